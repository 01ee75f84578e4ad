//! Answers to problems, and mistakes that explain them.

use super::assessment::{balls, fit, rounded, rounds_alike, scales, sizes};
use super::problems::short;
use super::program::{Constants, Formulas, Results, right, value};
use super::{Answer, CaseResult, Problem, Reply, Value, Verdict};
use crate::chapter::{SpringMass, system};
use crate::number::{Ball, Exact, PositivePart, ToExact, Tree};
use crate::solver::State;
use num_traits::Zero;
use std::cell::OnceCell;

/// An answer with its problem.
pub(super) struct Observation<'a> {
    pub problem: &'a Problem,
    pub answer: &'a Answer,
    /// Scales of the errors of u and N.
    pub scales: [Exact; 2],
    /// Sum of the lengths of the system, and that of its forces.
    sizes: [Exact; 2],
    /// The system in balls around floats of 53 bits, if it is in range.
    balls: Option<SpringMass<Ball<f64>>>,
    pub exact: [&'a Exact; 2],
    pub lags: Option<bool>,
    /// Whether u or N is wrong.
    pub wrong: bool,
    /// Whether it is within the rounding error.
    pub right: bool,
    /// The exact state, unless rounding may change it.
    pub state: Option<State>,
    /// Its place among the kept results.
    pub index: usize,
    /// The number of requests before it.
    pub position: usize,
    error: Option<&'a Exact>,
    roundings: OnceCell<[Exact; 2]>,
}

impl<'a> Observation<'a> {
    /// Returns the answer of the result at a place, if it is one.
    pub fn of(index: usize, checked: &'a CaseResult, tolerance: &Exact) -> Option<Self> {
        let Reply::Answered(answer) = &checked.reply else { return None };
        let judgement = &checked.assessment;
        let problem = judgement.solved.as_ref()?;
        let system = &problem.system;
        let scales = scales(system);
        let is_open = system::reaction(system).abs() <= fit(tolerance) * &scales[1];
        Some(Observation {
            problem,
            answer,
            scales,
            sizes: sizes(system),
            balls: balls(&0f64, system),
            exact: [&judgement.exact.deflection, &judgement.exact.contact_force],
            lags: judgement.lags,
            wrong: !judgement.has_right_numbers,
            right: judgement.verdict == Verdict::Right,
            state: Some(judgement.exact.state).filter(|_| !is_open),
            index,
            position: checked.number,
            error: judgement.error(),
            roundings: OnceCell::new(),
        })
    }

    /// Returns the larger of the errors of u and N relative to the system.
    pub fn error(&self) -> Option<&Exact> {
        self.error
    }

    /// Returns the penalty that the solver reported, or that of the problem.
    pub fn reported_penalty(&self) -> Option<Exact> {
        self.answer.used.penalty.clone().flatten().or_else(|| self.problem.penalty.clone())
    }

    /// Returns u and N.
    pub fn numbers(&self) -> [&Value; 2] {
        [&self.answer.deflection, &self.answer.contact_force]
    }

    /// Returns whether a program with these results and constants gives this answer: `None` if its rounding errors
    /// may be as large as the error of the answer. Returns `Some(false)` if the results contain an
    /// unknown penalty.
    pub fn is_explained_by(&self, results: &Results, k: Option<&Exact>, tolerance: &Exact) -> Option<bool> {
        let penalty = self.reported_penalty();
        let constants = Constants { penalty: penalty.as_ref(), factor: k };
        let touches = results.reaction(&self.problem.system, &constants) > Exact::zero();
        let states = [true, false].into_iter().filter(|state| self.state.is_none() || *state == touches);
        let found = states.map(|state| self.is_given_by(results.of_state(state), &constants, tolerance));
        // Some(true), then None.
        found.reduce(|a, b| if a == Some(false) || b == Some(true) { b } else { a })?
    }

    fn is_given_by(
        &self,
        formulas: &Formulas,
        constants: &Constants<Exact>,
        tolerance: &Exact,
    ) -> Option<bool> {
        let mut is_clear = true;
        for (i, formula) in formulas.iter().enumerate() {
            match (self.numbers()[i], value(formula, &self.problem.system, constants)) {
                (Some(own), Some(x)) => {
                    if (own - &x).abs() > tolerance * (&self.scales[i] + x.abs()) {
                        match self.is_rounded(i, formula, constants) {
                            Some(false) => return Some(false),
                            found => is_clear &= found.is_some(),
                        }
                    }
                }
                // Any program without a number gives the same answer.
                (None, None) => is_clear = false,
                _ => return Some(false),
            }
        }
        is_clear.then_some(true)
    }

    /// Returns whether u or N is within the rounding errors of a formula in f64; `None` if it is, and they are
    /// not small relative to its error.
    fn is_rounded(&self, i: usize, formula: &Tree, constants: &Constants<Exact>) -> Option<bool> {
        let ball = |x: Option<&Exact>| x.and_then(|x| Ball::enclosing(&0f64, x).ok());
        let (eps, k) = (ball(constants.penalty), ball(constants.factor));
        let in_balls = Constants { penalty: eps.as_ref(), factor: k.as_ref() };
        let ball = self.balls.as_ref().and_then(|system| value(formula, system, &in_balls));
        let (Some(ball), Some(own)) = (ball, self.numbers()[i]) else { return Some(false) };
        let is_within = ball.is_finite() && ball.contains(own);
        // Otherwise they would explain other errors as well.
        let error = (own - self.exact[i]).abs();
        let is_small = ball.radius().to_exact().is_ok_and(|radius| Exact::from(100) * radius <= error);
        if is_within && !is_small { None } else { Some(is_within) }
    }

    /// Returns `true` if both numbers have the form of single precision, with the accuracy of a program that
    /// computes in it.
    pub fn is_single(&self) -> bool {
        self.is_right_in_single()
            && self.numbers().into_iter().all(|x| x.as_ref().is_some_and(is_single_number))
    }

    /// Each number has at most eight rounding errors relative to the sum of lengths or forces: those of its
    /// parameters (c, m and g, or l and H), and of up to four operations in any order.
    fn is_right_in_single(&self) -> bool {
        let penalty = self.problem.penalty.as_ref();
        let force = penalty.map(|eps| eps * &self.sizes[0]).unwrap_or_else(Exact::zero) + &self.sizes[1];
        let most = [&self.sizes[0] * Exact::power_of_two(-21), force * Exact::power_of_two(-21)];
        (0..2).all(|i| {
            let off = self.numbers()[i].as_ref().map(|x| (x - self.exact[i]).abs());
            off.is_some_and(|off| off <= most[i] && most[i] <= self.sizes[i])
        })
    }

    /// Returns `true` if a right program with these parameters gives this answer.
    pub fn is_explained_by_parameters(&self, system: &SpringMass<Exact>, tolerance: &Exact) -> bool {
        let is_solvable = [&system.c, &system.m].into_iter().all(|x| *x > Exact::zero());
        is_solvable && self.is_near(right(system, self.problem.penalty.as_ref()).map(Some), tolerance)
    }

    /// Returns `true` if the numbers are within the rounding error of f64 of the right answer, or within the
    /// tolerance.
    fn is_near(&self, numbers: [Value; 2], tolerance: &Exact) -> bool {
        (0..2).all(|i| {
            let (Some(x), Some(own)) = (&numbers[i], self.numbers()[i]) else { return false };
            let off = (own - x).abs();
            off <= tolerance * &self.scales[i] || off <= *self.rounding(i) || rounds_alike(own, x)
        })
    }

    /// Returns a bound of the error of the right u or N in f64; 0 if it is larger than the system.
    pub fn rounding(&self, i: usize) -> &Exact {
        let bounds = || {
            let balls = rounded(&0f64, self.problem);
            [0, 1].map(|i| {
                let radius = balls.as_ref().and_then(|balls| balls[i].radius().to_exact().ok());
                radius.filter(|radius| *radius <= self.sizes[i]).unwrap_or_else(Exact::zero)
            })
        };
        &self.roundings.get_or_init(bounds)[i]
    }
}

/// Returns `true` if the number could be printed from single precision: its exact value, the digits that
/// identify it in double precision, or at most the nine that identify it in single precision.
fn is_single_number(x: &Exact) -> bool {
    let itself = x.to_f32().ok().and_then(|x| x.to_exact().ok());
    itself.is_some_and(|single| rounds_alike(&single, x)) || has_digits(x, 9)
}

/// Returns `true` if the number is a decimal with at most `digits` digits.
pub(super) fn has_digits(x: &Exact, digits: usize) -> bool {
    short(x, digits) == *x
}
