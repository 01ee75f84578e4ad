//! The penalty method: the limit (1.13) and its rate, the effect of a large ε in floats, the functionals
//! (1.10) and their conditions. What is stationary or minimal at (1.13), and the functionals of note 3, are claims.

use crate::strategies::*;
use spring_mass_contact::chapter::{contact, penalty, rounding, structure};
use spring_mass_contact::number::Ball;
use spring_mass_contact::solver::{penalty_for_penetration, series_penetration};

// (1.13) in rationals.

/// (c + ε)(u − Δ) = R for every ε, so u → Δ; both forms of (1.13) are its root.
#[test]
fn the_rate_is_exact() {
    holds(any_state(WIDE), |case| {
        let Case { system: s, eps, .. } = case;
        let (u, p, r) = (penalty::deflection(s, eps), penalty::penetration(s, eps), case.reaction());
        let (n, total) = (penalty::contact_force_at_equilibrium(s, eps), &s.c + eps);
        assert_eq!(&total * (&u - &s.h + &s.l), r);
        assert_eq!(penalty::deflection_divided(s, eps), u);
        assert_eq!(penalty::residual(s, eps, &u), int(0));
        assert_eq!(p, contact::penetration(s, &u));
        assert_eq!(n, penalty::contact_force(s, eps, &u));
        assert_eq!(penalty::total_stiffness(s, eps), total);
        // (R − N)/R = c/(c + ε), multiplied out.
        assert_eq!((&r - n) * total, &s.c * r);
    });
}

/// With unilateral contact the plane has no effect on a separated mass.
#[test]
fn the_plane_of_solve_is_one_sided() {
    holds(any_state(WIDE), |case| {
        let Case { system: s, eps, .. } = case;
        let (one, two) = (solve(s, &case.penalty()).unwrap(), solve_bilateral(s, &case.penalty()).unwrap());
        let free = case.reaction() < int(0);
        let expected = if free { structure::deflection(s) } else { penalty::deflection(s, eps) };
        assert_eq!(penalty::unilateral_deflection(s, eps), expected);
        assert_eq!((one.deflection, &two.deflection), (expected, &penalty::deflection(s, eps)));
        assert_eq!(two.contact_force, penalty::contact_force_at_equilibrium(s, eps));
    });
}

/// Remark 1.3.2: the smallest ε is exact; there is none if every ε > 0 suffices.
#[test]
fn the_penalty_for_a_penetration() {
    holds((any_state(WIDE), 1..100i32), |(case, less)| {
        let Case { system: s, tolerance: tol, .. } = case;
        let needed = case.reaction() > &s.c * tol;
        let found = penalty_for_penetration(s, tol).unwrap();
        assert_eq!(found.is_some(), needed);
        if let Some(eps) = found {
            let at = |part: Exact| penalty::penetration(s, &(&eps * part));
            let part = int(*less) / int(100);
            assert!(eps > int(0) && at(int(1)) == *tol);
            assert!(at(part.clone()) > *tol && at(int(1) / part) < *tol);
        } else {
            assert!(penalty::penetration(s, &case.eps) < *tol);
        }
    });
}

// (1.13) in floats.

/// Returns the system or, for R < 0, its mirror image, in which floats differ only in their signs: the laws
/// of rounding are stated for R > 0.
fn pushed(s: &SpringMass<Exact>) -> SpringMass<Exact> {
    let SpringMass { c, m, g, l, h } = s.clone();
    if system::reaction(s) < int(0) { SpringMass { c, m, g: -g, l: -l, h: -h } } else { s.clone() }
}

/// û − Δ is R/(c + ε) and the rounding error of six operations.
fn the_rate_until_rounding<T: Float>(floats: &Case<T>) {
    let Case { system: s, eps, .. } = &floats.exact();
    let bound = rounding::deflection_error(&pushed(s), eps, &floats.precision());
    let off = exact(&penalty::deflection(&floats.system, &floats.eps)) - system::gap(s);
    assert!((off - penalty::penetration(s, eps)).abs() <= bound);
}

/// The error of N̂ = ε p̂ at û is the rounding error of nine operations, and c p in addition relative to R.
fn the_precision_law<T: Float>(floats: &Case<T>) {
    let case = floats.exact();
    let Case { system: s, eps, .. } = &case;
    let bound = rounding::penalty_force_error(&pushed(s), eps, &floats.precision());
    let u = penalty::deflection(&floats.system, &floats.eps);
    let n = exact(&penalty::contact_force(&floats.system, &floats.eps, &u));
    assert!((&n - penalty::contact_force_at_equilibrium(s, eps)).abs() <= bound);
    let short = &s.c * penalty::penetration(s, eps).abs();
    assert!((n - case.reaction()).abs() <= short + bound);
}

/// In floats the computed penalty has the rounding error enclosed by balls, and meets the tolerance.
fn the_penalty_for_a_penetration_rounds<T: Float>(floats: &Case<T>) {
    let case = floats.exact();
    let balls = floats.map(|x| Ball::point(x.clone()));
    let ball = penalty::penalty_for(&balls.system, &balls.tolerance);
    let least = penalty::penalty_for(&case.system, &case.tolerance);
    assert!(ball.contains(&least));
    let answer = penalty_for_penetration(&floats.system, &floats.tolerance).unwrap();
    let found = answer.as_ref().map_or_else(Exact::zero, exact);
    assert!((found - least.positive_part()).abs() <= exact(ball.radius()));
    assert!(answer.is_none() || case.reaction() > int(0));
}

in_every_float! {
    the_rate_until_rounding from any_state;
    the_precision_law from any_state;
    the_penalty_for_a_penetration_rounds from any_state;
}

/// Returns the default system in f64.
fn default_floats() -> SpringMass<f64> {
    default_system().map(|x| x.to_f64().unwrap())
}

/// The log-log slope is −1 for ε ≫ c until rounding dominates; a larger ε does not reduce the error further.
#[test]
fn slope_minus_one_until_rounding_takes_over() {
    let s = default_floats();
    let error = |n: i32| {
        let off = exact(&penalty::deflection(&s, &10f64.powi(n))) - system::gap(&s.map(exact));
        off.abs().to_f64().unwrap_or(0.0)
    };
    // R = 4.81 N and Δ = 0.05 m: rounding, 5ηΔ = 2.8e-17, is below 1/1000 of R/ε up to ε = 1e14.
    for n in 5..14 {
        let slope = (error(n + 1) / error(n)).log10();
        // 1/(c + ε) in place of 1/ε bends it by c/ε · 0.9/ln 10 at most, 1/1000 rounding by 1/1000/ln 10 twice.
        assert!((slope + 1.0).abs() < 0.4 * 1e2 / 10f64.powi(n) + 1e-3, "{slope} at 1e{n}");
    }
    for n in 18..30 {
        assert!(error(n) < 3e-17, "at 1e{n}");
    }
}

/// ε* = √(c R/(η L)): N̂ = ε p̂ attains at most half the digits; m g − c û continues to improve.
#[test]
fn half_the_digits_of_the_force_are_lost() {
    let s = default_floats();
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
fn coefficients(span: i32) -> BoxedStrategy<(Exact, Vec<Exact>)> {
    let coefficient = || prop_oneof![1 => Just(Exact::zero()), 3 => positive(span)].boxed();
    prop_oneof![
        (positive(span), prop::collection::vec(coefficient(), 0..4)),
        (coefficient(), prop::collection::vec(positive(span), 1..4)),
    ]
    .boxed()
}

/// The exact residual changes sign between the neighbours of the result, so the result is the nearest float.
fn root_is_the_best<T: Float>(s: &SpringMass<Exact>, (eps, higher): &(Exact, Vec<Exact>), like: &T) {
    let round = |x: &Exact| like.round_from_exact(x).unwrap();
    let (s, eps, higher) = (s.map(round), round(eps), higher.iter().map(round).collect::<Vec<_>>());
    let p = series_penetration(&s, &eps, &higher).unwrap();
    let terms: Vec<_> = higher.iter().map(exact).collect();
    let residual = |p: T| penalty::series_residual(&s.map(exact), &exact(&eps), &terms, &exact(&p));
    let state = State::of(&s).unwrap();
    assert_eq!(p.is_zero(), state == State::Grazing, "{p:?}");
    if !p.is_zero() {
        assert_eq!(p > T::zero(), state == State::Contact, "{p:?}");
        assert!(residual(p.clone().next_down()) < int(0), "{p:?}");
        assert!(residual(p.clone().next_up()) > int(0), "{p:?}");
    }
}

#[test]
fn the_root_of_a_series_is_the_nearest_float() {
    holds((any_state(4), coefficients(8)), |(case, terms)| root_is_the_best(&case.system, terms, &1f32));
    holds((any_state(WIDE), coefficients(WIDE)), |(case, terms)| {
        root_is_the_best(&case.system, terms, &1f64);
    });
    holds((any_state(WIDE), coefficients(WIDE), 2u32..400), |(case, terms, bits)| {
        root_is_the_best(&case.system, terms, &float(*bits));
    });
}

/// The root is chosen first, and the system is constructed from it: c p + ε p + 4 ε₄ p³ + 6 ε₆ p⁵ = R.
///
/// 31, 7 and 7⁵ · 15 have 5, 3 and 18 bits and the exponents differ by at most 24: g has 53 bits.
#[test]
fn constructed_roots_are_found() {
    let root = (1..8i32, -2..=2i32, any::<bool>());
    let coefficients = prop::array::uniform4(0..16i32);
    holds((root, coefficients, (1..32i32, -31..32i32)), |((n, e, negative), k, (c, gap))| {
        let p = int(if *negative { -n } else { *n }) * Exact::power_of_two(*e);
        let [eps, e4, e6, l] = k.map(int);
        let eps = if k[..3] == [0; 3] { int(1) } else { eps };
        let w = &eps * &p + int(4) * &e4 * power(&p, 3) + int(6) * &e6 * power(&p, 5);
        let (c, gap) = (int(*c), int(*gap));
        let g = &c * &p + w + &c * &gap;
        let s = SpringMass { c, m: int(1), g, h: &l + gap, l };
        let [eps, e4, e6] = [eps, e4, e6].map(|x| x.to_f64().unwrap());
        let floats = s.map(|x| x.to_f64().unwrap());
        assert_eq!(floats.map(exact), s, "the parameters are floats");
        assert_eq!(exact(&series_penetration(&floats, &eps, &[e4, e6]).unwrap()), p);
        let bits = |x: &f64| exact(x).to_mpfr(60);
        let found = series_penetration(&floats.map(bits), &bits(&eps), &[e4, e6].map(|x| bits(&x)));
        assert_eq!(exact(&found.unwrap()), p);
    });
}

/// (1.10) with ε alone is (1.12): the same root as (1.13), rounded once.
#[test]
fn a_series_of_one_term_is_the_penalty_method() {
    holds(not_grazing(WIDE), |case| {
        let floats = case.rounded(&1f64);
        let Case { system: s, eps, .. } = floats.exact();
        let p = penalty::penetration(&s, &eps);
        let found = exact(&series_penetration(&floats.system, &floats.eps, &[]).unwrap());
        // No float is nearer than half the distance of neighbours, η relative to the smaller of the two.
        assert!((found - &p).abs() <= int(2) * floats.eta() * p.abs());
    });
}

/// A quartic alone: 4 ε₄ p³ = R − c p, so p³ ε₄ → R/4 and the log-log slope is −1/3.
#[test]
fn a_quartic_alone_has_slope_minus_a_third() {
    let s = default_system().map(|x| x.to_mpfr(200));
    let r = system::reaction(&s.map(exact));
    let root = |n: i32| {
        let e4 = Exact::power_of_two(n).to_mpfr(200);
        exact(&series_penetration(&s, &int(0).to_mpfr(200), &[e4]).unwrap())
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

/// R = 2⁻²⁵⁰ of W = 1 is lost by cancellation at the initial precision of the search.
#[test]
fn a_root_next_to_grazing_is_found() {
    let r = Exact::power_of_two(-250);
    let s = SpringMass { c: int(1), m: int(1), g: int(1) + &r, l: int(0), h: int(1) };
    let p = series_penetration(&s.map(|x| x.to_mpfr(300)), &float(300), &[]).unwrap();
    assert_eq!(exact(&p), r / int(2));
}

/// R = 2¹⁶⁰ exceeds the range of f32, but 2¹⁶⁰/(2¹²⁶ + 2¹²⁶) does not.
#[test]
fn a_root_is_found_where_the_reaction_is_out_of_range() {
    let [c, m, root] = [126, 80, 33].map(|n| 2f32.powi(n));
    let system = SpringMass { c, m, g: m, l: 1.0, h: 1.0 };
    assert_eq!(series_penetration(&system, &c, &[]), Ok(root));
    let soft = SpringMass { c: 1.0, ..system };
    let out_of_range = SolveError::OutOfRange { quantity: "penetration" };
    assert_eq!(series_penetration(&soft, &1.0, &[]), Err(out_of_range));
}

/// Errors of the (1.10) solver name the argument; those of a parameter of the system are in `results`.
#[test]
fn series_errors_name_the_argument() {
    let s = example();
    for (eps, higher, name) in
        [(-1.0, &[][..], "penalty"), (1.0, &[1.0, -1.0], "higher penalty"), (0.0, &[0.0, 0.0], "penalties")]
    {
        match series_penetration(&s, &eps, higher) {
            Err(SolveError::Invalid { argument, .. }) => assert_eq!(argument, name),
            other => panic!("{other:?}"),
        }
    }
    let constant = |x: &f64| Mpfr::constant(exact(x).into());
    let refused = series_penetration(&s.map(constant), &constant(&1.0), &[]).unwrap_err();
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

// The three conditions on a penalty functional W_ε(p), §1.3.2 before (1.10), the third with the correction of
// note 3: 1. W vanishes at contact; 2. it increases with p and with ε; 3. it is unbounded in ε at every p > 0.

fn increase<const N: usize>(values: [Exact; N]) -> bool {
    values.is_sorted_by(|a, b| a < b)
}

/// They hold for every series. W ≤ R²/(2c) at a minimum of Π + W, so where W exceeds this the root is below.
#[test]
fn every_series_meets_the_conditions() {
    holds((coefficients(8), in_contact(8), positive(8)), |((eps, higher), case, p)| {
        let (s, r, twice) = (&case.system, case.reaction(), p * int(2));
        let energy = &r * &r / (int(2) * &s.c);
        // W scales with ε as a whole; the last ε lifts it beyond the energy at p.
        let w = |scale: &Exact, p: &Exact| scale * penalty::series(eps, higher, p);
        let last = &energy / w(&int(1), p) + int(1);
        let penalties = ["1/4", "1/2", "1"].map(|part| &last * q(part));
        for eps in &penalties {
            assert_eq!(w(eps, &int(0)), int(0));
            assert!(increase([&int(0), p, &twice].map(|p| w(eps, p))));
        }
        for p in [p, &twice] {
            assert!(increase(penalties.each_ref().map(|eps| w(eps, p))));
            assert!(w(&last, p) > energy);
        }
        let scaled: Vec<_> = higher.iter().map(|e| e * &last).collect();
        assert!(penalty::series_residual(s, &(eps * &last), &scaled, p) > int(0));
    });
}
