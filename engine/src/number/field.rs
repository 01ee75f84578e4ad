//! Traits of the numbers that formulas are evaluated in.
//!
//! | trait | adds | for |
//! |---|---|---|
//! | [`Field`] | `+ − × ÷`, zero, one, small integers | identities |
//! | [`PositivePart`] | ⟨x⟩ = max(x, 0), min and \|x\| | unilateral conditions |
//! | [`Exponential`] | eˣ | growth and decay |
//! | [`OrderedField`] | `<` | stopping criteria, searches |
//! | [`Real`] | rounding | error bounds |
//! | [`Logarithm`] | ln | floats only |
//!
//! # Operators on references
//! A formula should read like the book, `(eps * (h - l) + m * g) / (c + eps)`, both for numbers that are
//! cheap to copy and for numbers that are not. So every operator has to exist in four forms, with each
//! operand owned or borrowed. In Rust a trait implies its bounds on `Self`, but a bound on `&'r Self` in a
//! `where` clause has to be repeated by every function that uses the trait. Only bounds on `Self` *and on its
//! associated types* are implied. Therefore the trait [`Imply<X>`] holds for every type and has an associated
//! type `Is` that equals `X`. `Field: Imply<&'r Self, Is: Add<…>>` is a bound on an associated type of
//! `Self`, and therefore implied; since `Is` *is* `&'r Self`, it has the effect of the `where` clause. This
//! takes two traits, because the equality `Is = X` is implied only in the header of a supertrait.
//!
//! (It works for type parameters, `T: Field`. An associated type cannot be bounded by `Field` itself, but by
//! a trait that has it as a supertrait, such as [`PositivePart`]. The limitation of the language is issue
//! rust-lang/rust#44491.)
//!
//! # Your own number system
//! A float with `Float` of num-traits needs only [`Native`](crate::number::Native). Any other number system is
//! a newtype with its operators on references by [`operators!`](crate::operators), `Zero`,
//! `One` and one line of `Field`; every formula then runs on it. This example is the integers modulo 7, in
//! which 1/3 = 5:
//!
//! ```
//! use provable::num_traits::{One, Zero};
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

use super::tree::Op;
use num_traits::{One, Zero};
use std::{
    fmt::Debug,
    ops::{Add, Div, Mul, Neg, Sub},
};

/// Names the type `T` in the header of a trait, so that its bounds are implied by the trait.
pub trait Imply<T>: ImplyInner<T, Is = T> {}
impl<S: ?Sized, T> Imply<T> for S {}

/// The supertrait of [`Imply`] that holds the type.
pub trait ImplyInner<T> {
    /// `T` itself.
    type Is;
}
impl<S: ?Sized, T> ImplyInner<T> for S {
    type Is = T;
}

/// Numbers with `+ − × ÷`, which suffice for identities.
///
/// Each operator takes its operands owned or borrowed, in all four combinations, and the result does not
/// depend on which. The exactness of the operations is that of the number system: rationals are exact, floats
/// round each result to nearest, balls bound the error. `Debug` shows every bit, so that tests can
/// distinguish results that compare equal.
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
    /// Returns a small integer exactly, at least for |n| ≤ 2⁸, which bf16 can represent, and otherwise the
    /// nearest number. A format with fewer digits needs exact constants like those of
    /// [`Mpfr`](crate::number::Mpfr).
    fn int(n: i32) -> Self;

    /// Returns `true` if `self` is invertible. This differs from `!is_zero()`: neither the dual number 0 +
    /// 1·ω nor a ball that contains zero is invertible.
    fn is_invertible(&self) -> bool {
        !self.is_zero()
    }

    /// Whether loops should reuse storage through [`assign_op`](Self::assign_op); set it for types whose
    /// operations allocate.
    const IN_PLACE: bool = false;

    /// Replaces `self` by the result of an arithmetic operation, bit for bit, and may reuse its memory.
    /// Returns `false` without a change for an operation that not every field has.
    fn assign_op(&mut self, op: Op<&Self>) -> bool {
        op.arithmetic().map(|result| *self = result).is_some()
    }
}

/// Numbers with ⟨x⟩ = max(x, 0) and min, for unilateral conditions.
///
/// These are methods because not every number system can decide a comparison: a ball that contains zero
/// cannot.
pub trait PositivePart: Field {
    /// Returns ⟨x⟩ = max(x, 0), exactly.
    fn positive_part(&self) -> Self;

    /// Returns the smaller of two numbers, exactly.
    fn min(&self, other: &Self) -> Self;

    /// Returns |x|, exactly.
    fn abs(&self) -> Self {
        -(-self).min(self)
    }
}

/// Numbers with eˣ.
///
/// f32 and f64 implement it with the feature `mpfr`, since correctly rounded functions come from MPFR.
pub trait Exponential: Field {
    /// Returns eˣ, correctly rounded for floats.
    fn exp(&self) -> Self;
}

/// Numbers with an order.
pub trait OrderedField: PositivePart + PartialOrd {}

/// Floating-point numbers: f32, f64, [`Native`](super::Native) floats and [`Mpfr`](super::Mpfr). Every operation rounds
/// to nearest.
///
/// [`Ball`](super::Ball)s of another type are correct if an operation differs from the exact result by at most
/// [`half_ulp`](Real::half_ulp) of the rounded one, a product or quotient by half of
/// [`min_subnormal`](Real::min_subnormal) more, and the methods below hold as stated.
pub trait Real: OrderedField {
    /// Returns the unit roundoff η at the precision of this value: 2⁻²⁴, 2⁻⁵³, or 2⁻ᵖ for p bits; 0 for an
    /// exact constant.
    fn unit_roundoff(&self) -> Self;

    /// Returns the smallest positive number, of which subnormal results are multiples; 0 if the range of
    /// exponents is unlimited.
    fn min_subnormal() -> Self;

    /// Returns `true` if the number is neither infinite nor NaN.
    fn is_finite(&self) -> bool;

    /// Returns +∞, the radius of a ball about which nothing is known.
    fn infinity() -> Self;

    /// Returns the next larger number of the same precision.
    fn next_up(self) -> Self;

    /// Returns the next smaller number of the same precision.
    fn next_down(self) -> Self {
        -(-self).next_up()
    }

    /// Returns half a unit in the last place or slightly more: an upper bound of the error of an operation
    /// that rounds to this result, above the subnormal numbers. 0 for 0, to which only a zero sum rounds; not
    /// finite if the result is not.
    fn half_ulp(&self) -> Self {
        // η|x|. Its own rounding does not decrease it: if half an ulp is not a float, no sum is rounded.
        self.magnitude() * self.unit_roundoff()
    }

    /// Returns an upper bound of |x| with few digits if x has very many; it is used for radii of balls.
    fn magnitude(&self) -> Self {
        self.abs()
    }

    /// Returns a slightly larger number for x ≥ 0: at least the exact result of up to ten operations, each of
    /// which decreased its result by η relative to itself, where η is that of [magnitudes](Real::magnitude).
    /// 0 stays 0.
    fn inflated(self) -> Self;
}

/// Floating-point numbers with ln. f32 and f64 implement it with the feature `mpfr`.
pub trait Logarithm: Real {
    /// Returns ln x, correctly rounded; x > 0.
    fn ln(&self) -> Self;

    /// Returns ln(1 + x), correctly rounded and accurate for small x; x > −1.
    fn ln_1p(&self) -> Self;
}

/// Implements the operators of a number system from their forms on references, in the four combinations of
/// owned and borrowed operands that [`Field`] requires.
///
/// The arguments are attributes of the operators' functions, if any, the generics in brackets, the type, and
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

/// Implements ⟨x⟩, min and |x| for numbers with an order.
macro_rules! ordered {
    ($([$($generics:tt)*] $type:ty),*) => {$(
        impl<$($generics)*> PositivePart for $type {
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
        impl<$($generics)*> OrderedField for $type {}
    )*};
}
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
            fn min_subnormal() -> Self {
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
            fn inflated(self) -> Self {
                // Multiplies by 1 + 12 η; the product may lose one η.
                self * (1.0 + 6.0 * $float::EPSILON)
            }
        }
    )*};
}
machine_float!(f32, f64);
#[allow(clippy::clone_on_copy)]
mod machine {
    use super::{OrderedField, PositivePart, Zero};
    ordered!([] f32, [] f64);
}
