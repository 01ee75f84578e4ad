//! Numbers in which statements are evaluated.

use crate::formula::Relation;
use crate::number::tree::{Op, all_ops, piecewise_ops};
use crate::number::{Ball, Exact, Exponential, PositivePart, RangeError, Real, ToExact};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::fmt;

/// Knowledge of a number, which decides statements.
pub trait Decidable {
    /// Returns the sign of the number if it is certain.
    fn sign(&self) -> Option<Ordering>;

    /// Returns whether two numbers are equal; of enclosures, whether they may be.
    fn is_equal(&self, other: &Self) -> Option<bool>;

    /// Returns whether the number is at most a bound in absolute value, if this is certain.
    fn is_within(&self, bound: &Self) -> Option<bool>;

    /// Returns the number, if it is known exactly. Limits are evaluated for such numbers only.
    fn exact(&self) -> Option<&Exact> {
        None
    }

    /// Returns whether the number has this sign, if this is certain.
    fn admits(&self, relation: Relation) -> Option<bool> {
        self.sign().map(|sign| relation.admits(sign))
    }
}

/// Numbers in which formulas are evaluated.
pub trait Domain {
    /// A number.
    type Value: Clone;

    /// Returns the result of an operation that is not a symbol; `None` if it is undefined.
    fn apply(&self, op: Op<&Self::Value>) -> Option<Self::Value>;

    /// Returns the value of the rounding at this place of the program, if it does not follow from the value of
    /// its operand.
    fn rounded(&self, _place: usize) -> Option<Self::Value> {
        None
    }
}

impl<D: Domain> Domain for &D {
    type Value = D::Value;

    fn apply(&self, op: Op<&Self::Value>) -> Option<Self::Value> {
        (**self).apply(op)
    }

    fn rounded(&self, place: usize) -> Option<Self::Value> {
        (**self).rounded(place)
    }
}

/// Rational numbers; balls enclose values that depend on eˣ.
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
    /// Returns the enclosure of all numbers.
    pub fn unknown() -> Self {
        Value::Ball(Ball::entire())
    }

    /// Returns an enclosure, which is infinite for a number outside the range of f64.
    pub(super) fn ball(&self) -> Ball<f64> {
        match self {
            Value::Exact(x) => Ball::enclosing(&0.0, x).unwrap_or_else(|_| Ball::entire()),
            Value::Ball(ball) => ball.clone(),
        }
    }

    /// Returns the result of an operation without roundings; `None` if it is undefined.
    pub(super) fn of(op: Op<&Value>) -> Option<Value> {
        match op.try_map(|value| value.exact()) {
            Some(Op::Exp(x)) if x.is_zero() => Some(Value::Exact(Exact::one())),
            Some(Op::Div(_, divisor)) if divisor.is_zero() => None,
            Some(op) if !matches!(op, Op::Exp(_)) => {
                op.arithmetic().or_else(|| piecewise_ops(op)).map(Value::Exact)
            }
            _ => Balls(0.0).apply(op.map(|value| value.ball()).map(|ball| ball)).map(Value::Ball),
        }
    }
}

impl Decidable for Value {
    fn sign(&self) -> Option<Ordering> {
        match self {
            Value::Exact(x) => Some(x.cmp(&Exact::zero())),
            Value::Ball(ball) => Some(ball).filter(|ball| ball.is_finite()).and_then(Ball::sign),
        }
    }

    fn is_equal(&self, other: &Self) -> Option<bool> {
        match (self, other) {
            (Value::Exact(x), Value::Exact(y)) => Some(x == y),
            (x, y) => Value::Ball(x.ball() - y.ball()).sign().map(Ordering::is_eq),
        }
    }

    fn is_within(&self, bound: &Self) -> Option<bool> {
        match (self, bound) {
            (Value::Exact(x), Value::Exact(bound)) => {
                let is_smaller = x.as_rational().cmp_abs(bound.as_rational()).is_le();
                Some(is_smaller && *bound >= Exact::zero())
            }
            (x, bound) => x.ball().is_within(&bound.ball()),
        }
    }

    fn exact(&self) -> Option<&Exact> {
        if let Value::Exact(x) = self { Some(x) } else { None }
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
        match op {
            // An enclosed value may round to either of two numbers.
            Op::Rounded(x) => {
                let nearest = x.exact().and_then(|x| self.round(x));
                Some(nearest.map_or_else(Value::unknown, Value::Exact))
            }
            op => Value::of(op),
        }
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
}

impl<T: Real + Exponential> Decidable for Ball<T> {
    fn sign(&self) -> Option<Ordering> {
        Ball::sign(self)
    }

    fn is_within(&self, bound: &Self) -> Option<bool> {
        Ball::sign(&(bound - self.abs())).map(Ordering::is_ge)
    }

    fn is_equal(&self, other: &Self) -> Option<bool> {
        let difference = self - other;
        difference.is_finite().then(|| difference.value().abs() <= *difference.radius())
    }
}
