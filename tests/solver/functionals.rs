//! User-defined penalty functionals: the bounds compared with exact signs and closed forms, and violated
//! conditions.

use crate::in_every_float;
use crate::strategies::*;
use num_traits::Zero;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, beyond, contact, penalty, system};
use spring_mass_contact::number::{Dual, Exact, Exponential, Field, Mpfr, PositivePart, ToExact};
use spring_mass_contact::solver::{
    Condition, DualEnclosure, FunctionalError, Method, Outcome, Scalar, Solution, SolveError, State,
    penalty_for_functional, solve, solve_functional,
};
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
) -> Result<(), TestCaseError> {
    let bounds = &answer.bounds;
    let [lower, upper] = [&bounds.penetration.lower, &bounds.penetration.upper].map(exact);
    // Where a kink at the plane holds the mass, the residual is positive already at 0.
    let held = lower.is_zero() && residual(s, &w, &lower) >= int(0);
    prop_assert!(held || residual(s, &w, &lower) <= int(0), "{:?}", answer);
    prop_assert!(lower >= int(0) && residual(s, &w, &upper) >= int(0), "{:?}", answer);
    let (gap, r) = (system::gap(s), system::reaction(s));
    prop_assert!(exact(&bounds.deflection.lower) <= &gap + &lower);
    prop_assert!(exact(&bounds.deflection.upper) >= gap + &upper);
    prop_assert!(exact(&bounds.contact_force.lower) <= positive_part(&(&r - &s.c * &upper)));
    prop_assert!(exact(&bounds.contact_force.upper) >= r - &s.c * &lower);
    let promised = match (answer.outcome, &answer.floor) {
        (Outcome::Converged, None) => tolerance,
        (Outcome::Stagnated, Some(floor)) => floor,
        (Outcome::Direct, None) if upper.is_zero() => return Ok(()),
        (other, _) => return Err(TestCaseError::fail(format!("{other}"))),
    };
    let off = |p: Exact| (exact(&answer.deflection) - system::gap(s) - p).abs();
    prop_assert!(off(lower) <= exact(promised) && off(upper) <= exact(promised), "{:?}", answer);
    Ok(())
}

/// Functionals in every float: a cubic, a layer with a kink inside, a kink at the plane, (1.10).
fn bounds_contain_the_root<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError>
where
    DualEnclosure<T>: PositivePart,
{
    let floats = case.rounded(like);
    let case = floats.exact();
    let (s, eps) = (&case.system, &case.eps);
    if State::of(s) != Ok(State::Contact) {
        return Ok(());
    }
    // As thick as the mass would sink in with the soft layer alone, or half of that.
    let depth = like.round_from_exact(&(penalty::penetration(s, eps) / int(2))).unwrap();
    let tolerance = &floats.tolerance;
    let parameters = [floats.eps.clone(), depth.clone(), T::int(7) * &floats.eps];
    let exactly = parameters.each_ref().map(exact);
    let [eps, d, stiff] = exactly.each_ref().map(constant);

    let answer =
        solve_functional(&floats.system, &parameters, tolerance, |[eps, ..], p| cubic(eps, p)).unwrap();
    bounds_hold(s, &answer, tolerance, |p| cubic(&eps, p))?;
    let layer = |[eps, d, stiff]: &[DualEnclosure<T>; 3], p: &DualEnclosure<T>| layered(stiff, eps, d, p);
    let answer = solve_functional(&floats.system, &parameters, tolerance, layer).unwrap();
    bounds_hold(s, &answer, tolerance, |p| layered(&stiff, &eps, &d, p))?;
    let quartic = |[eps, _, e4]: &[DualEnclosure<T>; 3], p: &DualEnclosure<T>| {
        penalty::series(eps, std::slice::from_ref(e4), p)
    };
    let answer = solve_functional(&floats.system, &parameters, tolerance, quartic).unwrap();
    bounds_hold(s, &answer, tolerance, |p| penalty::series(&eps, std::slice::from_ref(&stiff), p))?;

    // A kink that holds the mass, and one that does not: ε is a force here.
    let force = like.round_from_exact(&(system::reaction(s) / int(2))).unwrap();
    for times in [1, 3] {
        let parameters = [T::int(times) * &force, floats.eps.clone()];
        let [force, second] = parameters.each_ref().map(|x| constant(&exact(x)));
        let kink = |[eps, second]: &[DualEnclosure<T>; 2], p: &DualEnclosure<T>| kinked(eps, second, p);
        let answer = solve_functional(&floats.system, &parameters, tolerance, kink).unwrap();
        bounds_hold(s, &answer, tolerance, |p| kinked(&force, &second, p))?;
    }
    Ok(())
}

/// ε p²/2 is (1.13): the closed form is within the bounds, and they are not much wider than its rounding
/// error.
fn the_parabola_is_the_penalty_method<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let case = floats.exact();
    let found =
        solve_functional(&floats.system, std::array::from_ref(&floats.eps), &floats.tolerance, |[eps], p| {
            penalty::functional(eps, p)
        });
    let (found, known) = (found.unwrap(), solve(&floats.system, &floats.penalty()).unwrap());
    prop_assert_eq!(found.state, known.state);
    let (s, eps) = (&case.system, &case.eps);
    let r = reaction(&case);
    let p = if r > int(0) {
        penalty::penetration(s, eps)
    } else {
        contact::penetration(s, &contact::deflection(s))
    };
    let [lower, upper] = [&found.bounds.penetration.lower, &found.bounds.penetration.upper].map(exact);
    prop_assert!(lower <= p && p <= upper);
    if r <= int(0) {
        prop_assert_eq!(found.bounds, solve(&floats.system, &Method::Lagrange).unwrap().bounds);
        prop_assert!(found.contact_force.is_zero() && found.multiplier.is_none());
        return Ok(());
    }
    // c p, W′ and R are off by less than 16 η (c p + ε p + |m g| + |c l| + |c H|) together, as enclosed. That is made
    // up for within as much over c + ε to either side, at a number that is tried within twice that.
    let sizes = (&s.c + eps) * &p + (&s.m * &s.g).abs() + (&s.c * &s.l).abs() + (&s.c * &s.h).abs();
    let widest = int(128) * unit_roundoff(like) * sizes / (&s.c + eps);
    let tolerance = &case.tolerance;
    prop_assert!(&upper - &lower <= widest || &upper - &lower <= *tolerance, "{:?} {:?}", found, case);
    Ok(())
}

in_every_float! {
    bounds_contain_the_root from in_contact;
    the_parabola_is_the_penalty_method from any_state;
}

proptest! {
    /// In rationals every tolerance is met, and a parabola needs none.
    #[test]
    fn rationals_meet_every_tolerance(case in in_contact(8), digits in 1..200i32) {
        let Case { system: s, eps, .. } = &case;
        let tolerance = Exact::power_of_two(-digits);
        let found = solve_functional(s, std::array::from_ref(eps), &tolerance, |[eps], p| penalty::functional(eps, p)).unwrap();
        prop_assert_eq!((&found.penetration, found.outcome), (&penalty::penetration(s, eps), Outcome::Converged));
        prop_assert_eq!(&found.bounds.penetration.lower, &found.bounds.penetration.upper);
        let found = solve_functional(s, std::array::from_ref(eps), &tolerance, |[eps], p| cubic(eps, p)).unwrap();
        prop_assert_eq!(found.outcome, Outcome::Converged);
        let p = &found.bounds.penetration;
        prop_assert!(&p.upper - &p.lower <= tolerance);
        prop_assert_eq!(&found.contact_force, &(&s.m * &s.g - &s.c * &found.deflection));
        bounds_hold(s, &found, &tolerance, |p| cubic(&constant(eps), p))?;
    }

    /// 4 p + 8 p² = 2 has the irrational root p = (√5 − 1)/4, for which (4 p + 1)² = 5.
    #[test]
    fn an_irrational_root_has_rational_bounds(digits in 1..300i32) {
        let s = example().map(exact);
        let found =
            solve_functional(&s, &[int(8)], &Exact::power_of_two(-digits), |[eps], p| cubic(eps, p)).unwrap();
        let squared = |p: &Exact| power(&(int(4) * p + int(1)), 2);
        let p = &found.bounds.penetration;
        prop_assert!(squared(&p.lower) < int(5) && int(5) < squared(&p.upper));
        prop_assert!(p.lower.bit_length() < 4 * 300);
    }

    /// Condition 3: with the penalty that is found the exact root is below the tolerance.
    #[test]
    fn the_found_penalty_meets_the_tolerance(case in any_state(8), fraction in 1..100i32) {
        let Case { system: s, eps, .. } = &case;
        let tolerance = positive_part(&(reaction(&case) / &s.c)) * int(fraction) / int(100) + Exact::power_of_two(-30);
        let first = std::array::from_ref(eps);
        let found = penalty_for_functional(s, first, &tolerance, |[eps], p| cubic(eps, p)).unwrap();
        prop_assert!(&found >= eps);
        if State::of(s) == Ok(State::Contact) {
            prop_assert!(residual(s, |p| cubic(&constant(&found), p), &tolerance) > int(0));
        } else {
            prop_assert_eq!(&found, eps);
        }
    }
}

/// Returns the example system, R = 2.
fn example() -> SpringMass<f64> {
    SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 }
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
    let exact = example().map(|x| Exact::from(*x as i32).to_mpfr(400));
    let eps = Exact::from(1).to_mpfr(400);
    let tolerance = Exact::power_of_two(-380).to_mpfr(400);
    let answer = solve_functional(&exact, &[eps], &tolerance, |[eps], p| exponential(eps, p)).unwrap();
    assert_eq!(answer.outcome, Outcome::Converged);
}

/// High precision needs few values of W if it is smooth: the digits double with each step.
#[test]
fn digits_double() {
    let s = example().map(exact);
    let values = |digits: i32| {
        let count = Cell::new(0);
        let counted = |[eps]: &[DualEnclosure<Exact>; 1], p: &DualEnclosure<Exact>| {
            count.set(count.get() + 1);
            cubic(eps, p)
        };
        let found = solve_functional(&s, &[int(8)], &Exact::power_of_two(-digits), counted).unwrap();
        assert_eq!(found.outcome, Outcome::Converged);
        count.get()
    };
    // Sixteen at the sixteenths, two in each of 15 steps, and what it takes to come near and to end.
    assert!(values(20_000) < 100);
}

/// The search also terminates for functionals that are not smooth: a jump in MPFR gains one digit in each of
/// ten thousand steps. The bounds still hold, and no floor is reported.
#[test]
fn ten_thousand_steps_are_enough() {
    let like = int(1).to_mpfr(11_000);
    let s = example().map(|x| like.round_from_exact(&exact(x)).unwrap());
    let seventh = |p: &DualEnclosure<Mpfr>| {
        (p - DualEnclosure::<Mpfr>::int(1) / DualEnclosure::<Mpfr>::int(7)).positive_part()
    };
    let [force, tolerance] =
        [int(10), Exact::power_of_two(-10_900)].map(|x| like.round_from_exact(&x).unwrap());
    let found = solve_functional(&s, &[force], &tolerance, |[force], p| force * seventh(p)).unwrap();
    assert_eq!((found.outcome, &found.floor), (Outcome::IterationLimit, &None));
    let [lower, upper] = [&found.bounds.penetration.lower, &found.bounds.penetration.upper].map(exact);
    assert!(
        lower <= int(1) / int(7) && int(1) / int(7) <= upper && upper - lower < Exact::power_of_two(-5000)
    );
}

/// A functional that is undefined beyond a point: below it the force is 0, so the root is beyond, and R/c
/// bounds it.
#[test]
fn an_undefined_value_ends_the_search() {
    for n in 3..30 {
        let wall = |p: &DualEnclosure<f64>| {
            let beyond = (p - DualEnclosure::<f64>::int(1) / DualEnclosure::<f64>::int(n)).positive_part();
            let huge = Dual::constant(f64::MAX.enclose());
            beyond * &huge * huge
        };
        let found = solve_functional(&example(), &[], &1e-9, |[], p| wall(p)).unwrap();
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

/// Returns the violated condition, and the penetration rounded to 32nds.
fn refused<W>(w: W) -> (Condition, f64)
where
    W: Fn(&[DualEnclosure<f64>; 1], &DualEnclosure<f64>) -> DualEnclosure<f64>,
{
    match solve_functional(&example(), &[8.0], &1e-9, w) {
        Err(FunctionalError::Broken { condition, at }) => {
            (condition, (at.parse::<f64>().unwrap() * 32.0).round() / 32.0)
        }
        other => panic!("{other:?}"),
    }
}

/// Each condition is named, with a penetration at which it is violated. R/c = 1/2.
#[test]
fn violated_conditions_are_named() {
    use Condition::*;
    let w = |eps: &DualEnclosure<f64>, p: &DualEnclosure<f64>| penalty::functional(eps, p);
    let int = DualEnclosure::<f64>::int;
    assert_eq!(refused(|[eps], p| w(eps, p) + int(1)), (ZeroAtContact, 0.0));
    assert_eq!(refused(|[eps], p| w(eps, p) - eps), (ZeroAtContact, 0.0));
    assert_eq!(refused(|_, p| int(1) / p), (ZeroAtContact, 0.0));
    assert_eq!(refused(|_, p| p / (p - p)), (ZeroAtContact, 0.0));
    let nan = Dual::constant(f64::NAN.enclose());
    assert_eq!(refused(|_, _| nan.clone()), (ZeroAtContact, 0.0));
    // The energy at p = 0 is 0, and the force there is infinite.
    let large = Dual::constant(1e200.enclose());
    assert_eq!(refused(|_, p| p * &large * &large), (ZeroAtContact, 0.0));
    assert_eq!(refused(|[eps], p| -w(eps, p)), (Monotone, 0.03125));
    assert_eq!(refused(|_, p| -p), (Monotone, 0.03125));
    // Falls at last: p² (1 − 2 p) from 1/3 on.
    assert_eq!(refused(|_, p| p * p * (int(1) - int(2) * p)).0, Convex);
    assert_eq!(refused(|_, p| p.positive_part().min(&(int(1) / int(8) - p))), (Monotone, 0.0625));
    // Softens: ε p/(1 + p), and from one sixteenth to the next.
    assert_eq!(refused(|[eps], p| eps * p / (int(1) + p)), (Convex, 0.03125));
    assert_eq!(refused(|[eps], p| (eps * p).min(&(p + int(1)))), (Convex, 0.15625));
    // Jumps at 1/10 by 1: ⟨x⟩/x is 1 from there on, and 0 before.
    let step = |p: &DualEnclosure<f64>| {
        let x = p - int(1) / int(10);
        x.positive_part() / x
    };
    assert_eq!(refused(|[eps], p| w(eps, p) + step(p)), (Continuous, 0.125));
    // It does so between the sixteenths, and not at them: the force is 1, then 0, then 1 again.
    let beyond = |p: &DualEnclosure<f64>, n| (p - int(n) / int(128)).positive_part();
    assert_eq!(refused(|_, p| p - beyond(p, 5) + beyond(p, 7)), (Convex, 0.0625));
    // A fall that is hidden where there is no value, from 0.24 to 0.26.
    let (huge, hundredths) = (Dual::constant(f64::MAX.enclose()), |n| int(n) / int(100));
    let hole = |p: &DualEnclosure<f64>| {
        (p - hundredths(24)).min(&(hundredths(26) - p)).positive_part() * &huge * &huge
    };
    assert_eq!(refused(|[eps], p| w(eps, p) - step(&(p - hundredths(15))) + hole(p)), (Monotone, 0.28125));
    // A barrier that falls behind its pole.
    assert_eq!(refused(|[eps], p| eps * p * p / (int(1) / int(3) - p)).0, Monotone);

    // Condition 3: constant, falling, bounded in ε.
    let system = example();
    let third = |w: fn(&DualEnclosure<f64>, &DualEnclosure<f64>) -> DualEnclosure<f64>| {
        penalty_for_functional(&system, &[1.0], &0.01, |[eps], p| w(eps, p))
    };
    let unbounded = Err(FunctionalError::Broken { condition: UnboundedInPenalty, at: "0.01".to_string() });
    assert_eq!(third(|_, p| p - p), unbounded);
    assert_eq!(third(|eps, p| p * p / eps), unbounded);
    assert_eq!(third(|eps, p| eps * p * p / (DualEnclosure::<f64>::int(1) + eps)), unbounded);
    assert_eq!(penalty_for_functional(&system, &[], &0.01, |_, p| p.clone()), unbounded);
    let elevated = Err(FunctionalError::Broken { condition: ZeroAtContact, at: "0.0".to_string() });
    assert_eq!(third(|eps, p| penalty::functional(eps, p) + DualEnclosure::<f64>::int(9)), elevated);
    assert_eq!(third(|eps, _| eps / (eps - eps)), elevated);
    let enough = third(penalty::functional).unwrap();
    assert!(penalty::penetration(&system, &enough) <= 0.01);
}

/// Unusual functionals that meet the conditions have correct results.
#[test]
fn silly_functionals_come_to_an_end() {
    let solved = |w: fn(&DualEnclosure<f64>, &DualEnclosure<f64>) -> DualEnclosure<f64>, eps: f64| {
        solve_functional(&example(), &[eps], &1e-200, |[eps], p| w(eps, p)).unwrap()
    };
    // None at all: the spring alone, p = R/c.
    let none = solved(|_, p| p - p, 1.0);
    assert!(none.bounds.penetration.lower <= 0.5 && 0.5 <= none.bounds.penetration.upper);
    assert!(none.penetration - 0.5 < 1e-9 && none.bounds.contact_force.lower == 0.0);
    // So large that W′ overflows at R/c, and that all of it does: 4 p + 4e308 p³ = 2.
    let huge = solved(cubic, f64::MAX);
    let p = &huge.bounds.penetration;
    assert!(p.lower > 0.0 && p.upper < 1e-150 && p.upper / p.lower < 1.1, "{huge:?}");
    let larger = solved(|eps, p| penalty::functional(eps, p) * DualEnclosure::<f64>::int(1000), f64::MAX);
    let eps = constant(&(exact(&f64::MAX) * int(1000)));
    bounds_hold(&example().map(exact), &larger, &1e-200, |p| penalty::functional(&eps, p)).unwrap();
    // Nothing to be found but by halving: a force that jumps from 0 to 10 at 1/7.
    let kink = |p: &DualEnclosure<f64>| {
        (p - DualEnclosure::<f64>::int(1) / DualEnclosure::<f64>::int(7)).positive_part()
    };
    let jump = solve_functional(&example(), &[10.0], &1e-200, |[force], p| force * kink(p)).unwrap();
    let p = &jump.bounds.penetration;
    assert!(p.lower <= 1.0 / 7.0 && 1.0 / 7.0 <= p.upper && p.upper - p.lower < 1e-15, "{jump:?}");
    // A fiftieth power, in rationals: 1600 p⁴⁹ · … has its root far from where lines point.
    let power = |eps: &Dual<Exact>, p: &Dual<Exact>| (0..50).fold(eps.clone(), |w, _| w * p);
    let s = example().map(exact);
    let found = solve_functional(&s, &[int(1)], &Exact::power_of_two(-40), |[eps], p| power(eps, p)).unwrap();
    assert_eq!(found.outcome, Outcome::Converged);
}

#[test]
fn a_separated_mass_does_not_evaluate_the_functional() {
    let lifted = SpringMass { g: 4.0, ..example() };
    let grazing = SpringMass { g: 8.0, ..example() };
    for s in [lifted, grazing] {
        let found = solve_functional(&s, &[1.0], &1e-9, |_, _| panic!("asked")).unwrap();
        let mut known = solve(&s, &Method::Lagrange).unwrap();
        known.multiplier = None;
        assert_eq!(found, known);
    }
}

#[test]
fn arguments_are_refused_by_name() {
    let argument = |s: SpringMass<f64>, eps: f64, tolerance: f64| {
        let solved = solve_functional(&s, &[eps], &tolerance, |[eps], p| penalty::functional(eps, p));
        let searched = penalty_for_functional(&s, &[eps], &tolerance, |[eps], p| penalty::functional(eps, p));
        match (solved, searched) {
            (
                Err(FunctionalError::Solve(SolveError::Invalid { argument, .. })),
                Err(FunctionalError::Solve(SolveError::Invalid { argument: also, .. })),
            ) if argument == also => argument,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(argument(SpringMass { c: -4.0, ..example() }, 1.0, 1e-9), "stiffness");
    assert_eq!(argument(SpringMass { h: f64::NAN, ..example() }, 1.0, 1e-9), "height");
    assert_eq!(argument(example(), f64::INFINITY, 1e-9), "penalty parameter");
    assert_eq!(argument(example(), 1.0, 0.0), "tolerance");
    assert_eq!(argument(example(), 1.0, f64::NAN), "tolerance");
}
