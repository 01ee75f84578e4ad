//! Theorems about all members of a sequence, by induction over the natural numbers.

use super::lemma::{Lemma, Result, binders, format_hypothesis, format_proposition, spaced};
use super::print::ascii;
use super::theorem::Claim;
use crate::formula::Hypothesis;
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Proposition, Role, Sequence};
use crate::number::Tree;

/// A sequence with its theorem.
struct Induction<'c, 'a> {
    claim: &'c Claim<'a>,
    sequence: &'c Sequence,
    theorem: Lemma<'a>,
    /// Name of the recursion.
    name: String,
}

/// Returns one formula, or several in brackets.
fn tuple(values: impl Iterator<Item = String>) -> String {
    match &values.collect::<Vec<_>>()[..] {
        [value] => value.clone(),
        values => format!("({})", values.join(",\n      ")),
    }
}

impl Claim<'_> {
    /// Returns the theorem about a sequence with a closed form, or one that stays near it.
    pub(super) fn induction(&self, sequence: &Sequence) -> Result<String> {
        let Sequence { start, step, ratio, member, within, .. } = sequence;
        if sequence.is_perturbed() && start.len() > 1 {
            return Err("a perturbed sequence of several components".into());
        }
        let computed = self.statement.computed();
        let trees = start.iter().chain(step).chain(member).chain([ratio]);
        let trees = trees.chain(within.iter().flat_map(|(of, bound)| [of, bound]));
        let trees = trees.chain(computed.iter().map(|computed| &computed.formula));
        let mut theorem = self.new_lemma("", self.statement.hypotheses_for(Role::InvariantBase), trees);
        theorem.variables.retain(|var| {
            *var != POWER && !MEMBERS.contains(var) && computed.iter().all(|c| c.symbol != *var)
        });
        let name = format!("{}_iterates", self.name);
        let induction = Induction { claim: self, sequence, theorem, name };
        Ok(self.lemmas(self.statement.goals())? + &induction.recursion() + &induction.text())
    }
}

impl Induction<'_, '_> {
    fn tuple(&self, trees: &[Tree]) -> String {
        tuple(trees.iter().map(|tree| self.claim.printer.expr(tree).to_string()))
    }

    /// Returns the n-th member.
    fn member(&self) -> String {
        format!("{}{} n", self.name, spaced(self.theorem.variables.iter().map(|var| ascii(var))))
    }

    /// Returns `let u := FORMULA in` for quantities computed from a member.
    fn computed(&self) -> String {
        let computed = self.claim.statement.computed().iter().map(|computed| {
            let by = self.claim.printer.expr(&computed.formula);
            format!("let {} := {by} in\n    ", ascii(computed.symbol))
        });
        computed.collect()
    }

    /// Defines the recursion from its start.
    fn recursion(&self) -> String {
        let Sequence { start, step, .. } = self.sequence;
        let members = tuple(MEMBERS[..start.len()].iter().map(|name| ascii(name)));
        let (name, binders) = (&self.name, binders(self.theorem.variables.iter().copied()));
        let kind = vec!["R"; start.len()].join(" * ");
        format!(
            "\nFixpoint {name}{binders} (n : nat) : {kind} :=\n  match n with\n  | O => {}\n  | S n =>\n    \
             let '{members} := {} in\n    {}{}\n  end.\n",
            self.tuple(start),
            self.member(),
            self.computed(),
            self.tuple(step)
        )
    }

    /// Returns `let q := ρⁿ in`, and `let x := MEMBER in` if the statement is more than a closed form.
    fn lets(&self) -> String {
        let ratio = self.claim.printer.expr(&self.sequence.ratio);
        let power = format!("let {} := {} in ", ascii(POWER), ratio.power());
        match self.sequence.is_perturbed() {
            true => format!("{power}let {} := {} in ", ascii(MEMBERS[0]), self.member()),
            false => power,
        }
    }

    fn label(&self, hypothesis: &Hypothesis) -> Option<String> {
        let i = self.claim.statement.invariants().iter().position(|invariant| invariant == hypothesis);
        i.map(|i| format!("I{}", i + 1)).or_else(|| self.theorem.label(hypothesis))
    }

    /// Proves each component by a lemma for a role; in a step for ρⁿ, the n-th member, its invariants I1, I2, …, and the
    /// quantities computed from it.
    fn by(&self, role: Role) -> String {
        let is_step = matches!(role, Role::Step | Role::InvariantStep);
        let lets = if is_step { self.lets() + &self.claim.lets(|h| self.label(h)) } else { String::new() };
        let goals = self.claim.statement.goals().iter().filter(|goal| goal.role == role);
        let lemmas = goals.map(|goal| self.claim.applied(&self.claim.lemma(goal), |h| self.label(h)));
        lemmas.map(|lemma| format!("  - by_lemma ({lets}{lemma}).\n")).collect()
    }

    /// Proves the invariants and the closed form by induction, and then their consequences: each member is, or is near,
    /// its closed form, and so are the quantities computed from it.
    fn text(&self) -> String {
        let (printer, member, lets) = (self.claim.printer, self.member(), self.lets());
        let invariants = self.claim.statement.invariants().iter();
        let mut proved: Vec<_> = invariants.map(|h| format_hypothesis(h, printer)).collect();
        let step = self.by(Role::Step);
        let (conclusion, rewriting, step, hence) = if self.sequence.is_perturbed() {
            let bounds = self.sequence.within.iter().map(|(of, bound)| {
                format_proposition(&Proposition::Within(of.clone(), bound.clone()), printer)
            });
            let bounds = bounds.collect::<Vec<_>>().join(" /\\\n    ");
            (self.computed() + &bounds, String::new(), String::new(), step)
        } else {
            let closed = format!("{member} =\n    {}", self.tuple(&self.sequence.member));
            proved.push(closed.clone());
            (closed, format!("rewrite I{}", proved.len()), step, String::new())
        };
        let labels: Vec<_> = (1..=proved.len()).map(|i| format!("I{i}")).collect();
        let pattern = if labels.len() == 1 { labels[0].clone() } else { format!("({})", labels.join(" & ")) };
        let proof = format!(
            "  assert (I : forall n : nat, {lets}{}).\n  \
             {{ induction n as [ | n {pattern}]; cbn [{} pow]; cbv zeta in *; [ | {rewriting}]; components.\n\
             {}{}{}{step}  }}\n  \
             intro n. pose proof (I n) as {pattern}. cbv zeta. repeat apply conj.\n  - exact I{}.\n{hence}",
            proved.join(" /\\ "),
            self.name,
            self.by(Role::InvariantBase),
            self.by(Role::Claim),
            self.by(Role::InvariantStep),
            proved.len(),
        );
        self.theorem.text("Theorem", &format!("forall n : nat, {lets}\n    {conclusion}"), &proof)
    }
}
