//! What is wrong with a solver: which known mistake its answers fit.

use super::Penalty;
use super::given::{Given, has_digits};
use super::judge::fit;
use super::mistakes::{
    Constants, Measured, Mistake, fitted, in_single, mistakes, none, rounded_once, with_rounded_parameters,
};
use super::problems::{DIGITS, decimal, short};
use crate::chapter::SpringMass;
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart, Tree};
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

/// Answers that tell a mistake from what is right have to be so many: one or two could be off by anything,
/// and a constant takes one of them to be found.
const INFORMATIVE: usize = 3;

/// Wrong answers that a constant is looked for in, evenly spread: all of them in a run by default, since
/// where few systems are in contact for a wrong program, few tell.
const SAMPLES: usize = 200;

/// Every mistake that explains the answers, if some of them are wrong.
pub(super) fn diagnose(
    answers: &[Given],
    by_penalty: bool,
    shown: &Penalty,
    tolerance: &Exact,
) -> Vec<Diagnosis> {
    let steps = Vec::from_iter(lag(answers));
    let search = Search { answers, by_penalty, shown, tolerance, fit: fit(tolerance) };
    let wrong = Vec::from_iter(answers.iter().filter(|given| given.wrong));
    if wrong.len() < INFORMATIVE {
        return steps;
    }
    let all = Vec::from_iter(answers);
    let found = [
        search.known(Answers::All, &all),
        search.rounded(&all),
        search.with_a_constant(&all, &wrong),
        search.factors(&all),
        search.known(Answers::Wrong, &wrong),
    ];
    let found = found.into_iter().find(|found| !found.is_empty());
    steps.into_iter().chain(found.unwrap_or_default()).collect()
}

struct Search<'a> {
    answers: &'a [Given<'a>],
    by_penalty: bool,
    shown: &'a Penalty,
    tolerance: &'a Exact,
    /// How near an answer has to be to what a mistake makes of it.
    fit: Exact,
}

impl Search<'_> {
    fn diagnosis(&self, which: Answers, answers: &[&Given], name: &str, formula: String) -> Diagnosis {
        Diagnosis {
            name: name.to_string(),
            formula,
            at: Vec::new(),
            answers: which,
            fits: answers.len(),
            of: answers.len(),
        }
    }

    fn fits(&self, mistake: &Mistake, factor: Option<&Exact>, given: &Given, pulled: &Penalty) -> bool {
        let penalty = given.told().or_else(|| match mistake.measured? {
            Measured::ByForce => self.shown.at(&given.problem.system),
            Measured::ByEquilibrium => pulled.at(&given.problem.system),
        });
        given.fits(mistake, &Constants { penalty: penalty.as_ref(), factor }, &self.fit)
    }

    /// Are there enough answers that differ from what is right by more than what a mistake has to fit to?
    /// Where they are so little off, every mistake that hardly shows would fit.
    fn is_informative(&self, answers: &[&Given]) -> bool {
        let none = none(self.by_penalty);
        let telling = answers.iter().filter(|given| !self.fits(&none, None, given, &Penalty::NONE));
        telling.take(INFORMATIVE).count() == INFORMATIVE
    }

    /// Mistakes without an unknown constant but ε. An edit of a formula shows in all answers; that it
    /// explains the wrong ones alone is chance.
    fn known(&self, which: Answers, answers: &[&Given]) -> Vec<Diagnosis> {
        if !self.is_informative(answers) {
            return Vec::new();
        }
        let pulled = Penalty::measured(self.answers, Measured::ByEquilibrium, &self.fit);
        let known = mistakes(self.by_penalty).iter();
        let known = known.filter(|mistake| which == Answers::All || !mistake.is_edit());
        let known =
            known.filter(|mistake| answers.iter().all(|given| self.fits(mistake, None, given, &pulled)));
        let diagnosis = |known: &Mistake| Diagnosis {
            at: known.at.clone(),
            ..self.diagnosis(which, answers, &known.name, known.formula())
        };
        known.map(diagnosis).collect()
    }

    /// Few digits, or single precision.
    fn rounded(&self, answers: &[&Given]) -> Vec<Diagnosis> {
        let formula = || rounded_once(self.by_penalty).formula();
        let about = |name: &str, formula: String| self.diagnosis(Answers::All, answers, name, formula);
        if answers.iter().all(|given| given.is_single()) {
            return vec![about("it computes in single precision", formula())];
        }
        if let Some(name) = few_digits(answers) {
            return vec![about(&name, formula())];
        }
        if let Some(name) = self.few_digits_of_parameters(answers) {
            return vec![about(&name, with_rounded_parameters(self.by_penalty).formula())];
        }
        let fits =
            |mistake: &&Mistake| answers.iter().all(|given| given.fits_in_single(mistake, self.tolerance));
        let fitting = in_single(self.by_penalty).iter().filter(fits);
        fitting.map(|mistake| about(&mistake.name, mistake.formula())).collect()
    }

    /// What is right of lengths with few decimals, or of parameters with few digits: of the float nearest to
    /// a number, as most programs round, or of the number itself, which may be halfway between two.
    fn few_digits_of_parameters(&self, answers: &[&Given]) -> Option<String> {
        let fits = |change: &dyn Fn(&SpringMass<Exact>) -> SpringMass<Exact>| {
            answers.iter().all(|given| given.fits_parameters(&change(&given.problem.system), self.tolerance))
        };
        let read = |text: String| text.parse().expect("a decimal");
        let float = |x: &Exact| x.to_f64().unwrap_or_default();
        let lengths = |system: &SpringMass<Exact>, shorten: &dyn Fn(&Exact) -> Exact| SpringMass {
            l: shorten(&system.l),
            h: shorten(&system.h),
            ..system.clone()
        };
        let decimals = (0..DIGITS).find(|decimals| {
            fits(&|system| lengths(system, &|x| read(format!("{:.decimals$}", float(x)))))
                || fits(&|system| lengths(system, &|x| read(format!("{x:.decimals$}"))))
        });
        let digits = || {
            (1..DIGITS).find(|digits| {
                fits(&|system| system.map(|x| read(format!("{:.*e}", digits - 1, float(x)))))
                    || fits(&|system| system.map(|x| short(x, *digits)))
            })
        };
        decimals
            .map(|n| format!("it takes no more than {n} decimals of l and H"))
            .or_else(|| Some(format!("it takes no more than {} digits of its parameters", digits()?)))
    }

    /// Mistakes with a constant k, each with the first that all answers fit.
    fn with_a_constant(&self, answers: &[&Given], wrong: &[&Given]) -> Vec<Diagnosis> {
        if !self.is_informative(answers) {
            return Vec::new();
        }
        let found = fitted(self.by_penalty).iter().filter_map(|mistake| {
            let step = wrong.len().div_ceil(SAMPLES);
            let samples = wrong.iter().step_by(step);
            let estimates = samples
                .flat_map(|given| mistake.estimates.iter().filter_map(|estimate| given.factor_of(estimate)));
            let fits =
                |k: &Exact| answers.iter().all(|given| self.fits(mistake, Some(k), given, &Penalty::NONE));
            let is_possible =
                |k: &Exact| !k.is_zero() && (!mistake.is_share || *k > Exact::zero() && *k < Exact::from(2));
            let k = estimates.filter(is_possible).find(fits)?;
            let spelled = k.decimal(6, Round::Nearest);
            let name = mistake.name.replace("{k}", &spelled);
            Some(self.diagnosis(
                Answers::All,
                answers,
                &name,
                format!("{}, k = {spelled}", mistake.formula()),
            ))
        });
        found.collect()
    }

    /// u and N, each a multiple of what is right.
    fn factors(&self, answers: &[&Given]) -> Vec<Diagnosis> {
        if !self.is_informative(answers) {
            return Vec::new();
        }
        let Some(factors) = factors(answers) else { return Vec::new() };
        let [u, n] = none(self.by_penalty).touching;
        let times = |symbol: &'static str, x: &Exact, tree: Tree| match x {
            x if x.is_zero() => Tree::from(0),
            x if *x == Exact::one() => tree,
            _ => Tree::symbol(symbol) * tree,
        };
        let formulas = [times("k", &factors[0], u), times("k′", &factors[1], n)];
        let said = [("u", "k", &factors[0]), ("N", "k′", &factors[1])];
        let said = said.into_iter().filter(|(_, _, factor)| **factor != Exact::one());
        let (names, constants): (Vec<_>, Vec<_>) = said
            .map(|(name, symbol, factor)| {
                let factor = factor.decimal(6, Round::Nearest);
                (format!("{name} is {factor} times what is right"), format!("{symbol} = {factor}"))
            })
            .unzip();
        let formula = format!("{}, {}", Mistake::new("factors", formulas).formula(), constants.join(", "));
        vec![self.diagnosis(Answers::All, answers, &names.join(", "), formula)]
    }
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

/// By which u and N are multiples of what is right, the same in all answers that tell it; not both 1.
fn factors(answers: &[&Given]) -> Option<[Exact; 2]> {
    // How nearly the same factors have to be, and how far from 1 to be one.
    let alike = decimal(1, -5);
    let factor = |which| {
        let all = answers.iter().filter_map(|given| given.factor(which, &alike));
        let all = all.collect::<Option<Vec<_>>>()?;
        let (most, least) = (all.iter().max()?, all.iter().min()?);
        let is_one = (most - Exact::one()).abs() <= alike;
        ((most - least).abs() <= &alike * most.abs() && all.len() >= INFORMATIVE)
            .then(|| if is_one { Exact::one() } else { most.clone() })
    };
    let factors = [factor(0)?, factor(1)?];
    factors.iter().any(|factor| *factor != Exact::one()).then_some(factors)
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
