//! The search for the steps of a leaf: whatever the translation of a formula requires is found, and listed.

use super::algebra::{Poly, Ratio};
use super::assumption::AssumedFact;
use super::context::Context;
use super::dictionary::{poly, polynomial};
use super::finder::{Finder, Result, Steps};
use super::{Case, ProofError};
use crate::formula::Relation;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::check::{Atom, Knowledge, Law, Polynomial, Quotient, Refusal, Sequent, Sign, Step};
use std::collections::VecDeque;
use std::iter;

/// A search for the steps of a leaf.
pub struct Search<'a> {
    /// The knowledge so far.
    pub known: Context,
    /// The steps so far.
    pub proof: Steps<'a>,
    /// The quantities whose absolute values were replaced, each after the number of hypotheses before it.
    pub sizes: Vec<(usize, Ratio)>,
    /// The number of hypotheses so far.
    pub position: usize,
    /// The exponentials that were met, each with its reciprocal, as variables.
    pub exponentials: Vec<[usize; 2]>,
    /// Their laws that may still be listed.
    laws: VecDeque<Law>,
    /// The absolute values that were met, as variables.
    met: Vec<usize>,
}

/// The use of the sign of a quantity.
#[derive(Clone, Copy, PartialEq)]
enum Use {
    /// It is a factor, or a part of a limit.
    Part,
    /// It decides between the branches of a minimum or positive part.
    Branch,
    /// It is to be proved that it has this sign.
    Goal(Sign),
}

impl<'a> Search<'a> {
    /// Returns a search under the assumptions of cases.
    pub fn new(sequent: &'a Sequent<'a>, cases: &[Case]) -> Result<Self> {
        let cases: Vec<_> = cases.iter().map(|case| (case.on.clone(), case.sign)).collect();
        let proof = Steps { state: Knowledge::new(sequent, &cases)?, steps: Vec::new() };
        let (sizes, position, exponentials, laws, met) = Default::default();
        Ok(Search { known: Context::new(sequent), proof, sizes, position, exponentials, laws, met })
    }

    pub fn sequent(&self) -> &'a Sequent<'a> {
        self.proof.state.sequent
    }

    /// Uses the assumptions of cases before a hypothesis.
    pub fn follow(&mut self, position: usize, cases: &[Case]) {
        self.position = position;
        // The first fact is 2 > 0.
        for (fact, case) in (1..).zip(cases).filter(|(_, case)| case.at == position) {
            self.known.assume(None, &poly(&case.on).into(), case.sign, AssumedFact::new(fact, Vec::new()));
        }
    }

    /// Assumes the hypothesis with a number.
    pub fn assume(&mut self, i: usize) -> Result<()> {
        let sequent = self.sequent();
        let hypothesis = sequent.hypotheses[i];
        if let Some((_, ends)) = sequent.intervals[i] {
            ends.into_iter().try_for_each(|end| self.value(end).map(|_| ()))?;
            self.proof.add(Step::Assume(i))?;
            return Ok(());
        }
        let of = self.value(sequent.values[i])?;
        if sequent.mentions_variable(i) {
            self.show_leading(&of)?;
        }
        let fact = self.proof.add(Step::Assume(i))?;
        let value = self.known.ratio(&of, &self.proof.state);
        let fact = AssumedFact::new(fact, of.den);
        self.known.assume(Some(hypothesis), &value, hypothesis.relation.into(), fact);
        Ok(())
    }

    /// Shows the orders of the rounded formulas inside two formulas, operation by operation.
    fn orders(&mut self, a: usize, b: usize) -> Result<()> {
        use Op::*;
        let table = &self.sequent().table;
        match (table.op(a)?, table.op(b)?) {
            (Rounded(c), Rounded(d)) => {
                self.orders(c, d)?;
                // fl(a) ≥ fl(b) follows from a ≥ b.
                let difference = self.difference(c, d)?;
                self.show(&difference, Use::Goal(Sign::NON_NEGATIVE))?;
                [a, b].into_iter().try_for_each(|of| self.value(of).map(|_| ()))?;
                let fact = self.proof.add(Step::Law(Law::Order([a, b])))?;
                self.known.retain(fact, self.proof.state.facts.get(fact)?, Poly::constant(1));
                Ok(())
            }
            (PositivePart(a), PositivePart(b)) => self.orders(a, b),
            (Neg(a), Neg(b)) => self.orders(b, a),
            (Add(a, c), Add(b, d)) | (Min(a, c), Min(b, d)) => {
                self.orders(a, b)?;
                self.orders(c, d)
            }
            (Sub(a, c), Sub(b, d)) => {
                self.orders(a, b)?;
                self.orders(d, c)
            }
            (Mul(f, a), Mul(g, b)) | (Mul(a, f), Mul(b, g)) | (Div(a, f), Div(b, g)) if f == g => {
                self.orders(a, b)
            }
            _ => Ok(()),
        }
    }

    /// Shows the goal.
    pub fn goal(&mut self) -> Result<()> {
        let Sequent { proposition, goal, table, .. } = self.sequent();
        if let Proposition::Sign(Relation::NonNegative, _) = proposition
            && let Op::Sub(a, b) = table.op(goal[0])?
            && let (Op::Rounded(_), Op::Rounded(_)) = (table.op(a)?, table.op(b)?)
        {
            self.orders(a, b)?;
        }
        // A bound is shorter than what it bounds.
        goal.iter().rev().try_for_each(|of| self.value(*of).map(|_| ()))?;
        if let Proposition::Limit(..) = proposition {
            let of = self.value(goal[0])?;
            return self.limit(&of).map_err(|reason| self.no_limit(reason, &of));
        }
        for (of, sign) in self.proof.state.goals()? {
            self.show(&of, Use::Goal(sign))?;
            if !self.proof.state.facts.have(&of, sign) {
                let value = self.known.reduced_quotient(&of, &self.proof.state);
                let found = self.known.sign(value.clone()).ok_or(Refusal::Goal)?;
                return Err(ProofError::WrongSign(self.known.quantity(value), found.sign()));
            }
        }
        Ok(())
    }

    /// Returns the reason for which the limit of a quantity is not shown.
    fn no_limit(&self, reason: ProofError, of: &Quotient) -> ProofError {
        match reason {
            ProofError::UnknownSign(_) | ProofError::Refused(Refusal::Limit) => {
                let value = self.known.reduced_quotient(of, &self.proof.state);
                ProofError::UnknownLimit(self.known.quantity(value))
            }
            reason => reason,
        }
    }

    /// Returns a − b.
    fn difference(&mut self, a: usize, b: usize) -> Result<Quotient> {
        let (a, b) = (self.value(a)?, self.value(b)?);
        Ok(self.proof.state.facts.sum(&a, -1, &b)?)
    }

    /// Returns the value of a formula, after the steps that its translation requires.
    pub fn value(&mut self, formula: usize) -> Result<Quotient> {
        if !self.proof.state.values.contains_key(&formula) {
            let op = self.sequent().table.op(formula)?;
            op.operands().try_for_each(|operand| self.value(*operand).map(|_| ()))?;
            match op {
                Op::Div(_, by) => self.divisor(by)?,
                Op::PositivePart(of) => {
                    let deciding = self.value(of)?;
                    self.show(&deciding, Use::Branch)?;
                }
                Op::Min(a, b) if self.sequent().table.op(a) == Ok(Op::Neg(b)) => self.absolute_value(b)?,
                Op::Min(a, b) => {
                    let deciding = self.difference(b, a)?;
                    self.show(&deciding, Use::Branch)?;
                }
                Op::Exp(of) => self.exponential(of)?,
                Op::Rounded(_) => self.precision()?,
                _ => {}
            }
        }
        Ok(self.proof.state.value(formula)?)
    }

    /// Shows that a polynomial is not 0, and returns the number of the fact.
    pub fn strict(&mut self, of: &Polynomial) -> Result<usize> {
        self.show_part(of)?;
        Ok(self.proof.state.facts.strict(of).ok_or(Refusal::NotStrict)?)
    }

    /// Shows the sign of a polynomial.
    pub fn show_part(&mut self, of: &Polynomial) -> Result<()> {
        self.show(&of.clone().into(), Use::Part)
    }

    /// Shows the sign of a quantity by a certificate for its numerator, unless a fact states it. A weak sign that is known
    /// is replaced by a definite one if that is found.
    fn show(&mut self, of: &Quotient, usage: Use) -> Result<()> {
        let facts = self.proof.state.facts.all.iter().filter(|(known, _)| *known == of.num);
        let known: Vec<_> = facts.map(|(_, sign)| *sign).collect();
        if of.num.is_zero() || known.iter().any(|sign| is_definite(*sign)) {
            return Ok(());
        }
        // The numerator is shorter than the quotient, but its sign may be found by the other's alone.
        let signed = self.known.direct_sign(self.known.reduced(&of.num)).filter(|signed| {
            let may_be_weak = matches!(usage, Use::Branch | Use::Goal(Sign::NON_NEGATIVE));
            is_definite(signed.sign()) || known.is_empty() && may_be_weak
        });
        if let Some(signed) = signed {
            return Finder::show(&self.known, &of.num, &[], &signed, &mut self.proof);
        }
        if !known.is_empty() {
            return Ok(());
        }
        let value = self.known.reduced_quotient(of, &self.proof.state);
        let signed = self.known.sign(value.clone());
        let is_unequal = usage == Use::Goal(Sign::ZERO) && !value.is_zero();
        if (is_unequal || signed.is_none()) && self.list_law()? {
            return self.show(of, usage);
        }
        match signed {
            _ if is_unequal => Err(ProofError::Unequal(self.known.quantity(value))),
            Some(signed) => Finder::show(&self.known, &of.num, &of.den, &signed, &mut self.proof),
            None if usage == Use::Branch => Err(ProofError::UndecidedBranch(self.known.quantity(value))),
            None => Err(ProofError::UnknownSign(self.known.quantity(value))),
        }
    }

    /// Lists the next law of exponentials that applies. Returns `false` if all are listed already.
    fn list_law(&mut self) -> Result<bool> {
        while let Some(law) = self.laws.pop_front() {
            let bounded = match law {
                Law::AboveTangent(x) | Law::BelowPole(x) => Some(x),
                _ => None,
            };
            if let Some(x) = bounded {
                let exponent = self.proof.state.exponent(x)?;
                let value = self.known.reduced_quotient(&exponent, &self.proof.state);
                if self.known.sign(value).is_some() {
                    self.show(&exponent, Use::Part)?;
                }
            }
            let Ok(number) = self.proof.add(Step::Law(law)) else { continue };
            let fact = self.proof.state.facts.get(number)?;
            match bounded.and_then(|x| self.exponentials.iter().find(|[of, _]| *of == x)) {
                None => self.known.equate(number, &fact.0),
                Some([_, reciprocal]) => {
                    // Its product with the reciprocal bounds that one.
                    self.known.retain(number, fact, Poly::constant(1));
                    self.known.retain(number, fact, Poly::variable(*reciprocal));
                }
            }
            return Ok(true);
        }
        Ok(false)
    }

    /// Shows that the value of a formula is not 0.
    fn divisor(&mut self, formula: usize) -> Result<()> {
        let of = self.proof.state.value(formula)?;
        if self.proof.state.inverse(&of).is_ok() {
            return Ok(());
        }
        let tree = self.sequent().table.formula(formula)?.clone();
        self.factors(&of.num).map_err(|reason| self.zero_divisor(reason, &of, tree))
    }

    /// Returns the reason for which a divisor may be 0.
    fn zero_divisor(&self, reason: ProofError, of: &Quotient, formula: Tree) -> ProofError {
        match reason {
            ProofError::UnknownSign(_) | ProofError::Refused(Refusal::NotStrict) => {
                let value = self.known.reduced_quotient(of, &self.proof.state);
                ProofError::PossibleZeroDivisor(formula, self.known.quantity(value))
            }
            reason => reason,
        }
    }

    /// Shows that the factors of a polynomial are not 0: symbols, errors 2ᵖ + 1 + e, and the rest.
    fn factors(&mut self, of: &Polynomial) -> Result<()> {
        if of.is_zero() {
            return Err(Refusal::NotStrict.into());
        }
        let mut rest = poly(of);
        let mut candidates: Vec<Poly> =
            rest.common_monomial().powers().map(|(x, _)| Poly::variable(x)).collect();
        candidates.extend(self.known.largest_errors(&rest));
        let mut factors = Vec::new();
        for factor in candidates {
            while let Some(quotient) = rest.checked_div(&factor) {
                rest = quotient;
                factors.push(factor.clone());
            }
        }
        if !rest.is_one() {
            factors.push(rest);
        }
        let mut numbers = Vec::with_capacity(factors.len());
        for factor in &factors {
            numbers.push(self.strict(&polynomial(factor).ok_or("a divisor")?)?);
        }
        if numbers.len() != 1 {
            self.proof.add(Step::Divisor(numbers))?;
        }
        Ok(())
    }

    /// Shows that 2ᵖ + 1 is not 0.
    fn precision(&mut self) -> Result<()> {
        let largest = polynomial(&self.known.largest).ok_or("a precision")?;
        let formula = Tree::symbol(PRECISION) + Tree::from(1);
        self.strict(&largest).map_err(|reason| self.zero_divisor(reason, &largest.into(), formula))?;
        Ok(())
    }

    /// Adds the laws of an exponential and its reciprocal to those that may be listed.
    fn exponential(&mut self, exponent: usize) -> Result<()> {
        let table = &self.sequent().table;
        let mut ops = (0..).map_while(|of| table.op(of).ok());
        let reciprocal = ops.position(|op| op == Op::Neg(exponent)).ok_or(Refusal::Unknown)?;
        let pair = [exponent, reciprocal].map(|of| table.variable(Atom::Exponential(of)));
        let [x, y] = [pair[0]?, pair[1]?];
        if self.exponentials.iter().any(|[of, _]| *of == x) {
            return Ok(());
        }
        self.exponentials.extend([[x, y], [y, x]]);
        let all = self.exponentials.iter().map(|[z, _]| *z);
        for x in [x, y] {
            let pairs = all.clone().take_while(|z| *z != x).map(|z| vec![z, x]);
            for left in iter::once(vec![x]).chain(pairs) {
                let others = all.clone().filter(|z| !left.contains(z)).map(|z| vec![z]);
                let laws = iter::once(Vec::new()).chain(others);
                self.laws.extend(laws.map(|right| Law::Exponents { left: left.clone(), right }));
            }
        }
        for x in [x, y] {
            self.laws.extend([Law::AboveTangent(x), Law::BelowPole(x)]);
        }
        Ok(())
    }

    /// Shows what the absolute value of a formula is: an atom, or the formula with a sign.
    fn absolute_value(&mut self, of: usize) -> Result<()> {
        let table = &self.sequent().table;
        let (size, factor) = (table.variable(Atom::Size(of))?, table.variable(Atom::Factor(of))?);
        if self.met.contains(&size) {
            return Ok(());
        }
        let quotient = self.proof.state.value(of)?;
        let value = self.known.reduced_quotient(&quotient, &self.proof.state);
        let next = self.proof.state.facts.all.len();
        let is_free = self.known.sign(value.clone()).is_none();
        let law = if is_free && self.known.assume_size([size, factor], &value, next) {
            self.sizes.push((self.position, value));
            Law::AbsoluteValue(of)
        } else {
            self.show(&quotient, Use::Branch)?;
            Law::Signed(of)
        };
        let fact = self.proof.add(Step::Law(law))?;
        self.met.push(size);
        self.known.equate(fact, &self.proof.state.facts.get(fact)?.0);
        Ok(())
    }
}

/// Returns `true` if no other sign implies this one.
fn is_definite(sign: Sign) -> bool {
    sign.is_strict() || sign == Sign::ZERO
}
