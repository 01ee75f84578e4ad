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

/// What stands in the page: where to find the picture that stands still, and the script that puts the bench in
/// the place of that.
///
/// # Errors
/// Those of [`formulas`].
pub fn html() -> Result<String> {
    let formulas = formulas()?;
    Ok(format!(
        "<div class=\"bench\">\n{STILL}\n</div>\n\n\
         <script>\n(() => {{\n\"use strict\";\n{formulas}{MODEL}{PAGE}}})();\n</script>\n"
    ))
}

/// For who runs no scripts, and on paper.
const STILL: &str = "<p>Where scripts may run, a bench stands here, on which all of this moves. Its first steps for the example stand \
                     still in the <a href=\"#fig-augmented\">picture above</a>.</p>";
