//! The closed form of (1.16): the k-th iterate without those before it.

use super::scalar::MAX_BITS;
use super::validate::{self, SolveError};
use super::{Interval, Iterate, Plane, Scalar, to_interval};
use crate::chapter::{SpringMass, augmented, penalty, structure};
use crate::number::PositivePart;

/// Encloses the k-th iterate of (1.16) in exact arithmetic, for the parameters as represented in their
/// scalar; `penalty` is ε > 0 in N/m and `start` is λ₀ in N. For rationals both bounds are the iterate
/// itself.
///
/// Evaluates the closed form with ρᵏ by repeated squaring, which takes about log₂ k products. The penetration
/// is not computed as a difference of lengths, so its relative accuracy stays while it decreases; about log₂
/// k bits of the accuracy of R are lost. For a result with n bits use [`Mpfr`](crate::number::Mpfr) with n +
/// 70 bits, which suffices for every k, plus the bits that R loses by cancellation.
///
/// # Errors
/// Returns an error if a parameter is not finite or out of its range, if the scalar cannot represent a bound,
/// or if a rational iterate (or a constant of [`Mpfr`](crate::number::Mpfr)), which has about k times as many
/// digits as ρ, would have more than about ten million binary digits.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::{chapter::SpringMass, solver::{Plane, kth_iterate}};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// // p_k = 2^−(k+2), of which l + u − H has nothing left at k = 100.
/// let step = kth_iterate(&system, &4.0, &0.0, 100, Plane::Unilateral)?;
/// let p = 2f64.powi(-102);
/// assert!(step.penetration.lower <= p && p <= step.penetration.upper);
/// assert!(step.penetration.upper - step.penetration.lower < 1e-12 * p);
/// assert!(step.multiplier.lower <= 2.0 && 2.0 <= step.multiplier.upper);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn kth_iterate<T: Scalar>(
    system: &SpringMass<T>,
    eps: &T,
    start: &T,
    k: u64,
    plane: Plane,
) -> Result<Iterate<Interval<T>>, SolveError> {
    validate::system(system)?;
    validate::positive("penalty", eps)?;
    validate::finite_number("initial multiplier", start)?;
    let (system, eps, lambda) = (system.as_ref().map(T::enclose), eps.enclose(), start.enclose());
    let rho = augmented::contraction(&system, &eps);
    // For λ ≥ 0 the closed forms with brackets suffice (see `closed`). A negative λ₀ needs one separate step.
    let (start, steps) = if plane == Plane::Unilateral && k > 0 && *start < T::zero() {
        (augmented::multiplier_after(&system, &lambda, &rho).positive_part(), k - 1)
    } else {
        (lambda, k)
    };
    let decay =
        T::power(&rho, steps).ok_or(SolveError::TooLong { quantity: "k-th iterate", digits: MAX_BITS })?;
    let mut iterate = closed(&system, &eps, &start, &decay, &rho, plane);
    if steps == 0 {
        iterate.multiplier = start;
    }
    Ok(Iterate {
        k,
        multiplier: to_interval(&iterate.multiplier, "multiplier")?,
        deflection: to_interval(&iterate.deflection, "deflection")?,
        penetration: to_interval(&iterate.penetration, "penetration")?,
        contact_force: to_interval(&iterate.contact_force, "contact force")?,
    })
}

/// Returns the iterate for the decay ρᵏ. A unilateral plane requires λ₀ ≥ 0 or k = 0.
///
/// With unilateral contact the next multiplier is ⟨A(λ)⟩, where A is the bilateral step; if the mass is
/// separated, A(λ) ≤ 0 and the multiplier is 0. A increases with λ and has the fixed point R. For R ≥ 0 and
/// λ₀ ≥ 0 no Aᵏ(λ₀) is negative, and no bracket is active. For R < 0 the Aᵏ(λ₀) decrease, and from the first
/// negative one both sides of λ_k = ⟨Aᵏ(λ₀)⟩ are 0; the mass is then separated, also in the result computed
/// from Aᵏ(λ₀) without its bracket.
fn closed<E: PositivePart>(
    system: &SpringMass<E>,
    eps: &E,
    start: &E,
    decay: &E,
    rho: &E,
    plane: Plane,
) -> Iterate<E> {
    let next = decay * rho;
    let bilateral = Iterate {
        k: 0,
        multiplier: augmented::multiplier_after(system, start, decay),
        deflection: augmented::deflection_after(system, eps, start, decay),
        penetration: augmented::penetration_after(system, eps, start, decay),
        contact_force: augmented::multiplier_after(system, start, &next),
    };
    match plane {
        Plane::Bilateral => bilateral,
        Plane::Unilateral => Iterate {
            k: 0,
            multiplier: bilateral.multiplier.positive_part(),
            deflection: bilateral.deflection.min(&structure::deflection(system)),
            // Without a penalty it is the penetration of the separated mass.
            penetration: bilateral.penetration.min(&penalty::penetration(system, &E::zero())),
            contact_force: bilateral.contact_force.positive_part(),
        },
    }
}
