//! Symbols in LaTeX.

const LETTERS: &[(char, &str)] = &[
    ('α', "\\alpha"),
    ('δ', "\\delta"),
    ('ε', "\\varepsilon"),
    ('η', "\\eta"),
    ('λ', "\\lambda"),
    ('μ', "\\mu"),
    ('ρ', "\\rho"),
    ('Δ', "\\Delta"),
    ('Λ', "\\Lambda"),
    ('Π', "\\Pi"),
    ('𝓛', "\\mathcal{L}"),
    ('∂', "\\partial"),
    ('…', "\\cdots"),
    ('′', "'"),
    ('−', "-"),
];

/// The dot above the preceding letter.
const DOT: char = '\u{307}';

fn subscript(c: char) -> Option<char> {
    "₀₁₂₃₄₅₆₇₈₉".chars().position(|subscript| subscript == c).and_then(|i| char::from_digit(i as u32, 10))
}

pub(super) fn superscript(c: char) -> Option<char> {
    let (superscripts, plain) = ("⁰¹²³⁴⁵⁶⁷⁸⁹⁺ᵃᵇᶠᵏᵖ", "0123456789+abfkp");
    superscripts.chars().position(|superscript| superscript == c).and_then(|i| plain.chars().nth(i))
}

/// Returns a subscript or an exponent, in braces if it has more than one character.
pub(super) fn script(kind: char, inner: &str) -> String {
    if inner.chars().count() == 1 { format!("{kind}{inner}") } else { format!("{kind}{{{inner}}}") }
}

/// Converts a symbol to LaTeX, character by character; words and subscripts that are words are upright.
///
/// # Examples
///
/// ```
/// use provable::formula::latex;
/// assert_eq!(["λ₀", "u_{k−1}"].map(latex), [r"\lambda_0", "u_{k-1}"]);
/// assert_eq!(["ε_eff", "u̇"].map(latex), [r"\varepsilon_{\mathrm{eff}}", r"\dot{u}"]);
/// ```
pub fn latex(symbol: &str) -> String {
    let mut result = String::new();
    let mut rest = symbol;
    while let Some(c) = rest.chars().next() {
        let after = &rest[c.len_utf8()..];
        if c == '_' || c == '^' {
            let inner = match after.strip_prefix('{').and_then(|inner| inner.split_once('}')) {
                Some((inner, left)) => {
                    rest = left;
                    inner
                }
                None => {
                    let end = prefix_len(after, char::is_alphanumeric);
                    rest = &after[end..];
                    &after[..end]
                }
            };
            result += &script(c, &latex(inner));
        } else if subscript(c).is_some() {
            let end = prefix_len(rest, |c| subscript(c).is_some());
            result += &script('_', &rest[..end].chars().filter_map(subscript).collect::<String>());
            rest = &rest[end..];
        } else if superscript(c).is_some() {
            let end = prefix_len(rest, |c| superscript(c).is_some());
            result += &script('^', &rest[..end].chars().filter_map(superscript).collect::<String>());
            rest = &rest[end..];
        } else if let Some(left) = after.strip_prefix(DOT) {
            push(&mut result, &format!("\\dot{{{}}}", latex(&c.to_string())));
            rest = left;
        } else if c.is_ascii_alphabetic() {
            let end = prefix_len(rest, |c| c.is_ascii_alphabetic());
            // A letter with a dot does not belong to the word before it.
            let end = if rest[end..].starts_with(DOT) { end - 1 } else { end };
            match &rest[..end] {
                word @ ("min" | "max" | "lim") => push(&mut result, &format!("\\{word}")),
                word if word.len() > 1 => push(&mut result, &format!("\\mathrm{{{word}}}")),
                letter => push(&mut result, letter),
            }
            rest = &rest[end..];
        } else {
            match LETTERS.iter().find(|(letter, _)| *letter == c) {
                Some((_, command)) => push(&mut result, command),
                None => result.push(c),
            }
            rest = after;
        }
    }
    result
}

/// Appends a symbol or command; a space separates it from a command if it begins with a letter.
fn push(result: &mut String, next: &str) {
    let ends_with_command = result
        .rsplit_once('\\')
        .is_some_and(|(_, name)| !name.is_empty() && name.chars().all(|c| c.is_ascii_alphabetic()));
    if ends_with_command && next.starts_with(|c: char| c.is_ascii_alphabetic()) {
        result.push(' ');
    }
    *result += next;
}

/// Returns the length of the characters at the beginning of a text that satisfy a condition.
fn prefix_len(text: &str, is_part: impl Fn(char) -> bool) -> usize {
    text.find(|c| !is_part(c)).unwrap_or(text.len())
}
