//! The bench: a page on which the augmented Lagrangian method runs in the browser.
//!
//! Its formulas are JavaScript generated from the records of the chapter's functions, each operation by way
//! of an object `K`, so that one text serves floats of 32 and 64 bits and fractions. Written by hand
//! is what a run comes to, `book/theme/bench_model.js`, and what is seen, `book/theme/bench.js`.

use anyhow::{Result, bail};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, rounding, structure, system};
use spring_mass_contact::number::{PositivePart, Tree, tree::Step};

/// The numbers that the bench reckons with, which need no page; without [`formulas`].
pub const MODEL: &str = include_str!("../../theme/bench_model.js");

/// What the reader sees and touches.
const PAGE: &str = include_str!("../../theme/bench.js");

/// The chapter's functions that the bench reckons with, by their names.
pub fn functions<T: PositivePart>(
    system: &SpringMass<T>,
    eps: &T,
    lambda: &T,
    u: &T,
    n: &T,
) -> Vec<(&'static str, T)> {
    macro_rules! named {
        ($($module:ident::$name:ident($($argument:ident),*))*) => {
            vec![$((concat!(stringify!($module), "::", stringify!($name)), $module::$name($($argument),*))),*]
        };
    }
    named! {
        system::gap(system)
        system::reaction(system)
        structure::deflection(system)
        contact::penetration(system, u)
        contact::deflection(system)
        contact::contact_force(system)
        augmented::deflection(system, eps, lambda)
        augmented::update(system, eps, lambda, u)
        augmented::unilateral_deflection(system, eps, lambda)
        augmented::unilateral_update(system, eps, lambda, u)
        augmented::contact_force(system, u)
        augmented::natural_residual(system, eps, lambda, u)
        augmented::contraction(system, eps)
        rounding::floor(system, eps, n)
        rounding::fixed_point_error(system, eps, lambda, n)
    }
}

/// The functions as JavaScript: `const formulas = K => ({ "system::gap": ({ H, l }) => K.sub(H, l), … });`.
/// The arguments are the quantities of the record, `eps` and `lambda` among them.
///
/// ```
/// let script = book_tool::bench::formulas()?;
/// assert!(script.contains(r#""contact::penetration": ({ H, l, u }) => K.sub(K.add(l, u), H),"#));
/// # Ok::<(), anyhow::Error>(())
/// ```
///
/// # Errors
/// A function computes what `K` has no name for.
pub fn formulas() -> Result<String> {
    let system = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| Tree::symbol(name));
    let [eps, lambda, u, n] = ["eps", "lambda", "u", "n"].map(|name| Tree::symbol(name));
    let mut script = String::from("const formulas = K => ({\n");
    for (name, tree) in functions(&system, &eps, &lambda, &u, &n) {
        let quantities = Vec::from_iter(tree.symbols()).join(", ");
        script += &format!("  \"{name}\": ({{ {quantities} }}) => {},\n", expression(&tree)?);
    }
    Ok(script + "});\n")
}

/// Step by step, in the order of the record: floats know no other.
fn expression(tree: &Tree) -> Result<String> {
    use Step::*;
    Ok(match tree.step() {
        Symbol(name) => name.to_string(),
        Int(n) => format!("K.int({n})"),
        Neg(a) => format!("K.neg({})", expression(a)?),
        Add(a, b) => format!("K.add({}, {})", expression(a)?, expression(b)?),
        Sub(a, b) => format!("K.sub({}, {})", expression(a)?, expression(b)?),
        Mul(a, b) => format!("K.mul({}, {})", expression(a)?, expression(b)?),
        Div(a, b) => format!("K.div({}, {})", expression(a)?, expression(b)?),
        PositivePart(a) => format!("K.positivePart({})", expression(a)?),
        Min(a, b) => format!("K.min({}, {})", expression(a)?, expression(b)?),
        Exp(_) | Rounded(_) => bail!("the bench has no {tree}"),
    })
}

/// What stands in the page: a still picture, and the script that puts the bench in its place.
///
/// # Errors
/// Those of [`formulas`].
pub fn html() -> Result<String> {
    let (formulas, still) = (formulas()?, still());
    Ok(format!(
        "<div class=\"bench\">\n{still}\n</div>\n\n\
         <script>\n(() => {{\n\"use strict\";\n{formulas}{MODEL}{PAGE}}})();\n</script>\n"
    ))
}

/// The first steps of the example with ε = 4 as forces over penetrations, computed by the chapter's functions.
fn still() -> String {
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    let (eps, gap) = (4.0, system::gap(&system));
    let [x, y] = [|p: f64| 60.0 + 520.0 * p, |n: f64| 210.0 - 90.0 * n];
    let point = |p, n| format!("{:.1} {:.1}", x(p), y(n));
    // Equilibrium, from where the plane pushes a little more than it has to, to where it does not.
    let held = |u: f64| point(contact::penetration(&system, &u), augmented::contact_force(&system, &u));
    let equilibrium = [gap - 0.05, structure::deflection(&system)].map(held).join("L");
    let (mut lambda, mut way, mut dots) = (0.0, format!("M{}", point(0.0, 0.0)), String::new());
    for _ in 0..5 {
        let u = augmented::deflection(&system, &eps, &lambda);
        lambda = augmented::update(&system, &eps, &lambda, &u);
        let p = contact::penetration(&system, &u);
        way += &format!("L{}H{:.1}", point(p, lambda), x(0.0));
        dots += &format!("<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\"/>", x(p), y(lambda));
    }
    let corner = format!("M10 {0:.1}H{1:.1}V10", y(0.0), x(0.0));
    let force = system::reaction(&system);
    format!(
        "<figure class=\"drawing\">\n\
         <svg viewBox=\"0 0 360 240\" role=\"img\" aria-labelledby=\"bench-still\" fill=\"none\" stroke-width=\"1.6\">\n\
         <title id=\"bench-still\">Forces over penetrations: the iterates climb along the line of equilibrium to the corner of the plane</title>\n\
         <path stroke=\"var(--figure-spring)\" d=\"M{equilibrium}\"/>\n\
         <path stroke=\"var(--figure-plane)\" stroke-width=\"3\" d=\"{corner}\"/>\n\
         <path stroke=\"var(--figure-iterate)\" d=\"{way}\"/>\n\
         <g fill=\"var(--figure-iterate)\">{dots}</g>\n\
         <text class=\"label\" x=\"38\" y=\"{y:.1}\">R</text><text class=\"label\" x=\"68\" y=\"20\">N</text>\
         <text class=\"label\" x=\"340\" y=\"230\">p</text>\n\
         </svg>\n\
         <figcaption>The first steps for the example with ε = 4. Where scripts may run, this is a bench: choose other numbers, \
         and step on.</figcaption>\n</figure>",
        y = y(force) + 24.0,
    )
}
