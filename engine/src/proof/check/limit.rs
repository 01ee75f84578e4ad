//! Limits of quotients, by the degrees in the variable.
//!
//! A limit is proved for all values of the other symbols for which those hypotheses hold that do not mention its
//! variable x. The others must hold for all sufficiently large x, which is shown from what is known before them,
//! so they restrict nothing, and two of them cannot contradict each other.
//!
//! Invariant: for these values, *every fact, and every value of a formula, is valid for all sufficiently large x*.
//! A fact is added by
//!
//! - a case: its quantity must not depend on x;
//! - a hypothesis: if it mentions x, [`Knowledge::holds_later`] comes before it;
//! - any other step: it follows, at each x, from facts that are valid there.
//!
//! A translated formula has the value that follows from the facts of that time, among them the branch of a minimum. An
//! interval lets all formulas be translated again, from more facts. A sign that is shown of a quantity without x is
//! valid at some x, and therefore everywhere.

use super::polynomial::Polynomial;
use super::quotient::Quotient;
use super::sign::Sign;
use super::state::Knowledge;
use super::table::Atom;
use super::{Checked, Refusal};
use crate::formula::Relation;
use std::cmp::Ordering;

impl Knowledge<'_> {
    /// Returns the variable of the limit.
    fn variable_of_limit(&self) -> Checked<usize> {
        let by = self.sequent.variable().ok_or(Refusal::Limit)?;
        self.sequent.table.variable(Atom::Own(by))
    }

    /// Returns by how much the degree of the numerator in the variable of the limit exceeds that of the denominator,
    /// and the leading coefficients of the numerator and of the factors of the denominator. They must not depend
    /// on the variable in any other way.
    pub fn leading(&self, of: &Quotient) -> Checked<(i32, Vec<Polynomial>)> {
        let (x, mut parts) = (self.variable_of_limit()?, vec![&of.num]);
        for i in &of.den {
            parts.push(&self.facts.get(*i)?.0);
        }
        if !parts.iter().all(|part| part.has_only(|y| x == y || !self.sequent.varies(y))) {
            return Err(Refusal::Limit);
        }
        let degrees: i32 = parts.iter().map(|part| i32::from(part.degree(x))).sum();
        let coefficients = parts.iter().map(|part| part.coefficient(x, part.degree(x)));
        Ok((2 * i32::from(of.num.degree(x)) - degrees, coefficients.collect()))
    }

    /// Returns the numbers of the facts that these quantities are not 0.
    fn strict(&self, all: &[Polynomial]) -> Checked<Vec<usize>> {
        all.iter().map(|of| self.facts.strict(of).ok_or(Refusal::Limit)).collect()
    }

    /// Returns by how much the degree of a quotient in the variable exceeds 0, and the strict sign of its product of
    /// leading coefficients.
    fn excess(&self, of: &Quotient) -> Checked<(i32, Sign)> {
        let (excess, coefficients) = self.leading(of)?;
        Ok((excess, self.facts.sign_of_product(&self.strict(&coefficients)?)?))
    }

    /// Checks that a hypothesis that mentions the variable of the limit holds for all sufficiently large values.
    pub fn holds_later(&mut self, i: usize) -> Checked<()> {
        let hypothesis = self.sequent.hypotheses[i];
        let value = self.value(self.sequent.values[i])?;
        let is_inequality = self.sequent.intervals[i].is_none() && hypothesis.relation != Relation::Zero;
        if is_inequality && self.excess(&value)?.1 == Sign::POSITIVE { Ok(()) } else { Err(Refusal::Limit) }
    }

    /// Returns the limit of a quotient: 0 if the denominator has the higher degree, and the quotient of the
    /// leading coefficients if the degrees are equal.
    pub fn limit_of(&mut self, of: &Quotient) -> Checked<Quotient> {
        let mut later = (0..self.sequent.hypotheses.len()).filter(|i| self.sequent.mentions_variable(*i));
        if !later.all(|i| self.assumed.contains(&i)) {
            return Err(Refusal::Limit);
        }
        let num = self.without_vanishing_terms(&of.num)?;
        let (excess, mut coefficients) = self.leading(&Quotient { num, den: of.den.clone() })?;
        let den = self.strict(&coefficients.split_off(1))?;
        match excess.cmp(&0) {
            Ordering::Less => Ok(Polynomial::constant(0).into()),
            Ordering::Equal => Ok(Quotient::new(coefficients.swap_remove(0), den)),
            Ordering::Greater => Err(Refusal::Limit),
        }
    }

    /// Returns a polynomial without its terms that contain an exponential, all of which vanish.
    ///
    /// An exponent n/d of polynomials tends to −∞ at least as fast as −a x for some a > 0 if the degree of n
    /// in x is the higher one and the leading coefficients have opposite signs; and e^{−a x} times any power
    /// of x vanishes. So a term vanishes with one of its exponentials if each of its other factors is bounded by
    /// a power of x. Those that a polynomial can have are
    ///
    /// - x itself, a power;
    /// - any quantity that does not depend on x, a constant;
    /// - an exponential that depends on x: it is refused unless it vanishes;
    /// - an absolute value that depends on x: it is refused, because it may grow faster than any power;
    /// - its factor, or the error or parameter of a quantity that depends on x: they are between −1 and 1, but
    ///   are refused like the absolute value.
    pub fn without_vanishing_terms(&mut self, of: &Polynomial) -> Checked<Polynomial> {
        let (mut rest, x) = (of.clone(), self.variable_of_limit()?);
        for y in (0..self.signs.len()).filter(|y| *y != x && of.degree(*y) > 0) {
            if self.sequent.varies(y) {
                let exponent = self.exponent(y).map_err(|_| Refusal::Limit)?;
                let (excess, sign) = self.excess(&exponent)?;
                if excess <= 0 || sign != Sign::NEGATIVE {
                    return Err(Refusal::Limit);
                }
                rest = rest.coefficient(y, 0);
            }
        }
        Ok(rest)
    }
}
