//! `contact check`: compares an external solver with exact solutions.

mod answers;
mod json;
mod program;
pub mod reply;
mod report;

use crate::args::{Number, parse_positive};
use crate::cases::Selection;
use crate::output::{self, Exit, Failure, formats};
use program::{Program, end_with_signals};
use spring_mass_contact::check::{Problem, Report, check, check_table};
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  contact check -- python3 my_adapter.py
  contact check --family stiff --cases 50 -- ./my_solver --tolerance 1e-9
  contact check --format json -- python3 examples/adapter.py
  contact check --answers sheet.csv

The program is started once. It reads a line from stdin, such as
  {\"id\": \"contact-1\", \"stiffness\": 100, \"mass\": 1, \"gravity\": 9.81,
   \"free_length\": 1, \"height\": 1.05}
(without the line break), and answers with a line on stdout, flushed, before it
receives the next one:
  {\"id\": \"contact-1\", \"deflection\": 0.05, \"contact_force\": 4.81}
All quantities are in SI units. The deflection is measured downwards from the
undeformed spring; height is that of the support above the plane, which pushes
with the contact force or not at all. A negative gravity acts upwards. The error
of u is relative to |H - l| + |m g/c|, that of N to |m g| + |c (H - l)|. The
page `Check your own solver` of the book (book/src/check.md) lists the optional
keys of an answer, the families and the mistakes that are diagnosed.

With --answers the answers are in a table, with columns named as the keys are.
The ids are those of `contact cases`, whose --blank prints a sheet to fill in; a
row with all five parameters is judged by these, whatever its id.

Exit status: 0 if no answer is wrong and each family has one that is right or
within the tolerance; 1 otherwise; 2 for bad input. A refusal,
{\"id\": …, \"error\": …}, is not wrong.";

/// Check an external solver against exact solutions, and diagnose its mistakes
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    drawn: Selection,
    /// Largest relative error of an answer (u relative to |H - l| + |m g/c|, N to |m g| + |c (H - l)|)
    #[arg(long, value_name = "T", default_value = "1e-6", value_parser = parse_positive)]
    tolerance: Number,
    /// Time limit for an answer in s, from 0.001 to 1000000
    #[arg(long, value_name = "S", default_value = "10", value_parser = seconds, conflicts_with = "answers")]
    timeout: Duration,
    /// Check the penalty method with this ε in N/m; the exact solutions are then those of this method
    #[arg(long, value_name = "E", value_parser = parse_positive)]
    penalty: Option<Number>,
    /// Check a table in place of a program: CSV or JSON lines with id, deflection and contact_force; - is stdin
    #[arg(long, value_name = "FILE", conflicts_with = "program")]
    answers: Option<String>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Program with its arguments; it is started without a shell
    #[arg(last = true, required_unless_present = "answers", num_args = 1.., value_names = ["PROGRAM", "ARG"])]
    program: Vec<String>,
}

formats!(
    Table: "For people",
    Json: "Everything; quantities as strings",
    Markdown: "For documents: one line for each family"
);

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| (1e-3..=1e6).contains(seconds));
    let seconds = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.ok_or_else(|| "must be a number of seconds from 0.001 to 1000000".to_string())
}

/// What is checked.
struct Subject {
    /// `program` or `answers`.
    kind: &'static str,
    name: String,
    /// The systems without a row.
    missing: Vec<Problem>,
}

/// Checks the program or the table, and prints the report.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let mut problems = options.drawn.problems();
    for problem in &mut problems {
        problem.penalty = options.penalty.as_ref().map(|penalty| penalty.value.clone());
    }
    let (subject, report) = match &options.answers {
        Some(path) => {
            let (answers, missing) = answers::read(path, problems)?;
            let report = check_table(answers, &options.tolerance.value);
            (Subject { kind: "answers", name: reply::words(path), missing }, report)
        }
        None => {
            let program = shlex::try_join(options.program.iter().map(String::as_str));
            let name = reply::words(&program.map_err(|error| format!("the program's words: {error}"))?);
            (Subject { kind: "program", name, missing: Vec::new() }, ask(options, &problems)?)
        }
    };
    output::print(|out| match options.format {
        Format::Table => report::table(out, &subject, &report, &options.tolerance),
        Format::Json => output::json(out, &json::report(&subject, options, &report)),
        Format::Markdown => report::markdown(out, &report),
    })?;
    let is_answered = |missing: &Problem| report.families().iter().any(|row| row.family == missing.family);
    Ok(Exit::from_result(report.holds() && subject.missing.iter().all(is_answered)))
}

/// Passes the problems to the program.
fn ask(options: &Options, problems: &[Problem]) -> Result<Report, Failure> {
    end_with_signals().map_err(|error| format!("signals cannot be handled: {error}"))?;
    output::with_progress("checking", |progress| {
        let mut program = Program::new(&options.program, options.timeout);
        let mut count = 0;
        check(problems, &options.tolerance.value, |problem| {
            count += 1;
            progress(count, problems.len());
            program.ask(problem)
        })
    })
}
