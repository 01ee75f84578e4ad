//! The plane of p and N.

use super::Figure;
use super::axes::{Axis, Plot};
use super::svg::{Anchor::*, number};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, system};
use spring_mass_contact::number::{Exact, ToExact};

/// The example, with a gravity of its own.
fn example(g: i32) -> SpringMass<Exact> {
    SpringMass { c: 4, m: 1, g, l: 1, h: 3 }.map(|&n| Exact::from(n))
}

/// What is drawn of a number.
fn float(x: &Exact) -> f64 {
    x.to_f64().expect("within range")
}

/// The deflection at a penetration.
fn deflection(system: &SpringMass<Exact>, p: f64) -> Exact {
    system::gap(system) + p.to_exact().expect("a number")
}

/// The point at a deflection and a force.
fn point(system: &SpringMass<Exact>, u: &Exact, n: &Exact) -> (f64, f64) {
    (float(&contact::penetration(system, u)), float(n))
}

/// The window of the example, the same on every page.
fn window() -> Plot {
    let mut plot = Plot::new(
        Axis::linear("p in metres", -0.2, 0.6, 0.2),
        Axis::linear("N in newtons", -0.4, 2.4, 0.5),
        290.0,
    );
    plot.zeros();
    plot
}

/// c p + N = R.
fn equilibrium(plot: &mut Plot, system: &SpringMass<Exact>, class: &str) {
    plot.graph(class, |p| float(&augmented::contact_force(system, &deflection(system, p))));
}

/// p ≤ 0, N ≥ 0, p N = 0.
fn corner(plot: &mut Plot) {
    plot.line("plane thick", [(-9.0, 0.0), (0.0, 0.0), (0.0, 9.0)]);
}

/// The answer, where equilibrium and the corner meet.
fn solution(system: &SpringMass<Exact>) -> (f64, f64) {
    point(system, &contact::deflection(system), &contact::contact_force(system))
}

fn says(what: &str, (p, n): (f64, f64)) -> String {
    format!("{what}: p = {}, N = {}", number(p), number(n))
}

fn figure(plot: Plot, title: &'static str, caption: &'static str, description: String) -> Figure {
    let (body, size) = plot.done();
    Figure { name: "", title, caption, description, size, body }
}

/// Equilibrium, contact and the answer.
pub fn answer() -> Figure {
    let system = example(10);
    let mut plot = window();
    corner(&mut plot);
    equilibrium(&mut plot, &system, "spring");
    let answer @ (p, n) = solution(&system);
    plot.mark("answer", answer, &says("The answer", answer));
    plot.text("", answer, (12.0, -6.0), Start, "the answer: N = R");
    plot.text("spring", (0.2, 1.2), (16.0, -26.0), Start, "equilibrium");
    plot.text("spring", (0.2, 1.2), (16.0, -8.0), Start, "c p + N = R");
    plot.text("plane", (0.0, 1.0), (-10.0, 0.0), End, "contact");
    figure(
        plot,
        "Equilibrium, contact, and where they meet",
        "The plane of $p$ and $N$, for the example. Equilibrium is a line, contact a corner, and the answer is where they meet.",
        format!(
            "Penetration p to the right, contact force N upwards. Equilibrium, c p + N = R, is a line that falls from \
             N = {} at p = 0 to N = 0 at p = {}. Contact is a corner: the half of the p axis where p is not positive, and \
             the half of the N axis where N is not negative. They meet in one point, p = {}, N = {}.",
            number(float(&system::reaction(&system))),
            number(float(&(system::reaction(&system) / &system.c))),
            number(p),
            number(n),
        ),
    )
}
