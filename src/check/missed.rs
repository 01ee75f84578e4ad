//! Contacts that are taken for none, and what they have in common.

use super::given::Given;
use crate::chapter::{structure, system};
use crate::number::{Exact, PositivePart};
use num_traits::Zero;
use std::fmt;

/// Of what a threshold may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// How far the mass would go through the plane if there were none, in m.
    Penetration,
    /// How hard the plane has to push, in N.
    Force,
}

/// As JSON has it.
impl fmt::Display for Of {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Of::Penetration => "penetration",
            Of::Force => "force",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Of);

/// A solver lets the mass hang free in some systems in which the plane pushes, and one quantity tells these
/// from the others: most likely it compares that with a tolerance of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Missed {
    /// How many it misses.
    pub count: usize,
    /// What tells them.
    pub of: Of,
    /// The largest that it misses.
    pub up_to: Exact,
    /// The smallest that it finds.
    pub from: Exact,
}

/// So many ways there have to be to choose what is missed: by chance it would be told from the others in one
/// of them.
const WAYS: usize = 1000;

/// How many ways there are to choose so many of them, or [`WAYS`] if there are more.
fn ways(chosen: usize, of: usize) -> usize {
    (0..chosen.min(of - chosen)).fold(1, |ways, i| WAYS.min(ways * (of - i) / (i + 1)))
}

impl Missed {
    pub(super) fn of(answers: &[Given], tolerance: &Exact) -> Option<Self> {
        let contacts = answers.iter().filter_map(|given| {
            let system = &given.problem.system;
            let reaction = system::reaction(system);
            let is_found = given.answer.contact_force.as_ref()?.abs() > tolerance * &given.scales[1];
            let through = structure::deflection(system) - system::gap(system);
            (reaction > Exact::zero() && (is_found || given.wrong)).then_some((is_found, [through, reaction]))
        });
        let (found, missed): (Vec<_>, Vec<_>) = contacts.partition(|(is_found, _)| *is_found);
        let threshold = |(i, of): (usize, Of)| {
            let up_to = missed.iter().map(|(_, quantities)| &quantities[i]).max()?;
            let from = found.iter().map(|(_, quantities)| &quantities[i]).min()?;
            let count = missed.len();
            (up_to < from).then(|| Missed { count, of, up_to: up_to.clone(), from: from.clone() })
        };
        let both = [Of::Penetration, Of::Force].into_iter().enumerate().filter_map(threshold);
        // If both tell them, the one that does more clearly.
        let clearest = both.max_by(|a, b| (&a.from * &b.up_to).cmp(&(&b.from * &a.up_to)));
        clearest.filter(|_| ways(missed.len(), missed.len() + found.len()) == WAYS)
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
