//! What a user calls: [`solve`] a system by a [`Method`], get a [`Solution`] with rigorous bounds.
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
mod check;
mod closed;
#[cfg(feature = "mpfr")]
mod exact;
mod functional;
mod root;
mod scalar;
mod solution;

pub use augmentation::{Augmentation, Iterate};
pub use check::SolveError;
pub use closed::iterate_after;
#[cfg(feature = "mpfr")]
pub use exact::*;
pub use functional::{Condition, FunctionalError, Lifted, penalty_for_functional, solve_functional};
pub use scalar::{Interval, Scalar};
pub use solution::{Bounds, MAX_AUGMENTATIONS, Method, Outcome, Plane, Solution, State};

use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use num_traits::One;

/// Solves a system over a plane that never pulls.
///
/// Never loops for ever, and never returns a NaN or an infinity; for f32 and f64 it allocates nothing.
/// An augmentation in rationals, which become longer with every step, ends before it would take hours: no
/// multiplier has more than 2²² binary digits, and all of them together no more than 2²⁸.
///
/// # Errors
/// [`SolveError::Invalid`] for a parameter that is not finite or not in its range,
/// [`SolveError::OutOfRange`] where a result does not fit the scalar,
/// [`SolveError::TooLong`] where an augmentation in rationals has too many digits.
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

/// Solves a system as the chapter prints it: the plane also pulls, so that R < 0 has N < 0.
///
/// # Errors
/// As [`solve`].
pub fn solve_bilateral<T: Scalar>(
    system: &SpringMass<T>,
    method: &Method<T>,
) -> Result<Solution<T>, SolveError> {
    solve_observed(system, method, Plane::Bilateral, |_| {})
}

/// As [`solve`] or [`solve_bilateral`], and shows every step of an augmentation to `each` as it is made: to
/// whoever waits for a long one, or wants to keep them.
///
/// # Errors
/// As [`solve`].
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
    check::system(system)?;
    check::method(method)?;
    check::products(system)?;
    let enclosed = system.map(T::enclose);
    let reaction = system::reaction(&enclosed);
    let state = State::by(&reaction, system);
    let target = Target::of(&enclosed, reaction, method, state, plane);
    let bounds = target.bounds::<T>()?;
    let finish = |found: Found<T>| {
        let solution = Solution {
            state,
            outcome: found.outcome,
            penetration: contact::penetration(system, &found.deflection),
            deflection: found.deflection,
            contact_force: found.contact_force,
            multiplier: found.multiplier,
            augmentations: found.augmentations,
            floor: found.floor,
            bounds,
        };
        check::finite(&solution)?;
        Ok(solution)
    };
    match method {
        Method::Lagrange => {
            let contact_force = match (state, plane) {
                (State::Contact, Plane::Unilateral) => contact::contact_force(system),
                (State::Contact | State::Separated, Plane::Bilateral) => lagrange::multiplier(system),
                (State::Grazing, _) | (State::Separated, Plane::Unilateral) => T::zero(),
            };
            let deflection =
                if target.free { structure::deflection(system) } else { lagrange::deflection(system) };
            let multiplier = Some(contact_force.clone());
            finish(Found { multiplier, ..Found::directly(deflection, contact_force) })
        }
        Method::Penalty { penalty: eps } => finish(if target.free {
            Found::directly(structure::deflection(system), T::zero())
        } else {
            let deflection = penalty::deflection(system, eps);
            let force = augmented::contact_force(system, &deflection);
            let force = if plane == Plane::Unilateral { force.positive_part() } else { force };
            Found::directly(deflection, force)
        }),
        Method::Augmented { penalty: eps, tolerance, max_augmentations, start } => {
            check::stiffness(system, eps)?;
            let steps = Augmentation::new(system, eps).with_multiplier(start.clone()).over(plane);
            finish(iterate(steps, system, &enclosed, &target, tolerance, *max_augmentations, each)?)
        }
    }
}

/// The exact answer, enclosed.
struct Target<E> {
    deflection: E,
    penetration: E,
    contact_force: E,
    /// Does the mass hang free of the plane?
    free: bool,
}

impl<E: crate::number::PositivePart> Target<E> {
    /// The method's own exact answer; by augmentation its limit, which is Lagrange's.
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
                Target { deflection, penetration, contact_force: E::zero(), free }
            }
            Method::Penalty { penalty: eps } => {
                let eps = eps.enclose();
                Target {
                    deflection: penalty::deflection(enclosed, &eps),
                    penetration: penalty::penetration(enclosed, &eps),
                    contact_force: force_at_root::<T>(enclosed, reaction, &eps),
                    free,
                }
            }
            Method::Lagrange | Method::Augmented { .. } => Target {
                deflection: lagrange::deflection(enclosed),
                penetration: E::zero(),
                // λ = R: what `lagrange::multiplier` would compute again.
                contact_force: if state == State::Grazing { E::zero() } else { reaction },
                free,
            },
        }
    }

    /// u − u*, in contact by the penetration of u, which is formed without a detour.
    fn error(&self, enclosed: &SpringMass<E>, u: &E) -> E {
        if self.free { u - &self.deflection } else { contact::penetration(enclosed, u) }
    }

    fn bounds<T: Scalar<Enclosure = E>>(&self) -> Result<Bounds<T>, SolveError> {
        Ok(Bounds {
            deflection: bounded(&self.deflection, "deflection")?,
            penetration: bounded(&self.penetration, "penetration")?,
            contact_force: bounded(&self.contact_force, "contact force")?,
        })
    }
}

/// ε R / (c + ε), enclosed; where ε R overflows, as that of a reaction of 1 N, times R.
fn force_at_root<T: Scalar>(
    enclosed: &SpringMass<T::Enclosure>,
    reaction: T::Enclosure,
    eps: &T::Enclosure,
) -> T::Enclosure {
    let force = penalty::force_at_root(enclosed, eps);
    if T::magnitude(&force).is_finite() {
        return force;
    }
    penalty::force_at_root(&root::weighed(enclosed.c.clone(), T::Enclosure::one()), eps) * reaction
}

/// Its ends, if the scalar has them.
fn bounded<T: Scalar>(enclosure: &T::Enclosure, quantity: &'static str) -> Result<Interval<T>, SolveError> {
    let interval = T::interval(enclosure);
    let finite = interval.lower.is_finite() && interval.upper.is_finite();
    if finite { Ok(interval) } else { Err(SolveError::OutOfRange { quantity }) }
}

/// What a method comes up with, before it is checked.
struct Found<T> {
    outcome: Outcome,
    deflection: T,
    contact_force: T,
    multiplier: Option<T>,
    augmentations: Option<u64>,
    floor: Option<T>,
}

impl<T> Found<T> {
    fn directly(deflection: T, contact_force: T) -> Self {
        Found {
            outcome: Outcome::Direct,
            deflection,
            contact_force,
            multiplier: None,
            augmentations: None,
            floor: None,
        }
    }
}

/// More binary digits of one multiplier, or of those of all steps, take a computer minutes.
const LONGEST: u64 = 1 << 22;
const MOST_DIGITS: u64 = 1 << 28;

fn iterate<T: Scalar>(
    mut steps: Augmentation<T>,
    system: &SpringMass<T>,
    enclosed: &SpringMass<T::Enclosure>,
    target: &Target<T::Enclosure>,
    tolerance: &T,
    max_augmentations: u64,
    mut each: impl FnMut(&Iterate<T>),
) -> Result<Found<T>, SolveError> {
    let eps = steps.penalty().enclose();
    let free = target.free.then(|| structure::deflection(system));
    // How far is a deflection from the answer, the rounding of this question included?
    let bound = |u: &T| T::magnitude(&target.error(enclosed, &u.enclose()));
    let mut previous: Option<T> = None;
    let mut floor: Option<T> = None;
    let mut side = None;
    let mut digits = 0_u64;
    loop {
        let step = steps.step();
        let length = step.multiplier.growing_digits();
        digits = digits.saturating_add(length);
        if length > LONGEST {
            return Err(SolveError::TooLong { quantity: "multiplier", digits: LONGEST });
        } else if digits > MOST_DIGITS {
            return Err(SolveError::TooLong { quantity: "all multipliers together", digits: MOST_DIGITS });
        }
        check::in_range(step.deflection.is_finite(), "deflection")?;
        check::in_range(steps.multiplier().is_finite(), "multiplier")?;
        each(&step);
        // A posteriori. No bound is below what is computed of the error without one.
        let within = match &free {
            Some(free) => augmented::within_tolerance(&(&step.deflection - free), tolerance),
            None => augmented::within_tolerance(&step.penetration, tolerance),
        };
        let residual_within = || {
            let (u, lambda) = (step.deflection.enclose(), step.multiplier.enclose());
            let residual = match steps.plane() {
                Plane::Unilateral => augmented::natural_residual(enclosed, &eps, &lambda, &u),
                Plane::Bilateral => contact::penetration(enclosed, &u),
            };
            T::magnitude(&residual) < *tolerance
        };
        let converged = within && bound(&step.deflection) < *tolerance && residual_within();
        // Where λ < 0 the unilateral iterate has not begun to approach, and p = 0 means nothing.
        let approaching = steps.plane() == Plane::Bilateral || step.multiplier >= T::zero();
        let sign = step.penetration.partial_cmp(&T::zero());
        let crossed = approaching && (step.penetration.is_zero() || *side.get_or_insert(sign) != sign);
        let outcome = if converged {
            Outcome::Converged
        } else if crossed || *steps.multiplier() == step.multiplier {
            Outcome::Stagnated
        } else if step.k >= max_augmentations {
            Outcome::OutOfSteps
        } else {
            if !approaching {
                floor = Some(bound(&step.deflection));
            }
            // The last two deflections are kept, all else is computed over.
            let spare = previous.replace(step.deflection).unwrap_or_else(T::zero);
            steps.reuse(Iterate { deflection: spare, ..step });
            continue;
        };
        let floor = (outcome == Outcome::Stagnated).then(|| {
            // What is computed of the error falls once it approaches, unless the last step crossed over.
            let earlier = previous.as_ref().map(&bound).into_iter().chain(floor);
            earlier.fold(bound(&step.deflection), |least, bound| least.min(&bound))
        });
        return Ok(Found {
            outcome,
            deflection: step.deflection,
            contact_force: step.contact_force,
            multiplier: Some(step.multiplier),
            augmentations: Some(step.k),
            floor,
        });
    }
}

/// Remark 1.3.2 as a user asks it: the least penalty, in N/m, whose penetration is at most `tolerance`
/// in m; `None` if every ε > 0 has that (the mass hangs free, or the spring alone is stiff enough).
///
/// In floats it is rounded like any formula; read [`penalty::penalty_for`] in balls for its bound.
///
/// # Errors
/// A parameter is invalid, or the penalty leaves the range.
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
    check::positive("tolerance", tolerance)?;
    if state != State::Contact {
        return Ok(None);
    }
    let eps = penalty::penalty_for(system, tolerance);
    if !eps.is_finite() || !system::reaction(system).is_finite() {
        return Err(SolveError::OutOfRange { quantity: "penalty" });
    }
    Ok((eps > T::zero()).then_some(eps))
}
