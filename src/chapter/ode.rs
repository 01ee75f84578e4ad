//! §1.3.3, the theorem's analogy: the recursion (1.21) as a differential equation. Equations
//! (1.22)-(1.32).
//!
//! An analogy, not a proof: the solution of the ODE bounds the iterates strictly and never equals
//! them (note 5). Time t is dimensionless here, the continuous counterpart of the step k.

use super::{SpringMass, augmented};
use crate::number::{Exponential, Field};

/// Eq. (1.22): (1.21) with t for k; both sides, in N, at two deflections in m, one unit of time apart.
///
/// `(c + ε) (u_{t+1} − u_t) = −ε (l − H) − ε u_t`
///
/// `eps` is the penalty ε in N/m. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::difference_equation(&system, &4.0, &2.25, &2.125), (-1.0, -1.0));
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-22)
pub fn difference_equation<T: Field>(system: &SpringMass<T>, eps: &T, u: &T, next: &T) -> (T, T) {
    augmented::recursion(system, eps, u, next)
}

/// Eq. (1.25), its left side, in N: the homogeneous operator, at the deflection `u` in m and its rate
/// `v` in m per step.
///
/// `(c + ε) v + ε u`
///
/// `eps` is the penalty ε in N/m. Domain: all. Linear in (u, v), which is why (1.24) may add solutions.
/// Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::operator(&system, &4.0, &2.0, &-1.0), 0.0);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-25)
pub fn operator<T: Field>(system: &SpringMass<T>, eps: &T, u: &T, v: &T) -> T {
    let SpringMass { c, .. } = system;
    (c + eps) * v + eps * u
}

/// Eq. (1.23), its right side, in N.
///
/// `−ε (l − H)`
///
/// `eps` is the penalty ε in N/m. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::right_side(&system, &4.0), 8.0);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-23)
pub fn right_side<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let SpringMass { l, h, .. } = system;
    -eps * (l - h)
}

/// Eq. (1.23), solved for u̇: the rate of the deflection, in m per step, at `u` in m.
///
/// `u̇ = (−ε (l − H) − ε u) / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::velocity(&system, &4.0, &2.25), -0.125);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-23)
pub fn velocity<T: Field>(system: &SpringMass<T>, eps: &T, u: &T) -> T {
    let SpringMass { c, .. } = system;
    (right_side(system, eps) - eps * u) / (c + eps)
}

/// Eq. (1.24): the solution as a sum of a homogeneous and a particular one, all in m.
///
/// `u = u_h + u_nh`
///
/// Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::ode;
/// assert_eq!(ode::superposition(&0.25, &2.0), 2.25);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-24)
pub fn superposition<T: Field>(homogeneous: &T, particular: &T) -> T {
    homogeneous + particular
}

/// Eq. (1.26): the characteristic polynomial of (1.25) at the rate `rate`, in N/m.
///
/// `rate (c + ε) + ε`
///
/// The chapter calls the rate λ; here λ is the multiplier alone (note 7). `eps` is the penalty ε in
/// N/m. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::characteristic(&system, &4.0, &-0.5), 0.0);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-26)
pub fn characteristic<T: Field>(system: &SpringMass<T>, eps: &T, rate: &T) -> T {
    let SpringMass { c, .. } = system;
    rate * (c + eps) + eps
}

/// Eq. (1.26), solved: the rate of decay, per step.
///
/// `rate = −ε / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::rate(&system, &4.0), -0.5);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-26)
pub fn rate<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let SpringMass { c, .. } = system;
    -eps / (c + eps)
}

/// Eq. (1.27): the homogeneous solution, in m, at time `t`, with the constant `a` in m.
///
/// `u_h = A exp(−ε t / (c + ε))`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3.
///
/// ```
/// # #[cfg(feature = "mpfr")] {
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::homogeneous(&system, &4.0, &0.25, &0.0), 0.25);
/// # }
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-27)
pub fn homogeneous<T: Exponential>(system: &SpringMass<T>, eps: &T, a: &T, t: &T) -> T {
    a * (rate(system, eps) * t).exp()
}

/// Eq. (1.28): the particular solution, in m.
///
/// `u_nh = H − l`
///
/// Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::particular(&system), 2.0);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-28)
pub fn particular<T: Field>(system: &SpringMass<T>) -> T {
    let SpringMass { l, h, .. } = system;
    h - l
}

/// Eq. (1.29): the general solution, in m, at time `t`, with the constant `a` in m.
///
/// `u = A exp(−ε t / (c + ε)) + H − l`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3.
///
/// ```
/// # #[cfg(feature = "mpfr")] {
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::general(&system, &4.0, &0.25, &0.0), 2.25);
/// # }
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-29)
pub fn general<T: Exponential>(system: &SpringMass<T>, eps: &T, a: &T, t: &T) -> T {
    superposition(&homogeneous(system, eps, a, t), &particular(system))
}

/// The constant of (1.29) that meets the initial condition u(0) = `start`, in m.
///
/// `A = u₀ − H + l`
///
/// Domain: all. Source: §1.3.3, before (1.30).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::integration_constant(&system, &2.25), 0.25);
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-30)
pub fn integration_constant<T: Field>(system: &SpringMass<T>, start: &T) -> T {
    let SpringMass { l, h, .. } = system;
    start - h + l
}

/// Eq. (1.30): the solution that starts at `start`, in m, at time `t`; it tends to Δ, (1.31).
///
/// `u = (u₀ − H + l) exp(−ε t / (c + ε)) + H − l`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3.
///
/// ```
/// # #[cfg(feature = "mpfr")] {
/// # use spring_mass_contact::chapter::{SpringMass, ode};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(ode::solution(&system, &4.0, &2.25, &0.0), 2.25);
/// # }
/// ```
/// [In the book](../../../../book/convergence.html#eq-1-30)
pub fn solution<T: Exponential>(system: &SpringMass<T>, eps: &T, start: &T, t: &T) -> T {
    general(system, eps, &integration_constant(system, start), t)
}
