//! Certificates for what the kernel proves.
//!
//! The kernel finds signs by six rules, for quantities in which pivots are replaced by slack variables. Here
//! each of its derivations is expressed by the original symbols, as identities that the
//! [checker](super::check) expands. Nothing here is trusted.

mod dictionary;
mod equation;
mod finder;
mod form;
mod leaf;

use super::check::{CheckError, Node, Polynomial, Problem, Refusal, check};
use super::kernel::algebra::Poly;
use super::kernel::context::Context;
use super::kernel::sign::Sign;
use super::kernel::{self, MAX_EFFORT, MAX_NESTED_CASES, ProofError, effort};
use crate::formula::Hypothesis;
use crate::formula::statement::{Goal, Statement};
use dictionary::{Dictionary, integral};
use std::fmt;

/// The reason why no certificates were found.
#[derive(Clone, Debug)]
pub enum CertifyError {
    /// The kernel finds no proof.
    NoProof(ProofError),
    /// A derivation of the kernel could not be expressed by certificates, for this reason.
    NotExpressed(&'static str),
    /// The checker refuses the certificates.
    Refused(CheckError),
    /// The checker refuses a leaf for this reason, whatever the certificates.
    Leaf(Refusal),
}

/// Maximum number of terms that the search for certificates of one goal processes.
const EFFORT: usize = 10 * MAX_EFFORT;

type Certified<T> = Result<T, CertifyError>;

impl fmt::Display for CertifyError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            CertifyError::NoProof(reason) => write!(f, "{reason}"),
            CertifyError::NotExpressed(reason) => write!(f, "no certificates: {reason}"),
            CertifyError::Refused(reason) => write!(f, "the certificates are refused: {reason}"),
            CertifyError::Leaf(reason) => write!(f, "a leaf is refused: {reason:?}"),
        }
    }
}

impl std::error::Error for CertifyError {}

/// Returns a proof of each goal of a statement that the checker accepts.
///
/// # Errors
/// Returns the reason if there is none; the statement may still be proved by [`prove`](super::prove).
///
/// # Examples
/// ```
/// use provable::formula::claim::positive;
/// use provable::{number::Tree, proof::{certify, check}};
/// let x = Tree::symbol("x");
/// let statement = positive("square", &x * &x + Tree::from(1));
/// let proof = certify::certify(&statement).unwrap();
/// assert!(check::check(&statement, &proof).is_ok());
/// ```
pub fn certify(statement: &Statement) -> Result<Vec<Node>, CertifyError> {
    let roundings = kernel::check_premises(statement).map_err(CertifyError::NoProof)?;
    let context = Context::of(roundings);
    let too_large = || CertifyError::NoProof(ProofError::TooLarge("its proof", EFFORT));
    let certify_goal = |goal: &Goal| {
        let problem = Problem::new(&goal.proposition, statement.hypotheses_for(goal.role));
        let problem = problem.map_err(|_| CertifyError::NotExpressed("too many atoms"))?;
        let context = context.clone().with_variable(&goal.proposition);
        let attempt = Attempt { problem: &problem, goal, cases: Vec::new() };
        effort::bounded_by(EFFORT, || attempt.certify(context, &problem.hypotheses)).ok_or_else(too_large)?
    };
    let goals: Vec<_> = statement.goals().iter().map(certify_goal).collect::<Certified<_>>()?;
    check(statement, &goals).map_err(CertifyError::Refused)?;
    Ok(goals)
}

/// An attempt to certify a goal in some cases.
#[derive(Clone)]
struct Attempt<'a> {
    problem: &'a Problem<'a>,
    goal: &'a Goal,
    /// The quantities that distinguish the cases, in own symbols.
    cases: Vec<(Poly, Sign)>,
}

impl Attempt<'_> {
    /// Returns a proof from a context, to which these hypotheses are still to be added.
    fn certify(&self, mut context: Context, mut hypotheses: &[&Hypothesis]) -> Certified<Node> {
        let undecided = match context.assume_and_derive(self.goal, &mut hypotheses) {
            Ok(direct) => return Ok(Node::Leaf(self.leaf(&context, direct)?.into())),
            Err(ProofError::UndecidedSize(of, twice)) => {
                let mut sized = context.clone();
                if sized.assume_size(&of, &twice)
                    && let Ok(node) = self.certify(sized, hypotheses)
                {
                    return Ok(node);
                }
                twice
            }
            Err(ProofError::UndecidedBranch(value)) => value,
            Err(reason) => return Err(CertifyError::NoProof(reason)),
        };
        if self.cases.len() >= MAX_NESTED_CASES as usize {
            return Err(CertifyError::NoProof(ProofError::UndecidedBranch(undecided)));
        }
        self.cases(&context, hypotheses, &context.sign_numerator(&undecided))
    }

    fn cases(&self, context: &Context, hypotheses: &[&Hypothesis], deciding: &Poly) -> Certified<Node> {
        let dictionary = self.dictionary(context)?;
        let own = dictionary.own(&deciding.clone().into());
        let (own, _) = integral(own.num(), own.num());
        let mut nodes = Vec::new();
        for sign in [Sign::Positive, Sign::NonPositive] {
            let (mut context, mut case) = (context.clone(), self.clone());
            context.assume_sign(None, deciding.clone().into(), sign);
            case.cases.push((own.clone(), sign));
            nodes.push(case.certify(context, hypotheses)?);
        }
        let both = <[Node; 2]>::try_from(nodes).map_err(|_| CertifyError::NotExpressed("two cases"))?;
        Ok(Node::Cases(self.case(&own, &dictionary)?, both.into()))
    }

    /// Returns a quantity that distinguishes cases.
    fn case(&self, own: &Poly, dictionary: &Dictionary) -> Certified<Polynomial> {
        let state = super::check::State::new(self.problem);
        let polynomial = dictionary.polynomial(own, 0, &state);
        polynomial.ok_or(CertifyError::NotExpressed("the quantity of a case"))
    }

    fn dictionary(&self, context: &Context) -> Certified<Dictionary> {
        Dictionary::of(context, self.problem).ok_or(CertifyError::NotExpressed("the symbols"))
    }
}

/// Returns a proof of a goal without cases, from hypotheses without roundings of their own.
fn certify_part(problem: &Problem, hypotheses: &[&Hypothesis]) -> Certified<Node> {
    let trees = hypotheses.iter().map(|given| &given.value).chain(problem.proposition.trees());
    let context = Context::of(kernel::roundings(trees));
    let goal = Goal::of_claim("", problem.proposition.clone());
    Attempt { problem, goal: &goal, cases: Vec::new() }.certify(context, hypotheses)
}
