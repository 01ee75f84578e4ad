//! Typesetting of hypotheses.

use super::{Name, Notation};
use crate::formula::hypothesis::{Hypothesis, Relation};
use crate::number::tree::Op;
use crate::number::{Field, PositivePart, Tree};
use std::fmt;

/// Returns the sign of the relation with its sides exchanged.
fn exchanged(relation: Relation) -> &'static str {
    match relation {
        Relation::Positive => "<",
        Relation::NonNegative => "≤",
        Relation::Zero => "=",
    }
}

impl Hypothesis {
    /// Formats the hypothesis, with the names that `name` returns for subformulas: `λ < R`.
    pub fn typeset(&self, name: &dyn Fn(&Tree) -> Option<Name>) -> String {
        let text = |tree: &Tree| tree.typeset(Notation::Text, name);
        if let Some((x, lower, upper)) = self.interval() {
            return match self.distance() {
                Some((distance, most)) => format!("{} ≤ {}", text(&distance.abs()), text(most)),
                None => format!("{} ≤ {} ≤ {}", text(lower), text(&Tree::symbol(x)), text(upper)),
            };
        }
        let (left, is_exchanged, right) = self.sides(name(&self.value).is_some());
        let relation = if is_exchanged { exchanged(self.relation) } else { &self.relation.to_string() };
        format!("{} {relation} {}", text(&left), text(&right))
    }

    /// Returns the two sides, and whether they are exchanged.
    fn sides(&self, is_named: bool) -> (Tree, bool, Tree) {
        match self.value.op() {
            Op::Neg(a) if !is_named => (a.clone(), true, Tree::int(0)),
            Op::Sub(a, b) if !is_named => match (a.op(), b.op()) {
                (Op::Neg(a), _) => (a.clone(), true, -b),
                (Op::Symbol(_), _) => (a.clone(), false, b.clone()),
                // A single symbol comes first.
                (_, Op::Symbol(_)) => (b.clone(), true, a.clone()),
                _ => (a.clone(), false, b.clone()),
            },
            _ => (self.value.clone(), false, Tree::int(0)),
        }
    }
}

/// Writes the hypothesis without names of subformulas.
impl fmt::Display for Hypothesis {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.typeset(&|_| None))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hypotheses_are_formatted_as_inequalities() {
        let [c, eps, r] = ["c", "ε", "R"].map(|name| Tree::symbol(name));
        let two = || Tree::int(2);
        let text = |relation, value| Hypothesis::new(relation, value).to_string();
        use Relation::*;
        for (relation, value, written) in [
            (Positive, c.clone(), "c > 0"),
            (NonNegative, -&c, "c ≤ 0"),
            (Zero, -&c, "c = 0"),
            (Positive, &eps - &c, "ε > c"),
            (NonNegative, &c * &r - &eps, "ε ≤ c R"),
            (Positive, two() * (&c + &eps) - &r, "R < 2 (c + ε)"),
            (Positive, -&eps - two() * &c, "ε < −2 c"),
            (Zero, &eps + two() * &c, "ε + 2 c = 0"),
        ] {
            assert_eq!(text(relation, value), written);
        }
    }

    #[test]
    fn a_named_negation_is_not_taken_apart() {
        let opposite = -Tree::symbol("c");
        let name = |tree: &Tree| {
            (*tree == opposite).then(|| Name { symbol: "S".to_string(), arguments: Vec::new() })
        };
        assert_eq!(Hypothesis::new(Relation::Positive, opposite.clone()).typeset(&name), "S > 0");
    }
}
