//! Counterexamples made small.

use super::{Counterexample, How, Point, Verdict, bent_to_zero, check_goals, symbols};
use crate::formula::{Relation, Statement};
use crate::number::Exact;
use rug::Rational;
use std::collections::BTreeSet;

/// What a coordinate is best, and next best.
pub(super) const SIMPLE: [i32; 7] = [1, 0, 2, -1, 3, -2, -3];

/// How far from simple a number is.
fn complexity(x: &Exact) -> u64 {
    let q = x.as_rational();
    let simple = SIMPLE.iter().position(|n| *q == *n);
    let length = || q.numer().significant_bits() + q.denom().significant_bits();
    simple.map_or_else(|| SIMPLE.len() as u64 + u64::from(length()), |place| place as u64)
}

/// What a coordinate could be instead, the simplest first: of a long number, fewer digits; of one that is not
/// whole, those next to it.
fn simpler(x: &Exact) -> Vec<Exact> {
    let whole = Exact::from(x.as_rational().clone().trunc());
    let half = Exact::from((whole.as_rational() / Rational::from(2)).trunc());
    let simple = SIMPLE.iter().map(|n| Exact::from(*n)).take_while(|n| n != x);
    let next = &whole + if *x < Exact::from(0) { Exact::from(-1) } else { Exact::from(1) };
    simple.chain([half, whole, next]).collect()
}

/// Tries simpler numbers for one symbol after the other, as long as it stays a counterexample.
pub(super) fn smaller(statement: &Statement, found: Counterexample) -> Counterexample {
    let symbols: BTreeSet<_> = symbols(statement).into_iter().collect();
    let size = |point: &Point| point.numbers().map(|(_, x)| complexity(x)).sum::<u64>();
    let mut best = Counterexample { point: found.point.among(&symbols), ..found };
    // The same with another number, where a further one may have to follow.
    let with = |best: &Counterexample, symbol: &'static str, x: Exact| {
        let point = best.point.with(symbol, x);
        let followed = match &best.how {
            How::Undefined(divisor) => {
                let others = divisor.symbols().into_iter().filter(|other| *other != symbol);
                others.filter_map(|other| bent_to_zero(divisor, other, &point)).collect()
            }
            How::Different(..) | How::Sign(..) | How::Beyond(..) | How::Far(_) => Vec::new(),
        };
        let followed = followed.into_iter().filter(|point| point.satisfies(statement.hypotheses()));
        let one = |relation| Exact::from(i32::from(relation == Relation::Positive));
        let bent = point.bent(statement.hypotheses(), &one);
        bent.into_iter().chain(followed).find_map(|point| {
            let smaller = size(&point) < size(&best.point);
            let Verdict::Fails(part, how) = smaller.then(|| check_goals(statement, &point))? else {
                return None;
            };
            // What is defined stays so: that two numbers differ shows more than that there are none.
            let shows = !matches!(how, How::Undefined(_)) || matches!(best.how, How::Undefined(_));
            shows.then_some(Counterexample { point, part, how })
        })
    };
    let mut improves = true;
    while improves {
        improves = false;
        for symbol in &symbols {
            let better = simpler(&best.point.at(symbol)).into_iter().find_map(|x| with(&best, symbol, x));
            if let Some(better) = better {
                best = better;
                improves = true;
            }
        }
    }
    // A limit is looked at far out, wherever the point is.
    if matches!(best.how, How::Far(_)) {
        let varies =
            |name: &str| statement.goals().iter().any(|goal| goal.proposition.variable() == Some(name));
        let fixed = best.point.among(&symbols.into_iter().filter(|name| !varies(name)).collect());
        if fixed.satisfies(statement.hypotheses()) {
            best.point = fixed;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_long_is_far_from_simple() {
        let complexity = |text: &str| complexity(&text.parse().unwrap());
        let (simple, longer) =
            (SIMPLE.map(|n| complexity(&n.to_string())), ["4", "-15", "100", "1000/1001", "1e30"]);
        assert!(simple.into_iter().chain(longer.map(complexity)).is_sorted_by(|a, b| a < b));
        assert_eq!(complexity("1/1000"), complexity("1000"));
        // Beyond all simple ones by so many bits: those of 100 over 1.
        assert_eq!(complexity("4"), SIMPLE.len() as u64 + 3 + 1);
    }
}
