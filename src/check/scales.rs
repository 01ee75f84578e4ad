//! Scales of a system, by which errors are measured, and its roundings.

use crate::chapter::{SpringMass, structure, system};
use crate::number::{Ball, Exact, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::float::Round;

/// mantissa × 10^exponent
pub(super) fn decimal(mantissa: i64, exponent: i32) -> Exact {
    format!("{mantissa}e{exponent}").parse().expect("a decimal")
}

/// Returns the nearest decimal with this number of digits.
pub(super) fn short(x: &Exact, digits: usize) -> Exact {
    x.decimal(digits, Round::Nearest).parse().expect("a decimal")
}

/// Formats six digits.
pub(super) fn format_short(x: &Exact) -> String {
    x.decimal(6, Round::Nearest)
}

/// Returns the scales of the errors of u, in m, and N, in N; one SI unit if the scale is zero.
pub(super) fn scales(system: &SpringMass<Exact>) -> [Exact; 2] {
    let gap = system::gap(system);
    let free = structure::deflection(system);
    let weight = system::weight(system);
    let scales = [gap.abs() + free.abs(), weight.abs() + (&system.c * gap).abs()];
    scales.map(|scale| if scale.is_zero() { Exact::one() } else { scale })
}

/// Returns the sum of the lengths of a system, in m, and that of its forces, in N.
pub(super) fn sizes(system: &SpringMass<Exact>) -> [Exact; 2] {
    let [_, weight] = scales(system);
    let lengths = system.l.abs() + system.h.abs();
    [&lengths + structure::deflection(system).abs(), weight + &system.c * lengths]
}

/// Returns the ball around the float of a number, if it is in range.
pub(super) fn ball(x: &Exact) -> Option<Ball<f64>> {
    Ball::enclosing(&0f64, x).ok()
}

/// Returns a system in balls around floats, if it is in range.
pub(super) fn balls(system: &SpringMass<Exact>) -> Option<SpringMass<Ball<f64>>> {
    system.as_ref().try_map(|x| ball(x).ok_or(())).ok()
}

/// Returns `true` if the radius of a ball is at most a size.
pub(super) fn is_within(ball: &Ball<f64>, size: &Exact) -> bool {
    ball.radius().to_exact().is_ok_and(|radius| radius <= *size)
}

/// Returns `true` if both numbers are equal or round to the same f64. This accepts the exact solution rounded
/// once, which a ball with a radius of less than half an ulp may not contain.
pub(super) fn rounds_alike(x: &Exact, y: &Exact) -> bool {
    x == y || matches!((x.to_f64(), y.to_f64()), (Ok(x), Ok(y)) if x == y)
}

/// Returns the largest distance of an answer from a value that explains it, relative to the scale of the
/// system and of the value: the tolerance, but at least 10⁻⁶, so that the tolerance does not change which
/// mistakes are distinguished.
pub(super) fn fit(tolerance: &Exact) -> Exact {
    decimal(1, -6).max(tolerance.clone())
}
