//! `contact verify`: every claim in every number system, as one table.

use crate::args;
use crate::output::{self, Failure, Status};
use crate::text;
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use spring_mass_contact::claims::{Case, Entry, Var, claim_names, entries};
use spring_mass_contact::number::{Exact, NumberSystem};
use spring_mass_contact::verify::{self, Report, Row, command_line};
use std::collections::BTreeMap;
use std::io::{self, IsTerminal, Write};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

const EXAMPLES: &str = "\
Examples:
  contact verify
  contact verify --equation 1.13 --equation 'Theorem 1.3.3'
  contact verify --scalar f32 --scalar mpfr:777 --cases 50 --seed 99
  contact verify --format json

A claim holds in a number system if it does in every case that can be decided
there, and at least one can. Rationals are compared by equality, floats within
the error bounds that balls compute along the way: there are no tolerances.

Exit status: 0 all hold; 1 some do not; 2 bad input.";

/// Check every claim of the chapter in every number system
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Number system, repeatable [default: f32, f64, mpfr:256, exact]
    #[arg(long = "scalar", value_name = "S")]
    scalars: Vec<NumberSystem>,
    /// Cases to try a claim on, at least 1
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().cases, value_parser = args::count)]
    cases: u64,
    /// Where the cases are drawn from; the same seed, the same cases, on every machine
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().seed, value_parser = args::whole)]
    seed: u64,
    /// Only this number of the chapter, repeatable: 1.13, 'note 4', …
    #[arg(long = "equation", value_name = "NUMBER", value_parser = args::equation)]
    equations: Vec<String>,
    /// How to print the report
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// What `contact` alone does.
impl Default for Options {
    fn default() -> Self {
        let verify::Options { cases, seed, .. } = verify::Options::default();
        Options { scalars: Vec::new(), cases, seed, equations: Vec::new(), format: Format::Table }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For reading: a line an equation
    Table,
    /// For programs: everything
    Json,
    /// For documents: a line a claim and number system
    Markdown,
}

/// Verifies and reports.
pub fn run(options: &Options) -> Result<Status, Failure> {
    let mut wanted = verify::Options { cases: options.cases, seed: options.seed, ..Default::default() };
    if !options.scalars.is_empty() {
        wanted.scalars.clear();
        for scalar in &options.scalars {
            if !wanted.scalars.contains(scalar) {
                wanted.scalars.push(*scalar);
            }
        }
    }
    wanted.equations.clone_from(&options.equations);
    if let Some(empty) = wanted.equations.iter().find(|e| claim_names(e).is_empty()) {
        return Err(
            format!("invalid value '{empty}' for '--equation <NUMBER>': nothing is claimed of it").into()
        );
    }
    let report = with_progress(|progress| verify::verify(&wanted, progress));
    output::print(|out| match options.format {
        Format::Table => table(out, &report, &wanted),
        Format::Json => output::json(out, &Json::of(&report)),
        Format::Markdown => markdown(out, &report),
    })?;
    Ok(if report.holds() { Status::Fine } else { Status::Unmet })
}

/// A bar on stderr if that is a terminal and the work takes longer than a second.
fn with_progress<T>(work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T) -> T {
    let (start, visible) = (Instant::now(), io::stderr().is_terminal());
    let bar: OnceLock<ProgressBar> = OnceLock::new();
    let result = work(&|done, of| {
        if visible && start.elapsed() > Duration::from_secs(1) {
            let style = ProgressStyle::with_template("verifying {bar:40} {percent:>3} %");
            let new =
                || ProgressBar::new(of as u64).with_style(style.unwrap_or(ProgressStyle::default_bar()));
            bar.get_or_init(new).set_position(done as u64);
        }
    });
    if let Some(bar) = bar.get() {
        bar.finish_and_clear();
    }
    result
}

fn rows_of<'a>(report: &'a Report, entry: &Entry) -> Vec<&'a Row> {
    report.rows.iter().filter(|row| row.equation == entry.equation).collect()
}

fn held(rows: &[&Row]) -> usize {
    rows.iter().filter(|row| row.status == verify::Status::Held).count()
}

fn table(out: &mut dyn Write, report: &Report, options: &verify::Options) -> io::Result<()> {
    let mut table = output::table();
    let scalars = options.scalars.iter().map(ToString::to_string);
    table.set_header(["number", "title"].map(String::from).into_iter().chain(scalars));
    for entry in entries() {
        let rows = rows_of(report, entry);
        if rows.is_empty() {
            continue;
        }
        let cell = |scalar: &NumberSystem| {
            let rows: Vec<&Row> = rows.iter().copied().filter(|row| row.scalar == *scalar).collect();
            match (held(&rows), rows.len()) {
                (_, 0) => "-".to_string(),
                (held, all) if held == all => format!("{all} held"),
                (held, all) => format!("{} of {all} FAILED", all - held),
            }
        };
        table.add_row(
            [entry.label(), entry.title.to_string()].into_iter().chain(options.scalars.iter().map(cell)),
        );
    }
    output::lines(out, &table)?;
    let rows: Vec<&Row> = report.rows.iter().collect();
    for row in rows.iter().filter(|row| row.status == verify::Status::Failed) {
        failure(out, row)?;
    }
    let (held, decided) = (held(&rows), rows.iter().map(|row| row.decided).sum::<u64>());
    let undecided = rows.iter().map(|row| row.undecided).sum::<u64>();
    writeln!(out)?;
    writeln!(
        out,
        "{held} of {} claims hold: {decided} trials decided, {undecided} undecidable.",
        rows.len()
    )?;
    writeln!(out, "{} cases from seed {}.", options.cases, options.seed)?;
    let worst = rows.iter().filter_map(|row| row.worst.as_ref().map(|(ratio, _)| (*ratio, row)));
    if let Some((ratio, row)) = worst.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(ratio, _)| *ratio > 0.0) {
        let share = 100.0 * ratio;
        writeln!(
            out,
            "Rounding used at most {share:.0} % of its bound ({} {}, {}).",
            row.equation, row.claim, row.scalar
        )?;
    }
    Ok(())
}

fn failure(out: &mut dyn Write, row: &Row) -> io::Result<()> {
    writeln!(out, "\n{} {} FAILED in {}", row.equation, row.claim, row.scalar)?;
    match &row.counterexample {
        None => writeln!(out, "  none of {} cases could be decided", row.undecided),
        Some(case) => {
            let numbers = symbols(case).into_iter().map(|(symbol, value)| format!("{symbol} = {value}"));
            writeln!(out, "  {}", numbers.collect::<Vec<_>>().join(", "))?;
            command_line(case).map_or(Ok(()), |line| writeln!(out, "  {line}"))
        }
    }
}

fn symbols(case: &Case<Exact>) -> Vec<(&'static str, String)> {
    Var::ALL.iter().map(|var| (var.symbol(), case.get(*var).to_string())).collect()
}

fn status(row: &Row) -> &'static str {
    if row.status == verify::Status::Held { "held" } else { "failed" }
}

fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(out, "| number | claim | kind | scalar | status | decided | undecided | worst share |")?;
    writeln!(out, "|---|---|---|---|---|---|---|---|")?;
    report.rows.iter().try_for_each(|row| {
        let worst = row.worst.as_ref().map_or(String::new(), |(ratio, _)| format!("{ratio:.2}"));
        let (status, decided, undecided) = (status(row), row.decided, row.undecided);
        writeln!(
            out,
            "| {} | {} | {} | {} | {status} | {decided} | {undecided} | {worst} |",
            row.equation, row.claim, row.kind, row.scalar
        )
    })
}

#[derive(Serialize)]
struct Json {
    summary: Summary,
    equations: Vec<Equation>,
}

#[derive(Serialize)]
struct Summary {
    claims: usize,
    held: usize,
    failed: usize,
}

#[derive(Serialize)]
struct Equation {
    equation: &'static str,
    claims: Vec<Claim>,
}

#[derive(Serialize)]
struct Claim {
    claim: &'static str,
    kind: &'static str,
    status: &'static str,
    scalar: String,
    decided: u64,
    undecided: u64,
    worst: Option<String>,
    bound: Option<String>,
    counterexample: Option<BTreeMap<&'static str, String>>,
}

impl Json {
    fn of(report: &Report) -> Self {
        let rows: Vec<&Row> = report.rows.iter().collect();
        let held = held(&rows);
        let equation = |entry: &Entry| Equation {
            equation: entry.equation,
            claims: rows_of(report, entry).into_iter().map(Claim::of).collect(),
        };
        let equations = entries().iter().map(equation).filter(|e| !e.claims.is_empty()).collect();
        Json { summary: Summary { claims: rows.len(), held, failed: rows.len() - held }, equations }
    }
}

impl Claim {
    fn of(row: &Row) -> Self {
        Claim {
            claim: row.claim,
            kind: row.kind,
            status: status(row),
            scalar: row.scalar.to_string(),
            decided: row.decided,
            undecided: row.undecided,
            worst: row.worst.as_ref().map(|(ratio, _)| text::Number::text(ratio)),
            bound: row.worst.as_ref().map(|(_, bound)| bound.clone()),
            counterexample: row.counterexample.as_ref().map(|case| symbols(case).into_iter().collect()),
        }
    }
}
