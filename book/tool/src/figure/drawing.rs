//! Drawings of the system to scale.

use super::Figure;
use super::svg::{Anchor::*, Point, Svg, number};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, penalty, structure, system};

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
fn fixed(svg: &mut Svg, class: &str, y: f64, away: f64) {
    svg.path(class, &[(MIDDLE - 80.0, y), (MIDDLE + 80.0, y)]);
    for i in 0..12 {
        let x = MIDDLE - 78.0 + 14.0 * f64::from(i);
        svg.path("fine", &[(x, y), (x - 8.0 * away, y + 8.0 * away)]);
    }
}

/// Draws a spring between two depths in metres.
fn spring(svg: &mut Svg, class: &str, from: f64, to: f64) {
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
}

/// Draws a force on the mass, upwards if it is positive.
fn force(svg: &mut Svg, class: &str, from: Point, newtons: f64, name: &str, anchor: super::svg::Anchor) {
    let to = (from.0, from.1 - NEWTON * newtons);
    svg.arrow(class, from, to);
    let aside = match anchor {
        End => -8.0,
        _ => 8.0,
    };
    svg.text(
        class.split(' ').next().unwrap_or_default(),
        (to.0 + aside, (from.1 + to.1) / 2.0 + 5.0),
        anchor,
        name,
    );
}

/// Draws the dimension between two depths, beside the system.
fn distance(svg: &mut Svg, x: f64, from: f64, to: f64, name: &str) {
    let (from, to) = (level(from), level(to));
    svg.dimension("fine", (x, from), (x, to));
    let side = if x < MIDDLE { End } else { Start };
    // The letter stands beside the arrows, or outside the lines if these are too close.
    let far = if (to - from).abs() < 24.0 { 14.0 } else { 7.0 };
    let aside = if x < MIDDLE { -far } else { far };
    svg.text("", (x + aside, (from + to) / 2.0 + 5.0), side, name);
}

/// Draws a horizontal line at a depth.
fn mark_level(svg: &mut Svg, class: &str, depth: f64, from: f64, to: f64) {
    svg.path(class, &[(from, level(depth)), (to, level(depth))]);
}

/// Draws Fig. 1.1: the system at rest, separated.
pub fn system() -> Figure {
    let system = SpringMass { c: 4.0, m: 1.0, g: 4.0, l: 1.0, h: 3.0 };
    let u = contact::deflection(&system);
    let (depth, p) = (system.l + u, contact::penetration(&system, &u));
    let (pull, weight) = (structure::spring_force(&system, &u), system::weight(&system));
    let mut svg = Svg::default();
    fixed(&mut svg, "", level(0.0), -1.0);
    fixed(&mut svg, "plane", level(system.h), 1.0);
    spring(&mut svg, "spring", 0.0, depth);
    mark_level(&mut svg, "fine", 0.0, 40.0, 86.0);
    mark_level(&mut svg, "fine", 0.0, 254.0, 322.0);
    mark_level(&mut svg, "fine", system.h, 254.0, 322.0);
    mark_level(&mut svg, "fine dashed", system.l, 40.0, MIDDLE - 20.0);
    mark_level(&mut svg, "fine", depth, 40.0, MIDDLE - RADIUS);
    mark_level(&mut svg, "fine", depth, MIDDLE + RADIUS + 18.0, 270.0);
    distance(&mut svg, 50.0, 0.0, system.l, "l");
    distance(&mut svg, 50.0, system.l, depth, "u");
    distance(&mut svg, 312.0, 0.0, system.h, "H");
    distance(&mut svg, 262.0, depth, system.h, "−p");
    svg.disc((MIDDLE, level(depth)), RADIUS);
    force(&mut svg, "spring force", (MIDDLE + 22.0, level(depth)), pull, "c u", Start);
    force(&mut svg, "force", (MIDDLE + 22.0, level(depth)), -weight, "m g", Start);
    svg.text("spring", (MIDDLE - 20.0, level(depth / 3.0)), End, "c");
    svg.text("", (MIDDLE - 18.0, level(depth) + 18.0), End, "m");
    let description = format!(
        "A spring hangs from a support and carries a mass; below the mass is a rigid plane. From the support down: the free \
         length l = {} of the spring, the deflection u = {}, and between the mass and the plane the remaining gap −p = {}, \
         which add up to the height H = {} of the support above the plane. Two arrows of the same length at the mass: the \
         spring pulls up with c u = {} N, the weight is m g = {} N.",
        number(system.l),
        number(u),
        number(-p),
        number(system.h),
        number(pull),
        number(weight),
    );
    Figure {
        name: "",
        title: "The system",
        caption: "Fig. 1.1. The system, drawn separated ($g = 4$): above the plane the penetration is negative. Forces and lengths \
                  are to scale.",
        description,
        size: (super::axes::WIDTH, level(system.h) + 16.0),
        body: svg.body,
    }
}

/// Draws Fig. 1.2: the plane as a second spring.
pub fn second_spring() -> Figure {
    let (system, eps) = (SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 }, 4.0);
    let u = penalty::deflection(&system, &eps);
    let (depth, p) = (system.l + u, contact::penetration(&system, &u));
    let (pull, weight) = (structure::spring_force(&system, &u), system::weight(&system));
    let push = penalty::contact_force(&system, &eps, &u);
    let missing = augmented::contact_force(&system, &u);
    // The length of the second spring is arbitrary.
    let ground = system.h + 1.4;
    let mut svg = Svg::default();
    fixed(&mut svg, "", level(0.0), -1.0);
    fixed(&mut svg, "", level(ground), 1.0);
    spring(&mut svg, "spring", 0.0, depth);
    spring(&mut svg, "penalty", depth, ground);
    mark_level(&mut svg, "plane dashed", system.h, 60.0, 322.0);
    mark_level(&mut svg, "fine", depth, MIDDLE + 84.0, 322.0);
    distance(&mut svg, 312.0, system.h, depth, "p");
    svg.disc((MIDDLE, level(depth)), RADIUS);
    force(&mut svg, "spring force", (MIDDLE + 22.0, level(depth)), pull, "c u", Start);
    force(&mut svg, "penalty force", (MIDDLE + 36.0, level(depth)), push, "ε p", Start);
    force(&mut svg, "force", (MIDDLE + 22.0, level(depth)), -weight, "m g", Start);
    svg.text("spring", (MIDDLE - 20.0, level(depth / 2.0)), End, "c");
    svg.text("penalty", (MIDDLE - 20.0, level((depth + ground) / 2.0) + 8.0), End, "ε");
    svg.text("", (MIDDLE - 18.0, level(depth) + 16.0), End, "m");
    svg.text("plane", (60.0, level(system.h) - 8.0), Start, "plane");
    let description = format!(
        "The mass hangs from a spring of stiffness c and has sunk p = {} below the level of the plane. There it compresses a \
         second spring, of stiffness ε = {}, which stands on the ground. Arrows at the mass: the weight m g = {} N is \
         carried by c u = {} N of the first spring and ε p = {} N of the second, exactly the remaining {} N.",
        number(p),
        number(eps),
        number(weight),
        number(pull),
        number(push),
        number(missing),
    );
    Figure {
        name: "",
        title: "The penalty as a second spring",
        caption: "Fig. 1.2. The penalty as a second spring, relaxed when the mass is at the level of the plane. Forces and lengths \
                  are to scale, for $\\varepsilon = 4$.",
        description,
        size: (super::axes::WIDTH, level(ground) + 16.0),
        body: svg.body,
    }
}
