//! The assumptions of a search, and signs under them.

use super::algebra::{Monomial, Poly, Ratio};
use super::rules::SignCertificate;
use crate::formula::Hypothesis;
use crate::proof::check::Sign;

/// An assumption and its use.
#[derive(Clone, Debug)]
pub struct Assumption {
    /// The hypothesis, or `None` for the assumption of a case, a law, and an absolute value.
    pub hypothesis: Option<Hypothesis>,
    /// The quantity, reduced by the earlier assumptions, perhaps divided by a positive symbol.
    pub value: Ratio,
    /// The fact of the checker, except for an interval.
    pub fact: Option<AssumedFact>,
    /// The use of the assumption.
    pub usage: AssumptionUse,
}

impl Assumption {
    /// Returns `true` if the quantity is that of the hypothesis divided by a symbol.
    pub fn is_divided(&self) -> bool {
        self.fact.as_ref().is_some_and(|fact| !fact.scale.den().is_one())
    }
}

/// A fact of the checker for an assumption, whose quantity is `scale` times the fact divided by other facts.
#[derive(Clone, Debug)]
pub struct AssumedFact {
    pub fact: usize,
    pub den: Vec<usize>,
    pub scale: Ratio,
}

impl AssumedFact {
    /// Returns the quotient of a fact and others.
    pub fn new(fact: usize, den: Vec<usize>) -> Self {
        AssumedFact { fact, den, scale: Poly::constant(1).into() }
    }
}

/// The use of an assumption.
#[derive(Clone, Debug)]
pub enum AssumptionUse {
    /// The assumption follows from the earlier ones, or is an equation without a pivot.
    Unused,
    /// The sign of a variable that is the quantity: a symbol, or a new slack variable, which replaces a pivot.
    Variable(usize),
    /// An equation that is solved for a pivot.
    Equation(Monomial),
    /// The translator replaces a symbol by its value in an interval, with this parameter between −1 and 1.
    Interval(usize),
    /// The absolute value of the quantity is a variable.
    Size {
        /// The pivot.
        pivot: Monomial,
        /// The absolute value.
        size: usize,
        /// The quantity divided by it, between −1 and 1.
        factor: usize,
    },
    /// The quantity of this sign is retained unchanged. Multiples of it may be [subtracted](SignedRatio::subtracted).
    Retained(Sign),
}

/// The sign of a quotient.
#[derive(Clone, Debug)]
pub struct SignedRatio {
    /// The multiple of an assumed quantity that is subtracted first, if any.
    pub subtracted: Option<Box<Multiple>>,
    /// The sign of the numerator of the quotient or, after a subtraction, of the difference.
    pub num: SignCertificate,
    /// The strict sign of the denominator.
    pub den: SignCertificate,
}

impl SignedRatio {
    /// Returns the sign of the quotient.
    pub fn sign(&self) -> Sign {
        let rest = self.num.sign().times(self.den.sign());
        self.subtracted.as_ref().map_or(rest, |less| less.sum_sign)
    }
}

/// A multiple of an assumed quantity; its sign is the product of the signs of the factor and the quantity.
#[derive(Clone, Debug)]
pub struct Multiple {
    /// The sign of the factor.
    pub factor: SignedRatio,
    /// The number of the assumption about the quantity.
    pub of: usize,
    /// The sign of the sum of the multiple and the difference.
    pub sum_sign: Sign,
}
