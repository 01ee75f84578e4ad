//! The choice of rules for signs.

use super::algebra::{Poly, Ratio};
use super::rules::{SignCertificate, SignEnv};
use crate::number::Ball;
use crate::proof::check::Sign;
use num_traits::Zero;
use oorandom::Rand32;
use rug::Rational;
use std::cmp::Ordering;
use std::ops::{Add, Mul};

/// Maximum number of nested applications of rule 4, each to another symbol.
const MAX_ENDS: u32 = 6;

/// Returns the sign of a polynomial if the rules find one.
pub fn sign(of: &Poly, known: &SignEnv) -> Option<SignCertificate> {
    known.spend(of, &Poly::zero())?;
    by_terms(of, known).or_else(|| {
        let variables = of.variables();
        if has_both_signs(of, known) {
            None
        } else if variables.iter().any(|x| known.is_unit(*x)) {
            by_ends(of, known, MAX_ENDS)
        } else {
            variables.into_iter().find_map(|x| SignCertificate::square(of, x, known))
        }
    })
}

/// Number of points that [`has_both_signs`] tries.
const POINTS: u32 = 12;

/// Returns `true` if a polynomial has values of both signs, so that no rule can find its sign: balls of floats have them
/// at random points.
fn has_both_signs(of: &Poly, known: &SignEnv) -> bool {
    let (mut random, variables) = (Rand32::new(1), of.variables());
    let terms: Vec<_> = of.terms().map(|(m, q)| (m, enclosing(q))).collect();
    let signs = (0..POINTS).map(|_| {
        let point: Vec<_> = variables.iter().map(|x| (*x, random_value(&mut random, *x, known))).collect();
        let values = terms.iter().map(|(m, q)| {
            let powers = point.iter().map(|(x, at)| Ball::point(at.powi(m.degree(*x).into())));
            powers.fold(q.clone(), Mul::mul)
        });
        values.fold(Ball::zero(), Add::add).sign()
    });
    let signs: Vec<_> = signs.collect();
    [Ordering::Less, Ordering::Greater].iter().all(|sign| signs.contains(&Some(*sign)))
}

/// Returns a ball that contains a number.
fn enclosing(q: &Rational) -> Ball<f64> {
    Ball::enclosing(&0.0, &q.clone().into()).unwrap_or_else(|_| Ball::entire())
}

/// Returns a random value of a symbol, with its known sign; its powers are floats.
fn random_value(random: &mut Rand32, x: usize, known: &SignEnv) -> f64 {
    let size = if known.is_unit(x) { 1.0 } else { 2.0_f64.powi(random.rand_range(0..13) as i32 - 6) };
    let is_free = known.get(x) == Sign::ANY || known.is_unit(x);
    let is_negative = match is_free {
        true => random.rand_range(0..2) == 0,
        false => known.get(x).implies(Sign::NON_POSITIVE),
    };
    if is_negative { -size } else { size }
}

/// Returns the sign by rules 1 and 3.
fn by_terms(of: &Poly, known: &SignEnv) -> Option<SignCertificate> {
    SignCertificate::termwise(of, known).or_else(|| SignCertificate::triangle_inequality(of, known))
}

/// Returns the sign by rules 1, 3 and 4, the last one applied to at most `symbols` symbols.
fn bounded(of: &Poly, known: &SignEnv, symbols: u32) -> Option<SignCertificate> {
    known.spend(of, &Poly::zero())?;
    by_terms(of, known).or_else(|| by_ends(of, known, symbols))
}

/// Returns the sign by rule 4, and the others inside it.
fn by_ends(of: &Poly, known: &SignEnv, symbols: u32) -> Option<SignCertificate> {
    let symbols = symbols.checked_sub(1)?;
    let units = of.variables().into_iter().filter(|x| known.is_unit(*x));
    let x = units.min_by_key(|x| of.degree(*x))?;
    SignCertificate::endpoints(of, x, |of| bounded(of, known, symbols))
}

/// Returns the factors m for which a symbol cancels in `value` − m `other`: an error or interval parameter
/// if both contain one.
pub fn multipliers(value: &Ratio, other: &Ratio, known: &SignEnv) -> Vec<Ratio> {
    let (units, others): (Vec<_>, Vec<_>) =
        other.num().variables().into_iter().partition(|x| known.is_unit(*x));
    let all = cancelling_multipliers(value, other, &units);
    if all.is_empty() { cancelling_multipliers(value, other, &others) } else { all }
}

/// Returns the factors m for which one of the symbols cancels.
fn cancelling_multipliers(value: &Ratio, other: &Ratio, symbols: &[usize]) -> Vec<Ratio> {
    let Some(scale) = Ratio::from(other.den().clone()).checked_div(&value.den().clone().into()) else {
        return Vec::new();
    };
    let multipliers = symbols.iter().filter_map(|x| {
        let [[_, dividend], [_, divisor]] = [value.num().coefficients(*x)?, other.num().coefficients(*x)?];
        Some(&scale * Ratio::from(dividend).checked_div(&divisor.into())?)
    });
    multipliers.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::effort::{Effort, MAX_EFFORT};

    /// The symbols, in order.
    const NAMES: [&str; 6] = ["a", "b", "n", "u", "v", "z"];

    fn x(name: &str) -> Poly {
        Poly::variable(NAMES.iter().position(|own| *own == name).unwrap())
    }

    fn error(index: usize) -> Poly {
        Poly::variable(NAMES.len() + index)
    }

    /// Returns the signs of these symbols; the variables after the symbols are between −1 and 1.
    fn signs<const N: usize>(known: [(&str, Sign); N]) -> SignEnv {
        let mut env = SignEnv::new(NAMES.len()..2 * NAMES.len() + 6, Effort::default());
        for (name, sign) in known {
            env.set(x(name).variables()[0], sign);
        }
        env
    }

    fn n(n: i32) -> Poly {
        Poly::constant(n)
    }

    fn found(of: Poly) -> Option<Sign> {
        let known =
            [("a", Sign::POSITIVE), ("b", Sign::POSITIVE), ("z", Sign::NON_NEGATIVE), ("n", Sign::NEGATIVE)];
        let known = signs(known);
        sign(&of, &known).map(|certificate| certificate.sign())
    }

    #[test]
    fn terms_of_one_sign() {
        assert_eq!(found(x("a") + x("z")), Some(Sign::POSITIVE));
        assert_eq!(found(x("z") + x("u") * x("u")), Some(Sign::NON_NEGATIVE));
        assert_eq!(found(-(x("a") * x("b"))), Some(Sign::NEGATIVE));
        assert_eq!(found(Poly::zero()), Some(Sign::ZERO));
        assert_eq!(found(n(-2)), Some(Sign::NEGATIVE));
        assert_eq!(found(x("n") * x("n")), Some(Sign::POSITIVE));
        assert_eq!(found(x("n") * x("n") * x("n")), Some(Sign::NEGATIVE));
        // Odd powers of free symbols and differences have no certain sign.
        assert_eq!(found(x("u")), None);
        assert_eq!(found(x("a") - x("b")), None);
    }

    #[test]
    fn both_signs_are_found_where_both_occur() {
        let known = [("a", Sign::POSITIVE), ("z", Sign::NON_NEGATIVE), ("n", Sign::NEGATIVE)];
        let known = signs(known);
        for of in [x("u"), x("a") - n(1), x("z") * x("u"), error(0), n(3) * x("a") * error(0) - x("z")] {
            assert!(has_both_signs(&of, &known), "{of:?}");
        }
        // Squares and 1 + e have zeros but do not change sign, and cancellation in floats hides a sign.
        let square = (x("u") - x("v")) * (x("u") - x("v"));
        let lost = x("a") - (x("a") + x("z")) + x("z");
        for of in [square, n(1) + error(0), -x("n") * x("a"), x("z"), lost] {
            assert!(!has_both_signs(&of, &known), "{of:?}");
        }
    }

    #[test]
    fn no_sign_is_found_beyond_the_effort() {
        let effort = Effort::default();
        let known = SignEnv::new([], effort.clone());
        let square = n(2) * x("u") * x("u") - n(2) * x("u") + n(1);
        assert!(sign(&square, &known).is_some());
        effort.spend(MAX_EFFORT);
        assert!(sign(&square, &known).is_none() && bounded(&n(1), &known, 1).is_none());
    }

    #[test]
    fn quadratics_have_a_sign_unless_they_have_two_roots() {
        let quadratic = |d: i32| x("u") * x("u") + n(2) * x("u") + n(d);
        assert_eq!(found(quadratic(2)), Some(Sign::POSITIVE));
        assert_eq!(found(quadratic(1)), Some(Sign::NON_NEGATIVE));
        assert_eq!(found(quadratic(0)), None);
        assert_eq!(found(-quadratic(1)), Some(Sign::NON_POSITIVE));
        // The leading coefficient may be 0.
        assert_eq!(found(x("z") * x("u") * x("u") + x("u") + n(1)), None);
    }

    #[test]
    fn factors_between_minus_1_and_1_do_not_increase_terms() {
        assert_eq!(found(n(3) + error(0) + error(1)), Some(Sign::POSITIVE));
        assert_eq!(found(n(1) + error(0) * error(1)), Some(Sign::NON_NEGATIVE));
        assert_eq!(found(error(0) - n(1)), Some(Sign::NON_POSITIVE));
        assert_eq!(found(x("u") * x("u") * (n(2) + error(0))), Some(Sign::NON_NEGATIVE));
        assert_eq!(found(x("a") * error(0) - n(2) * x("a") - x("b")), Some(Sign::NEGATIVE));
        assert_eq!(found(n(2) * x("n") * error(0) - x("n")), None);
        // The other terms are too small, or of unknown sign.
        assert_eq!(found(x("a") + x("b") * error(0)), None);
        assert_eq!(found(n(3) + n(2) * error(0) + n(2) * error(1)), None);
        assert_eq!(found(x("u") * (n(2) + error(0))), None);
        assert_eq!(found(error(0)), None);
        // Other variables are unbounded.
        assert_eq!(found(n(3) + x("u")), None);
    }

    #[test]
    fn linear_polynomials_lie_between_their_values_at_the_ends() {
        // Rule 3 fails, as the absolute values of the other terms exceed 2.
        let product = || (n(1) + error(0)) * (n(2) + error(1));
        assert_eq!(found(product()), Some(Sign::NON_NEGATIVE));
        assert_eq!(found(-product()), Some(Sign::NON_POSITIVE));
        assert_eq!(found(x("a") * product() + x("b")), Some(Sign::POSITIVE));
        assert_eq!(found(product() - x("a")), None);
        assert_eq!(found(error(0) * error(0) * n(4) - n(4) * error(0) - error(1)), None);
    }
}
