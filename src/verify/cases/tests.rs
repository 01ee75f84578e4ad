//! Tests that the cases of a sample are of all kinds, so that no claim is checked in vain.

use super::*;
use crate::claims::{Hypotheses, claims};
use crate::number::{Real, ToExact};
use crate::solver::{Method, Scalar, solve};
use crate::verify::experiments;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

fn value(hypothesis: &Hypothesis, case: &Case<Exact>) -> Exact {
    hypothesis.value.eval(&|symbol| case.get_by_symbol(symbol), &|_| None).unwrap()
}

/// Returns all groups of hypotheses of claims.
fn groups() -> BTreeMap<String, Vec<Hypothesis>> {
    // Experiments check claims about rounding.
    let claims =
        claims().filter(|claim| !claim.contains_rounding()).map(|claim| claim.stated_hypotheses().to_vec());
    let experiments = experiments::<f64>().into_iter().map(|experiment| experiment.hypotheses);
    let text = |given: &[Hypothesis]| given.iter().map(|h| format!("{h}, ")).collect();
    claims.chain(experiments).map(|given| (text(&given), given)).collect()
}

#[test]
fn cases_attain_exactly_the_signs_that_hypotheses_allow() {
    for (group, given) in groups() {
        let cases: Vec<_> = (0..1000).filter_map(|index| case(1, index, &given)).collect();
        for hypothesis in &given {
            let sign = |case| value(hypothesis, case).cmp(&Exact::zero());
            let signs: BTreeSet<_> = cases.iter().map(sign).collect();
            let all = [Ordering::Less, Ordering::Equal, Ordering::Greater];
            let allowed = all.into_iter().filter(|sign| hypothesis.relation.admits(*sign)).collect();
            assert_eq!(signs, allowed, "{group}: {hypothesis}");
        }
    }
}

#[test]
fn nearly_every_case_can_be_adjusted_to_every_hypothesis() {
    let Hypotheses {
        stiffness,
        penalty,
        tolerance,
        sufficient_penalty: enough,
        in_equilibrium,
        next_in_equilibrium,
        within_tolerance,
        active,
        releases: idle,
        ..
    } = hypotheses();
    // Computed quantities, precisions and members of a sequence are not sampled.
    let later = [&hypotheses().fine_enough, &hypotheses().pushes];
    let drawn =
        |h: &&Hypothesis| !h.value.contains_rounding() && h.interval().is_none() && !later.contains(h);
    for hypothesis in hypotheses().all().filter(drawn) {
        let needs = match hypothesis {
            h if h == enough => vec![tolerance],
            h if h == next_in_equilibrium => vec![stiffness, penalty, in_equilibrium],
            h if h == within_tolerance => vec![stiffness, penalty],
            h if h == active || h == idle => vec![stiffness],
            _ => vec![],
        };
        let given: Vec<_> = needs.into_iter().chain([hypothesis]).cloned().collect();
        let planted = (0..1000).filter(|i| case(1, *i, &given).is_some()).count();
        assert!(planted > 950, "{hypothesis}: {planted} of 1000");
    }
}

/// Seeds that agree in their lower 32 or 63 bits, and such indices, with the same profile.
#[test]
fn all_bits_of_the_seed_and_of_the_case_number_affect_the_case() {
    let draw = |seed, first| (first..first + 10).map(|i| case(seed, i, &[]).unwrap()).collect::<Vec<_>>();
    assert_eq!(draw(1, 0), draw(1, 0));
    for (seed, first) in [(1 | 1 << 32, 0), (1 | 1 << 63, 0), (1, 10 << 32)] {
        assert!(
            draw(1, 0).iter().zip(draw(seed, first)).all(|(case, other)| *case != other),
            "{seed} {first}"
        );
    }
}

/// R is 0, or one unit in the last place of c Δ in f32 or f64.
#[test]
fn grazing_cases_have_zero_positive_and_negative_reactions() {
    let grazing = PROFILES.iter().position(|p| *p == Profile::Grazing).unwrap() as u64;
    let cases = (0..100).map(|i| grazing + i * PROFILES.len() as u64);
    let cases = cases.map(|index| case(1, index, &[hypotheses().stiffness.clone()]).unwrap());
    let force = |case: &Case<Exact>| (&case.system.c * system::gap(&case.system)).abs();
    let cases = cases.filter(|case| !force(case).is_zero());
    let found: BTreeSet<_> = cases.map(|case| value(&hypotheses().contact, &case) / force(&case)).collect();
    let [single, double] = [-23, -52].map(Exact::power_of_two);
    let units = [Exact::zero(), -&single, single, -&double, double];
    assert!(units.iter().all(|unit| found.contains(unit)), "{found:?}");
}

/// Numbers are multiples of four units, and `solve` accepts nearly all systems.
fn subnormal_systems_are_solved<T: Scalar + Real + ToExact>(like: &T, units: [i32; 3], small: &[Var]) {
    let least = T::min_subnormal().to_exact().unwrap();
    let normal = &least / (Exact::from(2) * like.unit_roundoff().to_exact().unwrap());
    let (mut solved, mut products) = (0, 0);
    for index in 0..100 {
        let profile = Profile::Subnormal(&[]);
        let mut sampler = CaseSampler { random: Rand64::new(index), profile, units };
        let case = Case::of(|var| sampler.magnitude(var));
        let is_small = |x: &Exact| least <= *x && *x < normal;
        let is_multiple = |x: &Exact| (x / &least / Exact::from(4)).as_rational().is_integer();
        for x in small.iter().map(|var| case.get(*var)) {
            assert!(is_small(x) && is_multiple(x), "{x} in {units:?}");
        }
        products += u32::from(is_small(&(&case.system.m * &case.system.g)));
        let computed = Case::try_of(|var| like.round_from_exact(case.get(var))).unwrap();
        solved += u32::from(solve(&computed.system, &Method::Penalty { penalty: computed.eps }).is_ok());
    }
    assert!(solved > 90 && (!small.is_empty() || products > 50), "{solved} of 100 in {units:?}");
}

#[test]
fn each_parameter_is_subnormal_in_some_cases() {
    let small: [&[Var]; 5] = [&[Var::C, Var::Eps], &[Var::M], &[Var::G], &[Var::L, Var::H], &[]];
    let units = PROFILES.iter().filter_map(|profile| match profile {
        Profile::Subnormal(units) => Some(*units),
        _ => None,
    });
    let [singles, doubles] = units.collect::<Vec<_>>()[..] else { panic!("f32 and f64") };
    for (i, small) in small.into_iter().enumerate() {
        subnormal_systems_are_solved(&1f32, singles[i], small);
        subnormal_systems_are_solved(&1f64, doubles[i], small);
    }
}
