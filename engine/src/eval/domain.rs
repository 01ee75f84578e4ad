//! Numbers in which statements are evaluated.

use crate::formula::Relation;
use crate::number::tree::{Op, all_ops, piecewise_ops};
use crate::number::{Ball, Exact, Exponential, Field, PositivePart, RangeError, Real, ToExact};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::fmt;

/// Numbers in which statements are evaluated. By default they are not compared.
pub trait Domain {
    /// A number, or what is known of it.
    type Value: Clone;

    /// Returns the result of an operation that is not a symbol; `None` if it is undefined.
    fn apply(&self, op: Op<&Self::Value>) -> Option<Self::Value>;

    /// Returns the value of the rounding at this place of the program, if it does not follow from the value of
    /// its operand.
    fn rounded(&self, _place: usize) -> Option<Self::Value> {
        None
    }

    /// Returns the sign of a number if it is certain.
    fn sign(&self, _x: &Self::Value) -> Option<Ordering> {
        None
    }

    /// Returns whether two numbers are equal; of enclosures, whether they may be.
    fn are_equal(&self, _x: &Self::Value, _y: &Self::Value) -> Option<bool> {
        None
    }

    /// Returns whether a number is at most a bound in absolute value, if this is certain.
    fn is_within(&self, _x: &Self::Value, _bound: &Self::Value) -> Option<bool> {
        None
    }

    /// Returns the number, if it is known exactly. Limits are evaluated for such numbers only.
    fn exact(&self, _: &Self::Value) -> Option<Exact> {
        None
    }

    /// Returns whether a number has this sign, if this is certain.
    fn admits(&self, relation: Relation, x: &Self::Value) -> Option<bool> {
        self.sign(x).map(|sign| relation.admits(sign))
    }
}

/// Rational numbers, with balls for what depends on eˣ.
#[derive(Clone, Debug)]
pub struct Rationals {
    /// 2ᵖ for the precision to which roundings round.
    pub precision: Exact,
}

/// An exact number, or an enclosure of a number that depends on eˣ.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A rational number.
    Exact(Exact),
    /// An enclosure of a number.
    Ball(Ball<f64>),
}

impl Value {
    /// Returns the number, if it is known exactly.
    pub fn exact(&self) -> Option<&Exact> {
        match self {
            Value::Exact(x) => Some(x),
            Value::Ball(_) => None,
        }
    }

    pub(super) fn ball(&self) -> Ball<f64> {
        match self {
            // A number outside the range of f64 has an infinite enclosure.
            Value::Exact(x) => Ball::enclosing(&0.0, x).unwrap_or_else(|_| unknown()),
            Value::Ball(ball) => ball.clone(),
        }
    }
}

/// Returns `true` if |x| ≤ bound.
pub(super) fn is_within(x: &Exact, bound: &Exact) -> bool {
    *bound >= Exact::zero() && x.as_rational().cmp_abs(bound.as_rational()).is_le()
}

/// Returns the enclosure of all numbers.
fn unknown() -> Ball<f64> {
    Ball::one() / (Ball::one() / Ball::int(3) * Ball::int(3) - Ball::one())
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Value::Exact(x) => x.fmt(f),
            Value::Ball(ball) => write!(f, "{} ± {:.0e}", ball.value(), ball.radius()),
        }
    }
}

impl Rationals {
    /// Returns the rationals for statements without roundings.
    pub fn unrounded() -> Self {
        Rationals { precision: Exact::one() }
    }

    /// Returns an exact number rounded to the precision; `None` unless that is at least 2 bits.
    pub(super) fn round(&self, x: &Exact) -> Option<Exact> {
        let n = self.precision.as_rational();
        let is_power = n.numer().is_power_of_two() && *n.denom() == 1;
        x.round_to_bits(is_power.then(|| n.numer().significant_bits() - 1).filter(|bits| *bits >= 2)?)
    }
}

impl Domain for Rationals {
    type Value = Value;

    fn apply(&self, op: Op<&Value>) -> Option<Value> {
        match op.try_map(|value| value.exact()) {
            Some(Op::Exp(x)) if x.is_zero() => Some(Value::Exact(Exact::one())),
            Some(Op::Rounded(x)) => Some(self.round(x).map_or_else(|| Value::Ball(unknown()), Value::Exact)),
            Some(Op::Div(_, divisor)) if divisor.is_zero() => None,
            Some(op) if !matches!(op, Op::Exp(_)) => {
                op.arithmetic().or_else(|| piecewise_ops(op)).map(Value::Exact)
            }
            // An enclosed value may round to either of two numbers.
            _ => match op.map(|value| value.ball()) {
                Op::Rounded(_) => Some(Value::Ball(unknown())),
                op => Balls(0.0).apply(op.map(|ball| ball)).map(Value::Ball),
            },
        }
    }

    fn sign(&self, x: &Value) -> Option<Ordering> {
        match x {
            Value::Exact(x) => Some(x.cmp(&Exact::zero())),
            Value::Ball(ball) => Some(ball).filter(|ball| ball.is_finite()).and_then(Ball::sign),
        }
    }

    fn are_equal(&self, x: &Value, y: &Value) -> Option<bool> {
        match (x, y) {
            (Value::Exact(x), Value::Exact(y)) => Some(x == y),
            (x, y) => self.sign(&Value::Ball(x.ball() - y.ball())).map(Ordering::is_eq),
        }
    }

    fn is_within(&self, x: &Value, bound: &Value) -> Option<bool> {
        match (x, bound) {
            (Value::Exact(x), Value::Exact(bound)) => Some(is_within(x, bound)),
            (x, bound) => Balls(0.0).is_within(&x.ball(), &bound.ball()),
        }
    }

    fn exact(&self, x: &Value) -> Option<Exact> {
        x.exact().cloned()
    }
}

/// Enclosures by balls of a scalar; the field determines its precision.
#[derive(Clone, Debug)]
pub struct Balls<T>(pub T);

impl<T: Real + ToExact> Balls<T> {
    /// Encloses a number.
    ///
    /// # Errors
    /// Returns an error if the number is out of range.
    pub fn enclose(&self, x: &Exact) -> Result<Ball<T>, RangeError> {
        Ball::enclosing(&self.0, x)
    }
}

impl<T: Real + Exponential> Domain for Balls<T> {
    type Value = Ball<T>;

    fn apply(&self, op: Op<&Ball<T>>) -> Option<Ball<T>> {
        // The quotient by a ball that contains 0 is unbounded.
        op.arithmetic().or_else(|| all_ops(op)).filter(|result| !result.is_undefined())
    }

    fn sign(&self, x: &Ball<T>) -> Option<Ordering> {
        x.sign()
    }

    fn is_within(&self, x: &Ball<T>, bound: &Ball<T>) -> Option<bool> {
        let margin = (bound - x.abs()).sign();
        margin.map(Ordering::is_ge)
    }

    fn are_equal(&self, x: &Ball<T>, y: &Ball<T>) -> Option<bool> {
        let difference = x - y;
        difference.is_finite().then(|| difference.value().abs() <= *difference.radius())
    }
}
