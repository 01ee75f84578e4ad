//! Numbers as text: with nothing lost, or as decimals on the side that is asked for.

use super::{Exact, Mpfr, ToExact};
use crate::number::Real;
use num_traits::Zero;
use rug::{Float, Integer, Rational, float::Round, ops::Pow};

/// Numbers that are written down with nothing lost, and bounds that hold as they are written.
pub trait Text: ToExact + Clone {
    /// All of it: the shortest text that reads back as the same float, or a fraction.
    ///
    /// ```
    /// # use provable::number::Text;
    /// assert_eq!([1e300, 0.1, -0.0].map(|x: f64| x.text()), ["1e300", "0.1", "0"]);
    /// ```
    fn text(&self) -> String;

    /// Returns [`text`](Self::text) with the sign of a zero, where the number system has zeros of two signs.
    ///
    /// ```
    /// # use provable::number::Text;
    /// assert_eq!([-0.0, 0.0, -0.1].map(|x: f64| x.signed_text()), ["-0", "0", "-0.1"]);
    /// ```
    fn signed_text(&self) -> String {
        self.text()
    }

    /// The numbers next to this one, the smaller first; a rational has none and gives itself.
    fn neighbours(&self) -> [Self; 2];

    /// A text that spells a number no greater than this one, or no less if the rounding is up: its own or
    /// that of a number near it, since the shortest decimal of a float can lie on either side of the float.
    /// An infinity and not-a-number are bounded by nothing else.
    ///
    /// # Panics
    /// The rounding is neither up nor down.
    fn bound(&self, round: Round) -> String {
        let Ok(end) = self.to_exact() else { return self.text() };
        let mut near = self.clone();
        loop {
            let text = near.text();
            if is_bound(&text, &end, round) {
                return text;
            }
            let [below, above] = near.neighbours();
            near = if round == Round::Up { above } else { below };
        }
    }
}

/// Does the text spell a number on this side of the end, or the end itself?
fn is_bound(text: &str, end: &Exact, round: Round) -> bool {
    let Ok(decimal) = Float::parse(text) else { return true }; // a fraction, which is the end itself
    // The end is a float of so many bits, so no rounding towards it can step over it.
    let bits = end.as_rational().numer().significant_bits().max(2);
    match round {
        Round::Down => Float::with_val_round(bits, decimal, Round::Up).0 <= *end.as_rational(),
        Round::Up => Float::with_val_round(bits, decimal, Round::Down).0 >= *end.as_rational(),
        other => panic!("{other:?} is no side"),
    }
}

macro_rules! machine {
    ($($float:ty),*) => {$(
        impl Text for $float {
            fn text(&self) -> String {
                // Debug turns to powers of ten where Display writes hundreds of zeros; no sign for a zero.
                let mut text = format!("{:?}", if self.is_zero() { 0.0 } else { *self });
                text.truncate(text.strip_suffix(".0").map_or(text.len(), str::len));
                text
            }
            fn signed_text(&self) -> String {
                if self.is_zero() && self.is_sign_negative() { "-0".to_string() } else { self.text() }
            }
            fn neighbours(&self) -> [Self; 2] {
                [Real::next_down(*self), Real::next_up(*self)]
            }
        }
    )*};
}
machine!(f32, f64);

impl Text for Mpfr {
    fn text(&self) -> String {
        self.to_string()
    }
    fn neighbours(&self) -> [Self; 2] {
        [self.clone().next_down(), self.clone().next_up()]
    }
}

impl Text for Exact {
    fn text(&self) -> String {
        self.to_string()
    }
    fn neighbours(&self) -> [Self; 2] {
        [self.clone(), self.clone()]
    }
}

/// The nearest whole number, of two the even one.
pub(super) fn to_whole(x: Rational) -> Integer {
    let (off, nearest) = x.fract_round(Integer::new());
    // rug rounds a tie away from zero.
    if *off.denom() == 2 && nearest.is_odd() { nearest + off.numer() } else { nearest }
}

/// The size of a number with so many decimals; `units` says which multiple of 1/unit is nearest to it.
pub(super) fn fixed(decimals: usize, units: impl FnOnce(&Integer) -> Integer) -> String {
    let unit = Integer::from(10).pow(decimals as u32);
    let digits = format!("{:0>1$}", units(&unit).abs().to_string(), decimals + 1);
    let (whole, fraction) = digits.split_at(digits.len() - decimals);
    if decimals == 0 { whole.to_string() } else { format!("{whole}.{fraction}") }
}

impl Exact {
    /// As a decimal of at most so many digits, on the side that the rounding says; directed, it can be one
    /// unit further than need be, but for what has so few digits.
    ///
    /// ```
    /// # use provable::{number::Exact, rug::float::Round};
    /// let third: Exact = "1/3".parse()?;
    /// assert_eq!([Round::Down, Round::Up].map(|side| third.decimal(3, side)), ["0.333", "0.334"]);
    /// # Ok::<(), provable::number::ParseError>(())
    /// ```
    pub fn decimal(&self, digits: usize, round: Round) -> String {
        if self.is_zero() {
            return "0".to_string();
        }
        if round != Round::Nearest {
            let nearest = self.decimal(digits, Round::Nearest);
            if nearest.parse().as_ref() == Ok(self) {
                return nearest;
            }
        }
        // Four bits hold a decimal digit; both roundings go the same way.
        let x = Float::with_val_round(4 * digits as u32 + 16, self.as_rational(), round).0;
        let (negative, text, exponent) = x.to_sign_string_exp_round(10, Some(digits), round);
        let sign = if negative { "-" } else { "" };
        let text = text.trim_end_matches('0');
        // The number is 0.text × 10^exponent.
        let exponent = exponent.expect("not zero");
        match usize::try_from(exponent) {
            Ok(0) | Err(_) if exponent > -4 => {
                format!("{sign}0.{}{text}", "0".repeat(exponent.unsigned_abs() as usize))
            }
            Ok(whole @ 1..) if whole < text.len() => format!("{sign}{}.{}", &text[..whole], &text[whole..]),
            Ok(whole @ 1..) if whole <= digits => format!("{sign}{text:0<whole$}"),
            _ => {
                let (first, rest) = text.split_at(1);
                let point = if rest.is_empty() { "" } else { "." };
                format!("{sign}{first}{point}{rest}e{}", exponent - 1)
            }
        }
    }

    /// As a decimal of at most so many digits, and of no more characters than fit if fewer digits can help.
    pub fn decimal_within(&self, digits: usize, width: usize) -> String {
        let decimal = |digits| self.decimal(digits, Round::Nearest);
        let mut shorter = (1..=digits).rev().map(decimal).filter(|text| text.chars().count() <= width);
        shorter.next().unwrap_or_else(|| decimal(1))
    }
}

/// Types that are serialised as they are displayed.
#[cfg(feature = "serde")]
#[doc(hidden)]
#[macro_export]
macro_rules! serialize_as_displayed {
    ($($Type:ty),*) => {$(
        impl serde::Serialize for $Type {
            fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                to.collect_str(self)
            }
        }
    )*};
}
#[cfg(feature = "serde")]
serialize_as_displayed!(Exact, super::NumberSystem);

/// Quantities are serialised as texts, so that no reader rounds them.
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod quantity {
    use super::Text;
    use serde::{Serialize, Serializer};

    pub fn serialize<T: Text, S: Serializer>(x: &T, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&x.text())
    }

    pub fn option<T: Text, S: Serializer>(x: &Option<T>, to: S) -> Result<S::Ok, S::Error> {
        x.as_ref().map(Text::text).serialize(to)
    }

    pub fn options<T: Text, S: Serializer>(x: &[Option<T>; 2], to: S) -> Result<S::Ok, S::Error> {
        x.each_ref().map(|x| x.as_ref().map(Text::text)).serialize(to)
    }
}

/// Quantities that are read back, too: the same bits for f32 and f64, the sign of a zero included, the same
/// number for rationals. A float of MPFR comes back as the constant of the same value, since a text has no
/// precision; `to_mpfr` rounds it.
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod lossless {
    use super::{Exact, Text};
    use crate::number::ParseError;
    use num_traits::Zero;
    use serde::{Deserialize, Deserializer, Serializer, de::Error};
    use std::ops::Neg;

    pub fn serialize<T: Text, S: Serializer>(x: &T, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&x.signed_text())
    }

    pub fn deserialize<'de, T, D>(from: D) -> Result<T, D::Error>
    where
        T: Text + Zero + Neg<Output = T>,
        D: Deserializer<'de>,
    {
        let text = String::deserialize(from)?;
        read(&text).map_err(|error| {
            let shown: String = text.chars().take(40).collect();
            D::Error::custom(format!("'{}': {error}", shown.escape_debug()))
        })
    }

    fn read<T: Text + Zero + Neg<Output = T>>(text: &str) -> Result<T, ParseError> {
        let x = T::zero().nearest(&text.parse::<Exact>()?)?;
        Ok(if x.is_zero() && text.starts_with('-') { -x } else { x })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bounds of a solve have room to spare, which hides a text on the wrong side; a point has none.
    fn encloses<T: Text>(point: &T) -> bool {
        let [lower, upper] = [Round::Down, Round::Up].map(|side| point.bound(side).parse::<Exact>().unwrap());
        // And no further away than the neighbour's text has to be.
        let exact = |x: &T| x.to_exact().unwrap();
        let [below, above] = point.neighbours();
        let ([below, _], [_, above]) = (below.neighbours(), above.neighbours());
        let point = exact(point);
        lower <= point && point <= upper && exact(&below) <= lower && upper <= exact(&above)
    }

    #[test]
    fn ends_hold_as_written() {
        for number in ["1/3", "-2/3", "1e-9", "123456.789", "0.1", "-1.1e38", "1e-45", "0", "7"] {
            let x: Exact = number.parse().unwrap();
            assert!(encloses(&x) && encloses(&x.to_f32().unwrap()) && encloses(&x.to_f64().unwrap()), "{x}");
            if !x.is_zero() {
                assert!([2, 3, 24, 53, 200].into_iter().all(|bits| encloses(&x.to_mpfr(bits))), "{x}");
            }
        }
    }

    #[test]
    fn decimals_stay_on_their_side() {
        for (fraction, down, up) in [
            ("1/3", "0.333", "0.334"),
            ("-2/3", "-0.667", "-0.666"),
            ("1/3000000", "3.33e-7", "3.34e-7"),
            ("999999", "9.99e5", "1e6"),
            ("20/3", "6.66", "6.67"),
            ("100", "100", "100"),
            ("123", "123", "123"),
            ("1000", "1e3", "1e3"),
            ("49/10", "4.9", "4.9"),
            ("4900000000000", "4.9e12", "4.9e12"),
            ("0", "0", "0"),
        ] {
            let x: Exact = fraction.parse().unwrap();
            assert_eq!([x.decimal(3, Round::Down), x.decimal(3, Round::Up)], [down, up], "{fraction}");
        }
    }

    /// ±(1/2 ± 10⁻³⁰) lies so close to a decimal that rounding to nearest, before the rounding to a side or
    /// in place of it, gives the decimal itself.
    #[test]
    fn decimals_next_to_a_shorter_one_stay_on_their_side() {
        let tiny: Exact = "1e-30".parse().unwrap();
        let half: Exact = "1/2".parse().unwrap();
        for (x, down, up) in [
            (&half + &tiny, "0.5", "0.501"),
            (&half - &tiny, "0.499", "0.5"),
            (&tiny - &half, "-0.5", "-0.499"),
            (-&half - &tiny, "-0.501", "-0.5"),
        ] {
            assert_eq!([x.decimal(3, Round::Down), x.decimal(3, Round::Up)], [down, up], "{x}");
        }
    }

    #[test]
    fn floats_are_short() {
        assert_eq!(
            [4.81, 100.0, 1e-7, 0.05, -0.0, 1e300].map(|x: f64| x.text()),
            ["4.81", "100", "1e-7", "0.05", "0", "1e300"]
        );
        assert_eq!([0.1_f32, 1e38].map(|x| x.text()), ["0.1", "1e38"]);
    }

    #[test]
    fn a_column_is_never_too_narrow() {
        for (number, width, text) in [
            ("1/3", 16, "0.3333333333"),
            ("-1/3000", 16, "-0.0003333333333"),
            ("-1/30000", 16, "-3.333333333e-5"),
            ("-1e-100/3", 16, "-3.33333333e-101"),
            ("-1e-100/3", 12, "-3.3333e-101"),
            ("1e-1000", 3, "1e-1000"),
        ] {
            let x: Exact = number.replace("e-100/3", "e-100").parse().unwrap();
            let x = if number.ends_with("e-100/3") { x / Exact::from(3) } else { x };
            assert_eq!(x.decimal_within(10, width), text, "{number}");
        }
    }
}
