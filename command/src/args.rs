//! Arguments shared by subcommands: numbers, the system, the scalar.

use crate::output::{Failure, is_visible, shortened};
use clap::Args;
use num_traits::Zero;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::claims::find_entries;
use spring_mass_contact::number::{Exact, NumberSystem, ToExact};
use spring_mass_contact::rug::float::Round;
use std::ffi::OsString;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// Returns the arguments if they are plain text, since others could garble the one line of an error.
/// Arguments after `--` belong to another program and only have to be Unicode.
pub fn checked_arguments() -> Result<Vec<String>, Failure> {
    let mut arguments = std::env::args_os().map(checked_text).collect::<Result<Vec<_>, _>>()?;
    let end = arguments.iter().position(|argument| argument == "--").unwrap_or(arguments.len());
    let foreign = arguments.split_off(end);
    if let Some(argument) = arguments.iter().find(|argument| !argument.chars().all(is_visible)) {
        let quoted = shortened(&format!("{argument:?}"));
        return Err(format!("argument {quoted}: must have no control characters").into());
    }
    Ok([join_negative_values(arguments), foreign].concat())
}

fn checked_text(argument: OsString) -> Result<String, String> {
    let text = argument.into_string();
    text.map_err(|other| format!("argument {}: must be UTF-8 text", shortened(&format!("{other:?}"))))
}

/// Joins values such as `-1/2` to the preceding option, `--gravity=-1/2`, because clap would take them for
/// options. (Allowing values that begin with a hyphen would hide that the value of `--mass --gravity 9` is
/// missing.)
fn join_negative_values(arguments: Vec<String>) -> Vec<String> {
    let mut joined: Vec<String> = Vec::new();
    for text in arguments {
        let negative = text.starts_with('-') && !text.starts_with("--");
        match joined.last_mut() {
            Some(option) if negative && takes_a_value(option) && text != "-h" && text != "-V" => {
                *option += &format!("={text}");
            }
            Some(_) | None => joined.push(text),
        }
    }
    joined
}

fn takes_a_value(argument: &str) -> bool {
    argument.starts_with("--") && !argument.contains('=')
}

/// Form of option names in errors: as typed, or as keys of a JSON object.
#[derive(Clone, Copy)]
pub enum NameStyle {
    /// `--free-length <L>`
    Options,
    /// `free_length`
    Keys,
}

impl NameStyle {
    /// Returns the name for an option as help writes it.
    pub fn of(self, option: &str) -> String {
        match self {
            NameStyle::Options => option.to_string(),
            NameStyle::Keys => key(option),
        }
    }
}

/// Returns the key of an option.
pub fn key(option: &str) -> String {
    let name = option.split(' ').next().unwrap_or(option);
    name.trim_start_matches('-').replace('-', "_")
}

/// Returns the one-line error for an invalid value of an option.
pub fn invalid(value: &str, name: impl Display, reason: impl Display) -> Failure {
    Failure::Input(format!("invalid value '{}' for '{name}': {reason}", shortened(value)))
}

/// A number as typed, with its exact value.
#[derive(Clone, Debug)]
pub struct Number {
    /// The text.
    pub text: String,
    /// The exact value.
    pub value: Exact,
}

/// Returns the value of a number that is known to be finite.
pub fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("a finite number")
}

/// Largest number of digits of an integer that is written without a power of ten.
const MAX_PLAIN_DIGITS: usize = 8;

/// Returns the shortest decimal equal to this number, or a fraction.
pub fn format_exact(x: &Exact) -> String {
    let decimals = (MAX_PLAIN_DIGITS..=100).map(|digits| x.decimal(digits, Round::Nearest));
    let mut decimals = decimals.filter(|text| text.parse().as_ref() == Ok(x));
    decimals.next().unwrap_or_else(|| x.to_string())
}

/// Parses any number.
pub fn parse_number(text: &str) -> Result<Number, String> {
    let value = text.parse().map_err(|error| format!("{error}"))?;
    Ok(Number { text: text.to_string(), value })
}

/// Parses a number greater than zero.
pub fn parse_positive(text: &str) -> Result<Number, String> {
    let number = parse_number(text)?;
    if number.value > Exact::zero() { Ok(number) } else { Err("must be greater than 0".to_string()) }
}

/// Parses an unsigned integer in this range.
pub fn parse_u64_in(range: RangeInclusive<u64>, text: &str) -> Result<u64, String> {
    let number = text.parse().ok().filter(|number| range.contains(number) && !text.starts_with('+'));
    number.ok_or_else(|| format!("must be an integer from {} to {}", range.start(), range.end()))
}

/// Parses an unsigned integer.
pub fn parse_u64(text: &str) -> Result<u64, String> {
    parse_u64_in(0..=u64::MAX, text)
}

/// Parses a positive integer.
pub fn parse_positive_u64(text: &str) -> Result<u64, String> {
    parse_u64_in(1..=u64::MAX, text)
}

impl Number {
    /// Returns the value, rounded once into the scalar of `like`.
    pub fn round<T: ToExact>(&self, name: impl Display, like: &T) -> Result<T, Failure> {
        let rounded = like.round_from_exact(&self.value);
        rounded.map_err(|error| invalid(&self.text, name, format!("{error}; use mpfr:BITS or exact")))
    }
}

/// Returns the number systems without repetition.
pub fn distinct(scalars: &[NumberSystem]) -> Vec<NumberSystem> {
    let scalars = scalars.iter().enumerate().filter(|(i, scalar)| !scalars[..*i].contains(scalar));
    scalars.map(|(_, scalar)| *scalar).collect()
}

/// Calls a generic function in a number system; `like` is a zero of it.
macro_rules! in_scalar {
    ($scalar:expr, |$like:ident| $run:expr) => {{
        use spring_mass_contact::half::{bf16, f16};
        use spring_mass_contact::number::{Exact, Native, NumberSystem};
        let zero = <Exact as num_traits::Zero>::zero();
        match $scalar {
            NumberSystem::F32 => {
                let $like = &0_f32;
                $run
            }
            NumberSystem::F64 => {
                let $like = &0_f64;
                $run
            }
            NumberSystem::F16 => {
                let $like = &Native(f16::ZERO);
                $run
            }
            NumberSystem::BF16 => {
                let $like = &Native(bf16::ZERO);
                $run
            }
            NumberSystem::Float(format) => unreachable!("no other format is parsed, but {}", format.name),
            NumberSystem::Mpfr(bits) => {
                let $like = &zero.to_mpfr(bits);
                $run
            }
            NumberSystem::Exact => {
                let $like = &zero;
                $run
            }
        }
    }};
}
pub(crate) use in_scalar;

/// The five parameters, in SI units.
#[derive(clap::Args, Clone, Debug)]
#[command(next_help_heading = "System")]
pub struct System {
    /// Stiffness of the spring in N/m, c > 0
    #[arg(long, value_name = "C", default_value = "100", value_parser = parse_positive)]
    pub stiffness: Number,
    /// Mass in kg, m > 0
    #[arg(long, value_name = "M", default_value = "1", value_parser = parse_positive)]
    pub mass: Number,
    /// Gravitational acceleration in m/s²; negative acts upwards
    #[arg(long, value_name = "G", default_value = "9.81", value_parser = parse_number)]
    pub gravity: Number,
    /// Free length of the spring in m
    #[arg(long, value_name = "L", default_value = "1", value_parser = parse_number)]
    pub free_length: Number,
    /// Height of the support above the plane in m
    #[arg(long, value_name = "H", default_value = "1.05", value_parser = parse_number)]
    pub height: Number,
}

impl System {
    /// Returns the parameters as typed.
    pub fn typed(&self) -> SpringMass<&Number> {
        let System { stiffness, mass, gravity, free_length, height } = self;
        SpringMass { c: stiffness, m: mass, g: gravity, l: free_length, h: height }
    }

    /// Formats the parameters in one line.
    pub fn shown(&self) -> String {
        self.typed().map(|number| shortened(&number.text)).to_string()
    }

    /// Returns the exact values.
    pub fn values(&self) -> SpringMass<Exact> {
        self.typed().map(|number| number.value.clone())
    }

    /// Returns the options for these parameters, without those at their defaults.
    pub fn options(&self) -> Vec<String> {
        let command = System::augment_args(clap::Command::new("system"));
        let SpringMass { c, m, g, l, h } = self.typed();
        let options = command.get_arguments().zip([c, m, g, l, h].map(|number| number.text.clone()));
        let changed = options.filter(|(option, text)| option.get_default_values() != [text.as_str()]);
        changed
            .flat_map(|(option, text)| [format!("--{}", option.get_long().expect("a name")), text])
            .collect()
    }

    /// Rounds each parameter once into the scalar of `like`.
    pub fn round<T: ToExact>(&self, names: NameStyle, like: &T) -> Result<SpringMass<T>, Failure> {
        let SpringMass { c, m, g, l, h } = self.typed();
        Ok(SpringMass {
            c: c.round(names.of("--stiffness <C>"), like)?,
            m: m.round(names.of("--mass <M>"), like)?,
            g: g.round(names.of("--gravity <G>"), like)?,
            l: l.round(names.of("--free-length <L>"), like)?,
            h: h.round(names.of("--height <H>"), like)?,
        })
    }
}

const NUMBER: &str = "must be a number listed by `contact equations`, such as 1.13 or 'Theorem 1.3.3'";

/// Parses equation numbers; `theorem 1.3.3` consists of two words.
pub fn equations(words: &[String]) -> Result<Vec<String>, Failure> {
    let entries = find_entries(words).map_err(|word| invalid(word, "[NUMBER]...", NUMBER))?;
    Ok(entries.iter().map(|entry| entry.equation.to_string()).collect())
}
