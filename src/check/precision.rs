//! Parameters of less precision than requested.

use super::observation::Observation;
use super::problems::DIGITS;
use super::scales::{decimal, short};
use crate::chapter::SpringMass;
use crate::number::{Exact, ToExact};
use std::fmt;

/// Symbols of parameters that a program may round: lengths, all, or one.
const PARAMETERS: [&[&str]; 7] =
    [&["l", "H"], &["c", "m", "g", "l", "H"], &["c"], &["m"], &["g"], &["l"], &["H"]];

/// A way to lose digits of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rounding {
    Single,
    /// To this number of decimals.
    Decimals(usize),
    /// The decimals after this number are cut off.
    Cut(usize),
    /// To this number of digits.
    Digits(usize),
}

impl Rounding {
    fn all() -> impl Iterator<Item = Rounding> {
        let decimals = (0..DIGITS).flat_map(|n| [Rounding::Decimals(n), Rounding::Cut(n)]);
        [Rounding::Single].into_iter().chain(decimals).chain((1..DIGITS).map(Rounding::Digits))
    }

    /// Returns the rounded number, if it is in range.
    fn of(self, x: &Exact) -> Option<Exact> {
        match self {
            Rounding::Single => x.to_f32().ok()?.to_exact().ok(),
            Rounding::Decimals(n) => format!("{x:.n$}").parse().ok(),
            Rounding::Cut(n) => {
                let unit = decimal(1, -(n as i32));
                Some(Exact::from((x / &unit).as_rational().clone().trunc()) * unit)
            }
            Rounding::Digits(n) => Some(short(x, n)),
        }
    }

    /// Rounds the nearest float, as most programs do.
    fn of_float(self, x: &Exact) -> Option<Exact> {
        let float = x.to_f64().ok()?;
        match self {
            // The product with the power of ten is rounded before it is cut.
            Rounding::Cut(n) => {
                let unit = 10_f64.powi(n as i32);
                ((float * unit).trunc() / unit).to_exact().ok()
            }
            _ => self.of(&float.to_exact().ok()?),
        }
    }

    /// Returns `true` if right programs that round these parameters give all answers: the numbers themselves, or
    /// the nearest floats.
    fn explains(self, symbols: &[&str], answers: &[&Observation], tolerance: &Exact) -> bool {
        [Rounding::of, Rounding::of_float].into_iter().any(|round| {
            answers.iter().all(|answer| {
                let system = SpringMass::SYMBOLS.zip(answer.problem.system.as_ref()).map(|(symbol, x)| {
                    let rounded = if symbols.contains(&symbol) { round(self, x) } else { None };
                    rounded.unwrap_or_else(|| x.clone())
                });
                answer.is_explained_by_parameters(&system, tolerance)
            })
        })
    }
}

impl fmt::Display for Rounding {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Rounding::Single => f.write_str("rounded to single precision"),
            Rounding::Decimals(n) => write!(f, "rounded to {n} decimals"),
            Rounding::Cut(n) => write!(f, "cut off after {n} decimals"),
            Rounding::Digits(n) => write!(f, "rounded to {n} digits"),
        }
    }
}

/// Describes the rounding of parameters that explains all answers.
pub(super) fn rounded_parameters(answers: &[&Observation], tolerance: &Exact) -> Option<String> {
    let mut all =
        PARAMETERS.into_iter().flat_map(|symbols| Rounding::all().map(move |rounding| (symbols, rounding)));
    let (symbols, rounding) =
        all.find(|(symbols, rounding)| rounding.explains(symbols, answers, tolerance))?;
    let (last, others) = symbols.split_last()?;
    Some(if others.is_empty() {
        format!("{last} is {rounding}")
    } else {
        format!("{} and {last} are {rounding}", others.join(", "))
    })
}
