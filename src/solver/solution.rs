//! Types of the solver: state, plane, method, outcome and solution.

use super::{Interval, Scalar, SolveError, validate};
use crate::chapter::{SpringMass, system};
use crate::number::Field;
use std::cmp::Ordering;
use std::fmt;

/// Contact state of mass and plane, decided exactly by the sign of R = m g − c (H − l).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// R > 0: the plane pushes (active contact).
    Contact,
    /// R = 0: mass and plane touch without force, which (1.6) as printed omits (note 1).
    Grazing,
    /// R < 0: the mass is separated from the plane.
    Separated,
}

/// Writes the name used in JSON and CSV.
impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            State::Contact => "contact",
            State::Grazing => "grazing",
            State::Separated => "separated",
        })
    }
}

impl State {
    /// Returns the exact state of a system, independent of rounding.
    ///
    /// The reaction and its error bound decide it; if they leave it undecided, it is computed without
    /// rounding.
    ///
    /// # Errors
    /// Returns [`SolveError::Invalid`] if a parameter is not finite or out of its range: without c > 0 there
    /// is no equilibrium.
    ///
    /// # Examples
    ///
    /// ```
    /// # use spring_mass_contact::{chapter::{SpringMass, system}, solver::State};
    /// // In f64 m g rounds up, and all the way to c (H − l).
    /// let system = SpringMass { c: 1.0, m: 3.0, g: 0.1, l: 0.0, h: 0.30000000000000004 };
    /// assert_eq!(system::reaction(&system), 0.0);
    /// assert_eq!(State::of(&system)?, State::Separated);
    /// let error = State::of(&SpringMass { g: f64::NAN, ..system }).unwrap_err();
    /// assert_eq!(error.to_string(), "gravity NaN: must be finite");
    /// # Ok::<(), spring_mass_contact::solver::SolveError>(())
    /// ```
    pub fn of<T: Scalar>(system: &SpringMass<T>) -> Result<State, SolveError> {
        validate::system(system)?;
        Ok(State::from_reaction(&system::reaction(&system.as_ref().map(T::enclose)), system))
    }

    /// Returns the state of a system from an enclosure of its reaction.
    pub(super) fn from_reaction<T: Scalar>(reaction: &T::Enclosure, system: &SpringMass<T>) -> State {
        let SpringMass { c, m, g, l, h } = system;
        match T::sign(reaction).unwrap_or_else(|| T::sign_of_sum([(m, g), (c, l)], (c, h))) {
            Ordering::Greater => State::Contact,
            Ordering::Equal => State::Grazing,
            Ordering::Less => State::Separated,
        }
    }
}

/// Direction of the force that the plane can exert.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Plane {
    /// Unilateral contact: the plane pushes and never pulls, as in (1.6).
    #[default]
    Unilateral,
    /// Bilateral contact: the plane pushes and pulls, as in the printed equations of the chapter (note 4).
    Bilateral,
}

/// Method of solution, with all quantities in SI units.
///
/// The feature `serde` serialises it with the keys of `contact solve --batch`: `method`, `penalty`,
/// `tolerance`, `max_augmentations`, `initial_multiplier`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "method", rename_all = "snake_case")
)]
pub enum Method<T> {
    /// Lagrange multiplier (§1.3.1): exact.
    Lagrange,
    /// Penalty (§1.3.2), with the penetration R/(c + ε).
    Penalty {
        /// ε > 0, in N/m.
        penalty: T,
    },
    /// Augmented Lagrangian (§1.3.3), iterated until the tolerance is met.
    Augmented {
        /// ε > 0, in N/m.
        penalty: T,
        /// Tolerance > 0, in m: the allowed error of the deflection.
        tolerance: T,
        /// Largest k; 0 solves once.
        max_augmentations: u64,
        /// λ₀ in N: 0, or an estimate (warm start).
        #[cfg_attr(feature = "serde", serde(rename = "initial_multiplier"))]
        start: T,
    },
}

/// Default limit of augmentations, used by [`Method::augmented`], by the advice and by the command.
pub const MAX_AUGMENTATIONS: u64 = 1000;

impl<T: Field> Method<T> {
    /// Returns the augmentation with the penalty ε > 0, in N/m, from λ₀ = 0, to a tolerance of 10⁻⁹ m in at
    /// most [`MAX_AUGMENTATIONS`]: the defaults of the command.
    ///
    /// The tolerance is a length that should be small relative to the lengths of the system: choose it with
    /// [`Method::Augmented`] or with `advise`. If rounding prevents convergence to this tolerance, as in f32
    /// with lengths of some metres, the outcome is [`Outcome::Stagnated`], and [`Solution::floor`] is the
    /// accuracy attained. In numbers so coarse that it rounds to 0, `solve` refuses it.
    ///
    /// ```
    /// # use spring_mass_contact::{chapter::SpringMass, solver::{Method, Outcome, solve}};
    /// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    /// let answer = solve(&system, &Method::augmented(4.0))?;
    /// // p_k = 2^−(k+2) is below 10⁻⁹ from k = 28 on.
    /// assert_eq!((answer.outcome, answer.augmentations), (Outcome::Converged, Some(28)));
    /// let narrow = system.map(|x| x as f32);
    /// assert_eq!(solve(&narrow, &Method::augmented(4.0))?.outcome, Outcome::Stagnated);
    /// # Ok::<(), spring_mass_contact::solver::SolveError>(())
    /// ```
    pub fn augmented(penalty: T) -> Self {
        Method::Augmented {
            penalty,
            // One rounding, since 10⁹ is a float.
            tolerance: T::one() / T::int(1_000_000_000),
            max_augmentations: MAX_AUGMENTATIONS,
            start: T::zero(),
        }
    }
}

impl<T> Method<T> {
    /// Returns ε, in N/m, if the method has a penalty.
    pub fn penalty(&self) -> Option<&T> {
        match self {
            Method::Lagrange => None,
            Method::Penalty { penalty } | Method::Augmented { penalty, .. } => Some(penalty),
        }
    }
}

/// Outcome of a solve. Only an iteration can end otherwise than [`Direct`](Outcome::Direct).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// No iteration was needed.
    Direct,
    /// The natural residual and a rigorous bound of |u − u*| are both below the tolerance.
    Converged,
    /// Rounding stopped the iteration: the multiplier repeats, or the penetration is zero or changes sign.
    /// Further steps could improve the result only by chance; [`Solution::floor`] is the accuracy attained.
    Stagnated,
    /// The limit of augmentations was reached.
    IterationLimit,
}

/// Writes the name used in JSON and CSV.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Outcome::Direct => "direct",
            Outcome::Converged => "converged",
            Outcome::Stagnated => "stagnated",
            Outcome::IterationLimit => "iteration_limit",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(State, Outcome);

/// Rigorous enclosures of the exact solution, for the parameters as represented in their scalar.
///
/// For the Lagrange multiplier and the penalty it is the exact solution of the method; for the augmentation
/// its limit, for every outcome.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Bounds<T> {
    /// Enclosure of the deflection, in m.
    pub deflection: Interval<T>,
    /// Enclosure of the penetration, in m.
    pub penetration: Interval<T>,
    /// Enclosure of the contact force, in N.
    pub contact_force: Interval<T>,
}

/// Result of [`solve`](super::solve).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Solution<T> {
    /// State: contact, grazing or separated.
    pub state: State,
    /// Outcome of the method.
    pub outcome: Outcome,
    /// u, in m.
    pub deflection: T,
    /// p = l + u − H of this deflection, in m.
    pub penetration: T,
    /// N = m g − c u, in N; exactly 0 if the mass is separated, and at grazing by Lagrange multiplier.
    pub contact_force: T,
    /// Multiplier λ_k of the iterate, in N; `None` for the penalty method.
    pub multiplier: Option<T>,
    /// Number k of augmentations of the returned iterate; `None` without iteration.
    pub augmentations: Option<u64>,
    /// Bound of |u − u*| of this deflection, in m, if the iteration stagnated. It is below the tolerance if
    /// only the natural residual is not.
    pub floor: Option<T>,
    /// Enclosures of the exact solution.
    pub bounds: Bounds<T>,
}
