//! Results of a solver for all problems.

use super::answer::Reply;
use super::assessment::{AnswerVerdict, Assessment, CaseResult};
use super::condition::FailureCondition;
use super::diagnosis::{Search, lag};
use super::explanation::{Diagnosis, DiagnosisScope, Explanation};
use super::observation::{INFORMATIVE, Observation};
use super::output::absolute_bounds;
use super::penalty::ApparentPenalty;
use super::problems::Family;
use super::program::Reference;
use super::scales::scales;
use crate::chapter::system;
use crate::number::{Exact, PositivePart};
use crate::solver::State;
use std::collections::BTreeMap;

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
    /// The penalty with which all wrong answers are consistent, if nothing explains them.
    pub apparent_penalty: Option<ApparentPenalty>,
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

impl Report {
    /// Counts a result, and keeps it unless there are many of its family.
    pub(super) fn add(&mut self, result: CaseResult) {
        if self.tallies.entry(result.problem.family).or_default().count(&result.assessment) {
            self.results.push(result);
        }
    }

    /// Finds explanations of wrong answers, and the conditions under which they are wrong.
    pub(super) fn diagnose(&mut self, reference: Reference, tolerance: &Exact) {
        let search = Search::new(reference, tolerance);
        let results = self.results.iter().enumerate();
        let answers: Vec<_> = results.filter_map(|(i, of)| Observation::of(i, of, tolerance)).collect();
        self.diagnosis.extend(lag(&answers));
        let mut all: Vec<_> = answers.iter().collect();
        // Wrong answers refute most mistakes.
        all.sort_by_key(|answer| !answer.is_wrong());
        let fitting = search.of_all(&all);
        let (wrong, mut right): (Vec<_>, Vec<_>) = all.iter().partition(|answer| answer.is_wrong());
        if !fitting.is_empty() || wrong.len() < INFORMATIVE || !self.changed.is_empty() {
            self.add_all(fitting, DiagnosisScope::All, all.len());
            return;
        }
        let mut fitting = search.of_wrong(&wrong);
        // Answers that the mistake would also give distinguish nothing.
        let before = right.len();
        right.retain(|answer| !fitting.iter().any(|found| (found.may_give)(answer)));
        self.disregarded = before - right.len();
        self.conditions = FailureCondition::separating(&wrong, &right);
        if self.conditions.is_empty() {
            // A wrong decision needs no condition.
            fitting.retain(|found| found.is_decision);
        }
        if fitting.is_empty() {
            self.carried_over = carried_over(&answers);
            if self.carried_over.is_empty() {
                self.absolute_bounds = absolute_bounds(&wrong, tolerance);
                self.apparent_penalty = ApparentPenalty::of(&wrong);
            } else {
                self.conditions.clear();
            }
        }
        self.add_all(fitting, DiagnosisScope::Wrong, wrong.len());
    }

    fn add_all(&mut self, fitting: Vec<Explanation>, scope: DiagnosisScope, of: usize) {
        self.diagnosis.extend(fitting.into_iter().map(|found| found.diagnosis(scope, of)));
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
            let [_, loads] = scales(system);
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
        let tallies = self.tallies.iter();
        tallies.filter_map(|(family, tally)| FamilyResult::of(*family, tally, &self.results)).collect()
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

/// Returns the wrong answers that are the right ones of an earlier request, by the numbers of both, if there
/// are several.
fn carried_over(answers: &[Observation]) -> Vec<[usize; 2]> {
    let mut all = Vec::new();
    for (i, answer) in answers.iter().enumerate().filter(|(_, answer)| answer.is_wrong()) {
        let before = |earlier: &&Observation| earlier.result.number < answer.result.number;
        let mut earlier = answers[..i].iter().rev().filter(|earlier| before(earlier) && !earlier.is_wrong());
        let same = earlier.find(|earlier| earlier.numbers() == answer.numbers());
        all.extend(same.map(|earlier| [answer.index, earlier.index]));
    }
    if all.len() < INFORMATIVE { Vec::new() } else { all }
}

impl<'a> FamilyResult<'a> {
    fn of(family: Family, tally: &Tally, results: &'a [CaseResult]) -> Option<Self> {
        let (verdict, count) = tally.counts.last_key_value()?;
        // `max_by_key` returns the last of equal elements.
        let is_bad =
            |result: &&CaseResult| result.problem.family == family && result.assessment.verdict == *verdict;
        let bad = results.iter().rev().filter(is_bad);
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
