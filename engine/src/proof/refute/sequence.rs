//! Sequences at one point, and what is computed there.

use super::{How, Point, Verdict, exact, fails, vanishing};
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Goal, Proposition, Role, Sequence, Statement};
use crate::number::{Exact, Field, PositivePart, Tree};
use num_traits::One;

/// As many steps of an induction are tried.
pub(super) const STEPS: usize = 4;

/// The point with the numbers that are computed there, or what it comes to if there is none.
pub(super) fn computed(statement: &Statement, point: &Point) -> Result<Point, Verdict> {
    let mut all = statement.computed().iter();
    all.try_fold(point.clone(), |point, computed| {
        Ok(point.with(computed.symbol, number(&computed.by, &point)?))
    })
}

fn number(tree: &Tree, point: &Point) -> Result<Exact, Verdict> {
    exact(tree, point).ok_or_else(|| {
        let divisor = vanishing(tree, point);
        divisor.map_or(Verdict::Open, |divisor| Verdict::Fails("computed", How::Undefined(divisor)))
    })
}

/// The first members of a sequence that has to stay near a closed form, each as a point with what is computed
/// from it; or what keeps it from being followed.
fn members(statement: &Statement, sequence: &Sequence, point: &Point) -> Result<Vec<Point>, Verdict> {
    let Sequence { start, step, ratio, .. } = sequence;
    let ([start], [step]) = (&start[..], &step[..]) else { return Err(Verdict::Open) };
    let (mut member, mut power, ratio) = (number(start, point)?, Exact::one(), number(ratio, point)?);
    let mut all = Vec::new();
    for _ in 0..STEPS {
        let point = point.with(MEMBERS[0], member).with(POWER, power.clone());
        let point = computed(statement, &point)?;
        (member, power) = (number(step, &point)?, power * &ratio);
        all.push(point);
    }
    Ok(all)
}

/// What such a sequence comes to.
pub(super) fn follow(statement: &Statement, sequence: &Sequence, point: &Point) -> Result<Verdict, Verdict> {
    for point in members(statement, sequence, point)? {
        for (of, bound) in &sequence.within {
            match fails(&Proposition::Within(of.clone(), bound.clone()), &point) {
                Some(Some(how)) => return Ok(Verdict::Fails("", how)),
                Some(None) => {}
                None => return Ok(Verdict::Open),
            }
        }
    }
    Ok(Verdict::Holds)
}

/// The largest share of a bound that is used up at a point; `None` if the statement has no bounds.
pub(super) fn share(statement: &Statement, point: &Point) -> Option<Exact> {
    let of = |of: &Tree, bound: &Tree, point: &Point| {
        let (of, bound) = (exact(of, point)?, exact(bound, point)?);
        bound.is_unit().then(|| of.abs() / bound)
    };
    match statement.conclusion().filter(|sequence| sequence.is_perturbed()) {
        Some(sequence) => {
            let members = members(statement, sequence, point).ok()?;
            let shares = |point: &Point| {
                let each = sequence.within.iter().map(|(error, bound)| of(error, bound, point));
                each.collect::<Vec<_>>()
            };
            members.iter().flat_map(shares).flatten().max()
        }
        None => {
            let point = computed(statement, point).ok()?;
            let share = |goal: &Goal| match &goal.proposition {
                Proposition::Within(error, bound) if goal.role == Role::Claim => of(error, bound, &point),
                _ => None,
            };
            statement.goals().iter().filter_map(share).max()
        }
    }
}

/// Is each member of the sequence its limit?
pub(super) fn is_constant(statement: &Statement, point: &Point) -> bool {
    let Some(Sequence { member, limit: Some(limit), .. }) = statement.conclusion() else { return false };
    let first = point.with(POWER, Exact::one());
    member.iter().all(|member| exact(member, &first).is_some_and(|x| exact(limit, point) == Some(x)))
}
