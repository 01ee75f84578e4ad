//! Proofs as text for readers.

mod lines;
mod names;
mod summary;
mod text;

pub use summary::proof_summary;

use self::lines::Lines;
use super::check::Proof;
use super::check::{Node, Sequent, Step};
#[cfg(feature = "serde")]
use super::data::GoalProof;
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Goal, Proposition, Role, Sequence, Statement};
use crate::formula::{Call, Formula, Notation, Registry};
use crate::number::{PositivePart, Tree};
use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Printer of claims and proofs with the names of a registry.
#[derive(Clone, Debug)]
pub struct ProofPrinter<'a> {
    registry: Cow<'a, Registry>,
}

impl<'a> ProofPrinter<'a> {
    /// Returns a printer with the names of this registry.
    pub fn new(registry: &'a Registry) -> Self {
        ProofPrinter { registry: Cow::Borrowed(registry) }
    }

    /// Formats a claim in one line.
    pub fn claim(&self, statement: &Statement) -> String {
        let printer = self.for_statement(statement);
        let power = statement.conclusion().map(|sequence| printer.power(statement, &sequence.ratio));
        let computed = statement.computed().iter();
        let computed = computed.map(|c| format!("{} = {}", c.symbol, printer.text(&c.formula)));
        let definitions = power.into_iter().chain(computed).collect::<Vec<_>>().join(" and ");
        let Some(Sequence { start, step, ratio, member, limit, within }) = statement.conclusion() else {
            let goals = statement.goals().iter().filter(|goal| goal.role == Role::Claim);
            let goals: Vec<_> = goals.map(|goal| printer.format_proposition(&goal.proposition)).collect();
            let separator = if definitions.is_empty() { "" } else { ", where " };
            return goals.join("; ") + separator + &definitions;
        };
        let (index, members) = (printer.index(statement), MEMBERS[..step.len()].join(", "));
        let [start, step, member] = [start, step, member]
            .map(|trees| trees.iter().map(|tree| printer.text(tree)).collect::<Vec<_>>().join(", "));
        if let Some(limit) = limit {
            let (limit, size) = (printer.text(limit), printer.text(&ratio.abs()));
            return format!(
                "{member} → {limit} for {definitions} and {index} → ∞, as {size} < 1 and it is {limit} at q = 0"
            );
        }
        let bounds: Vec<_> = within.iter().map(|(of, bound)| printer.format_bound(of, bound)).collect();
        let result =
            if bounds.is_empty() { member } else { format!("{members} with {}", bounds.join(" and ")) };
        format!(
            "{index} steps from {start}, each of {members} to {step}, lead to {result}, where {definitions}"
        )
    }

    /// Returns the properties of a sequence at every step, and of computed quantities, which are proved and
    /// not assumed.
    pub fn invariants(&self, statement: &Statement) -> Vec<String> {
        let printer = self.for_statement(statement);
        let computed = statement.computed().iter().map(|computed| &computed.hypothesis);
        let all = statement.invariants().iter().chain(computed);
        all.map(|hypothesis| printer.registry.format_hypothesis(hypothesis)).collect()
    }

    /// Returns the letter for the index of a sequence, which has no other meaning in the statement.
    pub fn index(&self, statement: &Statement) -> char {
        self.letter(statement).0
    }

    /// Returns the letter and its superscript.
    fn letter(&self, statement: &Statement) -> (char, char) {
        let names = self.called(statement).into_iter().map(|called| called.formula.symbol);
        let taken: BTreeSet<_> = statement.trees().flat_map(Tree::symbols).chain(names).collect();
        let [letters, superscripts] = LETTERS.map(str::chars);
        let mut all = letters.zip(superscripts);
        all.find(|(letter, _)| !taken.contains(&*letter.to_string())).unwrap_or(('k', 'ᵏ'))
    }

    /// Returns the definition of the power of a ratio: `q = ρᵏ`.
    fn power(&self, statement: &Statement, ratio: &Tree) -> String {
        let (_, exponent) = self.letter(statement);
        let power = ratio.raised(&exponent.to_string(), &|tree| self.registry.call_name(tree));
        format!("{POWER} = {power}")
    }

    /// Returns a printer without the names that the statement uses for its own quantities.
    fn for_statement(&self, statement: &Statement) -> ProofPrinter<'_> {
        let quantities = statement.trees().flat_map(Tree::symbols).collect();
        ProofPrinter { registry: self.registry.without_symbols(&quantities) }
    }

    fn format_bound(&self, of: &Tree, bound: &Tree) -> String {
        format!("{} ≤ {}", self.text(&of.abs()), self.text(bound))
    }

    /// Formats a goal.
    fn format_proposition(&self, proposition: &Proposition) -> String {
        use Proposition::*;
        match proposition {
            Equal(left, right) => match [left, right].map(|side| self.text(side)) {
                [left, right] if left != right => format!("{left} = {right}"),
                [number, _] if !number.contains(char::is_alphabetic) => {
                    format!("it is {number} for all values")
                }
                [formula, _] => format!("both functions are {formula}"),
            },
            Sign(relation, of) => format!("{} {relation} 0", self.text(of)),
            Within(of, bound) => self.format_bound(of, bound),
            Derivative(of, x, is) => format!("∂/∂{x} [{}] = {}", self.text(of), self.text(is)),
            Limit(of, x, to) => format!("lim [{}] = {} for {x} → ∞", self.text(of), self.text(to)),
        }
    }

    /// Returns the hypotheses used in the proof of a goal, as text.
    pub fn used(&self, proof: &Proof) -> Vec<String> {
        let (statement, mut all) = (proof.statement(), Vec::new());
        for (goal, node) in statement.goals().iter().zip(proof.goals()) {
            let hypotheses = statement.hypotheses_for(goal.role);
            for step in leaves(node).into_iter().flatten() {
                if let Step::Assume(i) = step
                    && !all.contains(hypotheses[*i])
                {
                    all.push(hypotheses[*i].clone());
                }
            }
        }
        self.for_statement(statement).registry.format_hypotheses(&all)
    }

    /// Returns the definitions of the names in a claim: `d = a b − c (x − y)`.
    pub fn names(&self, statement: &Statement) -> Vec<String> {
        let printer = self.for_statement(statement);
        let definitions = printer.called(statement).into_iter().map(|Called { formula, has_arguments }| {
            let names: Vec<_> = formula.depends_on().collect();
            let names = if has_arguments { format!("({})", names.join(", ")) } else { String::new() };
            format!("{}{names} = {}", formula.symbol, printer.registry.typeset(formula, Notation::Text))
        });
        definitions.collect()
    }

    /// Returns the formulas abbreviated in the text of the statement, and those abbreviated in their
    /// definitions.
    fn called(&self, statement: &Statement) -> Vec<Called<'_>> {
        let all = RefCell::new(Vec::new());
        let trees = statement.trees().chain(statement.formulas());
        trees.for_each(|tree| self.add_called(tree, &all));
        // A definition may contain further names.
        for i in 0.. {
            let Some(formula) = all.borrow().get(i).map(|called: &Called| called.formula) else { break };
            formula.tree.op().operands().for_each(|tree| self.add_called(tree, &all));
        }
        all.into_inner()
    }

    /// Adds the formulas abbreviated in the text of a formula.
    fn add_called<'s>(&'s self, tree: &Tree, all: &RefCell<Vec<Called<'s>>>) {
        tree.typeset(Notation::Text, &|part| {
            let (name, Call { formula, .. }) = self.registry.call_name(part).zip(self.registry.call(part))?;
            let (mut called, has_arguments) = (all.borrow_mut(), !name.arguments.is_empty());
            match called.iter_mut().find(|known| known.formula.name() == formula.name()) {
                Some(known) => known.has_arguments |= has_arguments,
                None => called.push(Called { formula, has_arguments }),
            }
            Some(name)
        });
    }

    /// Returns the lines of the whole proof.
    pub fn proof(&self, proof: &Proof) -> Vec<String> {
        let statement = proof.statement();
        let printer = self.for_statement(statement);
        let mut lines = Vec::new();
        lines.extend(statement.conclusion().map(|Sequence { ratio, limit, .. }| {
            let (index, power) = (printer.index(statement), printer.power(statement, ratio));
            if limit.is_none() {
                let next = printer.text(&(ratio * Tree::symbol(POWER)));
                return format!("by induction on {index}, with {power}: for {POWER} = 1, and from {POWER} to {next}");
            }
            let size = printer.text(&ratio.abs());
            format!("{power} → 0 if {size} < 1, and a function continuous in {POWER} at 0 tends to its value there")
        }));
        let single = statement.goals().len() == 1;
        for (Goal { part, role, proposition }, node) in statement.goals().iter().zip(proof.goals()) {
            let sequent = Sequent::new(proposition, statement.hypotheses_for(*role));
            let goal_lines =
                sequent.and_then(|sequent| Lines::new(&printer, &sequent).node(node, &mut Vec::new()));
            let goal_lines = goal_lines.unwrap_or_else(|reason| vec![reason.to_string()]);
            if single {
                return [lines, goal_lines].concat();
            }
            let part = match statement.conclusion() {
                Some(Sequence { ratio, .. }) => part.replace("|ρ|", &printer.text(&ratio.abs())),
                None => part.to_string(),
            };
            let colon = if part.is_empty() { "" } else { ": " };
            lines.push(format!("{part}{colon}{}", printer.format_proposition(proposition)));
            lines.extend(goal_lines.into_iter().map(|line| format!("  {line}")));
        }
        lines
    }

    /// Returns the proof of each goal as data.
    #[cfg(feature = "serde")]
    pub fn data(&self, proof: &Proof) -> Vec<GoalProof> {
        let statement = proof.statement();
        let printer = self.for_statement(statement);
        let all = statement.goals().iter().zip(proof.goals());
        all.filter_map(|(Goal { role, proposition, .. }, proof)| {
            let sequent = Sequent::new(proposition, statement.hypotheses_for(*role)).ok()?;
            let hypotheses = sequent.hypotheses.iter().map(|h| printer.registry.format_hypothesis(h));
            Some(GoalProof {
                goal: printer.format_proposition(proposition),
                hypotheses: hypotheses.collect(),
                atoms: Lines::new(&printer, &sequent).descriptions(),
                proof: proof.clone(),
            })
        })
        .collect()
    }

    fn text(&self, tree: &Tree) -> String {
        self.registry.format_tree(tree)
    }
}

/// Returns the leaves of a proof.
fn leaves(node: &Node) -> Vec<&[Step]> {
    match node {
        Node::Leaf(steps) => vec![steps],
        Node::Cases(_, both) => both.iter().flat_map(leaves).collect(),
    }
}

/// An abbreviated formula.
struct Called<'a> {
    formula: &'a Formula,
    /// Whether its arguments are displayed.
    has_arguments: bool,
}

/// Letters for the index of a sequence in order of preference, and their superscripts.
const LETTERS: [&str; 2] = ["kjinmrstwxyz", "ᵏʲⁱⁿᵐʳˢᵗʷˣʸᶻ"];

#[cfg(test)]
mod tests;
