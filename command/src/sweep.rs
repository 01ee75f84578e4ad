//! `contact sweep`: the penalty method over a range of penalties, in several number systems.

use crate::args::{
    self, NameStyle, Number, System, exact, format_exact, in_scalar, parse_positive, parse_u64_in,
};
use crate::output::{self, Exit, Failure, formats, shortened};
use num_traits::One;
use serde::Serialize;
use spring_mass_contact::chapter::{SpringMass, penalty, rounding, system};
use spring_mass_contact::number::{Exact, ExactText, NumberSystem};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{
    Scalar, SolveError, State, SweepRow, best_penalty, penalties, penalty_force_bound, sweep,
};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact sweep --penalty 1..1e18
  contact sweep --penalty 1..1e18 --points 19 --scalar f32 --scalar f64
  contact sweep --penalty 1/10..1e40 --scalar mpfr:200 --format csv

The errors are relative, |N − R|/R, for the exact contact force R of the rounded
parameters; in JSON they are exact, elsewhere rounded to a few digits. Penalties
are the same numbers in every number system, each rounded once; one that is out
of range ends the command. A row whose results are out of range has an error
instead.

Exit status: 0 success; 1 a row has an error; 2 bad input, or no row has results.";

/// Show the penalty method over a range of penalties, with the exact errors of its two forces
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    system: System,

    /// Range of penalties in N/m, 0 < FROM < TO
    #[arg(long, value_name = "FROM..TO", value_parser = range, help_heading = "Sweep")]
    penalty: (Number, Number),
    /// Number of penalties with both ends, from 2 to 1001, in equal ratios
    #[arg(value_parser = |text: &str| parse_u64_in(2..=1001, text))]
    #[arg(long, value_name = "N", default_value = "61", help_heading = "Sweep")]
    points: u64,

    /// Number system, repeatable: f16, bf16, f32, f64, mpfr:BITS or exact [default: f64]
    #[arg(long = "scalar", value_name = "S", help_heading = "Output")]
    scalars: Vec<NumberSystem>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table, help_heading = "Output")]
    format: Format,
}

formats!(
    Table: "For people: few digits, with notes",
    Json: "All digits, numbers as strings",
    Csv: "The same in rows"
);

/// Name of the option in clap.
const PENALTY: &str = "--penalty <FROM..TO>";

/// Widths of the table's columns: with a blank before each they fit a page.
const WIDTHS: [usize; 7] = [10, 11, 11, 11, 9, 11, 9];

/// Largest number of digits of a quantity in a table, and of an error there and a number in a note.
const DIGITS: usize = 8;
const SHORT_DIGITS: usize = 3;

/// Number of digits of an error in CSV, for plots.
const ERROR_DIGITS: usize = 6;

/// Parses a range of two numbers.
fn range(text: &str) -> Result<(Number, Number), String> {
    if text.contains("...") {
        return Err("must be FROM..TO with two dots, not three, such as 1..1e12".to_string());
    }
    let (from, to) = text.split_once("..").ok_or("must be FROM..TO, such as 1..1e12")?;
    let (from, to) = (end_of_range("FROM", from)?, end_of_range("TO", to)?);
    if from.value < to.value { Ok((from, to)) } else { Err("FROM must be less than TO".to_string()) }
}

fn end_of_range(name: &str, text: &str) -> Result<Number, String> {
    parse_positive(text).map_err(|error| format!("{name} '{}': {error}", shortened(text)))
}

/// Sweeps and prints the rows.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    // Computed before a line is printed, so that an error leaves no incomplete table.
    let sweeps = output::with_progress("sweeping", |progress| sweeps(options, progress))?;
    let rows: Vec<_> = sweeps.iter().flat_map(|sweep| &sweep.rows).collect();
    output::print(|out| match options.format {
        Format::Table => table(out, options, &sweeps),
        Format::Json => output::json(out, &rows),
        Format::Csv => output::csv(out, &rows),
    })?;
    Ok(Exit::from_result(rows.iter().all(|row| row.error.is_none())))
}

/// Sweeps in each number system, and reports the number of finished rows of all.
fn sweeps(options: &Options, progress: &dyn Fn(usize, usize)) -> Result<Vec<Sweep>, Failure> {
    let penalties = penalty_values(options)?;
    let scalars = args::distinct(&options.scalars);
    let scalars = if scalars.is_empty() { vec![NumberSystem::F64] } else { scalars };
    let rows = scalars.len() * penalties.len();
    let mut sweeps = Vec::new();
    for scalar in scalars {
        let finished = sweeps.len() * penalties.len();
        let sweeping = Sweeping { options, penalties: &penalties, scalar };
        sweeps.push(in_scalar!(scalar, |like| sweeping.run(like, |row| progress(finished + row, rows)))?);
    }
    Ok(sweeps)
}

/// Returns the penalties of the range.
fn penalty_values(options: &Options) -> Result<Vec<Number>, Failure> {
    let (from, to) = &options.penalty;
    let values = penalties(&from.value, &to.value, options.points as u32).map_err(|error| {
        let allowed = match error {
            SolveError::Invalid { argument, allowed, .. } => format!("the {argument} must be {allowed}"),
            other => other.to_string(),
        };
        args::invalid(&format!("{}..{}", from.text, to.text), PENALTY, allowed)
    })?;
    Ok(values.into_iter().map(|value| Number { text: format_exact(&value), value }).collect())
}

/// Formatted rows of one number system, with notes.
struct Sweep {
    scalar: NumberSystem,
    rows: Vec<Row>,
    notes: Vec<String>,
}

/// Results for one penalty, or the error.
#[derive(Default, Serialize)]
struct Row {
    scalar: String,
    penalty: String,
    deflection: Option<String>,
    penetration: Option<String>,
    contact_force: Option<String>,
    penalty_force: Option<String>,
    force_error: Option<String>,
    penalty_force_error: Option<String>,
    error: Option<String>,
}

/// A sweep in one number system.
struct Sweeping<'a> {
    options: &'a Options,
    penalties: &'a [Number],
    scalar: NumberSystem,
}

impl Sweeping<'_> {
    fn run<T: Scalar + ExactText>(&self, like: &T, each: impl Fn(usize)) -> Result<Sweep, Failure> {
        let system = self.options.system.round(NameStyle::Options, like)?;
        let rounded: Vec<T> =
            self.penalties.iter().map(|eps| eps.round(PENALTY, like)).collect::<Result<_, _>>()?;
        let mut rows = Vec::new();
        let mut first_error = None;
        let mut least: Option<(Exact, &str)> = None;
        for ((i, row), eps) in (1..).zip(sweep(&system, rounded.iter().cloned())).zip(self.penalties) {
            match &row {
                Ok(row) => {
                    if let Some(error) = &row.penalty_force_error
                        && least.as_ref().is_none_or(|(least, _)| error < least)
                    {
                        least = Some((error.clone(), &eps.text));
                    }
                }
                Err(error) => {
                    let at = format!("--scalar {}, --penalty {}", self.scalar, shortened(&eps.text));
                    first_error.get_or_insert(format!("{at}: {error}"));
                }
            }
            rows.push(self.row(eps, row));
            each(i);
        }
        match first_error {
            // An error in every row is an error of the system.
            Some(error) if rows.iter().all(|row: &Row| row.error.is_some()) => Err(error.into()),
            _ => {
                let notes = self.notes(&system, &rounded, least);
                Ok(Sweep { scalar: self.scalar, rows, notes })
            }
        }
    }

    /// Returns a formatted row: within the width of a column for tables, otherwise in full.
    fn row<T: ExactText>(&self, eps: &Number, row: Result<SweepRow<T>, SolveError>) -> Row {
        let format = self.options.format;
        let [width, u, p, force, force_error, penalty_force, penalty_force_error] = WIDTHS;
        let in_table = format == Format::Table;
        let penalty = if in_table { eps.value.decimal_within(DIGITS, width) } else { eps.text.clone() };
        let head = Row { scalar: self.scalar.to_string(), penalty, ..Row::default() };
        match row {
            Err(error) => Row { error: Some(error.to_string()), ..head },
            Ok(row) => Row {
                deflection: Some(format.quantity(&row.deflection, u)),
                penetration: Some(format.quantity(&row.penetration, p)),
                contact_force: Some(format.quantity(&row.contact_force, force)),
                penalty_force: row.penalty_force.as_ref().map(|x| format.quantity(x, penalty_force)),
                force_error: format.error(row.force_error.as_ref(), force_error),
                penalty_force_error: format.error(row.penalty_force_error.as_ref(), penalty_force_error),
                ..head
            },
        }
    }

    /// Describes the errors: their source, the least one, the best penalty and the end of augmentations.
    fn notes<T: Scalar + ExactText>(
        &self,
        system: &SpringMass<T>,
        penalties: &[T],
        least: Option<(Exact, &str)>,
    ) -> Vec<String> {
        let Some((least, at)) = least else {
            let reason = match State::of(system) {
                Ok(State::Separated) => "The mass is separated from the plane, so there is no force ε p.",
                _ => "Grazing: the contact force is 0, so there are no relative errors.",
            };
            return vec![reason.to_string()];
        };
        let reaction = system::reaction(&system.as_ref().map(exact));
        let stiffness = format!(
            "R = {} N for the rounded parameters, of which the spring carries c/(c + ε): from \
             ε = c = {} N/m on this error decreases like 1/ε, with the slope −1.",
            format_short(&reaction),
            format_short(&exact(&system.c)),
        );
        if self.scalar == NumberSystem::Exact {
            return vec![stiffness, "Rationals do not round: there is no other error.".to_string()];
        }
        let eta = self.scalar.unit_roundoff();
        let best = best_penalty_note(system, &eta);
        let least =
            format!("The smallest error here is {} at ε = {} N/m.", format_short(&least), shortened(at));
        let force = "m g − c u has no optimum: its error decreases to the level of rounding and stays there.";
        let notes = [stiffness, format!("{best} {least}"), force.to_string()];
        notes.into_iter().chain(augmentation_note(system, penalties, &eta)).collect()
    }
}

impl Format {
    /// Formats a quantity, in a table within a width.
    fn quantity<T: ExactText>(self, x: &T, width: usize) -> String {
        if self == Format::Table { exact(x).decimal_within(DIGITS, width) } else { x.text() }
    }

    /// Formats an error, in a table within a width.
    fn error(self, x: Option<&Exact>, width: usize) -> Option<String> {
        x.map(|x| match self {
            Format::Table => x.decimal_within(SHORT_DIGITS, width),
            Format::Json => x.text(),
            Format::Csv => x.decimal(ERROR_DIGITS, Round::Nearest),
        })
    }
}

fn format_short(x: &Exact) -> String {
    x.decimal(SHORT_DIGITS, Round::Nearest)
}

/// Describes the penalty with the best bound of ε p.
fn best_penalty_note<T: Scalar + ExactText>(system: &SpringMass<T>, eta: &Exact) -> String {
    match best_penalty(system, eta) {
        Ok(Some(best)) => {
            let bound = penalty_force_bound(system, &best, eta).ok().flatten();
            let (best, bound) =
                (format_short(&exact(&best)), bound.as_ref().map_or(String::new(), format_short));
            format!(
                "ε p amplifies the rounding error of p: the best bound is that of ε = {best} N/m, where ε p \
                 is within {bound} of R."
            )
        }
        Ok(None) if system.h.is_zero() && system.l.is_zero() => {
            "With H = l = 0 rounding does not limit the accuracy of ε p.".to_string()
        }
        Ok(None) => "Rounding dominates ε p before the penalty is stiff, so no ε is best.".to_string(),
        Err(_) => "The ε with the best bound of ε p is out of the range of this scalar.".to_string(),
    }
}

/// Describes the floors with the smallest and the largest penalty for which there is something to augment:
/// the penetration by penalty is greater than the floor.
fn augmentation_note<T: ExactText>(system: &SpringMass<T>, penalties: &[T], eta: &Exact) -> Option<String> {
    let (s, n) = (system.as_ref().map(exact), Exact::one() / eta);
    let floors = penalties.iter().map(exact).map(|eps| (rounding::floor_scale(&s, &eps, &n), eps));
    let floors: Vec<_> = floors.filter(|(floor, eps)| *floor < penalty::penetration(&s, eps)).collect();
    let (first, last) = (floors.first()?, floors.last()?);
    let [mut stops, stop] = [first, last]
        .map(|(floor, eps)| format!("{} m with ε = {} N/m", format_short(floor), format_short(eps)));
    if first != last {
        stops += &format!(", {stop}");
    }
    Some(format!(
        "An augmentation stops at a penetration of about η (|H| + |H − l| + R/ε), with the largest relative \
         rounding error η: {stops}."
    ))
}

fn table(out: &mut dyn Write, options: &Options, sweeps: &[Sweep]) -> io::Result<()> {
    const NAMES: [&str; 7] = ["ε in N/m", "u in m", "p in m", "m g − c u", "error", "ε p in N", "error"];
    output::wrapped(out, " ", 1, &options.system.shown())?;
    for Sweep { scalar, rows, notes } in sweeps {
        writeln!(out, "\n {scalar}\n{}", output::aligned(&WIDTHS, NAMES))?;
        for row in rows {
            let Row { penalty, deflection, penetration, contact_force, penalty_force, .. } = row;
            let forces = [contact_force, &row.force_error, penalty_force, &row.penalty_force_error];
            let cells = [deflection, penetration].into_iter().chain(forces);
            let cells = cells.map(|cell| cell.as_deref().unwrap_or("–"));
            let results = match &row.error {
                // It fits the page without its remedy, which is printed below.
                Some(error) => format!(" {}", error.split("; ").next().unwrap_or_default()),
                None => output::aligned(&WIDTHS[1..], cells),
            };
            writeln!(out, " {penalty:<width$}{results}", width = WIDTHS[0])?;
        }
        writeln!(out)?;
        if rows.iter().any(|row| row.error.is_some()) {
            let help = "If a result is out of range, use MPFR (mpfr:BITS) or exact rationals.";
            output::wrapped(out, " ", 1, help)?;
        }
        notes.iter().try_for_each(|note| output::wrapped(out, " ", 1, note))?;
    }
    writeln!(out, "\n At most eight digits each; --format csv has all.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Args, FromArgMatches};
    use std::cell::RefCell;

    fn options(line: &str) -> Options {
        let command = Options::augment_args(clap::Command::new("sweep"));
        Options::from_arg_matches(&command.get_matches_from(line.split(' '))).expect("options")
    }

    /// Over all rows of all number systems.
    #[test]
    fn progress_is_counted_in_rows() {
        let seen = RefCell::new(Vec::new());
        let options = options("sweep --penalty 1..9 --points 5 --scalar f32 --scalar f64 --scalar f32");
        assert!(sweeps(&options, &|row, of| seen.borrow_mut().push((row, of))).is_ok());
        assert_eq!(seen.into_inner(), (1..=10).map(|row| (row, 10)).collect::<Vec<_>>());
    }
}
