//! §1.3.1 Lagrange multiplier method: the plane's force is an unknown of its own. Equations (1.7)-(1.8).

use super::{SpringMass, contact, structure, system};
use crate::number::Field;

/// Eq. (1.7): the Lagrange functional, in J, at the deflection `u` in m and the multiplier `lambda`
/// in N.
///
/// `𝓛 = Π + λ p`
///
/// Its stationary point is a saddle, not a minimum. Domain: all. Source: §1.3.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, lagrange};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(lagrange::functional(&system, &2.5, &2.0), -11.5);
/// ```
/// [In the book](../../../../book/lagrange.html#eq-1-7)
pub fn functional<T: Field>(system: &SpringMass<T>, u: &T, lambda: &T) -> T {
    structure::potential_energy(system, u) + lambda * contact::penetration(system, u)
}

/// Eq. (1.8): the residuals of its two lines, in N and in m, at `u` in m and `lambda` in N.
///
/// `c u − m g + λ = 0, p = 0`
///
/// Domain: all. Source: §1.3.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, lagrange};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(lagrange::residual(&system, &2.0, &2.0), [0.0, 0.0]);
/// ```
/// [In the book](../../../../book/lagrange.html#eq-1-8)
pub fn residual<T: Field>(system: &SpringMass<T>, u: &T, lambda: &T) -> [T; 2] {
    [contact::equilibrium(system, u, lambda), contact::penetration(system, u)]
}

/// Eq. (1.8), solved for the deflection, in m: the mass lies exactly at the plane.
///
/// `u = Δ`
///
/// Bilateral: for R < 0 the plane would have to pull. Domain: all. One rounding. Source: §1.3.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, lagrange};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(lagrange::deflection(&system), 2.0);
/// ```
/// [In the book](../../../../book/lagrange.html#eq-1-8)
pub fn deflection<T: Field>(system: &SpringMass<T>) -> T {
    system::gap(system)
}

/// Eq. (1.8), solved for the multiplier, in N: the contact force.
///
/// `λ = R`
///
/// Bilateral: negative for R < 0. Domain: all. Four roundings. Source: §1.3.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, lagrange};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(lagrange::multiplier(&system), 2.0);
/// ```
/// [In the book](../../../../book/lagrange.html#eq-1-8)
pub fn multiplier<T: Field>(system: &SpringMass<T>) -> T {
    system::reaction(system)
}
