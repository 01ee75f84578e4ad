//! Experiments on computed numbers: bounds and outcomes of the solver, changes of units, counts of steps.
//!
//! The book's page on floating point derives the bounds. Exact results are those for the parameters as
//! represented in their scalar.

mod rounding_claims;
#[cfg(test)]
mod tests;

use crate::chapter::{SpringMass, augmented, contact, penalty, structure, system};
use crate::claims::{Case, Var, hypotheses};
use crate::formula::Hypothesis;
use crate::number::{Exact, PositivePart, Real, ToExact};
use crate::solver::{
    Augmentation, Interval, Iterate, Method, Outcome, Plane, Scalar, Solution, SolveError, State,
    exact_augmentation_count, series_penetration, solve, solve_bilateral,
};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::iter::successors;
use std::sync::Arc;

/// Result of one trial of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub enum Trial {
    /// An error and its bound.
    Within {
        /// The error.
        error: Exact,
        /// Its bound.
        bound: Exact,
    },
    /// The property holds or not.
    Decided(bool),
    /// Undecided: a hypothesis does not hold, or a number is out of range.
    Undecided,
}

/// Function of one trial.
pub type Check<T> = Arc<dyn Fn(&Case<T>) -> Trial + Send + Sync>;

/// A claim about *computed* results in one number system.
pub struct Experiment<T> {
    /// Its entry.
    pub equation: &'static str,
    /// Its name, unique within the equation.
    pub name: &'static str,
    /// Its statement in words, or `None` for a claim about rounding, which is a formula.
    pub statement: Option<&'static str>,
    /// Its hypotheses.
    pub hypotheses: Vec<Hypothesis>,
    /// Its trial.
    pub check: Check<T>,
}

fn check<T>(f: impl Fn(&Case<T>) -> Trial + Send + Sync + 'static) -> Check<T> {
    Arc::new(f)
}

macro_rules! list {
    ($($equation:literal $name:literal $statement:literal [$($hypothesis:ident)*] $check:expr;)*) => {
        vec![$(Experiment {
            equation: $equation,
            name: $name,
            statement: Some($statement),
            hypotheses: vec![$(hypotheses().$hypothesis.clone()),*],
            check: check($check),
        }),*]
    };
}

/// Number of steps that an experiment follows.
const STEPS: usize = 24;

/// Largest number of steps to a fixed point.
const MAX_STEPS: usize = 1000;

/// Returns the experiments on floats: claims proved for every precision, then properties that are only
/// tested.
pub fn float_experiments<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    let tried = list! {
        "1.6" "exact-state" "The state corresponds to the exact sign of R."
            [stiffness grazing] |x| state(x, State::of);
        "1.8" "bounds-contain" "The bounds contain the exact u, p and N."
            [stiffness] |x| bounds(x, &Method::Lagrange, solve);
        "1.10" "root" "The exact residual changes sign between the neighbours of the computed root."
            [stiffness penalty quartic] |x| series_root(x, series_penetration);
        "1.13" "bounds-contain" "The bounds contain the exact u, p and N."
            [stiffness penalty] |x: &Case<T>| bounds(x, &Method::Penalty { penalty: x.eps.clone() }, solve);
        "1.33" "promise"
            "If the outcome is `converged`, the exact error of u is below the tolerance; if `stagnated`, \
             it is not above the floor. The bounds contain the limit, and N ≥ 0."
            [stiffness penalty tolerance] |x| promise(x, solve);
        "note 8" "units-of-solutions" "A change of units by powers of two changes no digit of the solution."
            [stiffness penalty tolerance] |x| units(x, solve_bilateral);
    };
    rounding_claims::experiments().into_iter().chain(tried).collect()
}

/// Returns the experiments on exact results.
pub fn exact_experiments() -> Vec<Experiment<Exact>> {
    list! {
        "1.33" "steps" "With unilateral contact the iteration stops at the k for which (1.33) is solved."
            [stiffness penalty tolerance]
            |x| count(x, Plane::Unilateral, exact_steps(x, &x.lambda, Plane::Unilateral));
        "1.33" "steps-bilateral" "With bilateral contact it stops at the k for which (1.33) is solved."
            [stiffness penalty tolerance]
            |x| count(x, Plane::Bilateral, exact_steps(x, &x.lambda, Plane::Bilateral));
        "1.33" "tie-goes-on" "If |p₂| is equal to the tolerance, the iteration stops at k = 3."
            [stiffness penalty tolerance] |x| tie(x, exact_steps(x, &start_of_tie(x), Plane::Bilateral));
        "note 4" "closed-form" "λ_k = R + ρ^{k−1} (λ_1 − R) for k from 2 to 6."
            [stiffness penalty in_contact]
            |x| unilateral_closed_form(x, exact_steps(x, &x.lambda, Plane::Unilateral));
        "note 4" "release"
            "λ_k is first 0 at the K of the note, and the mass is separated from step max(K − 1, 0) on."
            [stiffness penalty separated] |x| release(x, exact_steps(x, &x.lambda, Plane::Unilateral));
    }
}

// Solver of a system by a method; an argument of the experiments, so that tests can pass a wrong one.

/// Solver of a system by a method.
trait Solver<T>: Fn(&SpringMass<T>, &Method<T>) -> Result<Solution<T>, SolveError> {}

impl<T, F: Fn(&SpringMass<T>, &Method<T>) -> Result<Solution<T>, SolveError>> Solver<T> for F {}

/// Arbitrary powers of two for the units of length, mass and force.
const UNITS: [i32; 3] = [3, -2, 5];

fn power_of_two<T: Scalar>(n: i32) -> T {
    (0..n.abs()).fold(T::one(), |x, _| if n < 0 { x / T::int(2) } else { x * T::int(2) })
}

fn exact<T: ToExact>(x: &T) -> Option<Exact> {
    x.to_exact().ok()
}

/// Checks that the state corresponds to the exact sign of R.
fn state<T: Scalar + ToExact>(
    x: &Case<T>,
    of: impl Fn(&SpringMass<T>) -> Result<State, SolveError>,
) -> Trial {
    let Ok(system) = x.system.try_map(|y| y.to_exact()) else { return Trial::Undecided };
    let expected = match system::reaction(&system).cmp(&Exact::zero()) {
        Ordering::Greater => State::Contact,
        Ordering::Equal => State::Grazing,
        Ordering::Less => State::Separated,
    };
    of(&x.system).map_or(Trial::Undecided, |state| Trial::Decided(state == expected))
}

fn encloses<T: ToExact>(interval: &Interval<T>, x: &Exact) -> bool {
    interval.lower.to_exact().is_ok_and(|lower| lower <= *x)
        && interval.upper.to_exact().is_ok_and(|upper| *x <= upper)
}

/// Returns the exact deflection and contact force of a method with unilateral contact.
fn answer(system: &SpringMass<Exact>, penalty: Option<&Exact>) -> (Exact, Exact) {
    let touches = system::reaction(system) > Exact::zero();
    match penalty.filter(|_| touches) {
        Some(eps) => (penalty::deflection(system, eps), penalty::contact_force_at_equilibrium(system, eps)),
        None => (contact::deflection(system), contact::contact_force(system)),
    }
}

fn contains_answer<T: Scalar + ToExact>(
    solution: &Solution<T>,
    s: &SpringMass<Exact>,
    eps: Option<&Exact>,
) -> bool {
    let (u, force) = answer(s, eps);
    encloses(&solution.bounds.deflection, &u)
        && encloses(&solution.bounds.penetration, &contact::penetration(s, &u))
        && encloses(&solution.bounds.contact_force, &force)
}

/// Checks that the bounds of a direct method contain its exact solution.
fn bounds<T: Scalar + ToExact>(x: &Case<T>, method: &Method<T>, solve: impl Solver<T>) -> Trial {
    let (Ok(system), Ok(solution)) = (x.system.try_map(|y| y.to_exact()), solve(&x.system, method)) else {
        return Trial::Undecided;
    };
    let eps = match method {
        Method::Penalty { penalty } => exact(penalty),
        Method::Lagrange | Method::Augmented { .. } => None,
    };
    Trial::Decided(contains_answer(&solution, &system, eps.as_ref()))
}

/// Checks that the exact residual of (1.10) changes sign between the two neighbours of the root.
fn series_root<T: Scalar + Real + ToExact>(
    x: &Case<T>,
    root: impl Fn(&SpringMass<T>, &T, &[T]) -> Result<T, SolveError>,
) -> Trial {
    let (Ok(system), Some(eps), Some(eps4)) =
        (x.system.try_map(|y| y.to_exact()), exact(&x.eps), exact(&x.eps4))
    else {
        return Trial::Undecided;
    };
    let Ok(root) = root(&x.system, &x.eps, std::slice::from_ref(&x.eps4)) else { return Trial::Undecided };
    // A zero without a precision has no neighbours.
    if root.is_zero() {
        let at_root = exact_series_residual(&system, &eps, &eps4, &root);
        return at_root.map_or(Trial::Undecided, |residual| Trial::Decided(residual.is_zero()));
    }
    let neighbours = [Real::next_down(root.clone()), Real::next_up(root)];
    match neighbours.map(|p| exact_series_residual(&system, &eps, &eps4, &p)) {
        [Some(below), Some(above)] => Trial::Decided(below < Exact::zero() && Exact::zero() < above),
        _ => Trial::Undecided,
    }
}

fn exact_series_residual<T: ToExact>(
    system: &SpringMass<Exact>,
    eps: &Exact,
    eps4: &Exact,
    p: &T,
) -> Option<Exact> {
    Some(penalty::series_residual(system, eps, std::slice::from_ref(eps4), &exact(p)?))
}

/// Returns (1.16) with the numbers of a case, for [`STEPS`] steps.
fn by_augmentation<T: Clone>(x: &Case<T>) -> Method<T> {
    let (penalty, tolerance, start) = (x.eps.clone(), x.tol.clone(), x.lambda.clone());
    Method::Augmented { penalty, tolerance, max_augmentations: STEPS as u64, start }
}

/// Checks that the exact |û − u*| is below the tolerance if the outcome is `converged`, and not above the
/// floor if it is `stagnated`; that the bounds contain the limit; and that N ≥ 0.
fn promise<T: Scalar + Real + ToExact>(x: &Case<T>, solve: impl Solver<T>) -> Trial {
    let (Ok(system), Ok(solution)) =
        (x.system.try_map(|y| y.to_exact()), solve(&x.system, &by_augmentation(x)))
    else {
        return Trial::Undecided;
    };
    let (Some(u), Some(tolerance)) = (exact(&solution.deflection), exact(&x.tol)) else {
        return Trial::Undecided;
    };
    let limit = contact::deflection(&system);
    let error = (u - limit).abs();
    let kept = match solution.outcome {
        Outcome::Converged => error < tolerance,
        Outcome::Stagnated => solution.floor.as_ref().and_then(exact).is_some_and(|floor| error <= floor),
        Outcome::IterationLimit => solution.augmentations == Some(STEPS as u64),
        Outcome::Direct => false,
    };
    let pushes = solution.contact_force >= T::zero();
    Trial::Decided(kept && pushes && contains_answer(&solution, &system, None))
}

/// Checks that a change of units by powers of two changes no digit.
fn units<T: Scalar + Real + ToExact>(x: &Case<T>, solve: impl Solver<T>) -> Trial {
    let [length, _, force] = UNITS;
    let scaled = x.map(|var, y| scale(y, unit(var)));
    // Subnormal numbers lose digits when they are scaled.
    let comes_back = scaled.map(|var, y| scale(y, -unit(var))) == *x;
    if !rounding_claims::in_range(x) || !rounding_claims::in_range(&scaled) || !comes_back {
        return Trial::Undecided;
    }
    match [x, &scaled].map(|x| solve(&x.system, &by_augmentation(x))) {
        [Ok(before), Ok(after)] => Trial::Decided(
            after.outcome == before.outcome
                && after.augmentations == before.augmentations
                && after.deflection == scale(&before.deflection, length)
                && after.contact_force == scale(&before.contact_force, force)
                && after.multiplier == before.multiplier.map(|y| scale(&y, force)),
        ),
        _ => Trial::Undecided,
    }
}

/// Returns the exponent of two of the unit of a quantity.
fn unit(var: Var) -> i32 {
    let [length, mass, force] = UNITS;
    match var {
        Var::C | Var::Eps => force - length,
        Var::M => mass,
        Var::G => force - mass,
        Var::L | Var::H | Var::Tol => length,
        Var::Lambda => force,
        _ => 0,
    }
}

fn scale<T: Scalar>(x: &T, n: i32) -> T {
    x.clone() * power_of_two::<T>(n)
}

/// Returns the iterates of (1.16) in rationals, at most [`STEPS`], and only while they have no more digits
/// than correct formulas need: with wrong ones the number of digits can double in each step.
///
/// The closed forms of λ_k and u_k are quotients of degree at most k + 1 in c and ε, and of degree 1 in all
/// other quantities. If all parameters, numerators and denominators together, have s digits, then numerator
/// and denominator of λ_k and of u_k have at most 2 (k + 1) s digits each, 8 (k + 1) s together. The rest is
/// a margin for carries.
fn exact_steps<'a>(
    x: &'a Case<Exact>,
    start: &Exact,
    plane: Plane,
) -> impl Iterator<Item = Iterate<Exact>> + use<'a> {
    let SpringMass { c, m, g, l, h } = &x.system;
    let digits: u64 = [c, m, g, l, h, &x.eps, start].into_iter().map(Exact::bit_length).sum();
    let steps = Augmentation::new(&x.system, &x.eps).with_multiplier(start.clone()).over(plane).take(STEPS);
    steps.take_while(move |step| {
        step.multiplier.bit_length() + step.deflection.bit_length() <= 8 * (step.k + 2) * digits
    })
}

/// Checks that the iteration first meets the tolerance at the k for which (1.33) is solved.
fn count(x: &Case<Exact>, plane: Plane, mut steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let k = exact_augmentation_count(&x.system, &x.eps, &x.tol, &x.lambda, plane);
    let Some(k) = k.ok().and_then(|k| k.to_usize()).filter(|k| *k < STEPS) else { return Trial::Undecided };
    let found = steps.position(|Iterate { multiplier, deflection, penetration, .. }| {
        let residual = match plane {
            Plane::Unilateral => augmented::natural_residual(&x.system, &x.eps, &multiplier, &deflection),
            Plane::Bilateral => penetration,
        };
        augmented::within_tolerance(&residual, &x.tol)
    });
    Trial::Decided(found == Some(k))
}

/// Returns the λ₀ for which p₂ *is* the tolerance.
fn start_of_tie(x: &Case<Exact>) -> Exact {
    let ratio = augmented::contraction(&x.system, &x.eps);
    let missing = penalty::total_stiffness(&x.system, &x.eps) * &x.tol / (&ratio * &ratio);
    system::reaction(&x.system) - missing
}

/// Checks that an iteration with |p₂| equal to the tolerance continues, and stops at k = 3.
fn tie(x: &Case<Exact>, mut steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let found = steps.position(|step| augmented::within_tolerance(&step.penetration, &x.tol));
    Trial::Decided(found == Some(3))
}

/// Checks that λ_k = R + ρ^{k−1} (λ₁ − R) for R ≥ 0 and every λ₀, for k from 2 to 6.
fn unilateral_closed_form(x: &Case<Exact>, steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let steps: Vec<_> = steps.skip(1).take(6).collect();
    let [first, later @ ..] = steps.as_slice() else { return Trial::Decided(false) };
    let ratio = augmented::contraction(&x.system, &x.eps);
    let mut decay = Exact::one();
    let holds = later.iter().all(|step| {
        decay = &decay * &ratio;
        step.multiplier == augmented::multiplier_after(&x.system, &first.multiplier, &decay)
    });
    Trial::Decided(holds && later.len() == 5)
}

/// Checks that for R < 0 the multiplier is first 0 at K, and the mass separated from step max(K − 1, 0) on.
fn release(x: &Case<Exact>, steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let steps: Vec<_> = steps.collect();
    if steps.len() < STEPS {
        return Trial::Decided(false);
    }
    let Some(first) = steps.iter().position(|step| step.multiplier.is_zero()) else {
        return Trial::Undecided;
    };
    // K is 1 for a negative start, otherwise the smallest k for which the closed form is not positive.
    let ratio = augmented::contraction(&x.system, &x.eps);
    let mut decays = successors(Some(Exact::one()), |decay| Some(decay * &ratio)).take(STEPS);
    let expected = if x.lambda < Exact::zero() {
        Some(1)
    } else {
        decays.position(|decay| augmented::multiplier_after(&x.system, &x.lambda, &decay) <= Exact::zero())
    };
    let free = structure::deflection(&x.system);
    let hangs = steps.iter().skip(first.saturating_sub(1)).all(|step| step.deflection == free);
    Trial::Decided(Some(first) == expected && hangs)
}
