//! Conversion of numbers to lossless text, and to decimals rounded in a given direction.

use super::{Exact, Mpfr, ToExact};
use crate::number::Real;
use num_traits::Zero;
use rug::{Float, Integer, Rational, float::Round, ops::Pow};

/// Numbers with a lossless text, and with texts that are bounds.
pub trait ExactText: ToExact + Clone {
    /// Returns the shortest text that parses as the same float, or a fraction.
    ///
    /// # Examples
    ///
    /// ```
    /// # use provable::number::ExactText;
    /// assert_eq!([1e300, 0.1, -0.0].map(|x: f64| x.text()), ["1e300", "0.1", "0"]);
    /// ```
    fn text(&self) -> String;

    /// Returns the adjacent numbers, the smaller first; for a rational, which has none, the number itself.
    fn neighbours(&self) -> [Self; 2];

    /// Returns a text whose value is at most this number, or at least this number if the rounding is up. It
    /// is the text of this number or of one nearby, since the shortest decimal of a float can lie on either
    /// side of it. The text of an infinity or NaN is its own bound.
    ///
    /// # Panics
    /// Panics if the rounding is neither up nor down.
    fn bound(&self, round: Round) -> String {
        let Ok(end) = self.to_exact() else { return self.text() };
        let mut candidate = self.clone();
        loop {
            let text = candidate.text();
            if is_bound(&text, &end, round) {
                return text;
            }
            let [below, above] = candidate.neighbours();
            candidate = if round == Round::Up { above } else { below };
        }
    }
}

/// Returns `true` if the value of the text is `end` or lies on this side of it.
fn is_bound(text: &str, end: &Exact, round: Round) -> bool {
    let Ok(decimal) = Float::parse(text) else { return true }; // a fraction, which is the end itself
    // `end` is a float of at most `bits` bits, so rounding towards it cannot pass it.
    let bits = end.as_rational().numer().significant_bits().max(2);
    match round {
        Round::Down => Float::with_val_round(bits, decimal, Round::Up).0 <= *end.as_rational(),
        Round::Up => Float::with_val_round(bits, decimal, Round::Down).0 >= *end.as_rational(),
        other => panic!("{other:?} is not a direction"),
    }
}

macro_rules! machine {
    ($($float:ty),*) => {$(
        impl ExactText for $float {
            fn text(&self) -> String {
                // `Debug` uses powers of ten where `Display` writes hundreds of zeros. A zero has no sign.
                let mut text = format!("{:?}", if self.is_zero() { 0.0 } else { *self });
                text.truncate(text.strip_suffix(".0").map_or(text.len(), str::len));
                text
            }
            fn neighbours(&self) -> [Self; 2] {
                [Real::next_down(*self), Real::next_up(*self)]
            }
        }
    )*};
}
machine!(f32, f64);

impl ExactText for Mpfr {
    fn text(&self) -> String {
        self.to_string()
    }
    fn neighbours(&self) -> [Self; 2] {
        [self.clone().next_down(), self.clone().next_up()]
    }
}

impl ExactText for Exact {
    fn text(&self) -> String {
        self.to_string()
    }
    fn neighbours(&self) -> [Self; 2] {
        [self.clone(), self.clone()]
    }
}

/// Returns the nearest integer, ties to even.
pub(super) fn to_whole(x: Rational) -> Integer {
    let (off, nearest) = x.fract_round(Integer::new());
    // rug rounds ties away from zero.
    if *off.denom() == 2 && nearest.is_odd() { nearest + off.numer() } else { nearest }
}

/// Returns the absolute value with this number of decimals; `units` returns the nearest multiple of 1/unit.
pub(super) fn fixed(decimals: usize, units: impl FnOnce(&Integer) -> Integer) -> String {
    let unit = Integer::from(10).pow(decimals as u32);
    let digits = format!("{:0>1$}", units(&unit).abs().to_string(), decimals + 1);
    let (whole, fraction) = digits.split_at(digits.len() - decimals);
    if decimals == 0 { whole.to_string() } else { format!("{whole}.{fraction}") }
}

impl Exact {
    /// Returns a decimal with at most `digits` digits, rounded in the given direction. A directed result can
    /// be one unit further than necessary, except for a number with few digits.
    ///
    /// # Examples
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
        // Four bits hold a decimal digit; both roundings have the same direction.
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

    /// Returns a decimal with at most `digits` digits, or fewer if the text would otherwise exceed `width`.
    pub fn decimal_within(&self, digits: usize, width: usize) -> String {
        let decimal = |digits| self.decimal(digits, Round::Nearest);
        let mut shorter = (1..=digits).rev().map(decimal).filter(|text| text.chars().count() <= width);
        shorter.next().unwrap_or_else(|| decimal(1))
    }
}

/// Implements `Serialize` by the `Display` text.
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
serialize_as_displayed!(Exact, Mpfr, super::NumberSystem);

/// Reads a number from its text, without rounding.
#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Exact {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let text = String::deserialize(from)?;
        text.parse().map_err(|error| serde::de::Error::custom(format!("{text:?}: {error}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tests a point: the bounds of a solve have a margin that would hide a text on the wrong side.
    fn encloses<T: ExactText>(point: &T) -> bool {
        let [lower, upper] = [Round::Down, Round::Up].map(|side| point.bound(side).parse::<Exact>().unwrap());
        // The text is also not further away than that of the neighbour.
        let exact = |x: &T| x.to_exact().unwrap();
        let [below, above] = point.neighbours();
        let ([below, _], [_, above]) = (below.neighbours(), above.neighbours());
        let point = exact(point);
        lower <= point && point <= upper && exact(&below) <= lower && upper <= exact(&above)
    }

    #[test]
    fn formatted_bounds_are_valid_and_tight() {
        for number in ["1/3", "-2/3", "1e-9", "123456.789", "0.1", "-1.1e38", "1e-45", "0", "7"] {
            let x: Exact = number.parse().unwrap();
            assert!(encloses(&x) && encloses(&x.to_f32().unwrap()) && encloses(&x.to_f64().unwrap()), "{x}");
            if !x.is_zero() {
                assert!([2, 3, 24, 53, 200].into_iter().all(|bits| encloses(&x.to_mpfr(bits))), "{x}");
            }
        }
    }

    #[test]
    fn decimals_are_rounded_in_the_given_direction() {
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

    /// ±(1/2 ± 10⁻³⁰) is so close to a decimal that an additional rounding to nearest would return the
    /// decimal itself.
    #[test]
    fn decimals_close_to_a_shorter_one_are_rounded_in_the_given_direction() {
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
    fn floats_have_short_texts() {
        assert_eq!(
            [4.81, 100.0, 1e-7, 0.05, -0.0, 1e300].map(|x: f64| x.text()),
            ["4.81", "100", "1e-7", "0.05", "0", "1e300"]
        );
        assert_eq!([0.1_f32, 1e38].map(|x| x.text()), ["0.1", "1e38"]);
    }

    #[test]
    fn decimals_fit_the_width_if_one_digit_does() {
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
