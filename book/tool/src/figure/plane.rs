//! Figures in the plane of penetration p and contact force N.

use super::Figure;
use super::axes::{Axis, Plot};
use super::svg::{Point, number};
use spring_mass_contact::chapter::{
    SpringMass, augmented, beyond, contact, lagrange, penalty, structure, system,
};
use spring_mass_contact::number::{Exact, ToExact};

pub const P: &str = "p in metres";
const N: &str = "N in newtons";

/// Returns the example with another gravity.
pub fn example(g: i32) -> SpringMass<Exact> {
    SpringMass { c: 4, m: 1, g, l: 1, h: 3 }.map(Exact::from)
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

/// Returns a fraction with the denominator 10.
fn tenths(n: i32) -> Exact {
    Exact::from(n) / Exact::from(10)
}

/// Plot of contact forces of a system over penetrations.
struct Plane {
    system: SpringMass<Exact>,
    plot: Plot,
}

impl Plane {
    /// Returns a plot with the lines p = 0 and N = 0.
    fn new(g: i32, p: Axis, n: Axis, height: f64) -> Self {
        let mut plot = Plot::new(p, n, height);
        plot.line("axis", [(-9.0, 0.0), (9.0, 0.0)]);
        plot.line("axis", [(0.0, -9.0), (0.0, 9.0)]);
        Plane { system: example(g), plot }
    }

    /// Returns the plot of the example with its line of equilibrium, with the same ranges on every page.
    fn of_example() -> Self {
        let (p, n) = (Axis::linear(P, -0.2, 0.6, 0.2), Axis::linear(N, -0.4, 2.4, 0.5));
        let mut plane = Self::new(10, p, n, 296.0);
        plane.equilibrium("spring");
        plane.text("spring", (0.14, 0.36), (1.0, 0.0), "c p + N = R");
        plane
    }

    /// Draws a force as a function of the deflection, of this number of straight parts.
    fn force(&mut self, class: &str, parts: u32, force: impl Fn(&SpringMass<Exact>, &Exact) -> Exact) {
        let system = &self.system;
        self.plot.graph(class, parts, |p| float(&force(system, &deflection(system, p))));
    }

    fn equilibrium(&mut self, class: &str) {
        self.force(class, 1, augmented::contact_force);
    }

    /// Draws the corner p ≤ 0, N ≥ 0, p N = 0.
    fn corner(&mut self, class: &str) {
        self.plot.line(class, [(-9.0, 0.0), (0.0, 0.0), (0.0, 9.0)]);
    }

    /// Returns the solution, the intersection of equilibrium and corner.
    fn solution(&self) -> (f64, f64) {
        let system = &self.system;
        point(system, &contact::deflection(system), &contact::contact_force(system))
    }

    /// Returns the rest position without the plane.
    fn free(&self) -> (f64, f64) {
        point(&self.system, &structure::deflection(&self.system), &Exact::from(0))
    }

    /// Returns the result of the multiplier method.
    fn constrained(&self) -> (f64, f64) {
        point(&self.system, &lagrange::deflection(&self.system), &lagrange::multiplier(&self.system))
    }

    /// Returns the result of the penalty method.
    fn penalised(&self, eps: &Exact) -> (f64, f64) {
        let u = penalty::deflection(&self.system, eps);
        point(&self.system, &u, &penalty::contact_force(&self.system, eps, &u))
    }

    /// Returns the result for a known multiplier.
    fn augmented(&self, eps: &Exact, lambda: &Exact) -> (f64, f64) {
        let u = augmented::deflection(&self.system, eps, lambda);
        point(&self.system, &u, &augmented::contact_force(&self.system, &u))
    }

    /// Returns the multiplier and the point of each of the first augmentations.
    fn augmentations(&self, eps: &Exact, start: i32) -> [(Exact, (f64, f64)); 4] {
        let mut lambda = Exact::from(start);
        [0; 4].map(|_| {
            let u = augmented::unilateral_deflection(&self.system, eps, &lambda);
            let next = augmented::unilateral_update(&self.system, eps, &lambda, &u);
            let at = point(&self.system, &u, &next);
            (std::mem::replace(&mut lambda, next), at)
        })
    }

    /// Marks a point with its name and coordinates.
    fn mark(&mut self, class: &str, name: &str, at: (f64, f64)) {
        self.plot.mark(class, at, &format!("{name}: p = {}, N = {}", number(at.0), number(at.1)));
    }

    fn text(&mut self, class: &str, at: (f64, f64), offset: Point, text: &str) {
        self.plot.text(class, at, offset, text);
    }
}

/// Draws equilibrium, contact and the solution.
pub fn answer() -> Figure {
    let mut plane = Plane::of_example();
    plane.corner("plane thick");
    plane.mark("answer", "The answer", plane.solution());
    plane.text("", plane.solution(), (12.0, -6.0), "the answer: N = R");
    plane.text("spring", (0.2, 1.2), (16.0, -8.0), "equilibrium");
    plane.text("plane", (0.0, 1.0), (-10.0, 0.0), "contact");
    let caption = "Force $N$ over penetration $p$, for the example. Equilibrium is a line, contact a corner, and the \
                   answer is where they meet.";
    let description = "Penetration p to the right, contact force N upwards. Equilibrium, c p + N = R, is a line that \
                       falls from N = R at p = 0 to N = 0 at p = R/c. Contact is a corner: the p axis for p ≤ 0, and \
                       the N axis for N ≥ 0. They meet in one point.";
    plane.plot.figure("Equilibrium, contact, and where they meet", caption, description)
}

/// Draws equilibrium alone, with its intercepts.
pub fn intercepts() -> Figure {
    let mut plane = Plane::of_example();
    plane.mark("spring", "Held at the plane", plane.constrained());
    plane.mark("spring", "Without the plane", plane.free());
    plane.text("spring", plane.constrained(), (12.0, -4.0), "R, to hold it at the plane");
    plane.text("spring", plane.free(), (-8.0, 20.0), "R/c, without the plane");
    plane.text("", (-0.1, 0.0), (0.0, -9.0), "above");
    plane.text("", (0.1, 0.0), (0.0, -9.0), "below");
    plane.text("", (0.0, -0.4), (0.0, 38.0), "u = Δ");
    let caption = "Equilibrium: the lower the mass, the more the spring carries, and the less the plane.";
    let description = "The line c p + N = R in the plane of penetration p and contact force N. At p = 0, where u is \
                       the gap, N = R is required to hold the mass; without the plane, N = 0, the mass rests at \
                       p = R/c, below the plane.";
    plane.plot.figure("Equilibrium as a line", caption, description)
}

/// Draws equilibrium without the plane.
pub fn hanging() -> Figure {
    let mut plane = Plane::of_example();
    plane.plot.line("thick", [(-9.0, 0.0), (9.0, 0.0)]);
    plane.mark("answer", "The free mass", plane.free());
    plane.text("", (0.0, 0.0), (8.0, -9.0), "no plane: N = 0");
    plane.text("", plane.free(), (-8.0, 22.0), "p = R/c, u = m g/c");
    let caption = "Without the plane $N = 0$, and the mass rests where equilibrium meets the $p$ axis.";
    let description = "The line of equilibrium, c p + N = R, meets the line N = 0 at p = R/c: there u = m g/c, and \
                       the spring alone carries the weight.";
    plane.plot.figure("The free mass", caption, description)
}

/// Draws the three states of contact.
pub fn states() -> Figure {
    let (p, n) = (Axis::linear(P, -1.5, 0.75, 0.5), Axis::linear(N, -0.5, 2.5, 0.5));
    let mut plane = Plane::new(10, p, n, 296.0);
    plane.corner("plane thick");
    for (g, class, state) in
        [(10, "spring", "contact"), (8, "spring dashed", "grazing"), (4, "spring dotted", "separated")]
    {
        plane.system = example(g);
        plane.equilibrium(class);
        plane.mark("answer", &format!("g = {g}, {state}"), plane.solution());
    }
    plane.text("", (0.0, 2.0), (12.0, -5.0), "g = 10:");
    plane.text("", (0.0, 2.0), (12.0, 13.0), "contact");
    plane.text("", (0.0, 0.0), (-8.0, 22.0), "g = 8: grazing");
    plane.text("", (-1.0, 0.0), (8.0, -28.0), "g = 4:");
    plane.text("", (-1.0, 0.0), (8.0, -10.0), "separated");
    let caption = "Less gravity moves the line of equilibrium down and to the left. It always meets the corner exactly once.";
    let description = "Three parallel lines of equilibrium meet the corner of contact, each in one point.";
    plane.plot.figure("Contact, grazing and separated", caption, description)
}

/// Draws the three methods for ε = 4.
pub fn methods() -> Figure {
    let (mut plane, eps) = (Plane::of_example(), Exact::from(4));
    plane.plot.line("plane thick", [(0.0, -9.0), (0.0, 9.0)]);
    plane.force("penalty dashed", 1, |system, u| penalty::contact_force(system, &eps, u));
    let [.., (lambda, third)] = plane.augmentations(&eps, 0);
    plane.force("iterate dotted", 1, |system, u| augmented::update(system, &eps, &lambda, u));
    plane.mark("plane", "Lagrange multiplier", plane.constrained());
    plane.mark("penalty", "Penalty", plane.penalised(&eps));
    plane.mark("iterate", "Augmented, k = 3", third);
    plane.text("plane", (0.0, 0.5), (-10.0, 0.0), "Lagrange");
    plane.text("penalty", (0.45, 1.8), (-10.0, -6.0), "penalty");
    plane.text("iterate", (0.16, 2.4), (12.0, 14.0), "augmented, k = 3");
    let caption = "The three methods for $\\varepsilon = 4$. Each replaces the corner by a line, and finds its intersection with \
                   equilibrium.";
    let description = "Intersections of the line of equilibrium, c p + N = R, with the line of each method, for ε = 4: \
                       p = 0 of the multiplier method, N = ε p of the penalty method, and N = λ + ε p of the augmented \
                       method after three steps.";
    plane.plot.figure("Three methods", caption, description)
}

/// Draws the plane as a bilateral constraint.
pub fn multiplier() -> Figure {
    let mut plane = Plane::of_example();
    plane.plot.line("plane thick", [(0.0, 0.0), (0.0, 9.0)]);
    plane.plot.line("plane thick dashed", [(0.0, 0.0), (0.0, -9.0)]);
    plane.mark("answer", "The multiplier method", plane.constrained());
    plane.text("", plane.constrained(), (12.0, -6.0), "u = Δ, λ = R");
    plane.text("plane", (0.0, 1.0), (-10.0, 0.0), "p = 0");
    plane.text("plane", (0.0, -0.2), (10.0, 5.0), "here the plane pulls");
    let caption = "The multiplier method replaces the corner by the line $p = 0$. Its lower half, dashed, is a plane to which the \
                   mass is glued.";
    let description = "The constraint p = 0 is the whole N axis; below N = 0, where the plane would pull, it is \
                       dashed. It meets the line of equilibrium, c p + N = R, in one point.";
    plane.plot.figure("The constraint as a line", caption, description)
}

/// Draws the second spring for three penalties.
pub fn penalties() -> Figure {
    let mut plane = Plane::of_example();
    plane.corner("plane thick ghost");
    let (soft, exact) = (plane.penalised(&Exact::from(4)), plane.solution());
    plane.plot.line("fine dashed", [exact, (soft.0, exact.1)]);
    plane.plot.dimension("fine", soft, (soft.0, exact.1));
    for eps in [4, 16, 36] {
        let stiffness = Exact::from(eps);
        plane.force("penalty", 1, |system, u| penalty::contact_force(system, &stiffness, u));
        plane.mark("penalty", &format!("ε = {eps}"), plane.penalised(&stiffness));
    }
    plane.mark("answer", "Exact", exact);
    plane.text("penalty", (0.06, 2.4), (0.0, -8.0), "ε = 36");
    plane.text("penalty", (0.19, 2.4), (0.0, -8.0), "ε = 16");
    plane.text("penalty", (0.6, 2.4), (-1.0, -8.0), "ε = 4");
    plane.text("", (soft.0, 1.65), (9.0, 0.0), "R − N");
    let caption = "The penalty replaces the corner by the line $N = \\varepsilon\\,p$. The spring carries the missing force, \
                   $R - N = c\\,p$.";
    let description = "Lines N = ε p through the origin, the steeper the larger ε, meet the line of equilibrium, \
                       c p + N = R, below the exact force. Its error, R − N, is c p.";
    plane.plot.figure("The penalty as a line", caption, description)
}

/// Draws the iterates of the augmentation.
pub fn iterates() -> Figure {
    let (mut plane, eps) = (Plane::of_example(), Exact::from(4));
    plane.corner("plane thick ghost");
    for (k, (lambda, at)) in plane.augmentations(&eps, 0).into_iter().enumerate() {
        let start = (0.0, float(&lambda));
        let end = augmented::update(&plane.system, &eps, &lambda, &deflection(&plane.system, 0.6));
        plane.plot.line("iterate fine dotted", [start, (0.6, float(&end))]);
        plane.plot.line("iterate", [start, at]);
        plane.plot.line("iterate fine dashed", [at, (0.0, at.1)]);
        plane.text("iterate", start, (-10.0, -7.0), &format!("λ_{k}"));
        plane.mark("iterate", &format!("k = {k}"), at);
    }
    plane.mark("answer", "Exact", plane.solution());
    plane.text("iterate", plane.penalised(&eps), (12.0, 5.0), "p_0, λ_1");
    let caption = "Augmentation shifts the line, $N = \\lambda_k + \\varepsilon\\,p$. Its intersection with equilibrium gives the \
                   next $\\lambda$, for $\\varepsilon = 4$.";
    let description = "Four parallel lines N = λ + ε p, for ε = 4, each from its λ on the N axis to the line of \
                       equilibrium; the first from λ = 0. The N of each is the λ of the next. They converge to the \
                       corner.";
    plane.plot.figure("The iterates move to the corner", caption, description)
}

/// Draws updates with different steps.
pub fn relaxed() -> Figure {
    let (mut plane, eps, start) = (Plane::of_example(), Exact::from(4), Exact::from(0));
    plane.corner("plane thick ghost");
    let u = augmented::deflection(&plane.system, &eps, &start);
    let mut points = Vec::new();
    for (step, class) in [(penalty::total_stiffness(&plane.system, &eps), "iterate dashed"), (eps, "iterate")]
    {
        plane.force(class, 1, |system, u| beyond::relaxed_update(system, &step, &start, u));
        let at = point(&plane.system, &u, &beyond::relaxed_update(&plane.system, &step, &start, &u));
        plane.plot.line("fine dashed", [at, (0.0, at.1)]);
        plane.mark("iterate", &format!("α = {step}"), at);
        points.push(at);
    }
    plane.plot.line("fine dashed", points);
    plane.mark("answer", "Exact", plane.solution());
    plane.text("iterate", (0.45, 1.8), (10.0, 8.0), "α = ε");
    plane.text("iterate", (0.3, 2.4), (8.0, 14.0), "α = c + ε");
    plane.text("iterate", (0.0, 1.0), (-10.0, 5.0), "λ_1");
    let caption = "One step from $\\lambda_0 = 0$ with $\\varepsilon = 4$: at the same $p_0$ the steeper line, $\\alpha = c + \\varepsilon$, \
                   is at the height of the solution.";
    let description = "Two lines N = α p through the origin, for ε = 4 and λ = 0. The line with α = ε meets \
                       equilibrium where N is the next λ. At the same p the line with α = c + ε has N = R: the \
                       solution in one step.";
    plane.plot.figure("Updates with different steps", caption, description)
}

/// Draws the augmentation of a separated system with unilateral contact.
pub fn bent() -> Figure {
    let (p, n) = (Axis::linear(P, -2.25, 0.75, 0.5), Axis::linear(N, -3.0, 5.0, 1.0));
    let (mut plane, eps, none) = (Plane::new(4, p, n, 340.0), Exact::from(4), Exact::from(0));
    plane.corner("plane thick");
    plane.force("penalty dashed", 1, |system, u| augmented::update(system, &eps, &none, u));
    let steps = plane.augmentations(&eps, 10);
    for (lambda, _) in &steps[..3] {
        // One of 60 parts is 0.05 m, and the lines bend at −0.75 m and at 0.
        plane.force("iterate", 60, |system, u| augmented::unilateral_update(system, &eps, lambda, u));
    }
    plane.equilibrium("spring");
    let (first, second, stuck) = (steps[0].1, steps[1].1, plane.augmented(&eps, &none));
    plane.mark("penalty", "No positive part in equilibrium", stuck);
    plane.mark("iterate", "k = 0", first);
    plane.mark("answer", "k = 1 and after", second);
    plane.text("iterate", first, (14.0, 5.0), "k = 0");
    plane.text("", second, (-6.0, 20.0), "k = 1, 2");
    plane.text("iterate", (-1.4, 4.4), (10.0, 5.0), "λ_0 = 10");
    plane.text("iterate", (-0.3, 1.8), (-8.0, 0.0), "λ_1 = 3");
    plane.text("iterate", (0.3, 0.9), (6.0, 5.0), "λ_2 = 0");
    plane.text("penalty", stuck, (-14.0, 5.0), "stuck, pulling");
    plane.text("spring", (-0.9, -1.5), (-1.0, 0.0), "c p + N = R");
    let caption = "A separated system ($c = \\varepsilon = 4$, $g = 4$, $R = -4$): the bent line \
                   $N = \\langle\\lambda_k + \\varepsilon\\,p\\rangle$ meets equilibrium on the other arm. Without the positive part (dashed), the plane pulls.";
    let description = "A system with R < 0, whose line of equilibrium meets the other arm of the corner, N = 0. Lines \
                       N = ⟨λ + ε p⟩ with ε = 4 lie on the p axis and then rise. From λ = 10 the first meets equilibrium \
                       above the p axis, the second on it, in the solution. The line N = ε p, without the positive \
                       part, continues below the axis: an update that is set to λ = 0 returns to its intersection with \
                       equilibrium in every step.";
    plane.plot.figure("The positive part as a bent line", caption, description)
}

/// Draws the step force of a penalty with a kink.
pub fn step() -> Figure {
    let mut plane = Plane::of_example();
    plane.corner("plane thick ghost");
    for (eps, class) in [(22, "penalty"), (10, "penalty dashed")] {
        // Any two points of a line determine its slope.
        let energy = |p: i32| beyond::exact_penalty(&tenths(eps), &tenths(p));
        let slope = |from: i32| float(&((energy(from + 1) - energy(from)) / tenths(1)));
        plane.plot.line(class, [(-0.2, slope(-5)), (0.0, slope(-5)), (0.0, slope(5)), (0.6, slope(5))]);
        plane.text("penalty", (0.5, slope(5)), (0.0, -6.0), &format!("ε = {}", number(slope(5))));
    }
    plane.mark("answer", "ε = 2.2", plane.solution());
    // On the lower step N acts as a known multiplier without a penalty.
    plane.mark("penalty", "ε = 1", plane.augmented(&Exact::from(0), &tenths(10)));
    let caption = "The force of the exact penalty is a step. If it is at least as high as $R$, equilibrium meets its vertical part, \
                   as with the corner.";
    let description = "The force of the penalty ε⟨p⟩ is a step: 0 above the plane, ε below it, any value between at \
                       p = 0. The line of equilibrium meets a step that is higher than R in its vertical part, exactly; \
                       it meets a lower one below the plane.";
    plane.plot.figure("The exact penalty as a step", caption, description)
}
