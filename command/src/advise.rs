//! `contact advise`: which penalty, and what it gives.

use crate::args::{Names, Number, System, exact, in_scalar, parse_positive, spelled};
use crate::output::{self, Exit, Failure, formats, record, shortened};
use crate::solve::{MethodName, rounded_in_words, state_in_words};
use clap::ValueEnum;
use num_traits::Zero;
use serde::Serialize;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{NumberSystem, Text};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{Advice, Choice, Method, Plane, Scalar, SolveError, advise, bits_needed};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact advise --tolerance 1e-12
      Which penalty and how many augmentations find u to 1e-12 m in f64.
  contact advise --tolerance 1e-40 --stiffness 1e6 --height 1.01
  contact advise --tolerance 1e-40 --scalar mpfr:200 --format json

Every choice has been tried: k, p and the error of the force m g − c u are those
of its run, p exactly that of the deflection found. Every penalty from .. to is
sure to meet the tolerance, too, and no smaller one is; the force is then off by
c T and what rounding adds. Up to the larger one rounding takes no more from the
method's own force (N = ε p, or the multiplier) than c T, unless it does so with
every penalty that will do: then the choice is the larger one.

Exit status: 0 a method reaches the tolerance; 1 none does; 2 bad input.";

/// Say which penalty reaches a tolerance, and how many augmentations it takes
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    system: System,

    /// How far the deflection may be off in m
    #[arg(long, value_name = "T", value_parser = parse_positive, help_heading = "Method")]
    tolerance: Number,

    /// Number system: f32, f64, mpfr:BITS or exact
    #[arg(long, value_name = "S", default_value_t = NumberSystem::F64, help_heading = "Output")]
    scalar: NumberSystem,
    /// How to print the result
    #[arg(long, value_enum, default_value_t = Format::Table, help_heading = "Output")]
    format: Format,
}

formats!(Table: "For people", Json: "Numbers as strings");

/// Advises and prints.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    in_scalar!(options.scalar, |like| run_in(options, like))
}

fn run_in<T: Scalar + Text>(options: &Options, like: &T) -> Result<Exit, Failure> {
    let system = options.system.round(Names::Options, like)?;
    let tolerance = options.tolerance.round("--tolerance <T>", like)?;
    let out_of_range = |error: SolveError| Failure::Input(format!("--scalar {}: {error}", options.scalar));
    let advice = advise(&system, &tolerance).map_err(out_of_range)?;
    // Of what was typed: with more bits it is rounded to other numbers.
    let values = options.system.values();
    let bits_needed =
        bits_needed(&values, Plane::Unilateral, &options.tolerance.value).map_err(out_of_range)?;
    let report = Report { options, system, tolerance, advice, bits_needed };
    output::print(|out| match options.format {
        Format::Table => report.table(out),
        Format::Json => output::json(out, &report.json()),
    })?;
    Ok(Exit::from_result(!report.advice.choices.is_empty()))
}

/// All there is to say.
struct Report<'a, T> {
    options: &'a Options,
    system: SpringMass<T>,
    tolerance: T,
    advice: Advice<T>,
    bits_needed: Option<u32>,
}

impl<T: Scalar + Text> Report<'_, T> {
    /// Returns the report as JSON has it: quantities as texts, the error relative to the force.
    fn json(&self) -> impl Serialize {
        let choice = |choice: &Choice<T>| {
            let penalty = choice.method.penalty();
            let range = || choice.penalties.each_ref().map(|end| end.as_ref().map(Text::text));
            record! {
                method: MethodName::of(&choice.method).name(),
                penalty: penalty.map(Text::text),
                penalty_range: penalty.map(|_| range()),
                augmentations: choice.augmentations,
                penetration: choice.penetration.decimal(17, Round::Nearest),
                force_error: choice.relative_force_error.as_ref().map(|error| error.decimal(3, Round::Up)),
            }
        };
        let choices = &self.advice.choices;
        record! {
            scalar: self.options.scalar,
            tolerance: self.tolerance.text(),
            floor: self.advice.floor.as_ref().map(|floor| floor.decimal(17, Round::Up)),
            reachable: !choices.is_empty(),
            bits_needed: self.bits_needed,
            choices: choices.iter().map(choice).collect::<Vec<_>>(),
        }
    }

    fn table(&self, out: &mut dyn Write) -> io::Result<()> {
        let Report { options, advice, .. } = self;
        let floor = match &advice.floor {
            Some(floor) if floor.is_zero() => "none: rounding keeps no method from any tolerance".to_string(),
            Some(floor) => {
                format!("{} m: every method is sure to meet a larger tolerance", floor.decimal(3, Round::Up))
            }
            None => "none: with so few bits, or numbers so small, no augmentation is sure".to_string(),
        };
        let tolerance = format!("{} m ({})", shortened(&options.tolerance.text), options.scalar);
        let state = state_in_words(advice.state, Plane::Unilateral).to_string();
        let rounded = rounded_in_words(&options.system, &self.system, Vec::new());
        let typed = options.system.shown();
        let head = [("system", typed), ("as rounded", rounded), ("state", state), ("tolerance", tolerance)];
        output::list(out, head.into_iter().chain([("floor", floor)]))?;
        writeln!(out)?;
        if !advice.choices.is_empty() {
            let names = ["method", "ε in N/m", "from", "to", "k", "p in m", "N off by"];
            output::table(out, names, advice.choices.iter().map(row), &[])?;
            writeln!(out)?;
        }
        if let Some(missing) = self.missing() {
            output::wrapped(out, " ", 1, &missing)?;
            writeln!(out)?;
        }
        advice.choices.iter().try_for_each(|choice| self.command(out, &choice.method))
    }

    /// What to say of methods that are not among the choices.
    fn missing(&self) -> Option<String> {
        let has = |name| self.advice.choices.iter().any(|choice| MethodName::of(&choice.method) == name);
        let missing = MethodName::value_variants().iter().filter(|name| !has(**name));
        let names: Vec<_> = missing.map(|name| name.name()).collect();
        let scalar = self.options.scalar;
        let own = match scalar {
            NumberSystem::F32 => f32::MANTISSA_DIGITS,
            NumberSystem::F64 => f64::MANTISSA_DIGITS,
            NumberSystem::Mpfr(_) | NumberSystem::Exact => 0,
        };
        let bits = match self.bits_needed {
            Some(bits) if bits <= own => {
                format!("a number leaves its range, and --scalar mpfr:{own} has room")
            }
            Some(bits) => format!("--scalar mpfr:{bits} has bits enough for every method"),
            None => "no number of bits that can be had is enough".to_string(),
        };
        if names.is_empty() {
            None
        } else if names.len() == MethodName::value_variants().len() {
            Some(format!("No method is sure to meet the tolerance in {scalar}; {bits}."))
        } else {
            Some(format!("By {} nothing is sure in {scalar}; {bits}.", names.join(" and ")))
        }
    }

    /// The command that does it.
    fn command(&self, out: &mut dyn Write, method: &Method<T>) -> io::Result<()> {
        let Options { system, tolerance, scalar, .. } = self.options;
        let mut words = vec!["contact".to_string(), "solve".to_string()];
        words.extend(system.options());
        let mut option = |name: &str, value: String| words.extend([format!("--{name}"), value]);
        option("method", MethodName::of(method).name());
        if let Some(penalty) = method.penalty() {
            option("penalty", spelled(&exact(penalty)));
        }
        if let Method::Augmented { .. } = method {
            option("tolerance", tolerance.text.clone());
        }
        if *scalar != NumberSystem::F64 {
            option("scalar", scalar.to_string());
        }
        output::command(out, words.iter().map(String::as_str))
    }
}

fn row<T: Scalar + Text>(choice: &Choice<T>) -> [String; 7] {
    let own = choice.method.penalty();
    // Rounded inwards, but for the choice itself, which is shown one way.
    let short = |x: Option<&T>, round| {
        let round = if x == own { Round::Nearest } else { round };
        x.map_or(String::new(), |x| exact(x).decimal(3, round))
    };
    let [from, to] = &choice.penalties;
    [
        MethodName::of(&choice.method).name(),
        short(own, Round::Nearest),
        short(from.as_ref(), Round::Up),
        short(to.as_ref(), Round::Down),
        choice.augmentations.map_or(String::new(), |k| k.to_string()),
        choice.penetration.decimal(3, Round::Nearest),
        format!("{} N", choice.force_error.decimal(2, Round::Up)),
    ]
}
