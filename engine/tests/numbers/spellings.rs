//! Tests of parsing and formatting numbers.

use super::draw::{for_all, rationals};
use super::floats::{Binary32, Binary64};
use super::mpfr::MpfrMixed;
use super::system::System;
use num_traits::{One, Zero};
use proptest::prelude::*;
use provable::number::{Exact, Field, MAX_EXPONENT, Mpfr, ParseError, RangeError, Real, ToExact};
use rug::{Float, Integer, Rational};
use std::fmt::Display;

fn read(text: &str) -> Result<Exact, ParseError> {
    text.parse()
}

#[test]
fn every_notation_is_parsed_exactly() {
    let ratio = |p: i64, q: i64| Ok(Exact::from(Rational::from((p, q))));
    for (text, p, q) in [
        ("0", 0, 1),
        ("-0", 0, 1),
        ("0.000", 0, 1),
        ("0e5", 0, 1),
        ("7", 7, 1),
        ("+7", 7, 1),
        ("007", 7, 1),
        ("-3", -3, 1),
        ("9.81", 981, 100),
        ("-9.81", -981, 100),
        (".5", 1, 2),
        ("-.5", -1, 2),
        ("5.", 5, 1),
        ("0.1", 1, 10),
        ("1e3", 1000, 1),
        ("1E3", 1000, 1),
        ("1e+3", 1000, 1),
        ("1e-3", 1, 1000),
        ("1e0003", 1000, 1),
        ("1e0", 1, 1),
        ("1e-0", 1, 1),
        ("2.50e1", 25, 1),
        ("-2.5e-1", -1, 4),
        (".5e1", 5, 1),
        ("5.e1", 50, 1),
        ("1/2", 1, 2),
        ("-1/2", -1, 2),
        ("+6/4", 3, 2),
        ("0/5", 0, 1),
        ("0x1.8p-3", 3, 16),
        ("-0x1p+4", -16, 1),
        ("0X1.FP2", 31, 4),
        ("0x1.999999999999ap-4", 0xc_cccc_cccc_cccd, 1 << 55),
        ("0xap-0", 10, 1),
        ("0x.8", 1, 2),
        ("0x1e5", 0x1e5, 1),
        ("9007199254740993", 9_007_199_254_740_993, 1),
        ("0.30000000000000004", 30_000_000_000_000_004, 100_000_000_000_000_000),
    ] {
        assert_eq!(read(text), ratio(p, q), "{text}");
    }
}

#[test]
fn texts_that_are_not_numbers_are_rejected() {
    for text in [
        "NaN", "nan", "inf", "-inf", "Infinity", "1e", "1e+", "1e-", "e5", "e", ".", "-.", "+", "-", "--1",
        "+-1", "-+1", "1-", "1_000", "1,5", "1 000", " 1", "1 ", "\t1", "1\n", " ", "0x", "0b1", "1f",
        "1.5.2", "1..2", "1e5.5", "1e5e5", "1e--5", "1e 5", ".e5", "1/2/3", "1.5/2", "1/2.5", "1e5/2",
        "1/1e5", "/2", "1/", "/", "1/-2", "-1/-2", "1/+2", "1 / 2", "½", "١", "１", "−1", "1\0", "x1", "one",
        "0x.", "0xp1", "0x1p", "0x1p-", "0x1pa", "0x1p1.0", "0x1p1p1", "0x1.8.1", "0xg", "0x-1", "x1p1",
        "1p3", "0x1/2", "1/0x2", "0x 1", "0x1 p1", "0x1_0",
    ] {
        assert_eq!(read(text), Err(ParseError::NotANumber), "{text:?}");
        assert_eq!(Mpfr::parse(text, 53), Err(ParseError::NotANumber), "{text:?}");
    }
    assert_eq!(read(""), Err(ParseError::Empty));
    for text in ["1/0", "0/0", "-1/0", "1/000"] {
        assert_eq!(read(text), Err(ParseError::DivisionByZero), "{text:?}");
    }
}

/// Returns immediately for any exponent, since a number with 10¹² digits would take too long.
#[test]
fn an_invalid_mantissa_is_reported_before_the_exponent() {
    for text in ["heavye99999999999", "1_0e-4294967296", "e100001", "1.2.3e99999999999", "0xgp99999999999"] {
        assert_eq!(read(text), Err(ParseError::NotANumber), "{text}");
    }
}

#[test]
fn exponents_beyond_100_000_are_rejected_before_allocation() {
    assert_eq!(MAX_EXPONENT, 100_000);
    let endless = format!("1e{}", "9".repeat(10_000));
    for text in [
        "1e100001",
        "1e-100001",
        "0e100001",
        "1.5e+100001",
        "1e999999999999",
        "-1e-999999999999",
        "0x1p100001",
        "0x0p-100001",
        &endless,
    ] {
        assert_eq!(read(text), Err(ParseError::Exponent), "{text:.20}");
        assert_eq!(Mpfr::parse(text, 2), Err(ParseError::Exponent), "{text:.20}");
    }
    let large = Exact::from(Rational::from(Integer::from(Integer::u_pow_u(10, 100_000))));
    assert_eq!(read("1e100000").as_ref(), Ok(&large));
    assert_eq!(read("-1e-000100000"), Ok(-Exact::one() / large));
    assert_eq!(read("0x1p-100000"), Ok(Exact::power_of_two(-100_000)));
}

#[test]
fn numbers_out_of_range_are_rejected_instead_of_rounded_to_inf_or_zero() {
    let to_f32 = |text| read(text).and_then(|x| Ok(x.to_f32()?));
    let to_f64 = |text| read(text).and_then(|x| Ok(x.to_f64()?));
    fn overflow<F>(scalar: &'static str) -> Result<F, ParseError> {
        Err(RangeError::Overflow { scalar }.into())
    }
    fn underflow<F>(scalar: &'static str) -> Result<F, ParseError> {
        Err(RangeError::Underflow { scalar }.into())
    }
    for text in ["1e39", "-1e39", "3.4028236e38", "1e100000"] {
        assert_eq!(to_f32(text), overflow("f32"), "{text}");
    }
    for text in ["1e309", "-1.8e308", "1e100000"] {
        assert_eq!(to_f64(text), overflow("f64"), "{text}");
    }
    for text in ["7e-46", "-7e-46", "1e-100000"] {
        assert_eq!(to_f32(text), underflow("f32"), "{text}");
    }
    for text in ["2e-324", "-2e-324", "1e-100000"] {
        assert_eq!(to_f64(text), underflow("f64"), "{text}");
    }
    assert_eq!((to_f32("0e-5"), to_f64("-0.0")), (Ok(0.0), Ok(0.0)));
}

/// The standard library also parses decimals with correct rounding.
#[test]
fn decimals_are_rounded_as_by_the_standard_library() {
    let decimal =
        (any::<bool>(), any::<u64>(), 0usize..20, -340..310).prop_map(|(negative, digits, point, e)| {
            let mut text = format!("{digits:020}");
            text.insert(point, '.');
            format!("{}{text}e{e}", if negative { "-" } else { "" })
        });
    for_all(decimal, |text| {
        let (exact, double) = (read(&text).unwrap(), text.parse::<f64>().unwrap());
        let in_range = double.is_finite() && double != 0.0;
        prop_assert!(in_range || exact.is_zero() || exact.to_f64().is_err());
        prop_assert!(!in_range || exact.to_f64() == Ok(double));
        let single = text.parse::<f32>().unwrap();
        let in_range = single.is_finite() && single != 0.0;
        prop_assert!(!in_range || exact.to_f32() == Ok(single));
        Ok(())
    });
}

#[test]
fn formatted_numbers_parse_to_the_same_number() {
    for_all((Binary32::number(), Binary64::number(), rationals()), |((single, _), (double, _), exact)| {
        for text in [format!("{single}"), format!("{single:e}"), format!("{single:?}")] {
            prop_assert_eq!(read(&text).map(|x| x.to_f32()), Ok(Ok(single)), "{}", text);
        }
        for text in [format!("{double}"), format!("{double:e}"), format!("{double:?}")] {
            prop_assert_eq!(read(&text).map(|x| x.to_f64()), Ok(Ok(double)), "{}", text);
        }
        prop_assert_eq!(read(&exact.to_string()), Ok(exact));
        Ok(())
    });
    for_all(MpfrMixed::number(), |(x, _)| {
        let text = x.to_string();
        let read = match x.precision() {
            Some(bits) => Mpfr::parse(&text, bits).unwrap().to_exact(),
            None => Ok(read(&text).unwrap()),
        };
        prop_assert_eq!(read, x.to_exact(), "{}", text);
        Ok(())
    });
}

#[test]
fn mpfr_numbers_round_trip_within_the_exponent_limit() {
    for text in ["1.5e99999", "-1.5e99999", "1.5e-99999", "-3.25e-99999"] {
        for bits in [2, 53, 200] {
            let x = Mpfr::parse(text, bits).unwrap();
            assert_eq!(Mpfr::parse(&x.to_string(), bits).unwrap(), x, "{x}");
        }
    }
    // 2^400000 has 120412 digits; its text is short.
    let beyond = Mpfr::rounded(53, Float::with_val(53, 1) << 400_000);
    assert!(beyond.to_string().ends_with("e120411") && beyond.to_string().len() < 30);
    assert_eq!(Mpfr::parse(&beyond.to_string(), 53), Err(ParseError::Exponent));
}

/// `format!` supports the same options for MPFR numbers as for f64.
#[test]
fn mpfr_numbers_are_padded_and_signed_like_floats() {
    fn shown(x: impl Display) -> [String; 8] {
        [
            format!("{x}"),
            format!("{x:+}"),
            format!("{x:12}|"),
            format!("{x:<12}|"),
            format!("{x:^12}|"),
            format!("{x:>12}|"),
            format!("{x:*>+12}|"),
            format!("{x:012}|"),
        ]
    }
    for x in [0.0, 1.0, -1.0, 1.5, -12.25, 1234.5, -1e6] {
        assert_eq!(shown(Mpfr::rounded(53, x)), shown(x), "{x}");
        assert_eq!(shown(Mpfr::rounded(200, x)), shown(x), "{x}");
    }
    for x in [0, 1, -1, 1234] {
        assert_eq!(shown(Mpfr::int(x)), shown(x), "{x}");
    }
    // Scientific, where the digits would begin or end with zeros; still padded.
    let small = Mpfr::rounded(53, -0.25);
    assert_eq!(shown(&small)[2..5], ["     -2.5e-1|", "-2.5e-1     |", "  -2.5e-1   |"]);
    assert_eq!(format!("{:e<8}|{:<+8}|", Mpfr::infinity(), Mpfr::infinity()), "infeeeee|+inf    |");
}

/// Ties go to the even digit, like in f64.
#[test]
fn formatting_with_a_precision_agrees_with_f64() {
    fn shown(x: impl Display + std::fmt::Debug) -> [String; 9] {
        [
            format!("{x:.0}"),
            format!("{x:.1}"),
            format!("{x:.2}"),
            format!("{x:.5}"),
            format!("{x:.40}"),
            format!("{x:+012.3}|"),
            format!("{x:*<12.3}|"),
            format!("{x:>12.3}|"),
            format!("{x:.3?}|"),
        ]
    }
    let ties = [0.5, 1.5, 2.5, -2.5, -3.5, 0.25, 0.75, 0.125, 0.375, 1.0625, -0.03125];
    let others = [0.0, 1.0, -1.0, 9.81, 1.05, 0.1, -0.05, 999.999, -0.999_999, 1e-9, 1e22, 1e300, 5e-324];
    for x in ties.into_iter().chain(others) {
        assert_eq!(shown(Mpfr::rounded(53, x)), shown(x), "{x}");
        assert_eq!(shown(Mpfr::rounded(200, x)), shown(x), "{x}");
        assert_eq!(shown(Mpfr::constant(Rational::from_f64(x).unwrap())), shown(x), "{x}");
        assert_eq!(shown(Exact::try_from(x).unwrap()), shown(x), "{x}");
    }
    for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(shown(Mpfr::rounded(53, x)), shown(x), "{x}");
    }
    // Next to nothing has nothing to show, and is found out without writing it down.
    let tiny = Mpfr::rounded(53, Float::with_val(53, 1) >> 1_000_000_000);
    assert_eq!([format!("{tiny:.2}"), format!("{:.2}", -tiny)], ["0.00", "-0.00"]);
    // Beyond what any f64 holds: 1/3 in 200 bits is off in the 61st digit.
    let third = Mpfr::rounded(200, 1) / Mpfr::int(3);
    assert_eq!(format!("{third:.60}"), format!("0.{}", "3".repeat(60)));
}

/// Texts of the characters of numbers, most of which are numbers or nearly so, and any others.
fn any_text() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "[-+]?[0-9]{0,6}[.]?[0-9]{0,6}([eE][-+]?[0-9]{1,7})?",
        2 => "[-+]?0[xX][0-9a-fA-F]{0,6}[.]?[0-9a-fA-F]{0,6}([pP][-+]?[0-9]{1,7})?",
        1 => "[-+]?[0-9]{1,9}/[-+]?[0-9]{1,9}",
        1 => "[0-9./eExXpP+ _-]{0,12}",
        1 => "\\PC{0,12}",
    ]
}

/// Returns the digits of a number without a point, its exponent with their number behind the point, and its bases
/// of digits and exponent; `None` if it is no number.
fn parts(text: &str) -> Option<(Integer, i64, [i32; 2])> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let hexadecimal = unsigned.strip_prefix("0x").or(unsigned.strip_prefix("0X"));
    let (number, marks, bases) =
        hexadecimal.map_or((unsigned, ['e', 'E'], [10, 10]), |x| (x, ['p', 'P'], [16, 2]));
    let (mantissa, exponent) = number.split_once(marks).unwrap_or((number, "0"));
    let size = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    let is_number = |text: &str, base: i32| !text.is_empty() && text.chars().all(|c| c.is_digit(base as u32));
    if !is_number(&digits, bases[0]) || !is_number(size, 10) {
        return None;
    }
    let per_digit = if bases[0] == 16 { 4 } else { 1 };
    let exponent: i64 = exponent.parse().unwrap_or(i64::MAX / 2);
    let digits = Integer::from_str_radix(&digits, bases[0]).expect("digits");
    Some((
        if text.starts_with('-') { -digits } else { digits },
        exponent,
        [per_digit * fraction.len() as i32, bases[1]],
    ))
}

/// Every text is parsed exactly, or refused for its reason.
#[test]
fn any_text_is_a_number_or_refused() {
    let power = |base: i32, n: i64| {
        Exact::from(Rational::from(Integer::from(Integer::i_pow_u(base, n.max(0) as u32))))
    };
    for_all(any_text(), |text| {
        let number = read(&text);
        prop_assert_eq!(Mpfr::parse(&text, 53).map(drop), number.clone().map(drop));
        match (number, parts(&text)) {
            (Ok(x), Some((digits, exponent, [behind, base]))) => {
                prop_assert!(exponent.abs() <= i64::from(MAX_EXPONENT));
                let exponent = exponent - i64::from(behind);
                let digits = Exact::from(Rational::from(digits));
                prop_assert_eq!(x * power(base, -exponent), digits * power(base, exponent));
            }
            (Ok(x), None) => {
                let (p, q) = text.split_once('/').expect("a fraction");
                let [p, q] =
                    [p, q].map(|text| text.strip_prefix('+').unwrap_or(text).parse::<Integer>().unwrap());
                prop_assert_eq!(x * Exact::from(Rational::from(q)), Exact::from(Rational::from(p)));
            }
            (Err(ParseError::Exponent), Some((_, exponent, _))) => {
                prop_assert!(exponent.abs() > i64::from(MAX_EXPONENT));
            }
            (Err(ParseError::NotANumber | ParseError::Empty), parts) => prop_assert_eq!(parts, None),
            (Err(ParseError::DivisionByZero), _) => prop_assert!(text.trim_end_matches('0').ends_with('/')),
            other => prop_assert!(false, "{:?}", other),
        }
        Ok(())
    });
}
