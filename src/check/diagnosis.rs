//! What is wrong with a solver: which known mistake its answers fit.

use super::Penalty;
use super::given::Given;
use super::mistakes::{Measured, Mistake, mistakes, none};
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart};
use num_traits::One;
use rug::float::Round;
use std::fmt;

/// How near an answer has to be to what a mistake computes, in parts of the system's scale and of what is
/// computed: as near as the tolerance asks for, and no nearer than this, so that the same mistakes can be
/// told apart whatever the tolerance.
const FIT: &str = "1e-6";

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
    let lag = lag(answers, tolerance);
    let wrong = Vec::from_iter(answers.iter().filter(|given| given.wrong));
    if wrong.is_empty() {
        return Vec::from_iter(lag);
    }
    let pulled = Penalty::measured(answers, Measured::ByEquilibrium, tolerance);
    let penalty_of = |mistake: &Mistake, given: &Given| {
        let told = given.answer.used.penalty.clone().flatten().or_else(|| given.problem.penalty.clone());
        told.or_else(|| match mistake.measured? {
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
        found.extend(all(&|given| given.is_single()).then(|| about("it computes in single precision")));
        if found.is_empty() {
            found.extend(few_digits(answers).or_else(|| factor(answers, tolerance)).map(|name| about(&name)));
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
    let unit = |decimals: usize| Exact::one() / ten_to(decimals);
    let near = |x: &Exact, exact: &Exact, unit: Exact| (x - exact).abs() <= unit;
    let has_decimals = |x: &Exact, decimals: usize| (x * ten_to(decimals)).as_rational().is_integer();
    let has_digits = |x: &Exact, digits: usize| x.decimal(digits, Round::Nearest).parse().as_ref() == Ok(x);
    let decimals = (0..FEW).find(|n| pairs.iter().all(|(x, _)| has_decimals(x, *n)));
    if let Some(n) = decimals.filter(|n| pairs.iter().all(|(x, exact)| near(x, exact, unit(*n)))) {
        return Some(format!("its numbers have no more than {n} decimals"));
    }
    let digits = (1..FEW).find(|n| pairs.iter().all(|(x, _)| has_digits(x, *n)))?;
    // A unit of the last digit is at most this part of the number.
    let part = unit(digits - 1);
    let all = pairs.iter().all(|(x, exact)| near(x, exact, &part * x.abs()));
    all.then(|| format!("its numbers have no more than {digits} digits"))
}

fn ten_to(n: usize) -> Exact {
    (0..n).fold(Exact::one(), |power, _| power * Exact::from(10))
}

/// u is the same multiple of what is right in all of them, or N is, or both are.
fn factor(answers: &[&Given], tolerance: &Exact) -> Option<String> {
    let factor = |which| {
        let all = answers.iter().filter_map(|given| given.factor(which, tolerance));
        let all = all.collect::<Option<Vec<_>>>()?;
        let (most, least) = (all.iter().max()?, all.iter().min()?);
        ((most - least).abs() <= tolerance * most.abs() && all.len() > 1).then(|| most.clone())
    };
    let [u, n] = [factor(0)?, factor(1)?];
    let is_right = |x: &Exact| (x - Exact::one()).abs() <= *tolerance;
    let times =
        |name: &str, x: &Exact| format!("{name} is {} times what is right", x.decimal(6, Round::Nearest));
    match (is_right(&u), is_right(&n)) {
        (true, true) => None,
        (false, true) => Some(times("u", &u)),
        (true, false) => Some(times("N", &n)),
        (false, false) => Some(format!("{}, {}", times("u", &u), times("N", &n))),
    }
}

/// How near an answer has to be.
fn fit(tolerance: &Exact) -> Exact {
    let least: Exact = FIT.parse().expect("a number");
    if *tolerance > least { tolerance.clone() } else { least }
}

/// The force reported is that of the step before.
fn lag(answers: &[Given], tolerance: &Exact) -> Option<Diagnosis> {
    let told = Vec::from_iter(answers.iter().filter_map(|given| given.lags(tolerance)));
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
