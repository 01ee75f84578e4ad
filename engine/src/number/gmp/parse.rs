//! Exact parsing of decimal, scientific, hexadecimal and fraction notation.

use super::{Exact, Mpfr};
use rug::{Integer, Rational, ops::Pow};
use std::str::FromStr;

/// Largest absolute value of an exponent, of 10 or, in hexadecimal notation, of 2; a larger one is refused
/// before memory is allocated.
pub const MAX_EXPONENT: i32 = 100_000;

/// Error of parsing a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseError {
    /// The text is empty.
    #[error(
        "empty; a number is a decimal (0.05), scientific (5e-2), hexadecimal (0x1.8p-3) or a fraction (1/20)"
    )]
    Empty,
    /// The text is not a number.
    #[error(
        "not a number; a number is a decimal (0.05), scientific (5e-2), hexadecimal (0x1.8p-3) or a fraction (1/20)"
    )]
    NotANumber,
    /// The denominator is zero.
    #[error("division by zero; the denominator must not be 0")]
    DivisionByZero,
    /// The exponent exceeds [`MAX_EXPONENT`] in absolute value.
    #[error("exponent out of range; it must lie between -100000 and 100000")]
    Exponent,
    /// The number is out of the range of the scalar.
    #[error(transparent)]
    Range(#[from] RangeError),
}

/// A number outside the range of a float, which would silently become infinite or zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RangeError {
    /// The number is larger than the largest float.
    #[error("overflows {scalar}")]
    Overflow {
        /// Name of the number system.
        scalar: &'static str,
    },
    /// The number is nonzero and rounds to zero.
    #[error("is not zero but would round to zero in {scalar}")]
    Underflow {
        /// Name of the number system.
        scalar: &'static str,
    },
}

/// Parses decimal (`9.81`, `.5`, `-3`), scientific (`1e-9`), hexadecimal (`0x1.8p-3` = 1.5 · 2⁻³, as C's `%a`
/// and Python's `float.hex` print it; without `p` the exponent is 0) and fraction (`-1/2`) notation exactly.
impl FromStr for Exact {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        if text.is_empty() {
            return Err(ParseError::Empty);
        }
        let (negative, rest) = sign(text);
        let q = match rest.split_once('/') {
            Some((p, q)) => {
                let (p, q) = (integer(p, 10)?, integer(q, 10)?);
                if q.is_zero() {
                    return Err(ParseError::DivisionByZero);
                }
                Rational::from((p, q))
            }
            None => positional(rest)?,
        };
        Ok(Exact(if negative { -q } else { q }))
    }
}

fn sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// Returns the text if it consists of digits of this base only.
fn digits(text: &str, base: u32) -> Result<&str, ParseError> {
    let all = !text.is_empty() && text.chars().all(|c| c.is_digit(base));
    all.then_some(text).ok_or(ParseError::NotANumber)
}

fn integer(text: &str, base: u32) -> Result<Integer, ParseError> {
    Integer::from_str_radix(digits(text, base)?, base as i32).map_err(|_| ParseError::NotANumber)
}

/// Parses decimal, scientific and hexadecimal notation.
fn positional(text: &str) -> Result<Rational, ParseError> {
    // A hexadecimal digit is worth four units of the exponent, which is one of 2.
    let (text, base, marks, radix, worth) = match text.strip_prefix("0x").or(text.strip_prefix("0X")) {
        Some(text) => (text, 16, ['p', 'P'], 2, 4),
        None => (text, 10, ['e', 'E'], 10, 1),
    };
    let (mantissa, exponent) = match text.split_once(marks) {
        Some((mantissa, exponent)) => {
            let (negative, exponent) = sign(exponent);
            // An exponent beyond i32 is out of range in any case.
            let size: i32 = digits(exponent, 10)?.parse().unwrap_or(i32::MAX);
            (mantissa, if negative { -size } else { size })
        }
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = integer(&format!("{whole}{fraction}"), base)?;
    if exponent.abs() > MAX_EXPONENT {
        return Err(ParseError::Exponent);
    }
    let shift = i64::from(exponent) - worth * fraction.len() as i64;
    let power =
        Integer::from(radix).pow(u32::try_from(shift.unsigned_abs()).map_err(|_| ParseError::Exponent)?);
    Ok(if shift < 0 { Rational::from((digits, power)) } else { Rational::from(digits * power) })
}

impl Mpfr {
    /// Parses a number and rounds it once to `precision` bits.
    ///
    /// # Errors
    /// Returns an error if the text is not a number.
    ///
    /// # Panics
    /// Panics if the precision is not in [`PRECISIONS`](super::PRECISIONS).
    pub fn parse(text: &str, precision: u32) -> Result<Self, ParseError> {
        Ok(text.parse::<Exact>()?.to_mpfr(precision))
    }
}
