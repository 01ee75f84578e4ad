//! Floats that round every result, with the exact values of what is not rounded.

use super::domain::{Domain, Value};
use super::evaluation::Evaluation;
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, Real, ToExact};
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// Floats of one precision that round every result. `None` is a number that is too large or too small for the
/// model of rounding to p bits, and decides nothing.
#[derive(Clone, Debug)]
pub struct Floats<T> {
    /// 2ᵖ
    precision: Exact,
    /// Smallest number with full precision.
    least: T,
}

impl<T: Real + ToExact> Floats<T> {
    /// Returns the floats of the coarsest precision of some numbers; `None` if there is none.
    pub fn coarsest<'a>(numbers: impl IntoIterator<Item = &'a T>) -> Option<Self>
    where
        T: 'a,
    {
        let roundoffs = numbers.into_iter().map(Real::unit_roundoff);
        let eta = roundoffs.max_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal))?;
        let precision = Exact::one() / eta.to_exact().ok().filter(|eta| !eta.is_zero())?;
        Some(Floats { precision, least: T::min_subnormal() / eta })
    }

    /// Returns 2ᵖ.
    pub fn precision(&self) -> &Exact {
        &self.precision
    }

    fn compute(&self, op: Op<&T>) -> Option<T> {
        // Sums never underflow; a nonzero product or quotient has full precision from `least` on.
        let is_zero = match op {
            Op::Rounded(x) => return Some(x.clone()),
            Op::Mul(a, b) => a.is_zero() || b.is_zero(),
            Op::Div(a, _) => a.is_zero(),
            _ => true,
        };
        let value = op.value(&|_| T::zero(), &piecewise_ops)?;
        let is_normal = is_zero || !(value.is_zero() || value.abs() < self.least);
        (Real::is_finite(&value) && is_normal).then_some(value)
    }
}

impl<T: Real + ToExact> Domain for Floats<T> {
    type Value = Option<T>;

    fn apply(&self, op: Op<&Option<T>>) -> Option<Option<T>> {
        Some(op.try_map(|x| x.as_ref()).and_then(|op| self.compute(op)))
    }
}

/// Exact numbers, except that floats compute what is below a rounding. A number that depends on a float out of
/// range, or is undefined, is unknown.
#[derive(Debug)]
pub struct RoundedRationals<'a, T: Real + ToExact, S>(pub Evaluation<'a, &'a Floats<T>, S>);

impl<T: Real + ToExact, S: Fn(&'static str) -> Option<T>> Domain for RoundedRationals<'_, T, S> {
    type Value = Value;

    fn rounded(&self, place: usize) -> Option<Value> {
        let float = self.0.at(place).and_then(|float| float.as_ref()?.to_exact().ok());
        Some(float.map_or_else(Value::unknown, Value::Exact))
    }

    fn apply(&self, op: Op<&Value>) -> Option<Value> {
        Some(Value::of(op).unwrap_or_else(Value::unknown))
    }
}
