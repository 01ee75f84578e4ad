//! Laws where numbers may underflow.

use super::*;

/// Returns the laws for η = 2⁻¹⁰, with 1 as the smallest normal number, so that lengths are at least 4096.
fn laws(weight: i32, l: i32, h: i32) -> RoundingLaws {
    let [c, m, g, l, h] = [1, 1, weight, l, h].map(Exact::from);
    RoundingLaws::new(&SpringMass { c, m, g, l, h }, &Exact::power_of_two(-10), &Exact::one()).unwrap()
}

#[test]
fn numbers_that_lose_precision_guarantee_nothing() {
    let is_normal = |(weight, l, h)| laws(weight, l, h).parameters_are_normal();
    assert!([(1, 0, 0), (8, 4096, 4096), (8, 0, -4096), (0, 4096, 0)].into_iter().all(is_normal));
    assert!(![(8, 4095, 4096), (8, 4096, 4095), (8, 1, 0)].into_iter().any(is_normal));
    // ε |Δ| ≥ 2.
    let with = |gap, p: i32, q: i32| {
        laws(8, 4096, 4096 + gap).gap_force_is_normal(&(Exact::from(p) / Exact::from(q)))
    };
    assert!(with(0, 1, 100) && with(4, 1, 2) && with(1, 2, 1) && !with(3, 1, 2) && !with(1, 1, 1));
    let far = Exact::from(1_000_000);
    let converges = |laws: RoundingLaws| laws.is_convergence_guaranteed(&Exact::one(), &far);
    assert!(converges(laws(8, 4096, 4098)));
    assert!(!converges(laws(8, 4095, 4098)) && !converges(laws(8, 4096, 4097)));
}

/// c |Δ| ≥ 2 if the mass is separated; the floor in contact is that for ε → ∞.
#[test]
fn a_force_that_loses_precision_leaves_no_floor_of_a_separated_mass() {
    let has_floor =
        |(weight, gap)| laws(weight, 4096, 4096 + gap).rounding_floor(Plane::Unilateral).is_some();
    assert!(has_floor((1, 4)) && !has_floor((0, 1)));
    assert!(has_floor((8, 4)) && has_floor((8, 1)));
}

#[test]
fn an_underflow_increases_the_drift_and_the_weight() {
    let (normal, four) = (laws(100_000, 4096, 4096), Exact::from(4));
    let drift = rounding::penetration_drift(&normal.system, &four, &normal.two_to_p);
    assert_eq!(normal.penetration_drift(&four) - drift, Exact::from(9) / &four);
    let without = RoundingLaws::new(&normal.system, &normal.eta, &Exact::zero()).unwrap();
    let increase = normal.limiting_penetration_drift() - without.limiting_penetration_drift();
    assert_eq!(increase, Exact::from(2));
    let tolerance = Exact::from(1000);
    let system = normal.with_added_weight(&(Exact::from(3) * &normal.eta));
    let heavier = RoundingLaws::new(&system, &normal.eta, &Exact::zero()).unwrap();
    let min = |laws: &RoundingLaws, tolerance: &Exact| laws.penalty_range(tolerance).unwrap().min;
    assert!(min(&normal, &tolerance) > Exact::one());
    assert_eq!(min(&normal, &tolerance), min(&heavier, &(&tolerance - &normal.eta)));
}

/// 64 (65 + 64) = 64 (2⁷ + 1).
#[test]
fn a_drift_is_bounded_up_to_the_largest_stiffness() {
    let is_bounded = |c: i32| {
        let [c, m, g, l, h] = [c, 1, 1, 1, 1].map(Exact::from);
        let laws = RoundingLaws::new(&SpringMass { c, m, g, l, h }, &Exact::power_of_two(-7), &Exact::zero());
        laws.unwrap().drift_is_bounded(&Exact::from(64))
    };
    assert!(is_bounded(65) && !is_bounded(66));
}

#[test]
fn no_largest_penalty_is_known_if_a_force_may_underflow() {
    let largest =
        |laws: RoundingLaws, tolerance: Exact| laws.max_stiffness(&Exact::power_of_two(-1), &tolerance);
    let half = Exact::power_of_two(-1);
    assert_eq!(largest(laws(8, 4096, 4096), Exact::one()), Some(Exact::from(2)));
    assert_eq!(largest(laws(8, 4096, 4096), half), Some(Exact::zero()));
    assert_eq!(largest(laws(8, 4095, 4095), Exact::one()), Some(Exact::zero()));
}
