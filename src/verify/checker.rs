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
use std::ops::Range;

impl ClaimResult {
    /// Returns the result without cases.
    pub(super) fn new(
        equation: &'static str,
        claim: &'static str,
        kind: &'static str,
        scalar: Option<NumberSystem>,
    ) -> Self {
        ClaimResult {
            equation,
            claim,
            kind,
            status: Status::Undecided,
            scalar,
            reason: None,
            decided: 0,
            undecided: 0,
            worst: None,
            counterexample: None,
        }
    }

    /// Adds the result of later cases.
    pub(super) fn add(&mut self, other: ClaimResult) {
        self.decided += other.decided;
        self.undecided += other.undecided;
        if other.worst.as_ref().is_some_and(|(ratio, _)| self.worst.as_ref().is_none_or(|(r, _)| ratio > r)) {
            self.worst = other.worst;
        }
        if self.counterexample.is_none() {
            (self.counterexample, self.reason) = (other.counterexample, other.reason);
        }
        self.status = match (self.decided, &self.counterexample) {
            (_, Some(_)) => Status::Failed,
            (0, None) => Status::Undecided,
            (_, None) => Status::Held,
        };
    }

    /// Adds a case that cannot be decided.
    pub(super) fn skip(&mut self) {
        self.undecided += 1;
    }

    /// Adds a decided case; a reason says why an evaluation failed.
    fn decide(&mut self, case: &Case<Exact>, holds: bool, reason: Option<String>) {
        self.decided += 1;
        if !holds && self.counterexample.is_none() {
            (self.counterexample, self.reason) = (Some(case.clone()), reason);
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

/// Floats in whose balls claims are checked.
pub(super) trait CheckedFloat: Scalar + Real + Exponential + ToExact + Send + Sync + 'static {}
impl<T: Scalar + Real + Exponential + ToExact + Send + Sync + 'static> CheckedFloat for T {}

impl<T: CheckedFloat> NumberDomain for Balls<T> {
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

/// Adds a case to the results of claims and experiments.
type Check = Box<dyn Fn(&Case<Exact>, &mut [ClaimResult]) + Send + Sync>;

/// Claims and experiments with the same hypotheses, which are checked on the same cases.
pub(super) struct Group {
    pub(super) hypotheses: Vec<Hypothesis>,
    /// Their results without cases.
    pub(super) results: Vec<ClaimResult>,
    /// The results of each number system, with their check.
    pub(super) checks: Vec<(Range<usize>, Check)>,
}

/// Adds the claims that can be evaluated in a number system, and its experiments, to the groups with their hypotheses.
pub(super) fn add_checks<'a, D: NumberDomain + Clone + Send + 'static>(
    groups: &mut Vec<Group>,
    options: &Options,
    (scalar, domain): (NumberSystem, D),
    claims: impl IntoIterator<Item = &'a Statement>,
    mut experiments: Vec<Experiment<D::Number>>,
) {
    // Experiments check claims about rounding.
    let is_evaluable =
        |claim: &Statement| !claim.contains_rounding() && (D::EXPONENTIALS || !claim.contains_exponential());
    let mut claims: Vec<_> = claims.into_iter().filter(|claim| is_evaluable(claim)).collect();
    claims.retain(|claim| options.includes(claim.equation()));
    experiments.retain(|experiment| options.includes(experiment.equation));
    let of_claims = claims.iter().map(|claim| claim.stated_hypotheses().to_vec());
    let of_experiments = experiments.iter().map(|experiment| experiment.hypotheses.clone());
    for hypotheses in of_claims.chain(of_experiments).collect::<Vec<_>>() {
        let claims: Vec<_> = claims.extract_if(.., |claim| claim.stated_hypotheses() == hypotheses).collect();
        let tried: Vec<_> = experiments.extract_if(.., |tried| tried.hypotheses == hypotheses).collect();
        let result = |equation, claim, kind| ClaimResult::new(equation, claim, kind, Some(scalar));
        let of_claims = claims.iter().map(|claim| result(claim.equation(), claim.name(), claim.kind()));
        let of_experiments = tried.iter().map(|tried| result(tried.equation, tried.name, "experiment"));
        let results: Vec<_> = of_claims.chain(of_experiments).collect();
        // Those of hypotheses that occur several times are taken already.
        if results.is_empty() {
            continue;
        }
        let place = groups.iter().position(|group| group.hypotheses == hypotheses).unwrap_or_else(|| {
            groups.push(Group { hypotheses, results: Vec::new(), checks: Vec::new() });
            groups.len() - 1
        });
        let group = &mut groups[place];
        let places = group.results.len()..group.results.len() + results.len();
        group.results.extend(results);
        group.checks.push((places, check(domain.clone(), &claims, tried)));
    }
}

/// Returns the check of claims, whose common formulas are computed once, and of experiments.
fn check<D: NumberDomain + Send + 'static>(
    domain: D,
    claims: &[&Statement],
    experiments: Vec<Experiment<D::Number>>,
) -> Check {
    let mut program = Program::default();
    let tests: Vec<_> = claims.iter().map(|claim| tests(claim, &mut program)).collect();
    Box::new(move |case, results| {
        let (of_claims, of_experiments) = results.split_at_mut(tests.len());
        let symbol = |name: &'static str| domain.value(&case.get_by_symbol(name));
        let values = Evaluation::of(&program, &domain, symbol);
        for (claim, result) in tests.iter().zip(of_claims) {
            result.evaluate(case, &values, claim);
        }
        if experiments.is_empty() {
            return;
        }
        let numbers = Case::try_of(|var| domain.number(case.get(var)).ok_or(()));
        for (experiment, result) in experiments.iter().zip(of_experiments) {
            match &numbers {
                Ok(numbers) => result.try_experiment(case, experiment, numbers),
                Err(()) => result.skip(),
            }
        }
    })
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

#[cfg(test)]
mod tests;
