//! (1.10): the equilibrium of a penalty functional with many terms, to the last bit.

use super::check::{self, SolveError};
use super::root::{Equation, Found};
use super::{Scalar, State};
use crate::chapter::{SpringMass, penalty, system};
use crate::number::{Ball, Dual, Exact, Mpfr, PositivePart, Real, ToExact};
use num_traits::Zero;
use rug::Float;

/// The penetration, in m, at which (1.10) is in equilibrium: the root of
/// [`penalty::series_residual`], for `eps` in N/m and `higher` = ε₄ in N/m³, ε₆ in N/m⁵, …
///
/// As printed (bilateral): negative for R < 0. The answer is as good as the scalar allows: the exact
/// residual, in rationals, changes sign between its two neighbours.
///
/// # Errors
/// A parameter out of its range, a negative coefficient, none that is positive, or a root that the
/// scalar cannot hold.
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
    // Of the precision the answer is to have, and of no size that could leave the range.
    let SpringMass { c, m, g, l, h } = system;
    let like = [c, m, g, l, h, eps].into_iter().fold(T::zero(), |zero, x| zero + T::zero() * x);
    if like.unit_roundoff().is_zero() {
        return Err(check::no_precision(&like)); // constants of MPFR: nothing to round to
    }
    let exact = |x: &T| x.to_exact().map_err(|_| out_of_range.clone());
    let SpringMass { c, m, g, l, h } = system.try_map(exact)?;
    let reaction = system::reaction(&SpringMass { c: c.clone(), m, g, l, h });
    let (eps, higher) = (exact(eps)?, higher.iter().map(exact).collect::<Result<Vec<_>, _>>()?);
    // A few digits more than the answer has are enough to tell its neighbours apart.
    let digits = exact(&like.unit_roundoff())?.as_rational().denom().significant_bits();
    for precision in [1, 2, 4].map(|times| times * (digits + 64)) {
        let Some(found) = enclosed([digits, precision], &c, &reaction.abs(), &eps, &higher) else { break };
        let signed = |p: Mpfr| {
            let p = p.to_exact().map_err(|_| out_of_range.clone());
            p.map(|p| if reaction < Exact::zero() { -p } else { p })
        };
        let ends = [signed(found.lower)?, signed(found.upper)?];
        let middle = (&ends[0] + &ends[1]) / Exact::from(2);
        if middle.is_zero() {
            break; // of R ≠ 0 it is no root, and the neighbours of 0 in MPFR have a billion digits
        }
        let answer = like.nearest(&middle).map_err(|_| out_of_range.clone())?;
        // Beyond the largest float there is no neighbour, and no root.
        let below = |p: T| p.to_exact().is_ok_and(|p| ends.iter().any(|end| *end <= p));
        let above = |p: T| p.to_exact().is_ok_and(|p| ends.iter().any(|end| p <= *end));
        if !below(Real::next_down(answer.clone())) && !above(Real::next_up(answer.clone())) {
            return Ok(answer);
        }
    }
    Err(out_of_range)
}

/// The root for R > 0, to so many digits and some more, if as many bits are enough.
fn enclosed(
    [digits, precision]: [u32; 2],
    c: &Exact,
    reaction: &Exact,
    eps: &Exact,
    higher: &[Exact],
) -> Option<Found<Mpfr>> {
    // Not `to_mpfr`: the root of a scalar with the most bits takes more.
    let like = Mpfr::from(Float::with_val(precision, 1));
    let around = |x: &Exact| Ball::around(&like, x);
    let constant = |x: &Exact| around(x).map(Dual::constant);
    let (eps, higher) =
        (constant(eps).ok()?, higher.iter().map(constant).collect::<Result<Vec<_>, _>>().ok()?);
    let equation = Equation::new(around(c).ok()?, around(reaction).ok()?, |p: &Dual<_>| {
        penalty::series(&eps, &higher, p)
    });
    let most: Mpfr = equation.most().ok()?;
    let width = Mpfr::from(Float::with_val(precision, 1) >> (digits + 4));
    equation.root(&most, |p| p * &width).ok()
}
