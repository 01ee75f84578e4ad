//! A float and a rigorous bound of its error.

use super::{Exponential, Field, PositivePart, Real};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// A value and a radius: the number meant lies no further than the radius from the value.
///
/// Every operation computes the value as `T` does and the radius as an upper bound: what the operands'
/// errors amount to, plus the rounding error of the operation itself, the sum rounded up. So a formula
/// read in balls gives the float result *and* a bound of its error. Inclusion holds for every input,
/// subnormal numbers included; a radius may be infinite where nothing can be said, as after a division
/// by a ball that contains zero. A division by zero itself, and by nothing else, is
/// [undefined](Ball::is_undefined), and so is all that is made of it.
///
/// ```
/// use spring_mass_contact::number::Ball;
/// let third = Ball::exactly(1.0) / Ball::exactly(3.0);
/// assert_eq!(*third.value(), 1.0 / 3.0);
/// assert!(*third.radius() > 0.0 && *third.radius() < 6e-17);
/// assert_eq!((third * Ball::exactly(3.0) - Ball::exactly(1.0)).sign(), None); // perhaps 0, perhaps not
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ball<T> {
    value: T,
    radius: T,
}

impl<T> Ball<T> {
    /// The centre: what `T` alone would have computed.
    pub fn value(&self) -> &T {
        &self.value
    }

    /// How far the number meant may be from the centre, at most.
    pub fn radius(&self) -> &T {
        &self.radius
    }
}

impl<T: Real> Ball<T> {
    /// This number and no other.
    pub fn exactly(value: T) -> Self {
        Ball { value, radius: T::zero() }
    }

    /// Some number that rounds to this value.
    pub fn rounded(value: T) -> Self {
        let radius = product_error(&value);
        Ball { value, radius }
    }

    /// A number no greater than any in the ball.
    pub fn lower(&self) -> T {
        if !self.is_finite() {
            -T::infinity()
        } else if self.radius.is_zero() {
            self.value.clone()
        } else {
            outward(&self.value - &self.radius, T::next_down)
        }
    }

    /// A number no less than any in the ball.
    pub fn upper(&self) -> T {
        if !self.is_finite() {
            T::infinity()
        } else if self.radius.is_zero() {
            self.value.clone()
        } else {
            outward(&self.value + &self.radius, T::next_up)
        }
    }

    /// A number no less than the absolute value of any in the ball.
    pub fn magnitude(&self) -> T {
        if !self.is_finite() {
            T::infinity()
        } else if self.radius.is_zero() {
            self.value.abs()
        } else {
            (self.value.abs() + &self.radius).next_up()
        }
    }

    /// The sign that all numbers in the ball share; `None` if they do not.
    pub fn sign(&self) -> Option<Ordering> {
        if self.radius.is_zero() || self.value.abs() > self.radius {
            self.value.partial_cmp(&T::zero())
        } else {
            None
        }
    }

    /// Can a result be trusted? Not if the value or the radius is infinite or not a number.
    pub fn is_finite(&self) -> bool {
        self.value.is_finite() && self.radius.is_finite()
    }

    /// Is no number meant at all, for certain? So it is where something was divided by zero.
    ///
    /// ```
    /// use spring_mass_contact::number::Ball;
    /// let (one, zero) = (Ball::exactly(1.0), Ball::exactly(0.0));
    /// assert!((&one / &zero).is_undefined() && ((&one / &zero) * &zero).is_undefined());
    /// let perhaps_zero = &one / Ball::exactly(3.0) * Ball::exactly(3.0) - &one;
    /// assert!(!(&one / perhaps_zero).is_undefined());
    /// ```
    pub fn is_undefined(&self) -> bool {
        // No other radius is not a number: sums of radii have no infinities of different signs.
        self.radius.partial_cmp(&self.radius).is_none()
    }

    fn undefined(value: T) -> Self {
        Ball { value, radius: T::infinity() - T::infinity() }
    }

    fn with(value: T, error: T) -> Self {
        // A value that is not finite says nothing of the number meant.
        let radius = if value.is_finite() && error.is_finite() { error } else { T::infinity() };
        Ball { value, radius }
    }

    fn is_exactly_zero(&self) -> bool {
        self.value.is_zero() && self.radius.is_zero()
    }
}

/// The neighbour of a rounded sum, unless the sum is 0: no sum of floats rounds to 0 but 0 itself, and
/// the neighbours of 0 in MPFR have a billion digits.
fn outward<T: Real>(sum: T, neighbour: impl Fn(T) -> T) -> T {
    if sum.is_zero() { sum } else { neighbour(sum) }
}

// Arithmetic of radii: numbers ≥ 0, every result rounded up, zero kept exact.

fn add<T: Real>(a: T, b: &T) -> T {
    if b.is_zero() {
        a
    } else if a.is_zero() {
        b.clone()
    } else {
        (a + b).next_up()
    }
}

/// A radius so many times; how many is not asked if it is 0.
fn times<T: Real>(radius: &T, factor: impl FnOnce() -> T) -> T {
    if radius.is_zero() {
        return T::zero();
    }
    let factor = factor();
    if factor.is_zero() { factor } else { (factor * radius).next_up() }
}

fn div<T: Real>(a: T, b: &T) -> T {
    if a.is_zero() { a } else { (a / b).next_up() }
}

/// Half an ulp and an absolute term, the rounding error of a product or quotient whose result is x.
fn product_error<T: Real>(x: &T) -> T {
    add(x.half_ulp(), &T::underflow_unit())
}

/// The value, undefined where one of the operands is: what every operation begins with.
macro_rules! of {
    ($value:expr, $($operand:expr),*) => {{
        let value = $value;
        if $($operand.is_undefined())||* {
            return Ball::undefined(value);
        }
        value
    }};
}

operators! { [T: Real] Ball<T>;
    Add add |a, b| {
        let value = of!(&a.value + &b.value, a, b);
        let error = add(add(a.radius.clone(), &b.radius), &value.half_ulp());
        Ball::with(value, error)
    };
    Sub sub |a, b| {
        let value = of!(&a.value - &b.value, a, b);
        let error = add(add(a.radius.clone(), &b.radius), &value.half_ulp());
        Ball::with(value, error)
    };
    Mul mul |a, b| {
        let value = of!(&a.value * &b.value, a, b);
        if a.is_exactly_zero() || b.is_exactly_zero() { return Ball::zero() }
        // ab − a'b' = a(b − b') + b(a − a') − (a − a')(b − b')
        let from_a = times(&a.radius, || add(b.value.magnitude(), &b.radius));
        let from_b = times(&b.radius, || a.value.magnitude());
        let error = add(add(from_a, &from_b), &product_error(&value));
        Ball::with(value, error)
    };
    Div div |a, b| {
        // By zero not `a / b`: Mpfr's constants are rationals and would panic.
        let value = if b.value.is_zero() { &a.value * T::infinity() } else { &a.value / &b.value };
        let value = of!(value, a, b);
        if b.is_exactly_zero() { return Ball::undefined(value) }
        // No |divisor| is less than this.
        let least = b.value.abs();
        let least = if b.radius.is_zero() { least } else { (least - &b.radius).next_down() };
        if least.partial_cmp(&T::zero()) != Some(Ordering::Greater) {
            return Ball { value, radius: T::infinity() }
        }
        if a.is_exactly_zero() { return Ball::zero() }
        // a/b − a'/b' = ((a − a') − (a/b)(b − b')) / b'
        let own = product_error(&value);
        let from_b = times(&b.radius, || add(value.magnitude(), &own));
        let error = div(add(from_b, &a.radius), &least);
        // The divisor may have more digits than a radius.
        Ball::with(value, add(error, &own).magnitude())
    };
    - |a| Ball { value: -&a.value, radius: a.radius.clone() }
}

impl<T: Real> Zero for Ball<T> {
    fn zero() -> Self {
        Ball::exactly(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.is_exactly_zero()
    }
}
impl<T: Real> One for Ball<T> {
    fn one() -> Self {
        Ball::exactly(T::one())
    }
}
impl<T: Real> Field for Ball<T> {
    fn int(n: i32) -> Self {
        Ball::exactly(T::int(n))
    }
    fn is_unit(&self) -> bool {
        self.value.abs() > self.radius
    }
}
impl<T: Real> PositivePart for Ball<T> {
    fn positive_part(&self) -> Self {
        let value = of!(self.value.positive_part(), self);
        match self.sign() {
            Some(Ordering::Greater) => self.clone(),
            Some(_) => Ball::zero(),
            // ⟨·⟩ brings no two numbers further apart, so the radius still holds.
            None => Ball::with(value, self.radius.clone()),
        }
    }
    fn min(&self, other: &Self) -> Self {
        let value = of!(self.value.min(&other.value), self, other);
        if self.upper() <= other.lower() {
            self.clone()
        } else if other.upper() <= self.lower() {
            other.clone()
        } else {
            let radius = if self.radius > other.radius { &self.radius } else { &other.radius };
            Ball::with(value, radius.clone())
        }
    }
}
impl<T: Real + Exponential> Exponential for Ball<T> {
    fn exp(&self) -> Self {
        if self.is_exactly_zero() {
            return Ball::one();
        }
        let value = of!(self.value.exp(), self);
        let own = product_error(&value);
        let r = &self.radius;
        // |eʳ − 1| ≤ r + r² for r ≤ 1.
        if *r > T::one() {
            return Ball { value, radius: T::infinity() };
        }
        let growth = times(&add(times(r, || r.clone()), r), || add(value.magnitude(), &own));
        Ball::with(value, add(growth, &own))
    }
}
