//! Formulas in Coq's notation.

use crate::formula::Relation;
use crate::proof::check::Polynomial;
use std::fmt;

/// A formula in Coq.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expr {
    Name(String),
    /// A nonnegative number.
    Number(String),
    Neg(Box<Expr>),
    Binary(Operator, Box<Expr>, Box<Expr>),
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

    pub(super) fn call(function: &str, arguments: Vec<Expr>) -> Self {
        Expr::Call(function.into(), arguments)
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

    pub(super) fn divided_by(self, other: Expr) -> Self {
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

    /// Returns a polynomial as a sum of products.
    pub(super) fn polynomial(of: &Polynomial, variable: impl Fn(usize) -> Expr) -> Self {
        let mut sum: Option<Expr> = None;
        for (powers, number) in of.terms() {
            let size = Expr::Number(number.unsigned_abs().to_string());
            let factors = powers.iter().enumerate().flat_map(|(x, n)| vec![x; usize::from(*n)]);
            let term = factors.fold(size, |product, x| product.times(variable(x)));
            sum = Some(match (sum, number.is_negative()) {
                (None, false) => term,
                (None, true) => term.negated(),
                (Some(sum), false) => sum.plus(term),
                (Some(sum), true) => Expr::binary(Operator::Sub, sum, term),
            });
        }
        sum.unwrap_or(Expr::int(0))
    }

    /// Substitutes an expression for a name.
    pub(super) fn substitute(&self, name: &str, by: &Expr) -> Self {
        let with = |a: &Expr| Box::new(a.substitute(name, by));
        match self {
            Expr::Name(known) if known == name => by.clone(),
            Expr::Name(_) | Expr::Number(_) => self.clone(),
            Expr::Neg(a) => Expr::Neg(with(a)),
            Expr::Binary(operator, a, b) => Expr::Binary(*operator, with(a), with(b)),
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
    use crate::proof::effort::Effort;

    #[test]
    fn polynomials_are_sums_of_products() {
        let [a, b] = [0, 1].map(|x| Polynomial::variable(x).unwrap());
        let square = a.times(&a, &Effort::default()).unwrap();
        let text = |of: &Polynomial| Expr::polynomial(of, |x| Expr::name(["a", "b"][x])).to_string();
        assert_eq!(text(&b.plus_multiple(-3, &square, &Effort::default()).unwrap()), "b - 3 * a * a");
        assert_eq!(
            text(&Polynomial::zero().plus_multiple(-1, &square, &Effort::default()).unwrap()),
            "- (a * a)"
        );
        assert_eq!(text(&Polynomial::zero()), "0");
    }
}
