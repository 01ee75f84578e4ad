//! §1.3.3 Augmented Lagrangian method: the multiplier is found by iteration. Equations (1.14)-(1.21),
//! (1.33).
//!
//! As printed the plane also pulls; the forms named *unilateral* (note 4) only push. What follows the
//! theorem's analogy with an ODE is in [`ode`](super::ode).

use super::{SpringMass, contact, penalty, structure, system};
use crate::number::{Field, OrderedField, PositivePart};

/// Eq. (1.14): the augmented functional, in J, at the deflection `u` in m.
///
/// `L = Π + λ p + ε p² / 2`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: all; convex in u for ε > −c.
/// Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::functional(&system, &4.0, &1.0, &2.5), -11.5);
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-14)
pub fn functional<T: Field>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    let p = contact::penetration(system, u);
    structure::potential_energy(system, u) + lambda * &p + penalty::functional(eps, &p)
}

/// The least value of (1.14) over u, in J.
///
/// `min L = Π(Δ) − (R − λ)² / (2 (c + ε))`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: c + ε > 0. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::least_value(&system, &4.0, &2.0), -12.0); // at λ = R it is Π(Δ)
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-14)
pub fn least_value<T: Field>(system: &SpringMass<T>, eps: &T, lambda: &T) -> T {
    let missing = system::reaction(system) - lambda;
    structure::potential_energy(system, &system::gap(system))
        - &missing * &missing / (T::int(2) * penalty::total_stiffness(system, eps))
}

/// Eq. (1.15): the derivative of (1.14) with respect to u, in N, at the deflection `u` in m.
///
/// `∂L/∂u = c u − m g + λ + ε p`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::stationarity(&system, &4.0, &1.0, &2.125), 0.0);
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-15)
pub fn stationarity<T: Field>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    structure::residual(system, u) + lambda + eps * contact::penetration(system, u)
}

/// Eq. (1.16), first line, and (1.18): the next multiplier, in N, from the deflection `u` in m.
///
/// `λ′ = λ + ε (l + u − H)`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::update(&system, &4.0, &1.0, &2.125), 1.5);
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-16)
pub fn update<T: Field>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    let SpringMass { l, h, .. } = system;
    lambda + eps * (l + u - h)
}

/// Eq. (1.16), second line, (1.19) and (1.20): the residual of equilibrium at one step, in N, at the
/// deflection `u` in m.
///
/// `r = c u − m g + λ + ε (l + u − H)`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::equilibrium(&system, &4.0, &1.0, &2.125), 0.0);
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-16)
pub fn equilibrium<T: Field>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    let SpringMass { c, m, g, l, h } = system;
    c * u - m * g + lambda + eps * (l + u - h)
}

/// Eq. (1.16), second line, solved: the deflection at one step, in m.
///
/// `u = (m g − λ + ε (H − l)) / (c + ε)`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: c + ε ≠ 0. The order of
/// operations matters in floats: for this one the distance of the computed iterates from the exact ones is
/// proved to be bounded by [`rounding::penetration_drift`](super::rounding::penetration_drift).
/// Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::deflection(&system, &4.0, &1.0), 2.125);
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-16)
pub fn deflection<T: Field>(system: &SpringMass<T>, eps: &T, lambda: &T) -> T {
    let SpringMass { c, m, g, l, h } = system;
    (m * g - lambda + eps * (h - l)) / (c + eps)
}

/// The contact force at one step, in N, from equilibrium at the deflection `u` in m.
///
/// `N = m g − c u`
///
/// Equal to λ_{k+1} in exact arithmetic, and the better of the two in floats. Remark 1.3.6 names λ_k,
/// which lags one step behind (note 6). Domain: all. Three roundings. Source: §1.3.3, from (1.18), (1.19).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::contact_force(&system, &2.125), 1.5);
/// ```
/// [In the book](../../../../book/augmented.html#fn-augmented-contact_force)
pub fn contact_force<T: Field>(system: &SpringMass<T>, u: &T) -> T {
    let SpringMass { c, m, g, .. } = system;
    m * g - c * u
}

/// The contraction factor of (1.16), dimensionless: each step multiplies the penetration by it.
///
/// `ρ = c / (c + ε)`
///
/// Between 0 and 1 for every ε > 0, which is Theorem 1.3.3. `eps` is the penalty ε in N/m. Domain:
/// c + ε ≠ 0. Source: §1.3.3, from (1.21).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::contraction(&system, &4.0), 0.5);
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-17)
pub fn contraction<T: Field>(system: &SpringMass<T>, eps: &T) -> T {
    let SpringMass { c, .. } = system;
    c / penalty::total_stiffness(system, eps)
}

/// (1.16) in closed form: the multiplier after k steps, in N, from the start `start` in N and the
/// decay `decay` = ρᵏ.
///
/// `λ_k = (λ₀ − R) ρᵏ + R`
///
/// Domain: all. Source: §1.3.3, by induction on k.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::multiplier_after(&system, &0.0, &0.25), 1.5); // k = 2
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-16)
pub fn multiplier_after<T: Field>(system: &SpringMass<T>, start: &T, decay: &T) -> T {
    let r = system::reaction(system);
    (start - &r) * decay + r
}

/// (1.16) in closed form: the penetration after k steps, in m, from the start `start` in N and the
/// decay `decay` = ρᵏ.
///
/// `p_k = ρᵏ (R − λ₀) / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3, by induction on k.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::penetration_after(&system, &4.0, &0.0, &0.25), 0.0625); // k = 2
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-17)
pub fn penetration_after<T: Field>(system: &SpringMass<T>, eps: &T, start: &T, decay: &T) -> T {
    decay * (system::reaction(system) - start) / penalty::total_stiffness(system, eps)
}

/// (1.16) in closed form: the deflection after k steps, in m, from the start `start` in N and the
/// decay `decay` = ρᵏ.
///
/// `u_k = Δ + ρᵏ (R − λ₀) / (c + ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c + ε ≠ 0. Source: §1.3.3, by induction on k.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::deflection_after(&system, &4.0, &0.0, &0.25), 2.0625); // k = 2
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-16)
pub fn deflection_after<T: Field>(system: &SpringMass<T>, eps: &T, start: &T, decay: &T) -> T {
    system::gap(system) + penetration_after(system, eps, start, decay)
}

/// Theorem 1.3.3 without powers: a bound of |p_k|/|p₀| that falls to 0 and whose proof needs no limit
/// of ρᵏ; `k` is the number of steps.
///
/// `c / (c + k ε)`
///
/// `eps` is the penalty ε in N/m. Domain: c > 0, ε > 0, k ≥ 0. Source: §1.3.3, Bernoulli's inequality.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::harmonic_bound(&system, &4.0, &3.0), 0.25); // ρ³ = 0.125
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-17)
pub fn harmonic_bound<T: Field>(system: &SpringMass<T>, eps: &T, k: &T) -> T {
    let SpringMass { c, .. } = system;
    c / (c + k * eps)
}

/// Eq. (1.21): both sides of the recursion in u alone, in N, at two deflections in m, one step apart.
///
/// `(c + ε) (u_{k+1} − u_k) = −ε (l − H) − ε u_k`
///
/// `eps` is the penalty ε in N/m. Domain: all. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let (left, right) = augmented::recursion(&system, &4.0, &2.25, &2.125);
/// assert_eq!((left, right), (-1.0, -1.0));
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-21)
pub fn recursion<T: Field>(system: &SpringMass<T>, eps: &T, u: &T, next: &T) -> (T, T) {
    let SpringMass { c, l, h, .. } = system;
    ((c + eps) * (next - u), -eps * (l - h) - eps * u)
}

/// Eq. (1.33): returns `true` if the penetration `p` is smaller than the tolerance, both in m.
///
/// `|p| < tol`
///
/// With unilateral contact use [`natural_residual`] instead: if the mass is separated, |p| tends to |R|/c. It
/// guarantees nothing in floats, where p̂ can be 0 although p is not.
/// Exact. Source: §1.3.3.
///
/// ```
/// # use spring_mass_contact::chapter::augmented;
/// assert!(augmented::within_tolerance(&-0.5, &1.0) && !augmented::within_tolerance(&1.0, &1.0));
/// ```
/// [In the book](../../../../book/augmented.html#eq-1-33)
pub fn within_tolerance<T: OrderedField>(p: &T, tolerance: &T) -> bool {
    p.abs() < *tolerance
}

/// Note 4: the augmented functional of unilateral contact, in J, at the deflection `u` in m.
///
/// `L = Π + (⟨λ + ε (l + u − H)⟩² − λ²) / (2 ε)`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: ε > 0. Source: note 4.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::unilateral_functional(&system, &4.0, &1.0, &2.5), -11.5); // (1.14)
/// ```
pub fn unilateral_functional<T: PositivePart>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    let n = update(system, eps, lambda, u).positive_part();
    structure::potential_energy(system, u) + (&n * &n - lambda * lambda) / (T::int(2) * eps)
}

/// Note 4: the next multiplier of unilateral contact, in N, from the deflection `u` in m.
///
/// `λ′ = ⟨λ + ε (l + u − H)⟩`
///
/// `eps` is the penalty ε in N/m, `lambda` the multiplier λ in N. Domain: all. Source: note 4.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::unilateral_update(&system, &4.0, &1.0, &1.0), 0.0);
/// ```
pub fn unilateral_update<T: PositivePart>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    update(system, eps, lambda, u).positive_part()
}

/// Note 4: the residual of equilibrium at one step with unilateral contact, in N, at `u` in m.
///
/// `r = c u − m g + ⟨λ + ε (l + u − H)⟩`
///
/// Both brackets are needed, here and in the update. `eps` is the penalty ε in N/m, `lambda` the
/// multiplier λ in N. Domain: all. Source: note 4.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::unilateral_equilibrium(&system, &4.0, &1.0, &2.125), 0.0);
/// ```
pub fn unilateral_equilibrium<T: PositivePart>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    contact::equilibrium(system, u, &unilateral_update(system, eps, lambda, u))
}

/// Note 4: the deflection at one step with unilateral contact, in m.
///
/// `u = min(m g / c, (m g − λ + ε (H − l)) / (c + ε))`
///
/// A minimum and not a difference with ⟨·⟩, whose rounding floor is far higher. `eps` is the penalty ε
/// in N/m, `lambda` the multiplier λ in N. Domain: c > 0, ε > 0. Source: note 4.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::unilateral_deflection(&system, &4.0, &-5.0), 2.5); // hangs free
/// ```
/// [In the book](../../../../book/unilateral.html#fn-augmented-unilateral_deflection)
pub fn unilateral_deflection<T: PositivePart>(system: &SpringMass<T>, eps: &T, lambda: &T) -> T {
    structure::deflection(system).min(&deflection(system, eps, lambda))
}

/// Note 4: the natural residual, in m, at the deflection `u` in m: the change of one step.
///
/// `r = max(p, −λ / ε)`
///
/// It is (λ_{k+1} − λ_k)/ε, bounds |u_k − u*| in every state, and *is* p in contact. `eps` is the
/// penalty ε in N/m, `lambda` the multiplier λ in N. Domain: ε > 0. Source: note 4.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, augmented};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(augmented::natural_residual(&system, &4.0, &1.0, &2.125), 0.125);
/// assert_eq!(augmented::natural_residual(&system, &4.0, &0.0, &1.0), 0.0); // free and done
/// ```
/// [In the book](../../../../book/unilateral.html#fn-augmented-natural_residual)
pub fn natural_residual<T: PositivePart>(system: &SpringMass<T>, eps: &T, lambda: &T, u: &T) -> T {
    -(-contact::penetration(system, u)).min(&(lambda / eps))
}
