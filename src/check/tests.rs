//! Tests that wrong solvers are detected and distinguished.

mod diagnosed;
mod judged;
mod named;

use super::mistakes::{
    Constants, Mistake, candidates, fitted, in_single, mistakes, reference, value, value_in_single, values,
};
use super::*;
use crate::chapter::{SpringMass, augmented, contact, structure, system};
use crate::claims::hypotheses;
use crate::formula::claim::equal;
use crate::number::{PositivePart, ToExact};
use crate::proof::prove;
use crate::solver::{Augmentation, Method, State, solve};
use num_traits::Zero;
use rug::float::Round;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::convert::Infallible;

const TOLERANCE: &str = "1e-6";

fn number(text: &str) -> Exact {
    text.parse().unwrap()
}

/// Returns one of four mistakes, or all with `DEEP=1`. Similar ones are adjacent, so some of each kind are tested.
fn sample<T>(mistakes: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
    let is_deep = std::env::var_os("DEEP").is_some_and(|value| value == "1");
    mistakes.into_iter().step_by(if is_deep { 1 } else { 4 })
}

fn default_problems() -> Vec<Problem> {
    problems(1, CASES, &Family::ALL)
}

/// Adds penalties that are different for all systems, also as multiples of c.
fn with_penalties(mut problems: Vec<Problem>) -> Vec<Problem> {
    for (i, problem) in problems.iter_mut().enumerate() {
        problem.penalty = Some(&problem.system.c * Exact::from(i as i32 + 2));
    }
    problems
}

/// Returns the problem of a system with these c, m, g, l and H.
fn problem(id: &str, family: Family, parameters: [&str; 5]) -> Problem {
    let [c, m, g, l, h] = parameters.map(number);
    Problem { id: id.to_string(), family, system: SpringMass { c, m, g, l, h }, penalty: None }
}

fn run(problems: &[Problem], solver: impl Fn(&Problem) -> Answer) -> Report {
    run_within(TOLERANCE, problems, solver)
}

fn run_within(tolerance: &str, problems: &[Problem], solver: impl Fn(&Problem) -> Answer) -> Report {
    let ask = |problem: &Problem| Ok::<_, Infallible>(Reply::Answered(Box::new(solver(problem))));
    check(problems, &number(tolerance), ask).unwrap()
}

/// Returns the answer of a program with this mistake and these constants.
fn answer(mistake: &Mistake, problem: &Problem, penalty: Option<&Exact>, factor: Option<&Exact>) -> Answer {
    let constants = Constants { penalty, factor };
    let [u, n] = mistake.formulas(mistake.reaction(&problem.system, &constants) > Exact::zero());
    let value = |tree| value(tree, &problem.system, &constants);
    Answer { deflection: value(u), contact_force: value(n), ..Answer::default() }
}

/// Rounds to single precision.
fn single(x: &Exact) -> Exact {
    x.to_f32().unwrap().to_exact().unwrap()
}

#[test]
fn every_mistake_is_diagnosed_as_itself() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for mistake in sample(mistakes(problems[0].penalty.is_some())) {
            let eps = number("3e5");
            let solve = |problem: &Problem| {
                let eps = problem.penalty.as_ref().or(mistake.measured.map(|_| &eps));
                answer(mistake, problem, eps, None)
            };
            let report = run(&problems, solve);
            assert!(!report.holds(), "{} holds", mistake.name);
            let found = report.diagnosis.iter().map(|d| (&d.name, &d.formula, d.answers, &d.at));
            let own = [(&mistake.name, &mistake.formula(), DiagnosisScope::All, &mistake.at)];
            assert_eq!(Vec::from_iter(found), own, "{}", mistake.name);
        }
    }
}

/// No decimal of six digits is the exact constant.
#[test]
fn a_constant_factor_is_diagnosed() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        let by_penalty = problems[0].penalty.is_some();
        for (mistake, k) in sample(fitted(by_penalty).iter().flat_map(|mistake| {
            let bound = mistake.name.contains("at most");
            // Constants of units, fractions of a step, and bounds within the range of the values.
            let constants: &[&str] = match () {
                () if bound => &["1/30", "7/3"],
                () if mistake.name.starts_with("the augmentation") => &["1e4", "3e6"],
                () if mistake.is_share => &["31/32", "1/3"],
                // A spring with negative stiffness is not tested.
                () if mistake.name.starts_with("c ") => &["1000", "1/3", "0.001"],
                () => &["1000", "1/3", "0.001", "-3"],
            };
            constants.iter().map(move |k| (mistake, number(k)))
        })) {
            let report =
                run(&problems, |problem| answer(mistake, problem, problem.penalty.as_ref(), Some(&k)));
            let found = report.diagnosis.iter().map(|d| (d.name.clone(), d.formula.clone()));
            let k = k.decimal(6, Round::Nearest);
            let own = (mistake.name.replace("{k}", &k), format!("{}, k = {k}", mistake.formula()));
            assert_eq!(Vec::from_iter(found), std::slice::from_ref(&own), "{}", own.0);
        }
    }
}

/// By default an error of 6e-8 of c, m, g or R is within the tolerance, but not that of a difference.
#[test]
fn a_single_rounding_to_f32_is_diagnosed() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for mistake in in_single(problems[0].penalty.is_some()) {
            let solve = |problem: &Problem| {
                let [u, n] = mistake.formulas(system::reaction(&problem.system) > Exact::zero());
                let value = |tree| value_in_single(tree, &problem.system, problem.penalty.as_ref());
                // As printed by a program.
                let printed = |x: Option<Exact>| Some(number(&x?.to_f64().unwrap().to_string()));
                let [u, n] = [value(u), value(n)].map(printed);
                Answer { deflection: u, contact_force: n, ..Answer::default() }
            };
            for tolerance in [TOLERANCE, "1e-12"] {
                let report = run_within(tolerance, &problems, solve);
                let names = Vec::from_iter(report.diagnosis.iter().map(|d| d.name.as_str()));
                let shows = tolerance != TOLERANCE
                    || ["l", "H", "H − l"].iter().any(|name| {
                        mistake.name == format!("{name} is rounded to single precision") && *name != "H − l"
                            || mistake.name == format!("{name} is computed in single precision")
                    });
                let expected = if shows { vec![mistake.name.as_str()] } else { vec![] };
                assert_eq!(names, expected, "{tolerance}");
                assert_eq!(report.holds(), !shows, "{}", mistake.name);
            }
        }
    }
}

/// Two mistakes that agree for all default systems are one.
#[test]
fn mistakes_treated_as_equal_are_proved_equal() {
    let given = hypotheses();
    let given = [&given.stiffness, &given.penalty];
    for by_penalty in [false, true] {
        let kept = [reference(by_penalty)].into_iter().chain(mistakes(by_penalty).iter().cloned());
        let kept: HashMap<_, _> = kept.map(|mistake| (values(&mistake), mistake)).collect();
        for mistake in candidates(by_penalty) {
            let same = &kept[&values(&mistake)];
            let pairs = [(&same.in_contact, &mistake.in_contact), (&same.separated, &mistake.separated)];
            for (a, b) in pairs.into_iter().flat_map(|(a, b)| a.iter().zip(b)) {
                let claim = equal("same", a, b).assuming(given);
                assert!(a == b || prove(&claim).is_ok(), "{} and {}: {a} and {b}", same.name, mistake.name);
            }
        }
    }
}

/// In f64, like a program that parses the decimals of a request.
#[test]
fn rounding_hides_no_mistake() {
    for mistake in sample(mistakes(false)) {
        let solve = |problem: &Problem| {
            let system = problem.system.try_map(Exact::to_f64).unwrap();
            let [u, n] = mistake.formulas(system::reaction(&system) > 0.0);
            let number = |tree| {
                let infinite = |x: f64| x.to_exact().ok();
                let constants = Constants { penalty: mistake.measured.map(|_| &3e5), factor: None };
                value(tree, &system, &constants).and_then(infinite)
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
fn systems_have_the_property_of_their_family() {
    let all = problems(1, 40, &Family::ALL);
    let short = |x: &Exact| x.decimal(DIGITS, Round::Nearest).parse().as_ref() == Ok(x);
    for Problem { id, family, system, .. } in &all {
        let SpringMass { c, m, g, l, h } = system;
        assert!([c, m, g, l, h].into_iter().all(short), "{id}: {system}");
        let (gap, state) = (system::gap(system), State::of(system).unwrap());
        let (zero, free) = (Exact::zero(), structure::deflection(system));
        let between = |x: &Exact, low: &str, high: &str| number(low) <= *x && *x < number(high);
        let holds = match family {
            Family::Contact => state == State::Contact && gap > zero,
            Family::Separated => state == State::Separated && *g > zero,
            Family::Grazing => state == State::Grazing && between(&gap, "1e-3", "1"),
            Family::Near => {
                // One unit of the twelfth digit of a number in m g or in c Δ.
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
            Family::Graded => between(&part(system), "0.99e-9", "0.1") && gap > zero && *g > zero,
        };
        assert!(holds, "{id}: {system}");
    }
    let states = |family: Family| {
        let of = all.iter().filter(|problem| problem.family == family);
        of.map(|problem| State::of(&problem.system).unwrap()).collect::<HashSet<_>>()
    };
    use Family::*;
    for family in [Near, Lifted, Stiff, Soft, Far, Huge, Tiny, Graded] {
        assert_eq!(states(family), HashSet::from([State::Contact, State::Separated]), "{family}");
    }
    // Both states alternate if the family allows it; those near grazing may be on either side.
    for Problem { id, family, system, .. } in &all {
        let odd = id.ends_with(['1', '3', '5', '7', '9']);
        let expected = if odd { State::Contact } else { State::Separated };
        let by_turns = [Lifted, Stiff, Soft, Far, Huge, Tiny].contains(family);
        assert!(!by_turns || State::of(system).unwrap() == expected, "{id}: {system}");
    }
    // Each of four parameters in turn has more than ten digits, one unit above or below.
    let mut changed = HashSet::new();
    for Problem { id, system, .. } in all.iter().filter(|problem| problem.family == Near) {
        let SpringMass { c, m, g, l: _, h } = system;
        let is_short = |x: &Exact| x.decimal(DIGITS - 2, Round::Nearest).parse().as_ref() == Ok(x);
        let [pulls, holds] = [[m, g], [c, h]].map(|of| of.map(|x| !is_short(x)));
        changed.insert((pulls, holds));
        let odd = id.ends_with(['1', '3', '5', '7', '9']);
        let touches = State::of(system).unwrap() == State::Contact;
        assert_eq!(touches, odd == pulls.contains(&true), "{id}");
    }
    assert_eq!(changed.len(), 4, "{changed:?}");
    let grazing = problems(1, 400, &[Grazing]);
    let masses: HashSet<_> = grazing.iter().map(|problem| problem.system.m.to_string()).collect();
    let expected =
        [1, 5].into_iter().flat_map(|n| (-2..=5).map(move |k| Exact::from(n) * Exact::power_of_two(k)));
    assert_eq!(masses, expected.map(|m| m.to_string()).collect());
    // Some systems have zero or negative length, and a plane below a lifted mass.
    let share = |family: Family, is_so: fn(&SpringMass<Exact>) -> bool| {
        let of = all.iter().filter(|problem| problem.family == family);
        of.filter(|problem| is_so(&problem.system)).count()
    };
    assert!((1..20).contains(&share(Stiff, |system| system.l.is_zero())));
    assert!((1..20).contains(&share(Far, |system| system.l < Exact::zero())));
    assert!((1..10).contains(&share(Lifted, |system| system::gap(system) > Exact::zero())));
    // The systems depend on the seed, and those of a family not on the others.
    assert_eq!(problems(1, 3, &[Stiff]), problems(1, 40, &Family::ALL)[240..243]);
    assert_ne!(problems(2, 3, &[Stiff]), problems(1, 3, &[Stiff]));
    // Also for seeds that agree in their lower bits.
    for other in [1 | 1 << 32, 1 | 1 << 63] {
        assert_ne!(problems(other, 3, &[Stiff]), problems(1, 3, &[Stiff]), "{other}");
    }
}

/// Returns |R| relative to |m g| + |c (H − l)|.
fn part(system: &SpringMass<Exact>) -> Exact {
    let loads = system::weight(system).abs() + (&system.c * system::gap(system)).abs();
    system::reaction(system).abs() / loads
}

/// Every decade has systems on both sides, for any number of systems. The first two of a decade lie in its
/// lowest quarter, of which 16 is the last number of E24.
#[test]
fn grades_are_spread_over_every_decade_on_either_side() {
    for cases in [2, 3, 5, 12] {
        let all = problems(1, cases, &[Family::Graded]);
        assert_eq!(all.len() as u64, 8 * cases);
        for decade in (-9..-1).map(|power| number(&format!("1e{power}"))) {
            let of = |state: State| {
                let of = all.iter().filter(|problem| State::of(&problem.system).unwrap() == state);
                let parts = of.map(|problem| part(&problem.system) / &decade);
                let parts = parts.filter(|x| number("0.99") <= *x && *x < number("9.9"));
                Vec::from_iter(parts)
            };
            for parts in [of(State::Contact), of(State::Separated)] {
                assert!(parts.len() as u64 >= cases / 2, "{decade}");
                // The error of a parameter with twelve digits is 5e-12, a four-hundredth of 2e-9.
                assert!(*parts.iter().min().unwrap() <= number("1.61"), "{decade}");
                // On a logarithmic scale half of them are below the middle.
                let low = parts.iter().filter(|x| **x < number("3.2")).count();
                assert!((parts.len() / 2..=parts.len().div_ceil(2)).contains(&low), "{decade}: {low}");
            }
        }
    }
}

/// All bits of the index and the seed are used.
#[test]
fn no_two_systems_are_the_same() {
    let mut seen = HashMap::new();
    let mut assert_new = |seed: u64, problem: Problem| {
        let own = format!("{} of seed {seed}", problem.id);
        let other = seen.insert(problem.system.to_string(), own.clone());
        assert_eq!(other, None, "{own}");
    };
    for problem in problems(1, 1000, &Family::ALL) {
        assert_new(1, problem);
    }
    for seed in (1..64).map(|bit| 1 + (1 << bit)) {
        problems(seed, 2, &[Family::Contact]).into_iter().for_each(|problem| assert_new(seed, problem));
    }
}

#[test]
fn a_force_is_written_by_its_deflection() {
    let no_plane = mistakes(false).iter().find(|mistake| mistake.name == "there is no plane").unwrap();
    assert_eq!(no_plane.formula(), "u = m g / c, N = 0");
    let formula = reference(true).formula();
    let (_, force) = formula.split_once(", N = ").unwrap();
    assert!(force.contains('u') && !force.contains('/'), "{formula}");
}

#[test]
fn every_mutant_is_named_by_an_equation() {
    let mutants = mistakes(true).iter().filter(|mistake| !mistake.at.is_empty());
    let (named, others): (Vec<_>, Vec<_>) = mutants
        .map(|mutant| &mutant.name)
        .partition(|name| name.contains("as (1.") || name.contains("as note "));
    assert!(!named.is_empty() && others.is_empty(), "{others:?}");
}

/// l + u − H of (1.5), and ε p of (1.12).
#[test]
fn a_mutant_is_named_by_its_equation() {
    let names: HashSet<_> = mistakes(true).iter().map(|mistake| mistake.name.as_str()).collect();
    assert!(names.contains("as (1.5) with l → H in operand 1") && names.contains("as (1.12) with a × b → b"));
}

#[test]
fn names_agree_with_the_command_line_and_json() {
    for family in Family::ALL {
        assert_eq!(family.name().parse(), Ok(family));
    }
    assert_eq!("flat".parse::<Family>(), Err(UnknownFamily));
    let verdicts = [Verdict::Right, Verdict::WithinTolerance, Verdict::Wrong, Verdict::TimedOut];
    assert_eq!(verdicts.map(|it| it.to_string()), ["right", "within_tolerance", "wrong", "timed_out"]);
    let quantities = [
        ThresholdQuantity::Penetration,
        ThresholdQuantity::ForceByWeight,
        ThresholdQuantity::PenetrationByHeight,
    ];
    let names = ["penetration", "force_by_weight", "penetration_by_height"];
    assert_eq!(quantities.map(|it| it.to_string()), names);
    let answers = [DiagnosisScope::All, DiagnosisScope::Wrong, DiagnosisScope::Steps];
    assert_eq!(answers.map(|it| it.to_string()), ["all", "wrong", "steps"]);
}

#[test]
fn the_book_lists_all_known_mistakes() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/check.md");
    let page = std::fs::read_to_string(page).unwrap();
    let (_, list) = page.split_once("Known are").expect("a list that begins with \"Known are\"");
    let is_edit = |name: &str| name.starts_with("as ") || name.contains(", and as ");
    let all = [false, true].into_iter().flat_map(|by_penalty| {
        [mistakes(by_penalty), fitted(by_penalty), in_single(by_penalty)].into_iter().flatten()
    });
    let as_listed = |mistake: &Mistake| {
        let name = mistake.name.replace("{k}", "*k*");
        let steps = |n: &i32| name.contains(&format!(" after {n} steps, "));
        let counted = (2..=20).find(steps);
        counted.map_or(name.clone(), |n| name.replace(&format!(" {n} steps"), " 2 to 8 steps"))
    };
    let names = all.filter(|mistake| !is_edit(&mistake.name)).map(as_listed);
    let unnamed: BTreeSet<_> = names.filter(|name| !list.contains(name)).collect();
    assert!(
        unnamed.is_empty(),
        "book/src/check.md does not name {unnamed:?}: add each, spelled like this, \
         to the list that begins with \"Known are\""
    );
    let names = Family::ALL.into_iter().map(|family| format!("`{family}`"));
    let unnamed: Vec<_> = names.filter(|name| !page.contains(name)).collect();
    assert!(
        unnamed.is_empty(),
        "book/src/check.md does not name the families {unnamed:?}: add each to the table of families"
    );
}
