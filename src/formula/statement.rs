//! What is to be proved: a claim, read in trees.

use super::claim::{Claim, Hypothesis, Kind, MEMBERS, POWER, Rate, Relation};
use crate::number::Tree;
use num_traits::{One, Zero};

/// A claim as formulas: hypotheses, and goals that follow from them.
#[derive(Clone, Debug, Default)]
pub struct Statement {
    /// The entry it belongs to.
    pub equation: &'static str,
    /// Its name, unique within the equation.
    pub name: &'static str,
    /// Its [kind](Kind::name).
    pub kind: &'static str,
    /// What is supposed.
    pub hypotheses: Vec<Hypothesis>,
    /// What holds at every step of an induction; part of its proof, and not supposed.
    pub invariants: Vec<Hypothesis>,
    /// What follows.
    pub goals: Vec<Goal>,
    /// What the goals amount to, where that is more than they say: for readers, and no part of what is
    /// proved.
    pub amounts_to: Option<Sequence>,
}

/// A statement about all members of a sequence.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Where it starts; empty if that is not spoken of.
    pub start: Vec<Tree>,
    /// Its next member, by the [`MEMBERS`]; empty if that is not spoken of.
    pub step: Vec<Tree>,
    /// ρ
    pub ratio: Tree,
    /// Its k-th member, by q = ρᵏ.
    pub member: Vec<Tree>,
    /// Its limit; `None` if that is not spoken of.
    pub limit: Option<Tree>,
}

/// A part of a claim.
#[derive(Clone, Debug)]
pub struct Goal {
    /// Which part, if there are several.
    pub part: &'static str,
    /// What it is for.
    pub role: Role,
    /// What it says.
    pub says: Says,
}

/// What a goal is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The claim, under its hypotheses.
    Claim,
    /// A step of an induction, under the invariants as well.
    Step,
    /// An invariant holds at the start, which is not where it may be supposed.
    Begins,
    /// An invariant holds after a step if it does before.
    Continues,
}

/// What a goal says.
#[derive(Clone, Debug)]
pub enum Says {
    /// Two formulas are equal, and defined.
    Equal(Tree, Tree),
    /// A formula is defined and has a sign.
    Sign(Relation, Tree),
    /// The third is the derivative of the first by a quantity.
    Derivative(Tree, &'static str, Tree),
    /// The first tends to the third as a quantity tends to infinity.
    Limit(Tree, &'static str, Tree),
}

impl Goal {
    /// A part of what a claim says.
    pub fn of_claim(part: &'static str, says: Says) -> Self {
        Goal { part, role: Role::Claim, says }
    }
}

impl Says {
    /// The symbol that varies, if one does.
    pub fn variable(&self) -> Option<&'static str> {
        match self {
            Says::Derivative(_, by, _) | Says::Limit(_, by, _) => Some(by),
            Says::Equal(..) | Says::Sign(..) => None,
        }
    }

    /// Its formulas.
    pub fn trees(&self) -> [&Tree; 2] {
        match self {
            Says::Equal(a, b) | Says::Derivative(a, _, b) | Says::Limit(a, _, b) => [a, b],
            Says::Sign(_, a) => [a, a],
        }
    }
}

impl Statement {
    /// A claim read in trees.
    ///
    /// The induction over k is here: a recursion has the closed form x_k = closed(ρᵏ) if closed(1) is its
    /// start and one step leads from closed(q) to closed(ρ q), whatever q is. What a claim supposes of q is
    /// an invariant: it has to hold for q = 1, by the other hypotheses alone, and to be passed on from q to
    /// ρ q; then it may be used in the step.
    pub fn of(claim: &Claim) -> Self {
        let goal = Goal::of_claim;
        let of_q = |given: &Hypothesis| given.value.symbols().contains(POWER);
        let (mut hypotheses, mut invariants) = (claim.given.clone(), Vec::new());
        let mut goals = Vec::new();
        let mut amounts_to = None;
        match &claim.kind {
            Kind::Equal(left, right) => goals.push(goal("", Says::Equal(left.clone(), right.clone()))),
            Kind::Sign(relation, of) => goals.push(goal("", Says::Sign(*relation, of.clone()))),
            Kind::Derivative { of, by, is } => {
                goals.push(goal("", Says::Derivative(of.clone(), by, is.clone())));
            }
            Kind::Limit { of, by, to, rate } => {
                goals.push(goal("limit", Says::Limit(of.clone(), by, to.clone())));
                let distance = of - to;
                match rate {
                    Rate::Exactly(rate) => goals.push(goal("rate", Says::Equal(distance, rate.clone()))),
                    Rate::Within(bound) => {
                        let margin = bound * bound - &distance * &distance;
                        goals.push(goal("bound", Says::Sign(Relation::NonNegative, bound.clone())));
                        goals.push(goal("within the bound", Says::Sign(Relation::NonNegative, margin)));
                    }
                }
            }
            Kind::Induction { ratio, start, step, closed } => {
                assert!(
                    start.len() == closed.len() && step.len() == closed.len(),
                    "a form for each component"
                );
                (invariants, hypotheses) = claim.given.iter().cloned().partition(of_q);
                let q = POWER;
                let next = ratio * Tree::symbol(q);
                let member = |i: usize| (MEMBERS[i], closed[i].clone());
                let members: Vec<_> = (0..closed.len()).map(member).collect();
                for (start, closed) in start.iter().zip(closed) {
                    let says = Says::Equal(closed.with(&[(q, Tree::one())]), start.clone());
                    goals.push(Goal { part: "start", role: Role::Claim, says });
                }
                for (step, closed) in step.iter().zip(closed) {
                    let says = Says::Equal(step.with(&members), closed.with(&[(q, next.clone())]));
                    goals.push(Goal { part: "step", role: Role::Step, says });
                }
                for given in &invariants {
                    let says = |q_is: Tree| Says::Sign(given.relation, given.value.with(&[(q, q_is)]));
                    let begins =
                        Goal { part: "invariant at the start", role: Role::Begins, says: says(Tree::one()) };
                    let says = says(next.clone());
                    goals.extend([
                        begins,
                        Goal { part: "invariant after a step", role: Role::Continues, says },
                    ]);
                }
                let (start, step) = (start.clone(), step.clone());
                let (ratio, member) = (ratio.clone(), closed.clone());
                amounts_to = Some(Sequence { start, step, ratio, member, limit: None });
            }
            Kind::Vanishing { ratio, of, to } => {
                let margin = Tree::one() - ratio * ratio;
                goals.push(goal("|ρ| < 1", Says::Sign(Relation::Positive, margin)));
                let at_zero = of.with(&[(POWER, Tree::zero())]);
                goals.push(goal("at q = 0", Says::Equal(at_zero, to.clone())));
                let (ratio, member, limit) = (ratio.clone(), vec![of.clone()], Some(to.clone()));
                amounts_to = Some(Sequence { start: Vec::new(), step: Vec::new(), ratio, member, limit });
            }
        }
        let (equation, name, kind) = (claim.equation, claim.name, claim.kind.name());
        Statement { equation, name, kind, hypotheses, invariants, goals, amounts_to }
    }

    /// Without one of its hypotheses.
    pub fn without(&self, hypothesis: usize) -> Self {
        let mut less = self.clone();
        less.hypotheses.remove(hypothesis);
        less
    }

    /// Its hypotheses and its invariants.
    pub fn supposed(&self) -> impl Iterator<Item = &Hypothesis> {
        self.hypotheses.iter().chain(&self.invariants)
    }

    /// All its formulas.
    pub fn trees(&self) -> impl Iterator<Item = &Tree> {
        let hypotheses = self.supposed().map(|h| &h.value);
        hypotheses.chain(self.goals.iter().flat_map(|goal| goal.says.trees()))
    }
}
