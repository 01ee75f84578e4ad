//! The three properties that the chapter rests on, for random systems: the conditions (1.6), the limit of (1.13), and
//! Theorem 1.3.3; in exact rationals, and in floats to within rounding. The proofs of the same claims are for all
//! systems; these run the solver.

use crate::strategies::*;
use spring_mass_contact::chapter::{penalty, rounding};

/// The conditions (1.6), in contact, grazing and separated. Each method has a force in equilibrium, c p + N = R, which
/// never pulls. The penetration that remains is 0 for the multiplier, ⟨R⟩/(c + ε) for the penalty, and below the
/// tolerance after an augmentation that converged. As printed, with a bilateral plane, R has no brackets.
#[test]
fn karush_kuhn_tucker_conditions() {
    holds(any_state(WIDE), |case| {
        let (s, r) = (&case.system, case.reaction());
        for (plane, method, answer) in case.solutions(30) {
            let acts = if plane == Plane::Unilateral { r.positive_part() } else { r.clone() };
            let kkt = answer.residuals(s).unwrap();
            assert_eq!(&s.c * &answer.penetration + &answer.contact_force, r);
            assert_eq!((&kkt.stationarity, &kkt.primal), (&int(0), &answer.penetration.positive_part()));
            assert_eq!(kkt.dual, (-&answer.contact_force).positive_part());
            assert_eq!(kkt.complementarity, &answer.penetration * &answer.contact_force, "{method:?}");
            assert!(answer.outcome != Outcome::Converged || kkt.primal < case.tolerance);
            assert!(plane == Plane::Bilateral || kkt.dual.is_zero(), "{method:?}");
            match &method {
                Method::Lagrange => assert_eq!(answer.contact_force, acts),
                Method::Penalty { penalty } => {
                    assert_eq!(&answer.contact_force * (&s.c + penalty), penalty * acts);
                }
                Method::Augmented { .. } => {}
            }
        }
        let answer = solve(s, &Method::Lagrange).unwrap();
        assert!(answer.residuals(s).unwrap().is_zero());
        assert_eq!((answer.deflection, answer.multiplier), (resting(s), Some(pushing(s))));
    });
}

/// The bounds of every method contain what is exact for its parameters; the plane never pulls, despite rounding.
fn exact_answers_are_enclosed<T: Float>(floats: &Case<T>) {
    let case = floats.exact();
    for ((plane, method, answer), (.., exactly)) in floats.solutions(50).into_iter().zip(case.solutions(0)) {
        assert_eq!(answer.state, exactly.state);
        assert!(plane == Plane::Bilateral || answer.contact_force >= T::zero(), "{method:?}");
        let by_iteration = matches!(method, Method::Augmented { .. });
        let Solution { deflection, penetration, contact_force, .. } = exactly;
        let [u, p, n] = match (by_iteration, plane) {
            (false, _) => [deflection, penetration, contact_force],
            (true, Plane::Unilateral) => {
                let u = resting(&case.system);
                [u.clone(), u - system::gap(&case.system), pushing(&case.system)]
            }
            (true, Plane::Bilateral) => [system::gap(&case.system), int(0), case.reaction()],
        };
        let within = &answer.bounds;
        assert!(
            encloses(&within.deflection, &u) && encloses(&within.penetration, &p),
            "{method:?} {plane:?}"
        );
        assert!(encloses(&within.contact_force, &n), "{method:?} {plane:?}");
    }
}

/// The limit of (1.13): for every δ > 0 and all ε ≥ |R|/δ − c, |u(ε) − Δ| ≤ δ. The error falls strictly with ε.
#[test]
fn the_deflection_by_penalty_tends_to_the_gap() {
    let penalty = prop_oneof![Just(Exact::zero()), positive(WIDE)];
    holds((any_state(WIDE), positive(WIDE), penalty, positive(WIDE)), |(case, delta, beyond, more)| {
        let (s, r) = (&case.system, case.reaction());
        let eps = (r.abs() / delta - &s.c).positive_part() + beyond;
        let [error, next] =
            [eps.clone(), eps + more].map(|eps| penalty::deflection(s, &eps) - system::gap(s));
        assert!(error.abs() <= *delta);
        assert!(next.abs() < error.abs() || r.is_zero());
    });
}

/// Theorem 1.3.3: for every ε > 0 and every initial multiplier |p_{k+1}| < |p_k|, unless p₀ = 0, and
/// |p_k| (c + k ε) ≤ c |p₀|, so the penetration tends to 0.
#[test]
fn the_augmentation_converges_monotonically_for_every_penalty() {
    holds(any_state(WIDE), |case| {
        let Case { system: s, eps, .. } = case;
        let sizes: Vec<_> =
            case.steps(Plane::Bilateral).map(|step| step.penetration.abs()).take(16).collect();
        assert!(sizes[0].is_zero() || sizes.is_sorted_by(|p, next| next < p), "{sizes:?}");
        for (k, p) in sizes.iter().enumerate() {
            assert!(p * (&s.c + int(k as i32) * eps) <= &s.c * &sizes[0], "k = {k}");
        }
    });
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
    exact_answers_are_enclosed from any_state;
    monotone_until_rounding from quick_contact;
}
