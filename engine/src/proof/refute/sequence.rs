//! The evaluation of sequences and computed quantities at a point.

use super::{Failure, Point, Verdict, check_proposition, exact_value, zero_divisor};
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Goal, Proposition, Role, Sequence, Statement};
use crate::number::{Exact, Field, PositivePart, Tree};
use num_traits::One;

/// Number of steps of a sequence that are evaluated.
pub(super) const STEPS: usize = 4;

/// Adds the computed quantities to a point, or returns the verdict if one of them has no exact value.
pub(super) fn with_computed(statement: &Statement, point: &Point) -> Result<Point, Verdict> {
    let mut all = statement.computed().iter();
    all.try_fold(point.clone(), |point, computed| {
        Ok(point.with(computed.symbol, number(&computed.formula, &point)?))
    })
}

fn number(tree: &Tree, point: &Point) -> Result<Exact, Verdict> {
    exact_value(tree, point).ok_or_else(|| {
        let divisor = zero_divisor(tree, point);
        divisor.map_or(Verdict::Undecided, |divisor| Verdict::Fails("computed", Failure::Undefined(divisor)))
    })
}

/// Returns the first members of a perturbed recursion, each as a point with the quantities computed from it,
/// or the verdict if one of them has no exact value.
fn members(statement: &Statement, sequence: &Sequence, point: &Point) -> Result<Vec<Point>, Verdict> {
    let Sequence { start, step, ratio, .. } = sequence;
    let ([start], [step]) = (&start[..], &step[..]) else { return Err(Verdict::Undecided) };
    let (mut member, mut power, ratio) = (number(start, point)?, Exact::one(), number(ratio, point)?);
    let mut all = Vec::new();
    for _ in 0..STEPS {
        let point = point.with(MEMBERS[0], member).with(POWER, power.clone());
        let point = with_computed(statement, &point)?;
        (member, power) = (number(step, &point)?, power * &ratio);
        all.push(point);
    }
    Ok(all)
}

/// Evaluates the bounds of a perturbed recursion at its first members.
pub(super) fn check_recursion(
    statement: &Statement,
    sequence: &Sequence,
    point: &Point,
) -> Result<Verdict, Verdict> {
    for point in members(statement, sequence, point)? {
        for (of, bound) in &sequence.within {
            match check_proposition(&Proposition::Within(of.clone(), bound.clone()), &point) {
                Some(Some(how)) => return Ok(Verdict::Fails("", how)),
                Some(None) => {}
                None => return Ok(Verdict::Undecided),
            }
        }
    }
    Ok(Verdict::Holds)
}

/// Returns the largest ratio of a quantity to its bound at a point; `None` if the statement has no bounds.
pub(super) fn bound_fraction(statement: &Statement, point: &Point) -> Option<Exact> {
    let ratio = |of: &Tree, bound: &Tree, point: &Point| {
        let (of, bound) = (exact_value(of, point)?, exact_value(bound, point)?);
        bound.is_invertible().then(|| of.abs() / bound)
    };
    match statement.conclusion().filter(|sequence| sequence.is_perturbed()) {
        Some(sequence) => {
            let members = members(statement, sequence, point).ok()?;
            let shares = |point: &Point| {
                let ratios = sequence.within.iter().map(|(error, bound)| ratio(error, bound, point));
                ratios.collect::<Vec<_>>()
            };
            members.iter().flat_map(shares).flatten().max()
        }
        None => {
            let point = with_computed(statement, point).ok()?;
            let share = |goal: &Goal| match &goal.proposition {
                Proposition::Within(error, bound) if goal.role == Role::Claim => ratio(error, bound, &point),
                _ => None,
            };
            statement.goals().iter().filter_map(share).max()
        }
    }
}

/// Returns `true` if the sequence is constant and equal to its limit.
pub(super) fn is_constant(statement: &Statement, point: &Point) -> bool {
    let Some(Sequence { member, limit: Some(limit), .. }) = statement.conclusion() else { return false };
    let first = point.with(POWER, Exact::one());
    member
        .iter()
        .all(|member| exact_value(member, &first).is_some_and(|x| exact_value(limit, point) == Some(x)))
}
