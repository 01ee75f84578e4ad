//! Claims about what is rounded: theorems about Flocq's rounding to nearest, for every precision and every
//! rule for what is half-way.

use super::expr::Expr;
use super::lemma::{Result, derivation, divisors, labels, names, none_is_zero, numbered, says, supposed};
use super::print::{Printer, ascii};
use super::script::{Reason, Script, first};
use crate::formula::claim::{MEMBERS, PRECISION, SCALES};
use crate::formula::statement::{Computed, Goal, Proposition, Role, Statement, minimum_precision};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;
use crate::number::tree::Step;
use crate::proof::kernel::algebra::Poly;
use crate::proof::kernel::{Because, Derivation, Rounding};
use std::fmt::Write;

/// A statement about what is rounded, to be printed.
pub(super) struct Law<'a> {
    pub(super) name: &'a str,
    pub(super) statement: &'a Statement,
    pub(super) printer: Printer<'a>,
}

/// Its theorem or one of its lemmas: whatever the precision, under these hypotheses, for these quantities.
pub(super) struct Part<'a> {
    pub(super) name: String,
    /// But for that of the precision, which Coq is told otherwise.
    pub(super) hypotheses: Vec<&'a Hypothesis>,
    /// One of them is 2ᵖ.
    pub(super) variables: Vec<&'static str>,
}

/// The exponent of a power of two: that of 2ᵃ is power_a.
fn exponent(scale: &str) -> String {
    ascii(scale).replace("two", "power")
}

impl Part<'_> {
    /// Which powers of two it speaks of besides 2ᵖ.
    fn scales(&self) -> impl Iterator<Item = &'static str> {
        SCALES.into_iter().filter(|scale| self.variables.contains(scale))
    }

    fn exponents(&self) -> String {
        self.scales().map(|scale| format!(" {}", exponent(scale))).collect()
    }

    /// With P, E, A1, A2, … for what is said of powers of two, and H1, H2, … for hypotheses.
    pub(super) fn intros(&self) -> String {
        let (exponents, variables) = (self.exponents(), names(&self.variables));
        let powers: String =
            numbered("A", self.scales().count()).iter().map(|label| format!(" {label}")).collect();
        format!("intros prec choice{exponents} P{variables} E{powers}{}.", labels(self.hypotheses.len()))
    }

    /// Lines that make of each A1, A2, … a Q1, Q2, …, that the power of two is positive.
    fn signs_of_scales(&self, script: &mut Script) {
        for (scale, i) in self.scales().zip(1..) {
            let exponent = exponent(scale);
            script
                .line(&format!("pose proof (bpow_gt_0 radix2 {exponent}) as Q{i}. rewrite <- A{i} in Q{i}."));
        }
    }

    /// Its name, applied to its variables, with others for some of them, and to its hypotheses.
    pub(super) fn applied(&self, replaced: &[(&str, &str)], hypotheses: &str) -> String {
        let argument = |var: &&'static str| {
            let other = replaced.iter().find(|(own, _)| own == var);
            format!(" {}", other.map_or_else(|| ascii(var), |(_, other)| other.to_string()))
        };
        let variables: String = self.variables.iter().map(argument).collect();
        format!("{} prec choice{} P{variables} E{hypotheses}", self.name, self.exponents())
    }

    /// All of it.
    pub(super) fn text(&self, keyword: &str, says: &str, proof: Script, printer: Printer) -> String {
        let (name, exponents, variables) = (&self.name, self.exponents(), names(&self.variables));
        let mut text = format!("\n{keyword} {name} :\n  forall (prec : Z) (choice : Z -> bool)");
        if !exponents.is_empty() {
            let _ = write!(text, " ({} : Z)", exponents.trim_start());
        }
        let _ = write!(text, ",\n  (2 <= prec)%Z ->\n  forall{variables} : R,\n");
        let _ = writeln!(text, "  {} = bpow radix2 prec ->", ascii(PRECISION));
        for scale in self.scales() {
            let _ = writeln!(text, "  {} = bpow radix2 {} ->", ascii(scale), exponent(scale));
        }
        for hypothesis in &self.hypotheses {
            let _ = writeln!(text, "  {} ->", supposed(hypothesis, printer));
        }
        let _ = write!(text, "  {says}.\nProof.\n{}Qed.\n", proof.into_text());
        text
    }
}

impl<'a> Law<'a> {
    /// Its lemmas and the theorem itself.
    pub(super) fn text(&self) -> Result<String> {
        let statement = self.statement;
        if self.statement.trees().any(|tree| tree.any(&|step| matches!(step.step(), Step::Exp(_)))) {
            return Err("an exponential in a claim about what is rounded".into());
        }
        let sequence = statement.conclusion().filter(|sequence| sequence.is_perturbed());
        let text = match (sequence, statement.computed(), statement.goals()) {
            (Some(sequence), [computed], _) => self.drift(sequence, computed)?,
            (None, [computed], [near, goal]) => self.computing(computed, near, goal)?,
            (None, [], [goal]) => self.lemma("Theorem", self.name.to_string(), goal)?.1,
            (_, [_, _, ..], _) => return Err("several computed quantities".into()),
            _ => return Err("a law of this kind has several goals".into()),
        };
        Ok(self.defined()? + &text)
    }

    /// The theorem, which speaks of these formulas.
    pub(super) fn theorem<'t>(&self, trees: impl Iterator<Item = &'t Tree>) -> Part<'a>
    where
        'a: 't,
    {
        self.part(self.name.to_string(), &self.statement.hypotheses_for(Role::InvariantBase), trees)
    }

    fn part<'t>(
        &self,
        name: String,
        hypotheses: &[&'a Hypothesis],
        trees: impl Iterator<Item = &'t Tree>,
    ) -> Part<'a>
    where
        'a: 't,
    {
        let supposed = hypotheses.iter().map(|h| &h.value);
        let mut variables = self.printer.registry.symbols_of(supposed.chain(trees));
        if !variables.contains(&PRECISION) {
            variables.push(PRECISION);
        }
        let hypotheses = hypotheses.iter().copied().filter(|h| **h != minimum_precision()).collect();
        Part { name, hypotheses, variables }
    }

    /// Returns the hypotheses for a goal, without those on a member and the quantity computed from it if the
    /// goal contains neither.
    fn needed(&self, goal: &Goal) -> Vec<&'a Hypothesis> {
        let computed = self.statement.computed();
        let own =
            |name: &&str| *name == MEMBERS[0] || computed.iter().any(|computed| computed.symbol == *name);
        let speaks_of_it = |tree: &Tree| tree.symbols().iter().any(own);
        let mut hypotheses = self.statement.hypotheses_for(goal.role);
        if !goal.proposition.trees().into_iter().any(speaks_of_it) {
            hypotheses.retain(|h| !speaks_of_it(&h.value));
        }
        hypotheses
    }

    /// A lemma for a goal.
    pub(super) fn lemma(&self, keyword: &str, name: String, goal: &Goal) -> Result<(Part<'a>, String)> {
        let hypotheses = self.needed(goal);
        let part = self.part(name, &hypotheses, goal.proposition.trees().into_iter());
        let mut script = Script::of_roundings();
        script.line(&format!("{} functions.", part.intros()));
        part.signs_of_scales(&mut script);
        self.proof(&mut script, &derivation(&hypotheses, &goal.proposition)?)?;
        let text = part.text(keyword, &says(&goal.proposition, self.printer), script, self.printer);
        Ok((part, text))
    }

    /// No divisor is 0; empty if there is none.
    ///
    /// # Errors
    /// The sign of a divisor is open.
    fn defined(&self) -> Result<String> {
        let divisors = divisors(self.statement.trees());
        if divisors.is_empty() {
            return Ok(String::new());
        }
        let name = format!("{}_defined", self.name);
        let hypotheses = self.statement.hypotheses_for(Role::InvariantBase);
        let part = self.part(name, &hypotheses, divisors.iter());
        let mut script = Script::of_roundings();
        script.line(&format!("{} functions.", part.intros()));
        part.signs_of_scales(&mut script);
        script.line("repeat apply conj.");
        for divisor in &divisors {
            // Rounded, it is 0 where it was 0.
            let (mut exact, mut tactic) = (divisor, String::new());
            while let Step::Rounded(inner) = exact.step() {
                tactic += "apply fl_not_zero; [exact P | ]. ";
                exact = inner;
            }
            let signed = |value: Tree| derivation(&hypotheses, &Proposition::Sign(Relation::Positive, value));
            let (rule, derivation) = match signed(exact.clone()) {
                Ok(derivation) => ("positive_not_zero", derivation),
                Err(_) => ("negative_not_zero", signed(-exact)?),
            };
            script.block("-", |own| {
                own.line(&format!("{tactic}apply {rule}."));
                self.proof(own, &derivation)
            })?;
        }
        Ok(part.text("Lemma", &none_is_zero(&divisors, self.printer), script, self.printer))
    }

    /// From models of what is rounded, or by what keeps order or scale.
    fn proof(&self, script: &mut Script, derivation: &Derivation) -> std::result::Result<(), Reason> {
        if let Derivation::Direct(direct) = derivation {
            match direct.because() {
                Because::Same(_) => return self.in_units(script, direct.errors()),
                Because::Order(_) => return script.order(direct, &ascii(PRECISION)),
                _ => {}
            }
        }
        let precision = ascii(PRECISION);
        script.line(&format!("pose proof (four_at_least prec {precision} P E) as N."));
        for (rounding, i) in first(derivation).errors().iter().zip(1..) {
            let (error, of) = (ascii(rounding.error().0), self.rounded(rounding));
            let model = format!("model prec choice {precision} P E {of}");
            script.line(&format!("destruct ({model}) as ({error} & B{i} & F{i})."));
        }
        script.line("rounded E.");
        script.line(&format!("assert (M : 0 <= {precision} - 4) by lra."));
        script.derivation(derivation)
    }

    /// What is rounded, as an argument.
    fn rounded(&self, rounding: &Rounding) -> String {
        self.printer.expr(rounding.of()).argument()
    }

    /// Each rounding in other units from that in the usual ones.
    fn in_units(&self, script: &mut Script, errors: &[Rounding]) -> std::result::Result<(), Reason> {
        let mut made = 0;
        for (i, later) in errors.iter().enumerate() {
            let Some(earlier) = errors[..i].iter().find(|known| known.error() == later.error()) else {
                continue;
            };
            let is_usual = *later.scale() == Poly::constant(1).into();
            let (usual, other) = if is_usual { (later, earlier) } else { (earlier, later) };
            let factor = other.scale().over(usual.scale()).ok_or("a scale is 0")?;
            let factor = Expr::ratio(&factor).argument();
            let [usual, other] =
                [usual, other].map(|rounding| format!("fl prec choice {}", self.rounded(rounding)));
            made += 1;
            script.line(&format!("assert (U{made} : {other} = {factor} * {usual}) by (in_units {factor})."));
        }
        script.line("by_units.");
        Ok(())
    }

    /// A quantity is near another, and so the claim holds of the one that is computed.
    fn computing(&self, computed: &Computed, near: &Goal, goal: &Goal) -> Result<String> {
        let (near, near_text) = self.lemma("Lemma", format!("{}_computed", self.name), near)?;
        let (rest, rest_text) = self.lemma("Lemma", format!("{}_nearby", self.name), goal)?;
        let Proposition::Within(of, bound) = &goal.proposition else {
            return Err("a computed quantity in a claim that is no bound".into());
        };
        let [of, bound] = [of, bound].map(|tree| tree.with(&[(computed.symbol, computed.by.clone())]));
        let theorem = self.theorem([&of, &bound].into_iter());
        let (by, given) = (self.printer.expr(&computed.by).argument(), labels(theorem.hypotheses.len()));
        let is_near = near.applied(&[], &given);
        let proof = rest.applied(&[(computed.symbol, &by)], &format!("{given} ({is_near})"));
        let mut script = Script::new();
        script.line(&theorem.intros());
        script.line(&format!("exact ({proof})."));
        let says = says(&Proposition::Within(of, bound), self.printer);
        Ok(near_text + &rest_text + &theorem.text("Theorem", &says, script, self.printer))
    }
}
