//! Equation numbers in usual notation.

use super::{Entry, entries};

/// Returns the entry with this number, in any usual notation: `1.13`, `(1.13)`, `Eq. (1.13)`, `theorem
/// 1.3.3`, `Fig 1.2`.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::claims::find_entry;
/// assert_eq!(find_entry("thm. 1.3.3").map(|entry| entry.equation), Some("Theorem 1.3.3"));
/// assert!(find_entry("1.3.3").is_none()); // no equation has this number
/// ```
pub fn find_entry(text: &str) -> Option<&'static Entry> {
    let wanted = name_and_number(text);
    entries().iter().find(|entry| name_and_number(entry.equation) == wanted)
}

/// Returns the entries whose numbers the words are; a name and its number may be two words.
///
/// # Errors
/// Returns the first word that is neither a number nor the name of one.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::claims::find_entries;
/// let numbers = |words| find_entries(words).map(|all| all.iter().map(|e| e.equation).collect::<Vec<_>>());
/// let words = ["eq.", "1.13", "theorem 1.3.3", "note", "4"];
/// assert_eq!(numbers(&words), Ok(vec!["1.13", "Theorem 1.3.3", "note 4"]));
/// assert_eq!(numbers(&["1.13", "theorem", "1.13"]), Err("theorem"));
/// ```
pub fn find_entries<S: AsRef<str>>(words: &[S]) -> Result<Vec<&'static Entry>, &str> {
    let mut all = Vec::new();
    let mut left = words;
    while let [word, rest @ ..] = left {
        let word = word.as_ref();
        let is_name = !word.is_empty() && word.chars().all(|c| c.is_alphabetic() || c == '.');
        // A name without a number can only belong to the next word.
        let (found, rest) = match (find_entry(word), rest) {
            (None, [next, rest @ ..]) if is_name => (find_entry(&format!("{word} {}", next.as_ref())), rest),
            (found, rest) => (found, rest),
        };
        all.push(found.ok_or(word)?);
        left = rest;
    }
    Ok(all)
}

/// Returns the kind of number in lower case, empty for an equation, and its digits.
fn name_and_number(text: &str) -> (String, &str) {
    let text = strip_parentheses(text);
    let (name, number) = text.split_at(text.find(|c: char| !c.is_alphabetic()).unwrap_or(text.len()));
    let name = name.to_lowercase();
    let number = if name.is_empty() { number } else { number.strip_prefix('.').unwrap_or(number) };
    let name = match name.as_str() {
        "eq" | "eqn" | "equation" => "",
        "figure" => "fig",
        "rem" => "remark",
        "thm" => "theorem",
        other => other,
    };
    (name.to_string(), strip_parentheses(number))
}

fn strip_parentheses(text: &str) -> &str {
    let text = text.trim();
    text.strip_prefix('(').and_then(|text| text.strip_suffix(')')).map_or(text, str::trim)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn equation(text: &str) -> Option<&'static str> {
        find_entry(text).map(|entry| entry.equation)
    }

    #[test]
    fn every_notation_of_a_number_is_understood() {
        for (number, ways) in [
            ("1.13", ["( 1.13 )", "Eq. (1.13)", "EQN.1.13", "(equation 1.13)"]),
            ("Theorem 1.3.3", ["THEOREM  1.3.3", "Thm. 1.3.3", "theorem (1.3.3)", "(Theorem 1.3.3)"]),
            ("Fig. 1.2", ["Fig 1.2", "FIG.1.2", "figure 1.2", "(Fig. 1.2)"]),
            ("Remark 1.3.2", ["rem. 1.3.2", "REMARK 1.3.2", "remark (1.3.2)", "remark1.3.2"]),
            ("note 4", ["NOTE 4", "note4", "note  4", "(note 4)"]),
            ("beyond 2", ["BEYOND 2", "beyond2", "beyond (2)", " beyond 2 "]),
        ] {
            for way in ways.into_iter().chain([number]) {
                assert_eq!(equation(way), Some(number), "{way}");
            }
        }
    }

    #[test]
    fn a_name_and_its_number_can_be_two_words() {
        let numbers =
            |words| find_entries(words).map(|all| all.iter().map(|e| e.equation).collect::<Vec<_>>());
        assert_eq!(numbers(&["eq.", "1.13", "note", "4"]), Ok(vec!["1.13", "note 4"]));
        for words in &[["(note", "4)"], ["", "1.13"], ["theorem", "1.13"]] {
            assert_eq!(numbers(words), Err(words[0]));
        }
    }

    #[test]
    fn every_entry_is_found_by_its_number_and_its_label() {
        for entry in entries() {
            assert_eq!(equation(entry.equation), Some(entry.equation));
            assert_eq!(equation(&entry.label()), Some(entry.equation));
        }
    }

    /// The number of a section is not that of a theorem, and that of a figure is not that of an equation.
    #[test]
    fn invalid_numbers_are_rejected() {
        for text in [
            "",
            " ",
            "()",
            ".",
            "9.9",
            "1.130",
            "01.13",
            "1.13.",
            ".1.13",
            "1,13",
            "(1.13",
            "1.13)",
            "1.3.3",
            "4",
            "note",
            "theorem",
            "theorem 1.13",
            "note 1.13",
            "note 10",
            "eq note 4",
            "eq",
            "section 1.3.3",
            "-1.13",
            "1.13 1.14",
            "notes 4",
            "fig.. 1.2",
        ] {
            assert_eq!(equation(text), None, "{text}");
        }
    }
}
