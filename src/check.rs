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

mod answer;
mod assessment;
mod condition;
mod convention;
mod diagnosis;
mod explanation;
mod iteration;
mod law;
mod observation;
mod output;
mod penalty;
mod precision;
mod problems;
mod program;
mod report;
mod scales;
#[cfg(test)]
mod tests;

use crate::number::Exact;
pub use answer::{Answer, Reply, ReportedNumber, UsedParameters};
pub use assessment::{AnswerVerdict, Assessment, CaseResult};
pub use condition::{FailureCondition, Threshold, ThresholdQuantity};
pub use diagnosis::CASES;
pub use explanation::{Diagnosis, DiagnosisScope};
pub use observation::INFORMATIVE;
pub use penalty::ApparentPenalty;
pub use problems::{DIGITS, Family, Problem, UnknownFamily, problems};
use program::Reference;
pub use report::{FamilyResult, Repetition, Report, VerdictCounts};

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
    report.diagnose(Reference::of(problems), tolerance);
    Ok(report)
}

/// Assesses the answers of a table in rationals, and diagnoses the mistakes of the solver that gave them. Like [`check`]
/// without repetition; nothing is concluded from the order of the answers.
///
/// # Panics
/// Panics if c, m or ε of a problem is not positive.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::chapter::SpringMass;
/// use spring_mass_contact::check::{Answer, Family, Problem, Reply, check_table};
///
/// let system = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" };
/// let problem = Problem::own("run-1", system.parse()?, None)?;
/// let answer = Answer::new("0.05".parse()?, "4.81".parse()?);
/// let report = check_table(vec![(problem, Reply::Answered(Box::new(answer)))], &"1e-6".parse()?);
/// assert_eq!((report.summary().right, report.families()[0].family), (1, Family::Contact));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn check_table(answers: Vec<(Problem, Reply)>, tolerance: &Exact) -> Report {
    let mut report = Report::default();
    let reference = Reference::of(answers.iter().map(|(problem, _)| problem));
    for (problem, reply) in answers {
        report.add(CaseResult::of(0, &problem, reply, tolerance));
    }
    report.diagnose(reference, tolerance);
    report
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
