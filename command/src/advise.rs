//! `contact advise`: recommends a penalty parameter for a tolerance.

use crate::args::{NameStyle, Number, System, exact, format_exact, in_scalar, invalid, parse_positive};
use crate::output::{self, Exit, Failure, formats, record, shortened};
use crate::solve::{MethodName, rounded_in_words, state_in_words};
use clap::ValueEnum;
use num_traits::Zero;
use serde::Serialize;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{ExactText, NumberSystem};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{
    Advice, Method, Plane, Recommendation, Scalar, advise, required_precision,
};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact advise --tolerance 1e-12
      Penalty and number of augmentations for u to 1e-12 m in f64.
  contact advise --tolerance 1e-40 --stiffness 1e6 --height 1.01
  contact advise --tolerance 1e-40 --scalar mpfr:200 --format json

Every recommendation has been confirmed by a run, from which k, the exact
penetration p and the error of the force m g − c u are taken. The augmentation
is that with the smallest penalty for which ten steps suffice or, if that is
beyond the range, with the fewest steps. Every penalty in the range guarantees
the tolerance, and none that is smaller by more than a hundredth does; the error
of the force is then at most c T plus rounding. In JSON the error of the force
is relative. Up to the larger bound, rounding changes the method's own force
(N = ε p, or the multiplier) by at most c T; if no sufficient penalty has that,
the larger bound is the recommendation.

Exit status: 0 a method meets the tolerance; 1 none does; 2 bad input.";

/// Recommend a penalty parameter for a tolerance, with the number of augmentations
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    system: System,

    /// Largest error of the deflection in m
    #[arg(long, value_name = "T", value_parser = parse_positive, help_heading = "Method")]
    tolerance: Number,

    /// Number system: f16, bf16, f32, f64, mpfr:BITS or exact
    #[arg(long, value_name = "S", default_value_t = NumberSystem::F64, help_heading = "Output")]
    scalar: NumberSystem,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table, help_heading = "Output")]
    format: Format,
}

formats!(Table: "For people", Json: "Numbers as strings");

/// Largest precision of the runs that confirm an advice: a thousand augmentations then take a second.
const MAX_CONFIRMED_BITS: u32 = 100_000;

/// Computes the advice and prints it.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let scalar = options.scalar;
    if matches!(scalar, NumberSystem::Mpfr(bits) if bits > MAX_CONFIRMED_BITS) {
        let reason = format!("advice is confirmed by runs, which take at most mpfr:{MAX_CONFIRMED_BITS}");
        return Err(invalid(&scalar.to_string(), "--scalar <S>", reason));
    }
    in_scalar!(scalar, |like| run_in(options, like))
}

fn run_in<T: Scalar + ExactText>(options: &Options, like: &T) -> Result<Exit, Failure> {
    let system = options.system.round(NameStyle::Options, like)?;
    let tolerance = options.tolerance.round("--tolerance <T>", like)?;
    // The precision is that for the typed numbers, which a higher precision rounds differently.
    let report = advise(&system, &tolerance).and_then(|advice| {
        let values = options.system.values();
        let required_precision = required_precision(&values, Plane::Unilateral, &options.tolerance.value)?;
        Ok(Report { options, system, tolerance, advice, required_precision })
    });
    let report = report.map_err(|error| format!("--scalar {}: {error}", options.scalar))?;
    output::print(|out| match options.format {
        Format::Table => report.table(out),
        Format::Json => output::json(out, &report.json()),
    })?;
    Ok(Exit::from_result(!report.advice.recommendations.is_empty()))
}

/// Contents of the report.
struct Report<'a, T> {
    options: &'a Options,
    system: SpringMass<T>,
    tolerance: T,
    advice: Advice<T>,
    required_precision: Option<u32>,
}

impl<T: Scalar + ExactText> Report<'_, T> {
    /// Returns the report for JSON: quantities as texts, and the error relative to the force.
    fn json(&self) -> impl Serialize {
        let choices = &self.advice.recommendations;
        record! {
            scalar: self.options.scalar,
            tolerance: self.tolerance.text(),
            floor: self.advice.floor.as_ref().map(|floor| floor.decimal(17, Round::Up)),
            reachable: !choices.is_empty(),
            required_precision: self.required_precision,
            recommendations: choices.iter().map(json).collect::<Vec<_>>(),
        }
    }

    fn table(&self, out: &mut dyn Write) -> io::Result<()> {
        let Report { options, advice, .. } = self;
        let floor = match &advice.floor {
            Some(floor) if floor.is_zero() => {
                "none: rationals do not round, so every tolerance is met".to_string()
            }
            Some(floor) => {
                let floor = floor.decimal(3, Round::Up);
                format!("{floor} m: every larger tolerance is guaranteed for each method")
            }
            None => {
                "none: with such a low precision, or such small numbers, nothing is guaranteed".to_string()
            }
        };
        let tolerance = format!("{} m ({})", shortened(&options.tolerance.text), options.scalar);
        let state = state_in_words(advice.state, Plane::Unilateral).to_string();
        let rounded = rounded_in_words(&options.system, &self.system, Vec::new());
        let typed = options.system.shown();
        let head = [("system", typed), ("as rounded", rounded), ("state", state), ("tolerance", tolerance)];
        output::list(out, head.into_iter().chain([("floor", floor)]))?;
        writeln!(out)?;
        if !advice.recommendations.is_empty() {
            let names = ["method", "ε in N/m", "from", "to", "k", "p in m", "N off by"];
            output::table(out, names, advice.recommendations.iter().map(row), ..)?;
            writeln!(out)?;
        }
        if let Some(missing) = self.missing() {
            output::wrapped(out, " ", 1, &missing)?;
            writeln!(out)?;
        }
        advice.recommendations.iter().try_for_each(|choice| self.command(out, &choice.method))
    }

    /// Explains which methods are not recommended.
    fn missing(&self) -> Option<String> {
        let choices = &self.advice.recommendations;
        let recommended: Vec<_> = choices.iter().map(|choice| MethodName::of(&choice.method)).collect();
        let missing = MethodName::value_variants().iter().filter(|name| !recommended.contains(name));
        let names: Vec<_> = missing.map(|name| name.name()).collect();
        let scalar = self.options.scalar;
        let digits = match scalar {
            NumberSystem::Float(format) => format.bits,
            NumberSystem::Mpfr(_) | NumberSystem::Exact => 0,
        };
        let bits = match self.required_precision {
            Some(bits) if bits <= digits => {
                format!("a number is out of its range, but not of that of --scalar mpfr:{digits}")
            }
            Some(bits) => format!("--scalar mpfr:{bits} suffices for every method"),
            None => "no available precision suffices".to_string(),
        };
        if names.is_empty() {
            None
        } else if names.len() == MethodName::value_variants().len() {
            Some(format!("No method is guaranteed to meet the tolerance in {scalar}; {bits}."))
        } else {
            Some(format!("With {} nothing is guaranteed in {scalar}; {bits}.", names.join(" and ")))
        }
    }

    /// Prints the command that runs the method.
    fn command(&self, out: &mut dyn Write, method: &Method<T>) -> io::Result<()> {
        let Options { system, tolerance, scalar, .. } = self.options;
        let mut words = ["contact", "solve"].map(String::from).to_vec();
        words.extend(system.options());
        words.extend(["--method".to_string(), MethodName::of(method).name()]);
        if let Some(penalty) = method.penalty() {
            // The shortest decimal that rounds to the penalty is sometimes hundreds of digits shorter.
            let texts = [format_exact(&exact(penalty)), penalty.text()];
            words.push("--penalty".to_string());
            words.extend(texts.into_iter().min_by_key(String::len));
        }
        if let Method::Augmented { .. } = method {
            words.extend(["--tolerance".to_string(), tolerance.text.clone()]);
        }
        if *scalar != NumberSystem::F64 {
            words.extend(["--scalar".to_string(), scalar.to_string()]);
        }
        output::command(out, words.iter().map(String::as_str))
    }
}

fn json<T: Scalar + ExactText>(choice: &Recommendation<T>) -> impl Serialize + use<T> {
    let penalty = choice.method.penalty();
    record! {
        method: MethodName::of(&choice.method).name(),
        penalty: penalty.map(ExactText::text),
        penalty_range: penalty
            .map(|_| choice.penalty_range.each_ref().map(|end| end.as_ref().map(ExactText::text))),
        augmentations: choice.augmentations,
        penetration: choice.penetration.decimal(17, Round::Nearest),
        force_error: choice.relative_force_error.as_ref().map(|error| error.decimal(3, Round::Up)),
    }
}

fn row<T: Scalar + ExactText>(choice: &Recommendation<T>) -> [String; 7] {
    let penalty = choice.method.penalty();
    let [from, to] = choice.penalty_range.each_ref().map(Option::as_ref);
    // Rounded inwards, except for the recommended penalty itself, which is formatted in one way.
    let [penalty, from, to] =
        [(penalty, Round::Nearest), (from, Round::Up), (to, Round::Down)].map(|(x, round)| {
            let round = if x == penalty { Round::Nearest } else { round };
            x.map_or(String::new(), |x| exact(x).decimal(3, round))
        });
    [
        MethodName::of(&choice.method).name(),
        penalty,
        from,
        to,
        choice.augmentations.map_or(String::new(), |k| k.to_string()),
        choice.penetration.decimal(3, Round::Nearest),
        format!("{} N", choice.force_error.decimal(2, Round::Up)),
    ]
}
