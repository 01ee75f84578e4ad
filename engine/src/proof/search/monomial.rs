//! Symbols and monomials, the products of their powers.

use super::algebra::Ratio;
use crate::formula::symbols::subscripted;
use crate::proof::effort;
use std::cmp::Ordering;
use std::sync::Arc;

/// A symbol of a polynomial. Those of the statement come first, by name.
#[derive(Clone, Copy, Debug)]
pub enum Symbol {
    /// A symbol of the statement.
    Own(&'static str),
    /// A relative rounding error divided by its maximum: e₁, e₂, …, with −1 ≤ e ≤ 1.
    Error(u8),
    /// The value of a hypothesis: s₁, s₂, ….
    Slack(u8),
    /// The parameter of a quantity in an interval: t₁, t₂, …, with −1 ≤ t ≤ 1.
    Place(u8),
}

impl Symbol {
    /// Returns `true` if the symbol is between −1 and 1 by definition.
    pub fn in_unit_interval(self) -> bool {
        matches!(self, Symbol::Error(_) | Symbol::Place(_))
    }

    /// Returns the printed name.
    pub fn name(self) -> &'static str {
        match self {
            Symbol::Own(name) => name,
            Symbol::Error(index) => subscripted('e', index),
            Symbol::Slack(index) => subscripted('s', index),
            Symbol::Place(index) => subscripted('t', index),
        }
    }
}

impl Ord for Symbol {
    fn cmp(&self, other: &Self) -> Ordering {
        // A loop over the few bytes of a name is faster than a comparison of texts of any length.
        fn kind(symbol: Symbol) -> (u8, u8) {
            match symbol {
                Symbol::Own(_) => (0, 0),
                Symbol::Error(index) => (1, index),
                Symbol::Slack(index) => (2, index),
                Symbol::Place(index) => (3, index),
            }
        }
        match (self, other) {
            (Symbol::Own(a), Symbol::Own(b)) if a.as_ptr() == b.as_ptr() => a.len().cmp(&b.len()),
            (Symbol::Own(a), Symbol::Own(b)) => a.bytes().cmp(b.bytes()),
            (a, b) => kind(*a).cmp(&kind(*b)),
        }
    }
}

impl PartialOrd for Symbol {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Symbol {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Symbol {}

/// Maximum power of a symbol. A formula within the limits of a proof does not exceed it; only repeated
/// substitution of pivots does.
const MAX_POWER: u32 = 20_000;

/// A product of powers of symbols, times e to the power of a quotient, if any.
///
/// One exponential suffices, since eᵃ eᵇ = eᵃ⁺ᵇ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monomial {
    /// The nonzero powers, ordered by symbol.
    pub(super) powers: Vec<(Symbol, u32)>,
    pub(super) exponent: Option<Arc<Ratio>>,
}

impl Monomial {
    /// Returns the empty product.
    pub fn one() -> Self {
        Monomial { powers: Vec::new(), exponent: None }
    }

    /// Returns the symbol `x` as a monomial.
    pub fn of(x: Symbol) -> Self {
        Monomial { powers: vec![(x, 1)], exponent: None }
    }

    /// Returns the symbol if the monomial is a single symbol.
    pub fn as_symbol(&self) -> Option<Symbol> {
        match (&self.powers[..], &self.exponent) {
            ([(x, 1)], None) => Some(*x),
            _ => None,
        }
    }

    /// Returns the symbols with their powers, ordered by symbol.
    pub fn powers(&self) -> impl ExactSizeIterator<Item = (Symbol, u32)> {
        self.powers.iter().copied()
    }

    /// Returns the exponent of e, if any.
    pub fn exponent(&self) -> Option<&Ratio> {
        self.exponent.as_deref()
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut powers = Vec::with_capacity(self.powers.len() + other.powers.len());
        let mut others = &other.powers[..];
        for (x, n) in &self.powers {
            let mut sum = *n;
            while let [(y, m), rest @ ..] = others
                && y <= x
            {
                others = rest;
                if x == y {
                    sum = sum.saturating_add(*m);
                    if sum > MAX_POWER {
                        effort::exceed();
                    }
                } else {
                    powers.push((*y, *m));
                }
            }
            powers.push((*x, sum));
        }
        powers.extend_from_slice(others);
        let exponent = match (&self.exponent, &other.exponent) {
            (None, e) | (e, None) => e.clone(),
            (Some(a), Some(b)) => Some(&**a + &**b).filter(|sum| !sum.is_zero()).map(Arc::new),
        };
        Monomial { powers, exponent }
    }

    /// Returns the quotient if the divisor divides `self` and has no e^….
    pub(super) fn over(&self, divisor: &Self) -> Option<Self> {
        if divisor.exponent.is_some() {
            return None;
        }
        if !self.is_divisible_by(divisor) {
            return None;
        }
        let mut rest = self.clone();
        rest.powers.retain_mut(|(x, n)| {
            *n -= divisor.degree(*x);
            *n > 0
        });
        Some(rest)
    }

    /// Returns `true` if `other` divides `self`, disregarding e^….
    pub fn is_divisible_by(&self, other: &Self) -> bool {
        let mut powers = self.powers.iter();
        other.powers.iter().all(|(x, n)| powers.any(|(y, m)| x == y && m >= n))
    }

    /// Returns the monomial without its e^….
    pub fn without_exponential(&self) -> Self {
        Monomial { powers: self.powers.clone(), exponent: None }
    }

    /// Returns the monomial without the symbols for which `some` is `true`.
    pub fn without_symbols(&self, some: impl Fn(Symbol) -> bool) -> Self {
        let mut rest = self.clone();
        rest.powers.retain(|(x, _)| !some(*x));
        rest
    }

    pub(super) fn degree(&self, x: Symbol) -> u32 {
        self.powers.iter().find(|(y, _)| *y == x).map_or(0, |(_, n)| *n)
    }

    pub(super) fn without(&self, x: Symbol) -> Self {
        self.without_symbols(|y| y == x)
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The lexicographic order of the powers. Multiplication preserves it, which long division requires.
impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        let mut others = other.powers.iter();
        for (x, n) in &self.powers {
            let Some((y, m)) = others.next() else { return Ordering::Greater };
            let first = y.cmp(x).then(n.cmp(m));
            if first.is_ne() {
                return first;
            }
        }
        others.next().map_or_else(|| self.exponent.cmp(&other.exponent), |_| Ordering::Less)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_have_names() {
        let all = [Symbol::Error(0), Symbol::Slack(11), Symbol::Place(u8::MAX), Symbol::Own("e")];
        assert_eq!(all.map(Symbol::name), ["e₁", "s₁₂", "t₂₅₆", "e"]);
    }
}
