//! Errors that an iteration leaves which stops early: similar in all answers, also without contact.

use super::observation::{INFORMATIVE, Observation, has_digits};
use super::program::{Known, Program};
use super::scales::decimal;
use crate::number::{Exact, PositivePart};
use crate::solver::State;
use num_traits::Zero;

/// Smallest ratio of an effect to an error that does not hide it, and largest ratio of similar errors.
const CLEAR: i32 = 100;

/// Largest number of digits that may be those of a table, so that they would explain an error.
const PRINTED_DIGITS: usize = 12;

/// An answer with what a program gives, and its errors beyond rounding, relative to the larger of this and its scales.
struct Residue<'a> {
    answer: &'a Observation<'a>,
    values: [Exact; 2],
    errors: [Exact; 2],
}

impl<'a> Residue<'a> {
    /// Returns that of the state which is closer, unless an error is larger than a thousandth.
    fn of(answer: &'a Observation<'a>, program: &Program) -> Option<Self> {
        let penalty = answer.reported_penalty();
        let known = Known::new(&answer.problem.system, penalty.as_ref(), None);
        let decided = program.touches(&known);
        let states = [decided, !decided].into_iter().take(if answer.state.is_none() { 2 } else { 1 });
        let residues = states.filter_map(|touches| {
            let [u, n] = program.values(&known, touches);
            let (values, [Some(x), Some(y)]) = ([u?, n?], answer.numbers()) else { return None };
            let numbers = [x, y];
            let errors = [0, 1].map(|i| {
                let beyond = (numbers[i] - &values[i]).abs() - answer.rounding(i);
                beyond.positive_part() / answer.scales[i].clone().max(values[i].abs())
            });
            Some(Residue { answer, values, errors })
        });
        let closest = residues.min_by(|a, b| a.errors.iter().max().cmp(&b.errors.iter().max()));
        closest.filter(|residue| residue.errors.iter().all(|error| *error <= decimal(1, -3)))
    }

    /// Returns `true` if u (0) or N (1) has an error that is neither much smaller than this one nor due to rounding.
    fn shows(&self, i: usize, most: &Exact) -> bool {
        let (error, clear) = (&self.errors[i], Exact::from(CLEAR));
        &clear * error >= *most && error * &self.answer.scales[i] > clear * self.answer.rounding(i)
    }

    /// Returns `true` if the program differs from the right one by much more than an error.
    fn differs(&self, most: &Exact) -> bool {
        (0..2).any(|i| {
            let off = (&self.values[i] - self.answer.exact(i)).abs();
            off > Exact::from(CLEAR) * most * &self.answer.scales[i]
        })
    }
}

/// Returns the largest error of answers relative to a program if that of most is similar: of u in both states, of N, and
/// not due to few digits. A program that is not right has to differ clearly.
pub(super) fn common_error(program: &Program, is_right: bool, answers: &[&Observation]) -> Option<Exact> {
    let all = answers.iter().map(|answer| Residue::of(answer, program)).collect::<Option<Vec<_>>>()?;
    let most = all.iter().flat_map(|residue| &residue.errors).max()?;
    let count = |is: &dyn Fn(&&Residue) -> bool| all.iter().filter(is).count();
    let similar = count(&|of| (0..2).any(|i| of.shows(i, most)));
    let [touching, apart] = [State::Contact, State::Separated].map(|state| {
        count(&|of| of.answer.state == Some(state) && of.shows(0, most) && !is_printed(of.answer))
    });
    let pushing = count(&|of| !of.values[1].is_zero());
    // Where either state is possible, the closer one may have another error.
    let forces = count(&|of| of.answer.state.is_some() && of.shows(1, most));
    let is_common = 4 * similar >= 3 * all.len() && touching.min(apart) >= INFORMATIVE;
    let holds = is_common
        && (pushing == 0 || forces >= INFORMATIVE)
        && (is_right || count(&|of| of.differs(most)) >= INFORMATIVE);
    holds.then(|| most.clone())
}

fn is_printed(answer: &Observation) -> bool {
    answer.numbers()[0].as_ref().is_some_and(|u| has_digits(u, PRINTED_DIGITS))
}
