//! Reading numbers: every decimal, scientific or fraction spelling exactly.

use super::{Exact, Mpfr};
use rug::{Integer, Rational, ops::Pow};
use std::str::FromStr;

/// A decimal exponent beyond ±100 000 is refused before anything is allocated.
pub const MAX_EXPONENT: i32 = 100_000;

/// Why a text is not a number.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseError {
    /// Nothing there.
    #[error("empty; a number is a decimal (0.05), scientific (5e-2) or a fraction (1/20)")]
    Empty,
    /// Something, but no number.
    #[error("not a number; a number is a decimal (0.05), scientific (5e-2) or a fraction (1/20)")]
    NotANumber,
    /// A fraction over zero.
    #[error("division by zero; the denominator must not be 0")]
    DivisionByZero,
    /// An exponent that only a slip of the finger makes.
    #[error("exponent out of range; it must lie between -100000 and 100000")]
    Exponent,
    /// The number does not fit the scalar it is to be rounded into.
    #[error(transparent)]
    Range(#[from] RangeError),
}

/// A number that a float cannot hold: silently becoming infinite or zero would be a wrong answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RangeError {
    /// Larger than the largest float.
    #[error("overflows {scalar}; use mpfr:BITS or exact")]
    Overflow {
        /// The scalar as the command names it.
        scalar: &'static str,
    },
    /// Not zero, and yet nearest to zero.
    #[error("is not zero but would round to zero in {scalar}; use mpfr:BITS or exact")]
    Underflow {
        /// The scalar as the command names it.
        scalar: &'static str,
    },
}

/// Decimal (`9.81`, `.5`, `-3`), scientific (`1e-9`) or fraction (`-1/2`), read exactly.
impl FromStr for Exact {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        if text.is_empty() {
            return Err(ParseError::Empty);
        }
        let (negative, rest) = sign(text);
        let q = match rest.split_once('/') {
            Some((p, q)) => {
                let (p, q) = (integer(p)?, integer(q)?);
                if q.is_zero() {
                    return Err(ParseError::DivisionByZero);
                }
                Rational::from((p, q))
            }
            None => decimal(rest)?,
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

/// The text, if it is digits and nothing else.
fn digits(text: &str) -> Result<&str, ParseError> {
    let all = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    all.then_some(text).ok_or(ParseError::NotANumber)
}

fn integer(text: &str) -> Result<Integer, ParseError> {
    digits(text)?.parse().map_err(|_| ParseError::NotANumber)
}

fn decimal(text: &str) -> Result<Rational, ParseError> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => {
            let (negative, exponent) = sign(exponent);
            // More than an i32 holds is out of range, whatever it is.
            let size: i32 = digits(exponent)?.parse().unwrap_or(i32::MAX);
            (mantissa, if negative { -size } else { size })
        }
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = integer(&format!("{whole}{fraction}"))?;
    if exponent.abs() > MAX_EXPONENT {
        return Err(ParseError::Exponent);
    }
    let shift = i64::from(exponent) - fraction.len() as i64;
    let power = Integer::from(10).pow(u32::try_from(shift.unsigned_abs()).map_err(|_| ParseError::Exponent)?);
    Ok(if shift < 0 { Rational::from((digits, power)) } else { Rational::from(digits * power) })
}

impl Mpfr {
    /// The number that `text` spells, rounded once to `precision` bits.
    ///
    /// # Errors
    /// The text is no number.
    ///
    /// # Panics
    /// The precision is not in [`PRECISIONS`](super::PRECISIONS).
    pub fn parse(text: &str, precision: u32) -> Result<Self, ParseError> {
        Ok(text.parse::<Exact>()?.to_mpfr(precision))
    }
}
