//! Number systems by name.

use super::{Exact, PRECISIONS, RangeError};
use num_traits::Zero;
use rug::{Float, float::Round, ops::AssignRound};
use std::{cmp::Ordering, fmt, str::FromStr};

/// Binary floating-point format of a fixed precision and range, with subnormal numbers.
///
/// # Examples
///
/// ```
/// use provable::number::FloatFormat;
/// assert_eq!(FloatFormat::F16.bits, 11);
/// assert_eq!(FloatFormat::F16.min_normal(), "0x1p-14".parse()?); // 2⁻¹⁴
/// # Ok::<(), provable::number::ParseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FloatFormat {
    /// Name of the type.
    pub name: &'static str,
    /// Number of binary digits of a normal number.
    pub bits: u32,
    /// Exponents of the smallest and of the largest power of two among the normal numbers.
    pub exponents: [i32; 2],
}

impl FloatFormat {
    /// Half precision, binary16.
    pub const F16: Self = FloatFormat { name: "f16", bits: 11, exponents: [-14, 15] };
    /// The upper half of single precision, bfloat16.
    pub const BF16: Self = FloatFormat { name: "bf16", bits: 8, exponents: [-126, 127] };
    /// Single precision, binary32.
    pub const F32: Self = FloatFormat { name: "f32", bits: 24, exponents: [-126, 127] };
    /// Double precision, binary64.
    pub const F64: Self = FloatFormat { name: "f64", bits: 53, exponents: [-1022, 1023] };

    /// Returns the smallest normal number.
    pub fn min_normal(&self) -> Exact {
        Exact::power_of_two(self.exponents[0])
    }

    /// Rounds a finite number once to one that this format represents, ties to even.
    pub(super) fn round<V>(&self, number: V) -> Result<(Float, Ordering), RangeError>
    where
        Float: AssignRound<V, Round = Round, Ordering = Ordering>,
    {
        let (x, ordering) = Float::with_val_round(self.bits, number, Round::Nearest);
        self.fit(x, ordering)
    }

    /// Rounds a finite number of the format's precision to its range; `ordering` is that of the rounding to this
    /// precision, after which a subnormal number is still rounded once.
    pub(super) fn fit(&self, mut x: Float, ordering: Ordering) -> Result<(Float, Ordering), RangeError> {
        let zero = x.is_zero();
        // MPFR's significands are less than 1, and its exponents larger by 1.
        let ordering = x.subnormalize_round(self.exponents[0] + 1, ordering, Round::Nearest);
        match x.get_exp() {
            Some(exponent) if exponent > self.exponents[1] + 1 => {
                Err(RangeError::Overflow { scalar: self.name })
            }
            None if !zero => Err(RangeError::Underflow { scalar: self.name }),
            _ => Ok((x, ordering)),
        }
    }
}

/// Number system by its name: `f16`, `bf16`, `f32`, `f64`, `mpfr:BITS` or `exact`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NumberSystem {
    /// A binary floating-point format.
    Float(FloatFormat),
    /// [`Mpfr`](super::Mpfr) with this many bits.
    Mpfr(u32),
    /// [`Exact`](super::Exact) rationals.
    Exact,
}

impl fmt::Display for NumberSystem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            NumberSystem::Float(format) => f.pad(format.name),
            NumberSystem::Mpfr(bits) => f.pad(&format!("mpfr:{bits}")),
            NumberSystem::Exact => f.pad("exact"),
        }
    }
}

impl NumberSystem {
    /// Half precision.
    pub const F16: Self = NumberSystem::Float(FloatFormat::F16);
    /// The upper half of single precision.
    pub const BF16: Self = NumberSystem::Float(FloatFormat::BF16);
    /// Single precision.
    pub const F32: Self = NumberSystem::Float(FloatFormat::F32);
    /// Double precision.
    pub const F64: Self = NumberSystem::Float(FloatFormat::F64);

    /// Number systems whose names have no parameter.
    const NAMED: [Self; 5] = [Self::F16, Self::BF16, Self::F32, Self::F64, NumberSystem::Exact];

    /// Returns η, the largest error of one rounding relative to the result; 0 for rationals.
    pub fn unit_roundoff(self) -> Exact {
        let bits = match self {
            NumberSystem::Float(FloatFormat { bits, .. }) | NumberSystem::Mpfr(bits) => bits,
            NumberSystem::Exact => return Exact::zero(),
        };
        Exact::power_of_two(-i32::try_from(bits).expect("precisions are small"))
    }
}

/// The text is not the name of a number system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("must be f16, bf16, f32, f64, mpfr:BITS with 2 to 1000000 bits, or exact")]
pub struct UnknownNumberSystem;

impl FromStr for NumberSystem {
    type Err = UnknownNumberSystem;
    fn from_str(text: &str) -> Result<Self, UnknownNumberSystem> {
        if let Some(named) = Self::NAMED.into_iter().find(|named| named.to_string() == text) {
            return Ok(named);
        }
        let digits = text.strip_prefix("mpfr:").filter(|d| d.bytes().all(|b| b.is_ascii_digit()));
        let bits = digits.and_then(|digits| digits.parse().ok());
        bits.filter(|bits| PRECISIONS.contains(bits)).map(NumberSystem::Mpfr).ok_or(UnknownNumberSystem)
    }
}
