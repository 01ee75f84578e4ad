//! Proofs as text for readers.

mod algebra;
mod bound;
mod names;
mod summary;

pub use summary::proof_summary;

use self::algebra::Order;
use super::kernel::algebra::Poly;
use super::kernel::sign::Sign;
use super::kernel::{
    Assumption, AssumptionUse, Derivation, Direct, Justification, Proof, Rounding, SignedRatio,
};
use crate::formula::claim::{MEMBERS, POWER, PRECISION};
use crate::formula::statement::{Goal, Proposition, Role, Sequence, Statement};
use crate::formula::{Call, Formula, Hypothesis, Notation, Registry, name_of_rounding};
use crate::number::tree::Op;
use crate::number::{PositivePart, Tree};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Printer of claims and proofs with the names of a registry.
#[derive(Clone, Copy, Debug)]
pub struct ProofPrinter<'a> {
    registry: &'a Registry,
    is_full: bool,
}

impl<'a> ProofPrinter<'a> {
    /// Returns a printer with the names of this registry.
    pub fn new(registry: &'a Registry) -> Self {
        ProofPrinter { registry, is_full: false }
    }

    /// Prints all polynomials and certificates in full, regardless of their length.
    pub fn in_full(self) -> Self {
        ProofPrinter { is_full: true, ..self }
    }

    /// Formats a claim in one line.
    pub fn claim(&self, statement: &Statement) -> String {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter { registry: &registry, ..*self }.claim(statement);
        }
        let computed = statement.computed().iter();
        let computed: Vec<_> = computed
            .map(|computed| format!("{} = {}", computed.symbol, self.text(&computed.formula)))
            .collect();
        let Some(sequence) = statement.conclusion() else {
            let goals = statement.goals().iter().filter(|goal| goal.role == Role::Claim);
            let goals: Vec<_> = goals.map(|goal| self.format_proposition(&goal.proposition)).collect();
            let place = if computed.is_empty() { "" } else { ", where " };
            return goals.join("; ") + place + &computed.join(" and ");
        };
        let Sequence { start, step, ratio, member, limit, within } = sequence;
        let together =
            |trees: &[Tree]| trees.iter().map(|tree| self.text(tree)).collect::<Vec<_>>().join(", ");
        let (index, power) = (self.index(statement), self.power(statement, ratio));
        let place = [&[power], &computed[..]].concat().join(" and ");
        if let Some(limit) = limit {
            return format!("{} → {} for {place} and {index} → ∞", together(member), self.text(limit));
        }
        let (from, to, members) = (together(start), together(step), MEMBERS[..step.len()].join(", "));
        let bound = |(of, bound): &(Tree, Tree)| {
            self.format_proposition(&Proposition::Within(of.clone(), bound.clone()))
        };
        let leads_to = match &within.iter().map(bound).collect::<Vec<_>>()[..] {
            [] => together(member),
            bounds => format!("{members} with {}", bounds.join(" and ")),
        };
        format!("{index} steps from {from}, each of {members} to {to}, lead to {leads_to}, where {place}")
    }

    /// Returns the properties of a sequence at every step, and of computed quantities, which are proved and
    /// not assumed.
    pub fn invariants(&self, statement: &Statement) -> Vec<String> {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter { registry: &registry, ..*self }.invariants(statement);
        }
        let computed = statement.computed().iter().map(|computed| &computed.hypothesis);
        let all = statement.invariants().iter().chain(computed);
        all.map(|hypothesis| self.registry.format_hypothesis(hypothesis)).collect()
    }

    /// Returns the letter for the index of a sequence, which has no other meaning in the statement.
    pub fn index(&self, statement: &Statement) -> char {
        self.letter(statement).0
    }

    /// Returns the letter and its superscript.
    fn letter(&self, statement: &Statement) -> (char, char) {
        let symbols: Vec<_> = statement.trees().flat_map(Tree::symbols).collect();
        let names = self.called(statement).into_iter().map(|called| called.formula.symbol);
        let taken: BTreeSet<_> = symbols.into_iter().chain(names).collect();
        let is_free = |(letter, _): &&(char, char)| !taken.contains(letter.to_string().as_str());
        *LETTERS.iter().find(is_free).unwrap_or(&LETTERS[0])
    }

    /// Returns the definition of the power of a ratio: `q = ρᵏ`.
    fn power(&self, statement: &Statement, ratio: &Tree) -> String {
        let (_, exponent) = self.letter(statement);
        let power = ratio.raised(&exponent.to_string(), &|tree| self.registry.call_name(tree));
        format!("{POWER} = {power}")
    }

    /// Returns the registry without names that the statement uses for its own quantities; `None` if there are
    /// none.
    fn other_names(&self, statement: &Statement) -> Option<Registry> {
        self.registry.without_symbols(&statement.trees().flat_map(Tree::symbols).collect())
    }

    /// Formats a goal.
    fn format_proposition(&self, proposition: &Proposition) -> String {
        let text = |tree: &Tree| self.text(tree);
        match proposition {
            Proposition::Equal(left, right) => format!("{} = {}", text(left), text(right)),
            Proposition::Sign(relation, of) => format!("{} {relation} 0", text(of)),
            Proposition::Within(of, bound) => format!("{} ≤ {}", text(&of.abs()), text(bound)),
            Proposition::Derivative(of, x, is) => format!("∂/∂{x} [{}] = {}", text(of), text(is)),
            Proposition::Limit(of, x, to) => format!("lim [{}] = {} for {x} → ∞", text(of), text(to)),
        }
    }

    /// Returns the hypotheses used in the proof of a goal, as text.
    pub fn used(&self, proof: &Proof) -> Vec<String> {
        if let Some(registry) = self.other_names(proof.statement()) {
            return ProofPrinter { registry: &registry, ..*self }.used(proof);
        }
        fn collect(derivation: &Derivation, all: &mut Vec<Hypothesis>) {
            match derivation {
                Derivation::Cases(_, positive, not) => {
                    collect(positive, all);
                    collect(not, all);
                }
                Derivation::Direct(direct) => {
                    for supposed in &direct.assumptions {
                        if let Some(given) = &supposed.hypothesis
                            && !matches!(&supposed.usage, AssumptionUse::Unused | AssumptionUse::Implied)
                            && !all.contains(given)
                        {
                            all.push(given.clone());
                        }
                    }
                }
            }
        }
        let mut all = Vec::new();
        proof.goals().iter().for_each(|derivation| collect(derivation, &mut all));
        self.registry.format_hypotheses(&all)
    }

    /// Returns the definitions of the names in a claim: `d = a b − c (x − y)`.
    pub fn names(&self, statement: &Statement) -> Vec<String> {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter { registry: &registry, ..*self }.names(statement);
        }
        let definition = |Called { formula, arguments }: &Called| {
            let names: Vec<_> = self.registry.displayed_arguments(formula, *arguments).collect();
            let names = if names.is_empty() { String::new() } else { format!("({})", names.join(", ")) };
            format!("{}{names} = {}", formula.symbol, self.registry.typeset(formula, Notation::Text))
        };
        self.called(statement).iter().map(definition).collect()
    }

    /// Returns the formulas abbreviated in the text of the statement, and those abbreviated in their
    /// definitions.
    fn called(&self, statement: &Statement) -> Vec<Called<'a>> {
        let called = RefCell::new(Vec::<Called<'a>>::new());
        let collect = |tree: &Tree| {
            let name = |part: &Tree| {
                let name = self.registry.call_name(part)?;
                let Call { formula, .. } = self.registry.call(part)?;
                let (mut called, arguments) = (called.borrow_mut(), name.arguments.len());
                match called.iter_mut().find(|known| known.formula.name() == formula.name()) {
                    Some(known) => known.arguments = known.arguments.max(arguments),
                    None => called.push(Called { formula, arguments }),
                }
                Some(name)
            };
            tree.typeset(Notation::Text, &name);
        };
        statement.trees().for_each(collect);
        if let Some(Sequence { start, step, ratio, member, limit, within }) = statement.conclusion() {
            let bounds = within.iter().flat_map(|(of, bound)| [of, bound]);
            start
                .iter()
                .chain(step)
                .chain([ratio])
                .chain(member)
                .chain(limit)
                .chain(bounds)
                .for_each(collect);
        }
        // A definition may contain further names.
        let mut i = 0;
        loop {
            let Some(formula) = called.borrow().get(i).map(|called| called.formula) else { break };
            formula.tree.op().operands().for_each(collect);
            i += 1;
        }
        called.into_inner()
    }

    /// Returns the lines of the whole proof.
    pub fn proof(&self, proof: &Proof) -> Vec<String> {
        let statement = proof.statement();
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter { registry: &registry, ..*self }.proof(proof);
        }
        let mut lines = Vec::new();
        lines.extend(statement.conclusion().map(|Sequence { ratio, limit, .. }| {
            let (index, power) = (self.index(statement), self.power(statement, ratio));
            match limit {
                None => {
                    let next = self.text(&(ratio * Tree::symbol(POWER)));
                    let steps = format!("for {POWER} = 1, and from {POWER} to {next}");
                    format!("by induction on {index}, with {power}: {steps}")
                }
                Some(_) => {
                    let size = self.text(&ratio.abs());
                    let continuous =
                        format!("a function continuous in {POWER} at 0 tends to its value there");
                    format!("{power} → 0 if {size} < 1, and {continuous}")
                }
            }
        }));
        let single = statement.goals().len() == 1;
        for (Goal { part, proposition, .. }, derivation) in statement.goals().iter().zip(proof.goals()) {
            if single {
                self.derivation(derivation, 0, &mut lines);
            } else {
                let part = match statement.conclusion() {
                    Some(Sequence { ratio, .. }) => part.replace("|ρ|", &self.text(&ratio.abs())),
                    None => part.to_string(),
                };
                let colon = if part.is_empty() { "" } else { ": " };
                lines.push(format!("{part}{colon}{}", self.format_proposition(proposition)));
                self.derivation(derivation, 1, &mut lines);
            }
        }
        lines
    }

    fn derivation(&self, derivation: &Derivation, depth: usize, lines: &mut Vec<String>) {
        if let Some(law) = self.law(derivation).filter(|_| !self.is_full) {
            lines.extend(law.into_iter().map(|line| format!("{}{line}", "  ".repeat(depth))));
            return;
        }
        let say = |text: String, lines: &mut Vec<String>| lines.push(format!("{}{text}", "  ".repeat(depth)));
        match derivation {
            Derivation::Cases(on, positive, not) => {
                let on = self.order().poly_or_size(on);
                say(format!("case {on} > 0:"), lines);
                self.derivation(positive, depth + 1, lines);
                say(format!("case {on} ≤ 0:"), lines);
                self.derivation(not, depth + 1, lines);
            }
            Derivation::Direct(direct) => self.direct(direct).into_iter().for_each(|line| say(line, lines)),
        }
    }

    fn direct(&self, direct: &Direct) -> Vec<String> {
        let mut lines: Vec<String> = direct.assumptions.iter().filter_map(|s| self.format_use(s)).collect();
        lines.extend(self.errors(direct));
        for (divisor, nonzero) in &direct.divisors {
            explain(format!("{} ≠ 0", self.text(divisor)), self.explain_sign(nonzero), &mut lines);
        }
        for (bracket, value, decides) in &direct.branches {
            let decisive = match bracket.op() {
                Op::Min(..) => "the second less the first",
                _ => "its argument",
            };
            explain(
                format!("{} = {} by the sign of {decisive}", self.text(bracket), self.text(value)),
                self.explain_sign(decides),
                &mut lines,
            );
        }
        match &direct.justification {
            Justification::Equal(value) => {
                lines.push(format!("both sides are {}", self.order().ratio_or_size(value)))
            }
            Justification::Sign(sign) => lines.extend(self.explain_sign(sign)),
            Justification::Order(signs) => {
                lines.push("rounding preserves order, and so does each operation, since".to_string());
                lines.extend(signs.iter().flat_map(|signed| self.explain_sign(signed)));
            }
            Justification::Within(sides) if self.is_full => lines.extend(self.within_in_full(sides)),
            Justification::Within(sides) => lines.extend(self.within(sides)),
            Justification::Derivative(value) => lines.push(format!(
                "differentiation by dual numbers gives {}, which is the right side",
                self.order().ratio(value)
            )),
            Justification::Limit { of, by, degrees: (n, d), leading, to } => {
                lines.push(format!("it is {}", self.order().ratio(of)));
                lines.push(format!(
                    "degrees {n} of the numerator and {d} of the denominator in {}, \
                     hence the limit is {}, since below",
                    by.name(),
                    self.order().ratio(to)
                ));
                lines.extend(self.order().certificate(leading).into_iter().map(|line| format!("  {line}")));
            }
        }
        lines
    }

    /// Returns the rounded formulas with the names of their errors.
    fn errors(&self, direct: &Direct) -> Option<String> {
        let own = |own: &Rounding| {
            format!("{} of {}({})", own.error.name(), name_of_rounding(&own.of), self.text(&own.of))
        };
        let errors: Vec<_> = direct.roundings.iter().map(own).collect();
        (!errors.is_empty()).then(|| model() + &errors.join(", "))
    }

    /// Returns the use of an assumption, if it has to be stated.
    fn format_use(&self, supposed: &Assumption) -> Option<String> {
        let name = supposed
            .hypothesis
            .as_ref()
            .map_or("the case".to_string(), |given| self.registry.format_hypothesis(given));
        match &supposed.usage {
            AssumptionUse::Symbol(_) => None,
            AssumptionUse::Implied => Some(format!("{name} follows")),
            AssumptionUse::Retained => Some(format!("{name} is used unchanged")),
            AssumptionUse::Unused => Some(format!("{name} is not used")),
            AssumptionUse::Interval(x, by, place) => Some(format!(
                "by {name}: {} = {}, where −1 ≤ {} ≤ 1",
                x.name(),
                self.order().ratio_or_size(by),
                place.name()
            )),
            AssumptionUse::Size { pivot, by, size, place, .. } => {
                let (value, place) = (self.order().ratio_or_size(&supposed.value), place.name());
                let solved = format!("{} = {}", self.order().monomial(pivot), self.order().ratio_or_size(by));
                Some(format!("with {} = |{value}|: {solved}, where −1 ≤ {place} ≤ 1", size.name()))
            }
            AssumptionUse::Pivot(pivot, by, slack) => {
                let solved = format!("{} = {}", self.order().monomial(pivot), self.order().ratio_or_size(by));
                Some(match slack {
                    None => format!("by {name}: {solved}"),
                    Some(slack) => {
                        let value = self.order().ratio_or_size(&supposed.slack_value());
                        let slack = slack.name();
                        let sign = if supposed.sign == Sign::Positive { "> 0" } else { "≥ 0" };
                        format!("by {name}: {slack} = {value} {sign}, so {solved}")
                    }
                })
            }
        }
    }

    /// Returns the proof of the sign of a quotient.
    fn explain_sign(&self, signed: &SignedRatio) -> Vec<String> {
        let mut lines = Vec::new();
        if !signed.value.den().is_one() || signed.subtracted.is_some() {
            lines.push(format!("it is {}", self.order().ratio_or_size(&signed.value)));
        }
        if let Some(less) = &signed.subtracted {
            lines.push(self.order().subtracted_multiple(less));
            if self.is_full {
                lines.extend(self.explain_sign(&less.factor));
            }
        }
        if !signed.den.of().is_one() {
            lines.extend(self.order().certificate(&signed.den));
        }
        lines.extend(self.order().certificate(&signed.num));
        lines
    }

    fn order(&self) -> Order<'a> {
        Order { factors: self.registry.factors(), is_full: self.is_full }
    }

    fn text(&self, tree: &Tree) -> String {
        self.registry.format_tree(tree)
    }
}

/// An abbreviated formula.
struct Called<'a> {
    formula: &'a Formula,
    /// Largest number of displayed arguments.
    arguments: usize,
}

/// Letters for the index of a sequence in order of preference, with their superscripts.
const LETTERS: [(char, char); 12] = [
    ('k', 'ᵏ'),
    ('j', 'ʲ'),
    ('i', 'ⁱ'),
    ('n', 'ⁿ'),
    ('m', 'ᵐ'),
    ('r', 'ʳ'),
    ('s', 'ˢ'),
    ('t', 'ᵗ'),
    ('w', 'ʷ'),
    ('x', 'ˣ'),
    ('y', 'ʸ'),
    ('z', 'ᶻ'),
];

/// Returns a polynomial as a formula.
pub(super) fn formula(poly: &Poly) -> Tree {
    Order::default().poly(poly)
}

/// Returns the definition of a rounding error; the names of errors follow.
fn model() -> String {
    format!("fl(…) = … (1 + eᵢ / ({PRECISION} + 1)) with |eᵢ| ≤ 1: ")
}

/// Writes a fact with its reason, on one line if that is short.
fn explain(fact: String, reason: Vec<String>, lines: &mut Vec<String>) {
    if let [reason] = reason.as_slice() {
        lines.push(format!("{fact}: {reason}"));
    } else {
        lines.push(format!("{fact}:"));
        lines.extend(reason.into_iter().map(|line| format!("  {line}")));
    }
}

#[cfg(test)]
mod tests;
