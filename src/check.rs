//! Holds a solver against the exact answer, and says what is wrong with it.
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
//! assert_eq!(report.named().unwrap().name, "the plane also pulls");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod diagnosis;
mod given;
mod judge;
mod missed;
mod mistakes;
mod penalty;
mod problems;
#[cfg(test)]
mod tests;

use crate::chapter::{SpringMass, system};
use crate::number::{Exact, PositivePart};
use crate::solver::State;
pub use diagnosis::{Answers, Diagnosis};
use given::Given;
pub use judge::{Judgement, Verdict};
pub use missed::{Of, Threshold};
use mistakes::Measured;
pub use penalty::{Kind, Penalty};
pub use problems::{DIGITS, Family, NoFamily, Problem, problems};
use std::collections::BTreeMap;

/// A number that a solver gives; `None` where it is not-a-number or infinite.
pub type Value = Option<Exact>;

/// What a solver answers, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// u, in m.
    pub deflection: Value,
    /// N, in N.
    pub contact_force: Value,
    /// p, in m, if it says so.
    pub penetration: Option<Value>,
    /// How it ended, in its own words.
    pub status: Option<String>,
    /// What it has really taken, where that is not what it was asked for.
    pub used: Used,
    /// u and N of every step that led there, if it says so.
    pub steps: Vec<[Value; 2]>,
}

impl Answer {
    /// u in m and N in N, and nothing else.
    pub fn new(deflection: Exact, contact_force: Exact) -> Self {
        Answer { deflection: Some(deflection), contact_force: Some(contact_force), ..Answer::default() }
    }
}

/// What a solver has taken for a parameter; `None` where it does not say.
#[derive(Clone, Debug, PartialEq)]
pub struct Used {
    /// The five parameters.
    pub system: SpringMass<Option<Value>>,
    /// ε, in N/m.
    pub penalty: Option<Value>,
}

impl Default for Used {
    fn default() -> Self {
        Used { system: SpringMass { c: None, m: None, g: None, l: None, h: None }, penalty: None }
    }
}

/// What comes of asking a solver.
#[derive(Clone, Debug, PartialEq)]
pub enum Reply {
    /// Numbers.
    Answered(Box<Answer>),
    /// It says that it cannot, and why.
    Refused(String),
    /// Something that is no answer to what was asked, and why.
    Garbled(String),
    /// It ended instead; how, and its last words.
    Crashed(String),
    /// It was still at it when its time was up; what there was to see of it.
    TimedOut(String),
}

/// A problem, what came of it, and what to think of that.
#[derive(Clone, Debug)]
pub struct Checked {
    /// What was asked.
    pub problem: Problem,
    /// What came, but for its steps.
    pub reply: Reply,
    /// How far off it is.
    pub judgement: Judgement,
}

/// What came of all problems.
#[derive(Clone, Debug)]
pub struct Report {
    /// In the order in which they were asked.
    pub checked: Vec<Checked>,
    /// Did the solver answer none of the first problems, so that the others were not asked?
    pub given_up: bool,
    /// What the forces by their penetrations show.
    pub penalty: Penalty,
    /// What contacts that are taken for none have in common.
    pub missed: Option<Threshold>,
    /// What separated systems that are taken for contacts have in common.
    pub held: Option<Threshold>,
    /// Every known mistake that all answers fit; or else, all wrong answers. Empty if none is wrong.
    pub diagnosis: Vec<Diagnosis>,
}

/// How many problems came to what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Summary {
    /// No further off than rounding explains.
    pub right: usize,
    /// Within the tolerance.
    pub within_tolerance: usize,
    /// Neither.
    pub wrong: usize,
    /// Not answered, with a reason.
    pub refused: usize,
    /// The solver ended.
    pub crashed: usize,
    /// The solver did not answer in time.
    pub timed_out: usize,
}

/// What came of a family.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// Which one.
    pub family: Family,
    /// How many of its problems were asked.
    pub cases: usize,
    /// The worst verdict.
    pub verdict: Verdict,
    /// How many problems have it.
    pub count: usize,
    /// How many answers are right, or within the tolerance.
    pub right: usize,
    /// The largest error of u, in parts of |H − l| + |m g/c|; `None` if there is no number.
    pub worst_deflection: Option<Exact>,
    /// The largest error of N, in parts of |m g| + |c (H − l)|; `None` if there is no number.
    pub worst_force: Option<Exact>,
    /// Of the problems that have the worst verdict, the one whose answer is furthest off.
    pub worst: &'a Checked,
}

/// Systems of each family by default: the least that tell all known mistakes apart with some to spare.
pub const CASES: u64 = 5;

/// A solver that answers none of so many problems is not asked any more.
const PATIENCE: usize = 3;

/// Asks a solver all problems, judges its answers in rationals, and looks for what is wrong with it.
///
/// # Errors
/// The first that `ask` returns.
///
/// # Panics
/// A problem's c, m or ε is not greater than 0.
pub fn check<E>(
    problems: &[Problem],
    tolerance: &Exact,
    mut ask: impl FnMut(&Problem) -> Result<Reply, E>,
) -> Result<Report, E> {
    let mut checked = Vec::new();
    let mut given_up = false;
    for problem in problems {
        let mut reply = ask(problem)?;
        let judgement = Judgement::of(problem, &reply, tolerance);
        // They may be many, and have told what they can.
        if let Reply::Answered(answer) = &mut reply {
            answer.steps = Vec::new();
        }
        checked.push(Checked { problem: problem.clone(), reply, judgement });
        let silent = |of: &Checked| matches!(of.reply, Reply::Crashed(_) | Reply::TimedOut(_));
        let more = checked.len() < problems.len();
        given_up = more && checked.len() == PATIENCE && checked.iter().all(silent);
        if given_up {
            break;
        }
    }
    let answers = Vec::from_iter(checked.iter().filter_map(Given::of));
    let by_penalty = problems.iter().any(|problem| problem.penalty.is_some());
    let penalty = Penalty::measured(&answers, Measured::ByForce, tolerance);
    let missed = Threshold::missed(&answers, tolerance);
    let held = Threshold::held(&answers, tolerance);
    let diagnosis = diagnosis::diagnose(&answers, by_penalty, &penalty, tolerance);
    Ok(Report { checked, given_up, penalty, missed, held, diagnosis })
}

impl Report {
    /// Is nothing wrong, and something of each family right? A refusal is not wrong; but of a family that is
    /// refused altogether nothing is known.
    pub fn holds(&self) -> bool {
        let Summary { wrong, crashed, timed_out, .. } = self.summary();
        let families = self.families();
        let known = !families.is_empty() && families.iter().all(|row| row.right > 0);
        known && wrong + crashed + timed_out == 0 && self.lag().is_none()
    }

    /// The smallest |R| relative to |m g| + |c (H − l)| of the systems in this state that a solver which
    /// takes them for the other state gets wrong by more than the tolerance; `None` if there are none.
    pub fn least_deciding(&self, state: State, tolerance: &Exact) -> Option<Exact> {
        let parts = self.checked.iter().filter_map(|checked| {
            let system = &checked.problem.system;
            let exact = &checked.judgement.exact;
            let [_, loads] = judge::scales(system);
            let part = system::reaction(system).abs() / &loads;
            // By penalty the plane pushes with less.
            let error =
                if state == State::Contact { exact.contact_force.abs() / loads } else { part.clone() };
            (exact.state == state && error > *tolerance).then_some(part)
        });
        parts.min()
    }

    /// How many problems came to what.
    pub fn summary(&self) -> Summary {
        let count = |verdict| self.checked.iter().filter(|of| of.judgement.verdict == verdict).count();
        Summary {
            right: count(Verdict::Right),
            within_tolerance: count(Verdict::WithinTolerance),
            wrong: count(Verdict::Wrong),
            refused: count(Verdict::Refused),
            crashed: count(Verdict::Crashed),
            timed_out: count(Verdict::TimedOut),
        }
    }

    /// What came of each family that was asked for.
    pub fn families(&self) -> Vec<Row<'_>> {
        let mut families: BTreeMap<Family, Vec<&Checked>> = BTreeMap::new();
        for checked in &self.checked {
            families.entry(checked.problem.family).or_default().push(checked);
        }
        families.into_iter().filter_map(|(family, all)| Row::of(family, &all)).collect()
    }

    /// The known mistakes that the answers fit: all of them, or all that are wrong.
    pub fn fitting(&self) -> impl Iterator<Item = &Diagnosis> {
        self.diagnosis.iter().filter(|diagnosis| diagnosis.answers != Answers::Steps)
    }

    /// What the steps show, if they do.
    pub fn lag(&self) -> Option<&Diagnosis> {
        self.diagnosis.iter().find(|diagnosis| diagnosis.answers == Answers::Steps)
    }

    /// The mistake that was made, if exactly one is known that explains the answers; or else, the steps.
    pub fn named(&self) -> Option<&Diagnosis> {
        let mut fitting = self.fitting();
        match (fitting.next(), fitting.next()) {
            (None, _) => self.lag(),
            (only, None) => only,
            _ => None,
        }
    }
}

impl<'a> Row<'a> {
    fn of(family: Family, all: &[&'a Checked]) -> Option<Self> {
        let verdict = all.iter().map(|of| of.judgement.verdict).max()?;
        let with_it = || all.iter().filter(|of| of.judgement.verdict == verdict);
        let worst = |error: fn(&Judgement) -> &Option<Exact>| {
            all.iter().filter_map(|of| error(&of.judgement).clone()).max()
        };
        // `max_by` takes the last of equals.
        let furthest = with_it().rev().max_by(|a, b| a.judgement.error().cmp(&b.judgement.error()))?;
        Some(Row {
            family,
            cases: all.len(),
            verdict,
            count: with_it().count(),
            right: all.iter().filter(|of| of.judgement.verdict <= Verdict::WithinTolerance).count(),
            worst_deflection: worst(|judgement| &judgement.deflection_error),
            worst_force: worst(|judgement| &judgement.force_error),
            worst: furthest,
        })
    }
}
