//! What is solved for, how, and what comes of it.

use super::{Interval, Scalar, SolveError, check};
use crate::chapter::{SpringMass, system};
use crate::number::Field;
use std::cmp::Ordering;
use std::fmt;

/// Whether the mass and the plane touch, decided exactly by the sign of R = m g − c (H − l).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// R > 0: the plane pushes.
    Contact,
    /// R = 0: they touch without force, which (1.6) as printed leaves out (note 1).
    Grazing,
    /// R < 0: the mass hangs free.
    Separated,
}

/// As JSON and CSV have it.
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
    /// The state of a system, whatever rounding does.
    ///
    /// It is decided by the reaction and its error bound; where these leave it open, without any rounding.
    ///
    /// # Errors
    /// [`SolveError::Invalid`] for a parameter that is not finite or not in its range: without c > 0
    /// nothing comes to rest, and R decides nothing.
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
        check::system(system)?;
        Ok(State::by(&system::reaction(&system.map(T::enclose)), system))
    }

    /// The state of a system whose reaction is known to be in this enclosure.
    pub(super) fn by<T: Scalar>(reaction: &T::Enclosure, system: &SpringMass<T>) -> State {
        let SpringMass { c, m, g, l, h } = system;
        let exactly = || T::sign_of_sum([(m, g), (c, l)], (c, h));
        match T::sign(reaction).unwrap_or_else(exactly) {
            Ordering::Greater => State::Contact,
            Ordering::Equal => State::Grazing,
            Ordering::Less => State::Separated,
        }
    }
}

/// Which way the plane can act.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Plane {
    /// It pushes and never pulls: what (1.6) asks for, and what a user needs.
    #[default]
    Unilateral,
    /// It pushes and pulls, as the equations of the chapter read where they are printed (note 4).
    Bilateral,
}

/// How to solve. All quantities in SI units.
///
/// With the feature `serde` it is serialised under the keys of `contact solve --batch`: `method`, `penalty`,
/// `tolerance`, `max_augmentations`, `initial_multiplier`, quantities as texts; and read back as a
/// [`SpringMass`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        tag = "method",
        rename_all = "snake_case",
        bound(
            serialize = "T: crate::number::Text",
            deserialize = "T: crate::number::Text + crate::number::Field"
        )
    )
)]
pub enum Method<T> {
    /// §1.3.1: exact.
    Lagrange,
    /// §1.3.2: with the penetration R/(c + ε).
    Penalty {
        /// ε > 0, in N/m.
        #[cfg_attr(feature = "serde", serde(with = "crate::number::lossless"))]
        penalty: T,
    },
    /// §1.3.3: repeated until the tolerance is met.
    Augmented {
        /// ε > 0, in N/m.
        #[cfg_attr(feature = "serde", serde(with = "crate::number::lossless"))]
        penalty: T,
        /// tol > 0, in m: how far the deflection may be from the exact one.
        #[cfg_attr(feature = "serde", serde(with = "crate::number::lossless"))]
        tolerance: T,
        /// The last k tried; 0 solves once.
        max_augmentations: u64,
        /// λ₀ in N: 0, or a guess (a warm start).
        #[cfg_attr(
            feature = "serde",
            serde(rename = "initial_multiplier", with = "crate::number::lossless")
        )]
        start: T,
    },
}

/// The limit of augmentations where nobody names one: what [`Method::augmented`] and advice keep to, and
/// the default of the command.
pub const MAX_AUGMENTATIONS: u64 = 1000;

impl<T: Field> Method<T> {
    /// By augmentation with the penalty ε > 0 in N/m, from λ₀ = 0, to a tolerance of 10⁻⁹ m, in
    /// [`MAX_AUGMENTATIONS`] at most: the defaults of the command.
    ///
    /// A tolerance is a length, and only who knows the lengths of the system knows one that is small:
    /// name it, by [`Method::Augmented`], or ask `advise`. Where rounding does not let this one be met, as
    /// in f32 with lengths of some metres, the outcome is [`Outcome::Stagnated`], and [`Solution::floor`]
    /// says what was reached. In numbers so coarse that it rounds to 0, `solve` refuses it.
    ///
    /// ```
    /// # use spring_mass_contact::{chapter::SpringMass, solver::{Method, Outcome, solve}};
    /// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    /// let answer = solve(&system, &Method::augmented(4.0))?;
    /// // p_k = 2^−(k+2) is below 10⁻⁹ from k = 28 on.
    /// assert_eq!((answer.outcome, answer.augmentations), (Outcome::Converged, Some(28)));
    /// let narrow = system.map(|x| *x as f32);
    /// assert_eq!(solve(&narrow, &Method::augmented(4.0))?.outcome, Outcome::Stagnated);
    /// # Ok::<(), spring_mass_contact::solver::SolveError>(())
    /// ```
    pub fn augmented(penalty: T) -> Self {
        Method::Augmented {
            penalty,
            // One rounding: 10⁹ is a float.
            tolerance: T::one() / T::int(1_000_000_000),
            max_augmentations: MAX_AUGMENTATIONS,
            start: T::zero(),
        }
    }
}

impl<T> Method<T> {
    /// ε, in N/m, where there is one.
    pub fn penalty(&self) -> Option<&T> {
        match self {
            Method::Lagrange => None,
            Method::Penalty { penalty } | Method::Augmented { penalty, .. } => Some(penalty),
        }
    }
}

/// How a solve ended. Only an iteration can end otherwise than [`Direct`](Outcome::Direct).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Outcome {
    /// There was nothing to iterate.
    Direct,
    /// The natural residual and a rigorous bound of |u − u*| are both below the tolerance.
    Converged,
    /// Rounding stopped the iteration before: the multiplier repeats, or the penetration is zero or
    /// changes sign. What more steps would gain is a matter of luck; [`Solution::floor`] says what was
    /// reached.
    Stagnated,
    /// The limit of augmentations came first.
    OutOfSteps,
}

/// As JSON and CSV have it.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Outcome::Direct => "direct",
            Outcome::Converged => "converged",
            Outcome::Stagnated => "stagnated",
            Outcome::OutOfSteps => "out_of_steps",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(State, Outcome);

/// Rigorous enclosures of the exact answer, for the parameters as they are in their scalar.
///
/// For Lagrange and penalty the method's own exact answer; for augmented the limit, whatever the outcome.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::Text"))]
#[non_exhaustive]
pub struct Bounds<T> {
    /// Of the deflection, in m.
    pub deflection: Interval<T>,
    /// Of the penetration, in m.
    pub penetration: Interval<T>,
    /// Of the contact force, in N.
    pub contact_force: Interval<T>,
}

/// What [`solve`](super::solve) finds.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::Text"))]
#[non_exhaustive]
pub struct Solution<T> {
    /// Contact, grazing or separated.
    pub state: State,
    /// How the solve ended.
    pub outcome: Outcome,
    /// u, in m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub deflection: T,
    /// p = l + u − H of this deflection, in m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub penetration: T,
    /// N = m g − c u, in N; exactly 0 where the mass hangs free, and at grazing by Lagrange.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub contact_force: T,
    /// λ (of this step: λ_k), in N; none by penalty.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::option"))]
    pub multiplier: Option<T>,
    /// k, the number of augmentations of the iterate returned; none without iteration.
    pub augmentations: Option<u64>,
    /// The least bound of |u − u*| met, in m, if the iteration stagnated: of the last two deflections and,
    /// if it began with λ₀ < 0, of the first. In between the error falls, as it is computed; so the bound of
    /// no other deflection is less, or only by what bounds themselves are rounded by.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::option"))]
    pub floor: Option<T>,
    /// Where the exact answer lies.
    pub bounds: Bounds<T>,
}
