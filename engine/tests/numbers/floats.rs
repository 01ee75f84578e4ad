//! Tests of machine floats, shared with floats of any precision.

use super::draw::{Tally, floats, for_all, pairs, rationals};
use super::format::{BRAIN, DOUBLE, Format, HALF, SINGLE, magnitude, rounds_as};
use super::mpfr::{Mpfr2, Mpfr3, Mpfr24, Mpfr53, Mpfr200};
use super::system::{Floats, Planted, System, planted};
use half::{bf16, f16};
use num_traits::{One, Zero};
use proptest::prelude::*;
use provable::number::{Exact, Exponential, Field, Logarithm, Mpfr, Native, PositivePart, Real, ToExact};
use rug::{Float, Rational};
use std::fmt::Debug;

macro_rules! machine_floats {
    ($($Name:ident $float:ty, $format:ident, $convert:expr;)*) => {$(
        pub struct $Name;

        impl System for $Name {
            type Number = $float;
            type Meaning = Exact;

            fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
                pairs($format).prop_map(planted::<Self>).boxed()
            }
            fn stands_for(result: &$float, exact: &Exact) -> bool {
                let nearest = $format.round(exact);
                if nearest.abs() > $format.largest() {
                    *result == if nearest > Exact::zero() { Real::infinity() } else { -<$float>::infinity() }
                } else {
                    result.to_exact() == Ok(nearest)
                }
            }
        }
        impl Floats for $Name {
            const FORMAT: Format = $format;

            fn float(x: &Exact) -> $float {
                $convert(x.as_rational())
            }
        }
    )*};
}
machine_floats! {
    Binary16 Native<f16>, HALF, |x: &Rational| Native(f16::from_f64(x.to_f64()));
    Brain16 Native<bf16>, BRAIN, |x: &Rational| Native(bf16::from_f64(x.to_f64()));
    Binary32 f32, SINGLE, Rational::to_f32;
    Binary64 f64, DOUBLE, Rational::to_f64;
    Native64 Native<f64>, DOUBLE, |x: &Rational| Native(x.to_f64());
}

macro_rules! laws_of_floats {
    ($($law:ident)+) => {$(law! { $law:
        Binary16 Brain16 Binary32 Binary64 Native64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 })+};
}
laws_of_floats! {
    no_float_lies_between_neighbours
    the_unit_roundoff_bounds_every_rounding
    inflation_compensates_for_ten_roundings
    exp_ln_and_ln_1p_are_correctly_rounded
}

fn no_float_lies_between_neighbours<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let below_the_largest = Tally::default();
    for_all(S::number(), |(x, exact)| {
        let (up, down) = (x.clone().next_up(), x.clone().next_down());
        prop_assert!(down < x && x < up);
        prop_assert_eq!(up.clone().next_down(), x.clone());
        prop_assert_eq!(down.clone().next_up(), x.clone());
        prop_assert_eq!(format!("{:?}", (-&x).next_up()), format!("{:?}", -&down));
        // The neighbours of an unbounded format's zero have exponents too large to look at.
        let near = if S::FORMAT.bounded || !exact.is_zero() { up } else { x };
        let largest = S::FORMAT.bounded && exact == S::FORMAT.largest();
        prop_assert_eq!(near.is_finite(), !largest);
        if below_the_largest.count(!largest && near.to_exact().as_ref() != Ok(&exact)) {
            let near = near.to_exact().unwrap();
            prop_assert_eq!(&S::FORMAT.round(&near), &near);
            // Were there a float between, one of the two thirds would round to it.
            let third = (&near - &exact) / Exact::int(3);
            prop_assert_eq!(S::FORMAT.round(&(&exact + &third)), exact);
            prop_assert_eq!(S::FORMAT.round(&(&near - third)), near);
        }
        Ok(())
    });
    below_the_largest.assert_one_in(2, "neighbours looked at");
}

/// Tests all finite floats of a format: the bits of those without a sign have the same order.
fn neighbours_have_adjacent_bits<T: num_traits::Float + Debug>(infinity: u16, float: fn(u16) -> T) {
    for bits in 0..infinity {
        let (x, up) = (Native(float(bits)), Native(float(bits + 1)));
        assert_eq!(x.next_up(), up);
        assert_eq!((-up).next_up(), -x);
    }
}

#[test]
fn neighbours_of_floats_of_16_bits_have_adjacent_bits() {
    neighbours_have_adjacent_bits(f16::INFINITY.to_bits(), f16::from_bits);
    neighbours_have_adjacent_bits(bf16::INFINITY.to_bits(), bf16::from_bits);
}

fn the_unit_roundoff_bounds_every_rounding<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let eta = Exact::power_of_two(-S::FORMAT.bits.cast_signed());
    let least = if S::FORMAT.bounded { Exact::power_of_two(S::FORMAT.least) } else { Exact::zero() };
    assert_eq!(N::min_subnormal().to_exact(), Ok(least));
    assert!(!N::infinity().is_finite() && N::infinity() > N::zero());
    for_all((S::number(), rationals()), |((x, exact), any)| {
        prop_assert_eq!(x.unit_roundoff().to_exact(), Ok(eta.clone()));
        prop_assert!(x.is_finite());
        let size = x.magnitude().to_exact().unwrap();
        // Exact up to 64 bits, otherwise rounded up to 64 bits.
        prop_assert!(exact.abs() <= size);
        prop_assert!(size <= exact.abs() * (Exact::one() + Exact::power_of_two(-63)));
        // η|fl(x)| is what the balls add for a rounding.
        let rounded = S::FORMAT.fit(&any);
        let overflows = any.abs() > S::FORMAT.largest();
        let error = S::float(&rounded).to_exact().unwrap() - &any;
        let underflow = N::min_subnormal().to_exact().unwrap();
        prop_assert!(overflows || error.abs() <= &eta * rounded.abs() + underflow / Exact::int(2));
        Ok(())
    });
}

/// Each operation may have decreased the result by the factor 1 − η; among subnormal numbers sums are exact
/// and no increase is needed. The increase is at most 24 η, unless the result is rounded more coarsely.
fn inflation_compensates_for_ten_roundings<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let normal = Tally::default();
    for_all(S::number(), |(x, exact)| {
        let before = x.magnitude();
        let exact = exact.abs();
        let bits = if S::FORMAT.bounded { S::FORMAT.bits } else { 64 };
        let eta = Exact::power_of_two(-bits.cast_signed());
        let after = before.clone().inflated();
        prop_assert_eq!(before.is_zero(), after.is_zero());
        prop_assert!(after >= before);
        if after.is_finite() {
            let after = after.to_exact().unwrap();
            let half_unit = N::min_subnormal().to_exact().unwrap() / Exact::int(2);
            prop_assert!(
                after <= before.to_exact().unwrap() * (Exact::one() + Exact::int(24) * &eta) + &half_unit
            );
            let is_normal = exact >= half_unit / &eta;
            if normal.count(is_normal) {
                let left = (0..10).fold(after, |x, _| x * (Exact::one() - &eta));
                prop_assert!(left >= exact, "{} of {}", left, exact);
            }
        }
        Ok(())
    });
    normal.assert_one_in(2, "normal numbers");
    let [zero, infinity] = [N::zero(), N::infinity()].map(N::inflated);
    assert!(zero.is_zero() && infinity == N::infinity());
}

fn exp_ln_and_ln_1p_are_correctly_rounded<S: Floats<Number = N>, N: Logarithm + Exponential + 'static>() {
    // Below η, where exp x rounds to 1, up to e^(2^11), beyond the range of f64.
    let bits = S::FORMAT.bits.cast_signed();
    let arguments = || floats(S::FORMAT.within(-bits - 8, 12));
    for_all(prop_oneof![arguments(), floats(S::FORMAT.within(-3000, 12))], |x| {
        let (result, float) = (S::float(&x).exp(), S::float(&x));
        prop_assert!(S::stands_for(&result, &rounds_as(S::FORMAT, &x, Float::exp_round)), "exp {float:?}");
        Ok(())
    });
    let around_one = arguments().prop_map(|x| S::FORMAT.round(&(Exact::one() + x.clamp(-half(), half()))));
    for_all(prop_oneof![floats(S::FORMAT), around_one], |x| {
        let x = if x.is_zero() { Exact::one() } else { x.abs() };
        let result = S::float(&x).ln();
        prop_assert!(S::stands_for(&result, &rounds_as(S::FORMAT, &x, Float::ln_round)), "ln of {x}");
        Ok(())
    });
    for_all(prop_oneof![floats(S::FORMAT), arguments()], |x| {
        let x = if x <= -Exact::one() { x.abs() } else { x };
        let result = S::float(&x).ln_1p();
        prop_assert!(S::stands_for(&result, &rounds_as(S::FORMAT, &x, Float::ln_1p_round)), "ln_1p of {x}");
        Ok(())
    });
}

/// Double rounding differs: a result close to the middle of two subnormal numbers can be rounded to the
/// middle first, and then to the wrong side.
#[test]
fn subnormal_exponentials_are_rounded_once() {
    fn law<S: Floats<Number = N>, N: Exponential>() {
        // From the smallest normal number's logarithm, 2^(least + bits − 1), to that of half the smallest number's.
        let (bits, least) = (f64::from(S::FORMAT.bits), f64::from(S::FORMAT.least));
        let subnormal = Tally::default();
        for i in 0..1000 {
            let power = least + bits - (bits + 2.0) * f64::from(i) / 1000.0;
            let x = S::FORMAT.round(&(power * std::f64::consts::LN_2).to_exact().unwrap());
            let exponential = rounds_as(S::FORMAT, &x, Float::exp_round);
            subnormal.count(magnitude(&exponential) < S::FORMAT.least + S::FORMAT.bits.cast_signed() - 1);
            let result = S::float(&x).exp();
            assert!(S::stands_for(&result, &exponential), "exp {x} gives {result:?}");
        }
        subnormal.assert_one_in(2, "subnormal numbers");
    }
    law::<Binary16, _>();
    law::<Brain16, _>();
    law::<Binary32, _>();
    law::<Binary64, _>();
}

fn half() -> Exact {
    Exact::power_of_two(-1)
}

#[test]
fn functions_are_exact_where_their_values_are_rational() {
    fn law<S: Floats<Number = N>, N: Logarithm + Exponential>() {
        let [zero, one] = [Exact::zero(), Exact::one()].map(|x| S::float(&x));
        assert_eq!((zero.exp(), one.ln(), zero.ln_1p()), (one.clone(), zero.clone(), zero));
    }
    law::<Binary32, _>();
    law::<Binary64, _>();
    law::<Mpfr2, _>();
    law::<Mpfr200, _>();
    let [zero, one] = [Mpfr::zero(), Mpfr::one()];
    assert_eq!((zero.exp(), one.ln(), zero.ln_1p()), (one.clone(), zero.clone(), zero));
}
