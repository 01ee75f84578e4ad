//! §1.2 Contact part: the mass must not penetrate the plane. Equations (1.5)-(1.6).

use super::{SpringMass, structure, system};
use crate::number::{Field, PositivePart};

/// Eq. (1.5): the penetration, in m, at the deflection `u` in m: positive inside the plane.
///
/// `p = l + u − H`
///
/// Domain: all. Two roundings: the error is at most η (|fl(l + u)| + |fl(p)|), which can be all of p if the
/// two lengths cancel. Source: §1.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, contact};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(contact::penetration(&system, &2.5), 0.5);
/// ```
/// [In the book](../../../../book/contact.html#eq-1-5)
pub fn penetration<T: Field>(system: &SpringMass<T>, u: &T) -> T {
    let SpringMass { l, h, .. } = system;
    l + u - h
}

/// The residual of equilibrium with a contact force, in N: `u` is the deflection in m, `n` the force
/// in N with which the plane pushes.
///
/// `r = c u − m g + N`
///
/// Domain: all. Source: the first line of (1.8), with N for λ; (1.6) alone fixes nothing without it.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, contact};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(contact::equilibrium(&system, &2.0, &2.0), 0.0);
/// ```
/// [In the book](../../../../book/contact.html#eq-1-6)
pub fn equilibrium<T: Field>(system: &SpringMass<T>, u: &T, n: &T) -> T {
    structure::residual(system, u) + n
}

/// The residuals of the conditions (1.6) and of equilibrium; all four are zero at the solution and
/// only there.
/// [In the book](../../../../book/contact.html#eq-1-6)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Kkt<T> {
    /// The residual of equilibrium, in N, with its sign.
    pub stationarity: T,
    /// Penetration of the plane, in m.
    pub primal: T,
    /// Force with which the plane pulls, in N.
    pub dual: T,
    /// Penetration times force, in J, with its sign.
    pub complementarity: T,
}

impl<T: Field> Kkt<T> {
    /// Returns `true` if all four are zero. In rationals this holds for the solution only.
    ///
    /// ```
    /// # use spring_mass_contact::chapter::{SpringMass, contact};
    /// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    /// assert!(contact::kkt(&system, &2.0, &2.0).is_zero());
    /// assert!(!contact::kkt(&system, &2.25, &1.0).is_zero());
    /// ```
    pub fn is_zero(&self) -> bool {
        let Kkt { stationarity, primal, dual, complementarity } = self;
        [stationarity, primal, dual, complementarity].into_iter().all(T::is_zero)
    }
}

/// Eq. (1.6): the Karush-Kuhn-Tucker conditions as residuals, at the deflection `u` in m and the
/// contact force `n` in N.
///
/// `c u − m g + N = 0, ⟨p⟩ = 0, ⟨−N⟩ = 0, p N = 0`
///
/// As printed, (1.6) leaves out grazing (p = 0 and N = 0) and equilibrium; here both are in. On
/// rationals these are 0 for a solution and for nothing else. Domain: all. Source: §1.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, contact};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let kkt = contact::kkt(&system, &2.25, &1.0); // the penalty method with ε = 4
/// assert_eq!((kkt.stationarity, kkt.primal, kkt.dual, kkt.complementarity), (0.0, 0.25, 0.0, 0.25));
/// ```
/// [In the book](../../../../book/contact.html#eq-1-6)
pub fn kkt<T: PositivePart>(system: &SpringMass<T>, u: &T, n: &T) -> Kkt<T> {
    let p = penetration(system, u);
    Kkt {
        stationarity: equilibrium(system, u, n),
        complementarity: &p * n,
        primal: p.positive_part(),
        dual: (-n).positive_part(),
    }
}

/// Eq. (1.6), solved for the force: the contact force of unilateral contact, in N.
///
/// `N = ⟨R⟩`
///
/// Domain: all. Source: §1.2; with equilibrium, (1.6) has exactly this solution.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, contact};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(contact::contact_force(&system), 2.0);
/// ```
/// [In the book](../../../../book/contact.html#fn-contact-contact_force)
pub fn contact_force<T: PositivePart>(system: &SpringMass<T>) -> T {
    system::reaction(system).positive_part()
}

/// Eq. (1.6), solved for the deflection: the equilibrium of unilateral contact, in m.
///
/// `u = min(m g / c, Δ)`
///
/// Domain: c > 0. Source: §1.2; with equilibrium, (1.6) has exactly this solution.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, contact};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(contact::deflection(&system), 2.0);
/// ```
/// [In the book](../../../../book/contact.html#fn-contact-deflection)
pub fn deflection<T: PositivePart>(system: &SpringMass<T>) -> T {
    structure::deflection(system).min(&system::gap(system))
}
