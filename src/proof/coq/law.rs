//! Claims about what is rounded: theorems about Flocq's rounding to nearest, for every precision and every rule
//! for what is half-way.

use super::lemma::{Result, labels, names, numbered, says, supposed, unproved};
use super::print::{Expr, Printer, ascii};
use super::script::Script;
use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Computed, Goal, Role, Says, Sequence, Statement, two_bits};
use crate::formula::{Hypothesis, Registry};
use crate::number::Tree;
use crate::proof::kernel::{Because, Derivation, Rounding};
use crate::proof::prove;
use std::fmt::Write;

/// A statement about what is rounded, to be printed.
pub(super) struct Law<'a> {
    pub(super) name: &'a str,
    pub(super) statement: &'a Statement,
    pub(super) printer: Printer<'a>,
}

/// One goal of it.
struct Part<'a> {
    name: String,
    hypotheses: Vec<&'a Hypothesis>,
    variables: Vec<&'static str>,
}

impl Part<'_> {
    /// The names of its variables, with others for some of them, and of its hypotheses.
    fn applied(&self, replaced: &[(&str, &str)], hypotheses: &str) -> String {
        let other =
            |var: &str| replaced.iter().find(|(own, _)| *own == var).map(|(_, other)| other.to_string());
        let variables: String = self
            .variables
            .iter()
            .map(|var| format!(" {}", other(var).unwrap_or_else(|| ascii(var))))
            .collect();
        format!("{} prec choice{} P{variables} E{hypotheses}", self.name, scales(&self.variables))
    }
}

/// Which exponents it speaks of.
fn scales(variables: &[&str]) -> String {
    let spoken_of = SCALES.iter().filter(|scale| variables.contains(scale));
    spoken_of.map(|scale| format!(" {}", exponent(scale))).collect()
}

fn exponent(scale: &str) -> String {
    ascii(scale).replace("two", "power")
}

impl<'a> Law<'a> {
    pub(super) fn text(&self) -> Result<String> {
        let Statement { goals, computed, amounts_to, .. } = self.statement;
        if let Some(sequence) = amounts_to.as_ref().filter(|sequence| !sequence.within.is_empty()) {
            return self.sequence(sequence);
        }
        match (computed, goals.as_slice()) {
            (None, [goal]) => self.part("Theorem", self.name.to_string(), goal).map(|(_, text)| text),
            (Some(computed), [_, goal]) => self.computing(computed, goal),
            _ => Err("a law of this kind has several goals".into()),
        }
    }

    fn registry(&self) -> &Registry {
        self.printer.registry
    }

    /// What is supposed where a goal is to be shown, but for the precision.
    fn hypotheses(&self, role: Role) -> Vec<&'a Hypothesis> {
        let Statement { hypotheses, invariants, computed, .. } = self.statement;
        let invariants = matches!(role, Role::Computed | Role::Step | Role::Continues).then_some(invariants);
        let computed = matches!(role, Role::Claim | Role::Step | Role::Continues).then_some(computed);
        let computed = computed.into_iter().flatten().map(|computed| &computed.hypothesis);
        hypotheses.iter().chain(invariants.into_iter().flatten()).chain(computed).collect()
    }

    /// The same without that of the precision, which a theorem says otherwise.
    fn said(&self, role: Role) -> Vec<&'a Hypothesis> {
        self.hypotheses(role).into_iter().filter(|h| **h != two_bits()).collect()
    }

    /// The quantities of formulas; the precision is always one.
    fn variables<'t>(&self, trees: impl Iterator<Item = &'t Tree>) -> Vec<&'static str> {
        let mut all = self.registry().symbols_of(trees);
        if !all.contains(&PRECISION) {
            all.push(PRECISION);
        }
        all
    }

    /// A lemma for a goal.
    fn part(&self, keyword: &str, name: String, goal: &Goal) -> Result<(Part<'a>, String)> {
        // If a goal speaks neither of a member nor of what is computed from it, nothing is supposed of them.
        let computed = self.statement.computed.as_ref().map(|computed| computed.symbol);
        let of_member =
            |tree: &Tree| tree.symbols().into_iter().any(|name| name == MEMBERS[0] || Some(name) == computed);
        let mut hypotheses = self.hypotheses(goal.role);
        if !goal.says.trees().into_iter().any(of_member) {
            hypotheses.retain(|h| !of_member(&h.value));
        }
        let variables = self.variables(hypotheses.iter().map(|h| &h.value).chain(goal.says.trees()));
        let derivation = self.derivation(&hypotheses, goal)?;
        let said: Vec<_> = hypotheses.into_iter().filter(|h| **h != two_bits()).collect();
        let mut script = Script::of_roundings();
        script.line(&format!("{} functions.", self.intros(&variables, said.len())));
        self.proof(&mut script, &derivation)?;
        let text = self.stated(keyword, &name, &variables, &said, &says(&goal.says, self.printer), script);
        Ok((Part { name, hypotheses: said, variables }, text))
    }

    fn derivation(&self, hypotheses: &[&Hypothesis], goal: &Goal) -> Result<Derivation> {
        let statement = Statement {
            hypotheses: hypotheses.iter().copied().cloned().collect(),
            goals: vec![Goal::of_claim("", goal.says.clone())],
            amounts_to: self.statement.amounts_to.clone(),
            ..Statement::default()
        };
        let proof = prove(&statement).map_err(unproved)?;
        proof.goals().first().cloned().ok_or_else(|| "there is nothing to prove".to_string())
    }

    fn intros(&self, variables: &[&str], hypotheses: usize) -> String {
        let scales: Vec<_> = SCALES.iter().filter(|scale| variables.contains(scale)).collect();
        let exponents: String = scales.iter().map(|scale| format!(" {}", exponent(scale))).collect();
        let powers: String = numbered("A", scales.len()).iter().map(|label| format!(" {label}")).collect();
        let labels = labels(hypotheses);
        let variables: String = variables.iter().map(|var| format!(" {}", ascii(var))).collect();
        format!("intros prec choice{exponents} P{variables} E{powers}{labels}.")
    }

    /// For all precisions and all numbers.
    fn stated(
        &self,
        keyword: &str,
        name: &str,
        variables: &[&'static str],
        hypotheses: &[&Hypothesis],
        says: &str,
        script: Script,
    ) -> String {
        let scales: Vec<_> = SCALES.iter().filter(|scale| variables.contains(scale)).collect();
        let mut text = format!("\n{keyword} {name} :\n  forall (prec : Z) (choice : Z -> bool)");
        if !scales.is_empty() {
            let exponents: Vec<_> = scales.iter().map(|scale| exponent(scale)).collect();
            let _ = write!(text, " ({} : Z)", exponents.join(" "));
        }
        let precision = ascii(PRECISION);
        let _ = write!(text, ",\n  (2 <= prec)%Z ->\n  forall{} : R,\n", names(variables));
        let _ = writeln!(text, "  {precision} = bpow radix2 prec ->");
        for scale in scales {
            let _ = writeln!(text, "  {} = bpow radix2 {} ->", ascii(scale), exponent(scale));
        }
        for hypothesis in hypotheses {
            let _ = writeln!(text, "  {} ->", supposed(hypothesis, self.printer));
        }
        let _ = write!(text, "  {says}.\nProof.\n{}Qed.\n", script.into_text());
        text
    }

    /// From models of what is rounded, or by what keeps order or scale.
    fn proof(&self, script: &mut Script, derivation: &Derivation) -> Result<()> {
        if let Derivation::Direct(direct) = derivation {
            match direct.because() {
                Because::Same(_) => return self.scaled(script, direct.errors()),
                Because::Order(_) => return Ok(script.line("by_order.")),
                _ => {}
            }
        }
        let precision = ascii(PRECISION);
        script.line(&format!("pose proof (four_at_least prec {precision} P E) as N."));
        for (i, rounding) in errors(derivation).iter().enumerate() {
            let (name, of) = (ascii(rounding.error().0), self.printer.expr(rounding.of()).argument());
            script.line(&format!(
                "destruct (model prec choice {precision} P E {of}) as ({name} & B{0} & F{0}).",
                i + 1
            ));
        }
        script.line("rounded E.");
        script.line(&format!("assert (M : 0 <= {precision} - 4) by lra."));
        Ok(script.derivation(derivation)?)
    }

    /// Each rounding in other units from that in the usual ones.
    fn scaled(&self, script: &mut Script, errors: &[Rounding]) -> Result<()> {
        let mut made = 0;
        for (i, after) in errors.iter().enumerate() {
            let Some(before) = errors[..i].iter().find(|known| known.error() == after.error()) else {
                continue;
            };
            let usual = after.scale().num().is_one() && after.scale().den().is_one();
            let (before, after) = if usual { (after, before) } else { (before, after) };
            let factor = after.scale().over(before.scale()).ok_or("a scale is 0")?;
            let factor = Expr::ratio(&factor).argument();
            made += 1;
            let [after, before] = [after, before].map(|rounding| self.printer.expr(rounding.of()).argument());
            script.line(&format!(
                "assert (U{made} : fl prec choice {after} = {factor} * fl prec choice {before}) by (in_units {factor})."
            ));
        }
        script.line("by_units.");
        Ok(())
    }

    /// A quantity is near another, and so the claim holds of the one that is computed.
    fn computing(&self, computed: &Computed, goal: &Goal) -> Result<String> {
        let of_computed = &self.statement.goals[0];
        let (near, mut text) = self.part("Lemma", format!("{}_computed", self.name), of_computed)?;
        let (rest, lemma) = self.part("Lemma", format!("{}_nearby", self.name), goal)?;
        text += &lemma;
        let by = self.printer.expr(&computed.by).argument();
        let says_of = |says: &Says| match says {
            Says::Within(of, bound) => {
                let with = |tree: &Tree| tree.with(&[(computed.symbol, computed.by.clone())]);
                Ok(Says::Within(with(of), with(bound)))
            }
            _ => Err("a computed quantity in a claim that is no bound"),
        };
        let own = says_of(&goal.says)?;
        let said = self.said(Role::Begins);
        let variables = self.variables(said.iter().map(|h| &h.value).chain(own.trees()));
        let labels = labels(said.len());
        let mut script = Script::new();
        script.line(&self.intros(&variables, said.len()));
        let inner = near.applied(&[], &labels);
        script.line(&format!(
            "exact ({}).",
            rest.applied(&[(computed.symbol, &by)], &format!("{labels} ({inner})"))
        ));
        text += &self.stated("Theorem", self.name, &variables, &said, &says(&own, self.printer), script);
        Ok(text)
    }

    /// A sequence that stays near another, by induction.
    fn sequence(&self, sequence: &Sequence) -> Result<String> {
        let Statement { goals, invariants, computed: Some(computed), .. } = self.statement else {
            return Err("a sequence of which nothing is computed".into());
        };
        let (mut text, mut parts) = (String::new(), Vec::new());
        for (i, goal) in goals.iter().enumerate() {
            let (part, lemma) = self.part("Lemma", format!("{}_{}", self.name, i + 1), goal)?;
            text += &lemma;
            parts.push((goal.role, part));
        }
        let of = |role: Role| -> Vec<&Part> {
            parts.iter().filter(|(own, _)| *own == role).map(|(_, part)| part).collect()
        };
        let ([start], [step], [of_q, of_x]) = (&sequence.start[..], &sequence.step[..], &invariants[..])
        else {
            return Err("a sequence with other invariants than of a power and a member".into());
        };
        let ([q_begins, x_begins], [q_continues, x_continues], [is_near], hence) =
            (&of(Role::Begins)[..], &of(Role::Continues)[..], &of(Role::Computed)[..], of(Role::Step))
        else {
            return Err("a sequence with other goals than those of its invariants".into());
        };
        let said = self.said(Role::Begins);
        let own = [start, step, &sequence.ratio, &computed.by].into_iter();
        let bounds = sequence.within.iter().flat_map(|(of, bound)| [of, bound]);
        let mut variables = self.variables(said.iter().map(|h| &h.value).chain(own).chain(bounds));
        variables.retain(|var| ![MEMBERS[0], POWER, computed.symbol].contains(var));
        let (arguments, iterates) = (names(&variables), format!("{}_iterates", self.name));
        let [x, u, q] = [MEMBERS[0], computed.symbol, POWER].map(ascii);
        let by = self.printer.expr(&computed.by);
        let _ = write!(
            text,
            "\nFixpoint {iterates} (prec : Z) (choice : Z -> bool) ({} : R) (n : nat) : R :=\n  match n with\n  \
             | O => {}\n  | S n =>\n      let {x} := {iterates} prec choice{arguments} n in\n      \
             let {u} := {by} in\n      {}\n  end.\n",
            arguments.trim_start(),
            self.printer.expr(start),
            self.printer.expr(step),
        );

        let given = labels(said.len());
        let power = format!("({} ^ n)", self.printer.expr(&sequence.ratio).base());
        let member = format!("({iterates} prec choice{arguments} n)");
        let by_member = by.with(&x, &Expr::name(member.clone())).argument().to_string();
        let at = |part: &Part, q_is: &str, x_is: &str| {
            let replaced = [(POWER, q_is), (MEMBERS[0], &member), (computed.symbol, &by_member)];
            let near = is_near.applied(&replaced, &format!("{given} (Q n) {x_is}"));
            // Of the power, of the member, and of what is computed, as far as that is supposed.
            let more = [" (Q n)".to_string(), format!(" {x_is}"), format!(" ({near})")];
            let more = more[..part.hypotheses.len() - said.len()].concat();
            part.applied(&replaced, &(given.clone() + &more))
        };
        let let_q = format!("let {q} := {power} in");
        let let_x = format!("let {x} := {member} in");
        let mut script = Script::new();
        script.line(&self.intros(&variables, said.len()));
        script.line(&format!("assert (Q : forall n : nat, {let_q} {}).", supposed(of_q, self.printer)));
        script.block("{", |own| {
            own.line("induction n as [ | n I]; cbn [pow]; cbv zeta in *.");
            own.line(&format!("- exact ({}).", at(q_begins, "1", "")));
            own.line(&format!("- exact ({}).", at(q_continues, &power, "").replace("(Q n)", "I")));
            Ok(())
        })?;
        script
            .line(&format!("assert (X : forall n : nat, {let_q} {let_x} {}).", supposed(of_x, self.printer)));
        script.block("{", |own| {
            own.line(&format!("induction n as [ | n I]; cbn [{iterates} pow]; cbv zeta in *."));
            own.line(&format!("- exact ({}).", at(x_begins, "1", "")));
            own.line(&format!("- exact ({}).", at(x_continues, &power, "I")));
            Ok(())
        })?;
        script.line("intro n. cbv zeta. repeat apply conj.");
        script.line("- exact (X n).");
        hence.iter().for_each(|part| script.line(&format!("- exact ({}).", at(part, &power, "(X n)"))));
        let bounds = sequence
            .within
            .iter()
            .map(|(of, bound)| says(&Says::Within(of.clone(), bound.clone()), self.printer));
        let bounds: Vec<_> = bounds.collect();
        let says = format!(
            "forall n : nat, {let_q}\n    {let_x}\n    let {u} := {by} in\n    {}",
            bounds.join(" /\\\n    ")
        );
        text += &self.stated("Theorem", self.name, &variables, &said, &says, script);
        Ok(text)
    }
}

/// What is rounded in a derivation, with its errors.
fn errors(derivation: &Derivation) -> &[Rounding] {
    match derivation {
        Derivation::Direct(direct) => direct.errors(),
        Derivation::Cases(_, positive, _) => errors(positive),
    }
}
