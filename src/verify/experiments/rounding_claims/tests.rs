//! Tests that a violated law is detected, and that cases outside its conditions decide nothing.

use super::*;
use crate::chapter::SpringMass;
use crate::claims::Var;
use crate::formula::claim::{equal, non_negative, perturbed_recursion, within};
use crate::number::{Mpfr, Tree};
use num_traits::Zero;

fn int(n: i32) -> Tree {
    Tree::from(n)
}

/// R = 2⁻²⁴ in f32, where 1 + R is rounded to 1.
fn case() -> Case<f32> {
    let tiny = 2f32.powi(-24);
    let system = SpringMass { c: 1.0, m: tiny, g: 1.0, l: 1.0, h: 1.0 };
    Case { system, eps: 1.0, lambda: 0.0, u: tiny, q: 0.5, ..Case::of(|_| 1.0) }
}

fn tried(claim: &Statement) -> Trial {
    (experiment(Arc::new(RoundingClaim::of(claim))).check)(&case())
}

#[test]
fn an_error_beyond_its_bound_is_detected() {
    let x = symbols();
    let sum = &x.system.l + &x.u;
    let error = || sum.with_rounding() - &sum;
    let eta = || int(1) / Tree::symbol(PRECISION);
    let tiny = Exact::power_of_two(-24);
    // A bound that vanishes with η is measured; any other is only met or not.
    for (times, bound) in [(1, tiny.clone()), (3, Exact::from(3) * &tiny)] {
        let law = within("law", error(), int(times) * eta());
        assert_eq!(tried(&law), Trial::Within { error: tiny.clone(), bound });
    }
    for (bound, holds) in [(int(1), true), (eta() + int(1), true), (int(1) / int(1 << 30), false)] {
        let trial = tried(&within("law", error(), &bound));
        assert_eq!(trial, Trial::Decided(holds), "{bound}");
    }
    let lost = || sum.with_rounding() - int(1);
    assert_eq!(tried(&equal("lost", lost(), 0)), Trial::Decided(true));
    assert_eq!(tried(&equal("kept", lost(), &x.u)), Trial::Decided(false));
    assert_eq!(tried(&non_negative("sign", lost())), Trial::Decided(true));
    assert_eq!(tried(&non_negative("sign", lost() - &x.u)), Trial::Decided(false));
}

#[test]
fn only_hypotheses_on_parameters_restrict_the_sampled_cases() {
    let given = crate::claims::hypotheses();
    let (parameter, computed, interval) = (&given.stiffness, &given.computed_inside, &given.decay);
    let bits = &given.fine_enough;
    let law =
        within("law", symbols().u.with_rounding(), int(1)).assuming([parameter, computed, interval, bits]);
    assert_eq!(
        experiment::<f32>(Arc::new(RoundingClaim::of(&law))).hypotheses.iter().collect::<Vec<_>>(),
        [parameter]
    );
    // Hypotheses that are not sampled are tested: fl(l + u − H) ≥ 0 holds here, and fails for l = 0.
    let under = within("law", symbols().u.with_rounding(), int(1)).assuming([computed]);
    let supposing = |x: &Case<f32>| (experiment(Arc::new(RoundingClaim::of(&under))).check)(x);
    let mut apart = case();
    apart.system.l = 0.0;
    assert_eq!((supposing(&case()), supposing(&apart)), (Trial::Decided(true), Trial::Undecided));
}

#[test]
fn the_coarsest_parameter_determines_the_precision() {
    for coarse in [Var::C, Var::G, Var::L, Var::H, Var::Eps, Var::U] {
        let bits = |var| if var == coarse { 24 } else { 53 };
        let case = Case::of(|var| Mpfr::rounded(bits(var), 1));
        assert_eq!(*floats(&case).unwrap().precision(), Exact::power_of_two(24), "{coarse:?}");
    }
}

/// x₀ = 0 and x ← x + fl(u) have the members k u, and q u stays u without a sequence.
#[test]
fn members_and_powers_of_a_sequence_are_followed() {
    let Case { u, q, .. } = symbols();
    let step = |x: &Tree| x + u.round();
    let law = |times: i32| perturbed_recursion("law", 1).start(0).step(step).near(0, int(times) * u);
    // The last of the members is followed, and no other.
    let last = UNFOLDED_MEMBERS as i32 - 1;
    assert_eq!((tried(&law(last)), tried(&law(last - 1))), (Trial::Decided(true), Trial::Decided(false)));
    let halved = |bound: Tree| {
        perturbed_recursion("law", int(1) / int(2)).start(u).step(|x| x.round() / int(2)).near(q * u, bound)
    };
    assert_eq!(tried(&halved(int(0))), Trial::Within { error: Exact::zero(), bound: Exact::zero() });
    assert_eq!(tried(&equal("power", q + (u - u).round(), int(1) / int(2))), Trial::Decided(true));
}

/// For ε = c each step gains a bit, so λ repeats after slightly more than 53 steps; a small ε gains almost
/// nothing.
#[test]
fn a_repeated_multiplier_is_found_only_if_the_penalty_is_large() {
    let system = SpringMass { c: 3.0, m: 1.0, g: 10.1, l: 1.0, h: 1.3 };
    let mut case: Case<f64> = Case { system, eps: 3.0, ..Case::of(|_| 0.0) };
    let precision = Exact::power_of_two(53);
    let step = find_repeat(&case, &precision).unwrap();
    assert_eq!(
        augmented::update(&case.system, &case.eps, &step.multiplier, &step.deflection),
        step.multiplier
    );
    assert!(step.multiplier > 0.0);
    // A law of the repeated λ is tested with it, whatever the λ of the case is.
    let pushes =
        non_negative("pushes", &symbols().lambda).assuming([&crate::claims::hypotheses().computed_repeats]);
    let tried = |x: &Case<f64>| (experiment(Arc::new(RoundingClaim::of(&pushes))).check)(x);
    assert_eq!(tried(&case), Trial::Decided(true));
    case.eps = 1e-6;
    assert_eq!(find_repeat(&case, &precision).map(|step| step.k), None);
    assert_eq!(tried(&case), Trial::Undecided);
}

#[test]
fn an_error_beyond_its_bound_or_with_the_larger_share_is_worse() {
    let is_worse = |[error, bound]: [i32; 2], other: [i32; 2]| {
        let [error, bound, other, other_bound] = [error, bound, other[0], other[1]].map(Exact::from);
        super::is_worse(&error, &bound, &(other, &other_bound))
    };
    for (less, more) in
        [([1, 4], [1, 2]), ([3, 8], [1, 2]), ([3, 16], [1, 4]), ([0, 1], [1, 9]), ([1, 4], [3, 4])]
    {
        assert_eq!([is_worse(more, less), is_worse(less, more)], [true, false]);
    }
    assert!(!is_worse([2, 4], [1, 2]), "the first of equals");
    for failing in [[5, 1], [1, 0]] {
        assert_eq!([is_worse(failing, [0, 0]), is_worse([0, 0], failing)], [true, false]);
    }
}
