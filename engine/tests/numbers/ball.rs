//! Tests of balls.

use super::draw::{Tally, floats, for_all, pairs, rationals};
use super::floats::{Binary16, Binary32, Binary64, Brain16};
use super::format::bracket;
use super::mpfr::{Mpfr2, Mpfr3, Mpfr24, Mpfr53, Mpfr200, all_of_three_bits};
use super::system::{Floats, Planted, System, operations};
use num_traits::{One, Zero};
use proptest::prelude::*;
use provable::number::{Ball, Dual, Exact, Exponential, Field, Mpfr, PositivePart, Real, ToExact};
use rug::Float;
use std::cmp::Ordering;
use std::fmt::Debug;
use std::marker::PhantomData;

/// Balls over floats with the exact number anywhere inside: at a bound, at the centre, or between.
pub struct Balls<S>(PhantomData<S>);
pub type BallF16 = Balls<Binary16>;
pub type BallBf16 = Balls<Brain16>;
pub type BallF32 = Balls<Binary32>;
pub type BallF64 = Balls<Binary64>;
pub type BallMpfr2 = Balls<Mpfr2>;
pub type BallMpfr53 = Balls<Mpfr53>;

/// Radius of a ball: 0, half a unit in the last place, or about η·2ᵏ times its centre.
#[derive(Clone, Copy, Debug)]
enum Width {
    Point,
    Rounding,
    Wide(i32),
}

impl<S: Floats<Number = N>, N: Real + ToExact + 'static> Balls<S> {
    /// A radius and a position inside: from −16, the lower bound, to 16, the upper bound.
    fn shape() -> BoxedStrategy<(Width, i32)> {
        let widest = S::FORMAT.bits.cast_signed() + 4;
        let width =
            prop_oneof![Just(Width::Point), Just(Width::Rounding), (-8..widest).prop_map(Width::Wide)];
        (width, prop_oneof![Just(-16), Just(0), Just(16), -16..=16]).boxed()
    }

    fn planted(centre: &Exact, (width, place): (Width, i32)) -> Planted<Self> {
        let float = S::float(centre);
        let ball = match width {
            Width::Point => Ball::point(float),
            Width::Rounding => Ball::from_rounded(float),
            Width::Wide(k) => {
                // Around 0 too, where the centre has no size of its own.
                let size = if centre.is_zero() { Exact::one() } else { centre.clone() };
                let error = S::float(&S::FORMAT.fit(&(size * Exact::power_of_two(k))));
                Ball::point(float) + (Ball::from_rounded(error.clone()) - Ball::point(error))
            }
        };
        let inside = match ball.radius().to_exact() {
            Ok(radius) => centre + radius * Exact::int(place) / Exact::int(16),
            Err(_) => centre.clone(),
        };
        (ball, inside)
    }

    pub fn of(centres: BoxedStrategy<Exact>) -> BoxedStrategy<Planted<Self>> {
        (centres, Self::shape()).prop_map(|(centre, shape)| Self::planted(&centre, shape)).boxed()
    }
}

impl<S: Floats<Number = N>, N: Real + ToExact + 'static> System for Balls<S> {
    type Number = Ball<N>;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        (pairs(S::FORMAT), Self::shape(), Self::shape())
            .prop_map(|((a, b), sa, sb)| (Self::planted(&a, sa), Self::planted(&b, sb)))
            .boxed()
    }
    fn stands_for(result: &Self::Number, exact: &Exact) -> bool {
        match (result.value().to_exact(), result.radius().to_exact()) {
            (Ok(value), Ok(radius)) => exact >= &(&value - &radius) && exact <= &(value + radius),
            _ => *result.radius() == N::infinity(),
        }
    }
    /// Returns `true` if the balls have a number in common.
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        let end = |x: &N| x.to_exact();
        match (end(a.value()), end(a.radius()), end(b.value()), end(b.radius())) {
            (Ok(va), Ok(ra), Ok(vb), Ok(rb)) => (va - vb).abs() <= ra + rb,
            _ => !a.is_finite() || !b.is_finite(),
        }
    }
}

law! { the_radius_is_zero_only_for_exact_centres: Binary16 Brain16 Binary32 Binary64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 }

// Laws of the balls over these floats.
macro_rules! laws_of_balls {
    ($($law:ident)+) => {$(law! { $law: Binary16 Brain16 Binary32 Binary64 Mpfr2 Mpfr53 })+};
}
laws_of_balls! {
    signs_and_bounds_of_balls_are_correct
    the_centre_is_the_float_result
    exp_of_a_ball_contains_the_exact_value
    exp_of_a_dual_ball_contains_the_exact_value_and_derivative
    the_radius_of_an_operation_on_points_is_tight
}

/// The four operations are monotone in each operand (÷ on either side of 0), so if the results for the bounds
/// of both balls are inside, all others are.
#[test]
fn operations_on_3_bit_balls_contain_the_results_of_their_ends() {
    let all = all_of_three_bits(-4..=0);
    let finite = Tally::default();
    for a in &all {
        for b in &all {
            let balls = [a, b].map(|x| Ball::from_rounded(Mpfr3::float(x)));
            let [ends_a, ends_b] = [(a, &balls[0]), (b, &balls[1])].map(|(x, ball)| {
                let radius = ball.radius().to_exact().unwrap();
                [x - &radius, x + radius]
            });
            for (i, (name, exact)) in operations::<Exact>().into_iter().enumerate() {
                let result = operations()[i].1(&balls[0], &balls[1]);
                if !finite.count(result.is_finite()) {
                    assert!(name == "/" && b.is_zero(), "{a} {name} {b}: {result:?}");
                    continue;
                }
                for (x, y) in ends_a.iter().flat_map(|x| ends_b.iter().map(move |y| (x, y))) {
                    let exact = exact(x, y);
                    assert!(Balls::<Mpfr3>::stands_for(&result, &exact), "{x} {name} {y}: {result:?}");
                }
            }
        }
    }
    finite.assert_one_in(2, "finite balls");
}

fn signs_and_bounds_of_balls_are_correct<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let (certain, uncertain) = (Tally::default(), Tally::default());
    // Differences of neighbours straddle 0; quotients have infinite balls among them.
    for_all(Balls::<S>::pair(), |((a, exact_a), (b, exact_b))| {
        let mut planted = vec![(&a - &b, &exact_a - &exact_b)];
        if exact_b.is_invertible() {
            planted.push((&a / &b, &exact_a / &exact_b));
        }
        planted.push((a, exact_a));
        for (ball, exact) in planted {
            prop_assert!(ball.contains(&exact));
            let sign = ball.sign();
            certain.count(sign.is_some());
            uncertain.count(sign.is_none());
            prop_assert!(sign.is_none() || sign == Some(exact.cmp(&Exact::zero())), "{:?}: {}", ball, exact);
            prop_assert!(!ball.is_invertible() || !exact.is_zero());
            prop_assert!(compare(&ball.lower(), &exact).is_some_and(Ordering::is_le), "{:?}", ball);
            prop_assert!(compare(&ball.upper(), &exact).is_some_and(Ordering::is_ge), "{:?}", ball);
            prop_assert!(compare(&ball.magnitude(), &exact.abs()).is_some_and(Ordering::is_ge), "{:?}", ball);
        }
        Ok(())
    });
    certain.assert_one_in(4, "signs decided");
    uncertain.assert_one_in(200, "signs not decided");
}

/// The enclosure holds for an infinite `x` as well.
fn compare<N: Real + ToExact>(x: &N, exact: &Exact) -> Option<Ordering> {
    match x.to_exact() {
        Ok(x) => Some(x.cmp(exact)),
        Err(_) => x.partial_cmp(&N::zero()),
    }
}

fn the_centre_is_the_float_result<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    for_all(Balls::<S>::pair(), |((a, _), (b, _))| {
        let (x, y) = (a.value(), b.value());
        let same = |ball: &Ball<N>, float: &N| S::same(ball.value(), float);
        for ((name, ball), (_, float)) in operations().into_iter().zip(operations()) {
            let (ball, float) = (ball(&a, &b), float(x, y));
            prop_assert!(same(&ball, &float), "{}: {:?}, {:?}", name, ball, float);
        }
        prop_assert!(same(&-&a, &-x));
        prop_assert!(same(&a.min(&b), &x.min(y)));
        prop_assert!(same(&a.positive_part(), &x.positive_part()));
        Ok(())
    });
}

/// One and a half of the smallest number: few digits, but between two floats.
#[test]
fn a_number_between_subnormals_is_enclosed_with_a_positive_radius() {
    let x = |n| Exact::from(3) * Exact::power_of_two(n);
    let (single, double) =
        (Ball::enclosing(&0f32, &x(-150)).unwrap(), Ball::enclosing(&0f64, &x(-1075)).unwrap());
    assert!(*single.radius() > 0.0 && single.contains(&x(-150)));
    assert!(*double.radius() > 0.0 && double.contains(&x(-1075)));
}

fn the_radius_is_zero_only_for_exact_centres<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let inexact = Tally::default();
    let thirds = floats(S::FORMAT).prop_map(|x| x / Exact::int(3));
    for_all(prop_oneof![1 => floats(S::FORMAT), 2 => thirds, 1 => rationals()], |x| {
        let nearest = S::FORMAT.round(&x);
        let ball = Ball::enclosing(&S::float(&Exact::zero()), &x);
        let in_range = nearest.abs() <= S::FORMAT.largest() && nearest.is_zero() == x.is_zero();
        prop_assert_eq!(ball.is_ok(), in_range, "{}", x);
        if let Ok(ball) = ball {
            prop_assert_eq!(ball.value(), &S::float(&nearest));
            prop_assert_eq!(ball.radius().is_zero(), !inexact.count(x != nearest));
            prop_assert!(Balls::<S>::stands_for(&ball, &x) && ball.contains(&x));
        }
        let ball = Ball::from_rounded(S::float(&S::FORMAT.fit(&x)));
        let radius = ball.radius().to_exact().unwrap();
        let end = ball.value().to_exact().unwrap() + &radius;
        prop_assert!(ball.contains(&end));
        prop_assert!(!ball.contains(&(end + Exact::power_of_two(-5000))));
        Ok(())
    });
    inexact.assert_one_in(10, "inexact centres");
}

/// Infinite radii would satisfy all other laws. One operation adds η|x| for the rounding of x, increased by
/// at most a factor 1 + 2η by rounding up, and the subnormal unit u if the product or sum underflows: for
/// points at most 2 (η|x| + 4u).
fn the_radius_of_an_operation_on_points_is_tight<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let eta = Exact::power_of_two(1 - S::FORMAT.bits.cast_signed());
    let underflow = Exact::int(8) * N::min_subnormal().to_exact().unwrap();
    let tried = Tally::default();
    for_all(pairs(S::FORMAT), |(a, b)| {
        let [x, y] = [&a, &b].map(S::float);
        let [p, q] = [&x, &y].map(|x| Ball::point(x.clone()));
        for ((_, ball), (_, float)) in operations().into_iter().zip(operations::<N>()) {
            let result = float(&x, &y);
            // Not where the float overflows, or only its bound does.
            let limit = S::FORMAT.largest() / Exact::int(4);
            if tried.count(result.to_exact().is_ok_and(|x| !S::FORMAT.bounded || x.abs() < limit)) {
                let ball = ball(&p, &q);
                let bound = &eta * result.to_exact().unwrap().abs() + &underflow;
                prop_assert!(ball.radius().to_exact().is_ok_and(|r| r <= bound), "{:?}, {}", ball, bound);
            }
        }
        Ok(())
    });
    tried.assert_one_in(2, "operations tried");
}

/// Bits of the enclosure of an exponential, many more than any of the balls has.
const ENCLOSURE: u32 = 500;

fn exp_of_a_ball_contains_the_exact_value<
    S: Floats<Number = N>,
    N: Real + Exponential + ToExact + 'static,
>() {
    let finite = Tally::default();
    let bits = S::FORMAT.bits.cast_signed();
    for_all(Balls::<S>::of(floats(S::FORMAT.within(-bits - 8, 11))), |(ball, x)| {
        let result = ball.exp();
        prop_assert!(Balls::<S>::same(&result, &Ball::point(ball.value().exp())));
        if finite.count(result.is_finite()) {
            let (low, high) = bracket(&x, ENCLOSURE, Float::exp_round);
            prop_assert!(Balls::<S>::stands_for(&result, &low), "exp {:?} = {:?} at {}", ball, result, x);
            prop_assert!(Balls::<S>::stands_for(&result, &high), "exp {:?} = {:?} at {}", ball, result, x);
        }
        Ok(())
    });
    finite.assert_one_in(2, "finite exponentials");
}

/// (eˣ)′ = eˣ x′. Both factors lie between their bounds, so the product lies between the smallest and the
/// largest product of bounds.
fn exp_of_a_dual_ball_contains_the_exact_value_and_derivative<
    S: Floats<Number = N>,
    N: Real + Exponential + ToExact + 'static,
>() {
    let finite = Tally::default();
    let bits = S::FORMAT.bits.cast_signed();
    let values = || Balls::<S>::of(floats(S::FORMAT.within(-bits, 6)));
    for_all((values(), values()), |((value, x), (derivative, dx))| {
        let Dual { value, derivative } = Dual { value, derivative }.exp();
        let (low, high) = bracket(&x, ENCLOSURE, Float::exp_round);
        finite.count(value.is_finite() && derivative.is_finite());
        for end in [low, high] {
            prop_assert!(Balls::<S>::stands_for(&value, &end));
            prop_assert!(Balls::<S>::stands_for(&derivative, &(end * &dx)));
        }
        Ok(())
    });
    finite.assert_one_in(2, "finite exponentials");
}

/// |eˣ − 1| ≤ r + r² for |x| ≤ r ≤ 1, and the rest of the radius is about an ulp: for r = 2⁻¹⁰ it is below r + 2 r².
#[test]
fn the_exponential_of_a_narrow_ball_is_narrow() {
    let r = 1.0 / 1024.0;
    let ball = Ball::point(-r).hull(&Ball::point(r));
    assert!(*ball.radius() >= r);
    let exponential = ball.exp();
    assert_eq!(*exponential.value(), 1.0);
    assert!(*exponential.radius() < r + 2.0 * r * r, "{exponential:?}");
}

/// Around zero the rounding of the centre cannot hide an error of the radius.
#[test]
fn scaled_balls_around_zero_contain_the_scaled_ends() {
    fn law<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
        let one = S::float(&Exact::one());
        let ball = Ball::from_rounded(one.clone()) - Ball::point(one);
        let end = ball.radius().to_exact().unwrap();
        for n in 1..200 {
            let (quotient, product) = (&ball / Ball::int(n), &ball * Ball::int(n));
            for end in [-&end, end.clone()] {
                assert!(
                    Balls::<S>::stands_for(&quotient, &(&end / Exact::int(n))),
                    "{end}/{n}: {quotient:?}"
                );
                assert!(Balls::<S>::stands_for(&product, &(&end * Exact::int(n))), "{end} {n}: {product:?}");
            }
        }
    }
    law::<Binary32, _>();
    law::<Binary64, _>();
    law::<Mpfr2, _>();
    law::<Mpfr53, _>();
}

/// Subnormal numbers, whose products may round to 0 without being 0, get no radius 0.
#[test]
fn only_a_product_with_exactly_zero_is_exactly_zero() {
    fn law<N: Real + ToExact>(least: &N) {
        let (zero, least) = (Ball::<N>::zero(), Ball::point(least.clone()));
        let third = Ball::point(N::one()) / Ball::point(N::int(3));
        for factor in [&third, &least, &(&least - &third), &zero] {
            assert!((&zero * factor).is_zero() && (factor * &zero).is_zero(), "{factor:?}");
        }
        let product = &least * &third * &least;
        assert!(!product.is_zero() && product.contains(&Exact::zero()), "{product:?}");
    }
    law(&f32::from_bits(1));
    law(&f64::from_bits(1));
}

#[test]
fn division_by_a_ball_around_zero_is_unbounded_and_by_zero_undefined() {
    fn law<S: Floats<Number = N>, N: Real + Exponential + ToExact>(zeros: &[N]) {
        let one = S::float(&Exact::one());
        let around_zero = Ball::from_rounded(one.clone()) - Ball::from_rounded(one.clone());
        let points = zeros.iter().cloned().map(Ball::point);
        for divisor in points.chain([around_zero, Ball::zero()]) {
            assert!(!divisor.is_invertible());
            for dividend in [Ball::point(one.clone()), Ball::one(), Ball::zero(), divisor.clone()] {
                let quotient = dividend / &divisor;
                assert_eq!((quotient.is_finite(), quotient.sign()), (false, None));
                assert!(quotient.contains(&Exact::int(7)));
                // Nothing is known of what is computed from it, either; and a factor 0 does not mend what is undefined.
                let (one, zero) = (Ball::<N>::one(), Ball::<N>::zero());
                let computed = [
                    (&quotient + &one, &one + &quotient),
                    (&quotient - &one, &one - &quotient),
                    (&quotient * &divisor, &divisor * &quotient),
                    (&quotient / &one, &zero / &quotient),
                    (-&quotient, quotient.min(&one)),
                    (quotient.positive_part(), one.min(&quotient)),
                    (quotient.exp(), &quotient - &quotient),
                    (quotient.hull(&one), zero.hull(&quotient)),
                ];
                let undefined = divisor.is_zero();
                assert_eq!(quotient.is_undefined(), undefined);
                for ball in computed.into_iter().flat_map(<[_; 2]>::from) {
                    assert!(!ball.is_finite());
                    assert_eq!(ball.is_undefined(), undefined, "{ball:?}");
                }
            }
        }
    }
    law::<Binary32, _>(&[0.0, -0.0]);
    law::<Binary64, _>(&[0.0, -0.0]);
    law::<Mpfr53, _>(&[Mpfr::zero(), Mpfr53::float(&Exact::zero()), -Mpfr53::float(&Exact::zero())]);
}
