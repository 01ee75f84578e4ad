//! Theorems and lemmas of a claim, with their proofs.

use super::expr::Expr;
use super::lemma::{Lemma, Result, divisors, format_proposition, none_is_zero};
use super::print::{Printer, ascii, free};
use super::script::Script;
use super::{identifier, theorem_name};
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
    pub(super) fn new(statement: &'a Statement, printer: Printer<'a>) -> Self {
        let name = theorem_name(statement.equation(), statement.name());
        Claim { printer, statement, name }
    }

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
            (None, [], [goal, rates @ ..]) => match goal.proposition {
                Proposition::Limit(_, by, _) => self.limit(by, goal, rates)?,
                _ if rates.is_empty() => self.with_proof("Theorem", &self.lemma(goal), goal)?,
                _ => return Err("several goals".into()),
            },
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

    /// Returns a goal with its proof.
    pub(super) fn with_proof(&self, keyword: &str, lemma: &Lemma, goal: &Goal) -> Result<String> {
        let mut script = Script::of(lemma);
        script.goal(lemma, &goal.proposition)?;
        Ok(lemma.text(keyword, &format_proposition(&goal.proposition, self.printer), script))
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
        let mut script = Script::of(&lemma);
        script.line("repeat apply conj.");
        for divisor in &divisors {
            let is_one = Proposition::Equal(divisor * (Tree::from(1) / divisor), Tree::from(1));
            script.block("-", |script| script.goal(&lemma, &is_one))?;
        }
        Ok(lemma.text("Lemma", &none_is_zero(&divisors, self.printer), script))
    }

    /// States the claim for the computed quantities, which lie in their intervals.
    fn computed(&self, intervals: &[Goal], goal: &Goal) -> Result<String> {
        let lemmas: Vec<_> = intervals.iter().map(|interval| self.lemma(interval)).collect();
        let mut main_lemma = self.lemma(goal);
        main_lemma.name += "_nearby";
        let proofs = lemmas.iter().zip(intervals).map(|(lemma, goal)| self.with_proof("Lemma", lemma, goal));
        let text = proofs.collect::<Result<String>>()? + &self.with_proof("Lemma", &main_lemma, goal)?;
        let Proposition::Within(of, bound) = &goal.proposition else {
            return Err("a computed quantity in a claim other than a bound".into());
        };
        let [of, bound] = [of, bound].map(|tree| {
            let last_first = self.statement.computed().iter().rev();
            last_first.fold(tree.clone(), |tree, c| tree.substitute(&[(c.symbol, c.formula.clone())]))
        });
        let theorem = self.new_lemma("", self.statement.hypotheses_for(Role::InvariantBase), [&of, &bound]);
        let computing = self.computing(lemmas.iter(), |hypothesis| theorem.label(hypothesis));
        let applied = self.applied(&main_lemma, |hypothesis| theorem.label(hypothesis));
        let mut script = Script::new();
        script.line(&theorem.intros());
        script.line(&format!("exact ({computing}{applied})."));
        let conclusion = format_proposition(&Proposition::Within(of, bound), self.printer);
        Ok(text + &theorem.text("Theorem", &conclusion, script))
    }

    /// Returns `let u := FORMULA in let N1 := INTERVAL in`: the computed quantities, with the lemmas that
    /// place them in their intervals.
    pub(super) fn computing<'l>(
        &self,
        lemmas: impl Iterator<Item = &'l Lemma<'l>>,
        label: impl Fn(&Hypothesis) -> Option<String>,
    ) -> String {
        let all = self.statement.computed().iter().zip(lemmas).zip(1..);
        let lets = all.map(|((computed, lemma), i)| {
            let (name, by) = (ascii(computed.symbol), self.printer.expr(&computed.formula));
            format!("let {name} := {by} in let N{i} := {} in ", self.applied(lemma, &label))
        });
        lets.collect()
    }

    /// Applies a lemma to labels of hypotheses, and to N1, N2, … for the intervals of computed quantities.
    pub(super) fn applied(&self, lemma: &Lemma, label: impl Fn(&Hypothesis) -> Option<String>) -> String {
        lemma.applied(|hypothesis| {
            let mut intervals = self.statement.computed().iter().map(|computed| &computed.hypothesis);
            match intervals.position(|interval| interval == hypothesis) {
                Some(i) => format!("N{}", i + 1),
                None => label(hypothesis).unwrap_or_default(),
            }
        })
    }

    /// States a limit, and its rate in lemmas.
    fn limit(&self, by: &'static str, goal: &Goal, rates: &[Goal]) -> Result<String> {
        let rates = rates.iter().map(|rate| match &rate.proposition {
            limit @ Proposition::Limit(..) => self.limit_with_proof("Lemma", rate.part, by, limit),
            _ => self.with_proof("Lemma", &self.lemma(rate), rate),
        });
        Ok(rates.collect::<Result<String>>()?
            + &self.limit_with_proof("Theorem", "", by, &goal.proposition)?)
    }

    fn limit_with_proof(&self, keyword: &str, name: &str, by: &str, limit: &Proposition) -> Result<String> {
        let hypotheses = self.statement.hypotheses_for(Role::Claim);
        let lemma = self.new_lemma(name, hypotheses.clone(), limit.trees()).without(by);
        let mut script = Script::of(&lemma);
        script.limit(&lemma, &hypotheses, limit)?;
        Ok(lemma.text(keyword, &format_proposition(limit, self.printer), script))
    }

    /// States the limit of a formula of powers of a ratio less than 1 in absolute value.
    fn vanishing(&self, Sequence { ratio, member, .. }: &Sequence, to: &Tree) -> Result<String> {
        let goals @ [_, at_zero] = self.statement.goals() else {
            return Err("a limit of several components".into());
        };
        let [small, limit] = [0, 1].map(|i| self.lemma(&goals[i]));
        let text =
            self.with_proof("Lemma", &small, &goals[0])? + &self.with_proof("Lemma", &limit, at_zero)?;
        let hypotheses = self.statement.hypotheses_for(Role::Claim);
        let theorem = self.new_lemma("", hypotheses, [ratio, &member[0], to]).without(POWER);
        let [ratio, of, to] = [ratio, &member[0], to].map(|tree| self.printer.expr(tree));
        let (name, power) = (ascii(POWER), Expr::name(format!("({} ^ n)", ratio.base())));
        let [small_proof, limit_proof] = [&small, &limit].map(|lemma| {
            format!("- exact ({}).", self.applied(lemma, |hypothesis| theorem.label(hypothesis)))
        });
        let mut script = Script::new();
        script.line(&theorem.intros());
        script.line(&format!("apply (limit_of_powers (fun {name} => {of}) {}).", ratio.argument()));
        script.line(&small_proof);
        // Continuity there has the same hypotheses.
        script.block("-", |script| {
            script.line("functions.");
            script.continuity(&limit, &at_zero.proposition)
        })?;
        script.line(&limit_proof);
        let conclusion = format!("is_lim_seq (fun n => {}) {}", of.substitute(&name, &power), to.argument());
        Ok(text + &theorem.text("Theorem", &conclusion, script))
    }
}
