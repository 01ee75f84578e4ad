//! Deviations of all u, or of all N, from the right ones.

use super::assessment::format_short;
use super::diagnosis::INFORMATIVE;
use super::observation::{Observation, has_digits};
use super::problems::decimal;
use crate::chapter::contact;
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};

/// Largest number of digits that counts as few; single precision has nine.
const FEW: usize = 8;

/// Largest number of decimals that counts as few.
const FEW_DECIMALS: usize = 15;

/// The deviation of all u, or of all N, from the right ones.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Deviation {
    None,
    Sum(Exact),
    Factor(Exact),
    /// They have at most this number of decimals.
    Decimals(usize),
    /// They have at most this number of digits.
    Digits(usize),
}

/// u or N of all answers.
pub(super) struct Output<'a> {
    /// 0 for u, 1 for N.
    index: usize,
    numbers: Vec<(&'a Observation<'a>, &'a Exact)>,
    /// Largest distance from the value that explains a number, relative to the scale of its system.
    fit: &'a Exact,
}

impl<'a> Output<'a> {
    /// Returns u (0) or N (1) of the answers; `None` if one is missing.
    fn of(index: usize, answers: &[&'a Observation<'a>], fit: &'a Exact) -> Option<Self> {
        let numbers = answers.iter().map(|answer| Some((*answer, answer.numbers()[index].as_ref()?)));
        Some(Output { index, numbers: numbers.collect::<Option<_>>()?, fit })
    }

    /// Returns the deviation that a search finds.
    fn deviation(&self, find: fn(&Self) -> Option<Deviation>) -> Option<Deviation> {
        if self.has(&Deviation::None) { Some(Deviation::None) } else { find(self) }
    }

    /// Returns `true` if all numbers have a deviation, within the tolerance, the rounding errors of the formula, or
    /// that of the number itself.
    fn has(&self, deviation: &Deviation) -> bool {
        self.numbers.iter().all(|(answer, number)| {
            let (expected, unit, factor) = deviation.expected(self.exact(answer), number);
            let tolerance = self.fit * self.scale(answer);
            let rounding = factor * tolerance.max(answer.rounding(self.index).clone());
            (*number - expected).abs() <= unit + rounding.max(number.abs() * Exact::power_of_two(-52))
        })
    }

    fn deviates_by(&self, deviation: Deviation) -> Option<Deviation> {
        self.has(&deviation).then_some(deviation)
    }

    /// Returns the exact number of an answer.
    fn exact(&self, answer: &Observation<'a>) -> &'a Exact {
        answer.exact(self.index)
    }

    fn scale<'b>(&self, answer: &'b Observation) -> &'b Exact {
        &answer.scales[self.index]
    }

    /// Returns `true` if a size is clear relative to the scales of several answers.
    fn is_clear(&self, size: impl Fn(&Observation<'a>) -> Exact) -> bool {
        let mut clear = 0;
        for (answer, _) in &self.numbers {
            clear += usize::from(size(answer) > Exact::from(100) * self.fit * self.scale(answer));
        }
        clear >= INFORMATIVE
    }

    /// Returns the sum or the factor that explains the numbers.
    pub fn sum_or_factor(&self) -> Option<Deviation> {
        self.sum().or_else(|| self.factor())
    }

    fn sum(&self) -> Option<Deviation> {
        // It is most accurate in the smallest system.
        let (answer, number) = self.numbers.iter().min_by_key(|(answer, _)| self.scale(answer))?;
        let sum = *number - self.exact(answer);
        if self.is_clear(|_| sum.abs()) { self.deviates_by(Deviation::Sum(sum)) } else { None }
    }

    fn factor(&self) -> Option<Deviation> {
        let numbers = self.numbers.iter();
        let (answer, number) =
            numbers.max_by_key(|(answer, _)| self.exact(answer).abs() / self.scale(answer))?;
        if !self.is_clear(|answer| self.exact(answer).abs()) {
            return None;
        }
        self.deviates_by(Deviation::Factor(*number / self.exact(answer)))
    }

    /// Returns the number of decimals or digits of right numbers.
    pub fn few(&self) -> Option<Deviation> {
        self.few_decimals().or_else(|| self.few_digits())
    }

    pub fn few_decimals(&self) -> Option<Deviation> {
        let n = (0..=FEW_DECIMALS).find(|n| {
            let unit = decimal(1, *n as i32);
            self.numbers.iter().all(|(_, x)| (*x * &unit).as_rational().is_integer())
        });
        self.deviates_by(Deviation::Decimals(n?))
    }

    pub fn few_digits(&self) -> Option<Deviation> {
        let n = (1..=FEW).find(|n| self.numbers.iter().all(|(_, x)| has_digits(x, *n)));
        self.deviates_by(Deviation::Digits(n?))
    }
}

impl Deviation {
    /// Returns the number expected for an exact one, the largest distance from it due to digits, and the factor of
    /// other rounding errors.
    fn expected(&self, exact: &Exact, number: &Exact) -> (Exact, Exact, Exact) {
        let (zero, one) = (Exact::zero(), Exact::one());
        match self {
            Deviation::None => (exact.clone(), zero, one),
            Deviation::Sum(sum) => (exact + sum, zero, one),
            Deviation::Factor(k) => (k * exact, decimal(1, -5) * (k * exact).abs(), k.abs()),
            // Rounded or cut off.
            Deviation::Decimals(n) => (exact.clone(), decimal(1, -(*n as i32)), one),
            Deviation::Digits(n) => (exact.clone(), decimal(1, 1 - *n as i32) * number.abs(), one),
        }
    }

    /// Returns what is wrong with u (0) or N (1), as a verb and a complement.
    fn description(&self, index: usize) -> Option<(&'static str, String)> {
        let unit = ["m", "N"][index];
        Some(match self {
            Deviation::None => return None,
            Deviation::Sum(sum) => {
                let size = if *sum < Exact::zero() { "small" } else { "large" };
                ("is", format!("{} {unit} too {size}", format_short(&sum.abs())))
            }
            Deviation::Factor(k) => ("is", format!("{} times the right value", format_short(k))),
            Deviation::Decimals(n) => ("has", format!("at most {n} decimals")),
            Deviation::Digits(n) => ("has", format!("at most {n} digits")),
        })
    }
}

/// Returns the deviations of u and N that a search finds; `None` if it finds one of them only, or neither deviates.
pub(super) fn deviations<'a>(
    answers: &[&'a Observation<'a>],
    fit: &'a Exact,
    find: fn(&Output<'a>) -> Option<Deviation>,
) -> Option<[Deviation; 2]> {
    let both = [Output::of(0, answers, fit)?.deviation(find)?, Output::of(1, answers, fit)?.deviation(find)?];
    (both != [Deviation::None, Deviation::None]).then_some(both)
}

/// Returns `true` if u and N of an answer have these deviations.
pub(super) fn have_deviations(answer: &Observation, both: &[Deviation; 2], fit: &Exact) -> bool {
    both.iter().enumerate().all(|(i, deviation)| {
        let output = Output::of(i, std::slice::from_ref(&answer), fit);
        output.is_some_and(|output| output.has(deviation))
    })
}

/// Describes the deviations of u and N.
pub(super) fn described([u, n]: &[Deviation; 2]) -> String {
    match (u.description(0), n.description(1)) {
        (Some(("is", what)), Some(_)) if u == n => format!("u and N are {what}"),
        (Some((_, what)), Some(_)) if u == n => format!("u and N have {what}"),
        (u, n) => {
            let both = [("u", u), ("N", n)].into_iter();
            let named =
                both.filter_map(|(name, said)| said.map(|(verb, what)| format!("{name} {verb} {what}")));
            named.collect::<Vec<_>>().join(", and ")
        }
    }
}

/// Returns the largest error of u in m, of N in N, and of their equilibrium in N: each if several are almost as large
/// although the scales of their systems differ by a factor of a thousand.
pub(super) fn absolute_bounds(wrong: &[&Observation], tolerance: &Exact) -> [Option<Exact>; 3] {
    [0, 1, 2].map(|i| {
        let errors = wrong.iter().map(|answer| {
            let error = if i < 2 { answer.absolute_error(i) } else { residual(answer) };
            Some((error?, &answer.scales[i.min(1)]))
        });
        absolute_bound(&errors.collect::<Option<Vec<_>>>()?, tolerance)
    })
}

/// Returns the error of equilibrium.
fn residual(answer: &Observation) -> Option<Exact> {
    let [Some(u), Some(n)] = answer.numbers() else { return None };
    Some(contact::equilibrium(&answer.problem.system, u, n).abs())
}

/// Returns the largest of errors with their scales, if several are almost as large although the scales differ by a
/// factor of a thousand.
fn absolute_bound(errors: &[(Exact, &Exact)], tolerance: &Exact) -> Option<Exact> {
    let (most, _) = errors.iter().max()?;
    let wrong = errors.iter().filter(|(error, scale)| *error > tolerance * *scale).count();
    let large = errors.iter().filter(|(error, _)| error * Exact::from(10) >= *most);
    let scales: Vec<_> = large.map(|(_, scale)| *scale).collect();
    let is_spread = **scales.iter().max()? >= Exact::from(1000) * *scales.iter().min()?;
    (is_spread && scales.len() >= INFORMATIVE && wrong >= INFORMATIVE).then(|| most.clone())
}
