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
    // λ is halved 20 times; its last 53 bits are below 2⁻¹⁰⁷⁴.
    let system = SpringMass { c: two(-500), m: 1.0, g: 0.0, l: 0.0, h: 0.0 };
    let vanishing = Case { system, eps: two(-500), lambda: two(-1010) / 3.0, tol: two(-530), ..case(8) };
    assert_eq!(units(&vanishing, solve_bilateral), Trial::Undecided);
}
