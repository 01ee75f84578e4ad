//! Forms, and the one rule for signs.

use super::polynomial::{MAX_VARIABLES, Polynomial, Powers};
use super::sign::Sign;
use super::state::Knowledge;
use super::{Certificate, Checked, Refusal};

impl Knowledge<'_> {
    /// Returns the sign of a polynomial f with l f = r, for the forms l and r of a certificate.
    pub fn certify(&self, of: &Polynomial, certificate: &Certificate) -> Checked<Sign> {
        let facts = certificate.known.iter().map(|i| Ok(self.facts.get(*i)?.1));
        let signs: Vec<_> = self.signs.iter().copied().map(Ok).chain(facts).collect::<Checked<_>>()?;
        let factor = self.sign_of_form(&certificate.left, &signs)?;
        if !factor.is_strict() {
            return Err(Refusal::NotStrict);
        }
        let sign = self.sign_of_form(&certificate.right, &signs)?.times(factor);
        let [left, right] = self.sides(of, certificate)?;
        if left == right { Ok(sign) } else { Err(Refusal::Identity) }
    }

    /// Returns l f and r as polynomials of atoms.
    pub fn sides(&self, of: &Polynomial, certificate: &Certificate) -> Checked<[Polynomial; 2]> {
        let Certificate { known, left, right } = certificate;
        let (first, effort) = (self.signs.len(), &self.facts.effort);
        let count = first.saturating_add(known.len());
        if count > MAX_VARIABLES {
            return Err(Refusal::TooLarge);
        }
        if [left, right].into_iter().any(|form| !form.has_only(|x| x < count)) {
            return Err(Refusal::Unknown);
        }
        let [mut left, mut right] = [left.clone(), right.clone()];
        for (x, i) in (first..).zip(known) {
            let fact = &self.facts.get(*i)?.0;
            (left, right) = (left.replace(x, fact, effort)?, right.replace(x, fact, effort)?);
        }
        Ok([left.times(of, effort)?, right])
    }

    /// Returns the sign of a form, term by term, for the signs of its variables.
    fn sign_of_form(&self, form: &Polynomial, signs: &[Sign]) -> Checked<Sign> {
        let bounds =
            [Sign::NON_NEGATIVE, Sign::NON_POSITIVE].map(|side| self.sign_by_bound(form, signs, side));
        let [above, below] = bounds;
        [above?, below?].into_iter().find(|sign| *sign != Sign::ANY).ok_or(Refusal::Form)
    }

    /// Returns the sign of a form f that follows from that of a form g, where f − g has the sign `side`.
    ///
    /// g has no factors between −1 and 1. A term of f with such factors is replaced by a bound: for f ≥ g the smaller of
    /// c and −c, where c is the term without them, or of c and 0 if they are squares; for f ≤ g the larger one.
    fn sign_by_bound(&self, form: &Polynomial, signs: &[Sign], side: Sign) -> Checked<Sign> {
        let (mut bound, mut difference) = (Vec::new(), Sign::ZERO);
        for (powers, number) in form.terms() {
            let is_factor = |x: &usize| powers[*x] > 0 && self.sequent.table.is_unit(*x);
            let (mut others, mut is_square) = (*powers, true);
            let factors: Vec<_> = (0..MAX_VARIABLES).filter(is_factor).collect();
            for x in &factors {
                is_square &= std::mem::take(&mut others[*x]) % 2 == 0;
            }
            match sign_of_term(&others, *number, signs) {
                Sign::ZERO => continue,
                Sign::ANY => return Ok(Sign::ANY),
                _ if factors.is_empty() => bound.push((others, *number)),
                sign => {
                    difference = side;
                    if !sign.implies(side) {
                        bound.push((others, *number));
                    } else if !is_square {
                        bound.push((others, number.checked_neg().ok_or(Refusal::TooLarge)?));
                    }
                }
            }
        }
        let bound = Polynomial::new(bound)?;
        let terms = bound.terms().map(|(powers, number)| sign_of_term(powers, *number, signs));
        Ok(terms.fold(difference, Sign::plus))
    }
}

/// Returns the sign of a term for the signs of its variables.
fn sign_of_term(powers: &Powers, number: i128, signs: &[Sign]) -> Sign {
    let number = if number < 0 { Sign::NEGATIVE } else { Sign::POSITIVE };
    let factors = powers.iter().zip(signs).filter(|(n, _)| **n > 0);
    factors.fold(number, |product, (n, sign)| product.times(sign.power(*n)))
}
