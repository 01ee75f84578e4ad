//! What a formula asks of the numbers it is read in.
//!
//! | trait | adds | so that one can write |
//! |---|---|---|
//! | [`Field`] | `+ − × ÷`, zero, one, small integers | identities |
//! | [`PositivePart`] | ⟨x⟩ = max(x, 0), min and \|x\| | what holds on one side only |
//! | [`Exponential`] | eˣ | growth and decay |
//! | [`OrderedField`] | `<` | stop tests, searches |
//! | [`Real`] | rounding | error bounds |
//! | [`Logarithm`] | ln | what floats alone can do |
//!
//! # The one clever thing here
//!
//! A formula should read like the book, `(eps * (h - l) + m * g) / (c + eps)`, for numbers that are
//! cheap to copy and for numbers that are not. So every operator has to exist in four forms, each
//! operand owned or borrowed. Rust lets a trait imply what it says of `Self`, but what it says of
//! `&'r Self` in a `where` clause has to be repeated by every function that uses the trait. Only
//! bounds on `Self` *and on its associated types* are implied. Hence a detour: [`Imply<X>`] is true
//! of every type and has an associated type `Is` that equals `X`. `Field: Imply<&'r Self, Is: Add<…>>`
//! is a bound on an associated type of `Self`, and therefore implied; since `Is` *is* `&'r Self`,
//! it says what the `where` clause would have said. The detour takes two traits, because the
//! equality `Is = X` is implied too only where it stands in a supertrait's header.
//! (It works for type parameters, `T: Field`. An associated type cannot be bounded by `Field` itself,
//! but by a trait that has it as a supertrait, such as [`PositivePart`]. The language's side of it is the
//! long-standing issue rust-lang/rust#44491.)
//!
//! # Your own number system
//!
//! A newtype, its operators from references by [`operators!`](crate::operators), `Zero`, `One` and
//! one line of `Field`; then every formula runs on it. Here it is the integers
//! modulo 7, in which 1/3 = 5:
//!
//! ```
//! use num_traits::{One, Zero};
//! use provable::{number::Field, operators};
//!
//! #[derive(Clone, Debug, PartialEq)]
//! struct Mod7(i32);
//!
//! operators! { [] Mod7;
//!     Add add |a, b| Mod7((a.0 + b.0) % 7);
//!     Sub sub |a, b| Mod7((a.0 - b.0).rem_euclid(7));
//!     Mul mul |a, b| Mod7(a.0 * b.0 % 7);
//!     Div div |a, b| (1..7).map(Mod7).find(|q| &(q * b) == a || a.0 == 0)
//!         .map_or_else(|| panic!("division by zero"), |q| if a.0 == 0 { Mod7(0) } else { q });
//!     - |a| Mod7((7 - a.0) % 7)
//! }
//! impl Zero for Mod7 {
//!     fn zero() -> Self { Mod7(0) }
//!     fn is_zero(&self) -> bool { self.0 == 0 }
//! }
//! impl One for Mod7 { fn one() -> Self { Mod7(1) } }
//! impl Field for Mod7 { fn int(n: i32) -> Self { Mod7(n.rem_euclid(7)) } }
//!
//! /// Two resistors side by side.
//! fn parallel<T: Field>(a: &T, b: &T) -> T {
//!     a * b / (a + b)
//! }
//!
//! let [a, b] = [2, 1].map(Mod7);
//! let r = parallel(&a, &b);
//! assert_eq!(r, Mod7(3)); // 2/3, where 1/3 is 5
//! assert_eq!(Mod7(1) / r, Mod7(1) / a + Mod7(1) / b);
//! ```

use super::tree::Step;
use num_traits::{One, Zero};
use std::{
    fmt::Debug,
    ops::{Add, Div, Mul, Neg, Sub},
};

/// Names the type `T` from the header of a trait, so that its bounds come along with the trait.
pub trait Imply<T>: ImplyInner<T, Is = T> {}
impl<S: ?Sized, T> Imply<T> for S {}

/// The half of [`Imply`] that holds the type.
pub trait ImplyInner<T> {
    /// `T` itself.
    type Is;
}
impl<S: ?Sized, T> ImplyInner<T> for S {
    type Is = T;
}

/// Numbers with `+ − × ÷`: enough for identities.
///
/// Each operator takes its operands owned or borrowed, in all four combinations, and the result does
/// not depend on which. How exact the operations are is the number system's own business: rationals
/// are, floats round each to nearest, balls say how far off they may be. `Debug` shows every bit: that is how
/// tests tell two results apart that are equal.
#[rustfmt::skip]
pub trait Field:
    Clone + Debug + PartialEq + Zero + One
    + Neg<Output = Self>
    + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
    + for<'r> Add<&'r Self, Output = Self> + for<'r> Sub<&'r Self, Output = Self>
    + for<'r> Mul<&'r Self, Output = Self> + for<'r> Div<&'r Self, Output = Self>
    + for<'r> Imply<&'r Self, Is:
        Neg<Output = Self>
        + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
        + Add<Self, Output = Self> + Sub<Self, Output = Self>
        + Mul<Self, Output = Self> + Div<Self, Output = Self>>
{
    /// A small integer, exactly: at least those up to 2²⁴ in size, which f32 holds. A format with fewer
    /// digits has exact constants besides, as [`Mpfr`](crate::number::Mpfr) has.
    fn int(n: i32) -> Self;

    /// May one divide by it? Not the same as `!is_zero()`: the dual number 0 + 1·ω is not zero, and
    /// yet nothing can be divided by it; nor by a ball that contains zero.
    fn is_unit(&self) -> bool {
        !self.is_zero()
    }

    /// Are operations so dear, and is so much gained by [`assign`](Self::assign), that a loop had better be
    /// run from its record, in rounds that use their memory again?
    const IN_PLACE: bool = false;

    /// Puts what a step of arithmetic comes to, bit for bit, where another number was, whose memory may
    /// serve again. Of the steps that not every field has it does nothing and says `false`.
    fn assign(&mut self, step: Step<&Self>) -> bool {
        step.arithmetic().map(|result| *self = result).is_some()
    }
}

/// Numbers with ⟨x⟩ = max(x, 0) and min: what holds on one side only.
///
/// These are methods and not comparisons in the formulas, since not everything a formula is read in
/// can always decide a sign: a ball around zero cannot.
pub trait PositivePart: Field {
    /// ⟨x⟩ = max(x, 0). Exact.
    fn positive_part(&self) -> Self;

    /// The smaller of two numbers. Exact.
    fn min(&self, other: &Self) -> Self;

    /// |x|, the larger of x and −x. Exact.
    fn abs(&self) -> Self {
        -(-self).min(self)
    }
}

/// Numbers with eˣ.
///
/// Without the feature `mpfr` f32 and f64 are none: correctly rounded functions come from MPFR.
pub trait Exponential: Field {
    /// eˣ, correctly rounded on floats.
    fn exp(&self) -> Self;
}

/// Numbers that can be compared.
pub trait OrderedField: PositivePart + PartialOrd {}

/// Floating-point numbers: f32, f64 and [`Mpfr`](super::Mpfr). Every operation rounds to nearest.
pub trait Real: OrderedField {
    /// η, the unit roundoff at the precision of this value: 2⁻²⁴, 2⁻⁵³, or 2⁻ᵖ for p bits (0 for a
    /// constant, which is exact).
    fn unit_roundoff(&self) -> Self;

    /// The smallest positive number, where results are rounded to multiples of it; 0 where the range
    /// of exponents has no end.
    fn underflow_unit() -> Self;

    /// Neither infinite nor not-a-number.
    fn is_finite(&self) -> bool;

    /// +∞, the radius of a ball about which nothing is known.
    fn infinity() -> Self;

    /// The next larger number of the same precision.
    fn next_up(self) -> Self;

    /// The next smaller number of the same precision.
    fn next_down(self) -> Self {
        -(-self).next_up()
    }

    /// Half a unit in the last place, or more: no operation that rounds to this result, above the
    /// subnormal numbers, errs by more. 0 for 0, which no sum that is not 0 rounds to; not finite where the
    /// result is not.
    fn half_ulp(&self) -> Self {
        // η|x|; when that is rounded it is no less, for where half an ulp is no float, no sum is rounded.
        self.magnitude() * self.unit_roundoff()
    }

    /// An upper bound of |x|, in few digits if x has very many: what the radius of a ball is made of.
    fn magnitude(&self) -> Self {
        self.abs()
    }

    /// A number ≥ 0, and a little more: no less than what it would have been without rounding, after up to
    /// ten operations that took η of their results, in parts of them. This η is that of
    /// [magnitudes](Real::magnitude). 0 stays 0.
    fn enlarged(self) -> Self;
}

/// Floating-point numbers with ln; as with [`Exponential`], f32 and f64 have it with the feature `mpfr`.
pub trait Logarithm: Real {
    /// ln x, correctly rounded; x > 0.
    fn ln(&self) -> Self;

    /// ln(1 + x), correctly rounded and accurate for small x; x > −1.
    fn ln_1p(&self) -> Self;
}

/// Writes the operators of a number system from their forms on references, each in the four
/// combinations of owned and borrowed operands that [`Field`] asks for.
///
/// First attributes for the operators' functions, if any, and the generics in brackets, then the type, then
/// the five operators. See the [recipe](self#your-own-number-system).
#[macro_export]
macro_rules! operators {
    (@neg ($(#[$attribute:meta])*) [$($generics:tt)*] $type:ty; |$n:ident| $negated:expr) => {
        impl<$($generics)*> ::std::ops::Neg for &$type {
            type Output = $type;
            $(#[$attribute])*
            fn neg(self) -> $type { let $n = self; $negated }
        }
        impl<$($generics)*> ::std::ops::Neg for $type {
            type Output = $type;
            $(#[$attribute])*
            fn neg(self) -> $type { -&self }
        }
    };
    (@binary ($(#[$attribute:meta])*) [$($generics:tt)*] $type:ty;
     $Trait:ident $f:ident |$a:ident, $b:ident| $body:expr) => {
        impl<$($generics)*> ::std::ops::$Trait<&$type> for &$type {
            type Output = $type;
            $(#[$attribute])*
            fn $f(self, other: &$type) -> $type { let ($a, $b) = (self, other); $body }
        }
        impl<$($generics)*> ::std::ops::$Trait<$type> for &$type {
            type Output = $type;
            $(#[$attribute])*
            fn $f(self, other: $type) -> $type { ::std::ops::$Trait::$f(self, &other) }
        }
        impl<$($generics)*> ::std::ops::$Trait<&$type> for $type {
            type Output = $type;
            $(#[$attribute])*
            fn $f(self, other: &$type) -> $type { ::std::ops::$Trait::$f(&self, other) }
        }
        impl<$($generics)*> ::std::ops::$Trait<$type> for $type {
            type Output = $type;
            $(#[$attribute])*
            fn $f(self, other: $type) -> $type { ::std::ops::$Trait::$f(&self, &other) }
        }
    };
    ($(#[$attribute:meta])* [$($generics:tt)*] $type:ty;
     $($Trait:ident $f:ident |$a:ident, $b:ident| $body:expr;)*
     - |$n:ident| $negated:expr) => {
        $crate::operators!(@all ($(#[$attribute])*) [$($generics)*] $type;
            $($Trait $f |$a, $b| $body;)* - |$n| $negated);
    };
    (@all $attributes:tt $generics:tt $type:ty;
     $($Trait:ident $f:ident |$a:ident, $b:ident| $body:expr;)*
     - |$n:ident| $negated:expr) => {
        $($crate::operators!(@binary $attributes $generics $type; $Trait $f |$a, $b| $body);)*
        $crate::operators!(@neg $attributes $generics $type; |$n| $negated);
    };
}

/// ⟨x⟩, min and |x| for numbers that compare.
macro_rules! ordered {
    ($($type:ty),*) => {$(
        impl PositivePart for $type {
            #[inline]
            fn positive_part(&self) -> Self {
                if *self > <$type>::zero() { self.clone() } else { <$type>::zero() }
            }
            #[inline]
            fn min(&self, other: &Self) -> Self {
                if other < self { other.clone() } else { self.clone() }
            }
            #[inline]
            fn abs(&self) -> Self {
                if *self < <$type>::zero() { -self } else { self.clone() }
            }
        }
        impl OrderedField for $type {}
    )*};
}
#[cfg(feature = "mpfr")]
pub(crate) use ordered;

macro_rules! machine_float {
    ($($float:ident),*) => {$(
        impl Field for $float {
            #[inline]
            fn int(n: i32) -> Self {
                n as $float
            }
        }
        impl Real for $float {
            #[inline]
            fn unit_roundoff(&self) -> Self {
                $float::EPSILON / 2.0
            }
            #[inline]
            fn underflow_unit() -> Self {
                $float::from_bits(1)
            }
            #[inline]
            fn is_finite(&self) -> bool {
                $float::is_finite(*self)
            }
            #[inline]
            fn infinity() -> Self {
                $float::INFINITY
            }
            #[inline]
            fn next_up(self) -> Self {
                $float::next_up(self)
            }
            #[inline]
            fn magnitude(&self) -> Self {
                $float::abs(*self)
            }
            #[inline]
            fn enlarged(self) -> Self {
                // By 12 η, of which the product may lose one.
                self * (1.0 + 6.0 * $float::EPSILON)
            }
        }
    )*};
}
machine_float!(f32, f64);
#[allow(clippy::clone_on_copy)]
mod machine {
    use super::{OrderedField, PositivePart, Zero};
    ordered!(f32, f64);
}
