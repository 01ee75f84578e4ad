//! The search for certificates.

use super::dictionary::{Dictionary, integral, quantity};
use crate::formula::Hypothesis;
use crate::formula::claim::PRECISION;
use crate::number::Tree;
use crate::proof::check::{Certificate, Known, Polynomial, Problem, Rise, Size, State};
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio, Symbol};
use crate::proof::kernel::context::Context;
use crate::proof::kernel::derivation::{AssumptionUse, SignedRatio};
use crate::proof::kernel::sign::{Certificate as KernelCertificate, Sign};

/// Maximum nesting of lemmas.
const MAX_DEPTH: u32 = 4;

/// Maximum number of terms of a fact by which a quantity is multiplied.
const MAX_FACTOR_TERMS: usize = 7;

/// The guide of the search: a derivation, and the problem that it solves.
pub struct Guide<'a> {
    /// The context of the derivation.
    pub context: &'a Context,
    /// The problem.
    pub problem: &'a Problem<'a>,
    /// The translation of symbols.
    pub dictionary: Dictionary,
    /// The signs in the derivation.
    pub signed: Vec<SignedRatio>,
    /// Whether the derivation compares rounded formulas.
    pub is_ordered: bool,
}

/// The reason why no certificate was found.
pub enum Failure {
    /// The sign of this function, whose parts are still to be proved, would help.
    Rise(Box<Rise>),
    /// Another reason.
    Reason(&'static str),
}

impl From<&'static str> for Failure {
    fn from(reason: &'static str) -> Self {
        Failure::Reason(reason)
    }
}

pub type Found<T> = Result<T, Failure>;

/// A quantity of a certificate: what the checker knows of it, and its value in own symbols.
#[derive(Clone)]
pub struct Quantity {
    pub known: Known,
    pub value: Poly,
}

/// A search for one certificate.
pub struct Finder<'a, 'p> {
    pub guide: &'a Guide<'a>,
    pub state: &'a State<'p>,
    pub quantities: Vec<Quantity>,
    /// The nesting of the certificate in others.
    pub depth: u32,
    /// Whether factors of known sign become lemmas, which keeps forms short.
    pub uses_lemmas: bool,
}

impl Guide<'_> {
    /// Returns a polynomial in own symbols, reduced by the derivation.
    pub fn reduced(&self, of: &Poly) -> Ratio {
        self.context.reduce(&self.dictionary.with_places(&of.clone().into()))
    }

    /// Returns the last fact of a hypothesis that satisfies a predicate.
    fn fact_of_hypothesis(&self, state: &State, is_it: impl Fn(&Hypothesis) -> bool) -> Option<usize> {
        let is_it = |i: usize| is_it(self.problem.hypotheses[i]);
        let mut supposed = state.supposed.iter().rev();
        supposed.find(|(i, _)| i.is_some_and(is_it)).map(|(_, fact)| *fact)
    }

    /// Returns the fact of the assumption with this number, a hypothesis or a case.
    pub fn fact(&self, assumption: usize, state: &State) -> Option<usize> {
        let all = self.context.assumptions();
        if let Some(hypothesis) = &all.get(assumption)?.hypothesis {
            return self.fact_of_hypothesis(state, |given| given == hypothesis);
        }
        let before = all[..assumption].iter().filter(|other| other.is_case()).count();
        state.supposed.iter().filter(|(i, _)| i.is_none()).nth(before).map(|(_, fact)| *fact)
    }

    fn has_sizes(&self) -> bool {
        self.context.assumptions().iter().any(|other| other.usage.is_size())
    }

    /// Returns the formula whose absolute value has this symbol, if it was met.
    pub fn size_atom<'s>(&self, size: Symbol, state: &'s State) -> Option<&'s Size> {
        let variable = self.dictionary.variable(size)?;
        state.sizes.iter().find(|known| known.size == variable)
    }

    /// Returns the fact for a slack variable.
    fn fact_of_slack(&self, slack: Symbol, state: &State) -> Option<usize> {
        let mut all = self.context.assumptions().iter();
        let is_it =
            |usage: &AssumptionUse| matches!(usage, AssumptionUse::Pivot(_, _, Some(own)) if *own == slack);
        self.fact(all.position(|assumption| is_it(&assumption.usage))?, state)
    }

    /// Returns the fact for a retained quantity.
    pub fn fact_of_retained(&self, of: &Ratio, state: &State) -> Option<usize> {
        let mut retained = self.context.retained().iter();
        let (kept, _) = retained.find(|(kept, _)| self.context.reduce(kept) == *of)?;
        let is_it = |i: &usize| {
            let assumption = &self.context.assumptions()[*i];
            matches!(assumption.usage, AssumptionUse::Retained) && assumption.value == *kept
        };
        let found = (0..self.context.assumptions().len()).rev().find(is_it);
        if let Some(fact) = found.and_then(|i| self.fact(i, state)) {
            return Some(fact);
        }
        // The sign of a symbol that is in an interval.
        let x = kept.num().symbols().into_iter().next()?;
        self.fact_of_hypothesis(state, |given| given.value == Tree::symbol(x.name()))
    }

    /// Returns the signs of factors that may occur in a value: facts, and 2ᵖ + 1 + e.
    fn factors(&self, value: &Poly, state: &State) -> Vec<KernelCertificate> {
        let strict = state.facts.iter().filter(|(of, sign)| sign.is_strict() && of.terms().len() > 1);
        let strict = strict.map(|(of, _)| self.dictionary.poly(of, state));
        let all: Vec<_> = strict.chain(self.largest_errors(value)).collect();
        all.iter().filter_map(|of| self.context.sign_of(self.reduced(of).num())).collect()
    }

    /// Returns the facts by which a quantity may be multiplied so that its sign is found.
    fn multipliers(&self, state: &State) -> Vec<usize> {
        let precision = Symbol::Own(PRECISION);
        let is_multiplier = |of: &Polynomial| {
            let is_precision =
                || of.as_variable().is_some_and(|x| self.dictionary.variable(precision) == Some(x));
            (2..=MAX_FACTOR_TERMS).contains(&of.terms().len()) || is_precision()
        };
        let facts = state.facts.iter().enumerate();
        facts.filter(|(_, (of, sign))| sign.is_strict() && is_multiplier(of)).map(|(i, _)| i).collect()
    }
}

impl<'a, 'p> Finder<'a, 'p> {
    /// Returns a certificate for a polynomial that is a numerator over these facts.
    pub fn find(
        guide: &'a Guide<'a>,
        of: &Polynomial,
        den: &[usize],
        state: &'a State<'p>,
    ) -> Found<Certificate> {
        let finder = |uses_lemmas| Finder { guide, state, quantities: Vec::new(), depth: 0, uses_lemmas };
        let is_accepted = |found: &Certificate| state.certify(of, found).is_ok();
        match finder(true).certificate(of, den) {
            Ok(found) if is_accepted(&found) => return Ok(found),
            Err(Failure::Rise(rise)) => return Err(Failure::Rise(rise)),
            _ => {}
        }
        let found = finder(false).certificate(of, den)?;
        if is_accepted(&found) { Ok(found) } else { Err("a certificate is refused".into()) }
    }

    /// Returns the polynomial of a quantity, which becomes part of the certificate.
    pub fn quantity(&mut self, known: Known, value: &Poly) -> Poly {
        let place = self.quantities.iter().position(|other| other.known == known);
        let i = place.unwrap_or_else(|| {
            self.quantities.push(Quantity { known, value: value.clone() });
            self.quantities.len() - 1
        });
        Poly::symbol(quantity(i))
    }

    /// Returns the polynomial of a fact, and its value.
    pub fn fact(&mut self, i: usize) -> Found<(Poly, Poly)> {
        let (of, _) = self.state.facts.get(i).map_err(|_| "a fact")?;
        let value = self.guide.dictionary.poly(of, self.state);
        Ok((self.quantity(Known::Fact(i), &value), value))
    }

    /// Returns the polynomial of a lemma about a value in own symbols.
    pub fn lemma(&mut self, value: &Poly) -> Found<Poly> {
        if self.depth >= MAX_DEPTH {
            return Err("too deep".into());
        }
        let of = self.guide.dictionary.polynomial(value, 0, self.state).ok_or("a lemma")?;
        let (guide, state, depth, uses_lemmas) = (self.guide, self.state, self.depth + 1, self.uses_lemmas);
        let mut finder = Finder { guide, state, quantities: Vec::new(), depth, uses_lemmas };
        let certificate = finder.certificate(&of, &[])?;
        state.certify(&of, &certificate).map_err(|_| "a lemma is refused")?;
        Ok(self.quantity(Known::Lemma((of, certificate).into()), value))
    }

    fn certificate(&mut self, of: &Polynomial, den: &[usize]) -> Found<Certificate> {
        let value = self.guide.dictionary.poly(of, self.state);
        let form = self.quotient(&value, den)?;
        let form = self.without_slacks(form)?;
        self.equated(of, &value, form.den().clone(), form.num().clone())
    }

    /// Returns the certificate for l and r in own symbols and quantities.
    pub fn finished(&self, left: &Poly, right: &Poly) -> Found<Certificate> {
        let (left, right) = integral(left, right);
        let count = self.quantities.len();
        let form = |of: &Poly| self.guide.dictionary.polynomial(of, count, self.state).ok_or("a form");
        let known = self.quantities.iter().map(|quantity| quantity.known.clone()).collect();
        Ok(Certificate { known, left: form(&left)?, right: form(&right)? })
    }

    /// Returns a value as a quotient of forms r/l.
    fn quotient(&mut self, value: &Poly, den: &[usize]) -> Found<Ratio> {
        let reduced = self.guide.reduced(value);
        if let Some(found) = self.multiple_of_order(value) {
            return Ok(found);
        }
        if reduced.is_zero() {
            return Ok(Ratio::zero());
        }
        if let Some(found) = self.multiplied(value, &reduced, 1)? {
            return Ok(found);
        }
        if let Some(found) = self.over(value, &reduced, den)? {
            return Ok(found);
        }
        if let Some(found) = self.multiplied(value, &reduced, 2)? {
            return Ok(found);
        }
        self.derived(&reduced)
    }

    /// Returns the form of a multiple, or divisor, of a fact about an order of rounded formulas.
    fn multiple_of_order(&mut self, value: &Poly) -> Option<Ratio> {
        if !self.guide.is_ordered {
            return None;
        }
        let is_order = |(of, sign): &(Polynomial, Sign)| of.terms().len() > 1 && *sign != Sign::Zero;
        let facts: Vec<_> = self.state.facts.iter().enumerate().filter(|(_, fact)| is_order(fact)).collect();
        facts.into_iter().rev().find_map(|(i, (of, _))| {
            let fact = self.guide.dictionary.poly(of, self.state);
            let (quotient, is_multiple) = match value.over(&fact) {
                Some(quotient) => (quotient, true),
                None => (fact.over(value)?, false),
            };
            let factors = self.guide.factors(&quotient, self.state);
            let signed = self.guide.context.sign_by_retained(self.guide.reduced(&quotient), &factors)?;
            let kept = self.quantities.len();
            let form = self.form(&signed).ok().and_then(|form| self.without_slacks(form).ok());
            let (symbol, _) = self.fact(i).ok()?;
            let found = form.and_then(|form| {
                if is_multiple { Some(form * Ratio::from(symbol)) } else { Ratio::from(symbol).over(&form) }
            });
            if found.is_none() {
                self.quantities.truncate(kept);
            }
            found
        })
    }

    /// Returns the form of a value by that of its product with `count` or fewer facts.
    fn multiplied(&mut self, value: &Poly, reduced: &Ratio, count: usize) -> Found<Option<Ratio>> {
        let factors = self.guide.factors(value, self.state);
        let facts = self.guide.multipliers(self.state);
        let mut products: Vec<Vec<usize>> = Vec::new();
        if count == 1 {
            products.push(Vec::new());
            products.extend(facts.iter().map(|i| vec![*i]));
        } else {
            products.extend(
                facts.iter().flat_map(|i| facts.iter().filter(move |j| i <= *j).map(move |j| vec![*i, *j])),
            );
        }
        for product in products {
            let reduced = match &product[..] {
                [] => reduced.clone(),
                facts => self.guide.reduced(&(value * self.guide.dictionary.product(facts, self.state))),
            };
            let Some(signed) = self.guide.context.sign_by_retained(reduced, &factors) else { continue };
            let mut form = self.form(&signed)?;
            for i in product {
                form = form.over(&self.fact(i)?.0.into()).ok_or("a zero factor")?;
            }
            return Ok(Some(form));
        }
        Ok(None)
    }

    /// Returns the form of a value by that of its quotient by facts.
    fn over(&mut self, value: &Poly, reduced: &Ratio, den: &[usize]) -> Found<Option<Ratio>> {
        if den.is_empty() || self.depth > 0 {
            return Ok(None);
        }
        let product = self.guide.dictionary.product(den, self.state);
        let Some(quotient) = reduced.over(&self.guide.reduced(&product)) else { return Ok(None) };
        let factors = self.guide.factors(&(value * &product), self.state);
        let Some(signed) = self.guide.context.sign_by_retained(quotient, &factors) else { return Ok(None) };
        let mut form = self.form(&signed)?;
        for i in den {
            form = form * Ratio::from(self.fact(*i)?.0);
        }
        Ok(Some(form))
    }

    /// Returns the form of a value that is a factor of one in the derivation.
    fn derived(&mut self, reduced: &Ratio) -> Found<Ratio> {
        let guide = self.guide;
        for signed in guide.signed.iter().filter(|_| self.depth == 0) {
            let Some(factor) = signed.value.num().over(reduced.num()) else { continue };
            let Some(factor) = guide.context.sign_by_retained(factor.into(), &[]) else { continue };
            let den = Ratio::from(signed.value.den().clone()).over(&reduced.den().clone().into());
            let form = self.form(signed)? * den.ok_or("a zero denominator")?;
            return Ok(form.over(&self.form(&factor)?).ok_or("a zero factor")?);
        }
        Err("a sign".into())
    }

    /// Replaces symbols by facts where a hypothesis is a multiple of the symbol whose sign it gives.
    fn without_symbols(&mut self, mut form: Ratio) -> Found<Ratio> {
        let guide = self.guide;
        for (i, assumption) in guide.context.assumptions().iter().enumerate() {
            let AssumptionUse::Symbol(x) = assumption.usage else { continue };
            let Some(fact) = guide.fact(i, self.state).filter(|_| form.symbols().contains(&x)) else {
                continue;
            };
            if self.state.facts.get(fact).is_ok_and(|(of, _)| of.as_variable().is_none()) {
                let (symbol, value) = self.fact(fact)?;
                let factor = value.over(&Poly::symbol(x)).ok_or("a multiple of a symbol")?;
                let by = Ratio::from(symbol).over(&factor.into()).ok_or("a zero fact")?;
                form = form.replace(&Monomial::of(x), &by);
            }
        }
        Ok(form)
    }

    /// Replaces slack variables by facts, and places by their own symbols.
    pub fn without_slacks(&mut self, mut form: Ratio) -> Found<Ratio> {
        let guide = self.guide;
        for (slack, own) in guide.dictionary.slacks.iter().rev() {
            if !form.symbols().contains(slack) {
                continue;
            }
            let fact = guide.fact_of_slack(*slack, self.state).ok_or("a slack variable")?;
            let (symbol, value) = self.fact(fact)?;
            // Its own value contains absolute values where the fact contains their arguments.
            let scale = if guide.has_sizes() {
                Ratio::from(Poly::symbol(*slack)).over(&guide.reduced(&value))
            } else {
                own.over(&value.into())
            };
            let scale = scale.ok_or("a zero fact")?;
            form = form.replace(&Monomial::of(*slack), &(scale * Ratio::from(symbol)));
        }
        Ok(guide.dictionary.with_own_places(&self.without_symbols(form)?))
    }
}
