//! Definitions with one changed sign, for which some theorem must fail.

use super::super::coqc::{DEFINITIONS, of_claims, words};
use super::stated;
use spring_mass_contact::proof::coq::{Development, File};

/// A definition with one changed sign.
pub struct SignMutant {
    /// Name of the changed function in Coq.
    pub function: String,
    /// The changed definition.
    pub definition: String,
    /// All definitions with this one among them, then every claim about the function, the shortest first.
    pub file: File,
}

/// Returns a text with one sign changed, for each sign: + for − or vice versa, or a leading − removed.
fn with_changed_signs(text: &str) -> Vec<String> {
    let signs = text.match_indices(['+', '-']);
    let mutant = |(at, sign): (usize, &str)| {
        let (before, after) = (&text[..at], &text[at + 1..]);
        let joins = before.trim_end().ends_with(|c: char| c.is_ascii_alphanumeric() || "_)".contains(c));
        match (joins, sign) {
            (false, _) => format!("{before}{}", after.trim_start()),
            (true, "+") => format!("{before}-{after}"),
            (true, _) => format!("{before}+{after}"),
        }
    };
    signs.map(mutant).collect()
}

/// Splits a file of theorems into its head and its claims, each with the lemmas before its theorem.
fn claims(file: &File) -> (&str, Vec<&str>) {
    let (head, mut rest) = file.text.split_once("\n\n").unwrap();
    let mut all = Vec::new();
    while let Some(theorem) = rest.find("Theorem ") {
        let end = theorem + rest[theorem..].find("Qed.\n").unwrap() + "Qed.\n".len();
        all.push(&rest[..end]);
        rest = &rest[end..];
    }
    (head, all)
}

/// Returns `true` if a statement contains a function; names in proofs do not count.
fn speaks_of(text: &str, function: &str) -> bool {
    stated(text).any(|stated| words(stated).any(|word| word == function))
}

/// Returns every definition with one changed sign.
pub fn sign_mutants(development: &Development) -> Vec<SignMutant> {
    let files = development.files();
    let definitions = &files.iter().find(|file| file.name == DEFINITIONS).unwrap().text;
    let of_files: Vec<_> = of_claims(&files).map(claims).collect();
    let mut all = Vec::new();
    for (start, _) in definitions.match_indices("Definition ") {
        let (definition, rest) = definitions[start..].split_once(".\n").unwrap();
        let (head, body) = definition.split_once(":=").unwrap();
        let function = words(head).nth(1).unwrap();
        let mut about_it: Vec<_> = of_files
            .iter()
            .flat_map(|(head, claims)| claims.iter().map(move |claim| (*head, *claim)))
            .filter(|(_, claim)| speaks_of(claim, function))
            .collect();
        about_it.sort_by_key(|(_, claim)| claim.len());
        let rounds = about_it.iter().find(|(head, _)| head.contains("Flocq"));
        let needed = rounds.map_or(String::new(), |(head, _)| head.replace(" B_Definitions", "") + "\n");
        let theorems: Vec<_> = about_it.iter().map(|(_, claim)| *claim).collect();
        for (body, i) in with_changed_signs(body).into_iter().zip(1..) {
            let definition = format!("{head}:={body}.");
            let before = &definitions[..start];
            let text = format!("{needed}{before}{definition}\n{rest}\n{}", theorems.join("\n"));
            let file = File { name: format!("F_{function}_{i}.v"), text };
            all.push(SignMutant { function: function.to_string(), definition, file });
        }
    }
    all
}

#[test]
fn a_mutant_changes_one_sign() {
    assert_eq!(
        with_changed_signs("- (a + b) * c - a"),
        ["(a + b) * c - a", "- (a - b) * c - a", "- (a + b) * c + a"]
    );
    // At every position of the sign.
    assert_eq!(
        with_changed_signs("exp (Rmin a (- b)) - - 2"),
        ["exp (Rmin a (b)) - - 2", "exp (Rmin a (- b)) + - 2", "exp (Rmin a (- b)) - 2"]
    );
}
