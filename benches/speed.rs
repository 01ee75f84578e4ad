//! Speed relative to references timed in the same run.
//!
//! `cargo bench -p benches` times everything and prints the table; `cargo bench -p benches -- mpfr` times the
//! benchmarks with that name.

use benches::{Ratio, table};
use criterion::{Criterion, measurement::WallTime};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, penalty};
use spring_mass_contact::number::{Ball, Exact, Mpfr, ToExact};
use spring_mass_contact::rug::{Assign, Float, ops::SubFrom};
use spring_mass_contact::solver::{Augmentation, Method, Outcome, Plane, State, kth_iterate, solve};
use std::hint::black_box;
use std::time::Duration;

/// The default system of the command.
const SYSTEM: SpringMass<f64> = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
const PENALTY: f64 = 1000.0;

/// Number of systems in one call of a chain, a study or a loop.
const CHAIN: u64 = 1000;
const STUDY: u64 = 1_000_000;
const STEPS: u64 = 100;

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

fn floats(criterion: &mut Criterion<WallTime>) -> Vec<Ratio> {
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
    let balls: Vec<_> = systems.iter().map(|s| s.map(|x| Ball::point(*x))).collect();
    let study: Vec<_> = (0..STUDY).map(|i| SpringMass { h: 1.05 + i as f64 * 1e-9, ..SYSTEM }).collect();
    vec![
        Ratio::of(
            criterion,
            "solve in f64, Lagrange, with state and bounds",
            (chain, CHAIN, chain_of_formulas(by_lagrange)),
            (CHAIN, chain_of_solves(Method::Lagrange)),
            6.0,
        ),
        Ratio::of(
            criterion,
            "solve in f64, penalty, with state and bounds",
            (chain, CHAIN, chain_of_formulas(by_penalty)),
            (CHAIN, chain_of_solves(Method::Penalty { penalty: PENALTY })),
            6.0,
        ),
        Ratio::of(
            criterion,
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
        ),
        Ratio::of(
            criterion,
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
        ),
        Ratio::of(
            criterion,
            "(1.13) of a million systems in memory",
            ("adding up their heights", STUDY, || study.iter().map(|s| s.h).sum::<f64>()),
            (STUDY, || study.iter().map(|s| penalty::deflection(s, &PENALTY)).sum::<f64>()),
            1.0,
        ),
    ]
}

/// (1.16) by hand with rug's floats in place. The `fixed` terms do not depend on λ.
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
        let (system, eps) = (system.map(float), float(eps));
        let zero = || Float::new(eps.prec());
        let (lambda, weight, rest, free, stiffness) = (zero(), zero(), zero(), zero(), zero());
        let (u, p, force) = (zero(), zero(), zero());
        let mut raw = Raw { lambda, weight, rest, free, stiffness, u, p, force, system, eps };
        raw.fix();
        raw
    }

    fn fix(&mut self) {
        let SpringMass { c, m, g, l, h } = &self.system;
        self.weight.assign(m * g);
        self.free.assign(&self.weight / c);
        self.rest.assign(h - l);
        self.rest *= &self.eps;
        self.stiffness.assign(c + &self.eps);
    }

    fn step(&mut self, plane: Plane, hoisted: bool) {
        if !hoisted {
            self.fix();
        }
        let SpringMass { c, l, h, .. } = &self.system;
        self.u.assign(&self.weight - &self.lambda);
        self.u += &self.rest;
        self.u /= &self.stiffness;
        if plane == Plane::Unilateral && self.free < self.u {
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
        if plane == Plane::Unilateral && self.lambda.is_sign_negative() {
            self.lambda.assign(0);
        }
    }
}

/// Returns the default system in `bits` bits with ε = 10 c.
fn in_bits(bits: u32) -> (SpringMass<Mpfr>, Mpfr) {
    let system = SYSTEM.map(|x| x.to_exact().expect("finite").to_mpfr(bits));
    (system, Exact::from(1000).to_mpfr(bits))
}

fn mpfr(criterion: &mut Criterion<WallTime>) -> Vec<Ratio> {
    let mut ratios = Vec::new();
    for (bits, wanted) in [(256, 1.6), (4096, 1.1), (65536, 1.05)] {
        let (system, eps) = in_bits(bits);
        for (plane, hoisted) in [
            (Plane::Unilateral, false),
            (Plane::Bilateral, false),
            (Plane::Unilateral, true),
            (Plane::Bilateral, true),
        ] {
            let mut raw = Raw::new(&system, &eps);
            let (side, reference) = match (plane, hoisted) {
                (Plane::Unilateral, false) => ("unilateral", "MPFR in place"),
                (Plane::Bilateral, false) => ("bilateral", "MPFR in place"),
                (Plane::Unilateral, true) => ("unilateral", "the same, what is fixed computed once"),
                (Plane::Bilateral, true) => ("bilateral", "the same, what is fixed computed once"),
            };
            let which = if hoisted { "fixed part once" } else { "all in each step" };
            let mut steps = Augmentation::new(&system, &eps).over(plane);
            ratios.push(Ratio::of(
                criterion,
                format!("(1.16) {side}, mpfr {bits}, {which}"),
                (reference, STEPS, || (0..STEPS).for_each(|_| raw.step(plane, hoisted))),
                (STEPS, || (0..STEPS).for_each(|_| drop(black_box(steps.step())))),
                wanted,
            ));
        }
    }
    ratios
}

/// About 4000 steps to 1e-1200 with 4096 bits, and the last iterate in closed form.
fn digits(criterion: &mut Criterion<WallTime>) -> Vec<Ratio> {
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
    let by_hand = Ratio::of(
        criterion,
        "solve to 1e-1200, mpfr 4096, a step",
        ("MPFR in place, what is fixed computed once", k, || {
            raw.lambda.assign(0);
            (0..k).for_each(|_| raw.step(Plane::Unilateral, true));
        }),
        (k, converged),
        1.3,
    );
    let closed = Ratio::of(
        criterion,
        "the last iterate by closed form, mpfr 4096",
        ("the loop that leads to it", 1, converged),
        (1, || kth_iterate(&system, &eps, &start, k, Plane::Unilateral).expect("an iterate")),
        0.001,
    );
    vec![by_hand, closed]
}

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    let mut ratios = floats(&mut criterion);
    ratios.extend(mpfr(&mut criterion));
    ratios.extend(digits(&mut criterion));
    criterion.final_summary();
    println!("\n{}", table(&ratios));
}
