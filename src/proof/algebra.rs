//! Polynomials and their quotients over ℚ, with e^… as an atom: the arithmetic that proofs rest on.
//!
//! Everything is exact. A [`Poly`] is a sum of distinct monomials with coefficients that are not 0, so two
//! polynomials without e^… are the same function if and only if they are the same sum; with e^… they are if they are
//! the same sum, and may be if exponents are equal that are not written alike. A [`Ratio`] is not reduced to
//! lowest terms: two are equal if they are after cross-multiplication. That is all that equality needs; where
//! a numerator divides by its denominator, the division is done, to keep what a reader sees short.

use crate::number::Tree;
use crate::number::tree::Step;
use rug::Rational;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::Arc;

/// A quantity by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(pub &'static str);

/// A product of powers of symbols, times e to a quotient, if any.
///
/// One exponential is enough, since eᵃ eᵇ = eᵃ⁺ᵇ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monomial {
    /// Symbols in order, with exponents that are not 0.
    powers: Vec<(Symbol, u32)>,
    exponent: Option<Arc<Ratio>>,
}

/// A polynomial: from each monomial to its coefficient, which is not 0.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Poly(BTreeMap<Monomial, Rational>);

/// A quotient of polynomials; the denominator is not the zero polynomial.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ratio {
    num: Poly,
    den: Poly,
}

impl Monomial {
    /// The empty product.
    pub fn one() -> Self {
        Monomial { powers: Vec::new(), exponent: None }
    }

    /// A symbol.
    pub fn of(symbol: Symbol) -> Self {
        Monomial::power(symbol, 1)
    }

    /// A symbol to a power.
    fn power(symbol: Symbol, n: u32) -> Self {
        let powers = if n == 0 { Vec::new() } else { vec![(symbol, n)] };
        Monomial { powers, exponent: None }
    }

    /// The powers of its symbols.
    pub fn powers(&self) -> &[(Symbol, u32)] {
        &self.powers
    }

    fn times(&self, other: &Self) -> Self {
        let mut powers = Vec::with_capacity(self.powers.len() + other.powers.len());
        let (mut left, mut right) = (self.powers.iter().peekable(), other.powers.iter().peekable());
        while let (Some(a), Some(b)) = (left.peek(), right.peek()) {
            match a.0.cmp(&b.0) {
                Ordering::Less => powers.extend(left.next()),
                Ordering::Greater => powers.extend(right.next()),
                Ordering::Equal => {
                    powers.push((a.0, a.1.checked_add(b.1).expect("a power fits 32 bits")));
                    left.next();
                    right.next();
                }
            }
        }
        powers.extend(left);
        powers.extend(right);
        let exponent = match (&self.exponent, &other.exponent) {
            (None, e) | (e, None) => e.clone(),
            (Some(a), Some(b)) => Some(a.plus(b)).filter(|sum| !sum.is_zero()).map(Arc::new),
        };
        Monomial { powers, exponent }
    }

    /// The quotient, if every power of the divisor is there; the divisor has no e^….
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        if divisor.exponent.is_some() {
            return None;
        }
        let mut powers = self.powers.clone();
        for (symbol, n) in &divisor.powers {
            let own = powers.iter_mut().find(|(s, _)| s == symbol)?;
            own.1 = own.1.checked_sub(*n)?;
        }
        powers.retain(|(_, n)| *n > 0);
        Some(Monomial { powers, exponent: self.exponent.clone() })
    }

    /// Without its e^….
    fn bare(&self) -> Self {
        Monomial { powers: self.powers.clone(), exponent: None }
    }

    fn degree(&self, x: Symbol) -> u32 {
        self.powers.iter().find(|(symbol, _)| *symbol == x).map_or(0, |(_, n)| *n)
    }

    fn without(&self, x: Symbol) -> Self {
        let powers = self.powers.iter().filter(|(symbol, _)| *symbol != x).copied().collect();
        Monomial { powers, exponent: self.exponent.clone() }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Lexicographic in the powers: an order that multiplication keeps, as long division needs.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        for (a, b) in self.powers.iter().zip(&other.powers) {
            let order = b.0.cmp(&a.0).then(a.1.cmp(&b.1));
            if order.is_ne() {
                return order;
            }
        }
        self.powers.len().cmp(&other.powers.len()).then_with(|| self.exponent.cmp(&other.exponent))
    }
}

impl Poly {
    /// 0
    pub fn zero() -> Self {
        Poly(BTreeMap::new())
    }

    /// A number.
    pub fn constant(q: impl Into<Rational>) -> Self {
        Poly::term(Monomial::one(), q.into())
    }

    /// A symbol.
    pub fn symbol(x: Symbol) -> Self {
        Poly::term(Monomial::power(x, 1), 1.into())
    }

    /// A number times a monomial.
    pub fn term(monomial: Monomial, coefficient: Rational) -> Self {
        let mut sum = Poly::zero();
        sum.accumulate(monomial, coefficient);
        sum
    }

    fn accumulate(&mut self, monomial: Monomial, coefficient: Rational) {
        use std::collections::btree_map::Entry;
        match self.0.entry(monomial) {
            Entry::Vacant(place) if !coefficient.is_zero() => drop(place.insert(coefficient)),
            Entry::Vacant(_) => {}
            Entry::Occupied(mut place) => {
                *place.get_mut() += coefficient;
                if place.get().is_zero() {
                    place.remove();
                }
            }
        }
    }

    /// Is it the zero polynomial?
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Its monomials with their coefficients.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Rational)> {
        self.0.iter()
    }

    /// The number it is, if it is one.
    pub fn as_constant(&self) -> Option<Rational> {
        match self.0.len() {
            0 => Some(Rational::new()),
            1 => self.0.get(&Monomial::one()).cloned(),
            _ => None,
        }
    }

    fn is_one(&self) -> bool {
        self.0.len() == 1 && self.0.get(&Monomial::one()).is_some_and(|q| *q == 1)
    }

    /// self + other
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        other.0.iter().for_each(|(m, q)| sum.accumulate(m.clone(), q.clone()));
        sum
    }

    /// −self
    pub fn negated(&self) -> Self {
        self.scaled(&(-1).into())
    }

    /// self · other
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Poly::zero();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                product.accumulate(a.times(b), Rational::from(x * y));
            }
        }
        product
    }

    /// self · q for a number q
    pub fn scaled(&self, q: &Rational) -> Self {
        if q.is_zero() {
            return Poly::zero();
        }
        Poly(self.0.iter().map(|(m, x)| (m.clone(), Rational::from(x * q))).collect())
    }

    /// Does it have an e^…?
    pub fn has_exponentials(&self) -> bool {
        self.0.keys().any(|m| m.exponent.is_some())
    }

    /// All its exponents.
    pub fn exponents(&self) -> impl Iterator<Item = &Ratio> {
        self.0.keys().filter_map(|m| m.exponent.as_deref())
    }

    /// Its symbols, but for those in exponents.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.0.keys().flat_map(|m| m.powers.iter().map(|(symbol, _)| *symbol)).collect()
    }

    /// Its symbols and those in exponents.
    pub fn all_symbols(&self) -> BTreeSet<Symbol> {
        self.symbols().into_iter().chain(self.exponents().flat_map(Ratio::symbols)).collect()
    }

    /// The highest power of a symbol.
    pub fn degree(&self, x: Symbol) -> u32 {
        self.0.keys().map(|m| m.degree(x)).max().unwrap_or(0)
    }

    /// The coefficients of x⁰, x¹, …; exponents are left alone.
    pub fn coefficients(&self, x: Symbol) -> Vec<Poly> {
        let mut all = vec![Poly::zero(); self.degree(x) as usize + 1];
        for (m, q) in &self.0 {
            all[m.degree(x) as usize].accumulate(m.without(x), q.clone());
        }
        all
    }

    /// The parts with the same e^…, without it.
    pub fn by_exponent(&self) -> BTreeMap<Option<Arc<Ratio>>, Poly> {
        let mut parts: BTreeMap<_, Poly> = BTreeMap::new();
        for (m, q) in &self.0 {
            parts.entry(m.exponent.clone()).or_insert_with(Poly::zero).accumulate(m.bare(), q.clone());
        }
        parts
    }

    /// Each exponent that a symbol occurs in, with its factor; and the other terms.
    pub fn exponentials_in(&self, x: Symbol) -> (Vec<(Arc<Ratio>, Poly)>, Poly) {
        let mut rest = self.clone();
        rest.0.retain(|m, _| m.exponent.as_ref().is_none_or(|e| !e.symbols().contains(&x)));
        let parts = self.by_exponent().into_iter();
        let moving = parts.filter_map(|(e, part)| Some((e.filter(|e| e.symbols().contains(&x))?, part)));
        (moving.collect(), rest)
    }

    /// e to a quotient.
    pub fn exponential(exponent: Ratio) -> Self {
        let exponent = if exponent.is_zero() { None } else { Some(Arc::new(exponent)) };
        Poly::term(Monomial { powers: Vec::new(), exponent }, 1.into())
    }

    fn leading(&self) -> Option<(&Monomial, &Rational)> {
        self.0.iter().next_back()
    }

    /// The exact quotient, if there is one; the divisor has no e^….
    pub fn over(&self, divisor: &Self) -> Option<Self> {
        let (first, coefficient) = divisor.leading()?;
        if divisor.is_one() {
            return Some(self.clone());
        }
        if divisor.has_exponentials() {
            return None;
        }
        let (mut rest, mut quotient) = (self.clone(), Poly::zero());
        while let Some((m, q)) = rest.leading() {
            let (m, q) = (m.over(first)?, Rational::from(q / coefficient));
            for (dm, dq) in &divisor.0 {
                rest.accumulate(dm.times(&m), -Rational::from(dq * &q));
            }
            quotient.accumulate(m, q);
        }
        Some(quotient)
    }

    /// The largest product of powers of symbols that divides every term.
    pub fn common_monomial(&self) -> Monomial {
        let mut monomials = self.0.keys();
        let mut powers = monomials.next().map_or(Vec::new(), |m| m.powers.clone());
        for m in monomials {
            powers.retain_mut(|(symbol, n)| {
                *n = (*n).min(m.degree(*symbol));
                *n > 0
            });
        }
        Monomial { powers, exponent: None }
    }

    /// The derivative by a symbol; exponents have denominators, so it is a quotient.
    pub fn derivative(&self, x: Symbol) -> Ratio {
        let mut sum = Ratio::zero();
        for (m, q) in &self.0 {
            let n = m.degree(x);
            if n > 0 {
                let lowered = m.without(x).times(&Monomial::power(x, n - 1));
                sum = sum.plus(&Poly::term(lowered, Rational::from(q * n)).into());
            }
            if let Some(exponent) = &m.exponent {
                let term = Ratio::from(Poly::term(m.clone(), q.clone()));
                sum = sum.plus(&term.times(&exponent.derivative(x)));
            }
        }
        sum
    }

    /// With each occurrence of a monomial replaced by a quotient, in exponents too. Equals are replaced by
    /// equals, so the value stays what it is wherever the monomial has the value of the quotient.
    pub fn replace(&self, pivot: &Monomial, by: &Ratio) -> Ratio {
        // The coefficients of the pivot's powers, times e^… whose exponents are replaced already.
        let mut by_power: Vec<Poly> = Vec::new();
        for (m, q) in &self.0 {
            let (mut rest, mut power) = (m.bare(), 0);
            while let Some(quotient) = rest.over(pivot) {
                rest = quotient;
                power += 1;
            }
            let exponent = m.exponent.as_ref().map(|e| e.replace(pivot, by)).filter(|e| !e.is_zero());
            rest.exponent = exponent.map(Arc::new);
            by_power.resize(by_power.len().max(power + 1), Poly::zero());
            by_power[power].accumulate(rest, q.clone());
        }
        let highest_first = by_power.into_iter().rev();
        highest_first.fold(Ratio::zero(), |sum, coefficient| sum.times(by).plus(&coefficient.into()))
    }

    /// Does a monomial occur in it, or in its exponents?
    pub fn contains(&self, pivot: &Monomial) -> bool {
        self.0
            .keys()
            .any(|m| m.bare().over(pivot).is_some() || m.exponent.as_ref().is_some_and(|e| e.contains(pivot)))
    }

    /// As a formula, each symbol by what `symbol` says of it.
    pub fn to_tree(&self, symbol: &impl Fn(Symbol) -> Tree) -> Tree {
        let mut sum: Option<Tree> = None;
        // What is subtracted does not come first.
        let (added, subtracted): (Vec<_>, Vec<_>) = self.0.iter().rev().partition(|(_, q)| q.is_positive());
        for (m, q) in added.into_iter().chain(subtracted) {
            let mut factors: Vec<Tree> = Vec::new();
            let mut powers = m.powers.clone();
            powers.sort_by_key(|(s, _)| CUSTOM.chars().position(|c| s.0.starts_with(c)));
            for (s, n) in &powers {
                factors.extend(std::iter::repeat_n(symbol(*s), *n as usize));
            }
            if let Some(e) = &m.exponent {
                factors.push(crate::number::Exponential::exp(&e.to_tree(symbol)));
            }
            let (size, negative) = (q.clone().abs(), q.is_negative());
            let product = factors.into_iter().reduce(|a, b| a * b);
            let term = match product {
                Some(product) if size == 1 => product,
                Some(product) if *size.denom() == 1 => number(&size) * product,
                Some(product) => {
                    let numerator = number(&size.numer().clone().into());
                    let product = if *size.numer() == 1 { product } else { numerator * product };
                    product / number(&size.denom().clone().into())
                }
                None => number(&size),
            };
            sum = Some(match (sum, negative) {
                (None, false) => term,
                (None, true) => -term,
                (Some(sum), false) => sum + term,
                (Some(sum), true) => sum - term,
            });
        }
        sum.unwrap_or_else(|| number(&Rational::new()))
    }
}

/// The order in which mechanics writes its factors; others come first.
const CUSTOM: &str = "skqtcεmglHuvλ";

/// A number as a formula; large integers in pieces, since a formula has only small ones.
fn number(q: &Rational) -> Tree {
    use crate::number::Field;
    if *q.denom() != 1 {
        return number(&q.numer().clone().into()) / number(&q.denom().clone().into());
    }
    match q.numer().to_i32() {
        Some(n) => Tree::int(n),
        None => {
            let (high, low) = q.numer().clone().div_rem((1 << 30).into());
            number(&high.into()) * Tree::int(1 << 30) + number(&low.into())
        }
    }
}

impl From<Poly> for Ratio {
    fn from(num: Poly) -> Self {
        Ratio { num, den: Poly::constant(1) }
    }
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
        if let (1, Some((Monomial { exponent: Some(e), .. }, _))) = (den.0.len(), den.leading()) {
            let inverse = Poly::exponential(e.negated());
            (num, den) = (num.times(&inverse), den.times(&inverse));
        }
        if let Some(quotient) = num.over(&den) {
            (num, den) = (quotient, Poly::constant(1));
        }
        if let Some((_, q)) = den.leading()
            && *q != 1
        {
            let inverse = Rational::from(q.recip_ref());
            (num, den) = (num.scaled(&inverse), den.scaled(&inverse));
        }
        Ratio { num, den }
    }

    /// self + other
    pub fn plus(&self, other: &Self) -> Self {
        if self.den == other.den {
            return Ratio::new(self.num.plus(&other.num), self.den.clone());
        }
        if let Some(k) = other.den.over(&self.den) {
            return Ratio::new(self.num.times(&k).plus(&other.num), other.den.clone());
        }
        if let Some(k) = self.den.over(&other.den) {
            return Ratio::new(other.num.times(&k).plus(&self.num), self.den.clone());
        }
        let num = self.num.times(&other.den).plus(&other.num.times(&self.den));
        Ratio::new(num, self.den.times(&other.den))
    }

    /// −self
    pub fn negated(&self) -> Self {
        Ratio { num: self.num.negated(), den: self.den.clone() }
    }

    /// self − other
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// self · other
    pub fn times(&self, other: &Self) -> Self {
        if self.den.is_one() && other.den.is_one() {
            return self.num.times(&other.num).into();
        }
        // Cancel crosswise what can be.
        let cancel = |num: &Poly, den: &Poly| match num.over(den) {
            Some(quotient) => (quotient, Poly::constant(1)),
            None => (num.clone(), den.clone()),
        };
        let ((a, d), (b, c)) = (cancel(&self.num, &other.den), cancel(&other.num, &self.den));
        Ratio::new(a.times(&b), c.times(&d))
    }

    /// self / other; `None` if other is identically zero.
    pub fn over(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        Some(self.times(&Ratio::new(other.den.clone(), other.num.clone())))
    }

    /// Is it free of e^…?
    pub fn is_of_polynomials(&self) -> bool {
        !self.num.has_exponentials() && !self.den.has_exponentials()
    }

    /// Is it 0 wherever it is defined?
    pub fn is_zero(&self) -> bool {
        self.num.is_zero()
    }

    /// The number it is, if it is one.
    pub fn as_constant(&self) -> Option<Rational> {
        self.den.as_constant().and_then(|d| Some(self.num.as_constant()? / d))
    }

    /// All its symbols.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.num.all_symbols().into_iter().chain(self.den.all_symbols()).collect()
    }

    /// The derivative by a symbol.
    pub fn derivative(&self, x: Symbol) -> Self {
        let (n, d) = (Ratio::from(self.num.clone()), Ratio::from(self.den.clone()));
        let top = self.num.derivative(x).times(&d).minus(&n.times(&self.den.derivative(x)));
        let bottom = self.den.times(&self.den);
        Ratio::new(top.num, top.den.times(&bottom))
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

    /// As a formula.
    pub fn to_tree(&self, symbol: &impl Fn(Symbol) -> Tree) -> Tree {
        let num = self.num.to_tree(symbol);
        if self.den.is_one() { num } else { num / self.den.to_tree(symbol) }
    }
}

fn by_name(x: Symbol) -> Tree {
    Tree::symbol(x.0)
}

impl fmt::Display for Monomial {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        Poly::term(self.clone(), 1.into()).fmt(f)
    }
}

impl fmt::Display for Poly {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.to_tree(&by_name).fmt(f)
    }
}

impl fmt::Display for Ratio {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.to_tree(&by_name).fmt(f)
    }
}

/// Is this step one that a quotient of polynomials cannot have?
pub fn is_bracket(tree: &Tree) -> bool {
    matches!(tree.step(), Step::PositivePart(_) | Step::Min(..))
}
