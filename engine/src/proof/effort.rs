//! A bound on the effort of a proof.
//!
//! The size of a polynomial cannot be predicted from the formula. So arithmetic counts the terms that it
//! processes. Above [`MAX_EFFORT`] it returns polynomials with too few terms, so that the proof ends soon, and
//! [`bounded`] discards the result.

use std::cell::Cell;

/// Maximum number of terms, and of powers in them, that arithmetic processes in one proof; a coefficient of
/// n words counts as n/8 terms.
pub const MAX_EFFORT: usize = 20_000_000;

/// The effort that is left.
#[derive(Clone, Copy)]
enum Rest {
    /// There is no proof in progress.
    Unlimited,
    /// The number of terms that may still be processed.
    Terms(usize),
    /// The proof in progress has processed too many.
    Exceeded,
}

thread_local! {
    static REST: Cell<Rest> = const { Cell::new(Rest::Unlimited) };
}

/// Returns the value of `f`, or `None` if its arithmetic exceeds [`MAX_EFFORT`].
pub fn bounded<T>(f: impl FnOnce() -> T) -> Option<T> {
    let before = REST.replace(Rest::Terms(MAX_EFFORT));
    let value = f();
    let is_exceeded = matches!(REST.replace(before), Rest::Exceeded);
    (!is_exceeded).then_some(value)
}

/// Counts terms that are about to be processed. Returns `false` if there are too many.
pub fn spend(terms: usize) -> bool {
    if let Rest::Terms(rest) = REST.get() {
        REST.set(rest.checked_sub(terms).map_or(Rest::Exceeded, Rest::Terms));
    }
    !matches!(REST.get(), Rest::Exceeded)
}

/// Ends the proof in progress, if there is one.
pub fn exceed() {
    if let Rest::Terms(_) = REST.get() {
        REST.set(Rest::Exceeded);
    }
}

#[cfg(test)]
mod tests {
    use super::super::search::algebra::{Number, Poly};
    use super::*;
    use rug::{Integer, Rational};

    #[test]
    fn effort_is_bounded_separately_for_each_proof() {
        let spend_all = || bounded(|| (0..MAX_EFFORT / 10).all(|_| spend(10)));
        assert!(spend_all() == Some(true) && spend_all() == Some(true));
        assert!(bounded(|| (spend(MAX_EFFORT), spend(1))).is_none());
        assert!(bounded(|| (spend(MAX_EFFORT + 1), spend(0))).is_none());
        assert!(bounded(exceed).is_none());
        // Elsewhere effort is unbounded, also after a bound was exceeded.
        exceed();
        assert!(spend(MAX_EFFORT + 1));
    }

    #[test]
    fn arithmetic_counts_its_terms() {
        let sum = |terms: usize| {
            let x = Poly::variable(0);
            let powers = std::iter::successors(Some(Poly::constant(1)), |power| Some(power * &x));
            powers
                .take(terms)
                .flat_map(|p| p.terms().map(|(m, q)| (m.clone(), q.clone())).collect::<Vec<_>>())
                .collect::<Poly>()
        };
        let rest_after = |f: &dyn Fn()| {
            bounded(|| {
                f();
                match REST.get() {
                    Rest::Terms(rest) => Some(rest),
                    Rest::Unlimited | Rest::Exceeded => None,
                }
            })?
        };
        // All terms except 1 have one power. A sum counts only terms.
        let [a, b] = [sum(20), sum(30)];
        assert_eq!(rest_after(&|| drop(&a * &b)), Some(MAX_EFFORT - 1199));
        assert_eq!(rest_after(&|| drop(&a + &b)), Some(MAX_EFFORT - 50));
        // 2⁹⁵⁹ has 15 words and its denominator one.
        let [c, d] = [480, 479].map(|n| Number::from(Rational::from(Integer::from(1) << n)));
        assert_eq!(rest_after(&|| drop(&c * &d)), Some(MAX_EFFORT - 2));
        // Each term of a quotient is multiplied by each term of the divisor except one, and subtracted.
        let product = &a * &b;
        assert!(rest_after(&|| drop(product.checked_div(&a))).unwrap() <= MAX_EFFORT - 19 * 30);
    }
}
