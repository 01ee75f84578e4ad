//! Advice on the penalty: proved laws of rounding propose a method, and a run confirms it.

use super::count::count;
use super::reach::{Laws, Limits, last, least_normal, rounding_floor};
use super::{
    MAX_AUGMENTATIONS, Method, Outcome, Plane, Scalar, Solution, SolveError, State, check, exact, solve,
};
use crate::chapter::{SpringMass, contact};
use crate::number::{Exact, ExactText, PositivePart, RangeError};
use num_traits::Zero;
use rug::Integer;
use rug::float::Round;

/// Result of [`advise`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::ExactText"))]
#[non_exhaustive]
pub struct Advice<T> {
    /// Contact, grazing or separated.
    pub state: State,
    /// Tolerance in m above which every method is guaranteed to converge, see [`rounding_floor`]; a smaller
    /// one is met by chance only. `None` if nothing is guaranteed.
    pub floor: Option<Exact>,
    /// One recommendation for each method that meets the tolerance, [`Method::Lagrange`] first. If there is
    /// none, no method can be guaranteed to meet the tolerance; the deflection by Lagrange multiplier is then
    /// the closest representable one, except that an iterate near grazing may be closer by chance.
    pub recommendations: Vec<Recommendation<T>>,
}

/// A method that meets the tolerance, confirmed by a run.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::ExactText"))]
#[non_exhaustive]
pub struct Recommendation<T> {
    /// The method, as an argument for [`solve`].
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub method: Method<T>,
    /// Smallest and largest penalty ε, in N/m, between which the tolerance is guaranteed; the penalty of
    /// [`method`](Self::method) is one of them. A penalty smaller by more than a hundredth is too soft or may
    /// take more than [`MAX_AUGMENTATIONS`]. Up to the larger one, rounding changes the force ε p, or the
    /// multiplier, by at most c times the tolerance; if no sufficient penalty has this property, the larger
    /// one is the penalty of the method. `None` if the method has no penalty, or if only the range of the
    /// scalar limits it.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::options"))]
    pub penalty_range: [Option<T>; 2],
    /// Number k of augmentations needed.
    pub augmentations: Option<u64>,
    /// Exact penetration of the computed deflection, in m.
    pub penetration: Exact,
    /// Exact error of the computed contact force, in N.
    pub force_error: Exact,
    /// Exact error relative to the contact force; `None` if the force is 0.
    pub relative_force_error: Option<Exact>,
}

/// Recommends methods and penalties that compute the deflection of a system to a tolerance, in m, with
/// unilateral contact.
///
/// - The penalty method with the smallest sufficient penalty, to two digits, or with 10 c if every penalty
///   suffices.
/// - The augmentation with the fewest steps: with the largest penalty for which rounding changes the
///   multiplier by no more than the tolerance allows.
///
/// The laws in [`rounding`](crate::chapter::rounding) determine the penalties for the parameters as
/// represented in their scalar; each method is then run. A method that is not recommended cannot be
/// guaranteed.
///
/// # Errors
/// Returns the errors of [`solve`], and [`SolveError::Invalid`] if the tolerance is not positive.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::chapter::SpringMass;
/// use spring_mass_contact::solver::{Method, Outcome, advise, solve};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let advice = advise(&system, &1e-12)?;
/// let penalties = advice.recommendations.iter().map(|choice| choice.method.penalty().copied());
/// assert_eq!(penalties.collect::<Vec<_>>(), [None, Some(4.9e12), Some(7e4)]);
/// let solution = solve(&system, &advice.recommendations[2].method)?;
/// assert_eq!((solution.outcome, solution.augmentations), (Outcome::Converged, Some(3)));
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn advise<T: Scalar + ExactText>(system: &SpringMass<T>, tolerance: &T) -> Result<Advice<T>, SolveError> {
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
    Ok(Advice { state, floor, recommendations: choices })
}

/// Returns the number rounded to `digits` digits in the given direction; the number itself if its exponent
/// has more digits than the parser accepts.
fn short(x: &Exact, digits: usize, round: Round) -> Exact {
    x.decimal(digits, round).parse().unwrap_or_else(|_| x.clone())
}

/// Returns the next larger number with `digits` significant digits, at most three.
fn digits_above(x: &Exact, digits: usize) -> Exact {
    let above = short(x, digits, Round::Up);
    if above > *x { above } else { short(&(x * Exact::from(1001) / Exact::from(1000)), digits, Round::Up) }
}

/// Returns the smallest penalty, within a hundredth, that needs at most [`MAX_AUGMENTATIONS`], starting the
/// search from `eps`. A larger penalty never needs more augmentations, and a sufficiently large one always
/// converges.
fn softest(eps: &Exact, augmentations: impl Fn(&Exact) -> Option<Integer>) -> Exact {
    let in_time = |eps: &Exact| augmentations(eps).is_some_and(|most| most <= MAX_AUGMENTATIONS);
    let times = |n: i32| eps * Exact::power_of_two(n);
    let soft = if in_time(eps) {
        times(-last(|n| in_time(&times(-n))))
    } else {
        times(last(|n| !in_time(&times(n))) + 1)
    };
    // Half of it needs more; seven bisections leave an interval of 1/256 of `soft`.
    let half = Exact::power_of_two(-1);
    let bisected = (0..7).fold([&soft * &half, soft], |[below, found], _| {
        let middle = (&below + &found) * &half;
        if in_time(&middle) { [below, middle] } else { [middle, found] }
    });
    let [_, found] = bisected;
    found
}

/// The arithmetic that decides which penalties suffice.
enum Arithmetic {
    /// Contact or grazing without rounding.
    Exact,
    /// Contact or grazing, with the laws of rounding.
    Rounded(Box<Laws>),
    /// Separated: every method computes m g / c.
    Free,
}

/// A system, a tolerance, and the arithmetic.
struct Task<'a, T> {
    system: &'a SpringMass<T>,
    tolerance: &'a T,
    /// The exact system and the deflection to be computed.
    numbers: SpringMass<Exact>,
    tol: Exact,
    answer: Exact,
    /// Whether the tolerance is above the rounding floor.
    promised: bool,
    arithmetic: Arithmetic,
}

impl<T: Scalar + ExactText> Task<'_, T> {
    /// Returns the penalty method and the augmentation, if they can be guaranteed.
    fn iterative(&self) -> Vec<Recommendation<T>> {
        // If the penalty method does not meet the tolerance, the augmentation is not guaranteed to meet it.
        let Some(limits) = self.penalties() else { return Vec::new() };
        let any_will_do = limits.from.is_zero();
        let eps = if any_will_do { Exact::from(10) * &self.numbers.c } else { digits_above(&limits.from, 2) };
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

    /// Returns the augmentation with the largest penalty that preserves the digits of the multiplier, but not
    /// larger than one that needs no augmentation. If it is too small, returns that with the smallest
    /// sufficient penalty.
    fn augmentation(&self, none_needed: Exact, any_will_do: bool) -> Option<Recommendation<T>> {
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
            // With a smaller penalty rounding near grazing could turn separation into contact.
            Arithmetic::Free => self.numbers.c.clone(),
        };
        let eps = std::cmp::max(eps, short(&from, 2, Round::Up));
        self.choice(&Limits { from, to }, &eps, |penalty| {
            let (tolerance, max_augmentations) = (self.tolerance.clone(), MAX_AUGMENTATIONS);
            Method::Augmented { penalty, tolerance, max_augmentations, start: T::zero() }
        })
    }

    /// Returns the recommendation for this penalty, with its range, if the method meets the tolerance.
    fn choice(
        &self,
        limits: &Limits,
        eps: &Exact,
        method: impl Fn(T) -> Method<T>,
    ) -> Option<Recommendation<T>> {
        // Rounded to nearest, unless the result is too small.
        let nearest = self.tolerance.round_from_exact(eps).ok()?;
        let eps = if exact(&nearest) > limits.from { nearest } else { self.directed(eps, true).ok()? };
        let choice = self.tried(method(eps.clone()))?;
        // A count replaces the run in rationals, whose length would grow.
        let counted = matches!(self.arithmetic, Arithmetic::Exact) && choice.augmentations.is_some();
        let reaches = |eps: &T| counted || self.tried(method(eps.clone())).is_some();
        // Rounded inwards; if it does not fit, or underflow or overflow invalidates the law, the bound is ε
        // itself.
        let end = |x: &Exact, up: bool| {
            let end = self.directed(x, up).ok().filter(|end| if up { *end < eps } else { *end > eps });
            end.filter(reaches).unwrap_or_else(|| eps.clone())
        };
        // A rational penalty at the limit of the penalty method is not sufficient yet.
        let at_limit = matches!(self.arithmetic, Arithmetic::Exact) && !counted;
        let least = if at_limit { &digits_above(&limits.from, 3) } else { &limits.from };
        let from = (!limits.from.is_zero()).then(|| end(least, true));
        Some(Recommendation { penalty_range: [from, limits.to.as_ref().map(|to| end(to, false))], ..choice })
    }

    /// Rounds into the scalar, up or down.
    fn directed(&self, x: &Exact, up: bool) -> Result<T, RangeError> {
        let (nearest, ordering) = self.tolerance.round_from_exact_with_ordering(x)?;
        let [below, above] = nearest.neighbours();
        Ok(match (up, ordering) {
            (true, std::cmp::Ordering::Less) => above,
            (false, std::cmp::Ordering::Greater) => below,
            _ => nearest,
        })
    }

    /// Runs a method and returns its recommendation if it meets the tolerance.
    fn tried(&self, method: Method<T>) -> Option<Recommendation<T>> {
        let solution = solve(self.system, &method).ok()?;
        self.reached(method, &solution)
    }

    /// Returns the recommendation for a solution that has been computed.
    fn reached(&self, method: Method<T>, solution: &Solution<T>) -> Option<Recommendation<T>> {
        let (u, n) = (exact(&solution.deflection), exact(&solution.contact_force));
        let reaches = match solution.outcome {
            Outcome::Direct => (&u - &self.answer).abs() < self.tol,
            outcome => outcome == Outcome::Converged,
        };
        let force = contact::contact_force(&self.numbers);
        let force_error = (n - &force).abs();
        reaches.then(|| Recommendation {
            method,
            penalty_range: [None, None],
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

    /// A penalty of 1 takes exactly the allowed number, 2 takes fewer, and below 1/2 the iteration does not
    /// converge.
    #[test]
    fn the_smallest_penalty_is_found_from_any_start() {
        let [half, one, two] = ["1/2", "1", "2"].map(|x| x.parse::<Exact>().unwrap());
        let needed = |eps: &Exact| {
            let more = i32::from(*eps < one) - i32::from(*eps >= two);
            (*eps >= half).then(|| Integer::from(MAX_AUGMENTATIONS) + more)
        };
        for from in ["1e-99", "1/3", "0.999", "1", "1.001", "1.3", "2", "7", "1e99"] {
            let found = softest(&from.parse().unwrap(), needed);
            assert!(one <= found && found < &one + &one / Exact::from(100), "{found} from {from}");
        }
    }
}
