//! Comparison of an external solver with exact solutions, and diagnosis of its mistakes.
//!
//! ```
//! use spring_mass_contact::check::{Answer, Family, Reply, Verdict, check, problems};
//! use spring_mass_contact::chapter::lagrange;
//!
//! // A solver whose plane also pulls.
//! let report = check(&problems(1, 5, &Family::ALL), &"1e-6".parse()?, |problem| {
//!     let [u, n] = [lagrange::deflection(&problem.system), lagrange::multiplier(&problem.system)];
//!     Ok::<_, std::convert::Infallible>(Reply::Answered(Box::new(Answer::new(u, n))))
//! })?;
//! let families = report.families();
//! let of = |family| families.iter().find(|row| row.family == family).unwrap().verdict;
//! assert_eq!((of(Family::Contact), of(Family::Separated)), (Verdict::Right, Verdict::Wrong));
//! assert_eq!(report.identified_mistake().unwrap().name, "the plane also pulls");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assessment;
mod diagnosis;
mod mistakes;
mod observation;
mod penalty;
mod problems;
#[cfg(test)]
mod tests;
mod threshold;

use crate::chapter::{SpringMass, system};
use crate::number::{Exact, PositivePart};
use crate::solver::State;
pub use assessment::{Assessment, Verdict};
pub use diagnosis::{Diagnosis, DiagnosisScope};
use mistakes::PenaltyEvidence;
use observation::Observation;
pub use penalty::{Penalty, PenaltyScaling};
pub use problems::{DIGITS, Family, Problem, UnknownFamily, problems};
use std::collections::BTreeMap;
pub use threshold::{Threshold, ThresholdQuantity};

/// A number reported by a solver; `None` if it is infinite or NaN.
pub type Value = Option<Exact>;

/// Answer of a solver, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// u, in m.
    pub deflection: Value,
    /// N, in N.
    pub contact_force: Value,
    /// Penetration p, in m, if it is reported.
    pub penetration: Option<Value>,
    /// Status reported by the solver.
    pub status: Option<String>,
    /// Parameters that the solver used, if they differ from those of the problem.
    pub used: UsedParameters,
    /// u and N of every step, if they are reported.
    pub steps: Vec<[Value; 2]>,
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
    pub system: SpringMass<Option<Value>>,
    /// ε, in N/m.
    pub penalty: Option<Value>,
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
    /// The problem.
    pub problem: Problem,
    /// The reply, without its steps.
    pub reply: Reply,
    /// The assessment of the reply.
    pub assessment: Assessment,
}

/// Results for all problems.
#[derive(Clone, Debug)]
pub struct Report {
    /// Results in the order of the problems.
    pub results: Vec<CaseResult>,
    /// Whether the remaining problems were skipped because the solver answered none of the first ones.
    pub given_up: bool,
    /// Penalty parameter identified from forces and penetrations.
    pub penalty: Penalty,
    /// Threshold below which contacts are taken for separation.
    pub missed_contacts: Option<Threshold>,
    /// Threshold below which separated systems are taken for contacts.
    pub false_contacts: Option<Threshold>,
    /// Known mistakes that explain all answers, or otherwise all wrong answers. Empty if no answer is wrong.
    pub diagnosis: Vec<Diagnosis>,
}

/// Numbers of problems by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Summary {
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
pub struct Row<'a> {
    /// The family.
    pub family: Family,
    /// Number of its problems.
    pub cases: usize,
    /// The worst verdict.
    pub verdict: Verdict,
    /// Number of problems with the worst verdict.
    pub count: usize,
    /// Number of answers that are right or within the tolerance.
    pub right: usize,
    /// Largest error of u relative to |H − l| + |m g/c|; `None` without numbers.
    pub worst_deflection: Option<Exact>,
    /// Largest error of N relative to |m g| + |c (H − l)|; `None` without numbers.
    pub worst_force: Option<Exact>,
    /// The result with the largest error among those with the worst verdict.
    pub worst: &'a CaseResult,
}

/// Default number of systems in each family: sufficient to distinguish all known mistakes, with a margin.
pub const CASES: u64 = 5;

/// Number of consecutive failures at the start after which the solver is no longer called.
const MAX_INITIAL_FAILURES: usize = 3;

/// Passes all problems to a solver, assesses its answers in rationals, and diagnoses its mistakes.
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
    let mut checked = Vec::new();
    let mut given_up = false;
    for problem in problems {
        let mut reply = ask(problem)?;
        let judgement = Assessment::of(problem, &reply, tolerance);
        // The steps have been assessed, and may be numerous.
        if let Reply::Answered(answer) = &mut reply {
            answer.steps = Vec::new();
        }
        checked.push(CaseResult { problem: problem.clone(), reply, assessment: judgement });
        let silent = |of: &CaseResult| matches!(of.reply, Reply::Crashed(_) | Reply::TimedOut(_));
        let more = checked.len() < problems.len();
        given_up = more && checked.len() == MAX_INITIAL_FAILURES && checked.iter().all(silent);
        if given_up {
            break;
        }
    }
    let answers = Vec::from_iter(checked.iter().filter_map(Observation::of));
    let by_penalty = problems.iter().any(|problem| problem.penalty.is_some());
    let penalty = Penalty::measured(&answers, PenaltyEvidence::ByForce, tolerance);
    let missed = Threshold::of_missed_contacts(&answers, tolerance);
    let held = Threshold::of_false_contacts(&answers, tolerance);
    let diagnosis = diagnosis::diagnose(&answers, by_penalty, &penalty, tolerance);
    Ok(Report {
        results: checked,
        given_up,
        penalty,
        missed_contacts: missed,
        false_contacts: held,
        diagnosis,
    })
}

impl Report {
    /// Returns `true` if no answer is wrong and every family has a correct one. A refusal is not wrong, but a
    /// family without answers is not known to be right.
    pub fn holds(&self) -> bool {
        let Summary { wrong, crashed, timed_out, .. } = self.summary();
        let families = self.families();
        let known = !families.is_empty() && families.iter().all(|row| row.right > 0);
        known && wrong + crashed + timed_out == 0 && self.lag().is_none()
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
    pub fn summary(&self) -> Summary {
        let count = |verdict| self.results.iter().filter(|of| of.assessment.verdict == verdict).count();
        Summary {
            right: count(Verdict::Right),
            within_tolerance: count(Verdict::WithinTolerance),
            wrong: count(Verdict::Wrong),
            refused: count(Verdict::Refused),
            crashed: count(Verdict::Crashed),
            timed_out: count(Verdict::TimedOut),
        }
    }

    /// Returns the results of each family.
    pub fn families(&self) -> Vec<Row<'_>> {
        let mut families: BTreeMap<Family, Vec<&CaseResult>> = BTreeMap::new();
        for checked in &self.results {
            families.entry(checked.problem.family).or_default().push(checked);
        }
        families.into_iter().filter_map(|(family, all)| Row::of(family, &all)).collect()
    }

    /// Returns the known mistakes that explain all answers, or all wrong ones.
    pub fn fitting(&self) -> impl Iterator<Item = &Diagnosis> {
        self.diagnosis.iter().filter(|diagnosis| diagnosis.answers != DiagnosisScope::Steps)
    }

    /// Returns the diagnosis of the steps, if there is one.
    pub fn lag(&self) -> Option<&Diagnosis> {
        self.diagnosis.iter().find(|diagnosis| diagnosis.answers == DiagnosisScope::Steps)
    }

    /// Returns the known mistake if exactly one explains the answers, otherwise the diagnosis of the steps.
    pub fn identified_mistake(&self) -> Option<&Diagnosis> {
        let mut fitting = self.fitting();
        match (fitting.next(), fitting.next()) {
            (None, _) => self.lag(),
            (only, None) => only,
            _ => None,
        }
    }
}

impl<'a> Row<'a> {
    fn of(family: Family, all: &[&'a CaseResult]) -> Option<Self> {
        let verdict = all.iter().map(|of| of.assessment.verdict).max()?;
        let with_it = || all.iter().filter(|of| of.assessment.verdict == verdict);
        let worst = |error: fn(&Assessment) -> &Option<Exact>| {
            all.iter().filter_map(|of| error(&of.assessment).clone()).max()
        };
        // `max_by` returns the last of equal elements.
        let furthest = with_it().rev().max_by(|a, b| a.assessment.error().cmp(&b.assessment.error()))?;
        Some(Row {
            family,
            cases: all.len(),
            verdict,
            count: with_it().count(),
            right: all.iter().filter(|of| of.assessment.verdict <= Verdict::WithinTolerance).count(),
            worst_deflection: worst(|judgement| &judgement.deflection_error),
            worst_force: worst(|judgement| &judgement.force_error),
            worst: furthest,
        })
    }
}
