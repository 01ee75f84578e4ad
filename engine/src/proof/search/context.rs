//! The assumptions of a proof and the substitutions that follow from them.

use super::algebra::{FIRST_SLACK, Monomial, Poly, Ratio, UNKNOWN};
use super::assumption::{AssumedFact, Assumption, AssumptionUse, Multiple, SignedRatio};
use super::choice;
use super::dictionary::poly;
use super::rules::SignEnv;
use super::symbol::Symbol;
use crate::formula::Hypothesis;
use crate::formula::claim::PRECISION;
use crate::number::{Exponential, Tree};
use crate::proof::check::{Atom, Knowledge, Polynomial, Quotient, Sequent, Sign};
use std::collections::BTreeMap;
use std::iter;

/// Maximum number of absolute values that are replaced.
const MAX_SIZES: usize = 8;

/// The assumptions of a proof, in the form in which the rules use them.
#[derive(Clone)]
pub(in crate::proof) struct Context {
    /// The assumptions in order.
    pub(in crate::proof) assumptions: Vec<Assumption>,
    /// The known signs of the remaining variables.
    pub(in crate::proof) signs: SignEnv,
    /// The variables in messages.
    symbols: BTreeMap<usize, Symbol>,
    /// The exponentials by their variables.
    pub(in crate::proof) exponentials: BTreeMap<usize, Tree>,
    /// The formulas whose errors e₁, e₂, … are.
    pub(in crate::proof) roundings: Vec<Tree>,
    /// The pivots and their values.
    substitutions: Vec<(Monomial, Ratio)>,
    /// 2ᵖ + 1 before any assumption, unless there are no roundings.
    pub(super) largest: Poly,
}

impl Context {
    /// Creates a context with the intervals of the sequent and the signs that its atoms have by definition.
    pub(in crate::proof) fn new(sequent: &Sequent) -> Self {
        let (assumptions, symbols, exponentials, roundings, substitutions) = Default::default();
        let table = &sequent.table;
        let units = (0..FIRST_SLACK).filter(|x| table.is_unit(*x));
        let signs = SignEnv::new(units, sequent.effort.clone());
        let precision = table.variable(Atom::Own(PRECISION)).map_or_else(|_| Poly::zero(), Poly::variable);
        let largest = precision + Poly::constant(1);
        let mut context =
            Context { assumptions, signs, symbols, exponentials, roundings, substitutions, largest };
        for (x, atom) in table.atoms.iter().enumerate() {
            let symbol = match atom {
                Atom::Own(name) => Some(Symbol::Own(name)),
                Atom::Error(of) => {
                    context.roundings.extend(table.formula(*of).cloned());
                    context.next_symbol(Symbol::Error)
                }
                Atom::IntervalParameter(i) => {
                    context.assumptions.push(Assumption {
                        hypothesis: Some(sequent.hypotheses[*i].clone()),
                        value: Poly::variable(x).into(),
                        fact: None,
                        usage: AssumptionUse::Interval(x),
                    });
                    context.next_symbol(Symbol::IntervalParameter)
                }
                Atom::Exponential(of) => {
                    let exponential = table.formula(*of).map(Tree::exp);
                    context.exponentials.extend(exponential.map(|tree| (x, tree)));
                    None
                }
                Atom::Size(_) | Atom::Factor(_) => None,
            };
            context.signs.set(x, table.sign(x));
            context.symbols.extend(symbol.map(|symbol| (x, symbol)));
        }
        context
    }

    /// Returns a variable as it is named in messages.
    pub(in crate::proof) fn symbol(&self, x: usize) -> Option<Symbol> {
        self.symbols.get(&x).copied()
    }

    /// Returns 2ᵖ + 1 + e for each rounding error in a polynomial.
    pub(super) fn largest_errors(&self, of: &Poly) -> Vec<Poly> {
        let variables = of.variables().into_iter();
        let errors = variables.filter(|x| matches!(self.symbol(*x), Some(Symbol::Error(_))));
        errors.map(|x| &self.largest + Poly::variable(x)).collect()
    }

    /// Returns a polynomial with the sign of a quotient whose denominator is positive: the numerator without
    /// its factors 2ᵖ + 1 + e, which are positive.
    pub(super) fn sign_numerator(&self, value: &Ratio) -> Poly {
        self.largest_errors(value.num()).into_iter().fold(value.num().clone(), |rest, factor| {
            rest.checked_div(self.reduce(&factor.into()).num()).unwrap_or(rest)
        })
    }

    /// Replaces every pivot; the result is equal to `value` under the assumptions. Some pivots stay if the search
    /// exceeds its effort.
    pub(super) fn reduce(&self, value: &Ratio) -> Ratio {
        self.substitutions.iter().fold(value.clone(), |value, (pivot, by)| {
            match self.signs.spend(value.num(), by.num()) {
                Some(()) => value.replace(pivot, by),
                None => value,
            }
        })
    }

    /// Returns a quantity of a derivation in original variables.
    pub fn original(&self, value: &Ratio) -> Ratio {
        self.assumptions.iter().rev().fold(value.clone(), |value, assumption| match assumption.usage {
            AssumptionUse::Variable(x) => value.replace(&Monomial::of(x), &assumption.value),
            _ => value,
        })
    }

    /// Returns a quotient of the checker, without those factors of the denominator that divide the numerator.
    pub fn ratio(&self, of: &Quotient, state: &Knowledge) -> Ratio {
        let (mut num, mut den) = (poly(&of.num), Poly::constant(1));
        for (fact, _) in of.den.iter().filter_map(|i| state.facts.get(*i).ok()) {
            let factor = poly(fact);
            match num.checked_div(&factor) {
                Some(quotient) => num = quotient,
                None => den = den * factor,
            }
        }
        Ratio::from(num).checked_div(&den.into()).unwrap_or_else(Ratio::zero)
    }

    /// Returns a polynomial of the checker, reduced.
    pub fn reduced(&self, of: &Polynomial) -> Ratio {
        self.reduce(&poly(of).into())
    }

    /// Returns a quotient of the checker, reduced.
    pub fn reduced_quotient(&self, of: &Quotient, state: &Knowledge) -> Ratio {
        self.reduce(&self.ratio(of, state))
    }

    /// Returns the sign of a reduced quotient if the rules find those of numerator and denominator.
    pub(super) fn direct_sign(&self, value: Ratio) -> Option<SignedRatio> {
        self.sign_under(value, &self.signs)
    }

    /// Returns the sign of a reduced quotient for the given signs of variables.
    fn sign_under(&self, value: Ratio, known: &SignEnv) -> Option<SignedRatio> {
        let [num, den] = [value.num(), value.den()].map(|part| choice::sign(part, known));
        let (num, den) = (num?, den?);
        den.sign().is_strict().then_some(SignedRatio { subtracted: None, num, den })
    }

    /// Returns the sign of a reduced quotient v, directly or by a [retained](AssumptionUse::Retained) quantity h:
    /// v = m h + (v − m h) has the common sign of the two terms.
    pub(super) fn sign(&self, value: Ratio) -> Option<SignedRatio> {
        self.direct_sign(value.clone()).or_else(|| {
            self.assumptions.iter().enumerate().rev().find_map(|(i, assumption)| {
                let AssumptionUse::Retained(sign) = assumption.usage else { return None };
                let h = self.reduce(&assumption.value);
                let mut multipliers = choice::multipliers(&value, &h, &self.signs).into_iter();
                multipliers.find_map(|m| {
                    let (rest, factor) = (self.direct_sign(&value - &m * &h)?, self.direct_sign(m)?);
                    let sum_sign = factor.sign().times(sign).plus(rest.sign());
                    let subtracted = Some(Multiple { factor, of: i, sum_sign }.into());
                    (sum_sign != Sign::ANY).then_some(SignedRatio { subtracted, ..rest })
                })
            })
        })
    }

    /// Adds the assumption that a quantity has a sign, which a fact states.
    pub(super) fn assume(
        &mut self,
        hypothesis: Option<&Hypothesis>,
        value: &Ratio,
        sign: Sign,
        mut fact: AssumedFact,
    ) {
        let mut value = self.reduce(value);
        let usage = match sign {
            Sign::NEGATIVE | Sign::NON_POSITIVE => {
                let fact = AssumedFact { scale: -fact.scale, ..fact };
                return self.assume(hypothesis, &-value, sign.negated(), fact);
            }
            Sign::ZERO => match self.pivot(hypothesis, &value, &Poly::zero(), &self.signs) {
                Some((pivot, by)) => {
                    self.replace(pivot.clone(), by);
                    AssumptionUse::Equation(pivot)
                }
                None => AssumptionUse::Unused,
            },
            Sign::POSITIVE | Sign::NON_NEGATIVE => match self.multiple(hypothesis, &value, sign) {
                Some((factor, x)) => {
                    value = value * &factor;
                    fact.scale = fact.scale * factor;
                    AssumptionUse::Variable(x)
                }
                None => AssumptionUse::Retained(sign),
            },
            _ => AssumptionUse::Unused,
        };
        self.add(hypothesis, value, fact, usage);
    }

    fn add(
        &mut self,
        hypothesis: Option<&Hypothesis>,
        value: Ratio,
        fact: AssumedFact,
        usage: AssumptionUse,
    ) {
        self.assumptions.push(Assumption { hypothesis: hypothesis.cloned(), value, fact: Some(fact), usage });
    }

    /// Returns a positive factor, 1 or the reciprocal of a symbol, and the variable that is its product with a quantity
    /// of known sign: 0 < k < 1 is k = 1/(1 + s) with s = (1 − k)/k > 0.
    fn multiple(
        &mut self,
        hypothesis: Option<&Hypothesis>,
        value: &Ratio,
        sign: Sign,
    ) -> Option<(Ratio, usize)> {
        let mut symbols = value.num().variables();
        symbols.retain(|x| self.signs.get(*x) == Sign::POSITIVE);
        let mut divisors = iter::once(Poly::constant(1)).chain(symbols.into_iter().map(Poly::variable));
        divisors.find_map(|divisor| {
            let factor = Ratio::from(Poly::constant(1)).checked_div(&divisor.into())?;
            self.variable(hypothesis, &(value * &factor), sign).map(|x| (factor, x))
        })
    }

    /// Returns the variable that is a quantity of known sign, if there is one: a new slack variable, by which a pivot is
    /// replaced, unless the quantity is a variable already.
    fn variable(&mut self, hypothesis: Option<&Hypothesis>, value: &Ratio, sign: Sign) -> Option<usize> {
        if let Some(x) = as_variable(value) {
            self.signs.set(x, sign);
            return Some(x);
        }
        let slack = (FIRST_SLACK..UNKNOWN).find(|x| !self.symbols.contains_key(x))?;
        let known = self.signs.with(slack, sign);
        let (pivot, by) = self.pivot(hypothesis, value, &Poly::variable(slack), &known)?;
        self.symbols.extend(self.next_symbol(Symbol::Slack).map(|symbol| (slack, symbol)));
        self.signs = known;
        self.replace(pivot, by);
        Some(slack)
    }

    /// Uses the fact with this number, that a polynomial is 0.
    pub(super) fn equate(&mut self, fact: usize, of: &Polynomial) {
        self.assume(None, &poly(of).into(), Sign::ZERO, AssumedFact::new(fact, Vec::new()));
    }

    /// Retains a multiple of a fact of known sign, for a positive factor.
    pub(super) fn retain(&mut self, fact: usize, (of, sign): &(Polynomial, Sign), factor: Poly) {
        let value = self.reduce(&(poly(of) * &factor).into());
        let fact = AssumedFact { fact, den: Vec::new(), scale: factor.into() };
        self.add(None, value, fact, AssumptionUse::Retained(*sign));
    }

    /// Replaces a reduced quantity x, the value of a formula, by t s, where s is its absolute value and −1 ≤ t ≤ 1,
    /// given the variables of s and t. The fact with the given number is to state x = t s. Returns `false` if x cannot
    /// be replaced.
    pub(super) fn assume_size(&mut self, [size, factor]: [usize; 2], value: &Ratio, fact: usize) -> bool {
        let sizes = self.assumptions.iter().filter(|known| matches!(known.usage, AssumptionUse::Size { .. }));
        if sizes.count() == MAX_SIZES {
            return false;
        }
        let symbols = self.next_symbol(Symbol::Slack).zip(self.next_symbol(Symbol::IntervalParameter));
        let Some(symbols) = symbols else { return false };
        let product = Poly::variable(size) * Poly::variable(factor);
        let Some((pivot, by)) = self.pivot(None, value, &product, &self.signs) else { return false };
        self.replace(pivot.clone(), by);
        self.symbols.extend([(size, symbols.0), (factor, symbols.1)]);
        let fact = AssumedFact::new(fact, Vec::new());
        self.add(None, value.clone(), fact, AssumptionUse::Size { pivot, size, factor });
        true
    }

    /// Returns the next symbol of a kind.
    fn next_symbol(&self, numbered: fn(u8) -> Symbol) -> Option<Symbol> {
        (0..=u8::MAX).map(numbered).find(|symbol| self.symbols.values().all(|used| used != symbol))
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
        hypothesis: Option<&Hypothesis>,
        value: &Ratio,
        replaced_by: &Poly,
        known: &SignEnv,
    ) -> Option<(Monomial, Ratio)> {
        // num − replaced_by · den = 0, and den is not 0.
        let equation = value.num() - replaced_by * value.den();
        let pivot = PivotChoice { context: self, hypothesis, value, equation: &equation, known }.pivot()?;
        let by = solve_for(&pivot, &equation, known)?;
        Some((pivot, by))
    }
}

/// The choice of the monomial for which to solve the equation that `value` equals its slack variable, or 0.
struct PivotChoice<'a> {
    context: &'a Context,
    hypothesis: Option<&'a Hypothesis>,
    value: &'a Ratio,
    equation: &'a Poly,
    /// The known signs, with that of the slack variable.
    known: &'a SignEnv,
}

impl PivotChoice<'_> {
    /// Returns the monomial.
    ///
    /// The choice prefers a symbol of unknown sign whose coefficient is not 0, so that the symbol is eliminated;
    /// otherwise a symbol whose sign still follows after the substitution, as that of b does from b = a + s for
    /// b − a > 0; otherwise a product with few symbols of known sign, so that little information is lost.
    ///
    /// If the equation contains rounding errors, the symbol for which the hypothesis is to be solved comes first.
    fn pivot(&self) -> Option<Monomial> {
        let variables = self.value.num().variables();
        self.free_symbol(&variables).or_else(|| self.signed_symbol(&variables)).or_else(|| self.product())
    }

    /// Returns the first symbol of unknown sign.
    fn free_symbol(&self, variables: &[usize]) -> Option<Monomial> {
        let solved_for = self.hypothesis.map(|hypothesis| Symbol::Own(hypothesis.solved_for));
        let has_errors = variables.iter().any(|x| self.known.is_unit(*x));
        let signs = &self.context.signs;
        let free = variables.iter().filter(|x| signs.get(**x) == Sign::ANY && !self.known.is_unit(**x));
        let solvable = free.filter(|x| solve_for(&Monomial::of(**x), self.equation, self.known).is_some());
        let first = solvable.min_by_key(|x| has_errors && self.context.symbol(**x) != solved_for);
        first.map(|x| Monomial::of(*x))
    }

    /// Returns the product with the fewest symbols of known sign.
    fn product(&self) -> Option<Monomial> {
        let signed =
            |m: &Monomial| m.powers().filter(|(x, _)| self.context.signs.get(*x) != Sign::ANY).count();
        let monomials = self.value.num().terms().map(|(m, _)| m);
        let products =
            monomials.filter(|m| m.powers().count() > 1 && !m.powers().any(|(x, _)| self.known.is_unit(x)));
        let first = products.min_by_key(|m| signed(m));
        first.filter(|m| solve_for(m, self.equation, self.known).is_some()).cloned()
    }

    /// Returns the first symbol whose sign follows from that of its value.
    fn signed_symbol(&self, variables: &[usize]) -> Option<Monomial> {
        variables.iter().find_map(|x| {
            let pivot = Monomial::of(*x);
            let by = self.context.reduce(&solve_for(&pivot, self.equation, self.known)?);
            let sign = self.context.sign_under(by, self.known)?.sign();
            let known = self.context.signs.get(*x);
            (known != Sign::ANY && sign.implies(known)).then_some(pivot)
        })
    }
}

/// Solves the equation `of` = 0 for a monomial: for a symbol whose coefficient is not 0, or for a product.
fn solve_for(pivot: &Monomial, of: &Poly, known: &SignEnv) -> Option<Ratio> {
    let (coefficient, by) = solved(pivot, of)?;
    choice::sign(&coefficient, known).filter(|certificate| certificate.sign().is_strict())?;
    (!by.contains(pivot)).then_some(by)
}

/// Returns the coefficient of a symbol, or of a product that occurs in one term only, and its value where `of` = 0.
pub(super) fn solved(pivot: &Monomial, of: &Poly) -> Option<(Poly, Ratio)> {
    let [rest, coefficient] = match pivot.as_variable() {
        Some(x) => of.coefficients(x)?,
        None => {
            let (_, q) = of.terms().find(|(m, _)| *m == pivot)?;
            [of - Poly::from_iter([(pivot.clone(), q.clone())]), Poly::constant(q.clone())]
        }
    };
    let by = Ratio::from(-rest).checked_div(&coefficient.clone().into())?;
    Some((coefficient, by))
}

/// Returns the variable if a quantity is a single variable.
fn as_variable(value: &Ratio) -> Option<usize> {
    let x = value.num().variables().into_iter().next()?;
    (*value == Ratio::from(Poly::variable(x))).then_some(x)
}
