//! Bounds of rounding errors of the chapter's formulas, for every precision (note 8).
//!
//! Rounding to p ≥ 2 bits has a relative error of at most η = 2⁻ᵖ; underflow and overflow are excluded. The
//! bounds are for the parameters as rounded, and for the functions of the other modules, computed in their
//! order of operations. Each bound is proved: it is a claim about the formula whose error it bounds, in the
//! entry of that formula.

use super::{SpringMass, penalty, system};
use crate::number::{Field, PositivePart};

/// Unit roundoff of numbers of p bits, dimensionless: bounds the relative rounding error.
///
/// `η = 1 / 2ᵖ`
///
/// `n` is 2ᵖ. Domain: n ≠ 0. Source: note 8.
///
/// ```
/// # use spring_mass_contact::chapter::rounding;
/// assert_eq!(rounding::unit_roundoff(&f64::powi(2.0, 53)), f64::EPSILON / 2.0);
/// ```
pub fn unit_roundoff<T: Field>(n: &T) -> T {
    T::one() / n
}

/// Bound of the error of a computed (1.13), in m.
///
/// `η (5 |Δ| + 4 R / (c + ε)) (1 + 2 η)`
///
/// `eps` is the penalty ε in N/m, `n` is 2ᵖ. Domain: c > 0, ε > 0, R ≥ 0. Source: §1.3.2, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::deflection_error(&system, &4.0, &4.0), 4.125);
/// ```
pub fn deflection_error<T: PositivePart>(system: &SpringMass<T>, eps: &T, n: &T) -> T {
    let eta = unit_roundoff(n);
    let lengths = T::int(5) * system::gap(system).abs() + T::int(4) * penalty::penetration(system, eps);
    &eta * lengths * (T::one() + T::int(2) * &eta)
}

/// Bound of the error of a computed ε p at a computed (1.13) as the force (1.12), in N.
///
/// `η (ε (|H| + 5 |Δ|) + 7 R) (1 + 8 η)`
///
/// `eps` is the penalty ε in N/m, `n` is 2ᵖ. Domain: c > 0, ε > 0, R ≥ 0. It grows with ε, so that at
/// best half of the digits are lost. Source: §1.3.2, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::penalty_force_error(&system, &4.0, &8.0), 16.5);
/// ```
pub fn penalty_force_error<T: PositivePart>(system: &SpringMass<T>, eps: &T, n: &T) -> T {
    let eta = unit_roundoff(n);
    let lengths = system.h.abs() + T::int(5) * system::gap(system).abs();
    &eta * (eps * lengths + T::int(7) * system::reaction(system)) * (T::one() + T::int(8) * &eta)
}

/// Bound of |p| at a fixed point of a computed (1.16), in m.
///
/// `η |H| + η (1 + η)² |λ| / ((1 − η) ε)`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N, `n` is 2ᵖ. Domain: ε > 0, n > 1.
/// Source: §1.3.3, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::fixed_point_error(&system, &4.0, &6.0, &2.0), 5.25 - 0.375);
/// ```
pub fn fixed_point_error<T: PositivePart>(system: &SpringMass<T>, eps: &T, lambda: &T, n: &T) -> T {
    let eta = unit_roundoff(n);
    let growth = T::one() + &eta;
    &eta * system.h.abs() + &eta * &growth * &growth * lambda.abs() / ((T::one() - &eta) * eps)
}

/// Scale of the rounding floor of (1.16), in m.
///
/// `F = η (|H| + |Δ| + R / ε)`
///
/// `eps` is the penalty ε in N/m, `n` is 2ᵖ. Domain: ε > 0, R ≥ 0. A small penalty has a high floor.
/// Source: §1.3.3, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::floor_scale(&system, &4.0, &2.0), 2.75);
/// ```
pub fn floor_scale<T: PositivePart>(system: &SpringMass<T>, eps: &T, n: &T) -> T {
    unit_roundoff(n) * (system.h.abs() + system::gap(system).abs() + system::reaction(system) / eps)
}

/// Bound of the errors of computed penetrations of (1.16), from λ₀ = 0 and for all k, in m.
///
/// `20 F`
///
/// Holds for the unilateral form, too. `eps` is the penalty ε in N/m, `n` is 2ᵖ. Domain: c > 0, ε > 0, R ≥ 0,
/// and 64 (c + ε) ≤ ε (2ᵖ + 1). Source: §1.3.3, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::penetration_drift(&system, &4.0, &1024.0), 110.0 / 1024.0);
/// ```
pub fn penetration_drift<T: PositivePart>(system: &SpringMass<T>, eps: &T, n: &T) -> T {
    T::int(20) * floor_scale(system, eps, n)
}

/// Bound of the errors of computed multipliers of (1.16), from λ₀ = 0 and for all k, in N.
///
/// `11 (c + ε) F`
///
/// `eps` is the penalty ε in N/m, `n` is 2ᵖ. Domain: that of [`penetration_drift`]. A large penalty reduces
/// the accuracy of the multiplier, but not of the deflection. Source: §1.3.3, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::multiplier_drift(&system, &4.0, &1024.0), 484.0 / 1024.0);
/// ```
pub fn multiplier_drift<T: PositivePart>(system: &SpringMass<T>, eps: &T, n: &T) -> T {
    T::int(11) * penalty::total_stiffness(system, eps) * floor_scale(system, eps, n)
}

/// Square of the compliance 1 / (c + ε) at which a computed ε p best approximates R, in m²/N².
///
/// `η (|H| + 5 |Δ|) (1 + 8 η) / (c R)`
///
/// `n` is 2ᵖ. With a smaller ε the spring carries more of R, with a larger one
/// [rounding](penalty_force_error) increases; the bound of both together is least here. If H and l are 0,
/// this is 0, and no ε is too large. Domain: c > 0, R > 0, n > 0. Source: §1.3.2, note 8.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, rounding};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(rounding::best_compliance_squared(&system, &8.0), 26.0 / 64.0);
/// ```
pub fn best_compliance_squared<T: PositivePart>(system: &SpringMass<T>, n: &T) -> T {
    let eta = unit_roundoff(n);
    let lengths = system.h.abs() + T::int(5) * system::gap(system).abs();
    &eta * lengths * (T::one() + T::int(8) * &eta) / (&system.c * system::reaction(system))
}
