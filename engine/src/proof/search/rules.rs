//! Rules for the sign of a polynomial for all values of its symbols.
//!
//! A [`Certificate`] is made by one of five rules. The [forms](super::form) of the checker's certificates
//! follow from it.
//!
//! 1. **Terms.** All terms have the same sign, which follows from the known signs of symbols; even powers of
//!    free symbols are not negative. The sign is strict if that of one term is.
//! 2. **Factor.** The sign of a product follows from those of its factors.
//! 3. **Square.** If 4 a f = r² + d with a ≠ 0 and d is not negative, f has the sign of a.
//! 4. **Sizes.** Factors between −1 and 1 do not increase the absolute value of a term, and their squares do
//!    not change its sign. So the polynomial is bounded from below by the one in which each term with such
//!    factors is replaced by minus its absolute value without them, or by 0 if they are squares and the term
//!    is not negative; and likewise from above.
//! 5. **Ends.** A polynomial of degree n in a symbol x between −1 and 1 is a sum of products aⁱ (1 − a)ⁿ⁻ⁱ
//!    with a = (1 + x)/2, none of them negative and not all 0, so it has the common sign of their
//!    coefficients (Bernstein form). In degree one the coefficients are its values at the ends.

use super::algebra::{Monomial, Number, Poly, VARIABLES};
use crate::proof::check::Sign::{self, Negative, NonNegative, NonPositive, Positive, Zero};
use crate::proof::effort::Effort;
use rug::{Complete, Integer, Rational};
use std::iter;

/// The known signs of variables. A variable without a sign is free: it may be any real number, or any between −1
/// and 1.
#[derive(Clone, Debug)]
pub struct SignEnv {
    signs: [Option<Sign>; VARIABLES],
    is_unit: [bool; VARIABLES],
    effort: Effort,
}

impl SignEnv {
    /// Creates an environment without signs, in which these variables are between −1 and 1.
    pub fn new(units: impl IntoIterator<Item = usize>, effort: Effort) -> Self {
        let mut env = SignEnv { signs: [None; VARIABLES], is_unit: [false; VARIABLES], effort };
        units.into_iter().for_each(|x| env.is_unit[x] = true);
        env
    }

    /// Returns the known sign of a variable.
    pub fn get(&self, x: usize) -> Option<Sign> {
        self.signs[x]
    }

    /// Sets or removes the sign of a variable, and returns the earlier one.
    pub fn set(&mut self, x: usize, sign: Option<Sign>) -> Option<Sign> {
        std::mem::replace(&mut self.signs[x], sign)
    }

    /// Returns the environment in which a variable has a sign.
    pub fn with(&self, x: usize, sign: Sign) -> Self {
        let mut env = self.clone();
        env.set(x, Some(sign));
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
pub struct Certificate {
    of: Poly,
    sign: Sign,
    rule: Rule,
}

/// The rule of a certificate, with the certificates on which it depends.
#[derive(Clone, Debug)]
pub enum Rule {
    /// Rule 1 or 4.
    Terms,
    /// Rule 2, with the signs of the two factors.
    Product(Box<Certificate>, Box<Certificate>),
    /// Rule 3.
    Square {
        /// The sign of a.
        leading: Box<Certificate>,
        /// The root r of the square.
        root: Poly,
        /// The sign of d.
        rest: Box<Certificate>,
    },
    /// Rule 5.
    Endpoints {
        /// The variable x.
        x: usize,
        /// The signs of the coefficients, from that at −1 to that at 1.
        at: Box<[Certificate]>,
    },
}

/// A search for the sign of a polynomial.
pub type SignSearch<'f> = &'f dyn Fn(&Poly, &SignEnv) -> Option<Certificate>;

impl Certificate {
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
        let sign = of.terms().try_fold(Zero, |sum, (monomial, coefficient)| {
            determined(sum.plus(sign_of_number(coefficient).times(sign_of_monomial(monomial, known)?)))
        });
        Some(Certificate { of: of.clone(), sign: sign?, rule: Rule::Terms })
    }

    /// Applies rule 2 to a product of two polynomials.
    pub fn product(of: &Poly, factor: Self, rest: Self) -> Self {
        let sign = factor.sign.times(rest.sign);
        Certificate { of: of.clone(), sign, rule: Rule::Product(factor.into(), rest.into()) }
    }

    /// Applies rule 3 to f = a x² + b x + d: 4 a f = (2 a x + b)² + (4 a d − b²).
    pub fn square(of: &Poly, x: usize, known: &SignEnv, find: SignSearch) -> Option<Self> {
        let [d, b, a] = of.coefficients(x)?;
        let leading = find(&a, known).filter(|a| a.sign.is_strict())?;
        known.spend(&a, &d).and(known.spend(&b, &b))?;
        let rest = find(&(Poly::constant(4) * &a * d - &b * &b), known)?;
        let sign = leading.sign.times(determined(NonNegative.plus(rest.sign))?);
        let root = Poly::constant(2) * a * Poly::variable(x) + b;
        let rule = Rule::Square { leading: leading.into(), root, rest: rest.into() };
        Some(Certificate { of: of.clone(), sign, rule })
    }

    /// Applies rule 4.
    pub fn triangle_inequality(of: &Poly, known: &SignEnv) -> Option<Self> {
        let (unit_terms, others): (Vec<_>, Vec<_>) =
            of.terms().partition(|(m, _)| m.powers().any(|(x, _)| known.is_unit(x)));
        let sizes = unit_terms.into_iter().map(|(m, q)| TermSize::new(m, q, known));
        let sizes: Vec<_> = sizes.collect::<Option<_>>()?;
        let others: Poly = others.into_iter().map(|(m, q)| (m.clone(), q.clone())).collect();
        [NonNegative, NonPositive].into_iter().find_map(|difference| {
            let bound = Certificate::termwise(&bound(&others, &sizes, difference), known)?;
            let sign = determined(bound.sign.plus(difference))?;
            Some(Certificate { of: of.clone(), sign, rule: Rule::Terms })
        })
    }

    /// Applies rule 5.
    pub fn endpoints(of: &Poly, x: usize, known: &SignEnv, find: SignSearch) -> Option<Self> {
        if !known.is_unit(x) {
            return None;
        }
        let at: Vec<_> = bernstein(of, x).iter().map(|of| find(of, known)).collect::<Option<_>>()?;
        // Strict signs come first. The products aⁱ (1 − a)ⁿ⁻ⁱ are not all 0, so they preserve them.
        let signs = [Positive, Negative, NonNegative, NonPositive];
        let sign = signs.into_iter().find(|sign| at.iter().all(|c| c.sign.implies(*sign)))?;
        let rule = Rule::Endpoints { x, at: at.into() };
        Some(Certificate { of: of.clone(), sign, rule })
    }
}

/// The size of a term with factors between −1 and 1.
struct TermSize {
    /// The absolute value of the term without these factors.
    size: (Monomial, Number),
    /// The sign of the term, if these factors are squares.
    sign: Option<Sign>,
}

impl TermSize {
    /// Returns the size if the remaining factors have a known sign.
    fn new(m: &Monomial, q: &Number, known: &SignEnv) -> Option<Self> {
        let rest = m.only(|x| !known.is_unit(x));
        let sign = sign_of_monomial(&rest, known)?;
        let size = if sign.implies(NonPositive) { -Number::from(q.abs_ref()) } else { q.abs_ref().into() };
        let is_even = m.powers().all(|(x, n)| !known.is_unit(x) || n % 2 == 0);
        Some(TermSize { size: (rest, size), sign: is_even.then(|| sign_of_number(q).times(sign)) })
    }
}

/// Returns a bound of a sum of terms from which the sum differs by a quantity of the sign `difference`.
fn bound(others: &Poly, sizes: &[TermSize], difference: Sign) -> Poly {
    let replaced = sizes.iter().filter(|term| !term.sign.is_some_and(|sign| sign.implies(difference)));
    let sizes: Poly = replaced.map(|term| term.size.clone()).collect();
    if difference == NonNegative { others - &sizes } else { others + &sizes }
}

/// Returns the sign of a number that is not any number.
pub fn determined(sign: Sign) -> Option<Sign> {
    (sign != Sign::Any).then_some(sign)
}

/// Returns the sign of a coefficient, which is not 0.
fn sign_of_number(q: &Number) -> Sign {
    if q.cmp0().is_lt() { Negative } else { Positive }
}

fn sign_of_monomial(monomial: &Monomial, known: &SignEnv) -> Option<Sign> {
    monomial.powers().try_fold(Positive, |product, (x, n)| match known.get(x) {
        Some(sign) if n % 2 == 1 => Some(product.times(sign)),
        Some(sign) => Some(product.times(sign.times(sign))),
        None if n % 2 == 0 => Some(product.times(NonNegative)),
        None => None,
    })
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
    Poly::constant(Number::from(Rational::from(sign * Integer::binomial_u(k.into(), i.into()).complete())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rule_3_completes_the_square() {
        let u = 0;
        let x = Poly::variable(u);
        let of = Poly::constant(3) * &x * &x + Poly::constant(2) * &x + Poly::constant(5);
        let found = Certificate::square(&of, u, &SignEnv::new([], Effort::default()), &Certificate::termwise)
            .unwrap();
        let Rule::Square { leading, root, rest } = found.rule() else { panic!("another rule") };
        assert_eq!(Poly::constant(4) * leading.of() * of, root * root + rest.of());
    }

    #[test]
    fn rule_4_applies_to_squares_of_symbols_between_minus_1_and_1() {
        let [a, b] = [0, 1].map(Poly::variable);
        let sign = |of: Poly| {
            Certificate::triangle_inequality(&of, &SignEnv::new([0, 1], Effort::default()))
                .map(|found| found.sign())
        };
        // 1 + 3 a² − b ≥ 1 − 1.
        let of = |power: Poly| Poly::constant(1) + Poly::constant(3) * power - &b;
        assert_eq!([of(&a * &a), -of(&a * &a)].map(sign), [Some(NonNegative), Some(NonPositive)]);
        assert_eq!([of(a.clone()), of(&a * &a * &b), of(&a * &a * &a)].map(sign), [None; 3]);
    }

    #[test]
    fn rule_5_applies_to_symbols_between_minus_1_and_1_only() {
        let known = SignEnv::new([0, 1], Effort::default());
        let two = || Poly::constant(2);
        let of = |x| Certificate::endpoints(&(two() + Poly::variable(x)), x, &known, &Certificate::termwise);
        assert!(of(0).is_some() && of(1).is_some());
        assert!(of(2).is_none());
    }

    /// (1 − x²)¹⁶ (1 + x²) = 4¹⁶ a¹⁶ (1 − a)¹⁶ 2 (a² + (1 − a)²), whose coefficients 2³³ exceed 32 bits.
    #[test]
    fn rule_5_is_exact_for_large_coefficients() {
        let x = 0;
        let of_square = |n| Poly::constant(1) + Poly::constant(n) * Poly::variable(x) * Poly::variable(x);
        let of = (0..16).fold(of_square(1), |product, _| product * of_square(-1));
        let large = || Number::from(Rational::from(1_u64 << 33));
        for (i, coefficient) in bernstein(&of, x).into_iter().enumerate() {
            let expected = if [16, 18].contains(&i) { Poly::constant(large()) } else { Poly::zero() };
            assert_eq!(coefficient, expected, "of power {i}");
        }
        let known = SignEnv::new([0, 1], Effort::default());
        let sign = |of: &Poly| {
            Certificate::endpoints(of, x, &known, &Certificate::termwise).map(|found| found.sign())
        };
        assert_eq!([sign(&of), sign(&-of)], [Some(NonNegative), Some(NonPositive)]);
    }
}
