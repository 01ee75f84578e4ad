//! The premises of a statement, which hold for every proof of it.

use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Sequence, Statement};
use crate::number::Tree;
use crate::proof::effort::excess_size;

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
    let has_limit = statement.conclusion().is_some_and(|sequence| sequence.limit.is_some());
    let is_smooth = has_limit || statement.goals().iter().any(|goal| goal.proposition.variable().is_some());
    // A computed quantity varies with its operands, which its symbol does not show.
    let varies = statement.trees().any(Tree::contains_rounding) || !statement.computed().is_empty();
    if is_smooth && varies {
        return Err(Premise::Discontinuous);
    }
    Ok(())
}

/// Checks the size and depth of formulas.
///
/// # Errors
/// Returns [`Premise::TooLarge`] if one of them exceeds its maximum.
pub fn check_size<'t>(trees: impl Iterator<Item = &'t Tree> + Clone) -> Result<(), Premise> {
    excess_size(trees).map_or(Ok(()), |(quantity, most)| Err(Premise::TooLarge(quantity, most)))
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
    let computed: Vec<_> = statement.computed().iter().map(|computed| computed.symbol).collect();
    let is_perturbed = statement.conclusion().is_some_and(Sequence::is_perturbed);
    let members = &MEMBERS[usize::from(is_perturbed)..];
    let variables = statement.goals().iter().filter_map(|goal| goal.proposition.variable());
    let mut names = statement.trees().flat_map(Tree::symbols).chain(variables);
    let reserved = names.find(|name| is_name_of_proof(name) || members.contains(name));
    let mut predefined = [POWER, PRECISION].into_iter().chain(MEMBERS).chain(SCALES);
    let found = reserved.or_else(|| predefined.find(|name| computed.contains(name)));
    found.map_or(Ok(()), |name| Err(Premise::ReservedName(name)))?;

    let hypotheses = statement.hypotheses().iter().map(|hypothesis| &hypothesis.value);
    if let Some(Sequence { start, step, ratio, limit, member, within }) = statement.conclusion() {
        let changing = [&[POWER], &MEMBERS[..], &computed].concat();
        refuse(start.iter().chain([ratio]).chain(limit), &changing, Premise::ReservedName)?;
        refuse(step, &[POWER], Premise::ReservedName)?;
        // An assumption about one power need not hold as the power tends to 0.
        let of_limit = hypotheses.clone().filter(|_| limit.is_some());
        refuse(of_limit, &[POWER], Premise::ReservedName)?;
        let bounds = within.iter().map(|(_, bound)| bound);
        let closed = member.iter().chain(bounds.clone().take(1));
        refuse(closed, &[&MEMBERS[..1], &computed].concat(), Premise::ReservedName)?;
        refuse(bounds, &MEMBERS[..1], Premise::ReservedName)?;
    }
    let invariants = statement.invariants().iter().map(|invariant| &invariant.value);
    refuse(hypotheses.chain(invariants), &computed, Premise::HypothesisOnComputed)?;
    let mut steps = statement.computed().iter().enumerate();
    steps.try_for_each(|(i, by)| refuse([&by.formula], &computed[i..], Premise::HypothesisOnComputed))
}

/// Rejects formulas that contain one of the names.
fn refuse<'t>(
    trees: impl IntoIterator<Item = &'t Tree>,
    names: &[&str],
    premise: fn(&'static str) -> Premise,
) -> Result<(), Premise> {
    let found = trees.into_iter().flat_map(Tree::symbols).find(|name| names.contains(name));
    found.map_or(Ok(()), |name| Err(premise(name)))
}

/// Returns `true` if `name` has the form of that of an error, a parameter or another quantity of a proof.
fn is_name_of_proof(name: &str) -> bool {
    let digits = name.strip_prefix(['e', 's', 't']).unwrap_or_default();
    !digits.is_empty() && digits.chars().all(|digit| ('₀'..='₉').contains(&digit))
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
