//! The claims of one number system on given cases.

use super::experiments::{Experiment, Trial, exact_experiments, float_experiments};
use super::goals::{Asked, Group, groups};
use super::guard::guarded;
use super::{Row, Status};
use crate::claims::Case;
use crate::formula::{Hypothesis, Statement};
use crate::number::tree::{Step, everything, piecewise};
use crate::number::{Ball, Exact, Exponential, Mpfr, NumberSystem, PositivePart, Real, ToExact};
use crate::solver::Scalar;
use num_traits::Zero;
use std::borrow::Cow;
use std::cmp::Ordering;

/// What a claim is called and supposes, in whatever number system.
#[derive(Clone)]
pub(super) struct Head {
    pub(super) equation: &'static str,
    claim: &'static str,
    kind: &'static str,
    pub(super) given: Vec<Hypothesis>,
}

/// What came of a claim's trials.
#[derive(Default)]
pub(super) struct Tally {
    decided: u64,
    undecided: u64,
    worst: Option<(f64, String)>,
    /// The first case in which the claim does not hold, and what broke it off there.
    failure: Option<(Case<Exact>, Option<String>)>,
}

impl Tally {
    /// Takes in another, whose cases come later.
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
            Verdict::Broken(why) => {
                self.decided += 1;
                self.failure.get_or_insert_with(|| (case.clone(), Some(why)));
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

    pub(super) fn into_row(self, head: Head, scalar: Option<NumberSystem>) -> Row {
        let status = match (&self.failure, self.decided) {
            (Some(_), _) => Status::Failed,
            (None, 0) => Status::Undecided,
            (None, _) => Status::Held,
        };
        let (counterexample, why) = self.failure.unzip();
        Row {
            equation: head.equation,
            claim: head.claim,
            kind: head.kind,
            scalar,
            status,
            why: why.flatten(),
            decided: self.decided,
            undecided: self.undecided,
            worst: self.worst,
            counterexample,
        }
    }
}

/// What one case says of a claim; the bound is formatted only if it is the worst so far.
enum Verdict<'a> {
    Undecided,
    /// It does not hold, since it is not even defined or breaks off otherwise: why.
    Broken(String),
    Decided {
        holds: bool,
        measured: Option<(f64, Box<dyn Fn() -> String + 'a>)>,
    },
}

/// A number system in which claims are checked.
pub(super) trait Judge: Sync {
    /// The numbers of the claims.
    type Number: PositivePart;
    /// The numbers of the experiments.
    type Computed: Clone;

    /// Has it exponentials?
    const EXPONENTIALS: bool;
    /// A quotient, eˣ, ⟨·⟩ or min; none where there is none.
    fn step(step: Step<&Self::Number>) -> Option<Self::Number>;
    fn experiments(&self) -> Vec<Experiment<Self::Computed>>;

    /// A case in these numbers; none if one of its coordinates is out of range.
    fn read<'a>(&self, case: &'a Case<Exact>) -> Option<Cow<'a, Case<Self::Number>>>;
    /// The same as the experiments take it.
    fn computed<'a>(&self, case: &'a Case<Self::Number>) -> Cow<'a, Case<Self::Computed>>;

    /// left − right: does it contain 0, what share of its bound does it use up, and the bound.
    fn difference(&self, left: &Self::Number, right: &Self::Number) -> Option<(bool, f64, Self::Number)>;
    fn bound(&self, difference: &Self::Number) -> String;
    fn sign(&self, x: &Self::Number) -> Option<Ordering>;
}

/// Rationals, by `==`.
pub(super) struct Exactly;

impl Judge for Exactly {
    type Number = Exact;
    type Computed = Exact;
    const EXPONENTIALS: bool = false;
    fn step(step: Step<&Exact>) -> Option<Exact> {
        match step {
            Step::Div(a, b) => (!b.is_zero()).then(|| a / b),
            other => piecewise(other),
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

/// Floats, by balls; the number within says of which type and precision.
pub(super) struct Floats<T>(pub(super) T);

impl<T> Judge for Floats<T>
where
    T: Scalar + Real + Exponential + ToExact + std::fmt::Display + Sync,
{
    type Number = Ball<T>;
    type Computed = T;
    const EXPONENTIALS: bool = true;
    fn step(step: Step<&Ball<T>>) -> Option<Ball<T>> {
        match step {
            // By a ball that contains 0 the quotient is any number.
            Step::Div(a, b) => Some(a / b).filter(|quotient| !quotient.is_undefined()),
            other => everything(other),
        }
    }
    fn experiments(&self) -> Vec<Experiment<T>> {
        float_experiments()
    }
    fn read<'a>(&self, case: &'a Case<Exact>) -> Option<Cow<'a, Case<Ball<T>>>> {
        Case::try_of(|var| Ball::around(&self.0, case.get(var))).ok().map(Cow::Owned)
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
        if x.is_finite() { x.sign() } else { None }
    }
}

/// What share of its bound an error uses up, for a report only.
fn share<T: Scalar + ToExact>(error: &T, bound: &T) -> f64 {
    match (error.is_zero(), bound.is_zero()) {
        (true, _) => 0.0,
        (false, true) => f64::INFINITY,
        (false, false) => {
            (error / bound).to_exact().map_or(f64::INFINITY, |ratio| ratio.as_rational().to_f64())
        }
    }
}

/// The claims and experiments of a number system, with the types hidden.
pub(super) trait Checks: Sync {
    /// All of them, in order.
    fn heads(&self) -> Vec<Head>;

    /// Tries those with these hypotheses; each tally comes with its place among the heads.
    fn check(
        &self,
        given: &[Hypothesis],
        wanted: &dyn Fn(&str) -> bool,
        cases: &[Option<Case<Exact>>],
    ) -> Vec<(usize, Tally)>;
}

pub(super) struct Checker<J: Judge> {
    judge: J,
    /// In the order of the heads.
    claims: Vec<Statement>,
    groups: Vec<Group>,
    experiments: Vec<Experiment<J::Computed>>,
}

impl<J: Judge> Checker<J> {
    /// For the claims that can be asked in these numbers.
    pub(super) fn new<'a>(judge: J, claims: impl IntoIterator<Item = &'a Statement>) -> Self {
        let experiments = judge.experiments();
        Checker::with(judge, claims, experiments)
    }

    pub(super) fn with<'a>(
        judge: J,
        claims: impl IntoIterator<Item = &'a Statement>,
        experiments: Vec<Experiment<J::Computed>>,
    ) -> Self {
        // What is rounded is a matter of experiments.
        let can_be_asked = |claim: &&Statement| {
            !claim.contains_rounding() && (J::EXPONENTIALS || !claim.contains_exponential())
        };
        let claims: Vec<Statement> = claims.into_iter().filter(can_be_asked).cloned().collect();
        Checker { judge, groups: groups(&claims), claims, experiments }
    }
}

impl<J: Judge> Checks for Checker<J> {
    fn heads(&self) -> Vec<Head> {
        let claim = |c: &Statement| Head {
            equation: c.equation(),
            claim: c.name(),
            kind: c.kind(),
            given: c.stated_hypotheses().to_vec(),
        };
        let experiment = |e: &Experiment<J::Computed>| Head {
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
                let values = group.program.run(&|name| read.named(name), &J::step);
                for ((_, asked), (_, tally)) in claims.iter().zip(of_claims) {
                    tally.record(exact, self.verdict(asked, &values));
                }
            }
            if experiments.is_empty() {
                continue;
            }
            let computed = self.judge.computed(&read);
            for ((_, experiment), (_, tally)) in experiments.iter().zip(of_experiments) {
                let verdict = guarded(|| of_trial((experiment.check)(&computed)));
                tally.record(exact, verdict.unwrap_or_else(Verdict::Broken));
            }
        }
        tallies
    }
}

impl<J: Judge> Checker<J> {
    /// All that is asked together: what fails decides, else what is open leaves the case open. So does asking
    /// nothing, as of a derivative that does not exist.
    fn verdict<'a>(&'a self, asked: &[Asked], values: &[Option<J::Number>]) -> Verdict<'a>
    where
        J::Number: 'a,
    {
        let (mut open, mut holds) = (asked.is_empty(), true);
        let mut worst: Option<(f64, J::Number)> = None;
        for asked in asked {
            let answer = match asked {
                Asked::Equal(left, right) => {
                    values[*left].as_ref().zip(values[*right].as_ref()).map(|(left, right)| {
                        let (equal, ratio, difference) = self.judge.difference(left, right)?;
                        if worst.as_ref().is_none_or(|(r, _)| ratio > *r) {
                            worst = Some((ratio, difference));
                        }
                        Some(equal)
                    })
                }
                Asked::Sign(relation, x) => {
                    values[*x].as_ref().map(|x| self.judge.sign(x).map(|sign| relation.admits(sign)))
                }
            };
            match answer {
                None => return Verdict::Broken("division by zero".to_string()),
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
