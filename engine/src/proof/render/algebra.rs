//! Polynomials, quotients and certificates as text.

use crate::number::{Exponential, Field, Tree};
use crate::proof::ProofError;
use crate::proof::kernel::Multiple;
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio, Symbol};
use crate::proof::kernel::sign::{Certificate, Rule, Sign, SignEnv};
use crate::proof::search;
use rug::Integer;
use std::fmt;
use std::sync::Arc;

/// Form of polynomials.
#[derive(Clone, Copy, Default)]
pub(super) struct Order<'a> {
    /// Order of the factors of a product, by symbols; other factors precede them, sorted by name.
    pub(super) factors: &'a [&'static str],
    /// Whether long sums are written out.
    pub(super) is_full: bool,
}

impl Order<'_> {
    fn product(&self, monomial: &Monomial) -> Option<Tree> {
        let mut powers: Vec<_> = monomial.powers().collect();
        powers.sort_by_key(|(x, _)| self.factors.iter().position(|name| Symbol::Own(name) == *x));
        let powers =
            powers.into_iter().flat_map(|(x, n)| std::iter::repeat_n(Tree::symbol(x.name()), n as usize));
        powers.chain(monomial.exponent().map(|e| self.ratio(e).exp())).reduce(|a, b| a * b)
    }

    /// Returns a monomial as a formula.
    pub(super) fn monomial(&self, monomial: &Monomial) -> Tree {
        self.product(monomial).unwrap_or_else(|| Tree::int(1))
    }

    /// Returns the terms of a sum without their signs, and whether they are negative; negative terms come
    /// last.
    fn terms(&self, poly: &Poly) -> impl Iterator<Item = (bool, Tree)> {
        let (added, subtracted): (Vec<_>, Vec<_>) = poly.terms().rev().partition(|(_, q)| q.sign().is_gt());
        added.into_iter().chain(subtracted).map(|(monomial, q)| {
            let q = q.to_rational();
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
        let sum = self.terms(poly).fold(None, |sum, (is_negative, term)| {
            Some(match (sum, is_negative) {
                (None, false) => term,
                (None, true) => -term,
                (Some(sum), false) => sum + term,
                (Some(sum), true) => sum - term,
            })
        });
        sum.unwrap_or_else(|| Tree::int(0))
    }

    /// Formats a polynomial in full.
    fn text(&self, poly: &Poly) -> String {
        let mut text = String::new();
        for (is_negative, term) in self.terms(poly) {
            let sign = match (text.is_empty(), is_negative) {
                (true, false) => "",
                (true, true) => "−",
                (false, false) => " + ",
                (false, true) => " − ",
            };
            text = text + sign + &term.to_string();
        }
        if text.is_empty() { "0".to_string() } else { text }
    }

    /// Returns a quotient as a formula.
    pub(super) fn ratio(&self, ratio: &Ratio) -> Tree {
        let num = self.poly(ratio.num());
        if ratio.den().is_one() { num } else { num / self.poly(ratio.den()) }
    }

    /// Returns the number of terms that are written out.
    fn shown(&self, poly: &Poly) -> usize {
        match poly.symbols().into_iter().any(Symbol::in_unit_interval) {
            _ if self.is_full => usize::MAX,
            true => SHOWN_OF_ROUNDING,
            false => SHOWN,
        }
    }

    /// Formats a polynomial, or the number of its terms if it is very long.
    pub(super) fn poly_or_size(&self, poly: &Poly) -> String {
        match poly.terms().len() {
            n if n > self.shown(poly) => format!("a sum of {n} terms"),
            _ => self.text(poly),
        }
    }

    /// Formats a quotient, or its size if it is very long.
    pub(super) fn ratio_or_size(&self, ratio: &Ratio) -> String {
        match [ratio.num(), ratio.den()].map(|poly| poly.terms().len()) {
            [n, d] if n > self.shown(ratio.num()) || d > self.shown(ratio.den()) => {
                format!("a sum of {n} terms over one of {d}")
            }
            _ if ratio.den().is_one() => self.text(ratio.num()),
            // The depth of a formula is limited.
            [n, d] if n.max(d) > SHOWN => {
                format!("({}) / ({})", self.text(ratio.num()), self.text(ratio.den()))
            }
            _ => self.ratio(ratio).to_string(),
        }
    }

    /// Formats the part of a quotient whose sign is assumed.
    pub(super) fn subtracted_multiple(&self, less: &Multiple) -> String {
        let part = &less.factor.value * &less.of;
        format!("of which {} has this sign by assumption and the rest", self.ratio_or_size(&part))
    }

    /// Explains the sign of a polynomial: one line for each rule, the last rule first.
    pub(super) fn certificate(&self, certificate: &Certificate) -> Vec<String> {
        let poly = |poly: &Poly| self.poly_or_size(poly);
        let (of, sign) = (poly(certificate.of()), text(certificate.sign()));
        match certificate.rule() {
            Rule::Termwise if certificate.of().is_zero() => vec!["0 = 0".to_string()],
            Rule::Termwise => vec![format!("{of} {sign}, term by term")],
            Rule::TriangleInequality(rest) => {
                let no = if rest.sign().implies(Sign::NonNegative) { "no less" } else { "no more" };
                let left = format!("{} {}, term by term", poly(rest.of()), text(rest.sign()));
                vec![format!("{of} {sign}: by the triangle inequality for the errors it is {no} than {left}")]
            }
            Rule::Endpoints { x, at } => {
                let x = x.name();
                let mut lines = vec![match at.len() {
                    2 => format!("{of} {sign}, at {x} = −1 and at {x} = 1:"),
                    _ => format!("{of} {sign}, by its Bernstein form in {x} from −1 to 1:"),
                }];
                lines.extend(at.iter().flat_map(|end| self.certificate(end)));
                lines
            }
            Rule::Product(factor, rest) => {
                let mut lines =
                    vec![format!("{of} = ({}) ({}) {sign}, since", poly(factor.of()), poly(rest.of()))];
                if factor.of().terms().len() > 1 {
                    lines.extend(self.certificate(factor));
                }
                lines.extend(self.certificate(rest));
                lines
            }
            Rule::Square { leading, root, rest } => {
                let (a, root, d) = (poly(leading.of()), poly(root), poly(rest.of()));
                let mut lines = vec![format!("4 ({a}) ({of}) = ({root})² + ({d}), hence {of} {sign}, since")];
                lines.extend(self.certificate(leading));
                lines.extend(self.certificate(rest));
                lines
            }
            Rule::MeanValue { x, start, slope } => {
                let x = x.name();
                let mut lines = vec![format!("{of} {sign}, by its value at {x} = 0 and its slope in {x}:")];
                lines.push(format!("at {x} = 0:"));
                lines.extend(self.certificate(start));
                lines.push(format!("its derivative with respect to {x} has the sign of:"));
                lines.extend(self.certificate(slope));
                lines
            }
        }
    }

    /// Returns the terms of a quotient that are not known to have the sign of its denominator, if there are
    /// one or two and not all: `: the term −b is < 0`.
    fn obstacles(&self, value: &Ratio, known: &Arc<SignEnv>) -> String {
        let sign = |part: &Poly| search::sign(part, known).map(|found| found.sign());
        let Some(den) = sign(value.den()) else { return String::new() };
        let terms = value.num().terms().map(|(m, q)| Poly::from_iter([(m.clone(), q.clone())]));
        let with_signs = terms.map(|term| (sign(&term), term));
        let fits = |sign: &Option<Sign>| sign.is_some_and(|s| s.times(den).implies(Sign::NonNegative));
        let (fitting, others): (Vec<_>, Vec<_>) = with_signs.partition(|(sign, _)| fits(sign));
        if fitting.is_empty() || others.len() > 2 {
            return String::new();
        }
        let described = others.iter().map(|(sign, term)| match sign {
            Some(sign) => format!("the term {} is {}", self.poly_or_size(term), text(*sign)),
            None => format!("the sign of the term {} is unknown", self.poly_or_size(term)),
        });
        format!(": {}", described.collect::<Vec<_>>().join(" and "))
    }

    /// Explains a failed proof, with formulas formatted by `formula`.
    pub(super) fn justify(&self, reason: &ProofError, formula: &dyn Fn(&Tree) -> String) -> String {
        let ratio = |ratio: &Ratio| self.ratio_or_size(ratio);
        match reason {
            ProofError::Discontinuous => {
                "rounding is discontinuous, so limits and derivatives of it are not supported".to_string()
            }
            ProofError::TooManyRoundings => {
                "it has more roundings than there are names for errors".to_string()
            }
            ProofError::PossibleZeroDivisor(of, value) if value.is_zero() => {
                format!("the divisor {} is 0", formula(of))
            }
            ProofError::PossibleZeroDivisor(of, value) => {
                let is_as_written = value.symbols().into_iter().map(Symbol::name).eq(of.symbols());
                let reduced = if is_as_written { String::new() } else { format!(" = {}", ratio(value)) };
                format!("the divisor {}{reduced} might be 0", formula(of))
            }
            ProofError::UndecidedBranch(value) | ProofError::UndecidedSize(_, value) => {
                format!("the sign of {} is undecided", ratio(value))
            }
            ProofError::UnknownSign(value, known) => {
                format!("no rule finds the sign of {}{}", ratio(value), self.obstacles(value, known))
            }
            ProofError::WrongSign(value, sign) => format!("{} is {}", ratio(value), text(*sign)),
            ProofError::Unequal(value) => format!("the sides differ by {}", ratio(value)),
            ProofError::UnknownLimit(value) => format!("no rule finds the limit of {}", ratio(value)),
            ProofError::NotDifferentiable => "⟨·⟩ and min are not differentiable at kinks".to_string(),
            ProofError::ReservedName(name) => format!("{name} is a reserved name of proofs"),
            ProofError::TooLarge(what, most) => format!("{what} exceeds the limit of {most} terms"),
            ProofError::HypothesisOnComputed(name) => {
                format!("{name} is computed at each step: only its interval may be assumed")
            }
            ProofError::NoGoals => "it has no goals".to_string(),
        }
    }
}

/// Largest number of terms written out, and of terms with rounding errors.
const SHOWN: usize = 24;
const SHOWN_OF_ROUNDING: usize = 8;

/// Returns a number as a formula; a large one as a product of small ones.
fn number(n: &Integer) -> Tree {
    n.to_i32().map_or_else(
        || {
            let (high, low) = n.clone().div_rem((1 << 30).into());
            number(&high) * Tree::int(1 << 30) + number(&low)
        },
        Tree::int,
    )
}

/// Returns a sign as text.
fn text(sign: Sign) -> &'static str {
    match sign {
        Sign::Negative => "< 0",
        Sign::NonPositive => "≤ 0",
        Sign::Zero => "= 0",
        Sign::NonNegative => "≥ 0",
        Sign::Positive => "> 0",
    }
}

/// Writes factors sorted by name, with the kernel's names;
/// [`ProofPrinter::describe`](super::ProofPrinter::describe) uses the order of a registry, and defines the
/// names.
impl fmt::Display for ProofError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&Order::default().justify(self, &Tree::to_string))
    }
}

/// Allows `?` on the result of a proof.
impl std::error::Error for ProofError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Exact;

    #[test]
    fn integers_of_any_size_are_written_exactly() {
        let large: Integer = Integer::from(1) << 80;
        for n in [large.clone(), -1 - large, Integer::ZERO, Integer::from(-7)] {
            let q = rug::Rational::from((n, 3));
            let tree = Order::default().poly(&Poly::constant(q.clone()));
            assert_eq!(tree.eval(&|_| Exact::int(0), &|_| None), Some(Exact::from(q)));
        }
    }

    #[test]
    fn long_sums_are_replaced_by_their_number_of_terms() {
        let powers =
            |x: Poly, many: usize| (0..many).fold(Poly::zero(), |sum, _| &x * &sum + Poly::constant(1));
        for (x, shown) in [(Symbol::Own("a"), SHOWN), (Symbol::Error(0), SHOWN_OF_ROUNDING)] {
            let order = Order::default();
            let x = Poly::symbol(x);
            let [short, long] = [shown, shown + 1].map(|many| powers(x.clone(), many));
            assert_eq!(order.poly_or_size(&short), order.poly(&short).to_string());
            assert_eq!(order.poly_or_size(&long), format!("a sum of {} terms", shown + 1));
            // A quotient is written out if both of its parts are.
            let ratio = |num: &Poly, den: &Poly| Ratio::from(num.clone()).over(&den.clone().into()).unwrap();
            let other = |many: usize| Poly::constant(1) + powers(x.clone(), many);
            let both = ratio(&short, &other(shown));
            assert_eq!(order.ratio_or_size(&both), order.ratio(&both).to_string());
            let full = Order { is_full: true, ..order };
            assert_eq!(full.poly_or_size(&long), order.poly(&long).to_string());
            let b = Poly::symbol(Symbol::Own("b"));
            let by_symbol = ratio(&short, &b);
            assert_eq!(full.ratio_or_size(&by_symbol), order.ratio(&by_symbol).to_string());
            let longest = &powers(x.clone(), 32) * &powers(b.clone(), 32);
            for (num, den) in [(&longest, &b), (&b, &longest)] {
                let parts = [num, den].map(|part| full.text(part));
                assert_eq!(full.ratio_or_size(&ratio(num, den)), format!("({}) / ({})", parts[0], parts[1]));
            }
            assert_eq!(full.ratio_or_size(&longest.clone().into()), full.text(&longest));
            for (num, den) in [(short, other(shown + 1)), (long, other(shown))] {
                let terms = [num.terms().len(), den.terms().len()];
                let text = order.ratio_or_size(&ratio(&num, &den));
                assert_eq!(text, format!("a sum of {} terms over one of {}", terms[0], terms[1]));
            }
        }
    }
}
