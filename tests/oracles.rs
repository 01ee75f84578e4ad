//! The chapter against what is not our own code: values worked out by hand, and another library's
//! derivatives.
//!
//! The doc examples work out the system c = 4, m = 1, g = 10, l = 1, H = 3. Here it is the default system,
//! in rationals, c = 100, m = 1, g = 9.81, l = 1, H = 1.05. By hand:
//!
//! - Δ = 1.05 − 1 = 0.05, W = 9.81, R = 9.81 − 100 · 0.05 = 4.81; it hangs free at 9.81/100 = 0.0981.
//! - With ε = 100, c + ε = 200 and ρ = 1/2: p = 4.81/200 = 0.02405, u = 0.05 + p = 0.07405, N = 100 p = 2.405.
//! - Π(u) = 50 u² − 9.81 u: Π(0.05) = 0.125 − 0.4905 = −0.3655, Π(0.1) = 0.5 − 0.981 = −0.481, and its minimum
//!   is −9.81²/200 = −96.2361/200 = −0.4811805.
//! - R² = 4.81² = 23.1361, so min Π_p = −0.3655 − 23.1361/400 = −0.42334025.
//! - Augmented: λ = 0, 2.405, 3.6075 and p = 0.02405, 0.012025, 0.0060125, by halving.

use crate::strategies::{default_system, holds, int, q};
use num_dual::{Dual64, DualNum};
use num_traits::{One, Zero};
use proptest::array::{uniform5, uniform6};
use spring_mass_contact::chapter::{
    SpringMass, augmented, beyond, contact, lagrange, ode, penalty, structure, system,
};
use spring_mass_contact::number::{Exact, Exponential, Field, Mpfr, PositivePart, ToExact};
use spring_mass_contact::operators;
use spring_mass_contact::solver::{Method, Plane, exact_augmentation_count, penalty_for_penetration, solve};

#[test]
fn the_system_and_its_structure() {
    let s = &default_system();
    assert_eq!(system::gap(s), q("0.05"));
    assert_eq!(system::weight(s), q("9.81"));
    assert_eq!(system::reaction(s), q("4.81"));
    assert_eq!(structure::spring_force(s, &q("0.05")), int(5));
    // 100 · 0.1 − 9.81.
    assert_eq!(structure::residual(s, &q("0.1")), q("0.19"));
    assert_eq!(structure::deflection(s), q("0.0981"));
    assert_eq!(structure::virtual_work(s, &q("0.1"), &int(-2)), q("-0.38"));
    assert_eq!(structure::first_variation(s, &q("0.1"), &int(-2)), q("-0.38"));
    assert_eq!(structure::potential_energy(s, &q("0.05")), q("-0.3655"));
    assert_eq!(structure::potential_energy(s, &q("0.1")), q("-0.481"));
    assert_eq!(structure::least_energy(s), q("-0.4811805"));
    // (1.3) by a central difference, which is exact for a quadratic, whatever the step: here 1.
    let difference = structure::potential_energy(s, &q("1.1")) - structure::potential_energy(s, &q("-0.9"));
    assert_eq!(difference / int(2), q("0.19"));
}

#[test]
fn contact_and_lagrange() {
    let s = &default_system();
    // 1 + 0.0981 − 1.05: hanging free it would be 4.81 cm too deep.
    assert_eq!(contact::penetration(s, &q("0.0981")), q("0.0481"));
    assert_eq!(contact::equilibrium(s, &q("0.05"), &q("4.81")), int(0));
    assert_eq!(contact::equilibrium(s, &q("0.05"), &int(1)), q("-3.81"));
    assert_eq!(contact::deflection(s), q("0.05"));
    assert_eq!(contact::contact_force(s), q("4.81"));
    // (u, N) = (0.1, −2): 10 − 9.81 − 2, ⟨0.05⟩, ⟨2⟩, 0.05 · (−2).
    let kkt = contact::kkt(s, &q("0.1"), &int(-2));
    assert_eq!((kkt.stationarity, kkt.primal), (q("-1.81"), q("0.05")));
    assert_eq!((kkt.dual, kkt.complementarity), (int(2), q("-0.1")));
    // (u, N) = (0, 3): 0 − 9.81 + 3, ⟨−0.05⟩, ⟨−3⟩, −0.05 · 3.
    let kkt = contact::kkt(s, &int(0), &int(3));
    assert_eq!((kkt.stationarity, kkt.primal), (q("-6.81"), int(0)));
    assert_eq!((kkt.dual, kkt.complementarity), (int(0), q("-0.15")));
    assert_eq!((lagrange::deflection(s), lagrange::multiplier(s)), (q("0.05"), q("4.81")));
    // −0.481 + 2 · 0.05.
    assert_eq!(lagrange::functional(s, &q("0.1"), &int(2)), q("-0.381"));
    assert_eq!(lagrange::residual(s, &q("0.1"), &int(2)), [q("2.19"), q("0.05")]);
    // A plane lower by 0.1, Δ = 0.15: R = 9.81 − 15 < 0, and the mass hangs free.
    let low = &SpringMass { h: q("1.15"), ..default_system() };
    assert_eq!((contact::deflection(low), contact::contact_force(low)), (q("0.0981"), int(0)));
    assert_eq!(lagrange::multiplier(low), q("-5.19"));
}

#[test]
fn penalty_method() {
    let (s, eps) = (&default_system(), &int(100));
    let u = &q("0.07405");
    assert_eq!(penalty::total_stiffness(s, eps), int(200));
    assert_eq!(&penalty::deflection(s, eps), u);
    assert_eq!(&penalty::deflection_divided(s, eps), u);
    assert_eq!(&penalty::unilateral_deflection(s, eps), u);
    assert_eq!(penalty::penetration(s, eps), q("0.02405"));
    assert_eq!(penalty::contact_force(s, eps, u), q("2.405"));
    assert_eq!(penalty::contact_force_at_equilibrium(s, eps), q("2.405"));
    assert_eq!(penalty::residual(s, eps, u), int(0));
    // 10 − 9.81 + 100 · 0.05.
    assert_eq!(penalty::residual(s, eps, &q("0.1")), q("5.19"));
    assert_eq!(penalty::functional(eps, &q("0.05")), q("0.125"));
    // −0.481 + 0.125.
    assert_eq!(penalty::energy(s, eps, &q("0.1")), q("-0.356"));
    assert_eq!(penalty::least_energy(s, eps), q("-0.42334025"));
    // 4.81/0.01 − 100, and 4.81/0.1 < 100.
    assert_eq!(penalty::penalty_for(s, &q("0.01")), int(381));
    assert_eq!(penalty_for_penetration(s, &q("0.01")), Ok(Some(int(381))));
    assert_eq!(penalty_for_penetration(s, &q("0.1")), Ok(None));
    // ε = 100, ε₄ = 3, ε₆ = 5 at p = 0.2: 2 + 3 · 0.0016 + 5 · 0.000064; 20 + 12 · 0.008 + 30 · 0.00032;
    // c p + that − R = 20 + 20.1056 − 4.81.
    let higher = [int(3), int(5)];
    assert_eq!(penalty::series(eps, &higher, &q("0.2")), q("2.00512"));
    assert_eq!(penalty::series_force(eps, &higher, &q("0.2")), q("20.1056"));
    assert_eq!(penalty::series_residual(s, eps, &higher, &q("0.2")), q("35.2956"));
    // Where it hangs free the one-sided plane leaves it alone.
    let low = &SpringMass { h: q("1.15"), ..default_system() };
    assert_eq!(penalty::unilateral_deflection(low, eps), q("0.0981"));
}

#[test]
fn augmented_method() {
    let (s, eps) = (&default_system(), &int(100));
    let lambda = &q("2.405");
    // (9.81 − 2.405 + 100 · 0.05)/200 = 12.405/200.
    let u = &q("0.062025");
    assert_eq!(&augmented::deflection(s, eps, lambda), u);
    assert_eq!(&augmented::unilateral_deflection(s, eps, lambda), u);
    assert_eq!(augmented::equilibrium(s, eps, lambda, u), int(0));
    assert_eq!(augmented::unilateral_equilibrium(s, eps, lambda, u), int(0));
    assert_eq!(augmented::stationarity(s, eps, lambda, &q("0.1")), q("7.595")); // 5.19 + 2.405
    assert_eq!(augmented::equilibrium(s, eps, lambda, &q("0.1")), q("7.595"));
    assert_eq!(augmented::update(s, eps, lambda, u), q("3.6075"));
    assert_eq!(augmented::unilateral_update(s, eps, lambda, u), q("3.6075"));
    // 2.405 + 100 · (1 + 0 − 1.05) < 0; and what the plane leaves: 0 − 9.81 + 0.
    assert_eq!(augmented::update(s, eps, lambda, &int(0)), q("-2.595"));
    assert_eq!(augmented::unilateral_update(s, eps, lambda, &int(0)), int(0));
    assert_eq!(augmented::unilateral_equilibrium(s, eps, lambda, &int(0)), q("-9.81"));
    assert_eq!(augmented::contact_force(s, u), q("3.6075"));
    assert_eq!(augmented::contraction(s, eps), q("1/2"));
    assert_eq!(augmented::harmonic_bound(s, &int(300), &int(3)), q("1/10"));
    assert_eq!(augmented::multiplier_after(s, &int(0), &q("1/4")), q("3.6075"));
    assert_eq!(augmented::multiplier_after(s, &int(1), &q("1/2")), q("2.905")); // 4.81 − 3.81/2
    assert_eq!(augmented::penetration_after(s, eps, &int(0), &q("1/4")), q("0.0060125"));
    assert_eq!(augmented::deflection_after(s, eps, &int(0), &q("1/4")), q("0.0560125"));
    // −0.481 + 2 · 0.05 + 0.125.
    assert_eq!(augmented::functional(s, eps, &int(2), &q("0.1")), q("-0.256"));
    // (⟨2 + 5⟩² − 4)/200 = 0.225 is the same; at u = 0, ⟨2 − 5⟩ = 0 leaves −4/200.
    assert_eq!(augmented::unilateral_functional(s, eps, &int(2), &q("0.1")), q("-0.256"));
    assert_eq!(augmented::unilateral_functional(s, eps, &int(2), &int(0)), q("-0.02"));
    // −0.3655 − 2.81²/400, 2.81² = 7.8961.
    assert_eq!(augmented::least_value(s, eps, &int(2)), q("-0.38524025"));
    // p = 0.0481 and −λ/ε = −0.02; and where p < −λ/ε.
    assert_eq!(augmented::natural_residual(s, eps, &int(2), &q("0.0981")), q("0.0481"));
    assert_eq!(augmented::natural_residual(s, eps, &int(2), &int(0)), q("-0.02"));
    // 200 · (0.062025 − 0.07405) = −2.405 = −100 · (−0.05) − 100 · 0.07405.
    let sides = (q("-2.405"), q("-2.405"));
    assert_eq!(augmented::recursion(s, eps, &q("0.07405"), u), sides);
    assert_eq!(ode::difference_equation(s, eps, &q("0.07405"), u), sides);
    // 0.02405 halves to below 0.001 with the fifth step: 24.05, 12.0…, 6.01…, 3.0…, 1.5…, 0.75… mm.
    let needed = exact_augmentation_count(s, eps, &q("0.001"), &int(0), Plane::Unilateral).unwrap();
    assert_eq!(needed, 5);
    let method =
        Method::Augmented { penalty: int(100), tolerance: q("0.001"), max_augmentations: 9, start: int(0) };
    let answer = solve(s, &method).unwrap();
    assert_eq!((answer.augmentations, answer.penetration), (Some(5), q("0.02405") / int(32)));
}

#[test]
fn the_ode_and_beyond() {
    let (s, eps) = (&default_system(), &int(100));
    assert_eq!(ode::right_side(s, eps), int(5));
    assert_eq!(ode::operator(s, eps, &q("0.1"), &q("0.2")), int(50)); // 200 · 0.2 + 100 · 0.1
    assert_eq!(ode::velocity(s, eps, &q("0.1")), q("-0.025")); // (5 − 10)/200
    assert_eq!(ode::rate(s, eps), q("-1/2"));
    assert_eq!(ode::characteristic(s, eps, &q("-1/2")), int(0));
    assert_eq!(ode::characteristic(s, eps, &int(1)), int(300));
    assert_eq!(ode::particular(s), q("0.05"));
    assert_eq!(ode::integration_constant(s, &q("0.07405")), q("0.02405"));
    assert_eq!(ode::superposition(&q("0.1"), &q("0.2")), q("0.3"));
    // e⁻¹ = 0.36787944117144232…, at t = 2 with rate −1/2; to 40 bits, 3 roundings of less than 2⁻⁴⁰ each.
    let like = int(1).to_mpfr(40);
    let rounded = s.map(|x| at_precision(&like, x));
    let [eps40, a, t] = [eps, &q("0.02405"), &int(2)].map(|x| at_precision(&like, x));
    let close = |x: &Mpfr, y: Exact| {
        assert!((x.to_exact().unwrap() - y).abs() < Exact::power_of_two(-38), "{x}");
    };
    let decayed = q("0.02405") * q("0.367879441171442");
    close(&ode::homogeneous(&rounded, &eps40, &a, &t), decayed.clone());
    close(&ode::general(&rounded, &eps40, &a, &t), q("0.05") + &decayed);
    let start = at_precision(&like, &q("0.07405"));
    close(&ode::solution(&rounded, &eps40, &start, &t), q("0.05") + decayed);

    assert_eq!(beyond::effective_penalty(s, &int(8)), int(700)); // two augmentations: p₂ = R/800
    assert_eq!(beyond::relaxed_update(s, &int(200), &int(0), &q("0.07405")), q("4.81"));
    assert_eq!(beyond::relaxed_contraction(s, eps, &int(50)), q("3/4"));
    assert_eq!(beyond::dual_functional(s, &q("4.81")), q("-0.3655"));
    assert_eq!(beyond::dual_functional(s, &int(0)), q("-0.4811805"));
    assert_eq!(beyond::aitken(&int(0), &q("2.405"), &q("3.6075")), q("4.81"));
    assert_eq!(beyond::exact_penalty(&int(5), &q("0.02")), q("0.1"));
}

fn at_precision(like: &Mpfr, x: &Exact) -> Mpfr {
    like.round_from_exact(x).unwrap()
}

/// num-dual's dual numbers as a number system.
#[derive(Clone, Copy, Debug, PartialEq)]
struct NumDual(Dual64);

operators! { [] NumDual;
    Add add |a, b| NumDual(a.0 + b.0);
    Sub sub |a, b| NumDual(a.0 - b.0);
    Mul mul |a, b| NumDual(a.0 * b.0);
    Div div |a, b| NumDual(a.0 / b.0);
    - |a| NumDual(-a.0)
}
impl Zero for NumDual {
    fn zero() -> Self {
        NumDual(Dual64::from_re(0.0))
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
impl One for NumDual {
    fn one() -> Self {
        NumDual(Dual64::from_re(1.0))
    }
}
impl Field for NumDual {
    fn int(n: i32) -> Self {
        NumDual(Dual64::from_re(f64::from(n)))
    }
}
impl PositivePart for NumDual {
    fn positive_part(&self) -> Self {
        if self.0.re > 0.0 { *self } else { Self::zero() }
    }
    fn min(&self, other: &Self) -> Self {
        if other.0.re < self.0.re { *other } else { *self }
    }
}
impl Exponential for NumDual {
    fn exp(&self) -> Self {
        NumDual(self.0.exp())
    }
}

/// Returns f′(x) by num-dual.
fn slope(f: impl Fn(&NumDual) -> NumDual, x: f64) -> f64 {
    f(&NumDual(Dual64::from_re(x).derivative())).0.eps
}

fn constant(x: &f64) -> NumDual {
    NumDual(Dual64::from_re(*x))
}

/// Every residual is the derivative of its energy. For integers below 2⁶ in absolute value the largest
/// term, 3 p⁶ and its derivative, is below 2⁵³, so f64 is exact and `==` is meant.
#[test]
fn residuals_are_derivatives() {
    let positive = (1..64i32, 1..64i32, 1..64i32);
    holds((positive, uniform6(-63..64i32)), |((c, m, eps), signed)| {
        let [c, m, eps] = [*c, *m, *eps].map(f64::from);
        let [g, l, h, lambda, u, du] = signed.map(f64::from);
        let s = SpringMass { c, m, g, l, h };
        let (d, e, n) = (s.map(constant), constant(&eps), constant(&lambda));
        assert_eq!(slope(|u| structure::potential_energy(&d, u), u), structure::residual(&s, &u));
        assert_eq!(structure::first_variation(&s, &u, &du), du * structure::residual(&s, &u));
        assert_eq!(slope(|u| contact::penetration(&d, u), u), 1.0);
        assert_eq!(slope(|u| lagrange::functional(&d, u, &n), u), lagrange::residual(&s, &u, &lambda)[0]);
        let by_lambda = slope(|n| lagrange::functional(&d, &constant(&u), n), lambda);
        assert_eq!(by_lambda, lagrange::residual(&s, &u, &lambda)[1]);
        assert_eq!(slope(|p| penalty::functional(&e, p), u), eps * u);
        assert_eq!(slope(|u| penalty::energy(&d, &e, u), u), penalty::residual(&s, &eps, &u));
        let higher = [lambda, 3.0];
        let by_p = slope(|p| penalty::series(&e, &higher.map(|x| constant(&x)), p), u);
        assert_eq!(by_p, penalty::series_force(&eps, &higher, &u));
        let augmented_slope = slope(|u| augmented::functional(&d, &e, &n, u), u);
        assert_eq!(augmented_slope, augmented::stationarity(&s, &eps, &lambda, &u));
        assert_eq!(augmented_slope, augmented::equilibrium(&s, &eps, &lambda, &u));
    });
}

/// The one-sided functional too, for penalties that are powers of two, where (⟨·⟩²)/(2ε) is exact.
#[test]
fn unilateral_residuals_are_derivatives() {
    let positive = (1..64i32, 1..64i32, 0..6);
    holds((positive, uniform5(-63..64i32)), |((c, m, e), signed)| {
        let [c, m, eps] = [*c, *m, 1 << e].map(f64::from);
        let [g, l, h, lambda, u] = signed.map(f64::from);
        let s = SpringMass { c, m, g, l, h };
        let (d, e, n) = (s.map(constant), constant(&eps), constant(&lambda));
        let by_u = slope(|u| augmented::unilateral_functional(&d, &e, &n, u), u);
        assert_eq!(by_u, augmented::unilateral_equilibrium(&s, &eps, &lambda, &u));
    });
}
