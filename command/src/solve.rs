//! `contact solve`: options, and the solution in the selected number system.

mod batch;
mod report;

use crate::args::{NameStyle, Number, System, in_scalar, parse_number, parse_positive, parse_u64};
use crate::output::{self, Exit, Failure, formats, shortened};
use clap::ValueEnum;
use num_traits::Zero;
use report::Report;
pub use report::{rounded_in_words, state_in_words};
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, ExactText, NumberSystem};
use spring_mass_contact::rug::Integer;
use spring_mass_contact::solver::{
    Augmentation, Iterate, MAX_AUGMENTATIONS, Method, Outcome, Plane, Scalar, Solution, SolveError,
    exact_augmentation_count, solve_observed,
};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact solve
      The default system by Lagrange multiplier: in contact, with 4.81 N.
  contact solve --method penalty --penalty 1000 --scalar exact
  contact solve --method augmented --tolerance 1e-30 --scalar mpfr:200 --trace
  contact solve --gravity -9.81 --height 21/20 --format json
  echo '{\"id\": 7, \"height\": 1.09}' | contact solve --batch

A number is a decimal (0.05), scientific (5e-2), hexadecimal (0x1.8p-3) or a
fraction (1/20), read exactly and rounded once into the scalar. In the table,
exact: and limit: are bounds of the exact solution for the rounded parameters;
for an augmentation, of its limit. JSON has them under bounds. An augmentation
in rationals, whose length grows with every step, ends with an error if a
multiplier would have more than 2²¹ binary digits, or all of them together 2²⁶.

With --batch each line of stdin is a JSON object. Its keys are the long options
with underscores (free_length), and id, which is returned; options on the
command line are defaults for the lines. Answers are printed in the order of the
lines, without waiting for further input. Each is what --format json prints, or
has an error.

Exit status: 0 success; 1 a solve did not converge (its result is still
printed), or a line of a batch is an error; 2 bad input.";

/// Solve a system, with rigorous bounds and the residuals of the contact conditions
#[derive(clap::Args, Clone)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    system: System,

    /// Method that enforces the contact
    #[arg(long, value_enum, default_value_t = MethodName::Lagrange, help_heading = "Method")]
    method: MethodName,
    /// Penalty parameter in N/m, ε > 0, for penalty and augmented [default for augmented: 10 c]
    #[arg(long, value_name = "E", value_parser = parse_positive, help_heading = "Method")]
    penalty: Option<Number>,
    /// Largest error of the deflection in m, for augmented [default: 1e-9]
    #[arg(long, value_name = "T", value_parser = parse_positive, help_heading = "Method")]
    tolerance: Option<Number>,
    /// Largest number of augmentations, for augmented [default: 1000]
    #[arg(long, value_name = "N", value_parser = parse_u64, help_heading = "Method")]
    max_augmentations: Option<u64>,
    /// Initial multiplier in N, for augmented [default: 0]
    #[arg(long, value_name = "L", value_parser = parse_number, help_heading = "Method")]
    initial_multiplier: Option<Number>,
    /// Use bilateral contact: the plane also pulls, as in the chapter's printed equations
    #[arg(long, help_heading = "Method")]
    bilateral: bool,

    /// Number system: f16, bf16, f32, f64, mpfr:BITS or exact
    #[arg(long, value_name = "S", default_value_t = NumberSystem::F64, help_heading = "Output")]
    scalar: NumberSystem,
    /// Show every augmentation, for augmented; csv then has these rows only
    #[arg(long, help_heading = "Output")]
    trace: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table, help_heading = "Output")]
    format: Format,
    /// Solve many systems: one JSON object per line of stdin, one line of output for each
    #[arg(long, conflicts_with_all = ["trace", "format"], help_heading = "Output")]
    batch: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Lagrange multiplier (§1.3.1): exact
    Lagrange,
    /// Penalty (§1.3.2): a second spring of stiffness ε
    Penalty,
    /// Augmented Lagrangian (§1.3.3): penalty, repeated with an updated multiplier
    Augmented,
}

impl MethodName {
    /// Returns the name of a method.
    pub fn of<T>(method: &Method<T>) -> Self {
        match method {
            Method::Lagrange => MethodName::Lagrange,
            Method::Penalty { .. } => MethodName::Penalty,
            Method::Augmented { .. } => MethodName::Augmented,
        }
    }

    /// Returns the name on the command line.
    pub fn name(self) -> String {
        self.to_possible_value().map_or(String::new(), |value| value.get_name().to_string())
    }
}

formats!(
    Table: "For people; long numbers are shortened",
    Json: "All digits, numbers as strings",
    Csv: "One row, or with --trace one for each augmentation"
);

/// Solves one system or many, and prints the results.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    if options.batch {
        return batch::run(options);
    }
    output::print_answer(|out| options.answer(out))
}

impl Options {
    /// Solves in the selected number system, and writes only after the solve has ended.
    fn answer(&self, out: &mut dyn Write) -> Result<Exit, Failure> {
        in_scalar!(self.scalar, |like| self.answer_in(like, out))
    }

    fn answer_in<T: Scalar + ExactText>(&self, like: &T, out: &mut dyn Write) -> Result<Exit, Failure> {
        self.refuse_unused()?;
        let problem = Problem {
            system: self.system.round(self.names(), like)?,
            method: self.method(like)?,
            plane: if self.bilateral { Plane::Bilateral } else { Plane::Unilateral },
        };
        let needed = problem.steps_needed();
        let solution = if self.batch {
            problem.solve(needed.as_ref(), &|_, _| {})
        } else {
            output::with_progress("solving", |progress| problem.solve(needed.as_ref(), progress))
        };
        let solution = solution.map_err(|error| self.out_of_range(error))?;
        if self.trace
            && !problem.trace(&solution).all(|iterate| quantities(&iterate).iter().all(|x| x.is_finite()))
        {
            return Err(self.out_of_range(SolveError::OutOfRange { quantity: "trace" }));
        }
        let kkt = solution.residuals(&problem.system).map_err(|error| self.out_of_range(error))?;
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

    fn out_of_range(&self, error: SolveError) -> Failure {
        Failure::Input(format!("{} {}: {error}", self.names().of("--scalar"), self.scalar))
    }

    /// Returns the form of names in errors: keys for a line of JSON, otherwise options.
    fn names(&self) -> NameStyle {
        if self.batch { NameStyle::Keys } else { NameStyle::Options }
    }

    /// Refuses an option without effect, which indicates a misunderstanding.
    fn refuse_unused(&self) -> Result<(), Failure> {
        let [penalty, tolerance, start] = [&self.penalty, &self.tolerance, &self.initial_multiplier]
            .map(|number| number.as_ref().map(|number| format!(" {}", shortened(&number.text))));
        let options = [
            ("--penalty", penalty, "penalty or augmented"),
            ("--tolerance", tolerance, "augmented"),
            ("--max-augmentations", self.max_augmentations.map(|n| format!(" {n}")), "augmented"),
            ("--initial-multiplier", start, "augmented"),
            ("--trace", self.trace.then(String::new), "augmented"),
        ];
        let selected = self.method.name();
        for (option, value, methods) in options {
            if let Some(value) = value
                && !methods.contains(&selected)
            {
                let [option, method] = [option, "--method"].map(|name| self.names().of(name));
                return Err(Failure::Input(format!(
                    "'{option}{value}' has no effect with {method} {selected}; use it with {method} {methods}"
                )));
            }
        }
        Ok(())
    }

    /// Returns the tolerance; the default as it would be typed.
    fn tolerance(&self) -> Number {
        self.tolerance.clone().unwrap_or_else(|| parse_number("1e-9").expect("a number"))
    }

    fn method<T: Scalar + ExactText>(&self, like: &T) -> Result<Method<T>, Failure> {
        let names = self.names();
        let ten_c = &self.system.stiffness.value * Exact::from(10);
        Ok(match self.method {
            MethodName::Lagrange => Method::Lagrange,
            MethodName::Penalty => {
                let penalty = self.penalty.as_ref().ok_or_else(|| {
                    let [method, value, option] =
                        ["--method", "--penalty <E>", "--penalty"].map(|name| names.of(name));
                    let example = shortened(&ten_c.to_string());
                    format!("{method} penalty needs '{value}', greater than 0; for example 10 c: {option} {example}")
                })?;
                Method::Penalty { penalty: penalty.round(names.of("--penalty <E>"), like)? }
            }
            MethodName::Augmented => {
                let ten_c = Number { text: "10 c, the default".to_string(), value: ten_c };
                let zero = Number { text: "0".to_string(), value: Exact::zero() };
                let tolerance = self.tolerance.clone().unwrap_or_else(|| {
                    let Number { text, value } = self.tolerance();
                    Number { text: format!("{text}, the default"), value }
                });
                let (penalty, start) = (self.penalty.as_ref(), self.initial_multiplier.as_ref());
                Method::Augmented {
                    penalty: penalty.unwrap_or(&ten_c).round(names.of("--penalty <E>"), like)?,
                    tolerance: tolerance.round(names.of("--tolerance <T>"), like)?,
                    max_augmentations: self.max_augmentations.unwrap_or(MAX_AUGMENTATIONS),
                    start: start.unwrap_or(&zero).round(names.of("--initial-multiplier <L>"), like)?,
                }
            }
        })
    }
}

/// A system and a method in the selected number system.
struct Problem<T> {
    system: SpringMass<T>,
    method: Method<T>,
    plane: Plane,
}

impl<T: Scalar + ExactText> Problem<T> {
    /// Solves, with progress relative to the number of steps in exact arithmetic.
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
        solve_observed(&self.system, &self.method, self.plane, |step| {
            let [k, steps] = [step.k, steps].map(|count| usize::try_from(count).unwrap_or(usize::MAX));
            progress(k, steps)
        })
    }

    /// Recomputes the augmentations of a solution, which is cheaper than storing them.
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

    /// Returns the count of (1.33) in exact arithmetic; `None` if it has too many digits.
    fn steps_needed(&self) -> Option<Integer> {
        let Method::Augmented { penalty, tolerance, start, .. } = &self.method else { return None };
        exact_augmentation_count(&self.system, penalty, tolerance, start, self.plane).ok()
    }
}

/// Returns the quantities of an iterate.
fn quantities<T>(iterate: &Iterate<T>) -> [&T; 4] {
    [&iterate.multiplier, &iterate.deflection, &iterate.penetration, &iterate.contact_force]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    /// Counted in steps of exact arithmetic, or allowed steps if these are fewer.
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
}
