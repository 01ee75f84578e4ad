//! The reasons for which no proof is found, with the names of the search.

use super::ProofPrinter;
use super::text::sign_text;
use crate::formula::Registry;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Statement;
use crate::number::Tree;
use crate::proof::ProofError::{self, *};
use crate::proof::check::Sign;
use crate::proof::search::Quantity;
use crate::proof::search::algebra::{Poly, Ratio};
use crate::proof::search::assumption::AssumptionUse;
use crate::proof::search::choice;
use crate::proof::search::context::Context;
use crate::proof::search::symbol::Symbol;
use std::fmt;

impl ProofPrinter<'_> {
    /// Returns the reason why a proof failed, with definitions of the names of the search: `no
    /// rule finds the sign of a − s₁, because of −s₁, where s₁ = b − a > 0`.
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
        let printer = self.for_statement(statement);
        let message = printer.reason(reason);
        let quantity = reason.quantity().into_iter();
        let variables =
            quantity.flat_map(|of| of.value.variables().into_iter().map(move |x| (x, &of.context)));
        let definitions = variables.filter_map(|(x, context)| {
            let symbol = context.symbol(x).filter(|symbol| !matches!(symbol, Symbol::Own(_)))?;
            let name = symbol.name();
            if message.contains(name) { printer.definition(x, name, context) } else { None }
        });
        let definitions: Vec<_> = definitions.collect();
        let separator = if definitions.is_empty() { "" } else { ", where " };
        message + separator + &definitions.join(" and ")
    }

    /// Returns the definition of a variable of the search other than a symbol of the statement.
    fn definition(&self, x: usize, name: &'static str, context: &Context) -> Option<String> {
        if let Some(Symbol::Error(i)) = context.symbol(x) {
            let of = context.roundings.get(usize::from(i))?;
            let factor = Tree::from(1) + Tree::symbol(name) / (Tree::symbol(PRECISION) + Tree::from(1));
            return Some(format!("{} = {} with |{name}| ≤ 1", self.rounding(of), self.text(&(of * factor))));
        }
        context.assumptions.iter().find_map(|assumption| match (&assumption.usage, &assumption.hypothesis) {
            (AssumptionUse::Variable(slack), Some(hypothesis)) if *slack == x => {
                let value = match assumption.is_divided() {
                    true => self.ratio(&assumption.value, context),
                    false => self.text(&hypothesis.value),
                };
                Some(format!("{name} = {value} {} 0", hypothesis.relation))
            }
            (AssumptionUse::Variable(slack), None) if *slack == x => {
                Some(format!("{name} ≥ 0 in one case of the proof"))
            }
            (AssumptionUse::Interval(parameter), Some(hypothesis)) if *parameter == x => {
                self.parameter(name, hypothesis)
            }
            (AssumptionUse::Size { size, .. }, _) if *size == x => {
                Some(format!("{name} = |{}|", self.ratio(&assumption.value, context)))
            }
            (AssumptionUse::Size { factor, .. }, _) if *factor == x => {
                Some(self.multiple_of_size(&self.ratio(&assumption.value, context), name))
            }
            _ => None,
        })
    }

    /// Returns a polynomial of the search as a formula, if it is short.
    fn poly(&self, of: &Poly, context: &Context) -> Option<Tree> {
        self.sum(of.terms().map(|(monomial, q)| (q.clone(), monomial.powers())), &|x| {
            let symbol = context.symbol(x).map(|symbol| Tree::symbol(symbol.name()));
            symbol.or_else(|| context.exponentials.get(&x).cloned())
        })
    }

    fn quotient(&self, of: &Ratio, context: &Context) -> Option<Tree> {
        Some(self.poly(of.num(), context)? / self.poly(of.den(), context)?)
    }

    /// Formats a quotient of the search, or its shape if it is long.
    fn ratio(&self, of: &Ratio, context: &Context) -> String {
        let shape = [of.num(), of.den()].map(|part| part.terms().len());
        let text = self.quotient(of, context).map(|tree| self.text(&tree));
        text.unwrap_or_else(|| format!("a sum of {} terms over one of {}", shape[0], shape[1]))
    }

    /// Returns the terms of a quotient that are not known to have the sign of its denominator, if there are
    /// one or two and not all: `, because of −b`.
    fn obstacles(&self, Quantity { value, context }: &Quantity) -> Option<String> {
        let den = choice::sign(value.den(), &context.signs)?.sign();
        let terms = value.num().terms().map(|(m, q)| Poly::from_iter([(m.clone(), q.clone())]));
        let (fitting, others): (Vec<_>, Vec<_>) = terms.partition(|term| {
            let sign = choice::sign(term, &context.signs).map(|found| found.sign().times(den));
            sign.is_some_and(|sign| sign.implies(Sign::NON_NEGATIVE))
        });
        let others: Vec<_> = others.iter().map(|term| self.ratio(&term.clone().into(), context)).collect();
        let is_listed = !fitting.is_empty() && others.len() <= 2;
        is_listed.then(|| format!(", because of {}", others.join(" and ")))
    }

    /// Returns the reason without definitions.
    fn reason(&self, reason: &ProofError) -> String {
        let quantity = reason.quantity().map(|of| self.ratio(&of.value, &of.context)).unwrap_or_default();
        match reason {
            Premise(premise) => premise.to_string(),
            PossibleZeroDivisor(of, value) => {
                let is = if value.value.is_zero() { "is" } else { "might be" };
                format!("the divisor {} {is} 0", self.text(of))
            }
            UndecidedBranch(_) => format!("the sign of {quantity} is undecided"),
            UnknownSign(of) => {
                format!("no rule finds the sign of {quantity}{}", self.obstacles(of).unwrap_or_default())
            }
            WrongSign(_, sign) => format!("{quantity} is {}", sign_text(*sign)),
            Unequal(_) => format!("the sides differ by {quantity}"),
            UnknownLimit(_) => format!("no rule finds that {quantity} has the stated limit"),
            EndingHypothesis(of) => {
                let of = self.text(of);
                format!("the hypothesis on {of} is not known to hold for all large values of the variable")
            }
            NotDifferentiable => "⟨·⟩ and min are not differentiable at kinks".to_string(),
            TooLarge(most) => format!("its proof exceeds the limit of {most} terms"),
            NotExpressed(reason) => format!("its proof cannot be checked: {reason}"),
            Refused(refusal) => format!("its proof cannot be checked: the checker refuses it ({refusal:?})"),
        }
    }
}

impl ProofError {
    /// Returns the quantity at which the proof failed.
    pub(in crate::proof) fn quantity(&self) -> Option<&Quantity> {
        match self {
            PossibleZeroDivisor(_, of) | UndecidedBranch(of) | UnknownSign(of) => Some(of),
            WrongSign(of, _) | Unequal(of) | UnknownLimit(of) => Some(of),
            _ => None,
        }
    }
}

/// Writes factors sorted by name, with the names of the search;
/// [`ProofPrinter::describe`](super::ProofPrinter::describe) uses the order of a registry, and defines the
/// names.
impl fmt::Display for ProofError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&ProofPrinter::new(&Registry::default()).reason(self))
    }
}

/// Writes the formula, with factors sorted by name.
impl fmt::Debug for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&ProofPrinter::new(&Registry::default()).ratio(&self.value, &self.context))
    }
}

/// Allows `?` on the result of a proof.
impl std::error::Error for ProofError {}

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
            "no rule finds the sign of 2 s₁ − b, because of −b, where s₁ = b − a > 0"
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
             where nearest(a (b + c)) = a (b + c) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1 and s₁ = 2ᵖ − 4 ≥ 0"
        );
        let message = reason(&equal("", (&a + &b).round(), &a + &b));
        assert!(message.contains("fl(a + b) = (a + b) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1"), "{message}");
        let opposite =
            positive("", &a + &b - &u).assuming(&[a.clone(), b.clone(), u.clone()].map(above_zero));
        assert_eq!(reason(&opposite), "no rule finds the sign of a + b − u, because of −u");
        // A negative divisor reverses the signs.
        let below = positive("", (&a - &u * &u + &b * &c) / (-&a - &b));
        assert_eq!(
            reason(&below.assuming(&[a.clone(), b.clone()].map(above_zero))),
            "no rule finds the sign of (u² − a − b c) / (a + b), because of −b c and −a"
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
            "no rule finds the sign of s₂ + s₁ − 2 s₂ t₂, because of −2 s₂ t₂, \
             where s₂ = |v| and s₁ = |u| and v = t₂ |v| with |t₂| ≤ 1"
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
        assert_eq!(reason(&inverse(&c + &a).assuming([&more])), divisor("c + a might be 0"));
        let equal = Hypothesis::new(Relation::Zero, &a - &b);
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
        let given = above_zero((&a - &b).positive_part() - &b);
        let message = reason(&positive("", &a - Tree::from(2) * &b - Tree::from(1)).assuming([&given]));
        assert!(message.ends_with("where s₂ = ⟨a − b⟩ − b > 0"), "{message}");
    }
}
