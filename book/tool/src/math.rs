//! Conversion of LaTeX to HTML.

use anyhow::{Context, Result};
use katex::{KatexContext, Settings, StrictMode, StrictSetting};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use regex::{Captures, Regex};
use spring_mass_contact::{claims::registry, formula::Notation};

/// Maximum length in characters of a formula that is never broken.
const MAX_UNBROKEN: usize = 24;

/// Characters that must not begin a line.
const PUNCTUATION: [char; 7] = ['.', ',', ';', ':', ')', '?', '”'];

/// Characters that must not end a line.
const OPENING: [char; 2] = ['(', '“'];

/// Boundary between parts of a formula, where it may be broken.
const PARTS: &str = "</span><span class=\"katex-base\">";

/// Converts LaTeX to HTML that Markdown leaves unchanged.
pub struct Typesetter {
    katex: KatexContext,
    element: Regex,
    attribute: Regex,
    omitted: Regex,
    tag: Regex,
    formula: Regex,
}

impl Typesetter {
    pub fn new() -> Result<Self> {
        Ok(Self {
            katex: KatexContext::default(),
            element: Regex::new(r#"<([a-zA-Z]+)((?: [\w:-]+="[^"]*"){2,})"#)?,
            attribute: Regex::new(r#" [\w:-]+="[^"]*""#)?,
            omitted: Regex::new(r#"(?s)<annotation .*?</annotation>|</?semantics>| xmlns="[^"]*""#)?,
            tag: Regex::new("<[^>]*>")?,
            formula: super::tag("formula")?,
        })
    }

    /// Typesets the `$…$` and `$$…$$` of a page; code is left unchanged.
    pub fn page(&self, text: &str) -> Result<String> {
        let mut result = String::with_capacity(text.len());
        let (mut end, mut in_head) = (0, false);
        for (event, range) in
            Parser::new_ext(text, Options::ENABLE_MATH | Options::ENABLE_TABLES).into_offset_iter()
        {
            let (html, short) = match event {
                Event::Start(Tag::TableHead) => {
                    in_head = true;
                    continue;
                }
                Event::End(TagEnd::TableHead) => {
                    in_head = false;
                    continue;
                }
                Event::InlineMath(latex) if in_head => (self.labelled(&self.inline(&latex)?), true),
                Event::InlineMath(latex) => (self.inline(&latex)?, latex.chars().count() <= MAX_UNBROKEN),
                Event::DisplayMath(latex) => {
                    (format!("<span class=\"formula\">{}</span>", self.display(&latex)?), false)
                }
                _ => continue,
            };
            result += &text[end..range.start];
            end = range.end;
            let before = result.len() - result.trim_end_matches(OPENING).len();
            let after = text[end..].len() - text[end..].trim_start_matches(PUNCTUATION).len();
            if text[range].ends_with(r"\square$") {
                // The end mark of a proof stays with the last word.
                result.truncate(result.trim_end_matches(' ').len());
                result += &format!("&nbsp;<span class=\"qed\">{html}</span>");
            } else if before + after == 0 {
                result += &html;
            } else {
                // Punctuation stays with the formula, which is broken only if it is long.
                let opening = result.split_off(result.len() - before);
                let html = if short { html } else { html.replace(PARTS, &PARTS.replace("><", "><wbr><")) };
                result +=
                    &format!("<span class=\"unbroken\">{opening}{html}{}</span>", &text[end..end + after]);
                end += after;
            }
        }
        Ok(result + &text[end..])
    }

    /// Adds the letters of a formula as its label: accessibility tools treat a header of MathML alone as empty.
    fn labelled(&self, html: &str) -> String {
        let letters = html.split_once("</math>").map_or("", |(math, _)| math);
        let letters = self.tag.replace_all(letters, "");
        html.replacen("<math", &format!("<math aria-label=\"{letters}\""), 1)
    }

    /// Typesets an inline formula.
    pub fn inline(&self, latex: &str) -> Result<String> {
        self.html(latex, false)
    }

    /// Typesets a display formula.
    pub fn display(&self, latex: &str) -> Result<String> {
        self.html(latex, true)
    }

    fn html(&self, latex: &str, display: bool) -> Result<String> {
        let settings =
            Settings::builder().display_mode(display).strict(StrictSetting::Mode(StrictMode::Error)).build();
        let latex = &self.expand(latex)?;
        let html = katex::render_to_string(&self.katex, latex, &settings)
            .with_context(|| format!("the formula {latex}"))?;
        // The LaTeX that KaTeX adds would be indexed by the book's search as words. HTML needs no namespace.
        let html = self.omitted.replace_all(&html, "");
        Ok(hide_from_markdown(&self.sort_attributes(&html)))
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

    /// Sorts the attributes, whose order varies from run to run, so that the output is reproducible.
    fn sort_attributes(&self, html: &str) -> String {
        let sorted = |element: &Captures| {
            let mut attributes: Vec<_> = self.attribute.find_iter(&element[2]).map(|a| a.as_str()).collect();
            attributes.sort_unstable();
            format!("<{}{}", &element[1], attributes.concat())
        };
        self.element.replace_all(html, sorted).into_owned()
    }
}

/// Replaces the characters that Markdown or mdBook would interpret by entities.
fn hide_from_markdown(html: &str) -> String {
    html.chars()
        .map(|c| match c {
            '_' | '*' | '|' | '\\' | '`' | '~' | '[' | ']' | '{' | '}' | '$' | '\n' => {
                format!("&#{};", u32::from(c))
            }
            _ => c.to_string(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(text: &str) -> Result<String> {
        Typesetter::new()?.page(text)
    }

    #[test]
    fn code_and_single_dollars_are_not_formulas() -> Result<()> {
        let text = "`$x$` costs 5 $\n\n```text\n$y$\n```\n";
        assert_eq!(page(text)?, text);
        Ok(())
    }

    #[test]
    fn formula_is_protected_from_markdown() -> Result<()> {
        let html = page(r"a $x_1 * y_2 \vert z$ b")?;
        assert!(html.starts_with("a <span") && html.ends_with("</span> b"), "{html}");
        assert!(!html.contains(['_', '*', '|', '\\', '\n']), "{html}");
        Ok(())
    }

    #[test]
    fn punctuation_stays_on_the_line_of_its_formula() -> Result<()> {
        let html = page("$x$; $y$ z, $a = b + b + b + b + b + b$). $a = b$, $c$")?;
        assert!(
            html.starts_with("<span class=\"unbroken\"><span") && html.contains("</span>;</span> <span"),
            "{html}"
        );
        assert!(
            html.contains("</span> z, <span class=\"unbroken\"><span")
                && html.contains("</span>).</span> <span"),
            "{html}"
        );
        assert_eq!(html.matches("<wbr>").count(), 6, "between the parts of the long one: {html}");
        let html = page("so ($x = 1$) it ends. $\\square$\n")?;
        assert!(
            html.starts_with("so <span class=\"unbroken\">(<span") && html.contains("</span>)</span> it"),
            "{html}"
        );
        assert!(html.contains("it ends.&nbsp;<span class=\"qed\"><span"), "{html}");
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
        assert!(
            page("${{#formula nothing::gap}}$").unwrap_err().to_string().contains("no formula nothing::gap")
        );
        Ok(())
    }

    #[test]
    fn invalid_formula_is_an_error() {
        let error = page(r"$\frac{1}$").unwrap_err();
        assert!(error.to_string().contains(r"\frac{1}"), "{error:?}");
        assert!(page(r"$\unknown$").is_err());
    }

    #[test]
    fn equal_formulas_give_equal_files() -> Result<()> {
        let formula = r"$$\sqrt{\frac{a}{b}} \overline{x} \begin{cases} a & b \\ c & d \end{cases}$$";
        let first = page(formula)?;
        for _ in 0..20 {
            assert_eq!(page(formula)?, first);
        }
        Ok(())
    }
}
