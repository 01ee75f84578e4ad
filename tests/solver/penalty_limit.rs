//! The penalty method: the limit (1.13) and its rate, the effect of a large ε in floats, the functionals
//! (1.10) and their conditions.

use crate::in_every_float;
use crate::strategies::*;
use num_traits::Zero;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, contact, penalty, rounding, structure, system};
use spring_mass_contact::number::{Ball, Dual, Exact, Mpfr, PositivePart, ToExact};
use spring_mass_contact::solver::{
    Outcome, SolveError, State, penalty_for_penetration, series_penetration, solve, solve_bilateral,
};

proptest! {
    /// (c + ε)(u − Δ) = R for every ε, so u → Δ; both forms of (1.13) are its root.
    #[test]
    fn the_rate_is_exact(case in any_state(WIDE)) {
        let Case { system: s, eps, .. } = &case;
        let (u, r) = (penalty::deflection(s, eps), reaction(&case));
        prop_assert_eq!((&s.c + eps) * (&u - &s.h + &s.l), r.clone());
        prop_assert_eq!(&penalty::deflection_divided(s, eps), &u);
        prop_assert_eq!(penalty::residual(s, eps, &u), int(0));
        prop_assert_eq!(penalty::penetration(s, eps), contact::penetration(s, &u));
        prop_assert_eq!(penalty::contact_force_at_equilibrium(s, eps), penalty::contact_force(s, eps, &u));
        prop_assert_eq!(penalty::total_stiffness(s, eps) * penalty::penetration(s, eps), r.clone());
        // (R − N)/R = c/(c + ε), multiplied out.
        prop_assert_eq!((&r - penalty::contact_force_at_equilibrium(s, eps)) * (&s.c + eps), &s.c * r);
    }

    /// The definition of the limit: for every δ > 0 there is an ε from which on the error is below δ.
    #[test]
    fn the_limit_is_the_gap(case in any_state(WIDE), delta in positive(WIDE), beyond in positive(WIDE)) {
        let s = &case.system;
        let least = reaction(&case).abs() / &delta - &s.c;
        let eps = positive_part(&least) + beyond;
        prop_assert!((penalty::deflection(s, &eps) - system::gap(s)).abs() < delta);
        prop_assert!(contact::penetration(s, &penalty::deflection(s, &eps)).abs() < delta);
    }

    /// The error decreases strictly with the penalty.
    #[test]
    fn the_error_falls_with_the_penalty(case in not_grazing(WIDE), more in positive(WIDE)) {
        let Case { system: s, eps, .. } = &case;
        let error = |eps: &Exact| (penalty::deflection(s, eps) - system::gap(s)).abs();
        prop_assert!(error(&(eps + more)) < error(eps));
    }

    /// ∂p/∂ε = −R/(c + ε)², and the energy of (1.9) is stationary and minimal at (1.13).
    #[test]
    fn derivatives_agree(case in any_state(WIDE), du in nonzero(WIDE)) {
        let Case { system: s, eps, .. } = &case;
        let (total, r) = (&s.c + eps, reaction(&case));
        let constants = s.map(|x| Dual::constant(x.clone()));
        let p = penalty::penetration(&constants, &Dual::variable(eps.clone()));
        prop_assert_eq!(p.derivative * &total * &total, -r);
        let u = penalty::deflection(s, eps);
        let energy = |u: &Exact| penalty::energy(s, eps, u);
        let slope = |u: Exact| penalty::energy(&constants, &Dual::constant(eps.clone()), &Dual::variable(u));
        prop_assert_eq!(slope(&u + &du).derivative, penalty::residual(s, eps, &(&u + &du)));
        prop_assert_eq!(energy(&u), penalty::least_energy(s, eps));
        prop_assert!(energy(&(&u + du)) > energy(&u));
    }

    /// With unilateral contact the plane has no effect on a separated mass.
    #[test]
    fn the_plane_of_solve_is_one_sided(case in any_state(WIDE)) {
        let Case { system: s, eps, .. } = &case;
        let (one, two) = (solve(s, &case.penalty()).unwrap(), solve_bilateral(s, &case.penalty()).unwrap());
        prop_assert_eq!(&one.deflection, &penalty::unilateral_deflection(s, eps));
        let free = reaction(&case) < int(0);
        let expected = if free { structure::deflection(s) } else { penalty::deflection(s, eps) };
        prop_assert_eq!(&one.deflection, &expected);
        prop_assert_eq!(&two.deflection, &penalty::deflection(s, eps));
        prop_assert_eq!(&two.contact_force, &penalty::contact_force_at_equilibrium(s, eps));
        for answer in [one, two] {
            prop_assert_eq!(answer.outcome, Outcome::Direct);
            prop_assert_eq!((answer.multiplier, answer.augmentations, answer.floor), (None, None, None));
            prop_assert_eq!(&answer.bounds.deflection.lower, &answer.deflection);
            prop_assert_eq!(&answer.bounds.penetration.lower, &answer.penetration);
            prop_assert_eq!(&answer.bounds.contact_force.upper, &answer.contact_force);
        }
    }

    /// Remark 1.3.2: the smallest ε is exact; there is none if every ε > 0 suffices.
    #[test]
    fn the_penalty_for_a_penetration(case in any_state(WIDE), less in 1..100i32) {
        let Case { system: s, tolerance: tol, .. } = &case;
        let needed = reaction(&case) > &s.c * tol;
        match penalty_for_penetration(s, tol).unwrap() {
            Some(eps) => {
                prop_assert!(needed && eps > int(0));
                prop_assert_eq!(&penalty::penetration(s, &eps), tol);
                prop_assert!(penalty::penetration(s, &(&eps * int(less) / int(100))) > *tol);
                prop_assert!(penalty::penetration(s, &(&eps * int(100) / int(less))) < *tol);
            }
            None => {
                prop_assert!(!needed);
                prop_assert!(penalty::penetration(s, &case.eps) < *tol);
            }
        }
    }
}

/// Returns the system or, for R < 0, its mirror image, in which floats differ only in their signs: the laws
/// of rounding are stated for R > 0.
fn pushed(s: &SpringMass<Exact>) -> SpringMass<Exact> {
    let SpringMass { c, m, g, l, h } = s.clone();
    if system::reaction(s) < int(0) { SpringMass { c, m, g: -g, l: -l, h: -h } } else { s.clone() }
}

/// û − Δ is R/(c + ε) and the rounding error of six operations.
fn the_rate_until_rounding<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let case = floats.exact();
    let bound = rounding::deflection_error(&pushed(&case.system), &case.eps, &(int(1) / unit_roundoff(like)));
    let u = exact(&penalty::deflection(&floats.system, &floats.eps));
    let p = penalty::penetration(&case.system, &case.eps);
    prop_assert!((&u - system::gap(&case.system) - &p).abs() <= bound, "{:?}", case);
    prop_assert!((u - system::gap(&case.system)).abs() <= p.abs() + bound, "{:?}", case);
    Ok(())
}

/// The error of N̂ = ε p̂ at û is the rounding error of nine operations, and c p in addition relative to R.
fn the_precision_law<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let case = floats.exact();
    let Case { system: s, eps, .. } = &case;
    let bound = rounding::penalty_force_error(&pushed(s), eps, &(int(1) / unit_roundoff(like)));
    let u = penalty::deflection(&floats.system, &floats.eps);
    let n = exact(&penalty::contact_force(&floats.system, &floats.eps, &u));
    prop_assert!((&n - penalty::contact_force_at_equilibrium(s, eps)).abs() <= bound, "{:?}", case);
    let short = &s.c * penalty::penetration(s, eps).abs();
    prop_assert!((n - reaction(&case)).abs() <= short + bound, "{:?}", case);
    Ok(())
}

/// In floats the computed penalty has the rounding error enclosed by balls, and meets the tolerance.
fn the_penalty_for_a_penetration_rounds<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let case = floats.exact();
    let tol = &case.tolerance;
    let balls = floats.map(|x| Ball::point(x.clone()));
    let ball = penalty::penalty_for(&balls.system, &balls.tolerance);
    let least = penalty::penalty_for(&case.system, tol);
    prop_assert!(ball.contains(&least), "{:?}", case);
    let answer = penalty_for_penetration(&floats.system, &floats.tolerance).unwrap();
    let found = answer.as_ref().map_or_else(Exact::zero, exact);
    let expected = positive_part(&least);
    prop_assert!((found - expected).abs() <= exact(ball.radius()), "{:?}", case);
    prop_assert!(answer.is_none() || reaction(&case) > int(0), "{:?}", case);
    Ok(())
}

in_every_float! {
    the_rate_until_rounding from any_state;
    the_precision_law from any_state;
    the_penalty_for_a_penetration_rounds from any_state;
}

fn default_system() -> SpringMass<Exact> {
    SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap()
}

/// Returns |û − Δ| of the default system in f64 at ε = 10ⁿ N/m, exactly.
fn default_error(n: u32) -> Exact {
    let s = default_system().try_map(Exact::to_f64).unwrap();
    let u = penalty::deflection(&s, &10f64.powi(n as i32));
    (exact(&u) - system::gap(&s.map(exact))).abs()
}

/// The log-log slope is −1 for ε ≫ c until rounding dominates; a larger ε does not reduce the error further.
#[test]
fn slope_minus_one_until_rounding_takes_over() {
    // R = 4.81 N and Δ = 0.05 m: rounding, 5ηΔ = 2.8e-17, is below 1/1000 of R/ε up to ε = 1e14.
    for n in 5..14 {
        let slope = (default_error(n + 1) / default_error(n)).to_f64().unwrap().log10();
        // 1/(c + ε) in place of 1/ε bends it by c/ε · 0.9/ln 10 at most, 1/1000 rounding by 1/1000/ln 10 twice.
        assert!((slope + 1.0).abs() < 0.4 * 1e2 / 10f64.powi(n as i32) + 1e-3, "{slope} at 1e{n}");
    }
    for n in 18..30 {
        assert!(default_error(n).to_f64().unwrap_or(0.0) < 3e-17, "at 1e{n}");
    }
}

/// ε* = √(c R/(η L)): N̂ = ε p̂ attains at most half the digits; m g − c û continues to improve.
#[test]
fn half_the_digits_of_the_force_are_lost() {
    let s = default_system().try_map(Exact::to_f64).unwrap();
    let r = system::reaction(&s.map(exact));
    let error = |force: f64| ((exact(&force) - &r).abs() / &r).to_f64().unwrap_or(0.0);
    let by_formula = |eps: f64| error(penalty::contact_force(&s, &eps, &penalty::deflection(&s, &eps)));
    let by_balance = |eps: f64| error(s.m * s.g - s.c * penalty::deflection(&s, &eps));
    // c = 100, R = 4.81, L = 1.05 + 0.25, η = 2⁻⁵³: ε* = 1.8e9 and the law's least value 1.1e-7.
    let best = (1..400).map(|i| by_formula(1.1f64.powi(i))).fold(1.0, f64::min);
    // Some ε near it happens to round well, but none is better than c/(c + ε) alone at 1000 ε*.
    assert!((5e-11..1.1e-7).contains(&best), "{best}");
    assert!(by_formula(1e18) > 0.1, "all digits are lost beyond c R/(c L η) = 3e16");
    assert!(by_balance(1e18) < 1e-15, "and none of m g − c u");
}

// (1.10)

/// Coefficients ε, ε₄, ε₆, …: some may be zero, not all.
fn coefficients(span: i32) -> impl Strategy<Value = (Exact, Vec<Exact>)> {
    let coefficient = || prop_oneof![1 => Just(Exact::zero()), 3 => positive(span)];
    prop_oneof![
        (positive(span), prop::collection::vec(coefficient(), 0..4)),
        (coefficient(), prop::collection::vec(positive(span), 1..4)),
    ]
}

/// The exact residual changes sign between the neighbours of the result, so the result is the nearest float.
fn root_is_the_best<T: Float>(
    s: &SpringMass<Exact>,
    (eps, higher): &(Exact, Vec<Exact>),
    like: &T,
) -> Result<(), TestCaseError> {
    let round = |x: &Exact| like.round_from_exact(x).unwrap();
    let (s, eps, higher) = (s.map(round), round(eps), higher.iter().map(round).collect::<Vec<_>>());
    let p = series_penetration(&s, &eps, &higher).unwrap();
    let terms: Vec<_> = higher.iter().map(exact).collect();
    let residual = |p: T| penalty::series_residual(&s.map(exact), &exact(&eps), &terms, &exact(&p));
    let context = format!("{s:?} {eps:?} {higher:?} {p:?}");
    match State::of(&s).unwrap() {
        State::Grazing => prop_assert!(p.is_zero(), "{}", context),
        state => {
            prop_assert!(residual(p.clone().next_down()) < int(0), "{}", context);
            prop_assert!(residual(p.clone().next_up()) > int(0), "{}", context);
            prop_assert_eq!(p > T::zero(), state == State::Contact, "{}", context);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn series_in_f32(case in any_state(4), terms in coefficients(8)) {
        root_is_the_best(&case.system, &terms, &1f32)?;
    }
    #[test]
    fn series_in_f64(case in any_state(WIDE), terms in coefficients(WIDE)) {
        root_is_the_best(&case.system, &terms, &1f64)?;
    }
    #[test]
    fn series_in_mpfr(case in any_state(WIDE), terms in coefficients(WIDE), bits in 2u32..400) {
        root_is_the_best(&case.system, &terms, &int(1).to_mpfr(bits))?;
    }

    /// The root is chosen first, and the system is constructed from it: c p + ε p + 4 ε₄ p³ + 6 ε₆ p⁵ = R.
    ///
    /// 31, 7 and 7⁵ · 15 have 5, 3 and 18 bits and the exponents differ by at most 24: g has 53 bits.
    #[test]
    fn constructed_roots_are_found(
        n in 1..8i32, e in -2..=2i32, negative in any::<bool>(), k in prop::array::uniform4(0..16i32),
        (c, gap) in (1..32i32, -31..32i32),
    ) {
        let p = int(if negative { -n } else { n }) * Exact::power_of_two(e);
        let [eps, e4, e6, l] = k.map(int);
        let p3 = &p * &p * &p;
        let w = &eps * &p + int(4) * &e4 * &p3 + int(6) * &e6 * &p3 * &p * &p;
        let (c, gap) = (int(c), int(gap));
        let g = &c * &p + w + &c * &gap;
        let s = SpringMass { c, m: int(1), g, h: &l + gap, l };
        let eps = if k[..3] == [0; 3] { int(1) } else { eps };
        let s = SpringMass { g: if k[..3] == [0; 3] { s.g + &p } else { s.g }, ..s };
        let f = s.try_map(Exact::to_f64).unwrap();
        prop_assert_eq!(f.map(exact), s.clone(), "the parameters are floats");
        let higher = [e4.to_f64().unwrap(), e6.to_f64().unwrap()];
        let found = series_penetration(&f, &eps.to_f64().unwrap(), &higher).unwrap();
        prop_assert_eq!(exact(&found), p.clone());
        let like = int(1).to_mpfr(60);
        let [eps, e4, e6] = [eps, e4, e6].map(|x| like.round_from_exact(&x).unwrap());
        let s = s.map(|x| like.round_from_exact(x).unwrap());
        prop_assert_eq!(exact(&series_penetration(&s, &eps, &[e4, e6]).unwrap()), p);
    }

    /// (1.10) with ε alone is (1.12): the same root as (1.13), rounded once.
    #[test]
    fn a_series_of_one_term_is_the_penalty_method(case in not_grazing(WIDE)) {
        let floats = case.rounded(&1f64);
        let exact = floats.exact();
        let p = penalty::penetration(&exact.system, &exact.eps);
        let found = series_penetration(&floats.system, &floats.eps, &[]).unwrap();
        let found = found.to_exact().unwrap();
        // No float is nearer than half the distance of neighbours, η relative to the smaller of the two.
        prop_assert!((&found - &p).abs() <= unit_roundoff(&1f64) * int(2) * p.abs());
    }

    /// The conditions before (1.10) hold for every series, and W > R²/(2c) then bounds p.
    #[test]
    fn every_series_meets_the_conditions((eps, higher) in coefficients(8), case in in_contact(8), p in positive(8)) {
        let s = &case.system;
        let r = reaction(&case);
        let energy = &r * &r / (int(2) * &s.c);
        // W scales with ε as a whole; the last ε lifts it beyond the energy at p.
        let w = |scale: &Exact, p: &Exact| scale * penalty::series(&eps, &higher, p);
        let last = &energy / w(&int(1), &p) + int(1);
        let penalties = [&last / int(4), &last / int(2), last.clone()];
        let penetrations = [p.clone(), &p * int(2)];
        prop_assert_eq!(broken_condition(w, &penalties, &penetrations, &energy), None);
        let scaled: Vec<_> = higher.iter().map(|e| e * &last).collect();
        // The residual at p is positive, so the root lies below.
        prop_assert!(penalty::series_residual(s, &(eps * &last), &scaled, &p) > int(0));
    }
}

/// A quartic alone: 4 ε₄ p³ = R − c p, so p³ ε₄ → R/4 and the log-log slope is −1/3.
#[test]
fn a_quartic_alone_has_slope_minus_a_third() {
    let like = int(1).to_mpfr(200);
    let s = default_system().map(|x| like.round_from_exact(x).unwrap());
    let r = system::reaction(&s.map(exact));
    let root = |n: i32| {
        let e4 = like.round_from_exact(&Exact::power_of_two(n)).unwrap();
        exact(&series_penetration(&s, &Exact::zero().to_mpfr(200), &[e4]).unwrap())
    };
    for n in (10..100).step_by(9) {
        let (p, q) = (root(n), root(n + 3));
        // 8 (q/p)³ = (R − c q)/(R − c p), between 1 and 1/(1 − c p/R); p and q are rounded to 200 bits.
        let cubed = int(8) * power(&(&q / &p), 3);
        let most = int(1) / (int(1) - int(100) * &p / &r);
        let rounding = Exact::power_of_two(-190);
        assert!(cubed > int(1) - &rounding && cubed < most + rounding, "ε₄ = 2^{n}");
        assert!(n < 30 || int(100) * &p / &r < Exact::power_of_two(-5), "the limit is near");
    }
}

/// Errors of the (1.10) solver name the argument.
#[test]
fn series_errors_name_the_argument() {
    let s = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    let argument = |result: Result<f64, SolveError>| match result {
        Err(SolveError::Invalid { argument, .. }) => argument,
        other => panic!("{other:?}"),
    };
    assert_eq!(argument(series_penetration(&SpringMass { c: 0.0, ..s }, &1.0, &[])), "stiffness");
    assert_eq!(argument(series_penetration(&SpringMass { m: -1.0, ..s }, &1.0, &[])), "mass");
    assert_eq!(argument(series_penetration(&SpringMass { g: f64::NAN, ..s }, &1.0, &[])), "gravity");
    assert_eq!(argument(series_penetration(&SpringMass { l: f64::INFINITY, ..s }, &1.0, &[])), "free length");
    assert_eq!(argument(series_penetration(&SpringMass { h: f64::NAN, ..s }, &1.0, &[])), "height");
    assert_eq!(argument(series_penetration(&s, &-1.0, &[])), "penalty");
    assert_eq!(argument(series_penetration(&s, &1.0, &[1.0, -1.0])), "higher penalty");
    assert_eq!(argument(series_penetration(&s, &0.0, &[0.0, 0.0])), "penalties");
    let constants = s.map(|x| Mpfr::constant(exact(x).into()));
    let one = Mpfr::constant(int(1).into());
    let refused = series_penetration(&constants, &one, &[]).unwrap_err();
    assert!(matches!(refused, SolveError::Invalid { argument: "system", .. }), "{refused}");
    // R/(c + ε) below the smallest f32: p = 2 / 2^127 · 2^-30.
    let tiny = SpringMass { c: 4f32, m: 1.0, g: f32::MIN_POSITIVE, l: 1.0, h: 1.0 };
    let refused = series_penetration(&tiny, &f32::MAX, &[]).unwrap_err();
    assert_eq!(refused, SolveError::OutOfRange { quantity: "penetration" });
    // And refused by name where a tolerance is asked for.
    let refused = penalty_for_penetration(&s, &0.0).unwrap_err();
    assert!(matches!(refused, SolveError::Invalid { argument: "tolerance", .. }), "{refused}");
    let refused = penalty_for_penetration(&SpringMass { g: 1e308, ..s }, &1e-300).unwrap_err();
    assert_eq!(refused, SolveError::OutOfRange { quantity: "penalty" });
}

/// R = 2¹⁶⁰ exceeds the range of f32, but 2¹⁶⁰/(2¹²⁶ + 2¹²⁶) does not.
#[test]
fn a_root_is_found_where_the_reaction_is_out_of_range() {
    let power = |n: f32| n.exp2();
    let system = SpringMass { c: power(126.0), m: power(80.0), g: power(80.0), l: 1.0, h: 1.0 };
    assert_eq!(series_penetration(&system, &power(126.0), &[]), Ok(power(33.0)));
    let soft = SpringMass { c: 1.0, ..system };
    let out_of_range = SolveError::OutOfRange { quantity: "penetration" };
    assert_eq!(series_penetration(&soft, &1.0, &[]), Err(out_of_range));
}

/// One of the three conditions on a penalty functional W_ε(p), §1.3.2 before (1.10).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PenaltyCondition {
    /// Condition 1.
    VanishesAtContact,
    /// Condition 2, for p > 0.
    PositiveAndIncreasing,
    /// Condition 3 with the correction of note 3: unbounded in ε, at every p > 0; growth in p does not
    /// suffice.
    Unbounded,
}

/// Returns the first condition before (1.10) that a functional `w(ε, p)` is found to violate.
///
/// The functional is evaluated at the `penalties` (> 0, increasing) and `penetrations` (> 0, increasing).
/// Condition 3, with the correction of note 3, requires that W exceeds `energy` at every penetration for the
/// last penalty. With `energy` = R²/(2c) the penetration of a system is then below the smallest penetration,
/// because W ≤ R²/(2c) at a minimum of Π + W. `None` does not prove the conditions at other values. Source:
/// §1.3.2.
fn broken_condition(
    w: impl Fn(&Exact, &Exact) -> Exact,
    penalties: &[Exact],
    penetrations: &[Exact],
    energy: &Exact,
) -> Option<PenaltyCondition> {
    let increasing = |values: Vec<Exact>| values.is_sorted_by(|a, b| a < b);
    let zero = Exact::zero();
    if penalties.iter().any(|eps| !w(eps, &zero).is_zero()) {
        return Some(PenaltyCondition::VanishesAtContact);
    }
    let with_p = |eps| increasing(std::iter::once(&zero).chain(penetrations).map(|p| w(eps, p)).collect());
    let with_eps = |p| increasing(penalties.iter().map(|eps| w(eps, p)).collect());
    if !penalties.iter().all(with_p) || !penetrations.iter().all(with_eps) {
        return Some(PenaltyCondition::PositiveAndIncreasing);
    }
    let last = penalties.last()?;
    (!penetrations.iter().all(|p| w(last, p) > *energy)).then_some(PenaltyCondition::Unbounded)
}

/// Functionals that violate each condition, and the two of note 3: one meets the printed conditions and is
/// not a penalty, the other is a penalty and does not meet them.
#[test]
fn violated_conditions_are_named() {
    let penalties: Vec<_> = (0..60).step_by(5).map(Exact::power_of_two).collect();
    let penetrations: Vec<_> = (-10..10).map(Exact::power_of_two).collect();
    let broken = |w: fn(&Exact, &Exact) -> Exact| broken_condition(w, &penalties, &penetrations, &int(4));
    use PenaltyCondition::*;
    assert_eq!(broken(penalty::functional), None);
    assert_eq!(broken(|eps, p| penalty::series(eps, &[int(1), int(0), int(3)], p)), None);
    assert_eq!(broken(|eps, p| eps * penalty::series(&int(0), &[int(1)], p)), None);
    // 1: not zero at contact, for every ε or for one.
    assert_eq!(broken(|eps, p| eps * p * p + int(1)), Some(VanishesAtContact));
    assert_eq!(broken(|eps, p| eps * p * p - eps), Some(VanishesAtContact));
    assert_eq!(broken(|eps, p| eps * p * p + int(1) - eps / eps.abs().min(int(2))), Some(VanishesAtContact));
    // 2: negative, not increasing in p, not increasing in ε.
    assert_eq!(broken(|eps, p| -eps * p * p), Some(PositiveAndIncreasing));
    assert_eq!(broken(|eps, p| eps * p * (p - int(1))), Some(PositiveAndIncreasing));
    assert_eq!(broken(|eps, p| eps * p / (int(1) + p * p)), Some(PositiveAndIncreasing));
    assert_eq!(broken(|_, p| p * p), Some(PositiveAndIncreasing));
    assert_eq!(broken(|eps, p| p * p / eps), Some(PositiveAndIncreasing));
    assert_eq!(broken(|_, p| p - p), Some(PositiveAndIncreasing));
    // 3: (1 − 1/(2(1 + ε))) p² grows with p and with ε, but not beyond p².
    let bounded = |eps: &Exact, p: &Exact| (int(1) - int(1) / (int(2) * (int(1) + eps))) * p * p;
    assert_eq!(broken(bounded), Some(Unbounded));
    assert_eq!(broken(|eps, p| p * p * (int(2) - int(1) / eps)), Some(Unbounded));
    // W = ε p²/(1 + p²) does not grow beyond all bounds with p, and need not.
    assert_eq!(broken(|eps, p| eps * p * p / (int(1) + p * p)), None);
    // An energy never reached is named too, by the same functional that is a penalty for less.
    let high = Exact::power_of_two(100);
    let broken_at = |energy: &Exact| broken_condition(penalty::functional, &penalties, &penetrations, energy);
    assert_eq!((broken_at(&int(4)), broken_at(&high)), (None, Some(Unbounded)));
    // Note 3: the penetration of the bounded functional is R/(c + 2) for ε → ∞, not 0: at ε it is the root
    // of c p + (2 − 1/(1 + ε)) p = R.
    let (c, r, eps) = (int(4), int(2), Exact::power_of_two(40));
    let p = &r / (&c + int(2) - int(1) / (int(1) + eps));
    assert!((p - r / (c + int(2))).abs() < Exact::power_of_two(-40));
}

/// R = 2⁻²⁵⁰ of W = 1 is lost by cancellation at the initial precision of the search.
#[test]
fn a_root_next_to_grazing_is_found() {
    let r = Exact::power_of_two(-250);
    let s = SpringMass { c: int(1), m: int(1), g: int(1) + &r, l: int(0), h: int(1) };
    let like = int(1).to_mpfr(300);
    let s = s.map(|x| like.round_from_exact(x).unwrap());
    let p = series_penetration(&s, &like, &[]).unwrap();
    assert_eq!(exact(&p), r / int(2));
}
