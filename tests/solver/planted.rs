//! Systems in which rounding has an effect that sampled systems seldom show.

use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::solver::{Augmentation, Method, Outcome, solve};

/// Δ = 6 and λ₀ = R = m g − c Δ, so that p₀ = 0. Between 2²⁶ and 2²⁷ floats are multiples of 8: the numerator
/// of û₀, ε Δ + 12, is a tie and rounds to ε Δ + 16. The quotient by c + ε, 6 + 4/14680066, rounds to û₀ =
/// 6 + 2⁻²¹. λ₁ = λ₀ + ε 2⁻²¹ = λ₀ + 7 is a tie, too, and rounds to λ₀ + 8; the next numerator, ε Δ + 4,
/// rounds to ε Δ, and 6 − 12/14680066 to û₁ = 6 − 2⁻²⁰.
#[test]
fn the_floor_bounds_the_error_of_the_answer_though_the_last_but_one_deflection_is_nearer() {
    let system = SpringMass { c: 2f32, m: 1.0, g: 25_165_824.0, l: 0.25, h: 6.25 };
    let (penalty, start) = (14_680_064.0, 25_165_812.0);
    let steps = Augmentation::new(&system, &penalty).with_multiplier(start);
    let deflections: Vec<_> = steps.map(|step| step.deflection).take(2).collect();
    let (nearest, last) = (2f32.powi(-21), 2f32.powi(-20));
    assert_eq!(deflections, [6.0 + nearest, 6.0 - last]);
    let method = Method::Augmented { penalty, tolerance: nearest, max_augmentations: 10, start };
    let answer = solve(&system, &method).unwrap();
    assert_eq!((answer.outcome, answer.deflection), (Outcome::Stagnated, 6.0 - last));
    let floor = answer.floor.unwrap();
    assert!(last <= floor && floor < 2.0 * last, "{floor}");
}
