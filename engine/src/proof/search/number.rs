//! Rational numbers as coefficients.

use crate::operators;
use rug::{Complete, Rational};
use std::ops::Deref;

/// Maximum number of binary digits of a coefficient; the checker accepts 127.
const MAX_BITS: u32 = 4096;

/// A rational number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Number(Rational);

operators! { [] Number;
    Add add |a, b| Number((&a.0 + &b.0).complete());
    Sub sub |a, b| Number((&a.0 - &b.0).complete());
    Mul mul |a, b| Number((&a.0 * &b.0).complete());
    - |a| Number((-&a.0).complete())
}

impl<T: Into<Rational>> From<T> for Number {
    fn from(q: T) -> Self {
        Number(q.into())
    }
}

impl Deref for Number {
    type Target = Rational;
    fn deref(&self) -> &Rational {
        &self.0
    }
}

impl Number {
    /// Returns `true` if numerator and denominator together have more than [`MAX_BITS`] binary digits.
    pub fn is_too_large(&self) -> bool {
        self.0.numer().significant_bits() + self.0.denom().significant_bits() > MAX_BITS
    }

    /// Converts to an integer, if the number is one that fits 128 bits.
    pub fn to_integer(&self) -> Option<i128> {
        self.0.numer().to_i128().filter(|_| self.0.is_integer())
    }

    /// Returns the largest positive number of which both numbers are integral multiples; one of them may be 0.
    pub fn common_divisor(&self, other: &Self) -> Self {
        let numerator = self.0.numer().gcd_ref(other.0.numer()).complete();
        Number(Rational::from((numerator, self.0.denom().lcm_ref(other.0.denom()).complete())))
    }
}
