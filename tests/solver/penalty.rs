//! The penalty for a penetration, and the root of the functional (1.10). The limit (1.13) is in `properties`; its rate,
//! its rounding error, and the conditions on functionals are claims.

use crate::strategies::*;
use spring_mass_contact::chapter::penalty;
use spring_mass_contact::number::Ball;
use spring_mass_contact::solver::{penalty_for_penetration, series_penetration};

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
    the_penalty_for_a_penetration_rounds from any_state;
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
    let (s, eps, higher) = (s.as_ref().map(round), round(eps), higher.iter().map(round).collect::<Vec<_>>());
    let p = series_penetration(&s, &eps, &higher).unwrap();
    let terms: Vec<_> = higher.iter().map(exact).collect();
    let residual = |p: T| penalty::series_residual(&s.as_ref().map(exact), &exact(&eps), &terms, &exact(&p));
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
        let floats = s.as_ref().map(|x| x.to_f64().unwrap());
        assert_eq!(floats.as_ref().map(exact), s, "the parameters are floats");
        assert_eq!(exact(&series_penetration(&floats, &eps, &[e4, e6]).unwrap()), p);
        let bits = |x: &f64| exact(x).to_mpfr(60);
        let found = series_penetration(&floats.as_ref().map(bits), &bits(&eps), &[e4, e6].map(|x| bits(&x)));
        assert_eq!(exact(&found.unwrap()), p);
    });
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
    let refused = series_penetration(&s.as_ref().map(constant), &constant(&1.0), &[]).unwrap_err();
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
