//! Beyond the chapter: further consequences of its equations.

use super::{SpringMass, contact, penalty, structure, system};
use crate::number::{Field, PositivePart};

/// Beyond 2: the one penalty, in N/m, that leaves the penetration of k augmentations from λ₀ = 0, with
/// `growth` = ((c + ε)/c)ᵏ⁺¹, dimensionless.
///
/// `ε_eff = c (growth − 1)`
///
/// If penalties vary from step to step, `growth` is the product of the (c + ε_i)/c. Domain: all.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, beyond};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(beyond::effective_penalty(&system, &8.0), 28.0); // ε = 4, k = 2
/// ```
/// [In the book](../../../../book/beyond.html#fn-beyond-effective_penalty)
pub fn effective_penalty<T: Field>(system: &SpringMass<T>, growth: &T) -> T {
    let SpringMass { c, .. } = system;
    c * (growth - T::one())
}

/// Beyond 3: the update of (1.16) with a step `step` in N/m of its own in place of ε, in N.
///
/// `λ′ = λ + α p`
///
/// Domain: all. With α = c + ε it is exact in one step.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, beyond};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(beyond::relaxed_update(&system, &8.0, &1.0, &2.125), 2.0); // R
/// ```
pub fn relaxed_update<T: Field>(system: &SpringMass<T>, step: &T, lambda: &T, u: &T) -> T {
    lambda + step * contact::penetration(system, u)
}

/// Beyond 3: the factor by which [`relaxed_update`] multiplies the error of the multiplier.
///
/// `1 − α / (c + ε)`
///
/// `eps` is the penalty ε in N/m, `step` is α in N/m; ε = 0 is Uzawa's method. Domain: c + ε ≠ 0.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, beyond};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(beyond::relaxed_contraction(&system, &4.0, &8.0), 0.0);
/// ```
pub fn relaxed_contraction<T: Field>(system: &SpringMass<T>, eps: &T, step: &T) -> T {
    T::one() - step / penalty::total_stiffness(system, eps)
}

/// Beyond 4: the dual functional, in J: the least value of (1.7) over u at the multiplier `lambda` in N.
///
/// `d = Π(Δ) − (λ − R)² / (2 c)`
///
/// Domain: c > 0.
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, beyond};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(beyond::dual_functional(&system, &0.0), -12.5); // without the plane's force: min Π
/// ```
/// [In the book](../../../../book/beyond.html#fn-beyond-dual_functional)
pub fn dual_functional<T: Field>(system: &SpringMass<T>, lambda: &T) -> T {
    let SpringMass { c, .. } = system;
    let missing = lambda - system::reaction(system);
    structure::potential_energy(system, &system::gap(system)) - &missing * &missing / (T::int(2) * c)
}

/// Beyond 5: Aitken's extrapolation of three successive multipliers, in N.
///
/// `λ₀ − (λ₁ − λ₀)² / (λ₂ − 2 λ₁ + λ₀)`
///
/// Exact, since the sequence (1.16) is geometric. Domain: the three do not lie on a line (λ₀ ≠ R).
///
/// ```
/// # use spring_mass_contact::chapter::beyond;
/// assert_eq!(beyond::aitken(&0.0, &1.0, &1.5), 2.0); // R
/// ```
/// [In the book](../../../../book/beyond.html#fn-beyond-aitken)
pub fn aitken<T: Field>(first: &T, second: &T, third: &T) -> T {
    let step = second - first;
    first - &step * &step / (third - T::int(2) * second + first)
}

/// Beyond 6: the exact penalty functional, in J, at the penetration `p` in m.
///
/// `W = ε ⟨p⟩`
///
/// Not smooth, and exact for every `eps` ≥ R, a *force* in N. Domain: all.
///
/// ```
/// # use spring_mass_contact::chapter::beyond;
/// assert_eq!(beyond::exact_penalty(&3.0, &0.5), 1.5);
/// assert_eq!(beyond::exact_penalty(&3.0, &-0.5), 0.0);
/// ```
pub fn exact_penalty<T: PositivePart>(eps: &T, p: &T) -> T {
    eps * p.positive_part()
}
