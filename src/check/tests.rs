//! That wrong solvers are found out, and told apart.

use super::mistakes::{Mistake, every, mistakes, none, value, values};
use super::*;
use crate::chapter::{SpringMass, contact, structure, system};
use crate::claims::given;
use crate::formula::{self, Claim, Statement};
use crate::number::{PositivePart, ToExact};
use crate::proof::prove;
use crate::solver::{Augmentation, Method, State, solve};
use num_traits::Zero;
use rug::float::Round;
use std::collections::{HashMap, HashSet};
use std::convert::Infallible;

const TOLERANCE: &str = "1e-6";

fn number(text: &str) -> Exact {
    text.parse().unwrap()
}

fn default_problems() -> Vec<Problem> {
    problems(1, CASES, &Family::ALL)
}

/// A penalty that no two systems have in common, as multiples of c have.
fn with_penalties(mut problems: Vec<Problem>) -> Vec<Problem> {
    for (i, problem) in problems.iter_mut().enumerate() {
        problem.penalty = Some(&problem.system.c * Exact::from(i as i32 + 2));
    }
    problems
}

fn run(problems: &[Problem], solver: impl Fn(&Problem) -> Answer) -> Report {
    let ask = |problem: &Problem| Ok::<_, Infallible>(Reply::Answered(Box::new(solver(problem))));
    check(problems, &number(TOLERANCE), ask).unwrap()
}

/// What a program with this mistake answers.
fn answer(mistake: &Mistake, problem: &Problem, penalty: Option<&Exact>) -> Answer {
    let [u, n] = mistake.formulas(system::reaction(&problem.system) > Exact::zero());
    let value = |tree| value(tree, &problem.system, penalty);
    Answer { deflection: value(u), contact_force: value(n), ..Answer::default() }
}

#[test]
fn every_mistake_is_diagnosed_as_itself() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for mistake in mistakes(problems[0].penalty.is_some()) {
            let eps = number("3e5");
            let solve = |problem: &Problem| {
                let eps = problem.penalty.as_ref().or(mistake.measured.map(|_| &eps));
                answer(mistake, problem, eps)
            };
            let report = run(&problems, solve);
            assert!(!report.holds(), "{} holds", mistake.name);
            let names: Vec<_> = report.diagnosis.iter().map(|d| (&d.name, &d.formula, d.answers)).collect();
            let own = [(&mistake.name, &mistake.formula(), Answers::All)];
            assert_eq!(names, own, "{}", mistake.name);
        }
    }
}

/// Two mistakes that compute the same on all systems of a run by default are one.
#[test]
fn what_is_taken_for_the_same_is_proved_to_be() {
    let given = given();
    let given = [&given.stiffness, &given.penalty];
    for by_penalty in [false, true] {
        let kept = [none(by_penalty)].into_iter().chain(mistakes(by_penalty).iter().cloned());
        let kept: HashMap<_, _> = kept.map(|mistake| (values(&mistake), mistake)).collect();
        for mistake in every(by_penalty) {
            let same = &kept[&values(&mistake)];
            let pairs = [(&same.touching, &mistake.touching), (&same.apart, &mistake.apart)];
            for (a, b) in pairs.into_iter().flat_map(|(a, b)| a.iter().zip(b)) {
                let claim = Claim::new("same", &given, formula::Kind::Equal(a.clone(), b.clone()));
                assert!(
                    a == b || prove(&Statement::of(&claim)).is_ok(),
                    "{} and {}: {a} and {b}",
                    same.name,
                    mistake.name
                );
            }
        }
    }
}

/// The same in f64, as a program would, that reads the decimals of a request.
#[test]
fn rounding_hides_no_mistake() {
    for mistake in mistakes(false) {
        let solve = |problem: &Problem| {
            let system = problem.system.try_map(Exact::to_f64).unwrap();
            let [u, n] = mistake.formulas(system::reaction(&system) > 0.0);
            let number = |tree| {
                let infinite = |x: f64| x.to_exact().ok();
                value(tree, &system, mistake.measured.map(|_| &3e5)).and_then(infinite)
            };
            Answer { deflection: number(u), contact_force: number(n), ..Answer::default() }
        };
        let report = run(&default_problems(), solve);
        let found: Vec<_> = report.diagnosis.iter().map(|d| d.name.as_str()).collect();
        assert!(!report.holds() && found == [&mistake.name], "{}: {found:?}", mistake.name);
    }
}

fn right(problem: &Problem) -> Answer {
    let exact = problem.solution();
    Answer::new(exact.deflection, exact.contact_force)
}

#[test]
fn what_is_right_is_not_diagnosed() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        let in_f64 = |problem: &Problem| {
            let system = problem.system.try_map(Exact::to_f64).unwrap();
            let method = match &problem.penalty {
                None => Method::Lagrange,
                Some(penalty) => Method::Penalty { penalty: penalty.to_f64().unwrap() },
            };
            let answer = solve(&system, &method).unwrap();
            let [u, n] = [answer.deflection, answer.contact_force].map(|x| x.to_exact().unwrap());
            Answer { penetration: Some(answer.penetration.to_exact().ok()), ..Answer::new(u, n) }
        };
        for report in [run(&problems, right), run(&problems, in_f64)] {
            assert_eq!(report.summary(), Summary { right: problems.len(), ..Summary::default() });
            assert!(report.holds() && report.diagnosis.is_empty());
        }
    }
}

/// Off by the tolerance is within, by a little more is not: u and N each on its own scale.
#[test]
fn the_tolerance_is_the_border() {
    let problem = &problems(1, 1, &[Family::Contact])[0];
    let SpringMass { c, .. } = &problem.system;
    let [gap, weight] = [system::gap(&problem.system), system::weight(&problem.system)];
    let scales = [&gap + &weight / c, &weight + c * &gap];
    for (i, factor, verdict) in [
        (0, "1", Verdict::WithinTolerance),
        (0, "-1", Verdict::WithinTolerance),
        (0, "1.0000001", Verdict::Wrong),
        (0, "-1.0000001", Verdict::Wrong),
        (1, "1", Verdict::WithinTolerance),
        (1, "1.0000001", Verdict::Wrong),
        (1, "-1.0000001", Verdict::Wrong),
    ] {
        let mut answer = right(problem);
        let number_of = if i == 0 { &mut answer.deflection } else { &mut answer.contact_force };
        *number_of = number_of.take().map(|x| x + number(factor) * number(TOLERANCE) * &scales[i]);
        let judgement = Judgement::of(problem, &Reply::Answered(Box::new(answer)), &number(TOLERANCE));
        assert_eq!(judgement.verdict, verdict, "{i}, {factor}");
        assert_eq!(judgement.error(), Some(&(number(factor) * number(TOLERANCE)).abs()));
    }
}

/// What an answer says besides is held against it.
#[test]
fn findings_say_what_is_wrong() {
    let problem = &problems(1, 1, &[Family::Contact])[0];
    let finding = |change: &dyn Fn(&mut Answer)| {
        let mut answer = right(problem);
        change(&mut answer);
        let judgement = Judgement::of(problem, &Reply::Answered(Box::new(answer)), &number(TOLERANCE));
        (judgement.verdict, judgement.finding.unwrap_or_default())
    };
    let wrong = |change: &dyn Fn(&mut Answer), text: &str| {
        let (verdict, finding) = finding(change);
        assert!(verdict == Verdict::Wrong && finding.contains(text), "{verdict}: {finding}");
    };
    let more = |x: &Exact| Some(Some(x * number("1.01")));
    let system = &problem.system;
    wrong(&|answer| answer.deflection = None, "its deflection is not a number");
    wrong(&|answer| answer.contact_force = None, "its contact force is not a number");
    wrong(
        &|answer| answer.contact_force = Some(Exact::zero()),
        "says that the mass hangs free; exactly, the",
    );
    wrong(
        &|answer| answer.contact_force = Some(number("-9")),
        "says that the plane pulls; exactly, the plane p",
    );
    wrong(&|answer| answer.penetration = Some(Some(number("0.1"))), "its penetration is 0.1, that of its");
    wrong(&|answer| answer.penetration = Some(None), "its penetration is not a number");
    wrong(&|answer| answer.used.system.c = more(&system.c), "took stiffness =");
    wrong(&|answer| answer.used.system.m = more(&system.m), "took mass =");
    wrong(&|answer| answer.used.system.g = more(&system.g), "took gravity =");
    wrong(&|answer| answer.used.system.l = more(&system.l), "took free_length =");
    wrong(&|answer| answer.used.system.h = more(&system.h), "took height =");
    wrong(&|answer| answer.used.system.h = Some(None), "took no number for height =");
    let zero = |answer: &mut Answer| answer.used.system.c = Some(Some(Exact::zero()));
    let mut none = right(problem);
    zero(&mut none);
    let judgement = Judgement::of(problem, &Reply::Answered(Box::new(none)), &number("2"));
    assert_eq!(judgement.finding.as_deref(), Some("it took stiffness = 0 for 30"));
    let same = finding(&|answer| answer.used.system.c = Some(Some(system.c.clone())));
    assert_eq!(same, (Verdict::Right, String::new()));
}

/// Rounded to single precision, H − l is another gap; the answer is judged by what was used.
#[test]
fn an_answer_is_judged_by_what_it_used() {
    let all = problems(1, 20, &[Family::Far]);
    let single = |problem: &Problem, says_so: bool| {
        let used = problem.system.map(|x| x.to_f32().unwrap().to_exact().unwrap());
        let exact = right(&Problem { system: used.clone(), ..problem.clone() });
        let single = |x: Option<Exact>| x.map(|x| x.to_f32().unwrap().to_exact().unwrap());
        let [u, n] = [exact.deflection, exact.contact_force].map(single);
        let mut answer = Answer { deflection: u, contact_force: n, ..Answer::default() };
        if says_so {
            answer.used.system = used.map(|x| Some(Some(x.clone())));
        }
        answer
    };
    let report = run(&all, |problem| single(problem, true));
    assert_eq!(report.summary(), Summary { within_tolerance: 20, ..Summary::default() });
    let report = run(&all, |problem| single(problem, false));
    assert_eq!(report.named().unwrap().name, "it computes in single precision");
}

/// Every reply has its own place in the tally, and none but a right answer passes.
#[test]
fn every_reply_is_counted() {
    let all = problems(1, 6, &[Family::Stiff]);
    let replies = |problem: &Problem| {
        let answer = |off: &str| {
            let mut answer = right(problem);
            answer.deflection = answer.deflection.map(|u| u * number(off));
            Reply::Answered(Box::new(answer))
        };
        match problem.id.as_str() {
            "stiff-1" => answer("1"),
            "stiff-2" => answer("1.0000001"),
            "stiff-3" => Reply::Refused("too stiff".into()),
            "stiff-4" => Reply::Garbled("who?".into()),
            "stiff-5" => Reply::Crashed("signal".into()),
            _ => Reply::TimedOut("nothing".into()),
        }
    };
    let judged = |problems: &[Problem]| {
        check(problems, &number(TOLERANCE), |problem| Ok::<_, Infallible>(replies(problem))).unwrap()
    };
    // Of two that are wrong the one that is further off is shown.
    let off = |problem: &Problem| {
        let mut answer = right(problem);
        answer.deflection =
            answer.deflection.map(|u| u * number(if problem.id == "stiff-4" { "3" } else { "2" }));
        answer
    };
    assert_eq!(run(&all, off).families()[0].worst.problem.id, "stiff-4");
    let report = judged(&all);
    let one_each = Summary { right: 1, within_tolerance: 1, wrong: 1, refused: 1, crashed: 1, timed_out: 1 };
    assert_eq!(report.summary(), one_each);
    let worst = &report.families()[0];
    assert_eq!((worst.verdict, worst.count, worst.cases), (Verdict::Crashed, 1, 6));
    assert_eq!(worst.worst.problem.id, "stiff-5");
    // Alone; the refusal beside a right answer; the refusal alone.
    let holds = |of: &[usize]| judged(&of.iter().map(|i| all[*i].clone()).collect::<Vec<_>>()).holds();
    assert_eq!([0, 1, 2, 3, 4, 5].map(|i| holds(&[i])), [true, true, false, false, false, false]);
    assert_eq!([1, 2, 3, 4, 5].map(|i| holds(&[0, i])), [true, true, false, false, false]);
    assert_eq!([3, 4, 5].map(|i| holds(&[i, 0])), [false; 3]);
}

#[test]
fn who_never_answers_is_left_alone() {
    let all = default_problems();
    let mut asked = 0;
    let mut silent = |answers_at: usize| {
        asked = 0;
        let report = check(&all, &number(TOLERANCE), |problem| {
            asked += 1;
            let answered = || Reply::Answered(Box::new(right(problem)));
            Ok::<_, Infallible>(if asked == answers_at {
                answered()
            } else {
                Reply::TimedOut("nothing".into())
            })
        });
        let report = report.unwrap();
        (report.given_up, report.checked.len())
    };
    assert_eq!(silent(usize::MAX), (true, 3));
    assert_eq!(silent(3), (false, all.len()));
    assert_eq!(silent(4), (true, 3));
    let three = check(&all[..3], &number(TOLERANCE), |_| Ok::<_, Infallible>(Reply::Crashed("so".into())));
    assert!(!three.unwrap().given_up, "there was nothing more to ask");
}

/// By penalty, with a multiple of something.
fn by_penalty(problems: &[Problem], eps: impl Fn(&SpringMass<Exact>) -> Exact) -> Report {
    run(problems, |problem| {
        let asked = Problem { penalty: Some(eps(&problem.system)), ..problem.clone() };
        right(&asked)
    })
}

#[test]
fn a_penalty_shows_what_it_is_a_multiple_of() {
    let all = default_problems();
    let shown = |report: Report| {
        let Penalty { kind, value, spread } = report.penalty.clone();
        assert_eq!(spread, Some(Exact::zero()));
        assert_eq!(report.named().unwrap().name, "it is the penalty method");
        (kind, value.unwrap())
    };
    assert_eq!(shown(by_penalty(&all, |_| number("1e4"))), (Kind::Constant, number("1e4")));
    assert_eq!(shown(by_penalty(&all, |system| &system.c * number("50"))), (Kind::OfStiffness, number("50")));
    assert_eq!(shown(by_penalty(&all, |system| &system.m * number("7e3"))), (Kind::OfMass, number("7e3")));
    // One that is five times as large for half of the systems is none that we know.
    let of_mass = |system: &SpringMass<Exact>| number(if system.m < number("1") { "1e4" } else { "5e4" });
    let two = by_penalty(&all, of_mass);
    assert_eq!((two.penalty.kind, two.named()), (Kind::None, None));
    // Where c and m are the same in all systems, it may be a multiple of either.
    let alike = |problem: &Problem| {
        let (c, m) = (number("300"), number("2"));
        Problem { system: SpringMass { c, m, ..problem.system.clone() }, ..problem.clone() }
    };
    let alike: Vec<_> = problems(1, 9, &[Family::Overlap]).iter().map(alike).collect();
    assert_eq!(by_penalty(&alike, |_| number("1e4")).penalty.kind, Kind::None);
    assert_eq!(run(&all, right).penalty.kind, Kind::None);
}

/// (1.16) with ε = 3 c, a step after the other; the force of each is that of the step before, or its own.
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
fn a_force_that_lags_is_told_from_one_that_does_not() {
    let report = run(&default_problems(), |problem| steps(problem, true));
    let lag = report.named().unwrap();
    assert_eq!((lag.name.as_str(), lag.answers), ("N is one step behind", Answers::Steps));
    assert_eq!(lag.formula, "N_k = m g − c u_{k−1}");
    assert!(!report.holds() && report.summary().right == report.checked.len());
    let report = run(&default_problems(), |problem| steps(problem, false));
    assert!(report.holds() && report.diagnosis.is_empty());
    // One step in which it does not is enough, and one system.
    let report = run(&default_problems(), |problem| {
        let mut answer = steps(problem, true);
        answer.steps[..2].clone_from_slice(&steps(problem, false).steps[..2]);
        answer
    });
    assert!(report.holds() && report.diagnosis.is_empty());
    let report = run(&default_problems(), |problem| steps(problem, problem.id != "contact-2"));
    assert!(report.holds() && report.diagnosis.is_empty());
}

/// Of the wrong answers alone: a tolerance in metres that lets the mass hang free.
#[test]
fn what_is_wrong_in_some_systems_is_diagnosed_of_those() {
    let report = run(&problems(1, 20, &Family::ALL), |problem| {
        let free = structure::deflection(&problem.system);
        let slack = contact::penetration(&problem.system, &free) < number("1e-6");
        if slack { Answer::new(free, Exact::zero()) } else { right(problem) }
    });
    let names: Vec<_> = report.diagnosis.iter().map(|d| (d.name.as_str(), d.answers)).collect();
    assert!(names.contains(&("there is no plane", Answers::Wrong)), "{names:?}");
    let wrong = report.summary().wrong;
    assert!(report.diagnosis.iter().all(|d| (d.fits, d.of) == (wrong, wrong)) && wrong > 0);
}

#[test]
fn families_are_what_they_say() {
    let all = problems(1, 40, &Family::ALL);
    let short = |x: &Exact| x.decimal(DIGITS, Round::Nearest).parse().as_ref() == Ok(x);
    for Problem { id, family, system, .. } in &all {
        let SpringMass { c, m, g, l, h } = system;
        assert!([c, m, g, l, h].into_iter().all(short), "{id}: {system}");
        let (gap, state) = (system::gap(system), State::of(system));
        let (zero, free) = (Exact::zero(), structure::deflection(system));
        let between = |x: &Exact, low: &str, high: &str| number(low) <= *x && *x < number(high);
        let holds = match family {
            Family::Contact => state == State::Contact && gap > zero,
            Family::Separated => state == State::Separated && *g > zero,
            Family::Grazing => state == State::Grazing,
            Family::Near => {
                // A unit of the twelfth digit of a number that has a part in m g or in c Δ.
                let part = system::reaction(system).abs() / system::weight(system).abs();
                !part.is_zero() && part < number("1e-8")
            }
            Family::Overlap => gap < zero,
            Family::Lifted => *g < zero,
            Family::Stiff => between(c, "1e7", "1e10"),
            Family::Soft => between(c, "1e-4", "1e-1"),
            Family::Far => l.abs() > number("100") * (gap.abs() + free.abs()) && l.abs() >= number("1000"),
            Family::Huge => [c, m, l].into_iter().all(|x| between(x, "1e6", "1e14")),
            Family::Tiny => [c, m, l].into_iter().all(|x| between(x, "1e-14", "1e-6")),
        };
        assert!(holds, "{id}: {system}");
    }
    let states = |family: Family| {
        let of = all.iter().filter(|problem| problem.family == family);
        of.map(|problem| State::of(&problem.system)).collect::<HashSet<_>>()
    };
    use Family::*;
    for family in [Near, Lifted, Stiff, Soft, Far, Huge, Tiny] {
        assert_eq!(states(family), HashSet::from([State::Contact, State::Separated]), "{family}");
    }
    // The systems of a seed are its own, and those of a family do not depend on the others.
    assert_eq!(problems(1, 3, &[Stiff]), problems(1, 40, &Family::ALL)[240..243]);
    assert_ne!(problems(2, 3, &[Stiff]), problems(1, 3, &[Stiff]));
}

#[test]
fn the_book_names_what_is_known() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/check.md");
    let page = std::fs::read_to_string(page).unwrap();
    let list = page.split_once("Known are").unwrap().1;
    let is_edit = |name: &str| name.starts_with("as ") || name.contains(", and as ");
    for mistake in mistakes(false).iter().filter(|mistake| !is_edit(&mistake.name)) {
        assert!(list.contains(&mistake.name), "{}", mistake.name);
    }
    for family in Family::ALL {
        assert!(page.contains(&format!("`{family}`")), "{family}");
    }
}

/// No force, and no gap: there is nothing to measure an error by but the unit.
#[test]
fn nothing_can_be_measured_by_nothing() {
    let [c, m] = ["5", "3"].map(number);
    let system = SpringMass { c, m, g: Exact::zero(), l: number("2"), h: number("2") };
    let problem = Problem { system, ..problems(1, 1, &[Family::Contact]).remove(0) };
    for (u, verdict) in [("0", Verdict::Right), ("1e-6", Verdict::WithinTolerance), ("2e-6", Verdict::Wrong)]
    {
        let report = run(std::slice::from_ref(&problem), |_| Answer::new(number(u), Exact::zero()));
        assert_eq!(report.checked[0].judgement.verdict, verdict, "{u}");
    }
}

/// Where f64 overflows, rounding explains nothing: not any number is right.
#[test]
fn what_overflows_explains_nothing() {
    let problem = Problem { penalty: Some(number("1e305")), ..problems(1, 1, &[Family::Huge]).remove(0) };
    for (off, verdict) in [("1", Verdict::Right), ("1.1", Verdict::Wrong)] {
        let mut answer = right(&problem);
        answer.deflection = answer.deflection.map(|u| u * number(off));
        let judgement = Judgement::of(&problem, &Reply::Answered(Box::new(answer)), &number(TOLERANCE));
        assert_eq!(judgement.verdict, verdict);
    }
}

/// All answers, changed alike.
fn changed(change: impl Fn(&Problem, Exact, Exact) -> [Exact; 2]) -> Report {
    run(&problems(1, 10, &Family::ALL), |problem| {
        let exact = problem.solution();
        let [u, n] = change(problem, exact.deflection, exact.contact_force);
        Answer::new(u, n)
    })
}

#[test]
fn a_factor_is_found() {
    let name = |change: fn(&Problem, Exact, Exact) -> [Exact; 2]| {
        changed(change).named().map(|only| only.name.clone()).unwrap_or_default()
    };
    assert_eq!(name(|_, u, n| [u * number("1000"), n]), "u is 1000 times what is right");
    assert_eq!(name(|_, u, n| [u, n * number("1/1000")]), "N is 0.001 times what is right");
    let both = name(|_, u, n| [u * number("1000"), n * number("3/4")]);
    assert_eq!(both, "u is 1000 times what is right, N is 0.75 times what is right");
    // Of some of them it is none.
    let some = |problem: &Problem, u: Exact, n: Exact| {
        [u * number(if problem.id.ends_with('1') { "1000" } else { "999" }), n]
    };
    assert_eq!(name(some), "");
}

#[test]
fn few_digits_are_found() {
    let rounded = |digits| move |x: &Exact| x.decimal(digits, Round::Nearest).parse().unwrap();
    let name = |round: &dyn Fn(&Exact) -> Exact| {
        changed(|_, u, n| [round(&u), round(&n)]).named().map(|only| only.name.clone()).unwrap_or_default()
    };
    assert_eq!(name(&rounded(4)), "its numbers have no more than 4 digits");
    let fixed = |x: &Exact| {
        let millions = rug::Rational::from((x * number("1e6")).as_rational().round_ref());
        Exact::from(millions) / number("1e6")
    };
    assert_eq!(name(&fixed), "its numbers have no more than 6 decimals");
    // Few digits, but not of what is right.
    let half = |x: &Exact| rounded(4)(&(x * number("1.01")));
    assert_eq!(name(&half), "");
}

/// So little off that every mistake fits that hardly shows there; or no number, which fits no formula.
#[test]
fn what_shows_nothing_is_not_named() {
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
    // A plane that also pulls, but for one number that is none.
    let nearly = run(&default_problems(), |problem| {
        let [u, n] = [system::gap(&problem.system), system::reaction(&problem.system)];
        let answer = Answer::new(u, n);
        if problem.id == "contact-1" { Answer { contact_force: None, ..answer } } else { answer }
    });
    assert!(nearly.diagnosis.is_empty(), "{:?}", nearly.diagnosis);
}

#[test]
fn a_tolerance_of_its_own_is_found() {
    let missing = |is_small: fn(&SpringMass<Exact>) -> bool| {
        let report = changed(|problem, u, n| {
            let free = structure::deflection(&problem.system);
            if is_small(&problem.system) { [free, Exact::zero()] } else { [u, n] }
        });
        report.missed.expect("a threshold")
    };
    let through =
        |system: &SpringMass<Exact>| structure::deflection(system) - system::gap(system) < number("1e-6");
    let Missed { of, up_to, from, .. } = missing(through);
    assert!(of == Of::Penetration && up_to < number("1e-6") && number("1e-6") <= from, "{up_to} {from}");
    let Missed { of, up_to, from, .. } = missing(|system| system::reaction(system) < number("1e-2"));
    assert!(of == Of::Force && up_to < number("1e-2") && number("1e-2") <= from, "{up_to} {from}");
    // No threshold of one quantity; and nothing missed.
    let by_name = changed(|problem, u, n| {
        let free = structure::deflection(&problem.system);
        if problem.id.ends_with('3') { [free, Exact::zero()] } else { [u, n] }
    });
    assert_eq!((by_name.missed, changed(|_, u, n| [u, n]).missed), (None, None));
}

/// What is refused altogether is not known to be right.
#[test]
fn a_family_without_an_answer_does_not_hold() {
    let refusing = |refused: &'static str| {
        let ask = |problem: &Problem| {
            let refuses = problem.id.starts_with(refused);
            let answer = || Reply::Answered(Box::new(right(problem)));
            Ok::<_, Infallible>(if refuses { Reply::Refused("no".into()) } else { answer() })
        };
        check(&default_problems(), &number(TOLERANCE), ask).unwrap().holds()
    };
    assert_eq!(["stiff-1", "stiff", "none"].map(refusing), [true, false, true]);
}

/// What looks like one thing and is another.
#[test]
fn nothing_is_named_for_what_it_is_not() {
    // As near as single precision, and yet in double.
    let exact = run(&problems(3, 5, &Family::ALL), |problem| {
        let Answer { deflection, contact_force, .. } = right(problem);
        let off = if problem.id == "contact-1" { "1.000005" } else { "1.00000001" };
        let n = contact_force.map(|n| (n * number(off)).to_f64().unwrap().to_exact().unwrap());
        Answer { deflection, contact_force: n, ..Answer::default() }
    });
    assert!(exact.summary().wrong > 0 && exact.diagnosis.is_empty(), "{:?}", exact.diagnosis);
    // A factor that is none, and one that is all.
    let slight = changed(|_, u, n| [u, n * number("1.0000015")]);
    assert!(slight.diagnosis.is_empty(), "{:?}", slight.diagnosis);
    let nothing = changed(|_, u, _| [u, Exact::zero()]);
    assert_eq!(nothing.named().unwrap().name, "N is always 0");
    // Any number under a penalty of which rounding leaves nothing.
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
    let findings = garbage.checked.iter().filter_map(|of| of.judgement.finding.as_deref());
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
    assert_eq!(report.named().unwrap().name, "the plane also pulls");
    assert!(report.checked.iter().all(|of| matches!(&of.reply, Reply::Answered(a) if a.steps.is_empty())));
}

/// What is missed by chance, or for another reason, is seldom told by one number.
#[test]
fn a_threshold_is_not_seen_in_a_few() {
    let few = problems(1, 5, &[Family::Contact, Family::Stiff]);
    let report = run(&few, |problem| {
        if problem.family == Family::Stiff {
            Answer::new(structure::deflection(&problem.system), Exact::zero())
        } else {
            right(problem)
        }
    });
    assert!(report.summary().wrong >= 2 && report.missed.is_none(), "{:?}", report.missed);
}
