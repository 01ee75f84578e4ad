//! Definitions of the names that a message has from the kernel and a reader from nowhere.

use super::Paper;
use crate::formula::claim::PRECISION;
use crate::formula::name_of_rounding;
use crate::formula::statement::{Goal, Proposition, Role, Statement};
use crate::number::Tree;
use crate::proof::hints::sufficient;
use crate::proof::kernel::algebra::Symbol;
use crate::proof::kernel::{Derivation, Supposed, Used, Why, derivation, roundings};
use std::collections::{BTreeMap, BTreeSet};

impl Paper<'_> {
    /// Why there is no proof of a statement, with the definitions of the names that are not its own:
    /// `no rule finds the sign of a − s₁: the term −s₁ is < 0, where s₁ = b − a > 0`.
    pub fn why(&self, statement: &Statement, why: &Why) -> String {
        if let Some(registry) = self.other_names(statement) {
            return Paper { registry: &registry, ..*self }.why(statement, why);
        }
        let said = self.order().why(why, &|tree| self.text(tree));
        let (rounded, mut supposed) = (roundings(statement.trees()), None);
        let mut definitions = Vec::new();
        for symbol in why.symbols().into_iter().filter(|symbol| said.contains(symbol.name())) {
            match symbol {
                Symbol::Own(_) => {}
                Symbol::Error(i) => {
                    definitions.extend(rounded.get(usize::from(i)).map(|of| self.error(symbol.name(), of)));
                }
                Symbol::Slack(_) | Symbol::Place(_) => {
                    let supposed = supposed.get_or_insert_with(|| self.supposed_names(statement));
                    let known = supposed.get(&symbol).and_then(Option::clone);
                    let of_case = || format!("{} ≥ 0 is what a case of the proof is about", symbol.name());
                    definitions.push(known.unwrap_or_else(of_case));
                }
            }
        }
        if definitions.is_empty() { said } else { format!("{said}, where {}", definitions.join(" and ")) }
    }

    /// Returns the reason why there is no proof, and up to three [hypotheses](sufficient) with which there is
    /// one.
    ///
    /// # Examples
    /// ```
    /// use provable::formula::{Hypothesis, Registry, Relation, claim::positive};
    /// use provable::proof::{paper::Paper, prove};
    /// let [f, g] = ["f", "g"].map(|name| provable::number::Tree::symbol(name));
    /// let converging = Hypothesis::new(Relation::Positive, f.clone());
    /// let claim = positive("real image", &f * &g / (&g - &f)).assuming([&converging]);
    /// assert_eq!(
    ///     Paper::new(&Registry::default()).explain(&claim, &prove(&claim).unwrap_err()),
    ///     "the divisor g − f might be 0; it is proved if g > f or if g < 0"
    /// );
    /// ```
    pub fn explain(&self, statement: &Statement, why: &Why) -> String {
        if let Some(registry) = self.other_names(statement) {
            return Paper { registry: &registry, ..*self }.explain(statement, why);
        }
        let hypotheses = self.registry.all_supposed(&sufficient(statement, why));
        let hint = if hypotheses.is_empty() { "" } else { "; it is proved if " };
        self.why(statement, why) + hint + &hypotheses.join(" or if ")
    }

    /// `fl(a b) = (a b) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1`
    fn error(&self, error: &str, of: &Tree) -> String {
        let factor = of.raised("", &|tree| self.registry.named(tree));
        let (name, of) = (name_of_rounding(of), self.text(of));
        format!("{name}({of}) = {factor} (1 + {error} / ({PRECISION} + 1)) with |{error}| ≤ 1")
    }

    /// The names that hypotheses bring, with their definitions; `None` if a name has several, in different
    /// cases.
    fn supposed_names(&self, statement: &Statement) -> BTreeMap<Symbol, Option<String>> {
        let derive =
            |role: Role, proposition: &Proposition| derivation(&statement.hypotheses_for(role), proposition);
        let fails = |goal: &&Goal| derive(goal.role, &goal.proposition).is_err();
        let mut all = BTreeMap::new();
        // Hypotheses are read before the goal, so another goal has the same names.
        let derivation = statement.goals().iter().find(fails).and_then(|goal| {
            let zero = || Tree::from(0);
            let trivial = match goal.proposition {
                Proposition::Limit(_, by, _) => Proposition::Limit(zero(), by, zero()),
                _ => Proposition::Equal(zero(), zero()),
            };
            derive(goal.role, &trivial).ok()
        });
        derivation.iter().for_each(|derivation| self.collect(derivation, &mut all));
        all
    }

    fn collect(&self, derivation: &Derivation, all: &mut BTreeMap<Symbol, Option<String>>) {
        match derivation {
            Derivation::Cases(_, positive, not) => {
                [positive, not].into_iter().for_each(|case| self.collect(case, all));
            }
            Derivation::Direct(direct) => {
                for (name, definition) in direct.supposed.iter().filter_map(|s| self.definition(s)) {
                    let known = all.entry(name).or_insert_with(|| definition.clone());
                    if *known != definition {
                        *known = None;
                    }
                }
            }
        }
    }

    /// The symbol that a supposition brings, and its definition if it is a hypothesis.
    fn definition(&self, supposed: &Supposed) -> Option<(Symbol, Option<String>)> {
        match &supposed.used {
            Used::Pivot(_, _, Some(slack)) => {
                let definition = supposed.given.as_ref().map(|given| {
                    let quotient = supposed.divided_by.as_ref().and_then(|by| supposed.value.over(by));
                    let value = quotient.map(|value| self.order().ratio_or_size(&value));
                    let value = value.unwrap_or_else(|| self.text(&given.value));
                    format!("{} = {value} {} 0", slack.name(), given.relation)
                });
                Some((*slack, definition))
            }
            Used::Between(x, _, place) => {
                let definition =
                    supposed.given.as_ref().and_then(|given| given.interval()).map(|(_, lower, upper)| {
                        let (lower, upper) = (self.text(lower), self.text(upper));
                        format!(
                            "{} goes from −1 to 1 as {} goes from {lower} to {upper}",
                            place.name(),
                            x.name()
                        )
                    });
                Some((*place, definition))
            }
            _ => None,
        }
    }
}

impl Why {
    /// Returns the symbols of the quantity that the proof ends at.
    fn symbols(&self) -> BTreeSet<Symbol> {
        match self {
            Why::MightVanish(_, value)
            | Why::OpenBracket(value)
            | Why::NoSign(value, _)
            | Why::WrongSign(value, _)
            | Why::Different(value)
            | Why::NoLimit(value) => value.symbols(),
            Why::Kink
            | Why::Jump
            | Why::TooMany
            | Why::Reserved(_)
            | Why::AssumedOfComputed(_)
            | Why::TooLarge(..)
            | Why::Nothing => BTreeSet::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{Rate, equal, limit, positive};
    use crate::formula::{Formula, Hypothesis, Registry, Relation};
    use crate::number::PositivePart;
    use crate::proof::prove;

    fn why(claim: &Statement) -> String {
        let statement = claim;
        Paper::new(&Registry::default()).why(statement, &prove(statement).unwrap_err())
    }

    #[test]
    fn a_message_defines_the_names_of_the_kernel() {
        let [a, b, c, u] = ["a", "b", "c", "u"].map(|name| Tree::symbol(name));
        let more = Hypothesis::new(Relation::Positive, &b - &a);
        let least = Hypothesis::new(Relation::NonNegative, &a * &b - &c);
        assert_eq!(
            why(&positive("", &b - Tree::from(2) * &a).assuming([&more])),
            "no rule finds the sign of 2 s₁ − b: the sign of the term −b is unknown, where s₁ = b − a > 0"
        );
        assert_eq!(
            why(&positive("", &c - &b).assuming([&more, &least])),
            "no rule finds the sign of b² − b s₁ − b − s₂, where s₁ = b − a > 0 and s₂ = a b − c ≥ 0"
        );
        let near = Hypothesis::near(&u, &a, &b);
        assert_eq!(
            why(&positive("", &u).assuming([&near])),
            "no rule finds the sign of a + b t₁, where t₁ goes from −1 to 1 as u goes from a − b to a + b"
        );
        assert_eq!(
            why(&equal("", (&a * (&b + &c)).nearest(), &a * (&b + &c))),
            "the sides differ by (a b e₁ + a c e₁) / (s₁ + 5), \
             where nearest(a (b + c)) = (a (b + c)) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1 and s₁ = 2ᵖ − 4 ≥ 0"
        );
        let said = why(&equal("", (&a + &b).nearest(), &a + &b));
        assert!(said.contains("fl(a + b) = (a + b) (1 + e₁ / (2ᵖ + 1)) with |e₁| ≤ 1"), "{said}");
        let opposite =
            positive("", &a + &b - &u).assuming(&[a.clone(), b.clone(), u.clone()].map(above_zero));
        assert_eq!(why(&opposite), "no rule finds the sign of a + b − u: the term −u is < 0");
        // A negative divisor turns the signs round.
        let below = positive("", (&a - &u * &u + &b * &c) / (-&a - &b));
        assert_eq!(
            why(&below.assuming(&[a.clone(), b.clone()].map(above_zero))),
            "no rule finds the sign of (u² − a − b c) / (a + b): \
             the sign of the term −b c is unknown and the term −a is < 0"
        );
        // Nothing to define.
        assert_eq!(why(&equal("", &a, &b)), "the sides differ by a − b");
    }

    fn above_zero(value: Tree) -> Hypothesis {
        Hypothesis::new(Relation::Positive, value)
    }

    #[test]
    fn a_divisor_is_written_as_it_stands_in_the_claim() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let inverse = |of: Tree| positive("", Tree::from(1) / of);
        let more = above_zero(&a - &b);
        let divisor = |text: &str| format!("the divisor {text}");
        assert_eq!(why(&inverse(&b + (&c + &a))), divisor("b + c + a might be 0"));
        assert_eq!(
            why(&inverse(&c + &a).assuming([&more])),
            divisor("c + a = b + c + s₁ might be 0, where s₁ = a − b > 0")
        );
        let equal = Hypothesis::new(Relation::Zero, &a - &b);
        assert_eq!(why(&inverse(&a - &c).assuming([&equal])), divisor("a − c = b − c might be 0"));
        assert_eq!(why(&inverse(&a - &b).assuming([&equal])), divisor("a − b is 0"));
        assert_eq!(why(&inverse(&a - &a)), divisor("a − a is 0"));
        // With the names of a registry.
        let spring = Formula::new("spring", "k", &["a", "b"], product(&a, &b)).folded();
        let registry = Registry::new(&["a", "b"], vec![spring]);
        let claim = inverse(product(&a, &b));
        let why = prove(&claim).unwrap_err();
        assert_eq!(Paper::new(&registry).why(&claim, &why), divisor("k might be 0"));
    }

    fn product(a: &Tree, b: &Tree) -> Tree {
        a * b
    }

    #[test]
    fn a_divided_hypothesis_and_one_on_the_variable_of_a_limit_are_defined() {
        let [k, f, g] = ["k", "f", "g"].map(|name| Tree::symbol(name));
        let bounds = [above_zero(k.clone()), above_zero(Tree::from(1) - &k)];
        let said = why(&positive("", Tree::from(2) * &k - Tree::from(1)).assuming(bounds.each_ref()));
        assert!(said.contains("s₁ = (1 − k) / k > 0"), "{said}");
        let of = &g * &g / (&g - &f);
        let said =
            why(&limit("", of.clone(), &g, &f, Rate::Exactly(of - &f)).assuming([&above_zero(&g - &f)]));
        assert!(said.contains("s₁ = g − f > 0"), "{said}");
    }

    #[test]
    fn a_name_of_a_case_is_said_to_be_one() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let said = why(&positive("", (&a - &b).positive_part() + &b));
        assert!(said.ends_with("where s₁ ≥ 0 is what a case of the proof is about"), "{said}");
    }

    /// The kernel's names for errors, in a proof that it makes: those of hypotheses come first.
    #[test]
    fn errors_are_named_in_the_order_in_which_they_are_rounded() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let given = Hypothesis::new(Relation::NonNegative, (&a + &b).nearest());
        let of = (&a * (&a + &b) - &b).rounded();
        let statement = equal("", of.clone() * b.nearest(), b.nearest() * of).assuming([&given]);
        let proof = prove(&statement).unwrap();
        let Derivation::Direct(direct) = &proof.goals()[0] else { panic!("no cases") };
        let named: Vec<_> = direct.errors.iter().map(|rounding| (rounding.error, &rounding.of)).collect();
        let rounded = roundings(statement.trees());
        let expected: Vec<_> = (0..).map(Symbol::Error).zip(&rounded).collect();
        assert_eq!(named, expected);
        assert_eq!(named.len(), 4);
    }
}
