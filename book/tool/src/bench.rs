//! The bench: an interactive element that runs the augmented Lagrangian method in the browser.
//!
//! Its formulas are JavaScript generated from the records of the chapter's functions. Each operation is a method of
//! an object `K`, so that one script serves floats of 32 and 64 bits and fractions. The analysis of a run,
//! `book/theme/bench_model.js`, and the user interface, `book/theme/bench.js`, are written by hand.

use anyhow::{Result, bail};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, ode, rounding, structure, system};
use spring_mass_contact::number::{PositivePart, Tree, tree::Op};

/// Arithmetic and analysis of a run, independent of the page; requires the script of [`formulas`].
pub const MODEL: &str = include_str!("../../theme/bench_model.js");

/// User interface.
pub const PAGE: &str =
    concat!(include_str!("../../theme/bench.js"), include_str!("../../theme/bench_flow.js"));

/// Evaluates the chapter's functions that the bench uses, and returns their names and values.
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
        ode::velocity(system, eps, u)
        rounding::floor_scale(system, eps, n)
        rounding::fixed_point_error(system, eps, lambda, n)
    }
}

/// Returns the functions as JavaScript: `const formulas = K => ({ "system::gap": ({ H, l }) => K.sub(H, l), … });`.
///
/// The arguments of each are the symbols of its record, such as `eps` and `lambda`. The solution (1.30), which contains
/// an exponential, follows as `const solution = K => …`.
///
/// # Errors
/// Returns an error if a function uses an operation that `K` does not have.
///
/// # Examples
/// ```
/// let script = book_tool::bench::formulas()?;
/// assert!(script.contains(r#""contact::penetration": ({ H, l, u }) => K.sub(K.add(l, u), H),"#));
/// # Ok::<(), anyhow::Error>(())
/// ```
pub fn formulas() -> Result<String> {
    let system = SpringMass::SYMBOLS.map(|name| Tree::symbol(name));
    let [eps, lambda, u, n] = ["eps", "lambda", "u", "n"].map(|name| Tree::symbol(name));
    let mut script = String::from("const formulas = K => ({\n");
    for (name, tree) in functions(&system, &eps, &lambda, &u, &n) {
        script += &format!("  \"{name}\": {},\n", function(&tree)?);
    }
    let solution = ode::solution(&system, &eps, &u, &Tree::symbol("t"));
    Ok(script + &format!("}});\nconst solution = K => {};\n", function(&solution)?))
}

/// Returns a function of the symbols of a formula.
fn function(tree: &Tree) -> Result<String> {
    let quantities = Vec::from_iter(tree.symbols()).join(", ");
    Ok(format!("({{ {quantities} }}) => {}", to_javascript(tree)?))
}

/// Returns a formula as nested calls in the order of the record, which determines the rounding.
fn to_javascript(tree: &Tree) -> Result<String> {
    use Op::*;
    Ok(match tree.op() {
        Symbol(name) => name.to_string(),
        Int(n) => format!("K.int({n})"),
        Neg(a) => format!("K.neg({})", to_javascript(a)?),
        Add(a, b) => format!("K.add({}, {})", to_javascript(a)?, to_javascript(b)?),
        Sub(a, b) => format!("K.sub({}, {})", to_javascript(a)?, to_javascript(b)?),
        Mul(a, b) => format!("K.mul({}, {})", to_javascript(a)?, to_javascript(b)?),
        Div(a, b) => format!("K.div({}, {})", to_javascript(a)?, to_javascript(b)?),
        PositivePart(a) => format!("K.positivePart({})", to_javascript(a)?),
        Min(a, b) => format!("K.min({}, {})", to_javascript(a)?, to_javascript(b)?),
        Exp(a) => format!("K.exp({})", to_javascript(a)?),
        Rounded(_) => bail!("the bench has no {tree}"),
    })
}

/// Returns the HTML of the bench. Where the script runs, it replaces a figure directly before it, and shows the
/// elements of the class `bench-text`, which are hidden otherwise and in print.
///
/// # Errors
/// Returns the errors of [`formulas`].
pub fn html() -> Result<String> {
    element("bench", "")
}

/// Returns the HTML of a small figure that moves: `fields` are the symbols of its sliders, and it shows the state
/// after `k` augmentations of the example, or the solution if `k` is `None`. The field `x` alone shows explicit Euler
/// steps of that size for (1.23). It replaces a figure like the [bench](html).
///
/// # Errors
/// Returns the errors of [`formulas`].
pub fn live(fields: &str, k: Option<u32>) -> Result<String> {
    // The error of the example is below a pixel after 40 augmentations.
    let (class, k) = match k {
        _ if fields == "x" => ("bench", 0),
        Some(k) => ("bench bench-small", k),
        None => ("bench bench-small bench-solved", 40),
    };
    element(class, &format!(" data-fields=\"{fields}\" data-k=\"{k}\""))
}

/// Returns an element with its script.
fn element(class: &str, data: &str) -> Result<String> {
    Ok(format!("<div class=\"{class}\"{data}></div>\n\n<script>\n{}</script>\n", script()?))
}

/// Returns the script of the bench and of the small figures.
///
/// # Errors
/// Returns the errors of [`formulas`].
pub fn script() -> Result<String> {
    Ok(format!("(() => {{\n\"use strict\";\n{}{MODEL}{PAGE}}})();\n", formulas()?))
}
