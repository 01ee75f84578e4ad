//! Rounding errors of the chapter's formulas in floats: the bounds of note 8.

use super::prelude::*;
use crate::chapter::rounding;

formulas! {
    |system, x|
    "η" = rounding::unit_roundoff(&x("2ᵖ")).abbreviated();
    "" = rounding::deflection_error(&system, &x("ε"), &x("2ᵖ"));
    "" = rounding::penalty_force_error(&system, &x("ε"), &x("2ᵖ"));
    "" = rounding::fixed_point_error(&system, &x("ε"), &x("λ"), &x("2ᵖ"));
    "F" = rounding::floor_scale(&system, &x("ε"), &x("2ᵖ")).abbreviated();
    "" = rounding::penetration_drift(&system, &x("ε"), &x("2ᵖ"));
    "" = rounding::multiplier_drift(&system, &x("ε"), &x("2ᵖ"));
    "" = rounding::best_compliance_squared(&system, &x("2ᵖ"));
}

/// Returns the unit roundoff.
pub(super) fn eta() -> Tree {
    rounding::unit_roundoff(precision())
}
