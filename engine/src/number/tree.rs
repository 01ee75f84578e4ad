//! Recorded formulas, which are the source of proofs, printing and mutation.

mod op;

pub use op::{Op, Site, all_ops, piecewise_ops, smooth_ops};

use super::{Dual, Exponential, Field, PositivePart};
use crate::operators;
use num_traits::{One, Zero};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::mem;
use std::panic::Location;
use std::sync::Arc;

/// A recorded formula: the value of a generic function that is called with trees.
///
/// A tree can be evaluated in any number system, proved about, printed, or mutated at one place. Each
/// operation has the [`Site`] of the source that performed it. Equality is structural and ignores sites.
///
/// # Examples
///
/// ```
/// use provable::number::{Field, Tree};
///
/// /// What is left of a voltage after a resistor.
/// fn remaining<T: Field>(u: &T, r: &T, i: &T) -> T {
///     u - r * i
/// }
///
/// let [u, r, i] = ["u", "R", "i"].map(|name| Tree::symbol(name));
/// let voltage = remaining(&u, &r, &i);
/// # #[cfg(feature = "prover")]
/// assert_eq!(voltage.to_string(), "u − R i");
/// let at = |name| if name == "u" { 5.0 } else { 2.0 };
/// assert_eq!(voltage.eval(&at, &|_| None), Some(1.0));
/// ```
#[derive(Clone, Debug)]
pub struct Tree(Arc<Node>);

#[derive(Debug)]
struct Node {
    op: Op<Tree>,
    site: Site,
    depth: u32,
    size: u32,
}

/// Size up to which a formula is visited without a table of shared operations.
pub(super) const SMALL: u32 = 64;

/// Depth below which a formula is dropped recursively.
const SHALLOW: u32 = 500;

impl Node {
    fn take_operands(&mut self) -> Vec<Tree> {
        mem::replace(&mut self.op, Op::Int(0)).operands().cloned().collect()
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        if self.depth < SHALLOW {
            return;
        }
        let mut open = self.take_operands();
        while let Some(tree) = open.pop() {
            if let Some(mut node) = Arc::into_inner(tree.0) {
                open.extend(node.take_operands());
            }
        }
    }
}

impl Tree {
    /// Returns a quantity.
    #[track_caller]
    pub fn symbol(name: &'static str) -> Self {
        node(Op::Symbol(name))
    }

    /// Returns fl(x), the number nearest to x in some precision, as a further operation.
    #[track_caller]
    pub fn round(&self) -> Self {
        node(Op::Rounded(self.clone()))
    }

    /// Returns the formula as a machine computes it: the result of every + − × ÷ and eˣ is rounded. A change
    /// of sign and the choice of one of two numbers are exact.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::number::Tree;
    /// let [l, u, h] = ["l", "u", "H"].map(|name| Tree::symbol(name));
    /// let sum = (&l + &u).round();
    /// assert_eq!((&l + &u - &h).with_rounding(), (sum - h).round());
    /// ```
    pub fn with_rounding(&self) -> Self {
        use Op::{Add, Div, Exp, Mul, Sub};
        self.rewrite(&|tree| match tree.op() {
            // The rounding has the site of the operation itself.
            Add(..) | Sub(..) | Mul(..) | Div(..) | Exp(_) => Some(tree.with_op(Op::Rounded(tree.clone()))),
            _ => None,
        })
    }

    /// Returns `true` if the formula contains fl(·).
    pub fn contains_rounding(&self) -> bool {
        self.any(&|tree| matches!(tree.op(), Op::Rounded(_)))
    }

    /// Returns the last operation.
    pub fn op(&self) -> &Op<Tree> {
        &self.0.op
    }

    /// Returns the place of the last operation in the source.
    pub fn site(&self) -> Site {
        self.0.site
    }

    /// Returns the largest number of operations between the last one and a quantity or number; 0 for these.
    pub fn depth(&self) -> u32 {
        self.0.depth
    }

    /// Returns the number of operations, quantities and numbers of the formula written out, at most
    /// `u32::MAX`.
    pub fn size(&self) -> u32 {
        self.0.size
    }

    /// Evaluates the formula in a number system. `extra_ops` evaluates eˣ, ⟨·⟩, min and rounding
    /// ([`piecewise_ops`], [`smooth_ops`], [`all_ops`]). Returns `None` if it does, or if a divisor is not
    /// invertible.
    pub fn eval<T: Field>(
        &self,
        symbol: &impl Fn(&'static str) -> T,
        extra_ops: &impl Fn(Op<&T>) -> Option<T>,
    ) -> Option<T> {
        if self.size() <= SMALL {
            let operands = self.op().try_map(|operand| operand.eval(symbol, extra_ops))?;
            return operands.map(|operand| operand).value(symbol, extra_ops);
        }
        let mut values: FxHashMap<_, T> = FxHashMap::default();
        for tree in self.distinct() {
            let operands = tree.op().map(|operand| &values[&operand.address()]);
            values.insert(tree.address(), operands.map(|operand| *operand).value(symbol, extra_ops)?);
        }
        values.remove(&self.address())
    }

    /// Returns the value of the formula and its derivative with respect to a quantity; `None` as for
    /// [`eval`](Self::eval).
    pub fn derivative<T: Field>(
        &self,
        by: &str,
        symbol: &impl Fn(&'static str) -> T,
        extra_ops: &impl Fn(Op<&Dual<T>>) -> Option<Dual<T>>,
    ) -> Option<Dual<T>> {
        self.eval(&|name| Dual::coordinate(symbol(name), name == by), extra_ops)
    }

    /// Solves the formula = `target` for one quantity in which it is linear, with the other quantities given.
    /// Returns `None` if the formula does not depend on the quantity, or contains eˣ, ⟨·⟩ or min. Roundings
    /// are ignored, so the result has their error.
    pub fn solve_linear<T: Field>(
        &self,
        by: &'static str,
        symbol: &impl Fn(&'static str) -> T,
        target: &T,
    ) -> Option<T> {
        let extra_ops = |op: Op<&Dual<T>>| if let Op::Rounded(x) = op { Some(x.clone()) } else { None };
        let Dual { value, derivative } = self.derivative(by, symbol, &extra_ops)?;
        derivative.is_invertible().then(|| symbol(by) + (target - value) / derivative)
    }

    /// Rebuilds the tree from its leaves: `f` may replace each operation, after its operands have been
    /// rebuilt.
    pub fn rewrite(&self, f: &impl Fn(&Tree) -> Option<Tree>) -> Tree {
        let mut rewritten: FxHashMap<_, Tree> = FxHashMap::default();
        for old in self.distinct() {
            let op = old.op().map(|operand| rewritten[&operand.address()].clone());
            let same = op.operands().zip(old.op().operands()).all(|(a, b)| a.address() == b.address());
            let tree = if same { old.clone() } else { old.with_op(op) };
            rewritten.insert(old.address(), f(&tree).unwrap_or(tree));
        }
        rewritten.remove(&self.address()).expect("the root is rewritten last")
    }

    pub(crate) fn address(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// Returns each operation once, even if shared, after its operands, from left to right.
    pub(crate) fn distinct(&self) -> Vec<&Tree> {
        let (mut found, mut all, mut open) = (FxHashSet::default(), Vec::new(), vec![(self, false)]);
        while let Some((tree, operands_are_done)) = open.pop() {
            if operands_are_done {
                all.push(tree);
            } else if found.insert(tree.address()) {
                open.push((tree, true));
                let first = open.len();
                open.extend(tree.op().operands().map(|operand| (operand, false)));
                open[first..].reverse();
            }
        }
        all
    }

    /// Substitutes formulas for quantities.
    pub fn substitute(&self, replaced: &[(&str, Tree)]) -> Tree {
        self.rewrite(&|tree| match tree.op() {
            Op::Symbol(name) => {
                replaced.iter().find(|(symbol, _)| symbol == name).map(|(_, tree)| tree.clone())
            }
            _ => None,
        })
    }

    /// Returns the tree with another last operation at the same place of the source.
    pub fn with_op(&self, op: Op<Tree>) -> Tree {
        Tree::at(self.0.site, op)
    }

    fn at(site: Site, op: Op<Tree>) -> Tree {
        let depth = op.operands().map(|operand| operand.depth().saturating_add(1)).max().unwrap_or(0);
        let size = op.operands().fold(1, |sum: u32, operand| sum.saturating_add(operand.size()));
        Tree(Arc::new(Node { op, site, depth, size }))
    }

    /// Calls `f` for every operation, the last first.
    pub fn visit<'a>(&'a self, f: &mut impl FnMut(&'a Tree)) {
        let mut open = vec![self];
        while let Some(tree) = open.pop() {
            f(tree);
            let first = open.len();
            open.extend(tree.op().operands());
            open[first..].reverse();
        }
    }

    /// Returns the first quantity in reading order.
    pub fn first_symbol(&self) -> Option<&'static str> {
        self.quantities().next()
    }

    /// Returns the quantities that the formula depends on.
    pub fn symbols(&self) -> BTreeSet<&'static str> {
        self.quantities().collect()
    }

    fn quantities(&self) -> impl Iterator<Item = &'static str> {
        self.distinct().into_iter().filter_map(|tree| match tree.op() {
            Op::Symbol(name) => Some(*name),
            _ => None,
        })
    }

    /// Returns `true` if an operation satisfies the predicate.
    pub fn any(&self, f: &impl Fn(&Tree) -> bool) -> bool {
        self.distinct().into_iter().any(f)
    }
}

/// Returns a quantity for each name.
///
/// # Examples
///
/// ```
/// let [u, v] = provable::number::symbols(["u", "v"]);
/// assert_eq!((&u + &v).symbols(), ["u", "v"].into());
/// ```
#[track_caller]
pub fn symbols<const N: usize>(names: [&'static str; N]) -> [Tree; N] {
    names.map(|name| Tree::symbol(name))
}

#[track_caller]
fn node(op: Op<Tree>) -> Tree {
    let at = Location::caller();
    let (file, line, column) = (at.file(), at.line(), at.column());
    let mut site = Site { file, line, column, rank: 0 };
    if let Some(Site { rank, .. }) = op
        .operands()
        .next()
        .map(Tree::site)
        .filter(|first| (first.file, first.line, first.column) == (file, line, column))
    {
        site.rank = rank + 1;
    }
    Tree::at(site, op)
}

impl PartialEq for Tree {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.op() == other.op()
    }
}

impl From<&Tree> for Tree {
    fn from(tree: &Tree) -> Self {
        tree.clone()
    }
}

impl From<i32> for Tree {
    #[track_caller]
    fn from(n: i32) -> Self {
        node(Op::Int(n))
    }
}

operators! { #[track_caller] [] Tree;
    Add add |a, b| node(Op::Add(a.clone(), b.clone()));
    Sub sub |a, b| node(Op::Sub(a.clone(), b.clone()));
    Mul mul |a, b| node(Op::Mul(a.clone(), b.clone()));
    Div div |a, b| node(Op::Div(a.clone(), b.clone()));
    - |a| node(Op::Neg(a.clone()))
}
impl Zero for Tree {
    #[track_caller]
    fn zero() -> Self {
        node(Op::Int(0))
    }
    fn is_zero(&self) -> bool {
        *self.op() == Op::Int(0)
    }
}
impl One for Tree {
    #[track_caller]
    fn one() -> Self {
        node(Op::Int(1))
    }
}
impl Field for Tree {
    #[track_caller]
    fn int(n: i32) -> Self {
        node(Op::Int(n))
    }
}
impl Exponential for Tree {
    #[track_caller]
    fn exp(&self) -> Self {
        node(Op::Exp(self.clone()))
    }
}
impl PositivePart for Tree {
    #[track_caller]
    fn positive_part(&self) -> Self {
        node(Op::PositivePart(self.clone()))
    }
    #[track_caller]
    fn min(&self, other: &Self) -> Self {
        node(Op::Min(self.clone(), other.clone()))
    }
    #[track_caller]
    fn abs(&self) -> Self {
        -PositivePart::min(&-self, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The operations of a chain begin at one place; the rank, from the left, is shown from the second on.
    #[test]
    fn operations_of_a_chain_have_distinct_sites() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let (chain, line) = (&a + &b - &a + &b, line!());
        let mut sites = Vec::new();
        chain.visit(&mut |tree| sites.extend((tree.site().line == line).then(|| tree.site().to_string())));
        let place = sites.last().expect("three of its steps").clone();
        assert!(place.starts_with(&format!("{}:{line}:", file!())) && !place.contains(' '), "{place}");
        assert_eq!(sites, [format!("{place} (operator 3)"), format!("{place} (operator 2)"), place]);
    }

    /// Each doubling is one further operation and doubles the size written out.
    #[test]
    fn a_deep_formula_is_traversed_and_dropped_without_recursion() {
        let x = Tree::symbol("x");
        let sum = |terms: u32| (0..terms).fold(x.clone(), |sum, _| sum + &x);
        let (deep, deeper) = (sum(100_000), sum(100_001));
        assert_eq!((deep.depth(), deep.size()), (100_000, 200_001));
        assert_eq!((deep.first_symbol(), deep.symbols().len()), (Some("x"), 1));
        assert!(!deep.contains_rounding() && deep.with_rounding().contains_rounding());
        assert_eq!(deep.substitute(&[("x", Tree::symbol("y"))]).symbols(), BTreeSet::from(["y"]));
        drop((deep, deeper));
        let doubled = (0..100).fold(x.clone(), |sum, _| &sum + &sum);
        assert_eq!((doubled.depth(), doubled.size()), (100, u32::MAX));
        assert_eq!(doubled.substitute(&[("x", Tree::one())]).first_symbol(), None);
    }

    /// fl(fl(2 x) + 1) = 7 is solved as 2 x + 1 = 7.
    #[test]
    fn solving_ignores_roundings() {
        let x = Tree::symbol("x");
        let formula = (Tree::int(2) * &x + Tree::one()).with_rounding();
        assert!(formula.contains_rounding());
        assert_eq!(formula.solve_linear("x", &|_| 0.5, &7.0), Some(3.0));
        assert_eq!(formula.solve_linear("y", &|_| 0.5, &7.0), None);
    }

    #[test]
    fn only_the_literal_zero_is_zero() {
        let x = Tree::symbol("x");
        assert!(Tree::zero().is_zero() && ![Tree::one(), &x - &x, x].iter().any(Tree::is_zero));
    }
}
