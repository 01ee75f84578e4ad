//! A float and a rigorous bound of its error.

use super::{Exponential, Field, PositivePart, Real};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// A value and a radius: the number meant lies no further than the radius from the value.
///
/// Every operation computes the value as `T` does and the radius as an upper bound: what the operands'
/// errors amount to, plus the rounding error of the operation itself, enlarged by what is lost on the way.
/// So a formula read in balls gives the float result *and* a bound of its error. Inclusion holds for every
/// input, subnormal numbers included; a radius may be infinite where nothing can be said, as after a division
/// by a ball that contains zero. A division by zero itself, and by nothing else, is
/// [undefined](Ball::is_undefined), and so is all that is made of it.
///
/// ```
/// use provable::number::Ball;
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
    #[inline]
    pub fn value(&self) -> &T {
        &self.value
    }

    /// How far the number meant may be from the centre, at most.
    #[inline]
    pub fn radius(&self) -> &T {
        &self.radius
    }
}

impl<T: Real> Ball<T> {
    /// This number and no other.
    #[inline]
    pub fn exactly(value: T) -> Self {
        Ball { value, radius: T::zero() }
    }

    /// Some number that rounds to this value.
    #[inline]
    pub fn rounded(value: T) -> Self {
        let radius = product_error(&value);
        Ball { value, radius }
    }

    /// A number no greater than any in the ball.
    #[inline]
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
    #[inline]
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
    #[inline]
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
    #[inline]
    pub fn sign(&self) -> Option<Ordering> {
        if self.radius.is_zero() || self.value.abs() > self.radius {
            self.value.partial_cmp(&T::zero())
        } else {
            None
        }
    }

    /// A ball that contains both.
    ///
    /// ```
    /// use provable::number::Ball;
    /// let hull = Ball::exactly(1.0).hull(&Ball::exactly(3.0));
    /// assert!(hull.lower() <= 1.0 && 3.0 <= hull.upper() && hull.upper() - hull.lower() < 2.0 + 1e-14);
    /// ```
    pub fn hull(&self, other: &Self) -> Self {
        // Each end is the middle and half the difference, one way or the other.
        let two = || Ball::exactly(T::int(2));
        let (middle, half) = ((self + other) / two(), (self - other) / two());
        let radius = (&middle.radius + half.magnitude()).enlarged();
        if radius.is_finite() {
            Ball { value: middle.value, radius }
        } else {
            Ball::unbounded(middle.value, &self.radius + &other.radius)
        }
    }

    /// Can a result be trusted? Not if the value or the radius is infinite or not a number.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.value.is_finite() && self.radius.is_finite()
    }

    /// Is no number meant at all, for certain? So it is where something was divided by zero.
    ///
    /// ```
    /// use provable::number::Ball;
    /// let (one, zero) = (Ball::exactly(1.0), Ball::exactly(0.0));
    /// assert!((&one / &zero).is_undefined() && ((&one / &zero) * &zero).is_undefined());
    /// let perhaps_zero = &one / Ball::exactly(3.0) * Ball::exactly(3.0) - &one;
    /// assert!(!(&one / perhaps_zero).is_undefined());
    /// ```
    #[inline]
    pub fn is_undefined(&self) -> bool {
        // No other radius is not a number: sums of radii have no infinities of different signs.
        self.radius.partial_cmp(&self.radius).is_none()
    }

    /// The result of an operation, from a radius that is not yet enlarged and from those that entered it.
    #[inline]
    fn with(value: T, error: T, entered: [&T; 2], exactly_zero: bool) -> Self {
        let radius = error.enlarged();
        // A finite radius has half an ulp of the value in it, so that is finite, too.
        if !radius.is_finite() {
            Ball::unbounded(value, entered[0] + entered[1])
        } else if exactly_zero {
            Ball::zero()
        } else {
            Ball { value, radius }
        }
    }

    /// Nothing is known of the number meant; or there is none, if what entered says so.
    #[cold]
    #[inline(never)]
    fn unbounded(value: T, entered: T) -> Self {
        Ball { value, radius: entered + T::infinity() }
    }

    #[inline]
    fn is_exactly_zero(&self) -> bool {
        self.value.is_zero() && self.radius.is_zero()
    }
}

/// The neighbour of a rounded sum, unless the sum is 0: no sum of floats rounds to 0 but 0 itself, and
/// the neighbours of 0 in MPFR have a billion digits.
#[inline]
fn outward<T: Real>(sum: T, neighbour: impl Fn(T) -> T) -> T {
    if sum.is_zero() { sum } else { neighbour(sum) }
}

// Radii are sums, products and quotients of numbers ≥ 0, computed to nearest like any others. Each operation
// may take η of its result away, in parts of it. No radius goes through more than ten, for which it is
// enlarged in the end. And among the subnormal numbers, where sums are exact, a product or quotient may lose
// half an underflow unit. There are five: the value, its half ulp, two more, and what enlarges. The four
// units in `product_error` are more than enough for them. 0 stays 0.

/// A radius so many times; how many is not asked if it is 0.
#[inline]
fn times<T: Real>(radius: &T, factor: impl FnOnce() -> T) -> T {
    if radius.is_zero() { T::zero() } else { factor() * radius }
}

/// Half an ulp and an absolute term, the rounding error of a product or quotient whose result is x.
#[inline]
fn product_error<T: Real>(x: &T) -> T {
    x.half_ulp() + T::int(4) * T::underflow_unit()
}

operators! { #[inline] [T: Real] Ball<T>;
    Add add |a, b| {
        let value = &a.value + &b.value;
        let error = &a.radius + &b.radius + value.half_ulp();
        Ball::with(value, error, [&a.radius, &b.radius], false)
    };
    Sub sub |a, b| {
        let value = &a.value - &b.value;
        let error = &a.radius + &b.radius + value.half_ulp();
        Ball::with(value, error, [&a.radius, &b.radius], false)
    };
    Mul mul |a, b| {
        if a.is_exactly_zero() && b.is_finite() || b.is_exactly_zero() && a.is_finite() {
            return Ball::zero();
        }
        let value = &a.value * &b.value;
        // ab − a'b' = a(b − b') + b(a − a') − (a − a')(b − b')
        let from_a = times(&a.radius, || b.value.magnitude() + &b.radius);
        let from_b = times(&b.radius, || a.value.magnitude());
        let error = from_a + (from_b + product_error(&value));
        Ball::with(value, error, [&a.radius, &b.radius], false)
    };
    Div div |a, b| {
        // No |divisor| is less than this.
        let least = b.value.abs() - &b.radius;
        if least.partial_cmp(&T::zero()) != Some(Ordering::Greater) {
            // By zero not `a / b`: Mpfr's constants are rationals and would panic.
            let value = if b.value.is_zero() { &a.value * T::infinity() } else { &a.value / &b.value };
            let undefined = if b.is_exactly_zero() { T::infinity() - T::infinity() } else { T::zero() };
            return Ball::unbounded(value, &a.radius + &b.radius + undefined);
        }
        let value = &a.value / &b.value;
        // a/b − a'/b' = ((a − a') − (a/b)(b − b')) / b'
        let own = product_error(&value);
        let from_b = times(&b.radius, || value.magnitude() + &own);
        // What underflows there, a small divisor magnifies.
        let lost = if b.radius.is_zero() { T::zero() } else { T::underflow_unit() };
        // The divisor may have more digits than a radius. To round it up counts as two of the ten.
        let error = (from_b + (lost + &a.radius)) / least.magnitude() + own;
        let zero = value.is_zero() && a.is_exactly_zero();
        Ball::with(value, error, [&a.radius, &b.radius], zero)
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
        match self.sign() {
            Some(Ordering::Greater) => self.clone(),
            Some(_) => Ball::zero(),
            // ⟨·⟩ brings no two numbers further apart, so the radius still holds.
            None => Ball { value: self.value.positive_part(), radius: self.radius.clone() },
        }
    }
    fn min(&self, other: &Self) -> Self {
        let value = self.value.min(&other.value);
        if self.is_undefined() || other.is_undefined() {
            Ball::unbounded(value, &self.radius + &other.radius)
        } else if self.upper() <= other.lower() {
            self.clone()
        } else if other.upper() <= self.lower() {
            other.clone()
        } else {
            let radius = if self.radius > other.radius { &self.radius } else { &other.radius };
            Ball { value, radius: radius.clone() }
        }
    }
}
impl<T: Real + Exponential> Exponential for Ball<T> {
    fn exp(&self) -> Self {
        if self.is_exactly_zero() {
            return Ball::one();
        }
        let value = self.value.exp();
        let r = &self.radius;
        if r.partial_cmp(&T::one()).is_none_or(Ordering::is_gt) {
            return Ball::unbounded(value, r.clone());
        }
        let own = product_error(&value);
        // |eʳ − 1| ≤ r + r² for r ≤ 1.
        let growth = times(&(r * r + r), || value.magnitude() + &own);
        Ball::with(value, growth + own, [r, r], false)
    }
}
