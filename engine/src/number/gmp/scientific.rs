//! Scientific notation of exact numbers and MPFR floats.

use super::text::to_whole;
use super::{Exact, Mpfr};
use num_traits::Zero;
use rug::ops::Pow;
use rug::{Float, Integer, Rational};
use std::fmt;

/// Writes scientific notation, exactly rounded with ties to even, like machine floats: `{:.2e}` has two
/// decimals, `{:e}` all decimals, or seventeen digits of a non-terminating fraction.
///
/// # Examples
///
/// ```
/// use provable::number::Exact;
/// let [third, eighth] = ["-1/3", "1/8"].map(|text| text.parse::<Exact>().unwrap());
/// assert_eq!(format!("{eighth:e} {eighth:.0e} {third:.3e}"), "1.25e-1 1e-1 -3.333e-1");
/// assert_eq!(format!("{third:e}"), "-3.3333333333333333e-1");
/// let below_one: Exact = "0.99999999999999999999999999".parse().unwrap(); // the next f64 is 1
/// assert_eq!(format!("{below_one:e}"), "9.9999999999999999999999999e-1");
/// ```
impl fmt::LowerExp for Exact {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad_integral(*self >= Exact::zero(), "", &rational(self.as_rational(), f.precision()))
    }
}

/// Writes scientific notation, exactly rounded with ties to even, like machine floats: `{:.2e}` has two
/// decimals, `{:e}` the digits that parse as the same number. A constant is written like an
/// [`Exact`](super::Exact) number.
///
/// # Examples
///
/// ```
/// use provable::number::Mpfr;
/// let third = Mpfr::rounded(24, 1) / Mpfr::rounded(24, 3);
/// assert_eq!(format!("{third:e} {third:.2e} {third:+9.1e}"), "3.33333343e-1 3.33e-1   +3.3e-1");
/// ```
impl fmt::LowerExp for Mpfr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let text = match self.as_float() {
            None => rational(&self.to_rational().unwrap_or_default(), f.precision()),
            Some(x) if !x.is_finite() => return fmt::LowerExp::fmt(&x.to_f64(), f),
            Some(x) if x.is_zero() => rational(&Rational::new(), f.precision()),
            // Not through a rational, which can exceed the memory.
            Some(x) => {
                let digits = f.precision().map(|decimals| decimals + 1);
                let (_, text, exponent) = x.to_sign_string_exp(10, digits);
                // The number is 0.text × 10^exponent.
                let text = if digits.is_none() { text.trim_end_matches('0') } else { &text };
                scientific(text, i64::from(exponent.unwrap_or_default()) - 1)
            }
        };
        f.pad_integral(*self >= Mpfr::zero(), "", &text)
    }
}

/// Returns digits in scientific notation, with the point after the first and the exponent of the first.
fn scientific(digits: &str, exponent: i64) -> String {
    let (first, rest) = digits.split_at(1);
    let point = if rest.is_empty() { "" } else { "." };
    format!("{first}{point}{rest}e{exponent}")
}

/// Number of digits of a non-terminating fraction if no precision is given.
const ENDLESS: usize = 17;

/// Returns the absolute value of a rational in scientific notation with `decimals` decimals, exactly rounded
/// with ties to even. Without a precision returns all digits, or [`ENDLESS`] digits of a non-terminating
/// fraction.
fn rational(x: &Rational, decimals: Option<usize>) -> String {
    let x = Rational::from(x.abs_ref());
    if x.is_zero() {
        return scientific(&"0".repeat(decimals.unwrap_or(0) + 1), 0);
    }
    let power = |n: i64| Rational::from(10).pow(n as i32);
    // Rounding x to 64 bits changes the logarithm by less than 0.44/2⁶⁴, which is less than half the distance
    // from an integer to the float below it (and 1 is exact). So it can reach the next integer, but not fall
    // below one.
    let mut order = Float::with_val(64, &x).log10().floor().to_f64() as i64;
    if power(order) > x {
        order -= 1;
    }
    let whole = |behind: i64| to_whole(&x * power(behind - order)).to_string();
    let digits = match (decimals, decimals_of(&x)) {
        (Some(decimals), _) => whole(decimals as i64),
        (None, Some(all)) => whole(i64::from(all) + order).trim_end_matches('0').to_string(),
        (None, None) => whole(ENDLESS as i64 - 1),
    };
    // 9.99 can become 10.0, which has one digit too many, a zero.
    let most = decimals.or_else(|| decimals_of(&x).is_none().then_some(ENDLESS - 1)).map(|n| n + 1);
    match most {
        Some(most) if digits.len() > most => scientific(&digits[..most], order + 1),
        _ => scientific(&digits, order),
    }
}

/// Returns the number of decimals of a rational; `None` if they do not terminate.
fn decimals_of(x: &Rational) -> Option<u32> {
    let (rest, twos) = x.denom().clone().remove_factor(&Integer::from(2));
    let (rest, fives) = rest.remove_factor(&Integer::from(5));
    (rest == 1).then_some(twos.max(fives))
}
