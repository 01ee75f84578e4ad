//! Polynomials and their quotients over ℚ, with e^… as an atom: the arithmetic that proofs rest on.
//!
//! Everything is exact. A [`Poly`] is a sum of distinct monomials with coefficients that are not 0, so two
//! polynomials without e^… are the same function if and only if they are the same sum; with e^… they are if
//! they are the same sum, and may be if exponents are equal that are not written alike. A [`Ratio`] is not
//! reduced to lowest terms: two are equal if they are after cross-multiplication. That is all that equality
//! needs; where a numerator divides by its denominator, the division is done, to keep what a reader sees
//! short.

use super::effort;
pub use super::monomial::{Monomial, Symbol};
pub use super::number::Number;

use crate::operators;
use rug::Rational;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A polynomial: its monomials in order, each with its coefficient, which is not 0.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Poly(Arc<Vec<(Monomial, Number)>>);

/// The number of e^… that may stand in exponents of each other: what is shared between them is read again at
/// each place.
const MAX_NESTING: u32 = 4;

/// A quotient of polynomials; the denominator is not the zero polynomial.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ratio {
    num: Poly,
    den: Poly,
}

/// The sum of terms, in any order.
impl FromIterator<(Monomial, Number)> for Poly {
    fn from_iter<I: IntoIterator<Item = (Monomial, Number)>>(terms: I) -> Self {
        let mut terms: Vec<_> =
            terms.into_iter().inspect(|(m, _)| effort::spend(1 + m.powers().len())).collect();
        // Where some are in order already, as in sums and products they are, this sort merges.
        terms.sort_by(|(m, _), (n, _)| m.cmp(n));
        terms.dedup_by(|(m, q), (n, sum)| {
            let alike = m == n;
            if alike {
                *sum = &*sum + &*q;
            }
            alike
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
    /// 0
    pub fn zero() -> Self {
        Poly(Vec::new().into())
    }

    /// A number.
    pub fn constant(q: impl Into<Number>) -> Self {
        Poly::from_iter([(Monomial::one(), q.into())])
    }

    /// A symbol.
    pub fn symbol(x: Symbol) -> Self {
        Monomial::of(x).into()
    }

    /// e to a quotient.
    pub fn exponential(exponent: Ratio) -> Self {
        if exponent.nesting() >= MAX_NESTING {
            effort::exceed();
        }
        let exponent = Some(exponent).filter(|e| !e.is_zero()).map(Arc::new);
        Monomial { exponent, ..Monomial::one() }.into()
    }

    /// Each term with the opposite sign.
    fn negated(&self) -> impl Iterator<Item = (Monomial, Number)> {
        self.0.iter().map(|(m, q)| (m.clone(), -q))
    }

    /// Each term of one with each of the other.
    fn products<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = (Monomial, Number)> {
        let times = |(m, p): &(Monomial, Number), (n, q): &_| (m.times(n), p * q);
        let (short, long) = if self.0.len() < other.0.len() { (self, other) } else { (other, self) };
        short.0.iter().flat_map(move |own| long.0.iter().map(move |term| times(own, term)))
    }

    /// Is it the zero polynomial?
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Is it the number 1?
    pub fn is_one(&self) -> bool {
        matches!(&self.0[..], [(m, q)] if *m == Monomial::one() && q.is_one())
    }

    /// Its monomials with their coefficients, in the order of division.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Number)> + ExactSizeIterator {
        self.0.iter().map(|(m, q)| (m, q))
    }

    fn monomials(&self) -> impl Iterator<Item = &Monomial> {
        self.0.iter().map(|(m, _)| m)
    }

    /// All its exponents.
    pub fn exponents(&self) -> impl Iterator<Item = &Ratio> {
        self.monomials().filter_map(Monomial::exponent)
    }

    /// Does it have an e^…?
    pub fn has_exponentials(&self) -> bool {
        self.exponents().next().is_some()
    }

    /// Its symbols, those in exponents too.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let mut all: BTreeSet<_> = self.exponents().flat_map(Ratio::symbols).collect();
        all.extend(self.monomials().flat_map(|m| m.powers().map(|(x, _)| x)));
        all
    }

    /// The highest power of a symbol.
    pub fn degree(&self, x: Symbol) -> u32 {
        self.monomials().map(|m| m.degree(x)).max().unwrap_or(0)
    }

    /// The coefficient of xⁿ; exponents are left alone.
    pub fn coefficient(&self, x: Symbol, n: u32) -> Poly {
        let of_power = self.0.iter().filter(|(m, _)| m.degree(x) == n);
        of_power.map(|(m, q)| (m.without(x), q.clone())).collect()
    }

    /// The coefficient of the highest power of a symbol.
    pub fn leading_coefficient(&self, x: Symbol) -> Poly {
        self.coefficient(x, self.degree(x))
    }

    /// The coefficients of x⁰ to xᴺ⁻¹, if the degree in x is N − 1.
    pub fn coefficients<const N: usize>(&self, x: Symbol) -> Option<[Poly; N]> {
        (self.degree(x) as usize + 1 == N).then(|| std::array::from_fn(|n| self.coefficient(x, n as u32)))
    }

    /// The exact quotient, if there is one and the divisor's last term has no e^….
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let [others @ .., (first, coefficient)] = &divisor.0[..] else { return None };
        if divisor.is_one() {
            return Some(self.clone());
        }
        // The last terms of factors are those of a product: mostly that is seen to fail.
        let ends = self.0.first().zip(divisor.0.first());
        if ends.is_some_and(|((m, _), (n, _))| !m.has(n)) {
            return None;
        }
        let inverse = coefficient.recip();
        let mut rest: BTreeMap<_, _> = self.0.iter().cloned().collect();
        let mut quotient = Vec::new();
        while let Some((m, q)) = rest.pop_last() {
            if q.sign().is_eq() {
                continue;
            }
            let (m, q) = (m.over(first)?, q * &inverse);
            effort::spend(others.iter().map(|(n, _)| 1 + n.powers().len() + m.powers().len()).sum());
            for (dm, dq) in others {
                let left = rest.entry(dm.times(&m)).or_insert_with(|| 0.into());
                *left = &*left - dq * &q;
            }
            quotient.push((m, q));
        }
        Some(quotient.into_iter().collect())
    }

    /// The largest product of powers of symbols that divides every term.
    pub fn common_monomial(&self) -> Monomial {
        let mut monomials = self.monomials();
        let mut common = monomials.next().map_or(Monomial::one(), Monomial::bare);
        for m in monomials {
            common.powers.retain_mut(|(x, n)| {
                *n = (*n).min(m.degree(*x));
                *n > 0
            });
        }
        common
    }

    /// The derivative by a symbol; exponents have denominators, so it is a quotient.
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

    /// With each occurrence of a monomial replaced by a quotient, in exponents too. Equals are replaced by
    /// equals, so the value stays what it is wherever the monomial has the value of the quotient.
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Ratio {
        // The coefficients of the pivot's powers, times e^… whose exponents are replaced already.
        let mut by_power: Vec<Vec<(Monomial, Number)>> = Vec::new();
        for (m, q) in self.0.iter() {
            let (mut rest, mut power) = (m.bare(), 0);
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

    /// Does a monomial occur in it, or in its exponents?
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.monomials().any(|m| m.has(pivot)) || self.exponents().any(|e| e.contains(pivot))
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
    /// 0
    pub fn zero() -> Self {
        Poly::zero().into()
    }

    /// The numerator.
    pub fn num(&self) -> &Poly {
        &self.num
    }

    /// The denominator.
    pub fn den(&self) -> &Poly {
        &self.den
    }

    /// A quotient. The denominator must not be the zero polynomial.
    fn new(mut num: Poly, mut den: Poly) -> Self {
        if num.is_zero() || den.is_one() {
            return num.into();
        }
        // A single e^… below goes above.
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
        let (a, b, den) = self.alongside(other);
        Ratio::new(a + b, den)
    }

    /// The two with one denominator.
    fn alongside(&self, other: &Self) -> (Poly, Poly, Poly) {
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

    /// a − b and a + b, not reduced: what is long takes less time so.
    pub fn both_sides(&self, other: &Self) -> [Self; 2] {
        let (a, b, den) = self.alongside(other);
        [&a - &b, a + b].map(|num| Ratio { num, den: den.clone() })
    }

    fn times(&self, other: &Self) -> Self {
        // Cancel crosswise what can be.
        let cancel = |num, den: &Poly| if den.is_one() { None } else { Poly::over(num, den) };
        let (a, b) = (cancel(&self.num, &other.den), cancel(&other.num, &self.den));
        let one = Poly::constant(1);
        let (c, d) = (b.as_ref().map_or(&self.den, |_| &one), a.as_ref().map_or(&other.den, |_| &one));
        Ratio::new(a.as_ref().unwrap_or(&self.num) * b.as_ref().unwrap_or(&other.num), c * d)
    }

    /// self / other; `None` if other is identically zero.
    pub fn over(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        Some(self * Ratio::new(other.den.clone(), other.num.clone()))
    }

    /// Is it free of e^…?
    pub fn is_of_polynomials(&self) -> bool {
        !self.num.has_exponentials() && !self.den.has_exponentials()
    }

    /// Is it 0 wherever it is defined?
    pub fn is_zero(&self) -> bool {
        self.num.is_zero()
    }

    /// The number of e^… that stand in exponents of each other.
    fn nesting(&self) -> u32 {
        let exponents = self.num.exponents().chain(self.den.exponents());
        exponents.map(|exponent| 1 + exponent.nesting()).max().unwrap_or(0)
    }

    /// Is it a number?
    pub fn is_number(&self) -> bool {
        self.den.is_one() && self.num.monomials().all(|m| *m == Monomial::one())
    }

    /// All its symbols.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.num.symbols().into_iter().chain(self.den.symbols()).collect()
    }

    /// The derivative by a symbol.
    pub fn derivative(&self, x: Symbol) -> Self {
        let (n, d) = (Ratio::from(self.num.clone()), Ratio::from(self.den.clone()));
        let top = self.num.derivative(x) * d - n * self.den.derivative(x);
        Ratio::new(top.num, top.den * &self.den * &self.den)
    }

    /// With a monomial replaced by a quotient ([`Poly::replace`]).
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Self {
        if !self.contains(pivot) {
            return self.clone();
        }
        let (num, den) = (self.num.replace(pivot, by), self.den.replace(pivot, by));
        num.over(&den).unwrap_or_else(|| self.clone())
    }

    /// Does a monomial occur in it?
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.num.contains(pivot) || self.den.contains(pivot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_divided_and_have_factors_in_common() {
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

    /// As long division needs.
    #[test]
    fn monomials_are_in_an_order_that_multiplication_keeps() {
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
