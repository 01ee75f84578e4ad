//! Invariances of the results: units, origin of lengths, positive direction.

use crate::strategies::*;
use spring_mass_contact::solver::Bounds;

/// Conversion factors: the number of new units in an old one.
struct Units<T> {
    length: T,
    mass: T,
    force: T,
}

impl<T: Scalar> Units<T> {
    fn new([length, mass, force]: [T; 3]) -> Self {
        Units { length, mass, force }
    }

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

    fn solution(&self, answer: Solution<T>) -> Solution<T> {
        let Units { length, force, .. } = self;
        let mut answer = answer;
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

    /// Asserts that for both planes and every method the results in the new units are the converted results.
    fn do_not_matter(&self, case: &Case<T>) {
        let others = self.case(case).solutions(30);
        for ((plane, method, answer), (.., other)) in case.solutions(30).into_iter().zip(others) {
            assert_eq!(other, self.solution(answer), "{plane:?} {method:?}");
        }
    }
}

/// Arbitrary units, in rationals.
#[test]
fn any_units_in_rationals() {
    let units = [(); 3].map(|()| positive(WIDE));
    holds((any_state(WIDE), units), |(case, units)| Units::new(units.clone()).do_not_matter(case));
}

/// Only H − l matters, the position of the support is arbitrary; and only m g, so that a heavier mass with a
/// smaller acceleration has the same deflection.
#[test]
fn only_the_gap_and_the_weight_matter() {
    holds((any_state(WIDE), number(WIDE), positive(WIDE)), |(case, shift, factor)| {
        let SpringMass { c, m, g, l, h } = case.system.clone();
        let shifted = SpringMass { l: l + shift, h: h + shift, ..case.system.clone() };
        let heavier = SpringMass { m: m * factor, g: g / factor, c, ..case.system.clone() };
        for system in [shifted, heavier] {
            assert_eq!(Case { system, ..case.clone() }.solutions(10), case.solutions(10));
        }
    });
}

/// With a bilateral plane the mirror image has the mirrored results.
#[test]
fn a_bilateral_plane_has_a_mirror_image() {
    holds(any_state(WIDE), |case| {
        let SpringMass { c, m, g, l, h } = case.system.clone();
        let system = SpringMass { c, m, g: -g, l: h, h: l };
        let image = Case { system, start: -&case.start, ..case.clone() };
        let results = |case: &Case<Exact>, method, sign: i32| {
            let Solution {
                deflection, penetration, contact_force, multiplier, augmentations, outcome, ..
            } = solve_bilateral(&case.system, &method).unwrap();
            let numbers = [Some(deflection), Some(penetration), Some(contact_force), multiplier];
            (numbers.map(|x| x.map(|x| int(sign) * x)), augmentations, outcome)
        };
        for (method, mirrored) in case.methods(10).into_iter().zip(image.methods(10)) {
            assert_eq!(results(&image, mirrored, -1), results(case, method, 1));
        }
    });
}
