//! Results as a few lines of text. Shortened values are marked by ≈, and shortened bounds still hold.

use super::{Interval, Outcome, Scalar, Solution, format_equation, format_short_bound};
use crate::chapter::contact::Kkt;
use crate::number::ExactText;
use rug::float::Round;
use std::fmt;

/// Number of digits of a residual.
const DIGITS: usize = 3;

/// Writes both bounds, rounded outwards where they are shortened, or one number if they agree.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{number::Exact, solver::Interval};
/// let ends = ["1/3", "1/2"].map(|end| end.parse::<Exact>().unwrap());
/// let [lower, upper] = ends.each_ref().map(|end| end.to_f64().unwrap());
/// assert_eq!(Interval { lower, upper }.to_string(), "0.3333333333333333 to 0.5");
/// assert_eq!(Interval { lower: 2.0, upper: 2.0 }.to_string(), "2");
/// ```
impl<T: ExactText> fmt::Display for Interval<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [lower, upper] =
            [format_short_bound(&self.lower, Round::Down), format_short_bound(&self.upper, Round::Up)];
        if lower == upper { f.write_str(&lower) } else { write!(f, "{lower} to {upper}") }
    }
}

/// Writes each quantity on a line with the enclosure of the exact solution; for an iteration, of its limit.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::{chapter::SpringMass, solver::{Method, solve}};
/// let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse()?;
/// let shown = "\
/// contact, direct
/// u = 9/4 m, exact 9/4 m
/// p = 1/4 m, exact 1/4 m
/// N = 1 N, exact 1 N";
/// assert_eq!(solve(&system, &Method::Penalty { penalty: 4.into() })?.to_string(), shown);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl<T: Scalar + ExactText> fmt::Display for Solution<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}, {}", self.state, self.outcome)?;
        if let Some(k) = self.augmentations {
            write!(f, " at k = {k}")?;
        }
        if let Some(floor) = &self.floor {
            write!(f, ", |u − u*| at most {} m", format_short_bound(floor, Round::Up))?;
        }
        let answer = if self.outcome == Outcome::Direct { "exact" } else { "limit" };
        for (symbol, unit, value, enclosure) in [
            ("u", "m", &self.deflection, &self.bounds.deflection),
            ("p", "m", &self.penetration, &self.bounds.penetration),
            ("N", "N", &self.contact_force, &self.bounds.contact_force),
        ] {
            write!(f, "\n{} {unit}, {answer} {enclosure} {unit}", format_equation(symbol, value))?;
        }
        match &self.multiplier {
            Some(multiplier) => write!(f, "\n{} N", format_equation("λ", multiplier)),
            None => Ok(()),
        }
    }
}

/// Writes the residuals with their units to three digits; only an exact zero is written as 0.
///
/// # Examples
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, contact};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// let kkt = contact::kkt(&system, &2.25, &1.0);
/// assert_eq!(kkt.to_string(), "stationarity 0 N, primal 0.25 m, dual 0 N, complementarity 0.25 J");
/// ```
impl<T: ExactText> fmt::Display for Kkt<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [stationarity, primal, dual, complementarity] =
            [&self.stationarity, &self.primal, &self.dual, &self.complementarity]
                .map(|x| x.to_exact().map_or_else(|_| x.text(), |x| x.decimal(DIGITS, Round::Nearest)));
        write!(f, "stationarity {stationarity} N, primal {primal} m, ")?;
        write!(f, "dual {dual} N, complementarity {complementarity} J")
    }
}
