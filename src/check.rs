//! Comparison of an external solver with exact solutions, and diagnosis of its mistakes.
//!
//! ```
//! use spring_mass_contact::check::{Answer, Family, Reply, AnswerVerdict, check, problems};
//! use spring_mass_contact::chapter::lagrange;
//!
//! // A solver whose plane also pulls.
//! let report = check(&problems(1, 5, Family::ALL), &"1e-6".parse()?, |problem| {
//!     let [u, n] = [lagrange::deflection(&problem.system), lagrange::multiplier(&problem.system)];
//!     Ok::<_, std::convert::Infallible>(Reply::Answered(Box::new(Answer::new(u, n))))
//! })?;
//! let families = report.families();
//! let of = |family| families.iter().find(|row| row.family == family).unwrap().verdict;
//! assert_eq!((of(Family::Contact), of(Family::Separated)), (AnswerVerdict::Right, AnswerVerdict::Wrong));
//! assert_eq!(report.identified_mistake().unwrap().name, "the plane always acts");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assessment;
mod condition;
mod diagnosis;
mod law;
mod observation;
mod output;
mod precision;
mod problems;
mod program;
#[cfg(test)]
mod tests;

use crate::chapter::{SpringMass, system};
use crate::number::{Exact, PositivePart};
use crate::solver::State;
pub use assessment::{AnswerVerdict, Assessment};
pub use condition::{FailureCondition, Threshold, ThresholdQuantity};
use diagnosis::{Cause, INFORMATIVE, Search};
pub use diagnosis::{Diagnosis, DiagnosisScope};
use observation::Observation;
use output::absolute_bounds;
pub use problems::{DIGITS, Family, Problem, UnknownFamily, problems};
use std::collections::BTreeMap;

/// A number reported by a solver; `None` if it is infinite or NaN.
pub type ReportedNumber = Option<Exact>;

/// Answer of a solver, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// u, in m.
    pub deflection: ReportedNumber,
    /// N, in N.
    pub contact_force: ReportedNumber,
    /// Penetration p, in m, if it is reported.
    pub penetration: Option<ReportedNumber>,
    /// Status reported by the solver.
    pub status: Option<String>,
    /// Parameters that the solver used, if they differ from those of the problem.
    pub used: UsedParameters,
    /// u and N of every step, if they are reported.
    pub steps: Vec<[ReportedNumber; 2]>,
}

impl Answer {
    /// Returns an answer with u in m and N in N.
    pub fn new(deflection: Exact, contact_force: Exact) -> Self {
        Answer { deflection: Some(deflection), contact_force: Some(contact_force), ..Answer::default() }
    }
}

/// Parameters that a solver used; `None` if they are not reported.
#[derive(Clone, Debug, PartialEq)]
pub struct UsedParameters {
    /// The five parameters.
    pub system: SpringMass<Option<ReportedNumber>>,
    /// ε, in N/m.
    pub penalty: Option<ReportedNumber>,
}

impl Default for UsedParameters {
    fn default() -> Self {
        UsedParameters { system: SpringMass { c: None, m: None, g: None, l: None, h: None }, penalty: None }
    }
}

/// Reply of a solver to a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Reply {
    /// The solver returned numbers.
    Answered(Box<Answer>),
    /// The solver refused the problem, with a reason.
    Refused(String),
    /// The response is not an answer to the problem, with a reason.
    InvalidResponse(String),
    /// The solver terminated, with its last output.
    Crashed(String),
    /// The solver exceeded the time limit, with its last output.
    TimedOut(String),
}

/// A problem with its reply and assessment.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// The number of requests before it.
    pub number: usize,
    /// The problem.
    pub problem: Problem,
    /// The reply, without its steps.
    pub reply: Reply,
    /// The assessment of the reply.
    pub assessment: Assessment,
}

/// Results for all problems.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Results in the order of the problems: the first thousand of each family, and each that is worse than all before.
    pub results: Vec<CaseResult>,
    tallies: BTreeMap<Family, Tally>,
    /// Whether the remaining problems were skipped because the solver answered none of the first ones.
    pub given_up: bool,
    /// Number of problems that were asked again at the end, in another order.
    pub repeated: usize,
    /// Problems that were answered otherwise the second time. The diagnosis is about the first replies.
    pub changed: Vec<Repetition>,
    /// The wrong answers that are those of an earlier request, by the numbers of both; empty if something else
    /// explains them.
    pub carried_over: Vec<[usize; 2]>,
    /// Conditions each of which separates the wrong answers from the right ones. Empty if an explanation of all
    /// answers is found.
    pub conditions: Vec<FailureCondition>,
    /// Number of right answers that the diagnosed mistakes would also give, which the conditions disregard.
    pub disregarded: usize,
    /// The largest error of u in m, of N in N, and of their equilibrium in N: each if it does not grow with the systems,
    /// and nothing else explains the errors.
    pub absolute_bounds: [Option<Exact>; 3],
    /// Mistakes that explain all answers, or otherwise all wrong answers. Empty if no answer is wrong.
    pub diagnosis: Vec<Diagnosis>,
}

/// A second reply to a problem.
#[derive(Clone, Debug)]
pub struct Repetition {
    /// Number of the problem among the results.
    pub of: usize,
    /// The second reply.
    pub reply: Reply,
}

/// Numbers of problems by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VerdictCounts {
    /// Within the rounding error of f64.
    pub right: usize,
    /// Within the tolerance.
    pub within_tolerance: usize,
    /// Beyond the tolerance.
    pub wrong: usize,
    /// Refused, with a reason.
    pub refused: usize,
    /// The solver terminated.
    pub crashed: usize,
    /// The solver did not answer in time.
    pub timed_out: usize,
}

/// Results of a family.
#[derive(Clone, Debug)]
pub struct FamilyResult<'a> {
    /// The family.
    pub family: Family,
    /// Number of its problems.
    pub cases: usize,
    /// The worst verdict.
    pub verdict: AnswerVerdict,
    /// Number of problems with the worst verdict.
    pub count: usize,
    /// Number of answers that are right or within the tolerance.
    pub right: usize,
    /// Largest error of u relative to |H − l| + |m g/c|; `None` without numbers.
    pub worst_deflection: Option<Exact>,
    /// Largest error of N relative to |m g| + |c (H − l)|; `None` without numbers.
    pub worst_force: Option<Exact>,
    /// The kept result with the largest error among those with the worst verdict.
    pub worst: &'a CaseResult,
}

/// Default number of systems in each family: sufficient to distinguish most mistakes.
pub const CASES: u64 = 5;

/// Number of consecutive failures at the start after which the solver is no longer called.
const MAX_INITIAL_FAILURES: usize = 3;

/// Passes all problems to a solver, and up to twelve of them again in another order; assesses its answers in
/// rationals, and diagnoses its mistakes.
///
/// # Errors
/// Returns the first error of `ask`.
///
/// # Panics
/// Panics if c, m or ε of a problem is not positive.
pub fn check<E>(
    problems: &[Problem],
    tolerance: &Exact,
    mut ask: impl FnMut(&Problem) -> Result<Reply, E>,
) -> Result<Report, E> {
    let mut report = Report::default();
    for (number, problem) in problems.iter().enumerate() {
        report.add(CaseResult::of(number, problem, ask(problem)?, tolerance));
        let is_last = number + 1 == problems.len();
        report.given_up = !is_last
            && number + 1 == MAX_INITIAL_FAILURES
            && report.results.iter().all(CaseResult::is_silent);
        if report.given_up {
            return Ok(report);
        }
    }
    let again = repeated(&report.results);
    report.repeated = again.len();
    for of in again {
        let first = &report.results[of];
        let reply = ask(&first.problem)?;
        if first.differs(&reply, tolerance) {
            report.changed.push(Repetition { of, reply });
        }
    }
    let by_penalty = problems.iter().any(|problem| problem.penalty.is_some());
    report.diagnose(by_penalty, tolerance);
    Ok(report)
}

/// Returns the wrong answers that are the right ones of an earlier request, by the numbers of both, if there
/// are several.
fn carried_over(answers: &[Observation]) -> Vec<[usize; 2]> {
    let mut all = Vec::new();
    for (i, answer) in answers.iter().enumerate().filter(|(_, answer)| answer.is_wrong()) {
        let mut earlier = answers[..i].iter().rev().filter(|earlier| !earlier.is_wrong());
        let same = earlier.find(|earlier| earlier.numbers() == answer.numbers());
        all.extend(same.map(|earlier| [answer.index, earlier.index]));
    }
    if all.len() < INFORMATIVE { Vec::new() } else { all }
}

/// Largest number of problems that are asked again.
const MAX_REPEATED: usize = 12;

/// Returns the numbers of the results whose problems are asked again: evenly spaced, from both ends in turn,
/// so that most come after others than before.
fn repeated(results: &[CaseResult]) -> Vec<usize> {
    let answered: Vec<_> =
        (0..results.len()).filter(|i| matches!(results[*i].reply, Reply::Answered(_))).collect();
    let step = answered.len().div_ceil(MAX_REPEATED).max(1);
    let chosen: Vec<_> = answered.into_iter().step_by(step).collect();
    let ends = chosen.iter().rev().zip(&chosen).flat_map(|(last, first)| [*last, *first]);
    ends.take(chosen.len()).collect()
}

impl CaseResult {
    fn of(number: usize, problem: &Problem, mut reply: Reply, tolerance: &Exact) -> Self {
        let assessment = Assessment::of(problem, &reply, tolerance);
        // The steps have been assessed, and may be numerous.
        if let Reply::Answered(answer) = &mut reply {
            answer.steps = Vec::new();
        }
        CaseResult { number, problem: problem.clone(), reply, assessment }
    }

    /// Returns `true` if the solver did not answer.
    fn is_silent(&self) -> bool {
        matches!(self.reply, Reply::InvalidResponse(_) | Reply::Crashed(_) | Reply::TimedOut(_))
    }

    /// Returns `true` if another reply to the same problem is no answer, or one that differs by more than the
    /// tolerance.
    fn differs(&self, other: &Reply, tolerance: &Exact) -> bool {
        let (Reply::Answered(first), Reply::Answered(again)) = (&self.reply, other) else { return true };
        let scales = assessment::scales(&self.problem.system);
        let numbers = [[&first.deflection, &again.deflection], [&first.contact_force, &again.contact_force]];
        numbers.iter().zip(&scales).any(|(both, scale)| match both {
            [Some(a), Some(b)] => (a - b).abs() > tolerance * scale,
            [a, b] => a != b,
        })
    }
}

impl Report {
    /// Counts a result, and keeps it unless there are many of its family.
    fn add(&mut self, result: CaseResult) {
        if self.tallies.entry(result.problem.family).or_default().count(&result.assessment) {
            self.results.push(result);
        }
    }

    /// Finds the causes of wrong answers, and the conditions under which they are wrong.
    fn diagnose(&mut self, by_penalty: bool, tolerance: &Exact) {
        let search = Search::new(by_penalty, tolerance);
        let results = self.results.iter().enumerate();
        let answers: Vec<_> = results.filter_map(|(i, of)| Observation::of(i, of, tolerance)).collect();
        self.diagnosis.extend(diagnosis::lag(&answers));
        let all: Vec<_> = answers.iter().collect();
        let causes = search.of_all(&all).into_iter();
        let fitting: Vec<_> = causes.map(|cause| cause.diagnosis(DiagnosisScope::All, all.len())).collect();
        let (wrong, mut right): (Vec<_>, Vec<_>) = all.iter().partition(|answer| answer.is_wrong());
        if !fitting.is_empty() || wrong.len() < INFORMATIVE || !self.changed.is_empty() {
            self.diagnosis.extend(fitting);
            return;
        }
        let mut causes = search.of_wrong(&wrong);
        // Answers that the mistake would also give distinguish nothing.
        let before = right.len();
        right.retain(|answer| !causes.iter().any(|cause| search.may_cause(cause, answer)));
        self.disregarded = before - right.len();
        self.conditions = FailureCondition::separating(&wrong, &right);
        if self.conditions.is_empty() {
            // A wrong decision needs no condition.
            causes.retain(Cause::is_decision);
        }
        if causes.is_empty() {
            self.carried_over = carried_over(&answers);
            if self.carried_over.is_empty() {
                self.absolute_bounds = absolute_bounds(&wrong, tolerance);
            } else {
                self.conditions.clear();
            }
        }
        let scope = DiagnosisScope::Wrong;
        self.diagnosis.extend(causes.into_iter().map(|cause| cause.diagnosis(scope, wrong.len())));
    }

    /// Returns `true` if no answer is wrong and every family has a correct one. A refusal is not wrong, but a
    /// family without answers is not known to be right.
    pub fn holds(&self) -> bool {
        let VerdictCounts { wrong, crashed, timed_out, .. } = self.summary();
        let families = self.families();
        let known = !families.is_empty() && families.iter().all(|row| row.right > 0);
        known && wrong + crashed + timed_out == 0 && self.changed.is_empty() && self.lag().is_none()
    }

    /// Returns the smallest |R| relative to |m g| + |c (H − l)| among the systems in this state for which
    /// confusing the state causes an error beyond the tolerance; `None` if there are none.
    pub fn least_deciding(&self, state: State, tolerance: &Exact) -> Option<Exact> {
        let parts = self.results.iter().filter_map(|checked| {
            let system = &checked.problem.system;
            let exact = &checked.assessment.exact;
            let [_, loads] = assessment::scales(system);
            let part = system::reaction(system).abs() / &loads;
            // The contact force by the penalty method is smaller.
            let error =
                if state == State::Contact { exact.contact_force.abs() / loads } else { part.clone() };
            (exact.state == state && error > *tolerance).then_some(part)
        });
        parts.min()
    }

    /// Returns the numbers of problems by verdict.
    pub fn summary(&self) -> VerdictCounts {
        VerdictCounts {
            right: self.count(AnswerVerdict::Right),
            within_tolerance: self.count(AnswerVerdict::WithinTolerance),
            wrong: self.count(AnswerVerdict::Wrong),
            refused: self.count(AnswerVerdict::Refused),
            crashed: self.count(AnswerVerdict::Crashed),
            timed_out: self.count(AnswerVerdict::TimedOut),
        }
    }

    /// Returns the number of problems with a verdict.
    fn count(&self, verdict: AnswerVerdict) -> usize {
        self.tallies.values().filter_map(|tally| tally.counts.get(&verdict)).sum()
    }

    /// Returns the results of each family.
    pub fn families(&self) -> Vec<FamilyResult<'_>> {
        self.tallies
            .iter()
            .filter_map(|(family, tally)| FamilyResult::of(*family, tally, &self.results))
            .collect()
    }

    /// Returns the number of problems.
    pub fn cases(&self) -> usize {
        self.tallies.values().flat_map(|tally| tally.counts.values()).sum()
    }

    /// Returns the mistakes that explain all answers, or all wrong ones.
    pub fn fitting(&self) -> impl Iterator<Item = &Diagnosis> {
        self.diagnosis.iter().filter(|diagnosis| diagnosis.answers != DiagnosisScope::Steps)
    }

    /// Returns the diagnosis of the steps, if there is one.
    pub fn lag(&self) -> Option<&Diagnosis> {
        self.diagnosis.iter().find(|diagnosis| diagnosis.answers == DiagnosisScope::Steps)
    }

    /// Returns the mistake if exactly one explains the answers, otherwise the diagnosis of the steps.
    pub fn identified_mistake(&self) -> Option<&Diagnosis> {
        let mut fitting = self.fitting();
        match (fitting.next(), fitting.next()) {
            (None, _) => self.lag(),
            (only, None) => only,
            _ => None,
        }
    }
}

impl<'a> FamilyResult<'a> {
    fn of(family: Family, tally: &Tally, results: &'a [CaseResult]) -> Option<Self> {
        let (verdict, count) = tally.counts.last_key_value()?;
        // `max_by_key` returns the last of equal elements.
        let bad = results
            .iter()
            .rev()
            .filter(|result| result.problem.family == family && result.assessment.verdict == *verdict);
        let worst = bad.max_by_key(|result| result.assessment.error())?;
        let [worst_deflection, worst_force] = tally.largest_errors.clone();
        let right = tally.counts.range(..=AnswerVerdict::WithinTolerance).map(|(_, count)| count).sum();
        let cases = tally.counts.values().sum();
        Some(FamilyResult {
            family,
            cases,
            verdict: *verdict,
            count: *count,
            right,
            worst_deflection,
            worst_force,
            worst,
        })
    }
}

/// Number of results of a family that are kept, beside worse ones.
const MAX_KEPT: usize = 1000;

/// Counts and largest errors of the results of a family.
#[derive(Clone, Debug, Default)]
struct Tally {
    kept: usize,
    counts: BTreeMap<AnswerVerdict, usize>,
    /// The largest errors of u and N.
    largest_errors: [Option<Exact>; 2],
}

impl Tally {
    /// Counts a result. Returns `true` if it is to be kept.
    fn count(&mut self, assessment: &Assessment) -> bool {
        let is_worse = self.counts.keys().all(|verdict| *verdict < assessment.verdict);
        *self.counts.entry(assessment.verdict).or_default() += 1;
        let errors = [&assessment.deflection_error, &assessment.force_error];
        for (largest, error) in self.largest_errors.iter_mut().zip(errors) {
            *largest = largest.take().max(error.clone());
        }
        let is_kept = is_worse || self.kept < MAX_KEPT;
        self.kept += usize::from(is_kept);
        is_kept
    }
}
