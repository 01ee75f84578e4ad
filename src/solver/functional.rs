//! Penalty functionals of one's own (§1.3.2): what they have to be, and their equilibrium.

use super::check::{self, SolveError};
use super::root::{Equation, Found, middle, weighed};
use super::{Bounds, Interval, Method, Outcome, Scalar, Solution, State, bounded, solve};
use crate::chapter::{SpringMass, augmented, contact, structure, system};
use crate::number::{Dual, PositivePart};
use num_traits::Zero;
use std::cmp::Ordering;
use std::fmt;

/// What a penalty functional is read in: an enclosure, which bounds the rounding, and its derivative.
pub type Lifted<T> = Dual<<T as Scalar>::Enclosure>;

/// What a penalty functional W(p) has to be, for p ≥ 0.
///
/// The first two and the last are the chapter's, as note 3 mends them. The others are what
/// [`solve_functional`] needs besides: of a W whose force falls there can be more than one equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Condition {
    /// Condition 1: W(0) = 0.
    VanishesAtContact,
    /// Condition 2: W does not fall as p grows.
    NeverFalls,
    /// W has no jumps.
    Continuous,
    /// W is convex: its force W′ does not fall as p grows.
    NeverSoftens,
    /// Condition 3: W grows beyond all bounds with the penalty, at a fixed p > 0.
    GrowsWithPenalty,
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Condition::VanishesAtContact => "must be 0 at p = 0",
            Condition::NeverFalls => "must not fall as p grows",
            Condition::Continuous => "must be continuous in p",
            Condition::NeverSoftens => "must be convex in p: its force must not fall as p grows",
            Condition::GrowsWithPenalty => "must grow beyond all bounds with its penalty",
        })
    }
}

/// Why a penalty functional has no answer to return.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FunctionalError {
    /// A parameter outside its range, or a result that the scalar cannot hold.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A condition that the functional is seen to break.
    #[error("the penalty functional {condition}; not so at p = {at} m")]
    Broken {
        /// Which one.
        condition: Condition,
        /// The penetration at which it was seen, in m.
        at: String,
    },
}

pub(super) fn broken<T: Scalar>(condition: Condition, at: &T) -> FunctionalError {
    FunctionalError::Broken { condition, at: format!("{at:?}") }
}

/// Solves a system by a penalty functional W of one's own, in J, over a plane that never pulls: where R > 0
/// for the root of c p + W′(p) = R, and else as by Lagrange.
///
/// `functional` is given the `parameters` and p in m, and is differentiated by the numbers that it is read
/// in: a generic function like [`penalty::functional`](crate::chapter::penalty::functional) will do. Its
/// constants are numbers of the same kind, `T::int(2)`, or in a closure `Lifted::<f64>::int(2)`. It is asked
/// for 0 ≤ p ≤ R/c, and a bit more by rounding. A kink there is no hindrance: of W = ε ⟨p⟩ the answer
/// is exact for ε ≥ R. Nor is a jump of W′ upwards.
///
/// The [bounds](Solution::bounds) end where c p + W′ − R is < 0 for certain and where it is > 0 for
/// certain, its rounding included, or at 0 and R/c, between which every equilibrium is. They are narrowed
/// until they are no wider than `tolerance` > 0, in m, or rounding leaves the sign open. If |u − u*| <
/// tolerance is proved then, the outcome is [`Converged`](Outcome::Converged), and else
/// [`Stagnated`](Outcome::Stagnated), with the bound in [`floor`](Solution::floor). In rationals, which
/// leave no sign open, a tolerance is always met: a root need not be rational, and its bounds have about as
/// many digits as the tolerance asks for. After ten thousand steps, which none takes that is smooth near
/// the root, it is [`OutOfSteps`](Outcome::OutOfSteps). Where nothing is left to look for it is
/// [`Direct`](Outcome::Direct).
///
/// That there is one equilibrium, and that it is the least energy, rests on the [conditions](Condition).
/// That W(0) = 0 is tried at 0; the others but the last are tried at all sixteenths of R/c, and that W does
/// not fall wherever the search comes by. So whoever breaks them in between goes unseen. The last is not
/// about one functional but about a family: [`penalty_for_functional`] tries it.
///
/// # Errors
/// Those of [`solve`]; a parameter that is not finite, or a tolerance that is not > 0; or a condition that is
/// broken for certain, with the penetration at which it is. W or W′ that is not finite at p = 0 counts as not
/// being 0 there; elsewhere it counts as beyond the root.
///
/// # Panics
/// If `functional` does, as a division of rationals by 0.
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
    functional: impl Fn(&[Lifted<T>; N], &Lifted<T>) -> Lifted<T>,
) -> Result<Solution<T>, FunctionalError> {
    let rigid = Solution { multiplier: None, ..solve(system, &Method::Lagrange)? };
    check::positive("tolerance", tolerance)?;
    let parameters = lifted(parameters)?;
    if rigid.state != State::Contact {
        return Ok(rigid);
    }
    let enclosed = system.map(T::enclose);
    let reaction = system::reaction(&enclosed);
    let equation = Equation::new(enclosed.c.clone(), reaction, |p| functional(&parameters, p));
    let most = equation.most()?;
    equation.check(&most)?;
    let Found { lower, upper, ended } = equation.root(&most, tolerance)?;
    if upper.is_zero() {
        return Ok(rigid);
    }
    let below = |p: &T| system::gap(&enclosed) + p.enclose();
    // R − c p: the less of it, the deeper.
    let force = |p: &T| augmented::contact_force(&equation.spring, &p.enclose()).positive_part();
    let ends = |lower, upper, quantity| -> Result<Interval<T>, SolveError> {
        let (lower, upper): (Interval<T>, _) = (bounded(&lower, quantity)?, bounded(&upper, quantity)?);
        Ok(Interval { lower: lower.lower, upper: upper.upper })
    };
    let deflection = system::gap(system) + middle(&lower, &upper);
    let off = |p: &T| T::magnitude(&(deflection.enclose() - below(p)));
    let (above, under) = (off(&lower), off(&upper));
    let error = if above < under { under } else { above };
    let outcome = match ended {
        _ if error < *tolerance => Outcome::Converged,
        true => Outcome::Stagnated,
        false => Outcome::OutOfSteps,
    };
    let bounds = Bounds {
        deflection: ends(below(&lower), below(&upper), "deflection")?,
        contact_force: ends(force(&upper), force(&lower), "contact force")?,
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
    check::finite(&solution)?;
    Ok(solution)
}

/// A penalty, the first of the `parameters` in its own units, with which the minimum by one's own
/// functional has a penetration of at most `tolerance` > 0 in m: the given one, doubled as often as that
/// takes.
///
/// By note 3: where W(0) = 0, the minimum has W ≤ R²/(2c), so that a W which is larger at the tolerance,
/// and does not fall, keeps p below it. Such a penalty exists for every tolerance if and only if the
/// functional meets the chapter's condition 3. It is not the least one.
///
/// # Errors
/// Those of [`solve_functional`], of the conditions the first and the last: W(0) is not 0, or a thousand
/// doublings do not suffice, or lead out of the scalar's range. That is no proof that W is bounded: it may
/// grow slowly.
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
    functional: impl Fn(&[Lifted<T>; N], &Lifted<T>) -> Lifted<T>,
) -> Result<T, FunctionalError> {
    let touches = State::of(system)? == State::Contact;
    check::positive("tolerance", tolerance)?;
    lifted(parameters)?;
    let mut parameters = parameters.clone();
    let unbounded = || broken(Condition::GrowsWithPenalty, tolerance);
    let enclosed = system.map(T::enclose);
    let spring = weighed(enclosed.c.clone(), system::reaction(&enclosed));
    // −R²/(2c): the least energy of a mass whose weight is R.
    let least = structure::least_energy(&spring);
    let p = Dual::constant(tolerance.enclose());
    for _ in 0..=1000 {
        let lifted = lifted(&parameters)?;
        let at = |p: &Lifted<T>| functional(&lifted, p).value;
        vanishes::<T>(&at(&Dual::zero()))?;
        let w = at(&p);
        let eps = parameters.first_mut().ok_or_else(unbounded)?;
        if !touches || T::sign(&(w + &least)) == Some(Ordering::Greater) {
            return Ok(eps.clone());
        }
        *eps = T::int(2) * &*eps;
        if !eps.is_finite() {
            break;
        }
    }
    Err(unbounded())
}

/// Is it a number, and perhaps 0?
pub(super) fn vanishes<T: Scalar>(w: &T::Enclosure) -> Result<(), FunctionalError> {
    let holds = is_finite::<T>(w) && T::sign(w).is_none_or(Ordering::is_eq);
    if holds { Ok(()) } else { Err(broken(Condition::VanishesAtContact, &T::zero())) }
}

pub(super) fn is_finite<T: Scalar>(x: &T::Enclosure) -> bool {
    T::magnitude(x).is_finite()
}

fn lifted<T: Scalar, const N: usize>(parameters: &[T; N]) -> Result<[Lifted<T>; N], SolveError> {
    parameters.iter().try_for_each(|x| check::finite_number("penalty parameter", x))?;
    Ok(parameters.each_ref().map(|x| Dual::constant(x.enclose())))
}
