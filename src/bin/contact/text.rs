//! Numbers as text for people: shortened where they are long.

use crate::args::Number;
use spring_mass_contact::number::{Exact, Text, ToExact};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::Interval;

/// The value, of a number that a solve returned.
fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("solutions are finite")
}

/// How many characters of a number a table has room for.
const ROOM: usize = 24;

/// For a table: the whole text if there is room, otherwise some of its digits.
pub fn brief<T: Text>(x: &T) -> String {
    let text = x.text();
    if text.chars().count() <= ROOM { text } else { format!("≈ {}", exact(x).decimal(17, Round::Nearest)) }
}

/// For a table: the symbol and its value, `u = 0.05`, or `u ≈ …` if it is shortened.
pub fn relation<T: Text>(symbol: &str, x: &T) -> String {
    let text = brief(x);
    if text.starts_with('≈') { format!("{symbol} {text}") } else { format!("{symbol} = {text}") }
}

/// How many digits of a number are looked at, however few were typed: the residuals in a table have as many.
const FEWEST: usize = 3;

/// What a number became by rounding, `g = 8`, if one can see that: if it is no longer the number that was typed
/// when written to as many digits. Where few digits are typed, 6 for f32 and 15 for f64, it is.
pub fn visibly_rounded<T: Text>(symbol: &str, typed: &Number, x: &T) -> Option<String> {
    let mantissa = typed.text.split(['e', 'E']).next().unwrap_or_default();
    let digits = mantissa.chars().filter(char::is_ascii_digit).skip_while(|digit| *digit == '0').count();
    // A fraction is not written to any digits.
    let digits = if typed.text.contains('/') { FEWEST } else { digits.max(FEWEST) };
    let x = exact(x);
    let written = |x: &Exact| x.decimal(digits, Round::Nearest);
    (written(&typed.value) != written(&x)).then(|| {
        let text = x.decimal(digits.min(17), Round::Nearest);
        let sign = if text.parse() == Ok(x) { '=' } else { '≈' };
        format!("{symbol} {sign} {text}")
    })
}

/// For a table: at most so many digits, and no more than fit into a column.
pub fn fitting<T: Text>(x: &T, digits: usize, width: usize) -> String {
    let x = exact(x);
    let fits = |text: &String| text.chars().count() <= width;
    let shorter = (1..=digits).rev().map(|digits| x.decimal(digits, Round::Nearest));
    let mut shorter = shorter.skip_while(|text| !fits(text));
    shorter.next().unwrap_or_else(|| x.decimal(1, Round::Nearest))
}

/// For a table: bounds that still hold.
pub fn brief_bounds<T: Text>(interval: &Interval<T>) -> [String; 2] {
    let [lower, upper] = interval.texts();
    let brief = |text: String, end: &T, round| {
        if text.chars().count() <= ROOM { text } else { exact(end).decimal(17, round) }
    };
    [brief(lower, &interval.lower, Round::Down), brief(upper, &interval.upper, Round::Up)]
}

/// The beginning of a text that may be long.
pub fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 { text.to_string() } else { text.chars().take(39).chain(['…']).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::finite;
    use num_traits::Zero;

    #[test]
    fn only_what_can_be_seen_was_rounded() {
        fn seen<T: Text>(typed: &str, like: &T) -> Option<String> {
            let typed = finite(typed).unwrap();
            visibly_rounded("x", &typed, &like.nearest(&typed.value).unwrap())
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
}
