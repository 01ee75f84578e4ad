//! Exact number of augmentations for a tolerance: (1.33) solved for k.

use super::{Plane, Scalar, SolveError, exact, validate};
use crate::chapter::{SpringMass, augmented, system};
use crate::number::{Exact, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::float::Round;
use rug::ops::{AssignRound, Pow};
use rug::{Float, Integer, Rational};
use std::cmp::Ordering;

/// Returns the first k at which the augmentation meets a tolerance in exact arithmetic, for the parameters as
/// represented in their scalar; penalty ε > 0 in N/m, tolerance > 0 in m, λ₀ in N.
///
/// It is the first k with |r_k| < tol, where r_k is the natural residual (note 4). In contact and grazing r_k
/// is the penetration, so this is (1.33). The count can be very large: it has about as many digits as c/ε.
///
/// Floats may take a few steps more or fewer, see
/// [`guaranteed_max_augmentations`](super::guaranteed_max_augmentations); below the limit of
/// [`is_convergence_guaranteed`](super::is_convergence_guaranteed) they may never converge.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter, ε, the tolerance or λ₀ is not finite or out of its range,
/// and [`SolveError::TooLong`] if the count has more than about a million binary digits.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::{Plane, exact_augmentation_count}};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// // p_k = 1/4, 1/8, 1/16, …: not yet *less* than 1/16 at k = 2.
/// assert_eq!(exact_augmentation_count(&system, &4.0, &0.0625, &0.0, Plane::Unilateral)?, 3);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn exact_augmentation_count<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    start: &T,
    plane: Plane,
) -> Result<Integer, SolveError> {
    validate::system(system)?;
    validate::positive("penalty", eps)?;
    validate::positive("tolerance", tolerance)?;
    validate::finite_number("initial multiplier", start)?;
    count(&system.as_ref().map(exact), &exact(eps), &exact(tolerance), &exact(start), plane)
}

/// Returns the count for arguments that have been checked.
pub(super) fn count(
    system: &SpringMass<Exact>,
    eps: &Exact,
    tolerance: &Exact,
    start: &Exact,
    plane: Plane,
) -> Result<Integer, SolveError> {
    let (zero, r) = (Exact::zero(), system::reaction(system));
    if plane == Plane::Bilateral {
        return count_while_active(system, eps, tolerance, start);
    }
    if *start <= zero && &system.c * start + eps * &r < zero {
        // The first step is separated and sets λ to 0, unless it is within the tolerance already.
        return Ok(if -start / eps < *tolerance {
            Integer::new()
        } else if r < zero {
            Integer::from(1)
        } else {
            count_while_active(system, eps, tolerance, &zero)? + 1
        });
    }
    let while_active = count_while_active(system, eps, tolerance, start)?;
    if r >= zero {
        return Ok(while_active);
    }
    // Separated with λ₀ > 0: r_k is p_k until λ would become negative, and −λ_k/ε afterwards. Both are
    // negative and r_k is the larger one, so the first of the two within the tolerance counts.
    let after_release = first_below(&(start - &r), &(eps * tolerance - &r), &(eps / &system.c))?;
    Ok(while_active.min(after_release))
}

/// Returns the smallest k with |p_k| = ρᵏ |p₀| < tol; while the contact is active, |p_k| is the residual.
fn count_while_active(
    system: &SpringMass<Exact>,
    eps: &Exact,
    tolerance: &Exact,
    start: &Exact,
) -> Result<Integer, SolveError> {
    let p = augmented::penetration_after(system, eps, start, &Exact::one());
    first_below(&p.abs(), tolerance, &(eps / &system.c))
}

/// Largest precision of logarithms in bits, which takes seconds.
const MAX_PRECISION: u32 = 1 << 20;

/// Returns the smallest k ≥ 0 with value < bound · (1 + x)ᵏ, for value ≥ 0, bound > 0 and x > 0.
fn first_below(value: &Exact, bound: &Exact, x: &Exact) -> Result<Integer, SolveError> {
    if value < bound {
        return Ok(Integer::new());
    }
    let ratio = value / bound;
    let (ratio, x) = (ratio.as_rational(), x.as_rational());
    let growth = Rational::from(x + 1);
    // ⌊ln ratio / ln(1 + x)⌋ is the largest power that does not exceed the ratio.
    let mut precision = 64;
    loop {
        if let Some([lower, upper]) = enclose_floor_of_power(ratio, x, precision)
            && (lower == upper || is_power(ratio, &growth, &upper))
        {
            return Ok(upper + 1);
        }
        precision *= 2;
        if precision > MAX_PRECISION {
            return Err(SolveError::TooLong {
                quantity: "number of augmentations",
                digits: MAX_PRECISION.into(),
            });
        }
    }
}

/// Encloses ⌊ln ratio / ln(1 + x)⌋ by logarithms of this precision, rounded down and up.
fn enclose_floor_of_power(ratio: &Rational, x: &Rational, precision: u32) -> Option<[Integer; 2]> {
    let [(ln, ln_1p), (ln_up, ln_1p_up)] = [Round::Down, Round::Up].map(|round| {
        let ratio = round_float(precision, ratio, round);
        let x = round_float(precision, x, round);
        (round_float(precision, ratio.ln_ref(), round), round_float(precision, x.ln_1p_ref(), round))
    });
    let lower = round_float(precision, &ln / &ln_1p_up, Round::Down);
    let upper = round_float(precision, &ln_up / &ln_1p, Round::Up);
    let [(lower, _), (upper, _)] =
        [lower.to_integer_round(Round::Down)?, upper.to_integer_round(Round::Down)?];
    Some([lower, upper])
}

fn round_float<X>(precision: u32, x: X, round: Round) -> Float
where
    Float: AssignRound<X, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(precision, x, round).0
}

/// Returns `true` if ratio = growthⁿ. The logarithms cannot decide this case; neither side is longer than the
/// ratio.
fn is_power(ratio: &Rational, growth: &Rational, n: &Integer) -> bool {
    let bits = u64::from(ratio.numer().significant_bits());
    let least_bits = u64::from(growth.numer().significant_bits() - 1).max(1);
    n.to_u32().is_some_and(|n| u64::from(n) * least_bits <= bits && growth.clone().pow(n) == *ratio)
}
