//! Augmented Lagrangian: (1.14) to (1.21), Theorem 1.3.3, and the stopping criterion: (1.33), Remark 1.3.6.

use super::prelude::*;
use crate::chapter::augmented::{self, *};
use crate::chapter::system::{gap, reaction};
use crate::chapter::{contact, lagrange, penalty, rounding, structure, system};

formulas! {
    |system, x|
    "L" = augmented::functional(&system, &x("ε"), &x("λ"), &x("u")).abbreviated();
    "min L" = augmented::least_value(&system, &x("ε"), &x("λ"));
    "∂L/∂u" = augmented::stationarity(&system, &x("ε"), &x("λ"), &x("u"));
    "λ′" = augmented::update(&system, &x("ε"), &x("λ"), &x("u"));
    "r" = augmented::equilibrium(&system, &x("ε"), &x("λ"), &x("u"));
    "u" = augmented::deflection(&system, &x("ε"), &x("λ"));
    "N" = augmented::contact_force(&system, &x("u"));
    "ρ" = augmented::contraction(&system, &x("ε")).abbreviated();
    "λ_k" = augmented::multiplier_after(&system, &x("λ₀"), &x("ρᵏ"));
    "p_k" = augmented::penetration_after(&system, &x("ε"), &x("λ₀"), &x("ρᵏ"));
    "u_k" = augmented::deflection_after(&system, &x("ε"), &x("λ₀"), &x("ρᵏ"));
    "" = augmented::harmonic_bound(&system, &x("ε"), &x("k"));
    "" = augmented::recursion(&system, &x("ε"), &x("u_k"), &x("u_{k+1}")) ["left": (left, _) => left];
    "" = augmented::recursion(&system, &x("ε"), &x("u_k"), &x("u_{k+1}")) ["right": (_, right) => right];
    "L" = augmented::unilateral_functional(&system, &x("ε"), &x("λ"), &x("u"));
    "λ′" = augmented::unilateral_update(&system, &x("ε"), &x("λ"), &x("u"));
    "r" = augmented::unilateral_equilibrium(&system, &x("ε"), &x("λ"), &x("u"));
    "u" = augmented::unilateral_deflection(&system, &x("ε"), &x("λ"));
    "r" = augmented::natural_residual(&system, &x("ε"), &x("λ"), &x("u"));
}

/// One step of (1.16): the next multiplier and its deflection.
pub(super) fn augment([lambda, u]: [Tree; 2]) -> [Tree; 2] {
    let Case { system: s, eps, .. } = symbols();
    let lambda = update(s, eps, &lambda, &u);
    let u = deflection(s, eps, &lambda);
    [lambda, u]
}

/// Returns the entries up to (1.21).
pub(super) fn entries() -> Vec<Entry> {
    let Case { system: s, u, v, eps, lambda, q, k, .. } = symbols();
    let Hypotheses {
        stiffness,
        penalty,
        below_reaction,
        above_reaction,
        in_equilibrium,
        next_in_equilibrium,
        power,
        count,
        later_multiplier,
        fine_enough,
        in_contact,
        computed_inside,
        decay,
        near_iterate,
        some_bits,
        ..
    } = hypotheses();
    let iterate = &deflection(s, eps, lambda);
    let zero = &int(0);
    let one = &int(1);
    vec![
        Entry::new("1.14", "Augmented functional")
            .states("L(u) = «augmented::functional»")
            .assuming([stiffness, penalty])
            .functions(["augmented::functional", "augmented::least_value"])
            .follows_from(["1.7", "1.9"])
            .claims([
                equal("least", functional(s, eps, lambda, iterate), least_value(s, eps, lambda)),
                equal(
                    "excess",
                    functional(s, eps, lambda, u) - least_value(s, eps, lambda),
                    half(penalty::total_stiffness(s, eps) * square(u - iterate)),
                ),
                equal("without-multiplier", functional(s, eps, zero, u), penalty::energy(s, eps, u))
                    .only_assuming([]),
                equal("without-penalty", functional(s, zero, lambda, u), lagrange::functional(s, u, lambda))
                    .only_assuming([]),
            ]),
        Entry::new("1.15", "Stationarity")
            .states("∂L/∂u = «augmented::stationarity» = 0")
            .in_latex(r"\frac{\partial L}{\partial u} = «augmented::stationarity» = 0")
            .functions(["augmented::stationarity"])
            .follows_from(["1.14"])
            .claims([
                derivative("stationary", functional(s, eps, lambda, u), u, stationarity(s, eps, lambda, u)),
                equal("written-out", stationarity(s, eps, lambda, u), equilibrium(s, eps, lambda, u)),
            ]),
        Entry::new("1.16", "Augmentation")
            .states(
                "λ_k = «augmented::update: λ=λ_{k−1}, u=u_{k−1}» and \
                 «augmented::equilibrium: λ=λ_k, u=u_k» = 0; \
                 in closed form λ_k = «augmented::multiplier_after»",
            )
            .in_latex(concat!(
                r"\begin{gathered} \left\{\begin{aligned} ",
                r"&\lambda_k = «augmented::update: u=u_{k-1}, λ=λ_{k-1}» \\ ",
                r"&«augmented::equilibrium: u=u_k, λ=λ_k» = 0 \end{aligned}\right. \\ ",
                r"k = 1, 2, 3, \dots \end{gathered}",
            ))
            .assuming([stiffness, penalty])
            .functions([
                "augmented::update",
                "augmented::equilibrium",
                "augmented::deflection",
                "augmented::multiplier_after",
                "augmented::deflection_after",
            ])
            .follows_from(["1.15"])
            .claims([
                equal("first-step", deflection(s, eps, zero), penalty::deflection(s, eps)),
                induction(
                    "closed-form",
                    contraction(s, eps),
                    [lambda.clone(), iterate.clone()],
                    augment,
                    [multiplier_after(s, lambda, q), deflection_after(s, eps, lambda, q)],
                ),
                non_negative(
                    "float-multiplier-rises",
                    update(s, eps, lambda, u).with_rounding() - lambda.round(),
                )
                .only_assuming([penalty, computed_inside]),
                {
                    let p =
                        |lambda: &Tree| contact::penetration(s, &deflection(s, eps, lambda)).with_rounding();
                    non_negative("float-penetration-falls", p(lambda) - p(v)).assuming([later_multiplier])
                },
                perturbed_recursion("float-drift", contraction(s, eps))
                    .start(0)
                    .step(|lambda| update(s, eps, lambda, u).with_rounding())
                    .bounding(
                        |_| contact::penetration(s, u).with_rounding() - penetration_after(s, eps, zero, q),
                        rounding::penetration_drift(s, eps, precision()),
                    )
                    .near(multiplier_after(s, zero, q), rounding::multiplier_drift(s, eps, precision()))
                    .assuming([fine_enough, in_contact, decay, near_iterate])
                    .computing(u, deflection(s, eps, member()).with_rounding()),
                {
                    let drift = rounding::penetration_drift(s, eps, precision());
                    let lengths = s.h.abs() + gap(s).abs() + reaction(s) / eps;
                    equal("float-drift-in-parts", drift * precision(), int(20) * lengths)
                        .only_assuming([penalty, some_bits])
                },
                equal(
                    "float-multiplier-drift-in-parts",
                    rounding::multiplier_drift(s, eps, precision()),
                    int(11) * (&s.c + eps) * rounding::floor_scale(s, eps, precision()),
                )
                .only_assuming([penalty, some_bits]),
                equal(
                    "penetration",
                    contact::penetration(s, &deflection_after(s, eps, lambda, q)),
                    penetration_after(s, eps, lambda, q),
                ),
            ]),
        Entry::new("Theorem 1.3.3", "Convergence of the augmentation")
            .states(
                "p(u_k) shrinks by the factor ρ = «augmented::contraction» in each step for every \
                 ε > 0: |p(u_k)| falls strictly unless λ₀ = R",
            )
            .assuming([stiffness, penalty])
            .functions(["augmented::contraction"])
            .follows_from(["1.16"])
            .claims([
                geometric_limit("contracts", contraction(s, eps), penetration_after(s, eps, lambda, q), 0),
                {
                    let next = contraction(s, eps) * q;
                    positive(
                        "falls",
                        penetration_after(s, eps, lambda, q) - penetration_after(s, eps, lambda, &next),
                    )
                    .assuming([below_reaction, power])
                },
                {
                    let next = contraction(s, eps) * q;
                    positive(
                        "rises",
                        penetration_after(s, eps, lambda, &next) - penetration_after(s, eps, lambda, q),
                    )
                    .assuming([above_reaction, power])
                },
                geometric_limit("force", contraction(s, eps), multiplier_after(s, lambda, q), reaction(s)),
            ]),
        Entry::new("1.17", "The limit of the theorem")
            .states("lim p(u_k) = 0, and |p_k| ≤ r |p₀| with r = «augmented::harmonic_bound»")
            .in_latex(r"\lim_{k\to\infty} p(u_k) = 0")
            .assuming([stiffness, penalty])
            .functions([
                "augmented::harmonic_bound",
                "augmented::contraction",
                "augmented::penetration_after",
            ])
            .follows_from(["Theorem 1.3.3"])
            .claims([
                positive("stays-positive", penetration_after(s, eps, lambda, q))
                    .assuming([below_reaction, power]),
                positive("stays-negative", -penetration_after(s, eps, lambda, q))
                    .assuming([above_reaction, power]),
                {
                    let next = k + one;
                    non_negative(
                        "harmonic-step",
                        harmonic_bound(s, eps, &next) - contraction(s, eps) * harmonic_bound(s, eps, k),
                    )
                    .assuming([count])
                },
                {
                    let sum = |k: &Tree| &s.c + k * eps;
                    let bound = |k: &Tree| harmonic_bound(s, eps, k);
                    let (next, factor) = (k + one, contraction(s, eps));
                    equal(
                        "harmonic-margin",
                        (bound(&next) - factor * bound(k)) * sum(one) * sum(k) * sum(&next),
                        &s.c * k * square(eps),
                    )
                    .assuming([count])
                },
                equal("harmonic-start", harmonic_bound(s, eps, zero), 1).only_assuming([stiffness]),
                limit("harmonic-limit", harmonic_bound(s, eps, k), k, 0, Equal(one / (one + k * eps / &s.c)))
                    .assuming([count]),
            ]),
        Entry::new("1.18", "Update of the multiplier")
            .states("λ_{k+1} = «augmented::update: λ=λ_k, u=u_k» = «augmented::contact_force: u=u_k»")
            .in_latex(r"\lambda_{k+1} = «augmented::update: u=u_k, λ=λ_k»")
            .assuming([in_equilibrium])
            .functions(["augmented::update"])
            .follows_from(["1.16"])
            .claims([equal("next-multiplier", update(s, eps, lambda, u), contact_force(s, u))]),
        Entry::new("1.19", "Equilibrium at step k")
            .states("«augmented::equilibrium: λ=λ_k, u=u_k» = 0")
            .in_latex(r"«augmented::equilibrium: u=u_k, λ=λ_k» = 0")
            .assuming([stiffness, penalty])
            .functions(["augmented::equilibrium"])
            .follows_from(["1.16"])
            .claims([equal("root", equilibrium(s, eps, lambda, iterate), 0)]),
        Entry::new("1.20", "Equilibrium at step k + 1")
            .states("«augmented::equilibrium: λ=λ_{k+1}, u=u_{k+1}» = 0")
            .in_latex(r"«augmented::equilibrium: u=u_{k+1}, λ=λ_{k+1}» = 0")
            .assuming([stiffness, penalty])
            .functions(["augmented::equilibrium"])
            .follows_from(["1.16", "1.18"])
            .claims([
                {
                    let [next, u] = augment([lambda.clone(), iterate.clone()]);
                    equal("next-root", equilibrium(s, eps, &next, &u), 0)
                },
                equal(
                    "missing-force",
                    &s.c * contact::penetration(s, u),
                    reaction(s) - update(s, eps, lambda, u),
                )
                .only_assuming([in_equilibrium]),
            ]),
        Entry::new("1.21", "Recursion in the deflection")
            .states("«augmented::recursion.left» = «augmented::recursion.right»")
            .assuming([in_equilibrium, next_in_equilibrium])
            .functions(["augmented::recursion"])
            .follows_from(["1.18", "1.19", "1.20"])
            .claims([
                {
                    let (left, right) = recursion(s, eps, u, v);
                    equal("eliminated", left, right)
                },
                {
                    let (left, right) = recursion(s, eps, u, v);
                    let next = update(s, eps, lambda, u);
                    equal(
                        "difference",
                        equilibrium(s, eps, &next, v) - equilibrium(s, eps, lambda, u),
                        left - right,
                    )
                    .only_assuming([])
                },
            ]),
    ]
}

/// Returns the entries after (1.32).
pub(super) fn stopping() -> Vec<Entry> {
    let Case { system: s, u, eps, lambda, q, tol, .. } = symbols();
    let Hypotheses { stiffness, penalty, tolerance, power, .. } = hypotheses();
    let one = &int(1);
    vec![
        Entry::new("1.33", "Stopping criterion")
            .states("|p_k| < tol, first at k = 0 if |p₀| < tol, else at k = ⌊ln(|p₀|/tol)/ln(1 + ε/c)⌋ + 1")
            .in_latex(r"\lvert p_k \rvert = \lvert «contact::penetration: u=u_k» \rvert < \mathrm{tol}")
            .assuming([stiffness, penalty, tolerance])
            .functions(["augmented::within_tolerance"])
            .follows_from(["1.16"])
            .claims([
                equal(
                    "count",
                    penetration_after(s, eps, lambda, q) * penalty::total_stiffness(s, eps),
                    (reaction(s) - lambda) * q,
                )
                .only_assuming([stiffness, penalty]),
                equal("growth", one / contraction(s, eps), one + eps / &s.c)
                    .only_assuming([stiffness, penalty]),
                {
                    // λ₀ chosen so that |p₀| = tol/q: after the steps with ρᵏ = q the penetration *is* the
                    // tolerance.
                    let start = reaction(s) - penalty::total_stiffness(s, eps) * tol / q;
                    equal("tie", penetration_after(s, eps, &start, q), tol)
                        .only_assuming([stiffness, penalty, power])
                },
            ]),
        Entry::new("Remark 1.3.6", "The force at step k")
            .states(
                "λ_{k+1} − λ_k = «penalty::contact_force: u=u_k»: \
                 the force named in the remark lags one step behind",
            )
            .functions(["augmented::contact_force"])
            .follows_from(["1.18"])
            .claims([
                equal("lag", update(s, eps, lambda, u) - lambda, penalty::contact_force(s, eps, u)),
                within("rounding", contact_force(s, u).with_rounding() - contact_force(s, u), {
                    let parts = [system::weight(s), structure::spring_force(s, u)];
                    let [weight, spring] = parts.map(|part| part.with_rounding());
                    let force = contact_force(s, u).with_rounding();
                    eta() * (weight.abs() + spring.abs() + force.abs())
                }),
            ]),
    ]
}
