//! Consistency of the pages with the code, with the command and with each other.

mod command;
mod exercises;
mod proofs;
mod tables;

use crate::files::text;

/// Returns the text of a page, given by the name of its file.
fn page(name: &str) -> String {
    text(format!("book/src/{name}.md"))
}
