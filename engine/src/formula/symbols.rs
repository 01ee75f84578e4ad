//! Symbols with a meaning of their own in statements.

use std::collections::BTreeMap;
use std::sync::Mutex;

/// Symbol of 2ᵖ in formulas [rounded](crate::number::Tree::with_rounding) to p bits; its inverse is the unit roundoff.
pub const PRECISION: &str = "2ᵖ";

/// Symbols of powers of two with arbitrary integer exponents.
pub const SCALES: [&str; 3] = ["2ᵃ", "2ᵇ", "2ᶠ"];

/// Symbol q of the power ρᵏ in a statement about a [sequence](super::statement::Sequence).
pub const POWER: &str = "q";

/// Symbols of the components of x_k in the step of a [sequence](super::statement::Sequence).
pub const MEMBERS: [&str; 4] = ["x₁", "x₂", "x₃", "x₄"];

/// Returns a letter with the subscript `index` + 1: v₁ for 0.
pub(crate) fn subscripted(letter: char, index: u8) -> &'static str {
    static NAMES: Mutex<BTreeMap<(char, u8), &str>> = Mutex::new(BTreeMap::new());
    let mut names = NAMES.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    names.entry((letter, index)).or_insert_with(|| {
        let digits = (u32::from(index) + 1).to_string();
        let digits = digits.bytes().filter_map(|d| char::from_u32(u32::from('₀') + u32::from(d - b'0')));
        String::from_iter([letter].into_iter().chain(digits)).leak()
    })
}
