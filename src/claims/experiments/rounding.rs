//! Bounds on what rounding does to the formulas.

use super::super::Case;
use super::{MOST_STEPS, STEPS, Trial, exact, within};
use crate::chapter::{SpringMass, augmented, contact, penalty, structure, system};
use crate::number::{Exact, Field, PositivePart, Real, ToExact};
use crate::solver::{Augmentation, Iterate, Plane, Scalar, rounding_floor};
use num_traits::{One, Zero};

/// A system of floats without over- or underflow in the formulas below, and its exact counterpart.
pub(super) struct Setting {
    system: SpringMass<Exact>,
    eps: Exact,
    /// η.
    eta: Exact,
    gap: Exact,
    reaction: Exact,
}

/// A trial that only a system in range can have.
pub(super) fn in_range<T: Scalar + Real + ToExact>(
    x: &Case<T>,
    trial: fn(&Setting, &Case<T>) -> Trial,
) -> Trial {
    Setting::of(x).map_or(Trial::Undecided, |setting| trial(&setting, x))
}

/// The products and quotients that the bounds below suppose to be in range.
fn results<T: Field>(s: &SpringMass<T>, eps: &T) -> [T; 7] {
    let (gap, p) = (system::gap(s), penalty::penetration(s, eps));
    [
        system::weight(s),
        structure::spring_force(s, &gap),
        eps * &gap,
        structure::deflection(s),
        penalty::deflection(s, eps),
        eps * &p,
        p,
    ]
}

impl Setting {
    pub(super) fn of<T: Scalar + Real + ToExact>(x: &Case<T>) -> Option<Self> {
        let eta = [&x.system.c, &x.system.g, &x.system.l, &x.system.h, &x.eps, &x.u]
            .iter()
            .filter_map(|y| exact(&y.unit_roundoff()))
            .max()?;
        let (system, eps) = (x.system.try_map(|y| exact(y).ok_or(())).ok()?, exact(&x.eps)?);
        let smallest = exact(&T::underflow_unit())? / (&eta * &eta);
        let computed: Vec<Exact> = results(&x.system, &x.eps).iter().map(exact).collect::<Option<_>>()?;
        // Nothing was divided by 0, so rationals can follow; a result of 0 may be the last of one that is
        // not.
        for (computed, exact) in computed.iter().zip(results(&system, &eps)) {
            if !exact.is_zero() && computed.abs() < smallest {
                return None;
            }
        }
        let (gap, reaction) = (system::gap(&system), system::reaction(&system));
        Some(Setting { eps, eta, gap, reaction, system })
    }

    /// |p̂ − p| ≤ η (|fl(l + u)| + |p̂|).
    pub(super) fn penetration_rounding<T: Scalar + ToExact>(&self, x: &Case<T>) -> Trial {
        let computed = contact::penetration(&x.system, &x.u);
        let sum = &x.system.l + &x.u;
        match (exact(&computed), exact(&sum), exact(&x.u)) {
            (Some(computed), Some(sum), Some(u)) => {
                let error = &computed - contact::penetration(&self.system, &u);
                within(error, &self.eta * (sum.abs() + computed.abs()))
            }
            _ => Trial::Undecided,
        }
    }

    /// |û − u| ≤ η (5 |Δ| + 4 R/(c + ε)), u the exact (1.13): what is missing to R/(c + ε) + η (…) for Δ.
    pub(super) fn deflection_error<T: Scalar + ToExact>(&self, x: &Case<T>) -> Trial {
        let Some(u) = exact(&penalty::deflection(&x.system, &x.eps)) else { return Trial::Undecided };
        if self.reaction <= Exact::zero() {
            return Trial::Undecided;
        }
        let p = penalty::penetration(&self.system, &self.eps);
        let rounding = &self.eta * (Exact::from(5) * self.gap.abs() + Exact::from(4) * p);
        within(u - penalty::deflection(&self.system, &self.eps), self.first_order(rounding))
    }

    /// The relative error of ε p̂ is at most c/(c + ε) + η ε L/R + 7 η with L = |H| + 5 |Δ|; the first
    /// term is the method's own, the others are the rounding.
    pub(super) fn precision_law<T: Scalar + ToExact>(&self, x: &Case<T>) -> Trial {
        let u = penalty::deflection(&x.system, &x.eps);
        let Some(force) = exact(&penalty::contact_force(&x.system, &x.eps, &u)) else {
            return Trial::Undecided;
        };
        if self.reaction <= Exact::zero() {
            return Trial::Undecided;
        }
        let length = self.system.h.abs() + Exact::from(5) * self.gap.abs();
        let rounding = &self.eta * (&self.eps * length + Exact::from(7) * &self.reaction);
        within(force - penalty::force_at_root(&self.system, &self.eps), self.first_order(rounding))
    }

    /// From λ₀ = 0, |p̂_k − ρᵏ p₀| ≤ 16 F.
    pub(super) fn penetration_drift<T: Scalar + Real + ToExact>(&self, x: &Case<T>) -> Trial {
        let after =
            |decay: &Exact| augmented::penetration_after(&self.system, &self.eps, &Exact::zero(), decay);
        self.drift(
            x,
            |step| exact(&step.penetration),
            after,
            Exact::from(16) * rounding_floor(&self.system, &self.eps, &self.eta),
        )
    }

    /// From λ₀ = 0, |λ̂_k − λ_k| ≤ 9 (c + ε) F.
    pub(super) fn multiplier_drift<T: Scalar + Real + ToExact>(&self, x: &Case<T>) -> Trial {
        let after = |decay: &Exact| augmented::multiplier_after(&self.system, &Exact::zero(), decay);
        let bound = Exact::from(9)
            * penalty::total_stiffness(&self.system, &self.eps)
            * rounding_floor(&self.system, &self.eps, &self.eta);
        self.drift(x, |step| exact(&step.multiplier), after, bound)
    }

    /// The largest distance of the computed iterates from the exact ones, which are functions of ρᵏ.
    fn drift<T: Scalar + Real + ToExact>(
        &self,
        x: &Case<T>,
        computed: impl Fn(&Iterate<T>) -> Option<Exact>,
        after: impl Fn(&Exact) -> Exact,
        bound: Exact,
    ) -> Trial {
        if self.reaction <= Exact::zero() {
            return Trial::Undecided;
        }
        let ratio = augmented::contraction(&self.system, &self.eps);
        let (mut decay, mut worst) = (Exact::one(), Exact::zero());
        for step in Augmentation::new(&x.system, &x.eps).over(Plane::Bilateral).take(STEPS) {
            let Some(computed) = computed(&step) else { return Trial::Undecided };
            worst = worst.max((computed - after(&decay)).abs());
            decay = decay * &ratio;
        }
        within(worst, self.first_order(bound))
    }

    /// Where λ̂ repeats, |p(û)| ≤ η |H| + η (1 + η)²/(1 − η) |λ|/ε.
    pub(super) fn fixed_point<T: Scalar + ToExact>(&self, x: &Case<T>) -> Trial {
        let mut steps = Augmentation::new(&x.system, &x.eps).over(Plane::Bilateral);
        // Where ε ≥ c each step gains a bit or more.
        let bits = self.eta.as_rational().denom().significant_bits() as usize;
        let enough = if self.eps >= self.system.c { (bits + STEPS).min(MOST_STEPS) } else { STEPS };
        for _ in 0..enough {
            let step = steps.step();
            if *steps.multiplier() != step.multiplier {
                continue;
            }
            let (Some(u), Some(lambda)) = (exact(&step.deflection), exact(&step.multiplier)) else { break };
            let one = Exact::one();
            let growth = (&one + &self.eta) * (&one + &self.eta) / (&one - &self.eta);
            let bound = &self.eta * self.system.h.abs() + &self.eta * growth * lambda.abs() / &self.eps;
            return within(contact::penetration(&self.system, &u), bound);
        }
        Trial::Undecided
    }

    /// The bounds hold to first order in η; what is left out is a small multiple of η times them.
    fn first_order(&self, bound: Exact) -> Exact {
        bound * (Exact::one() + Exact::from(64) * &self.eta)
    }
}
