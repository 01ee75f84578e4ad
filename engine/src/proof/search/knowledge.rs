//! The knowledge of a search: assumptions, and formulas in the symbols that remain under them.

use super::algebra::{Poly, Ratio, Symbol};
use super::assumption::{Assumption, AssumptionUse, SignedRatio};
use super::context::Context;
use super::dictionary::Dictionary;
use super::sign::Certificate;
use super::{Failure, ProofError};
use crate::formula::Hypothesis;
use crate::number::tree::Op;
use crate::proof::check::{Problem, Sign, Size, State};
use std::collections::HashMap;

/// A fact of the checker for an assumption: its quantity is `scale` times the fact over other facts.
#[derive(Clone)]
pub struct Supposed {
    pub fact: usize,
    pub den: Vec<usize>,
    pub scale: Ratio,
}

/// The assumptions of a proof with their facts, and the values of formulas.
#[derive(Clone)]
pub struct Knowledge<'a> {
    pub problem: &'a Problem<'a>,
    pub context: Context,
    pub dictionary: Dictionary,
    /// The fact of each assumption, except for those of intervals and absolute values.
    pub supposed: Vec<Option<Supposed>>,
    /// The signs of factors of divisors.
    pub factors: Vec<Certificate>,
    /// The rounded formulas so far, with the symbols of their errors.
    pub rounded: Vec<(usize, Symbol)>,
    values: HashMap<usize, Ratio>,
}

impl<'a> Knowledge<'a> {
    /// Returns the knowledge before any assumption.
    pub fn new(problem: &'a Problem, context: Context) -> Option<Self> {
        let dictionary = Dictionary::new(problem, context.roundings())?;
        let (supposed, factors, rounded, values) = Default::default();
        Some(Knowledge { problem, context, dictionary, supposed, factors, rounded, values })
    }

    /// Adds a hypothesis.
    pub fn assume(&mut self, i: usize, supposed: Option<Supposed>) -> Result<(), Failure> {
        let hypothesis = self.problem.hypotheses[i];
        match hypothesis.interval() {
            Some((x, lower, upper)) => {
                let table = &self.problem.table;
                let (lower, upper) = (self.value(table.find(lower)?)?, self.value(table.find(upper)?)?);
                self.context.assume_interval(hypothesis, Symbol::Own(x), &lower, &upper);
            }
            None => {
                let value = self.value(self.problem.values[i])?;
                self.context.assume_sign(Some(hypothesis), value, hypothesis.relation.into());
            }
        }
        self.record(Some(i), supposed);
        Ok(())
    }

    /// Adds the assumption of a case.
    pub fn assume_case(&mut self, deciding: &Poly, sign: Sign, supposed: Supposed) {
        self.context.assume_sign(None, deciding.clone().into(), sign);
        self.record(None, Some(supposed));
    }

    /// Replaces a formula by a multiple of its absolute value. Returns `false` if this is not possible.
    pub fn assume_size(&mut self, of: usize, twice: &Ratio) -> bool {
        let Ok(tree) = self.problem.table.formula(of) else { return false };
        let mut context = self.context.clone();
        if !context.assume_size(tree, twice) {
            return false;
        }
        self.context = context;
        self.record(None, None);
        self.values.clear();
        true
    }

    /// Records the fact of the last assumption.
    fn record(&mut self, hypothesis: Option<usize>, supposed: Option<Supposed>) {
        let Some(last) = self.context.assumptions().last() else { return };
        self.dictionary.read(last, hypothesis, self.problem);
        self.supposed.resize(self.context.assumptions().len() - 1, None);
        self.supposed.push(supposed);
    }

    /// Replaces the fact of a hypothesis, which is used again.
    pub fn assume_again(&mut self, hypothesis: &Hypothesis, supposed: Supposed) {
        let is_it = |given: &Option<Hypothesis>| given.as_ref() == Some(hypothesis);
        let place = self.context.assumptions().iter().position(|own| is_it(&own.hypothesis));
        if let Some(known) = place.and_then(|place| self.supposed.get_mut(place)) {
            *known = Some(supposed);
        }
    }

    /// Returns a sum of multiples of formulas, reduced.
    pub fn sum(&mut self, terms: &[(i128, usize)]) -> Result<Ratio, Failure> {
        let mut sum = Ratio::zero();
        for (i, (n, of)) in terms.iter().enumerate() {
            let value = self.value(*of)?;
            sum = match (i, *n < 0) {
                (0, false) => value,
                (_, true) => sum - value,
                (_, false) => sum + value,
            };
        }
        Ok(self.context.reduce(&sum))
    }

    /// Returns the difference or sum of two formulas, reduced but not simplified, which would take long.
    pub fn long_sum(&mut self, [(_, a), (n, b)]: [(i128, usize); 2]) -> Result<Ratio, Failure> {
        let (a, b) = (self.value(a)?, self.value(b)?);
        let [difference, sum] = self.context.reduce(&a).difference_and_sum(&self.context.reduce(&b));
        Ok(if n < 0 { difference } else { sum })
    }

    /// Returns the sign of a reduced quantity if the rules find it.
    pub fn sign(&self, value: Ratio) -> Option<SignedRatio> {
        self.context.sign_by_retained(value, &self.factors)
    }

    /// Records the signs of the factors of a divisor.
    pub fn collect_factors(&mut self, divisor: usize) -> Result<(), Failure> {
        match self.problem.table.step(divisor)? {
            Op::Mul(a, b) => [a, b].into_iter().try_for_each(|factor| self.collect_factors(factor)),
            Op::Neg(a) | Op::Div(a, _) | Op::Rounded(a) => self.collect_factors(a),
            _ => {
                let value = self.value(divisor)?;
                let factor = self.context.reduce(&value);
                if self.factors.iter().all(|known| known.of() != factor.num()) {
                    self.factors.extend(self.context.sign_of(factor.num()));
                }
                Ok(())
            }
        }
    }

    /// Returns the value of the formula with this number.
    pub fn value(&mut self, of: usize) -> Result<Ratio, Failure> {
        if let Some(value) = self.values.get(&of) {
            return Ok(value.clone());
        }
        let value = self.value_of_step(of)?;
        self.values.insert(of, value.clone());
        Ok(value)
    }

    fn value_of_step(&mut self, of: usize) -> Result<Ratio, Failure> {
        use Op::{Add, Div, Exp, Int, Min, Mul, Neg, PositivePart, Rounded, Sub};
        Ok(match self.problem.table.step(of)? {
            Op::Symbol(name) => Poly::symbol(Symbol::Own(name)).into(),
            Int(n) => Poly::constant(n).into(),
            Neg(a) => -self.value(a)?,
            Add(a, b) => self.value(a)? + self.value(b)?,
            Sub(a, b) => self.value(a)? - self.value(b)?,
            Mul(a, b) => self.value(a)? * self.value(b)?,
            Div(a, b) => {
                let (value, divisor) = (self.value(a)?, self.value(b)?);
                let tree = self.problem.table.formula(b)?;
                let is_zero = || ProofError::PossibleZeroDivisor(tree.clone(), divisor.clone());
                value.over(&divisor).ok_or_else(|| Failure::Error(is_zero()))?
            }
            Exp(a) => {
                let exponent = self.value(a)?;
                Poly::exponential(self.context.reduce(&exponent)).into()
            }
            PositivePart(a) => {
                let value = self.value(a)?;
                if self.is_not_negative(&value)? { value } else { Ratio::zero() }
            }
            Min(a, b) => self.minimum(a, b)?,
            Rounded(a) => {
                let value = self.value(a)?;
                let value = self.context.reduce(&value);
                let (_, error) =
                    self.rounded.iter().find(|(known, _)| *known == a).ok_or("an unknown error")?;
                let largest = self.context.inverse_gamma();
                let nearest = &largest + Ratio::from(Poly::symbol(*error));
                // The quotient comes first, since the value is long.
                value * nearest.over(&largest).ok_or("a precision of 0")?
            }
        })
    }

    fn minimum(&mut self, a: usize, b: usize) -> Result<Ratio, Failure> {
        let (first, second) = (self.value(a)?, self.value(b)?);
        if self.problem.table.step(a)? == Op::Neg(b)
            && let Some(size) = self.context.size(&second)
        {
            return Ok((-Poly::symbol(size)).into());
        }
        Ok(if self.is_not_negative(&(&second - &first))? { first } else { second })
    }

    fn is_not_negative(&self, value: &Ratio) -> Result<bool, Failure> {
        let value = self.context.reduce(value);
        let signed = self.sign(value.clone()).ok_or(Failure::Branch(value))?;
        Ok(signed.sign().implies(Sign::NonNegative))
    }

    /// Returns `true` if identities may rest on equations: of hypotheses, or of absolute values.
    pub fn has_equations(&self) -> bool {
        let is_equation = |usage: &AssumptionUse| {
            matches!(usage, AssumptionUse::Pivot(_, _, None) | AssumptionUse::Size { .. })
        };
        self.context.assumptions().iter().any(|own| is_equation(&own.usage))
    }

    /// Returns the fact of a retained quantity.
    pub fn retained(&self, of: &Ratio) -> Option<&Supposed> {
        let mut retained = self.context.retained().iter();
        let (kept, _) = retained.find(|(kept, _)| self.context.reduce(kept) == *of)?;
        // The quantity may also be a symbol whose sign is known and that is in an interval.
        let is_it = |own: &Assumption| match own.usage {
            AssumptionUse::Retained => own.value == *kept,
            AssumptionUse::Symbol(x) => Ratio::from(Poly::symbol(x)) == *kept,
            _ => false,
        };
        let place = self.context.assumptions().iter().rposition(is_it)?;
        self.supposed.get(place)?.as_ref()
    }

    /// Returns the formula whose absolute value has this symbol, if it was met.
    pub fn size_atom<'s>(&self, size: Symbol, state: &'s State) -> Option<&'s Size> {
        let variable = self.dictionary.variable(size)?;
        state.sizes.iter().find(|known| known.size == variable)
    }
}
