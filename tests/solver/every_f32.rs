//! Every f32 as each parameter of a system: all three methods solve it without a panic, invalid parameters are
//! refused by name, and the bounds contain the exact solution.
//!
//! ```sh
//! F32_STRIDE=1009 cargo test --release --test all every_f32
//! ```
//! tests every 1009th bit pattern. A stride of 1, which takes hours, tests all; an odd one also varies the last bits.
//!
//! Rationals would take too long for each case. Products of f32s are exact in f64, and a ball of f64s around
//! the exact solution is tiny relative to an interval of f32s, so rationals are needed only if a bound lies
//! within the ball.

use rayon::prelude::*;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use spring_mass_contact::number::{Ball, Exact, Field, ToExact};
use spring_mass_contact::operators;
use spring_mass_contact::solver::{Interval, Method, Outcome, Solution, SolveError, State, solve};
use std::cmp::Ordering;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Default system of the command.
const SYSTEM: SpringMass<f32> = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
const PENALTY: f32 = 1000.0;
const TOLERANCE: f32 = 1e-6;
/// About the number that the default takes; more would cost time without testing bounds.
const MAX_AUGMENTATIONS: u64 = 8;

/// A parameter: its name in errors, whether it must be positive, and its setter.
struct Parameter {
    name: &'static str,
    positive: bool,
    set: fn(&mut SpringMass<f32>, &mut f32, f32),
}

const PARAMETERS: [Parameter; 6] = [
    Parameter { name: "stiffness", positive: true, set: |system, _, x| system.c = x },
    Parameter { name: "mass", positive: true, set: |system, _, x| system.m = x },
    Parameter { name: "gravity", positive: false, set: |system, _, x| system.g = x },
    Parameter { name: "free length", positive: false, set: |system, _, x| system.l = x },
    Parameter { name: "height", positive: false, set: |system, _, x| system.h = x },
    Parameter { name: "penalty", positive: true, set: |_, eps, x| *eps = x },
];

/// Returns the exact deflection, penetration and contact force.
fn answer<T: Field>(system: &SpringMass<T>, eps: Option<&T>, state: Ordering) -> [T; 3] {
    match eps {
        _ if state == Ordering::Less => {
            let u = structure::deflection(system);
            let p = contact::penetration(system, &u);
            [u, p, T::zero()]
        }
        None => [lagrange::deflection(system), T::zero(), lagrange::multiplier(system)],
        Some(eps) => [
            penalty::deflection(system, eps),
            penalty::penetration(system, eps),
            penalty::contact_force_at_equilibrium(system, eps),
        ],
    }
}

/// A case, in balls of f64, and in rationals if these do not decide.
struct Oracle<'a> {
    system: &'a SpringMass<f32>,
    /// Penalty of the penalty method; the limit of the augmentation is the solution by Lagrange multiplier.
    eps: Option<f32>,
    state: Ordering,
    balls: [Ball<f64>; 3],
}

fn exact(x: f32) -> Exact {
    x.to_exact().expect("finite")
}

impl<'a> Oracle<'a> {
    fn new(system: &'a SpringMass<f32>, eps: Option<f32>) -> Self {
        let ball = |x: f32| Ball::point(f64::from(x));
        let balls = system.map(|x| ball(*x));
        let sign = system::reaction(&balls).sign();
        let state = sign.unwrap_or_else(|| system::reaction(&system.map(|x| exact(*x))).cmp(&Exact::from(0)));
        let balls = answer(&balls, eps.map(ball).as_ref(), state);
        Oracle { system, eps, state, balls }
    }

    /// Returns `true` if this part of the solution satisfies a predicate, in f64 or, if that is undecided, in
    /// rationals.
    fn lies(
        &self,
        part: usize,
        for_certain: impl Fn(f64, f64) -> bool,
        exactly: impl Fn(&Exact) -> bool,
    ) -> bool {
        let ball = &self.balls[part];
        if for_certain(ball.lower(), ball.upper()) {
            return true;
        }
        let answer = answer(&self.system.map(|x| exact(*x)), self.eps.map(exact).as_ref(), self.state);
        exactly(&answer[part])
    }

    fn within(&self, part: usize, Interval { lower, upper }: &Interval<f32>) -> bool {
        let certain = |least, most| f64::from(*lower) <= least && most <= f64::from(*upper);
        lower.is_finite()
            && upper.is_finite()
            && self.lies(part, certain, |x| exact(*lower) <= *x && *x <= exact(*upper))
    }

    /// Returns the error in a solution, if any.
    fn wrong(&self, solution: &Solution<f32>) -> Option<&'static str> {
        let Solution { deflection, penetration, contact_force, bounds, .. } = solution;
        let state = match solution.state {
            State::Contact => Ordering::Greater,
            State::Grazing => Ordering::Equal,
            State::Separated => Ordering::Less,
        };
        let (u, tolerance) = (*deflection, TOLERANCE);
        let near = |least: f64, most: f64| {
            let (u, tolerance) = (f64::from(u), f64::from(tolerance));
            // Each difference is off by less than the distance to the next number.
            (most - u).next_up() < tolerance && (u - least).next_up() < tolerance
        };
        let nearby = |x: &Exact| {
            let error = x - exact(u);
            error < exact(tolerance) && -error < exact(tolerance)
        };
        if ![deflection, penetration, contact_force].iter().all(|x| x.is_finite()) {
            Some("a result is not finite")
        } else if state != self.state {
            Some("the state is wrong")
        } else if !self.within(0, &bounds.deflection) {
            Some("the deflection is out of its bounds")
        } else if !self.within(1, &bounds.penetration) {
            Some("the penetration is out of its bounds")
        } else if !self.within(2, &bounds.contact_force) {
            Some("the contact force is out of its bounds")
        } else if solution.outcome == Outcome::Converged && !self.lies(0, near, nearby) {
            Some("it did not converge")
        } else {
            None
        }
    }
}

/// A number, and whether f32 can represent all intermediate results with a margin.
#[derive(Clone, Debug, PartialEq)]
struct Roomy(f64, bool);

fn roomy(value: f64, operands: [&Roomy; 2]) -> Roomy {
    // Between the smallest f32 and a quarter of the largest, so that four values, or one and its error, can
    // be added.
    let fits =
        value == 0.0 || (f64::from(f32::from_bits(1))..=f64::from(f32::MAX) / 4.0).contains(&value.abs());
    Roomy(value, fits && operands.iter().all(|operand| operand.1))
}

operators! { [] Roomy;
    Add add |a, b| roomy(a.0 + b.0, [a, b]);
    Sub sub |a, b| roomy(a.0 - b.0, [a, b]);
    Mul mul |a, b| roomy(a.0 * b.0, [a, b]);
    Div div |a, b| roomy(a.0 / b.0, [a, b]);
    - |a| roomy(-a.0, [a, a])
}

impl num_traits::Zero for Roomy {
    fn zero() -> Self {
        Roomy(0.0, true)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl num_traits::One for Roomy {
    fn one() -> Self {
        Roomy(1.0, true)
    }
}

impl Field for Roomy {
    fn int(n: i32) -> Self {
        Roomy(f64::from(n), true)
    }
}

/// Returns `true` if f32 can represent all results; then no overflow may be reported.
fn has_room(system: &SpringMass<f32>, eps: f32) -> bool {
    let number = |x: f32| roomy(f64::from(x), [&Roomy(0.0, true); 2]);
    let (system, eps) = (system.map(|x| number(*x)), number(eps));
    let [free, held, penalised] = [
        answer(&system, None, Ordering::Less),
        answer(&system, None, Ordering::Greater),
        answer(&system, Some(&eps), Ordering::Greater),
    ];
    let forces = [&free[0], &held[0], &penalised[0]].map(|u| augmented::contact_force(&system, u));
    [free, held, penalised, forces].iter().flatten().all(|x| x.1)
}

/// Returns the error in a solve, if any.
fn check(parameter: &Parameter, x: f32, method: &Method<f32>) -> Option<String> {
    let (mut system, mut eps) = (SYSTEM, PENALTY);
    (parameter.set)(&mut system, &mut eps, x);
    let mut method = *method;
    match &mut method {
        Method::Lagrange => {}
        Method::Penalty { penalty } | Method::Augmented { penalty, .. } => *penalty = eps,
    }
    let valid = x.is_finite() && (x > 0.0 || !parameter.positive);
    match solve(&system, &method) {
        Err(SolveError::Invalid { argument, .. }) => {
            (valid || argument != parameter.name).then(|| format!("{argument} is refused"))
        }
        _ if !valid => Some("it is not refused".to_string()),
        Err(error) => has_room(&system, eps).then(|| format!("{error}")),
        Ok(solution) => {
            let eps = matches!(method, Method::Penalty { .. }).then_some(eps);
            Oracle::new(&system, eps).wrong(&solution).map(String::from)
        }
    }
}

/// Returns the error with one bit pattern as a parameter, for each method that has it, if any.
fn check_pattern(parameter: &Parameter, bits: u32) -> Option<String> {
    let x = f32::from_bits(bits);
    let methods = [
        Method::Lagrange,
        Method::Penalty { penalty: PENALTY },
        Method::Augmented {
            penalty: PENALTY,
            tolerance: TOLERANCE,
            max_augmentations: MAX_AUGMENTATIONS,
            start: 0.0,
        },
    ];
    let methods = &methods[usize::from(parameter.name == "penalty")..];
    methods.iter().find_map(|method| {
        let checked = catch_unwind(AssertUnwindSafe(|| check(parameter, x, method)));
        let wrong = checked.unwrap_or_else(|_| Some("it panics".to_string()))?;
        Some(format!("{} = {x:?} (bits {bits:#010x}), {method:?}: {wrong}", parameter.name))
    })
}

/// The default is a prime, so that the last bits vary with the first.
#[test]
fn every_f32_has_no_violations() {
    let stride = std::env::var("F32_STRIDE").map_or(1_000_003, |text| text.parse().expect("an integer"));
    for parameter in &PARAMETERS {
        let multiples = (0..=u32::MAX / stride).into_par_iter();
        let wrong = multiples.find_map_any(|n| check_pattern(parameter, n * stride));
        assert_eq!(wrong, None, "{}", parameter.name);
    }
}

/// Cases that balls do not decide: grazing, R = 1·10 − 4 (3.5 − 1) = 0, and a bound equal to the solution.
#[test]
fn rationals_decide_where_balls_are_inconclusive() {
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.5 };
    let oracle = Oracle::new(&system, None);
    assert_eq!(oracle.state, Ordering::Equal);
    assert!(oracle.within(0, &Interval { lower: 2.5, upper: 2.5 }));
    assert!(!oracle.within(0, &Interval { lower: 2.5_f32.next_up(), upper: 3.0 }));
    assert!(!oracle.within(0, &Interval { lower: 2.0, upper: 2.5_f32.next_down() }));
    assert!(!oracle.within(0, &Interval { lower: f32::NEG_INFINITY, upper: 3.0 }));
}
