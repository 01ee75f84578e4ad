//! (1.10): the equilibrium of a penalty functional with many terms, to the last bit.

use super::check::{self, SolveError};
use super::{Scalar, State};
use crate::chapter::{SpringMass, penalty, system};
use crate::number::{Dual, Exact, Mpfr, PositivePart, Real, ToExact};
use num_traits::{One, Zero};
use rug::Float;
use std::cmp::Ordering;

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
    check::system(system)?;
    check::coefficient("penalty", eps)?;
    higher.iter().try_for_each(|e| check::coefficient("higher penalty", e))?;
    check::any_positive(std::iter::once(eps).chain(higher))?;
    let out_of_range = SolveError::OutOfRange { quantity: "penetration" };
    if State::of(system) == State::Grazing {
        return Ok(T::zero());
    }
    let like = penalty::penetration(system, eps); // of the precision the answer is to have
    if Real::next_up(like.clone()) == like {
        return Err(check::no_precision(&like)); // constants of MPFR: nothing to round to
    }
    let exact = |x: &T| x.to_exact().map_err(|_| out_of_range.clone());
    let terms: Vec<_> = higher.iter().map(exact).collect::<Result<_, _>>()?;
    // The same equation from a system whose reaction does not cancel: its weight is R, its gap 0.
    let system = system.try_map(exact)?;
    let (r, zero) = (system::reaction(&system), Exact::zero());
    let system = SpringMass { c: system.c, m: r, g: Exact::one(), l: zero.clone(), h: zero };
    let equation = Equation { system, eps: exact(eps)?, higher: terms };
    // A few digits more than the answer has are enough to tell its neighbours apart.
    let digits = exact(&like.unit_roundoff())?.as_rational().denom().significant_bits();
    let mut precision = 128;
    while precision <= 128.max(4 * digits) {
        let Some(root) = equation.root(precision) else { break };
        let answer = like.nearest(&root.to_exact().map_err(|_| out_of_range.clone())?);
        let answer = answer.map_err(|_| out_of_range.clone())?;
        let residual_sign = |p: T| p.to_exact().map(|p| equation.residual(&p).cmp(&Exact::zero()));
        // Beyond the largest float the residual has the sign it has at infinity.
        let below = residual_sign(Real::next_down(answer.clone())).unwrap_or(Ordering::Less);
        let above = residual_sign(Real::next_up(answer.clone())).unwrap_or(Ordering::Greater);
        if (below, above) == (Ordering::Less, Ordering::Greater) {
            return Ok(answer);
        }
        precision *= 2;
    }
    Err(out_of_range)
}

/// c p + W′(p) = R in rationals.
struct Equation {
    system: SpringMass<Exact>,
    eps: Exact,
    higher: Vec<Exact>,
}

impl Equation {
    fn residual(&self, p: &Exact) -> Exact {
        penalty::series_residual(&self.system, &self.eps, &self.higher, p)
    }

    /// Newton's method from outside, where the residual is convex (concave for R < 0) and the method
    /// monotone: it ends when it no longer comes nearer. `None` if it does not, or if there is no place to
    /// begin.
    fn root(&self, precision: u32) -> Option<Mpfr> {
        // Not `to_mpfr`: the root of a scalar with the most bits takes more.
        let rounded = |x: &Exact| Mpfr::from(Float::with_val(precision, x.as_rational()));
        let constant = |x: &Exact| Dual::constant(rounded(x));
        let (system, eps) = (self.system.map(constant), constant(&self.eps));
        let higher: Vec<_> = self.higher.iter().map(constant).collect();
        let mut p = rounded(&self.outside()?);
        // From less than twice the root of a polynomial of degree d, d steps lead to within a factor 1 +
        // 1/d, and from there each doubles the digits.
        for _ in 0..2 * (2 * self.higher.len() + 1) + 64 {
            let f = penalty::series_residual(&system, &eps, &higher, &Dual::variable(p.clone()));
            let next = &p - f.value / f.derivative;
            if next.abs() >= p.abs() {
                return Some(p);
            }
            p = next;
        }
        None
    }

    /// So many binary digits that the root is between 2⁻ⁿ and 2ⁿ in size: it is at most |R|/c, and at least
    /// what the largest of the terms would be the root of alone, with R divided among the terms. So n is
    /// less than all the digits together.
    fn digits(&self) -> u64 {
        let SpringMass { c, m, g, l, h } = &self.system;
        let terms = 64 + self.higher.len() as u64;
        [c, m, g, l, h, &self.eps].into_iter().chain(&self.higher).map(Exact::digits).sum::<u64>() + terms
    }

    /// A power of two beyond the root, less than twice as far from 0, with the root's sign; if there is one.
    fn outside(&self) -> Option<Exact> {
        let sign = self.residual(&Exact::zero()).cmp(&Exact::zero()).reverse();
        let signed =
            |n: i32| if sign == Ordering::Less { -Exact::power_of_two(n) } else { Exact::power_of_two(n) };
        let beyond = |n: i32| self.residual(&signed(n)).cmp(&Exact::zero()) == sign;
        // Gallop to an exponent on the other side, then halve the distance.
        let first = beyond(0);
        let most = i32::try_from(2 * self.digits()).unwrap_or(i32::MAX / 2);
        let mut reach = 1;
        while beyond(if first { -reach } else { reach }) == first {
            reach *= 2;
            if reach > most {
                return None;
            }
        }
        let (mut inside, mut outside) = if first { (-reach, 0) } else { (0, reach) };
        while outside - inside > 1 {
            let middle = inside + (outside - inside) / 2;
            if beyond(middle) { outside = middle } else { inside = middle }
        }
        Some(signed(outside))
    }
}
