//! Decisions between contact and separation that a tolerance of the solver's own explains.

use super::given::Given;
use crate::chapter::{contact, structure, system};
use crate::number::{Exact, PositivePart};
use num_traits::Zero;
use std::fmt;

/// Of what a threshold may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// |R|/c, the distance between the plane and where the mass would hang without it, in m.
    Penetration,
    /// |R|, the force that the plane has to push or pull with to be touched, in N.
    Force,
    /// |R| relative to |m g|, which is |R|/c relative to the free deflection. As long as it is below 1, a
    /// threshold of it is one of |R| relative to |c (H − l)| or to |m g| + |c (H − l)| as well, since each
    /// grows with the others.
    ForceByWeight,
    /// |R|/c relative to |H|, or to |l|, which is nearly as long where they decide.
    PenetrationByHeight,
}

/// As JSON has it.
impl fmt::Display for Of {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Of::Penetration => "penetration",
            Of::Force => "force",
            Of::ForceByWeight => "force_by_weight",
            Of::PenetrationByHeight => "penetration_by_height",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Of);

impl Of {
    /// All of them.
    pub const ALL: [Of; 4] = [Of::Penetration, Of::Force, Of::ForceByWeight, Of::PenetrationByHeight];

    /// Its value for a system; `None` if it is relative to nothing.
    fn value(self, given: &Given) -> Option<Exact> {
        let system = &given.problem.system;
        let force = system::reaction(system).abs();
        let through = (structure::deflection(system) - system::gap(system)).abs();
        let (value, unit) = match self {
            Of::Penetration => return Some(through),
            Of::Force => return Some(force),
            Of::ForceByWeight => (force, system::weight(system)),
            Of::PenetrationByHeight => (through, system.h.clone()),
        };
        (!unit.is_zero()).then(|| value / unit.abs())
    }
}

/// A solver decides some systems wrongly, and one quantity tells these from those that it decides rightly:
/// most likely it compares that quantity with a tolerance of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Threshold {
    /// How many it decides wrongly.
    pub count: usize,
    /// What tells them.
    pub of: Of,
    /// The largest that it decides wrongly.
    pub up_to: Exact,
    /// The smallest that it decides rightly.
    pub from: Exact,
}

/// So many ways there have to be to choose what is decided wrongly: by chance it would be told from the
/// others in one of them, for each quantity that is tried.
const WAYS: usize = 1000 * Of::ALL.len();

/// How many ways there are to choose so many of them, or [`WAYS`] if there are more.
fn ways(chosen: usize, of: usize) -> usize {
    (0..chosen.min(of - chosen)).fold(1, |ways, i| WAYS.min(ways * (of - i) / (i + 1)))
}

impl Threshold {
    /// Of the systems in contact, those in which the mass hangs free.
    pub(super) fn missed(answers: &[Given], tolerance: &Exact) -> Option<Self> {
        let decided = answers.iter().filter_map(|given| {
            let has_force = given.answer.contact_force.as_ref()?.abs() > tolerance * &given.scales[1];
            let touches = system::reaction(&given.problem.system) > Exact::zero();
            (touches && (has_force || given.wrong)).then_some((!has_force, given))
        });
        Threshold::between(decided)
    }

    /// Of the separated systems, those in which the mass is held at the plane, or pulled to it.
    pub(super) fn held(answers: &[Given], tolerance: &Exact) -> Option<Self> {
        let decided = answers.iter().filter_map(|given| {
            let p = contact::penetration(&given.problem.system, given.answer.deflection.as_ref()?);
            let pull = -given.answer.contact_force.as_ref()?;
            let [length, force] = &given.scales;
            let is_held = given.wrong && (p.abs() <= tolerance * length || pull > tolerance * force);
            let separated = system::reaction(&given.problem.system) < Exact::zero();
            // Nearer to R = 0 than that, an answer of either kind is within the tolerance.
            let shows = system::reaction(&given.problem.system).abs() > tolerance * force;
            (separated && (is_held || shows)).then_some((is_held, given))
        });
        Threshold::between(decided)
    }

    fn between<'a>(decided: impl Iterator<Item = (bool, &'a Given<'a>)>) -> Option<Self> {
        let (wrong, right): (Vec<_>, Vec<_>) = decided.partition(|(is_wrong, _)| *is_wrong);
        let threshold = |of: Of| {
            let values = wrong.iter().map(|(_, given)| of.value(given)).collect::<Option<Vec<_>>>()?;
            let up_to = values.into_iter().max()?;
            let from = right.iter().filter_map(|(_, given)| of.value(given)).min()?;
            (up_to < from).then(|| Threshold { count: wrong.len(), of, up_to, from })
        };
        // If several tell them, the one that does most clearly.
        let clearest = Of::ALL.into_iter().filter_map(threshold);
        let clearest = clearest.max_by(|a, b| (&a.from * &b.up_to).cmp(&(&b.from * &a.up_to)));
        clearest.filter(|_| ways(wrong.len(), wrong.len() + right.len()) == WAYS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn so_many_ways_there_are_to_choose() {
        let few = [(0, 9), (9, 9), (20, 20), (1, 7), (6, 7), (2, 5), (3, 5), (4, 12)];
        assert_eq!(few.map(|(chosen, of)| ways(chosen, of)), [1, 1, 1, 7, 7, 10, 10, 495]);
        assert_eq!([(10, 20), (50, 100)].map(|(chosen, of)| ways(chosen, of)), [WAYS; 2]);
    }
}
