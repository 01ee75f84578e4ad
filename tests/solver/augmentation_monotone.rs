//! The augmented Lagrangian method: strictly monotone convergence for every ε > 0 (Theorem 1.3.3), its closed
//! forms, the unilateral iteration of note 4, the number of steps (1.33), and the same in floats.

use crate::in_every_float;
use crate::strategies::*;
use num_traits::Zero;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, penalty, rounding, structure, system};
use spring_mass_contact::number::{Exact, Mpfr, OrderedField, PositivePart};
use spring_mass_contact::rug::Integer;
use spring_mass_contact::solver::{
    Augmentation, Iterate, Method, Outcome, Plane, Scalar, State, exact_augmentation_count, solve,
    solve_bilateral,
};

fn iterate<'a, T: OrderedField>(case: &'a Case<T>, plane: Plane) -> Augmentation<'a, T> {
    Augmentation::new(&case.system, &case.eps).with_multiplier(case.start.clone()).over(plane)
}

/// Returns p₀ of the bilateral iteration.
fn first_penetration(case: &Case<Exact>) -> Exact {
    (reaction(case) - &case.start) / (&case.system.c + &case.eps)
}

fn contraction(case: &Case<Exact>) -> Exact {
    &case.system.c / (&case.system.c + &case.eps)
}

/// Cases with ε/c large enough for a short iteration.
fn quick(span: i32) -> impl Strategy<Value = Case<Exact>> {
    let relative =
        prop_oneof![Just(int(1)), Just(int(1) / int(10)), (-4..PENALTIES).prop_map(Exact::power_of_two)];
    (any_state(span), relative).prop_map(|(case, relative)| with_penalty(case, &relative))
}
fn quick_contact(span: i32) -> impl Strategy<Value = Case<Exact>> {
    (in_contact(span), -4..PENALTIES).prop_map(|(case, e)| with_penalty(case, &Exact::power_of_two(e)))
}
fn quick_separated() -> impl Strategy<Value = Case<Exact>> {
    (separated(WIDE), -3..8).prop_map(|(case, e)| with_penalty(case, &Exact::power_of_two(e)))
}

proptest! {
    /// Theorem 1.3.3 and the closed forms at every k, from any initial multiplier, for any ε > 0.
    #[test]
    fn closed_forms_and_strict_monotony(case in any_state(WIDE)) {
        let Case { system: s, eps, start, .. } = &case;
        let (p0, r, rho) = (first_penetration(&case), reaction(&case), contraction(&case));
        prop_assert_eq!(&augmented::contraction(s, eps), &rho);
        prop_assert!(int(0) < rho && rho < int(1));
        let mut decay = int(1);
        let mut last: Option<Iterate<Exact>> = None;
        for step in iterate(&case, Plane::Bilateral).take(16) {
            let Iterate { k, multiplier: lambda, deflection: u, penetration: p, contact_force: n, .. } = &step;
            prop_assert_eq!(p, &(&decay * &p0));
            prop_assert_eq!(lambda, &(&r + (start - &r) * &decay));
            prop_assert_eq!(&augmented::multiplier_after(s, start, &decay), lambda);
            prop_assert_eq!(&augmented::penetration_after(s, eps, start, &decay), p);
            prop_assert_eq!(&augmented::deflection_after(s, eps, start, &decay), u);
            prop_assert_eq!(augmented::equilibrium(s, eps, lambda, u), int(0));
            prop_assert_eq!(augmented::stationarity(s, eps, lambda, u), int(0));
            // Without logarithms: |p_k| ≤ |p₀| c/(c + k ε), so no bound is too small for some k.
            let k = int(*k as i32);
            prop_assert!(p.abs() * (&s.c + &k * eps) <= p0.abs() * &s.c);
            if let Some(last) = last {
                // (1.18)-(1.21): the force of a step is the multiplier of the next.
                prop_assert_eq!(lambda, &last.contact_force);
                prop_assert_eq!(&augmented::update(s, eps, &last.multiplier, &last.deflection), lambda);
                prop_assert_eq!(n - lambda, eps * p);
                let (left, right) = augmented::recursion(s, eps, &last.deflection, u);
                prop_assert_eq!(left, right);
                prop_assert!(p.abs() < last.penetration.abs() || p0.is_zero());
                prop_assert!(*p == &rho * &last.penetration);
            }
            decay = decay * &rho;
            last = Some(step);
        }
    }

    /// (1.14) is minimal at the u of the step, where its value is `least_value`.
    #[test]
    fn every_step_minimises_its_functional(case in any_state(WIDE), du in nonzero(WIDE)) {
        let Case { system: s, eps, start: lambda, .. } = &case;
        let u = augmented::deflection(s, eps, lambda);
        let least = augmented::functional(s, eps, lambda, &u);
        prop_assert_eq!(&least, &augmented::least_value(s, eps, lambda));
        prop_assert!(augmented::functional(s, eps, lambda, &(&u + &du)) > least);
        let u = augmented::unilateral_deflection(s, eps, lambda);
        let least = augmented::unilateral_functional(s, eps, lambda, &u);
        prop_assert_eq!(augmented::unilateral_equilibrium(s, eps, lambda, &u), int(0));
        prop_assert!(augmented::unilateral_functional(s, eps, lambda, &(u + du)) > least);
    }

    /// Note 4: both positive parts; the natural residual bounds the error in every state, from every initial
    /// multiplier.
    #[test]
    fn one_sided_steps(case in any_state(WIDE)) {
        let Case { system: s, eps, .. } = &case;
        let (u_star, n_star, r) = (resting(s), pushing(s), reaction(&case));
        for step in iterate(&case, Plane::Unilateral).take(12) {
            let Iterate { multiplier: lambda, deflection: u, penetration: p, contact_force: n, .. } = &step;
            // p_k = min(R/c, (R − λ_k)/(c + ε)), λ_{k+1} = ⟨(c λ_k + ε R)/(c + ε)⟩.
            prop_assert_eq!(p, &(&r / &s.c).min((&r - lambda) / (&s.c + eps)));
            let next = positive_part(&((&s.c * lambda + eps * &r) / (&s.c + eps)));
            prop_assert_eq!(&augmented::unilateral_update(s, eps, lambda, u), &next);
            prop_assert_eq!(n, &next);
            let residual = augmented::natural_residual(s, eps, lambda, u);
            prop_assert_eq!(&residual * eps, &next - lambda);
            prop_assert!((u - &u_star).abs() <= residual.abs());
            prop_assert_eq!((next - &n_star).abs(), &s.c * (u - &u_star).abs());
            // It *is* the penetration where the plane acts.
            let acts = r >= int(0) && lambda * &s.c >= -eps * &r;
            prop_assert!(!acts || residual == *p);
        }
    }

    /// R ≥ 0: λ is monotone and geometric from k = 1 on; for R = 0 it never becomes 0.
    #[test]
    fn one_sided_multipliers_in_contact_and_grazing(case in prop_oneof![in_contact(WIDE), grazing(WIDE)]) {
        let (r, rho) = (reaction(&case), contraction(&case));
        let steps: Vec<_> = iterate(&case, Plane::Unilateral).map(|s| s.multiplier).take(12).collect();
        for (k, lambda) in steps.iter().enumerate().skip(1) {
            let closed = &r + power(&rho, k as u32 - 1) * (&steps[1] - &r);
            prop_assert_eq!(lambda, &closed);
            prop_assert!((lambda - &r).abs() <= (&steps[k - 1] - &r).abs());
            prop_assert!((lambda - &r) * (&steps[1] - &r) >= int(0));
        }
        prop_assert!(r > int(0) || case.start <= int(0) || steps.iter().all(|l| *l > int(0)));
    }

    /// R < 0: λ_k is 0 first at K, and u_k = m g/c exactly from max(K − 1, 0) on, not before.
    #[test]
    fn one_sided_steps_let_go_in_time(case in quick_separated()) {
        let Case { system: s, eps, start, .. } = &case;
        let r = reaction(&case);
        // K = ⌈ln(1 + λ₀/|R|)/ln(1 + ε/c)⌉ for λ₀ > 0: the least K with (1 + ε/c)^K ≥ 1 + λ₀/|R|.
        let (growth, ratio) = (int(1) + eps / &s.c, int(1) - start / &r);
        let mut first = if *start < int(0) { 1 } else { 0 };
        while first < 1000 && *start > int(0) && power(&growth, first) < ratio {
            first += 1;
        }
        let free = structure::deflection(s);
        let steps: Vec<_> = iterate(&case, Plane::Unilateral).take(first as usize + 3).collect();
        let found = steps.iter().position(|step| step.multiplier.is_zero());
        prop_assert_eq!(found, Some(first as usize));
        for (k, step) in steps.iter().enumerate() {
            let let_go = k + 1 >= first as usize;
            prop_assert_eq!(step.deflection == free, let_go, "k = {}", k);
            prop_assert!(step.deflection <= free);
            prop_assert!(k < first as usize || step.multiplier.is_zero());
        }
    }

    /// (1.33): the count equals the number of steps of the exact iteration, for both planes, from every
    /// initial multiplier.
    #[test]
    fn the_count_is_the_iterations(case in quick(WIDE), digits in 0i32..40, factor in positive(0)) {
        // Relative to the first step, so that a few hundred augmentations reach it at ε = c/16.
        let p0 = first_penetration(&case).abs();
        let tolerance = if p0.is_zero() { factor } else { p0 * factor * Exact::power_of_two(-digits) };
        let case = Case { tolerance, ..case };
        let Case { system: s, eps, tolerance, start } = &case;
        for plane in [Plane::Unilateral, Plane::Bilateral] {
            let done = |step: &Iterate<Exact>| match plane {
                Plane::Bilateral => augmented::within_tolerance(&step.penetration, tolerance),
                Plane::Unilateral => {
                    let r = augmented::natural_residual(s, eps, &step.multiplier, &step.deflection);
                    augmented::within_tolerance(&r, tolerance)
                }
            };
            let needed = exact_augmentation_count(s, eps, tolerance, start, plane).unwrap();
            let needed = needed.to_usize().expect("small, by the choice of ε and the tolerance");
            let counted = iterate(&case, plane).take(needed + 2).position(|step| done(&step));
            prop_assert_eq!(counted, Some(needed), "{:?}", plane);
            // The solver takes this number of augmentations if it is allowed; one fewer does not suffice.
            let run = |limit: usize| match plane {
                Plane::Unilateral => solve(s, &case.augmented(limit as u64)),
                Plane::Bilateral => solve_bilateral(s, &case.augmented(limit as u64)),
            };
            let answer = run(needed).unwrap();
            let exactly_there = answer.penetration.is_zero() && answer.multiplier == Some(reaction(&case));
            prop_assert!(answer.augmentations <= Some(needed as u64));
            match answer.outcome {
                Outcome::Converged => {
                    let rest = if plane == Plane::Unilateral { resting(s) } else { system::gap(s) };
                    prop_assert!((answer.deflection - rest).abs() < *tolerance);
                    prop_assert_eq!(answer.augmentations, Some(needed as u64));
                }
                // In rationals too: an event without the residual below the tolerance needs p = 0 exactly.
                outcome => prop_assert!(exactly_there, "{:?}", outcome),
            }
            if let Some(fewer) = needed.checked_sub(1) {
                prop_assert_eq!(run(fewer).unwrap().outcome, Outcome::IterationLimit);
            }
        }
    }

    /// A tie, |p₀| = tol ρ⁻ⁿ, is not *below* the tolerance at n.
    #[test]
    fn a_tie_takes_one_step_more(case in in_contact(WIDE), relative in positive(4), n in 0u32..60) {
        let case = with_penalty(Case { start: int(0), ..case }, &relative);
        let decay = power(&contraction(&case), n);
        let tie = Case { tolerance: decay * first_penetration(&case), ..case };
        let Case { system: s, eps, tolerance, start } = &tie;
        let more = tolerance * (int(1) + Exact::power_of_two(-200));
        for plane in [Plane::Unilateral, Plane::Bilateral] {
            prop_assert_eq!(exact_augmentation_count(s, eps, tolerance, start, plane).unwrap(), n + 1);
            prop_assert_eq!(exact_augmentation_count(s, eps, &more, start, plane).unwrap(), n);
        }
    }

    /// Note 9: (c/ε) Λ < ln(|p₀|/tol)/ln(1 + ε/c) < (c/ε + ½) Λ, for counts too large to iterate.
    #[test]
    fn the_count_of_a_tiny_penalty(case in in_contact(WIDE), e in 20..3000i32, digits in 1..100i32) {
        let case = with_penalty(Case { start: int(0), ..case }, &Exact::power_of_two(-e));
        let tolerance = first_penetration(&case) * Exact::power_of_two(-digits);
        let needed = exact_augmentation_count(&case.system, &case.eps, &tolerance, &case.start, Plane::Bilateral).unwrap();
        let needed = Exact::from(spring_mass_contact::rug::Rational::from(needed));
        // Λ = digits · ln 2, and 693147180/10⁹ < ln 2 < 693147181/10⁹.
        let billion = int(1_000_000_000);
        let (least, most) = (int(digits) * int(693_147_180) / &billion, int(digits) * int(693_147_181) / &billion);
        let inverse = Exact::power_of_two(e);
        prop_assert!(&inverse * least < needed);
        prop_assert!(needed <= (inverse + int(1) / int(2)) * most + int(1));
    }
}

/// The variant with the positive part of the update only stays at p = −½; with both positive parts the
/// contact is released.
#[test]
fn one_bracket_is_wrong() {
    let s = SpringMass { c: 1.0, m: 1.0, g: -1.0, l: 0.0, h: 0.0 };
    assert_eq!(system::reaction(&s), -1.0);
    let mut lambda = 0.0;
    for _ in 0..1000 {
        let u = augmented::deflection(&s, &1.0, &lambda);
        assert_eq!(contact::penetration(&s, &u), -0.5);
        lambda = augmented::unilateral_update(&s, &1.0, &lambda, &u);
    }
    let method = Method::Augmented { penalty: 1.0, tolerance: 1e-9, max_augmentations: 1000, start: 0.0 };
    let answer = solve(&s, &method).unwrap();
    assert_eq!((answer.outcome, answer.penetration, answer.contact_force), (Outcome::Converged, -1.0, 0.0));
}

// In floats.

/// While p̂ ≥ 0, λ̂ increases strictly until it is a fixed point or p̂ is 0 or changes sign, and p̂ never
/// increases. A fixed point has |p(û)| ≤ η|H| + η (1 + η)²/(1 − η) |λ|/ε. The loop always terminates, without
/// a limit.
fn monotone_until_rounding<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = Case { start: Exact::zero(), ..case.clone() }.rounded(like);
    let case = floats.exact();
    let n = int(1) / unit_roundoff(like);
    for plane in [Plane::Unilateral, Plane::Bilateral] {
        let mut steps = iterate(&floats, plane);
        let mut last = steps.step();
        // Next to grazing p̂₀ may be rounded to 0 or below, and there is nothing to follow.
        while last.penetration > T::zero() && *steps.multiplier() != last.multiplier {
            prop_assert!(*steps.multiplier() > last.multiplier, "{:?}", floats);
            let step = steps.step();
            prop_assert!(step.penetration <= last.penetration, "{:?}", floats);
            last = step;
        }
        let p = exact(&last.deflection) - system::gap(&case.system);
        let lambda = exact(&last.multiplier);
        let fixed = rounding::fixed_point_error(&case.system, &case.eps, &lambda, &n);
        // p̂ ≤ 0 ended it instead: then see the next law.
        prop_assert!(last.penetration <= T::zero() || p.abs() <= fixed, "{:?}", floats);
    }
    Ok(())
}

/// |λ̂_k − λ_k| ≤ 11 (c + ε) F and |p̂_k − ρᵏ p₀| ≤ 20 F for every k, if R > 0 and 64 (c + ε) ≤ ε (2ᵖ + 1).
fn close_to_the_closed_form<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = Case { start: Exact::zero(), ..case.clone() }.rounded(like);
    let case = floats.exact();
    let n = int(1) / unit_roundoff(like);
    let stiffness = &case.system.c + &case.eps;
    let (r, p0, rho) = (reaction(&case), first_penetration(&case), contraction(&case));
    if r <= int(0) || int(64) * &stiffness > &case.eps * (&n + int(1)) {
        return Ok(());
    }
    let of_multiplier = int(11) * stiffness * rounding::floor_scale(&case.system, &case.eps, &n);
    let of_penetration = rounding::penetration_drift(&case.system, &case.eps, &n);
    let mut decay = int(1);
    for step in iterate(&floats, Plane::Bilateral).take(24) {
        let lambda = &r - &decay * &r;
        prop_assert!(
            (exact(&step.multiplier) - lambda).abs() <= of_multiplier,
            "k = {} {:?}",
            step.k,
            floats
        );
        let off = (exact(&step.penetration) - &decay * &p0).abs();
        prop_assert!(off <= of_penetration, "k = {} {:?}", step.k, floats);
        decay = decay * &rho;
    }
    Ok(())
}

/// The guarantee of each outcome, checked in rationals; the bounds always contain the exact limit.
fn outcomes_keep_their_promises<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let case = floats.exact();
    let s = &case.system;
    let limit = 300;
    for plane in [Plane::Unilateral, Plane::Bilateral] {
        let solve = if plane == Plane::Unilateral { solve::<T> } else { solve_bilateral::<T> };
        let answer = solve(&floats.system, &floats.augmented(limit)).unwrap();
        let (u, n) = match plane {
            Plane::Unilateral => (resting(s), pushing(s)),
            Plane::Bilateral => (system::gap(s), reaction(&case)),
        };
        let p = &u - system::gap(s);
        let bounds = &answer.bounds;
        for (interval, x) in
            [(&bounds.deflection, &u), (&bounds.penetration, &p), (&bounds.contact_force, &n)]
        {
            let inside = exact(&interval.lower) <= *x && *x <= exact(&interval.upper);
            prop_assert!(inside, "{:?} {:?} {:?}", plane, interval, floats);
        }
        let error = |u_k: &T| (exact(u_k) - &u).abs();
        let k = answer.augmentations.unwrap();
        prop_assert!(k <= limit);
        let steps: Vec<_> = iterate(&floats, plane).take(k as usize + 1).collect();
        let returned = steps.last().unwrap();
        prop_assert_eq!(&returned.deflection, &answer.deflection);
        prop_assert_eq!(Some(&returned.multiplier), answer.multiplier.as_ref());
        prop_assert_eq!(&returned.contact_force, &answer.contact_force);
        match answer.outcome {
            Outcome::Converged => {
                prop_assert!(error(&answer.deflection) < case.tolerance, "{:?} {:?}", plane, floats);
                prop_assert_eq!(answer.floor, None);
            }
            Outcome::Stagnated => {
                let floor = exact(answer.floor.as_ref().unwrap());
                let least = steps.iter().map(|step| error(&step.deflection)).min().unwrap();
                prop_assert!(least <= floor, "{:?} {:?}", plane, floats);
                // It is the bound of a deflection that is, as computed, no further off than any other.
                let enclosed = floats.system.map(T::enclose);
                let free = plane == Plane::Unilateral && reaction(&case) < int(0);
                let bound = |step: &Iterate<T>| {
                    let u = step.deflection.enclose();
                    exact(&<T as Scalar>::magnitude(&if free {
                        u - structure::deflection(&enclosed)
                    } else {
                        contact::penetration(&enclosed, &u)
                    }))
                };
                let off = |step: &Iterate<T>| {
                    let u = &step.deflection;
                    let free_error = || u - structure::deflection(&floats.system);
                    exact(&if free { free_error() } else { step.penetration.clone() }).abs()
                };
                let least = steps.iter().map(off).min();
                let bounds = steps.iter().filter(|step| Some(off(step)) == least).map(bound);
                prop_assert!(bounds.max().is_some_and(|most| floor <= most), "{:?} {:?}", plane, floats);
            }
            outcome => {
                prop_assert_eq!((outcome, k, answer.floor), (Outcome::IterationLimit, limit, None));
            }
        }
    }
    Ok(())
}

/// Each step equals the functions of λ, also if it is computed in place: bit for bit, and of the same
/// precision.
fn steps_are_what_the_functions_say<T: OrderedField>(case: &Case<T>) -> Result<(), TestCaseError> {
    let Case { system: s, eps, start, .. } = case;
    let bits = |x: &T| format!("{x:?}");
    for plane in [Plane::Unilateral, Plane::Bilateral] {
        let mut lambda = start.clone();
        for step in iterate(case, plane).take(6) {
            let (u, force, next) = match plane {
                Plane::Unilateral => {
                    let u = augmented::unilateral_deflection(s, eps, &lambda);
                    let force = augmented::contact_force(s, &u).positive_part();
                    let free = u >= structure::deflection(s);
                    let next = augmented::unilateral_update(s, eps, &lambda, &u);
                    (u, if free { T::zero() } else { force }, next)
                }
                Plane::Bilateral => {
                    let u = augmented::deflection(s, eps, &lambda);
                    let force = augmented::contact_force(s, &u);
                    let next = augmented::update(s, eps, &lambda, &u);
                    (u, force, next)
                }
            };
            prop_assert_eq!(bits(&step.multiplier), bits(&lambda));
            prop_assert_eq!(bits(&step.deflection), bits(&u));
            prop_assert_eq!(bits(&step.penetration), bits(&contact::penetration(s, &u)));
            prop_assert_eq!(bits(&step.contact_force), bits(&force));
            lambda = next;
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn steps_in_rationals(case in quick(WIDE)) {
        steps_are_what_the_functions_say(&case)?;
    }

    #[test]
    fn steps_in_f64(case in any_state(WIDE)) {
        steps_are_what_the_functions_say(&case.rounded(&1f64))?;
    }

    /// Every parameter has its own precision, or none.
    #[test]
    fn steps_in_mpfr(case in any_state(WIDE), precisions in proptest::collection::vec(1u32..200, 8)) {
        let mut precisions = precisions.into_iter();
        let mixed = case.map(|x| match precisions.next() {
            Some(p @ 2..) => x.to_mpfr(p),
            _ => Mpfr::constant(x.as_rational().clone()),
        });
        steps_are_what_the_functions_say(&mixed)?;
    }
}

in_every_float! {
    monotone_until_rounding from quick_contact;
    close_to_the_closed_form from in_contact;
    outcomes_keep_their_promises from any_state;
}

/// The default system in f64 with ε = 1e5 ends in a 2-cycle: λ never repeats and p̂ always changes sign.
#[test]
fn two_cycles_are_recognised() {
    let s = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    let multipliers: Vec<f64> =
        Augmentation::new(&s, &1e5).over(Plane::Bilateral).map(|step| step.multiplier).take(10_000).collect();
    let (a, b, c) = (multipliers[9_997], multipliers[9_998], multipliers[9_999]);
    assert!(a == c && a != b, "{a} {b} {c}");
    assert!(multipliers.windows(2).all(|pair| pair[0] != pair[1]));
    let method =
        |tolerance| Method::Augmented { penalty: 1e5, tolerance, max_augmentations: u64::MAX, start: 0.0 };
    let answer = solve(&s, &method(1e-18)).unwrap();
    assert_eq!(answer.outcome, Outcome::Stagnated);
    let error = (exact(&answer.deflection) - system::gap(&s.map(exact))).abs();
    assert!(error <= exact(&answer.floor.unwrap()));
    assert_eq!(solve(&s, &method(1e-15)).unwrap().outcome, Outcome::Converged);
}

/// p̂ can be exactly 0 while p(û) is not and λ is wrong: p̂ alone guarantees nothing.
#[test]
fn a_computed_penetration_of_zero_guarantees_nothing() {
    let s = SpringMass { c: 100f32, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    let first = Augmentation::new(&s, &1e8).step();
    assert_eq!((first.penetration, first.multiplier), (0.0, 0.0));
    assert_ne!(exact(&first.deflection), system::gap(&s.map(exact)));
    let method = Method::Augmented { penalty: 1e8, tolerance: 1e-9, max_augmentations: 10, start: 0.0 };
    let answer = solve(&s, &method).unwrap();
    assert_eq!((answer.outcome, answer.augmentations), (Outcome::Stagnated, Some(0)));
    assert!(exact(&answer.floor.unwrap()) >= (exact(&answer.deflection) - system::gap(&s.map(exact))).abs());
}

/// Every outcome, and both kinds of stagnation, occur on this grid, so the properties above are not vacuous.
#[test]
fn every_outcome_occurs() {
    let (mut converged, mut repeats, mut crosses, mut iteration_limit) = (0, 0, 0, 0);
    for penalty in (-10..30).map(|e| 2f64.powi(e) * 100.0) {
        for tolerance in [1e-6, 1e-12, 1e-15, 1e-17] {
            let s = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
            let method = Method::Augmented { penalty, tolerance, max_augmentations: 10_000, start: 0.0 };
            let answer = solve(&s, &method).unwrap();
            match answer.outcome {
                Outcome::Converged => converged += 1,
                Outcome::Stagnated if answer.penetration > 0.0 => repeats += 1,
                Outcome::Stagnated => crosses += 1,
                _ => iteration_limit += 1,
            }
        }
    }
    let all = [converged, repeats, crosses, iteration_limit];
    assert!(all.iter().all(|n| *n > 0), "{all:?}");
}

/// Beyond the chapter: k augmentations from λ₀ = 0 are one penalty solution with a larger ε.
#[test]
fn augmentations_are_one_penalty_solve() {
    let s: SpringMass<Exact> = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap();
    let eps = int(30);
    for step in Augmentation::new(&s, &eps).take(20) {
        let growth = power(&(int(13) / int(10)), step.k as u32 + 1);
        let effective = int(100) * (growth - int(1));
        assert_eq!(penalty::deflection(&s, &effective), step.deflection);
    }
}

/// A count of a million steps is exact and is not iterated.
#[test]
fn a_count_of_many_digits() {
    let s: SpringMass<Exact> = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse().unwrap();
    // p₀ = 2/(4 + 4) = 1/4 halves with every step: 2⁻² < 2⁻¹⁰⁰⁰⁰⁰⁰ · 2ᵏ first for k = 999 999.
    let needed =
        exact_augmentation_count(&s, &int(4), &Exact::power_of_two(-1_000_000), &int(0), Plane::Unilateral)
            .unwrap();
    assert_eq!(needed, Integer::from(999_999));
}

/// R = −1, ε = 1: from λ₀ = 1/2 the mass separates at once, |r₀| = λ₀/ε = 1/2, and r₁ = 0. From λ₀ = −1 it is
/// separated as well, and |r₀| = −λ₀/ε = 1. Neither is *less* than a tolerance of the same value.
#[test]
fn a_residual_of_the_tolerance_is_not_below_it() {
    let system = SpringMass { c: 1, m: 1, g: 1, l: 0, h: 2 }.map(|x| int(*x));
    for (start, tie) in [(int(1) / int(2), int(1) / int(2)), (int(-1), int(1))] {
        for (tolerance, needed) in [(tie.clone(), 1), (tie + Exact::power_of_two(-99), 0)] {
            let count =
                exact_augmentation_count(&system, &int(1), &tolerance, &start, Plane::Unilateral).unwrap();
            let method =
                Method::Augmented { penalty: int(1), tolerance, max_augmentations: 9, start: start.clone() };
            let answer = solve(&system, &method).unwrap();
            assert_eq!((answer.outcome, answer.augmentations), (Outcome::Converged, Some(needed)));
            assert_eq!(count, needed);
        }
    }
}

/// The bound of |u₅ − u*| is not below itself as the tolerance; nor is that of a separated mass, whose u =
/// 1/3 is rounded and whose residual is 0.
#[test]
fn a_bound_of_the_tolerance_is_not_below_it() {
    let s = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    let step = Augmentation::new(&s, &100.0).nth(5).unwrap();
    let bound = f64::magnitude(&contact::penetration(&s.map(f64::enclose), &step.deflection.enclose()));
    assert!(step.penetration < bound);
    let solved = |s: &SpringMass<f64>, tolerance| {
        let method = Method::Augmented { penalty: 100.0, tolerance, max_augmentations: 99, start: 0.0 };
        let answer = solve(s, &method).unwrap();
        (answer.outcome, answer.augmentations)
    };
    assert_eq!(solved(&s, bound), (Outcome::Converged, Some(6)));
    assert_eq!(solved(&s, bound.next_up()), (Outcome::Converged, Some(5)));
    let s = SpringMass { c: 3.0, m: 1.0, g: 1.0, l: 0.0, h: 1.0 };
    let off = structure::deflection(&s).enclose() - structure::deflection(&s.map(f64::enclose));
    let bound = f64::magnitude(&off);
    assert_eq!(solved(&s, bound), (Outcome::Stagnated, Some(0)));
    assert_eq!(solved(&s, bound.next_up()), (Outcome::Converged, Some(0)));
}

/// From λ₁ on, a change to a bilateral plane is equivalent to starting from this multiplier.
#[test]
fn the_plane_may_change_on_the_way() {
    let s = SpringMass { c: 1, m: 1, g: -1, l: 0, h: 0 }.map(|x| int(*x));
    let eps = int(1);
    let mut steps = Augmentation::new(&s, &eps).with_multiplier(int(1));
    let first = steps.step();
    let lambda = steps.multiplier().clone();
    let second = steps.over(Plane::Bilateral).step();
    let mut anew = Augmentation::new(&s, &eps).over(Plane::Bilateral).with_multiplier(lambda).step();
    assert_eq!((first.k, anew.k), (0, 0));
    anew.k = 1;
    assert_eq!(second, anew);
}

/// The mass is separated, but in 8 bits u* = 22464/106 = 211.9… is rounded to 213, beyond the plane at
/// 211.97…: λ grows from 0, and u falls to 212 and below. The first u, from λ₀ < 0, is free and 213, within
/// half an ulp each of product and quotient, 64/106 + 1/2: closer than the bounds of the last two.
#[test]
fn a_floor_is_of_the_first_deflection_too() {
    let system = SpringMass { c: "106", m: "117", g: "192", l: "-213", h: "-131/128" };
    let system: SpringMass<Exact> = system.parse().unwrap();
    let system = system.map(|x| x.to_mpfr(8));
    let [penalty, tolerance, start] = [3392, 1, -1 << 20].map(|n| int(n).to_mpfr(8));
    let steps = Augmentation::new(&system, &penalty).with_multiplier(start.clone());
    let deflections: Vec<_> = steps.take(99).map(|step| exact(&step.deflection)).collect();
    let method = Method::Augmented { penalty: penalty.clone(), tolerance, max_augmentations: 99, start };
    let answer = solve(&system, &method).unwrap();
    assert_eq!((answer.state, answer.outcome), (State::Separated, Outcome::Stagnated));
    let last = answer.augmentations.unwrap() as usize;
    assert_eq!((&deflections[0], deflections[last - 1] <= int(212)), (&int(213), true));
    assert!(exact(&answer.deflection) == deflections[last] && deflections[last] <= int(212));
    let floor = exact(&answer.floor.unwrap());
    assert!(int(64) / int(106) + int(1) / int(2) <= floor && floor < int(2), "{floor}");
}
