//! Tests of rationals and their conversion to floats.

use super::draw::{Tally, floats, for_all, rationals};
use super::format::{DOUBLE, Format, SINGLE};
use super::system::{Planted, System};
use num_traits::{One, Zero};
use proptest::prelude::*;
use provable::number::{Exact, Field, Mpfr, NonFiniteError, PositivePart, RangeError, Real, ToExact};
use rug::{Float, Integer, Rational};
use std::fmt::Debug;

pub struct Rationals;

impl System for Rationals {
    type Number = Exact;
    /// An independent representation, so that `Exact` is not compared with itself.
    type Meaning = Fraction;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let planted = |x: Exact| {
            let (p, q) = Rational::from(x.clone()).into_numer_denom();
            (x, Fraction(p, q))
        };
        (rationals(), rationals()).prop_map(move |(a, b)| (planted(a), planted(b))).boxed()
    }
    fn stands_for(result: &Exact, exact: &Fraction) -> bool {
        let q = result.as_rational();
        Fraction(q.numer().clone(), q.denom().clone()) == *exact
    }
}

/// A rational number as two integers, the second not 0, never reduced.
#[derive(Clone, Debug)]
pub struct Fraction(pub Integer, pub Integer);

provable::operators! { [] Fraction;
    Add add |a, b| Fraction(Integer::from(&a.0 * &b.1) + Integer::from(&b.0 * &a.1), Integer::from(&a.1 * &b.1));
    Sub sub |a, b| Fraction(Integer::from(&a.0 * &b.1) - Integer::from(&b.0 * &a.1), Integer::from(&a.1 * &b.1));
    Mul mul |a, b| Fraction(Integer::from(&a.0 * &b.0), Integer::from(&a.1 * &b.1));
    Div div |a, b| Fraction(Integer::from(&a.0 * &b.1), Integer::from(&a.1 * &b.0));
    - |a| Fraction(Integer::from(-&a.0), a.1.clone())
}
impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        Integer::from(&self.0 * &other.1) == Integer::from(&other.0 * &self.1)
    }
}
impl Zero for Fraction {
    fn zero() -> Self {
        Fraction::int(0)
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
impl One for Fraction {
    fn one() -> Self {
        Fraction::int(1)
    }
}
impl Field for Fraction {
    fn int(n: i32) -> Self {
        Fraction(n.into(), 1.into())
    }
}

/// Returns the expected result of a conversion, including errors.
fn converted(x: &Exact, format: Format, scalar: &'static str) -> Result<Exact, RangeError> {
    let nearest = format.round(x);
    if nearest.abs() > format.largest() {
        Err(RangeError::Overflow { scalar })
    } else if nearest.is_zero() && !x.is_zero() {
        Err(RangeError::Underflow { scalar })
    } else {
        Ok(nearest)
    }
}

#[test]
fn rationals_are_rounded_once_to_the_nearest_float_or_rejected() {
    // Numbers with a few more bits than the format, half of them ties, from below the smallest subnormal to
    // beyond the largest float.
    let wide = |f: Format| Format { least: f.least - 3, greatest: f.greatest + 8, bits: f.bits + 1, ..f };
    let drawn = |f| prop_oneof![3 => floats(wide(f)), 1 => floats(f).prop_map(|x| x / Exact::int(3)), 1 => rationals()];
    let refused = Tally::default();
    for_all(drawn(SINGLE), |x| {
        let result = x.to_f32();
        refused.count(result.is_err());
        prop_assert_eq!(result.map(|y| y.to_exact().unwrap()), converted(&x, SINGLE, "f32"));
        Ok(())
    });
    for_all(drawn(DOUBLE), |x| {
        let result = x.to_f64();
        refused.count(result.is_err());
        prop_assert_eq!(result.map(|y| y.to_exact().unwrap()), converted(&x, DOUBLE, "f64"));
        // By way of other digits than f64 has, rounded or not.
        for y in [x.to_mpfr(60), Mpfr::constant(x.as_rational().clone())] {
            let result = y.to_f64().map(|y| y.to_exact().unwrap());
            prop_assert_eq!(result, converted(&y.to_exact().unwrap(), DOUBLE, "f64"));
        }
        Ok(())
    });
    refused.assert_one_in(100, "refused");
    for_all((rationals(), floats(Format::unbounded(54)), 2u32..=53), |(x, tie, bits)| {
        for x in [x, tie] {
            let result = x.to_mpfr(bits);
            prop_assert_eq!(result.precision(), Some(bits));
            prop_assert_eq!(result.to_exact(), Ok(Format::unbounded(bits).round(&x)));
        }
        Ok(())
    });
}

#[test]
fn overflow_and_underflow_begin_at_the_rounding_thresholds() {
    fn edges<F: Copy + PartialEq + Debug>(
        format: Format,
        convert: fn(&Exact) -> Result<F, RangeError>,
        [largest, smallest]: [F; 2],
        scalar: &'static str,
    ) {
        let unit = Exact::power_of_two(format.greatest);
        let beyond = format.largest() + &unit / Exact::int(2);
        let tiny = &unit / Exact::power_of_two(2000);
        assert_eq!(convert(&(&beyond - &tiny)), Ok(largest));
        assert_eq!(convert(&beyond), Err(RangeError::Overflow { scalar }));
        assert_eq!(convert(&-&beyond), Err(RangeError::Overflow { scalar }));
        let least = Exact::power_of_two(format.least);
        let below = &least / Exact::int(2);
        let tiny = &least / Exact::power_of_two(2000);
        assert_eq!(convert(&least), Ok(smallest));
        assert_eq!(convert(&(&below + &tiny)), Ok(smallest));
        assert_eq!(convert(&below), Err(RangeError::Underflow { scalar }));
        assert_eq!(convert(&-below), Err(RangeError::Underflow { scalar }));
        assert_eq!(convert(&tiny), Err(RangeError::Underflow { scalar }));
    }
    edges(SINGLE, Exact::to_f32, [f32::MAX, f32::from_bits(1)], "f32");
    edges(DOUBLE, Exact::to_f64, [f64::MAX, f64::from_bits(1)], "f64");
    // Enough bits for what is drawn next to an edge.
    edges(DOUBLE, |x| x.to_mpfr(4000).to_f64(), [f64::MAX, f64::from_bits(1)], "f64");
    let far = |shift: i32| Mpfr::rounded(53, Float::with_val(53, 1) << shift).to_f64();
    assert_eq!(far(1_000_000_000), Err(RangeError::Overflow { scalar: "f64" }));
    assert_eq!(far(-1_000_000_000), Err(RangeError::Underflow { scalar: "f64" }));
    assert_eq!(Exact::zero().to_f32().map(f32::to_bits), Ok(0));
    assert_eq!(Exact::zero().to_f64().map(f64::to_bits), Ok(0));
}

#[test]
fn the_bits_of_both_integers_are_counted() {
    for (fraction, digits) in [("-5/16", 3 + 5), ("0", 1), ("1023", 10 + 1), ("1/1024", 1 + 11)] {
        assert_eq!(fraction.parse::<Exact>().unwrap().bit_length(), digits, "{fraction}");
    }
}

#[test]
fn rounding_to_0_bits_returns_none() {
    for x in ["1/3", "0"].map(|x| x.parse::<Exact>().unwrap()) {
        assert_eq!((x.round_to_bits(0), x.round_to_bits(1).is_some()), (None, true));
    }
}

#[test]
fn non_finite_floats_have_no_exact_value() {
    let none =
        [NonFiniteError::Infinity, NonFiniteError::NegativeInfinity, NonFiniteError::NotANumber].map(Err);
    assert_eq!([f32::INFINITY, f32::NEG_INFINITY, f32::NAN].map(|x| x.to_exact()), none);
    let floats = [f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    assert_eq!(floats.map(|x| x.to_exact()), none);
    let endless = [Mpfr::infinity(), -Mpfr::infinity(), Mpfr::infinity() - Mpfr::infinity()];
    assert_eq!(endless.each_ref().map(|x| x.to_exact()), none);
    // The error says which number it was, and a float of the machine stays what it is.
    for (x, endless) in floats.into_iter().zip(endless) {
        assert!(Exact::try_from(x).unwrap_err().to_string().starts_with(&format!("{x} ")));
        assert_eq!(
            endless.to_f64().map(|y| (y.is_nan(), y.is_sign_negative() && !y.is_nan())).ok(),
            Some((x.is_nan(), x < 0.0))
        );
    }
}

#[test]
fn integers_and_finite_floats_are_converted_exactly() {
    assert_eq!(Exact::from(i64::MIN).to_string(), "-9223372036854775808");
    assert_eq!(Exact::from(u64::MAX).to_string(), "18446744073709551615");
    assert_eq!(Exact::from(u32::MAX), Exact::from(u64::from(u32::MAX)));
    assert_eq!(Exact::from(i32::MIN), Exact::from(i64::from(i32::MIN)));
    // 2⁻² + 2⁻⁵⁴ and so on: the float next to a quarter, and not the quarter.
    assert_eq!(
        Exact::try_from(0.25_f64.next_up()),
        Ok("1/4".parse::<Exact>().unwrap() + Exact::power_of_two(-54))
    );
    assert_eq!(
        Exact::try_from(0.25_f32.next_up()),
        Ok("1/4".parse::<Exact>().unwrap() + Exact::power_of_two(-25))
    );
    assert_eq!(Exact::try_from(-0.0), Ok(Exact::zero()));
}
