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
        let said = |left: &Tree, turned: bool, right: &Tree| {
            let between =
                if turned { exchanged(self.relation).to_string() } else { self.relation.to_string() };
            format!("{} {between} {}", text(left), text(right))
        };
        if let Some((x, lower, upper)) = self.interval() {
            return match self.distance() {
                Some((distance, most)) => format!("{} ≤ {}", text(&distance.abs()), text(most)),
                None => format!("{} ≤ {} ≤ {}", text(lower), text(&Tree::symbol(x)), text(upper)),
            };
        }
        let zero = Tree::int(0);
        let is_symbol = |tree: &Tree| matches!(tree.op(), Op::Symbol(_));
        match self.value.op() {
            _ if name(&self.value).is_some() => said(&self.value, false, &zero),
            Op::Neg(a) => said(a, true, &zero),
            Op::Sub(a, b) => match a.op() {
                Op::Neg(a) => said(a, true, &-b),
                // A single symbol comes first.
                _ if is_symbol(b) && !is_symbol(a) => said(b, true, a),
                _ => said(a, false, b),
            },
            _ => said(&self.value, false, &zero),
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
}
