//! The k-th iterate in closed form, compared with the iteration in rationals.

use crate::strategies::*;
use spring_mass_contact::number::{Exponential, Field};
use spring_mass_contact::rug::Rational;
use spring_mass_contact::solver::kth_iterate;

/// The first steps, and some later ones.
const STEPS: [usize; 8] = [0, 1, 2, 3, 4, 7, 12, 25];

fn numbers<T>(x: Iterate<T>) -> [T; 4] {
    [x.multiplier, x.deflection, x.penetration, x.contact_force]
}

/// Asserts that closed forms contain the exact iterates, and returns them.
fn enclosures<T: Scalar + ToExact>(case: &Case<T>) -> Vec<Interval<T>> {
    let (exactly, mut found) = (case.exact(), Vec::new());
    for (plane, _) in planes::<T>() {
        let steps: Vec<_> = exactly.steps(plane).take(26).collect();
        for k in STEPS {
            let closed = kth_iterate(&case.system, &case.eps, &case.start, k as u64, plane).unwrap();
            assert_eq!(closed.k, k as u64);
            for (closed, step) in numbers(closed).into_iter().zip(numbers(steps[k].clone())) {
                assert!(encloses(&closed, &step), "k = {k}, {plane:?}: {:?}, {step}", ends(&closed));
                found.push(closed);
            }
        }
    }
    found
}

/// In rationals the closed form equals the iterate.
#[test]
fn rationals_are_exact() {
    holds((any_state(WIDE), -6..6i32), |(case, e)| {
        for case in [case, &case.with_penalty(&Exact::power_of_two(*e))] {
            assert!(enclosures(case).iter().all(|closed| closed.lower == closed.upper));
        }
    });
}

fn floats_enclose_the_exact_iterates<T: Float>(case: &Case<T>) {
    enclosures(case);
    let exactly = case.exact();
    let relative = if exactly.eps > exactly.system.c { q("1/3") } else { int(20) };
    enclosures(&exactly.with_penalty(&relative).rounded(&case.eps));
}

in_every_float! {
    floats_enclose_the_exact_iterates from any_state;
}

/// An operation of balls adds at most 2 η of its result, half an ulp and the rounding up of the radius. So
/// the relative error of ρ is at most 4 η, and that of ρᵏ 6 k η, since the weights of its products add up to
/// less than k; quotient and product add 6 η, and R, of exact terms up to 3 R, 14 η. The width is twice this
/// bound, and its rounding outward adds 4 η.
#[test]
fn the_penetration_keeps_its_digits() {
    let system = SpringMass { c: 100.0, m: 1.0, g: 10.0, l: 1.0, h: 1.0625 };
    let eta = f64::EPSILON / 2.0;
    for k in [0, 1, 10, 1000, 5000] {
        let p = kth_iterate(&system, &3.0, &0.0, k, Plane::Unilateral).unwrap().penetration;
        let few = 12.0 * k as f64 + 2.0 * 20.0 + 4.0;
        assert!(p.lower > 0.0 && p.upper - p.lower <= few * eta * p.upper, "k = {k}: {p:?}");
    }
}

/// Numbers of steps that are too large to iterate.
#[test]
fn steps_without_number() {
    let (system, eps, k) = (default_system(), Exact::power_of_two(-50), u64::MAX);
    // ρᵏ = (1 + ε/c)⁻ᵏ is between exp(−k ε/c) and the same with k ε²/(2 c²) less in the exponent, which is nothing.
    let bits = |x: &Exact| x.to_mpfr(300);
    let p =
        kth_iterate(&system.as_ref().map(bits), &bits(&eps), &bits(&int(0)), k, Plane::Unilateral).unwrap();
    let [lower, upper] = ends(&p.penetration);
    assert!(lower > int(0) && &upper - &lower < Exact::power_of_two(-60) * &lower);
    let exponent = -(&eps / &system.c * Exact::from(Rational::from(k)));
    let first = system::reaction(&system) / (&system.c + &eps);
    let expected = exact(&(bits(&exponent).exp() * bits(&first)));
    // k ε²/c² < 2⁶⁴ 2⁻¹⁰⁰ 2⁻¹² = 2⁻⁴⁸.
    assert!((&expected - lower).abs() < Exact::power_of_two(-48) * expected);
    // In f64 ρ is known to too few digits for that, and says so; as a rational it is refused.
    let floats = system.as_ref().map(|x| x.to_f64().unwrap());
    let rough = kth_iterate(&floats, &eps.to_f64().unwrap(), &0.0, k, Plane::Unilateral);
    assert!(rough.is_err() || rough.is_ok_and(|rough| rough.penetration.lower <= 0.0));
    let refused = kth_iterate(&system, &eps, &int(0), k, Plane::Unilateral);
    assert!(matches!(refused, Err(SolveError::TooLong { .. })));
    // And so it is as a constant of MPFR, whatever the other parameters are.
    let constant = |x: &Exact| Mpfr::constant(x.clone().into());
    let mixed = SpringMass { c: constant(&system.c), ..system.map(|x| x.to_mpfr(100)) };
    let after = |k| kth_iterate(&mixed, &constant(&eps), &Mpfr::int(0), k, Plane::Unilateral);
    assert!(matches!(after(k), Err(SolveError::TooLong { .. })));
    assert!(after(1000).is_ok_and(|step| step.penetration.lower > Mpfr::int(0)));
}

#[test]
fn a_weight_out_of_range_is_refused() {
    let huge = SpringMass { m: 1e300, g: 1e300, ..example() };
    let refused = kth_iterate(&huge, &4.0, &0.0, 3, Plane::Unilateral);
    assert!(matches!(refused, Err(SolveError::OutOfRange { .. })), "{refused:?}");
}
