//! Mutations of formulas.

use crate::formula::{Proposition, Registry, Statement};
use crate::number::Tree;
use crate::number::tree::{Op, Site};
use crate::proof::prove;
use std::collections::BTreeSet;
use std::fmt;

/// A mutant of the source: a mutation of the operation at one location.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Mutant {
    /// The location of the operation.
    pub site: Site,
    /// The mutation of the operation.
    pub mutation: Mutation,
}

/// A mutation of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Mutation {
    /// + becomes −, × becomes ÷, and the other way round.
    Opposite(Operator),
    /// The operation is replaced by its first operand.
    FirstOperand(Operator),
    /// The operation is replaced by its second operand.
    SecondOperand(Operator),
    /// The operands of − or ÷ are exchanged.
    Swap(Operator),
    /// min becomes max.
    Maximum,
    /// −a becomes a.
    DropSign,
    /// eᵃ becomes e⁻ᵃ.
    NegateExponent,
    /// ⟨a⟩ becomes a.
    DropPositivePart,
    /// The first integer becomes the second.
    Integer(i32, i32),
    /// The symbol in the operand of this index becomes another symbol with which it may be confused.
    Symbol(usize, &'static str, &'static str),
}

/// A binary operator.
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
    fn of(op: &Op<Tree>) -> Option<(Self, &Tree, &Tree)> {
        match op {
            Op::Add(a, b) => Some((Operator::Add, a, b)),
            Op::Sub(a, b) => Some((Operator::Sub, a, b)),
            Op::Mul(a, b) => Some((Operator::Mul, a, b)),
            Op::Div(a, b) => Some((Operator::Div, a, b)),
            Op::Min(a, b) => Some((Operator::Min, a, b)),
            _ => None,
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
        !matches!(self, Operator::Sub | Operator::Div)
    }

    /// Returns the operands of an operation with this operator.
    fn operands(self, op: &Op<Tree>) -> Option<(&Tree, &Tree)> {
        Operator::of(op).filter(|(operator, ..)| *operator == self).map(|(_, a, b)| (a, b))
    }

    fn op(self, a: Tree, b: Tree) -> Op<Tree> {
        match self {
            Operator::Add => Op::Add(a, b),
            Operator::Sub => Op::Sub(a, b),
            Operator::Mul => Op::Mul(a, b),
            Operator::Div => Op::Div(a, b),
            Operator::Min => Op::Min(a, b),
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
            operator => format!("{a} {} {b}", operator.sign()),
        }
    }
}

impl Mutation {
    /// Returns all mutations of an operation.
    fn all(tree: &Tree, registry: &Registry) -> Vec<Mutation> {
        let mut all = Vec::new();
        match tree.op() {
            Op::Int(n) => all.extend(n.checked_add(1).map(|next| Mutation::Integer(*n, next))),
            Op::Neg(_) => all.push(Mutation::DropSign),
            Op::Exp(_) => all.push(Mutation::NegateExponent),
            Op::PositivePart(_) => all.push(Mutation::DropPositivePart),
            Op::Min(..) => all.push(Mutation::Maximum),
            _ => {}
        }
        if let Some((operator, ..)) = Operator::of(tree.op()) {
            all.extend(operator.opposite().map(|_| Mutation::Opposite(operator)));
            all.extend([Mutation::FirstOperand(operator), Mutation::SecondOperand(operator)]);
            all.extend((!operator.commutes()).then_some(Mutation::Swap(operator)));
        }
        for (index, operand) in tree.op().operands().enumerate() {
            if let Op::Symbol(name) = operand.op() {
                all.extend(registry.confusable_with(name).map(|other| Mutation::Symbol(index, name, other)));
            }
        }
        all
    }

    /// Applies the mutation to an operation; `None` if it is not applicable.
    fn mutate(self, tree: &Tree) -> Option<Tree> {
        use Mutation::*;
        match (self, tree.op()) {
            (Opposite(operator), op) => {
                let (a, b) = operator.operands(op)?;
                Some(tree.with_op(operator.opposite()?.op(a.clone(), b.clone())))
            }
            (FirstOperand(operator), op) => operator.operands(op).map(|(a, _)| a.clone()),
            (SecondOperand(operator), op) => operator.operands(op).map(|(_, b)| b.clone()),
            (Swap(operator), op) => {
                let (a, b) = operator.operands(op)?;
                Some(tree.with_op(operator.op(b.clone(), a.clone())))
            }
            (Maximum, Op::Min(a, b)) => {
                let [a, b] = [a, b].map(|operand| tree.with_op(Op::Neg(operand.clone())));
                Some(tree.with_op(Op::Neg(tree.with_op(Op::Min(a, b)))))
            }
            (NegateExponent, Op::Exp(a)) => Some(tree.with_op(Op::Exp(tree.with_op(Op::Neg(a.clone()))))),
            (DropSign, Op::Neg(a)) | (DropPositivePart, Op::PositivePart(a)) => Some(a.clone()),
            (Integer(from, to), Op::Int(n)) if *n == from => Some(tree.with_op(Op::Int(to))),
            (Symbol(index, from, to), op) => {
                let mut indices = 0..;
                let mut is_applicable = false;
                let op = op.map(|operand| {
                    let is_target = indices.next() == Some(index) && *operand.op() == Op::Symbol(from);
                    is_applicable |= is_target;
                    if is_target { operand.with_op(Op::Symbol(to)) } else { operand.clone() }
                });
                is_applicable.then(|| tree.with_op(op))
            }
            _ => None,
        }
    }
}

impl fmt::Display for Mutation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        use Mutation::*;
        match self {
            Opposite(operator) => {
                write!(f, "{} → {}", operator.sign(), operator.opposite().map_or("", Operator::sign))
            }
            FirstOperand(operator) => write!(f, "{} → a", operator.between("a", "b")),
            SecondOperand(operator) => write!(f, "{} → b", operator.between("a", "b")),
            Swap(operator) => write!(f, "{} → {}", operator.between("a", "b"), operator.between("b", "a")),
            Maximum => f.write_str("min → max"),
            DropSign => f.write_str("−a → a"),
            NegateExponent => f.write_str("exp(a) → exp(−a)"),
            DropPositivePart => f.write_str("⟨a⟩ → a"),
            Integer(from, to) => write!(f, "{from} → {to}"),
            Symbol(index, from, to) => write!(f, "{from} → {to} in operand {}", index + 1),
        }
    }
}

impl fmt::Display for Mutant {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} {}", self.site, self.mutation)
    }
}

impl Mutant {
    fn mutate(&self, tree: &Tree) -> Option<Tree> {
        if tree.site() == self.site { self.mutation.mutate(tree) } else { None }
    }

    /// Returns the mutated statement; `None` if the mutation applies to none of its formulas.
    pub fn apply(&self, statement: &Statement) -> Option<Statement> {
        statement.trees().any(|tree| self.affects(tree)).then(|| statement.map(&|tree| self.rewrite(tree)))
    }

    fn affects(&self, tree: &Tree) -> bool {
        tree.any(&|tree| self.mutate(tree).is_some())
    }

    /// Returns the mutated formula, or the same formula if the mutation does not apply.
    pub fn rewrite(&self, tree: &Tree) -> Tree {
        tree.rewrite(&|tree| self.mutate(tree))
    }

    /// Returns `true` if the mutation provably does not change the value of any formula of the registry in
    /// the statement.
    ///
    /// The value of the mutated operation itself may change, as when the operands of − are exchanged in
    /// (a − b)², but not that of the formula of the registry that contains it. Equality of the formulas of
    /// the claim would not suffice, as the claim could multiply by 0.
    pub(super) fn is_equivalent(&self, statement: &Statement, registry: &Registry) -> bool {
        statement.trees().all(|tree| self.preserves(tree, statement, registry))
    }

    fn preserves(&self, tree: &Tree, statement: &Statement, registry: &Registry) -> bool {
        if !self.affects(tree) {
            return true;
        }
        let equality = Proposition::Equal(tree.clone(), self.rewrite(tree));
        registry.has_site(&tree.site()) && prove(&statement.with_proposition(equality)).is_ok()
            || self.mutate(tree).is_none()
                && tree.op().operands().all(|operand| self.preserves(operand, statement, registry))
    }
}

/// Returns the formulas whose last operation is mutated, but not its symbols.
pub fn mutated(tree: &Tree) -> Vec<Tree> {
    let mutations = Mutation::all(tree, &Registry::default()).into_iter();
    mutations.filter_map(|mutation| mutation.mutate(tree)).collect()
}

/// Returns all mutants of functions of the registry that affect the statements.
pub fn mutants(statements: &[Statement], registry: &Registry) -> Vec<Mutant> {
    mutants_in(statements.iter().flat_map(Statement::trees), registry)
}

/// Returns all mutants of functions of the registry that affect the formulas.
pub fn mutants_in<'a>(trees: impl IntoIterator<Item = &'a Tree>, registry: &Registry) -> Vec<Mutant> {
    let mut all = BTreeSet::new();
    for tree in trees {
        tree.visit(&mut |tree| {
            let site = tree.site();
            if registry.has_site(&site) {
                all.extend(
                    Mutation::all(tree, registry).into_iter().map(|mutation| Mutant { site, mutation }),
                );
            }
        });
    }
    all.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Hypothesis;
    use crate::formula::claim::perturbed_recursion;
    use crate::formula::statement::Sequence;
    use crate::number::{Exponential, Field, PositivePart};

    #[test]
    fn mutations_agree_with_their_descriptions() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let registry = Registry::default().with_confusable(&[["c", "ε"]]);
        let check = |tree: &Tree, expected: &[(&str, Tree)]| {
            let mutant = |what: Mutation| (what.to_string(), what.mutate(tree).unwrap());
            let mutants: Vec<_> = Mutation::all(tree, &registry).into_iter().map(mutant).collect();
            let expected: Vec<_> =
                expected.iter().map(|(text, tree)| (text.to_string(), tree.clone())).collect();
            assert_eq!(mutants, expected);
        };
        let [first, second] = [&a, &b].map(Tree::clone);
        let operands = |sign| [format!("a {sign} b → a"), format!("a {sign} b → b")];
        let [to_a, to_b] = operands("+");
        check(&(&a + &b), &[("+ → −", &a - &b), (&to_a, first.clone()), (&to_b, second.clone())]);
        let [to_a, to_b] = operands("−");
        let swapped = ("a − b → b − a", &b - &a);
        check(&(&a - &b), &[("− → +", &a + &b), (&to_a, first.clone()), (&to_b, second.clone()), swapped]);
        let [to_a, to_b] = operands("×");
        check(&(&a * &b), &[("× → ÷", &a / &b), (&to_a, first.clone()), (&to_b, second.clone())]);
        check(&-&a, &[("−a → a", first.clone())]);
        check(&-&c, &[("−a → a", c.clone()), ("c → ε in operand 1", -Tree::symbol("ε"))]);
        check(&Tree::int(2), &[("2 → 3", Tree::int(3))]);
        check(&a.exp(), &[("exp(a) → exp(−a)", (-&a).exp())]);
        check(&a.positive_part(), &[("⟨a⟩ → a", first.clone())]);
        let maximum = ("min → max", -(-&a).min(&-&b));
        check(&a.min(&b), &[maximum, ("min(a, b) → a", first), ("min(a, b) → b", second)]);
    }

    #[test]
    fn only_the_symbol_or_integer_of_a_mutation_is_replaced() {
        let [a, c, eps] = ["a", "c", "ε"].map(|name| Tree::symbol(name));
        let mutation = |index| Mutation::Symbol(index, "c", "ε");
        let square = &c * &c;
        assert_eq!([0, 1].map(|i| mutation(i).mutate(&square)), [Some(&eps * &c), Some(&c * &eps)]);
        assert_eq!([0, 1].map(|i| mutation(i).mutate(&(&a * &c))), [None, Some(&a * &eps)]);
        assert_eq!(Mutation::Integer(2, 3).mutate(&Tree::int(5)), None);
    }

    /// Hypotheses, goals, computed quantities and the sequence are all changed.
    #[test]
    fn mutations_apply_to_all_formulas_of_a_statement() {
        let [q, u, v, w] = ["q", "u", "v", "w"].map(|name| Tree::symbol(name));
        let hypotheses =
            [Hypothesis::near(&u, &v, &v), Hypothesis::near(&q, 0, &v), Hypothesis::near(&v, 0, 2)];
        let statement = perturbed_recursion("stays", &v)
            .start(&v)
            .step(|x| x + &v)
            .bounding(|x| x - &v, &u)
            .near(&v, &u + &v)
            .assuming(&hypotheses)
            .computing(&u, &v);
        let replaced = |tree: &Tree| tree.substitute(&[("v", w.clone())]);
        let changed = statement.map(&replaced);
        let expected: Vec<_> = statement.trees().map(replaced).collect();
        assert_eq!(changed.trees().cloned().collect::<Vec<_>>(), expected);
        assert!([statement.hypotheses().len(), statement.invariants().len()].iter().all(|n| *n > 0));
        assert!(matches!(changed.computed(), [computed] if computed.formula == w));
        let Sequence { start, step, ratio, member, within, .. } = changed.conclusion().unwrap();
        let x = Tree::symbol("x₁");
        let all = [&start[..], step, std::slice::from_ref(ratio), member].concat();
        assert_eq!(all, [w.clone(), &x + &w, w.clone(), w.clone()]);
        assert_eq!(*within, [(&x - &w, &u + &w), (&x - &w, u.clone())]);
        let elsewhere = Mutant { site: (&u + &v).site(), mutation: Mutation::Opposite(Operator::Add) };
        assert!(elsewhere.apply(&statement).is_none());
    }
}
