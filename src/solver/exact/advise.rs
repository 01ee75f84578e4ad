//! Which penalty, and what it gives: the laws of rounding propose, a run confirms.

use super::count::count;
use super::reach::{Laws, Limits, last, least_normal, rounding_floor};
use super::{
    MAX_AUGMENTATIONS, Method, Outcome, Plane, Scalar, Solution, SolveError, State, check, exact, solve,
};
use crate::chapter::{SpringMass, contact};
use crate::number::{Exact, PositivePart, RangeError, Text};
use num_traits::Zero;
use rug::Integer;
use rug::float::Round;
use std::iter::successors;

/// What [`advise`] comes to.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::Text"))]
#[non_exhaustive]
pub struct Advice<T> {
    /// Contact, grazing or separated.
    pub state: State,
    /// The tolerance in m above which every method is promised to come, as [`rounding_floor`] says; below it
    /// by luck. None where none is promised.
    pub floor: Option<Exact>,
    /// A method each that reaches the tolerance, [`Method::Lagrange`] first. Where there is none, no method
    /// ends within the tolerance and says so: Lagrange's deflection is the nearest that the scalar has, or,
    /// where the mass hangs free, that of all methods, but for an iterate near grazing that luck brings
    /// nearer.
    pub choices: Vec<Choice<T>>,
}

/// A method that reaches the tolerance: it has been tried.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::Text"))]
#[non_exhaustive]
pub struct Choice<T> {
    /// To be given to [`solve`].
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub method: Method<T>,
    /// Every penalty ε in N/m between these is sure to reach the tolerance, [`method`](Self::method)'s
    /// among them. A smaller one is not: it is too soft, or may take more than [`MAX_AUGMENTATIONS`]. Up to
    /// the larger one rounding takes no more from the force ε p, or from the multiplier, than c times the
    /// tolerance; if it may take more with every one that will do, or with all but the softest, the
    /// larger one is the method's own. From the deflection it takes no more at any. None where there is
    /// no penalty, or no limit but the range of the scalar.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::options"))]
    pub penalties: [Option<T>; 2],
    /// k of the augmentation that arrives.
    pub augmentations: Option<u64>,
    /// p of the deflection that is found, in m, exactly: what a run computes of it is rounded.
    pub penetration: Exact,
    /// How far the contact force that is found is off, in N, exactly.
    pub force_error: Exact,
    /// The same in parts of the force; none where there is no force.
    pub relative_force_error: Option<Exact>,
}

/// Which method with which penalty finds the deflection of a system to a tolerance, in m, over a plane that
/// never pulls.
///
/// - The penalty method with the softest penalty that will do, to two digits; where every one will do, 10 c.
/// - The augmentation with the fewest steps that leave the multiplier its digits: with the hardest penalty of
///   which rounding takes no more from the multiplier than the tolerance does.
///
/// The laws of [`rounding`](crate::chapter::rounding) find them, for parameters as they are in their scalar;
/// each is then run. What is not in the advice cannot be promised.
///
/// # Errors
/// As [`solve`], and [`SolveError::Invalid`] for a tolerance that is not positive.
///
/// ```
/// use spring_mass_contact::chapter::SpringMass;
/// use spring_mass_contact::solver::{Method, Outcome, advise, solve};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let advice = advise(&system, &1e-12)?;
/// let penalties: Vec<_> = advice.choices.iter().map(|choice| choice.method.penalty().copied()).collect();
/// assert_eq!(penalties, [None, Some(4.9e12), Some(7e4)]);
/// let solution = solve(&system, &advice.choices[2].method)?;
/// assert_eq!((solution.outcome, solution.augmentations), (Outcome::Converged, Some(3)));
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn advise<T: Scalar + Text>(system: &SpringMass<T>, tolerance: &T) -> Result<Advice<T>, SolveError> {
    check::positive("tolerance", tolerance)?;
    let solution = solve(system, &Method::Lagrange)?;
    let state = solution.state;
    let (numbers, tol) = (system.map(exact), exact(tolerance));
    let SpringMass { c, m, g, l, h } = system;
    let eta = [c, m, g, l, h].map(|x| x.number_system().unit_roundoff()).into_iter().max();
    let eta = eta.expect("five parameters");
    let floor = rounding_floor(system, Plane::Unilateral, &eta)?;
    let promised = floor.as_ref().is_some_and(|floor| tol > *floor);
    let arithmetic = match Laws::of(&numbers, &eta, &least_normal(tolerance)) {
        _ if state == State::Separated => Arithmetic::Free,
        Some(laws) => Arithmetic::Rounded(Box::new(laws)),
        None => Arithmetic::Exact,
    };
    let answer = contact::deflection(&numbers);
    let task = Task { system, tolerance, tol, answer, numbers, promised, arithmetic };
    let mut choices = Vec::from_iter(task.reached(Method::Lagrange, &solution));
    if !choices.is_empty() {
        choices.extend(task.iterative());
    }
    Ok(Advice { state, floor, choices })
}

/// A number of so few digits, on the side that the rounding says; the number itself where that has an
/// exponent of more digits than are read.
fn short(x: &Exact, digits: usize, round: Round) -> Exact {
    x.decimal(digits, round).parse().unwrap_or_else(|_| x.clone())
}

/// A larger number, of two digits.
fn two_digits_above(x: &Exact) -> Exact {
    let above = short(x, 2, Round::Up);
    if above > *x { above } else { short(&(x * Exact::from(101) / Exact::from(100)), 2, Round::Up) }
}

/// The softest penalty that takes no more than [`MAX_AUGMENTATIONS`], within a tenth; looked for from this
/// one on. A harder one takes no more than a softer one, and a hard one is sure to arrive.
fn softest(eps: &Exact, augmentations: impl Fn(&Exact) -> Option<Integer>) -> Exact {
    let in_time = |eps: &Exact| augmentations(eps).is_some_and(|most| most <= MAX_AUGMENTATIONS);
    let times = |n: i32| eps * Exact::power_of_two(n);
    let soft = if in_time(eps) {
        times(-last(|n| in_time(&times(-n))))
    } else {
        times(last(|n| !in_time(&times(n))) + 1)
    };
    // 1.1⁸ > 2.
    let tenth = Exact::from(10) / Exact::from(11);
    let softer = successors(Some(soft), |eps| Some(eps * &tenth));
    softer.take_while(in_time).last().expect("the first one is")
}

/// What decides which penalties will do.
enum Arithmetic {
    /// Mass and plane touch, and nothing is rounded.
    Exact,
    /// They touch, and these are the laws of what is rounded.
    Rounded(Box<Laws>),
    /// The mass hangs free: every method computes m g / c.
    Free,
}

/// What is to be solved, and how well.
struct Task<'a, T> {
    system: &'a SpringMass<T>,
    tolerance: &'a T,
    /// The same, exactly, with the deflection to be found.
    numbers: SpringMass<Exact>,
    tol: Exact,
    answer: Exact,
    /// Is the tolerance above the floor?
    promised: bool,
    arithmetic: Arithmetic,
}

impl<T: Scalar + Text> Task<'_, T> {
    /// The penalty method and the augmentation, if they can be promised.
    fn iterative(&self) -> Vec<Choice<T>> {
        // Where this does not reach the tolerance, it is not promised to the augmentation.
        let Some(limits) = self.penalties() else { return Vec::new() };
        let any_will_do = limits.from.is_zero();
        let eps =
            if any_will_do { Exact::from(10) * &self.numbers.c } else { two_digits_above(&limits.from) };
        let penalty = self.choice(&limits, &eps, |penalty| Method::Penalty { penalty });
        let augmentation = self.promised.then(|| self.augmentation(eps, any_will_do));
        [penalty, augmentation.flatten()].into_iter().flatten().collect()
    }

    fn penalties(&self) -> Option<Limits> {
        match &self.arithmetic {
            Arithmetic::Exact => Some(Limits::exact(&self.numbers, &self.tol)),
            Arithmetic::Rounded(laws) => laws.penalties(&self.tol),
            Arithmetic::Free => Some(Limits { from: Exact::zero(), to: None }),
        }
    }

    /// The augmentation with the hardest penalty that leaves the multiplier its digits, but no harder than
    /// one with which there is nothing to augment; if that is too soft, with the softest that will do.
    fn augmentation(&self, none_needed: Exact, any_will_do: bool) -> Option<Choice<T>> {
        let to = match &self.arithmetic {
            Arithmetic::Rounded(laws) => laws.hardest_augmentation(&self.tol),
            Arithmetic::Exact | Arithmetic::Free => None,
        };
        let eps = match &to {
            Some(to) if *to > Exact::zero() => std::cmp::min(short(to, 1, Round::Down), none_needed),
            Some(_) | None => none_needed,
        };
        let (zero, plane) = (Exact::zero(), Plane::Unilateral);
        let from = match &self.arithmetic {
            Arithmetic::Exact if any_will_do => zero,
            Arithmetic::Exact => softest(&eps, |eps| count(&self.numbers, eps, &self.tol, &zero, plane).ok()),
            Arithmetic::Rounded(laws) => {
                softest(&eps, |eps| laws.augmentations_at_most(eps, &self.tol).ok()?)
            }
            // Softer than that, rounding near grazing could take it for touching.
            Arithmetic::Free => self.numbers.c.clone(),
        };
        let eps = std::cmp::max(eps, short(&from, 2, Round::Up));
        self.choice(&Limits { from, to }, &eps, |penalty| {
            let (tolerance, max_augmentations) = (self.tolerance.clone(), MAX_AUGMENTATIONS);
            Method::Augmented { penalty, tolerance, max_augmentations, start: T::zero() }
        })
    }

    /// The choice with this penalty, if it reaches the tolerance, with the limits that do so too.
    fn choice(&self, limits: &Limits, eps: &Exact, method: impl Fn(T) -> Method<T>) -> Option<Choice<T>> {
        // To the nearest, unless that is down to what is too soft.
        let nearest = self.tolerance.nearest(eps).ok()?;
        let eps = if exact(&nearest) > limits.from { nearest } else { self.directed(eps, true).ok()? };
        let choice = self.tried(method(eps.clone()))?;
        // In rationals the count is the run, whose numbers would become long.
        let counted = matches!(self.arithmetic, Arithmetic::Exact) && choice.augmentations.is_some();
        let reaches = |eps: &T| counted || self.tried(method(eps.clone())).is_some();
        // Rounded inwards; where it does not fit, or under- and overflow break the law, no further than ε.
        let end = |x: &Exact, up: bool| {
            let end = self.directed(x, up).ok().filter(|end| if up { *end < eps } else { *end > eps });
            end.filter(reaches).unwrap_or_else(|| eps.clone())
        };
        let from = (!limits.from.is_zero()).then(|| end(&limits.from, true));
        Some(Choice { penalties: [from, limits.to.as_ref().map(|to| end(to, false))], ..choice })
    }

    /// Rounded into the scalar, up or down.
    fn directed(&self, x: &Exact, up: bool) -> Result<T, RangeError> {
        let (nearest, ordering) = self.tolerance.nearest_compared(x)?;
        let [below, above] = nearest.neighbours();
        Ok(match (up, ordering) {
            (true, std::cmp::Ordering::Less) => above,
            (false, std::cmp::Ordering::Greater) => below,
            _ => nearest,
        })
    }

    /// A method, if it reaches the tolerance, with what it gives.
    fn tried(&self, method: Method<T>) -> Option<Choice<T>> {
        let solution = solve(self.system, &method).ok()?;
        self.reached(method, &solution)
    }

    /// The same of a method that has been run.
    fn reached(&self, method: Method<T>, solution: &Solution<T>) -> Option<Choice<T>> {
        let (u, n) = (exact(&solution.deflection), exact(&solution.contact_force));
        let reaches = match solution.outcome {
            Outcome::Direct => (&u - &self.answer).abs() < self.tol,
            outcome => outcome == Outcome::Converged,
        };
        let force = contact::contact_force(&self.numbers);
        let force_error = (n - &force).abs();
        reaches.then(|| Choice {
            method,
            penalties: [None, None],
            augmentations: solution.augmentations,
            penetration: contact::penetration(&self.numbers, &u),
            relative_force_error: (!force.is_zero()).then(|| &force_error / force),
            force_error,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 1 on it takes as many as are allowed, from 2 on fewer; below 1/2 it never arrives.
    #[test]
    fn the_softest_is_found_from_wherever_it_is_looked_for() {
        let [half, one, two] = ["1/2", "1", "2"].map(|x| x.parse::<Exact>().unwrap());
        let needed = |eps: &Exact| {
            let more = i32::from(*eps < one) - i32::from(*eps >= two);
            (*eps >= half).then(|| Integer::from(MAX_AUGMENTATIONS) + more)
        };
        for from in ["1e-99", "1/3", "0.999", "1", "1.001", "1.3", "2", "7", "1e99"] {
            let found = softest(&from.parse().unwrap(), needed);
            assert!(one <= found && found < &one + &one / Exact::from(10), "{found} from {from}");
        }
    }
}
