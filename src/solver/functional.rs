//! User-defined penalty functionals (§1.3.2): their conditions and their equilibrium.

use super::root::{PenaltyEquation, RootBracket, middle, reduced_system};
use super::validate::{self, SolveError};
use super::{Bounds, Interval, Method, Outcome, Scalar, Solution, State, solve, to_interval};
use crate::chapter::{SpringMass, augmented, contact, structure, system};
use crate::number::{Dual, PositivePart};
use num_traits::Zero;
use std::cmp::Ordering;
use std::fmt;

/// Argument and value of a penalty functional: an enclosure, which bounds the rounding error, with its
/// derivative.
pub type DualEnclosure<T> = Dual<<T as Scalar>::Enclosure>;

/// Condition on a penalty functional W(p) for p ≥ 0.
///
/// The first two and the last are those of the chapter, as corrected by note 3. [`solve_functional`] also
/// requires the others: if the force of W decreases, there can be more than one equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FunctionalCondition {
    /// Condition 1: W(0) = 0.
    ZeroAtContact,
    /// Condition 2: W does not decrease with p.
    Monotone,
    /// W is continuous.
    Continuous,
    /// W is convex: its force W′ does not decrease with p.
    Convex,
    /// Condition 3: W at a fixed p > 0 is unbounded as the penalty grows.
    UnboundedInPenalty,
}

impl fmt::Display for FunctionalCondition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            FunctionalCondition::ZeroAtContact => "must be 0 at p = 0",
            FunctionalCondition::Monotone => "must not decrease with p",
            FunctionalCondition::Continuous => "must be continuous in p",
            FunctionalCondition::Convex => "must be convex in p: its force must not decrease with p",
            FunctionalCondition::UnboundedInPenalty => "must be unbounded as its penalty grows",
        })
    }
}

/// Error of solving with a penalty functional.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FunctionalError {
    /// A parameter is outside its range, or the scalar cannot represent a result.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The functional violates a condition.
    #[error("the penalty functional {condition}; violated at p = {at} m")]
    Broken {
        /// The condition.
        condition: FunctionalCondition,
        /// Penetration at which it is violated, in m.
        at: String,
    },
}

pub(super) fn violation<T: Scalar>(condition: FunctionalCondition, at: &T) -> FunctionalError {
    FunctionalError::Broken { condition, at: format!("{at:?}") }
}

/// Solves a system with unilateral contact by a user-defined penalty functional W, in J: for R > 0 the root
/// of c p + W′(p) = R, otherwise the solution by Lagrange multiplier.
///
/// `functional` receives the `parameters` and p in m, and is differentiated by the dual numbers it is
/// evaluated in: any generic function like [`penalty::functional`](crate::chapter::penalty::functional) is
/// suitable. Its constants are numbers of the same type, `T::int(2)`, or in a closure
/// `DualEnclosure::<f64>::int(2)`. It is evaluated for 0 ≤ p ≤ R/c, slightly exceeded by rounding. Kinks are
/// allowed: for W = ε ⟨p⟩ the result is exact if ε ≥ R. Upward jumps of W′ are allowed, too.
///
/// The [bounds](Solution::bounds) end where c p + W′ − R is certainly negative and certainly positive,
/// rounding included, or at 0 and R/c, which contain every equilibrium. They are narrowed until their width
/// is at most `tolerance` > 0, in m, or rounding leaves the sign undecided. If |u − u*| < tolerance is then
/// proved, the outcome is [`Converged`](Outcome::Converged), otherwise [`Stagnated`](Outcome::Stagnated) with
/// the bound in [`floor`](Solution::floor). Rationals always meet the tolerance; the bounds have about as
/// many digits as the tolerance requires. The outcome is [`IterationLimit`](Outcome::IterationLimit) after
/// ten thousand steps, which suffice if the functional is smooth near the root, and
/// [`Direct`](Outcome::Direct) without iteration.
///
/// The [conditions](FunctionalCondition) ensure that there is one equilibrium, with the least energy. W(0) = 0 is
/// tested at 0, the others except the last at all sixteenths of R/c, and monotonicity at every evaluation of
/// the search. A violation in between remains undetected. The last condition concerns a family of
/// functionals: [`penalty_for_functional`] tests it.
///
/// # Errors
/// Returns the errors of [`solve`], and an error if a parameter is not finite, the tolerance is not positive,
/// or a condition is certainly violated, with the penetration concerned. A non-finite W or W′ violates the
/// condition at p = 0; elsewhere it counts as a point beyond the root.
///
/// # Panics
/// Panics if `functional` does, for example by a division of rationals by 0.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::{chapter::SpringMass, number::PositivePart};
/// use spring_mass_contact::solver::{Outcome, solve_functional};
///
/// /// W = ε |p|³ / 3: a force that grows like the square of the penetration.
/// fn cubic<T: PositivePart>(eps: &T, p: &T) -> T {
///     eps * p * p * p.abs() / T::int(3)
/// }
///
/// // 4 p + 8 p² = 4 with p = 1/2.
/// let system = SpringMass { c: 4.0, m: 1.0, g: 12.0, l: 1.0, h: 3.0 };
/// let answer = solve_functional(&system, &[8.0], &1e-12, |[eps], p| cubic(eps, p))?;
/// assert_eq!((answer.outcome, answer.deflection, answer.contact_force), (Outcome::Converged, 2.5, 2.0));
/// let p = &answer.bounds.penetration;
/// assert!(p.lower <= 0.5 && 0.5 <= p.upper && p.upper - p.lower < 1e-14);
/// # Ok::<(), spring_mass_contact::solver::FunctionalError>(())
/// ```
pub fn solve_functional<T: Scalar, const N: usize>(
    system: &SpringMass<T>,
    parameters: &[T; N],
    tolerance: &T,
    functional: impl Fn(&[DualEnclosure<T>; N], &DualEnclosure<T>) -> DualEnclosure<T>,
) -> Result<Solution<T>, FunctionalError> {
    let rigid = Solution { multiplier: None, ..solve(system, &Method::Lagrange)? };
    validate::positive("tolerance", tolerance)?;
    let parameters = enclose_parameters(parameters)?;
    if rigid.state != State::Contact {
        return Ok(rigid);
    }
    solve_in_contact(system, rigid, tolerance, &|p| functional(&parameters, p))
}

/// Returns the solution for R > 0, given that by Lagrange multiplier.
fn solve_in_contact<T: Scalar>(
    system: &SpringMass<T>,
    rigid: Solution<T>,
    tolerance: &T,
    functional: &dyn Fn(&DualEnclosure<T>) -> DualEnclosure<T>,
) -> Result<Solution<T>, FunctionalError> {
    let enclosed = system.as_ref().map(T::enclose);
    let reaction = system::reaction(&enclosed);
    let equation = PenaltyEquation::new(enclosed.c.clone(), reaction, functional);
    let max = equation.max_penetration()?;
    equation.check_conditions(&max)?;
    let RootBracket { lower, upper, is_complete } = equation.root(&max, tolerance)?;
    if upper.is_zero() {
        return Ok(rigid);
    }
    let deflection = system::gap(system) + middle(&lower, &upper);
    let deflections = [&lower, &upper].map(|p| system::gap(&enclosed) + p.enclose());
    let [above, below] = deflections.each_ref().map(|u| T::magnitude(&(deflection.enclose() - u)));
    let error = if above < below { below } else { above };
    // R − c p, which decreases with the penetration.
    let forces =
        [&upper, &lower].map(|p| augmented::contact_force(&equation.spring, &p.enclose()).positive_part());
    let outcome = match is_complete {
        _ if error < *tolerance => Outcome::Converged,
        true => Outcome::Stagnated,
        false => Outcome::IterationLimit,
    };
    let bounds = Bounds {
        deflection: span(&deflections, "deflection")?,
        contact_force: span(&forces, "contact force")?,
        penetration: Interval { lower, upper },
    };
    let solution = Solution {
        outcome,
        penetration: contact::penetration(system, &deflection),
        contact_force: augmented::contact_force(system, &deflection).positive_part(),
        deflection,
        floor: (outcome == Outcome::Stagnated).then_some(error),
        bounds,
        ..rigid
    };
    validate::require_finite(&solution)?;
    Ok(solution)
}

/// Returns the interval from the lower bound of one enclosure to the upper bound of another.
fn span<T: Scalar>(
    [lower, upper]: &[T::Enclosure; 2],
    quantity: &'static str,
) -> Result<Interval<T>, SolveError> {
    let (lower, upper): (Interval<T>, Interval<T>) =
        (to_interval(lower, quantity)?, to_interval(upper, quantity)?);
    Ok(Interval { lower: lower.lower, upper: upper.upper })
}

/// Returns a penalty, the first of the `parameters` in its own units, for which the minimum with a
/// user-defined functional has a penetration of at most `tolerance` > 0, in m. It is the given penalty,
/// doubled as often as necessary.
///
/// By note 3: if W(0) = 0, the minimum satisfies W ≤ R²/(2c), so a monotone W that is larger at the tolerance
/// keeps p below it. Such a penalty exists for every tolerance if and only if the functional satisfies
/// condition 3 of the chapter. It is not the smallest one.
///
/// # Errors
/// Returns the errors of [`solve_functional`], with the first and the last condition: W(0) is not 0, or a
/// thousand doublings do not suffice or leave the range of the scalar. This does not prove that W is bounded,
/// since it may grow slowly.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::{chapter::{SpringMass, penalty}, solver::penalty_for_functional};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// // ε/2 · 2⁻⁸ > R²/(2c) = 1/2 for ε > 256, while R/(c + ε) ≤ 2⁻⁴ already for ε ≥ 28.
/// let eps = penalty_for_functional(&system, &[1.0], &0.0625, |[eps], p| penalty::functional(eps, p))?;
/// assert_eq!(eps, 512.0);
/// # Ok::<(), spring_mass_contact::solver::FunctionalError>(())
/// ```
pub fn penalty_for_functional<T: Scalar, const N: usize>(
    system: &SpringMass<T>,
    parameters: &[T; N],
    tolerance: &T,
    functional: impl Fn(&[DualEnclosure<T>; N], &DualEnclosure<T>) -> DualEnclosure<T>,
) -> Result<T, FunctionalError> {
    let touches = State::of(system)? == State::Contact;
    validate::positive("tolerance", tolerance)?;
    enclose_parameters(parameters)?;
    let mut parameters = parameters.clone();
    let enclosed = system.as_ref().map(T::enclose);
    let spring = reduced_system(enclosed.c.clone(), system::reaction(&enclosed));
    // −R²/(2c), the least energy of a mass of weight R.
    let least = structure::least_energy(&spring);
    let p = Dual::constant(tolerance.enclose());
    for _ in 0..=1000 {
        let enclosed_parameters = enclose_parameters(&parameters)?;
        check_vanishes::<T>(&functional(&enclosed_parameters, &Dual::zero()).value)?;
        let w = functional(&enclosed_parameters, &p).value;
        let Some(eps) = parameters.first_mut() else { break };
        if !touches || T::sign(&(w + &least)) == Some(Ordering::Greater) {
            return Ok(eps.clone());
        }
        *eps = T::int(2) * &*eps;
        if !eps.is_finite() {
            break;
        }
    }
    Err(violation(FunctionalCondition::UnboundedInPenalty, tolerance))
}

/// Returns an error unless W is finite and its enclosure contains 0.
pub(super) fn check_vanishes<T: Scalar>(w: &T::Enclosure) -> Result<(), FunctionalError> {
    let holds = is_finite::<T>(w) && T::sign(w).is_none_or(Ordering::is_eq);
    if holds { Ok(()) } else { Err(violation(FunctionalCondition::ZeroAtContact, &T::zero())) }
}

pub(super) fn is_finite<T: Scalar>(x: &T::Enclosure) -> bool {
    T::magnitude(x).is_finite()
}

fn enclose_parameters<T: Scalar, const N: usize>(
    parameters: &[T; N],
) -> Result<[DualEnclosure<T>; N], SolveError> {
    parameters.iter().try_for_each(|x| validate::finite_number("penalty parameter", x))?;
    Ok(parameters.each_ref().map(|x| Dual::constant(x.enclose())))
}
