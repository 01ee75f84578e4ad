//! Rounding errors of the chapter's formulas in floats: the bounds of note 8.

use super::prelude::*;
use crate::chapter::rounding;

formulas! {
    "η" (abbreviated) = rounding::unit_roundoff("2ᵖ");
    "" = rounding::deflection_error(system, "ε", "2ᵖ");
    "" = rounding::penalty_force_error(system, "ε", "2ᵖ");
    "" = rounding::fixed_point_error(system, "ε", "λ", "2ᵖ");
    "F" (abbreviated) = rounding::floor_scale(system, "ε", "2ᵖ");
    "" = rounding::penetration_drift(system, "ε", "2ᵖ");
    "" = rounding::multiplier_drift(system, "ε", "2ᵖ");
    "" = rounding::best_compliance_squared(system, "2ᵖ");
}

/// Returns the unit roundoff.
pub(super) fn eta() -> Tree {
    rounding::unit_roundoff(precision())
}
