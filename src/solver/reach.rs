//! What rounding leaves within reach: the proved laws of [`rounding`], solved for what a user asks.

use super::{Plane, Scalar, SolveError, State, augmentations_needed, check, exact};
use crate::chapter::{SpringMass, penalty, rounding, structure, system};
use crate::number::{Exact, PRECISIONS, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::Integer;

/// Is it guaranteed that floats of this scalar meet the tolerance, from λ₀ = 0, where mass and plane touch?
///
/// It is for 64 (c + ε) ≤ ε (1 + 1/η) and tol > 20 F + η (|H| + 8 tol), with the drift 20 F of
/// [`rounding::penetration_drift`]. A smaller tolerance may be met as well, by luck, or not. Rationals meet
/// every one.
///
/// # Panics
/// A parameter, the penalty or the tolerance is not finite or not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact};
/// # use spring_mass_contact::solver::{Method, Outcome, solve, within_reach};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let eta = Exact::power_of_two(-53);
/// let ends = |tolerance| {
///     let method = Method::Augmented { penalty: 1.0, tolerance, max_augmentations: 10_000, start: 0.0 };
///     let guaranteed = within_reach(&system, &1.0, &tolerance, &eta);
///     (guaranteed, solve(&system, &method).unwrap().outcome)
/// };
/// assert_eq!(ends(1e-13), (true, Outcome::Converged));
/// assert_eq!(ends(1e-14), (false, Outcome::Converged)); // luck
/// assert_eq!(ends(1e-16), (false, Outcome::Stagnated)); // less than η H
/// ```
pub fn within_reach<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> bool {
    let (system, eps, tolerance) = valid(system, eps, tolerance);
    Laws::of(&system, unit_roundoff).is_none_or(|laws| laws.promise(&eps, &tolerance))
}

/// So many augmentations at most meet the tolerance in floats of this unit roundoff, from λ₀ = 0 where mass
/// and plane touch; none if it is not [within reach](within_reach).
///
/// As many as exact arithmetic needs for what 20 F + η (|H| + 8 tol) leaves of the tolerance; in rationals,
/// for the tolerance.
///
/// # Panics
/// A parameter, the penalty or the tolerance is not finite or not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::augmentations_promised};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// let promised = |tolerance| augmentations_promised(&system, &100.0, &tolerance, &Exact::power_of_two(-53));
/// assert_eq!(promised(1e-12), Some(35.into())); // as many as it takes without rounding
/// assert_eq!(promised(3e-15), Some(47.into())); // 43 without; 24.01 η of 3e-15 go to rounding
/// assert_eq!(promised(1e-15), None);
/// ```
pub fn augmentations_promised<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
    unit_roundoff: &Exact,
) -> Option<Integer> {
    let (system, eps, tolerance) = valid(system, eps, tolerance);
    match Laws::of(&system, unit_roundoff) {
        Some(laws) => laws.augmentations_at_most(&eps, &tolerance),
        None => Some(augmentations_needed(&system, &eps, &tolerance, &Exact::zero(), Plane::Bilateral)),
    }
}

/// The rounding floor, in m: every tolerance above it is met by each method in floats of this unit roundoff,
/// with a penalty that is hard enough; if there is none, no tolerance is promised (5 bits and fewer).
///
/// That is the bound of [`within_reach`] for ε → ∞; where the mass hangs free, 5 η |m g / c|, and the sum of
/// both near grazing, where |R| / c is no more than the first and twice the second. Without under- and
/// overflow; a smaller tolerance may be met by luck.
///
/// # Panics
/// A parameter is not finite or not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, rounding_floor}};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let floor = rounding_floor(&system, Plane::Unilateral, &Exact::power_of_two(-10)).unwrap();
/// assert_eq!(floor, "103/1016".parse().unwrap()); // (20 η (3 + 2) + 3 η) / (1 − 8 η)
/// ```
pub fn rounding_floor<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    plane: Plane,
    unit_roundoff: &Exact,
) -> Option<Exact> {
    let state = required(State::of(system));
    let system = system.map(exact);
    let Some(laws) = Laws::of(&system, unit_roundoff) else { return Some(Exact::zero()) };
    // With fewer bits no penalty bounds the drift: 64 (c + ε) ≤ ε (2ᵖ + 1) for none.
    if laws.precision <= Exact::from(63) {
        return None;
    }
    let touching = laws.least_tolerance(&laws.hardest_drift());
    Some(match (state, plane) {
        (State::Separated, Plane::Unilateral) => laws.free_floor(&system, touching),
        _ => touching,
    })
}

/// How many bits promise a tolerance, in m, by each method: the fewest whose [`rounding_floor`] is below it,
/// for the parameters and the tolerance as rounded to so many bits. `None` if more than
/// [`PRECISIONS`] has.
///
/// # Panics
/// A parameter or the tolerance is not in its range.
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, number::Exact, solver::{Plane, bits_needed}};
/// let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse()?;
/// assert_eq!(bits_needed(&system, Plane::Unilateral, &Exact::power_of_two(-93)), Some(100));
/// # Ok::<(), spring_mass_contact::solver::ReadError>(())
/// ```
pub fn bits_needed(system: &SpringMass<Exact>, plane: Plane, tolerance: &Exact) -> Option<u32> {
    required(check::positive("tolerance", tolerance));
    let promised = |bits: u32| {
        let rounded = |x: &Exact| x.rounded(bits).expect("some bits");
        let eta = Exact::power_of_two(-i32::try_from(bits).expect("precisions are small"));
        let floor = rounding_floor(&system.map(rounded), plane, &eta);
        floor.is_some_and(|floor| floor < rounded(tolerance))
    };
    // The floor halves with every bit, but for what rounding does to the parameters.
    let like = rounding_floor(system, plane, &Exact::power_of_two(-64)).expect("bits enough");
    let (least, most) = (6, *PRECISIONS.end());
    let ratio = like / tolerance;
    let [over, under] =
        [ratio.as_rational().numer(), ratio.as_rational().denom()].map(Integer::significant_bits);
    let about = (64 + over).saturating_sub(under).clamp(least, most);
    let less = |n: i32| about.checked_sub(n.unsigned_abs());
    if promised(about) {
        // Where the mass hangs free it can be so many less that one after the other would take for ever.
        return less(last(|n| less(n).is_some_and(|bits| bits >= least && promised(bits))));
    }
    (about..=most).take(64).find(|bits| promised(*bits))
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

/// What a caller has to see to.
fn required<T>(checked: Result<T, SolveError>) -> T {
    checked.unwrap_or_else(|error| panic!("{error}"))
}

/// A system, a penalty and a tolerance, checked, as they are in their scalar.
fn valid<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    eps: &T,
    tolerance: &T,
) -> (SpringMass<Exact>, Exact, Exact) {
    required(check::system(system));
    required(check::positive("penalty", eps));
    required(check::positive("tolerance", tolerance));
    (system.map(exact), exact(eps), exact(tolerance))
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
}

impl Laws {
    /// None where nothing is rounded.
    pub(super) fn of(system: &SpringMass<Exact>, unit_roundoff: &Exact) -> Option<Self> {
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
        Some(Laws { system, eta: unit_roundoff.clone(), precision: Exact::one() / unit_roundoff })
    }

    /// That an augmentation with this penalty meets this tolerance.
    fn promise(&self, eps: &Exact, tolerance: &Exact) -> bool {
        let Laws { system, precision, .. } = self;
        let stiffness = penalty::total_stiffness(system, eps);
        let fine = Exact::from(64) * stiffness <= eps * (precision + Exact::one());
        fine && *tolerance > self.least_tolerance(&self.penetration_drift(eps))
    }

    /// So many augmentations at most until one with this penalty meets this tolerance, if it is promised:
    /// then the exact penetration is below what drift leaves of the tolerance.
    pub(super) fn augmentations_at_most(&self, eps: &Exact, tolerance: &Exact) -> Option<Integer> {
        let needed = || {
            // With bits enough; with three, there is no least tolerance.
            let left = tolerance - self.least_tolerance(&self.penetration_drift(eps));
            augmentations_needed(&self.system, eps, &left, &Exact::zero(), Plane::Bilateral)
        };
        self.promise(eps, tolerance).then(needed)
    }

    fn penetration_drift(&self, eps: &Exact) -> Exact {
        rounding::penetration_drift(&self.system, eps, &self.precision)
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
    pub(super) fn penalties(&self, tolerance: &Exact) -> Option<Limits> {
        let Laws { system, precision, .. } = self;
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
        let growth = (&hard - &soft, lost(&hard) - lost(&soft));
        let to = crossing((Exact::zero(), Exact::zero()), growth, &(&system.c * tolerance));
        Some(Limits { from: from.positive_part(), to })
    }

    /// Up to which penalty rounding takes no more from the multiplier of (1.16) for the sake of ε than this
    /// tolerance does, if there is one. Above the floor that is more than c/2.
    pub(super) fn hardest_augmentation(&self, tolerance: &Exact) -> Option<Exact> {
        let Laws { system, precision, .. } = self;
        let level = self.without_reaction();
        let drift = rounding::multiplier_drift(&level, &system.c, precision);
        let growth = (penalty::total_stiffness(system, &system.c), drift);
        let to = crossing((Exact::zero(), Exact::zero()), growth, &(&system.c * tolerance));
        to.map(|stiffness| stiffness - &system.c)
    }

    /// The floor where the mass hangs free, for ε ≥ c.
    ///
    /// Computed is û = min(â, b̂) of a = m g / c and b = (m g + ε Δ) / (c + ε), to first order with errors
    /// of 2 η |a| and η (5 |Δ| + 4 |R| / (c + ε)), and b − a = |R| ε / (c (c + ε)) is at least |R| / (2 c),
    /// and at least the last of these terms. So û is off by 2 η |a|, or by 5 η |Δ| more if b is as near as
    /// that; its bound, a ball around â, adds its radius, 2 η |a|. What is of higher order is less than the
    /// rest. The natural residual is 0, or what p̂ is off by, less than 3 η |H|, if |R| / c is as small as
    /// that.
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
        let weight = structure::spring_force(&self.system, &system::gap(&self.system));
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
