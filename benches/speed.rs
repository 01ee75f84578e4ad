//! Speed relative to references timed in the same run: `cargo bench --bench speed` prints the table.

use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, penalty};
use spring_mass_contact::number::{Ball, Exact, Mpfr, ToExact};
use spring_mass_contact::rug::{Assign, Float, ops::SubFrom};
use spring_mass_contact::solver::{Augmentation, Method, Outcome, Plane, State, kth_iterate, solve};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Number and duration of the alternating turns; the speed of a machine drifts over seconds.
const TURNS: usize = 100;
const TURN: Duration = Duration::from_millis(5);

/// Prints a row of the table: the least times of a reference and of our computation, of each of which a call
/// performs a number of operations. A ratio that misses its target is bold.
fn compare<A, B>(
    name: &str,
    (reference, many, mut raw): (&str, u64, impl FnMut() -> A),
    (own_many, mut own): (u64, impl FnMut() -> B),
    wanted: f64,
) {
    let mut least = [f64::INFINITY; 2];
    for _ in 0..TURNS {
        least[0] = least[0].min(turn(&mut raw) / many as f64);
        least[1] = least[1].min(turn(&mut own) / own_many as f64);
    }
    let ratio = least[1] / least[0];
    let mark = if ratio > wanted { "**" } else { "" };
    let [raw, own] = least.map(duration);
    println!("| {name} | {reference} | {raw} | {own} | {mark}{}{mark} | {wanted} |", digits(ratio));
}

/// Returns the nanoseconds of a call, averaged over one turn.
fn turn<A>(call: &mut impl FnMut() -> A) -> f64 {
    let (start, mut calls) = (Instant::now(), 0);
    while start.elapsed() < TURN || calls == 0 {
        black_box(call());
        calls += 1;
    }
    start.elapsed().as_nanos() as f64 / f64::from(calls)
}

/// Formats nanoseconds in a suitable unit.
fn duration(ns: f64) -> String {
    let units = [(1.0, "ns"), (1e3, "µs"), (1e6, "ms"), (1e9, "s")];
    let (unit, name) = units.into_iter().rev().find(|(unit, _)| ns >= *unit).unwrap_or(units[0]);
    format!("{} {name}", digits(ns / unit))
}

/// Formats two or three digits.
fn digits(x: f64) -> String {
    if x >= 100.0 {
        format!("{x:.0}")
    } else if x >= 0.1 {
        format!("{x:.2}")
    } else {
        format!("{x:.1e}")
    }
}

/// The default system of the command.
const SYSTEM: SpringMass<f64> = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
const PENALTY: f64 = 1000.0;

/// Number of systems in one call of a chain, a study or a loop.
const CHAIN: u64 = 1000;
const STUDY: u64 = 1_000_000;
const STEPS: u64 = 100;

/// Reference of the augmentation.
const IN_PLACE: &str = "MPFR in place, what is fixed computed once";

/// Returns the same system for the next step of a chain, which depends on the results of the previous one.
fn next(system: SpringMass<f64>, results: [f64; 3]) -> SpringMass<f64> {
    SpringMass { h: system.h + results.iter().sum::<f64>() * 0.0, ..system }
}

/// Evaluates the formulas of a method in a chain.
fn chain_of_formulas(formulas: impl Fn(&SpringMass<f64>) -> [f64; 3]) -> impl FnMut() -> f64 {
    move || {
        let mut system = black_box(SYSTEM);
        (0..CHAIN).for_each(|_| system = next(system, formulas(&system)));
        system.h
    }
}

fn chain_of_solves(method: Method<f64>) -> impl FnMut() -> f64 {
    move || {
        let mut system = black_box(SYSTEM);
        for _ in 0..CHAIN {
            let solution = solve(&system, black_box(&method)).expect("a system that can be solved");
            black_box(&solution);
            system = next(system, [solution.deflection, solution.contact_force, solution.penetration]);
        }
        system.h
    }
}

fn floats() {
    let by_lagrange = |s: &SpringMass<f64>| {
        let u = lagrange::deflection(s);
        [u, contact::contact_force(s), contact::penetration(s, &u)]
    };
    let by_penalty = |s: &SpringMass<f64>| {
        let u = penalty::deflection(s, &PENALTY);
        [u, augmented::contact_force(s, &u), contact::penetration(s, &u)]
    };
    let chain = "its formulas, each waiting for the one before";
    let systems: Vec<_> = (0..CHAIN).map(|i| SpringMass { h: 1.05 + i as f64 * 1e-5, ..SYSTEM }).collect();
    let balls: Vec<_> = systems.iter().map(|s| s.map(Ball::point)).collect();
    let study: Vec<_> = (0..STUDY).map(|i| SpringMass { h: 1.05 + i as f64 * 1e-9, ..SYSTEM }).collect();
    compare(
        "solve in f64, Lagrange, with state and bounds",
        (chain, CHAIN, chain_of_formulas(by_lagrange)),
        (CHAIN, chain_of_solves(Method::Lagrange)),
        6.0,
    );
    compare(
        "solve in f64, penalty, with state and bounds",
        (chain, CHAIN, chain_of_formulas(by_penalty)),
        (CHAIN, chain_of_solves(Method::Penalty { penalty: PENALTY })),
        6.0,
    );
    compare(
        "state of a system in f64",
        ("Lagrange's formulas in a chain", CHAIN, chain_of_formulas(by_lagrange)),
        (CHAIN, || {
            let mut system = black_box(SYSTEM);
            for _ in 0..CHAIN {
                let touches = if State::of(&system) == Ok(State::Contact) { 1.0 } else { 0.0 };
                system = next(system, [touches; 3]);
            }
            system.h
        }),
        6.0,
    );
    compare(
        "balls of f64, (1.13)",
        ("f64", CHAIN, || {
            for system in black_box(&systems) {
                black_box(penalty::deflection(system, black_box(&PENALTY)));
            }
        }),
        (CHAIN, || {
            let eps = Ball::point(PENALTY);
            for system in black_box(&balls) {
                black_box(penalty::deflection(system, black_box(&eps)));
            }
        }),
        8.0,
    );
    compare(
        "(1.13) of a million systems in memory",
        ("adding up their heights", STUDY, || study.iter().map(|s| s.h).sum::<f64>()),
        (STUDY, || study.iter().map(|s| penalty::deflection(s, &PENALTY)).sum::<f64>()),
        1.0,
    );
}

/// (1.16) by hand with rug's floats in place; what does not depend on λ is computed once.
struct Raw {
    system: SpringMass<Float>,
    eps: Float,
    lambda: Float,
    weight: Float,
    rest: Float,
    free: Float,
    stiffness: Float,
    u: Float,
    p: Float,
    force: Float,
}

impl Raw {
    fn new(system: &SpringMass<Mpfr>, eps: &Mpfr) -> Self {
        let float = |x: &Mpfr| x.as_float().expect("a rounded number").clone();
        let (system, eps) = (system.as_ref().map(float), float(eps));
        let SpringMass { c, m, g, l, h } = &system;
        let bits = eps.prec();
        let weight = Float::with_val(bits, m * g);
        let free = Float::with_val(bits, &weight / c);
        let rest = Float::with_val(bits, h - l) * &eps;
        let stiffness = Float::with_val(bits, c + &eps);
        let zero = Float::new(bits);
        let [lambda, u, p, force] = [zero.clone(), zero.clone(), zero.clone(), zero];
        Raw { lambda, weight, rest, free, stiffness, u, p, force, system, eps }
    }

    fn step(&mut self) {
        let SpringMass { c, l, h, .. } = &self.system;
        self.u.assign(&self.weight - &self.lambda);
        self.u += &self.rest;
        self.u /= &self.stiffness;
        if self.free < self.u {
            self.u.assign(&self.free);
        }
        self.force.assign(c * &self.u);
        self.force.sub_from(&self.weight);
        self.p.assign(l + &self.u);
        self.p -= h;
        let (p, eps) = (&self.p, &self.eps);
        // One product as in the formula, and a sum.
        self.u.assign(p * eps);
        self.lambda += &self.u;
        if self.lambda.is_sign_negative() {
            self.lambda.assign(0);
        }
    }
}

/// Returns the default system in `bits` bits with ε = 10 c.
fn in_bits(bits: u32) -> (SpringMass<Mpfr>, Mpfr) {
    let system = SYSTEM.map(|x| x.to_exact().expect("finite").to_mpfr(bits));
    (system, Exact::from(1000).to_mpfr(bits))
}

fn mpfr() {
    for (bits, wanted) in [(256, 1.6), (4096, 1.1), (65536, 1.05)] {
        let (system, eps) = in_bits(bits);
        let mut raw = Raw::new(&system, &eps);
        let mut steps = Augmentation::new(&system, &eps);
        compare(
            &format!("(1.16) unilateral, mpfr {bits}"),
            (IN_PLACE, STEPS, || (0..STEPS).for_each(|_| raw.step())),
            (STEPS, || (0..STEPS).for_each(|_| drop(black_box(steps.step())))),
            wanted,
        );
    }
}

/// About 4000 steps to 1e-1200 with 4096 bits, and the last iterate in closed form.
fn accurate() {
    let bits = 4096;
    let (system, _) = in_bits(bits);
    // ρ = 1/2
    let eps = Exact::from(100).to_mpfr(bits);
    let tolerance = "1e-1200".parse::<Exact>().expect("a number").to_mpfr(bits);
    let start = Exact::from(0).to_mpfr(bits);
    let method = Method::Augmented {
        penalty: eps.clone(),
        tolerance,
        max_augmentations: 10_000,
        start: start.clone(),
    };
    let converged = || {
        let solution = solve(&system, &method).expect("a system that can be solved");
        assert_eq!(solution.outcome, Outcome::Converged);
        solution.augmentations.expect("an iteration")
    };
    let k = converged();
    let mut raw = Raw::new(&system, &eps);
    compare(
        "solve to 1e-1200, mpfr 4096, a step",
        (IN_PLACE, k, || {
            raw.lambda.assign(0);
            (0..k).for_each(|_| raw.step());
        }),
        (k, converged),
        1.3,
    );
    compare(
        "the last iterate by closed form, mpfr 4096",
        ("the loop that leads to it", 1, converged),
        (1, || kth_iterate(&system, &eps, &start, k, Plane::Unilateral).expect("an iterate")),
        0.001,
    );
}

fn main() {
    println!("| work | against | reference | own | ratio | wanted |\n|---|---|--:|--:|--:|--:|");
    floats();
    mpfr();
    accurate();
}
