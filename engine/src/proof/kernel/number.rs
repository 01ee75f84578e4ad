//! Rational numbers: of machine integers where these suffice, as nearly everywhere, and of GMP's elsewhere.

use super::effort;
use crate::operators;
use rug::Rational;
use std::cmp::Ordering;

/// A rational number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number(Size);

/// In lowest terms, with a positive denominator; large if not both fit 64 bits. So equal numbers are written
/// alike.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Size {
    Small(i64, i64),
    Large(Box<Rational>),
}

use Size::{Large, Small};

// Products of two integers of 64 bits fit 127 bits, and sums of two of these fit 128.
operators! { [] Number;
    Add add |a, b| match (&a.0, &b.0) {
        (Small(n, d), Small(m, e)) => {
            let [n, d, m, e] = [n, d, m, e].map(wide);
            Number::quotient(n * e + m * d, d * e)
        }
        _ => Number::large(a.rational() + b.rational()),
    };
    Sub sub |a, b| a + -b;
    Mul mul |a, b| match (&a.0, &b.0) {
        (Small(n, d), Small(m, e)) => Number::quotient(wide(n) * wide(m), wide(d) * wide(e)),
        _ => Number::large(a.rational() * b.rational()),
    };
    - |a| match &a.0 {
        Small(n, d) => Number::quotient(-wide(n), wide(d)),
        Large(_) => (-a.rational()).into(),
    }
}

fn wide(n: &i64) -> i128 {
    (*n).into()
}

/// The greatest common divisor of two numbers that are not 0.
fn common_divisor(mut a: u128, mut b: u128) -> u128 {
    let twos = (a | b).trailing_zeros();
    a >>= a.trailing_zeros();
    b >>= b.trailing_zeros();
    // Both are odd: 2 does not divide them, and may be taken out of their difference.
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
    /// A quotient; the denominator is positive.
    fn quotient(n: i128, d: i128) -> Self {
        let common = if n == 0 { d } else { common_divisor(n.unsigned_abs(), d.unsigned_abs()) as i128 };
        match (i64::try_from(n / common), i64::try_from(d / common)) {
            (Ok(n), Ok(d)) => Number(Small(n, d)),
            _ => Rational::from((n, d)).into(),
        }
    }

    /// One that may have many digits.
    fn large(q: Rational) -> Self {
        effort::spend((q.numer().significant_digits::<u64>() + q.denom().significant_digits::<u64>()) / 8);
        q.into()
    }

    /// As one of GMP's.
    pub fn rational(&self) -> Rational {
        match &self.0 {
            Small(n, d) => Rational::from((*n, *d)),
            Large(q) => (**q).clone(),
        }
    }

    /// Returns the float nearby.
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            Small(n, d) => *n as f64 / *d as f64,
            Large(q) => q.to_f64(),
        }
    }

    /// Its sign, compared with 0.
    pub fn sign(&self) -> Ordering {
        match &self.0 {
            Small(n, _) => n.cmp(&0),
            Large(q) => q.cmp0(),
        }
    }

    /// Is it 1?
    pub fn is_one(&self) -> bool {
        self.0 == Small(1, 1)
    }

    /// Its size.
    pub fn abs(&self) -> Self {
        if self.sign().is_lt() { -self } else { self.clone() }
    }

    /// 1/x, of what is not 0.
    pub fn recip(&self) -> Self {
        self.rational().recip().into()
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Self) -> Ordering {
        self.rational().cmp(&other.rational())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quotients of numbers at the ends of 64 bits, around 0, and beyond.
    fn some() -> Vec<Rational> {
        let ends = [i64::MIN, i64::MIN + 1, -6, -1, 0, 1, 4, 1 << 40, i64::MAX - 1, i64::MAX];
        let small = ends.iter().flat_map(|n| [1, 2, 3, 1 << 50, i64::MAX].map(|d| Rational::from((*n, d))));
        let all: Vec<_> = small.collect();
        let large = all.iter().map(|q| Rational::from(q * q));
        all.iter().cloned().chain(large).collect()
    }

    #[test]
    fn arithmetic_is_that_of_rationals_of_any_size() {
        let of = |q: &Rational| Number::from(q.clone());
        for p in some() {
            let x = of(&p);
            assert_eq!((x.rational(), x.sign(), x.is_one()), (p.clone(), p.cmp0(), p == 1));
            assert_eq!((-&x, x.abs()), (of(&Rational::from(-&p)), of(&p.clone().abs())));
            assert!(p.is_zero() || x.recip() == of(&p.clone().recip()));
            for q in some() {
                let y = of(&q);
                // Equal numbers are written alike, too.
                assert_eq!(&x + &y, of(&Rational::from(&p + &q)), "{p} + {q}");
                assert_eq!(&x - &y, of(&Rational::from(&p - &q)), "{p} - {q}");
                assert_eq!(&x * &y, of(&Rational::from(&p * &q)), "{p} * {q}");
                assert_eq!((x == y, x.partial_cmp(&y)), (p == q, Some(p.cmp(&q))), "{p} and {q}");
            }
        }
    }
}
