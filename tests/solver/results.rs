//! Quality of results: bounds are narrow, exact zeros are 0, and rejected arguments are named.

use crate::strategies::*;
use spring_mass_contact::chapter::penalty;
use spring_mass_contact::solver::{
    Bounds, advise, best_penalty, exact_augmentation_count, guaranteed_max_augmentations,
    is_convergence_guaranteed, kth_iterate, penalties, penalty_for_penetration, penalty_force_bound,
    required_precision, rounding_floor, series_penetration, sweep,
};

// Bounds.

/// Returns the maximal widths of the bounds of the deflection, the penetration and the contact force, in units of
/// 2 η.
///
/// To first order in η, for the exact answer u = Δ + p or u = m g/c, with |m g| ≤ |R| + c |Δ|. Each operation adds
/// η times its result to what the errors of its operands amount to. So
///
/// - Δ = H − l errs by η |Δ|;
/// - R = m g − c Δ by η (|m g| + 2 c |Δ| + |R|) ≤ η (3 c |Δ| + 2 |R|);
/// - p = R/(c + ε) by that over c + ε, and 2 η |p|, one for the divisor and one for the quotient:
///   η (3 c |Δ|/(c + ε) + 4 |p|);
/// - N = ε R/(c + ε) by η (3 c |Δ| ε/(c + ε) + 5 |N|), one more for the product;
/// - u = (ε Δ + m g)/(c + ε) by η ((2 ε |Δ| + |m g|)/(c + ε) + 3 |u|) ≤ η (5 |Δ| + 4 |p|), the terms of the numerator,
///   their sum, the divisor and the quotient;
/// - u = m g/c by 2 η |u|, and p = l + u − H of it by η (2 |u| + |l + u| + |p|) ≤ η (2 |u| + |H| + 2 |p|).
///
/// An end of an interval lies a rounding, η, and an ulp, at most 2 η, further out.
fn widths(s: &SpringMass<Exact>, penalty: Option<&Exact>, free: bool) -> [Exact; 3] {
    let (gap, r) = (system::gap(s).abs(), system::reaction(s).abs());
    let c = &s.c;
    if free {
        let (u, p) = ((&s.m * &s.g / c).abs(), &r / c);
        [int(5) * &u, int(2) * u + s.h.abs() + int(5) * p, int(0)]
    } else if let Some(eps) = penalty {
        let p = &r / (c + eps);
        let from_gap = int(3) * c * &gap / (c + eps);
        let force = eps * (&from_gap + int(8) * &p);
        [int(8) * gap + int(7) * &p, from_gap + int(7) * p, force]
    } else if r.is_zero() {
        [int(4) * gap, int(0), int(0)]
    } else {
        [int(4) * &gap, int(0), int(3) * c * gap + int(5) * r]
    }
}

/// No bound is wider than the possible rounding errors; there is no force for R = 0 or a separated mass.
///
/// If the force of the penalty method were computed as m g − c u, the error of m g would enter, c/ε times as
/// large for small ε.
fn bounds_are_narrow<T: Float>(case: &Case<T>) {
    let (Case { system, eps, .. }, eta) = (case.exact(), case.eta());
    // What is of higher order. An operation on balls has ten roundings of the radius, which may go up, and enlarges it:
    // (1 + η)¹⁰ (1 + 16 η)(1 + 2 η) < 1 + 32 η, where η is that of radii of no more than 64 bits. No error goes through
    // more than five of these, that where it arises among them. One more is for the values that it is relative to.
    let growth = power(&(int(1) + int(32) * eta.clone().max(Exact::power_of_two(-64))), 6);
    for (plane, method, answer) in case.solutions(3) {
        let penalty = matches!(method, Method::Penalty { .. }).then_some(&eps);
        let free = plane == Plane::Unilateral && answer.state == State::Separated;
        let Bounds { deflection, penetration, contact_force, .. } = &answer.bounds;
        let allowed = widths(&system, penalty, free);
        for (interval, allowed) in [deflection, penetration, contact_force].into_iter().zip(allowed) {
            let [lower, upper] = ends(interval);
            let (width, allowed) = (upper - lower, int(2) * &eta * &growth * allowed);
            assert!(width <= allowed, "{method:?} {plane:?} {interval:?}: {width} > {allowed}");
        }
    }
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

in_every_float! {
    exact_answers_are_enclosed from any_state;
    bounds_are_narrow from any_state;
}

/// A direct result in rationals needs no iteration, and is its own bound.
#[test]
fn direct_rationals_are_their_own_bounds() {
    holds(any_state(WIDE), |case| {
        for (_, method, answer) in case.solutions(0) {
            if matches!(method, Method::Augmented { .. }) {
                continue;
            }
            assert_eq!(answer.outcome, Outcome::Direct);
            assert_eq!((answer.augmentations, &answer.floor), (None, &None));
            assert_eq!(answer.multiplier.is_some(), method == Method::Lagrange);
            let Bounds { deflection, penetration, contact_force, .. } = answer.bounds;
            let point = |x: Exact| Interval { lower: x.clone(), upper: x };
            assert_eq!(deflection, point(answer.deflection));
            assert_eq!(penetration, point(answer.penetration));
            assert_eq!(contact_force, point(answer.contact_force));
        }
    });
}

/// m g = c (a − b) (a + b) = c (a² − b²) = c (H − l), where f32 rounds the products and H − l differently.
#[test]
fn grazing_has_no_force_however_it_is_rounded() {
    let mut rounded = 0;
    for (n, b) in (2001..4001).step_by(100).flat_map(|n| (1001..2001).step_by(50).map(move |b| (n, b))) {
        let a = 64 * n;
        let system = SpringMass { c: 3, m: 3 * (a - b), g: a + b, l: b * b, h: 1 };
        let system = SpringMass { h: int(a) * int(a), ..system.map(int) };
        let floats = system.as_ref().map(|x| x.to_f32().unwrap());
        assert_eq!(floats.as_ref().map(exact), system, "the parameters fit");
        rounded += u32::from(!system::reaction(&floats).is_zero());
        for (_, solve) in planes() {
            let answer = solve(&floats, &Method::Lagrange).unwrap();
            assert_eq!((answer.state, answer.contact_force), (State::Grazing, 0.0));
        }
    }
    assert!(rounded > 100, "{rounded}");
}

// Arguments.

/// A parameter: its name, an accessor, and whether it must be positive.
type Parameter<T> = (&'static str, fn(&mut Case<T>) -> &mut T, bool);

/// The parameters of the system, and the additional ones of methods.
fn parameters<T>() -> ([Parameter<T>; 5], [Parameter<T>; 3]) {
    let system: [Parameter<T>; 5] = [
        ("stiffness", |x| &mut x.system.c, true),
        ("mass", |x| &mut x.system.m, true),
        ("gravity", |x| &mut x.system.g, false),
        ("free length", |x| &mut x.system.l, false),
        ("height", |x| &mut x.system.h, false),
    ];
    let method: [Parameter<T>; 3] = [
        ("penalty", |x| &mut x.eps, true),
        ("tolerance", |x| &mut x.tolerance, true),
        ("initial multiplier", |x| &mut x.start, false),
    ];
    (system, method)
}

/// Every invalid value of every parameter of every method is rejected with the name of the parameter; the
/// first one if there are several. −0 counts as 0 if that is allowed.
fn refusals_name_the_parameter<T: Float>(one: &T) {
    let zero = one.clone() - one;
    let infinity = one * T::infinity();
    let not_a_number = infinity.clone() - &infinity;
    let never = [not_a_number, infinity.clone(), -&infinity];
    let not_positive = [zero.clone(), -&zero, -one, -T::min_subnormal()];
    let [c, m, g, l, h, eps, start, tolerance] = [(); 8].map(|()| one.clone());
    let case = Case { system: SpringMass { c, m, g, l, h }, eps, start, tolerance };
    let (of_the_system, of_a_method) = parameters();
    // Lagrange, penalty and augmented ask for none, one and three of the rest.
    for (index, asked) in [0, 1, 3].into_iter().enumerate() {
        let asked: Vec<_> = of_the_system.iter().chain(&of_a_method[..asked]).collect();
        for (place, (name, parameter, positive)) in asked.iter().enumerate() {
            for value in never.iter().chain(not_positive.iter().filter(|_| *positive)) {
                let mut wrong = case.clone();
                *parameter(&mut wrong) = value.clone();
                refused_as(name, value, &wrong, index, *positive);
                // One that follows is wrong too: the first is named.
                for (_, later, _) in &asked[place + 1..] {
                    let mut several = wrong.clone();
                    *later(&mut several) = never[0].clone();
                    refused_as(name, value, &several, index, *positive);
                }
            }
            for zero in not_positive[..2].iter().filter(|_| !*positive) {
                let mut allowed = case.clone();
                *parameter(&mut allowed) = zero.clone();
                for (_, solve) in planes() {
                    assert!(solve(&allowed.system, &allowed.methods(3)[index]).is_ok(), "{name} = {zero:?}");
                }
            }
        }
    }
}

fn refused_as<T: Float>(name: &str, value: &T, case: &Case<T>, method: usize, positive: bool) {
    let allowed = if positive { "greater than 0 and finite" } else { "finite" };
    for (plane, solve) in planes() {
        let error = solve(&case.system, &case.methods(3)[method]).unwrap_err();
        assert!(matches!(error, SolveError::Invalid { .. }), "{error:?}");
        assert_eq!(error.to_string(), format!("{name} {value:?}: must be {allowed}"), "{plane:?}");
        // A state is refused for what is wrong with a system, and for nothing else.
        let of_the_system = parameters::<T>().0.iter().any(|(parameter, ..)| *parameter == name);
        assert_eq!(State::of(&case.system).err(), of_the_system.then_some(error));
    }
}

#[test]
fn refusals_name_the_parameter_in_f32() {
    refusals_name_the_parameter(&1f32);
}
#[test]
fn refusals_name_the_parameter_in_f64_and_mpfr() {
    refusals_name_the_parameter(&1f64);
    refusals_name_the_parameter(&float(100));
}

/// Non-finite or out-of-range arguments are errors of every function, without a panic.
#[test]
fn every_function_rejects_an_invalid_system() {
    let (good, eta, plane) = (example(), Exact::power_of_two(-53), Plane::Unilateral);
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    fn named<R>(result: Result<R, SolveError>, expected: &str) {
        let Err(SolveError::Invalid { argument, .. }) = result else { panic!("{expected} is not refused") };
        assert_eq!(argument, expected);
    }
    let mut solution = solve(&good, &Method::Lagrange).unwrap();
    for (system, name) in &[
        (SpringMass { c: nan, ..good }, "stiffness"),
        (SpringMass { c: -4.0, ..good }, "stiffness"),
        (SpringMass { m: 0.0, ..good }, "mass"),
        (SpringMass { g: inf, ..good }, "gravity"),
        (SpringMass { l: nan, ..good }, "free length"),
        (SpringMass { h: -inf, ..good }, "height"),
    ] {
        named(is_convergence_guaranteed(system, &4.0, &0.1, &eta), name);
        named(guaranteed_max_augmentations(system, &4.0, &0.1, &eta), name);
        named(exact_augmentation_count(system, &4.0, &0.1, &0.0, plane), name);
        named(rounding_floor(system, plane, &eta), name);
        named(penalty_force_bound(system, &4.0, &eta), name);
        named(best_penalty(system, &eta), name);
        named(penalty_for_penetration(system, &0.1), name);
        named(kth_iterate(system, &4.0, &0.0, 3, plane), name);
        named(series_penetration(system, &4.0, &[]), name);
        named(advise(system, &0.1), name);
        named(solution.residuals(system), name);
        named(sweep(system, [4.0]).next().unwrap(), name);
    }
    for eps in [0.0, -4.0, nan, inf] {
        named(is_convergence_guaranteed(&good, &eps, &0.1, &eta), "penalty");
        named(guaranteed_max_augmentations(&good, &eps, &0.1, &eta), "penalty");
        named(exact_augmentation_count(&good, &eps, &0.1, &0.0, plane), "penalty");
        named(penalty_force_bound(&good, &eps, &eta), "penalty");
        named(kth_iterate(&good, &eps, &0.0, 3, plane), "penalty");
        named(sweep(&good, [eps]).next().unwrap(), "penalty");
    }
    for tolerance in [0.0, -0.1, nan, inf] {
        named(is_convergence_guaranteed(&good, &4.0, &tolerance, &eta), "tolerance");
        named(guaranteed_max_augmentations(&good, &4.0, &tolerance, &eta), "tolerance");
        named(exact_augmentation_count(&good, &4.0, &tolerance, &0.0, plane), "tolerance");
    }
    named(exact_augmentation_count(&good, &4.0, &0.1, &nan, plane), "initial multiplier");
    named(kth_iterate(&good, &4.0, &nan, 3, plane), "initial multiplier");
    let negative = int(-1);
    named(is_convergence_guaranteed(&good, &4.0, &0.1, &negative), "unit roundoff");
    named(guaranteed_max_augmentations(&good, &4.0, &0.1, &negative), "unit roundoff");
    named(rounding_floor(&good, plane, &negative), "unit roundoff");
    named(penalty_force_bound(&good, &4.0, &negative), "unit roundoff");
    named(best_penalty(&good, &negative), "unit roundoff");
    let exactly = good.as_ref().map(exact);
    named(required_precision(&exactly, plane, &int(0)), "tolerance");
    named(required_precision(&SpringMass { c: int(0), ..exactly.clone() }, plane, &int(1)), "stiffness");
    named(exact_augmentation_count(&exactly, &int(-4), &int(1), &int(0), plane), "penalty");
    for (from, to, points, name) in [
        (0, 1, 2, "first penalty"),
        (-1, 1, 2, "first penalty"),
        (1, 1, 2, "last penalty"),
        (2, 1, 2, "last penalty"),
        (1, 2, 1, "number of penalties"),
        (1, 2, 0, "number of penalties"),
        (1, 2, u32::MAX, "number of penalties"),
    ] {
        named(penalties(&int(from), &int(to), points), name);
    }
    solution.contact_force = nan;
    named(solution.residuals(&good), "contact force");
    // Nor do texts of what is not finite.
    assert_eq!(Interval { lower: -inf, upper: inf }.texts(), ["-inf", "inf"]);
}

// Limits of the range.

/// c u = m g = c H, so u = H, the largest f64: no f64 bounds it from above.
#[test]
fn bounds_are_finite() {
    let system = SpringMass { c: 1.0, m: 1.0, g: f64::MAX, l: 0.0, h: f64::MAX };
    assert_eq!(State::of(&system), Ok(State::Grazing));
    let out_of_range = SolveError::OutOfRange { quantity: "deflection" };
    assert_eq!(solve(&system, &Method::Lagrange), Err(out_of_range));
}

/// The deflection from this λ₀ is the smallest f32, so no f32 bounds its error, and no least bound is
/// returned.
#[test]
fn a_floor_is_finite() {
    let system: SpringMass<f32> = SpringMass { c: 1.0, m: 1.0, g: 1.0, l: 0.0, h: -41.0 };
    let solved = |start| solve(&system, &augmentation(f32::MIN_POSITIVE, 1e-6, 99, start));
    assert_eq!(solved(f32::MAX), Err(SolveError::OutOfRange { quantity: "bound of |u − u*|" }));
    // A little less has one.
    let floor = solved(f32::MAX / 2.0).unwrap().floor;
    assert!(floor.is_some_and(|floor| floor.is_finite() && floor > f32::MAX / 8.0));
}

/// Underflow is rejected instead of being treated as 0, and so is overflow of a sum of two stiffnesses.
#[test]
fn lost_products_are_refused() {
    let one = SpringMass { c: 1.0, m: 1.0, g: 1.0, l: 1.0, h: 1.0 };
    for (system, quantity) in [
        (SpringMass { m: 1e-200, g: 1e-200, ..one }, "weight"),
        (SpringMass { c: 1e200, g: 1e-200, ..one }, "deflection"),
        (SpringMass { c: 1e-200, l: 0.0, h: 1e-200, ..one }, "spring force"),
        (SpringMass { c: f64::MAX, ..one }, "total stiffness c + ε"),
    ] {
        for method in [Method::augmented(f64::MAX), Method::Penalty { penalty: f64::MAX }] {
            assert_eq!(solve(&system, &method), Err(SolveError::OutOfRange { quantity }));
        }
    }
    // A separated mass does not meet the second spring.
    let separated = SpringMass { c: 1e308, h: 1.5, ..one };
    assert!(solve(&separated, &Method::Penalty { penalty: f64::MAX }).is_ok());
}

/// The first multiplier would be ε p, which exceeds the range of f32.
#[test]
fn a_multiplier_out_of_range_is_refused() {
    let system =
        SpringMass { c: 3.0137273e-4_f32, m: 2.4460823e29, g: 0.3403485, l: 0.70053273, h: 58010.57 };
    let solved = solve(&system, &augmentation(f32::MAX, 1.0363584e-4, 54, 0.0));
    assert_eq!(solved, Err(SolveError::OutOfRange { quantity: "multiplier" }));
}

/// ε R = 4.81·10³⁰⁸ overflows, but N = ε R / (c + ε) does not: it is 4.81, with the negligible relative
/// correction 100/10³⁰⁸.
#[test]
fn a_penalty_may_be_as_large_as_a_float() {
    let system = default_system().map(|x| x.to_f64().unwrap());
    for (_, solve) in planes() {
        let force = |penalty| solve(&system, &Method::Penalty { penalty }).unwrap().bounds.contact_force;
        for penalty in [1e308, f64::MAX / 2.0] {
            let exactly =
                penalty::contact_force_at_equilibrium(&system.as_ref().map(exact), &exact(&penalty));
            assert!(encloses(&force(penalty), &exactly));
            // As narrow as for a penalty that overflows nothing.
            assert!(force(penalty).width() <= 2.0 * force(1e300).width());
        }
    }
    // Soft beside the spring, where R − c p would cancel; and small numbers, where ε R underflows.
    let strong = SpringMass { c: 1e20, m: 1e300, g: 1.0, l: 1.0, h: 1.0 };
    let light = SpringMass { c: 1e-269, m: 1e-269, g: 9.81, l: 1.0, h: 1.05 };
    for (system, penalty) in [(strong, 1e9), (light, 1e-272), (light, 1e-269), (light, 1e-265)] {
        let force = solve(&system, &Method::Penalty { penalty }).unwrap().bounds.contact_force;
        let exactly = penalty::contact_force_at_equilibrium(&system.as_ref().map(exact), &exact(&penalty));
        assert!(encloses(&force, &exactly) && force.width() <= 1e-14 * force.upper, "{penalty}: {force}");
    }
}

/// Rationals grow with every step: with 50 000 decimals, by 166 000 digits a step.
#[test]
fn an_augmentation_of_endless_digits_is_refused() {
    let (system, soft) = (default_system(), q("1e-50000"));
    let refused = solve(&system, &Method::augmented(soft.clone())).unwrap_err();
    let said = "multiplier: more than 2097152 binary digits; use MPFR (mpfr:BITS), a larger penalty or tolerance, \
                or fewer augmentations";
    assert_eq!(refused.to_string(), said);
    // Constants of MPFR are rationals, too.
    let constant = |x: &Exact| Mpfr::constant(x.clone().into());
    let refused = solve(&system.as_ref().map(constant), &Method::augmented(constant(&soft))).unwrap_err();
    assert!(matches!(refused, SolveError::TooLong { .. }), "{refused}");
    // A thousand steps of everyday numbers are none too many.
    let answer = solve(&system, &Method::augmented(q("0.001"))).unwrap();
    assert_eq!(answer.outcome, Outcome::IterationLimit);
}

// Floors and precisions, worked out by hand.

fn floor(system: &SpringMass<Exact>, eta: &Exact) -> Option<Exact> {
    rounding_floor(system, Plane::Unilateral, eta).unwrap()
}

/// With c = ε = 4, Δ = 2, |R| = 2, |H| = 3 the drift is 20 F = 20 η (3 + 2 + 1/2), so guaranteed tolerances
/// exceed 110 η + η (3 + 8 tol); and 64 · 8 ≤ 4 (2ᵖ + 1) from p = 7 on.
#[test]
fn guaranteed_tolerances_begin_at_the_drift() {
    let pulls = SpringMass { c: 4.0, m: 1.0, g: -10.0, l: -1.0, h: -3.0 };
    for system in [example(), pulls].map(|s| s.as_ref().map(exact)) {
        let reaches = |tolerance: &Exact, eta: &Exact| {
            is_convergence_guaranteed(&system, &int(4), tolerance, eta).unwrap()
        };
        for bits in [24, 53, 200] {
            let eta = Exact::power_of_two(-bits);
            let drift = int(113) * &eta / (int(1) - int(8) * &eta);
            let more = &drift * (int(1) + &eta);
            assert_eq!([reaches(&drift, &eta), reaches(&more, &eta)], [false, true], "{bits} bits");
        }
        assert_eq!([6, 7].map(|bits| reaches(&int(1000), &Exact::power_of_two(-bits))), [false, true]);
        assert!(reaches(&Exact::power_of_two(-1000), &int(0)));
    }
}

/// With l = 0 and H = 7 the floor is (20 η · 14 + 7 η)/(1 − 8 η): 41/8 with 6 bits, the smallest possible
/// precision, and 287/120 with 7. A tolerance equal to the floor is not above it.
#[test]
fn a_tolerance_is_above_the_floor() {
    let system = SpringMass { c: 1, m: 1, g: 8, l: 0, h: 7 }.map(int);
    assert_eq!([floor(&system, &q("1/64")), floor(&system, &q("1/63"))], [Some(q("41/8")), None]);
    let bits = |tolerance| required_precision(&system, Plane::Unilateral, &q(tolerance)).unwrap();
    assert_eq!([bits("41/8"), bits("6")], [Some(7), Some(6)]);
}

/// R = −1 and H = l = 2^400000. The mass is certainly separated if |R|/c = 2^200000 > 21 η H/(1 − 8 η) + 10 η
/// m |g|/c, which holds for η ≤ 2^−200005; the floor, 5 η m |g|/c = 5/32, is then below 1. With the floor of
/// contact, twice as many bits would be required.
#[test]
fn the_required_precision_is_found_if_it_is_far_below_its_estimate() {
    let [soft, long] = [-200_000, 400_000].map(Exact::power_of_two);
    let system = SpringMass { c: soft, m: int(1), g: int(-1), l: long.clone(), h: long };
    assert_eq!(required_precision(&system, Plane::Unilateral, &int(1)), Ok(Some(200_005)));
}

/// u = m g/c = 1 and l = 0: 5 η from the plane. The floor of contact is 41 η H/(1 − 8 η); it is added if H −
/// 1 does not exceed it and 10 η.
#[test]
fn the_floor_near_grazing_covers_both_states() {
    let eta = Exact::power_of_two(-10);
    let touching = |h: &Exact| int(41) * &eta * h / (int(1) - int(8) * &eta);
    let alone = int(5) * &eta;
    let near = (int(1) + int(10) * &eta) / (int(1) - touching(&int(1)));
    assert_eq!(&near - int(1), touching(&near) + int(2) * &alone);
    let at = |h: Exact| floor(&SpringMass { c: int(1), m: int(1), g: int(1), l: int(0), h }, &eta).unwrap();
    assert_eq!(at(near.clone()), touching(&near) + &alone);
    assert_eq!([at(near + Exact::power_of_two(-99)), at(int(3))], [alone.clone(), alone]);
}
