//! All claims. Whoever adds an equation adds what is claimed of it here.

use super::{Case, Claim, Given, Kind, MEMBERS, Rate, Relation, Var};
use crate::chapter::{augmented, beyond, contact, lagrange, ode, penalty, structure, system};
use crate::number::{Dual, Exponential, Field, PositivePart, Tree};
use num_traits::{One, Zero};

macro_rules! list {
    ($($equation:literal $name:literal [$($given:ident)*] $kind:expr;)*) => {
        vec![$(Claim { equation: $equation, name: $name, given: &[$(Given::$given),*], kind: $kind }),*]
    };
}

fn equal((left, right): (Tree, Tree)) -> Kind {
    Kind::Equal(left, right)
}

/// What the members of a sequence are called in its step.
fn members<const N: usize>() -> [Tree; N] {
    std::array::from_fn(|i| Tree::symbol(MEMBERS[i]))
}

fn half(x: Tree) -> Tree {
    x / Tree::int(2)
}

fn square(x: Tree) -> Tree {
    &x * &x
}

/// Both partial derivatives of the two lines of (1.8): the Hessian of (1.7).
fn hessian_determinant(case: &Case<Tree>) -> Tree {
    let along = |by| {
        let dual = case.along(by);
        lagrange::residual(&dual.system, &dual.u, &dual.lambda).map(|line| line.derivative)
    };
    let ([a, c], [b, d]) = (along(Var::U), along(Var::Lambda));
    a * d - b * c
}

/// One step of (1.16): the next multiplier and the deflection that goes with it.
fn augment(case: &Case<Tree>, x: &[Tree]) -> Vec<Tree> {
    let lambda = augmented::update(&case.system, &case.eps, &x[0], &x[1]);
    let u = augmented::deflection(&case.system, &case.eps, &lambda);
    vec![lambda, u]
}

/// Aitken's formula of the case's multiplier and the next two.
fn extrapolated(case: &Case<Tree>) -> Tree {
    let first = augment(case, &[case.lambda.clone(), iterate(case)]);
    let second = augment(case, &first);
    beyond::aitken(&case.lambda, &first[0], &second[0])
}

/// The deflection that goes with the case's multiplier.
fn iterate(case: &Case<Tree>) -> Tree {
    augmented::deflection(&case.system, &case.eps, &case.lambda)
}

/// The same over a plane that never pulls.
fn unilateral_iterate(case: &Case<Tree>) -> Tree {
    augmented::unilateral_deflection(&case.system, &case.eps, &case.lambda)
}

/// The next multiplier over a plane that never pulls.
fn unilateral_step(case: &Case<Tree>, lambda: &Tree) -> Tree {
    let u = augmented::unilateral_deflection(&case.system, &case.eps, lambda);
    augmented::unilateral_update(&case.system, &case.eps, lambda, &u)
}

/// Note 3: a functional with all three properties that the chapter asks for.
fn saturating_penalty<T: Field>(eps: &T, p: &T) -> T {
    (T::one() - T::one() / (T::int(2) * (T::one() + eps))) * p * p
}

/// The penetration that it leaves.
fn stalled_penetration(case: &Case<Tree>) -> Tree {
    let slope =
        saturating_penalty(&Dual::constant(case.eps.clone()), &Dual::variable(Tree::one())).derivative;
    system::reaction(&case.system) / (&case.system.c + slope)
}

/// Note 3: a functional that lacks one of them.
fn bounded_penalty(eps: &Tree, p: &Tree) -> Tree {
    let square = p * p;
    eps * &square / (Tree::one() + square)
}

/// The derivative of a function of time that satisfies (1.23) is its velocity.
fn follows_the_ode(x: &Case<Tree>, u: Tree) -> Tree {
    ode::velocity(&x.system, &x.eps, &u)
}

/// A bound of the distance of (1.30) from Δ that tends to zero: e⁻ˢ ≤ 1/(1 + s).
fn reciprocal_decay(x: &Case<Tree>) -> Tree {
    contact::penetration(&x.system, &x.u) / (Tree::one() - ode::rate(&x.system, &x.eps) * &x.t)
}

/// The residuals of (1.6) for its solution.
fn kkt(x: &Case<Tree>) -> contact::Kkt<Tree> {
    contact::kkt(&x.system, &contact::deflection(&x.system), &contact::contact_force(&x.system))
}

/// Every claim, in an order of its own; within an entry they are shown in it.
#[rustfmt::skip]
pub(super) fn record() -> Vec<Claim> {
    use Kind::*;
    use Relation::*;
    let x = &Case::of_symbols();
    let Case { system: s, u, v, du, alpha, eps, eps4, lambda, q, k, t, tol } = x;
    list! {
        "1.1" "forces" [] Equal(structure::residual(s, u), structure::spring_force(s, u) - system::weight(s));
        "1.1" "root" [Stiffness] Equal(structure::residual(s, &structure::deflection(s)), Tree::zero());
        "1.1" "unique" [Stiffness] Equal(structure::residual(s, u), &s.c * (u - structure::deflection(s)));
        "1.2" "linear" [] Equal(structure::virtual_work(s, u, &(du + v)), structure::virtual_work(s, u, du) + structure::virtual_work(s, u, v));
        "1.2" "coefficient" [] Equal(structure::virtual_work(s, u, &Tree::one()), structure::residual(s, u));
        // Zero for every δu: in particular for this one.
        "1.2" "only-equilibrium" [] equal({ let r = structure::residual(s, u); (structure::virtual_work(s, u, &r), &r * &r) });
        "1.3" "variation" [] Derivative { of: structure::potential_energy(s, &(u + alpha * du)), by: Var::Alpha,
            is: structure::virtual_work(s, &(u + alpha * du), du) };
        "1.3" "weak-form" [] Equal(structure::first_variation(s, u, du), structure::virtual_work(s, u, du));
        "1.3" "central-difference" [] Equal(
            structure::potential_energy(s, &(u + du)) - structure::potential_energy(s, &(u - du)),
            Tree::int(2) * structure::virtual_work(s, u, du));
        "1.4" "slope" [] Derivative { of: structure::potential_energy(s, u), by: Var::U, is: structure::residual(s, u) };
        "1.4" "excess" [Stiffness] equal({ let least = structure::deflection(s); (
            structure::potential_energy(s, u) - structure::potential_energy(s, &least),
            half(&s.c * square(u - &least))) });
        "1.4" "minimum" [Stiffness] Sign(NonNegative, structure::potential_energy(s, u) - structure::least_energy(s));
        "1.4" "least" [Stiffness] Equal(structure::potential_energy(s, &structure::deflection(s)), structure::least_energy(s));

        "1.5" "at-the-gap" [] Equal(contact::penetration(s, &system::gap(s)), Tree::zero());
        "1.5" "slope" [] Derivative { of: contact::penetration(s, u), by: Var::U, is: Tree::one() };
        "1.5" "free" [Stiffness] Equal(contact::penetration(s, &structure::deflection(s)), system::reaction(s) / &s.c);
        "1.6" "force-from-deflection" [] Equal(
            contact::equilibrium(s, u, lambda),
            &s.c * contact::penetration(s, u) + lambda - system::reaction(s));
        // By equilibrium N = m g − c u: a mass short of the plane with R > 0 would need a force there.
        // Of two solutions, each with p N = 0, p ≤ 0 and N ≥ 0, the right side is not positive: they are one.
        "1.6" "unique" [] equal({ let p = |u: &Tree| contact::penetration(s, u); let n = |u: &Tree| augmented::contact_force(s, u);
            (&s.c * square(u - v), p(u) * n(v) + p(v) * n(u) - p(u) * n(u) - p(v) * n(v)) });
        "1.6" "contact-excludes-gap" [Stiffness Contact Clear] Sign(Positive, -(contact::penetration(s, u) * augmented::contact_force(s, u)));
        // … and one at the plane with R < 0 would be pulled.
        "1.6" "separation-excludes-touch" [Separated] Sign(Positive, structure::residual(s, &system::gap(s)));

        "1.7" "by-deflection" [] Derivative { of: lagrange::functional(s, u, lambda), by: Var::U, is: { let [first, _] = lagrange::residual(s, u, lambda); first } };
        "1.7" "by-multiplier" [] Derivative { of: lagrange::functional(s, u, lambda), by: Var::Lambda, is: { let [_, second] = lagrange::residual(s, u, lambda); second } };
        "1.7" "hessian" [] Equal(hessian_determinant(x), Tree::int(-1));
        "1.8" "equilibrium" [] equal({ let [first, _] = lagrange::residual(s, &lagrange::deflection(s), &lagrange::multiplier(s)); (first, Tree::zero()) });
        "1.8" "constraint" [] equal({ let [_, second] = lagrange::residual(s, &lagrange::deflection(s), &lagrange::multiplier(s)); (second, Tree::zero()) });
        "1.8" "unique-deflection" [] equal({ let [_, second] = lagrange::residual(s, u, lambda); (second, u - lagrange::deflection(s)) });
        "1.8" "unique-multiplier" [] equal({ let [first, second] = lagrange::residual(s, u, lambda); (first - &s.c * second, lambda - lagrange::multiplier(s)) });
        "1.8" "complementary" [] Equal(contact::penetration(s, &lagrange::deflection(s)) * lagrange::multiplier(s), Tree::zero());
        "Remark 1.3.1" "exact" [] Equal(contact::penetration(s, &lagrange::deflection(s)), Tree::zero());

        "1.9" "least" [Stiffness Penalty] Equal(penalty::energy(s, eps, &penalty::deflection(s, eps)), penalty::least_energy(s, eps));
        "1.9" "excess" [Stiffness Penalty] Equal(
            penalty::energy(s, eps, u) - penalty::least_energy(s, eps),
            half(penalty::total_stiffness(s, eps) * square(u - penalty::deflection(s, eps))));
        "1.10" "vanishes-at-contact" [] Equal(penalty::series(eps, std::slice::from_ref(eps4), &Tree::zero()), Tree::zero());
        "1.10" "positive" [Penalty Quartic Penetrating] Sign(Positive, penalty::series(eps, std::slice::from_ref(eps4), &contact::penetration(s, u)));
        "1.10" "increasing" [Penalty Quartic Penetrating] Sign(Positive, penalty::series_force(eps, std::slice::from_ref(eps4), &contact::penetration(s, u)));
        "1.10" "unbounded" [] Derivative { of: penalty::series(eps, std::slice::from_ref(eps4), u), by: Var::Eps, is: half(u * u) };
        "1.10" "one-term" [] Equal(penalty::series(eps, &[], u), penalty::functional(eps, u));
        "1.10" "force" [] Equal(penalty::series_force(eps, std::slice::from_ref(eps4), u), eps * u + Tree::int(4) * eps4 * u * u * u);
        "1.10" "slope" [] Derivative { of: penalty::series(eps, std::slice::from_ref(eps4), u), by: Var::U, is: penalty::series_force(eps, std::slice::from_ref(eps4), u) };
        "1.10" "odd" [] equal({ let f = |p: &Tree| penalty::series_residual(s, eps, std::slice::from_ref(eps4), p);
            (f(u) + f(&-u), -(Tree::int(2) * system::reaction(s))) });
        "1.10" "stiffens" [] Derivative { of: penalty::series_residual(s, eps, std::slice::from_ref(eps4), u), by: Var::U,
            is: penalty::total_stiffness(s, eps) + Tree::int(12) * eps4 * u * u };
        "1.10" "one-root" [Stiffness Penalty Quartic] Sign(Positive, {
            let dual = x.along(Var::U);
            penalty::series_residual(&dual.system, &dual.eps, std::slice::from_ref(&dual.eps4), &dual.u).derivative });
        "1.11" "stationary" [] Derivative { of: penalty::energy(s, eps, u), by: Var::U, is: penalty::residual(s, eps, u) };
        "1.11" "root" [Stiffness Penalty] Equal(penalty::residual(s, eps, &penalty::deflection(s, eps)), Tree::zero());
        "1.11" "two-springs" [] Equal(penalty::residual(s, eps, u), contact::equilibrium(s, u, &penalty::contact_force(s, eps, u)));
        "1.12" "at-the-root" [Stiffness Penalty] Equal(penalty::contact_force(s, eps, &penalty::deflection(s, eps)), penalty::force_at_root(s, eps));
        "1.12" "pushes" [Stiffness Penalty Contact] Sign(Positive, penalty::force_at_root(s, eps));
        "1.12" "error" [Stiffness Penalty] Equal(system::reaction(s) - penalty::force_at_root(s, eps), &s.c * penalty::penetration(s, eps));
        "1.12" "relative-error" [Stiffness Penalty] Equal(system::reaction(s) - penalty::force_at_root(s, eps), augmented::contraction(s, eps) * system::reaction(s));
        "1.12" "complementarity" [Stiffness Penalty] equal({ let p = penalty::penetration(s, eps); (&p * penalty::force_at_root(s, eps), eps * &p * &p) });
        "Fig. 1.2" "force" [] Derivative { of: penalty::functional(eps, &contact::penetration(s, u)), by: Var::U, is: penalty::contact_force(s, eps, u) };
        "Fig. 1.2" "stiffness" [] Derivative { of: penalty::residual(s, eps, u), by: Var::U, is: penalty::total_stiffness(s, eps) };
        "1.13" "rate" [Stiffness Penalty] Equal(penalty::total_stiffness(s, eps) * (penalty::deflection(s, eps) - system::gap(s)), system::reaction(s));
        "1.13" "limit" [Stiffness Penalty] Limit { of: penalty::deflection(s, eps), by: Var::Eps, to: system::gap(s),
            rate: Rate::Exactly(system::reaction(s) / penalty::total_stiffness(s, eps)) };
        "1.13" "two-forms" [Stiffness Penalty] Equal(penalty::deflection(s, eps), penalty::deflection_divided(s, eps));
        "1.13" "slope" [Stiffness Penalty] Derivative { of: contact::penetration(s, &penalty::deflection(s, eps)), by: Var::Eps,
            is: -system::reaction(s) / square(penalty::total_stiffness(s, eps)) };
        "1.13" "penetration-vanishes" [Stiffness Penalty] Limit { of: contact::penetration(s, &penalty::deflection(s, eps)), by: Var::Eps, to: Tree::zero(),
            rate: Rate::Exactly(penalty::penetration(s, eps)) };
        "Remark 1.3.2" "enough" [Tolerance Contact Enough] Sign(NonNegative, tol - penalty::penetration(s, eps));
        "Remark 1.3.2" "least" [Tolerance Contact] Equal(penalty::penetration(s, &penalty::penalty_for(s, tol)), tol.clone());

        "Remark 1.3.2" "necessary" [Stiffness Penalty Tolerance WithinTolerance] Sign(NonNegative, eps - penalty::penalty_for(s, tol));
        "1.14" "least" [Stiffness Penalty] Equal(augmented::functional(s, eps, lambda, &iterate(x)), augmented::least_value(s, eps, lambda));
        "1.14" "excess" [Stiffness Penalty] Equal(
            augmented::functional(s, eps, lambda, u) - augmented::least_value(s, eps, lambda),
            half(penalty::total_stiffness(s, eps) * square(u - iterate(x))));
        "1.14" "without-multiplier" [] Equal(augmented::functional(s, eps, &Tree::zero(), u), penalty::energy(s, eps, u));
        "1.14" "without-penalty" [] Equal(augmented::functional(s, &Tree::zero(), lambda, u), lagrange::functional(s, u, lambda));
        "1.15" "stationary" [] Derivative { of: augmented::functional(s, eps, lambda, u), by: Var::U, is: augmented::stationarity(s, eps, lambda, u) };
        "1.15" "written-out" [] Equal(augmented::stationarity(s, eps, lambda, u), augmented::equilibrium(s, eps, lambda, u));
        "1.16" "first-step" [Stiffness Penalty] Equal(augmented::deflection(s, eps, &Tree::zero()), penalty::deflection(s, eps));
        "1.16" "closed-form" [Stiffness Penalty] Induction {
            ratio: augmented::contraction(s, eps),
            start: vec![lambda.clone(), iterate(x)],
            step: augment(x, &members::<2>()),
            closed: { let decay = q; vec![augmented::multiplier_after(s, lambda, decay), augmented::deflection_after(s, eps, lambda, decay)] } };
        "1.16" "penetration" [Stiffness Penalty] Equal(
            contact::penetration(s, &augmented::deflection_after(s, eps, lambda, q)),
            augmented::penetration_after(s, eps, lambda, q));
        "Theorem 1.3.3" "contracts" [Stiffness Penalty] Vanishing { ratio: augmented::contraction(s, eps),
            of: { let decay = q; augmented::penetration_after(s, eps, lambda, decay) }, to: Tree::zero() };
        "Theorem 1.3.3" "falls" [Stiffness Penalty BelowReaction Power] Sign(Positive, {
            let next = augmented::contraction(s, eps) * q;
            augmented::penetration_after(s, eps, lambda, q) - augmented::penetration_after(s, eps, lambda, &next) });
        "Theorem 1.3.3" "rises" [Stiffness Penalty AboveReaction Power] Sign(Positive, {
            let next = augmented::contraction(s, eps) * q;
            augmented::penetration_after(s, eps, lambda, &next) - augmented::penetration_after(s, eps, lambda, q) });
        "Theorem 1.3.3" "force" [Stiffness Penalty] Vanishing { ratio: augmented::contraction(s, eps),
            of: { let decay = q; augmented::multiplier_after(s, lambda, decay) }, to: system::reaction(s) };
        "1.17" "stays-positive" [Stiffness Penalty BelowReaction Power] Sign(Positive, augmented::penetration_after(s, eps, lambda, q));
        "1.17" "stays-negative" [Stiffness Penalty AboveReaction Power] Sign(Positive, -augmented::penetration_after(s, eps, lambda, q));
        "1.17" "harmonic-step" [Stiffness Penalty Count] Sign(NonNegative, {
            let next = k + Tree::one();
            augmented::harmonic_bound(s, eps, &next) - augmented::contraction(s, eps) * augmented::harmonic_bound(s, eps, k) });
        "1.17" "harmonic-margin" [Stiffness Penalty Count] equal({
            let (c, stiffness) = (&s.c, |k: Tree| &s.c + k * eps);
            let bound = |k: &Tree| augmented::harmonic_bound(s, eps, k);
            let (next, factor) = (k + Tree::one(), augmented::contraction(s, eps));
            ((bound(&next) - factor * bound(k)) * stiffness(Tree::one()) * stiffness(k.clone()) * stiffness(next), c * k * square(eps.clone())) });
        "1.17" "harmonic-start" [Stiffness] Equal(augmented::harmonic_bound(s, eps, &Tree::zero()), Tree::one());
        "1.17" "harmonic-limit" [Stiffness Penalty Count] Limit { of: augmented::harmonic_bound(s, eps, k), by: Var::K, to: Tree::zero(),
            rate: Rate::Exactly(Tree::one() / (Tree::one() + k * eps / &s.c)) };
        "1.18" "next-multiplier" [Equilibrium] Equal(augmented::update(s, eps, lambda, u), augmented::contact_force(s, u));
        "1.19" "root" [Stiffness Penalty] Equal(augmented::equilibrium(s, eps, lambda, &iterate(x)), Tree::zero());
        "1.20" "next-root" [Stiffness Penalty] equal({ let next = augment(x, &[lambda.clone(), iterate(x)]);
            (augmented::equilibrium(s, eps, &next[0], &next[1]), Tree::zero()) });
        "1.20" "missing-force" [Equilibrium] Equal(
            &s.c * contact::penetration(s, u),
            system::reaction(s) - augmented::update(s, eps, lambda, u));
        "1.21" "eliminated" [Equilibrium NextEquilibrium] equal(augmented::recursion(s, eps, u, v));
        "1.21" "difference" [] equal({ let (left, right) = augmented::recursion(s, eps, u, v);
            let next = augmented::update(s, eps, lambda, u); (
            augmented::equilibrium(s, eps, &next, v) - augmented::equilibrium(s, eps, lambda, u),
            left - right) });

        "1.22" "iterates" [Stiffness Penalty] equal({
            let after = |decay: &Tree| augmented::deflection_after(s, eps, lambda, decay);
            ode::difference_equation(s, eps, &after(q), &after(&(augmented::contraction(s, eps) * q))) });
        "1.23" "velocity" [Stiffness Penalty] Equal(ode::operator(s, eps, u, &ode::velocity(s, eps, u)), ode::right_side(s, eps));
        "1.23" "explicit-euler" [Stiffness Penalty] equal(augmented::recursion(s, eps, u, &(u + ode::velocity(s, eps, u))));
        "1.24" "linear" [] Equal(
            ode::operator(s, eps, &ode::superposition(u, v), &ode::superposition(du, alpha)),
            ode::operator(s, eps, u, du) + ode::operator(s, eps, v, alpha));
        "1.25" "annihilates" [Stiffness Penalty] Equal(ode::operator(s, eps, u, &(ode::rate(s, eps) * u)), Tree::zero());
        "1.26" "root" [Stiffness Penalty] Equal(ode::characteristic(s, eps, &ode::rate(s, eps)), Tree::zero());
        "1.26" "from-operator" [] Equal(ode::operator(s, eps, u, &(alpha * u)), ode::characteristic(s, eps, alpha) * u);
        "1.26" "contraction" [Stiffness Penalty] Equal(Tree::one() + ode::rate(s, eps), augmented::contraction(s, eps));
        "1.28" "particular" [] Equal(ode::operator(s, eps, &ode::particular(s), &Tree::zero()), ode::right_side(s, eps));
        "1.29" "constant" [] Equal(ode::superposition(&ode::constant(s, u), &ode::particular(s)), u.clone());
        "1.30" "constant-is-penetration" [] Equal(ode::constant(s, u), contact::penetration(s, u));
        "1.33" "count" [Stiffness Penalty] Equal(
            augmented::penetration_after(s, eps, lambda, q) * penalty::total_stiffness(s, eps),
            (system::reaction(s) - lambda) * q);
        "1.33" "growth" [Stiffness Penalty] Equal(Tree::one() / augmented::contraction(s, eps), Tree::one() + eps / &s.c);
        "1.33" "tie" [Stiffness Penalty Power] equal({
            // λ₀ planted so that |p₀| = tol/q: after the steps with ρᵏ = q the penetration *is* the tolerance.
            let start = system::reaction(s) - penalty::total_stiffness(s, eps) * tol / q;
            (augmented::penetration_after(s, eps, &start, q), tol.clone()) });
        "Remark 1.3.6" "lag" [] Equal(augmented::update(s, eps, lambda, u) - lambda, penalty::contact_force(s, eps, u));

        "note 2" "saddle-in-deflection" [] equal({ let (gap, r) = (system::gap(s), system::reaction(s)); (
            lagrange::functional(s, u, &r) - lagrange::functional(s, &gap, &r),
            half(&s.c * square(u - &gap))) });
        "note 2" "least-in-deflection" [Stiffness] Sign(NonNegative, { let (gap, r) = (system::gap(s), system::reaction(s));
            lagrange::functional(s, u, &r) - lagrange::functional(s, &gap, &r) });
        "note 2" "constant-in-multiplier" [] equal({ let gap = system::gap(s); (
            lagrange::functional(s, &gap, lambda), structure::potential_energy(s, &gap)) });
        "note 2" "separated" [Stiffness] equal({ let free = structure::deflection(s); (
            lagrange::functional(s, &free, lambda),
            structure::least_energy(s) + lambda * system::reaction(s) / &s.c) });
        "note 2" "not-positive" [Stiffness] Sign(NonNegative, -structure::least_energy(s));
        "note 3" "energy-bound" [Stiffness Penalty] Sign(NonNegative, { let r = system::reaction(s);
            &r * &r / (Tree::int(2) * &s.c) - penalty::functional(eps, &penalty::penetration(s, eps)) });
        // Positive, increasing and unbounded in p, and yet the penetration does not vanish.
        "note 3" "not-sufficient" [Stiffness Penalty] equal({ let p = stalled_penetration(x);
            (&s.c * &p + saturating_penalty(&Dual::constant(eps.clone()), &Dual::variable(p)).derivative, system::reaction(s)) });
        "note 3" "stalls" [Stiffness Penalty] Limit { of: stalled_penetration(x), by: Var::Eps, to: system::reaction(s) / (&s.c + Tree::int(2)),
            rate: Rate::Exactly(stalled_penetration(x) / ((&s.c + Tree::int(2)) * (Tree::one() + eps))) };
        // Bounded in p, and yet it does: W = ε p²/(1 + p²) is proportional to ε.
        "note 3" "not-necessary" [] Limit { of: bounded_penalty(eps, u), by: Var::U, to: eps.clone(),
            rate: Rate::Exactly(-(eps / (Tree::one() + square(u.clone())))) };
        "note 5" "beyond-twice" [Stiffness BeyondTwice] Vanishing { ratio: augmented::contraction(s, eps),
            of: { let decay = q; augmented::penetration_after(s, eps, lambda, decay) }, to: Tree::zero() };
        "note 5" "alternates" [Stiffness BeyondTwice] Sign(Positive, -augmented::contraction(s, eps));
        "note 5" "twice" [Stiffness Twice] Equal(augmented::contraction(s, eps), Tree::int(-1));
        "note 5" "diverges" [Softening WithinTwice] Sign(Positive, square(s.c.clone()) - square(penalty::total_stiffness(s, eps)));
        "note 5" "no-solution" [Opposite] Equal(augmented::equilibrium(s, eps, lambda, u), lambda - system::reaction(s));
        "note 5" "starts-there" [Stiffness Penalty AtReaction] Equal(augmented::penetration_after(s, eps, lambda, q), Tree::zero());
        "note 5" "maximises" [BeyondOnce] Sign(NonNegative, augmented::least_value(s, eps, lambda) - augmented::functional(s, eps, lambda, u));
        "note 5" "ode-converges" [Stiffness BeyondOnce] Sign(Positive, -ode::rate(s, eps));
        "note 5" "no-penalty" [Stiffness] Equal(augmented::contraction(s, &Tree::zero()), Tree::one());
        "note 6" "force" [Equilibrium] Equal(augmented::contact_force(s, u), lambda + penalty::contact_force(s, eps, u));

        "beyond 2" "one-penalty" [Stiffness Penalty Power] equal({
            let growth = Tree::one() / (augmented::contraction(s, eps) * q);
            let effective = beyond::effective_penalty(s, &growth);
            (penalty::penetration(s, &effective), augmented::penetration_after(s, eps, &Tree::zero(), q)) });
        "beyond 2" "varying" [Stiffness Penalty Power] equal({
            // After steps with whatever penalties, whose (c + ε_i)/c have the product q, and one more with ε.
            let left = |growth: &Tree| penalty::penetration(s, &beyond::effective_penalty(s, growth));
            let lambda = system::reaction(s) - &s.c * left(q);
            let u = augmented::deflection(s, eps, &lambda);
            (contact::penetration(s, &u), left(&(q / augmented::contraction(s, eps)))) });
        "beyond 3" "factor" [Stiffness Penalty] equal({ let r = system::reaction(s); (
            beyond::relaxed_update(s, alpha, lambda, &iterate(x)) - &r,
            beyond::relaxed_contraction(s, eps, alpha) * (lambda - &r)) });
        "beyond 3" "newton" [Stiffness Penalty] Equal(
            beyond::relaxed_update(s, &penalty::total_stiffness(s, eps), lambda, &iterate(x)),
            system::reaction(s));
        "beyond 3" "converges" [Step ShortStep] Sign(Positive, Tree::one() - square(beyond::relaxed_contraction(s, eps, alpha)));
        "beyond 3" "diverges" [Stiffness Penalty LongStep] Sign(Positive, square(beyond::relaxed_contraction(s, eps, alpha)) - Tree::one());
        "beyond 3" "uzawa" [Step UzawaStep] Sign(Positive, Tree::one() - square(beyond::relaxed_contraction(s, &Tree::zero(), alpha)));
        "beyond 4" "dual" [Stiffness] equal({
            let u = augmented::deflection(s, &Tree::zero(), lambda);
            (beyond::dual_functional(s, lambda), lagrange::functional(s, &u, lambda)) });
        "beyond 4" "proximal-step" [Stiffness Penalty] equal({ let next = augmented::update(s, eps, lambda, &iterate(x)); (
            (&next - lambda) / eps,
            (system::reaction(s) - &next) / &s.c) });
        "beyond 4" "envelope" [Stiffness Penalty] equal({ let next = augmented::update(s, eps, lambda, &iterate(x)); (
            beyond::dual_functional(s, &next) - square(&next - lambda) / (Tree::int(2) * eps),
            augmented::least_value(s, eps, lambda)) });
        "beyond 4" "envelope-slope" [Stiffness Penalty] Derivative { of: augmented::least_value(s, eps, lambda), by: Var::Lambda,
            is: contact::penetration(s, &iterate(x)) };
        "beyond 5" "aitken" [Stiffness Penalty BelowReaction] Equal(extrapolated(x), system::reaction(s));
        "beyond 5" "aitken-from-above" [Stiffness Penalty AboveReaction] Equal(extrapolated(x), system::reaction(s));
        "beyond 5" "rises" [Stiffness Penalty] equal({ let after = augmented::multiplier_after(s, lambda, q); (
            augmented::least_value(s, eps, &after),
            structure::potential_energy(s, &system::gap(s))
                - square((system::reaction(s) - lambda) * q) / (Tree::int(2) * penalty::total_stiffness(s, eps))) });

        // With eˣ, which rationals lack.

        "1.27" "annihilated" [Stiffness Penalty] Derivative { of: ode::homogeneous(s, eps, u, t), by: Var::T,
            is: ode::rate(s, eps) * ode::homogeneous(s, eps, u, t) };
        "1.27" "constant" [Stiffness Penalty] Equal(ode::homogeneous(s, eps, u, &Tree::zero()), u.clone());
        "1.29" "solves" [Stiffness Penalty] Derivative { of: ode::general(s, eps, u, t), by: Var::T,
            is: follows_the_ode(x, ode::general(s, eps, u, t)) };
        "1.30" "solves" [Stiffness Penalty] Derivative { of: ode::solution(s, eps, u, t), by: Var::T,
            is: follows_the_ode(x, ode::solution(s, eps, u, t)) };
        "1.30" "starts" [Stiffness Penalty] Equal(ode::solution(s, eps, u, &Tree::zero()), u.clone());
        "1.31" "limit" [Stiffness Penalty Time Penetrating] Limit { of: ode::solution(s, eps, u, t), by: Var::T, to: system::gap(s),
            rate: Rate::Within(reciprocal_decay(x)) };
        // … and from below, or from the plane itself.
        "1.31" "limit-from-below" [Stiffness Penalty Time Clear] Limit { of: ode::solution(s, eps, u, t), by: Var::T, to: system::gap(s),
            rate: Rate::Within(-reciprocal_decay(x)) };
        "1.31" "stays" [Stiffness Penalty] equal({ let gap = system::gap(s); (ode::solution(s, eps, &gap, t), gap) });
        "1.32" "limit" [Stiffness Penalty Time Penetrating] Limit { of: contact::penetration(s, &ode::solution(s, eps, u, t)), by: Var::T, to: Tree::zero(),
            rate: Rate::Within(reciprocal_decay(x)) };
        "1.32" "limit-from-below" [Stiffness Penalty Time Clear] Limit { of: contact::penetration(s, &ode::solution(s, eps, u, t)), by: Var::T, to: Tree::zero(),
            rate: Rate::Within(-reciprocal_decay(x)) };
        "note 5" "strict-bound" [Stiffness Penalty] Sign(Positive, ode::rate(s, eps).exp() - augmented::contraction(s, eps));
        "note 5" "other-side" [Stiffness Penalty] Sign(Positive, augmented::contraction(s, eps) - (-eps / &s.c).exp());
        // From one step to the next: a bound q + t above ρᵏ = q stays above.
        "note 5" "stays-strict" [Stiffness Penalty Power Time] Sign(Positive, ode::rate(s, eps).exp() * (q + t) - augmented::contraction(s, eps) * q);
        "note 5" "flow" [Stiffness Penalty] equal({
            let decay = |t: &Tree| ode::homogeneous(s, eps, &Tree::one(), t);
            (decay(&(t + Tree::one())), decay(t) * decay(&Tree::one())) });
        "note 9" "more-than" [Stiffness Penalty] Sign(Positive, { let ratio = eps / &s.c; ratio.exp() - (Tree::one() + ratio) });
        "note 9" "less-than" [Stiffness Penalty] Sign(Positive, { let ratio = eps / &s.c;
            Tree::one() + &ratio - (Tree::int(2) * &ratio / (Tree::int(2) + &ratio)).exp() });

        // Over a plane that never pulls.

        "1.6" "stationarity" [Stiffness] Equal(kkt(x).stationarity, Tree::zero());
        "1.6" "no-penetration" [Stiffness] Equal(kkt(x).primal, Tree::zero());
        "1.6" "no-pull" [] Equal(contact::kkt(s, u, &contact::contact_force(s)).dual, Tree::zero());
        "1.6" "complementarity" [Stiffness] Equal(kkt(x).complementarity, Tree::zero());
        "1.6" "product" [] Equal(contact::kkt(s, &(system::gap(s) + du), lambda).complementarity, du * lambda);
        "1.6" "pushes" [Contact] Sign(Positive, contact::contact_force(s));
        "1.6" "hangs-free" [Stiffness Separated] Sign(Positive, -contact::penetration(s, &contact::deflection(s)));
        "1.8" "kkt-with-multiplier" [Touching] Equal(lagrange::multiplier(s), contact::contact_force(s));
        "1.13" "unilateral" [Stiffness Penalty Touching] Equal(penalty::unilateral_deflection(s, eps), penalty::deflection(s, eps));
        "1.13" "unilateral-free" [Stiffness Penalty Separated] Equal(penalty::unilateral_deflection(s, eps), structure::deflection(s));
        "note 1" "grazing-deflection" [Stiffness Grazing] Equal(contact::deflection(s), system::gap(s));
        "note 1" "grazing-force" [Grazing] Equal(contact::contact_force(s), Tree::zero());
        "note 4" "equilibrium" [Stiffness Penalty] Equal(augmented::unilateral_equilibrium(s, eps, lambda, &unilateral_iterate(x)), Tree::zero());
        "note 4" "never-pulls" [Stiffness Penalty] Sign(NonNegative, augmented::unilateral_update(s, eps, lambda, &unilateral_iterate(x)));
        "note 4" "functional-where-active" [Penalty Multiplier Penetrating] Equal(
            augmented::unilateral_functional(s, eps, lambda, u), augmented::functional(s, eps, lambda, u));
        "note 4" "functional-elsewhere" [Penalty Inactive] Equal(
            augmented::unilateral_functional(s, eps, lambda, u),
            structure::potential_energy(s, u) - square(lambda.clone()) / (Tree::int(2) * eps));
        "note 4" "where-active" [Stiffness Penalty Active] Equal(unilateral_iterate(x), iterate(x));
        "note 4" "multiplier" [Stiffness Penalty] Equal(
            augmented::unilateral_update(s, eps, lambda, &unilateral_iterate(x)),
            ((&s.c * lambda + eps * system::reaction(s)) / penalty::total_stiffness(s, eps)).positive_part());
        "note 4" "natural-residual" [Stiffness Penalty] equal({ let u = unilateral_iterate(x); (
            augmented::natural_residual(s, eps, lambda, &u),
            (augmented::unilateral_update(s, eps, lambda, &u) - lambda) / eps) });
        "note 4" "residual-bounds-error" [Stiffness Penalty] Sign(NonNegative, { let u = unilateral_iterate(x);
            square(augmented::natural_residual(s, eps, lambda, &u)) - square(u - contact::deflection(s)) });
        "note 4" "force-error" [Stiffness Penalty] equal({ let u = unilateral_iterate(x); (
            contact::contact_force(s) - augmented::unilateral_update(s, eps, lambda, &u),
            &s.c * (u - contact::deflection(s))) });
        "note 4" "contracts" [Stiffness Penalty Touching] Sign(NonNegative, { let r = system::reaction(s);
            let next = augmented::unilateral_update(s, eps, lambda, &unilateral_iterate(x));
            square(lambda - &r) - square(next - &r) });
        "note 4" "active-step" [Stiffness Penalty Active] Equal(unilateral_step(x, lambda), augmented::multiplier_after(s, lambda, &augmented::contraction(s, eps)));
        "note 4" "idle-step" [Stiffness Penalty Idle] Equal(unilateral_step(x, lambda), Tree::zero());
        "note 4" "idle-deflection" [Stiffness Penalty Idle] Equal(unilateral_iterate(x), structure::deflection(s));
        "note 4" "stays-free" [Stiffness Penalty Separated] Equal(unilateral_step(x, &Tree::zero()), Tree::zero());
        "note 4" "contact-sequence" [Stiffness Penalty Touching Multiplier Carried] Induction {
            ratio: augmented::contraction(s, eps),
            start: vec![lambda.clone()],
            step: { let lambda = members::<1>(); vec![unilateral_step(x, &lambda[0])] },
            closed: { let decay = q; vec![augmented::multiplier_after(s, lambda, decay)] } };
        "note 4" "grazing-sequence" [Stiffness Penalty Grazing Multiplier Power] Induction {
            ratio: augmented::contraction(s, eps),
            start: vec![lambda.clone()],
            step: { let lambda = members::<1>(); vec![unilateral_step(x, &lambda[0])] },
            closed: { let decay = q; vec![lambda * decay] } };
        // λ_k > 0 as long as (1 + ε/c)ᵏ < 1 + λ₀/|R|.
        "note 4" "count" [Separated Power] equal({ let r = system::reaction(s); (
            augmented::multiplier_after(s, lambda, q),
            -&r * q * (Tree::one() - lambda / &r - Tree::one() / q)) });
        "note 4" "residual-is-penetration" [Stiffness Penalty Active] equal({ let u = unilateral_iterate(x); (
            augmented::natural_residual(s, eps, lambda, &u), contact::penetration(s, &u)) });
        // With ⟨·⟩ in the update alone the iteration stops short of the answer.
        "note 4" "one-bracket-stalls" [Stiffness Penalty Separated] equal({
            let u = augmented::deflection(s, eps, &Tree::zero());
            (augmented::unilateral_update(s, eps, &Tree::zero(), &u), Tree::zero()) });
        "note 4" "one-bracket-errs" [Stiffness Penalty Separated] Sign(Positive,             augmented::deflection(s, eps, &Tree::zero()) - contact::deflection(s));
        "beyond 1" "force" [] Equal(contact::contact_force(s), system::reaction(s).positive_part());
        "beyond 1" "gap" [Stiffness] Equal(-&s.c * contact::penetration(s, &contact::deflection(s)), (-system::reaction(s)).positive_part());
        "beyond 6" "exact-penalty" [Stiffness Touching StrongEnough] Sign(NonNegative, { let gap = system::gap(s);
            structure::potential_energy(s, u) + beyond::exact_penalty(eps, &contact::penetration(s, u))
                - structure::potential_energy(s, &gap) });
    }
}
