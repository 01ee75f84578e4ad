//! The search for the steps of a leaf: whatever the translation of a formula requires is found, and listed.

use super::ProofError;
use super::algebra::{Poly, Ratio};
use super::dictionary::{poly, polynomial};
use super::finder::{Finder, Result};
use super::knowledge::{AssumedFact, Knowledge};
use super::{Decision, case};
use crate::formula::Relation;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::check::{Atom, Law, Polynomial, Problem, Quotient, Refusal, Sign, State, Step};
use std::collections::VecDeque;
use std::iter;

/// The steps so far, and the knowledge of the checker after them.
pub struct Steps<'a> {
    pub state: State<'a>,
    pub steps: Vec<Step>,
}

/// A search for the steps of a leaf.
pub struct Search<'a> {
    /// The knowledge so far.
    pub known: Knowledge<'a>,
    /// The steps so far.
    pub proof: Steps<'a>,
    /// The absolute values that were replaced, each with the number of hypotheses before it.
    pub sizes: Vec<Decision>,
    /// The number of hypotheses so far.
    pub position: usize,
    /// The last quantity whose sign was required.
    pub required: Option<Quotient>,
    /// The exponentials that were met, as variables.
    pub exponentials: Vec<usize>,
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
    /// It is the goal, or the premise of an order.
    Goal,
}

impl Steps<'_> {
    /// Adds a step, and returns the number of the last fact.
    pub fn add(&mut self, step: Step) -> Result<usize> {
        self.state.apply(&step)?;
        self.steps.push(step);
        Ok(self.state.facts.iter().len() - 1)
    }
}

impl<'a> Search<'a> {
    /// Returns a search under the assumptions of decisions.
    pub fn new(problem: &'a Problem<'a>, decisions: &[Decision]) -> Result<Self> {
        let cases: Vec<_> = decisions.iter().filter_map(case).collect();
        let proof = Steps { state: State::new(problem, &cases)?, steps: Vec::new() };
        let (sizes, position, required) = Default::default();
        let (exponentials, laws, met) = Default::default();
        let known = Knowledge::new(problem);
        Ok(Search { known, proof, sizes, position, required, exponentials, laws, met })
    }

    pub fn problem(&self) -> &'a Problem<'a> {
        self.known.problem
    }

    /// Uses the assumptions of decisions before a hypothesis.
    pub fn follow(&mut self, position: usize, decisions: &[Decision]) {
        self.position = position;
        let mut cases = 0;
        for decision in decisions {
            match decision {
                Decision::Case { at, deciding, scale, sign, .. } => {
                    cases += 1;
                    if *at == position {
                        let is_negated = *sign == Sign::NonPositive;
                        let scale = if is_negated { -scale } else { scale.clone() };
                        // The first fact is 2 > 0.
                        let fact = AssumedFact { fact: cases, den: Vec::new(), scale };
                        self.known.assume_case(deciding, *sign, fact);
                    }
                }
                Decision::Size { at, of, twice } if *at == position => {
                    self.known.assume_size(*of, twice);
                }
                Decision::Size { .. } => {}
            }
        }
    }

    /// Assumes the hypothesis with a number.
    pub fn assume(&mut self, i: usize) -> Result<()> {
        let problem = self.problem();
        let hypothesis = problem.hypotheses[i];
        if let Some((_, ends)) = problem.intervals[i] {
            ends.into_iter().try_for_each(|end| self.value(end).map(|_| ()))?;
            self.proof.add(Step::Assume(i))?;
            return Ok(());
        }
        let of = self.value(problem.values[i])?;
        if problem.mentions_variable(i) {
            self.show_leading(&of)?;
        }
        let fact = self.proof.add(Step::Assume(i))?;
        let value = self.known.ratio(&of, &self.proof.state);
        let scale = Poly::constant(1).into();
        self.known.assume(hypothesis, value, AssumedFact { fact, den: of.den, scale });
        Ok(())
    }

    /// Shows that fl(a) ≥ fl(b), from a ≥ b, for the numbers of these two formulas.
    pub fn order(&mut self, a: usize, b: usize) -> Result<()> {
        let (x, y) = (self.inside(a)?, self.inside(b)?);
        self.show_sum(&[(1, x), (-1, y)], Use::Goal)?;
        [a, b].into_iter().try_for_each(|of| self.value(of).map(|_| ()))?;
        let fact = self.proof.add(Step::Law(Law::Order([a, b])))?;
        let (of, sign) = self.proof.state.facts.get(fact)?;
        self.known.retain(fact, of, *sign, Poly::constant(1));
        Ok(())
    }

    /// Returns the formula that a rounded formula rounds.
    fn inside(&self, rounded: usize) -> Result<usize> {
        match self.problem().table.op(rounded)? {
            Op::Rounded(of) => Ok(of),
            _ => Err(Refusal::Unknown.into()),
        }
    }

    /// Shows the goal.
    pub fn goal(&mut self) -> Result<()> {
        let problem = self.problem();
        problem.goal.iter().try_for_each(|of| self.value(*of).map(|_| ()))?;
        if problem.variable().is_some() {
            let of = self.value(problem.goal[0])?;
            self.limit(&of)?;
        }
        let goals = self.proof.state.goals()?;
        goals.iter().try_for_each(|(of, _)| self.show(of, Use::Goal))?;
        if self.proof.state.proves_goal()? { Ok(()) } else { Err(Refusal::Goal.into()) }
    }

    /// Returns the value of a formula, after the steps that its translation requires.
    pub fn value(&mut self, formula: usize) -> Result<Quotient> {
        if !self.proof.state.has_value(formula) {
            let op = self.problem().table.op(formula)?;
            op.operands().try_for_each(|operand| self.value(*operand).map(|_| ()))?;
            match op {
                Op::Div(_, by) => self.divisor(by)?,
                Op::PositivePart(of) => self.show_sum(&[(1, of)], Use::Branch)?,
                Op::Min(a, b) if self.problem().table.op(a) == Ok(Op::Neg(b)) => self.absolute_value(b)?,
                Op::Min(a, b) => self.show_sum(&[(1, b), (-1, a)], Use::Branch)?,
                Op::Exp(of) => self.exponential(of)?,
                Op::Rounded(_) => self.precision()?,
                _ => {}
            }
        }
        Ok(self.proof.state.value(formula)?)
    }

    /// Shows the sign of a sum of multiples of formulas.
    fn show_sum(&mut self, sum: &[(i128, usize)], usage: Use) -> Result<()> {
        let mut value = Quotient::from(Polynomial::zero());
        for (n, of) in sum {
            let of = self.value(*of)?;
            value = self.proof.state.facts.sum(&value, *n, &of)?;
        }
        self.show(&value, usage)
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

    /// Shows the sign of a quantity by a certificate for its numerator, unless a fact states it.
    fn show(&mut self, of: &Quotient, usage: Use) -> Result<()> {
        let fact = known_fact(&of.num, &self.proof.state);
        if of.num.is_zero() || fact.is_some_and(is_definite) {
            return Ok(());
        }
        self.required = Some(of.clone());
        // The numerator is shorter than the quotient, but its sign may be found by the other's alone.
        let direct = self.known.reduced(&of.num);
        let signed = self.known.context.sign(direct.clone());
        let signed = signed.filter(|signed| match fact {
            Some(_) => is_definite(signed.sign()),
            None => self.suffices(usage, signed.sign()),
        });
        if let Some(signed) = signed {
            return Finder::show(&self.known, &of.num, &[], &signed, &mut self.proof);
        }
        if fact.is_some() {
            return Ok(());
        }
        let value =
            if of.den.is_empty() { direct } else { self.known.reduced_quotient(of, &self.proof.state) };
        let signed = self.known.sign(value.clone());
        let requires_zero =
            matches!(self.problem().proposition, Proposition::Equal(..) | Proposition::Derivative(..));
        let is_unequal = requires_zero && usage == Use::Goal && !value.is_zero();
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

    /// Returns `true` if no other sign would prove more.
    fn suffices(&self, usage: Use, sign: Sign) -> bool {
        let is_weak = match self.problem().proposition {
            Proposition::Within(..) | Proposition::Sign(Relation::NonNegative, _) => usage != Use::Part,
            _ => usage == Use::Branch,
        };
        is_definite(sign) || is_weak
    }

    /// Lists the next law of exponentials that applies. Returns `false` if all are listed already.
    fn list_law(&mut self) -> Result<bool> {
        while let Some(law) = self.laws.pop_front() {
            let (x, is_bound) = match law {
                Law::AboveTangent(x) | Law::BelowPole(x) => (x, true),
                _ => (0, false),
            };
            if is_bound {
                let exponent = self.proof.state.exponent(x)?;
                let value = self.known.reduced_quotient(&exponent, &self.proof.state);
                if self.known.sign(value).is_some() {
                    self.show(&exponent, Use::Part)?;
                }
            }
            let Ok(fact) = self.proof.add(Step::Law(law)) else { continue };
            let (of, sign) = self.proof.state.facts.get(fact)?;
            match is_bound {
                false => self.known.equate(fact, of),
                true => {
                    // Its product with the reciprocal bounds that one.
                    let i = self.exponentials.iter().position(|y| *y == x).unwrap_or_default();
                    let reciprocal = Poly::variable(self.exponentials[i ^ 1]);
                    self.known.retain(fact, of, *sign, Poly::constant(1));
                    self.known.retain(fact, of, *sign, reciprocal);
                }
            }
            return Ok(true);
        }
        Ok(false)
    }

    /// Shows that the factors of a divisor are not 0: symbols, known facts, errors 2ᵖ + 1 + e, and the rest.
    fn divisor(&mut self, formula: usize) -> Result<()> {
        let of = self.proof.state.value(formula)?;
        if self.proof.state.inverse(&of).is_ok() {
            return Ok(());
        }
        self.check_divisor(formula, &of)?;
        let state = &self.proof.state;
        let mut rest = poly(&of.num);
        let mut candidates: Vec<Poly> =
            rest.common_monomial().powers().map(|(x, _)| Poly::variable(x)).collect();
        let strict = state.facts.iter().filter(|(of, sign)| sign.is_strict() && of.terms().len() > 1);
        candidates.extend(strict.map(|(of, _)| poly(of)));
        candidates.extend(self.known.largest_errors(&rest));
        let mut factors = Vec::new();
        for factor in candidates {
            while let Some(quotient) = rest.checked_div(&factor).filter(is_integral) {
                rest = quotient;
                factors.push(factor.clone());
            }
        }
        if !rest.is_one() {
            factors.push(rest);
        }
        let mut numbers = Vec::with_capacity(factors.len());
        for factor in &factors {
            let factor = polynomial(factor).ok_or("a divisor")?;
            numbers.push(self.strict(&factor)?);
        }
        if numbers.len() != 1 {
            self.proof.add(Step::Divisor(numbers))?;
        }
        Ok(())
    }

    /// Checks that the sign of a divisor is found, and that it is strict.
    fn check_divisor(&mut self, formula: usize, value: &Quotient) -> Result<()> {
        if value.num.has_only(|_| false) && !value.num.is_zero() {
            return Ok(());
        }
        loop {
            let reduced = self.known.reduced_quotient(value, &self.proof.state);
            let signed = self.known.sign(reduced.clone());
            if signed.is_some_and(|signed| signed.sign().is_strict()) {
                return Ok(());
            }
            if value.num.is_zero() || !self.list_law()? {
                let divisor = self.problem().table.formula(formula)?.clone();
                return Err(ProofError::PossibleZeroDivisor(divisor, self.known.quantity(reduced)));
            }
        }
    }

    /// Shows that 2ᵖ + 1 is not 0.
    fn precision(&mut self) -> Result<()> {
        let largest = self.known.context.inverse_gamma();
        if !self.known.sign(largest.clone()).is_some_and(|signed| signed.sign().is_strict()) {
            let divisor = Tree::symbol(PRECISION) + Tree::from(1);
            return Err(ProofError::PossibleZeroDivisor(divisor, self.known.quantity(largest)));
        }
        let largest = polynomial(&self.known.context.largest);
        self.strict(&largest.ok_or("a precision")?)?;
        Ok(())
    }

    /// Adds the laws of an exponential and its reciprocal to those that may be listed.
    fn exponential(&mut self, exponent: usize) -> Result<()> {
        let table = &self.problem().table;
        let reciprocal = table.number(&Op::Neg(exponent))?;
        let pair = [exponent, reciprocal].map(|of| table.variable(Atom::Exponential(of)));
        let [x, y] = [pair[0]?, pair[1]?];
        if self.exponentials.contains(&x) {
            return Ok(());
        }
        self.exponentials.extend([x, y]);
        let all = &self.exponentials;
        for x in [x, y] {
            let pairs = all.iter().take_while(|z| **z != x).map(|z| vec![*z, x]);
            for left in iter::once(vec![x]).chain(pairs) {
                let others = all.iter().filter(|z| !left.contains(z)).map(|z| vec![*z]);
                let laws = iter::once(Vec::new()).chain(others);
                self.laws.extend(laws.map(|right| Law::Exponents { left: left.clone(), right }));
            }
        }
        for x in [x, y] {
            self.laws.extend([Law::AboveTangent(x), Law::BelowPole(x)]);
        }
        Ok(())
    }

    /// Shows what the absolute value of a formula is: another one, an atom, or the formula with a sign.
    fn absolute_value(&mut self, of: usize) -> Result<()> {
        let size = self.problem().table.variable(Atom::Size(of))?;
        if self.met.contains(&size) {
            return Ok(());
        }
        let quotient = self.proof.state.value(of)?;
        let value = self.known.ratio(&quotient, &self.proof.state);
        let twice: Ratio = self.known.context.reduce(&(&value + &value));
        let replaced = self.known.context.size(&value);
        let decision = Decision::Size { at: self.position, of, twice: twice.clone() };
        let is_free = replaced.is_none() && self.known.sign(twice.clone()).is_none();
        let is_new = is_free && self.known.assume_size(of, &twice);
        self.sizes.extend(is_new.then_some(decision));
        self.met.push(size);
        if is_new || replaced == Some(size) {
            let fact = self.proof.add(Step::Law(Law::AbsoluteValue(of)))?;
            self.known.sizes.insert(size, fact);
        } else {
            self.show(&quotient, Use::Branch)?;
            let fact = self.proof.add(Step::Law(Law::Signed(of)))?;
            self.known.equate(fact, &self.proof.state.facts.get(fact)?.0);
        }
        Ok(())
    }
}

impl Knowledge<'_> {
    /// Returns 2ᵖ + 1 + e for each error in a polynomial.
    pub fn largest_errors(&self, of: &Poly) -> Vec<Poly> {
        let largest = &self.context.largest;
        self.context.errors(of).into_iter().map(|x| largest + Poly::variable(x)).collect()
    }
}

/// Returns the sign that the first fact about a polynomial states.
fn known_fact(of: &Polynomial, state: &State) -> Option<Sign> {
    state.facts.iter().find(|(known, _)| known == of).map(|(_, sign)| *sign)
}

/// Returns `true` if no other sign implies this one.
fn is_definite(sign: Sign) -> bool {
    sign.is_strict() || sign == Sign::Zero
}

fn is_integral(of: &Poly) -> bool {
    of.terms().all(|(_, number)| number.is_integer())
}
