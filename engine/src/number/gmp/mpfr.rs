//! Floats with a precision chosen at run time.

use super::text::{fixed, to_whole};
use crate::number::field::ordered;
use crate::number::tree::Op;
use crate::number::{Exponential, Field, Logarithm, OrderedField, PositivePart, Real};
use num_traits::{One, Zero};
use rug::float::{Round, Special};
use rug::ops::{AddFrom, DivFrom, MulAssignRound, MulFrom, SubFrom};
use rug::{Assign, Float, Integer, Rational};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{AddAssign, DivAssign, MulAssign, RangeInclusive, SubAssign};

/// Allowed precisions of [`Mpfr`], in bits.
pub const PRECISIONS: RangeInclusive<u32> = 2..=1_000_000;

/// Precision of a radius; a larger one would not improve the bound.
const RADIUS_PRECISION: u32 = 64;

/// A float of the MPFR library with a precision chosen at run time.
///
/// - Every operation is one correctly rounded MPFR operation, to nearest.
/// - The result of two rounded operands has the larger of their precisions. It never depends on which operand
///   is borrowed. (rug's own `Float` takes the precision of the owned operand.)
/// - A constant (zero, one, small integers, and results of operations on constants) has no precision of its
///   own: it stays an exact rational until it meets a rounded number.
/// - The range of exponents is ±2³⁰, practically unlimited.
///
/// # Examples
///
/// ```
/// use provable::number::{Exact, Field, Mpfr};
/// let third = "1/3".parse::<Exact>()?.to_mpfr(10);
/// assert_eq!((&third * Mpfr::int(3)).precision(), Some(10));
/// assert_eq!((&third + Mpfr::parse("0.1", 200)?).precision(), Some(200));
/// assert_eq!((Mpfr::int(1) / Mpfr::int(3)).precision(), None); // 1/3 exactly
/// # Ok::<(), provable::number::ParseError>(())
/// ```
#[derive(Clone)]
pub struct Mpfr(Kind);

#[derive(Clone, Debug)]
enum Kind {
    /// A constant as well; almost all of them are small integers, which need no memory of their own.
    Small(i32),
    Constant(Rational),
    Rounded(Float),
}
use Kind::{Constant, Rounded, Small};

impl Kind {
    fn constant(q: Rational) -> Self {
        if *q.denom() == 1
            && let Some(n) = q.numer().to_i32()
        {
            Small(n)
        } else {
            Constant(q)
        }
    }

    /// Returns the exact value.
    ///
    /// # Panics
    /// Panics if the number is infinite or NaN.
    fn rational(&self) -> Rational {
        match self {
            Small(n) => Rational::from(*n),
            Constant(q) => q.clone(),
            Rounded(x) => x.to_rational().expect("a finite number"),
        }
    }

    /// Stores a result of this precision, and reuses the present float if it has the same precision.
    #[inline]
    fn put<V>(&mut self, precision: u32, result: V)
    where
        Float: Assign<V>,
    {
        match self {
            Rounded(x) if x.prec() == precision => x.assign(result),
            // Moved at most once, because moving a new number is slow.
            other => *other = Rounded(Float::with_val(precision, result)),
        }
    }
}

/// Implements the four combinations of owned and borrowed operands by one function that stores the result in
/// place.
macro_rules! operator {
    ($($Trait:ident $f:ident $assign:ident $from:ident $op:tt $small:expr, $constant_first:expr;)*) => {
        /// The operators with the result stored in an existing number.
        mod assign {
            use super::*;
            $(pub(super) fn $f(result: &mut Kind, a: &Mpfr, b: &Mpfr) {
                match (&a.0, &b.0) {
                    (Rounded(a), Rounded(b)) => result.put(a.prec().max(b.prec()), a $op b),
                    (Rounded(a), Small(b)) => result.put(a.prec(), a $op b),
                    (Rounded(a), Constant(b)) => result.put(a.prec(), a $op b),
                    (Small(a), Rounded(b)) => result.put(b.prec(), a $op b),
                    (Constant(a), Rounded(b)) => $constant_first(result, a, b),
                    (a, b) => {
                        let small = if let (Small(a), Small(b)) = (a, b) { $small(*a, *b) } else { None };
                        let exact = || Kind::constant(a.rational() $op b.rational());
                        *result = small.map_or_else(exact, Small);
                    }
                }
            })*
        }
        $(
        impl std::ops::$Trait<&Mpfr> for &Mpfr {
            type Output = Mpfr;
            fn $f(self, other: &Mpfr) -> Mpfr {
                let mut result = Small(0);
                assign::$f(&mut result, self, other);
                Mpfr(result)
            }
        }
        impl std::ops::$Trait<&Mpfr> for Mpfr {
            type Output = Mpfr;
            fn $f(mut self, other: &Mpfr) -> Mpfr {
                match (&mut self.0, &other.0) {
                    (Rounded(a), Rounded(b)) if a.prec() >= b.prec() => a.$assign(b),
                    (Rounded(a), Small(b)) => a.$assign(b),
                    (Rounded(a), Constant(b)) => a.$assign(b),
                    _ => return &self $op other,
                }
                self
            }
        }
        impl std::ops::$Trait<Mpfr> for &Mpfr {
            type Output = Mpfr;
            fn $f(self, mut other: Mpfr) -> Mpfr {
                match (&self.0, &mut other.0) {
                    (Rounded(a), Rounded(b)) if b.prec() >= a.prec() => b.$from(a),
                    (Small(a), Rounded(b)) => b.$from(a),
                    _ => return self $op &other,
                }
                other
            }
        }
        impl std::ops::$Trait<Mpfr> for Mpfr {
            type Output = Mpfr;
            fn $f(self, other: Mpfr) -> Mpfr {
                if self.precision() < other.precision() { &self $op other } else { self $op &other }
            }
        }
    )*};
}
operator! {
    Add add add_assign add_from + i32::checked_add,
        |x: &mut Kind, a: &Rational, b: &Float| x.put(b.prec(), a + b);
    Sub sub sub_assign sub_from - i32::checked_sub,
        |x: &mut Kind, a: &Rational, b: &Float| x.put(b.prec(), a - b);
    Mul mul mul_assign mul_from * i32::checked_mul,
        |x: &mut Kind, a: &Rational, b: &Float| x.put(b.prec(), a * b);
    Div div div_assign div_from / |_, _| None, divide_constant;
}

/// Computes (n/d) / x = n / (d x). MPFR lacks this operation, but d x is exact with enough bits.
fn divide_constant(result: &mut Kind, a: &Rational, x: &Float) {
    let wide = |bits: u32| bits.max(2);
    let n = Float::with_val(wide(a.numer().significant_bits()), a.numer());
    let dx = Float::with_val(wide(a.denom().significant_bits() + x.prec()), x * a.denom());
    // Both are borrowed, because an owned n would determine the precision of the quotient.
    result.put(x.prec(), &n / &dx);
}

impl std::ops::Neg for Mpfr {
    type Output = Mpfr;
    fn neg(self) -> Mpfr {
        Mpfr(match self.0 {
            // The smallest integer has no opposite.
            Small(n) => n.checked_neg().map_or_else(|| Constant(-Rational::from(n)), Small),
            Constant(q) => Constant(-q),
            Rounded(x) => Rounded(-x),
        })
    }
}
impl std::ops::Neg for &Mpfr {
    type Output = Mpfr;
    fn neg(self) -> Mpfr {
        -self.clone()
    }
}
impl PartialEq for Mpfr {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}
impl PartialOrd for Mpfr {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match (&self.0, &other.0) {
            (Small(a), Rounded(b)) => a.partial_cmp(b),
            (Constant(a), Rounded(b)) => a.partial_cmp(b),
            (Rounded(a), Small(b)) => a.partial_cmp(b),
            (Rounded(a), Constant(b)) => a.partial_cmp(b),
            (Rounded(a), Rounded(b)) => a.partial_cmp(b),
            (Small(a), Small(b)) => a.partial_cmp(b),
            (a, b) => a.rational().partial_cmp(&b.rational()),
        }
    }
}
impl Zero for Mpfr {
    fn zero() -> Self {
        Mpfr(Small(0))
    }
    fn is_zero(&self) -> bool {
        match &self.0 {
            Small(n) => *n == 0,
            Constant(q) => q.is_zero(),
            Rounded(x) => x.is_zero(),
        }
    }
}
impl One for Mpfr {
    fn one() -> Self {
        Mpfr::int(1)
    }
}
impl Field for Mpfr {
    fn int(n: i32) -> Self {
        Mpfr(Small(n))
    }

    const IN_PLACE: bool = true;

    fn assign_op(&mut self, op: Op<&Self>) -> bool {
        match op {
            Op::Int(n) => self.0 = Small(n),
            Op::Neg(Mpfr(Rounded(a))) => self.0.put(a.prec(), -a),
            Op::Neg(a) => *self = -a,
            Op::Add(a, b) => assign::add(&mut self.0, a, b),
            Op::Sub(a, b) => assign::sub(&mut self.0, a, b),
            Op::Mul(a, b) => assign::mul(&mut self.0, a, b),
            Op::Div(a, b) => assign::div(&mut self.0, a, b),
            Op::Symbol(_) | Op::Exp(_) | Op::PositivePart(_) | Op::Min(..) | Op::Rounded(_) => {
                return false;
            }
        }
        true
    }
}
ordered!([] Mpfr);

/// Panics, because a function of a constant is irrational and has no precision to round to.
fn no_precision(function: &str) -> ! {
    panic!("{function} of a constant without a precision: round it first, with Mpfr::rounded")
}

/// # Panics
/// Panics for a constant that has not met a rounded number, except exp 0 = 1, ln 1 = 0 and ln_1p 0 = 0.
impl Exponential for Mpfr {
    fn exp(&self) -> Self {
        match &self.0 {
            Rounded(x) => Mpfr(Rounded(Float::with_val(x.prec(), x.exp_ref()))),
            Small(_) | Constant(_) if self.is_zero() => Mpfr::one(),
            Small(_) | Constant(_) => no_precision("exp"),
        }
    }
}
impl Logarithm for Mpfr {
    fn ln(&self) -> Self {
        match &self.0 {
            Rounded(x) => Mpfr(Rounded(Float::with_val(x.prec(), x.ln_ref()))),
            Small(_) | Constant(_) if self.is_one() => Mpfr::zero(),
            Small(_) | Constant(_) => no_precision("ln"),
        }
    }
    fn ln_1p(&self) -> Self {
        match &self.0 {
            Rounded(x) => Mpfr(Rounded(Float::with_val(x.prec(), x.ln_1p_ref()))),
            Small(_) | Constant(_) if self.is_zero() => Mpfr::zero(),
            Small(_) | Constant(_) => no_precision("ln_1p"),
        }
    }
}
impl Real for Mpfr {
    fn unit_roundoff(&self) -> Self {
        self.as_float()
            .map_or_else(Mpfr::zero, |x| Mpfr(Rounded(Float::with_val(RADIUS_PRECISION, 1) >> x.prec())))
    }
    fn min_subnormal() -> Self {
        Mpfr::zero()
    }
    fn is_finite(&self) -> bool {
        self.as_float().is_none_or(Float::is_finite)
    }
    fn infinity() -> Self {
        Mpfr(Rounded(Float::with_val(RADIUS_PRECISION, Special::Infinity)))
    }
    /// A constant has no neighbours and is returned unchanged.
    fn next_up(mut self) -> Self {
        if let Rounded(x) = &mut self.0 {
            x.next_up();
        }
        self
    }
    fn half_ulp(&self) -> Self {
        let Rounded(x) = &self.0 else { return Mpfr::zero() };
        // x lies between 2^(e−1) and 2^e. Zero and non-finite numbers have no exponent e.
        let Some(e) = x.get_exp() else { return self.magnitude() };
        let half = Float::i_exp(1, e - x.prec() as i32 - 1);
        Mpfr(Rounded(Float::with_val(RADIUS_PRECISION, half)))
    }
    fn magnitude(&self) -> Self {
        let (size, _) = match self.as_float() {
            Some(x) => Float::with_val_round(RADIUS_PRECISION, x.abs_ref(), Round::Up),
            None => Float::with_val_round(RADIUS_PRECISION, &self.0.rational().abs(), Round::Up),
        };
        Mpfr(Rounded(size))
    }
    fn inflated(mut self) -> Self {
        if let Rounded(x) = &mut self.0 {
            // Multiplies by 1 + 16 η.
            x.mul_assign_round((1u64 << 60) + 1, Round::Up);
            *x >>= 60;
        }
        self
    }
}

impl Mpfr {
    /// Rounds any number of the crate rug once to `precision` bits, to nearest.
    ///
    /// # Panics
    /// Panics if the precision is not in [`PRECISIONS`].
    pub fn rounded<V>(precision: u32, value: V) -> Self
    where
        Float: rug::Assign<V> + rug::ops::AssignRound<V, Round = Round, Ordering = Ordering>,
    {
        assert!(
            PRECISIONS.contains(&precision),
            "a precision of {precision} bits; it must be from 2 to 1000000"
        );
        Mpfr(Rounded(Float::with_val(precision, value)))
    }

    /// Returns an exact constant, which has no precision of its own.
    pub fn constant(value: Rational) -> Self {
        Mpfr(Kind::constant(value))
    }

    /// Returns the precision in bits; `None` for a constant.
    pub fn precision(&self) -> Option<u32> {
        self.as_float().map(Float::prec)
    }

    /// Returns the underlying float of the crate rug; `None` for a constant.
    pub fn as_float(&self) -> Option<&Float> {
        match &self.0 {
            Small(_) | Constant(_) => None,
            Rounded(x) => Some(x),
        }
    }

    /// Returns the integer nearest to `times` times a finite number, ties to even.
    fn to_whole(&self, times: &Integer) -> Integer {
        match &self.0 {
            Small(_) | Constant(_) => to_whole(self.0.rational() * times),
            Rounded(x) => {
                let exact = Float::with_val(x.prec() + times.significant_bits(), x * times);
                exact.to_integer_round(Round::Nearest).expect("a finite number").0
            }
        }
    }

    /// Returns the exact value; `None` if it is infinite or NaN.
    pub fn to_rational(&self) -> Option<Rational> {
        self.as_float().map_or_else(|| Some(self.0.rational()), Float::to_rational)
    }
}

impl From<Float> for Mpfr {
    fn from(x: Float) -> Self {
        Mpfr(Rounded(x))
    }
}

/// Writes all digits: parsing the text with the same precision returns the same number if its exponent is
/// within [`MAX_EXPONENT`](super::MAX_EXPONENT). A constant is written as a fraction.
///
/// With a precision, as in `{:.5}`, writes that number of decimals, correctly rounded from the exact value,
/// like machine floats; also for a constant. Width, fill and sign are supported.
///
/// # Examples
///
/// ```
/// use provable::number::{Field, Mpfr};
/// let ninth = Mpfr::rounded(200, 1) / Mpfr::int(9);
/// assert_eq!(format!("{ninth:.3} {ninth:+8.1}"), "0.111     +0.1");
/// ```
impl fmt::Display for Mpfr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let (Some(decimals), true) = (f.precision(), self.is_finite()) {
            let negative = *self < Mpfr::zero();
            return f.pad_integral(!negative, "", &fixed(decimals, |unit| self.to_whole(unit)));
        }
        let text = match &self.0 {
            Small(_) | Constant(_) => return fmt::Display::fmt(&self.0.rational(), f),
            Rounded(x) if !x.is_finite() => return fmt::Display::fmt(&x.to_f64(), f),
            Rounded(x) if x.is_zero() => "0".to_string(),
            Rounded(x) => x.to_string_radix(10, None),
        };
        // rug pads the mantissa with insignificant zeros to the digits of the precision.
        let (mantissa, exponent) = text.split_once('e').map_or((text.as_str(), ""), |(m, e)| (m, e));
        let is_padded = mantissa.contains('.');
        let mantissa =
            if is_padded { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
        let separator = if exponent.is_empty() { "" } else { "e" };
        f.pad_integral(
            !mantissa.starts_with('-'),
            "",
            &format!("{}{separator}{exponent}", mantissa.trim_start_matches('-')),
        )
    }
}

/// Writes the same as `Display`.
impl fmt::Debug for Mpfr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
