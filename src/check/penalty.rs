//! The penalty with which answers are consistent that no single one explains.

use super::observation::{INFORMATIVE, Observation};
use super::scales::{decimal, short};
use crate::chapter::{contact, system};
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};

/// The penalty N/p of wrong answers, which penetrate the plane in equilibrium; with six digits.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ApparentPenalty {
    /// `N/m`, or `c` for multiples of the stiffness: the unit in which the penalties differ less.
    pub unit: &'static str,
    /// The least and the largest penalty in this unit.
    pub range: [Exact; 2],
    /// Whether all are the least one times powers of ten.
    pub is_by_tens: bool,
    /// The largest p relative to |H − l|, without systems with H = l.
    pub penetration: Exact,
}

impl ApparentPenalty {
    /// Returns the penalty of the answers if all in which rounding does not hide p penetrate the plane in equilibrium.
    pub(super) fn of(wrong: &[&Observation]) -> Option<Self> {
        let (mut penalties, mut by_c, mut part) = (Vec::new(), Vec::new(), Exact::zero());
        for answer in wrong {
            let ([Some(u), Some(n)], system) = (answer.numbers(), &answer.problem.system) else {
                return None;
            };
            let (p, gap) = (contact::penetration(system, u), system::gap(system).abs());
            let rounding = &answer.sizes[0] * Exact::power_of_two(-52);
            // A ten-thousandth does not matter.
            if p.abs() <= &rounding * Exact::from(10_000) {
                continue;
            }
            // The error of equilibrium is small relative to c p, and thus to that of N, or due to rounding.
            let rounded = n / &p * rounding + &answer.sizes[1] * Exact::power_of_two(-50);
            let most = decimal(1, -2) * &system.c * &p + Exact::from(4) * rounded;
            let is_balanced = contact::equilibrium(system, u, n).abs() <= most;
            if p <= Exact::zero() || *n <= Exact::zero() || !is_balanced {
                return None;
            }
            penalties.push(n / &p);
            by_c.push(n / &p / &system.c);
            part = if gap.is_zero() { part } else { part.max(p / gap) };
        }
        let in_units = [("N/m", penalties), ("c", by_c)].map(|(unit, all): (_, Vec<Exact>)| {
            let range = [all.iter().min()?, all.iter().max()?].map(|x| short(x, 6));
            let is_by_tens = all.iter().all(|eps| is_power_of_ten(&(eps / &range[0])));
            let found = ApparentPenalty { unit, range, is_by_tens, penetration: short(&part, 6) };
            Some(found).filter(|_| all.len() >= INFORMATIVE)
        });
        in_units
            .into_iter()
            .flatten()
            .min_by_key(|found| (!found.is_by_tens, &found.range[1] / &found.range[0]))
    }
}

/// Returns `true` for a power of ten up to a thousandth, which answers of few digits allow.
fn is_power_of_ten(x: &Exact) -> bool {
    let power = x.to_f64().map_or(0, |x| x.log10().round() as i32);
    (x / decimal(1, power) - Exact::one()).abs() <= decimal(1, -3)
}
