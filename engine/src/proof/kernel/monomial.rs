//! Products of powers of symbols.

use super::algebra::Ratio;
use super::effort;
use std::cmp::Ordering;
use std::sync::Arc;

/// A quantity by its name.
#[derive(Clone, Copy, Debug, Eq)]
pub struct Symbol(pub &'static str);

impl PartialEq for Symbol {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0) || self.0 == other.0
    }
}

impl PartialOrd for Symbol {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// By name; where two names are one, that is seen without reading them.
impl Ord for Symbol {
    fn cmp(&self, other: &Self) -> Ordering {
        if std::ptr::eq(self.0, other.0) { Ordering::Equal } else { self.0.cmp(other.0) }
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
