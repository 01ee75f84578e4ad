//! Dual numbers.

use crate::ball::{BallF32, BallF64};
use crate::draw::{Tally, floats, for_all, fractions, rationals};
use crate::exact::Rationals;
use crate::floats::Binary64;
use crate::format::DOUBLE;
use crate::system::{Floats, Planted, System, operations};
use num_traits::{One, Zero};
use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, penalty, structure, system};
use spring_mass_contact::number::{Ball, Dual, Exact, Exponential, Field, PositivePart, ToExact};
use spring_mass_contact::solver::{Augmentation, Plane};
use std::cmp::Ordering;
use std::fmt::Debug;
use std::marker::PhantomData;

/// Dual numbers over any of the others.
pub struct Duals<S>(PhantomData<S>);
pub type DualExact = Duals<Rationals>;
pub type DualF64 = Duals<Binary64>;
pub type DualBallF32 = Duals<BallF32>;
pub type DualBallF64 = Duals<BallF64>;

impl<S, N, M> System for Duals<S>
where
    S: System<Number = N, Meaning = M>,
    N: Field + 'static,
    M: Field + 'static,
{
    type Number = Dual<N>;
    /// Not `Dual` again, which would be compared with itself.
    type Meaning = Matrix<M>;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let dual = |(value, v): Planted<S>, (derivative, d): Planted<S>| {
            (Dual { value, derivative }, Matrix([[v.clone(), d], [M::zero(), v]]))
        };
        (S::pair(), S::pair()).prop_map(move |((va, vb), (da, db))| (dual(va, da), dual(vb, db))).boxed()
    }
    fn stands_for(result: &Self::Number, Matrix([[v, d], [zero, w]]): &Self::Meaning) -> bool {
        S::stands_for(&result.value, v) && S::stands_for(&result.derivative, d) && zero.is_zero() && v == w
    }
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        S::same(&a.value, &b.value) && S::same(&a.derivative, &b.derivative)
    }
}

/// What a dual number v + d·ε is: the matrix with v on and d above its diagonal.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix<T>(pub [[T; 2]; 2]);

impl<T: Field> Matrix<T> {
    fn each(&self, other: &Self, f: impl Fn(&T, &T) -> T) -> Self {
        Matrix([0, 1].map(|i| [0, 1].map(|j| f(&self.0[i][j], &other.0[i][j]))))
    }

    fn determinant(&self) -> T {
        let [[a, b], [c, d]] = &self.0;
        a * d - b * c
    }
}

spring_mass_contact::operators! { [T: Field] Matrix<T>;
    Add add |a, b| a.each(b, |x, y| x + y);
    Sub sub |a, b| a.each(b, |x, y| x - y);
    Mul mul |a, b| {
        let entry = |i: usize, j: usize| &a.0[i][0] * &b.0[0][j] + &a.0[i][1] * &b.0[1][j];
        Matrix([0, 1].map(|i| [0, 1].map(|j| entry(i, j))))
    };
    Div div |a, b| {
        let [[p, q], [r, s]] = &b.0;
        let product = a * Matrix([[s.clone(), -q], [-r, p.clone()]]);
        product.each(&product, |x, _| x / b.determinant())
    };
    - |a| a.each(a, |x, _| -x)
}
impl<T: Field> Zero for Matrix<T> {
    fn zero() -> Self {
        Matrix::int(0)
    }
    fn is_zero(&self) -> bool {
        self.0.iter().flatten().all(T::is_zero)
    }
}
impl<T: Field> One for Matrix<T> {
    fn one() -> Self {
        Matrix::int(1)
    }
}
impl<T: Field> Field for Matrix<T> {
    fn int(n: i32) -> Self {
        Matrix([[T::int(n), T::zero()], [T::zero(), T::int(n)]])
    }
    fn is_unit(&self) -> bool {
        self.determinant().is_unit()
    }
}

/// A system and a penalty; every divisor of the chapter's formulas is positive.
fn systems() -> BoxedStrategy<(SpringMass<Exact>, Exact)> {
    let positive = || rationals().prop_map(|x| if x.is_zero() { Exact::one() } else { x.abs() });
    (positive(), positive(), rationals(), rationals(), rationals(), positive())
        .prop_map(|(c, m, g, l, h, eps)| (SpringMass { c, m, g, l, h }, eps))
        .boxed()
}

fn constants<T: Field>(system: &SpringMass<T>) -> SpringMass<Dual<T>> {
    system.map(|x| Dual::constant(x.clone()))
}

/// Exact for polynomials of degree ≤ 2.
fn central_difference_quotient(f: impl Fn(&Exact) -> Exact, x: &Exact, step: &Exact) -> Exact {
    (f(&(x + step)) - f(&(x - step))) / (Exact::int(2) * step)
}

#[test]
fn the_derivative_of_a_quadratic_is_its_difference_quotient_at_any_step() {
    let step =
        fractions().prop_map(|(p, q)| if p == 0 { Exact::one() } else { Exact::int(p) / Exact::int(q) });
    for_all((systems(), rationals(), rationals(), step), |((system, eps), u, lambda, step)| {
        let (lifted, x) = (constants(&system), Dual::variable(u.clone()));
        let [lifted_eps, lifted_lambda] = [&eps, &lambda].map(|x| Dual::constant(x.clone()));
        let quotient = |f: &dyn Fn(&Exact) -> Exact| central_difference_quotient(f, &u, &step);
        prop_assert_eq!(
            structure::potential_energy(&lifted, &x).derivative,
            quotient(&|u| structure::potential_energy(&system, u))
        );
        prop_assert_eq!(
            penalty::energy(&lifted, &lifted_eps, &x).derivative,
            quotient(&|u| penalty::energy(&system, &eps, u))
        );
        prop_assert_eq!(
            augmented::functional(&lifted, &lifted_eps, &lifted_lambda, &x).derivative,
            quotient(&|u| augmented::functional(&system, &eps, &lambda, u))
        );
        Ok(())
    });
}

#[test]
fn the_derivative_of_a_quartic_is_its_five_point_quotient() {
    for_all((rationals(), rationals(), rationals()), |(eps, fourth, p)| {
        let f = |p: &Exact| penalty::series(&eps, std::slice::from_ref(&fourth), p);
        // The quotients at the steps h and 2h differ from f′ by h² f‴/6 and 4h² f‴/6, and by nothing else
        // if f has no fifth derivative.
        let [near, far] = [1, 2].map(|step| central_difference_quotient(f, &p, &Exact::int(step)));
        let derivative = (Exact::int(4) * near - far) / Exact::int(3);
        prop_assert_eq!(penalty::series_force(&eps, std::slice::from_ref(&fourth), &p), derivative);
        Ok(())
    });
}

#[test]
fn the_derivative_of_a_quotient_of_linear_functions_is_the_algebraic_one() {
    let units = Tally::default();
    for_all((rationals(), rationals(), rationals(), rationals(), rationals()), |(a, b, c, d, x)| {
        let [da, db, dc, dd] = [&a, &b, &c, &d].map(|x| Dual::constant(x.clone()));
        let dx = Dual::variable(x.clone());
        let below = &c + &d * &x;
        if units.count(below.is_unit()) {
            let quotient = (da + db * &dx) / (dc + dd * &dx);
            prop_assert_eq!(quotient.value, (&a + &b * &x) / &below);
            prop_assert_eq!(quotient.derivative, (b * c - a * d) / (&below * &below));
        }
        if units.count(x.is_unit()) {
            prop_assert_eq!((Dual::one() / dx).derivative, -Exact::one() / (&x * &x));
        }
        Ok(())
    });
    units.assert_one_in(2, "divisors");
}

#[test]
fn the_derivatives_of_the_penalty_deflection_are_the_algebraic_ones() {
    for_all(systems(), |(system, eps)| {
        let deflection = penalty::deflection(&constants(&system), &Dual::variable(eps.clone()));
        let (r, total) = (system::reaction(&system), &system.c + &eps);
        // u = Δ + R/(c + ε)
        let first = -&r / (&total * &total);
        prop_assert_eq!(&deflection.derivative, &first);
        // A dual of duals has the second derivative.
        let twice = Dual { value: Dual::variable(eps), derivative: Dual::one() };
        let deflection = penalty::deflection(&constants(&constants(&system)), &twice);
        prop_assert_eq!(deflection.value.derivative, first.clone());
        prop_assert_eq!(deflection.derivative.value, first);
        prop_assert_eq!(deflection.derivative.derivative, Exact::int(2) * r / (&total * &total * &total));
        Ok(())
    });
}

#[test]
fn dual_zero_divisors_are_neither_zero_nor_units() {
    let nilpotent = Dual { value: Exact::zero(), derivative: Exact::one() };
    assert!(!nilpotent.is_zero() && !nilpotent.is_unit());
    assert!((&nilpotent * &nilpotent).is_zero());
}

/// Dual numbers over f64 compute what the centres of dual balls are, so the balls bound their error. Only
/// after an overflow may a ball know better: to it 0·∞ is 0.
#[test]
fn dual_floats_are_the_centres_of_dual_balls() {
    fn law(float: &Dual<f64>, ball: &Dual<Ball<f64>>, finite: &Tally) -> TestCaseResult {
        for (float, ball) in [(float.value, &ball.value), (float.derivative, &ball.derivative)] {
            let overflown = !finite.count(float.is_finite() && ball.is_finite());
            prop_assert!(overflown || float == *ball.value(), "{:?}, {:?}", float, ball);
        }
        Ok(())
    }
    let finite = Tally::default();
    let lift =
        |x: &Dual<f64>| Dual { value: Ball::exactly(x.value), derivative: Ball::exactly(x.derivative) };
    for_all(DualF64::pair(), |((a, _), (b, _))| {
        let (ball_a, ball_b) = (lift(&a), lift(&b));
        for ((_, float), (_, ball)) in operations().into_iter().zip(operations()) {
            law(&float(&a, &b), &ball(&ball_a, &ball_b), &finite)?;
        }
        law(&a.exp(), &ball_a.exp(), &finite)
    });
    finite.assert_one_in(2, "finite balls");
}

/// γₙ = nη/(1 − nη): n roundings in a row, of products, quotients and sums, change a term of a sum by no
/// more than γₙ times its size. (Nicholas Higham, Accuracy and Stability of Numerical Algorithms, §3.1.)
fn gamma(n: i32) -> Exact {
    let roundings = Exact::int(n) * Exact::power_of_two(-53);
    &roundings / (Exact::one() - &roundings)
}

#[test]
fn num_dual_and_ours_agree_with_the_exact_derivative_to_the_roundings_made() {
    // Six exponents of up to ±40 in a formula: nothing underflows.
    let positive =
        || floats(DOUBLE.within(-40, 40)).prop_map(|x| if x.is_zero() { Exact::one() } else { x.abs() });
    let any = || floats(DOUBLE.within(-40, 40));
    for_all((positive(), positive(), any(), any(), any(), positive()), |(c, m, g, l, h, eps)| {
        let exact = SpringMass { c, m, g, l, h };
        let system = exact.map(Binary64::float);
        let x = Binary64::float(&eps);

        let ours = penalty::deflection(&constants(&system), &Dual::variable(x));
        let SpringMass { c, m, g, l, h } = system.map(|&x| num_dual::Dual64::from_re(x));
        let eps_ = num_dual::Dual64::from_re(x).derivative();
        let theirs = (eps_ * (h - l) + m * g) / (c + eps_);
        let reference = penalty::deflection(&constants(&exact), &Dual::variable(eps.clone()));

        // u = n/s with n = εΔ + mg, s = c + ε; u′ = (n′s − n s′)/s² with n′ = Δ, s′ = 1. num-dual forms
        // (n′s − n s′)·(1/s)·(1/s): n′ takes 4 roundings (the difference, the product with ε′, the sums with
        // the zero derivatives of ε·Δ and mg), n 3, s 1, s′ 1, the products 1, their difference 1, each 1/s
        // 2, its product 1: at most 13 on a term. Ours forms (n′ − (n/s)s′)/s: fewer. So γ₁₆ covers both.
        let SpringMass { c, m, g, l, h } = &exact;
        let (gap, total) = ((h - l).abs(), c + &eps);
        let size = &eps * &gap + m * g.abs();
        let value_bound = gamma(16) * &size / &total;
        let derivative_bound = gamma(16) * (&gap * &total + &size) / (&total * &total);
        for (name, value, derivative) in
            [("ours", ours.value, ours.derivative), ("num-dual", theirs.re, theirs.eps)]
        {
            let [value, derivative] = [value, derivative].map(|x| x.to_exact().unwrap());
            prop_assert!((value - &reference.value).abs() <= value_bound, "{}", name);
            prop_assert!((derivative - &reference.derivative).abs() <= derivative_bound, "{}", name);
        }

        // And ours within the bound that it computes itself.
        let balls = constants(&system.map(|&x| Ball::exactly(x)));
        let bounded = penalty::deflection(&balls, &Dual::variable(Ball::exactly(x)));
        prop_assert_eq!((*bounded.value.value(), *bounded.derivative.value()), (ours.value, ours.derivative));
        prop_assert!(BallF64::stands_for(&bounded.value, &reference.value));
        prop_assert!(BallF64::stands_for(&bounded.derivative, &reference.derivative));
        prop_assert!(bounded.derivative.is_finite());
        Ok(())
    });
}

/// ⟨·⟩ and its like have the derivative to the right, and minus that of a falling variable is the one to the left:
/// what difference quotients are, of a step before the next kink.
#[test]
fn at_a_kink_the_derivative_is_that_of_the_side() {
    let kinks = Tally::default();
    let near = prop_oneof![Just(0), -3..=3];
    for_all((systems(), near, rationals()), |((mut system, eps), r, step)| {
        // Grazing in one case of two: R = r.
        system.g = (Exact::int(r) + &system.c * system::gap(&system)) / &system.m;
        kinks.count(r == 0);
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
            prop_assert_eq!(
                contact::contact_force(&lowered).derivative,
                quotient(&|s| contact::contact_force(s))
            );
            prop_assert_eq!(contact::deflection(&lowered).derivative, quotient(&|s| contact::deflection(s)));
            prop_assert_eq!(
                penalty::unilateral_deflection(&lowered, &lifted).derivative,
                quotient(&|s| penalty::unilateral_deflection(s, &eps))
            );
        }
        // ∂u/∂ε = −R/(c + ε)² in contact, 0 where the mass hangs free and where it grazes.
        let by_penalty = |direction: i32| {
            let eps = Dual { value: eps.clone(), derivative: Exact::int(direction) };
            penalty::unilateral_deflection(&constants(&system), &eps).derivative
        };
        let total = &system.c + &eps;
        let pushed = Exact::int(r).positive_part() / (&total * &total);
        prop_assert_eq!((by_penalty(1), by_penalty(-1)), (-&pushed, pushed));
        Ok(())
    });
    kinks.assert_one_in(3, "kinks");
}

/// The order: of R[ω] with an ω > 0 below all numbers. It goes with sums and weakly with products.
#[test]
fn duals_are_an_ordered_ring() {
    let small =
        || (-2..=2, -2..=2).prop_map(|(v, d)| Dual { value: Exact::int(v), derivative: Exact::int(d) });
    for_all((small(), small(), small()), |(a, b, c)| {
        let zero = Dual::zero();
        prop_assert_eq!(a == b, a.partial_cmp(&b) == Some(Ordering::Equal));
        prop_assert_eq!(a < b, b > a);
        prop_assert_eq!(a < b, &a + &c < &b + &c);
        prop_assert_eq!(a < b, -&b < -&a);
        prop_assert!(!(a > zero && b > zero) || &a * &b >= zero);
        prop_assert_eq!(a.min(&b), b.min(&a));
        prop_assert_eq!(a.positive_part() - (-&a).positive_part(), a.clone());
        prop_assert_eq!(a.abs(), a.positive_part() + (-&a).positive_part());
        prop_assert_eq!(a.min(&b) + &c, (&a + &c).min(&(&b + &c)));
        // What is close to the right: x = v + d t at a t that is small enough for numbers such as these.
        let at = |x: &Dual<Exact>| &x.value + &x.derivative / Exact::int(100);
        prop_assert_eq!(a < b, at(&a) < at(&b));
        prop_assert_eq!(at(&a.positive_part()), at(&a).positive_part());
        prop_assert_eq!(at(&a.min(&b)), PositivePart::min(&at(&a), &at(&b)));
        Ok(())
    });
}

/// Balls that leave a sign open have both derivatives within, and else only the right one.
#[test]
fn dual_balls_hold_the_derivative_at_a_kink() {
    let open = Tally::default();
    let near = || (-3..=3i32, -3..=3i32, 0..=2i32);
    for_all((near(), near()), |((v, d, r), (w, e, q))| {
        // v + r/3 − r/3, whose radius is some units of the last place; and that much off.
        let ball = |v: i32, r: i32| {
            let third = Ball::exactly(f64::from(r)) / Ball::exactly(3.0);
            Ball::exactly(f64::from(v)) + &third - third
        };
        let (a, b) = (
            Dual { value: ball(v, r), derivative: ball(d, q) },
            Dual { value: ball(w, q), derivative: ball(e, r) },
        );
        let meant = |v: &Ball<f64>, to: i32| {
            v.value().to_exact().unwrap() + Exact::int(to) * v.radius().to_exact().unwrap()
        };
        open.count(a.value.sign().is_none());
        for (i, j) in [(-1, -1), (-1, 1), (0, 0), (1, -1), (1, 1)] {
            let dual = |x: &Dual<Ball<f64>>, i| Dual {
                value: meant(&x.value, i),
                derivative: meant(&x.derivative, i),
            };
            let (x, y) = (dual(&a, i), dual(&b, j));
            for (found, right) in
                [(a.positive_part(), x.positive_part()), (a.min(&b), x.min(&y)), (a.abs(), x.abs())]
            {
                prop_assert!(BallF64::stands_for(&found.value, &right.value), "{:?} {:?}", found, right);
                prop_assert!(
                    BallF64::stands_for(&found.derivative, &right.derivative),
                    "{:?} {:?}",
                    found,
                    right
                );
            }
        }
        Ok(())
    });
    open.assert_one_in(20, "signs left open");
}

#[test]
fn a_decided_sign_leaves_the_derivative_as_it_is() {
    let dual = |value: f64, derivative: f64| Dual {
        value: Ball::exactly(value),
        derivative: Ball::exactly(derivative),
    };
    let exactly = |x: &Dual<Ball<f64>>| (*x.derivative.value(), *x.derivative.radius());
    assert_eq!(exactly(&dual(2.0, 3.0).positive_part()), (3.0, 0.0));
    assert_eq!(exactly(&dual(-2.0, 3.0).positive_part()), (0.0, 0.0));
    assert_eq!(exactly(&dual(0.0, 3.0).positive_part()), (3.0, 0.0));
    assert_eq!(exactly(&dual(0.0, -3.0).positive_part()), (0.0, 0.0));
    assert_eq!(exactly(&dual(1.0, 3.0).min(&dual(1.0, 2.0))), (2.0, 0.0));
    assert_eq!(exactly(&dual(1.0, 3.0).min(&dual(2.0, 2.0))), (3.0, 0.0));
    // Two at once: the second derivative of ⟨x⟩³ at 0 is 0 on either side, and that of ⟨x⟩² 2 to the right.
    let twice = |direction: f64| Dual {
        value: Dual { value: 0.0, derivative: direction },
        derivative: Dual { value: direction, derivative: 0.0 },
    };
    let second = |x: Dual<Dual<f64>>| x.derivative.derivative;
    let part = |direction| twice(direction).positive_part();
    assert_eq!([second(part(1.0) * part(1.0)), second(part(-1.0) * part(-1.0))], [2.0, 0.0]);
    assert_eq!(second(part(1.0) * part(1.0) * part(1.0)), 0.0);
}

/// The iteration (1.16) differentiates itself, too: by ε, as its closed forms do.
#[test]
fn an_augmentation_in_duals_has_the_derivative_of_its_closed_form() {
    for_all((systems(), 0..6usize), |((system, eps), k)| {
        let (lifted, eps) = (constants(&system), Dual::variable(eps));
        let step = Augmentation::new(&lifted, &eps).over(Plane::Bilateral).nth(k).unwrap();
        let rho = augmented::contraction(&lifted, &eps);
        let decay = (0..k).fold(Dual::one(), |decay, _| decay * &rho);
        let start = Dual::zero();
        prop_assert_eq!(step.penetration, augmented::penetration_after(&lifted, &eps, &start, &decay));
        prop_assert_eq!(step.multiplier, augmented::multiplier_after(&lifted, &start, &decay));
        // From λ₀ = 0 a plane that never pulls is the same in contact, and free it takes no part.
        let one_sided = Augmentation::new(&lifted, &eps).nth(k).unwrap();
        let free = system::reaction(&system) < Exact::zero();
        let limit = structure::deflection(&lifted);
        prop_assert_eq!(one_sided.deflection, if free { limit } else { step.deflection });
        Ok(())
    });
}
