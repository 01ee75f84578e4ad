//! Formulas of one quantity where it is large.

use super::domain::{Balls, Domain, Value};
use crate::number::tree::Op;
use crate::number::{Ball, Exact};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::iter;

/// A polynomial; the coefficient of the highest power comes last and is not 0.
type Polynomial = Vec<Exact>;

fn sum(a: &[Exact], b: &[Exact]) -> Polynomial {
    let mut sum = a.to_vec();
    sum.resize(a.len().max(b.len()), Exact::zero());
    for (coefficient, other) in sum.iter_mut().zip(b) {
        *coefficient = &*coefficient + other;
    }
    while sum.pop_if(|last| last.is_zero()).is_some() {}
    sum
}

fn product(a: &[Exact], b: &[Exact]) -> Polynomial {
    a.iter().enumerate().fold(Vec::new(), |total, (i, x)| {
        let term: Polynomial = iter::repeat_n(Exact::zero(), i).chain(b.iter().map(|y| x * y)).collect();
        sum(&total, &term)
    })
}

fn negated(a: &[Exact]) -> Polynomial {
    a.iter().map(|x| -x).collect()
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
        Germ { numerator: sum(&[x], &[]), denominator: vec![Exact::one()] }
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

    /// Returns the sign for all large values of the quantity.
    fn sign(&self) -> Ordering {
        self.numerator.last().map_or(Ordering::Equal, |x| x.cmp(&Exact::zero()))
    }

    fn minus(&self, other: &Self) -> Self {
        let [a, b] = [(self, other), (other, self)].map(|(x, y)| product(&x.numerator, &y.denominator));
        Germ { numerator: sum(&a, &negated(&b)), denominator: product(&self.denominator, &other.denominator) }
    }

    fn times(&self, other: &Self) -> Self {
        Germ {
            numerator: product(&self.numerator, &other.numerator),
            denominator: product(&self.denominator, &other.denominator),
        }
    }

    /// Returns the reciprocal; `None` of 0.
    fn inverse(&self) -> Option<Self> {
        let (numerator, denominator) = match self.sign() {
            Ordering::Less => (negated(&self.denominator), negated(&self.numerator)),
            Ordering::Equal => return None,
            Ordering::Greater => (self.denominator.clone(), self.numerator.clone()),
        };
        Some(Germ { numerator, denominator })
    }
}

/// The behaviour of a formula where the quantity is large.
#[derive(Clone, Debug)]
pub(super) enum Tendency {
    /// The formula is a rational function there.
    Rational(Germ),
    /// It tends to a number in the ball.
    Number(Ball<f64>),
    /// It tends to infinity with this sign.
    Infinite(Ordering),
    /// Nothing is known.
    Unknown,
}

use Tendency::{Infinite, Number, Rational, Unknown};

impl Tendency {
    /// Returns the rational function, if the formula is one.
    fn germ(&self) -> Option<&Germ> {
        if let Rational(germ) = self { Some(germ) } else { None }
    }

    /// Returns the tendency without the rational function.
    fn coarse(&self) -> Self {
        let Rational(germ) = self else { return self.clone() };
        germ.limit().map_or(Infinite(germ.sign()), |limit| Number(Value::Exact(limit).ball()))
    }

    /// Returns the tendency of an operation on operands that are not all rational functions.
    fn of(op: Op<Tendency>) -> Self {
        match op {
            Op::Exp(Infinite(Ordering::Greater)) => Infinite(Ordering::Greater),
            Op::Exp(Infinite(_)) | Op::Div(Number(_), Infinite(_)) => Number(Ball::zero()),
            Op::Neg(Infinite(sign)) => Infinite(sign.reverse()),
            Op::Sub(a, b) => Tendency::of(Op::Add(a, Tendency::of(Op::Neg(b)))),
            Op::Add(Infinite(a), Infinite(b)) if a == b => Infinite(a),
            Op::Add(Infinite(sign), Number(_)) | Op::Add(Number(_), Infinite(sign)) => Infinite(sign),
            Op::Mul(Infinite(a), Infinite(b)) if a == b => Infinite(Ordering::Greater),
            Op::Mul(Infinite(_), Infinite(_)) => Infinite(Ordering::Less),
            Op::Mul(Infinite(infinite), Number(x)) | Op::Mul(Number(x), Infinite(infinite)) => {
                match x.sign() {
                    Some(Ordering::Greater) => Infinite(infinite),
                    Some(Ordering::Less) => Infinite(infinite.reverse()),
                    Some(Ordering::Equal) | None => Unknown,
                }
            }
            Op::Rounded(_) => Unknown,
            op => Tendency::of_numbers(&op).unwrap_or(Unknown),
        }
    }

    /// Returns the tendency of an operation that is continuous at numbers.
    fn of_numbers(op: &Op<Tendency>) -> Option<Self> {
        let numbers = op.try_map(|operand| if let Number(x) = operand { Some(x) } else { None })?;
        Balls(0.0).apply(numbers).filter(Ball::is_finite).map(Number)
    }
}

/// Behaviours of formulas where one quantity is large.
pub(super) struct Germs;

impl Domain for Germs {
    type Value = Tendency;

    fn apply(&self, op: Op<&Tendency>) -> Option<Tendency> {
        let zero = || Germ::constant(Exact::zero());
        Some(Rational(match op.try_map(|tendency| tendency.germ()) {
            Some(Op::Int(n)) => Germ::constant(Exact::from(n)),
            Some(Op::Neg(a)) => zero().minus(a),
            Some(Op::Add(a, b)) => a.minus(&zero().minus(b)),
            Some(Op::Sub(a, b)) => a.minus(b),
            Some(Op::Mul(a, b)) => a.times(b),
            Some(Op::Div(a, b)) => a.times(&b.inverse()?),
            Some(Op::PositivePart(a)) if a.sign().is_gt() => a.clone(),
            Some(Op::PositivePart(_)) => zero(),
            Some(Op::Min(a, b)) if b.minus(a).sign().is_lt() => b.clone(),
            Some(Op::Min(a, _)) => a.clone(),
            Some(Op::Symbol(_) | Op::Exp(_) | Op::Rounded(_)) | None => {
                return Some(Tendency::of(op.map(|operand| operand.coarse())));
            }
        }))
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
        Infinite(_) => Some(Err(None)),
        Unknown => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_compared_where_they_are_large() {
        let (x, one) = (Germ::variable(), Germ::constant(Exact::one()));
        let same = x.times(&x).times(&x.inverse().unwrap());
        assert_eq!(
            [same.minus(&x), same.minus(&one), one.minus(&x)].map(|germ| germ.sign()),
            [Ordering::Equal, Ordering::Greater, Ordering::Less]
        );
        let inverse = one.minus(&x).inverse().unwrap();
        assert_eq!((inverse.sign(), inverse.limit()), (Ordering::Less, Some(Exact::zero())));
        assert!(same.minus(&x).inverse().is_none());
    }

    #[test]
    fn a_difference_of_infinite_quantities_is_unknown() {
        let infinite = || Infinite(Ordering::Greater);
        assert!(matches!(Tendency::of(Op::Add(infinite(), infinite())), Infinite(Ordering::Greater)));
        assert!(matches!(Tendency::of(Op::Sub(infinite(), infinite())), Unknown));
    }
}
