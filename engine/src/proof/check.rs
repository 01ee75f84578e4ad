//! The checker of proofs.
//!
//! # Certificates
//!
//! There is one rule for signs. A [`Certificate`] for a polynomial f states l f = r for two *forms* l and r,
//! polynomials in quantities of known sign: symbols, hypotheses, and quantities certified before. The sign of
//! a form is read off its terms: factors between −1 and 1 do not increase the absolute value of a term, and
//! their squares do not change its sign. So 1 + e ≥ 0 for −1 ≤ e ≤ 1. Expanding both sides checks the
//! identity.
//!
//! # Proofs
//!
//! A proof of a goal is a tree of cases ([`Node`]), whose leaves ([`Leaf`]) list what they use in the order in
//! which the checker needs it. The checker translates hypotheses and the goal into quotients of polynomials,
//! operation by operation. It takes the sign of each quantity on which this depends from the list, and checks
//! it. It does not search, and an error in a proof can only make it refuse.
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
//! (2ᵖ + 1) |fl(x) − x| ≤ 2ᵏ + |x| − 2ᵏ = |x|. □ Formulas that are equal up to a power of two share their e,
//! because a change of units leaves the digits as they are. Rounding is monotone, so fl(a) ≥ fl(b) if a ≥ b; it
//! is not continuous, so limits and derivatives of rounded formulas are refused.
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
pub use premises::{MAX_DEPTH, MAX_SIZE, Premise};
pub(in crate::proof) use premises::{MAX_ROUNDINGS, check_premises, check_size, roundings};
pub(in crate::proof) use quotient::Quotient;
pub use sign::Sign;
pub(in crate::proof) use state::{State, Translator};
pub use table::Atom;
pub(in crate::proof) use table::{Problem, derivative};

use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::{Proposition, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;
use std::slice::Iter;

/// Maximum nesting of cases, of lemmas in certificates, and of rising functions.
const MAX_NESTING: u32 = 32;

/// A proof of the sign of a polynomial f: an identity l f = r.
///
/// The variables of l and r are the atoms and, after these, the known quantities. The sign of l must be
/// strict. The sign of f is the product of the signs of l and r.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Certificate {
    /// The quantities that l and r are expressed by.
    pub known: Vec<Known>,
    /// The form l. Its sign follows from its terms and is strict.
    pub left: Polynomial,
    /// The form r. Its sign follows from its terms.
    pub right: Polynomial,
}

/// A quantity in a form.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Known {
    /// The fact with this number, with its sign.
    Fact(usize),
    /// Any polynomial of atoms. Nothing is known of its sign, except that its square is not negative.
    Value(Polynomial),
    /// A polynomial of atoms, with the sign that the certificate proves.
    Lemma(Box<(Polynomial, Certificate)>),
    /// The difference of two products of exponentials, given by their variables. It is 0: the exponents on
    /// both sides have the same sum, as functions of the atoms.
    Exponents {
        /// The factors of the first product.
        left: Vec<usize>,
        /// The factors of the second product.
        right: Vec<usize>,
    },
}

/// A reason for the sign of a polynomial.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Reason {
    /// It is the fact with this number, that is, the same polynomial.
    Fact(usize),
    /// The certificate proves it. The polynomial becomes the next fact.
    Certificate(Certificate),
}

/// A statement that a rounded formula is an earlier one times a power of two, so that both have the same
/// relative error.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Same {
    /// The place of the earlier formula among the rounded formulas of the leaf.
    pub rounding: usize,
    /// The numerator of the power of two, a product of its symbols.
    pub up: Polynomial,
    /// The denominator of the power of two: `down` times the formula is `up` times the earlier one.
    pub down: Polynomial,
}

/// The translation of min(−x, x), which is −|x|.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum AbsoluteValue {
    /// It is x or −x by the sign of 2 x.
    BySign,
    /// It is minus the atom [`Size`](Atom::Size) of x. That x is the product of this atom and its
    /// [`Factor`](Atom::Factor) becomes the next fact.
    Atom,
    /// It is that of the earlier x with this number, which has the same value, or the opposite one.
    Same(usize),
}

/// The sign of a function f(x) for x ≥ 0, by the mean value theorem: f(x) = f(0) + x f'(ξ) for some ξ > 0. It
/// becomes the next fact.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Rise {
    /// The function: a polynomial of symbols and exponentials. It becomes a formula, which is differentiated.
    pub of: Polynomial,
    /// The variable of x: a symbol that is known not to be negative, and that is no power of two.
    pub x: usize,
    /// The relation of f(0) to 0.
    pub start: Relation,
    /// The relation of f'(x) to 0 for x > 0.
    pub slope: Relation,
    /// Proofs, from the hypotheses that do not mention x, that f is differentiable for x ≥ 0, and of the two
    /// relations.
    pub parts: [Node; 3],
}

/// A proof of a goal under the assumptions of some cases.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Node {
    /// A quantity, a polynomial of atoms, and proofs for the cases that it is positive and that it is not.
    Cases(Polynomial, Box<[Node; 2]>),
    /// A proof without further cases.
    Leaf(Box<Leaf>),
}

/// A proof without cases. Its facts are 2 > 0, the assumptions of the cases, and then what follows from each
/// part in this order: hypotheses, rises, orders, goal. A sign that these depend on is a fact before them.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Leaf {
    /// The numbers of the hypotheses to use. An interval gives its symbol a value; any other one becomes a
    /// fact. In a limit, all that mention its variable are listed.
    pub hypotheses: Vec<usize>,
    /// The functions that rise or fall from 0 on.
    pub rises: Vec<Rise>,
    /// The pairs a ≥ b whose roundings are compared, as the variables of the errors of a and b. The fact is
    /// fl(a) ≥ fl(b).
    pub orders: Vec<[usize; 2]>,
    /// The reasons for the signs, in the order in which they are needed.
    pub signs: Vec<Reason>,
    /// The factors of each divisor. Their product is the numerator of the divisor, and each has a strict sign.
    pub divisors: Vec<Vec<Polynomial>>,
    /// For each rounded formula, in the order in which they are met, an earlier one with the same error.
    pub roundings: Vec<Option<Same>>,
    /// The translations of the absolute values in the order in which they are met.
    pub sizes: Vec<AbsoluteValue>,
}

/// A polynomial whose sign is needed.
#[derive(Clone, Copy, Debug)]
pub(in crate::proof) struct Question<'q> {
    /// The polynomial.
    pub of: &'q Polynomial,
    /// The facts over which it is the numerator of a sum of formulas; none for any other polynomial.
    pub den: &'q [usize],
    /// Whether it is the numerator of a sum of formulas.
    pub is_sum: bool,
    /// Whether it decides between the branches of a minimum or positive part.
    pub decides: bool,
}

/// The source of what a leaf uses: a proof, or a search for one. Formulas are given by their numbers.
pub(in crate::proof) trait Source {
    /// Returns the reason for the sign of a polynomial.
    fn sign(&mut self, question: Question, state: &State) -> Option<Reason>;
    /// Returns the factors of a divisor with this numerator.
    fn divisor(&mut self, of: usize, value: &Polynomial, state: &State) -> Option<Vec<Polynomial>>;
    /// Returns the earlier formula whose error a rounded formula has, if there is one.
    fn rounding(&mut self, of: usize, value: &Quotient, state: &State) -> Option<Option<Same>>;
    /// Returns the translation of the absolute value of a formula.
    fn size(&mut self, of: usize, value: &Quotient, state: &State) -> Option<AbsoluteValue>;
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
    /// The proof lists too little.
    Missing,
    /// The proof lists more than it uses.
    Unused,
    /// A number is not that of a fact, variable, formula or hypothesis.
    Unknown,
    /// The two sides of a certificate differ, or a fact is about another quantity.
    Identity,
    /// The sign of a form does not follow from its terms.
    Form,
    /// The sign of a divisor, or of the left side of a certificate, is not strict.
    NotStrict,
    /// The sums of exponents differ.
    Exponents,
    /// The product of the factors is not the divisor.
    Divisor,
    /// A rounded formula is not a power of two times the other.
    Rounding,
    /// An absolute value is not that of an earlier formula.
    Size,
    /// The order of two rounded formulas is not known.
    Order,
    /// The mean value theorem does not apply.
    Rise,
    /// The formula contains an operation that is not differentiable.
    NotDifferentiable,
    /// The limit does not follow from the degrees, or a hypothesis does not hold for all large values.
    Limit,
    /// The sign is not the one to be proved.
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
        let problem = Problem::new(&goal.proposition, statement.hypotheses_for(goal.role));
        let checked = problem.and_then(|problem| check_node(&problem, &mut Vec::new(), node));
        checked.map_err(|reason| CheckError::Goal(i, reason))?;
    }
    Ok(Proof { statement: statement.clone(), goals: goals.into() })
}

/// Checks a proof under the assumptions of cases.
fn check_node(problem: &Problem, cases: &mut Vec<(Polynomial, Sign)>, node: &Node) -> Checked<()> {
    match node {
        Node::Cases(on, both) => {
            if !on.has_only(|x| x < problem.table.atoms().len()) {
                return Err(Refusal::Unknown);
            }
            if cases.len() >= MAX_NESTING as usize {
                return Err(Refusal::TooLarge);
            }
            for (node, sign) in both.iter().zip([Sign::Positive, Sign::NonPositive]) {
                cases.push((on.clone(), sign));
                check_node(problem, cases, node)?;
                cases.pop();
            }
            Ok(())
        }
        Node::Leaf(leaf) => {
            let mut translator = Translator::new(problem, List::of(leaf));
            translator.leaf(leaf, cases)?;
            if translator.source.is_empty() { Ok(()) } else { Err(Refusal::Unused) }
        }
    }
}

/// The rest of the lists of a leaf.
#[derive(Default)]
pub(in crate::proof) struct List<'a> {
    signs: Iter<'a, Reason>,
    divisors: Iter<'a, Vec<Polynomial>>,
    roundings: Iter<'a, Option<Same>>,
    sizes: Iter<'a, AbsoluteValue>,
}

impl<'a> List<'a> {
    /// Returns the lists of a leaf.
    pub(in crate::proof) fn of(leaf: &'a Leaf) -> Self {
        let Leaf { signs, divisors, roundings, sizes, .. } = leaf;
        let (signs, divisors) = (signs.iter(), divisors.iter());
        List { signs, divisors, roundings: roundings.iter(), sizes: sizes.iter() }
    }

    fn is_empty(&self) -> bool {
        self.signs.len() + self.divisors.len() + self.roundings.len() + self.sizes.len() == 0
    }
}

impl Source for List<'_> {
    fn sign(&mut self, _: Question, _: &State) -> Option<Reason> {
        self.signs.next().cloned()
    }

    fn divisor(&mut self, _: usize, _: &Polynomial, _: &State) -> Option<Vec<Polynomial>> {
        self.divisors.next().cloned()
    }

    fn rounding(&mut self, _: usize, _: &Quotient, _: &State) -> Option<Option<Same>> {
        self.roundings.next().cloned()
    }

    fn size(&mut self, _: usize, _: &Quotient, _: &State) -> Option<AbsoluteValue> {
        self.sizes.next().copied()
    }
}

impl<S: Source> Translator<'_, S> {
    /// Checks the goal under the assumptions of cases.
    pub(in crate::proof) fn leaf(&mut self, leaf: &Leaf, cases: &[(Polynomial, Sign)]) -> Checked<()> {
        self.assume_cases(cases);
        leaf.hypotheses.iter().try_for_each(|i| self.assume(*i))?;
        self.conclude(leaf, cases)
    }

    /// Uses the assumptions of cases.
    pub(in crate::proof) fn assume_cases(&mut self, cases: &[(Polynomial, Sign)]) {
        for (case, sign) in cases {
            let fact = self.state.add_fact(case.clone(), *sign);
            self.state.assumed.push((None, fact));
        }
    }

    /// Checks the goal after the hypotheses.
    pub(in crate::proof) fn conclude(&mut self, leaf: &Leaf, cases: &[(Polynomial, Sign)]) -> Checked<()> {
        leaf.rises.iter().try_for_each(|rise| self.rise(rise))?;
        leaf.orders.iter().try_for_each(|errors| self.monotone(*errors))?;
        match self.state.problem.proposition {
            Proposition::Limit(of, by, to) => self.limit(of, by, to, cases),
            proposition => self.goal(proposition),
        }
    }

    /// Checks a goal that is not a limit.
    fn goal(&mut self, proposition: &Proposition) -> Checked<()> {
        let holds = match (proposition, &self.state.problem.goal[..]) {
            (Proposition::Equal(..), [a, b]) => self.sign_of_sum(&[(1, *a), (-1, *b)], false)? == Sign::Zero,
            (Proposition::Sign(relation, _), [of, ..]) => {
                self.sign_of_sum(&[(1, *of)], false)?.implies((*relation).into())
            }
            (Proposition::Within(..), [of, bound]) => {
                self.sign_of_sum(&[(1, *bound), (-1, *of)], false)?.implies(Sign::NonNegative)
                    && self.sign_of_sum(&[(1, *bound), (1, *of)], false)?.implies(Sign::NonNegative)
            }
            (Proposition::Derivative(..), [of, is, derivative]) => {
                self.value(*of)?;
                self.sign_of_sum(&[(1, *derivative), (-1, *is)], false)? == Sign::Zero
            }
            _ => false,
        };
        if holds { Ok(()) } else { Err(Refusal::Goal) }
    }

    /// Checks the sign of a function by those of its start and its slope.
    fn rise(&mut self, rise: &Rise) -> Checked<()> {
        let problem = self.state.problem;
        let x = match problem.table.atoms().get(rise.x) {
            Some(Atom::Own(name)) if *name != PRECISION && !SCALES.contains(name) => *name,
            _ => return Err(Refusal::Rise),
        };
        for ((proposition, assumed), node) in parts_of_rise(problem, rise, x)?.iter().zip(&rise.parts) {
            let others = problem.hypotheses.iter().copied();
            let others = others.filter(|h| !h.value.symbols().contains(x)).chain(assumed);
            let part = Problem::new(proposition, others.collect())?.within(problem)?;
            check_node(&part, &mut Vec::new(), node)?;
        }
        let at_x = self.state.signs.get(rise.x).copied().flatten();
        let at_x = at_x.filter(|sign| sign.implies(Sign::NonNegative)).ok_or(Refusal::Rise)?;
        let sign = Sign::from(rise.start).plus(at_x.times(rise.slope.into())).ok_or(Refusal::Rise)?;
        self.state.add_fact(rise.of.clone(), sign);
        Ok(())
    }
}

/// Returns the propositions that the parts of a rise prove, each with an assumption about x.
pub(in crate::proof) fn parts_of_rise(
    problem: &Problem,
    rise: &Rise,
    x: &'static str,
) -> Checked<[(Proposition, Option<Hypothesis>); 3]> {
    let of = problem.table.to_tree(&rise.of)?;
    let slope = derivative(&of, x)?;
    let start = of.substitute(&[(x, Tree::from(0))]);
    check_size([&of, &slope, &start].into_iter()).map_err(|_| Refusal::TooLarge)?;
    let assumed = |relation| Some(Hypothesis::new(relation, Tree::symbol(x)));
    Ok([
        (Proposition::Derivative(of, x, slope.clone()), assumed(Relation::NonNegative)),
        (Proposition::Sign(rise.start, start), None),
        (Proposition::Sign(rise.slope, slope), assumed(Relation::Positive)),
    ])
}
