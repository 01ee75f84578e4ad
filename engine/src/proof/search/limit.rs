//! The steps that a limit requires: the signs of leading coefficients.

use super::finder::Result;
use super::leaf::Search;
use crate::proof::check::{Atom, Quotient};

impl Search<'_> {
    /// Shows the signs of the leading coefficients of a quantity in the variable of the limit.
    pub fn show_leading(&mut self, of: &Quotient) -> Result<()> {
        let Some(by) = self.problem().variable() else { return Ok(()) };
        let x = self.problem().table.variable(Atom::Own(by))?;
        let (_, coefficients) = self.proof.state.leading(of, x)?;
        coefficients.iter().try_for_each(|of| self.show_part(of))
    }

    /// Shows what a limit requires.
    pub fn limit(&mut self, of: usize, by: &'static str, to: usize) -> Result<()> {
        let (of, to) = (self.value(of)?, self.value(to)?);
        let x = self.problem().table.variable(Atom::Own(by))?;
        for y in self.exponentials.clone() {
            if of.num.degree(y) > 0 && self.problem().varies(y) {
                let exponent = self.proof.state.exponent(y)?;
                self.show_leading(&exponent)?;
            }
        }
        let num = self.proof.state.without_vanishing_terms(&of.num, x)?;
        let (_, coefficients) = self.proof.state.leading(&Quotient { num, den: of.den.clone() }, x)?;
        coefficients[1..].iter().try_for_each(|of| self.show_part(of))?;
        let found = self.proof.state.limit_of(&of, x)?;
        let difference = self.proof.state.facts.sum(&found, -1, &to)?;
        self.show_part(&difference.num)
    }
}
