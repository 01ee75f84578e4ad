//! What is supposed, ready for use.

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::derivation::{Multiple, Rounding, Signed, Supposed, Used, Why};
use super::reader::Reader;
use super::sign::{Certificate, Known, Sign};
use crate::formula::Hypothesis;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::Proposition;
use crate::number::Tree;
use crate::proof::search;
use std::sync::Arc;

/// What is supposed, ready for use.
#[derive(Clone, Debug)]
pub(in crate::proof) struct Context {
    pub(super) supposed: Vec<Supposed>,
    pub(super) known: Arc<Known>,
    rules: Vec<(Monomial, Ratio)>,
    /// Assumed quantities, each with its sign, that the remaining symbols do not show.
    kept: Vec<(Ratio, Sign)>,
    /// What is rounded: with the errors of the same place.
    pub(super) roundings: Vec<Tree>,
    /// What has been rounded in hypotheses, with its error.
    pub(super) errors: Vec<Rounding>,
    /// What tends to infinity, in the proof of a limit.
    variable: Option<Symbol>,
}

impl Context {
    /// Nothing yet, but that powers of two are positive.
    pub(super) fn of(roundings: Vec<Tree>) -> Self {
        let known = SCALES.into_iter().map(|name| (Symbol::Own(name), Sign::Positive)).collect();
        let (supposed, rules, kept, errors, variable) = Default::default();
        Context { supposed, known: Arc::new(known), rules, kept, roundings, errors, variable }
    }

    /// For the proof of this: hypotheses on the variable of a limit are solved for it.
    pub(super) fn with_variable(self, says: &Proposition) -> Self {
        let variable = match says {
            Proposition::Limit(_, by, _) => Some(Symbol::Own(by)),
            _ => None,
        };
        Context { variable, ..self }
    }

    /// Takes in a hypothesis.
    pub(super) fn take_in(&mut self, hypothesis: &Hypothesis) -> Result<(), Why> {
        let mut reader = Reader::new(self);
        if let Some((x, lower, upper)) = hypothesis.interval() {
            let [lower, upper] = [reader.read(lower)?, reader.read(upper)?];
            self.errors = reader.errors;
            self.suppose_between(hypothesis, Symbol::Own(x), &lower, &upper);
        } else {
            let value = reader.read(&hypothesis.value)?;
            self.errors = reader.errors;
            self.suppose(Some(hypothesis), value, hypothesis.relation.into());
        }
        Ok(())
    }

    /// What has the sign of a quotient whose denominator is positive: its numerator, without the factors
    /// 2ᵖ + 1 + e, which are positive too.
    pub(super) fn deciding(&self, value: &Ratio) -> Poly {
        let errors = value.num().symbols().into_iter().filter(|x| matches!(x, Symbol::Error(_)));
        let largest = self.largest();
        errors.fold(value.num().clone(), |rest, error| {
            let nearest = &largest + Ratio::from(Poly::symbol(error));
            rest.over(nearest.num()).filter(|_| *nearest.den() == *largest.den()).unwrap_or(rest)
        })
    }

    pub(in crate::proof) fn rounds(&self) -> bool {
        !self.roundings.is_empty()
    }

    /// N
    pub(super) fn largest(&self) -> Ratio {
        self.reduce(&Ratio::from(Poly::symbol(Symbol::Own(PRECISION)) + Poly::constant(1)))
    }

    /// With every pivot replaced, until there is none left; equal in value to what is given.
    pub(super) fn reduce(&self, value: &Ratio) -> Ratio {
        let mut value = value.clone();
        // Pivots could bring each other back for ever; then the value just stays unreduced.
        for _ in &self.rules {
            let mut stays = true;
            for (pivot, by) in &self.rules {
                if value.contains(pivot) {
                    value = value.replace(pivot, by);
                    stays = false;
                }
            }
            if stays {
                break;
            }
        }
        value
    }

    /// The sign of a reduced quotient, if the rules find that of numerator and denominator.
    pub(super) fn sign(&self, value: Ratio, factors: &[Certificate]) -> Option<Signed> {
        self.sign_under(value, factors, &self.known)
    }

    fn sign_under(&self, value: Ratio, factors: &[Certificate], known: &Arc<Known>) -> Option<Signed> {
        let find = |of: &Poly, known: &Arc<Known>| search::sign_of_product(of, factors, known);
        let sign = |part: &Poly| Certificate::found(part, known, &find);
        let (num, den) = (sign(value.num())?, sign(value.den())?);
        den.sign().is_strict().then_some(Signed { value, less: None, num, den })
    }

    /// Returns the sign of a reduced quotient, also by an assumption that is [kept](Self::kept): where h is
    /// assumed to have a sign, v = m h + (v − m h) has the sign that both parts have.
    pub(super) fn sign_by_kept(&self, value: Ratio, factors: &[Certificate]) -> Option<Signed> {
        let by = |h: &Ratio, sign: Sign, m: Ratio| {
            let rest = self.sign(&value - &m * h, factors)?;
            let factor = self.sign(m, factors)?;
            let whole = factor.sign().times(sign).plus(rest.sign())?;
            let less = Some(Multiple { factor, of: h.clone(), whole }.into());
            Some(Signed { value: value.clone(), less, ..rest })
        };
        let kept = || self.kept.iter().rev().map(|(h, sign)| (self.reduce(h), *sign));
        self.sign(value.clone(), factors).or_else(|| {
            kept().find_map(|(h, sign)| {
                search::multipliers(&value, &h).into_iter().find_map(|m| by(&h, sign, m))
            })
        })
    }

    /// Returns the sign of a quotient under other signs of symbols.
    pub(in crate::proof) fn reduced_sign(&self, value: &Ratio, known: &Arc<Known>) -> Option<Sign> {
        Some(self.sign_under(self.reduce(value), &[], known)?.sign())
    }

    pub(in crate::proof) fn known(&self) -> &Known {
        &self.known
    }

    pub(in crate::proof) fn variable(&self) -> Option<Symbol> {
        self.variable
    }

    fn know(&mut self, symbol: Symbol, sign: Sign) {
        Arc::make_mut(&mut self.known).insert(symbol, sign);
    }

    /// Takes in that a quantity has a sign.
    pub(super) fn suppose(&mut self, given: Option<&Hypothesis>, value: Ratio, sign: Sign) {
        let value = self.reduce(&value);
        let (given, mut divided_by) = (given.cloned(), None);
        let used = match sign {
            _ if self.sign(value.clone(), &[]).is_some_and(|signed| signed.sign().implies(sign)) => {
                Used::Follows
            }
            Sign::Negative | Sign::NonPositive => {
                return self.suppose(given.as_ref(), -value, sign.negated());
            }
            Sign::Positive | Sign::NonNegative => {
                if let Some(symbol) = as_symbol(&value) {
                    self.know(symbol, sign);
                    Used::Symbol(symbol)
                } else if self.bounds_the_variable_again(&value) {
                    Used::Unused
                } else if let Some((divisor, (pivot, by), slack)) = self.solve(given.as_ref(), &value, sign) {
                    divided_by = divisor;
                    self.know(slack, sign);
                    if Some(&pivot) == self.variable.map(Monomial::of).as_ref() {
                        self.variable = Some(slack);
                    }
                    Used::Pivot(pivot, by, Some(slack))
                } else {
                    self.kept.push((value.clone(), sign));
                    Used::Kept
                }
            }
            Sign::Zero => self
                .pivot(given.as_ref(), &value, None)
                .map_or(Used::Unused, |(pivot, by)| Used::Pivot(pivot, by, None)),
        };
        if let Used::Pivot(pivot, by, _) = &used {
            self.replace(pivot.clone(), by.clone());
        }
        self.supposed.push(Supposed { given, value, sign, divided_by, used });
    }

    /// Returns `true` if a quantity depends on the slack that tends to infinity in place of the variable: one
    /// more pivot would replace it, and what is known of it.
    fn bounds_the_variable_again(&self, value: &Ratio) -> bool {
        self.variable.is_some_and(|x| matches!(x, Symbol::Slack(_)) && value.symbols().contains(&x))
    }

    /// A pivot of a quantity, or else of its quotient by a symbol that is positive: 0 < k < 1 is
    /// k = 1/(1 + s) with s = (1 − k)/k > 0. With the divisor, if any, and the slack.
    fn solve(&self, given: Option<&Hypothesis>, value: &Ratio, sign: Sign) -> Option<Solved> {
        let slacks = self.supposed.iter().filter(|s| matches!(s.used, Used::Pivot(..))).count();
        let slack = Symbol::Slack(slacks.try_into().ok()?);
        let pivot = |value: &Ratio| self.pivot(given, value, Some((slack, sign)));
        let quotient = |x: Symbol| {
            let divisor = Ratio::from(Poly::symbol(x));
            let is_positive = self.known.get(&x) == Some(&Sign::Positive);
            let rule = pivot(&value.over(&divisor).filter(|_| is_positive)?)?;
            Some((Some(divisor), rule, slack))
        };
        let whole = pivot(value).map(|rule| (None, rule, slack));
        whole.or_else(|| value.num().symbols().into_iter().find_map(quotient))
    }

    /// Takes in that a symbol is in an interval: for some t between −1 and 1 it is its middle and t times
    /// half of its length. That does not show a sign that is known of the symbol, which is kept.
    fn suppose_between(&mut self, given: &Hypothesis, x: Symbol, lower: &Ratio, upper: &Ratio) {
        let half = Ratio::from(Poly::constant((1, 2)));
        let [middle, reach] = [upper + lower, upper - lower].map(|sum| self.reduce(&(sum * &half)));
        let own = Ratio::from(Poly::symbol(x));
        let open = self.reduce(&own) == own;
        let named = self.supposed.iter().filter(|s| matches!(s.used, Used::Between(..))).count();
        let used = match named.try_into().map(Symbol::Place) {
            Ok(place) if open && !middle.symbols().contains(&x) && !reach.symbols().contains(&x) => {
                let by = &middle + reach * Ratio::from(Poly::symbol(place));
                self.kept.extend(Arc::make_mut(&mut self.known).remove(&x).map(|sign| (own.clone(), sign)));
                self.replace(Monomial::of(x), by.clone());
                Used::Between(x, by, place)
            }
            _ => Used::Unused,
        };
        let sign = Sign::NonNegative;
        self.supposed.push(Supposed { given: Some(given.clone()), value: own, sign, divided_by: None, used });
    }

    /// From now on a monomial is replaced.
    fn replace(&mut self, pivot: Monomial, by: Ratio) {
        for (_, older) in &mut self.rules {
            *older = older.replace(&pivot, &by);
        }
        self.rules.push((pivot, by));
    }

    /// Returns a monomial of the quantity, and what it equals if the quantity is the slack, or 0 without one.
    fn pivot(
        &self,
        given: Option<&Hypothesis>,
        value: &Ratio,
        slack: Option<(Symbol, Sign)>,
    ) -> Option<(Monomial, Ratio)> {
        // num − slack · den = 0, and den is not 0.
        let (mut equation, mut known) = (value.num().clone(), self.known.clone());
        if let Some((slack, sign)) = slack {
            equation = equation - Poly::symbol(slack) * value.den();
            Arc::make_mut(&mut known).insert(slack, sign);
        }
        let pivot = search::pivot(self, given, value, &equation, &known)?;
        let by = solved_for(&pivot, &equation, &known)?;
        Some((pivot, by))
    }
}

/// Returns the value of a monomial by the equation `of` = 0: of a symbol whose factor is not 0, or of a
/// product that stands in one term.
pub(in crate::proof) fn solved_for(pivot: &Monomial, of: &Poly, known: &Arc<Known>) -> Option<Ratio> {
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

/// Returns the sign of a polynomial, if the search finds it.
pub(super) fn sign(of: &Poly, known: &Arc<Known>) -> Option<Certificate> {
    Certificate::found(of, known, &search::sign)
}

/// A divisor, if any; a pivot and what it equals; the slack.
type Solved = (Option<Ratio>, (Monomial, Ratio), Symbol);

/// The symbol that a quantity is, if it is one.
fn as_symbol(value: &Ratio) -> Option<Symbol> {
    let x = value.num().symbols().into_iter().next()?;
    (*value == Ratio::from(Poly::symbol(x))).then_some(x)
}
