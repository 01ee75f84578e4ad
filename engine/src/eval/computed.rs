//! Floats that round every result, with the exact values of what is not rounded.

use super::domain::{Domain, is_within};
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Real, ToExact};
use num_traits::{One, Zero};
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::rc::Rc;

/// Floats of one precision.
///
/// An operation below a rounding is computed by the floats; everything else is exact. A number that is too
/// large or too small for the model of rounding to p bits decides nothing.
#[derive(Clone, Debug)]
pub struct Rounding<T> {
    /// 2ᵖ
    precision: Exact,
    /// Smallest number with full precision.
    least: T,
}

/// A number whose float and whose exact value are computed when they are required.
#[derive(Clone, Debug)]
pub struct Computed<T>(Rc<Node<T>>);

#[derive(Debug)]
struct Node<T> {
    op: Op<Computed<T>>,
    /// The float; `None` if it is out of range.
    float: OnceCell<Option<T>>,
    /// The exact value; `None` if it is undefined, or depends on a float that is out of range.
    exact: OnceCell<Option<Exact>>,
}

impl<T: Real + ToExact> Rounding<T> {
    /// Returns the coarsest precision of some numbers; `None` if there is none.
    pub fn coarsest<'a>(numbers: impl IntoIterator<Item = &'a T>) -> Option<Self>
    where
        T: 'a,
    {
        let order = |a: &T, b: &T| a.partial_cmp(b).unwrap_or(Ordering::Equal);
        let eta = numbers.into_iter().map(Real::unit_roundoff).max_by(order)?;
        let precision = Exact::one() / eta.to_exact().ok().filter(|eta| !eta.is_zero())?;
        Some(Rounding { precision, least: T::min_subnormal() / eta })
    }

    /// Returns 2ᵖ.
    pub fn precision(&self) -> &Exact {
        &self.precision
    }

    /// Returns a float as a number.
    pub fn float(&self, x: T) -> Computed<T> {
        Computed::leaf(Op::Symbol(""), Some(x), OnceCell::new())
    }

    /// Returns an exact number, which no float represents.
    pub fn number(&self, x: Exact) -> Computed<T> {
        Computed::leaf(Op::Symbol(""), None, OnceCell::from(Some(x)))
    }

    /// Returns the float that is computed for a number; `None` if a number is too large or too small.
    pub fn computed<'a>(&self, x: &'a Computed<T>) -> Option<&'a T> {
        x.0.float.get_or_init(|| self.compute(&x.0.op)).as_ref()
    }

    fn compute(&self, op: &Op<Computed<T>>) -> Option<T> {
        let operands = op.try_map(|operand| self.computed(operand))?;
        // Sums never underflow; a nonzero product or quotient has full precision from `least` on.
        let is_zero = match operands {
            Op::Rounded(x) => return Some(x.clone()),
            Op::Mul(a, b) => a.is_zero() || b.is_zero(),
            Op::Div(a, _) => a.is_zero(),
            _ => true,
        };
        let value = field_operation(operands)?;
        let is_small = || value.is_zero() || value.abs() < self.least;
        (Real::is_finite(&value) && (is_zero || !is_small())).then_some(value)
    }

    /// Returns the exact value; `None` if it is undefined, or if a float below a rounding is out of range.
    pub fn value<'a>(&self, x: &'a Computed<T>) -> Option<&'a Exact> {
        let exact = || match &x.0.op {
            Op::Rounded(_) | Op::Symbol(_) => self.computed(x)?.to_exact().ok(),
            op => field_operation(op.try_map(|operand| self.value(operand))?),
        };
        x.0.exact.get_or_init(exact).as_ref()
    }
}

/// Returns the result of an operation without roundings and exponentials; `None` if it divides by 0.
fn field_operation<T: PositivePart>(op: Op<&T>) -> Option<T> {
    op.value(&|_| T::zero(), &piecewise_ops)
}

impl<T> Computed<T> {
    fn leaf(op: Op<Computed<T>>, float: Option<T>, exact: OnceCell<Option<Exact>>) -> Self {
        Computed(Rc::new(Node { op, float: OnceCell::from(float), exact }))
    }
}

impl<T: Real + ToExact> Domain for Rounding<T> {
    type Value = Computed<T>;

    fn apply(&self, op: Op<&Computed<T>>) -> Option<Computed<T>> {
        let op = op.map(|operand| (*operand).clone());
        Some(Computed(Rc::new(Node { op, float: OnceCell::new(), exact: OnceCell::new() })))
    }

    fn are_equal(&self, x: &Computed<T>, y: &Computed<T>) -> Option<bool> {
        Some(self.value(x)? == self.value(y)?)
    }

    fn is_within(&self, x: &Computed<T>, bound: &Computed<T>) -> Option<bool> {
        Some(is_within(self.value(x)?, self.value(bound)?))
    }

    fn sign(&self, x: &Computed<T>) -> Option<Ordering> {
        self.value(x).map(|x| x.cmp(&Exact::zero()))
    }
}
