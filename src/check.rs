//! Holds somebody else's solver against the exact answer, and says what is wrong with it.

use crate::chapter::SpringMass;
use crate::number::Exact;

/// A system to be solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What it is called in requests and answers.
    pub id: String,
    /// Its parameters: decimals of few digits.
    pub system: SpringMass<Exact>,
    /// ε in N/m, if the penalty method is asked for.
    pub penalty: Option<Exact>,
}

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
    /// It was still at it when its time was up.
    TimedOut,
}
