//! Hypotheses: assumptions about the signs of quantities.

use crate::number::Tree;
use crate::number::tree::Op;
use std::fmt;

/// Relation of a quantity to zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Relation {
    /// > 0
    Positive,
    /// ≥ 0
    NonNegative,
    /// = 0
    Zero,
}

/// Writes the sign between two sides: `>`.
impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Relation::Positive => ">",
            Relation::NonNegative => "≥",
            Relation::Zero => "=",
        })
    }
}

/// A hypothesis: a recorded quantity and its relation to zero.
///
/// # Examples
///
/// ```
/// use provable::formula::{Hypothesis, Relation};
/// use provable::number::Tree;
/// let [c, eps] = ["c", "ε"].map(|name| Tree::symbol(name));
/// let stiffer = Hypothesis::new(Relation::Positive, &eps - &c);
/// assert_eq!(stiffer.to_string(), "ε > c");
/// assert!(stiffer.holds(&|name| if name == "c" { 1.0 } else { 2.0 }));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// The quantity.
    pub value: Tree,
    /// Its relation to zero.
    pub relation: Relation,
    /// Symbol to solve for when points that satisfy the hypothesis are constructed.
    pub solved_for: &'static str,
}

impl Hypothesis {
    /// Returns a hypothesis, to be solved for the first symbol in its quantity.
    ///
    /// # Panics
    /// Panics if the quantity is a number without symbols.
    pub fn new(relation: Relation, value: Tree) -> Self {
        let solved_for = value
            .first_symbol()
            .unwrap_or_else(|| panic!("a hypothesis needs a symbol, and {value} has none"));
        Hypothesis { value, relation, solved_for }
    }

    /// Sets the symbol to solve for, in which the quantity must be linear. If the quantity does not depend on
    /// it, as after a mutation, the symbol stays unchanged.
    pub fn solved_for(self, symbol: &Tree) -> Self {
        let depends = self.value.symbols().contains(name_of(symbol));
        let solved_for = if depends { name_of(symbol) } else { self.solved_for };
        Hypothesis { solved_for, ..self }
    }

    /// Assumes that a symbol lies in an interval; the bounds may be given in either order.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::{formula::Hypothesis, number::Tree};
    /// let [q, one] = [Tree::symbol("q"), Tree::from(1)];
    /// assert_eq!(Hypothesis::between(&q, Tree::from(0), one.clone()).to_string(), "0 ≤ q ≤ 1");
    /// ```
    /// # Panics
    /// Panics if `symbol` is not a symbol, or if a bound depends on it.
    pub fn between(symbol: &Tree, lower: impl Into<Tree>, upper: impl Into<Tree>) -> Self {
        let (lower, upper) = (lower.into(), upper.into());
        let name = name_of(symbol);
        let depends = [&lower, &upper].into_iter().any(|end| end.symbols().contains(name));
        assert!(!depends, "the interval of {name} depends on it");
        let hypothesis = Hypothesis::new(Relation::NonNegative, (upper - symbol) * (symbol - lower));
        Hypothesis { solved_for: name, ..hypothesis }
    }

    /// Assumes that the distance of a symbol from a quantity is at most `most`: `|u − Δ| ≤ tol`.
    ///
    /// # Panics
    /// Panics like [`between`](Self::between).
    pub fn near(symbol: &Tree, quantity: impl Into<Tree>, most: impl Into<Tree>) -> Self {
        let (quantity, most) = (quantity.into(), most.into());
        Hypothesis::between(symbol, &quantity - &most, quantity + most)
    }

    /// Returns the symbol and the bounds if the hypothesis is an interval.
    pub fn interval(&self) -> Option<(&'static str, &Tree, &Tree)> {
        let Op::Mul(above, below) = self.value.op() else { return None };
        let (Op::Sub(upper, x), Op::Sub(y, lower)) = (above.op(), below.op()) else { return None };
        let Op::Symbol(name) = x.op() else { return None };
        let depends = [lower, upper].into_iter().any(|end| end.symbols().contains(name));
        let is_interval = self.relation == Relation::NonNegative && x == y && !depends;
        is_interval.then_some((*name, lower, upper))
    }

    /// Returns the distance and its bound if the hypothesis states that a symbol is [near](Self::near) a
    /// quantity.
    pub fn distance(&self) -> Option<(Tree, &Tree)> {
        let (x, lower, upper) = self.interval()?;
        match (lower.op(), upper.op()) {
            (Op::Sub(a, least), Op::Add(b, most)) if a == b && least == most => {
                Some((Tree::symbol(x) - a, most))
            }
            _ => None,
        }
    }
}

/// Returns the name of a symbol.
///
/// # Panics
/// Panics if the formula is not a symbol.
pub(super) fn name_of(symbol: &Tree) -> &'static str {
    let Op::Symbol(name) = symbol.op() else { panic!("{symbol} is not a symbol") };
    name
}
