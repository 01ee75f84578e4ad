//! The reasons for which no proof is found.

use super::algebra::Ratio;
use super::sign::SignEnv;
use crate::number::Tree;
use crate::proof::check::{Premise, Sign};
use std::sync::Arc;

/// The reason why a statement could not be proved.
#[derive(Clone, Debug)]
pub enum ProofError {
    /// A divisor may be 0: its formula, and its value under the hypotheses.
    PossibleZeroDivisor(Tree, Ratio),
    /// The branch of a positive part or minimum is undecided by this quantity, and no more cases may be distinguished.
    UndecidedBranch(Ratio),
    /// No rule finds the sign of a quantity, for these signs of symbols.
    UnknownSign(Ratio, Arc<SignEnv>),
    /// The sign of a quantity differs from the required one.
    WrongSign(Ratio, Sign),
    /// The two sides of an equation differ by this amount.
    Unequal(Ratio),
    /// The formula to be differentiated contains ⟨·⟩ or min.
    NotDifferentiable,
    /// No rule finds the limit of a quantity.
    UnknownLimit(Ratio),
    /// A sign was found that could not be expressed by certificates, for this reason.
    NotExpressed(&'static str),
    /// The statement does not satisfy a premise.
    Premise(Premise),
    /// The search exceeds this maximum.
    TooLarge(usize),
}

impl From<Premise> for ProofError {
    fn from(premise: Premise) -> Self {
        ProofError::Premise(premise)
    }
}
