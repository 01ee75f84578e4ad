//! Definitions of the names of the search in a message.

use super::ProofPrinter;
use super::text::{Order, justify};
use crate::formula::claim::PRECISION;
use crate::formula::name_of_rounding;
use crate::formula::statement::Statement;
use crate::number::Tree;
use crate::proof::ProofError;
use crate::proof::search::Quantity;
use crate::proof::search::assumption::AssumptionUse;
use crate::proof::search::context::Context;
use crate::proof::search::symbol::Symbol;

impl ProofPrinter<'_> {
    /// Returns the reason why a proof failed, with definitions of the names of the search: `no
    /// rule finds the sign of a − s₁: the term −s₁ is < 0, where s₁ = b − a > 0`.
    ///
    /// # Examples
    /// ```
    /// use provable::formula::{Hypothesis, Registry, Relation, claim::positive};
    /// use provable::proof::{render::ProofPrinter, prove};
    /// let [f, g] = ["f", "g"].map(|name| provable::number::Tree::symbol(name));
    /// let converging = Hypothesis::new(Relation::Positive, f.clone());
    /// let claim = positive("real image", &f * &g / (&g - &f)).assuming([&converging]);
    /// assert_eq!(
    ///     ProofPrinter::new(&Registry::default()).describe(&claim, &prove(&claim).unwrap_err()),
    ///     "the divisor g − f might be 0"
    /// );
    /// ```
    pub fn describe(&self, statement: &Statement, reason: &ProofError) -> String {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter::new(&registry).describe(statement, reason);
        }
        let message = justify(reason, &|tree| self.text(tree), self.registry.factors());
        let mut definitions = Vec::new();
        let quantity = reason.quantity();
        for (of, symbol) in quantity.into_iter().flat_map(|of| of.symbols().into_iter().map(move |x| (of, x)))
        {
            if !message.contains(symbol.name()) {
                continue;
            }
            match symbol {
                Symbol::Own(_) => {}
                Symbol::Error(i) => {
                    let rounded = of.context.roundings.get(usize::from(i));
                    definitions.extend(rounded.map(|of| self.error(symbol.name(), of)));
                }
                Symbol::Slack(_) | Symbol::IntervalParameter(_) => {
                    let of_case = format!("{} ≥ 0 in one case of the proof", symbol.name());
                    definitions.push(self.definition(symbol, &of.context).unwrap_or(of_case));
                }
            }
        }
        if definitions.is_empty() {
            return message;
        }
        format!("{message}, where {}", definitions.join(" and "))
    }

    /// Defines an error: `fl(a b) = (a b) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1`.
    fn error(&self, error: &str, of: &Tree) -> String {
        let factor = of.raised("", &|tree| self.registry.call_name(tree));
        let (name, of) = (name_of_rounding(of), self.text(of));
        format!("{name}({of}) = {factor} (1 + {error} / ({PRECISION} + 1)) with |{error}| ≤ 1")
    }

    /// Returns the definition of a symbol that an assumption introduces, unless the assumption is a case.
    fn definition(&self, symbol: Symbol, context: &Context) -> Option<String> {
        let order = Order { context, factors: self.registry.factors() };
        context.assumptions.iter().find_map(|assumption| match &assumption.usage {
            AssumptionUse::Pivot(_, _, Some(slack)) if context.symbol(*slack) == Some(symbol) => {
                let hypothesis = assumption.hypothesis.as_ref()?;
                let quotient = assumption.divisor.as_ref().and_then(|by| assumption.value.checked_div(by));
                let value = quotient.map(|value| order.ratio_or_size(&value));
                let value = value.unwrap_or_else(|| self.text(&hypothesis.value));
                Some(format!("{} = {value} {} 0", symbol.name(), hypothesis.relation))
            }
            AssumptionUse::Interval(parameter) if context.symbol(*parameter) == Some(symbol) => {
                let (x, lower, upper) = assumption.hypothesis.as_ref()?.interval()?;
                let (name, lower, upper) = (symbol.name(), self.text(lower), self.text(upper));
                Some(format!("{name} goes from −1 to 1 as {x} goes from {lower} to {upper}"))
            }
            AssumptionUse::Size { size, .. } if context.symbol(*size) == Some(symbol) => {
                Some(format!("{} = |{}|", symbol.name(), order.ratio_or_size(&assumption.value)))
            }
            AssumptionUse::Size { factor, .. } if context.symbol(*factor) == Some(symbol) => {
                let (of, factor) = (order.ratio_or_size(&assumption.value), symbol.name());
                Some(format!("{of} = {factor} |{of}| with |{factor}| ≤ 1"))
            }
            _ => None,
        })
    }
}

impl ProofError {
    /// Returns the quantity at which the proof failed.
    pub(in crate::proof) fn quantity(&self) -> Option<&Quantity> {
        match self {
            ProofError::PossibleZeroDivisor(_, value)
            | ProofError::UndecidedBranch(value)
            | ProofError::UnknownSign(value)
            | ProofError::WrongSign(value, _)
            | ProofError::Unequal(value)
            | ProofError::UnknownLimit(value) => Some(value),
            ProofError::NotDifferentiable
            | ProofError::EndingHypothesis(_)
            | ProofError::Premise(_)
            | ProofError::TooLarge(_)
            | ProofError::Refused(_)
            | ProofError::NotExpressed(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{Rate, equal, limit, positive, within};
    use crate::formula::{Formula, Hypothesis, Registry, Relation};
    use crate::number::PositivePart;
    use crate::proof::prove;

    fn reason(claim: &Statement) -> String {
        let statement = claim;
        ProofPrinter::new(&Registry::default()).describe(statement, &prove(statement).unwrap_err())
    }

    #[test]
    fn a_message_defines_the_names_of_the_search() {
        let [a, b, c, u] = ["a", "b", "c", "u"].map(|name| Tree::symbol(name));
        let more = Hypothesis::new(Relation::Positive, &b - &a);
        let least = Hypothesis::new(Relation::NonNegative, &a * &b - &c);
        assert_eq!(
            reason(&positive("", &b - Tree::from(2) * &a).assuming([&more])),
            "no rule finds the sign of 2 s₁ − b: the sign of the term −b is unknown, where s₁ = b − a > 0"
        );
        assert_eq!(
            reason(&positive("", &c - &b).assuming([&more, &least])),
            "no rule finds the sign of b² − b s₁ − b − s₂, where s₁ = b − a > 0 and s₂ = a b − c ≥ 0"
        );
        let near = Hypothesis::near(&u, &a, &b);
        assert_eq!(
            reason(&positive("", &u).assuming([&near])),
            "no rule finds the sign of a + b t₁, where t₁ goes from −1 to 1 as u goes from a − b to a + b"
        );
        assert_eq!(
            reason(&equal("", (&a * (&b + &c)).round(), &a * (&b + &c))),
            "the sides differ by (a b e₁ + a c e₁) / (s₁ + 5), \
             where nearest(a (b + c)) = (a (b + c)) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1 and s₁ = 2ᵖ − 4 ≥ 0"
        );
        let message = reason(&equal("", (&a + &b).round(), &a + &b));
        assert!(message.contains("fl(a + b) = (a + b) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1"), "{message}");
        let opposite =
            positive("", &a + &b - &u).assuming(&[a.clone(), b.clone(), u.clone()].map(above_zero));
        assert_eq!(reason(&opposite), "no rule finds the sign of a + b − u: the term −u is < 0");
        // A negative divisor reverses the signs.
        let below = positive("", (&a - &u * &u + &b * &c) / (-&a - &b));
        assert_eq!(
            reason(&below.assuming(&[a.clone(), b.clone()].map(above_zero))),
            "no rule finds the sign of (u² − a − b c) / (a + b): \
             the sign of the term −b c is unknown and the term −a is < 0"
        );
        // There is nothing to define.
        assert_eq!(reason(&equal("", &a, &b)), "the sides differ by a − b");
    }

    /// Each is that of its own quantity.
    #[test]
    fn parameters_of_intervals_and_absolute_values_are_defined() {
        let [a, b, c, u, v] = ["a", "b", "c", "u", "v"].map(|name| Tree::symbol(name));
        let intervals = [Hypothesis::near(&u, &a, &b), Hypothesis::near(&v, &a, &c)];
        assert_eq!(
            reason(&positive("", &v).assuming(&intervals)),
            "no rule finds the sign of a + c t₂, where t₂ goes from −1 to 1 as v goes from a − c to a + c"
        );
        assert_eq!(
            reason(&within("", Tree::from(2) * &v, u.abs() + v.abs())),
            "no rule finds the sign of s₂ + s₁ − 2 s₂ t₂: the sign of the term −2 s₂ t₂ is unknown, \
             where s₁ = |u| and s₂ = |v| and v = t₂ |v| with |t₂| ≤ 1"
        );
    }

    fn above_zero(value: Tree) -> Hypothesis {
        Hypothesis::new(Relation::Positive, value)
    }

    #[test]
    fn a_divisor_is_written_as_in_the_claim() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let inverse = |of: Tree| positive("", Tree::from(1) / of);
        let more = above_zero(&a - &b);
        let divisor = |text: &str| format!("the divisor {text}");
        assert_eq!(reason(&inverse(&b + (&c + &a))), divisor("b + c + a might be 0"));
        assert_eq!(
            reason(&inverse(&c + &a).assuming([&more])),
            divisor("c + a = b + c + s₁ might be 0, where s₁ = a − b > 0")
        );
        let equal = Hypothesis::new(Relation::Zero, &a - &b);
        assert_eq!(reason(&inverse(&a - &c).assuming([&equal])), divisor("a − c = b − c might be 0"));
        assert_eq!(reason(&inverse(&a - &b).assuming([&equal])), divisor("a − b is 0"));
        assert_eq!(reason(&inverse(&a - &a)), divisor("a − a is 0"));
        // With the names of a registry.
        let spring = Formula::new("spring", "k", &["a", "b"], product(&a, &b)).abbreviated();
        let registry = Registry::new(&["a", "b"], vec![spring]);
        let claim = inverse(product(&a, &b));
        let reason = prove(&claim).unwrap_err();
        assert_eq!(ProofPrinter::new(&registry).describe(&claim, &reason), divisor("k might be 0"));
    }

    fn product(a: &Tree, b: &Tree) -> Tree {
        a * b
    }

    #[test]
    fn a_divided_hypothesis_and_one_on_the_variable_of_a_limit_are_defined() {
        let [k, f, g] = ["k", "f", "g"].map(|name| Tree::symbol(name));
        let bounds = [above_zero(k.clone()), above_zero(Tree::from(1) - &k)];
        let message = reason(&positive("", Tree::from(2) * &k - Tree::from(1)).assuming(bounds.each_ref()));
        assert!(message.contains("s₁ = (1 − k) / k > 0"), "{message}");
        let of = &g * &g / (&g - &f);
        let message =
            reason(&limit("", of.clone(), &g, &f, Rate::Equal(of - &f)).assuming([&above_zero(&g - &f)]));
        assert!(message.contains("s₁ = g − f > 0"), "{message}");
        // What is known of other symbols comes first.
        let [h, of] = [Tree::symbol("h"), (&g - Tree::symbol("h")) * &k + &g];
        let bounds = [&g - &f, &g - &h, &k - &f].map(above_zero);
        let message = reason(&limit("", of.clone(), &g, &f, Rate::Equal(of - &f)).assuming(&bounds));
        assert!(message.ends_with("where s₁ = k − f > 0 and s₂ = g − f > 0 and s₃ = g − h > 0"), "{message}");
    }

    #[test]
    fn a_name_introduced_by_a_case_is_described_as_such() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let message = reason(&positive("", (&a - &b).positive_part() + &b));
        assert!(message.ends_with("where s₁ ≥ 0 in one case of the proof"), "{message}");
    }
}
