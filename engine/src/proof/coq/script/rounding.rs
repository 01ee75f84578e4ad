//! Proofs of claims about rounded formulas.

use super::super::expr::Expr;
use super::super::lemma::{Lemma, Result};
use super::super::print::ascii;
use super::Script;
use crate::formula::claim::PRECISION;
use crate::formula::{Proposition, Relation};
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::kernel::Rounding;
use crate::proof::kernel::algebra::Poly;

/// Writes a rounded formula as an argument.
fn rounded(rounding: &Rounding, lemma: &Lemma) -> String {
    lemma.printer.expr(&rounding.of).argument()
}

/// Writes the proof of a part.
type Part<'p> = &'p dyn Fn(&mut Script) -> Result<()>;

impl Script {
    /// Introduces M, that 2ᵖ is at least 4, and replaces each rounding by an unknown factor near 1.
    pub(super) fn models(&mut self, errors: &[Rounding], lemma: &Lemma) {
        let precision = ascii(PRECISION);
        self.line(&format!("pose proof (four_at_least prec {precision} P E) as N."));
        self.line(&format!("assert (M : 0 <= {precision} - 4) by lra."));
        for (rounding, i) in errors.iter().zip(1..) {
            let (error, of) = (ascii(rounding.error.name()), rounded(rounding, lemma));
            let model = format!("model prec choice {precision} P E {of}");
            self.line(&format!("destruct ({model}) as ({error} & B{i} & F{i})."));
        }
        self.line("rounded E.");
    }

    /// Proves that one rounded formula is at least another.
    pub(super) fn order(&mut self, of: &Tree, lemma: &Lemma) -> Result<()> {
        let Op::Sub(a, b) = of.op() else { return Err("an order of no difference".into()) };
        self.line("apply difference.");
        self.at_least(a, b, lemma)
    }

    /// Uses that rounding and each operation preserve order; it remains to compare the differing parts, and
    /// to prove the sign of a common factor or divisor.
    fn at_least(&mut self, a: &Tree, b: &Tree, lemma: &Lemma) -> Result<()> {
        use Op::*;
        let sign = |relation, of: &Tree| Proposition::Sign(relation, of.clone());
        let mut rule = |rule: &str, parts: [Part; 2]| {
            self.line(rule);
            parts.into_iter().try_for_each(|part| self.block("-", part))
        };
        match (a.op(), b.op()) {
            _ if a == b => self.line("apply Rle_refl."),
            (Rounded(a), Rounded(b)) => {
                self.line("apply fl_le; [exact P | ].");
                self.at_least(a, b, lemma)?;
            }
            (Neg(a), Neg(b)) => {
                self.line("apply Ropp_le_contravar.");
                self.at_least(b, a, lemma)?;
            }
            (Add(a, c), Add(b, d)) => rule(
                "apply Rplus_le_compat.",
                [&|own| own.at_least(a, b, lemma), &|own| own.at_least(c, d, lemma)],
            )?,
            (Sub(a, c), Sub(b, d)) => rule(
                "apply Rplus_le_compat; [ | apply Ropp_le_contravar].",
                [&|own| own.at_least(a, b, lemma), &|own| own.at_least(d, c, lemma)],
            )?,
            (Mul(factor, a), Mul(same, b)) if factor == same => rule(
                "apply Rmult_le_compat_l.",
                [&|own| own.goal(lemma, &sign(Relation::NonNegative, factor)), &|own| {
                    own.at_least(a, b, lemma)
                }],
            )?,
            (Mul(a, factor), Mul(b, same)) if factor == same => rule(
                "apply Rmult_le_compat_r.",
                [&|own| own.goal(lemma, &sign(Relation::NonNegative, factor)), &|own| {
                    own.at_least(a, b, lemma)
                }],
            )?,
            (Div(a, divisor), Div(b, same)) if divisor == same => rule(
                "apply quotient_le.",
                [&|own| own.goal(lemma, &sign(Relation::Positive, divisor)), &|own| {
                    own.at_least(a, b, lemma)
                }],
            )?,
            _ => {
                self.line("apply Rminus_le_0.");
                self.goal(lemma, &sign(Relation::NonNegative, &(a - b)))?;
            }
        }
        Ok(())
    }

    /// Rewrites each rounding in scaled units as one in the original units.
    pub(super) fn in_units(&mut self, errors: &[Rounding], lemma: &Lemma) -> Result<()> {
        for (i, later) in errors.iter().enumerate() {
            let Some(earlier) = errors[..i].iter().find(|known| known.error == later.error) else {
                continue;
            };
            let is_usual = later.scale == Poly::constant(1).into();
            let (usual, other) = if is_usual { (later, earlier) } else { (earlier, later) };
            let factor = other.scale.over(&usual.scale).ok_or("a scale is 0")?;
            let factor = Expr::ratio(&factor).argument();
            let [usual, other] =
                [usual, other].map(|rounding| format!("fl prec choice {}", rounded(rounding, lemma)));
            self.line(&format!("assert (U{i} : {other} = {factor} * {usual}) by (in_units {factor})."));
        }
        self.line("by_units.");
        Ok(())
    }
}
