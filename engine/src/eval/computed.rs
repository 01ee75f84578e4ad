//! Floats that round every result, with the exact values of what is not rounded.

use super::domain::{Domain, is_within};
use super::statement::Evaluation;
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Real, ToExact};
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
        let order = |a: &T, b: &T| a.partial_cmp(b).unwrap_or(Ordering::Equal);
        let eta = numbers.into_iter().map(Real::unit_roundoff).max_by(order)?;
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
        let value = operation(op)?;
        let is_small = || value.is_zero() || value.abs() < self.least;
        (Real::is_finite(&value) && (is_zero || !is_small())).then_some(value)
    }
}

/// Returns the result of an operation without roundings and exponentials; `None` if it divides by 0.
fn operation<T: PositivePart>(op: Op<&T>) -> Option<T> {
    op.value(&|_| T::zero(), &piecewise_ops)
}

impl<T: Real + ToExact> Domain for Floats<T> {
    type Value = Option<T>;

    fn apply(&self, op: Op<&Option<T>>) -> Option<Option<T>> {
        Some(op.try_map(|x| x.as_ref()).and_then(|op| self.compute(op)))
    }
}

/// Exact numbers, except that floats compute what is below a rounding. `None` is a number that depends on a
/// float out of range, or is undefined, and decides nothing.
#[derive(Debug)]
pub struct Computed<'a, T: Real + ToExact, S>(pub Evaluation<'a, Floats<T>, S>);

impl<T: Real + ToExact, S: Fn(&'static str) -> Option<T>> Domain for Computed<'_, T, S> {
    type Value = Option<Exact>;

    fn rounded(&self, place: usize) -> Option<Option<Exact>> {
        let float = self.0.at(place).and_then(|float| float.as_ref());
        Some(float.and_then(|float| float.to_exact().ok()))
    }

    fn apply(&self, op: Op<&Option<Exact>>) -> Option<Option<Exact>> {
        Some(op.try_map(|x| x.as_ref()).and_then(operation))
    }

    fn sign(&self, x: &Option<Exact>) -> Option<Ordering> {
        x.as_ref().map(|x| x.cmp(&Exact::zero()))
    }

    fn are_equal(&self, x: &Option<Exact>, y: &Option<Exact>) -> Option<bool> {
        Some(x.as_ref()? == y.as_ref()?)
    }

    fn is_within(&self, x: &Option<Exact>, bound: &Option<Exact>) -> Option<bool> {
        Some(is_within(x.as_ref()?, bound.as_ref()?))
    }
}
