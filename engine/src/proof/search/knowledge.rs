//! The knowledge of a search: assumptions with the facts of the checker.

use super::algebra::{Poly, Ratio};
use super::assumption::{AssumptionUse, SignedRatio};
use super::context::Context;
use super::dictionary::poly;
use super::error::Quantity;
use crate::formula::Hypothesis;
use crate::proof::check::{Atom, Polynomial, Problem, Sign};
use std::collections::BTreeMap;

/// A fact of the checker for an assumption, whose quantity is `scale` times the fact divided by other facts.
#[derive(Clone)]
pub struct AssumedFact {
    pub fact: usize,
    pub den: Vec<usize>,
    pub scale: Ratio,
}

/// The assumptions of a proof with their facts.
#[derive(Clone)]
pub struct Knowledge<'a> {
    pub problem: &'a Problem<'a>,
    pub context: Context,
    /// The slack variables, with their values in original variables.
    pub slacks: Vec<(usize, Ratio)>,
    /// The fact of each assumption, except for those of intervals and absolute values.
    pub facts: Vec<Option<AssumedFact>>,
    /// The facts about absolute values that are atoms, by their variables.
    pub sizes: BTreeMap<usize, usize>,
}

impl<'a> Knowledge<'a> {
    /// Returns the knowledge before any assumption.
    pub fn new(problem: &'a Problem) -> Self {
        let (slacks, facts, sizes) = Default::default();
        Knowledge { problem, context: Context::new(problem), slacks, facts, sizes }
    }

    /// Returns a quantity at which the search ends.
    pub fn quantity(&self, value: Ratio) -> Quantity {
        Quantity { value, context: self.context.clone().into() }
    }

    /// Adds a hypothesis about the sign of this value.
    pub fn assume(&mut self, hypothesis: &Hypothesis, value: Ratio, fact: AssumedFact) {
        self.context.assume_sign(Some(hypothesis), value, hypothesis.relation.into());
        self.record(Some(fact));
    }

    /// Uses the fact with this number, that a polynomial is 0.
    pub fn equate(&mut self, fact: usize, of: &Polynomial) {
        self.context.assume_sign(None, poly(of).into(), Sign::Zero);
        self.record(Some(AssumedFact { fact, den: Vec::new(), scale: Poly::constant(1).into() }));
    }

    /// Retains a multiple of a fact of known sign, for a positive factor.
    pub fn retain(&mut self, fact: usize, of: &Polynomial, sign: Sign, factor: Poly) {
        let value = self.context.reduce(&(poly(of) * &factor).into());
        self.context.retain(None, value, sign);
        self.record(Some(AssumedFact { fact, den: Vec::new(), scale: factor.into() }));
    }

    /// Adds the assumption of a case.
    pub fn assume_case(&mut self, deciding: &Poly, sign: Sign, fact: AssumedFact) {
        self.context.assume_sign(None, deciding.clone().into(), sign);
        self.record(Some(fact));
    }

    /// Replaces a formula by a multiple of its absolute value. Returns `false` if this is not possible.
    pub fn assume_size(&mut self, of: usize, twice: &Ratio) -> bool {
        let table = &self.problem.table;
        let variables = (table.variable(Atom::Size(of)), table.variable(Atom::Factor(of)));
        let (Ok(size), Ok(factor)) = variables else { return false };
        let mut context = self.context.clone();
        if !context.assume_size([size, factor], twice) {
            return false;
        }
        self.context = context;
        self.record(None);
        true
    }

    /// Records the fact of the last assumption.
    fn record(&mut self, fact: Option<AssumedFact>) {
        let Some(last) = self.context.assumptions.last() else { return };
        if let AssumptionUse::Pivot(_, _, Some(slack)) = &last.usage {
            let value = (*slack, self.original(&last.slack_value()));
            self.slacks.push(value);
        }
        self.facts.resize(self.context.assumptions.len() - 1, None);
        self.facts.push(fact);
    }

    /// Returns the sign of a reduced quantity if the rules find it.
    pub fn sign(&self, value: Ratio) -> Option<SignedRatio> {
        self.context.sign_by_retained(value)
    }

    /// Returns the fact of a retained quantity.
    pub fn retained(&self, of: &Ratio) -> Option<&AssumedFact> {
        let mut retained = self.context.retained.iter();
        let (quantity, _) = retained.find(|(quantity, _)| self.context.reduce(quantity) == *of)?;
        let index = self.context.assumptions.iter().rposition(|assumption| {
            matches!(assumption.usage, AssumptionUse::Retained) && assumption.value == *quantity
        })?;
        self.facts.get(index)?.as_ref()
    }
}
