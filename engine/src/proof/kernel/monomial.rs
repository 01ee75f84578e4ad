//! Symbols, and products of their powers.

use super::algebra::Ratio;
use super::effort;
use crate::formula::claim::numbered;
use std::cmp::Ordering;
use std::sync::Arc;

/// A symbol of a polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symbol {
    /// A symbol of the statement.
    Own(&'static str),
    /// The error of a rounding in units of the largest, e₁, e₂, …: −1 ≤ e ≤ 1.
    Error(u8),
    /// The value of a hypothesis, s₁, s₂, ….
    Slack(u8),
    /// The place of a quantity in its interval, t₁, t₂, …: −1 ≤ t ≤ 1.
    Place(u8),
}

impl Symbol {
    /// Returns `true` if it is between −1 and 1.
    pub fn is_small(self) -> bool {
        matches!(self, Symbol::Error(_) | Symbol::Place(_))
    }

    /// Returns the name that a reader sees.
    pub fn name(self) -> &'static str {
        match self {
            Symbol::Own(name) => name,
            Symbol::Error(index) => numbered('e', index),
            Symbol::Slack(index) => numbered('s', index),
            Symbol::Place(index) => numbered('t', index),
        }
    }

    /// Returns `true` if a reader would take a symbol of this name for one of a proof.
    pub fn is_reserved(name: &str) -> bool {
        let digits = name.strip_prefix(['e', 's', 't']).unwrap_or_default();
        !digits.is_empty() && digits.chars().all(|digit| ('₀'..='₉').contains(&digit))
    }
}

/// The highest power of a symbol. A formula within the limits of a proof has none above it, and only pivots
/// that are replaced by each other do.
const MAX_POWER: u32 = 20_000;

/// A product of powers of symbols, times e to a quotient, if any.
///
/// One exponential is enough, since eᵃ eᵇ = eᵃ⁺ᵇ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monomial {
    /// By name; none of them is 0.
    pub(super) powers: Vec<(Symbol, u32)>,
    pub(super) exponent: Option<Arc<Ratio>>,
}

impl Monomial {
    /// The empty product.
    pub fn one() -> Self {
        Monomial { powers: Vec::new(), exponent: None }
    }

    /// A symbol.
    pub fn of(x: Symbol) -> Self {
        Monomial { powers: vec![(x, 1)], exponent: None }
    }

    /// Returns the symbol that it is, if it is one.
    pub fn as_symbol(&self) -> Option<Symbol> {
        match (&self.powers[..], &self.exponent) {
            ([(x, 1)], None) => Some(*x),
            _ => None,
        }
    }

    /// The powers of its symbols, by name.
    pub fn powers(&self) -> impl ExactSizeIterator<Item = (Symbol, u32)> {
        self.powers.iter().copied()
    }

    /// What e is raised to, if it is.
    pub fn exponent(&self) -> Option<&Ratio> {
        self.exponent.as_deref()
    }

    pub(super) fn times(&self, other: &Self) -> Self {
        let mut powers = Vec::with_capacity(self.powers.len() + other.powers.len());
        let mut others = &other.powers[..];
        for (x, n) in &self.powers {
            let mut sum = *n;
            while let [(y, m), rest @ ..] = others
                && y <= x
            {
                others = rest;
                if x == y {
                    sum = sum.checked_add(*m).filter(|n| *n <= MAX_POWER).unwrap_or_else(|| effort::exceed());
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

    /// The quotient, if every power of the divisor is there; the divisor has no e^….
    pub(super) fn over(&self, divisor: &Self) -> Option<Self> {
        if divisor.exponent.is_some() {
            return None;
        }
        if !self.has(divisor) {
            return None;
        }
        let mut rest = self.clone();
        rest.powers.retain_mut(|(x, n)| {
            *n -= divisor.degree(*x);
            *n > 0
        });
        Some(rest)
    }

    /// Are all powers of the other there? Its e^… is not asked for.
    pub fn has(&self, other: &Self) -> bool {
        let mut own = self.powers.iter();
        other.powers.iter().all(|(x, n)| own.any(|(y, m)| x == y && m >= n))
    }

    /// Without its e^….
    pub fn bare(&self) -> Self {
        Monomial { powers: self.powers.clone(), exponent: None }
    }

    /// Without some of its symbols.
    pub fn without_those(&self, some: impl Fn(Symbol) -> bool) -> Self {
        let mut rest = self.clone();
        rest.powers.retain(|(x, _)| !some(*x));
        rest
    }

    pub(super) fn degree(&self, x: Symbol) -> u32 {
        self.powers.iter().find(|(y, _)| *y == x).map_or(0, |(_, n)| *n)
    }

    pub(super) fn without(&self, x: Symbol) -> Self {
        self.without_those(|y| y == x)
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
    fn every_symbol_of_a_proof_has_a_name_that_is_reserved() {
        let all = [Symbol::Error(0), Symbol::Slack(11), Symbol::Place(u8::MAX), Symbol::Own("e")];
        assert_eq!(all.map(Symbol::name), ["e₁", "s₁₂", "t₂₅₆", "e"]);
        assert_eq!(all.map(|symbol| Symbol::is_reserved(symbol.name())), [true, true, true, false]);
    }
}
