//! The assumptions of a search, and signs under them.

use super::algebra::{Monomial, Ratio};
use super::rules::Certificate;
use crate::formula::Hypothesis;
use crate::proof::check::Sign;

/// An assumption and its use.
#[derive(Clone, Debug)]
pub struct Assumption {
    /// The hypothesis, or `None` for the assumption of a case and for an absolute value.
    pub hypothesis: Option<Hypothesis>,
    /// The quantity, reduced by the earlier assumptions.
    pub value: Ratio,
    /// The positive divisor, if the slack variable is a quotient of the quantity.
    pub divisor: Option<Ratio>,
    /// The use of the assumption.
    pub usage: AssumptionUse,
}

impl Assumption {
    /// Returns the quantity that a slack variable replaces.
    pub fn slack_value(&self) -> Ratio {
        let quotient = self.divisor.as_ref().and_then(|by| self.value.checked_div(by));
        quotient.unwrap_or_else(|| self.value.clone())
    }
}

/// The use of an assumption.
#[derive(Clone, Debug)]
pub enum AssumptionUse {
    /// The assumption follows from the earlier ones.
    Implied,
    /// The sign of a variable.
    Variable(usize),
    /// A pivot, its value, and the slack variable for the quantity, unless that is 0.
    Pivot(Monomial, Ratio, Option<usize>),
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
    /// The quantity is retained unchanged. Multiples of it may be [subtracted](SignedRatio::less).
    Retained,
    /// An equation without a pivot, which is not used.
    Unused,
}

/// The sign of a quotient.
#[derive(Clone, Debug)]
pub struct SignedRatio {
    /// The multiple of an assumed quantity that is subtracted first, if any.
    pub subtracted: Option<Box<Multiple>>,
    /// The sign of the numerator of the quotient or, after a subtraction, of the difference.
    pub num: Certificate,
    /// The strict sign of the denominator.
    pub den: Certificate,
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
    /// The quantity.
    pub of: Ratio,
    /// The sign of the sum of the multiple and the difference.
    pub sum_sign: Sign,
}
