//! Every f32 as each parameter of a system: all three methods solve it without a panic, invalid parameters are
//! refused by name, and the bounds contain the exact solution.
//!
//! ```sh
//! F32_STRIDE=1009 cargo test --release --package spring-mass-contact --test all every_f32
//! ```
//! tests every 1009th bit pattern. A stride of 1, which takes hours, tests all; an odd one also varies the last bits.
//!
//! Rationals would take too long for each case. Products of f32s are exact in f64, and a ball of f64s around
//! the exact solution is tiny relative to an interval of f32s, so rationals are needed only if a bound lies
//! within the ball.

use crate::strategies::is_deep;
use half::f16;
use rayon::prelude::*;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use spring_mass_contact::number::{Ball, Exact, Field, Native, Real, ToExact};
use spring_mass_contact::operators;
use spring_mass_contact::solver::{Interval, Method, Outcome, Scalar, Solution, SolveError, State, solve};
use std::cmp::Ordering;
use std::marker::PhantomData;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A format narrower than f64, with the default system of the command.
trait Narrow: Scalar + Real + ToExact + Copy + Send + Sync {
    /// Above the floor of the augmentation.
    const TOLERANCE: f64;
    fn from_pattern(bits: u32) -> Self;
    fn nearest(x: f64) -> Self;
    fn wide(self) -> f64;
}
impl Narrow for f32 {
    const TOLERANCE: f64 = 1e-6;
    fn from_pattern(bits: u32) -> Self {
        f32::from_bits(bits)
    }
    fn nearest(x: f64) -> Self {
        x as f32
    }
    fn wide(self) -> f64 {
        self.into()
    }
}
impl Narrow for Native<f16> {
    const TOLERANCE: f64 = 1.0 / 32.0;
    fn from_pattern(bits: u32) -> Self {
        Native(f16::from_bits(bits as u16))
    }
    fn nearest(x: f64) -> Self {
        Native(f16::from_f64(x))
    }
    fn wide(self) -> f64 {
        self.0.into()
    }
}

const SYSTEM: SpringMass<f64> = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
const PENALTY: f64 = 1000.0;
/// About the number that the default takes; more would cost time without testing bounds.
const MAX_AUGMENTATIONS: u64 = 8;

/// A parameter: its name in errors, whether it must be positive, and its setter.
struct Parameter<T> {
    name: &'static str,
    positive: bool,
    set: fn(&mut SpringMass<T>, &mut T, T),
}

fn parameters<T>() -> [Parameter<T>; 6] {
    [
        Parameter { name: "stiffness", positive: true, set: |system, _, x| system.c = x },
        Parameter { name: "mass", positive: true, set: |system, _, x| system.m = x },
        Parameter { name: "gravity", positive: false, set: |system, _, x| system.g = x },
        Parameter { name: "free length", positive: false, set: |system, _, x| system.l = x },
        Parameter { name: "height", positive: false, set: |system, _, x| system.h = x },
        Parameter { name: "penalty", positive: true, set: |_, eps, x| *eps = x },
    ]
}

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
struct Oracle<'a, T> {
    system: &'a SpringMass<T>,
    /// Penalty of the penalty method; the limit of the augmentation is the solution by Lagrange multiplier.
    eps: Option<T>,
    state: Ordering,
    balls: [Ball<f64>; 3],
}

fn exact<T: ToExact>(x: T) -> Exact {
    x.to_exact().expect("finite")
}

impl<'a, T: Narrow> Oracle<'a, T> {
    fn new(system: &'a SpringMass<T>, eps: Option<T>) -> Self {
        let ball = |x: T| Ball::point(x.wide());
        let balls = system.map(ball);
        let sign = system::reaction(&balls).sign();
        let state = sign.unwrap_or_else(|| system::reaction(&system.map(exact)).cmp(&Exact::from(0)));
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
        let answer = answer(&self.system.map(exact), self.eps.map(exact).as_ref(), self.state);
        exactly(&answer[part])
    }

    fn within(&self, part: usize, Interval { lower, upper }: &Interval<T>) -> bool {
        let certain = |least, most| lower.wide() <= least && most <= upper.wide();
        Real::is_finite(lower)
            && Real::is_finite(upper)
            && self.lies(part, certain, |x| exact(*lower) <= *x && *x <= exact(*upper))
    }

    /// Returns the error in a solution, if any.
    fn wrong(&self, solution: &Solution<T>) -> Option<&'static str> {
        let Solution { deflection, penetration, contact_force, bounds, .. } = solution;
        let state = match solution.state {
            State::Contact => Ordering::Greater,
            State::Grazing => Ordering::Equal,
            State::Separated => Ordering::Less,
        };
        let (u, tolerance) = (*deflection, T::nearest(T::TOLERANCE));
        let near = |least: f64, most: f64| {
            let (u, tolerance) = (u.wide(), tolerance.wide());
            // Each difference is off by less than the distance to the next number.
            f64::next_up(most - u) < tolerance && f64::next_up(u - least) < tolerance
        };
        let nearby = |x: &Exact| {
            let error = x - exact(u);
            error < exact(tolerance) && -error < exact(tolerance)
        };
        if ![deflection, penetration, contact_force].iter().all(|x| Real::is_finite(*x)) {
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

/// A number, and whether T can represent all intermediate results with a margin.
#[derive(Clone, Debug, PartialEq)]
struct Roomy<T>(f64, bool, PhantomData<T>);

fn roomy<T: Narrow>(value: f64, operands: [&Roomy<T>; 2]) -> Roomy<T> {
    // Between the smallest T and a quarter of the largest, so that four values, or one and its error, can
    // be added.
    let range = T::min_subnormal().wide()..=T::infinity().next_down().wide() / 4.0;
    let fits = value == 0.0 || range.contains(&value.abs());
    Roomy(value, fits && operands.iter().all(|operand| operand.1), PhantomData)
}

operators! { [T: Narrow] Roomy<T>;
    Add add |a, b| roomy(a.0 + b.0, [a, b]);
    Sub sub |a, b| roomy(a.0 - b.0, [a, b]);
    Mul mul |a, b| roomy(a.0 * b.0, [a, b]);
    Div div |a, b| roomy(a.0 / b.0, [a, b]);
    - |a| roomy(-a.0, [a, a])
}

impl<T: Narrow> num_traits::Zero for Roomy<T> {
    fn zero() -> Self {
        Roomy(0.0, true, PhantomData)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl<T: Narrow> num_traits::One for Roomy<T> {
    fn one() -> Self {
        Roomy(1.0, true, PhantomData)
    }
}

impl<T: Narrow> Field for Roomy<T> {
    fn int(n: i32) -> Self {
        Roomy(f64::from(n), true, PhantomData)
    }
}

/// Returns `true` if T can represent all results; then no overflow may be reported.
fn has_room<T: Narrow>(system: &SpringMass<T>, eps: T) -> bool {
    let number = |x: T| roomy::<T>(x.wide(), [&Roomy(0.0, true, PhantomData); 2]);
    let (system, eps) = (system.map(number), number(eps));
    let [free, held, penalised] = [
        answer(&system, None, Ordering::Less),
        answer(&system, None, Ordering::Greater),
        answer(&system, Some(&eps), Ordering::Greater),
    ];
    let forces = [&free[0], &held[0], &penalised[0]].map(|u| augmented::contact_force(&system, u));
    [free, held, penalised, forces].iter().flatten().all(|x| x.1)
}

/// Returns the error in a solve, if any.
fn check<T: Narrow>(parameter: &Parameter<T>, x: T, method: &Method<T>) -> Option<String> {
    let (mut system, mut eps) = (SYSTEM.map(T::nearest), T::nearest(PENALTY));
    (parameter.set)(&mut system, &mut eps, x);
    let mut method = *method;
    match &mut method {
        Method::Lagrange => {}
        Method::Penalty { penalty } | Method::Augmented { penalty, .. } => *penalty = eps,
    }
    let valid = Real::is_finite(&x) && (x > T::zero() || !parameter.positive);
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
fn check_pattern<T: Narrow>(parameter: &Parameter<T>, bits: u32) -> Option<String> {
    let x = T::from_pattern(bits);
    let methods = [
        Method::Lagrange,
        Method::Penalty { penalty: T::nearest(PENALTY) },
        Method::Augmented {
            penalty: T::nearest(PENALTY),
            tolerance: T::nearest(T::TOLERANCE),
            max_augmentations: MAX_AUGMENTATIONS,
            start: T::zero(),
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
    for parameter in &parameters::<f32>() {
        let multiples = (0..=u32::MAX / stride).into_par_iter();
        let wrong = multiples.find_map_any(|n| check_pattern(parameter, n * stride));
        assert_eq!(wrong, None, "{}", parameter.name);
    }
}

/// By every method with every parameter.
#[test]
fn every_f16_has_no_violations() {
    for parameter in &parameters::<Native<f16>>() {
        // All values of one parameter, and of the others a sample.
        let stride = if is_deep() || parameter.name == "height" { 1 } else { 127 };
        let multiples = (0..=u32::from(u16::MAX) / stride).into_par_iter();
        let wrong = multiples.find_map_any(|n| check_pattern(parameter, n * stride));
        assert_eq!(wrong, None, "{}", parameter.name);
    }
}

/// Cases that balls do not decide: grazing, R = 1·10 − 4 (3.5 − 1) = 0, and a bound equal to the solution.
#[test]
fn rationals_decide_where_balls_are_inconclusive() {
    let system = SpringMass { c: 4.0_f32, m: 1.0, g: 10.0, l: 1.0, h: 3.5 };
    let oracle = Oracle::new(&system, None);
    assert_eq!(oracle.state, Ordering::Equal);
    assert!(oracle.within(0, &Interval { lower: 2.5, upper: 2.5 }));
    assert!(!oracle.within(0, &Interval { lower: f32::next_up(2.5), upper: 3.0 }));
    assert!(!oracle.within(0, &Interval { lower: 2.0, upper: f32::next_down(2.5) }));
    assert!(!oracle.within(0, &Interval { lower: f32::NEG_INFINITY, upper: 3.0 }));
}
