//! Proofs of limits by Coq's tactics.

use super::super::expr::{Expr, by_exponent};
use super::super::lemma::{Lemma, Result};
use super::retained::Retained;
use super::{Place, Script, derivation};
use crate::formula::{Hypothesis, Proposition};
use crate::proof::kernel::algebra::{Poly, Ratio, Symbol};
use crate::proof::kernel::{Derivation, Justification};

impl Script {
    /// Proves a limit from these hypotheses; the premises of the lemma are those that do not contain the
    /// variable of the limit.
    pub(in crate::proof::coq) fn limit(
        &mut self,
        lemma: &Lemma,
        hypotheses: &[&Hypothesis],
        proposition: &Proposition,
    ) -> Result<()> {
        let derivation = derivation(hypotheses, proposition)?;
        let Derivation::Direct(direct) = &derivation else { return Err("a limit in cases".into()) };
        let Justification::Limit { of, by, .. } = &direct.justification else {
            return Err("no limit".into());
        };
        if !direct.branches.is_empty() {
            return Err("a limit with brackets".into());
        }
        self.hypotheses(&mut Place::new(lemma, proposition, Retained::default()), direct)?;
        self.at_infinity(of, *by)
    }

    /// Proves a limit for x → ∞: rewrites the formula in 1/x and one decaying e^….
    fn at_infinity(&mut self, of: &Ratio, x: Symbol) -> Result<()> {
        let moving = by_exponent(of.num()).into_iter().filter_map(|(e, part)| Some((e?, part)));
        let moving: Vec<_> = moving.filter(|(e, _)| e.symbols().contains(&x)).collect();
        let rest = moving.iter().fold(of.num().clone(), |rest, (exponent, part)| {
            rest - part * Poly::exponential((*exponent).clone())
        });
        let degree = of.den().degree(x);
        // Returns a polynomial of x over x^degree, in y = 1/x.
        let reversed = |poly: &Poly| {
            let terms = (0..=poly.degree(x)).map(|i| {
                (i..degree).fold(poly.coefficient(x, i), |term, _| term * Poly::symbol(Symbol::Own("y")))
            });
            Expr::poly(&terms.fold(Poly::zero(), |sum, term| sum + term))
        };
        let g = reversed(&rest).over(reversed(of.den()));
        match &moving[..] {
            [] => self.line(&format!("at_infinity (fun y : R => {g}).")),
            [(exponent, part)] => {
                let rate = exponent.over(&Poly::symbol(x).into()).ok_or("an exponent is not linear")?;
                let factor =
                    Ratio::from(part.clone()).over(&of.den().clone().into()).ok_or("a divisor is 0")?;
                if rate.symbols().contains(&x) || factor.symbols().contains(&x) {
                    return Err(
                        "an exponential is not that of a constant rate, or has a factor that grows".into()
                    );
                }
                let [factor, rate] = [&factor, &rate].map(|ratio| Expr::ratio(ratio).argument());
                self.line(&format!("with_decay (fun y : R => {g}) {factor} {rate}."));
            }
            _ => return Err("there is more than one exponential".into()),
        }
        Ok(())
    }
}
