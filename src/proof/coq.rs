//! The second route: the chapter and its claims for the proof assistant Coq, whose kernel checks them anew.
//!
//! [`files`] writes every function of the chapter as a definition, printed from its recorded formula, and every
//! claim as a theorem about these definitions, with its hypotheses as premises. The proofs follow what
//! our kernel found, but nothing of it is taken on trust: if Coq accepts the files, what is left to trust
//! is Coq's own kernel, its axioms of the real numbers, and that definitions and theorems read as the
//! chapter does.
//!
//! A function that only hands on what another computes leaves no step of its own in a record, so a theorem speaks
//! in the names of the functions that its entry lists. A definition that no theorem names would protect nothing.
//!
//! What goes further than our own kernel: an induction is one over the natural numbers, a limit is one in the sense of
//! ε and N, a derivative is one in the sense of a limit. Coq lets everything be divided by 0, so for every claim
//! a lemma of its own, `…_defined`, says that no divisor is 0.

mod print;
mod script;

use super::statement::{Goal, Hypothesis, Role, Says, Statement};
use super::{Why, prove};
use crate::claims::{Claim, Formula, Kind, MEMBERS, Relation, Var, claims, entry, formulas};
use crate::number::Tree;
use crate::number::tree::Step;
use print::{Expr, ascii};
use script::Script;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::{fs, io};

/// A file for Coq.
#[derive(Clone, Debug)]
pub struct File {
    /// Its name, which ends in `.v`. A file needs only files whose names come before its own.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// A claim that is not among the files.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The entry it belongs to.
    pub equation: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Why.
    pub reason: String,
}

/// One sign of one definition changed: not all that speaks of it should still be provable.
#[derive(Clone, Debug)]
pub struct Flip {
    /// The changed function, by its name in Coq.
    pub function: String,
    /// The definition as it is now.
    pub definition: String,
    /// All definitions with this one among them, then every theorem that speaks of the function, the shortest
    /// first. It needs the first of [`files`] alone.
    pub file: File,
}

const TACTICS: &str = "A_Tactics";
const CHAPTER: &str = "B_Chapter";
const ITERATES: &str = "D_Iterates";
const ASSUMPTIONS: &str = "E_Assumptions";

/// Everything: tactics, definitions, theorems by section, and what joins them.
///
/// They compile in this order, and in that of their names: `coqc -R DIR Contact FILE`.
pub fn files() -> Vec<File> {
    let theorems = by_section(&WRITTEN.0);
    let all: String = theorems.iter().map(|file| format!(" {}", file.name.trim_end_matches(".v"))).collect();
    let iterates = format!(
        "From Contact Require Import {TACTICS} {CHAPTER}{all}.\n\n{}",
        include_str!("coq/iterates.v")
    );
    let mut files = vec![
        file(TACTICS, include_str!("coq/tactics.v").to_string()),
        file(CHAPTER, chapter(&definitions())),
    ];
    files.extend(theorems);
    files.push(file(ITERATES, iterates));
    // Asking of each theorem what it rests on would take longer than all proofs.
    let parts: Vec<_> = files[2..].iter_mut().map(together).collect();
    let assumptions = format!(
        "(** * What everything rests on. *)\nFrom Contact Require Import {TACTICS} {CHAPTER}{all} {ITERATES}.\n\n\
         Definition everything :=\n  ({}).\nPrint Assumptions everything.\n",
        parts.join(",\n   ")
    );
    files.push(file(ASSUMPTIONS, assumptions));
    files
}

/// Ends a file with all that it proves as one, and says what that is called.
fn together(file: &mut File) -> String {
    let name = format!("proved_in_{}", file.name.trim_end_matches(".v").to_lowercase());
    let proved: Vec<_> = proved(&file.text).collect();
    let text = format!("\nDefinition {name} :=\n  ({}).\n", proved.join(",\n   "));
    file.text += &text;
    name
}

/// The names of the theorems and lemmas in a text.
fn proved(text: &str) -> impl Iterator<Item = &str> {
    let statement =
        |line: &'_ str| line.strip_prefix("Theorem ").or(line.strip_prefix("Lemma ")).map(str::len);
    text.lines().filter_map(move |line| {
        let rest = &line[line.len() - statement(line)?..];
        rest.split(|c| !is_part_of_name(c)).next()
    })
}

/// Writes the files to a directory, which is made if it is not there.
///
/// # Errors
/// The first that the file system reports.
pub fn write(directory: &Path) -> io::Result<Vec<PathBuf>> {
    fs::create_dir_all(directory)?;
    let path = |file: File| -> io::Result<PathBuf> {
        let path = directory.join(file.name);
        fs::write(&path, file.text)?;
        Ok(path)
    };
    files().into_iter().map(path).collect()
}

/// The claims for which there is no theorem, each with its reason.
pub fn left_out() -> Vec<LeftOut> {
    WRITTEN.1.clone()
}

/// What Coq calls a claim: `eq_1_13_rate`, `theorem_1_3_3_contracts`.
pub fn theorem_name(equation: &str, name: &str) -> String {
    let number = if equation.starts_with(|c: char| c.is_ascii_digit()) { "eq " } else { "" };
    identifier(&format!("{number}{equation} {name}"))
}

/// Every way to change one sign of one definition.
pub fn flips() -> Vec<Flip> {
    let definitions = definitions();
    let mut all = Vec::new();
    for (i, definition) in definitions.iter().enumerate() {
        let speaks_of_it = |theorem: &&Written| speaks_of(&theorem.text, &definition.name);
        let mut theorems: Vec<_> = WRITTEN.0.iter().filter(speaks_of_it).collect();
        theorems.sort_by_key(|theorem| theorem.text.len());
        let theorems: String = theorems.iter().map(|theorem| theorem.text.as_str()).collect();
        for (count, body) in definition.body.flips().into_iter().enumerate() {
            let mut flipped = definitions.clone();
            flipped[i].body = body;
            all.push(Flip {
                function: definition.name.clone(),
                definition: flipped[i].to_string(),
                file: file(&format!("F_{}_{}", definition.name, count + 1), chapter(&flipped) + &theorems),
            });
        }
    }
    all
}

/// Does what is stated name a function? What only proofs name says nothing of it.
fn speaks_of(text: &str, function: &str) -> bool {
    let mut stated = text.split("\nProof.\n").map(|part| part.rsplit("Qed.\n").next().unwrap_or_default());
    stated.any(|stated| stated.split(|c: char| !is_part_of_name(c)).any(|word| word == function))
}

fn file(name: &str, text: String) -> File {
    File { name: format!("{name}.v"), text: wrapped(&text) }
}

/// No line is longer than a reader likes; where it is broken means nothing to Coq.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 100;
    let mut all = String::new();
    for mut line in text.lines() {
        let indent = line.len() - line.trim_start().len() + 4;
        while line.len() > WIDTH {
            let text_from = line.len() - line.trim_start().len();
            let Some(end) = line[..WIDTH].rfind(' ').filter(|end| *end > text_from) else { break };
            let _ = write!(all, "{}\n{:indent$}", line[..end].trim_end(), "");
            line = line[end..].trim_start();
        }
        let _ = writeln!(all, "{line}");
    }
    all
}

fn is_part_of_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Words joined by single underscores, in lower case.
fn identifier(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("_")
}

/// A function of the chapter, to be printed.
#[derive(Clone)]
struct Definition {
    formula: &'static Formula,
    name: String,
    body: Expr,
}

impl std::fmt::Display for Definition {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let parameters = print::parameters(self.formula);
        let binders: Vec<_> = parameters.chain(self.formula.depends_on().map(ascii)).collect();
        write!(f, "Definition {} ({} : R) : R :=\n  {}.", self.name, binders.join(" "), self.body)
    }
}

fn definitions() -> Vec<Definition> {
    let definition =
        |formula| Definition { formula, name: print::function(formula), body: Expr::body(formula) };
    formulas().iter().map(definition).collect()
}

fn chapter(definitions: &[Definition]) -> String {
    let mut text = format!(
        "(** * The functions of the chapter, as their source computes them. *)\nFrom Contact Require Import {TACTICS}.\n"
    );
    for definition in definitions {
        let _ = write!(text, "\n{definition}\n#[export] Hint Unfold {} : chapter.\n", definition.name);
    }
    text
}

/// A claim, printed: its lemmas, its theorem, all with their proofs.
struct Written {
    section: String,
    text: String,
}

/// The same at every call, and each asks the kernel for all proofs.
static WRITTEN: LazyLock<(Vec<Written>, Vec<LeftOut>)> = LazyLock::new(written);

/// The claims, printed, and those that cannot be.
fn written() -> (Vec<Written>, Vec<LeftOut>) {
    let (mut written, mut left_out) = (Vec::new(), Vec::new());
    for claim in claims() {
        let section = entry(claim.equation).map_or("", |entry| entry.section).to_string();
        match Theorem::new(claim).text() {
            Ok(text) => written.push(Written { section, text }),
            Err(reason) => left_out.push(LeftOut { equation: claim.equation, name: claim.name, reason }),
        }
    }
    (written, left_out)
}

/// The files of theorems, one or more a section.
fn by_section(written: &[Written]) -> Vec<File> {
    let mut sections: Vec<(&str, Vec<&str>)> = Vec::new();
    for Written { section, text } in written {
        match sections.iter_mut().find(|(known, _)| known == section) {
            Some((_, texts)) => texts.push(text),
            None => sections.push((section, vec![text])),
        }
    }
    let mut files = Vec::new();
    for (section, texts) in sections {
        for (texts, part) in texts.chunks(PER_FILE).zip('a'..='z') {
            let head = format!("From Contact Require Import {TACTICS} {CHAPTER}.\n");
            let name = format!("C_{}_{part}", section.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
            files.push(file(&name, head + &texts.concat()));
        }
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files
}

/// Few enough that files can be compiled side by side.
const PER_FILE: usize = 12;

/// A claim, to be printed.
struct Theorem<'a> {
    claim: &'a Claim,
    /// The functions of its entry: what it says, it says in their names.
    own: &'static [&'static str],
    statement: Statement,
    name: String,
}

/// Why a claim cannot be printed.
type Result<T> = std::result::Result<T, String>;

fn unproved(why: Why) -> String {
    format!("there is no proof to follow: {}", super::paper::why(&why))
}

/// One goal under hypotheses.
#[derive(Clone)]
struct Lemma<'a> {
    name: String,
    own: &'static [&'static str],
    hypotheses: Vec<&'a Hypothesis>,
    says: &'a Says,
    defined: Option<Defined>,
}

/// A lemma that no divisor is 0, under the hypotheses of a claim.
#[derive(Clone)]
struct Defined {
    name: String,
    variables: Vec<Var>,
    divisors: Vec<Tree>,
}

impl Defined {
    /// Brings in what it says as N1, N2, …
    fn recall(&self, hypotheses: &str) -> String {
        let lemma = format!("{}{}{hypotheses}", self.name, names(&self.variables));
        match self.divisors.len() {
            1 => format!("pose proof ({lemma}) as N1."),
            n => format!("destruct ({lemma}) as ({}).", numbered("N", n).join(" & ")),
        }
    }
}

/// H1, H2, …
fn numbered(letter: &str, n: usize) -> Vec<String> {
    (1..=n).map(|i| format!("{letter}{i}")).collect()
}

fn depends(tree: &Tree, on: &str) -> bool {
    tree.symbols().contains(on)
}

/// The coordinates that formulas depend on.
fn variables<'t>(trees: impl Iterator<Item = &'t Tree>) -> Vec<Var> {
    let symbols: Vec<_> = trees.map(Tree::symbols).collect();
    let occurs = |var: &Var| symbols.iter().any(|symbols| symbols.contains(var.symbol()));
    Var::ALL.iter().copied().filter(occurs).collect()
}

fn names(variables: &[Var]) -> String {
    variables.iter().map(|var| format!(" {}", ascii(var.symbol()))).collect()
}

fn for_all(variables: &[Var]) -> String {
    if variables.is_empty() { String::new() } else { format!(" forall{} : R,\n ", names(variables)) }
}

/// H1 H2 …, each after a blank.
fn labels(n: usize) -> String {
    numbered("H", n).iter().map(|label| format!(" {label}")).collect()
}

/// What is said under hypotheses, with its proof.
fn stated(
    keyword: &str,
    name: &str,
    variables: &[Var],
    hypotheses: &[&Hypothesis],
    says: &str,
    proof: Script,
) -> String {
    let (variables, premises, proof) = (for_all(variables), premises(hypotheses), proof.into_text());
    format!("\n{keyword} {name} :{variables}{premises} {says}.\nProof.\n{proof}Qed.\n")
}

fn premises(hypotheses: &[&Hypothesis]) -> String {
    hypotheses.iter().map(|h| format!(" {} ->\n ", Expr::of(&h.value).relation(h.relation()))).collect()
}

fn says(says: &Says, own: &[&str]) -> String {
    let of = |tree: &Tree| Expr::of_entry(tree, own);
    let under = |var: &Var, tree: &Tree| format!("(fun {} => {})", ascii(var.symbol()), of(tree));
    match says {
        Says::Equal(a, b) => {
            let (left, right) = (of(a).to_string(), of(b).to_string());
            let between = if left.len() + right.len() > 80 { "\n  " } else { " " };
            format!("{left} ={between}{right}")
        }
        Says::Sign(relation, a) => of(a).relation(*relation),
        Says::Derivative(a, by, b) => {
            format!("is_derive {}\n    {}\n    {}", under(by, a), ascii(by.symbol()), of(b).argument())
        }
        Says::Limit(a, by, b) => format!("is_lim {} p_infty {}", under(by, a), of(b).argument()),
    }
}

/// What formulas divide by, but for numbers; none before its own divisors.
fn divisors<'t>(trees: impl Iterator<Item = &'t Tree>) -> Vec<Tree> {
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

/// Proves of each divisor that it is not 0, and calls that N1, N2, …
fn divisors_script(script: &mut Script, hypotheses: &[&Hypothesis], divisors: &[Tree]) -> Result<()> {
    for (i, divisor) in divisors.iter().enumerate() {
        let signed = |value: &Tree| {
            let goal = Goal::of_claim("", Says::Sign(Relation::Positive, value.clone()));
            derivation(hypotheses, goal)
        };
        let (rule, derivation) = match signed(divisor) {
            Ok(derivation) => ("positive_not_zero", derivation),
            Err(_) => ("negative_not_zero", signed(&-divisor)?),
        };
        script.line(&format!("assert (N{} : {} <> 0).", i + 1, Expr::of(divisor)));
        script.block("{", |own| {
            own.line(&format!("chapter. apply {rule}."));
            own.derivation(&derivation)
        })?;
    }
    Ok(())
}

fn derivation(hypotheses: &[&Hypothesis], goal: Goal) -> Result<super::kernel::Derivation> {
    let hypotheses = hypotheses.iter().map(|h| (*h).clone()).collect();
    let statement = Statement { hypotheses, goals: vec![goal], ..Statement::default() };
    let proof = prove(&statement).map_err(unproved)?;
    proof.goals().first().cloned().ok_or_else(|| "there is nothing to prove".to_string())
}

impl<'a> Lemma<'a> {
    fn trees(&self) -> impl Iterator<Item = &Tree> {
        self.hypotheses.iter().map(|h| &h.value).chain(self.says.trees())
    }

    fn variables(&self) -> Vec<Var> {
        variables(self.trees())
    }

    /// Its name, applied to its variables by name and to its hypotheses as H1, H2, …
    fn applied(&self) -> String {
        format!("{}{}{}", self.name, names(&self.variables()), labels(self.hypotheses.len()))
    }

    fn goal(&self) -> Goal {
        Goal::of_claim("", self.says.clone())
    }

    /// The lemma with its proof.
    fn text(&self, keyword: &str) -> Result<String> {
        let variables = self.variables();
        let mut script = Script::new();
        script.line(&format!("intros{}{}.", names(&variables), labels(self.hypotheses.len())));
        let recalled =
            self.defined.as_ref().filter(|d| d.variables.iter().all(|var| variables.contains(var)));
        match recalled {
            Some(defined) => script.line(&defined.recall(&labels(self.hypotheses.len()))),
            None => divisors_script(&mut script, &self.hypotheses, &divisors(self.trees()))?,
        }
        script.line("chapter.");
        script.derivation(&derivation(&self.hypotheses, self.goal())?)?;
        Ok(stated(keyword, &self.name, &variables, &self.hypotheses, &says(self.says, self.own), script))
    }
}

impl<'a> Theorem<'a> {
    fn new(claim: &'a Claim) -> Self {
        Theorem {
            claim,
            own: entry(claim.equation).map_or(&[], |entry| entry.functions),
            statement: Statement::of(claim),
            name: theorem_name(claim.equation, claim.name),
        }
    }

    /// A formula that it speaks of. Hypotheses are shared by entries and no part of one.
    fn expr(&self, tree: &Tree) -> Expr {
        Expr::of_entry(tree, self.own)
    }

    /// Its hypotheses, but for those on one coordinate.
    fn hypotheses(&self, without: Option<&str>) -> Vec<&Hypothesis> {
        let keeps = |h: &&Hypothesis| without.is_none_or(|symbol| !depends(&h.value, symbol));
        self.statement.supposed().filter(keeps).collect()
    }

    /// What says that no divisor is 0, if there is any.
    fn defined(&self) -> Option<Defined> {
        let divisors = divisors(self.statement.trees());
        let hypotheses = self.statement.supposed().map(|h| &h.value);
        let variables = variables(hypotheses.chain(&divisors));
        (!divisors.is_empty()).then(|| Defined {
            name: format!("{}_defined", self.name),
            variables,
            divisors,
        })
    }

    /// The same, if these are all its hypotheses.
    fn recalled(&self, hypotheses: &[&Hypothesis]) -> Option<Defined> {
        self.defined().filter(|_| hypotheses.len() == self.statement.supposed().count())
    }

    /// The lemma for one of its goals.
    fn lemma<'s>(&'s self, i: usize, without: Option<&str>) -> Lemma<'s> {
        let goals = &self.statement.goals;
        let part = goals[i].part;
        let same: Vec<_> = (0..goals.len()).filter(|j| goals[*j].part == part).collect();
        let count = same.iter().position(|j| *j == i).filter(|_| same.len() > 1);
        let count = count.map_or(String::new(), |count| format!(" {}", count + 1));
        let name = format!("{}_{}", self.name, identifier(&format!("{part}{count}")));
        let hypotheses = self.hypotheses(without);
        let defined = self.recalled(&hypotheses);
        Lemma { name, own: self.own, hypotheses, says: &goals[i].says, defined }
    }

    /// Its lemmas and the theorem itself.
    fn text(&self) -> Result<String> {
        let mut text = String::new();
        if let Some(defined) = self.defined() {
            text += &self.definedness(&defined)?;
        }
        let hypotheses = self.hypotheses(None);
        text += &match &self.claim.kind {
            Kind::Limit { by, .. } => self.limit(*by)?,
            Kind::Induction { .. } => self.induction()?,
            Kind::Vanishing { .. } => self.vanishing()?,
            _ => {
                let [goal] = self.statement.goals.as_slice() else {
                    return Err("a claim of this kind has several goals".into());
                };
                let defined = self.defined();
                let (name, own) = (self.name.clone(), self.own);
                Lemma { name, own, hypotheses, says: &goal.says, defined }.text("Theorem")?
            }
        };
        Ok(text)
    }

    /// No divisor is 0.
    fn definedness(&self, defined: &Defined) -> Result<String> {
        let Defined { name, variables, divisors } = defined;
        let hypotheses = self.hypotheses(None);
        let mut script = Script::new();
        script.line(&format!("intros{}{}.", names(variables), labels(hypotheses.len())));
        divisors_script(&mut script, &hypotheses, divisors)?;
        script.line("repeat split; assumption.");
        let goals: Vec<_> = divisors.iter().map(|divisor| format!("{} <> 0", Expr::of(divisor))).collect();
        Ok(stated("Lemma", name, variables, &hypotheses, &goals.join(" /\\\n  "), script))
    }

    /// The limit itself; how fast it is reached is in lemmas.
    fn limit(&self, by: Var) -> Result<String> {
        let goals = &self.statement.goals;
        let mut text = String::new();
        for i in 1..goals.len() {
            text += &self.lemma(i, None).text("Lemma")?;
        }
        let x = by.symbol();
        let own = Lemma {
            name: self.name.clone(),
            own: self.own,
            hypotheses: self.hypotheses(Some(x)),
            says: &goals[0].says,
            defined: None,
        };
        let variables: Vec<_> = own.variables().into_iter().filter(|var| *var != by).collect();
        let mut script = Script::new();
        script.line(&format!("intros{}{}. chapter.", names(&variables), labels(own.hypotheses.len())));
        // Whatever is supposed of x itself is that it is positive, or less.
        let all = self.hypotheses(None);
        script.limit(&derivation(&all, own.goal())?, by, |script| {
            let (mut label, mut i) = (Vec::new(), 0);
            for hypothesis in &all {
                if !depends(&hypothesis.value, x) {
                    i += 1;
                    label.push(format!("H{i}"));
                } else if *hypothesis.value.step() != Step::Symbol(x) {
                    return Err("more is supposed of what tends to infinity than that it is positive");
                } else {
                    let weak = hypothesis.relation() == Relation::NonNegative;
                    label.push(if weak { "(Rlt_le _ _ X)".into() } else { "X".into() });
                }
            }
            if let Some(defined) = self.defined() {
                script.line(&format!("{} chapter.", defined.recall(&format!(" {}", label.join(" ")))));
            }
            Ok(())
        })?;
        Ok(text
            + &stated("Theorem", &self.name, &variables, &own.hypotheses, &says(own.says, own.own), script))
    }

    /// The recursion over the natural numbers, and its closed form by induction.
    fn induction(&self) -> Result<String> {
        let Kind::Induction { ratio, start, step, closed } = &self.claim.kind else {
            return Err("no induction".into());
        };
        let q = Var::Q.symbol();
        let lemma = |i: usize| {
            let at_start = matches!(self.statement.goals[i].role, Role::Claim | Role::Begins);
            self.lemma(i, at_start.then_some(q))
        };
        let lemmas: Vec<_> = (0..self.statement.goals.len()).map(lemma).collect();
        let part = |role: Role| -> Vec<&Lemma> {
            let goals = self.statement.goals.iter().zip(&lemmas);
            goals.filter(|(goal, _)| goal.role == role).map(|(_, lemma)| lemma).collect()
        };
        let mut text = lemmas.iter().map(|lemma| lemma.text("Lemma")).collect::<Result<String>>()?;

        let names_of_values = MEMBERS.get(..start.len()).ok_or("the recursion has too many values")?;
        let hypotheses = self.hypotheses(Some(q));
        let trees = start.iter().chain(step).chain(closed).chain([ratio]);
        let free: Vec<_> = variables(trees.chain(hypotheses.iter().map(|h| &h.value)))
            .into_iter()
            .filter(|var| *var != Var::Q)
            .collect();
        let tuple = |trees: &[Tree]| {
            let values: Vec<_> = trees.iter().map(|tree| self.expr(tree).to_string()).collect();
            if let [value] = values.as_slice() {
                value.clone()
            } else {
                format!("({})", values.join(",\n      "))
            }
        };
        let pattern = match names_of_values {
            [name] => ascii(name),
            names => format!("'({})", names.iter().map(|name| ascii(name)).collect::<Vec<_>>().join(", ")),
        };
        let iterates = format!("{}_iterates", self.name);
        let (arguments, ratio) = (names(&free), self.expr(ratio));
        let _ = write!(
            text,
            "\nFixpoint {iterates} ({} : R) (n : nat) : {} :=\n  match n with\n  | O => {}\n  | S n =>\n      \
             let {} := {iterates}{arguments} n in\n      {}\n  end.\n",
            arguments.trim_start(),
            vec!["R"; start.len()].join(" * "),
            tuple(start),
            pattern,
            tuple(step),
        );

        let mut script = Script::new();
        let all = self.hypotheses(None);
        let of_q: Vec<_> = all.iter().filter(|h| depends(&h.value, q)).copied().collect();
        script.line(&format!("intros{arguments}{}.", labels(hypotheses.len())));
        // Where something is supposed of q, it is true of every power of the ratio.
        let (mut next_label, mut next_q) = (0, 0);
        let step_labels: Vec<_> = all
            .iter()
            .map(|h| {
                let (letter, counter) =
                    if depends(&h.value, q) { ("Q", &mut next_q) } else { ("H", &mut next_label) };
                *counter += 1;
                format!("{letter}{counter}")
            })
            .collect();
        let at = |lemma: &Lemma, q_is: &str| {
            let variables = lemma.variables();
            let arguments = variables.iter().map(|var| {
                if *var == Var::Q { format!(" {q_is}") } else { format!(" {}", ascii(var.symbol())) }
            });
            let with_q = lemma.hypotheses.len() == all.len();
            let labels: Vec<_> = if with_q { step_labels.clone() } else { numbered("H", hypotheses.len()) };
            format!("{}{} {}", lemma.name, arguments.collect::<String>(), labels.join(" "))
        };
        let power = format!("({} ^ n)", ratio.base());
        let q_pattern = match of_q.len() {
            1 => "Q1".to_string(),
            n => format!("({})", numbered("Q", n).join(" & ")),
        };
        if !of_q.is_empty() {
            let told: Vec<_> = of_q.iter().map(|h| Expr::of(&h.value).relation(h.relation())).collect();
            script.line(&format!("assert (Q : forall n : nat, let q := {power} in {}).", told.join(" /\\ ")));
            script.block("{", |own| {
                own.line(&format!(
                    "induction n as [ | n {q_pattern}]; cbn [pow]; cbv zeta in *; repeat apply conj."
                ));
                let (at_start, after) = (part(Role::Begins), part(Role::Continues));
                at_start.iter().for_each(|lemma| own.line(&format!("- exact ({}).", at(lemma, "1"))));
                after.iter().for_each(|lemma| own.line(&format!("- exact ({}).", at(lemma, &power))));
                Ok(())
            })?;
        }
        script.line(&format!("induction n as [ | n I]; cbn [{iterates} pow]; cbv zeta in *."));
        let pairs = "repeat apply (f_equal2 pair)";
        script.line("- symmetry.");
        script.line(&format!("  {pairs}."));
        part(Role::Claim).iter().for_each(|lemma| script.line(&format!("  + exact ({}).", at(lemma, "1"))));
        script.line("- rewrite I.");
        if !of_q.is_empty() {
            script.line(&format!("  pose proof (Q n) as {q_pattern}."));
        }
        script.line(&format!("  {pairs}."));
        part(Role::Step).iter().for_each(|lemma| script.line(&format!("  + exact ({}).", at(lemma, &power))));
        let says = format!(
            "forall n : nat, let q := {power} in\n    {iterates}{arguments} n =\n    {}",
            tuple(closed)
        );
        Ok(text + &stated("Theorem", &self.name, &free, &hypotheses, &says, script))
    }

    /// A function of the powers of what is less than 1 in size.
    fn vanishing(&self) -> Result<String> {
        let Kind::Vanishing { ratio, of, to } = &self.claim.kind else {
            return Err("no limit of powers".into());
        };
        let q = Var::Q.symbol();
        let lemmas: Vec<_> = (0..self.statement.goals.len()).map(|i| self.lemma(i, Some(q))).collect();
        let [small, limit] = lemmas.as_slice() else {
            return Err("a limit of powers has two parts".into());
        };
        let text = small.text("Lemma")? + &limit.text("Lemma")?;
        let hypotheses = self.hypotheses(Some(q));
        let trees = [ratio, of, to].into_iter().chain(hypotheses.iter().map(|h| &h.value));
        let free: Vec<_> = variables(trees.clone()).into_iter().filter(|var| *var != Var::Q).collect();
        let (ratio, to) = (self.expr(ratio), self.expr(to));
        let power = Expr::name(format!("({} ^ n)", ratio.base()));
        let mut script = Script::new();
        script.line(&format!("intros{}{}.", names(&free), labels(hypotheses.len())));
        match self.recalled(&hypotheses) {
            Some(defined) => script.line(&defined.recall(&labels(hypotheses.len()))),
            None => divisors_script(&mut script, &hypotheses, &divisors(self.statement.trees()))?,
        }
        let name = ascii(q);
        script.line(&format!(
            "apply (limit_of_powers (fun {name} => {}) {}).",
            self.expr(of),
            ratio.argument()
        ));
        script.line(&format!("- exact ({}).", small.applied()));
        script.line("- chapter. auto_derive; nonzero.");
        script.line(&format!("- exact ({}).", limit.applied()));
        let says = format!("is_lim_seq (fun n => {}) {}", self.expr(of).with(&name, &power), to.argument());
        Ok(text + &stated("Theorem", &self.name, &free, &hypotheses, &says, script))
    }
}
