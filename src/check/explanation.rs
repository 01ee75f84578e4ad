//! Explanations of wrong answers.

use super::observation::Observation;
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

/// A mistake that explains answers, whatever it is.
pub(super) struct Explanation {
    pub name: String,
    /// Descriptions of mistakes in other parameters with the same results.
    pub equivalent: Vec<String>,
    /// The lines of a program with the mistake, or its number.
    pub program: Vec<String>,
    /// Whether only the decision between the two states is wrong.
    pub is_decision: bool,
    /// Whether the mistake may give an answer.
    pub may_give: Box<dyn Fn(&Observation) -> bool>,
}

impl Explanation {
    /// Returns an explanation of all answers, of which there is no single one to ask for.
    pub fn new(name: impl Into<String>, program: Vec<String>) -> Self {
        let may_give = Box::new(|_: &Observation| false);
        Explanation { name: name.into(), equivalent: Vec::new(), program, is_decision: false, may_give }
    }

    /// Returns the diagnosis of a number of answers.
    pub fn diagnosis(self, answers: DiagnosisScope, of: usize) -> Diagnosis {
        let Explanation { name, equivalent, program, .. } = self;
        Diagnosis { name, equivalent, program, answers, of }
    }
}
