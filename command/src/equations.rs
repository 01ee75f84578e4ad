//! `contact equations`: the chapter as data.

mod graph;

use crate::args;
use crate::output::{self, Exit, Failure, formats, record};
use graph::graph;
use serde::Serialize;
use spring_mass_contact::claims::{Entry, SourceLine, entries, function_line};
use spring_mass_contact::verify::claim_names;
use std::ffi::OsStr;
use std::io::{self, Write};
use std::iter;
use std::path::Path;

const EXAMPLES: &str = "\
Examples:
  contact equations
  contact equations 1.13 'Theorem 1.3.3' 'note 4'
  contact equations --format json
  contact equations --format dot | dot -Tsvg > chapter.svg";

/// List the equations of the chapter with their functions and claims
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these, with their statements: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

formats!(
    Table: "For reading",
    Json: "For programs",
    Dot: "For Graphviz: dependencies, and what is proved"
);

/// Prints the entries.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let numbers = args::equations(&options.numbers)?;
    let all = numbers.is_empty();
    let chosen: Vec<&'static Entry> =
        entries().iter().filter(|e| all || numbers.iter().any(|n| n == e.equation)).collect();
    output::print(|out| match options.format {
        Format::Json => output::json(out, &chosen.iter().map(|entry| json(entry)).collect::<Vec<_>>()),
        Format::Dot => write!(out, "{}", graph(&chosen)),
        Format::Table if all => table(out, &chosen),
        Format::Table => chosen.iter().enumerate().try_for_each(|(i, entry)| {
            if i > 0 {
                writeln!(out)?;
            }
            details(out, entry)
        }),
    })
}

fn json(entry: &Entry) -> impl Serialize {
    record! {
        equation: entry.equation,
        title: entry.title,
        section: entry.section,
        statement: entry.statement(),
        latex: entry.latex(),
        hypotheses: entry.format_hypotheses(),
        function: function(entry),
        functions: function_lines(entry)
            .map(|(path, source)| record! { path: path, file: source.file, line: source.line })
            .collect::<Vec<_>>(),
        entry: record! { file: entry.source.file.clone(), line: entry.source.line },
        derivation: derivation(entry),
        follows_from: entry.follows_from.clone(),
        claims: claim_names(entry.equation),
    }
}

/// Returns the first function of an entry.
fn function(entry: &Entry) -> Option<&'static str> {
    entry.functions.first().copied()
}

/// Returns the functions of an entry with their lines in the source.
fn function_lines(entry: &Entry) -> impl Iterator<Item = (&'static str, SourceLine)> {
    entry.functions.iter().map(|path| (*path, function_line(path).unwrap_or_default()))
}

/// Returns the page of the book with the derivation, which is named like the file of the entry except for two.
fn derivation(entry: &Entry) -> String {
    let section = Path::new(&entry.source.file).file_stem().and_then(OsStr::to_str).unwrap_or_default();
    let page = match section {
        "ode" => "convergence",
        "notes" => "loose",
        section => section,
    };
    format!("book/src/{page}.md")
}

fn table(out: &mut dyn Write, entries: &[&Entry]) -> io::Result<()> {
    let rows = entries.iter().map(|entry| {
        let claims = claim_names(entry.equation).len().to_string();
        [entry.label(), entry.title.to_string(), function(entry).unwrap_or("-").to_string(), claims]
    });
    // A broken name cannot be searched for; titles may be broken.
    output::table(out, ["number", "title", "function", "claims"], rows, 1..2)
}

fn details(out: &mut dyn Write, entry: &Entry) -> io::Result<()> {
    writeln!(out, "{} {}, section {}", entry.label(), entry.title, entry.section)?;
    let functions = function_lines(entry).map(|(path, source)| format!("{source} {path}"));
    let mut rows = vec![("states", entry.statement()), ("if", entry.format_hypotheses().join(", "))];
    rows.extend(iter::once("functions").chain(iter::repeat("")).zip(functions));
    rows.extend([
        ("follows from", entry.follows_from.join(", ")),
        ("claims", claim_names(entry.equation).join(", ")),
        ("entry", entry.source.to_string()),
        ("derivation", derivation(entry)),
    ]);
    output::list(out, rows)
}
