//! Exact rational numbers: the oracle.

use super::text::{fixed, to_whole};
use super::{Mpfr, NumberSystem, RangeError};
use crate::number::field::ordered;
use crate::number::tree::Step;
use crate::number::{Ball, Field, OrderedField, PositivePart, Real};
use num_traits::{One, Zero};
use rug::float::Round;
use rug::ops::{AssignRound, NegAssign};
use rug::{Assign, Float, Rational};
use std::cmp::Ordering;
use std::fmt;

/// A rational number; every operation is exact, and `==` means equal.
///
/// Division by zero panics, as it does for Rust's integers.
///
/// ```
/// use provable::number::Exact;
/// let g: Exact = "9.81".parse()?;
/// assert_eq!(g.to_string(), "981/100"); // the decimal itself, not the f64 beside it
/// assert_eq!("1/3".parse::<Exact>()? + "0.5".parse::<Exact>()?, "5/6".parse()?);
/// # Ok::<(), provable::number::ParseError>(())
/// ```
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Exact(pub(super) Rational);

macro_rules! operator {
    ($($Trait:ident $f:ident $op:tt;)*) => {$(
        // rug keeps an owned operand's allocation, and its result of two references is finished by `from`.
        operator!(@form $Trait $f $op Exact, Exact, self other self.0, other.0);
        operator!(@form $Trait $f $op Exact, &Exact, self other self.0, &other.0);
        operator!(@form $Trait $f $op &Exact, Exact, self other &self.0, other.0);
        operator!(@form $Trait $f $op &Exact, &Exact, self other &self.0, &other.0);
    )*};
    (@form $Trait:ident $f:ident $op:tt $left:ty, $right:ty, $self:ident $other:ident $a:expr, $b:expr) => {
        impl std::ops::$Trait<$right> for $left {
            type Output = Exact;
            fn $f($self, $other: $right) -> Exact {
                #[allow(clippy::useless_conversion)]
                Exact(Rational::from($a $op $b))
            }
        }
    };
}
operator! { Add add +; Sub sub -; Mul mul *; Div div /; }

impl std::ops::Neg for Exact {
    type Output = Exact;
    fn neg(mut self) -> Exact {
        self.0.neg_assign();
        self
    }
}
impl std::ops::Neg for &Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact(Rational::from(-&self.0))
    }
}
impl Zero for Exact {
    fn zero() -> Self {
        Exact(Rational::new())
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
impl One for Exact {
    fn one() -> Self {
        Exact(Rational::from(1))
    }
}
impl Field for Exact {
    fn int(n: i32) -> Self {
        Exact(Rational::from(n))
    }

    const IN_PLACE: bool = true;

    fn assign(&mut self, step: Step<&Self>) -> bool {
        match step {
            Step::Int(n) => self.0.assign(n),
            Step::Neg(a) => self.0.assign(-&a.0),
            Step::Add(a, b) => self.0.assign(&a.0 + &b.0),
            Step::Sub(a, b) => self.0.assign(&a.0 - &b.0),
            Step::Mul(a, b) => self.0.assign(&a.0 * &b.0),
            Step::Div(a, b) => self.0.assign(&a.0 / &b.0),
            Step::Symbol(_) | Step::Exp(_) | Step::PositivePart(_) | Step::Min(..) | Step::Rounded(_) => {
                return false;
            }
        }
        true
    }
}
ordered!(Exact);

impl Exact {
    /// The nearest number of so many bits, the even one of two; 0 bits are none.
    ///
    /// ```
    /// use provable::number::Exact;
    /// let tenth: Exact = "0.1".parse()?;
    /// assert_eq!(tenth.rounded(3).unwrap(), "3/32".parse()?); // 0.09375; the next is 7/64
    /// # Ok::<(), provable::number::ParseError>(())
    /// ```
    pub fn rounded(&self, bits: u32) -> Option<Self> {
        (bits > 0).then(|| Float::with_val(bits, &self.0).to_rational())?.map(Exact)
    }
}

/// As `p/q` in lowest terms, or as an integer; reading it back gives the same number.
///
/// With a number of decimals, as in `{:.5}`, it is that many, to the nearest and of two to the even one, as
/// for the machine's floats. Width, fill and sign are honoured.
///
/// ```
/// use provable::number::Exact;
/// let x: Exact = "-2/3".parse()?;
/// assert_eq!(format!("{x} {x:.3} {x:8.1}|"), "-2/3 -0.667     -0.7|");
/// # Ok::<(), provable::number::ParseError>(())
/// ```
impl fmt::Display for Exact {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match f.precision() {
            Some(decimals) => {
                let units = |unit: &_| to_whole(Rational::from(&self.0 * unit));
                f.pad_integral(*self >= Exact::zero(), "", &fixed(decimals, units))
            }
            None => fmt::Display::fmt(&self.0, f),
        }
    }
}

/// As it is displayed, so that a failing test prints what can be read back.
impl fmt::Debug for Exact {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl From<Rational> for Exact {
    fn from(q: Rational) -> Self {
        Exact(q)
    }
}
impl From<Exact> for Rational {
    fn from(x: Exact) -> Self {
        x.0
    }
}

macro_rules! from_integers {
    ($($integer:ty),*) => {$(
        impl From<$integer> for Exact {
            fn from(n: $integer) -> Self {
                Exact(Rational::from(n))
            }
        }
    )*};
}
from_integers!(i32, i64, u32, u64);

macro_rules! from_floats {
    ($($float:ty),*) => {$(
        /// The value of the float itself, which of 0.1 is not 1/10.
        impl TryFrom<$float> for Exact {
            type Error = Inexact;
            fn try_from(x: $float) -> Result<Self, Inexact> {
                x.to_exact()
            }
        }
    )*};
}
from_floats!(f32, f64);

/// A float that has no exact value, since it is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Inexact {
    /// ∞
    #[error("inf has no exact value; a finite number has")]
    Infinity,
    /// −∞
    #[error("-inf has no exact value; a finite number has")]
    NegativeInfinity,
    /// Not-a-number.
    #[error("NaN has no exact value; a finite number has")]
    NotANumber,
}

impl Inexact {
    /// Of a float that is not finite.
    fn of(x: f64) -> Self {
        if x.is_nan() {
            Inexact::NotANumber
        } else if x.is_sign_positive() {
            Inexact::Infinity
        } else {
            Inexact::NegativeInfinity
        }
    }
}

/// Numbers that convert to rationals exactly, and from them by one rounding: the machine's floats,
/// [`Mpfr`], and [`Exact`] itself.
pub trait ToExact: Sized {
    /// The value, exactly.
    ///
    /// # Errors
    /// It is infinite or not a number.
    fn to_exact(&self) -> Result<Exact, Inexact>;

    /// The number system that it is of. Constants of [`Mpfr`] are exact.
    fn number_system(&self) -> NumberSystem;

    /// `x` rounded once into this type, and at the precision that `self` has if that can differ; and how the
    /// result compares with `x`.
    ///
    /// # Errors
    /// The value overflows, or is not zero and would round to zero.
    fn nearest_compared(&self, x: &Exact) -> Result<(Self, Ordering), RangeError>;

    /// The same without the comparison.
    ///
    /// # Errors
    /// The same.
    fn nearest(&self, x: &Exact) -> Result<Self, RangeError> {
        self.nearest_compared(x).map(|(nearest, _)| nearest)
    }
}
impl ToExact for f32 {
    fn to_exact(&self) -> Result<Exact, Inexact> {
        Rational::from_f32(*self).map(Exact).ok_or_else(|| Inexact::of(f64::from(*self)))
    }
    fn number_system(&self) -> NumberSystem {
        NumberSystem::F32
    }
    fn nearest_compared(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
        to_ieee(&x.0, 24, "f32").map(|(x, ordering)| (x.to_f32(), ordering))
    }
}
impl ToExact for f64 {
    fn to_exact(&self) -> Result<Exact, Inexact> {
        Rational::from_f64(*self).map(Exact).ok_or_else(|| Inexact::of(*self))
    }
    fn number_system(&self) -> NumberSystem {
        NumberSystem::F64
    }
    fn nearest_compared(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
        to_ieee(&x.0, 53, "f64").map(|(x, ordering)| (x.to_f64(), ordering))
    }
}
/// Rounding like a constant does not round.
impl ToExact for Mpfr {
    fn to_exact(&self) -> Result<Exact, Inexact> {
        let float = || self.as_float().map_or(0.0, Float::to_f64);
        self.to_rational().map(Exact).ok_or_else(|| Inexact::of(float()))
    }
    fn number_system(&self) -> NumberSystem {
        self.precision().map_or(NumberSystem::Exact, NumberSystem::Mpfr)
    }
    fn nearest_compared(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
        Ok(match self.precision() {
            None => (Mpfr::constant(x.0.clone()), Ordering::Equal),
            Some(p) => {
                let (nearest, ordering) = Float::with_val_round(p, &x.0, Round::Nearest);
                (Mpfr::from(nearest), ordering)
            }
        })
    }
}
impl ToExact for Exact {
    fn to_exact(&self) -> Result<Exact, Inexact> {
        Ok(self.clone())
    }
    fn number_system(&self) -> NumberSystem {
        NumberSystem::Exact
    }
    fn nearest_compared(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
        Ok((x.clone(), Ordering::Equal))
    }
}

impl Exact {
    /// The rational number of the crate `rug` within.
    pub fn as_rational(&self) -> &Rational {
        &self.0
    }

    /// How long it is: the binary digits of its numerator and of its denominator together.
    ///
    /// ```
    /// # use provable::number::Exact;
    /// assert_eq!("-5/16".parse::<Exact>()?.digits(), 3 + 5);
    /// # Ok::<(), provable::number::ParseError>(())
    /// ```
    pub fn digits(&self) -> u64 {
        u64::from(self.0.numer().significant_bits()) + u64::from(self.0.denom().significant_bits())
    }

    /// 2ⁿ.
    pub fn power_of_two(n: i32) -> Self {
        Exact(Rational::from(1) << n)
    }

    /// Rounded once to the nearest f64, ties to even, also where f64 is subnormal.
    ///
    /// # Errors
    /// The value overflows, or is not zero and would round to zero.
    pub fn to_f64(&self) -> Result<f64, RangeError> {
        0f64.nearest(self)
    }

    /// Rounded once to the nearest f32, ties to even, also where f32 is subnormal.
    ///
    /// # Errors
    /// The value overflows, or is not zero and would round to zero.
    pub fn to_f32(&self) -> Result<f32, RangeError> {
        0f32.nearest(self)
    }

    /// Rounded once to the nearest float of `precision` bits, ties to even.
    ///
    /// # Panics
    /// The precision is not in [`PRECISIONS`](super::PRECISIONS).
    pub fn to_mpfr(&self, precision: u32) -> Mpfr {
        Mpfr::rounded(precision, &self.0)
    }
}

/// A finite number, rounded to one that a machine's float of so many bits holds.
fn to_ieee<V>(number: V, precision: u32, scalar: &'static str) -> Result<(Float, Ordering), RangeError>
where
    Float: AssignRound<V, Round = Round, Ordering = Ordering>,
{
    let (mut x, ordering) = Float::with_val_round(precision, number, Round::Nearest);
    let zero = x.is_zero();
    let ordering = x.subnormalize_ieee_round(ordering, Round::Nearest);
    let largest = if precision == 53 { f64::MAX } else { f64::from(f32::MAX) };
    if *x.as_abs() > largest {
        Err(RangeError::Overflow { scalar })
    } else if x.is_zero() && !zero {
        Err(RangeError::Underflow { scalar })
    } else {
        Ok((x, ordering))
    }
}

impl Mpfr {
    /// Rounded once to the nearest f64, ties to even, also where f64 is subnormal. What is infinite or not a
    /// number stays so.
    ///
    /// # Errors
    /// A finite value overflows, or is not zero and would round to zero.
    ///
    /// ```
    /// use provable::number::{Exact, Mpfr, RangeError};
    /// let third = "1/3".parse::<Exact>()?.to_mpfr(200);
    /// assert_eq!(third.to_f64(), Ok(1.0 / 3.0));
    /// assert_eq!(Mpfr::parse("1e400", 200)?.to_f64(), Err(RangeError::Overflow { scalar: "f64" }));
    /// # Ok::<(), provable::number::ParseError>(())
    /// ```
    pub fn to_f64(&self) -> Result<f64, RangeError> {
        match self.as_float() {
            None => Exact(self.to_rational().unwrap_or_default()).to_f64(),
            Some(x) if !x.is_finite() => Ok(x.to_f64()),
            // Not by way of a rational, which can be longer than the memory.
            Some(x) => to_ieee(x, 53, "f64").map(|(x, _)| x.to_f64()),
        }
    }
}

impl<T: Real + ToExact> Ball<T> {
    /// Does the ball contain this number? Decided exactly.
    pub fn contains(&self, x: &Exact) -> bool {
        match (self.value().to_exact(), self.radius().to_exact()) {
            (Ok(value), Ok(radius)) => (x - value).abs() <= radius,
            _ => true, // an infinite ball contains everything
        }
    }

    /// A ball that contains `x`, around the float that is [nearest](ToExact::nearest) to it.
    ///
    /// # Errors
    /// Those of [`nearest`](ToExact::nearest).
    pub fn around(like: &T, x: &Exact) -> Result<Self, RangeError> {
        let (nearest, ordering) = like.nearest_compared(x)?;
        Ok(if ordering.is_eq() { Ball::exactly(nearest) } else { Ball::rounded(nearest) })
    }
}
