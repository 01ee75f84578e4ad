//! The rules for what is between −1 and 1: the errors of roundings, and places in intervals.

use super::Sign::{Negative, NonNegative, NonPositive, Positive, Zero};
use super::{Certificate, Known, Rule, Sign, of_monomial, terms};
use crate::proof::kernel::algebra::{Monomial, Number, Poly, Symbol};
use std::collections::BTreeMap;

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

/// Rule 6 is used on so many symbols, one inside the other, and on so many terms.
pub(super) const ENDS: u32 = 4;
const TERMS_AT_ENDS: usize = 1000;

/// Rule 5.
pub(super) fn sizes(of: &Poly, known: &Known) -> Option<Certificate> {
    // Of each monomial, the coefficient without small factors and the sizes of those with them.
    let mut all: BTreeMap<Monomial, [Number; 2]> = BTreeMap::new();
    for (monomial, coefficient) in of.terms() {
        let rest = monomial.without_those(is_small);
        let is_whole = rest == *monomial;
        let [own, with] = all.entry(rest).or_insert_with(|| [0.into(), 0.into()]);
        if is_whole { *own = &*own + coefficient } else { *with = &*with + coefficient.abs() }
    }
    let all: Option<Vec<_>> = all
        .into_iter()
        .map(|(monomial, [own, with])| {
            let size = match of_monomial(&monomial, known) {
                Some(Positive | NonNegative | Zero) => with,
                Some(Negative | NonPositive) => -with,
                None if with.sign().is_eq() => with,
                None => return None,
            };
            Some((monomial, own, size))
        })
        .collect();
    let all = all?;
    // The whole is `beyond` 0 with respect to what is left, so it is of its sign if both agree.
    let by = |beyond: Sign| {
        let term = |(monomial, own, size): &(Monomial, Number, Number)| {
            let left = if beyond == NonNegative { own - size } else { own + size };
            (monomial.clone(), left)
        };
        let rest = terms(&all.iter().map(term).collect(), known)?;
        let sign = rest.sign.plus(beyond)?;
        Some(Certificate { of: of.clone(), sign, rule: Rule::Sizes(rest.into()) })
    };
    by(NonNegative).or_else(|| by(NonPositive))
}

/// Rule 6.
pub(super) fn ends(of: &Poly, known: &Known, more: u32) -> Option<Certificate> {
    let more = more.checked_sub(1)?;
    if of.terms().len() > TERMS_AT_ENDS {
        return None;
    }
    let raised = |x: &Symbol| of.exponents().any(|e| e.symbols().contains(x));
    let linear = |x: &Symbol| is_small(*x) && of.degree(*x) == 1 && !raised(x);
    let x = of.symbols().into_iter().find(linear)?;
    let [rest, slope] = <[Poly; 2]>::try_from(of.coefficients(x)).ok()?;
    let sign = |of: Poly| terms(&of, known).or_else(|| sizes(&of, known)).or_else(|| ends(&of, known, more));
    let (low, high) = (sign(&rest - &slope)?, sign(rest + slope)?);
    // Between two numbers of one sign there is no other, and no zero if neither is.
    let one = [Positive, Negative, NonNegative, NonPositive];
    let both = one.into_iter().find(|sign| low.sign.implies(*sign) && high.sign.implies(*sign))?;
    Some(Certificate { of: of.clone(), sign: both, rule: Rule::Ends { x, at: [low, high].into() } })
}
