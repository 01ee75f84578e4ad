//! What is said under hypotheses, as a lemma.

use super::print::{Printer, ascii};
use super::script::Script;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::minimum_precision;
use crate::formula::{Hypothesis, Proposition};
use crate::number::Tree;
use crate::number::tree::Step;

/// Why a claim cannot be printed.
pub(super) type Result<T> = std::result::Result<T, String>;

/// What a lemma speaks of and supposes; where it rounds, that is for every precision.
#[derive(Clone)]
pub(super) struct Lemma<'a> {
    pub(super) name: String,
    pub(super) printer: Printer<'a>,
    pub(super) variables: Vec<&'static str>,
    pub(super) rounds: bool,
    hypotheses: Vec<&'a Hypothesis>,
}

/// The exponent of a power of two: that of 2ᵃ is power_a.
fn exponent(scale: &str) -> String {
    ascii(scale).replace("two", "power")
}

/// H1, H2, …
pub(super) fn numbered(letter: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{letter}{i}")).collect()
}

/// Words, each after a blank.
pub(super) fn spaced<W: AsRef<str>>(words: impl IntoIterator<Item = W>) -> String {
    words.into_iter().map(|word| format!(" {}", word.as_ref())).collect()
}

pub(super) fn names(variables: &[&'static str]) -> String {
    spaced(variables.iter().map(|var| ascii(var)))
}

pub(super) fn supposed(hypothesis: &Hypothesis, printer: Printer) -> String {
    match hypothesis.distance() {
        Some((distance, most)) => says(&Proposition::Within(distance, most.clone()), printer.plain()),
        None => printer.plain().expr(&hypothesis.value).relation(hypothesis.relation),
    }
}

pub(super) fn says(says: &Proposition, printer: Printer) -> String {
    let of = |tree: &Tree| printer.expr(tree);
    let under = |var: &str, tree: &Tree| format!("(fun {} => {})", ascii(var), of(tree));
    match says {
        Proposition::Equal(a, b) => format!("{} = {}", of(a), of(b)),
        Proposition::Sign(relation, a) => of(a).relation(*relation),
        Proposition::Within(a, bound) => format!("Rabs {} <= {}", of(a).argument(), of(bound)),
        Proposition::Derivative(a, by, b) => {
            format!("is_derive {}\n    {}\n    {}", under(by, a), ascii(by), of(b).argument())
        }
        Proposition::Limit(a, by, b) => format!("is_lim {} p_infty {}", under(by, a), of(b).argument()),
    }
}

/// What formulas divide by, but for numbers; none before its own divisors.
pub(super) fn divisors<'t>(trees: impl Iterator<Item = &'t Tree>) -> Vec<Tree> {
    fn visit(tree: &Tree, all: &mut Vec<Tree>) {
        tree.step().operands().for_each(|operand| visit(operand, all));
        if let Step::Div(_, divisor) = tree.step()
            && !matches!(divisor.step(), Step::Int(n) if *n != 0)
            && !all.contains(divisor)
        {
            all.push(divisor.clone());
        }
    }
    let mut all = Vec::new();
    trees.for_each(|tree| visit(tree, &mut all));
    all
}

/// That none of them is 0.
pub(super) fn none_is_zero(divisors: &[Tree], printer: Printer) -> String {
    let all: Vec<_> =
        divisors.iter().map(|divisor| format!("{} <> 0", printer.plain().expr(divisor))).collect();
    all.join(" /\\\n  ")
}

impl<'a> Lemma<'a> {
    /// Under these hypotheses, of these formulas.
    pub(super) fn new<'t>(
        name: String,
        printer: Printer<'a>,
        rounds: bool,
        hypotheses: Vec<&'a Hypothesis>,
        trees: impl Iterator<Item = &'t Tree>,
    ) -> Self
    where
        'a: 't,
    {
        let supposed = hypotheses.iter().map(|h| &h.value);
        let mut variables = printer.registry.symbols_of(supposed.chain(trees));
        if rounds && !variables.contains(&PRECISION) {
            variables.push(PRECISION);
        }
        Lemma { name, printer, variables, hypotheses, rounds }
    }

    fn says_bits(&self, hypothesis: &Hypothesis) -> bool {
        self.rounds && *hypothesis == minimum_precision()
    }

    /// Its hypotheses, but for that of the precision, which Coq is told otherwise.
    pub(super) fn hypotheses(&self) -> impl Iterator<Item = &'a Hypothesis> {
        self.hypotheses.iter().copied().filter(|given| !self.says_bits(given))
    }

    /// All of them.
    pub(super) fn given(&self) -> &[&'a Hypothesis] {
        &self.hypotheses
    }

    /// What a hypothesis is called in proofs: H1, H2, …, and M for that of the precision.
    pub(super) fn label(&self, hypothesis: &Hypothesis) -> Option<String> {
        if self.says_bits(hypothesis) {
            return Some("M".into());
        }
        self.hypotheses().position(|own| own == hypothesis).map(|i| format!("H{}", i + 1))
    }

    /// Without what speaks of a variable.
    pub(super) fn without(mut self, variable: &str) -> Self {
        self.hypotheses.retain(|given| !given.value.symbols().contains(variable));
        self.variables.retain(|own| *own != variable);
        self
    }

    /// Which powers of two it speaks of besides 2ᵖ.
    fn scales(&self) -> impl Iterator<Item = &'static str> {
        SCALES.into_iter().filter(|scale| self.rounds && self.variables.contains(scale))
    }

    fn exponents(&self) -> String {
        spaced(self.scales().map(exponent))
    }

    /// Introduces all of it: P, E, A1, A2, … for what is said of powers of two, and H1, H2, … for hypotheses.
    pub(super) fn intros(&self) -> String {
        let (variables, labels) = (names(&self.variables), numbered("H", self.hypotheses().count()));
        let labels = spaced(labels);
        if self.rounds {
            let (exponents, powers) = (self.exponents(), spaced(numbered("A", self.scales().count())));
            return format!("intros prec choice{exponents} P{variables} E{powers}{labels}.");
        }
        // Without any, `intros` would take in what the statement says.
        if self.variables.is_empty() { String::new() } else { format!("intros{variables}{labels}.") }
    }

    /// Lines that make of each A1, A2, … a Q1, Q2, …, that the power of two is positive.
    pub(super) fn signs_of_scales(&self) -> Vec<String> {
        let sign = |(scale, i)| {
            let exponent = exponent(scale);
            format!("pose proof (bpow_gt_0 radix2 {exponent}) as Q{i}. rewrite <- A{i} in Q{i}.")
        };
        self.scales().zip(1..).map(sign).collect()
    }

    /// Its name, applied to its variables, and to its hypotheses by what they are called.
    pub(super) fn applied(&self, label: impl Fn(&Hypothesis) -> String) -> String {
        let (variables, labels) = (names(&self.variables), spaced(self.hypotheses().map(label)));
        let name = &self.name;
        if self.rounds {
            return format!("{name} prec choice{} P{variables} E{labels}", self.exponents());
        }
        format!("{name}{variables}{labels}")
    }

    /// What it says, with its proof.
    pub(super) fn text(&self, keyword: &str, says: &str, proof: Script) -> String {
        let (mut start, mut lines, mut powers) = (" ", Vec::new(), Vec::new());
        if self.rounds {
            let exponents = self.exponents();
            let exponents =
                if exponents.is_empty() { exponents } else { format!(" ({} : Z)", &exponents[1..]) };
            lines.push(format!("forall (prec : Z) (choice : Z -> bool){exponents},"));
            lines.push("(2 <= prec)%Z ->".into());
            powers.push(format!("{} = bpow radix2 prec ->", ascii(PRECISION)));
            powers.extend(
                self.scales().map(|own| format!("{} = bpow radix2 {} ->", ascii(own), exponent(own))),
            );
            start = "\n  ";
        }
        if !self.variables.is_empty() {
            lines.push(format!("forall{} : R,", names(&self.variables)));
        }
        lines.extend(powers);
        lines.extend(self.hypotheses().map(|given| format!("{} ->", supposed(given, self.printer))));
        lines.push(says.to_string());
        let (name, says, proof) = (&self.name, lines.join("\n  "), proof.into_text());
        format!("\n{keyword} {name} :{start}{says}.\nProof.\n{proof}Qed.\n")
    }
}
