//! Proofs of goals by Coq's tactics, from certificates.
//!
//! A script follows the checker: each quantity that is not computed by the four operations gets a name, the
//! facts are listed in the order in which the checker knows them, and a program proved correct in Coq checks
//! the certificates.

mod leaf;
mod limit;

use super::lemma::{Lemma, Result};
use super::print::{ascii, simplified};
use crate::formula::claim::PRECISION;
use crate::formula::{Hypothesis, Proposition, Registry, Statement};
use crate::proof::check::{Atom, Node, Polynomial, Problem, Sign};
use crate::proof::render::ProofPrinter;
use crate::proof::search::prove_proposition;
use std::fmt::Write;

/// Lines of a proof.
#[derive(Clone, Default)]
pub(super) struct Script {
    lines: String,
    indent: usize,
}

/// A problem to be proved in Coq.
#[derive(Clone)]
struct Target<'p> {
    lemma: &'p Lemma<'p>,
    problem: &'p Problem<'p>,
    /// The labels of its hypotheses.
    labels: Vec<Option<String>>,
    /// The tactic that proves its leaves.
    tactic: &'static str,
    /// The variable of a limit, where it is known to be positive.
    positive: Option<usize>,
}

impl<'p> Target<'p> {
    fn new(lemma: &'p Lemma<'p>, problem: &'p Problem<'p>, labels: Vec<Option<String>>) -> Self {
        let is_smooth = matches!(problem.proposition, Proposition::Derivative(..));
        let tactic = if is_smooth { "auto_derive; derived" } else { "shown" };
        Target { lemma, problem, labels, tactic, positive: None }
    }

    /// Calls `write` with the problem of a proposition whose formulas are simplified, as they are printed.
    fn with(
        lemma: &Lemma,
        hypotheses: &[&Hypothesis],
        proposition: &Proposition,
        write: impl FnOnce(Target) -> Result<()>,
    ) -> Result<()> {
        let proposition = proposition.map(&simplified);
        let problem = Problem::new(&proposition, hypotheses.to_vec())?;
        write(Target::new(lemma, &problem, hypotheses.iter().map(|h| lemma.label(h)).collect()))
    }

    /// Searches for a proof of the problem.
    fn proof(&self) -> Result<Node> {
        let Problem { proposition, hypotheses, .. } = self.problem;
        let found = prove_proposition(proposition, hypotheses.clone()).map_err(|reason| {
            let statement = Statement::new("", (*proposition).clone()).assuming(hypotheses.iter().copied());
            let reason = ProofPrinter::new(&Registry::default()).describe(&statement, &reason);
            format!("no proof to follow: {reason}")
        })?;
        Ok(found)
    }

    /// Returns the name of an atom: that of a symbol, or s and its number.
    fn name(&self, x: usize) -> String {
        match self.problem.table.atoms().get(x) {
            Some(Atom::Own(name)) => ascii(name),
            _ => format!("s{x}"),
        }
    }

    /// Writes the formula with a number as an argument.
    fn formula(&self, number: usize) -> Result<String> {
        let tree = self.problem.table.formula(number)?;
        Ok(self.lemma.printer.expr(tree).argument())
    }

    fn variable(&self, atom: Atom) -> Result<usize> {
        Ok(self.problem.table.variable(atom)?)
    }

    fn label(&self, i: usize) -> Option<&str> {
        self.labels.get(i)?.as_deref()
    }

    /// Returns the numbers of a program in Coq; one that does not occur stands for what is not in scope.
    fn environment(&self, is_known: impl Fn(usize) -> bool) -> String {
        let atoms = 0..self.problem.table.atoms().len();
        let names: Vec<_> = atoms.map(|x| if is_known(x) { self.name(x) } else { "PI".into() }).collect();
        if names.is_empty() { "(@nil R)".into() } else { leaf::list(names) }
    }
}

impl Script {
    pub(super) fn new() -> Self {
        Script { indent: 1, ..Script::default() }
    }

    /// Begins a proof by introducing the variables and hypotheses of a lemma.
    pub(super) fn of(lemma: &Lemma) -> Self {
        let mut script = Script::new();
        let intros = lemma.intros();
        script.line(format!("{intros} functions.").trim_start());
        lemma.signs_of_scales().iter().for_each(|line| script.line(line));
        script
    }

    pub(super) fn into_text(self) -> String {
        self.lines
    }

    pub(super) fn line(&mut self, text: &str) {
        let _ = writeln!(self.lines, "{:1$}{text}", "", 2 * self.indent);
    }

    /// Writes a subproof.
    pub(super) fn block(&mut self, bullet: &str, inside: impl FnOnce(&mut Self) -> Result<()>) -> Result<()> {
        let mut block = Script { lines: String::new(), indent: self.indent + 1 };
        inside(&mut block)?;
        let pad = " ".repeat(2 * self.indent);
        let text = block.lines.trim_start();
        let end = if bullet == "{" { " }\n" } else { "\n" };
        let _ = write!(self.lines, "{pad}{bullet} {}{end}", text.trim_end());
        Ok(())
    }

    /// Proves a proposition from the hypotheses of a lemma.
    pub(super) fn goal(&mut self, lemma: &Lemma, proposition: &Proposition) -> Result<()> {
        Target::with(lemma, lemma.premises(), proposition, |target| self.problem(&target))
    }

    /// Proves that the left side of an equation is continuous in the variable of the goal.
    pub(super) fn continuity(&mut self, lemma: &Lemma, proposition: &Proposition) -> Result<()> {
        let tactic = "auto_derive; derived";
        Target::with(lemma, lemma.premises(), proposition, |target| {
            self.problem(&Target { tactic, ..target })
        })
    }

    /// Proves the proposition of a problem.
    fn problem(&mut self, target: &Target) -> Result<()> {
        let node = target.proof()?;
        self.names(target, |_| true)?;
        self.node(target, &node, &mut Vec::new())
    }

    fn node(&mut self, target: &Target, node: &Node, cases: &mut Vec<(Polynomial, Sign)>) -> Result<()> {
        match node {
            Node::Leaf(steps) => self.leaf(target, steps, cases),
            Node::Cases(on, both) => {
                let case = format!("C{}", cases.len() + 1);
                let env = target.environment(|_| true);
                let deciding = format!("value {env} (polynomial {})", leaf::text(on));
                self.line(&format!("destruct (either ({deciding})) as [{case} | {case}]."));
                for (node, sign) in both.iter().zip([Sign::Positive, Sign::NonPositive]) {
                    cases.push((on.clone(), sign));
                    self.block("{", |script| script.node(target, node, cases))?;
                    cases.pop();
                }
                Ok(())
            }
        }
    }

    /// Introduces the chosen atoms with what defines them: B1, B2, … are their signs or bounds, F1, F2, … their
    /// equations.
    fn names(&mut self, target: &Target, is_chosen: impl Fn(usize) -> bool) -> Result<()> {
        let precision = ascii(PRECISION);
        if target.lemma.contains_rounding {
            self.line(&format!("pose proof (four_at_least prec {precision} P E) as N."));
            self.line(&format!("assert (M : 0 <= {precision} - 4) by lra."));
        }
        let before = self.lines.len();
        for (x, atom) in target.problem.table.atoms().iter().enumerate().filter(|(x, _)| is_chosen(*x)) {
            let (rule, names) = match *atom {
                Atom::Own(_) | Atom::Factor(_) => continue,
                Atom::Error(of) => {
                    let of = target.formula(of)?;
                    (format!("model prec choice {precision} P E {of}"), format!("s{x} & B{x} & F{x}"))
                }
                Atom::IntervalParameter(i) => {
                    let is_near = target.problem.hypotheses[i].distance().is_some();
                    let rule = if is_near { "near" } else { "between" };
                    let label = target.label(i).ok_or("an interval of the variable of a limit")?;
                    (format!("{rule} _ _ _ {label}"), format!("s{x} & B{x} & F{x}"))
                }
                Atom::Size(of) => {
                    let y = target.variable(Atom::Factor(of))?;
                    let names = format!("s{x} & s{y} & B{x} & B{y} & F{x} & F{y}");
                    (format!("absolute {}", target.formula(of)?), names)
                }
                Atom::Exponential(of) => {
                    (format!("exponential {}", target.formula(of)?), format!("s{x} & B{x} & F{x}"))
                }
            };
            self.line(&format!("destruct ({rule}) as ({names})."));
        }
        if self.lines.len() > before {
            self.line("functions.");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_indented_behind_their_bullets() {
        let mut script = Script::new();
        script.line("one.");
        script
            .block("{", |own| {
                own.line("two.");
                own.block("-", |own| {
                    own.line("three.");
                    own.line("four.");
                    Ok(())
                })
            })
            .unwrap();
        script.line("five.");
        assert_eq!(script.into_text(), "  one.\n  { two.\n    - three.\n      four. }\n  five.\n");
    }
}
