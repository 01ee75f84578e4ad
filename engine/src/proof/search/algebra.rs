//! Polynomials over ℚ and their quotients, with e^… as an atom: the arithmetic of the search.
//!
//! All arithmetic is exact. A [`Poly`] is a sum of distinct monomials with nonzero coefficients, so two
//! polynomials without e^… are the same function if and only if they are the same sum. With e^…, equal sums
//! are equal functions; the converse can fail, as equal exponents may have different representations. A
//! [`Ratio`] is not reduced to lowest terms: two are equal if they are so after cross-multiplication. If the
//! denominator divides the numerator, the division is carried out, which shortens printed proofs.

pub use super::monomial::{Monomial, Symbol};
pub use super::number::Number;
use crate::proof::effort;

use crate::operators;
use rug::Rational;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A polynomial, as its monomials in ascending order with their nonzero coefficients.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Poly(Arc<Vec<(Monomial, Number)>>);

/// Maximum nesting of e^… in exponents. Shared parts of exponents are translated again at each occurrence.
const MAX_NESTING: u32 = 4;

/// A quotient of polynomials, whose denominator is not the zero polynomial.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ratio {
    num: Poly,
    den: Poly,
}

/// Adds terms, which may come in any order.
impl FromIterator<(Monomial, Number)> for Poly {
    fn from_iter<I: IntoIterator<Item = (Monomial, Number)>>(terms: I) -> Self {
        let mut terms: Vec<_> =
            terms.into_iter().take_while(|(m, _)| effort::spend(1 + m.powers().len())).collect();
        // Terms of sums and products come in sorted runs, which this sort merges.
        terms.sort_by(|(m, _), (n, _)| m.cmp(n));
        terms.dedup_by(|(m, q), (n, sum)| {
            let is_duplicate = m == n;
            if is_duplicate {
                *sum = &*sum + &*q;
            }
            is_duplicate
        });
        terms.retain(|(_, q)| q.sign().is_ne());
        Poly(terms.into())
    }
}

impl From<Monomial> for Poly {
    fn from(monomial: Monomial) -> Self {
        Poly(vec![(monomial, 1.into())].into())
    }
}

operators! { [] Poly;
    Add add |a, b| a.0.iter().chain(b.0.iter()).cloned().collect();
    Sub sub |a, b| a.0.iter().cloned().chain(b.negated()).collect();
    Mul mul |a, b| a.products(b).collect();
    - |a| a.negated().collect()
}

impl Poly {
    /// Returns the zero polynomial.
    pub fn zero() -> Self {
        Poly(Vec::new().into())
    }

    /// Returns the constant `q`.
    pub fn constant(q: impl Into<Number>) -> Self {
        Poly::from_iter([(Monomial::one(), q.into())])
    }

    /// Returns the symbol `x` as a polynomial.
    pub fn symbol(x: Symbol) -> Self {
        Monomial::of(x).into()
    }

    /// Returns e to the power of a quotient.
    pub fn exponential(exponent: Ratio) -> Self {
        if exponent.nesting() >= MAX_NESTING {
            effort::exceed();
            return Poly::zero();
        }
        let exponent = Some(exponent).filter(|e| !e.is_zero()).map(Arc::new);
        Monomial { exponent, ..Monomial::one() }.into()
    }

    /// Returns the terms with opposite signs.
    fn negated(&self) -> impl Iterator<Item = (Monomial, Number)> {
        self.0.iter().map(|(m, q)| (m.clone(), -q))
    }

    /// Returns the products of each term of one polynomial and each term of the other.
    fn products<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = (Monomial, Number)> {
        let times = |(m, p): &(Monomial, Number), (n, q): &_| (m.times(n), p * q);
        let (short, long) = if self.0.len() < other.0.len() { (self, other) } else { (other, self) };
        short.0.iter().flat_map(move |a| long.0.iter().map(move |b| times(a, b)))
    }

    /// Returns `true` if `self` is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns `true` if `self` is the number 1.
    pub fn is_one(&self) -> bool {
        matches!(&self.0[..], [(m, q)] if *m == Monomial::one() && q.is_one())
    }

    /// Returns the monomials in ascending order with their coefficients.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Number)> + ExactSizeIterator {
        self.0.iter().map(|(m, q)| (m, q))
    }

    fn monomials(&self) -> impl Iterator<Item = &Monomial> {
        self.0.iter().map(|(m, _)| m)
    }

    /// Returns the exponents of all e^… that are not themselves in exponents.
    pub fn exponents(&self) -> impl Iterator<Item = &Ratio> {
        self.monomials().filter_map(Monomial::exponent)
    }

    /// Returns `true` if a term contains e^….
    pub fn has_exponentials(&self) -> bool {
        self.exponents().next().is_some()
    }

    /// Returns the symbols, including those in exponents.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let mut all: BTreeSet<_> = self.exponents().flat_map(Ratio::symbols).collect();
        all.extend(self.monomials().flat_map(|m| m.powers().map(|(x, _)| x)));
        all
    }

    /// Returns the degree in a symbol.
    pub fn degree(&self, x: Symbol) -> u32 {
        self.monomials().map(|m| m.degree(x)).max().unwrap_or(0)
    }

    /// Returns the coefficient of xⁿ, disregarding occurrences of x in exponents.
    pub fn coefficient(&self, x: Symbol, n: u32) -> Poly {
        let of_power = self.0.iter().filter(|(m, _)| m.degree(x) == n);
        of_power.map(|(m, q)| (m.without(x), q.clone())).collect()
    }

    /// Returns the coefficient of the highest power of a symbol.
    pub fn leading_coefficient(&self, x: Symbol) -> Poly {
        self.coefficient(x, self.degree(x))
    }

    /// Returns the coefficients of x⁰ to xᴺ⁻¹ if the degree in x is N − 1.
    pub fn coefficients<const N: usize>(&self, x: Symbol) -> Option<[Poly; N]> {
        (self.degree(x) as usize + 1 == N).then(|| std::array::from_fn(|n| self.coefficient(x, n as u32)))
    }

    /// Returns the exact quotient, if there is one and the divisor's last term has no e^….
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let [others @ .., (leading, coefficient)] = &divisor.0[..] else { return None };
        if divisor.is_one() {
            return Some(self.clone());
        }
        // The first and last terms of a product are products of those terms, which rules out most divisors.
        let ends = [(self.0.first(), &divisor.0[0].0), (self.0.last(), leading)];
        if ends.into_iter().any(|(term, by)| term.is_some_and(|(m, _)| !m.is_divisible_by(by))) {
            return None;
        }
        let inverse = coefficient.recip();
        let mut rest: BTreeMap<_, _> = self.0.iter().cloned().collect();
        let mut quotient = Vec::new();
        while let Some((m, q)) = rest.pop_last() {
            if q.sign().is_eq() {
                continue;
            }
            let (m, q) = (m.over(leading)?, q * &inverse);
            if !effort::spend(others.iter().map(|(n, _)| 1 + n.powers().len() + m.powers().len()).sum()) {
                return None;
            }
            for (dm, dq) in others {
                let remainder = rest.entry(dm.times(&m)).or_insert_with(|| 0.into());
                *remainder = &*remainder - dq * &q;
            }
            quotient.push((m, q));
        }
        Some(quotient.into_iter().collect())
    }

    /// Returns the greatest product of powers of symbols that divides every term.
    pub fn common_monomial(&self) -> Monomial {
        let mut monomials = self.monomials();
        let mut common = monomials.next().map_or(Monomial::one(), Monomial::without_exponential);
        for m in monomials {
            common.powers.retain_mut(|(x, n)| {
                *n = (*n).min(m.degree(*x));
                *n > 0
            });
        }
        common
    }

    /// Returns the derivative with respect to a symbol, which is a quotient because exponents are.
    pub fn derivative(&self, x: Symbol) -> Ratio {
        let lowered = |m: &Monomial, q: &Number| {
            Some((m.over(&Monomial::of(x))?, q * Number::from(Rational::from(m.degree(x)))))
        };
        let powers: Poly = self.0.iter().filter_map(|(m, q)| lowered(m, q)).collect();
        self.0.iter().fold(powers.into(), |sum, (m, q)| match m.exponent() {
            None => sum,
            Some(e) => sum + Ratio::from(Poly::from_iter([(m.clone(), q.clone())])) * e.derivative(x),
        })
    }

    /// Replaces each occurrence of a monomial, also in exponents, by a quotient.
    ///
    /// The value does not change wherever the monomial equals the quotient.
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Ratio {
        // The coefficients of the powers of the pivot, with the replacement already made in exponents.
        let mut by_power: Vec<Vec<(Monomial, Number)>> = Vec::new();
        for (m, q) in self.0.iter() {
            let (mut rest, mut power) = (m.without_exponential(), 0);
            while let Some(quotient) = rest.over(pivot) {
                rest = quotient;
                power += 1;
            }
            let exponent = m.exponent().map(|e| e.replace(pivot, by)).filter(|e| !e.is_zero());
            rest.exponent = exponent.map(Arc::new);
            by_power.resize(by_power.len().max(power + 1), Vec::new());
            by_power[power].push((rest, q.clone()));
        }
        let highest_first = by_power.into_iter().rev().map(Poly::from_iter);
        highest_first.fold(Ratio::zero(), |sum, coefficient| sum * by + Ratio::from(coefficient))
    }

    /// Returns `true` if a monomial occurs in a term or an exponent.
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.monomials().any(|m| m.is_divisible_by(pivot)) || self.exponents().any(|e| e.contains(pivot))
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
        if num.is_zero() || den.is_one() {
            return num.into();
        }
        // The e^… of a denominator with a single term moves to the numerator.
        if let [(Monomial { exponent: Some(e), .. }, _)] = &den.0[..] {
            let inverse = Poly::exponential(-&**e);
            (num, den) = (num * &inverse, den * inverse);
        }
        if let Some(quotient) = num.over(&den) {
            return quotient.into();
        }
        if let Some((_, q)) = den.0.last()
            && !q.is_one()
        {
            let inverse = Poly::constant(q.recip());
            (num, den) = (num * &inverse, den * inverse);
        }
        Ratio { num, den }
    }

    fn plus(&self, other: &Self) -> Self {
        let (a, b, den) = self.with_common_denominator(other);
        Ratio::new(a + b, den)
    }

    /// Returns both numerators over a common denominator, and that denominator.
    fn with_common_denominator(&self, other: &Self) -> (Poly, Poly, Poly) {
        if self.den == other.den {
            return (self.num.clone(), other.num.clone(), self.den.clone());
        }
        if let Some(k) = other.den.over(&self.den) {
            return (&self.num * k, other.num.clone(), other.den.clone());
        }
        if let Some(k) = self.den.over(&other.den) {
            return (self.num.clone(), &other.num * k, self.den.clone());
        }
        (&self.num * &other.den, &other.num * &self.den, &self.den * &other.den)
    }

    /// Returns a − b and a + b, without simplification for speed.
    pub fn difference_and_sum(&self, other: &Self) -> [Self; 2] {
        let (a, b, den) = self.with_common_denominator(other);
        [&a - &b, a + b].map(|num| Ratio { num, den: den.clone() })
    }

    fn times(&self, other: &Self) -> Self {
        // Cancels denominators that divide the opposite numerator.
        let cancel = |num, den: &Poly| if den.is_one() { None } else { Poly::over(num, den) };
        let (a, b) = (cancel(&self.num, &other.den), cancel(&other.num, &self.den));
        let one = Poly::constant(1);
        let (c, d) = (b.as_ref().map_or(&self.den, |_| &one), a.as_ref().map_or(&other.den, |_| &one));
        Ratio::new(a.as_ref().unwrap_or(&self.num) * b.as_ref().unwrap_or(&other.num), c * d)
    }

    /// Returns `self` / `other`, or `None` if `other` is identically zero.
    pub fn over(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        Some(self * Ratio::new(other.den.clone(), other.num.clone()))
    }

    /// Returns `true` if neither numerator nor denominator contains e^….
    pub fn is_rational_function(&self) -> bool {
        !self.num.has_exponentials() && !self.den.has_exponentials()
    }

    /// Returns `true` if the numerator is the zero polynomial.
    pub fn is_zero(&self) -> bool {
        self.num.is_zero()
    }

    /// Returns the nesting depth of e^… in exponents.
    fn nesting(&self) -> u32 {
        let exponents = self.num.exponents().chain(self.den.exponents());
        exponents.map(|exponent| 1 + exponent.nesting()).max().unwrap_or(0)
    }

    /// Returns `true` if the quotient is a number.
    pub fn is_number(&self) -> bool {
        self.den.is_one() && self.num.monomials().all(|m| *m == Monomial::one())
    }

    /// Returns the symbols of numerator and denominator.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.num.symbols().into_iter().chain(self.den.symbols()).collect()
    }

    /// Returns the derivative with respect to a symbol.
    pub fn derivative(&self, x: Symbol) -> Self {
        let (n, d) = (Ratio::from(self.num.clone()), Ratio::from(self.den.clone()));
        let numerator = self.num.derivative(x) * d - n * self.den.derivative(x);
        Ratio::new(numerator.num, numerator.den * &self.den * &self.den)
    }

    /// Replaces a monomial by a quotient; see [`Poly::replace`].
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Self {
        if !self.contains(pivot) {
            return self.clone();
        }
        let (num, den) = (self.num.replace(pivot, by), self.den.replace(pivot, by));
        num.over(&den).unwrap_or_else(|| self.clone())
    }

    /// Returns `true` if a monomial occurs in the numerator or the denominator.
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.num.contains(pivot) || self.den.contains(pivot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_division_and_common_monomials() {
        let [u, v] = ["u", "v"].map(|name| Poly::symbol(Symbol::Own(name)));
        let e = Poly::exponential(v.clone().into());
        for divisor in [&u + &v, &u + &e, &u * &v - Poly::constant(2)] {
            assert_eq!((&divisor * &v).over(&divisor), Some(v.clone()));
            assert_eq!((&divisor * &v + &e).over(&divisor), None);
            assert_eq!(divisor.common_monomial(), Monomial::one());
            assert_eq!(
                (&divisor * &u * &v * &e).common_monomial(),
                Monomial::of(Symbol::Own("u")).times(&Monomial::of(Symbol::Own("v")))
            );
        }
        assert_eq!(u.over(&Poly::zero()), None);
    }

    #[test]
    fn exponentials_of_a_single_term_move_to_the_numerator() {
        let [u, c, v] = ["u", "c", "v"].map(|name| Poly::symbol(Symbol::Own(name)));
        let e = Poly::exponential(v.clone().into());
        let quotient = Ratio::from(u.clone()).over(&(&c * &e).into()).unwrap();
        assert_eq!((quotient.num() * &e, quotient.den()), (u.clone(), &c));
        // With several terms they stay.
        let several = &c + &e;
        let quotient = Ratio::from(u.clone()).over(&several.clone().into()).unwrap();
        assert_eq!((quotient.num(), quotient.den()), (&u, &several));
    }

    #[test]
    fn nothing_is_divided_by_zero() {
        let [u, v] = ["u", "v"].map(|name| Poly::symbol(Symbol::Own(name)));
        assert_eq!(Ratio::from(u.clone()).over(&Ratio::zero()), None);
        // Where u is v the quotient 1/(u − v) has no value, so it stays.
        let quotient = Ratio::from(Poly::constant(1)).over(&(u - &v).into()).unwrap();
        assert_eq!(quotient.replace(&Monomial::of(Symbol::Own("u")), &v.into()), quotient);
    }

    /// Long division requires this order.
    #[test]
    fn multiplication_preserves_the_order_of_monomials() {
        let [u, v] = ["u", "v"].map(|name| Monomial::of(Symbol::Own(name)));
        let all = [Monomial::one(), v.clone(), v.times(&v), u.clone(), u.times(&v), u.times(&u)];
        for (i, a) in all.iter().enumerate() {
            for (j, b) in all.iter().enumerate() {
                assert_eq!(a < b, i < j, "{a:?} and {b:?}");
                assert!(all.iter().all(|m| (a.times(m) < b.times(m)) == (i < j)));
            }
        }
    }
}
