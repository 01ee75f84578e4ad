//! Solution of a system: [`solve`] applies a [`Method`] and returns a [`Solution`] with rigorous bounds.
//!
//! ```
//! use spring_mass_contact::{chapter::SpringMass, solver::{Method, Outcome, State, solve}};
//!
//! let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
//! let method = Method::Augmented { penalty: 100.0, tolerance: 1e-12, max_augmentations: 1000, start: 0.0 };
//! let answer = solve(&system, &method)?;
//! assert_eq!((answer.state, answer.outcome), (State::Contact, Outcome::Converged));
//! assert_eq!(answer.augmentations, Some(35));
//! let force = answer.bounds.contact_force; // of the f64 parameters, which are not quite the decimals
//! assert!(force.lower <= 4.81 && 4.81 <= force.upper && force.upper - force.lower < 1e-14);
//! # Ok::<(), spring_mass_contact::solver::SolveError>(())
//! ```

mod augmentation;
mod closed;
mod functional;
mod root;
mod scalar;
mod solution;
mod validate;

#[cfg(feature = "mpfr")]
mod advise;
#[cfg(feature = "mpfr")]
mod count;
#[cfg(feature = "mpfr")]
mod display;
#[cfg(feature = "mpfr")]
mod format;
#[cfg(feature = "mpfr")]
mod gmp_scalars;
#[cfg(feature = "mpfr")]
mod guarantees;
#[cfg(feature = "mpfr")]
pub mod laws;
#[cfg(feature = "mpfr")]
mod read;
#[cfg(feature = "mpfr")]
mod residuals;
#[cfg(feature = "mpfr")]
mod rounding_laws;
#[cfg(feature = "mpfr")]
mod series;
#[cfg(feature = "mpfr")]
mod sweep;

pub use augmentation::{Augmentation, Iterate};
pub use closed::kth_iterate;
pub use functional::{
    DualEnclosure, FunctionalCondition, FunctionalError, penalty_for_functional, solve_functional,
};
pub use scalar::{Interval, Scalar};
pub use solution::{Bounds, MAX_AUGMENTATIONS, Method, Outcome, Plane, Solution, State};
pub use validate::SolveError;

#[cfg(feature = "mpfr")]
pub use {
    advise::{Advice, Recommendation, advise},
    count::exact_augmentation_count,
    format::{format_equation, format_short, format_short_bound},
    guarantees::{
        guaranteed_max_augmentations, is_convergence_guaranteed, required_precision, rounding_floor,
    },
    read::ReadError,
    series::series_penetration,
    sweep::{SweepRow, best_penalty, penalties, penalty_force_bound, sweep},
};

use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use num_traits::One;

/// Returns the value of a number that has been checked, or is the result of a solve.
#[cfg(feature = "mpfr")]
fn exact<T: crate::number::ToExact>(x: &T) -> crate::number::Exact {
    x.to_exact().expect("a finite number")
}

/// Solves a system with unilateral contact: the plane pushes and never pulls.
///
/// Always terminates, and never returns a NaN or an infinity; allocates nothing for f32 and f64. An
/// augmentation in rationals, whose length grows with every step, ends before it would take hours: a
/// multiplier has at most 2²¹ binary digits, and all of them together at most 2²⁶.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter is not finite or out of its range,
/// [`SolveError::OutOfRange`] if the scalar cannot represent a result, and [`SolveError::TooLong`] if an
/// augmentation in rationals exceeds the limit of digits.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::{Method, State, solve}};
/// // R = 2: the plane pushes; c u + N = m g.
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let exact = solve(&system, &Method::Lagrange)?;
/// assert_eq!((exact.state, exact.penetration, exact.contact_force), (State::Contact, 0.0, 2.0));
/// // By penalty p = R / (c + ε) and N = ε p.
/// let soft = solve(&system, &Method::Penalty { penalty: 4.0 })?;
/// assert_eq!((soft.penetration, soft.contact_force), (0.25, 1.0));
/// let error = solve(&SpringMass { c: -4.0, ..system }, &Method::Lagrange).unwrap_err();
/// assert_eq!(error.to_string(), "stiffness -4.0: must be greater than 0 and finite");
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn solve<T: Scalar>(system: &SpringMass<T>, method: &Method<T>) -> Result<Solution<T>, SolveError> {
    solve_observed(system, method, Plane::Unilateral, |_| {})
}

/// Solves a system with bilateral contact, as the chapter prints it: the plane also pulls, so that R < 0
/// gives N < 0.
///
/// # Errors
/// Returns the errors of [`solve`].
pub fn solve_bilateral<T: Scalar>(
    system: &SpringMass<T>,
    method: &Method<T>,
) -> Result<Solution<T>, SolveError> {
    solve_observed(system, method, Plane::Bilateral, |_| {})
}

/// Solves a system over the given plane and passes every augmentation to `each` as it is computed.
///
/// # Errors
/// Returns the errors of [`solve`].
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::{Method, Plane, solve_observed}};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let method = Method::Augmented { penalty: 4.0, tolerance: 0.1, max_augmentations: 9, start: 0.0 };
/// let mut penetrations = Vec::new();
/// solve_observed(&system, &method, Plane::Unilateral, |step| penetrations.push(step.penetration))?;
/// assert_eq!(penetrations, [0.25, 0.125, 0.0625]);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn solve_observed<T: Scalar>(
    system: &SpringMass<T>,
    method: &Method<T>,
    plane: Plane,
    each: impl FnMut(&Iterate<T>),
) -> Result<Solution<T>, SolveError> {
    validate::system(system)?;
    validate::method(method)?;
    validate::products(system)?;
    let enclosed = system.as_ref().map(T::enclose);
    let reaction = system::reaction(&enclosed);
    let state = State::from_reaction(&reaction, system);
    let target = ExactSolution::of(&enclosed, reaction, method, state, plane);
    // A separated mass does not meet the second spring of the penalty method.
    let is_free = target.free && matches!(method, Method::Penalty { .. });
    if let Some(eps) = method.penalty().filter(|_| !is_free) {
        validate::stiffness(system, eps)?;
    }
    let bounds = target.bounds::<T>()?;
    let raw = match method {
        Method::Lagrange => {
            let contact_force = match (state, plane) {
                (State::Contact, Plane::Unilateral) => contact::contact_force(system),
                (State::Contact | State::Separated, Plane::Bilateral) => lagrange::multiplier(system),
                (State::Grazing, _) | (State::Separated, Plane::Unilateral) => T::zero(),
            };
            let deflection =
                if target.free { structure::deflection(system) } else { lagrange::deflection(system) };
            let multiplier = Some(contact_force.clone());
            RawSolution { multiplier, ..RawSolution::direct(deflection, contact_force) }
        }
        Method::Penalty { .. } if target.free => {
            RawSolution::direct(structure::deflection(system), T::zero())
        }
        Method::Penalty { penalty: eps } => {
            let deflection = penalty::deflection(system, eps);
            let force = augmented::contact_force(system, &deflection);
            let force = if plane == Plane::Unilateral { force.positive_part() } else { force };
            RawSolution::direct(deflection, force)
        }
        Method::Augmented { penalty: eps, tolerance, max_augmentations, start } => {
            let steps = Augmentation::new(system, eps).with_multiplier(start.clone()).over(plane);
            iterate(steps, system, &enclosed, &target, tolerance, *max_augmentations, each)?
        }
    };
    let solution = Solution {
        state,
        outcome: raw.outcome,
        penetration: contact::penetration(system, &raw.deflection),
        deflection: raw.deflection,
        contact_force: raw.contact_force,
        multiplier: raw.multiplier,
        augmentations: raw.augmentations,
        floor: raw.floor,
        bounds,
    };
    validate::require_finite(&solution)?;
    Ok(solution)
}

/// Enclosures of the exact solution.
struct ExactSolution<E> {
    deflection: E,
    penetration: E,
    contact_force: E,
    state: State,
    /// Whether the mass is separated from a unilateral plane.
    free: bool,
}

impl<E: crate::number::PositivePart> ExactSolution<E> {
    /// Encloses the exact solution of the method; for the augmentation its limit, which is the solution by
    /// Lagrange multiplier.
    fn of<T: Scalar<Enclosure = E>>(
        enclosed: &SpringMass<E>,
        reaction: E,
        method: &Method<T>,
        state: State,
        plane: Plane,
    ) -> Self {
        let free = plane == Plane::Unilateral && state == State::Separated;
        match method {
            _ if free => {
                let deflection = structure::deflection(enclosed);
                let penetration = contact::penetration(enclosed, &deflection);
                ExactSolution { deflection, penetration, contact_force: E::zero(), state, free }
            }
            Method::Penalty { penalty: eps } => {
                let eps = eps.enclose();
                ExactSolution {
                    deflection: penalty::deflection(enclosed, &eps),
                    penetration: penalty::penetration(enclosed, &eps),
                    contact_force: force_at_root::<T>(enclosed, reaction, &eps),
                    state,
                    free,
                }
            }
            Method::Lagrange | Method::Augmented { .. } => ExactSolution {
                deflection: lagrange::deflection(enclosed),
                penetration: E::zero(),
                // λ = R, which `lagrange::multiplier` would compute again.
                contact_force: reaction,
                state,
                free,
            },
        }
    }

    /// Returns an enclosure of u − u*; in contact it is the penetration of u, which avoids cancellation.
    fn error(&self, enclosed: &SpringMass<E>, u: &E) -> E {
        if self.free { u - &self.deflection } else { contact::penetration(enclosed, u) }
    }

    /// Returns an upper bound of |u − u*|, the rounding error of the difference included.
    fn error_bound<T: Scalar<Enclosure = E>>(&self, enclosed: &SpringMass<E>, u: &T) -> T {
        T::magnitude(&self.error(enclosed, &u.enclose()))
    }

    fn bounds<T: Scalar<Enclosure = E>>(&self) -> Result<Bounds<T>, SolveError> {
        Ok(Bounds {
            deflection: to_interval(&self.deflection, "deflection")?,
            penetration: self.with_sign(to_interval(&self.penetration, "penetration")?),
            contact_force: self.with_sign(to_interval(&self.contact_force, "contact force")?),
        })
    }

    /// Returns the part of an enclosure of p or N with the sign of R, which is exact; neither p nor N has the
    /// opposite sign.
    fn with_sign<T: Scalar>(&self, Interval { lower, upper }: Interval<T>) -> Interval<T> {
        match self.state {
            State::Contact => Interval { lower: lower.positive_part(), upper },
            State::Grazing => Interval { lower: T::zero(), upper: T::zero() },
            State::Separated => Interval { lower, upper: upper.min(&T::zero()) },
        }
    }
}

/// Encloses ε R / (c + ε). If ε R overflows or underflows, multiplies the result for a reaction of 1 N by R.
fn force_at_root<T: Scalar>(
    enclosed: &SpringMass<T::Enclosure>,
    reaction: T::Enclosure,
    eps: &T::Enclosure,
) -> T::Enclosure {
    let force = penalty::contact_force_at_equilibrium(enclosed, eps);
    if T::magnitude(&force).is_finite() && T::sign(&force) == T::sign(&reaction) {
        return force;
    }
    penalty::contact_force_at_equilibrium(&root::reduced_system(enclosed.c.clone(), T::Enclosure::one()), eps)
        * reaction
}

/// Returns the bounds of the enclosure, or an error if the scalar cannot represent them.
fn to_interval<T: Scalar>(
    enclosure: &T::Enclosure,
    quantity: &'static str,
) -> Result<Interval<T>, SolveError> {
    let interval = T::interval(enclosure);
    let finite = interval.lower.is_finite() && interval.upper.is_finite();
    if finite { Ok(interval) } else { Err(SolveError::OutOfRange { quantity }) }
}

/// Result of a method before it is checked.
struct RawSolution<T> {
    outcome: Outcome,
    deflection: T,
    contact_force: T,
    multiplier: Option<T>,
    augmentations: Option<u64>,
    floor: Option<T>,
}

impl<T> RawSolution<T> {
    fn direct(deflection: T, contact_force: T) -> Self {
        RawSolution {
            outcome: Outcome::Direct,
            deflection,
            contact_force,
            multiplier: None,
            augmentations: None,
            floor: None,
        }
    }
}

fn iterate<T: Scalar>(
    mut steps: Augmentation<T>,
    system: &SpringMass<T>,
    enclosed: &SpringMass<T::Enclosure>,
    target: &ExactSolution<T::Enclosure>,
    tolerance: &T,
    max_augmentations: u64,
    mut each: impl FnMut(&Iterate<T>),
) -> Result<RawSolution<T>, SolveError> {
    let eps = steps.penalty().enclose();
    let free = target.free.then(|| structure::deflection(system));
    let (mut side, mut digits) = (None, 0_u64);
    loop {
        let step = steps.step();
        let length = step.multiplier.variable_bit_length();
        digits = digits.saturating_add(length);
        validate::digits(length, digits)?;
        validate::in_range(step.deflection.is_finite(), "deflection")?;
        validate::in_range(steps.multiplier().is_finite(), "multiplier")?;
        each(&step);
        // An a posteriori test; the error computed without a bound is never larger than its bound.
        let within = match &free {
            Some(free) => augmented::within_tolerance(&(&step.deflection - free), tolerance),
            None => augmented::within_tolerance(&step.penetration, tolerance),
        };
        let converged = within
            && target.error_bound(enclosed, &step.deflection) < *tolerance
            && residual_bound(steps.plane(), enclosed, &eps, &step) < *tolerance;
        // While λ < 0 the unilateral iterate does not approach the solution yet, and p = 0 has no meaning.
        let approaching = steps.plane() == Plane::Bilateral || step.multiplier >= T::zero();
        let sign = step.penetration.partial_cmp(&T::zero());
        let crossed = approaching && (step.penetration.is_zero() || *side.get_or_insert(sign) != sign);
        let outcome = if converged {
            Outcome::Converged
        } else if crossed || *steps.multiplier() == step.multiplier {
            Outcome::Stagnated
        } else if step.k >= max_augmentations {
            Outcome::IterationLimit
        } else {
            steps.reuse(step);
            continue;
        };
        return Ok(RawSolution {
            floor: (outcome == Outcome::Stagnated).then(|| target.error_bound(enclosed, &step.deflection)),
            outcome,
            deflection: step.deflection,
            contact_force: step.contact_force,
            multiplier: Some(step.multiplier),
            augmentations: Some(step.k),
        });
    }
}

/// Returns an upper bound of the natural residual of an iterate; with bilateral contact, of |p|.
fn residual_bound<T: Scalar>(
    plane: Plane,
    enclosed: &SpringMass<T::Enclosure>,
    eps: &T::Enclosure,
    step: &Iterate<T>,
) -> T {
    let u = step.deflection.enclose();
    T::magnitude(&match plane {
        Plane::Unilateral => augmented::natural_residual(enclosed, eps, &step.multiplier.enclose(), &u),
        Plane::Bilateral => contact::penetration(enclosed, &u),
    })
}

/// Returns the smallest penalty ε, in N/m, whose penetration is at most `tolerance`, in m (remark 1.3.2).
/// Returns `None` if every ε > 0 satisfies this, because the mass is separated or the spring alone is stiff
/// enough.
///
/// In floats the result is rounded; evaluate [`penalty::penalty_for`] in balls for a bound.
///
/// # Errors
/// Returns an error if a parameter is invalid or the penalty leaves the range of the scalar.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::penalty_for_penetration};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty_for_penetration(&system, &0.25)?, Some(4.0));
/// assert_eq!(penalty_for_penetration(&system, &0.5)?, None);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn penalty_for_penetration<T: Scalar>(
    system: &SpringMass<T>,
    tolerance: &T,
) -> Result<Option<T>, SolveError> {
    let state = State::of(system)?;
    validate::positive("tolerance", tolerance)?;
    if state != State::Contact {
        return Ok(None);
    }
    let eps = penalty::penalty_for(system, tolerance);
    if !eps.is_finite() || !system::reaction(system).is_finite() {
        return Err(SolveError::OutOfRange { quantity: "penalty" });
    }
    Ok((eps > T::zero()).then_some(eps))
}
