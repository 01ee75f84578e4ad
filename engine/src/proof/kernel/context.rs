//! What is supposed, ready for use.

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::derivation::{Multiple, Rounding, Signed, Supposed, Used, Why};
use super::reader::Reader;
use super::sign::{Certificate, ERRORS, Known, PLACES, Sign, is_small, sign, sign_of_product};
use crate::formula::Hypothesis;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::Proposition;
use crate::number::Tree;

/// Names for the quantities of hypotheses, which no claim may use.
pub(super) const NAMES: [&str; 12] =
    ["s₁", "s₂", "s₃", "s₄", "s₅", "s₆", "s₇", "s₈", "s₉", "s₁₀", "s₁₁", "s₁₂"];

/// What is supposed, ready for use.
#[derive(Clone, Debug)]
pub(super) struct Context {
    pub(super) supposed: Vec<Supposed>,
    pub(super) known: Known,
    rules: Vec<(Monomial, Ratio)>,
    /// What is assumed, with its sign, and not seen in the symbols that are left.
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
        let known = SCALES.into_iter().map(|name| (Symbol(name), Sign::Positive)).collect();
        let (supposed, rules, kept, errors, variable) = Default::default();
        Context { supposed, known, rules, kept, roundings, errors, variable }
    }

    /// For the proof of this: hypotheses on the variable of a limit are solved for it.
    pub(super) fn with_variable(self, says: &Proposition) -> Self {
        let variable = match says {
            Proposition::Limit(_, by, _) => Some(Symbol(by)),
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
            self.suppose_between(hypothesis, Symbol(x), &lower, &upper);
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
        let errors = value.num().symbols().into_iter().filter(|x| ERRORS.contains(&x.0));
        let largest = self.largest();
        errors.fold(value.num().clone(), |rest, error| {
            let nearest = &largest + Ratio::from(Poly::symbol(error));
            rest.over(nearest.num()).filter(|_| *nearest.den() == *largest.den()).unwrap_or(rest)
        })
    }

    pub(super) fn rounds(&self) -> bool {
        !self.roundings.is_empty()
    }

    /// N
    pub(super) fn largest(&self) -> Ratio {
        self.reduce(&Ratio::from(Poly::symbol(Symbol(PRECISION)) + Poly::constant(1)))
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
        let sign = |part: &Poly| sign_of_product(part, factors, &self.known);
        let (num, den) = (sign(value.num())?, sign(value.den())?);
        den.sign().is_strict().then_some(Signed { value, less: None, num, den })
    }

    /// The same also by what is [kept](Self::kept): v = m h + (v − m h) has the sign that both parts have,
    /// where h is assumed to have one. The factor m is one for which a symbol cancels: an error or an
    /// interval parameter, if there is one in both.
    pub(super) fn sign_by_kept(&self, value: Ratio, factors: &[Certificate]) -> Option<Signed> {
        let by = |h: &Ratio, sign: Sign, m: &Ratio| {
            let factor = self.sign(m.clone(), factors)?;
            let rest = self.sign(&value - m * h, factors)?;
            let whole = factor.sign().times(sign).plus(rest.sign())?;
            let less = Some(Multiple { factor, of: h.clone(), whole }.into());
            Some(Signed { value: value.clone(), less, ..rest })
        };
        self.sign(value.clone(), factors).or_else(|| {
            self.kept.iter().rev().find_map(|(h, sign)| {
                let h = self.reduce(h);
                let scale = Ratio::from(h.den().clone()).over(&value.den().clone().into())?;
                let factor = |x: Symbol| {
                    let [[_, own], [_, other]] = [value.num().coefficients(x)?, h.num().coefficients(x)?];
                    Some(&scale * Ratio::from(own).over(&other.into())?)
                };
                let (small, others): (Vec<_>, Vec<_>) =
                    h.num().symbols().into_iter().partition(|x| is_small(*x));
                let cancelling = |of: Vec<Symbol>| of.into_iter().filter_map(factor).collect::<Vec<_>>();
                let small = cancelling(small);
                let mut all = if small.is_empty() { cancelling(others) } else { small };
                all.dedup();
                all.iter().find_map(|m| by(&h, *sign, m))
            })
        })
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
                    self.known.insert(symbol, sign);
                    Used::Symbol(symbol)
                } else if self.bounds_the_variable_again(&value) {
                    Used::Unused
                } else if let Some((divisor, (pivot, by), slack)) = self.solve(given.as_ref(), &value, sign) {
                    divided_by = divisor;
                    self.known.insert(slack, sign);
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
                .pivot(given.as_ref(), &value, &Poly::zero(), sign)
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
        self.variable.is_some_and(|x| NAMES.contains(&x.0) && value.symbols().contains(&x))
    }

    /// A pivot of a quantity, or else of its quotient by a symbol that is positive: 0 < k < 1 is
    /// k = 1/(1 + s) with s = (1 − k)/k > 0. With the divisor, if any, and the slack.
    fn solve(&self, given: Option<&Hypothesis>, value: &Ratio, sign: Sign) -> Option<Solved> {
        let slacks = self.supposed.iter().filter(|s| matches!(s.used, Used::Pivot(..))).count();
        let slack = NAMES.get(slacks).copied().map(Symbol)?;
        let pivot = |value: &Ratio| self.pivot(given, value, &Poly::symbol(slack), sign);
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
        let used = match PLACES.get(named).copied().map(Symbol) {
            Some(place) if open && !middle.symbols().contains(&x) && !reach.symbols().contains(&x) => {
                let by = &middle + reach * Ratio::from(Poly::symbol(place));
                self.kept.extend(self.known.remove(&x).map(|sign| (own.clone(), sign)));
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

    /// A monomial of the quantity, and what it equals if the quantity is `slack`.
    ///
    /// Best a symbol of which nothing is known and that stands alone or times what is not 0, so that it
    /// disappears for good; else a product of symbols of which little is known, so that little is forgotten;
    /// else a symbol whose sign is then seen again: with b = a + s for b − a > 0 that of b is.
    ///
    /// Where there are errors in it, the symbol that the hypothesis is solved for comes first, and products
    /// last: they would be forgotten for something long.
    fn pivot(
        &self,
        given: Option<&Hypothesis>,
        value: &Ratio,
        slack: &Poly,
        sign_of_slack: Sign,
    ) -> Option<(Monomial, Ratio)> {
        // num − slack · den = 0, and den is not 0.
        let equation = value.num() - slack * value.den();
        let mut context = self.clone();
        context.known.extend(slack.symbols().into_iter().map(|s| (s, sign_of_slack)));
        let solved = |x: Symbol| {
            let [rest, coefficient] = equation.coefficients(x)?;
            let (strict, length) =
                (sign(&coefficient, &context.known)?.sign().is_strict(), coefficient.terms().len());
            let by = Ratio::from(-rest).over(&coefficient.into())?;
            (strict && !by.symbols().contains(&x)).then_some((length, (Monomial::of(x), by)))
        };
        let symbols = value.num().symbols();
        let rounds = symbols.iter().any(|x| is_small(*x));
        let comes_later = |x: &Symbol| rounds && given.is_none_or(|given| given.solved_for != x.0);
        let free = |x: &&Symbol| !self.known.contains_key(x) && !is_small(**x);
        let free = symbols.iter().filter(free).filter_map(|x| Some((comes_later(x), solved(*x)?)));
        let product = || {
            let known = |m: &Monomial| m.powers().filter(|(x, _)| self.known.contains_key(x)).count();
            let large = |m: &&Monomial| m.powers().len() > 1 && !m.powers().any(|(x, _)| is_small(x));
            let own = value.num().terms().map(|(m, _)| m).filter(large);
            let pivot = own.min_by_key(|m| known(m))?.clone();
            let coefficient = equation.terms().find(|(m, _)| **m == pivot)?.1.clone();
            let rest = &equation - Poly::constant(coefficient.clone()) * Poly::from(pivot.clone());
            let by = -&rest * Poly::constant(coefficient.recip());
            (!rest.contains(&pivot)).then_some((pivot, by.into()))
        };
        let seen_again = || {
            symbols.iter().find_map(|x| {
                let (_, rule) = solved(*x)?;
                let signed = context.sign(self.reduce(&rule.1), &[])?;
                signed.sign().implies(*self.known.get(x)?).then_some(rule)
            })
        };
        // In a limit first of all the variable, so that the slack tends to infinity instead.
        let variable = self.variable.filter(|x| symbols.contains(x) && !slack.is_zero());
        if let Some((_, rule)) = variable.and_then(solved) {
            return Some(rule);
        }
        let free = free.min_by_key(|(later, (terms, _))| (*later, *terms)).map(|(_, (_, rule))| rule);
        free.or_else(|| {
            if rounds || self.rounds() {
                seen_again().or_else(product)
            } else {
                product().or_else(seen_again)
            }
        })
    }
}

/// A divisor, if any; a pivot and what it equals; the slack.
type Solved = (Option<Ratio>, (Monomial, Ratio), Symbol);

/// The symbol that a quantity is, if it is one.
fn as_symbol(value: &Ratio) -> Option<Symbol> {
    let x = value.num().symbols().into_iter().next()?;
    (*value == Ratio::from(Poly::symbol(x))).then_some(x)
}
