//! The search as the source of a proof: what the checker asks for is found, and listed.

use super::ProofError;
use super::algebra::{Poly, Ratio};
use super::dictionary::opaque;
use super::finder::{Finder, Result};
use super::knowledge::{AssumedFact, Knowledge};
use super::symbol::Symbol;
use super::{Decision, Failure};
use crate::formula::Relation;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::Proposition;
use crate::number::Tree;
use crate::proof::check::{
    AbsoluteValue, Atom, Leaf, Polynomial, Problem, Question, Quotient, Reason, Refusal, Same, Sign, Source,
    State,
};

/// A search for what a leaf lists.
pub struct Search<'a> {
    /// The knowledge so far.
    pub known: Knowledge<'a>,
    /// The lists so far.
    pub leaf: Leaf,
    /// The absolute values that were replaced, each with the number of hypotheses before it.
    pub sizes: Vec<Decision>,
    /// Whether the goal rests on an order of rounded formulas.
    pub is_ordered: bool,
    /// The number of hypotheses so far.
    pub position: usize,
    /// The reason why the search ended.
    pub failure: Option<Failure>,
    /// The last quantity whose sign was required.
    pub required: Option<Quotient>,
}

impl Search<'_> {
    fn problem(&self) -> &Problem<'_> {
        self.known.problem
    }

    fn noted<T>(&mut self, found: Result<T>) -> Option<T> {
        found.map_err(|failure| self.failure.get_or_insert(failure)).ok()
    }

    /// Returns a reason for the sign of a polynomial: a fact about it, unless a certificate proves more.
    fn reason(&mut self, question: Question, state: &State) -> Result<Reason> {
        let fact = known_fact(question.of, state);
        if let Some((i, sign)) = fact
            && is_definite(sign)
        {
            return Ok(Reason::Fact(i));
        }
        if self.is_ordered
            && fact.is_none()
            && let Some(found) = Finder::by_order(&self.known, question.of, state)
        {
            return Ok(Reason::Certificate(found));
        }
        let quotient = Quotient { num: question.of.clone(), den: question.den.into() };
        self.required = Some(quotient.clone());
        // The polynomial itself is shorter than the sum, but its sign may be found by the other's alone.
        let direct = self.known.reduced(question.of, state);
        let signed = self.known.context.sign(direct.clone(), &self.known.factors);
        let signed = signed.filter(|signed| match fact {
            Some(_) => is_definite(signed.sign()),
            None => self.suffices(question, signed.sign()),
        });
        if let Some(signed) = signed {
            return Finder::find(&self.known, question.of, &[], &signed, state).map(Reason::Certificate);
        }
        if let Some((i, _)) = fact {
            return Ok(Reason::Fact(i));
        }
        let value =
            if question.den.is_empty() { direct } else { self.known.reduced_quotient(&quotient, state) };
        let signed = self.known.sign(value.clone());
        let requires_zero =
            matches!(self.problem().proposition, Proposition::Equal(..) | Proposition::Derivative(..));
        if requires_zero && !question.decides && question.is_sum && !value.is_zero() {
            return Err(ProofError::Unequal(self.known.quantity(value)).into());
        }
        let Some(signed) = signed else {
            let value = self.known.quantity(value);
            let is_branch = question.decides;
            return Err(if is_branch {
                Failure::Branch(value)
            } else {
                ProofError::UnknownSign(value).into()
            });
        };
        Finder::find(&self.known, question.of, question.den, &signed, state).map(Reason::Certificate)
    }

    /// Returns `true` if no other sign of a polynomial would prove more.
    fn suffices(&self, question: Question, sign: Sign) -> bool {
        let is_weak = match self.problem().proposition {
            Proposition::Within(..) | Proposition::Sign(Relation::NonNegative, _) => true,
            _ => question.decides,
        };
        is_definite(sign) || (is_weak && question.is_sum)
    }

    /// Returns the factors of a divisor: symbols, known facts, errors 2ᵖ + 1 + e, and the rest.
    fn factors(&mut self, of: usize, value: &Polynomial, state: &State) -> Result<Vec<Polynomial>> {
        self.check_divisor(of, state)?;
        let mut rest = opaque(value);
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
        let factors: Option<_> = factors.iter().map(|factor| self.known.polynomial(factor, state)).collect();
        Ok(factors.ok_or("a divisor")?)
    }

    /// Checks that a divisor is not 0.
    fn check_divisor(&mut self, of: usize, state: &State) -> Result<()> {
        let value = state.value(of).ok_or(Refusal::Unknown)?;
        if value.num.has_only(|_| false) && !value.num.is_zero() {
            return Ok(());
        }
        let reduced = self.known.reduced_quotient(value, state);
        if !value.num.is_zero() {
            self.known.collect_factors(of, state)?;
            let signed = self.known.context.sign(reduced.clone(), &self.known.factors);
            if signed.is_some_and(|signed| signed.sign().is_strict()) {
                return Ok(());
            }
        }
        let divisor = self.problem().table.formula(of)?.clone();
        Err(ProofError::PossibleZeroDivisor(divisor, self.known.quantity(reduced)).into())
    }

    /// Returns the earlier formula that a rounded formula is a power of two times, if there is one.
    fn same_rounding(&mut self, value: &Quotient, state: &State) -> Result<Option<Same>> {
        let largest = self.known.context.inverse_gamma();
        if !self.known.sign(largest.clone()).is_some_and(|signed| signed.sign().is_strict()) {
            let divisor = Tree::symbol(PRECISION) + Tree::from(1);
            return Err(ProofError::PossibleZeroDivisor(divisor, self.known.quantity(largest)).into());
        }
        let mut reduced = None;
        for (i, known) in state.rounded.iter().enumerate() {
            let (unscaled, scale) = reduced
                .get_or_insert_with(|| self.without_scales(&self.known.reduced_quotient(value, state)));
            let (other, before) = self.without_scales(&self.known.reduced_quotient(&known.value, state));
            if !(&other - &*unscaled).is_zero() {
                continue;
            }
            let factor = scale.checked_div(&before).ok_or("a power of two")?;
            let [up, down] = [factor.num(), factor.den()].map(|of| self.known.polynomial(of, state));
            let (up, down) = (up.ok_or("a power of two")?, down.ok_or("a power of two")?);
            return Ok(Some(Same { rounding: i, up, down }));
        }
        Ok(None)
    }

    /// Splits a quotient into a factor without powers of two and a product of powers of two.
    fn without_scales(&self, value: &Ratio) -> (Ratio, Ratio) {
        let [num, den] = [value.num(), value.den()].map(|part| {
            let scales = part.common_monomial().only(
                |x| matches!(self.known.context.symbol(x), Some(Symbol::Own(name)) if SCALES.contains(&name)),
            );
            Ratio::from(Poly::from(scales))
        });
        let scale = num.checked_div(&den).unwrap_or_else(|| Poly::constant(1).into());
        (value.checked_div(&scale).unwrap_or_else(|| value.clone()), scale)
    }

    /// Returns the translation of the absolute value of a formula.
    fn absolute_value(&mut self, of: usize, value: &Quotient, state: &State) -> Result<AbsoluteValue> {
        let value = self.known.ratio(value, state);
        let twice = self.known.context.reduce(&(&value + &value));
        if self.known.context.size(&value).is_none() {
            let decision = Decision::Size { at: self.position, of, twice: twice.clone() };
            if self.known.sign(twice.clone()).is_some() || !self.known.assume_size(of, &twice) {
                return Ok(AbsoluteValue::BySign);
            }
            self.sizes.push(decision);
        }
        let size = self.known.context.size(&value).ok_or("an absolute value")?;
        if let Some(i) = state.sizes.iter().position(|known| known.size == size) {
            return Ok(AbsoluteValue::Same(i));
        }
        let atom = self.problem().table.variable(Atom::Size(of))?;
        if atom == size { Ok(AbsoluteValue::Atom) } else { Err("an absolute value before its own".into()) }
    }
}

impl Search<'_> {
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
}

impl Knowledge<'_> {
    /// Returns 2ᵖ + 1 + e for each error in a polynomial.
    pub fn largest_errors(&self, of: &Poly) -> Vec<Poly> {
        let largest = &self.context.largest;
        self.context.errors(of).into_iter().map(|x| largest + Poly::variable(x)).collect()
    }
}

/// Returns the number and sign of the first fact about this polynomial.
fn known_fact(of: &Polynomial, state: &State) -> Option<(usize, Sign)> {
    let (i, (_, sign)) = state.facts.iter().enumerate().find(|(_, (known, _))| known == of)?;
    Some((i, *sign))
}

/// Returns `true` if no other sign implies this one.
fn is_definite(sign: Sign) -> bool {
    sign.is_strict() || sign == Sign::Zero
}

fn is_integral(of: &Poly) -> bool {
    of.terms().all(|(_, number)| number.is_integer())
}

impl Source for Search<'_> {
    fn sign(&mut self, question: Question, state: &State) -> Option<Reason> {
        let found = self.reason(question, state);
        let reason = self.noted(found)?;
        self.leaf.signs.push(reason.clone());
        Some(reason)
    }

    fn divisor(&mut self, of: usize, value: &Polynomial, state: &State) -> Option<Vec<Polynomial>> {
        let found = self.factors(of, value, state);
        let factors = self.noted(found)?;
        self.leaf.divisors.push(factors.clone());
        Some(factors)
    }

    fn rounding(&mut self, _: usize, value: &Quotient, state: &State) -> Option<Option<Same>> {
        let found = self.same_rounding(value, state);
        let same = self.noted(found)?;
        self.leaf.roundings.push(same.clone());
        Some(same)
    }

    fn size(&mut self, of: usize, value: &Quotient, state: &State) -> Option<AbsoluteValue> {
        let found = self.absolute_value(of, value, state);
        let size = self.noted(found)?;
        self.leaf.sizes.push(size);
        Some(size)
    }
}
