//! The assumptions of a proof and the substitutions that follow from them.

use super::algebra::{FIRST_SLACK, Monomial, Poly, Ratio, UNKNOWN};
use super::assumption::{Assumption, AssumptionUse, Multiple, SignedRatio};
use super::choice;
use super::rules::{SignEnv, determined};
use super::symbol::Symbol;
use crate::formula::Hypothesis;
use crate::formula::claim::{PRECISION, SCALES};
use crate::number::{Exponential, Tree};
use crate::proof::check::{Atom, Problem, Sign};
use std::collections::BTreeMap;

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
    /// Quantities of known sign that are not expressed by the remaining variables.
    pub(super) retained: Vec<(Ratio, Sign)>,
    /// 2ᵖ + 1 before any assumption, unless there are no roundings.
    pub(super) largest: Poly,
}

impl Context {
    /// Creates a context with the intervals of the problem, in which powers of two are positive.
    pub(in crate::proof) fn new(problem: &Problem) -> Self {
        let (assumptions, symbols, exponentials, roundings, substitutions, retained) = Default::default();
        let units = (0..FIRST_SLACK).filter(|x| problem.table.is_unit(*x));
        let (signs, largest) = (SignEnv::new(units, problem.effort.clone()), Poly::constant(1));
        let mut context = Context {
            assumptions,
            signs,
            symbols,
            exponentials,
            roundings,
            substitutions,
            retained,
            largest,
        };
        for (x, atom) in problem.table.atoms().iter().enumerate() {
            let symbol = match atom {
                Atom::Own(name) => Some(Symbol::Own(name)),
                Atom::Error(of) => {
                    context.roundings.extend(problem.table.formula(*of).cloned());
                    context.next_symbol(Symbol::Error)
                }
                Atom::IntervalParameter(i) => {
                    context.assumptions.push(Assumption {
                        hypothesis: Some(problem.hypotheses[*i].clone()),
                        value: Poly::variable(x).into(),
                        divisor: None,
                        usage: AssumptionUse::Interval(x),
                    });
                    context.next_symbol(Symbol::IntervalParameter)
                }
                Atom::Exponential(of) => {
                    context.signs.set(x, Some(Sign::Positive));
                    let exponential = problem.table.formula(*of).map(Tree::exp);
                    context.exponentials.extend(exponential.map(|tree| (x, tree)));
                    None
                }
                Atom::Size(_) | Atom::Factor(_) => None,
            };
            if symbol == Some(Symbol::Own(PRECISION)) {
                context.largest = Poly::variable(x) + Poly::constant(1);
            }
            if SCALES.iter().any(|name| symbol == Some(Symbol::Own(name))) {
                context.signs.set(x, Some(Sign::Positive));
            }
            context.symbols.extend(symbol.map(|symbol| (x, symbol)));
        }
        context
    }

    /// Returns a variable as it is named in messages.
    pub(in crate::proof) fn symbol(&self, x: usize) -> Option<Symbol> {
        self.symbols.get(&x).copied()
    }

    /// Returns the rounding errors in a polynomial.
    pub(super) fn errors(&self, of: &Poly) -> Vec<usize> {
        let variables = of.variables().into_iter();
        variables.filter(|x| matches!(self.symbol(*x), Some(Symbol::Error(_)))).collect()
    }

    /// Returns a polynomial with the sign of a quotient whose denominator is positive: the numerator without
    /// its factors 2ᵖ + 1 + e, which are positive.
    pub(super) fn sign_numerator(&self, value: &Ratio) -> Poly {
        let largest = self.inverse_gamma();
        self.errors(value.num()).into_iter().fold(value.num().clone(), |rest, error| {
            let nearest = &largest + Ratio::from(Poly::variable(error));
            rest.checked_div(nearest.num()).filter(|_| *nearest.den() == *largest.den()).unwrap_or(rest)
        })
    }

    /// Returns 2ᵖ + 1, the reciprocal of the largest relative rounding error.
    pub(super) fn inverse_gamma(&self) -> Ratio {
        self.reduce(&self.largest.clone().into())
    }

    /// Replaces every pivot, repeatedly; the result is equal to `value` under the assumptions. Some pivots stay if the
    /// search exceeds its effort.
    pub(super) fn reduce(&self, value: &Ratio) -> Ratio {
        let mut value = value.clone();
        // Substitutions could reintroduce each other's pivots indefinitely; some are then left in the value.
        for _ in &self.substitutions {
            let mut is_reduced = true;
            for (pivot, by) in &self.substitutions {
                if value.contains(pivot) && self.signs.spend(value.num(), by.num()).is_some() {
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
    pub(super) fn sign(&self, value: Ratio) -> Option<SignedRatio> {
        self.sign_under(value, &self.signs)
    }

    /// Returns the sign of a reduced quotient for the given signs of variables.
    pub(super) fn sign_under(&self, value: Ratio, known: &SignEnv) -> Option<SignedRatio> {
        let [num, den] = [value.num(), value.den()].map(|part| choice::sign(part, known));
        let (num, den) = (num?, den?);
        den.sign().is_strict().then_some(SignedRatio { subtracted: None, num, den })
    }

    /// Returns the sign of a reduced quotient v, directly or by a [retained](Self::retained) quantity h:
    /// v = m h + (v − m h) has the common sign of the two terms.
    pub(super) fn sign_by_retained(&self, value: Ratio) -> Option<SignedRatio> {
        self.sign(value.clone()).or_else(|| {
            self.retained.iter().rev().find_map(|(h, sign)| {
                let h = self.reduce(h);
                let mut multipliers = choice::multipliers(&value, &h, &self.signs).into_iter();
                multipliers.find_map(|m| self.sign_by_multiple(&value, (&h, *sign), m))
            })
        })
    }

    /// Returns the sign of v by those of m h and of v − m h.
    fn sign_by_multiple(&self, value: &Ratio, (h, sign): (&Ratio, Sign), m: Ratio) -> Option<SignedRatio> {
        let (rest, factor) = (self.sign(value - &m * h)?, self.sign(m)?);
        let sum_sign = determined(factor.sign().times(sign).plus(rest.sign()))?;
        let subtracted = Some(Multiple { factor, of: h.clone(), sum_sign }.into());
        Some(SignedRatio { subtracted, ..rest })
    }

    /// Adds the assumption that a quantity has a sign.
    pub(super) fn assume_sign(&mut self, hypothesis: Option<&Hypothesis>, value: Ratio, sign: Sign) {
        let value = self.reduce(&value);
        let mut divided_by = None;
        let used = match sign {
            _ if self.sign(value.clone()).is_some_and(|signed| signed.sign().implies(sign)) => {
                AssumptionUse::Implied
            }
            Sign::Negative | Sign::NonPositive => {
                return self.assume_sign(hypothesis, -value, sign.negated());
            }
            Sign::Positive | Sign::NonNegative => {
                if let Some(x) = as_variable(&value) {
                    self.signs.set(x, Some(sign));
                    AssumptionUse::Variable(x)
                } else if let Some((divisor, (pivot, by), slack)) = self.solve(hypothesis, &value, sign) {
                    divided_by = divisor;
                    self.symbols.extend(self.next_symbol(Symbol::Slack).map(|symbol| (slack, symbol)));
                    self.signs.set(slack, Some(sign));
                    AssumptionUse::Pivot(pivot, by, Some(slack))
                } else {
                    return self.retain(hypothesis, value, sign);
                }
            }
            Sign::Any => AssumptionUse::Unused,
            Sign::Zero => self
                .pivot(hypothesis, &value, &Poly::zero(), &self.signs)
                .map_or(AssumptionUse::Unused, |(pivot, by)| AssumptionUse::Pivot(pivot, by, None)),
        };
        if let AssumptionUse::Pivot(pivot, by, _) = &used {
            self.replace(pivot.clone(), by.clone());
        }
        let hypothesis = hypothesis.cloned();
        self.assumptions.push(Assumption { hypothesis, value, divisor: divided_by, usage: used });
    }

    /// Retains a quantity of known sign.
    pub(super) fn retain(&mut self, hypothesis: Option<&Hypothesis>, value: Ratio, sign: Sign) {
        self.retained.push((value.clone(), sign));
        let (hypothesis, usage) = (hypothesis.cloned(), AssumptionUse::Retained);
        self.assumptions.push(Assumption { hypothesis, value, divisor: None, usage });
    }

    /// Finds a pivot of a quantity, otherwise of its quotient by a positive symbol: 0 < k < 1 is
    /// k = 1/(1 + s) with s = (1 − k)/k > 0.
    fn solve(&self, hypothesis: Option<&Hypothesis>, value: &Ratio, sign: Sign) -> Option<Solved> {
        let slack = self.next_slack()?;
        let known = self.signs.with(slack, sign);
        let by = Poly::variable(slack);
        if let Some(rule) = self.pivot(hypothesis, value, &by, &known) {
            return Some((None, rule, slack));
        }
        value.num().variables().into_iter().find_map(|x| {
            let is_positive = self.signs.get(x) == Some(Sign::Positive);
            let divisor = is_positive.then(|| Ratio::from(Poly::variable(x)))?;
            let rule = self.pivot(hypothesis, &value.checked_div(&divisor)?, &by, &known)?;
            Some((Some(divisor), rule, slack))
        })
    }

    /// Replaces a quantity x by t s, where s is its absolute value and −1 ≤ t ≤ 1, given the variables of s and
    /// t, and 2 x. Returns `false` if x cannot be replaced.
    pub(super) fn assume_size(&mut self, [size, factor]: [usize; 2], twice: &Ratio) -> bool {
        let sizes = self.assumptions.iter().filter(|known| matches!(known.usage, AssumptionUse::Size { .. }));
        if sizes.count() == MAX_SIZES {
            return false;
        }
        let symbols = self.next_symbol(Symbol::Slack).zip(self.next_symbol(Symbol::IntervalParameter));
        let Some(symbols) = symbols else { return false };
        let value = self.reduce(&(twice * Ratio::from(Poly::constant((1, 2)))));
        let known = self.signs.with(size, Sign::NonNegative);
        let product = Poly::variable(size) * Poly::variable(factor);
        let Some((pivot, by)) = self.pivot(None, &value, &product, &known) else { return false };
        self.signs = known;
        self.replace(pivot.clone(), by);
        self.symbols.extend([(size, symbols.0), (factor, symbols.1)]);
        let usage = AssumptionUse::Size { pivot, size, factor };
        let (hypothesis, divisor) = (None, None);
        self.assumptions.push(Assumption { hypothesis, value: value.clone(), divisor, usage });
        self.size(&value).is_some()
    }

    /// Returns the variable that is the absolute value of a quantity, if there is one.
    pub(super) fn size(&self, value: &Ratio) -> Option<usize> {
        self.assumptions.iter().find_map(|assumption| {
            let AssumptionUse::Size { size, .. } = &assumption.usage else { return None };
            let [difference, sum] = [&assumption.value - value, &assumption.value + value];
            let is_same = self.reduce(&difference).is_zero() || self.reduce(&sum).is_zero();
            is_same.then_some(*size)
        })
    }

    fn next_slack(&self) -> Option<usize> {
        (FIRST_SLACK..UNKNOWN).find(|x| !self.symbols.contains_key(x))
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
    /// otherwise a product with few symbols of known sign, so that little information is lost; otherwise a
    /// symbol whose sign still follows after the substitution, as that of b does from b = a + s for b − a > 0.
    ///
    /// If the equation contains rounding errors, the symbol for which the hypothesis is to be solved comes
    /// first, and products come last, because long expressions would replace them.
    fn pivot(&self) -> Option<Monomial> {
        let variables = self.value.num().variables();
        let has_errors = variables.iter().any(|x| self.known.is_unit(*x));
        self.free_symbol(&variables, has_errors).or_else(|| match has_errors {
            true => self.signed_symbol(&variables).or_else(|| self.product(|_, _| true)),
            false => self
                .product(|signed, all| signed < all)
                .or_else(|| self.signed_symbol(&variables))
                .or_else(|| self.product(|_, _| true)),
        })
    }

    /// Returns the symbol of unknown sign with the shortest coefficient.
    fn free_symbol(&self, variables: &[usize], has_errors: bool) -> Option<Monomial> {
        let solved_for = self.hypothesis.map(|hypothesis| Symbol::Own(hypothesis.solved_for));
        let signs = &self.context.signs;
        let free = variables.iter().filter(|x| signs.get(**x).is_none() && !self.known.is_unit(**x));
        let solvable = free.filter(|x| solve_for(&Monomial::of(**x), self.equation, self.known).is_some());
        let first = solvable.min_by_key(|x| {
            let comes_later = has_errors && (solved_for.is_none() || self.context.symbol(**x) != solved_for);
            (comes_later, self.equation.coefficient(**x, 1).terms().len())
        });
        first.map(|x| Monomial::of(*x))
    }

    /// Returns the product with the fewest symbols of known sign, by the numbers of these and of all its symbols.
    fn product(&self, is_chosen: fn(usize, usize) -> bool) -> Option<Monomial> {
        let signed = |m: &Monomial| m.powers().filter(|(x, _)| self.context.signs.get(*x).is_some()).count();
        let monomials = self.value.num().terms().map(|(m, _)| m);
        let products = monomials.filter(|m| m.count() > 1 && !m.powers().any(|(x, _)| self.known.is_unit(x)));
        let first = products.filter(|m| is_chosen(signed(m), m.count())).min_by_key(|m| signed(m));
        first.filter(|m| solve_for(m, self.equation, self.known).is_some()).cloned()
    }

    /// Returns the first symbol whose sign follows from that of its value.
    fn signed_symbol(&self, variables: &[usize]) -> Option<Monomial> {
        variables.iter().find_map(|x| {
            let pivot = Monomial::of(*x);
            let by = self.context.reduce(&solve_for(&pivot, self.equation, self.known)?);
            let sign = self.context.sign_under(by, self.known)?.sign();
            sign.implies(self.context.signs.get(*x)?).then_some(pivot)
        })
    }
}

/// Solves the equation `of` = 0 for a monomial: for a symbol whose coefficient is not 0, or for a product
/// that occurs in one term only.
pub(in crate::proof) fn solve_for(pivot: &Monomial, of: &Poly, known: &SignEnv) -> Option<Ratio> {
    let by = if let Some(x) = pivot.as_variable() {
        let [rest, coefficient] = of.coefficients(x)?;
        choice::sign(&coefficient, known).filter(|certificate| certificate.sign().is_strict())?;
        Ratio::from(-rest).checked_div(&coefficient.into())?
    } else {
        let (_, coefficient) = of.terms().find(|(m, _)| *m == pivot)?;
        let rest = of - Poly::from_iter([(pivot.clone(), coefficient.clone())]);
        (-rest * Poly::constant(coefficient.recip_ref())).into()
    };
    (!by.contains(pivot)).then_some(by)
}

/// The divisor, if any; the pivot and its value; the slack variable.
type Solved = (Option<Ratio>, (Monomial, Ratio), usize);

/// Returns the variable if a quantity is a single variable.
fn as_variable(value: &Ratio) -> Option<usize> {
    let x = value.num().variables().into_iter().next()?;
    (*value == Ratio::from(Poly::variable(x))).then_some(x)
}
