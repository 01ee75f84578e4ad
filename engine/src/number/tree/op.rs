//! Operations of a recorded formula, and their sites in the source.

use crate::number::{Exponential, Field, PositivePart};
use std::fmt;

/// The last operation of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op<T> {
    /// A symbol.
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
    /// fl(a), the number nearest to a in some precision
    Rounded(T),
}

/// Place of an operation in the source.
///
/// The operations of a chain such as `a + b + c` all begin where the chain begins; their rank, counted from
/// the left, distinguishes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Site {
    /// The file, as named to the compiler.
    pub file: &'static str,
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
    /// Number of inner operations that begin at the same place.
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
    /// Returns `true` if the operation belongs to the rules of differentiation.
    pub fn is_in_dual_numbers(&self) -> bool {
        self.file.ends_with("dual.rs")
    }
}

impl<T> Op<T> {
    /// Returns the operands in order.
    pub fn operands(&self) -> impl Iterator<Item = &T> {
        use Op::*;
        let (a, b) = match self {
            Symbol(_) | Int(_) => (None, None),
            Neg(a) | Exp(a) | PositivePart(a) | Rounded(a) => (Some(a), None),
            Add(a, b) | Sub(a, b) | Mul(a, b) | Div(a, b) | Min(a, b) => (Some(a), Some(b)),
        };
        a.into_iter().chain(b)
    }

    /// Returns the operation with mapped operands.
    pub fn map<'a, U>(&'a self, mut f: impl FnMut(&'a T) -> U) -> Op<U> {
        let all = self.try_map(|operand| Some(f(operand)));
        all.expect("every operand has another")
    }

    /// Returns the operation with mapped operands, or `None` if `f` returns `None` for one of them.
    pub fn try_map<'a, U>(&'a self, mut f: impl FnMut(&'a T) -> Option<U>) -> Option<Op<U>> {
        use Op::*;
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

impl<T: Field> Op<&T> {
    /// Returns the result of an operation that every field has, and `None` for any other. A divisor must be
    /// [invertible](Field::is_invertible).
    pub fn arithmetic(self) -> Option<T> {
        use Op::*;
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

    /// Returns the result of the operation on numbers; see [`eval`](super::Tree::eval) for the arguments.
    pub fn value(
        self,
        symbol: &impl Fn(&'static str) -> T,
        extra_ops: &impl Fn(Op<&T>) -> Option<T>,
    ) -> Option<T> {
        match self {
            Op::Symbol(name) => Some(symbol(name)),
            Op::Div(_, b) if !b.is_invertible() => None,
            op => op.arithmetic().or_else(|| extra_ops(op)),
        }
    }
}

/// Evaluates ⟨·⟩ and min, for [`Tree::eval`](super::Tree::eval).
pub fn piecewise_ops<T: PositivePart>(op: Op<&T>) -> Option<T> {
    match op {
        Op::PositivePart(a) => Some(a.positive_part()),
        Op::Min(a, b) => Some(a.min(b)),
        _ => None,
    }
}

/// Evaluates eˣ, for [`Tree::eval`](super::Tree::eval).
pub fn smooth_ops<T: Exponential>(op: Op<&T>) -> Option<T> {
    if let Op::Exp(a) = op { Some(a.exp()) } else { None }
}

/// Evaluates eˣ, ⟨·⟩ and min, for [`Tree::eval`](super::Tree::eval).
pub fn all_ops<T: PositivePart + Exponential>(op: Op<&T>) -> Option<T> {
    smooth_ops(op).or_else(|| piecewise_ops(op))
}
