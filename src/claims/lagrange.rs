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
    let Case { system: s, u, lambda, .. } = symbols();
    let Hypotheses { in_contact, .. } = hypotheses();
    vec![
        Entry::new("1.7", "Lagrange functional")
            .states("𝓛(u, λ) = «lagrange::functional» is stationary at its only saddle point")
            .in_latex(r"\mathcal{L}(u, \lambda) = «lagrange::functional»")
            .functions(["lagrange::functional"])
            .follows_from(["1.4", "1.5"])
            .claims([
                {
                    let [first, _] = residual(s, u, lambda);
                    derivative("by-deflection", functional(s, u, lambda), u, first)
                },
                {
                    let [_, second] = residual(s, u, lambda);
                    derivative("by-multiplier", functional(s, u, lambda), lambda, second)
                },
                equal("hessian", hessian_determinant(), -1),
            ]),
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
                {
                    let [first, _] = residual(s, &deflection(s), &multiplier(s));
                    equal("equilibrium", first, 0)
                },
                {
                    let [_, second] = residual(s, &deflection(s), &multiplier(s));
                    equal("constraint", second, 0)
                },
                {
                    let [_, second] = residual(s, u, lambda);
                    equal("unique-deflection", second, u - deflection(s))
                },
                {
                    let [first, second] = residual(s, u, lambda);
                    equal("unique-multiplier", first - &s.c * second, lambda - multiplier(s))
                },
                equal("complementary", contact::penetration(s, &deflection(s)) * multiplier(s), 0),
                equal("kkt-with-multiplier", multiplier(s), contact::contact_force(s)).assuming([in_contact]),
            ]),
        Entry::new("Remark 1.3.1", "Exact at the price of an unknown")
            .states("p = 0 exactly")
            .functions(["lagrange::deflection"])
            .follows_from(["1.8"])
            .claims([equal("exact", contact::penetration(s, &deflection(s)), 0)]),
    ]
}

/// Determinant of the Hessian of (1.7): both partial derivatives of the two lines of (1.8).
fn hessian_determinant() -> Tree {
    let Case { u, lambda, .. } = symbols();
    let along = |by| {
        let dual = symbols().with_dual_variable(by);
        residual(&dual.system, &dual.u, &dual.lambda).map(|line| line.derivative)
    };
    let ([a, c], [b, d]) = (along(u), along(lambda));
    a * d - b * c
}
