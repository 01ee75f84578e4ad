//! Notes 1 to 9 on loose spots of the chapter.

use super::prelude::*;
use crate::chapter::{SpringMass, augmented, contact, lagrange, ode, penalty, rounding, structure, system};
use crate::formula::claim;
use std::sync::LazyLock;

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![note_1(), note_2(), note_3(), note_4(), note_5(), note_6(), note_7(), note_8(), note_9()]
}

fn note_1() -> Entry {
    let Case { system: s, .. } = symbols();
    let Hypotheses { stiffness, grazing, .. } = hypotheses();
    let gap = &system::gap(s);
    Entry::new("note 1", "Grazing")
        .states("p = 0 with N = 0 is a third state")
        .assuming([stiffness, grazing])
        .functions(["contact::deflection"])
        .follows_from(["1.6"])
        .claims([
            equal("grazing-deflection", contact::deflection(s), gap),
            equal("grazing-force", contact::contact_force(s), 0).only_assuming([grazing]),
        ])
}

fn note_2() -> Entry {
    let Case { system: s, u, lambda, .. } = symbols();
    let Hypotheses { stiffness, .. } = hypotheses();
    let (gap, r) = (&system::gap(s), &system::reaction(s));
    let free = structure::deflection(s);
    let excess = lagrange::functional(s, u, r) - lagrange::functional(s, gap, r);
    Entry::new("note 2", "A saddle point")
        .states("(1.7) is least in u and constant in λ at (Δ, R)")
        .assuming([stiffness])
        .functions(["lagrange::functional"])
        .follows_from(["1.7", "1.8"])
        .claims([
            equal("saddle-in-deflection", &excess, half(&s.c * square(u - gap))).only_assuming([]),
            non_negative("least-in-deflection", excess),
            equal(
                "constant-in-multiplier",
                lagrange::functional(s, gap, lambda),
                structure::potential_energy(s, gap),
            )
            .only_assuming([]),
            equal(
                "separated",
                lagrange::functional(s, &free, lambda),
                structure::least_energy(s) + lambda * r / &s.c,
            ),
            non_negative("not-positive", -structure::least_energy(s)),
        ])
}

fn note_3() -> Entry {
    let Case { system: s, u, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let r = &system::reaction(s);
    let stalled = &(r / (&s.c + saturating_force(eps, &int(1))));
    Entry::new("note 3", "Conditions on a penalty functional")
        .states("W_ε(p_ε) ≤ R²/(2c)")
        .assuming([stiffness, penalty])
        .functions(["penalty::functional"])
        .follows_from(["1.10"])
        .claims([
            non_negative(
                "energy-bound",
                r * r / (int(2) * &s.c) - penalty::functional(eps, &penalty::penetration(s, eps)),
            ),
            // Positive, increasing and unbounded in p, but the penetration does not vanish.
            equal("not-sufficient", &s.c * stalled + saturating_force(eps, stalled), r),
            limit(
                "stalls",
                stalled,
                eps,
                r / (&s.c + int(2)),
                Equal(stalled / ((&s.c + int(2)) * (int(1) + eps))),
            ),
            // Bounded in p, but the penetration vanishes: W = ε p²/(1 + p²) is proportional to ε.
            limit("not-necessary", bounded_penalty(eps, u), u, eps, Equal(-(eps / (int(1) + square(u)))))
                .only_assuming([]),
        ])
}

fn note_4() -> Entry {
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    Entry::new("note 4", "Unilateral contact")
        .states(
            "λ_k = «augmented::unilateral_update: λ=λ_{k−1}, u=u_{k−1}» and \
             «augmented::unilateral_equilibrium: λ=λ_k, u=u_k» = 0",
        )
        .assuming([stiffness, penalty])
        .functions([
            "augmented::unilateral_deflection",
            "augmented::unilateral_update",
            "augmented::unilateral_equilibrium",
            "augmented::unilateral_functional",
            "augmented::natural_residual",
            "penalty::unilateral_deflection",
        ])
        .follows_from(["1.6", "1.16"])
        .claims(unilateral_equations())
        .claims(unilateral_sequences())
        .claims(unilateral_rounding())
        .claims(unilateral_remarks())
}

/// Returns the claims of note 4 about one step.
fn unilateral_equations() -> impl IntoIterator<Item = Statement> {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let Hypotheses { penalty, in_contact, penetrating, multiplier, active, inactive, .. } = hypotheses();
    let iterate = &augmented::deflection(s, eps, lambda);
    let r = &system::reaction(s);
    let unilateral = &augmented::unilateral_deflection(s, eps, lambda);
    let next = &augmented::unilateral_update(s, eps, lambda, unilateral);
    let residual = &augmented::natural_residual(s, eps, lambda, unilateral);
    let error = &(unilateral - contact::deflection(s));
    [
        equal("equilibrium", augmented::unilateral_equilibrium(s, eps, lambda, unilateral), 0),
        non_negative("never-pulls", next),
        equal(
            "functional-where-active",
            augmented::unilateral_functional(s, eps, lambda, u),
            augmented::functional(s, eps, lambda, u),
        )
        .only_assuming([penalty, multiplier, penetrating]),
        equal(
            "functional-elsewhere",
            augmented::unilateral_functional(s, eps, lambda, u),
            structure::potential_energy(s, u) - square(lambda) / (int(2) * eps),
        )
        .only_assuming([penalty, inactive]),
        equal("where-active", unilateral, iterate).assuming([active]),
        equal(
            "multiplier",
            next,
            ((&s.c * lambda + eps * r) / penalty::total_stiffness(s, eps)).positive_part(),
        ),
        equal("natural-residual", residual, (next - lambda) / eps),
        non_negative("residual-bounds-error", square(residual) - square(error)),
        equal("force-error", contact::contact_force(s) - next, &s.c * error),
        non_negative("contracts", square(lambda - r) - square(next - r)).assuming([in_contact]),
    ]
}

/// Returns the claims of note 4 about the sequence of multipliers.
fn unilateral_sequences() -> impl IntoIterator<Item = Statement> {
    let Case { system: s, eps, lambda, q, .. } = symbols();
    let Hypotheses { in_contact, grazing, separated, active, releases, power, .. } = hypotheses();
    let Hypotheses { multiplier, next_multiplier_nonnegative, .. } = hypotheses();
    let unilateral = &augmented::unilateral_deflection(s, eps, lambda);
    let next = &augmented::unilateral_update(s, eps, lambda, unilateral);
    [
        equal("active-step", next, augmented::multiplier_after(s, lambda, &augmented::contraction(s, eps)))
            .assuming([active]),
        equal("idle-step", next, 0).assuming([releases]),
        equal("idle-deflection", unilateral, structure::deflection(s)).assuming([releases]),
        equal("stays-free", unilateral_step(&int(0)), 0).assuming([separated]),
        induction(
            "contact-sequence",
            augmented::contraction(s, eps),
            [lambda.clone()],
            |[lambda]| [unilateral_step(&lambda)],
            [augmented::multiplier_after(s, lambda, q)],
        )
        .assuming([in_contact, multiplier, next_multiplier_nonnegative]),
        induction(
            "grazing-sequence",
            augmented::contraction(s, eps),
            [lambda.clone()],
            |[lambda]| [unilateral_step(&lambda)],
            [lambda * q],
        )
        .assuming([grazing, multiplier, power]),
    ]
}

/// Returns the claims of note 4 about computed numbers.
fn unilateral_rounding() -> impl IntoIterator<Item = Statement> {
    let Case { system: s, u, v, eps, lambda, q, .. } = symbols();
    let Hypotheses { stiffness, fine_enough, decay, pushes, in_contact, separated, .. } = hypotheses();
    let Hypotheses { near_bilateral_iterate, near_iterate, near_next, near_bilateral, .. } = hypotheses();
    let free = &structure::deflection(s);
    let computed_free = &free.with_rounding();
    let distance = system::gap(s).abs() + system::reaction(s).abs() / penalty::total_stiffness(s, eps);
    [
        perturbed_recursion("float-unilateral-drift", augmented::contraction(s, eps))
            .start(0)
            .step(|_| lambda.positive_part())
            .bounding(
                |_| computed_penetration(u) - augmented::penetration_after(s, eps, &int(0), q),
                rounding::penetration_drift(s, eps, precision()),
            )
            .near(augmented::multiplier_after(s, &int(0), q), rounding::multiplier_drift(s, eps, precision()))
            .assuming([fine_enough, in_contact, decay, pushes])
            .assuming([near_bilateral_iterate, near_iterate, near_next])
            .computing(v, augmented::deflection(s, eps, member()).with_rounding())
            .computing(u, computed_free.min(v))
            .computing(lambda, augmented::update(s, eps, member(), u).with_rounding()),
        within(
            "float-nearly-free",
            computed_free.min(v) - free,
            eta() * (int(2) * free.abs() + int(8) * distance),
        )
        .assuming([separated, near_bilateral])
        .computing(v, augmented::deflection(s, eps, &int(0)).with_rounding()),
        non_negative(
            "float-no-deeper",
            computed_penetration(computed_free) - computed_penetration(&computed_free.min(v)),
        )
        .only_assuming([stiffness]),
        non_negative(
            "float-hardly-inside",
            eta() * (int(3) * free.abs() + s.h.abs()) - computed_penetration(computed_free),
        )
        .only_assuming([stiffness, separated]),
    ]
}

/// Returns the computed penetration at a deflection that is rounded already.
fn computed_penetration(deflection: &Tree) -> Tree {
    let Case { system: s, u, .. } = symbols();
    contact::penetration(s, u).with_rounding().substitute(&[("u", deflection.clone())])
}

/// Returns the claims of note 4 about the count of steps and about ⟨·⟩ in the update alone.
fn unilateral_remarks() -> impl IntoIterator<Item = Statement> {
    let Case { system: s, eps, lambda, q, .. } = symbols();
    let Hypotheses { separated, active, power, .. } = hypotheses();
    let r = &system::reaction(s);
    let unilateral = &augmented::unilateral_deflection(s, eps, lambda);
    let first_bilateral = &augmented::deflection(s, eps, &int(0));
    [
        // λ_k > 0 while (1 + ε/c)ᵏ < 1 + λ₀/|R|.
        equal(
            "count",
            augmented::multiplier_after(s, lambda, q),
            -r * q * (int(1) - lambda / r - int(1) / q),
        )
        .only_assuming([separated, power]),
        equal(
            "residual-is-penetration",
            augmented::natural_residual(s, eps, lambda, unilateral),
            contact::penetration(s, unilateral),
        )
        .assuming([active]),
        // With ⟨·⟩ in the update alone the iteration stops before the solution.
        equal("one-bracket-stalls", augmented::unilateral_update(s, eps, &int(0), first_bilateral), 0)
            .assuming([separated]),
        positive("one-bracket-errs", first_bilateral - contact::deflection(s)).assuming([separated]),
    ]
}

fn note_5() -> Entry {
    let Case { system: s, u, eps, lambda, q, t, .. } = symbols();
    let Hypotheses { stiffness, penalty, softening, zero_total_stiffness, at_reaction, .. } = hypotheses();
    let Hypotheses { penalty_below_minus_c, penalty_below_minus_two_c, power, time, .. } = hypotheses();
    let Hypotheses { penalty_above_minus_two_c, penalty_of_minus_two_c, .. } = hypotheses();
    let rho = &augmented::contraction(s, eps);
    let p = &augmented::penetration_after(s, eps, lambda, q);
    let [flow, flow_on, flow_one] = [t, &(t + int(1)), &int(1)].map(|t| ode::homogeneous(s, eps, &int(1), t));
    Entry::new("note 5", "An analogy, not a proof")
        .states("e^{−ε/c} < ρ < e^{−ε/(c+ε)} for ε > 0, and p_k → 0 also for ε < −2c")
        .assuming([stiffness])
        .functions(["augmented::contraction"])
        .follows_from(["1.16", "1.30"])
        .claims([
            geometric_limit("beyond-twice", rho, p, 0).assuming([penalty_below_minus_two_c]),
            positive("alternates", -rho).assuming([penalty_below_minus_two_c]),
            equal("twice", rho, -1).assuming([penalty_of_minus_two_c]),
            positive("diverges", square(&s.c) - square(penalty::total_stiffness(s, eps)))
                .only_assuming([softening, penalty_above_minus_two_c]),
            equal("no-solution", augmented::equilibrium(s, eps, lambda, u), lambda - system::reaction(s))
                .only_assuming([zero_total_stiffness]),
            equal("starts-there", p, 0).assuming([penalty, at_reaction]),
            non_negative(
                "maximises",
                augmented::least_value(s, eps, lambda) - augmented::functional(s, eps, lambda, u),
            )
            .only_assuming([penalty_below_minus_c]),
            positive("ode-converges", -ode::rate(s, eps)).assuming([penalty_below_minus_c]),
            equal("no-penalty", augmented::contraction(s, &int(0)), 1),
            positive("strict-bound", ode::rate(s, eps).exp() - rho).assuming([penalty]),
            positive("other-side", rho - (-eps / &s.c).exp()).assuming([penalty]),
            // From one step to the next: a bound q + t above ρᵏ = q stays above it.
            positive("stays-strict", ode::rate(s, eps).exp() * (q + t) - rho * q)
                .assuming([penalty, power, time]),
            equal("flow", flow_on, flow * flow_one).assuming([penalty]),
        ])
}

fn note_6() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let Hypotheses { in_equilibrium, .. } = hypotheses();
    Entry::new("note 6", "Which force")
        .states("«augmented::contact_force: u=u_k» = «augmented::update: λ=λ_k, u=u_k»")
        .assuming([in_equilibrium])
        .functions(["augmented::contact_force"])
        .follows_from(["1.18", "1.19"])
        .claims([equal("force", augmented::contact_force(s, u), lambda + penalty::contact_force(s, eps, u))])
}

fn note_7() -> Entry {
    Entry::new("note 7", "One letter with two meanings")
        .states("The root of (1.26) is called the rate; λ is the multiplier")
        .functions(["ode::rate", "ode::characteristic"])
        .follows_from(["1.26"])
}

fn note_8() -> Entry {
    let Case { system: s, u, eps, lambda, .. } = symbols();
    let Hypotheses { stiffness, penalty, some_bits, computed_repeats, one_bit, .. } = hypotheses();
    let r = &system::reaction(s);
    let bound = &rounding::fixed_point_error(s, eps, lambda, precision());
    let growth = (int(3) + eta()) / (precision() - int(1));
    let [height, length] = [s.h.abs(), lambda.abs() / eps];
    let lengths = s.h.abs() + system::gap(s).abs() + r / eps;
    let [length_scale, _, force_scale] = scales();
    let deflection = augmented::deflection(s, eps, lambda).with_rounding();
    let update = augmented::update(s, eps, lambda, u).with_rounding();
    Entry::new("note 8", "Not in every precision")
        .states("Rounding stops the augmentation at a floor of about η (|H| + R/ε)")
        .assuming([penalty])
        .functions([
            "rounding::fixed_point_error",
            "rounding::floor_scale",
            "rounding::unit_roundoff",
            "rounding::deflection_error",
            "rounding::penalty_force_error",
            "rounding::best_compliance_squared",
            "rounding::penetration_drift",
            "rounding::multiplier_drift",
        ])
        .follows_from(["1.16"])
        .claims([
            within("floor", contact::penetration(s, u), bound).assuming([computed_repeats]),
            equal("floor-in-parts", bound * precision(), height + &length + growth * length)
                .assuming([one_bit]),
            equal("drift-in-parts", rounding::floor_scale(s, eps, precision()) * precision(), lengths)
                .assuming([some_bits]),
            equal("units", in_other_units(&deflection), deflection * length_scale)
                .only_assuming([stiffness, penalty]),
            equal("units-of-force", in_other_units(&update), update * force_scale).only_assuming([]),
        ])
}

fn note_9() -> Entry {
    let Case { system: s, eps, .. } = symbols();
    let Hypotheses { stiffness, penalty, .. } = hypotheses();
    let ratio = eps / &s.c;
    Entry::new("note 9", "The effort depends on ε")
        .states("(c/ε) Λ < Λ/ln(1 + ε/c) < (c/ε + ½) Λ for Λ = ln(|p₀|/tol) > 0")
        .assuming([stiffness, penalty])
        .follows_from(["1.33"])
        .claims([
            positive("more-than", ratio.exp() - (int(1) + &ratio)),
            positive("less-than", int(1) + &ratio - (int(2) * &ratio / (int(2) + &ratio)).exp()),
        ])
}

/// Scales of length, mass and force, as powers of two.
fn scales() -> [&'static Tree; 3] {
    static SCALES: LazyLock<[Tree; 3]> = LazyLock::new(|| claim::SCALES.map(|name| Tree::symbol(name)));
    SCALES.each_ref()
}

/// Returns a formula of quantities in these units.
fn in_other_units(formula: &Tree) -> Tree {
    let Case { system: SpringMass { c, m, g, l, h }, u, eps, lambda, .. } = symbols();
    let [a, b, f] = scales();
    let units = [(c, f / a), (m, b.clone()), (g, f / b), (l, a.clone()), (h, a.clone())];
    let own = [(u, a.clone()), (eps, f / a), (lambda, f.clone())];
    let scaled =
        units.into_iter().chain(own).map(|(x, unit)| (x.first_symbol().expect("a symbol"), x * unit));
    formula.substitute(&scaled.collect::<Vec<_>>())
}

/// Returns the next multiplier with unilateral contact.
fn unilateral_step(lambda: &Tree) -> Tree {
    let Case { system: s, eps, .. } = symbols();
    augmented::unilateral_update(s, eps, lambda, &augmented::unilateral_deflection(s, eps, lambda))
}

/// Force at p of the functional W = (1 − 1/(2 (1 + ε))) p², which has all three properties that the chapter
/// requires.
fn saturating_force(eps: &Tree, p: &Tree) -> Tree {
    let (eps, p) = (Dual::constant(eps.clone()), Dual::variable(p.clone()));
    let one = Dual::<Tree>::int(1);
    let functional = (&one - &one / (Dual::int(2) * (&one + &eps))) * &p * &p;
    functional.derivative
}

/// Functional W = ε p²/(1 + p²), which lacks one of these properties: it is bounded in p.
fn bounded_penalty(eps: &Tree, p: &Tree) -> Tree {
    eps * p * p / (int(1) + p * p)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The intermediate quantities of the drift are those of the functions themselves.
    #[test]
    fn the_unilateral_drift_claim_computes_with_the_functions_of_the_chapter() {
        let Case { system: s, u, eps, .. } = symbols();
        let own =
            |claim: &&Statement| (claim.equation(), claim.name()) == ("note 4", "float-unilateral-drift");
        let claim = crate::claims::claims().find(own).expect("the claim");
        let ([v, deflection, bracket], Some(sequence)) = (claim.computed(), claim.conclusion()) else {
            panic!("three computed quantities of a sequence");
        };
        let computed = deflection.formula.substitute(&[(v.symbol, v.formula.clone())]);
        assert_eq!(computed, augmented::unilateral_deflection(s, eps, member()).with_rounding());
        let next = sequence.step[0].substitute(&[(bracket.symbol, bracket.formula.clone())]);
        assert_eq!(next, augmented::unilateral_update(s, eps, member(), u).with_rounding());
    }
}
