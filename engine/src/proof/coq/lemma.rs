//! Lemmas: statements under hypotheses.

use super::print::{Printer, ascii};
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::minimum_precision;
use crate::formula::{Hypothesis, Proposition};
use crate::number::Tree;
use crate::number::tree::Op;

/// Result, with the reason why a claim cannot be exported.
pub(super) type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Variables and hypotheses of a lemma. What rounding needs belongs to the section of its file.
#[derive(Clone)]
pub(super) struct Lemma<'a> {
    pub(super) name: String,
    pub(super) printer: Printer<'a>,
    pub(super) variables: Vec<&'static str>,
    pub(super) hypotheses: Vec<&'a Hypothesis>,
    contains_rounding: bool,
}

/// Joins words, each after a blank.
pub(super) fn spaced(words: impl IntoIterator<Item = String>) -> String {
    words.into_iter().map(|word| format!(" {word}")).collect()
}

/// Returns the parameters of a lemma or function.
pub(super) fn binders(variables: impl IntoIterator<Item = &'static str>) -> String {
    let names = spaced(variables.into_iter().map(ascii));
    if names.is_empty() { names } else { format!(" ({} : R)", names.trim_start()) }
}

pub(super) fn format_hypothesis(hypothesis: &Hypothesis, printer: Printer) -> String {
    match hypothesis.distance() {
        Some((distance, most)) => {
            format_proposition(&Proposition::Within(distance, most.clone()), printer.plain())
        }
        None => printer.plain().expr(&hypothesis.value).relation(hypothesis.relation),
    }
}

pub(super) fn format_proposition(proposition: &Proposition, printer: Printer) -> String {
    use Proposition::*;
    match proposition {
        Equal(a, b) => format!("{} = {}", printer.expr(a), printer.expr(b)),
        Sign(relation, a) => printer.expr(a).relation(*relation),
        Within(a, bound) => format!("Rabs {} <= {}", printer.expr(a).argument(), printer.expr(bound)),
        Derivative(a, by, b) => {
            let by = ascii(by);
            format!(
                "is_derive (fun {by} => {})\n    {by}\n    {}",
                printer.expr(a),
                printer.expr(b).argument()
            )
        }
        Limit(a, by, b) => {
            format!(
                "is_lim (fun {} => {}) p_infty {}",
                ascii(by),
                printer.expr(a),
                printer.expr(b).argument()
            )
        }
    }
}

/// Returns the divisors in formulas, except numbers, each after its own divisors.
pub(super) fn divisors<'t>(trees: impl Iterator<Item = &'t Tree>) -> Vec<Tree> {
    fn visit(tree: &Tree, all: &mut Vec<Tree>) {
        tree.op().operands().for_each(|operand| visit(operand, all));
        if let Op::Div(_, divisor) = tree.op()
            && !matches!(divisor.op(), Op::Int(n) if *n != 0)
            && !all.contains(divisor)
        {
            all.push(divisor.clone());
        }
    }
    let mut all = Vec::new();
    trees.for_each(|tree| visit(tree, &mut all));
    all
}

impl<'a> Lemma<'a> {
    /// Returns a lemma for all values of the symbols in its hypotheses and in formulas.
    pub(super) fn new<'t>(
        name: String,
        printer: Printer<'a>,
        contains_rounding: bool,
        hypotheses: Vec<&'a Hypothesis>,
        trees: impl Iterator<Item = &'t Tree>,
    ) -> Self
    where
        'a: 't,
    {
        let values = hypotheses.iter().map(|h| &h.value);
        let mut variables = printer.registry.symbols_of(values.chain(trees));
        variables.retain(|name| !contains_rounding || *name != PRECISION && !SCALES.contains(name));
        Lemma { name, printer, variables, hypotheses, contains_rounding }
    }

    fn is_minimum_precision(&self, hypothesis: &Hypothesis) -> bool {
        self.contains_rounding && *hypothesis == minimum_precision()
    }

    /// Returns the label of a hypothesis in proofs: H1, H2, …, or the proof of the minimum precision.
    pub(super) fn label(&self, hypothesis: &Hypothesis) -> Option<String> {
        if self.is_minimum_precision(hypothesis) {
            return Some(format!("minimum_precision prec {} P E", ascii(PRECISION)));
        }
        self.hypotheses.iter().position(|h| *h == hypothesis).map(|i| format!("H{}", i + 1))
    }

    /// Returns the hypotheses that it states: the minimum precision is that of its section.
    fn stated(&self) -> impl Iterator<Item = &'a Hypothesis> {
        self.hypotheses.iter().copied().filter(|h| !self.is_minimum_precision(h))
    }

    /// Removes a variable and the hypotheses on it.
    pub(super) fn without(mut self, variable: &str) -> Self {
        self.hypotheses.retain(|h| !h.value.symbols().contains(variable));
        self.variables.retain(|name| *name != variable);
        self
    }

    /// Returns its name, applied to its variables and to the labels of its hypotheses.
    pub(super) fn applied(&self, label: impl Fn(&Hypothesis) -> Option<String>) -> String {
        let variables = spaced(self.variables.iter().map(|name| ascii(name)));
        format!("{}{variables}{}", self.name, spaced(self.stated().filter_map(label)))
    }

    /// Returns its statement with a proof.
    pub(super) fn text(&self, keyword: &str, conclusion: &str, proof: &str) -> String {
        let (name, binders) = (&self.name, binders(self.variables.iter().copied()));
        let hypotheses = self.stated().filter_map(|h| {
            Some(format!("\n  ({} : {})", self.label(h)?, format_hypothesis(h, self.printer)))
        });
        let hypotheses: String = hypotheses.collect();
        format!(
            "\n{keyword} {name}{binders}{hypotheses} :\n  {conclusion}.\nProof.\n  functions.\n{proof}Qed.\n"
        )
    }
}
