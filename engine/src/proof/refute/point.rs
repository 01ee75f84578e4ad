//! Where a counterexample is looked for.

use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Hypothesis, Relation};
use crate::number::Exact;
use crate::number::tree::{Step, piecewise};
use num_traits::{One, Zero};
use oorandom::Rand64;
use rug::Rational;
use std::collections::BTreeSet;
use std::fmt;

/// Numbers for symbols, in an order for readers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point(Vec<(&'static str, Exact)>);

impl Point {
    /// The point with these numbers.
    pub fn new(numbers: impl IntoIterator<Item = (&'static str, Exact)>) -> Self {
        Point(numbers.into_iter().collect())
    }

    /// The number for a symbol; 1 if the point says nothing of it.
    pub fn at(&self, symbol: &str) -> Exact {
        let own = self.0.iter().find(|(name, _)| *name == symbol);
        own.map_or_else(Exact::one, |(_, x)| x.clone())
    }

    /// The same point but for one number.
    pub(super) fn with(&self, symbol: &'static str, x: Exact) -> Self {
        let mut point = self.clone();
        match point.0.iter_mut().find(|(name, _)| *name == symbol) {
            Some((_, own)) => *own = x,
            None => point.0.push((symbol, x)),
        }
        point
    }

    /// Its numbers.
    pub fn numbers(&self) -> impl Iterator<Item = (&'static str, &Exact)> {
        self.0.iter().map(|(symbol, x)| (*symbol, x))
    }

    /// The same for some symbols only.
    pub(super) fn among(&self, symbols: &BTreeSet<&'static str>) -> Self {
        Point(self.0.iter().filter(|(symbol, _)| symbols.contains(symbol)).cloned().collect())
    }

    /// Do hypotheses hold there?
    pub fn satisfies(&self, hypotheses: &[Hypothesis]) -> bool {
        let is_one = |(name, x): (&str, &Exact)| !SCALES.contains(&name) || is_power_of_two(x);
        self.numbers().all(is_one) && hypotheses.iter().all(|hypothesis| self.admits(hypothesis))
    }

    fn admits(&self, hypothesis: &Hypothesis) -> bool {
        let n = self.at(PRECISION);
        hypothesis.holds_with(&|symbol| self.at(symbol), &|step| rounding(step, &n))
    }

    /// The point bent until the hypotheses hold. A quantity that lacks its sign gets the value `target`:
    /// the hypothesis is linear in the symbol that it is solved for.
    pub(super) fn bent(
        mut self,
        hypotheses: &[Hypothesis],
        target: &impl Fn(Relation) -> Exact,
    ) -> Option<Self> {
        for hypothesis in hypotheses {
            if !self.admits(hypothesis) {
                let target = target(hypothesis.relation);
                let x = hypothesis.solution(&|symbol| self.at(symbol), &target)?;
                self = self.with(hypothesis.solved_for, x);
            }
        }
        self.satisfies(hypotheses).then_some(self)
    }
}

/// `c = 1, ε = −2`
impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, (symbol, x)) in self.numbers().enumerate() {
            write!(f, "{}{symbol} = {x}", if i == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

/// So many raw points are drawn.
const RAW: u64 = 4000;

/// Whole numbers this small and smaller: in one of seven draws two of them cancel. And in every fourth
/// point up to the other, for hypotheses such as α > 2(c + ε).
const SMALL: i32 = 3;
const LARGER: i32 = 9;

/// So many planted points.
const PLANTED: u64 = 60;

/// What is drawn for a symbol depends on its name and the point's number alone.
fn random(point: u64, symbol: &str) -> Rand64 {
    let seed = symbol.bytes().fold(u128::from(point), |seed, byte| seed << 8 | u128::from(byte));
    Rand64::new(seed)
}

/// The bits of the numbers that are rounded to, with which a point is drawn.
const BITS: [i32; 8] = [2, 3, 4, 6, 8, 11, 24, 53];

/// 2ᵖ for some number of bits p; of others, any power of two.
fn power_of_two(symbol: &str, random: &mut Rand64) -> Exact {
    Exact::power_of_two(match symbol {
        PRECISION => BITS[random.rand_range(0..BITS.len() as u64) as usize],
        _ => random.rand_range(0..9) as i32 - 4,
    })
}

/// With any whole exponent.
fn is_power_of_two(x: &Exact) -> bool {
    x.as_rational().numer().is_power_of_two() && x.as_rational().denom().is_power_of_two()
}

/// The p with n = 2ᵖ, if it is 2 or more.
fn bits(n: &Exact) -> Option<u32> {
    let whole = is_power_of_two(n) && *n.as_rational().denom() == 1;
    whole.then(|| n.as_rational().numer().significant_bits() - 1).filter(|bits| *bits >= 2)
}

/// The nearest number of p bits, if n is 2ᵖ and p at least 2.
pub(super) fn nearest(x: &Exact, n: &Exact) -> Option<Exact> {
    x.rounded(bits(n)?)
}

/// ⟨·⟩, min, and rounding to p bits where n is 2ᵖ.
fn rounding(step: Step<&Exact>, n: &Exact) -> Option<Exact> {
    match step {
        Step::Rounded(x) => nearest(x, n),
        step => piecewise(step),
    }
}

fn raw(point: u64, symbol: &str) -> Exact {
    if symbol == PRECISION || SCALES.contains(&symbol) {
        return power_of_two(symbol, &mut random(point, symbol));
    }
    let size = if point % 4 == 3 { LARGER } else { SMALL };
    Exact::from(random(point, symbol).rand_range(0..2 * size as u64 + 1) as i32 - size)
}

/// The raw points at which hypotheses hold: small integers, the same for all statements.
pub fn raw_points(hypotheses: &[Hypothesis], symbols: &[&'static str]) -> impl Iterator<Item = Point> {
    first_raw_points(RAW, hypotheses, symbols)
}

/// Those of the first so many.
pub(super) fn first_raw_points(
    many: u64,
    hypotheses: &[Hypothesis],
    symbols: &[&'static str],
) -> impl Iterator<Item = Point> {
    let holds = |i: &u64| {
        let n = raw(*i, PRECISION);
        let own = |symbol: &'static str| raw(*i, symbol);
        hypotheses.iter().all(|hypothesis| hypothesis.holds_with(&own, &|step| rounding(step, &n)))
    };
    (0..many).filter(holds).map(|i| Point::new(symbols.iter().map(|symbol| (*symbol, raw(i, symbol)))))
}

/// Planted points at which hypotheses hold; not for ever.
pub fn planted_points(hypotheses: &[Hypothesis], symbols: &[&'static str]) -> impl Iterator<Item = Point> {
    // One to nine, over one to three, of either sign.
    let size = |random: &mut Rand64| {
        Exact::from(Rational::from((random.rand_range(1..10), random.rand_range(1..4))))
    };
    (0..PLANTED).filter_map(move |i| {
        let draw = |symbol: &&'static str| {
            let mut random = random(RAW + i, symbol);
            if *symbol == PRECISION || SCALES.contains(symbol) {
                return (*symbol, power_of_two(symbol, &mut random));
            }
            let x = size(&mut random);
            (*symbol, if random.rand_range(0..3) == 0 { -x } else { x })
        };
        let target = size(&mut random(RAW + i, ""));
        // A quantity that may be 0 should be so sometimes.
        let target = |relation| match relation {
            Relation::Positive => target.clone(),
            Relation::NonNegative if i % 3 > 0 => target.clone(),
            Relation::NonNegative | Relation::Zero => Exact::zero(),
        };
        Point::new(symbols.iter().map(draw)).bent(hypotheses, &target)
    })
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
    fn small_whole_numbers_are_drawn_and_in_every_fourth_point_larger_ones() {
        let (larger, small): (Vec<_>, Vec<_>) = (0..RAW).partition(|point| point % 4 == 3);
        let drawn = |points: Vec<u64>| all(points.into_iter().map(|point| raw(point, "c")));
        assert_eq!(drawn(small), all(-SMALL..=SMALL));
        assert_eq!(drawn(larger), all(-LARGER..=LARGER));
        // Of two signs about three in seven are right.
        let given = [Hypothesis::new(Relation::Positive, Tree::symbol("c"))];
        let right: Vec<_> = raw_points(&given, &["c"]).collect();
        assert!((RAW as usize / 3..RAW as usize / 2).contains(&right.len()), "{}", right.len());
        assert!(right.iter().all(|point| point.at("c") > Exact::zero()));
    }

    #[test]
    fn precisions_and_scales_are_powers_of_two() {
        let drawn = |symbol: &str| all((0..RAW).map(|point| raw(point, symbol)));
        assert_eq!(drawn(PRECISION), all(BITS.map(Exact::power_of_two)));
        for scale in SCALES {
            assert_eq!(drawn(scale), all((-4..=4).map(Exact::power_of_two)));
        }
        let third: Exact = "1/3".parse().unwrap();
        let rounded = ["4", "1/4", "12", "2"].map(|n| nearest(&third, &n.parse().unwrap()));
        assert_eq!(rounded, [Some("3/8".parse().unwrap()), None, None, None]);
    }

    #[test]
    fn fractions_are_planted() {
        let drawn = all(planted_points(&[], &["c", "u"]).map(|point| point.at("c")));
        let size = |x: &Exact| x.as_rational().clone().abs();
        let fits = |x: &Exact| (1..10).any(|n| (1..4).any(|d| size(x) == Rational::from((n, d))));
        assert!(drawn.iter().all(fits), "{drawn:?}");
        // A third of them are negative.
        let negative = drawn.iter().filter(|x| **x < Exact::zero()).count();
        assert!((drawn.len() / 6..drawn.len() / 2).contains(&negative), "{drawn:?}");
        // And precisions and scales are what they have to be.
        let rounded = planted_points(&[], &[PRECISION, SCALES[0]]);
        assert_eq!(rounded.count() as u64, PLANTED);
    }

    #[test]
    fn a_point_is_bent_where_a_hypothesis_does_not_hold_and_a_third_of_them_to_zero() {
        let u = || Tree::symbol("u");
        let at = |given: &[Hypothesis]| -> Vec<Exact> {
            planted_points(given, &["u"]).map(|point| point.at("u")).collect()
        };
        let bent = |relation, value| at(&[Hypothesis::new(relation, value)]);
        // All that is drawn is less.
        let (far, zero) = (|| u() - Tree::from(20), Exact::from(20));
        for (relation, touching) in
            [(Relation::Positive, 0), (Relation::NonNegative, PLANTED / 3), (Relation::Zero, PLANTED)]
        {
            let points = bent(relation, far());
            assert_eq!(points.iter().filter(|x| **x == zero).count() as u64, touching, "{relation:?}");
            assert!(points.len() as u64 == PLANTED && points.iter().all(|x| *x >= zero));
        }
        // All that is drawn is more, and stays what it is.
        assert_eq!(bent(Relation::Positive, u() + Tree::from(20)), at(&[]));
    }
}
