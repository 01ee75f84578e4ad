//! Forms for the rules.

use super::algebra::{Poly, Ratio};
use super::assumption::SignedRatio;
use super::choice;
use super::dictionary::{integral, polynomial};
use super::finder::{Finder, Result};
use super::rules::{Rule, SignCertificate};
use crate::proof::check::Step;

/// Forms l and r with l f = r.
type Forms = (Poly, Poly);

impl Finder<'_, '_> {
    /// Returns the product of a quotient and facts, as a quotient of forms.
    pub fn form(&mut self, signed: &SignedRatio, facts: &[usize]) -> Result<Ratio> {
        let (left, right) = self.forms(&signed.num)?;
        let (den, rest) = self.cancelled(signed.den.of(), facts);
        let (left_of_den, right_of_den) = match self.by_largest_errors(&den) {
            Some(forms) => forms,
            None => {
                let den = choice::sign(&den, &self.guide.signs);
                self.forms(&den.ok_or("the sign of a denominator")?)?
            }
        };
        let form = Ratio::from(right * left_of_den).checked_div(&(right_of_den * left).into());
        let mut form = form.ok_or("a zero denominator")?;
        for i in rest {
            form = form * Ratio::from(self.variable(i));
        }
        let Some(multiple) = &signed.subtracted else { return Ok(form) };
        let retained = self.guide.assumptions[multiple.of].fact.as_ref().ok_or("a retained quantity")?;
        Ok(self.form(&multiple.factor, facts)? * self.assumed(retained)? + form)
    }

    /// Divides a denominator by those of the facts that divide it. Returns the rest of it, and of the facts.
    fn cancelled(&self, den: &Poly, facts: &[usize]) -> (Poly, Vec<usize>) {
        let (mut den, mut rest) = (den.clone(), Vec::new());
        for i in facts {
            let fact = self.proof.state.facts.get(*i).map(|(of, _)| self.guide.reduced(of));
            let quotient = fact.ok().filter(|fact| fact.den().is_one() && !fact.is_zero());
            match quotient.and_then(|fact| den.checked_div(fact.num())) {
                Some(quotient) => den = quotient,
                None => rest.push(*i),
            }
        }
        (den, rest)
    }

    /// Returns the forms of a denominator by lemmas about its factors 2ᵖ + 1 + e.
    fn by_largest_errors(&mut self, of: &Poly) -> Option<Forms> {
        let original = self.guide.original(&of.clone().into());
        let (rest, product) = self.without_largest_errors(original.num()).ok()?;
        if product.is_one() || !original.den().is_one() {
            return None;
        }
        let rest = self.guide.reduce(&rest.into());
        let form = self.form(&self.guide.sign(rest)?, &[]).ok()?;
        Some((form.den().clone(), form.num() * product))
    }

    /// Divides a value in original variables by its factors 2ᵖ + 1 + e. Returns the rest, and the product of lemmas
    /// about them.
    pub fn without_largest_errors(&mut self, of: &Poly) -> Result<(Poly, Poly)> {
        let (mut rest, mut product) = (of.clone(), Poly::constant(1));
        for factor in self.guide.largest_errors(of) {
            while let Some(quotient) = rest.checked_div(&factor) {
                rest = quotient;
                product = product * self.lemma(&factor)?;
            }
        }
        Ok((rest, product))
    }

    fn forms(&mut self, of: &SignCertificate) -> Result<Forms> {
        match of.rule() {
            Rule::Terms => Ok((Poly::constant(1), of.of().clone())),
            Rule::Square { leading, root, rest } => self.square(leading, root, rest),
            Rule::Endpoints { x, at } => self.ends(*x, at),
        }
    }

    /// Returns 4 a f = r² + d.
    fn square(&mut self, leading: &Poly, root: &Poly, rest: &Poly) -> Result<Forms> {
        let original = self.guide.original(&root.clone().into());
        let [value] = integral([original.num()]);
        let scale = original.checked_div(&value.clone().into()).ok_or("a zero root")?;
        if [scale.num(), scale.den()].into_iter().any(|part| part.terms().len() != 1) {
            return Err("the scale of a root".into());
        }
        let of = polynomial(&value).ok_or("a root")?;
        let fact = self.proof.add(Step::Square(of))?;
        let square = &scale * &scale * Ratio::from(self.variable(fact));
        Ok((Poly::constant(4) * leading * square.den(), square.num() + rest * square.den()))
    }

    /// Returns 2ⁿ f = Σ bᵢ (1 + x)ⁱ (1 − x)ⁿ⁻ⁱ.
    fn ends(&mut self, x: usize, at: &[SignCertificate]) -> Result<Forms> {
        let forms: Vec<Forms> = at.iter().map(|end| self.forms(end)).collect::<Result<_>>()?;
        let (one, x) = (Poly::constant(1), Poly::variable(x));
        let lower = self.lemma(&(&one + &x))?;
        let upper = self.lemma(&(&one - &x))?;
        let all = forms.iter().fold(one, |all, (left, _)| all * left);
        let mut sum = Poly::zero();
        for (i, (left, right)) in forms.iter().enumerate() {
            let others = all.checked_div(left).ok_or("a zero form")?;
            sum = sum
                + (1..at.len()).fold(right * others, |term, k| term * if k <= i { &lower } else { &upper });
        }
        Ok(((1..at.len()).fold(all, |all, _| all * Poly::constant(2)), sum))
    }
}
