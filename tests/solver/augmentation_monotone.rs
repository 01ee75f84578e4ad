//! The augmented Lagrangian method: strictly monotone convergence for every ε > 0 (Theorem 1.3.3), its closed
//! forms, the unilateral iteration of note 4, the number of steps (1.33), and the same in floats.

use crate::strategies::*;
use spring_mass_contact::chapter::{augmented, contact, rounding, structure};
use spring_mass_contact::rug::{Integer, Rational};
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

/// Returns the cases with ε/c = 2ᵉ.
fn with_powers(
    cases: BoxedStrategy<Case<Exact>>,
    exponents: std::ops::Range<i32>,
) -> BoxedStrategy<Case<Exact>> {
    (cases, exponents).prop_map(|(case, e)| case.with_penalty(&Exact::power_of_two(e))).boxed()
}

/// Cases with ε/c large enough for a short iteration.
fn quick(span: i32) -> BoxedStrategy<Case<Exact>> {
    let tenth = any_state(span).prop_map(|case| case.with_penalty(&q("1/10")));
    prop_oneof![with_powers(any_state(span), 0..1), tenth, with_powers(any_state(span), -4..PENALTIES)]
        .boxed()
}
fn quick_contact(span: i32) -> BoxedStrategy<Case<Exact>> {
    with_powers(in_contact(span), -4..PENALTIES)
}

// In rationals.

/// The closed forms at every k, from any initial multiplier, for any ε > 0.
#[test]
fn closed_forms() {
    holds(any_state(WIDE), |case| {
        let Case { system: s, eps, start, .. } = case;
        let (p0, r, rho) = (first_penetration(case), case.reaction(), contraction(case));
        assert_eq!(augmented::contraction(s, eps), rho);
        assert!(int(0) < rho && rho < int(1));
        let mut decay = int(1);
        let mut last: Option<Iterate<Exact>> = None;
        for step in case.steps(Plane::Bilateral).take(16) {
            let Iterate { multiplier: lambda, deflection: u, penetration: p, contact_force: n, .. } = &step;
            assert_eq!(*p, &decay * &p0);
            assert_eq!(*lambda, &r + (start - &r) * &decay);
            assert_eq!(augmented::multiplier_after(s, start, &decay), *lambda);
            assert_eq!(augmented::penetration_after(s, eps, start, &decay), *p);
            assert_eq!(augmented::deflection_after(s, eps, start, &decay), *u);
            assert_eq!(augmented::equilibrium(s, eps, lambda, u), int(0));
            assert_eq!(augmented::stationarity(s, eps, lambda, u), int(0));
            if let Some(last) = last {
                // (1.18)-(1.21): the force of a step is the multiplier of the next.
                assert_eq!(*lambda, last.contact_force);
                assert_eq!(augmented::update(s, eps, &last.multiplier, &last.deflection), *lambda);
                assert_eq!(n - lambda, eps * p);
                let (left, right) = augmented::recursion(s, eps, &last.deflection, u);
                assert_eq!(left, right);
            }
            decay = decay * &rho;
            last = Some(step);
        }
    });
}

/// Note 4: both positive parts; each step minimises its functional, as the bilateral one of (1.14) is claimed to;
/// the natural residual bounds the error in every state, from every initial multiplier.
#[test]
fn one_sided_steps() {
    holds((any_state(WIDE), nonzero(WIDE)), |(case, du)| {
        let Case { system: s, eps, .. } = case;
        let (u_star, n_star, r) = (resting(s), pushing(s), case.reaction());
        for step in case.steps(Plane::Unilateral).take(12) {
            let Iterate { multiplier: lambda, deflection: u, penetration: p, contact_force: n, .. } = &step;
            // p_k = min(R/c, (R − λ_k)/(c + ε)), λ_{k+1} = ⟨(c λ_k + ε R)/(c + ε)⟩.
            assert_eq!(*p, (&r / &s.c).min((&r - lambda) / (&s.c + eps)));
            let next = ((&s.c * lambda + eps * &r) / (&s.c + eps)).positive_part();
            assert_eq!(augmented::unilateral_equilibrium(s, eps, lambda, u), int(0));
            let functional = |u: &Exact| augmented::unilateral_functional(s, eps, lambda, u);
            assert!(functional(&(u + du)) > functional(u));
            assert_eq!(augmented::unilateral_update(s, eps, lambda, u), next);
            assert_eq!(*n, next);
            let residual = augmented::natural_residual(s, eps, lambda, u);
            assert_eq!(&residual * eps, &next - lambda);
            assert!((u - &u_star).abs() <= residual.abs());
            assert_eq!((next - &n_star).abs(), &s.c * (u - &u_star).abs());
            // It *is* the penetration where the plane acts.
            let acts = r >= int(0) && lambda * &s.c >= -eps * &r;
            assert!(!acts || residual == *p);
        }
    });
}

/// R ≥ 0: λ is monotone and geometric from k = 1 on; for R = 0 it never becomes 0.
#[test]
fn one_sided_multipliers_in_contact_and_grazing() {
    holds(prop_oneof![in_contact(WIDE), grazing(WIDE)], |case| {
        let (r, rho) = (case.reaction(), contraction(case));
        let steps: Vec<_> = case.steps(Plane::Unilateral).map(|s| s.multiplier).take(12).collect();
        for (k, lambda) in steps.iter().enumerate().skip(1) {
            assert_eq!(*lambda, &r + power(&rho, k as u32 - 1) * (&steps[1] - &r));
            assert!((lambda - &r).abs() <= (&steps[k - 1] - &r).abs());
        }
        assert!(r > int(0) || case.start <= int(0) || steps.iter().all(|lambda| *lambda > int(0)));
    });
}

/// R < 0: λ_k is 0 first at K, and u_k = m g/c exactly from max(K − 1, 0) on, not before.
#[test]
fn one_sided_steps_let_go_in_time() {
    holds(with_powers(separated(WIDE), -3..8), |case| {
        let Case { system: s, eps, start, .. } = case;
        // K = ⌈ln(1 + λ₀/|R|)/ln(1 + ε/c)⌉ for λ₀ > 0: the least K with (1 + ε/c)^K ≥ 1 + λ₀/|R|.
        let (growth, ratio) = (int(1) + eps / &s.c, int(1) - start / case.reaction());
        let first = match () {
            () if *start < int(0) => 1,
            () => (0..1000).find(|k| power(&growth, *k) >= ratio).unwrap() as usize,
        };
        let free = structure::deflection(s);
        for (k, step) in case.steps(Plane::Unilateral).take(first + 3).enumerate() {
            assert_eq!(step.multiplier.is_zero(), k >= first, "k = {k}");
            assert_eq!(step.deflection == free, k + 1 >= first, "k = {k}");
            assert!(step.deflection <= free);
        }
    });
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

/// Note 9: (c/ε) Λ < ln(|p₀|/tol)/ln(1 + ε/c) < (c/ε + ½) Λ, for counts too large to iterate.
#[test]
fn the_count_of_a_tiny_penalty() {
    holds((in_contact(WIDE), 20..3000i32, 1..100i32), |(case, e, digits)| {
        let case = Case { start: int(0), ..case.with_penalty(&Exact::power_of_two(-e)) };
        let tolerance = first_penetration(&case) * Exact::power_of_two(-digits);
        let needed = count(&Case { tolerance, ..case }, Plane::Bilateral);
        let needed = Exact::from(Rational::from(needed));
        // Λ = digits · ln 2, and 0.693147180 < ln 2 < 0.693147181.
        let [least, most] = ["0.693147180", "0.693147181"].map(|ln2| int(*digits) * q(ln2));
        let inverse = Exact::power_of_two(*e);
        assert!(&inverse * least < needed);
        assert!(needed <= (inverse + q("1/2")) * most + int(1));
    });
}

/// p₀ = 2/(4 + 4) = 1/4 halves with every step: 2⁻² < 2⁻¹⁰⁰⁰⁰⁰⁰ · 2ᵏ first for k = 999 999.
#[test]
fn a_count_of_many_digits() {
    let (eps, start, tolerance) = (int(4), int(0), Exact::power_of_two(-1_000_000));
    let case = Case { system: example().map(exact), eps, start, tolerance };
    assert_eq!(count(&case, Plane::Unilateral), 999_999);
}

/// R = −1, ε = 1: from λ₀ = 1/2 the mass separates at once, |r₀| = λ₀/ε = 1/2, and r₁ = 0. From λ₀ = −1 it is
/// separated as well, and |r₀| = −λ₀/ε = 1. Neither is *less* than a tolerance of the same value.
#[test]
fn a_residual_of_the_tolerance_is_not_below_it() {
    let system = SpringMass { c: 1, m: 1, g: 1, l: 0, h: 2 }.map(|x| int(*x));
    for (start, tie) in [(q("1/2"), q("1/2")), (int(-1), int(1))] {
        for (tolerance, needed) in [(tie.clone(), 1), (tie + Exact::power_of_two(-99), 0)] {
            let case = Case { system: system.clone(), eps: int(1), start: start.clone(), tolerance };
            let answer = solve(&case.system, &case.augmented(9)).unwrap();
            assert_eq!((answer.outcome, answer.augmentations), (Outcome::Converged, Some(needed)));
            assert_eq!(count(&case, Plane::Unilateral), needed);
        }
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
    let answer = solve(&s, &Method::augmented(1.0)).unwrap();
    assert_eq!((answer.outcome, answer.penetration, answer.contact_force), (Outcome::Converged, -1.0, 0.0));
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

// In floats.

/// While p̂ ≥ 0, λ̂ increases strictly until it is a fixed point or p̂ is 0 or changes sign, and p̂ never
/// increases. A fixed point has |p(û)| ≤ η|H| + η (1 + η)²/(1 − η) |λ|/ε. The loop always terminates, without
/// a limit.
fn monotone_until_rounding<T: Float>(case: &Case<T>) {
    let floats = Case { start: case.round(&int(0)), ..case.clone() };
    let case = floats.exact();
    for plane in PLANES {
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

/// |λ̂_k − λ_k| ≤ 11 (c + ε) F and |p̂_k − ρᵏ p₀| ≤ 20 F for every k, if R > 0 and 64 (c + ε) ≤ ε (2ᵖ + 1).
fn close_to_the_closed_form<T: Float>(case: &Case<T>) {
    let floats = Case { start: case.round(&int(0)), ..case.clone() };
    let (case, n) = (&floats.exact(), floats.precision());
    let Case { system: s, eps, .. } = case;
    let stiffness = &s.c + eps;
    let (r, p0, rho) = (case.reaction(), first_penetration(case), contraction(case));
    if r <= int(0) || int(64) * &stiffness > eps * (&n + int(1)) {
        return;
    }
    let of_multiplier = int(11) * stiffness * rounding::floor_scale(s, eps, &n);
    let of_penetration = rounding::penetration_drift(s, eps, &n);
    let mut decay = int(1);
    for step in floats.steps(Plane::Bilateral).take(24) {
        let lambda = &r - &decay * &r;
        assert!((exact(&step.multiplier) - lambda).abs() <= of_multiplier, "k = {}", step.k);
        assert!((exact(&step.penetration) - &decay * &p0).abs() <= of_penetration, "k = {}", step.k);
        decay = decay * &rho;
    }
}

/// The guarantee of each outcome, checked in rationals; the bounds always contain the exact limit.
fn outcomes_keep_their_promises<T: Float>(floats: &Case<T>) {
    let case = floats.exact();
    let s = &case.system;
    let limit = 300;
    for (plane, solve) in planes() {
        let answer = solve(&floats.system, &floats.augmented(limit)).unwrap();
        let (u, n) = match plane {
            Plane::Unilateral => (resting(s), pushing(s)),
            Plane::Bilateral => (system::gap(s), case.reaction()),
        };
        let bounds = &answer.bounds;
        assert!(encloses(&bounds.deflection, &u), "{plane:?}");
        assert!(encloses(&bounds.penetration, &(&u - system::gap(s))), "{plane:?}");
        assert!(encloses(&bounds.contact_force, &n), "{plane:?}");
        let error = |u_k: &T| (exact(u_k) - &u).abs();
        let k = answer.augmentations.unwrap();
        assert!(k <= limit);
        let steps: Vec<_> = floats.steps(plane).take(k as usize + 1).collect();
        let returned = &steps[k as usize];
        assert_eq!(returned.deflection, answer.deflection);
        assert_eq!(Some(&returned.multiplier), answer.multiplier.as_ref());
        assert_eq!(returned.contact_force, answer.contact_force);
        match answer.outcome {
            Outcome::Converged => {
                assert!(error(&answer.deflection) < case.tolerance, "{plane:?}");
                assert_eq!(answer.floor, None);
            }
            Outcome::Stagnated => {
                let floor = exact(answer.floor.as_ref().unwrap());
                assert!(error(&answer.deflection) <= floor, "{plane:?}");
            }
            outcome => assert_eq!((outcome, k, answer.floor), (Outcome::IterationLimit, limit, None)),
        }
    }
}

in_every_float! {
    monotone_until_rounding from quick_contact;
    close_to_the_closed_form from in_contact;
    outcomes_keep_their_promises from any_state;
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
    let error = (exact(&answer.deflection) - system::gap(&s.map(exact))).abs();
    assert!(error <= exact(&answer.floor.unwrap()));
    assert_eq!(solved(1e-15).outcome, Outcome::Converged);
}

/// p̂ can be exactly 0 while p(û) is not and λ is wrong: p̂ alone guarantees nothing.
#[test]
fn a_computed_penetration_of_zero_guarantees_nothing() {
    let s = default_floats().map(|x| *x as f32);
    let gap = system::gap(&s.map(exact));
    let first = Augmentation::new(&s, &1e8).step();
    assert_eq!((first.penetration, first.multiplier), (0.0, 0.0));
    assert_ne!(exact(&first.deflection), gap);
    let answer = solve(&s, &augmentation(1e8, 1e-9, 10, 0.0)).unwrap();
    assert_eq!((answer.outcome, answer.augmentations), (Outcome::Stagnated, Some(0)));
    assert!(exact(&answer.floor.unwrap()) >= (exact(&answer.deflection) - gap).abs());
}

/// Every outcome, and both kinds of stagnation, occur on this grid, so the properties above are not vacuous.
#[test]
fn every_outcome_occurs() {
    let mut counts = [0; 4];
    for penalty in (-10..30).map(|e| 2f64.powi(e) * 100.0) {
        for tolerance in [1e-6, 1e-12, 1e-15, 1e-17] {
            let answer = solve(&default_floats(), &augmentation(penalty, tolerance, 10_000, 0.0)).unwrap();
            counts[match answer.outcome {
                Outcome::Converged => 0,
                Outcome::Stagnated if answer.penetration > 0.0 => 1,
                Outcome::Stagnated => 2,
                _ => 3,
            }] += 1;
        }
    }
    assert!(counts.iter().all(|n| *n > 0), "converged, repeats, crosses, limited: {counts:?}");
}

/// The bound of |u₅ − u*| is not below itself as the tolerance; nor is that of a separated mass, whose u =
/// 1/3 is rounded and whose residual is 0.
#[test]
fn a_bound_of_the_tolerance_is_not_below_it() {
    let s = default_floats();
    let step = Augmentation::new(&s, &100.0).nth(5).unwrap();
    let bound = f64::magnitude(&contact::penetration(&s.map(f64::enclose), &step.deflection.enclose()));
    assert!(step.penetration < bound);
    let solved = |s: &SpringMass<f64>, tolerance| {
        let answer = solve(s, &augmentation(100.0, tolerance, 99, 0.0)).unwrap();
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
