//! Lagrange multiplier: (1.7), (1.8), Remark 1.3.1.

use super::prelude::*;
use crate::chapter::contact;
use crate::chapter::lagrange::{self, *};

formulas! {
    |system, x|
    "𝓛" = lagrange::functional(&system, &x("u"), &x("λ")).abbreviated();
    "" = lagrange::residual(&system, &x("u"), &x("λ")) ["equilibrium": [equilibrium, _] => equilibrium];
    "" = lagrange::residual(&system, &x("u"), &x("λ")) ["constraint": [_, constraint] => constraint];
    "u" = lagrange::deflection(&system);
    "λ" = lagrange::multiplier(&system);
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![eq_1_7(), eq_1_8(), remark_1_3_1()]
}

fn eq_1_7() -> Entry {
    let Case { system: s, u, lambda, .. } = symbols();
    let [equilibrium, constraint] = residual(s, u, lambda);
    Entry::new("1.7", "Lagrange functional")
        .states("𝓛(u, λ) = «lagrange::functional» is stationary at its only saddle point")
        .in_latex(r"\mathcal{L}(u, \lambda) = «lagrange::functional»")
        .functions(["lagrange::functional"])
        .follows_from(["1.4", "1.5"])
        .claims([
            derivative("by-deflection", functional(s, u, lambda), u, equilibrium),
            derivative("by-multiplier", functional(s, u, lambda), lambda, constraint),
            equal("hessian", hessian_determinant(), -1),
        ])
}

fn eq_1_8() -> Entry {
    let Case { system: s, u, lambda, .. } = symbols();
    let Hypotheses { in_contact, .. } = hypotheses();
    let [equilibrium, constraint] = residual(s, u, lambda);
    let [solved_equilibrium, solved_constraint] = residual(s, &deflection(s), &multiplier(s));
    Entry::new("1.8", "Lagrange system")
        .states(
            "«lagrange::residual.equilibrium» = 0 and «contact::penetration» = 0 have the only \
             solution u = «lagrange::deflection», λ = «lagrange::multiplier»",
        )
        .in_latex(concat!(
            r"\left\{\begin{aligned} «lagrange::residual.equilibrium» &= 0 ",
            r"\\ «contact::penetration» &= 0 \end{aligned}\right.",
        ))
        .functions(["lagrange::residual", "lagrange::deflection", "lagrange::multiplier"])
        .follows_from(["1.7"])
        .claims([
            equal("equilibrium", solved_equilibrium, 0),
            equal("constraint", solved_constraint, 0),
            equal("unique-deflection", &constraint, u - deflection(s)),
            equal("unique-multiplier", equilibrium - &s.c * constraint, lambda - multiplier(s)),
            equal("complementary", contact::penetration(s, &deflection(s)) * multiplier(s), 0),
            equal("kkt-with-multiplier", multiplier(s), contact::contact_force(s)).assuming([in_contact]),
        ])
}

fn remark_1_3_1() -> Entry {
    let Case { system: s, .. } = symbols();
    Entry::new("Remark 1.3.1", "Exact at the price of an unknown")
        .states("p = 0 exactly")
        .functions(["lagrange::deflection"])
        .follows_from(["1.8"])
        .claims([equal("exact", contact::penetration(s, &deflection(s)), 0)])
}

/// Determinant of the Hessian of (1.7): both partial derivatives of the two lines of (1.8).
fn hessian_determinant() -> Tree {
    let Case { u, lambda, .. } = symbols();
    let [[a, c], [b, d]] = [u, lambda].map(|variable| {
        let dual = symbols().with_dual_variable(variable);
        residual(&dual.system, &dual.u, &dual.lambda).map(|line| line.derivative)
    });
    a * d - b * c
}
