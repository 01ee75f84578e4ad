//! Propositions about formulas, the goals of statements.

use super::hypothesis::{Hypothesis, Relation};
use crate::number::Tree;

/// A part of a statement.
#[derive(Clone, Debug)]
pub struct Goal {
    /// The name of the part, if there are several.
    pub part: &'static str,
    /// Role in the argument, which decides the hypotheses that it may use.
    pub role: Role,
    /// The proposition to be proved.
    pub proposition: Proposition,
}

/// Role of a goal in the argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The claim, under its hypotheses.
    Claim,
    /// A step of an induction, for which the invariants are assumed as well.
    Step,
    /// An invariant at the start, where no invariant may be assumed.
    InvariantBase,
    /// An invariant after a step, if it holds before the step.
    InvariantStep,
    /// A computed quantity is in its interval, under the invariants and the intervals of the quantities
    /// before it; the number is their count.
    Computed(usize),
}

/// A proposition about formulas.
#[derive(Clone, Debug)]
pub enum Proposition {
    /// Two formulas are equal, and defined.
    Equal(Tree, Tree),
    /// A formula is defined and has a sign.
    Sign(Relation, Tree),
    /// A formula is at most another in absolute value.
    Within(Tree, Tree),
    /// The third is the derivative of the first with respect to a quantity.
    Derivative(Tree, &'static str, Tree),
    /// The first tends to the third as a quantity tends to infinity.
    Limit(Tree, &'static str, Tree),
}

impl Proposition {
    /// Returns a hypothesis as a proposition, with formulas substituted for symbols.
    ///
    /// |x − a| ≤ b is stronger than a − b ≤ x ≤ a + b, since b could be negative.
    pub(super) fn of_hypothesis(hypothesis: &Hypothesis, replaced: &[(&str, Tree)]) -> Self {
        match hypothesis.distance() {
            Some((distance, most)) => {
                Proposition::Within(distance.substitute(replaced), most.substitute(replaced))
            }
            None => Proposition::Sign(hypothesis.relation, hypothesis.value.substitute(replaced)),
        }
    }

    pub(super) fn kind(&self) -> &'static str {
        match self {
            Proposition::Equal(..) => "equal",
            Proposition::Sign(..) => "sign",
            Proposition::Within(..) => "bound",
            Proposition::Derivative(..) => "derivative",
            Proposition::Limit(..) => "limit",
        }
    }

    /// Returns the symbol of differentiation or of a limit.
    pub fn variable(&self) -> Option<&'static str> {
        match self {
            Proposition::Derivative(_, by, _) | Proposition::Limit(_, by, _) => Some(by),
            Proposition::Equal(..) | Proposition::Sign(..) | Proposition::Within(..) => None,
        }
    }

    /// Returns its formulas.
    pub fn trees(&self) -> [&Tree; 2] {
        match self {
            Proposition::Equal(a, b) | Proposition::Within(a, b) => [a, b],
            Proposition::Derivative(a, _, b) | Proposition::Limit(a, _, b) => [a, b],
            Proposition::Sign(_, a) => [a, a],
        }
    }

    pub(crate) fn map(&self, f: &impl Fn(&Tree) -> Tree) -> Self {
        match self {
            Proposition::Equal(a, b) => Proposition::Equal(f(a), f(b)),
            Proposition::Sign(relation, a) => Proposition::Sign(*relation, f(a)),
            Proposition::Within(a, b) => Proposition::Within(f(a), f(b)),
            Proposition::Derivative(a, by, b) => Proposition::Derivative(f(a), by, f(b)),
            Proposition::Limit(a, by, b) => Proposition::Limit(f(a), by, f(b)),
        }
    }
}

impl Goal {
    /// Returns a goal with the role of a claim.
    pub fn of_claim(part: &'static str, proposition: Proposition) -> Self {
        Goal { part, role: Role::Claim, proposition }
    }
}
