//! Polynomials over ℚ and their quotients: the arithmetic of the search.
//!
//! The variables are those of the checker and, after these, the slack variables. All arithmetic is exact. A
//! [`Poly`] is a sum of distinct monomials with nonzero coefficients, so two polynomials are the same function if and
//! only if they are the same sum. A [`Ratio`] is not reduced to lowest terms: two are equal if they are so after
//! cross-multiplication. If the denominator divides the numerator, the division is carried out, which shortens
//! printed proofs.

use crate::operators;
use crate::proof::check::MAX_VARIABLES;
use rug::{Complete, Rational};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The first slack variable; the variables before it are those of the checker.
pub const FIRST_SLACK: usize = MAX_VARIABLES;

/// Maximum number of variables: those of the checker and 32 slack variables.
pub const VARIABLES: usize = FIRST_SLACK + 32;

/// The variable in place of a quantity that is too large to be computed. Nothing is known of it.
pub const UNKNOWN: usize = VARIABLES - 1;

/// A product of powers of variables.
///
/// The order of monomials is the lexicographic order of the powers. Multiplication preserves it, which long division
/// requires.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Monomial {
    powers: [u8; VARIABLES],
}

impl Monomial {
    /// Returns the empty product.
    pub fn one() -> Self {
        Monomial { powers: [0; VARIABLES] }
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
        let mut powers = self.powers();
        powers.next().filter(|(_, n)| *n == 1 && powers.next().is_none()).map(|(x, _)| x)
    }

    /// Returns the variables with their powers.
    pub fn powers(&self) -> impl Iterator<Item = (usize, u8)> {
        self.powers.iter().copied().enumerate().filter(|(_, n)| *n > 0)
    }

    /// Returns the monomial whose powers are a function of those of two others.
    fn zip(&self, other: &Self, of: impl Fn(u8, u8) -> u8) -> Self {
        let mut powers = self.powers;
        powers.iter_mut().zip(&other.powers).for_each(|(n, m)| *n = of(*n, *m));
        Monomial { powers }
    }

    /// Returns the product; the [unknown](UNKNOWN) variable if a power would exceed 254, to which only repeated
    /// substitution of pivots leads.
    pub fn times(&self, other: &Self) -> Self {
        let product = self.zip(other, u8::saturating_add);
        if product.powers.contains(&u8::MAX) { Monomial::of(UNKNOWN) } else { product }
    }

    /// Returns the quotient if the divisor divides `self`.
    pub fn checked_div(&self, divisor: &Self) -> Option<Self> {
        self.is_divisible_by(divisor).then(|| self.zip(divisor, |n, m| n - m))
    }

    /// Returns `true` if `other` divides `self`.
    pub fn is_divisible_by(&self, other: &Self) -> bool {
        self.powers.iter().zip(&other.powers).fold(true, |is_divisible, (n, m)| is_divisible & (n >= m))
    }

    /// Returns the greatest common divisor.
    pub fn common(&self, other: &Self) -> Self {
        self.zip(other, u8::min)
    }

    /// Returns the product of the powers of those variables for which `is_in` is `true`.
    pub fn only(&self, is_in: impl Fn(usize) -> bool) -> Self {
        let mut powers = self.powers;
        powers.iter_mut().enumerate().filter(|(x, _)| !is_in(*x)).for_each(|(_, n)| *n = 0);
        Monomial { powers }
    }

    /// Returns the degree in a variable.
    pub fn degree(&self, x: usize) -> u8 {
        self.powers[x]
    }
}

/// A polynomial, as its monomials in ascending order with their nonzero coefficients.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Poly(Arc<Vec<(Monomial, Rational)>>);

/// Maximum number of binary digits of a coefficient; the checker accepts 127.
const MAX_BITS: u32 = 4096;

/// Maximum number of terms of a product, before equal ones are added, and of steps of a division.
const MAX_TERMS: usize = 1 << 18;

/// A quotient of polynomials, whose denominator is not the zero polynomial.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ratio {
    num: Poly,
    den: Poly,
}

/// Adds terms, which may come in any order.
impl FromIterator<(Monomial, Rational)> for Poly {
    fn from_iter<I: IntoIterator<Item = (Monomial, Rational)>>(terms: I) -> Self {
        Poly::new(terms.into_iter().collect())
    }
}

impl From<Monomial> for Poly {
    fn from(monomial: Monomial) -> Self {
        Poly(vec![(monomial, 1.into())].into())
    }
}

operators! { [] Poly;
    Add add |a, b| a.plus(b);
    Sub sub |a, b| a.plus(&-b);
    Mul mul |a, b| a.times(b);
    - |a| Poly(a.terms().map(|(m, q)| (m.clone(), (-q).complete())).collect::<Vec<_>>().into())
}

impl Poly {
    /// Returns the sum of terms, which may come in any order; the unknown quantity if a coefficient is too large.
    fn new(mut terms: Vec<(Monomial, Rational)>) -> Self {
        // Terms of sums and products come in sorted runs, which this sort merges.
        terms.sort_by(|(m, _), (n, _)| m.cmp(n));
        terms.dedup_by(|(m, q), (n, sum)| {
            let is_duplicate = m == n;
            if is_duplicate {
                *sum += &*q;
            }
            is_duplicate
        });
        terms.retain(|(_, q)| q.cmp0().is_ne());
        if terms.iter().any(|(_, q)| q.numer().significant_bits() + q.denom().significant_bits() > MAX_BITS) {
            return Poly::unknown();
        }
        Poly(terms.into())
    }

    /// Returns a quantity that is too large to be computed, of which nothing is known.
    fn unknown() -> Self {
        Poly::variable(UNKNOWN)
    }

    /// Returns the zero polynomial.
    pub fn zero() -> Self {
        Poly(Vec::new().into())
    }

    /// Returns the constant `q`.
    pub fn constant(q: impl Into<Rational>) -> Self {
        Poly::from_iter([(Monomial::one(), q.into())])
    }

    /// Returns a variable as a polynomial.
    pub fn variable(x: usize) -> Self {
        Monomial::of(x).into()
    }

    fn plus(&self, other: &Self) -> Self {
        Poly::new([&self.0[..], &other.0].concat())
    }

    fn times(&self, other: &Self) -> Self {
        if self.is_one() {
            return other.clone();
        }
        if other.is_one() {
            return self.clone();
        }
        let (short, long) = if self.0.len() < other.0.len() { (self, other) } else { (other, self) };
        let count = short.0.len().saturating_mul(long.0.len());
        if count > MAX_TERMS {
            return Poly::unknown();
        }
        let mut terms = Vec::with_capacity(count);
        for (m, p) in short.0.iter() {
            terms.extend(long.0.iter().map(|(n, q)| (m.times(n), (p * q).complete())));
        }
        Poly::new(terms)
    }

    /// Returns `true` if `self` is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns `true` if `self` is the number 1.
    pub fn is_one(&self) -> bool {
        matches!(&self.0[..], [(m, q)] if *m == Monomial::one() && *q == 1)
    }

    /// Returns the monomials in ascending order with their coefficients.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Rational)> + ExactSizeIterator {
        self.0.iter().map(|(m, q)| (m, q))
    }

    fn monomials(&self) -> impl Iterator<Item = &Monomial> {
        self.0.iter().map(|(m, _)| m)
    }

    /// Returns the variables in order.
    pub fn variables(&self) -> Vec<usize> {
        variables(self.monomials())
    }

    /// Returns the degree in a variable.
    pub fn degree(&self, x: usize) -> u8 {
        self.monomials().map(|m| m.degree(x)).max().unwrap_or(0)
    }

    /// Returns the coefficient of xⁿ.
    pub fn coefficient(&self, x: usize, n: u8) -> Poly {
        let of_power = self.0.iter().filter(|(m, _)| m.degree(x) == n);
        of_power.map(|(m, q)| (m.only(|y| y != x), q.clone())).collect()
    }

    /// Returns the coefficients of x⁰ to xᴺ⁻¹ if the degree in x is N − 1.
    pub fn coefficients<const N: usize>(&self, x: usize) -> Option<[Poly; N]> {
        (usize::from(self.degree(x)) + 1 == N).then(|| std::array::from_fn(|n| self.coefficient(x, n as u8)))
    }

    /// Returns the exact quotient, if there is one.
    pub fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let [others @ .., (leading, coefficient)] = &divisor.0[..] else { return None };
        if divisor.is_one() {
            return Some(self.clone());
        }
        // The first and last terms of a product are products of those terms, which rules out most divisors.
        let ends = [(self.0.first(), &divisor.0[0].0), (self.0.last(), leading)];
        if ends.into_iter().any(|(term, by)| term.is_some_and(|(m, _)| !m.is_divisible_by(by))) {
            return None;
        }
        let inverse = coefficient.recip_ref().complete();
        let mut rest: BTreeMap<_, _> = self.0.iter().cloned().collect();
        let (mut quotient, mut steps) = (Vec::new(), 0);
        while let Some((m, q)) = rest.pop_last() {
            if q.cmp0().is_eq() {
                continue;
            }
            let (m, q) = (m.checked_div(leading)?, q * &inverse);
            steps += others.len();
            if steps > MAX_TERMS {
                return None;
            }
            for (dm, dq) in others {
                *rest.entry(dm.times(&m)).or_default() -= (dq * &q).complete();
            }
            quotient.push((m, q));
        }
        Some(quotient.into_iter().collect())
    }

    /// Returns the greatest product of powers of variables that divides every term.
    pub fn common_monomial(&self) -> Monomial {
        let mut monomials = self.monomials();
        let first = monomials.next().cloned().unwrap_or_else(Monomial::one);
        monomials.fold(first, |common, monomial| common.common(monomial))
    }

    /// Replaces each occurrence of a monomial by a quotient.
    ///
    /// The value does not change wherever the monomial equals the quotient.
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Ratio {
        // The coefficients of the powers of the pivot.
        let mut by_power: Vec<Vec<(Monomial, Rational)>> = Vec::new();
        for (m, q) in self.0.iter() {
            let (mut rest, mut power) = (m.clone(), 0);
            while let Some(quotient) = rest.checked_div(pivot) {
                rest = quotient;
                power += 1;
            }
            by_power.resize(by_power.len().max(power + 1), Vec::new());
            by_power[power].push((rest, q.clone()));
        }
        let highest_first = by_power.into_iter().rev().map(Poly::new);
        if by.den.is_one() {
            return highest_first.fold(Poly::zero(), |sum, coefficient| sum * &by.num + coefficient).into();
        }
        highest_first.fold(Ratio::zero(), |sum, coefficient| sum * by + Ratio::from(coefficient))
    }

    /// Returns `true` if a monomial occurs in a term.
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.monomials().any(|m| m.is_divisible_by(pivot))
    }
}

impl From<Poly> for Ratio {
    fn from(num: Poly) -> Self {
        Ratio { num, den: Poly::constant(1) }
    }
}

operators! { [] Ratio;
    Add add |a, b| a.plus(b);
    Sub sub |a, b| a + -b;
    Mul mul |a, b| a.times(b);
    - |a| Ratio { num: -&a.num, den: a.den.clone() }
}

impl Ratio {
    /// Returns 0.
    pub fn zero() -> Self {
        Poly::zero().into()
    }

    /// Returns the numerator.
    pub fn num(&self) -> &Poly {
        &self.num
    }

    /// Returns the denominator.
    pub fn den(&self) -> &Poly {
        &self.den
    }

    /// Creates a quotient, whose denominator must not be the zero polynomial.
    fn new(mut num: Poly, mut den: Poly) -> Self {
        if let Some(quotient) = num.checked_div(&den) {
            return quotient.into();
        }
        if let Some((_, q)) = den.0.last()
            && *q != 1
        {
            let inverse = Poly::constant(q.recip_ref());
            (num, den) = (num * &inverse, den * inverse);
        }
        Ratio { num, den }
    }

    fn plus(&self, other: &Self) -> Self {
        if let Some(k) = other.den.checked_div(&self.den) {
            return Ratio::new(&self.num * k + &other.num, other.den.clone());
        }
        if let Some(k) = self.den.checked_div(&other.den) {
            return Ratio::new(&self.num + &other.num * k, self.den.clone());
        }
        Ratio::new(&self.num * &other.den + &other.num * &self.den, &self.den * &other.den)
    }

    fn times(&self, other: &Self) -> Self {
        // Cancels denominators that divide the opposite numerator.
        let (a, b) = (self.num.checked_div(&other.den), other.num.checked_div(&self.den));
        let one = Poly::constant(1);
        let (c, d) = (b.as_ref().map_or(&self.den, |_| &one), a.as_ref().map_or(&other.den, |_| &one));
        Ratio::new(a.as_ref().unwrap_or(&self.num) * b.as_ref().unwrap_or(&other.num), c * d)
    }

    /// Returns `self` / `other`, or `None` if `other` is identically zero.
    pub fn checked_div(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        Some(self * Ratio::new(other.den.clone(), other.num.clone()))
    }

    /// Returns `true` if the numerator is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.num.is_zero()
    }

    /// Returns the variables of numerator and denominator in order.
    pub fn variables(&self) -> Vec<usize> {
        variables(self.num.monomials().chain(self.den.monomials()))
    }

    /// Replaces a monomial by a quotient; see [`Poly::replace`].
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Self {
        if !self.contains(pivot) {
            return self.clone();
        }
        let (num, den) = (self.num.replace(pivot, by), self.den.replace(pivot, by));
        num.checked_div(&den).unwrap_or_else(|| self.clone())
    }

    /// Returns `true` if a monomial occurs in the numerator or the denominator.
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.num.contains(pivot) || self.den.contains(pivot)
    }
}

/// Returns the variables of monomials in order.
fn variables<'a>(monomials: impl Iterator<Item = &'a Monomial>) -> Vec<usize> {
    let all = monomials.fold(Monomial::one(), |all, monomial| all.zip(monomial, u8::max));
    all.powers().map(|(x, _)| x).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_division_and_common_monomials() {
        let [u, v] = [0, 1].map(Poly::variable);
        let e = Poly::variable(2);
        for divisor in [&u + &v, &u + &e, &u * &v - Poly::constant(2)] {
            assert_eq!((&divisor * &v).checked_div(&divisor), Some(v.clone()));
            assert_eq!((&divisor * &v + &e).checked_div(&divisor), None);
            assert_eq!(divisor.common_monomial(), Monomial::one());
            assert_eq!(
                (&divisor * &u * &v * &e).common_monomial(),
                Monomial::of(0).times(&Monomial::of(1)).times(&Monomial::of(2))
            );
        }
        assert_eq!(u.checked_div(&Poly::zero()), None);
    }

    #[test]
    fn nothing_is_divided_by_zero() {
        let [u, v] = [0, 1].map(Poly::variable);
        assert_eq!(Ratio::from(u.clone()).checked_div(&Ratio::zero()), None);
        // Where u is v the quotient 1/(u − v) has no value, so it stays.
        let quotient = Ratio::from(Poly::constant(1)).checked_div(&(u - &v).into()).unwrap();
        assert_eq!(quotient.replace(&Monomial::of(0), &v.into()), quotient);
    }

    /// With u = v/w, u² + v is (v² + v w²)/w², also for w = 1.
    #[test]
    fn a_monomial_is_replaced_by_a_quotient() {
        let [u, v, w] = [0, 1, 2].map(Poly::variable);
        for w in [w, Poly::constant(1)] {
            let by = Ratio::from(v.clone()).checked_div(&w.clone().into()).unwrap();
            let replaced = (&u * &u + &v).replace(&Monomial::of(0), &by);
            let expected = Ratio::from(&v * &v + &v * &w * &w).checked_div(&(&w * &w).into());
            assert_eq!(Some(replaced), expected);
        }
    }

    /// Sums have the larger of two denominators, one of which divides the other, or else their product.
    #[test]
    fn quotients_are_added_and_multiplied() {
        let [u, v, w] = [0, 1, 2].map(Poly::variable);
        let vw = &v + &w;
        for (a, b, of_sum) in [
            (&v, &v, v.clone()),
            (&v, &(&v * &vw), &v * &vw),
            (&(&v * &vw), &vw, &v * &vw),
            (&v, &vw, &v * &vw),
        ] {
            let sum = Ratio::new(u.clone(), a.clone()) + Ratio::new(w.clone(), b.clone());
            assert_eq!((sum.num() * a * b, sum.den()), ((&u * b + &w * a) * &of_sum, &of_sum));
        }
        // A denominator that divides the opposite numerator is cancelled.
        let product = Ratio::new(&u * &vw, w.clone()) * Ratio::new(u.clone(), vw.clone());
        assert_eq!((product.num(), product.den()), (&(&u * &u), &w));
        let replaced =
            (&u * &u + &u + Poly::constant(3)).replace(&Monomial::of(0), &Ratio::new(v.clone(), w.clone()));
        assert_eq!(
            replaced.num() * &w * &w,
            (&v * &v + &v * &w + Poly::constant(3) * &w * &w) * replaced.den()
        );
    }

    /// A product of 2⁹ terms and as many is computed, one with a term more is not.
    #[test]
    fn products_have_a_largest_size() {
        let terms = |count: u16, x: usize| {
            let power = |n: u16, x: usize| (0..n).fold(Monomial::one(), |m, _| m.times(&Monomial::of(x)));
            let monomials = (0..count).map(|i| power(i % 64, x).times(&power(i / 64, x + 1)));
            monomials.map(|m| (m, Rational::from(1))).collect::<Poly>()
        };
        let [a, b, more] = [terms(512, 0), terms(512, 2), terms(513, 2)];
        assert_eq!((&a * &b).terms().len(), MAX_TERMS);
        assert_eq!(&a * &more, Poly::unknown());
    }

    /// Returns (uⁿ − 1)(vⁿ − 1)(wⁿ − 1).
    fn powers_less_one(n: usize) -> Poly {
        let one = Poly::constant(1);
        [0, 1, 2].map(Poly::variable).iter().fold(one.clone(), |product, x| {
            let power = (0..n).fold(one.clone(), |power, _| &power * x);
            &product * &(power - &one)
        })
    }

    /// Each of the n³ terms of the quotient takes seven steps.
    #[test]
    fn divisions_have_a_largest_number_of_steps() {
        let divisor = powers_less_one(1);
        assert_eq!(
            powers_less_one(33).checked_div(&divisor).map(|quotient| quotient.terms().len()),
            Some(33 * 33 * 33)
        );
        assert!(powers_less_one(34).checked_div(&divisor).is_none());
    }

    /// Long division requires this order.
    #[test]
    fn multiplication_preserves_the_order_of_monomials() {
        let [u, v] = [0, 1].map(Monomial::of);
        let all = [Monomial::one(), v.clone(), v.times(&v), u.clone(), u.times(&v), u.times(&u)];
        for (i, a) in all.iter().enumerate() {
            for (j, b) in all.iter().enumerate() {
                assert_eq!(a < b, i < j, "{a:?} and {b:?}");
                assert!(all.iter().all(|m| (a.times(m) < b.times(m)) == (i < j)));
            }
        }
    }
}
