//! Number systems under test.

use super::format::Format;
use proptest::prelude::*;
use provable::number::{Exact, Field};
use std::fmt::Debug;

/// A number system under test.
pub trait System: 'static {
    type Number: Clone + Debug + PartialEq + 'static;
    /// Exact meaning of a number: a rational, or a rational with its derivative.
    type Meaning: Oracle;

    fn number() -> BoxedStrategy<Planted<Self>> {
        Self::pair().prop_map(|(a, _)| a).boxed()
    }
    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)>;
    /// Returns `true` if `result` is a correct result of one operation with the exact result `exact`.
    fn stands_for(result: &Self::Number, exact: &Self::Meaning) -> bool;
    /// Returns `true` if the numbers are equal as far as the system can decide.
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        #[allow(clippy::eq_op)]
        let (a_is_nan, b_is_nan) = (a != a, b != b);
        a == b || (a_is_nan && b_is_nan)
    }
}

/// Exact results of the operations for any field.
///
/// It is separate from the field because the operators on references are implied by `T: Field` only for a
/// type parameter T, not for an associated type. For the same reason the laws name the numbers of their
/// system N.
pub trait Oracle: Clone + Debug + 'static {
    fn negative(&self) -> Self;
    /// Returns the four results; `None` for an undefined quotient.
    fn results(&self, other: &Self) -> [Option<Self>; 4];
}
impl<T: Field + 'static> Oracle for T {
    fn negative(&self) -> Self {
        -self
    }
    fn results(&self, other: &Self) -> [Option<Self>; 4] {
        operations().map(|(name, f)| (name != "/" || other.is_invertible()).then(|| f(self, other)))
    }
}

/// A number with one of the exact numbers that it represents.
pub type Planted<S> = (<S as System>::Number, <S as System>::Meaning);

/// Systems in which every operation rounds to nearest.
pub trait Floats: System<Meaning = Exact> {
    const FORMAT: Format;
    /// Returns `x`, which this format can represent.
    fn float(x: &Exact) -> Self::Number;
}

pub fn planted<S: Floats>((a, b): (Exact, Exact)) -> (Planted<S>, Planted<S>) {
    ((S::float(&a), a), (S::float(&b), b))
}

pub type Operation<T> = fn(&T, &T) -> T;

pub fn operations<T: Field>() -> [(&'static str, Operation<T>); 4] {
    [("+", |a, b| a + b), ("-", |a, b| a - b), ("*", |a, b| a * b), ("/", |a, b| a / b)]
}
