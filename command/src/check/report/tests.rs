//! Sentences on solvers with known mistakes. Those on one mistake, and tables, are in `tests/cmd/check.trycmd`.

use super::*;
use crate::args::parse_number;
use crate::check::{Options, json};
use crate::output::capture;
use clap::{Args, FromArgMatches};
use spring_mass_contact::chapter::{SpringMass, contact, structure, system};
use spring_mass_contact::check::{Answer, CASES, Family, Problem, check, problems};
use spring_mass_contact::solver::Augmentation;
use std::convert::Infallible;

fn number(text: &str) -> Exact {
    text.parse().expect("a number")
}

fn replied(problems: &[Problem], mut solver: impl FnMut(&Problem) -> Reply) -> Report {
    let Ok(report) = check(problems, &number("1e-6"), |problem| Ok::<_, Infallible>(solver(problem)));
    report
}

fn report(problems: &[Problem], solver: impl Fn(&Problem) -> Answer) -> Report {
    replied(problems, |problem| Reply::Answered(Box::new(solver(problem))))
}

/// Returns what is checked.
fn program() -> Subject {
    Subject { kind: "program", name: "program".to_string(), missing: Vec::new() }
}

/// Returns the table with normalised white space.
fn said(report: &Report) -> String {
    let text = capture(|out| table(out, &program(), report, &parse_number("1e-6").expect("a number")));
    assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
    text.split_whitespace().collect::<Vec<_>>().join(" ") + " "
}

fn all() -> Vec<Problem> {
    problems(1, CASES, Family::ALL)
}

fn right(problem: &Problem) -> Answer {
    let exact = problem.solution();
    Answer::new(exact.deflection, exact.contact_force)
}

const UNEXPLAINED: &str = "No single mistake that is searched for explains the wrong answers.";

/// Asserts that a report contains a sentence, and whether it says that nothing explains wrong answers.
fn assert_says(report: &Report, text: &str) {
    let said = said(report);
    assert!(said.contains(text), "{text}\n{said}");
    assert_eq!(said.contains(UNEXPLAINED), text == UNEXPLAINED, "{said}");
}

/// Returns a report on a solver with wrong answers that no single mistake explains, where a condition holds.
fn wrong_where(problems: &[Problem], is_wrong: impl Fn(&SpringMass<Exact>) -> bool) -> Report {
    report(problems, |problem| {
        let (exact, system) = (problem.solution(), &problem.system);
        let [u, n] = [exact.deflection, exact.contact_force];
        let off = &system.h * &system.m;
        if is_wrong(system) { Answer::new(u * number("1.5") + &off, n + off) } else { Answer::new(u, n) }
    })
}

#[test]
fn a_condition_is_described_by_a_state_or_by_each_quantity_that_fits() {
    let in_contact = wrong_where(&all(), |system| system::reaction(system) > number("0"));
    let count = in_contact.summary().wrong;
    let text = format!("The {count} wrong answers are to all {count} systems in contact. ");
    assert_says(&in_contact, &text);
    let grazing = wrong_where(&all(), |system| system::reaction(system) == number("0"));
    let count = grazing.summary().wrong;
    assert_says(&grazing, &format!("The {count} wrong answers are to systems with R = 0. "));

    let more = "More cases may tell which of these matters.";
    let is_stiff = |system: &SpringMass<Exact>| system.c > number("1000");
    let one = wrong_where(&all(), is_stiff);
    assert_says(&one, "systems with c from ");
    assert!(!said(&one).contains(more));
    let mut alike = all();
    alike.retain(|problem| is_stiff(&problem.system) == (problem.system.m > number("2")));
    let several = wrong_where(&alike, is_stiff);
    assert!(said(&several).contains(", or "));
    assert_says(&several, more);
}

#[test]
fn a_threshold_is_printed_with_its_unit() {
    let report = report(&problems(1, 10, Family::ALL), |problem| {
        let free = structure::deflection(&problem.system);
        let is_near = contact::penetration(&problem.system, &free) < number("1e-6");
        if is_near { Answer::new(free, number("0")) } else { right(problem) }
    });
    let threshold = report.conditions[0].threshold.as_ref().expect("a threshold");
    let wrong = threshold.wrong.decimal(ERROR_DIGITS, Round::Up);
    let right = threshold.right.decimal(ERROR_DIGITS, Round::Down);
    let count = report.summary().wrong;
    let text = format!(
        "One mistake explains all {count} wrong answers, but not the right ones: the plane never acts. gap = H \
         − l R = m g − c gap u = m g / c, N = 0 The {count} wrong answers are to systems with |R|/c up to {wrong} m \
         (right from {right} m on)"
    );
    assert_says(&report, &text);
}

/// Two mistakes at once, which are not searched for: 2 m g c instead of m g / c.
#[test]
fn what_nothing_explains_is_said() {
    let twice = report(&all(), |Problem { system, .. }| {
        let weight = system::weight(system);
        let u = (&weight * &system.c * number("2")).min(system::gap(system));
        let force = (weight - &system.c * &u).max(number("0"));
        Answer::new(u, force)
    });
    assert_says(&twice, UNEXPLAINED);
    let wrong = |count: usize| report(&all()[..count], |_| Answer::new(number("12345"), number("6789")));
    assert_says(&wrong(2), "Fewer than three wrong answers do not determine a mistake.");
    assert_says(&wrong(3), UNEXPLAINED);
    // The example says what is wrong.
    assert_says(&replied(&all(), |_| Reply::InvalidResponse("no key".into())), "no key");
}

/// Another answer the second time; and every second answer is the one before, also when the request is repeated.
#[test]
fn what_is_carried_over_is_reported() {
    let mut asked = Vec::new();
    let changed = replied(&all(), |problem| {
        let is_first = !asked.contains(&problem.id);
        asked.push(problem.id.clone());
        let answer = if is_first { right(problem) } else { Answer::new(number("1"), number("2")) };
        Reply::Answered(Box::new(answer))
    });
    let text = "The program carries something over from earlier requests, or is random: of 12 requests that were \
                repeated in another order, 12 have another answer.";
    assert_says(&changed, text);
    assert_says(&changed, ", then u = 1 m, N = 2 N.");

    let problems = all();
    let place = |id: &str| problems.iter().position(|problem| id == problem.id).expect("a request");
    let stale = report(&problems, |problem| {
        let place = place(&problem.id);
        right(&problems[place - place % 2])
    });
    let options = Options::augment_args(clap::Command::new("check"));
    let options = Options::from_arg_matches(&options.get_matches_from(["check", "--", "program"]));
    let json = serde_json::to_value(json::report(&program(), &options.expect("options"), &stale));
    let json = json.expect("a report");
    let pairs = json["carried_over"].as_array().expect("pairs").iter();
    let pairs: Vec<_> = pairs.map(|pair| [0, 1].map(|end| pair[end].as_str().expect("an id"))).collect();
    assert!(pairs.len() > 9, "{pairs:?}");
    assert!(pairs.iter().all(|[id, earlier]| place(id) == place(earlier) + 1), "{pairs:?}");
    let ([id, earlier], count, wrong) = (pairs[0], pairs.len(), stale.summary().wrong);
    let text = format!(
        "The program carries something over from earlier requests: {count} of {wrong} wrong answers are the right \
         ones of an earlier request; that to {id} is that to {earlier}."
    );
    assert_says(&stale, &text);
}

#[test]
fn errors_that_do_not_grow_are_reported() {
    let mut both = report(&problems(1, 4, Family::ALL), |problem| {
        let part = number(if problem.id.len().is_multiple_of(2) { "1" } else { "0.7" });
        let exact = problem.solution();
        Answer::new(exact.deflection + number("1e-6") * &part, exact.contact_force + number("1e-3") * part)
    });
    assert_says(&both, "the largest is 1e-6 m of u, 0.001 N of N. ");
    both.absolute_bounds = [None, Some(number("1e-3")), Some(number("2e-3"))];
    assert_says(&both, "the largest is 0.001 N of N. ");
}

/// Three penalties, in equilibrium.
#[test]
fn apparent_penalties_are_reported() {
    let asked = [("1.05", "800"), ("1.06", "9000"), ("1.07", "9000")].map(|(h, eps)| {
        let system = SpringMass { c: "100", m: "1", g: "10", l: "1", h }.parse().expect("a system");
        (Problem::own(h, system, None).expect("a problem"), number(eps))
    });
    let problems = asked.each_ref().map(|(problem, _)| problem.clone());
    let said = said(&report(&problems, |problem| {
        let (_, eps) = asked.iter().find(|(other, _)| other == problem).expect("a problem");
        right(&Problem { penalty: Some(eps.clone()), ..problem.clone() })
    }));
    let text = "Where rounding does not hide p = l + u − H, the wrong answers are in equilibrium with p > 0, as by a \
                penalty N/p from 800 N/m to 9e3 N/m.";
    assert!(said.contains(&format!("{UNEXPLAINED} {text}")), "{said}");
}

/// (1.16), with the force of the previous step.
#[test]
fn lagging_steps_are_reported() {
    let lagging = report(&all(), |problem| {
        let (eps, mut before) = (&problem.system.c * number("3"), number("0"));
        let steps = Augmentation::new(&problem.system, &eps)
            .take(12)
            .map(|step| [Some(step.deflection), Some(std::mem::replace(&mut before, step.contact_force))]);
        Answer { steps: steps.collect(), ..right(problem) }
    });
    let of = lagging.lag().expect("a lag").of;
    let text = "N is one step behind. N_k = m g − c u_{k−1}";
    assert_says(&lagging, &format!("The reported steps of all {of} systems show it: {text}"));
}

/// The requested penalty of 10⁶ N/m is not reported.
#[test]
fn mistakes_with_the_same_results_are_named() {
    let mut asked = all();
    asked.iter_mut().for_each(|problem| problem.penalty = Some(number("1e6")));
    let of_less = |problem: &Problem| right(&Problem { penalty: Some(number("1e4")), ..problem.clone() });
    let text = "Each of 3 mistakes explains all 140 answers: ε is 0.01 times the right value; ε is always 10000; -990000 is \
                added to ε. More";
    let mut three = report(&asked, of_less);
    assert_says(&three, text);
    // Four are named, and of five as many.
    three.diagnosis.push(three.diagnosis[0].clone());
    assert!(!said(&three).contains('…'));
    three.diagnosis.push(three.diagnosis[0].clone());
    assert_says(&three, "; …. More");
}

/// The report on a right program contains only what was tested: families, systems, and the smallest |R| among
/// them. A family without answers leaves the result open.
#[test]
fn the_report_lists_what_was_tested() {
    let tested = problems(1, 1, &[Family::Contact]);
    let contact = &tested[0].system;
    let loads = system::weight(contact) + &contact.c * system::gap(contact);
    let least = (system::reaction(contact) / loads).decimal(ERROR_DIGITS, Round::Up);
    let text = format!(
        "No error above 1e-6 was found in 1 system of 1 family, with one unknown and one plane. Missed \
         contact would be detected from |R| = {least} (|m g| + |c (H − l)|) on, false contact would not be \
         detected. "
    );
    assert_says(&report(&tested, right), &text);
    let refusing = replied(&all(), |problem| match problem.family {
        Family::Stiff => Reply::Refused("no".into()),
        _ => Reply::Answered(Box::new(right(problem))),
    });
    assert!(!refusing.holds());
    assert_says(&refusing, "Every system of stiff was refused, so its result is unknown. ");
}
