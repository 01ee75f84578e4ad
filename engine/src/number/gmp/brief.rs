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
/// use provable::number::{Exact, brief};
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
/// use provable::{number::{Exact, brief_bound}, rug::float::Round};
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
