//! What is said of formulas.

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
/// use spring_mass_contact::formula::{Hypothesis, Relation};
/// use spring_mass_contact::number::Tree;
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

    /// The same, solved for another symbol: one that the quantity is linear in.
    ///
    /// # Panics
    /// The quantity does not depend on it.
    pub fn solved_for(self, symbol: &Tree) -> Self {
        assert!(self.value.symbols().contains(name_of(symbol)), "{self} does not depend on {symbol}");
        Hypothesis { solved_for: name_of(symbol), ..self }
    }

    /// As a reader writes it, with the parts that `name` knows by their names: `λ < R`.
    pub fn typeset(&self, notation: Notation, name: &dyn Fn(&Tree) -> Option<Name>) -> String {
        let text = |tree: &Tree| tree.typeset(notation, name);
        let said = |left: &Tree, turned: bool, right: &Tree| {
            let between = if turned { self.relation.turned().to_string() } else { self.relation.to_string() };
            format!("{} {between} {}", text(left), text(right))
        };
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
        let value = self.value.replay(symbol, &piecewise);
        value.and_then(|value| value.partial_cmp(&T::zero())).is_some_and(|sign| self.relation.admits(sign))
    }

    /// The number for the symbol that it is [solved for](field@Self::solved_for) with which the quantity,
    /// if it is linear there, has the value `target`; `None` if it does not depend on it.
    pub fn solution<T: Field>(&self, symbol: &impl Fn(&'static str) -> T, target: &T) -> Option<T> {
        self.value.solution(self.solved_for, symbol, target)
    }
}

/// Without names.
impl fmt::Display for Hypothesis {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.typeset(Notation::Text, &|_| None))
    }
}

/// The name of a symbol.
///
/// # Panics
/// It is another formula.
fn name_of(symbol: &Tree) -> &'static str {
    match symbol.step() {
        Step::Symbol(name) => name,
        _ => panic!("{symbol} is no symbol"),
    }
}

/// How a limit is checked in numbers: by the distance to it, in a form from which the limit can be read.
#[derive(Clone, Debug)]
pub enum Rate {
    /// The distance is this.
    Exactly(Tree),
    /// The distance is no more than this, either way.
    Within(Tree),
}

/// What q is called, which stands for the power ρᵏ in an [induction](Kind::Induction).
pub const POWER: &str = "q";

/// What the components of x_k are called in the step of an [induction](Kind::Induction).
pub const MEMBERS: [&str; 4] = ["x₁", "x₂", "x₃", "x₄"];

/// What is claimed.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Two formulas are equal.
    Equal(Tree, Tree),
    /// A formula has a sign.
    Sign(Relation, Tree),
    /// One formula is the derivative of another.
    Derivative {
        /// What is differentiated.
        of: Tree,
        /// By this symbol.
        by: &'static str,
        /// Its derivative.
        is: Tree,
    },
    /// A formula tends to another as a symbol tends to infinity.
    Limit {
        /// The formula.
        of: Tree,
        /// The symbol.
        by: &'static str,
        /// Its limit.
        to: Tree,
        /// How fast.
        rate: Rate,
    },
    /// A recursion x₀ = start, x_{k+1} = step(x_k) has the closed form x_k = closed at q = ratioᵏ.
    Induction {
        /// What is raised to the power k.
        ratio: Tree,
        /// x₀.
        start: Vec<Tree>,
        /// The next x, by the [`MEMBERS`].
        step: Vec<Tree>,
        /// x_k, by q.
        closed: Vec<Tree>,
    },
    /// A formula in q = ratioᵏ tends to a limit as k grows: |ratio| < 1, and at q = 0 it is the limit.
    Vanishing {
        /// What is raised to the power k.
        ratio: Tree,
        /// The formula.
        of: Tree,
        /// Its limit.
        to: Tree,
    },
}

impl Kind {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Equal(..) => "equal",
            Kind::Sign(..) => "sign",
            Kind::Derivative { .. } => "derivative",
            Kind::Limit { .. } => "limit",
            Kind::Induction { .. } => "induction",
            Kind::Vanishing { .. } => "vanishing",
        }
    }
}

/// Something said of formulas under hypotheses: recorded once, and read by provers, number systems and
/// printers.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The number of the equation that it belongs to.
    pub equation: &'static str,
    /// Its name, unique within the equation.
    pub name: &'static str,
    /// What it supposes.
    pub given: Vec<Hypothesis>,
    /// What it says.
    pub kind: Kind,
}

impl Claim {
    /// A claim, of no equation yet.
    pub fn new(name: &'static str, given: &[&Hypothesis], kind: Kind) -> Self {
        Claim { equation: "", name, given: given.iter().copied().cloned().collect(), kind }
    }

    /// Its formulas, but for those of its hypotheses.
    pub fn trees(&self) -> Vec<&Tree> {
        match &self.kind {
            Kind::Equal(a, b) | Kind::Derivative { of: a, is: b, .. } => vec![a, b],
            Kind::Sign(_, a) => vec![a],
            Kind::Limit { of, to, rate: Rate::Exactly(rate) | Rate::Within(rate), .. } => vec![of, to, rate],
            Kind::Vanishing { ratio, of, to } => vec![ratio, of, to],
            Kind::Induction { ratio, start, step, closed } => {
                [ratio].into_iter().chain(start).chain(step).chain(closed).collect()
            }
        }
    }

    /// Does it speak of eˣ, which rationals have not?
    pub fn has_exponentials(&self) -> bool {
        self.trees().into_iter().any(|tree| tree.any(&|tree| matches!(tree.step(), Step::Exp(_))))
    }

    /// With each of its formulas changed, but for those of its hypotheses.
    pub fn map(&self, f: &impl Fn(&Tree) -> Tree) -> Self {
        let all = |trees: &[Tree]| trees.iter().map(f).collect();
        let kind = match &self.kind {
            Kind::Equal(a, b) => Kind::Equal(f(a), f(b)),
            Kind::Sign(relation, a) => Kind::Sign(*relation, f(a)),
            Kind::Derivative { of, by, is } => Kind::Derivative { of: f(of), by, is: f(is) },
            Kind::Limit { of, by, to, rate } => {
                let rate = match rate {
                    Rate::Exactly(rate) => Rate::Exactly(f(rate)),
                    Rate::Within(rate) => Rate::Within(f(rate)),
                };
                Kind::Limit { of: f(of), by, to: f(to), rate }
            }
            Kind::Vanishing { ratio, of, to } => Kind::Vanishing { ratio: f(ratio), of: f(of), to: f(to) },
            Kind::Induction { ratio, start, step, closed } => {
                Kind::Induction { ratio: f(ratio), start: all(start), step: all(step), closed: all(closed) }
            }
        };
        Claim { kind, ..self.clone() }
    }
}

// How claims are written.

/// Two formulas are equal.
pub fn equal<const N: usize>(
    name: &'static str,
    given: [&Hypothesis; N],
    left: impl Into<Tree>,
    right: impl Into<Tree>,
) -> Claim {
    Claim::new(name, &given, Kind::Equal(left.into(), right.into()))
}

/// A formula is positive.
pub fn positive<const N: usize>(name: &'static str, given: [&Hypothesis; N], of: impl Into<Tree>) -> Claim {
    Claim::new(name, &given, Kind::Sign(Relation::Positive, of.into()))
}

/// A formula is not negative.
pub fn non_negative<const N: usize>(
    name: &'static str,
    given: [&Hypothesis; N],
    of: impl Into<Tree>,
) -> Claim {
    Claim::new(name, &given, Kind::Sign(Relation::NonNegative, of.into()))
}

/// The derivative of a formula by a symbol is another formula.
pub fn derivative<const N: usize>(
    name: &'static str,
    given: [&Hypothesis; N],
    of: impl Into<Tree>,
    by: &Tree,
    is: impl Into<Tree>,
) -> Claim {
    Claim::new(name, &given, Kind::Derivative { of: of.into(), by: name_of(by), is: is.into() })
}

/// As a symbol tends to infinity, a formula tends to another at this rate.
pub fn limit<const N: usize>(
    name: &'static str,
    given: [&Hypothesis; N],
    of: impl Into<Tree>,
    by: &Tree,
    to: impl Into<Tree>,
    rate: Rate,
) -> Claim {
    Claim::new(name, &given, Kind::Limit { of: of.into(), by: name_of(by), to: to.into(), rate })
}

/// From x₀ = start each x leads to the next; in closed form that is x_k, by q = ratioᵏ.
///
/// # Panics
/// There are more components than [`MEMBERS`], or the step speaks of q or of a quantity that is called like
/// one of them: then nobody could tell the two apart.
pub fn induction<const M: usize, const N: usize>(
    name: &'static str,
    given: [&Hypothesis; M],
    ratio: impl Into<Tree>,
    start: [Tree; N],
    step: impl Fn([Tree; N]) -> [Tree; N],
    closed: [Tree; N],
) -> Claim {
    assert!(N <= MEMBERS.len(), "{name}: an induction has at most {} components", MEMBERS.len());
    // Of members that have no names, only a step's own quantities are left.
    for own in step(std::array::from_fn(|_| Tree::from(1))).iter().flat_map(Tree::symbols) {
        assert!(own != POWER && !MEMBERS.contains(&own), "{name}: {own} is a name that inductions keep");
    }
    let members = std::array::from_fn(|i| Tree::symbol(MEMBERS[i]));
    let (start, step, closed) = (start.into(), step(members).into(), closed.into());
    Claim::new(name, &given, Kind::Induction { ratio: ratio.into(), start, step, closed })
}

/// A formula in q = ratioᵏ tends to a limit as k grows.
pub fn vanishing<const N: usize>(
    name: &'static str,
    given: [&Hypothesis; N],
    ratio: impl Into<Tree>,
    of: impl Into<Tree>,
    to: impl Into<Tree>,
) -> Claim {
    Claim::new(name, &given, Kind::Vanishing { ratio: ratio.into(), of: of.into(), to: to.into() })
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
        let other = Hypothesis { solved_for: "x", ..stiffer };
        assert_eq!(other.solution(&at, &0.0), None);
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

    #[test]
    #[should_panic(expected = "c ε is no symbol")]
    fn only_a_symbol_can_be_differentiated_by() {
        let [c, eps] = ["c", "ε"].map(|name| Tree::symbol(name));
        derivative("wrong", [], &c, &(&c * &eps), &c);
    }

    #[test]
    #[should_panic(expected = "powers: x₁ is a name that inductions keep")]
    fn a_step_has_no_quantity_called_like_its_member() {
        let [own, q] = ["x₁", "q"].map(|name| Tree::symbol(name));
        induction("powers", [], 2, [Tree::from(1)], |[_]| [Tree::from(2) * &own], [q]);
    }
}
