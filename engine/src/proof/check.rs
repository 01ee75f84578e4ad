//! The checker of proofs.
//!
//! # Certificates
//!
//! There is one rule for signs. A [`Certificate`] for a polynomial f states l f = r for two *forms* l and r,
//! polynomials in atoms and facts, whose signs are known. The sign of a form is read off its terms: factors between −1
//! and 1 do not increase the absolute value of a term, and their squares do not change its sign. So 1 + e ≥ 0 for
//! −1 ≤ e ≤ 1. Expanding both sides checks the identity.
//!
//! # Proofs
//!
//! A proof of a goal is a tree of cases ([`Node`]), whose leaves are lists of [steps](Step). Most steps add a *fact*: the
//! sign of a polynomial. Formulas are translated into quotients of polynomials, operation by operation. Where this
//! depends on a sign, or on a divisor that is not 0, a fact before it has to state so. The goal is proved if the facts
//! state the sign of its translation. The checker does not search, and an error in a proof can only make it refuse.
//!
//! The variables of polynomials are the [atoms](Atom) of the goal: its symbols, the errors of its rounded
//! formulas, the parameters of symbols in their intervals, its absolute values with their factors, and its
//! exponentials. The goal and its hypotheses determine them.
//!
//! # Rounding
//!
//! fl(x), the nearest number of p bits, is x (1 + γ e) for some −1 ≤ e ≤ 1, where γ = 1/(2ᵖ + 1), in the absence
//! of overflow and underflow. *Proof.* Let 2ᵏ ≤ |x| < 2ᵏ⁺¹. Then |fl(x) − x| is at most 2ᵏ/2ᵖ, and, since 2ᵏ
//! itself has p bits, at most |x| − 2ᵏ. Adding the second bound to 2ᵖ times the first gives
//! (2ᵖ + 1) |fl(x) − x| ≤ 2ᵏ + |x| − 2ᵏ = |x|. □ A change of units by a power of two leaves the digits as they are, so
//! formulas that differ by one share their e. Rounding is monotone, so fl(a) ≥ fl(b) if a ≥ b; it
//! is not continuous, so limits and derivatives of rounded formulas are refused.
//!
//! # Exponentials
//!
//! For x ≠ 0 the graph of the exponential function, which is convex, lies above its tangent at 0: eˣ > 1 + x. And
//! (2 − x) eˣ < 2 + x for x > 0, because the derivative of 2 + x − (2 − x) eˣ, which is 0 at x = 0, is
//! 1 − (1 − x) eˣ = eˣ (e⁻ˣ − 1 + x) > 0.
//!
//! # Limits
//!
//! A hypothesis about the variable of a limit must hold for all sufficiently large values, by its degrees and
//! leading coefficients, before it becomes a fact. A limit follows from the degrees of numerator and denominator;
//! e^… with an exponent that tends to −∞ vanishes against any power.

mod form;
mod limit;
mod polynomial;
mod premises;
mod quotient;
mod sign;
mod state;
mod table;
#[cfg(test)]
mod tests;

pub use polynomial::{MAX_VARIABLES, Polynomial, Powers};
pub use premises::Premise;
pub(in crate::proof) use premises::{check_premises, check_size};
pub(in crate::proof) use quotient::Quotient;
pub use sign::Sign;
pub(in crate::proof) use state::Knowledge;
pub use table::Atom;
pub(in crate::proof) use table::Sequent;

use crate::formula::statement::Statement;

/// Maximum nesting of cases.
const MAX_NESTING: usize = 32;

/// A proof of the sign of a polynomial f: an identity l f = r.
///
/// The variables of l and r are the atoms and, after these, the known facts. The sign of l must be strict. The sign of f
/// is the product of the signs of l and r.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Certificate {
    /// The numbers of the facts that l and r are expressed by.
    pub known: Vec<usize>,
    /// The form l. Its sign follows from its terms and is strict.
    pub left: Polynomial,
    /// The form r. Its sign follows from its terms.
    pub right: Polynomial,
}

/// A step of a proof.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Step {
    /// The hypothesis with this number. An interval gives its symbol a value; any other one adds a fact. In a limit, all
    /// that mention its variable have to be assumed.
    Assume(usize),
    /// A polynomial and the certificate of its sign: a fact.
    Show(Polynomial, Certificate),
    /// The square of a polynomial, which is not negative: a fact.
    Square(Polynomial),
    /// The numbers of facts of strict sign, whose product will be a divisor.
    Divisor(Vec<usize>),
    /// An instance of a law: a fact.
    Law(Law),
}

/// A law of a function. Exponentials are given by their variables.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Law {
    /// Two products of exponentials are equal if the sums of their exponents are.
    Exponents {
        /// The factors of the first product.
        left: Vec<usize>,
        /// The factors of the second product.
        right: Vec<usize>,
    },
    /// eˣ ≥ 1 + x, and eˣ > 1 + x if x ≠ 0.
    AboveTangent(usize),
    /// (2 − x) eˣ ≤ 2 + x for x ≥ 0, and (2 − x) eˣ < 2 + x if x > 0.
    BelowPole(usize),
    /// x = t |x| for some −1 ≤ t ≤ 1, for the formula x with this number.
    AbsoluteValue(usize),
    /// |x| = x if x ≥ 0, and |x| = −x if x ≤ 0, for the formula x with this number.
    Signed(usize),
    /// fl(a) ≥ fl(b) if a ≥ b, for the formulas fl(a) and fl(b) with these numbers.
    Order([usize; 2]),
}

/// A proof of a goal under the assumptions of some cases.
///
/// The facts at a leaf have numbers. The first ones are 2 > 0 and the assumptions of the cases.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Node {
    /// A quantity, a polynomial of atoms, and proofs for the cases that it is positive and that it is not.
    Cases(Polynomial, Box<[Node; 2]>),
    /// A proof without further cases.
    Leaf(Vec<Step>),
}

/// The reason why a proof is refused.
#[derive(Clone, Debug, thiserror::Error)]
pub enum CheckError {
    /// The statement does not satisfy a premise.
    #[error("{0}")]
    Statement(Premise),
    /// The number of proofs is not that of the goals.
    #[error("there is not one proof for each goal")]
    Goals,
    /// The proof of the goal with this number is refused.
    #[error("goal {0}: {1:?}")]
    Goal(usize, Refusal),
}

/// The reason why the proof of a goal is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a proof that is refused: {self:?}")]
pub enum Refusal {
    /// A coefficient, power, sum, product or nesting exceeds its limit.
    TooLarge,
    /// A number is not that of a fact, variable, formula or hypothesis.
    Unknown,
    /// The two sides of a certificate differ.
    Identity,
    /// The sign of a form does not follow from its terms.
    Form,
    /// The sign of a factor of a divisor, or of the left side of a certificate, is not strict.
    NotStrict,
    /// No fact states the sign of a quantity that decides about the value of a formula.
    Sign,
    /// No fact, or product of facts, is the divisor.
    Divisor,
    /// The facts do not state the premise of a law.
    Law,
    /// The formula contains an operation that is not differentiable.
    NotDifferentiable,
    /// The limit does not follow from the degrees, or a hypothesis does not hold for all large values.
    Limit,
    /// The facts do not state what is to be proved.
    Goal,
}

type Checked<T> = Result<T, Refusal>;

/// A proof of a statement, which the checker accepts.
///
/// Only [`check`] makes a proof, and a proof cannot be changed.
///
/// # Examples
/// ```
/// use provable::formula::claim::equal;
/// use provable::{number::Tree, proof::{Proof, prove}};
/// let x = Tree::symbol("x");
/// let statement = equal("twice", &x + &x, Tree::from(2) * &x);
/// let proof: Proof = prove(&statement).unwrap();
/// assert_eq!(proof.statement().goals().len(), proof.goals().len());
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
    statement: Statement,
    goals: Vec<Node>,
}

impl Proof {
    /// Returns the proved statement.
    pub fn statement(&self) -> &Statement {
        &self.statement
    }

    /// Returns the proof of each goal, in the order of the goals.
    pub fn goals(&self) -> &[Node] {
        &self.goals
    }
}

/// Checks a proof of a statement, which consists of a proof of each of its goals.
///
/// # Errors
/// Returns the reason if the proof is refused, which does not refute the statement.
pub fn check(statement: &Statement, goals: &[Node]) -> Result<Proof, CheckError> {
    check_premises(statement).map_err(CheckError::Statement)?;
    if goals.len() != statement.goals().len() {
        return Err(CheckError::Goals);
    }
    for (i, (goal, node)) in statement.goals().iter().zip(goals).enumerate() {
        let sequent = Sequent::new(&goal.proposition, statement.hypotheses_for(goal.role));
        let checked = sequent.and_then(|sequent| check_node(&sequent, &[], node));
        checked.map_err(|reason| CheckError::Goal(i, reason))?;
    }
    Ok(Proof { statement: statement.clone(), goals: goals.into() })
}

/// Checks a proof under the assumptions of cases.
fn check_node(sequent: &Sequent, cases: &[(Polynomial, Sign)], node: &Node) -> Checked<()> {
    match node {
        Node::Cases(..) if cases.len() >= MAX_NESTING => Err(Refusal::TooLarge),
        Node::Cases(on, both) => {
            let mut both = both.iter().zip([Sign::POSITIVE, Sign::NON_POSITIVE]);
            both.try_for_each(|(node, sign)| {
                check_node(sequent, &[cases, &[(on.clone(), sign)]].concat(), node)
            })
        }
        Node::Leaf(steps) => {
            let mut state = Knowledge::new(sequent, cases)?;
            steps.iter().try_for_each(|step| state.apply(step))?;
            if state.proves_goal()? { Ok(()) } else { Err(Refusal::Goal) }
        }
    }
}
