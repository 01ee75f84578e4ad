//! §1.1 Structural part: the mass on its spring, without the plane. Equations (1.1)-(1.4).
//!
//! Three descriptions of one equilibrium: the balance of forces, the vanishing of the virtual work,
//! the minimum of the potential energy.

use super::SpringMass;
use crate::number::{Dual, Field};

/// The force of the spring, in N, at the deflection `u` in m.
///
/// `c u`
///
/// Domain: all. One rounding. Source: §1.1, before (1.1).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::spring_force(&system, &2.0), 8.0);
/// ```
/// [In the book](../../../../book/structure.html#eq-1-1)
pub fn spring_force<T: Field>(system: &SpringMass<T>, u: &T) -> T {
    let SpringMass { c, .. } = system;
    c * u
}

/// Eq. (1.1): the residual of equilibrium without the plane, in N; zero at equilibrium.
///
/// `r = c u − m g`
///
/// `u` is the deflection in m. Domain: all. Three roundings. Source: §1.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::residual(&system, &2.5), 0.0);
/// ```
/// [In the book](../../../../book/structure.html#eq-1-1)
pub fn residual<T: Field>(system: &SpringMass<T>, u: &T) -> T {
    let SpringMass { c, m, g, .. } = system;
    c * u - m * g
}

/// Eq. (1.1), solved: the deflection without the plane, in m.
///
/// `u = m g / c`
///
/// Domain: c ≠ 0. Two roundings: the error is at most η (2 + η) |fl(u)|. Source: §1.1, the root of (1.1).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::deflection(&system), 2.5);
/// ```
/// [In the book](../../../../book/structure.html#eq-1-1)
pub fn deflection<T: Field>(system: &SpringMass<T>) -> T {
    let SpringMass { c, m, g, .. } = system;
    m * g / c
}

/// Eq. (1.2): the virtual work, in J, of the forces at `u` over the virtual displacement `du`, both in
/// m; zero *for every* `du` where (1.1) holds.
///
/// `δW = δu (c u − m g)`
///
/// Domain: all. Four roundings. Source: §1.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::virtual_work(&system, &2.0, &0.5), -1.0);
/// ```
/// [In the book](../../../../book/structure.html#eq-1-2)
pub fn virtual_work<T: Field>(system: &SpringMass<T>, u: &T, du: &T) -> T {
    du * residual(system, u)
}

/// Eq. (1.3): the first variation of the potential energy, in J: its derivative at `u` in the
/// direction `du`, both in m.
///
/// `δΠ = δu ∂Π/∂u`
///
/// Computed by automatic differentiation of [`potential_energy`]. Domain: all.
/// Source: §1.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::first_variation(&system, &2.0, &0.5), -1.0); // (1.2)
/// ```
/// [In the book](../../../../book/structure.html#eq-1-3)
pub fn first_variation<T: Field>(system: &SpringMass<T>, u: &T, du: &T) -> T {
    let path = Dual { value: u.clone(), derivative: du.clone() };
    potential_energy(&system.as_ref().map(|x| Dual::constant(x.clone())), &path).derivative
}

/// Eq. (1.4): the potential energy, in J, at the deflection `u` in m.
///
/// `Π = c u² / 2 − m g u`
///
/// Domain: all. Five roundings (halving is exact). Its only minimum is at [`deflection`]. Source: §1.1.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::potential_energy(&system, &2.5), -12.5);
/// ```
/// [In the book](../../../../book/structure.html#eq-1-4)
pub fn potential_energy<T: Field>(system: &SpringMass<T>, u: &T) -> T {
    let SpringMass { c, m, g, .. } = system;
    c * u * u / T::int(2) - m * g * u
}

/// The least potential energy, in J: (1.4) at its minimum.
///
/// `min Π = −(m g)² / (2 c)`
///
/// Never positive, so (1.4) is not a "positive polynomial". Domain: c ≠ 0. Source: §1.1, after (1.4).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, structure};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(structure::least_energy(&system), -12.5);
/// ```
/// [In the book](../../../../book/structure.html#eq-1-4)
pub fn least_energy<T: Field>(system: &SpringMass<T>) -> T {
    let SpringMass { c, m, g, .. } = system;
    let w = m * g;
    -(&w * &w) / (T::int(2) * c)
}
