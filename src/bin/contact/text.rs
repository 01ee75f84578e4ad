//! Numbers as text for people: shortened where they are long.

use crate::args::Number;
use spring_mass_contact::number::{Exact, Text, ToExact};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::Interval;

/// The value, of a number that a solve returned.
pub fn exact<T: ToExact>(x: &T) -> Exact {
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

/// What a number became by rounding, `g = 8`, if one can see that: if it is no longer the number that was
/// typed when written to as many digits. Where few digits are typed, 6 for f32 and 15 for f64, it is.
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
