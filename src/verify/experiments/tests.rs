//! Tests that each experiment fails for a wrong solver or iteration.

use super::*;

/// c = 4 N/m, ε = 4 N/m, m = 1 kg, l = 1 m, H = 3 m, tol = 2⁻¹⁰ m: R = g − 8, u* = 2 m where g ≥ 8, ρ = 1/2.
fn case<T: Scalar>(g: i32) -> Case<T> {
    let system = SpringMass { c: T::int(4), m: T::one(), g: T::int(g), l: T::one(), h: T::int(3) };
    let one = Case::of(|_| T::one());
    Case { system, eps: T::int(4), eps4: T::zero(), tol: power_of_two(-10), lambda: T::zero(), ..one }
}

const RIGHT: Trial = Trial::Decided(true);
const WRONG: Trial = Trial::Decided(false);

#[test]
fn every_listed_experiment_holds_for_the_right_functions() {
    fn listed<T>(all: Vec<Experiment<T>>, equation: &str, name: &str, x: &Case<T>) -> Trial {
        let found = all.iter().find(|e| (e.equation, e.name) == (equation, name));
        (found.unwrap_or_else(|| panic!("{equation} {name}")).check)(x)
    }
    for (equation, name, g) in [
        ("1.33", "steps", 10),
        ("1.33", "steps-bilateral", 10),
        ("1.33", "tie-goes-on", 10),
        ("note 4", "closed-form", 10),
        ("note 4", "release", 5),
    ] {
        assert_eq!(listed(exact_experiments(), equation, name, &case(g)), RIGHT, "{equation} {name}");
    }
    for (equation, name) in [
        ("1.6", "exact-state"),
        ("1.8", "bounds-contain"),
        ("1.10", "root"),
        ("1.13", "bounds-contain"),
        ("1.33", "promise"),
        ("note 8", "units-of-solutions"),
    ] {
        assert_eq!(listed(float_experiments::<f64>(), equation, name, &case(10)), RIGHT, "{equation} {name}");
    }
}

#[test]
fn powers_of_two_have_their_exponents() {
    assert_eq!([-2, -1, 0, 1, 3].map(power_of_two::<f64>), [0.25, 0.5, 1.0, 2.0, 8.0]);
}

#[test]
fn a_wrong_state_is_detected() {
    let all = [State::Contact, State::Grazing, State::Separated];
    for (g, right) in [9, 8, 7].into_iter().zip(all) {
        for found in all {
            assert_eq!(state(&case::<f64>(g), |_| Ok(found)), Trial::Decided(found == right), "{g} {found}");
        }
    }
}

/// A mistake in a solution.
type Mistake = fn(&mut Solution<f64>);

/// Each mistake moves one bound beyond the other.
const BOUNDS: [Mistake; 6] = [
    |s| s.bounds.deflection.lower = s.bounds.deflection.upper + 1.0,
    |s| s.bounds.deflection.upper = s.bounds.deflection.lower - 1.0,
    |s| s.bounds.penetration.lower = s.bounds.penetration.upper + 1.0,
    |s| s.bounds.penetration.upper = s.bounds.penetration.lower - 1.0,
    |s| s.bounds.contact_force.lower = s.bounds.contact_force.upper + 1.0,
    |s| s.bounds.contact_force.upper = s.bounds.contact_force.lower - 1.0,
];

/// Returns a solver with a mistake in its solution.
fn mistaken(mistake: impl Fn(&mut Solution<f64>)) -> impl Solver<f64> {
    move |system, method| {
        let mut solution = solve(system, method)?;
        mistake(&mut solution);
        Ok(solution)
    }
}

#[test]
fn bounds_on_the_wrong_side_are_detected() {
    let penalty = Method::Penalty { penalty: 4.0 };
    for (g, method) in [(10, Method::Lagrange), (5, Method::Lagrange), (10, penalty), (5, penalty)] {
        let x = case(g);
        assert_eq!(bounds(&x, &method, solve), RIGHT, "{g} {method:?}");
        for (i, mistake) in BOUNDS.into_iter().enumerate() {
            assert_eq!(bounds(&x, &method, mistaken(mistake)), WRONG, "{g} {method:?} {i}");
        }
        let refused = || solve(&x.system, &Method::Penalty { penalty: -1.0 });
        assert_eq!(bounds(&x, &method, |_: &_, _: &_| refused()), Trial::Undecided);
    }
    // The penetration by the penalty method is larger.
    assert_eq!(bounds(&case(10), &penalty, |system, _| solve(system, &Method::Lagrange)), WRONG);
}

#[test]
fn a_root_without_a_change_of_sign_is_detected() {
    let right = series_penetration::<f64>;
    // 8 p = 2, and 8 p + p³ = 2.
    for x in [case(10), Case { eps4: 1.0, ..case(10) }] {
        assert_eq!(series_root(&x, right), RIGHT);
        let wrong: [fn(f64) -> f64; 4] =
            [|p| p.next_up().next_up(), |p| p.next_down().next_down(), |p| -p, |_| 0.0];
        for wrong in wrong {
            assert_eq!(series_root(&x, |s, eps, higher| right(s, eps, higher).map(wrong)), WRONG);
        }
        assert_eq!(series_root(&x, |_, _, _| Ok(f64::MAX)), Trial::Undecided);
    }
    assert_eq!(series_root(&case(8), right), RIGHT);
    // Next to an exact root no sign changes.
    for wrong in [f64::next_up, f64::next_down] {
        assert_eq!(series_root(&case(10), |s, eps, higher| right(s, eps, higher).map(wrong)), WRONG);
    }
}

#[test]
fn a_violated_guarantee_is_detected() {
    let x = case(10);
    assert_eq!(promise(&x, solve), RIGHT);
    for mistake in BOUNDS {
        assert_eq!(promise(&x, mistaken(mistake)), WRONG);
    }
    let at = |u: f64| promise(&x, mistaken(move |s| s.deflection = u));
    assert_eq!([2.0 + x.tol, 2.0 - x.tol].map(at), [WRONG, WRONG], "the tolerance itself is not below it");
    assert_eq!([(2.0 + x.tol).next_down(), (2.0 - x.tol).next_up()].map(at), [RIGHT, RIGHT]);
    let pushing = |force: f64| promise(&x, mistaken(move |s| s.contact_force = force));
    assert_eq!([2.0, 0.0, -1e-9].map(pushing), [RIGHT, RIGHT, WRONG]);
    let ended = |outcome: Outcome, k: u64, floor: Option<f64>| {
        promise(
            &x,
            mistaken(move |s| {
                (s.outcome, s.augmentations, s.floor) = (outcome, Some(k), floor);
            }),
        )
    };
    assert_eq!(ended(Outcome::Direct, 7, None), WRONG, "there is something to iterate");
    let limit = STEPS as u64;
    assert_eq!(ended(Outcome::IterationLimit, limit, None), RIGHT);
    assert_eq!(ended(Outcome::IterationLimit, limit - 1, None), WRONG);
    // The error of the answer is p₉ = 2⁻¹¹, the first one below 2⁻¹⁰.
    let least = power_of_two::<f64>(-11);
    let stagnated = [None, Some(0.0), Some(least.next_down()), Some(least), Some(1.0)]
        .map(|floor| ended(Outcome::Stagnated, limit, floor));
    assert_eq!(stagnated, [WRONG, WRONG, WRONG, RIGHT, RIGHT]);
}

#[test]
fn a_solver_that_depends_on_units_is_detected() {
    let mistakes: [Mistake; 7] = [
        |s| s.outcome = Outcome::IterationLimit,
        |s| s.augmentations = s.augmentations.map(|k| k + 1),
        |s| s.deflection = s.deflection.next_up(),
        |s| s.contact_force = s.contact_force.next_down(),
        |s| s.multiplier = s.multiplier.map(f64::next_up),
        |s| s.multiplier = None,
        |s| s.deflection *= 2.0,
    ];
    for x in [case(10), case(5), Case { lambda: 3.0, ..case(10) }] {
        assert_eq!(units(&x, solve_bilateral), RIGHT);
        for (i, mistake) in mistakes.into_iter().enumerate() {
            let wrong = |system: &SpringMass<f64>, method: &Method<f64>| {
                let mut solution = solve_bilateral(system, method)?;
                if *system != x.system {
                    mistake(&mut solution);
                }
                Ok(solution)
            };
            assert_eq!(units(&x, wrong), WRONG, "{i}");
        }
    }
}

/// If digits are lost, the trial is undecided: of a parameter in other units, or of a product in these.
#[test]
fn cases_that_lose_digits_by_a_change_of_units_are_undecided() {
    let two = power_of_two::<f64>;
    let with = |c, m, g| {
        let system = SpringMass { c, m, g, l: 1.0, h: 2.0 };
        Case { system, eps: c, ..case(8) }
    };
    assert_eq!(units(&with(two(-74), 1.5 * two(-500), 1.5 * two(427)), solve_bilateral), RIGHT);
    assert_eq!(units(&with(two(-74), 3.0 * two(-1074), two(1000)), solve_bilateral), Trial::Undecided);
    assert_eq!(units(&with(two(-1020), two(-500), 1.5 * two(-523)), solve_bilateral), Trial::Undecided);
}

fn steps(x: &Case<Exact>, plane: Plane) -> Vec<Iterate<Exact>> {
    exact_steps(x, &x.lambda, plane).collect()
}

#[test]
fn right_formulas_with_many_digits_are_followed_to_the_end() {
    let long = |n: i32| Exact::from(n) + Exact::power_of_two(-200);
    let system = SpringMass { c: 4, m: 1, g: 10, l: 1, h: 3 }.map(|n| long(*n));
    let all = Case { system, eps: long(5), ..case(10) };
    // The stiffnesses alone, with different denominators.
    let system = SpringMass { c: long(4), ..case(10).system };
    let eps = Exact::from(5) + Exact::one() / (Exact::power_of_two(200) + Exact::one());
    for x in [all, Case { system, eps, ..case(10) }] {
        for plane in [Plane::Unilateral, Plane::Bilateral] {
            assert_eq!(steps(&x, plane).len(), STEPS);
        }
    }
}

/// |p_k| = 2^{−(k+2)}
#[test]
fn a_count_that_is_off_by_one_is_detected() {
    for plane in [Plane::Unilateral, Plane::Bilateral] {
        let x = Case { tol: "3/64".parse().unwrap(), ..case(10) };
        let of = |steps: &[Iterate<Exact>]| count(&x, plane, steps.iter().cloned());
        let right = steps(&x, plane);
        let found = [of(&right), of(&right[..4]), of(&right[..3]), of(&right[1..])];
        assert_eq!(found, [RIGHT, RIGHT, WRONG, WRONG]);
        // The tolerance up to which the count applies.
        let far = |tol: Exact| count(&Case { tol, ..x.clone() }, plane, right.iter().cloned());
        assert_eq!(far(Exact::from(3) * power_of_two::<Exact>(-26)), RIGHT);
        assert_eq!(far(Exact::from(3) * power_of_two::<Exact>(-27)), Trial::Undecided);
    }
}

#[test]
fn an_iteration_that_ends_at_a_tie_is_detected() {
    let x = case(10);
    let right: Vec<_> = exact_steps(&x, &start_of_tie(&x), Plane::Bilateral).collect();
    assert_eq!(right[2].penetration, x.tol);
    let of = |steps: &[Iterate<Exact>]| tie(&x, steps.iter().cloned());
    assert_eq!([of(&right), of(&right[..3]), of(&right[1..])], [RIGHT, WRONG, WRONG]);
}

#[test]
fn members_that_deviate_from_the_closed_form_are_detected() {
    for (g, start) in [(10, 0), (10, 7), (10, -7), (8, 3)] {
        let x = Case { lambda: Exact::from(start), ..case(g) };
        let right = steps(&x, Plane::Unilateral);
        let of = |steps: Vec<_>| unilateral_closed_form(&x, steps.into_iter());
        assert_eq!(of(right.clone()), RIGHT, "{g} {start}");
        for k in 2..7 {
            let mut wrong = right.clone();
            wrong[k].multiplier = &wrong[k].multiplier + Exact::one();
            assert_eq!(of(wrong), WRONG, "{g} {start} {k}");
        }
        for short in [0, 1, 2, 6] {
            assert_eq!(of(right[..short].to_vec()), WRONG, "{short} steps do not prove six");
        }
    }
}

/// R = −3: from 20 it takes 3 steps, since 23/8 is the first of 23/2ᵏ below 3; from 3 only one, since 6/2 is
/// 3.
#[test]
fn a_release_that_is_too_early_or_too_late_is_detected() {
    for (start, released) in [(0, 0), (-1, 1), (-100, 1), (3, 1), (4, 2), (20, 3)] {
        let x = Case { lambda: Exact::from(start), ..case(5) };
        let right = steps(&x, Plane::Unilateral);
        assert_eq!(right.iter().position(|step| step.multiplier.is_zero()), Some(released));
        let of = |steps: Vec<_>| release(&x, steps.into_iter());
        let with = |k: usize, change: fn(&mut Iterate<Exact>)| {
            let mut steps = right.clone();
            change(&mut steps[k]);
            of(steps)
        };
        assert_eq!(of(right.clone()), RIGHT, "{start}");
        if released > 0 {
            assert_eq!(with(released - 1, |step| step.multiplier = Exact::zero()), WRONG, "too early");
        }
        assert_eq!(with(released, |step| step.multiplier = Exact::one()), WRONG, "too late");
        for hanging in [released.saturating_sub(1), released, STEPS - 1] {
            assert_eq!(with(hanging, |step| step.deflection = Exact::from(9)), WRONG, "{start} {hanging}");
        }
        assert_eq!(of(right[..STEPS - 1].to_vec()), WRONG, "the last step is missing");
    }
    let far = Case { lambda: power_of_two(40), ..case(5) };
    assert_eq!(release(&far, steps(&far, Plane::Unilateral).into_iter()), Trial::Undecided);
}
