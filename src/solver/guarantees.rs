//! Guarantees before a run: attainable tolerances, sufficient numbers of augmentations, required precision.
//!
//! [`RoundingLaws`] derives them from the laws of the book's page on floating point.

use super::count::count;
use super::rounding_laws::{RoundingLaws, min_normal};
use super::{Plane, Scalar, SolveError, exact, validate};
use crate::chapter::SpringMass;
use crate::number::{Exact, PRECISIONS, ToExact};
use num_traits::Zero;
use rug::Integer;

/// Returns `true` if floats of this scalar are guaranteed to meet the tolerance from λ₀ = 0 in contact or
/// grazing.
///
/// The condition is 64 (c + ε) ≤ ε (1 + 1/η) and tol > 20 F + η (|H| + 8 tol), with the drift 20 F of
/// [`rounding::penetration_drift`](crate::chapter::rounding::penetration_drift), which is proved for
/// unilateral and for bilateral contact. A smaller tolerance may be met by chance. Rationals meet every
/// tolerance.
///
/// Machine floats below their smallest normal number ν are rounded by more than η relative to themselves.
/// Therefore floats of limited range also require a weight of 0 or at least ν, a gap of 0 or ε |Δ| ≥ 2 ν,
/// lengths H and l of 0 or at least 4 ν / η, and a tolerance of at least 4 ν, and the drift increases by
/// ν (2 + 1/ε). No result below ν then occurs before the tolerance is met.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter, the penalty, the tolerance or the unit roundoff is not
/// finite or out of its range.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact};
/// # use spring_mass_contact::solver::{Method, Outcome, solve, is_convergence_guaranteed};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let eta = Exact::power_of_two(-53);
/// let ends = |tolerance| {
///     let method = Method::Augmented { penalty: 1.0, tolerance, max_augmentations: 10_000, start: 0.0 };
///     let guaranteed = is_convergence_guaranteed(&system, &1.0, &tolerance, &eta)?;
///     Ok((guaranteed, solve(&system, &method)?.outcome))
/// };
/// assert_eq!(ends(1e-13)?, (true, Outcome::Converged));
/// assert_eq!(ends(1e-14)?, (false, Outcome::Converged)); // luck
/// assert_eq!(ends(1e-16)?, (false, Outcome::Stagnated)); // less than η H
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn is_convergence_guaranteed<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<bool, SolveError> {
    validate_arguments(system, eps, tolerance, unit_roundoff)?;
    let laws = RoundingLaws::new(&system.as_ref().map(exact), unit_roundoff, &min_normal(&system.c));
    Ok(laws.is_none_or(|laws| laws.is_convergence_guaranteed(&exact(eps), &exact(tolerance))))
}

/// Returns an upper bound on the number of augmentations that floats of this unit roundoff need to meet the
/// tolerance from λ₀ = 0 in contact or grazing; `None` if convergence is not
/// [guaranteed](is_convergence_guaranteed).
///
/// The bound is the exact count for the part of the tolerance that exceeds 20 F + η (|H| + 8 tol); for
/// rationals, for the tolerance itself.
///
/// # Errors
/// Returns the errors of [`is_convergence_guaranteed`], and [`SolveError::TooLong`] if the count has too many
/// digits.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::guaranteed_max_augmentations};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let eta = Exact::power_of_two(-53);
/// let bound = |tolerance| guaranteed_max_augmentations(&system, &100.0, &tolerance, &eta);
/// assert_eq!(bound(1e-12)?, Some(35.into())); // as many as without rounding
/// assert_eq!(bound(3e-15)?, Some(47.into())); // 43 without rounding
/// assert_eq!(bound(1e-15)?, None);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn guaranteed_max_augmentations<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<Option<Integer>, SolveError> {
    validate_arguments(system, eps, tolerance, unit_roundoff)?;
    let (exact_system, eps, tolerance) = (system.as_ref().map(exact), exact(eps), exact(tolerance));
    match RoundingLaws::new(&exact_system, unit_roundoff, &min_normal(&system.c)) {
        Some(laws) => laws.max_augmentations(&eps, &tolerance),
        None => count(&exact_system, &eps, &tolerance, &Exact::zero(), Plane::Bilateral).map(Some),
    }
}

/// Returns the rounding floor, in m: every larger tolerance is met by each method in floats of this unit
/// roundoff with a sufficiently large penalty. Returns `None` if no tolerance is guaranteed (5 bits and
/// fewer, or numbers so small that results may underflow).
///
/// It is the limit of [`is_convergence_guaranteed`] for ε → ∞. If the mass is separated it is 5 η |m g / c|,
/// and the sum of both near grazing, where |R| / c is at most the first and twice the second. Overflow is
/// excluded; a smaller tolerance may be met by chance.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter or the unit roundoff is not finite or out of its range.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, rounding_floor}};
/// let system = SpringMass { c: 4, m: 1, g: 10, l: 1, h: 3 };
/// let system = system.map(Exact::from);
/// let floor = rounding_floor(&system, Plane::Unilateral, &Exact::power_of_two(-10))?;
/// assert_eq!(floor, Some("103/1016".parse()?)); // (20 η (3 + 2) + 3 η) / (1 − 8 η)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rounding_floor<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    plane: Plane,
    unit_roundoff: &Exact,
) -> Result<Option<Exact>, SolveError> {
    validate::system(system)?;
    validate_unit_roundoff(unit_roundoff)?;
    let laws = RoundingLaws::new(&system.as_ref().map(exact), unit_roundoff, &min_normal(&system.c));
    Ok(laws.map_or(Some(Exact::zero()), |laws| laws.rounding_floor(plane)))
}

/// Returns the precision in bits that guarantees a tolerance, in m, by each method: the smallest whose
/// [`rounding_floor`] is below it, for the parameters and the tolerance as rounded to that precision. Returns
/// `None` if it exceeds [`PRECISIONS`].
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter or the tolerance is out of its range.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, required_precision}};
/// let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse()?;
/// assert_eq!(required_precision(&system, Plane::Unilateral, &Exact::power_of_two(-93))?, Some(100));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn required_precision(
    system: &SpringMass<Exact>,
    plane: Plane,
    tolerance: &Exact,
) -> Result<Option<u32>, SolveError> {
    validate::system(system)?;
    validate::positive("tolerance", tolerance)?;
    // The floor is halved by every bit, except for the effect of rounding on the parameters.
    let floor = mpfr_floor(system, plane, 64).expect("64 bits have a floor");
    let ratio = floor / tolerance;
    let [excess, shortfall] =
        [ratio.as_rational().numer(), ratio.as_rational().denom()].map(Integer::significant_bits);
    let max_bits = *PRECISIONS.end();
    let estimate = (64 + excess).saturating_sub(shortfall).clamp(MIN_BITS, max_bits);
    if !precision_suffices(system, plane, tolerance, estimate) {
        let mut candidates = (estimate..=max_bits).take(64);
        return Ok(candidates.find(|bits| precision_suffices(system, plane, tolerance, *bits)));
    }
    // For a separated mass the precision can be so much smaller that a linear search would take too long.
    let reduced = |n: i32| estimate.checked_sub(n.unsigned_abs()).filter(|bits| *bits >= MIN_BITS);
    Ok(reduced(last_where(|n| {
        reduced(n).is_some_and(|bits| precision_suffices(system, plane, tolerance, bits))
    })))
}

/// Smallest precision, in bits, for which a tolerance is guaranteed.
const MIN_BITS: u32 = 6;

/// Returns `true` if the tolerance is above the rounding floor, with the tolerance and the parameters rounded
/// to this precision.
fn precision_suffices(system: &SpringMass<Exact>, plane: Plane, tolerance: &Exact, bits: u32) -> bool {
    let floor = mpfr_floor(&system.as_ref().map(|x| round_to_bits(x, bits)), plane, bits);
    floor.is_some_and(|floor| floor < round_to_bits(tolerance, bits))
}

fn round_to_bits(x: &Exact, bits: u32) -> Exact {
    x.round_to_bits(bits).expect("at least one bit")
}

/// Returns the rounding floor of MPFR numbers of this precision.
fn mpfr_floor(system: &SpringMass<Exact>, plane: Plane, bits: u32) -> Option<Exact> {
    let eta = Exact::power_of_two(-i32::try_from(bits).expect("precisions are small"));
    RoundingLaws::new(system, &eta, &Exact::zero()).expect("MPFR numbers are rounded").rounding_floor(plane)
}

/// Returns the last n for which a predicate holds that holds for 0 and, once false, for no larger n.
pub(super) fn last_where(holds: impl Fn(i32) -> bool) -> i32 {
    let (mut last, mut beyond) = (0, 1);
    while holds(beyond) {
        (last, beyond) = (beyond, beyond.saturating_mul(2));
    }
    while beyond - last > 1 {
        let middle = last + (beyond - last) / 2;
        if holds(middle) { last = middle } else { beyond = middle }
    }
    last
}

fn validate_arguments<T: Scalar>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<(), SolveError> {
    validate::system(system)?;
    validate::positive("penalty", eps)?;
    validate::positive("tolerance", tolerance)?;
    validate_unit_roundoff(unit_roundoff)
}

/// Returns an error if η is negative. It is 0 if nothing is rounded.
pub(super) fn validate_unit_roundoff(eta: &Exact) -> Result<(), SolveError> {
    validate::require(*eta >= Exact::zero(), "unit roundoff", eta, "at least 0")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_planes_have_the_same_floor_at_grazing() {
        let system = SpringMass { c: 4.0, m: 1.0, g: 8.0, l: 1.0, h: 3.0 };
        let floor = |plane| rounding_floor(&system, plane, &Exact::power_of_two(-53)).unwrap();
        assert!(floor(Plane::Unilateral).is_some() && floor(Plane::Unilateral) == floor(Plane::Bilateral));
    }

    #[test]
    fn the_last_power_is_found_from_any_start() {
        for n in (0..100).chain([i32::MAX / 2, i32::MAX - 2]) {
            assert_eq!(last_where(|k| k <= n), n);
        }
    }
}
