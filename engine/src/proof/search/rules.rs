//! Rules for the sign of a polynomial for all values of its symbols.
//!
//! A [`SignCertificate`] is made by one of four rules. The [forms](super::form) of the checker's certificates
//! follow from it.
//!
//! 1. **Terms.** All terms have the same sign, which follows from the known signs of symbols; even powers of
//!    free symbols are not negative. The sign is strict if that of one term is.
//! 2. **Square.** If 4 a f = r² + d with a ≠ 0 and d is not negative, f has the sign of a.
//! 3. **Sizes.** Factors between −1 and 1 do not increase the absolute value of a term. So the polynomial is
//!    bounded from below by the one in which each term with such factors is replaced by minus its absolute value
//!    without them; and likewise from above.
//! 4. **Ends.** A polynomial of degree n in a symbol x between −1 and 1 is a sum of products aⁱ (1 − a)ⁿ⁻ⁱ
//!    with a = (1 + x)/2, none of them negative and not all 0, so it has the common sign of their
//!    coefficients (Bernstein form). In degree one the coefficients are its values at the ends.

use super::algebra::{Monomial, Poly, VARIABLES};
use crate::proof::check::Sign;
use crate::proof::effort::Effort;
use rug::{Complete, Integer, Rational};
use std::iter;

/// The known signs of variables. A variable without a sign is free: it may be any real number, or any between −1
/// and 1.
#[derive(Clone, Debug)]
pub struct SignEnv {
    signs: [Sign; VARIABLES],
    is_unit: [bool; VARIABLES],
    effort: Effort,
}

impl SignEnv {
    /// Creates an environment without signs, in which these variables are between −1 and 1.
    pub fn new(units: impl IntoIterator<Item = usize>, effort: Effort) -> Self {
        let mut env = SignEnv { signs: [Sign::ANY; VARIABLES], is_unit: [false; VARIABLES], effort };
        units.into_iter().for_each(|x| env.is_unit[x] = true);
        env
    }

    /// Returns the known sign of a variable.
    pub fn get(&self, x: usize) -> Sign {
        self.signs[x]
    }

    /// Sets the sign of a variable.
    pub fn set(&mut self, x: usize, sign: Sign) {
        self.signs[x] = sign;
    }

    /// Returns the environment in which a variable has a sign.
    pub fn with(&self, x: usize, sign: Sign) -> Self {
        let mut env = self.clone();
        env.set(x, sign);
        env
    }

    /// Counts an operation on each pair of terms of two polynomials. Returns `None` if the search exceeds its effort.
    pub fn spend(&self, a: &Poly, b: &Poly) -> Option<()> {
        self.effort.spend(a.terms().len().max(1).saturating_mul(b.terms().len().max(1)))
    }

    /// Returns `true` if a variable is between −1 and 1 by definition.
    pub fn is_unit(&self, x: usize) -> bool {
        self.is_unit[x]
    }
}

/// A proof that a polynomial has a sign, for the known signs of symbols.
#[derive(Clone, Debug)]
pub struct SignCertificate {
    of: Poly,
    sign: Sign,
    rule: Rule,
}

/// The rule of a certificate, with the certificates on which it depends.
#[derive(Clone, Debug)]
pub enum Rule {
    /// Rule 1 or 3.
    Terms,
    /// Rule 2, where the signs of a and d follow from their terms.
    Square {
        /// The factor a.
        leading: Poly,
        /// The root r of the square.
        root: Poly,
        /// The rest d.
        rest: Poly,
    },
    /// Rule 4.
    Endpoints {
        /// The variable x.
        x: usize,
        /// The signs of the coefficients, from that at −1 to that at 1.
        at: Box<[SignCertificate]>,
    },
}

impl SignCertificate {
    /// Returns the polynomial.
    pub fn of(&self) -> &Poly {
        &self.of
    }

    /// Returns the sign of the polynomial.
    pub fn sign(&self) -> Sign {
        self.sign
    }

    /// Returns the rule that proves the sign.
    pub fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Applies rule 1.
    pub fn termwise(of: &Poly, known: &SignEnv) -> Option<Self> {
        let sign = of.terms().fold(Sign::ZERO, |sum, (monomial, coefficient)| {
            sum.plus(sign_of_number(coefficient).times(sign_of_monomial(monomial, known)))
        });
        (sign != Sign::ANY).then(|| SignCertificate { of: of.clone(), sign, rule: Rule::Terms })
    }

    /// Applies rule 2 to f = a x² + b x + c: 4 a f = (2 a x + b)² + (4 a c − b²).
    pub fn square(of: &Poly, x: usize, known: &SignEnv) -> Option<Self> {
        let [c, b, a] = of.coefficients(x)?;
        let leading = SignCertificate::termwise(&a, known).filter(|a| a.sign.is_strict())?;
        known.spend(&a, &c).and(known.spend(&b, &b))?;
        let rest = Poly::constant(4) * &a * c - &b * &b;
        let sign = Sign::NON_NEGATIVE.plus(SignCertificate::termwise(&rest, known)?.sign).times(leading.sign);
        let root = Poly::constant(2) * &a * Poly::variable(x) + b;
        let rule = Rule::Square { leading: a, root, rest };
        (sign != Sign::ANY).then(|| SignCertificate { of: of.clone(), sign, rule })
    }

    /// Applies rule 3.
    pub fn triangle_inequality(of: &Poly, known: &SignEnv) -> Option<Self> {
        let (unit_terms, others): (Vec<_>, Vec<_>) =
            of.terms().partition(|(m, _)| m.powers().any(|(x, _)| known.is_unit(x)));
        let sizes = unit_terms.into_iter().map(|(m, q)| size(m, q, known)).collect::<Option<Poly>>()?;
        let others: Poly = others.into_iter().map(|(m, q)| (m.clone(), q.clone())).collect();
        [(Sign::NON_NEGATIVE, &others - &sizes), (Sign::NON_POSITIVE, others + sizes)].iter().find_map(
            |(side, bound)| {
                let sign = SignCertificate::termwise(bound, known)?.sign.plus(*side);
                (sign != Sign::ANY).then(|| SignCertificate { of: of.clone(), sign, rule: Rule::Terms })
            },
        )
    }

    /// Applies rule 4 to a variable between −1 and 1.
    pub fn endpoints(of: &Poly, x: usize, find: impl Fn(&Poly) -> Option<Self>) -> Option<Self> {
        let at: Vec<_> = bernstein(of, x).iter().map(find).collect::<Option<_>>()?;
        // Strict signs come first. The products aⁱ (1 − a)ⁿ⁻ⁱ are not all 0, so they preserve them.
        let signs = [Sign::POSITIVE, Sign::NEGATIVE, Sign::NON_NEGATIVE, Sign::NON_POSITIVE];
        let sign = signs.into_iter().find(|sign| at.iter().all(|c| c.sign.implies(*sign)))?;
        let rule = Rule::Endpoints { x, at: at.into() };
        Some(SignCertificate { of: of.clone(), sign, rule })
    }
}

/// Returns the absolute value of a term without its factors between −1 and 1, if the others have known signs.
fn size(m: &Monomial, q: &Rational, known: &SignEnv) -> Option<(Monomial, Rational)> {
    let rest = m.only(|x| !known.is_unit(x));
    let sign = sign_of_monomial(&rest, known);
    let size = q.clone().abs();
    let size = if sign.implies(Sign::NON_POSITIVE) { -size } else { size };
    (sign != Sign::ANY).then_some((rest, size))
}

/// Returns the sign of a coefficient, which is not 0.
fn sign_of_number(q: &Rational) -> Sign {
    if q.cmp0().is_lt() { Sign::NEGATIVE } else { Sign::POSITIVE }
}

fn sign_of_monomial(monomial: &Monomial, known: &SignEnv) -> Sign {
    monomial.powers().fold(Sign::POSITIVE, |product, (x, n)| product.times(known.get(x).power(n)))
}

/// Returns the coefficients bᵢ for which a polynomial of degree n in x is Σ bᵢ aⁱ (1 − a)ⁿ⁻ⁱ, where
/// a = (1 + x)/2.
///
/// They follow from xᵏ = (a − (1 − a))ᵏ and, for those of lower degree, from 1 = a + (1 − a).
fn bernstein(of: &Poly, x: usize) -> Vec<Poly> {
    let zero = Poly::zero();
    (0..=of.degree(x)).fold(Vec::new(), |sums: Vec<Poly>, k| {
        let coefficient = of.coefficient(x, k);
        let shifted = iter::once(&zero).chain(&sums);
        let sums = sums.iter().chain([&zero]).zip(shifted).zip(0..);
        sums.map(|((low, high), i)| low + high + &coefficient * power_coefficient(k, i)).collect()
    })
}

/// Returns the coefficient of aⁱ bᵏ⁻ⁱ in (a − b)ᵏ.
fn power_coefficient(k: u8, i: u8) -> Poly {
    let sign = if (k - i).is_multiple_of(2) { 1 } else { -1 };
    Poly::constant(sign * Integer::binomial_u(k.into(), i.into()).complete())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rule_2_completes_the_square() {
        let u = 0;
        let x = Poly::variable(u);
        let of = Poly::constant(3) * &x * &x + Poly::constant(2) * &x + Poly::constant(5);
        let found = SignCertificate::square(&of, u, &SignEnv::new([], Effort::default())).unwrap();
        let Rule::Square { leading, root, rest } = found.rule() else { panic!("another rule") };
        assert_eq!(Poly::constant(4) * leading * of, root * root + rest);
    }

    /// (1 − x²)¹⁶ (1 + x²) = 4¹⁶ a¹⁶ (1 − a)¹⁶ 2 (a² + (1 − a)²), whose coefficients 2³³ exceed 32 bits.
    #[test]
    fn rule_4_is_exact_for_large_coefficients() {
        let x = 0;
        let of_square = |n| Poly::constant(1) + Poly::constant(n) * Poly::variable(x) * Poly::variable(x);
        let of = (0..16).fold(of_square(1), |product, _| product * of_square(-1));
        let large = || Rational::from(1_u64 << 33);
        for (i, coefficient) in bernstein(&of, x).into_iter().enumerate() {
            let expected = if [16, 18].contains(&i) { Poly::constant(large()) } else { Poly::zero() };
            assert_eq!(coefficient, expected, "of power {i}");
        }
        let known = SignEnv::new([0, 1], Effort::default());
        let terms = |of: &Poly| SignCertificate::termwise(of, &known);
        let sign = |of: &Poly| SignCertificate::endpoints(of, x, terms).map(|found| found.sign());
        assert_eq!([sign(&of), sign(&-of)], [Some(Sign::NON_NEGATIVE), Some(Sign::NON_POSITIVE)]);
    }
}
