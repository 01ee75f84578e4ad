//! Equilibrium of a penalty functional with higher terms (1.10), to the last bit.

use super::root::{PenaltyEquation, RootBracket};
use super::{Scalar, SolveError, State, validate};
use crate::chapter::{SpringMass, penalty, system};
use crate::number::{Ball, Dual, Exact, Mpfr, PositivePart, Real, ToExact};
use num_traits::Zero;
use rug::Float;

/// Returns the penetration, in m, at which (1.10) is in equilibrium: the root of
/// [`penalty::series_residual`], for `eps` in N/m and `higher` = ε₄ in N/m³, ε₆ in N/m⁵, …
///
/// Contact is bilateral, as printed: the result is negative for R < 0. It is the best one the scalar can
/// represent: the exact residual, in rationals, changes sign between its two neighbours.
///
/// # Errors
/// Returns an error if a parameter is out of its range, a coefficient is negative, none is positive, or the
/// scalar cannot represent the root.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::series_penetration};
/// // c p + ε p + 4 ε₄ p³ = R with p = 1/2: 2 + 2 + 4 = 8.
/// let system = SpringMass { c: 4.0, m: 1.0, g: 16.0, l: 1.0, h: 3.0 };
/// assert_eq!(series_penetration(&system, &4.0, &[8.0])?, 0.5);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn series_penetration<T>(system: &SpringMass<T>, eps: &T, higher: &[T]) -> Result<T, SolveError>
where
    T: Scalar + Real + ToExact,
{
    let state = State::of(system)?;
    validate_coefficient("penalty", eps)?;
    higher.iter().try_for_each(|coefficient| validate_coefficient("higher penalty", coefficient))?;
    let is_positive = *eps > T::zero() || higher.iter().any(|coefficient| *coefficient > T::zero());
    let allowed = "greater than 0, at least one of them";
    validate::require(is_positive, "penalties", &T::zero(), allowed)?;
    if state == State::Grazing {
        return Ok(T::zero());
    }
    // Defines the precision of the result; it is the root without the higher terms.
    let like = penalty::penetration(system, eps);
    let is_rounded = !like.unit_roundoff().is_zero(); // constants of MPFR are not
    validate::require(is_rounded, "system", system, "rounded to some precision")?;
    let SpringMass { c, m, g, l, h } = system.as_ref().try_map(exact)?;
    let reaction = system::reaction(&SpringMass { c: c.clone(), m, g, l, h });
    let (eps, higher) = (exact(eps)?, higher.iter().map(exact).collect::<Result<Vec<_>, _>>()?);
    let bits = exact(&like.unit_roundoff())?.as_rational().denom().significant_bits();
    let bracket = enclose_root(bits, &c, &reaction.abs(), &eps, &higher).ok_or(OUT_OF_RANGE)?;
    let (lower, upper) = (exact(&bracket.lower)?, exact(&bracket.upper)?);
    let middle = (&lower + &upper) / Exact::from(2);
    // For R ≠ 0 it is not a root, and the neighbours of 0 in MPFR have a billion digits.
    validate::in_range(!middle.is_zero(), "penetration")?;
    let root = like.round_from_exact(&middle).map_err(|_| OUT_OF_RANGE)?;
    // Beyond the largest float there is neither a neighbour nor a root.
    let contains_below = Real::next_down(root.clone()).to_exact().is_ok_and(|below| lower <= below);
    let contains_above = Real::next_up(root.clone()).to_exact().is_ok_and(|above| above <= upper);
    validate::in_range(!contains_below && !contains_above, "penetration")?;
    Ok(if state == State::Separated { -root } else { root })
}

const OUT_OF_RANGE: SolveError = SolveError::OutOfRange { quantity: "penetration" };

fn exact<T: ToExact>(x: &T) -> Result<Exact, SolveError> {
    x.to_exact().map_err(|_| OUT_OF_RANGE)
}

fn validate_coefficient<T: Scalar>(argument: &'static str, value: &T) -> Result<(), SolveError> {
    validate::require(value.is_finite() && *value >= T::zero(), argument, value, "at least 0 and finite")
}

/// Encloses the root for R > 0 with a given number of bits and a margin: all terms are positive, so its
/// relative error is not larger than theirs.
fn enclose_root(
    bits: u32,
    c: &Exact,
    reaction: &Exact,
    eps: &Exact,
    higher: &[Exact],
) -> Option<RootBracket<Mpfr>> {
    // Not `to_mpfr`, because the root of a scalar with the largest precision needs more.
    let like = Mpfr::from(Float::with_val(bits + 64, 1));
    let [c, reaction, eps] = [c, reaction, eps].map(|x| Ball::enclosing(&like, x).ok());
    let eps = Dual::constant(eps?);
    let higher = higher.iter().map(|x| Ball::enclosing(&like, x).map(Dual::constant));
    let higher = higher.collect::<Result<Vec<_>, _>>().ok()?;
    let functional = |p: &Dual<_>| penalty::series(&eps, &higher, p);
    let equation = PenaltyEquation::new(c?, reaction?, &functional);
    let max: Mpfr = equation.max_penetration().ok()?;
    equation.root(&max, &Mpfr::zero()).ok()
}
