//! Reference rounding in integers.

use num_traits::Zero;
use provable::number::{Exact, PositivePart};
use rug::float::Round;
use rug::{Float, Integer, Rational};
use std::cmp::Ordering;

/// Binary floats m·2ᵉ with |m| < 2^bits.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    pub bits: u32,
    /// Exponents e of drawn numbers.
    pub least: i32,
    pub greatest: i32,
    /// Whether the range of exponents is limited, as in f32 and f64.
    pub bounded: bool,
}

pub const HALF: Format = Format { bits: 11, least: -24, greatest: 5, bounded: true };
pub const BRAIN: Format = Format { bits: 8, least: -133, greatest: 120, bounded: true };
pub const SINGLE: Format = Format { bits: 24, least: -149, greatest: 104, bounded: true };
pub const DOUBLE: Format = Format { bits: 53, least: -1074, greatest: 971, bounded: true };

impl Format {
    pub const fn unbounded(bits: u32) -> Self {
        Format { bits, least: -300, greatest: 300, bounded: false }
    }

    /// Returns the format with drawn numbers limited to 2^low ≤ |x| < 2^high.
    pub fn within(self, low: i32, high: i32) -> Self {
        let bits = self.bits.cast_signed();
        Format { least: self.least.max(low - bits), greatest: self.greatest.min(high - bits), ..self }
    }

    /// Returns the distance of two neighbours at `x`.
    pub fn unit(&self, x: &Exact) -> Exact {
        let lowest = if self.bounded { self.least } else { i32::MIN };
        let exponent = if x.is_zero() { self.least } else { magnitude(x) - self.bits.cast_signed() + 1 };
        Exact::power_of_two(exponent.max(lowest))
    }

    /// Rounds to nearest, ties to even, with unlimited exponents.
    pub fn round(&self, x: &Exact) -> Exact {
        if x.is_zero() {
            return Exact::zero();
        }
        let unit = self.unit(x);
        let scaled = Rational::from(x / &unit);
        let floor = Integer::from(scaled.floor_ref());
        let above_half = (scaled - &floor).cmp(&Rational::from((1, 2)));
        let up = above_half.is_gt() || (above_half.is_eq() && floor.is_odd());
        Exact::from(Rational::from(floor + i32::from(up))) * unit
    }

    pub fn largest(&self) -> Exact {
        Exact::from(Rational::from((Integer::from(1) << self.bits) - 1u32))
            * Exact::power_of_two(self.greatest)
    }

    /// Rounds to the nearest finite float.
    pub fn fit(&self, x: &Exact) -> Exact {
        self.round(x).clamp(-self.largest(), self.largest())
    }
}

/// Returns e with 2ᵉ ≤ |x| < 2ᵉ⁺¹ for x ≠ 0.
pub fn magnitude(x: &Exact) -> i32 {
    let q = x.as_rational();
    let e = q.numer().significant_bits().cast_signed() - q.denom().significant_bits().cast_signed();
    if x.abs() < Exact::power_of_two(e) { e - 1 } else { e }
}

/// Returns f(x) for an increasing f, rounded down and up to `bits` bits.
pub fn bracket(x: &Exact, bits: u32, f: fn(&mut Float, Round) -> Ordering) -> (Exact, Exact) {
    let end = |round| {
        let (mut y, _) = Float::with_val_round(bits, x.as_rational(), round);
        f(&mut y, round);
        Exact::from(y.to_rational().expect("finite"))
    };
    (end(Round::Down), end(Round::Up))
}

/// Returns a number that rounds like f(x): both bounds round to the same float with enough bits, since f(x)
/// is irrational except for x = 0 (ln: 1), where the bounds are equal.
pub fn rounds_as(format: Format, x: &Exact, f: fn(&mut Float, Round) -> Ordering) -> Exact {
    let mut bits = 2 * format.bits + 64;
    loop {
        let (low, high) = bracket(x, bits, f);
        if format.round(&low) == format.round(&high) {
            return low;
        }
        bits *= 2;
    }
}
