//! (1.16) as an iterator.

use super::Plane;
use crate::chapter::{SpringMass, augmented, contact, structure};
use crate::number::OrderedField;

/// What one step of (1.16) arrives at.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(bound = "T: crate::number::Text"))]
pub struct Iterate<T> {
    /// The counter k, from 0.
    pub k: u64,
    /// λ_k, in N.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub multiplier: T,
    /// u_k, in m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub deflection: T,
    /// p_k, in m.
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub penetration: T,
    /// m g − c u_k, in N: the force that is in equilibrium with u_k; 0 where the mass hangs free. In
    /// exact arithmetic it is λ_{k+1} (note 6).
    #[cfg_attr(feature = "serde", serde(with = "crate::number::quantity"))]
    pub contact_force: T,
}

/// The augmentation (1.16), step by step and without an end; every number system has it.
///
/// ```
/// use spring_mass_contact::{chapter::SpringMass, solver::Augmentation};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let steps = Augmentation::new(&system, &4.0).take(4);
/// let penetrations: Vec<_> = steps.map(|step| step.penetration).collect();
/// assert_eq!(penetrations, [0.25, 0.125, 0.0625, 0.03125]); // ρ = 1/2
/// ```
#[derive(Clone, Debug)]
pub struct Augmentation<'a, T> {
    system: &'a SpringMass<T>,
    penalty: &'a T,
    plane: Plane,
    k: u64,
    multiplier: T,
}

impl<'a, T: OrderedField> Augmentation<'a, T> {
    /// From λ₀ = 0 over a plane that never pulls; the penalty ε > 0 in N/m.
    pub fn new(system: &'a SpringMass<T>, penalty: &'a T) -> Self {
        Augmentation { system, penalty, plane: Plane::Unilateral, k: 0, multiplier: T::zero() }
    }

    /// From another λ₀, in N.
    pub fn from_multiplier(self, multiplier: T) -> Self {
        Augmentation { multiplier, ..self }
    }

    /// Over another plane.
    pub fn over(self, plane: Plane) -> Self {
        Augmentation { plane, ..self }
    }

    /// ε, in N/m.
    pub fn penalty(&self) -> &T {
        self.penalty
    }

    /// Which plane.
    pub fn plane(&self) -> Plane {
        self.plane
    }

    /// λ of the step that comes next, in N.
    pub fn multiplier(&self) -> &T {
        &self.multiplier
    }

    /// The next step; there always is one.
    pub fn step(&mut self) -> Iterate<T> {
        let Augmentation { system, penalty, plane, .. } = *self;
        let lambda = &self.multiplier;
        let (u, force, next) = match plane {
            Plane::Unilateral => {
                let u = augmented::unilateral_deflection(system, penalty, lambda);
                let free = u >= structure::deflection(system);
                let force =
                    if free { T::zero() } else { augmented::contact_force(system, &u).positive_part() };
                let next = augmented::unilateral_update(system, penalty, lambda, &u);
                (u, force, next)
            }
            Plane::Bilateral => {
                let u = augmented::deflection(system, penalty, lambda);
                let force = augmented::contact_force(system, &u);
                let next = augmented::update(system, penalty, lambda, &u);
                (u, force, next)
            }
        };
        let iterate = Iterate {
            k: self.k,
            multiplier: std::mem::replace(&mut self.multiplier, next),
            penetration: contact::penetration(system, &u),
            deflection: u,
            contact_force: force,
        };
        self.k += 1;
        iterate
    }
}

impl<T: OrderedField> Iterator for Augmentation<'_, T> {
    type Item = Iterate<T>;
    fn next(&mut self) -> Option<Iterate<T>> {
        Some(self.step())
    }
}
