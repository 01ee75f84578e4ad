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
        point.set(symbol, x);
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

    /// Returns the point [adjusted](adjust) to hypotheses; `None` if not all hold in the end.
    pub(crate) fn adjusted_to(
        mut self,
        hypotheses: &[Hypothesis],
        target: impl Fn(Relation) -> Exact,
    ) -> Option<Self> {
        adjust(&mut self, hypotheses, |hypothesis, _| Some(target(hypothesis.relation)))?;
        self.has_valid_scales().then_some(self)
    }
}

/// Values of symbols that can be changed.
pub trait Coordinates {
    /// Returns the value of a symbol.
    fn get(&self, symbol: &'static str) -> Exact;

    /// Sets the value of a symbol.
    fn set(&mut self, symbol: &'static str, x: Exact);
}

impl Coordinates for Point {
    fn get(&self, symbol: &'static str) -> Exact {
        self.at(symbol)
    }

    fn set(&mut self, symbol: &'static str, x: Exact) {
        match self.0.iter_mut().find(|(name, _)| *name == symbol) {
            Some((_, value)) => *value = x,
            None => self.0.push((symbol, x)),
        }
    }
}

/// Returns `true` if a hypothesis holds for these values of symbols.
fn admits(symbol: &impl Fn(&'static str) -> Exact, hypothesis: &Hypothesis) -> bool {
    hypothesis.holds_with(symbol, &|op| match op {
        Op::Rounded(x) => Rationals { precision: symbol(PRECISION) }.round(x),
        op => piecewise_ops(op),
    })
}

/// Adjusts coordinates to one hypothesis after the other; `None` if not all hold in the end. A hypothesis that
/// does not hold is solved for its symbol, in which it is linear, so that its quantity becomes what `target`
/// returns.
pub fn adjust<C: Coordinates>(
    at: &mut C,
    hypotheses: &[Hypothesis],
    mut target: impl FnMut(&Hypothesis, &C) -> Option<Exact>,
) -> Option<()> {
    let mut is_changed = false;
    for hypothesis in hypotheses {
        if !admits(&|symbol| at.get(symbol), hypothesis) {
            let target = target(hypothesis, at)?;
            let x = hypothesis.solve(&|symbol| at.get(symbol), &target)?;
            at.set(hypothesis.solved_for, x);
            is_changed = true;
        }
    }
    // Adjusting to one hypothesis may violate another.
    let holds = !is_changed || hypotheses.iter().all(|h| admits(&|symbol| at.get(symbol), h));
    holds.then_some(())
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
        point.adjusted_to(hypotheses, |relation| match relation {
            Relation::Positive => target.clone(),
            Relation::NonNegative if i % 3 > 0 => target.clone(),
            Relation::NonNegative | Relation::Zero => Exact::zero(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Tree;
    use std::collections::HashSet;

    fn all<T: Into<Exact>>(numbers: impl IntoIterator<Item = T>) -> HashSet<Exact> {
        numbers.into_iter().map(Into::into).collect()
    }

    #[test]
    fn every_fourth_integer_point_has_a_wider_range() {
        let (larger, small): (Vec<_>, Vec<_>) = (0..INTEGER_POINTS).partition(|point| point % 4 == 3);
        let drawn = |points: Vec<u64>| all(points.into_iter().map(|point| integer_coordinate(point, "c")));
        assert_eq!(drawn(small), all(-SMALL_RANGE..=SMALL_RANGE));
        assert_eq!(drawn(larger), all(-LARGE_RANGE..=LARGE_RANGE));
        // About three in seven are positive.
        let hypotheses = [Hypothesis::new(Relation::Positive, Tree::symbol("c"))];
        let admissible: Vec<_> = integer_points(&hypotheses, &["c"]).collect();
        assert!(
            (INTEGER_POINTS as usize / 3..INTEGER_POINTS as usize / 2).contains(&admissible.len()),
            "{}",
            admissible.len()
        );
        assert!(admissible.iter().all(|point| point.at("c") > Exact::zero()));
    }

    #[test]
    fn precisions_and_scales_are_powers_of_two() {
        let drawn = |symbol: &str| all((0..INTEGER_POINTS).map(|point| integer_coordinate(point, symbol)));
        assert_eq!(drawn(PRECISION), all(PRECISIONS.map(Exact::power_of_two)));
        for scale in SCALES {
            assert_eq!(drawn(scale), all((-4..=4).map(Exact::power_of_two)));
        }
        let third: Exact = "1/3".parse().unwrap();
        let rounded =
            ["4", "1/4", "12", "2"].map(|n| Rationals { precision: n.parse().unwrap() }.round(&third));
        assert_eq!(rounded, [Some("3/8".parse().unwrap()), None, None, None]);
    }

    #[test]
    fn constructed_points_have_small_fractions_of_both_signs() {
        let drawn = all(constructed_points(&[], &["c", "u"]).map(|point| point.at("c")));
        let size = |x: &Exact| x.as_rational().clone().abs();
        let fits = |x: &Exact| (1..10).any(|n| (1..4).any(|d| size(x) == Rational::from((n, d))));
        assert!(drawn.iter().all(fits), "{drawn:?}");
        // A third of them are negative.
        let negative = drawn.iter().filter(|x| **x < Exact::zero()).count();
        assert!((drawn.len() / 6..drawn.len() / 2).contains(&negative), "{drawn:?}");
        // No draw of a precision and a scale is rejected.
        let rounded = constructed_points(&[], &[PRECISION, SCALES[0]]);
        assert_eq!(rounded.count() as u64, CONSTRUCTED_POINTS);
    }

    #[test]
    fn points_are_adjusted_only_if_a_hypothesis_fails_and_a_third_of_them_to_zero() {
        let u = || Tree::symbol("u");
        let at = |hypotheses: &[Hypothesis]| -> Vec<Exact> {
            constructed_points(hypotheses, &["u"]).map(|point| point.at("u")).collect()
        };
        let adjusted = |relation, value| at(&[Hypothesis::new(relation, value)]);
        // All drawn values are less than 20.
        let (far, zero) = (|| u() - Tree::from(20), Exact::from(20));
        for (relation, touching) in [
            (Relation::Positive, 0),
            (Relation::NonNegative, CONSTRUCTED_POINTS / 3),
            (Relation::Zero, CONSTRUCTED_POINTS),
        ] {
            let points = adjusted(relation, far());
            assert_eq!(points.iter().filter(|x| **x == zero).count() as u64, touching, "{relation:?}");
            assert!(points.len() as u64 == CONSTRUCTED_POINTS && points.iter().all(|x| *x >= zero));
        }
        // All drawn values exceed −20 and are not changed.
        assert_eq!(adjusted(Relation::Positive, u() + Tree::from(20)), at(&[]));
    }
}
