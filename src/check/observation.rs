//! Answers to problems, and mistakes that explain them.

use super::answer::{Answer, Reply, ReportedNumber};
use super::assessment::{AnswerVerdict, Assessment, CaseResult, rounded};
use super::problems::{Problem, right};
use super::program::{Known, Program};
use super::scales::{ball, balls, fit, is_within, rounds_alike, scales, short, sizes};
use crate::chapter::{SpringMass, system};
use crate::number::{Ball, Exact, PositivePart, ToExact};
use crate::solver::State;
use num_traits::Zero;
use std::cell::OnceCell;

/// Number of answers required to distinguish a mistake from the right formulas: one or two could differ by
/// chance, and one determines a number.
pub const INFORMATIVE: usize = 3;

/// An answer with its problem.
pub(super) struct Observation<'a> {
    /// Its place among the kept results.
    pub index: usize,
    pub result: &'a CaseResult,
    pub answer: &'a Answer,
    /// The problem with the parameters that the solver used.
    pub problem: &'a Problem,
    /// The exact state, unless rounding may change it.
    pub state: Option<State>,
    /// Scales of the errors of u and N.
    pub scales: [Exact; 2],
    /// Sum of the lengths of the system, and that of its forces.
    pub sizes: [Exact; 2],
    /// The system in balls around floats of 53 bits, if it is in range.
    balls: Option<SpringMass<Ball<f64>>>,
    roundings: OnceCell<[Exact; 2]>,
}

/// Agreement of an answer with a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Agreement {
    No,
    /// The rounding errors of the program may be as large as the error of the answer.
    Possible,
    Clear,
}

impl<'a> Observation<'a> {
    /// Returns the answer of the result at a place, if it is one.
    pub fn of(index: usize, result: &'a CaseResult, tolerance: &Exact) -> Option<Self> {
        let Reply::Answered(answer) = &result.reply else { return None };
        let problem = result.assessment.solved.as_ref()?;
        let system = &problem.system;
        let scales = scales(system);
        let is_open = system::reaction(system).abs() <= fit(tolerance) * &scales[1];
        Some(Observation {
            index,
            result,
            answer,
            problem,
            state: Some(result.assessment.exact.state).filter(|_| !is_open),
            scales,
            sizes: sizes(system),
            balls: balls(system),
            roundings: OnceCell::new(),
        })
    }

    pub fn assessment(&self) -> &'a Assessment {
        &self.result.assessment
    }

    /// Returns `true` if u or N is wrong.
    pub fn is_wrong(&self) -> bool {
        !self.assessment().has_right_numbers
    }

    /// Returns `true` if the answer is within the rounding error.
    pub fn is_right(&self) -> bool {
        self.assessment().verdict == AnswerVerdict::Right
    }

    /// Returns the exact u (0) or N (1).
    pub fn exact(&self, index: usize) -> &'a Exact {
        let exact = &self.assessment().exact;
        [&exact.deflection, &exact.contact_force][index]
    }

    /// Returns the absolute error of u (0), in m, or N (1), in N.
    pub fn absolute_error(&self, index: usize) -> Option<Exact> {
        self.numbers()[index].as_ref().map(|number| (number - self.exact(index)).abs())
    }

    /// Returns the larger error of u and N relative to their scales; `None` without numbers.
    pub fn relative_error(&self) -> Option<Exact> {
        let [u, n] = [0, 1].map(|i| Some(self.absolute_error(i)? / &self.scales[i]));
        Some(u?.max(n?))
    }

    /// Returns the penalty that the solver reported, or that of the problem.
    pub fn reported_penalty(&self) -> Option<Exact> {
        self.answer.used.penalty.clone().flatten().or_else(|| self.problem.penalty.clone())
    }

    /// Returns u and N.
    pub fn numbers(&self) -> [&ReportedNumber; 2] {
        [&self.answer.deflection, &self.answer.contact_force]
    }

    /// Returns whether a program with a number k gives this answer; not if its results contain an unknown penalty.
    pub fn agreement(&self, program: &Program, k: Option<&Exact>, tolerance: &Exact) -> Agreement {
        let penalty = self.reported_penalty();
        let known = Known::new(&self.problem.system, penalty.as_ref(), k);
        let (eps, k) = (penalty.as_ref().and_then(ball), k.and_then(ball));
        let known_in_balls = |system| Known::new(system, eps.as_ref(), k.as_ref());
        let in_balls = self.balls.as_ref().map(known_in_balls);
        let in_state = |touches| {
            let values = program.values(&known, touches);
            let balls = || in_balls.as_ref().map(|known| program.values(known, touches));
            let agreement =
                |i: usize| self.agreement_with(i, values[i].as_ref(), || balls()?[i].clone(), tolerance);
            match agreement(0) {
                Agreement::No => Agreement::No,
                u => u.min(agreement(1)),
            }
        };
        match self.state {
            None => in_state(true).max(in_state(false)),
            Some(_) => in_state(program.touches(&known)),
        }
    }

    /// Returns whether u or N is a value within the tolerance, or within its rounding errors in f64.
    fn agreement_with(
        &self,
        i: usize,
        value: Option<&Exact>,
        ball: impl Fn() -> Option<Ball<f64>>,
        tolerance: &Exact,
    ) -> Agreement {
        let (number, x) = match (self.numbers()[i], value) {
            (Some(number), Some(x)) => (number, x),
            // Any program without a number gives the same answer.
            (None, None) => return Agreement::Possible,
            _ => return Agreement::No,
        };
        let error = (number - x).abs();
        let is_clear = if error <= tolerance * (&self.scales[i] + x.abs()) {
            // A value that is small relative to its system agrees with any other small number.
            x.is_zero() || error * Exact::from(100) <= x.abs()
        } else {
            let Some(ball) = ball().filter(|ball| ball.is_finite() && ball.contains(number)) else {
                return Agreement::No;
            };
            // Rounding errors that are not small relative to the error and the number would explain others as well.
            is_within(&ball, &((number - self.exact(i)).abs().min(number.abs()) / Exact::from(100)))
        };
        if is_clear { Agreement::Clear } else { Agreement::Possible }
    }

    /// Returns `true` if both numbers have the form of single precision, with the accuracy of a program that
    /// computes in it: at most eight rounding errors relative to the sum of lengths or forces, those of its
    /// parameters (c, m and g, or l and H), and of up to four operations in any order.
    pub fn is_single(&self) -> bool {
        let [lengths, forces] = &self.sizes;
        let penalty = self.problem.penalty.as_ref().map_or(Exact::zero(), |eps| eps * lengths);
        let most = [lengths.clone(), penalty + forces].map(|size| size * Exact::power_of_two(-21));
        (0..2).all(|i| {
            let has_form = self.numbers()[i].as_ref().is_some_and(is_single_number);
            let error = self.absolute_error(i);
            has_form && most[i] <= self.sizes[i] && error.is_some_and(|error| error <= most[i])
        })
    }

    /// Returns `true` if a right program with these parameters gives this answer, within the tolerance or the rounding
    /// errors of f64.
    pub fn is_explained_by_parameters(&self, system: &SpringMass<Exact>, tolerance: &Exact) -> bool {
        if [&system.c, &system.m].into_iter().any(|x| *x <= Exact::zero()) {
            return false;
        }
        let expected = right(system, self.problem.penalty.as_ref());
        (0..2).all(|i| {
            let Some(number) = self.numbers()[i] else { return false };
            let most = (tolerance * &self.scales[i]).max(self.rounding(i).clone());
            (number - &expected[i]).abs() <= most || rounds_alike(number, &expected[i])
        })
    }

    /// Returns a bound of the error of the right u or N in f64; 0 if it is larger than the system.
    pub fn rounding(&self, i: usize) -> &Exact {
        let radius = |ball: Ball<f64>| ball.radius().to_exact().expect("finite");
        let bounds = || rounded(self.problem).map(|ball| ball.map_or(Exact::zero(), radius));
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
