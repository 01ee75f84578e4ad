//! The three properties that the chapter rests on, for random systems in exact rationals: the conditions (1.6), the
//! limit of (1.13), and Theorem 1.3.3. The proofs of the same claims are for all systems; these run the solver. In
//! floats the same holds to within rounding: see `solver`.

use crate::strategies::*;
use spring_mass_contact::chapter::{contact, penalty};

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
        let (u, n) = (contact::deflection(s), contact::contact_force(s));
        assert!(contact::kkt(s, &u, &n).is_zero());
        assert!(!contact::kkt(s, &(u + int(1)), &n).is_zero());
        let answer = solve(s, &Method::Lagrange).unwrap();
        assert!(answer.residuals(s).unwrap().is_zero());
        assert_eq!((answer.deflection, answer.multiplier), (resting(s), Some(pushing(s))));
    });
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
