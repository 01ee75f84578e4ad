//! The augmentation (1.16) as an iterator.

use super::Plane;
use crate::chapter::{SpringMass, augmented, contact, structure};
use crate::number::tree::piecewise_ops;
use crate::number::{OrderedField, PositivePart, Program, SpecializedProgram, Tree};
use std::mem::replace;
use std::sync::LazyLock;

/// One iterate of (1.16).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Iterate<T> {
    /// Number k of the augmentation, from 0.
    pub k: u64,
    /// λ_k, in N.
    pub multiplier: T,
    /// u_k, in m.
    pub deflection: T,
    /// p_k, in m.
    pub penetration: T,
    /// m g − c u_k, in N: the force in equilibrium with u_k, or 0 if the mass is separated. In exact
    /// arithmetic it is λ_{k+1} (note 6).
    pub contact_force: T,
}

/// The augmentation (1.16) as an infinite iterator, for every number system.
///
/// If the number system computes in place ([`Field::IN_PLACE`](crate::number::Field::IN_PLACE)), subformulas
/// without λ are computed once, and a step allocates only the four numbers of an [`Iterate`]; the results are
/// the same. [`kth_iterate`](super::kth_iterate) computes the k-th iterate directly.
///
/// # Examples
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
    /// Created with the first step if the number system computes in place.
    program: Option<SpecializedProgram<T>>,
}

impl<'a, T: OrderedField> Augmentation<'a, T> {
    /// Starts from λ₀ = 0 with unilateral contact; `penalty` is ε > 0 in N/m.
    pub fn new(system: &'a SpringMass<T>, penalty: &'a T) -> Self {
        Augmentation { system, penalty, plane: Plane::Unilateral, k: 0, multiplier: T::zero(), program: None }
    }

    /// Sets the initial multiplier λ₀, in N.
    pub fn with_multiplier(self, multiplier: T) -> Self {
        Augmentation { multiplier, ..self }
    }

    /// Sets the plane.
    pub fn over(self, plane: Plane) -> Self {
        Augmentation { plane, program: None, ..self }
    }

    /// Returns ε, in N/m.
    pub fn penalty(&self) -> &T {
        self.penalty
    }

    /// Returns the plane.
    pub fn plane(&self) -> Plane {
        self.plane
    }

    /// Returns the multiplier λ of the next step, in N.
    pub fn multiplier(&self) -> &T {
        &self.multiplier
    }

    /// Computes the next iterate; there always is one.
    pub fn step(&mut self) -> Iterate<T> {
        let iterate = if T::IN_PLACE { self.step_in_place() } else { self.step_by_functions() };
        self.k += 1;
        iterate
    }

    fn step_by_functions(&mut self) -> Iterate<T> {
        let step = StepResult::of(self.plane, self.system, self.penalty, &self.multiplier);
        let free = step.free.is_some_and(|free| step.deflection >= free);
        Iterate {
            k: self.k,
            multiplier: replace(&mut self.multiplier, step.next),
            deflection: step.deflection,
            penetration: step.penetration,
            contact_force: if free { T::zero() } else { step.contact_force },
        }
    }

    fn step_in_place(&mut self) -> Iterate<T> {
        let Record { program: recorded, multiplier, step } = Record::of(self.plane);
        let (system, penalty) = (self.system, self.penalty);
        let program = self.program.get_or_insert_with(|| {
            recorded.specialize(&|name| constant(name, system, penalty), &piecewise_ops).expect(ELEMENTARY)
        });
        let spare = program.replace(*multiplier, replace(&mut self.multiplier, T::zero()));
        program.run(&piecewise_ops).expect(ELEMENTARY);
        let free = step.free.is_some_and(|free| program[step.deflection] >= program[free]);
        self.multiplier = program.replace(step.next, spare);
        Iterate {
            k: self.k,
            multiplier: program.take(*multiplier),
            deflection: program.take(step.deflection),
            penetration: program.take(step.penetration),
            contact_force: if free { T::zero() } else { program.take(step.contact_force) },
        }
    }

    /// Recycles the memory of an iterate for the next ones.
    pub(super) fn reuse(&mut self, iterate: Iterate<T>) {
        if let Some(program) = &mut self.program {
            let Record { multiplier, step, .. } = Record::of(self.plane);
            program.replace(*multiplier, iterate.multiplier);
            program.replace(step.deflection, iterate.deflection);
            program.replace(step.penetration, iterate.penetration);
            program.replace(step.contact_force, iterate.contact_force);
        }
    }
}

impl<T: OrderedField> Iterator for Augmentation<'_, T> {
    type Item = Iterate<T>;
    fn next(&mut self) -> Option<Iterate<T>> {
        Some(self.step())
    }
}

/// Results of one step for a given λ.
struct StepResult<T> {
    deflection: T,
    penetration: T,
    /// Contact force if the mass is not separated.
    contact_force: T,
    /// Multiplier of the next step.
    next: T,
    /// Deflection of the separated mass, for a unilateral plane.
    free: Option<T>,
}

impl<T: PositivePart> StepResult<T> {
    /// Computes the step with the chapter's functions.
    fn of(plane: Plane, system: &SpringMass<T>, penalty: &T, lambda: &T) -> Self {
        let (u, force, next, free) = match plane {
            Plane::Unilateral => {
                let u = augmented::unilateral_deflection(system, penalty, lambda);
                let force = augmented::contact_force(system, &u).positive_part();
                let next = augmented::unilateral_update(system, penalty, lambda, &u);
                (u, force, next, Some(structure::deflection(system)))
            }
            Plane::Bilateral => {
                let u = augmented::deflection(system, penalty, lambda);
                let force = augmented::contact_force(system, &u);
                let next = augmented::update(system, penalty, lambda, &u);
                (u, force, next, None)
            }
        };
        StepResult {
            penetration: contact::penetration(system, &u),
            deflection: u,
            contact_force: force,
            next,
            free,
        }
    }
}

/// The recorded functions of a step.
struct Record {
    program: Program,
    /// Places of λ and of the results in the program.
    multiplier: usize,
    step: StepResult<usize>,
}

const ELEMENTARY: &str = "a step contains only arithmetic, ⟨·⟩ and min";

impl Record {
    fn of(plane: Plane) -> &'static Record {
        static UNILATERAL: LazyLock<Record> = LazyLock::new(|| Record::new(Plane::Unilateral));
        static BILATERAL: LazyLock<Record> = LazyLock::new(|| Record::new(Plane::Bilateral));
        match plane {
            Plane::Unilateral => &UNILATERAL,
            Plane::Bilateral => &BILATERAL,
        }
    }

    fn new(plane: Plane) -> Self {
        let system = SpringMass::SYMBOLS.map(|name| Tree::symbol(name));
        let [penalty, lambda] = ["ε", "λ"].map(|name| Tree::symbol(name));
        let step = StepResult::of(plane, &system, &penalty, &lambda);
        let mut program = Program::default();
        let multiplier = program.add(&lambda);
        let step = StepResult {
            deflection: program.add(&step.deflection),
            penetration: program.add(&step.penetration),
            contact_force: program.add(&step.contact_force),
            next: program.add(&step.next),
            free: step.free.map(|free| program.add(&free)),
        };
        Record { program, multiplier, step }
    }
}

/// Returns the value of a symbol, or `None` for λ, which varies.
fn constant<T: Clone>(name: &str, system: &SpringMass<T>, penalty: &T) -> Option<T> {
    if name == "ε" { Some(penalty.clone()) } else { system.by_symbol(name).cloned() }
}
