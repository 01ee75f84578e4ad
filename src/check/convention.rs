//! Conventions of the output: sign, scale and offset of u and of N, which hold for all answers.

use super::answer::Reply;
use super::assessment::CaseResult;
use super::diagnosis::SAMPLES;
use super::observation::{INFORMATIVE, Observation};
use super::scales::{decimal, format_short};
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};

/// A number that is returned for u or N: a multiple of it, or its sum with a constant.
#[derive(Clone)]
struct Returned {
    factor: Exact,
    sum: Exact,
    /// The larger the less usual; 0 for u or N itself.
    rank: usize,
}

/// The numbers that are returned for u and N.
pub(super) struct Convention([Returned; 2]);

impl Returned {
    /// Returns signs, units, and the sum that most answers have: each if several answers are right with it, and several
    /// more are nearer than farther. (With any factor, other mistakes would have the same results.)
    fn candidates(i: usize, answers: &[&Observation], fit: &Exact) -> Vec<Self> {
        let numbers = answers.iter().filter_map(|answer| {
            Some((answer.numbers()[i].clone()?, answer.exact(i).clone(), fit * &answer.scales[i]))
        });
        let numbers: Vec<_> = numbers.collect();
        let sum = common(numbers.iter().map(|(number, exact, _)| number - exact).collect(), fit);
        let factors = [(1, 0), (-1, 0), (1, 3), (1, -3), (-1, 3), (-1, -3)].into_iter();
        let factors = factors.map(|(sign, power)| (decimal(sign, power), Exact::zero()));
        let factors = factors.chain(sum.map(|sum| (Exact::one(), sum)));
        let mut all: Vec<_> =
            (0..).zip(factors).map(|(rank, (factor, sum))| Returned { factor, sum, rank }).collect();
        all.retain(|returned| {
            let (mut near, mut gain) = (0, 0);
            for (number, exact, most) in &numbers {
                let error = (returned.undo(number) - exact).abs();
                // Any factor gives 0 for 0.
                near += usize::from((returned.rank < 2 || !exact.is_zero()) && error <= *most);
                gain += (number - exact).abs().cmp(&error) as isize;
            }
            near >= INFORMATIVE && (returned.rank == 0 || gain >= INFORMATIVE as isize)
        });
        all
    }

    fn undo(&self, number: &Exact) -> Exact {
        (number - &self.sum) / &self.factor
    }

    fn description(&self, name: &str, unit: &str) -> Option<String> {
        let [factor, sum] = [&self.factor, &self.sum].map(format_short);
        let value = match self.rank {
            1 => format!("−{name}"),
            _ if self.sum.is_zero() => format!("{factor} {name}"),
            _ => format!("{name} + {sum} {unit}"),
        };
        (self.rank > 0).then(|| format!("{value} is returned as {name}"))
    }
}

/// Returns the value other than 0 that most of the values have.
fn common(values: Vec<Exact>, fit: &Exact) -> Option<Exact> {
    let samples = values.iter().step_by(values.len().div_ceil(SAMPLES).max(1)).filter(|x| !x.is_zero());
    samples.max_by_key(|x| values.iter().filter(|y| (*y - *x).abs() <= fit * x.abs()).count()).cloned()
}

impl Convention {
    /// Returns the conventions that answers may have, the most usual ones first.
    pub fn candidates(answers: &[&Observation], fit: &Exact) -> Vec<Self> {
        let [u, n] = [0, 1].map(|i| Returned::candidates(i, answers, fit));
        let pairs = u.iter().flat_map(|u| n.iter().map(|n| Convention([u.clone(), n.clone()])));
        let rank = |pair: &Convention| pair.0[0].rank + pair.0[1].rank;
        let mut all = Vec::from_iter(pairs.filter(|pair| rank(pair) > 0));
        all.sort_by_key(rank);
        all
    }

    /// Returns an answer without the convention.
    pub fn undo(&self, answer: &Observation, tolerance: &Exact) -> CaseResult {
        let mut undone = answer.answer.clone();
        undone.deflection = undone.deflection.map(|u| self.0[0].undo(&u));
        undone.contact_force = undone.contact_force.map(|n| self.0[1].undo(&n));
        CaseResult::of(answer.result.number, answer.problem, Reply::Answered(Box::new(undone)), tolerance)
    }

    pub fn description(&self) -> String {
        let both = [self.0[0].description("u", "m"), self.0[1].description("N", "N")];
        both.into_iter().flatten().collect::<Vec<_>>().join(", and ")
    }
}
