//! The functions of the chapter as formulas, by section.

use super::{augmented, beyond, contact, lagrange, ode, penalty, rounding, structure, system};
use crate::formula::Formula;
use crate::number::{Exponential, PositivePart, Tree};
use std::cell::RefCell;

/// Defines the formulas of a section: `"p" = contact::penetration(&system, &x("u")).abbreviated();`, where
/// `system` is the five parameters and `x` returns a quantity.
///
/// A value without a symbol is a residual, a side of an equation, or has no name in the chapter. A value that
/// is one of several has a name and a pattern.
macro_rules! formulas {
    (|$system:ident, $x:ident|
     $($symbol:literal = $module:ident::$name:ident($($argument:expr),*)
       $([$part:literal: $pattern:pat_param => $value:expr])? $(.$with:ident($($of:literal)?))*;)*) => {
        /// Returns the section's functions with their values in a number system.
        #[allow(unused_variables, reason = "some functions have no arguments but the parameters")]
        pub(super) fn formulas<T>(symbol: &impl Fn(&'static str) -> T) -> Vec<crate::claims::formulas::RecordedValue<T>>
        where
            T: crate::number::PositivePart + crate::number::Exponential,
        {
            let $system = crate::chapter::SpringMass::SYMBOLS.map(|name| symbol(name));
            vec![$({
                let arguments = std::cell::RefCell::default();
                let $x = |name| crate::claims::formulas::argument(name, symbol, &arguments);
                let value = $module::$name($($argument),*);
                $(let $pattern = value; let value = $value;)?
                crate::claims::formulas::RecordedValue {
                    value,
                    arguments: arguments.into_inner(),
                    formula: |arguments, tree| {
                        let path = concat!(stringify!($module), "::", stringify!($name));
                        let formula = crate::formula::Formula::new(path, $symbol, arguments, tree);
                        formula$(.part($part))?$(.$with($($of)?))*
                    },
                }
            }),*]
        }
    };
}
pub(super) use formulas;

/// A value of a function of the chapter.
pub(super) struct RecordedValue<T> {
    pub(super) value: T,
    /// Names of the arguments, except for the five parameters.
    pub(super) arguments: Vec<&'static str>,
    /// Returns the record of the function for its arguments and its formula.
    pub(super) formula: fn(&[&'static str], Tree) -> Formula,
}

/// Returns the value of an argument, and adds its name to those of the function.
pub(super) fn argument<T>(
    name: &'static str,
    symbol: &impl Fn(&'static str) -> T,
    names: &RefCell<Vec<&'static str>>,
) -> T {
    names.borrow_mut().push(name);
    symbol(name)
}

/// Returns the functions of all sections with their values in a number system, each after those it calls.
fn values<T: PositivePart + Exponential>(symbol: &impl Fn(&'static str) -> T) -> Vec<RecordedValue<T>> {
    let mut all = system::formulas(symbol);
    all.extend(structure::formulas(symbol));
    all.extend(contact::formulas(symbol));
    all.extend(lagrange::formulas(symbol));
    all.extend(penalty::formulas(symbol));
    all.extend(augmented::formulas(symbol));
    all.extend(ode::formulas(symbol));
    all.extend(rounding::formulas(symbol));
    all.extend(beyond::formulas(symbol));
    all
}

/// Returns the value of each function of the [`registry`](super::registry) in a number system, in its order,
/// computed by the functions themselves and not by their records.
pub fn computed<T: PositivePart + Exponential>(symbol: &impl Fn(&'static str) -> T) -> Vec<T> {
    values(symbol).into_iter().map(|of| of.value).collect()
}

/// Returns every function of the chapter that has a formula, each after those it calls.
pub(super) fn recorded() -> Vec<Formula> {
    let all = values(&|name| Tree::symbol(name)).into_iter();
    all.map(|of| (of.formula)(&of.arguments, of.value)).collect()
}

#[cfg(test)]
mod tests {
    use crate::chapter::{SpringMass, augmented, contact, lagrange, ode, system};
    use crate::claims::registry;
    use crate::formula::Notation;
    use crate::number::Tree;

    #[test]
    fn a_call_is_identified_by_its_source_location() {
        let formula = |path: &str| registry().formula(path).unwrap();
        // (1.11) contains l + u − H itself, (1.12) calls (1.5).
        let within = |path: &str, callee: &str| {
            formula(path).tree.any(&|t| registry().call(t).is_some_and(|c| c.formula.path == callee))
        };
        assert!(within("penalty::contact_force", "contact::penetration"));
        assert!(!within("penalty::residual", "contact::penetration"));
        assert_eq!(
            registry().delegated_call(formula("lagrange::multiplier")).unwrap().formula.path,
            "system::reaction"
        );
        assert!(registry().delegated_call(formula("system::reaction")).is_none());
    }

    #[test]
    fn the_argument_of_a_call_is_found() {
        let own = SpringMass::SYMBOLS.map(|name| Tree::symbol(name));
        let argument = system::gap(&own) * Tree::symbol("x");
        let call = registry().call(&contact::penetration(&own, &argument)).unwrap();
        assert_eq!((call.formula.path, call.arguments), ("contact::penetration", vec![argument]));
    }

    #[test]
    fn a_call_omits_arguments_that_its_value_ignores() {
        let own = SpringMass::SYMBOLS.map(|name| Tree::symbol(name));
        let [u, n] = ["u", "n"].map(|name| Tree::symbol(name));
        let call = registry().call(&contact::kkt(&own, &u, &n).dual).unwrap();
        assert_eq!((call.formula.name().as_str(), call.arguments), ("contact::kkt.dual", vec![n]));
    }

    #[test]
    fn a_returned_value_is_a_call_of_several_functions() {
        let own = SpringMass::SYMBOLS.map(|name| Tree::symbol(name));
        let names = |tree: &Tree| registry().calls(tree).map(|call| call.formula.name()).collect::<Vec<_>>();
        assert_eq!(names(&system::gap(&own)), ["system::gap", "lagrange::deflection"]);
        let [eps, u, t] = ["ε", "x", "t"].map(|name| Tree::symbol(name));
        // A solution with any constant A is not the solution of an initial value problem.
        assert_eq!(names(&ode::general(&own, &eps, &u, &t)), ["ode::superposition", "ode::general"]);
        let all = ["ode::superposition", "ode::general", "ode::solution"];
        assert_eq!(names(&ode::solution(&own, &eps, &u, &t)), all);
    }

    #[test]
    fn a_call_lists_arguments_that_differ_from_its_definition() {
        let own = SpringMass::SYMBOLS.map(|name| Tree::symbol(name));
        let [u, eps, lambda] = ["u", "ε", "λ"].map(|name| Tree::symbol(name));
        let (gap, r) = (system::gap(&own), system::reaction(&own));
        for (tree, text) in [
            (contact::penetration(&own, &u), "p"),
            (contact::penetration(&own, &(&u + &gap)), "p(u + Δ)"),
            (lagrange::functional(&own, &u, &r), "𝓛(u, R)"),
            (augmented::functional(&own, &eps, &lambda, &u), "L"),
            (augmented::functional(&own, &eps, &r, &gap), "L(ε, R, Δ)"),
            (augmented::contraction(&own, &(&eps + &r)), "ρ(ε + R)"),
        ] {
            assert_eq!(registry().format_tree(&tree), text);
        }
    }

    #[test]
    fn placeholders_are_replaced_by_formulas() {
        for (template, text, latex) in [
            ("no hole", "no hole", "no hole"),
            ("«system::gap» < 0", "H − l < 0", "H - l < 0"),
            (
                "«augmented::update: u=u_{k−1}, λ=λ₀»",
                "λ₀ + ε (l + u_{k−1} − H)",
                r"\lambda_0 + \varepsilon\,(l + u_{k-1} - H)",
            ),
            ("«penalty::contact_force: u=u_k»", "ε p(u_k)", r"\varepsilon\,p(u_k)"),
            ("«penalty::contact_force in full»", "ε (l + u − H)", r"\varepsilon\,(l + u - H)"),
            ("«lagrange::residual.constraint», «contact::kkt.dual»", "p, ⟨−N⟩", r"p, \langle -N \rangle"),
            // These names do not exist.
            (
                "«system::gap: x=y» «system::gap",
                "«system::gap: x=y» «system::gap",
                "«system::gap: x=y» «system::gap",
            ),
            ("a » b «nothing» c", "a » b «nothing» c", "a » b «nothing» c"),
            ("«system::gap: H»", "«system::gap: H»", "«system::gap: H»"),
        ] {
            assert_eq!(
                [Notation::Text, Notation::Latex].map(|n| registry().render_template(template, n)),
                [text, latex]
            );
        }
    }

    #[test]
    fn every_formula_comes_after_those_it_calls() {
        for (i, formula) in registry().formulas().iter().enumerate() {
            formula.tree.visit(&mut |tree| {
                if let Some(call) = registry().call(tree) {
                    let place =
                        registry().formulas().iter().position(|f| f.name() == call.formula.name()).unwrap();
                    assert!(place <= i, "{} calls {}", formula.name(), call.formula.name());
                }
            });
        }
    }
}
