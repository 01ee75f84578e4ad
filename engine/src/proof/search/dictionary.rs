//! Translation between the polynomials of the search and those of the checker.
//!
//! Their variables are the same, but the search replaces pivots by slack variables, and has the exponents of
//! exponentials. A quantity in *original* variables is a polynomial of the search without slack variables. In an
//! *opaque* polynomial exponentials are variables.

use super::algebra::{Monomial, Number, Poly, Ratio};
use super::knowledge::Knowledge;
use crate::proof::check::{Polynomial, Quotient, State};
use rug::Rational;

/// Maximum power of an exponential that is recognised.
const MAX_POWER: u8 = 4;

impl Knowledge<'_> {
    /// Returns a quantity of a derivation in original variables.
    pub fn original(&self, value: &Ratio) -> Ratio {
        let slacks = self.slacks.iter().rev();
        slacks.fold(value.clone(), |value, (slack, by)| value.replace(&Monomial::of(*slack), by))
    }

    /// Returns a polynomial of the checker, with exponentials as such.
    pub fn poly(&self, of: &Polynomial, state: &State) -> Poly {
        let poly = opaque(of);
        if state.exponents.is_empty() {
            return poly;
        }
        let terms = poly.terms().flat_map(|(m, q)| {
            let number = Poly::constant(q.clone());
            let term = m.powers().fold(number, |term, (x, n)| term * self.power(x, n, state));
            term.terms().map(|(m, q)| (m.clone(), q.clone())).collect::<Vec<_>>()
        });
        terms.collect()
    }

    fn power(&self, x: usize, n: u8, state: &State) -> Poly {
        let exponent = state.exponent(x).map(|exponent| self.ratio(exponent, state));
        let factor = exponent.map_or_else(|| Poly::variable(x), Poly::exponential);
        (0..n).fold(Poly::constant(1), |power, _| power * &factor)
    }

    /// Returns a quotient of the checker, without those factors of the denominator that divide the numerator.
    pub fn ratio(&self, of: &Quotient, state: &State) -> Ratio {
        let (mut num, mut den) = (self.poly(&of.num, state), Poly::constant(1));
        for (fact, _) in of.den.iter().filter_map(|i| state.facts.get(*i).ok()) {
            let factor = self.poly(fact, state);
            match num.checked_div(&factor) {
                Some(quotient) => num = quotient,
                None => den = den * factor,
            }
        }
        Ratio::from(num).checked_div(&den.into()).unwrap_or_else(Ratio::zero)
    }

    /// Returns a polynomial of the checker, reduced.
    pub fn reduced(&self, of: &Polynomial, state: &State) -> Ratio {
        self.context.reduce(&self.poly(of, state).into())
    }

    /// Returns a quotient of the checker, reduced.
    pub fn reduced_quotient(&self, of: &Quotient, state: &State) -> Ratio {
        self.context.reduce(&self.ratio(of, state))
    }

    /// Returns a polynomial in original variables as one of the checker.
    pub fn polynomial(&self, of: &Poly, state: &State) -> Option<Polynomial> {
        let of = self.without_exponentials(of, state)?;
        let terms = of.terms().map(|(monomial, number)| Some((monomial.to_powers()?, number.to_integer()?)));
        Polynomial::new(terms.collect::<Option<_>>()?).ok()
    }

    /// Replaces each exponential by a power of a variable.
    pub fn without_exponentials(&self, of: &Poly, state: &State) -> Option<Poly> {
        if !of.has_exponentials() {
            return Some(of.clone());
        }
        let exponents: Vec<_> = state.exponents.iter().map(|(e, x)| (*x, self.ratio(e, state))).collect();
        let reduced: Vec<_> = exponents.iter().map(|(x, e)| (*x, self.context.reduce(e))).collect();
        let terms = of.terms().map(|(monomial, number)| {
            let mut rest = monomial.without_exponential();
            if let Some(exponent) = monomial.exponent() {
                let (x, n) = power_of(exponent, &exponents).or_else(|| power_of(exponent, &reduced))?;
                rest = (0..n).fold(rest, |rest, _| rest.times(&Monomial::of(x)));
            }
            Some((rest, number.clone()))
        });
        terms.collect()
    }
}

/// Returns a polynomial of the checker, whose exponentials remain variables.
pub fn opaque(of: &Polynomial) -> Poly {
    let terms = of.terms();
    terms.map(|(powers, n)| (Monomial::from_powers(powers), Number::from(Rational::from(*n)))).collect()
}

/// Returns a variable and the power of its exponential that has this exponent.
fn power_of(exponent: &Ratio, known: &[(usize, Ratio)]) -> Option<(usize, u8)> {
    (1..=MAX_POWER).find_map(|n| {
        let power = Ratio::from(Poly::constant(i32::from(n)));
        let base = known.iter().find(|(_, known)| (known * &power - exponent).is_zero());
        base.map(|(x, _)| (*x, n))
    })
}

/// Multiplies two polynomials by the same positive number, so that their coefficients are integers without a
/// common divisor.
pub fn integral(a: &Poly, b: &Poly) -> (Poly, Poly) {
    let numbers = a.terms().chain(b.terms()).map(|(_, number)| number);
    let common = numbers.fold(Number::from(0), |common, number| common.common_divisor(number));
    if common.sign().is_eq() {
        return (a.clone(), b.clone());
    }
    let by = Poly::constant(common.recip());
    (a * &by, b * by)
}
