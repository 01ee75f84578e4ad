//! Assessment of answers, and counts.

use super::*;

fn assess(problem: &Problem, answer: Answer, tolerance: &str) -> Assessment {
    Assessment::of(problem, &Reply::Answered(Box::new(answer)), &number(tolerance))
}

#[test]
fn a_correct_program_has_no_diagnosis() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        let in_f64 = |problem: &Problem| {
            let system = problem.system.as_ref().try_map(Exact::to_f64).unwrap();
            let method = match &problem.penalty {
                None => Method::Lagrange,
                Some(penalty) => Method::Penalty { penalty: penalty.to_f64().unwrap() },
            };
            let answer = solve(&system, &method).unwrap();
            let [u, n] = [answer.deflection, answer.contact_force].map(|x| x.to_exact().unwrap());
            Answer { penetration: Some(answer.penetration.to_exact().ok()), ..Answer::new(u, n) }
        };
        for report in [run(&problems, right), run(&problems, in_f64)] {
            assert_eq!(report.summary(), VerdictCounts { right: problems.len(), ..VerdictCounts::default() });
            assert!(report.holds() && report.diagnosis.is_empty());
        }
    }
}

/// Rounded once to f64 and written with the digits that identify it, for every tolerance: also with a large
/// penalty, and where the bound of rounding is larger than the system or smaller than half an ulp.
#[test]
fn the_exact_answer_rounded_once_is_right() {
    let penalties = [None, Some("1e8"), Some("1e12"), Some("3.7e15")];
    for (seed, penalty) in (1..=3).flat_map(|seed| penalties.map(|penalty| (seed, penalty))) {
        for problem in problems(seed, 40, Family::ALL) {
            let problem = Problem { penalty: penalty.map(number), ..problem };
            assert_rounded_once_is_right(&problem);
        }
    }
    problems(2, 420, &[Family::Stiff]).iter().for_each(assert_rounded_once_is_right);
}

fn assert_rounded_once_is_right(problem: &Problem) {
    let exact = problem.solution();
    let [u, p, n] =
        [exact.deflection, exact.penetration, exact.contact_force].map(|x| x.to_f64().unwrap().to_string());
    let answer = Answer { penetration: Some(Some(number(&p))), ..Answer::new(number(&u), number(&n)) };
    let judged = assess(problem, answer, "1e-30");
    assert_eq!(
        judged.verdict,
        AnswerVerdict::Right,
        "{}, {:?}: {:?}",
        problem.id,
        problem.penalty,
        judged.finding
    );
}

/// An error equal to the tolerance is accepted, a slightly larger one is not: u, N and the penetration, which is that
/// of u, each on its own scale.
#[test]
fn the_tolerance_is_the_border() {
    let problem = &problems(1, 1, &[Family::Contact])[0];
    let SpringMass { c, .. } = &problem.system;
    let [gap, weight] = [system::gap(&problem.system), system::weight(&problem.system)];
    let scales = [&gap + &weight / c, &weight + c * &gap, &gap + &weight / c];
    for (i, factor, verdict) in [
        (0, "1", AnswerVerdict::WithinTolerance),
        (0, "-1", AnswerVerdict::WithinTolerance),
        (0, "-1.0000001", AnswerVerdict::Wrong),
        (1, "1", AnswerVerdict::WithinTolerance),
        (1, "1.0000001", AnswerVerdict::Wrong),
        (2, "1", AnswerVerdict::Right),
        (2, "-1", AnswerVerdict::Right),
        (2, "-1.01", AnswerVerdict::Wrong),
    ] {
        let Answer { mut deflection, mut contact_force, .. } = right(problem);
        let mut p = deflection.as_ref().map(|u| contact::penetration(&problem.system, u));
        let changed = [&mut deflection, &mut contact_force, &mut p][i].as_mut().unwrap();
        *changed = &*changed + number(factor) * number(TOLERANCE) * &scales[i];
        let penetration = (i == 2).then_some(p);
        let answer = Answer { deflection, contact_force, penetration, ..Answer::default() };
        let assessment = assess(problem, answer, TOLERANCE);
        assert_eq!(assessment.verdict, verdict, "{i}, {factor}");
        let error = if i < 2 { (number(factor) * number(TOLERANCE)).abs() } else { Exact::zero() };
        assert_eq!(assessment.error(), Some(&error));
    }
    // The penetration is that of a deflection whose error is the tolerance.
    let u = right(problem).deflection.unwrap() + number(TOLERANCE) * &scales[0];
    let own = contact::penetration(&problem.system, &u);
    let verdict = |p: &Exact| {
        let answer = Answer { deflection: Some(u.clone()), ..right(problem) };
        assess(problem, Answer { penetration: Some(Some(p.clone())), ..answer }, TOLERANCE).verdict
    };
    assert_eq!([&own, &-&own].map(verdict), [AnswerVerdict::WithinTolerance, AnswerVerdict::Wrong]);
}

/// The plane counts as active if |N| exceeds the tolerance; another state is wrong if the error of N exceeds
/// it.
#[test]
fn a_wrong_state_is_reported_if_it_matters() {
    let finding = |family: Family, parts: &str| {
        let problem = &problems(1, 1, &[family])[0];
        let weight = system::weight(&problem.system);
        let scale = weight + &problem.system.c * system::gap(&problem.system);
        assert!(scale > number("1"));
        let u = right(problem).deflection.unwrap() + number("1");
        let answer = Answer::new(u, number(parts) * number(TOLERANCE) * scale);
        let assessment = assess(problem, answer, TOLERANCE);
        assert_eq!(assessment.verdict, AnswerVerdict::Wrong);
        assessment.finding.unwrap_or_default()
    };
    let in_contact = |parts| finding(Family::Contact, parts);
    for free in ["0.5", "1", "-1"].map(in_contact) {
        assert_eq!(free, "according to its answer the mass is separated; exactly, the plane pushes");
    }
    assert_eq!(in_contact("-1.01"), "according to its answer the plane pulls; exactly, the plane pushes");
    assert_eq!(["1.01", "3e6"].map(in_contact), ["", ""]);
    assert_eq!(finding(Family::Grazing, "1"), "", "no further off than the tolerance");
    let touching = "according to its answer the plane pushes; exactly, they touch without force";
    assert_eq!(finding(Family::Grazing, "1.01"), touching);
}

/// Returns the right answer for this multiple of the penalty, which it states.
fn right_with(problem: &Problem, factor: &str) -> Answer {
    let used = problem.penalty.as_ref().unwrap() * number(factor);
    let mut answer = right(&Problem { penalty: Some(used.clone()), ..problem.clone() });
    answer.used.penalty = Some(Some(used));
    answer
}

/// The problem is solved with the parameters used; residuals are those of the numbers, if there are two.
#[test]
fn the_penalty_that_was_used_is_the_one_that_counts() {
    let problem = with_penalties(problems(1, 1, &[Family::Contact])).remove(0);
    let answer = right_with(&problem, "1.0000005");
    let assessment = |answer: Answer| assess(&problem, answer, TOLERANCE);
    let judged = assessment(answer.clone());
    assert_eq!((judged.verdict, judged.force_error), (AnswerVerdict::Right, Some(Exact::zero())));
    let [u, n] = [answer.deflection.as_ref().unwrap(), answer.contact_force.as_ref().unwrap()];
    assert_eq!(judged.kkt, Some(contact::kkt(&problem.system, u, n)));
    assert_eq!(assessment(Answer { deflection: None, ..answer.clone() }).kkt, None);
}

/// Additional values of an answer are checked.
#[test]
fn findings_describe_the_error() {
    let problem = &problems(1, 1, &[Family::Contact])[0];
    type Change = fn(&mut Answer);
    let wrong: [(&str, Change); 6] = [
        ("its deflection is not a number", |answer| answer.deflection = None),
        ("its contact force is not a number", |answer| answer.contact_force = None),
        ("its penetration is not a number", |answer| answer.penetration = Some(None)),
        ("its penetration is 0.1, but that of its", |answer| answer.penetration = Some(Some(number("0.1")))),
        ("it used a value for height = ", |answer| answer.used.system.h = Some(None)),
        ("it used stiffness = 0 instead of 30", |answer| answer.used.system.c = Some(Some(Exact::zero()))),
    ];
    for (finding, change) in wrong {
        let mut answer = right(problem);
        change(&mut answer);
        // c = 0 differs from 30 by less than this tolerance, but is not positive.
        let assessment = assess(problem, answer, if finding.ends_with("30") { "2" } else { TOLERANCE });
        assert_eq!(assessment.verdict, AnswerVerdict::Wrong, "{finding}");
        assert!(assessment.finding.as_ref().unwrap().starts_with(finding), "{assessment:?}");
    }
    for (i, key) in SpringMass::KEYS.into_array().into_iter().enumerate() {
        // The value of the problem, and just beyond the tolerance.
        let finding = |factor: &str| {
            let parameters = SpringMass::KEYS.zip(problem.system.as_ref());
            let used = parameters.map(|(other, x)| (other == key).then(|| Some(x * number(factor))));
            let mut answer = right(problem);
            answer.used.system = used;
            assess(problem, answer, TOLERANCE).finding
        };
        assert_eq!(finding("1"), None, "{i}");
        assert!(finding("1.0000011").unwrap().starts_with(&format!("it used {key} = ")), "{key}");
    }
}

/// Rounding to single precision changes the gap H − l; the answer is assessed with the parameters used.
#[test]
fn an_answer_is_compared_with_the_method_that_it_used() {
    let all = problems(1, 20, &[Family::Far]);
    let single = |problem: &Problem| {
        let used = problem.system.as_ref().map(|x| x.to_f32().unwrap().to_exact().unwrap());
        let exact = right(&Problem { system: used.clone(), ..problem.clone() });
        let single = |x: Option<Exact>| x.map(|x| x.to_f32().unwrap().to_exact().unwrap());
        let [u, n] = [exact.deflection, exact.contact_force].map(single);
        let mut answer = Answer { deflection: u, contact_force: n, ..Answer::default() };
        answer.used.system = used.map(|x| Some(Some(x)));
        answer
    };
    let report = run(&all, single);
    assert_eq!(report.summary(), VerdictCounts { within_tolerance: 20, ..VerdictCounts::default() });
}

/// Returns the right answer with this multiple of u.
fn deflected(problem: &Problem, factor: &str) -> Answer {
    let answer = right(problem);
    Answer { deflection: answer.deflection.map(|u| u * number(factor)), ..answer }
}

/// Every reply has its own count, and only a right answer passes.
#[test]
fn every_reply_is_counted() {
    let all = problems(1, 6, &[Family::Stiff]);
    let replies = |problem: &Problem| {
        let answer = |factor| Reply::Answered(Box::new(deflected(problem, factor)));
        match problem.id.as_str() {
            "stiff-1" => answer("1"),
            "stiff-2" => answer("1.0000001"),
            "stiff-3" => Reply::Refused("too stiff".into()),
            "stiff-4" => Reply::InvalidResponse("who?".into()),
            "stiff-5" => Reply::Crashed("signal".into()),
            _ => Reply::TimedOut("nothing".into()),
        }
    };
    let judged = |problems: &[Problem]| {
        check(problems, &number(TOLERANCE), |problem| Ok::<_, Infallible>(replies(problem))).unwrap()
    };
    // The wrong answer with the larger error is shown.
    let off = |problem: &Problem| deflected(problem, if problem.id == "stiff-4" { "3" } else { "2" });
    assert_eq!(run(&all, off).families()[0].worst.problem.id, "stiff-4");
    let report = judged(&all);
    let one_each =
        VerdictCounts { right: 1, within_tolerance: 1, wrong: 1, refused: 1, crashed: 1, timed_out: 1 };
    assert_eq!(report.summary(), one_each);
    let worst = &report.families()[0];
    assert_eq!((worst.verdict, worst.count, worst.cases), (AnswerVerdict::Crashed, 1, 6));
    assert_eq!(worst.worst.problem.id, "stiff-5");
    // A wrong answer alone, a refusal with a right answer, and a refusal alone.
    let holds = |of: &[usize]| judged(&of.iter().map(|i| all[*i].clone()).collect::<Vec<_>>()).holds();
    assert_eq!([0, 1, 2, 3, 4, 5].map(|i| holds(&[i])), [true, true, false, false, false, false]);
    assert_eq!([1, 2, 3, 4, 5].map(|i| holds(&[0, i])), [true, true, false, false, false]);
    assert_eq!([3, 4, 5].map(|i| holds(&[i, 0])), [false; 3]);
}

#[test]
fn a_program_that_never_answers_is_not_restarted() {
    let all = default_problems();
    let silent = |answers_at: usize, other: Reply| {
        let mut asked = 0;
        let report = check(&all, &number(TOLERANCE), |problem| {
            asked += 1;
            let is_answered = asked == answers_at;
            let answer = is_answered.then(|| Reply::Answered(Box::new(right(problem))));
            Ok::<_, Infallible>(answer.unwrap_or_else(|| other.clone()))
        });
        let report = report.unwrap();
        (report.given_up, report.results.len())
    };
    for other in [
        Reply::TimedOut("nothing".into()),
        Reply::Crashed("signal".into()),
        Reply::InvalidResponse("another id".into()),
    ] {
        assert_eq!(silent(usize::MAX, other.clone()), (true, 3));
        assert_eq!(silent(3, other.clone()), (false, all.len()));
        assert_eq!(silent(4, other), (true, 3));
    }
    assert_eq!(silent(usize::MAX, Reply::Refused("no".into())), (false, all.len()));
    let three = check(&all[..3], &number(TOLERANCE), |_| Ok::<_, Infallible>(Reply::Crashed("so".into())));
    assert!(!three.unwrap().given_up, "there was nothing more to ask");
}

/// Without a force and a gap errors are measured in units. If f64 overflows, rounding explains nothing. For l = 10⁴ m
/// the rounding error is 10⁻¹² m, which ε = 4.5e17 N/m turns into a million N: less than the 2e8 N of c (|l| + |H|), but
/// above the tolerance. With lengths near 10¹² m it is larger than u, but explains errors only up to 10⁻⁶ of 1 + 2 m.
#[test]
fn rounding_explains_errors_up_to_a_millionth() {
    let (exact, f64_range) = (["5", "3", "0", "2", "2"], ["1e10", "1e8", "9.81", "1e8", "2e8"]);
    let (stiff, far) =
        (["1e4", "1", "2", "1e4", "10000.0001"], ["1", "1", "2", "1000000000000.3", "1000000000001.3"]);
    for (parameters, penalty, tolerance, [off_u, off_n], verdict) in [
        (exact, None, "1e-6", ["0", "0"], AnswerVerdict::Right),
        (exact, None, "1e-6", ["1e-6", "0"], AnswerVerdict::WithinTolerance),
        (exact, None, "1e-6", ["2e-6", "0"], AnswerVerdict::Wrong),
        (f64_range, Some("1e305"), "1e-6", ["0", "0"], AnswerVerdict::Right),
        (f64_range, Some("1e305"), "1e-6", ["1e7", "0"], AnswerVerdict::Wrong),
        (stiff, Some("4.5e17"), "1e-6", ["0", "1000"], AnswerVerdict::Wrong),
        (far, None, "1e-30", ["3e-6", "0"], AnswerVerdict::Right),
        (far, None, "1e-30", ["3.0000003e-6", "0"], AnswerVerdict::Wrong),
    ] {
        let penalty = penalty.map(number);
        let problem = Problem { penalty, ..problem("own", Family::Contact, parameters) };
        let [u, n] = solution(problem.system.clone(), problem.penalty.clone());
        let assessment = assess(&problem, Answer::new(u + number(off_u), n + number(off_n)), tolerance);
        assert_eq!(assessment.verdict, verdict, "{parameters:?}: {off_u}, {off_n}");
        let says_so = assessment.finding.as_deref() == Some("within the rounding error of f64");
        let is_open = [stiff, far].contains(&parameters);
        assert_eq!(says_so, is_open && verdict == AnswerVerdict::Wrong, "{parameters:?}");
    }
}

/// R = −2 on a scale of two million.
#[test]
fn a_state_decides_if_its_error_exceeds_the_tolerance() {
    let separated = problem("own", Family::Near, ["1", "1", "999999", "0", "1000001"]);
    let report = run(&[separated], right);
    let least = |tolerance: &str| report.least_deciding(State::Separated, &number(tolerance));
    assert_eq!(["1e-6", "9.9e-7"].map(least), [None, Some(number("1e-6"))]);
}

/// A parameter that differs by exactly the tolerance is that of the problem, one further off is not.
#[test]
fn a_parameter_is_taken_up_to_the_tolerance() {
    let problem = with_penalties(problems(1, 1, &[Family::Contact])).remove(0);
    let verdict = |factor: &str| assess(&problem, right_with(&problem, factor), TOLERANCE).verdict;
    assert_eq!(["0.999999", "1.000001"].map(verdict), [AnswerVerdict::Right; 2]);
    assert!(["0.9999989", "1.0000011"].map(verdict).iter().all(|verdict| *verdict != AnswerVerdict::Right));
}

/// All are counted; beside the first thousand only the first wrong one is kept.
#[test]
fn results_are_kept_in_bounded_memory() {
    let report = run(&problems(1, 1100, &[Family::Contact]), |problem| {
        let is_late = ["contact-1050", "contact-1060"].contains(&problem.id.as_str());
        deflected(problem, if is_late { "2" } else { "1" })
    });
    assert_eq!((report.results.len(), report.cases()), (1001, 1100));
    let row = &report.families()[0];
    assert_eq!((row.cases, row.verdict, row.count, row.right), (1100, AnswerVerdict::Wrong, 2, 1098));
    assert_eq!((row.worst.problem.id.as_str(), row.worst.number), ("contact-1050", 1049));
}
