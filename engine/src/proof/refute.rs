//! The search for a counterexample: values of the symbols for which a statement does not hold.
//!
//! A statement is [evaluated](crate::eval) at points with small rational coordinates, of two kinds:
//!
//! - *constructed* points are drawn at random, then adjusted to one hypothesis after the other;
//! - *integer* points have small integer coordinates and are used if the hypotheses happen to hold. They
//!   often meet coincidences such as a + b = 0, and they are independent of the method of proofs, which also
//!   solves each hypothesis for a quantity.
//!
//! All arithmetic is exact, except for eˣ, which is enclosed by a ball: a refuted statement is certainly
//! false.

pub use crate::eval::Counterexample;
use crate::eval::{
    Compiled, Point, Verdict, constructed_points, first_integer_points, independent_symbols, integer_points,
    shrink, with_divisor_zero,
};
use crate::formula::{Hypothesis, Statement};
use crate::number::tree::Op;
use crate::number::{Exact, Tree};
use std::sync::OnceLock;

/// A statement with a counterexample as the search found it.
#[derive(Clone, Debug)]
pub struct Refutation {
    statement: Box<Statement>,
    found: Box<Counterexample>,
}

impl Refutation {
    /// Returns a counterexample with simpler numbers, as far as such are found.
    pub fn counterexample(&self) -> Counterexample {
        shrink(&self.statement, (*self.found).clone())
    }
}

/// Number of drawn integer points of which the admissible ones are tried first.
const FIRST_INTEGER_POINTS: u64 = 200;

/// Number of constructed points that are tried first.
const FIRST_CONSTRUCTED_POINTS: usize = 4;

/// The search for a refutation of one statement.
struct Search<'a> {
    statement: &'a Statement,
    compiled: Compiled,
}

impl<'a> Search<'a> {
    fn of(statement: &'a Statement) -> Self {
        Search { statement, compiled: Compiled::new(statement) }
    }

    /// Returns a refutation if the statement fails at a point at which its hypotheses hold.
    fn refute_at(&self, point: &Point) -> Option<Refutation> {
        match self.compiled.verdict(point) {
            Verdict::Fails(part, failure) => {
                let found = Counterexample { point: point.clone(), part, failure };
                Some(Refutation { statement: self.statement.clone().into(), found: found.into() })
            }
            Verdict::Excluded | Verdict::Holds | Verdict::Undecided => None,
        }
    }

    /// Returns a refutation at a point that differs from this one in one coordinate, so that a divisor is 0. Most
    /// divisors are linear in some coordinate.
    fn refute_at_pole(&self, point: &Point) -> Option<Refutation> {
        let mut divisors: Vec<&Tree> = Vec::new();
        for tree in self.statement.goals().iter().flat_map(|goal| goal.proposition.trees()) {
            tree.visit(&mut |tree| {
                if let Op::Div(_, divisor) = tree.op()
                    && !divisors.contains(&divisor)
                {
                    divisors.push(divisor);
                }
            });
        }
        let divisors = divisors.into_iter();
        let mut pairs = divisors.flat_map(|of| of.symbols().into_iter().map(move |by| (of, by)));
        pairs.find_map(|(divisor, by)| {
            let point = with_divisor_zero(divisor, by, point)?;
            point.satisfies(self.statement.hypotheses()).then(|| self.refute_at(&point))?
        })
    }
}

/// The points at which certain hypotheses hold.
pub(super) struct PointSet {
    hypotheses: Vec<Hypothesis>,
    symbols: Vec<&'static str>,
    /// The integer points and constructed points that are tried first.
    first: [Vec<Point>; 2],
    all: OnceLock<[Vec<Point>; 2]>,
}

impl PointSet {
    pub(super) fn of(hypotheses: Vec<Hypothesis>, symbols: Vec<&'static str>) -> Self {
        let integer = first_integer_points(FIRST_INTEGER_POINTS, &hypotheses, &symbols).collect();
        let constructed = constructed_points(&hypotheses, &symbols).take(FIRST_CONSTRUCTED_POINTS).collect();
        PointSet { hypotheses, symbols, first: [integer, constructed], all: OnceLock::new() }
    }

    /// Returns a refutation at one of the points that are tried first.
    pub(super) fn refute_at_first_points(&self, statement: &Statement) -> Option<Refutation> {
        let ([integer, constructed], search) = (&self.first, Search::of(statement));
        integer.iter().take(8).chain(constructed).find_map(|point| search.refute_at(point))
    }

    /// Returns a refutation at one of the other points.
    pub(super) fn refute_at_other_points(&self, statement: &Statement) -> Option<Refutation> {
        let ([integer, constructed], search) = (&self.first, Search::of(statement));
        let at_integer = integer.iter().skip(8).find_map(|point| search.refute_at(point));
        at_integer
            .or_else(|| constructed.iter().find_map(|point| search.refute_at_pole(point)))
            .or_else(|| self.all().iter().flatten().find_map(|point| search.refute_at(point)))
    }

    fn all(&self) -> &[Vec<Point>; 2] {
        self.all.get_or_init(|| {
            let integer = integer_points(&self.hypotheses, &self.symbols).collect();
            [integer, constructed_points(&self.hypotheses, &self.symbols).collect()]
        })
    }
}

/// Returns the point, among a number of trials, at which a quantity attains the largest fraction of its
/// bound, and that fraction; `None` if the statement has no bounds.
pub fn tightest_point(statement: &Statement) -> Option<(Point, Exact)> {
    let (symbols, compiled) = (independent_symbols(statement), Compiled::new(statement));
    let integer = integer_points(statement.hypotheses(), &symbols).take(TIGHTEST_POINT_TRIALS);
    let points = integer.chain(constructed_points(statement.hypotheses(), &symbols));
    let fractions = points.filter_map(|point| Some((compiled.bound_fraction(&point)?, point)));
    // Returns the first of several maxima, unlike `max_by`.
    let (fraction, point) = fractions.min_by(|(a, _), (b, _)| b.cmp(a))?;
    Some((point.restricted_to(&symbols.into_iter().collect()), fraction))
}

/// Number of integer points that [`tightest_point`] tries.
const TIGHTEST_POINT_TRIALS: usize = 500;

/// Searches for a counterexample.
///
/// `None` does not prove the statement. Statements that are too large for [`prove`](super::prove) are not
/// examined.
pub fn refute(statement: &Statement) -> Option<Counterexample> {
    if super::effort::excess_size(statement.trees()).is_some() {
        return None;
    }
    let symbols = independent_symbols(statement);
    let points = PointSet::of(statement.hypotheses().to_vec(), symbols);
    let refutation =
        points.refute_at_first_points(statement).or_else(|| points.refute_at_other_points(statement))?;
    Some(refutation.counterexample())
}

#[cfg(test)]
mod tests;
