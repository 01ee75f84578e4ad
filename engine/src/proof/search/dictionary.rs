//! Translation between the polynomials of the search and those of the checker.
//!
//! Their variables are the same, but the search replaces pivots by slack variables. A quantity in *original* variables
//! is a polynomial of the search without slack variables.

use super::algebra::{Monomial, Poly, Ratio};
use super::assumption::AssumptionUse;
use super::context::Context;
use crate::proof::check::{Polynomial, Quotient, State};
use rug::{Complete, Rational};

impl Context {
    /// Returns a quantity of a derivation in original variables.
    pub fn original(&self, value: &Ratio) -> Ratio {
        self.assumptions.iter().rev().fold(value.clone(), |value, assumption| match assumption.usage {
            AssumptionUse::Variable(x) => value.replace(&Monomial::of(x), &assumption.value),
            _ => value,
        })
    }

    /// Returns a quotient of the checker, without those factors of the denominator that divide the numerator.
    pub fn ratio(&self, of: &Quotient, state: &State) -> Ratio {
        let (mut num, mut den) = (poly(&of.num), Poly::constant(1));
        for (fact, _) in of.den.iter().filter_map(|i| state.facts.get(*i).ok()) {
            let factor = poly(fact);
            match num.checked_div(&factor) {
                Some(quotient) => num = quotient,
                None => den = den * factor,
            }
        }
        Ratio::from(num).checked_div(&den.into()).unwrap_or_else(Ratio::zero)
    }

    /// Returns a polynomial of the checker, reduced.
    pub fn reduced(&self, of: &Polynomial) -> Ratio {
        self.reduce(&poly(of).into())
    }

    /// Returns a quotient of the checker, reduced.
    pub fn reduced_quotient(&self, of: &Quotient, state: &State) -> Ratio {
        self.reduce(&self.ratio(of, state))
    }
}

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
