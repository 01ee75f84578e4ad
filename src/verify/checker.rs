//! Checks of claims in one number system.

use super::experiments::{Experiment, Trial};
use super::{ClaimResult, Options, Status};
use crate::claims::Case;
use crate::eval::{
    Balls, Decidable, Domain, Evaluation, Failure, Instance, Rationals, Test, UNFOLDED_MEMBERS, Value,
    Verdict, instances,
};
use crate::formula::statement::Role;
use crate::formula::{Hypothesis, Proposition, Statement};
use crate::number::{Ball, Exact, Exponential, Mpfr, NumberSystem, Program, Real, ToExact};
use crate::solver::Scalar;
use num_traits::Zero;
use std::fmt::Debug;

/// Identification and hypotheses of a claim in any number system.
#[derive(Clone)]
pub(super) struct ClaimKey {
    pub(super) equation: &'static str,
    claim: &'static str,
    kind: &'static str,
    pub(super) hypotheses: Vec<Hypothesis>,
}

impl ClaimKey {
    fn of_claim(claim: &Statement) -> Self {
        ClaimKey {
            equation: claim.equation(),
            claim: claim.name(),
            kind: claim.kind(),
            hypotheses: claim.stated_hypotheses().to_vec(),
        }
    }

    fn of_experiment<T>(experiment: &Experiment<T>) -> Self {
        ClaimKey {
            equation: experiment.equation,
            claim: experiment.name,
            kind: "experiment",
            hypotheses: experiment.hypotheses.clone(),
        }
    }
}

/// Results of the cases of a claim.
#[derive(Default)]
pub(super) struct ClaimTally {
    decided: u64,
    undecided: u64,
    worst: Option<(f64, String)>,
    /// First case in which the claim does not hold, with the reason if its evaluation failed.
    failure: Option<(Case<Exact>, Option<String>)>,
}

impl ClaimTally {
    /// Adds the tally of later cases.
    pub(super) fn add(&mut self, other: ClaimTally) {
        self.decided += other.decided;
        self.undecided += other.undecided;
        if other.worst.as_ref().is_some_and(|(ratio, _)| self.worst.as_ref().is_none_or(|(r, _)| ratio > r)) {
            self.worst = other.worst;
        }
        self.failure = self.failure.take().or(other.failure);
    }

    /// Adds a case that cannot be decided.
    fn skip(&mut self) {
        self.undecided += 1;
    }

    /// Adds a decided case; a reason says why an evaluation failed.
    fn decide(&mut self, case: &Case<Exact>, holds: bool, reason: Option<String>) {
        self.decided += 1;
        if !holds {
            self.failure.get_or_insert_with(|| (case.clone(), reason));
        }
    }

    /// Adds the ratio of an error and its bound, which is formatted only if it is the worst so far.
    fn measure(&mut self, ratio: f64, bound: impl FnOnce() -> String) {
        if self.worst.as_ref().is_none_or(|(worst, _)| ratio > *worst) {
            self.worst = Some((ratio, bound()));
        }
    }

    fn try_experiment<T>(&mut self, case: &Case<Exact>, experiment: &Experiment<T>, computed: &Case<T>) {
        match (experiment.check)(computed) {
            Trial::Undecided => self.skip(),
            Trial::Decided(holds) => self.decide(case, holds, None),
            Trial::Within { error, bound } => {
                self.measure(ratio(&error, &bound), || Mpfr::rounded(24, bound.as_rational()).to_string());
                self.decide(case, error <= bound, None);
            }
        }
    }

    fn evaluate<D: NumberDomain>(
        &mut self,
        case: &Case<Exact>,
        values: &Evaluation<'_, &D, impl Fn(&'static str) -> D::Value>,
        claim: &[(&'static str, Test)],
    ) {
        let (holds, reason) = match values.verdict(claim) {
            Verdict::Excluded | Verdict::Undecided => return self.skip(),
            Verdict::Holds => (true, None),
            Verdict::Fails(_, Failure::Undefined(_)) => (false, Some("division by zero".to_string())),
            Verdict::Fails(..) => (false, None),
        };
        for (_, test) in claim {
            if let Test::Equal([left, right]) = test
                && let (Some(left), Some(right)) = (values.at(*left), values.at(*right))
            {
                let [error, bound] = D::difference(left, right);
                self.measure(ratio(&error, &bound), || format!("{bound:?}"));
            }
        }
        self.decide(case, holds, reason);
    }

    pub(super) fn into_result(self, key: ClaimKey, scalar: Option<NumberSystem>) -> ClaimResult {
        let status = match (&self.failure, self.decided) {
            (Some(_), _) => Status::Failed,
            (None, 0) => Status::Undecided,
            (None, _) => Status::Held,
        };
        let (counterexample, reason) = self.failure.unzip();
        ClaimResult {
            equation: key.equation,
            claim: key.claim,
            kind: key.kind,
            scalar,
            status,
            reason: reason.flatten(),
            decided: self.decided,
            undecided: self.undecided,
            worst: self.worst,
            counterexample,
        }
    }
}

/// Number system in which claims are checked.
pub(super) trait NumberDomain: Domain<Value: Decidable> + Sync {
    /// Numbers of the experiments.
    type Number: Scalar + ToExact + Debug;

    /// Whether it has exponentials.
    const EXPONENTIALS: bool;

    /// Returns the value of a number, which is unknown if it is out of range.
    fn value(&self, x: &Exact) -> Self::Value;

    /// Returns the number that experiments use; `None` if it is out of range.
    fn number(&self, x: &Exact) -> Option<Self::Number>;

    /// Returns the difference of the two sides of an equation that holds, and its bound.
    fn difference(left: &Self::Value, right: &Self::Value) -> [Self::Number; 2];
}

impl NumberDomain for Rationals {
    type Number = Exact;
    const EXPONENTIALS: bool = false;
    fn value(&self, x: &Exact) -> Value {
        Value::Exact(x.clone())
    }
    fn number(&self, x: &Exact) -> Option<Exact> {
        Some(x.clone())
    }
    fn difference(_: &Value, _: &Value) -> [Exact; 2] {
        [Exact::zero(), Exact::zero()]
    }
}

impl<T> NumberDomain for Balls<T>
where
    T: Scalar + Real + Exponential + ToExact + std::fmt::Display + Sync,
{
    type Number = T;
    const EXPONENTIALS: bool = true;
    fn value(&self, x: &Exact) -> Ball<T> {
        self.enclose(x).unwrap_or_else(|_| Ball::entire())
    }
    fn number(&self, x: &Exact) -> Option<T> {
        self.0.round_from_exact(x).ok()
    }
    fn difference(left: &Ball<T>, right: &Ball<T>) -> [T; 2] {
        let difference = left - right;
        [difference.value().abs(), difference.radius().clone()]
    }
}

/// Returns the ratio of an error and its bound, for a report only.
fn ratio<T: Scalar + ToExact>(error: &T, bound: &T) -> f64 {
    match (error.is_zero(), bound.is_zero()) {
        (true, _) => 0.0,
        (false, true) => f64::INFINITY,
        (false, false) => {
            (error / bound).to_exact().map_or(f64::INFINITY, |ratio| ratio.as_rational().to_f64())
        }
    }
}

/// Claims and experiments of a number system with its types erased.
pub(super) trait ErasedChecker: Sync {
    /// Returns the keys of all claims and experiments in order.
    fn keys(&self) -> Vec<ClaimKey>;

    /// Checks the claims and experiments with these hypotheses that the options include, in cases that
    /// satisfy the hypotheses. Each tally has the index of its claim.
    fn check(
        &self,
        hypotheses: &[Hypothesis],
        options: &Options,
        cases: &[Option<Case<Exact>>],
    ) -> Vec<(usize, ClaimTally)>;
}

/// Claims with the same hypotheses, which are checked on the same cases.
struct Group {
    hypotheses: Vec<Hypothesis>,
    program: Program,
    /// Each claim with its index and its tests.
    claims: Vec<(usize, Vec<(&'static str, Test)>)>,
}

/// Groups claims by their hypotheses.
fn groups(claims: &[Statement]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, claim) in claims.iter().enumerate() {
        let hypotheses = claim.stated_hypotheses();
        let place = groups.iter().position(|group| group.hypotheses == hypotheses).unwrap_or_else(|| {
            let (program, claims) = Default::default();
            groups.push(Group { hypotheses: hypotheses.to_vec(), program, claims });
            groups.len() - 1
        });
        let Group { program, claims, .. } = &mut groups[place];
        claims.push((index, tests(claim, program)));
    }
    groups
}

/// Returns the tests of a claim: those of its instances, and those of the steps of its induction for any q.
/// The rate of a limit is tested in place of the limit.
fn tests(claim: &Statement, program: &mut Program) -> Vec<(&'static str, Test)> {
    let steps = claim.goals().iter().filter(|goal| goal.role != Role::Claim);
    let steps = steps.map(|goal| Instance::new(goal.part, goal.proposition.clone()));
    let all = instances(claim, UNFOLDED_MEMBERS).into_iter().chain(steps);
    all.filter(|instance| !matches!(instance.proposition, Proposition::Limit(..)))
        .map(|instance| (instance.part, Test::of(&instance, program)))
        .collect()
}

pub(super) struct Checker<D: NumberDomain> {
    domain: D,
    /// In the order of the keys.
    claims: Vec<Statement>,
    groups: Vec<Group>,
    experiments: Vec<Experiment<D::Number>>,
}

impl<D: NumberDomain> Checker<D> {
    /// Returns a checker of the claims that can be evaluated in these numbers, and of experiments.
    pub(super) fn new<'a>(
        domain: D,
        claims: impl IntoIterator<Item = &'a Statement>,
        experiments: Vec<Experiment<D::Number>>,
    ) -> Self {
        // Experiments check claims about rounding.
        let recorded = claims.into_iter().filter(|claim| !claim.contains_rounding());
        let evaluable = recorded.filter(|claim| D::EXPONENTIALS || !claim.contains_exponential());
        let claims: Vec<Statement> = evaluable.cloned().collect();
        Checker { domain, groups: groups(&claims), claims, experiments }
    }
}

impl<D: NumberDomain> ErasedChecker for Checker<D> {
    fn keys(&self) -> Vec<ClaimKey> {
        let experiments = self.experiments.iter().map(ClaimKey::of_experiment);
        self.claims.iter().map(ClaimKey::of_claim).chain(experiments).collect()
    }

    fn check(
        &self,
        hypotheses: &[Hypothesis],
        options: &Options,
        cases: &[Option<Case<Exact>>],
    ) -> Vec<(usize, ClaimTally)> {
        let offset = self.claims.len();
        let group = self.groups.iter().find(|group| group.hypotheses == hypotheses);
        let mut claims: Vec<_> = group.map_or(&[][..], |group| &group.claims).iter().collect();
        claims.retain(|(place, _)| options.includes(self.claims[*place].equation()));
        let mut experiments: Vec<_> = self.experiments.iter().enumerate().collect();
        experiments.retain(|(_, e)| e.hypotheses == hypotheses && options.includes(e.equation));
        let places = claims.iter().map(|(i, _)| *i).chain(experiments.iter().map(|(i, _)| offset + i));
        let mut tallies: Vec<(usize, ClaimTally)> =
            places.map(|place| (place, ClaimTally::default())).collect();
        if tallies.is_empty() {
            return tallies;
        }
        let (of_claims, of_experiments) = tallies.split_at_mut(claims.len());
        for case in cases {
            let Some(case) = case else {
                of_claims.iter_mut().chain(&mut *of_experiments).for_each(|(_, tally)| tally.skip());
                continue;
            };
            if let Some(group) = group.filter(|_| !claims.is_empty()) {
                let symbol = |name: &'static str| self.domain.value(&case.get_by_symbol(name));
                let values = Evaluation::of(&group.program, &self.domain, symbol);
                for ((_, claim), (_, tally)) in claims.iter().zip(&mut *of_claims) {
                    tally.evaluate(case, &values, claim);
                }
            }
            if experiments.is_empty() {
                continue;
            }
            let numbers = Case::try_of(|var| self.domain.number(case.get(var)).ok_or(()));
            for ((_, experiment), (_, tally)) in experiments.iter().zip(&mut *of_experiments) {
                match &numbers {
                    Ok(numbers) => tally.try_experiment(case, experiment, numbers),
                    Err(()) => tally.skip(),
                }
            }
        }
        tallies
    }
}

#[cfg(test)]
mod tests;
