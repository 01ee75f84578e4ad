//! Numbers as short text.

use super::exact;
use crate::number::ExactText;
use rug::float::Round;

/// Largest number of characters of a number in a table.
const ROOM: usize = 24;

/// Number of digits of a shortened number.
const DIGITS: usize = 17;

/// Returns a number as text for a table: in full if it is short enough, otherwise its leading digits.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::{number::Exact, solver::format_short};
/// let third: Exact = "1/3".parse().unwrap();
/// let long: Exact = "1234567890123456/1234567890123457".parse().unwrap();
/// assert_eq!([format_short(&third), format_short(&long)], ["1/3", "≈ 0.99999999999999919"]);
/// ```
pub fn format_short<T: ExactText>(x: &T) -> String {
    let text = x.text();
    if text.chars().count() <= ROOM {
        text
    } else {
        format!("≈ {}", exact(x).decimal(DIGITS, Round::Nearest))
    }
}

/// Returns a bound as text for a table, rounded down or up so that it still holds. Non-finite values are not
/// changed.
///
/// # Panics
/// Panics if the rounding is neither up nor down.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::{number::Exact, rug::float::Round, solver::format_short_bound};
/// let long: Exact = "1234567890123456/1234567890123457".parse().unwrap();
/// assert_eq!(format_short_bound(&long, Round::Down), "0.99999999999999918");
/// ```
pub fn format_short_bound<T: ExactText>(x: &T, round: Round) -> String {
    if x.to_exact().is_err() {
        return x.text();
    }
    let text = x.bound(round);
    if text.chars().count() <= ROOM { text } else { exact(x).decimal(DIGITS, round) }
}

/// Returns a symbol and its value for a table, `u = 0.05`, or `u ≈ …` if it is shortened.
pub fn format_equation<T: ExactText>(symbol: &str, x: &T) -> String {
    let text = format_short(x);
    if text.starts_with('≈') { format!("{symbol} {text}") } else { format!("{symbol} = {text}") }
}
