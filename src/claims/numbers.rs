//! The chapter's numbers as people write them.

use super::{Entry, entries};

/// The entry of this number, in any of the ways that numbers are written: `1.13`, `(1.13)`, `Eq. (1.13)`,
/// `theorem 1.3.3`, `Fig 1.2`.
///
/// ```
/// # use spring_mass_contact::claims::numbered;
/// assert_eq!(numbered("thm. 1.3.3").map(|entry| entry.equation), Some("Theorem 1.3.3"));
/// assert!(numbered("1.3.3").is_none()); // no equation has this number
/// ```
pub fn numbered(text: &str) -> Option<&'static Entry> {
    let wanted = name_and_number(text);
    entries().iter().find(|entry| name_and_number(entry.equation) == wanted)
}

/// The entries whose numbers the words of a line are; a name and its number may be two of them.
///
/// # Errors
/// The first word that is no number, and no name of one.
///
/// ```
/// # use spring_mass_contact::claims::all_numbered;
/// let numbers = |words| all_numbered(words).map(|all| all.iter().map(|e| e.equation).collect::<Vec<_>>());
/// let words = ["eq.", "1.13", "theorem 1.3.3", "note", "4"];
/// assert_eq!(numbers(&words), Ok(vec!["1.13", "Theorem 1.3.3", "note 4"]));
/// assert_eq!(numbers(&["1.13", "theorem", "1.13"]), Err("theorem"));
/// ```
pub fn all_numbered<S: AsRef<str>>(words: &[S]) -> Result<Vec<&'static Entry>, &str> {
    let mut all = Vec::new();
    let mut left = words;
    while let [word, rest @ ..] = left {
        let word = word.as_ref();
        let is_name = !word.is_empty() && word.chars().all(|c| c.is_alphabetic() || c == '.');
        // A name alone is no number, so it can only belong to the word behind it.
        let (found, rest) = match (numbered(word), rest) {
            (None, [next, rest @ ..]) if is_name => (numbered(&format!("{word} {}", next.as_ref())), rest),
            (found, rest) => (found, rest),
        };
        all.push(found.ok_or(word)?);
        left = rest;
    }
    Ok(all)
}

/// What a number is called, none for an equation, and its digits, without how they are written.
fn name_and_number(text: &str) -> (String, &str) {
    let bare = |text| {
        let text = str::trim(text);
        text.strip_prefix('(').and_then(|text| text.strip_suffix(')')).map_or(text, str::trim)
    };
    let text = bare(text);
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
    (name.to_string(), bare(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn equation(text: &str) -> Option<&'static str> {
        numbered(text).map(|entry| entry.equation)
    }

    #[test]
    fn a_number_is_understood_however_it_is_written() {
        for (number, ways) in [
            ("1.13", ["(1.13)", "( 1.13 )", " 1.13", "eq 1.13", "Eq. (1.13)", "EQN.1.13", "(equation 1.13)"]),
            (
                "Theorem 1.3.3",
                [
                    "theorem 1.3.3",
                    "THEOREM  1.3.3",
                    "Theorem1.3.3",
                    "Thm. 1.3.3",
                    "thm 1.3.3",
                    "theorem (1.3.3)",
                    "(Theorem 1.3.3)",
                ],
            ),
            (
                "Fig. 1.2",
                ["Fig 1.2", "fig. 1.2", "fig 1.2", "FIG.1.2", "figure 1.2", "Figure (1.2)", "(Fig. 1.2)"],
            ),
            (
                "Remark 1.3.2",
                [
                    "remark 1.3.2",
                    "Remark. 1.3.2",
                    "rem. 1.3.2",
                    "Rem 1.3.2",
                    "REMARK 1.3.2",
                    "remark (1.3.2)",
                    "remark1.3.2",
                ],
            ),
            ("note 4", ["Note 4", "NOTE 4", "note4", "note  4", "note (4)", "(note 4)", "Note. 4"]),
            (
                "beyond 2",
                ["Beyond 2", "BEYOND 2", "beyond2", "beyond  2", "beyond (2)", "(beyond 2)", " beyond 2 "],
            ),
        ] {
            for way in ways.into_iter().chain([number]) {
                assert_eq!(equation(way), Some(number), "{way}");
            }
        }
    }

    #[test]
    fn every_number_is_itself_and_its_label() {
        for entry in entries() {
            assert_eq!(equation(entry.equation), Some(entry.equation));
            assert_eq!(equation(&entry.label()), Some(entry.equation));
        }
    }

    /// A section's number is no theorem's, and one figure's no equation's.
    #[test]
    fn what_is_no_number_is_not_guessed() {
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
            "note 7",
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
