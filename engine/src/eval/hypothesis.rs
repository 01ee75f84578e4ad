//! Hypotheses about numbers: whether they hold, and numbers for which they do.

use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Field, PositivePart};
use std::cmp::Ordering;

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

impl Hypothesis {
    /// Returns `true` if the hypothesis holds for these numbers. Returns `false` if its quantity is
    /// undefined.
    pub fn holds<T: PositivePart + PartialOrd>(&self, symbol: &impl Fn(&'static str) -> T) -> bool {
        self.holds_with(symbol, &piecewise_ops)
    }

    /// Like [`holds`](Self::holds), with further operations as in [`Tree::eval`](crate::number::Tree::eval).
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Tree;

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
        // (u − q)(c − d) ≥ 0, and (u − q)(q − c) = 0.
        let product = (&u - &q) * (&c - &d);
        assert_eq!(Hypothesis::new(Relation::NonNegative, product).interval(), None);
        let ends = Hypothesis::new(Relation::Zero, (&u - &q) * (&q - &c));
        assert_eq!(ends.interval(), None);
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
