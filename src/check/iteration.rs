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

/// Returns u and N of a program with the errors of an answer beyond rounding, relative to the larger of these and its
/// scales; in the closer state if both are possible.
fn errors(answer: &Observation, program: &Program) -> Option<[(Exact, Exact); 2]> {
    let penalty = answer.reported_penalty();
    let known = Known::new(&answer.problem.system, penalty.as_ref(), None);
    let decided = program.touches(&known);
    let states = [decided, !decided].into_iter().take(if answer.state.is_none() { 2 } else { 1 });
    let all = states.filter_map(|touches| {
        let [u, n] = program.values(&known, touches);
        let error = |i: usize, value: Exact| {
            let beyond = (answer.numbers()[i].as_ref()? - &value).abs() - answer.rounding(i);
            let error = beyond.positive_part() / answer.scales[i].clone().max(value.abs());
            Some((value, error))
        };
        Some([error(0, u?)?, error(1, n?)?])
    });
    all.min_by_key(|both| both.each_ref().map(|(_, error)| error.clone()).into_iter().max())
}

/// Returns the largest error of answers relative to a program, at most a thousandth, if that of most is similar: of u in
/// both states, of N, and not due to few digits. A program that is not right has to differ clearly.
pub(super) fn common_error(program: &Program, is_right: bool, answers: &[&Observation]) -> Option<Exact> {
    let limit = decimal(1, -3);
    let is_small = |both: &[(Exact, Exact); 2]| both.iter().all(|(_, error)| *error <= limit);
    let all = answers.iter().map(|answer| Some((*answer, errors(answer, program).filter(is_small)?)));
    let all: Vec<_> = all.collect::<Option<_>>()?;
    let most = all.iter().flat_map(|(_, both)| both).map(|(_, error)| error).max()?;
    let clear = Exact::from(CLEAR);
    let shows = |answer: &Observation, i: usize, error: &Exact| {
        &clear * error >= *most && error * &answer.scales[i] > &clear * answer.rounding(i)
    };
    let [mut similar, mut touching, mut apart, mut pushing, mut forces, mut differing] = [0; 6];
    for (answer, [(u, off_u), (n, off_n)]) in &all {
        let [by_u, by_n] = [shows(answer, 0, off_u), shows(answer, 1, off_n)];
        let is_printed = answer.numbers()[0].as_ref().is_some_and(|u| has_digits(u, PRINTED_DIGITS));
        let differs = |i: usize, x: &Exact| (x - answer.exact(i)).abs() > &clear * most * &answer.scales[i];
        similar += usize::from(by_u || by_n);
        touching += usize::from(by_u && !is_printed && answer.state == Some(State::Contact));
        apart += usize::from(by_u && !is_printed && answer.state == Some(State::Separated));
        pushing += usize::from(!n.is_zero());
        // Where either state is possible, the closer one may have another error.
        forces += usize::from(by_n && answer.state.is_some());
        differing += usize::from(differs(0, u) || differs(1, n));
    }
    let holds = 4 * similar >= 3 * all.len()
        && touching.min(apart) >= INFORMATIVE
        && (pushing == 0 || forces >= INFORMATIVE)
        && (is_right || differing >= INFORMATIVE);
    holds.then(|| most.clone())
}
