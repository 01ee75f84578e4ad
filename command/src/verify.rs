//! `contact verify`: every claim, proved and checked in every number system.

use crate::args;
use crate::output::{self, Exit, Failure, counted, formats};
use spring_mass_contact::claims::entry;
use spring_mass_contact::number::NumberSystem;
use spring_mass_contact::verify::{self, ClaimResult, Status, VerificationReport, claim_names};
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

A case is undecidable if the error bound of a float exceeds the quantity in
question. A claim without a decided case is undecided, which is not a failure;
few cases or a low precision can be the reason.

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
    Json: "For programs: everything"
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

fn exit(report: &VerificationReport) -> Exit {
    Exit::from_result(report.holds())
}

fn print(
    out: &mut dyn Write,
    report: &VerificationReport,
    options: &verify::Options,
    format: Format,
) -> io::Result<()> {
    match format {
        Format::Table => table(out, report, options),
        Format::Json => output::json(out, report),
    }
}

/// Column of the report: a number system, or the prover.
type Column = Option<NumberSystem>;

fn column_name(column: Column) -> String {
    column.map_or("proved".to_string(), |scalar| scalar.to_string())
}

fn table(out: &mut dyn Write, report: &VerificationReport, options: &verify::Options) -> io::Result<()> {
    let scalars = options.scalars.iter().copied().map(Some);
    let columns: Vec<Column> = [None].into_iter().chain(scalars).collect();
    for columns in side_by_side(report, &columns) {
        counts(out, report, columns)?;
        writeln!(out)?;
    }
    for alike in rows_with(report, Status::Failed).chunk_by(|a, b| failure_key(a) == failure_key(b)) {
        failure(out, alike)?;
        writeln!(out)?;
    }
    undecided(out, &rows_with(report, Status::Undecided))?;
    totals(out, report, options)?;
    worst(out, report)?;
    if !report.shared.is_empty() {
        let shared = report.shared.join(", ");
        output::wrapped(out, "", 2, &format!("Every claim that is not proved uses {shared}."))?;
    }
    Ok(())
}

fn rows_with(report: &VerificationReport, status: Status) -> Vec<&ClaimResult> {
    report.rows.iter().filter(|row| row.status == status).collect()
}

fn totals(out: &mut dyn Write, report: &VerificationReport, options: &verify::Options) -> io::Result<()> {
    let summary = report.summary();
    let checked: Vec<_> = report.rows.iter().filter(|row| row.scalar.is_some()).collect();
    let all = counted((summary.claims - checked.len()) as u64, "claim", "claims");
    writeln!(out, "{} of {all} proved for all values.", summary.proved)?;
    writeln!(
        out,
        "{} of {} hold: {} decided, {} undecidable.",
        summary.held,
        counted(checked.len() as u64, "check", "checks"),
        counted(checked.iter().map(|row| row.decided).sum(), "trial", "trials"),
        checked.iter().map(|row| row.undecided).sum::<u64>()
    )?;
    writeln!(out, "{} from seed {}.", counted(options.cases, "case", "cases"), options.seed)
}

/// Prints the largest rounding error relative to its bound.
fn worst(out: &mut dyn Write, report: &VerificationReport) -> io::Result<()> {
    let held = rows_with(report, Status::Held).into_iter();
    let shares = held.filter_map(|row| row.worst.as_ref().map(|(share, _)| (*share, row)));
    let positive = shares.filter(|(share, _)| *share > 0.0);
    positive.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(Ok(()), |(share, row)| {
        let (ClaimResult { equation, claim, .. }, share) = (row, percent(share));
        let scalar = column_name(row.scalar);
        writeln!(out, "Rounding errors: at most {share} of the bound ({equation} {claim}, {scalar}).")
    })
}

/// Formats a fraction in per cent with one decimal, rounded up, since it is an upper bound.
fn percent(share: f64) -> String {
    format!("{} %", (1e3 * share).ceil() / 10.0)
}

/// Width for these columns; the number and the longest word of the title need the rest of a line.
const MAX_COLUMNS_WIDTH: usize = 45;

/// Blanks around a column.
const COLUMN_GAP: usize = 2;

/// Groups columns that fit beside each other.
fn side_by_side<'a>(report: &VerificationReport, columns: &'a [Column]) -> Vec<&'a [Column]> {
    let (mut groups, mut start, mut used) = (Vec::new(), 0, 0);
    for (i, column) in columns.iter().enumerate() {
        let cells = report.by_equation().map(|rows| cell(rows, *column).len());
        let width = cells.chain([column_name(*column).len()]).max().unwrap_or(0) + COLUMN_GAP;
        if used + width > MAX_COLUMNS_WIDTH {
            groups.push(&columns[start..i]);
            (start, used) = (i, 0);
        }
        used += width;
    }
    groups.push(&columns[start..]);
    groups
}

/// Returns the number of claims of an equation that are proved, or that hold in a number system.
fn cell(rows: &[ClaimResult], column: Column) -> String {
    let statuses = rows.iter().filter(|row| row.scalar == column).map(|row| row.status);
    let [failed, undecided] = [Status::Failed, Status::Undecided]
        .map(|status| statuses.clone().filter(|other| *other == status).count());
    match (failed, undecided, statuses.count()) {
        (_, _, 0) => "-".to_string(),
        (0, 0, all) if column.is_none() => all.to_string(),
        (0, 0, all) => format!("{all} held"),
        (0, undecided, _) => format!("{undecided} undecided"),
        (failed, ..) => format!("{failed} FAILED"),
    }
}

/// Prints a line for each equation.
fn counts(out: &mut dyn Write, report: &VerificationReport, columns: &[Column]) -> io::Result<()> {
    let names =
        ["number", "title"].map(String::from).into_iter().chain(columns.iter().copied().map(column_name));
    let rows = report.by_equation().map(|rows| {
        let head = entry(rows[0].equation).map(|entry| [entry.label(), entry.title.to_string()]);
        let cells = columns.iter().map(|column| cell(rows, *column));
        head.unwrap_or_default().into_iter().chain(cells).collect::<Vec<_>>()
    });
    output::table(out, names, rows, 1..2)
}

/// Returns the key that equal failures in different number systems share; their rows are adjacent.
fn failure_key(row: &ClaimResult) -> impl PartialEq {
    (row.equation, row.claim, row.scalar.is_none(), &row.reason, &row.counterexample)
}

/// Prints the undecided claims, one per line, and a remedy.
fn undecided(out: &mut dyn Write, rows: &[&ClaimResult]) -> io::Result<()> {
    for alike in rows.chunk_by(|a, b| (a.equation, a.claim) == (b.equation, b.claim)) {
        let ClaimResult { equation, claim, .. } = alike[0];
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
fn failure(out: &mut dyn Write, alike: &[&ClaimResult]) -> io::Result<()> {
    let row = alike[0];
    let ClaimResult { equation, claim, reason, .. } = row;
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
fn names(rows: &[&ClaimResult]) -> String {
    rows.iter().map(|row| column_name(row.scalar)).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;
