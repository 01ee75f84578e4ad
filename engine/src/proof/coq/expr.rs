//! Formulas in Coq's notation.

use crate::formula::Relation;
use std::fmt;

/// A formula in Coq, with its precedence level; a smaller level binds more strongly.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expr {
    text: String,
    level: u32,
}

impl Expr {
    /// Returns a name or a nonnegative number.
    pub(super) fn word(text: impl ToString) -> Self {
        Expr { text: text.to_string(), level: 0 }
    }

    /// Applies a function to arguments.
    pub(super) fn call(function: &str, arguments: impl IntoIterator<Item = Expr>) -> Self {
        let arguments = arguments.into_iter().map(|argument| format!(" {}", argument.argument()));
        Expr { text: function.to_string() + &arguments.collect::<String>(), level: 10 }
    }

    pub(super) fn negated(self) -> Self {
        Expr { text: format!("- {}", self.within(34)), level: 35 }
    }

    /// Joins two formulas by an operator.
    pub(super) fn binary(sign: char, a: Expr, b: Expr) -> Self {
        let level = if matches!(sign, '+' | '-') { 50 } else { 40 };
        Expr { text: format!("{} {sign} {}", a.within(level), b.within(level - 1)), level }
    }

    /// Joins two formulas by an operator, without zeros and ones.
    pub(super) fn simplified(sign: char, a: Expr, b: Expr) -> Self {
        match (sign, a.text.as_str(), b.text.as_str()) {
            ('+', "0", _) | ('*', _, "0") | ('*', "1", _) => b,
            ('+' | '-', _, "0") | ('*', "0", _) | ('*', _, "1") | ('/', "0", _) => a,
            _ => Expr::binary(sign, a, b),
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

    /// Writes brackets unless the level is at most `level`.
    fn within(&self, level: u32) -> String {
        if self.level > level { format!("({self})") } else { self.text.clone() }
    }

    /// Writes an argument, in brackets unless it is one word.
    pub(super) fn argument(&self) -> String {
        self.within(0)
    }

    /// Writes a power whose exponent is n, in brackets.
    pub(super) fn power(&self) -> String {
        format!("({} ^ n)", self.within(10))
    }
}

impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.text)
    }
}
