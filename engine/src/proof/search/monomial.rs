//! Monomials, the products of powers of variables.

use super::algebra::Ratio;
use crate::proof::check::MAX_VARIABLES;
use std::sync::Arc;

/// The first slack variable; the variables before it are those of the checker.
pub const FIRST_SLACK: usize = MAX_VARIABLES;

/// Maximum number of variables: those of the checker and 32 slack variables.
pub const VARIABLES: usize = FIRST_SLACK + 32;

/// The variable in place of a quantity that is too large to be computed. Nothing is known of it.
pub const UNKNOWN: usize = VARIABLES - 1;

/// A product of powers of variables, times e to the power of a quotient, if any.
///
/// One exponential suffices, since eᵃ eᵇ = eᵃ⁺ᵇ. The order of monomials is the lexicographic order of the powers.
/// Multiplication preserves it, which long division requires.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Monomial {
    powers: [u8; VARIABLES],
    pub(super) exponent: Option<Arc<Ratio>>,
}

impl Monomial {
    /// Returns the empty product.
    pub fn one() -> Self {
        Monomial { powers: [0; VARIABLES], exponent: None }
    }

    /// Returns a variable as a monomial.
    pub fn of(x: usize) -> Self {
        let mut one = Monomial::one();
        one.powers[x] = 1;
        one
    }

    /// Returns the product of the powers of the checker's variables.
    pub fn from_powers(powers: &[u8; MAX_VARIABLES]) -> Self {
        let mut product = Monomial::one();
        product.powers[..MAX_VARIABLES].copy_from_slice(powers);
        product
    }

    /// Returns the powers of the checker's variables, if there are no slack variables.
    pub fn to_powers(&self) -> Option<[u8; MAX_VARIABLES]> {
        let (powers, slacks) = self.powers.split_first_chunk()?;
        slacks.iter().all(|n| *n == 0).then_some(*powers)
    }

    /// Returns the variable if the monomial is a single variable.
    pub fn as_variable(&self) -> Option<usize> {
        let mut powers = self.powers().filter(|_| self.exponent.is_none());
        powers.next().filter(|(_, n)| *n == 1 && powers.next().is_none()).map(|(x, _)| x)
    }

    /// Returns the variables with their powers.
    pub fn powers(&self) -> impl Iterator<Item = (usize, u8)> {
        self.powers.iter().copied().enumerate().filter(|(_, n)| *n > 0)
    }

    /// Returns the number of variables.
    pub fn count(&self) -> usize {
        self.powers.iter().map(|n| u8::from(*n > 0)).sum::<u8>().into()
    }

    /// Adds the variables to a set.
    pub fn add_variables(&self, set: &mut [bool; VARIABLES]) {
        set.iter_mut().zip(&self.powers).for_each(|(is_in, n)| *is_in |= *n > 0);
    }

    /// Returns the exponent of e, if any.
    pub fn exponent(&self) -> Option<&Ratio> {
        self.exponent.as_deref()
    }

    /// Returns the product; the [unknown](UNKNOWN) variable if a power would exceed 254, to which only repeated
    /// substitution of pivots leads.
    pub fn times(&self, other: &Self) -> Self {
        let (mut powers, mut largest) = (self.powers, 0);
        for (n, m) in powers.iter_mut().zip(&other.powers) {
            *n = n.saturating_add(*m);
            largest = largest.max(*n);
        }
        if largest == u8::MAX {
            return Monomial::of(UNKNOWN);
        }
        let exponent = match (&self.exponent, &other.exponent) {
            (None, e) | (e, None) => e.clone(),
            (Some(a), Some(b)) => Some(&**a + &**b).filter(|sum| !sum.is_zero()).map(Arc::new),
        };
        Monomial { powers, exponent }
    }

    /// Returns the quotient if the divisor divides `self` and has no e^….
    pub fn checked_div(&self, divisor: &Self) -> Option<Self> {
        if divisor.exponent.is_some() || !self.is_divisible_by(divisor) {
            return None;
        }
        let mut rest = self.clone();
        rest.powers.iter_mut().zip(&divisor.powers).for_each(|(n, m)| *n -= m);
        Some(rest)
    }

    /// Returns `true` if `other` divides `self`, disregarding e^….
    pub fn is_divisible_by(&self, other: &Self) -> bool {
        self.powers.iter().zip(&other.powers).fold(true, |is_divisible, (n, m)| is_divisible & (n >= m))
    }

    /// Returns the greatest common divisor, which has no e^….
    pub fn common(mut self, other: &Self) -> Self {
        self.powers.iter_mut().zip(&other.powers).for_each(|(n, m)| *n = (*n).min(*m));
        self.without_exponential()
    }

    /// Returns the monomial without its e^….
    pub fn without_exponential(&self) -> Self {
        Monomial { powers: self.powers, exponent: None }
    }

    /// Returns the product of the powers of those variables for which `is_in` is `true`, with e^….
    pub fn only(&self, is_in: impl Fn(usize) -> bool) -> Self {
        let mut rest = self.clone();
        rest.powers.iter_mut().enumerate().filter(|(x, _)| !is_in(*x)).for_each(|(_, n)| *n = 0);
        rest
    }

    /// Returns the degree in a variable.
    pub fn degree(&self, x: usize) -> u8 {
        self.powers[x]
    }

    /// Returns the monomial without a variable.
    pub fn without(&self, x: usize) -> Self {
        let mut rest = self.clone();
        rest.powers[x] = 0;
        rest
    }
}
