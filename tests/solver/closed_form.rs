//! The k-th iterate in closed form, compared with the iteration in rationals.

use crate::in_every_float;
use crate::strategies::*;
use proptest::prelude::*;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, Field, Mpfr};
use spring_mass_contact::solver::{
    Augmentation, Interval, Iterate, Plane, Scalar, SolveError, State, kth_iterate,
};

const PLANES: [Plane; 2] = [Plane::Unilateral, Plane::Bilateral];

fn numbers<T>(x: Iterate<T>) -> [T; 4] {
    [x.multiplier, x.deflection, x.penetration, x.contact_force]
}

fn after<T: Scalar>(x: &Case<T>, k: u64, plane: Plane) -> Result<Iterate<Interval<T>>, SolveError> {
    kth_iterate(&x.system, &x.eps, &x.start, k, plane)
}

fn step(x: &Case<Exact>, k: u64, plane: Plane) -> Iterate<Exact> {
    let steps = Augmentation::new(&x.system, &x.eps).with_multiplier(x.start.clone()).over(plane);
    steps.take(k as usize + 1).last().unwrap()
}

/// The first steps, and some later ones.
const STEPS: [u64; 8] = [0, 1, 2, 3, 4, 7, 12, 25];

proptest! {
    /// In rationals the closed form equals the iterate.
    #[test]
    fn rationals_are_exact(case in any_state(WIDE), e in -6..6i32) {
        let near_c = with_penalty(case.clone(), &Exact::power_of_two(e));
        for case in [case, near_c] {
            for plane in PLANES {
                for k in STEPS {
                    let closed = after(&case, k, plane).unwrap();
                    prop_assert_eq!(closed.k, k);
                    for (closed, step) in numbers(closed).into_iter().zip(numbers(step(&case, k, plane))) {
                        prop_assert_eq!(&closed.lower, &step, "k = {}, {:?}", k, plane);
                        prop_assert_eq!(closed.upper, step);
                    }
                }
            }
        }
    }
}

fn floats_enclose_the_exact_iterates<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let relative = if case.eps > case.system.c { int(1) / int(3) } else { int(20) };
    for case in [case.clone(), with_penalty(case.clone(), &relative)] {
        let floats = case.rounded(like);
        for plane in PLANES {
            for k in STEPS {
                let closed = numbers(after(&floats, k, plane).unwrap());
                for (closed, step) in closed.iter().zip(numbers(step(&floats.exact(), k, plane))) {
                    let inside = exact(&closed.lower) <= step && step <= exact(&closed.upper);
                    prop_assert!(inside, "k = {k}, {plane:?}: {closed:?}, {step} of {floats:?}");
                }
            }
        }
    }
    Ok(())
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
    let decimals = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" };
    let system = decimals.map(|x| x.parse::<Exact>().unwrap());
    let eps = Exact::power_of_two(-50);
    let k = u64::MAX;
    // ρᵏ = (1 + ε/c)⁻ᵏ is between exp(−k ε/c) and the same with k ε²/(2 c²) less in the exponent, which is nothing.
    let bits = |x: &Exact| x.to_mpfr(300);
    let narrow = Mpfr::rounded(300, 1) / bits(&Exact::power_of_two(60));
    let p = kth_iterate(&system.map(bits), &bits(&eps), &bits(&int(0)), k, Plane::Unilateral).unwrap();
    let p = p.penetration;
    assert!(p.lower > bits(&int(0)) && &p.upper - &p.lower < &narrow * &p.lower);
    let exponent = -(&eps / &system.c * Exact::from(spring_mass_contact::rug::Rational::from(k)));
    let expected = {
        use spring_mass_contact::number::Exponential;
        bits(&exponent).exp() * bits(&(system_reaction(&system) / (&system.c + &eps)))
    };
    // k ε²/c² < 2⁶⁴ 2⁻¹⁰⁰ 2⁻¹² = 2⁻⁴⁸.
    let off = (&expected - &p.lower) / &expected;
    let most = Mpfr::rounded(300, 1) / bits(&Exact::power_of_two(48));
    assert!(off < most && -off < most);
    // In f64 ρ is known to too few digits for that, and says so; as a rational it is refused.
    let rough =
        kth_iterate(&system.map(|x| x.to_f64().unwrap()), &eps.to_f64().unwrap(), &0.0, k, Plane::Unilateral);
    assert!(rough.is_err() || rough.is_ok_and(|rough| rough.penetration.lower <= 0.0));
    let refused = kth_iterate(&system, &eps, &int(0), k, Plane::Unilateral);
    assert!(matches!(refused, Err(SolveError::TooLong { .. })));
    // And so it is as a constant of MPFR, whatever the other parameters are.
    let constant = |x: &Exact| Mpfr::constant(x.clone().into());
    let mixed = SpringMass { c: constant(&system.c), ..system.map(|x| x.to_mpfr(100)) };
    let refused = kth_iterate(&mixed, &constant(&eps), &Mpfr::int(0), k, Plane::Unilateral);
    assert!(matches!(refused, Err(SolveError::TooLong { .. })));
    let accepted = kth_iterate(&mixed, &constant(&eps), &Mpfr::int(0), 1000, Plane::Unilateral);
    assert!(accepted.is_ok_and(|step| step.penetration.lower > Mpfr::int(0)));
}

fn system_reaction(system: &SpringMass<Exact>) -> Exact {
    spring_mass_contact::chapter::system::reaction(system)
}

#[test]
fn arguments_out_of_range_are_rejected() {
    let good = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    assert_eq!(State::of(&good), Ok(State::Contact));
    for (system, eps, start) in [
        (SpringMass { c: 0.0, ..good }, 4.0, 0.0),
        (SpringMass { h: f64::NAN, ..good }, 4.0, 0.0),
        (good, -4.0, 0.0),
        (good, f64::INFINITY, 0.0),
        (good, 4.0, f64::NAN),
    ] {
        let refused = kth_iterate(&system, &eps, &start, 3, Plane::Unilateral);
        assert!(matches!(refused, Err(SolveError::Invalid { .. })), "{refused:?}");
    }
    let huge = SpringMass { m: 1e300, g: 1e300, ..good };
    let refused = kth_iterate(&huge, &4.0, &0.0, 3, Plane::Unilateral);
    assert!(matches!(refused, Err(SolveError::OutOfRange { .. })), "{refused:?}");
}
