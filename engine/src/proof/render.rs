//! Proofs as text for readers.

mod lines;
mod names;
mod summary;
mod text;

pub use summary::proof_summary;

use self::lines::Lines;
use super::check::Proof;
use super::check::{Node, Problem, Step};
#[cfg(feature = "serde")]
use super::data::GoalProof;
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Goal, Proposition, Role, Sequence, Statement};
use crate::formula::{Call, Formula, Notation, Registry};
use crate::number::{PositivePart, Tree};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Printer of claims and proofs with the names of a registry.
#[derive(Clone, Copy, Debug)]
pub struct ProofPrinter<'a> {
    registry: &'a Registry,
}

impl<'a> ProofPrinter<'a> {
    /// Returns a printer with the names of this registry.
    pub fn new(registry: &'a Registry) -> Self {
        ProofPrinter { registry }
    }

    /// Formats a claim in one line.
    pub fn claim(&self, statement: &Statement) -> String {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter::new(&registry).claim(statement);
        }
        let computed = statement.computed().iter();
        let computed = computed.map(|c| format!("{} = {}", c.symbol, self.text(&c.formula)));
        let computed: Vec<_> = computed.collect();
        let Some(sequence) = statement.conclusion() else {
            let goals = statement.goals().iter().filter(|goal| goal.role == Role::Claim);
            let goals: Vec<_> = goals.map(|goal| self.format_proposition(&goal.proposition)).collect();
            let separator = if computed.is_empty() { "" } else { ", where " };
            return goals.join("; ") + separator + &computed.join(" and ");
        };
        let Sequence { start, step, ratio, member, limit, within } = sequence;
        let (index, power) = (self.index(statement), self.power(statement, ratio));
        let definitions = [&[power], &computed[..]].concat().join(" and ");
        if let Some(limit) = limit {
            let (member, limit) = (self.list(member), self.text(limit));
            let size = self.text(&ratio.abs());
            return format!(
                "{member} → {limit} for {definitions} and {index} → ∞, as {size} < 1 and it is {limit} at q = 0"
            );
        }
        let (from, to, members) = (self.list(start), self.list(step), MEMBERS[..step.len()].join(", "));
        let bounds = within
            .iter()
            .map(|(of, bound)| self.format_proposition(&Proposition::Within(of.clone(), bound.clone())));
        let result = match &bounds.collect::<Vec<_>>()[..] {
            [] => self.list(member),
            bounds => format!("{members} with {}", bounds.join(" and ")),
        };
        format!("{index} steps from {from}, each of {members} to {to}, lead to {result}, where {definitions}")
    }

    fn list(&self, trees: &[Tree]) -> String {
        trees.iter().map(|tree| self.text(tree)).collect::<Vec<_>>().join(", ")
    }

    /// Returns the properties of a sequence at every step, and of computed quantities, which are proved and
    /// not assumed.
    pub fn invariants(&self, statement: &Statement) -> Vec<String> {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter::new(&registry).invariants(statement);
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
        let [letters, superscripts] = LETTERS.map(str::chars);
        let mut free = letters.zip(superscripts).filter(|(letter, _)| !taken.contains(&*letter.to_string()));
        free.next().unwrap_or(('k', 'ᵏ'))
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
            Within(of, bound) => format!("{} ≤ {}", self.text(&of.abs()), self.text(bound)),
            Derivative(of, x, is) => format!("∂/∂{x} [{}] = {}", self.text(of), self.text(is)),
            Limit(of, x, to) => format!("lim [{}] = {} for {x} → ∞", self.text(of), self.text(to)),
        }
    }

    /// Returns the hypotheses used in the proof of a goal, as text.
    pub fn used(&self, proof: &Proof) -> Vec<String> {
        if let Some(registry) = self.other_names(proof.statement()) {
            return ProofPrinter::new(&registry).used(proof);
        }
        let mut all = Vec::new();
        for (goal, node) in proof.statement().goals().iter().zip(proof.goals()) {
            let hypotheses = proof.statement().hypotheses_for(goal.role);
            let used = leaves(node).into_iter().flatten().filter_map(|step| match step {
                Step::Assume(i) => hypotheses.get(*i),
                _ => None,
            });
            for hypothesis in used {
                if !all.contains(*hypothesis) {
                    all.push((*hypothesis).clone());
                }
            }
        }
        self.registry.format_hypotheses(&all)
    }

    /// Returns the definitions of the names in a claim: `d = a b − c (x − y)`.
    pub fn names(&self, statement: &Statement) -> Vec<String> {
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter::new(&registry).names(statement);
        }
        let called = self.called(statement).into_iter();
        let definitions = called.map(|Called { formula, arguments }| {
            let names: Vec<_> = self.registry.displayed_arguments(formula, arguments).collect();
            let names = if names.is_empty() { String::new() } else { format!("({})", names.join(", ")) };
            format!("{}{names} = {}", formula.symbol, self.registry.typeset(formula, Notation::Text))
        });
        definitions.collect()
    }

    /// Returns the formulas abbreviated in the text of the statement, and those abbreviated in their
    /// definitions.
    fn called(&self, statement: &Statement) -> Vec<Called<'a>> {
        let mut called = Vec::new();
        statement.trees().for_each(|tree| self.add_called(tree, &mut called));
        if let Some(Sequence { start, step, ratio, member, limit, within }) = statement.conclusion() {
            let bounds = within.iter().flat_map(|(of, bound)| [of, bound]);
            let trees = start.iter().chain(step).chain([ratio]).chain(member).chain(limit).chain(bounds);
            trees.for_each(|tree| self.add_called(tree, &mut called));
        }
        // A definition may contain further names.
        let mut i = 0;
        while let Some(Called { formula, .. }) = called.get(i) {
            formula.tree.op().operands().for_each(|tree| self.add_called(tree, &mut called));
            i += 1;
        }
        called
    }

    /// Adds the formulas abbreviated in the text of a formula.
    fn add_called(&self, tree: &Tree, called: &mut Vec<Called<'a>>) {
        let all = RefCell::new(called);
        tree.typeset(Notation::Text, &|part| {
            let name = self.registry.call_name(part)?;
            let Call { formula, .. } = self.registry.call(part)?;
            let (mut called, arguments) = (all.borrow_mut(), name.arguments.len());
            match called.iter_mut().find(|known| known.formula.name() == formula.name()) {
                Some(known) => known.arguments = known.arguments.max(arguments),
                None => called.push(Called { formula, arguments }),
            }
            Some(name)
        });
    }

    /// Returns the lines of the whole proof.
    pub fn proof(&self, proof: &Proof) -> Vec<String> {
        let statement = proof.statement();
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter::new(&registry).proof(proof);
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
        for (Goal { part, role, proposition }, node) in statement.goals().iter().zip(proof.goals()) {
            let problem = Problem::new(proposition, statement.hypotheses_for(*role));
            let goal_lines =
                problem.and_then(|problem| Lines::new(self, &problem).node(node, &mut Vec::new()));
            let goal_lines = goal_lines.unwrap_or_else(|reason| vec![reason.to_string()]);
            if single {
                lines.extend(goal_lines);
            } else {
                let part = match statement.conclusion() {
                    Some(Sequence { ratio, .. }) => part.replace("|ρ|", &self.text(&ratio.abs())),
                    None => part.to_string(),
                };
                let colon = if part.is_empty() { "" } else { ": " };
                lines.push(format!("{part}{colon}{}", self.format_proposition(proposition)));
                lines.extend(goal_lines.into_iter().map(|line| format!("  {line}")));
            }
        }
        lines
    }

    /// Returns the proof of each goal as data.
    #[cfg(feature = "serde")]
    pub fn data(&self, proof: &Proof) -> Vec<GoalProof> {
        let statement = proof.statement();
        if let Some(registry) = self.other_names(statement) {
            return ProofPrinter::new(&registry).data(proof);
        }
        let all = statement.goals().iter().zip(proof.goals());
        all.filter_map(|(Goal { role, proposition, .. }, proof)| {
            let problem = Problem::new(proposition, statement.hypotheses_for(*role)).ok()?;
            let hypotheses = problem.hypotheses.iter().map(|h| self.registry.format_hypothesis(h));
            Some(GoalProof {
                goal: self.format_proposition(proposition),
                hypotheses: hypotheses.collect(),
                atoms: Lines::new(self, &problem).descriptions(),
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
    /// Maximum number of displayed arguments.
    arguments: usize,
}

/// Letters for the index of a sequence in order of preference, and their superscripts.
const LETTERS: [&str; 2] = ["kjinmrstwxyz", "ᵏʲⁱⁿᵐʳˢᵗʷˣʸᶻ"];

#[cfg(test)]
mod tests;
