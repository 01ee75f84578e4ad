//! What the solver asks of its numbers, beyond arithmetic: bounds and an exact sign.

use crate::number::{Ball, OrderedField, PositivePart, Real};
use std::cmp::Ordering;

/// Two numbers, and all between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Interval<T> {
    /// The smaller one.
    pub lower: T,
    /// The larger one.
    pub upper: T,
}

impl<T: PartialOrd> Interval<T> {
    /// Is the number between the ends, or one of them? Decided by comparison, without rounding; never of
    /// not-a-number.
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
    /// How far the upper end is from the lower one: exactly, if the scalar has that number, and otherwise no
    /// less than that, by some roundings. Infinite if an end is or the distance overflows.
    ///
    /// ```
    /// # use spring_mass_contact::solver::Interval;
    /// assert_eq!(Interval { lower: 0.25, upper: 1.0 }.width(), 0.75);
    /// // 1 + 2⁻⁶⁰ is no f64.
    /// assert!(Interval { lower: -0.5_f64.powi(60), upper: 1.0 }.width() > 1.0);
    /// ```
    pub fn width(&self) -> T {
        let Interval { lower, upper } = self;
        let (one, width) = (T::one(), upper - lower);
        if !width.is_finite() || T::sign_of_sum([(upper, &one), (&-lower, &one)], (&width, &one)).is_le() {
            return width;
        }
        T::magnitude(&(upper.enclose() - lower.enclose()))
    }
}

/// Numbers that [`solve`](super::solve) takes: f32, f64, [`Mpfr`](crate::number::Mpfr) and
/// [`Exact`](crate::number::Exact), and your own.
///
/// Its bounds rest on what the methods promise. `laws::scalar`, which comes with the feature `mpfr`, tries
/// these promises in your own tests.
///
/// # Your own scalar
///
/// A number system by its [recipe](crate::number::field#your-own-number-system), an order, and what bounds
/// are computed in. Here it is an f64 that counts what is done with it. It borrows the balls of f64, so
/// that the methods pass on what those know:
///
/// ```
/// use num_traits::{One, Zero};
/// use spring_mass_contact::chapter::SpringMass;
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
/// let answer = solve(&floats.map(|&x| Counted(x)), &Method::Penalty { penalty: Counted(100.0) })?;
/// let known = solve(&floats, &Method::Penalty { penalty: 100.0 })?;
/// assert_eq!(answer.deflection.0, known.deflection);
/// assert_eq!(answer.bounds.deflection.lower.0, known.bounds.deflection.lower);
/// assert!(OPERATIONS.get() > 5); // those of (1.13), and a few besides
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub trait Scalar: OrderedField {
    /// What bounds are computed in: [`Ball`]s of a float, rationals themselves.
    type Enclosure: PositivePart;

    /// This number and no other. Its arithmetic, ⟨·⟩ and min must enclose the exact results.
    fn enclose(&self) -> Self::Enclosure;

    /// Two scalars with everything enclosed between them; infinite ones where nothing is known.
    fn interval(enclosure: &Self::Enclosure) -> Interval<Self>;

    /// A scalar no less than the absolute value of anything enclosed.
    fn magnitude(enclosure: &Self::Enclosure) -> Self;

    /// The sign of everything enclosed; `None` if not all of it has the same.
    fn sign(enclosure: &Self::Enclosure) -> Option<Ordering>;

    /// Encloses xᵏ, by repeated squaring; `None` if it is too long to be written down. By default it never
    /// is: where enclosures are rationals, pass on the power of [`Exact`](crate::number::Exact), which knows.
    fn power(x: &Self::Enclosure, k: u64) -> Option<Self::Enclosure> {
        Some(power(x, k))
    }

    /// Neither infinite nor not-a-number.
    fn is_finite(&self) -> bool;

    /// The binary digits of a number that arithmetic makes ever longer, as
    /// [`Exact::digits`](crate::number::Exact::digits) counts them; 0, as by default, where all numbers have
    /// the same length. An augmentation ends with an error before it takes for ever.
    fn growing_digits(&self) -> u64 {
        0
    }

    /// The sign of a₁b₁ + a₂b₂ − a₃b₃, without any rounding. It takes longer than an enclosure's.
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

/// More binary digits take a computer minutes and gigabytes.
pub(super) const LONGEST: u64 = 10_000_000;

macro_rules! by_ball {
    ($($float:ty, $sign:expr $(, $power:item)*;)*) => {$(
        impl Scalar for $float {
            type Enclosure = Ball<$float>;
            #[inline]
            fn enclose(&self) -> Ball<$float> {
                Ball::exactly(self.clone())
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
        f32, |plus: [(&f32, &f32); 2], minus: (&f32, &f32)| {
            let wide = |(a, b): (&f32, &f32)| (f64::from(*a), f64::from(*b));
            sign_of_sum(plus.map(wide), wide(minus))
        };
        f64, |plus: [(&f64, &f64); 2], (a, b): (&f64, &f64)| {
            sign_of_sum(plus.map(|(a, b)| (*a, *b)), (*a, *b))
        };
    }
}
fn sign_of_sum(plus: [(f64, f64); 2], (a, b): (f64, f64)) -> Ordering {
    let mut sum = Accumulator::new();
    for (a, b) in [plus[0], plus[1], (-a, b)] {
        sum.add(a, b);
    }
    sum.sign()
}

/// The weight of the accumulator's last bit is 2^−2148, the square of the smallest f64.
const LAST_BIT: i32 = 2 * -1074;
/// From 2^−2148 to beyond 2^2048, the square of the largest, with room for carries and a sign.
const LIMBS: usize = 68;

/// A sum of products of f64s without rounding: an integer so wide that every product fits, in two's
/// complement, least limb first.
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

/// A finite |x| as an integer below 2^53 and the power of two it is to be multiplied by.
fn decode(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let (fraction, exponent) = (bits & ((1 << 52) - 1), ((bits >> 52) & 0x7ff) as i32);
    if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) }
}
