//! Agreement of answers with programs, and the numbers that are computed from answers.

use super::*;
use crate::check::observation::Agreement;
use crate::number::Tree;

/// Returns a value that is computed from an answer with its problem.
fn observed<T>(problem: &Problem, answer: Answer, value: impl FnOnce(Observation) -> T) -> T {
    let result = CaseResult::of(0, problem, Reply::Answered(Box::new(answer)), &number(TOLERANCE));
    value(Observation::of(0, &result, &number(TOLERANCE)).unwrap())
}

/// Either state explains an answer if |R| is at most 10⁻⁶ of the scale, here 2 N and 2.000001 N.
#[test]
fn a_state_is_open_near_grazing() {
    let states = ["1000001", "1000002"].map(|h| {
        let problem = problem("own", Family::Near, ["1", "1", "999999", "0", h]);
        observed(&problem, right(&problem), |answer| answer.state)
    });
    assert_eq!(states, [None, Some(State::Separated)]);
}

/// A program that divides by 0 has no number, and gives an answer without one.
#[test]
fn a_missing_number_agrees_with_a_missing_number() {
    let [c, l] = ["c", "l"].map(|name| Tree::symbol(name));
    let problem = problem("own", Family::Contact, ["4", "1", "10", "0", "1"]);
    let exact = problem.solution();
    let divided = Program::without_branches(&[], [&c / &l, Tree::from(6)]);
    let agreement = |deflection: ReportedNumber| {
        let answer = Answer { deflection, ..Answer::new(Exact::zero(), exact.contact_force.clone()) };
        observed(&problem, answer, |answer| answer.agreement(&divided, None, &number(TOLERANCE)))
    };
    assert_eq!(agreement(None), Agreement::Possible);
    assert_eq!(agreement(Some(exact.deflection.clone())), Agreement::No);
}

/// The rounding error of H − l is 10⁻¹⁰ m: a hundredth of an error of 1 m, but not of one of 10⁻⁸ m.
#[test]
fn a_program_agrees_clearly_if_its_rounding_errors_are_small() {
    let problem = problem("own", Family::Contact, ["4", "1", "10", "1000000.1", "1000001.1"]);
    let exact = problem.solution();
    let agreement = |part: i32, off: &str| {
        let by = Tree::from(1) / Tree::from(part);
        let program =
            Program::without_branches(&[], [Tree::symbol("H") - Tree::symbol("l") + by, Tree::from(6)]);
        let u = &exact.deflection + Exact::from(1) / Exact::from(part) + number(off);
        let answer = Answer::new(u, exact.contact_force.clone());
        observed(&problem, answer, |answer| answer.agreement(&program, None, &number("1e-30")))
    };
    let found = [(1, "1e-11"), (100_000_000, "1e-11"), (1, "1e-9")].map(|(part, off)| agreement(part, off));
    assert_eq!(found, [Agreement::Clear, Agreement::Possible, Agreement::No]);
}

/// With ε = 7 N/m u is 3 m, N is 7 N, and the errors are at most 2⁻²¹ of 14 m and of 7 · 14 N + 16 N.
#[test]
fn errors_of_single_precision_are_bounded() {
    let own = problem("own", Family::Contact, ["1", "1", "10", "1", "3"]);
    let problem = Problem { penalty: Some(number("7")), ..own };
    let is_single = |units: [i32; 2]| {
        let [u, n] = [3, 7].map(Exact::from);
        let [off_u, off_n] = units.map(|n| Exact::from(n) * Exact::power_of_two(-21));
        observed(&problem, Answer::new(u + off_u, n + off_n), |answer| answer.is_single())
    };
    assert_eq!([[14, 114], [15, 114], [14, 115]].map(is_single), [true, false, false]);
}

/// Within the tolerance, within the rounding error, or rounded once, where the system is not in the range of f64.
#[test]
fn parameters_explain_an_answer_within_its_errors() {
    let explains = |[l, h]: [&str; 2], c: &str, tolerance: &str, off: &str| {
        let problem = problem("own", Family::Contact, [c, "1", "10", l, h]);
        let exact = problem.solution();
        let answer = Answer::new(exact.deflection + number(off), exact.contact_force);
        observed(&problem, answer, |answer| {
            answer.is_explained_by_parameters(&problem.system, &number(tolerance))
        })
    };
    let near = |off: &str| explains(["1", "2"], "1", "1e-6", off);
    // The scale is 1 m + 10 m.
    assert_eq!(["1.1e-5", "1.2e-5"].map(near), [true, false]);
    let rounded = |off: &str| explains(["1000000.1", "1000001.1"], "1", "1e-30", off);
    assert_eq!(["1e-11", "1e-9"].map(rounded), [true, false]);
    let once = |off: &str| explains(["0.1", "0.4"], "1e-400", "1e-500", off);
    assert_eq!(["1e-18", "1e-15"].map(once), [true, false]);
    // Parameters that make a system unsolvable explain nothing.
    let problem = problem("own", Family::Contact, ["1", "1", "10", "1", "2"]);
    for (c, m) in [("0", "1"), ("1", "0"), ("-1", "1")] {
        let system = SpringMass { c: number(c), m: number(m), ..problem.system.clone() };
        assert!(!observed(&problem, right(&problem), |answer| {
            answer.is_explained_by_parameters(&system, &number("1"))
        }));
    }
}

/// The constant of a contact law is that of the most accurate answer, the first, the last or another. A force deviates
/// by a hundredth in a system with a hundred times the forces, and another by 10⁻⁶ N for R = −5 N.
#[test]
fn a_constant_is_that_of_the_most_accurate_answer() {
    let grazing = |c: &str, by: &str| {
        let [c, load, by] = [c, "10", by].map(number);
        let gap = (load - by) / &c;
        problem(
            &c.to_string(),
            Family::Contact,
            [&c.to_string(), "1", "10", "1", &(gap + number("1")).to_string()],
        )
    };
    let accurate =
        [("100", "0.1"), ("125", "-0.2"), ("160", "0.3"), ("200", "-5")].map(|(c, by)| grazing(c, by));
    let large = problem("large", Family::Contact, ["100", "1", "1000", "1", "11"]);
    for place in [0, 2, 4] {
        let mut all = accurate.to_vec();
        all.insert(place, large.clone());
        let report = run(&all, |problem| {
            let [u, n] = on_curve(&problem.system, &number("1"));
            let off = number(match problem.id.as_str() {
                "large" => "0.001",
                "200" => "1e-6",
                _ => "0",
            });
            Answer::new(u - &off / &problem.system.c, n + off)
        });
        assert_eq!(names(&report), ["a smoothed corner, N = (R + √(R² + 4 k))/2"]);
        assert_eq!(report.diagnosis[0].program, ["k = 0.01 N²"]);
    }
}

/// Three systems with the same scale, 0.15 m: 10⁻⁴ of it is not clear, more is.
#[test]
fn a_sum_of_a_hundred_tolerances_is_not_named() {
    let all = [("11", "1.04"), ("10", "1.05"), ("9", "1.06")]
        .map(|(g, h)| problem(g, Family::Contact, ["100", "1", g, "1", h]));
    let named = |sum: &str| {
        let report = changed_in(&all, |_, u, n| [u + number(sum), n]);
        assert_eq!(report.summary().wrong, 3);
        names(&report).join("; ")
    };
    assert_eq!(["1.5e-5", "1.6e-5"].map(named), ["", "u is 1.6e-5 m too large"]);
}

/// The force of 2 N in a system with forces of two million N does not determine the factor.
#[test]
fn a_factor_is_that_of_the_largest_force_relative_to_its_system() {
    let mut all = problems(1, 4, &[Family::Contact]);
    all.push(problem("large", Family::Contact, ["1", "1", "1000001", "0", "999999"]));
    let report = changed_in(&all, |problem, u, n| {
        let off = number(if problem.id == "large" { "1" } else { "0" });
        [u, n * number("1.5") + off]
    });
    assert_eq!(names(&report), ["N is 1.5 times the right value"]);
}

/// 4.35 · 100 is below 435 in f64.
#[test]
fn decimals_are_cut_off_exactly() {
    let all = [("4.35", "4.4012"), ("1.15", "1.2034"), ("2.3", "2.3561")]
        .map(|(l, h)| problem(l, Family::Contact, ["100.37", "1", "10", l, h]));
    let hundred = number("100");
    let report = changed_in(&all, |problem, _, _| {
        with_lengths(&problem.system, |x| {
            Exact::from((x * &hundred).as_rational().clone().trunc()) / &hundred
        })
    });
    assert_eq!(names(&report), ["l and H are cut off after 2 decimals"]);
}

/// 0.35 · 100 is 35 in f64, though the float is below 0.35; 1.15 · 100 is below 115.
#[test]
fn decimals_are_cut_off_as_by_a_program_in_floats() {
    let all = [("0.35", "0.4012"), ("1.15", "1.2034"), ("0.7", "0.7561")]
        .map(|(l, h)| problem(l, Family::Contact, ["100.37", "1", "10", l, h]));
    let report = changed_in(&all, |problem, _, _| {
        with_lengths(&problem.system, |x| ((x.to_f64().unwrap() * 100.0).trunc() / 100.0).to_exact().unwrap())
    });
    assert_eq!(names(&report), ["l and H are cut off after 2 decimals"]);
}

/// Two wrong answers of few digits show nothing, whatever the number of right ones.
#[test]
fn right_answers_of_few_digits_show_nothing() {
    let mut all = problems(1, 1, &[Family::Stiff, Family::Soft]);
    all.extend(["1", "2", "3"].map(|l| {
        problem(l, Family::Contact, ["100", "1", "10", l, &(number(l) + number("0.05")).to_string()])
    }));
    let report = changed_in(&all, |_, u, n| [rounded(&u, 4), rounded(&n, 4)]);
    assert_eq!((report.summary().wrong, report.summary().right), (2, 3));
    assert!(names(&report).is_empty(), "{:?}", names(&report));
}

/// Most errors are of a similar size although the scales, 0.15 m times the factors, differ by a thousand.
#[test]
fn similar_absolute_errors_of_different_systems_are_a_bound() {
    let bound = |factors: &[&str], errors: &[&str]| {
        let all = Vec::from_iter((0..factors.len()).map(|i| {
            let stiffness = number("100") / number(factors[i]);
            let height = number("1") + number("0.05") * number(factors[i]);
            let parameters = [&stiffness.to_string(), "1", "10", "1", &height.to_string()];
            problem(&i.to_string(), Family::Contact, parameters)
        }));
        // N is wrong in any case.
        let report = changed_in(&all, |problem, u, n| {
            [u + number(errors[problem.id.parse::<usize>().unwrap()]), n * number("1.5")]
        });
        report.absolute_bounds[0].as_ref().map(|bound| bound.to_string())
    };
    let of = |text: &str| Some(number(text).to_string());
    assert_eq!(bound(&["1", "1000", "2000"], &["1e-3", "1e-3", "2e-4"]), None);
    assert_eq!(bound(&["1", "1000", "2000"], &["1e-3", "1e-3", "4e-4"]), of("1e-3"));
    assert_eq!(bound(&["1", "2", "3"], &["1e-3", "1e-3", "1e-3"]), None);
    assert_eq!(bound(&["1", "1000", "1"], &["1e-3", "1e-3", "9.9e-5"]), None);
    assert_eq!(bound(&["1", "1000", "1"], &["1e-3", "1e-3", "1e-4"]), of("1e-3"));
    let [three, four] =
        [3, 4].map(|large| ["1e-3"; 4][..large].iter().chain(&["1e-5"; 3]).copied().collect::<Vec<_>>());
    assert_eq!(bound(&["1", "1000", "1", "1", "1", "1"], &three), None);
    assert_eq!(bound(&["1", "1000", "1", "1", "1", "1", "1"], &four), of("1e-3"));
    // The tolerance of the second is 1.5e-4 m.
    assert_eq!(bound(&["1", "1000", "1"], &["1.5e-4", "1.5e-4", "1.5e-4"]), None);
    assert_eq!(bound(&["1", "1000", "1"], &["1.6e-4", "1.6e-4", "1.6e-4"]), of("1.6e-4"));
    let forces = changed_in(&default_problems(), |problem, u, n| {
        [u, n + number(if problem.id.ends_with('1') { "1" } else { "2" })]
    });
    let two = Some(number("2"));
    assert_eq!(forces.absolute_bounds, [None, two.clone(), two]);
}

/// The errors of a table whose rows are shifted are of all sizes.
#[test]
fn shifted_rows_have_no_absolute_bound() {
    let all = default_problems();
    let next: HashMap<_, _> = all.iter().zip(all.iter().cycle().skip(1)).map(|(a, b)| (&a.id, b)).collect();
    let report = run(&all, |problem| right(next[&problem.id]));
    assert!(report.diagnosis.is_empty() && report.absolute_bounds == [None, None, None], "{report:?}");
}
