//! Deviations of all u, or of all N, from the right ones.

use super::explanation::Explanation;
use super::observation::{INFORMATIVE, Observation, has_digits};
use super::scales::{decimal, format_short};
use crate::chapter::contact;
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};

/// Largest number of digits that counts as few; single precision has nine.
const FEW: usize = 8;

/// Largest number of decimals that counts as few.
const FEW_DECIMALS: usize = 15;

/// The deviation of all u, or of all N, from the right ones.
#[derive(Clone, Debug, PartialEq)]
enum Deviation {
    None,
    Sum(Exact),
    Factor(Exact),
    /// They have at most this number of decimals.
    Decimals(usize),
    /// They have at most this number of digits.
    Digits(usize),
}

/// u or N of an answer.
struct Number<'a> {
    number: &'a Exact,
    exact: &'a Exact,
    /// Its scale, and a bound of the rounding errors of its formula.
    scale: &'a Exact,
    rounding: &'a Exact,
}

/// u or N of all answers.
struct Output<'a> {
    numbers: Vec<Number<'a>>,
    /// Largest distance from the value that explains a number, relative to the scale of its system.
    fit: &'a Exact,
}

/// A search for the deviation of numbers.
type Find<'a> = fn(&Output<'a>) -> Option<Deviation>;

impl<'a> Output<'a> {
    /// Returns u (0) or N (1) of the answers; `None` if one is missing.
    fn of(i: usize, answers: &[&'a Observation<'a>], fit: &'a Exact) -> Option<Self> {
        let numbers = answers.iter().map(|answer| {
            let number = answer.numbers()[i].as_ref()?;
            let (exact, scale) = (answer.exact(i), &answer.scales[i]);
            Some(Number { number, exact, scale, rounding: answer.rounding(i) })
        });
        Some(Output { numbers: numbers.collect::<Option<_>>()?, fit })
    }

    /// Returns the first deviation of all numbers that the searches find.
    fn deviation(&self, searches: &[Find<'a>]) -> Option<Deviation> {
        let found = searches.iter().filter_map(|find| find(self));
        [Deviation::None].into_iter().chain(found).find(|deviation| self.has(deviation))
    }

    /// Returns `true` if all numbers have a deviation, within the tolerance, the rounding errors of the formula, or
    /// that of the number itself.
    fn has(&self, deviation: &Deviation) -> bool {
        self.numbers.iter().all(|Number { number, exact, scale, rounding }| {
            let (expected, unit, factor) = deviation.expected(exact, number);
            let rounding = factor * (self.fit * *scale).max((*rounding).clone());
            (*number - expected).abs() <= unit + rounding.max(number.abs() * Exact::power_of_two(-52))
        })
    }

    /// Returns `true` if a size is clear relative to the scales of several answers.
    fn is_clear(&self, size: impl Fn(&Number) -> Exact) -> bool {
        let hundred = Exact::from(100) * self.fit;
        let clear = self.numbers.iter().filter(|number| size(number) > &hundred * number.scale);
        clear.take(INFORMATIVE).count() == INFORMATIVE
    }

    fn sum(&self) -> Option<Deviation> {
        // It is most accurate in the smallest system.
        let smallest = self.numbers.iter().min_by_key(|number| number.scale)?;
        let sum = smallest.number - smallest.exact;
        self.is_clear(|_| sum.abs()).then(|| Deviation::Sum(sum.clone()))
    }

    fn factor(&self) -> Option<Deviation> {
        let nonzero = self.numbers.iter().filter(|number| !number.exact.is_zero());
        let largest = nonzero.max_by_key(|number| number.exact.abs() / number.scale)?;
        let is_clear = self.is_clear(|number| (number.number - number.exact).abs());
        is_clear.then(|| Deviation::Factor(largest.number / largest.exact))
    }

    fn few_decimals(&self) -> Option<Deviation> {
        let n = (0..=FEW_DECIMALS).find(|n| {
            let unit = decimal(1, *n as i32);
            self.numbers.iter().all(|x| (x.number * &unit).as_rational().is_integer())
        });
        n.map(Deviation::Decimals)
    }

    fn few_digits(&self) -> Option<Deviation> {
        let n = (1..=FEW).find(|n| self.numbers.iter().all(|x| has_digits(x.number, *n)));
        n.map(Deviation::Digits)
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

    /// Returns what is wrong with u or N, whose unit is given: a verb, also of both, and a complement.
    fn description(&self, unit: &str) -> Option<([&'static str; 2], String)> {
        let (is, has) = (["is", "are"], ["has", "have"]);
        Some(match self {
            Deviation::None => return None,
            Deviation::Sum(sum) => {
                let size = if *sum < Exact::zero() { "small" } else { "large" };
                (is, format!("{} {unit} too {size}", format_short(&sum.abs())))
            }
            Deviation::Factor(k) => (is, format!("{} times the right value", format_short(k))),
            Deviation::Decimals(n) => (has, format!("at most {n} decimals")),
            Deviation::Digits(n) => (has, format!("at most {n} digits")),
        })
    }
}

/// Returns the deviations of u and N that searches find; `None` if they find one of them only, or neither deviates.
fn deviations<'a>(
    answers: &[&'a Observation<'a>],
    fit: &'a Exact,
    searches: &[Find<'a>],
) -> Option<Explanation> {
    let [u, n] = [0, 1].map(|i| Output::of(i, answers, fit)?.deviation(searches));
    let both = [u?, n?];
    let name = match (both[0].description("m"), both[1].description("N")) {
        (None, None) => return None,
        (Some(([_, verb], what)), Some(_)) if both[0] == both[1] => format!("u and N {verb} {what}"),
        (u, n) => {
            let named = [("u", u), ("N", n)].into_iter().filter_map(|(name, said)| {
                let ([verb, _], what) = said?;
                Some(format!("{name} {verb} {what}"))
            });
            named.collect::<Vec<_>>().join(", and ")
        }
    };
    let fit = fit.clone();
    let may_give = Box::new(move |answer: &Observation| {
        both.iter()
            .enumerate()
            .all(|(i, deviation)| Output::of(i, &[answer], &fit).is_some_and(|output| output.has(deviation)))
    });
    Some(Explanation { may_give, ..Explanation::new(name, Vec::new()) })
}

/// Returns the sums or factors by which u and N deviate.
pub(super) fn sums_or_factors<'a>(answers: &[&'a Observation<'a>], fit: &'a Exact) -> Option<Explanation> {
    deviations(answers, fit, &[Output::sum, Output::factor])
}

/// Returns the number of decimals or digits of right numbers, preferably of the same kind for u and N.
pub(super) fn few_digits<'a>(answers: &[&'a Observation<'a>], fit: &'a Exact) -> Option<Explanation> {
    let (decimals, digits): (Find, Find) = (Output::few_decimals, Output::few_digits);
    let searches: [&[Find]; 3] = [&[decimals], &[digits], &[decimals, digits]];
    searches.into_iter().find_map(|searches| deviations(answers, fit, searches))
}

/// Returns the largest error of u in m, of N in N, and of their equilibrium in N: each if most are almost as large
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

/// Returns the largest of errors with their scales, if most are almost as large although the scales differ by a factor
/// of a thousand.
fn absolute_bound(errors: &[(Exact, &Exact)], tolerance: &Exact) -> Option<Exact> {
    let (most, _) = errors.iter().max()?;
    let wrong = errors.iter().filter(|(error, scale)| *error > tolerance * *scale).count();
    let large = errors.iter().filter(|(error, _)| error * Exact::from(10) >= *most);
    let scales: Vec<_> = large.map(|(_, scale)| *scale).collect();
    let is_spread = **scales.iter().max()? >= Exact::from(1000) * *scales.iter().min()?;
    let is_common = scales.len() >= INFORMATIVE && 2 * scales.len() > errors.len();
    (is_spread && is_common && wrong >= INFORMATIVE).then(|| most.clone())
}
