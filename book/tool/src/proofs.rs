//! The pages of claims and proofs, in Markdown.

use spring_mass_contact::{
    claims::{Entry, entries, registry},
    formula::Statement,
    proof::{
        prove,
        render::{self, ProofPrinter},
    },
};
use std::fmt::Write;

/// Sections of the entries, each with its title.
pub const SECTIONS: [(&str, &str); 7] = [
    ("1.1", "1.1 Structural part"),
    ("1.2", "1.2 Contact part"),
    ("1.3.1", "1.3.1 Lagrange multiplier method"),
    ("1.3.2", "1.3.2 Penalty method"),
    ("1.3.3", "1.3.3 Augmented Lagrangian method"),
    ("notes", "The loose spots"),
    ("beyond", "Beyond the chapter"),
];

/// Maximum number of lines of a proof that is not folded.
const MAX_OPEN_LINES: usize = 20;

/// Returns the file name and the Markdown text of a page for each section, with its entries, their claims and the proofs.
pub fn pages() -> impl Iterator<Item = (String, String)> {
    SECTIONS.iter().map(|(section, title)| (format!("{section}.md"), page(section, title)))
}

/// Returns the heading of an entry.
pub fn heading(entry: &Entry) -> String {
    format!("{} {}", entry.label(), entry.title)
}

/// Returns the heading of the proof of a claim, which is unique on its page.
pub fn heading_of(entry: &Entry, claim: &str) -> String {
    format!("{claim}, {}", entry.label())
}

/// Returns the hypotheses of a claim as they are stated, without invariants, which are part of the proof.
pub fn format_hypotheses(claim: &Statement) -> Vec<String> {
    let stated = claim.stated_hypotheses().iter().filter(|h| claim.hypotheses().contains(h));
    registry().format_hypotheses(&stated.cloned().collect::<Vec<_>>())
}

fn page(section: &str, title: &str) -> String {
    let mut text = format!(
        "# Proofs: {title}\n\n\
         This page is printed by the prover, and a test compares the two.\n\
         [What is proved, and how](../proofs.md) explains the notation.\n"
    );
    let of_section = |entry: &&Entry| entry.section == section && !entry.claims.is_empty();
    entries().iter().filter(of_section).for_each(|entry| text += &render_entry(entry));
    text
}

/// Renders an entry with its claims and proofs.
fn render_entry(entry: &Entry) -> String {
    let mut text = format!("\n## {}\n\n{}.\n", heading(entry), entry.statement());
    if !entry.functions.is_empty() {
        let modules = entry.functions.iter().filter_map(|function| function.split_once("::"));
        let mut files: Vec<_> = modules.map(|(module, _)| format!("`src/chapter/{module}.rs`")).collect();
        files.dedup();
        let (functions, files) = (entry.functions.join("`, `"), files.join(" and "));
        let _ = write!(text, "\nComputed by `{functions}` in {files}.\n");
    }
    for claim in &entry.claims {
        let printer = ProofPrinter::new(registry());
        let mut conditions = String::new();
        for (word, list, note) in [
            ("if", format_hypotheses(claim), ""),
            ("always", printer.invariants(claim), ", which is part of the proof"),
        ] {
            if !list.is_empty() {
                let _ = write!(conditions, "\n\n{word} `{}`{note}", list.join("`, `"));
            }
        }
        let heading = heading_of(entry, claim.name());
        let _ = write!(text, "\n### {heading}\n\n`{}`{conditions}\n\n", printer.claim(claim));
        text += &match prove(claim) {
            Ok(proof) => {
                let names = printer.names(claim).into_iter().map(|name| format!("where {name}"));
                let lines: Vec<_> = names.chain(printer.proof(&proof)).collect();
                let block = format!("```text\n{}\n```\n", lines.join("\n"));
                let summary = format!("{}, {} lines", render::proof_summary(&proof), lines.len());
                if lines.len() > MAX_OPEN_LINES {
                    format!("<details><summary>{summary}</summary>\n\n{block}\n</details>\n")
                } else {
                    block
                }
            }
            Err(error) => format!("**not proved**: {}\n", printer.describe(claim, &error)),
        };
    }
    text
}
