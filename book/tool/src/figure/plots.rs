//! Plots of functions of one variable.

use super::Figure;
use super::axes::{Axis, Plot};
use super::plane::{P, deflection, example, float, point};
use super::svg::number;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, ode, penalty, structure};
use spring_mass_contact::number::{Exact, NumberSystem, PositivePart, ToExact};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{self, Scalar};

/// Draws an energy of the example with its minimum, which is at the deflection `u`.
fn curve(plot: &mut Plot, class: &str, name: &str, u: Exact, energy: impl Fn(&Exact) -> Exact) {
    let system = example(10);
    plot.graph(class, 60, |p| float(&energy(&deflection(&system, p))));
    let at = point(&system, &u, &energy(&u));
    plot.mark(class, at, &format!("{name}: p = {}, {} J", number(at.0), number(at.1)));
}

/// Draws the functionals of the methods and their minima.
pub fn energies() -> Figure {
    let (system, eps) = (example(10), Exact::from(4));
    let (multiplier, guess) = (lagrange::multiplier(&system), Exact::from(1));
    let mut plot = Plot::new(
        Axis::linear(P, -0.2, 0.6, 0.2),
        Axis::linear("energy in joules", -12.6, -11.4, 0.2),
        310.0,
    );
    let s = &system;
    curve(&mut plot, "spring", "Π", structure::deflection(s), |u| structure::potential_energy(s, u));
    curve(&mut plot, "penalty dashed", "Πp", penalty::deflection(s, &eps), |u| penalty::energy(s, &eps, u));
    curve(&mut plot, "plane", "ℒ", lagrange::deflection(s), |u| lagrange::functional(s, u, &multiplier));
    curve(&mut plot, "iterate dotted", "L", augmented::deflection(s, &eps, &guess), |u| {
        augmented::functional(s, &eps, &guess, u)
    });
    plot.text("spring", (0.5, -12.5), (0.0, -10.0), "Π");
    plot.text("penalty", (0.42, -12.12), (4.0, 14.0), "Π_p");
    plot.text("plane", (0.3, -11.82), (-6.0, -6.0), "ℒ");
    plot.text("iterate", (0.42, -11.8), (1.0, 14.0), "L");
    let caption = "The functional of each method, for the example with $\\varepsilon = 4$: the energy $\\Pi$ alone, with the penalty, with \
                   the multiplier $\\lambda = R$, and with both at $\\lambda = 1$. They agree at $p = 0$.";
    let description = "Four parabolas over the penetration p, with the same value at p = 0. Their minima:";
    plot.figure("The energies and their minima", caption, description)
}

/// Returns a plot of a decreasing quantity against the number of augmentations.
fn decay(steps: f64, every: f64, quantity: Axis) -> Plot {
    Plot::new(Axis::linear("k, augmentations", 0.0, steps, every), quantity, 296.0)
}

/// Draws the penetrations between the solutions of two differential equations.
pub fn rates() -> Figure {
    let (system, eps) = (SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 }, 4.0);
    let start = augmented::deflection(&system, &eps, &0.0);
    let first = contact::penetration(&system, &start);
    // The rate −ε/c is −ε/(c + ε) for a spring that is softer by ε.
    let softer = SpringMass { c: system.c - eps, ..system };
    let above = |k: f64| contact::penetration(&system, &ode::solution(&system, &eps, &start, &k));
    let below = |k: f64| ode::homogeneous(&softer, &eps, &first, &k);
    let mut plot = decay(6.0, 1.0, Axis::powers("penetration in metres", -4, 0, 1));
    plot.graph("", 1, above);
    plot.graph("dashed", 1, below);
    let mut lambda = 0.0;
    let points = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|k| {
        let u = augmented::deflection(&system, &eps, &lambda);
        lambda = augmented::update(&system, &eps, &lambda, &u);
        (k, contact::penetration(&system, &u))
    });
    plot.line("iterate fine dotted", points);
    for (k, p) in points {
        plot.mark("iterate", (k, p), &format!("k = {k}: p = {p}"));
    }
    plot.text("", (3.0, above(3.0)), (4.0, -10.0), "p_0 e^{−k ε/(c + ε)}");
    plot.text("", (3.0, below(3.0)), (-10.0, 12.0), "p_0 e^{−k ε/c}");
    plot.text("iterate", points[6], (-2.0, -12.0), "p_k");
    let caption = "The iterates $p_k$ (dots) lie between their two bounds. The upper one, drawn solid, is the solution of the \
                   differential equation, which decays more slowly. Here $\\varepsilon = c$.";
    let description = format!(
        "Penetrations on a logarithmic axis against the number k of augmentations, for the example with ε = c = 4. The \
         iterates and their two bounds start at the same point and fall along straight lines; at k = 6 the solution of \
         the differential equation is {:.4} and the lower bound {:.5}. Iterates:",
        above(6.0),
        below(6.0),
    );
    plot.figure("Iterates between two bounds", caption, &description)
}

/// Returns the default system of the command.
fn default() -> SpringMass<Exact> {
    SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().expect("decimals")
}

/// Returns the relative errors of u, of m g − c u and of ε p against ε. An error of 0 cannot be shown on a logarithmic
/// axis.
fn errors<T: Scalar + ToExact>(penalties: &[Exact], round: impl Fn(&Exact) -> T) -> [Vec<(f64, f64)>; 3] {
    let system = default().as_ref().map(&round);
    let exact = |x: &T| x.to_exact().expect("a finite number");
    let right = contact::deflection(&system.as_ref().map(exact));
    let mut curves = [const { Vec::new() }; 3];
    for row in solver::sweep(&system, penalties.iter().map(&round)).map_while(Result::ok) {
        let deflection = ((exact(&row.deflection) - &right) / &right).abs();
        let errors = [Some(deflection), row.force_error, row.penalty_force_error];
        for (curve, error) in curves.iter_mut().zip(errors) {
            let error = error.filter(|error| *error > Exact::from(0));
            curve.extend(error.map(|error| (float(&exact(&row.penalty)), float(&error))));
        }
    }
    curves
}

/// Draws the errors of the penalty method in three precisions, with the best penalties.
pub fn rounding() -> Figure {
    let last = "1e38".parse().expect("a decimal");
    let penalties = solver::penalties(&Exact::from(1), &last, 77).expect("ends in order");
    const BITS: u32 = 113;
    let single = |x: &Exact| x.to_f32().expect("within range");
    let mut plot = Plot::new(
        Axis::powers("ε in newtons per metre", 0, 40, 10),
        Axis::powers("relative error", -40, 0, 10),
        340.0,
    );
    let measured = [
        ("f32", NumberSystem::F32, errors(&penalties, single)),
        ("f64", NumberSystem::F64, errors(&penalties, float)),
        ("113 bits", NumberSystem::Mpfr(BITS), errors(&penalties, |x| x.to_mpfr(BITS))),
    ];
    let system = default();
    for (name, numbers, [deflection, force, penalty_force]) in measured {
        let eta = numbers.unit_roundoff();
        let best = solver::best_penalty(&system, &eta).ok().flatten().expect("there is contact");
        let bound = solver::penalty_force_bound(&system, &best, &eta);
        let bound = bound.ok().flatten().expect("there is contact");
        let (at, shown) = ((float(&best), float(&bound)), bound.decimal(2, Round::Up));
        plot.mark("penalty", at, &format!("{name} ε* = {:.1e}, error at most {shown}", at.0));
        plot.text("penalty", at, (-7.0, 14.0), "ε^{∗}");
        // The rising curve is labelled a third of its way up, the falling one below its end.
        let rising = penalty_force.iter().rfind(|(_, error)| *error < at.1.powf(0.7)).expect("a small error");
        plot.text("penalty", *rising, (10.0, 6.0), name);
        plot.text("", *force.last().expect("a row"), (-1.0, 16.0), name);
        plot.line("penalty", penalty_force);
        plot.line("spring", force);
        plot.line("fine dotted", deflection);
    }
    plot.text("penalty", (1e26, 1e-4), (-1.0, 0.0), "ε p");
    plot.text("spring", (1e27, 1e-25), (10.0, 0.0), "m g − c u");
    let caption = "Errors of $\\varepsilon\\,\\hat p$, of $m\\,g - c\\,\\hat u$ and of $\\hat u$ (dotted) in three precisions. The dots are the best penalties \
                   $\\varepsilon^*$ with the guaranteed bound. Errors of 0 are omitted.";
    let description = "Relative errors of the penalty method for the default system, on logarithmic axes, against ε. All \
                       fall along one line, c/(c + ε), at first. The errors of the deflection u and of the force \
                       m g − c u follow it down to the rounding error of one number; errors of 0 are omitted. The error \
                       of the force ε p departs from it first, near the best penalty ε*, and rises again to 1:";
    plot.figure("Errors of the penalty method with rounding", caption, description)
}

/// Draws the residuals of the block in `examples/block.log` with their bound.
pub fn block() -> Figure {
    let rows = include_str!("../../../../examples/block.log").lines().filter_map(|line| {
        let numbers: Vec<f64> = line.split_whitespace().map_while(|word| word.parse().ok()).collect();
        let [k, residual, bound, ..] = numbers[..] else { return None };
        Some((k, residual, bound))
    });
    let rows: Vec<_> = rows.collect();
    let mut plot = decay(8.0, 1.0, Axis::powers("residual in millimetres", -14, -2, 2));
    plot.line("dashed", rows.iter().map(|(k, _, bound)| (*k, *bound)));
    plot.line("iterate fine dotted", rows.iter().map(|(k, residual, _)| (*k, *residual)));
    for (k, residual, _) in &rows {
        plot.mark("iterate", (*k, *residual), &format!("k = {k}: {residual:e} mm"));
    }
    let (middle, residual, bound) = rows[rows.len() / 2];
    plot.text("iterate", (middle, residual), (-14.0, 16.0), "|r_k|");
    plot.text("", (middle, bound), (4.0, -10.0), "|r_0| / (1 + ε s_{min})^{k}");
    let caption = "Residuals of the block (dots) and the bound $|r_0|/(1 + \\varepsilon s_{\\min})^k$ (dashed), for $\\varepsilon = 10\\,\\bar c$. \
                   The slopes become equal as the slowest mode remains.";
    let description = "Residuals on a logarithmic axis against the number k of augmentations. They fall faster than \
                       the bound, along a curve whose slope becomes that of the bound:";
    plot.figure("Convergence of the block", caption, description)
}
