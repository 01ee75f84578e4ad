//! What a formula does, step by step: the reading that all readings without numbers start from.

use super::{Dual, Exponential, Field, PositivePart};
use crate::operators;
use num_traits::{One, Zero};
use std::collections::BTreeSet;
use std::fmt;
use std::panic::Location;
use std::sync::Arc;

/// A formula, recorded: read a function of the chapter in trees, and its value *is* the function.
///
/// A tree can be replayed in any number system, be proved, printed, or changed at one place. Each step
/// remembers the [`Site`] in the source that wrote it. Equality is of structure; sites do not count.
///
/// ```
/// use spring_mass_contact::{chapter::{SpringMass, contact}, number::Tree};
/// let system = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| Tree::symbol(name));
/// let p = contact::penetration(&system, &Tree::symbol("u"));
/// # #[cfg(feature = "prover")]
/// assert_eq!(p.to_string(), "l + u − H");
/// let at = |name| if name == "H" { 3.0 } else { 2.0 };
/// assert_eq!(p.replay(&at, &|_| None), Some(1.0));
/// ```
#[derive(Clone, Debug)]
pub struct Tree(Arc<Node>);

#[derive(Debug)]
struct Node {
    step: Step<Tree>,
    site: Site,
}

/// The last step of a formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step<T> {
    /// A quantity.
    Symbol(&'static str),
    /// A small integer.
    Int(i32),
    /// −a
    Neg(T),
    /// a + b
    Add(T, T),
    /// a − b
    Sub(T, T),
    /// a b
    Mul(T, T),
    /// a / b
    Div(T, T),
    /// eᵃ
    Exp(T),
    /// ⟨a⟩ = max(a, 0)
    PositivePart(T),
    /// min(a, b)
    Min(T, T),
    /// fl(a): the number nearest to a in some precision
    Rounded(T),
}

/// Where in the source a step is written.
///
/// The steps of a chain such as `a + b + c` all begin where the chain begins; their rank, counted from
/// the left, tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Site {
    /// The file, as it was named to the compiler.
    pub file: &'static str,
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
    /// How many steps begin at the same place, further inside.
    pub rank: u32,
}

impl fmt::Display for Site {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Site { file, line, column, rank } = self;
        write!(f, "{file}:{line}:{column}")?;
        if *rank > 0 { write!(f, " (operator {})", rank + 1) } else { Ok(()) }
    }
}

impl Site {
    /// Was it written by the rules of differentiation, and by no formula?
    pub fn is_of_duals(&self) -> bool {
        self.file.ends_with("dual.rs")
    }
}

impl<T> Step<T> {
    /// What the step is made of, in order.
    pub fn operands(&self) -> impl Iterator<Item = &T> {
        use Step::*;
        let (a, b) = match self {
            Symbol(_) | Int(_) => (None, None),
            Neg(a) | Exp(a) | PositivePart(a) | Rounded(a) => (Some(a), None),
            Add(a, b) | Sub(a, b) | Mul(a, b) | Div(a, b) | Min(a, b) => (Some(a), Some(b)),
        };
        a.into_iter().chain(b)
    }

    /// The same step with other operands.
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> Step<U> {
        let all = self.try_map(|operand| Some(f(operand)));
        all.expect("every operand has another")
    }

    /// The same, if there are others.
    pub fn try_map<U>(&self, mut f: impl FnMut(&T) -> Option<U>) -> Option<Step<U>> {
        use Step::*;
        Some(match self {
            Symbol(name) => Symbol(name),
            Int(n) => Int(*n),
            Neg(a) => Neg(f(a)?),
            Add(a, b) => Add(f(a)?, f(b)?),
            Sub(a, b) => Sub(f(a)?, f(b)?),
            Mul(a, b) => Mul(f(a)?, f(b)?),
            Div(a, b) => Div(f(a)?, f(b)?),
            Exp(a) => Exp(f(a)?),
            PositivePart(a) => PositivePart(f(a)?),
            Min(a, b) => Min(f(a)?, f(b)?),
            Rounded(a) => Rounded(f(a)?),
        })
    }
}

impl<T: Field> Step<T> {
    /// What it comes to, with operands that are numbers. The rest as for [`Tree::replay`].
    pub fn value(
        self,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> Option<T> {
        use Step::*;
        Some(match self {
            Symbol(name) => symbol(name),
            Int(n) => T::int(n),
            Neg(a) => -a,
            Add(a, b) => a + b,
            Sub(a, b) => a - b,
            Mul(a, b) => a * b,
            Div(_, b) if !b.is_unit() => return None,
            Div(a, b) => a / b,
            Exp(a) => beyond(Exp(&a))?,
            PositivePart(a) => beyond(PositivePart(&a))?,
            Min(a, b) => beyond(Min(&a, &b))?,
            Rounded(a) => beyond(Rounded(&a))?,
        })
    }
}

/// ⟨·⟩ and min, for [`Tree::replay`].
pub fn piecewise<T: PositivePart>(step: Step<&T>) -> Option<T> {
    match step {
        Step::PositivePart(a) => Some(a.positive_part()),
        Step::Min(a, b) => Some(a.min(b)),
        _ => None,
    }
}

/// eˣ, for [`Tree::replay`].
pub fn smooth<T: Exponential>(step: Step<&T>) -> Option<T> {
    match step {
        Step::Exp(a) => Some(a.exp()),
        _ => None,
    }
}

/// eˣ, ⟨·⟩ and min, for [`Tree::replay`].
pub fn everything<T: PositivePart + Exponential>(step: Step<&T>) -> Option<T> {
    smooth(step).or_else(|| piecewise(step))
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
    /// use spring_mass_contact::number::Tree;
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

    /// The formula in a number system, whose eˣ, ⟨·⟩, min and rounding are in `beyond` ([`piecewise`],
    /// [`smooth`], [`everything`]); `None` where it lacks one, or where the formula divides by what is no
    /// unit.
    pub fn replay<T: Field>(
        &self,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> Option<T> {
        self.step().try_map(|operand| operand.replay(symbol, beyond))?.value(symbol, beyond)
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
        let step = self.step().map(|tree| tree.rewrite(f));
        let same = step.operands().zip(self.step().operands()).all(|(new, old)| Arc::ptr_eq(&new.0, &old.0));
        let tree = if same { self.clone() } else { self.with_step(step) };
        f(&tree).unwrap_or(tree)
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
        Tree(Arc::new(Node { step, site: self.0.site }))
    }

    /// Calls `f` for every step, the last first.
    pub fn visit<'a>(&'a self, f: &mut impl FnMut(&'a Tree)) {
        f(self);
        self.step().operands().for_each(|tree| tree.visit(f));
    }

    /// The first of its quantities, as it is read.
    pub fn first_symbol(&self) -> Option<&'static str> {
        match self.step() {
            Step::Symbol(name) => Some(name),
            step => step.operands().find_map(Tree::first_symbol),
        }
    }

    /// The quantities it depends on.
    pub fn symbols(&self) -> BTreeSet<&'static str> {
        let mut symbols = BTreeSet::new();
        self.visit(&mut |tree| {
            if let Step::Symbol(name) = tree.step() {
                symbols.insert(*name);
            }
        });
        symbols
    }

    /// Does one of its steps satisfy this?
    pub fn any(&self, f: &impl Fn(&Tree) -> bool) -> bool {
        f(self) || self.step().operands().any(|tree| tree.any(f))
    }
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
    Tree(Arc::new(Node { step, site }))
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
