//! The search for proofs.
//!
//! Before the checker translates a formula, the [search for a leaf](leaf) lists the steps that this requires. Signs are
//! found by [rules](rules), and expressed by the symbols of the statement as identities that the
//! [checker](super::check) expands. Nothing here is trusted.
//!
//! A hypothesis v > 0 that does not follow from others, and is more than the sign of a symbol, becomes v = s for
//! a new symbol s > 0, the *slack variable*: one monomial of v, the *pivot*, is replaced wherever it occurs by
//! the value that this equation gives it. (For a b − c (x − y) > 0: a b by s + c (x − y); or x by
//! (a b + c y − s)/c, where c ≠ 0 is known.) Where no pivot is found, v may be divided by a positive symbol: for
//! k > 0, the hypothesis 1 − k > 0 is (1 − k)/k = s > 0, and k is 1/(1 + s). A hypothesis h > 0 without a pivot
//! is retained: where no rule finds the sign of v, the rules may find those of m and of v − m h, for a quotient m
//! that makes a symbol cancel; so are the laws of exponentials. The checker itself replaces a symbol in an interval,
//! before what mentions the symbol.
//!
//! If the sign that decides a branch is not found, both cases of its quantity are proved. For an absolute value
//! |x| no cases are needed at first: x is replaced by t |x| for some −1 ≤ t ≤ 1.

pub(in crate::proof) mod algebra;
pub(in crate::proof) mod assumption;
pub(in crate::proof) mod choice;
pub(in crate::proof) mod context;
mod dictionary;
mod equation;
pub(in crate::proof) mod error;
mod finder;
mod form;
mod leaf;
mod limit;
pub(in crate::proof) mod rules;
pub(in crate::proof) mod symbol;
#[cfg(test)]
mod tests;

pub use self::error::{ProofError, Quantity};

use super::check::{self, Node, Polynomial, Premise, Proof, Sequent, Sign, check};
use super::effort::MAX_EFFORT;
use crate::formula::Hypothesis;
use crate::formula::statement::{Proposition, Statement};
use crate::number::Tree;
use algebra::Ratio;
use dictionary::{integral, polynomial};
use leaf::Search;

/// Maximum number of nested case distinctions.
const MAX_NESTED_CASES: usize = 4;

/// Proves a statement.
///
/// # Errors
/// Returns the reason if no proof is found, which does not refute the statement; returns
/// [`ProofError::TooLarge`] if the statement exceeds [`MAX_SIZE`](super::MAX_SIZE) or
/// [`MAX_DEPTH`](super::MAX_DEPTH), or the search exceeds [`MAX_EFFORT`].
///
/// # Examples
/// ```
/// use provable::formula::claim::positive;
/// use provable::{number::Tree, proof::prove};
/// let x = Tree::symbol("x");
/// assert!(prove(&positive("square", &x * &x + Tree::from(1))).is_ok());
/// assert!(prove(&positive("square", &x * &x - Tree::from(1))).is_err());
/// ```
pub fn prove(statement: &Statement) -> Result<Proof, ProofError> {
    check::check_premises(statement)?;
    let goals = statement.goals().iter();
    let goals = goals.map(|goal| solve(&goal.proposition, statement.hypotheses_for(goal.role)));
    let goals = goals.collect::<Result<Vec<_>, _>>()?;
    check(statement, &goals).map_err(|_| ProofError::NotExpressed("the checker refuses it"))
}

/// Returns a proof of a proposition from hypotheses, which the checker has not read.
///
/// # Errors
/// Returns the reason if there is none; see [`prove`].
pub(in crate::proof) fn prove_proposition(
    proposition: &Proposition,
    hypotheses: Vec<&Hypothesis>,
) -> Result<Node, ProofError> {
    let trees: Vec<&Tree> = hypotheses.iter().map(|h| &h.value).chain(proposition.trees()).collect();
    check::check_size(trees.iter().copied())?;
    if proposition.variable().is_some() && trees.into_iter().any(Tree::contains_rounding) {
        return Err(Premise::Discontinuous.into());
    }
    solve(proposition, hypotheses)
}

fn solve(proposition: &Proposition, hypotheses: Vec<&Hypothesis>) -> Result<Node, ProofError> {
    let sequent = Sequent::new(proposition, hypotheses)?;
    certify(&sequent, &[]).map_err(|reason| {
        if sequent.effort.is_exceeded() { ProofError::TooLarge(MAX_EFFORT) } else { reason }
    })
}

/// The case that a quantity has a sign.
#[derive(Clone, Debug)]
pub struct Case {
    /// The number of hypotheses before it.
    at: usize,
    /// The quantity.
    on: Polynomial,
    /// The sign.
    sign: Sign,
}

/// Returns a proof in nested cases.
fn certify(sequent: &Sequent, cases: &[Case]) -> Result<Node, ProofError> {
    let mut search = Search::new(sequent, cases)?;
    let Err(failure) = search.read(cases) else { return Ok(Node::Leaf(search.proof.steps)) };
    let found = match &failure {
        ProofError::UndecidedBranch(of) => both_cases(&search, cases, search.position, &of.value),
        _ => Err(failure),
    };
    // An absolute value that does not suffice is replaced by cases.
    search.sizes.iter().rev().fold(found, |found, (at, twice)| {
        found.or_else(|reason| both_cases(&search, cases, *at, twice).map_err(|_| reason))
    })
}

/// Returns a proof in the two cases of a quantity.
fn both_cases(search: &Search, cases: &[Case], at: usize, value: &Ratio) -> Result<Node, ProofError> {
    let known = &search.known;
    if cases.len() >= MAX_NESTED_CASES {
        return Err(ProofError::UndecidedBranch(known.quantity(value.clone())));
    }
    let original = known.original(&known.sign_numerator(value).into());
    let [on] = integral([original.num()]);
    let on = polynomial(&on).ok_or("the quantity of a case")?;
    let nodes = [Sign::POSITIVE, Sign::NON_POSITIVE].into_iter().map(|sign| {
        let case = Case { at, on: on.clone(), sign };
        certify(search.sequent(), &[cases, &[case]].concat())
    });
    let nodes = nodes.collect::<Result<Vec<_>, _>>()?;
    let both = <[Node; 2]>::try_from(nodes).map_err(|_| "both cases")?;
    Ok(Node::Cases(on, both.into()))
}

impl Search<'_> {
    /// Lists the steps to the goal.
    fn read(&mut self, cases: &[Case]) -> Result<(), ProofError> {
        let order = self.order();
        for (position, i) in order.iter().enumerate() {
            self.follow(position, cases);
            self.assume(*i).map_err(|reason| self.not_assumed(*i, reason))?;
        }
        self.follow(order.len(), cases);
        self.goal()
    }

    /// Returns the reason for which a hypothesis is not used. One on the variable of a limit is named, unless cases may
    /// still help.
    fn not_assumed(&self, i: usize, reason: ProofError) -> ProofError {
        match reason {
            ProofError::UndecidedBranch(_) | ProofError::NotExpressed(_) => reason,
            _ if !self.sequent().mentions_variable(i) => reason,
            _ => ProofError::EndingHypothesis(self.sequent().hypotheses[i].value.clone()),
        }
    }

    /// Returns the numbers of the hypotheses: intervals before what mentions their symbols, and those on the
    /// variable of a limit last.
    fn order(&self) -> Vec<usize> {
        let hypotheses = &self.sequent().hypotheses;
        let intervals = &self.sequent().intervals;
        let bounded: Vec<_> = intervals.iter().flatten().map(|(x, _)| *x).collect();
        let mut order: Vec<_> = (0..hypotheses.len()).collect();
        order.sort_by_key(|i| {
            let (symbols, own) = (hypotheses[*i].value.symbols(), intervals[*i].map(|(x, _)| x));
            let waits = bounded.iter().any(|x| symbols.contains(x) && own != Some(*x));
            (self.sequent().mentions_variable(*i), waits, waits && own.is_none())
        });
        order
    }
}
