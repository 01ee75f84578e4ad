//! Proofs of limits: what becomes of a formula for great x is what becomes of it for small 1/x.

use super::super::expr::Expr;
use super::super::lemma::{Lemma, Result};
use super::leaf::{Writer, text};
use super::{Script, Target};
use crate::formula::{Hypothesis, Proposition};
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::check::{Atom, Node, Polynomial, Quotient, State, Step};

/// A limit to be proved.
struct Limit<'l> {
    target: Target<'l>,
    state: State<'l>,
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
            let Proposition::Limit(_, by, _) = target.problem.proposition else {
                return Err("no limit".into());
            };
            let Node::Leaf(steps) = target.proof()? else { return Err("a limit in cases".into()) };
            let mut state = State::new(target.problem, &[])?;
            steps.iter().try_for_each(|step| state.apply(step))?;
            let of = state.value(target.problem.goal[0])?;
            let x = target.variable(Atom::Own(by))?;
            let target = Target { positive: Some(x), ..target };
            Limit { target, state, steps: &steps, by, x, of }.write(self)
        })
    }
}

impl Limit<'_> {
    fn depends(&self, of: &Polynomial) -> bool {
        !of.has_only(|y| !self.target.problem.varies(y))
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
            let is_moving = matches!(atom, Atom::Exponential(_)) && self.target.problem.varies(y);
            if is_moving && rest.degree(y) > 0 {
                moving.push((y, rest.coefficient(y, 1)));
                rest = rest.coefficient(y, 0);
            }
        }
        let den = self.product(&self.of.den)?;
        let name = Expr::name(format!("s{}", table.atoms().len()));
        let degree = den.degree(self.x);
        let [above, below] = [&rest, &den].map(|part| self.reversed(part, degree, &name));
        let from = self.lower_bounds().fold("0".to_string(), |rest, (_, bound)| {
            format!("(Rmax {} {rest})", self.target.lemma.printer.expr(bound).argument())
        });
        let g = format!("(fun {name} : R => {})", above?.divided_by(below?));
        match &moving[..] {
            [] => {
                script.line(&format!("apply (limit_at_infinity {from} _ {g}); cbv beta."));
                script.block("-", |script| self.equation(script, None))?;
            }
            [(y, part)] => {
                let unlike = "an exponential is not that of a constant rate, or has a factor that grows";
                let exponent = self.state.clone().exponent(*y)?;
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
                script.line(&format!("apply (limit_with_decay {from} _ {g} {factor} {rate}); cbv beta."));
                script.block("-", |script| self.equation(script, Some((*y, rate))))?;
                script.block("-", |script| self.at_zero(script, "shown"))?;
            }
            _ => return Err("there is more than one exponential".into()),
        }
        script.block("-", |script| self.at_zero(script, "auto_derive; derived"))?;
        script.block("-", |script| self.at_zero(script, "shown"))
    }

    /// Returns the lower bounds of the variable, each with the number of its hypothesis.
    fn lower_bounds(&self) -> impl Iterator<Item = (usize, &Tree)> {
        self.target.problem.hypotheses.iter().enumerate().filter_map(|(i, hypothesis)| {
            match hypothesis.value.op() {
                Op::Sub(x, bound) if *x.op() == Op::Symbol(self.by) && !bound.symbols().contains(self.by) => {
                    Some((i, bound))
                }
                _ => None,
            }
        })
    }

    /// Proves that the formula is that in 1/x, for large x, plus a decaying exponential of this rate.
    fn equation(&self, script: &mut Script, decaying: Option<(usize, String)>) -> Result<()> {
        let name = self.target.name(self.x);
        script.line(&format!("intros {name} X."));
        let mut labels = self.target.labels.clone();
        for (i, _) in self.lower_bounds().collect::<Vec<_>>().into_iter().rev() {
            script.line(&format!("apply Rmax_Rlt in X as [K{i} X]. apply Rlt_Rminus in K{i}. functions."));
            labels[i] = Some(format!("K{i}"));
        }
        for (hypothesis, label) in self.target.problem.hypotheses.iter().zip(&mut labels) {
            if *hypothesis.value.op() == Op::Symbol(self.by) {
                *label = Some("X".into());
            }
        }
        let target = Target { labels, ..self.target.clone() };
        script.names(&target, |_| true)?;
        let mut writer = Writer::new(&target, &[], |_| true)?;
        writer.steps(self.steps)?;
        writer.divide(&self.of.den);
        let variable = text(&Polynomial::variable(self.x)?);
        writer.add(format!("Shown {variable} (identity []%nat \"+\" {variable})"));
        if let Some((y, rate)) = decaying {
            writer.add(format!("same_exponential ({rate} * {name}) _ _ F{y}"));
        }
        script.line(&format!("{}.", writer.call("shown")));
        Ok(())
    }

    /// Proves what does not depend on the variable, of which nothing is known here: a certificate that needs its
    /// sign shows none.
    fn at_zero(&self, script: &mut Script, tactic: &'static str) -> Result<()> {
        script.names(&self.target, |y| !self.target.problem.varies(y))?;
        let target = Target { tactic, ..self.target.clone() };
        let mut writer = Writer::new(&target, &[], |y| !self.target.problem.varies(y))?;
        writer.steps(self.steps)?;
        script.line(&format!("{}.", writer.call(tactic)));
        Ok(())
    }
}
