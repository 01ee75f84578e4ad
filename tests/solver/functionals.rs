//! User-defined penalty functionals: the bounds compared with exact signs and closed forms, and violated
//! conditions.

use crate::strategies::*;
use spring_mass_contact::chapter::{beyond, contact, penalty};
use spring_mass_contact::number::{Dual, Exponential, Field};
use spring_mass_contact::solver::{
    DualEnclosure, FunctionalCondition, FunctionalError, penalty_for_functional, solve_functional,
};
use std::array;
use std::cell::Cell;

/// W = ε |p|³ / 3.
fn cubic<T: PositivePart>(eps: &T, p: &T) -> T {
    eps * p * p * p.abs() / T::int(3)
}

/// W = ε ⟨p − d⟩² / 2: a plane with a soft layer of thickness d.
fn layered<T: PositivePart>(eps: &T, soft: &T, d: &T, p: &T) -> T {
    penalty::functional(soft, p) + penalty::functional(eps, &(p - d).positive_part())
}

/// W = ε ⟨p⟩ + ε₂ p²/2 with a kink at 0.
fn kinked<T: PositivePart>(eps: &T, second: &T, p: &T) -> T {
    beyond::exact_penalty(eps, p) + penalty::functional(second, p)
}

/// ⟨p − 1/n⟩: a kink at 1/n.
fn beyond_part<T: PositivePart>(p: &T, n: i32) -> T {
    (p - T::one() / T::int(n)).positive_part()
}

/// c p + W′(p) − R in rationals.
fn residual(s: &SpringMass<Exact>, w: impl Fn(&Dual<Exact>) -> Dual<Exact>, p: &Exact) -> Exact {
    &s.c * p + w(&Dual::variable(p.clone())).derivative - system::reaction(s)
}

fn constant(x: &Exact) -> Dual<Exact> {
    Dual::constant(x.clone())
}

/// Asserts that the root of an increasing residual is within the bounds, N = R − c p within those of the
/// force, and u as accurate as guaranteed.
fn bounds_hold<T: Scalar + ToExact>(
    s: &SpringMass<Exact>,
    answer: &Solution<T>,
    tolerance: &T,
    w: impl Fn(&Dual<Exact>) -> Dual<Exact>,
) {
    let bounds = &answer.bounds;
    let [lower, upper] = ends(&bounds.penetration);
    // Where a kink at the plane holds the mass, the residual is positive already at 0.
    let held = lower.is_zero() && residual(s, &w, &lower) >= int(0);
    assert!(held || residual(s, &w, &lower) <= int(0), "{answer:?}");
    assert!(lower >= int(0) && residual(s, &w, &upper) >= int(0), "{answer:?}");
    let (gap, r) = (system::gap(s), system::reaction(s));
    let [lowest, highest] = ends(&bounds.deflection);
    assert!(lowest <= &gap + &lower && &gap + &upper <= highest, "{answer:?}");
    let [least, most] = ends(&bounds.contact_force);
    assert!(least <= (&r - &s.c * &upper).positive_part() && r - &s.c * &lower <= most, "{answer:?}");
    let promised = match (answer.outcome, &answer.floor) {
        (Outcome::Converged, None) => tolerance,
        (Outcome::Stagnated, Some(floor)) => floor,
        (Outcome::Direct, None) if upper.is_zero() => return,
        (other, _) => panic!("{other}"),
    };
    let off = |p: Exact| (exact(&answer.deflection) - &gap - p).abs();
    assert!(off(lower) <= exact(promised) && off(upper) <= exact(promised), "{answer:?}");
}

/// Functionals in every float: a cubic, a layer with a kink inside, a kink at the plane, (1.10).
fn bounds_contain_the_root<T: Float>(floats: &Case<T>)
where
    DualEnclosure<T>: PositivePart,
{
    let Case { system: s, eps, .. } = &floats.exact();
    if State::of(s) != Ok(State::Contact) {
        return;
    }
    let Case { system, tolerance, .. } = floats;
    // As thick as the mass would sink in with the soft layer alone, or half of that.
    let depth = floats.round(&(penalty::penetration(s, eps) / int(2)));
    let parameters = [floats.eps.clone(), depth, T::int(7) * &floats.eps];
    let [eps, d, stiff] = parameters.each_ref().map(|x| constant(&exact(x)));

    let answer = solve_functional(system, &parameters, tolerance, |[eps, ..], p| cubic(eps, p)).unwrap();
    bounds_hold(s, &answer, tolerance, |p| cubic(&eps, p));
    let layer = |[eps, d, stiff]: &[DualEnclosure<T>; 3], p: &DualEnclosure<T>| layered(stiff, eps, d, p);
    let answer = solve_functional(system, &parameters, tolerance, layer).unwrap();
    bounds_hold(s, &answer, tolerance, |p| layered(&stiff, &eps, &d, p));
    let quartic = |[eps, _, e4]: &[DualEnclosure<T>; 3], p: &DualEnclosure<T>| {
        penalty::series(eps, std::slice::from_ref(e4), p)
    };
    let answer = solve_functional(system, &parameters, tolerance, quartic).unwrap();
    bounds_hold(s, &answer, tolerance, |p| penalty::series(&eps, std::slice::from_ref(&stiff), p));

    // A kink that holds the mass, and one that does not: ε is a force here.
    let force = floats.round(&(system::reaction(s) / int(2)));
    for times in [1, 3] {
        let parameters = [T::int(times) * &force, floats.eps.clone()];
        let [force, second] = parameters.each_ref().map(|x| constant(&exact(x)));
        let kink = |[eps, second]: &[DualEnclosure<T>; 2], p: &DualEnclosure<T>| kinked(eps, second, p);
        let answer = solve_functional(system, &parameters, tolerance, kink).unwrap();
        bounds_hold(s, &answer, tolerance, |p| kinked(&force, &second, p));
    }
}

/// ε p²/2 is (1.13): the closed form is within the bounds, and they are not much wider than its rounding
/// error.
fn the_parabola_is_the_penalty_method<T: Float>(floats: &Case<T>) {
    let case = floats.exact();
    let Case { system: s, eps, tolerance, .. } = &case;
    let parabola = |[eps]: &[_; 1], p: &_| penalty::functional(eps, p);
    let parameters = array::from_ref(&floats.eps);
    let found = solve_functional(&floats.system, parameters, &floats.tolerance, parabola).unwrap();
    assert_eq!(found.state, solve(&floats.system, &floats.penalty()).unwrap().state);
    if case.reaction() <= int(0) {
        assert!(encloses(&found.bounds.penetration, &contact::penetration(s, &contact::deflection(s))));
        assert_eq!(found.bounds, solve(&floats.system, &Method::Lagrange).unwrap().bounds);
        assert!(found.contact_force.is_zero() && found.multiplier.is_none());
        return;
    }
    let p = penalty::penetration(s, eps);
    let [lower, upper] = ends(&found.bounds.penetration);
    assert!(lower <= p && p <= upper);
    // c p, W′ and R are off by less than 16 η (c p + ε p + |m g| + |c l| + |c H|) together, as enclosed. That is made
    // up for within as much over c + ε to either side, at a number that is tried within twice that.
    let sizes = (&s.c + eps) * &p + (&s.m * &s.g).abs() + (&s.c * &s.l).abs() + (&s.c * &s.h).abs();
    let widest = int(128) * floats.eta() * sizes / (&s.c + eps);
    assert!(upper - lower <= widest.max(tolerance.clone()), "{found:?}");
}

in_every_float! {
    bounds_contain_the_root from in_contact;
    the_parabola_is_the_penalty_method from any_state;
}

/// R = 1/2 without lengths: in f32 the numbers beside the root have signs that rounding leaves open, and the number
/// before the first certain one is no bound.
#[test]
fn a_bound_is_certain() {
    let [c, m, g, l, h, eps, start] = ["1", "1", "1/2", "0", "0", "128", "0"].map(q);
    let system = SpringMass { c, m, g, l, h };
    let case = Case { system, eps, start, tolerance: Exact::power_of_two(-31) };
    bounds_contain_the_root(&case.rounded(&1f32));
}

/// In rationals every tolerance is met, and a parabola needs none.
#[test]
fn rationals_meet_every_tolerance() {
    holds((in_contact(8), 1..200i32), |(case, digits)| {
        let Case { system: s, eps, .. } = case;
        let (tolerance, first) = (Exact::power_of_two(-digits), array::from_ref(eps));
        let found = solve_functional(s, first, &tolerance, |[eps], p| penalty::functional(eps, p)).unwrap();
        assert_eq!((found.penetration, found.outcome), (penalty::penetration(s, eps), Outcome::Converged));
        assert_eq!(found.bounds.penetration.lower, found.bounds.penetration.upper);
        let found = solve_functional(s, first, &tolerance, |[eps], p| cubic(eps, p)).unwrap();
        assert_eq!(found.outcome, Outcome::Converged);
        assert!(found.bounds.penetration.width() <= tolerance);
        assert_eq!(found.contact_force, &s.m * &s.g - &s.c * &found.deflection);
        bounds_hold(s, &found, &tolerance, |p| cubic(&constant(eps), p));
    });
}

/// Condition 3: with the penalty that is found the exact root is below the tolerance.
#[test]
fn the_found_penalty_meets_the_tolerance() {
    holds((any_state(8), 1..100i32), |(case, percent)| {
        let Case { system: s, eps, .. } = case;
        let free = (case.reaction() / &s.c).positive_part();
        let tolerance = free * int(*percent) / int(100) + Exact::power_of_two(-30);
        let first = array::from_ref(eps);
        let found = penalty_for_functional(s, first, &tolerance, |[eps], p| cubic(eps, p)).unwrap();
        assert!(found >= *eps);
        if State::of(s) == Ok(State::Contact) {
            assert!(residual(s, |p| cubic(&constant(&found), p), &tolerance) > int(0));
        } else {
            assert_eq!(found, *eps);
        }
    });
}

/// W = ε (eᵖ − 1 − p): a plane with exponentially increasing stiffness.
fn exponential<T: Exponential>(eps: &T, p: &T) -> T {
    eps * (p.exp() - T::one() - p)
}

/// A functional without rational values. With MPFR's directed rounding of eᵖ, independent of the library, the
/// residual has different signs at the two bounds.
#[test]
fn an_exponential_wall() {
    use rug::{Float, float::Round, ops::AddAssignRound};
    for (eps, tolerance) in [(1.0, 1e-300), (1e6, 1e-300), (1e-6, 1e-3)] {
        let answer =
            solve_functional(&example(), &[eps], &tolerance, |[eps], p| exponential(eps, p)).unwrap();
        let sign = |p: f64, round: Round| {
            // 4 p + ε (eᵖ − 1) − 2, rounded one way: 200 bits hold all but eᵖ exactly.
            let mut e = Float::with_val_round(200, Float::with_val(53, p).exp_ref(), round).0;
            e.add_assign_round(-1, round);
            let sum = Float::with_val_round(200, e * eps, round).0 + 4.0 * p - 2.0f64;
            sum.cmp0().unwrap()
        };
        let p = &answer.bounds.penetration;
        assert!(sign(p.lower, Round::Up).is_lt() && sign(p.upper, Round::Down).is_gt(), "{answer:?}");
        // Slope 4 + ε and ten roundings of sizes up to 8 + 2 ε: within 100 η.
        assert!(p.upper - p.lower < 1e-14 || p.upper - p.lower <= tolerance, "{answer:?}");
    }
    let system = example().as_ref().map(|x| exact(x).to_mpfr(400));
    let tolerance = Exact::power_of_two(-380).to_mpfr(400);
    let answer = solve_functional(&system, &[float(400)], &tolerance, |[eps], p| exponential(eps, p));
    assert_eq!(answer.unwrap().outcome, Outcome::Converged);
}

/// High precision needs few values of W if it is smooth: the digits double with each step.
#[test]
fn digits_double() {
    let (s, tolerance, count) = (example().as_ref().map(exact), Exact::power_of_two(-20_000), Cell::new(0));
    let counted = |[eps]: &[DualEnclosure<Exact>; 1], p: &DualEnclosure<Exact>| {
        count.set(count.get() + 1);
        cubic(eps, p)
    };
    let found = solve_functional(&s, &[int(8)], &tolerance, counted).unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
    // Sixteen at the sixteenths, two in each of 15 steps, and what it takes to come near and to end.
    assert!(count.get() < 100, "{count:?}");
}

/// The search also terminates for functionals that are not smooth: a jump in MPFR gains one digit in each of
/// ten thousand steps. The bounds still hold, and no floor is reported.
#[test]
fn ten_thousand_steps_are_enough() {
    let s = example().as_ref().map(|x| exact(x).to_mpfr(11_000));
    let [force, tolerance] = [int(10), Exact::power_of_two(-10_900)].map(|x| x.to_mpfr(11_000));
    let found = solve_functional(&s, &[force], &tolerance, |[force], p| force * beyond_part(p, 7)).unwrap();
    assert_eq!((found.outcome, &found.floor), (Outcome::IterationLimit, &None));
    assert!(encloses(&found.bounds.penetration, &q("1/7")));
    let [lower, upper] = ends(&found.bounds.penetration);
    assert!(upper - lower < Exact::power_of_two(-5000));
}

/// A functional that is undefined beyond a point: below it the force is 0, so the root is beyond, and R/c
/// bounds it.
#[test]
fn an_undefined_value_ends_the_search() {
    let huge = Dual::constant(f64::MAX.enclose());
    for n in 3..30 {
        let wall = |_: &[_; 0], p: &DualEnclosure<f64>| beyond_part(p, n) * &huge * &huge;
        let found = solve_functional(&example(), &[], &1e-9, wall).unwrap();
        let p = &found.bounds.penetration;
        assert_eq!(found.outcome, Outcome::Stagnated);
        assert!(p.upper >= 0.5 && p.upper < 0.5 + 1e-14, "{found:?}");
        assert!((p.lower * f64::from(n) - 1.0).abs() < 1e-14, "{found:?}");
    }
}

/// The proved bound is less than the tolerance, and not equal: a floor equal to the tolerance remains a
/// floor.
#[test]
fn a_tolerance_that_is_the_floor_is_not_met() {
    let floor = |eps: i32, tolerance: f64| {
        let eps = f64::from(eps);
        solve_functional(&example(), &[eps], &tolerance, |[eps], p| cubic(eps, p)).unwrap().floor
    };
    // With another tolerance the search can take another way, and end at another floor.
    let floors = (1..20).map(|eps| (eps, floor(eps, 1e-200).unwrap()));
    assert!(floors.filter(|(eps, least)| floor(*eps, *least) == Some(*least)).count() > 0);
}

/// The force jumps between 1/8 and the next f64, where both signs are certain.
#[test]
fn the_search_ends_between_neighbours() {
    let [eighth, less] = [0.125_f64, f64::exp2(-60.0)].map(|x| Dual::constant(x.enclose()));
    let jump = |[force]: &[_; 1], p: &DualEnclosure<f64>| force * (p - &eighth - &less).positive_part();
    let found = solve_functional(&example(), &[10.0], &1e-200, jump).unwrap();
    assert_eq!(found.outcome, Outcome::Stagnated);
    assert_eq!(found.bounds.penetration, Interval { lower: 0.125, upper: f64::next_up(0.125) });
}

type Number = DualEnclosure<f64>;

/// Returns the violated condition, and the penetration rounded to 32nds.
fn refused(w: impl Fn(&Number, &Number) -> Number) -> (FunctionalCondition, f64) {
    match solve_functional(&example(), &[8.0], &1e-9, |[eps], p| w(eps, p)) {
        Err(FunctionalError::Broken { condition, at }) => {
            (condition, (at.parse::<f64>().unwrap() * 32.0).round() / 32.0)
        }
        other => panic!("{other:?}"),
    }
}

/// Each condition is named, with a penetration at which it is violated. R/c = 1/2.
#[test]
fn violated_conditions_are_named() {
    use FunctionalCondition::*;
    let w = penalty::functional::<Number>;
    let int = Number::int;
    let [nan, huge, large] = [f64::NAN, f64::MAX, 1e200].map(|x| Dual::constant(x.enclose()));
    assert_eq!(refused(|eps, p| w(eps, p) + int(1)), (ZeroAtContact, 0.0));
    assert_eq!(refused(|eps, p| w(eps, p) - eps), (ZeroAtContact, 0.0));
    assert_eq!(refused(|_, p| int(1) / p), (ZeroAtContact, 0.0));
    assert_eq!(refused(|_, p| p / (p - p)), (ZeroAtContact, 0.0));
    assert_eq!(refused(|_, _| nan.clone()), (ZeroAtContact, 0.0));
    // The energy at p = 0 is 0, and the force there is infinite.
    assert_eq!(refused(|_, p| p * &large * &large), (ZeroAtContact, 0.0));
    assert_eq!(refused(|eps, p| -w(eps, p)), (Monotone, 0.03125));
    assert_eq!(refused(|_, p| -p), (Monotone, 0.03125));
    // Falls at last: p² (1 − 2 p) from 1/3 on.
    assert_eq!(refused(|_, p| p * p * (int(1) - int(2) * p)).0, Convex);
    assert_eq!(refused(|_, p| p.positive_part().min(&(int(1) / int(8) - p))), (Monotone, 0.0625));
    // Softens: ε p/(1 + p), and from one sixteenth to the next.
    assert_eq!(refused(|eps, p| eps * p / (int(1) + p)), (Convex, 0.03125));
    assert_eq!(refused(|eps, p| (eps * p).min(&(p + int(1)))), (Convex, 0.15625));
    // Jumps at 1/10 by 1: ⟨x⟩/x is 1 from there on, and 0 before.
    let step = |p: &Number| {
        let x = p - int(1) / int(10);
        x.positive_part() / x
    };
    assert_eq!(refused(|eps, p| w(eps, p) + step(p)), (Continuous, 0.125));
    // It does so between the sixteenths, and not at them: the force is 1, then 0, then 1 again.
    let beyond = |p: &Number, n| (p - int(n) / int(128)).positive_part();
    assert_eq!(refused(|_, p| p - beyond(p, 5) + beyond(p, 7)), (Convex, 0.0625));
    // A fall that is hidden where there is no value, from 0.24 to 0.26.
    let hundredths = |n| int(n) / int(100);
    let hole = |p: &Number| (p - hundredths(24)).min(&(hundredths(26) - p)).positive_part() * &huge * &huge;
    assert_eq!(refused(|eps, p| w(eps, p) - step(&(p - hundredths(15))) + hole(p)), (Monotone, 0.28125));
    // A barrier that falls behind its pole.
    assert_eq!(refused(|eps, p| eps * p * p / (int(1) / int(3) - p)).0, Monotone);

    // Condition 3: constant, falling, bounded in ε; and the others with the penalty that is tried.
    let third = |w: fn(&Number, &Number) -> Number| {
        penalty_for_functional(&example(), &[1.0], &0.01, |[eps], p| w(eps, p))
    };
    let broken = |condition, at: &str| Err(FunctionalError::Broken { condition, at: at.to_string() });
    let unbounded = broken(UnboundedInPenalty, "0.01");
    assert_eq!(third(|_, p| p - p), unbounded);
    assert_eq!(third(|eps, p| p * p / eps), unbounded);
    assert_eq!(third(|eps, p| eps * p * p / (Number::int(1) + eps)), unbounded);
    assert_eq!(penalty_for_functional(&example(), &[], &0.01, |_, p| p.clone()), unbounded);
    let elevated = broken(ZeroAtContact, "0.0");
    assert_eq!(third(|eps, p| penalty::functional(eps, p) + Number::int(9)), elevated);
    assert_eq!(third(|eps, _| eps / (eps - eps)), elevated);
    assert!(penalty::penetration(&example(), &third(penalty::functional).unwrap()) <= 0.01);
}

/// Unusual functionals that meet the conditions have correct results.
#[test]
fn silly_functionals_come_to_an_end() {
    let solved = |w: fn(&Number, &Number) -> Number, eps: f64| {
        solve_functional(&example(), &[eps], &1e-200, |[eps], p| w(eps, p)).unwrap()
    };
    // None at all: the spring alone, p = R/c.
    let none = solved(|_, p| p - p, 1.0);
    assert!(none.bounds.penetration.contains(&0.5));
    assert!(none.penetration - 0.5 < 1e-9 && none.bounds.contact_force.lower == 0.0);
    // So large that W′ overflows at R/c, and that all of it does: 4 p + 4e308 p³ = 2.
    let huge = solved(cubic, f64::MAX);
    let p = &huge.bounds.penetration;
    assert!(p.lower > 0.0 && p.upper < 1e-150 && p.upper / p.lower < 1.1, "{huge:?}");
    let larger = solved(|eps, p| penalty::functional(eps, p) * Number::int(1000), f64::MAX);
    let eps = constant(&(exact(&f64::MAX) * int(1000)));
    bounds_hold(&example().as_ref().map(exact), &larger, &1e-200, |p| penalty::functional(&eps, p));
    // Nothing to be found but by halving: a force that jumps from 0 to 10 at 1/7.
    let jump = solved(|force, p| force * beyond_part(p, 7), 10.0);
    let p = &jump.bounds.penetration;
    assert!(p.contains(&(1.0 / 7.0)) && p.upper - p.lower < 1e-15, "{jump:?}");
    // A fiftieth power, in rationals: 1600 p⁴⁹ · … has its root far from where lines point.
    let power = |[eps]: &[Dual<Exact>; 1], p: &Dual<Exact>| (0..50).fold(eps.clone(), |w, _| w * p);
    let s = example().as_ref().map(exact);
    let found = solve_functional(&s, &[int(1)], &Exact::power_of_two(-40), power).unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
}

#[test]
fn a_separated_mass_does_not_evaluate_the_functional() {
    for g in [4.0, 8.0] {
        let s = SpringMass { g, ..example() };
        let found = solve_functional(&s, &[1.0], &1e-9, |_, _| panic!("asked")).unwrap();
        let mut known = solve(&s, &Method::Lagrange).unwrap();
        known.multiplier = None;
        assert_eq!(found, known);
    }
}

#[test]
fn arguments_are_refused_by_name() {
    for (s, eps, tolerance, name) in [
        (SpringMass { c: -4.0, ..example() }, 1.0, 1e-9, "stiffness"),
        (SpringMass { h: f64::NAN, ..example() }, 1.0, 1e-9, "height"),
        (example(), f64::INFINITY, 1e-9, "penalty parameter"),
        (example(), 1.0, 0.0, "tolerance"),
        (example(), 1.0, f64::NAN, "tolerance"),
    ] {
        let w = |[eps]: &[Number; 1], p: &Number| penalty::functional(eps, p);
        let solved = solve_functional(&s, &[eps], &tolerance, w).err();
        let searched = penalty_for_functional(&s, &[eps], &tolerance, w).err();
        for error in [solved, searched] {
            match error {
                Some(FunctionalError::Solve(SolveError::Invalid { argument, .. })) => {
                    assert_eq!(argument, name)
                }
                other => panic!("{name}: {other:?}"),
            }
        }
    }
}
