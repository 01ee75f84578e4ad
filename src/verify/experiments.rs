//! What only computed numbers have: rounding floors, stagnation, promises of the solver, counts.
//!
//! The bounds are those of the chapter on floating point in the book, where they are derived. "True"
//! always means: of the parameters as they are in their scalar.

mod laws;
#[cfg(test)]
mod tests;

use crate::chapter::{SpringMass, augmented, contact, penalty, structure, system};
use crate::claims::{Case, Var, given};
use crate::formula::Hypothesis;
use crate::number::{Exact, PositivePart, Real, ToExact};
use crate::solver::{
    Augmentation, Interval, Iterate, Method, Outcome, Plane, Scalar, Solution, SolveError, State,
    augmentations_needed, series_penetration, solve, solve_bilateral,
};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::iter::successors;
use std::sync::Arc;

/// How one trial of an experiment went.
#[derive(Clone, Debug, PartialEq)]
pub enum Trial {
    /// An error and the bound it must not exceed.
    Within {
        /// The error.
        error: Exact,
        /// Its bound.
        bound: Exact,
    },
    /// Right or wrong.
    Decided(bool),
    /// Nothing can be said: the statement's conditions are not met, or the scalar's range is left.
    Undecided,
}

/// One trial.
pub type Check<T> = Arc<dyn Fn(&Case<T>) -> Trial + Send + Sync>;

/// A claim about what is *computed* in one number system.
pub struct Experiment<T> {
    /// The entry it belongs to.
    pub equation: &'static str,
    /// Its name, unique within the equation.
    pub name: &'static str,
    /// What it supposes.
    pub given: Vec<Hypothesis>,
    /// One trial.
    pub check: Check<T>,
}

fn check<T>(f: impl Fn(&Case<T>) -> Trial + Send + Sync + 'static) -> Check<T> {
    Arc::new(f)
}

macro_rules! list {
    ($($equation:literal $name:literal [$($given:ident)*] $check:expr;)*) => {
        vec![$(Experiment {
            equation: $equation,
            name: $name,
            given: vec![$(given().$given.clone()),*],
            check: check($check),
        }),*]
    };
}

/// As many steps as an experiment follows.
const STEPS: usize = 24;

/// And as many to a fixed point.
const MOST_STEPS: usize = 1000;

/// Claims about floats: those that are proved for every precision, then those that are only tried.
pub fn float_experiments<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    let tried = list! {
        "1.6" "exact-state" [stiffness grazing] |x| state(x, State::of);
        "1.8" "bounds-contain" [stiffness] |x| bounds(x, &Method::Lagrange, solve);
        "1.10" "root" [stiffness penalty quartic] |x| series_root(x, series_penetration);
        "1.13" "bounds-contain" [stiffness penalty]
            |x: &Case<T>| bounds(x, &Method::Penalty { penalty: x.eps.clone() }, solve);
        "1.33" "promise" [stiffness penalty tolerance] |x| promise(x, solve);
        "note 8" "units-of-solutions" [stiffness penalty tolerance] |x| units(x, solve_bilateral);
    };
    laws::laws().into_iter().chain(tried).collect()
}

/// Claims about what is computed without rounding.
pub fn exact_experiments() -> Vec<Experiment<Exact>> {
    list! {
        "1.33" "steps" [stiffness penalty tolerance]
            |x| count(x, Plane::Unilateral, exact_steps(x, &x.lambda, Plane::Unilateral));
        "1.33" "steps-bilateral" [stiffness penalty tolerance]
            |x| count(x, Plane::Bilateral, exact_steps(x, &x.lambda, Plane::Bilateral));
        "1.33" "tie-goes-on" [stiffness penalty tolerance]
            |x| tie(x, exact_steps(x, &start_of_tie(x), Plane::Bilateral));
        "note 4" "closed-form" [stiffness penalty touching]
            |x| unilateral_closed_form(x, exact_steps(x, &x.lambda, Plane::Unilateral));
        "note 4" "release" [stiffness penalty separated]
            |x| release(x, exact_steps(x, &x.lambda, Plane::Unilateral));
    }
}

// What is tried is handed to each experiment, so that tests can hand it something wrong.

/// What solves a system by a method.
trait Solver<T>: Fn(&SpringMass<T>, &Method<T>) -> Result<Solution<T>, SolveError> {}

impl<T, F: Fn(&SpringMass<T>, &Method<T>) -> Result<Solution<T>, SolveError>> Solver<T> for F {}

/// Powers of two for the units of length, of mass and of force. Any would do.
const UNITS: [i32; 3] = [3, -2, 5];

fn power_of_two<T: Scalar>(n: i32) -> T {
    (0..n.abs()).fold(T::one(), |x, _| if n < 0 { x / T::int(2) } else { x * T::int(2) })
}

fn exact<T: ToExact>(x: &T) -> Option<Exact> {
    x.to_exact().ok()
}

/// The state is that of the exact sign of R, next to grazing too.
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
    let end = |y: &T| y.to_exact();
    end(&interval.lower).is_ok_and(|y| y <= *x) && end(&interval.upper).is_ok_and(|y| *x <= y)
}

/// The exact deflection and contact force of a method over a plane that never pulls.
fn answer(system: &SpringMass<Exact>, penalty: Option<&Exact>) -> (Exact, Exact) {
    let touches = system::reaction(system) > Exact::zero();
    match penalty.filter(|_| touches) {
        Some(eps) => (penalty::deflection(system, eps), penalty::force_at_root(system, eps)),
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

/// The bounds of a direct method contain its exact answer, and so does the interval around the result.
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

/// The exact residual of (1.10) changes sign between the root's two neighbours.
fn series_root<T: Scalar + Real + ToExact>(
    x: &Case<T>,
    root: impl Fn(&SpringMass<T>, &T, &[T]) -> Result<T, SolveError>,
) -> Trial {
    let higher = [x.eps4.clone()];
    let (Ok(system), Some(eps), Some(eps4)) =
        (x.system.try_map(|y| y.to_exact()), exact(&x.eps), exact(&x.eps4))
    else {
        return Trial::Undecided;
    };
    let Ok(root) = root(&x.system, &x.eps, &higher) else { return Trial::Undecided };
    let residual =
        |p: T| exact(&p).map(|p| penalty::series_residual(&system, &eps, std::slice::from_ref(&eps4), &p));
    // A zero without a precision has no neighbours.
    if root.is_zero() {
        return residual(root).map_or(Trial::Undecided, |at| Trial::Decided(at.is_zero()));
    }
    match (residual(Real::next_down(root.clone())), residual(Real::next_up(root))) {
        (Some(below), Some(above)) => Trial::Decided(below < Exact::zero() && Exact::zero() < above),
        _ => Trial::Undecided,
    }
}

/// (1.16) with what a case has for it, for [`STEPS`] steps.
fn by_augmentation<T: Clone>(x: &Case<T>) -> Method<T> {
    let (penalty, tolerance, start) = (x.eps.clone(), x.tol.clone(), x.lambda.clone());
    Method::Augmented { penalty, tolerance, max_augmentations: STEPS as u64, start }
}

/// `converged` means that |û − u*| is below the tolerance, exactly; the floor is no less than the error of
/// some step; the bounds contain the limit, whatever the outcome; the plane never pulls.
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
    let error = |u: Exact| (u - &limit).abs();
    let is_met = |floor: Exact| {
        let steps = Augmentation::new(&x.system, &x.eps).with_multiplier(x.lambda.clone()).take(STEPS + 1);
        let mut met = steps.filter_map(|step| exact(&step.deflection));
        met.any(|u| error(u) <= floor)
    };
    let kept = match solution.outcome {
        Outcome::Converged => error(u) < tolerance,
        Outcome::Stagnated => solution.floor.as_ref().and_then(exact).is_some_and(is_met),
        Outcome::OutOfSteps => solution.augmentations == Some(STEPS as u64),
        Outcome::Direct => false,
    };
    let pushes = solution.contact_force >= T::zero();
    Trial::Decided(kept && pushes && contains_answer(&solution, &system, None))
}

/// Other units, if they are powers of two, change no digit.
fn units<T: Scalar + Real + ToExact>(x: &Case<T>, solve: impl Solver<T>) -> Trial {
    let [length, mass, force] = UNITS;
    let scale = |y: &T, n: i32| y.clone() * power_of_two::<T>(n);
    let unit = |var| match var {
        Var::C | Var::Eps => force - length,
        Var::M => mass,
        Var::G => force - mass,
        Var::L | Var::H | Var::Tol => length,
        Var::Lambda => force,
        _ => 0,
    };
    let scaled = x.map(|var, y| scale(y, unit(var)));
    // Subnormal numbers lose digits where they are scaled.
    let comes_back = scaled.map(|var, y| scale(y, -unit(var))) == *x;
    if !laws::in_range(x) || !laws::in_range(&scaled) || !comes_back {
        return Trial::Undecided;
    }
    let solved = |x: &Case<T>| solve(&x.system, &by_augmentation(x));
    match (solved(x), solved(&scaled)) {
        (Ok(before), Ok(after)) => Trial::Decided(
            after.outcome == before.outcome
                && after.augmentations == before.augmentations
                && after.deflection == scale(&before.deflection, length)
                && after.contact_force == scale(&before.contact_force, force)
                && after.multiplier == before.multiplier.map(|y| scale(&y, force)),
        ),
        _ => Trial::Undecided,
    }
}

/// (1.16) in rationals, for no more than [`STEPS`] steps, and for no more digits than right formulas come
/// to: wrong ones can double them from step to step.
///
/// The closed forms of λ_k and u_k are quotients, of degree k + 1 at most in c and ε, and of degree 1 in
/// everything else. So with the digits s of all that is given, numerators and denominators counted, both
/// parts of each fraction are products of 2 (k + 1) s digits at most; two of them are 8 (k + 1) s. What is
/// left over are carries.
fn exact_steps<'a>(
    x: &'a Case<Exact>,
    start: &Exact,
    plane: Plane,
) -> impl Iterator<Item = Iterate<Exact>> + use<'a> {
    let SpringMass { c, m, g, l, h } = &x.system;
    let given: u64 = [c, m, g, l, h, &x.eps, start].into_iter().map(Exact::digits).sum();
    let steps = Augmentation::new(&x.system, &x.eps).with_multiplier(start.clone()).over(plane).take(STEPS);
    steps.take_while(move |step| {
        step.multiplier.digits() + step.deflection.digits() <= 8 * (step.k + 2) * given
    })
}

/// The iteration's count is the one that (1.33) solved for k gives.
fn count(x: &Case<Exact>, plane: Plane, mut steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let k = augmentations_needed(&x.system, &x.eps, &x.tol, &x.lambda, plane);
    let Some(k) = k.ok().and_then(|k| k.to_usize()).filter(|k| *k < STEPS) else { return Trial::Undecided };
    let residual = |step: &Iterate<Exact>| match plane {
        Plane::Unilateral => {
            augmented::natural_residual(&x.system, &x.eps, &step.multiplier, &step.deflection)
        }
        Plane::Bilateral => step.penetration.clone(),
    };
    let found = steps.position(|step| augmented::within_tolerance(&residual(&step), &x.tol));
    Trial::Decided(found == Some(k))
}

/// From here p₂ *is* the tolerance.
fn start_of_tie(x: &Case<Exact>) -> Exact {
    let ratio = augmented::contraction(&x.system, &x.eps);
    let missing = penalty::total_stiffness(&x.system, &x.eps) * &x.tol / (&ratio * &ratio);
    system::reaction(&x.system) - missing
}

/// Where some |p_k| *is* the tolerance, the iteration goes on: its count is k + 1.
fn tie(x: &Case<Exact>, mut steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let found = steps.position(|step| augmented::within_tolerance(&step.penetration, &x.tol));
    Trial::Decided(found == Some(3))
}

/// For R ≥ 0 and any start, λ_k = R + ρ^{k−1} (λ₁ − R) for k ≥ 1.
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

/// For R < 0 the multiplier first vanishes at K, and the mass hangs free from step max(K − 1, 0) on.
fn release(x: &Case<Exact>, steps: impl Iterator<Item = Iterate<Exact>>) -> Trial {
    let steps: Vec<_> = steps.collect();
    if steps.len() < STEPS {
        return Trial::Decided(false);
    }
    let Some(first) = steps.iter().position(|step| step.multiplier.is_zero()) else {
        return Trial::Undecided;
    };
    // K: 1 from below, else the least for which the closed form is no push any more.
    let ratio = augmented::contraction(&x.system, &x.eps);
    let mut decays = successors(Some(Exact::one()), |decay| Some(decay * &ratio)).take(STEPS);
    let pulls = |decay| augmented::multiplier_after(&x.system, &x.lambda, &decay) <= Exact::zero();
    let expected = if x.lambda < Exact::zero() { Some(1) } else { decays.position(pulls) };
    let free = structure::deflection(&x.system);
    let hangs = steps.iter().skip(first.saturating_sub(1)).all(|step| step.deflection == free);
    Trial::Decided(Some(first) == expected && hangs)
}
