//! `contact verify`: every claim, proved and checked in every number system.

use crate::args;
use crate::output::{self, Exit, Failure, formats};
use spring_mass_contact::claims::entry;
use spring_mass_contact::number::NumberSystem;
use spring_mass_contact::verify::{self, Report, Row, Status, claim_names};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact verify
  contact verify 1.13 'Theorem 1.3.3'
  contact verify --scalar f32 --scalar mpfr:777 --cases 50 --seed 99
  contact verify --format json

Claims about formulas and their rounding errors are proved for all values;
properties of the solver in floats are tested. A claim holds in a number system
if it holds in every decided case, of which there is at least one. Rationals are
compared by equality, floats within the error bounds that balls compute with
them: there are no tolerances.

A claim without a decided case is undecided, which is not a failure; few cases
or a low precision can be the reason.

Exit status: 0 no claim fails; 1 some do; 2 bad input.";

/// Prove every claim of the chapter, and check it in every number system
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these numbers of the chapter: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Number system, repeatable [default: f32, f64, mpfr:256, exact]
    #[arg(long = "scalar", value_name = "S")]
    scalars: Vec<NumberSystem>,
    /// Number of cases for each claim, at least 1
    #[arg(value_parser = args::parse_positive_u64)]
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().cases)]
    cases: u64,
    /// Seed of the cases, which are the same on every machine
    #[arg(value_parser = args::parse_u64)]
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().seed)]
    seed: u64,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

formats!(
    Table: "For reading: one line for each equation",
    Json: "For programs: everything",
    Markdown: "For documents: one line for each claim and number system"
);

/// Verifies and prints the report.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let mut wanted = verify::Options { cases: options.cases, seed: options.seed, ..Default::default() };
    if !options.scalars.is_empty() {
        wanted.scalars = args::distinct(&options.scalars);
    }
    wanted.equations = args::equations(&options.numbers)?;
    if let Some(empty) = wanted.equations.iter().find(|e| claim_names(e).is_empty()) {
        let reason = "it has no claims; `contact equations` lists the number of claims of each";
        return Err(args::invalid(empty, "[NUMBER]...", reason));
    }
    let report = output::with_progress("verifying", |progress| verify::verify(&wanted, progress));
    output::print(|out| print(out, &report, &wanted, options.format))?;
    Ok(exit(&report))
}

fn exit(report: &Report) -> Exit {
    Exit::from_result(report.holds())
}

fn print(out: &mut dyn Write, report: &Report, options: &verify::Options, format: Format) -> io::Result<()> {
    match format {
        Format::Table => table(out, report, options),
        Format::Json => output::json(out, report),
        Format::Markdown => markdown(out, report),
    }
}

/// Column of the report: a number system, or the prover.
type Way = Option<NumberSystem>;

fn name(way: Way) -> String {
    way.map_or("proved".to_string(), |scalar| scalar.to_string())
}

fn table(out: &mut dyn Write, report: &Report, options: &verify::Options) -> io::Result<()> {
    let ways: Vec<Way> = [None].into_iter().chain(options.scalars.iter().copied().map(Some)).collect();
    for ways in side_by_side(report, &ways) {
        counts(out, report, ways)?;
        writeln!(out)?;
    }
    let of = |status| report.rows.iter().filter(move |row| row.status == status);
    let failed: Vec<&Row> = of(Status::Failed).collect();
    for alike in failed.chunk_by(|a, b| fail_alike(a, b)) {
        failure(out, alike)?;
        writeln!(out)?;
    }
    undecided(out, &of(Status::Undecided).collect::<Vec<_>>())?;
    let summary = report.summary();
    let in_numbers = || report.rows.iter().filter(|row| row.scalar.is_some());
    let tried = in_numbers().count();
    let all = counted((summary.claims - tried) as u64, "claim");
    writeln!(out, "{} of {all} proved for all values.", summary.proved)?;
    writeln!(
        out,
        "{} of {} hold: {} decided, {} undecidable.",
        summary.held,
        counted(tried as u64, "claim"),
        counted(in_numbers().map(|row| row.decided).sum(), "trial"),
        in_numbers().map(|row| row.undecided).sum::<u64>()
    )?;
    writeln!(out, "{} from seed {}.", counted(options.cases, "case"), options.seed)?;
    let worst = of(Status::Held).filter_map(|row| row.worst.as_ref().map(|(ratio, _)| (*ratio, row)));
    if let Some((ratio, row)) = worst.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(ratio, _)| *ratio > 0.0) {
        let Row { equation, claim, scalar, .. } = row;
        let share = percent(ratio);
        writeln!(
            out,
            "Rounding errors: at most {share} of the bound ({equation} {claim}, {}).",
            name(*scalar)
        )?;
    }
    if !report.shared.is_empty() {
        let shared = report.shared.join(", ");
        output::wrapped(out, "", 2, &format!("Every claim that is not proved uses {shared}."))?;
    }
    Ok(())
}

/// Formats a fraction in per cent with one decimal, rounded up, since it is an upper bound.
fn percent(share: f64) -> String {
    format!("{} %", (1e3 * share).ceil() / 10.0)
}

fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Width for these columns; the number and the longest word of the title need the rest of a line.
const ROOM: usize = 45;

/// Blanks around a column.
const BLANKS: usize = 2;

/// Groups columns that fit beside each other.
fn side_by_side<'a>(report: &Report, ways: &'a [Way]) -> Vec<&'a [Way]> {
    let width = |way: Way| {
        let cells = report.by_equation().map(|rows| cell(rows, way).len());
        cells.chain([name(way).len()]).max().unwrap_or(0) + BLANKS
    };
    let (mut groups, mut start, mut used) = (Vec::new(), 0, 0);
    for (i, way) in ways.iter().enumerate() {
        let width = width(*way);
        if used + width > ROOM {
            groups.push(&ways[start..i]);
            (start, used) = (i, 0);
        }
        used += width;
    }
    groups.push(&ways[start..]);
    groups
}

/// Returns how many claims of an equation are proved, or hold in a number system.
fn cell(rows: &[Row], way: Way) -> String {
    let rows = || rows.iter().filter(|row| row.scalar == way);
    let count = |status| rows().filter(|row| row.status == status).count();
    match (count(Status::Failed), count(Status::Undecided), rows().count()) {
        (_, _, 0) => "-".to_string(),
        (0, 0, all) if way.is_none() => all.to_string(),
        (0, 0, all) => format!("{all} held"),
        (0, undecided, _) => format!("{undecided} undecided"),
        (failed, ..) => format!("{failed} FAILED"),
    }
}

/// Prints a line for each equation.
fn counts(out: &mut dyn Write, report: &Report, ways: &[Way]) -> io::Result<()> {
    let names = ["number", "title"].map(String::from).into_iter().chain(ways.iter().copied().map(name));
    let rows = report.by_equation().map(|rows| {
        let head = entry(rows[0].equation).map(|entry| [entry.label(), entry.title.to_string()]);
        let cells = ways.iter().map(|way| cell(rows, *way));
        head.unwrap_or_default().into_iter().chain(cells).collect::<Vec<_>>()
    });
    output::table(out, names, rows, 1..2)
}

/// Returns `true` if the same claim fails for the same reason in two number systems; their rows are adjacent.
fn fail_alike(a: &Row, b: &Row) -> bool {
    let key = |row: &Row| (row.equation, row.claim, row.scalar.is_none());
    key(a) == key(b) && (&a.reason, &a.counterexample) == (&b.reason, &b.counterexample)
}

/// Prints the undecided claims, one per line, and a remedy.
fn undecided(out: &mut dyn Write, rows: &[&Row]) -> io::Result<()> {
    for alike in rows.chunk_by(|a, b| (a.equation, a.claim) == (b.equation, b.claim)) {
        let Row { equation, claim, .. } = alike[0];
        output::wrapped(out, "", 2, &format!("{equation} {claim} undecided in {}", names(alike)))?;
    }
    if rows.is_empty() {
        return Ok(());
    }
    const ADVICE: &str = "No case decides these, which is not a failure: try more --cases, or a \
                          --scalar with a higher precision.";
    output::wrapped(out, "  ", 2, ADVICE)?;
    writeln!(out)
}

/// Prints equal failures, at least one.
fn failure(out: &mut dyn Write, alike: &[&Row]) -> io::Result<()> {
    let row = alike[0];
    let Row { equation, claim, reason, .. } = row;
    match row.scalar {
        None => writeln!(out, "{equation} {claim} NOT PROVED")?,
        Some(_) => output::wrapped(out, "", 2, &format!("{equation} {claim} FAILED in {}", names(alike)))?,
    }
    if let Some(reason) = reason {
        output::wrapped(out, "  ", 4, reason)?;
    }
    match row.point() {
        Some(point) => output::wrapped(out, "  ", 2, &output::join_coordinates(&point)),
        None => Ok(()),
    }
}

/// Returns the number systems of rows.
fn names(rows: &[&Row]) -> String {
    rows.iter().map(|row| name(row.scalar)).collect::<Vec<_>>().join(", ")
}

fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let names = ["number", "claim", "kind", "scalar", "status", "decided", "undecided", "worst share"];
    let rows = report.rows.iter().map(|row| {
        let scalar = row.scalar.map_or(String::new(), |scalar| scalar.to_string());
        let worst = row.worst.as_ref().map_or(String::new(), |(ratio, _)| format!("{ratio:.2}"));
        let [equation, claim, kind] = [row.equation, row.claim, row.kind].map(String::from);
        let [decided, undecided] = [row.decided, row.undecided].map(|count| count.to_string());
        [equation, claim, kind, scalar, row.status.to_string(), decided, undecided, worst]
    });
    output::markdown(out, names, rows)
}

#[cfg(test)]
mod tests;
