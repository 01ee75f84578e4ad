//! Equilibrium of a penalty functional with higher terms (1.10), to the last bit.

use super::check::{self, SolveError};
use super::root::{Equation, RootBracket};
use super::{Scalar, State};
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
    check::coefficient("penalty", eps)?;
    higher.iter().try_for_each(|e| check::coefficient("higher penalty", e))?;
    check::any_positive(std::iter::once(eps).chain(higher))?;
    let out_of_range = SolveError::OutOfRange { quantity: "penetration" };
    if state == State::Grazing {
        return Ok(T::zero());
    }
    // Defines the precision of the result; it is the root without the higher terms.
    let like = penalty::penetration(system, eps);
    let rounds = !like.unit_roundoff().is_zero(); // constants of MPFR do not
    check::require(rounds, "system", system, "rounded to some precision")?;
    let exact = |x: &T| x.to_exact().map_err(|_| out_of_range.clone());
    let SpringMass { c, m, g, l, h } = system.try_map(exact)?;
    let reaction = system::reaction(&SpringMass { c: c.clone(), m, g, l, h });
    let (eps, higher) = (exact(eps)?, higher.iter().map(exact).collect::<Result<Vec<_>, _>>()?);
    let digits = exact(&like.unit_roundoff())?.as_rational().denom().significant_bits();
    let found = enclosed(digits, &c, &reaction.abs(), &eps, &higher).ok_or(out_of_range.clone())?;
    let end = |p: Mpfr| p.to_exact().map_err(|_| out_of_range.clone());
    let (lower, upper) = (end(found.lower)?, end(found.upper)?);
    let middle = (&lower + &upper) / Exact::from(2);
    // For R ≠ 0 it is not a root, and the neighbours of 0 in MPFR have a billion digits.
    check::in_range(!middle.is_zero(), "penetration")?;
    let answer = like.round_from_exact(&middle).map_err(|_| out_of_range.clone())?;
    // Beyond the largest float there is neither a neighbour nor a root.
    let below = Real::next_down(answer.clone()).to_exact().is_ok_and(|p| lower <= p);
    let above = Real::next_up(answer.clone()).to_exact().is_ok_and(|p| p <= upper);
    check::in_range([below, above] == [false; 2], "penetration")?;
    Ok(if state == State::Separated { -answer } else { answer })
}

/// Encloses the root for R > 0 with a given number of digits and a margin: all terms are positive, so its
/// relative error is not larger than theirs.
fn enclosed(
    digits: u32,
    c: &Exact,
    reaction: &Exact,
    eps: &Exact,
    higher: &[Exact],
) -> Option<RootBracket<Mpfr>> {
    // Not `to_mpfr`, because the root of a scalar with the largest precision needs more.
    let like = Mpfr::from(Float::with_val(digits + 64, 1));
    let around = |x: &Exact| Ball::enclosing(&like, x);
    let constant = |x: &Exact| around(x).map(Dual::constant);
    let (eps, higher) =
        (constant(eps).ok()?, higher.iter().map(constant).collect::<Result<Vec<_>, _>>().ok()?);
    let functional = |p: &Dual<_>| penalty::series(&eps, &higher, p);
    let equation = Equation::new(around(c).ok()?, around(reaction).ok()?, &functional);
    let most: Mpfr = equation.most().ok()?;
    equation.root(&most, &Mpfr::zero()).ok()
}
