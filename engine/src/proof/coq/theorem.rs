//! Theorems and lemmas of a claim, with their proofs.

use super::identifier;
use super::lemma::{Lemma, Result, divisors, format_proposition};
use super::print::{Printer, ascii, free};
use super::script::program;
use crate::formula::claim::POWER;
use crate::formula::statement::{Goal, Role, Sequence};
use crate::formula::{Hypothesis, Proposition, Statement};
use crate::number::Tree;

/// A claim to be exported.
pub(super) struct Claim<'a> {
    /// Prints with the names of the functions that the claim concerns.
    pub(super) printer: Printer<'a>,
    pub(super) statement: &'a Statement,
    pub(super) name: String,
}

impl<'a> Claim<'a> {
    /// Returns its theorem and the lemmas before it.
    pub(super) fn text(&self) -> Result<String> {
        let symbols = self.printer.registry.symbols_of(self.statement.trees());
        for (i, symbol) in symbols.iter().enumerate() {
            if let Some(same) = symbols[..i].iter().find(|other| ascii(other) == ascii(symbol)) {
                return Err(format!("{same} and {symbol} have the same name in Coq").into());
            }
        }
        let sequence = self.statement.conclusion();
        let text = match (sequence, self.statement.computed(), self.statement.goals()) {
            (Some(sequence), ..) => match &sequence.limit {
                Some(limit) => self.vanishing(sequence, limit)?,
                None => self.induction(sequence)?,
            },
            (None, [], [goal, rates @ ..]) => {
                let mut theorem = self.lemma(goal);
                theorem.name.clone_from(&self.name);
                self.lemmas(rates)? + &self.with_proof("Theorem", theorem, goal)?
            }
            (None, all, [parts @ .., goal]) if parts.len() == all.len() => self.computed(parts, goal)?,
            _ => return Err("a computed quantity among several goals".into()),
        };
        Ok(self.defined()? + &text)
    }

    /// Returns a lemma about formulas under hypotheses; its name begins with that of the claim.
    pub(super) fn new_lemma<'t>(
        &self,
        name: &str,
        hypotheses: Vec<&'a Hypothesis>,
        trees: impl IntoIterator<Item = &'t Tree>,
    ) -> Lemma<'a>
    where
        'a: 't,
    {
        let name = free(identifier(&format!("{} {name}", self.name)));
        Lemma::new(name, self.printer, self.statement.contains_rounding(), hypotheses, trees.into_iter())
    }

    /// Returns the lemma of a goal. Its name is that of the part, with a number if there are several.
    pub(super) fn lemma(&self, goal: &Goal) -> Lemma<'a> {
        let hypotheses = self.statement.hypotheses_for(goal.role);
        let alike: Vec<_> = self.statement.goals().iter().filter(|other| other.part == goal.part).collect();
        let index = alike.iter().position(|other| std::ptr::eq(*other, goal)).map_or(0, |index| index + 1);
        let number = if alike.len() > 1 { index.to_string() } else { String::new() };
        self.new_lemma(&format!("{} {number}", goal.part), hypotheses, goal.proposition.trees())
    }

    /// Returns goals as lemmas.
    pub(super) fn lemmas(&self, goals: &[Goal]) -> Result<String> {
        goals.iter().map(|goal| self.with_proof("Lemma", self.lemma(goal), goal)).collect()
    }

    /// Returns a goal with its proof. The variable of a limit is bound there.
    fn with_proof(&self, keyword: &str, lemma: Lemma<'a>, goal: &Goal) -> Result<String> {
        let hypotheses = lemma.hypotheses.clone();
        let (lemma, tactic) = match goal.proposition {
            Proposition::Limit(_, by, _) => (lemma.without(by), "shown"),
            Proposition::Derivative(..) => (lemma, "auto_derive; derived"),
            _ => (lemma, "shown"),
        };
        let proof = format!("  {tactic} {}.\n", program(&lemma, &hypotheses, &goal.proposition)?);
        Ok(lemma.text(keyword, &format_proposition(&goal.proposition, self.printer), &proof))
    }

    /// States that no divisor is 0; empty without divisors.
    fn defined(&self) -> Result<String> {
        let divisors = divisors(self.statement.trees());
        if divisors.is_empty() {
            return Ok(String::new());
        }
        let symbols: Vec<_> = self.statement.computed().iter().map(|computed| computed.symbol).collect();
        // For roundings, nothing proved by induction is needed.
        let hypotheses = if divisors.iter().flat_map(Tree::symbols).any(|name| symbols.contains(&name)) {
            self.statement.hypotheses_for(Role::Claim)
        } else if self.statement.contains_rounding() {
            self.statement.hypotheses_for(Role::InvariantBase)
        } else {
            self.statement.all_hypotheses().collect()
        };
        let lemma = self.new_lemma("defined", hypotheses, &divisors);
        let (mut proof, mut all) = ("  repeat apply conj.\n".to_string(), Vec::new());
        for divisor in &divisors {
            let is_one = Proposition::Equal(divisor * (Tree::from(1) / divisor), Tree::from(1));
            proof += &format!("  - shown {}.\n", program(&lemma, &lemma.hypotheses, &is_one)?);
            all.push(format!("{} <> 0", self.printer.plain().expr(divisor)));
        }
        Ok(lemma.text("Lemma", &all.join(" /\\\n  "), &proof))
    }

    /// States the claim for the computed quantities, which lie in their intervals.
    fn computed(&self, intervals: &[Goal], goal: &Goal) -> Result<String> {
        let mut nearby = self.lemma(goal);
        nearby.name += "_nearby";
        let Proposition::Within(of, bound) = &goal.proposition else {
            return Err("a computed quantity in a claim other than a bound".into());
        };
        let [of, bound] = [of, bound].map(|tree| {
            let last_first = self.statement.computed().iter().rev();
            last_first.fold(tree.clone(), |tree, c| tree.substitute(&[(c.symbol, c.formula.clone())]))
        });
        let theorem = self.new_lemma("", self.statement.hypotheses_for(Role::InvariantBase), [&of, &bound]);
        let lets = self.lets(|h| theorem.label(h));
        let proof = format!("  exact ({lets}{}).\n", self.applied(&nearby, |h| theorem.label(h)));
        let text = self.lemmas(intervals)? + &self.with_proof("Lemma", nearby, goal)?;
        let conclusion = format_proposition(&Proposition::Within(of, bound), self.printer);
        Ok(text + &theorem.text("Theorem", &conclusion, &proof))
    }

    /// Returns `let u := FORMULA in let N1 := INTERVAL in`: the computed quantities, with the lemmas that
    /// place them in their intervals.
    pub(super) fn lets(&self, label: impl Fn(&Hypothesis) -> Option<String> + Copy) -> String {
        let lemmas = self.statement.goals().iter().filter(|goal| matches!(goal.role, Role::Computed(_)));
        let all = self.statement.computed().iter().zip(lemmas).zip(1..);
        let lets = all.map(|((computed, goal), i)| {
            let (name, by) = (ascii(computed.symbol), self.printer.expr(&computed.formula));
            format!("let {name} := {by} in let N{i} := {} in ", self.applied(&self.lemma(goal), label))
        });
        lets.collect()
    }

    /// Applies a lemma to labels of hypotheses, and to N1, N2, … for the intervals of computed quantities.
    pub(super) fn applied(&self, lemma: &Lemma, label: impl Fn(&Hypothesis) -> Option<String>) -> String {
        lemma.applied(|hypothesis| {
            let mut intervals = self.statement.computed().iter().map(|computed| &computed.hypothesis);
            let interval = intervals.position(|interval| interval == hypothesis);
            interval.map(|i| format!("N{}", i + 1)).or_else(|| label(hypothesis))
        })
    }

    /// States the limit of a formula of powers of a ratio less than 1 in absolute value.
    fn vanishing(&self, Sequence { ratio, member, .. }: &Sequence, to: &Tree) -> Result<String> {
        let goals @ [_, at_zero] = self.statement.goals() else {
            return Err("a limit of several components".into());
        };
        let hypotheses = self.statement.hypotheses_for(Role::Claim);
        let theorem = self.new_lemma("", hypotheses, [ratio, &member[0], to]).without(POWER);
        let [small, limit] = [0, 1].map(|i| self.lemma(&goals[i]).applied(|h| theorem.label(h)));
        let [ratio, of, to] = [ratio, &member[0], to].map(|tree| self.printer.expr(tree));
        let (name, power, base) = (ascii(POWER), ratio.power(), ratio.argument());
        let continuous = program(&theorem, &theorem.hypotheses, &at_zero.proposition)?;
        let proof = format!(
            "  apply (limit_of_powers (fun {name} => {of}) {base}).\n  - exact ({small}).\n  \
             - functions. auto_derive; derived {continuous}.\n  - exact ({limit}).\n"
        );
        let conclusion = format!("is_lim_seq (fun n => let {name} := {power} in {of}) {}", to.argument());
        Ok(self.lemmas(goals)? + &theorem.text("Theorem", &conclusion, &proof))
    }
}
