//! Identification of the penalty method and its penalty parameter.

use super::mistakes::PenaltyEvidence;
use super::observation::Observation;
use crate::chapter::SpringMass;
use crate::number::Exact;
use num_traits::One;
use std::fmt;

/// Dependence of a penalty on the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PenaltyScaling {
    /// No penalty identified.
    None,
    /// One ε for all systems.
    Constant,
    /// Proportional to c.
    OfStiffness,
    /// Proportional to m.
    OfMass,
}

/// Writes the name used in JSON.
impl fmt::Display for PenaltyScaling {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            PenaltyScaling::None => "none",
            PenaltyScaling::Constant => "constant",
            PenaltyScaling::OfStiffness => "of_stiffness",
            PenaltyScaling::OfMass => "of_mass",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(PenaltyScaling);

impl PenaltyScaling {
    const ALL: [PenaltyScaling; 3] =
        [PenaltyScaling::Constant, PenaltyScaling::OfStiffness, PenaltyScaling::OfMass];

    /// Returns the factor of the penalty.
    fn unit(self, system: &SpringMass<Exact>) -> Exact {
        match self {
            PenaltyScaling::None | PenaltyScaling::Constant => Exact::one(),
            PenaltyScaling::OfStiffness => system.c.clone(),
            PenaltyScaling::OfMass => system.m.clone(),
        }
    }
}

/// Penalty identified from forces and penetrations.
#[derive(Clone, Debug, PartialEq)]
pub struct Penalty {
    /// Dependence on the system.
    pub kind: PenaltyScaling,
    /// ε in N/m, ε/c, or ε/m in 1/s², from the most accurate answer.
    pub value: Option<Exact>,
    /// Ratio of the largest and the smallest value, less 1.
    pub spread: Option<Exact>,
}

impl Penalty {
    pub(super) const NONE: Penalty = Penalty { kind: PenaltyScaling::None, value: None, spread: None };

    /// Identifies a penalty if exactly one of the three multiples agrees within a tenth in all informative
    /// answers, and these are at least three and at least half of those with a contact force.
    pub(super) fn measured(answers: &[Observation], by: PenaltyEvidence, tolerance: &Exact) -> Self {
        let acting = answers.iter().filter_map(|given| given.force(by, tolerance)).count();
        let ratios = Vec::from_iter(answers.iter().filter_map(|given| given.ratio(by, tolerance)));
        let clearest = ratios.iter().max_by(|a, b| a.clarity.cmp(&b.clarity));
        let (Some(clearest), true) = (clearest, ratios.len() >= 3 && 2 * ratios.len() >= acting) else {
            return Penalty::NONE;
        };
        let shown = PenaltyScaling::ALL.into_iter().filter_map(|kind| {
            let multiples = || ratios.iter().map(|ratio| &ratio.value / kind.unit(ratio.system));
            let spread = multiples().max()? / multiples().min()? - Exact::one();
            let value = &clearest.value / kind.unit(clearest.system);
            (&spread * Exact::from(10) <= Exact::one()).then_some(Penalty {
                kind,
                value: Some(value),
                spread: Some(spread),
            })
        });
        match shown.collect::<Vec<_>>().as_slice() {
            [only] => only.clone(),
            _ => Penalty::NONE,
        }
    }

    pub(super) fn at(&self, system: &SpringMass<Exact>) -> Option<Exact> {
        self.value.as_ref().map(|value| value * self.kind.unit(system))
    }
}
