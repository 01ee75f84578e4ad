//! The reasons for which no proof is found.

use super::algebra::Ratio;
use super::context::Context;
use crate::number::Tree;
use crate::proof::check::{Premise, Refusal, Sign};
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
    /// The checker refuses a step.
    Refused(Refusal),
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

impl Context {
    /// Returns a quantity at which the search ends.
    pub(super) fn quantity(&self, value: Ratio) -> Quantity {
        Quantity { value, context: self.clone().into() }
    }
}

impl From<Premise> for ProofError {
    fn from(premise: Premise) -> Self {
        ProofError::Premise(premise)
    }
}

impl From<&'static str> for ProofError {
    fn from(reason: &'static str) -> Self {
        ProofError::NotExpressed(reason)
    }
}

impl From<Refusal> for ProofError {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::NotDifferentiable => ProofError::NotDifferentiable,
            Refusal::TooLarge => ProofError::NotExpressed("it is too large"),
            refusal => ProofError::Refused(refusal),
        }
    }
}
