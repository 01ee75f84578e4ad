//! That wrong solvers are found out, and told apart.

use super::mistakes::{Mistake, every, mistakes, none, value, values};
use super::*;
use crate::chapter::system;
use crate::claims::given;
use crate::formula::{Claim, Kind, Statement};
use crate::proof::prove;
use num_traits::Zero;
use std::collections::HashMap;
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
                answer(&mistake, problem, eps)
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
                let claim = Claim::new("same", &given, Kind::Equal(a.clone(), b.clone()));
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
