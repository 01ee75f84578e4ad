//! Quotients of polynomials, whose denominators are products of quantities of strict sign.

use super::polynomial::Polynomial;
use super::sign::Sign;
use super::{Checked, Refusal};
use crate::proof::effort::Effort;

/// A quotient of a polynomial and a product of facts. The product is not multiplied out.
#[derive(Clone, Debug, PartialEq)]
pub struct Quotient {
    /// The numerator.
    pub num: Polynomial,
    /// The factors of the denominator: the numbers of their facts, in ascending order.
    pub den: Vec<usize>,
}

/// The quantities of known sign, in the order in which they became known.
#[derive(Clone, Debug)]
pub struct Facts {
    /// All facts.
    pub all: Vec<(Polynomial, Sign)>,
    /// The effort that is left for arithmetic.
    pub effort: Effort,
}

impl From<Polynomial> for Quotient {
    fn from(num: Polynomial) -> Self {
        Quotient { num, den: Vec::new() }
    }
}

impl Quotient {
    /// Returns the quotient whose denominator has these factors.
    pub fn new(num: Polynomial, mut den: Vec<usize>) -> Self {
        den.sort_unstable();
        Quotient { num, den }
    }

    /// Returns the product.
    pub fn times(&self, other: &Self, effort: &Effort) -> Checked<Self> {
        let den = [&self.den[..], &other.den].concat();
        Ok(Quotient::new(self.num.times(&other.num, effort)?, den))
    }
}

/// Returns what the list `a` has more than `b`.
fn without(a: &[usize], b: &[usize]) -> Vec<usize> {
    let mut rest = a.to_vec();
    for x in b {
        if let Some(i) = rest.iter().position(|y| x == y) {
            rest.remove(i);
        }
    }
    rest
}

impl Facts {
    /// Returns a fact.
    pub fn get(&self, i: usize) -> Checked<&(Polynomial, Sign)> {
        self.all.get(i).ok_or(Refusal::Unknown)
    }

    /// Returns `true` if the facts state that a quotient has a sign.
    pub fn have(&self, of: &Quotient, sign: Sign) -> bool {
        let Ok(sign_of_den) = self.sign_of_product(&of.den) else { return false };
        let states = |(known, known_sign): &(Polynomial, Sign)| {
            known_sign.times(sign_of_den).implies(sign) && *known == of.num
        };
        (of.num.is_zero() && Sign::ZERO.implies(sign)) || self.all.iter().any(states)
    }

    /// Returns the number of the first fact that a polynomial is positive, or negative.
    pub fn strict(&self, of: &Polynomial) -> Option<usize> {
        self.all.iter().position(|(known, sign)| sign.is_strict() && known == of)
    }

    /// Returns the product of facts.
    pub fn product(&self, facts: &[usize]) -> Checked<Polynomial> {
        facts
            .iter()
            .try_fold(Polynomial::constant(1), |product, i| product.times(&self.get(*i)?.0, &self.effort))
    }

    /// Returns the sign of a product of facts.
    pub fn sign_of_product(&self, facts: &[usize]) -> Checked<Sign> {
        facts.iter().try_fold(Sign::POSITIVE, |sign, i| Ok(sign.times(self.get(*i)?.1)))
    }

    /// Returns a + n b.
    pub fn sum(&self, a: &Quotient, n: i128, b: &Quotient) -> Checked<Quotient> {
        let (more, less) = (without(&b.den, &a.den), without(&a.den, &b.den));
        let [left, right] =
            [(a, &more), (b, &less)].map(|(of, factors)| of.num.times(&self.product(factors)?, &self.effort));
        let num = left?.plus_multiple(n, &right?, &self.effort)?;
        Ok(Quotient::new(num, [&a.den[..], &more].concat()))
    }
}
