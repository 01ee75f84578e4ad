//! Requirements of the solver on numbers beyond arithmetic: bounds and an exact sign.

use crate::number::{Ball, OrderedField, PositivePart, Real};
use std::cmp::Ordering;

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Interval<T> {
    /// Lower bound.
    pub lower: T,
    /// Upper bound.
    pub upper: T,
}

impl<T: PartialOrd> Interval<T> {
    /// Returns `true` if the interval contains the number. The comparison is exact; NaN is in no interval.
    ///
    /// # Examples
    ///
    /// ```
    /// # use spring_mass_contact::solver::Interval;
    /// let unit = Interval { lower: 0.0, upper: 1.0 };
    /// assert!(unit.contains(&1.0) && !unit.contains(&1.0_f64.next_up()));
    /// ```
    pub fn contains(&self, x: &T) -> bool {
        self.lower <= *x && *x <= self.upper
    }
}

impl<T: Scalar> Interval<T> {
    /// Returns the distance of the bounds: exact if the scalar can represent it, otherwise an upper bound,
    /// larger by a few roundings. Infinite if a bound is infinite or the distance overflows.
    ///
    /// # Examples
    ///
    /// ```
    /// # use spring_mass_contact::solver::Interval;
    /// assert_eq!(Interval { lower: 0.25, upper: 1.0 }.width(), 0.75);
    /// let beyond = Interval { lower: f64::INFINITY, upper: f64::INFINITY };
    /// assert_eq!(beyond.width(), f64::INFINITY);
    /// // 1 + 2⁻⁶⁰ is no f64.
    /// assert!(Interval { lower: -0.5_f64.powi(60), upper: 1.0 }.width() > 1.0);
    /// ```
    pub fn width(&self) -> T {
        let Interval { lower, upper } = self;
        if let Some(infinite) = [lower, upper].into_iter().find(|end| !end.is_finite()) {
            return infinite.abs();
        }
        let (one, width) = (T::one(), upper - lower);
        if !width.is_finite() || T::sign_of_sum([(upper, &one), (&-lower, &one)], (&width, &one)).is_le() {
            return width;
        }
        T::magnitude(&(upper.enclose() - lower.enclose()))
    }
}

/// Numbers for [`solve`](super::solve): f32, f64, [`Mpfr`](crate::number::Mpfr),
/// [`Exact`](crate::number::Exact), any other float as [`Native`](crate::number::Native), and user-defined
/// types.
///
/// The bounds of the solver rest on the requirements of these methods. `laws::check_scalar_laws` checks them
/// in your own tests. It requires the feature `mpfr`, in your dev-dependencies if your library does without.
///
/// # Your own scalar
/// A scalar is a number system ([recipe](crate::number::field#your-own-number-system)) with an order and a
/// type of enclosures. This example is an f64 that counts its operations. It uses the balls of f64, to which
/// its methods delegate:
///
/// ```
/// use spring_mass_contact::chapter::SpringMass;
/// use spring_mass_contact::num_traits::{One, Zero};
/// use spring_mass_contact::number::{Ball, Field, OrderedField, PositivePart};
/// use spring_mass_contact::operators;
/// use spring_mass_contact::solver::{Interval, Method, Scalar, solve};
/// use std::{cell::Cell, cmp::Ordering};
///
/// #[derive(Clone, Debug, PartialEq, PartialOrd)]
/// struct Counted(f64);
///
/// thread_local! { static OPERATIONS: Cell<u32> = const { Cell::new(0) }; }
/// fn counted(x: f64) -> Counted {
///     OPERATIONS.set(OPERATIONS.get() + 1);
///     Counted(x)
/// }
///
/// operators! { [] Counted;
///     Add add |a, b| counted(a.0 + b.0);
///     Sub sub |a, b| counted(a.0 - b.0);
///     Mul mul |a, b| counted(a.0 * b.0);
///     Div div |a, b| counted(a.0 / b.0);
///     - |a| Counted(-a.0)
/// }
/// impl Zero for Counted {
///     fn zero() -> Self { Counted(0.0) }
///     fn is_zero(&self) -> bool { self.0 == 0.0 }
/// }
/// impl One for Counted { fn one() -> Self { Counted(1.0) } }
/// impl Field for Counted { fn int(n: i32) -> Self { Counted(n.into()) } }
/// impl PositivePart for Counted {
///     fn positive_part(&self) -> Self { Counted(self.0.max(0.0)) }
///     fn min(&self, other: &Self) -> Self { Counted(self.0.min(other.0)) }
/// }
/// impl OrderedField for Counted {}
///
/// impl Scalar for Counted {
///     type Enclosure = Ball<f64>;
///     fn enclose(&self) -> Ball<f64> { self.0.enclose() }
///     fn interval(ball: &Ball<f64>) -> Interval<Self> {
///         let Interval { lower, upper } = f64::interval(ball);
///         // Numbers coarser than these floats are rounded outwards here, and up in `magnitude`.
///         Interval { lower: Counted(lower), upper: Counted(upper) }
///     }
///     fn magnitude(ball: &Ball<f64>) -> Self { Counted(f64::magnitude(ball)) }
///     fn sign(ball: &Ball<f64>) -> Option<Ordering> { f64::sign(ball) }
///     fn is_finite(&self) -> bool { self.0.is_finite() }
///     fn sign_of_sum([a, b]: [(&Self, &Self); 2], c: (&Self, &Self)) -> Ordering {
///         let floats = |(x, y): (&'_ Self, &'_ Self)| (x.0, y.0);
///         let [a, b, c] = [a, b, c].map(floats);
///         f64::sign_of_sum([(&a.0, &a.1), (&b.0, &b.1)], (&c.0, &c.1))
///     }
/// }
///
/// let floats = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let answer = solve(&floats.map(Counted), &Method::Penalty { penalty: Counted(100.0) })?;
/// let known = solve(&floats, &Method::Penalty { penalty: 100.0 })?;
/// assert_eq!(answer.deflection.0, known.deflection);
/// assert_eq!(answer.bounds.deflection.lower.0, known.bounds.deflection.lower);
/// assert!(OPERATIONS.get() > 5); // those of (1.13), and a few besides
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub trait Scalar: OrderedField {
    /// Type of enclosures: [`Ball`]s of a float, or rationals themselves.
    type Enclosure: PositivePart;

    /// Returns an enclosure of exactly this number. Arithmetic on enclosures, ⟨·⟩ and min must enclose the
    /// exact results.
    fn enclose(&self) -> Self::Enclosure;

    /// Returns an interval of scalars that contains the enclosure; infinite if nothing is known.
    fn interval(enclosure: &Self::Enclosure) -> Interval<Self>;

    /// Returns a scalar not less than the absolute value of any number in the enclosure.
    fn magnitude(enclosure: &Self::Enclosure) -> Self;

    /// Returns the common sign of all numbers in the enclosure; `None` if they differ.
    fn sign(enclosure: &Self::Enclosure) -> Option<Ordering>;

    /// Encloses xᵏ by repeated squaring; `None` if the result would be too long. The default never returns
    /// `None`: if enclosures are rationals, delegate to the power of [`Exact`](crate::number::Exact), which
    /// does.
    fn power(x: &Self::Enclosure, k: u64) -> Option<Self::Enclosure> {
        Some(power(x, k))
    }

    /// Returns `true` if the number is neither infinite nor NaN.
    fn is_finite(&self) -> bool;

    /// Returns `true` if the exact value of every finite number is known, as the signs and bounds require. A
    /// parameter without one is refused.
    fn has_exact_value(&self) -> bool {
        true
    }

    /// Returns the number of binary digits, as [`Exact::bit_length`](crate::number::Exact::bit_length) counts
    /// them, of a number whose length grows with arithmetic. The default is 0, for numbers of constant
    /// length. An augmentation whose multipliers become too long ends with an error.
    fn variable_bit_length(&self) -> u64 {
        0
    }

    /// Returns the exact sign of a₁b₁ + a₂b₂ − a₃b₃. It is slower than the sign of an enclosure.
    fn sign_of_sum(plus: [(&Self, &Self); 2], minus: (&Self, &Self)) -> Ordering;
}

pub(super) fn power<E: PositivePart>(x: &E, k: u64) -> E {
    let mut power = E::one();
    for digit in (0..u64::BITS - k.leading_zeros()).rev() {
        power = &power * &power;
        if k >> digit & 1 == 1 {
            power = power * x;
        }
    }
    power
}

/// Limit of binary digits, beyond which a computation takes minutes and gigabytes.
pub(super) const MAX_BITS: u64 = 10_000_000;

macro_rules! by_ball {
    ($([$($generics:tt)*] $float:ty, $sign:expr $(, $power:item)*;)*) => {$(
        impl<$($generics)*> Scalar for $float {
            type Enclosure = Ball<$float>;
            #[inline]
            fn enclose(&self) -> Ball<$float> {
                Ball::point(self.clone())
            }
            #[inline]
            fn interval(ball: &Ball<$float>) -> Interval<Self> {
                Interval { lower: ball.lower(), upper: ball.upper() }
            }
            #[inline]
            fn magnitude(ball: &Ball<$float>) -> Self {
                ball.magnitude()
            }
            #[inline]
            fn sign(ball: &Ball<$float>) -> Option<Ordering> {
                ball.sign()
            }
            #[inline]
            fn is_finite(&self) -> bool {
                Real::is_finite(self)
            }
            $($power)*
            #[cold]
            fn sign_of_sum(plus: [(&Self, &Self); 2], minus: (&Self, &Self)) -> Ordering {
                $sign(plus, minus)
            }
        }
    )*};
}
#[cfg(feature = "mpfr")]
pub(super) use by_ball;

#[allow(clippy::clone_on_copy)]
mod machine {
    use super::*;
    by_ball! {
        [] f32, |plus: [(&f32, &f32); 2], minus: (&f32, &f32)| {
            sign_of_sum(plus.map(widen), widen(minus))
        };
        [] f64, |plus: [(&f64, &f64); 2], (a, b): (&f64, &f64)| {
            sign_of_sum(plus.map(|(a, b)| (*a, *b)), (*a, *b))
        };
    }
}

fn widen((a, b): (&f32, &f32)) -> (f64, f64) {
    (f64::from(*a), f64::from(*b))
}

fn sign_of_sum(plus: [(f64, f64); 2], (a, b): (f64, f64)) -> Ordering {
    let mut sum = Accumulator::new();
    for (a, b) in [plus[0], plus[1], (-a, b)] {
        sum.add(a, b);
    }
    sum.sign()
}

/// Exponent of the last bit of the accumulator: 2^−2148 is the square of the smallest f64.
const LAST_BIT: i32 = 2 * -1074;
/// Range from 2^−2148 to more than 2^2048, the square of the largest f64, with room for carries and a sign.
const LIMBS: usize = 68;

/// Exact sum of products of f64s: an integer in two's complement, least limb first, that is wide enough for
/// every product.
struct Accumulator([u64; LIMBS]);

impl Accumulator {
    fn new() -> Self {
        Accumulator([0; LIMBS])
    }

    fn add(&mut self, a: f64, b: f64) {
        let ((m, e), (n, f)) = (decode(a), decode(b));
        let product = u128::from(m) * u128::from(n); // below 2^106
        let shift = (e + f - LAST_BIT).unsigned_abs() as usize;
        let (limb, bit) = (shift / 64, shift % 64);
        let low = product << bit;
        let high = if bit == 0 { 0 } else { product >> (128 - bit) };
        let parts = [low as u64, (low >> 64) as u64, high as u64];
        let negative = a.is_sign_negative() != b.is_sign_negative();
        let mut carry = false;
        for (i, own) in self.0.iter_mut().enumerate().skip(limb) {
            let part = parts.get(i - limb).copied().unwrap_or(0);
            let (x, y) = if negative { own.overflowing_sub(part) } else { own.overflowing_add(part) };
            let c = u64::from(carry);
            let (x, z) = if negative { x.overflowing_sub(c) } else { x.overflowing_add(c) };
            *own = x;
            carry = y || z;
            if !carry && i >= limb + parts.len() {
                break;
            }
        }
    }

    fn sign(&self) -> Ordering {
        if self.0[LIMBS - 1] >> 63 == 1 {
            Ordering::Less
        } else if self.0.iter().all(|limb| *limb == 0) {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }
}

/// Returns a finite |x| as an integer below 2^53 and the exponent of its power of two.
fn decode(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let (fraction, exponent) = (bits & ((1 << 52) - 1), ((bits >> 52) & 0x7ff) as i32);
    if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) }
}
