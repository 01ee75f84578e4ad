//! A claim as theorem and lemmas, with their proofs.

use super::expr::Expr;
use super::law::Law;
use super::lemma::{
    Defined, Lemma, Result, depends, derivation, divisors, divisors_script, labels, names, none_is_zero,
    numbered, says, stated, supposed,
};
use super::print::{Printer, ascii, free};
use super::script::Script;
use super::{identifier, theorem_name};
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Goal, Role, Sequence};
use crate::formula::{Hypothesis, Proposition, Relation, Statement};
use crate::number::Tree;
use crate::number::tree::Step;

use std::fmt::Write;

/// A claim, to be printed.
pub(super) struct Theorem<'a> {
    /// What it says, it says in the names of the functions that it is about.
    printer: Printer<'a>,
    statement: &'a Statement,
    name: String,
}

impl<'a> Theorem<'a> {
    pub(super) fn new(statement: &'a Statement, printer: Printer<'a>) -> Self {
        let name = theorem_name(statement.equation(), statement.name());
        Theorem { printer, statement, name }
    }

    /// A formula that it speaks of.
    fn expr(&self, tree: &Tree) -> Expr {
        self.printer.expr(tree)
    }

    fn variables<'t>(&self, trees: impl Iterator<Item = &'t Tree>) -> Vec<&'static str> {
        self.printer.registry.symbols_of(trees)
    }

    /// Its hypotheses, but for those on one coordinate.
    fn hypotheses(&self, without: Option<&str>) -> Vec<&Hypothesis> {
        let keeps = |h: &&Hypothesis| without.is_none_or(|symbol| !depends(&h.value, symbol));
        self.statement.all_hypotheses().filter(keeps).collect()
    }

    /// What says that no divisor is 0, if there is any.
    fn defined(&self) -> Option<Defined> {
        let divisors = divisors(self.statement.trees());
        let hypotheses = self.statement.all_hypotheses().map(|h| &h.value);
        let variables = self.variables(hypotheses.chain(&divisors));
        (!divisors.is_empty()).then(|| Defined {
            name: format!("{}_defined", self.name),
            variables,
            divisors,
        })
    }

    /// The same, if these are all its hypotheses.
    fn recalled(&self, hypotheses: &[&Hypothesis]) -> Option<Defined> {
        self.defined().filter(|_| hypotheses.len() == self.statement.all_hypotheses().count())
    }

    /// The lemma for one of its goals. If that is all that the claim says, it is the theorem.
    fn lemma(&self, i: usize, without: Option<&str>) -> Lemma<'_> {
        let goals = self.statement.goals();
        let part = goals[i].part;
        let alike = |goals: &[Goal]| goals.iter().filter(|goal| goal.part == part).count();
        let number = if alike(goals) > 1 { alike(&goals[..=i]).to_string() } else { String::new() };
        let name = free(identifier(&format!("{} {part} {number}", self.name)));
        let hypotheses = self.hypotheses(without);
        let defined = self.recalled(&hypotheses);
        Lemma { name, printer: self.printer, hypotheses, proposition: &goals[i].proposition, defined }
    }

    /// Its lemmas and the theorem itself.
    pub(super) fn text(&self) -> Result<String> {
        let symbols = self.variables(self.statement.trees());
        for (i, symbol) in symbols.iter().enumerate() {
            if let Some(same) = symbols[..i].iter().find(|other| ascii(other) == ascii(symbol)) {
                return Err(format!("{same} and {symbol} have the same name in Coq"));
            }
        }
        if self.statement.contains_rounding() {
            let (name, statement, printer) = (&self.name, self.statement, self.printer);
            return Law { name, statement, printer }.text();
        }
        let defined = self.defined().map(|defined| self.definedness(&defined)).transpose()?;
        let bound = || Err("a bound of what is not rounded".to_string());
        let text = match (self.statement.conclusion(), &self.statement.goals()[0].proposition) {
            (Some(sequence), _) => match &sequence.limit {
                Some(limit) => self.vanishing(sequence, limit)?,
                None if !sequence.is_perturbed() => self.induction(sequence)?,
                None => return bound(),
            },
            (None, Proposition::Limit(_, by, _)) => self.limit(by)?,
            (None, Proposition::Within(..)) => return bound(),
            (None, Proposition::Equal(..) | Proposition::Sign(..) | Proposition::Derivative(..)) => {
                self.lemma(0, None).text("Theorem")?
            }
        };
        Ok(defined.unwrap_or_default() + &text)
    }

    /// No divisor is 0.
    fn definedness(&self, defined: &Defined) -> Result<String> {
        let Defined { name, variables, divisors } = defined;
        let hypotheses = self.hypotheses(None);
        let mut script = Script::new();
        script.line(&format!("intros{}{}.", names(variables), labels(hypotheses.len())));
        divisors_script(&mut script, &hypotheses, divisors, self.printer)?;
        script.line("repeat split; assumption.");
        let says = none_is_zero(divisors, self.printer);
        Ok(stated("Lemma", name, variables, &hypotheses, &says, script, self.printer))
    }

    /// The limit itself; how fast it is reached is in lemmas.
    fn limit(&self, by: &'static str) -> Result<String> {
        let lemmas = (1..self.statement.goals().len()).map(|i| self.lemma(i, None).text("Lemma"));
        let text = lemmas.collect::<Result<String>>()?;
        let own = self.lemma(0, Some(by));
        let variables: Vec<_> = own.variables().into_iter().filter(|var| *var != by).collect();
        let mut script = Script::new();
        script.line(&format!("intros{}{}. functions.", names(&variables), labels(own.hypotheses.len())));
        // Whatever is supposed of x itself is that it is positive, or less.
        let all = self.hypotheses(None);
        script.limit(&derivation(&all, own.proposition)?, by, |script| {
            let (mut label, mut i) = (Vec::new(), 0);
            for hypothesis in &all {
                if !depends(&hypothesis.value, by) {
                    i += 1;
                    label.push(format!("H{i}"));
                } else if *hypothesis.value.step() != Step::Symbol(by) {
                    return Err("more is supposed of what tends to infinity than that it is positive");
                } else {
                    let weak = hypothesis.relation == Relation::NonNegative;
                    label.push(if weak { "(Rlt_le _ _ X)".into() } else { "X".into() });
                }
            }
            if let Some(defined) = self.defined() {
                script.line(&format!("{} functions.", defined.recall(&format!(" {}", label.join(" ")))));
            }
            Ok(())
        })?;
        Ok(text
            + &stated(
                "Theorem",
                &self.name,
                &variables,
                &own.hypotheses,
                &says(own.proposition, self.printer),
                script,
                self.printer,
            ))
    }

    /// The recursion over the natural numbers, and its closed form by induction.
    fn induction(&self, Sequence { ratio, start, step, member, .. }: &Sequence) -> Result<String> {
        let q = POWER;
        let lemma = |i: usize| {
            let at_start = matches!(self.statement.goals()[i].role, Role::Claim | Role::InvariantBase);
            self.lemma(i, at_start.then_some(q))
        };
        let lemmas: Vec<_> = (0..self.statement.goals().len()).map(lemma).collect();
        let part = |role: Role| -> Vec<&Lemma> {
            let goals = self.statement.goals().iter().zip(&lemmas);
            goals.filter(|(goal, _)| goal.role == role).map(|(_, lemma)| lemma).collect()
        };
        let mut text = lemmas.iter().map(|lemma| lemma.text("Lemma")).collect::<Result<String>>()?;

        let hypotheses = self.hypotheses(Some(q));
        let trees = start.iter().chain(step).chain(member).chain([ratio]);
        let free: Vec<_> = self
            .variables(trees.chain(hypotheses.iter().map(|h| &h.value)))
            .into_iter()
            .filter(|var| *var != POWER && !MEMBERS.contains(var))
            .collect();
        let tuple = |trees: &[Tree]| {
            let values: Vec<_> = trees.iter().map(|tree| self.expr(tree).to_string()).collect();
            if let [value] = values.as_slice() {
                value.clone()
            } else {
                format!("({})", values.join(",\n      "))
            }
        };
        let pattern = match &MEMBERS[..start.len()] {
            [name] => ascii(name),
            names => format!("'({})", names.iter().map(|name| ascii(name)).collect::<Vec<_>>().join(", ")),
        };
        let iterates = format!("{}_iterates", self.name);
        let (arguments, ratio) = (names(&free), self.expr(ratio));
        let binder =
            if free.is_empty() { String::new() } else { format!(" ({} : R)", arguments.trim_start()) };
        let _ = write!(
            text,
            "\nFixpoint {iterates}{} (n : nat) : {} :=\n  match n with\n  | O => {}\n  | S n =>\n\
             \x20     let {} := {iterates}{arguments} n in\n      {}\n  end.\n",
            binder,
            vec!["R"; start.len()].join(" * "),
            tuple(start),
            pattern,
            tuple(step),
        );

        let mut script = Script::new();
        let of_q = &self.statement.invariants();
        // Without any, `intros` would take in n.
        let introduced = format!("{arguments}{}", labels(hypotheses.len()));
        if !introduced.is_empty() {
            script.line(&format!("intros{introduced}."));
        }
        // Where something is supposed of q, it is true of every power of the ratio.
        let all_labels = [numbered("H", hypotheses.len()), numbered("Q", of_q.len())].concat();
        let at = |lemma: &Lemma, q_is: &str| {
            let argument = |var: &&str| if *var == POWER { q_is.to_string() } else { ascii(var) };
            let arguments: Vec<_> = lemma.variables().iter().map(argument).collect();
            let labels = &all_labels[..lemma.hypotheses.len()];
            [std::slice::from_ref(&lemma.name), &arguments, labels].concat().join(" ")
        };
        let power = format!("({} ^ n)", ratio.base());
        let q_pattern = match of_q.len() {
            1 => "Q1".to_string(),
            n => format!("({})", numbered("Q", n).join(" & ")),
        };
        if !of_q.is_empty() {
            let told: Vec<_> = of_q.iter().map(|h| supposed(h, self.printer)).collect();
            script.line(&format!("assert (Q : forall n : nat, let q := {power} in {}).", told.join(" /\\ ")));
            script.block("{", |own| {
                own.line(&format!(
                    "induction n as [ | n {q_pattern}]; cbn [pow]; cbv zeta in *; repeat apply conj."
                ));
                let (at_start, after) = (part(Role::InvariantBase), part(Role::InvariantStep));
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
            tuple(member)
        );
        Ok(text + &stated("Theorem", &self.name, &free, &hypotheses, &says, script, self.printer))
    }

    /// A function of the powers of what is less than 1 in size.
    fn vanishing(&self, Sequence { ratio, member, .. }: &Sequence, to: &Tree) -> Result<String> {
        let (q, of) = (POWER, &member[0]);
        let [small, limit] = [0, 1].map(|i| self.lemma(i, Some(q)));
        let text = small.text("Lemma")? + &limit.text("Lemma")?;
        let hypotheses = self.hypotheses(Some(q));
        let trees = [ratio, of, to].into_iter().chain(hypotheses.iter().map(|h| &h.value));
        let free: Vec<_> = self.variables(trees.clone()).into_iter().filter(|var| *var != POWER).collect();
        let (ratio, to) = (self.expr(ratio), self.expr(to));
        let power = Expr::name(format!("({} ^ n)", ratio.base()));
        let mut script = Script::new();
        script.line(&format!("intros{}{}.", names(&free), labels(hypotheses.len())));
        match self.recalled(&hypotheses) {
            Some(defined) => script.line(&defined.recall(&labels(hypotheses.len()))),
            None => {
                let divisors = divisors(self.statement.trees());
                divisors_script(&mut script, &hypotheses, &divisors, self.printer)?
            }
        }
        let name = ascii(q);
        script.line(&format!(
            "apply (limit_of_powers (fun {name} => {}) {}).",
            self.expr(of),
            ratio.argument()
        ));
        script.line(&format!("- exact ({}).", small.applied()));
        script.line("- functions. auto_derive; nonzero.");
        script.line(&format!("- exact ({}).", limit.applied()));
        let says = format!("is_lim_seq (fun n => {}) {}", self.expr(of).with(&name, &power), to.argument());
        Ok(text + &stated("Theorem", &self.name, &free, &hypotheses, &says, script, self.printer))
    }
}
