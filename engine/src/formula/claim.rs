//! What is said of formulas.

use super::hypothesis::{Hypothesis, Relation, name_of};
use crate::number::Tree;
use crate::number::tree::Step;

/// How a limit is checked in numbers: by the distance to it, in a form from which the limit can be read.
#[derive(Clone, Debug)]
pub enum Rate {
    /// The distance is this.
    Exactly(Tree),
    /// The distance is no more than this, either way.
    Within(Tree),
}

/// What stands for 2ᵖ where formulas [round](Tree::rounded): to p bits, so that its inverse is the unit
/// roundoff.
pub const PRECISION: &str = "2ᵖ";

/// What stands for powers of two, with any whole exponents.
pub const SCALES: [&str; 3] = ["2ᵃ", "2ᵇ", "2ᶠ"];

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
    /// A formula is no larger in size than a bound.
    Within(Tree, Tree),
    /// A recursion x₀ = start, x_{k+1} = step(x_k) stays near a closed form at q = ratioᵏ, for all k.
    Drift {
        /// What is raised to the power k.
        ratio: Tree,
        /// x₀.
        start: Tree,
        /// The next x, by the first of the [`MEMBERS`].
        step: Tree,
        /// What x_k is near, by q.
        near: Tree,
        /// How near.
        bound: Tree,
        /// What else is of limited size, by the same, with its bound.
        also: Vec<(Tree, Tree)>,
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
            Kind::Within(..) => "bound",
            Kind::Drift { .. } => "drift",
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
    /// A quantity of which it supposes that it is near another; that is proved where it is computed like
    /// this.
    pub computed: Option<(&'static str, Tree)>,
    /// What it says.
    pub kind: Kind,
}

impl Claim {
    /// A claim, of no equation yet.
    pub fn new(name: &'static str, given: &[&Hypothesis], kind: Kind) -> Self {
        Claim { equation: "", name, given: given.iter().copied().cloned().collect(), computed: None, kind }
    }

    /// The same where one of its quantities is computed: what it supposes of that is no longer supposed but
    /// proved.
    ///
    /// # Panics
    /// It does not suppose that the quantity, and no other, is in an interval.
    pub fn computing(self, symbol: &Tree, by: impl Into<Tree>) -> Self {
        let name = name_of(symbol);
        let of_it = |given: &&Hypothesis| given.value.symbols().contains(name);
        let supposed: Vec<_> = self.given.iter().filter(of_it).collect();
        let [only] = supposed[..] else { panic!("{}: of {name} it is not supposed where it is", self.name) };
        assert!(
            only.interval().is_some_and(|(x, ..)| x == name),
            "{}: {only} is no interval of {name}",
            self.name
        );
        Claim { computed: Some((name, by.into())), ..self }
    }

    /// Its formulas, but for those of its hypotheses.
    pub fn trees(&self) -> Vec<&Tree> {
        let mut all = match &self.kind {
            Kind::Equal(a, b) | Kind::Derivative { of: a, is: b, .. } | Kind::Within(a, b) => vec![a, b],
            Kind::Sign(_, a) => vec![a],
            Kind::Limit { of, to, rate: Rate::Exactly(rate) | Rate::Within(rate), .. } => vec![of, to, rate],
            Kind::Vanishing { ratio, of, to } => vec![ratio, of, to],
            Kind::Induction { ratio, start, step, closed } => {
                [ratio].into_iter().chain(start).chain(step).chain(closed).collect()
            }
            Kind::Drift { ratio, start, step, near, bound, also } => {
                let also = also.iter().flat_map(|(of, bound)| [of, bound]);
                [ratio, start, step, near, bound].into_iter().chain(also).collect()
            }
        };
        all.extend(self.computed.iter().map(|(_, by)| by));
        all
    }

    /// Does it speak of what is rounded, which is true of floats?
    pub fn rounds(&self) -> bool {
        let given = self.given.iter().map(|given| &given.value);
        self.trees().into_iter().chain(given).any(Tree::rounds)
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
            Kind::Within(a, bound) => Kind::Within(f(a), f(bound)),
            Kind::Drift { ratio, start, step, near, bound, also } => Kind::Drift {
                ratio: f(ratio),
                start: f(start),
                step: f(step),
                near: f(near),
                bound: f(bound),
                also: also.iter().map(|(of, bound)| (f(of), f(bound))).collect(),
            },
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
        let computed = self.computed.as_ref().map(|(name, by)| (*name, f(by)));
        Claim { kind, computed, ..self.clone() }
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

/// A formula is no larger in size than a bound.
pub fn within<const N: usize>(
    name: &'static str,
    given: [&Hypothesis; N],
    of: impl Into<Tree>,
    bound: impl Into<Tree>,
) -> Claim {
    Claim::new(name, &given, Kind::Within(of.into(), bound.into()))
}

/// From x₀ = start each x leads to the next; each is near what is said of q = ratioᵏ, and what is said of
/// it and q besides is of limited size.
///
/// # Panics
/// As for an [`induction`].
pub fn drift<const M: usize, const N: usize>(
    name: &'static str,
    given: [&Hypothesis; M],
    ratio: impl Into<Tree>,
    start: impl Into<Tree>,
    step: impl Fn(&Tree) -> Tree,
    (near, bound): (Tree, Tree),
    also: impl Fn(&Tree) -> [(Tree, Tree); N],
) -> Claim {
    let member = Tree::symbol(MEMBERS[0]);
    let nameless = step(&Tree::from(1));
    let own = [&near, &bound, &nameless].into_iter().flat_map(Tree::symbols);
    let also: Vec<_> = also(&member).into();
    kept(name, own.filter(|own| *own != POWER).chain(nameless.symbols()));
    let (ratio, start, step) = (ratio.into(), start.into(), step(&member));
    Claim::new(name, &given, Kind::Drift { ratio, start, step, near, bound, also })
}

/// # Panics
/// A name is one that inductions keep.
fn kept(name: &str, symbols: impl Iterator<Item = &'static str>) {
    for own in symbols {
        assert!(own != POWER && !MEMBERS.contains(&own), "{name}: {own} is a name that inductions keep");
    }
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
    kept(name, step(std::array::from_fn(|_| Tree::from(1))).iter().flat_map(Tree::symbols));
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
    use crate::number::Exponential;

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

    #[test]
    fn all_formulas_of_a_claim_are_changed() {
        let [q, u, v] = ["q", "u", "v"].map(|name| Tree::symbol(name));
        let given = Hypothesis::near(&u, &v, 0);
        let claim = equal("exponential", [&given], v.exp(), &u).computing(&u, &q);
        assert!(claim.has_exponentials() && !equal("none", [], &u, &v).has_exponentials());
        let negated = claim.map(&|tree| -tree);
        assert_eq!(negated.trees(), [&-v.exp(), &-u, &-q]);
        assert_eq!(negated.given, claim.given);
    }
}
