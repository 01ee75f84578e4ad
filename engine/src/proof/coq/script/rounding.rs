//! The proof of what is said of rounded formulas.

use super::super::expr::Expr;
use super::super::lemma::{Lemma, Result};
use super::super::print::ascii;
use super::{Place, Script};
use crate::formula::claim::PRECISION;
use crate::formula::statement::minimum_precision;
use crate::proof::kernel::algebra::Poly;
use crate::proof::kernel::{Direct, Rounding, Supposed, Used};

/// What is rounded, as an argument.
fn rounded(rounding: &Rounding, lemma: &Lemma) -> String {
    lemma.printer.expr(&rounding.of).argument()
}

impl Script {
    /// M, that 2ᵖ is at least 4.
    fn bits(&mut self) {
        let precision = ascii(PRECISION);
        self.line(&format!("pose proof (four_at_least prec {precision} P E) as N."));
        self.line(&format!("assert (M : 0 <= {precision} - 4) by lra."));
    }

    /// What is rounded is what it was, by an unknown factor near 1.
    pub(super) fn models(&mut self, errors: &[Rounding], lemma: &Lemma) {
        let precision = ascii(PRECISION);
        self.bits();
        for (rounding, i) in errors.iter().zip(1..) {
            let (error, of) = (ascii(rounding.error.name()), rounded(rounding, lemma));
            let model = format!("model prec choice {precision} P E {of}");
            self.line(&format!("destruct ({model}) as ({error} & B{i} & F{i})."));
        }
        self.line("rounded E.");
    }

    /// One rounded formula is no less than another.
    pub(super) fn order(&mut self, direct: &Direct, lemma: &Lemma) -> Result<()> {
        let rounds = |supposed: &Supposed| supposed.given.as_ref().is_some_and(|given| given.value.rounds());
        // Signs of symbols are put to use as they are.
        let is_solved = |supposed: &Supposed| {
            let says_bits = supposed.given.as_ref().is_some_and(|given| *given == minimum_precision());
            matches!(&supposed.used, Used::Pivot(..)) && !says_bits && !rounds(supposed)
        };
        let supposed = &direct.supposed;
        if supposed.iter().any(is_solved) && supposed.iter().any(rounds) {
            return Err(
                "an order that rests on one hypothesis to be solved and another about what is rounded".into(),
            );
        }
        if !supposed.iter().any(rounds) {
            self.bits();
            self.line("clear E.");
            self.hypotheses(&mut Place { lemma, supposed: 0, cases: 0 }, direct)?;
            self.line("pivots.");
        }
        self.line("by_order.");
        Ok(())
    }

    /// Each rounding in other units from that in the usual ones.
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
