//! The numbers of the search.

use crate::number::{Ball, Exact, Exponential, Field, PositivePart};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::fmt;

/// A number: exact, or enclosed if an eˣ went into it.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// This rational number.
    Exact(Exact),
    /// A number in this ball.
    Ball(Ball<f64>),
}

impl Value {
    fn ball(&self) -> Ball<f64> {
        match self {
            // A number that f64 cannot hold is anywhere.
            Value::Exact(x) => Ball::around(&0.0, x).unwrap_or_else(|_| Ball::one() / Ball::zero()),
            Value::Ball(ball) => ball.clone(),
        }
    }

    /// Its sign, if that is certain.
    pub fn sign(&self) -> Option<Ordering> {
        match self {
            Value::Exact(x) => Some(x.cmp(&Exact::zero())),
            Value::Ball(ball) => Some(ball).filter(|ball| ball.is_finite()).and_then(Ball::sign),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Value::Exact(x) => x.fmt(f),
            Value::Ball(ball) => write!(f, "{} ± {:.0e}", ball.value(), ball.radius()),
        }
    }
}

macro_rules! either {
    ($a:expr, $b:expr, |$x:ident, $y:ident| $result:expr) => {
        match ($a, $b) {
            (Value::Exact($x), Value::Exact($y)) => Value::Exact($result),
            (a, b) => {
                let ($x, $y) = (&a.ball(), &b.ball());
                Value::Ball($result)
            }
        }
    };
}

operators! { [] Value;
    Add add |a, b| either!(a, b, |x, y| x + y);
    Sub sub |a, b| either!(a, b, |x, y| x - y);
    Mul mul |a, b| either!(a, b, |x, y| x * y);
    Div div |a, b| either!(a, b, |x, y| x / y);
    - |a| match a {
        Value::Exact(x) => Value::Exact(-x),
        Value::Ball(ball) => Value::Ball(-ball),
    }
}
impl Zero for Value {
    fn zero() -> Self {
        Value::Exact(Exact::zero())
    }
    fn is_zero(&self) -> bool {
        self.sign() == Some(Ordering::Equal)
    }
}
impl One for Value {
    fn one() -> Self {
        Value::Exact(Exact::one())
    }
}
impl Field for Value {
    fn int(n: i32) -> Self {
        Value::Exact(Exact::int(n))
    }
    // By default, whatever is not certainly 0 is a unit: by a ball around 0 the quotient is a ball of
    // infinite radius, which decides nothing. So what is undefined is undefined for certain.
}
impl Exponential for Value {
    fn exp(&self) -> Self {
        if self.is_zero() { Value::one() } else { Value::Ball(self.ball().exp()) }
    }
}
impl PositivePart for Value {
    fn positive_part(&self) -> Self {
        match self {
            Value::Exact(x) => Value::Exact(x.positive_part()),
            Value::Ball(ball) => Value::Ball(ball.positive_part()),
        }
    }
    fn min(&self, other: &Self) -> Self {
        either!(self, other, |x, y| PositivePart::min(x, y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stay_exact_until_there_is_an_exponential() {
        assert_eq!(Value::zero().exp(), Value::one());
        let e = Value::one().exp();
        assert_eq!((&e - Value::int(2)).sign(), Some(Ordering::Greater));
        // Rounding leaves this open, and so is everything after a division by it.
        let nothing = &e * (-Value::one()).exp() - Value::one();
        assert_eq!(nothing.sign(), None);
        assert_eq!((Value::one() / nothing).sign(), None);
        assert!((&e * Value::zero()).is_zero());
        assert_eq!(Value::int(10_000).exp().sign(), None);
        // What f64 cannot hold is anywhere, too.
        assert_eq!((&e * Value::Exact(Exact::power_of_two(2000))).sign(), None);
    }
}
