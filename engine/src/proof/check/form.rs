//! Forms, and the one rule for signs.

use super::polynomial::{MAX_VARIABLES, Polynomial, Powers};
use super::sign::Sign;
use super::state::State;
use super::{Certificate, Checked, Known, MAX_NESTING, Refusal};
use crate::proof::effort::Effort;

/// The knowledge about a variable of a form.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// It has a sign.
    Signed(Sign),
    /// It is between −1 and 1.
    Unit,
    /// It may be any number.
    Free,
}

impl State<'_> {
    /// Returns the sign of a polynomial f with l f = r, for the forms l and r of a certificate.
    pub fn certify(&self, of: &Polynomial, certificate: &Certificate) -> Checked<Sign> {
        self.certify_nested(of, certificate, MAX_NESTING)
    }

    fn certify_nested(&self, of: &Polynomial, certificate: &Certificate, nesting: u32) -> Checked<Sign> {
        let (kinds, values) = self.quantities(of, certificate, nesting)?;
        let factor = sign_of_form(&certificate.left, &kinds)?;
        if !factor.is_strict() {
            return Err(Refusal::NotStrict);
        }
        let sign = sign_of_form(&certificate.right, &kinds)?.times(factor);
        let [left, right] = self.sides(of, certificate, &values)?;
        if left == right { Ok(sign) } else { Err(Refusal::Identity) }
    }

    /// Returns l f − r, which is 0 for a correct certificate.
    pub fn difference(&self, of: &Polynomial, certificate: &Certificate) -> Checked<Polynomial> {
        let (_, values) = self.quantities(of, certificate, MAX_NESTING)?;
        let [left, right] = self.sides(of, certificate, &values)?;
        left.plus_multiple(-1, &right, &self.facts.effort)
    }

    /// Returns what is known of the variables of a certificate, and the values of its quantities.
    fn quantities(
        &self,
        of: &Polynomial,
        certificate: &Certificate,
        nesting: u32,
    ) -> Checked<(Vec<Kind>, Vec<Polynomial>)> {
        let Certificate { known, left, right } = certificate;
        let first = self.problem.table.atoms().len();
        let count = first.saturating_add(known.len());
        if count > MAX_VARIABLES {
            return Err(Refusal::TooLarge);
        }
        let mut kinds: Vec<_> = (0..first).map(|x| self.kind(x)).collect();
        let mut values = Vec::with_capacity(known.len());
        for quantity in known {
            let (value, kind) = self.known(quantity, nesting)?;
            kinds.push(kind);
            values.push(value);
        }
        // Quantities that form a variable of a form do not contain such variables themselves.
        let is_known = values.iter().chain([of]).all(|value| value.has_only(|x| x < first))
            && [left, right].into_iter().all(|form| form.has_only(|x| x < count));
        if is_known { Ok((kinds, values)) } else { Err(Refusal::Unknown) }
    }

    /// Returns l f and r as polynomials of atoms.
    fn sides(
        &self,
        of: &Polynomial,
        certificate: &Certificate,
        values: &[Polynomial],
    ) -> Checked<[Polynomial; 2]> {
        let first = self.problem.table.atoms().len();
        let effort = &self.facts.effort;
        let left = expand(&certificate.left, first, values, effort)?.times(of, effort)?;
        Ok([left, expand(&certificate.right, first, values, effort)?])
    }

    fn kind(&self, x: usize) -> Kind {
        match self.signs[x] {
            _ if self.problem.table.is_unit(x) => Kind::Unit,
            Some(sign) => Kind::Signed(sign),
            None => Kind::Free,
        }
    }

    /// Returns a quantity and what is known about it.
    fn known(&self, quantity: &Known, nesting: u32) -> Checked<(Polynomial, Kind)> {
        Ok(match quantity {
            Known::Fact(i) => {
                let (of, sign) = self.facts.get(*i)?;
                (of.clone(), Kind::Signed(*sign))
            }
            Known::Value(of) => (of.clone(), Kind::Free),
            Known::Lemma(lemma) => {
                let nesting = nesting.checked_sub(1).ok_or(Refusal::TooLarge)?;
                let sign = self.certify_nested(&lemma.0, &lemma.1, nesting)?;
                (lemma.0.clone(), Kind::Signed(sign))
            }
            Known::Exponents { left, right } => {
                (self.difference_of_exponentials(left, right)?, Kind::Signed(Sign::Zero))
            }
        })
    }

    /// Returns the difference of two products of exponentials whose exponents have the same sum.
    fn difference_of_exponentials(&self, left: &[usize], right: &[usize]) -> Checked<Polynomial> {
        let sum = |all: &[usize]| {
            all.iter().try_fold(Polynomial::zero().into(), |sum, x| {
                self.facts.sum(&sum, 1, self.exponent(*x).ok_or(Refusal::Unknown)?)
            })
        };
        if !self.facts.are_equal(&sum(left)?, &sum(right)?)? {
            return Err(Refusal::Exponents);
        }
        let product = |all: &[usize]| {
            all.iter().try_fold(Polynomial::constant(1), |product, x| {
                product.times(&Polynomial::variable(*x)?, &self.facts.effort)
            })
        };
        product(left)?.plus_multiple(-1, &product(right)?, &self.facts.effort)
    }
}

/// Returns a form as a polynomial of atoms.
fn expand(form: &Polynomial, first: usize, values: &[Polynomial], effort: &Effort) -> Checked<Polynomial> {
    let mut values = values.iter().enumerate();
    values.try_fold(form.clone(), |form, (i, value)| form.replace(first + i, value, effort))
}

/// Returns the sign of a form, term by term.
fn sign_of_form(form: &Polynomial, kinds: &[Kind]) -> Checked<Sign> {
    for side in [Sign::NonNegative, Sign::NonPositive] {
        if let Some(sign) = sign_by_bound(form, kinds, side)? {
            return Ok(sign);
        }
    }
    Err(Refusal::Form)
}

/// Returns the sign of a form f if that of a form g follows from its terms, where f − g has the sign `side`.
///
/// In g there are no factors between −1 and 1. A term in which these are all squares is dropped if it has
/// the sign `side`; any other term with such factors is replaced by its absolute value without them, or by
/// minus that for f ≥ g.
fn sign_by_bound(form: &Polynomial, kinds: &[Kind], side: Sign) -> Checked<Option<Sign>> {
    let (mut bound, mut difference) = (Vec::new(), Sign::Zero);
    for (powers, number) in form.terms() {
        let (units, others) = split(powers, kinds);
        let Some(sign) = sign_of_powers(&others, kinds) else { return Ok(None) };
        if sign == Sign::Zero {
            continue;
        }
        if units.iter().all(|n| *n == 0) {
            bound.push((others, *number));
            continue;
        }
        difference = side;
        let is_square = units.iter().all(|n| n % 2 == 0);
        if is_square && sign_of_number(*number).times(sign).implies(side) {
            continue;
        }
        let size = number.checked_abs().ok_or(Refusal::TooLarge)?;
        let is_negated = sign.implies(Sign::NonPositive) != (side == Sign::NonNegative);
        bound.push((others, if is_negated { -size } else { size }));
    }
    let bound = Polynomial::new(bound)?;
    let mut terms = bound.terms();
    Ok(terms.try_fold(difference, |sum, (powers, number)| {
        sum.plus(sign_of_number(*number).times(sign_of_powers(powers, kinds)?))
    }))
}

/// Splits a product of powers into that of variables between −1 and 1 and that of the others.
fn split(powers: &Powers, kinds: &[Kind]) -> (Powers, Powers) {
    let (mut units, mut others) = ([0; MAX_VARIABLES], *powers);
    for (x, _) in kinds.iter().enumerate().filter(|(_, kind)| **kind == Kind::Unit) {
        units[x] = std::mem::take(&mut others[x]);
    }
    (units, others)
}

/// Returns the sign of a product of powers.
fn sign_of_powers(powers: &Powers, kinds: &[Kind]) -> Option<Sign> {
    let all = powers.iter().zip(kinds).filter(|(n, _)| **n > 0);
    if all.clone().any(|(_, kind)| *kind == Kind::Signed(Sign::Zero)) {
        return Some(Sign::Zero);
    }
    all.map(|(n, kind)| match (kind, n % 2 == 0) {
        (Kind::Signed(sign), false) => Some(*sign),
        (Kind::Signed(sign), true) => Some(sign.times(*sign)),
        (_, true) => Some(Sign::NonNegative),
        (_, false) => None,
    })
    .try_fold(Sign::Positive, |product, sign| Some(product.times(sign?)))
}

/// Returns the sign of a coefficient, which is not 0.
fn sign_of_number(n: i128) -> Sign {
    if n < 0 { Sign::Negative } else { Sign::Positive }
}
