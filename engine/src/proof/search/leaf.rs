//! The search for the steps of a leaf: whatever the translation of a formula requires is found, and listed.

use super::Failure;
use super::ProofError;
use super::algebra::{Poly, Ratio};
use super::dictionary::opaque;
use super::finder::{Finder, Result};
use super::knowledge::{AssumedFact, Knowledge};
use super::{Decision, case};
use crate::formula::Relation;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::check::{Atom, Law, Polynomial, Problem, Quotient, Refusal, Sign, State, Step};

/// The steps so far, and the knowledge of the checker after them.
pub struct Steps<'a> {
    pub state: State<'a>,
    pub steps: Vec<Step>,
    /// The number of the last fact after each step.
    last_facts: Vec<usize>,
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
    /// Whether the goal rests on an order of rounded formulas.
    is_ordered: bool,
    /// The number of laws of exponentials, two for each, that were tried.
    laws: usize,
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
        self.last_facts.push(self.state.facts.iter().len() - 1);
        Ok(self.state.facts.iter().len() - 1)
    }

    /// Adds a step, unless it is listed, and returns the number of its fact.
    pub fn add_once(&mut self, step: Step) -> Result<usize> {
        match self.steps.iter().position(|known| *known == step) {
            Some(i) => Ok(self.last_facts[i]),
            None => self.add(step),
        }
    }
}

impl<'a> Search<'a> {
    /// Returns a search under the assumptions of decisions.
    pub fn new(problem: &'a Problem<'a>, decisions: &[Decision]) -> Result<Self> {
        let cases: Vec<_> = decisions.iter().filter_map(case).collect();
        let proof = Steps { state: State::new(problem, &cases)?, steps: Vec::new(), last_facts: Vec::new() };
        let (sizes, position, required, is_ordered, laws) = Default::default();
        Ok(Search { known: Knowledge::new(problem), proof, sizes, position, required, is_ordered, laws })
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
        if let Some((_, lower, upper)) = hypothesis.interval() {
            for end in [lower, upper] {
                self.value(problem.table.find(end)?)?;
            }
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
        self.is_ordered = true;
        let [Op::Rounded(x), Op::Rounded(y)] =
            [a, b].map(|of| self.problem().table.op(of).unwrap_or(Op::Int(0)))
        else {
            return Err(Refusal::Unknown.into());
        };
        self.show_sum(&[(1, x), (-1, y)], Use::Goal)?;
        [a, b].into_iter().try_for_each(|of| self.value(of).map(|_| ()))?;
        self.proof.add(Step::Law(Law::Order { rounded: [a, b] }))?;
        Ok(())
    }

    /// Shows the goal.
    pub fn goal(&mut self) -> Result<()> {
        match (self.problem().proposition, &self.problem().goal[..]) {
            (Proposition::Limit(_, by, _), [of, to]) => self.limit(*of, by, *to)?,
            (Proposition::Equal(..), [a, b]) => self.show_sum(&[(1, *a), (-1, *b)], Use::Goal)?,
            (Proposition::Sign(..), [of, ..]) => self.show_sum(&[(1, *of)], Use::Goal)?,
            (Proposition::Within(..), [of, bound]) => {
                self.show_sum(&[(1, *bound), (-1, *of)], Use::Goal)?;
                self.show_sum(&[(1, *bound), (1, *of)], Use::Goal)?;
            }
            (Proposition::Derivative(..), [of, is, derivative]) => {
                self.value(*of)?;
                self.show_sum(&[(1, *derivative), (-1, *is)], Use::Goal)?;
            }
            _ => {}
        }
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
                Op::Min(a, b) if self.problem().table.op(a) == Ok(Op::Neg(b)) => self.absolute_value(a, b)?,
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
        if self.is_ordered && fact.is_none() && Finder::by_order(&self.known, &of.num, &mut self.proof)? {
            return Ok(());
        }
        self.required = Some(of.clone());
        // The numerator is shorter than the quotient, but its sign may be found by the other's alone.
        let direct = self.known.reduced(&of.num, &self.proof.state);
        let signed = self.known.context.sign(direct.clone(), &self.known.factors);
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
        if requires_zero && usage == Use::Goal && !value.is_zero() {
            return Err(ProofError::Unequal(self.known.quantity(value)).into());
        }
        if signed.is_none() && self.list_law()? {
            return self.show(of, usage);
        }
        match signed {
            Some(signed) => Finder::show(&self.known, &of.num, &of.den, &signed, &mut self.proof),
            None if usage == Use::Branch => Err(Failure::Branch(self.known.quantity(value))),
            None => Err(ProofError::UnknownSign(self.known.quantity(value)).into()),
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

    /// Lists the next law of an exponential. Returns `false` if all are listed already.
    fn list_law(&mut self) -> Result<bool> {
        let Some((exponent, x)) = self.proof.state.exponents.get(self.laws / 2).cloned() else {
            return Ok(false);
        };
        let is_tangent = self.laws.is_multiple_of(2);
        self.laws += 1;
        let signed = self.known.sign(self.known.reduced_quotient(&exponent, &self.proof.state));
        let sign = signed.map(|signed| signed.sign());
        if !is_tangent && !sign.is_some_and(|sign| sign.implies(Sign::NonNegative)) {
            return self.list_law();
        }
        if sign.is_some() {
            self.show(&exponent, Use::Part)?;
        }
        let law = if is_tangent { Law::AboveTangent(x) } else { Law::BelowPole(x) };
        let fact = self.proof.add(Step::Law(law))?;
        let (of, sign) = self.proof.state.facts.get(fact)?;
        self.known.retain(self.known.poly(of, &self.proof.state).into(), *sign, fact);
        Ok(true)
    }

    /// Shows that the factors of a divisor are not 0: symbols, known facts, errors 2ᵖ + 1 + e, and the rest.
    fn divisor(&mut self, formula: usize) -> Result<()> {
        let of = self.proof.state.value(formula)?;
        if self.proof.state.inverse(&of).is_ok() {
            return Ok(());
        }
        self.check_divisor(formula, &of)?;
        let state = &self.proof.state;
        let mut rest = opaque(&of.num);
        let mut candidates: Vec<Poly> =
            rest.common_monomial().powers().map(|(x, _)| Poly::variable(x)).collect();
        let strict = state.facts.iter().filter(|(of, sign)| sign.is_strict() && of.terms().len() > 1);
        candidates.extend(strict.map(|(of, _)| opaque(of)));
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
            let factor = self.known.polynomial(factor, &self.proof.state).ok_or("a divisor")?;
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
        let reduced = self.known.reduced_quotient(value, &self.proof.state);
        self.known.collect_factors(formula, &mut self.proof.state)?;
        loop {
            let signed = self.known.sign(reduced.clone());
            if signed.is_some_and(|signed| signed.sign().is_strict()) {
                return Ok(());
            }
            if value.num.is_zero() || !self.list_law()? {
                let divisor = self.problem().table.formula(formula)?.clone();
                return Err(ProofError::PossibleZeroDivisor(divisor, self.known.quantity(reduced)).into());
            }
        }
    }

    /// Shows that 2ᵖ + 1 is not 0.
    fn precision(&mut self) -> Result<()> {
        let largest = self.known.context.inverse_gamma();
        if !self.known.sign(largest.clone()).is_some_and(|signed| signed.sign().is_strict()) {
            let divisor = Tree::symbol(PRECISION) + Tree::from(1);
            return Err(ProofError::PossibleZeroDivisor(divisor, self.known.quantity(largest)).into());
        }
        let largest = self.known.polynomial(&self.known.context.largest, &self.proof.state);
        self.strict(&largest.ok_or("a precision")?)?;
        Ok(())
    }

    /// Makes an exponential an atom, unless one with the same exponent is one.
    fn exponential(&mut self, exponent: usize) -> Result<()> {
        let x = self.problem().table.variable(Atom::Exponential(exponent))?;
        if self.proof.state.exponent(x).is_none() {
            self.proof.add(Step::Exponential(exponent))?;
        }
        Ok(())
    }

    /// Makes the absolute value of a formula an atom, or shows its sign.
    fn absolute_value(&mut self, negated: usize, of: usize) -> Result<()> {
        if self.proof.state.sizes.contains(&of) {
            return Ok(());
        }
        let quotient = self.proof.state.value(of)?;
        let value = self.known.ratio(&quotient, &self.proof.state);
        let twice: Ratio = self.known.context.reduce(&(&value + &value));
        if self.known.context.size(&value).is_none() {
            let decision = Decision::Size { at: self.position, of, twice: twice.clone() };
            if self.known.sign(twice.clone()).is_some() || !self.known.assume_size(of, &twice) {
                return self.show_sum(&[(1, of), (-1, negated)], Use::Branch);
            }
            self.sizes.push(decision);
        }
        let size = self.problem().table.variable(Atom::Size(of))?;
        let known = self.known.context.size(&value).ok_or("an absolute value")?;
        let fact = self.proof.add(Step::AbsoluteValue(of))?;
        if known == size {
            self.known.sizes.insert(size, fact);
        } else if let Some(Atom::Size(other)) = self.problem().table.atoms().get(known) {
            let fact = self.proof.add(Step::Law(Law::AbsoluteValues { of: [of, *other] }))?;
            self.known.equate([size, known], fact);
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
