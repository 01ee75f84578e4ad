//! The proof of a limit as Coq's tactics.

use super::super::expr::{Expr, by_exponent};
use super::super::print::ascii;
use super::{Reason, Script};
use crate::proof::kernel::algebra::{Poly, Ratio, Symbol};
use crate::proof::kernel::{Because, Derivation, Used};
use crate::proof::search;

impl Script {
    /// A limit; the hypotheses H1, H2, … are those that do not speak of `by`, and `inside` makes use of those
    /// that do, for a positive value X.
    pub(in crate::proof::coq) fn limit(
        &mut self,
        derivation: &Derivation,
        by: &'static str,
        inside: impl FnOnce(&mut Self) -> Result<(), Reason>,
    ) -> Result<(), Reason> {
        let Derivation::Direct(direct) = derivation else { return Err("a limit in cases") };
        let Because::Limit { of, .. } = &direct.because else { return Err("no limit") };
        if !direct.brackets.is_empty() {
            return Err("a limit with brackets");
        }
        let x = Symbol::Own(by);
        let others = direct.supposed.iter().filter(|s| !matches!(&s.used, Used::Symbol(y) if *y == x));
        others.enumerate().try_for_each(|(i, supposed)| self.suppose(supposed, &format!("H{}", i + 1)))?;
        self.at_infinity(of, x, inside)
    }

    /// A limit for x → ∞: the formula as one in 1/x, and one e^… that falls.
    fn at_infinity(
        &mut self,
        of: &Ratio,
        x: Symbol,
        inside: impl FnOnce(&mut Self) -> Result<(), Reason>,
    ) -> Result<(), Reason> {
        let moving = by_exponent(of.num()).into_iter().filter_map(|(e, part)| Some((e?, part)));
        let moving: Vec<_> = moving.filter(|(e, _)| e.symbols().contains(&x)).collect();
        let rest = moving.iter().fold(of.num().clone(), |rest, (exponent, part)| {
            rest - part * Poly::exponential((*exponent).clone())
        });
        let falling = match moving.as_slice() {
            [] => None,
            [(exponent, part)] => {
                let rate = exponent.over(&Poly::symbol(x).into()).ok_or("an exponent is not linear")?;
                let factor =
                    Ratio::from(part.clone()).over(&of.den().clone().into()).ok_or("a divisor is 0")?;
                if rate.symbols().contains(&x) || factor.symbols().contains(&x) {
                    return Err("an exponential is not that of a constant rate, or has a factor that grows");
                }
                Some((factor, rate))
            }
            _ => return Err("there is more than one exponential"),
        };
        let degree = of.den().degree(x);
        // A polynomial of x over x^degree, in y = 1/x.
        let reversed = |poly: &Poly| {
            let terms = (0..=poly.degree(x)).map(|i| {
                (i..degree).fold(poly.coefficient(x, i), |term, _| term * Poly::symbol(Symbol::Own("y")))
            });
            terms.fold(Poly::zero(), |sum, term| sum + term)
        };
        let g = Expr::poly(&reversed(&rest)).over(Expr::poly(&reversed(of.den())));
        let name = ascii(x.name());
        let (rule, more) = match &falling {
            None => ("limit_at_infinity", String::new()),
            Some((factor, rate)) => (
                "limit_with_decay",
                format!(" {} {}", Expr::ratio(factor).argument(), Expr::ratio(rate).argument()),
            ),
        };
        self.line(&format!("apply ({rule} _ (fun y => {g}){more}); cbv beta."));
        self.block("-", |own| {
            own.line(&format!("intros {name} X."));
            inside(own)?;
            own.line("identity.");
            Ok(())
        })?;
        if let Some((_, rate)) = &falling {
            let certificate =
                |p: &Poly| search::sign(p, &self.known.clone().into()).ok_or("the sign of a rate is open");
            let (num, den) = (certificate(rate.num())?, certificate(rate.den())?);
            let size = self.positive(&num)?.over(self.positive(&den)?);
            self.line(&format!("- sign_by {}.", size.argument()));
        }
        self.line("- auto_derive; nonzero.");
        self.line("- identity.");
        Ok(())
    }
}
