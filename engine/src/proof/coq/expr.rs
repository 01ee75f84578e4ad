//! Formulas in Coq's notation.

use super::print::ascii;
use crate::formula::Relation;
use crate::proof::kernel::algebra::{Poly, Ratio, Symbol};
use std::collections::BTreeMap;
use std::fmt;

/// A formula in Coq.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expr {
    Name(String),
    /// A nonnegative number.
    Number(String),
    Neg(Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
    Power(Box<Expr>, u32),
    /// A function and its arguments.
    Call(String, Vec<Expr>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Sub,
    Mul,
    Div,
}

impl Expr {
    pub(super) fn name(name: impl Into<String>) -> Self {
        Expr::Name(name.into())
    }

    pub(super) fn int(n: i32) -> Self {
        let size = Expr::Number(n.unsigned_abs().to_string());
        if n < 0 { size.negated() } else { size }
    }

    pub(super) fn negated(self) -> Self {
        Expr::Neg(self.into())
    }

    pub(super) fn binary(operator: Operator, a: Expr, b: Expr) -> Self {
        Expr::Binary(operator, a.into(), b.into())
    }

    pub(super) fn plus(self, other: Expr) -> Self {
        Expr::binary(Operator::Add, self, other)
    }

    pub(super) fn times(self, other: Expr) -> Self {
        if self.is(1) { other } else { Expr::binary(Operator::Mul, self, other) }
    }

    pub(super) fn over(self, other: Expr) -> Self {
        if other.is(1) { self } else { Expr::binary(Operator::Div, self, other) }
    }

    fn is(&self, n: u8) -> bool {
        matches!(self, Expr::Number(digits) if *digits == n.to_string())
    }

    pub(super) fn simplified(self) -> Self {
        use Operator::*;
        match self {
            Expr::Binary(Add, a, b) if a.is(0) => *b,
            Expr::Binary(Add | Sub, a, b) if b.is(0) => *a,
            Expr::Binary(Mul, a, b) if a.is(0) || b.is(1) => *a,
            Expr::Binary(Mul, a, b) if b.is(0) || a.is(1) => *b,
            Expr::Binary(Div, a, _) if a.is(0) => *a,
            other => other,
        }
    }

    /// Returns a polynomial as a sum of products of powers.
    pub(super) fn poly(poly: &Poly) -> Self {
        let mut sum: Option<Expr> = None;
        for (exponent, part) in by_exponent(poly) {
            let exponential = exponent.map(|e| Expr::Call("exp".into(), vec![Expr::ratio(e)]));
            for (monomial, coefficient) in part.terms().rev() {
                let coefficient = coefficient.to_rational();
                let number = |n: &rug::Integer| Expr::Number(n.clone().abs().to_string());
                let mut factors: Vec<Expr> = monomial.powers().map(power).collect();
                factors.extend(exponential.clone());
                let size = number(coefficient.numer());
                let product = factors.into_iter().fold(size, Expr::times);
                let term = product.over(number(coefficient.denom()));
                sum = Some(match (sum, coefficient.is_negative()) {
                    (None, false) => term,
                    (None, true) => term.negated(),
                    (Some(sum), false) => sum.plus(term),
                    (Some(sum), true) => Expr::binary(Operator::Sub, sum, term),
                });
            }
        }
        sum.unwrap_or(Expr::int(0))
    }

    pub(super) fn ratio(ratio: &Ratio) -> Self {
        Expr::poly(ratio.num()).over(Expr::poly(ratio.den()))
    }

    /// Substitutes an expression for a name.
    pub(super) fn substitute(&self, name: &str, by: &Expr) -> Self {
        let with = |a: &Expr| Box::new(a.substitute(name, by));
        match self {
            Expr::Name(own) if own == name => by.clone(),
            Expr::Name(_) | Expr::Number(_) => self.clone(),
            Expr::Neg(a) => Expr::Neg(with(a)),
            Expr::Binary(operator, a, b) => Expr::Binary(*operator, with(a), with(b)),
            Expr::Power(a, n) => Expr::Power(with(a), *n),
            Expr::Call(function, arguments) => {
                Expr::Call(function.clone(), arguments.iter().map(|a| a.substitute(name, by)).collect())
            }
        }
    }

    /// Returns the relation of the expression to zero.
    pub(super) fn relation(&self, relation: Relation) -> String {
        match relation {
            Relation::Positive => format!("0 < {self}"),
            Relation::NonNegative => format!("0 <= {self}"),
            Relation::Zero => format!("{self} = 0"),
        }
    }

    /// Returns Coq's precedence level; a smaller level binds more strongly.
    fn level(&self) -> u32 {
        match self {
            Expr::Name(_) | Expr::Number(_) => 0,
            Expr::Call(..) => 10,
            Expr::Power(..) => 30,
            Expr::Neg(_) => 35,
            Expr::Binary(operator, ..) => operator.level(),
        }
    }

    /// Writes brackets unless the level is at most `level`.
    fn within(&self, level: u32) -> String {
        if self.level() > level { format!("({self})") } else { self.to_string() }
    }

    /// Writes an argument, in brackets unless it is one word.
    pub(super) fn argument(&self) -> String {
        self.within(0)
    }

    /// Writes the base of a power.
    pub(super) fn base(&self) -> String {
        self.within(10)
    }
}

/// Groups the terms of a polynomial by their factor e^…, without it.
pub(super) fn by_exponent(poly: &Poly) -> BTreeMap<Option<&Ratio>, Poly> {
    let mut parts = BTreeMap::<_, Vec<_>>::new();
    for (monomial, coefficient) in poly.terms() {
        parts
            .entry(monomial.exponent())
            .or_default()
            .push((monomial.without_exponential(), coefficient.clone()));
    }
    parts.into_iter().map(|(exponent, terms)| (exponent, terms.into_iter().collect())).collect()
}

fn power((symbol, n): (Symbol, u32)) -> Expr {
    let symbol = Expr::Name(ascii(symbol.name()));
    match n {
        1 => symbol,
        // Written as a square where possible, so that its sign is evident.
        n if n % 2 == 0 && n > 2 => Expr::Power(Expr::Power(symbol.into(), n / 2).into(), 2),
        n => Expr::Power(symbol.into(), n),
    }
}

impl Operator {
    fn level(self) -> u32 {
        match self {
            Operator::Add | Operator::Sub => 50,
            Operator::Mul | Operator::Div => 40,
        }
    }
}

impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Expr::Name(text) | Expr::Number(text) => f.write_str(text),
            Expr::Neg(a) => write!(f, "- {}", a.within(34)),
            Expr::Binary(operator, a, b) => {
                let sign = match operator {
                    Operator::Add => "+",
                    Operator::Sub => "-",
                    Operator::Mul => "*",
                    Operator::Div => "/",
                };
                write!(f, "{} {sign} {}", a.within(operator.level()), b.within(operator.level() - 1))
            }
            Expr::Power(a, n) => write!(f, "{} ^ {n}", a.base()),
            Expr::Call(function, arguments) => {
                f.write_str(function)?;
                arguments.iter().try_for_each(|argument| write!(f, " {}", argument.argument()))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_sums_of_powers() {
        let x = |name| Poly::symbol(Symbol::Own(name));
        let square = x("a") * x("a");
        let fourth = Poly::constant(-3) * &square * &square;
        assert_eq!(Expr::poly(&(fourth + x("b"))).to_string(), "- (3 * (a ^ 2) ^ 2) + b");
        assert_eq!(Expr::poly(&(square * Poly::constant((1, 2)))).to_string(), "a ^ 2 / 2");
        assert_eq!(Expr::poly(&Poly::zero()).to_string(), "0");
    }
}
