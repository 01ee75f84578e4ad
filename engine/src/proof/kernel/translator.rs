//! The translation of formulas into quotients of polynomials.

use super::algebra::{self, Poly, Ratio};
use super::context::{Context, sign};
use super::derivation::{ProofError, Rounding, SignedRatio};
use super::effort;
use super::sign::{Certificate, Sign};
use crate::formula::claim::{PRECISION, SCALES};
use crate::number::Tree;
use crate::number::tree::Op;

/// Translates formulas into quotients, and records the signs and roundings that this requires.
pub(super) struct Translator<'a> {
    context: &'a Context,
    pub(super) divisors: Vec<(Tree, SignedRatio)>,
    pub(super) branches: Vec<(Tree, Tree, SignedRatio)>,
    /// The rounded quotients, without factors that are powers of two, and their errors.
    rounded: Vec<(Ratio, algebra::Symbol)>,
    pub(super) errors: Vec<Rounding>,
    /// The signs of factors of divisors.
    factors: Vec<Certificate>,
}

impl<'a> Translator<'a> {
    pub(super) fn new(context: &'a Context) -> Self {
        let (divisors, brackets, rounded, factors) = Default::default();
        Translator { context, divisors, branches: brackets, rounded, errors: context.errors.clone(), factors }
    }

    /// Returns the sign of a quotient.
    pub(super) fn sign(&self, value: Ratio) -> Result<SignedRatio, ProofError> {
        let (value, known) = (self.context.reduce(&value), self.context.signs.clone());
        self.context
            .sign_by_retained(value.clone(), &self.factors)
            .ok_or(ProofError::UnknownSign(value, known))
    }

    /// Returns the sign of a quotient if it implies `sign`.
    pub(super) fn require_sign(&self, value: Ratio, sign: Sign) -> Result<SignedRatio, ProofError> {
        let signed = self.sign(value)?;
        let holds = signed.sign().implies(sign);
        if holds { Ok(signed) } else { Err(ProofError::WrongSign(signed.value.clone(), signed.sign())) }
    }

    /// Checks that no divisor in a formula is 0.
    pub(super) fn check_defined(&mut self, tree: &Tree) -> Result<(), ProofError> {
        match tree.op() {
            Op::Div(a, b) => {
                self.check_defined(a)?;
                self.read_divisor(b)?;
            }
            step => step.operands().try_for_each(|operand| self.check_defined(operand))?,
        }
        Ok(())
    }

    /// Translates a divisor and checks that it is not 0.
    fn read_divisor(&mut self, tree: &Tree) -> Result<Ratio, ProofError> {
        let divisor = self.translate(tree)?;
        if divisor.is_zero() {
            return Err(ProofError::PossibleZeroDivisor(tree.clone(), divisor));
        }
        require_effort(self.divisors.len().saturating_mul(tree.size() as usize))?;
        if !divisor.is_number() && self.divisors.iter().all(|(known, _)| known != tree) {
            self.collect_factors(tree)?;
            let value = self.context.reduce(&divisor);
            let signed = self.context.sign(value.clone(), &self.factors);
            let signed = signed.filter(|s| s.num.sign().is_strict());
            self.divisors.push((
                tree.clone(),
                signed.ok_or_else(|| ProofError::PossibleZeroDivisor(tree.clone(), value))?,
            ));
        }
        Ok(divisor)
    }

    /// Records the signs of the factors of a divisor, rounded factors included.
    fn collect_factors(&mut self, tree: &Tree) -> Result<(), ProofError> {
        match tree.op() {
            Op::Mul(a, b) => [a, b].into_iter().try_for_each(|factor| self.collect_factors(factor)),
            Op::Neg(a) | Op::Div(a, _) | Op::Rounded(a) => self.collect_factors(a),
            _ => {
                let factor = self.context.reduce(&self.translate(tree)?);
                if self.factors.iter().all(|known| known.of() != factor.num()) {
                    self.factors.extend(sign(factor.num(), &self.context.signs));
                }
                Ok(())
            }
        }
    }

    pub(super) fn translate(&mut self, tree: &Tree) -> Result<Ratio, ProofError> {
        use Op::*;
        Ok(match tree.op() {
            Symbol(name) => Poly::symbol(algebra::Symbol::Own(name)).into(),
            Int(n) => Poly::constant(*n).into(),
            Neg(a) => -self.translate(a)?,
            Add(a, b) => self.translate(a)? + self.translate(b)?,
            Sub(a, b) => self.translate(a)? - self.translate(b)?,
            Mul(a, b) => self.translate(a)? * self.translate(b)?,
            Div(a, b) => {
                let (value, divisor) = (self.translate(a)?, self.read_divisor(b)?);
                value.over(&divisor).ok_or_else(|| ProofError::PossibleZeroDivisor(b.clone(), divisor))?
            }
            Exp(a) => {
                let exponent = self.context.reduce(&self.translate(a)?);
                Poly::exponential(exponent).into()
            }
            PositivePart(a) => self.resolve_branch(tree, a, &tree.with_op(Int(0)), |a, _| a)?,
            Min(a, b) if matches!(a.op(), Neg(negated) if negated == b) => self.resolve_size(tree, a, b)?,
            Min(a, b) => self.resolve_branch(tree, a, b, |a, b| b - a)?,
            Rounded(a) => {
                let value = self.context.reduce(&self.translate(a)?);
                let (error, largest) = self.read_rounding(a, &value)?;
                let nearest = &largest + Ratio::from(Poly::symbol(error));
                let divisor = || Tree::symbol(PRECISION) + Tree::from(1);
                // The quotient comes first, since the value is long.
                let factor = nearest
                    .over(&largest)
                    .ok_or_else(|| ProofError::PossibleZeroDivisor(divisor(), largest))?;
                value * factor
            }
        })
    }

    /// Returns the error of a rounded formula, and 2ᵖ + 1.
    fn read_rounding(&mut self, of: &Tree, value: &Ratio) -> Result<(algebra::Symbol, Ratio), ProofError> {
        let largest = self.context.inverse_gamma();
        // Values that differ by a power of two have the same relative error.
        let (value, scale) = without_scales(value);
        // Equal values contain the same errors, unless one cancels; equality is then not recognised.
        let errors = |value: &Ratio| -> Vec<_> {
            value.symbols().into_iter().filter(|x| matches!(x, algebra::Symbol::Error(_))).collect()
        };
        let value_errors = errors(&value);
        let mut candidates = self.rounded.iter().filter(|(known, _)| errors(known) == value_errors);
        let equal = candidates.find(|(known, _)| (known - &value).is_zero());
        let rounding = self.context.roundings.iter().position(|known| known == of);
        let rounding = rounding.ok_or(ProofError::TooManyRoundings)?;
        let error = match equal {
            Some((_, error)) => *error,
            None => {
                let index = rounding.try_into().map_err(|_| ProofError::TooManyRoundings)?;
                let error = algebra::Symbol::Error(index);
                self.rounded.push((value, error));
                error
            }
        };
        if self.errors.iter().all(|known| known.of != *of) {
            // Of equal formulas the first one is displayed.
            self.errors.push(Rounding { of: self.context.roundings[rounding].clone(), error, scale });
        }
        Ok((error, largest))
    }

    /// Translates ⟨a⟩ or min(a, b): returns the first branch if the deciding quantity is ≥ 0 for all values
    /// of the symbols, the second if it is ≤ 0 for all.
    fn resolve_branch(
        &mut self,
        bracket: &Tree,
        first: &Tree,
        second: &Tree,
        decides: fn(Ratio, Ratio) -> Ratio,
    ) -> Result<Ratio, ProofError> {
        let (a, b) = (self.translate(first)?, self.translate(second)?);
        let value = decides(a.clone(), b.clone());
        self.decide_branch(bracket, [(first, a), (second, b)], &value)
    }

    /// Returns the first branch if the deciding quantity is ≥ 0, the second if it is ≤ 0.
    fn decide_branch(
        &mut self,
        bracket: &Tree,
        [(first, a), (second, b)]: [(&Tree, Ratio); 2],
        deciding: &Ratio,
    ) -> Result<Ratio, ProofError> {
        let value = self.context.reduce(deciding);
        let signed = self
            .context
            .sign_by_retained(value.clone(), &self.factors)
            .ok_or(ProofError::UndecidedBranch(value))?;
        let is_first = signed.sign().implies(Sign::NonNegative);
        require_effort(self.branches.len().saturating_mul(bracket.size() as usize))?;
        if self.branches.iter().all(|(known, ..)| known != bracket) {
            self.branches.push((bracket.clone(), if is_first { first } else { second }.clone(), signed));
        }
        Ok(if is_first { a } else { b })
    }

    /// Translates min(−x, x), which is −|x|.
    fn resolve_size(&mut self, minimum: &Tree, negated: &Tree, x: &Tree) -> Result<Ratio, ProofError> {
        let value = self.translate(x)?;
        if let Some(size) = self.context.size(&value) {
            return Ok((-Poly::symbol(size)).into());
        }
        let (opposite, twice) = (-&value, &value + &value);
        self.decide_branch(minimum, [(negated, opposite), (x, value)], &twice).map_err(|error| match error {
            ProofError::UndecidedBranch(twice) if !self.context.has_cases_only() => {
                ProofError::UndecidedSize(x.clone(), twice)
            }
            error => error,
        })
    }
}

/// Counts effort of other operations than arithmetic.
fn require_effort(terms: usize) -> Result<(), ProofError> {
    if effort::spend(terms) { Ok(()) } else { Err(ProofError::TooLarge("its proof", effort::MAX_EFFORT)) }
}

fn is_scale(x: algebra::Symbol) -> bool {
    SCALES.iter().any(|scale| x == algebra::Symbol::Own(scale))
}

/// Splits a quotient into a factor without powers of two and a product of powers of two.
pub(in crate::proof) fn without_scales(value: &Ratio) -> (Ratio, Ratio) {
    let scales = |poly: &Poly| -> Poly { poly.common_monomial().without_symbols(|x| !is_scale(x)).into() };
    let scale = Ratio::from(scales(value.num())).over(&scales(value.den()).into());
    let scale = scale.unwrap_or_else(|| Poly::constant(1).into());
    (value.over(&scale).unwrap_or_else(|| value.clone()), scale)
}
