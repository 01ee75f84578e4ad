//! Polynomials with integer coefficients, whose arithmetic refuses what it cannot represent.

use super::{Checked, Refusal};
use crate::proof::effort::Effort;

/// Maximum number of variables of a polynomial: of the atoms of a goal and the quantities of a certificate.
pub const MAX_VARIABLES: usize = 64;

/// Maximum number of terms of a product, before equal ones are added.
const MAX_TERMS: usize = 1 << 18;

/// The powers of the variables in a term.
pub type Powers = [u8; MAX_VARIABLES];

/// A polynomial: its terms in ascending order of their powers, with nonzero coefficients.
///
/// Two polynomials are the same function if and only if they have the same terms.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Polynomial(Vec<(Powers, i128)>);

impl Polynomial {
    /// Returns the sum of terms, which may come in any order.
    pub fn new(mut terms: Vec<(Powers, i128)>) -> Checked<Self> {
        terms.sort_by(|(a, _), (b, _)| a.as_slice().cmp(b));
        let sums = terms.chunk_by(|(a, _), (b, _)| a == b).map(|equal| {
            let sum = equal.iter().try_fold(0_i128, |sum, (_, number)| sum.checked_add(*number));
            Ok((equal[0].0, sum.ok_or(Refusal::TooLarge)?))
        });
        let mut sums: Vec<_> = sums.collect::<Checked<_>>()?;
        sums.retain(|(_, number)| *number != 0);
        Ok(Polynomial(sums))
    }

    /// Returns the constant `n`.
    pub fn constant(n: i128) -> Self {
        Polynomial((n != 0).then_some(([0; MAX_VARIABLES], n)).into_iter().collect())
    }

    /// Returns the variable `x` as a polynomial.
    pub fn variable(x: usize) -> Checked<Self> {
        let mut powers = [0; MAX_VARIABLES];
        *powers.get_mut(x).ok_or(Refusal::TooLarge)? = 1;
        Ok(Polynomial(vec![(powers, 1)]))
    }

    /// Returns the terms in ascending order: the powers of the variables, and the coefficient.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = &(Powers, i128)> {
        self.0.iter()
    }

    /// Returns `true` if this is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the variable if the polynomial is a single one.
    pub fn as_variable(&self) -> Option<usize> {
        let [(powers, 1)] = &self.0[..] else { return None };
        let x = powers.iter().position(|n| *n > 0)?;
        (powers.iter().map(|n| u32::from(*n)).sum::<u32>() == 1).then_some(x)
    }

    /// Returns `true` if every variable that occurs satisfies a predicate.
    pub fn has_only(&self, is_allowed: impl Fn(usize) -> bool) -> bool {
        self.0.iter().all(|(powers, _)| (0..MAX_VARIABLES).all(|x| powers[x] == 0 || is_allowed(x)))
    }

    /// Returns `self` + `n` `other`.
    pub fn plus_multiple(&self, n: i128, other: &Self, effort: &Effort) -> Checked<Self> {
        effort.spend(self.0.len() + other.0.len()).ok_or(Refusal::TooLarge)?;
        let mut terms = self.0.clone();
        for (powers, number) in &other.0 {
            terms.push((*powers, number.checked_mul(n).ok_or(Refusal::TooLarge)?));
        }
        Polynomial::new(terms)
    }

    /// Returns the product.
    pub fn times(&self, other: &Self, effort: &Effort) -> Checked<Self> {
        if *other == Polynomial::constant(1) {
            return Ok(self.clone());
        }
        let count = self.0.len().saturating_mul(other.0.len());
        effort.spend(count).filter(|()| count <= MAX_TERMS).ok_or(Refusal::TooLarge)?;
        let mut terms = Vec::with_capacity(count);
        // Few long runs of ascending terms are sorted fast.
        let (short, long) = if self.0.len() < other.0.len() { (self, other) } else { (other, self) };
        for (a, p) in &short.0 {
            for (b, q) in &long.0 {
                let (mut powers, mut exceeds) = (*a, false);
                // A loop without an exit is compiled to few instructions.
                for (n, m) in powers.iter_mut().zip(b) {
                    exceeds |= n.checked_add(*m).is_none();
                    *n = n.wrapping_add(*m);
                }
                let number = p.checked_mul(*q).filter(|_| !exceeds);
                terms.push((powers, number.ok_or(Refusal::TooLarge)?));
            }
        }
        Polynomial::new(terms)
    }

    /// Returns the degree in a variable.
    pub fn degree(&self, x: usize) -> u8 {
        self.0.iter().map(|(powers, _)| powers[x]).max().unwrap_or(0)
    }

    /// Returns the coefficient of xⁿ.
    pub fn coefficient(&self, x: usize, n: u8) -> Self {
        let of_power = self.0.iter().filter(|(powers, _)| powers[x] == n);
        let mut rest: Vec<_> = of_power.copied().collect();
        rest.iter_mut().for_each(|(powers, _)| powers[x] = 0);
        // Equal powers of x do not change the order of the others.
        Polynomial(rest)
    }

    /// Replaces a variable by a polynomial.
    pub fn replace(&self, x: usize, by: &Self, effort: &Effort) -> Checked<Self> {
        let degree = self.degree(x);
        if degree == 0 {
            return Ok(self.clone());
        }
        let mut sum = self.coefficient(x, degree);
        for n in (0..degree).rev() {
            sum = sum.times(by, effort)?.plus_multiple(1, &self.coefficient(x, n), effort)?;
        }
        Ok(sum)
    }
}
