//! The assumptions of a proof and the substitutions that follow from them.

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::assumption::{Assumption, AssumptionUse, Multiple, SignedRatio};
use super::choice;
use super::sign::{Certificate, SignEnv};
use crate::formula::Hypothesis;
use crate::formula::claim::{PRECISION, SCALES};
use crate::number::Tree;
use crate::proof::check::Sign;
use std::sync::Arc;

/// Maximum number of absolute values that are replaced.
const MAX_SIZES: usize = 8;

/// The assumptions of a proof, in the form in which the rules use them.
#[derive(Clone, Debug, Default)]
pub(in crate::proof) struct Context {
    pub(super) assumptions: Vec<Assumption>,
    pub(super) signs: Arc<SignEnv>,
    /// The pivots and their values.
    substitutions: Vec<(Monomial, Ratio)>,
    /// Quantities of known sign that are not expressed by the remaining symbols.
    retained: Vec<(Ratio, Sign)>,
    /// The rounded formulas; the position of each is the index of its error.
    pub(super) roundings: Vec<Tree>,
}

impl Context {
    /// Creates a context whose only assumption is that powers of two are positive.
    pub(in crate::proof) fn of(roundings: Vec<Tree>) -> Self {
        let known = SCALES.into_iter().map(|name| (Symbol::Own(name), Sign::Positive)).collect();
        Context { signs: Arc::new(known), roundings, ..Context::default() }
    }

    /// Returns a polynomial with the sign of a quotient whose denominator is positive: the numerator without
    /// its factors 2ᵖ + 1 + e, which are positive.
    pub(in crate::proof) fn sign_numerator(&self, value: &Ratio) -> Poly {
        let errors = value.num().symbols().into_iter().filter(|x| matches!(x, Symbol::Error(_)));
        let largest = self.inverse_gamma();
        errors.fold(value.num().clone(), |rest, error| {
            let nearest = &largest + Ratio::from(Poly::symbol(error));
            rest.over(nearest.num()).filter(|_| *nearest.den() == *largest.den()).unwrap_or(rest)
        })
    }

    /// Returns 2ᵖ + 1, the reciprocal of the largest relative rounding error.
    pub(in crate::proof) fn inverse_gamma(&self) -> Ratio {
        self.reduce(&Ratio::from(Poly::symbol(Symbol::Own(PRECISION)) + Poly::constant(1)))
    }

    /// Replaces every pivot, repeatedly; the result is equal to `value` under the assumptions.
    pub(in crate::proof) fn reduce(&self, value: &Ratio) -> Ratio {
        let mut value = value.clone();
        // Substitutions could reintroduce each other's pivots indefinitely; some are then left in the value.
        for _ in &self.substitutions {
            let mut is_reduced = true;
            for (pivot, by) in &self.substitutions {
                if value.contains(pivot) {
                    value = value.replace(pivot, by);
                    is_reduced = false;
                }
            }
            if is_reduced {
                break;
            }
        }
        value
    }

    /// Returns the sign of a reduced quotient if the rules find those of numerator and denominator.
    pub(in crate::proof) fn sign(&self, value: Ratio, factors: &[Certificate]) -> Option<SignedRatio> {
        self.sign_under(value, factors, &self.signs)
    }

    fn sign_under(&self, value: Ratio, factors: &[Certificate], known: &Arc<SignEnv>) -> Option<SignedRatio> {
        let [num, den] = [value.num(), value.den()].map(|part| choice::sign_of_product(part, factors, known));
        let (num, den) = (num?, den?);
        den.sign().is_strict().then_some(SignedRatio { subtracted: None, num, den })
    }

    /// Returns the sign of a reduced quotient v, directly or by a [retained](Self::retained) quantity h:
    /// v = m h + (v − m h) has the common sign of the two terms.
    pub(in crate::proof) fn sign_by_retained(
        &self,
        value: Ratio,
        factors: &[Certificate],
    ) -> Option<SignedRatio> {
        let by = |h: &Ratio, sign: Sign, m: Ratio| {
            let rest = self.sign(&value - &m * h, factors)?;
            let factor = self.sign(m, factors)?;
            let whole = factor.sign().times(sign).plus(rest.sign())?;
            let less = Some(Multiple { factor, of: h.clone(), sum_sign: whole }.into());
            Some(SignedRatio { subtracted: less, ..rest })
        };
        let mut retained = self.retained.iter().rev().map(|(h, sign)| (self.reduce(h), *sign));
        self.sign(value.clone(), factors).or_else(|| {
            retained.find_map(|(h, sign)| {
                choice::multipliers(&value, &h).into_iter().find_map(|m| by(&h, sign, m))
            })
        })
    }

    /// Returns the sign of a quotient for the given signs of symbols, after reduction.
    pub(in crate::proof) fn reduced_sign(&self, value: &Ratio, known: &Arc<SignEnv>) -> Option<Sign> {
        Some(self.sign_under(self.reduce(value), &[], known)?.sign())
    }

    /// Returns the assumptions in order.
    pub(in crate::proof) fn assumptions(&self) -> &[Assumption] {
        &self.assumptions
    }

    /// Returns the quantities of known sign that are not expressed by the remaining symbols.
    pub(in crate::proof) fn retained(&self) -> &[(Ratio, Sign)] {
        &self.retained
    }

    /// Returns the rounded formulas; the position of each is the index of its error.
    pub(in crate::proof) fn roundings(&self) -> &[Tree] {
        &self.roundings
    }

    /// Returns the sign of a polynomial of the remaining symbols if the search finds it.
    pub(in crate::proof) fn sign_of(&self, of: &Poly) -> Option<Certificate> {
        sign(of, &self.signs)
    }

    /// Returns the known signs of the remaining symbols.
    pub(in crate::proof) fn signs(&self) -> &Arc<SignEnv> {
        &self.signs
    }

    /// Returns `true` if a symbol is not replaced, so that an interval may give it a value.
    pub(in crate::proof) fn is_free(&self, x: Symbol) -> bool {
        let quantity = Ratio::from(Poly::symbol(x));
        self.reduce(&quantity) == quantity
    }

    fn set_sign(&mut self, symbol: Symbol, sign: Sign) {
        Arc::make_mut(&mut self.signs).insert(symbol, sign);
    }

    /// Adds the assumption that a quantity has a sign.
    pub(in crate::proof) fn assume_sign(&mut self, given: Option<&Hypothesis>, value: Ratio, sign: Sign) {
        let value = self.reduce(&value);
        let (given, mut divided_by) = (given.cloned(), None);
        let used = match sign {
            _ if self.sign(value.clone(), &[]).is_some_and(|signed| signed.sign().implies(sign)) => {
                AssumptionUse::Implied
            }
            Sign::Negative | Sign::NonPositive => {
                return self.assume_sign(given.as_ref(), -value, sign.negated());
            }
            Sign::Positive | Sign::NonNegative => {
                if let Some(symbol) = as_symbol(&value) {
                    self.set_sign(symbol, sign);
                    AssumptionUse::Symbol(symbol)
                } else if let Some((divisor, (pivot, by), slack)) = self.solve(given.as_ref(), &value, sign) {
                    divided_by = divisor;
                    self.set_sign(slack, sign);
                    AssumptionUse::Pivot(pivot, by, Some(slack))
                } else {
                    self.retained.push((value.clone(), sign));
                    AssumptionUse::Retained
                }
            }
            Sign::Zero => self
                .pivot(given.as_ref(), &value, &Poly::zero(), &self.signs)
                .map_or(AssumptionUse::Unused, |(pivot, by)| AssumptionUse::Pivot(pivot, by, None)),
        };
        if let AssumptionUse::Pivot(pivot, by, _) = &used {
            self.replace(pivot.clone(), by.clone());
        }
        self.assumptions.push(Assumption { hypothesis: given, value, divisor: divided_by, usage: used });
    }

    /// Finds a pivot of a quantity, otherwise of its quotient by a positive symbol: 0 < k < 1 is
    /// k = 1/(1 + s) with s = (1 − k)/k > 0.
    fn solve(&self, given: Option<&Hypothesis>, value: &Ratio, sign: Sign) -> Option<Solved> {
        let slack = self.next_slack()?;
        let mut known = self.signs.clone();
        Arc::make_mut(&mut known).insert(slack, sign);
        let pivot = |value: &Ratio| self.pivot(given, value, &Poly::symbol(slack), &known);
        let quotient = |x: Symbol| {
            let divisor = Ratio::from(Poly::symbol(x));
            let is_positive = self.signs.get(&x) == Some(&Sign::Positive);
            let rule = pivot(&value.over(&divisor).filter(|_| is_positive)?)?;
            Some((Some(divisor), rule, slack))
        };
        let whole = pivot(value).map(|rule| (None, rule, slack));
        whole.or_else(|| value.num().symbols().into_iter().find_map(quotient))
    }

    /// Adds the assumption that a symbol lies in an interval, as the midpoint plus t times half the length,
    /// for some t between −1 and 1. A known sign of the symbol, which this does not imply, is retained.
    pub(in crate::proof) fn assume_interval(
        &mut self,
        given: &Hypothesis,
        x: Symbol,
        lower: &Ratio,
        upper: &Ratio,
    ) {
        let half = Ratio::from(Poly::constant((1, 2)));
        let [middle, reach] = [upper + lower, upper - lower].map(|sum| self.reduce(&(sum * &half)));
        let quantity = Ratio::from(Poly::symbol(x));
        let used = match self.next_place() {
            Some(place)
                if self.is_free(x) && !middle.symbols().contains(&x) && !reach.symbols().contains(&x) =>
            {
                let by = &middle + reach * Ratio::from(Poly::symbol(place));
                let sign = Arc::make_mut(&mut self.signs).remove(&x);
                self.retained.extend(sign.map(|sign| (quantity.clone(), sign)));
                self.replace(Monomial::of(x), by.clone());
                AssumptionUse::Interval(x, by, place)
            }
            _ => AssumptionUse::Unused,
        };
        let hypothesis = Some(given.clone());
        self.assumptions.push(Assumption { hypothesis, value: quantity, divisor: None, usage: used });
    }

    /// Replaces a quantity x by t s, where s is its absolute value and −1 ≤ t ≤ 1, given its formula and 2 x.
    /// Returns `false` if x cannot be replaced.
    pub(in crate::proof) fn assume_size(&mut self, of: &Tree, twice: &Ratio) -> bool {
        if self.assumptions.iter().filter(|assumption| assumption.usage.is_size()).count() == MAX_SIZES {
            return false;
        }
        let Some((size, place)) = self.next_slack().zip(self.next_place()) else { return false };
        let value = self.reduce(&(twice * Ratio::from(Poly::constant((1, 2)))));
        let mut known = self.signs.clone();
        Arc::make_mut(&mut known).insert(size, Sign::NonNegative);
        let product = Poly::symbol(size) * Poly::symbol(place);
        let Some((pivot, by)) = self.pivot(None, &value, &product, &known) else { return false };
        self.signs = known;
        self.replace(pivot.clone(), by);
        let usage = AssumptionUse::Size { of: of.clone(), pivot, size, place };
        let (hypothesis, divisor) = (None, None);
        self.assumptions.push(Assumption { hypothesis, value: value.clone(), divisor, usage });
        self.size(&value).is_some()
    }

    /// Returns the absolute value of a quantity, if it is a symbol.
    pub(in crate::proof) fn size(&self, value: &Ratio) -> Option<Symbol> {
        self.assumptions.iter().find_map(|assumption| {
            let AssumptionUse::Size { size, .. } = &assumption.usage else { return None };
            let [difference, sum] = [&assumption.value - value, &assumption.value + value];
            let is_same = self.reduce(&difference).is_zero() || self.reduce(&sum).is_zero();
            is_same.then_some(*size)
        })
    }

    fn next_slack(&self) -> Option<Symbol> {
        let has_slack =
            |usage: &AssumptionUse| matches!(usage, AssumptionUse::Pivot(..) | AssumptionUse::Size { .. });
        let slacks = self.assumptions.iter().filter(|assumption| has_slack(&assumption.usage)).count();
        slacks.try_into().ok().map(Symbol::Slack)
    }

    fn next_place(&self) -> Option<Symbol> {
        let has_place =
            |usage: &AssumptionUse| matches!(usage, AssumptionUse::Interval(..) | AssumptionUse::Size { .. });
        let places = self.assumptions.iter().filter(|assumption| has_place(&assumption.usage)).count();
        places.try_into().ok().map(Symbol::Place)
    }

    /// Adds a substitution.
    fn replace(&mut self, pivot: Monomial, by: Ratio) {
        for (_, value) in &mut self.substitutions {
            *value = value.replace(&pivot, &by);
        }
        self.substitutions.push((pivot, by));
    }

    /// Returns a monomial and its value where `value` equals a polynomial in new symbols.
    fn pivot(
        &self,
        given: Option<&Hypothesis>,
        value: &Ratio,
        replaced_by: &Poly,
        known: &Arc<SignEnv>,
    ) -> Option<(Monomial, Ratio)> {
        // num − replaced_by · den = 0, and den is not 0.
        let equation = value.num() - replaced_by * value.den();
        let pivot = choice::pivot(self, given, value, &equation, known)?;
        let by = solve_for(&pivot, &equation, known)?;
        Some((pivot, by))
    }
}

/// Solves the equation `of` = 0 for a monomial: for a symbol whose coefficient is not 0, or for a product
/// that occurs in one term only.
pub(in crate::proof) fn solve_for(pivot: &Monomial, of: &Poly, known: &Arc<SignEnv>) -> Option<Ratio> {
    let by = if let Some(x) = pivot.as_symbol() {
        let [rest, coefficient] = of.coefficients(x)?;
        sign(&coefficient, known).filter(|certificate| certificate.sign().is_strict())?;
        Ratio::from(-rest).over(&coefficient.into())?
    } else {
        let (_, coefficient) = of.terms().find(|(m, _)| *m == pivot)?;
        let rest = of - Poly::from_iter([(pivot.clone(), coefficient.clone())]);
        (-rest * Poly::constant(coefficient.recip())).into()
    };
    (!by.contains(pivot)).then_some(by)
}

/// Returns the sign of a polynomial if the search finds it.
pub(super) fn sign(of: &Poly, known: &Arc<SignEnv>) -> Option<Certificate> {
    choice::sign(of, known)
}

/// The divisor, if any; the pivot and its value; the slack variable.
type Solved = (Option<Ratio>, (Monomial, Ratio), Symbol);

/// Returns the symbol if a quantity is a single symbol.
fn as_symbol(value: &Ratio) -> Option<Symbol> {
    let x = value.num().symbols().into_iter().next()?;
    (*value == Ratio::from(Poly::symbol(x))).then_some(x)
}
