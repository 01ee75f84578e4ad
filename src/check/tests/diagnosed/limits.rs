//! Limits of diagnoses.

use super::*;

/// Two pairs of steps show a lag, one does not.
#[test]
fn three_steps_show_a_lag() {
    let lags = |count: usize| {
        let report = run(&problems(1, 3, &[Family::Contact]), |problem| {
            let mut answer = steps(problem, true);
            answer.steps.truncate(count);
            answer
        });
        report.lag().is_some()
    };
    assert_eq!([2, 3].map(lags), [false, true]);
}

/// Factors are equal, or 1, if they differ by at most 10⁻⁵ of the largest.
#[test]
fn factors_are_equal_up_to_a_tolerance() {
    let names = |of_u: &str, first: &str| {
        let report = run(&problems(1, 3, &[Family::Contact]), |problem| {
            let exact = problem.solution();
            let of_n = if problem.id == "contact-1" { first } else { "1.3" };
            Answer::new(exact.deflection * number(of_u), exact.contact_force * number(of_n))
        });
        report.diagnosis.iter().map(|d| d.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names("1.00001", "1.3"), ["N is 1.3 times the right value"]);
    assert_eq!(names("1", "1.299987"), ["N is 1.3 times the right value"]);
    assert!(names("1", "1.299986").is_empty());
}

/// Errors above the tolerance of the check, but below that of a diagnosis, fit every constant near 1.
#[test]
fn slight_errors_determine_no_constant() {
    let report = run_within("1e-9", &problems(1, 3, &[Family::Contact]), |problem| {
        let exact = problem.solution();
        Answer::new(exact.deflection, exact.contact_force * number("1.00000001"))
    });
    assert!(report.summary().wrong == 3 && report.diagnosis.is_empty(), "{:?}", report.diagnosis);
}

/// Wrong answers for R = −6, far from the plane, or for R = 0, beside right ones for R = −8.
#[test]
fn only_separated_systems_held_at_the_plane_are_false_contacts() {
    let hung = |id: &str, g| problem(id, Family::Separated, ["1", "1", g, "0", "10"]);
    for (g, u, n) in [("4", "5", "0"), ("10", "10", "-1")] {
        let all = [vec![hung("wrong", g); 10], vec![hung("right", "2"); 10]].concat();
        let wrong = Answer::new(number(u), number(n));
        let report = run(&all, |problem| if problem.id == "wrong" { wrong.clone() } else { right(problem) });
        assert_eq!((report.summary().wrong, report.false_contacts), (10, None), "{g}");
    }
}
