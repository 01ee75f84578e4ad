//! The parts of a proof.
//!
//! Any code in this crate can construct a derivation, which proves nothing by itself: only the kernel
//! constructs a [`Proof`].

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::sign::{Certificate, Sign, SignEnv};
use crate::formula::{Hypothesis, Statement};
use crate::number::Tree;

/// A proof of a statement: a derivation for each of its goals.
///
/// Only [`prove`](super::prove) makes a proof, and a proof cannot be changed.
///
/// # Examples
/// ```
/// use provable::formula::claim::equal;
/// use provable::{number::Tree, proof::{Proof, prove}};
/// let x = Tree::symbol("x");
/// let statement = equal("twice", &x + &x, Tree::from(2) * &x);
/// let proof: Proof = prove(&statement).unwrap();
/// assert_eq!(proof.statement().goals().len(), 1);
/// ```
/// ```compile_fail
/// # use provable::formula::claim::equal;
/// # use provable::{number::Tree, proof::{Proof, prove}};
/// # let x = Tree::symbol("x");
/// # let statement = equal("twice", &x + &x, Tree::from(2) * &x);
/// # let mut proof: Proof = prove(&statement).unwrap();
/// proof.statement = statement.clone();
/// ```
/// ```compile_fail
/// # use provable::formula::claim::equal;
/// # use provable::{number::Tree, proof::{Proof, prove}};
/// # let x = Tree::symbol("x");
/// # let statement = equal("twice", &x + &x, Tree::from(2) * &x);
/// # let mut proof: Proof = prove(&statement).unwrap();
/// proof.goals.clear();
/// ```
#[derive(Clone, Debug)]
pub struct Proof {
    pub(super) statement: Statement,
    pub(super) goals: Vec<Derivation>,
}

impl Proof {
    /// Returns the proved statement.
    pub fn statement(&self) -> &Statement {
        &self.statement
    }

    /// Returns the derivation of each goal, in the order of the goals.
    pub(in crate::proof) fn goals(&self) -> &[Derivation] {
        &self.goals
    }
}

/// The derivation of a goal.
#[derive(Clone, Debug)]
pub enum Derivation {
    /// A derivation for each of two cases: a quantity is positive, or it is not.
    Cases(Poly, Box<Derivation>, Box<Derivation>),
    /// A derivation without case distinction.
    Direct(Box<Direct>),
}

/// A derivation without case distinction.
#[derive(Clone, Debug)]
pub struct Direct {
    /// The assumptions and their uses.
    pub assumptions: Vec<Assumption>,
    /// The rounded formulas, each after those inside it.
    pub roundings: Vec<Rounding>,
    /// The divisors, each after those inside it, and their strict signs.
    pub divisors: Vec<(Tree, SignedRatio)>,
    /// The positive parts and minima, the branch that each equals, and the sign that decides this.
    pub branches: Vec<(Tree, Tree, SignedRatio)>,
    /// The justification of the goal.
    pub justification: Justification,
}

/// A rounding.
#[derive(Clone, Debug)]
pub struct Rounding {
    /// The rounded formula.
    pub of: Tree,
    /// The symbol of its relative error, which formulas that differ by a power of two share.
    pub error: Symbol,
    /// The power of two that is factored out of the formula.
    pub scale: Ratio,
}

/// An assumption and its use.
#[derive(Clone, Debug)]
pub struct Assumption {
    /// The hypothesis, or `None` for the assumption of a case and for an absolute value.
    pub hypothesis: Option<Hypothesis>,
    /// The quantity, reduced by the earlier assumptions.
    pub value: Ratio,
    /// The sign of the quantity.
    pub sign: Sign,
    /// The positive divisor, if the slack variable is a quotient of the quantity.
    pub divisor: Option<Ratio>,
    /// The use of the assumption.
    pub usage: AssumptionUse,
}

impl Assumption {
    /// Returns `true` for the assumption of a case.
    pub fn is_case(&self) -> bool {
        self.hypothesis.is_none() && !self.usage.is_size()
    }

    /// Returns the quantity that a slack variable replaces.
    pub fn slack_value(&self) -> Ratio {
        let quotient = self.divisor.as_ref().and_then(|by| self.value.over(by));
        quotient.unwrap_or_else(|| self.value.clone())
    }
}

/// The use of an assumption.
#[derive(Clone, Debug)]
pub enum AssumptionUse {
    /// The assumption follows from the earlier ones.
    Implied,
    /// The sign of a symbol.
    Symbol(Symbol),
    /// A pivot, its value, and the slack variable for the quantity, unless that is 0.
    Pivot(Monomial, Ratio, Option<Symbol>),
    /// A symbol, its value in its interval, and the interval parameter between −1 and 1.
    Interval(Symbol, Ratio, Symbol),
    /// The absolute value of the quantity is a symbol `size`, and the quantity is the product of it and a symbol
    /// between −1 and 1.
    Size {
        /// The formula of the quantity.
        of: Tree,
        /// The pivot.
        pivot: Monomial,
        /// The value of the pivot.
        by: Ratio,
        /// The absolute value.
        size: Symbol,
        /// The factor between −1 and 1.
        place: Symbol,
    },
    /// The quantity is retained unchanged. Multiples of it may be [subtracted](SignedRatio::less).
    Retained,
    /// An equation without a pivot, or an interval of a replaced quantity, which is not used.
    Unused,
}

impl AssumptionUse {
    /// Returns `true` if an absolute value is replaced.
    pub fn is_size(&self) -> bool {
        matches!(self, AssumptionUse::Size { .. })
    }
}

/// The sign of a quotient.
#[derive(Clone, Debug)]
pub struct SignedRatio {
    /// The quotient, reduced by the assumptions.
    pub value: Ratio,
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

/// The justification of a goal.
#[derive(Clone, Debug)]
pub enum Justification {
    /// The common value of both sides of an equation.
    Equal(Ratio),
    /// The sign of the quantity.
    Sign(SignedRatio),
    /// The signs of b − a and b + a, for |a| ≤ b.
    Within(Box<[SignedRatio; 2]>),
    /// The signs that imply the order of two rounded formulas.
    Order(Vec<SignedRatio>),
    /// The common value of the derivative, computed by dual numbers, and of the other side.
    Derivative(Ratio),
    /// A limit, by the degrees in the symbol.
    Limit {
        /// The quotient whose limit is taken.
        of: Ratio,
        /// The symbol that tends to infinity.
        by: Symbol,
        /// The degrees of numerator and denominator, without the e^… that vanish.
        degrees: (u32, u32),
        /// The strict sign of the leading coefficient of the denominator.
        leading: Certificate,
        /// The limit.
        to: Ratio,
    },
}

/// The reason why a statement could not be proved.
#[derive(Clone, Debug)]
pub enum ProofError {
    /// A divisor may be 0: its formula, and its value under the hypotheses.
    PossibleZeroDivisor(Tree, Ratio),
    /// The branch of a positive part or minimum is undecided by this quantity, and no more cases may be distinguished.
    UndecidedBranch(Ratio),
    /// The branch of an absolute value is undecided by this quantity, twice its argument.
    UndecidedSize(Tree, Ratio),
    /// No rule finds the sign of a quantity, for these signs of symbols.
    UnknownSign(Ratio, std::sync::Arc<SignEnv>),
    /// The sign of a quantity differs from the required one.
    WrongSign(Ratio, Sign),
    /// The two sides of an equation differ by this amount.
    Unequal(Ratio),
    /// The formula to be differentiated contains ⟨·⟩ or min.
    NotDifferentiable,
    /// No rule finds the limit of a quantity.
    UnknownLimit(Ratio),
    /// A rounded formula, which is discontinuous, occurs in a limit or derivative.
    Discontinuous,
    /// The statement contains more roundings than the kernel has symbols for.
    TooManyRoundings,
    /// The statement uses a reserved name.
    ReservedName(&'static str),
    /// A hypothesis other than its interval contains a computed symbol, or that is computed from itself.
    HypothesisOnComputed(&'static str),
    /// The statement has no goals.
    NoGoals,
    /// The named quantity of the statement or its proof exceeds this maximum.
    TooLarge(&'static str, usize),
}
