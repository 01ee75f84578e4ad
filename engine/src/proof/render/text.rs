//! Polynomials, signs and intervals as text.

use super::ProofPrinter;
use crate::formula::{Hypothesis, name_of_rounding};
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::check::Sign;
use rug::{Integer, Rational};

/// Maximum numbers of characters and of terms of a polynomial in place of which its shape is written.
pub(super) const LONG: usize = 100;
const MOST: usize = 16;

impl ProofPrinter<'_> {
    /// Returns a polynomial as a formula, given its terms in ascending order and its variables; `None` if it is long.
    ///
    /// Negative terms come last. Factors have the order of the registry; others precede them, sorted by name.
    pub(super) fn sum<Powers: Iterator<Item = (usize, u8)>>(
        &self,
        terms: impl ExactSizeIterator<Item = (Rational, Powers)>,
        variable: &dyn Fn(usize) -> Option<Tree>,
    ) -> Option<Tree> {
        if terms.len() > MOST {
            return None;
        }
        let (mut terms, order): (Vec<_>, _) = (terms.collect(), self.registry.factors());
        terms.sort_by_key(|(q, _)| !q.is_negative());
        let sum = terms.into_iter().rev().try_fold(Tree::from(0), |sum, (q, powers)| {
            let factors = powers.flat_map(|(x, n)| std::iter::repeat_n(x, n.into())).map(variable);
            let mut factors = factors.collect::<Option<Vec<_>>>()?;
            factors.sort_by_key(|factor| match factor.op() {
                Op::Symbol(name) => (order.iter().position(|symbol| symbol == name), *name),
                _ => (Some(order.len()), ""),
            });
            let size = number(&q.numer().clone().abs());
            let term = factors.into_iter().fold(size, |product, factor| product * factor) / number(q.denom());
            Some(if q.is_negative() { sum - term } else { sum + term })
        })?;
        (self.text(&sum).chars().count() <= LONG).then_some(sum)
    }

    /// Formats the rounding of a formula: `fl(a + fl(b c))`.
    pub(super) fn rounding(&self, of: &Tree) -> String {
        format!("{}({})", name_of_rounding(of), self.text(of))
    }

    /// Formats a formula as a multiple of its absolute value, with the name of the factor.
    pub(super) fn multiple_of_size(&self, of: &str, factor: &str) -> String {
        format!("{of} = {factor} |{of}| with |{factor}| ≤ 1")
    }

    /// Formats the definition of the parameter of an interval.
    pub(super) fn parameter(&self, name: &str, hypothesis: &Hypothesis) -> Option<String> {
        let (x, lower, upper) = hypothesis.interval()?;
        let (lower, upper) = (self.text(lower), self.text(upper));
        Some(format!("{name} goes from −1 to 1 as {x} goes from {lower} to {upper}"))
    }
}

/// Returns a number as a formula; a large one as a product of small ones.
fn number(n: &Integer) -> Tree {
    if let Some(n) = n.to_i32() {
        return n.into();
    }
    let (high, low) = n.clone().div_rem((1 << 30).into());
    number(&high) * Tree::from(1 << 30) + number(&low)
}

/// Returns a sign as text.
pub(super) fn sign_text(sign: Sign) -> &'static str {
    match sign {
        Sign::NEGATIVE => "< 0",
        Sign::NON_POSITIVE => "≤ 0",
        Sign::ZERO => "= 0",
        Sign::NON_NEGATIVE => "≥ 0",
        Sign::POSITIVE => "> 0",
        _ => "of any sign",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Registry;
    use crate::number::Exact;

    #[test]
    fn signs_are_relations_to_zero() {
        let signs = [Sign::NEGATIVE, Sign::NON_POSITIVE, Sign::ZERO, Sign::NON_NEGATIVE, Sign::POSITIVE];
        assert_eq!(signs.map(sign_text), ["< 0", "≤ 0", "= 0", "≥ 0", "> 0"]);
    }

    #[test]
    fn integers_of_any_size_are_written_exactly() {
        let (large, registry): (Integer, _) = (Integer::from(1) << 80, Registry::default());
        for n in [large.clone(), -1 - large, Integer::ZERO, Integer::from(-7)] {
            let q = Rational::from((n, 3));
            let terms = [(q.clone(), std::iter::empty())];
            let tree = ProofPrinter::new(&registry).sum(terms.into_iter(), &|_| None).unwrap();
            assert_eq!(tree.eval(&|_| Exact::from(0), &|_| None), Some(Exact::from(q)));
        }
    }
}
