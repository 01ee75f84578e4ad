//! Rational numbers: of machine integers where these suffice, as nearly everywhere, and of GMP's elsewhere.

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
        (Small(n, d), Small(m, e)) => Number::quotient(wide(n) * wide(e) + wide(m) * wide(d), wide(d) * wide(e)),
        _ => (a.rational() + b.rational()).into(),
    };
    Sub sub |a, b| a + -b;
    Mul mul |a, b| match (&a.0, &b.0) {
        (Small(n, d), Small(m, e)) => Number::quotient(wide(n) * wide(m), wide(d) * wide(e)),
        _ => (a.rational() * b.rational()).into(),
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

    /// As one of GMP's.
    pub fn rational(&self) -> Rational {
        match &self.0 {
            Small(n, d) => Rational::from((*n, *d)),
            Large(q) => (**q).clone(),
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
