//! Conversion of LaTeX to MathML.

use anyhow::{Context, Result, anyhow};
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use regex::Regex;
use spring_mass_contact::{claims::registry, formula::Notation};

/// Maximum length in characters of a formula that is never broken.
const MAX_UNBROKEN: usize = 24;

/// Characters that must not begin a line.
const PUNCTUATION: [char; 7] = ['.', ',', ';', ':', ')', '?', '”'];

/// Characters that must not end a line.
const OPENING: [char; 2] = ['(', '“'];

/// End mark of a proof, which stays with the last word.
const END_MARK: &str = "&nbsp;<span class=\"qed\">□</span>";

/// Relations after which a long formula may be broken.
const RELATIONS: [&str; 12] = ["=", "&lt;", "&gt;", "≤", "≥", "≠", "≈", "∼", "≪", "≫", "→", "⇒"];

/// Converts LaTeX to MathML that Markdown leaves unchanged.
pub struct Typesetter {
    converter: LatexToMathML,
    tag: Regex,
    formula: Regex,
}

impl Typesetter {
    pub fn new() -> Result<Self> {
        Ok(Self {
            converter: LatexToMathML::new(MathCoreConfig::default())
                .map_err(|(error, ..)| anyhow!("{error:?}"))?,
            tag: Regex::new("<(/?)[a-z]+[^>]*?(/?)>")?,
            formula: super::tag("formula")?,
        })
    }

    /// Typesets the `$…$` and `$$…$$` of a page; code is left unchanged.
    pub fn page(&self, text: &str) -> Result<String> {
        let text = &text.replace(r" $\square$", END_MARK);
        let mut result = String::with_capacity(text.len());
        let (mut end, mut in_head) = (0, false);
        for (event, range) in
            Parser::new_ext(text, Options::ENABLE_MATH | Options::ENABLE_TABLES).into_offset_iter()
        {
            let html = match event {
                Event::Start(Tag::TableHead) | Event::End(TagEnd::TableHead) => {
                    in_head = !in_head;
                    continue;
                }
                Event::InlineMath(latex) if in_head => self.labelled(&latex)?,
                Event::InlineMath(latex) => self.inline(&latex)?,
                Event::DisplayMath(latex) => {
                    format!("<span class=\"formula\">{}</span>", self.display(&latex)?)
                }
                _ => continue,
            };
            result += &text[end..range.start];
            end = range.end;
            let before = result.len() - result.trim_end_matches(OPENING).len();
            let after = text[end..].len() - text[end..].trim_start_matches(PUNCTUATION).len();
            if before + after == 0 {
                result += &html;
            } else {
                // Punctuation stays with the formula.
                let opening = result.split_off(result.len() - before);
                result +=
                    &format!("<span class=\"unbroken\">{opening}{html}{}</span>", &text[end..end + after]);
                end += after;
            }
        }
        Ok(result + &text[end..])
    }

    /// Typesets a formula with its letters as a label: accessibility tools treat a header of MathML alone as empty.
    fn labelled(&self, latex: &str) -> Result<String> {
        let html = self.html(latex, MathDisplay::Inline)?;
        let label = format!("<math aria-label=\"{}\"", self.tag.replace_all(&html, ""));
        Ok(html.replacen("<math", &label, 1))
    }

    /// Typesets an inline formula.
    pub fn inline(&self, latex: &str) -> Result<String> {
        let html = self.html(latex, MathDisplay::Inline)?;
        Ok(if latex.chars().count() <= MAX_UNBROKEN { html } else { self.breakable(&html) })
    }

    /// Typesets a display formula.
    pub fn display(&self, latex: &str) -> Result<String> {
        self.html(latex, MathDisplay::Block)
    }

    fn html(&self, latex: &str, display: MathDisplay) -> Result<String> {
        let latex = &self.expand(latex)?;
        let formula = self
            .converter
            .convert_with_local_state(latex, display)
            .map_err(|error| anyhow!("the formula {latex}: {error:?}"))?;
        Ok(hide_from_markdown(&formula.mathml))
    }

    /// Divides a formula after its relations, because browsers never break one.
    fn breakable(&self, html: &str) -> String {
        let (mut result, mut end, mut depth) = (String::new(), 0, 0);
        for tag in self.tag.captures_iter(html) {
            let whole = tag.get(0).expect("a match");
            match (&tag[1], &tag[2]) {
                ("", "") => depth += 1,
                ("", _) => {}
                _ => depth -= 1,
            }
            let before = &html[..whole.start()];
            if depth == 1 && RELATIONS.iter().any(|relation| before.ends_with(&format!("<mo>{relation}"))) {
                result += &html[end..whole.end()];
                result += "</math><wbr><math>";
                end = whole.end();
            }
        }
        result + &html[end..]
    }

    /// Replaces the tags in LaTeX by the formulas of the functions.
    fn expand(&self, latex: &str) -> Result<String> {
        super::replaced(latex, &self.formula, |tag| {
            let path = tag.get(2).map_or("", |path| path.as_str());
            registry()
                .render_placeholder(path, Notation::Latex)
                .with_context(|| format!("no formula {path} at the head of a file in src/claims"))
        })
    }
}

/// Replaces the characters that Markdown or mdBook would interpret by entities.
fn hide_from_markdown(html: &str) -> String {
    let hidden =
        |c: char| if "_*|\\`~[]{}$\n".contains(c) { format!("&#{};", u32::from(c)) } else { c.to_string() };
    html.chars().map(hidden).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(text: &str) -> Result<String> {
        Typesetter::new()?.page(text)
    }

    #[test]
    fn formula_is_protected_from_markdown_and_code_is_not_a_formula() -> Result<()> {
        let text = "`$x$` costs 5 $\n\n```text\n$y$\n```\n";
        assert_eq!(page(text)?, text);
        let html = page(r"a $x_1 * y_2 \vert z$ b")?;
        assert!(html.starts_with("a <math>") && html.ends_with("</math> b"), "{html}");
        assert!(!html.contains(['_', '*', '|', '\\', '\n']), "{html}");
        Ok(())
    }

    #[test]
    fn punctuation_stays_on_the_line_of_its_formula() -> Result<()> {
        let html = page("$x$; ($y = 1$) $z$ z. $\\square$\n")?;
        assert_eq!(
            html,
            "<span class=\"unbroken\"><math><mi>x</mi></math>;</span> \
             <span class=\"unbroken\">(<math><mi>y</mi><mo>=</mo><mn>1</mn></math>)</span> \
             <math><mi>z</mi></math> z.&nbsp;<span class=\"qed\">□</span>\n"
        );
        Ok(())
    }

    #[test]
    fn long_formulas_are_broken_after_relations_outside_of_groups() -> Result<()> {
        let html = page(r"$\frac{a = b}{c} = \mathrm{name} \le x_{k < n}$")?;
        let parts: Vec<_> = html.split("</math><wbr><math>").collect();
        let ends = parts.iter().map(|part| part.ends_with("</mo>")).collect::<Vec<_>>();
        assert_eq!(ends, [true, true, false], "{html}");
        assert!(!page("$$\\frac{a = b}{c} = b + b + b + b + b + b$$")?.contains("<wbr>"));
        assert!(!page("$a = b = c = d = e = f$")?.contains("<wbr>"), "23 characters");
        Ok(())
    }

    #[test]
    fn formula_in_table_header_has_label() -> Result<()> {
        let table = page("| $p_k < 1$ |\n|---|\n| $q$ |\n")?;
        assert_eq!(table.matches("<math").count(), 2);
        assert_eq!(table.matches("<math aria-label=").count(), 1);
        assert!(table.contains("<math aria-label=\"pk&lt;1\">"), "{table}");
        Ok(())
    }

    #[test]
    fn tag_expands_to_recorded_formula() -> Result<()> {
        let tag = "{{#formula augmented::update: u=u_{k-1}, λ=λ₀}}";
        let latex = r"\lambda_0 + \varepsilon\,(l + u_{k-1} - H)";
        assert_eq!(
            page(&format!("$x = {tag}$ and $${tag}$$"))?,
            page(&format!("$x = {latex}$ and $${latex}$$"))?
        );
        Ok(())
    }
}
