//! Attainable accuracy: the proved laws of [`rounding`], solved for guarantees.

use super::count::count;
use super::{Plane, Scalar, SolveError, check, exact};
use crate::chapter::{SpringMass, penalty, rounding, structure, system};
use crate::number::{Exact, NumberSystem, PRECISIONS, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::Integer;

/// Returns `true` if floats of this scalar are guaranteed to meet the tolerance from λ₀ = 0 in contact or
/// grazing.
///
/// The condition is 64 (c + ε) ≤ ε (1 + 1/η) and tol > 20 F + η (|H| + 8 tol), with the drift 20 F of
/// [`rounding::penetration_drift`], which is proved for both planes. A smaller tolerance may be met by
/// chance. Rationals meet every tolerance.
///
/// Machine floats below their smallest normal number n are rounded by more than η relative to themselves.
/// Therefore f32 and f64 also require a weight of 0 or at least n, a gap of 0 or ε |Δ| ≥ 2 n, lengths H and l
/// of 0 or at least 4 n / η, and a tolerance of at least 4 n, and the drift increases by n (2 + 1/ε). No
/// result below n then occurs before the tolerance is met.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter, the penalty, the tolerance or the unit roundoff is not
/// finite or out of its range.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact};
/// # use spring_mass_contact::solver::{Method, Outcome, solve, is_convergence_guaranteed};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let eta = Exact::power_of_two(-53);
/// let ends = |tolerance| {
///     let method = Method::Augmented { penalty: 1.0, tolerance, max_augmentations: 10_000, start: 0.0 };
///     let guaranteed = is_convergence_guaranteed(&system, &1.0, &tolerance, &eta)?;
///     Ok((guaranteed, solve(&system, &method)?.outcome))
/// };
/// assert_eq!(ends(1e-13)?, (true, Outcome::Converged));
/// assert_eq!(ends(1e-14)?, (false, Outcome::Converged)); // luck
/// assert_eq!(ends(1e-16)?, (false, Outcome::Stagnated)); // less than η H
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn is_convergence_guaranteed<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<bool, SolveError> {
    let (numbers, eps, tolerance) = valid(system, eps, tolerance, unit_roundoff)?;
    let laws = Laws::of(&numbers, unit_roundoff, &least_normal(&system.c));
    Ok(laws.is_none_or(|laws| laws.promise(&eps, &tolerance)))
}

/// Returns an upper bound on the number of augmentations that floats of this unit roundoff need to meet the
/// tolerance from λ₀ = 0 in contact or grazing; `None` if convergence is not
/// [guaranteed](is_convergence_guaranteed).
///
/// The bound is the exact count for the part of the tolerance that exceeds 20 F + η (|H| + 8 tol); for
/// rationals, for the tolerance itself.
///
/// # Errors
/// Returns the errors of [`is_convergence_guaranteed`], and [`SolveError::TooLong`] if the count has too many
/// digits.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::guaranteed_max_augmentations};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let eta = Exact::power_of_two(-53);
/// let bound = |tolerance| guaranteed_max_augmentations(&system, &100.0, &tolerance, &eta);
/// assert_eq!(bound(1e-12)?, Some(35.into())); // as many as without rounding
/// assert_eq!(bound(3e-15)?, Some(47.into())); // 43 without rounding
/// assert_eq!(bound(1e-15)?, None);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn guaranteed_max_augmentations<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<Option<Integer>, SolveError> {
    let (numbers, eps, tolerance) = valid(system, eps, tolerance, unit_roundoff)?;
    match Laws::of(&numbers, unit_roundoff, &least_normal(&system.c)) {
        Some(laws) => laws.augmentations_at_most(&eps, &tolerance),
        None => count(&numbers, &eps, &tolerance, &Exact::zero(), Plane::Bilateral).map(Some),
    }
}

/// Returns the rounding floor, in m: every larger tolerance is met by each method in floats of this unit
/// roundoff with a sufficiently large penalty. Returns `None` if no tolerance is guaranteed (5 bits and
/// fewer, or numbers so small that results may underflow).
///
/// It is the limit of [`is_convergence_guaranteed`] for ε → ∞. If the mass is separated it is 5 η |m g / c|,
/// and the sum of both near grazing, where |R| / c is at most the first and twice the second. Overflow is
/// excluded; a smaller tolerance may be met by chance.
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter or the unit roundoff is not finite or out of its range.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, rounding_floor}};
/// let system = SpringMass { c: 4, m: 1, g: 10, l: 1, h: 3 };
/// let system = system.map(|x| Exact::from(*x));
/// let floor = rounding_floor(&system, Plane::Unilateral, &Exact::power_of_two(-10))?;
/// assert_eq!(floor, Some("103/1016".parse()?)); // (20 η (3 + 2) + 3 η) / (1 − 8 η)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rounding_floor<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    plane: Plane,
    unit_roundoff: &Exact,
) -> Result<Option<Exact>, SolveError> {
    check::system(system)?;
    check::unit_roundoff(unit_roundoff)?;
    Ok(floor(&system.map(exact), plane, unit_roundoff, &least_normal(&system.c)))
}

/// Returns the floor for numbers of a scalar with this smallest normal number.
fn floor(
    system: &SpringMass<Exact>,
    plane: Plane,
    unit_roundoff: &Exact,
    least_normal: &Exact,
) -> Option<Exact> {
    let Some(laws) = Laws::of(system, unit_roundoff, least_normal) else { return Some(Exact::zero()) };
    // With fewer bits no penalty bounds the drift: 64 (c + ε) ≤ ε (2ᵖ + 1) has no solution.
    if laws.precision <= Exact::from(63) {
        return None;
    }
    let free = plane == Plane::Unilateral && system::reaction(system) < Exact::zero();
    // If the mass is separated, the smallest penalty is c.
    if !laws.is_normal() || free && !laws.is_normal_with(&system.c) {
        return None;
    }
    let least = laws.least_tolerance(&(laws.hardest_drift() + Exact::from(2) * least_normal));
    let least = if free { laws.free_floor(system, least) } else { least };
    Some(least.max(laws.shortest_tolerance()))
}

/// Returns the smallest number n of a scalar with full precision; a smaller result is rounded by up to η n.
/// It is 0 except for machine floats, since the exponents of other floats are practically unlimited.
pub(super) fn least_normal<T: ToExact>(like: &T) -> Exact {
    match like.number_system() {
        NumberSystem::F32 => exact(&f32::MIN_POSITIVE),
        NumberSystem::F64 => exact(&f64::MIN_POSITIVE),
        NumberSystem::Mpfr(_) | NumberSystem::Exact => Exact::zero(),
    }
}

/// Returns the precision in bits that guarantees a tolerance, in m, by each method: the smallest whose
/// [`rounding_floor`] is below it, for the parameters and the tolerance as rounded to that precision. Returns
/// `None` if it exceeds [`PRECISIONS`].
///
/// # Errors
/// Returns [`SolveError::Invalid`] if a parameter or the tolerance is out of its range.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, required_precision}};
/// let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse()?;
/// assert_eq!(required_precision(&system, Plane::Unilateral, &Exact::power_of_two(-93))?, Some(100));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn required_precision(
    system: &SpringMass<Exact>,
    plane: Plane,
    tolerance: &Exact,
) -> Result<Option<u32>, SolveError> {
    check::system(system)?;
    check::positive("tolerance", tolerance)?;
    let floor = |system: &_, eta: &_| floor(system, plane, eta, &Exact::zero());
    let promised = |bits: u32| {
        let rounded = |x: &Exact| x.round_to_bits(bits).expect("some bits");
        let eta = Exact::power_of_two(-i32::try_from(bits).expect("precisions are small"));
        let floor = floor(&system.map(rounded), &eta);
        floor.is_some_and(|floor| floor < rounded(tolerance))
    };
    // The floor is halved by every bit, except for the effect of rounding on the parameters.
    let like = floor(system, &Exact::power_of_two(-64)).expect("bits enough");
    let (least, most) = (6, *PRECISIONS.end());
    let ratio = like / tolerance;
    let [over, under] =
        [ratio.as_rational().numer(), ratio.as_rational().denom()].map(Integer::significant_bits);
    let about = (64 + over).saturating_sub(under).clamp(least, most);
    let less = |n: i32| about.checked_sub(n.unsigned_abs());
    if promised(about) {
        // For a separated mass the precision can be so much smaller that a linear search would take too long.
        return Ok(less(last(|n| less(n).is_some_and(|bits| bits >= least && promised(bits)))));
    }
    Ok((about..=most).take(64).find(|bits| promised(*bits)))
}

/// Returns the last n for which a predicate holds that holds for 0 and, once false, for no larger n.
pub(super) fn last(holds: impl Fn(i32) -> bool) -> i32 {
    let (mut held, mut lost) = (0, 1);
    while holds(lost) {
        (held, lost) = (lost, lost.saturating_mul(2));
    }
    while lost - held > 1 {
        let middle = held + (lost - held) / 2;
        if holds(middle) { held = middle } else { lost = middle }
    }
    held
}

/// Checks a system, a penalty and a tolerance, and returns their exact values.
fn valid<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<(SpringMass<Exact>, Exact, Exact), SolveError> {
    check::system(system)?;
    check::positive("penalty", eps)?;
    check::positive("tolerance", tolerance)?;
    check::unit_roundoff(unit_roundoff)?;
    Ok((system.map(exact), exact(eps), exact(tolerance)))
}

/// Returns the abscissa at which the line through two points reaches a height; `None` if it is level.
fn crossing((x, y): (Exact, Exact), (x2, y2): (Exact, Exact), height: &Exact) -> Option<Exact> {
    let rise = y2 - &y;
    (!rise.is_zero()).then(|| &x + (height - y) * (x2 - &x) / rise)
}

/// Smallest sufficient penalty, and the largest one if there is a limit.
pub(super) struct Limits {
    pub(super) from: Exact,
    pub(super) to: Option<Exact>,
}

impl Limits {
    /// Returns the limits of the penalty method without rounding.
    pub(super) fn exact(system: &SpringMass<Exact>, tolerance: &Exact) -> Self {
        Limits { from: penalty::penalty_for(system, tolerance).positive_part(), to: None }
    }
}

/// The laws of rounding for one system in one precision, stated for R ≥ 0.
pub(super) struct Laws {
    system: SpringMass<Exact>,
    eta: Exact,
    /// 2ᵖ
    precision: Exact,
    /// The [smallest normal number](least_normal) n.
    least_normal: Exact,
}

impl Laws {
    /// Returns `None` if nothing is rounded.
    pub(super) fn of(
        system: &SpringMass<Exact>,
        unit_roundoff: &Exact,
        least_normal: &Exact,
    ) -> Option<Self> {
        if unit_roundoff.is_zero() {
            return None;
        }
        // R < 0 with bilateral contact is the mirror image of R > 0: the same floats with other signs.
        let system = if system::reaction(system) < Exact::zero() {
            let SpringMass { c, m, g, l, h } = system.clone();
            SpringMass { c, m, g: -g, l: -l, h: -h }
        } else {
            system.clone()
        };
        let precision = Exact::one() / unit_roundoff;
        Some(Laws { system, eta: unit_roundoff.clone(), precision, least_normal: least_normal.clone() })
    }

    /// Returns `true` if an augmentation with this penalty is guaranteed to meet this tolerance.
    fn promise(&self, eps: &Exact, tolerance: &Exact) -> bool {
        let Laws { system, precision, .. } = self;
        let stiffness = penalty::total_stiffness(system, eps);
        let fine = Exact::from(64) * stiffness <= eps * (precision + Exact::one());
        let normal = self.is_normal() && self.is_normal_with(eps) && *tolerance >= self.shortest_tolerance();
        fine && normal && *tolerance > self.least_tolerance(&self.penetration_drift(eps))
    }

    /// Returns `true` if the weight and the lengths keep full precision: the weight is rounded by at most η
    /// relative to itself, and l + û, or û − H if l = 0, is the same for all |û| < n as for û = 0, so that an
    /// underflow of û has no effect. (If H = l = 0, û is p̂, and within the tolerance by then.)
    fn is_normal(&self) -> bool {
        let Laws { system, eta, least_normal, .. } = self;
        let shortest = Exact::from(4) * least_normal / eta;
        let at_least = |x: Exact, least: &Exact| x.is_zero() || x.abs() >= *least;
        at_least(system::weight(system), least_normal)
            && [&system.l, &system.h].into_iter().all(|length| at_least(length.clone(), &shortest))
    }

    /// Returns `true` if ε Δ keeps full precision, with the difference of H and l rounded.
    fn is_normal_with(&self, eps: &Exact) -> bool {
        let gap = system::gap(&self.system);
        gap.is_zero() || eps * gap.abs() >= Exact::from(2) * &self.least_normal
    }

    /// Returns the smallest tolerance that is guaranteed: a result below n is rounded by up to η n, six times
    /// that is 3 η of this tolerance, which [`least_tolerance`](Self::least_tolerance) has as a margin.
    fn shortest_tolerance(&self) -> Exact {
        Exact::from(4) * &self.least_normal
    }

    /// Returns an upper bound on the number of augmentations until this tolerance is met with this penalty,
    /// if it is guaranteed: the exact penetration is then below the tolerance less the drift.
    pub(super) fn augmentations_at_most(
        &self,
        eps: &Exact,
        tolerance: &Exact,
    ) -> Result<Option<Integer>, SolveError> {
        let needed = || {
            // This requires enough bits; with three bits no tolerance is guaranteed.
            let left = tolerance - self.least_tolerance(&self.penetration_drift(eps));
            count(&self.system, eps, &left, &Exact::zero(), Plane::Bilateral)
        };
        self.promise(eps, tolerance).then(needed).transpose()
    }

    /// Returns the drift, with a margin for a p̂ with ε p̂ < n: the law holds up to the first one, which is
    /// within every guaranteed tolerance, as is a û below n if H = l = 0.
    fn penetration_drift(&self, eps: &Exact) -> Exact {
        let small = &self.least_normal * (Exact::from(2) + Exact::one() / eps);
        rounding::penetration_drift(&self.system, eps, &self.precision) + small
    }

    /// Returns the number that the tolerance must exceed if p̂ drifts by `drift`.
    ///
    /// Once p̂ consists of drift only, |p̂| < tol, and its bound |p̂| + η (|fl(l + û)| + |p̂|) is below
    /// |p̂| + η (|H| + 3 tol). Balls increase this bound, and the bracket and the sum, by less than 4 η
    /// relative to themselves: together by less than 5 η tol.
    fn least_tolerance(&self, drift: &Exact) -> Exact {
        (drift + &self.eta * self.system.h.abs()) / (Exact::one() - Exact::from(8) * &self.eta)
    }

    /// Returns the penalties for which (1.13) meets a tolerance: from the first on; up to the second,
    /// rounding changes the force ε p by no more than the tolerance allows. Returns `None` if no penalty
    /// suffices.
    ///
    /// If products underflow, m g and ε Δ have additional errors of η n each, and the quotient another η n.
    /// The law represents the errors of both products by a change of the weight of at most 3 η n: (m g + t)
    /// (1 + γ e) + ε Δ for m g (1 + γ e) + ε Δ + t (1 + γ e). The error of the quotient reduces the
    /// tolerance.
    pub(super) fn penalties(&self, tolerance: &Exact) -> Option<Limits> {
        let Laws { precision, .. } = self;
        let lost = &self.eta * &self.least_normal;
        let system = &self.heavier_by(&(Exact::from(3) * &lost));
        let tolerance = &(tolerance - &lost);
        // The error of (1.13) is affine in p = R/(c + ε), so two points determine it.
        let (soft, hard) = (system.c.clone(), Exact::from(2) * &system.c);
        let off = |eps: &Exact| {
            let p = penalty::penetration(system, eps);
            (p.clone(), p + rounding::deflection_error(system, eps, precision))
        };
        let from = match crossing(off(&soft), off(&hard), tolerance) {
            Some(p) if p > Exact::zero() => penalty::penalty_for(system, &p),
            None if off(&soft).1 < *tolerance => Exact::zero(),
            _ => return None,
        };
        let lost = |eps: &Exact| rounding::penalty_force_error(system, eps, precision);
        let to = self.hardest(&hard - &soft, lost(&hard) - lost(&soft), tolerance);
        Some(Limits { from: from.positive_part(), to })
    }

    /// Returns the largest penalty for which rounding changes the multiplier of (1.16) by no more than this
    /// tolerance allows, if there is one. Above the floor it is larger than c/2.
    pub(super) fn hardest_augmentation(&self, tolerance: &Exact) -> Option<Exact> {
        let Laws { system, precision, .. } = self;
        let level = self.without_reaction();
        let drift = rounding::multiplier_drift(&level, &system.c, precision);
        let to = self.hardest(penalty::total_stiffness(system, &system.c), drift, tolerance);
        to.map(|stiffness| stiffness - &system.c)
    }

    /// Returns the largest penalty for which the error of a force, which grows by `loss` per `stiffness`, is
    /// at most c times the tolerance. Returns 0 if underflow is possible, since then no penalty is known to
    /// be small enough.
    fn hardest(&self, stiffness: Exact, loss: Exact, tolerance: &Exact) -> Option<Exact> {
        let allowed = &self.system.c * tolerance;
        if !self.is_normal() || allowed < self.least_normal {
            return Some(Exact::zero());
        }
        crossing((Exact::zero(), Exact::zero()), (stiffness, loss), &allowed)
    }

    /// Returns the floor of a separated mass for ε ≥ c.
    ///
    /// The computed deflection is û = min(â, b̂) of a = m g / c and b = (m g + ε Δ) / (c + ε). It is proved
    /// (note 4) that the error of û is at most η (2 |a| + 8 (|Δ| + |R| / (c + ε))), and that the natural
    /// residual, which is p̂ if that is positive, is at most η (3 |a| + |H|). The bound of û, a ball around
    /// â, adds its radius, 2 η |a|. Far from grazing û is â with an error of 2 η |a|: b − a = |R| ε / (c (c +
    /// ε)) is at least |R| / (2 c), and at least the last term of the error of b̂, to first order η (5 |Δ| +
    /// 4 |R| / (c + ε)).
    fn free_floor(&self, system: &SpringMass<Exact>, touching: Exact) -> Exact {
        let alone = Exact::from(5) * &self.eta * structure::deflection(system).abs();
        let distance = system::reaction(&self.system) / &self.system.c;
        if distance > &touching + Exact::from(2) * &alone { alone } else { touching + alone }
    }

    /// Returns the drift of the penetration in the limit of large penalties: that of a system of the same
    /// lengths with R = 0, which is the same for all penalties.
    fn hardest_drift(&self) -> Exact {
        rounding::penetration_drift(&self.without_reaction(), &self.system.c, &self.precision)
    }

    /// Returns a system of the same lengths with R = 0.
    fn without_reaction(&self) -> SpringMass<Exact> {
        self.heavier_by(&-system::reaction(&self.system))
    }

    /// Returns the system with additional weight, in N.
    fn heavier_by(&self, more: &Exact) -> SpringMass<Exact> {
        let weight = system::weight(&self.system) + more;
        SpringMass { m: Exact::one(), g: weight, ..self.system.clone() }
    }
}

#[cfg(test)]
mod tests;
