//! `solve` in machine floats allocates nothing.

use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::solver::{Method, Outcome, Plane, State, solve, solve_bilateral};

/// Returns the number of allocations and the result.
fn counted<T>(run: impl FnOnce() -> T) -> (u64, T) {
    let mut result = None;
    let info = allocation_counter::measure(|| result = Some(run()));
    (info.count_total, result.expect("it ran"))
}

/// Contact, grazing and separated; H < l; negative gravity.
const SYSTEMS: [SpringMass<f64>; 5] = [
    SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 },
    SpringMass { c: 4.0, m: 1.0, g: 8.0, l: 1.0, h: 3.0 },
    SpringMass { c: 4.0, m: 1.0, g: 4.0, l: 1.0, h: 3.0 },
    SpringMass { c: 4.0, m: 1.0, g: 4.0, l: 3.0, h: 1.0 },
    SpringMass { c: 4.0, m: 1.0, g: -4.0, l: 1.0, h: 3.0 },
];

#[test]
fn allocations_are_counted() {
    assert_eq!(counted(|| vec![1]).0, 1);
}

#[test]
fn solving_in_machine_floats_does_not_allocate() {
    let mut outcomes = Vec::new();
    for system in &SYSTEMS {
        for tolerance in [1e-3, 1e-30] {
            let augmented = |max_augmentations| Method::Augmented {
                penalty: 50.0,
                tolerance,
                max_augmentations,
                start: 1.0,
            };
            for method in [Method::Lagrange, Method::Penalty { penalty: 50.0 }, augmented(1), augmented(1000)]
            {
                for plane in [Plane::Unilateral, Plane::Bilateral] {
                    let (count, answer) = counted(|| match plane {
                        Plane::Unilateral => solve(system, &method),
                        Plane::Bilateral => solve_bilateral(system, &method),
                    });
                    assert_eq!(count, 0, "{system:?} {method:?} {plane:?}");
                    outcomes.push(answer.unwrap().outcome);
                }
            }
        }
    }
    for outcome in [Outcome::Direct, Outcome::Converged, Outcome::Stagnated, Outcome::IterationLimit] {
        assert!(outcomes.contains(&outcome), "{outcome:?} was not among what was measured");
    }
}

#[test]
fn solving_in_f32_and_state_do_not_allocate() {
    for system in &SYSTEMS {
        let narrow = system.map(|x| x as f32);
        let method = Method::Augmented { penalty: 50.0, tolerance: 1e-3, max_augmentations: 99, start: 0.0 };
        assert_eq!(counted(|| solve(&narrow, &method).is_ok()), (0, true));
        let (count, state) = counted(|| State::of(system));
        assert_eq!((count, state), (0, State::of(&narrow)));
    }
}
