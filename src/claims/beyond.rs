//! Results beyond the chapter.

use super::augmented::augment;
use super::prelude::*;
use crate::chapter::{
    augmented, beyond, contact, lagrange, penalty, structure,
    system::{gap, reaction},
};

formulas! {
    |system, x|
    "ε_eff" = beyond::effective_penalty(&system, &x("growth"));
    "λ′" = beyond::relaxed_update(&system, &x("α"), &x("λ"), &x("u"));
    "" = beyond::relaxed_contraction(&system, &x("ε"), &x("α"));
    "d" = beyond::dual_functional(&system, &x("λ"));
    "" = beyond::aitken(&x("λ₀"), &x("λ₁"), &x("λ₂"));
    "W" = beyond::exact_penalty(&x("ε"), &x("p"));
}

/// Returns the entries beyond the chapter.
pub(super) fn entries() -> Vec<Entry> {
    vec![beyond_1(), beyond_2(), beyond_3(), beyond_4(), beyond_5(), beyond_6()]
}

fn beyond_1() -> Entry {
    let Case { system: s, .. } = symbols();
    let Hypotheses { stiffness, .. } = hypotheses();
    Entry::new("beyond 1", "Moreau's decomposition")
        .states("c p + N = R splits R into its positive part N and its negative part −c p")
        .assuming([stiffness])
        .functions(["contact::contact_force"])
        .follows_from(["1.6"])
        .claims([
            equal("force", contact::contact_force(s), reaction(s).positive_part()).only_assuming([]),
            equal(
                "gap",
                -&s.c * contact::penetration(s, &contact::deflection(s)),
                (-reaction(s)).positive_part(),
            ),
        ])
}

fn beyond_2() -> Entry {
    let Case { system: s, eps, q, .. } = symbols();
    let Hypotheses { stiffness, penalty, power, .. } = hypotheses();
    let effective = beyond::effective_penalty(s, &(int(1) / (augmented::contraction(s, eps) * q)));
    // After steps with arbitrary penalties, for which the product of (c + ε_i)/c is q, and one more with ε.
    let [before, after] = [q, &(q / augmented::contraction(s, eps))]
        .map(|growth| penalty::penetration(s, &beyond::effective_penalty(s, growth)));
    let u = augmented::deflection(s, eps, &(reaction(s) - &s.c * before));
    Entry::new("beyond 2", "Augmentations as one penalty")
        .states(
            "k augmentations from λ₀ = 0 equal one penalty solve with \
             ε_eff = «beyond::effective_penalty: growth=(1 + ε/c)^{k+1}»",
        )
        .assuming([stiffness, penalty])
        .functions(["beyond::effective_penalty"])
        .follows_from(["1.13", "1.16"])
        .claims([
            equal(
                "one-penalty",
                penalty::penetration(s, &effective),
                augmented::penetration_after(s, eps, &int(0), q),
            )
            .assuming([power]),
            equal("varying", contact::penetration(s, &u), after).assuming([power]),
        ])
}

fn beyond_3() -> Entry {
    let Case { system: s, alpha, eps, lambda, .. } = symbols();
    let Hypotheses { stiffness, penalty, step, short_step, long_step, uzawa_step, .. } = hypotheses();
    let iterate = &augmented::deflection(s, eps, lambda);
    let r = &reaction(s);
    let factor = &beyond::relaxed_contraction(s, eps, alpha);
    Entry::new("beyond 3", "A separate step size")
        .states(
            "λ′ = «beyond::relaxed_update» multiplies the error by «beyond::relaxed_contraction»; \
             α = «penalty::total_stiffness» is exact",
        )
        .assuming([stiffness, penalty])
        .functions(["beyond::relaxed_update", "beyond::relaxed_contraction"])
        .follows_from(["1.16"])
        .claims([
            equal("factor", beyond::relaxed_update(s, alpha, lambda, iterate) - r, factor * (lambda - r)),
            equal("newton", beyond::relaxed_update(s, &penalty::total_stiffness(s, eps), lambda, iterate), r),
            positive("converges", int(1) - square(factor)).only_assuming([step, short_step]),
            positive("diverges", square(factor) - int(1)).assuming([long_step]),
            positive("uzawa", int(1) - square(beyond::relaxed_contraction(s, &int(0), alpha)))
                .only_assuming([step, uzawa_step]),
        ])
}

fn beyond_4() -> Entry {
    let Case { system: s, eps, lambda, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let iterate = &augmented::deflection(s, eps, lambda);
    let without_penalty = augmented::deflection(s, &int(0), lambda);
    let next = augmented::update(s, eps, lambda, iterate);
    Entry::new("beyond 4", "A proximal step")
        .states("(1.16) is implicit Euler of step ε on λ̇ = (R − λ)/c")
        .assuming([stiffness, penalty])
        .functions(["beyond::dual_functional"])
        .follows_from(["1.16"])
        .claims([
            equal(
                "dual",
                beyond::dual_functional(s, lambda),
                lagrange::functional(s, &without_penalty, lambda),
            )
            .only_assuming([stiffness]),
            equal("proximal-step", (&next - lambda) / eps, (reaction(s) - &next) / &s.c),
            equal(
                "envelope",
                beyond::dual_functional(s, &next) - square(&next - lambda) / (int(2) * eps),
                augmented::least_value(s, eps, lambda),
            ),
            derivative(
                "envelope-slope",
                augmented::least_value(s, eps, lambda),
                lambda,
                contact::penetration(s, iterate),
            ),
        ])
}

fn beyond_5() -> Entry {
    let Case { system: s, eps, lambda, q, .. } = symbols();
    let Hypotheses { stiffness, penalty, below_reaction, above_reaction, .. } = hypotheses();
    let iterate = &augmented::deflection(s, eps, lambda);
    let [first, after_first] = augment([lambda.clone(), iterate.clone()]);
    let [second, _] = augment([first.clone(), after_first]);
    let extrapolated = &beyond::aitken(lambda, &first, &second);
    let after = augmented::multiplier_after(s, lambda, q);
    Entry::new("beyond 5", "Extrapolation")
        .states("Aitken's formula gives R exactly from λ₀ ≠ R, λ₁ and λ₂")
        .assuming([stiffness, penalty])
        .functions(["beyond::aitken"])
        .follows_from(["1.16"])
        .claims([
            equal("aitken", extrapolated, reaction(s)).assuming([below_reaction]),
            equal("aitken-from-above", extrapolated, reaction(s)).assuming([above_reaction]),
            equal(
                "rises",
                augmented::least_value(s, eps, &after),
                structure::potential_energy(s, &gap(s))
                    - square((reaction(s) - lambda) * q) / (int(2) * penalty::total_stiffness(s, eps)),
            ),
        ])
}

fn beyond_6() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, in_contact, strong_enough, .. } = hypotheses();
    Entry::new("beyond 6", "An exact penalty")
        .states("Π + «beyond::exact_penalty» is least at u = «lagrange::deflection» for every ε ≥ R")
        .assuming([stiffness, in_contact])
        .functions(["beyond::exact_penalty"])
        .follows_from(["1.4", "Remark 1.3.2"])
        .claims([non_negative(
            "exact-penalty",
            structure::potential_energy(s, u) + beyond::exact_penalty(eps, &contact::penetration(s, u))
                - structure::potential_energy(s, &gap(s)),
        )
        .assuming([strong_enough])])
}
