//! Tests that wrong solvers are detected and distinguished.

mod diagnosed;
mod explained;
mod judged;
mod programs;

use super::diagnosis::with_penalties;
use super::observation::Observation;
use super::program::{Known, Program, Reference};
use super::scales::scales;
use super::*;
use crate::chapter::{SpringMass, augmented, contact, structure, system};
use crate::number::{PositivePart, ToExact};
use crate::solver::{Augmentation, Method, State, solve};
use num_traits::Zero;
use rug::float::Round;
use std::collections::{HashMap, HashSet};
use std::convert::Infallible;

const TOLERANCE: &str = "1e-6";

fn number(text: &str) -> Exact {
    text.parse().unwrap()
}

/// Returns one of `one_of` mistakes, or all with `DEEP=1`. Similar ones are adjacent, so some of each kind are
/// tested.
fn sample<T>(mistakes: impl IntoIterator<Item = T>, one_of: usize) -> impl Iterator<Item = T> {
    let is_deep = std::env::var_os("DEEP").is_some_and(|value| value == "1");
    mistakes.into_iter().step_by(if is_deep { 1 } else { one_of })
}

fn default_problems() -> Vec<Problem> {
    problems(1, CASES, Family::ALL)
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

/// Returns the answer of a program with this number k.
fn answer(program: &Program, problem: &Problem, k: Option<&Exact>) -> Answer {
    let [deflection, contact_force] = program.answer(problem, k);
    Answer { deflection, contact_force, ..Answer::default() }
}

/// Returns the right u and N for a system, by penalty if one is given.
fn solution(system: SpringMass<Exact>, penalty: Option<Exact>) -> [Exact; 2] {
    let exact = Problem { id: String::new(), family: Family::Contact, system, penalty }.solution();
    [exact.deflection, exact.contact_force]
}

/// Returns the right answer for other parameters.
fn solved(c: &Exact, m: &Exact, g: &Exact, l: &Exact, h: &Exact) -> [Exact; 2] {
    let [c, m, g, l, h] = [c, m, g, l, h].map(Exact::clone);
    solution(SpringMass { c, m, g, l, h }, None)
}

/// Returns the right answer for rounded lengths.
fn with_lengths(s: &SpringMass<Exact>, round: impl Fn(&Exact) -> Exact) -> [Exact; 2] {
    solved(&s.c, &s.m, &s.g, &round(&s.l), &round(&s.h))
}

fn right(problem: &Problem) -> Answer {
    let [u, n] = solution(problem.system.clone(), problem.penalty.clone());
    Answer::new(u, n)
}

/// Returns the names of what explains the answers, with those of the same results.
fn names(report: &Report) -> Vec<&str> {
    let named = report.fitting().flat_map(|found| [&found.name].into_iter().chain(&found.equivalent));
    named.map(String::as_str).collect()
}

/// Returns u and N in equilibrium for N (N − R) = k/100.
fn on_curve(exact: &SpringMass<Exact>, k: &Exact) -> [Exact; 2] {
    let system = exact.as_ref().try_map(Exact::to_f64).unwrap();
    let (r, k) = (system::reaction(&system), k.to_f64().unwrap() / 100.0);
    let root = (r * r + 4.0 * k).sqrt();
    let n = if r > 0.0 { (r + root) / 2.0 } else { 2.0 * k / (root - r) };
    let n = n.to_exact().unwrap();
    let u = (system::weight(exact) - &n) / &exact.c;
    [u.to_f64().unwrap().to_exact().unwrap(), n]
}

fn rounded(x: &Exact, digits: usize) -> Exact {
    number(&x.decimal(digits, Round::Nearest))
}

fn decimals(x: &Exact, n: usize) -> Exact {
    number(&format!("{:.n$}", x.to_f64().unwrap()))
}

/// Returns a report on answers that are all changed in the same way.
fn changed_in(problems: &[Problem], change: impl Fn(&Problem, Exact, Exact) -> [Exact; 2]) -> Report {
    run(problems, |problem| {
        let exact = problem.solution();
        let [u, n] = change(problem, exact.deflection, exact.contact_force);
        Answer::new(u, n)
    })
}

#[test]
fn systems_have_the_property_of_their_family() {
    let all = problems(1, 40, Family::ALL);
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
            Family::Signed => [number("9.81"), number("9.80665")].contains(&g.abs()),
            Family::Neighbour => {
                let bases = problems(1, 40, &[Family::Contact]);
                let differing = |base: &Problem| {
                    let pairs = base.system.as_ref().zip(system.as_ref()).into_array();
                    let differing: Vec<_> = pairs.into_iter().filter(|(a, b)| a != b).collect();
                    matches!(differing[..], [(a, b)] if (a * number("1.001") - b).abs() <= b.abs() * number("1e-11"))
                };
                bases.iter().any(differing)
            }
        };
        assert!(holds, "{id}: {system}");
    }
    let is_odd = |id: &str| id.ends_with(['1', '3', '5', '7', '9']);
    let states = |family: Family| {
        let of = all.iter().filter(|problem| problem.family == family);
        of.map(|problem| State::of(&problem.system).unwrap()).collect::<HashSet<_>>()
    };
    use Family::*;
    for family in [Near, Lifted, Stiff, Soft, Far, Huge, Tiny, Graded, Signed] {
        assert_eq!(states(family), HashSet::from([State::Contact, State::Separated]), "{family}");
    }
    // Without contact the gap of a lifted mass has either sign.
    let lifted = all
        .iter()
        .filter(|problem| problem.family == Lifted && State::of(&problem.system) == Ok(State::Separated));
    let gaps: HashSet<_> = lifted.map(|problem| system::gap(&problem.system) > Exact::zero()).collect();
    assert_eq!(gaps.len(), 2);
    // Each of four parameters in turn has more than ten digits, one unit above or below.
    let mut changed = HashSet::new();
    for Problem { id, system, .. } in all.iter().filter(|problem| problem.family == Near) {
        let SpringMass { c, m, g, l: _, h } = system;
        let is_short = |x: &Exact| x.decimal(DIGITS - 2, Round::Nearest).parse().as_ref() == Ok(x);
        let [pulls, holds] = [[m, g], [c, h]].map(|of| of.map(|x| !is_short(x)));
        changed.insert((pulls, holds));
        let touches = State::of(system).unwrap() == State::Contact;
        assert_eq!(touches, is_odd(id) == pulls.contains(&true), "{id}");
    }
    assert_eq!(changed.len(), 4, "{changed:?}");
    // Rounding the parameters to f64 does not exceed the tolerance, even in a system with a gap of 2.3e-10 m.
    let stiff = &problems(1, 3283, &[Stiff])[3282];
    let rounded = Problem {
        system: stiff.system.as_ref().map(|x| x.to_f64().unwrap().to_exact().unwrap()),
        ..stiff.clone()
    };
    let off = (stiff.solution().deflection - rounded.solution().deflection).abs();
    assert!(off <= number(TOLERANCE) * scales(&stiff.system)[0].clone(), "{}", stiff.system);
}

/// For g > 0 > H − l there is always contact, and for g < 0 < H − l never.
#[test]
fn every_combination_of_signs_and_state_occurs_by_default() {
    let signs = default_problems().into_iter().map(|problem| {
        let SpringMass { g, l, h, .. } = &problem.system;
        let gap = system::gap(&problem.system);
        ([g, h, l, &gap].map(|x| x.cmp(&Exact::zero()) as i32), State::of(&problem.system).unwrap())
    });
    let occurring: HashSet<_> = signs.collect();
    let mut missing = Vec::new();
    for (h, l, gap) in [(1, 1, 1), (1, 1, -1), (1, -1, 1), (-1, 1, -1), (-1, -1, 1), (-1, -1, -1)] {
        for (g, state) in [1, -1].into_iter().flat_map(|g| [(g, State::Contact), (g, State::Separated)]) {
            let is_possible = g == gap || (g > 0) == (state == State::Contact);
            missing.extend(
                (is_possible && !occurring.contains(&([g, h, l, gap], state)))
                    .then_some((g, h, l, gap, state)),
            );
        }
    }
    assert!(missing.is_empty(), "{missing:?}");
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
    for problem in problems(1, 1000, Family::ALL) {
        assert_new(1, problem);
    }
    for seed in (1..64).map(|bit| 1 + (1 << bit)) {
        problems(seed, 2, &[Family::Contact]).into_iter().for_each(|problem| assert_new(seed, problem));
    }
}

#[test]
fn names_are_those_of_json() {
    assert_eq!("neighbour".parse(), Ok(Family::Neighbour));
    assert_eq!("flat".parse::<Family>(), Err(UnknownFamily));
    assert_eq!(AnswerVerdict::WithinTolerance.to_string(), "within_tolerance");
    assert_eq!(ThresholdQuantity::ForceByWeight.to_string(), "force_by_weight");
    assert_eq!(DiagnosisScope::Wrong.to_string(), "wrong");
}

#[test]
fn the_book_lists_all_families() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/check.md");
    let page = std::fs::read_to_string(page).unwrap();
    let names = Family::ALL.iter().map(|family| format!("`{family}`"));
    let unnamed: Vec<_> = names.filter(|name| !page.contains(name)).collect();
    assert!(
        unnamed.is_empty(),
        "book/src/check.md does not name the families {unnamed:?}: add each to the table of families"
    );
}
