//! The penalty with which answers are consistent that no single one explains.

use super::observation::{INFORMATIVE, Observation};
use super::scales::{decimal, short};
use crate::chapter::contact;
use crate::number::{Exact, PositivePart};
use num_traits::Zero;

/// The penalty N/p of wrong answers, which penetrate the plane in equilibrium; with six digits.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ApparentPenalty {
    /// `N/m`, or `c` for multiples of the stiffness: the unit in which the penalties differ less.
    pub unit: &'static str,
    /// The least and the largest penalty in this unit.
    pub range: [Exact; 2],
}

impl ApparentPenalty {
    /// Returns the penalty of the answers if all in which rounding does not hide p penetrate the plane in equilibrium.
    pub(super) fn of(wrong: &[&Observation]) -> Option<Self> {
        let mut penalties = Vec::new();
        for answer in wrong {
            let system = &answer.problem.system;
            let [Some(u), Some(n)] = answer.numbers() else { return None };
            let p = contact::penetration(system, u);
            let rounding = &answer.sizes[0] * Exact::power_of_two(-52);
            // A ten-thousandth does not matter.
            if p.abs() <= &rounding * Exact::from(10_000) {
                continue;
            }
            // The error of equilibrium is small relative to c p, and thus to that of N, or due to the rounding of p. Other
            // rounding errors are small relative to c p. If p < 0 < N, this is negative.
            let most = decimal(1, -2) * &system.c * &p + Exact::from(4) * rounding * n / &p;
            let is_balanced = contact::equilibrium(system, u, n).abs() <= most;
            if *n <= Exact::zero() || !is_balanced {
                return None;
            }
            penalties.push([n / &p, n / &p / &system.c]);
        }
        let in_units = (0..).zip(["N/m", "c"]).filter_map(|(i, unit): (usize, _)| {
            let all = penalties.iter().map(|in_units| &in_units[i]);
            let range = [all.clone().min()?, all.max()?].map(|x| short(x, 6));
            (penalties.len() >= INFORMATIVE).then_some(ApparentPenalty { unit, range })
        });
        in_units.min_by_key(|found| &found.range[1] / &found.range[0])
    }
}
