//! The chapter in dual numbers. That its residuals are derivatives of its functionals are claims.

use crate::strategies::*;
use num_traits::One;
use spring_mass_contact::chapter::{augmented, contact, penalty, structure};
use spring_mass_contact::number::{Dual, Field};

/// A system and a penalty for which every divisor in the chapter is positive.
fn systems() -> impl Strategy<Value = (SpringMass<Exact>, Exact)> {
    let [c, m, eps] = [(); 3].map(|()| positive(NARROW));
    let [g, l, h] = [(); 3].map(|()| number(NARROW));
    (c, m, g, l, h, eps).prop_map(|(c, m, g, l, h, eps)| (SpringMass { c, m, g, l, h }, eps))
}

fn constants<T: Field>(system: &SpringMass<T>) -> SpringMass<Dual<T>> {
    system.as_ref().map(|x| Dual::constant(x.clone()))
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

/// The claims about (1.10) have one term beyond the first.
#[test]
fn the_force_of_a_series_is_its_slope() {
    holds(
        (number(NARROW), prop::collection::vec(number(NARROW), 0..4), number(NARROW)),
        |(eps, higher, p)| {
            let constants: Vec<_> = higher.iter().map(|x| Dual::constant(x.clone())).collect();
            let energy =
                penalty::series(&Dual::constant(eps.clone()), &constants, &Dual::variable(p.clone()));
            assert_eq!(energy.derivative, penalty::series_force(eps, higher, p));
        },
    );
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
