//! Diagnosis: the one edit, the one number or the one rounding that explains the answers of a solver.

use super::CASES;
use super::assessment::{fit, format_short};
use super::law::smoothed_law;
use super::observation::{Agreement, Observation};
use super::output::{Deviation, Output, described, deviations, have_deviations};
use super::precision::rounded_parameters;
use super::problems::{Family, Problem, problems};
use super::program::{Constants, Mistake, edits, in_some_answers, numbers, reference, value};
use crate::chapter::{contact, system};
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart, ToExact, Tree};
use num_traits::{One, Zero};
use std::sync::LazyLock;
use strum::Display;

/// Answers that a mistake explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
#[strum(serialize_all = "snake_case")]
pub enum DiagnosisScope {
    /// All answers.
    All,
    /// All wrong answers, but not all right ones.
    Wrong,
    /// All answers with steps.
    Steps,
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(DiagnosisScope);

/// A mistake that explains the answers.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Diagnosis {
    /// Description of the mistake.
    pub name: String,
    /// Descriptions of mistakes in other parameters with the same results.
    pub equivalent: Vec<String>,
    /// The lines of a program with the mistake.
    pub program: Vec<String>,
    /// Answers that it explains.
    pub answers: DiagnosisScope,
    /// Number of these answers.
    pub of: usize,
}

/// Number of answers required to distinguish a mistake from the right formulas: one or two could differ by
/// chance, and one determines a number.
pub(super) const INFORMATIVE: usize = 3;

/// Number of wrong answers, of all families, from which an unknown number is computed.
const SAMPLES: usize = 40;

/// A reason for wrong answers.
pub(super) enum Cause {
    /// A wrong program.
    Program(Explanation),
    /// Deviations of u and N from the right ones.
    Outputs([Deviation; 2]),
    /// Another one with its name, and its number.
    Other(String, Option<String>),
}

/// A wrong program that explains answers.
pub(super) struct Explanation {
    mistake: &'static Mistake,
    /// Its number, if it has one.
    k: Option<Exact>,
    /// Names of mistakes in other parameters with the same results.
    equivalent: Vec<String>,
}

impl Explanation {
    /// Returns its name.
    fn name(&self) -> String {
        let name = &self.mistake.name;
        self.k.as_ref().map_or(name.clone(), |k| name.replace("{k}", &format_short(k)))
    }

    /// Returns the lines of its program.
    fn lines(&self) -> Vec<String> {
        // The formulas of many steps are long.
        let is_long = self.mistake.augmentations.is_some();
        let lines = if is_long { Vec::new() } else { self.mistake.program.lines() };
        lines.into_iter().chain(self.k.as_ref().map(|k| format!("k = {}", format_short(k)))).collect()
    }

    /// Returns `true` if it may give an answer.
    fn may_give(&self, answer: &Observation, fit: &Exact) -> bool {
        answer.agreement(&self.mistake.results, self.k.as_ref(), fit) != Agreement::No
    }
}

impl Cause {
    /// Returns the diagnosis of a number of answers.
    pub fn diagnosis(self, answers: DiagnosisScope, of: usize) -> Diagnosis {
        let (name, program, equivalent) = match self {
            Cause::Program(found) => (found.name(), found.lines(), found.equivalent),
            Cause::Outputs(both) => (described(&both), Vec::new(), Vec::new()),
            Cause::Other(name, number) => (name, number.into_iter().collect(), Vec::new()),
        };
        Diagnosis { name, equivalent, program, answers, of }
    }

    /// Returns `true` if the program is right except for its decision between the two states.
    pub fn is_decision(&self) -> bool {
        matches!(self, Cause::Program(found) if found.mistake.is_decision)
    }
}

/// A search for the causes of wrong answers.
pub(super) struct Search<'a> {
    by_penalty: bool,
    tolerance: &'a Exact,
    /// Largest distance of an answer from the value that explains it.
    fit: Exact,
}

/// Mistakes of solvers by Lagrange multiplier, and by penalty.
type Candidates = [LazyLock<Vec<Mistake>>; 2];

static EDITS: Candidates = [LazyLock::new(|| edits(false)), LazyLock::new(|| edits(true))];
static NUMBERS: Candidates = [LazyLock::new(|| numbers(false)), LazyLock::new(|| numbers(true))];
static IN_SOME_ANSWERS: Candidates =
    [LazyLock::new(|| in_some_answers(false)), LazyLock::new(|| in_some_answers(true))];

impl<'a> Search<'a> {
    pub fn new(by_penalty: bool, tolerance: &'a Exact) -> Self {
        Search { by_penalty, tolerance, fit: fit(tolerance) }
    }

    /// Returns all causes of one kind, the first one of which explains all answers.
    pub fn of_all(&self, answers: &[&Observation]) -> Vec<Cause> {
        if !self.is_informative(answers) {
            return self.roundings(answers);
        }
        let searches = [Search::edits, Search::roundings, Search::outputs, Search::numbers, Search::laws];
        let found = searches.into_iter().map(|search| search(self, answers));
        found.into_iter().find(|found| !found.is_empty()).unwrap_or_default()
    }

    /// Returns all causes that explain the wrong answers alone.
    ///
    /// A changed formula affects all answers, so explaining only some would be a coincidence; a changed
    /// decision, or result, does not.
    pub fn of_wrong(&self, wrong: &[&Observation]) -> Vec<Cause> {
        if !self.is_informative(wrong) {
            return Vec::new();
        }
        let found = self.fitting(&IN_SOME_ANSWERS, wrong);
        if found.is_empty() { self.outputs(wrong) } else { found }
    }

    /// Returns `true` if a right answer agrees with the cause of wrong ones, so that it distinguishes nothing.
    pub fn may_cause(&self, cause: &Cause, answer: &Observation) -> bool {
        match cause {
            Cause::Program(found) => found.may_give(answer, &self.fit),
            Cause::Outputs(both) => have_deviations(answer, both, &self.fit),
            Cause::Other(..) => false,
        }
    }

    /// Returns `true` if enough answers differ from the right ones by more than the fitting tolerance.
    /// Otherwise every mistake with a small effect would fit.
    fn is_informative(&self, answers: &[&Observation]) -> bool {
        let right = reference(self.by_penalty).results();
        let differing =
            answers.iter().filter(|answer| answer.agreement(&right, None, &self.fit) == Agreement::No);
        differing.take(INFORMATIVE).count() == INFORMATIVE
    }

    /// Returns `true` if the mistake explains all answers, and several wrong ones not only by rounding errors.
    fn explains_all(&self, mistake: &Mistake, k: Option<&Exact>, answers: &[&Observation]) -> bool {
        let mut clear = 0;
        for answer in answers {
            let agreement = answer.agreement(&mistake.results, k, &self.fit);
            if agreement == Agreement::No {
                return false;
            }
            clear += usize::from(answer.is_wrong() && agreement == Agreement::Clear);
        }
        clear >= INFORMATIVE
    }

    fn edits(&self, answers: &[&Observation]) -> Vec<Cause> {
        self.fitting(&EDITS, answers)
    }

    /// Returns the mistakes without a number that explain the answers.
    fn fitting(&self, candidates: &'static Candidates, answers: &[&Observation]) -> Vec<Cause> {
        let all = candidates[usize::from(self.by_penalty)].iter();
        distinct(
            all.filter(|mistake| self.explains_all(mistake, None, answers)).map(|mistake| (mistake, None)),
        )
    }

    /// Returns the mistakes with a number k that explains all answers.
    fn numbers(&self, answers: &[&Observation]) -> Vec<Cause> {
        let wrong: Vec<_> = answers.iter().copied().filter(|answer| answer.is_wrong()).collect();
        let all = NUMBERS[usize::from(self.by_penalty)].iter();
        distinct(all.filter_map(|mistake| Some((mistake, Some(self.number(mistake, &wrong, answers)?)))))
    }

    /// Returns the number k with which a mistake explains all answers.
    fn number(&self, mistake: &Mistake, wrong: &[&Observation], answers: &[&Observation]) -> Option<Exact> {
        let samples = wrong.iter().step_by(wrong.len().div_ceil(SAMPLES).max(1));
        let mut numbers = samples.flat_map(|answer| estimates(mistake, answer)).filter(|k| !k.is_zero());
        numbers.find(|k| self.explains_all(mistake, Some(k), answers))
    }

    /// Returns the contact law without a corner that explains all answers.
    fn laws(&self, answers: &[&Observation]) -> Vec<Cause> {
        let law = smoothed_law(answers, &self.fit);
        law.map(|(name, k)| Cause::Other(name.to_string(), Some(k))).into_iter().collect()
    }

    /// Returns the deviations of u and N from the right ones by a sum or a factor.
    fn outputs(&self, answers: &[&Observation]) -> Vec<Cause> {
        deviations(answers, &self.fit, Output::sum_or_factor).map(Cause::Outputs).into_iter().collect()
    }

    /// Returns the loss of digits that explains all answers.
    fn roundings(&self, answers: &[&Observation]) -> Vec<Cause> {
        let is_wrong = answers.iter().any(|answer| answer.is_wrong());
        if !is_wrong || answers.iter().filter(|answer| !answer.is_right()).count() < INFORMATIVE {
            return Vec::new();
        }
        // Preferably of the same kind for u and N.
        let searches = [Output::few_decimals, Output::few_digits, Output::few];
        if let Some(both) = searches.into_iter().find_map(|find| deviations(answers, &self.fit, find)) {
            return vec![Cause::Outputs(both)];
        }
        let name = if answers.iter().all(|answer| answer.is_single()) {
            Some("it computes in single precision".to_string())
        } else {
            rounded_parameters(answers, self.tolerance)
        };
        name.map(|name| Cause::Other(name, None)).into_iter().collect()
    }
}

/// Returns the explanations by mistakes with their numbers: one for all that have the same results.
fn distinct(fitting: impl Iterator<Item = (&'static Mistake, Option<Exact>)>) -> Vec<Cause> {
    let mut found: Vec<(Vec<[Option<Exact>; 2]>, Explanation)> = Vec::new();
    for (mistake, k) in fitting {
        let values = values(mistake, k.as_ref());
        let new = Explanation { mistake, k, equivalent: Vec::new() };
        let Some((_, same)) = found.iter_mut().find(|(known, _)| *known == values) else {
            found.push((values, new));
            continue;
        };
        let name = new.name();
        if mistake.is_parameter && same.name() != name && !same.equivalent.contains(&name) {
            same.equivalent.push(name);
        }
    }
    found.into_iter().map(|(_, found)| Cause::Program(found)).collect()
}

/// Adds penalties that are different for all systems, as multiples of c.
pub(super) fn with_penalties(mut problems: Vec<Problem>) -> Vec<Problem> {
    for (multiple, problem) in (2..).zip(&mut problems) {
        problem.penalty = Some(&problem.system.c * Exact::from(multiple));
    }
    problems
}

/// Returns the values of a mistake for the default systems, each with a penalty.
pub(super) fn values(mistake: &Mistake, k: Option<&Exact>) -> Vec<[Option<Exact>; 2]> {
    static PROBLEMS: LazyLock<Vec<Problem>> =
        LazyLock::new(|| with_penalties(problems(1, CASES, Family::ALL)));
    PROBLEMS.iter().map(|problem| mistake.results.values(problem, k)).collect()
}

/// Returns the numbers k for which a mistake gives u or N of an answer.
fn estimates(mistake: &Mistake, answer: &Observation) -> Vec<Exact> {
    let touches = system::reaction(&answer.problem.system) > Exact::zero();
    if let Some(steps) = mistake.augmentations {
        let penalty = if touches { penalty_of_augmentations(steps, answer) } else { None };
        return penalty.into_iter().collect();
    }
    let formulas = mistake.results.of_state(touches).iter().zip(answer.numbers());
    formulas.filter_map(|(formula, number)| estimate(formula, number.as_ref()?, answer)).collect()
}

/// Returns the number k for which a formula has a value for the system of an answer.
fn estimate(formula: &Tree, number: &Exact, answer: &Observation) -> Option<Exact> {
    // The scale of k is not known.
    let unit = if number.is_zero() { Exact::one() } else { number.abs() / Exact::from(8) };
    let penalty = answer.reported_penalty();
    let [a, b, c] = [1, 2, 3].map(|i| {
        let constants = Constants { penalty: penalty.as_ref(), factor: Some(&(Exact::from(i) * &unit)) };
        value(formula, &answer.problem.system, &constants)
    });
    Some(linear_fractional([a?, b?, c?], number)? * unit)
}

/// Returns the k for which a quotient of linear functions of k has a value, given its values for k = 1, 2 and
/// 3. A formula in which k occurs once is such a quotient, which preserves cross-ratios.
fn linear_fractional([a, b, c]: [Exact; 3], value: &Exact) -> Option<Exact> {
    let (above, below) = ((value - &a) * (&b - &c), (value - &c) * (&b - &a));
    let sum = &above + &below;
    (!sum.is_zero()).then(|| (Exact::from(3) * above + below) / sum)
}

/// Returns the penalty for which a number of augmentations leaves the penetration of an answer.
fn penalty_of_augmentations(steps: i32, answer: &Observation) -> Option<Exact> {
    let system = &answer.problem.system;
    let p = contact::penetration(system, answer.numbers()[0].as_ref()?);
    // ρᵏ from the penetration R/c without a plane, with ρ = c/(c + ε).
    let left = &system.c * p / system::reaction(system);
    let contraction = left.to_f64().ok()?.powf(1.0 / f64::from(steps)).to_exact().ok()?;
    (contraction > Exact::zero()).then(|| &system.c / contraction - &system.c)
}

/// Returns the diagnosis of a reported force that is the one of the previous step.
pub(super) fn lag(answers: &[Observation]) -> Option<Diagnosis> {
    let lags: Vec<_> = answers.iter().filter_map(|answer| answer.assessment().lags).collect();
    let is_behind = !lags.is_empty() && lags.iter().all(|lags| *lags);
    is_behind.then(|| Diagnosis {
        name: "N is one step behind".to_string(),
        equivalent: Vec::new(),
        program: vec![
            registry().render_template("N_k = «augmented::contact_force: u=u_{k−1}»", Notation::Text),
        ],
        answers: DiagnosisScope::Steps,
        of: lags.len(),
    })
}
