//! All claims. Whoever adds an equation adds what is claimed of it here.

use super::{Case, Claim, Given, Kind, Rate, Relation, Var};
use crate::chapter::{augmented, beyond, contact, lagrange, ode, penalty, structure, system};
use crate::number::{Dual, Exponential, Field, PositivePart};

macro_rules! list {
    ($($equation:literal $name:literal [$($given:ident)*] $kind:expr;)*) => {
        vec![$(Claim { equation: $equation, name: $name, given: &[$(Given::$given),*], kind: $kind }),*]
    };
}

/// The formula is read twice: in duals, and as it is.
macro_rules! derivative {
    (of: $of:expr, by: $by:expr, is: $is:expr) => {
        Derivative { of: $of, formula: $of, by: $by, is: $is }
    };
}

fn half<T: Field>(x: T) -> T {
    x / T::int(2)
}

fn square<T: Field>(x: T) -> T {
    &x * &x
}

/// Both partial derivatives of the two lines of (1.8): the Hessian of (1.7).
fn hessian_determinant<T: Field>(case: &Case<T>) -> T {
    let along = |by| {
        let dual = case.along(by);
        lagrange::residual(&dual.system, &dual.u, &dual.lambda).map(|line| line.derivative)
    };
    let ([a, c], [b, d]) = (along(Var::U), along(Var::Lambda));
    a * d - b * c
}

/// One step of (1.16): the next multiplier and the deflection that goes with it.
fn augment<T: Field>(case: &Case<T>, x: &[T]) -> Vec<T> {
    let lambda = augmented::update(&case.system, &case.eps, &x[0], &x[1]);
    let u = augmented::deflection(&case.system, &case.eps, &lambda);
    vec![lambda, u]
}

/// Aitken's formula of the case's multiplier and the next two.
fn extrapolated<T: Field>(case: &Case<T>) -> T {
    let first = augment(case, &[case.lambda.clone(), iterate(case)]);
    let second = augment(case, &first);
    beyond::aitken(&case.lambda, &first[0], &second[0])
}

/// The deflection that goes with the case's multiplier.
fn iterate<T: Field>(case: &Case<T>) -> T {
    augmented::deflection(&case.system, &case.eps, &case.lambda)
}

/// The same over a plane that never pulls.
fn unilateral_iterate<T: PositivePart>(case: &Case<T>) -> T {
    augmented::unilateral_deflection(&case.system, &case.eps, &case.lambda)
}

/// The next multiplier over a plane that never pulls.
fn unilateral_step<T: PositivePart>(case: &Case<T>, lambda: &T) -> T {
    let u = augmented::unilateral_deflection(&case.system, &case.eps, lambda);
    augmented::unilateral_update(&case.system, &case.eps, lambda, &u)
}

/// Note 3: a functional with all three properties that the chapter asks for.
fn saturating_penalty<T: Field>(eps: &T, p: &T) -> T {
    (T::one() - T::one() / (T::int(2) * (T::one() + eps))) * p * p
}

/// The penetration that it leaves.
fn stalled_penetration<T: Field>(case: &Case<T>) -> T {
    let slope = saturating_penalty(&Dual::constant(case.eps.clone()), &Dual::variable(T::one())).derivative;
    system::reaction(&case.system) / (&case.system.c + slope)
}

/// Note 3: a functional that lacks one of them.
fn bounded_penalty<T: Field>(eps: &T, p: &T) -> T {
    let square = p * p;
    eps * &square / (T::one() + square)
}

/// Every claim.
pub fn all_claims<T: PositivePart + Exponential>() -> Vec<Claim<T>> {
    claims().into_iter().chain(exponential_claims()).chain(unilateral_claims()).collect()
}

/// Claims that need no more than `+ − × ÷`.
#[rustfmt::skip]
pub fn claims<T: Field>() -> Vec<Claim<T>> {
    use Kind::*;
    use Relation::*;
    list! {
        "1.1" "forces" [] Equal(|x| (structure::residual(&x.system, &x.u), structure::spring_force(&x.system, &x.u) - system::weight(&x.system)));
        "1.1" "root" [Stiffness] Equal(|x| (structure::residual(&x.system, &structure::deflection(&x.system)), T::zero()));
        "1.1" "unique" [Stiffness] Equal(|x| (structure::residual(&x.system, &x.u), &x.system.c * (&x.u - structure::deflection(&x.system))));
        "1.2" "linear" [] Equal(|x| (structure::virtual_work(&x.system, &x.u, &(&x.du + &x.v)), structure::virtual_work(&x.system, &x.u, &x.du) + structure::virtual_work(&x.system, &x.u, &x.v)));
        "1.2" "coefficient" [] Equal(|x| (structure::virtual_work(&x.system, &x.u, &T::one()), structure::residual(&x.system, &x.u)));
        // Zero for every δu: in particular for this one.
        "1.2" "only-equilibrium" [] Equal(|x| { let r = structure::residual(&x.system, &x.u); (structure::virtual_work(&x.system, &x.u, &r), &r * &r) });
        "1.3" "variation" [] derivative!(of: |x| structure::potential_energy(&x.system, &(&x.u + &x.alpha * &x.du)), by: Var::Alpha,
            is: |x| structure::virtual_work(&x.system, &(&x.u + &x.alpha * &x.du), &x.du));
        "1.3" "weak-form" [] Equal(|x| (structure::first_variation(&x.system, &x.u, &x.du), structure::virtual_work(&x.system, &x.u, &x.du)));
        "1.3" "central-difference" [] Equal(|x| (
            structure::potential_energy(&x.system, &(&x.u + &x.du)) - structure::potential_energy(&x.system, &(&x.u - &x.du)),
            T::int(2) * structure::virtual_work(&x.system, &x.u, &x.du)));
        "1.4" "slope" [] derivative!(of: |x| structure::potential_energy(&x.system, &x.u), by: Var::U, is: |x| structure::residual(&x.system, &x.u));
        "1.4" "excess" [Stiffness] Equal(|x| { let least = structure::deflection(&x.system); (
            structure::potential_energy(&x.system, &x.u) - structure::potential_energy(&x.system, &least),
            half(&x.system.c * square(&x.u - &least))) });
        "1.4" "minimum" [Stiffness] Sign(NonNegative, |x| structure::potential_energy(&x.system, &x.u) - structure::least_energy(&x.system));
        "1.4" "least" [Stiffness] Equal(|x| (structure::potential_energy(&x.system, &structure::deflection(&x.system)), structure::least_energy(&x.system)));

        "1.5" "at-the-gap" [] Equal(|x| (contact::penetration(&x.system, &system::gap(&x.system)), T::zero()));
        "1.5" "slope" [] derivative!(of: |x| contact::penetration(&x.system, &x.u), by: Var::U, is: |_| T::one());
        "1.5" "free" [Stiffness] Equal(|x| (contact::penetration(&x.system, &structure::deflection(&x.system)), system::reaction(&x.system) / &x.system.c));
        "1.6" "force-from-deflection" [] Equal(|x| (
            contact::equilibrium(&x.system, &x.u, &x.lambda),
            &x.system.c * contact::penetration(&x.system, &x.u) + &x.lambda - system::reaction(&x.system)));
        // By equilibrium N = m g − c u: a mass short of the plane with R > 0 would need a force there.
        // Of two solutions, each with p N = 0, p ≤ 0 and N ≥ 0, the right side is not positive: they are one.
        "1.6" "unique" [] Equal(|x| { let p = |u: &T| contact::penetration(&x.system, u); let n = |u: &T| augmented::contact_force(&x.system, u);
            (&x.system.c * square(&x.u - &x.v), p(&x.u) * n(&x.v) + p(&x.v) * n(&x.u) - p(&x.u) * n(&x.u) - p(&x.v) * n(&x.v)) });
        "1.6" "contact-excludes-gap" [Stiffness Contact Clear] Sign(Positive, |x| -(contact::penetration(&x.system, &x.u) * augmented::contact_force(&x.system, &x.u)));
        // … and one at the plane with R < 0 would be pulled.
        "1.6" "separation-excludes-touch" [Separated] Sign(Positive, |x| structure::residual(&x.system, &system::gap(&x.system)));

        "1.7" "by-deflection" [] derivative!(of: |x| lagrange::functional(&x.system, &x.u, &x.lambda), by: Var::U, is: |x| { let [first, _] = lagrange::residual(&x.system, &x.u, &x.lambda); first });
        "1.7" "by-multiplier" [] derivative!(of: |x| lagrange::functional(&x.system, &x.u, &x.lambda), by: Var::Lambda, is: |x| { let [_, second] = lagrange::residual(&x.system, &x.u, &x.lambda); second });
        "1.7" "hessian" [] Equal(|x| (hessian_determinant(x), T::int(-1)));
        "1.8" "equilibrium" [] Equal(|x| { let [first, _] = lagrange::residual(&x.system, &lagrange::deflection(&x.system), &lagrange::multiplier(&x.system)); (first, T::zero()) });
        "1.8" "constraint" [] Equal(|x| { let [_, second] = lagrange::residual(&x.system, &lagrange::deflection(&x.system), &lagrange::multiplier(&x.system)); (second, T::zero()) });
        "1.8" "unique-deflection" [] Equal(|x| { let [_, second] = lagrange::residual(&x.system, &x.u, &x.lambda); (second, &x.u - lagrange::deflection(&x.system)) });
        "1.8" "unique-multiplier" [] Equal(|x| { let [first, second] = lagrange::residual(&x.system, &x.u, &x.lambda); (first - &x.system.c * second, &x.lambda - lagrange::multiplier(&x.system)) });
        "1.8" "complementary" [] Equal(|x| (contact::penetration(&x.system, &lagrange::deflection(&x.system)) * lagrange::multiplier(&x.system), T::zero()));
        "Remark 1.3.1" "exact" [] Equal(|x| (contact::penetration(&x.system, &lagrange::deflection(&x.system)), T::zero()));

        "1.9" "least" [Stiffness Penalty] Equal(|x| (penalty::energy(&x.system, &x.eps, &penalty::deflection(&x.system, &x.eps)), penalty::least_energy(&x.system, &x.eps)));
        "1.9" "excess" [Stiffness Penalty] Equal(|x| (
            penalty::energy(&x.system, &x.eps, &x.u) - penalty::least_energy(&x.system, &x.eps),
            half(penalty::total_stiffness(&x.system, &x.eps) * square(&x.u - penalty::deflection(&x.system, &x.eps)))));
        "1.10" "vanishes-at-contact" [] Equal(|x| (penalty::series(&x.eps, std::slice::from_ref(&x.eps4), &T::zero()), T::zero()));
        "1.10" "positive" [Penalty Quartic Penetrating] Sign(Positive, |x| penalty::series(&x.eps, std::slice::from_ref(&x.eps4), &contact::penetration(&x.system, &x.u)));
        "1.10" "increasing" [Penalty Quartic Penetrating] Sign(Positive, |x| penalty::series_force(&x.eps, std::slice::from_ref(&x.eps4), &contact::penetration(&x.system, &x.u)));
        "1.10" "unbounded" [] derivative!(of: |x| penalty::series(&x.eps, std::slice::from_ref(&x.eps4), &x.u), by: Var::Eps, is: |x| half(&x.u * &x.u));
        "1.10" "one-term" [] Equal(|x| (penalty::series(&x.eps, &[], &x.u), penalty::functional(&x.eps, &x.u)));
        "1.10" "force" [] Equal(|x| (penalty::series_force(&x.eps, std::slice::from_ref(&x.eps4), &x.u), &x.eps * &x.u + T::int(4) * &x.eps4 * &x.u * &x.u * &x.u));
        "1.10" "slope" [] derivative!(of: |x| penalty::series(&x.eps, std::slice::from_ref(&x.eps4), &x.u), by: Var::U, is: |x| penalty::series_force(&x.eps, std::slice::from_ref(&x.eps4), &x.u));
        "1.10" "odd" [] Equal(|x| { let f = |p: &T| penalty::series_residual(&x.system, &x.eps, std::slice::from_ref(&x.eps4), p);
            (f(&x.u) + f(&-&x.u), -(T::int(2) * system::reaction(&x.system))) });
        "1.10" "stiffens" [] derivative!(of: |x| penalty::series_residual(&x.system, &x.eps, std::slice::from_ref(&x.eps4), &x.u), by: Var::U,
            is: |x| penalty::total_stiffness(&x.system, &x.eps) + T::int(12) * &x.eps4 * &x.u * &x.u);
        "1.10" "one-root" [Stiffness Penalty Quartic] Sign(Positive, |x| {
            let dual = x.along(Var::U);
            penalty::series_residual(&dual.system, &dual.eps, std::slice::from_ref(&dual.eps4), &dual.u).derivative });
        "1.11" "stationary" [] derivative!(of: |x| penalty::energy(&x.system, &x.eps, &x.u), by: Var::U, is: |x| penalty::residual(&x.system, &x.eps, &x.u));
        "1.11" "root" [Stiffness Penalty] Equal(|x| (penalty::residual(&x.system, &x.eps, &penalty::deflection(&x.system, &x.eps)), T::zero()));
        "1.11" "two-springs" [] Equal(|x| (penalty::residual(&x.system, &x.eps, &x.u), contact::equilibrium(&x.system, &x.u, &penalty::contact_force(&x.system, &x.eps, &x.u))));
        "1.12" "at-the-root" [Stiffness Penalty] Equal(|x| (penalty::contact_force(&x.system, &x.eps, &penalty::deflection(&x.system, &x.eps)), penalty::force_at_root(&x.system, &x.eps)));
        "1.12" "pushes" [Stiffness Penalty Contact] Sign(Positive, |x| penalty::force_at_root(&x.system, &x.eps));
        "1.12" "error" [Stiffness Penalty] Equal(|x| (system::reaction(&x.system) - penalty::force_at_root(&x.system, &x.eps), &x.system.c * penalty::penetration(&x.system, &x.eps)));
        "1.12" "relative-error" [Stiffness Penalty] Equal(|x| (system::reaction(&x.system) - penalty::force_at_root(&x.system, &x.eps), augmented::contraction(&x.system, &x.eps) * system::reaction(&x.system)));
        "1.12" "complementarity" [Stiffness Penalty] Equal(|x| { let p = penalty::penetration(&x.system, &x.eps); (&p * penalty::force_at_root(&x.system, &x.eps), &x.eps * &p * &p) });
        "Fig. 1.2" "force" [] derivative!(of: |x| penalty::functional(&x.eps, &contact::penetration(&x.system, &x.u)), by: Var::U, is: |x| penalty::contact_force(&x.system, &x.eps, &x.u));
        "Fig. 1.2" "stiffness" [] derivative!(of: |x| penalty::residual(&x.system, &x.eps, &x.u), by: Var::U, is: |x| penalty::total_stiffness(&x.system, &x.eps));
        "1.13" "rate" [Stiffness Penalty] Equal(|x| (penalty::total_stiffness(&x.system, &x.eps) * (penalty::deflection(&x.system, &x.eps) - system::gap(&x.system)), system::reaction(&x.system)));
        "1.13" "limit" [Stiffness Penalty] Limit { of: |x| penalty::deflection(&x.system, &x.eps), by: Var::Eps, to: |x| system::gap(&x.system),
            rate: Rate::Exactly(|x| system::reaction(&x.system) / penalty::total_stiffness(&x.system, &x.eps)) };
        "1.13" "two-forms" [Stiffness Penalty] Equal(|x| (penalty::deflection(&x.system, &x.eps), penalty::deflection_divided(&x.system, &x.eps)));
        "1.13" "slope" [Stiffness Penalty] derivative!(of: |x| contact::penetration(&x.system, &penalty::deflection(&x.system, &x.eps)), by: Var::Eps,
            is: |x| -system::reaction(&x.system) / square(penalty::total_stiffness(&x.system, &x.eps)));
        "1.13" "penetration-vanishes" [Stiffness Penalty] Limit { of: |x| contact::penetration(&x.system, &penalty::deflection(&x.system, &x.eps)), by: Var::Eps, to: |_| T::zero(),
            rate: Rate::Exactly(|x| penalty::penetration(&x.system, &x.eps)) };
        "Remark 1.3.2" "enough" [Tolerance Contact Enough] Sign(NonNegative, |x| &x.tol - penalty::penetration(&x.system, &x.eps));
        "Remark 1.3.2" "least" [Tolerance Contact] Equal(|x| (penalty::penetration(&x.system, &penalty::penalty_for(&x.system, &x.tol)), x.tol.clone()));

        "Remark 1.3.2" "necessary" [Stiffness Penalty Tolerance WithinTolerance] Sign(NonNegative, |x| &x.eps - penalty::penalty_for(&x.system, &x.tol));
        "1.14" "least" [Stiffness Penalty] Equal(|x| (augmented::functional(&x.system, &x.eps, &x.lambda, &iterate(x)), augmented::least_value(&x.system, &x.eps, &x.lambda)));
        "1.14" "excess" [Stiffness Penalty] Equal(|x| (
            augmented::functional(&x.system, &x.eps, &x.lambda, &x.u) - augmented::least_value(&x.system, &x.eps, &x.lambda),
            half(penalty::total_stiffness(&x.system, &x.eps) * square(&x.u - iterate(x)))));
        "1.14" "without-multiplier" [] Equal(|x| (augmented::functional(&x.system, &x.eps, &T::zero(), &x.u), penalty::energy(&x.system, &x.eps, &x.u)));
        "1.14" "without-penalty" [] Equal(|x| (augmented::functional(&x.system, &T::zero(), &x.lambda, &x.u), lagrange::functional(&x.system, &x.u, &x.lambda)));
        "1.15" "stationary" [] derivative!(of: |x| augmented::functional(&x.system, &x.eps, &x.lambda, &x.u), by: Var::U, is: |x| augmented::stationarity(&x.system, &x.eps, &x.lambda, &x.u));
        "1.15" "written-out" [] Equal(|x| (augmented::stationarity(&x.system, &x.eps, &x.lambda, &x.u), augmented::equilibrium(&x.system, &x.eps, &x.lambda, &x.u)));
        "1.16" "first-step" [Stiffness Penalty] Equal(|x| (augmented::deflection(&x.system, &x.eps, &T::zero()), penalty::deflection(&x.system, &x.eps)));
        "1.16" "closed-form" [Stiffness Penalty] Induction {
            ratio: |x| augmented::contraction(&x.system, &x.eps),
            start: |x| vec![x.lambda.clone(), iterate(x)],
            step: augment,
            closed: |x, decay| vec![augmented::multiplier_after(&x.system, &x.lambda, decay), augmented::deflection_after(&x.system, &x.eps, &x.lambda, decay)] };
        "1.16" "penetration" [Stiffness Penalty] Equal(|x| (
            contact::penetration(&x.system, &augmented::deflection_after(&x.system, &x.eps, &x.lambda, &x.q)),
            augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q)));
        "Theorem 1.3.3" "contracts" [Stiffness Penalty] Vanishing { ratio: |x| augmented::contraction(&x.system, &x.eps),
            of: |x, decay| augmented::penetration_after(&x.system, &x.eps, &x.lambda, decay), to: |_| T::zero() };
        "Theorem 1.3.3" "falls" [Stiffness Penalty BelowReaction Power] Sign(Positive, |x| {
            let next = augmented::contraction(&x.system, &x.eps) * &x.q;
            augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q) - augmented::penetration_after(&x.system, &x.eps, &x.lambda, &next) });
        "Theorem 1.3.3" "rises" [Stiffness Penalty AboveReaction Power] Sign(Positive, |x| {
            let next = augmented::contraction(&x.system, &x.eps) * &x.q;
            augmented::penetration_after(&x.system, &x.eps, &x.lambda, &next) - augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q) });
        "Theorem 1.3.3" "force" [Stiffness Penalty] Vanishing { ratio: |x| augmented::contraction(&x.system, &x.eps),
            of: |x, decay| augmented::multiplier_after(&x.system, &x.lambda, decay), to: |x| system::reaction(&x.system) };
        "1.17" "stays-positive" [Stiffness Penalty BelowReaction Power] Sign(Positive, |x| augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q));
        "1.17" "stays-negative" [Stiffness Penalty AboveReaction Power] Sign(Positive, |x| -augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q));
        "1.17" "harmonic-step" [Stiffness Penalty Count] Sign(NonNegative, |x| {
            let next = &x.k + T::one();
            augmented::harmonic_bound(&x.system, &x.eps, &next) - augmented::contraction(&x.system, &x.eps) * augmented::harmonic_bound(&x.system, &x.eps, &x.k) });
        "1.17" "harmonic-margin" [Stiffness Penalty Count] Equal(|x| {
            let (c, stiffness) = (&x.system.c, |k: T| &x.system.c + k * &x.eps);
            let bound = |k: &T| augmented::harmonic_bound(&x.system, &x.eps, k);
            let (next, factor) = (&x.k + T::one(), augmented::contraction(&x.system, &x.eps));
            ((bound(&next) - factor * bound(&x.k)) * stiffness(T::one()) * stiffness(x.k.clone()) * stiffness(next), c * &x.k * square(x.eps.clone())) });
        "1.17" "harmonic-start" [Stiffness] Equal(|x| (augmented::harmonic_bound(&x.system, &x.eps, &T::zero()), T::one()));
        "1.17" "harmonic-limit" [Stiffness Penalty Count] Limit { of: |x| augmented::harmonic_bound(&x.system, &x.eps, &x.k), by: Var::K, to: |_| T::zero(),
            rate: Rate::Exactly(|x| T::one() / (T::one() + &x.k * &x.eps / &x.system.c)) };
        "1.18" "next-multiplier" [Equilibrium] Equal(|x| (augmented::update(&x.system, &x.eps, &x.lambda, &x.u), augmented::contact_force(&x.system, &x.u)));
        "1.19" "root" [Stiffness Penalty] Equal(|x| (augmented::equilibrium(&x.system, &x.eps, &x.lambda, &iterate(x)), T::zero()));
        "1.20" "next-root" [Stiffness Penalty] Equal(|x| { let next = augment(x, &[x.lambda.clone(), iterate(x)]);
            (augmented::equilibrium(&x.system, &x.eps, &next[0], &next[1]), T::zero()) });
        "1.20" "missing-force" [Equilibrium] Equal(|x| (
            &x.system.c * contact::penetration(&x.system, &x.u),
            system::reaction(&x.system) - augmented::update(&x.system, &x.eps, &x.lambda, &x.u)));
        "1.21" "eliminated" [Equilibrium NextEquilibrium] Equal(|x| augmented::recursion(&x.system, &x.eps, &x.u, &x.v));
        "1.21" "difference" [] Equal(|x| { let (left, right) = augmented::recursion(&x.system, &x.eps, &x.u, &x.v);
            let next = augmented::update(&x.system, &x.eps, &x.lambda, &x.u); (
            augmented::equilibrium(&x.system, &x.eps, &next, &x.v) - augmented::equilibrium(&x.system, &x.eps, &x.lambda, &x.u),
            left - right) });

        "1.22" "iterates" [Stiffness Penalty] Equal(|x| {
            let after = |decay: &T| augmented::deflection_after(&x.system, &x.eps, &x.lambda, decay);
            ode::difference_equation(&x.system, &x.eps, &after(&x.q), &after(&(augmented::contraction(&x.system, &x.eps) * &x.q))) });
        "1.23" "velocity" [Stiffness Penalty] Equal(|x| (ode::operator(&x.system, &x.eps, &x.u, &ode::velocity(&x.system, &x.eps, &x.u)), ode::right_side(&x.system, &x.eps)));
        "1.23" "explicit-euler" [Stiffness Penalty] Equal(|x| augmented::recursion(&x.system, &x.eps, &x.u, &(&x.u + ode::velocity(&x.system, &x.eps, &x.u))));
        "1.24" "linear" [] Equal(|x| (
            ode::operator(&x.system, &x.eps, &ode::superposition(&x.u, &x.v), &ode::superposition(&x.du, &x.alpha)),
            ode::operator(&x.system, &x.eps, &x.u, &x.du) + ode::operator(&x.system, &x.eps, &x.v, &x.alpha)));
        "1.25" "annihilates" [Stiffness Penalty] Equal(|x| (ode::operator(&x.system, &x.eps, &x.u, &(ode::rate(&x.system, &x.eps) * &x.u)), T::zero()));
        "1.26" "root" [Stiffness Penalty] Equal(|x| (ode::characteristic(&x.system, &x.eps, &ode::rate(&x.system, &x.eps)), T::zero()));
        "1.26" "from-operator" [] Equal(|x| (ode::operator(&x.system, &x.eps, &x.u, &(&x.alpha * &x.u)), ode::characteristic(&x.system, &x.eps, &x.alpha) * &x.u));
        "1.26" "contraction" [Stiffness Penalty] Equal(|x| (T::one() + ode::rate(&x.system, &x.eps), augmented::contraction(&x.system, &x.eps)));
        "1.28" "particular" [] Equal(|x| (ode::operator(&x.system, &x.eps, &ode::particular(&x.system), &T::zero()), ode::right_side(&x.system, &x.eps)));
        "1.29" "constant" [] Equal(|x| (ode::superposition(&ode::constant(&x.system, &x.u), &ode::particular(&x.system)), x.u.clone()));
        "1.30" "constant-is-penetration" [] Equal(|x| (ode::constant(&x.system, &x.u), contact::penetration(&x.system, &x.u)));
        "1.33" "count" [Stiffness Penalty] Equal(|x| (
            augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q) * penalty::total_stiffness(&x.system, &x.eps),
            (system::reaction(&x.system) - &x.lambda) * &x.q));
        "1.33" "growth" [Stiffness Penalty] Equal(|x| (T::one() / augmented::contraction(&x.system, &x.eps), T::one() + &x.eps / &x.system.c));
        "1.33" "tie" [Stiffness Penalty Power] Equal(|x| {
            // λ₀ planted so that |p₀| = tol/q: after the steps with ρᵏ = q the penetration *is* the tolerance.
            let start = system::reaction(&x.system) - penalty::total_stiffness(&x.system, &x.eps) * &x.tol / &x.q;
            (augmented::penetration_after(&x.system, &x.eps, &start, &x.q), x.tol.clone()) });
        "Remark 1.3.6" "lag" [] Equal(|x| (augmented::update(&x.system, &x.eps, &x.lambda, &x.u) - &x.lambda, penalty::contact_force(&x.system, &x.eps, &x.u)));

        "note 2" "saddle-in-deflection" [] Equal(|x| { let (gap, r) = (system::gap(&x.system), system::reaction(&x.system)); (
            lagrange::functional(&x.system, &x.u, &r) - lagrange::functional(&x.system, &gap, &r),
            half(&x.system.c * square(&x.u - &gap))) });
        "note 2" "least-in-deflection" [Stiffness] Sign(NonNegative, |x| { let (gap, r) = (system::gap(&x.system), system::reaction(&x.system));
            lagrange::functional(&x.system, &x.u, &r) - lagrange::functional(&x.system, &gap, &r) });
        "note 2" "constant-in-multiplier" [] Equal(|x| { let gap = system::gap(&x.system); (
            lagrange::functional(&x.system, &gap, &x.lambda), structure::potential_energy(&x.system, &gap)) });
        "note 2" "separated" [Stiffness] Equal(|x| { let free = structure::deflection(&x.system); (
            lagrange::functional(&x.system, &free, &x.lambda),
            structure::least_energy(&x.system) + &x.lambda * system::reaction(&x.system) / &x.system.c) });
        "note 2" "not-positive" [Stiffness] Sign(NonNegative, |x| -structure::least_energy(&x.system));
        "note 3" "energy-bound" [Stiffness Penalty] Sign(NonNegative, |x| { let r = system::reaction(&x.system);
            &r * &r / (T::int(2) * &x.system.c) - penalty::functional(&x.eps, &penalty::penetration(&x.system, &x.eps)) });
        // Positive, increasing and unbounded in p, and yet the penetration does not vanish.
        "note 3" "not-sufficient" [Stiffness Penalty] Equal(|x| { let p = stalled_penetration(x);
            (&x.system.c * &p + saturating_penalty(&Dual::constant(x.eps.clone()), &Dual::variable(p)).derivative, system::reaction(&x.system)) });
        "note 3" "stalls" [Stiffness Penalty] Limit { of: stalled_penetration, by: Var::Eps, to: |x| system::reaction(&x.system) / (&x.system.c + T::int(2)),
            rate: Rate::Exactly(|x| stalled_penetration(x) / ((&x.system.c + T::int(2)) * (T::one() + &x.eps))) };
        // Bounded in p, and yet it does: W = ε p²/(1 + p²) is proportional to ε.
        "note 3" "not-necessary" [] Limit { of: |x| bounded_penalty(&x.eps, &x.u), by: Var::U, to: |x| x.eps.clone(),
            rate: Rate::Exactly(|x| -(&x.eps / (T::one() + square(x.u.clone())))) };
        "note 5" "beyond-twice" [Stiffness BeyondTwice] Vanishing { ratio: |x| augmented::contraction(&x.system, &x.eps),
            of: |x, decay| augmented::penetration_after(&x.system, &x.eps, &x.lambda, decay), to: |_| T::zero() };
        "note 5" "alternates" [Stiffness BeyondTwice] Sign(Positive, |x| -augmented::contraction(&x.system, &x.eps));
        "note 5" "twice" [Stiffness Twice] Equal(|x| (augmented::contraction(&x.system, &x.eps), T::int(-1)));
        "note 5" "diverges" [Softening WithinTwice] Sign(Positive, |x| square(x.system.c.clone()) - square(penalty::total_stiffness(&x.system, &x.eps)));
        "note 5" "no-solution" [Opposite] Equal(|x| (augmented::equilibrium(&x.system, &x.eps, &x.lambda, &x.u), &x.lambda - system::reaction(&x.system)));
        "note 5" "starts-there" [Stiffness Penalty AtReaction] Equal(|x| (augmented::penetration_after(&x.system, &x.eps, &x.lambda, &x.q), T::zero()));
        "note 5" "maximises" [BeyondOnce] Sign(NonNegative, |x| augmented::least_value(&x.system, &x.eps, &x.lambda) - augmented::functional(&x.system, &x.eps, &x.lambda, &x.u));
        "note 5" "ode-converges" [Stiffness BeyondOnce] Sign(Positive, |x| -ode::rate(&x.system, &x.eps));
        "note 5" "no-penalty" [Stiffness] Equal(|x| (augmented::contraction(&x.system, &T::zero()), T::one()));
        "note 6" "force" [Equilibrium] Equal(|x| (augmented::contact_force(&x.system, &x.u), &x.lambda + penalty::contact_force(&x.system, &x.eps, &x.u)));

        "beyond 2" "one-penalty" [Stiffness Penalty Power] Equal(|x| {
            let growth = T::one() / (augmented::contraction(&x.system, &x.eps) * &x.q);
            let effective = beyond::effective_penalty(&x.system, &growth);
            (penalty::penetration(&x.system, &effective), augmented::penetration_after(&x.system, &x.eps, &T::zero(), &x.q)) });
        "beyond 2" "varying" [Stiffness Penalty Power] Equal(|x| {
            // After steps with whatever penalties, whose (c + ε_i)/c have the product q, and one more with ε.
            let left = |growth: &T| penalty::penetration(&x.system, &beyond::effective_penalty(&x.system, growth));
            let lambda = system::reaction(&x.system) - &x.system.c * left(&x.q);
            let u = augmented::deflection(&x.system, &x.eps, &lambda);
            (contact::penetration(&x.system, &u), left(&(&x.q / augmented::contraction(&x.system, &x.eps)))) });
        "beyond 3" "factor" [Stiffness Penalty] Equal(|x| { let r = system::reaction(&x.system); (
            beyond::relaxed_update(&x.system, &x.alpha, &x.lambda, &iterate(x)) - &r,
            beyond::relaxed_contraction(&x.system, &x.eps, &x.alpha) * (&x.lambda - &r)) });
        "beyond 3" "newton" [Stiffness Penalty] Equal(|x| (
            beyond::relaxed_update(&x.system, &penalty::total_stiffness(&x.system, &x.eps), &x.lambda, &iterate(x)),
            system::reaction(&x.system)));
        "beyond 3" "converges" [Step ShortStep] Sign(Positive, |x| T::one() - square(beyond::relaxed_contraction(&x.system, &x.eps, &x.alpha)));
        "beyond 3" "diverges" [Stiffness Penalty LongStep] Sign(Positive, |x| square(beyond::relaxed_contraction(&x.system, &x.eps, &x.alpha)) - T::one());
        "beyond 3" "uzawa" [Step UzawaStep] Sign(Positive, |x| T::one() - square(beyond::relaxed_contraction(&x.system, &T::zero(), &x.alpha)));
        "beyond 4" "dual" [Stiffness] Equal(|x| {
            let u = augmented::deflection(&x.system, &T::zero(), &x.lambda);
            (beyond::dual_functional(&x.system, &x.lambda), lagrange::functional(&x.system, &u, &x.lambda)) });
        "beyond 4" "proximal-step" [Stiffness Penalty] Equal(|x| { let next = augmented::update(&x.system, &x.eps, &x.lambda, &iterate(x)); (
            (&next - &x.lambda) / &x.eps,
            (system::reaction(&x.system) - &next) / &x.system.c) });
        "beyond 4" "envelope" [Stiffness Penalty] Equal(|x| { let next = augmented::update(&x.system, &x.eps, &x.lambda, &iterate(x)); (
            beyond::dual_functional(&x.system, &next) - square(&next - &x.lambda) / (T::int(2) * &x.eps),
            augmented::least_value(&x.system, &x.eps, &x.lambda)) });
        "beyond 4" "envelope-slope" [Stiffness Penalty] derivative!(of: |x| augmented::least_value(&x.system, &x.eps, &x.lambda), by: Var::Lambda,
            is: |x| contact::penetration(&x.system, &iterate(x)));
        "beyond 5" "aitken" [Stiffness Penalty BelowReaction] Equal(|x| (extrapolated(x), system::reaction(&x.system)));
        "beyond 5" "aitken-from-above" [Stiffness Penalty AboveReaction] Equal(|x| (extrapolated(x), system::reaction(&x.system)));
        "beyond 5" "rises" [Stiffness Penalty] Equal(|x| { let lambda = augmented::multiplier_after(&x.system, &x.lambda, &x.q); (
            augmented::least_value(&x.system, &x.eps, &lambda),
            structure::potential_energy(&x.system, &system::gap(&x.system))
                - square((system::reaction(&x.system) - &x.lambda) * &x.q) / (T::int(2) * penalty::total_stiffness(&x.system, &x.eps))) });
    }
}

/// The derivative of a function of time that satisfies (1.23) is its velocity.
fn follows_the_ode<T: Exponential>(x: &Case<T>, u: T) -> T {
    ode::velocity(&x.system, &x.eps, &u)
}

/// A bound of the distance of (1.30) from Δ that tends to zero: e⁻ˢ ≤ 1/(1 + s).
fn reciprocal_decay<T: Exponential>(x: &Case<T>) -> T {
    contact::penetration(&x.system, &x.u) / (T::one() - ode::rate(&x.system, &x.eps) * &x.t)
}

/// Claims that need eˣ: rationals cannot check them.
#[rustfmt::skip]
pub fn exponential_claims<T: Exponential>() -> Vec<Claim<T>> {
    use Kind::*;
    use Relation::*;
    list! {
        "1.27" "annihilated" [Stiffness Penalty] derivative!(of: |x| ode::homogeneous(&x.system, &x.eps, &x.u, &x.t), by: Var::T,
            is: |x| ode::rate(&x.system, &x.eps) * ode::homogeneous(&x.system, &x.eps, &x.u, &x.t));
        "1.27" "constant" [Stiffness Penalty] Equal(|x| (ode::homogeneous(&x.system, &x.eps, &x.u, &T::zero()), x.u.clone()));
        "1.29" "solves" [Stiffness Penalty] derivative!(of: |x| ode::general(&x.system, &x.eps, &x.u, &x.t), by: Var::T,
            is: |x| follows_the_ode(x, ode::general(&x.system, &x.eps, &x.u, &x.t)));
        "1.30" "solves" [Stiffness Penalty] derivative!(of: |x| ode::solution(&x.system, &x.eps, &x.u, &x.t), by: Var::T,
            is: |x| follows_the_ode(x, ode::solution(&x.system, &x.eps, &x.u, &x.t)));
        "1.30" "starts" [Stiffness Penalty] Equal(|x| (ode::solution(&x.system, &x.eps, &x.u, &T::zero()), x.u.clone()));
        "1.31" "limit" [Stiffness Penalty Time Penetrating] Limit { of: |x| ode::solution(&x.system, &x.eps, &x.u, &x.t), by: Var::T, to: |x| system::gap(&x.system),
            rate: Rate::Within(reciprocal_decay) };
        // … and from below, or from the plane itself.
        "1.31" "limit-from-below" [Stiffness Penalty Time Clear] Limit { of: |x| ode::solution(&x.system, &x.eps, &x.u, &x.t), by: Var::T, to: |x| system::gap(&x.system),
            rate: Rate::Within(|x| -reciprocal_decay(x)) };
        "1.31" "stays" [Stiffness Penalty] Equal(|x| { let gap = system::gap(&x.system); (ode::solution(&x.system, &x.eps, &gap, &x.t), gap) });
        "1.32" "limit" [Stiffness Penalty Time Penetrating] Limit { of: |x| contact::penetration(&x.system, &ode::solution(&x.system, &x.eps, &x.u, &x.t)), by: Var::T, to: |_| T::zero(),
            rate: Rate::Within(reciprocal_decay) };
        "1.32" "limit-from-below" [Stiffness Penalty Time Clear] Limit { of: |x| contact::penetration(&x.system, &ode::solution(&x.system, &x.eps, &x.u, &x.t)), by: Var::T, to: |_| T::zero(),
            rate: Rate::Within(|x| -reciprocal_decay(x)) };
        "note 5" "strict-bound" [Stiffness Penalty] Sign(Positive, |x| ode::rate(&x.system, &x.eps).exp() - augmented::contraction(&x.system, &x.eps));
        "note 5" "other-side" [Stiffness Penalty] Sign(Positive, |x| augmented::contraction(&x.system, &x.eps) - (-&x.eps / &x.system.c).exp());
        // From one step to the next: a bound q + t above ρᵏ = q stays above.
        "note 5" "stays-strict" [Stiffness Penalty Power Time] Sign(Positive, |x| ode::rate(&x.system, &x.eps).exp() * (&x.q + &x.t) - augmented::contraction(&x.system, &x.eps) * &x.q);
        "note 5" "flow" [Stiffness Penalty] Equal(|x| {
            let decay = |t: &T| ode::homogeneous(&x.system, &x.eps, &T::one(), t);
            (decay(&(&x.t + T::one())), decay(&x.t) * decay(&T::one())) });
        "note 9" "more-than" [Stiffness Penalty] Sign(Positive, |x| { let ratio = &x.eps / &x.system.c; ratio.exp() - (T::one() + ratio) });
        "note 9" "less-than" [Stiffness Penalty] Sign(Positive, |x| { let ratio = &x.eps / &x.system.c;
            T::one() + &ratio - (T::int(2) * &ratio / (T::int(2) + &ratio)).exp() });
    }
}

/// Claims about a plane that never pulls.
#[rustfmt::skip]
pub fn unilateral_claims<T: PositivePart>() -> Vec<Claim<T>> {
    use Kind::*;
    use Relation::*;
    fn kkt<T: PositivePart>(x: &Case<T>) -> contact::Kkt<T> {
        contact::kkt(&x.system, &contact::deflection(&x.system), &contact::contact_force(&x.system))
    }
    list! {
        "1.6" "stationarity" [Stiffness] Equal(|x| (kkt(x).stationarity, T::zero()));
        "1.6" "no-penetration" [Stiffness] Equal(|x| (kkt(x).primal, T::zero()));
        "1.6" "no-pull" [] Equal(|x| (contact::kkt(&x.system, &x.u, &contact::contact_force(&x.system)).dual, T::zero()));
        "1.6" "complementarity" [Stiffness] Equal(|x| (kkt(x).complementarity, T::zero()));
        "1.6" "product" [] Equal(|x| (contact::kkt(&x.system, &(system::gap(&x.system) + &x.du), &x.lambda).complementarity, &x.du * &x.lambda));
        "1.6" "pushes" [Contact] Sign(Positive, |x| contact::contact_force(&x.system));
        "1.6" "hangs-free" [Stiffness Separated] Sign(Positive, |x| -contact::penetration(&x.system, &contact::deflection(&x.system)));
        "1.8" "kkt-with-multiplier" [Touching] Equal(|x| (lagrange::multiplier(&x.system), contact::contact_force(&x.system)));
        "1.13" "unilateral" [Stiffness Penalty Touching] Equal(|x| (penalty::unilateral_deflection(&x.system, &x.eps), penalty::deflection(&x.system, &x.eps)));
        "1.13" "unilateral-free" [Stiffness Penalty Separated] Equal(|x| (penalty::unilateral_deflection(&x.system, &x.eps), structure::deflection(&x.system)));
        "note 1" "grazing-deflection" [Stiffness Grazing] Equal(|x| (contact::deflection(&x.system), system::gap(&x.system)));
        "note 1" "grazing-force" [Grazing] Equal(|x| (contact::contact_force(&x.system), T::zero()));
        "note 4" "equilibrium" [Stiffness Penalty] Equal(|x| (augmented::unilateral_equilibrium(&x.system, &x.eps, &x.lambda, &unilateral_iterate(x)), T::zero()));
        "note 4" "never-pulls" [Stiffness Penalty] Sign(NonNegative, |x| augmented::unilateral_update(&x.system, &x.eps, &x.lambda, &unilateral_iterate(x)));
        "note 4" "functional-where-active" [Penalty Multiplier Penetrating] Equal(|x| (
            augmented::unilateral_functional(&x.system, &x.eps, &x.lambda, &x.u), augmented::functional(&x.system, &x.eps, &x.lambda, &x.u)));
        "note 4" "functional-elsewhere" [Penalty Inactive] Equal(|x| (
            augmented::unilateral_functional(&x.system, &x.eps, &x.lambda, &x.u),
            structure::potential_energy(&x.system, &x.u) - square(x.lambda.clone()) / (T::int(2) * &x.eps)));
        "note 4" "where-active" [Stiffness Penalty Active] Equal(|x| (unilateral_iterate(x), iterate(x)));
        "note 4" "multiplier" [Stiffness Penalty] Equal(|x| (
            augmented::unilateral_update(&x.system, &x.eps, &x.lambda, &unilateral_iterate(x)),
            ((&x.system.c * &x.lambda + &x.eps * system::reaction(&x.system)) / penalty::total_stiffness(&x.system, &x.eps)).positive_part()));
        "note 4" "natural-residual" [Stiffness Penalty] Equal(|x| { let u = unilateral_iterate(x); (
            augmented::natural_residual(&x.system, &x.eps, &x.lambda, &u),
            (augmented::unilateral_update(&x.system, &x.eps, &x.lambda, &u) - &x.lambda) / &x.eps) });
        "note 4" "residual-bounds-error" [Stiffness Penalty] Sign(NonNegative, |x| { let u = unilateral_iterate(x);
            square(augmented::natural_residual(&x.system, &x.eps, &x.lambda, &u)) - square(u - contact::deflection(&x.system)) });
        "note 4" "force-error" [Stiffness Penalty] Equal(|x| { let u = unilateral_iterate(x); (
            contact::contact_force(&x.system) - augmented::unilateral_update(&x.system, &x.eps, &x.lambda, &u),
            &x.system.c * (u - contact::deflection(&x.system))) });
        "note 4" "contracts" [Stiffness Penalty Touching] Sign(NonNegative, |x| { let r = system::reaction(&x.system);
            let next = augmented::unilateral_update(&x.system, &x.eps, &x.lambda, &unilateral_iterate(x));
            square(&x.lambda - &r) - square(next - &r) });
        "note 4" "active-step" [Stiffness Penalty Active] Equal(|x| (unilateral_step(x, &x.lambda), augmented::multiplier_after(&x.system, &x.lambda, &augmented::contraction(&x.system, &x.eps))));
        "note 4" "idle-step" [Stiffness Penalty Idle] Equal(|x| (unilateral_step(x, &x.lambda), T::zero()));
        "note 4" "idle-deflection" [Stiffness Penalty Idle] Equal(|x| (unilateral_iterate(x), structure::deflection(&x.system)));
        "note 4" "stays-free" [Stiffness Penalty Separated] Equal(|x| (unilateral_step(x, &T::zero()), T::zero()));
        "note 4" "contact-sequence" [Stiffness Penalty Touching Multiplier Carried] Induction {
            ratio: |x| augmented::contraction(&x.system, &x.eps),
            start: |x| vec![x.lambda.clone()],
            step: |x, lambda| vec![unilateral_step(x, &lambda[0])],
            closed: |x, decay| vec![augmented::multiplier_after(&x.system, &x.lambda, decay)] };
        "note 4" "grazing-sequence" [Stiffness Penalty Grazing Multiplier Power] Induction {
            ratio: |x| augmented::contraction(&x.system, &x.eps),
            start: |x| vec![x.lambda.clone()],
            step: |x, lambda| vec![unilateral_step(x, &lambda[0])],
            closed: |x, decay| vec![&x.lambda * decay] };
        // λ_k > 0 as long as (1 + ε/c)ᵏ < 1 + λ₀/|R|.
        "note 4" "count" [Separated Power] Equal(|x| { let r = system::reaction(&x.system); (
            augmented::multiplier_after(&x.system, &x.lambda, &x.q),
            -&r * &x.q * (T::one() - &x.lambda / &r - T::one() / &x.q)) });
        "note 4" "residual-is-penetration" [Stiffness Penalty Active] Equal(|x| { let u = unilateral_iterate(x); (
            augmented::natural_residual(&x.system, &x.eps, &x.lambda, &u), contact::penetration(&x.system, &u)) });
        // With ⟨·⟩ in the update alone the iteration stops short of the answer.
        "note 4" "one-bracket-stalls" [Stiffness Penalty Separated] Equal(|x| {
            let u = augmented::deflection(&x.system, &x.eps, &T::zero());
            (augmented::unilateral_update(&x.system, &x.eps, &T::zero(), &u), T::zero()) });
        "note 4" "one-bracket-errs" [Stiffness Penalty Separated] Sign(Positive, |x|
            augmented::deflection(&x.system, &x.eps, &T::zero()) - contact::deflection(&x.system));
        "beyond 1" "force" [] Equal(|x| (contact::contact_force(&x.system), system::reaction(&x.system).positive_part()));
        "beyond 1" "gap" [Stiffness] Equal(|x| (-&x.system.c * contact::penetration(&x.system, &contact::deflection(&x.system)), (-system::reaction(&x.system)).positive_part()));
        "beyond 6" "exact-penalty" [Stiffness Touching StrongEnough] Sign(NonNegative, |x| { let gap = system::gap(&x.system);
            structure::potential_energy(&x.system, &x.u) + beyond::exact_penalty(&x.eps, &contact::penetration(&x.system, &x.u))
                - structure::potential_energy(&x.system, &gap) });
    }
}
