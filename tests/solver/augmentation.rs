//! The augmented Lagrangian method: the number of steps (1.33), its iterates, and where it ends in floats. That it
//! converges for every ε > 0 is in `properties`, and the closed forms of its iterates are in `closed_form`.

use crate::strategies::*;
use spring_mass_contact::chapter::{augmented, contact, rounding, structure};
use spring_mass_contact::rug::Integer;
use spring_mass_contact::solver::exact_augmentation_count;

const PLANES: [Plane; 2] = [Plane::Unilateral, Plane::Bilateral];

/// Returns p₀ of the bilateral iteration.
fn first_penetration(case: &Case<Exact>) -> Exact {
    (case.reaction() - &case.start) / (&case.system.c + &case.eps)
}

/// Returns ρ.
fn contraction(case: &Case<Exact>) -> Exact {
    &case.system.c / (&case.system.c + &case.eps)
}

/// Returns the exact number of steps.
fn count(case: &Case<Exact>, plane: Plane) -> Integer {
    exact_augmentation_count(&case.system, &case.eps, &case.tolerance, &case.start, plane).unwrap()
}

/// Cases with ε/c large enough for a short iteration.
fn quick(span: i32) -> BoxedStrategy<Case<Exact>> {
    let factor = prop_oneof![Just(int(1)), Just(q("1/10")), (-4..PENALTIES).prop_map(Exact::power_of_two)];
    (any_state(span), factor).prop_map(|(case, factor)| case.with_penalty(&factor)).boxed()
}

/// (1.33): the count equals the number of steps of the exact iteration, for both planes, from every initial
/// multiplier.
#[test]
fn the_count_is_the_iterations() {
    holds((quick(WIDE), 0i32..40, positive(0)), |(case, digits, factor)| {
        // Relative to the first step, so that a few hundred augmentations reach it at ε = c/16.
        let p0 = first_penetration(case).abs();
        let part = factor * Exact::power_of_two(-digits);
        let case = &Case { tolerance: if p0.is_zero() { factor.clone() } else { p0 * part }, ..case.clone() };
        let Case { system: s, eps, tolerance, .. } = case;
        for (plane, solve) in planes() {
            let residual = |step: &Iterate<Exact>| match plane {
                Plane::Bilateral => step.penetration.clone(),
                Plane::Unilateral => augmented::natural_residual(s, eps, &step.multiplier, &step.deflection),
            };
            let needed = count(case, plane);
            let needed = needed.to_usize().expect("small, by the choice of ε and the tolerance");
            let steps: Vec<_> = case.steps(plane).take(needed + 2).collect();
            let counted =
                steps.iter().position(|step| augmented::within_tolerance(&residual(step), tolerance));
            assert_eq!(counted, Some(needed), "{plane:?}");
            // The solver takes this number of augmentations if it is allowed; one fewer does not suffice.
            let run = |limit: usize| solve(s, &case.augmented(limit as u64)).unwrap();
            let answer = run(needed);
            let k = answer.augmentations.unwrap() as usize;
            assert!(k <= needed && answer.deflection == steps[k].deflection);
            if answer.outcome == Outcome::Converged {
                let rest = if plane == Plane::Unilateral { resting(s) } else { system::gap(s) };
                assert!((answer.deflection - rest).abs() < *tolerance);
                assert_eq!(k, needed);
            } else {
                // In rationals too: an event without the residual below the tolerance needs p = 0 exactly.
                assert!(answer.penetration.is_zero() && answer.multiplier == Some(case.reaction()));
            }
            if let Some(fewer) = needed.checked_sub(1) {
                assert_eq!(run(fewer).outcome, Outcome::IterationLimit);
            }
        }
    });
}

/// A tie, |p₀| = tol ρ⁻ⁿ, is not *below* the tolerance at n.
#[test]
fn a_tie_takes_one_step_more() {
    holds((in_contact(WIDE), positive(4), 0u32..60), |(case, relative, n)| {
        let case = Case { start: int(0), ..case.with_penalty(relative) };
        let tie = Case { tolerance: power(&contraction(&case), *n) * first_penetration(&case), ..case };
        let more = Case { tolerance: &tie.tolerance * (int(1) + Exact::power_of_two(-200)), ..tie.clone() };
        for plane in PLANES {
            assert_eq!((count(&tie, plane), count(&more, plane)), (Integer::from(n + 1), Integer::from(*n)));
        }
    });
}

/// p₀ = 2/(4 + 4) = 1/4 halves with every step: 2⁻² < 2⁻¹⁰⁰⁰⁰⁰⁰ · 2ᵏ first for k = 999 999.
#[test]
fn a_count_of_many_digits() {
    let (eps, start, tolerance) = (int(4), int(0), Exact::power_of_two(-1_000_000));
    let case = Case { system: example().as_ref().map(exact), eps, start, tolerance };
    assert_eq!(count(&case, Plane::Unilateral), 999_999);
}

/// R = −1, ε = 1: from λ₀ = 1/2 the mass separates at once, |r₀| = λ₀/ε = 1/2, and r₁ = 0. From λ₀ = −1 it is
/// separated as well, and |r₀| = −λ₀/ε = 1. Neither is *less* than a tolerance of the same value.
#[test]
fn a_residual_of_the_tolerance_is_not_below_it() {
    let system = SpringMass { c: 1, m: 1, g: 1, l: 0, h: 2 }.map(int);
    for (start, tie) in [(q("1/2"), q("1/2")), (int(-1), int(1))] {
        for (tolerance, needed) in [(tie.clone(), 1), (tie + Exact::power_of_two(-99), 0)] {
            let case = Case { system: system.clone(), eps: int(1), start: start.clone(), tolerance };
            let answer = solve(&case.system, &case.augmented(9)).unwrap();
            assert_eq!((answer.outcome, answer.augmentations), (Outcome::Converged, Some(needed)));
            assert_eq!(count(&case, Plane::Unilateral), needed);
        }
    }
}

/// Each step equals the functions of λ, also if it is computed in place: bit for bit, and of the same
/// precision.
fn follows_the_functions<T: OrderedField>(case: &Case<T>) {
    let Case { system: s, eps, start, .. } = case;
    for plane in PLANES {
        let mut lambda = start.clone();
        for step in case.steps(plane).take(6) {
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
                    let (force, next) =
                        (augmented::contact_force(s, &u), augmented::update(s, eps, &lambda, &u));
                    (u, force, next)
                }
            };
            let bits = [&lambda, &u, &contact::penetration(s, &u), &force].map(|x| format!("{x:?}"));
            let Iterate { multiplier, deflection, penetration, contact_force, .. } = &step;
            let found = [multiplier, deflection, penetration, contact_force].map(|x| format!("{x:?}"));
            assert_eq!(found, bits, "{plane:?}");
            lambda = next;
        }
    }
}

#[test]
fn steps_are_what_the_functions_say() {
    holds(quick(WIDE), follows_the_functions);
    holds(any_state(WIDE), |case| follows_the_functions(&case.rounded(&1f64)));
    // Every parameter has its own precision, or none.
    holds((any_state(WIDE), prop::collection::vec(1u32..200, 8)), |(case, precisions)| {
        let mut precisions = precisions.iter();
        follows_the_functions(&case.map(|x| match precisions.next() {
            Some(p @ 2..) => x.to_mpfr(*p),
            _ => Mpfr::constant(x.as_rational().clone()),
        }));
    });
}

/// Returns the default system in f64.
fn default_floats() -> SpringMass<f64> {
    SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 }
}

/// The default system in f64 with ε = 1e5 ends in a 2-cycle: λ never repeats and p̂ always changes sign.
#[test]
fn two_cycles_are_recognised() {
    let s = default_floats();
    let steps = Augmentation::new(&s, &1e5).over(Plane::Bilateral);
    let multipliers: Vec<f64> = steps.map(|step| step.multiplier).take(10_000).collect();
    let [.., a, b, c] = multipliers[..] else { unreachable!() };
    assert!(a == c && a != b, "{a} {b} {c}");
    assert!(multipliers.windows(2).all(|pair| pair[0] != pair[1]));
    let solved = |tolerance| solve(&s, &augmentation(1e5, tolerance, u64::MAX, 0.0)).unwrap();
    let answer = solved(1e-18);
    assert_eq!(answer.outcome, Outcome::Stagnated);
    let error = (exact(&answer.deflection) - system::gap(&s.as_ref().map(exact))).abs();
    assert!(error <= exact(&answer.floor.unwrap()));
    assert_eq!(solved(1e-15).outcome, Outcome::Converged);
}

/// R = −4, λ₀ = 3: after a step with a unilateral plane λ is 0, and with a bilateral one (c λ + ε R)/(c + ε) = −2.
#[test]
fn the_plane_may_change_between_steps() {
    let s = SpringMass { g: 4.0, ..example() }.map(|x| exact(&x).to_mpfr(53));
    let [eps, start] = [4, 3].map(|n| int(n).to_mpfr(53));
    let mut steps = Augmentation::new(&s, &eps).with_multiplier(start);
    steps.next();
    assert!(steps.multiplier().is_zero());
    let mut steps = steps.over(Plane::Bilateral);
    steps.next();
    assert_eq!(exact(steps.multiplier()), int(-2));
}

/// The bound of |u₅ − u*| is not below itself as the tolerance; nor is that of a separated mass, whose u =
/// 1/3 is rounded and whose residual is 0.
#[test]
fn a_bound_of_the_tolerance_is_not_below_it() {
    let s = default_floats();
    let step = Augmentation::new(&s, &100.0).nth(5).unwrap();
    let bound =
        f64::magnitude(&contact::penetration(&s.as_ref().map(f64::enclose), &step.deflection.enclose()));
    assert!(step.penetration < bound);
    let solved = |s: &SpringMass<f64>, tolerance| {
        let answer = solve(s, &augmentation(100.0, tolerance, 99, 0.0)).unwrap();
        (answer.outcome, answer.augmentations)
    };
    assert_eq!(solved(&s, bound), (Outcome::Converged, Some(6)));
    assert_eq!(solved(&s, bound.next_up()), (Outcome::Converged, Some(5)));
    let s = SpringMass { c: 3.0, m: 1.0, g: 1.0, l: 0.0, h: 1.0 };
    let off = structure::deflection(&s).enclose() - structure::deflection(&s.as_ref().map(f64::enclose));
    let bound = f64::magnitude(&off);
    assert_eq!(solved(&s, bound), (Outcome::Stagnated, Some(0)));
    assert_eq!(solved(&s, bound.next_up()), (Outcome::Converged, Some(0)));
}

/// While p̂ ≥ 0, λ̂ increases strictly until it is a fixed point or p̂ is 0 or changes sign, and p̂ never
/// increases. A fixed point has |p(û)| ≤ η|H| + η (1 + η)²/(1 − η) |λ|/ε. The loop always terminates, without
/// a limit.
fn monotone_until_rounding<T: Float>(case: &Case<T>) {
    let floats = Case { start: case.round(&int(0)), ..case.clone() };
    let case = floats.exact();
    for plane in [Plane::Unilateral, Plane::Bilateral] {
        let mut steps = floats.steps(plane);
        let mut last = steps.step();
        // Next to grazing p̂₀ may be rounded to 0 or below, and there is nothing to follow.
        while last.penetration > T::zero() && *steps.multiplier() != last.multiplier {
            assert!(*steps.multiplier() > last.multiplier, "k = {}", last.k);
            let step = steps.step();
            assert!(step.penetration <= last.penetration, "k = {}", last.k);
            last = step;
        }
        let p = exact(&last.deflection) - system::gap(&case.system);
        let lambda = exact(&last.multiplier);
        let fixed = rounding::fixed_point_error(&case.system, &case.eps, &lambda, &floats.precision());
        // p̂ ≤ 0 ended it instead: then see the next law.
        assert!(last.penetration <= T::zero() || p.abs() <= fixed);
    }
}

/// Systems in contact with ε/c large enough for a short iteration.
fn quick_contact(span: i32) -> BoxedStrategy<Case<Exact>> {
    let cases = (in_contact(span), -4..PENALTIES);
    cases.prop_map(|(case, e)| case.with_penalty(&Exact::power_of_two(e))).boxed()
}

in_every_float! {
    monotone_until_rounding from quick_contact;
}
