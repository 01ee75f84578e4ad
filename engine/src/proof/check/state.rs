//! The knowledge at a leaf of a proof, its steps, and the translation of formulas into quotients of polynomials.

use super::polynomial::Polynomial;
use super::quotient::{Facts, Quotient};
use super::sign::Sign;
use super::table::{Atom, Sequent};
use super::{Checked, Law, Refusal, Step};
use crate::formula::Relation;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::number::tree::Op;
use rustc_hash::FxHashMap;

/// The number of the fact 2 > 0, which is always known.
const TWO: usize = 0;

/// The knowledge at a leaf of a proof.
#[derive(Clone, Debug)]
pub struct Knowledge<'p> {
    /// The proposition to be proved, with its hypotheses.
    pub sequent: &'p Sequent<'p>,
    /// The quantities of known sign.
    pub facts: Facts,
    /// The known signs of variables.
    pub signs: Vec<Sign>,
    /// The hypotheses that were assumed.
    pub assumed: Vec<usize>,
    /// The products of facts that are divisors, with their factors.
    divisors: Vec<(Polynomial, Vec<usize>)>,
    /// The values of symbols in intervals.
    symbols: FxHashMap<&'static str, Quotient>,
    /// The values of formulas.
    pub values: FxHashMap<usize, Quotient>,
}

impl<'p> Knowledge<'p> {
    /// Returns the knowledge at the beginning of a leaf under the assumptions of cases. Powers of two and exponentials are
    /// positive. In a limit, the assumptions must not depend on its variable.
    pub fn new(sequent: &'p Sequent, cases: &[(Polynomial, Sign)]) -> Checked<Self> {
        let signs = (0..sequent.table.atoms.len()).map(|x| sequent.table.sign(x));
        let facts = Facts { all: Vec::new(), effort: sequent.effort.clone() };
        let (assumed, divisors, symbols, values) = Default::default();
        let signs = signs.collect();
        let mut state = Knowledge { sequent, facts, signs, assumed, divisors, symbols, values };
        state.add_fact(Polynomial::constant(2), Sign::POSITIVE)?;
        for (case, sign) in cases {
            state.add_fact(case.clone(), *sign)?;
            if !case.has_only(|x| !sequent.varies(x)) {
                return Err(Refusal::Limit);
            }
        }
        Ok(state)
    }

    /// Applies a step.
    pub fn apply(&mut self, step: &Step) -> Checked<()> {
        match step {
            Step::Assume(i) => self.assume(*i),
            Step::Show(of, certificate) => self.add_fact(of.clone(), self.certify(of, certificate)?),
            Step::Square(of) => self.add_fact(of.times(of, &self.facts.effort)?, Sign::NON_NEGATIVE),
            Step::Divisor(factors) if self.facts.sign_of_product(factors)?.is_strict() => {
                self.divisors.push((self.facts.product(factors)?, factors.clone()));
                Ok(())
            }
            Step::Divisor(_) => Err(Refusal::NotStrict),
            Step::Law(law) => {
                let (of, sign) = self.instance(law)?;
                self.add_quotient(of, sign)
            }
        }
    }

    /// Adds the fact that a polynomial of atoms has a sign.
    fn add_fact(&mut self, of: Polynomial, sign: Sign) -> Checked<()> {
        if !of.has_only(|x| x < self.signs.len()) {
            return Err(Refusal::Unknown);
        }
        if let Some(known) = of.as_variable().and_then(|x| self.signs.get_mut(x))
            && !known.implies(sign)
        {
            *known = sign;
        }
        self.facts.all.push((of, sign));
        Ok(())
    }

    /// Adds the fact that follows from the sign of a quotient.
    fn add_quotient(&mut self, of: Quotient, sign: Sign) -> Checked<()> {
        let sign = self.facts.sign_of_product(&of.den)?.times(sign);
        self.add_fact(of.num, sign)
    }

    /// Uses the hypothesis with a number.
    fn assume(&mut self, i: usize) -> Checked<()> {
        let sequent = self.sequent;
        let hypothesis = *sequent.hypotheses.get(i).ok_or(Refusal::Unknown)?;
        if sequent.mentions_variable(i) {
            self.holds_later(i)?;
        }
        self.assumed.push(i);
        let Some((x, ends)) = sequent.intervals[i] else {
            let value = self.value(sequent.values[i])?;
            return self.add_quotient(value, hypothesis.relation.into());
        };
        let [lower, upper] = ends.map(|end| self.value(end));
        let (lower, upper) = (lower?, upper?);
        let (t, half) =
            (self.variable(Atom::IntervalParameter(i))?, Quotient::new(Polynomial::constant(1), vec![TWO]));
        let reach = self.facts.sum(&upper, -1, &lower)?.times(&t.into(), &self.facts.effort)?;
        let twice = self.facts.sum(&self.facts.sum(&upper, 1, &lower)?, 1, &reach)?;
        let value = twice.times(&half, &self.facts.effort)?;
        self.symbols.entry(x).or_insert(value);
        self.values.clear();
        Ok(())
    }

    /// Returns the first of these signs that the facts state; it is the premise of a law.
    fn premise<const N: usize>(&self, of: &Quotient, signs: [Sign; N]) -> Checked<Sign> {
        signs.into_iter().find(|sign| self.facts.have(of, *sign)).ok_or(Refusal::Law)
    }

    /// Returns the quantity of an instance of a law, with its sign.
    fn instance(&mut self, law: &Law) -> Checked<(Quotient, Sign)> {
        Ok(match *law {
            Law::Exponents { ref left, ref right } => {
                let ([sum, product], [other_sum, other]) = (self.product(left)?, self.product(right)?);
                self.premise(&self.facts.sum(&sum, -1, &other_sum)?, [Sign::ZERO])?;
                (self.facts.sum(&product, -1, &other)?, Sign::ZERO)
            }
            Law::AboveTangent(x) => {
                let [exponent, power] = self.product(&[x])?;
                let tangent = self.facts.sum(&Polynomial::constant(1).into(), 1, &exponent)?;
                let strict = self.premise(&exponent, [Sign::POSITIVE, Sign::NEGATIVE]);
                (self.facts.sum(&power, -1, &tangent)?, strict.map_or(Sign::NON_NEGATIVE, |_| Sign::POSITIVE))
            }
            Law::BelowPole(x) => {
                let [exponent, power] = self.product(&[x])?;
                let two = Polynomial::constant(2).into();
                let [above, below] = [1, -1].map(|n| self.facts.sum(&two, n, &exponent));
                let product = below?.times(&power, &self.facts.effort)?;
                let sign = self.premise(&exponent, [Sign::POSITIVE, Sign::NON_NEGATIVE])?;
                (self.facts.sum(&above?, -1, &product)?, sign)
            }
            Law::AbsoluteValue(of) => {
                let (value, size) = (self.value(of)?, self.variable(Atom::Size(of))?);
                let product = size.times(&self.variable(Atom::Factor(of))?, &self.facts.effort)?;
                (self.facts.sum(&value, -1, &product.into())?, Sign::ZERO)
            }
            Law::Signed(of) => {
                let (value, size) = (self.value(of)?, self.variable(Atom::Size(of))?);
                let sign = self.premise(&value, [Sign::NON_NEGATIVE, Sign::NON_POSITIVE])?;
                let n = if sign == Sign::NON_NEGATIVE { -1 } else { 1 };
                (self.facts.sum(&size.into(), n, &value)?, Sign::ZERO)
            }
            Law::Order([a, b]) => {
                let table = &self.sequent.table;
                let (Op::Rounded(x), Op::Rounded(y)) = (table.op(a)?, table.op(b)?) else {
                    return Err(Refusal::Unknown);
                };
                let difference = self.sum(x, -1, y)?;
                (self.sum(a, -1, b)?, self.premise(&difference, [Sign::NON_NEGATIVE])?)
            }
        })
    }

    /// Returns the sum of the exponents of exponentials, and their product.
    fn product(&mut self, exponentials: &[usize]) -> Checked<[Quotient; 2]> {
        let mut both = [0, 1].map(|n| Polynomial::constant(n).into());
        for x in exponentials {
            let exponent = self.exponent(*x)?;
            let [sum, product] = &both;
            let sum = self.facts.sum(sum, 1, &exponent)?;
            both = [sum, product.times(&Polynomial::variable(*x)?.into(), &self.facts.effort)?];
        }
        Ok(both)
    }

    /// Returns the variable of an atom as a polynomial.
    fn variable(&self, atom: Atom) -> Checked<Polynomial> {
        Polynomial::variable(self.sequent.table.variable(atom)?)
    }

    /// Returns the exponent of an exponential.
    pub fn exponent(&mut self, x: usize) -> Checked<Quotient> {
        match self.sequent.table.atoms.get(x) {
            Some(Atom::Exponential(of)) => self.value(*of),
            _ => Err(Refusal::Unknown),
        }
    }

    /// Returns the value of the formula with a number. No divisor in it is 0.
    pub fn value(&mut self, formula: usize) -> Checked<Quotient> {
        if let Some(value) = self.values.get(&formula) {
            return Ok(value.clone());
        }
        let value = self.value_of_op(self.sequent.table.op(formula)?)?;
        self.values.insert(formula, value.clone());
        Ok(value)
    }

    fn value_of_op(&mut self, op: Op<usize>) -> Checked<Quotient> {
        use Op::*;
        Ok(match op {
            Symbol(name) => match self.symbols.get(name) {
                Some(value) => value.clone(),
                None => self.variable(Atom::Own(name))?.into(),
            },
            Int(n) => Polynomial::constant(n.into()).into(),
            Neg(a) => self.value(a)?.times(&Polynomial::constant(-1).into(), &self.facts.effort)?,
            Add(a, b) => self.sum(a, 1, b)?,
            Sub(a, b) => self.sum(a, -1, b)?,
            Mul(a, b) => self.value(a)?.times(&self.value(b)?, &self.facts.effort)?,
            Div(a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                a.times(&self.inverse(&b)?, &self.facts.effort)?
            }
            Exp(a) => {
                self.value(a)?;
                self.variable(Atom::Exponential(a))?.into()
            }
            PositivePart(a) => {
                let a = self.value(a)?;
                self.chosen(&a, &a, &Polynomial::constant(0).into())?
            }
            // min(−x, x) is −|x|.
            Min(a, b) if self.sequent.table.op(a)? == Neg(b) => {
                self.value(b)?;
                self.variable(Atom::Size(b))?.times(&Polynomial::constant(-1), &self.facts.effort)?.into()
            }
            Min(a, b) => {
                let (first, second) = (self.value(a)?, self.value(b)?);
                self.chosen(&self.facts.sum(&second, -1, &first)?, &first, &second)?
            }
            Rounded(a) => {
                let (value, effort) = (self.value(a)?, &self.facts.effort);
                let one = Polynomial::constant(1);
                let largest = self.variable(Atom::Own(PRECISION))?.plus_multiple(1, &one, effort)?;
                let share = self.inverse(&largest.into())?.times(&value, effort)?;
                let error = self.variable(Atom::Error(self.sequent.table.rounding(a).1))?;
                self.facts.sum(&value, 1, &share.times(&error.into(), effort)?)?
            }
        })
    }

    /// Returns a + n b for two formulas.
    fn sum(&mut self, a: usize, n: i128, b: usize) -> Checked<Quotient> {
        let (a, b) = (self.value(a)?, self.value(b)?);
        self.facts.sum(&a, n, &b)
    }

    /// Returns the reciprocal of a divisor, which is a fact or a product of facts.
    pub fn inverse(&self, of: &Quotient) -> Checked<Quotient> {
        let factors =
            self.divisors.iter().find(|(product, _)| *product == of.num).map(|(_, all)| all.clone());
        let factors = factors.or_else(|| Some(vec![self.facts.strict(&of.num)?])).ok_or(Refusal::Divisor)?;
        Ok(Quotient::new(self.facts.product(&of.den)?, factors))
    }

    /// Returns one of two values: the first one if a quantity is not negative.
    fn chosen(&self, by: &Quotient, first: &Quotient, second: &Quotient) -> Checked<Quotient> {
        let sign = self.premise(by, [Sign::NON_NEGATIVE, Sign::NON_POSITIVE]).or(Err(Refusal::Sign))?;
        Ok(if sign == Sign::NON_NEGATIVE { first } else { second }.clone())
    }

    /// Returns the quantities whose signs are to be proved.
    pub fn goals(&mut self) -> Checked<Vec<(Quotient, Sign)>> {
        use Proposition::*;
        let values = self.sequent.goal.iter().map(|of| self.value(*of)).collect::<Checked<Vec<_>>>()?;
        let (relation, sums) = match (self.sequent.proposition, &values[..]) {
            (Sign(relation, _), [of, ..]) => (*relation, vec![(of.clone(), 0, of)]),
            (Within(..), [of, bound]) => {
                (Relation::NonNegative, [-1, 1].map(|n| (bound.clone(), n, of)).into())
            }
            (Limit(..), [of, to]) => (Relation::Zero, vec![(self.limit_of(of)?, -1, to)]),
            (Equal(..), [a, b]) | (Derivative(..), [_, b, a]) => (Relation::Zero, vec![(a.clone(), -1, b)]),
            _ => return Err(Refusal::Goal),
        };
        let sums = sums.iter().map(|(a, n, b)| Ok((self.facts.sum(a, *n, b)?, relation.into())));
        sums.collect()
    }

    /// Returns `true` if the facts state what is to be proved.
    pub fn proves_goal(&mut self) -> Checked<bool> {
        Ok(self.goals()?.iter().all(|(of, sign)| self.facts.have(of, *sign)))
    }
}
