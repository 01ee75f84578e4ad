//! Proofs of limits: what becomes of a formula for great x is what becomes of it for small 1/x.

use super::super::expr::Expr;
use super::super::lemma::{Lemma, Result};
use super::leaf::Writer;
use super::{Script, Target};
use crate::formula::{Hypothesis, Proposition};
use crate::number::tree::Op;
use crate::proof::check::{Atom, Leaf, Node, Polynomial, Quotient, State};
use crate::proof::trace::{Step, reread, trace};

/// A limit to be proved.
struct Limit<'l> {
    target: Target<'l>,
    state: &'l State<'l>,
    leaf: &'l Leaf,
    steps: &'l [Step],
    /// The variable, and its number.
    by: &'static str,
    x: usize,
    /// The formula.
    of: Quotient,
}

impl Script {
    /// Proves a limit from these hypotheses; the premises of the lemma are those that do not contain the
    /// variable of the limit.
    pub(in crate::proof::coq) fn limit(
        &mut self,
        lemma: &Lemma,
        hypotheses: &[&Hypothesis],
        proposition: &Proposition,
    ) -> Result<()> {
        Target::with(lemma, hypotheses, proposition, |target| {
            let Proposition::Limit(of, by, _) = target.problem.proposition else {
                return Err("no limit".into());
            };
            let Node::Leaf(leaf) = target.proof()? else { return Err("a limit in cases".into()) };
            let (state, steps) = trace(target.problem, &leaf, &[])?;
            let of = reread(state.clone()).translate(of)?;
            let x = target.variable(Atom::Own(by))?;
            Limit { target, state: &state, leaf: &leaf, steps: &steps, by, x, of }.write(self)
        })
    }
}

impl Limit<'_> {
    /// Returns `true` if an atom varies with the variable of the limit.
    fn is_variable(&self, y: usize) -> bool {
        self.target.problem.depends(y, self.by)
    }

    fn depends(&self, of: &Polynomial) -> bool {
        !of.has_only(|y| !self.is_variable(y))
    }

    /// Returns a polynomial, with the formulas of exponentials in place of their variables.
    fn expr(&self, of: &Polynomial) -> Result<Expr> {
        let table = &self.target.problem.table;
        if !of.has_only(|x| matches!(table.atoms().get(x), Some(Atom::Own(_) | Atom::Exponential(_)))) {
            return Err("a limit with other quantities than symbols and exponentials".into());
        }
        Ok(Expr::polynomial(of, |x| match table.atoms()[x] {
            Atom::Exponential(of) => match table.formula(of) {
                Ok(of) => Expr::call("exp", vec![self.target.lemma.printer.expr(of)]),
                Err(_) => Expr::name(self.target.name(x)),
            },
            _ => Expr::name(self.target.name(x)),
        }))
    }

    /// Returns a polynomial over x to the power of a degree, in y = 1/x.
    fn reversed(&self, of: &Polynomial, degree: u8, y: &Expr) -> Result<Expr> {
        let mut sum = Expr::int(0);
        for i in 0..=of.degree(self.x) {
            let power = (i..degree).fold(Expr::int(1), |power, _| power.times(y.clone()));
            let coefficient = of.coefficient(self.x, i);
            if !coefficient.is_zero() {
                sum = sum.plus(power.times(self.expr(&coefficient)?)).simplified();
            }
        }
        Ok(sum)
    }

    fn product(&self, facts: &[usize]) -> Result<Polynomial> {
        Ok(self.state.facts.product(facts)?)
    }

    fn write(&self, script: &mut Script) -> Result<()> {
        let (table, mut rest, mut moving) = (&self.target.problem.table, self.of.num.clone(), Vec::new());
        for (y, atom) in table.atoms().iter().enumerate() {
            let is_moving = matches!(atom, Atom::Exponential(_)) && self.is_variable(y);
            if is_moving && rest.degree(y) > 0 {
                moving.push((y, rest.coefficient(y, 1)));
                rest = rest.coefficient(y, 0);
            }
        }
        let den = self.product(&self.of.den)?;
        let name = Expr::name(format!("s{}", table.atoms().len()));
        let degree = den.degree(self.x);
        let [above, below] = [&rest, &den].map(|part| self.reversed(part, degree, &name));
        let g = format!("(fun {name} : R => {})", above?.divided_by(below?));
        match &moving[..] {
            [] => {
                script.line(&format!("apply (limit_at_infinity _ {g}); cbv beta."));
                script.block("-", |script| self.equation(script, None))?;
            }
            [(y, part)] => {
                let unlike = "an exponential is not that of a constant rate, or has a factor that grows";
                let exponent = self.state.exponent(*y).ok_or("an exponential without exponent")?;
                let (above, below) = (&exponent.num, self.product(&exponent.den)?);
                let rate = above.coefficient(self.x, 1);
                let is_linear = above.degree(self.x) == 1 && above.coefficient(self.x, 0).is_zero();
                let constant = [part, &den, &rate, &below];
                if !is_linear || constant.into_iter().any(|of| self.depends(of)) || self.of.num.degree(*y) > 1
                {
                    return Err(unlike.into());
                }
                let factor = self.expr(part)?.divided_by(self.expr(&den)?).argument();
                let rate = self.expr(&rate)?.divided_by(self.expr(&below)?).argument();
                script.line(&format!("apply (limit_with_decay _ {g} {factor} {rate}); cbv beta."));
                script.block("-", |script| self.equation(script, Some((*y, rate))))?;
                script.block("-", |script| {
                    self.at_zero(script, |writer| Ok(writer.shown(&["Known".into()])))
                })?;
            }
            _ => return Err("there is more than one exponential".into()),
        }
        script.block("-", |script| {
            self.at_zero(script, |writer| Ok(format!("auto_derive; {}", writer.call("derived"))))
        })?;
        let last = self.steps.last().ok_or("a limit without a value")?;
        script.block("-", |script| {
            self.at_zero(script, |writer| {
                let reason = writer.reason(last)?;
                Ok(writer.shown(&[reason]))
            })
        })
    }

    /// Proves that the formula is that in 1/x, for positive x, plus a decaying exponential of this rate.
    fn equation(&self, script: &mut Script, decaying: Option<(usize, String)>) -> Result<()> {
        let name = self.target.name(self.x);
        let all = self.target.problem.hypotheses.iter().zip(&self.target.labels);
        let labels = all.map(|(hypothesis, label)| {
            let is_sign = *hypothesis.value.op() == Op::Symbol(self.by);
            label.clone().or(is_sign.then(|| "X".into()))
        });
        let target = Target::new(self.target.lemma, self.target.problem, labels.collect());
        script.line(&format!("intros {name} X."));
        script.names(&target, |_| true)?;
        let mut writer = Writer::new(&target, self.state, self.leaf, |_| true)?;
        writer.add_fact("X".into());
        for step in self.steps {
            writer.step(step)?;
        }
        let factors = self.of.den.iter().filter_map(|i| self.state.facts.get(*i).ok());
        writer.divide(factors.map(|(of, _)| of.clone()).collect());
        writer.finish()?;
        if let Some((y, rate)) = decaying {
            writer.equate(format!("same_exponential ({rate} * {name}) _ _ _ eq_refl F{y}"));
        }
        script.line(&format!("{}.", writer.shown(&["Known".into()])));
        Ok(())
    }

    /// Proves what does not depend on the variable, of which nothing is known here: a certificate that needs its
    /// sign shows none.
    fn at_zero(&self, script: &mut Script, end: impl Fn(&mut Writer) -> Result<String>) -> Result<()> {
        script.names(&self.target, |y| !self.is_variable(y))?;
        let mut writer = Writer::new(&self.target, self.state, self.leaf, |y| !self.is_variable(y))?;
        for step in self.steps {
            if let Step::Sign { .. } = step {
                writer.step(step)?;
            }
        }
        let end = end(&mut writer)?;
        script.line(&format!("{end}."));
        Ok(())
    }
}
