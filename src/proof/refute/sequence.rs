//! Sequences at one point, and what is computed there.

use super::{How, Point, Verdict, exact, fails, vanishing};
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Says, Sequence, Statement};
use crate::number::{Exact, Tree};
use num_traits::One;

/// As many steps of an induction are tried.
pub(super) const STEPS: usize = 4;

/// The point with the number that is computed there, or what it comes to if there is none.
pub(super) fn computed(statement: &Statement, point: &Point) -> Result<Point, Verdict> {
    match &statement.computed {
        Some(computed) => Ok(point.with(computed.symbol, number(&computed.by, point)?)),
        None => Ok(point.clone()),
    }
}

fn number(tree: &Tree, point: &Point) -> Result<Exact, Verdict> {
    exact(tree, point).ok_or_else(|| {
        let divisor = vanishing(tree, point);
        divisor.map_or(Verdict::Open, |divisor| Verdict::Fails("computed", How::Undefined(divisor)))
    })
}

/// A sequence that has to stay near a closed form, for some steps; or what keeps it from being followed.
pub(super) fn follow(statement: &Statement, sequence: &Sequence, point: &Point) -> Result<Verdict, Verdict> {
    let Sequence { start, step, ratio, within, .. } = sequence;
    let ([start], [step]) = (&start[..], &step[..]) else { return Ok(Verdict::Open) };
    let (mut member, mut power, ratio) = (number(start, point)?, Exact::one(), number(ratio, point)?);
    for _ in 0..STEPS {
        let point = point.with(MEMBERS[0], member).with(POWER, power.clone());
        let point = computed(statement, &point)?;
        for (of, bound) in within {
            match fails(&Says::Within(of.clone(), bound.clone()), &point) {
                Some(Some(how)) => return Ok(Verdict::Fails("", how)),
                Some(None) => {}
                None => return Ok(Verdict::Open),
            }
        }
        (member, power) = (number(step, &point)?, power * &ratio);
    }
    Ok(Verdict::Holds)
}

/// Is each member of the sequence its limit?
pub(super) fn is_constant(statement: &Statement, point: &Point) -> bool {
    let Some(Sequence { member, limit: Some(limit), .. }) = &statement.amounts_to else { return false };
    let first = point.with(POWER, Exact::one());
    member.iter().all(|member| exact(member, &first).is_some_and(|x| exact(limit, point) == Some(x)))
}
