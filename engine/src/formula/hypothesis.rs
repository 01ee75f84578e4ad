//! What is supposed.

use super::typeset::{Name, Notation};
use crate::number::tree::{Step, piecewise};
use crate::number::{Field, PositivePart, Tree};
use std::cmp::Ordering;
use std::fmt;

/// What is said of the sign of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// > 0
    Positive,
    /// ≥ 0
    NonNegative,
    /// = 0
    Zero,
}

impl Relation {
    /// Does a number of this sign satisfy it?
    pub fn admits(self, sign: Ordering) -> bool {
        match self {
            Relation::Positive => sign.is_gt(),
            Relation::NonNegative => sign.is_ge(),
            Relation::Zero => sign.is_eq(),
        }
    }

    /// As a reader writes it if the sides have traded places.
    fn turned(self) -> &'static str {
        match self {
            Relation::Positive => "<",
            Relation::NonNegative => "≤",
            Relation::Zero => "=",
        }
    }
}

/// As a reader writes it, between two sides: `>`.
impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Relation::Positive => ">",
            Relation::NonNegative => "≥",
            Relation::Zero => "=",
        })
    }
}

/// What is supposed: a quantity, recorded, and what is said of its sign.
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
    /// What is said of its sign.
    pub relation: Relation,
    /// The symbol to be chosen so that it holds, where numbers are looked for.
    pub solved_for: &'static str,
}

impl Hypothesis {
    /// A hypothesis, solved for the first of the symbols in its record.
    ///
    /// # Panics
    /// There is none: of a number nothing is to be supposed.
    pub fn new(relation: Relation, value: Tree) -> Self {
        let solved_for =
            value.first_symbol().unwrap_or_else(|| panic!("of a number, {value}, nothing is to be supposed"));
        Hypothesis { value, relation, solved_for }
    }

    /// The same, solved for another symbol: one that the quantity is linear in. If it does not depend on it,
    /// as after a mistake in the quantity, it is solved for what it was.
    pub fn solved_for(self, symbol: &Tree) -> Self {
        let depends = self.value.symbols().contains(name_of(symbol));
        let solved_for = if depends { name_of(symbol) } else { self.solved_for };
        Hypothesis { solved_for, ..self }
    }

    /// A symbol is in an interval: from `lower` to `upper`, or the other way round.
    ///
    /// ```
    /// use provable::{formula::Hypothesis, number::Tree};
    /// let [q, one] = [Tree::symbol("q"), Tree::from(1)];
    /// assert_eq!(Hypothesis::between(&q, Tree::from(0), one.clone()).to_string(), "0 ≤ q ≤ 1");
    /// ```
    ///
    /// # Panics
    /// It is no symbol, or an end depends on it.
    pub fn between(symbol: &Tree, lower: impl Into<Tree>, upper: impl Into<Tree>) -> Self {
        let (lower, upper) = (lower.into(), upper.into());
        let name = name_of(symbol);
        let depends = |end: &Tree| end.symbols().contains(name);
        assert!(!depends(&lower) && !depends(&upper), "the interval of {name} depends on it");
        let hypothesis = Hypothesis::new(Relation::NonNegative, (upper - symbol) * (symbol - lower));
        Hypothesis { solved_for: name, ..hypothesis }
    }

    /// A symbol is no further than `most` from a quantity: `|u − Δ| ≤ tol`.
    ///
    /// # Panics
    /// As [`between`](Self::between).
    pub fn near(symbol: &Tree, quantity: impl Into<Tree>, most: impl Into<Tree>) -> Self {
        let (quantity, most) = (quantity.into(), most.into());
        Hypothesis::between(symbol, &quantity - &most, quantity + most)
    }

    /// What it is in an interval, with the two ends, if that is what it says.
    pub fn interval(&self) -> Option<(&'static str, &Tree, &Tree)> {
        let Step::Mul(above, below) = self.value.step() else { return None };
        let (Step::Sub(upper, x), Step::Sub(y, lower)) = (above.step(), below.step()) else { return None };
        let Step::Symbol(name) = x.step() else { return None };
        let depends = |end: &Tree| end.symbols().contains(name);
        let says_so = self.relation == Relation::NonNegative && x == y && !depends(lower) && !depends(upper);
        says_so.then_some((*name, lower, upper))
    }

    /// Its distance from a quantity, and the most that it may be, if it is [near](Self::near) one.
    pub fn distance(&self) -> Option<(Tree, &Tree)> {
        let (x, lower, upper) = self.interval()?;
        match (lower.step(), upper.step()) {
            (Step::Sub(a, least), Step::Add(b, most)) if a == b && least == most => {
                Some((Tree::symbol(x) - a, most))
            }
            _ => None,
        }
    }

    /// As a reader writes it, with the parts that `name` knows by their names: `λ < R`.
    pub fn typeset(&self, name: &dyn Fn(&Tree) -> Option<Name>) -> String {
        let text = |tree: &Tree| tree.typeset(Notation::Text, name);
        let said = |left: &Tree, turned: bool, right: &Tree| {
            let between = if turned { self.relation.turned().to_string() } else { self.relation.to_string() };
            format!("{} {between} {}", text(left), text(right))
        };
        if let Some((x, lower, upper)) = self.interval() {
            return match self.distance() {
                Some((distance, most)) => format!("{} ≤ {}", text(&distance.abs()), text(most)),
                None => format!("{} ≤ {} ≤ {}", text(lower), text(&Tree::symbol(x)), text(upper)),
            };
        }
        let zero = Tree::int(0);
        let is_symbol = |tree: &Tree| matches!(tree.step(), Step::Symbol(_));
        match self.value.step() {
            _ if name(&self.value).is_some() => said(&self.value, false, &zero),
            Step::Neg(a) => said(a, true, &zero),
            Step::Sub(a, b) => match a.step() {
                Step::Neg(a) => said(a, true, &-b),
                // What is alone comes first.
                _ if is_symbol(b) && !is_symbol(a) => said(b, true, a),
                _ => said(a, false, b),
            },
            _ => said(&self.value, false, &zero),
        }
    }

    /// Does it hold at these numbers? Not where its quantity is undefined.
    pub fn holds<T: PositivePart + PartialOrd>(&self, symbol: &impl Fn(&'static str) -> T) -> bool {
        self.holds_with(symbol, &piecewise)
    }

    /// The same with other steps than + − × ÷ as [`Tree::replay`] has them.
    pub fn holds_with<T: Field + PartialOrd>(
        &self,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> bool {
        let value = self.value.replay(symbol, beyond);
        value.and_then(|value| value.partial_cmp(&T::zero())).is_some_and(|sign| self.relation.admits(sign))
    }

    /// The number for the symbol that it is [solved for](field@Self::solved_for) with which the quantity,
    /// if it is linear there, has the value `target`; `None` if it does not depend on it. In an interval,
    /// `target` ≥ 0 is the distance from the lower end over that from the upper one.
    pub fn solution<T: PositivePart>(&self, symbol: &impl Fn(&'static str) -> T, target: &T) -> Option<T> {
        if let Some((_, lower, upper)) = self.interval() {
            let [lower, upper] = [lower, upper].map(|end| end.replay(symbol, &piecewise));
            let (lower, upper) = (lower?, upper?);
            let whole = target + T::one();
            return whole.is_unit().then(|| &lower + (upper - &lower) * target / whole);
        }
        self.value.solution(self.solved_for, symbol, target)
    }
}

/// Without names.
impl fmt::Display for Hypothesis {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.typeset(&|_| None))
    }
}

/// The name of a symbol.
///
/// # Panics
/// It is another formula.
pub(super) fn name_of(symbol: &Tree) -> &'static str {
    match symbol.step() {
        Step::Symbol(name) => name,
        _ => panic!("{symbol} is no symbol"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hypotheses_are_written_as_a_reader_does() {
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
    fn a_hypothesis_is_solved_for_its_symbol() {
        let [c, eps] = ["c", "ε"].map(|name| Tree::symbol(name));
        let at = |name| if name == "c" { 3.0 } else { 2.0 };
        let stiffer = Hypothesis::new(Relation::Positive, &c - &eps);
        assert_eq!((stiffer.solved_for, stiffer.solution(&at, &0.0)), ("c", Some(2.0)));
        assert_eq!(stiffer.clone().solved_for(&eps).solution(&at, &0.0), Some(3.0));
        assert_eq!(stiffer.clone().solved_for(&Tree::symbol("x")), stiffer);
        let other = Hypothesis { solved_for: "x", ..stiffer };
        assert_eq!(other.solution(&at, &0.0), None);
    }

    #[test]
    fn an_interval_has_two_ends_and_perhaps_a_middle() {
        let [q, u, c, d] = ["q", "u", "c", "d"].map(|name| Tree::symbol(name));
        let near = Hypothesis::near(&q, &u, &c);
        assert_eq!(near.distance(), Some((&q - &u, &c)));
        for other in [(&u - &c, &u + &d), (&d - &c, &u + &c), (&d - &u, &u + &c)] {
            assert_eq!(Hypothesis::between(&q, other.0, other.1).distance(), None);
        }
        // Two thirds of the way it is twice as far from 1 as from 4.
        let at = |name| if name == "u" { 1.0 } else { 4.0 };
        let between = Hypothesis::between(&q, &u, &c);
        assert_eq!((between.solved_for, between.solution(&at, &2.0)), ("q", Some(3.0)));
        assert_eq!([0.0, -1.0].map(|target| between.solution(&at, &target)), [Some(1.0), None]);
    }

    #[test]
    fn what_is_undefined_does_not_hold() {
        let inverse = Tree::int(1) / Tree::symbol("c");
        for relation in [Relation::Positive, Relation::NonNegative, Relation::Zero] {
            let hypothesis = Hypothesis::new(relation, inverse.clone());
            assert!(!hypothesis.holds(&|_| 0.0), "{hypothesis} at 0");
            assert!(!hypothesis.holds(&|_| f64::NAN), "{hypothesis} at no number");
        }
        assert!(Hypothesis::new(Relation::Positive, inverse).holds(&|_| 2.0));
    }
}
