//! `contact solve`: its options, and from them to a solution in the scalar that was asked for.

mod batch;
mod report;

use crate::args::{Names, Number, System, in_scalar, parse_number, parse_positive, parse_u64};
use crate::output::{self, Exit, Failure, formats, shortened};
use clap::ValueEnum;
use num_traits::Zero;
use report::Report;
pub use report::{rounded_in_words, state_in_words};
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, NumberSystem, Text};
use spring_mass_contact::proof::refute::Point;
use spring_mass_contact::rug::Integer;
use spring_mass_contact::solver::{
    Augmentation, Iterate, MAX_AUGMENTATIONS, Method, Outcome, Plane, Scalar, Solution, SolveError,
    augmentations_needed, solve_observed,
};
use spring_mass_contact::verify::reproduction;
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact solve
      The default system by Lagrange multiplier: in contact, with 4.81 N.
  contact solve --method penalty --penalty 1000 --scalar exact
  contact solve --method augmented --tolerance 1e-30 --scalar mpfr:200 --trace
  contact solve --gravity -9.81 --height 21/20 --format json
  echo '{\"id\": 7, \"height\": 1.09}' | contact solve --batch

A number is a decimal (0.05), scientific (5e-2) or a fraction (1/20), read
exactly and rounded once into the scalar. In the table, exact: and limit: say
where the exact answer lies, for the parameters as rounded: by augmentation that
is the limit of its steps. JSON calls that bounds. An augmentation in rationals,
which become longer with every step, is refused where a multiplier would have
more than 2²² binary digits, or all of them together 2²⁸.

With --batch a line of stdin is a JSON object. Its keys are the long options
with underscores (free_length), and id, which comes back; options given here
are for the lines that do not say otherwise. The answers keep the order of the
lines, and wait for no line that has not come. Each is what --format json
prints, or has an error.

Exit status: 0 all well; 1 a solve did not converge, its result is printed all
the same, or a line of a batch is an error; 2 bad input.";

/// Solve one system, with rigorous bounds and the residuals of the contact conditions
#[derive(clap::Args, Clone)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    system: System,

    /// How to enforce the contact
    #[arg(long, value_enum, default_value_t = MethodName::Lagrange, help_heading = "Method")]
    method: MethodName,
    /// Penalty parameter in N/m, ε > 0, for penalty and augmented [default for augmented: 10 c]
    #[arg(long, value_name = "E", value_parser = parse_positive, help_heading = "Method")]
    penalty: Option<Number>,
    /// How far the deflection may be off in m, for augmented [default: 1e-9]
    #[arg(long, value_name = "T", value_parser = parse_positive, help_heading = "Method")]
    tolerance: Option<Number>,
    /// The last augmentation to try, for augmented [default: 1000]
    #[arg(long, value_name = "N", value_parser = parse_u64, help_heading = "Method")]
    max_augmentations: Option<u64>,
    /// Multiplier to start from in N, for augmented [default: 0]
    #[arg(long, value_name = "L", value_parser = parse_number, help_heading = "Method")]
    initial_multiplier: Option<Number>,
    /// Let the plane pull as well, as the chapter prints its equations
    #[arg(long, help_heading = "Method")]
    bilateral: bool,

    /// Number system: f32, f64, mpfr:BITS or exact
    #[arg(long, value_name = "S", default_value_t = NumberSystem::F64, help_heading = "Output")]
    scalar: NumberSystem,
    /// Show every augmentation, for augmented; as csv, these rows alone
    #[arg(long, help_heading = "Output")]
    trace: bool,
    /// How to print the result
    #[arg(long, value_enum, default_value_t = Format::Table, help_heading = "Output")]
    format: Format,
    /// Solve many systems: JSON objects from stdin, a line each, and a line for each
    #[arg(long, conflicts_with_all = ["trace", "format"], help_heading = "Output")]
    batch: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// §1.3.1: exact
    Lagrange,
    /// §1.3.2: a second spring of stiffness ε
    Penalty,
    /// §1.3.3: penalty, repeated with a growing multiplier
    Augmented,
}

impl MethodName {
    /// Of a method.
    pub fn of<T>(method: &Method<T>) -> Self {
        match method {
            Method::Lagrange => MethodName::Lagrange,
            Method::Penalty { .. } => MethodName::Penalty,
            Method::Augmented { .. } => MethodName::Augmented,
        }
    }

    /// As on the command line.
    pub fn name(self) -> String {
        self.to_possible_value().map_or(String::new(), |value| value.get_name().to_string())
    }
}

formats!(
    Table: "For people; long numbers are shortened",
    Json: "All digits, numbers as strings",
    Csv: "One row, or with --trace one for each augmentation"
);

/// Solves and prints, one system or many.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    if options.batch {
        return batch::run(options);
    }
    output::print_answer(|out| options.answer(out))
}

impl Options {
    /// Solves in the scalar that was asked for; writes nothing before the solve is at its end.
    fn answer(&self, out: &mut dyn Write) -> Result<Exit, Failure> {
        in_scalar!(self.scalar, |like| self.answer_in(like, out))
    }

    fn answer_in<T: Scalar + Text>(&self, like: &T, out: &mut dyn Write) -> Result<Exit, Failure> {
        self.refuse_unused()?;
        let problem = Problem {
            system: self.system.round(self.names(), like)?,
            method: self.method(like)?,
            plane: if self.bilateral { Plane::Bilateral } else { Plane::Unilateral },
        };
        let out_of_range =
            |error: SolveError| format!("{} {}: {error}", self.names().of("--scalar"), self.scalar);
        let needed = problem.steps_needed();
        let solve = |progress: &dyn Fn(usize, usize)| problem.solve(needed.as_ref(), progress);
        let solution =
            if self.batch { solve(&|_, _| {}) } else { output::with_progress("solving", |bar| solve(bar)) };
        let solution = solution.map_err(out_of_range)?;
        if self.trace
            && !problem.trace(&solution).all(|iterate| quantities(&iterate).iter().all(|x| x.is_finite()))
        {
            return Err(out_of_range(SolveError::OutOfRange { quantity: "trace" }).into());
        }
        let kkt = solution.certificate(&problem.system).map_err(out_of_range)?;
        let steps_needed = needed.map(|steps| steps.to_string());
        let report = Report { options: self, problem: &problem, solution: &solution, kkt, steps_needed };
        match self.format {
            _ if self.batch => serde_json::to_writer(out, &report).map_err(io::Error::from)?,
            Format::Table => report.table(out)?,
            Format::Json => output::json(out, &report)?,
            Format::Csv => report.csv(out)?,
        }
        Ok(Exit::from_result(matches!(solution.outcome, Outcome::Direct | Outcome::Converged)))
    }

    /// A line of JSON knows keys, and no options.
    fn names(&self) -> Names {
        if self.batch { Names::Keys } else { Names::Options }
    }

    /// Refuses an option that would change nothing: it is a misunderstanding.
    fn refuse_unused(&self) -> Result<(), Failure> {
        let typed = |number: &Option<Number>| number.as_ref().map(|n| format!(" {}", shortened(&n.text)));
        let options = [
            ("--penalty", typed(&self.penalty), "penalty or augmented"),
            ("--tolerance", typed(&self.tolerance), "augmented"),
            ("--max-augmentations", self.max_augmentations.map(|n| format!(" {n}")), "augmented"),
            ("--initial-multiplier", typed(&self.initial_multiplier), "augmented"),
            ("--trace", self.trace.then(String::new), "augmented"),
        ];
        let own = self.method.name();
        for (option, value, methods) in options {
            if let Some(value) = value
                && !methods.contains(&own)
            {
                let [option, method] = [option, "--method"].map(|name| self.names().of(name));
                return Err(Failure::Input(format!(
                    "'{option}{value}' is not used by {method} {own}; it belongs to {method} {methods}"
                )));
            }
        }
        Ok(())
    }

    /// The default too as it would be typed.
    fn tolerance(&self) -> Number {
        self.tolerance.clone().unwrap_or_else(|| parse_number("1e-9").expect("a number"))
    }

    fn method<T: Scalar + Text>(&self, like: &T) -> Result<Method<T>, Failure> {
        let ten_c = &self.system.stiffness.value * Exact::from(10);
        let name = |option| self.names().of(option);
        let round_penalty = |number: &Number| number.round(name("--penalty <E>"), like);
        Ok(match self.method {
            MethodName::Lagrange => Method::Lagrange,
            MethodName::Penalty => Method::Penalty {
                penalty: round_penalty(self.penalty.as_ref().ok_or_else(|| {
                    let example = shortened(&ten_c.to_string());
                    format!(
                        "{} penalty needs '{}', greater than 0; for example 10 c: {} {example}",
                        name("--method"),
                        name("--penalty <E>"),
                        name("--penalty")
                    )
                })?)?,
            },
            MethodName::Augmented => {
                let or = |number: &Option<Number>, text: &str, value: Exact| {
                    number.clone().unwrap_or_else(|| Number { text: text.to_string(), value })
                };
                let start = or(&self.initial_multiplier, "0", Exact::zero());
                Method::Augmented {
                    penalty: round_penalty(&or(&self.penalty, "10 c, the default", ten_c))?,
                    tolerance: self.tolerance().round(name("--tolerance <T>"), like)?,
                    max_augmentations: self.max_augmentations.unwrap_or(MAX_AUGMENTATIONS),
                    start: start.round(name("--initial-multiplier <L>"), like)?,
                }
            }
        })
    }
}

/// What is to be solved, in the scalar it is solved in.
struct Problem<T> {
    system: SpringMass<T>,
    method: Method<T>,
    plane: Plane,
}

impl<T: Scalar + Text> Problem<T> {
    /// How far it has come is measured by the steps that exact arithmetic needs.
    fn solve(
        &self,
        needed: Option<&Integer>,
        progress: &dyn Fn(usize, usize),
    ) -> Result<Solution<T>, SolveError> {
        let steps = match &self.method {
            Method::Augmented { max_augmentations, .. } => {
                needed.and_then(Integer::to_u64).map_or(*max_augmentations, |n| n.min(*max_augmentations))
            }
            Method::Lagrange | Method::Penalty { .. } => 0,
        };
        let count = |k: u64| usize::try_from(k).unwrap_or(usize::MAX);
        let each = |step: &Iterate<T>| progress(count(step.k), count(steps));
        solve_observed(&self.system, &self.method, self.plane, each)
    }

    /// The augmentations that led to a solution, once more: cheaper than to keep them all.
    fn trace(&self, solution: &Solution<T>) -> impl Iterator<Item = Iterate<T>> {
        let steps = match &self.method {
            Method::Augmented { penalty, start, .. } => {
                Some(Augmentation::new(&self.system, penalty).with_multiplier(start.clone()).over(self.plane))
            }
            Method::Lagrange | Method::Penalty { .. } => None,
        };
        let last = solution.augmentations;
        steps.into_iter().flatten().take_while(move |step| Some(step.k) <= last)
    }

    /// The count of (1.33), of exact arithmetic; none if it has too many digits.
    fn steps_needed(&self) -> Option<Integer> {
        let Method::Augmented { penalty, tolerance, start, .. } = &self.method else { return None };
        augmentations_needed(&self.system, penalty, tolerance, start, self.plane).ok()
    }
}

/// Prints the command that reproduces a counterexample, if there is one.
pub fn command(out: &mut dyn Write, counterexample: &Point) -> io::Result<()> {
    let reproduction = reproduction(counterexample);
    reproduction
        .map_or(Ok(()), |(system, method)| output::command(out, command_line(&system, &method).split(' ')))
}

fn command_line(system: &SpringMass<Exact>, method: &Method<Exact>) -> String {
    let options = SpringMass::KEYS.zip(system.as_ref());
    let options = options.map(|(key, x)| format!("--{} {x}", key.replace('_', "-"))).into_array().join(" ");
    let line = format!("contact solve --scalar exact {options} --method {}", MethodName::of(method).name());
    match method {
        Method::Lagrange => line,
        Method::Penalty { penalty } | Method::Augmented { penalty, .. } => {
            line + &format!(" --penalty {penalty}")
        }
    }
}

/// What an iterate says besides its k.
fn quantities<T>(iterate: &Iterate<T>) -> [&T; 4] {
    [&iterate.multiplier, &iterate.deflection, &iterate.penetration, &iterate.contact_force]
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{Args, FromArgMatches};
    use std::cell::RefCell;

    /// In steps, of those that exact arithmetic needs, or that are allowed if these are fewer.
    #[test]
    fn progress_ends_with_the_solve() {
        let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
        for (max_augmentations, last) in [(1000, 35), (7, 7)] {
            let seen = RefCell::new(Vec::new());
            let method =
                Method::Augmented { penalty: 100.0, tolerance: 1e-12, max_augmentations, start: 0.0 };
            let problem = Problem { system, method, plane: Plane::Unilateral };
            let progress = |k, of| seen.borrow_mut().push((k, of));
            assert!(problem.solve(problem.steps_needed().as_ref(), &progress).is_ok());
            assert_eq!(seen.into_inner(), (0..=last).map(|k| (k, last)).collect::<Vec<_>>());
        }
    }

    /// What is printed, however long, is read as the system and the method that were meant.
    #[test]
    fn a_command_line_is_read_as_what_it_was_made_from() {
        let [c, m, g, l, h, penalty] =
            ["1/3", "5", "-1/3", "-7", "2", "7"].map(|text| text.parse::<Exact>().unwrap());
        let system = SpringMass { c, m, g, l, h };
        for method in [Method::Lagrange, Method::Penalty { penalty: penalty.clone() }] {
            let line = command_line(&system, &method);
            let words = crate::args::joined(line.split(' ').skip(1).map(String::from));
            let read =
                Options::augment_args(clap::Command::new("solve")).try_get_matches_from(words).unwrap();
            let options = Options::from_arg_matches(&read).unwrap();
            assert_eq!(options.system.values(), system);
            assert_eq!(options.method(&penalty).unwrap_or_else(|_| panic!("{line}")), method);
            assert_eq!(options.scalar, NumberSystem::Exact);
        }
    }
}
