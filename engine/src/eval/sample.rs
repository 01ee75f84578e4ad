//! Points at which statements are evaluated.

use super::Rationals;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Hypothesis, Relation};
use crate::number::Exact;
use crate::number::tree::{Op, piecewise_ops};
use num_traits::{One, Zero};
use oorandom::Rand64;
use rug::Rational;
use std::collections::BTreeSet;
use std::fmt;

/// Values of symbols, in the order in which they are printed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point(Vec<(&'static str, Exact)>);

impl Point {
    /// Creates a point with these coordinates.
    pub fn new(numbers: impl IntoIterator<Item = (&'static str, Exact)>) -> Self {
        Point(numbers.into_iter().collect())
    }

    /// Returns the value of a symbol, 1 if the point does not contain the symbol.
    pub fn at(&self, symbol: &str) -> Exact {
        let coordinate = self.0.iter().find(|(name, _)| *name == symbol);
        coordinate.map_or_else(Exact::one, |(_, x)| x.clone())
    }

    /// Sets the value of one symbol.
    pub(crate) fn with(&self, symbol: &'static str, x: Exact) -> Self {
        let mut point = self.clone();
        match point.0.iter_mut().find(|(name, _)| *name == symbol) {
            Some((_, value)) => *value = x,
            None => point.0.push((symbol, x)),
        }
        point
    }

    /// Returns the symbols with their values.
    pub fn coordinates(&self) -> impl Iterator<Item = (&'static str, &Exact)> {
        self.0.iter().map(|(symbol, x)| (*symbol, x))
    }

    /// Restricts the point to some symbols.
    pub(crate) fn restricted_to(&self, symbols: &BTreeSet<&'static str>) -> Self {
        Point(self.0.iter().filter(|(symbol, _)| symbols.contains(symbol)).cloned().collect())
    }

    /// Returns `true` if all hypotheses hold at the point.
    pub fn satisfies(&self, hypotheses: &[Hypothesis]) -> bool {
        self.has_valid_scales()
            && hypotheses.iter().all(|hypothesis| admits(&|symbol| self.at(symbol), hypothesis))
    }

    fn has_valid_scales(&self) -> bool {
        self.coordinates().all(|(name, x)| !SCALES.contains(&name) || is_power_of_two(x))
    }

    /// Returns the point adjusted to one hypothesis after the other; `None` if not all hold in the end. A
    /// hypothesis that does not hold is solved for its symbol, in which it is linear, so that its quantity becomes
    /// what `target` returns.
    pub fn adjusted_to(
        self,
        hypotheses: &[Hypothesis],
        mut target: impl FnMut(&Hypothesis, &Self) -> Option<Exact>,
    ) -> Option<Self> {
        let mut adjusted = self;
        for hypothesis in hypotheses {
            if !admits(&|symbol| adjusted.at(symbol), hypothesis) {
                let target = target(hypothesis, &adjusted)?;
                let x = hypothesis.solve(&|symbol| adjusted.at(symbol), &target)?;
                adjusted = adjusted.with(hypothesis.solved_for, x);
            }
        }
        // Adjusting to one hypothesis may violate another.
        adjusted.satisfies(hypotheses).then_some(adjusted)
    }
}

/// Returns `true` if a hypothesis holds for these values of symbols.
fn admits(symbol: &impl Fn(&'static str) -> Exact, hypothesis: &Hypothesis) -> bool {
    hypothesis.holds_with(symbol, &|op| match op {
        Op::Rounded(x) => Rationals { precision: symbol(PRECISION) }.round(x),
        op => piecewise_ops(op),
    })
}

/// Formats the point as `a = 1, b = -2`.
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, (symbol, x)) in self.coordinates().enumerate() {
            write!(f, "{}{symbol} = {x}", if i == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

/// Number of integer points that are drawn.
const INTEGER_POINTS: u64 = 4000;

/// Maximum absolute value of integer coordinates: small, so that two of them cancel in one of seven draws.
const SMALL_RANGE: i32 = 3;

/// Maximum absolute value in every fourth integer point, for hypotheses such as a > 2 (b + c).
const LARGE_RANGE: i32 = 9;

/// Number of constructed points.
const CONSTRUCTED_POINTS: u64 = 60;

/// Returns a generator that depends only on the index of a point and the name of a symbol.
fn random(point: u64, symbol: &str) -> Rand64 {
    let seed = symbol.bytes().fold(u128::from(point), |seed, byte| seed << 8 | u128::from(byte));
    Rand64::new(seed)
}

/// The precisions p from which points are drawn.
const PRECISIONS: [i32; 8] = [2, 3, 4, 6, 8, 11, 24, 53];

/// Draws 2ᵖ for the precision, and a power of two from 1/16 to 16 for other symbols.
fn power_of_two(symbol: &str, random: &mut Rand64) -> Exact {
    Exact::power_of_two(match symbol {
        PRECISION => PRECISIONS[random.rand_range(0..PRECISIONS.len() as u64) as usize],
        _ => random.rand_range(0..9) as i32 - 4,
    })
}

/// Returns `true` if `x` is a power of two with an integer exponent.
fn is_power_of_two(x: &Exact) -> bool {
    x.as_rational().numer().is_power_of_two() && x.as_rational().denom().is_power_of_two()
}

fn integer_coordinate(point: u64, symbol: &str) -> Exact {
    if symbol == PRECISION || SCALES.contains(&symbol) {
        return power_of_two(symbol, &mut random(point, symbol));
    }
    let size = if point % 4 == 3 { LARGE_RANGE } else { SMALL_RANGE };
    Exact::from(random(point, symbol).rand_range(0..2 * size as u64 + 1) as i32 - size)
}

/// Returns the integer points at which hypotheses hold. They are drawn alike for all statements.
pub fn integer_points(hypotheses: &[Hypothesis], symbols: &[&'static str]) -> impl Iterator<Item = Point> {
    first_integer_points(INTEGER_POINTS, hypotheses, symbols)
}

/// Returns the points among the first `count` integer points at which hypotheses hold.
pub fn first_integer_points(
    count: u64,
    hypotheses: &[Hypothesis],
    symbols: &[&'static str],
) -> impl Iterator<Item = Point> {
    let admitted =
        (0..count).filter(|i| hypotheses.iter().all(|h| admits(&|symbol| integer_coordinate(*i, symbol), h)));
    admitted.map(|i| Point::new(symbols.iter().map(|symbol| (*symbol, integer_coordinate(i, symbol)))))
}

/// Returns constructed points at which hypotheses hold.
pub fn constructed_points(
    hypotheses: &[Hypothesis],
    symbols: &[&'static str],
) -> impl Iterator<Item = Point> {
    (0..CONSTRUCTED_POINTS).filter_map(move |i| {
        let target = small_fraction(&mut random(INTEGER_POINTS + i, ""));
        let point = Point::new(symbols.iter().map(|symbol| (*symbol, constructed_coordinate(i, symbol))));
        // A quantity that may be 0 becomes 0 at every third point.
        point.adjusted_to(hypotheses, |hypothesis, _| match hypothesis.relation {
            Relation::Positive => Some(target.clone()),
            Relation::NonNegative if i % 3 > 0 => Some(target.clone()),
            Relation::NonNegative | Relation::Zero => Some(Exact::zero()),
        })
    })
}

fn constructed_coordinate(point: u64, symbol: &str) -> Exact {
    let mut random = random(INTEGER_POINTS + point, symbol);
    if symbol == PRECISION || SCALES.contains(&symbol) {
        return power_of_two(symbol, &mut random);
    }
    let x = small_fraction(&mut random);
    if random.rand_range(0..3) == 0 { -x } else { x }
}

/// Draws a quotient of 1 to 9 and 1 to 3.
fn small_fraction(random: &mut Rand64) -> Exact {
    Exact::from(Rational::from((random.rand_range(1..10), random.rand_range(1..4))))
}
