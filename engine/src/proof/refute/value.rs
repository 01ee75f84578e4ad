//! The values with which the search for counterexamples computes.

use crate::number::{Ball, Exact, Exponential, Field, PositivePart};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::fmt;

/// An exact number, or an enclosure of a number that depends on eˣ.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A rational number.
    Exact(Exact),
    /// An enclosure of a number.
    Ball(Ball<f64>),
}

impl Value {
    fn ball(&self) -> Ball<f64> {
        match self {
            // A number outside the range of f64 has an infinite enclosure.
            Value::Exact(x) => Ball::enclosing(&0.0, x).unwrap_or_else(|_| Ball::one() / Ball::zero()),
            Value::Ball(ball) => ball.clone(),
        }
    }

    /// Returns the sign if it is certain.
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

macro_rules! exact_or_ball {
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
    Add add |a, b| exact_or_ball!(a, b, |x, y| x + y);
    Sub sub |a, b| exact_or_ball!(a, b, |x, y| x - y);
    Mul mul |a, b| exact_or_ball!(a, b, |x, y| x * y);
    Div div |a, b| exact_or_ball!(a, b, |x, y| x / y);
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
    // By default, a value is invertible unless it is certainly 0. Division by a ball around 0 gives a ball of
    // infinite radius, which decides nothing. So a value is undefined only if a divisor is certainly 0.
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
        exact_or_ball!(self, other, |x, y| PositivePart::min(x, y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_exact_unless_they_depend_on_an_exponential() {
        assert_eq!(Value::zero().exp(), Value::one());
        let e = Value::one().exp();
        assert_eq!((&e - Value::int(2)).sign(), Some(Ordering::Greater));
        // The sign of e e⁻¹ − 1 is undecided, and so is that of a quotient by it.
        let zero = &e * (-Value::one()).exp() - Value::one();
        assert_eq!(zero.sign(), None);
        assert_eq!((Value::one() / zero).sign(), None);
        assert!((&e * Value::zero()).is_zero());
        assert_eq!(Value::int(10_000).exp().sign(), None);
        // So is the sign of a number outside the range of f64.
        assert_eq!((&e * Value::Exact(Exact::power_of_two(2000))).sign(), None);
    }
}
