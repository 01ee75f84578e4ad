//! Diagnosis: known mistakes that explain the answers of a solver.

use super::Penalty;
use super::assessment::fit;
use super::mistakes::{
    Constants, Mistake, PenaltyEvidence, fitted, in_single, mistakes, reference, rounded_once,
    with_rounded_parameters,
};
use super::observation::{Observation, has_digits};
use super::problems::{DIGITS, decimal, short};
use crate::chapter::SpringMass;
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart, Tree};
use num_traits::{One, Zero};
use rug::float::Round;
use std::fmt;

/// Answers that a mistake explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DiagnosisScope {
    /// All answers.
    All,
    /// All wrong answers, but not all right ones.
    Wrong,
    /// All answers with steps.
    Steps,
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(DiagnosisScope);

/// Writes the name used in JSON.
impl fmt::Display for DiagnosisScope {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            DiagnosisScope::All => "all",
            DiagnosisScope::Wrong => "wrong",
            DiagnosisScope::Steps => "steps",
        })
    }
}

/// A mistake that explains the answers.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Diagnosis {
    /// Description of the mistake.
    pub name: String,
    /// Formulas of u and N with the mistake.
    pub formula: String,
    /// Edits of the chapter's source that cause it, if it is a single one.
    pub at: Vec<String>,
    /// Answers that it explains.
    pub answers: DiagnosisScope,
    /// Number of answers explained.
    pub explained: usize,
    /// Number of answers considered.
    pub of: usize,
}

/// Number of answers required to distinguish a mistake from the right formulas: one or two could differ by
/// chance, and one determines a constant.
const INFORMATIVE: usize = 3;

/// Largest number of wrong answers in which a constant is searched, evenly spaced: all of a default run,
/// since few of them may be informative.
const SAMPLES: usize = 200;

/// Returns every mistake that explains the answers, if some of them are wrong.
pub(super) fn diagnose(
    answers: &[Observation],
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
        search.known(DiagnosisScope::All, &all),
        search.rounded(&all),
        search.with_a_constant(&all, &wrong),
        search.factors(&all),
        search.known(DiagnosisScope::Wrong, &wrong),
    ];
    let found = found.into_iter().find(|found| !found.is_empty());
    steps.into_iter().chain(found.unwrap_or_default()).collect()
}

struct Search<'a> {
    answers: &'a [Observation<'a>],
    by_penalty: bool,
    shown: &'a Penalty,
    tolerance: &'a Exact,
    /// Largest distance of an answer from the value that explains it.
    fit: Exact,
}

impl Search<'_> {
    fn diagnosis(
        &self,
        which: DiagnosisScope,
        answers: &[&Observation],
        name: &str,
        formula: String,
    ) -> Diagnosis {
        Diagnosis {
            name: name.to_string(),
            formula,
            at: Vec::new(),
            answers: which,
            explained: answers.len(),
            of: answers.len(),
        }
    }

    fn explains(
        &self,
        mistake: &Mistake,
        factor: Option<&Exact>,
        given: &Observation,
        pulled: &Penalty,
    ) -> bool {
        let penalty = given.reported_penalty().or_else(|| match mistake.measured? {
            PenaltyEvidence::ByForce => self.shown.at(&given.problem.system),
            PenaltyEvidence::ByEquilibrium => pulled.at(&given.problem.system),
        });
        given.is_explained_by(mistake, &Constants { penalty: penalty.as_ref(), factor }, &self.fit)
    }

    /// Returns `true` if enough answers differ from the right ones by more than the fitting tolerance.
    /// Otherwise every mistake with a small effect would fit.
    fn is_informative(&self, answers: &[&Observation]) -> bool {
        let none = reference(self.by_penalty);
        let telling = answers.iter().filter(|given| !self.explains(&none, None, given, &Penalty::NONE));
        telling.take(INFORMATIVE).count() == INFORMATIVE
    }

    /// Returns the mistakes without an unknown constant except ε. A mutated formula affects all answers, so
    /// explaining only the wrong ones would be a coincidence.
    fn known(&self, which: DiagnosisScope, answers: &[&Observation]) -> Vec<Diagnosis> {
        if !self.is_informative(answers) {
            return Vec::new();
        }
        let pulled = Penalty::measured(self.answers, PenaltyEvidence::ByEquilibrium, &self.fit);
        let known = mistakes(self.by_penalty).iter();
        let known = known.filter(|mistake| which == DiagnosisScope::All || !mistake.is_edit());
        let known =
            known.filter(|mistake| answers.iter().all(|given| self.explains(mistake, None, given, &pulled)));
        let diagnosis = |known: &Mistake| Diagnosis {
            at: known.at.clone(),
            ..self.diagnosis(which, answers, &known.name, known.formula())
        };
        known.map(diagnosis).collect()
    }

    /// Returns the diagnoses of few digits and of single precision.
    fn rounded(&self, answers: &[&Observation]) -> Vec<Diagnosis> {
        let formula = || rounded_once(self.by_penalty).formula();
        let about = |name: &str, formula: String| self.diagnosis(DiagnosisScope::All, answers, name, formula);
        if answers.iter().all(|given| given.is_single()) {
            return vec![about("it computes in single precision", formula())];
        }
        if let Some(name) = few_digits(answers) {
            return vec![about(&name, formula())];
        }
        if let Some(name) = self.few_digits_of_parameters(answers) {
            return vec![about(&name, with_rounded_parameters(self.by_penalty).formula())];
        }
        let fits = |mistake: &&Mistake| {
            answers.iter().all(|given| given.is_explained_in_single(mistake, self.tolerance))
        };
        let fitting = in_single(self.by_penalty).iter().filter(fits);
        fitting.map(|mistake| about(&mistake.name, mistake.formula())).collect()
    }

    /// Returns the diagnosis of lengths with few decimals, or of parameters with few digits: rounded from the
    /// nearest float, like most programs do, or from the number itself, which may be a tie.
    fn few_digits_of_parameters(&self, answers: &[&Observation]) -> Option<String> {
        let fits = |change: &dyn Fn(&SpringMass<Exact>) -> SpringMass<Exact>| {
            answers
                .iter()
                .all(|given| given.is_explained_by_parameters(&change(&given.problem.system), self.tolerance))
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
            .map(|n| format!("it uses at most {n} decimals of l and H"))
            .or_else(|| Some(format!("it uses at most {} digits of its parameters", digits()?)))
    }

    /// Returns mistakes with a constant k, each with the first k that explains all answers.
    fn with_a_constant(&self, answers: &[&Observation], wrong: &[&Observation]) -> Vec<Diagnosis> {
        if !self.is_informative(answers) {
            return Vec::new();
        }
        let found = fitted(self.by_penalty).iter().filter_map(|mistake| {
            let step = wrong.len().div_ceil(SAMPLES);
            let samples = wrong.iter().step_by(step);
            let estimates = samples
                .flat_map(|given| mistake.estimates.iter().filter_map(|estimate| given.factor_of(estimate)));
            let fits = |k: &Exact| {
                answers.iter().all(|given| self.explains(mistake, Some(k), given, &Penalty::NONE))
            };
            let is_possible =
                |k: &Exact| !k.is_zero() && (!mistake.is_share || *k > Exact::zero() && *k < Exact::from(2));
            let k = estimates.filter(is_possible).find(fits)?;
            let spelled = k.decimal(6, Round::Nearest);
            let name = mistake.name.replace("{k}", &spelled);
            Some(self.diagnosis(
                DiagnosisScope::All,
                answers,
                &name,
                format!("{}, k = {spelled}", mistake.formula()),
            ))
        });
        found.collect()
    }

    /// Returns the diagnosis of u and N being constant multiples of the right ones.
    fn factors(&self, answers: &[&Observation]) -> Vec<Diagnosis> {
        let Some(factors) = factors(answers) else { return Vec::new() };
        let [u, n] = reference(self.by_penalty).in_contact;
        let times = |symbol: &'static str, x: &Exact, tree: Tree| {
            if *x == Exact::one() { tree } else { Tree::symbol(symbol) * tree }
        };
        let formulas = [times("k", &factors[0], u), times("k′", &factors[1], n)];
        let said = [("u", "k", &factors[0]), ("N", "k′", &factors[1])];
        let said = said.into_iter().filter(|(_, _, factor)| **factor != Exact::one());
        let (names, constants): (Vec<_>, Vec<_>) = said
            .map(|(name, symbol, factor)| {
                let factor = factor.decimal(6, Round::Nearest);
                (format!("{name} is {factor} times the right value"), format!("{symbol} = {factor}"))
            })
            .unzip();
        let formula = format!("{}, {}", Mistake::new("factors", formulas).formula(), constants.join(", "));
        vec![self.diagnosis(DiagnosisScope::All, answers, &names.join(", "), formula)]
    }
}

/// Largest number of digits or decimals that counts as few.
const FEW: usize = 9;

/// Returns the diagnosis of right numbers written with few digits or decimals.
fn few_digits(answers: &[&Observation]) -> Option<String> {
    let pairs = answers.iter().flat_map(|given| given.numbers().into_iter().zip(given.exact));
    let pairs = pairs.map(|(number, exact)| Some((number.as_ref()?, exact))).collect::<Option<Vec<_>>>()?;
    // Rounded to nearest; a previous rounding to f64 rarely matters.
    let near = |x: &Exact, exact: &Exact, unit: Exact| {
        Exact::from(100) * (x - exact).abs() <= Exact::from(51) * unit
    };
    let has_decimals = |x: &Exact, decimals: i32| (x * decimal(1, decimals)).as_rational().is_integer();
    let decimals = (0..FEW as i32).find(|n| pairs.iter().all(|(x, _)| has_decimals(x, *n)));
    if let Some(n) = decimals.filter(|n| pairs.iter().all(|(x, exact)| near(x, exact, decimal(1, -n)))) {
        return Some(format!("its numbers have at most {n} decimals"));
    }
    let digits = (1..FEW).find(|n| pairs.iter().all(|(x, _)| has_digits(x, *n)))?;
    // One unit of the last digit is at most this fraction of the number.
    let part = decimal(1, 1 - digits as i32);
    let all = pairs.iter().all(|(x, exact)| near(x, exact, &part * x.abs()));
    all.then(|| format!("its numbers have at most {digits} digits"))
}

/// Returns the factors of u and N relative to the right ones, if they agree in all informative answers; not
/// both 1.
fn factors(answers: &[&Observation]) -> Option<[Exact; 2]> {
    // Largest relative difference of equal factors, and smallest of a factor from 1.
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

/// Returns the diagnosis of a reported force that is the one of the previous step.
fn lag(answers: &[Observation]) -> Option<Diagnosis> {
    let lags = Vec::from_iter(answers.iter().filter_map(|given| given.lags));
    let fits = lags.iter().filter(|lagging| **lagging).count();
    (fits > 0 && fits == lags.len()).then(|| Diagnosis {
        name: "N is one step behind".to_string(),
        formula: registry().render_template("N_k = «augmented::contact_force: u=u_{k−1}»", Notation::Text),
        at: Vec::new(),
        answers: DiagnosisScope::Steps,
        explained: fits,
        of: lags.len(),
    })
}
