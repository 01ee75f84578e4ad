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
mod knowledge;
mod leaf;
mod limit;
mod number;
pub(in crate::proof) mod rules;
pub(in crate::proof) mod symbol;
#[cfg(test)]
mod tests;

pub use self::error::{ProofError, Quantity};

use super::check::{self, Node, Polynomial, Premise, Problem, Proof, Refusal, Sign, Table, check};
use super::effort::{MAX_EFFORT, excess_size};
use crate::formula::statement::{Proposition, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;
use crate::number::tree::Op;
use algebra::{Poly, Ratio, UNKNOWN};
use dictionary::{integral, polynomial};
use leaf::Search;
use std::collections::BTreeSet;

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
    if let Some((quantity, most)) = excess_size(trees.iter().copied()) {
        return Err(Premise::TooLarge(quantity, most).into());
    }
    if proposition.variable().is_some() && trees.into_iter().any(Tree::contains_rounding) {
        return Err(Premise::Discontinuous.into());
    }
    solve(proposition, hypotheses)
}

fn solve(proposition: &Proposition, hypotheses: Vec<&Hypothesis>) -> Result<Node, ProofError> {
    let problem = Problem::new(proposition, hypotheses)?;
    let found = Attempt { problem: &problem }.certify(&[]);
    found.map_err(|reason| {
        let is_unknown = reason.quantity().is_some_and(|of| of.value.variables().contains(&UNKNOWN));
        if problem.effort.is_exceeded() || is_unknown { ProofError::TooLarge(MAX_EFFORT) } else { reason }
    })
}

/// A decision on the way to a leaf, before the hypothesis at a place in their order.
#[derive(Clone, Debug)]
pub enum Decision {
    /// The case of a quantity with this sign.
    Case {
        /// The number of hypotheses before it.
        at: usize,
        /// The quantity in the symbols that remain there.
        deciding: Poly,
        /// The quantity as a polynomial of the checker.
        on: Polynomial,
        /// The quotient of the two.
        scale: Ratio,
        /// The sign.
        sign: Sign,
    },
    /// The replacement of a formula by a multiple of its absolute value.
    Size {
        /// The number of hypotheses before it.
        at: usize,
        /// The formula.
        of: usize,
        /// Twice its value.
        twice: Ratio,
    },
}

/// An attempt to solve a problem.
struct Attempt<'a> {
    problem: &'a Problem<'a>,
}

impl<'a> Attempt<'a> {
    /// Returns a proof under the assumptions of these decisions.
    fn certify(&self, decisions: &[Decision]) -> Result<Node, ProofError> {
        let mut search = Search::new(self.problem, decisions)?;
        let failure = match self.read(&mut search, decisions) {
            Ok(()) => return Ok(Node::Leaf(search.proof.steps)),
            Err(failure) => self.explained(&search, failure),
        };
        let script = [decisions, &search.sizes].concat();
        let found = match &failure {
            ProofError::UndecidedBranch(of) => self.cases(&search, &script, search.position, &of.value),
            _ => Err(failure.clone()),
        };
        // An absolute value that does not suffice is replaced by cases.
        (0..search.sizes.len()).rev().fold(found, |found, i| {
            let Decision::Size { at, twice, .. } = &search.sizes[i] else { return found };
            found.or_else(|reason| {
                let script = &script[..decisions.len() + i];
                self.cases(&search, script, *at, twice).map_err(|_| reason)
            })
        })
    }

    /// Returns the reason for which a goal does not follow from the steps found.
    fn explained(&self, search: &Search, failure: ProofError) -> ProofError {
        let is_at_end = search.position == self.problem.hypotheses.len();
        let is_limit = self.problem.variable().is_some();
        let required = match failure {
            ProofError::UnknownSign(_) | ProofError::Refused(Refusal::Limit) if is_limit && is_at_end => {
                search.proof.state.clone().value(self.problem.goal[0]).ok()
            }
            ProofError::Refused(Refusal::Goal) => search.required.clone(),
            _ => None,
        };
        let Some(required) = required else { return failure };
        let value = search.known.reduced_quotient(&required, &search.proof.state);
        let quantity = search.known.quantity(value.clone());
        match search.known.sign(value) {
            _ if is_limit => ProofError::UnknownLimit(quantity),
            Some(signed) => ProofError::WrongSign(quantity, signed.sign()),
            None => failure,
        }
    }

    /// Returns a proof in the two cases of a quantity.
    fn cases(
        &self,
        search: &Search,
        script: &[Decision],
        at: usize,
        value: &Ratio,
    ) -> Result<Node, ProofError> {
        if script.iter().filter_map(case).count() >= MAX_NESTED_CASES {
            return Err(ProofError::UndecidedBranch(search.known.quantity(value.clone())));
        }
        let known = &search.known;
        let deciding = known.context.sign_numerator(value);
        let original = known.original(&deciding.clone().into());
        let (on, _) = integral(original.num(), original.num());
        let scale = original.checked_div(&on.clone().into()).ok_or("a case of nothing")?;
        let on = polynomial(&on).ok_or("the quantity of a case")?;
        let mut nodes = Vec::with_capacity(2);
        for sign in [Sign::Positive, Sign::NonPositive] {
            let (deciding, on, scale) = (deciding.clone(), on.clone(), scale.clone());
            let case = Decision::Case { at, deciding, on, scale, sign };
            nodes.push(self.certify(&[script, &[case]].concat())?);
        }
        let both = <[Node; 2]>::try_from(nodes).map_err(|_| "both cases")?;
        Ok(Node::Cases(on, both.into()))
    }

    /// Lists the steps to the goal.
    fn read(&self, search: &mut Search<'a>, decisions: &[Decision]) -> Result<(), ProofError> {
        let (order, mut read) = (self.order(), BTreeSet::new());
        for (position, i) in order.iter().enumerate() {
            search.follow(position, decisions);
            let interval = self.problem.hypotheses[*i].interval();
            if interval.is_none_or(|(x, ..)| read.insert(x)) {
                search.assume(*i).map_err(|reason| self.not_assumed(*i, reason))?;
            }
        }
        search.follow(order.len(), decisions);
        self.orders().into_iter().try_for_each(|[a, b]| search.order(a, b))?;
        search.goal()
    }

    /// Returns the reason for which a hypothesis is not used. One on the variable of a limit is named, unless cases may
    /// still help.
    fn not_assumed(&self, i: usize, reason: ProofError) -> ProofError {
        match reason {
            ProofError::UndecidedBranch(_) | ProofError::NotExpressed(_) => reason,
            _ if !self.problem.mentions_variable(i) => reason,
            _ => ProofError::EndingHypothesis(self.problem.hypotheses[i].value.clone()),
        }
    }

    /// Returns the numbers of the hypotheses: intervals before what mentions their symbols, and those on the
    /// variable of a limit last.
    fn order(&self) -> Vec<usize> {
        let hypotheses = &self.problem.hypotheses;
        let bounded: Vec<_> = hypotheses.iter().filter_map(|h| h.interval()).map(|(x, ..)| x).collect();
        let mut order: Vec<_> = (0..hypotheses.len()).collect();
        order.sort_by_key(|i| {
            let (hypothesis, symbols) = (hypotheses[*i], hypotheses[*i].value.symbols());
            let own = hypothesis.interval().map(|(x, ..)| x);
            let waits = bounded.iter().any(|x| symbols.contains(x) && own != Some(*x));
            (self.problem.mentions_variable(*i), waits, waits && own.is_none())
        });
        order
    }

    /// Returns the pairs of rounded formulas whose order the goal rests on.
    fn orders(&self) -> Vec<[usize; 2]> {
        let (table, mut pairs) = (&self.problem.table, Vec::new());
        if let Proposition::Sign(Relation::NonNegative, _) = self.problem.proposition
            && let Ok(Op::Sub(a, b)) = table.op(self.problem.goal[0])
            && let (Ok(Op::Rounded(_)), Ok(Op::Rounded(_))) = (table.op(a), table.op(b))
        {
            collect_orders(table, a, b, &mut pairs);
        }
        pairs
    }
}

/// Returns the quantity of a case, and its sign, if the decision is one.
fn case(decision: &Decision) -> Option<(Polynomial, Sign)> {
    if let Decision::Case { on, sign, .. } = decision { Some((on.clone(), *sign)) } else { None }
}

/// Collects pairs of formulas inside two others, operation by operation, whose roundings have an order.
fn collect_orders(table: &Table, a: usize, b: usize, all: &mut Vec<[usize; 2]>) {
    use Op::*;
    let (Ok(first), Ok(second)) = (table.op(a), table.op(b)) else { return };
    match (first, second) {
        _ if a == b => {}
        (Rounded(c), Rounded(d)) => {
            collect_orders(table, c, d, all);
            all.push([a, b]);
        }
        (PositivePart(a), PositivePart(b)) => collect_orders(table, a, b, all),
        (Neg(a), Neg(b)) => collect_orders(table, b, a, all),
        (Add(a, c), Add(b, d)) | (Min(a, c), Min(b, d)) => {
            collect_orders(table, a, b, all);
            collect_orders(table, c, d, all);
        }
        (Sub(a, c), Sub(b, d)) => {
            collect_orders(table, a, b, all);
            collect_orders(table, d, c, all);
        }
        (Mul(f, a), Mul(g, b)) | (Mul(a, f), Mul(b, g)) | (Div(a, f), Div(b, g)) if f == g => {
            collect_orders(table, a, b, all);
        }
        _ => {}
    }
}
