//! Exact rational numbers.

use super::text::{fixed, to_whole};
use super::{FloatFormat, Mpfr, NumberSystem, RangeError};
use crate::number::field::ordered;
use crate::number::tree::Op;
use crate::number::{Ball, Field, OrderedField, PositivePart, Real};
use num_traits::{One, Zero};
use rug::float::Round;
use rug::ops::NegAssign;
use rug::{Assign, Float, Rational};
use std::cmp::Ordering;
use std::fmt;

/// A rational number with exact operations, for which `==` means equal values.
///
/// Division by zero panics, as for Rust's integers.
///
/// # Examples
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
        // rug reuses the allocation of an owned operand; its result of two references is completed by `from`.
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

    fn assign_op(&mut self, op: Op<&Self>) -> bool {
        match op {
            Op::Int(n) => self.0.assign(n),
            Op::Neg(a) => self.0.assign(-&a.0),
            Op::Add(a, b) => self.0.assign(&a.0 + &b.0),
            Op::Sub(a, b) => self.0.assign(&a.0 - &b.0),
            Op::Mul(a, b) => self.0.assign(&a.0 * &b.0),
            Op::Div(a, b) => self.0.assign(&a.0 / &b.0),
            Op::Symbol(_) | Op::Exp(_) | Op::PositivePart(_) | Op::Min(..) | Op::Rounded(_) => {
                return false;
            }
        }
        true
    }
}
ordered!([] Exact);

impl Exact {
    /// Rounds to `bits` bits, ties to even. Returns `None` if `bits` is 0.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::number::Exact;
    /// let tenth: Exact = "0.1".parse()?;
    /// assert_eq!(tenth.round_to_bits(3).unwrap(), "3/32".parse()?); // 0.09375; the next is 7/64
    /// # Ok::<(), provable::number::ParseError>(())
    /// ```
    pub fn round_to_bits(&self, bits: u32) -> Option<Self> {
        (bits > 0).then(|| Float::with_val(bits, &self.0).to_rational())?.map(Exact)
    }
}

/// Writes `p/q` in lowest terms, or an integer; parsing it returns the same number.
///
/// With a precision, as in `{:.5}`, writes that number of decimals, rounded to nearest with ties to even,
/// like machine floats. Width, fill and sign are supported.
///
/// # Examples
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

/// Writes the same as `Display`, so that the output of a failing test can be parsed.
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
        /// Converts the value of the float exactly; that of 0.1 is not 1/10.
        impl TryFrom<$float> for Exact {
            type Error = NonFiniteError;
            fn try_from(x: $float) -> Result<Self, NonFiniteError> {
                x.to_exact()
            }
        }
    )*};
}
from_floats!(f32, f64);

/// A number without an exact value, since it is not finite or of a type that does not return it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum NonFiniteError {
    /// ∞
    #[error("inf has no exact value; a finite number has")]
    Infinity,
    /// −∞
    #[error("-inf has no exact value; a finite number has")]
    NegativeInfinity,
    /// NaN
    #[error("NaN has no exact value; a finite number has")]
    NotANumber,
    /// A finite number of a type that returns only a part of it, such as its leading digits.
    #[error("integer_decode of this type does not return the whole number")]
    Incomplete,
}

impl NonFiniteError {
    /// Returns the error for a float that is not finite.
    pub(super) fn of(x: f64) -> Self {
        if x.is_nan() {
            NonFiniteError::NotANumber
        } else if x.is_sign_positive() {
            NonFiniteError::Infinity
        } else {
            NonFiniteError::NegativeInfinity
        }
    }
}

/// Numbers that convert to rationals exactly, and from rationals with one rounding: machine floats,
/// [`Native`](crate::number::Native) ones, [`Mpfr`] and [`Exact`] itself.
pub trait ToExact: Sized {
    /// Returns the exact value.
    ///
    /// # Errors
    /// Returns an error if the number is infinite or NaN, or if a type of [`Native`](crate::number::Native) does
    /// not return its value.
    fn to_exact(&self) -> Result<Exact, NonFiniteError>;

    /// Returns the number system of this number. Constants of [`Mpfr`] are exact.
    fn number_system(&self) -> NumberSystem;

    /// Rounds `x` once into this type, at the precision of `self` if it has one, and compares the result with
    /// `x`.
    ///
    /// # Errors
    /// Returns an error if the value overflows, or is nonzero and rounds to zero.
    fn round_from_exact_with_ordering(&self, x: &Exact) -> Result<(Self, Ordering), RangeError>;

    /// Like [`round_from_exact_with_ordering`](Self::round_from_exact_with_ordering), without the comparison.
    ///
    /// # Errors
    /// Returns the same errors.
    fn round_from_exact(&self, x: &Exact) -> Result<Self, RangeError> {
        self.round_from_exact_with_ordering(x).map(|(nearest, _)| nearest)
    }
}
macro_rules! machine {
    ($($float:ident $format:ident $from:ident $to:ident;)*) => {$(
        impl ToExact for $float {
            fn to_exact(&self) -> Result<Exact, NonFiniteError> {
                Rational::$from(*self).map(Exact).ok_or_else(|| NonFiniteError::of(f64::from(*self)))
            }
            fn number_system(&self) -> NumberSystem {
                NumberSystem::$format
            }
            fn round_from_exact_with_ordering(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
                FloatFormat::$format.round(&x.0).map(|(x, ordering)| (x.$to(), ordering))
            }
        }
    )*};
}
machine! { f32 F32 from_f32 to_f32; f64 F64 from_f64 to_f64; }
/// A constant represents every rational exactly.
impl ToExact for Mpfr {
    fn to_exact(&self) -> Result<Exact, NonFiniteError> {
        let float = || self.as_float().map_or(0.0, Float::to_f64);
        self.to_rational().map(Exact).ok_or_else(|| NonFiniteError::of(float()))
    }
    fn number_system(&self) -> NumberSystem {
        self.precision().map_or(NumberSystem::Exact, NumberSystem::Mpfr)
    }
    fn round_from_exact_with_ordering(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
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
    fn to_exact(&self) -> Result<Exact, NonFiniteError> {
        Ok(self.clone())
    }
    fn number_system(&self) -> NumberSystem {
        NumberSystem::Exact
    }
    fn round_from_exact_with_ordering(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
        Ok((x.clone(), Ordering::Equal))
    }
}

impl Exact {
    /// Returns the underlying rational number of the crate `rug`.
    pub fn as_rational(&self) -> &Rational {
        &self.0
    }

    /// Returns the total number of binary digits of numerator and denominator.
    ///
    /// # Examples
    ///
    /// ```
    /// # use provable::number::Exact;
    /// assert_eq!("-5/16".parse::<Exact>()?.bit_length(), 3 + 5);
    /// # Ok::<(), provable::number::ParseError>(())
    /// ```
    pub fn bit_length(&self) -> u64 {
        u64::from(self.0.numer().significant_bits()) + u64::from(self.0.denom().significant_bits())
    }

    /// Returns 2ⁿ.
    pub fn power_of_two(n: i32) -> Self {
        Exact(Rational::from(1) << n)
    }

    /// Rounds once to the nearest f64, ties to even, also if the result is subnormal.
    ///
    /// # Errors
    /// Returns an error if the value overflows, or is nonzero and rounds to zero.
    pub fn to_f64(&self) -> Result<f64, RangeError> {
        0f64.round_from_exact(self)
    }

    /// Rounds once to the nearest f32, ties to even, also if the result is subnormal.
    ///
    /// # Errors
    /// Returns an error if the value overflows, or is nonzero and rounds to zero.
    pub fn to_f32(&self) -> Result<f32, RangeError> {
        0f32.round_from_exact(self)
    }

    /// Rounds once to the nearest float of `precision` bits, ties to even.
    ///
    /// # Panics
    /// Panics if the precision is not in [`PRECISIONS`](super::PRECISIONS).
    pub fn to_mpfr(&self, precision: u32) -> Mpfr {
        Mpfr::rounded(precision, &self.0)
    }
}

impl Mpfr {
    /// Rounds once to the nearest f64, ties to even, also if the result is subnormal. Infinities and NaN are
    /// preserved.
    ///
    /// # Errors
    /// Returns an error if a finite value overflows, or is nonzero and rounds to zero.
    ///
    /// # Examples
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
            // Not through a rational, which can exceed the memory.
            Some(x) => FloatFormat::F64.round(x).map(|(x, _)| x.to_f64()),
        }
    }
}

impl<T: Real + ToExact> Ball<T> {
    /// Returns `true` if the ball contains this number, decided exactly.
    pub fn contains(&self, x: &Exact) -> bool {
        match (self.value().to_exact(), self.radius().to_exact()) {
            (Ok(value), Ok(radius)) => (x - value).abs() <= radius,
            _ => true, // an infinite ball contains everything
        }
    }

    /// Returns a ball that contains `x`, centred at the [nearest](ToExact::round_from_exact) float.
    ///
    /// # Errors
    /// Returns the errors of [`round_from_exact`](ToExact::round_from_exact).
    pub fn enclosing(like: &T, x: &Exact) -> Result<Self, RangeError> {
        let (nearest, ordering) = like.round_from_exact_with_ordering(x)?;
        Ok(if ordering.is_eq() { Ball::point(nearest) } else { Ball::from_rounded(nearest) })
    }
}
