//! The laws of rounding, solved for tolerances, penalties and numbers of augmentations.
//!
//! The laws are those of the book's page on floating point (`book/src/floats.md`). The claims about
//! [`rounding`] prove them; the functions below solve them, in the order of that page, whose sections their
//! comments name. They compute in rationals, for the parameters as rounded.
//!
//! Notation: η is the unit roundoff of numbers of p bits, Δ = H − l, R = m g − c Δ, and
//! F = η (|H| + |Δ| + R/ε) is the scale of the floor. Hats mark computed quantities.
//!
//! The page excludes underflow. Machine floats do underflow: below their smallest normal number ν, a result
//! is rounded by up to η ν, whatever its magnitude. Where a law needs it, the functions require numbers of at
//! least ν or increase a bound.

use super::count::count;
use super::{Plane, SolveError};
use crate::chapter::{SpringMass, penalty, rounding, structure, system};
use crate::number::{Exact, NumberSystem, PositivePart, ToExact};
use num_traits::{One, Zero};
use rug::Integer;

/// Returns the smallest normal number ν of a scalar: numbers from ν on have full precision. It is 0 except
/// for machine floats, since the exponents of other numbers are practically unlimited.
pub(super) fn min_normal<T: ToExact>(like: &T) -> Exact {
    match like.number_system() {
        NumberSystem::Float(format) => format.min_normal(),
        NumberSystem::Mpfr(_) | NumberSystem::Exact => Exact::zero(),
    }
}

/// Penalties that suffice for a tolerance, in N/m.
pub(super) struct PenaltyRange {
    /// Limit above which every penalty suffices; 0 if all do.
    pub(super) min: Exact,
    /// Largest penalty that preserves the accuracy of the force, if there is a limit.
    pub(super) max: Option<Exact>,
}

impl PenaltyRange {
    /// Returns the range of the penalty method without rounding: ε ≥ R / tol − c.
    pub(super) fn exact(system: &SpringMass<Exact>, tolerance: &Exact) -> Self {
        PenaltyRange { min: penalty::penalty_for(system, tolerance).positive_part(), max: None }
    }
}

/// The laws of rounding for one system in one precision.
pub(super) struct RoundingLaws {
    /// The system if R ≥ 0, otherwise its mirror image.
    system: SpringMass<Exact>,
    is_mirrored: bool,
    /// Unit roundoff η.
    eta: Exact,
    /// 2ᵖ = 1/η.
    two_to_p: Exact,
    /// [Smallest normal number](min_normal) ν.
    min_normal: Exact,
}

impl RoundingLaws {
    /// Returns `None` if nothing is rounded.
    ///
    /// The laws are stated for R ≥ 0. By the section *The state*, R < 0 with bilateral contact is the mirror
    /// image of R > 0: g, l and H change their signs, and so do all results, with the same digits.
    pub(super) fn new(system: &SpringMass<Exact>, unit_roundoff: &Exact, min_normal: &Exact) -> Option<Self> {
        let is_mirrored = system::reaction(system) < Exact::zero();
        let SpringMass { c, m, g, l, h } = system.clone();
        let system = if is_mirrored { SpringMass { c, m, g: -g, l: -l, h: -h } } else { system.clone() };
        (!unit_roundoff.is_zero()).then(|| RoundingLaws {
            system,
            is_mirrored,
            eta: unit_roundoff.clone(),
            two_to_p: Exact::one() / unit_roundoff,
            min_normal: min_normal.clone(),
        })
    }

    // Section "One operation": fl(x) = x (1 + γ e). Below ν this is true of sums, but not of products.

    /// Returns `true` if the weight and the lengths have full precision: m g is 0 or at least ν; H and l are
    /// 0 or at least 4 ν/η.
    ///
    /// The weight is then rounded by at most η relative to itself. And l + û, or û − H if l = 0, is the same
    /// for all |û| < ν as for û = 0, so that an underflow of û has no effect. (If H = l = 0, û is p̂, and
    /// within the tolerance by then.)
    fn parameters_are_normal(&self) -> bool {
        let RoundingLaws { system, eta, min_normal, .. } = self;
        let min_length = Exact::from(4) * min_normal / eta;
        let weight = system::weight(system);
        [(&weight, min_normal), (&system.l, &min_length), (&system.h, &min_length)]
            .into_iter()
            .all(|(x, least)| x.is_zero() || x.abs() >= *least)
    }

    /// Returns `true` if ε Δ has full precision, with Δ rounded: it is 0 or at least 2 ν.
    fn gap_force_is_normal(&self, eps: &Exact) -> bool {
        let gap = system::gap(&self.system);
        gap.is_zero() || eps * gap.abs() >= Exact::from(2) * &self.min_normal
    }

    /// Returns the smallest tolerance without underflow, 4 ν.
    ///
    /// A result below ν is rounded by up to η ν. Six times that is less than 3 η of this tolerance, the
    /// margin of [`attainable_tolerance`](Self::attainable_tolerance).
    fn min_normal_tolerance(&self) -> Exact {
        Exact::from(4) * &self.min_normal
    }

    // Section "The penalty method's deflection": |û − u| ≤ η (5 |Δ| + 4 R/(c + ε)) (1 + 2 η).

    /// Returns the limit above which every penalty meets the tolerance by (1.13); `None` if none does.
    ///
    /// The distance from the plane is p plus the error of û. As functions of p = R/(c + ε) both are affine,
    /// so two penalties determine the p at which their sum is the tolerance.
    fn min_penalty(&self, system: &SpringMass<Exact>, tolerance: &Exact) -> Option<Exact> {
        let [(p, distance), (other_p, other_distance)] = [1, 2].map(|eps| {
            let eps = Exact::from(eps);
            let p = penalty::penetration(system, &eps);
            (p.clone(), p + rounding::deflection_error(system, &eps, &self.two_to_p))
        });
        let change = other_distance - &distance;
        if change.is_zero() {
            // R = 0: the distance is the same for all penalties.
            return (distance < *tolerance).then(Exact::zero);
        }
        let max_p = &p + (tolerance - distance) * (other_p - &p) / change;
        (max_p > Exact::zero()).then(|| penalty::penalty_for(system, &max_p).positive_part())
    }

    // Section "The penalty force": |N̂ − ε p| ≤ η (ε (|H| + 5 |Δ|) + 7 R) (1 + 8 η).

    /// Returns the largest penalty for which the part of this bound that grows with ε is at most c tol.
    fn max_penalty_for_force(&self, tolerance: &Exact) -> Option<Exact> {
        let RoundingLaws { system, two_to_p, .. } = self;
        let [error, other_error] =
            [1, 2].map(|eps| rounding::penalty_force_error(system, &Exact::from(eps), two_to_p));
        self.max_stiffness(&(other_error - error), tolerance)
    }

    /// Returns the largest stiffness for which the error of a force, in N, is at most c tol, if it is
    /// proportional to the stiffness; `None` if there is no error. Returns 0 if underflow is possible, since
    /// no penalty is then known to be small enough.
    fn max_stiffness(&self, error_per_stiffness: &Exact, tolerance: &Exact) -> Option<Exact> {
        let allowed = &self.system.c * tolerance;
        if !self.parameters_are_normal() || allowed < self.min_normal {
            return Some(Exact::zero());
        }
        (!error_per_stiffness.is_zero()).then(|| allowed / error_per_stiffness)
    }

    // Section "The computed iterates": if 64 (c + ε) ≤ ε (2ᵖ + 1), |λ̂_k − λ_k| ≤ 11 (c + ε) F and
    // |p̂_k − ρᵏ p₀| ≤ 20 F.

    /// Returns `true` if rounding is small relative to the progress of a step: 64 (c + ε) ≤ ε (2ᵖ + 1).
    fn drift_is_bounded(&self, eps: &Exact) -> bool {
        let stiffness = penalty::total_stiffness(&self.system, eps);
        Exact::from(64) * stiffness <= eps * (&self.two_to_p + Exact::one())
    }

    /// Returns `true` if no penalty satisfies this condition: c + ε > ε, so 2ᵖ + 1 must exceed 64.
    fn drift_is_never_bounded(&self) -> bool {
        self.two_to_p <= Exact::from(63)
    }

    /// Bounds the drift of the penetration: 20 F + ν (2 + 1/ε).
    ///
    /// The second term is a margin for a p̂ with ε p̂ < ν. The law holds up to the first one, which is within
    /// every guaranteed tolerance, as is a û below ν if H = l = 0.
    fn penetration_drift(&self, eps: &Exact) -> Exact {
        let underflow = &self.min_normal * (Exact::from(2) + Exact::one() / eps);
        rounding::penetration_drift(&self.system, eps, &self.two_to_p) + underflow
    }

    /// Returns the limit of this bound for ε → ∞: 20 η (|H| + |Δ|) + 2 ν.
    fn limiting_penetration_drift(&self) -> Exact {
        // For R = 0 the drift is the same for all penalties.
        let RoundingLaws { system, two_to_p, min_normal, .. } = self;
        rounding::penetration_drift(&self.without_reaction(), &system.c, two_to_p)
            + Exact::from(2) * min_normal
    }

    /// Returns the largest penalty for which the part of the drift of the multiplier that grows with ε,
    /// 11 η (c + ε) (|H| + |Δ|), is at most c tol, if there is one. Above the floor it is larger than c/2.
    pub(super) fn max_penalty_for_multiplier(&self, tolerance: &Exact) -> Option<Exact> {
        // For R = 0 the drift is proportional to c + ε.
        let RoundingLaws { system, two_to_p, .. } = self;
        let drift = rounding::multiplier_drift(&self.without_reaction(), &system.c, two_to_p);
        let drift_per_stiffness = drift / penalty::total_stiffness(system, &system.c);
        self.max_stiffness(&drift_per_stiffness, tolerance).map(|stiffness| stiffness - &system.c)
    }

    // Section "Unilateral contact": for R < 0, |û₀ − m g/c| ≤ η (2 |m g/c| + 8 (|Δ| + |R|/(c + ε))) and
    // p̂₀ ≤ η (3 |m g/c| + |H|).

    /// Returns the tolerance that a separated mass meets for ε ≥ c, given the floor in contact: 5 η |m g/c|,
    /// and near grazing the sum of both.
    ///
    /// The computed deflection is û = min(â, b̂) of a = m g/c and b = (m g + ε Δ)/(c + ε). By the law, the
    /// error of û is at most η (2 |a| + 8 (|Δ| + |R|/(c + ε))), and the natural residual, which is p̂ if that
    /// is positive, is at most η (3 |a| + |H|). The bound of û, a ball around â, adds its radius, 2 η |a|.
    /// Far from grazing û is â with an error of 2 η |a|: b − a = |R| ε/(c (c + ε)) is at least |R|/(2 c), and
    /// at least the last term of the error of b̂, to first order η (5 |Δ| + 4 |R|/(c + ε)).
    fn separated_floor(&self, contact_floor: Exact) -> Exact {
        let RoundingLaws { system, eta, .. } = self;
        let floor = Exact::from(5) * eta * structure::deflection(system).abs();
        let distance = system::reaction(system) / &system.c;
        let is_near_grazing = distance <= &contact_floor + Exact::from(2) * &floor;
        if is_near_grazing { contact_floor + floor } else { floor }
    }

    // Section "When to stop": the iteration stops when |p̂| + η (|fl(l + û)| + |p̂|) < tol.

    /// Returns the limit above which tolerances are attained if p̂ drifts by at most `drift`: the solution of
    /// tol = drift + η (|H| + 8 tol).
    ///
    /// Once p̂ consists of drift only, |p̂| < tol, and its bound |p̂| + η (|fl(l + û)| + |p̂|) is below
    /// |p̂| + η (|H| + 3 tol). Balls increase this bound, and the bracket and the sum, by less than 4 η
    /// relative to themselves: together by less than 5 η tol.
    fn attainable_tolerance(&self, drift: &Exact) -> Exact {
        (drift + &self.eta * self.system.h.abs()) / (Exact::one() - Exact::from(8) * &self.eta)
    }

    /// Returns `true` if the laws guarantee that an augmentation from λ₀ = 0 with this penalty meets this
    /// tolerance.
    pub(super) fn is_convergence_guaranteed(&self, eps: &Exact, tolerance: &Exact) -> bool {
        self.drift_is_bounded(eps)
            && self.parameters_are_normal()
            && self.gap_force_is_normal(eps)
            && *tolerance >= self.min_normal_tolerance()
            && *tolerance > self.attainable_tolerance(&self.penetration_drift(eps))
    }

    /// Returns an upper bound on the number of augmentations until this tolerance is met with this penalty,
    /// if it is guaranteed.
    ///
    /// It is the first k at which the exact penetration is below the tolerance less the attainable one.
    pub(super) fn max_augmentations(
        &self,
        eps: &Exact,
        tolerance: &Exact,
    ) -> Result<Option<Integer>, SolveError> {
        // Few bits guarantee no tolerance, and 1 − 8 η can be 0.
        if !self.is_convergence_guaranteed(eps, tolerance) {
            return Ok(None);
        }
        let margin = tolerance - self.attainable_tolerance(&self.penetration_drift(eps));
        count(&self.system, eps, &margin, &Exact::zero(), Plane::Bilateral).map(Some)
    }

    // Section "For a large penalty".

    /// Returns the penalties for which (1.13) meets a tolerance, up to the largest one for which rounding
    /// changes the force ε p by no more than the tolerance allows. Returns `None` if no penalty suffices.
    ///
    /// If products underflow, m g and ε Δ have additional errors of η ν each, and the quotient another η ν.
    /// The law represents the errors of both products by a change of the weight of at most 3 η ν: (m g + t)
    /// (1 + γ e) + ε Δ for m g (1 + γ e) + ε Δ + t (1 + γ e). The error of the quotient reduces the
    /// tolerance.
    pub(super) fn penalty_range(&self, tolerance: &Exact) -> Option<PenaltyRange> {
        let underflow = &self.eta * &self.min_normal;
        let tolerance = tolerance - &underflow;
        let heavier = self.with_added_weight(&(Exact::from(3) * underflow));
        let min = self.min_penalty(&heavier, &tolerance)?;
        Some(PenaltyRange { min, max: self.max_penalty_for_force(&tolerance) })
    }

    /// Returns the rounding floor: the limit of the attainable tolerance for ε → ∞; if the mass is separated,
    /// that for ε ≥ c. Returns `None` if no tolerance is guaranteed.
    pub(super) fn rounding_floor(&self, plane: Plane) -> Option<Exact> {
        let is_separated = plane == Plane::Unilateral && self.is_mirrored;
        let is_normal =
            self.parameters_are_normal() && (!is_separated || self.gap_force_is_normal(&self.system.c));
        if self.drift_is_never_bounded() || !is_normal {
            return None;
        }
        let floor = self.attainable_tolerance(&self.limiting_penetration_drift());
        let floor = if is_separated { self.separated_floor(floor) } else { floor };
        Some(floor.max(self.min_normal_tolerance()))
    }

    /// Returns a system of the same lengths with R = 0.
    fn without_reaction(&self) -> SpringMass<Exact> {
        self.with_added_weight(&-system::reaction(&self.system))
    }

    /// Returns the system with additional weight, in N.
    fn with_added_weight(&self, added: &Exact) -> SpringMass<Exact> {
        let weight = system::weight(&self.system) + added;
        SpringMass { m: Exact::one(), g: weight, ..self.system.clone() }
    }
}

#[cfg(test)]
mod tests;
