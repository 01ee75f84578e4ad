//! The number systems by name.

use super::PRECISIONS;
use std::{fmt, str::FromStr};

/// A number system as a user names it: `f32`, `f64`, `mpfr:BITS` or `exact`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NumberSystem {
    /// The machine's single precision.
    F32,
    /// The machine's double precision.
    F64,
    /// [`Mpfr`](super::Mpfr) with this many bits.
    Mpfr(u32),
    /// [`Exact`](super::Exact) rationals.
    Exact,
}

impl fmt::Display for NumberSystem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            NumberSystem::F32 => f.pad("f32"),
            NumberSystem::F64 => f.pad("f64"),
            NumberSystem::Mpfr(bits) => f.pad(&format!("mpfr:{bits}")),
            NumberSystem::Exact => f.pad("exact"),
        }
    }
}

/// The text names no number system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("must be f32, f64, exact or mpfr:BITS with 2 to 1000000 bits")]
pub struct UnknownNumberSystem;

impl FromStr for NumberSystem {
    type Err = UnknownNumberSystem;
    fn from_str(text: &str) -> Result<Self, UnknownNumberSystem> {
        match text {
            "f32" => Ok(NumberSystem::F32),
            "f64" => Ok(NumberSystem::F64),
            "exact" => Ok(NumberSystem::Exact),
            _ => {
                let digits = text.strip_prefix("mpfr:").filter(|d| d.bytes().all(|b| b.is_ascii_digit()));
                let bits = digits.and_then(|digits| digits.parse().ok());
                bits.filter(|bits| PRECISIONS.contains(bits)).map(NumberSystem::Mpfr).ok_or(UnknownNumberSystem)
            }
        }
    }
}
