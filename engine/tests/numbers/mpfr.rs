//! Tests of floats with any precision.

use super::ball::Balls;
use super::draw::{Tally, for_all, fractions, pairs};
use super::format::Format;
use super::system::{Floats, Planted, System, operations, planted};
use num_traits::{One, Zero};
use proptest::prelude::*;
use provable::number::{
    Ball, Exact, Exponential, Field, Logarithm, Mpfr, PRECISIONS, PositivePart, Real, ToExact,
};
use rug::{Float, Rational};

/// MPFR numbers of one precision.
pub struct Bits<const BITS: u32>;
pub type Mpfr2 = Bits<2>;
pub type Mpfr3 = Bits<3>;
pub type Mpfr24 = Bits<24>;
pub type Mpfr53 = Bits<53>;
pub type Mpfr200 = Bits<200>;

impl<const BITS: u32> System for Bits<BITS> {
    type Number = Mpfr;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        pairs(Self::FORMAT).prop_map(planted::<Self>).boxed()
    }
    fn stands_for(result: &Mpfr, exact: &Exact) -> bool {
        result.precision() == Some(BITS) && MpfrMixed::stands_for(result, exact)
    }
}
impl<const BITS: u32> Floats for Bits<BITS> {
    const FORMAT: Format = Format::unbounded(BITS);

    fn float(x: &Exact) -> Mpfr {
        Mpfr::rounded(BITS, x.as_rational())
    }
}

/// MPFR numbers of all precisions mixed with constants.
pub struct MpfrMixed;

impl System for MpfrMixed {
    type Number = Mpfr;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let precision =
            || prop_oneof![Just(None), prop::sample::select(vec![2, 3, 24, 53, 200]).prop_map(Some)];
        let number = |x: Exact, precision, (p, q)| match precision {
            Some(bits) => {
                let x = Format::unbounded(bits).round(&x);
                (Mpfr::rounded(bits, x.as_rational()), x)
            }
            None => (Mpfr::int(p) / Mpfr::int(q), Rational::from((p, q)).into()),
        };
        (pairs(Format::unbounded(200)), precision(), precision(), fractions(), fractions())
            .prop_map(move |((a, b), pa, pb, qa, qb)| (number(a, pa, qa), number(b, pb, qb)))
            .boxed()
    }
    fn stands_for(result: &Mpfr, exact: &Exact) -> bool {
        let expected = match result.precision() {
            Some(bits) => Format::unbounded(bits).round(exact),
            None => exact.clone(),
        };
        result.to_exact() == Ok(expected)
    }
}

/// MPFR constants, which are exact until they meet a rounded number.
pub struct MpfrConstant;

impl System for MpfrConstant {
    type Number = Mpfr;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let constant = || {
            fractions().prop_map(|(p, q)| (Mpfr::int(p) / Mpfr::int(q), Exact::from(Rational::from((p, q)))))
        };
        (constant(), constant()).boxed()
    }
    fn stands_for(result: &Mpfr, exact: &Exact) -> bool {
        result.precision().is_none() && result.to_exact().as_ref() == Ok(exact)
    }
}

#[test]
fn results_have_the_larger_precision_of_their_operands() {
    let (first, second) = (Tally::default(), Tally::default());
    for_all(MpfrMixed::pair(), |((a, _), (b, _))| {
        let larger = a.precision().max(b.precision());
        first.count(a.precision() > b.precision());
        second.count(a.precision() < b.precision());
        for (name, operation) in operations::<Mpfr>() {
            for (a, b) in [(&a, &b), (&b, &a)] {
                // Constant by constant zero is refused, as a rational is.
                if name != "/" || b.is_invertible() {
                    prop_assert_eq!(operation(a, b).precision(), larger, "{}", name);
                }
            }
        }
        prop_assert_eq!((-&a).precision(), a.precision());
        prop_assert_eq!(a.abs().precision(), a.precision());
        let neighbours = (a.clone().next_up(), a.clone().next_down());
        prop_assert_eq!((neighbours.0.precision(), neighbours.1.precision()), (a.precision(), a.precision()));
        Ok(())
    });
    first.assert_one_in(20, "first operand more precise");
    second.assert_one_in(20, "second operand more precise");
}

#[test]
fn constants_may_exceed_the_range_of_i32() {
    let [least, most, one] = [i32::MIN, i32::MAX, 1].map(Mpfr::int);
    let beyond = Some(Rational::from(1_i64 << 31));
    for constant in [-&least, -least, &most + &one] {
        assert_eq!((constant.to_rational(), constant.precision()), (beyond.clone(), None));
        assert!(constant > most && constant - &one == most);
    }
}

/// Like machine floats.
#[test]
fn zero_is_written_without_a_sign() {
    let zero = Mpfr::rounded(10, 0);
    assert!((-&zero).as_float().is_some_and(Float::is_sign_negative));
    assert_eq!([&zero, &-&zero].map(Mpfr::to_string), ["0", "0"]);
}

/// A higher precision would not improve the bound, and would slow down every operation.
#[test]
fn radii_have_at_most_64_bits() {
    let ball = |x: &str| Ball::enclosing(&Mpfr::rounded(1000, 0), &x.parse().unwrap()).unwrap();
    let (a, b) = (ball("1/3"), ball("5/7"));
    for made in [&a + &b, &a - &b, &a * &b, &a / &b, -&a, a.exp(), a.min(&b), a.positive_part()] {
        assert!(made.radius().precision().is_some_and(|bits| bits <= 64), "{:?}", made.radius().precision());
    }
}

#[test]
fn precisions_from_2_to_a_million_bits_are_supported() {
    assert_eq!(PRECISIONS, 2..=1_000_000);
    for bits in [2, 1_000_000] {
        assert_eq!(Exact::one().to_mpfr(bits).precision(), Some(bits));
        assert_eq!(Mpfr::parse("1/3", bits).map(|x| x.precision()), Ok(Some(bits)));
    }
}

#[test]
#[should_panic = "a precision of 1 bits"]
fn a_precision_of_one_bit_panics() {
    Exact::one().to_mpfr(1);
}

#[test]
#[should_panic = "a precision of 1000001 bits"]
fn a_precision_above_a_million_bits_panics() {
    Exact::one().to_mpfr(1_000_001);
}

#[test]
#[should_panic = "exp of a constant"]
fn exp_of_a_constant_panics() {
    Mpfr::int(1).exp();
}

#[test]
#[should_panic = "ln of a constant"]
fn ln_of_a_constant_panics() {
    Mpfr::int(2).ln();
}

#[test]
#[should_panic = "ln_1p of a constant"]
fn ln_1p_of_a_constant_panics() {
    Mpfr::int(1).ln_1p();
}

/// Returns zero and ±m·2ᵉ, 4 ≤ m ≤ 7: all floats of 3 bits with these exponents.
pub fn all_of_three_bits(exponents: std::ops::RangeInclusive<i32>) -> Vec<Exact> {
    let positive = exponents.flat_map(|e| (4..8).map(move |m| Exact::int(m) * Exact::power_of_two(e)));
    let signed = positive.flat_map(|x| [-&x, x]);
    std::iter::once(Exact::zero()).chain(signed).collect()
}

#[test]
fn operations_on_3_bit_floats_are_correctly_rounded_and_enclosed() {
    let all = all_of_three_bits(-5..=3);
    for exact_a in &all {
        for exact_b in &all {
            let [a, b] = [exact_a, exact_b].map(Mpfr3::float);
            let (ball_a, ball_b) = (Ball::point(a.clone()), Ball::point(b.clone()));
            for (i, (name, exact)) in operations::<Exact>().into_iter().enumerate() {
                let (float, ball) = (operations()[i].1, operations()[i].1);
                if name == "/" && exact_b.is_zero() {
                    assert!(!ball(&ball_a, &ball_b).is_finite());
                    continue;
                }
                let (result, exact) = (float(&a, &b), exact(exact_a, exact_b));
                assert!(Mpfr3::stands_for(&result, &exact), "{exact_a} {name} {exact_b} = {result}");
                let ball = ball(&ball_a, &ball_b);
                assert_eq!(*ball.value(), result);
                assert!(Balls::<Mpfr3>::stands_for(&ball, &exact), "{exact_a} {name} {exact_b}: {ball:?}");
            }
        }
    }
}
