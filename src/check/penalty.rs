//! Whether a solver is a penalty method, and with which penalty.

use super::given::Given;
use super::mistakes::Measured;
use crate::chapter::SpringMass;
use crate::number::Exact;
use num_traits::One;
use std::fmt;

/// How a penalty depends on the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// No penalty shows.
    None,
    /// The same ε everywhere.
    Constant,
    /// A multiple of c.
    OfStiffness,
    /// A multiple of m.
    OfMass,
}

/// As JSON has it.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Kind::None => "none",
            Kind::Constant => "constant",
            Kind::OfStiffness => "of_stiffness",
            Kind::OfMass => "of_mass",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Kind);

impl Kind {
    const ALL: [Kind; 3] = [Kind::Constant, Kind::OfStiffness, Kind::OfMass];

    /// What the penalty is a multiple of.
    fn unit(self, system: &SpringMass<Exact>) -> Exact {
        match self {
            Kind::None | Kind::Constant => Exact::one(),
            Kind::OfStiffness => system.c.clone(),
            Kind::OfMass => system.m.clone(),
        }
    }
}

/// The penalty that forces by their penetrations show.
#[derive(Clone, Debug, PartialEq)]
pub struct Penalty {
    /// How it depends on the system.
    pub kind: Kind,
    /// ε in N/m; or ε/c; or ε/m in 1/s². Of the answer that tells it most clearly.
    pub value: Option<Exact>,
    /// The largest by the smallest, less 1.
    pub spread: Option<Exact>,
}

impl Penalty {
    pub(super) const NONE: Penalty = Penalty { kind: Kind::None, value: None, spread: None };

    /// A penalty shows if one of the three multiples, and only one, is the same to within a tenth in all
    /// answers that tell it; and if these are three or more, and at least half of those whose force it would
    /// be.
    pub(super) fn measured(answers: &[Given], by: Measured, tolerance: &Exact) -> Self {
        let acting = answers.iter().filter_map(|given| given.force(by, tolerance)).count();
        let told = Vec::from_iter(answers.iter().filter_map(|given| given.ratio(by, tolerance)));
        let clearest = told.iter().max_by(|a, b| a.clarity.cmp(&b.clarity));
        let (Some(clearest), true) = (clearest, told.len() >= 3 && 2 * told.len() >= acting) else {
            return Penalty::NONE;
        };
        let shown = Kind::ALL.into_iter().filter_map(|kind| {
            let multiples = || told.iter().map(|ratio| &ratio.value / kind.unit(ratio.system));
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
