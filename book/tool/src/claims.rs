//! Status of the claims: a line in the box of each equation.
//!
//! Claims are proved and tested when the book is built; no status is written by hand, and an open claim stops the build.

use crate::proofs::{heading, tested};
use anyhow::{Result, ensure};
use spring_mass_contact::{
    claims::Entry,
    verify::{Options, Status, verify},
};
use std::sync::LazyLock;

/// Number of cases on which each claim is tested; `contact verify` uses more.
const CASES: u64 = 50;

/// Proves and tests all claims on the first call.
///
/// # Errors
/// Returns an error if a claim is not proved, fails or is undecided.
pub fn verify_all() -> Result<()> {
    static OPEN: LazyLock<Vec<String>> = LazyLock::new(|| {
        let rows = verify(&Options { cases: CASES, ..Options::default() }, &|_, _| ()).rows;
        let open = rows.iter().filter(|row| !matches!(row.status, Status::Proved | Status::Held));
        open.map(|row| format!("{} of {}", row.claim, row.equation)).collect()
    });
    ensure!(OPEN.is_empty(), "these claims are open, see `contact verify`: {}", OPEN.join(", "));
    Ok(())
}

/// Returns the status line of an equation in Markdown, which links to its claims; `up` is the relative path to the root
/// of the book.
pub fn status(entry: &Entry, up: &str) -> String {
    let tested = match tested(entry).count() {
        0 => String::new(),
        tested => format!(", {tested} only tested"),
    };
    let (count, link) = (claim_count(entry), link(entry));
    format!("<div class=\"status\">\n\n[{count}]({up}{link}) proved{tested}\n\n</div>")
}

/// Returns `1 claim`, `2 claims`, and so on: the number of proved claims about an entry.
pub fn claim_count(entry: &Entry) -> String {
    match entry.claims.len() {
        1 => "1 claim".into(),
        count => format!("{count} claims"),
    }
}

/// Returns the name of an entry in addresses: `1-13`, `note-3`, `theorem-1-3-3`.
pub fn slug(entry: &Entry) -> String {
    entry.equation.to_lowercase().replace(". ", "-").replace(['.', ' '], "-")
}

/// Returns the link to the claims of an entry.
fn link(entry: &Entry) -> String {
    format!("proofs/{}.md#{}", entry.section, id(&heading(entry)))
}

/// Returns the anchor that mdBook generates for a heading.
fn id(heading: &str) -> String {
    let letter = |c: char| match c {
        c if c.is_alphanumeric() || c == '_' || c == '-' => Some(c),
        c => c.is_whitespace().then_some('-'),
    };
    heading.to_lowercase().chars().filter_map(letter).collect()
}
