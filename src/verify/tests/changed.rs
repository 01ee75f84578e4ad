//! Wrong formulas in process: numbers that err at one place of the source, as an edit there would make them.

use super::super::checker::Judge;
use super::super::*;
use crate::claims::{Claim, Experiment, all_claims, claims, formula, unilateral_claims};
use crate::number::tree::Site;
use crate::number::{Exponential, Field, PositivePart};
use crate::operators;
use crate::proof::controls::{self, Change, Operator, Outcome, What};
use num_traits::{One, Zero};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::panic::Location;

thread_local! {
    /// The change that is active on this thread.
    static ACTIVE: Cell<Option<Change>> = const { Cell::new(None) };
}

/// A number that remembers where it was made, so that the steps of a chain can be told apart.
#[derive(Clone, Debug)]
struct Changed<T> {
    value: T,
    site: Site,
}

impl<T: PartialEq> PartialEq for Changed<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// What is made here, and what the active change does to it.
#[track_caller]
fn here<T>(first: Option<&Changed<T>>, make: impl FnOnce(Option<What>) -> T) -> Changed<T> {
    let at = Location::caller();
    let mut site = Site { file: at.file(), line: at.line(), column: at.column(), rank: 0 };
    if let Some(first) = first.filter(|first| Site { rank: 0, ..first.site } == site) {
        site.rank = first.site.rank + 1;
    }
    let what = ACTIVE.get().filter(|change| change.site == site).map(|change| change.what);
    Changed { value: make(what), site }
}

#[track_caller]
fn binary<T: Field>(own: Operator, a: &Changed<T>, b: &Changed<T>) -> Changed<T> {
    here(Some(a), |what| {
        let (a, b) = (&a.value, &b.value);
        match (own, what) {
            (_, Some(What::First(_))) => a.clone(),
            (_, Some(What::Second(_))) => b.clone(),
            (Operator::Add, None) | (Operator::Sub, Some(What::Opposite(_))) => a + b,
            (Operator::Sub, None) | (Operator::Add, Some(What::Opposite(_))) => a - b,
            (Operator::Mul, None) | (Operator::Div, Some(What::Opposite(_))) => a * b,
            (Operator::Div, None) | (Operator::Mul, Some(What::Opposite(_))) => a / b,
            (Operator::Sub, Some(What::Swap(_))) => b - a,
            (Operator::Div, Some(What::Swap(_))) => b / a,
            (own, what) => panic!("{what:?} at {own:?}"),
        }
    })
}

operators! { #[track_caller] [T: Field] Changed<T>;
    Add add |a, b| binary(Operator::Add, a, b);
    Sub sub |a, b| binary(Operator::Sub, a, b);
    Mul mul |a, b| binary(Operator::Mul, a, b);
    Div div |a, b| binary(Operator::Div, a, b);
    - |a| here(Some(a), |what| if what.is_some() { a.value.clone() } else { -&a.value })
}

#[track_caller]
fn integer<T: Field>(n: i32) -> Changed<T> {
    here(None, |what| T::int(if what.is_some() { n + 1 } else { n }))
}

impl<T: Field> Zero for Changed<T> {
    #[track_caller]
    fn zero() -> Self {
        integer(0)
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
}
impl<T: Field> One for Changed<T> {
    #[track_caller]
    fn one() -> Self {
        integer(1)
    }
}
impl<T: Field> Field for Changed<T> {
    #[track_caller]
    fn int(n: i32) -> Self {
        integer(n)
    }
    fn is_unit(&self) -> bool {
        self.value.is_unit()
    }
}
impl<T: PositivePart> PositivePart for Changed<T> {
    #[track_caller]
    fn positive_part(&self) -> Self {
        here(Some(self), |what| if what.is_some() { self.value.clone() } else { self.value.positive_part() })
    }
    #[track_caller]
    fn min(&self, other: &Self) -> Self {
        let (a, b) = (&self.value, &other.value);
        here(Some(self), |what| match what {
            None => a.min(b),
            Some(What::First(_)) => a.clone(),
            Some(What::Second(_)) => b.clone(),
            Some(_) => -(-a).min(&-b),
        })
    }
}
impl<T: Exponential> Exponential for Changed<T> {
    #[track_caller]
    fn exp(&self) -> Self {
        here(Some(self), |what| if what.is_some() { (-&self.value).exp() } else { self.value.exp() })
    }
}

/// The judge of a number system, for numbers of it that err.
struct Erring<J>(J);

impl<J: Judge> Judge for Erring<J> {
    type Number = Changed<J::Number>;
    type Computed = J::Computed;
    fn claims(&self) -> Vec<Claim<Self::Number>> {
        Vec::new()
    }
    fn experiments(&self) -> Vec<Experiment<J::Computed>> {
        Vec::new()
    }
    fn read(&self, case: &Case<Exact>) -> Option<Case<Self::Number>> {
        Some(self.0.read(case)?.map(|_, x| here(None, |_| x.clone())))
    }
    fn computed(&self, case: &Case<Self::Number>) -> Case<J::Computed> {
        self.0.computed(&case.map(|_, x| x.value.clone()))
    }
    fn difference(&self, left: &Self::Number, right: &Self::Number) -> Option<(bool, f64, Self::Number)> {
        let (equal, share, difference) = self.0.difference(&left.value, &right.value)?;
        Some((equal, share, here(None, |_| difference)))
    }
    fn bound(&self, difference: &Self::Number) -> String {
        self.0.bound(&difference.value)
    }
    fn is_defined(&self, x: &Self::Number) -> bool {
        self.0.is_defined(&x.value)
    }
    fn sign(&self, x: &Self::Number) -> Option<std::cmp::Ordering> {
        self.0.sign(&x.value)
    }
}

/// Each change of a formula that can be made in numbers fails some claim, in rationals or in balls; none stops a
/// claim beside it. (A symbol that becomes another one is for the controls, which work on the records.)
#[test]
fn every_change_of_a_formula_is_a_finding() {
    const CASES: u64 = 4;
    let statements = statements();
    let exactly = || claims().into_iter().chain(unilateral_claims()).collect::<Vec<_>>();
    let checkers: [Box<dyn Checks>; 2] = [
        Box::new(Checker { judge: Erring(Exactly), claims: exactly(), experiments: Vec::new() }),
        Box::new(Checker { judge: Erring(Floats(0f64)), claims: all_claims(), experiments: Vec::new() }),
    ];
    let mut groups: BTreeMap<String, (&[Given], Vec<_>)> = BTreeMap::new();
    for given in checkers.iter().flat_map(|checker| checker.heads()).map(|head| head.given) {
        let drawn = || (0..CASES).map(|i| drawn(1, i, given)).collect();
        groups.entry(format!("{given:?}")).or_insert_with(|| (given, drawn()));
    }
    let findings = |change: Option<Change>| {
        ACTIVE.set(change);
        let touched = |equation: &str| {
            let mut own = statements.iter().filter(|s| s.equation == equation);
            change.is_none_or(|change| own.any(|s| change.apply(s).is_some()))
        };
        let mut found = Vec::new();
        for checker in &checkers {
            let heads = checker.heads();
            for (given, cases) in groups.values() {
                for (place, tally) in checker.check(given, &touched, cases) {
                    let row = tally.into_row(heads[place].clone(), None);
                    assert_eq!(row.decided + row.undecided, CASES);
                    found.extend((row.status == Status::Failed).then_some((
                        row.equation,
                        row.claim,
                        row.why,
                    )));
                }
            }
        }
        ACTIVE.set(None);
        found
    };
    assert_eq!(findings(None), []);
    let controls = controls::controls(&statements).changes;
    // Inside dual numbers these are not asked. What is known of the higher terms of (1.10) is their derivative.
    let series = &formula("penalty::series").unwrap().tree;
    let plain = |s: &Statement| !s.trees().any(|tree| tree.any(&|tree| tree.site().is_of_duals()));
    let numeric = |change: &Change| {
        let seen = |s: &Statement| s.kind != "derivative" && plain(s) && change.apply(s).is_some();
        let of_a_derivative = series.any(&|step| step.site() == change.site);
        !matches!(change.what, What::Symbol(..)) && !of_a_derivative && statements.iter().any(seen)
    };
    let (wrong, harmless): (Vec<_>, Vec<_>) = controls
        .into_iter()
        .filter(|(change, _)| numeric(change))
        .partition(|(_, outcome)| matches!(outcome, Outcome::Noticed { .. }));
    assert!(wrong.len() > 400, "{}", wrong.len());
    let unseen: Vec<_> =
        wrong.par_iter().filter(|(change, _)| findings(Some(*change)).is_empty()).map(|(c, _)| c).collect();
    let unseen: Vec<_> = unseen.iter().map(|change| change.to_string()).collect();
    assert!(unseen.is_empty(), "{unseen:#?}");
    for (change, _) in harmless {
        assert_eq!(findings(Some(change)), [], "{change}");
    }
}
