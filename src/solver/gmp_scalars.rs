//! MPFR numbers, floats of num-traits and rationals as scalars.

use crate::number::{Ball, Exact, ExactText, Mpfr, Native, PositivePart, Real, ToExact};
use crate::solver::scalar::{MAX_BITS, by_ball, power};
use crate::solver::{Interval, Scalar};
use num_traits::{Float, Zero};
use rug::float::Round;
use std::cmp::Ordering;
use std::fmt::Debug;

/// Returns `true` if xᵏ has at most [`MAX_BITS`] binary digits.
fn can_be_written(x: &Exact, k: u64) -> bool {
    x.bit_length().checked_mul(k).is_some_and(|digits| digits <= MAX_BITS)
}

impl<T: ExactText> Interval<T> {
    /// Returns both bounds as texts that still enclose.
    ///
    /// # Examples
    ///
    /// ```
    /// # use spring_mass_contact::solver::Interval;
    /// // The f64 beside 0.1 is a little larger than 0.1.
    /// assert_eq!(Interval { lower: 0.1, upper: 0.1 }.texts(), ["0.1", "0.10000000000000002"]);
    /// ```
    pub fn texts(&self) -> [String; 2] {
        [self.lower.bound(Round::Down), self.upper.bound(Round::Up)]
    }
}

by_ball! {
    [T: Float + Debug] Native<T>, sign_of_sum,
    fn has_exact_value(&self) -> bool {
        self.to_exact().is_ok()
    };
    [] Mpfr, sign_of_sum,
    fn power(x: &Ball<Mpfr>, k: u64) -> Option<Ball<Mpfr>> {
        // A constant is a rational, and its powers grow in the same way.
        let rational = x.value().precision().is_none().then(|| x.value().to_exact().ok()).flatten();
        rational.is_none_or(|x| can_be_written(&x, k)).then(|| power(x, k))
    },
    fn variable_bit_length(&self) -> u64 {
        // A constant is a rational.
        let constant = self.precision().is_none().then(|| self.to_exact().ok()).flatten();
        constant.map_or(0, |x| x.bit_length())
    };
}

fn sign_of_sum<T: ToExact>([a, b]: [(&T, &T); 2], minus: (&T, &T)) -> Ordering {
    (product(a) + product(b)).cmp(&product(minus))
}

/// Returns the exact product of finite numbers. Others are refused before a sign is computed.
fn product<T: ToExact>((a, b): (&T, &T)) -> Exact {
    let [x, y] = [a, b].map(|x| x.to_exact().unwrap_or_else(|_| Exact::zero()));
    x * y
}

impl Scalar for Exact {
    type Enclosure = Exact;
    fn enclose(&self) -> Exact {
        self.clone()
    }
    fn interval(x: &Exact) -> Interval<Self> {
        Interval { lower: x.clone(), upper: x.clone() }
    }
    fn magnitude(x: &Exact) -> Self {
        x.abs()
    }
    fn sign(x: &Exact) -> Option<Ordering> {
        Some(x.cmp(&Exact::zero()))
    }
    fn power(x: &Exact, k: u64) -> Option<Exact> {
        can_be_written(x, k).then(|| power(x, k))
    }
    fn is_finite(&self) -> bool {
        true
    }
    fn variable_bit_length(&self) -> u64 {
        self.bit_length()
    }
    fn sign_of_sum(plus: [(&Self, &Self); 2], minus: (&Self, &Self)) -> Ordering {
        (plus[0].0 * plus[0].1 + plus[1].0 * plus[1].1).cmp(&(minus.0 * minus.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_rationals_and_constants_grow() {
        let third = rug::Rational::from((1, 3));
        let float = rug::Float::with_val(64, &third);
        assert_eq!(Exact::from(third.clone()).variable_bit_length(), 3);
        assert_eq!(Mpfr::constant(third).variable_bit_length(), 3);
        assert_eq!([Mpfr::from(float).variable_bit_length(), 1.5_f64.variable_bit_length()], [0; 2]);
    }
}
