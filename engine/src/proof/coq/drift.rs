//! A sequence of what is rounded that stays near another: by induction over the natural numbers.

use super::expr::Expr;
use super::law::{Law, Part};
use super::lemma::{Result, labels, names, says, supposed};
use super::print::ascii;
use super::script::Script;
use crate::formula::Hypothesis;
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Computed, Proposition, Role, Sequence};
use crate::number::Tree;
use std::fmt::Write;

/// What the induction is put together from.
struct Lemmas<'a> {
    /// What is computed from a member is near what it should be.
    near: Part<'a>,
    /// Of the power, then of the member: it holds at the start, and after a step if before.
    begins: [Part<'a>; 2],
    continues: [Part<'a>; 2],
    /// What else holds of a member.
    hence: Vec<Part<'a>>,
}

/// The sequence, and its theorem.
struct Drift<'d, 'a> {
    law: &'d Law<'a>,
    sequence: &'d Sequence,
    computed: &'d Computed,
    theorem: Part<'a>,
    /// What the recursion is called.
    iterates: String,
    /// ρᵏ, the k-th member, and what is computed from any.
    power: String,
    member: String,
    by: Expr,
}

impl<'a> Law<'a> {
    /// A sequence that stays near another.
    pub(super) fn drift(&self, sequence: &Sequence, computed: &Computed) -> Result<String> {
        let (lemmas, text) = self.lemmas()?;
        let [of_q, of_x] = self.statement.invariants() else {
            return Err("a sequence with other invariants than of a power and a member".into());
        };
        let drift = Drift::new(self, sequence, computed);
        let (theorem, recursion) = (&drift.theorem, drift.recursion()?);
        let mut script = Script::new();
        script.line(&theorem.intros());
        drift.induction(&mut script, &lemmas, [of_q, of_x])?;
        let theorem = theorem.text("Theorem", &drift.says(), script, self.printer);
        Ok(text + &recursion + &theorem)
    }

    /// A lemma for each goal, by what it is for.
    fn lemmas(&self) -> Result<(Lemmas<'a>, String)> {
        let mut text = String::new();
        let (mut near, mut begins, mut continues, mut hence) = (vec![], vec![], vec![], vec![]);
        for (goal, i) in self.statement.goals().iter().zip(1..) {
            let (part, lemma) = self.lemma("Lemma", format!("{}_{i}", self.name), goal)?;
            text += &lemma;
            match goal.role {
                Role::Computed(_) => near.push(part),
                Role::InvariantBase => begins.push(part),
                Role::InvariantStep => continues.push(part),
                Role::Claim | Role::Step => hence.push(part),
            }
        }
        let several = |_| "a sequence with other goals than those of its two invariants";
        let ([near], begins) = (near.try_into().map_err(several)?, begins.try_into().map_err(several)?);
        let continues = continues.try_into().map_err(several)?;
        Ok((Lemmas { near, begins, continues, hence }, text))
    }
}

impl<'d, 'a> Drift<'d, 'a> {
    fn new(law: &'d Law<'a>, sequence: &'d Sequence, computed: &'d Computed) -> Self {
        let Sequence { start, step, ratio, within, .. } = sequence;
        let bounds = within.iter().flat_map(|(of, bound)| [of, bound]);
        let mut theorem = law.theorem(start.iter().chain(step).chain([ratio, &computed.by]).chain(bounds));
        theorem.variables.retain(|var| ![MEMBERS[0], POWER, computed.symbol].contains(var));
        let (iterates, arguments) = (format!("{}_iterates", law.name), names(&theorem.variables));
        let power = format!("({} ^ n)", law.printer.expr(ratio).base());
        let member = format!("({iterates} prec choice{arguments} n)");
        Drift {
            law,
            sequence,
            computed,
            theorem,
            iterates,
            power,
            member,
            by: law.printer.expr(&computed.by),
        }
    }

    /// From its start, each member by the last.
    fn recursion(&self) -> Result<String> {
        let ([start], [step]) = (&self.sequence.start[..], &self.sequence.step[..]) else {
            return Err("a sequence of several components".into());
        };
        let [start, step] = [start, step].map(|tree| self.law.printer.expr(tree));
        let ([x, u], iterates, by) = (self.names(), &self.iterates, &self.by);
        let arguments = names(&self.theorem.variables);
        let arguments = arguments.trim_start();
        let head = format!("{iterates} (prec : Z) (choice : Z -> bool) ({arguments} : R) (n : nat) : R");
        let mut text = format!("\nFixpoint {head} :=\n  match n with\n  | O => {start}\n  | S n =>\n");
        let _ = writeln!(text, "      let {x} := {iterates} prec choice {arguments} n in");
        let _ = write!(text, "      let {u} := {by} in\n      {step}\n  end.\n");
        Ok(text)
    }

    /// What a member is called, and what is computed from it.
    fn names(&self) -> [String; 2] {
        [MEMBERS[0], self.computed.symbol].map(ascii)
    }

    /// For a power and a member, by these names.
    fn lets(&self) -> [String; 2] {
        let [q, x] = [POWER, MEMBERS[0]].map(ascii);
        [format!("let {q} := {} in", self.power), format!("let {x} := {} in", self.member)]
    }

    /// Each member is near, and so is what is computed from it.
    fn says(&self) -> String {
        let ([let_q, let_x], [_, u], by) = (self.lets(), self.names(), &self.by);
        let bound = |(of, bound): &(Tree, Tree)| {
            says(&Proposition::Within(of.clone(), bound.clone()), self.law.printer)
        };
        let bounds: Vec<_> = self.sequence.within.iter().map(bound).collect();
        let bounds = bounds.join(" /\\\n    ");
        format!("forall n : nat, {let_q}\n    {let_x}\n    let {u} := {by} in\n    {bounds}")
    }

    /// Q of all powers, by induction; X of all members, by another, which uses it; and what follows.
    fn induction(&self, script: &mut Script, lemmas: &Lemmas, invariants: [&Hypothesis; 2]) -> Result<()> {
        let [let_q, let_x] = self.lets();
        let [of_q, of_x] = invariants.map(|given| supposed(given, self.law.printer));
        let Lemmas { near, begins: [q_begins, x_begins], continues: [q_continues, x_continues], hence } =
            lemmas;
        let at = |part: &Part, power: &str, known: &[&str]| self.at(near, part, power, known);
        let exact = |proof: String| format!("- exact ({proof}).");
        script.line(&format!("assert (Q : forall n : nat, {let_q} {of_q})."));
        script.block("{", |own| {
            own.line("induction n as [ | n I]; cbn [pow]; cbv zeta in *.");
            own.line(&exact(at(q_begins, "1", &[])));
            own.line(&exact(at(q_continues, &self.power, &["I"])));
            Ok(())
        })?;
        script.line(&format!("assert (X : forall n : nat, {let_q} {let_x} {of_x})."));
        script.block("{", |own| {
            own.line(&format!("induction n as [ | n I]; cbn [{} pow]; cbv zeta in *.", self.iterates));
            own.line(&exact(at(x_begins, "1", &[])));
            own.line(&exact(at(x_continues, &self.power, &["(Q n)", "I"])));
            Ok(())
        })?;
        script.line("intro n. cbv zeta. repeat apply conj.");
        script.line("- exact (X n).");
        hence.iter().for_each(|part| script.line(&exact(at(part, &self.power, &["(Q n)", "(X n)"]))));
        Ok(())
    }

    /// A lemma for a power and the n-th member, of which this is known; with what is computed from that, as
    /// far as it supposes anything of it.
    fn at(&self, near: &Part, part: &Part, power: &str, known: &[&str]) -> String {
        let given = self.theorem.hypotheses.len();
        let by = self.by.with(&ascii(MEMBERS[0]), &Expr::name(self.member.clone())).argument();
        let replaced = [(POWER, power), (MEMBERS[0], &self.member), (self.computed.symbol, &by)];
        let known_labels: String = known.iter().map(|label| format!(" {label}")).collect();
        let mut all = labels(given) + &known_labels;
        if part.hypotheses.len() > given + known.len() {
            let is_near = near.applied(&replaced, &all);
            let _ = write!(all, " ({is_near})");
        }
        part.applied(&replaced, &all)
    }
}
