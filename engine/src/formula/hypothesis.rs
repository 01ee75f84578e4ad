//! Hypotheses: assumptions about the signs of quantities.

use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Field, PositivePart, Tree};
use std::cmp::Ordering;
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

impl Relation {
    /// Returns `true` if a number of this sign satisfies the relation.
    pub fn admits(self, sign: Ordering) -> bool {
        match self {
            Relation::Positive => sign.is_gt(),
            Relation::NonNegative => sign.is_ge(),
            Relation::Zero => sign.is_eq(),
        }
    }
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

    /// Returns `true` if the hypothesis holds for these numbers. Returns `false` if its quantity is
    /// undefined.
    pub fn holds<T: PositivePart + PartialOrd>(&self, symbol: &impl Fn(&'static str) -> T) -> bool {
        self.holds_with(symbol, &piecewise_ops)
    }

    /// Like [`holds`](Self::holds), with further operations as in [`Tree::eval`].
    pub fn holds_with<T: Field + PartialOrd>(
        &self,
        symbol: &impl Fn(&'static str) -> T,
        extra_ops: &impl Fn(Op<&T>) -> Option<T>,
    ) -> bool {
        let value = self.value.eval(symbol, extra_ops);
        value.and_then(|value| value.partial_cmp(&T::zero())).is_some_and(|sign| self.relation.admits(sign))
    }

    /// Solves for the symbol [`solved_for`](field@Self::solved_for) so that the quantity, if it is linear in
    /// the symbol, has the value `target`; `None` if it does not depend on it. For an interval, `target` ≥ 0
    /// is the distance from the lower bound divided by that from the upper one.
    pub fn solve<T: PositivePart>(&self, symbol: &impl Fn(&'static str) -> T, target: &T) -> Option<T> {
        if let Some((_, lower, upper)) = self.interval() {
            let [lower, upper] = [lower, upper].map(|end| end.eval(symbol, &piecewise_ops));
            let (lower, upper) = (lower?, upper?);
            let whole = target + T::one();
            return whole.is_invertible().then(|| &lower + (upper - &lower) * target / whole);
        }
        self.value.solve_linear(self.solved_for, symbol, target)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hypothesis_is_solved_for_its_symbol() {
        let [c, eps] = ["c", "ε"].map(|name| Tree::symbol(name));
        let at = |name| if name == "c" { 3.0 } else { 2.0 };
        let stiffer = Hypothesis::new(Relation::Positive, &c - &eps);
        assert_eq!((stiffer.solved_for, stiffer.solve(&at, &0.0)), ("c", Some(2.0)));
        assert_eq!(stiffer.clone().solved_for(&eps).solve(&at, &0.0), Some(3.0));
        assert_eq!(stiffer.clone().solved_for(&Tree::symbol("x")), stiffer);
        let other = Hypothesis { solved_for: "x", ..stiffer };
        assert_eq!(other.solve(&at, &0.0), None);
    }

    #[test]
    fn an_interval_is_solved_between_its_ends() {
        let [q, u, c, d] = ["q", "u", "c", "d"].map(|name| Tree::symbol(name));
        let near = Hypothesis::near(&q, &u, &c);
        assert_eq!(near.distance(), Some((&q - &u, &c)));
        for other in [(&u - &c, &u + &d), (&d - &c, &u + &c), (&d - &u, &u + &c)] {
            assert_eq!(Hypothesis::between(&q, other.0, other.1).distance(), None);
        }
        // At two thirds of the interval the distance from 1 is twice that from 4.
        let at = |name| if name == "u" { 1.0 } else { 4.0 };
        let between = Hypothesis::between(&q, &u, &c);
        assert_eq!((between.solved_for, between.solve(&at, &2.0)), ("q", Some(3.0)));
        assert_eq!([0.0, -1.0].map(|target| between.solve(&at, &target)), [Some(1.0), None]);
    }

    #[test]
    fn a_hypothesis_does_not_hold_where_its_quantity_is_undefined() {
        let inverse = Tree::int(1) / Tree::symbol("c");
        for relation in [Relation::Positive, Relation::NonNegative, Relation::Zero] {
            let hypothesis = Hypothesis::new(relation, inverse.clone());
            assert!(!hypothesis.holds(&|_| 0.0), "{hypothesis} at 0");
            assert!(!hypothesis.holds(&|_| f64::NAN), "{hypothesis} at no number");
        }
        assert!(Hypothesis::new(Relation::Positive, inverse).holds(&|_| 2.0));
    }
}
