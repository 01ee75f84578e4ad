//! Each letter of the book's formulas is on the page of notation.

use super::page;
use book_tool::{PAGES, equations};
use pulldown_cmark::{Event, Options, Parser};
use regex::{Captures, Regex};
use spring_mass_contact::{claims::registry, formula::Notation};
use std::collections::BTreeSet;

const GREEK: [&str; 23] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu",
    "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
];

/// Page that explains its own letters, those of matrices.
const WITH_OWN_LETTERS: &str = "elements";

/// Returns the formulas of a text, with the formulas of functions in place of tags.
fn formulas(text: &str) -> String {
    let tag = Regex::new(r"\{\{#(formula|eq) ((?:[^{}]|\{[^{}]*\})+)\}\}").unwrap();
    let filled = tag.replace_all(text, |tag: &Captures| {
        let equation = || equations().find(|(entry, _)| entry.equation == &tag[2]);
        let latex = match &tag[1] {
            "eq" => equation().map(|(_, latex)| format!("${latex}$")),
            _ => registry().render_placeholder(&tag[2], Notation::Latex),
        };
        latex.unwrap_or_else(|| panic!("no formula for {}", &tag[0]))
    });
    let all = Parser::new_ext(&filled, Options::ENABLE_MATH | Options::ENABLE_TABLES);
    all.filter_map(|event| match event {
        Event::InlineMath(latex) | Event::DisplayMath(latex) => Some(latex.to_string() + "\n"),
        _ => None,
    })
    .collect()
}

/// Returns the letters in a formula. Upright text is a word, except for Euler's number.
fn letters(latex: &str) -> BTreeSet<String> {
    let upright = r"\\mathrm(?:\{e\}| e\b)|\\(?:mathrm|text|begin|end)\s*(?:\{[^}]*\}|[A-Za-z])";
    let letter = r"\\mathcal\{\w\}|\\[A-Za-z]+|[A-Za-z]";
    let either = Regex::new(&format!("{upright}|{letter}")).unwrap();
    let euler = "\\mathrm e";
    let known = |found: &str| match found.strip_prefix('\\') {
        Some(name) if name.starts_with("mathcal") => Some(found.to_string()),
        Some("mathrm{e}" | "mathrm e") => Some(euler.to_string()),
        Some(name) => {
            let letter = name.strip_prefix("var").unwrap_or(name).to_lowercase();
            GREEK.contains(&&*letter).then(|| found.to_string())
        }
        None => Some(found.to_string()),
    };
    either.find_iter(latex).filter_map(|found| known(found.as_str())).collect()
}

#[test]
fn every_letter_is_on_the_page_of_notation() {
    // The symbol at the start of a row, up to an equals sign.
    let notation = page("notation");
    let symbols = notation.lines().filter_map(|line| line.strip_prefix("| $")?.split_once(['$', '=']));
    let explained: BTreeSet<_> = symbols.flat_map(|(symbol, _)| letters(symbol)).collect();
    for name in PAGES.iter().filter(|name| !["notation", WITH_OWN_LETTERS].contains(name)) {
        let used = letters(&formulas(&page(name)));
        let missing: Vec<_> = used.difference(&explained).collect();
        assert!(missing.is_empty(), "{name}.md: not on the page of notation: {missing:?}");
    }
}
