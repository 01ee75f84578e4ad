//! Experiments on computed floats: bounds and outcomes of the solver, changes of units.
//!
//! The book's page on floating point derives the bounds. Exact results are those for the parameters as
//! represented in their scalar.

mod rounding_claims;
#[cfg(test)]
mod tests;

use crate::chapter::{SpringMass, contact, penalty, system};
use crate::claims::{Case, Var, hypotheses, symbols};
use crate::formula::Hypothesis;
use crate::number::tree::piecewise_ops;
use crate::number::{Exact, PositivePart, Real, ToExact, Tree};
use crate::solver::{Interval, Method, Outcome, Scalar, Solution, SolveError, State, solve, solve_bilateral};
use num_traits::Zero;
use std::cmp::Ordering;
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

/// Returns the experiments: claims proved for every precision, then properties that are only
/// tested.
pub fn experiments<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    let tried = list! {
        "1.6" "exact-state" "The state corresponds to the exact sign of R."
            [stiffness grazing] |x| state(x, State::of);
        "1.8" "bounds-contain" "The bounds contain the exact u, p and N."
            [stiffness] |x| bounds(x, &Method::Lagrange, solve);
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

/// Returns the numbers of a case in rationals.
fn exact_case<T: ToExact>(x: &Case<T>) -> Option<Case<Exact>> {
    Case::try_of(|var| x.get(var).to_exact()).ok()
}

/// Returns the value in rationals of a formula of the parameters and ε; `None` if a divisor is 0.
fn exact_value(x: &Case<Exact>, formula: &Tree) -> Option<Exact> {
    formula.eval(&|name| x.get_by_symbol(name), &piecewise_ops)
}

/// Checks that the state corresponds to the exact sign of R.
fn state<T: Scalar + ToExact>(
    x: &Case<T>,
    of: impl Fn(&SpringMass<T>) -> Result<State, SolveError>,
) -> Trial {
    let (Some(exact), Ok(state)) = (exact_case(x), of(&x.system)) else { return Trial::Undecided };
    let expected =
        exact_value(&exact, &system::reaction(&symbols().system)).map(|r| match r.cmp(&Exact::zero()) {
            Ordering::Greater => State::Contact,
            Ordering::Equal => State::Grazing,
            Ordering::Less => State::Separated,
        });
    Trial::Decided(Some(state) == expected)
}

fn encloses<T: ToExact>(interval: &Interval<T>, x: &Exact) -> bool {
    interval.lower.to_exact().is_ok_and(|lower| lower <= *x)
        && interval.upper.to_exact().is_ok_and(|upper| *x <= upper)
}

/// Returns the exact deflection, penetration and contact force with unilateral contact, by the penalty method or by
/// the Lagrange multiplier; `None` if a divisor is 0.
fn exact_answer(x: &Case<Exact>, by_penalty: bool) -> Option<[Exact; 3]> {
    let Case { system: s, eps, .. } = symbols();
    let touches = exact_value(x, &system::reaction(s))? > Exact::zero();
    let (u, force) = if by_penalty && touches {
        (penalty::deflection(s, eps), penalty::contact_force_at_equilibrium(s, eps))
    } else {
        (contact::deflection(s), contact::contact_force(s))
    };
    let p = contact::penetration(s, &u);
    Some([exact_value(x, &u)?, exact_value(x, &p)?, exact_value(x, &force)?])
}

fn contains_answer<T: Scalar + ToExact>(solution: &Solution<T>, x: &Case<Exact>, by_penalty: bool) -> bool {
    exact_answer(x, by_penalty).is_some_and(|[u, p, force]| {
        encloses(&solution.bounds.deflection, &u)
            && encloses(&solution.bounds.penetration, &p)
            && encloses(&solution.bounds.contact_force, &force)
    })
}

/// Checks that the bounds of a direct method contain its exact solution.
fn bounds<T: Scalar + ToExact>(x: &Case<T>, method: &Method<T>, solve: impl Solver<T>) -> Trial {
    let (Some(exact), Ok(solution)) = (exact_case(x), solve(&x.system, method)) else {
        return Trial::Undecided;
    };
    Trial::Decided(contains_answer(&solution, &exact, matches!(method, Method::Penalty { .. })))
}

/// Returns (1.16) with the numbers of a case, for [`STEPS`] steps.
fn by_augmentation<T: Clone>(x: &Case<T>) -> Method<T> {
    let (penalty, tolerance, start) = (x.eps.clone(), x.tol.clone(), x.lambda.clone());
    Method::Augmented { penalty, tolerance, max_augmentations: STEPS as u64, start }
}

/// Checks that the exact |û − u*| is below the tolerance if the outcome is `converged`, and not above the
/// floor if it is `stagnated`; that the bounds contain the limit; and that N ≥ 0.
fn promise<T: Scalar + Real + ToExact>(x: &Case<T>, solve: impl Solver<T>) -> Trial {
    let (Some(exact_x), Ok(solution)) = (exact_case(x), solve(&x.system, &by_augmentation(x))) else {
        return Trial::Undecided;
    };
    let Some(u) = exact(&solution.deflection) else { return Trial::Undecided };
    let Some(limit) = exact_value(&exact_x, &contact::deflection(&symbols().system)) else {
        return Trial::Decided(false);
    };
    let error = (u - limit).abs();
    let kept = match solution.outcome {
        Outcome::Converged => error < exact_x.tol,
        Outcome::Stagnated => solution.floor.as_ref().and_then(exact).is_some_and(|floor| error <= floor),
        Outcome::IterationLimit => solution.augmentations == Some(STEPS as u64),
        Outcome::Direct => false,
    };
    let pushes = solution.contact_force >= T::zero();
    Trial::Decided(kept && pushes && contains_answer(&solution, &exact_x, false))
}

/// Checks that a change of units by powers of two changes no digit.
fn units<T: Scalar + Real + ToExact>(x: &Case<T>, solve: impl Solver<T>) -> Trial {
    let [length, _, force] = UNITS;
    let scaled = x.map(|var, y| scale(y, unit(UNITS, var)));
    // Subnormal numbers lose digits when they are scaled.
    if scaled.map(|var, y| scale(y, -unit(UNITS, var))) != *x {
        return Trial::Undecided;
    }
    let solved =
        [x, &scaled].map(|x| solve(&x.system, &by_augmentation(x)).ok().filter(|of| ends_in_range(x, of)));
    match solved {
        [Some(before), Some(after)] => Trial::Decided(
            after.outcome == before.outcome
                && after.augmentations == before.augmentations
                && after.deflection == scale(&before.deflection, length)
                && after.contact_force == scale(&before.contact_force, force)
                && after.multiplier == before.multiplier.map(|y| scale(&y, force)),
        ),
        _ => Trial::Undecided,
    }
}

/// Returns `true` if the step after the last one has neither underflow nor overflow. (For R = 0, λ tends to 0.)
fn ends_in_range<T: Scalar + Real + ToExact>(x: &Case<T>, solution: &Solution<T>) -> bool {
    let multiplier = solution.multiplier.clone();
    multiplier.is_none_or(|lambda| rounding_claims::in_range(&Case { lambda, ..x.clone() }))
}

/// Returns the exponent of two of the unit of a quantity, from those of length, mass and force.
pub(super) fn unit([length, mass, force]: [i32; 3], var: Var) -> i32 {
    match var {
        Var::C | Var::Eps => force - length,
        Var::M => mass,
        Var::G => force - mass,
        Var::L | Var::H | Var::U | Var::V | Var::Du | Var::Tol => length,
        Var::Lambda => force,
        _ => 0,
    }
}

fn scale<T: Scalar>(x: &T, n: i32) -> T {
    x.clone() * power_of_two::<T>(n)
}
