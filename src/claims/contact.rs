//! Contact with the plane: (1.5) and (1.6).

use super::prelude::*;
use crate::chapter::contact::{self, *};
use crate::chapter::system::{gap, reaction};
use crate::chapter::{augmented, structure};

formulas! {
    |system, x|
    "p" = contact::penetration(&system, &x("u")).abbreviated();
    "r" = contact::equilibrium(&system, &x("u"), &x("N"));
    "" = contact::kkt(&system, &x("u"), &x("N")) ["stationarity": Kkt { stationarity, .. } => stationarity];
    "" = contact::kkt(&system, &x("u"), &x("N")) ["primal": Kkt { primal, .. } => primal];
    "" = contact::kkt(&system, &x("u"), &x("N")) ["dual": Kkt { dual, .. } => dual];
    "" = contact::kkt(&system, &x("u"), &x("N")) ["complementarity": Kkt { complementarity, .. } => complementarity];
    "N" = contact::contact_force(&system);
    "u" = contact::deflection(&system);
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![eq_1_5(), eq_1_6()]
}

fn eq_1_5() -> Entry {
    let Case { system: s, u, .. } = symbols();
    let Hypotheses { stiffness, .. } = hypotheses();
    let (sum, p) = ((&s.l + u).with_rounding(), penetration(s, u).with_rounding());
    Entry::new("1.5", "Penetration")
        .states("p(u) = «contact::penetration» ≤ 0")
        .in_latex(r"p(u) = «contact::penetration» \le 0")
        .functions(["contact::penetration"])
        .follows_from(["Fig. 1.1"])
        .claims([
            equal("at-the-gap", penetration(s, &gap(s)), 0),
            derivative("slope", penetration(s, u), u, 1),
            within("rounding", &p - penetration(s, u), eta() * (sum.abs() + p.abs())),
            equal("free", penetration(s, &structure::deflection(s)), reaction(s) / &s.c)
                .assuming([stiffness]),
        ])
}

fn eq_1_6() -> Entry {
    let Case { system: s, u, v, du, lambda, .. } = symbols();
    let Hypotheses { stiffness, contact, separated, gap_open, .. } = hypotheses();
    let solved = kkt(s, &deflection(s), &contact_force(s));
    let [p, other_p] = [u, v].map(|u| penetration(s, u));
    let [n, other_n] = [u, v].map(|u| augmented::contact_force(s, u));
    Entry::new("1.6", "Karush-Kuhn-Tucker (KKT) conditions")
        .states(
            "p ≤ 0, N ≥ 0, «contact::kkt.complementarity» = 0 and «contact::equilibrium» = 0 have \
             exactly one solution",
        )
        .in_latex(concat!(
            r"\begin{array}{lll} \text{contact:} & p = 0 & N > 0 \\ ",
            r"\text{no contact:} & p < 0 & N = 0 \\ ",
            r"\text{always:} & «contact::kkt.complementarity» = 0 & \end{array}",
        ))
        .assuming([stiffness])
        .functions(["contact::kkt", "contact::Kkt", "contact::equilibrium"])
        .follows_from(["1.4", "1.5"])
        .claims([
            equal(
                "force-from-deflection",
                equilibrium(s, u, lambda),
                &s.c * penetration(s, u) + lambda - reaction(s),
            )
            .only_assuming([]),
            // By equilibrium N = m g − c u: a mass above the plane with R > 0 would need a force there.
            // For two solutions, each with p N = 0, p ≤ 0 and N ≥ 0, the right side is not positive, so
            // they are equal.
            equal(
                "unique",
                &s.c * square(u - v),
                &p * &other_n + &other_p * &n - &p * &n - &other_p * &other_n,
            )
            .only_assuming([]),
            positive("contact-excludes-gap", -(p * n)).assuming([contact, gap_open]),
            // … and a mass at the plane with R < 0 would be pulled.
            positive("separation-excludes-touch", structure::residual(s, &gap(s))).only_assuming([separated]),
            equal("stationarity", &solved.stationarity, 0),
            equal("no-penetration", &solved.primal, 0),
            equal("no-pull", kkt(s, u, &contact_force(s)).dual, 0).only_assuming([]),
            equal("complementarity", &solved.complementarity, 0),
            equal("product", kkt(s, &(gap(s) + du), lambda).complementarity, du * lambda).only_assuming([]),
            positive("pushes", contact_force(s)).only_assuming([contact]),
            positive("hangs-free", -penetration(s, &deflection(s))).assuming([separated]),
        ])
}
