//! The premises of a statement, which hold for every proof of it.

use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Computed, Sequence, Statement};
use crate::number::Tree;
use std::iter;

/// A premise that a statement does not satisfy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Premise {
    /// A rounded formula, which is discontinuous, occurs in a limit or derivative.
    #[error("rounding is discontinuous, so limits and derivatives of it are not supported")]
    Discontinuous,
    /// The statement uses a reserved name.
    #[error("{0} is a reserved name of proofs")]
    ReservedName(&'static str),
    /// A hypothesis other than its interval contains a computed symbol, or that is computed from itself.
    #[error("{0} is computed at each step: only its interval may be assumed")]
    HypothesisOnComputed(&'static str),
    /// The statement has no goals.
    #[error("it has no goals")]
    NoGoals,
    /// The named quantity of the statement exceeds this maximum.
    #[error("{0} exceeds the limit of {1} terms")]
    TooLarge(&'static str, usize),
}

/// Maximum number of operations, quantities and numbers in all formulas of a statement.
pub const MAX_SIZE: u32 = 20_000;

/// Maximum depth of a formula in a statement.
pub const MAX_DEPTH: u32 = 500;

/// Checks the premises of a proof: the statement has goals, is not too large, and uses no reserved name, and no
/// limit or derivative in it is one of a rounded or computed quantity.
///
/// # Errors
/// Returns the premise that does not hold.
pub fn check_premises(statement: &Statement) -> Result<(), Premise> {
    check_size(statement.trees())?;
    if statement.goals().is_empty() {
        return Err(Premise::NoGoals);
    }
    check_names(statement)?;
    let rounds = statement.trees().any(Tree::contains_rounding);
    // A computed quantity varies with its operands, which its symbol does not show.
    if (rounds || !statement.computed().is_empty()) && has_continuous_variable(statement) {
        return Err(Premise::Discontinuous);
    }
    Ok(())
}

/// Checks the size and depth of formulas.
///
/// # Errors
/// Returns [`Premise::TooLarge`] if the formulas exceed [`MAX_SIZE`] or [`MAX_DEPTH`].
pub fn check_size<'t>(trees: impl Iterator<Item = &'t Tree> + Clone) -> Result<(), Premise> {
    let deepest = trees.clone().map(Tree::depth).max().unwrap_or(0);
    if deepest > MAX_DEPTH {
        return Err(Premise::TooLarge("its depth", MAX_DEPTH as usize));
    }
    let size = trees.fold(0, |sum: u32, tree| sum.saturating_add(tree.size()));
    if size > MAX_SIZE {
        return Err(Premise::TooLarge("its size", MAX_SIZE as usize));
    }
    Ok(())
}

/// Rejects a statement that uses a reserved name.
///
/// - Names of symbols of a proof do not occur. A name of a member of a sequence occurs only for the first
///   member, and only in a perturbed recursion.
/// - A computed symbol has no other meaning. Its value may differ at each step, so its interval is the only
///   assumption about it, and it is computed neither from itself nor from a symbol that is computed later.
/// - The start, ratio and limit of a sequence do not depend on the power, on members or on computed symbols;
///   its step and the hypotheses of its limit do not depend on the power; its closed form and the bound of
///   its distance from that do not depend on members or computed symbols; the bounds of other quantities do
///   not depend on members.
fn check_names(statement: &Statement) -> Result<(), Premise> {
    let is_perturbed = statement.conclusion().is_some_and(|sequence| sequence.is_perturbed());
    let is_reserved = |name| {
        let is_allowed = is_perturbed && name == MEMBERS[0];
        is_name_of_proof(name) || (MEMBERS.contains(&name) && !is_allowed)
    };
    refuse(statement.trees(), is_reserved)?;
    let mut variables = statement.goals().iter().filter_map(|goal| goal.proposition.variable());
    variables.find(|name| is_reserved(name)).map_or(Ok(()), |name| Err(Premise::ReservedName(name)))?;

    let computed = statement.computed();
    let mut predefined = [POWER, PRECISION].into_iter().chain(MEMBERS).chain(SCALES);
    let found = predefined.find(|name| is_among(name, computed));
    found.map_or(Ok(()), |name| Err(Premise::ReservedName(name)))?;

    let hypotheses = statement.hypotheses().iter().map(|hypothesis| &hypothesis.value);
    if let Some(Sequence { start, step, ratio, limit, member, within }) = statement.conclusion() {
        refuse(start.iter().chain([ratio]).chain(limit), |name| {
            name == POWER || MEMBERS.contains(&name) || is_among(name, computed)
        })?;
        refuse(step.iter(), |name| name == POWER)?;
        // An assumption about one power need not hold as the power tends to 0.
        refuse(hypotheses.clone().filter(|_| limit.is_some()), |name| name == POWER)?;
        let bounds = within.iter().map(|(_, bound)| bound);
        refuse(member.iter().chain(bounds.clone().take(1)), |name| {
            name == MEMBERS[0] || is_among(name, computed)
        })?;
        refuse(bounds, |name| name == MEMBERS[0])?;
    }
    let invariants = statement.invariants().iter().map(|invariant| &invariant.value);
    refuse_computed(hypotheses.chain(invariants), computed)?;
    (0..computed.len()).try_for_each(|i| refuse_computed(iter::once(&computed[i].formula), &computed[i..]))
}

/// Rejects formulas that contain a name for which `is_refused` holds.
fn refuse<'t>(
    trees: impl Iterator<Item = &'t Tree>,
    is_refused: impl Fn(&'static str) -> bool,
) -> Result<(), Premise> {
    let found = trees.flat_map(Tree::symbols).find(|name| is_refused(name));
    found.map_or(Ok(()), |name| Err(Premise::ReservedName(name)))
}

/// Rejects formulas that contain the symbol of a computed quantity.
fn refuse_computed<'t>(trees: impl Iterator<Item = &'t Tree>, computed: &[Computed]) -> Result<(), Premise> {
    let found = trees.flat_map(Tree::symbols).find(|name| is_among(name, computed));
    found.map_or(Ok(()), |name| Err(Premise::HypothesisOnComputed(name)))
}

fn is_among(name: &str, computed: &[Computed]) -> bool {
    computed.iter().any(|computed| computed.symbol == name)
}

/// Returns `true` if `name` has the form of that of an error, a parameter or another quantity of a proof.
fn is_name_of_proof(name: &str) -> bool {
    let digits = name.strip_prefix(['e', 's', 't']).unwrap_or_default();
    !digits.is_empty() && digits.chars().all(|digit| ('₀'..='₉').contains(&digit))
}

/// Returns `true` if a statement has a limit, or a derivative with respect to a symbol.
fn has_continuous_variable(statement: &Statement) -> bool {
    let has_limit = statement.conclusion().is_some_and(|sequence| sequence.limit.is_some());
    has_limit || statement.goals().iter().any(|goal| goal.proposition.variable().is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_proof_have_a_letter_and_digits() {
        let names = ["e₁", "s₁₂", "t₂₅₆", "e", "e1", "u₁", "te₁"];
        assert_eq!(names.map(is_name_of_proof), [true, true, true, false, false, false, false]);
    }
}
