//! What is to be proved: a claim, read in trees.

use super::claim::{Claim, Kind, MEMBERS, POWER, PRECISION, Rate};
use super::hypothesis::{Hypothesis, Relation};
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
    /// What is supposed; where formulas round, [that](two_bits) as well.
    pub hypotheses: Vec<Hypothesis>,
    /// What holds at every step of an induction; part of its proof, and not supposed.
    pub invariants: Vec<Hypothesis>,
    /// What is supposed of a quantity that is computed, and proved of it.
    pub computed: Option<Computed>,
    /// What follows.
    pub goals: Vec<Goal>,
    /// What the goals amount to, where that is more than they say: for readers, and no part of what is
    /// proved.
    pub amounts_to: Option<Sequence>,
}

/// A quantity that is computed.
#[derive(Clone, Debug)]
pub struct Computed {
    /// What it is called.
    pub symbol: &'static str,
    /// How it is computed.
    pub by: Tree,
    /// In which interval it is.
    pub hypothesis: Hypothesis,
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
    /// If its k-th member is only near that: what is of limited size, with its bound.
    pub within: Vec<(Tree, Tree)>,
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
    /// What is computed is where it may be supposed to be.
    Computed,
}

/// What a goal says.
#[derive(Clone, Debug)]
pub enum Says {
    /// Two formulas are equal, and defined.
    Equal(Tree, Tree),
    /// A formula is defined and has a sign.
    Sign(Relation, Tree),
    /// A formula is no larger in size than another.
    Within(Tree, Tree),
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
    /// A hypothesis, as something to be proved, with formulas in place of symbols.
    ///
    /// |x − a| ≤ b is more than that x is between a − b and a + b, if b could be negative.
    fn of_hypothesis(hypothesis: &Hypothesis, replaced: &[(&str, Tree)]) -> Self {
        match hypothesis.distance() {
            Some((distance, most)) => Says::Within(distance.with(replaced), most.with(replaced)),
            None => Says::Sign(hypothesis.relation, hypothesis.value.with(replaced)),
        }
    }

    /// The symbol that varies, if one does.
    pub fn variable(&self) -> Option<&'static str> {
        match self {
            Says::Derivative(_, by, _) | Says::Limit(_, by, _) => Some(by),
            Says::Equal(..) | Says::Sign(..) | Says::Within(..) => None,
        }
    }

    /// Its formulas.
    pub fn trees(&self) -> [&Tree; 2] {
        match self {
            Says::Equal(a, b) | Says::Within(a, b) => [a, b],
            Says::Derivative(a, _, b) | Says::Limit(a, _, b) => [a, b],
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
        let computed = claim.computed.as_ref().and_then(|(symbol, by)| {
            let of_it = |given: &Hypothesis| given.interval().is_some_and(|(x, ..)| x == *symbol);
            let hypothesis = hypotheses.remove(hypotheses.iter().position(of_it)?);
            let says = Says::of_hypothesis(&hypothesis, &[(symbol, by.clone())]);
            goals.push(Goal { part: "computed", role: Role::Computed, says });
            Some(Computed { symbol, by: by.clone(), hypothesis })
        });
        let mut amounts_to = None;
        match &claim.kind {
            Kind::Equal(left, right) => goals.push(goal("", Says::Equal(left.clone(), right.clone()))),
            Kind::Within(of, bound) => goals.push(goal("", Says::Within(of.clone(), bound.clone()))),
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
                (invariants, hypotheses) = hypotheses.into_iter().partition(of_q);
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
                    let begins = Says::of_hypothesis(given, &[(q, Tree::one())]);
                    let continues = Says::of_hypothesis(given, &[(q, next.clone())]);
                    goals.extend(invariant(begins, continues));
                }
                let (start, step) = (start.clone(), step.clone());
                let (ratio, member) = (ratio.clone(), closed.clone());
                amounts_to = Some(Sequence { start, step, ratio, member, limit: None, within: Vec::new() });
            }
            Kind::Drift { ratio, start, step, near, bound, also } => {
                (invariants, hypotheses) = hypotheses.into_iter().partition(of_q);
                let x = MEMBERS[0];
                invariants.push(Hypothesis::near(&Tree::symbol(x), near, bound));
                let at_start = [(POWER, Tree::one()), (x, start.clone())];
                let after = [(POWER, ratio * Tree::symbol(POWER)), (x, step.clone())];
                for given in &invariants {
                    let [begins, continues] = [&at_start, &after].map(|at| Says::of_hypothesis(given, at));
                    goals.extend(invariant(begins, continues));
                }
                for (of, bound) in also {
                    let says = Says::Within(of.clone(), bound.clone());
                    goals.push(Goal { part: "hence", role: Role::Step, says });
                }
                let own = (Tree::symbol(x) - near, bound.clone());
                amounts_to = Some(Sequence {
                    start: vec![start.clone()],
                    step: vec![step.clone()],
                    ratio: ratio.clone(),
                    member: vec![near.clone()],
                    limit: None,
                    within: [own].into_iter().chain(also.iter().cloned()).collect(),
                });
            }
            Kind::Vanishing { ratio, of, to } => {
                let margin = Tree::one() - ratio * ratio;
                goals.push(goal("|ρ| < 1", Says::Sign(Relation::Positive, margin)));
                let at_zero = of.with(&[(POWER, Tree::zero())]);
                goals.push(goal("at q = 0", Says::Equal(at_zero, to.clone())));
                let (ratio, member, limit) = (ratio.clone(), vec![of.clone()], Some(to.clone()));
                let (start, step, within) = (Vec::new(), Vec::new(), Vec::new());
                amounts_to = Some(Sequence { start, step, ratio, member, limit, within });
            }
        }
        let (equation, name, kind) = (claim.equation, claim.name, claim.kind.name());
        if claim.rounds() {
            // Last if others speak of the precision, for they say more.
            let of_precision = |h: &Hypothesis| h.value.symbols().contains(PRECISION);
            let place = if hypotheses.iter().any(of_precision) { hypotheses.len() } else { 0 };
            hypotheses.insert(place, two_bits());
        }
        Statement { equation, name, kind, hypotheses, invariants, computed, goals, amounts_to }
    }

    /// Without one of its hypotheses.
    pub fn without(&self, hypothesis: usize) -> Self {
        let mut less = self.clone();
        less.hypotheses.remove(hypothesis);
        less
    }

    /// Does it hold for numbers of any precision, and speak of what is rounded?
    pub fn rounds(&self) -> bool {
        self.hypotheses.contains(&two_bits())
    }

    /// All that it supposes: also its invariants, and where what is computed is.
    pub fn supposed(&self) -> impl Iterator<Item = &Hypothesis> {
        let computed = self.computed.iter().map(|computed| &computed.hypothesis);
        self.hypotheses.iter().chain(&self.invariants).chain(computed)
    }

    /// All its formulas.
    pub fn trees(&self) -> impl Iterator<Item = &Tree> {
        let hypotheses = self.supposed().map(|h| &h.value);
        hypotheses.chain(self.goals.iter().flat_map(|goal| goal.says.trees()))
    }
}

/// What goes without saying where formulas round: numbers have 2 bits or more.
pub fn two_bits() -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::from(4))
}

/// What has to be shown of an invariant: it holds at the start, and after a step if it does before.
fn invariant(begins: Says, continues: Says) -> [Goal; 2] {
    let begins = Goal { part: "invariant at the start", role: Role::Begins, says: begins };
    [begins, Goal { part: "invariant after a step", role: Role::Continues, says: continues }]
}
