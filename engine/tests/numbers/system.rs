//! Number systems as the laws see them.

use crate::format::Format;
use proptest::prelude::*;
use provable::number::{Exact, Field};
use std::fmt::Debug;

/// A number system as the laws see it.
pub trait System: 'static {
    type Number: Clone + Debug + PartialEq + 'static;
    /// What a number stands for: a rational, or a rational and its derivative.
    type Meaning: Oracle;

    fn number() -> BoxedStrategy<Planted<Self>> {
        Self::pair().prop_map(|(a, _)| a).boxed()
    }
    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)>;
    /// Is `result` what one operation has to return whose exact result is `exact`?
    fn stands_for(result: &Self::Number, exact: &Self::Meaning) -> bool;
    /// Are these the same number, as far as the system can tell?
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        #[allow(clippy::eq_op)]
        let (a_is_nan, b_is_nan) = (a != a, b != b);
        a == b || (a_is_nan && b_is_nan)
    }
}

/// The exact results of the operations: any field can be asked for them.
///
/// It stands between a system and its field since the operators on references come along with a bound
/// `T: Field` only where T is a type parameter, not with a bound on an associated type. For the same reason
/// the laws name the numbers of their system N.
pub trait Oracle: Clone + Debug + 'static {
    fn negative(&self) -> Self;
    /// `None` for a quotient that does not exist.
    fn results(&self, other: &Self) -> [Option<Self>; 4];
}
impl<T: Field + 'static> Oracle for T {
    fn negative(&self) -> Self {
        -self
    }
    fn results(&self, other: &Self) -> [Option<Self>; 4] {
        operations().map(|(name, f)| (name != "/" || other.is_unit()).then(|| f(self, other)))
    }
}

/// A number and one of the exact numbers that it stands for.
pub type Planted<S> = (<S as System>::Number, <S as System>::Meaning);

/// The systems whose every operation rounds to nearest.
pub trait Floats: System<Meaning = Exact> {
    const FORMAT: Format;
    /// `x`, which this format can hold.
    fn float(x: &Exact) -> Self::Number;
}

pub fn planted<S: Floats>((a, b): (Exact, Exact)) -> (Planted<S>, Planted<S>) {
    ((S::float(&a), a), (S::float(&b), b))
}

pub type Operation<T> = fn(&T, &T) -> T;

pub fn operations<T: Field>() -> [(&'static str, Operation<T>); 4] {
    [("+", |a, b| a + b), ("-", |a, b| a - b), ("*", |a, b| a * b), ("/", |a, b| a / b)]
}
