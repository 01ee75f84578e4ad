//! Numbers as text for people: shortened where they are long.

use super::{Exact, Text, ToExact};
use rug::float::Round;

/// How many characters of a number a table has room for.
const ROOM: usize = 24;

/// How many digits of a shortened number are written.
const DIGITS: usize = 17;

fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("what is not finite is short")
}

/// For a table: the whole text if there is room, otherwise some of its digits.
///
/// ```
/// use spring_mass_contact::number::{Exact, brief};
/// let third: Exact = "1/3".parse().unwrap();
/// let long: Exact = "1234567890123456/1234567890123457".parse().unwrap();
/// assert_eq!([brief(&third), brief(&long)], ["1/3", "≈ 0.99999999999999919"]);
/// ```
pub fn brief<T: Text>(x: &T) -> String {
    let text = x.text();
    if text.chars().count() <= ROOM {
        text
    } else {
        format!("≈ {}", exact(x).decimal(DIGITS, Round::Nearest))
    }
}

/// For a table: a bound that still holds, rounded down or up. What is not finite stays so.
///
/// # Panics
/// The rounding is neither up nor down.
///
/// ```
/// use spring_mass_contact::{number::{Exact, brief_bound}, rug::float::Round};
/// let long: Exact = "1234567890123456/1234567890123457".parse().unwrap();
/// assert_eq!(brief_bound(&long, Round::Down), "0.99999999999999918");
/// ```
pub fn brief_bound<T: Text>(x: &T, round: Round) -> String {
    if x.to_exact().is_err() {
        return x.text();
    }
    let text = x.bound(round);
    if text.chars().count() <= ROOM { text } else { exact(x).decimal(DIGITS, round) }
}

/// For a table: the symbol and its value, `u = 0.05`, or `u ≈ …` if it is shortened.
pub fn relation<T: Text>(symbol: &str, x: &T) -> String {
    let text = brief(x);
    if text.starts_with('≈') { format!("{symbol} {text}") } else { format!("{symbol} = {text}") }
}

/// How many digits of a number are looked at, however few were typed: the residuals in a table have as many.
const FEWEST: usize = 3;

/// What a number became by rounding, `g = 8`, if one can see that: if it is no longer the number that was
/// typed, of this value, when written to as many digits. Where few digits are typed, 6 for f32 and 15 for
/// f64, it is.
pub fn visibly_rounded<T: Text>(symbol: &str, typed: &str, value: &Exact, x: &T) -> Option<String> {
    let mantissa = typed.split(['e', 'E']).next().unwrap_or_default();
    let digits = mantissa.chars().filter(char::is_ascii_digit).skip_while(|digit| *digit == '0').count();
    // A fraction is not written to any digits.
    let digits = if typed.contains('/') { FEWEST } else { digits.max(FEWEST) };
    let x = exact(x);
    let written = |x: &Exact| x.decimal(digits, Round::Nearest);
    (written(value) != written(&x)).then(|| {
        let text = x.decimal(digits.min(DIGITS), Round::Nearest);
        let sign = if text.parse() == Ok(x) { '=' } else { '≈' };
        format!("{symbol} {sign} {text}")
    })
}
