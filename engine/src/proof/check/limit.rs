//! Limits of quotients, by the degrees in the variable.

use super::polynomial::Polynomial;
use super::quotient::Quotient;
use super::sign::Sign;
use super::state::{Reader, State};
use super::table::Atom;
use super::{Checked, Refusal, Source};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;
use std::cmp::Ordering;
use std::mem;

impl<'p, S: Source> Reader<'p, S> {
    /// Checks that `of` tends to `to` as a symbol tends to infinity, for all values of the other symbols for
    /// which those hypotheses hold that do not mention it.
    ///
    /// What these hypotheses imply is known early. From it alone follows that the others hold for all
    /// sufficiently large values of the symbol; so for these, all facts are valid.
    pub fn limit(
        &mut self,
        of: &Tree,
        by: &'static str,
        to: &Tree,
        cases: &[(Polynomial, Sign)],
    ) -> Checked<()> {
        let (of, to) = (self.translate(of)?, self.translate(to)?);
        let (problem, early) = (self.state.problem, self.early.clone().ok_or(Refusal::Limit)?);
        let x = problem.table.variable(Atom::Own(by))?;
        if cases.iter().any(|(case, _)| !case.has_only(|y| !problem.depends(y, by))) {
            return Err(Refusal::Limit);
        }
        for hypothesis in problem.hypotheses.iter().filter(|h| h.value.symbols().contains(by)) {
            self.holds_later(hypothesis, x, &early)?;
        }
        let found = self.limit_of(&of, x)?;
        let difference = self.state.facts.sum(&found, -1, &to)?;
        let (sign, _) = self.sign_of_part(&difference.num)?;
        if sign == Sign::Zero { Ok(()) } else { Err(Refusal::Goal) }
    }

    /// Returns by how much the degree of the numerator in the variable exceeds that of the denominator, and
    /// the leading coefficients of the numerator and of the factors of the denominator. They must not depend
    /// on the variable in any other way.
    fn leading(&self, of: &Quotient, x: usize) -> Checked<(i32, Vec<Polynomial>)> {
        let (mut excess, mut coefficients) = (0, Vec::with_capacity(1 + of.den.len()));
        let den = of.den.iter().map(|i| Ok(&self.state.facts.get(*i)?.0));
        for part in [Ok(&of.num)].into_iter().chain(den) {
            let (degree, leading) = part?.leading(x);
            if !part?.has_only(|y| x == y || !self.state.problem.depends_on(y, x)) {
                return Err(Refusal::Limit);
            }
            excess += if coefficients.is_empty() { i32::from(degree) } else { -i32::from(degree) };
            coefficients.push(leading);
        }
        Ok((excess, coefficients))
    }

    fn sign_of_product(&mut self, of: &[Polynomial]) -> Checked<Sign> {
        of.iter().try_fold(Sign::Positive, |sign, factor| Ok(sign.times(self.sign_of_part(factor)?.0)))
    }

    /// Checks that a hypothesis holds for all sufficiently large values of the variable.
    fn holds_later(&mut self, hypothesis: &Hypothesis, x: usize, early: &State<'p>) -> Checked<()> {
        if hypothesis.interval().is_some() || hypothesis.relation == Relation::Zero {
            return Err(Refusal::Limit);
        }
        let value = self.translate(&hypothesis.value)?;
        let (_, coefficients) = self.leading(&value, x)?;
        // The signs are found in the earlier state, and are not added to the later one.
        let later = mem::replace(&mut self.state, early.clone());
        let sign = self.sign_of_product(&coefficients);
        self.state = later;
        if sign? == Sign::Positive { Ok(()) } else { Err(Refusal::Limit) }
    }

    /// Returns the limit of a quotient: 0 if the denominator has the higher degree, and the quotient of the
    /// leading coefficients if the degrees are equal.
    fn limit_of(&mut self, of: &Quotient, x: usize) -> Checked<Quotient> {
        let num = self.without_vanishing_exponentials(&of.num, x)?;
        let (excess, mut coefficients) = self.leading(&Quotient { num, den: of.den.clone() }, x)?;
        let den: Vec<_> =
            coefficients.split_off(1).iter().map(|of| self.strict(of)).collect::<Checked<_>>()?;
        match excess.cmp(&0) {
            Ordering::Less => Ok(Polynomial::zero().into()),
            Ordering::Equal => Ok(Quotient::new(coefficients.swap_remove(0), den)),
            Ordering::Greater => Err(Refusal::Limit),
        }
    }

    /// Returns a polynomial without its terms in which an exponential tends to 0.
    ///
    /// An exponent n/d of polynomials tends to −∞ at least as fast as −a x for some a > 0 if the degree of n
    /// in x is the higher one and the leading coefficients have opposite signs; and e^{−a x} times any power
    /// of x vanishes.
    fn without_vanishing_exponentials(&mut self, of: &Polynomial, x: usize) -> Checked<Polynomial> {
        let (mut rest, problem) = (of.clone(), self.state.problem);
        for (y, atom) in problem.table.atoms().iter().enumerate() {
            let is_exponential = matches!(atom, Atom::Exponential(_)) && of.degree(y) > 0;
            if !is_exponential || !problem.depends_on(y, x) {
                continue;
            }
            // Each one vanishes, so a product of several does.
            let exponent = self.state.exponent(y).ok_or(Refusal::Limit)?.clone();
            let (excess, coefficients) = self.leading(&exponent, x)?;
            if excess <= 0 || self.sign_of_product(&coefficients)? != Sign::Negative {
                return Err(Refusal::Limit);
            }
            rest = rest.coefficient(y, 0);
        }
        Ok(rest)
    }
}
