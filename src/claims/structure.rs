//! Equilibrium without a plane: (1.1) to (1.4).

use super::prelude::*;
use crate::chapter::structure::{self, *};
use crate::chapter::system;

formulas! {
    |system, x|
    "" = structure::spring_force(&system, &x("u"));
    "r" = structure::residual(&system, &x("u"));
    "u" = structure::deflection(&system);
    "δW" = structure::virtual_work(&system, &x("u"), &x("δu"));
    "Π" = structure::potential_energy(&system, &x("u")).abbreviated();
    "δΠ" = structure::first_variation(&system, &x("u"), &x("δu")).written("δu ∂Π/∂u");
    "min Π" = structure::least_energy(&system);
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![eq_1_1(), eq_1_2(), eq_1_3(), eq_1_4()]
}

fn eq_1_1() -> Entry {
    let Case { system: s, u, .. } = symbols();
    let Hypotheses { stiffness, .. } = hypotheses();
    Entry::new("1.1", "Equilibrium of forces")
        .states("«structure::residual» = 0")
        .assuming([stiffness])
        .functions(["structure::residual", "structure::spring_force", "structure::deflection"])
        .follows_from(["Fig. 1.1"])
        .claims([
            equal("forces", residual(s, u), spring_force(s, u) - system::weight(s)).only_assuming([]),
            equal("root", residual(s, &deflection(s)), 0),
            within(
                "rounding",
                deflection(s).with_rounding() - deflection(s),
                eta() * (int(2) + eta()) * deflection(s).with_rounding().abs(),
            ),
            equal("unique", residual(s, u), &s.c * (u - deflection(s))),
        ])
}

fn eq_1_2() -> Entry {
    let Case { system: s, u, v, du, .. } = symbols();
    let r = residual(s, u);
    Entry::new("1.2", "Virtual work")
        .states("«structure::virtual_work» = 0 for every δu")
        .in_latex(r"«structure::virtual_work» = 0 \quad\text{for every } \delta u")
        .functions(["structure::virtual_work"])
        .follows_from(["1.1"])
        .claims([
            equal("linear", virtual_work(s, u, &(du + v)), virtual_work(s, u, du) + virtual_work(s, u, v)),
            equal("coefficient", virtual_work(s, u, &int(1)), residual(s, u)),
            // Zero for every δu, in particular for this one.
            equal("only-equilibrium", virtual_work(s, u, &r), &r * &r),
        ])
}

fn eq_1_3() -> Entry {
    let Case { system: s, u, du, alpha, .. } = symbols();
    Entry::new("1.3", "Variation of the energy")
        .states("δΠ = «structure::virtual_work» = 0")
        .in_latex(r"\delta\Pi = \delta\left(«structure::potential_energy»\right) = 0")
        .functions(["structure::first_variation"])
        .follows_from(["1.2", "1.4"])
        .claims([
            derivative(
                "variation",
                potential_energy(s, &(u + alpha * du)),
                alpha,
                virtual_work(s, &(u + alpha * du), du),
            ),
            equal("weak-form", first_variation(s, u, du), virtual_work(s, u, du)),
            equal(
                "central-difference",
                potential_energy(s, &(u + du)) - potential_energy(s, &(u - du)),
                int(2) * virtual_work(s, u, du),
            ),
        ])
}

fn eq_1_4() -> Entry {
    let Case { system: s, u, .. } = symbols();
    let Hypotheses { stiffness, .. } = hypotheses();
    let least = deflection(s);
    Entry::new("1.4", "Potential energy")
        .states(
            "Π(u) = «structure::potential_energy» is least at u = «structure::deflection» and only \
             there",
        )
        .in_latex(r"\Pi(u) = «structure::potential_energy» \;\to\; \min")
        .assuming([stiffness])
        .functions(["structure::potential_energy", "structure::least_energy"])
        .follows_from(["1.1"])
        .claims([
            derivative("slope", potential_energy(s, u), u, residual(s, u)).only_assuming([]),
            equal(
                "excess",
                potential_energy(s, u) - potential_energy(s, &least),
                half(&s.c * square(u - &least)),
            ),
            non_negative("minimum", potential_energy(s, u) - least_energy(s)),
            equal("least", potential_energy(s, &deflection(s)), least_energy(s)),
        ])
}
