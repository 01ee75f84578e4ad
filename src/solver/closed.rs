//! (1.16) in closed form: one iterate without those before it.

use super::check::{self, SolveError};
use super::scalar::LONGEST;
use super::{Interval, Iterate, Plane, Scalar, bounded};
use crate::chapter::{SpringMass, augmented, penalty, structure};
use crate::number::PositivePart;

/// The k-th iterate of (1.16) in exact arithmetic, enclosed, for the parameters as they are in their scalar:
/// penalty ε > 0 in N/m, `start` = λ₀ in N. For rationals both ends are the iterate itself.
///
/// By the closed forms of (1.16), with ρᵏ by repeated squaring: so many products as k has binary digits, and
/// no steps. The penetration is not found as a difference of lengths and keeps its digits while it shrinks:
/// of those that R has, about log₂ k bits are lost. For an answer to so many digits, take
/// [`Mpfr`](crate::number::Mpfr) of as many bits and 70 more, enough for any k, and as many again as R
/// loses where it cancels.
///
/// # Errors
/// A parameter is not finite or not in its range, or a bound is beyond the scalar. Rationals, whose k-th
/// iterate has about k times as many digits as ρ, are refused from some ten million binary digits on; so are
/// constants of [`Mpfr`](crate::number::Mpfr).
///
/// ```
/// use spring_mass_contact::{chapter::SpringMass, solver::{Plane, iterate_after}};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// // p_k = 2^−(k+2), of which l + u − H has nothing left at k = 100.
/// let step = iterate_after(&system, &4.0, &0.0, 100, Plane::Unilateral)?;
/// let p = 2f64.powi(-102);
/// assert!(step.penetration.lower <= p && p <= step.penetration.upper);
/// assert!(step.penetration.upper - step.penetration.lower < 1e-12 * p);
/// assert!(step.multiplier.lower <= 2.0 && 2.0 <= step.multiplier.upper);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn iterate_after<T: Scalar>(
    system: &SpringMass<T>,
    eps: &T,
    start: &T,
    k: u64,
    plane: Plane,
) -> Result<Iterate<Interval<T>>, SolveError> {
    check::system(system)?;
    check::positive("penalty", eps)?;
    check::finite_number("initial multiplier", start)?;
    let (system, eps, lambda) = (system.map(T::enclose), eps.enclose(), start.enclose());
    let rho = augmented::contraction(&system, &eps);
    // From λ ≥ 0 on, brackets around the closed forms are all it takes (see `closed`). A negative λ₀ has one
    // step of its own.
    let (start, steps) = if plane == Plane::Unilateral && k > 0 && *start < T::zero() {
        (augmented::multiplier_after(&system, &lambda, &rho).positive_part(), k - 1)
    } else {
        (lambda, k)
    };
    let decay =
        T::power(&rho, steps).ok_or(SolveError::TooLong { quantity: "k-th iterate", digits: LONGEST })?;
    let mut iterate = closed(&system, &eps, &start, &decay, &rho, plane);
    if steps == 0 {
        iterate.multiplier = start;
    }
    Ok(Iterate {
        k,
        multiplier: bounded(&iterate.multiplier, "multiplier")?,
        deflection: bounded(&iterate.deflection, "deflection")?,
        penetration: bounded(&iterate.penetration, "penetration")?,
        contact_force: bounded(&iterate.contact_force, "contact force")?,
    })
}

/// The iterate at which the decay is ρᵏ; over a plane that never pulls for λ₀ ≥ 0, or for k = 0.
///
/// There the next multiplier is ⟨A(λ)⟩, A being the bilateral step: where the mass hangs free, A(λ) ≤ 0, and
/// it is 0. A rises with λ and leaves R where it is. For R ≥ 0 and λ₀ ≥ 0 no Aᵏ(λ₀) is negative, and no
/// bracket acts; for R < 0 the Aᵏ(λ₀) fall, and from the first that is negative both sides of λ_k = ⟨Aᵏ(λ₀)⟩
/// are 0. The mass then hangs free, also by what is computed from Aᵏ(λ₀) without its bracket.
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
            // With no penalty it is that of a mass which hangs free.
            penetration: bilateral.penetration.min(&penalty::penetration(system, &E::zero())),
            contact_force: bilateral.contact_force.positive_part(),
        },
    }
}
