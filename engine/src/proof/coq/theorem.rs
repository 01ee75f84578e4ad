//! Theorems and lemmas of a claim, with their proofs.

use super::expr::Expr;
use super::lemma::{Lemma, Result, divisors, format_proposition, none_is_zero};
use super::print::{Printer, ascii, free};
use super::script::Script;
use super::{identifier, theorem_name};
use crate::formula::claim::{MEMBERS, POWER};
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
                return Err(format!("{same} and {symbol} have the same name in Coq"));
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
            (None, own, [near @ .., goal]) if near.len() == own.len() => self.computed(near, goal)?,
            _ => return Err("a computed quantity among several goals".into()),
        };
        Ok(self.defined()? + &text)
    }

    /// Returns a lemma about formulas under hypotheses.
    pub(super) fn supposing<'t>(
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

    /// Returns the lemma of a goal, without hypotheses on a member and the quantity computed from it if the
    /// goal contains neither. Its name is that of the part, with a number if there are several.
    pub(super) fn lemma(&self, goal: &Goal) -> Lemma<'a> {
        let computed = self.statement.computed();
        let own = |name: &&str| *name == MEMBERS[0] || computed.iter().any(|own| own.symbol == *name);
        let speaks_of_it = |tree: &Tree| tree.symbols().iter().any(own);
        let mut hypotheses = self.statement.hypotheses_for(goal.role);
        if !goal.proposition.trees().into_iter().any(speaks_of_it) {
            hypotheses.retain(|h| !speaks_of_it(&h.value));
        }
        let alike: Vec<_> = self.statement.goals().iter().filter(|other| other.part == goal.part).collect();
        let place = alike.iter().position(|other| std::ptr::eq(*other, goal)).map_or(0, |place| place + 1);
        let number = if alike.len() > 1 { place.to_string() } else { String::new() };
        self.supposing(&format!("{} {number}", goal.part), hypotheses, goal.proposition.trees())
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
        let is_computed = |divisor: &Tree| divisor.symbols().iter().any(|name| symbols.contains(name));
        // For roundings, nothing proved by induction is needed.
        let hypotheses = if divisors.iter().any(is_computed) {
            self.statement.hypotheses_for(Role::Claim)
        } else if self.statement.contains_rounding() {
            self.statement.hypotheses_for(Role::InvariantBase)
        } else {
            self.statement.all_hypotheses().collect()
        };
        let lemma = self.supposing("defined", hypotheses, &divisors);
        let mut script = Script::of(&lemma);
        script.line("repeat apply conj.");
        for divisor in &divisors {
            let is_one = Proposition::Equal(divisor * (Tree::from(1) / divisor), Tree::from(1));
            script.block("-", |own| own.goal(&lemma, &is_one))?;
        }
        Ok(lemma.text("Lemma", &none_is_zero(&divisors, self.printer), script))
    }

    /// States the claim for the computed quantities, which lie in their intervals.
    fn computed(&self, near: &[Goal], goal: &Goal) -> Result<String> {
        let (are_near, mut rest) = (near.iter().map(|near| self.lemma(near)), self.lemma(goal));
        let are_near: Vec<_> = are_near.collect();
        rest.name += "_nearby";
        let near = are_near.iter().zip(near).map(|(lemma, near)| self.with_proof("Lemma", lemma, near));
        let text = near.collect::<Result<String>>()? + &self.with_proof("Lemma", &rest, goal)?;
        let Proposition::Within(of, bound) = &goal.proposition else {
            return Err("a computed quantity in a claim other than a bound".into());
        };
        let spelled_out = |tree: &Tree| {
            let last_first = self.statement.computed().iter().rev();
            last_first.fold(tree.clone(), |tree, own| tree.substitute(&[(own.symbol, own.formula.clone())]))
        };
        let [of, bound] = [of, bound].map(spelled_out);
        let theorem = self.supposing("", self.statement.hypotheses_for(Role::InvariantBase), [&of, &bound]);
        let label = |given: &Hypothesis| theorem.label(given);
        let (computing, applied) = (self.computing(are_near.iter(), label), self.applied(&rest, label));
        let mut script = Script::new();
        script.line(&theorem.intros());
        script.line(&format!("exact ({computing}{applied})."));
        let says = format_proposition(&Proposition::Within(of, bound), self.printer);
        Ok(text + &theorem.text("Theorem", &says, script))
    }

    /// Returns `let u := FORMULA in let N1 := INTERVAL in`: the computed quantities, with the lemmas that
    /// place them in their intervals.
    pub(super) fn computing<'l>(
        &self,
        near: impl Iterator<Item = &'l Lemma<'l>>,
        label: impl Fn(&Hypothesis) -> Option<String>,
    ) -> String {
        let all = self.statement.computed().iter().zip(near).zip(1..);
        let lets = all.map(|((computed, near), i)| {
            let (name, by) = (ascii(computed.symbol), self.printer.expr(&computed.formula));
            format!("let {name} := {by} in let N{i} := {} in ", self.applied(near, &label))
        });
        lets.collect()
    }

    /// Applies a lemma to labels of hypotheses, and to N1, N2, … for the intervals of computed quantities.
    pub(super) fn applied(&self, lemma: &Lemma, label: impl Fn(&Hypothesis) -> Option<String>) -> String {
        let place =
            |given: &Hypothesis| self.statement.computed().iter().position(|own| own.hypothesis == *given);
        let near = |given: &Hypothesis| Some(format!("N{}", place(given)? + 1));
        lemma.applied(|given| near(given).or_else(|| label(given)).unwrap_or_default())
    }

    /// States the limit; lemmas contain its rate.
    fn limit(&self, by: &'static str, goal: &Goal, rates: &[Goal]) -> Result<String> {
        let all = self.statement.hypotheses_for(Role::Claim);
        let tends = |keyword: &str, name: &str, of: &Proposition| {
            let lemma = self.supposing(name, all.clone(), of.trees()).without(by);
            let mut script = Script::of(&lemma);
            script.limit(&lemma, &all, of)?;
            Ok(lemma.text(keyword, &format_proposition(of, self.printer), script))
        };
        let rates = rates.iter().map(|rate| match &rate.proposition {
            of @ Proposition::Limit(..) => tends("Lemma", rate.part, of),
            _ => self.with_proof("Lemma", &self.lemma(rate), rate),
        });
        Ok(rates.collect::<Result<String>>()? + &tends("Theorem", "", &goal.proposition)?)
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
        let theorem = self.supposing("", hypotheses, [ratio, &member[0], to]).without(POWER);
        let [ratio, of, to] = [ratio, &member[0], to].map(|tree| self.printer.expr(tree));
        let (name, power) = (ascii(POWER), Expr::name(format!("({} ^ n)", ratio.base())));
        let exact =
            |lemma: &Lemma| format!("- exact ({}).", self.applied(lemma, |given| theorem.label(given)));
        let mut script = Script::new();
        script.line(&theorem.intros());
        script.line(&format!("apply (limit_of_powers (fun {name} => {of}) {}).", ratio.argument()));
        script.line(&exact(&small));
        // Continuity there has the same hypotheses.
        script.block("-", |own| {
            own.line("functions.");
            own.continuity(&limit, &at_zero.proposition)
        })?;
        script.line(&exact(&limit));
        let says = format!("is_lim_seq (fun n => {}) {}", of.substitute(&name, &power), to.argument());
        Ok(text + &theorem.text("Theorem", &says, script))
    }
}
