//! Invariances of the results: units, origin of lengths, positive direction.

use crate::strategies::*;
use proptest::prelude::*;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::Exact;
use spring_mass_contact::solver::{Bounds, Interval, Method, Scalar, Solution, solve, solve_bilateral};

/// Conversion factors: the number of new units in an old one.
#[derive(Clone, Debug)]
struct Units<T> {
    length: T,
    mass: T,
    force: T,
}

impl<T: Scalar> Units<T> {
    fn case(&self, case: &Case<T>) -> Case<T> {
        let Units { length, mass, force } = self;
        let SpringMass { c, m, g, l, h } = &case.system;
        Case {
            system: SpringMass {
                c: c * (force / length),
                m: m * mass,
                g: g * (force / mass),
                l: l * length,
                h: h * length,
            },
            eps: &case.eps * (force / length),
            start: &case.start * force,
            tolerance: &case.tolerance * length,
        }
    }

    fn solution(&self, answer: &Solution<T>) -> Solution<T> {
        let Units { length, force, .. } = self;
        let mut answer = answer.clone();
        let Bounds { deflection, penetration, contact_force, .. } = &mut answer.bounds;
        for (bounds, unit) in [(deflection, length), (penetration, length), (contact_force, force)] {
            *bounds = Interval { lower: &bounds.lower * unit, upper: &bounds.upper * unit };
        }
        answer.deflection = &answer.deflection * length;
        answer.penetration = &answer.penetration * length;
        answer.contact_force = &answer.contact_force * force;
        answer.multiplier = answer.multiplier.map(|x| x * force);
        answer.floor = answer.floor.map(|x| x * length);
        answer
    }
}

/// For both planes and every method, the results in the new units are the converted results.
fn units_do_not_matter<T: Scalar>(case: &Case<T>, units: &Units<T>) -> Result<(), TestCaseError>
where
    Case<T>: std::fmt::Debug,
{
    let other = units.case(case);
    for (old, new) in case.methods(30).iter().zip(other.methods(30)) {
        for solve in [solve::<T>, solve_bilateral::<T>] {
            let expected = units.solution(&solve(&case.system, old).unwrap());
            prop_assert_eq!(solve(&other.system, &new).unwrap(), expected, "{:?}", old);
        }
    }
    Ok(())
}

proptest! {
    /// Arbitrary units, in rationals.
    #[test]
    fn any_units_in_rationals(
        case in any_state(WIDE), (length, mass, force) in (positive(WIDE), positive(WIDE), positive(WIDE)),
    ) {
        units_do_not_matter(&case, &Units { length, mass, force })?;
    }

    /// Units that differ by powers of two: equal bit for bit, bounds and step counts included.
    #[test]
    fn powers_of_two_in_f32(case in any_state(NARROW), exponents in prop::array::uniform3(-6..=6i32)) {
        let [length, mass, force] = exponents.map(|n| 2f32.powi(n));
        let case = case.rounded(&1f32);
        // A radius has some units of underflow, 2⁻¹⁴⁹, which are the same in all units; a divisor of 2⁻¹⁸ makes them
        // 2⁻¹²⁹. Beside the last bit of what is larger than this, 2⁻⁸⁴ of a value and 2⁻¹⁰⁸ of its radius, they turn no
        // rounding but one of 2²¹.
        let is_small = |x: f32| x != 0.0 && x.abs() < 2f32.powi(-60);
        let solutions = case.methods(30).into_iter().flat_map(|method| {
            [solve::<f32>, solve_bilateral::<f32>].map(|solve| solve(&case.system, &method).unwrap())
        });
        let ends = solutions.flat_map(|solution| {
            let Bounds { deflection, penetration, contact_force, .. } = solution.bounds;
            [deflection, penetration, contact_force].map(|interval| [interval.lower, interval.upper])
        });
        prop_assume!(!ends.flatten().any(is_small));
        units_do_not_matter(&case, &Units { length, mass, force })?;
    }
    #[test]
    fn powers_of_two_in_f64(case in any_state(WIDE), exponents in prop::array::uniform3(-100..=100i32)) {
        let [length, mass, force] = exponents.map(|n| 2f64.powi(n));
        units_do_not_matter(&case.rounded(&1f64), &Units { length, mass, force })?;
    }
    #[test]
    fn powers_of_two_in_mpfr(
        case in any_state(WIDE), exponents in prop::array::uniform3(-9999..=9999i32), bits in 4u32..200,
    ) {
        let like = int(1).to_mpfr(bits);
        let [length, mass, force] = exponents.map(|n| Exact::power_of_two(n).to_mpfr(bits));
        units_do_not_matter(&case.rounded(&like), &Units { length, mass, force })?;
    }

    /// Only H − l matters: the position of the support is arbitrary.
    #[test]
    fn the_support_may_be_anywhere(case in any_state(WIDE), shift in number(WIDE)) {
        let SpringMass { l, h, .. } = &case.system;
        let system = SpringMass { l: l + &shift, h: h + &shift, ..case.system.clone() };
        for method in case.methods(10) {
            for solve in [solve::<Exact>, solve_bilateral::<Exact>] {
                prop_assert_eq!(solve(&system, &method).unwrap(), solve(&case.system, &method).unwrap());
            }
        }
    }

    /// Only m g matters: a heavier mass with a smaller acceleration has the same deflection.
    #[test]
    fn only_the_weight_matters(case in any_state(WIDE), factor in positive(WIDE)) {
        let SpringMass { m, g, .. } = &case.system;
        let system = SpringMass { m: m * &factor, g: g / &factor, ..case.system.clone() };
        for method in case.methods(10) {
            for solve in [solve::<Exact>, solve_bilateral::<Exact>] {
                prop_assert_eq!(solve(&system, &method).unwrap(), solve(&case.system, &method).unwrap());
            }
        }
    }

    /// With a bilateral plane the mirror image has the mirrored results.
    #[test]
    fn a_bilateral_plane_has_a_mirror_image(case in any_state(WIDE)) {
        let SpringMass { c, m, g, l, h } = case.system.clone();
        let system = SpringMass { c, m, g: -g, l: h, h: l };
        let image = Case { system, start: -&case.start, ..case.clone() };
        for (method, other) in case.methods(10).iter().zip(image.methods(10)) {
            let answer = solve_bilateral(&case.system, method).unwrap();
            let mirrored = solve_bilateral(&image.system, &other).unwrap();
            prop_assert_eq!(-mirrored.deflection, answer.deflection);
            prop_assert_eq!(-mirrored.penetration, answer.penetration);
            prop_assert_eq!(-mirrored.contact_force, answer.contact_force);
            prop_assert_eq!(mirrored.multiplier.map(|x| -x), answer.multiplier);
            prop_assert_eq!(mirrored.augmentations, answer.augmentations);
            prop_assert_eq!(mirrored.outcome, answer.outcome);
        }
    }

    /// An augmentation that starts from λ₀ = R converges at once, for every ε.
    #[test]
    fn a_start_from_the_answer_stays(case in in_contact(WIDE)) {
        let case = Case { start: reaction(&case), ..case };
        let answer = solve(&case.system, &case.augmented(0)).unwrap();
        let lagrange = solve(&case.system, &Method::Lagrange).unwrap();
        prop_assert_eq!(answer.augmentations, Some(0));
        prop_assert_eq!(answer.deflection, lagrange.deflection);
        prop_assert_eq!(answer.contact_force, lagrange.contact_force);
    }
}
