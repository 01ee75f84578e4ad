//! What rounding leaves within reach: the proved laws of [`rounding`], solved for what a user asks.

use super::count::count;
use super::{Plane, Scalar, SolveError, check, exact};
use crate::chapter::{SpringMass, penalty, rounding, structure, system};
use crate::number::{Exact, NumberSystem, PRECISIONS, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::Integer;

/// Is it guaranteed that floats of this scalar meet the tolerance, from λ₀ = 0, where mass and plane touch?
///
/// It is for 64 (c + ε) ≤ ε (1 + 1/η) and tol > 20 F + η (|H| + 8 tol), with the drift 20 F of
/// [`rounding::penetration_drift`], which is proved for both planes. A smaller tolerance may be met as well,
/// by luck, or not. Rationals meet every one.
///
/// The machine's floats have numbers below their least normal one, n, that are rounded by more than η of
/// themselves. So in f32 and f64 it also takes a weight that is 0 or at least n, a gap that is 0 or has
/// ε |Δ| ≥ 2 n, lengths H and l that are 0 or at least 4 n / η, a tolerance of at least 4 n, and n (2 + 1/ε)
/// besides the drift: then no result below n is met before the tolerance is.
///
/// # Errors
/// [`SolveError::Invalid`] for a parameter, a penalty, a tolerance or a unit roundoff that is not finite or
/// not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact};
/// # use spring_mass_contact::solver::{Method, Outcome, solve, within_reach};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let eta = Exact::power_of_two(-53);
/// let ends = |tolerance| {
///     let method = Method::Augmented { penalty: 1.0, tolerance, max_augmentations: 10_000, start: 0.0 };
///     let guaranteed = within_reach(&system, &1.0, &tolerance, &eta)?;
///     Ok((guaranteed, solve(&system, &method)?.outcome))
/// };
/// assert_eq!(ends(1e-13)?, (true, Outcome::Converged));
/// assert_eq!(ends(1e-14)?, (false, Outcome::Converged)); // luck
/// assert_eq!(ends(1e-16)?, (false, Outcome::Stagnated)); // less than η H
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn within_reach<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Result<bool, SolveError> {
    let (numbers, eps, tolerance) = valid(system, eps, tolerance, unit_roundoff)?;
    let laws = Laws::of(&numbers, unit_roundoff, &least_normal(&system.c));
    Ok(laws.is_none_or(|laws| laws.promise(&eps, &tolerance)))
}

/// So many augmentations at most meet the tolerance in floats of this unit roundoff, from λ₀ = 0 where mass
/// and plane touch; none if it is not [within reach](within_reach).
///
/// As many as exact arithmetic needs for what 20 F + η (|H| + 8 tol) leaves of the tolerance; in rationals,
/// for the tolerance.
///
/// # Errors
/// As [`within_reach`], and [`SolveError::TooLong`] for a number of so many digits.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::augmentations_promised};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let promised = |tolerance| augmentations_promised(&system, &100.0, &tolerance, &Exact::power_of_two(-53));
/// assert_eq!(promised(1e-12)?, Some(35.into())); // as many as it takes without rounding
/// assert_eq!(promised(3e-15)?, Some(47.into())); // 43 without; 24.01 η of 3e-15 go to rounding
/// assert_eq!(promised(1e-15)?, None);
/// # Ok::<(), spring_mass_contact::solver::SolveError>(())
/// ```
pub fn augmentations_promised<T: Scalar + ToExact>(
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

/// The rounding floor, in m: every tolerance above it is met by each method in floats of this unit roundoff,
/// with a penalty that is hard enough; if there is none, no tolerance is promised (5 bits and fewer, or
/// numbers so small that results may underflow).
///
/// That is the bound of [`within_reach`] for ε → ∞; where the mass hangs free, 5 η |m g / c|, and the sum of
/// both near grazing, where |R| / c is no more than the first and twice the second. Without overflow; a
/// smaller tolerance may be met by luck.
///
/// # Errors
/// [`SolveError::Invalid`] for a parameter or a unit roundoff that is not finite or not in its range.
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

/// The same for numbers as they are in their scalar, which has this least normal one.
fn floor(
    system: &SpringMass<Exact>,
    plane: Plane,
    unit_roundoff: &Exact,
    least_normal: &Exact,
) -> Option<Exact> {
    let Some(laws) = Laws::of(system, unit_roundoff, least_normal) else { return Some(Exact::zero()) };
    // With fewer bits no penalty bounds the drift: 64 (c + ε) ≤ ε (2ᵖ + 1) for none.
    if laws.precision <= Exact::from(63) {
        return None;
    }
    let free = plane == Plane::Unilateral && system::reaction(system) < Exact::zero();
    // Where the mass hangs free the softest penalty is c.
    if !laws.is_normal() || free && !laws.is_normal_with(&system.c) {
        return None;
    }
    let least = laws.least_tolerance(&(laws.hardest_drift() + Exact::from(2) * least_normal));
    let least = if free { laws.free_floor(system, least) } else { least };
    Some(least.max(laws.shortest_tolerance()))
}

/// The least number of a scalar that has all its bits, n: a result below it is rounded by up to η n. For all
/// but the machine's floats 0, since their exponents are as good as unlimited.
pub(super) fn least_normal<T: ToExact>(like: &T) -> Exact {
    match like.number_system() {
        NumberSystem::F32 => exact(&f32::MIN_POSITIVE),
        NumberSystem::F64 => exact(&f64::MIN_POSITIVE),
        NumberSystem::Mpfr(_) | NumberSystem::Exact => Exact::zero(),
    }
}

/// How many bits promise a tolerance, in m, by each method: the fewest whose [`rounding_floor`] is below it,
/// for the parameters and the tolerance as rounded to so many bits. `None` if more than
/// [`PRECISIONS`] has.
///
/// # Errors
/// [`SolveError::Invalid`] for a parameter or a tolerance that is not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, bits_needed}};
/// let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse()?;
/// assert_eq!(bits_needed(&system, Plane::Unilateral, &Exact::power_of_two(-93))?, Some(100));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bits_needed(
    system: &SpringMass<Exact>,
    plane: Plane,
    tolerance: &Exact,
) -> Result<Option<u32>, SolveError> {
    check::system(system)?;
    check::positive("tolerance", tolerance)?;
    let floor = |system: &_, eta: &_| floor(system, plane, eta, &Exact::zero());
    let promised = |bits: u32| {
        let rounded = |x: &Exact| x.rounded(bits).expect("some bits");
        let eta = Exact::power_of_two(-i32::try_from(bits).expect("precisions are small"));
        let floor = floor(&system.map(rounded), &eta);
        floor.is_some_and(|floor| floor < rounded(tolerance))
    };
    // The floor halves with every bit, but for what rounding does to the parameters.
    let like = floor(system, &Exact::power_of_two(-64)).expect("bits enough");
    let (least, most) = (6, *PRECISIONS.end());
    let ratio = like / tolerance;
    let [over, under] =
        [ratio.as_rational().numer(), ratio.as_rational().denom()].map(Integer::significant_bits);
    let about = (64 + over).saturating_sub(under).clamp(least, most);
    let less = |n: i32| about.checked_sub(n.unsigned_abs());
    if promised(about) {
        // Where the mass hangs free it can be so many less that one after the other would take for ever.
        return Ok(less(last(|n| less(n).is_some_and(|bits| bits >= least && promised(bits)))));
    }
    Ok((about..=most).take(64).find(|bits| promised(*bits)))
}

/// The last n of which something holds that holds of 0 and, once lost, of no greater one.
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

/// A system, a penalty and a tolerance, checked, as they are in their scalar.
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

/// Where a line through two points reaches a height; none if it is level.
fn crossing((x, y): (Exact, Exact), (x2, y2): (Exact, Exact), height: &Exact) -> Option<Exact> {
    let rise = y2 - &y;
    (!rise.is_zero()).then(|| &x + (height - y) * (x2 - &x) / rise)
}

/// From which penalty on, and up to which, if any is too hard.
pub(super) struct Limits {
    pub(super) from: Exact,
    pub(super) to: Option<Exact>,
}

impl Limits {
    /// Of the penalty method without rounding.
    pub(super) fn exact(system: &SpringMass<Exact>, tolerance: &Exact) -> Self {
        Limits { from: penalty::penalty_for(system, tolerance).positive_part(), to: None }
    }
}

/// The laws of rounding for one system in one precision. As printed they are for R ≥ 0.
pub(super) struct Laws {
    system: SpringMass<Exact>,
    eta: Exact,
    /// 2ᵖ
    precision: Exact,
    /// n, the [least normal number](least_normal).
    least_normal: Exact,
}

impl Laws {
    /// None where nothing is rounded.
    pub(super) fn of(
        system: &SpringMass<Exact>,
        unit_roundoff: &Exact,
        least_normal: &Exact,
    ) -> Option<Self> {
        if unit_roundoff.is_zero() {
            return None;
        }
        // A plane that pulls is one that pushes, seen in a mirror: the same floats but for their signs.
        let system = if system::reaction(system) < Exact::zero() {
            let SpringMass { c, m, g, l, h } = system.clone();
            SpringMass { c, m, g: -g, l: -l, h: -h }
        } else {
            system.clone()
        };
        let precision = Exact::one() / unit_roundoff;
        Some(Laws { system, eta: unit_roundoff.clone(), precision, least_normal: least_normal.clone() })
    }

    /// That an augmentation with this penalty meets this tolerance.
    fn promise(&self, eps: &Exact, tolerance: &Exact) -> bool {
        let Laws { system, precision, .. } = self;
        let stiffness = penalty::total_stiffness(system, eps);
        let fine = Exact::from(64) * stiffness <= eps * (precision + Exact::one());
        let normal = self.is_normal() && self.is_normal_with(eps) && *tolerance >= self.shortest_tolerance();
        fine && normal && *tolerance > self.least_tolerance(&self.penetration_drift(eps))
    }

    /// Returns `true` if the weight and the lengths keep all their bits: the weight is rounded by no more
    /// than η of itself, and l + û, or û − H where l = 0, is the same for all |û| < n as for û = 0, so
    /// that nothing is lost where û underflows. (Where H = l = 0, û is p̂, and within the tolerance by
    /// then.)
    fn is_normal(&self) -> bool {
        let Laws { system, eta, least_normal, .. } = self;
        let shortest = Exact::from(4) * least_normal / eta;
        let at_least = |x: Exact, least: &Exact| x.is_zero() || x.abs() >= *least;
        at_least(system::weight(system), least_normal)
            && [&system.l, &system.h].into_iter().all(|length| at_least(length.clone(), &shortest))
    }

    /// Returns `true` if ε Δ keeps all its bits, the difference of H and l rounded.
    fn is_normal_with(&self, eps: &Exact) -> bool {
        let gap = system::gap(&self.system);
        gap.is_zero() || eps * gap.abs() >= Exact::from(2) * &self.least_normal
    }

    /// The shortest tolerance that is promised: whatever is below n is rounded by up to η n, six times
    /// that is 3 η of this, and so much is what [`least_tolerance`](Self::least_tolerance) has to spare.
    fn shortest_tolerance(&self) -> Exact {
        Exact::from(4) * &self.least_normal
    }

    /// So many augmentations at most until one with this penalty meets this tolerance, if it is promised:
    /// then the exact penetration is below what drift leaves of the tolerance.
    pub(super) fn augmentations_at_most(
        &self,
        eps: &Exact,
        tolerance: &Exact,
    ) -> Result<Option<Integer>, SolveError> {
        let needed = || {
            // With bits enough; with three, there is no least tolerance.
            let left = tolerance - self.least_tolerance(&self.penetration_drift(eps));
            count(&self.system, eps, &left, &Exact::zero(), Plane::Bilateral)
        };
        self.promise(eps, tolerance).then(needed).transpose()
    }

    /// With room for a p̂ of which ε p̂ < n: the law holds up to the first, and it is within every tolerance
    /// that is promised. So is a û below n where H = l = 0.
    fn penetration_drift(&self, eps: &Exact) -> Exact {
        let small = &self.least_normal * (Exact::from(2) + Exact::one() / eps);
        rounding::penetration_drift(&self.system, eps, &self.precision) + small
    }

    /// What the tolerance has to be greater than if p̂ drifts so far.
    ///
    /// Once p̂ is all drift, |p̂| < tol, and its bound |p̂| + η (|fl(l + û)| + |p̂|) is below
    /// |p̂| + η (|H| + 3 tol). Balls round that up, the bracket and the sum by less than 4 η of themselves:
    /// less than 5 η tol in all.
    fn least_tolerance(&self, drift: &Exact) -> Exact {
        (drift + &self.eta * self.system.h.abs()) / (Exact::one() - Exact::from(8) * &self.eta)
    }

    /// Which penalties bring (1.13) within a tolerance: from the first on, and up to the second rounding
    /// takes no more from the force ε p for the sake of ε than the tolerance does. None if no penalty does.
    ///
    /// Where products underflow, m g and ε Δ are off by η n each besides, and the quotient by another η
    /// n. What both products lose the law takes for a weight that is off by 3 η n at most: (m g + t) (1 +
    /// γ e) + ε Δ for m g (1 + γ e) + ε Δ + t (1 + γ e). The quotient's takes so much from the tolerance.
    pub(super) fn penalties(&self, tolerance: &Exact) -> Option<Limits> {
        let Laws { precision, .. } = self;
        let lost = &self.eta * &self.least_normal;
        let system = &self.heavier_by(&(Exact::from(3) * &lost));
        let tolerance = &(tolerance - &lost);
        // What (1.13) is off by is affine in p = R/(c + ε), and two points fix a line.
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

    /// Up to which penalty rounding takes no more from the multiplier of (1.16) for the sake of ε than this
    /// tolerance does, if there is one. Above the floor that is more than c/2.
    pub(super) fn hardest_augmentation(&self, tolerance: &Exact) -> Option<Exact> {
        let Laws { system, precision, .. } = self;
        let level = self.without_reaction();
        let drift = rounding::multiplier_drift(&level, &system.c, precision);
        let to = self.hardest(penalty::total_stiffness(system, &system.c), drift, tolerance);
        to.map(|stiffness| stiffness - &system.c)
    }

    /// Up to where what rounding takes from a force is no more than c times the tolerance, if it grows by
    /// `loss` for every `stiffness`. Where it may underflow, no penalty is known to be soft enough: 0.
    fn hardest(&self, stiffness: Exact, loss: Exact, tolerance: &Exact) -> Option<Exact> {
        let allowed = &self.system.c * tolerance;
        if !self.is_normal() || allowed < self.least_normal {
            return Some(Exact::zero());
        }
        crossing((Exact::zero(), Exact::zero()), (stiffness, loss), &allowed)
    }

    /// The floor where the mass hangs free, for ε ≥ c.
    ///
    /// Computed is û = min(â, b̂) of a = m g / c and b = (m g + ε Δ) / (c + ε). Proved (note 4) is that û is
    /// off by no more than η (2 |a| + 8 (|Δ| + |R| / (c + ε))), and that the natural residual, p̂ if that is
    /// positive, is no more than η (3 |a| + |H|). The bound of û, a ball around â, adds its radius, 2 η |a|.
    /// Far from grazing û is â, and off by 2 η |a|: b − a = |R| ε / (c (c + ε)) is at least |R| / (2 c), and
    /// at least the last term of b̂'s error, to first order η (5 |Δ| + 4 |R| / (c + ε)).
    fn free_floor(&self, system: &SpringMass<Exact>, touching: Exact) -> Exact {
        let alone = Exact::from(5) * &self.eta * structure::deflection(system).abs();
        let distance = system::reaction(&self.system) / &self.system.c;
        if distance > &touching + Exact::from(2) * &alone { alone } else { touching + alone }
    }

    /// The drift of the penetration that no penalty, however hard, has less than: that of a system of the
    /// same lengths with R = 0, where it is the same for all.
    fn hardest_drift(&self) -> Exact {
        rounding::penetration_drift(&self.without_reaction(), &self.system.c, &self.precision)
    }

    /// A system of the same lengths with R = 0.
    fn without_reaction(&self) -> SpringMass<Exact> {
        self.heavier_by(&-system::reaction(&self.system))
    }

    /// The system with this much more weight, in N.
    fn heavier_by(&self, more: &Exact) -> SpringMass<Exact> {
        let weight = system::weight(&self.system) + more;
        SpringMass { m: Exact::one(), g: weight, ..self.system.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::last;

    #[test]
    fn the_last_is_found_wherever_it_is() {
        for n in (0..100).chain([i32::MAX / 2, i32::MAX - 2]) {
            assert_eq!(last(|k| k <= n), n);
        }
    }
}
