//! Forms for the six rules.

use super::Failure;
use super::algebra::{FIRST_SLACK, Poly, Ratio};
use super::assumption::SignedRatio;
use super::choice;
use super::dictionary::{integral, opaque};
use super::finder::{Finder, Result};
use super::rules::{Certificate, Rule};
use crate::formula::Relation;
use crate::proof;
use crate::proof::check::{Known, Leaf, Node, Polynomial, Rise, Sign};

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
                let den = choice::sign(&den, &self.guide.context.signs);
                self.forms(&den.ok_or("the sign of a denominator")?)?
            }
        };
        let form = Ratio::from(right * left_of_den).checked_div(&(right_of_den * left).into());
        let mut form = form.ok_or("a zero denominator")?;
        for i in rest {
            form = form * Ratio::from(self.fact(i));
        }
        let Some(multiple) = &signed.subtracted else { return Ok(form) };
        let retained = self.guide.retained(&multiple.of).ok_or("a retained quantity")?;
        Ok(self.form(&multiple.factor, facts)? * self.assumed(retained)? + form)
    }

    /// Divides a denominator by those of the facts that divide it. Returns the rest of it, and of the facts.
    fn cancelled(&self, den: &Poly, facts: &[usize]) -> (Poly, Vec<usize>) {
        let (mut den, mut rest) = (den.clone(), Vec::new());
        for i in facts {
            let fact = self.state.facts.get(*i).map(|(of, _)| self.guide.reduced(of, self.state));
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
        let rest = self.guide.context.reduce(&rest.into());
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

    fn forms(&mut self, of: &Certificate) -> Result<Forms> {
        match of.rule() {
            Rule::Terms => Ok((Poly::constant(1), of.of().clone())),
            Rule::Product(factor, rest) => {
                let (left, right) = self.forms(factor)?;
                let (left_of_rest, right_of_rest) = self.forms(rest)?;
                Ok((left * left_of_rest, right * right_of_rest))
            }
            Rule::Square { leading, root, rest } => self.square(leading, root, rest),
            Rule::Endpoints { x, at } => self.ends(*x, at),
            Rule::MeanValue { x, start, slope } => self.slope(of, *x, [start.sign(), slope.sign()]),
        }
    }

    /// Returns 4 a f = r² + d.
    fn square(&mut self, leading: &Certificate, root: &Poly, rest: &Certificate) -> Result<Forms> {
        let (left_of_leading, leading) = self.forms(leading)?;
        let (left_of_rest, rest) = self.forms(rest)?;
        let original = self.guide.original(&root.clone().into());
        let (value, _) = integral(original.num(), original.num());
        let scale = original.checked_div(&value.clone().into()).ok_or("a zero root")?;
        if [scale.num(), scale.den()].into_iter().any(|part| part.terms().len() != 1) {
            return Err("the scale of a root".into());
        }
        let of = self.guide.polynomial(&value, self.state).ok_or("a root")?;
        let root = scale * Ratio::from(self.quantity(Known::Value(of)));
        let square = &root * &root;
        let left = Poly::constant(4) * leading * &left_of_rest * square.den();
        let right = &left_of_leading * left_of_rest * square.num() + left_of_leading * rest * square.den();
        Ok((left, right))
    }

    /// Returns 2ⁿ f = Σ bᵢ (1 + x)ⁱ (1 − x)ⁿ⁻ⁱ.
    fn ends(&mut self, x: usize, at: &[Certificate]) -> Result<Forms> {
        let forms: Vec<Forms> = at.iter().map(|end| self.forms(end)).collect::<Result<_>>()?;
        let (one, x) = (Poly::constant(1), Poly::variable(x));
        let lower = self.bound(&(&one + &x))?;
        let upper = self.bound(&(&one - &x))?;
        let all = forms.iter().fold(one, |all, (left, _)| all * left);
        let mut sum = Poly::zero();
        for (i, (left, right)) in forms.iter().enumerate() {
            let others = all.checked_div(left).ok_or("a zero form")?;
            sum = sum
                + (1..at.len()).fold(right * others, |term, k| term * if k <= i { &lower } else { &upper });
        }
        Ok(((1..at.len()).fold(all, |all, _| all * Poly::constant(2)), sum))
    }

    /// Returns a lemma about 1 + x or 1 − x, which is a form itself.
    fn bound(&mut self, value: &Poly) -> Result<Poly> {
        let of = self.guide.polynomial(value, self.state).ok_or("a unit")?;
        let (known, left, right) = (Vec::new(), Polynomial::constant(1), of.clone());
        let certificate = proof::check::Certificate { known, left, right };
        Ok(self.quantity(Known::Lemma((of, certificate).into())))
    }

    /// Returns the forms of a function whose sign follows from that of its slope.
    fn slope(&mut self, of: &Certificate, x: usize, signs: [Sign; 2]) -> Result<Forms> {
        let original = self.guide.original(&of.of().clone().into());
        for i in 0..self.state.facts.iter().len() {
            let Some(scale) = self.scale(&original, i) else { continue };
            let symbol = self.fact(i);
            return Ok((scale.den().clone(), scale.num() * symbol));
        }
        if x >= FIRST_SLACK {
            return Err("the slope in a slack variable".into());
        }
        let is_falling = of.sign().implies(Sign::NonPositive);
        let num = if is_falling { -original.num() } else { original.num().clone() };
        let (num, _) = integral(&num, &num);
        let of = self.guide.polynomial(&num, self.state).ok_or("a function that rises")?;
        let [start, slope] = signs.map(|sign| relation(if is_falling { sign.negated() } else { sign }));
        let (start, slope) = (start.ok_or("the sign of a start")?, slope.ok_or("the sign of a slope")?);
        let parts = [(); 3].map(|()| Node::Leaf(Leaf::default().into()));
        Err(Failure::Rise(Rise { of, x, start, slope, parts }.into()))
    }

    /// Returns the quotient of a value and a fact if it is one of single terms.
    fn scale(&self, original: &Ratio, fact: usize) -> Option<Ratio> {
        let (fact, _) = self.state.facts.get(fact).ok()?;
        let fact = opaque(fact);
        let scale = if original.num().has_exponentials() {
            let num = self.guide.without_exponentials(original.num(), self.state)?;
            let [a, b] = [&num, &fact].map(|of| of.terms().last().map(|(_, q)| Poly::constant(q.clone())));
            let (a, b) = (a?, b?);
            if &num * &b != &fact * &a {
                return None;
            }
            Ratio::from(a).checked_div(&(b * original.den()).into())?
        } else {
            original.checked_div(&fact.into())?
        };
        let is_simple = [scale.num(), scale.den()].into_iter().all(|part| part.terms().len() == 1);
        is_simple.then_some(scale)
    }
}

fn relation(sign: Sign) -> Option<Relation> {
    match sign {
        Sign::Positive => Some(Relation::Positive),
        Sign::NonNegative => Some(Relation::NonNegative),
        Sign::Zero => Some(Relation::Zero),
        Sign::Negative | Sign::NonPositive => None,
    }
}
