//! Forms, and the one rule for signs.

use super::polynomial::{MAX_VARIABLES, Polynomial, Powers};
use super::sign::Sign;
use super::state::State;
use super::{Certificate, Checked, Refusal};

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
        let kinds = self.kinds(&certificate.known)?;
        let factor = sign_of_form(&certificate.left, &kinds)?;
        if !factor.is_strict() {
            return Err(Refusal::NotStrict);
        }
        let sign = sign_of_form(&certificate.right, &kinds)?.times(factor);
        let [left, right] = self.sides(of, certificate)?;
        if left == right { Ok(sign) } else { Err(Refusal::Identity) }
    }

    /// Returns what is known of the variables of a certificate: of atoms and facts.
    fn kinds(&self, known: &[usize]) -> Checked<Vec<Kind>> {
        let atoms = self.signs.iter().enumerate().map(|(x, sign)| match sign {
            _ if self.problem.table.is_unit(x) => Ok(Kind::Unit),
            Some(sign) => Ok(Kind::Signed(*sign)),
            None => Ok(Kind::Free),
        });
        let facts = known.iter().map(|i| Ok(Kind::Signed(self.facts.get(*i)?.1)));
        atoms.chain(facts).collect()
    }

    /// Returns l f and r as polynomials of atoms.
    pub fn sides(&self, of: &Polynomial, certificate: &Certificate) -> Checked<[Polynomial; 2]> {
        let Certificate { known, left, right } = certificate;
        let (first, effort) = (self.problem.table.atoms().len(), &self.facts.effort);
        let count = first.saturating_add(known.len());
        if count > MAX_VARIABLES {
            return Err(Refusal::TooLarge);
        }
        if !of.has_only(|x| x < first) || [left, right].into_iter().any(|form| !form.has_only(|x| x < count))
        {
            return Err(Refusal::Unknown);
        }
        let expand = |form: &Polynomial| {
            let mut facts = known.iter().zip(first..);
            facts.try_fold(form.clone(), |form, (i, x)| form.replace(x, &self.facts.get(*i)?.0, effort))
        };
        Ok([expand(left)?.times(of, effort)?, expand(right)?])
    }
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
