//! Penalty method: (1.9) to (1.13), Fig. 1.2, Remark 1.3.2.

use super::prelude::*;
use crate::chapter::penalty::{self, *};
use crate::chapter::{
    augmented, contact, rounding, structure,
    system::{gap, reaction},
};

formulas! {
    |system, x|
    "W" = penalty::functional(&x("ε"), &x("p"));
    "Π_p" = penalty::energy(&system, &x("ε"), &x("u")).abbreviated();
    "" = penalty::total_stiffness(&system, &x("ε"));
    "min Π_p" = penalty::least_energy(&system, &x("ε"));
    "W" = penalty::series(&x("ε"), &[x("ε₄")], &x("p")).written("«» + …");
    "W′" = penalty::series_force(&x("ε"), &[x("ε₄")], &x("p")).abbreviated().written("∂W/∂p");
    "r" = penalty::series_residual(&system, &x("ε"), &[x("ε₄")], &x("p"));
    "r" = penalty::residual(&system, &x("ε"), &x("u"));
    "N" = penalty::contact_force(&system, &x("ε"), &x("u"));
    "u" = penalty::deflection(&system, &x("ε"));
    "u" = penalty::deflection_divided(&system, &x("ε"));
    "p" = penalty::penetration(&system, &x("ε"));
    "N" = penalty::contact_force_at_equilibrium(&system, &x("ε"));
    "ε" = penalty::penalty_for(&system, &x("tol"));
    "u" = penalty::unilateral_deflection(&system, &x("ε"));
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![eq_1_9(), eq_1_10(), eq_1_11(), eq_1_12(), figure_1_2(), eq_1_13(), remark_1_3_2()]
}

fn eq_1_9() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("1.9", "Penalised energy")
        .states("Π_p(u) = «penalty::energy»")
        .in_latex(r"\Pi_p(u) = «penalty::energy»")
        .assuming([stiffness, penalty])
        .functions(["penalty::energy", "penalty::functional", "penalty::least_energy"])
        .follows_from(["1.4", "1.5"])
        .claims([
            equal("least", energy(s, eps, &deflection(s, eps)), least_energy(s, eps)),
            equal(
                "excess",
                energy(s, eps, u) - least_energy(s, eps),
                half(total_stiffness(s, eps) * square(u - deflection(s, eps))),
            ),
        ])
}

fn eq_1_10() -> Entry {
    let Case { system: s, u, eps, eps4, .. } = symbols();
    let Hypotheses { stiffness, penalty, quartic, penetrating, .. } = hypotheses();
    let quartic_term = std::slice::from_ref(eps4);
    let p = &contact::penetration(s, u);
    let [residual, mirrored] = [p, &-p].map(|p| series_residual(s, eps, quartic_term, p));
    let dual = symbols().with_dual_variable(u);
    Entry::new("1.10", "Penalty functional with many terms")
        .states("W = «penalty::series» satisfies the conditions on a penalty functional")
        .in_latex(r"W_\varepsilon(p) = «penalty::series»")
        .assuming([penalty, quartic])
        .functions(["penalty::series", "penalty::series_force", "penalty::series_residual"])
        .follows_from(["1.9"])
        .claims([
            equal("vanishes-at-contact", series(eps, quartic_term, &int(0)), 0).only_assuming([]),
            positive("positive", series(eps, quartic_term, p)).assuming([penetrating]),
            positive("increasing", series_force(eps, quartic_term, p)).assuming([penetrating]),
            derivative("unbounded", series(eps, quartic_term, p), eps, half(p * p)).only_assuming([]),
            equal("one-term", series(eps, &[], p), functional(eps, p)).only_assuming([]),
            equal("force", series_force(eps, quartic_term, p), eps * p + int(4) * eps4 * p * p * p)
                .only_assuming([]),
            derivative("slope", series(eps, quartic_term, p), u, series_force(eps, quartic_term, p))
                .only_assuming([]),
            equal("odd", residual + mirrored, -(int(2) * reaction(s))).only_assuming([]),
            derivative(
                "stiffens",
                series_residual(s, eps, quartic_term, p),
                u,
                total_stiffness(s, eps) + int(12) * eps4 * p * p,
            )
            .only_assuming([]),
            positive(
                "one-root",
                series_residual(&dual.system, &dual.eps, std::slice::from_ref(&dual.eps4), &dual.u)
                    .derivative,
            )
            .only_assuming([stiffness, penalty, quartic]),
        ])
}

fn eq_1_11() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("1.11", "Equilibrium by penalty")
        .states("«penalty::residual» = 0")
        .in_latex(r"\frac{\partial\Pi_p}{\partial u} = «penalty::residual» = 0")
        .functions(["penalty::residual"])
        .follows_from(["1.9"])
        .claims([
            derivative("stationary", energy(s, eps, u), u, residual(s, eps, u)),
            equal("root", residual(s, eps, &deflection(s, eps)), 0).assuming([stiffness, penalty]),
            equal("two-springs", residual(s, eps, u), contact::equilibrium(s, u, &contact_force(s, eps, u))),
        ])
}

fn eq_1_12() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, contact, in_contact, near_penalty, some_bits, .. } = hypotheses();
    let n = &contact_force_at_equilibrium(s, eps);
    let bound = &rounding::penalty_force_error(s, eps, precision());
    let parts = eps * (s.h.abs() + int(5) * gap(s).abs()) + int(7) * reaction(s);
    let best = &rounding::best_compliance_squared(s, precision());
    let error = reaction(s) - n + bound;
    let fixed = int(7) * eta() * (int(1) + int(8) * eta()) - square(&s.c) * best;
    let p = penetration(s, eps);
    Entry::new("1.12", "Contact force by penalty")
        .states("N = «penalty::contact_force», which is «penalty::contact_force_at_equilibrium» at (1.13)")
        .in_latex(r"N = «penalty::contact_force» = «penalty::contact_force in full»")
        .assuming([stiffness, penalty])
        .functions(["penalty::contact_force", "penalty::contact_force_at_equilibrium"])
        .follows_from(["1.11"])
        .claims([
            equal("at-the-root", contact_force(s, eps, &deflection(s, eps)), n),
            positive("pushes", n).assuming([contact]),
            equal("error", reaction(s) - n, &s.c * penetration(s, eps)),
            equal("relative-error", reaction(s) - n, augmented::contraction(s, eps) * reaction(s)),
            within("precision-law", contact_force(s, eps, u).with_rounding() - n, bound)
                .assuming([in_contact, near_penalty])
                .computing(u, deflection(s, eps).with_rounding()),
            equal("precision-law-in-parts", bound * precision(), &parts + int(8) * eta() * &parts)
                .only_assuming([some_bits]),
            // The error of the force relative to R, without the part that is independent of ε. It is
            // smallest if the square on the right vanishes.
            equal(
                "best-penalty",
                square(error / reaction(s) - fixed) - int(4) * square(&s.c) * best,
                square(augmented::contraction(s, eps) - &s.c * total_stiffness(s, eps) * best),
            )
            .assuming([contact, some_bits]),
            equal("complementarity", &p * n, eps * &p * &p),
        ])
}

fn figure_1_2() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    Entry::new("Fig. 1.2", "The penalty as a second spring")
        .states("Two springs of stiffness c and ε act side by side.")
        .functions(["penalty::total_stiffness"])
        .follows_from(["1.12"])
        .claims([
            derivative("force", functional(eps, &contact::penetration(s, u)), u, contact_force(s, eps, u)),
            derivative("stiffness", residual(s, eps, u), u, total_stiffness(s, eps)),
        ])
}

fn eq_1_13() -> Entry {
    let Case { system: s, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, in_contact, separated, some_bits, .. } = hypotheses();
    let u = &deflection(s, eps);
    let bound = &rounding::deflection_error(s, eps, precision());
    let parts = int(5) * gap(s).abs() + int(4) * penetration(s, eps);
    Entry::new("1.13", "Deflection by penalty and its limit")
        .states(
            "u = «penalty::deflection» tends to «system::gap» as ε → ∞, \
             with p = «penalty::penetration»",
        )
        .in_latex(concat!(
            r"\begin{aligned} \lim_{\varepsilon\to\infty} u ",
            r"&= \lim_{\varepsilon\to\infty} «penalty::deflection» \\ ",
            r"&= \lim_{\varepsilon\to\infty} «penalty::deflection_divided» \\ ",
            r"&= «system::gap» \end{aligned}",
        ))
        .assuming([stiffness, penalty])
        .functions(["penalty::deflection", "penalty::deflection_divided"])
        .follows_from(["1.11"])
        .claims([
            equal("rate", total_stiffness(s, eps) * (u - gap(s)), reaction(s)),
            limit("limit", u, eps, gap(s), Equal(reaction(s) / total_stiffness(s, eps))),
            equal("two-forms", u, deflection_divided(s, eps)),
            within("float-error", u.with_rounding() - u, bound).assuming([in_contact]),
            equal("float-error-in-parts", bound * precision(), &parts + int(2) * eta() * &parts)
                .assuming([some_bits]),
            within("float-distance", u.with_rounding() - gap(s), penetration(s, eps) + bound)
                .assuming([in_contact]),
            derivative(
                "slope",
                contact::penetration(s, u),
                eps,
                -reaction(s) / square(total_stiffness(s, eps)),
            ),
            limit("penetration-vanishes", contact::penetration(s, u), eps, 0, Equal(penetration(s, eps))),
            equal("unilateral", unilateral_deflection(s, eps), u).assuming([in_contact]),
            equal("unilateral-free", unilateral_deflection(s, eps), structure::deflection(s))
                .assuming([separated]),
        ])
}

fn remark_1_3_2() -> Entry {
    let Case { system: s, eps, tol, .. } = symbols();
    let Hypotheses { stiffness, penalty, contact, tolerance, sufficient_penalty, within_tolerance, .. } =
        hypotheses();
    Entry::new("Remark 1.3.2", "Sufficient penalty")
        .states("p ≤ tol if and only if ε ≥ «penalty::penalty_for»")
        .assuming([stiffness, penalty, contact, tolerance])
        .functions(["penalty::penalty_for", "penalty::penetration"])
        .follows_from(["1.13"])
        .claims([
            non_negative("enough", tol - penetration(s, eps)).only_assuming([
                tolerance,
                contact,
                sufficient_penalty,
            ]),
            equal("least", penetration(s, &penalty_for(s, tol)), tol).only_assuming([tolerance, contact]),
            non_negative("necessary", eps - penalty_for(s, tol)).only_assuming([
                stiffness,
                penalty,
                tolerance,
                within_tolerance,
            ]),
        ])
}
