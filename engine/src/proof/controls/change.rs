//! What can be changed in a formula.

use crate::formula::{Proposition, Registry, Statement};
use crate::number::Tree;
use crate::number::tree::{Site, Step};
use crate::proof::prove;
use std::collections::BTreeSet;
use std::fmt;

/// A small edit of the source: what is done to the step that is written at a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Change {
    /// Where.
    pub site: Site,
    /// What.
    pub what: What,
}

/// What is edited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum What {
    /// + becomes −, × becomes ÷, and the other way round.
    Opposite(Operator),
    /// Only the first operand is kept.
    First(Operator),
    /// Only the second operand is kept.
    Second(Operator),
    /// The operands of − or ÷ trade places.
    Swap(Operator),
    /// min becomes max.
    Maximum,
    /// The sign before an operand is dropped.
    DropSign,
    /// eᵃ becomes e⁻ᵃ.
    NegateExponent,
    /// ⟨a⟩ becomes a.
    DropBracket,
    /// The first integer becomes the second.
    Integer(i32, i32),
    /// In this operand, the first being 0, a symbol becomes another of the same unit.
    Symbol(usize, &'static str, &'static str),
}

/// An operator of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operator {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a × b
    Mul,
    /// a ÷ b
    Div,
    /// min(a, b)
    Min,
}

impl Operator {
    fn of(step: &Step<Tree>) -> Option<(Self, &Tree, &Tree)> {
        match step {
            Step::Add(a, b) => Some((Operator::Add, a, b)),
            Step::Sub(a, b) => Some((Operator::Sub, a, b)),
            Step::Mul(a, b) => Some((Operator::Mul, a, b)),
            Step::Div(a, b) => Some((Operator::Div, a, b)),
            Step::Min(a, b) => Some((Operator::Min, a, b)),
            Step::Symbol(_) | Step::Int(_) | Step::Neg(_) => None,
            Step::Exp(_) | Step::PositivePart(_) | Step::Rounded(_) => None,
        }
    }

    fn opposite(self) -> Option<Self> {
        match self {
            Operator::Add => Some(Operator::Sub),
            Operator::Sub => Some(Operator::Add),
            Operator::Mul => Some(Operator::Div),
            Operator::Div => Some(Operator::Mul),
            Operator::Min => None,
        }
    }

    fn commutes(self) -> bool {
        match self {
            Operator::Add | Operator::Mul | Operator::Min => true,
            Operator::Sub | Operator::Div => false,
        }
    }

    fn step(self, a: Tree, b: Tree) -> Step<Tree> {
        match self {
            Operator::Add => Step::Add(a, b),
            Operator::Sub => Step::Sub(a, b),
            Operator::Mul => Step::Mul(a, b),
            Operator::Div => Step::Div(a, b),
            Operator::Min => Step::Min(a, b),
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Operator::Add => "+",
            Operator::Sub => "−",
            Operator::Mul => "×",
            Operator::Div => "÷",
            Operator::Min => "min",
        }
    }

    fn between(self, a: &str, b: &str) -> String {
        match self {
            Operator::Min => format!("min({a}, {b})"),
            Operator::Add | Operator::Sub | Operator::Mul | Operator::Div => {
                format!("{a} {} {b}", self.sign())
            }
        }
    }
}

impl What {
    /// All that can be done to a step.
    fn all(tree: &Tree, registry: &Registry) -> Vec<What> {
        let mut all = Vec::new();
        match tree.step() {
            Step::Symbol(_) | Step::Rounded(_) => {}
            Step::Int(n) => all.extend(n.checked_add(1).map(|next| What::Integer(*n, next))),
            Step::Neg(_) => all.push(What::DropSign),
            Step::Exp(_) => all.push(What::NegateExponent),
            Step::PositivePart(_) => all.push(What::DropBracket),
            Step::Min(..) => all.push(What::Maximum),
            Step::Add(..) | Step::Sub(..) | Step::Mul(..) | Step::Div(..) => {}
        }
        if let Some((operator, ..)) = Operator::of(tree.step()) {
            all.extend(operator.opposite().map(|_| What::Opposite(operator)));
            all.extend([What::First(operator), What::Second(operator)]);
            all.extend((!operator.commutes()).then_some(What::Swap(operator)));
        }
        for (place, operand) in tree.step().operands().enumerate() {
            if let Step::Symbol(name) = operand.step() {
                all.extend(registry.mistaken_for(name).map(|other| What::Symbol(place, name, other)));
            }
        }
        all
    }

    /// The edits of a step that may undo a mistake: [`all`](Self::all), and for an integer n also the
    /// integers up to 24, −n, 2 n and n/2.
    fn repairs(tree: &Tree, registry: &Registry) -> Vec<What> {
        const LARGEST: i32 = 24;
        let mut repairs = What::all(tree, registry);
        if let Step::Int(n) = *tree.step() {
            let near = [n.checked_neg(), n.checked_mul(2), Some(n / 2)].into_iter().flatten();
            let others: BTreeSet<i32> = (0..=LARGEST).chain(near).filter(|other| *other != n).collect();
            repairs.extend(others.into_iter().map(|other| What::Integer(n, other)));
        }
        repairs
    }

    /// The step after the edit; `None` if there is nothing to edit.
    fn edit(self, tree: &Tree) -> Option<Tree> {
        match self {
            What::Opposite(operator) => {
                let (own, a, b) = Operator::of(tree.step())?;
                (own == operator).then_some(())?;
                Some(tree.with_step(operator.opposite()?.step(a.clone(), b.clone())))
            }
            What::First(operator) | What::Second(operator) | What::Swap(operator) => {
                let (own, a, b) = Operator::of(tree.step())?;
                (own == operator).then_some(())?;
                Some(match self {
                    What::First(_) => a.clone(),
                    What::Second(_) => b.clone(),
                    _ => tree.with_step(operator.step(b.clone(), a.clone())),
                })
            }
            What::Maximum => {
                let Step::Min(a, b) = tree.step() else { return None };
                let negated = |a: &Tree| tree.with_step(Step::Neg(a.clone()));
                Some(negated(&tree.with_step(Step::Min(negated(a), negated(b)))))
            }
            What::DropSign => {
                let Step::Neg(a) = tree.step() else { return None };
                Some(a.clone())
            }
            What::NegateExponent => {
                let Step::Exp(a) = tree.step() else { return None };
                Some(tree.with_step(Step::Exp(tree.with_step(Step::Neg(a.clone())))))
            }
            What::DropBracket => {
                let Step::PositivePart(a) = tree.step() else { return None };
                Some(a.clone())
            }
            What::Integer(from, to) => {
                let Step::Int(own) = tree.step() else { return None };
                (*own == from).then(|| tree.with_step(Step::Int(to)))
            }
            What::Symbol(place, from, to) => {
                let mut index = 0..;
                let mut replaced = false;
                let step = tree.step().map(|operand| {
                    let here = index.next() == Some(place) && *operand.step() == Step::Symbol(from);
                    replaced |= here;
                    if here { operand.with_step(Step::Symbol(to)) } else { operand.clone() }
                });
                replaced.then(|| tree.with_step(step))
            }
        }
    }
}

impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            What::Opposite(operator) => {
                write!(f, "{} → {}", operator.sign(), operator.opposite().map_or("", Operator::sign))
            }
            What::First(operator) => write!(f, "{} → a", operator.between("a", "b")),
            What::Second(operator) => write!(f, "{} → b", operator.between("a", "b")),
            What::Swap(operator) => {
                write!(f, "{} → {}", operator.between("a", "b"), operator.between("b", "a"))
            }
            What::Maximum => f.write_str("min → max"),
            What::DropSign => f.write_str("−a → a"),
            What::NegateExponent => f.write_str("exp(a) → exp(−a)"),
            What::DropBracket => f.write_str("⟨a⟩ → a"),
            What::Integer(from, to) => write!(f, "{from} → {to}"),
            What::Symbol(place, from, to) => {
                write!(f, "{from} → {to} in operand {}", place + 1)
            }
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} {}", self.site, self.what)
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Change);

impl Change {
    fn edit(&self, tree: &Tree) -> Option<Tree> {
        if tree.site() == self.site { self.what.edit(tree) } else { None }
    }

    /// The statement after the change, in its hypotheses and its goals; `None` if it does not touch it.
    pub fn apply(&self, statement: &Statement) -> Option<Statement> {
        statement.trees().any(|tree| self.touches(tree)).then(|| statement.map(&|tree| self.rewrite(tree)))
    }

    fn touches(&self, tree: &Tree) -> bool {
        tree.any(&|tree| self.edit(tree).is_some())
    }

    /// A formula after the change.
    pub fn rewrite(&self, tree: &Tree) -> Tree {
        tree.rewrite(&|tree| self.edit(tree))
    }

    /// Is every formula of the registry that it changes in the statement equal to what it was, and provably
    /// so?
    ///
    /// Not the edited step itself has to be, but some formula of the registry that it is a part of: in (a −
    /// b)² the operands of − may trade places. That the claim's own formulas stay the same would say too
    /// little: it could multiply by 0.
    pub(super) fn changes_nothing(&self, statement: &Statement, registry: &Registry) -> bool {
        statement.trees().all(|tree| self.keeps(tree, statement, registry))
    }

    fn keeps(&self, tree: &Tree, statement: &Statement, registry: &Registry) -> bool {
        if !self.touches(tree) {
            return true;
        }
        let equal =
            |after| prove(&statement.with_proposition(Proposition::Equal(tree.clone(), after))).is_ok();
        registry.has_site(&tree.site()) && equal(self.rewrite(tree))
            || self.edit(tree).is_none()
                && tree.step().operands().all(|operand| self.keeps(operand, statement, registry))
    }
}

/// Every change of a function of the registry that one of the statements can see.
pub fn changes(statements: &[Statement], registry: &Registry) -> Vec<Change> {
    changes_in(statements.iter().flat_map(Statement::trees), registry)
}

/// Every change of a function of the registry that one of these formulas can see.
pub fn changes_in<'a>(trees: impl IntoIterator<Item = &'a Tree>, registry: &Registry) -> Vec<Change> {
    edits_in(trees, registry, What::all)
}

/// Every change of a function of the registry that may undo a mistake in one of the statements: the
/// [`changes`], and more integers.
pub fn possible_repairs(statements: &[Statement], registry: &Registry) -> Vec<Change> {
    edits_in(statements.iter().flat_map(Statement::trees), registry, What::repairs)
}

fn edits_in<'a>(
    trees: impl IntoIterator<Item = &'a Tree>,
    registry: &Registry,
    edits: fn(&Tree, &Registry) -> Vec<What>,
) -> Vec<Change> {
    let mut all = BTreeSet::new();
    for tree in trees {
        tree.visit(&mut |tree| {
            let site = tree.site();
            if registry.has_site(&site) {
                all.extend(edits(tree, registry).into_iter().map(|what| Change { site, what }));
            }
        });
    }
    all.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Hypothesis;
    use crate::formula::claim::drift;
    use crate::formula::statement::Sequence;
    use crate::number::{Exponential, Field, PositivePart};

    #[test]
    fn every_edit_is_as_it_is_displayed() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let registry = Registry::default().alike(&[["c", "ε"]]);
        let edited = |tree: &Tree, expected: &[(&str, Tree)]| {
            let edit = |what: What| (what.to_string(), what.edit(tree).unwrap());
            let edits: Vec<_> = What::all(tree, &registry).into_iter().map(edit).collect();
            let expected: Vec<_> =
                expected.iter().map(|(text, tree)| (text.to_string(), tree.clone())).collect();
            assert_eq!(edits, expected);
        };
        let [first, second] = [&a, &b].map(Tree::clone);
        let kept = |sign| [format!("a {sign} b → a"), format!("a {sign} b → b")];
        let [to_a, to_b] = kept("+");
        edited(&(&a + &b), &[("+ → −", &a - &b), (&to_a, first.clone()), (&to_b, second.clone())]);
        let [to_a, to_b] = kept("−");
        let swapped = ("a − b → b − a", &b - &a);
        edited(&(&a - &b), &[("− → +", &a + &b), (&to_a, first.clone()), (&to_b, second.clone()), swapped]);
        let [to_a, to_b] = kept("×");
        edited(&(&a * &b), &[("× → ÷", &a / &b), (&to_a, first.clone()), (&to_b, second.clone())]);
        edited(&-&a, &[("−a → a", first.clone())]);
        edited(&-&c, &[("−a → a", c.clone()), ("c → ε in operand 1", -Tree::symbol("ε"))]);
        edited(&Tree::int(2), &[("2 → 3", Tree::int(3))]);
        edited(&a.exp(), &[("exp(a) → exp(−a)", (-&a).exp())]);
        edited(&a.positive_part(), &[("⟨a⟩ → a", first.clone())]);
        let maximum = ("min → max", -(-&a).min(&-&b));
        edited(&a.min(&b), &[maximum, ("min(a, b) → a", first), ("min(a, b) → b", second)]);
    }

    #[test]
    fn a_symbol_is_mistaken_in_one_operand() {
        let [a, c, eps] = ["a", "c", "ε"].map(|name| Tree::symbol(name));
        let mistaken = |place| What::Symbol(place, "c", "ε");
        let square = &c * &c;
        assert_eq!([0, 1].map(|i| mistaken(i).edit(&square)), [Some(&eps * &c), Some(&c * &eps)]);
        assert_eq!([0, 1].map(|i| mistaken(i).edit(&(&a * &c))), [None, Some(&a * &eps)]);
    }

    /// In its hypotheses, its goals, what is computed, and the sequence that it is about.
    #[test]
    fn a_change_is_made_in_all_formulas_of_a_statement() {
        let [q, u, v, w] = ["q", "u", "v", "w"].map(|name| Tree::symbol(name));
        let given = [Hypothesis::near(&u, &v, &v), Hypothesis::near(&q, 0, &v), Hypothesis::near(&v, 0, 2)];
        let statement = drift("stays", &v, &v, |x| x + &v, (v.clone(), &u + &v), |x| [(x - &v, u.clone())])
            .assuming(&given)
            .computing(&u, &v);
        let replaced = |tree: &Tree| tree.with(&[("v", w.clone())]);
        let changed = statement.map(&replaced);
        let expected: Vec<_> = statement.trees().map(replaced).collect();
        assert_eq!(changed.trees().cloned().collect::<Vec<_>>(), expected);
        assert!([statement.hypotheses().len(), statement.invariants().len()].iter().all(|n| *n > 0));
        assert!(matches!(changed.computed(), [computed] if computed.by == w));
        let Sequence { start, step, ratio, member, within, .. } = changed.conclusion().unwrap();
        let x = Tree::symbol("x₁");
        let all = [&start[..], step, std::slice::from_ref(ratio), member].concat();
        assert_eq!(all, [w.clone(), &x + &w, w.clone(), w.clone()]);
        assert_eq!(*within, [(&x - &w, &u + &w), (&x - &w, u.clone())]);
        let elsewhere = Change { site: (&u + &v).site(), what: What::Opposite(Operator::Add) };
        assert!(elsewhere.apply(&statement).is_none());
    }
}
