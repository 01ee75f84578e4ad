//! One goal under hypotheses, with its proof.

use super::print::{Printer, ascii};
use super::script::Script;
use crate::formula::{Hypothesis, Registry, Relation};
use crate::formula::{Proposition, Statement};
use crate::number::Tree;
use crate::number::tree::Step;
use crate::proof::kernel;
use crate::proof::kernel::Derivation;
use crate::proof::paper::Paper;

/// Why a claim cannot be printed.
pub(super) type Result<T> = std::result::Result<T, String>;

/// One goal under hypotheses.
#[derive(Clone)]
pub(super) struct Lemma<'a> {
    pub(super) name: String,
    pub(super) printer: Printer<'a>,
    pub(super) hypotheses: Vec<&'a Hypothesis>,
    pub(super) proposition: &'a Proposition,
    pub(super) defined: Option<Defined>,
}

/// A lemma that no divisor is 0, under the hypotheses of a claim.
#[derive(Clone)]
pub(super) struct Defined {
    pub(super) name: String,
    pub(super) variables: Vec<&'static str>,
    pub(super) divisors: Vec<Tree>,
}

impl Defined {
    /// Brings in what it says as N1, N2, …
    pub(super) fn recall(&self, hypotheses: &str) -> String {
        let lemma = format!("{}{}{hypotheses}", self.name, names(&self.variables));
        match self.divisors.len() {
            1 => format!("pose proof ({lemma}) as N1."),
            n => format!("destruct ({lemma}) as ({}).", numbered("N", n).join(" & ")),
        }
    }
}

/// H1, H2, …
pub(super) fn numbered(letter: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{letter}{i}")).collect()
}

pub(super) fn depends(tree: &Tree, on: &str) -> bool {
    tree.symbols().contains(on)
}

pub(super) fn names(variables: &[&'static str]) -> String {
    variables.iter().map(|var| format!(" {}", ascii(var))).collect()
}

fn for_all(variables: &[&'static str]) -> String {
    if variables.is_empty() { String::new() } else { format!(" forall{} : R,\n ", names(variables)) }
}

/// H1 H2 …, each after a blank.
pub(super) fn labels(n: usize) -> String {
    numbered("H", n).iter().map(|label| format!(" {label}")).collect()
}

/// What is said under hypotheses, with its proof.
pub(super) fn stated(
    keyword: &str,
    name: &str,
    variables: &[&'static str],
    hypotheses: &[&Hypothesis],
    says: &str,
    proof: Script,
    printer: Printer,
) -> String {
    let (variables, proof) = (for_all(variables), proof.into_text());
    let premises = premises(hypotheses, printer);
    format!("\n{keyword} {name} :{variables}{premises} {says}.\nProof.\n{proof}Qed.\n")
}

fn premises(hypotheses: &[&Hypothesis], printer: Printer) -> String {
    hypotheses.iter().map(|h| format!(" {} ->\n ", supposed(h, printer))).collect()
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

fn not_zero(divisor: &Tree, printer: Printer) -> String {
    format!("{} <> 0", printer.plain().expr(divisor))
}

/// That none of them is 0.
pub(super) fn none_is_zero(divisors: &[Tree], printer: Printer) -> String {
    let all: Vec<_> = divisors.iter().map(|divisor| not_zero(divisor, printer)).collect();
    all.join(" /\\\n  ")
}

/// Proves of each divisor that it is not 0, and calls that N1, N2, …
pub(super) fn divisors_script(
    script: &mut Script,
    hypotheses: &[&Hypothesis],
    divisors: &[Tree],
    printer: Printer,
) -> Result<()> {
    for (i, divisor) in divisors.iter().enumerate() {
        let signed =
            |value: &Tree| derivation(hypotheses, &Proposition::Sign(Relation::Positive, value.clone()));
        let (rule, derivation) = match signed(divisor) {
            Ok(derivation) => ("positive_not_zero", derivation),
            Err(_) => ("negative_not_zero", signed(&-divisor)?),
        };
        script.line(&format!("assert (N{} : {}).", i + 1, not_zero(divisor, printer)));
        script.block("{", |own| {
            own.line(&format!("functions. apply {rule}."));
            own.derivation(&derivation)
        })?;
    }
    Ok(())
}

/// # Errors
/// Returns the reason if the kernel finds no derivation.
pub(super) fn derivation(hypotheses: &[&Hypothesis], proposition: &Proposition) -> Result<Derivation> {
    kernel::derivation(hypotheses, proposition).map_err(|why| {
        let statement = Statement::new("", proposition.clone()).assuming(hypotheses.iter().copied());
        let why = Paper::new(&Registry::default()).why(&statement, &why);
        format!("there is no proof to follow: {why}")
    })
}

impl<'a> Lemma<'a> {
    pub(super) fn trees(&self) -> impl Iterator<Item = &Tree> {
        self.hypotheses.iter().map(|h| &h.value).chain(self.proposition.trees())
    }

    pub(super) fn variables(&self) -> Vec<&'static str> {
        self.printer.registry.symbols_of(self.trees())
    }

    /// Its name, applied to its variables by name and to its hypotheses as H1, H2, …
    pub(super) fn applied(&self) -> String {
        format!("{}{}{}", self.name, names(&self.variables()), labels(self.hypotheses.len()))
    }

    /// The lemma with its proof.
    pub(super) fn text(&self, keyword: &str) -> Result<String> {
        let variables = self.variables();
        let mut script = Script::new();
        script.line(&format!("intros{}{}.", names(&variables), labels(self.hypotheses.len())));
        let recalled =
            self.defined.as_ref().filter(|d| d.variables.iter().all(|var| variables.contains(var)));
        match recalled {
            Some(defined) => script.line(&defined.recall(&labels(self.hypotheses.len()))),
            None => divisors_script(&mut script, &self.hypotheses, &divisors(self.trees()), self.printer)?,
        }
        script.line("functions.");
        script.derivation(&derivation(&self.hypotheses, self.proposition)?)?;
        let says = says(self.proposition, self.printer);
        Ok(stated(keyword, &self.name, &variables, &self.hypotheses, &says, script, self.printer))
    }
}
