//! The rules for what is between −1 and 1: the errors of roundings, and places in intervals.

use super::Sign::{Negative, NonNegative, NonPositive, Positive};
use super::{Certificate, Known, Rule, Sign, of_monomial, terms};
use crate::proof::kernel::algebra::{Monomial, Number, Poly, Symbol};

/// What is between −1 and 1: the rounding error of each step, in parts of the largest.
pub const ERRORS: [&str; 24] = [
    "e₁", "e₂", "e₃", "e₄", "e₅", "e₆", "e₇", "e₈", "e₉", "e₁₀", "e₁₁", "e₁₂", "e₁₃", "e₁₄", "e₁₅", "e₁₆",
    "e₁₇", "e₁₈", "e₁₉", "e₂₀", "e₂₁", "e₂₂", "e₂₃", "e₂₄",
];

/// And where in an interval a quantity is, from one end to the other.
pub const PLACES: [&str; 6] = ["t₁", "t₂", "t₃", "t₄", "t₅", "t₆"];

/// Is it between −1 and 1?
pub fn is_small(x: Symbol) -> bool {
    ERRORS.contains(&x.0) || PLACES.contains(&x.0)
}

/// Rule 6 is used on at most this many symbols, one inside the other, up to this degree, and on at most this
/// many terms.
pub(super) const ENDS: u32 = 6;
pub(super) const MAX_DEGREE: u32 = 4;
pub(super) const TERMS_AT_ENDS: usize = 1000;

/// Rule 5.
pub(super) fn sizes(of: &Poly, small: &[Symbol], known: &Known) -> Option<Certificate> {
    let has_small = |m: &Monomial| m.powers().any(|(x, _)| small.contains(&x));
    let (with, whole): (Vec<_>, Vec<_>) = of.terms().partition(|(m, _)| has_small(m));
    let whole: Poly = whole.into_iter().map(|(m, q)| (m.clone(), q.clone())).collect();
    // Without their small factors the others are no larger in size than the sums of their coefficients'
    // sizes, times the size of what is left of them, whose sign has to be known.
    let without = |(m, q): (&Monomial, &Number)| (m.without_those(|x| small.contains(&x)), q.abs());
    let with: Poly = with.into_iter().map(without).collect();
    let size = |(m, q): (&Monomial, &Number)| {
        let is_negative = of_monomial(m, known)?.implies(NonPositive);
        Some((m.clone(), if is_negative { -q } else { q.clone() }))
    };
    let sizes: Poly = with.terms().map(size).collect::<Option<_>>()?;
    // The whole is `beyond` 0 with respect to what is left, so it is of its sign if both agree.
    let by = |beyond: Sign| {
        let rest = terms(&if beyond == NonNegative { &whole - &sizes } else { &whole + &sizes }, known)?;
        let sign = rest.sign.plus(beyond)?;
        Some(Certificate { of: of.clone(), sign, rule: Rule::Sizes(rest.into()) })
    };
    by(NonNegative).or_else(|| by(NonPositive))
}

/// Rule 6.
pub(super) fn ends(of: &Poly, small: &[Symbol], known: &Known, more: u32) -> Option<Certificate> {
    let more = more.checked_sub(1)?;
    if of.terms().len() > TERMS_AT_ENDS {
        return None;
    }
    let raised = |x: &Symbol| of.exponents().any(|e| e.symbols().contains(x));
    let degrees = small.iter().map(|x| (of.degree(*x), *x));
    let (_, x) = degrees.filter(|(n, x)| (1..=MAX_DEGREE).contains(n) && !raised(x)).min()?;
    let sign = |of: Poly| {
        terms(&of, known).or_else(|| sizes(&of, small, known)).or_else(|| ends(&of, small, known, more))
    };
    let at: Vec<_> = bernstein(of, x).into_iter().map(sign).collect::<Option<_>>()?;
    // Between numbers of one sign there is no other, and no zero if none is.
    let one = [Positive, Negative, NonNegative, NonPositive];
    let all = one.into_iter().find(|sign| at.iter().all(|own| own.sign.implies(*sign)))?;
    Some(Certificate { of: of.clone(), sign: all, rule: Rule::Ends { x, at: at.into() } })
}

/// The sums bᵢ for which a polynomial of degree n in x is Σ bᵢ aⁱ (1 − a)ⁿ⁻ⁱ, where a = (1 + x)/2.
///
/// In it xᵏ = (a − (1 − a))ᵏ (a + (1 − a))ⁿ⁻ᵏ.
fn bernstein(of: &Poly, x: Symbol) -> Vec<Poly> {
    let degree = of.degree(x) as usize;
    let times = |factors: &[i32], by: i32| -> Vec<i32> {
        let shifted = [0].iter().chain(factors);
        factors.iter().chain(&[0]).zip(shifted).map(|(low, high)| by * low + high).collect()
    };
    // The factors of aⁱ (1 − a)ⁿ⁻ⁱ in xᵏ.
    let factors = |k: usize| {
        let minus = (0..k).fold(vec![1], |all, _| times(&all, -1));
        (k..degree).fold(minus, |all, _| times(&all, 1))
    };
    (0..=degree).fold(vec![Poly::zero(); degree + 1], |sums, k| {
        let coefficient = of.coefficient(x, k as u32);
        sums.iter().zip(factors(k)).map(|(sum, n)| sum + &coefficient * Poly::constant(n)).collect()
    })
}
