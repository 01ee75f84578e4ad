//! Diagnoses from answers.

use super::*;
use std::cell::RefCell;

/// Returns that on the default problems.
fn changed(change: impl Fn(&Problem, Exact, Exact) -> [Exact; 2]) -> Report {
    changed_in(&default_problems(), change)
}

/// u and N, from the system and those of the right solution.
type Change = fn(&SpringMass<Exact>, Exact, Exact) -> [Exact; 2];

fn by_penalty(s: &SpringMass<Exact>, eps: Exact) -> [Exact; 2] {
    solution(s.clone(), Some(eps))
}

/// Returns the answer with the force of equilibrium, or without the plane.
fn if_positive(decides: Exact, [u, n]: [Exact; 2], s: &SpringMass<Exact>) -> [Exact; 2] {
    if decides > Exact::zero() { [u, n] } else { free(s) }
}

fn free(s: &SpringMass<Exact>) -> [Exact; 2] {
    [structure::deflection(s), Exact::zero()]
}

fn held(s: &SpringMass<Exact>) -> [Exact; 2] {
    [system::gap(s), system::reaction(s)]
}

/// (1.16) in f64, with N of the last step or of the one before.
fn augmented(s: &SpringMass<Exact>, steps: usize, eps: f64, lags: bool) -> [Exact; 2] {
    let system = s.as_ref().try_map(Exact::to_f64).unwrap();
    let (mut u, mut lambda, mut before) = (0.0, 0.0, 0.0);
    for _ in 0..steps {
        before = lambda;
        u = augmented::unilateral_deflection(&system, &eps, &lambda);
        lambda = augmented::unilateral_update(&system, &eps, &lambda, &u);
    }
    [u, if lags { before } else { lambda }].map(|x| x.to_exact().unwrap())
}

/// Edits by hand in all uses, in one use, in one state, in the decision, of a parameter, or of a result; then parameters
/// with an unknown number, results, digits, laws and methods. The other names have the same effect.
#[test]
fn each_mistake_has_its_name() {
    let table: [(&str, Change); 45] = [
        ("u = min(g / c, gap) instead of min(m g / c, gap)", |s, _, _| {
            let u = (&s.g / &s.c).min(system::gap(s));
            let force = system::weight(s) - structure::spring_force(s, &u);
            [u, force.positive_part()]
        }),
        ("R = m g + c gap instead of m g − c gap", |s, _, _| {
            let reaction = system::weight(s) + &s.c * system::gap(s);
            if_positive(reaction.clone(), [system::gap(s), reaction], s)
        }),
        ("in contact u = H + l instead of H − l", |s, _, _| {
            if_positive(system::reaction(s), [&s.h + &s.l, system::reaction(s)], s)
        }),
        ("N = ⟨m g − c (H + l)⟩ instead of ⟨m g − c (H − l)⟩", |s, u, _| {
            [u, (system::weight(s) - &s.c * (&s.h + &s.l)).positive_part()]
        }),
        ("the plane acts if −R > 0 instead of if R > 0", |s, _, _| {
            if_positive(-system::reaction(s), held(s), s)
        }),
        ("in contact N = m − c u instead of m g − c u", |s, _, _| {
            if_positive(system::reaction(s), [system::gap(s), &s.m - &s.c * system::gap(s)], s)
        }),
        ("without contact u = m g instead of m g / c", |s, u, n| {
            if system::reaction(s) > Exact::zero() { [u, n] } else { [system::weight(s), n] }
        }),
        ("|m g − c (H − l)| is returned as N", |s, u, _| [u, system::reaction(s).abs()]),
        ("the plane acts if H > l", |s, _, _| if_positive(system::gap(s), held(s), s)),
        ("the plane always acts", |s, _, _| held(s)),
        ("the plane never acts", |s, _, _| free(s)),
        ("the mass is held at the plane, with N = 0", |s, _, _| [system::gap(s), Exact::zero()]),
        ("c and m are swapped", |s, _, _| solved(&s.m, &s.c, &s.g, &s.l, &s.h)),
        ("0 is used for l", |s, _, _| solved(&s.c, &s.m, &s.g, &Exact::zero(), &s.h)),
        ("l + u − H is returned as u", |s, u, n| [contact::penetration(s, &u), n]),
        ("m g + c u is returned as N", |s, u, _| {
            let force = system::weight(s) + structure::spring_force(s, &u);
            [u, force]
        }),
        ("N / g is returned as N", |s, u, n| [u, n / &s.g]),
        ("N / (m g) is returned as N", |s, u, n| [u, n / system::weight(s)]),
        ("m is 2 times the right value; g is 2 times the right value", |s, _, _| {
            solved(&s.c, &s.m, &(&s.g * number("2")), &s.l, &s.h)
        }),
        ("g is always 9.81 or the negative of it", |s, _, _| {
            let g = number(if s.g > Exact::zero() { "9.81" } else { "-9.81" });
            solved(&s.c, &s.m, &g, &s.l, &s.h)
        }),
        ("u is 1000 times the right value", |_, u, n| [u * number("1000"), n]),
        ("N is 0.001 times the right value", |_, u, n| [u, n * number("0.001")]),
        ("u and N are 1.5 times the right value", |_, u, n| [u, n].map(|x| x * number("1.5"))),
        ("u is 1000 times the right value, and N is 0.75 times the right value", |_, u, n| {
            [u * number("1000"), n * number("3/4")]
        }),
        ("u is 1e-6 m too large", |_, u, n| [u + number("1e-6"), n]),
        ("u is 0.5 m too small, and N is 2 N too large", |_, u, n| [u - number("0.5"), n + number("2")]),
        ("u and N have at most 4 digits", |_, u, n| [u, n].map(|x| rounded(&x, 4))),
        ("N has at most 3 digits", |_, u, n| [u, rounded(&n, 3)]),
        ("u has at most 6 decimals, and N has at most 4 digits", |_, u, n| {
            [number(&format!("{u:.6}")), rounded(&n, 4)]
        }),
        ("u and N have at most 6 decimals", |_, u, n| [u, n].map(|x| decimals(&x, 6))),
        ("l and H are rounded to 3 decimals", |s, _, _| with_lengths(s, |x| decimals(x, 3))),
        ("l and H are cut off after 3 decimals", |s, _, _| {
            with_lengths(s, |x| ((x.to_f64().unwrap() * 1e3).trunc() / 1e3).to_exact().unwrap())
        }),
        ("H is rounded to single precision", |s, _, _| {
            solved(&s.c, &s.m, &s.g, &s.l, &s.h.to_f32().unwrap().to_exact().unwrap())
        }),
        ("c, m, g, l and H are rounded to 6 digits", |s, _, _| {
            solution(s.as_ref().map(|x| rounded(x, 6)), None)
        }),
        ("it computes in single precision", |s, _, _| {
            let SpringMass { c, m, g, l, h } = s.as_ref().try_map(Exact::to_f32).unwrap();
            let u = (m * g / c).min(h - l);
            [u, (m * g - c * u).max(0.0)].map(|x| number(&format!("{x:e}")))
        }),
        ("a barrier, N = k/(H − l − u)", |s, _, _| on_curve(s, &s.c)),
        ("a smoothed corner, N = (R + √(R² + 4 k))/2", |s, _, _| on_curve(s, &number("1"))),
        ("it is the penalty method, with ε = 10000 N/m", |s, _, _| by_penalty(s, number("1e4"))),
        ("it is the penalty method, with ε = 7000/s² m", |s, _, _| by_penalty(s, &s.m * number("7e3"))),
        (
            "it is the penalty method, with ε = 50 c, or an iteration that always stops after the same number of steps",
            |s, _, _| by_penalty(s, &s.c * number("50")),
        ),
        ("the augmentation stops after 2 steps with ε = 10000 N/m", |s, _, _| augmented(s, 2, 1e4, false)),
        ("the augmentation stops after 3 steps with ε = 1000 N/m, and N is one step behind", |s, _, _| {
            augmented(s, 3, 1e3, true)
        }),
        ("the augmentation stops after 8 steps with ε = 10000 N/m", |s, _, _| augmented(s, 8, 1e4, false)),
        ("the augmentation stops after 12 steps with ε = 1000 N/m, and N is one step behind", |s, _, _| {
            augmented(s, 12, 1e3, true)
        }),
        ("the augmentation stops after 30 steps with ε = 1000 N/m, and N is one step behind", |s, _, _| {
            augmented(s, 30, 1e3, true)
        }),
    ];
    let all = problems(1, 3, Family::ALL);
    for (name, change) in table {
        let report = changed_in(&all, |problem, u, n| change(&problem.system, u, n));
        assert_eq!(names(&report).join("; "), name, "{:?}", report.diagnosis);
        assert!(!report.holds() && report.conditions.is_empty(), "{name}");
    }
}

/// Returns the answers of a solver that decides wrongly for some systems in a state.
fn deciding_wrongly(state: State, is_wrong: impl Fn(&SpringMass<Exact>) -> bool) -> Report {
    changed(|problem, u, n| {
        let system = &problem.system;
        match State::of(system) == Ok(state) && is_wrong(system) {
            true if state == State::Contact => free(system),
            true => held(system),
            false => [u, n],
        }
    })
}

/// Returns the threshold of a quantity among the conditions.
fn threshold(report: &Report, quantity: ThresholdQuantity) -> Option<&Threshold> {
    let mut found = report.conditions.iter().filter_map(|condition| condition.threshold.as_ref());
    found.find(|found| found.quantity == quantity)
}

#[test]
fn a_tolerance_of_the_program_is_located() {
    type Quantity = fn(&SpringMass<Exact>) -> Exact;
    let quantities: [(ThresholdQuantity, &str, Quantity); 4] = [
        (ThresholdQuantity::Penetration, "1e-6", |s| system::reaction(s).abs() / &s.c),
        (ThresholdQuantity::Force, "1e-2", |s| system::reaction(s).abs()),
        (ThresholdQuantity::ForceByWeight, "1e-3", |s| system::reaction(s).abs() / system::weight(s).abs()),
        (ThresholdQuantity::PenetrationByHeight, "1e-3", |s| system::reaction(s).abs() / &s.c / s.h.abs()),
    ];
    for (quantity, most, of) in quantities {
        for (state, name) in
            [(State::Contact, "the plane never acts"), (State::Separated, "the plane always acts")]
        {
            let report = deciding_wrongly(state, |system| of(system) <= number(most));
            assert_eq!(names(&report), [name], "{quantity}");
            assert_eq!(report.diagnosis[0].answers, DiagnosisScope::Wrong);
            let found = threshold(&report, quantity).expect(name);
            assert!(
                found.is_below() && found.wrong <= number(most) && number(most) < found.right,
                "{found:?}"
            );
        }
    }
}

#[test]
fn a_state_or_a_parameter_separates_wrong_answers() {
    let apart = changed(|_, u, n| if n.is_zero() { [u + number("1e-3"), n] } else { [u, n] });
    assert_eq!(names(&apart), ["u is 0.001 m too large"]);
    let condition = FailureCondition { state: Some(State::Separated), threshold: None };
    assert_eq!(apart.conditions, [condition]);
    let heavy =
        changed(|problem, u, n| [u, if problem.system.m > number("50") { n * number("1.01") } else { n }]);
    assert_eq!(names(&heavy), ["N is 1.01 times the right value"]);
    assert!(!threshold(&heavy, ThresholdQuantity::Mass).unwrap().is_below());
    assert!(heavy.disregarded > 0, "without contact a factor of N changes nothing");
    // No quantity separates some answers: a decision is still named.
    let some = changed(|problem, u, n| {
        let is_wrong = State::of(&problem.system) == Ok(State::Separated) && problem.id.ends_with('2');
        if is_wrong { held(&problem.system) } else { [u, n] }
    });
    assert_eq!((names(&some), &some.conditions[..]), (vec!["the plane always acts"], &[][..]));
    let some = changed(|problem, u, n| [u, if problem.id.ends_with('3') { n + number("1") } else { n }]);
    assert!(some.conditions.is_empty() && some.diagnosis.is_empty(), "{:?}", some.diagnosis);
}

/// The threshold lies between the two systems next to it, on either side, and not in one of them.
/// Floats represent some of these systems exactly, and others are near R = 0 for them.
#[test]
fn an_answer_without_force_is_located() {
    let report = run(&default_problems(), |problem| {
        let floats = problem.system.as_ref().try_map(Exact::to_f64).unwrap();
        if system::reaction(&floats) == 0.0 { Answer::default() } else { right(problem) }
    });
    assert_eq!(report.conditions, [FailureCondition { state: Some(State::Grazing), threshold: None }]);
}

#[test]
fn a_threshold_is_that_of_the_nearest_systems() {
    let threshold_of_mass = |problems: &[Problem], is_wrong: &dyn Fn(&Problem) -> bool| {
        let report =
            changed_in(problems, |problem, u, n| [u, if is_wrong(problem) { n + number("1") } else { n }]);
        threshold(&report, ThresholdQuantity::Mass).cloned()
    };
    let mut problems = problems(1, 20, &[Family::Contact, Family::Separated]);
    let is_heavy = |problem: &Problem| problem.system.m > number("5");
    let (heavy, light): (Vec<_>, Vec<_>) = problems.iter().partition(|problem| is_heavy(problem));
    let mass = |problem: &&Problem| problem.system.m.clone();
    let (least, most) = (heavy.iter().map(mass).min().unwrap(), light.iter().map(mass).max().unwrap());
    let expected = |[wrong, right]: [&Exact; 2]| {
        Some(Threshold { quantity: ThresholdQuantity::Mass, wrong: wrong.clone(), right: right.clone() })
    };
    assert_eq!(threshold_of_mass(&problems, &is_heavy), expected([&least, &most]));
    assert_eq!(threshold_of_mass(&problems, &|problem| !is_heavy(problem)), expected([&most, &least]));
    // One of two systems with the same mass has a wrong answer.
    let same = problems.iter().find(|problem| problem.system.m == least).unwrap().clone();
    problems.push(Problem { id: "same".to_string(), ..same });
    let is_other = |problem: &Problem| is_heavy(problem) && problem.id != "same";
    assert_eq!(threshold_of_mass(&problems, &is_other), None);
    assert_eq!(threshold_of_mass(&problems, &|problem| !is_other(problem)), None);
}

/// Returns the report on a solver whose first answers are right, and whose second ones are these.
fn answering_again(again: impl Fn(&Problem) -> Answer) -> Report {
    let asked = RefCell::new(HashSet::new());
    run(&default_problems(), |problem| {
        let is_first = asked.borrow_mut().insert(problem.id.clone());
        if is_first { right(problem) } else { again(problem) }
    })
}

/// A second answer may differ from the first by the tolerance.
#[test]
fn the_tolerance_of_a_repeated_answer_is_the_border() {
    for (times, changes) in [("1", false), ("1.001", true)] {
        let report = answering_again(|problem| {
            let [length, _] = scales(&problem.system);
            let off = number(times) * number(TOLERANCE) * length;
            Answer { deflection: right(problem).deflection.map(|u| u + off), ..right(problem) }
        });
        assert_eq!(report.changed.len(), if changes { report.repeated } else { 0 });
        assert!(report.repeated > 5 && report.holds() != changes);
    }
}

/// A single quantity rarely separates wrong answers from right ones by chance: three wrong answers of many are
/// separated from the others by the mass, and two are not.
#[test]
fn two_wrong_answers_of_many_show_no_condition() {
    let all = problems(1, 20, Family::ALL);
    let mut masses: Vec<_> = all.iter().map(|problem| problem.system.m.clone()).collect();
    masses.sort();
    for (count, is_shown) in [(2, false), (3, true)] {
        let least = &masses[masses.len() - count];
        let is_wrong = |problem: &Problem| problem.system.m >= *least;
        let report =
            changed_in(&all, |problem, u, n| if is_wrong(problem) { [number("2") * u, n] } else { [u, n] });
        assert_eq!(threshold(&report, ThresholdQuantity::Mass).is_some(), is_shown, "{count}");
    }
    let counts = [(0, 9), (9, 9), (1, 7), (6, 7), (2, 5), (3, 5), (4, 12), (6, 116), (110, 116)];
    let ways = counts.map(|(chosen, of)| condition::combinations(chosen, of));
    assert_eq!(ways, [1, 1, 7, 7, 10, 10, 495, 48000, 48000]);
}

/// Answers with errors of 2·10⁻⁷ are right within the tolerance; those with errors ten times as large jump.
#[test]
fn only_errors_that_jump_show_a_condition() {
    let all = problems(1, 14, &[Family::Stiff, Family::Soft]);
    for (wrong, is_shown) in [("1.99e-6", false), ("2e-6", true)] {
        let report = changed_in(&all, |problem, u, n| {
            let [length, _] = scales(&problem.system);
            let is_wrong = problem.system.m > number("5");
            [u + number(if is_wrong { wrong } else { "2e-7" }) * length, n]
        });
        assert_eq!(threshold(&report, ThresholdQuantity::Mass).is_some(), is_shown, "{wrong}");
    }
}

#[test]
fn the_gap_of_a_condition_is_relative_to_its_larger_value() {
    let gap = |wrong: &str, right: &str| {
        let [wrong, right] = [wrong, right].map(number);
        Threshold { quantity: ThresholdQuantity::Mass, wrong, right }.gap()
    };
    let gaps = [gap("1", "4"), gap("4", "1"), gap("-4", "-1"), gap("-1", "4"), gap("2", "4")];
    assert_eq!(gaps, ["3/4", "3/4", "3/4", "5/4", "1/2"].map(number));
}

/// Answers by c and m alone, and the state of the request before.
#[test]
fn what_is_carried_over_is_noticed() {
    let known = RefCell::new(HashMap::new());
    let cached = run(&default_problems(), |problem| {
        let SpringMass { c, m, .. } = &problem.system;
        let key = format!("{c} {m}");
        known.borrow_mut().entry(key).or_insert_with(|| right(problem)).clone()
    });
    assert!(cached.carried_over.len() >= 3 && cached.changed.is_empty(), "{:?}", cached.carried_over);
    assert!(cached.diagnosis.is_empty() && cached.conditions.is_empty(), "{:?}", cached.diagnosis);
    let before = RefCell::new(true);
    let stale = run(&default_problems(), |problem| {
        let system = &problem.system;
        let touches = before.replace(system::reaction(system) > Exact::zero());
        let [u, n] = if touches { held(system) } else { free(system) };
        Answer::new(u, n)
    });
    assert!(!stale.changed.is_empty() && stale.diagnosis.is_empty(), "{:?}", stale.diagnosis);
    let silent = answering_again(|problem| Answer { contact_force: None, ..right(problem) });
    assert_eq!(silent.changed.len(), silent.repeated);
    let rights = run(&default_problems(), right);
    assert!(rights.holds() && rights.changed.is_empty() && rights.repeated == silent.repeated);
}

/// Returns one of two numbers for light, and for heavy masses.
fn one_of_two(s: &SpringMass<Exact>, [light, heavy]: [&str; 2]) -> Exact {
    number(if s.m < number("1") { light } else { heavy })
}

/// Returns the solution by one of two penalties, with a force that is too large by a part of c p.
fn nearly_balanced(s: &SpringMass<Exact>, part: &str) -> [Exact; 2] {
    let [u, n] = by_penalty(s, one_of_two(s, ["700", "900"]) * &s.c);
    let excess = number(part) * &s.c * contact::penetration(s, &u).positive_part();
    [u, n + excess]
}

/// One of two penalties, in N/m or in c. Without equilibrium, without penetration, or with two wrong answers there is none.
#[test]
fn unexplained_answers_have_an_apparent_penalty() {
    type Range = (&'static str, [&'static str; 2]);
    let table: [(Change, Option<Range>); 7] = [
        (|s, _, _| by_penalty(s, one_of_two(s, ["1e4", "5e4"])), Some(("N/m", ["1e4", "5e4"]))),
        (|s, _, _| by_penalty(s, one_of_two(s, ["700", "900"]) * &s.c), Some(("c", ["700", "900"]))),
        (
            |s, _, _| {
                let [u, n] = by_penalty(s, one_of_two(s, ["1e4", "5e4"]));
                [u, n * number("1.01")]
            },
            None,
        ),
        (|s, u, n| [u - one_of_two(s, ["0.1", "0.2"]) * system::gap(s).abs(), n], None),
        (|s, _, _| nearly_balanced(s, "0.009"), Some(("c", ["700.009", "900.009"]))),
        (|s, _, _| nearly_balanced(s, "0.011"), None),
        // In equilibrium above the plane.
        (
            |s, _, _| {
                let [u, n] = by_penalty(s, one_of_two(s, ["700", "900"]) * &s.c);
                if n.is_zero() { [u - number("1"), s.c.clone()] } else { [u, n] }
            },
            None,
        ),
    ];
    let few = problems(1, 2, Family::ALL);
    for (place, (change, expected)) in table.into_iter().enumerate() {
        let report = changed_in(&few, |problem, u, n| change(&problem.system, u, n));
        let expected = expected.map(|(unit, range)| ApparentPenalty { unit, range: range.map(number) });
        assert_eq!(report.apparent_penalty, expected, "{place}");
    }
    let all = problems(1, 2, &[Family::Contact]);
    let two = changed_in(&all, |of, _, _| by_penalty(&of.system, one_of_two(&of.system, ["1e4", "5e4"])));
    assert_eq!(two.apparent_penalty, None);
    // N = ε p, where p of a rounded u is a multiple of 2⁻⁵³ m.
    let rounded = run_within("1e-11", &default_problems(), |problem| {
        let eps = one_of_two(&problem.system, ["1e9", "4e9"]) * &problem.system.c;
        let u = by_penalty(&problem.system, eps.clone())[0].to_f64().unwrap().to_exact().unwrap();
        let n = eps * contact::penetration(&problem.system, &u).positive_part();
        Answer::new(u, n)
    });
    assert_eq!(rounded.apparent_penalty.unwrap().range, ["1e9", "4e9"].map(number));
}

/// Returns u(1 − error), and N in equilibrium, as a damped Newton method leaves them that starts from 0.
fn damped([u, n]: [Exact; 2], s: &SpringMass<Exact>, error: &str) -> [Exact; 2] {
    let u = u * (Exact::from(1) - number(error));
    if n.is_zero() { [u, n] } else { [u.clone(), system::weight(s) - structure::spring_force(s, &u)] }
}

/// The error is similar in most answers, in both states, and in N: not if only a penalty or a parameter has it, or the
/// output has few digits.
#[test]
fn iterations_that_stop_early_are_named() {
    type Change = fn(&Problem, [Exact; 2]) -> [Exact; 2];
    let table: [(&str, &str, Change); 11] = [
        ("1e-9", "the formulas are right up to ", |of, exact| damped(exact, &of.system, "1/300000000")),
        ("1e-6", "the formulas are right up to ", |of, exact| damped(exact, &of.system, "1/300000")),
        ("1e-6", "the plane always acts up to ", |of, _| damped(held(&of.system), &of.system, "1/300000")),
        ("1e-6", "the plane never acts up to ", |of, _| damped(free(&of.system), &of.system, "1/300000")),
        ("1e-9", "", |of, _| by_penalty(&of.system, number("1e8") * &of.system.c)),
        ("1e-9", "", |_, [u, n]| [u, n * number("1.00000001")]),
        ("1e-9", "", |_, [u, n]| [u * number("1.0000000123456789"), n]),
        (
            "1e-9",
            "",
            |of, [u, n]| if n.is_zero() { damped([u, n], &of.system, "1/300000000") } else { [u, n] },
        ),
        ("1e-12", "", |_, exact| exact.map(|x| rounded(&x, 10))),
        ("1e-6", "", |of, exact| damped(exact, &of.system, "0.01")),
        ("1e-9", "", |of, exact| {
            let is_small = of.id.ends_with(['1', '4', '7', '0']);
            damped(exact, &of.system, if is_small { "1/300000000000" } else { "1/300000000" })
        }),
    ];
    for (place, (tolerance, name, change)) in table.into_iter().enumerate() {
        let report = run_within(tolerance, &problems(1, 3, Family::ALL), |problem| {
            let [u, n] = change(problem, solution(problem.system.clone(), None));
            Answer::new(u, n)
        });
        let found = names(&report);
        let is_named = found.len() == 1 && found[0].ends_with(", as an iteration that stops early leaves");
        assert_eq!((is_named, found.is_empty()), (!name.is_empty(), name.is_empty()), "{place}: {found:?}");
        if is_named {
            let (_, error) = found[0].split_once(name).unwrap();
            let error = number(error.split(',').next().unwrap());
            // |u| is at most its scale, and half of it where m g/c = H − l; the error is rounded up to two digits.
            let most = number(if tolerance == "1e-9" { "3.4e-9" } else { "3.4e-6" });
            assert!(error <= most && error >= most / number("2"), "{place}: {error}");
        }
    }
    // Errors are relative to the size of a system, and rounding errors are not.
    let huge = run_within("1e-9", &problems(1, 12, &[Family::Huge]), |problem| {
        let [u, n] = damped(solution(problem.system.clone(), None), &problem.system, "1/300000000");
        Answer::new(u, n)
    });
    assert_eq!(names(&huge).len(), 1);
}

/// Errors of less than a hundred rounding errors, and of a wrong program that is nearly right near grazing.
#[test]
fn other_errors_are_not_those_of_an_iteration() {
    // The rounding error of H − l is 10⁻¹³ m, and the error of u is 10⁻¹¹ m.
    let long = ["1001.1", "1002.1", "1004.1", "1014.1", "1015.1", "1016.1"]
        .map(|h| problem(h, Family::Far, ["1", "1", "10", "1000.1", h]));
    let hidden = run_within("1e-13", &long, |problem| {
        let [u, n] = damped(solution(problem.system.clone(), None), &problem.system, "1/300000000000");
        Answer::new(u, n)
    });
    assert!(hidden.summary().wrong == 6 && names(&hidden).is_empty(), "{:?}", names(&hidden));
    let near = ["9.99987654321231", "9.99987654321232", "9.99987654321233", "12", "13", "14"]
        .map(|h| problem(h, Family::Near, ["1", "1", "10", "0", h]));
    let off_apart = run_within("1e-9", &near, |problem| {
        let [u, n] = solution(problem.system.clone(), None);
        let error = (number("13.1") - &problem.system.h) * number("1.23456789012e-4");
        Answer::new(if n.is_zero() { u + error } else { u }, n)
    });
    assert!(off_apart.summary().wrong == 3 && names(&off_apart).is_empty(), "{:?}", names(&off_apart));
}

fn with_twice_c(s: &SpringMass<Exact>) -> [Exact; 2] {
    solved(&(&s.c * number("2")), &s.m, &s.g, &s.l, &s.h)
}

/// Signs, units, factors and sums of u and N with a mistake behind them.
#[test]
fn a_mistake_behind_a_convention_is_named() {
    let twice = "c is 2 times the right value";
    let table: [(&str, &str, Change); 8] = [
        ("−N is returned as N", twice, |s, _, _| {
            let [u, n] = with_twice_c(s);
            [u, -n]
        }),
        ("1000 u is returned as u", "the plane always acts", |s, _, _| {
            let [u, n] = held(s);
            [u * number("1000"), n]
        }),
        ("−u is returned as u", "the plane never acts", |s, _, _| free(s).map(|x| -x)),
        ("−u is returned as u, and −N is returned as N", twice, |s, _, _| with_twice_c(s).map(|x| -x)),
        ("0.001 u is returned as u", twice, |s, _, _| {
            let [u, n] = with_twice_c(s);
            [u * number("0.001"), n]
        }),
        ("-1000 u is returned as u", twice, |s, _, _| {
            let [u, n] = with_twice_c(s);
            [u * number("-1000"), n]
        }),
        ("-0.001 u is returned as u", twice, |s, _, _| {
            let [u, n] = with_twice_c(s);
            [u * number("-0.001"), n]
        }),
        ("u + 0.5 m is returned as u", twice, |s, _, _| {
            let [u, n] = with_twice_c(s);
            [u + number("0.5"), n]
        }),
    ];
    for (convention, mistake, change) in table {
        let report = changed_in(&problems(1, 3, Family::ALL), |problem, u, n| change(&problem.system, u, n));
        let name = format!("with the convention that {convention}, {mistake}");
        assert_eq!(names(&report), [name.as_str()]);
        assert_eq!(report.identified_mistake().unwrap().name, name);
    }
    // Near is relative to the size of a system.
    let huge = changed_in(&problems(1, 12, &[Family::Huge]), |problem, _, _| {
        let [u, n] = with_twice_c(&problem.system);
        [u * number("-1.00000001"), n]
    });
    assert_eq!(names(&huge), [format!("with the convention that −u is returned as u, {twice}")]);
    // Three forces show their sign, and three right deflections show millimetres. Two do not.
    let mistakes: [Change; 2] = [
        |s, _, _| {
            let [u, n] = solved(&s.c, &s.m, &(&s.g * number("3/2")), &s.l, &s.h);
            [u, -n]
        },
        |s, u, n| [number("1000") * if n.is_zero() { system::weight(s) } else { u }, n],
    ];
    for (convention, change) in ["−N is returned as N", "1000 u is returned as u"].into_iter().zip(mistakes)
    {
        for (contacts, is_named) in [(3, true), (2, false)] {
            let mut all = problems(1, 4, &[Family::Separated, Family::Overlap]);
            all.retain(|problem| solution(problem.system.clone(), None)[1].is_zero());
            all.extend(problems(1, contacts, &[Family::Contact]));
            let report = changed_in(&all, |problem, u, n| change(&problem.system, u, n));
            let is_found = names(&report).iter().any(|name| name.contains(convention));
            assert_eq!(is_found, is_named, "{convention}: {contacts}, {:?}", names(&report));
        }
    }
}

/// Answers of a table have no order: the same ones show neither that they are carried over, nor a border of requests.
#[test]
fn a_table_has_no_order() {
    let all = problems(1, 20, &[Family::Contact, Family::Neighbour]);
    let carried = |problem: &Problem| {
        let is_base = problem.family == Family::Contact || problem.id.len() > "neighbour-9".len();
        right(if is_base { problem } else { &all[0] })
    };
    let late = |problem: &Problem| {
        let place = all.iter().position(|other| other == problem).unwrap();
        let [u, n] = solution(problem.system.clone(), None);
        Answer::new(u, if place < 30 { n } else { n * number("1.5") + number(&place.to_string()) })
    };
    let answers: [&dyn Fn(&Problem) -> Answer; 2] = [&carried, &late];
    let findings = |report: &Report| {
        let is_border = threshold(report, ThresholdQuantity::Position).is_some();
        (!report.carried_over.is_empty(), is_border)
    };
    for (answer, expected) in answers.into_iter().zip([(true, false), (false, true)]) {
        assert_eq!(findings(&run(&all, answer)), expected);
        let rows = all.iter().map(|problem| (problem.clone(), Reply::Answered(Box::new(answer(problem)))));
        let report = check_table(rows.collect(), &number(TOLERANCE));
        assert_eq!((findings(&report), report.repeated, report.holds()), ((false, false), 0, false));
    }
}

/// Three answers show that a base is answered for its neighbours, two do not.
#[test]
fn three_answers_are_carried_over() {
    let all = problems(1, 20, &[Family::Contact, Family::Neighbour]);
    let carried_over = |last: &str| {
        let report = run(&all, |problem| match problem.id.as_str() {
            "neighbour-1" | "neighbour-2" => right(&all[0]),
            id if id == last => right(&all[0]),
            "neighbour-3" => Answer::new(number("0.7"), number("0.3")),
            _ => right(problem),
        });
        assert_eq!(report.summary().wrong, 3);
        report.carried_over.len()
    };
    assert_eq!([carried_over("neighbour-3"), carried_over("none")], [3, 0]);
}

/// The constant of a contact law is named if several answers determine it to a hundredth.
#[test]
fn a_slight_corner_is_not_named() {
    let all = ["0", "1", "2"].map(|l| {
        problem(l, Family::Grazing, ["100", "1", "10", l, &(number(l) + number("0.1")).to_string()])
    });
    let report = run(&all, |problem| {
        let force = number("1.0000000000123e-3");
        Answer::new((system::weight(&problem.system) - &force) / &problem.system.c, force)
    });
    assert_eq!((report.summary().wrong, names(&report)), (3, vec![]));
}

/// (1.16) with ε = 3 c; the force of each step is that of the previous step, or its own.
fn steps(problem: &Problem, lagging: bool) -> Answer {
    let eps = &problem.system.c * number("3");
    let mut before = Exact::zero();
    let mut steps = Vec::new();
    for step in Augmentation::new(&problem.system, &eps).take(12) {
        let force = if lagging { &before } else { &step.contact_force };
        steps.push([Some(step.deflection), Some(rounded(force, 12))]);
        before = step.contact_force;
    }
    Answer { steps, ..right(problem) }
}

/// It hides no other mistake.
#[test]
fn a_lagging_force_is_distinguished() {
    let report = run(&default_problems(), |problem| steps(problem, true));
    let lag = report.identified_mistake().unwrap();
    assert_eq!((lag.name.as_str(), lag.answers), ("N is one step behind", DiagnosisScope::Steps));
    assert!(!report.holds() && report.summary().right == report.results.len());
    assert!(report.results.iter().all(|of| matches!(&of.reply, Reply::Answered(a) if a.steps.is_empty())));
    let besides = run(&default_problems(), |problem| {
        let [u, n] = held(&problem.system);
        Answer { steps: steps(problem, true).steps, ..Answer::new(u, n) }
    });
    assert_eq!((besides.lag(), names(&besides)[0]), (Some(lag), "the plane always acts"));
    // The force does not lag, belongs to no step, does not lag at first, or in one system.
    let changes: [fn(&Problem, &mut Answer); 4] = [
        |problem, answer| *answer = steps(problem, false),
        |_, answer| {
            let other =
                |[_, n]: &mut [ReportedNumber; 2]| *n = n.take().map(|n| n * number("2") + number("1"));
            answer.steps.iter_mut().for_each(other);
        },
        |problem, answer| answer.steps[..2].clone_from_slice(&steps(problem, false).steps[..2]),
        |problem, answer| *answer = steps(problem, problem.id != "contact-2"),
    ];
    for change in changes {
        let report = run(&default_problems(), |problem| {
            let mut answer = steps(problem, true);
            change(problem, &mut answer);
            answer
        });
        assert!(report.holds() && report.diagnosis.is_empty(), "{:?}", report.diagnosis);
    }
    // Two pairs of steps decide it, one does not, and the start is not a step.
    let is_lagging = |count: usize| {
        let report = run(&problems(1, 3, &[Family::Contact]), |problem| {
            let mut answer = steps(problem, true);
            answer.steps.truncate(count);
            answer
        });
        report.lag().is_some()
    };
    assert_eq!([2, 3].map(is_lagging), [false, true]);
}

/// Answers that resemble a mistake which they are not.
#[test]
fn nothing_else_is_named() {
    type Change = fn(&Problem, Exact, Exact) -> [Exact; 2];
    let changes: [(&str, Change); 8] = [
        ("one slight error", |problem, u, n| {
            [u * number(if problem.id == "contact-1" { "1.000005" } else { "1" }), n]
        }),
        ("a factor that is hardly one", |_, u, n| [u, n * number("1.0000015")]),
        ("two factors", |problem, u, n| {
            [u * number(if problem.id.ends_with('1') { "0.001" } else { "0.0010003" }), n]
        }),
        ("few digits of wrong numbers", |problem, u, n| {
            let off = number(if problem.id.ends_with('1') { "1.01" } else { "1.02" });
            [u * off, n].map(|x| rounded(&x, 4))
        }),
        ("penalties of no known form", |problem, _, _| {
            let system = &problem.system;
            by_penalty(system, number(if system.m < number("1") { "1e4" } else { "5e4" }))
        }),
        (
            "forces of at most the weight, whose rounding errors are not those of a penalty of 10¹⁵ c",
            |problem, _, _| {
                let SpringMass { c, m, g, l, h } = problem.system.as_ref().try_map(Exact::to_f64).unwrap();
                let u = (m * g / c).min(h - l);
                [u, (m * g - c * u).max(0.0).min((m * g).abs())].map(|x| x.to_exact().unwrap())
            },
        ),
        ("forces without contact", |problem, u, n| {
            let off = &problem.system.h * &problem.system.m;
            [u, if n.is_zero() { off } else { n }]
        }),
        ("errors that grow from below the tolerance to above it", |problem, u, n| {
            [u, n * (Exact::from(1) + &problem.system.h * number("0.001"))]
        }),
    ];
    let nothing = |what: &str, report: Report| {
        assert!(!report.holds() && report.diagnosis.is_empty(), "{what}: {:?}", report.diagnosis);
    };
    let few = problems(1, 2, Family::ALL);
    for (what, change) in changes {
        let report = changed_in(&few, change);
        assert!(!what.starts_with("errors") || report.conditions.is_empty(), "{:?}", report.conditions);
        nothing(what, report);
    }
    // A factor has to be clear, and a penalty positive.
    let separated = problems(1, 5, &[Family::Separated]);
    let unequal: Change =
        |problem, u, n| [u * number(if problem.id.ends_with('1') { "1" } else { "1.0000095" }), n];
    nothing("errors of 0 and 1e-5", changed_in(&separated, unequal));
    let k = number("1.7e-5");
    let negative = changed_in(&separated, |problem, u, n| {
        [(u - &k * system::gap(&problem.system)) / (Exact::from(1) - &k), n]
    });
    assert!(names(&negative).iter().all(|name| !name.contains('ε')), "{:?}", names(&negative));
    nothing("no numbers", run(&default_problems(), |_| Answer::default()));
    let missing = |problem: &Problem| {
        let [u, n] = held(&problem.system);
        let contact_force = Some(n).filter(|_| problem.id != "contact-1");
        Answer { deflection: Some(u), contact_force, ..Answer::default() }
    };
    nothing("a missing number", run(&default_problems(), missing));
    let penetrating = |problem: &Problem| {
        let answer = right(problem);
        let p = contact::penetration(&problem.system, answer.deflection.as_ref().unwrap());
        Answer { penetration: Some(Some(number("1") - p)), ..answer }
    };
    nothing("a wrong penetration beside right numbers", run(&default_problems(), penetrating));
    let asked = default_problems().into_iter();
    let asked: Vec<_> = asked.map(|problem| Problem { penalty: Some(number("1e30")), ..problem }).collect();
    let any_force = |problem: &Problem| {
        let answer = right(problem);
        let force = answer.contact_force.filter(Zero::is_zero).unwrap_or(number("12345"));
        Answer { contact_force: Some(force), ..answer }
    };
    nothing("any force where a penalty leaves it open by rounding", run(&asked, any_force));
    // They fit every number near 1.
    let slightly_off = run_within("1e-9", &problems(1, 3, &[Family::Contact]), |problem| {
        let [u, n] = solution(problem.system.clone(), None);
        Answer::new(u, n * number("1.00000001"))
    });
    nothing("errors above the tolerance of the check, but below that of a diagnosis", slightly_off);
}

/// One answer could have any error, and two could as well, or determine a number.
#[test]
fn two_answers_show_nothing() {
    let named = |families: &[Family], change: fn(Exact, Exact) -> [Exact; 2]| {
        let report = changed_in(&problems(1, 1, families), |_, u, n| change(u, n));
        assert!(report.summary().wrong > 0);
        report.diagnosis.iter().map(|found| found.name.clone()).collect::<Vec<_>>()
    };
    let digits = |u: Exact, n: Exact| [rounded(&u, 4), rounded(&n, 4)];
    let three = [Family::Stiff, Family::Soft, Family::Separated];
    assert_eq!(named(&three, digits), ["u and N have at most 4 digits"]);
    assert!(named(&three[..2], digits).is_empty());
    let more = |u: Exact, n: Exact| [u, n * number("1.3")];
    let three = [Family::Contact, Family::Overlap, Family::Soft];
    assert_eq!(named(&three, more), ["N is 1.3 times the right value"]);
    assert!(named(&three[..2], more).is_empty() && named(&three[..1], more).is_empty());
}

/// The only wrong answer is that for H = 1000.05 in single precision; all numbers have ten digits.
#[test]
fn a_rounded_parameter_takes_three_wrong_answers() {
    let name_if = |wrong: usize| {
        let all = [0, 1, 2, 3].map(|i| {
            let [l, h] = if i < wrong { ["1000", "1000.05"] } else { ["1000", "1000.0625"] };
            problem(&i.to_string(), Family::Contact, ["100", &format!("1.{i}2345678901"), "10", l, h])
        });
        let report = changed_in(&all, |problem, _, _| {
            let single = |x: &Exact| x.to_f32().unwrap().to_exact().unwrap();
            with_lengths(&problem.system, single).map(|x| rounded(&x, 10))
        });
        assert_eq!(report.summary().wrong, wrong);
        names(&report).concat()
    };
    assert_eq!([1, 2, 3].map(name_if), ["", "", "l and H are rounded to single precision"]);
}

/// A wrong decision is noticed from the force on that the report on a right solver states.
#[test]
fn a_wrong_decision_is_noticed_from_the_stated_force_on() {
    for state in [State::Contact, State::Separated] {
        let least = run(&default_problems(), right).least_deciding(state, &number(TOLERANCE)).unwrap();
        for (most, holds) in [(least.clone(), false), (&least * number("0.999"), true)] {
            assert_eq!(deciding_wrongly(state, |system| part(system) <= most).holds(), holds, "{most}");
        }
    }
}
