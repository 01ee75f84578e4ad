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
//! - a hypothesis: if it mentions x, [`Translator::holds_later`] comes before it;
//! - a sign, a divisor or an absolute value: it follows, at each x, from facts that are valid there;
//! - a rise or an order: likewise, and from hypotheses, all of which have been examined when the limit is accepted.
//!
//! A translated formula has the value that follows from the facts of that time, among them the branch of a minimum. An
//! interval lets all formulas be translated again, from more facts. A sign that is shown of a quantity without x is
//! valid at some x, and therefore everywhere.

use super::polynomial::Polynomial;
use super::quotient::Quotient;
use super::sign::Sign;
use super::state::Translator;
use super::table::Atom;
use super::{Checked, Refusal, Source};
use crate::formula::Relation;
use crate::number::Tree;
use std::cmp::Ordering;

impl<S: Source> Translator<'_, S> {
    /// Checks that `of` tends to `to` as a symbol tends to infinity.
    pub fn limit(
        &mut self,
        of: &Tree,
        by: &'static str,
        to: &Tree,
        cases: &[(Polynomial, Sign)],
    ) -> Checked<()> {
        let (of, to) = (self.translate(of)?, self.translate(to)?);
        let problem = self.state.problem;
        let x = problem.table.variable(Atom::Own(by))?;
        let mut later = (0..problem.hypotheses.len()).filter(|i| problem.mentions_variable(*i));
        let is_examined = later.all(|i| self.state.assumed.iter().any(|(known, _)| *known == Some(i)));
        if !is_examined || cases.iter().any(|(case, _)| !case.has_only(|y| !problem.depends(y, by))) {
            return Err(Refusal::Limit);
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

    /// Checks that a hypothesis that mentions the variable of the limit holds for all sufficiently large values.
    pub fn holds_later(&mut self, i: usize, by: &'static str) -> Checked<()> {
        let problem = self.state.problem;
        if problem.hypotheses[i].interval().is_some() || problem.hypotheses[i].relation == Relation::Zero {
            return Err(Refusal::Limit);
        }
        let value = self.value(problem.values[i])?;
        let (_, coefficients) = self.leading(&value, problem.table.variable(Atom::Own(by))?)?;
        if self.sign_of_product(&coefficients)? == Sign::Positive { Ok(()) } else { Err(Refusal::Limit) }
    }

    /// Returns the limit of a quotient: 0 if the denominator has the higher degree, and the quotient of the
    /// leading coefficients if the degrees are equal.
    fn limit_of(&mut self, of: &Quotient, x: usize) -> Checked<Quotient> {
        let num = self.without_vanishing_terms(&of.num, x)?;
        let (excess, mut coefficients) = self.leading(&Quotient { num, den: of.den.clone() }, x)?;
        let den: Vec<_> =
            coefficients.split_off(1).iter().map(|of| self.strict(of)).collect::<Checked<_>>()?;
        match excess.cmp(&0) {
            Ordering::Less => Ok(Polynomial::zero().into()),
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
    fn without_vanishing_terms(&mut self, of: &Polynomial, x: usize) -> Checked<Polynomial> {
        let (mut rest, problem) = (of.clone(), self.state.problem);
        let varies = |y: &usize| *y != x && of.degree(*y) > 0 && problem.depends_on(*y, x);
        for y in (0..problem.table.atoms().len()).filter(varies) {
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
