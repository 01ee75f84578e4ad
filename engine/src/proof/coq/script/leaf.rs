//! Leaves of proofs: what a leaf uses, in the order in which the checker reads it.

use super::super::lemma::{Result, spaced};
use super::super::print::simplified;
use super::{Script, Target};
use crate::formula::statement::Proposition;
use crate::number::{Exponential, Tree};
use crate::proof::check::{
    AbsoluteValue, Atom, Certificate, Known, Leaf, Polynomial, Problem, Quotient, Reason, Rise, Same, Sign,
    State, derivative, parts_of_rise,
};
use crate::proof::trace::{Step, reread, trace};
use std::iter;

/// A leaf that is being written.
pub(super) struct Writer<'w, 'p> {
    target: &'w Target<'w>,
    state: &'w State<'p>,
    leaf: &'w Leaf,
    /// The names of the atoms in scope.
    names: Vec<String>,
    /// The steps in Coq: data, and terms that prove what is assumed.
    steps: Vec<String>,
    /// The number of facts in Coq, and the number there of each fact of the checker so far.
    facts: usize,
    numbers: Vec<Option<usize>>,
    /// The number of hypotheses so far, among those that the leaf lists.
    hypotheses: usize,
    /// The number of roundings so far.
    roundings: usize,
    /// The exponentials with the exponent 0, or that of another one: their exponents, and their equations.
    exponentials: Vec<(Quotient, String)>,
    /// The numbers of rises and orders so far.
    rises: usize,
    orders: usize,
    /// The factors of divisors whose signs are still to come.
    divisors: Vec<Vec<Polynomial>>,
    /// The equation of a rounding, which follows the sign of its denominator.
    rounding: Option<String>,
}

/// Returns a list in Coq.
fn list<W: AsRef<str>>(items: impl IntoIterator<Item = W>) -> String {
    let items = items.into_iter().map(|item| item.as_ref().to_string());
    format!("[{}]", items.collect::<Vec<_>>().join("; "))
}

/// Returns the numbers of a program in Coq.
pub(super) fn environment(names: &[String]) -> String {
    if names.is_empty() { "(@nil R)".into() } else { list(names) }
}

/// Returns a polynomial as text: terms with signs, and a character for each variable.
pub(super) fn text(of: &Polynomial) -> String {
    let mut terms = Vec::new();
    for (powers, coefficient) in of.terms() {
        let factors = powers.iter().zip(b'?'..).filter(|(n, _)| **n > 0);
        let factors = factors.map(|(n, x)| format!("{}{}", char::from(x), unless_one((*n).into())));
        let sign = if coefficient.is_negative() { '-' } else { '+' };
        let number = unless_one(coefficient.unsigned_abs());
        terms.push(format!("{sign}{number}{}", factors.collect::<String>()));
    }
    format!("\"{}\"", terms.join(" "))
}

fn unless_one(n: u128) -> String {
    if n == 1 { String::new() } else { n.to_string() }
}

impl<'w, 'p> Writer<'w, 'p> {
    pub(super) fn new(
        target: &'w Target<'w>,
        state: &'w State<'p>,
        leaf: &'w Leaf,
        is_known: impl Fn(usize) -> bool,
    ) -> Result<Self> {
        let atoms = target.problem.table.atoms();
        // A number that does not occur stands for what is not in scope.
        let names =
            (0..atoms.len()).map(|x| if is_known(x) { target.name(x) } else { "PI".into() }).collect();
        let (steps, hypotheses, roundings, exponentials, rises, orders, divisors, rounding) =
            Default::default();
        let (facts, numbers) = (1, vec![Some(0)]);
        let mut writer = Writer {
            target,
            state,
            leaf,
            names,
            steps,
            facts,
            numbers,
            hypotheses,
            roundings,
            exponentials,
            rises,
            orders,
            divisors,
            rounding,
        };
        for (_, label) in target.known_atoms().filter(|(x, _)| is_known(*x)) {
            writer.add_fact(label);
        }
        let mut translator = reread(state.clone());
        for (x, atom) in atoms.iter().enumerate().filter(|(x, _)| is_known(*x)) {
            let Atom::Exponential(of) = atom else { continue };
            if state.exponent(x).is_some() {
                writer.equate(format!("F{x}"));
                continue;
            }
            let Ok(value) = translator.value(*of) else { continue };
            let mut known = state.exponents.iter();
            let same = known.find(|(_, exponent)| state.facts.are_equal(exponent, &value).unwrap_or(false));
            let other = match same {
                _ if value.num.is_zero() => "exp_0".into(),
                Some((y, _)) => format!("F{y}"),
                None => continue,
            };
            writer.exponentials.push((value, format!("same_exponential _ _ _ _ F{x} {other}")));
        }
        Ok(writer)
    }

    /// Adds a step with its fact, and returns the number of the fact.
    pub(super) fn add_fact(&mut self, step: String) -> usize {
        self.steps.push(step);
        self.facts += 1;
        self.facts - 1
    }

    /// Adds an equation.
    pub(super) fn equate(&mut self, step: String) {
        self.steps.push(step);
    }

    /// Returns the call of a tactic with what is known.
    pub(super) fn call(&self, tactic: &str) -> String {
        let steps: String = self.steps.iter().map(|step| format!(", {step}")).collect();
        let steps = if steps.is_empty() { "tt".into() } else { format!("(tt{steps})") };
        format!("{tactic} {} {steps}", environment(&self.names))
    }

    /// Returns the call that proves a goal.
    pub(super) fn shown(&self, reasons: &[String]) -> String {
        format!("{} {}", self.call("shown"), list(reasons))
    }

    /// Returns the number of hypotheses up to the last interval in which a value lies.
    fn last_interval(&self, value: &Quotient) -> usize {
        let last = self.leaf.hypotheses.iter().rposition(|i| {
            let Ok(x) = self.atom(Atom::IntervalParameter(*i)) else { return false };
            let mut factors = value.den.iter().filter_map(|i| self.state.facts.get(*i).ok());
            value.num.degree(x) > 0 || factors.any(|(of, _)| of.degree(x) > 0)
        });
        last.map_or(0, |last| last + 1)
    }

    /// Adds the equations of exponentials whose exponents are known.
    fn share_exponentials(&mut self) {
        for (value, equation) in std::mem::take(&mut self.exponentials) {
            let is_known = self.last_interval(&value) <= self.hypotheses
                && value.den.iter().all(|i| *i < self.numbers.len());
            if is_known {
                self.equate(equation);
            } else {
                self.exponentials.push((value, equation));
            }
        }
    }

    /// Adds the hypotheses before one that the leaf lists. An interval gives an equation.
    fn hypotheses_before(&mut self, end: usize) -> Result<()> {
        while self.hypotheses < end {
            let i = self.leaf.hypotheses[self.hypotheses];
            if self.target.problem.hypotheses[i].interval().is_some() {
                let x = self.atom(Atom::IntervalParameter(i))?;
                self.equate(format!("F{x}"));
                self.hypotheses += 1;
            } else {
                self.catch_up(self.numbers.len() + 1)?;
            }
        }
        Ok(())
    }

    fn atom(&self, atom: Atom) -> Result<usize> {
        self.target.variable(atom)
    }

    /// Adds the facts before that with a number.
    pub(super) fn catch_up(&mut self, facts: usize) -> Result<()> {
        while self.numbers.len() < facts {
            let i = self.numbers.len();
            let label = self.label(i)?;
            self.share_exponentials();
            let number = label.map(|label| self.add_fact(label));
            self.numbers.push(number);
        }
        Ok(())
    }

    /// Returns the proof of a fact that no certificate shows, if it is in scope.
    fn label(&mut self, i: usize) -> Result<Option<String>> {
        let state = self.state;
        if let Some(index) = state.assumed.iter().position(|(_, fact)| *fact == i) {
            let Some(hypothesis) = state.assumed[index].0 else {
                return Ok(Some(format!("C{}", index + 1)));
            };
            let rest = &self.leaf.hypotheses[self.hypotheses..];
            let next = rest.iter().position(|i| *i == hypothesis).ok_or("a hypothesis that is not listed")?;
            self.hypotheses_before(self.hypotheses + next)?;
            self.hypotheses += 1;
            return Ok(self.target.labels.get(hypothesis).cloned().flatten());
        }
        if let Some(known) = state.sizes.iter().find(|known| known.fact == i) {
            self.hypotheses_before(self.last_interval(&known.value))?;
            let factor = match self.target.problem.table.atoms().get(known.size) {
                Some(Atom::Size(of)) => self.atom(Atom::Factor(*of))?,
                _ => return Err("an absolute value of nothing".into()),
            };
            return Ok(Some(format!("F{factor}")));
        }
        self.hypotheses_before(self.leaf.hypotheses.len())?;
        if self.rises < self.leaf.rises.len() {
            self.rises += 1;
            return Ok(Some(format!("X{}", self.rises)));
        }
        let [a, b] = self.leaf.orders.get(self.orders).ok_or("a fact without a reason")?;
        self.orders += 1;
        Ok(Some(format!("ordered _ _ _ _ _ _ P F{a} F{b}")))
    }

    /// Writes a step of the checker.
    pub(super) fn step(&mut self, step: &Step) -> Result<()> {
        match step {
            Step::Sign { of, reason, facts, .. } => {
                match reason {
                    Reason::Fact(i) => self.catch_up(i + 1)?,
                    Reason::Certificate(certificate) => {
                        self.catch_up(*facts)?;
                        let number = self.certified(of, certificate)?;
                        self.numbers.push(Some(number));
                    }
                }
                self.list_divisors();
                if let Some(equation) = self.rounding.take() {
                    self.share_exponentials();
                    self.equate(equation);
                }
            }
            Step::Divisor(factors) => self.divide(factors.clone()),
            Step::Rounding(same) => {
                let rounded = self.state.rounded.get(self.roundings).ok_or("a rounding of nothing")?;
                self.roundings += 1;
                self.hypotheses_before(self.last_interval(&rounded.value))?;
                let x = self.atom(Atom::Error(rounded.of))?;
                self.rounding = Some(match same {
                    None => format!("F{x}"),
                    Some(same) => self.share(x, same)?,
                });
            }
            Step::Size(of, value, size) => {
                self.hypotheses_before(self.last_interval(value))?;
                let x = self.atom(Atom::Size(*of))?;
                match size {
                    AbsoluteValue::BySign => {}
                    AbsoluteValue::Atom => self.steps.push(format!("F{x}")),
                    AbsoluteValue::Same(i) => {
                        let y = self.state.sizes.get(*i).ok_or("an absolute value of nothing")?.size;
                        self.steps.push(format!("same_size _ _ _ _ F{x} F{y}"));
                    }
                }
            }
        }
        Ok(())
    }

    /// Lists a divisor by its factors as soon as their signs are known.
    pub(super) fn divide(&mut self, factors: Vec<Polynomial>) {
        self.divisors.push(factors);
        self.list_divisors();
    }

    /// Lists the divisors whose factors have signs, and their squares, which occur in derivatives.
    fn list_divisors(&mut self) {
        let is_smooth = matches!(self.target.problem.proposition, Proposition::Derivative(..));
        for factors in std::mem::take(&mut self.divisors) {
            let known = self.state.facts.iter().zip(&self.numbers);
            let strict = known.filter(|((_, sign), _)| sign.is_strict());
            let strict: Vec<_> = strict.filter_map(|((of, _), number)| Some((of, (*number)?))).collect();
            let facts = factors.iter().map(|factor| strict.iter().find(|(of, _)| *of == factor));
            let numbers = facts.map(|fact| fact.map(|(_, number)| number.to_string()));
            let Some(numbers) = numbers.collect::<Option<Vec<_>>>() else {
                self.divisors.push(factors);
                continue;
            };
            let square = is_smooth.then(|| [&numbers[..], &numbers].concat());
            for factors in (numbers.len() != 1).then_some(numbers).into_iter().chain(square) {
                let step = format!("Divisor {}%nat", list(&factors));
                if !self.steps.contains(&step) {
                    self.steps.push(step);
                }
            }
        }
    }

    /// Returns the equation of a rounded formula with the error of an earlier one.
    fn share(&self, x: usize, same: &Same) -> Result<String> {
        let y = self.state.rounded.get(same.rounding).ok_or("a rounding of nothing")?.error;
        let [down, up] = [&same.down, &same.up].map(|of| self.target.polynomial(of).argument());
        let powers = "ltac:(power_of_two) ltac:(power_of_two)";
        Ok(format!("same_error _ _ {down} {up} _ _ _ _ _ {powers} F{x} F{y}"))
    }

    /// Adds what a certificate shows, and returns the number of the fact.
    fn certified(&mut self, of: &Polynomial, certificate: &Certificate) -> Result<usize> {
        let certificate = self.certificate(certificate)?;
        Ok(self.add_fact(format!("Shown {} {certificate}", text(of))))
    }

    /// Returns a certificate as an argument, after adding the lemmas in it.
    fn certificate(&mut self, certificate: &Certificate) -> Result<String> {
        let Certificate { known, left, right } = certificate;
        let mut numbers = Vec::new();
        for quantity in known {
            let number = match quantity {
                Known::Fact(i) => {
                    self.numbers.get(*i).copied().flatten().ok_or("a fact that is not in scope")?
                }
                Known::Value(of) => self.add_fact(format!(r#"Shown {} (identity []%nat "" "")"#, text(of))),
                Known::Lemma(lemma) => self.certified(&lemma.0, &lemma.1)?,
                Known::Exponents { left, right } => {
                    let [left, right] = [left, right].map(|all| product(all));
                    self.add_fact(format!("same_exponents _ _ _ _ {left} {right}"))
                }
            };
            numbers.push(number.to_string());
        }
        Ok(format!("(identity {}%nat {} {})", list(numbers), text(left), text(right)))
    }

    /// Returns the reason for the sign of a goal as an argument.
    pub(super) fn reason(&mut self, step: &Step) -> Result<String> {
        match step {
            Step::Sign { of, reason, .. } if of.is_zero() || matches!(reason, Reason::Fact(_)) => {
                Ok("Known".into())
            }
            Step::Sign { reason: Reason::Certificate(certificate), .. } => {
                Ok(format!("By {}", self.certificate(certificate)?))
            }
            _ => Err("a goal without a sign".into()),
        }
    }

    /// Adds the remaining hypotheses and equations of exponentials.
    pub(super) fn finish(&mut self) -> Result<()> {
        self.hypotheses_before(self.leaf.hypotheses.len())?;
        self.share_exponentials();
        if self.divisors.is_empty() { Ok(()) } else { Err("a divisor without a sign".into()) }
    }
}

/// Returns the proof of e to the power of a sum as a product of exponentials.
fn product(all: &[usize]) -> String {
    let factors = all.iter().map(|x| format!("F{x}"));
    factors.reduce(|product, factor| format!("(both _ _ _ _ {product} {factor})")).unwrap_or("exp_0".into())
}

impl Script {
    /// Proves the goal at a leaf.
    pub(super) fn leaf(&mut self, target: &Target, leaf: &Leaf, cases: &[(Polynomial, Sign)]) -> Result<()> {
        let (state, steps) = trace(target.problem, leaf, cases)?;
        for (rise, i) in leaf.rises.iter().zip(1..) {
            self.rise(target, &state, rise, i)?;
        }
        if !leaf.rises.is_empty() {
            self.line("functions.");
        }
        let is_double = matches!(target.problem.proposition, Proposition::Within(..));
        let (steps, goals) = steps.split_at(steps.len().saturating_sub(1 + usize::from(is_double)));
        let mut writer = Writer::new(target, &state, leaf, |_| true)?;
        for step in steps {
            writer.step(step)?;
        }
        let Some(Step::Sign { facts, .. }) = goals.first() else { return Err("no goal".into()) };
        writer.catch_up(*facts)?;
        writer.finish()?;
        if target.tactic != "shown" {
            self.line(&format!("{}.", writer.call(target.tactic)));
            return Ok(());
        }
        let first = writer.reason(&goals[0])?;
        let second = goals.get(1).map(|goal| match goal {
            Step::Sign { reason: Reason::Fact(i), .. } if i == facts => Ok(first.clone()),
            _ => writer.reason(goal),
        });
        let reasons: Vec<_> = iter::once(Ok(first.clone())).chain(second).collect::<Result<_>>()?;
        self.line(&format!("{}.", writer.shown(&reasons)));
        Ok(())
    }

    /// Proves that a function has a sign if its argument has one: X1, X2, …
    fn rise(&mut self, target: &Target, state: &State, rise: &Rise, i: usize) -> Result<()> {
        let Some(Atom::Own(x)) = target.problem.table.atoms().get(rise.x) else {
            return Err("a function of no symbol".into());
        };
        let parts = parts_of_rise(target.problem, rise, x)?;
        let at_x = state.signs.get(rise.x).copied().flatten().ok_or("an argument without a sign")?;
        let name = target.name(rise.x);
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for (y, atom) in target.problem.table.atoms().iter().enumerate() {
            let tree = match atom {
                Atom::Own(symbol) => Tree::symbol(symbol),
                Atom::Exponential(of) if rise.of.degree(y) > 0 => target.problem.table.formula(*of)?.exp(),
                // It does not occur in the function.
                _ => Tree::from(0),
            };
            let slope = simplified(&derivative(&tree, x)?);
            values.push(target.lemma.printer.expr(&tree).to_string());
            slopes.push(target.lemma.printer.expr(&slope).to_string());
        }
        let [values, slopes] = [list(values), list(slopes)].map(|all| format!("(fun {name} : R => {all})"));
        let signs: [Sign; 3] = [rise.start.into(), rise.slope.into(), at_x];
        let signs = spaced(signs.map(|sign| format!("A_Polynomials.{sign:?}")));
        self.line(&format!("rises {values} {slopes} {}%string {name}{signs} X{i}.", text(&rise.of)));
        for (proposition, assumed) in &parts {
            let all = target.problem.hypotheses.iter().copied().zip(&target.labels);
            let others = all.filter(|(other, _)| !other.value.symbols().contains(x));
            let (mut hypotheses, mut labels): (Vec<_>, Vec<_>) =
                others.map(|(other, label)| (other, label.clone())).unzip();
            let kept = labels.iter().flatten().filter(|label| *label != "M").cloned();
            let premises =
                if target.lemma.contains_rounding { vec!["P".into(), "E".into()] } else { Vec::new() };
            let kept = spaced(kept.chain(premises));
            let minus = if kept.is_empty() { "" } else { " -" };
            hypotheses.extend(assumed);
            labels.extend(assumed.iter().map(|_| Some("K".to_string())));
            let proposition = proposition.map(&simplified);
            let part = Problem::new(&proposition, hypotheses)?;
            self.block("{", |script| {
                script.line(&format!("clear{minus}{kept}."));
                if assumed.is_some() {
                    script.line(&format!("intros {name} K."));
                }
                let is_slope = matches!(part.proposition, Proposition::Derivative(..));
                let tactic = if is_slope { "slopes" } else { "shown" };
                script.problem(&Target { tactic, ..Target::new(target.lemma, &part, labels) })
            })?;
        }
        Ok(())
    }
}
