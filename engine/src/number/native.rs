//! Floats of the traits of num-traits.

use super::field::ordered;
use super::{Field, OrderedField, PositivePart, Real};
use crate::operators;
use num_traits::{Float, One, Zero};
use std::fmt;

/// A float of another crate by its [`num_traits::Float`], such as f16 and bf16 of the crate `half`.
///
/// Its operations have to round to nearest, and `epsilon`, `min_positive_value`, `max_value` and
/// `integer_decode` have to be those of a binary format with subnormal numbers and 8 to 64 bits. A type of more
/// bits, or whose `integer_decode` returns only a part of a number, computes, but has no exact values, and is
/// refused where they are required: `TwoFloat` of the crate `twofloat` 0.8, for example, a sum of two f64s, which
/// neither rounds to nearest nor can be decoded. A system of your own can then state its bounds. `Native<f64>` gives the
/// same bits as `f64`.
///
/// # Examples
///
/// ```
/// use provable::number::{Ball, Field, Native};
///
/// /// Two resistors side by side.
/// fn parallel<T: Field>(a: &T, b: &T) -> T {
///     a * b / (a + b)
/// }
/// let [a, b] = [3.0_f32, 5.0].map(Native);
/// assert_eq!(parallel(&a, &b), Native(1.875));
/// assert!(*parallel(&Ball::point(a), &Ball::point(b)).radius() < Native(1e-6));
/// ```
#[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[repr(transparent)]
pub struct Native<T>(pub T);

impl<T: fmt::Debug> fmt::Debug for Native<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<T: fmt::Display> fmt::Display for Native<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

operators! { #[inline] [T: Float + fmt::Debug] Native<T>;
    Add add |a, b| Native(a.0 + b.0);
    Sub sub |a, b| Native(a.0 - b.0);
    Mul mul |a, b| Native(a.0 * b.0);
    Div div |a, b| Native(a.0 / b.0);
    - |a| Native(-a.0)
}
impl<T: Float + fmt::Debug> Zero for Native<T> {
    fn zero() -> Self {
        Native(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
impl<T: Float + fmt::Debug> One for Native<T> {
    fn one() -> Self {
        Native(T::one())
    }
}
impl<T: Float + fmt::Debug> Field for Native<T> {
    #[inline]
    fn int(n: i32) -> Self {
        Native(T::from(n).unwrap_or_else(T::nan))
    }
}
ordered!([T: Float + fmt::Debug] Native<T>);

impl<T: Float + fmt::Debug> Real for Native<T> {
    #[inline]
    fn unit_roundoff(&self) -> Self {
        Native(T::epsilon()) / Self::int(2)
    }
    #[inline]
    fn min_subnormal() -> Self {
        Native(T::min_positive_value() * T::epsilon())
    }
    #[inline]
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    #[inline]
    fn infinity() -> Self {
        Native(T::infinity())
    }
    fn next_up(self) -> Self {
        // Rump, Zimmermann, Boldo and Melquiond, Computing predecessor and successor in rounding to nearest
        // (2009): η (1 + 2η) |x| rounds x up by one unit, unless it loses digits to underflow.
        let (eta, unit) = (self.unit_roundoff(), Self::min_subnormal());
        let grow = |x: Self| x + eta * (Self::one() + Self::int(2) * eta) * x.magnitude();
        if self.0 == T::neg_infinity() {
            Native(T::min_value())
        } else if self.magnitude() * eta * eta >= unit {
            grow(self)
        } else if self.magnitude() * eta < unit {
            self + unit
        } else {
            grow(self / eta) * eta
        }
    }
    #[inline]
    fn magnitude(&self) -> Self {
        Native(self.0.abs())
    }
    #[inline]
    fn inflated(self) -> Self {
        // As for f32 and f64. The product suffices from η = 1/132 on, and so for 8 bits.
        self * (Self::one() + Self::int(6) * Native(T::epsilon()))
    }
}
