//! Numbers as text: with nothing lost for machines, shortened for people, bounds that hold as written.

use num_traits::Zero;
use spring_mass_contact::number::{Exact, Mpfr, Real, ToExact};
use spring_mass_contact::rug::{Float, float::Round};
use spring_mass_contact::solver::{Interval, Scalar};

/// Scalars that a command can print.
pub trait Number: Scalar + ToExact {
    /// All of it: the shortest text that reads back as the same float, or a fraction.
    fn text(&self) -> String;

    /// The numbers next to this one; a rational has none and is printed as it is.
    fn neighbours(&self) -> Interval<Self>;
}

macro_rules! machine {
    ($($float:ty),*) => {$(
        impl Number for $float {
            fn text(&self) -> String {
                // Debug turns to powers of ten where Display writes hundreds of zeros; no sign for a zero.
                let text = format!("{:?}", if self.is_zero() { 0.0 } else { *self });
                text.strip_suffix(".0").unwrap_or(&text).to_string()
            }
            fn neighbours(&self) -> Interval<Self> {
                Interval { lower: Real::next_down(self), upper: Real::next_up(self) }
            }
        }
    )*};
}
machine!(f32, f64);

impl Number for Mpfr {
    fn text(&self) -> String {
        self.to_string()
    }
    fn neighbours(&self) -> Interval<Self> {
        Interval { lower: self.next_down(), upper: self.next_up() }
    }
}

impl Number for Exact {
    fn text(&self) -> String {
        self.to_string()
    }
    fn neighbours(&self) -> Interval<Self> {
        Interval { lower: self.clone(), upper: self.clone() }
    }
}

/// Both ends as texts that still enclose. The shortest decimal of a float can lie on either side of it.
pub fn enclosing<T: Number>(interval: &Interval<T>) -> [String; 2] {
    let search = |end: &T, round, next: fn(Interval<T>) -> T| {
        let mut near = end.clone();
        loop {
            let text = near.text();
            if holds(&text, end, round) {
                return text;
            }
            near = next(near.neighbours());
        }
    };
    [
        search(&interval.lower, Round::Up, |beside| beside.lower),
        search(&interval.upper, Round::Down, |beside| beside.upper),
    ]
}

/// Is the number that the text spells no greater than the end (rounding up), or no less (down)?
fn holds<T: Number>(text: &str, end: &T, round: Round) -> bool {
    let end = exact(end);
    let Ok(decimal) = Float::parse(text) else { return true }; // a fraction, which is the end itself
    // The end is a float of so many bits, so no rounding towards it can step over it.
    let bits = end.as_rational().numer().significant_bits().max(2);
    let rounded = Float::with_val_round(bits, decimal, round).0;
    if round == Round::Up { rounded <= *end.as_rational() } else { rounded >= *end.as_rational() }
}

/// The value, of a number that a solve returned.
pub fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("solutions are finite")
}

/// How many characters of a number a table has room for.
const ROOM: usize = 24;

/// For a table: the whole text if there is room, otherwise some of its digits.
pub fn brief<T: Number>(x: &T) -> String {
    let text = x.text();
    if text.chars().count() <= ROOM {
        text
    } else {
        format!("≈ {}", decimal(&exact(x), 17, Round::Nearest))
    }
}

/// For a table: the symbol and its value, `u = 0.05`, or `u ≈ …` if it is shortened.
pub fn relation<T: Number>(symbol: &str, x: &T) -> String {
    let text = brief(x);
    if text.starts_with('≈') { format!("{symbol} {text}") } else { format!("{symbol} = {text}") }
}

/// How many digits of a number are looked at, however few were typed: the residuals in a table have as many.
const FEWEST: usize = 3;

/// What a number became by rounding, `g = 8`, if one can see that: if it is no longer the number that was typed
/// when written to as many digits. Where few digits are typed, 6 for f32 and 15 for f64, it is.
pub fn visibly_rounded<T: Number>(symbol: &str, typed: &str, value: &Exact, x: &T) -> Option<String> {
    let mantissa = typed.split(['e', 'E']).next().unwrap_or_default();
    let digits = mantissa.chars().filter(char::is_ascii_digit).skip_while(|digit| *digit == '0').count();
    // A fraction is not written to any digits.
    let digits = if typed.contains('/') { FEWEST } else { digits.max(FEWEST) };
    let x = exact(x);
    let written = |x: &Exact| decimal(x, digits, Round::Nearest);
    (written(value) != written(&x)).then(|| {
        let text = decimal(&x, digits.min(17), Round::Nearest);
        let sign = if text.parse() == Ok(x) { '=' } else { '≈' };
        format!("{symbol} {sign} {text}")
    })
}

/// For a table: at most so many digits, and no more than fit into a column.
pub fn fitting<T: Number>(x: &T, digits: usize, width: usize) -> String {
    let x = exact(x);
    let fits = |text: &String| text.chars().count() <= width;
    let shorter = (1..=digits).rev().map(|digits| decimal(&x, digits, Round::Nearest));
    let mut shorter = shorter.skip_while(|text| !fits(text));
    shorter.next().unwrap_or_else(|| decimal(&x, 1, Round::Nearest))
}

/// For a table: bounds that still hold.
pub fn brief_bounds<T: Number>(interval: &Interval<T>) -> [String; 2] {
    let [lower, upper] = enclosing(interval);
    let brief = |text: String, end: &T, round| {
        if text.chars().count() <= ROOM { text } else { decimal(&exact(end), 17, round) }
    };
    [brief(lower, &interval.lower, Round::Down), brief(upper, &interval.upper, Round::Up)]
}

/// A rational as a decimal of at most so many digits, on the side that the rounding says; directed, it can be
/// one unit further than need be.
pub fn decimal(x: &Exact, digits: usize, round: Round) -> String {
    if x.is_zero() {
        return "0".to_string();
    }
    // Four bits hold a decimal digit; both roundings go the same way.
    let x = Float::with_val_round(4 * digits as u32 + 16, x.as_rational(), round).0;
    let (negative, text, exponent) = x.to_sign_string_exp_round(10, Some(digits), round);
    let sign = if negative { "-" } else { "" };
    let text = text.trim_end_matches('0');
    // The number is 0.text × 10^exponent.
    let exponent = exponent.expect("not zero");
    match usize::try_from(exponent) {
        Ok(0) | Err(_) if exponent > -4 => {
            format!("{sign}0.{}{text}", "0".repeat(exponent.unsigned_abs() as usize))
        }
        Ok(whole @ 1..) if whole >= text.len() && whole <= digits => {
            format!("{sign}{text}{}", "0".repeat(whole - text.len()))
        }
        Ok(whole @ 1..) if whole < text.len() => format!("{sign}{}.{}", &text[..whole], &text[whole..]),
        _ => {
            let (first, rest) = text.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            format!("{sign}{first}{point}{rest}e{}", exponent - 1)
        }
    }
}

/// The beginning of a text that may be long.
pub fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 { text.to_string() } else { text.chars().take(39).chain(['…']).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bounds of a solve have room to spare, which hides a text on the wrong side; a point has none.
    fn encloses<T: Number>(point: &T) -> bool {
        let texts = enclosing(&Interval { lower: point.clone(), upper: point.clone() });
        let [lower, upper]: [Exact; 2] = texts.map(|text| text.parse().expect("a number"));
        // And no further away than the neighbour's text has to be.
        let Interval { lower: below, upper: above } = point.neighbours();
        let (below, above) = (exact(&below.neighbours().lower), exact(&above.neighbours().upper));
        lower <= exact(point) && exact(point) <= upper && below <= lower && upper <= above
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
            ("1000", "1e3", "1e3"),
            ("0", "0", "0"),
        ] {
            let x: Exact = fraction.parse().unwrap();
            assert_eq!([decimal(&x, 3, Round::Down), decimal(&x, 3, Round::Up)], [down, up], "{fraction}");
        }
    }

    #[test]
    fn only_what_can_be_seen_was_rounded() {
        fn seen<T: Number>(typed: &str, like: &T) -> Option<String> {
            let value: Exact = typed.parse().unwrap();
            visibly_rounded("x", typed, &value, &like.nearest(&value).unwrap())
        }
        // Six digits in f32 and fifteen in f64 come back, whatever they are; a fraction has none.
        for typed in ["9.81", "1.05", "0.1", "1e-9", "999999", "-123.456", "7.00001e-30", "1/3", "-22/7", "0"]
        {
            assert_eq!(seen(typed, &0_f32), None, "{typed}");
            assert_eq!(seen(typed, &0_f64), None, "{typed}");
            assert_eq!(seen(typed, &Exact::zero()), None, "{typed}");
        }
        assert_eq!(seen("999999999999999", &0_f64), None);
        // 2²⁴ + 1 and 2⁵³ + 1 do not fit. 1.4…e-45 is the least f32.
        assert_eq!(seen("16777217", &0_f32).as_deref(), Some("x = 16777216"));
        assert_eq!(seen("9007199254740993", &0_f64).as_deref(), Some("x = 9007199254740992"));
        assert_eq!(seen("1e-45", &0_f32).as_deref(), Some("x ≈ 1.4e-45"));
        // Two bits: 1, 3/2, 2, 3, 4, 6, 8, 12, …, and 3/32 is 0.09375.
        let two_bits = Exact::zero().to_mpfr(2);
        assert_eq!(seen("9.81", &two_bits).as_deref(), Some("x = 8"));
        assert_eq!(seen("-1.05", &two_bits).as_deref(), Some("x = -1"));
        assert_eq!(seen("100", &two_bits).as_deref(), Some("x = 96"));
        assert_eq!(seen("0.1", &two_bits).as_deref(), Some("x ≈ 0.0938"));
        assert_eq!(seen("1/3", &two_bits).as_deref(), Some("x = 0.375"));
        assert_eq!(
            [seen("12", &two_bits), seen("1.50", &two_bits), seen("6e2", &two_bits)],
            [None, None, Some("x = 512".into())]
        );
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
            assert_eq!(fitting(&x, 10, width), text, "{number}");
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
}
