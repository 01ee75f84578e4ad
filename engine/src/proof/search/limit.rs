//! The steps that a limit requires: the signs of leading coefficients.

use super::finder::Result;
use super::leaf::Search;
use crate::proof::check::{Quotient, Refusal};

impl Search<'_> {
    /// Shows the signs of the leading coefficients of a quantity in the variable of the limit.
    pub fn show_leading(&mut self, of: &Quotient) -> Result<()> {
        let (_, coefficients) = self.proof.state.leading(of)?;
        coefficients.iter().try_for_each(|of| self.show_part(of))
    }

    /// Shows what the limit of a quantity requires.
    pub fn limit(&mut self, of: &Quotient) -> Result<()> {
        for [y, _] in self.exponentials.clone() {
            if of.num.degree(y) > 0 && self.sequent().varies(y) {
                let exponent = self.proof.state.exponent(y)?;
                self.show_leading(&exponent)?;
            }
        }
        let num = self.proof.state.without_vanishing_terms(&of.num)?;
        let (_, coefficients) = self.proof.state.leading(&Quotient { num, den: of.den.clone() })?;
        coefficients[1..].iter().try_for_each(|of| self.show_part(of))?;
        for (difference, sign) in self.proof.state.goals()? {
            self.show_part(&difference.num)?;
            if !self.proof.state.facts.have(&difference, sign) {
                return Err(Refusal::Limit.into());
            }
        }
        Ok(())
    }
}
