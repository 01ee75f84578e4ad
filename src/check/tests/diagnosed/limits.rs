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

/// Wrong answers for R = −6 on a scale of 14, far from the plane or near it, or for R = 0, beside right ones
/// for R = −8.
#[test]
fn only_separated_systems_held_at_the_plane_are_false_contacts() {
    let hung = |id: &str, g| problem(id, Family::Separated, ["1", "1", g, "0", "10"]);
    for (g, u, n, held) in [
        ("4", "5", "-0.00001", None),
        ("4", "9.99999", "0", Some(10)),
        ("4", "9.99998", "0", None),
        ("4", "5", "-0.00002", Some(10)),
        ("10", "10", "-1", None),
    ] {
        let all = [vec![hung("wrong", g); 10], vec![hung("right", "2"); 10]].concat();
        let wrong = Answer::new(number(u), number(n));
        let report = run(&all, |problem| if problem.id == "wrong" { wrong.clone() } else { right(problem) });
        let found = report.false_contacts.as_ref().map(|threshold| threshold.count);
        assert_eq!((report.summary().wrong, found), (10, held), "{g} {u} {n}");
    }
}

/// A program in f64 whose lengths have three decimals, with a tolerance far below its rounding errors.
#[test]
fn rounding_errors_do_not_hide_few_decimals() {
    let report = run_within("1e-30", &problems(1, 10, &[Family::Contact]), |problem| {
        let SpringMass { c, m, g, l, h } = problem.system.try_map(Exact::to_f64).unwrap();
        let [l, h] = [l, h].map(|x| format!("{x:.3}").parse::<f64>().unwrap());
        let gap = h - l;
        Answer::new(gap.to_exact().unwrap(), (m * g - c * gap).to_exact().unwrap())
    });
    let names: Vec<_> = report.diagnosis.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names, ["it uses at most 3 decimals of l and H"]);
}
