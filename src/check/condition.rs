//! The one condition on one quantity that separates wrong answers from right ones.

use super::observation::Observation;
use crate::chapter::{structure, system};
use crate::number::{Exact, PositivePart};
use crate::solver::State;
use num_traits::Zero;
use std::fmt;

/// A quantity of a system, or of its place in the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
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

/// Name in JSON, name in text, and unit.
type Names = (&'static str, &'static str, &'static str);

impl Quantity {
    /// All quantities.
    pub const ALL: [Quantity; 12] = [
        Quantity::Penetration,
        Quantity::Force,
        Quantity::ForceByWeight,
        Quantity::PenetrationByHeight,
        Quantity::Gap,
        Quantity::Stiffness,
        Quantity::Mass,
        Quantity::Gravity,
        Quantity::FreeLength,
        Quantity::Height,
        Quantity::Deflection,
        Quantity::Position,
    ];

    fn names(self) -> Names {
        match self {
            Quantity::Penetration => ("penetration", "|R|/c", " m"),
            Quantity::Force => ("force", "|R|", " N"),
            Quantity::ForceByWeight => ("force_by_weight", "|R|", " |m g|"),
            Quantity::PenetrationByHeight => ("penetration_by_height", "|R|/c", " |H|"),
            Quantity::Gap => ("gap", "H − l", " m"),
            Quantity::Stiffness => ("stiffness", "c", " N/m"),
            Quantity::Mass => ("mass", "m", " kg"),
            Quantity::Gravity => ("gravity", "g", " m/s²"),
            Quantity::FreeLength => ("free_length", "l", " m"),
            Quantity::Height => ("height", "H", " m"),
            Quantity::Deflection => ("deflection", "|u|", " m"),
            Quantity::Position => ("position", "the number of earlier requests", ""),
        }
    }

    /// Returns its symbol.
    pub fn symbol(self) -> &'static str {
        self.names().1
    }

    /// Returns its unit after a space; empty for a number.
    pub fn unit(self) -> &'static str {
        self.names().2
    }

    /// Returns its value for a system; `None` if the reference is zero.
    fn value(self, given: &Observation) -> Option<Exact> {
        let system = &given.problem.system;
        let force = system::reaction(system).abs();
        let through = (structure::deflection(system) - system::gap(system)).abs();
        let part = |value: Exact, unit: Exact| (!unit.is_zero()).then(|| value / unit.abs());
        match self {
            Quantity::Penetration => Some(through),
            Quantity::Force => Some(force),
            Quantity::ForceByWeight => part(force, system::weight(system)),
            Quantity::PenetrationByHeight => part(through, system.h.clone()),
            Quantity::Gap => Some(system::gap(system)),
            Quantity::Stiffness => Some(system.c.clone()),
            Quantity::Mass => Some(system.m.clone()),
            Quantity::Gravity => Some(system.g.clone()),
            Quantity::FreeLength => Some(system.l.clone()),
            Quantity::Height => Some(system.h.clone()),
            Quantity::Deflection => Some(given.exact[0].abs()),
            Quantity::Position => Some(Exact::from(given.position as i32)),
        }
    }
}

/// Writes the name used in JSON.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(self.names().0)
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Quantity);

/// A condition that separates wrong answers from right ones: a state, a threshold, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// The state of all systems with wrong answers, if the condition concerns this state alone.
    pub state: Option<State>,
    /// The threshold; `None` if all answers in the state are wrong.
    pub threshold: Option<Threshold>,
}

/// The border between wrong and right answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// The quantity.
    pub quantity: Quantity,
    /// Its value with a wrong answer that is closest to those with right ones.
    pub wrong: Exact,
    /// Its value with a right answer that is closest to those with wrong ones.
    pub right: Exact,
}

/// Smallest number of combinations of systems whose answers could be wrong: it bounds the probability that a
/// quantity separates one of them by chance, on either side, in one state or in both.
const MIN_COMBINATIONS: usize = 1000 * Quantity::ALL.len() * 2 * 2;

/// Returns the number of combinations of `chosen` out of `of` systems, at most [`MIN_COMBINATIONS`].
pub(super) fn combinations(chosen: usize, of: usize) -> usize {
    (0..chosen.min(of - chosen)).fold(1, |ways, i| MIN_COMBINATIONS.min(ways * (of - i) / (i + 1)))
}

impl Condition {
    /// Returns the conditions that separate wrong answers from right ones, those with the widest gap first.
    pub(super) fn separating(wrong: &[&Observation], right: &[&Observation]) -> Vec<Self> {
        let found = Threshold::separating(wrong, right);
        if !found.is_empty() {
            return found
                .into_iter()
                .map(|found| Condition { state: None, threshold: Some(found) })
                .collect();
        }
        // The state may be any one close to grazing.
        let mut states = wrong.iter().filter_map(|given| given.state);
        let Some(first) = states.next().filter(|first| states.all(|state| state == *first)) else {
            return Vec::new();
        };
        let state = Some(first);
        let alike: Vec<_> = right.iter().copied().filter(|given| given.state == state).collect();
        if alike.is_empty() && combinations(wrong.len(), wrong.len() + right.len()) == MIN_COMBINATIONS {
            return vec![Condition { state, threshold: None }];
        }
        let found = Threshold::separating(wrong, &alike).into_iter();
        found.map(|found| Condition { state, threshold: Some(found) }).collect()
    }
}

impl Threshold {
    /// Returns the thresholds that separate wrong answers from right ones, those with the widest gap first.
    fn separating(wrong: &[&Observation], right: &[&Observation]) -> Vec<Self> {
        if combinations(wrong.len(), wrong.len() + right.len()) < MIN_COMBINATIONS {
            return Vec::new();
        }
        let found = Quantity::ALL.into_iter().filter_map(|quantity| Threshold::of(quantity, wrong, right));
        let mut found: Vec<_> = found.collect();
        found.sort_by_key(|found| std::cmp::Reverse(found.gap()));
        found
    }

    fn of(quantity: Quantity, wrong: &[&Observation], right: &[&Observation]) -> Option<Self> {
        let values =
            |all: &[&Observation]| all.iter().map(|given| quantity.value(given)).collect::<Option<Vec<_>>>();
        let (bad, good) = (values(wrong)?, values(right)?);
        let below = (bad.iter().max()?, good.iter().min()?);
        let above = (bad.iter().min()?, good.iter().max()?);
        let (wrong, right) = if below.0 < below.1 { below } else { above };
        let separates = below.0 < below.1 || above.0 > above.1;
        separates.then(|| Threshold { quantity, wrong: wrong.clone(), right: right.clone() })
    }

    /// Returns `true` if the answers are wrong below the right ones.
    pub fn is_below(&self) -> bool {
        self.wrong < self.right
    }

    /// Returns the distance of the two values relative to the larger one.
    fn gap(&self) -> Exact {
        let most = self.wrong.abs().max(self.right.abs());
        (&self.wrong - &self.right).abs() / most
    }
}
