//! The parts of a proof.
//!
//! Anyone in this crate may write down a derivation, which proves nothing: only the kernel puts one into a
//! [`Proof`].

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::sign::{Certificate, Known, Sign};
use crate::formula::{Hypothesis, Statement};
use crate::number::Tree;

/// A proof of a statement: a derivation for each of its goals. Only [`prove`](super::prove) makes one, and
/// it stays what it is:
///
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
    /// What is proved.
    pub fn statement(&self) -> &Statement {
        &self.statement
    }

    /// How each goal is derived, in the order of the goals.
    pub(in crate::proof) fn goals(&self) -> &[Derivation] {
        &self.goals
    }
}

/// How a goal is derived.
#[derive(Clone, Debug)]
pub enum Derivation {
    /// In two cases: a quantity is positive, or it is not.
    Cases(Poly, Box<Derivation>, Box<Derivation>),
    /// In one go.
    Direct(Box<Direct>),
}

/// A derivation without cases of its own.
#[derive(Clone, Debug)]
pub struct Direct {
    /// The assumptions, and how they are used.
    pub supposed: Vec<Supposed>,
    /// The formulas that are rounded, each after those inside it.
    pub errors: Vec<Rounding>,
    /// The divisors, each after its own, and why they are not 0: their numerators have strict signs.
    pub divisors: Vec<(Tree, Signed)>,
    /// The brackets, which of their values they have, and why: the sign of what decides.
    pub brackets: Vec<(Tree, Tree, Signed)>,
    /// The last step.
    pub because: Because,
}

/// A rounding.
#[derive(Clone, Debug)]
pub struct Rounding {
    /// The formula that is rounded.
    pub of: Tree,
    /// Its error: formulas that differ by powers of two have the same.
    pub error: Symbol,
    /// The powers of two by which it differs from what else has that error, in other units.
    pub scale: Ratio,
}

/// A supposition and what became of it.
#[derive(Clone, Debug)]
pub struct Supposed {
    /// The hypothesis, or `None` for the case of a split.
    pub given: Option<Hypothesis>,
    /// The quantity it speaks of, before this supposition is used.
    pub value: Ratio,
    /// The sign that it has.
    pub sign: Sign,
    /// The positive divisor of the quantity, if not the quantity itself but a quotient is named by a slack.
    pub divided_by: Option<Ratio>,
    /// The use that is made of it.
    pub used: Used,
}

/// How a supposition is used.
#[derive(Clone, Debug)]
pub enum Used {
    /// It follows from the others.
    Follows,
    /// The quantity is a symbol; its sign is known from now on.
    Symbol(Symbol),
    /// The pivot is replaced, with a new symbol for the quantity unless it is 0.
    Pivot(Monomial, Ratio, Option<Symbol>),
    /// In its interval the symbol is this, by a new symbol between −1 and 1.
    Between(Symbol, Ratio, Symbol),
    /// Unchanged, as there is no pivot. Multiples of it may be [subtracted](Signed::less).
    Kept,
    /// Not at all. What is proved holds without it, too.
    Unused,
}

/// The sign of a quotient.
#[derive(Clone, Debug)]
pub struct Signed {
    /// The quotient, reduced by the assumptions.
    pub value: Ratio,
    /// The multiple of an assumption that is subtracted first, if one is.
    pub less: Option<Box<Multiple>>,
    /// The sign of its numerator, or of that of the difference.
    pub num: Certificate,
    /// The strict sign of the denominator.
    pub den: Certificate,
}

impl Signed {
    /// Returns the sign of the quotient.
    pub fn sign(&self) -> Sign {
        let rest = self.num.sign().times(self.den.sign());
        self.less.as_ref().map_or(rest, |less| less.whole)
    }
}

/// A multiple of an assumed quantity, whose sign is that of the factor times that of the quantity.
#[derive(Clone, Debug)]
pub struct Multiple {
    /// The sign of the factor.
    pub factor: Signed,
    /// The quantity.
    pub of: Ratio,
    /// The sign of the sum of this and the rest.
    pub whole: Sign,
}

/// The last step of a derivation.
#[derive(Clone, Debug)]
pub enum Because {
    /// Both sides are this.
    Same(Ratio),
    /// A sign.
    Sign(Signed),
    /// What the bound exceeds the size by, on either side.
    Within(Box<[Signed; 2]>),
    /// One rounded formula is no less than another, because of these signs: rounding keeps order.
    Order(Vec<Signed>),
    /// The derivative, as dual numbers compute it, and the other side are this.
    Derivative(Ratio),
    /// By degrees in the symbol, and the sign of the denominator's leading coefficient.
    Limit {
        /// What has the limit.
        of: Ratio,
        /// In which symbol.
        by: Symbol,
        /// The degrees of numerator and denominator, without the e^… that vanish.
        degrees: (u32, u32),
        /// Why the denominator's leading coefficient is not 0.
        leading: Certificate,
        /// The limit.
        to: Ratio,
    },
}

/// Why there is no proof: where a search for a counterexample may start.
#[derive(Clone, Debug)]
pub enum Why {
    /// A divisor might be 0: its formula, and its value under the hypotheses.
    MightVanish(Tree, Ratio),
    /// It is not known whether a bracket opens, and no case can be made of it.
    OpenBracket(Ratio),
    /// No rule finds the sign under these signs of symbols.
    NoSign(Ratio, std::sync::Arc<Known>),
    /// The sign is another.
    WrongSign(Ratio, Sign),
    /// Two sides differ by this.
    Different(Ratio),
    /// A derivative is asked of ⟨·⟩ or min, which have kinks.
    Kink,
    /// No rule finds the limit.
    NoLimit(Ratio),
    /// Something is rounded where something varies: it has jumps.
    Jump,
    /// There are more roundings than names for their errors.
    TooMany,
    /// A name that the kernel keeps for itself.
    Reserved(&'static str),
    /// A hypothesis, other than its interval, mentions this computed symbol, or it is computed from itself.
    AssumedOfComputed(&'static str),
    /// There is no goal.
    Nothing,
    /// The statement or its proof exceeds a limit: which quantity, and the most it may be.
    TooLarge(&'static str, usize),
}
