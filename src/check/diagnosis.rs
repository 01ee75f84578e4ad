//! Diagnosis: the one edit, the one number or the one rounding that explains the answers of a solver.

use super::convention::Convention;
use super::explanation::{Diagnosis, DiagnosisScope, Explanation};
use super::iteration::common_error;
use super::law::smoothed_law;
use super::observation::{Agreement, INFORMATIVE, Observation};
use super::output::{few_digits, sums_or_factors};
use super::precision::rounded_parameters;
use super::problems::{Family, Problem, problems};
use super::program::{Kind, Known, Mistake, Reference};
use super::scales::{fit, format_short, short};
use crate::chapter::{contact, system};
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Exact, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::float::Round;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Default number of systems in each family: sufficient to distinguish most mistakes.
pub const CASES: u64 = 5;

/// Number of wrong answers, of all families, from which an unknown number is computed.
pub(super) const SAMPLES: usize = 40;

/// A search for explanations of wrong answers.
pub(super) struct Search<'a> {
    reference: Reference,
    tolerance: &'a Exact,
    /// Largest distance of an answer from the value that explains it.
    fit: Exact,
}

/// Mistakes of solvers by each method of reference.
type Candidates = [LazyLock<Vec<Mistake>>; 2];

static EDITS: Candidates =
    [LazyLock::new(|| Reference::Multiplier.edits()), LazyLock::new(|| Reference::Penalty.edits())];
static NUMBERS: Candidates =
    [LazyLock::new(|| Reference::Multiplier.numbers()), LazyLock::new(|| Reference::Penalty.numbers())];
static IN_SOME_ANSWERS: Candidates = [
    LazyLock::new(|| Reference::Multiplier.in_some_answers()),
    LazyLock::new(|| Reference::Penalty.in_some_answers()),
];

/// One kind of search.
type Find = fn(&Search, &[&Observation]) -> Vec<Explanation>;

impl<'a> Search<'a> {
    pub fn new(reference: Reference, tolerance: &'a Exact) -> Self {
        Search { reference, tolerance, fit: fit(tolerance) }
    }

    /// Returns all explanations of one kind, the first one of which explains all answers.
    pub fn of_all(&self, answers: &[&Observation]) -> Vec<Explanation> {
        if !self.is_informative(answers) {
            let found = self.roundings(answers);
            return if found.is_empty() { self.stopped_early(answers) } else { found };
        }
        let searches: [Find; 7] = [
            |search, answers| search.programs(&EDITS, answers),
            |search, answers| search.roundings(answers),
            |search, answers| sums_or_factors(answers, &search.fit).into_iter().collect(),
            |search, answers| search.programs(&NUMBERS, answers),
            |search, answers| smoothed_law(answers, &search.fit).into_iter().collect(),
            |search, answers| search.stopped_early(answers),
            |search, answers| search.behind_conventions(answers),
        ];
        let found = searches.into_iter().map(|search| search(self, answers));
        found.into_iter().find(|found| !found.is_empty()).unwrap_or_default()
    }

    /// Returns all explanations of the wrong answers alone.
    ///
    /// A changed formula affects all answers, so explaining only some would be a coincidence; a changed
    /// decision, or result, does not.
    pub fn of_wrong(&self, wrong: &[&Observation]) -> Vec<Explanation> {
        if !self.is_informative(wrong) {
            return Vec::new();
        }
        let found = self.programs(&IN_SOME_ANSWERS, wrong);
        if found.is_empty() { sums_or_factors(wrong, &self.fit).into_iter().collect() } else { found }
    }

    /// Returns `true` if enough answers differ from the right ones by more than the fitting tolerance.
    /// Otherwise every mistake with a small effect would fit.
    fn is_informative(&self, answers: &[&Observation]) -> bool {
        let right = self.reference.program();
        let differing =
            answers.iter().filter(|answer| answer.agreement(&right, None, &self.fit) == Agreement::No);
        differing.take(INFORMATIVE).count() == INFORMATIVE
    }

    /// Returns `true` if the mistake explains all answers, and several wrong ones not only by rounding errors.
    fn explains_all(&self, mistake: &Mistake, k: Option<&Exact>, answers: &[&Observation]) -> bool {
        let mut clear = 0;
        for answer in answers {
            let agreement = answer.agreement(&mistake.program, k, &self.fit);
            if agreement == Agreement::No {
                return false;
            }
            clear += usize::from(answer.is_wrong() && agreement == Agreement::Clear);
        }
        clear >= INFORMATIVE
    }

    /// Returns the wrong programs that explain all answers: one for all that have the same results.
    fn programs(&self, candidates: &'static Candidates, answers: &[&Observation]) -> Vec<Explanation> {
        let wrong: Vec<_> = answers.iter().copied().filter(|answer| answer.is_wrong()).collect();
        let mut found: Vec<(Vec<[Option<Exact>; 2]>, Explanation)> = Vec::new();
        for mistake in candidates[self.reference as usize].iter() {
            let Some(k) = self.number(mistake, &wrong, answers) else { continue };
            let results = results(mistake, k.as_ref());
            let new = self.explanation(mistake, k);
            let Some((_, same)) = found.iter_mut().find(|(known, _)| *known == results) else {
                found.push((results, new));
                continue;
            };
            let is_new = same.name != new.name && !same.equivalent.contains(&new.name);
            if mistake.kind == Kind::Parameter && is_new {
                same.equivalent.push(new.name);
            }
        }
        found.into_iter().map(|(_, found)| found).collect()
    }

    /// Returns the number k with which a mistake explains all answers, or `None` in place of a number if it has
    /// none.
    fn number(
        &self,
        mistake: &Mistake,
        wrong: &[&Observation],
        answers: &[&Observation],
    ) -> Option<Option<Exact>> {
        if !mistake.name.contains("{k}") {
            return self.explains_all(mistake, None, answers).then_some(None);
        }
        let samples = wrong.iter().step_by(wrong.len().div_ceil(SAMPLES).max(1));
        // A penalty is positive.
        let may_be_negative = !mistake.name.contains("ε = {k}");
        let is_possible = |k: &Exact| *k > Exact::zero() || may_be_negative;
        let mut numbers = samples.flat_map(|answer| estimates(mistake, answer)).filter(is_possible);
        let explains = |k: &Exact| self.explains_all(mistake, Some(k), answers);
        let k = numbers.find(explains)?;
        // Answers of few digits determine it roughly, and it is probably a round number.
        Some((1..=3).map(|digits| short(&k, digits)).find(explains).or(Some(k)))
    }

    fn explanation(&self, mistake: &'static Mistake, k: Option<Exact>) -> Explanation {
        let text = k.as_ref().map(format_short);
        // The formulas of many steps are long.
        let is_long = matches!(mistake.kind, Kind::Augmentations(_));
        let mut program = if is_long { Vec::new() } else { mistake.program.lines() };
        program.extend(text.iter().map(|k| format!("k = {k}")));
        let name = mistake.name.replace("{k}", &text.unwrap_or_default());
        let fit = self.fit.clone();
        Explanation {
            is_decision: mistake.kind == Kind::Decision,
            may_give: Box::new(move |answer| {
                answer.agreement(&mistake.program, k.as_ref(), &fit) != Agreement::No
            }),
            ..Explanation::new(name, program)
        }
    }

    /// Returns the mistakes behind the most usual convention that explain all answers with it.
    fn behind_conventions(&self, answers: &[&Observation]) -> Vec<Explanation> {
        let conventions = Convention::candidates(answers, &self.fit);
        let mut found = conventions.iter().map(|convention| self.behind(convention, answers));
        found.find(|found| !found.is_empty()).unwrap_or_default()
    }

    fn behind(&self, convention: &Convention, answers: &[&Observation]) -> Vec<Explanation> {
        let results: Vec<_> = answers.iter().map(|answer| convention.undo(answer, self.tolerance)).collect();
        let undone = results.iter().filter_map(|result| Observation::of(0, result, self.tolerance));
        let undone: Vec<_> = undone.collect();
        let undone: Vec<_> = undone.iter().collect();
        let searches = [&EDITS, &NUMBERS].into_iter().filter(|_| self.is_informative(&undone));
        let mut found = searches.map(|candidates| self.programs(candidates, &undone));
        let mut found = found.find(|found| !found.is_empty()).unwrap_or_default();
        for explanation in &mut found {
            explanation.name =
                format!("with the convention that {}, {}", convention.description(), explanation.name);
            // It describes the answers without the convention.
            explanation.may_give = Box::new(|_| false);
        }
        found
    }

    /// Returns the right program, or the wrong ones, that give all answers up to an error that is similar in most.
    fn stopped_early(&self, answers: &[&Observation]) -> Vec<Explanation> {
        let right = &Mistake::new("the formulas are right", self.reference.program());
        let mut found = BTreeMap::new();
        let is_wrong = answers.iter().filter(|answer| answer.is_wrong()).count() >= INFORMATIVE;
        for mistake in std::iter::once(right).chain(&*EDITS[self.reference as usize]).filter(|_| is_wrong) {
            let is_right = std::ptr::eq(mistake, right);
            let Some(error) = common_error(&mistake.program, is_right, answers) else { continue };
            let (results, error) = (results(mistake, None), error.decimal(2, Round::Up));
            let name = format!("{} up to {error}, as an iteration that stops early leaves", mistake.name);
            if is_right {
                return vec![Explanation::new(name, Vec::new())];
            }
            found.entry(results).or_insert_with(|| Explanation::new(name, mistake.program.lines()));
        }
        found.into_values().collect()
    }

    /// Returns the loss of digits that explains all answers.
    fn roundings(&self, answers: &[&Observation]) -> Vec<Explanation> {
        let wrong = answers.iter().filter(|answer| answer.is_wrong()).count();
        if wrong == 0 || answers.iter().filter(|answer| !answer.is_right()).count() < INFORMATIVE {
            return Vec::new();
        }
        let found = few_digits(answers, &self.fit).or_else(|| {
            let name = if answers.iter().all(|answer| answer.is_single()) {
                "it computes in single precision".to_string()
            } else if wrong >= INFORMATIVE {
                rounded_parameters(answers, self.tolerance)?
            } else {
                return None;
            };
            Some(Explanation::new(name, Vec::new()))
        });
        found.into_iter().collect()
    }
}

/// Adds penalties that are different for all systems, as multiples of c.
pub(super) fn with_penalties(mut problems: Vec<Problem>) -> Vec<Problem> {
    for (multiple, problem) in (2..).zip(&mut problems) {
        problem.penalty = Some(&problem.system.c * Exact::from(multiple));
    }
    problems
}

/// Returns u and N of a mistake for the default systems, each with a penalty.
pub(super) fn results(mistake: &Mistake, k: Option<&Exact>) -> Vec<[Option<Exact>; 2]> {
    static PROBLEMS: LazyLock<Vec<Problem>> =
        LazyLock::new(|| with_penalties(problems(1, CASES, Family::ALL)));
    PROBLEMS.iter().map(|problem| mistake.program.answer(problem, k)).collect()
}

/// Returns the numbers k for which a mistake gives u or N of an answer.
fn estimates(mistake: &Mistake, answer: &Observation) -> Vec<Exact> {
    let touches = system::reaction(&answer.problem.system) > Exact::zero();
    if let Kind::Augmentations(steps) = mistake.kind {
        let penalty = if touches { penalty_of_augmentations(steps, answer) } else { None };
        return penalty.into_iter().collect();
    }
    (0..2).filter_map(|i| estimate(mistake, i, touches, answer)).collect()
}

/// Returns the number k for which a mistake gives u (0) or N (1) of an answer.
fn estimate(mistake: &Mistake, i: usize, touches: bool, answer: &Observation) -> Option<Exact> {
    let number = answer.numbers()[i].as_ref()?;
    // The scale of k is not known.
    let unit = if number.is_zero() { Exact::one() } else { number.abs() / Exact::from(8) };
    let penalty = answer.reported_penalty();
    let [a, b, c] = [1, 2, 3].map(|multiple| {
        let k = Exact::from(multiple) * &unit;
        let known = Known::new(&answer.problem.system, penalty.as_ref(), Some(&k));
        mistake.program.values(&known, touches).into_iter().nth(i).flatten()
    });
    Some(linear_fractional([a?, b?, c?], number)? * unit)
}

/// Returns the k for which a quotient of linear functions of k has a value, given its values for k = 1, 2 and
/// 3. A formula in which k occurs once is such a quotient, which preserves cross-ratios.
fn linear_fractional([a, b, c]: [Exact; 3], value: &Exact) -> Option<Exact> {
    let (above, below) = ((value - &a) * (&b - &c), (value - &c) * (&b - &a));
    let sum = &above + &below;
    (!sum.is_zero()).then(|| (Exact::from(3) * above + below) / sum)
}

/// Returns the penalty for which a number of augmentations leaves the penetration of an answer.
fn penalty_of_augmentations(steps: i32, answer: &Observation) -> Option<Exact> {
    let system = &answer.problem.system;
    let p = contact::penetration(system, answer.numbers()[0].as_ref()?);
    // ρᵏ from the penetration R/c without a plane, with ρ = c/(c + ε).
    let left = &system.c * p / system::reaction(system);
    let contraction = left.to_f64().ok()?.powf(1.0 / f64::from(steps)).to_exact().ok()?;
    (contraction > Exact::zero()).then(|| &system.c / contraction - &system.c)
}

/// Returns the diagnosis of a reported force that is the one of the previous step.
pub(super) fn lag(answers: &[Observation]) -> Option<Diagnosis> {
    let lags: Vec<_> = answers.iter().filter_map(|answer| answer.assessment().lags).collect();
    let line = || registry().render_template("N_k = «augmented::contact_force: u=u_{k−1}»", Notation::Text);
    let is_behind = !lags.is_empty() && lags.iter().all(|lags| *lags);
    is_behind.then(|| {
        Explanation::new("N is one step behind", vec![line()]).diagnosis(DiagnosisScope::Steps, lags.len())
    })
}
