//! Numbers as text for people: shortened where they are long.

use super::exact;
use crate::number::Text;
use rug::float::Round;

/// How many characters of a number a table has room for.
const ROOM: usize = 24;

/// How many digits of a shortened number are written.
const DIGITS: usize = 17;

/// Returns a number as text for a table: in full if there is room, otherwise some of its digits.
///
/// ```
/// use spring_mass_contact::{number::Exact, solver::format_short};
/// let third: Exact = "1/3".parse().unwrap();
/// let long: Exact = "1234567890123456/1234567890123457".parse().unwrap();
/// assert_eq!([format_short(&third), format_short(&long)], ["1/3", "≈ 0.99999999999999919"]);
/// ```
pub fn format_short<T: Text>(x: &T) -> String {
    let text = x.text();
    if text.chars().count() <= ROOM {
        text
    } else {
        format!("≈ {}", exact(x).decimal(DIGITS, Round::Nearest))
    }
}

/// Returns a bound as text for a table, rounded down or up so that it still holds. What is not finite stays
/// so.
///
/// # Panics
/// Panics if the rounding is neither up nor down.
///
/// ```
/// use spring_mass_contact::{number::Exact, rug::float::Round, solver::format_short_bound};
/// let long: Exact = "1234567890123456/1234567890123457".parse().unwrap();
/// assert_eq!(format_short_bound(&long, Round::Down), "0.99999999999999918");
/// ```
pub fn format_short_bound<T: Text>(x: &T, round: Round) -> String {
    if x.to_exact().is_err() {
        return x.text();
    }
    let text = x.bound(round);
    if text.chars().count() <= ROOM { text } else { exact(x).decimal(DIGITS, round) }
}

/// Returns a symbol and its value for a table, `u = 0.05`, or `u ≈ …` if it is shortened.
pub fn format_equation<T: Text>(symbol: &str, x: &T) -> String {
    let text = format_short(x);
    if text.starts_with('≈') { format!("{symbol} {text}") } else { format!("{symbol} = {text}") }
}
