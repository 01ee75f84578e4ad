//! Replies of a solver.

use crate::chapter::SpringMass;
use crate::number::Exact;

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
