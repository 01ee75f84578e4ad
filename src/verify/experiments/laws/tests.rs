//! Tests that a violated law is detected, and that cases outside its conditions decide nothing.

use super::*;
use crate::chapter::SpringMass;
use crate::claims::Var;
use crate::formula::claim::{equal, non_negative, within};
use crate::number::{Mpfr, Tree};

fn int(n: i32) -> Tree {
    Tree::from(n)
}

/// R = 2⁻²⁴ in f32, where 1 + R is rounded to 1.
fn case() -> Case<f32> {
    let tiny = 2f32.powi(-24);
    let system = SpringMass { c: 1.0, m: tiny, g: 1.0, l: 1.0, h: 1.0 };
    Case { system, eps: 1.0, lambda: 0.0, u: tiny, q: 0.5, ..Case::of(|_| 1.0) }
}

/// Returns the value that floats compute for a formula.
fn computed<T: Scalar + Real + ToExact>(formula: &Tree, case: &Case<T>) -> Option<T> {
    let mut program = Program::default();
    let place = program.add(formula);
    Evaluation::of(case, &program, &[]).unwrap().compute(place).cloned()
}

fn tried(claim: &Statement) -> Trial {
    (experiment(claim).check)(&case())
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
    assert_eq!(experiment::<f32>(&law).given.iter().collect::<Vec<_>>(), [parameter]);
    // Hypotheses that are not sampled are tested: fl(l + u − H) ≥ 0 holds here, and fails for l = 0.
    let under = within("law", symbols().u.with_rounding(), int(1)).assuming([computed]);
    let supposing = |x: &Case<f32>| (experiment(&under).check)(x);
    let mut apart = case();
    apart.system.l = 0.0;
    assert_eq!((supposing(&case()), supposing(&apart)), (Trial::Decided(true), Trial::Undecided));
}

#[test]
fn underflow_and_overflow_yield_no_value() {
    let Case { system: s, u, .. } = symbols();
    let with = |c: f64, m: f64| {
        let system = SpringMass { c, m, g: 1.0, l: 1.0, h: 1.0 };
        Case { system, ..Case::of(|_| 0.0) }
    };
    let computed = |tree: &Tree, c: i32, m: i32| computed(tree, &with(power_of_two(c), power_of_two(m)));
    let least = -1074 + 53;
    let (product, quotient) = (&s.c * &s.m, &s.c / &s.m);
    assert_eq!(computed(&product, least, 0), Some(power_of_two(least)));
    assert_eq!(computed(&quotient, least, 0), Some(power_of_two(least)));
    assert_eq!([computed(&product, least, -1), computed(&quotient, least, 1)], [None, None]);
    assert_eq!([computed(&product, 1000, 1000), computed(&quotient, 1000, -1000)], [None, None]);
    // A product with 0 is not an underflow, and neither is a difference.
    assert_eq!(computed(&(u * &s.c), 0, 0), Some(0.0));
    assert_eq!(computed(&(u / &s.c), 0, 0), Some(0.0));
    assert_eq!(computed(&(&s.c - &s.m), least, least - 1), Some(power_of_two(least - 1)));
}

#[test]
fn the_coarsest_parameter_determines_the_precision() {
    for coarse in [Var::C, Var::G, Var::L, Var::H, Var::Eps, Var::U] {
        let bits = |var| if var == coarse { 24 } else { 53 };
        let case = Case::of(|var| Mpfr::rounded(bits(var), 1));
        assert_eq!(
            Evaluation::of(&case, &Program::default(), &[]).unwrap().precision,
            Exact::power_of_two(24),
            "{coarse:?}"
        );
    }
}

#[test]
fn the_power_symbol_is_a_power_of_the_ratio_once_a_sequence_is_followed() {
    let case = case();
    let law = Law::of(&equal("power", Tree::symbol(POWER), &symbols().u));
    let mut floats = Evaluation::of(&case, &law.program, &law.varies).unwrap();
    let Test::Equal(q, u) = law.asks else { panic!("an equation") };
    assert_eq!((floats.value(q).cloned(), floats.value(u).cloned()), (exact(&0.5f32), exact(&case.u)));
    floats.set(MEMBERS[0], 0.0);
    assert_eq!((law.varies[q], law.varies[u]), (true, false));
    assert_eq!((floats.value(q).cloned(), floats.value(u).cloned()), (Some(Exact::one()), exact(&case.u)));
}

/// For ε = c each step gains a bit, so λ repeats after slightly more than 53 steps; a small ε gains almost
/// nothing.
#[test]
fn a_repeated_multiplier_is_found_only_if_the_penalty_is_large() {
    let Case { system: s, eps, lambda, u, .. } = symbols();
    let mut program = Program::default();
    let next = program.add(&augmented::update(s, eps, lambda, u));
    let system = SpringMass { c: 3.0, m: 1.0, g: 10.1, l: 1.0, h: 1.3 };
    let mut case: Case<f64> = Case { system, eps: 3.0, ..Case::of(|_| 0.0) };
    let mut floats = Evaluation::of(&case, &program, &[]).unwrap();
    assert_eq!(floats.find_repeat(), Some(()));
    let next = *floats.compute(next).unwrap();
    assert_eq!(next, floats.number("λ"));
    assert!(next > 0.0);
    // A law of the repeated λ is tested with it, whatever the λ of the case is.
    let pushes = non_negative("pushes", lambda).assuming([&crate::claims::hypotheses().computed_repeats]);
    let tried = |x: &Case<f64>| (experiment(&pushes).check)(x);
    assert_eq!(tried(&case), Trial::Decided(true));
    case.eps = 1e-6;
    assert_eq!(Evaluation::of(&case, &program, &[]).unwrap().find_repeat(), None);
    assert_eq!(tried(&case), Trial::Undecided);
}

#[test]
fn the_trial_with_the_larger_share_is_the_worse() {
    let of = |error: i32, bound: i32| super::within(Exact::from(error), Exact::from(bound));
    let shares = [of(1, 2), of(1, 4), of(3, 4), of(5, 8), of(3, 16)];
    let worst = |a: &Trial, b: &Trial| worse(a.clone(), b.clone());
    let found = shares.iter().fold(Trial::Undecided, |worst_so_far, share| worst(&worst_so_far, share));
    assert_eq!(found, of(3, 4));
    for (less, more) in
        [(of(1, 4), of(1, 2)), (of(3, 8), of(1, 2)), (of(3, 16), of(1, 4)), (of(0, 1), of(1, 9))]
    {
        assert_eq!((worst(&less, &more), worst(&more, &less)), (more.clone(), more));
    }
    assert_eq!(worst(&of(1, 2), &of(2, 4)), of(1, 2), "the first of equals");
    for failing in [of(5, 1), of(1, 0)] {
        assert_eq!((worst(&of(0, 0), &failing), worst(&failing, &of(0, 0))), (failing.clone(), failing));
    }
}
