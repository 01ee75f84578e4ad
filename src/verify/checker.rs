//! Checks of claims in one number system.

use super::catch_panic::catch_panic;
use super::experiments::{Experiment, Trial, exact_experiments, float_experiments};
use super::goals::{Group, Test, groups};
use super::{Row, Status};
use crate::claims::Case;
use crate::formula::{Hypothesis, Statement};
use crate::number::tree::{Op, all_ops, piecewise_ops};
use crate::number::{Ball, Exact, Exponential, Mpfr, NumberSystem, PositivePart, Real, ToExact};
use crate::solver::Scalar;
use num_traits::Zero;
use std::borrow::Cow;
use std::cmp::Ordering;

/// Identification and hypotheses of a claim in any number system.
#[derive(Clone)]
pub(super) struct ClaimKey {
    pub(super) equation: &'static str,
    claim: &'static str,
    kind: &'static str,
    pub(super) given: Vec<Hypothesis>,
}

/// Results of the cases of a claim.
#[derive(Default)]
pub(super) struct Tally {
    decided: u64,
    undecided: u64,
    worst: Option<(f64, String)>,
    /// First case in which the claim does not hold, with the reason if its evaluation failed.
    failure: Option<(Case<Exact>, Option<String>)>,
}

impl Tally {
    /// Adds the tally of later cases.
    pub(super) fn add(&mut self, other: Tally) {
        self.decided += other.decided;
        self.undecided += other.undecided;
        if other.worst.as_ref().is_some_and(|(ratio, _)| self.worst.as_ref().is_none_or(|(r, _)| ratio > r)) {
            self.worst = other.worst;
        }
        self.failure = self.failure.take().or(other.failure);
    }

    fn record(&mut self, case: &Case<Exact>, verdict: Verdict<'_>) {
        match verdict {
            Verdict::Undecided => self.undecided += 1,
            Verdict::Failed(reason) => {
                self.decided += 1;
                self.failure.get_or_insert_with(|| (case.clone(), Some(reason)));
            }
            Verdict::Decided { holds, measured } => {
                self.decided += 1;
                if let Some((ratio, bound)) = measured
                    && self.worst.as_ref().is_none_or(|(worst, _)| ratio > *worst)
                {
                    self.worst = Some((ratio, bound()));
                }
                if !holds {
                    self.failure.get_or_insert_with(|| (case.clone(), None));
                }
            }
        }
    }

    pub(super) fn into_row(self, head: ClaimKey, scalar: Option<NumberSystem>) -> Row {
        let status = match (&self.failure, self.decided) {
            (Some(_), _) => Status::Failed,
            (None, 0) => Status::Undecided,
            (None, _) => Status::Held,
        };
        let (counterexample, reason) = self.failure.unzip();
        Row {
            equation: head.equation,
            claim: head.claim,
            kind: head.kind,
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

/// Result of a claim in one case; the bound is formatted only if it is the worst so far.
enum Verdict<'a> {
    Undecided,
    /// The evaluation failed, for example because the claim is undefined; with the reason.
    Failed(String),
    Decided {
        holds: bool,
        measured: Option<(f64, Box<dyn Fn() -> String + 'a>)>,
    },
}

/// Number system in which claims are checked.
pub(super) trait NumberDomain: Sync {
    /// Numbers of the claims.
    type Number: PositivePart;
    /// Numbers of the experiments.
    type Computed: Clone;

    /// Whether it has exponentials.
    const EXPONENTIALS: bool;
    /// Evaluates a quotient, eˣ, ⟨·⟩ or min; `None` if it is undefined.
    fn step(step: Op<&Self::Number>) -> Option<Self::Number>;
    fn experiments(&self) -> Vec<Experiment<Self::Computed>>;

    /// Returns a case in these numbers; `None` if a coordinate is out of range.
    fn read<'a>(&self, case: &'a Case<Exact>) -> Option<Cow<'a, Case<Self::Number>>>;
    /// Returns the case in the numbers of the experiments.
    fn computed<'a>(&self, case: &'a Case<Self::Number>) -> Cow<'a, Case<Self::Computed>>;

    /// Returns for left − right whether it may be 0, the ratio of error and bound, and the difference.
    fn difference(&self, left: &Self::Number, right: &Self::Number) -> Option<(bool, f64, Self::Number)>;
    fn bound(&self, difference: &Self::Number) -> String;
    fn sign(&self, x: &Self::Number) -> Option<Ordering>;
}

/// Rationals, compared by `==`.
pub(super) struct RationalDomain;

impl NumberDomain for RationalDomain {
    type Number = Exact;
    type Computed = Exact;
    const EXPONENTIALS: bool = false;
    fn step(step: Op<&Exact>) -> Option<Exact> {
        match step {
            Op::Div(a, b) => (!b.is_zero()).then(|| a / b),
            other => piecewise_ops(other),
        }
    }
    fn experiments(&self) -> Vec<Experiment<Exact>> {
        exact_experiments()
    }
    fn read<'a>(&self, case: &'a Case<Exact>) -> Option<Cow<'a, Case<Exact>>> {
        Some(Cow::Borrowed(case))
    }
    fn computed<'a>(&self, case: &'a Case<Exact>) -> Cow<'a, Case<Exact>> {
        Cow::Borrowed(case)
    }
    fn difference(&self, left: &Exact, right: &Exact) -> Option<(bool, f64, Exact)> {
        Some((left == right, 0.0, Exact::zero()))
    }
    fn bound(&self, difference: &Exact) -> String {
        difference.to_string()
    }
    fn sign(&self, x: &Exact) -> Option<Ordering> {
        Some(x.cmp(&Exact::zero()))
    }
}

/// Floats, enclosed by balls; the field determines their type and precision.
pub(super) struct FloatDomain<T>(pub(super) T);

impl<T> NumberDomain for FloatDomain<T>
where
    T: Scalar + Real + Exponential + ToExact + std::fmt::Display + Sync,
{
    type Number = Ball<T>;
    type Computed = T;
    const EXPONENTIALS: bool = true;
    fn step(step: Op<&Ball<T>>) -> Option<Ball<T>> {
        match step {
            // The quotient by a ball that contains 0 is unbounded.
            Op::Div(a, b) => Some(a / b).filter(|quotient| !quotient.is_undefined()),
            other => all_ops(other),
        }
    }
    fn experiments(&self) -> Vec<Experiment<T>> {
        float_experiments()
    }
    fn read<'a>(&self, case: &'a Case<Exact>) -> Option<Cow<'a, Case<Ball<T>>>> {
        Case::try_of(|var| Ball::enclosing(&self.0, case.get(var))).ok().map(Cow::Owned)
    }
    fn computed<'a>(&self, case: &'a Case<Ball<T>>) -> Cow<'a, Case<T>> {
        Cow::Owned(case.map(|_, ball| ball.value().clone()))
    }
    fn difference(&self, left: &Ball<T>, right: &Ball<T>) -> Option<(bool, f64, Ball<T>)> {
        let difference = left - right;
        if !difference.is_finite() {
            return None;
        }
        let (error, bound) = (difference.value().abs(), difference.radius());
        let ratio = share(&error, bound);
        Some((error <= *bound, ratio, difference))
    }
    fn bound(&self, difference: &Ball<T>) -> String {
        format!("{:?}", difference.radius())
    }
    fn sign(&self, x: &Ball<T>) -> Option<Ordering> {
        x.sign()
    }
}

/// Returns the ratio of an error and its bound, for a report only.
fn share<T: Scalar + ToExact>(error: &T, bound: &T) -> f64 {
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
    /// Returns all claims and experiments in order.
    fn heads(&self) -> Vec<ClaimKey>;

    /// Checks those with these hypotheses; each tally has the index of its claim.
    fn check(
        &self,
        given: &[Hypothesis],
        wanted: &dyn Fn(&str) -> bool,
        cases: &[Option<Case<Exact>>],
    ) -> Vec<(usize, Tally)>;
}

pub(super) struct Checker<J: NumberDomain> {
    judge: J,
    /// In the order of the keys.
    claims: Vec<Statement>,
    groups: Vec<Group>,
    experiments: Vec<Experiment<J::Computed>>,
}

impl<J: NumberDomain> Checker<J> {
    /// Returns a checker of the claims that can be evaluated in these numbers.
    pub(super) fn new<'a>(judge: J, claims: impl IntoIterator<Item = &'a Statement>) -> Self {
        let experiments = judge.experiments();
        Checker::with(judge, claims, experiments)
    }

    pub(super) fn with<'a>(
        judge: J,
        claims: impl IntoIterator<Item = &'a Statement>,
        experiments: Vec<Experiment<J::Computed>>,
    ) -> Self {
        // Experiments check claims about rounding.
        let can_be_asked = |claim: &&Statement| {
            !claim.contains_rounding() && (J::EXPONENTIALS || !claim.contains_exponential())
        };
        let claims: Vec<Statement> = claims.into_iter().filter(can_be_asked).cloned().collect();
        Checker { judge, groups: groups(&claims), claims, experiments }
    }
}

impl<J: NumberDomain> ErasedChecker for Checker<J> {
    fn heads(&self) -> Vec<ClaimKey> {
        let claim = |c: &Statement| ClaimKey {
            equation: c.equation(),
            claim: c.name(),
            kind: c.kind(),
            given: c.stated_hypotheses().to_vec(),
        };
        let experiment = |e: &Experiment<J::Computed>| ClaimKey {
            equation: e.equation,
            claim: e.name,
            kind: "experiment",
            given: e.given.clone(),
        };
        self.claims.iter().map(claim).chain(self.experiments.iter().map(experiment)).collect()
    }

    fn check(
        &self,
        given: &[Hypothesis],
        wanted: &dyn Fn(&str) -> bool,
        cases: &[Option<Case<Exact>>],
    ) -> Vec<(usize, Tally)> {
        let offset = self.claims.len();
        let group = self.groups.iter().find(|group| group.given == given);
        let mut claims: Vec<_> = group.map_or(&[][..], |group| &group.claims).iter().collect();
        claims.retain(|(place, _)| wanted(self.claims[*place].equation()));
        let mut experiments: Vec<_> = self.experiments.iter().enumerate().collect();
        experiments.retain(|(_, e)| e.given == given && wanted(e.equation));
        let places = claims.iter().map(|(i, _)| *i).chain(experiments.iter().map(|(i, _)| offset + i));
        let mut tallies: Vec<(usize, Tally)> = places.map(|place| (place, Tally::default())).collect();
        if tallies.is_empty() {
            return tallies;
        }
        for case in cases {
            let Some((exact, read)) = case.as_ref().and_then(|case| Some((case, self.judge.read(case)?)))
            else {
                tallies.iter_mut().for_each(|(_, tally)| tally.undecided += 1);
                continue;
            };
            let (of_claims, of_experiments) = tallies.split_at_mut(claims.len());
            if let Some(group) = group.filter(|_| !claims.is_empty()) {
                let values = group.program.run(&|name| read.get_by_symbol(name), &J::step);
                for ((_, asked), (_, tally)) in claims.iter().zip(of_claims) {
                    tally.record(exact, self.verdict(asked, &values));
                }
            }
            if experiments.is_empty() {
                continue;
            }
            let computed = self.judge.computed(&read);
            for ((_, experiment), (_, tally)) in experiments.iter().zip(of_experiments) {
                let verdict = catch_panic(|| of_trial((experiment.check)(&computed)));
                tally.record(exact, verdict.unwrap_or_else(Verdict::Failed));
            }
        }
        tallies
    }
}

impl<J: NumberDomain> Checker<J> {
    /// Combines all tests of a claim: a failure decides, otherwise an undecided test leaves the case
    /// undecided. So does a claim without tests, for example about a derivative that does not exist.
    fn verdict<'a>(&'a self, asked: &[Test], values: &[Option<J::Number>]) -> Verdict<'a>
    where
        J::Number: 'a,
    {
        let (mut open, mut holds) = (asked.is_empty(), true);
        let mut worst: Option<(f64, J::Number)> = None;
        for asked in asked {
            let answer = match asked {
                Test::Equal(left, right) => {
                    values[*left].as_ref().zip(values[*right].as_ref()).map(|(left, right)| {
                        let (equal, ratio, difference) = self.judge.difference(left, right)?;
                        if worst.as_ref().is_none_or(|(r, _)| ratio > *r) {
                            worst = Some((ratio, difference));
                        }
                        Some(equal)
                    })
                }
                Test::Sign(relation, x) => {
                    values[*x].as_ref().map(|x| self.judge.sign(x).map(|sign| relation.admits(sign)))
                }
            };
            match answer {
                None => return Verdict::Failed("division by zero".to_string()),
                Some(None) => open = true,
                Some(Some(answer)) => holds &= answer,
            }
        }
        if holds && open {
            return Verdict::Undecided;
        }
        let measured = worst.map(|(ratio, difference)| {
            let bound: Box<dyn Fn() -> String + 'a> = Box::new(move || self.judge.bound(&difference));
            (ratio, bound)
        });
        Verdict::Decided { holds, measured }
    }
}

fn of_trial<'a>(trial: Trial) -> Verdict<'a> {
    match trial {
        Trial::Undecided => Verdict::Undecided,
        Trial::Decided(holds) => Verdict::Decided { holds, measured: None },
        Trial::Within { error, bound } => {
            let (holds, ratio) = (error <= bound, share(&error, &bound));
            let text: Box<dyn Fn() -> String> =
                Box::new(move || Mpfr::rounded(24, bound.as_rational()).to_string());
            Verdict::Decided { holds, measured: Some((ratio, text)) }
        }
    }
}

#[cfg(test)]
mod tests;
