//! Claims and proofs as pages to be read without running anything.

use spring_mass_contact::{
    claims::{Entry, entries, registry},
    formula::Hypothesis,
    proof::{
        paper::{self, Paper},
        prove,
    },
};
use std::fmt::Write;

/// A section as entries have it, and as it is called.
pub const SECTIONS: [(&str, &str); 7] = [
    ("1.1", "1.1 Structural part"),
    ("1.2", "1.2 Contact part"),
    ("1.3.1", "1.3.1 Lagrange multiplier method"),
    ("1.3.2", "1.3.2 Penalty method"),
    ("1.3.3", "1.3.3 Augmented Lagrangian method"),
    ("notes", "The loose spots"),
    ("beyond", "Beyond the chapter"),
];

/// A proof of more lines than this is folded away.
const LONG: usize = 40;

/// A page of Markdown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// The name of its file.
    pub file: String,
    /// What stands on it.
    pub text: String,
}

/// A page for each section of the chapter: its entries, what is claimed of each, and the proofs.
pub fn pages() -> Vec<Page> {
    SECTIONS.iter().map(|(section, title)| page(section, title)).collect()
}

/// The heading over an entry's claims.
pub fn heading(entry: &Entry) -> String {
    format!("{} {}", entry.label(), entry.title)
}

/// The heading over the proof of one of them: no other on its page is the same.
pub fn heading_of(entry: &Entry, claim: &str) -> String {
    format!("{claim}, {}", entry.label())
}

fn page(section: &str, title: &str) -> Page {
    let mut text = format!(
        "# Proofs: {title}\n\n\
         Printed by the prover; a test holds this page to what it prints.\n\
         What the lines mean is said in [What is proved, and how](../proofs.md).\n"
    );
    let of_section = |entry: &&Entry| entry.section == section && !entry.claims.is_empty();
    entries().iter().filter(of_section).for_each(|entry| text += &account(entry));
    Page { file: format!("{section}.md"), text }
}

/// What is claimed of one entry.
fn account(entry: &Entry) -> String {
    let mut text = format!("\n## {}\n\n{}.\n", heading(entry), entry.statement());
    let functions: Vec<_> = entry.functions.iter().map(|function| format!("`{function}`")).collect();
    if !functions.is_empty() {
        let modules = entry.functions.iter().filter_map(|function| function.split_once("::"));
        let mut files: Vec<_> = modules.map(|(module, _)| format!("`src/chapter/{module}.rs`")).collect();
        files.dedup();
        let _ = write!(text, "\nComputed by {} in {}.\n", functions.join(", "), files.join(" and "));
    }
    for claim in &entry.claims {
        let paper = Paper::new(registry());
        let supposed = |given: &&Hypothesis| claim.hypotheses().contains(given);
        let given: Vec<_> = claim.stated_hypotheses().iter().filter(supposed).cloned().collect();
        let mut given = [("if", registry().all_supposed(&given)), ("always", paper.always(claim))]
            .into_iter()
            .filter(|(_, all)| !all.is_empty())
            .map(|(what, all)| format!("\n\n{what} `{}`", all.join("`, `")))
            .collect::<String>();
        if !paper.always(claim).is_empty() {
            given += ", which is part of the proof";
        }
        let _ =
            write!(text, "\n### {}\n\n`{}`{given}\n\n", heading_of(entry, claim.name()), paper.claim(claim));
        text += &match prove(claim) {
            Ok(proof) => {
                let names = paper.names(claim).into_iter().map(|name| format!("where {name}"));
                let lines: Vec<_> = names.chain(paper.proof(&proof)).collect();
                let block = format!("```text\n{}\n```\n", lines.join("\n"));
                let summary = format!("{}, {} lines", paper::how(&proof), lines.len());
                if lines.len() > LONG {
                    format!("<details><summary>{summary}</summary>\n\n{block}\n</details>\n")
                } else {
                    block
                }
            }
            Err(why) => format!("**not proved**: {}\n", paper.why(claim, &why)),
        };
    }
    text
}
