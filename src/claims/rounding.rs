//! What floats make of the chapter: the bounds of note 8.

use super::prelude::*;
use crate::chapter::rounding;

formulas! {
    "η" (folded) = rounding::unit_roundoff("n");
    "" = rounding::penetration_error("n", "s", "p");
    "" = rounding::free_error("n", "u");
    "" = rounding::force_error("n", "W", "F", "N");
    "" = rounding::deflection_error(system, "ε", "n");
    "" = rounding::penalty_force_error(system, "ε", "n");
    "" = rounding::fixed_point_error(system, "ε", "λ", "n");
    "F" (folded) = rounding::floor(system, "ε", "n");
    "" = rounding::step_error(system, "ε", "n");
    "" = rounding::multiplier_drift(system, "ε", "n");
    "" = rounding::penetration_drift(system, "ε", "n");
}
