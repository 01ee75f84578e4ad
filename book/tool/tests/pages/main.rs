//! The pages as they are written: what stands in them is held to the code, to the command and to each other.

mod command;
mod exercises;
mod files;
mod letters;
mod proofs;
mod tables;

/// A page, by the name of its file.
fn page(name: &str) -> String {
    files::text(&files::root().join(format!("book/src/{name}.md")))
}
