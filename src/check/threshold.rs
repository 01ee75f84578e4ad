//! Wrong decisions between contact and separation that an internal tolerance of the solver explains.

use super::observation::Observation;
use crate::chapter::{contact, structure, system};
use crate::number::{Exact, PositivePart};
use num_traits::Zero;
use std::fmt;

/// Quantity of a threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
}

/// Writes the name used in JSON.
impl fmt::Display for ThresholdQuantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            ThresholdQuantity::Penetration => "penetration",
            ThresholdQuantity::Force => "force",
            ThresholdQuantity::ForceByWeight => "force_by_weight",
            ThresholdQuantity::PenetrationByHeight => "penetration_by_height",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(ThresholdQuantity);

impl ThresholdQuantity {
    /// All quantities.
    pub const ALL: [ThresholdQuantity; 4] = [
        ThresholdQuantity::Penetration,
        ThresholdQuantity::Force,
        ThresholdQuantity::ForceByWeight,
        ThresholdQuantity::PenetrationByHeight,
    ];

    /// Returns its value for a system; `None` if the reference is zero.
    fn value(self, given: &Observation) -> Option<Exact> {
        let system = &given.problem.system;
        let force = system::reaction(system).abs();
        let through = (structure::deflection(system) - system::gap(system)).abs();
        let (value, unit) = match self {
            ThresholdQuantity::Penetration => return Some(through),
            ThresholdQuantity::Force => return Some(force),
            ThresholdQuantity::ForceByWeight => (force, system::weight(system)),
            ThresholdQuantity::PenetrationByHeight => (through, system.h.clone()),
        };
        (!unit.is_zero()).then(|| value / unit.abs())
    }
}

/// A quantity that separates the systems decided wrongly from those decided rightly; probably the solver
/// compares it with an internal tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// Number of systems decided wrongly.
    pub count: usize,
    /// The quantity.
    pub of: ThresholdQuantity,
    /// Largest value decided wrongly.
    pub up_to: Exact,
    /// Smallest value decided rightly.
    pub from: Exact,
}

/// Smallest number of combinations of systems that could be decided wrongly; it bounds the probability that a
/// quantity separates one of them by chance.
const MIN_COMBINATIONS: usize = 1000 * ThresholdQuantity::ALL.len();

/// Returns the number of combinations of `chosen` out of `of` systems, at most [`MIN_COMBINATIONS`].
fn ways(chosen: usize, of: usize) -> usize {
    (0..chosen.min(of - chosen)).fold(1, |ways, i| MIN_COMBINATIONS.min(ways * (of - i) / (i + 1)))
}

impl Threshold {
    /// Returns the threshold of contacts that are taken for separation.
    pub(super) fn of_missed_contacts(answers: &[Observation], tolerance: &Exact) -> Option<Self> {
        let decided = answers.iter().filter_map(|given| {
            let has_force = given.answer.contact_force.as_ref()?.abs() > tolerance * &given.scales[1];
            let touches = system::reaction(&given.problem.system) > Exact::zero();
            (touches && (has_force || given.wrong)).then_some((!has_force, given))
        });
        Threshold::between(decided)
    }

    /// Returns the threshold of separated systems that are taken for contacts.
    pub(super) fn of_false_contacts(answers: &[Observation], tolerance: &Exact) -> Option<Self> {
        let decided = answers.iter().filter_map(|given| {
            let p = contact::penetration(&given.problem.system, given.answer.deflection.as_ref()?);
            let pull = -given.answer.contact_force.as_ref()?;
            let [length, force] = &given.scales;
            let is_held = given.wrong && (p.abs() <= tolerance * length || pull > tolerance * force);
            let separated = system::reaction(&given.problem.system) < Exact::zero();
            // Closer to R = 0 the answers for both states are within the tolerance.
            let shows = system::reaction(&given.problem.system).abs() > tolerance * force;
            (separated && (is_held || shows)).then_some((is_held, given))
        });
        Threshold::between(decided)
    }

    fn between<'a>(decided: impl Iterator<Item = (bool, &'a Observation<'a>)>) -> Option<Self> {
        let (wrong, right): (Vec<_>, Vec<_>) = decided.partition(|(is_wrong, _)| *is_wrong);
        let threshold = |of: ThresholdQuantity| {
            let values = wrong.iter().map(|(_, given)| of.value(given)).collect::<Option<Vec<_>>>()?;
            let up_to = values.into_iter().max()?;
            let from = right.iter().filter_map(|(_, given)| of.value(given)).min()?;
            (up_to < from).then(|| Threshold { count: wrong.len(), of, up_to, from })
        };
        // If several quantities separate them, the one with the widest gap is chosen.
        let clearest = ThresholdQuantity::ALL.into_iter().filter_map(threshold);
        let clearest = clearest.max_by(|a, b| (&a.from * &b.up_to).cmp(&(&b.from * &a.up_to)));
        clearest.filter(|_| ways(wrong.len(), wrong.len() + right.len()) == MIN_COMBINATIONS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combinations_are_counted() {
        let few = [(0, 9), (9, 9), (20, 20), (1, 7), (6, 7), (2, 5), (3, 5), (4, 12)];
        assert_eq!(few.map(|(chosen, of)| ways(chosen, of)), [1, 1, 1, 7, 7, 10, 10, 495]);
        assert_eq!([(10, 20), (50, 100)].map(|(chosen, of)| ways(chosen, of)), [MIN_COMBINATIONS; 2]);
    }
}
