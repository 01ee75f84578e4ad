//! The reasons for which no proof is found.

use super::algebra::Ratio;
use super::context::Context;
use crate::formula::symbols::subscripted;
use crate::number::Tree;
use crate::proof::check::{Premise, Sign};
use std::sync::Arc;

/// The reason why a statement could not be proved.
#[derive(Clone, Debug)]
pub enum ProofError {
    /// A divisor may be 0: its formula, and its value under the hypotheses.
    PossibleZeroDivisor(Tree, Quantity),
    /// The branch of a positive part or minimum is undecided by this quantity, and no more cases may be distinguished.
    UndecidedBranch(Quantity),
    /// No rule finds the sign of a quantity.
    UnknownSign(Quantity),
    /// The sign of a quantity differs from the required one.
    WrongSign(Quantity, Sign),
    /// The two sides of an equation differ by this amount.
    Unequal(Quantity),
    /// The formula to be differentiated contains ⟨·⟩ or min.
    NotDifferentiable,
    /// No rule finds that a quantity has the stated limit.
    UnknownLimit(Quantity),
    /// The hypothesis on this quantity is not known to hold for all large values of the variable of a limit.
    EndingHypothesis(Tree),
    /// A sign was found that could not be expressed by certificates, for this reason.
    NotExpressed(&'static str),
    /// The statement does not satisfy a premise.
    Premise(Premise),
    /// The search exceeds this maximum.
    TooLarge(usize),
}

/// A quantity at which a proof failed, in the variables that remain under the assumptions.
#[derive(Clone)]
pub struct Quantity {
    /// Its value.
    pub(in crate::proof) value: Ratio,
    /// The assumptions.
    pub(in crate::proof) context: Arc<Context>,
}

/// A variable in a message. The symbols of the statement come first, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symbol {
    /// A symbol of the statement.
    Own(&'static str),
    /// A relative rounding error divided by its maximum: e₁, e₂, …, with −1 ≤ e ≤ 1.
    Error(u8),
    /// The value of a hypothesis, or an absolute value: s₁, s₂, ….
    Slack(u8),
    /// The parameter of a quantity in an interval: t₁, t₂, …, with −1 ≤ t ≤ 1.
    IntervalParameter(u8),
}

impl Symbol {
    /// Returns the printed name.
    pub fn name(self) -> &'static str {
        match self {
            Symbol::Own(name) => name,
            Symbol::Error(index) => subscripted('e', index),
            Symbol::Slack(index) => subscripted('s', index),
            Symbol::IntervalParameter(index) => subscripted('t', index),
        }
    }
}

impl Quantity {
    /// Returns the symbols of the variables.
    pub(in crate::proof) fn symbols(&self) -> Vec<Symbol> {
        let mut symbols: Vec<_> =
            self.value.variables().into_iter().filter_map(|x| self.context.symbol(x)).collect();
        symbols.sort_unstable();
        symbols
    }
}

impl From<Premise> for ProofError {
    fn from(premise: Premise) -> Self {
        ProofError::Premise(premise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_have_names() {
        let all = [Symbol::Error(0), Symbol::Slack(11), Symbol::IntervalParameter(u8::MAX), Symbol::Own("e")];
        assert_eq!(all.map(Symbol::name), ["e₁", "s₁₂", "t₂₅₆", "e"]);
    }
}
