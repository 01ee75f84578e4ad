//! The penalty with which answers are consistent that no single one explains.

use super::observation::{INFORMATIVE, Observation};
use super::scales::decimal;
use crate::chapter::{contact, system};
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};

/// The penalty N/p of wrong answers, each of which penetrates the plane in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct ApparentPenalty {
    /// Number of wrong answers in which rounding does not hide p.
    pub of: usize,
    /// `N/m`, or `c` for multiples of the stiffness: the unit in which the penalties differ less.
    pub unit: &'static str,
    /// The least and the largest penalty in this unit.
    pub range: [Exact; 2],
    /// Whether all are the least one times powers of ten.
    pub is_by_tens: bool,
    /// The largest p relative to |H − l|; `None` for H = l.
    pub penetration: Option<Exact>,
}

impl ApparentPenalty {
    /// Returns the penalty of the answers if all penetrate the plane in equilibrium, as far as rounding shows it.
    pub(super) fn of(wrong: &[&Observation]) -> Option<Self> {
        let shown: Vec<_> = wrong.iter().filter(|answer| is_shown(answer)).collect();
        let all = shown.iter().map(|answer| penalty(answer)).collect::<Option<Vec<_>>>()?;
        let by_c = shown.iter().zip(&all).map(|(answer, eps)| eps / &answer.problem.system.c).collect();
        let parts = shown.iter().map(|answer| {
            let gap = system::gap(&answer.problem.system).abs();
            (!gap.is_zero()).then(|| penetration(answer).map(|p| p / gap))?
        });
        let penetration = parts.collect::<Option<Vec<_>>>().and_then(|parts| parts.into_iter().max());
        let of = shown.len();
        let in_units = [("N/m", all), ("c", by_c)].map(|(unit, penalties): (_, Vec<Exact>)| {
            let range = [penalties.iter().min()?.clone(), penalties.iter().max()?.clone()];
            let is_by_tens = penalties.iter().all(|eps| is_power_of_ten(&(eps / &range[0])));
            Some(ApparentPenalty { of, unit, range, is_by_tens, penetration: penetration.clone() })
        });
        let rank = |found: &Self| (!found.is_by_tens, &found.range[1] / &found.range[0]);
        in_units.into_iter().flatten().min_by_key(rank).filter(|_| of >= INFORMATIVE)
    }
}

fn penetration(answer: &Observation) -> Option<Exact> {
    Some(contact::penetration(&answer.problem.system, answer.numbers()[0].as_ref()?))
}

/// Returns the rounding error of p.
fn rounding(answer: &Observation) -> Exact {
    &answer.sizes[0] * Exact::power_of_two(-52)
}

/// Returns `true` unless p may consist of rounding errors, of which a ten-thousandth would not matter.
fn is_shown(answer: &Observation) -> bool {
    penetration(answer).is_none_or(|p| p.abs() > rounding(answer) * Exact::from(10_000))
}

/// Returns N/p of an answer in equilibrium, whose error is small relative to c p, and thus to the error of N, or due to
/// rounding.
fn penalty(answer: &Observation) -> Option<Exact> {
    let (p, [Some(u), Some(n)]) = (penetration(answer)?, answer.numbers()) else { return None };
    let system = &answer.problem.system;
    if p <= Exact::zero() || *n <= Exact::zero() {
        return None;
    }
    let penalty = n / &p;
    let rounded = &penalty * rounding(answer) + &answer.sizes[1] * Exact::power_of_two(-50);
    let most = decimal(1, -2) * &system.c * &p + Exact::from(4) * rounded;
    (contact::equilibrium(system, u, n).abs() <= most).then_some(penalty)
}

/// Returns `true` for a power of ten up to a thousandth, which answers of few digits allow.
fn is_power_of_ten(x: &Exact) -> bool {
    let power = x.to_f64().map_or(0, |x| x.log10().round() as i32);
    (x / decimal(1, power) - Exact::one()).abs() <= decimal(1, -3)
}
