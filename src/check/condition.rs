//! The one condition on one quantity that separates wrong answers from right ones.

use super::observation::Observation;
use crate::chapter::{structure, system};
use crate::number::{Exact, PositivePart};
use crate::solver::State;
use num_traits::Zero;
use strum::{Display, VariantArray};

/// A quantity of a system, or of its place in the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display, VariantArray)]
#[strum(serialize_all = "snake_case")]
pub enum ThresholdQuantity {
    /// |R|/c, in m: the distance between the plane and the mass without the plane.
    Penetration,
    /// |R|, in N: the force that brings the mass to the plane.
    Force,
    /// |R| relative to |m g|, which is |R|/c relative to the free deflection. Below 1 a threshold
    /// of it is equivalent to one of |R| relative to |c (H − l)| or to |m g| + |c (H − l)|, since each
    /// increases with the others.
    ForceByWeight,
    /// |R|/c relative to |H|, or to |l|, which is almost the same where they decide.
    PenetrationByHeight,
    /// H − l, in m.
    Gap,
    /// c, in N/m.
    Stiffness,
    /// m, in kg.
    Mass,
    /// g, in m/s².
    Gravity,
    /// l, in m.
    FreeLength,
    /// H, in m.
    Height,
    /// |u|, in m.
    Deflection,
    /// The number of requests before it.
    Position,
}

impl ThresholdQuantity {
    /// All quantities.
    pub const ALL: &[ThresholdQuantity] = ThresholdQuantity::VARIANTS;

    fn symbol_and_unit(self) -> (&'static str, &'static str) {
        match self {
            ThresholdQuantity::Penetration => ("|R|/c", " m"),
            ThresholdQuantity::Force => ("|R|", " N"),
            ThresholdQuantity::ForceByWeight => ("|R|", " |m g|"),
            ThresholdQuantity::PenetrationByHeight => ("|R|/c", " |H|"),
            ThresholdQuantity::Gap => ("H − l", " m"),
            ThresholdQuantity::Stiffness => ("c", " N/m"),
            ThresholdQuantity::Mass => ("m", " kg"),
            ThresholdQuantity::Gravity => ("g", " m/s²"),
            ThresholdQuantity::FreeLength => ("l", " m"),
            ThresholdQuantity::Height => ("H", " m"),
            ThresholdQuantity::Deflection => ("|u|", " m"),
            ThresholdQuantity::Position => ("the number of earlier requests", ""),
        }
    }

    /// Returns its symbol.
    pub fn symbol(self) -> &'static str {
        self.symbol_and_unit().0
    }

    /// Returns its unit after a space; empty for a number.
    pub fn unit(self) -> &'static str {
        self.symbol_and_unit().1
    }

    /// Returns its value for a system; `None` if the reference is zero.
    fn value(self, answer: &Observation) -> Option<Exact> {
        let system = &answer.problem.system;
        let force = system::reaction(system).abs();
        let through = (structure::deflection(system) - system::gap(system)).abs();
        match self {
            ThresholdQuantity::Penetration => Some(through),
            ThresholdQuantity::Force => Some(force),
            ThresholdQuantity::ForceByWeight => relative(force, &system::weight(system)),
            ThresholdQuantity::PenetrationByHeight => relative(through, &system.h),
            ThresholdQuantity::Gap => Some(system::gap(system)),
            ThresholdQuantity::Stiffness => Some(system.c.clone()),
            ThresholdQuantity::Mass => Some(system.m.clone()),
            ThresholdQuantity::Gravity => Some(system.g.clone()),
            ThresholdQuantity::FreeLength => Some(system.l.clone()),
            ThresholdQuantity::Height => Some(system.h.clone()),
            ThresholdQuantity::Deflection => Some(answer.exact(0).abs()),
            ThresholdQuantity::Position => Some(Exact::from(answer.result.number as i32)),
        }
    }
}

/// Returns a quotient of sizes, unless it divides by zero.
fn relative(value: Exact, unit: &Exact) -> Option<Exact> {
    if unit.is_zero() { None } else { Some(value / unit.abs()) }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(ThresholdQuantity);

/// A condition that separates wrong answers from right ones: a state, a threshold, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct FailureCondition {
    /// The state of all systems with wrong answers, if the condition concerns this state alone.
    pub state: Option<State>,
    /// The threshold; `None` if all answers in the state are wrong, or the state is grazing.
    pub threshold: Option<Threshold>,
}

/// The border between wrong and right answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// The quantity.
    pub quantity: ThresholdQuantity,
    /// Its value with a wrong answer that is closest to those with right ones.
    pub wrong: Exact,
    /// Its value with a right answer that is closest to those with wrong ones.
    pub right: Exact,
}

/// Smallest number of combinations of systems whose answers could be wrong: it bounds the probability that a
/// quantity separates one of them by chance, on either side, in one state or in both.
const MIN_COMBINATIONS: usize = 1000 * ThresholdQuantity::ALL.len() * 2 * 2;

/// Returns the number of combinations of `chosen` out of `of` systems, at most [`MIN_COMBINATIONS`].
pub(super) fn combinations(chosen: usize, of: usize) -> usize {
    (0..chosen.min(of - chosen)).fold(1, |ways, i| MIN_COMBINATIONS.min(ways * (of - i) / (i + 1)))
}

/// Returns `true` if the wrong answers are hardly the wrong ones by chance.
fn is_significant(wrong: &[&Observation], right: &[&Observation]) -> bool {
    combinations(wrong.len(), wrong.len() + right.len()) == MIN_COMBINATIONS
}

impl FailureCondition {
    /// Returns the conditions that separate wrong answers from right ones, those with the widest gap first.
    pub(super) fn separating(wrong: &[&Observation], right: &[&Observation]) -> Vec<Self> {
        // Floats may miss R = 0, so not all of these answers have to be wrong.
        let is_grazing = |answer: &&Observation| answer.assessment().exact.state == State::Grazing;
        if is_significant(wrong, right) && wrong.iter().all(is_grazing) {
            return vec![FailureCondition { state: Some(State::Grazing), threshold: None }];
        }
        let of_state = |state, found: Vec<Threshold>| {
            let found = found.into_iter();
            found.map(|found| FailureCondition { state, threshold: Some(found) }).collect()
        };
        let found = Threshold::separating(wrong, right);
        if !found.is_empty() {
            return of_state(None, found);
        }
        // The state may be any one close to grazing.
        let mut states = wrong.iter().filter_map(|answer| answer.state);
        let Some(first) = states.next().filter(|first| states.all(|state| state == *first)) else {
            return Vec::new();
        };
        let state = Some(first);
        let alike: Vec<_> = right.iter().copied().filter(|answer| answer.state == state).collect();
        if alike.is_empty() && is_significant(wrong, right) {
            return vec![FailureCondition { state, threshold: None }];
        }
        of_state(state, Threshold::separating(wrong, &alike))
    }
}

/// Smallest ratio of the least error of a wrong answer to the largest one of a right answer at which the error jumps.
const MIN_JUMP: i32 = 10;

/// Returns `true` if errors grow from those of right answers to those of wrong ones without a jump, so that the tolerance
/// alone makes the border.
fn is_continuous(wrong: &[&Observation], right: &[&Observation]) -> bool {
    let least = wrong.iter().map(|answer| answer.relative_error()).min().flatten();
    let within = right.iter().filter(|answer| !answer.is_right());
    let most = within.filter_map(|answer| answer.relative_error()).max();
    least.zip(most).is_some_and(|(least, most)| least < Exact::from(MIN_JUMP) * most)
}

impl Threshold {
    /// Returns the thresholds that separate wrong answers from right ones, those with the widest gap first.
    fn separating(wrong: &[&Observation], right: &[&Observation]) -> Vec<Self> {
        if !is_significant(wrong, right) || is_continuous(wrong, right) {
            return Vec::new();
        }
        let all = ThresholdQuantity::ALL.iter();
        let mut found: Vec<_> = all.filter_map(|quantity| Threshold::of(*quantity, wrong, right)).collect();
        found.sort_by_key(|found| std::cmp::Reverse(found.gap()));
        found
    }

    fn of(quantity: ThresholdQuantity, wrong: &[&Observation], right: &[&Observation]) -> Option<Self> {
        let range = |of: &[&Observation]| {
            let values = of.iter().map(|answer| quantity.value(answer)).collect::<Option<Vec<_>>>()?;
            Some((values.iter().min()?.clone(), values.iter().max()?.clone()))
        };
        let ((bad_low, bad_high), (good_low, good_high)) = (range(wrong)?, range(right)?);
        if bad_high < good_low {
            return Some(Threshold { quantity, wrong: bad_high, right: good_low });
        }
        (bad_low > good_high).then_some(Threshold { quantity, wrong: bad_low, right: good_high })
    }

    /// Returns `true` if the answers are wrong below the right ones.
    pub fn is_below(&self) -> bool {
        self.wrong < self.right
    }

    /// Returns the distance of the two values relative to the larger one.
    pub(super) fn gap(&self) -> Exact {
        let most = self.wrong.abs().max(self.right.abs());
        (&self.wrong - &self.right).abs() / most
    }
}
