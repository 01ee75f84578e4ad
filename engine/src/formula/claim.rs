//! Constructors of statements.

pub use super::symbols::{MEMBERS, POWER, PRECISION, SCALES};

use super::hypothesis::{Relation, name_of};
use super::proposition::Proposition;
use super::sequence::Sequence;
use super::statement::{Form, Statement};
use crate::number::Tree;

/// Rate of convergence to a limit, for numerical checks.
#[derive(Clone, Debug)]
pub enum Rate {
    /// The distance from the limit.
    Equal(Tree),
    /// A bound of the absolute distance from the limit, which tends to 0.
    Within(Tree),
}

/// States that two formulas are equal.
pub fn equal(name: &'static str, left: impl Into<Tree>, right: impl Into<Tree>) -> Statement {
    Statement::new(name, Proposition::Equal(left.into(), right.into()))
}

/// States that a formula is positive.
pub fn positive(name: &'static str, of: impl Into<Tree>) -> Statement {
    Statement::new(name, Proposition::Sign(Relation::Positive, of.into()))
}

/// States that a formula is not negative.
pub fn non_negative(name: &'static str, of: impl Into<Tree>) -> Statement {
    Statement::new(name, Proposition::Sign(Relation::NonNegative, of.into()))
}

/// States that a formula is at most a bound in absolute value.
pub fn within(name: &'static str, of: impl Into<Tree>, bound: impl Into<Tree>) -> Statement {
    Statement::new(name, Proposition::Within(of.into(), bound.into()))
}

/// States that a formula is the derivative of another with respect to a symbol.
///
/// # Panics
/// Panics if `by` is not a symbol.
pub fn derivative(name: &'static str, of: impl Into<Tree>, by: &Tree, is: impl Into<Tree>) -> Statement {
    Statement::new(name, Proposition::Derivative(of.into(), name_of(by), is.into()))
}

/// States that a formula tends to a limit at a given rate as a symbol tends to infinity.
///
/// # Panics
/// Panics if `by` is not a symbol.
pub fn limit(
    name: &'static str,
    of: impl Into<Tree>,
    by: &Tree,
    to: impl Into<Tree>,
    rate: Rate,
) -> Statement {
    let (of, to) = (of.into(), to.into());
    let (distance, by) = (&of - &to, name_of(by));
    let mut parts = vec![("limit", Proposition::Limit(of, by, to))];
    match rate {
        Rate::Equal(rate) => parts.push(("rate", Proposition::Equal(distance, rate))),
        Rate::Within(bound) => {
            parts.push(("limit of the bound", Proposition::Limit(bound.clone(), by, Tree::from(0))));
            parts.push(("bound", Proposition::Sign(Relation::NonNegative, bound.clone())));
            parts.push(("within the bound", Proposition::Within(distance, bound)));
        }
    }
    Statement::of_form(name, Form::Propositions(parts))
}

/// States that the recursion x₀ = start, x_{k+1} = step(x_k) has the closed form x_k = closed at q = ratioᵏ.
///
/// # Panics
/// Panics if there are more components than [`MEMBERS`], or if the step depends on q or on a symbol with the
/// name of a member.
pub fn induction<const N: usize>(
    name: &'static str,
    ratio: impl Into<Tree>,
    start: [Tree; N],
    step: impl Fn([Tree; N]) -> [Tree; N],
    closed: [Tree; N],
) -> Statement {
    assert!(N <= MEMBERS.len(), "{name}: an induction has at most {} components", MEMBERS.len());
    // With numbers as members, only the symbols of the step itself remain.
    assert_not_reserved(name, step(std::array::from_fn(|_| Tree::from(1))).iter().flat_map(Tree::symbols));
    let step = step(std::array::from_fn(|i| Tree::symbol(MEMBERS[i])));
    let (start, step, member, ratio) = (start.into(), step.into(), closed.into(), ratio.into());
    let sequence = Sequence { start, step, ratio, member, limit: None, within: Vec::new() };
    Statement::of_form(name, Form::Sequence(sequence))
}

/// A recursion whose members are only near a closed form, for example because its steps are rounded.
///
/// # Examples
///
/// ```
/// use provable::formula::{Hypothesis, claim::perturbed_recursion};
/// use provable::{number::Tree, proof::prove};
/// let [a, q] = ["a", "q"].map(|name| Tree::symbol(name));
/// // Each step halves the distance from a, so 2⁻ᵏ |a| remains of it.
/// let halves = perturbed_recursion("halves", Tree::from(1) / Tree::from(2))
///     .start(0)
///     .step(|x| (x + &a) / Tree::from(2))
///     .near(&a - &a * &q, 0);
/// assert!(prove(&halves).is_ok());
/// ```
#[derive(Clone, Debug)]
pub struct PerturbedRecursion {
    name: &'static str,
    ratio: Tree,
    start: Tree,
    step: Tree,
    other_bounds: Vec<(Tree, Tree)>,
}

/// Begins a statement about a recursion and the powers q = ratioᵏ. Without another start and step its members
/// stay 0.
pub fn perturbed_recursion(name: &'static str, ratio: impl Into<Tree>) -> PerturbedRecursion {
    let (start, step) = (Tree::from(0), Tree::symbol(MEMBERS[0]));
    PerturbedRecursion { name, ratio: ratio.into(), start, step, other_bounds: Vec::new() }
}

impl PerturbedRecursion {
    /// Sets the first member x₀.
    pub fn start(self, start: impl Into<Tree>) -> Self {
        PerturbedRecursion { start: start.into(), ..self }
    }

    /// Sets the step from x_k to x_{k+1}.
    ///
    /// # Panics
    /// Panics if the step depends on q or on a symbol with the name of a member.
    pub fn step(self, step: impl Fn(&Tree) -> Tree) -> Self {
        // With a number as the member, only the symbols of the step itself remain.
        assert_not_reserved(self.name, step(&Tree::from(1)).symbols().into_iter());
        PerturbedRecursion { step: step(&Tree::symbol(MEMBERS[0])), ..self }
    }

    /// Claims that a formula of x_k and q is bounded as well.
    pub fn bounding(mut self, of: impl Fn(&Tree) -> Tree, bound: impl Into<Tree>) -> Self {
        self.other_bounds.push((of(&Tree::symbol(MEMBERS[0])), bound.into()));
        self
    }

    /// States that each member is within a bound of a closed form, a formula of q, and that the further bounds
    /// hold.
    ///
    /// # Panics
    /// Panics if the closed form or its bound depends on a member.
    pub fn near(self, closed: impl Into<Tree>, bound: impl Into<Tree>) -> Statement {
        let PerturbedRecursion { name, ratio, start, step, other_bounds } = self;
        let (closed, bound) = (closed.into(), bound.into());
        let symbols = [&closed, &bound].into_iter().flat_map(Tree::symbols);
        assert_not_reserved(name, symbols.filter(|symbol| *symbol != POWER));
        let distance = Tree::symbol(MEMBERS[0]) - &closed;
        let within = [(distance, bound)].into_iter().chain(other_bounds).collect();
        let (start, step, member) = (vec![start], vec![step], vec![closed]);
        Statement::of_form(name, Form::Sequence(Sequence { start, step, ratio, member, limit: None, within }))
    }
}

/// States that |ratio| < 1, and that a formula of q is defined at q = 0 and has the value `to` there, so that for
/// q = ratioᵏ it tends to `to` as k tends to infinity.
///
/// The statement is false for a formula that tends to `to` otherwise, such as q/q to 1, or 1/q to 0 for the ratio 2.
pub fn geometric_limit(
    name: &'static str,
    ratio: impl Into<Tree>,
    of: impl Into<Tree>,
    to: impl Into<Tree>,
) -> Statement {
    let (ratio, member, limit) = (ratio.into(), vec![of.into()], Some(to.into()));
    let (start, step, within) = Default::default();
    Statement::of_form(name, Form::Sequence(Sequence { start, step, ratio, member, limit, within }))
}

/// # Panics
/// Panics if a name is reserved for sequences.
fn assert_not_reserved(name: &str, symbols: impl Iterator<Item = &'static str>) {
    for symbol in symbols {
        assert!(symbol != POWER && !MEMBERS.contains(&symbol), "{name}: {symbol} is a reserved name");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Hypothesis;
    use crate::number::Exponential;

    #[test]
    #[should_panic(expected = "c ε is not a symbol")]
    fn the_variable_of_a_derivative_must_be_a_symbol() {
        let [c, eps] = ["c", "ε"].map(|name| Tree::symbol(name));
        derivative("wrong", &c, &(&c * &eps), &c);
    }

    #[test]
    #[should_panic(expected = "powers: x₁ is a reserved name")]
    fn a_step_must_not_depend_on_a_reserved_symbol() {
        let [own, q] = ["x₁", "q"].map(|name| Tree::symbol(name));
        induction("powers", 2, [Tree::from(1)], |[_]| [Tree::from(2) * &own], [q]);
    }

    #[test]
    fn an_exponential_in_a_statement_is_found() {
        let [u, v] = ["u", "v"].map(|name| Tree::symbol(name));
        let statement = equal("exponential", v.exp(), &u).assuming([&Hypothesis::near(&u, &v, 0)]);
        assert!(statement.contains_exponential() && !equal("none", &u, &v).contains_exponential());
    }

    #[test]
    fn statements_about_sequences_are_of_three_kinds() {
        let [u, q] = ["u", POWER].map(|name| Tree::symbol(name));
        let kinds = [
            induction("same", 2, [u.clone()], |[x]| [x], [u.clone()]),
            perturbed_recursion("near", 2).start(&u).near(&u, 0),
            geometric_limit("limit", 2, q, 0),
        ];
        assert_eq!(kinds.map(|statement| statement.kind()), ["induction", "drift", "vanishing"]);
    }

    #[test]
    fn another_proposition_computes_no_quantity() {
        let [u, v] = ["u", "v"].map(|name| Tree::symbol(name));
        let statement = equal("same", &u, &v).assuming([&Hypothesis::near(&u, &v, 0)]).computing(&u, &v);
        let other = statement.with_proposition(Proposition::Equal(v, u));
        assert_eq!(
            [&statement, &other].map(|s| (s.computed().len(), s.hypotheses().len())),
            [(1, 0), (0, 1)]
        );
    }
}
