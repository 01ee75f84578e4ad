//! Drawings of the system to scale.

use super::Figure;
use super::svg::{Svg, number};
use spring_mass_contact::chapter::{SpringMass, contact, penalty, structure, system};

/// Pixels per metre and per newton.
const METRE: f64 = 72.0;
const NEWTON: f64 = 8.0;

/// Vertical position of the support, and horizontal position of the mass, in pixels.
const SUPPORT: f64 = 30.0;
const MIDDLE: f64 = 170.0;

const RADIUS: f64 = 12.0;

/// Returns the vertical position in pixels of a depth below the support in metres.
fn level(depth: f64) -> f64 {
    SUPPORT + METRE * depth
}

/// Draws a fixed surface, hatched away from the mass.
fn fixed(svg: &mut Svg, class: &str, depth: f64, away: f64) {
    horizontal(svg, class, depth, MIDDLE - 80.0, MIDDLE + 80.0);
    for i in 0..12 {
        let (x, y) = (MIDDLE - 78.0 + 14.0 * f64::from(i), level(depth));
        svg.path("fine", &[(x, y), (x - 8.0 * away, y + 8.0 * away)]);
    }
}

/// Draws a spring between two depths, with its stiffness.
fn spring(svg: &mut Svg, class: &str, from: f64, to: f64, name: &str) {
    const COILS: u32 = 8;
    let (top, bottom) = (level(from), level(to));
    let end = (bottom - top) * 0.07;
    let coil = (bottom - top - 2.0 * end) / f64::from(2 * COILS);
    let mut points = vec![(MIDDLE, top), (MIDDLE, top + end)];
    for i in 0..2 * COILS {
        let side = if i % 2 == 0 { 13.0 } else { -13.0 };
        points.push((MIDDLE + side, top + end + coil * (f64::from(i) + 0.5)));
    }
    points.extend([(MIDDLE, bottom - end), (MIDDLE, bottom)]);
    svg.path(class, &points);
    svg.text(class, (MIDDLE, 0.6 * top + 0.4 * bottom), (-20.0, 4.0), name);
}

/// Draws the mass at a depth.
fn mass(svg: &mut Svg, depth: f64) {
    svg.disc("disc", (MIDDLE, level(depth)), RADIUS, "the mass");
    svg.text("", (MIDDLE, level(depth)), (-18.0, 16.0), "m");
}

/// Draws a force on the mass at a depth, this far beside it, upwards if it is positive.
fn force(svg: &mut Svg, class: &str, aside: f64, depth: f64, newtons: f64, name: &str) {
    let (x, y) = (MIDDLE + aside, level(depth));
    let to = y - NEWTON * newtons;
    svg.arrow(&format!("{class} force"), (x, y), (x, to));
    svg.text(class, (x, (y + to) / 2.0), (8.0, 5.0), name);
    svg.labels.push(format!("{name} = {} N", number(newtons.abs())));
}

/// Draws the dimension between two depths, beside the system.
fn distance(svg: &mut Svg, x: f64, from: f64, to: f64, name: &str) {
    let (top, bottom) = (level(from), level(to));
    svg.dimension("fine", (x, top), (x, bottom));
    // The letter stands beside the arrows, or outside the lines if these are too close.
    let aside: f64 = if (bottom - top).abs() < 24.0 { 14.0 } else { 7.0 };
    svg.text("", (x, (top + bottom) / 2.0), (aside.copysign(x - MIDDLE), 5.0), name);
    svg.labels.push(format!("{name} = {} m", number(to - from)));
}

/// Draws a horizontal line at a depth.
fn horizontal(svg: &mut Svg, class: &str, depth: f64, from: f64, to: f64) {
    svg.path(class, &[(from, level(depth)), (to, level(depth))]);
}

/// Draws Fig. 1.1: the system at rest, separated.
pub fn system() -> Figure {
    let system = SpringMass { c: 4.0, m: 1.0, g: 4.0, l: 1.0, h: 3.0 };
    let u = contact::deflection(&system);
    let depth = system.l + u;
    let mut svg = Svg { height: level(system.h) + 16.0, ..Svg::default() };
    fixed(&mut svg, "", 0.0, -1.0);
    fixed(&mut svg, "plane", system.h, 1.0);
    spring(&mut svg, "spring", 0.0, depth, "c");
    horizontal(&mut svg, "fine", 0.0, 40.0, 86.0);
    horizontal(&mut svg, "fine", 0.0, 254.0, 322.0);
    horizontal(&mut svg, "fine", system.h, 254.0, 322.0);
    horizontal(&mut svg, "fine dashed", system.l, 40.0, MIDDLE - 20.0);
    horizontal(&mut svg, "fine", depth, 40.0, MIDDLE - RADIUS);
    horizontal(&mut svg, "fine", depth, MIDDLE + RADIUS + 18.0, 270.0);
    distance(&mut svg, 50.0, 0.0, system.l, "l");
    distance(&mut svg, 50.0, system.l, depth, "u");
    distance(&mut svg, 312.0, 0.0, system.h, "H");
    distance(&mut svg, 262.0, depth, depth - contact::penetration(&system, &u), "−p");
    mass(&mut svg, depth);
    force(&mut svg, "spring", 22.0, depth, structure::spring_force(&system, &u), "c u");
    force(&mut svg, "weight", 22.0, depth, -system::weight(&system), "m g");
    let caption = "Fig. 1.1. The system, drawn separated ($g = 4$): above the plane the penetration is negative. Forces and lengths \
                   are to scale.";
    let description = "A mass hangs from a fixed support by a spring, above a fixed plane. Dimensions beside it: the \
                       length l of the spring and the deflection u, and between the mass and the plane the \
                       remaining gap −p, which add up to the height H of the support above the plane. Two arrows \
                       at the mass: the spring pulls up with c u, the weight is m g.";
    Figure::new("The system", caption, description, svg)
}

/// Draws Fig. 1.2: the plane as a second spring.
pub fn second_spring() -> Figure {
    let (system, eps) = (SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 }, 4.0);
    let u = penalty::deflection(&system, &eps);
    let depth = system.l + u;
    // The length of the second spring is arbitrary.
    let ground = system.h + 1.4;
    let mut svg = Svg { height: level(ground) + 16.0, ..Svg::default() };
    fixed(&mut svg, "", 0.0, -1.0);
    fixed(&mut svg, "", ground, 1.0);
    spring(&mut svg, "spring", 0.0, depth, "c");
    spring(&mut svg, "penalty", depth, ground, "ε");
    horizontal(&mut svg, "plane dashed", system.h, 60.0, 322.0);
    horizontal(&mut svg, "fine", depth, MIDDLE + 84.0, 322.0);
    distance(&mut svg, 312.0, system.h, system.h + contact::penetration(&system, &u), "p");
    mass(&mut svg, depth);
    force(&mut svg, "spring", 22.0, depth, structure::spring_force(&system, &u), "c u");
    force(&mut svg, "penalty", 36.0, depth, penalty::contact_force(&system, &eps, &u), "ε p");
    force(&mut svg, "weight", 22.0, depth, -system::weight(&system), "m g");
    svg.text("plane", (59.0, level(system.h)), (1.0, -8.0), "plane");
    let caption = "Fig. 1.2. The penalty as a second spring, relaxed when the mass is at the level of the plane. Forces and lengths \
                   are to scale, for $\\varepsilon = 4$.";
    let description = "The mass hangs from a spring of stiffness c and has sunk by p below the level of the plane. \
                       There it compresses a second spring, of stiffness ε, which stands on the ground. Arrows at the \
                       mass: the weight m g is carried by c u of the first spring and by ε p of the second.";
    Figure::new("The penalty as a second spring", caption, description, svg)
}
