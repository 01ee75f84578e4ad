//! Number systems by name.

use super::{Exact, PRECISIONS};
use num_traits::Zero;
use std::{fmt, str::FromStr};

/// Number system by its name: `f32`, `f64`, `mpfr:BITS` or `exact`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NumberSystem {
    /// Single precision.
    F32,
    /// Double precision.
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

impl NumberSystem {
    /// Returns η, the largest error of one rounding relative to the result; 0 for rationals.
    pub fn unit_roundoff(self) -> Exact {
        let bits = match self {
            NumberSystem::F32 => f32::MANTISSA_DIGITS,
            NumberSystem::F64 => f64::MANTISSA_DIGITS,
            NumberSystem::Mpfr(bits) => bits,
            NumberSystem::Exact => return Exact::zero(),
        };
        Exact::power_of_two(-i32::try_from(bits).expect("precisions are small"))
    }
}

/// The text is not the name of a number system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("must be f32, f64, mpfr:BITS with 2 to 1000000 bits, or exact")]
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
                bits.filter(|bits| PRECISIONS.contains(bits))
                    .map(NumberSystem::Mpfr)
                    .ok_or(UnknownNumberSystem)
            }
        }
    }
}
