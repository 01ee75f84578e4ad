//! `contact equations`: the chapter as data.

use crate::args;
use crate::output::{self, Exit, Failure};
use clap::ValueEnum;
use spring_mass_contact::claims::{Entry, claim_names, entries};
use spring_mass_contact::verify::graph;
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact equations
  contact equations 1.13 'Theorem 1.3.3' 'note 4'
  contact equations --format json
  contact equations --format dot | dot -Tsvg > chapter.svg";

/// List what the chapter states: each number, its function and its claims
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these, with their statements: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
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
    /// For Graphviz: what follows from what, and what is proved
    Dot,
}

/// Prints the entries asked for.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let numbers = args::equations(&options.numbers)?;
    let all = numbers.is_empty();
    let chosen: Vec<&'static Entry> =
        entries().iter().filter(|e| all || numbers.iter().any(|n| n == e.equation)).collect();
    output::print(|out| match options.format {
        Format::Json => output::json(out, &chosen),
        Format::Markdown => markdown(out, &chosen),
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

/// Its own function, without those beside it.
fn function(entry: &Entry) -> Option<&'static str> {
    entry.functions.first().copied()
}

fn table(out: &mut dyn Write, entries: &[&Entry]) -> io::Result<()> {
    let mut table = output::table();
    table.set_header(["number", "title", "function", "claims"]);
    for entry in entries {
        let claims = claim_names(entry.equation).len().to_string();
        table.add_row([&entry.label(), entry.title, function(entry).unwrap_or("-"), &claims]);
    }
    // A name that is broken cannot be searched for; titles break well.
    output::unbroken(&mut table, &[0, 2, 3]);
    output::lines(out, &table)
}

fn markdown(out: &mut dyn Write, entries: &[&Entry]) -> io::Result<()> {
    writeln!(out, "| number | title | statement | hypotheses | function | claims |")?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    entries.iter().try_for_each(|e| {
        let function = function(e).map_or(String::new(), |f| format!("`{f}`"));
        let (hypotheses, claims) = (e.format_hypotheses().join(", "), claim_names(e.equation).join(", "));
        let statement = e.statement().replace('|', "\\|");
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
    line("states", entry.statement());
    line("if", entry.format_hypotheses().join(", "));
    line("functions", entry.functions.join(", "));
    line("follows from", entry.follows_from.join(", "));
    line("claims", claim_names(entry.equation).join(", "));
    output::lines(out, &table)
}
