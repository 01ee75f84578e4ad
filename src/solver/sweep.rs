//! The penalty method for a range of penalties, and the best penalty for a computed force ε p.

use super::guarantees::validate_unit_roundoff;
use super::{Method, Scalar, SolveError, State, exact, solve, validate};
use crate::chapter::{SpringMass, augmented, penalty, rounding, system};
use crate::number::{Exact, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::float::Round;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};

/// Results of the penalty method for one penalty, with the errors of its two forces relative to the contact
/// force R of the problem.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SweepRow<T> {
    /// ε, in N/m.
    pub penalty: T,
    /// u, in m.
    pub deflection: T,
    /// p = l + u − H of this deflection, in m.
    pub penetration: T,
    /// N = m g − c u, in N, by equilibrium, as [`solve`] returns it.
    pub contact_force: T,
    /// N = ε p, in N, by (1.12); `None` if the mass is separated.
    pub penalty_force: Option<T>,
    /// |m g − c u − R| / R, exact for the parameters as represented in their scalar; `None` unless R > 0.
    pub force_error: Option<Exact>,
    /// |ε p − R| / R, likewise.
    pub penalty_force_error: Option<Exact>,
}

/// Solves a system by the penalty method for each ε > 0, in N/m. The rows are independent.
///
/// # Errors
/// A row is an error of [`solve`], or [`SolveError::OutOfRange`] if ε p leaves the range of the scalar.
/// Without penalties the only row is [`SolveError::Invalid`].
///
/// # Examples
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
    let listed: [&T; 0] = [];
    let error = validate::require(penalties.peek().is_some(), "penalties", &listed, "nonempty").err();
    error.map(Err).into_iter().chain(penalties.map(|eps| row(system, eps)))
}

fn row<T: Scalar + ToExact>(system: &SpringMass<T>, eps: T) -> Result<SweepRow<T>, SolveError> {
    let solution = solve(system, &Method::Penalty { penalty: eps.clone() })?;
    let touches = solution.state != State::Separated;
    let force = touches.then(|| penalty::contact_force(system, &eps, &solution.deflection));
    validate::in_range(force.as_ref().is_none_or(T::is_finite), "penalty force")?;
    let reaction = (solution.state == State::Contact).then(|| system::reaction(&system.as_ref().map(exact)));
    let [force_error, penalty_force_error] = [Some(&solution.contact_force), force.as_ref()]
        .map(|force| reaction.as_ref().zip(force).map(|(r, force)| (exact(force) - r).abs() / r));
    Ok(SweepRow {
        force_error,
        penalty_force_error,
        penalty: eps,
        deflection: solution.deflection,
        penetration: solution.penetration,
        contact_force: solution.contact_force,
        penalty_force: force,
    })
}

/// Returns the ε, in N/m, that minimises [`penalty_force_bound`], the bound on the error of a computed ε p of
/// (1.12): [`rounding::best_compliance_squared`] solved for ε.
///
/// The result has about the precision of the scalar. Returns `None` if the bound has no minimum: without a
/// force or without rounding, if it decreases with ε (H = l = 0), or if it increases (very few bits and c Δ
/// large relative to R). `unit_roundoff` is η of the scalar.
///
/// # Errors
/// Returns an error if a parameter is invalid, η is negative, or the penalty leaves the range.
///
/// # Examples
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
    validate_unit_roundoff(unit_roundoff)?;
    if State::of(system)? != State::Contact || unit_roundoff.is_zero() {
        return Ok(None);
    }
    let s = system.as_ref().map(exact);
    let compliance = rounding::best_compliance_squared(&s, &(Exact::one() / unit_roundoff));
    if compliance.is_zero() {
        return Ok(None);
    }
    // (c + ε)² − c² = 2 c ε + ε²; the difference of the root and c would cancel.
    let total = Exact::one() / compliance;
    let excess = &total - &s.c * &s.c;
    if excess <= Exact::zero() {
        return Ok(None);
    }
    let bits = 64 + unit_roundoff.bit_length() as u32;
    let total =
        Exact::from(Float::with_val(bits, total.as_rational()).sqrt().to_rational().unwrap_or_default());
    let best = system.c.round_from_exact(&(excess / (total + s.c)));
    best.map(Some).map_err(|_| SolveError::OutOfRange { quantity: "best penalty" })
}

/// Returns a bound on the error of a computed ε p relative to R, by the claims proved about (1.12) and its
/// [`rounding::penalty_force_error`], without underflow and overflow; `None` unless R > 0. `unit_roundoff` is
/// η of the scalar, 0 for rationals.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter, ε or η is not finite or out of its range.
///
/// # Examples
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
    validate::system(system)?;
    validate::positive("penalty", eps)?;
    validate_unit_roundoff(unit_roundoff)?;
    let (s, eps) = (system.as_ref().map(exact), exact(eps));
    let (r, short) = (system::reaction(&s), augmented::contraction(&s, &eps));
    if r <= Exact::zero() {
        return Ok(None);
    } else if unit_roundoff.is_zero() {
        return Ok(Some(short));
    }
    Ok(Some(short + rounding::penalty_force_error(&s, &eps, &(Exact::one() / unit_roundoff)) / r))
}

/// Largest number of penalties of [`penalties`].
const MAX_POINTS: u32 = 1_000_000;

/// Largest number of digits of a penalty of [`penalties`].
const MAX_DIGITS: usize = 100;

/// Returns `points` penalties from one to another, both included, in about equal ratios, for a logarithmic
/// plot. The unit is arbitrary.
///
/// Intermediate values are decimals with three digits, or as many as distinguish them; they are the same on
/// every machine.
///
/// # Errors
/// Returns an error if a bound is not positive, the second is not larger than the first, there are fewer than
/// two points or more than a million, or they need more than 100 digits.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{number::Exact, solver::penalties};
/// let [from, to] = [1, 100].map(Exact::from);
/// let spaced = penalties(&from, &to, 5)?;
/// assert_eq!(spaced, ["1", "3.16", "10", "31.6", "100"].map(|x| x.parse().unwrap()));
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn penalties(from: &Exact, to: &Exact, points: u32) -> Result<Vec<Exact>, SolveError> {
    validate::require(*from > Exact::zero(), "first penalty", from, "greater than 0")?;
    validate::require(from < to, "last penalty", to, "greater than the first")?;
    validate::require(
        (2..=MAX_POINTS).contains(&points),
        "number of penalties",
        &points,
        "from 2 to 1000000",
    )?;
    let spaced = (3..=MAX_DIGITS).map(|digits| spaced(from, to, points, digits));
    let mut distinct = spaced.filter(|list| list.windows(2).all(|pair| pair[0] < pair[1]));
    let further = "further from the first, or there must be fewer between them";
    distinct.next().ok_or(SolveError::Invalid {
        argument: "last penalty",
        value: to.to_string(),
        allowed: further,
    })
}

fn spaced(from: &Exact, to: &Exact, points: u32, digits: usize) -> Vec<Exact> {
    // Four bits hold a decimal digit; the rest is a margin for the logarithms of large numbers.
    let bits = 4 * digits as u32 + 128;
    let [first, last] = [from, to].map(|x| Float::with_val(bits, x.as_rational()).ln());
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
