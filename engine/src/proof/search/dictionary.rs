//! Translation between the polynomials of the search and those of the checker.
//!
//! Their variables are the same, but the search replaces pivots by slack variables. A quantity in *original* variables
//! is a polynomial of the search without slack variables.

use super::algebra::{Monomial, Number, Poly, Ratio};
use super::knowledge::Knowledge;
use crate::proof::check::{Polynomial, Quotient, State};
use rug::Rational;

impl Knowledge<'_> {
    /// Returns a quantity of a derivation in original variables.
    pub fn original(&self, value: &Ratio) -> Ratio {
        let slacks = self.slacks.iter().rev();
        slacks.fold(value.clone(), |value, (slack, by)| value.replace(&Monomial::of(*slack), by))
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
        self.context.reduce(&poly(of).into())
    }

    /// Returns a quotient of the checker, reduced.
    pub fn reduced_quotient(&self, of: &Quotient, state: &State) -> Ratio {
        self.context.reduce(&self.ratio(of, state))
    }
}

/// Returns a polynomial in original variables as one of the checker.
pub fn polynomial(of: &Poly) -> Option<Polynomial> {
    let terms = of.terms().map(|(monomial, number)| Some((monomial.to_powers()?, number.to_integer()?)));
    Polynomial::new(terms.collect::<Option<_>>()?).ok()
}

/// Returns a polynomial of the checker.
pub fn poly(of: &Polynomial) -> Poly {
    let terms = of.terms();
    terms.map(|(powers, n)| (Monomial::from_powers(powers), Number::from(Rational::from(*n)))).collect()
}

/// Multiplies two polynomials by the same positive number, so that their coefficients are integers without a
/// common divisor.
pub fn integral(a: &Poly, b: &Poly) -> (Poly, Poly) {
    let numbers = a.terms().chain(b.terms()).map(|(_, number)| number);
    let common = numbers.fold(Number::from(0), |common, number| common.common_divisor(number));
    if common.cmp0().is_eq() {
        return (a.clone(), b.clone());
    }
    let by = Poly::constant(common.recip_ref());
    (a * &by, b * by)
}
