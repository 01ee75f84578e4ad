//! Reports on solvers with known mistakes.

use super::*;
use crate::args::parse_number;
use crate::check::{Options, json};
use crate::output::capture;
use clap::{Args, FromArgMatches};
use spring_mass_contact::chapter::{SpringMass, contact, lagrange, structure, system};
use spring_mass_contact::check::{Answer, CASES, Family, Problem, check, problems};
use spring_mass_contact::solver::Augmentation;
use std::convert::Infallible;

fn number(text: &str) -> Exact {
    text.parse().expect("a number")
}

fn report(problems: &[Problem], solver: impl Fn(&Problem) -> Answer) -> Report {
    let ask = |problem: &Problem| Ok::<_, Infallible>(Reply::Answered(Box::new(solver(problem))));
    check(problems, &number("1e-6"), ask).expect("no failure")
}

/// Returns the table with normalised white space.
fn said(report: &Report) -> String {
    let text = capture(|out| table(out, "program", report, &parse_number("1e-6").expect("a number")));
    assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn all() -> Vec<Problem> {
    problems(1, CASES, Family::ALL)
}

fn right(problem: &Problem) -> Answer {
    let exact = problem.solution();
    Answer::new(exact.deflection, exact.contact_force)
}

/// Returns a report on a solver without a plane where a quantity is below a threshold.
fn missing(is_small: impl Fn(&SpringMass<Exact>) -> bool) -> Report {
    report(&problems(1, 10, Family::ALL), |problem| {
        let free = structure::deflection(&problem.system);
        if is_small(&problem.system) { Answer::new(free, number("0")) } else { right(problem) }
    })
}

#[test]
fn a_threshold_is_printed_with_its_unit() {
    let through = |system: &SpringMass<Exact>| contact::penetration(system, &structure::deflection(system));
    for (report, symbol, unit) in [
        (missing(|system| through(system) < number("1e-6")), "|R|/c", "m"),
        (missing(|system| system::reaction(system) < number("1e-2")), "|R|", "N"),
    ] {
        let threshold = report.conditions[0].threshold.as_ref().expect("a threshold");
        let [wrong, right] = [
            threshold.wrong.decimal(ERROR_DIGITS, Round::Up),
            threshold.right.decimal(ERROR_DIGITS, Round::Down),
        ];
        let count = report.summary().wrong;
        let text = format!(
            "One mistake explains all {count} wrong answers, but not the right ones: the plane never acts. gap = H \
             − l R = m g − c gap u = m g / c, N = 0 The {count} wrong answers are to \
             systems with {symbol} up to {wrong} {unit} (right from {right} {unit} on)"
        );
        assert!(said(&report).contains(&text), "{text}\n{}", said(&report));
    }
}

/// A mistake explains all answers, and is printed with its program; others have the same results.
#[test]
fn a_mistake_is_printed_with_its_program() {
    let pulls = report(&all(), |problem| {
        Answer::new(lagrange::deflection(&problem.system), lagrange::multiplier(&problem.system))
    });
    let text = "One mistake explains all 140 answers: the plane always acts. gap = H − l";
    assert!(said(&pulls).contains(text), "{}", said(&pulls));
    assert!(said(&pulls).contains("R = m g − c gap u = gap, N = R"));
    let mut asked = Vec::new();
    let other = check(&all(), &number("1e-6"), |problem| {
        let is_first = !asked.contains(&problem.id);
        asked.push(problem.id.clone());
        let answer = if is_first { right(problem) } else { Answer::new(number("1"), number("2")) };
        Ok::<_, Infallible>(Reply::Answered(Box::new(answer)))
    });
    let text = "The program carries something over from earlier requests, or is random: of 12 requests that were \
                repeated in another order, 12 have another answer.";
    let said = said(&other.expect("no failure"));
    assert!(said.contains(text) && said.contains(", then u = 1 m, N = 2 N."), "{said}");
}

const UNEXPLAINED: &str = "No single mistake that is searched for explains";

/// Two mistakes at once, which are not searched for: 2 m g c instead of m g / c.
#[test]
fn what_nothing_explains_is_said() {
    let twice = report(&all(), |Problem { system, .. }| {
        let weight = &system.m * &system.g;
        let u = (&weight * &system.c * number("2")).min(&system.h - &system.l);
        let force = (weight - &system.c * &u).max(number("0"));
        Answer::new(u, force)
    });
    let text = format!("{UNEXPLAINED} the wrong answers.");
    assert!(twice.summary().wrong > 0 && said(&twice).ends_with(&text), "{}", said(&twice));
    assert!(!said(&report(&all(), right)).contains(UNEXPLAINED));
    let invalid =
        check(&all(), &number("1e-6"), |_| Ok::<_, Infallible>(Reply::InvalidResponse("no key".into())));
    assert!(!said(&invalid.expect("no failure")).contains(UNEXPLAINED), "the example says what is wrong");
}

/// Returns a report on a solver with wrong answers that no single mistake explains, where a condition holds.
fn twice_wrong_where(problems: &[Problem], is_wrong: impl Fn(&SpringMass<Exact>) -> bool) -> Report {
    report(problems, |problem| {
        let (exact, system) = (problem.solution(), &problem.system);
        let [u, n] = [exact.deflection, exact.contact_force];
        match is_wrong(system) {
            true => Answer::new(
                u * number("1.5") + &system.h * &system.m,
                n * number("1.5") + &system.h * &system.m,
            ),
            false => Answer::new(u, n),
        }
    })
}

fn is_stiff(system: &SpringMass<Exact>) -> bool {
    system.c > number("1000")
}

#[test]
fn a_condition_is_described_by_a_state_or_by_each_quantity_that_fits() {
    let in_contact = twice_wrong_where(&all(), |system| system::reaction(system) > number("0"));
    let count = in_contact.summary().wrong;
    let text = format!("The {count} wrong answers are to all {count} systems in contact. ");
    let said_of = said(&in_contact) + " ";
    assert!(said_of.contains(&text) && !said_of.contains(UNEXPLAINED), "{said_of}");

    let more = "More cases may tell which of these matters.";
    let one = said(&twice_wrong_where(&all(), is_stiff));
    assert!(one.contains("systems with c from ") && !one.contains(more), "{one}");
    let mut alike = all();
    alike.retain(|problem| is_stiff(&problem.system) == (problem.system.m > number("2")));
    let several = said(&twice_wrong_where(&alike, is_stiff));
    assert!(several.contains(", or ") && several.contains(more), "{several}");
}

/// Every second answer is the one before, also when the request is repeated.
#[test]
fn answers_of_earlier_requests_are_reported_by_both_requests() {
    let problems = all();
    let place = |id: &str| problems.iter().position(|problem| id == problem.id).expect("a request");
    let stale = report(&problems, |problem| {
        let place = place(&problem.id);
        right(&problems[place - place % 2])
    });
    let options = Options::augment_args(clap::Command::new("check"));
    let options = Options::from_arg_matches(&options.get_matches_from(["check", "--", "program"]));
    let json = serde_json::to_value(json::report("program", &options.expect("options"), &stale));
    let json = json.expect("a report");
    let pairs = json["carried_over"].as_array().expect("pairs").iter();
    let pairs: Vec<_> = pairs.map(|pair| [0, 1].map(|end| pair[end].as_str().expect("an id"))).collect();
    assert!(
        pairs.len() > 9 && pairs.iter().all(|[id, earlier]| place(id) == place(earlier) + 1),
        "{pairs:?}"
    );
    let said = said(&stale);
    let ([id, earlier], count, wrong) = (pairs[0], pairs.len(), stale.summary().wrong);
    let text = format!(
        "The program carries something over from earlier requests: {count} of {wrong} wrong answers are the right \
         ones of an earlier request; that to {id} is that to {earlier}."
    );
    assert!(said.contains(&text) && !said.contains(UNEXPLAINED), "{said}");
}

#[test]
fn errors_that_do_not_grow_are_reported() {
    let part = |problem: &Problem| number(if problem.id.len().is_multiple_of(2) { "1" } else { "0.7" });
    for (off, text) in [
        ([Some("1e-6"), None], "the largest is 1e-6 m of u. "),
        ([None, Some("1e-3")], "the largest is 0.001 N of N. "),
        ([Some("1e-6"), Some("1e-3")], "the largest is 1e-6 m of u, 0.001 N of N. "),
    ] {
        let off = off.map(|off| number(off.unwrap_or("0")));
        let said = said(&report(&all(), |problem| {
            let (exact, [u, n]) = (problem.solution(), off.each_ref().map(|off| off * part(problem)));
            Answer::new(exact.deflection + u, exact.contact_force + n)
        }));
        assert!(said.contains(text) && !said.contains(UNEXPLAINED), "{said}");
    }
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
    let text = format!(
        "The reported steps of all {of} systems show it: N is one step behind. N_k = m g − c u_{{k−1}}"
    );
    assert!(said(&lagging).contains(&text), "{}", said(&lagging));
}

/// The requested penalty is not reported.
#[test]
fn a_penalty_is_printed_with_its_scale() {
    let by_penalty = |asked: Option<&str>, eps: fn(&SpringMass<Exact>) -> Exact| {
        let asked = |problem| Problem { penalty: asked.map(number), ..problem };
        let problems: Vec<_> = all().into_iter().map(asked).collect();
        said(&report(&problems, |problem| {
            right(&Problem { penalty: Some(eps(&problem.system)), ..problem.clone() })
        }))
    };
    for (asked, eps, text) in [
        (None, (|_| number("1e4")) as fn(&SpringMass<Exact>) -> Exact, "ε = 10000 N/m. "),
        (Some("1e6"), |_| number("1e4"), "ε is 0.01 times the right value; ε is always 10000; "),
        (None, |system| &system.c * number("50"), "ε = 50 c, or an iteration that always stops after"),
        (None, |system| &system.m * number("7e3"), "ε = 7000/s² m. "),
    ] {
        let said = by_penalty(asked, eps);
        assert!(said.contains(text), "{said}");
    }
    let right = by_penalty(Some("1e4"), |_| number("1e4"));
    assert!(right.contains("No error"), "{right}");
}

/// The report on a right program contains only what was tested: families, systems, and the smallest |R| among
/// them.
#[test]
fn the_report_lists_the_tested_penalties() {
    let said_of = |families: &[Family], refused: &str| {
        let ask = |problem: &Problem| {
            let answer = || Reply::Answered(Box::new(right(problem)));
            let refuses = problem.family.name() == refused;
            Ok::<_, Infallible>(if refuses { Reply::Refused("no".into()) } else { answer() })
        };
        said(&check(&problems(1, 1, families), &number("1e-6"), ask).expect("no failure"))
    };
    let all = said_of(Family::ALL, "");
    assert!(
        all.contains("No error above 1e-6 was found in 28 systems of 14 families, with one unknown and one")
    );
    let contact = &problems(1, 1, &[Family::Contact])[0].system;
    let loads = system::weight(contact) + &contact.c * system::gap(contact);
    let least = (system::reaction(contact) / loads).decimal(ERROR_DIGITS, Round::Up);
    let text = format!(
        "No error above 1e-6 was found in 1 system of 1 family, with one unknown and one plane. Missed \
         contact would be detected from |R| = {least} (|m g| + |c (H − l)|) on, false contact would not be \
         detected."
    );
    let one = said_of(&[Family::Contact], "");
    assert!(one.ends_with(&text), "{text}\n{one}");
    // A family without answers leaves the result open.
    let refused = said_of(Family::ALL, "stiff");
    assert!(refused.ends_with("Every system of stiff was refused, so its result is unknown."), "{refused}");
}
