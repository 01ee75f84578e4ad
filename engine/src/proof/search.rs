//! The search for certificates of signs, and for the monomials that hypotheses are solved for.
//!
//! Nothing here is trusted: only the rules of the [kernel](super::kernel) make certificates, and it is the
//! kernel that solves.

use super::kernel::algebra::{Monomial, Poly, Ratio, Symbol};
use super::kernel::context::{Context, solved_for};
use super::kernel::sign::{Certificate, Known, Sign};
use crate::formula::Hypothesis;
use oorandom::Rand32;
use std::sync::Arc;

/// The depth to which certificates may rest on others.
const DEPTH: u32 = 3;

/// Rule 4 is tried on at most this many terms: derivatives only grow.
const TERMS: usize = 12;

/// Rule 6 is used on at most this many symbols, one inside the other, up to this degree, and on at most this
/// many terms.
const ENDS: u32 = 6;
const MAX_DEGREE: u32 = 4;
const TERMS_AT_ENDS: usize = 1000;

/// Rule 3 is tried on at most this many terms if there are symbols between −1 and 1.
const TERMS_OF_SQUARE: usize = 40;

/// Returns the sign of a polynomial, by rule 2 also with factors whose signs have been found before.
pub fn sign_of_product(of: &Poly, factors: &[Certificate], known: &Arc<Known>) -> Option<Certificate> {
    if has_both_signs(of, known) {
        return None;
    }
    sign(of, known).or_else(|| {
        let factor = |factor: &Certificate| {
            let rest = of.over(factor.of()).filter(|_| factor.of().terms().len() > 1)?;
            Certificate::product(factor.clone(), sign_of_product(&rest, factors, known)?)
        };
        factors.iter().find_map(factor)
    })
}

/// Returns the sign of a polynomial, if the rules find one.
///
/// Where there are symbols between −1 and 1, rule 4 is not tried.
pub fn sign(of: &Poly, known: &Arc<Known>) -> Option<Certificate> {
    if of.symbols().into_iter().any(Symbol::is_small) {
        return bounded(of, known, ENDS).or_else(|| small_square(of, known));
    }
    // A short certificate before a long one.
    (0..=DEPTH).find_map(|depth| within(of, known, depth))
}

/// The number of points at which both signs are looked for.
const POINTS: u32 = 12;

/// Returns `true` if a polynomial has values of both signs, as floats see it at some points: then no rule
/// finds its sign.
fn has_both_signs(of: &Poly, known: &Known) -> bool {
    if of.has_exponentials() {
        return false;
    }
    let mut random = Rand32::new(1);
    let mut number = |x: &Symbol| match known.get(x) {
        _ if x.is_small() => [-1.0, -0.5, 0.5, 1.0][random.rand_range(0..4) as usize],
        sign => {
            let size = 2.0_f64.powi(random.rand_range(0..13) as i32 - 6);
            let is_negative =
                sign.map_or(random.rand_range(0..2) == 0, |sign| sign.implies(Sign::NonPositive));
            if is_negative { -size } else { size }
        }
    };
    let symbols: Vec<_> = of.symbols().into_iter().collect();
    let place = |x: Symbol| symbols.binary_search(&x).unwrap_or_default();
    let powers = |m: &Monomial| m.powers().map(|(x, n)| (place(x), n as i32)).collect::<Vec<_>>();
    let terms: Vec<_> = of.terms().map(|(m, q)| (q.to_f64(), powers(m))).collect();
    let mut signs = (0..POINTS).filter_map(|_| {
        let point: Vec<f64> = symbols.iter().map(&mut number).collect();
        let values =
            terms.iter().map(|(q, powers)| powers.iter().fold(*q, |x, (i, n)| x * point[*i].powi(*n)));
        let (sum, sizes) = values.fold((0.0, 0.0), |(sum, sizes), x| (sum + x, sizes + x.abs()));
        // Where less is left than rounding may have made, nothing is seen.
        (sum.abs() > 1e-9 * sizes).then_some(sum > 0.0)
    });
    let first = signs.next();
    signs.any(|sign| Some(sign) != first)
}

fn within(of: &Poly, known: &Arc<Known>, depth: u32) -> Option<Certificate> {
    if let Some(certificate) = Certificate::terms(of, known) {
        return Some(certificate);
    }
    let depth = depth.checked_sub(1)?;
    let find = |of: &Poly, known: &Arc<Known>| within(of, known, depth);
    factor(of, known, depth)
        .or_else(|| of.symbols().into_iter().find_map(|x| Certificate::square(of, x, known, &find)))
        .or_else(|| slope(of, known, depth))
        .or_else(|| exponential_factor(of, known, depth))
}

/// Rule 2, with a product of powers.
fn factor(of: &Poly, known: &Arc<Known>, depth: u32) -> Option<Certificate> {
    let common = of.common_monomial();
    if common == Monomial::one() {
        return None;
    }
    let factor = Poly::from(common);
    let rest = within(&of.over(&factor)?, known, depth)?;
    Certificate::product(Certificate::terms(&factor, known)?, rest)
}

/// Rule 2, with an e^…, where rule 4 decides what is left.
fn exponential_factor(of: &Poly, known: &Arc<Known>, depth: u32) -> Option<Certificate> {
    of.exponents().find_map(|exponent| {
        let rest = of * Poly::exponential(-exponent);
        let factor = Certificate::terms(&Poly::exponential(exponent.clone()), known)?;
        Certificate::product(factor, slope(&rest, known, depth)?)
    })
}

/// Rule 4, where there is an e^….
fn slope(of: &Poly, known: &Arc<Known>, depth: u32) -> Option<Certificate> {
    if !of.has_exponentials() || of.terms().len() > TERMS {
        return None;
    }
    let find = |of: &Poly, known: &Arc<Known>| within(of, known, depth);
    of.symbols().into_iter().find_map(|x| Certificate::slope(of, x, known, &find))
}

/// Returns the sign by rules 1, 2, 5 and 6, the last of them on at most this many symbols.
fn bounded(of: &Poly, known: &Arc<Known>, symbols: u32) -> Option<Certificate> {
    let by_terms = Certificate::terms(of, known).or_else(|| Certificate::sizes(of, known));
    by_terms.or_else(|| small_factor(of, known, symbols)).or_else(|| {
        let symbols = symbols.checked_sub(1)?;
        if of.terms().len() > TERMS_AT_ENDS {
            return None;
        }
        let raised = |x: &Symbol| of.exponents().any(|e| e.symbols().contains(x));
        let small = of.symbols().into_iter().filter(|x| x.is_small() && !raised(x));
        let degrees = small.map(|x| (of.degree(x), x)).filter(|(n, _)| *n <= MAX_DEGREE);
        Certificate::ends(of, degrees.min()?.1, known, &|of, known| bounded(of, known, symbols))
    })
}

/// Rule 3, with a square in a symbol between −1 and 1.
fn small_square(of: &Poly, known: &Arc<Known>) -> Option<Certificate> {
    let small = of.symbols().into_iter().filter(|x| x.is_small() && of.terms().len() <= TERMS_OF_SQUARE);
    let find = |of: &Poly, known: &Arc<Known>| bounded(of, known, ENDS);
    small.into_iter().find_map(|x| Certificate::square(of, x, known, &find))
}

/// Rule 2, with squares of symbols between −1 and 1.
fn small_factor(of: &Poly, known: &Arc<Known>, symbols: u32) -> Option<Certificate> {
    let common = of.common_monomial();
    let small = common.without_those(|x| !x.is_small());
    let factor = Certificate::terms(&small.into(), known).filter(|factor| !factor.of().is_one())?;
    Certificate::product(factor.clone(), bounded(&of.over(factor.of())?, known, symbols)?)
}

/// Returns the monomial of a quantity for which the equation is best solved that the quantity is its slack,
/// or 0.
///
/// Best a symbol of which nothing is known and that stands alone or times what is not 0, so that it
/// disappears for good; else a product of symbols of which little is known, so that little is forgotten;
/// else a symbol whose sign is then seen again: with b = a + s for b − a > 0 that of b is.
///
/// Where there are errors in it, the symbol that the hypothesis is solved for comes first, and products
/// last: they would be forgotten for something long.
pub fn pivot(
    context: &Context,
    given: Option<&Hypothesis>,
    value: &Ratio,
    equation: &Poly,
    known: &Arc<Known>,
) -> Option<Monomial> {
    let solved = |x: Symbol| {
        let pivot = Monomial::of(x);
        let by = solved_for(&pivot, equation, known)?;
        Some((equation.coefficient(x, 1).terms().len(), pivot, by))
    };
    let symbols = value.num().symbols();
    // In a limit first of all the variable, so that the slack tends to infinity instead.
    let has_slack = equation != value.num();
    if let Some(x) = context.variable().filter(|x| symbols.contains(x) && has_slack)
        && let Some((_, pivot, _)) = solved(x)
    {
        return Some(pivot);
    }
    let rounds = symbols.iter().any(|x| x.is_small());
    let comes_later = |x: Symbol| rounds && given.is_none_or(|given| Symbol::Own(given.solved_for) != x);
    let is_free = |x: &&Symbol| !context.known().contains_key(x) && !x.is_small();
    let free = symbols.iter().filter(is_free).filter_map(|x| Some((comes_later(*x), solved(*x)?)));
    let free = free.min_by_key(|(later, (terms, ..))| (*later, *terms)).map(|(_, (_, pivot, _))| pivot);
    let product = || {
        let is_known = |m: &Monomial| m.powers().filter(|(x, _)| context.known().contains_key(x)).count();
        let is_large = |m: &&Monomial| m.powers().len() > 1 && !m.powers().any(|(x, _)| x.is_small());
        let own = value.num().terms().map(|(m, _)| m).filter(is_large);
        own.min_by_key(|m| is_known(m)).filter(|m| solved_for(m, equation, known).is_some()).cloned()
    };
    let seen_again = || {
        symbols.iter().find_map(|x| {
            let (_, pivot, by) = solved(*x)?;
            let sign = context.reduced_sign(&by, known)?;
            sign.implies(*context.known().get(x)?).then_some(pivot)
        })
    };
    free.or_else(|| {
        if rounds || context.rounds() { seen_again().or_else(product) } else { product().or_else(seen_again) }
    })
}

/// Returns the factors with which a symbol cancels in the difference of a value and a multiple of another:
/// an error or an interval parameter, if there is one in both.
pub fn multipliers(value: &Ratio, other: &Ratio) -> Vec<Ratio> {
    let factor = |x: Symbol| {
        let [[_, own], [_, other]] = [value.num().coefficients(x)?, other.num().coefficients(x)?];
        Ratio::from(own).over(&other.into())
    };
    let scale = Ratio::from(other.den().clone()).over(&value.den().clone().into());
    let cancelling = |of: Vec<Symbol>| -> Vec<Ratio> {
        of.into_iter().filter_map(|x| Some(scale.as_ref()? * factor(x)?)).collect()
    };
    let (small, others): (Vec<_>, Vec<_>) = other.num().symbols().into_iter().partition(|x| x.is_small());
    let small = cancelling(small);
    let mut all = if small.is_empty() { cancelling(others) } else { small };
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::super::kernel::algebra::Ratio;
    use super::super::kernel::sign::Sign::*;
    use super::*;

    fn x(name: &'static str) -> Poly {
        Poly::symbol(Symbol::Own(name))
    }

    fn error(index: u8) -> Poly {
        Poly::symbol(Symbol::Error(index))
    }

    fn n(n: i32) -> Poly {
        Poly::constant(n)
    }

    fn e(exponent: impl Into<Ratio>) -> Poly {
        Poly::exponential(exponent.into())
    }

    fn over(a: Poly, b: Poly) -> Ratio {
        Ratio::from(a).over(&b.into()).unwrap()
    }

    fn found(of: Poly) -> Option<Sign> {
        let known = [("a", Positive), ("b", Positive), ("z", NonNegative), ("n", Negative)];
        let known = Known::from(known.map(|(name, sign)| (Symbol::Own(name), sign)));
        sign(&of, &known.into()).map(|certificate| certificate.sign())
    }

    #[test]
    fn terms_of_one_sign() {
        assert_eq!(found(x("a") + x("z")), Some(Positive));
        assert_eq!(found(x("z") + x("u") * x("u")), Some(NonNegative));
        assert_eq!(found(-(x("a") * x("b"))), Some(Negative));
        assert_eq!(found(Poly::zero()), Some(Zero));
        assert_eq!(found(n(-2)), Some(Negative));
        assert_eq!(found(x("n") * x("n")), Some(Positive));
        assert_eq!(found(x("n") * x("n") * x("n")), Some(Negative));
        // An odd power of a free symbol, a difference: nothing is known.
        assert_eq!(found(x("u")), None);
        assert_eq!(found(x("a") - x("b")), None);
    }

    #[test]
    fn both_signs_are_seen_where_both_are_taken() {
        let known = [("a", Positive), ("z", NonNegative), ("n", Negative)];
        let known = Known::from(known.map(|(name, sign)| (Symbol::Own(name), sign)));
        for of in [x("u"), x("a") - n(1), x("z") * x("u"), error(0), n(3) * x("a") * error(0) - x("z")] {
            assert!(has_both_signs(&of, &known), "{of:?}");
        }
        // A square touches 0, and so does 1 + e; what is lost in floats is not seen.
        let square = (x("u") - x("v")) * (x("u") - x("v"));
        let lost = x("a") - (x("a") + x("z")) + x("z");
        for of in [square, n(1) + error(0), -x("n") * x("a"), x("z"), lost, e(x("u")) - x("a")] {
            assert!(!has_both_signs(&of, &known), "{of:?}");
        }
    }

    #[test]
    fn a_common_factor() {
        // a(u² + 1) is rule 1; a u² − 2 a u + 2 a needs the factor, then the square.
        let square = x("u") * x("u") - n(2) * x("u") + n(2);
        assert_eq!(found(x("a") * &square), Some(Positive));
        assert_eq!(found(x("z") * &square), Some(NonNegative));
        assert_eq!(found(x("u") * &square), None);
    }

    #[test]
    fn squares_that_miss_zero_touch_it_or_cross_it() {
        let quadratic = |d: i32| x("u") * x("u") + n(2) * x("u") + n(d);
        assert_eq!(found(quadratic(2)), Some(Positive));
        assert_eq!(found(quadratic(1)), Some(NonNegative));
        assert_eq!(found(quadratic(0)), None);
        assert_eq!(found(-quadratic(1)), Some(NonPositive));
        // A leading coefficient that may vanish proves nothing.
        assert_eq!(found(x("z") * x("u") * x("u") + x("u") + n(1)), None);
    }

    #[test]
    fn small_factors_make_no_term_larger() {
        assert_eq!(found(n(3) + error(0) + Poly::symbol(Symbol::Place(0))), Some(Positive));
        assert_eq!(found(n(1) + error(0) * error(1)), Some(NonNegative));
        assert_eq!(found(error(0) - n(1)), Some(NonPositive));
        assert_eq!(found(x("u") * x("u") * (n(2) + error(0))), Some(NonNegative));
        assert_eq!(found(x("a") * error(0) - n(2) * x("a") - x("b")), Some(Negative));
        // It takes as much of the same, and a sign.
        assert_eq!(found(x("a") + x("b") * error(0)), None);
        assert_eq!(found(n(3) + n(2) * error(0) + n(2) * error(1)), None);
        assert_eq!(found(x("u") * (n(2) + error(0))), None);
        assert_eq!(found(error(0)), None);
        // No other symbol is between −1 and 1, whatever its name.
        assert_eq!(found(n(3) + x("e₁")), None);
    }

    #[test]
    fn squares_of_small_factors_keep_the_sign_of_a_term() {
        let square = || error(0) * error(0);
        let [of_both, cube] = [square() * error(1), square() * error(0)];
        assert_eq!(found(n(1) + n(3) * square() - error(1)), Some(NonNegative));
        assert_eq!(found(n(2) + x("a") * square() * (n(1) + square()) + error(1)), Some(Positive));
        assert_eq!(found(x("n") * square() - n(2) - error(1)), Some(Negative));
        assert_eq!(found(square() * (n(3) - error(1)) * (n(3) - error(0))), Some(NonNegative));
        // Not of two factors of which one is no square, nor of a cube, nor without a sign.
        assert_eq!(found(n(1) + n(3) * of_both - error(0)), None);
        assert_eq!(found(n(1) + n(3) * cube - error(1)), None);
        assert_eq!(found(n(1) + x("u") * square() - error(1)), None);
        assert_eq!(found(n(1) - n(3) * square() - error(1)), None);
        assert_eq!(found(x("n") * square() + n(2) + error(1)), None);
    }

    #[test]
    fn what_is_linear_lies_between_its_ends() {
        // Its terms alone do not show it: with the sizes of all it is 1 − 2.
        let product = || (n(1) + error(0)) * (n(2) + error(1));
        assert_eq!(found(product()), Some(NonNegative));
        assert_eq!(found(-product()), Some(NonPositive));
        assert_eq!(found(x("a") * product() + x("b")), Some(Positive));
        assert_eq!(found(product() - x("a")), None);
        // Nor do they show a square, which is completed; not where it is in an exponent as well.
        assert_eq!(found(error(0) * error(0) * n(4) - n(4) * error(0) + n(1)), Some(NonNegative));
        assert_eq!(found(error(0) * error(0) * n(4) - n(4) * error(0) - error(1)), None);
        assert_eq!(found(e(error(0)) - n(1) - error(0)), None);
    }

    #[test]
    fn an_exponential_against_its_tangent() {
        let tangent = || n(1) + x("a");
        assert_eq!(found(e(x("a")) - tangent()), Some(Positive));
        assert_eq!(found(tangent() - e(x("a"))), Some(Negative));
        // The other way round and from a wrong start it is not so.
        assert_eq!(found(e(x("a")) - n(1) - tangent()), None);
        assert_eq!(found(e(x("u")) - n(1) - x("u")), None);
        // Where x may be 0 it is only as strict as its start.
        assert_eq!(found(e(x("z")) - n(1) - x("z")), Some(NonNegative));
        // e^{e^{1/a}} has no value at a = 0 to begin with.
        let nested = over(x("a") * e(over(n(1), x("a"))), tangent());
        assert_eq!(found(e(-nested) - n(1)), None);
        // 1 + a − e^{a/(a+1)}: its slope takes two rounds.
        assert_eq!(found(tangent() - e(over(x("a"), tangent()))), Some(Positive));
    }

    #[test]
    fn long_sums_are_left_alone() {
        let known = Arc::new(Known::from([(Symbol::Own("a"), Positive)]));
        let powers = |many: usize| {
            std::iter::successors(Some(x("a")), |power| Some(power * x("a")))
                .take(many)
                .fold(n(0), |a, b| a + b)
        };
        // e^a − 1 + a + a² + …: its slope is one of terms that are positive.
        let of = |terms: usize| e(x("a")) - n(1) + powers(terms - 2);
        let tried = [TERMS - 1, TERMS, TERMS + 1].map(|many| slope(&of(many), &known, 1).is_some());
        assert_eq!(tried, [true, true, false]);
        assert!(slope(&powers(3), &known, 1).is_none(), "where there is no e^…, other rules are as good");
        // (1 + e₁)(2 + e₂)(a + a² + …).
        let of = |terms: usize| (n(1) + error(0)) * (n(2) + error(1)) * powers(terms / 4);
        let many = [TERMS_AT_ENDS, TERMS_AT_ENDS + 4];
        let tried = many.map(|many| bounded(&of(many), &known, 2).is_some());
        assert_eq!(tried, [true, false]);
    }
}
