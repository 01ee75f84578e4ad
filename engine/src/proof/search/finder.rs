//! The search for certificates.

use super::ProofError;
use super::algebra::{FIRST_SLACK, Monomial, Poly, Ratio};
use super::assumption::{AssumedFact, AssumptionUse, SignedRatio};
use super::context::Context;
use super::dictionary::polynomial;
use super::symbol::Symbol;
use crate::proof::check::{Certificate, Knowledge, Polynomial, Step};

/// Maximum nesting of lemmas.
const MAX_DEPTH: u32 = 4;

/// The result of a part of a search.
pub type Result<T> = std::result::Result<T, ProofError>;

/// The steps so far, and the knowledge of the checker after them.
pub struct Steps<'a> {
    pub state: Knowledge<'a>,
    pub steps: Vec<Step>,
}

impl Steps<'_> {
    /// Adds a step, and returns the number of the last fact.
    pub fn add(&mut self, step: Step) -> Result<usize> {
        self.state.apply(&step)?;
        self.steps.push(step);
        Ok(self.state.facts.all.len() - 1)
    }
}

/// A search for one certificate.
pub struct Finder<'f, 'p> {
    pub guide: &'f Context,
    pub proof: &'f mut Steps<'p>,
    /// The facts in it.
    facts: Vec<usize>,
    /// Number of lemmas that may be nested in the certificate.
    depth: u32,
}

impl<'f, 'p> Finder<'f, 'p> {
    fn new(guide: &'f Context, proof: &'f mut Steps<'p>, depth: u32) -> Self {
        Finder { guide, proof, facts: Vec::new(), depth }
    }

    /// Shows a polynomial whose quotient by these facts has this sign.
    pub fn show(
        guide: &'f Context,
        of: &Polynomial,
        den: &[usize],
        signed: &SignedRatio,
        proof: &'f mut Steps<'p>,
    ) -> Result<()> {
        Finder::new(guide, proof, MAX_DEPTH).shown(of, den, signed).map(|_| ())
    }

    /// Returns the variable of a fact, which becomes part of the certificate. If there are too many, it is one that
    /// no certificate can have.
    pub fn variable(&mut self, fact: usize) -> Poly {
        let index = self.facts.iter().position(|other| *other == fact);
        let i = index.unwrap_or_else(|| {
            self.facts.push(fact);
            self.facts.len() - 1
        });
        let first = self.proof.state.sequent.table.atoms.len();
        Poly::variable((first + i).min(FIRST_SLACK))
    }

    /// Returns the polynomial of a fact that is shown about a value in original variables.
    pub fn lemma(&mut self, value: &Poly) -> Result<Poly> {
        let depth = self.depth.checked_sub(1).ok_or("too deep")?;
        let state = &self.proof.state;
        let of = polynomial(value).ok_or("a lemma")?;
        let fact = match state.facts.strict(&of) {
            Some(fact) => fact,
            None => {
                let signed = self.guide.sign(self.guide.reduced(&of)).ok_or("the sign of a lemma")?;
                Finder::new(self.guide, self.proof, depth).shown(&of, &[], &signed)?
            }
        };
        Ok(self.variable(fact))
    }

    fn shown(&mut self, of: &Polynomial, den: &[usize], signed: &SignedRatio) -> Result<usize> {
        let form = self.form(signed, den)?;
        let form = self.without_slacks(form)?;
        let certificate = self.equated(of, form)?;
        self.proof.add(Step::Show(of.clone(), certificate))
    }

    /// Returns the certificate for l and r in original variables and facts, with integers as coefficients.
    pub fn finished(&self, left: &Poly, right: &Poly) -> Result<Certificate> {
        let [left, right] = [left, right].map(|of| polynomial(of).ok_or("a form"));
        Ok(Certificate { known: self.facts.clone(), left: left?, right: right? })
    }

    /// Returns the quantity of an assumption as a quotient of facts.
    pub fn assumed(&mut self, AssumedFact { fact, den, scale }: &AssumedFact) -> Result<Ratio> {
        let mut value = scale * Ratio::from(self.variable(*fact));
        for i in den {
            value = value.checked_div(&self.variable(*i).into()).ok_or("a zero fact")?;
        }
        Ok(value)
    }

    /// Replaces slack variables by facts.
    pub fn without_slacks(&mut self, mut form: Ratio) -> Result<Ratio> {
        let guide = self.guide;
        for assumption in guide.assumptions.iter().rev() {
            let (AssumptionUse::Variable(x), Some(assumed)) = (&assumption.usage, &assumption.fact) else {
                continue;
            };
            let is_variable = self.proof.state.facts.get(assumed.fact)?.0.as_variable().is_some();
            let is_original = is_variable && matches!(guide.symbol(*x), Some(Symbol::Own(_)));
            let pivot = Monomial::of(*x);
            if !is_original && form.contains(&pivot) {
                form = form.replace(&pivot, &self.assumed(assumed)?);
            }
        }
        Ok(form)
    }
}
