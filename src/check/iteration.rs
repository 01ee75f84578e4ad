//! Errors that an iteration leaves which stops early: similar in all answers, also without contact.

use super::observation::{INFORMATIVE, Observation, has_digits};
use super::program::{Known, Program};
use super::scales::decimal;
use crate::number::{Exact, PositivePart};
use crate::solver::State;
use num_traits::Zero;

/// Largest number of digits that may be those of a table, so that they would explain an error.
const PRINTED_DIGITS: usize = 12;

/// Values of a program for an answer, with the errors of the answer beyond rounding.
type Deviation = [(Exact, Exact); 2];

/// Returns u and N of a program with the errors of an answer beyond rounding, relative to the larger of these and its
/// scales.
fn deviation(answer: &Observation, program: &Program) -> Option<Deviation> {
    let penalty = answer.reported_penalty();
    let known = Known::new(&answer.problem.system, penalty.as_ref(), None);
    let [u, n] = program.values(&known, program.touches(&known));
    let error = |i: usize, value: Exact| {
        let beyond = (answer.numbers()[i].as_ref()? - &value).abs() - answer.rounding(i);
        let error = beyond.positive_part() / answer.scales[i].clone().max(value.abs());
        Some((value, error))
    };
    Some([error(0, u?)?, error(1, n?)?])
}

/// Returns the largest error of answers relative to a program, at most a thousandth, if that of most is similar: of u in
/// both states, of N, and not due to few digits. A program that is not right has to differ clearly.
pub(super) fn common_error(program: &Program, is_right: bool, answers: &[&Observation]) -> Option<Exact> {
    let is_small = |both: &Deviation| both.iter().all(|(_, error)| *error <= decimal(1, -3));
    let all = answers.iter().map(|answer| Some((*answer, deviation(answer, program).filter(is_small)?)));
    let all: Vec<_> = all.collect::<Option<_>>()?;
    let most = all.iter().flat_map(|(_, both)| both).map(|(_, error)| error).max()?;
    // Smallest ratio of an effect to an error that does not hide it, and largest ratio of similar errors.
    let clear = Exact::from(100);
    let shows = |answer: &Observation, both: &Deviation, i: usize| {
        let error = &both[i].1;
        &clear * error >= *most && error * &answer.scales[i] > &clear * answer.rounding(i)
    };
    let differs = |answer: &Observation, both: &Deviation, i: usize| {
        (&both[i].0 - answer.exact(i)).abs() > &clear * most * &answer.scales[i]
    };
    let count = |holds: &dyn Fn(&Observation, &Deviation) -> bool| {
        all.iter().filter(|(answer, both)| holds(answer, both)).count()
    };
    let in_state = |state: State| {
        count(&|answer, both| {
            let is_printed = answer.numbers()[0].as_ref().is_some_and(|u| has_digits(u, PRINTED_DIGITS));
            answer.state == Some(state) && shows(answer, both, 0) && !is_printed
        })
    };
    let is_similar = 4 * count(&|answer, both| (0..2).any(|i| shows(answer, both, i))) >= 3 * all.len();
    // Where either state is possible, the answer may be in the other one.
    let in_force = || count(&|answer, both| answer.state.is_some() && shows(answer, both, 1)) >= INFORMATIVE;
    let holds = is_similar
        && [State::Contact, State::Separated].into_iter().all(|state| in_state(state) >= INFORMATIVE)
        && (count(&|_, both| !both[1].0.is_zero()) == 0 || in_force())
        && (is_right || count(&|answer, both| (0..2).any(|i| differs(answer, both, i))) >= INFORMATIVE);
    holds.then(|| most.clone())
}
