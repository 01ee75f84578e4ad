//! Where the chapter is loose: notes 1 to 9.

use super::prelude::*;
use crate::chapter::{SpringMass, augmented, contact, lagrange, ode, penalty, rounding, structure, system};
use crate::formula::claim;
use std::sync::LazyLock;

/// Its entries, with what is claimed of each.
pub(super) fn entries() -> Vec<Entry> {
    let Case { system: s, u, eps, lambda, q, t, .. } = symbols();
    let Given {
        stiffness,
        penalty,
        softening,
        some_bits,
        beyond_twice,
        within_twice,
        twice,
        touching,
        grazing,
        separated,
        opposite,
        beyond_once,
        penetrating,
        multiplier,
        at_reaction,
        carried,
        active,
        idle,
        inactive,
        in_equilibrium,
        power,
        time,
        computed_repeats,
        one_bit,
        ..
    } = given();
    let iterate = &augmented::deflection(s, eps, lambda);
    let (gap, r) = (&system::gap(s), &system::reaction(s));
    let (zero, one) = (&int(0), &int(1));
    // The same over a plane that never pulls: the deflection that goes with λ, and the next λ.
    let unilateral = &augmented::unilateral_deflection(s, eps, lambda);
    let next = &augmented::unilateral_update(s, eps, lambda, unilateral);
    let stalled = &(r / (&s.c + saturating_force(eps, one)));
    vec![
        Entry::new("note 1", "Grazing")
            .states("p = 0 with N = 0 is a third state")
            .given([stiffness, grazing])
            .functions(["contact::deflection"])
            .follows_from(["1.6"])
            .claims([
                equal("grazing-deflection", [stiffness, grazing], contact::deflection(s), gap),
                equal("grazing-force", [grazing], contact::contact_force(s), 0),
            ]),
        Entry::new("note 2", "A saddle point")
            .states("(1.7) is least in u and constant in λ at (Δ, R)")
            .given([stiffness])
            .functions(["lagrange::functional"])
            .follows_from(["1.7", "1.8"])
            .claims([
                equal(
                    "saddle-in-deflection",
                    [],
                    lagrange::functional(s, u, r) - lagrange::functional(s, gap, r),
                    half(&s.c * square(u - gap)),
                ),
                non_negative(
                    "least-in-deflection",
                    [stiffness],
                    lagrange::functional(s, u, r) - lagrange::functional(s, gap, r),
                ),
                equal(
                    "constant-in-multiplier",
                    [],
                    lagrange::functional(s, gap, lambda),
                    structure::potential_energy(s, gap),
                ),
                {
                    let free = structure::deflection(s);
                    equal(
                        "separated",
                        [stiffness],
                        lagrange::functional(s, &free, lambda),
                        structure::least_energy(s) + lambda * r / &s.c,
                    )
                },
                non_negative("not-positive", [stiffness], -structure::least_energy(s)),
            ]),
        Entry::new("note 3", "What a penalty functional needs")
            .states("W_ε(p_ε) ≤ R²/(2c)")
            .given([stiffness, penalty])
            .functions(["penalty::functional"])
            .follows_from(["1.10"])
            .claims([
                non_negative(
                    "energy-bound",
                    [stiffness, penalty],
                    r * r / (int(2) * &s.c) - penalty::functional(eps, &penalty::penetration(s, eps)),
                ),
                // Positive, increasing and unbounded in p, and yet the penetration does not vanish.
                equal(
                    "not-sufficient",
                    [stiffness, penalty],
                    &s.c * stalled + saturating_force(eps, stalled),
                    r,
                ),
                limit(
                    "stalls",
                    [stiffness, penalty],
                    stalled,
                    eps,
                    r / (&s.c + int(2)),
                    Exactly(stalled / ((&s.c + int(2)) * (one + eps))),
                ),
                // Bounded in p, and yet it does: W = ε p²/(1 + p²) is proportional to ε.
                limit(
                    "not-necessary",
                    [],
                    bounded_penalty(eps, u),
                    u,
                    eps,
                    Exactly(-(eps / (one + square(u)))),
                ),
            ]),
        Entry::new("note 4", "A plane that never pulls")
            .states(
                "λ_k = «augmented::unilateral_update: λ=λ_{k−1}, u=u_{k−1}» and \
                 «augmented::unilateral_equilibrium: λ=λ_k, u=u_k» = 0",
            )
            .given([stiffness, penalty])
            .functions([
                "augmented::unilateral_deflection",
                "augmented::unilateral_update",
                "augmented::unilateral_equilibrium",
                "augmented::unilateral_functional",
                "augmented::natural_residual",
                "penalty::unilateral_deflection",
            ])
            .follows_from(["1.6", "1.16"])
            .claims([
                equal(
                    "equilibrium",
                    [stiffness, penalty],
                    augmented::unilateral_equilibrium(s, eps, lambda, unilateral),
                    0,
                ),
                non_negative("never-pulls", [stiffness, penalty], next),
                equal(
                    "functional-where-active",
                    [penalty, multiplier, penetrating],
                    augmented::unilateral_functional(s, eps, lambda, u),
                    augmented::functional(s, eps, lambda, u),
                ),
                equal(
                    "functional-elsewhere",
                    [penalty, inactive],
                    augmented::unilateral_functional(s, eps, lambda, u),
                    structure::potential_energy(s, u) - square(lambda) / (int(2) * eps),
                ),
                equal("where-active", [stiffness, penalty, active], unilateral, iterate),
                equal(
                    "multiplier",
                    [stiffness, penalty],
                    next,
                    ((&s.c * lambda + eps * r) / penalty::total_stiffness(s, eps)).positive_part(),
                ),
                equal(
                    "natural-residual",
                    [stiffness, penalty],
                    augmented::natural_residual(s, eps, lambda, unilateral),
                    (next - lambda) / eps,
                ),
                non_negative(
                    "residual-bounds-error",
                    [stiffness, penalty],
                    square(augmented::natural_residual(s, eps, lambda, unilateral))
                        - square(unilateral - contact::deflection(s)),
                ),
                equal(
                    "force-error",
                    [stiffness, penalty],
                    contact::contact_force(s) - next,
                    &s.c * (unilateral - contact::deflection(s)),
                ),
                non_negative(
                    "contracts",
                    [stiffness, penalty, touching],
                    square(lambda - r) - square(next - r),
                ),
                equal(
                    "active-step",
                    [stiffness, penalty, active],
                    next,
                    augmented::multiplier_after(s, lambda, &augmented::contraction(s, eps)),
                ),
                equal("idle-step", [stiffness, penalty, idle], next, 0),
                equal("idle-deflection", [stiffness, penalty, idle], unilateral, structure::deflection(s)),
                equal("stays-free", [stiffness, penalty, separated], unilateral_step(zero), 0),
                induction(
                    "contact-sequence",
                    [stiffness, penalty, touching, multiplier, carried],
                    augmented::contraction(s, eps),
                    [lambda.clone()],
                    |[lambda]| [unilateral_step(&lambda)],
                    [augmented::multiplier_after(s, lambda, q)],
                ),
                induction(
                    "grazing-sequence",
                    [stiffness, penalty, grazing, multiplier, power],
                    augmented::contraction(s, eps),
                    [lambda.clone()],
                    |[lambda]| [unilateral_step(&lambda)],
                    [lambda * q],
                ),
                // λ_k > 0 as long as (1 + ε/c)ᵏ < 1 + λ₀/|R|.
                equal(
                    "count",
                    [separated, power],
                    augmented::multiplier_after(s, lambda, q),
                    -r * q * (one - lambda / r - one / q),
                ),
                equal(
                    "residual-is-penetration",
                    [stiffness, penalty, active],
                    augmented::natural_residual(s, eps, lambda, unilateral),
                    contact::penetration(s, unilateral),
                ),
                // With ⟨·⟩ in the update alone the iteration stops short of the answer.
                {
                    let u = augmented::deflection(s, eps, zero);
                    equal(
                        "one-bracket-stalls",
                        [stiffness, penalty, separated],
                        augmented::unilateral_update(s, eps, zero, &u),
                        0,
                    )
                },
                positive(
                    "one-bracket-errs",
                    [stiffness, penalty, separated],
                    augmented::deflection(s, eps, zero) - contact::deflection(s),
                ),
            ]),
        Entry::new("note 5", "An analogy and no proof")
            .states("e^{−ε/c} < ρ < e^{−ε/(c+ε)} for ε > 0, and p_k → 0 also for ε < −2c")
            .given([stiffness])
            .functions(["augmented::contraction"])
            .follows_from(["1.16", "1.30"])
            .claims([
                vanishing(
                    "beyond-twice",
                    [stiffness, beyond_twice],
                    augmented::contraction(s, eps),
                    augmented::penetration_after(s, eps, lambda, q),
                    0,
                ),
                positive("alternates", [stiffness, beyond_twice], -augmented::contraction(s, eps)),
                equal("twice", [stiffness, twice], augmented::contraction(s, eps), -1),
                positive(
                    "diverges",
                    [softening, within_twice],
                    square(&s.c) - square(penalty::total_stiffness(s, eps)),
                ),
                equal("no-solution", [opposite], augmented::equilibrium(s, eps, lambda, u), lambda - r),
                equal(
                    "starts-there",
                    [stiffness, penalty, at_reaction],
                    augmented::penetration_after(s, eps, lambda, q),
                    0,
                ),
                non_negative(
                    "maximises",
                    [beyond_once],
                    augmented::least_value(s, eps, lambda) - augmented::functional(s, eps, lambda, u),
                ),
                positive("ode-converges", [stiffness, beyond_once], -ode::rate(s, eps)),
                equal("no-penalty", [stiffness], augmented::contraction(s, zero), 1),
                positive(
                    "strict-bound",
                    [stiffness, penalty],
                    ode::rate(s, eps).exp() - augmented::contraction(s, eps),
                ),
                positive(
                    "other-side",
                    [stiffness, penalty],
                    augmented::contraction(s, eps) - (-eps / &s.c).exp(),
                ),
                // From one step to the next: a bound q + t above ρᵏ = q stays above.
                positive(
                    "stays-strict",
                    [stiffness, penalty, power, time],
                    ode::rate(s, eps).exp() * (q + t) - augmented::contraction(s, eps) * q,
                ),
                {
                    let decay = |t: &Tree| ode::homogeneous(s, eps, one, t);
                    equal("flow", [stiffness, penalty], decay(&(t + one)), decay(t) * decay(one))
                },
            ]),
        Entry::new("note 6", "Which force")
            .states("«augmented::contact_force: u=u_k» = «augmented::update: λ=λ_k, u=u_k»")
            .given([in_equilibrium])
            .functions(["augmented::contact_force"])
            .follows_from(["1.18", "1.19"])
            .claims([equal(
                "force",
                [in_equilibrium],
                augmented::contact_force(s, u),
                lambda + penalty::contact_force(s, eps, u),
            )]),
        Entry::new("note 8", "Not in every precision")
            .states("Rounding stops the augmentation at a floor of about η (|H| + R/ε)")
            .given([penalty])
            .functions([
                "rounding::fixed_point_error",
                "rounding::floor",
                "rounding::unit_roundoff",
                "rounding::deflection_error",
                "rounding::penalty_force_error",
                "rounding::best_compliance_squared",
                "rounding::penetration_drift",
                "rounding::multiplier_drift",
            ])
            .follows_from(["1.16"])
            .claims([
                within(
                    "floor",
                    [penalty, computed_repeats],
                    contact::penetration(s, u),
                    rounding::fixed_point_error(s, eps, lambda, precision()),
                ),
                {
                    let growth = (int(3) + eta()) / (precision() - one);
                    let [height, length] = [s.h.abs(), lambda.abs() / eps];
                    equal(
                        "floor-in-parts",
                        [penalty, one_bit],
                        rounding::fixed_point_error(s, eps, lambda, precision()) * precision(),
                        height + &length + growth * length,
                    )
                },
                {
                    let lengths = s.h.abs() + system::gap(s).abs() + r / eps;
                    equal(
                        "drift-in-parts",
                        [penalty, some_bits],
                        rounding::floor(s, eps, precision()) * precision(),
                        lengths,
                    )
                },
                {
                    let [a, ..] = scales();
                    let own = augmented::deflection(s, eps, lambda).rounded();
                    equal("units", [stiffness, penalty], in_other_units(&own), own * a)
                },
                {
                    let [_, _, f] = scales();
                    let own = augmented::update(s, eps, lambda, u).rounded();
                    equal("units-of-force", [], in_other_units(&own), own * f)
                },
            ]),
        Entry::new("note 9", "The effort depends on ε")
            .states("(c/ε) Λ < Λ/ln(1 + ε/c) < (c/ε + ½) Λ for Λ = ln(|p₀|/tol) > 0")
            .given([stiffness, penalty])
            .follows_from(["1.33"])
            .claims([
                {
                    let ratio = eps / &s.c;
                    positive("more-than", [stiffness, penalty], ratio.exp() - (one + &ratio))
                },
                {
                    let ratio = eps / &s.c;
                    positive(
                        "less-than",
                        [stiffness, penalty],
                        one + &ratio - (int(2) * &ratio / (int(2) + &ratio)).exp(),
                    )
                },
            ]),
    ]
}

/// Other units, by powers of two: those of length, mass and force.
fn scales() -> [&'static Tree; 3] {
    static SCALES: LazyLock<[Tree; 3]> = LazyLock::new(|| claim::SCALES.map(|name| Tree::symbol(name)));
    SCALES.each_ref()
}

/// A formula of quantities that are given in these units.
fn in_other_units(formula: &Tree) -> Tree {
    let Case { system: SpringMass { c, m, g, l, h }, u, eps, lambda, .. } = symbols();
    let [a, b, f] = scales();
    let units = [(c, f / a), (m, b.clone()), (g, f / b), (l, a.clone()), (h, a.clone())];
    let own = [(u, a.clone()), (eps, f / a), (lambda, f.clone())];
    let scaled =
        units.into_iter().chain(own).map(|(x, unit)| (x.first_symbol().expect("a symbol"), x * unit));
    formula.with(&scaled.collect::<Vec<_>>())
}

/// The next multiplier over a plane that never pulls.
fn unilateral_step(lambda: &Tree) -> Tree {
    let Case { system: s, eps, .. } = symbols();
    augmented::unilateral_update(s, eps, lambda, &augmented::unilateral_deflection(s, eps, lambda))
}

/// The slope at p of a functional W = (1 − 1/(2 (1 + ε))) p² that has all three properties which the
/// chapter asks for.
fn saturating_force(eps: &Tree, p: &Tree) -> Tree {
    let (eps, p) = (Dual::constant(eps.clone()), Dual::variable(p.clone()));
    let one = Dual::<Tree>::int(1);
    let functional = (&one - &one / (Dual::int(2) * (&one + &eps))) * &p * &p;
    functional.derivative
}

/// A functional that lacks one of them.
fn bounded_penalty(eps: &Tree, p: &Tree) -> Tree {
    eps * p * p / (int(1) + p * p)
}
