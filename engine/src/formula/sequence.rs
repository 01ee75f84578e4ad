//! Statements about sequences.

use super::hypothesis::{Hypothesis, Relation};
use super::proposition::{Goal, Proposition, Role};
use super::symbols::{MEMBERS, POWER};
use crate::number::Tree;
use num_traits::{One, Zero};

/// A statement about all members of a sequence.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// The first member; empty in the limit of a sequence.
    pub start: Vec<Tree>,
    /// The next member, as a formula of the [`MEMBERS`]; empty in the limit of a sequence.
    pub step: Vec<Tree>,
    /// ρ
    pub ratio: Tree,
    /// The k-th member as a formula of q = ρᵏ; for a perturbed recursion its approximation.
    pub member: Vec<Tree>,
    /// The limit, if the statement is about one.
    pub limit: Option<Tree>,
    /// Bounded quantities of a perturbed recursion with their bounds; the first is the distance of the member
    /// from its formula.
    pub within: Vec<(Tree, Tree)>,
}

impl Sequence {
    /// Returns `true` if the members are only near their formula.
    pub fn is_perturbed(&self) -> bool {
        !self.within.is_empty()
    }

    pub(super) fn kind(&self) -> &'static str {
        match &self.limit {
            Some(_) => "vanishing",
            None if self.is_perturbed() => "drift",
            None => "induction",
        }
    }

    pub(super) fn trees(&self) -> impl Iterator<Item = &Tree> {
        let Sequence { start, step, ratio, member, limit, within } = self;
        let bounds = within.iter().flat_map(|(of, bound)| [of, bound]);
        [ratio].into_iter().chain(start).chain(step).chain(member).chain(limit).chain(bounds)
    }

    pub(super) fn map(&self, f: &impl Fn(&Tree) -> Tree) -> Self {
        Sequence {
            start: self.start.iter().map(f).collect(),
            step: self.step.iter().map(f).collect(),
            ratio: f(&self.ratio),
            member: self.member.iter().map(f).collect(),
            limit: self.limit.as_ref().map(f),
            within: self.within.iter().map(|(of, bound)| (f(of), f(bound))).collect(),
        }
    }

    /// Returns `true` if a hypothesis concerns a quantity that changes with k: a power, or in a perturbed
    /// recursion a member.
    pub(super) fn changes(&self, hypothesis: &Hypothesis) -> bool {
        let symbols = hypothesis.value.symbols();
        symbols.contains(POWER) || self.is_perturbed() && symbols.contains(MEMBERS[0])
    }

    /// Returns the invariant of a perturbed recursion: the distance of a member from its formula.
    pub(super) fn invariant(&self) -> Option<Hypothesis> {
        let ((_, bound), closed) = (self.within.first()?, self.member.first()?);
        Some(Hypothesis::near(&Tree::symbol(MEMBERS[0]), closed, bound))
    }

    /// Returns the goals of the induction over k.
    ///
    /// A recursion has the closed form x_k = closed(ρᵏ) if closed(1) is its start and one step leads from
    /// closed(q) to closed(ρ q) for every q. A hypothesis on q, or on a member of a perturbed recursion, is
    /// an invariant: it must hold at the start, for q = 1, by the other hypotheses alone, and be preserved
    /// from q to ρ q and from a member to the next; then the step may use it.
    pub(super) fn goals(&self, invariants: &[Hypothesis]) -> Vec<Goal> {
        let goal = |part, role, proposition| Goal { part, role, proposition };
        let Sequence { start, step, ratio, member, limit, within } = self;
        if let Some(limit) = limit {
            let margin = Proposition::Sign(Relation::Positive, Tree::one() - ratio * ratio);
            let at_zero = member.iter().map(|member| {
                let at_zero = Proposition::Equal(member.substitute(&[(POWER, Tree::zero())]), limit.clone());
                goal("at q = 0", Role::Claim, at_zero)
            });
            return [goal("|ρ| < 1", Role::Claim, margin)].into_iter().chain(at_zero).collect();
        }
        let next = ratio * Tree::symbol(POWER);
        let (mut at_start, mut after) = (vec![(POWER, Tree::one())], vec![(POWER, next.clone())]);
        let mut goals = Vec::new();
        if !self.is_perturbed() {
            for (start, closed) in start.iter().zip(member) {
                let equal = Proposition::Equal(closed.substitute(&at_start), start.clone());
                goals.push(goal("start", Role::Claim, equal));
            }
            let members: Vec<_> = MEMBERS.into_iter().zip(member.iter().cloned()).collect();
            for (step, closed) in step.iter().zip(member) {
                let equal = Proposition::Equal(step.substitute(&members), closed.substitute(&after));
                goals.push(goal("step", Role::Step, equal));
            }
        } else {
            at_start.extend(MEMBERS.into_iter().zip(start.iter().cloned()));
            after.extend(MEMBERS.into_iter().zip(step.iter().cloned()));
        }
        for invariant in invariants {
            let [base, step] = [&at_start, &after].map(|at| Proposition::of_hypothesis(invariant, at));
            goals.push(goal("invariant at the start", Role::InvariantBase, base));
            goals.push(goal("invariant after a step", Role::InvariantStep, step));
        }
        // The first one is an invariant.
        goals.extend(
            within
                .iter()
                .skip(1)
                .map(|(of, bound)| goal("hence", Role::Step, Proposition::Within(of.clone(), bound.clone()))),
        );
        goals
    }
}
