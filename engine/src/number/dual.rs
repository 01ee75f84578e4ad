//! Values with derivatives.

use super::{Ball, Exponential, Field, OrderedField, PositivePart, Real};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// A value and its derivative with respect to one variable. A formula evaluated in dual numbers
/// differentiates itself.
///
/// The derivative is exact over rationals, carries its bound over balls, and over dual numbers it is the
/// second derivative.
///
/// # Examples
///
/// ```
/// use provable::number::Dual;
/// // A resistor of 2 Ω turns 2 i² into heat.
/// let power = |i: Dual<f64>| Dual::constant(2.0) * &i * &i;
/// assert_eq!(power(Dual::variable(3.0)), Dual { value: 18.0, derivative: 12.0 });
/// ```
/// # Order, and the derivative at a kink
/// Two dual numbers are equal if their values and derivatives are. They compare by their values; if these are
/// equal, by their derivatives, which is the order immediately to the right of the point. So ⟨·⟩, min and |·|
/// have the *right-hand* derivative: at 0 that of ⟨x⟩ is 1 and that of ⟨−x⟩ is 0, and the minimum of two
/// equal numbers is the one that increases less. Without a kink it is the derivative. Unlike an element of
/// the subdifferential it satisfies the chain rule at a kink: ⟨x⟩ − ⟨−x⟩ has the derivative of x. The
/// left-hand derivative is minus that of a decreasing variable, `Dual { value, derivative: −1 }`. Floats
/// round before they compare, so close to a kink they may be on its other side.
///
/// # Examples
///
/// ```
/// use provable::number::{Dual, PositivePart};
/// // A diode lets ⟨u − 1⟩ pass. How does that change with u, above its threshold, at it and below?
/// let slope = |u: f64, direction: f64| {
///     (Dual { value: u, derivative: direction } - Dual::constant(1.0)).positive_part().derivative
/// };
/// assert_eq!([slope(2.0, 1.0), slope(1.0, 1.0), slope(0.0, 1.0)], [1.0, 1.0, 0.0]);
/// // To the left of the threshold nothing changes.
/// assert_eq!(-slope(1.0, -1.0), 0.0);
/// ```
/// The order is compatible with sums, and a product of two positive numbers is never negative; but it can be
/// 0, as (0 + 1·ω)² is.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Dual<T> {
    /// The value.
    pub value: T,
    /// The derivative.
    pub derivative: T,
}

impl<T: Field> Dual<T> {
    /// Returns a number that does not depend on the variable.
    pub fn constant(value: T) -> Self {
        Dual { value, derivative: T::zero() }
    }

    /// Returns the variable.
    pub fn variable(value: T) -> Self {
        Dual { value, derivative: T::one() }
    }

    /// Returns the variable if `varies`, and a constant otherwise.
    pub fn coordinate(value: T, varies: bool) -> Self {
        if varies { Dual::variable(value) } else { Dual::constant(value) }
    }
}

operators! { [T: Field] Dual<T>;
    Add add |a, b| Dual { value: &a.value + &b.value, derivative: &a.derivative + &b.derivative };
    Sub sub |a, b| Dual { value: &a.value - &b.value, derivative: &a.derivative - &b.derivative };
    Mul mul |a, b| Dual {
        value: &a.value * &b.value,
        derivative: &a.derivative * &b.value + &a.value * &b.derivative,
    };
    Div div |a, b| {
        let value = &a.value / &b.value;
        let derivative = (&a.derivative - &value * &b.derivative) / &b.value;
        Dual { value, derivative }
    };
    - |a| Dual { value: -&a.value, derivative: -&a.derivative }
}

impl<T: Field> Zero for Dual<T> {
    fn zero() -> Self {
        Dual::constant(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.derivative.is_zero()
    }
}
impl<T: Field> One for Dual<T> {
    fn one() -> Self {
        Dual::constant(T::one())
    }
}
impl<T: Field> Field for Dual<T> {
    fn int(n: i32) -> Self {
        Dual::constant(T::int(n))
    }
    fn is_invertible(&self) -> bool {
        self.value.is_invertible()
    }
}
impl<T: Exponential> Exponential for Dual<T> {
    fn exp(&self) -> Self {
        let value = self.value.exp();
        Dual { derivative: &value * &self.derivative, value }
    }
}

impl<T: OrderedField> PositivePart for Dual<T> {
    fn positive_part(&self) -> Self {
        if *self > Self::zero() { self.clone() } else { Self::zero() }
    }
    fn min(&self, other: &Self) -> Self {
        if other < self { other.clone() } else { self.clone() }
    }
}
impl<T: OrderedField> OrderedField for Dual<T> {}

/// If a ball contains a kink, the derivative contains those on both sides.
impl<T: Real> PositivePart for Dual<Ball<T>> {
    fn positive_part(&self) -> Self {
        Dual {
            value: self.value.positive_part(),
            derivative: match self.value.sign() {
                Some(Ordering::Greater) => self.derivative.clone(),
                Some(Ordering::Equal) => self.derivative.positive_part(),
                Some(Ordering::Less) => Ball::zero(),
                None => Ball::zero().hull(&self.derivative),
            },
        }
    }
    fn min(&self, other: &Self) -> Self {
        Dual {
            value: self.value.min(&other.value),
            derivative: match (&self.value - &other.value).sign() {
                Some(Ordering::Greater) => other.derivative.clone(),
                Some(Ordering::Equal) => self.derivative.min(&other.derivative),
                Some(Ordering::Less) => self.derivative.clone(),
                None => self.derivative.hull(&other.derivative),
            },
        }
    }
}
