//! The knowledge at a leaf of a proof, and the translation of formulas into quotients of polynomials.

use super::polynomial::Polynomial;
use super::quotient::{Facts, Quotient};
use super::sign::Sign;
use super::table::{Atom, Problem};
use super::{AbsoluteValue, Checked, Question, Reason, Refusal, Same, Source};
use crate::formula::claim::{PRECISION, SCALES};
use crate::number::Tree;
use crate::number::tree::Op;
use rustc_hash::FxHashMap;

/// The number of the fact 2 > 0, which every state contains.
const TWO: usize = 0;

/// The knowledge at a leaf of a proof.
#[derive(Clone, Debug)]
pub struct State<'p> {
    /// The proposition to be proved, with its hypotheses.
    pub problem: &'p Problem<'p>,
    /// The quantities of known sign.
    pub facts: Facts,
    /// The known signs of variables.
    pub signs: Vec<Option<Sign>>,
    /// The hypotheses, or cases, that are facts, with the numbers of these.
    pub assumed: Vec<(Option<usize>, usize)>,
    /// The rounded formulas met so far.
    pub rounded: Vec<Rounded>,
    /// The formulas whose absolute values are atoms.
    pub sizes: Vec<Size>,
    /// The exponentials met so far, with their exponents.
    pub exponents: Vec<(usize, Quotient)>,
    /// The values of symbols in intervals.
    symbols: FxHashMap<&'static str, Quotient>,
    /// The values of formulas.
    values: FxHashMap<usize, Quotient>,
}

/// A rounded formula.
#[derive(Clone, Debug)]
pub struct Rounded {
    /// The number of the formula before it is rounded.
    pub of: usize,
    /// Its value.
    pub value: Quotient,
    /// The variable of its error.
    pub error: usize,
}

/// A formula whose absolute value is an atom.
#[derive(Clone, Debug)]
pub struct Size {
    /// Its value.
    pub value: Quotient,
    /// The variable of its absolute value.
    pub size: usize,
    /// The number of the fact that it is a multiple of this.
    pub fact: usize,
}

/// A translator of formulas, which asks a source for everything that a proof states.
pub struct Translator<'p, S> {
    /// The knowledge at the leaf.
    pub state: State<'p>,
    /// The proof, or a search for one.
    pub source: S,
}

impl<'p> State<'p> {
    /// Returns the state before any hypothesis is used: powers of two and exponentials are positive.
    pub fn new(problem: &'p Problem) -> Self {
        let signs = problem.table.atoms().iter().map(|atom| match atom {
            Atom::Own(name) if SCALES.contains(name) => Some(Sign::Positive),
            Atom::Exponential(_) => Some(Sign::Positive),
            Atom::Size(_) => Some(Sign::NonNegative),
            _ => None,
        });
        let mut facts = Facts::new(problem.effort.clone());
        facts.add(Polynomial::constant(2), Sign::Positive);
        let (assumed, rounded, sizes, exponents, symbols, values) = Default::default();
        State { problem, facts, signs: signs.collect(), assumed, rounded, sizes, exponents, symbols, values }
    }

    /// Adds a fact and returns its number.
    pub fn add_fact(&mut self, of: Polynomial, sign: Sign) -> usize {
        if let Some(known) = of.as_variable().and_then(|x| self.signs.get_mut(x))
            && !known.is_some_and(|known| known.implies(sign))
        {
            *known = Some(sign);
        }
        self.facts.add(of, sign)
    }

    /// Adds the fact that follows from the sign of a quotient, and returns its number.
    pub fn add_quotient(&mut self, of: Quotient, sign: Sign) -> Checked<usize> {
        let sign = self.facts.sign_of_product(&of.den)?.times(sign);
        Ok(self.add_fact(of.num, sign))
    }

    /// Returns the variable of an atom as a polynomial.
    pub fn variable(&self, atom: Atom) -> Checked<Polynomial> {
        Polynomial::variable(self.problem.table.variable(atom)?)
    }

    /// Returns the value of a formula that was met.
    pub fn value(&self, formula: usize) -> Option<&Quotient> {
        self.values.get(&formula)
    }

    /// Returns the exponent of an exponential that was met.
    pub fn exponent(&self, x: usize) -> Option<&Quotient> {
        self.exponents.iter().find(|(y, _)| *y == x).map(|(_, exponent)| exponent)
    }
}

impl<'p, S: Source> Translator<'p, S> {
    /// Returns a translator that knows no hypothesis.
    pub fn new(problem: &'p Problem, source: S) -> Self {
        Translator { state: State::new(problem), source }
    }

    /// Returns the sign of a polynomial, and the number of the fact.
    fn sign(&mut self, question: Question) -> Checked<(Sign, usize)> {
        let of = question.of;
        match self.source.sign(question, &self.state).ok_or(Refusal::Missing)? {
            Reason::Fact(i) => {
                let (known, sign) = self.state.facts.get(i)?;
                if known == of { Ok((*sign, i)) } else { Err(Refusal::Identity) }
            }
            Reason::Certificate(certificate) => {
                let sign = self.state.certify(of, &certificate)?;
                Ok((sign, self.state.add_fact(of.clone(), sign)))
            }
        }
    }

    /// Returns the sign of a polynomial, and the number of the fact.
    pub fn sign_of_part(&mut self, of: &Polynomial) -> Checked<(Sign, usize)> {
        self.sign(Question { of, den: &[], is_sum: false, decides: false })
    }

    /// Returns the sign of a sum of multiples of formulas.
    pub fn sign_of_sum(&mut self, sum: &[(i128, usize)], decides: bool) -> Checked<Sign> {
        let mut value = Quotient::from(Polynomial::zero());
        for (n, of) in sum {
            let of = self.value(*of)?;
            value = self.state.facts.sum(&value, *n, &of)?;
        }
        let (sign, _) = self.sign(Question { of: &value.num, den: &value.den, is_sum: true, decides })?;
        Ok(self.state.facts.sign_of_product(&value.den)?.times(sign))
    }

    /// Checks that a polynomial is not 0, and returns the number of the fact.
    pub fn strict(&mut self, of: &Polynomial) -> Checked<usize> {
        let (sign, i) = self.sign_of_part(of)?;
        if sign.is_strict() { Ok(i) } else { Err(Refusal::NotStrict) }
    }

    /// Returns the value of a formula, after a check that no divisor in it is 0.
    pub fn translate(&mut self, tree: &Tree) -> Checked<Quotient> {
        self.value(self.state.problem.table.find(tree)?)
    }

    /// Returns the value of the formula with a number.
    pub fn value(&mut self, formula: usize) -> Checked<Quotient> {
        if let Some(value) = self.state.values.get(&formula) {
            return Ok(value.clone());
        }
        let value = self.value_of_op(self.state.problem.table.op(formula)?)?;
        self.state.values.insert(formula, value.clone());
        Ok(value)
    }

    fn value_of_op(&mut self, op: Op<usize>) -> Checked<Quotient> {
        use Op::*;
        Ok(match op {
            Symbol(name) => match self.state.symbols.get(name) {
                Some(value) => value.clone(),
                None => self.state.variable(Atom::Own(name))?.into(),
            },
            Int(n) => Polynomial::constant(n.into()).into(),
            Neg(a) => {
                let a = self.value(a)?;
                self.state.facts.sum(&Polynomial::zero().into(), -1, &a)?
            }
            Add(a, b) => self.sum(a, 1, b)?,
            Sub(a, b) => self.sum(a, -1, b)?,
            Mul(a, b) => self.value(a)?.times(&self.value(b)?, &self.state.facts.effort)?,
            Div(a, b) => {
                let (a, inverse) = (self.value(a)?, self.inverse(b)?);
                a.times(&inverse, &self.state.facts.effort)?
            }
            Exp(a) => self.exponential(a)?,
            PositivePart(a) => {
                let is_open = self.sign_of_sum(&[(1, a)], true)?.implies(Sign::NonNegative);
                if is_open { self.value(a)? } else { Polynomial::zero().into() }
            }
            Min(a, b) if self.state.problem.table.op(a)? == Neg(b) => self.opposite_size(a, b)?,
            Min(a, b) => self.minimum(a, b)?,
            Rounded(a) => self.rounded(a)?,
        })
    }

    fn sum(&mut self, a: usize, n: i128, b: usize) -> Checked<Quotient> {
        let (a, b) = (self.value(a)?, self.value(b)?);
        self.state.facts.sum(&a, n, &b)
    }

    fn minimum(&mut self, a: usize, b: usize) -> Checked<Quotient> {
        let (first, second) = (self.value(a)?, self.value(b)?);
        let is_first = self.sign_of_sum(&[(1, b), (-1, a)], true)?.implies(Sign::NonNegative);
        Ok(if is_first { first } else { second })
    }

    /// Returns min(−x, x), which is −|x|.
    fn opposite_size(&mut self, negated: usize, x: usize) -> Checked<Quotient> {
        let value = self.value(x)?;
        let size = match self.source.size(x, &value, &self.state).ok_or(Refusal::Missing)? {
            AbsoluteValue::BySign => return self.minimum(negated, x),
            AbsoluteValue::Atom => self.size_atom(x, value)?,
            AbsoluteValue::Same(i) => {
                let (known, facts) = (self.state.sizes.get(i).ok_or(Refusal::Unknown)?, &self.state.facts);
                let sum = facts.sum(&value, 1, &known.value)?;
                if !facts.are_equal(&value, &known.value)? && !sum.num.is_zero() {
                    return Err(Refusal::Size);
                }
                known.size
            }
        };
        Ok(Polynomial::variable(size)?.negated()?.into())
    }

    /// Returns the variable of the absolute value of a formula x, and adds the fact x = t |x|.
    fn size_atom(&mut self, x: usize, value: Quotient) -> Checked<usize> {
        let size = self.state.problem.table.variable(Atom::Size(x))?;
        let effort = &self.state.facts.effort;
        let product = Polynomial::variable(size)?.times(&self.state.variable(Atom::Factor(x))?, effort)?;
        let product = product.times(&self.state.facts.product(&value.den)?, effort)?;
        let fact = self.state.add_fact(value.num.plus_multiple(-1, &product, effort)?, Sign::Zero);
        self.state.sizes.push(Size { value, size, fact });
        Ok(size)
    }

    /// Returns the reciprocal of a divisor, after a check of the signs of its factors.
    fn inverse(&mut self, divisor: usize) -> Checked<Quotient> {
        let of = self.value(divisor)?;
        let factors = self.source.divisor(divisor, &of.num, &self.state).ok_or(Refusal::Missing)?;
        let mut den = Vec::with_capacity(factors.len());
        for factor in &factors {
            den.push(self.strict(factor)?);
        }
        if self.state.facts.product(&den)? != of.num {
            return Err(Refusal::Divisor);
        }
        Ok(Quotient::new(self.state.facts.product(&of.den)?, den))
    }

    /// Returns an exponential. Equal exponents have the same one.
    fn exponential(&mut self, exponent: usize) -> Checked<Quotient> {
        let value = self.value(exponent)?;
        if value.num.is_zero() {
            return Ok(Polynomial::constant(1).into());
        }
        for (x, known) in &self.state.exponents {
            if self.state.facts.are_equal(known, &value)? {
                return Ok(Polynomial::variable(*x)?.into());
            }
        }
        let table = &self.state.problem.table;
        let x = table.variable(Atom::Exponential(exponent))?;
        let reciprocal = table.variable(Atom::Exponential(table.number(&Op::Neg(exponent))?))?;
        let opposite = self.state.facts.sum(&Polynomial::zero().into(), -1, &value)?;
        self.state.exponents.extend([(x, value), (reciprocal, opposite)]);
        Ok(Polynomial::variable(x)?.into())
    }

    /// Returns fl(a) = a (2ᵖ + 1 + e)/(2ᵖ + 1).
    fn rounded(&mut self, of: usize) -> Checked<Quotient> {
        let value = self.value(of)?;
        let error = self.error(of, &value)?;
        let effort = &self.state.facts.effort.clone();
        let precision = self.state.variable(Atom::Own(PRECISION))?;
        let largest = precision.plus_multiple(1, &Polynomial::constant(1), effort)?;
        let factor = largest.plus_multiple(1, &Polynomial::variable(error)?, effort)?;
        let den = vec![self.strict(&largest)?];
        value.times(&Quotient { num: factor, den }, effort)
    }

    /// Returns the variable of the error of a rounded formula. Values that differ by a power of two have the
    /// same relative error.
    fn error(&mut self, of: usize, value: &Quotient) -> Checked<usize> {
        if let Some(known) = self.state.rounded.iter().find(|known| known.of == of) {
            return Ok(known.error);
        }
        let error = match self.source.rounding(of, value, &self.state).ok_or(Refusal::Missing)? {
            None => self.state.problem.table.variable(Atom::Error(of))?,
            Some(same) => self.shared_error(value, &same)?,
        };
        self.state.rounded.push(Rounded { of, value: value.clone(), error });
        Ok(error)
    }

    fn shared_error(&self, value: &Quotient, same: &Same) -> Checked<usize> {
        let known = self.state.rounded.get(same.rounding).ok_or(Refusal::Unknown)?;
        let scaled = |of: &Quotient, by| {
            Ok(Quotient { num: of.num.times(by, &self.state.facts.effort)?, ..of.clone() })
        };
        let is_equal =
            self.state.facts.are_equal(&scaled(value, &same.down)?, &scaled(&known.value, &same.up)?)?;
        let is_power = [&same.up, &same.down].into_iter().all(|of| self.is_power_of_two(of));
        if is_equal && is_power { Ok(known.error) } else { Err(Refusal::Rounding) }
    }

    /// Returns `true` if a polynomial is a product of symbols of powers of two.
    fn is_power_of_two(&self, of: &Polynomial) -> bool {
        let atoms = self.state.problem.table.atoms();
        let is_scale = |x: usize| matches!(atoms.get(x), Some(Atom::Own(name)) if SCALES.contains(name));
        of.has_only(is_scale) && of.terms().len() == 1 && of.terms().all(|(_, number)| *number == 1)
    }

    /// Uses the hypothesis with a number.
    pub fn assume(&mut self, i: usize) -> Checked<()> {
        let problem = self.state.problem;
        let hypothesis = *problem.hypotheses.get(i).ok_or(Refusal::Unknown)?;
        if let Some(by) = problem.variable().filter(|_| problem.mentions_variable(i)) {
            self.holds_later(i, by)?;
        }
        if let Some((x, lower, upper)) = hypothesis.interval() {
            let (lower, upper) = (self.translate(lower)?, self.translate(upper)?);
            let (sum, length) =
                (self.state.facts.sum(&upper, 1, &lower)?, self.state.facts.sum(&upper, -1, &lower)?);
            let half = Quotient { num: Polynomial::constant(1), den: vec![TWO] };
            let t = self.state.variable(Atom::IntervalParameter(i))?.into();
            let effort = &self.state.facts.effort;
            let distance = length.times(&half, effort)?.times(&t, effort)?;
            let value = self.state.facts.sum(&sum.times(&half, effort)?, 1, &distance)?;
            self.state.symbols.entry(x).or_insert(value);
            self.state.values.clear();
        } else {
            let value = self.value(problem.values[i])?;
            let fact = self.state.add_quotient(value, hypothesis.relation.into())?;
            self.state.assumed.push((Some(i), fact));
        }
        Ok(())
    }

    /// Adds the fact fl(a) ≥ fl(b), which follows from a ≥ b; `errors` are the variables of the errors of a and b.
    pub fn monotone(&mut self, errors: [usize; 2]) -> Checked<()> {
        let [a, b] = errors.map(|x| match self.state.problem.table.atoms().get(x) {
            Some(Atom::Error(of)) => Ok(*of),
            _ => Err(Refusal::Unknown),
        });
        let (a, b) = (a?, b?);
        if !self.sign_of_sum(&[(1, a), (-1, b)], false)?.implies(Sign::NonNegative) {
            return Err(Refusal::Order);
        }
        let [a, b] = [a, b].map(|of| self.state.problem.table.number(&Op::Rounded(of)));
        let rounded = self.sum(a?, -1, b?)?;
        self.state.add_quotient(rounded, Sign::NonNegative)?;
        Ok(())
    }
}
