//! What a proof consists of: read by whoever prints it, made by the kernel alone.
//!
//! The fields of a structure are seen by nobody else. So a variant of an enum, which anyone in this crate
//! can write down, gets into a [`Proof`] here or not at all.

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::sign::{Certificate, Sign};
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
    pub(super) supposed: Vec<Supposed>,
    pub(super) errors: Vec<Rounding>,
    pub(super) divisors: Vec<(Tree, Signed)>,
    pub(super) brackets: Vec<(Tree, Tree, Signed)>,
    pub(super) because: Because,
}

impl Direct {
    /// What is supposed, and how it is used.
    pub fn supposed(&self) -> &[Supposed] {
        &self.supposed
    }

    /// Each formula that is rounded, and what its error is called, those inside it before it.
    pub fn errors(&self) -> &[Rounding] {
        &self.errors
    }

    /// Each divisor, and why it is not 0.
    ///
    /// Its numerator has a strict sign; its own divisors are listed before it.
    pub fn divisors(&self) -> &[(Tree, Signed)] {
        &self.divisors
    }

    /// Each bracket, which of its values it has, and why: the sign of what decides it.
    pub fn brackets(&self) -> &[(Tree, Tree, Signed)] {
        &self.brackets
    }

    /// The rest.
    pub fn because(&self) -> &Because {
        &self.because
    }
}

/// A rounding.
#[derive(Clone, Debug)]
pub struct Rounding {
    pub(super) of: Tree,
    pub(super) error: Symbol,
    pub(super) scale: Ratio,
}

impl Rounding {
    /// What is rounded.
    pub fn of(&self) -> &Tree {
        &self.of
    }

    /// What its error is called: the same for all that is the same but for powers of two.
    pub fn error(&self) -> Symbol {
        self.error
    }

    /// By which powers of two it differs from what else has that error, in other units.
    pub fn scale(&self) -> &Ratio {
        &self.scale
    }
}

/// A supposition and what became of it.
#[derive(Clone, Debug)]
pub struct Supposed {
    pub(super) given: Option<Hypothesis>,
    pub(super) value: Ratio,
    pub(super) sign: Sign,
    pub(super) divided_by: Option<Ratio>,
    pub(super) used: Used,
}

impl Supposed {
    /// The hypothesis, or `None` for the case of a split.
    pub fn given(&self) -> Option<&Hypothesis> {
        self.given.as_ref()
    }

    /// The quantity it speaks of, before this supposition is used.
    pub fn value(&self) -> &Ratio {
        &self.value
    }

    /// What it says of its sign.
    pub fn sign(&self) -> Sign {
        self.sign
    }

    /// The positive divisor of the quantity, if not the quantity itself but a quotient is named by a slack.
    pub fn divided_by(&self) -> Option<&Ratio> {
        self.divided_by.as_ref()
    }

    /// How it is used.
    pub fn used(&self) -> &Used {
        &self.used
    }
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
    /// As it is: there is no pivot. Multiples of it may be [subtracted](Signed::less).
    Kept,
    /// Not at all. What is proved holds without it, too.
    Unused,
}

/// The sign of a quotient.
#[derive(Clone, Debug)]
pub struct Signed {
    pub(super) value: Ratio,
    pub(super) less: Option<Box<Multiple>>,
    pub(super) num: Certificate,
    pub(super) den: Certificate,
}

impl Signed {
    /// The quotient, reduced by the suppositions.
    pub fn value(&self) -> &Ratio {
        &self.value
    }

    /// The multiple of an assumption that is subtracted first, if one is.
    pub fn less(&self) -> Option<&Multiple> {
        self.less.as_deref()
    }

    /// The sign of its numerator, or of that of the difference.
    pub fn num(&self) -> &Certificate {
        &self.num
    }

    /// The strict sign of the denominator.
    pub fn den(&self) -> &Certificate {
        &self.den
    }

    /// The sign of the quotient.
    pub fn sign(&self) -> Sign {
        let rest = self.num.sign().times(self.den.sign());
        self.less.as_ref().map_or(rest, |less| less.whole)
    }
}

/// A multiple of an assumed quantity, whose sign is that of the factor times that of the quantity.
#[derive(Clone, Debug)]
pub struct Multiple {
    pub(super) factor: Signed,
    pub(super) of: Ratio,
    /// The sign of the sum of this and the rest.
    pub(super) whole: Sign,
}

impl Multiple {
    /// The factor.
    pub fn factor(&self) -> &Signed {
        &self.factor
    }

    /// The quantity.
    pub fn of(&self) -> &Ratio {
        &self.of
    }
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
    /// A divisor might be 0.
    MightVanish(Ratio),
    /// It is not known whether a bracket opens, and no case can be made of it.
    OpenBracket(Ratio),
    /// No rule finds the sign.
    NoSign(Ratio),
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
