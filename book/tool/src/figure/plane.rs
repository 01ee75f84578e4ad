//! Figures in the plane of penetration p and contact force N.

use super::Figure;
use super::axes::{Axis, Plot};
use super::svg::{Anchor::*, number};
use spring_mass_contact::chapter::{
    SpringMass, augmented, beyond, contact, lagrange, penalty, structure, system,
};
use spring_mass_contact::number::{Exact, ToExact};

pub const P: &str = "p in metres";
const N: &str = "N in newtons";

/// Returns the example with another gravity.
pub fn example(g: i32) -> SpringMass<Exact> {
    SpringMass { c: 4, m: 1, g, l: 1, h: 3 }.map(|&n| Exact::from(n))
}

/// Converts a number for drawing.
pub fn float(x: &Exact) -> f64 {
    x.to_f64().expect("within range")
}

/// Returns the deflection at a penetration.
pub fn deflection(system: &SpringMass<Exact>, p: f64) -> Exact {
    system::gap(system) + p.to_exact().expect("a number")
}

/// Returns the point (p, N) at a deflection and a force.
pub fn point(system: &SpringMass<Exact>, u: &Exact, n: &Exact) -> (f64, f64) {
    (float(&contact::penetration(system, u)), float(n))
}

/// Returns a plot with the lines p = 0 and N = 0.
fn plane(p: Axis, n: Axis, height: f64) -> Plot {
    let mut plot = Plot::new(p, n, height);
    plot.zeros();
    plot
}

/// Returns the plot of the example, with the same ranges on every page.
fn window() -> Plot {
    plane(Axis::linear(P, -0.2, 0.6, 0.2), Axis::linear(N, -0.4, 2.4, 0.5), 296.0)
}

/// Draws a force as a function of the deflection.
fn line(plot: &mut Plot, class: &str, system: &SpringMass<Exact>, force: impl Fn(&Exact) -> Exact) {
    plot.graph(class, |p| float(&force(&deflection(system, p))));
}

fn equilibrium(plot: &mut Plot, system: &SpringMass<Exact>, class: &str) {
    line(plot, class, system, |u| augmented::contact_force(system, u));
}

/// Labels the line of equilibrium of the example above the line.
fn equilibrium_above(plot: &mut Plot) {
    plot.text("spring", (0.2, 1.2), (16.0, -8.0), Start, "c p + N = R");
}

/// Labels the line of equilibrium below the line, clear of the methods' lines.
fn equilibrium_below(plot: &mut Plot) {
    plot.text("spring", (0.14, 0.3), (0.0, 0.0), Start, "c p + N = R");
}

/// Draws the corner p ≤ 0, N ≥ 0, p N = 0.
fn corner(plot: &mut Plot, class: &str) {
    plot.line(class, [(-9.0, 0.0), (0.0, 0.0), (0.0, 9.0)]);
}

/// Returns the solution, the intersection of equilibrium and corner.
fn solution(system: &SpringMass<Exact>) -> (f64, f64) {
    point(system, &contact::deflection(system), &contact::contact_force(system))
}

/// Returns the rest position without the plane.
fn free(system: &SpringMass<Exact>) -> (f64, f64) {
    point(system, &structure::deflection(system), &Exact::from(0))
}

/// Returns the result of the penalty method.
fn penalised(system: &SpringMass<Exact>, eps: &Exact) -> (f64, f64) {
    let u = penalty::deflection(system, eps);
    point(system, &u, &penalty::contact_force(system, eps, &u))
}

/// Returns the multiplier and the point of each augmentation.
fn augmentations(system: &SpringMass<Exact>, eps: &Exact, start: i32) -> Vec<(Exact, (f64, f64))> {
    let mut lambda = Exact::from(start);
    let mut step = |_| {
        let u = augmented::unilateral_deflection(system, eps, &lambda);
        let next = augmented::unilateral_update(system, eps, &lambda, &u);
        let at = point(system, &u, &next);
        (std::mem::replace(&mut lambda, next), at)
    };
    (0..4).map(&mut step).collect()
}

fn format_point((p, n): (f64, f64)) -> String {
    format!("p = {}, N = {}", number(p), number(n))
}

fn label(name: &str, point: (f64, f64)) -> String {
    format!("{name}: {}", format_point(point))
}

pub fn figure(plot: Plot, title: &'static str, caption: &'static str, description: String) -> Figure {
    let (body, size) = plot.done();
    Figure { name: "", title, caption, description, size, body }
}

/// Draws equilibrium, contact and the solution.
pub fn answer() -> Figure {
    let system = example(10);
    let mut plot = window();
    corner(&mut plot, "plane thick");
    equilibrium(&mut plot, &system, "spring");
    let answer = solution(&system);
    plot.mark("answer", answer, &label("The answer", answer));
    plot.text("", answer, (12.0, -6.0), Start, "the answer: N = R");
    plot.text("spring", (0.2, 1.2), (16.0, -26.0), Start, "equilibrium");
    equilibrium_above(&mut plot);
    plot.text("plane", (0.0, 1.0), (-10.0, 0.0), End, "contact");
    let description = format!(
        "Penetration p to the right, contact force N upwards. Equilibrium, c p + N = R, is a line that falls from N = {} \
         at p = 0 to N = 0 at p = {}. Contact is a corner: the p axis for p ≤ 0, and the N axis for N ≥ 0. They meet in \
         one point, {}.",
        number(float(&system::reaction(&system))),
        number(free(&system).0),
        format_point(answer),
    );
    let caption = "Force $N$ over penetration $p$, for the example. Equilibrium is a line, contact a corner, and the \
                   answer is where they meet.";
    figure(plot, "Equilibrium, contact, and where they meet", caption, description)
}

/// Draws equilibrium alone, with its intercepts.
pub fn intercepts() -> Figure {
    let system = example(10);
    let mut plot = window();
    equilibrium(&mut plot, &system, "spring");
    let held = point(&system, &lagrange::deflection(&system), &lagrange::multiplier(&system));
    let free = free(&system);
    plot.mark("spring", held, &label("Held at the plane", held));
    plot.mark("spring", free, &label("Without the plane", free));
    plot.text("spring", held, (12.0, -4.0), Start, "R, to hold it at the plane");
    plot.text("spring", free, (-8.0, 20.0), End, "R/c, without the plane");
    equilibrium_above(&mut plot);
    plot.text("", (-0.1, 0.0), (0.0, -9.0), Middle, "above");
    plot.text("", (0.1, 0.0), (0.0, -9.0), Middle, "below");
    plot.text("", (0.0, -0.4), (0.0, 38.0), Middle, "u = Δ");
    let description = format!(
        "The line c p + N = R in the plane of penetration p and contact force N. At p = 0, where u is the gap, N = {} is \
         required to hold the mass; without the plane, N = 0, the mass rests at p = {}, below the plane.",
        number(held.1),
        number(free.0),
    );
    let caption = "Equilibrium: the lower the mass, the more the spring carries, and the less the plane.";
    figure(plot, "Equilibrium as a line", caption, description)
}

/// Draws equilibrium without the plane.
pub fn hanging() -> Figure {
    let system = example(10);
    let mut plot = window();
    plot.line("thick", [(-9.0, 0.0), (9.0, 0.0)]);
    equilibrium(&mut plot, &system, "spring");
    let free = free(&system);
    plot.mark("answer", free, &label("The free mass", free));
    plot.text("", (0.0, 0.0), (8.0, -9.0), Start, "no plane: N = 0");
    plot.text("", free, (-8.0, 22.0), End, "p = R/c, u = m g/c");
    equilibrium_above(&mut plot);
    let description = format!(
        "The line of equilibrium, c p + N = R, meets the line N = 0 at p = {}: there u = {} m, and the spring alone \
         carries the weight.",
        number(free.0),
        number(float(&structure::deflection(&system))),
    );
    let caption = "Without the plane $N = 0$, and the mass rests where equilibrium meets the $p$ axis.";
    figure(plot, "The free mass", caption, description)
}

pub fn states() -> Figure {
    let mut plot = plane(Axis::linear(P, -1.5, 0.75, 0.5), Axis::linear(N, -0.5, 2.5, 0.5), 296.0);
    corner(&mut plot, "plane thick");
    let mut lines = Vec::new();
    for (g, class, state) in
        [(10, "spring", "contact"), (8, "spring dashed", "grazing"), (4, "spring dotted", "separated")]
    {
        let system = example(g);
        equilibrium(&mut plot, &system, class);
        let answer = solution(&system);
        plot.mark("answer", answer, &label(&format!("g = {g}, {state}"), answer));
        let r = number(float(&system::reaction(&system)));
        lines.push(format!("for g = {g}, R = {r}, at {}: {state}", format_point(answer)));
    }
    plot.text("", (0.0, 2.0), (12.0, -5.0), Start, "g = 10:");
    plot.text("", (0.0, 2.0), (12.0, 13.0), Start, "contact");
    plot.text("", (0.0, 0.0), (-8.0, 22.0), End, "g = 8: grazing");
    plot.text("", (-1.0, 0.0), (8.0, -28.0), Start, "g = 4:");
    plot.text("", (-1.0, 0.0), (8.0, -10.0), Start, "separated");
    let description = format!(
        "Three parallel lines of equilibrium meet the corner of contact, each in one point: {}.",
        lines.join("; ")
    );
    let caption = "Less gravity moves the line of equilibrium down and to the left. It always meets the corner exactly once.";
    figure(plot, "Contact, grazing and separated", caption, description)
}

/// Draws the three methods for ε = 4.
pub fn methods() -> Figure {
    let (system, eps) = (example(10), Exact::from(4));
    let mut plot = window();
    plot.line("plane thick", [(0.0, -9.0), (0.0, 9.0)]);
    line(&mut plot, "penalty dashed", &system, |u| penalty::contact_force(&system, &eps, u));
    let steps = augmentations(&system, &eps, 0);
    let (lambda, third) = &steps[3];
    line(&mut plot, "iterate dotted", &system, |u| augmented::update(&system, &eps, lambda, u));
    equilibrium(&mut plot, &system, "spring");
    let (exact, soft) = (solution(&system), penalised(&system, &eps));
    plot.mark("plane", exact, &label("Lagrange multiplier", exact));
    plot.mark("penalty", soft, &label("Penalty", soft));
    plot.mark("iterate", *third, &label("Augmented, k = 3", *third));
    plot.text("plane", (0.0, 0.5), (-10.0, 0.0), End, "Lagrange");
    plot.text("penalty", (0.45, 1.8), (-10.0, -6.0), End, "penalty");
    plot.text("iterate", (0.16, 2.4), (12.0, 14.0), Start, "augmented, k = 3");
    equilibrium_below(&mut plot);
    let description = format!(
        "Intersections of the line of equilibrium, c p + N = R, with the line of each method, for ε = 4. Multiplier method, \
         p = 0: {}. Penalty method, N = ε p: {}. Augmented method after three steps, N = {} + ε p: {}.",
        format_point(exact),
        format_point(soft),
        number(float(lambda)),
        format_point(*third),
    );
    let caption = "The three methods for $\\varepsilon = 4$. Each replaces the corner by a line, and finds its intersection with \
                   equilibrium.";
    figure(plot, "Three methods", caption, description)
}

/// Draws the plane as a bilateral constraint.
pub fn multiplier() -> Figure {
    let system = example(10);
    let mut plot = window();
    plot.line("plane thick", [(0.0, 0.0), (0.0, 9.0)]);
    plot.line("plane thick dashed", [(0.0, 0.0), (0.0, -9.0)]);
    equilibrium(&mut plot, &system, "spring");
    let answer = point(&system, &lagrange::deflection(&system), &lagrange::multiplier(&system));
    plot.mark("answer", answer, &label("The multiplier method", answer));
    plot.text("", answer, (12.0, -6.0), Start, "u = Δ, λ = R");
    plot.text("plane", (0.0, 1.0), (-10.0, 0.0), End, "p = 0");
    plot.text("plane", (0.0, -0.2), (10.0, 5.0), Start, "here the plane pulls");
    equilibrium_below(&mut plot);
    let description = format!(
        "The constraint p = 0 is the whole N axis; below N = 0, where the plane would pull, it is dashed. It meets the line \
         of equilibrium, c p + N = R, at {}.",
        format_point(answer),
    );
    let caption = "The multiplier method replaces the corner by the line $p = 0$. Its lower half, dashed, is a plane to which the \
                   mass is glued.";
    figure(plot, "The constraint as a line", caption, description)
}

/// Draws the second spring for three penalties.
pub fn penalties() -> Figure {
    let system = example(10);
    let mut plot = window();
    corner(&mut plot, "plane thick ghost");
    let mut lines = Vec::new();
    let mut found = Vec::new();
    for eps in [4, 16, 36] {
        let stiffness = Exact::from(eps);
        line(&mut plot, "penalty", &system, |u| penalty::contact_force(&system, &stiffness, u));
        let at = penalised(&system, &stiffness);
        lines.push(format!("for ε = {eps} at {}", format_point(at)));
        found.push((eps, at));
    }
    equilibrium(&mut plot, &system, "spring");
    let (soft, exact) = (found[0].1, solution(&system));
    plot.line("fine dashed", [exact, (soft.0, exact.1)]);
    plot.dimension("fine", soft, (soft.0, exact.1));
    for (eps, at) in found {
        plot.mark("penalty", at, &label(&format!("ε = {eps}"), at));
    }
    plot.mark("answer", exact, &label("Exact", exact));
    plot.text("penalty", (0.06, 2.4), (0.0, -8.0), Middle, "ε = 36");
    plot.text("penalty", (0.19, 2.4), (0.0, -8.0), Middle, "ε = 16");
    plot.text("penalty", (0.6, 2.4), (0.0, -8.0), End, "ε = 4");
    plot.text("", (soft.0, 1.65), (9.0, 0.0), Start, "R − N");
    equilibrium_below(&mut plot);
    let description = format!(
        "Lines N = ε p through the origin, the steeper the larger ε, meet the line of equilibrium, c p + N = R: {}. The exact \
         solution is at {}. The error of the force, R − N, is c p.",
        lines.join(", "),
        format_point(exact),
    );
    let caption = "The penalty replaces the corner by the line $N = \\varepsilon\\,p$. The spring carries the missing force, \
                   $R - N = c\\,p$.";
    figure(plot, "The penalty as a line", caption, description)
}

/// Draws the iterates of the augmentation.
pub fn iterates() -> Figure {
    let (system, eps) = (example(10), Exact::from(4));
    let mut plot = window();
    corner(&mut plot, "plane thick ghost");
    let steps = augmentations(&system, &eps, 0);
    for (lambda, _) in &steps {
        let along = |p: f64| (p, float(&augmented::update(&system, &eps, lambda, &deflection(&system, p))));
        plot.line("iterate fine dotted", [0.0, 0.6].map(along));
    }
    equilibrium(&mut plot, &system, "spring");
    let exact = solution(&system);
    let mut lines = Vec::new();
    for (k, (lambda, at)) in steps.iter().enumerate() {
        let start = (0.0, float(lambda));
        plot.line("iterate", [start, *at]);
        plot.line("iterate fine dashed", [*at, (0.0, at.1)]);
        let down = if k == 0 { -9.0 } else { 5.0 };
        plot.text("iterate", start, (-10.0, down), End, &format!("λ_{k}"));
        lines.push(format!("from {} to {}", number(start.1), format_point(*at)));
    }
    for (k, (_, at)) in steps.iter().enumerate() {
        plot.mark("iterate", *at, &label(&format!("k = {k}"), *at));
    }
    plot.mark("answer", exact, &label("Exact", exact));
    plot.text("iterate", steps[0].1, (12.0, 5.0), Start, "p_0, λ_1");
    equilibrium_below(&mut plot);
    let description = format!(
        "Four parallel lines N = λ + ε p, for ε = 4, each from its λ on the N axis to the line of equilibrium: {}. The N of \
         each is the λ of the next. They converge to the corner at {}.",
        lines.join(", "),
        format_point(exact),
    );
    let caption = "Augmentation shifts the line, $N = \\lambda_k + \\varepsilon\\,p$. Its intersection with equilibrium gives the \
                   next $\\lambda$, for $\\varepsilon = 4$.";
    figure(plot, "The iterates move to the corner", caption, description)
}

/// Draws updates with different steps.
pub fn relaxed() -> Figure {
    let (system, eps, start) = (example(10), Exact::from(4), Exact::from(0));
    let mut plot = window();
    corner(&mut plot, "plane thick ghost");
    equilibrium(&mut plot, &system, "spring");
    let u = augmented::deflection(&system, &eps, &start);
    let steps = [eps.clone(), penalty::total_stiffness(&system, &eps)];
    let mut found = Vec::new();
    for (step, class) in steps.iter().zip(["iterate", "iterate dashed"]) {
        line(&mut plot, class, &system, |u| beyond::relaxed_update(&system, step, &start, u));
        let at = point(&system, &u, &beyond::relaxed_update(&system, step, &start, &u));
        plot.line("fine dashed", [at, (0.0, at.1)]);
        found.push(at);
    }
    plot.line("fine dashed", found.clone());
    for (step, at) in steps.iter().zip(&found) {
        plot.mark("iterate", *at, &label(&format!("α = {step}"), *at));
    }
    plot.mark("answer", solution(&system), &label("Exact", solution(&system)));
    plot.text("iterate", (0.45, 1.8), (10.0, 8.0), Start, "α = ε");
    plot.text("iterate", (0.3, 2.4), (8.0, 14.0), Start, "α = c + ε");
    plot.text("iterate", (0.0, 1.0), (-10.0, 5.0), End, "λ_1");
    equilibrium_below(&mut plot);
    let description = format!(
        "Two lines N = α p through the origin, for ε = 4 and λ = 0. The line with α = ε meets equilibrium at {}, where N is \
         the next λ. At the same p the line with α = c + ε = {} has N = {}, which is R: the solution in one step.",
        format_point(found[0]),
        number(float(&steps[1])),
        number(found[1].1),
    );
    let caption = "One step from $\\lambda_0 = 0$ with $\\varepsilon = 4$: at the same $p_0$ the steeper line, $\\alpha = c + \\varepsilon$, \
                   is at the height of the solution.";
    figure(plot, "Updates with different steps", caption, description)
}

/// Draws the augmentation of a separated system with unilateral contact.
pub fn bent() -> Figure {
    let (system, eps) = (example(4), Exact::from(4));
    let mut plot = plane(Axis::linear(P, -2.25, 0.75, 0.5), Axis::linear(N, -3.0, 5.0, 1.0), 340.0);
    corner(&mut plot, "plane thick");
    let steps = augmentations(&system, &eps, 10);
    let none = Exact::from(0);
    line(&mut plot, "penalty dashed", &system, |u| augmented::update(&system, &eps, &none, u));
    for (lambda, _) in &steps[..3] {
        line(&mut plot, "iterate", &system, |u| augmented::unilateral_update(&system, &eps, lambda, u));
    }
    equilibrium(&mut plot, &system, "spring");
    let u = augmented::deflection(&system, &eps, &none);
    let stuck = point(&system, &u, &augmented::contact_force(&system, &u));
    plot.mark("penalty", stuck, &label("No positive part in equilibrium", stuck));
    plot.mark("iterate", steps[0].1, &label("k = 0", steps[0].1));
    plot.mark("answer", steps[1].1, &label("k = 1 and after", steps[1].1));
    plot.text("iterate", steps[0].1, (14.0, 5.0), Start, "k = 0");
    plot.text("", steps[1].1, (-6.0, 20.0), End, "k = 1, 2");
    plot.text("iterate", (-1.4, 4.4), (10.0, 5.0), Start, "λ_0 = 10");
    plot.text("iterate", (-0.3, 1.8), (-8.0, 0.0), End, "λ_1 = 3");
    plot.text("iterate", (0.3, 0.9), (6.0, 5.0), Start, "λ_2 = 0");
    plot.text("penalty", stuck, (-14.0, 5.0), End, "stuck, pulling");
    plot.text("spring", (-0.9, -1.5), (0.0, 0.0), End, "c p + N = R");
    let [(_, first), (lambda, second), ..] = &steps[..] else { unreachable!("four steps") };
    let description = format!(
        "A system with R = {}, whose line of equilibrium meets the other arm of the corner, N = 0. Lines N = ⟨λ + ε p⟩ with \
         ε = 4 lie on the p axis and then rise. From λ = 10 the first meets equilibrium at {}; the second, with \
         λ = {}, at {}, the solution. The line N = ε p, without the positive part, continues below the axis and meets \
         equilibrium at {}: an update that is set to λ = 0 returns to it in every step.",
        number(float(&system::reaction(&system))),
        format_point(*first),
        number(float(lambda)),
        format_point(*second),
        format_point(stuck),
    );
    let caption = "A separated system ($g = 4$, $R = -4$): the bent line $N = \\langle\\lambda_k + \\varepsilon\\,p\\rangle$ meets \
                   equilibrium on the other arm. Without the positive part (dashed), the plane pulls.";
    figure(plot, "The positive part as a bent line", caption, description)
}

/// Draws the step force of a penalty with a kink.
pub fn step() -> Figure {
    let system = example(10);
    let mut plot = window();
    corner(&mut plot, "plane thick ghost");
    let tenths = |n: i32| Exact::from(n) / Exact::from(10);
    // Any two points of a line determine its slope.
    let slope = |eps: &Exact, from: i32, to: i32| {
        let [a, b] = [from, to].map(|p| beyond::exact_penalty(eps, &tenths(p)));
        float(&((b - a) / tenths(to - from)))
    };
    let mut ends = Vec::new();
    for (eps, class) in [(tenths(22), "penalty"), (tenths(10), "penalty dashed")] {
        let (low, high) = (slope(&eps, -9, -1), slope(&eps, 1, 9));
        plot.line(class, [(-0.2, low), (0.0, low), (0.0, high), (0.6, high)]);
        ends.push(high);
    }
    equilibrium(&mut plot, &system, "spring");
    let exact = solution(&system);
    // On the lower step N acts as a known multiplier without a penalty.
    let u = augmented::deflection(&system, &Exact::from(0), &tenths(10));
    let low = point(&system, &u, &augmented::contact_force(&system, &u));
    plot.mark("answer", exact, &label("ε = 2.2", exact));
    plot.mark("penalty", low, &label("ε = 1", low));
    plot.text("penalty", (0.5, ends[0]), (0.0, -6.0), Middle, "ε = 2.2");
    plot.text("penalty", (0.5, ends[1]), (0.0, -6.0), Middle, "ε = 1");
    equilibrium_below(&mut plot);
    let description = format!(
        "The force of the penalty ε⟨p⟩ is a step: 0 above the plane, ε below it, any value between at p = 0. The line of \
         equilibrium meets a step of height {} in its vertical part, at {}, exactly. A step of height {} is lower than \
         R; they meet below the plane, at p = {}.",
        number(ends[0]),
        format_point(exact),
        number(ends[1]),
        number(low.0),
    );
    let caption = "The force of the exact penalty is a step. If it is at least as high as $R$, equilibrium meets its vertical part, \
                   as with the corner.";
    figure(plot, "The exact penalty as a step", caption, description)
}
