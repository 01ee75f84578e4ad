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
    vec![
        eq_1_14(),
        eq_1_15(),
        eq_1_16(),
        theorem_1_3_3(),
        eq_1_17(),
        eq_1_18(),
        eq_1_19(),
        eq_1_20(),
        eq_1_21(),
    ]
}

fn eq_1_14() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let iterate = &deflection(s, eps, lambda);
    Entry::new("1.14", "Augmented functional")
        .states("L(ε, λ, u) = «augmented::functional»")
        .in_latex("L(u) = «augmented::functional»")
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
            equal("without-multiplier", functional(s, eps, &int(0), u), penalty::energy(s, eps, u))
                .only_assuming([]),
            equal("without-penalty", functional(s, &int(0), lambda, u), lagrange::functional(s, u, lambda))
                .only_assuming([]),
        ])
}

fn eq_1_15() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    Entry::new("1.15", "Stationarity")
        .states("∂L/∂u = «augmented::stationarity» = 0")
        .in_latex(r"\frac{\partial L}{\partial u} = «augmented::stationarity» = 0")
        .functions(["augmented::stationarity"])
        .follows_from(["1.14"])
        .claims([
            derivative("stationary", functional(s, eps, lambda, u), u, stationarity(s, eps, lambda, u)),
            equal("written-out", stationarity(s, eps, lambda, u), equilibrium(s, eps, lambda, u)),
        ])
}

fn eq_1_16() -> Entry {
    let Case { system: s, eps, lambda, q, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let iterate = &deflection(s, eps, lambda);
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
            equal("first-step", deflection(s, eps, &int(0)), penalty::deflection(s, eps)),
            induction(
                "closed-form",
                contraction(s, eps),
                [lambda.clone(), iterate.clone()],
                augment,
                [multiplier_after(s, lambda, q), deflection_after(s, eps, lambda, q)],
            ),
        ])
        .claims(rounded_augmentation())
        .claims([equal(
            "penetration",
            contact::penetration(s, &deflection_after(s, eps, lambda, q)),
            penetration_after(s, eps, lambda, q),
        )])
}

/// Returns the claims about a computed (1.16).
fn rounded_augmentation() -> impl IntoIterator<Item = Statement> {
    let Case { system: s, u, v, eps, lambda, q, .. } = symbols();
    let Hypotheses { penalty, later_multiplier, fine_enough, in_contact, .. } = hypotheses();
    let Hypotheses { computed_inside, decay, near_iterate, some_bits, .. } = hypotheses();
    let [p, later_p] =
        [lambda, v].map(|lambda| contact::penetration(s, &deflection(s, eps, lambda)).with_rounding());
    let drift = rounding::penetration_drift(s, eps, precision());
    let lengths = s.h.abs() + gap(s).abs() + reaction(s) / eps;
    [
        non_negative("float-multiplier-rises", update(s, eps, lambda, u).with_rounding() - lambda.round())
            .only_assuming([penalty, computed_inside]),
        non_negative("float-penetration-falls", p - later_p).assuming([later_multiplier]),
        perturbed_recursion("float-drift", contraction(s, eps))
            .start(0)
            .step(|lambda| update(s, eps, lambda, u).with_rounding())
            .bounding(
                |_| contact::penetration(s, u).with_rounding() - penetration_after(s, eps, &int(0), q),
                &drift,
            )
            .near(multiplier_after(s, &int(0), q), rounding::multiplier_drift(s, eps, precision()))
            .assuming([fine_enough, in_contact, decay, near_iterate])
            .computing(u, deflection(s, eps, member()).with_rounding()),
        equal("float-drift-in-parts", drift * precision(), int(20) * lengths)
            .only_assuming([penalty, some_bits]),
        equal(
            "float-multiplier-drift-in-parts",
            rounding::multiplier_drift(s, eps, precision()),
            int(11) * (&s.c + eps) * rounding::floor_scale(s, eps, precision()),
        )
        .only_assuming([penalty, some_bits]),
    ]
}

fn theorem_1_3_3() -> Entry {
    let Case { system: s, eps, lambda, q, .. } = symbols();
    let Hypotheses { stiffness, penalty, below_reaction, above_reaction, power, .. } = hypotheses();
    let [p, next_p] = [q, &(contraction(s, eps) * q)].map(|q| penetration_after(s, eps, lambda, q));
    Entry::new("Theorem 1.3.3", "Convergence of the augmentation")
        .states(
            "p(u_k) shrinks by the factor ρ = «augmented::contraction» in each step for every \
             ε > 0: |p(u_k)| falls strictly unless λ₀ = R",
        )
        .assuming([stiffness, penalty])
        .functions(["augmented::contraction"])
        .follows_from(["1.16"])
        .claims([
            geometric_limit("contracts", contraction(s, eps), &p, 0),
            positive("falls", &p - &next_p).assuming([below_reaction, power]),
            positive("rises", next_p - p).assuming([above_reaction, power]),
            geometric_limit("force", contraction(s, eps), multiplier_after(s, lambda, q), reaction(s)),
        ])
}

fn eq_1_17() -> Entry {
    let Case { system: s, eps, lambda, q, k, .. } = symbols();
    let Hypotheses { stiffness, penalty, below_reaction, above_reaction, power, count, .. } = hypotheses();
    let p = penetration_after(s, eps, lambda, q);
    let next = &(k + int(1));
    let [bound, next_bound] = [k, next].map(|k| harmonic_bound(s, eps, k));
    let [first, current, last] = [&int(1), k, next].map(|k| &s.c + k * eps);
    Entry::new("1.17", "The limit of the theorem")
        .states("lim p(u_k) = 0, and |p_k| ≤ r |p₀| with r = «augmented::harmonic_bound»")
        .in_latex(r"\lim_{k\to\infty} p(u_k) = 0")
        .assuming([stiffness, penalty])
        .functions(["augmented::harmonic_bound", "augmented::contraction", "augmented::penetration_after"])
        .follows_from(["Theorem 1.3.3"])
        .claims([
            positive("stays-positive", &p).assuming([below_reaction, power]),
            positive("stays-negative", -p).assuming([above_reaction, power]),
            non_negative("harmonic-step", &next_bound - contraction(s, eps) * &bound).assuming([count]),
            equal(
                "harmonic-margin",
                (next_bound - contraction(s, eps) * bound) * first * current * last,
                &s.c * k * square(eps),
            )
            .assuming([count]),
            equal("harmonic-start", harmonic_bound(s, eps, &int(0)), 1).only_assuming([stiffness]),
            limit(
                "harmonic-limit",
                harmonic_bound(s, eps, k),
                k,
                0,
                Equal(int(1) / (int(1) + k * eps / &s.c)),
            )
            .assuming([count]),
        ])
}

fn eq_1_18() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let Hypotheses { in_equilibrium, .. } = hypotheses();
    Entry::new("1.18", "Update of the multiplier")
        .states("λ_{k+1} = «augmented::update: λ=λ_k, u=u_k» = «augmented::contact_force: u=u_k»")
        .in_latex(r"\lambda_{k+1} = «augmented::update: u=u_k, λ=λ_k»")
        .assuming([in_equilibrium])
        .functions(["augmented::update"])
        .follows_from(["1.16"])
        .claims([equal("next-multiplier", update(s, eps, lambda, u), contact_force(s, u))])
}

fn eq_1_19() -> Entry {
    let Case { system: s, eps, lambda, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let iterate = &deflection(s, eps, lambda);
    Entry::new("1.19", "Equilibrium at step k")
        .states("«augmented::equilibrium: λ=λ_k, u=u_k» = 0")
        .in_latex(r"«augmented::equilibrium: u=u_k, λ=λ_k» = 0")
        .assuming([stiffness, penalty])
        .functions(["augmented::equilibrium"])
        .follows_from(["1.16"])
        .claims([equal("root", equilibrium(s, eps, lambda, iterate), 0)])
}

fn eq_1_20() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let Hypotheses { stiffness, penalty, in_equilibrium, .. } = hypotheses();
    let [next, next_deflection] = augment([lambda.clone(), deflection(s, eps, lambda)]);
    Entry::new("1.20", "Equilibrium at step k + 1")
        .states("«augmented::equilibrium: λ=λ_{k+1}, u=u_{k+1}» = 0")
        .in_latex(r"«augmented::equilibrium: u=u_{k+1}, λ=λ_{k+1}» = 0")
        .assuming([stiffness, penalty])
        .functions(["augmented::equilibrium"])
        .follows_from(["1.16", "1.18"])
        .claims([
            equal("next-root", equilibrium(s, eps, &next, &next_deflection), 0),
            equal(
                "missing-force",
                &s.c * contact::penetration(s, u),
                reaction(s) - update(s, eps, lambda, u),
            )
            .only_assuming([in_equilibrium]),
        ])
}

fn eq_1_21() -> Entry {
    let Case { system: s, u, v, eps, lambda, .. } = symbols();
    let Hypotheses { in_equilibrium, next_in_equilibrium, .. } = hypotheses();
    let (left, right) = recursion(s, eps, u, v);
    let next = update(s, eps, lambda, u);
    Entry::new("1.21", "Recursion in the deflection")
        .states("«augmented::recursion.left» = «augmented::recursion.right»")
        .assuming([in_equilibrium, next_in_equilibrium])
        .functions(["augmented::recursion"])
        .follows_from(["1.18", "1.19", "1.20"])
        .claims([
            equal("eliminated", &left, &right),
            equal("difference", equilibrium(s, eps, &next, v) - equilibrium(s, eps, lambda, u), left - right)
                .only_assuming([]),
        ])
}

/// Returns the entries after (1.32).
pub(super) fn stopping() -> Vec<Entry> {
    vec![eq_1_33(), remark_1_3_6()]
}

fn eq_1_33() -> Entry {
    let Case { system: s, eps, lambda, q, tol, .. } = symbols();
    let Hypotheses { stiffness, penalty, tolerance, power, .. } = hypotheses();
    // λ₀ chosen so that |p₀| = tol/q: after the steps with ρᵏ = q the penetration *is* the tolerance.
    let start = reaction(s) - penalty::total_stiffness(s, eps) * tol / q;
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
            equal("growth", int(1) / contraction(s, eps), int(1) + eps / &s.c)
                .only_assuming([stiffness, penalty]),
            equal("tie", penetration_after(s, eps, &start, q), tol)
                .only_assuming([stiffness, penalty, power]),
        ])
}

fn remark_1_3_6() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let [weight, spring_force, force] =
        [system::weight(s), structure::spring_force(s, u), contact_force(s, u)].map(|x| x.with_rounding());
    Entry::new("Remark 1.3.6", "The force at step k")
        .states(
            "λ_{k+1} − λ_k = «penalty::contact_force: u=u_k»: \
             the force named in the remark lags one step behind",
        )
        .functions(["augmented::contact_force"])
        .follows_from(["1.18"])
        .claims([
            equal("lag", update(s, eps, lambda, u) - lambda, penalty::contact_force(s, eps, u)),
            within(
                "rounding",
                &force - contact_force(s, u),
                eta() * (weight.abs() + spring_force.abs() + force.abs()),
            ),
        ])
}
