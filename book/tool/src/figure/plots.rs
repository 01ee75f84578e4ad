//! Plots of functions of one variable.

use super::Figure;
use super::axes::{Axis, Plot};
use super::plane::{P, deflection, example, figure, float, point};
use super::svg::{Anchor::*, number};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, ode, penalty, structure};
use spring_mass_contact::number::{Exact, NumberSystem, PositivePart, ToExact};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{self, Scalar};

/// Draws the functionals of the methods and their minima.
pub fn energies() -> Figure {
    let (system, eps) = (example(10), Exact::from(4));
    let (multiplier, guess) = (lagrange::multiplier(&system), Exact::from(1));
    let mut plot = Plot::new(
        Axis::linear(P, -0.2, 0.6, 0.2),
        Axis::linear("energy in joules", -12.6, -11.4, 0.2),
        310.0,
    );
    type Energy<'a> = &'a dyn Fn(&Exact) -> Exact;
    let curves: [(&str, &str, Exact, Energy); 4] = [
        ("spring", "Π", structure::deflection(&system), &|u| structure::potential_energy(&system, u)),
        ("penalty dashed", "Π_p", penalty::deflection(&system, &eps), &|u| {
            penalty::energy(&system, &eps, u)
        }),
        ("plane", "ℒ", lagrange::deflection(&system), &|u| lagrange::functional(&system, u, &multiplier)),
        ("iterate dotted", "L", augmented::deflection(&system, &eps, &guess), &|u| {
            augmented::functional(&system, &eps, &guess, u)
        }),
    ];
    let mut labels = Vec::new();
    let mut minima = Vec::new();
    for (class, name, u, energy) in curves {
        plot.graph(class, |p| float(&energy(&deflection(&system, p))));
        let at = point(&system, &u, &energy(&u));
        let label = format!("{name}: p = {}, {} J", number(at.0), number(at.1));
        labels.push(label.replace('_', ""));
        minima.push((class, at));
    }
    for ((class, at), label) in minima.iter().zip(&labels) {
        plot.mark(class.split(' ').next().unwrap_or_default(), *at, label);
    }
    plot.text("spring", minima[0].1, (0.0, -10.0), Middle, "Π");
    plot.text("penalty", (0.42, -12.12), (4.0, 14.0), Start, "Π_p");
    plot.text("plane", (0.3, -11.82), (-6.0, -6.0), End, "ℒ");
    plot.text("iterate", (0.42, -11.8), (0.0, 14.0), Start, "L");
    let description = format!(
        "Four parabolas over the penetration p, with the same value at p = 0. Their minima: {}.",
        labels.join("; ")
    );
    let caption = "The functional of each method, for the example with $\\varepsilon = 4$: the energy $\\Pi$ alone, with the penalty, with \
                   the multiplier $\\lambda = R$, and with both at $\\lambda = 1$. They agree at $p = 0$.";
    figure(plot, "The energies and their minima", caption, description)
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
    let mut plot = Plot::new(
        Axis::linear("k, augmentations", 0.0, 6.0, 1.0),
        Axis::powers("penetration in metres", -4, 0, 1),
        296.0,
    );
    plot.graph("", above);
    plot.graph("dashed", below);
    let mut lambda = 0.0;
    let mut points = Vec::new();
    for k in 0..=6 {
        let u = augmented::deflection(&system, &eps, &lambda);
        points.push((f64::from(k), contact::penetration(&system, &u)));
        lambda = augmented::update(&system, &eps, &lambda, &u);
    }
    plot.line("iterate fine dotted", points.clone());
    for (k, p) in &points {
        plot.mark("iterate", (*k, *p), &format!("k = {k}: p = {p}"));
    }
    plot.text("", (3.0, above(3.0)), (4.0, -10.0), Start, "p_0 e^{−k ε/(c + ε)}");
    plot.text("", (3.0, below(3.0)), (-10.0, 12.0), End, "p_0 e^{−k ε/c}");
    plot.text("iterate", points[6], (-2.0, -12.0), End, "p_k");
    let (k, p) = points[6];
    let description = format!(
        "Penetrations on a logarithmic axis against the number k of augmentations, for the example with ε = c = 4. All three \
         sequences start at {first} and fall along straight lines. At k = {k} the iterate is {p:.4}, below the solution of the \
         differential equation, {:.4}, and above the lower bound, {:.5}.",
        above(k),
        below(k),
    );
    let caption = "The iterates $p_k$ (dots) lie between their two bounds. The upper one, drawn solid, is the solution of the \
                   differential equation, which decays more slowly. Here $\\varepsilon = c$.";
    figure(plot, "Iterates between two bounds", caption, description)
}

/// Returns the default system of the command.
fn default() -> SpringMass<Exact> {
    SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().expect("decimals")
}

/// Relative errors of u, of m g − c u and of ε p for a penalty.
struct Errors {
    eps: f64,
    deflection: f64,
    force: f64,
    penalty_force: f64,
}

fn errors<T: Scalar + ToExact>(penalties: &[Exact], round: impl Fn(&Exact) -> T) -> Vec<Errors> {
    let system = default().map(&round);
    let exact = |x: &T| x.to_exact().expect("a finite number");
    let right = contact::deflection(&system.map(exact));
    let rows = solver::sweep(&system, penalties.iter().map(&round));
    let errors = rows.map_while(|row| {
        let row = row.ok()?;
        Some(Errors {
            eps: float(&exact(&row.penalty)),
            deflection: float(&((exact(&row.deflection) - &right) / &right).abs()),
            force: float(&row.force_error?),
            penalty_force: float(&row.penalty_force_error?),
        })
    });
    errors.collect()
}

/// Draws the errors of the penalty method in three precisions, with the best penalties.
pub fn rounding() -> Figure {
    let power = |n: i32| format!("1e{n}").parse::<Exact>().expect("a power of ten");
    let penalties = solver::penalties(&power(0), &power(38), 77).expect("ends in order");
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
    let mut best = Vec::new();
    for (name, numbers, errors) in &measured {
        // An error of 0 cannot be shown on a logarithmic axis.
        let curve = |error: fn(&Errors) -> f64| -> Vec<_> {
            errors.iter().map(|row| (row.eps, error(row))).filter(|(_, error)| *error > 0.0).collect()
        };
        plot.line("penalty", curve(|row| row.penalty_force));
        plot.line("spring", curve(|row| row.force));
        plot.line("fine dotted", curve(|row| row.deflection));
        let (label_error, aside) =
            if *name == "113 bits" { (1e-10, (-16.0, 4.0)) } else { (0.05, (0.0, -8.0)) };
        let rising = curve(|row| row.penalty_force).into_iter().rfind(|(_, error)| *error < label_error);
        plot.text("penalty", rising.unwrap_or_default(), (10.0, 6.0), Start, name);
        let last = curve(|row| row.force).last().copied().unwrap_or_default();
        plot.text("", last, aside, End, name);
        let eta = numbers.unit_roundoff();
        let system = default();
        let eps = solver::best_penalty(&system, &eta).expect("a valid system").expect("there is contact");
        let bound = solver::penalty_force_bound(&system, &eps, &eta)
            .expect("a valid system")
            .expect("there is contact");
        let label = format!("{name} ε* = {:.1e}, error at most {}", float(&eps), bound.decimal(2, Round::Up));
        best.push((label, (float(&eps), float(&bound))));
    }
    for (label, at) in &best {
        plot.mark("penalty", *at, label);
        plot.text("penalty", *at, (-7.0, 14.0), End, "ε^{∗}");
    }
    plot.text("penalty", (1e26, 1e-4), (0.0, 0.0), End, "ε p");
    plot.text("spring", (1e27, 1e-25), (10.0, 0.0), Start, "m g − c u");
    let description = format!(
        "Relative errors of the penalty method for the default system, on logarithmic axes, against ε. All fall along one line, \
         c/(c + ε), at first. The error of the force ε p departs from it first, near the best penalty ε*, and rises again to \
         1: {}. The errors of the deflection u and of the force m g − c u follow the line down to the rounding error of one \
         number; errors of 0 are omitted.",
        best.iter().map(|(label, _)| &label[..]).collect::<Vec<_>>().join("; "),
    );
    let caption = "Errors of $\\varepsilon\\,\\hat p$, of $m\\,g - c\\,\\hat u$ and of $\\hat u$ (dotted) in three precisions. The dots are the best penalties \
                   $\\varepsilon^*$ with the guaranteed bound. Errors of 0 are omitted.";
    figure(plot, "Errors of the penalty method with rounding", caption, description)
}

/// Draws the residuals of the block in `examples/block.log` with their bound.
pub fn block() -> Figure {
    let rows = include_str!("../../../../examples/block.log").lines().filter_map(|line| {
        let numbers: Vec<f64> = line.split_whitespace().map_while(|word| word.parse().ok()).collect();
        <[f64; 5]>::try_from(numbers).ok()
    });
    let rows: Vec<_> = rows.collect();
    let mut plot = Plot::new(
        Axis::linear("k, augmentations", 0.0, 10.0, 2.0),
        Axis::powers("residual in millimetres", -14, -2, 2),
        296.0,
    );
    plot.line("dashed", rows.iter().map(|row| (row[0], row[2])));
    plot.line("iterate fine dotted", rows.iter().map(|row| (row[0], row[1])));
    for [k, residual, ..] in &rows {
        plot.mark("iterate", (*k, *residual), &format!("k = {k}: {residual:e} mm"));
    }
    let [last, middle] = [rows.len() - 1, rows.len() / 2];
    plot.text("iterate", (rows[middle][0], rows[middle][1]), (-14.0, 16.0), End, "|r_k|");
    plot.text("", (rows[middle][0], rows[middle][2]), (4.0, -10.0), Start, "|r_0| / (1 + ε s_{min})^{k}");
    let description = format!(
        "Residuals on a logarithmic axis against the number k of augmentations. They fall from {:e} mm to {:e} mm at \
         k = {}, faster than the bound, which falls to {:e} mm.",
        rows[0][1], rows[last][1], rows[last][0], rows[last][2],
    );
    let caption = "Residuals of the block (dots) and the bound $|r_0|/(1 + \\varepsilon s_{\\min})^k$ (dashed), for $\\varepsilon = \\kappa$. \
                   The slopes become equal as the slowest mode remains.";
    figure(plot, "Convergence of the block", caption, description)
}
