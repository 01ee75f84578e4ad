//! Advice on the penalty: proved laws of rounding propose a method, and a run confirms it.

use super::count::count;
use super::guarantees::{last_where, rounding_floor};
use super::rounding_laws::{PenaltyRange, RoundingLaws, min_normal};
use super::{
    MAX_AUGMENTATIONS, Method, Outcome, Plane, Scalar, Solution, SolveError, State, exact, solve, validate,
};
use crate::chapter::{SpringMass, contact, penalty};
use crate::number::{Exact, ExactText, PositivePart};
use num_traits::Zero;
use rug::Integer;
use rug::float::Round;
use std::cmp::Ordering;

/// Result of [`advise`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
///   suffices; with c or c/100 if the scalar cannot represent the total stiffness.
/// - The augmentation with the smallest penalty, to two digits, that is guaranteed to need at most ten steps,
///   or with that of the penalty method if every penalty suffices. Without rounding this penalty is the
///   smallest ε with (1 + ε/c)¹¹ > R/(c tol), which makes p₁₀ = R/(c + ε) (1 + ε/c)⁻¹⁰ smaller than the tolerance. If rounding
///   with it would change the multiplier by more than the tolerance allows, the augmentation has the fewest
///   steps: the penalty is the largest one, to one digit, without this effect.
///
/// The laws in [`rounding`](crate::chapter::rounding) determine the penalties for the parameters as
/// represented in their scalar; each method is then run. A method that is not recommended cannot be
/// guaranteed. A penalty has the precision of the coarsest parameter.
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
/// assert_eq!(penalties.collect::<Vec<_>>(), [None, Some(4.9e12), Some(840.0)]);
/// let solution = solve(&system, &advice.recommendations[2].method)?;
/// assert_eq!((solution.outcome, solution.augmentations), (Outcome::Converged, Some(10)));
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn advise<T: Scalar + ExactText>(system: &SpringMass<T>, tolerance: &T) -> Result<Advice<T>, SolveError> {
    validate::positive("tolerance", tolerance)?;
    let by_multiplier = solve(system, &Method::Lagrange)?;
    let state = by_multiplier.state;
    let (exact_system, exact_tolerance) = (system.as_ref().map(exact), exact(tolerance));
    // The coarsest parameter determines the precision, also that of a recommended penalty.
    let SpringMass { c, m, g, l, h } = system;
    let coarsest = [c, m, g, l, h].into_iter().max_by_key(|x| x.number_system().unit_roundoff());
    let coarsest = coarsest.expect("five parameters");
    let eta = coarsest.number_system().unit_roundoff();
    let floor = rounding_floor(system, Plane::Unilateral, &eta)?;
    let advisor = Advisor {
        system,
        tolerance,
        coarsest,
        exact_deflection: contact::deflection(&exact_system),
        is_above_floor: floor.as_ref().is_some_and(|floor| exact_tolerance > *floor),
        arithmetic: match RoundingLaws::new(&exact_system, &eta, &min_normal(coarsest)) {
            _ if state == State::Separated => Arithmetic::Separated,
            Some(laws) => Arithmetic::Rounded(Box::new(laws)),
            None => Arithmetic::Exact,
        },
        exact_system,
        exact_tolerance,
    };
    let mut recommendations = Vec::from_iter(advisor.assess(Method::Lagrange, &by_multiplier));
    if !recommendations.is_empty() {
        recommendations.extend(advisor.recommend_penalty_and_augmentation());
    }
    Ok(Advice { state, floor, recommendations })
}

/// Returns the number rounded to `digits` digits in the given direction; the number itself if its exponent
/// has more digits than the parser accepts.
fn round_to_digits(x: &Exact, digits: usize, round: Round) -> Exact {
    x.decimal(digits, round).parse().unwrap_or_else(|_| x.clone())
}

/// Returns the next larger number with `digits` significant digits, at most three.
fn next_above(x: &Exact, digits: usize) -> Exact {
    let rounded_up = round_to_digits(x, digits, Round::Up);
    if rounded_up > *x {
        return rounded_up;
    }
    round_to_digits(&(x * Exact::from(1001) / Exact::from(1000)), digits, Round::Up)
}

/// Largest number of steps of a recommended augmentation, unless its penalty would be too large.
const RECOMMENDED_AUGMENTATIONS: u64 = 10;

/// Returns the smallest penalty, within a hundredth, that suffices, starting the search from `eps`; if one
/// suffices, so does every larger one, and a sufficiently large one has to exist.
fn min_penalty(eps: &Exact, suffices: impl Fn(&Exact) -> bool) -> Exact {
    let scaled = |n: i32| eps * Exact::power_of_two(n);
    let sufficient = if suffices(eps) {
        scaled(-last_where(|n| suffices(&scaled(-n))))
    } else {
        scaled(last_where(|n| !suffices(&scaled(n))) + 1)
    };
    // Half of it is too small; seven bisections leave an interval of 1/256 of it.
    let half = Exact::power_of_two(-1);
    let mut interval = [&sufficient * &half, sufficient];
    for _ in 0..7 {
        let [too_small, sufficient] = interval;
        let middle = (&too_small + &sufficient) * &half;
        interval = if suffices(&middle) { [too_small, middle] } else { [middle, sufficient] };
    }
    let [_, sufficient] = interval;
    sufficient
}

/// The arithmetic that determines which penalties suffice.
enum Arithmetic {
    /// Contact or grazing without rounding.
    Exact,
    /// Contact or grazing, with the laws of rounding.
    Rounded(Box<RoundingLaws>),
    /// Separated: every method computes m g / c.
    Separated,
}

/// A system with a tolerance, and all that is known about them before a method is run.
struct Advisor<'a, T> {
    system: &'a SpringMass<T>,
    tolerance: &'a T,
    /// The parameter to whose precision penalties are rounded.
    coarsest: &'a T,
    exact_system: SpringMass<Exact>,
    exact_tolerance: Exact,
    exact_deflection: Exact,
    /// Whether the tolerance is above the rounding floor.
    is_above_floor: bool,
    arithmetic: Arithmetic,
}

impl<T: Scalar + ExactText> Advisor<'_, T> {
    /// Returns the penalty method and the augmentation, if they can be guaranteed.
    fn recommend_penalty_and_augmentation(&self) -> Vec<Recommendation<T>> {
        // If the penalty method does not meet the tolerance, the augmentation is not guaranteed to meet it.
        let Some(range) = self.penalty_range() else { return Vec::new() };
        let all_suffice = range.min.is_zero();
        let eps = if all_suffice { self.any_penalty() } else { next_above(&range.min, 2) };
        let penalty =
            self.recommend(&range, &eps, |eps| *eps > range.min, |penalty| Method::Penalty { penalty });
        let augmentation = self.is_above_floor.then(|| self.recommend_augmentation(&eps, all_suffice));
        [penalty, augmentation.flatten()].into_iter().flatten().collect()
    }

    /// Returns 10 c, or less if c + ε is out of the range of the scalar.
    fn any_penalty(&self) -> Exact {
        let c = &self.exact_system.c;
        let penalties = [1000, 100, 1].map(|percent| c * Exact::from(percent) / Exact::from(100));
        penalties.into_iter().find(|eps| self.is_in_range(eps)).unwrap_or_else(|| c.clone())
    }

    /// Returns `true` if the scalar can represent c + ε.
    fn is_in_range(&self, eps: &Exact) -> bool {
        self.coarsest.round_from_exact(&penalty::total_stiffness(&self.exact_system, eps)).is_ok()
    }

    /// Returns the penalties for which the penalty method meets the tolerance, if there are any.
    fn penalty_range(&self) -> Option<PenaltyRange> {
        match &self.arithmetic {
            Arithmetic::Exact => Some(PenaltyRange::exact(&self.exact_system, &self.exact_tolerance)),
            Arithmetic::Rounded(laws) => laws.penalty_range(&self.exact_tolerance),
            Arithmetic::Separated => Some(PenaltyRange { min: Exact::zero(), max: None }),
        }
    }

    /// Returns the augmentation with the smallest two-digit penalty that needs at most
    /// [`RECOMMENDED_AUGMENTATIONS`], or with `direct_eps` if every penalty suffices. If that is too large to
    /// preserve the digits of the multiplier, returns the largest penalty that does, or the smallest that needs
    /// at most [`MAX_AUGMENTATIONS`] if it is larger.
    fn recommend_augmentation(&self, direct_eps: &Exact, all_suffice: bool) -> Option<Recommendation<T>> {
        let is_quick = |eps: &Exact| self.takes_at_most(RECOMMENDED_AUGMENTATIONS, eps);
        let is_admissible = |eps: &Exact| self.takes_at_most(MAX_AUGMENTATIONS, eps);
        let max = match &self.arithmetic {
            Arithmetic::Rounded(laws) => laws.max_penalty_for_multiplier(&self.exact_tolerance),
            Arithmetic::Exact | Arithmetic::Separated => None,
        };
        let min = match &self.arithmetic {
            Arithmetic::Exact if all_suffice => Exact::zero(),
            Arithmetic::Exact | Arithmetic::Rounded(_) => min_penalty(direct_eps, is_admissible),
            // With a smaller penalty rounding near grazing could turn separation into contact.
            Arithmetic::Separated => self.exact_system.c.clone(),
        };
        let eps = if all_suffice {
            direct_eps.clone()
        } else {
            let least = min_penalty(direct_eps, is_quick);
            let below = round_to_digits(&least, 2, Round::Down);
            if is_quick(&below) { below } else { round_to_digits(&least, 2, Round::Up) }
        };
        let eps = match &max {
            Some(max) if *max > Exact::zero() && *max < eps => round_to_digits(max, 1, Round::Down),
            Some(_) | None => eps,
        };
        let eps = eps.max(round_to_digits(&min, 2, Round::Up));
        let suffices = |x: &Exact| if is_quick(&eps) { is_quick(x) } else { is_admissible(x) };
        self.recommend(&PenaltyRange { min, max }, &eps, suffices, |penalty| Method::Augmented {
            penalty,
            tolerance: self.tolerance.clone(),
            max_augmentations: MAX_AUGMENTATIONS,
            start: T::zero(),
        })
    }

    /// Returns `true` if at most `limit` augmentations with this penalty are guaranteed to meet the tolerance.
    fn takes_at_most(&self, limit: u64, eps: &Exact) -> bool {
        let count = match &self.arithmetic {
            Arithmetic::Rounded(laws) => laws.max_augmentations(eps, &self.exact_tolerance).ok().flatten(),
            Arithmetic::Exact | Arithmetic::Separated => self.exact_count(eps),
        };
        count.is_some_and(|k| k <= limit)
    }

    /// Returns the number of augmentations in exact arithmetic, unless it has too many digits.
    fn exact_count(&self, eps: &Exact) -> Option<Integer> {
        count(&self.exact_system, eps, &self.exact_tolerance, &Exact::zero(), Plane::Unilateral).ok()
    }

    /// Returns the recommendation for this penalty, with its range, if the method meets the tolerance.
    fn recommend(
        &self,
        range: &PenaltyRange,
        eps: &Exact,
        suffices: impl Fn(&Exact) -> bool,
        method: impl Fn(T) -> Method<T>,
    ) -> Option<Recommendation<T>> {
        // Rounded to nearest, unless the result is too small.
        let nearest = self.coarsest.round_from_exact(eps).ok()?;
        let eps = if suffices(&exact(&nearest)) { nearest } else { self.round(eps, Round::Up)? };
        let recommendation = self.run(method(eps.clone()))?;
        // A count replaces the run in rationals, whose length would grow.
        let is_exact = matches!(self.arithmetic, Arithmetic::Exact);
        let is_counted = is_exact && recommendation.augmentations.is_some();
        let meets_tolerance = |eps: &T| is_counted || self.run(method(eps.clone())).is_some();
        // A rational penalty at the limit of the penalty method is not sufficient yet.
        let is_limit_excluded = is_exact && !is_counted;
        let min = if is_limit_excluded { &next_above(&range.min, 3) } else { &range.min };
        let min = (!range.min.is_zero()).then(|| self.confirmed_limit(min, Round::Up, &eps, meets_tolerance));
        let max = range.max.as_ref().filter(|max| self.is_in_range(max));
        let max = max.map(|max| self.confirmed_limit(max, Round::Down, &eps, meets_tolerance));
        Some(Recommendation { penalty_range: [min, max], ..recommendation })
    }

    /// Returns a limit of the range of ε, rounded inwards; or ε itself if the result is not beyond ε, or if
    /// the method does not meet the tolerance there, because underflow or overflow invalidates the law.
    fn confirmed_limit(
        &self,
        limit: &Exact,
        inwards: Round,
        eps: &T,
        meets_tolerance: impl Fn(&T) -> bool,
    ) -> T {
        let rounded = self.round(limit, inwards);
        rounded
            .filter(|end| if inwards == Round::Up { end < eps } else { end > eps })
            .filter(meets_tolerance)
            .unwrap_or_else(|| eps.clone())
    }

    /// Rounds into the scalar, up or down; returns `None` out of its range.
    fn round(&self, x: &Exact, direction: Round) -> Option<T> {
        let (nearest, ordering) = self.coarsest.round_from_exact_with_ordering(x).ok()?;
        let [below, above] = nearest.neighbours();
        Some(match (direction, ordering) {
            (Round::Up, Ordering::Less) => above,
            (Round::Down, Ordering::Greater) => below,
            _ => nearest,
        })
    }

    /// Runs a method and returns its recommendation if it meets the tolerance.
    fn run(&self, method: Method<T>) -> Option<Recommendation<T>> {
        let solution = solve(self.system, &method).ok()?;
        self.assess(method, &solution)
    }

    /// Returns the recommendation of a method for its solution if it meets the tolerance.
    fn assess(&self, method: Method<T>, solution: &Solution<T>) -> Option<Recommendation<T>> {
        let (u, n) = (exact(&solution.deflection), exact(&solution.contact_force));
        let meets_tolerance = match solution.outcome {
            Outcome::Direct => (&u - &self.exact_deflection).abs() < self.exact_tolerance,
            outcome => outcome == Outcome::Converged,
        };
        let force = contact::contact_force(&self.exact_system);
        let force_error = (n - &force).abs();
        meets_tolerance.then(|| Recommendation {
            method,
            penalty_range: [None, None],
            augmentations: solution.augmentations,
            penetration: contact::penetration(&self.exact_system, &u),
            relative_force_error: (!force.is_zero()).then(|| &force_error / force),
            force_error,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_penalty_is_found_from_any_start() {
        let one = Exact::from(1);
        for from in ["1e-99", "1/3", "0.999", "1", "1.001", "1.3", "2", "7", "1e99"] {
            let found = min_penalty(&from.parse().unwrap(), |eps| *eps >= one);
            assert!(one <= found && found < &one + &one / Exact::from(100), "{found} from {from}");
        }
    }

    #[test]
    fn the_next_number_with_few_digits_is_the_least_one_above() {
        for (x, next) in [("1.2395", "1.24"), ("1.24", "1.25"), ("9.99", "10"), ("0.0099901", "0.01")] {
            assert_eq!(next_above(&x.parse().unwrap(), 3), next.parse().unwrap(), "{x}");
        }
    }

    /// p = R/(c + ε) = 1/4 for ε = 4, and the tolerance has to exceed it.
    #[test]
    fn an_error_equal_to_the_tolerance_does_not_meet_it() {
        let system = SpringMass { c: 4, m: 1, g: 10, l: 1, h: 3 }.map(Exact::from);
        let tolerance = Exact::power_of_two(-2);
        let advisor = Advisor {
            system: &system,
            tolerance: &tolerance,
            coarsest: &system.c,
            exact_deflection: contact::deflection(&system),
            is_above_floor: true,
            arithmetic: Arithmetic::Exact,
            exact_system: system.clone(),
            exact_tolerance: tolerance.clone(),
        };
        let meets = |eps| advisor.run(Method::Penalty { penalty: Exact::from(eps) }).is_some();
        assert!(!meets(4) && meets(5));
    }
}
