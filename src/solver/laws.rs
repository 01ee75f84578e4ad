//! Laws that a number system must satisfy for [`solve`](super::solve) to be correct, for use in your own
//! tests.

use super::{Interval, Scalar};
use crate::number::{Exact, Field, PositivePart};
use num_traits::{One, Zero};
use rug::float::Round;

/// A law of [`Scalar`], named after the method concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScalarLaw {
    /// [`int`](Field::int) is exact up to 2⁸ in scalars, and enclosed up to 2²⁴.
    Integer,
    /// Numbers compare as their values do, only 0 is zero, and ⟨·⟩, min and |·| are exact.
    Order,
    /// A number with a value is finite.
    Finite,
    /// [`enclose`](Scalar::enclose) contains the number itself.
    Enclose,
    /// [`interval`](Scalar::interval) contains the exact result of arithmetic on enclosures.
    Interval,
    /// [`magnitude`](Scalar::magnitude) is not less than the absolute value.
    Magnitude,
    /// [`sign`](Scalar::sign) is correct or `None`.
    Sign,
    /// [`power`](Scalar::power) encloses the power.
    Power,
    /// [`sign_of_sum`](Scalar::sign_of_sum) is exact. A [`Native`](crate::number::Native) without exact values, such as
    /// `TwoFloat` of the crate `twofloat` 0.8, violates it.
    SignOfSum,
}

/// A violated law with its counterexample.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the law {law:?} is violated: {counterexample}")]
pub struct LawViolation {
    /// The law.
    pub law: ScalarLaw,
    /// The operation with its operands, its result and the expected result.
    pub counterexample: String,
}

/// Checks the laws of [`Scalar`] on all samples, their pairs and their triples, where `exact` returns the
/// value of a scalar.
///
/// The bounds of `solve` rest on these laws. Good samples make rounding difficult: neighbours, whose
/// differences cancel; numbers of very different magnitude; the smallest and the largest numbers. The time
/// grows with the cube of the number of samples; twenty suffice. Division by zero is not tested. A non-finite
/// bound violates no law.
///
/// # Errors
/// Returns the first violation found.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::{number::ToExact, solver::laws};
/// let samples = [0.0, 1.0, 1.0 + f64::EPSILON, 0.1, -3.0, 1e20, 1e-20];
/// laws::check_scalar_laws(&samples, |x| x.to_exact().unwrap())?;
/// # Ok::<(), laws::LawViolation>(())
/// ```
pub fn check_scalar_laws<T: Scalar<Enclosure = E>, E: PositivePart>(
    samples: &[T],
    exact: impl Fn(&T) -> Exact,
) -> Result<(), LawViolation> {
    let laws = LawChecker { exact: &exact };
    laws.of_integers()?;
    let known: Vec<_> = samples.iter().map(|x| Sample { number: x, exact: (laws.exact)(x) }).collect();
    for a in &known {
        laws.of_one(a)?;
        for b in &known {
            laws.of_two(a, b)?;
            for c in &known {
                laws.of_three(a, b, c)?;
            }
        }
    }
    Ok(())
}

/// A scalar and its exact value.
struct Sample<'a, T> {
    number: &'a T,
    exact: Exact,
}

struct LawChecker<'a, T> {
    exact: &'a dyn Fn(&T) -> Exact,
}

impl<T: Scalar<Enclosure = E>, E: PositivePart> LawChecker<'_, T> {
    fn of_integers(&self) -> Result<(), LawViolation> {
        for n in [-256, 0, 1, 2, 3, 255] {
            self.is(&T::int(n), &Exact::int(n), ScalarLaw::Integer, || format!("the integer {n}"))?;
        }
        for n in [-16_777_216, -257, 0, 1, 2, 3, 16_777_215] {
            let right = Exact::int(n);
            self.encloses(&E::int(n), &right, ScalarLaw::Integer, || format!("the enclosure of {n}"))?;
        }
        Ok(())
    }

    fn of_one(&self, a: &Sample<T>) -> Result<(), LawViolation> {
        let Sample { number, exact } = a;
        hold(number.is_finite(), ScalarLaw::Finite, || format!("{number:?}, which is {}", written(exact)))?;
        let (zero, right) = (number.is_zero(), exact.is_zero());
        hold(zero == right, ScalarLaw::Order, || format!("is_zero of {number:?}: {zero}, expected {right}"))?;
        self.is(&number.positive_part(), &exact.positive_part(), ScalarLaw::Order, || {
            format!("⟨·⟩ of {number:?}")
        })?;
        self.is(&number.abs(), &exact.abs(), ScalarLaw::Order, || format!("|·| of {number:?}"))?;
        self.encloses(&number.enclose(), exact, ScalarLaw::Enclose, || {
            format!("the enclosure of {number:?}")
        })?;
        let mut product = Exact::one();
        for k in 0..=9 {
            if let Some(power) = T::power(&number.enclose(), k) {
                self.encloses(&power, &product, ScalarLaw::Power, || {
                    format!("{number:?} to the power of {k}")
                })?;
            }
            product = product * exact;
        }
        Ok(())
    }

    fn of_two(&self, a: &Sample<T>, b: &Sample<T>) -> Result<(), LawViolation> {
        let (x, y) = (a.number, b.number);
        let (order, right) = (x.partial_cmp(y), a.exact.cmp(&b.exact));
        hold(order == Some(right), ScalarLaw::Order, || {
            format!("{x:?} compared with {y:?}: {order:?}, expected {right:?}")
        })?;
        self.is(&x.min(y), &PositivePart::min(&a.exact, &b.exact), ScalarLaw::Order, || {
            format!("{x:?} min {y:?}")
        })
    }

    fn of_three(&self, a: &Sample<T>, b: &Sample<T>, c: &Sample<T>) -> Result<(), LawViolation> {
        let numbers = [a, b, c].map(|x| x.number);
        let divisors = [!c.exact.is_zero(), !(&a.exact + &b.exact).is_zero()];
        let enclosed = results(&numbers.map(T::enclose), divisors);
        let exact = results(&[&a.exact, &b.exact, &c.exact].map(Exact::clone), divisors);
        for ((what, enclosure), (_, exact)) in enclosed.iter().zip(&exact) {
            self.encloses(enclosure, exact, ScalarLaw::Interval, || {
                let [a, b, c] = numbers;
                format!("{what} with a = {a:?}, b = {b:?}, c = {c:?}")
            })?;
        }
        // b times the rounding error of a + c, with two unrelated products.
        let sum = a.number + c.number;
        for (plus, minus) in [([(a, b), (b, c)], None), ([(a, b), (c, a)], Some((b, c)))] {
            let (last, taken) = match minus {
                Some((x, y)) => ((x.number, y.number), &x.exact * &y.exact),
                None if sum.is_finite() => ((b.number, &sum), &b.exact * (self.exact)(&sum)),
                None => continue,
            };
            let [first, second] = plus.map(|(x, y)| &x.exact * &y.exact);
            let right = (first + second).cmp(&taken);
            let found = T::sign_of_sum(plus.map(|(x, y)| (x.number, y.number)), last);
            hold(found == right, ScalarLaw::SignOfSum, || {
                let [(a, b), (c, d)] = plus.map(|(x, y)| (x.number, y.number));
                let (e, f) = last;
                format!("{a:?} · {b:?} + {c:?} · {d:?} − {e:?} · {f:?}: {found:?}, expected {right:?}")
            })?;
        }
        Ok(())
    }

    fn is(
        &self,
        found: &T,
        right: &Exact,
        law: ScalarLaw,
        by: impl Fn() -> String,
    ) -> Result<(), LawViolation> {
        hold((self.exact)(found) == *right, law, || {
            format!("{}: {found:?}, expected {}", by(), written(right))
        })
    }

    fn encloses(
        &self,
        enclosure: &T::Enclosure,
        x: &Exact,
        law: ScalarLaw,
        by: impl Fn() -> String,
    ) -> Result<(), LawViolation> {
        let Interval { lower, upper } = T::interval(enclosure);
        let magnitude = T::magnitude(enclosure);
        let with = |what: String| format!("{}: {what}, of {}", by(), written(x));
        let within = self.finite_value(&lower).is_none_or(|lower| lower <= *x)
            && self.finite_value(&upper).is_none_or(|upper| *x <= upper);
        hold(within, law, || with(format!("between {lower:?} and {upper:?}")))?;
        let is_bounded = self.finite_value(&magnitude).is_none_or(|magnitude| x.abs() <= magnitude);
        hold(is_bounded, ScalarLaw::Magnitude, || with(format!("magnitude {magnitude:?}")))?;
        let (sign, right) = (T::sign(enclosure), x.cmp(&Exact::zero()));
        hold(sign.is_none_or(|sign| sign == right), ScalarLaw::Sign, || with(format!("sign {sign:?}")))
    }

    /// Returns the value of a bound; `None` if it is not finite and so violates no law.
    fn finite_value(&self, bound: &T) -> Option<Exact> {
        bound.is_finite().then(|| (self.exact)(bound))
    }
}

/// Returns results of two operations each on three numbers, so that the second operation receives the
/// rounding error of the first. The flags tell whether the divisors c and a + b are nonzero.
fn results<E: PositivePart>([a, b, c]: &[E; 3], divisors: [bool; 2]) -> Vec<(&'static str, E)> {
    let mut results = vec![
        ("a + b − c", a + b - c),
        ("(a − b) c", (a - b) * c),
        ("a b − c", a * b - c),
        ("⟨a b − c⟩", (a * b - c).positive_part()),
        ("min(a − b, c)", (a - b).min(c)),
        ("|a b − c|", (a * b - c).abs()),
    ];
    if divisors[0] {
        results.push(("(a − b) / c", (a - b) / c));
        results.push(("a / c − b", a / c - b));
    }
    if divisors[1] {
        results.push(("c / (a + b)", c / (a + b)));
    }
    results
}

/// Formats with enough digits to distinguish the value from an enclosure of four floats.
fn written(x: &Exact) -> String {
    x.decimal(30, Round::Nearest)
}

fn hold(holds: bool, law: ScalarLaw, by: impl Fn() -> String) -> Result<(), LawViolation> {
    if holds { Ok(()) } else { Err(LawViolation { law, counterexample: by() }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every label denotes the computed result.
    #[test]
    fn results_agree_with_their_names() {
        let numbers = [7, 2, 3].map(Exact::from);
        let expected = ["6", "15", "11", "11", "3", "11", "5/3", "1/3", "1/3"];
        let found = results(&numbers, [true; 2]).into_iter().map(|(_, x)| x);
        assert!(found.eq(expected.map(|x| x.parse().unwrap())));
    }
}
