//! Formulas of one quantity where it is large.

use super::domain::{Balls, Domain, Value};
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Ball, Exact, Field, OrderedField, PositivePart};
use crate::operators;
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::iter;

/// A polynomial; the coefficient of the highest power comes last and is not 0.
type Polynomial = Vec<Exact>;

fn polynomial(mut coefficients: Polynomial) -> Polynomial {
    while coefficients.pop_if(|last| last.is_zero()).is_some() {}
    coefficients
}

fn sum(a: &[Exact], b: &[Exact]) -> Polynomial {
    let of = |x: &[Exact], i: usize| x.get(i).cloned().unwrap_or_else(Exact::zero);
    polynomial((0..a.len().max(b.len())).map(|i| of(a, i) + of(b, i)).collect())
}

fn product(a: &[Exact], b: &[Exact]) -> Polynomial {
    let shifted = |(i, x): (usize, &Exact)| -> Polynomial {
        iter::repeat_n(Exact::zero(), i).chain(b.iter().map(|y| x * y)).collect()
    };
    a.iter().enumerate().map(shifted).fold(Vec::new(), |total, term| sum(&total, &term))
}

/// A quotient of polynomials of a quantity. Of two, that is the larger which is larger for all large values of
/// the quantity.
#[derive(Clone, Debug)]
pub(super) struct Germ {
    numerator: Polynomial,
    /// Its leading coefficient is positive.
    denominator: Polynomial,
}

impl Germ {
    pub(super) fn constant(x: Exact) -> Self {
        Germ { numerator: polynomial(vec![x]), denominator: vec![Exact::one()] }
    }

    /// Returns the quantity itself.
    pub(super) fn variable() -> Self {
        Germ { numerator: vec![Exact::zero(), Exact::one()], denominator: vec![Exact::one()] }
    }

    /// Returns the limit as the quantity tends to infinity; `None` if there is none.
    pub(super) fn limit(&self) -> Option<Exact> {
        let Germ { numerator, denominator } = self;
        match numerator.len().cmp(&denominator.len()) {
            Ordering::Less => Some(Exact::zero()),
            Ordering::Equal => Some(numerator.last()? / denominator.last()?),
            Ordering::Greater => None,
        }
    }
}

operators! { [] Germ;
    Add add |a, b| Germ {
        numerator: sum(&product(&a.numerator, &b.denominator), &product(&b.numerator, &a.denominator)),
        denominator: product(&a.denominator, &b.denominator),
    };
    Sub sub |a, b| a + (-b);
    Mul mul |a, b| Germ {
        numerator: product(&a.numerator, &b.numerator),
        denominator: product(&a.denominator, &b.denominator),
    };
    Div div |a, b| {
        let inverse = Germ { numerator: b.denominator.clone(), denominator: b.numerator.clone() };
        a * if *b < Germ::zero() { -Germ { denominator: (-b).numerator, ..inverse } } else { inverse }
    };
    - |a| Germ { numerator: a.numerator.iter().map(|x| -x).collect(), denominator: a.denominator.clone() }
}

impl PartialEq for Germ {
    fn eq(&self, other: &Self) -> bool {
        (self - other).is_zero()
    }
}
impl PartialOrd for Germ {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let leading = (self - other).numerator.pop();
        Some(leading.map_or(Ordering::Equal, |x| x.cmp(&Exact::zero())))
    }
}
impl Zero for Germ {
    fn zero() -> Self {
        Germ::constant(Exact::zero())
    }
    fn is_zero(&self) -> bool {
        self.numerator.is_empty()
    }
}
impl One for Germ {
    fn one() -> Self {
        Germ::constant(Exact::one())
    }
}
impl Field for Germ {
    fn int(n: i32) -> Self {
        Germ::constant(Exact::from(n))
    }
}
impl PositivePart for Germ {
    fn positive_part(&self) -> Self {
        if *self > Germ::zero() { self.clone() } else { Germ::zero() }
    }
    fn min(&self, other: &Self) -> Self {
        if other < self { other.clone() } else { self.clone() }
    }
}
impl OrderedField for Germ {}

/// The behaviour of a formula where the quantity is large.
#[derive(Clone, Debug)]
pub(super) enum Tendency {
    /// The formula is a rational function there.
    Rational(Germ),
    /// It tends to a number in the ball.
    Number(Ball<f64>),
    /// It tends to +∞, or to −∞.
    Infinite { positive: bool },
    /// Nothing is known.
    Unknown,
}

use Tendency::{Infinite, Number, Rational, Unknown};

impl Tendency {
    /// Returns the tendency without the rational function.
    fn coarse(&self) -> Self {
        let Rational(germ) = self else { return self.clone() };
        match germ.limit() {
            Some(limit) => Number(Value::Exact(limit).ball()),
            None => Infinite { positive: *germ > Germ::zero() },
        }
    }

    /// Returns the tendency of an operation on operands that are not all rational functions.
    fn of(op: Op<Tendency>) -> Self {
        match op {
            Op::Exp(Infinite { positive: true }) => Infinite { positive: true },
            Op::Exp(Infinite { positive: false }) | Op::Div(Number(_), Infinite { .. }) => {
                Number(Ball::zero())
            }
            Op::Neg(Infinite { positive }) => Infinite { positive: !positive },
            Op::Sub(a, b) => Tendency::of(Op::Add(a, Tendency::of(Op::Neg(b)))),
            Op::Add(Infinite { positive: a }, Infinite { positive: b }) if a == b => Infinite { positive: a },
            Op::Add(Infinite { positive }, Number(_)) | Op::Add(Number(_), Infinite { positive }) => {
                Infinite { positive }
            }
            Op::Mul(Infinite { positive: a }, Infinite { positive: b }) => Infinite { positive: a == b },
            Op::Mul(Infinite { positive }, Number(x)) | Op::Mul(Number(x), Infinite { positive }) => {
                match x.sign() {
                    Some(Ordering::Greater) => Infinite { positive },
                    Some(Ordering::Less) => Infinite { positive: !positive },
                    Some(Ordering::Equal) | None => Unknown,
                }
            }
            Op::Rounded(_) => Unknown,
            op => Tendency::of_numbers(&op).unwrap_or(Unknown),
        }
    }

    /// Returns the tendency of an operation that is continuous at numbers.
    fn of_numbers(op: &Op<Tendency>) -> Option<Self> {
        let numbers = op.try_map(|operand| match operand {
            Number(x) => Some(x),
            Rational(_) | Infinite { .. } | Unknown => None,
        })?;
        Balls(0.0).apply(numbers).filter(Ball::is_finite).map(Number)
    }
}

/// Behaviours of formulas where one quantity is large.
pub(super) struct Germs;

impl Domain for Germs {
    type Value = Tendency;

    fn apply(&self, op: Op<&Tendency>) -> Option<Tendency> {
        let rational = |tendency: &&Tendency| match tendency {
            Rational(germ) => Some(germ.clone()),
            Number(_) | Infinite { .. } | Unknown => None,
        };
        match op.try_map(rational) {
            Some(op) if !matches!(op, Op::Exp(_) | Op::Rounded(_)) => {
                op.map(|germ| germ).value(&|_| Germ::zero(), &piecewise_ops).map(Rational)
            }
            _ => Some(Tendency::of(op.map(|operand| operand.coarse()))),
        }
    }
}

/// Returns `Ok` if what tends like this tends to 0, and otherwise its limit if there is one; `None` if this is not
/// certain.
pub(super) fn vanishes(tendency: &Tendency) -> Option<Result<(), Option<Value>>> {
    match tendency {
        Rational(germ) => match germ.limit() {
            Some(limit) if limit.is_zero() => Some(Ok(())),
            limit => Some(Err(limit.map(Value::Exact))),
        },
        Number(x) => match x.sign()? {
            Ordering::Equal => Some(Ok(())),
            Ordering::Less | Ordering::Greater => Some(Err(Some(Value::Ball(x.clone())))),
        },
        Infinite { .. } => Some(Err(None)),
        Unknown => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_quotients_are_equal() {
        let x = Germ::variable();
        let same = &x * &x / &x;
        assert!(same == x && x != Germ::one());
        assert!(same <= x && x > Germ::int(5) && -&x < Germ::int(-5));
    }
}
