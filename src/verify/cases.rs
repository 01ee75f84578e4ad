//! Numbers to try the claims on: drawn from a seed, then bent until the hypotheses hold.
//!
//! A number is drawn as an integer mantissa and an integer exponent, so that a seed means the same on
//! every machine.

use crate::claims::{Case, Given, Relation, Var};
use crate::number::{Dual, Exact, OrderedField};
use num_traits::Zero;
use oorandom::Rand64;

/// How large the numbers of a case are, and what is special about them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Profile {
    /// Integers from 1 to 9.
    Plain,
    /// Some digits, some decades.
    Moderate,
    /// All the digits of an f32.
    Single,
    /// All the digits of an f64.
    Double,
    /// ε/c from 2⁻⁶⁰ to 2⁶⁰.
    Stiff,
    /// R = 0, or one unit in the last place of c Δ beside it, in f32 or in f64.
    Grazing,
    /// Large numbers.
    Huge,
    /// Small numbers.
    Tiny,
    /// Products next to the smallest numbers of f32 or f64.
    Subnormal,
}

const PROFILES: &[Profile] = &[
    Profile::Plain,
    Profile::Moderate,
    Profile::Grazing,
    Profile::Single,
    Profile::Stiff,
    Profile::Double,
    Profile::Tiny,
    Profile::Moderate,
    Profile::Huge,
    Profile::Subnormal,
];

/// The source of one case.
struct Draw {
    random: Rand64,
    profile: Profile,
}

impl Draw {
    fn below(&mut self, n: u64) -> u64 {
        self.random.rand_range(0..n)
    }

    fn between(&mut self, low: i32, high: i32) -> i32 {
        low + self.below((high - low + 1) as u64) as i32
    }

    /// A positive number.
    fn magnitude(&mut self) -> Exact {
        let (bits, low, high) = match self.profile {
            Profile::Plain => return Exact::from(self.between(1, 9)),
            Profile::Moderate | Profile::Stiff | Profile::Grazing => (11, -18, 4),
            Profile::Single => (24, -32, -16),
            Profile::Double => (53, -60, -46),
            Profile::Huge => (11, 5, 25),
            Profile::Tiny => (11, -45, -25),
            Profile::Subnormal => [(11, -80, -66), (11, -545, -530)][self.below(2) as usize],
        };
        let mantissa = 1 + self.below(1 << bits);
        Exact::from(rug::Rational::from(mantissa)) * Exact::power_of_two(self.between(low, high))
    }

    /// A number with no unit, of moderate size.
    fn pure(&mut self) -> Exact {
        Exact::from(self.between(1, 32)) / Exact::from(8)
    }

    fn coordinate(&mut self, var: Var) -> Exact {
        let size = match var {
            Var::Alpha | Var::Q | Var::T => self.pure(),
            Var::K => Exact::from(self.between(1, 50)),
            _ => self.magnitude(),
        };
        match (var, self.below(8)) {
            (Var::C | Var::M | Var::Eps | Var::Tol | Var::Q | Var::T | Var::K, 0) => -size,
            (Var::C | Var::M | Var::Eps | Var::Tol | Var::Q | Var::T | Var::K, _) => size,
            (_, 0) => Exact::zero(),
            (_, 1..=3) => -size,
            _ => size,
        }
    }

    /// A unit in the last place of c Δ, or nothing.
    fn next_to_grazing(&mut self, case: &Case<Exact>) -> Exact {
        let ulp = |n: i32| {
            (&case.system.c * crate::chapter::system::gap(&case.system)).abs() * Exact::power_of_two(n)
        };
        match self.below(5) {
            0 => Exact::zero(),
            1 => ulp(-23),
            2 => -ulp(-23),
            3 => ulp(-52),
            _ => -ulp(-52),
        }
    }

    fn raw(&mut self) -> Case<Exact> {
        let mut case = Case::of(|var| self.coordinate(var));
        if self.profile == Profile::Stiff {
            case.eps = case.system.c.abs() * Exact::power_of_two(self.between(-60, 60));
        }
        if self.profile == Profile::Grazing {
            let reaction = self.next_to_grazing(&case);
            let _ = plant(&mut case, Given::Grazing, &reaction);
        }
        case
    }
}

/// Case number `index` of a seed, with the hypotheses; `None` if it cannot be bent to them.
pub(super) fn case(seed: u64, index: u64, given: &[Given]) -> Option<Case<Exact>> {
    let profile = PROFILES[(index % PROFILES.len() as u64) as usize];
    let mut draw = Draw { random: Rand64::new((u128::from(seed) << 64) | u128::from(index)), profile };
    let mut case = draw.raw();
    for hypothesis in given {
        let value = hypothesis.value(&case);
        if holds(*hypothesis, &case) {
            continue;
        }
        let target = match hypothesis.relation() {
            Relation::Zero => Exact::zero(),
            Relation::NonNegative if draw.below(4) == 0 => Exact::zero(),
            _ if value.is_zero() => match draw.next_to_grazing(&case).abs() {
                tiny if profile == Profile::Grazing && !tiny.is_zero() => tiny,
                _ => draw.magnitude(),
            },
            _ => value.abs(),
        };
        plant(&mut case, *hypothesis, &target)?;
    }
    given.iter().all(|hypothesis| holds(*hypothesis, &case)).then_some(case)
}

fn holds(hypothesis: Given, case: &Case<Exact>) -> bool {
    hypothesis.relation().admits(hypothesis.value(case).cmp(&Exact::zero()))
}

/// Chooses the coordinate that a hypothesis is solved for so that its quantity has this value.
fn plant(case: &mut Case<Exact>, hypothesis: Given, target: &Exact) -> Option<()> {
    let by = hypothesis.solved_for();
    let Dual { value, derivative } = hypothesis.value(&case.along(by));
    if derivative.is_zero() {
        return None;
    }
    let x = case.get(by) + (target - value) / derivative;
    *case.get_mut(by) = x;
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearly_every_case_can_be_bent_to_every_hypothesis() {
        for given in Given::ALL {
            let needs = match given {
                Given::Enough => &[Given::Tolerance][..],
                Given::NextEquilibrium => &[Given::Stiffness, Given::Penalty, Given::Equilibrium],
                Given::WithinTolerance => &[Given::Stiffness, Given::Penalty],
                Given::Active | Given::Idle => &[Given::Stiffness],
                _ => &[],
            };
            let given: Vec<_> = needs.iter().chain([given]).copied().collect();
            let planted = (0..1000).filter(|i| case(1, *i, &given).is_some()).count();
            assert!(planted > 950, "{given:?}: {planted} of 1000");
        }
    }

    #[test]
    fn a_seed_draws_its_own_cases_and_always_the_same() {
        let draw = |seed| (0..20).map(|i| case(seed, i, &[Given::Stiffness])).collect::<Vec<_>>();
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
    }

    #[test]
    fn grazing_is_met_exactly_and_on_both_sides() {
        let grazing = PROFILES.iter().position(|p| *p == Profile::Grazing).unwrap() as u64;
        let mut signs = std::collections::BTreeSet::new();
        for i in 0..100 {
            let case = case(1, grazing + i * PROFILES.len() as u64, &[Given::Stiffness]).unwrap();
            signs.insert(Given::Contact.value(&case).cmp(&Exact::zero()));
        }
        assert_eq!(signs.len(), 3);
    }
}
