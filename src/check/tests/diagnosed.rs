//! Diagnoses from answers.

mod kinds;
mod limits;

use super::*;

/// Returns a report on a penalty method with this penalty.
fn by_penalty(problems: &[Problem], eps: impl Fn(&SpringMass<Exact>) -> Exact) -> Report {
    run(problems, |problem| {
        let asked = Problem { penalty: Some(eps(&problem.system)), ..problem.clone() };
        right(&asked)
    })
}

#[test]
fn the_scale_of_a_penalty_is_diagnosed() {
    let all = default_problems();
    let shown = |report: Report| {
        let Penalty { kind, value, spread } = report.penalty.clone();
        assert_eq!(spread, Some(Exact::zero()));
        assert_eq!(report.identified_mistake().unwrap().name, "it is the penalty method");
        (kind, value.unwrap())
    };
    assert_eq!(shown(by_penalty(&all, |_| number("1e4"))), (PenaltyScaling::Constant, number("1e4")));
    assert_eq!(
        shown(by_penalty(&all, |system| &system.c * number("50"))),
        (PenaltyScaling::OfStiffness, number("50"))
    );
    assert_eq!(
        shown(by_penalty(&all, |system| &system.m * number("7e3"))),
        (PenaltyScaling::OfMass, number("7e3"))
    );
    // A penalty that is five times as large for half of the systems has no known form.
    let of_mass = |system: &SpringMass<Exact>| number(if system.m < number("1") { "1e4" } else { "5e4" });
    let two = by_penalty(&all, of_mass);
    assert_eq!((two.penalty.kind, two.identified_mistake()), (PenaltyScaling::None, None));
    // If two agree closely, the value of short systems is used, which has smaller rounding errors.
    let long = |system: &SpringMass<Exact>| system.l.abs() >= number("1000");
    let nearly = problems(1, 5, &[Family::Contact, Family::Far]);
    let nearly = by_penalty(&nearly, |system| number(if long(system) { "1.05e4" } else { "1e4" }));
    assert_eq!((nearly.penalty.kind, nearly.penalty.value), (PenaltyScaling::Constant, Some(number("1e4"))));
    // If c and m are the same in all systems, the penalty may be proportional to either.
    let alike = |problem: &Problem| {
        let (c, m) = (number("300"), number("2"));
        Problem { system: SpringMass { c, m, ..problem.system.clone() }, ..problem.clone() }
    };
    let alike: Vec<_> = problems(1, 9, &[Family::Overlap]).iter().map(alike).collect();
    assert_eq!(by_penalty(&alike, |_| number("1e4")).penalty.kind, PenaltyScaling::None);
    assert_eq!(run(&all, right).penalty.kind, PenaltyScaling::None);
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
    assert_eq!(lag.formula, "N_k = m g − c u_{k−1}");
    assert!(!report.holds() && report.summary().right == report.results.len());
    let report = run(&default_problems(), |problem| steps(problem, false));
    assert!(report.holds() && report.diagnosis.is_empty());
    // A force that belongs to no step does not lag.
    let report = run(&default_problems(), |problem| {
        let mut answer = steps(problem, true);
        answer.steps.iter_mut().for_each(|[_, n]| *n = n.take().map(|n| n * number("2") + number("1")));
        answer
    });
    assert!(report.holds() && report.diagnosis.is_empty());
    // One step or one system without a lag suffices.
    let report = run(&default_problems(), |problem| {
        let mut answer = steps(problem, true);
        answer.steps[..2].clone_from_slice(&steps(problem, false).steps[..2]);
        answer
    });
    assert!(report.holds() && report.diagnosis.is_empty());
    let report = run(&default_problems(), |problem| steps(problem, problem.id != "contact-2"));
    assert!(report.holds() && report.diagnosis.is_empty());
}

/// A tolerance in metres, by which the mass is separated, explains only the wrong answers.
#[test]
fn a_mistake_in_some_systems_is_diagnosed_for_those() {
    let report = run(&problems(1, 20, &Family::ALL), |problem| {
        let free = structure::deflection(&problem.system);
        let slack = contact::penetration(&problem.system, &free) < number("1e-6");
        if slack { Answer::new(free, Exact::zero()) } else { right(problem) }
    });
    let names: Vec<_> = report.diagnosis.iter().map(|d| (d.name.as_str(), d.answers)).collect();
    assert!(names.contains(&("there is no plane", DiagnosisScope::Wrong)), "{names:?}");
    let wrong = report.summary().wrong;
    assert!(report.diagnosis.iter().all(|d| (d.explained, d.of) == (wrong, wrong)) && wrong > 0);
}

/// Returns a report on answers that are all changed in the same way.
fn changed(change: impl Fn(&Problem, Exact, Exact) -> [Exact; 2]) -> Report {
    run(&problems(1, 10, &Family::ALL), |problem| {
        let exact = problem.solution();
        let [u, n] = change(problem, exact.deflection, exact.contact_force);
        Answer::new(u, n)
    })
}

#[test]
fn a_wrong_factor_is_diagnosed() {
    let name = |change: fn(&Problem, Exact, Exact) -> [Exact; 2]| {
        changed(change).identified_mistake().map(|only| only.name.clone()).unwrap_or_default()
    };
    assert_eq!(name(|_, u, n| [u * number("1000"), n]), "u is 1000 times the right value");
    assert_eq!(name(|_, u, n| [u, n * number("1/1000")]), "N is 0.001 times the right value");
    let both = name(|_, u, n| [u * number("1000"), n * number("3/4")]);
    assert_eq!(both, "u is 1000 times the right value, N is 0.75 times the right value");
    // A change of only some answers is not diagnosed.
    let some = |problem: &Problem, u: Exact, n: Exact| {
        [u * number(if problem.id.ends_with('1') { "1000" } else { "999" }), n]
    };
    assert_eq!(name(some), "");
}

/// In contact the augmentation is right; if separated, the plane pulls with ε = 10⁴ N/m.
#[test]
fn mistakes_independent_of_the_plane_are_diagnosed() {
    let eps = || number("1e4");
    let report = changed(|problem, u, n| {
        let SpringMass { c, m, g, l, h } = &problem.system;
        let pulled = (m * g + eps() * (h - l)) / (c + eps());
        if n > Exact::zero() { [u, n] } else { [pulled, n] }
    });
    let named = report.identified_mistake().map(|named| (named.name.as_str(), named.answers));
    assert_eq!(named, Some(("only the update of the augmentation is bracketed", DiagnosisScope::All)));
}

#[test]
fn a_mistake_in_the_source_is_located() {
    let edited: Vec<_> = mistakes(false).iter().filter(|mistake| mistake.name.contains(" with ")).collect();
    assert!(edited.len() > 5, "{}", edited.len());
    for mistake in edited {
        assert!(mistake.at.iter().any(|at| at.starts_with("src/chapter/")), "{}", mistake.name);
    }
}

#[test]
fn few_digits_are_diagnosed() {
    let rounded = |digits| move |x: &Exact| x.decimal(digits, Round::Nearest).parse().unwrap();
    let name = |round: &dyn Fn(&Exact) -> Exact| {
        changed(|_, u, n| [round(&u), round(&n)])
            .identified_mistake()
            .map(|only| only.name.clone())
            .unwrap_or_default()
    };
    assert_eq!(name(&rounded(4)), "its numbers have at most 4 digits");
    let fixed = |x: &Exact| {
        let millions = rug::Rational::from((x * number("1e6")).as_rational().round_ref());
        Exact::from(millions) / number("1e6")
    };
    assert_eq!(name(&fixed), "its numbers have at most 6 decimals");
    // Few digits, but not of the right values.
    let half = |x: &Exact| rounded(4)(&(x * number("1.01")));
    assert_eq!(name(&half), "");
}

/// Errors so small that every mistake with a small effect fits, or a number that fits no formula.
#[test]
fn an_unobservable_mistake_is_not_diagnosed() {
    let slight = changed(|problem, u, n| {
        let off = if problem.id == "contact-1" { "1.0000035" } else { "1" };
        [u * number(off), n]
    });
    assert_eq!((slight.summary().wrong, slight.diagnosis.len()), (1, 0));
    let nan = run(&default_problems(), |problem| {
        let mut answer = right(problem);
        answer.contact_force = answer.contact_force.filter(Zero::is_zero);
        answer
    });
    assert!(nan.summary().wrong > 0 && nan.diagnosis.is_empty(), "{:?}", nan.diagnosis);
    assert!(run(&default_problems(), |_| Answer::default()).diagnosis.is_empty());
    // Bilateral contact, except for one number that is missing.
    let nearly = run(&default_problems(), |problem| {
        let [u, n] = [system::gap(&problem.system), system::reaction(&problem.system)];
        let answer = Answer::new(u, n);
        if problem.id == "contact-1" { Answer { contact_force: None, ..answer } } else { answer }
    });
    assert!(nearly.diagnosis.is_empty(), "{:?}", nearly.diagnosis);
}

#[test]
fn a_tolerance_of_the_program_is_diagnosed() {
    let missing = |is_small: fn(&SpringMass<Exact>) -> bool| {
        let report = changed(|problem, u, n| {
            let system = &problem.system;
            let (free, reaction) = (structure::deflection(system), system::reaction(system));
            let (weight, held) = (system::weight(system).abs(), &system.c * system::gap(system));
            // Forces within the tolerance of zero, or wrong ones also for separated systems.
            let hardly = (&weight + held.abs()) * number(TOLERANCE);
            let missed = !reaction.is_zero() && is_small(system);
            if missed { [free, hardly] } else { [u, n * number("1.3") + weight * number("0.01")] }
        });
        report.missed_contacts.expect("a threshold")
    };
    let through =
        |system: &SpringMass<Exact>| structure::deflection(system) - system::gap(system) < number("1e-6");
    let Threshold { of, up_to, from, .. } = missing(through);
    assert!(
        of == ThresholdQuantity::Penetration && up_to < number("1e-6") && number("1e-6") <= from,
        "{up_to} {from}"
    );
    let Threshold { of, up_to, from, .. } = missing(|system| system::reaction(system) < number("1e-2"));
    assert!(
        of == ThresholdQuantity::Force && up_to < number("1e-2") && number("1e-2") <= from,
        "{up_to} {from}"
    );
    // No threshold of a single quantity, and no missed contact.
    let by_name = changed(|problem, u, n| {
        let free = structure::deflection(&problem.system);
        if problem.id.ends_with('3') { [free, Exact::zero()] } else { [u, n] }
    });
    assert_eq!((by_name.missed_contacts, changed(|_, u, n| [u, n]).missed_contacts), (None, None));
}

/// Missed contacts with R = 6 and 3 m of penetration, and as many others.
#[test]
fn a_threshold_refers_to_the_quantity_that_separates_best() {
    let threshold = |count: usize, c: &str, weight: &str| {
        let hung = |id: &str, c, weight| problem(id, Family::Contact, [c, "1", weight, "0", "0"]);
        let all = [vec![hung("missed", "2", "6"); count], vec![hung("found", c, weight); count]].concat();
        let report = run(&all, |problem| {
            let free = structure::deflection(&problem.system);
            if problem.id == "missed" { Answer::new(free, Exact::zero()) } else { right(problem) }
        });
        report.missed_contacts.map(|missed| (missed.of, missed.up_to, missed.from))
    };
    let of = |of, up_to, from| Some((of, number(up_to), number(from)));
    assert_eq!(threshold(10, "3", "18"), of(ThresholdQuantity::Force, "6", "18"));
    assert_eq!(threshold(10, "3/2", "9"), of(ThresholdQuantity::Penetration, "3", "6"));
    assert_eq!(threshold(10, "2", "6"), None, "some are missed and others, just the same, are not");
    assert_eq!(threshold(5, "3", "18"), None, "252 ways to choose five of ten");
}

/// Zero forces are not counted; if most forces have no penetration, they are not those of a penalty.
#[test]
fn forces_without_penetrations_tell_no_penalty() {
    let all = problems(1, 5, &[Family::Contact, Family::Separated, Family::Separated, Family::Separated]);
    let kind = |parts: &str| {
        let report = run(&all, |problem| {
            let answer = right(&Problem { penalty: Some(number("1e4")), ..problem.clone() });
            let system = &problem.system;
            let scale = system::weight(system) + &system.c * system::gap(system);
            let force = number(parts) * number(TOLERANCE) * scale;
            if answer.contact_force == Some(Exact::zero()) {
                Answer { contact_force: Some(force), ..answer }
            } else {
                answer
            }
        });
        report.penalty.kind
    };
    assert_eq!(["1", "1.001"].map(kind), [PenaltyScaling::Constant, PenaltyScaling::None]);
}

/// With a tolerance of 10⁻⁶ of the scale of the system and of the value; if |R| is smaller than that, by
/// either formula.
#[test]
fn an_answer_fits_to_the_tolerance() {
    let fits = |name: &str, [g, h]: [&str; 2], n: &str| {
        let problem = problem("own", Family::Near, ["1", "1", g, "0", h]);
        let report = run(std::slice::from_ref(&problem), |problem| Answer {
            contact_force: Some(number(n)),
            ..right(problem)
        });
        let mistake = mistakes(false).iter().find(|mistake| mistake.name == name).unwrap();
        let none = Constants { penalty: None, factor: None };
        Observation::of(&report.results[0]).unwrap().is_explained_by(mistake, &none, &number(TOLERANCE))
    };
    // N = −8 in place of 8, on a scale of 10 + 2.
    let sign = |n| fits("N has the wrong sign", ["10", "2"], n);
    assert_eq!(["-8", "-7.99998", "-8.00002"].map(sign), [true; 3]);
    assert_eq!(["-7.9999799", "-8.0000201", "8"].map(sign), [false; 3]);
    // R = ±2 on a scale of two million, and more.
    let weight = |system, n| fits("N is the weight", system, n);
    assert!(weight(["999999", "1000001"], "999999") && weight(["999999", "1000001"], "0"));
    assert!(weight(["1000001", "999999"], "1000001") && weight(["1000001", "999999"], "0"));
    assert!(!weight(["999998.9", "1000001"], "999998.9") && !weight(["1000001.1", "999999"], "0"));
}

/// Answers that resemble a mistake which they are not.
#[test]
fn no_wrong_diagnosis_is_made() {
    // As accurate as single precision, but in double precision.
    let exact = run(&problems(3, 5, &Family::ALL), |problem| {
        let Answer { deflection, contact_force, .. } = right(problem);
        let off = if problem.id == "contact-1" { "1.000005" } else { "1.00000001" };
        let n = contact_force.map(|n| (n * number(off)).to_f64().unwrap().to_exact().unwrap());
        Answer { deflection, contact_force: n, ..Answer::default() }
    });
    assert!(exact.summary().wrong > 0 && exact.diagnosis.is_empty(), "{:?}", exact.diagnosis);
    // A factor that does not count, and one that applies to all answers.
    let slight = changed(|_, u, n| [u, n * number("1.0000015")]);
    assert!(slight.diagnosis.is_empty(), "{:?}", slight.diagnosis);
    let nothing = changed(|_, u, _| [u, Exact::zero()]);
    assert_eq!(nothing.identified_mistake().unwrap().name, "N is always 0");
    // Any number with a penalty for which rounding leaves no information.
    let asked: Vec<_> = default_problems()
        .into_iter()
        .map(|problem| Problem { penalty: Some(number("1e30")), ..problem })
        .collect();
    let garbage = run(&asked, |problem| {
        let answer = right(problem);
        let force = answer.contact_force.filter(Zero::is_zero).unwrap_or(number("12345"));
        Answer { contact_force: Some(force), ..answer }
    });
    assert!(!garbage.holds() && garbage.diagnosis.is_empty(), "{:?}", garbage.diagnosis);
    let findings = garbage.results.iter().filter_map(|of| of.assessment.finding.as_deref());
    assert!(findings.clone().count() > 0 && findings.clone().all(|finding| !finding.contains("rounding")));
}

#[test]
fn a_start_is_no_step() {
    let report = run(&problems(1, 9, &[Family::Contact]), |problem| {
        let answer = right(problem);
        let start = [Some(system::gap(&problem.system)), Some(Exact::zero())];
        Answer { steps: vec![start, [answer.deflection.clone(), answer.contact_force.clone()]], ..answer }
    });
    assert!(report.holds() && report.diagnosis.is_empty(), "{:?}", report.diagnosis);
}

#[test]
fn a_lag_hides_no_mistake() {
    let report = run(&default_problems(), |problem| {
        let [u, n] = [system::gap(&problem.system), system::reaction(&problem.system)];
        Answer { steps: steps(problem, true).steps, ..Answer::new(u, n) }
    });
    assert_eq!(report.lag().unwrap().name, "N is one step behind");
    assert_eq!(report.identified_mistake().unwrap().name, "the plane also pulls");
    assert!(report.results.iter().all(|of| matches!(&of.reply, Reply::Answered(a) if a.steps.is_empty())));
}

/// A single quantity rarely separates contacts missed by chance or for another reason.
#[test]
fn a_threshold_is_not_diagnosed_from_few_systems() {
    let few = problems(1, 5, &[Family::Contact, Family::Stiff]);
    let report = run(&few, |problem| {
        if problem.family == Family::Stiff {
            Answer::new(structure::deflection(&problem.system), Exact::zero())
        } else {
            right(problem)
        }
    });
    assert!(report.summary().wrong >= 2 && report.missed_contacts.is_none(), "{:?}", report.missed_contacts);
}

/// One answer could have any error, and two could as well, or determine a factor.
#[test]
fn two_answers_show_nothing() {
    let few = |families: &[Family], change: fn(Exact, Exact) -> [Exact; 2]| {
        let report = run(&problems(1, 1, families), |problem| {
            let exact = problem.solution();
            let [u, n] = change(exact.deflection, exact.contact_force);
            Answer::new(u, n)
        });
        assert!(report.summary().wrong > 0);
        report.diagnosis.iter().map(|d| d.name.clone()).collect::<Vec<_>>()
    };
    let one = [Family::Contact];
    let digits = |u: Exact, n: Exact| [u, n].map(|x| x.decimal(4, Round::Nearest).parse().unwrap());
    let three = [Family::Stiff, Family::Soft, Family::Separated];
    assert_eq!(few(&three, digits), ["its numbers have at most 4 digits"]);
    assert!(few(&three[..2], digits).is_empty());
    let more = |u: Exact, n: Exact| [u, n * number("1.3")];
    let three = [Family::Contact, Family::Overlap, Family::Soft];
    assert_eq!(few(&three, more), ["N is 1.3 times the right value"]);
    assert!(few(&three[..2], more).is_empty());
    assert!(few(&one, more).is_empty());
}

/// A mass that touches the plane with zero free length and zero gap.
#[test]
fn without_a_length_scale_no_penalty_is_diagnosed_from_penetrations() {
    let no_length = |problem: &Problem| {
        let SpringMass { c, m, g, .. } = problem.system.clone();
        Problem { system: SpringMass { c, m, g, l: Exact::zero(), h: Exact::zero() }, ..problem.clone() }
    };
    let all: Vec<_> = problems(1, 3, &[Family::Contact]).iter().map(no_length).collect();
    let report = run(&all, |_| Answer::new(Exact::zero(), number("1")));
    assert!(!report.holds() && report.penalty.kind == PenaltyScaling::None);
}
