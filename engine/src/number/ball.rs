//! Floats with a rigorous error bound.

use super::{Exponential, Field, PositivePart, Real};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// A value and a radius: the distance of the exact number from the value is at most the radius.
///
/// Every operation computes the value as `T` does, and as the radius an upper bound: the propagated errors of
/// the operands plus the rounding error of the operation, inflated by the rounding of the radius itself. A
/// formula evaluated in balls therefore returns the float result *and* a bound of its error. Inclusion holds
/// for every input, subnormal numbers included; the radius may be infinite, for example after a division by a
/// ball that contains zero. Only a division by exactly zero is [undefined](Ball::is_undefined), and so is
/// every result that depends on it.
///
/// # Examples
///
/// ```
/// use provable::number::Ball;
/// let third = Ball::point(1.0) / Ball::point(3.0);
/// assert_eq!(*third.value(), 1.0 / 3.0);
/// assert!(*third.radius() > 0.0 && *third.radius() < 6e-17);
/// assert_eq!((third * Ball::point(3.0) - Ball::point(1.0)).sign(), None); // perhaps 0, perhaps not
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ball<T> {
    value: T,
    radius: T,
}

impl<T> Ball<T> {
    /// Returns the centre, which is what `T` alone would compute.
    #[inline]
    pub fn value(&self) -> &T {
        &self.value
    }

    /// Returns the largest distance of the exact number from the centre.
    #[inline]
    pub fn radius(&self) -> &T {
        &self.radius
    }
}

impl<T: Real> Ball<T> {
    /// Returns the ball that contains only this number.
    #[inline]
    pub fn point(value: T) -> Self {
        Ball { value, radius: T::zero() }
    }

    /// Returns a ball that contains every number that rounds to this value.
    #[inline]
    pub fn from_rounded(value: T) -> Self {
        let radius = product_error(&value);
        Ball { value, radius }
    }

    /// Returns a lower bound of the numbers in the ball.
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

    /// Returns an upper bound of the numbers in the ball.
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

    /// Returns an upper bound of the absolute values in the ball.
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

    /// Returns the common sign of all numbers in the ball; `None` if they differ.
    #[inline]
    pub fn sign(&self) -> Option<Ordering> {
        if self.radius.is_zero() || self.value.abs() > self.radius {
            self.value.partial_cmp(&T::zero())
        } else {
            None
        }
    }

    /// Returns a ball that contains both.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::number::Ball;
    /// let hull = Ball::point(1.0).hull(&Ball::point(3.0));
    /// assert!(hull.lower() <= 1.0 && 3.0 <= hull.upper() && hull.upper() - hull.lower() < 2.0 + 1e-14);
    /// ```
    pub fn hull(&self, other: &Self) -> Self {
        // Each bound is the middle plus or minus half the difference.
        let two = || Ball::point(T::int(2));
        let (middle, half) = ((self + other) / two(), (self - other) / two());
        let radius = (&middle.radius + half.magnitude()).inflated();
        if radius.is_finite() {
            Ball { value: middle.value, radius }
        } else {
            Ball::unbounded(middle.value, &self.radius + &other.radius)
        }
    }

    /// Returns `true` if value and radius are finite numbers.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.value.is_finite() && self.radius.is_finite()
    }

    /// Returns `true` if the result contains a division by exactly zero, so that no exact number exists.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::number::Ball;
    /// let (one, zero) = (Ball::point(1.0), Ball::point(0.0));
    /// assert!((&one / &zero).is_undefined() && ((&one / &zero) * &zero).is_undefined());
    /// let perhaps_zero = &one / Ball::point(3.0) * Ball::point(3.0) - &one;
    /// assert!(!(&one / perhaps_zero).is_undefined());
    /// ```
    #[inline]
    pub fn is_undefined(&self) -> bool {
        // No other radius is NaN, since sums of radii have no infinities of different signs.
        self.radius.partial_cmp(&self.radius).is_none()
    }

    /// Returns the ball of all numbers, about which nothing is known.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::number::Ball;
    /// let unknown = Ball::<f64>::entire();
    /// assert!(unknown.sign().is_none() && !unknown.is_finite() && !unknown.is_undefined());
    /// ```
    pub fn entire() -> Self {
        Ball { value: T::zero(), radius: T::infinity() }
    }

    /// Returns the result of an operation from a radius that is not inflated yet and the radii of the
    /// operands.
    #[inline]
    fn from_parts(value: T, error: T, entered: [&T; 2], exactly_zero: bool) -> Self {
        let radius = error.inflated();
        // A finite radius includes half an ulp of the value, so the value is finite, too.
        if !radius.is_finite() {
            Ball::unbounded(value, entered[0] + entered[1])
        } else if exactly_zero {
            Ball::zero()
        } else {
            Ball { value, radius }
        }
    }

    /// Returns a ball of infinite radius, or an undefined one if an operand is.
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

/// Returns the neighbour of a rounded sum unless the sum is 0: only exact sums of floats are 0, and the
/// neighbours of 0 in MPFR have a billion digits.
#[inline]
fn outward<T: Real>(sum: T, neighbour: impl Fn(T) -> T) -> T {
    if sum.is_zero() { sum } else { neighbour(sum) }
}

// Radii are sums, products and quotients of nonnegative numbers, rounded to nearest. Each operation may
// decrease its result by η relative to itself; a radius results from at most ten operations, for which it is
// inflated at the end. Among subnormal numbers sums are exact, and a product or quotient may lose half a
// subnormal unit; there are five of these: the value, its half ulp, two more, and the inflation. The four
// units in `product_error` cover them. A radius of 0 stays 0.

/// Returns the product of a radius and a factor that is not computed if the radius is 0.
#[inline]
fn times<T: Real>(radius: &T, factor: impl FnOnce() -> T) -> T {
    if radius.is_zero() { T::zero() } else { factor() * radius }
}

/// Returns half an ulp and an absolute term: the rounding error of a product or quotient x.
#[inline]
fn product_error<T: Real>(x: &T) -> T {
    x.half_ulp() + T::int(4) * T::min_subnormal()
}

operators! { #[inline] [T: Real] Ball<T>;
    Add add |a, b| {
        let value = &a.value + &b.value;
        let error = &a.radius + &b.radius + value.half_ulp();
        Ball::from_parts(value, error, [&a.radius, &b.radius], false)
    };
    Sub sub |a, b| {
        let value = &a.value - &b.value;
        let error = &a.radius + &b.radius + value.half_ulp();
        Ball::from_parts(value, error, [&a.radius, &b.radius], false)
    };
    Mul mul |a, b| {
        let value = &a.value * &b.value;
        // ab − a'b' = a(b − b') + b(a − a') − (a − a')(b − b')
        let from_a = times(&a.radius, || b.value.magnitude() + &b.radius);
        let from_b = times(&b.radius, || a.value.magnitude());
        let error = from_a + (from_b + product_error(&value));
        // The value is rarely 0, and the factors are looked at only then.
        let zero = value.is_zero() && (a.is_exactly_zero() || b.is_exactly_zero());
        Ball::from_parts(value, error, [&a.radius, &b.radius], zero)
    };
    Div div |a, b| {
        // Lower bound of |divisor|.
        let least = b.value.abs() - &b.radius;
        if least.partial_cmp(&T::zero()) != Some(Ordering::Greater) {
            // Not `a / b` for a zero divisor: constants of Mpfr are rationals and would panic.
            let value = if b.value.is_zero() { &a.value * T::infinity() } else { &a.value / &b.value };
            let undefined = if b.is_exactly_zero() { T::infinity() - T::infinity() } else { T::zero() };
            return Ball::unbounded(value, &a.radius + &b.radius + undefined);
        }
        let value = &a.value / &b.value;
        // a/b − a'/b' = ((a − a') − (a/b)(b − b')) / b'
        let rounding = product_error(&value);
        let from_b = times(&b.radius, || value.magnitude() + &rounding);
        // A small divisor magnifies an underflow there.
        let lost = if b.radius.is_zero() { T::zero() } else { T::min_subnormal() };
        // The divisor may have more digits than a radius. Rounding it up counts as two of the ten operations.
        let error = (from_b + (lost + &a.radius)) / least.magnitude() + rounding;
        let zero = value.is_zero() && a.is_exactly_zero();
        Ball::from_parts(value, error, [&a.radius, &b.radius], zero)
    };
    - |a| Ball { value: -&a.value, radius: a.radius.clone() }
}

impl<T: Real> Zero for Ball<T> {
    fn zero() -> Self {
        Ball::point(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.is_exactly_zero()
    }
}
impl<T: Real> One for Ball<T> {
    fn one() -> Self {
        Ball::point(T::one())
    }
}
impl<T: Real> Field for Ball<T> {
    fn int(n: i32) -> Self {
        let x = T::int(n);
        // Below 2ᵖ every integer is a number of p bits.
        if (x.abs() * x.unit_roundoff()).partial_cmp(&T::one()).is_some_and(Ordering::is_lt) {
            return Ball::point(x);
        }
        Ball::int(n / 16) * Ball::int(16) + Ball::int(n % 16)
    }
    fn is_invertible(&self) -> bool {
        self.value.abs() > self.radius
    }
}
impl<T: Real> PositivePart for Ball<T> {
    fn positive_part(&self) -> Self {
        match self.sign() {
            Some(Ordering::Greater) => self.clone(),
            Some(_) => Ball::zero(),
            // ⟨·⟩ does not increase distances, so the radius still holds.
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
        let rounding = product_error(&value);
        // |eʳ − 1| ≤ r + r² for r ≤ 1.
        let growth = times(&(r * r + r), || value.magnitude() + &rounding);
        Ball::from_parts(value, growth + rounding, [r, r], false)
    }
}
