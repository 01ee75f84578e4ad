//! Diagnosis: the one edit, the one number or the one rounding that explains the answers of a solver.

use super::CASES;
use super::assessment::fit;
use super::observation::{Observation, has_digits};
use super::problems::{DIGITS, Family, Problem, decimal, problems, short};
use super::program::{Constants, Mistake, edits, in_some_answers, numbers, reference, value};
use crate::chapter::{SpringMass, contact, system};
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::float::Round;
use std::fmt;
use std::sync::LazyLock;

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
    /// Descriptions of mistakes in other parameters with the same results.
    pub equivalent: Vec<String>,
    /// The lines of a program with the mistake.
    pub program: Vec<String>,
    /// Answers that it explains.
    pub answers: DiagnosisScope,
    /// Number of answers explained.
    pub explained: usize,
    /// Number of answers considered.
    pub of: usize,
}

/// Number of answers required to distinguish a mistake from the right formulas: one or two could differ by
/// chance, and one determines a number.
pub(super) const INFORMATIVE: usize = 3;

/// Number of wrong answers from which an unknown number is computed, with errors of all sizes.
const SAMPLES: usize = 40;

/// A search for what explains answers.
pub(super) struct Search<'a> {
    by_penalty: bool,
    tolerance: &'a Exact,
    /// Largest distance of an answer from the value that explains it.
    fit: Exact,
}

/// An explanation, and the answers that a program with it would give.
pub(super) struct Explanation {
    pub diagnosis: Diagnosis,
    cause: Cause,
}

impl Explanation {
    /// Returns `true` if the program is right except for its decision between the two states.
    pub fn is_decision(&self) -> bool {
        matches!(&self.cause, Cause::Mistake(mistake, _) if mistake.is_decision)
    }
}

/// A reason for wrong answers.
enum Cause {
    /// A program, and its number if it has one.
    Mistake(Box<Mistake>, Option<Exact>),
    /// Differences of u and N from the right ones.
    Outputs([Difference; 2]),
    /// Another one, which explains all answers.
    Other,
}

impl<'a> Search<'a> {
    pub fn new(by_penalty: bool, tolerance: &'a Exact) -> Self {
        Search { by_penalty, tolerance, fit: fit(tolerance) }
    }

    /// Returns every mistake that explains all answers.
    pub fn of_all(&self, answers: &[&Observation]) -> Vec<Explanation> {
        if !self.is_informative(answers) {
            return self.roundings(answers);
        }
        let searches = [Search::edits, Search::roundings, Search::outputs, Search::numbers, Search::curves];
        let found = searches.into_iter().map(|search| search(self, answers));
        found.into_iter().find(|found| !found.is_empty()).unwrap_or_default()
    }

    /// Returns every mistake that explains the wrong answers alone.
    ///
    /// A changed formula affects all answers, so explaining only some would be a coincidence; a changed
    /// decision, or result, does not.
    pub fn of_wrong(&self, wrong: &[&Observation]) -> Vec<Explanation> {
        if !self.is_informative(wrong) {
            return Vec::new();
        }
        let found = self.distinct(wrong, self.fitting(&in_some_answers(self.by_penalty), wrong));
        if found.is_empty() { self.outputs(wrong) } else { found }
    }

    /// Returns `true` if an answer may also be right for the reason of wrong ones, so that it tells nothing.
    pub fn may_cause(&self, found: &Explanation, given: &Observation) -> bool {
        match &found.cause {
            Cause::Mistake(mistake, k) => self.explains(mistake, k.as_ref(), given),
            Cause::Outputs(both) => {
                let numbers = given.numbers();
                (0..2).all(|i| {
                    numbers[i].as_ref().is_some_and(|own| both[i].explains(i, given, own, &self.fit))
                })
            }
            Cause::Other => false,
        }
    }

    /// Returns `true` if enough answers differ from the right ones by more than the fitting tolerance.
    /// Otherwise every mistake with a small effect would fit.
    fn is_informative(&self, answers: &[&Observation]) -> bool {
        let none = reference(self.by_penalty).results();
        let is_telling = |given: &&&Observation| given.is_explained_by(&none, None, &self.fit) == Some(false);
        answers.iter().filter(is_telling).take(INFORMATIVE).count() == INFORMATIVE
    }

    /// Returns `true` if the mistake may give this answer.
    pub fn explains(&self, mistake: &Mistake, k: Option<&Exact>, given: &Observation) -> bool {
        given.is_explained_by(&mistake.results, k, &self.fit) != Some(false)
    }

    /// Returns `true` if the mistake explains all answers, and most wrong ones not only by rounding errors.
    fn explains_all(&self, mistake: &Mistake, k: Option<&Exact>, answers: &[&Observation]) -> bool {
        let is_clear =
            |given: &&&Observation| given.is_explained_by(&mistake.results, k, &self.fit) == Some(true);
        let wrong = || answers.iter().filter(|given| given.wrong);
        let is_possible = answers.iter().all(|given| self.explains(mistake, k, given));
        is_possible && 2 * wrong().filter(is_clear).count() >= wrong().count().max(2 * INFORMATIVE)
    }

    fn explanation(&self, answers: &[&Observation], name: String, program: Vec<String>) -> Explanation {
        let (answers, count) = (DiagnosisScope::All, answers.len());
        let equivalent = Vec::new();
        let diagnosis = Diagnosis { name, equivalent, program, answers, explained: count, of: count };
        Explanation { diagnosis, cause: Cause::Other }
    }

    fn edits(&self, answers: &[&Observation]) -> Vec<Explanation> {
        static EDITS: [LazyLock<Vec<Mistake>>; 2] =
            [LazyLock::new(|| edits(false)), LazyLock::new(|| edits(true))];
        self.distinct(answers, self.fitting(&EDITS[usize::from(self.by_penalty)], answers))
    }

    /// Returns the mistakes that explain the answers.
    fn fitting<'m>(&self, all: &'m [Mistake], answers: &[&Observation]) -> Vec<(&'m Mistake, Option<Exact>)> {
        let fitting = all.iter().filter(|mistake| self.explains_all(mistake, None, answers));
        fitting.map(|mistake| (mistake, None)).collect()
    }

    /// Returns the explanations by mistakes with their numbers: one for all that have the same results.
    fn distinct<'m>(
        &self,
        answers: &[&Observation],
        fitting: impl IntoIterator<Item = (&'m Mistake, Option<Exact>)>,
    ) -> Vec<Explanation> {
        let mut found: Vec<(Vec<[Option<Exact>; 2]>, Explanation)> = Vec::new();
        for (mistake, k) in fitting {
            let values = values(mistake, k.as_ref());
            let digits = |k: &Exact| k.decimal(6, Round::Nearest);
            let filled =
                |text: &str| k.as_ref().map_or(text.to_string(), |k| text.replace("{k}", &digits(k)));
            let name = filled(&mistake.name);
            if let Some((_, same)) = found.iter_mut().find(|(known, _)| *known == values) {
                let is_known = same.diagnosis.name == name || same.diagnosis.equivalent.contains(&name);
                if mistake.is_parameter && !is_known {
                    same.diagnosis.equivalent.push(name);
                }
                continue;
            }
            // The formulas of many steps are long.
            let mut lines =
                if mistake.augmentations.is_some() { Vec::new() } else { mistake.program.lines() };
            lines.extend(k.as_ref().map(|k| format!("k = {}", digits(k))));
            let explanation = self.explanation(answers, name, lines);
            let cause = Cause::Mistake(mistake.clone().into(), k);
            found.push((values, Explanation { cause, ..explanation }));
        }
        found.into_iter().map(|(_, explanation)| explanation).collect()
    }

    /// Returns the mistakes with a number k that explains all answers, and that three of them determine.
    fn numbers(&self, answers: &[&Observation]) -> Vec<Explanation> {
        static NUMBERS: [LazyLock<Vec<Mistake>>; 2] =
            [LazyLock::new(|| numbers(false)), LazyLock::new(|| numbers(true))];
        let mut wrong: Vec<_> = answers.iter().copied().filter(|given| given.wrong).collect();
        wrong.sort_by(|a, b| b.error().cmp(&a.error()));
        let fitting = NUMBERS[usize::from(self.by_penalty)].iter().filter_map(|mistake| {
            let step = wrong.len().div_ceil(SAMPLES).max(1);
            let samples = wrong.iter().step_by(step).flat_map(|given| estimates(mistake, given));
            let mut samples = samples.filter(|k| !k.is_zero());
            let k = samples.find(|k| self.explains_all(mistake, Some(k), answers))?;
            let agrees =
                |given: &&&Observation| estimates(mistake, given).iter().any(|own| is_close(own, &k));
            let count = wrong.iter().filter(agrees).take(INFORMATIVE).count();
            (count == INFORMATIVE).then_some((mistake, Some(k)))
        });
        self.distinct(answers, fitting)
    }

    /// Returns the explanation by a contact law without a corner: N (N − R) is a positive number k in all answers, or
    /// k c, and they are in equilibrium.
    fn curves(&self, answers: &[&Observation]) -> Vec<Explanation> {
        let smoothed = self.curve(answers, |_| Exact::one());
        let barrier = self.curve(answers, |system| system.c.clone());
        let explain = |name: &str, k: Exact, unit: &str| {
            let k = k.decimal(6, Round::Nearest);
            self.explanation(answers, name.to_string(), vec![format!("k = {k} {unit}")])
        };
        let smoothed = smoothed.map(|k| explain("a smoothed corner, N = (R + √(R² + 4 k))/2", k, "N²"));
        smoothed
            .or_else(|| Some(explain("a barrier, N = k/(H − l − u)", barrier?, "J")))
            .into_iter()
            .collect()
    }

    /// Returns N (N − R)/unit if it is the same positive number in all answers, and clear in several.
    fn curve(&self, answers: &[&Observation], unit: fn(&SpringMass<Exact>) -> Exact) -> Option<Exact> {
        let values = answers.iter().map(|given| {
            let (product, error) = self.of_curve(given)?;
            let unit = unit(&given.problem.system);
            Some((product / &unit, error / unit))
        });
        let values: Vec<_> = values.collect::<Option<_>>()?;
        let positive = values.iter().filter(|(k, _)| *k > Exact::zero());
        // The most accurate one.
        let (k, _) = positive.min_by(|(a, e), (b, f)| (e * b).cmp(&(f * a)))?;
        let is_same = values.iter().all(|(own, error)| (own - k).abs() <= *error);
        let clear = values.iter().filter(|(_, error)| Exact::from(100) * error <= *k);
        (is_same && clear.take(INFORMATIVE).count() == INFORMATIVE).then(|| k.clone())
    }

    /// Returns N (N − R) with its error; `None` without equilibrium.
    fn of_curve(&self, given: &Observation) -> Option<(Exact, Exact)> {
        let system = &given.problem.system;
        let [Some(u), Some(n)] = given.numbers() else { return None };
        let off = &self.fit * &given.scales[1] + n.abs() * Exact::power_of_two(-50);
        let rest = n - system::reaction(system);
        let error = (n.abs() + rest.abs() + &off) * &off;
        (contact::equilibrium(system, u, n).abs() <= off).then(|| (n * rest, error))
    }

    /// Returns the explanations by single precision, or by few digits or decimals.
    fn roundings(&self, answers: &[&Observation]) -> Vec<Explanation> {
        let is_wrong = answers.iter().any(|given| given.wrong);
        if !is_wrong || answers.iter().filter(|given| !given.right).count() < INFORMATIVE {
            return Vec::new();
        }
        let is_single = || answers.iter().all(|given| given.is_single());
        let single = || is_single().then(|| "it computes in single precision".to_string());
        // Preferably of the same kind for u and N.
        let either = |i: usize, pairs: &[Pair]| few_decimals(i, pairs).or_else(|| few_digits(i, pairs));
        let few = [few_decimals, few_digits].into_iter().find_map(|find| self.differences(answers, find));
        let few = few.or_else(|| self.differences(answers, either));
        let found =
            few.map(|both| described(&both)).or_else(single).or_else(|| self.rounded_parameters(answers));
        found.map(|name| self.explanation(answers, name, Vec::new())).into_iter().collect()
    }

    /// Returns the explanation by parameters of less precision.
    fn rounded_parameters(&self, answers: &[&Observation]) -> Option<String> {
        // Of the number itself, or of the nearest float.
        let roundings: [fn(Rounding, &Exact) -> Option<Exact>; 2] = [Rounding::of, Rounding::of_float];
        let is_given = |given: &Observation, which: &[&str], round: &dyn Fn(&Exact) -> Option<Exact>| {
            let system = with_rounded(&given.problem.system, which, round);
            given.is_explained_by_parameters(&system, self.tolerance)
        };
        let fits = |which: &[&str], rounding: Rounding| {
            roundings
                .iter()
                .any(|of| answers.iter().all(|given| is_given(given, which, &|x| of(rounding, x))))
        };
        let parameters: [&[&str]; 7] =
            [&["l", "H"], &["c", "m", "g", "l", "H"], &["c"], &["m"], &["g"], &["l"], &["H"]];
        let mut all =
            parameters.into_iter().flat_map(|which| Rounding::all().map(move |rounding| (which, rounding)));
        let (which, rounding) = all.find(|(which, rounding)| fits(which, *rounding))?;
        let (last, others) = which.split_last()?;
        Some(match others {
            [] => format!("{last} is {rounding}"),
            _ => format!("{} and {last} are {rounding}", others.join(", ")),
        })
    }

    /// Returns the explanation by u and N that are right up to a sum or a factor.
    fn outputs(&self, answers: &[&Observation]) -> Vec<Explanation> {
        let both = self.differences(answers, |i, pairs| {
            sum(i, pairs, &self.fit).or_else(|| factor(i, pairs, &self.fit))
        });
        let explanation = |both: [Difference; 2]| Explanation {
            cause: Cause::Outputs(both.clone()),
            ..self.explanation(answers, described(&both), Vec::new())
        };
        both.map(explanation).into_iter().collect()
    }

    /// Returns by what u and N differ from the right ones; `None` if it is not found, or neither does.
    fn differences(
        &self,
        answers: &[&Observation],
        find: impl Fn(usize, &[Pair]) -> Option<Difference>,
    ) -> Option<[Difference; 2]> {
        let of = |i: usize| {
            let pairs = answers.iter().map(|given| Some((*given, given.numbers()[i].as_ref()?)));
            let pairs = pairs.collect::<Option<Vec<_>>>()?;
            let is_right = Difference::None.explains_all(i, &pairs, &self.fit);
            if is_right { Some(Difference::None) } else { find(i, &pairs) }
        };
        let both = [of(0)?, of(1)?];
        (both != [Difference::None, Difference::None]).then_some(both)
    }
}

/// An answer, and its u or N.
type Pair<'a> = (&'a Observation<'a>, &'a Exact);

/// The difference of all u or N from the right ones.
#[derive(Clone, Debug, PartialEq)]
enum Difference {
    None,
    Sum(Exact),
    Factor(Exact),
    /// They have at most this number of decimals.
    Decimals(usize),
    /// They have at most this number of digits.
    Digits(usize),
}

impl Difference {
    /// Returns `true` if u (0) or N (1) of an answer has the difference, within the tolerance, the rounding errors
    /// of the formula, or that of the number itself.
    fn explains(&self, i: usize, given: &Observation, own: &Exact, fit: &Exact) -> bool {
        let (exact, one) = (given.exact[i], Exact::one());
        let (expected, unit, factor) = match self {
            Difference::None => (exact.clone(), Exact::zero(), one),
            Difference::Sum(sum) => (exact + sum, Exact::zero(), one),
            Difference::Factor(k) => (k * exact, decimal(1, -5) * (k * exact).abs(), k.abs()),
            // Rounded or cut off.
            Difference::Decimals(n) => (exact.clone(), decimal(1, -(*n as i32)), one),
            Difference::Digits(n) => (exact.clone(), decimal(1, 1 - *n as i32) * own.abs(), one),
        };
        let rounding = factor * (fit * &given.scales[i]).max(given.rounding(i).clone());
        (own - expected).abs() <= unit + rounding.max(own.abs() * Exact::power_of_two(-52))
    }

    fn explains_all(&self, i: usize, pairs: &[Pair], fit: &Exact) -> bool {
        pairs.iter().all(|(given, own)| self.explains(i, given, own, fit))
    }

    /// Returns what is wrong with u (0) or N (1).
    fn description(&self, i: usize) -> Option<String> {
        let unit = ["m", "N"][i];
        let digits = |x: &Exact| x.decimal(6, Round::Nearest);
        Some(match self {
            Difference::None => return None,
            Difference::Sum(sum) => {
                let size = if *sum < Exact::zero() { "small" } else { "large" };
                format!("is {} {unit} too {size}", digits(&sum.abs()))
            }
            Difference::Factor(k) => format!("is {} times the right value", digits(k)),
            Difference::Decimals(n) => format!("has at most {n} decimals"),
            Difference::Digits(n) => format!("has at most {n} digits"),
        })
    }
}

/// Returns what is wrong with u and N.
fn described(both: &[Difference; 2]) -> String {
    let [u, n] = [0, 1].map(|i| both[i].description(i));
    let alike = (both[0] == both[1]).then(|| u.as_ref()?.split_once(' ')).flatten();
    match alike {
        Some(("is", rest)) => format!("u and N are {rest}"),
        Some((_, rest)) => format!("u and N have {rest}"),
        None => {
            let named = |(name, what): (&str, Option<String>)| Some(format!("{name} {}", what?));
            let all: Vec<_> = [("u", u), ("N", n)].into_iter().filter_map(named).collect();
            all.join(", and ")
        }
    }
}

/// A way to lose digits of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Rounding {
    Single,
    /// To this number of decimals.
    Decimals(usize),
    /// The decimals after this number are cut off.
    Cut(usize),
    /// To this number of digits.
    Digits(usize),
}

impl Rounding {
    fn all() -> impl Iterator<Item = Rounding> {
        let decimals = (0..DIGITS).flat_map(|n| [Rounding::Decimals(n), Rounding::Cut(n)]);
        [Rounding::Single].into_iter().chain(decimals).chain((1..DIGITS).map(Rounding::Digits))
    }

    fn of(self, x: &Exact) -> Option<Exact> {
        match self {
            Rounding::Single => x.to_f32().ok()?.to_exact().ok(),
            Rounding::Decimals(n) => format!("{x:.n$}").parse().ok(),
            Rounding::Cut(n) => {
                let unit = decimal(1, -(n as i32));
                Some(Exact::from((x / &unit).as_rational().clone().trunc()) * unit)
            }
            Rounding::Digits(n) => Some(short(x, n)),
        }
    }

    /// Rounds the nearest float, as most programs do.
    fn of_float(self, x: &Exact) -> Option<Exact> {
        let float = x.to_f64().ok()?;
        match self {
            Rounding::Single => self.of(x),
            Rounding::Decimals(n) => format!("{float:.n$}").parse().ok(),
            Rounding::Cut(n) => {
                let unit = 10_f64.powi(n as i32);
                ((float * unit).trunc() / unit).to_exact().ok()
            }
            Rounding::Digits(n) => format!("{float:.*e}", n - 1).parse().ok(),
        }
    }
}

/// Returns a system in which the parameters with these symbols are rounded, if they can be.
fn with_rounded(
    system: &SpringMass<Exact>,
    which: &[&str],
    round: &dyn Fn(&Exact) -> Option<Exact>,
) -> SpringMass<Exact> {
    let rounded = |x: &Exact, symbol: &str| which.contains(&symbol).then(|| round(x)).flatten();
    SpringMass::SYMBOLS
        .zip(system.as_ref())
        .map(|(symbol, x)| rounded(x, symbol).unwrap_or_else(|| (*x).clone()))
}

impl fmt::Display for Rounding {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Rounding::Single => f.write_str("rounded to single precision"),
            Rounding::Decimals(n) => write!(f, "rounded to {n} decimals"),
            Rounding::Cut(n) => write!(f, "cut off after {n} decimals"),
            Rounding::Digits(n) => write!(f, "rounded to {n} digits"),
        }
    }
}

/// Returns the values of a mistake for the default systems, with a different penalty for each.
pub(super) fn values(mistake: &Mistake, k: Option<&Exact>) -> Vec<[Option<Exact>; 2]> {
    static SYSTEMS: LazyLock<Vec<Problem>> = LazyLock::new(|| problems(1, CASES, &Family::ALL));
    let numbered = SYSTEMS.iter().map(|problem| &problem.system).zip(2..);
    let values = numbered.map(|(system, penalty)| {
        let constants = Constants { penalty: Some(&Exact::from(penalty)), factor: k };
        let touches = mistake.results.reaction(system, &constants) > Exact::zero();
        mistake.results.of_state(touches).each_ref().map(|formula| value(formula, system, &constants))
    });
    values.collect()
}

/// Returns `true` if two numbers differ by at most a hundredth.
fn is_close(a: &Exact, b: &Exact) -> bool {
    (a - b).abs() * Exact::from(100) <= b.abs()
}

/// Returns the numbers k for which a mistake gives u or N of an answer.
fn estimates(mistake: &Mistake, given: &Observation) -> Vec<Exact> {
    let system = &given.problem.system;
    let touches = system::reaction(system) > Exact::zero();
    if let Some(steps) = mistake.augmentations {
        return touches.then(|| penalty_of_augmentations(steps, given)).flatten().into_iter().collect();
    }
    let penalty = given.reported_penalty();
    let formulas = mistake.results.of_state(touches);
    let numbers = formulas.iter().zip(given.numbers());
    let estimate = |(formula, own): (&_, &Option<Exact>)| {
        let own = own.as_ref()?;
        // The scale of k is not known.
        let unit = if own.is_zero() { Exact::one() } else { own.abs() / Exact::from(8) };
        let points = [1, 2, 3].map(|i| Exact::from(i) * &unit);
        let at = |k| value(formula, system, &Constants { penalty: penalty.as_ref(), factor: Some(k) });
        let [a, b, c] = points.each_ref().map(at);
        Some(linear_fractional([a?, b?, c?], own)? * unit)
    };
    numbers.filter_map(estimate).collect()
}

/// Returns the k for which a quotient of linear functions of k has a value, given its values for k = 1, 2 and
/// 3. A formula in which k occurs once is such a quotient, which preserves cross-ratios.
fn linear_fractional([a, b, c]: [Exact; 3], value: &Exact) -> Option<Exact> {
    let (above, below) = ((value - &a) * (&b - &c), (value - &c) * (&b - &a));
    let sum = &above + &below;
    (!sum.is_zero()).then(|| (Exact::from(3) * above + below) / sum)
}

/// Returns the penalty for which a number of augmentations leaves the penetration of an answer.
fn penalty_of_augmentations(steps: i32, given: &Observation) -> Option<Exact> {
    let system = &given.problem.system;
    let p = contact::penetration(system, given.answer.deflection.as_ref()?);
    // ρᵏ from the penetration R/c without a plane, with ρ = c/(c + ε).
    let left = &system.c * p / system::reaction(system);
    let contraction = left.to_f64().ok()?.powf(1.0 / f64::from(steps)).to_exact().ok()?;
    (contraction > Exact::zero()).then(|| &system.c / contraction - &system.c)
}

/// Returns the difference of all u or N from the right ones in m or N, if it is the same everywhere, and clear in at
/// least three answers.
fn sum(i: usize, pairs: &[Pair], fit: &Exact) -> Option<Difference> {
    // It is most accurate in the smallest system.
    let (given, own) = pairs.iter().min_by(|(a, _), (b, _)| a.scales[i].cmp(&b.scales[i]))?;
    let sum = *own - given.exact[i];
    let is_clear = |(given, _): &&Pair| sum.abs() > Exact::from(100) * fit * &given.scales[i];
    let is_known = pairs.iter().filter(is_clear).take(INFORMATIVE).count() == INFORMATIVE;
    let sum = Difference::Sum(sum);
    (is_known && sum.explains_all(i, pairs, fit)).then_some(sum)
}

/// Returns the factor of all u or N relative to the right ones, if it is the same everywhere, and clear in at least
/// three answers.
fn factor(i: usize, pairs: &[Pair], fit: &Exact) -> Option<Difference> {
    let part = |given: &Observation| given.exact[i].abs() / &given.scales[i];
    let (given, own) = pairs.iter().max_by(|(a, _), (b, _)| part(a).cmp(&part(b)))?;
    let is_clear = |(given, _): &&Pair| part(given) > Exact::from(100) * fit;
    if pairs.iter().filter(is_clear).take(INFORMATIVE).count() < INFORMATIVE {
        return None;
    }
    let factor = Difference::Factor(*own / given.exact[i]);
    factor.explains_all(i, pairs, fit).then_some(factor)
}

/// Largest number of digits that counts as few; single precision has nine.
const FEW: usize = 8;

/// Largest number of decimals that counts as few.
const FEW_DECIMALS: usize = 15;

/// Returns the number of decimals of right numbers.
fn few_decimals(i: usize, pairs: &[Pair]) -> Option<Difference> {
    let is_short = |x: &Exact, n: usize| (x * decimal(1, n as i32)).as_rational().is_integer();
    let decimals = (0..=FEW_DECIMALS).find(|n| pairs.iter().all(|(_, x)| is_short(x, *n)));
    decimals.map(Difference::Decimals).filter(|found| found.explains_all(i, pairs, &Exact::zero()))
}

/// Returns the number of digits of right numbers.
fn few_digits(i: usize, pairs: &[Pair]) -> Option<Difference> {
    let digits = (1..=FEW).find(|n| pairs.iter().all(|(_, x)| has_digits(x, *n)));
    digits.map(Difference::Digits).filter(|found| found.explains_all(i, pairs, &Exact::zero()))
}

/// Returns the diagnosis of a reported force that is the one of the previous step.
pub(super) fn lag(answers: &[Observation]) -> Option<Diagnosis> {
    let lags: Vec<_> = answers.iter().filter_map(|given| given.lags).collect();
    let explained = lags.iter().filter(|lagging| **lagging).count();
    (explained > 0 && explained == lags.len()).then(|| Diagnosis {
        name: "N is one step behind".to_string(),
        equivalent: Vec::new(),
        program: vec![
            registry().render_template("N_k = «augmented::contact_force: u=u_{k−1}»", Notation::Text),
        ],
        answers: DiagnosisScope::Steps,
        explained,
        of: lags.len(),
    })
}

/// Returns the largest error of u in m, of N in N, and of their equilibrium in N: each if several are almost as large
/// although the scales of their systems differ by a factor of a thousand.
pub(super) fn absolute_bounds(wrong: &[&Observation], tolerance: &Exact) -> [Option<Exact>; 3] {
    [0, 1, 2].map(|i| {
        let error = |given: &Observation| {
            let [u, n] = given.numbers().map(Option::as_ref);
            Some(match i {
                0 => u? - given.exact[0],
                1 => n? - given.exact[1],
                _ => contact::equilibrium(&given.problem.system, u?, n?),
            })
        };
        let errors = wrong.iter().map(|given| Some((error(given)?.abs(), &given.scales[i.min(1)])));
        let errors = errors.collect::<Option<Vec<_>>>()?;
        let (most, _) = errors.iter().max()?;
        let is_wrong = |(own, scale): &&(Exact, &Exact)| *own > tolerance * *scale;
        let is_large = |(own, _): &&(Exact, &Exact)| own * Exact::from(10) >= *most;
        let scales: Vec<_> = errors.iter().filter(is_large).map(|(_, scale)| *scale).collect();
        let (largest, least) = (*scales.iter().max()?, *scales.iter().min()?);
        let is_spread = *largest >= Exact::from(1000) * least;
        let counts = [scales.len(), errors.iter().filter(is_wrong).count()];
        (is_spread && counts.into_iter().all(|count| count >= INFORMATIVE)).then(|| most.clone())
    })
}
