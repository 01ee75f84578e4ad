//! Formulas read as quotients.

use super::algebra::{self, Poly, Ratio};
use super::context::{Context, sign};
use super::derivation::{Rounding, Signed, Why};
use super::effort;
use super::sign::{Certificate, Sign};
use crate::formula::claim::{PRECISION, SCALES};
use crate::number::Tree;
use crate::number::tree::Step;

/// Reads formulas as quotients, and notes what that takes.
pub(super) struct Reader<'a> {
    context: &'a Context,
    pub(super) divisors: Vec<(Tree, Signed)>,
    pub(super) brackets: Vec<(Tree, Tree, Signed)>,
    /// What has been rounded, without factors that are powers of two, and with which error.
    rounded: Vec<(Ratio, algebra::Symbol)>,
    pub(super) errors: Vec<Rounding>,
    /// The factors of divisors.
    factors: Vec<Certificate>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(context: &'a Context) -> Self {
        let (divisors, brackets, rounded, factors) = Default::default();
        Reader { context, divisors, brackets, rounded, errors: context.errors.clone(), factors }
    }

    /// The sign of a quotient.
    pub(super) fn sign(&self, value: Ratio) -> Result<Signed, Why> {
        let (value, known) = (self.context.reduce(&value), self.context.known.clone());
        self.context.sign_by_kept(value.clone(), &self.factors).ok_or(Why::NoSign(value, known))
    }

    /// The same, if it is such a sign.
    pub(super) fn of_sign(&self, value: Ratio, sign: Sign) -> Result<Signed, Why> {
        let signed = self.sign(value)?;
        let holds = signed.sign().implies(sign);
        if holds { Ok(signed) } else { Err(Why::WrongSign(signed.value.clone(), signed.sign())) }
    }

    /// Nothing in it is divided by 0.
    pub(super) fn defined(&mut self, tree: &Tree) -> Result<(), Why> {
        match tree.step() {
            Step::Div(a, b) => {
                self.defined(a)?;
                self.divisor(b)?;
            }
            step => step.operands().try_for_each(|operand| self.defined(operand))?,
        }
        Ok(())
    }

    /// What is divided by, which is not 0.
    fn divisor(&mut self, tree: &Tree) -> Result<Ratio, Why> {
        let divisor = self.read(tree)?;
        if divisor.is_zero() {
            return Err(Why::MightVanish(tree.clone(), divisor));
        }
        effort::spend(self.divisors.len().saturating_mul(tree.size() as usize));
        if !divisor.is_number() && self.divisors.iter().all(|(known, _)| known != tree) {
            self.collect_factors(tree)?;
            let value = self.context.reduce(&divisor);
            let signed = self.context.sign(value.clone(), &self.factors);
            let signed = signed.filter(|s| s.num.sign().is_strict());
            self.divisors.push((tree.clone(), signed.ok_or_else(|| Why::MightVanish(tree.clone(), value))?));
        }
        Ok(divisor)
    }

    /// Notes the signs of the factors that a divisor is a product of, also after rounding.
    fn collect_factors(&mut self, tree: &Tree) -> Result<(), Why> {
        match tree.step() {
            Step::Mul(a, b) => [a, b].into_iter().try_for_each(|factor| self.collect_factors(factor)),
            Step::Neg(a) | Step::Div(a, _) => self.collect_factors(a),
            Step::Rounded(a) => {
                let value = self.context.reduce(&self.read(a)?);
                let (error, largest) = self.rounding(a, &value)?;
                self.note_sign(&(largest + Ratio::from(Poly::symbol(error))));
                self.collect_factors(a)
            }
            _ => {
                let value = self.context.reduce(&self.read(tree)?);
                self.note_sign(&value);
                Ok(())
            }
        }
    }

    fn note_sign(&mut self, factor: &Ratio) {
        if self.factors.iter().all(|known| known.of() != factor.num()) {
            self.factors.extend(sign(factor.num(), &self.context.known));
        }
    }

    pub(super) fn read(&mut self, tree: &Tree) -> Result<Ratio, Why> {
        use Step::*;
        Ok(match tree.step() {
            // What rounding makes of a formula is long: soon in the symbols that are left, it is shorter.
            Symbol(name) if self.context.rounds() => {
                self.context.reduce(&Poly::symbol(algebra::Symbol::Own(name)).into())
            }
            Symbol(name) => Poly::symbol(algebra::Symbol::Own(name)).into(),
            Int(n) => Poly::constant(*n).into(),
            Neg(a) => -self.read(a)?,
            Add(a, b) => self.read(a)? + self.read(b)?,
            Sub(a, b) => self.read(a)? - self.read(b)?,
            Mul(a, b) => self.read(a)? * self.read(b)?,
            Div(a, b) => {
                let (value, divisor) = (self.read(a)?, self.divisor(b)?);
                value.over(&divisor).ok_or_else(|| Why::MightVanish(b.clone(), divisor))?
            }
            Exp(a) => {
                let exponent = self.context.reduce(&self.read(a)?);
                Poly::exponential(exponent).into()
            }
            PositivePart(a) => self.either(tree, a, &tree.with_step(Int(0)), |a, _| a)?,
            Min(a, b) => self.either(tree, a, b, |a, b| b - a)?,
            Rounded(a) => {
                let value = self.context.reduce(&self.read(a)?);
                let (error, largest) = self.rounding(a, &value)?;
                let nearest = &largest + Ratio::from(Poly::symbol(error));
                let divisor = || Tree::symbol(PRECISION) + Tree::from(1);
                (value * nearest).over(&largest).ok_or_else(|| Why::MightVanish(divisor(), largest))?
            }
        })
    }

    /// The error of what is rounded, and N.
    fn rounding(&mut self, of: &Tree, value: &Ratio) -> Result<(algebra::Symbol, Ratio), Why> {
        let largest = self.context.largest();
        // What differs by a power of two rounds alike.
        let (value, scale) = without_scales(value);
        // What is equal has the same errors in it, if none cancels; then it is not seen to be equal.
        let errors = |value: &Ratio| -> Vec<_> {
            value.symbols().into_iter().filter(|x| matches!(x, algebra::Symbol::Error(_))).collect()
        };
        let own = errors(&value);
        let mut alike = self.rounded.iter().filter(|(known, _)| errors(known) == own);
        let same = alike.find(|(known, _)| (known - &value).is_zero());
        let error = match same {
            Some((_, error)) => *error,
            None => {
                let place = self.context.roundings.iter().position(|known| known == of);
                let place = place.and_then(|place| place.try_into().ok());
                let error = algebra::Symbol::Error(place.ok_or(Why::TooMany)?);
                self.rounded.push((value, error));
                error
            }
        };
        if self.errors.iter().all(|known| known.of != *of) {
            self.errors.push(Rounding { of: of.clone(), error, scale });
        }
        Ok((error, largest))
    }

    /// A bracket: the first where what decides is ≥ 0, the second where it is ≤ 0. It has to be one of them
    /// for all values.
    fn either(
        &mut self,
        bracket: &Tree,
        first: &Tree,
        second: &Tree,
        decides: fn(Ratio, Ratio) -> Ratio,
    ) -> Result<Ratio, Why> {
        let (a, b) = (self.read(first)?, self.read(second)?);
        let value = self.context.reduce(&decides(a.clone(), b.clone()));
        let signed =
            self.context.sign_by_kept(value.clone(), &self.factors).ok_or(Why::OpenBracket(value))?;
        let is_first = signed.sign().implies(Sign::NonNegative);
        effort::spend(self.brackets.len().saturating_mul(bracket.size() as usize));
        if self.brackets.iter().all(|(known, ..)| known != bracket) {
            self.brackets.push((bracket.clone(), if is_first { first } else { second }.clone(), signed));
        }
        Ok(if is_first { a } else { b })
    }
}

fn is_scale(x: algebra::Symbol) -> bool {
    SCALES.iter().any(|scale| x == algebra::Symbol::Own(scale))
}

/// A quotient without factors that are powers of two, and these.
fn without_scales(value: &Ratio) -> (Ratio, Ratio) {
    let scales = |poly: &Poly| -> Poly { poly.common_monomial().without_those(|x| !is_scale(x)).into() };
    let scale = Ratio::from(scales(value.num())).over(&scales(value.den()).into());
    let scale = scale.unwrap_or_else(|| Poly::constant(1).into());
    (value.over(&scale).unwrap_or_else(|| value.clone()), scale)
}
