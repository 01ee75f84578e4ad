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
use spring_mass_contact::chapter::{SpringMass, augmented, penalty, structure, system};
use spring_mass_contact::number::{Ball, Dual, Exact, Exponential, Field, PositivePart, ToExact};
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
