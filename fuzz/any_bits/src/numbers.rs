//! Properties of texts as numbers.

use crate::bytes::Bytes;
use num_traits::Zero;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, MAX_EXPONENT, Mpfr, NumberSystem, ParseError};
use spring_mass_contact::rug::ops::Pow;
use spring_mass_contact::rug::{Integer, Rational};
use spring_mass_contact::solver::ReadError;

/// Returns a text of arbitrary bytes, or of the characters of decimal or of hexadecimal numbers.
fn text(bytes: &mut Bytes) -> String {
    const DECIMAL: &[u8] = b"00123456789012345678901234567890123456789..//eE--+  _x\x00naif";
    const HEXADECIMAL: &[u8] = b"00123456789abcdefABCDEF0123456789abcdef...pP+-";
    if bytes.one_in(8) {
        return String::from_utf8_lossy(bytes.rest()).into_owned();
    }
    let (start, characters, mark) = if bytes.one_in(4) {
        (*bytes.pick(&["0x", "-0X", "+0x"]), HEXADECIMAL, 'p')
    } else {
        ("", DECIMAL, 'e')
    };
    let count = bytes.below(24);
    let mut text: String = start.to_string();
    text.extend((0..count).map(|_| char::from(*bytes.pick(characters))));
    // Else few would have an exponent that can be read.
    if bytes.one_in(2) {
        text += &format!("{mark}{}", bytes.bits() as i64 >> (16 + bytes.below(48)));
    }
    // More digits than any integer type has.
    if bytes.one_in(64) {
        text += &"9".repeat(bytes.below(64));
    }
    text
}

/// A number in decimal, scientific or hexadecimal notation: `mantissa · radix^exponent`.
struct Positional {
    mantissa: Exact,
    radix: i32,
    exponent: i64,
}

impl Positional {
    /// Returns the parts of a text; `None` if it is no such number.
    fn of(text: &str) -> Option<Self> {
        let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
        let is_hexadecimal = unsigned.get(..2).is_some_and(|start| start.eq_ignore_ascii_case("0x"));
        let (number, base, radix, marks) =
            if is_hexadecimal { (&unsigned[2..], 16, 2, ['p', 'P']) } else { (unsigned, 10, 10, ['e', 'E']) };
        let (digits, exponent) = number.split_once(marks).unwrap_or((number, "0"));
        let exponent = nearest_integer(exponent)?;
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        if whole.is_empty() && fraction.is_empty() {
            return None;
        }
        let mut mantissa = Exact::zero();
        for character in whole.chars().chain(fraction.chars()) {
            let digit = character.to_digit(base as u32)?;
            mantissa = mantissa * Exact::from(base) + Exact::from(digit as i32);
        }
        let mantissa = mantissa / power(base, fraction.len() as i64);
        Some(Positional {
            mantissa: if text.starts_with('-') { -mantissa } else { mantissa },
            radix,
            exponent,
        })
    }

    /// Returns `true` if this is the number x, which has an exponent that is allowed.
    fn is(&self, x: &Exact) -> bool {
        x * power(self.radix, -self.exponent) == &self.mantissa * power(self.radix, self.exponent)
    }
}

/// Returns the integer with these digits, or the nearest that fits.
fn nearest_integer(text: &str) -> Option<i64> {
    // Between digits, rug also accepts spaces and underscores.
    let is_integer = text.trim_start_matches(['+', '-']).bytes().all(|byte| byte.is_ascii_digit());
    let integer: Integer = if is_integer { text.parse().ok()? } else { return None };
    Some(integer.to_i64().unwrap_or(if integer < 0 { i64::MIN } else { i64::MAX }))
}

/// Returns a power; 1 for a negative exponent.
fn power(base: i32, exponent: i64) -> Exact {
    Exact::from(Rational::from(Integer::from(base).pow(exponent.max(0) as u32)))
}

/// Every notation is parsed exactly or rejected, for every number system.
pub fn parse(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let text = text(&mut bytes);
    let read = text.parse::<Exact>();
    let positional = Positional::of(&text);
    match &read {
        Ok(x) if text.contains('/') => {
            let (p, q) = text.split_once('/').expect("a fraction");
            let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            assert!(digits(p.trim_start_matches(['+', '-'])) && digits(q), "it is read");
            let [p, q] =
                [p, q].map(|text| Exact::from(Rational::from(text.parse::<Integer>().expect("digits"))));
            assert_eq!(x * q, p);
        }
        Ok(x) => {
            let positional = positional.expect("it is read");
            assert!(positional.exponent.abs() <= i64::from(MAX_EXPONENT));
            assert!(positional.is(x), "{x}");
        }
        Err(ParseError::Empty) => assert_eq!(text, ""),
        Err(ParseError::NotANumber) => assert!(positional.is_none(), "it is refused"),
        Err(ParseError::DivisionByZero) => assert!(text.trim_end_matches('0').ends_with('/')),
        Err(ParseError::Exponent) => {
            let exponent = positional.expect("a number").exponent;
            assert!(exponent.unsigned_abs() > u64::from(MAX_EXPONENT.unsigned_abs()));
        }
        Err(other) => panic!("{other:?}"),
    }
    let precision = 2 + bytes.below(63) as u32;
    assert_eq!(Mpfr::parse(&text, precision).map(drop), read.clone().map(drop));
    if let Ok(system) = text.parse::<NumberSystem>() {
        assert_eq!(system.to_string().parse(), Ok(system));
    }
    let texts = SpringMass { c: "1", m: "1", g: &*text, l: "1", h: "1" };
    match (texts.parse(), &read) {
        (Ok(system), Ok(x)) => assert_eq!(system.g, *x),
        (Err(ReadError::NotANumber { argument: "gravity", value, reason }), Err(error)) => {
            assert_eq!((&value, &reason), (&text, error));
        }
        (other, _) => panic!("{other:?}"),
    }
}
