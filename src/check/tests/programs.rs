//! Tests of the right programs, and of wrong ones by their results.

use super::*;
use crate::check::diagnosis::results;

#[test]
fn references_are_right() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for program in Reference::of(&problems).programs() {
            for problem in &problems {
                assert_eq!(answer(&program, problem, None), right(problem), "{:?}", program.lines());
            }
        }
    }
}

/// No number is edited, and nothing is divided by 0.
#[test]
fn no_edit_is_useless() {
    for reference in [Reference::Multiplier, Reference::Penalty] {
        let is_useless = |name: &str| name.ends_with(" instead of 0") || name.contains("/ 0");
        assert!(reference.edits().iter().all(|mistake| !is_useless(&mistake.name)));
    }
}

/// A name is replaced by those of the same unit that are computed before it, and a bracket by an absolute value.
#[test]
fn edits_are_programs() {
    let system = problem("own", Family::Contact, ["100", "2", "9.81", "0.5", "0.6"]);
    let problem = &with_penalties(vec![system])[0];
    let multiplier = ["N = |R| instead of ⟨R⟩", "in contact N = m g − c gap instead of m g − c u"];
    let penalty = ["in contact N = ε |p| instead of ε p", "ε is not used: the plane is rigid"];
    for (reference, names) in [(Reference::Multiplier, multiplier), (Reference::Penalty, penalty)] {
        let all = reference.edits();
        assert!(all.iter().all(|edit| edit.program.answer(problem, None) != [None, None]));
        assert!(names.iter().all(|name| all.iter().any(|edit| edit.name == *name)), "{names:?}");
    }
}

/// An edit is named, or one with the same results, in rationals and mostly in f64, unless it changes no answer beyond
/// the tolerance.
#[test]
fn every_edit_is_named() {
    let (mut named, mut silent) = (0, 0);
    for problems in [default_problems(), with_penalties(default_problems())] {
        let all = Reference::of(&problems).edits();
        let all_results: Vec<_> = all.iter().map(|mistake| results(mistake, None)).collect();
        for (i, mistake) in sample(&all, 240).enumerate() {
            let in_f64 = i % 2 == 1;
            let report = run(&problems, |problem| match in_f64 {
                true => answer_in_f64(&mistake.program, problem),
                false => answer(&mistake.program, problem, None),
            });
            // Rounding errors in f64 may be as large as the errors.
            if report.summary().wrong < 3 || in_f64 && report.diagnosis.is_empty() {
                silent += 1;
                continue;
            }
            let of_mistake = results(mistake, None);
            let name = &all[all_results.iter().position(|results| *results == of_mistake).unwrap()].name;
            assert!(names(&report).contains(&name.as_str()), "{}: {:?}", mistake.name, report.diagnosis);
            assert!(report.fitting().all(|found| found.answers == DiagnosisScope::All), "{name}");
            named += 1;
        }
    }
    assert!(named > 2 * silent, "{named} are named, {silent} change nothing");
}

/// Returns the answer in f64, as of a program that parses the decimals of a request.
fn answer_in_f64(program: &Program, problem: &Problem) -> Answer {
    let system = problem.system.as_ref().try_map(Exact::to_f64).unwrap();
    let eps = problem.penalty.as_ref().map(|eps| eps.to_f64().unwrap());
    let known = Known::new(&system, eps.as_ref(), None);
    let values = program.values(&known, program.touches(&known));
    let [deflection, contact_force] = values.map(|x| x?.to_exact().ok());
    Answer { deflection, contact_force, ..Answer::default() }
}

/// No decimal of six digits is the exact number.
#[test]
fn every_number_is_found() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for mistake in sample(Reference::of(&problems).numbers(), 24) {
            let k = number(match mistake.name.as_str() {
                name if name.contains("augmentation") || name.contains("N/m") => "10000/3",
                name if name.contains("at most") || name.contains("at least") => "7/3",
                _ => "1/3",
            });
            let report = run(&problems, |problem| answer(&mistake.program, problem, Some(&k)));
            // Three digits are named if they have the same results to the tolerance.
            let is_named = [3, 6].into_iter().any(|digits| {
                let k = number(&k.decimal(digits, Round::Nearest)).decimal(6, Round::Nearest);
                names(&report).contains(&mistake.name.replace("{k}", &k).as_str())
            });
            // An output that is wrong by a factor is described as such.
            let is_output = names(&report).iter().all(|name| name.contains("times the right value"));
            assert!(is_named || is_output, "{}: {:?}", mistake.name, report.diagnosis);
        }
    }
}

#[test]
fn numbers_change_what_they_say() {
    let (k, all) = (number("1/3"), Reference::Multiplier.numbers());
    let assert_changes = |name: &str, symbols: &[&str], change: fn(&Exact, &Exact) -> Exact| {
        let mistake = all.iter().find(|mistake| mistake.name == name).expect(name);
        for problem in default_problems() {
            let parameters = SpringMass::SYMBOLS.zip(problem.system.as_ref());
            let system = parameters
                .map(|(symbol, x)| if symbols.contains(&symbol) { change(x, &k) } else { x.clone() });
            let found = answer(&mistake.program, &problem, Some(&k));
            assert_eq!(found, right(&Problem { system, ..problem }), "{name}");
        }
    };
    for x in SpringMass::SYMBOLS.into_array() {
        assert_changes(&format!("{x} is {{k}} times the right value"), &[x], |x, k| k * x);
        assert_changes(&format!("{x} is always {{k}}"), &[x], |_, k| k.clone());
        assert_changes(&format!("{{k}} is added to {x}"), &[x], |x, k| x + k);
    }
    assert_changes("l and H are {k} times the right values", &["l", "H"], |x, k| k * x);
}
