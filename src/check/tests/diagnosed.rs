//! Diagnoses from answers.

use super::programs::hand_written_edits;
use super::*;
use crate::check::diagnosis::values;
use std::cell::RefCell;

/// Returns that on the default problems.
fn changed(change: impl Fn(&Problem, Exact, Exact) -> [Exact; 2]) -> Report {
    changed_in(&default_problems(), change)
}

/// Returns the results of an edit in f64, as of a program that parses the decimals of a request.
fn in_f64(mistake: &Mistake, problem: &Problem) -> Answer {
    let system = problem.system.try_map(Exact::to_f64).unwrap();
    let eps = problem.penalty.as_ref().map(|eps| eps.to_f64().unwrap());
    let constants = Constants { penalty: eps.as_ref(), factor: None };
    let condition = mistake.results.condition.as_ref();
    let decides = condition.map_or(Some(1.0), |condition| value(condition, &system, &constants));
    let formulas = mistake.results.of_state(decides.is_some_and(|decides| decides > 0.0));
    let [u, n] = formulas.each_ref().map(|formula| value(formula, &system, &constants)?.to_exact().ok());
    Answer { deflection: u, contact_force: n, ..Answer::default() }
}

/// An edit is named, or one with the same results, in rationals and mostly in f64, unless it changes no answer beyond
/// the tolerance.
#[test]
fn every_edit_is_named() {
    let solvers: [fn(&Mistake, &Problem) -> Answer; 2] =
        [|mistake, problem| answer(&mistake.results, problem, None), in_f64];
    let (mut named, mut silent) = (0, 0);
    for problems in [default_problems(), with_penalties(default_problems())] {
        let all = edits(problems[0].penalty.is_some());
        let all_values: Vec<_> = all.iter().map(|mistake| values(mistake, None)).collect();
        for (i, mistake) in sample(&all, 80).enumerate() {
            let report = run(&problems, |problem| solvers[i % 2](mistake, problem));
            // Rounding errors in f64 may be as large as the errors.
            if report.summary().wrong < 3 || i % 2 == 1 && report.diagnosis.is_empty() {
                silent += 1;
                continue;
            }
            let results = values(mistake, None);
            let first = all_values.iter().position(|values| *values == results).unwrap();
            let name = &all[first].name;
            assert!(names(&report).contains(&name.as_str()), "{}: {:?}", mistake.name, report.diagnosis);
            assert!(report.fitting().all(|found| found.answers == DiagnosisScope::All), "{name}");
            named += 1;
        }
    }
    assert!(named > 2 * silent, "{named} are named, {silent} change nothing");
}

/// ⟨·⟩ and |·| of a deflection differ only if it is negative, which requires a penalty of the order of c.
#[test]
fn edits_that_differ_for_large_penalties_alone_are_distinct() {
    let all = edits(true);
    let [bracket, size] = ["⟨", "|"].map(|sign| {
        let start = format!("u = min(m g / c, {sign}(ε gap + m g) / (c + ε)");
        values(all.iter().find(|mistake| mistake.name.starts_with(&start)).unwrap(), None)
    });
    assert!(bracket != size);
}

/// An edit by hand in all uses, in one use, in one state, in the decision, of a parameter, or of a result.
#[test]
fn edits_have_their_names() {
    for (name, edit) in hand_written_edits() {
        let report = changed(|problem, _, _| edit(&problem.system));
        assert_eq!(names(&report), [name]);
    }
}

/// No decimal of six digits is the exact number.
#[test]
fn every_number_is_found() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for mistake in sample(numbers(problems[0].penalty.is_some()), 12) {
            let k = number(match mistake.name.as_str() {
                name if name.contains("augmentation") || name.contains("N/m") => "10000/3",
                name if name.contains("at most") || name.contains("at least") => "7/3",
                _ => "1/3",
            });
            let report = run(&problems, |problem| answer(&mistake.results, problem, Some(&k)));
            let name = mistake.name.replace("{k}", &k.decimal(6, Round::Nearest));
            // An output that is wrong by a factor is described as such.
            let is_output = names(&report).iter().all(|name| name.contains("times the right value"));
            assert!(names(&report).contains(&name.as_str()) || is_output, "{name}: {:?}", report.diagnosis);
        }
    }
}

/// u and N, from those of the right solution.
type Change = fn(&Problem, Exact, Exact) -> [Exact; 2];

#[test]
fn each_kind_of_mistake_has_its_name() {
    let table: [(&str, Change); 21] = [
        ("N / g is returned as N", |problem, u, n| [u, n / &problem.system.g]),
        ("N / (m g) is returned as N", |problem, u, n| [u, n / system::weight(&problem.system)]),
        ("the plane acts if H > l", |problem, _, _| {
            let system = &problem.system;
            let free = [structure::deflection(system), Exact::zero()];
            if system.h > system.l { [system::gap(system), system::reaction(system)] } else { free }
        }),
        ("g is always 9.81 or the negative of it", |problem, _, _| {
            let g = number(if problem.system.g > Exact::zero() { "9.81" } else { "-9.81" });
            let exact =
                Problem { system: SpringMass { g, ..problem.system.clone() }, ..problem.clone() }.solution();
            [exact.deflection, exact.contact_force]
        }),
        ("u is 1000 times the right value", |_, u, n| [u * number("1000"), n]),
        ("N is 0.001 times the right value", |_, u, n| [u, n * number("0.001")]),
        ("u and N are 1.5 times the right value", |_, u, n| [u * number("1.5"), n * number("1.5")]),
        ("u is 1000 times the right value, and N is 0.75 times the right value", |_, u, n| {
            [u * number("1000"), n * number("3/4")]
        }),
        ("u is 1e-6 m too large", |_, u, n| [u + number("1e-6"), n]),
        ("u is 0.5 m too small, and N is 2 N too large", |_, u, n| [u - number("0.5"), n + number("2")]),
        ("u and N have at most 4 digits", |_, u, n| [rounded(&u, 4), rounded(&n, 4)]),
        ("N has at most 3 digits", |_, u, n| [u, rounded(&n, 3)]),
        ("u has at most 6 decimals, and N has at most 4 digits", |_, u, n| {
            [format!("{u:.6}").parse().unwrap(), rounded(&n, 4)]
        }),
        ("u and N have at most 6 decimals", |_, u, n| {
            [u, n].map(|x| number(&format!("{:.6}", x.to_f64().unwrap())))
        }),
        ("l and H are rounded to 3 decimals", |problem, _, _| {
            with_lengths(problem, |x| number(&format!("{:.3}", x.to_f64().unwrap())))
        }),
        ("l and H are cut off after 3 decimals", |problem, _, _| {
            with_lengths(problem, |x| ((x.to_f64().unwrap() * 1e3).trunc() / 1e3).to_exact().unwrap())
        }),
        ("H is rounded to single precision", |problem, _, _| {
            with_lengths(problem, |x| match x == &problem.system.h {
                true => x.to_f32().unwrap().to_exact().unwrap(),
                false => x.clone(),
            })
        }),
        ("c, m, g, l and H are rounded to 6 digits", |problem, _, _| {
            let system = problem.system.map(|x| rounded(x, 6));
            let exact = Problem { system, ..problem.clone() }.solution();
            [exact.deflection, exact.contact_force]
        }),
        ("a barrier, N = k/(H − l − u)", |problem, _, _| on_curve(problem, &problem.system.c)),
        ("a smoothed corner, N = (R + √(R² + 4 k))/2", |problem, _, _| on_curve(problem, &number("1"))),
        ("it computes in single precision", |problem, _, _| {
            let SpringMass { c, m, g, l, h } = problem.system.try_map(Exact::to_f32).unwrap();
            let u = (m * g / c).min(h - l);
            [u, (m * g - c * u).max(0.0)].map(|x| number(&format!("{x:e}")))
        }),
    ];
    for (name, change) in table {
        let report = changed(change);
        assert_eq!(names(&report).first(), Some(&name), "{:?}", report.diagnosis);
        assert!(!report.holds() && report.conditions.is_empty(), "{name}");
    }
}

/// Returns the answers of a solver that decides wrongly for some systems in a state.
fn deciding_wrongly(state: State, is_wrong: impl Fn(&SpringMass<Exact>) -> bool) -> Report {
    changed(|problem, u, n| {
        let system = &problem.system;
        match State::of(system) == Ok(state) && is_wrong(system) {
            true if state == State::Contact => [structure::deflection(system), Exact::zero()],
            true => [system::gap(system), system::reaction(system)],
            false => [u, n],
        }
    })
}

#[test]
fn a_tolerance_of_the_program_is_located() {
    let penetration = |system: &SpringMass<Exact>| system::reaction(system).abs() / &system.c;
    let by_weight =
        |system: &SpringMass<Exact>| system::reaction(system).abs() / system::weight(system).abs();
    let by_height = |system: &SpringMass<Exact>| system::reaction(system).abs() / &system.c / system.h.abs();
    type Of<'a> = &'a dyn Fn(&SpringMass<Exact>) -> Exact;
    let quantities: [(ThresholdQuantity, &str, Of); 4] = [
        (ThresholdQuantity::Penetration, "1e-6", &penetration),
        (ThresholdQuantity::Force, "1e-2", &|system| system::reaction(system).abs()),
        (ThresholdQuantity::ForceByWeight, "1e-3", &by_weight),
        (ThresholdQuantity::PenetrationByHeight, "1e-3", &by_height),
    ];
    let states = [(State::Contact, "the plane never acts"), (State::Separated, "the plane always acts")];
    for ((quantity, most, of), (state, name)) in
        quantities.iter().flat_map(|of| states.map(|state| (of, state)))
    {
        let report = deciding_wrongly(state, |system| of(system) <= number(most));
        assert_eq!(names(&report), [name], "{quantity}");
        assert!(report.fitting().all(|found| found.answers == DiagnosisScope::Wrong));
        let found = report.conditions.iter().filter_map(|condition| condition.threshold.as_ref());
        let found = found.clone().find(|found| found.quantity == *quantity).expect(name);
        assert!(found.is_below() && found.wrong <= number(most) && number(most) < found.right, "{found:?}");
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
    let found: Vec<_> = heavy.conditions.iter().filter_map(|found| found.threshold.as_ref()).collect();
    assert!(
        found.iter().any(|found| found.quantity == ThresholdQuantity::Mass && !found.is_below()),
        "{found:?}"
    );
    let huge =
        changed(|problem, u, n| [u, if problem.system.m > number("1000") { n * number("1.001") } else { n }]);
    let found: Vec<_> = huge.conditions.iter().filter_map(|found| found.threshold.as_ref()).collect();
    assert!(
        found.iter().any(|found| found.quantity == ThresholdQuantity::Mass && !found.is_below()),
        "{found:?}"
    );
    assert!(huge.disregarded > 0, "without contact a factor of N changes nothing");
    // No quantity separates some answers: a decision is still named.
    let wrong =
        |problem: &Problem| State::of(&problem.system) == Ok(State::Separated) && problem.id.ends_with('2');
    let some = changed(|problem, u, n| {
        let system = &problem.system;
        if wrong(problem) { [system::gap(system), system::reaction(system)] } else { [u, n] }
    });
    assert!(some.conditions.is_empty(), "{:?}", some.conditions);
    assert_eq!(names(&some), ["the plane always acts"]);
    let some = changed(|problem, u, n| [u, if problem.id.ends_with('3') { n + number("1") } else { n }]);
    assert!(some.conditions.is_empty() && some.diagnosis.is_empty(), "{:?}", some.diagnosis);
}

/// The threshold lies between the two systems next to it, on either side, and not in one of them.
/// Floats represent some of these systems exactly, and others are near R = 0 for them.
#[test]
fn an_answer_without_force_is_located() {
    let report = run(&default_problems(), |problem| {
        let floats = problem.system.try_map(Exact::to_f64).unwrap();
        if system::reaction(&floats) == 0.0 { Answer::default() } else { right(problem) }
    });
    assert_eq!(report.conditions, [FailureCondition { state: Some(State::Grazing), threshold: None }]);
}

/// The error of N by the factor 1 + 0.001 H grows from below the tolerance to above it.
#[test]
fn an_error_that_grows_continuously_has_no_border() {
    let growing = |problem: &Problem, u: Exact, n: Exact| {
        [u, n * (Exact::from(1) + &problem.system.h * number("0.001"))]
    };
    assert_eq!(changed(growing).conditions, []);
}

#[test]
fn a_threshold_is_that_of_the_nearest_systems() {
    let threshold_of_mass = |problems: &[Problem], is_wrong: &dyn Fn(&Problem) -> bool| {
        let report =
            changed_in(problems, |problem, u, n| [u, if is_wrong(problem) { n + number("1") } else { n }]);
        let mut found = report.conditions.into_iter().filter_map(|found| found.threshold);
        found.find(|found| found.quantity == ThresholdQuantity::Mass)
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
    let changed = |times: &str| {
        let report = answering_again(|problem| {
            let [length, _] = assessment::scales(&problem.system);
            let off = number(times) * number(TOLERANCE) * length;
            Answer { deflection: right(problem).deflection.map(|u| u + off), ..right(problem) }
        });
        (report.changed.len(), report.repeated)
    };
    assert_eq!(changed("1").0, 0);
    let (more, all) = changed("1.001");
    assert!(more == all && all > 5);
}

/// 2 m has the effect of 2 g.
#[test]
fn parameters_with_the_same_effect_are_named() {
    let twice = run(&default_problems(), |problem| {
        let system = SpringMass { g: &problem.system.g * number("2"), ..problem.system.clone() };
        right(&Problem { system, ..problem.clone() })
    });
    let [found] = &twice.diagnosis[..] else { panic!("{:?}", names(&twice)) };
    assert_eq!(found.name, "m is 2 times the right value");
    assert_eq!(found.equivalent, ["g is 2 times the right value"]);
}

/// A single quantity rarely separates wrong answers from right ones by chance.
#[test]
fn few_systems_show_no_condition() {
    let few = problems(1, 3, &[Family::Contact, Family::Stiff]);
    let report = run(&few, |problem| match problem.family {
        Family::Stiff => Answer::new(number("7"), number("5")),
        _ => right(problem),
    });
    assert!(report.summary().wrong == 3 && report.conditions.is_empty(), "{:?}", report.conditions);
    let counts = [(0, 9), (9, 9), (1, 7), (6, 7), (2, 5), (3, 5), (4, 12), (6, 116), (110, 116)];
    let ways = counts.map(|(chosen, of)| condition::combinations(chosen, of));
    assert_eq!(ways, [1, 1, 7, 7, 10, 10, 495, 48000, 48000]);
}

/// Three wrong answers of many are separated from the others by the mass, and two are not.
#[test]
fn two_wrong_answers_of_many_show_no_condition() {
    let all = problems(1, 20, Family::ALL);
    let mut masses: Vec<_> = all.iter().map(|problem| problem.system.m.clone()).collect();
    masses.sort();
    let conditions = |count: usize| {
        let least = &masses[masses.len() - count];
        let report = changed_in(
            &all,
            |problem, u, n| {
                if problem.system.m >= *least { [number("2") * u, n] } else { [u, n] }
            },
        );
        report.conditions
    };
    assert!(conditions(2).is_empty());
    let found = conditions(3);
    assert!(
        found.iter().any(|found| found.threshold.as_ref().unwrap().quantity == ThresholdQuantity::Mass),
        "{found:?}"
    );
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
        match touches {
            true => Answer::new(system::gap(system), system::reaction(system)),
            false => Answer::new(structure::deflection(system), Exact::zero()),
        }
    });
    assert!(!stale.changed.is_empty() && stale.diagnosis.is_empty(), "{:?}", stale.diagnosis);
    let again = answering_again(|_| Answer::new(number("1"), number("1")));
    assert_eq!((again.changed.len(), again.summary().wrong), (again.repeated, 0));
    assert!(!again.holds() && again.repeated > 5);
    let silent = answering_again(|problem| Answer { contact_force: None, ..right(problem) });
    assert_eq!(silent.changed.len(), silent.repeated);
    let rights = run(&default_problems(), right);
    assert!(rights.holds() && rights.changed.is_empty() && rights.repeated == again.repeated);
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

/// Forces are at most the weight. The rounding errors of the right ones are not those of a penalty of 10¹⁵ c.
#[test]
fn rounding_errors_of_right_answers_name_nothing() {
    let limited = run(&default_problems(), |problem| {
        let SpringMass { c, m, g, l, h } = problem.system.try_map(Exact::to_f64).unwrap();
        let u = (m * g / c).min(h - l);
        let force = (m * g - c * u).max(0.0).min((m * g).abs());
        Answer::new(u.to_exact().unwrap(), force.to_exact().unwrap())
    });
    assert!(limited.summary().wrong > 2 && names(&limited).is_empty(), "{:?}", names(&limited));
}

/// A sum, or a factor, is named if several answers determine it to a hundredth.
#[test]
fn slight_sums_and_factors_are_not_named() {
    let named = |part: &str, change: &dyn Fn(Exact, Exact) -> [Exact; 2]| {
        // The scales are below 0.2 m and 20 N, and the forces are 100 N, 200 N and 300 N times the part.
        let all = [1, 2, 3].map(|i| {
            let height = number("1.1") - Exact::from(i) * number(part);
            problem(&format!("{i}"), Family::Contact, ["100", "1", "10", "1", &height.to_string()])
        });
        let report = changed_in(&all, |_, u, n| change(u, n));
        assert_eq!(report.summary().wrong, 3);
        names(&report).join("; ")
    };
    let sum = |off: &'static str| named("0.02", &move |u, n| [u + number(off), n]);
    assert_eq!([sum("2.0000000000123e-6"), sum("1.0000000000123e-4")], ["", "u is 0.0001 m too large"]);
    let factor = |part: &str| named(part, &|u, n| [u, n * number("1.5000000000000123")]);
    assert_eq!([factor("1e-5"), factor("1e-3")], ["", "N is 1.5 times the right value"]);
}

/// Penetrations up to a micrometre, forces up to a millinewton, and an equilibrium to a millinewton.
#[test]
fn an_absolute_error_is_reported() {
    let part = |problem: &Problem| number(if problem.id.len().is_multiple_of(2) { "1" } else { "0.7" });
    let bounds = |change: &dyn Fn(&Problem, Exact, Exact) -> [Exact; 2]| {
        changed(change).absolute_bounds.map(|bound| bound.map(|bound| bound.to_string()))
    };
    let off = |text: &str| Some(number(text).to_string());
    let of_u = bounds(&|problem, u, n| [u + number("1e-6") * part(problem), n]);
    assert_eq!(of_u[..2], [off("1e-6"), None]);
    let of_n = bounds(&|problem, u, n| [u, n + number("1e-3") * part(problem)]);
    assert_eq!(of_n[..2], [None, off("1e-3")]);
    let of_both = bounds(&|problem, u, n| [u + number("1e-3") * part(problem) / &problem.system.c, n]);
    assert_eq!(of_both[2], off("1e-3"));
    let relative = bounds(&|problem, u, n| [u * (number("1") + number("1e-3") * part(problem)), n]);
    assert_eq!(relative[1..], [None, None]);
}

#[test]
fn an_unrequested_penalty_is_named_with_its_scale() {
    let named = |eps: fn(&SpringMass<Exact>) -> Exact| {
        let report = run(&default_problems(), |problem| {
            right(&Problem { penalty: Some(eps(&problem.system)), ..problem.clone() })
        });
        names(&report).join("; ")
    };
    assert_eq!(named(|_| number("1e4")), "it is the penalty method, with ε = 10000 N/m");
    assert!(
        named(|system| &system.c * number("50"))
            .starts_with("it is the penalty method, with ε = 50 c, or an")
    );
    assert_eq!(named(|system| &system.m * number("7e3")), "it is the penalty method, with ε = 7000/s² m");
    // A penalty that is five times as large for half of the systems has no known form.
    assert_eq!(named(|system| number(if system.m < number("1") { "1e4" } else { "5e4" })), "");
}

/// (1.16) with ε = 3 c; the force of each step is that of the previous step, or its own.
fn steps(problem: &Problem, lagging: bool) -> Answer {
    let eps = &problem.system.c * number("3");
    let mut before = Exact::zero();
    let mut steps = Vec::new();
    for step in Augmentation::new(&problem.system, &eps).take(12) {
        let force = if lagging { before } else { step.contact_force.clone() };
        steps.push([Some(step.deflection), Some(force)]);
        before = step.contact_force;
    }
    Answer { steps, ..right(problem) }
}

#[test]
fn a_lagging_force_is_distinguished() {
    let report = run(&default_problems(), |problem| steps(problem, true));
    let lag = report.identified_mistake().unwrap();
    assert_eq!((lag.name.as_str(), lag.answers), ("N is one step behind", DiagnosisScope::Steps));
    assert_eq!(lag.program, ["N_k = m g − c u_{k−1}"]);
    assert!(!report.holds() && report.summary().right == report.results.len());
    let changed_steps = |change: &dyn Fn(&Problem, &mut Answer)| {
        let report = run(&default_problems(), |problem| {
            let mut answer = steps(problem, true);
            change(problem, &mut answer);
            answer
        });
        assert!(report.holds() && report.diagnosis.is_empty(), "{:?}", report.diagnosis);
    };
    // The force does not lag, belongs to no step, does not lag at first, or in one system.
    changed_steps(&|problem, answer| *answer = steps(problem, false));
    let other = |[_, n]: &mut [ReportedNumber; 2]| *n = n.take().map(|n| n * number("2") + number("1"));
    changed_steps(&|_, answer| answer.steps.iter_mut().for_each(other));
    changed_steps(&|problem, answer| answer.steps[..2].clone_from_slice(&steps(problem, false).steps[..2]));
    changed_steps(&|problem, answer| *answer = steps(problem, problem.id != "contact-2"));
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

/// It hides no other mistake.
#[test]
fn a_lag_is_reported_beside_a_mistake() {
    let report = run(&default_problems(), |problem| {
        let [u, n] = [system::gap(&problem.system), system::reaction(&problem.system)];
        Answer { steps: steps(problem, true).steps, ..Answer::new(u, n) }
    });
    assert_eq!(report.lag().unwrap().name, "N is one step behind");
    assert_eq!(names(&report)[0], "the plane always acts");
    assert!(report.results.iter().all(|of| matches!(&of.reply, Reply::Answered(a) if a.steps.is_empty())));
}

/// (1.16) in f64, with N of the last step or of the one before.
#[test]
fn augmentations_that_end_early_are_counted() {
    for (steps, eps, lags) in
        [(2, 1e4, false), (3, 1e3, true), (8, 1e4, false), (12, 1e3, true), (30, 1e3, true)]
    {
        let report = run(&default_problems(), |problem| {
            let system = problem.system.try_map(Exact::to_f64).unwrap();
            let (mut u, mut lambda, mut before) = (0.0, 0.0, 0.0);
            for _ in 0..steps {
                before = lambda;
                u = augmented::unilateral_deflection(&system, &eps, &lambda);
                lambda = augmented::unilateral_update(&system, &eps, &lambda, &u);
            }
            Answer::new(u.to_exact().unwrap(), if lags { before } else { lambda }.to_exact().unwrap())
        });
        let besides = if lags { ", and N is one step behind" } else { "" };
        let name = format!("the augmentation stops after {steps} steps with ε = {eps} N/m{besides}");
        assert_eq!(names(&report), [name.as_str()]);
    }
}

/// Answers that resemble a mistake which they are not.
#[test]
fn nothing_else_is_named() {
    let nothing = |what: &str, report: Report| {
        assert!(!report.holds() && report.diagnosis.is_empty(), "{what}: {:?}", report.diagnosis);
    };
    nothing(
        "one slight error",
        changed(|problem, u, n| {
            let off = if problem.id == "contact-1" { "1.000005" } else { "1" };
            [u * number(off), n]
        }),
    );
    nothing("a factor that is hardly one", changed(|_, u, n| [u, n * number("1.0000015")]));
    nothing(
        "two factors",
        changed(|problem, u, n| [u * number(if problem.id.ends_with('1') { "1000" } else { "999" }), n]),
    );
    nothing(
        "few digits of wrong numbers",
        changed(|problem, u, n| {
            let off = if problem.id.ends_with('1') { "1.01" } else { "1.02" };
            [rounded(&(u * number(off)), 4), rounded(&n, 4)]
        }),
    );
    nothing("no numbers", run(&default_problems(), |_| Answer::default()));
    nothing(
        "a missing number",
        run(&default_problems(), |problem| {
            let [u, n] = [system::gap(&problem.system), system::reaction(&problem.system)];
            let answer = Answer::new(u, n);
            if problem.id == "contact-1" { Answer { contact_force: None, ..answer } } else { answer }
        }),
    );
    // A wrong penetration beside right numbers.
    nothing(
        "a wrong penetration",
        run(&default_problems(), |problem| {
            let answer = right(problem);
            let p = contact::penetration(&problem.system, answer.deflection.as_ref().unwrap());
            Answer { penetration: Some(Some(number("1") - p)), ..answer }
        }),
    );
    // Any number with a penalty for which rounding leaves no information.
    let asked = default_problems().into_iter();
    let asked: Vec<_> = asked.map(|problem| Problem { penalty: Some(number("1e30")), ..problem }).collect();
    nothing(
        "a force that rounding leaves open",
        run(&asked, |problem| {
            let answer = right(problem);
            let force = answer.contact_force.filter(Zero::is_zero).unwrap_or(number("12345"));
            Answer { contact_force: Some(force), ..answer }
        }),
    );
    // Errors above the tolerance of the check, but below that of a diagnosis, fit every number near 1.
    nothing(
        "errors below 1e-6",
        run_within("1e-9", &problems(1, 3, &[Family::Contact]), |problem| {
            let exact = problem.solution();
            Answer::new(exact.deflection, exact.contact_force * number("1.00000001"))
        }),
    );
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
