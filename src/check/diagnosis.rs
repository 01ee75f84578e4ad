//! What is wrong with a solver: which known mistake its answers fit.

use super::Penalty;
use super::given::{Given, has_digits};
use super::judge::fit;
use super::mistakes::{Measured, Mistake, mistakes, none};
use super::problems::decimal;
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};
use rug::float::Round;
use std::fmt;

/// Which answers a mistake explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answers {
    /// All of them.
    All,
    /// All that are wrong, and not all that are right.
    Wrong,
    /// All whose steps are told.
    Steps,
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Answers);

/// As JSON has it.
impl fmt::Display for Answers {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Answers::All => "all",
            Answers::Wrong => "wrong",
            Answers::Steps => "steps",
        })
    }
}

/// A mistake that explains the answers.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Diagnosis {
    /// What is wrong.
    pub name: String,
    /// u and N as such a program computes them.
    pub formula: String,
    /// Where in the chapter's source that is one edit, and which one.
    pub at: Vec<String>,
    /// Which answers it explains.
    pub answers: Answers,
    /// How many answers fit.
    pub fits: usize,
    /// Of how many.
    pub of: usize,
}

/// Every mistake that explains the answers, if some of them are wrong.
pub(super) fn diagnose(
    answers: &[Given],
    by_penalty: bool,
    shown: &Penalty,
    tolerance: &Exact,
) -> Vec<Diagnosis> {
    let tolerance = &fit(tolerance);
    let lag = lag(answers);
    let wrong = Vec::from_iter(answers.iter().filter(|given| given.wrong));
    if wrong.is_empty() {
        return Vec::from_iter(lag);
    }
    let pulled = Penalty::measured(answers, Measured::ByEquilibrium, tolerance);
    let penalty_of = |mistake: &Mistake, given: &Given| {
        given.told().or_else(|| match mistake.measured? {
            Measured::ByForce => shown.at(&given.problem.system),
            Measured::ByEquilibrium => pulled.at(&given.problem.system),
        })
    };
    let fits = |mistake: &Mistake, given: &Given| {
        given.fits(mistake, penalty_of(mistake, given).as_ref(), tolerance)
    };
    let none = none(by_penalty);
    let explaining = |which: Answers, answers: &[&Given]| {
        let all = |holds: &dyn Fn(&Given) -> bool| answers.iter().all(|given| holds(given));
        let diagnosis = |name: &str, formula: String, at: &[String]| Diagnosis {
            name: name.to_string(),
            formula,
            at: at.to_vec(),
            answers: which,
            fits: answers.len(),
            of: answers.len(),
        };
        let about = |name: &str| diagnosis(name, none.formula(), &[]);
        let mut found = Vec::new();
        // Where they are so little off, every mistake that hardly shows would fit.
        if !all(&|given| fits(&none, given)) {
            let known = mistakes(by_penalty).iter().filter(|mistake| all(&|given| fits(mistake, given)));
            found.extend(known.map(|known| diagnosis(&known.name, known.formula(), &known.at)));
        }
        // One answer alone could be off by anything.
        if found.is_empty() && answers.len() > 1 {
            let single = || all(&|given| given.is_single()).then(|| "it computes in single precision".into());
            let name = few_digits(answers).or_else(single).or_else(|| factor(answers));
            found.extend(name.map(|name| about(&name)));
        }
        found
    };
    let mut found = explaining(Answers::All, &answers.iter().collect::<Vec<_>>());
    if found.is_empty() {
        found = explaining(Answers::Wrong, &wrong);
    }
    lag.into_iter().chain(found).collect()
}

/// Digits, or decimals, that numbers may have for this to be why they are off.
const FEW: usize = 9;

/// All numbers are what is right, written with few digits or decimals.
fn few_digits(answers: &[&Given]) -> Option<String> {
    let pairs = answers.iter().flat_map(|given| given.numbers().into_iter().zip(given.exact));
    let pairs = pairs.map(|(number, exact)| Some((number.as_ref()?, exact))).collect::<Option<Vec<_>>>()?;
    // Rounded to nearest; that it has been rounded before, to f64, moves hardly any of them further.
    let near = |x: &Exact, exact: &Exact, unit: Exact| {
        Exact::from(100) * (x - exact).abs() <= Exact::from(51) * unit
    };
    let has_decimals = |x: &Exact, decimals: i32| (x * decimal(1, decimals)).as_rational().is_integer();
    let decimals = (0..FEW as i32).find(|n| pairs.iter().all(|(x, _)| has_decimals(x, *n)));
    if let Some(n) = decimals.filter(|n| pairs.iter().all(|(x, exact)| near(x, exact, decimal(1, -n)))) {
        return Some(format!("its numbers have no more than {n} decimals"));
    }
    let digits = (1..FEW).find(|n| pairs.iter().all(|(x, _)| has_digits(x, *n)))?;
    // A unit of the last digit is at most this part of the number.
    let part = decimal(1, 1 - digits as i32);
    let all = pairs.iter().all(|(x, exact)| near(x, exact, &part * x.abs()));
    all.then(|| format!("its numbers have no more than {digits} digits"))
}

/// u is the same multiple of what is right in all of them, or N is, or both are.
fn factor(answers: &[&Given]) -> Option<String> {
    // How nearly the same factors have to be, and how far from 1 to be one.
    let alike = decimal(1, -5);
    let factor = |which| {
        let all = answers.iter().filter_map(|given| given.factor(which, &alike));
        let all = all.collect::<Option<Vec<_>>>()?;
        let (most, least) = (all.iter().max()?, all.iter().min()?);
        ((most - least).abs() <= &alike * most.abs() && all.len() > 1).then(|| most.clone())
    };
    let times = |name: &str, x: &Exact| {
        if (x - Exact::one()).abs() <= alike {
            None
        } else if x.is_zero() {
            Some(format!("{name} is always 0"))
        } else {
            Some(format!("{name} is {} times what is right", x.decimal(6, Round::Nearest)))
        }
    };
    let found: Vec<_> = [times("u", &factor(0)?), times("N", &factor(1)?)].into_iter().flatten().collect();
    (!found.is_empty()).then(|| found.join(", "))
}

/// The force reported is that of the step before.
fn lag(answers: &[Given]) -> Option<Diagnosis> {
    let told = Vec::from_iter(answers.iter().filter_map(|given| given.lags));
    let fits = told.iter().filter(|lags| **lags).count();
    (fits > 0 && fits == told.len()).then(|| Diagnosis {
        name: "N is one step behind".to_string(),
        formula: registry().fill("N_k = «augmented::contact_force: u=u_{k−1}»", Notation::Text),
        at: Vec::new(),
        answers: Answers::Steps,
        fits,
        of: told.len(),
    })
}
