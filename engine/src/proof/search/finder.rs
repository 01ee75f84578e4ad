//! The search for certificates.

use super::Failure;
use super::algebra::{Monomial, Poly, Ratio};
use super::assumption::{AssumptionUse, SignedRatio};
use super::dictionary::opaque;
use super::knowledge::{AssumedFact, Knowledge};
use super::symbol::Symbol;
use crate::proof::check::{Certificate, Known, MAX_VARIABLES, Polynomial, State};

/// Maximum nesting of lemmas.
const MAX_DEPTH: u32 = 4;

/// The result of a part of a search.
pub type Result<T> = std::result::Result<T, Failure>;

/// A search for one certificate.
pub struct Finder<'a, 'p> {
    pub guide: &'a Knowledge<'a>,
    pub state: &'a State<'p>,
    pub quantities: Vec<Known>,
    /// The nesting of the certificate in others.
    pub depth: u32,
}

impl<'a, 'p> Finder<'a, 'p> {
    fn new(guide: &'a Knowledge<'a>, state: &'a State<'p>, depth: u32) -> Self {
        Finder { guide, state, quantities: Vec::new(), depth }
    }

    /// Returns a certificate for a polynomial whose quotient by these facts has this sign.
    pub fn find(
        guide: &'a Knowledge<'a>,
        of: &Polynomial,
        den: &[usize],
        signed: &SignedRatio,
        state: &'a State<'p>,
    ) -> Result<Certificate> {
        Finder::new(guide, state, 0).certificate(of, den, signed)
    }

    /// Returns a certificate for a multiple, or divisor, of a fact about an order of rounded formulas.
    pub fn by_order(guide: &'a Knowledge<'a>, of: &Polynomial, state: &'a State<'p>) -> Option<Certificate> {
        let value = guide.poly(of, state);
        for (i, (fact, _)) in state.facts.iter().enumerate().rev() {
            let fact = guide.poly(fact, state);
            let (quotient, is_multiple) = match value.checked_div(&fact) {
                Some(quotient) => (quotient, true),
                None => match fact.checked_div(&value) {
                    Some(quotient) => (quotient, false),
                    None => continue,
                },
            };
            let reduced = guide.context.reduce(&quotient.into());
            let Some(signed) = guide.sign(reduced) else { continue };
            let mut finder = Finder::new(guide, state, 0);
            let found = finder.form(&signed, &[]).and_then(|form| finder.without_slacks(form));
            let (Ok(form), symbol) = (found, finder.fact(i)) else { continue };
            let symbol = Ratio::from(symbol);
            let form = if is_multiple { Some(form * symbol) } else { symbol.checked_div(&form) };
            if let Ok(found) = finder.equated(of, form?)
                && state.certify(of, &found).is_ok()
            {
                return Some(found);
            }
        }
        None
    }

    /// Returns the variable of a quantity, which becomes part of the certificate. If there are too many, the
    /// checker refuses it.
    pub fn quantity(&mut self, known: Known) -> Poly {
        let index = self.quantities.iter().position(|other| *other == known);
        let i = index.unwrap_or_else(|| {
            self.quantities.push(known);
            self.quantities.len() - 1
        });
        let first = self.state.problem.table.atoms().len();
        Poly::variable((first + i).min(MAX_VARIABLES - 1))
    }

    /// Returns the polynomial of a fact: its number if it is one.
    pub fn fact(&mut self, i: usize) -> Poly {
        match self.state.facts.get(i) {
            Ok((of, _)) if of.has_only(|_| false) => opaque(of),
            _ => self.quantity(Known::Fact(i)),
        }
    }

    /// Returns the polynomial of a lemma about a value in original variables.
    pub fn lemma(&mut self, value: &Poly) -> Result<Poly> {
        if self.depth >= MAX_DEPTH {
            return Err("too deep".into());
        }
        let of = self.guide.polynomial(value, self.state).ok_or("a lemma")?;
        let signed = self.guide.sign(self.guide.reduced(&of, self.state)).ok_or("the sign of a lemma")?;
        let mut finder = Finder::new(self.guide, self.state, self.depth + 1);
        let certificate = finder.certificate(&of, &[], &signed)?;
        self.state.certify(&of, &certificate)?;
        Ok(self.quantity(Known::Lemma((of, certificate).into())))
    }

    fn certificate(&mut self, of: &Polynomial, den: &[usize], signed: &SignedRatio) -> Result<Certificate> {
        let form = self.form(signed, den)?;
        let form = self.without_slacks(form)?;
        self.equated(of, form)
    }

    /// Returns the certificate for l and r in original variables and quantities, with integers as coefficients.
    pub fn finished(&self, left: &Poly, right: &Poly) -> Result<Certificate> {
        let [left, right] = [left, right].map(|of| self.guide.polynomial(of, self.state).ok_or("a form"));
        Ok(Certificate { known: self.quantities.clone(), left: left?, right: right? })
    }

    /// Returns the quantity of an assumption as a quotient of facts.
    pub fn assumed(&mut self, AssumedFact { fact, den, scale }: &AssumedFact) -> Result<Ratio> {
        let mut value = scale * Ratio::from(self.fact(*fact));
        for i in den {
            value = value.checked_div(&self.fact(*i).into()).ok_or("a zero fact")?;
        }
        Ok(value)
    }

    /// Replaces slack variables by facts.
    pub fn without_slacks(&mut self, mut form: Ratio) -> Result<Ratio> {
        let guide = self.guide;
        for (i, assumption) in guide.context.assumptions.iter().enumerate().rev() {
            let (AssumptionUse::Pivot(_, _, Some(x)) | AssumptionUse::Variable(x)) = &assumption.usage else {
                continue;
            };
            let pivot = Monomial::of(*x);
            let assumed = guide.facts.get(i).and_then(Option::as_ref);
            let Some(assumed) = assumed.filter(|_| form.contains(&pivot)) else { continue };
            let is_variable = self.state.facts.get(assumed.fact)?.0.as_variable().is_some();
            if is_variable && matches!(guide.context.symbol(*x), Some(Symbol::Own(_))) {
                continue;
            }
            let mut by = self.assumed(assumed)?;
            if let Some(divisor) = &assumption.divisor {
                by = by.checked_div(divisor).ok_or("a zero divisor")?;
            }
            form = form.replace(&pivot, &by);
        }
        Ok(form)
    }
}
