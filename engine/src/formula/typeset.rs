//! Typesetting of formulas: one layout with two notations.
//!
//! The layout preserves the meaning and the order of a formula, but not every operation: sums and products
//! are flat, signs stand in front of products and numbers at their head, equal factors form a power, and a
//! factor 1 or a summand 0 is omitted. Brackets occur only where they are needed.

mod hypothesis;
mod latex;
mod rounding;

pub use latex::latex;
pub(crate) use rounding::name_of_rounding;

use self::latex::{script, superscript};
use crate::number::Tree;
use crate::number::tree::Op;
use std::fmt;

/// Output notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// `u = (ε (H − l) + m g) / (c + ε)`
    Text,
    /// `u = \frac{\varepsilon\,(H - l) + m\,g}{c + \varepsilon}`
    Latex,
}

/// Abbreviation of a subformula.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// Symbol in plain text: `Π`, `u_{k−1}`, `λ₀`.
    pub symbol: String,
    /// Displayed arguments, such as the Δ of `Π(Δ)`.
    pub arguments: Vec<Tree>,
}

/// Largest depth of a formula that is written out.
const MAX_DEPTH: u32 = 1000;

impl Tree {
    /// Returns the formula in LaTeX.
    ///
    /// # Examples
    ///
    /// ```
    /// use provable::number::{Field, Tree};
    /// let [c, u] = ["c", "u"].map(|name| Tree::symbol(name));
    /// assert_eq!((c * &u * &u / Tree::int(2)).latex(), r"\tfrac{1}{2}\,c\,u^2");
    /// ```
    pub fn latex(&self) -> String {
        self.typeset(Notation::Latex, &|_| None)
    }

    /// Formats the formula with the names that `name` returns for subformulas. Returns only its size if it is
    /// more than 1000 operations deep.
    pub fn typeset(&self, notation: Notation, name: &dyn Fn(&Tree) -> Option<Name>) -> String {
        if self.depth() > MAX_DEPTH {
            return format!("a formula of {} operations and quantities", self.size());
        }
        let sum = Layout { name }.sum(self);
        Writer { notation, inline: notation == Notation::Text }.sum(&sum)
    }

    /// Returns the formula in plain text with an exponent: `ρᵏ`, `(1 − c)ᵏ`.
    pub(crate) fn raised(&self, exponent: &str, name: &dyn Fn(&Tree) -> Option<Name>) -> String {
        let sum = Layout { name }.sum(self);
        let writer = Writer { notation: Notation::Text, inline: true };
        let base = match &sum[..] {
            [term] if !term.negative && term.under.is_one() => {
                match (&term.over.factors[..], term.over.number) {
                    ([], _) => Some(writer.term(term)),
                    ([(factor, 1)], 1) => Some(writer.base(factor)),
                    _ => None,
                }
            }
            _ => None,
        };
        base.unwrap_or_else(|| format!("({})", writer.sum(&sum))) + exponent
    }
}

/// Writes the formula in plain text.
impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.typeset(Notation::Text, &|_| None))
    }
}

/// Terms of a sum, at least one.
type Sum = Vec<Term>;

/// A quotient of products with its sign.
#[derive(Clone, PartialEq)]
struct Term {
    negative: bool,
    over: Product,
    under: Product,
}

#[derive(Clone, PartialEq)]
struct Product {
    number: u64,
    factors: Vec<(Factor, u32)>,
}

#[derive(Clone, PartialEq)]
enum Factor {
    Name(String, Vec<Sum>),
    Group(Sum),
    Exp(Sum),
    PositivePart(Sum),
    Size(Sum),
    Rounded(&'static str, Sum),
    Extremum(&'static str, [Sum; 2]),
}

impl Product {
    fn number(number: u64) -> Self {
        Product { number, factors: Vec::new() }
    }

    fn is_one(&self) -> bool {
        self.number == 1 && self.factors.is_empty()
    }

    fn pieces(&self) -> usize {
        self.factors.len() + usize::from(self.number != 1)
    }

    fn push(&mut self, factor: Factor, power: u32) {
        match self.factors.iter_mut().find(|(known, _)| *known == factor) {
            Some((_, sum)) => *sum += power,
            None => self.factors.push((factor, power)),
        }
    }

    fn multiply(&mut self, other: Product) {
        match self.number.checked_mul(other.number) {
            Some(number) => self.number = number,
            None => self.push(Factor::Group(vec![Term::over(Product::number(other.number))]), 1),
        }
        other.factors.into_iter().for_each(|(factor, power)| self.push(factor, power));
    }
}

impl Term {
    fn over(over: Product) -> Self {
        Term { negative: false, over, under: Product::number(1) }
    }

    fn of(factor: Factor, power: u32) -> Self {
        Term::over(Product { number: 1, factors: vec![(factor, power)] })
    }

    fn negated(self) -> Self {
        Term { negative: !self.negative, ..self }
    }

    fn inverse(self) -> Self {
        Term { over: self.under, under: self.over, ..self }
    }

    fn times(mut self, other: Term) -> Self {
        self.negative ^= other.negative;
        self.over.multiply(other.over);
        self.under.multiply(other.under);
        let (mut a, mut b) = (self.over.number, self.under.number);
        while b != 0 {
            (a, b) = (b, a % b);
        }
        if self.under.number != 0 {
            self.over.number /= a;
            self.under.number /= a;
        }
        if self.is_zero() { Term::over(Product::number(0)) } else { self }
    }

    fn is_zero(&self) -> bool {
        self.over.number == 0 && self.under.number != 0
    }

    /// Returns the factor if the product consists of one.
    fn only(&self) -> Option<&Factor> {
        match &self.over.factors[..] {
            [(factor, 1)] if self.over.number == 1 && self.under.is_one() => Some(factor),
            _ => None,
        }
    }
}

/// Returns the x of −min(−x, x), which is |x|; the argument is what is negated.
fn size(negated: &Tree) -> Option<&Tree> {
    match negated.op() {
        Op::Min(y, x) if matches!(y.op(), Op::Neg(z) if z == x) => Some(x),
        _ => None,
    }
}

/// Arranges a formula in sums and products.
struct Layout<'a> {
    name: &'a dyn Fn(&Tree) -> Option<Name>,
}

impl Layout<'_> {
    fn sum(&self, tree: &Tree) -> Sum {
        let mut sum = Vec::new();
        self.collect(tree, false, &mut sum);
        if sum.iter().all(Term::is_zero) {
            return vec![Term::over(Product::number(0))];
        }
        sum.retain(|term| !term.is_zero());
        // −min(−a, b) is more readable as max(a, −b).
        if let [term] = &mut sum[..]
            && term.negative
            && let Some(Factor::Extremum("min", [a, b])) = term.only()
            && (a[0].negative || b[0].negative)
        {
            let negated = [a, b].map(|sum| sum.iter().cloned().map(Term::negated).collect());
            *term = Term::of(Factor::Extremum("max", negated), 1);
        }
        sum
    }

    fn collect(&self, tree: &Tree, negative: bool, sum: &mut Sum) {
        match tree.op() {
            _ if (self.name)(tree).is_some() => {}
            Op::Add(a, b) => {
                self.collect(a, negative, sum);
                return self.collect(b, negative, sum);
            }
            Op::Sub(a, b) => {
                self.collect(a, negative, sum);
                return self.collect(b, !negative, sum);
            }
            _ => {}
        }
        let mut term = self.term(tree);
        term.negative ^= negative;
        match term.only() {
            // The remainder of 1 (a + b).
            Some(Factor::Group(inner)) => {
                sum.extend(inner.iter().cloned().map(|t| Term { negative: t.negative ^ term.negative, ..t }))
            }
            _ => sum.push(term),
        }
    }

    fn term(&self, tree: &Tree) -> Term {
        if let Some(Name { symbol, arguments }) = (self.name)(tree) {
            let arguments = arguments.iter().map(|argument| self.sum(argument)).collect();
            return Term::of(Factor::Name(symbol, arguments), 1);
        }
        match tree.op() {
            Op::Symbol(name) => Term::of(Factor::Name(name.to_string(), Vec::new()), 1),
            Op::Int(n) => {
                let number = Term::over(Product::number(n.unsigned_abs().into()));
                Term { negative: *n < 0, ..number }
            }
            Op::Neg(a) => match size(a) {
                Some(a) => Term::of(Factor::Size(self.sum(a)), 1),
                None => self.term(a).negated(),
            },
            Op::Add(..) | Op::Sub(..) => match <[Term; 1]>::try_from(self.sum(tree)) {
                Ok([term]) => term,
                Err(sum) => Term::of(Factor::Group(sum), 1),
            },
            Op::Mul(a, b) => {
                let (first, second) = (self.term(a), self.term(b));
                // The square of a product is kept: (m g)² and not m² g².
                if a == b && first.over.pieces() + first.under.pieces() > 1 {
                    return Term::of(Factor::Group(vec![Term { negative: false, ..first }]), 2);
                }
                first.times(second)
            }
            Op::Div(a, b) => self.term(a).times(self.term(b).inverse()),
            Op::Exp(a) => Term::of(Factor::Exp(self.sum(a)), 1),
            Op::PositivePart(a) => Term::of(Factor::PositivePart(self.sum(a)), 1),
            Op::Min(a, b) => Term::of(Factor::Extremum("min", [self.sum(a), self.sum(b)]), 1),
            Op::Rounded(of) => {
                let (name, of) = rounding::notation(of);
                Term::of(Factor::Rounded(name, self.sum(&of)), 1)
            }
        }
    }
}

/// Writes arranged sums and products.
#[derive(Clone, Copy)]
struct Writer {
    notation: Notation,
    /// Whether fractions are written as a / b: in plain text, and where those of LaTeX would be too small.
    inline: bool,
}

impl Writer {
    fn is_latex(self) -> bool {
        self.notation == Notation::Latex
    }

    fn small(self) -> Self {
        Writer { inline: true, ..self }
    }

    fn sum(self, sum: &Sum) -> String {
        let minus = if self.is_latex() { '-' } else { '−' };
        let mut text = String::new();
        for (i, term) in sum.iter().enumerate() {
            text += &match (i, term.negative) {
                (0, false) => String::new(),
                (0, true) => minus.to_string(),
                (_, false) => " + ".to_string(),
                (_, true) => format!(" {minus} "),
            };
            text += &self.term(term);
        }
        text
    }

    fn term(self, Term { over, under, .. }: &Term) -> String {
        if under.is_one() {
            return self.product(over);
        }
        if self.inline {
            let divisor = self.product(under);
            let divisor = if under.pieces() > 1 { self.brackets("(", ")", &divisor) } else { divisor };
            return format!("{} / {divisor}", self.product(over));
        }
        if under.factors.is_empty() {
            let number = format!("\\tfrac{{{}}}{{{}}}", over.number, under.number);
            let rest = Product { number: 1, factors: over.factors.clone() };
            return if rest.is_one() { number } else { format!("{number}\\,{}", self.product(&rest)) };
        }
        format!("\\frac{{{}}}{{{}}}", self.small().standalone(over), self.small().standalone(under))
    }

    /// Writes a product that stands alone, so that a sum needs no brackets.
    fn standalone(self, product: &Product) -> String {
        match &product.factors[..] {
            [(Factor::Group(sum), 1)] if product.number == 1 => self.sum(sum),
            _ => self.product(product),
        }
    }

    fn product(self, product: &Product) -> String {
        let factors: Vec<_> =
            product.factors.iter().map(|(factor, power)| self.power(factor, *power)).collect();
        // Letters are separated by a thin space.
        let factors = factors.join(if self.is_latex() { "\\," } else { " " });
        // 5·2ᵖ, which must not be read as 52ᵖ.
        let times = match factors.starts_with(|c: char| c.is_ascii_digit()) {
            true if self.is_latex() => " \\cdot ",
            true => "·",
            false => " ",
        };
        match (product.number, factors.is_empty()) {
            (number, true) => number.to_string(),
            (1, false) => factors,
            (number, false) => format!("{number}{times}{factors}"),
        }
    }

    /// Writes a factor with an exponent.
    fn base(self, factor: &Factor) -> String {
        let base = self.factor(factor);
        // A base with an exponent of its own needs brackets.
        let needs_brackets = match factor {
            Factor::Name(symbol, _) => {
                symbol.contains('^') || symbol.chars().any(|c| superscript(c).is_some())
            }
            Factor::Exp(_) => self.is_latex(),
            _ => false,
        };
        if needs_brackets { self.brackets("(", ")", &base) } else { base }
    }

    fn power(self, factor: &Factor, power: u32) -> String {
        if power == 1 {
            return self.factor(factor);
        }
        let base = self.base(factor);
        if self.is_latex() {
            return base + &script('^', &power.to_string());
        }
        let digits = power.to_string().into_bytes().into_iter();
        base + &String::from_iter(digits.filter_map(|d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(usize::from(d - b'0'))))
    }

    fn factor(self, factor: &Factor) -> String {
        use Factor::*;
        match factor {
            Name(symbol, arguments) => {
                let symbol = if self.is_latex() { latex(symbol) } else { symbol.clone() };
                if arguments.is_empty() { symbol } else { symbol + &self.list(arguments) }
            }
            Group(sum) => self.brackets("(", ")", &self.sum(sum)),
            Exp(sum) if self.is_latex() => format!("\\mathrm{{e}}^{{{}}}", self.small().sum(sum)),
            Exp(sum) => format!("exp{}", self.brackets("(", ")", &self.sum(sum))),
            PositivePart(sum) if self.is_latex() => self.brackets("\\langle ", " \\rangle", &self.sum(sum)),
            PositivePart(sum) => self.brackets("⟨", "⟩", &self.sum(sum)),
            Size(sum) if self.is_latex() => self.brackets("\\lvert ", " \\rvert", &self.sum(sum)),
            Size(sum) => self.brackets("|", "|", &self.sum(sum)),
            Rounded(name, sum) => {
                let name = if self.is_latex() { format!("\\mathrm{{{name}}}") } else { name.to_string() };
                name + &self.brackets("(", ")", &self.sum(sum))
            }
            Extremum(name, sums) => {
                format!("{}{name}{}", if self.is_latex() { "\\" } else { "" }, self.list(sums))
            }
        }
    }

    fn list(self, sums: &[Sum]) -> String {
        let sums: Vec<_> = sums.iter().map(|sum| self.sum(sum)).collect();
        self.brackets("(", ")", &sums.join(", "))
    }

    /// Writes brackets as high as their content.
    fn brackets(self, open: &str, close: &str, inner: &str) -> String {
        if inner.contains("\\frac") {
            format!("\\left{open}{inner}\\right{}", close.trim_start())
        } else {
            format!("{open}{inner}{close}")
        }
    }
}

#[cfg(test)]
mod tests;
