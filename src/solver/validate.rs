//! Errors of the solver, and checks of its arguments and results.

use super::{Method, Scalar, Solution};
use crate::chapter::{SpringMass, penalty, structure, system};
use std::fmt::Debug;

/// Error of the solver.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// A parameter is outside its range.
    #[error("{argument} {value}: must be {allowed}")]
    Invalid {
        /// Name of the parameter.
        argument: &'static str,
        /// Its value.
        value: String,
        /// The values allowed.
        allowed: &'static str,
    },
    /// A rational has too many digits for the computation to end in practice.
    #[error(
        "{quantity}: more than {digits} binary digits; use MPFR (mpfr:BITS), a larger penalty or tolerance, \
         or fewer augmentations"
    )]
    TooLong {
        /// Name of the quantity.
        quantity: &'static str,
        /// The largest number of digits allowed.
        digits: u64,
    },
    /// The scalar cannot represent a result.
    #[error("the {quantity} is out of the range of this scalar; use MPFR (mpfr:BITS) or exact rationals")]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
    },
}

const POSITIVE: &str = "greater than 0 and finite";
const FINITE: &str = "finite";
const COMPLETE: &str = "of a type whose integer_decode returns the whole number";

pub(super) fn require(
    holds: bool,
    argument: &'static str,
    value: &impl Debug,
    allowed: &'static str,
) -> Result<(), SolveError> {
    if holds { Ok(()) } else { Err(SolveError::Invalid { argument, value: format!("{value:?}"), allowed }) }
}

pub(super) fn positive<T: Scalar>(argument: &'static str, value: &T) -> Result<(), SolveError> {
    require(value.is_finite() && *value > T::zero(), argument, value, POSITIVE)?;
    finite_number(argument, value)
}

pub(super) fn finite_number<T: Scalar>(argument: &'static str, value: &T) -> Result<(), SolveError> {
    require(value.is_finite(), argument, value, FINITE)?;
    require(value.has_exact_value(), argument, value, COMPLETE)
}

pub(super) fn system<T: Scalar>(system: &SpringMass<T>) -> Result<(), SolveError> {
    let [c, m, others @ ..] = SpringMass::NAMES.zip(system.as_ref()).into_array();
    [c, m].into_iter().try_for_each(|(name, x)| positive(name, x))?;
    others.into_iter().try_for_each(|(name, x)| finite_number(name, x))
}

pub(super) fn method<T: Scalar>(method: &Method<T>) -> Result<(), SolveError> {
    match method {
        Method::Lagrange => Ok(()),
        Method::Penalty { penalty } => positive("penalty", penalty),
        Method::Augmented { penalty, tolerance, start, max_augmentations: _ } => {
            positive("penalty", penalty)?;
            positive("tolerance", tolerance)?;
            finite_number("initial multiplier", start)
        }
    }
}

pub(super) fn in_range(holds: bool, quantity: &'static str) -> Result<(), SolveError> {
    if holds { Ok(()) } else { Err(SolveError::OutOfRange { quantity }) }
}

/// Returns an error if a product of nonzero factors underflows to zero.
pub(super) fn products<T: Scalar>(s: &SpringMass<T>) -> Result<(), SolveError> {
    let gap = system::gap(s);
    in_range(s.g.is_zero() || !system::weight(s).is_zero(), "weight")?;
    in_range(s.g.is_zero() || !structure::deflection(s).is_zero(), "deflection")?;
    in_range(gap.is_zero() || !structure::spring_force(s, &gap).is_zero(), "spring force")
}

pub(super) fn stiffness<T: Scalar>(s: &SpringMass<T>, eps: &T) -> Result<(), SolveError> {
    in_range(penalty::total_stiffness(s, eps).is_finite(), "total stiffness c + ε")
}

pub(super) fn require_finite<T: Scalar>(solution: &Solution<T>) -> Result<(), SolveError> {
    in_range(solution.deflection.is_finite(), "deflection")?;
    in_range(solution.penetration.is_finite(), "penetration")?;
    in_range(solution.contact_force.is_finite(), "contact force")?;
    in_range(solution.floor.as_ref().is_none_or(T::is_finite), "bound of |u − u*|")
}

/// Limits of binary digits, for one multiplier and for all steps together; within them an augmentation takes
/// about a second.
const MAX_MULTIPLIER_BITS: u64 = 1 << 21;
const MAX_TOTAL_BITS: u64 = 1 << 26;

pub(super) fn digits(multiplier: u64, all_multipliers: u64) -> Result<(), SolveError> {
    if multiplier > MAX_MULTIPLIER_BITS {
        return Err(SolveError::TooLong { quantity: "multiplier", digits: MAX_MULTIPLIER_BITS });
    } else if all_multipliers > MAX_TOTAL_BITS {
        return Err(SolveError::TooLong { quantity: "all multipliers together", digits: MAX_TOTAL_BITS });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multipliers_of_the_greatest_length_are_allowed() {
        let refused = |multiplier, all| match digits(multiplier, all) {
            Err(SolveError::TooLong { quantity, .. }) => Some(quantity),
            _ => None,
        };
        assert_eq!(refused(MAX_MULTIPLIER_BITS, MAX_TOTAL_BITS), None);
        assert_eq!(refused(MAX_MULTIPLIER_BITS + 2, MAX_TOTAL_BITS), Some("multiplier"));
        assert_eq!(refused(0, MAX_TOTAL_BITS + 2), Some("all multipliers together"));
    }
}
