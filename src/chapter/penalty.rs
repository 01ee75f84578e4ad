//! §1.3.2 Penalty method: the plane as a second spring of stiffness ε. Equations (1.9)-(1.13).
//!
//! As printed the second spring also pulls; the forms named *unilateral* only push.

use super::{SpringMass, contact, structure, system};
use crate::number::{Dual, Field, PositivePart};

/// The penalty functional of (1.9), in J, at the penetration `p` in m: the energy of the second spring.
///
/// `W = ε p² / 2`
///
/// `eps` is the penalty ε in N/m. Domain: all. Source: §1.3.2, after (1.9).
///
/// ```
/// # use spring_mass_contact::chapter::penalty;
/// assert_eq!(penalty::functional(&4.0, &0.5), 0.5);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-9)
pub fn functional<T: Field>(eps: &T, p: &T) -> T {
    eps * p * p / T::int(2)
}

/// Eq. (1.9): the penalised energy, in J, at the deflection `u` in m.
///
/// `Π_p = Π + ε p² / 2`
///
/// `eps` is the penalty ε in N/m. Domain: all; convex for ε > −c. Source: §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::energy(&system, &4.0, &2.5), -12.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-9)
pub fn energy<T: Field>(system: &SpringMass<T>, eps: &T, u: &T) -> T {
    structure::potential_energy(system, u) + functional(eps, &contact::penetration(system, u))
}

/// The least penalised energy, in J: (1.9) at its minimum (1.13).
///
/// `min Π_p = Π(Δ) − R² / (2 (c + ε))`
///
/// Domain: c + ε > 0. Source: §1.3.2, (1.9) at (1.13).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::least_energy(&system, &4.0), -12.25);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-9)
pub fn least_energy<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let r = system::reaction(system);
    structure::potential_energy(system, &system::gap(system))
        - &r * &r / (T::int(2) * total_stiffness(system, eps))
}

/// Eq. (1.10): a penalty functional with any number of even terms, in J, at the penetration `p` in m.
///
/// `W = ε p² / 2 + ε₄ p⁴ + …`
///
/// `eps` is ε in N/m, `higher` holds ε₄ in N/m³, ε₆ in N/m⁵, …; none negative, not all zero. Source:
/// §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::penalty;
/// assert_eq!(penalty::series(&4.0, &[8.0], &0.5), 1.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-10)
pub fn series<T: Field>(eps: &T, higher: &[T], p: &T) -> T {
    let square = p * p;
    let mut power = square.clone();
    higher.iter().fold(functional(eps, p), |sum, coefficient| {
        power = &power * &square;
        sum + coefficient * &power
    })
}

/// The force of (1.10), in N, at the penetration `p` in m: the derivative of [`series`].
///
/// `W′ = ∂W/∂p`
///
/// Computed by automatic differentiation. Odd and increasing in `p`. Source: §1.3.2, from (1.10).
///
/// ```
/// # use spring_mass_contact::chapter::penalty;
/// assert_eq!(penalty::series_force(&4.0, &[8.0], &0.5), 6.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-10)
pub fn series_force<T: Field>(eps: &T, higher: &[T], p: &T) -> T {
    let higher: Vec<_> = higher.iter().cloned().map(Dual::constant).collect();
    series(&Dual::constant(eps.clone()), &higher, &Dual::variable(p.clone())).derivative
}

/// The residual of equilibrium with the penalty functional (1.10), in N, at the penetration `p` in m.
///
/// `r = c p + W′ − R`
///
/// Strictly increasing, and odd except for the constant, so it has exactly one root;
/// [`series_penetration`](crate::solver) finds it. Source: §1.3.2, from (1.10).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::series_residual(&system, &4.0, &[8.0], &0.5), 6.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-10)
pub fn series_residual<T: Field>(system: &SpringMass<T>, eps: &T, higher: &[T], p: &T) -> T {
    let SpringMass { c, .. } = system;
    c * p + series_force(eps, higher, p) - system::reaction(system)
}

/// Eq. (1.11): the residual of equilibrium by the penalty method, in N, at the deflection `u` in m.
///
/// `r = c u − m g + ε (l + u − H)`
///
/// `eps` is the penalty ε in N/m. Domain: all. Source: §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::residual(&system, &4.0, &2.25), 0.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-11)
pub fn residual<T: Field>(system: &SpringMass<T>, eps: &T, u: &T) -> T {
    let SpringMass { c, m, g, l, h } = system;
    c * u - m * g + eps * (l + u - h)
}

/// Eq. (1.12): the contact force of the penalty method, in N, at the deflection `u` in m.
///
/// `N = ε p`
///
/// `eps` is the penalty ε in N/m. Domain: all. Floats: at a computed (1.13) its error is at most
/// [`rounding::penalty_force_error`](super::rounding::penalty_force_error), which grows with ε. The force by
/// equilibrium, [`augmented::contact_force`](super::augmented::contact_force), keeps its accuracy. Source:
/// §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::contact_force(&system, &4.0, &2.25), 1.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-12)
pub fn contact_force<T: Field>(system: &SpringMass<T>, eps: &T, u: &T) -> T {
    eps * contact::penetration(system, u)
}

/// Fig. 1.2: the stiffness of the two springs side by side, in N/m.
///
/// `c + ε`
///
/// Domain: all. One rounding. Source: §1.3.2, Fig. 1.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::total_stiffness(&system, &4.0), 8.0);
/// ```
pub fn total_stiffness<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let SpringMass { c, .. } = system;
    c + eps
}

/// Eq. (1.13): the deflection by the penalty method, in m; its limit for ε → ∞ is Δ.
///
/// `u = (ε (H − l) + m g) / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Floats: for R > 0 its error is at most
/// [`rounding::deflection_error`](super::rounding::deflection_error). Source: §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::deflection(&system, &4.0), 2.25);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-13)
pub fn deflection<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let SpringMass { c, m, g, l, h } = system;
    (eps * (h - l) + m * g) / (c + eps)
}

/// Eq. (1.13), the form after division by ε, from which the limit is read off; in m.
///
/// `u = (H − l + m g / ε) / (c / ε + 1)`
///
/// `eps` is the penalty ε in N/m. Domain: ε ≠ 0, c + ε ≠ 0. Source: §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::deflection_divided(&system, &4.0), 2.25);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-13)
pub fn deflection_divided<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let SpringMass { c, m, g, l, h } = system;
    (h - l + m * g / eps) / (c / eps + T::one())
}

/// The penetration that the penalty method leaves, in m: (1.5) at (1.13), without its cancellation.
///
/// `p = R / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.2, after (1.13).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::penetration(&system, &4.0), 0.25);
/// ```
/// [In the book](../../../../book/penalty.html#fn-penalty-penetration)
pub fn penetration<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    system::reaction(system) / total_stiffness(system, eps)
}

/// The force at the root, in N: (1.12) at (1.13), without its cancellation.
///
/// `N = ε R / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.2, from (1.12).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::contact_force_at_equilibrium(&system, &4.0), 1.0);
/// ```
/// [In the book](../../../../book/penalty.html#eq-1-12)
pub fn contact_force_at_equilibrium<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    eps * system::reaction(system) / total_stiffness(system, eps)
}

/// Remark 1.3.2: the least penalty, in N/m, that keeps the penetration at or below `tolerance` > 0 in
/// m; every larger one does, too.
///
/// `ε = R / tol − c`
///
/// For R > 0; if it is not positive, and for R ≤ 0, any ε > 0 suffices. Source: §1.3.2.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::penalty_for(&system, &0.25), 4.0);
/// ```
/// [In the book](../../../../book/penalty.html#fn-penalty-penalty_for)
pub fn penalty_for<T: Field>(system: &SpringMass<T>, tolerance: &T) -> T {
    let SpringMass { c, .. } = system;
    system::reaction(system) / tolerance - c
}

/// Eq. (1.13) for unilateral contact (note 4): the deflection, in m.
///
/// `u = min(m g / c, (ε (H − l) + m g) / (c + ε))`
///
/// `eps` is the penalty ε in N/m. Domain: c > 0, ε > 0. Source: note 4.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, penalty};
/// let lifted = SpringMass { c: 4.0, m: 1.0, g: 4.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty::unilateral_deflection(&lifted, &4.0), 1.0); // hangs free
/// ```
/// [In the book](../../../../book/unilateral.html#fn-penalty-unilateral_deflection)
pub fn unilateral_deflection<T: PositivePart>(system: &SpringMass<T>, eps: &T) -> T {
    structure::deflection(system).min(&deflection(system, eps))
}
