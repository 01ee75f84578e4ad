//! The recursion as a differential equation: (1.22) to (1.32).

use super::prelude::*;
use crate::chapter::ode::{self, *};
use crate::chapter::{augmented, contact, system::gap};

formulas! {
    |system, x|
    "" = ode::difference_equation(&system, &x("ε"), &x("u_t"), &x("u_{t+1}")) ["left": (left, _) => left];
    "" = ode::difference_equation(&system, &x("ε"), &x("u_t"), &x("u_{t+1}")) ["right": (_, right) => right];
    "" = ode::operator(&system, &x("ε"), &x("u"), &x("v"));
    "" = ode::right_side(&system, &x("ε"));
    "u̇" = ode::velocity(&system, &x("ε"), &x("u"));
    "u" = ode::superposition(&x("u_h"), &x("u_nh"));
    "" = ode::characteristic(&system, &x("ε"), &x("rate"));
    "rate" = ode::rate(&system, &x("ε"));
    "u_h" = ode::homogeneous(&system, &x("ε"), &x("A"), &x("t"));
    "u_nh" = ode::particular(&system);
    "u" = ode::general(&system, &x("ε"), &x("A"), &x("t"));
    "A" = ode::integration_constant(&system, &x("u₀"));
    "u" = ode::solution(&system, &x("ε"), &x("u₀"), &x("t"));
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    let Case { system: s, u, v, du, alpha, eps, lambda, q, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, penetrating, gap_open, time, .. } = hypotheses();
    let zero = &int(0);
    let one = &int(1);
    // A bound of the distance of (1.30) from Δ that tends to zero, since e⁻ˢ ≤ 1/(1 + s).
    let reciprocal_decay = &(contact::penetration(s, u) / (one - rate(s, eps) * t));
    vec![
        Entry::new("1.22", "Recursion in time")
            .states("«ode::difference_equation.left» = «ode::difference_equation.right»")
            .assuming([stiffness, penalty])
            .functions(["ode::difference_equation"])
            .follows_from(["1.21"])
            .claims([{
                let after = |decay: &Tree| augmented::deflection_after(s, eps, lambda, decay);
                let (left, right) =
                    difference_equation(s, eps, &after(q), &after(&(augmented::contraction(s, eps) * q)));
                equal("iterates", left, right)
            }]),
        Entry::new("1.23", "Differential equation")
            .states(
                "«ode::operator: v=u̇» = «ode::right_side», \
                 of which one explicit Euler step of size 1 is (1.21)",
            )
            .in_latex(r"«ode::operator: v=u̇» = «ode::right_side», \quad u(0) = u_0")
            .assuming([stiffness, penalty])
            .functions(["ode::velocity", "ode::right_side"])
            .follows_from(["1.22"])
            .claims([equal("velocity", operator(s, eps, u, &velocity(s, eps, u)), right_side(s, eps)), {
                let (left, right) = augmented::recursion(s, eps, u, &(u + velocity(s, eps, u)));
                equal("explicit-euler", left, right)
            }]),
        Entry::new("1.24", "Superposition")
            .states("u = «ode::superposition»")
            .functions(["ode::superposition"])
            .follows_from(["1.23"])
            .claims([equal(
                "linear",
                operator(s, eps, &superposition(u, v), &superposition(du, alpha)),
                operator(s, eps, u, du) + operator(s, eps, v, alpha),
            )]),
        Entry::new("1.25", "Homogeneous equation")
            .states("«ode::operator: v=u̇» = 0")
            .assuming([stiffness, penalty])
            .functions(["ode::operator"])
            .follows_from(["1.23"])
            .claims([equal("annihilates", operator(s, eps, u, &(rate(s, eps) * u)), 0)]),
        Entry::new("1.26", "Characteristic rate")
            .states("«ode::characteristic» = 0 at rate = «ode::rate»")
            .in_latex(r"«ode::characteristic: rate=s» = 0 \quad\Rightarrow\quad s = «ode::rate»")
            .assuming([stiffness, penalty])
            .functions(["ode::characteristic", "ode::rate"])
            .follows_from(["1.25"])
            .claims([
                equal("root", characteristic(s, eps, &rate(s, eps)), 0),
                equal("from-operator", operator(s, eps, u, &(alpha * u)), characteristic(s, eps, alpha) * u)
                    .only_assuming([]),
                equal("contraction", one + rate(s, eps), augmented::contraction(s, eps)),
            ]),
        Entry::new("1.27", "Homogeneous solution")
            .states("u_h = «ode::homogeneous»")
            .assuming([stiffness, penalty])
            .functions(["ode::homogeneous"])
            .follows_from(["1.26"])
            .claims([
                derivative(
                    "annihilated",
                    homogeneous(s, eps, u, t),
                    t,
                    rate(s, eps) * homogeneous(s, eps, u, t),
                ),
                equal("constant", homogeneous(s, eps, u, zero), u),
            ]),
        Entry::new("1.28", "Particular solution")
            .states("u_nh = «ode::particular»")
            .in_latex(r"u_{\mathrm{nh}} = «ode::particular»")
            .functions(["ode::particular"])
            .follows_from(["1.23"])
            .claims([equal("particular", operator(s, eps, &particular(s), zero), right_side(s, eps))]),
        Entry::new("1.29", "General solution")
            .states("u = «ode::general»")
            .assuming([stiffness, penalty])
            .functions(["ode::general"])
            .follows_from(["1.24", "1.27", "1.28"])
            .claims([
                equal("constant", superposition(&integration_constant(s, u), &particular(s)), u)
                    .only_assuming([]),
                derivative("solves", general(s, eps, u, t), t, velocity(s, eps, &general(s, eps, u, t))),
            ]),
        Entry::new("1.30", "Solution of the initial-value problem")
            .states("u = «ode::solution»")
            .assuming([stiffness, penalty])
            .functions(["ode::solution", "ode::integration_constant"])
            .follows_from(["1.29"])
            .claims([
                equal("constant-is-penetration", integration_constant(s, u), contact::penetration(s, u))
                    .only_assuming([]),
                derivative("solves", solution(s, eps, u, t), t, velocity(s, eps, &solution(s, eps, u, t))),
                equal("starts", solution(s, eps, u, zero), u),
            ]),
        Entry::new("1.31", "Limit of the deflection")
            .states("lim u = «ode::particular» as t → ∞")
            .in_latex(r"\lim_{t\to\infty} u = «ode::particular» \qquad\text{for } c, \varepsilon > 0")
            .assuming([stiffness, penalty])
            .functions(["ode::solution"])
            .follows_from(["1.30"])
            .claims([
                limit("limit", solution(s, eps, u, t), t, gap(s), Within(reciprocal_decay.clone()))
                    .assuming([time, penetrating]),
                // … and from below, or from the plane itself.
                limit("limit-from-below", solution(s, eps, u, t), t, gap(s), Within(-reciprocal_decay))
                    .assuming([time, gap_open]),
                {
                    let gap = gap(s);
                    equal("stays", solution(s, eps, &gap, t), gap)
                },
            ]),
        Entry::new("1.32", "Limit of the penetration")
            .states("lim p(u) = 0 as t → ∞")
            .in_latex(r"\lim_{t\to\infty} p(u(t)) = 0")
            .assuming([stiffness, penalty])
            .functions(["contact::penetration"])
            .follows_from(["1.31"])
            .claims([
                limit(
                    "limit",
                    contact::penetration(s, &solution(s, eps, u, t)),
                    t,
                    0,
                    Within(reciprocal_decay.clone()),
                )
                .assuming([time, penetrating]),
                limit(
                    "limit-from-below",
                    contact::penetration(s, &solution(s, eps, u, t)),
                    t,
                    0,
                    Within(-reciprocal_decay),
                )
                .assuming([time, gap_open]),
            ]),
    ]
}
