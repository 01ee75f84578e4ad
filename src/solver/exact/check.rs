//! Checks of the arguments that are neither a system nor a method.

use crate::number::Exact;
use crate::solver::Scalar;
pub(super) use crate::solver::SolveError;
pub(super) use crate::solver::check::*;

pub(super) fn coefficient<T: Scalar>(argument: &'static str, value: &T) -> Result<(), SolveError> {
    require(value.is_finite() && *value >= T::zero(), argument, value, "at least 0 and finite")
}

/// Checks η, which is 0 if nothing is rounded.
pub(super) fn unit_roundoff(eta: &Exact) -> Result<(), SolveError> {
    require(*eta >= num_traits::Zero::zero(), "unit roundoff", eta, "at least 0")
}

pub(super) fn any_positive<'a, T: Scalar + 'a>(
    mut coefficients: impl Iterator<Item = &'a T>,
) -> Result<(), SolveError> {
    require(
        coefficients.any(|e| *e > T::zero()),
        "penalties",
        &T::zero(),
        "greater than 0, at least one of them",
    )
}
