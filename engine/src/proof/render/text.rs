//! Polynomials, quotients and certificates as text.

use crate::number::{Field, Tree};
use crate::proof::ProofError;
use crate::proof::check::Sign;
use crate::proof::search::Quantity;
use crate::proof::search::algebra::{Monomial, Poly, Ratio};
use crate::proof::search::choice;
use crate::proof::search::context::Context;
use crate::proof::search::symbol::Symbol;
use rug::Integer;
use std::fmt;

/// Form of polynomials.
#[derive(Clone, Copy)]
pub(super) struct Order<'a> {
    /// The meaning of the variables.
    pub(super) context: &'a Context,
    /// Order of the factors of a product, by symbols; other factors precede them, sorted by name.
    pub(super) factors: &'a [&'static str],
}

impl Order<'_> {
    fn product(&self, monomial: &Monomial) -> Option<Tree> {
        let mut powers: Vec<_> = monomial.powers().map(|(x, n)| (self.context.symbol(x), x, n)).collect();
        powers.sort_by_key(|(symbol, x, _)| {
            let place = self.factors.iter().position(|name| Some(Symbol::Own(name)) == *symbol);
            (symbol.is_none(), place, *symbol, *x)
        });
        let factors = powers.into_iter().flat_map(|(symbol, x, n)| {
            let factor = symbol.map(|symbol| Tree::symbol(symbol.name()));
            let factor = factor.or_else(|| self.context.exponentials.get(&x).cloned());
            std::iter::repeat_n(factor, n.into()).flatten()
        });
        factors.reduce(|a, b| a * b)
    }

    /// Returns the terms of a sum without their signs, and whether they are negative.
    fn terms(&self, poly: &Poly) -> impl Iterator<Item = (bool, Tree)> {
        poly.terms().rev().map(|(monomial, q)| {
            let (n, d) = (number(&q.numer().clone().abs()), number(q.denom()));
            let term = match self.product(monomial) {
                Some(product) => n * product,
                None => n,
            };
            (q.is_negative(), if *q.denom() == 1 { term } else { term / d })
        })
    }

    /// Returns a polynomial as a formula.
    pub(super) fn poly(&self, poly: &Poly) -> Tree {
        sum(self.terms(poly))
    }

    /// Returns a quotient as a formula.
    pub(super) fn ratio(&self, ratio: &Ratio) -> Tree {
        let num = self.poly(ratio.num());
        if ratio.den().is_one() { num } else { num / self.poly(ratio.den()) }
    }

    /// Returns the number of terms that are written out.
    fn shown(&self, poly: &Poly) -> usize {
        match poly.variables().into_iter().any(|x| self.context.signs.is_unit(x)) {
            true => SHOWN_OF_ROUNDING,
            false => SHOWN,
        }
    }

    /// Formats a polynomial, or the number of its terms if it is very long.
    pub(super) fn poly_or_size(&self, poly: &Poly) -> String {
        match poly.terms().len() {
            n if n > self.shown(poly) => format!("a sum of {n} terms"),
            _ => self.poly(poly).to_string(),
        }
    }

    /// Formats a quotient, or its size if it is very long.
    pub(super) fn ratio_or_size(&self, ratio: &Ratio) -> String {
        match [ratio.num(), ratio.den()].map(|poly| poly.terms().len()) {
            [n, d] if n > self.shown(ratio.num()) || d > self.shown(ratio.den()) => {
                format!("a sum of {n} terms over one of {d}")
            }
            _ => self.ratio(ratio).to_string(),
        }
    }

    fn sign(&self, of: &Poly) -> Option<Sign> {
        choice::sign(of, &self.context.signs).map(|found| found.sign())
    }

    /// Returns the terms of a quotient that are not known to have the sign of its denominator, if there are
    /// one or two and not all: `: the term −b is < 0`.
    fn obstacles(&self, value: &Ratio) -> String {
        let Some(den) = self.sign(value.den()) else { return String::new() };
        let terms = value.num().terms().map(|(m, q)| Poly::from_iter([(m.clone(), q.clone())]));
        let with_signs = terms.map(|term| (self.sign(&term), term));
        let (fitting, others): (Vec<_>, Vec<_>) = with_signs
            .partition(|(sign, _)| sign.is_some_and(|sign| sign.times(den).implies(Sign::NonNegative)));
        if fitting.is_empty() || others.len() > 2 {
            return String::new();
        }
        let described = others.iter().map(|(sign, term)| match sign {
            Some(sign) => format!("the term {} is {}", self.poly_or_size(term), sign_text(*sign)),
            None => format!("the sign of the term {} is unknown", self.poly_or_size(term)),
        });
        format!(": {}", described.collect::<Vec<_>>().join(" and "))
    }
}

impl Quantity {
    fn order<'a>(&'a self, factors: &'a [&'static str]) -> Order<'a> {
        Order { context: &self.context, factors }
    }

    fn formula(&self, factors: &[&'static str]) -> String {
        self.order(factors).ratio_or_size(&self.value)
    }
}

/// Explains a failed proof, with formulas formatted by `text`, and the order of factors.
pub(super) fn justify(of: &ProofError, text: &dyn Fn(&Tree) -> String, factors: &[&'static str]) -> String {
    use ProofError::*;
    match of {
        Premise(premise) => premise.to_string(),
        PossibleZeroDivisor(of, value) if value.value.is_zero() => format!("the divisor {} is 0", text(of)),
        PossibleZeroDivisor(of, value) => {
            let is_as_written = value.symbols().into_iter().map(Symbol::name).eq(of.symbols());
            let reduced =
                if is_as_written { String::new() } else { format!(" = {}", value.formula(factors)) };
            format!("the divisor {}{reduced} might be 0", text(of))
        }
        UndecidedBranch(value) => format!("the sign of {} is undecided", value.formula(factors)),
        UnknownSign(value) => {
            let obstacles = value.order(factors).obstacles(&value.value);
            format!("no rule finds the sign of {}{obstacles}", value.formula(factors))
        }
        WrongSign(value, sign) => format!("{} is {}", value.formula(factors), sign_text(*sign)),
        Unequal(value) => format!("the sides differ by {}", value.formula(factors)),
        UnknownLimit(value) => format!("no rule finds that {} has the stated limit", value.formula(factors)),
        EndingHypothesis(of) => {
            format!(
                "the hypothesis on {} is not known to hold for all large values of the variable",
                text(of)
            )
        }
        NotDifferentiable => "⟨·⟩ and min are not differentiable at kinks".to_string(),
        TooLarge(most) => format!("its proof exceeds the limit of {most} terms"),
        NotExpressed(reason) => format!("its proof cannot be checked: {reason}"),
        Refused(refusal) => format!("its proof cannot be checked: the checker refuses it ({refusal:?})"),
    }
}

/// Maximum number of terms written out, and of terms with rounding errors.
const SHOWN: usize = 24;
const SHOWN_OF_ROUNDING: usize = 8;

/// Returns the sum of terms, each with whether it is negative; negative terms come last.
pub(super) fn sum(terms: impl Iterator<Item = (bool, Tree)>) -> Tree {
    let (subtracted, added): (Vec<_>, Vec<_>) = terms.partition(|(is_negative, _)| *is_negative);
    let sum = added.into_iter().chain(subtracted).fold(None, |sum, (is_negative, term)| {
        Some(match (sum, is_negative) {
            (None, false) => term,
            (None, true) => -term,
            (Some(sum), false) => sum + term,
            (Some(sum), true) => sum - term,
        })
    });
    sum.unwrap_or_else(|| Tree::int(0))
}

/// Returns a number as a formula; a large one as a product of small ones.
pub(super) fn number(n: &Integer) -> Tree {
    n.to_i32().map_or_else(
        || {
            let (high, low) = n.clone().div_rem((1 << 30).into());
            number(&high) * Tree::int(1 << 30) + number(&low)
        },
        Tree::int,
    )
}

/// Returns a sign as text.
pub(super) fn sign_text(sign: Sign) -> &'static str {
    match sign {
        Sign::Negative => "< 0",
        Sign::NonPositive => "≤ 0",
        Sign::Zero => "= 0",
        Sign::NonNegative => "≥ 0",
        Sign::Positive => "> 0",
        Sign::Any => "of any sign",
    }
}

/// Writes factors sorted by name, with the names of the search;
/// [`ProofPrinter::describe`](super::ProofPrinter::describe) uses the order of a registry, and defines the
/// names.
impl fmt::Display for ProofError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&justify(self, &Tree::to_string, &[]))
    }
}

/// Writes the formula, with factors sorted by name.
impl fmt::Debug for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.formula(&[]))
    }
}

/// Allows `?` on the result of a proof.
impl std::error::Error for ProofError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::positive;
    use crate::number::Exact;
    use crate::proof::prove;

    /// Returns a context with the variables 2ᵖ, a and e₁.
    fn context() -> Context {
        let of_rounded = prove(&positive("", Tree::symbol("a").round())).unwrap_err();
        of_rounded.quantity().unwrap().context.as_ref().clone()
    }

    #[test]
    fn integers_of_any_size_are_written_exactly() {
        let context = context();
        let large: Integer = Integer::from(1) << 80;
        for n in [large.clone(), -1 - large, Integer::ZERO, Integer::from(-7)] {
            let q = rug::Rational::from((n, 3));
            let tree = Order { context: &context, factors: &[] }.poly(&Poly::constant(q.clone()));
            assert_eq!(tree.eval(&|_| Exact::int(0), &|_| None), Some(Exact::from(q)));
        }
    }

    #[test]
    fn long_sums_are_replaced_by_their_number_of_terms() {
        let powers =
            |x: Poly, many: usize| (0..many).fold(Poly::zero(), |sum, _| &x * &sum + Poly::constant(1));
        let context = context();
        for (x, shown) in [(1, SHOWN), (2, SHOWN_OF_ROUNDING)] {
            let order = Order { context: &context, factors: &[] };
            let x = Poly::variable(x);
            let [short, long] = [shown, shown + 1].map(|many| powers(x.clone(), many));
            assert_eq!(order.poly_or_size(&short), order.poly(&short).to_string());
            assert_eq!(order.poly_or_size(&long), format!("a sum of {} terms", shown + 1));
            // A quotient is written out if both of its parts are.
            let ratio =
                |num: &Poly, den: &Poly| Ratio::from(num.clone()).checked_div(&den.clone().into()).unwrap();
            let other = |many: usize| Poly::constant(1) + powers(x.clone(), many);
            let both = ratio(&short, &other(shown));
            assert_eq!(order.ratio_or_size(&both), order.ratio(&both).to_string());
            for (num, den) in [(short, other(shown + 1)), (long, other(shown))] {
                let terms = [num.terms().len(), den.terms().len()];
                let text = order.ratio_or_size(&ratio(&num, &den));
                assert_eq!(text, format!("a sum of {} terms over one of {}", terms[0], terms[1]));
            }
        }
    }
}
