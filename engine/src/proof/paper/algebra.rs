//! Polynomials, quotients and certificates as a reader writes them.

use crate::number::{Exponential, Field, Tree};
use crate::proof::Why;
use crate::proof::kernel::Multiple;
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio, Symbol};
use crate::proof::kernel::sign::{Certificate, Known, Rule, Sign};
use crate::proof::search;
use rug::Integer;
use std::fmt;
use std::sync::Arc;

/// The form in which polynomials are written.
#[derive(Clone, Copy, Default)]
pub(super) struct Order<'a> {
    /// The order of the factors of a product, by their symbols. Others come before them, by name.
    pub(super) factors: &'a [&'static str],
    /// Sums are written out however long they are.
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

    /// A monomial as a formula.
    pub(super) fn monomial(&self, monomial: &Monomial) -> Tree {
        self.product(monomial).unwrap_or_else(|| Tree::int(1))
    }

    /// The terms of a sum without their signs, and which of them are negative: these come last.
    fn terms(&self, poly: &Poly) -> impl Iterator<Item = (bool, Tree)> {
        let (added, subtracted): (Vec<_>, Vec<_>) = poly.terms().rev().partition(|(_, q)| q.sign().is_gt());
        added.into_iter().chain(subtracted).map(|(monomial, q)| {
            let q = q.rational();
            let (n, d) = (number(&q.numer().clone().abs()), number(q.denom()));
            let term = match self.product(monomial) {
                Some(product) => n * product,
                None => n,
            };
            (q.is_negative(), if *q.denom() == 1 { term } else { term / d })
        })
    }

    /// A polynomial as a formula.
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

    /// A polynomial as text, however long it is.
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

    /// A quotient as a formula.
    pub(super) fn ratio(&self, ratio: &Ratio) -> Tree {
        let num = self.poly(ratio.num());
        if ratio.den().is_one() { num } else { num / self.poly(ratio.den()) }
    }

    /// Returns the number of terms that are written out.
    fn shown(&self, poly: &Poly) -> usize {
        match poly.symbols().into_iter().any(Symbol::is_small) {
            _ if self.is_full => usize::MAX,
            true => SHOWN_OF_ROUNDING,
            false => SHOWN,
        }
    }

    /// A polynomial as text, of a very long one how long it is.
    pub(super) fn poly_or_size(&self, poly: &Poly) -> String {
        match poly.terms().len() {
            n if n > self.shown(poly) => format!("a sum of {n} terms"),
            _ => self.text(poly),
        }
    }

    /// A quotient as text, of a very long one how long it is.
    pub(super) fn ratio_or_size(&self, ratio: &Ratio) -> String {
        match [ratio.num(), ratio.den()].map(|poly| poly.terms().len()) {
            [n, d] if n > self.shown(ratio.num()) || d > self.shown(ratio.den()) => {
                format!("a sum of {n} terms over one of {d}")
            }
            // A formula has a limit to its length.
            [n, _] if n > SHOWN && ratio.den().is_one() => self.text(ratio.num()),
            [n, d] if n.max(d) > SHOWN => {
                format!("({}) / ({})", self.text(ratio.num()), self.text(ratio.den()))
            }
            _ => self.ratio(ratio).to_string(),
        }
    }

    /// The part of a quotient that has its sign by assumption.
    pub(super) fn kept(&self, less: &Multiple) -> String {
        let part = &less.factor.value * &less.of;
        format!("of which {} has this sign by assumption and the rest", self.ratio_or_size(&part))
    }

    /// Why a polynomial has its sign: one line a rule, the last one first.
    pub(super) fn certificate(&self, certificate: &Certificate) -> Vec<String> {
        let poly = |poly: &Poly| self.poly_or_size(poly);
        let (of, sign) = (poly(certificate.of()), text(certificate.sign()));
        match certificate.rule() {
            Rule::Terms if certificate.of().is_zero() => vec!["0 = 0".to_string()],
            Rule::Terms => vec![format!("{of} {sign}, term by term")],
            Rule::Sizes(rest) => {
                let no = if rest.sign().implies(Sign::NonNegative) { "no less" } else { "no more" };
                let left = format!("{} {}, term by term", poly(rest.of()), text(rest.sign()));
                vec![format!("{of} {sign}: with the sizes of errors it is {no} than {left}")]
            }
            Rule::Ends { x, at } => {
                let x = x.name();
                let mut lines = vec![match at.len() {
                    2 => format!("{of} {sign}, at {x} = −1 and at {x} = 1:"),
                    _ => format!("{of} {sign}, by its Bernstein form in {x} from −1 to 1:"),
                }];
                lines.extend(at.iter().flat_map(|end| self.certificate(end)));
                lines
            }
            Rule::Factor(factor, rest) => {
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
            Rule::Slope { x, start, slope } => {
                let x = x.name();
                let mut lines = vec![format!("{of} {sign}, by its value at {x} = 0 and its slope in {x}:")];
                lines.push(format!("at {x} = 0:"));
                lines.extend(self.certificate(start));
                lines.push(format!("its derivative by {x} has the sign of:"));
                lines.extend(self.certificate(slope));
                lines
            }
        }
    }

    /// Returns which terms of a quotient are not known to have the sign of its denominator, if these are one
    /// or two and not all: `: the term −b is < 0`.
    fn obstacles(&self, value: &Ratio, known: &Arc<Known>) -> String {
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

    /// Why there is no proof, with formulas as `formula` writes them.
    pub(super) fn why(&self, why: &Why, formula: &dyn Fn(&Tree) -> String) -> String {
        let ratio = |ratio: &Ratio| self.ratio_or_size(ratio);
        match why {
            Why::Jump => "rounding has jumps, so nothing is said of limits and derivatives of it".to_string(),
            Why::TooMany => "it rounds more often than there are names for errors".to_string(),
            Why::MightVanish(of, value) if value.is_zero() => format!("the divisor {} is 0", formula(of)),
            Why::MightVanish(of, value) => {
                let is_as_written = value.symbols().into_iter().map(Symbol::name).eq(of.symbols());
                let reduced = if is_as_written { String::new() } else { format!(" = {}", ratio(value)) };
                format!("the divisor {}{reduced} might be 0", formula(of))
            }
            Why::OpenBracket(value) => format!("the sign of {} is open", ratio(value)),
            Why::NoSign(value, known) => {
                format!("no rule finds the sign of {}{}", ratio(value), self.obstacles(value, known))
            }
            Why::WrongSign(value, sign) => format!("{} is {}", ratio(value), text(*sign)),
            Why::Different(value) => format!("the sides differ by {}", ratio(value)),
            Why::NoLimit(value) => format!("no rule finds the limit of {}", ratio(value)),
            Why::Kink => "⟨·⟩ and min have kinks, so no derivative of them is taken".to_string(),
            Why::Reserved(name) => format!("{name} is a name that proofs keep for themselves"),
            Why::TooLarge(what, most) => format!("{what} exceeds the limit of {most} terms"),
            Why::AssumedOfComputed(name) => {
                format!("{name} is computed at each step: nothing may be assumed of it but its interval")
            }
            Why::Nothing => "it says nothing".to_string(),
        }
    }
}

/// As many terms are written out, and as many if there are errors in them.
const SHOWN: usize = 24;
const SHOWN_OF_ROUNDING: usize = 8;

/// A number as a formula; a large one in pieces, since a formula has only small ones.
fn number(n: &Integer) -> Tree {
    n.to_i32().map_or_else(
        || {
            let (high, low) = n.clone().div_rem((1 << 30).into());
            number(&high) * Tree::int(1 << 30) + number(&low)
        },
        Tree::int,
    )
}

/// A sign as a reader writes it.
fn text(sign: Sign) -> &'static str {
    match sign {
        Sign::Negative => "< 0",
        Sign::NonPositive => "≤ 0",
        Sign::Zero => "= 0",
        Sign::NonNegative => "≥ 0",
        Sign::Positive => "> 0",
    }
}

/// With factors by name, and with the kernel's names; [`Paper::why`](super::Paper::why) has them in the order
/// of a registry, and defines its names.
impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&Order::default().why(self, &Tree::to_string))
    }
}

/// So that a proof can be asked for by `?`.
impl std::error::Error for Why {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Exact;

    #[test]
    fn numbers_of_any_size_are_written_as_what_they_are() {
        let large: Integer = Integer::from(1) << 80;
        for n in [large.clone(), -1 - large, Integer::ZERO, Integer::from(-7)] {
            let q = rug::Rational::from((n, 3));
            let tree = Order::default().poly(&Poly::constant(q.clone()));
            assert_eq!(tree.replay(&|_| Exact::int(0), &|_| None), Some(Exact::from(q)));
        }
    }

    #[test]
    fn long_sums_are_counted_and_not_written() {
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
            for (num, den) in [(short, other(shown + 1)), (long, other(shown))] {
                let terms = [num.terms().len(), den.terms().len()];
                let text = order.ratio_or_size(&ratio(&num, &den));
                assert_eq!(text, format!("a sum of {} terms over one of {}", terms[0], terms[1]));
            }
        }
    }
}
