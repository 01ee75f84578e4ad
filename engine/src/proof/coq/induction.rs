//! Theorems about all members of a sequence, by induction over the natural numbers.

use super::lemma::{Lemma, Result, format_hypothesis, format_proposition, names, numbered_names};
use super::print::ascii;
use super::script::Script;
use super::theorem::Claim;
use crate::formula::Hypothesis;
use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::{Goal, Proposition, Role, Sequence};
use crate::number::Tree;

/// A sequence with its theorem.
struct Induction<'c, 'a> {
    claim: &'c Claim<'a>,
    sequence: &'c Sequence,
    theorem: Lemma<'a>,
    /// A lemma for each goal.
    lemmas: Vec<(&'c Goal, Lemma<'a>)>,
    /// Name of the recursion, applied to its arguments before n.
    iterates: String,
    /// ρᵏ.
    power: String,
}

/// Returns one formula, or several in brackets.
fn tuple(values: Vec<String>) -> String {
    match &values[..] {
        [value] => value.clone(),
        values => format!("({})", values.join(",\n      ")),
    }
}

impl<'a> Claim<'a> {
    /// Returns the theorem about a sequence with a closed form, or one that stays near it.
    pub(super) fn induction(&self, sequence: &Sequence) -> Result<String> {
        let Sequence { start, step, ratio, member, within, .. } = sequence;
        if sequence.is_perturbed() && start.len() > 1 {
            return Err("a perturbed sequence of several components".into());
        }
        let lemmas: Vec<_> = self.statement.goals().iter().map(|goal| (goal, self.lemma(goal))).collect();
        let proved = lemmas.iter().map(|(goal, lemma)| self.with_proof("Lemma", lemma, goal));
        let text = proved.collect::<Result<String>>()?;

        let computed = self.statement.computed();
        let trees = start.iter().chain(step).chain(member).chain([ratio]);
        let trees = trees.chain(within.iter().flat_map(|(of, bound)| [of, bound]));
        let trees = trees.chain(computed.iter().map(|computed| &computed.formula));
        let mut theorem = self.new_lemma("", self.statement.hypotheses_for(Role::InvariantBase), trees);
        theorem.variables.retain(|var| {
            *var != POWER && !MEMBERS.contains(var) && computed.iter().all(|c| c.symbol != *var)
        });
        let choice = if theorem.contains_rounding { " prec choice" } else { "" };
        let iterates = format!("{}_iterates{choice}{}", self.name, names(&theorem.variables));
        let power = format!("({} ^ n)", self.printer.expr(ratio).base());
        let induction = Induction { claim: self, sequence, theorem, lemmas, iterates, power };
        Ok(text + &induction.recursion() + &induction.text()?)
    }
}

impl Induction<'_, '_> {
    fn tuple(&self, trees: &[Tree]) -> String {
        tuple(trees.iter().map(|tree| self.claim.printer.expr(tree).to_string()).collect())
    }

    /// Returns `let u := FORMULA in` for quantities computed from a member.
    fn computed(&self, indent: &str) -> String {
        let computed = self.claim.statement.computed().iter();
        let text = computed.map(|computed| {
            let by = self.claim.printer.expr(&computed.formula);
            format!("{indent}let {} := {by} in\n", ascii(computed.symbol))
        });
        text.collect()
    }

    /// Defines the recursion from its start.
    fn recursion(&self) -> String {
        let Sequence { start, step, .. } = self.sequence;
        let members: Vec<_> = MEMBERS[..start.len()].iter().map(|name| ascii(name)).collect();
        let pattern = match &members[..] {
            [name] => name.clone(),
            names => format!("'({})", names.join(", ")),
        };
        let variables = match names(&self.theorem.variables) {
            none if none.is_empty() => none,
            names => format!(" ({} : R)", names.trim_start()),
        };
        let choice = if self.theorem.contains_rounding { " (prec : Z) (choice : Z -> bool)" } else { "" };
        let head = format!("{}_iterates{choice}{variables} (n : nat)", self.claim.name);
        let kind = vec!["R"; start.len()].join(" * ");
        format!(
            "\nFixpoint {head} : {kind} :=\n  match n with\n  | O => {}\n  | S n =>\n\
             \x20     let {pattern} := {} n in\n{}      {}\n  end.\n",
            self.tuple(start),
            self.iterates,
            self.computed("      "),
            self.tuple(step)
        )
    }

    /// Returns `let q := ρⁿ in`, and `let x := MEMBER in` if the statement is more than a closed form.
    fn lets(&self) -> String {
        let power = format!("let {} := {} in", ascii(POWER), self.power);
        match self.sequence.is_perturbed() {
            true => format!("{power}\n    let {} := {} in", ascii(MEMBERS[0]), self.member()),
            false => power,
        }
    }

    fn member(&self) -> String {
        format!("({} n)", self.iterates)
    }

    /// Returns the statement: each member is, or is near, its closed form, and so are the quantities computed
    /// from it.
    fn conclusion(&self) -> String {
        if !self.sequence.is_perturbed() {
            return format!("forall n : nat, {}\n    {}", self.lets(), self.closed());
        }
        let bounds = self.sequence.within.iter().map(|(of, bound)| {
            format_proposition(&Proposition::Within(of.clone(), bound.clone()), self.claim.printer)
        });
        let bounds: Vec<_> = bounds.collect();
        let (lets, computed) = (self.lets(), self.computed("    "));
        format!("forall n : nat, {lets}\n{computed}    {}", bounds.join(" /\\\n    "))
    }

    fn closed(&self) -> String {
        format!("{} n =\n    {}", self.iterates, self.tuple(&self.sequence.member))
    }

    /// Proves the invariants and the closed form by induction, and then their consequences.
    fn text(&self) -> Result<String> {
        let perturbed = self.sequence.is_perturbed();
        let invariants = self.claim.statement.invariants().iter();
        let mut proved: Vec<_> = invariants.map(|h| format_hypothesis(h, self.claim.printer)).collect();
        proved.extend((!perturbed).then(|| self.closed()));
        let labels = numbered_names("I", proved.len());
        let pattern = if labels.len() == 1 { labels[0].clone() } else { format!("({})", labels.join(" & ")) };
        let last = labels.last().ok_or("the claim has no statement about the sequence")?;

        let mut script = Script::new();
        script.line(&self.theorem.intros());
        script.line(&format!("assert (I : forall n : nat, {} {}).", self.lets(), proved.join(" /\\ ")));
        script.block("{", |script| {
            let unfolded = format!("cbn [{}_iterates pow]; cbv zeta in *;", self.claim.name);
            script.line(&format!("induction n as [ | n {pattern}]; {unfolded}"));
            script.line("  repeat apply conj.");
            self.prove_each(script, Role::InvariantBase);
            if !perturbed {
                self.prove_components(script, "symmetry.", Role::Claim);
            }
            self.prove_each(script, Role::InvariantStep);
            if !perturbed {
                self.prove_components(script, &format!("rewrite {last}."), Role::Step);
            }
            Ok(())
        })?;
        script.line(&format!("intro n. pose proof (I n) as {pattern}. cbv zeta. repeat apply conj."));
        script.line(&format!("- exact {last}."));
        if perturbed {
            self.prove_each(&mut script, Role::Step);
        }
        Ok(self.theorem.text("Theorem", &self.conclusion(), script))
    }

    /// Proves each conjunct by a lemma for a role.
    fn prove_each(&self, script: &mut Script, role: Role) {
        self.by(role).for_each(|lemma| script.line(&format!("- exact ({lemma}).")));
    }

    /// Proves an equation of members, component by component.
    fn prove_components(&self, script: &mut Script, before: &str, role: Role) {
        script.line(&format!("- {before} repeat apply (f_equal2 pair)."));
        self.by(role).for_each(|lemma| script.line(&format!("  + exact ({lemma}).")));
    }

    /// Returns the applied lemmas for a role; in a step for ρⁿ, the n-th member, its invariants I1, I2, …,
    /// and the quantities computed from it.
    fn by(&self, role: Role) -> impl Iterator<Item = String> {
        let is_step = matches!(role, Role::Step | Role::InvariantStep);
        let lets = if is_step { self.step_lets() } else { String::new() };
        let lemmas = self.lemmas.iter().filter(move |(goal, _)| goal.role == role);
        lemmas.map(move |(_, lemma)| format!("{lets}{}", self.claim.applied(lemma, |h| self.label(h))))
    }

    /// Returns the definitions of ρⁿ, of the n-th member, and of the quantities computed from it.
    fn step_lets(&self) -> String {
        let member = format!("let {} := {} in ", ascii(MEMBERS[0]), self.member());
        let member = if self.sequence.is_perturbed() { member } else { String::new() };
        let computed = self.lemmas.iter().filter(|(goal, _)| matches!(goal.role, Role::Computed(_)));
        let computed = self.claim.computing(computed.map(|(_, lemma)| lemma), |h| self.label(h));
        format!("let {} := {} in {member}{computed}", ascii(POWER), self.power)
    }

    fn label(&self, hypothesis: &Hypothesis) -> Option<String> {
        let i = self.claim.statement.invariants().iter().position(|invariant| invariant == hypothesis);
        i.map(|i| format!("I{}", i + 1)).or_else(|| self.theorem.label(hypothesis))
    }
}
