//! Test with every f32 as each parameter of a system: all three methods solve it without a panic, invalid
//! parameters are refused by name, and the bounds contain the exact solution.
//!
//! ```sh
//! cargo run --release --example every_f32 -- --stride 1009
//! ```
//! tests every 1009th bit pattern; the default is all 2³². An odd stride also varies the last bits. All patterns
//! take hours; `--from` and `--to` select a part, such as `--from 0 --to 0x0fffffff`.
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
use std::ops::AddAssign;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::time::Instant;

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

/// Number of solves for each outcome.
#[derive(Clone, Debug, Default)]
struct Tally {
    solves: u64,
    refused: u64,
    out_of_range: u64,
    by_rationals: u64,
    violations: u64,
    /// One wrong case.
    example: Option<String>,
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.solves += other.solves;
        self.refused += other.refused;
        self.out_of_range += other.out_of_range;
        self.by_rationals += other.by_rationals;
        self.violations += other.violations;
        self.example = self.example.take().or(other.example);
    }
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
struct Oracle<'a> {
    system: &'a SpringMass<f32>,
    /// Penalty of the penalty method; the limit of the augmentation is the solution by Lagrange multiplier.
    eps: Option<f32>,
    state: Ordering,
    balls: [Ball<f64>; 3],
    by_rationals: bool,
}

fn exact(x: f32) -> Exact {
    x.to_exact().expect("finite")
}

impl<'a> Oracle<'a> {
    fn new(system: &'a SpringMass<f32>, eps: Option<f32>) -> Self {
        let ball = |x: f32| Ball::point(f64::from(x));
        let balls = system.map(|x| ball(*x));
        let (state, by_rationals) = match system::reaction(&balls).sign() {
            Some(state) => (state, false),
            None => (system::reaction(&system.map(|x| exact(*x))).cmp(&Exact::from(0)), true),
        };
        let balls = answer(&balls, eps.map(ball).as_ref(), state);
        Oracle { system, eps, state, balls, by_rationals }
    }

    /// Returns `true` if this part of the solution satisfies a predicate, in f64 or, if that is undecided, in
    /// rationals.
    fn lies(
        &mut self,
        part: usize,
        for_certain: impl Fn(f64, f64) -> bool,
        exactly: impl Fn(&Exact) -> bool,
    ) -> bool {
        let ball = &self.balls[part];
        if for_certain(ball.lower(), ball.upper()) {
            return true;
        }
        self.by_rationals = true;
        let answer = answer(&self.system.map(|x| exact(*x)), self.eps.map(exact).as_ref(), self.state);
        exactly(&answer[part])
    }

    fn within(&mut self, part: usize, Interval { lower, upper }: &Interval<f32>) -> bool {
        let certain = |least, most| f64::from(*lower) <= least && most <= f64::from(*upper);
        lower.is_finite()
            && upper.is_finite()
            && self.lies(part, certain, |x| exact(*lower) <= *x && *x <= exact(*upper))
    }

    /// Returns the error in a solution, if any.
    fn wrong(&mut self, solution: &Solution<f32>) -> Option<&'static str> {
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
fn check(parameter: &Parameter, x: f32, method: &Method<f32>, tally: &mut Tally) -> Option<String> {
    let (mut system, mut eps) = (SYSTEM, PENALTY);
    (parameter.set)(&mut system, &mut eps, x);
    let mut method = *method;
    match &mut method {
        Method::Lagrange => {}
        Method::Penalty { penalty } | Method::Augmented { penalty, .. } => *penalty = eps,
    }
    tally.solves += 1;
    let valid = x.is_finite() && (x > 0.0 || !parameter.positive);
    match solve(&system, &method) {
        Err(SolveError::Invalid { argument, .. }) => {
            tally.refused += 1;
            (valid || argument != parameter.name).then(|| format!("{argument} is refused"))
        }
        _ if !valid => Some("it is not refused".to_string()),
        Err(error) => {
            tally.out_of_range += 1;
            has_room(&system, eps).then(|| format!("{error}"))
        }
        Ok(solution) => {
            let eps = matches!(method, Method::Penalty { .. }).then_some(eps);
            let mut oracle = Oracle::new(&system, eps);
            let wrong = oracle.wrong(&solution);
            tally.by_rationals += u64::from(oracle.by_rationals);
            wrong.map(String::from)
        }
    }
}

/// Tests one bit pattern as a parameter with each method that has it.
fn check_pattern(parameter: &Parameter, bits: u32) -> Tally {
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
    let mut tally = Tally::default();
    for method in methods.iter().skip(usize::from(parameter.name == "penalty")) {
        let checked = catch_unwind(AssertUnwindSafe(|| check(parameter, x, method, &mut tally)));
        if let Some(wrong) = checked.unwrap_or_else(|_| Some("it panics".to_string())) {
            tally.violations += 1;
            tally.example.get_or_insert_with(|| {
                format!("{} = {x:?} (bits {bits:#010x}), {method:?}: {wrong}", parameter.name)
            });
        }
    }
    tally
}

/// The multiples of `stride` between two bit patterns, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Patterns {
    from: u32,
    to: u32,
    stride: u32,
}

impl Patterns {
    /// Parses the arguments of the command line.
    fn parse(arguments: &[String]) -> Result<Self, String> {
        let mut patterns = Patterns { from: 0, to: u32::MAX, stride: 1 };
        for argument in arguments.chunks(2) {
            let option = &argument[0];
            let (value, least) = match option.as_str() {
                "--stride" => (&mut patterns.stride, 1),
                "--from" => (&mut patterns.from, 0),
                "--to" => (&mut patterns.to, 0),
                _ => {
                    return Err(format!(
                        "unknown argument '{option}': the options are --stride, --from and --to"
                    ));
                }
            };
            let [_, number] = argument else { return Err(format!("'{option}' needs a value")) };
            let parsed = match number.strip_prefix("0x") {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => number.parse(),
            };
            *value = parsed.ok().filter(|n| *n >= least).ok_or_else(|| {
                format!(
                    "invalid value '{number}' for '{option}': must be an integer from {least} to {}",
                    u32::MAX
                )
            })?;
        }
        match patterns {
            Patterns { from, to, .. } if from > to => {
                Err(format!("invalid value '{to:#010x}' for '--to': must be at least '--from', {from:#010x}"))
            }
            patterns => Ok(patterns),
        }
    }

    /// Tests the patterns as this parameter.
    fn check(self, parameter: &Parameter) -> Tally {
        let sum = |mut a: Tally, b| {
            a += b;
            a
        };
        let multiples = (self.from.div_ceil(self.stride)..=self.to / self.stride).into_par_iter();
        multiples.map(|n| check_pattern(parameter, n * self.stride)).reduce(Tally::default, sum)
    }
}

fn main() -> ExitCode {
    let arguments: Vec<_> =
        std::env::args_os().skip(1).map(|text| text.to_string_lossy().into_owned()).collect();
    let patterns = match Patterns::parse(&arguments) {
        Ok(patterns) => patterns,
        Err(line) => {
            eprintln!("error: {line}");
            return ExitCode::from(2);
        }
    };
    println!(
        "parameter         solves      refused  out of range  by rationals  violations  seconds  solves/s"
    );
    let (start, mut all) = (Instant::now(), Tally::default());
    let row = |name: &str, tally: &Tally, start: Instant| {
        let Tally { solves, refused, out_of_range, by_rationals, violations, .. } = tally;
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{name:11} {solves:12} {refused:12} {out_of_range:13} {by_rationals:13} {violations:11} {seconds:8.1} {:9.2e}",
            *solves as f64 / seconds
        );
    };
    for parameter in &PARAMETERS {
        let start = Instant::now();
        let tally = patterns.check(parameter);
        row(parameter.name, &tally, start);
        if let Some(example) = &tally.example {
            println!("  {example}");
        }
        all += tally;
    }
    row("all", &all, start);
    ExitCode::from(u8::from(all.violations > 0))
}

#[test]
fn a_sample_of_patterns_has_no_violations() {
    for parameter in &PARAMETERS {
        // A prime, so that the last bits vary with the first.
        let all = Patterns { from: 0, to: u32::MAX, stride: 4_000_037 };
        let tally = all.check(parameter);
        assert_eq!((tally.violations, &tally.example), (0, &None));
        assert!(tally.refused > 0, "{}", parameter.name);

        // Parts are disjoint and contain all patterns; the first ends at a pattern that is tested.
        let middle = 500 * all.stride;
        let parts = [Patterns { to: middle, ..all }, Patterns { from: middle + 1, ..all }];
        let [first, second] = parts.map(|part| part.check(parameter));
        let count = |tally: &Tally| (tally.solves, tally.refused);
        assert_eq!((first.solves + second.solves, first.refused + second.refused), count(&tally));
        assert_eq!(first.solves, 501 * tally.solves / (u64::from(u32::MAX / all.stride) + 1));
    }
}

#[test]
fn arguments_are_parsed_or_refused_by_name() {
    let parse = |line: &str| Patterns::parse(&line.split_whitespace().map(String::from).collect::<Vec<_>>());
    assert_eq!(parse(""), Ok(Patterns { from: 0, to: u32::MAX, stride: 1 }));
    let part = Patterns { from: 7, to: 1 << 28, stride: 3 };
    assert_eq!(parse("--from 7 --stride 3 --to 0x10000000"), Ok(part));
    for (line, message) in [
        ("--to 1e9", "invalid value '1e9' for '--to': must be an integer from 0 to 4294967295"),
        ("--stride 0", "invalid value '0' for '--stride': must be an integer from 1 to 4294967295"),
        ("--from 9 --to 8", "invalid value '0x00000008' for '--to': must be at least '--from', 0x00000009"),
        ("--from", "'--from' needs a value"),
        ("1009", "unknown argument '1009': the options are --stride, --from and --to"),
    ] {
        assert_eq!(parse(line), Err(message.to_string()));
    }
}

/// Cases that balls do not decide: grazing, R = 1·10 − 4 (3.5 − 1) = 0, and a bound equal to the solution.
#[test]
fn rationals_decide_where_balls_are_inconclusive() {
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.5 };
    let mut oracle = Oracle::new(&system, None);
    assert_eq!((oracle.state, oracle.by_rationals), (Ordering::Equal, true));
    oracle.by_rationals = false;
    assert!(oracle.within(0, &Interval { lower: 2.5, upper: 2.5 }) && oracle.by_rationals);
    assert!(!oracle.within(0, &Interval { lower: 2.5_f32.next_up(), upper: 3.0 }));
    assert!(!oracle.within(0, &Interval { lower: 2.0, upper: 2.5_f32.next_down() }));
    assert!(!oracle.within(0, &Interval { lower: f32::NEG_INFINITY, upper: 3.0 }));
}
