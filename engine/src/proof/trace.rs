//! Proofs step by step, as the checker reads them, for those who print them.

use super::check::{
    AbsoluteValue, Leaf, List, Polynomial, Problem, Question, Quotient, Reason, Refusal, Same, Sign, Source,
    State, Translator,
};

/// A step of a leaf, in the order in which the checker asks for it.
#[derive(Clone, Debug)]
pub enum Step {
    /// The sign of a polynomial, which is a numerator over these facts, with its reason.
    Sign {
        /// The polynomial.
        of: Polynomial,
        /// The facts in the denominator.
        den: Vec<usize>,
        /// The reason.
        reason: Reason,
        /// The number of facts before this step.
        facts: usize,
    },
    /// The factors of a divisor.
    Divisor(Vec<Polynomial>),
    /// The earlier formula that has the error of a rounded one, if there is one.
    Rounding(Option<Same>),
    /// The absolute value of the formula with this number.
    Size(usize, Quotient, AbsoluteValue),
}

/// The lists of a leaf, and the steps so far.
struct Trace<'a> {
    list: List<'a>,
    steps: Vec<Step>,
}

/// Returns the steps of a leaf under the assumptions of cases, and what is known after the last one.
///
/// # Errors
/// Returns the reason if the checker refuses the leaf.
pub fn trace<'p>(
    problem: &'p Problem,
    leaf: &Leaf,
    cases: &[(Polynomial, Sign)],
) -> Result<(State<'p>, Vec<Step>), Refusal> {
    let mut translator = Translator::new(problem, Trace { list: List::of(leaf), steps: Vec::new() });
    translator.leaf(leaf, cases)?;
    Ok((translator.state, translator.source.steps))
}

/// Returns a translator of the formulas that were read before, without a proof.
pub fn reread(state: State<'_>) -> Translator<'_, List<'static>> {
    Translator { state, source: List::default() }
}

impl Source for Trace<'_> {
    fn sign(&mut self, question: Question, state: &State) -> Option<Reason> {
        let reason = self.list.sign(question, state)?;
        let (of, den, facts) = (question.of.clone(), question.den.into(), state.facts.iter().len());
        self.steps.push(Step::Sign { of, den, reason: reason.clone(), facts });
        Some(reason)
    }

    fn divisor(&mut self, of: usize, value: &Polynomial, state: &State) -> Option<Vec<Polynomial>> {
        let factors = self.list.divisor(of, value, state)?;
        self.steps.push(Step::Divisor(factors.clone()));
        Some(factors)
    }

    fn rounding(&mut self, of: usize, value: &Quotient, state: &State) -> Option<Option<Same>> {
        let same = self.list.rounding(of, value, state)?;
        self.steps.push(Step::Rounding(same.clone()));
        Some(same)
    }

    fn size(&mut self, of: usize, value: &Quotient, state: &State) -> Option<AbsoluteValue> {
        let size = self.list.size(of, value, state)?;
        self.steps.push(Step::Size(of, value.clone(), size));
        Some(size)
    }
}
