//! The simplification of counterexamples.

use super::{Counterexample, Failure, Point, Verdict, check_goals, symbols, with_divisor_zero};
use crate::formula::{Relation, Statement};
use crate::number::Exact;
use rug::Rational;
use std::collections::BTreeSet;

/// The simplest coordinates, in order of preference.
pub(super) const SIMPLE: [i32; 7] = [1, 0, 2, -1, 3, -2, -3];

/// Returns the rank of a number in the order of preference.
fn complexity(x: &Exact) -> u64 {
    let q = x.as_rational();
    let simple = SIMPLE.iter().position(|n| *q == *n);
    let length = || q.numer().significant_bits() + q.denom().significant_bits();
    simple.map_or_else(|| SIMPLE.len() as u64 + u64::from(length()), |rank| rank as u64)
}

/// Returns candidates for a simpler coordinate, the simplest first: simple numbers, half of the number, and
/// the integers next to it.
fn simpler(x: &Exact) -> Vec<Exact> {
    let integer = Exact::from(x.as_rational().clone().trunc());
    let half = Exact::from((integer.as_rational() / Rational::from(2)).trunc());
    let simple = SIMPLE.iter().map(|n| Exact::from(*n)).take_while(|n| n != x);
    let next = &integer + if *x < Exact::from(0) { Exact::from(-1) } else { Exact::from(1) };
    simple.chain([half, integer, next]).collect()
}

/// Simplifies a counterexample by trying simpler values of one symbol after the other.
pub(super) fn shrink(statement: &Statement, found: Counterexample) -> Counterexample {
    let symbols: BTreeSet<_> = symbols(statement).into_iter().collect();
    let size = |point: &Point| point.coordinates().map(|(_, x)| complexity(x)).sum::<u64>();
    let mut best = Counterexample { point: found.point.restricted_to(&symbols), ..found };
    // Changes one coordinate, and others as far as the hypotheses or a zero divisor require.
    let with = |best: &Counterexample, symbol: &'static str, x: Exact| {
        let point = best.point.with(symbol, x);
        let with_zero_divisor = match &best.failure {
            Failure::Undefined(divisor) => {
                let others = divisor.symbols().into_iter().filter(|other| *other != symbol);
                others.filter_map(|other| with_divisor_zero(divisor, other, &point)).collect()
            }
            Failure::Unequal(..)
            | Failure::Sign(..)
            | Failure::BoundExceeded(..)
            | Failure::NotConverging(_) => Vec::new(),
        };
        let admissible = |point: &Point| point.satisfies(statement.hypotheses());
        let with_zero_divisor = with_zero_divisor.into_iter().filter(admissible);
        let target = |relation| Exact::from(i32::from(relation == Relation::Positive));
        let adjusted = point.adjusted_to(statement.hypotheses(), &target);
        adjusted.into_iter().chain(with_zero_divisor).find_map(|point| {
            let smaller = size(&point) < size(&best.point);
            let Verdict::Fails(part, how) = smaller.then(|| check_goals(statement, &point))? else {
                return None;
            };
            // A counterexample with defined values is not replaced by one with a zero divisor.
            let is_as_clear =
                !matches!(how, Failure::Undefined(_)) || matches!(best.failure, Failure::Undefined(_));
            is_as_clear.then_some(Counterexample { point, part, failure: how })
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
    // The value of the variable of a limit is irrelevant.
    if matches!(best.failure, Failure::NotConverging(_)) {
        let is_variable =
            |name: &str| statement.goals().iter().any(|goal| goal.proposition.variable() == Some(name));
        let fixed =
            best.point.restricted_to(&symbols.into_iter().filter(|name| !is_variable(name)).collect());
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
    fn complexity_increases_with_length() {
        let complexity = |text: &str| complexity(&text.parse().unwrap());
        let (simple, longer) =
            (SIMPLE.map(|n| complexity(&n.to_string())), ["4", "-15", "100", "1000/1001", "1e30"]);
        assert!(simple.into_iter().chain(longer.map(complexity)).is_sorted_by(|a, b| a < b));
        assert_eq!(complexity("1/1000"), complexity("1000"));
        // The rank exceeds those of simple numbers by the bits of 100 and 1 in binary.
        assert_eq!(complexity("4"), SIMPLE.len() as u64 + 3 + 1);
    }

    #[test]
    fn integers_on_both_sides_are_candidates() {
        let candidates = |text: &str| simpler(&text.parse().unwrap()).split_off(SIMPLE.len());
        assert_eq!(candidates("15/2"), [3, 7, 8].map(Exact::from));
        assert_eq!(candidates("-15/2"), [-3, -7, -8].map(Exact::from));
        assert_eq!(candidates("1/2")[2], Exact::from(1));
    }
}
