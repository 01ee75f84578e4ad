//! `contact equations`: the chapter as data.

use crate::args;
use crate::output::{self, Failure, Status};
use clap::ValueEnum;
use serde::Serialize;
use spring_mass_contact::claims::{Entry, claim_names, entries};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact equations
  contact equations 1.13 'Theorem 1.3.3' 'note 4'
  contact equations --format json";

/// List what the chapter states: each number, its function and its claims
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these, with their statements: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER", value_parser = args::equation)]
    numbers: Vec<String>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For reading
    Table,
    /// For programs
    Json,
    /// For documents
    Markdown,
}

#[derive(Serialize)]
struct Row {
    equation: &'static str,
    title: &'static str,
    section: &'static str,
    statement: &'static str,
    hypotheses: &'static [&'static str],
    function: Option<&'static str>,
    follows_from: &'static [&'static str],
    claims: Vec<&'static str>,
}

/// Prints the entries asked for.
pub fn run(options: &Options) -> Result<Status, Failure> {
    let all = options.numbers.is_empty();
    let chosen: Vec<&Entry> =
        entries().iter().filter(|e| all || options.numbers.iter().any(|n| n == e.equation)).collect();
    output::print(|out| match options.format {
        Format::Json => output::json(out, &chosen.iter().map(|e| row(e)).collect::<Vec<_>>()),
        Format::Markdown => markdown(out, &chosen),
        Format::Table if all => table(out, &chosen),
        Format::Table => chosen.iter().enumerate().try_for_each(|(i, entry)| {
            if i > 0 {
                writeln!(out)?;
            }
            details(out, entry)
        }),
    })
}

fn row(entry: &Entry) -> Row {
    let Entry { equation, title, section, statement, hypotheses, function, follows_from } = *entry;
    Row {
        equation,
        title,
        section,
        statement,
        hypotheses,
        function,
        follows_from,
        claims: claim_names(equation),
    }
}

fn table(out: &mut dyn Write, entries: &[&Entry]) -> io::Result<()> {
    let mut table = output::table();
    table.set_header(["number", "title", "function", "claims"]);
    for entry in entries {
        let claims = claim_names(entry.equation).len().to_string();
        table.add_row([&entry.label(), entry.title, entry.function.unwrap_or("-"), &claims]);
    }
    // A name that is broken cannot be searched for; titles break well.
    output::unbroken(&mut table, &[0, 2, 3]);
    output::lines(out, &table)
}

fn markdown(out: &mut dyn Write, entries: &[&Entry]) -> io::Result<()> {
    writeln!(out, "| number | title | statement | hypotheses | function | claims |")?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    entries.iter().try_for_each(|e| {
        let function = e.function.map_or(String::new(), |f| format!("`{f}`"));
        let (hypotheses, claims) = (e.hypotheses.join(", "), claim_names(e.equation).join(", "));
        let statement = e.statement.replace('|', "\\|");
        writeln!(out, "| {} | {} | {statement} | {hypotheses} | {function} | {claims} |", e.label(), e.title)
    })
}

fn details(out: &mut dyn Write, entry: &Entry) -> io::Result<()> {
    writeln!(out, "{} {}, section {}", entry.label(), entry.title, entry.section)?;
    let mut table = output::table();
    let mut line = |name: &str, text: String| {
        if !text.is_empty() {
            table.add_row([name, &text]);
        }
    };
    line("states", entry.statement.to_string());
    line("if", entry.hypotheses.join(", "));
    line("function", entry.function.map_or(String::new(), |f| format!("spring_mass_contact::chapter::{f}")));
    line("follows from", entry.follows_from.join(", "));
    line("claims", claim_names(entry.equation).join(", "));
    output::lines(out, &table)
}
