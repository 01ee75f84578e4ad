//! Translation between the polynomials of the search and those of the checker.
//!
//! Their variables are the same, but the search replaces pivots by slack variables. A quantity in *original* variables
//! is a polynomial of the search without slack variables.

use super::algebra::{Monomial, Poly};
use crate::proof::check::Polynomial;
use rug::{Complete, Rational};

/// Returns a polynomial in original variables as one of the checker.
pub fn polynomial(of: &Poly) -> Option<Polynomial> {
    let terms = of
        .terms()
        .map(|(monomial, q)| Some((monomial.to_powers()?, q.numer().to_i128().filter(|_| q.is_integer())?)));
    Polynomial::new(terms.collect::<Option<_>>()?).ok()
}

/// Returns a polynomial of the checker.
pub fn poly(of: &Polynomial) -> Poly {
    let terms = of.terms();
    terms.map(|(powers, n)| (Monomial::from_powers(powers), Rational::from(*n))).collect()
}

/// Multiplies polynomials by the same positive number, so that their coefficients are integers without a common
/// divisor.
pub fn integral<const N: usize>(all: [&Poly; N]) -> [Poly; N] {
    let numbers = all.into_iter().flat_map(|of| of.terms().map(|(_, q)| q));
    let common = numbers.fold(Rational::new(), |common, q| {
        let numerator = common.numer().gcd_ref(q.numer()).complete();
        (numerator, common.denom().lcm_ref(q.denom()).complete()).into()
    });
    let by = if common.is_zero() { common } else { common.recip() };
    all.map(|of| of * Poly::constant(by.clone()))
}
