//! Rational numbers, stored as machine integers where these suffice and as GMP integers otherwise.

use crate::operators;
use rug::Rational;
use std::cmp::Ordering;

/// Maximum number of binary digits of a coefficient; the checker accepts 127.
const MAX_BITS: u32 = 4096;

/// A rational number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number(Representation);

/// Numerator and denominator in lowest terms, with a positive denominator; `Large` only if they do not both
/// fit 64 bits. So equal numbers have equal representations.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Representation {
    Small(i64, i64),
    Large(Box<Rational>),
}

use Representation::{Large, Small};

// Products of two 64-bit integers fit 127 bits, and sums of two such products fit 128 bits.
operators! { [] Number;
    Add add |a, b| match (&a.0, &b.0) {
        (Small(n, d), Small(m, e)) => {
            let [n, d, m, e] = [n, d, m, e].map(wide);
            Number::quotient(n * e + m * d, d * e)
        }
        _ => (a.to_rational() + b.to_rational()).into(),
    };
    Sub sub |a, b| a + -b;
    Mul mul |a, b| match (&a.0, &b.0) {
        (Small(n, d), Small(m, e)) => Number::quotient(wide(n) * wide(m), wide(d) * wide(e)),
        _ => (a.to_rational() * b.to_rational()).into(),
    };
    - |a| match &a.0 {
        Small(n, d) => Number::quotient(-wide(n), wide(d)),
        Large(_) => (-a.to_rational()).into(),
    }
}

fn wide(n: &i64) -> i128 {
    (*n).into()
}

/// Computes the greatest common divisor of two numbers, one of which may be 0.
fn common_divisor(mut a: u128, mut b: u128) -> u128 {
    if a == 0 || b == 0 {
        return a | b;
    }
    let twos = (a | b).trailing_zeros();
    a >>= a.trailing_zeros();
    b >>= b.trailing_zeros();
    // Both are odd, so factors 2 can be removed from their difference.
    while a != b && a != 1 && b != 1 {
        (a, b) = (a.abs_diff(b), a.min(b));
        a >>= a.trailing_zeros();
    }
    if a == b { a << twos } else { 1 << twos }
}

impl From<i32> for Number {
    fn from(n: i32) -> Self {
        Number(Small(n.into(), 1))
    }
}

impl From<(i32, i32)> for Number {
    fn from(quotient: (i32, i32)) -> Self {
        Rational::from(quotient).into()
    }
}

impl From<Rational> for Number {
    fn from(q: Rational) -> Self {
        match (q.numer().to_i64(), q.denom().to_i64()) {
            (Some(n), Some(d)) => Number(Small(n, d)),
            _ => Number(Large(q.into())),
        }
    }
}

impl Number {
    /// Reduces n/d to lowest terms; `d` must be positive.
    fn quotient(n: i128, d: i128) -> Self {
        if d == 1
            && let Ok(n) = i64::try_from(n)
        {
            return Number(Small(n, 1));
        }
        let common = common_divisor(n.unsigned_abs(), d.unsigned_abs()) as i128;
        match (i64::try_from(n / common), i64::try_from(d / common)) {
            (Ok(n), Ok(d)) => Number(Small(n, d)),
            _ => Rational::from((n, d)).into(),
        }
    }

    /// Returns `true` if numerator and denominator together have more than [`MAX_BITS`] binary digits.
    pub fn is_too_large(&self) -> bool {
        let Large(q) = &self.0 else { return false };
        q.numer().significant_bits() + q.denom().significant_bits() > MAX_BITS
    }

    /// Converts to a rational number of GMP.
    pub fn to_rational(&self) -> Rational {
        match &self.0 {
            Small(n, d) => Rational::from((*n, *d)),
            Large(q) => (**q).clone(),
        }
    }

    /// Converts to an integer, if the number is one that fits 128 bits.
    pub fn to_integer(&self) -> Option<i128> {
        match &self.0 {
            Small(n, d) => (*d == 1).then_some((*n).into()),
            Large(q) => q.numer().to_i128().filter(|_| q.is_integer()),
        }
    }

    /// Returns `true` if the number is an integer.
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Small(_, d) => *d == 1,
            Large(q) => q.is_integer(),
        }
    }

    /// Converts to a nearby float.
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            Small(n, d) => *n as f64 / *d as f64,
            Large(q) => q.to_f64(),
        }
    }

    /// Compares the number with 0.
    pub fn sign(&self) -> Ordering {
        match &self.0 {
            Small(n, _) => n.cmp(&0),
            Large(q) => q.cmp0(),
        }
    }

    /// Returns `true` if the number is 1.
    pub fn is_one(&self) -> bool {
        self.0 == Small(1, 1)
    }

    /// Returns the largest positive number of which both numbers are integral multiples; one of them may be 0.
    pub fn common_divisor(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Small(n, d), Small(m, e)) => {
                let of_numerators = common_divisor(n.unsigned_abs().into(), m.unsigned_abs().into());
                let of_denominators = common_divisor(d.unsigned_abs().into(), e.unsigned_abs().into());
                let multiple = wide(d) / of_denominators as i128 * wide(e);
                Number::quotient(of_numerators as i128, multiple)
            }
            _ => {
                let (a, b) = (self.to_rational(), other.to_rational());
                let numerator = a.numer().clone().gcd(b.numer());
                Rational::from((numerator, a.denom().clone().lcm(b.denom()))).into()
            }
        }
    }

    /// Returns the absolute value.
    pub fn abs(&self) -> Self {
        if self.sign().is_lt() { -self } else { self.clone() }
    }

    /// Returns the reciprocal.
    ///
    /// # Panics
    /// Panics if the number is 0.
    pub fn recip(&self) -> Self {
        self.to_rational().recip().into()
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Self) -> Ordering {
        self.to_rational().cmp(&other.to_rational())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quotients of integers around 0 and at the limits of 64 bits, and their squares.
    fn samples() -> Vec<Rational> {
        let numerators = [i64::MIN, i64::MIN + 1, -6, -1, 0, 1, 4, 1 << 40, i64::MAX - 1, i64::MAX];
        let denominators = [1, 2, 3, 1 << 50, i64::MAX];
        let small = numerators.iter().flat_map(|n| denominators.map(|d| Rational::from((*n, d))));
        let all: Vec<_> = small.collect();
        let large = all.iter().map(|q| Rational::from(q * q));
        all.iter().cloned().chain(large).collect()
    }

    #[test]
    fn arithmetic_agrees_with_gmp_for_numbers_of_any_length() {
        let of = |q: &Rational| Number::from(q.clone());
        for p in samples() {
            let x = of(&p);
            assert_eq!((x.to_rational(), x.sign(), x.is_one()), (p.clone(), p.cmp0(), p == 1));
            assert_eq!((-&x, x.abs()), (of(&Rational::from(-&p)), of(&p.clone().abs())));
            assert!(p.is_zero() || x.recip() == of(&p.clone().recip()));
            for q in samples() {
                let y = of(&q);
                // This compares representations.
                assert_eq!(&x + &y, of(&Rational::from(&p + &q)), "{p} + {q}");
                assert_eq!(&x - &y, of(&Rational::from(&p - &q)), "{p} - {q}");
                assert_eq!(&x * &y, of(&Rational::from(&p * &q)), "{p} * {q}");
                let common = x.common_divisor(&y).to_rational();
                assert!(common.cmp0().is_ge() && (common.is_zero() == (p.is_zero() && q.is_zero())));
                if !common.is_zero() {
                    let [a, b] = [&p, &q].map(|of| Rational::from(of / &common));
                    assert!(a.is_integer() && b.is_integer() && a.numer().clone().gcd(b.numer()) == 1);
                }
                assert_eq!((x == y, x.partial_cmp(&y)), (p == q, Some(p.cmp(&q))), "{p} and {q}");
            }
        }
    }
}
