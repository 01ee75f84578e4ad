//! Lemmas: statements under hypotheses.

use super::print::{Printer, ascii};
use super::script::Script;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::minimum_precision;
use crate::formula::{Hypothesis, Proposition};
use crate::number::Tree;
use crate::number::tree::Op;

/// Result, with the reason why a claim cannot be exported.
pub(super) type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Variables and hypotheses of a lemma; if it contains roundings, it is for every precision.
#[derive(Clone)]
pub(super) struct Lemma<'a> {
    pub(super) name: String,
    pub(super) printer: Printer<'a>,
    pub(super) variables: Vec<&'static str>,
    pub(super) contains_rounding: bool,
    hypotheses: Vec<&'a Hypothesis>,
}

/// Returns the name of the exponent of a power of two: that of 2ᵃ is power_a.
fn exponent(scale: &str) -> String {
    ascii(scale).replace("two", "power")
}

/// Returns H1, H2, …
pub(super) fn numbered_names(letter: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{letter}{i}")).collect()
}

/// Joins words, each after a blank.
pub(super) fn spaced<W: AsRef<str>>(words: impl IntoIterator<Item = W>) -> String {
    words.into_iter().map(|word| format!(" {}", word.as_ref())).collect()
}

pub(super) fn names(variables: &[&'static str]) -> String {
    spaced(variables.iter().map(|var| ascii(var)))
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
    let of = |tree: &Tree| printer.expr(tree);
    let function = |var: &str, tree: &Tree| format!("(fun {} => {})", ascii(var), of(tree));
    match proposition {
        Equal(a, b) => format!("{} = {}", of(a), of(b)),
        Sign(relation, a) => of(a).relation(*relation),
        Within(a, bound) => format!("Rabs {} <= {}", of(a).argument(), of(bound)),
        Derivative(a, by, b) => {
            format!("is_derive {}\n    {}\n    {}", function(by, a), ascii(by), of(b).argument())
        }
        Limit(a, by, b) => format!("is_lim {} p_infty {}", function(by, a), of(b).argument()),
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

/// States that no divisor is 0.
pub(super) fn none_is_zero(divisors: &[Tree], printer: Printer) -> String {
    let all: Vec<_> = divisors.iter().map(|of| format!("{} <> 0", printer.plain().expr(of))).collect();
    all.join(" /\\\n  ")
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
        if contains_rounding && !variables.contains(&PRECISION) {
            variables.push(PRECISION);
        }
        Lemma { name, printer, variables, hypotheses, contains_rounding }
    }

    fn is_minimum_precision(&self, hypothesis: &Hypothesis) -> bool {
        self.contains_rounding && *hypothesis == minimum_precision()
    }

    /// Returns its hypotheses, except the minimum precision, which has another form in Coq.
    pub(super) fn hypotheses(&self) -> impl Iterator<Item = &'a Hypothesis> {
        self.hypotheses.iter().copied().filter(|h| !self.is_minimum_precision(h))
    }

    /// Returns all its hypotheses.
    pub(super) fn premises(&self) -> &[&'a Hypothesis] {
        &self.hypotheses
    }

    /// Returns the label of a hypothesis in proofs: H1, H2, …, and M for the minimum precision.
    pub(super) fn label(&self, hypothesis: &Hypothesis) -> Option<String> {
        if self.is_minimum_precision(hypothesis) {
            return Some("M".into());
        }
        self.hypotheses().position(|h| h == hypothesis).map(|i| format!("H{}", i + 1))
    }

    /// Removes a variable and the hypotheses on it.
    pub(super) fn without(mut self, variable: &str) -> Self {
        self.hypotheses.retain(|h| !h.value.symbols().contains(variable));
        self.variables.retain(|name| *name != variable);
        self
    }

    /// Returns the powers of two in it other than 2ᵖ.
    fn scales(&self) -> impl Iterator<Item = &'static str> {
        SCALES.into_iter().filter(|scale| self.contains_rounding && self.variables.contains(scale))
    }

    fn exponents(&self) -> String {
        spaced(self.scales().map(exponent))
    }

    /// Introduces all variables and hypotheses: P, E, A1, A2, … for powers of two, and H1, H2, … for
    /// hypotheses.
    pub(super) fn intros(&self) -> String {
        let (variables, labels) = (names(&self.variables), numbered_names("H", self.hypotheses().count()));
        let labels = spaced(labels);
        if self.contains_rounding {
            let (exponents, powers) = (self.exponents(), spaced(numbered_names("A", self.scales().count())));
            return format!("intros prec choice{exponents} P{variables} E{powers}{labels}.");
        }
        // Without variables, `intros` would introduce premises of the statement.
        if self.variables.is_empty() { String::new() } else { format!("intros{variables}{labels}.") }
    }

    /// Returns lines that derive Q1, Q2, … from A1, A2, …: the powers of two are positive.
    pub(super) fn signs_of_scales(&self) -> Vec<String> {
        let lines = self.scales().zip(1..).map(|(scale, i)| {
            let exponent = exponent(scale);
            format!("pose proof (bpow_gt_0 radix2 {exponent}) as Q{i}. rewrite <- A{i} in Q{i}.")
        });
        lines.collect()
    }

    /// Returns its name, applied to its variables and to the labels of its hypotheses.
    pub(super) fn applied(&self, label: impl Fn(&Hypothesis) -> String) -> String {
        let (variables, labels) = (names(&self.variables), spaced(self.hypotheses().map(label)));
        let name = &self.name;
        if self.contains_rounding {
            return format!("{name} prec choice{} P{variables} E{labels}", self.exponents());
        }
        format!("{name}{variables}{labels}")
    }

    /// Returns its statement with a proof.
    pub(super) fn text(&self, keyword: &str, conclusion: &str, proof: Script) -> String {
        let (mut start, mut lines, mut powers) = (" ", Vec::new(), Vec::new());
        if self.contains_rounding {
            let exponents = self.exponents();
            let exponents =
                if exponents.is_empty() { exponents } else { format!(" ({} : Z)", &exponents[1..]) };
            lines.push(format!("forall (prec : Z) (choice : Z -> bool){exponents},"));
            lines.push("(2 <= prec)%Z ->".into());
            powers.push(format!("{} = bpow radix2 prec ->", ascii(PRECISION)));
            powers.extend(
                self.scales().map(|scale| format!("{} = bpow radix2 {} ->", ascii(scale), exponent(scale))),
            );
            start = "\n  ";
        }
        if !self.variables.is_empty() {
            lines.push(format!("forall{} : R,", names(&self.variables)));
        }
        lines.extend(powers);
        lines.extend(self.hypotheses().map(|h| format!("{} ->", format_hypothesis(h, self.printer))));
        lines.push(conclusion.to_string());
        let (name, statement, proof) = (&self.name, lines.join("\n  "), proof.into_text());
        format!("\n{keyword} {name} :{start}{statement}.\nProof.\n{proof}Qed.\n")
    }
}
