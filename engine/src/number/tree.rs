//! What a formula does, step by step: the reading that all readings without numbers start from.

mod step;

pub use step::{Site, Step, everything, piecewise, smooth};

use super::{Dual, Exponential, Field, PositivePart};
use crate::operators;
use num_traits::{One, Zero};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::mem;
use std::panic::Location;
use std::sync::Arc;

/// A formula, recorded: read a generic function in trees, and its value *is* the function.
///
/// A tree can be replayed in any number system, be proved, printed, or changed at one place. Each step
/// remembers the [`Site`] in the source that wrote it. Equality is of structure; sites do not count.
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
/// assert_eq!(voltage.replay(&at, &|_| None), Some(1.0));
/// ```
#[derive(Clone, Debug)]
pub struct Tree(Arc<Node>);

#[derive(Debug)]
struct Node {
    step: Step<Tree>,
    site: Site,
    depth: u32,
    size: u32,
}

/// Formulas less deep than this are dropped by recursion.
const SHALLOW: u32 = 500;

impl Node {
    fn take_operands(&mut self) -> Vec<Tree> {
        mem::replace(&mut self.step, Step::Int(0)).operands().cloned().collect()
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
    /// A quantity.
    #[track_caller]
    pub fn symbol(name: &'static str) -> Self {
        node(Step::Symbol(name))
    }

    /// The number nearest to it in some precision, as one step more.
    #[track_caller]
    pub fn nearest(&self) -> Self {
        node(Step::Rounded(self.clone()))
    }

    /// The formula as a machine computes it: the result of every + − × ÷ and eˣ is rounded. What is taken
    /// from what is there, a sign or one of two numbers, is exact.
    ///
    /// ```
    /// use provable::number::Tree;
    /// let [l, u, h] = ["l", "u", "H"].map(|name| Tree::symbol(name));
    /// let sum = (&l + &u).nearest();
    /// assert_eq!((&l + &u - &h).rounded(), (sum - h).nearest());
    /// ```
    pub fn rounded(&self) -> Self {
        use Step::{Add, Div, Exp, Mul, Sub};
        let rounds = |tree: &Tree| matches!(tree.step(), Add(..) | Sub(..) | Mul(..) | Div(..) | Exp(_));
        // At the place of the step itself.
        self.rewrite(&|tree| rounds(tree).then(|| tree.with_step(Step::Rounded(tree.clone()))))
    }

    /// Does it round?
    pub fn rounds(&self) -> bool {
        self.any(&|tree| matches!(tree.step(), Step::Rounded(_)))
    }

    /// The last step.
    pub fn step(&self) -> &Step<Tree> {
        &self.0.step
    }

    /// Where it is written.
    pub fn site(&self) -> Site {
        self.0.site
    }

    /// The number of operations between the last one and a quantity or number, at most: 0 for these.
    pub fn depth(&self) -> u32 {
        self.0.depth
    }

    /// The number of operations, quantities and numbers, as written out; `u32::MAX` stands for more.
    pub fn size(&self) -> u32 {
        self.0.size
    }

    /// The formula in a number system, whose eˣ, ⟨·⟩, min and rounding are in `beyond` ([`piecewise`],
    /// [`smooth`], [`everything`]); `None` where it lacks one, or where the formula divides by what is no
    /// unit.
    pub fn replay<T: Field>(
        &self,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> Option<T> {
        let operands = self.step().try_map(|operand| operand.replay(symbol, beyond))?;
        operands.map(|operand| operand).value(symbol, beyond)
    }

    /// The value of the formula and its derivative by one of its quantities; `None` as for
    /// [`replay`](Self::replay).
    pub fn derivative<T: Field>(
        &self,
        by: &str,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&Dual<T>>) -> Option<Dual<T>>,
    ) -> Option<Dual<T>> {
        self.replay(&|name| Dual::coordinate(symbol(name), name == by), beyond)
    }

    /// The number for one of its quantities at which the formula, if it is linear in that quantity and the
    /// others are as they are, has the value `target`; `None` if it does not depend on it, or has eˣ, ⟨·⟩
    /// or min. What is rounded is taken as it is, so that the value may be off by as much.
    pub fn solution<T: Field>(
        &self,
        by: &'static str,
        symbol: &impl Fn(&'static str) -> T,
        target: &T,
    ) -> Option<T> {
        let beyond = |step: Step<&Dual<T>>| match step {
            Step::Rounded(x) => Some(x.clone()),
            _ => None,
        };
        let Dual { value, derivative } = self.derivative(by, symbol, &beyond)?;
        derivative.is_unit().then(|| symbol(by) + (target - value) / derivative)
    }

    /// The tree rebuilt from its leaves: each step that `f` replaces, after its operands have been.
    pub fn rewrite(&self, f: &impl Fn(&Tree) -> Option<Tree>) -> Tree {
        let mut rewritten: HashMap<_, Tree> = HashMap::new();
        for old in self.distinct() {
            let step = old.step().map(|operand| rewritten[&operand.address()].clone());
            let same = step.operands().zip(old.step().operands()).all(|(a, b)| a.address() == b.address());
            let tree = if same { old.clone() } else { old.with_step(step) };
            rewritten.insert(old.address(), f(&tree).unwrap_or(tree));
        }
        rewritten.remove(&self.address()).expect("the last step is one of them")
    }

    fn address(&self) -> *const Node {
        Arc::as_ptr(&self.0)
    }

    /// Its steps, each once however often it is shared, after its operands; those from left to right.
    fn distinct(&self) -> Vec<&Tree> {
        let (mut found, mut all, mut open) = (HashSet::new(), Vec::new(), vec![(self, false)]);
        while let Some((tree, operands_are_done)) = open.pop() {
            if operands_are_done {
                all.push(tree);
            } else if found.insert(tree.address()) {
                open.push((tree, true));
                let first = open.len();
                open.extend(tree.step().operands().map(|operand| (operand, false)));
                open[first..].reverse();
            }
        }
        all
    }

    /// The tree with other formulas in place of quantities.
    pub fn with(&self, replaced: &[(&str, Tree)]) -> Tree {
        self.rewrite(&|tree| match tree.step() {
            Step::Symbol(name) => replaced.iter().find(|(own, _)| own == name).map(|(_, tree)| tree.clone()),
            _ => None,
        })
    }

    /// The tree with its last step replaced by another, at the same place in the source.
    pub fn with_step(&self, step: Step<Tree>) -> Tree {
        Tree::at(self.0.site, step)
    }

    fn at(site: Site, step: Step<Tree>) -> Tree {
        let depth = step.operands().map(|operand| operand.depth().saturating_add(1)).max().unwrap_or(0);
        let size = step.operands().fold(1, |sum: u32, operand| sum.saturating_add(operand.size()));
        Tree(Arc::new(Node { step, site, depth, size }))
    }

    /// Calls `f` for every step, the last first.
    pub fn visit<'a>(&'a self, f: &mut impl FnMut(&'a Tree)) {
        let mut open = vec![self];
        while let Some(tree) = open.pop() {
            f(tree);
            let first = open.len();
            open.extend(tree.step().operands());
            open[first..].reverse();
        }
    }

    /// The first of its quantities, as it is read.
    pub fn first_symbol(&self) -> Option<&'static str> {
        self.quantities().next()
    }

    /// The quantities it depends on.
    pub fn symbols(&self) -> BTreeSet<&'static str> {
        self.quantities().collect()
    }

    fn quantities(&self) -> impl Iterator<Item = &'static str> {
        self.distinct().into_iter().filter_map(|tree| match tree.step() {
            Step::Symbol(name) => Some(*name),
            _ => None,
        })
    }

    /// Does one of its steps satisfy this?
    pub fn any(&self, f: &impl Fn(&Tree) -> bool) -> bool {
        self.distinct().into_iter().any(f)
    }
}

/// Returns a quantity for each name.
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
fn node(step: Step<Tree>) -> Tree {
    let at = Location::caller();
    let (file, line, column) = (at.file(), at.line(), at.column());
    let mut site = Site { file, line, column, rank: 0 };
    if let Some(Site { rank, .. }) = step
        .operands()
        .next()
        .map(Tree::site)
        .filter(|first| (first.file, first.line, first.column) == (file, line, column))
    {
        site.rank = rank + 1;
    }
    Tree::at(site, step)
}

impl PartialEq for Tree {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.step() == other.step()
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
        node(Step::Int(n))
    }
}

operators! { #[track_caller] [] Tree;
    Add add |a, b| node(Step::Add(a.clone(), b.clone()));
    Sub sub |a, b| node(Step::Sub(a.clone(), b.clone()));
    Mul mul |a, b| node(Step::Mul(a.clone(), b.clone()));
    Div div |a, b| node(Step::Div(a.clone(), b.clone()));
    - |a| node(Step::Neg(a.clone()))
}
impl Zero for Tree {
    #[track_caller]
    fn zero() -> Self {
        node(Step::Int(0))
    }
    fn is_zero(&self) -> bool {
        *self.step() == Step::Int(0)
    }
}
impl One for Tree {
    #[track_caller]
    fn one() -> Self {
        node(Step::Int(1))
    }
}
impl Field for Tree {
    #[track_caller]
    fn int(n: i32) -> Self {
        node(Step::Int(n))
    }
}
impl Exponential for Tree {
    #[track_caller]
    fn exp(&self) -> Self {
        node(Step::Exp(self.clone()))
    }
}
impl PositivePart for Tree {
    #[track_caller]
    fn positive_part(&self) -> Self {
        node(Step::PositivePart(self.clone()))
    }
    #[track_caller]
    fn min(&self, other: &Self) -> Self {
        node(Step::Min(self.clone(), other.clone()))
    }
    #[track_caller]
    fn abs(&self) -> Self {
        -PositivePart::min(&-self, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The steps of a chain begin at one place; their rank, from the left, is shown from the second on.
    #[test]
    fn steps_are_known_by_their_place() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let (chain, line) = (&a + &b - &a + &b, line!());
        let mut sites = Vec::new();
        chain.visit(&mut |tree| sites.extend((tree.site().line == line).then(|| tree.site().to_string())));
        let place = sites.last().expect("three of its steps").clone();
        assert!(place.starts_with(&format!("{}:{line}:", file!())) && !place.contains(' '), "{place}");
        assert_eq!(sites, [format!("{place} (operator 3)"), format!("{place} (operator 2)"), place]);
    }

    /// Each doubling is one step more, and twice as many as written out.
    #[test]
    fn a_deep_formula_is_read_and_dropped_without_recursion() {
        let x = Tree::symbol("x");
        let sum = |terms: u32| (0..terms).fold(x.clone(), |sum, _| sum + &x);
        let (deep, deeper) = (sum(100_000), sum(100_001));
        assert_eq!((deep.depth(), deep.size()), (100_000, 200_001));
        assert_eq!((deep.first_symbol(), deep.symbols().len()), (Some("x"), 1));
        assert!(!deep.rounds() && deep.rounded().rounds());
        assert_eq!(deep.with(&[("x", Tree::symbol("y"))]).symbols(), BTreeSet::from(["y"]));
        drop((deep, deeper));
        let doubled = (0..100).fold(x.clone(), |sum, _| &sum + &sum);
        assert_eq!((doubled.depth(), doubled.size()), (100, u32::MAX));
        assert_eq!(doubled.with(&[("x", Tree::one())]).first_symbol(), None);
    }

    /// fl(fl(2 x) + 1) = 7 where 2 x + 1 = 7, but for rounding.
    #[test]
    fn a_rounded_formula_is_solved_as_if_it_were_not() {
        let x = Tree::symbol("x");
        let formula = (Tree::int(2) * &x + Tree::one()).rounded();
        assert!(formula.rounds());
        assert_eq!(formula.solution("x", &|_| 0.5, &7.0), Some(3.0));
        assert_eq!(formula.solution("y", &|_| 0.5, &7.0), None);
    }

    #[test]
    fn zero_is_zero_and_nothing_else_is() {
        let x = Tree::symbol("x");
        assert!(Tree::zero().is_zero() && ![Tree::one(), &x - &x, x].iter().any(Tree::is_zero));
    }
}
