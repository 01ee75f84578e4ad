//! The chapter in dual numbers: its derivatives are exact in rationals, and within the rounding errors in
//! floats.

use crate::strategies::*;
use num_traits::One;
use spring_mass_contact::chapter::{augmented, contact, penalty, structure};
use spring_mass_contact::number::{Ball, Dual, Field};

/// A system and a penalty for which every divisor in the chapter is positive.
fn systems() -> impl Strategy<Value = (SpringMass<Exact>, Exact)> {
    let [c, m, eps] = [(); 3].map(|()| positive(NARROW));
    let [g, l, h] = [(); 3].map(|()| number(NARROW));
    (c, m, g, l, h, eps).prop_map(|(c, m, g, l, h, eps)| (SpringMass { c, m, g, l, h }, eps))
}

fn constants<T: Field>(system: &SpringMass<T>) -> SpringMass<Dual<T>> {
    system.map(|x| Dual::constant(x.clone()))
}

/// Exact for polynomials of degree ≤ 2.
fn central_difference_quotient(f: impl Fn(&Exact) -> Exact, x: &Exact, step: &Exact) -> Exact {
    (f(&(x + step)) - f(&(x - step))) / (Exact::int(2) * step)
}

/// γₙ = nη/(1 − nη): n successive roundings of products, quotients and sums change a term of a sum by at most
/// γₙ relative to itself. (Nicholas Higham, Accuracy and Stability of Numerical Algorithms, §3.1.)
fn gamma(n: i32) -> Exact {
    let roundings = Exact::int(n) * Exact::power_of_two(-53);
    &roundings / (Exact::one() - &roundings)
}

#[test]
fn the_derivative_of_a_quadratic_is_its_difference_quotient_at_any_step() {
    let numbers = (number(NARROW), number(NARROW), nonzero(NARROW));
    holds((systems(), numbers), |((system, eps), (u, lambda, step))| {
        let (lifted, x) = (constants(system), Dual::variable(u.clone()));
        let [lifted_eps, lifted_lambda] = [eps, lambda].map(|x| Dual::constant(x.clone()));
        let quotient = |f: &dyn Fn(&Exact) -> Exact| central_difference_quotient(f, u, step);
        assert_eq!(
            structure::potential_energy(&lifted, &x).derivative,
            quotient(&|u| structure::potential_energy(system, u))
        );
        assert_eq!(
            penalty::energy(&lifted, &lifted_eps, &x).derivative,
            quotient(&|u| penalty::energy(system, eps, u))
        );
        assert_eq!(
            augmented::functional(&lifted, &lifted_eps, &lifted_lambda, &x).derivative,
            quotient(&|u| augmented::functional(system, eps, lambda, u))
        );
    });
}

#[test]
fn the_derivative_of_a_quartic_is_its_five_point_quotient() {
    holds((number(NARROW), number(NARROW), number(NARROW)), |(eps, fourth, p)| {
        let f = |p: &Exact| penalty::series(eps, std::slice::from_ref(fourth), p);
        // The quotients at the steps h and 2h differ from f′ by h² f‴/6 and 4h² f‴/6, and by nothing else
        // if f has no fifth derivative.
        let [near, far] = [1, 2].map(|step| central_difference_quotient(f, p, &Exact::int(step)));
        let derivative = (Exact::int(4) * near - far) / Exact::int(3);
        assert_eq!(penalty::series_force(eps, std::slice::from_ref(fourth), p), derivative);
    });
}

#[test]
fn the_derivatives_of_the_penalty_deflection_are_the_algebraic_ones() {
    holds(systems(), |(system, eps)| {
        let deflection = penalty::deflection(&constants(system), &Dual::variable(eps.clone()));
        let (r, total) = (system::reaction(system), &system.c + eps);
        // u = Δ + R/(c + ε)
        let first = -&r / (&total * &total);
        assert_eq!(&deflection.derivative, &first);
        // A dual of duals has the second derivative.
        let twice = Dual { value: Dual::variable(eps.clone()), derivative: Dual::one() };
        let deflection = penalty::deflection(&constants(&constants(system)), &twice);
        assert_eq!(deflection.value.derivative, first.clone());
        assert_eq!(deflection.derivative.value, first);
        assert_eq!(deflection.derivative.derivative, Exact::int(2) * r / (&total * &total * &total));
    });
}

/// Six exponents in a formula: nothing underflows.
#[test]
fn derivatives_in_f64_are_within_the_rounding_error_bound() {
    holds(systems(), |(system, eps)| {
        let (system, x) = (system.map(|x| x.to_f64().unwrap()), eps.to_f64().unwrap());
        let (rational, eps) = (system.map(exact), exact(&x));

        let ours = penalty::deflection(&constants(&system), &Dual::variable(x));
        let SpringMass { c, m, g, l, h } = system.map(|&x| num_dual::Dual64::from_re(x));
        let eps_ = num_dual::Dual64::from_re(x).derivative();
        let theirs = (eps_ * (h - l) + m * g) / (c + eps_);
        let reference = penalty::deflection(&constants(&rational), &Dual::variable(eps.clone()));

        // u = n/s with n = εΔ + mg, s = c + ε; u′ = (n′s − n s′)/s² with n′ = Δ, s′ = 1. num-dual forms
        // (n′s − n s′)·(1/s)·(1/s): n′ takes 4 roundings (the difference, the product with ε′, the sums with
        // the zero derivatives of ε·Δ and mg), n 3, s 1, s′ 1, the products 1, their difference 1, each 1/s
        // 2, its product 1: at most 13 on a term. Ours forms (n′ − (n/s)s′)/s: fewer. So γ₁₆ covers both.
        let SpringMass { c, m, g, l, h } = &rational;
        let (gap, total) = ((h - l).abs(), c + &eps);
        let size = &eps * &gap + m * g.abs();
        let value_bound = gamma(16) * &size / &total;
        let derivative_bound = gamma(16) * (&gap * &total + &size) / (&total * &total);
        for (name, value, derivative) in
            [("ours", ours.value, ours.derivative), ("num-dual", theirs.re, theirs.eps)]
        {
            let [value, derivative] = [value, derivative].map(|x| x.to_exact().unwrap());
            assert!((value - &reference.value).abs() <= value_bound, "{}", name);
            assert!((derivative - &reference.derivative).abs() <= derivative_bound, "{}", name);
        }

        // And ours within the bound that it computes itself.
        let balls = constants(&system.map(|&x| Ball::point(x)));
        let bounded = penalty::deflection(&balls, &Dual::variable(Ball::point(x)));
        assert_eq!((*bounded.value.value(), *bounded.derivative.value()), (ours.value, ours.derivative));
        let encloses = |ball: &Ball<f64>, x: &Exact| (exact(ball.value()) - x).abs() <= exact(ball.radius());
        assert!(encloses(&bounded.value, &reference.value));
        assert!(encloses(&bounded.derivative, &reference.derivative));
        assert!(bounded.derivative.is_finite());
    });
}

/// ⟨·⟩ and the like have the right-hand derivative, and minus that of a decreasing variable is the
/// left-hand one: difference quotients with a step that does not reach the next kink.
#[test]
fn derivatives_at_a_kink_are_one_sided() {
    holds((systems(), prop_oneof![Just(0), -3..=3], number(NARROW)), |((system, eps), r, step)| {
        let (r, mut system) = (*r, system.clone());
        // Grazing in one case of two: R = r.
        system.g = (Exact::int(r) + &system.c * system::gap(&system)) / &system.m;
        // The functions are linear between R and 0, for H c less than |R| away; of ε there is no kink at all.
        let most = if r == 0 { Exact::one() } else { Exact::int(r).abs() / &system.c / Exact::int(2) };
        let step = if step.is_zero() { most } else { step.abs().min(most) };
        for direction in [1, -1] {
            let moved = |x: &Exact| x + Exact::int(direction) * &step;
            let dual = |x: &Exact| Dual { value: x.clone(), derivative: Exact::int(direction) };
            let lowered = SpringMass { h: dual(&system.h), ..constants(&system) };
            let there = SpringMass { h: moved(&system.h), ..system.clone() };
            let quotient = |f: &dyn Fn(&SpringMass<Exact>) -> Exact| (f(&there) - f(&system)) / &step;
            let lifted = Dual::constant(eps.clone());
            assert_eq!(contact::contact_force(&lowered).derivative, quotient(&|s| contact::contact_force(s)));
            assert_eq!(contact::deflection(&lowered).derivative, quotient(&|s| contact::deflection(s)));
            assert_eq!(
                penalty::unilateral_deflection(&lowered, &lifted).derivative,
                quotient(&|s| penalty::unilateral_deflection(s, eps))
            );
        }
        // ∂u/∂ε = −R/(c + ε)² in contact, 0 where the mass hangs free and where it grazes.
        let by_penalty = |direction: i32| {
            let eps = Dual { value: eps.clone(), derivative: Exact::int(direction) };
            penalty::unilateral_deflection(&constants(&system), &eps).derivative
        };
        let total = &system.c + eps;
        let pushed = Exact::int(r).positive_part() / (&total * &total);
        assert_eq!((by_penalty(1), by_penalty(-1)), (-&pushed, pushed));
    });
}

/// The iteration (1.16) is differentiated with respect to ε like its closed forms.
#[test]
fn an_augmentation_has_the_derivative_of_its_closed_form() {
    holds((systems(), 0..6usize), |((system, eps), k)| {
        let (lifted, eps) = (constants(system), Dual::variable(eps.clone()));
        let step = Augmentation::new(&lifted, &eps).over(Plane::Bilateral).nth(*k).unwrap();
        let rho = augmented::contraction(&lifted, &eps);
        let decay = (0..*k).fold(Dual::one(), |decay, _| decay * &rho);
        let start = Dual::zero();
        assert_eq!(step.penetration, augmented::penetration_after(&lifted, &eps, &start, &decay));
        assert_eq!(step.multiplier, augmented::multiplier_after(&lifted, &start, &decay));
        // From λ₀ = 0 a plane that never pulls is the same in contact, and free it takes no part.
        let one_sided = Augmentation::new(&lifted, &eps).nth(*k).unwrap();
        let free = system::reaction(system) < Exact::zero();
        let limit = structure::deflection(&lifted);
        assert_eq!(one_sided.deflection, if free { limit } else { step.deflection });
    });
}
