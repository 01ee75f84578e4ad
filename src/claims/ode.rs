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
    vec![
        eq_1_22(),
        eq_1_23(),
        eq_1_24(),
        eq_1_25(),
        eq_1_26(),
        eq_1_27(),
        eq_1_28(),
        eq_1_29(),
        eq_1_30(),
        eq_1_31(),
        eq_1_32(),
    ]
}

fn eq_1_22() -> Entry {
    let Case { system: s, eps, lambda, q, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let [u, next] = [q, &(augmented::contraction(s, eps) * q)]
        .map(|decay| augmented::deflection_after(s, eps, lambda, decay));
    let (left, right) = difference_equation(s, eps, &u, &next);
    Entry::new("1.22", "Recursion in time")
        .states("«ode::difference_equation.left» = «ode::difference_equation.right»")
        .assuming([stiffness, penalty])
        .functions(["ode::difference_equation"])
        .follows_from(["1.21"])
        .claims([equal("iterates", left, right)])
}

fn eq_1_23() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let (left, right) = augmented::recursion(s, eps, u, &(u + velocity(s, eps, u)));
    Entry::new("1.23", "Differential equation")
        .states(
            "«ode::operator: v=u̇» = «ode::right_side», \
             of which one explicit Euler step of size 1 is (1.21)",
        )
        .in_latex(r"«ode::operator: v=u̇» = «ode::right_side», \quad u(0) = u_0")
        .assuming([stiffness, penalty])
        .functions(["ode::velocity", "ode::right_side"])
        .follows_from(["1.22"])
        .claims([
            equal("velocity", operator(s, eps, u, &velocity(s, eps, u)), right_side(s, eps)),
            equal("explicit-euler", left, right),
        ])
}

fn eq_1_24() -> Entry {
    let Case { system: s, u, v, du, alpha, eps, .. } = symbols();
    Entry::new("1.24", "Superposition")
        .states("u = «ode::superposition»")
        .functions(["ode::superposition"])
        .follows_from(["1.23"])
        .claims([equal(
            "linear",
            operator(s, eps, &superposition(u, v), &superposition(du, alpha)),
            operator(s, eps, u, du) + operator(s, eps, v, alpha),
        )])
}

fn eq_1_25() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("1.25", "Homogeneous equation")
        .states("«ode::operator: v=u̇» = 0")
        .assuming([stiffness, penalty])
        .functions(["ode::operator"])
        .follows_from(["1.23"])
        .claims([equal("annihilates", operator(s, eps, u, &(rate(s, eps) * u)), 0)])
}

fn eq_1_26() -> Entry {
    let Case { system: s, u, alpha, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
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
            equal("contraction", int(1) + rate(s, eps), augmented::contraction(s, eps)),
        ])
}

fn eq_1_27() -> Entry {
    let Case { system: s, u, eps, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("1.27", "Homogeneous solution")
        .states("u_h = «ode::homogeneous»")
        .assuming([stiffness, penalty])
        .functions(["ode::homogeneous"])
        .follows_from(["1.26"])
        .claims([
            derivative("annihilated", homogeneous(s, eps, u, t), t, rate(s, eps) * homogeneous(s, eps, u, t)),
            equal("constant", homogeneous(s, eps, u, &int(0)), u),
        ])
}

fn eq_1_28() -> Entry {
    let Case { system: s, eps, .. } = symbols();
    Entry::new("1.28", "Particular solution")
        .states("u_nh = «ode::particular»")
        .in_latex(r"u_{\mathrm{nh}} = «ode::particular»")
        .functions(["ode::particular"])
        .follows_from(["1.23"])
        .claims([equal("particular", operator(s, eps, &particular(s), &int(0)), right_side(s, eps))])
}

fn eq_1_29() -> Entry {
    let Case { system: s, u, eps, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("1.29", "General solution")
        .states("u = «ode::general»")
        .assuming([stiffness, penalty])
        .functions(["ode::general"])
        .follows_from(["1.24", "1.27", "1.28"])
        .claims([
            equal("constant", superposition(&integration_constant(s, u), &particular(s)), u)
                .only_assuming([]),
            derivative("solves", general(s, eps, u, t), t, velocity(s, eps, &general(s, eps, u, t))),
        ])
}

fn eq_1_30() -> Entry {
    let Case { system: s, u, eps, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("1.30", "Solution of the initial-value problem")
        .states("u = «ode::solution»")
        .assuming([stiffness, penalty])
        .functions(["ode::solution", "ode::integration_constant"])
        .follows_from(["1.29"])
        .claims([
            equal("constant-is-penetration", integration_constant(s, u), contact::penetration(s, u))
                .only_assuming([]),
            derivative("solves", solution(s, eps, u, t), t, velocity(s, eps, &solution(s, eps, u, t))),
            equal("starts", solution(s, eps, u, &int(0)), u),
        ])
}

/// Bounds the distance of (1.30) from Δ by a function that tends to zero, since e⁻ˢ ≤ 1/(1 + s).
fn reciprocal_decay() -> Tree {
    let Case { system: s, u, eps, t, .. } = symbols();
    contact::penetration(s, u) / (int(1) - rate(s, eps) * t)
}

fn eq_1_31() -> Entry {
    let Case { system: s, u, eps, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, penetrating, gap_open, time, .. } = hypotheses();
    Entry::new("1.31", "Limit of the deflection")
        .states("lim u = «ode::particular» as t → ∞")
        .in_latex(r"\lim_{t\to\infty} u = «ode::particular» \qquad\text{for } c, \varepsilon > 0")
        .assuming([stiffness, penalty])
        .functions(["ode::solution"])
        .follows_from(["1.30"])
        .claims([
            limit("limit", solution(s, eps, u, t), t, gap(s), Within(reciprocal_decay()))
                .assuming([time, penetrating]),
            // … and from below, or from the plane itself.
            limit("limit-from-below", solution(s, eps, u, t), t, gap(s), Within(-reciprocal_decay()))
                .assuming([time, gap_open]),
            equal("stays", solution(s, eps, &gap(s), t), gap(s)),
        ])
}

fn eq_1_32() -> Entry {
    let Case { system: s, u, eps, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, penetrating, gap_open, time, .. } = hypotheses();
    let p = contact::penetration(s, &solution(s, eps, u, t));
    Entry::new("1.32", "Limit of the penetration")
        .states("lim p(u) = 0 as t → ∞, from which lim p(u_k) = 0 does not follow")
        .in_latex(r"\lim_{t\to\infty} p(u) = 0 \;\overset{?}{\Rightarrow}\; \lim_{k\to\infty} p(u_k) = 0")
        .assuming([stiffness, penalty])
        .functions(["contact::penetration"])
        .follows_from(["1.31"])
        .claims([
            limit("limit", &p, t, 0, Within(reciprocal_decay())).assuming([time, penetrating]),
            limit("limit-from-below", p, t, 0, Within(-reciprocal_decay())).assuming([time, gap_open]),
        ])
}
