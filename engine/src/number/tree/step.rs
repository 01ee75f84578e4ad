//! The steps of a formula, and where they are written.

use crate::number::{Exponential, Field, PositivePart};
use std::fmt;

/// The last step of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step<T> {
    /// A quantity.
    Symbol(&'static str),
    /// A small integer.
    Int(i32),
    /// −a
    Neg(T),
    /// a + b
    Add(T, T),
    /// a − b
    Sub(T, T),
    /// a b
    Mul(T, T),
    /// a / b
    Div(T, T),
    /// eᵃ
    Exp(T),
    /// ⟨a⟩ = max(a, 0)
    PositivePart(T),
    /// min(a, b)
    Min(T, T),
    /// fl(a): the number nearest to a in some precision
    Rounded(T),
}

/// Where in the source a step is written.
///
/// The steps of a chain such as `a + b + c` all begin where the chain begins; their rank, counted from
/// the left, tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Site {
    /// The file, as it was named to the compiler.
    pub file: &'static str,
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
    /// How many steps begin at the same place, further inside.
    pub rank: u32,
}

impl fmt::Display for Site {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Site { file, line, column, rank } = self;
        write!(f, "{file}:{line}:{column}")?;
        if *rank > 0 { write!(f, " (operator {})", rank + 1) } else { Ok(()) }
    }
}

impl Site {
    /// Was it written by the rules of differentiation, and by no formula?
    pub fn is_of_duals(&self) -> bool {
        self.file.ends_with("dual.rs")
    }
}

impl<T> Step<T> {
    /// What the step is made of, in order.
    pub fn operands(&self) -> impl Iterator<Item = &T> {
        use Step::*;
        let (a, b) = match self {
            Symbol(_) | Int(_) => (None, None),
            Neg(a) | Exp(a) | PositivePart(a) | Rounded(a) => (Some(a), None),
            Add(a, b) | Sub(a, b) | Mul(a, b) | Div(a, b) | Min(a, b) => (Some(a), Some(b)),
        };
        a.into_iter().chain(b)
    }

    /// The same step with other operands.
    pub fn map<'a, U>(&'a self, mut f: impl FnMut(&'a T) -> U) -> Step<U> {
        let all = self.try_map(|operand| Some(f(operand)));
        all.expect("every operand has another")
    }

    /// The same, if there are others.
    pub fn try_map<'a, U>(&'a self, mut f: impl FnMut(&'a T) -> Option<U>) -> Option<Step<U>> {
        use Step::*;
        Some(match self {
            Symbol(name) => Symbol(name),
            Int(n) => Int(*n),
            Neg(a) => Neg(f(a)?),
            Add(a, b) => Add(f(a)?, f(b)?),
            Sub(a, b) => Sub(f(a)?, f(b)?),
            Mul(a, b) => Mul(f(a)?, f(b)?),
            Div(a, b) => Div(f(a)?, f(b)?),
            Exp(a) => Exp(f(a)?),
            PositivePart(a) => PositivePart(f(a)?),
            Min(a, b) => Min(f(a)?, f(b)?),
            Rounded(a) => Rounded(f(a)?),
        })
    }
}

impl<T: Field> Step<&T> {
    /// Returns the result of an operation that every field has, and `None` for any other. A divisor has to be
    /// [invertible](Field::is_unit).
    pub fn arithmetic(self) -> Option<T> {
        use Step::*;
        Some(match self {
            Int(n) => T::int(n),
            Neg(a) => -a,
            Add(a, b) => a + b,
            Sub(a, b) => a - b,
            Mul(a, b) => a * b,
            Div(a, b) => a / b,
            Symbol(_) | Exp(_) | PositivePart(_) | Min(..) | Rounded(_) => return None,
        })
    }

    /// Returns the result for operands that are numbers; see [`replay`](super::Tree::replay) for the others.
    pub fn value(
        self,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> Option<T> {
        match self {
            Step::Symbol(name) => Some(symbol(name)),
            Step::Div(_, b) if !b.is_unit() => None,
            step => step.arithmetic().or_else(|| beyond(step)),
        }
    }
}

/// ⟨·⟩ and min, for [`Tree::replay`](super::Tree::replay).
pub fn piecewise<T: PositivePart>(step: Step<&T>) -> Option<T> {
    match step {
        Step::PositivePart(a) => Some(a.positive_part()),
        Step::Min(a, b) => Some(a.min(b)),
        _ => None,
    }
}

/// eˣ, for [`Tree::replay`](super::Tree::replay).
pub fn smooth<T: Exponential>(step: Step<&T>) -> Option<T> {
    match step {
        Step::Exp(a) => Some(a.exp()),
        _ => None,
    }
}

/// eˣ, ⟨·⟩ and min, for [`Tree::replay`](super::Tree::replay).
pub fn everything<T: PositivePart + Exponential>(step: Step<&T>) -> Option<T> {
    smooth(step).or_else(|| piecewise(step))
}
