//! Line breaks in formulas.

/// A space at which no line is broken.
pub const NO_BREAK_SPACE: char = '\u{a0}';

/// Joins each operator or relation to its right operand, and factors and quotients to each other, by no-break
/// spaces: a line is broken before an operator, and products stay together.
pub fn join_operands(text: &str) -> String {
    let words: Vec<&str> = text.split(' ').collect();
    let mut all = words.first().unwrap_or(&"").to_string();
    for pair in words.windows(2) {
        let (word, next) = (pair[0], pair[1]);
        let is_joined = is_operator(word) || next == "/" || is_factor(word) && is_factor(next);
        all.push(if is_joined { NO_BREAK_SPACE } else { ' ' });
        all.push_str(next);
    }
    all
}

fn is_operator(word: &str) -> bool {
    ["+", "−", "/", "=", "≠", "<", ">", "≤", "≥", "→"].contains(&word)
}

/// Returns `true` for a symbol or a number that no punctuation ends.
fn is_factor(word: &str) -> bool {
    let letters = word.chars().filter(|c| c.is_alphabetic()).count();
    letters < 2 && !is_operator(word) && !word.ends_with([',', ';', ':'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_stay_together() {
        let parts = |text: &str| -> Vec<_> {
            join_operands(text).split(' ').map(|part| part.replace(NO_BREAK_SPACE, "_")).collect()
        };
        assert_eq!(parts("it is 2 c ε² / (c + ε) − s₁ u"), ["it", "is", "2_c_ε²_/_(c", "+_ε)", "−_s₁_u"]);
        assert_eq!(parts("c > 0, ε ≥ 0: m g"), ["c", ">_0,", "ε", "≥_0:", "m_g"]);
        assert_eq!(parts(""), [""]);
    }
}
