//! The simplification of counterexamples.

use super::{Compiled, Failure, Point, Verdict, independent_symbols};
use crate::formula::{Relation, Statement};
use crate::number::{Exact, Tree};
use rug::Rational;
use std::collections::BTreeSet;
use std::fmt;

/// The simplest coordinates, in order of preference.
const SIMPLE: [i32; 7] = [1, 0, 2, -1, 3, -2, -3];

/// Returns the rank of a number in the order of preference.
fn complexity(x: &Exact) -> u64 {
    let q = x.as_rational();
    let length = q.numer().significant_bits() + q.denom().significant_bits();
    let rank = SIMPLE.iter().position(|n| *q == *n);
    rank.map_or(SIMPLE.len() as u64 + u64::from(length), |rank| rank as u64)
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

/// A point at which a statement does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// Values of the symbols in the statement.
    pub point: Point,
    /// The part of the claim that fails; empty if the claim has one part.
    pub part: &'static str,
    /// The failure.
    pub failure: Failure,
}

/// Formats the numbers and the failure.
impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let colon = if self.point == Point::default() { "" } else { ": " };
        write!(f, "{}{colon}{}", self.point, self.failure)
    }
}

/// Changes one coordinate of a point so that a divisor is 0.
pub(crate) fn with_divisor_zero(divisor: &Tree, by: &'static str, point: &Point) -> Option<Point> {
    let x = divisor.solve_linear(by, &|symbol| point.at(symbol), &Exact::from(0))?;
    Some(point.with(by, x))
}

/// Returns the complexity of a point.
fn size(point: &Point) -> u64 {
    point.coordinates().map(|(_, x)| complexity(x)).sum()
}

/// The simplification of a counterexample to a statement.
struct Simplification<'a> {
    statement: &'a Statement,
    compiled: Compiled,
    best: Counterexample,
}

impl Simplification<'_> {
    /// Changes one coordinate, and others as far as the hypotheses or a zero divisor require, if this makes the
    /// counterexample simpler.
    fn improves(&mut self, symbol: &'static str, x: Exact) -> bool {
        let (point, hypotheses) = (self.best.point.with(symbol, x), self.statement.hypotheses());
        let mut candidates = Vec::new();
        candidates.extend(point.clone().adjusted_to(hypotheses, |hypothesis, _| {
            Some(Exact::from(i32::from(hypothesis.relation == Relation::Positive)))
        }));
        if let Failure::Undefined(divisor) = &self.best.failure {
            let others = divisor.symbols().into_iter().filter(|other| *other != symbol);
            let undefined = others.filter_map(|other| with_divisor_zero(divisor, other, &point));
            candidates.extend(undefined.filter(|point| point.satisfies(hypotheses)));
        }
        let better = candidates.into_iter().find_map(|point| self.simpler_at(point));
        better.map(|better| self.best = better).is_some()
    }

    /// Returns the counterexample at a point, if it is one and simpler.
    fn simpler_at(&self, point: Point) -> Option<Counterexample> {
        if size(&point) >= size(&self.best.point) {
            return None;
        }
        let Verdict::Fails(part, failure) = self.compiled.verdict(&point) else { return None };
        // A counterexample with defined values is not replaced by one with a zero divisor.
        let [new, best] = [&failure, &self.best.failure].map(|f| matches!(f, Failure::Undefined(_)));
        (!new || best).then_some(Counterexample { point, part, failure })
    }
}

/// Simplifies a counterexample by trying simpler values of one symbol after the other.
pub(crate) fn shrink(statement: &Statement, found: Counterexample) -> Counterexample {
    let symbols: BTreeSet<_> = independent_symbols(statement).into_iter().collect();
    let best = Counterexample { point: found.point.restricted_to(&symbols), ..found };
    let mut search = Simplification { statement, compiled: Compiled::new(statement), best };
    let mut is_simplest = false;
    while !is_simplest {
        is_simplest = true;
        for symbol in &symbols {
            let candidates = simpler(&search.best.point.at(symbol));
            if candidates.into_iter().any(|x| search.improves(symbol, x)) {
                is_simplest = false;
            }
        }
    }
    // The value of the variable of a limit is irrelevant.
    let mut best = search.best;
    if matches!(best.failure, Failure::NotConverging(_)) {
        let mut fixed = symbols;
        statement.goals().iter().filter_map(|goal| goal.proposition.variable()).for_each(|x| {
            fixed.remove(x);
        });
        let fixed = best.point.restricted_to(&fixed);
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
