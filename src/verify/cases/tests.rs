//! Tests that samples follow their profiles, and that adjusted cases satisfy their hypotheses.

use super::*;
use crate::chapter::SpringMass;
use crate::claims::{Hypotheses, claims};
use crate::number::{Real, ToExact};
use crate::verify::experiments;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, HashSet};

fn value(hypothesis: &Hypothesis, case: &Case<Exact>) -> Option<Exact> {
    hypothesis.value.eval(&|symbol| case.get_by_symbol(symbol), &|_| None)
}

/// Default number of cases.
const CASES: u64 = 1000;

/// Returns all groups of hypotheses of claims.
fn groups() -> BTreeMap<String, Vec<Hypothesis>> {
    // Experiments check claims about rounding.
    let claims =
        claims().filter(|claim| !claim.contains_rounding()).map(|claim| claim.stated_hypotheses().to_vec());
    let experiments = experiments::<f64>().into_iter().map(|experiment| experiment.hypotheses);
    let text = |given: &[Hypothesis]| given.iter().map(|h| format!("{h}, ")).collect();
    claims.chain(experiments).map(|given| (text(&given), given)).collect()
}

fn samples(given: &[Hypothesis]) -> impl Iterator<Item = Case<Exact>> {
    (0..CASES).filter_map(move |index| case(1, index, given))
}

/// Seventeen coordinates make coincidences impossible in practice: the integers from 1 to 9 alone give 9¹⁷
/// cases.
#[test]
fn no_case_is_sampled_twice() {
    for (group, given) in groups() {
        let mut seen = HashSet::new();
        for case in samples(&given) {
            let coordinates: Vec<_> =
                Var::ALL.iter().map(|var| case.get(*var).as_rational().clone()).collect();
            assert!(seen.insert(coordinates), "{group}: {case:?}");
        }
    }
}

#[test]
fn cases_attain_exactly_the_signs_that_hypotheses_allow() {
    for (group, given) in groups() {
        let cases: Vec<_> = samples(&given).collect();
        for hypothesis in &given {
            let sign = |case| value(hypothesis, case).unwrap().cmp(&Exact::zero());
            let signs: BTreeSet<_> = cases.iter().map(sign).collect();
            let all = [Ordering::Less, Ordering::Equal, Ordering::Greater];
            let allowed = all.into_iter().filter(|sign| hypothesis.relation.admits(*sign)).collect();
            assert_eq!(signs, allowed, "{group}: {hypothesis}");
        }
    }
}

/// Counts the cases in which each parameter is subnormal, then those in which m g is, for floats that can
/// represent them.
fn subnormals<T: Real + ToExact>(like: &T) -> [usize; 7] {
    let eta = like.unit_roundoff().to_exact().unwrap();
    // The smallest normal number is 1/(2 η) units.
    let normal = T::min_subnormal().to_exact().unwrap() / (Exact::from(2) * eta);
    let subnormal = |x: &Exact| !x.is_zero() && x.abs() < normal;
    let mut found = [0; 7];
    for case in samples(&[hypotheses().stiffness.clone(), hypotheses().penalty.clone()]) {
        let Ok(read) =
            Case::try_of(|var| like.round_from_exact(case.get(var)).map_err(drop)?.to_exact().map_err(drop))
        else {
            continue;
        };
        let SpringMass { c, m, g, l, h } = &read.system;
        let weight = &(m * g);
        for (count, x) in found.iter_mut().zip([c, m, g, l, h, &read.eps, weight]) {
            *count += usize::from(subnormal(x));
        }
    }
    found
}

#[test]
fn each_parameter_is_subnormal_in_some_cases() {
    for found in [subnormals(&1f32), subnormals(&1f64)] {
        assert!(found.iter().all(|n| *n >= 5), "{found:?}");
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

#[test]
fn a_seed_determines_the_cases() {
    let draw = |seed| (0..20).map(|i| case(seed, i, &[hypotheses().stiffness.clone()])).collect::<Vec<_>>();
    assert_eq!(draw(1), draw(1));
    assert_ne!(draw(1), draw(2));
}

/// Seeds that agree in their lower 32 or 63 bits, and such indices, with the same profile.
#[test]
fn all_bits_of_the_seed_and_of_the_case_number_affect_the_case() {
    let draw = |seed, first| (first..first + 10).map(|i| case(seed, i, &[]).unwrap()).collect::<Vec<_>>();
    for other in [1 | 1 << 32, 1 | 1 << 63] {
        assert!(draw(1, 0).iter().zip(draw(other, 0)).all(|(case, of_other)| *case != of_other), "{other}");
    }
    assert!(draw(1, 0).iter().zip(draw(1, 10 << 32)).all(|(case, later)| *case != later));
}

#[test]
fn grazing_cases_have_zero_positive_and_negative_reactions() {
    let grazing = PROFILES.iter().position(|p| *p == Profile::Grazing).unwrap() as u64;
    let mut signs = std::collections::BTreeSet::new();
    for i in 0..100 {
        let case = case(1, grazing + i * PROFILES.len() as u64, &[hypotheses().stiffness.clone()]).unwrap();
        signs.insert(value(&hypotheses().contact, &case).unwrap().cmp(&Exact::zero()));
    }
    assert_eq!(signs.len(), 3);
}

fn sampler(profile: Profile) -> CaseSampler {
    CaseSampler { random: Rand64::new(5), profile, small: Small::Products }
}

#[test]
fn both_ends_of_a_range_are_sampled() {
    let mut sampler = sampler(Profile::Plain);
    let found: BTreeSet<_> = (0..100).map(|_| sampler.between(-1, 2)).collect();
    assert_eq!(found, BTreeSet::from([-1, 0, 1, 2]));
}

/// Smallest and largest magnitudes, as powers of two, and numbers of digits.
#[test]
fn numbers_have_the_magnitude_and_precision_of_their_profile() {
    for (profile, low, high, digits) in [
        (Profile::Plain, 0, 4, 4),
        (Profile::Moderate, -18, 15, 11),
        (Profile::Single, -32, 8, 24),
        (Profile::Double, -60, 7, 53),
        (Profile::Huge, 5, 36, 11),
        (Profile::Tiny, -45, -14, 11),
    ] {
        let mut sampler = sampler(profile);
        let all: Vec<_> = (0..10_000).map(|_| sampler.magnitude(Var::C)).collect();
        let range = Exact::power_of_two(low)..=Exact::power_of_two(high);
        assert!(all.iter().all(|x| range.contains(x)), "{profile:?}");
        let fits = |bits| all.iter().filter(|x| x.round_to_bits(bits).as_ref() == Some(x)).count();
        // 2ⁿ itself has only one digit.
        assert_eq!(fits(digits), all.len(), "{profile:?}");
        assert!(fits(digits - 1) < all.len(), "{profile:?}");
    }
}

/// Wrong signs and zeros are sampled, too, but rarely: they are adjusted to hypotheses.
#[test]
fn all_signs_are_sampled() {
    let mut sampler = sampler(Profile::Tiny);
    let all: Vec<_> = (0..400).map(|_| sampler.raw()).collect();
    for var in Var::ALL {
        let sign = |case: &Case<Exact>| case.get(*var).cmp(&Exact::zero());
        let [less, equal, greater] = [Ordering::Less, Ordering::Equal, Ordering::Greater]
            .map(|sought| all.iter().filter(|case| sign(case) == sought).count());
        let mostly_positive = [Var::C, Var::M, Var::Eps, Var::Tol, Var::Q, Var::T, Var::K].contains(var);
        if mostly_positive {
            assert!((10..100).contains(&less) && equal == 0, "{var:?}: {less} {equal} {greater}");
        } else {
            let found = less >= 100 && (10..100).contains(&equal) && greater >= 100;
            assert!(found, "{var:?}: {less} {equal} {greater}");
        }
    }
    // Dimensionless quantities have moderate magnitudes in all profiles.
    let [eighths, whole] = [8, 1].map(|n| {
        let of = move |x: &Exact| (x * Exact::from(n)).as_rational().is_integer();
        move |case: &Case<Exact>, var| of(case.get(var))
    });
    for case in &all {
        for var in [Var::Alpha, Var::Q, Var::T] {
            assert!(eighths(case, var) && case.get(var).abs() <= Exact::from(4), "{var:?}");
        }
        assert!(whole(case, Var::K) && case.k.abs() <= Exact::from(50));
    }
}

#[test]
fn reactions_next_to_grazing_are_a_unit_in_the_last_place() {
    let mut sampler = sampler(Profile::Grazing);
    // c Δ = 3 · 5
    let case = Case::of(|var| match var {
        Var::C => Exact::from(3),
        Var::H => Exact::from(5),
        _ => Exact::zero(),
    });
    let found: HashSet<_> = (0..100).map(|_| sampler.next_to_grazing(&case).as_rational().clone()).collect();
    let units = [Exact::zero(), Exact::power_of_two(-23), Exact::power_of_two(-52)];
    let of = |unit: &Exact| [unit * Exact::from(15), -(unit * Exact::from(15))];
    let expected: HashSet<_> = units.iter().flat_map(of).map(|x| x.as_rational().clone()).collect();
    assert_eq!(found, expected);
}

#[test]
fn stiff_cases_have_large_and_small_ratios() {
    let mut sampler = sampler(Profile::Stiff);
    let ratios = (0..200).map(|_| sampler.raw()).map(|case| case.eps / case.system.c.abs());
    let ratios: Vec<_> = ratios.collect();
    let least = Exact::power_of_two(-60)..Exact::power_of_two(-50);
    let most = Exact::power_of_two(50)..=Exact::power_of_two(60);
    let [smallest, largest] = [ratios.iter().min(), ratios.iter().max()].map(Option::unwrap);
    assert!(least.contains(smallest) && most.contains(largest), "{smallest} {largest}");
}

/// Only the sign is changed; if the sign does not matter, one unit suffices in the grazing profile.
#[test]
fn adjustments_are_as_small_as_possible() {
    let reaction = |case: &Case<Exact>| value(&hypotheses().contact, case).unwrap();
    let (mut zeros, mut beside, mut near) = (0, 0, Vec::new());
    for index in 0..CASES {
        let raw = case(1, index, &[]).unwrap();
        let stiff = case(1, index, &[hypotheses().stiffness.clone()]).unwrap();
        assert_eq!(stiff.system.c, raw.system.c.abs());
        let touching = case(1, index, &[hypotheses().in_contact.clone()]);
        let adjusted = touching.filter(|_| reaction(&raw) < Exact::zero()).map(|case| reaction(&case));
        zeros += usize::from(adjusted.as_ref().is_some_and(Zero::is_zero));
        beside += usize::from(adjusted.as_ref().is_some_and(|r| *r == -reaction(&raw)));
        assert!(adjusted.is_none_or(|r| r.is_zero() || r == -reaction(&raw)), "{index}");
        let profile = PROFILES[(index % PROFILES.len() as u64) as usize];
        let solvable = !raw.system.m.is_zero() && !raw.system.c.is_zero();
        if profile == Profile::Grazing && reaction(&raw).is_zero() && solvable {
            let contact = case(1, index, &[hypotheses().contact.clone()]).unwrap();
            let force = &raw.system.c * crate::chapter::system::gap(&raw.system);
            let few = force.is_zero() || reaction(&contact) <= force.abs() * Exact::power_of_two(-23);
            near.push(few);
        }
    }
    assert!(zeros > 20 && beside > 2 * zeros, "{zeros} {beside}");
    let few = near.iter().filter(|few| **few).count();
    assert!(3 * few > 2 * near.len() && near.len() > 10, "{few} of {}", near.len());
}

/// Counts the cases of each kind that `solve` accepts, in the floats that they are made for.
fn taken<T: crate::solver::Scalar + Real + ToExact>(
    like: &T,
    profile: Profile,
) -> BTreeMap<String, [usize; 2]> {
    let mut found = BTreeMap::new();
    for index in 0..300 {
        let mut sampler = CaseSampler { random: Rand64::new(index), profile, small: Small::Products };
        let mut case = sampler.raw();
        for var in [Var::C, Var::M, Var::Eps] {
            *case.get_mut(var) = case.get(var).abs();
        }
        let [taken, all] = found.entry(format!("{:?}", sampler.small)).or_insert([0, 0]);
        *all += 1;
        let Ok(read) = Case::try_of(|var| like.round_from_exact(case.get(var)).map_err(drop)) else {
            continue;
        };
        let method = crate::solver::Method::Penalty { penalty: read.eps.clone() };
        *taken += usize::from(crate::solver::solve(&read.system, &method).is_ok());
    }
    found
}

/// Numbers are multiples of four units, and neither m g nor c H is much smaller than the other.
#[test]
fn other_quantities_compensate_for_subnormal_ones() {
    let order = |x: &Exact| {
        let [over, under] = [x.as_rational().numer(), x.as_rational().denom()].map(|n| n.significant_bits());
        i64::from(over) - i64::from(under)
    };
    for (profile, smallest, normal) in
        [(Profile::SubnormalSingle, -149, -126), (Profile::SubnormalDouble, -1074, -1022)]
    {
        for small in Small::ALL {
            let mut sampler = CaseSampler { small, ..sampler(profile) };
            let mut orders = Vec::new();
            for _ in 0..99 {
                let case = Case::of(|var| sampler.magnitude(var));
                for x in Var::ALL.iter().filter(|var| small.shift(**var).is_none()).map(|var| case.get(*var))
                {
                    let units = x / Exact::power_of_two(smallest + 2);
                    assert!(units.as_rational().is_integer() && *x < Exact::power_of_two(normal), "{x}");
                }
                let SpringMass { c, m, g, l: _, h } = &case.system;
                orders.push(order(&(m * g)) - order(&(c * h)));
            }
            orders.sort_unstable();
            assert!(orders[49].abs() < 16, "{profile:?} {small:?}: {orders:?}");
        }
    }
}

#[test]
fn solve_accepts_most_subnormal_cases() {
    for found in [taken(&1f32, Profile::SubnormalSingle), taken(&1f64, Profile::SubnormalDouble)] {
        assert_eq!(found.len(), Small::ALL.len());
        assert!(found.values().all(|[taken, all]| 10 * taken > 9 * all), "{found:?}");
    }
}
