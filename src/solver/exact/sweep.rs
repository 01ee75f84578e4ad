//! The penalty method over a range of penalties: what each one gives, and which is best for a computed ε p.

use super::check::{self, SolveError};
use super::{Method, Scalar, State, exact, solve};
use crate::chapter::{SpringMass, augmented, penalty, rounding, system};
use crate::number::{Exact, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::float::Round;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};

/// What the penalty method gives at one penalty, and how far its two forces are from the one it is after:
/// the contact force of the problem, R where the plane pushes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::Text"))]
#[non_exhaustive]
pub struct SweepRow<T> {
    /// ε, in N/m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub penalty: T,
    /// u, in m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub deflection: T,
    /// p = l + u − H of this deflection, in m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub penetration: T,
    /// N = m g − c u, in N, by equilibrium: what [`solve`] returns.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub contact_force: T,
    /// N = ε p, in N, by (1.12); none where the mass hangs free.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::option"))]
    pub penalty_force: Option<T>,
    /// |m g − c u − R| / R, exactly, of the parameters as they are in their scalar; none unless R > 0.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::option"))]
    pub force_error: Option<Exact>,
    /// |ε p − R| / R, in the same way.
    #[cfg_attr(feature = "serde", serde(serialize_with = "crate::number::quantity::option"))]
    pub penalty_force_error: Option<Exact>,
}

/// Solves a system by penalty, with one ε > 0 in N/m after the other. No row depends on another.
///
/// # Errors
/// Of a row those of [`solve`], or its ε p leaves the range of the scalar. Of no penalties the only row is
/// [`SolveError::Invalid`].
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::sweep};
/// // R = 2, and both forces fall short of it by c/(c + ε) of it.
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let rows: Vec<_> = sweep(&system, [4.0, 12.0]).collect::<Result<_, _>>()?;
/// assert_eq!((rows[0].penetration, rows[0].contact_force), (0.25, 1.0));
/// let errors = rows.iter().map(|row| row.penalty_force_error.clone().unwrap());
/// assert!(errors.eq(["1/2", "1/4"].map(|error| error.parse().unwrap())));
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn sweep<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    penalties: impl IntoIterator<Item = T>,
) -> impl Iterator<Item = Result<SweepRow<T>, SolveError>> {
    let mut penalties = penalties.into_iter().peekable();
    let none: [&T; 0] = [];
    let none = check::require(penalties.peek().is_some(), "penalties", &none, "at least one").err();
    none.map(Err).into_iter().chain(penalties.map(|eps| row(system, eps)))
}

fn row<T: Scalar + ToExact>(system: &SpringMass<T>, eps: T) -> Result<SweepRow<T>, SolveError> {
    let solution = solve(system, &Method::Penalty { penalty: eps.clone() })?;
    let touches = solution.state != State::Separated;
    let force = touches.then(|| penalty::contact_force(system, &eps, &solution.deflection));
    check::in_range(force.as_ref().is_none_or(T::is_finite), "penalty force")?;
    let reaction = (solution.state == State::Contact).then(|| system::reaction(&system.map(exact)));
    let error = |force: &T| reaction.as_ref().map(|r| (exact(force) - r).abs() / r);
    Ok(SweepRow {
        force_error: error(&solution.contact_force),
        penalty_force_error: force.as_ref().and_then(error),
        penalty: eps,
        deflection: solution.deflection,
        penetration: solution.penetration,
        contact_force: solution.contact_force,
        penalty_force: force,
    })
}

/// The ε, in N/m, with which a computed ε p of (1.12) is surest to be near R: where
/// [`penalty_force_bound`] is least, which is [`rounding::best_compliance_squared`] solved for ε.
///
/// To about the precision of the scalar. None if the bound has no least value: without a force or without
/// rounding, where it falls with every ε (H = l = 0), or rises (with very few bits, and where c Δ is large
/// beside R). `unit_roundoff` is η of the scalar.
///
/// # Errors
/// A parameter is invalid, η is negative, or the penalty leaves the range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::best_penalty};
/// // (c + ε)² = c R / (η (|H| + 5 |Δ|) (1 + 8 η)), where |H| + 5 |Δ| = 13 and η = 2⁻⁵³.
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let best = best_penalty(&system, &Exact::power_of_two(-53))?.unwrap();
/// assert!((best + 4.0 - (8.0_f64 / 13.0 * 2_f64.powi(53)).sqrt()).abs() < 1e-7);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn best_penalty<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    unit_roundoff: &Exact,
) -> Result<Option<T>, SolveError> {
    check::unit_roundoff(unit_roundoff)?;
    if State::of(system)? != State::Contact || unit_roundoff.is_zero() {
        return Ok(None);
    }
    let s = system.map(exact);
    let compliance = rounding::best_compliance_squared(&s, &(Exact::one() / unit_roundoff));
    if compliance.is_zero() {
        return Ok(None);
    }
    // (c + ε)² − c², which is 2 c ε + ε²; the root of the sum less c would cancel.
    let total = Exact::one() / compliance;
    let excess = &total - &s.c * &s.c;
    if excess <= Exact::zero() {
        return Ok(None);
    }
    let bits = 64 + unit_roundoff.digits() as u32;
    let total =
        Exact::from(Float::with_val(bits, total.as_rational()).sqrt().to_rational().unwrap_or_default());
    let best = system.c.nearest(&(excess / (total + s.c)));
    best.map(Some).map_err(|_| SolveError::OutOfRange { quantity: "best penalty" })
}

/// How far a computed ε p is from R at most, relative to R, by what is proved of (1.12) and its
/// [`rounding::penalty_force_error`], without under- and overflow; none unless R > 0. `unit_roundoff` is η of
/// the scalar, 0 for rationals.
///
/// # Errors
/// [`SolveError::Invalid`] for a parameter, ε or η that is not finite or not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::penalty_force_bound};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(penalty_force_bound(&system, &12.0, &0.into())?, Some("1/4".parse()?));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn penalty_force_bound<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    unit_roundoff: &Exact,
) -> Result<Option<Exact>, SolveError> {
    check::system(system)?;
    check::positive("penalty", eps)?;
    check::unit_roundoff(unit_roundoff)?;
    let (s, eps) = (system.map(exact), exact(eps));
    let (r, short) = (system::reaction(&s), augmented::contraction(&s, &eps));
    if r <= Exact::zero() {
        return Ok(None);
    } else if unit_roundoff.is_zero() {
        return Ok(Some(short));
    }
    Ok(Some(short + rounding::penalty_force_error(&s, &eps, &(Exact::one() / unit_roundoff)) / r))
}

/// The most penalties that [`penalties`] makes.
const MOST_POINTS: u32 = 1_000_000;

/// The most digits that [`penalties`] writes.
const MOST_DIGITS: usize = 100;

/// So many penalties from one to another, both included, each about as many times the one before: for a
/// plot over powers of ten. In any units.
///
/// Between the ends they are decimals of three digits, or of as many as it takes to tell them apart; the same
/// on every machine.
///
/// # Errors
/// The ends are not positive, the second is not the larger one, there are fewer than two points or more than
/// a million, or they need more than 100 digits.
///
/// ```
/// # use spring_mass_contact::{number::Exact, solver::penalties};
/// let [from, to] = [1, 100].map(Exact::from);
/// let spaced = penalties(&from, &to, 5)?;
/// assert_eq!(spaced, ["1", "3.16", "10", "31.6", "100"].map(|x| x.parse().unwrap()));
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn penalties(from: &Exact, to: &Exact, points: u32) -> Result<Vec<Exact>, SolveError> {
    check::require(*from > Exact::zero(), "first penalty", from, "greater than 0")?;
    check::require(from < to, "last penalty", to, "greater than the first")?;
    check::require((2..=MOST_POINTS).contains(&points), "number of penalties", &points, "from 2 to 1000000")?;
    let spaced = (3..=MOST_DIGITS).map(|digits| spaced(from, to, points, digits));
    let mut distinct = spaced.filter(|list| list.windows(2).all(|pair| pair[0] < pair[1]));
    let further = "further from the first, or there must be fewer between them";
    distinct.next().ok_or(SolveError::Invalid {
        argument: "last penalty",
        value: to.to_string(),
        allowed: further,
    })
}

fn spaced(from: &Exact, to: &Exact, points: u32, digits: usize) -> Vec<Exact> {
    // Four bits hold a decimal digit; the rest is for the logarithms of large numbers, and to spare.
    let bits = 4 * digits as u32 + 128;
    let ln = |x: &Exact| Float::with_val(bits, x.as_rational()).ln();
    let (first, last) = (ln(from), ln(to));
    let step = Float::with_val(bits, &last - &first) / (points - 1);
    let between = (1..points - 1).map(|i| {
        let x = (Float::with_val(bits, &step * i) + &first).exp();
        let (_, text, exponent) = x.to_sign_string_exp_round(10, Some(digits), Round::Nearest);
        // The number is 0.text × 10^exponent.
        let shift = exponent.unwrap_or_default() - digits as i32;
        let power = Rational::from(Integer::from(10).pow(shift.unsigned_abs()));
        let whole = Rational::from(text.parse::<Integer>().expect("digits"));
        Exact::from(if shift < 0 { whole / power } else { whole * power })
    });
    [from.clone()].into_iter().chain(between).chain([to.clone()]).collect()
}
