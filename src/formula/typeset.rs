//! How a formula is written: one layout for the eye, in two notations.
//!
//! The layout says what a formula says and keeps its order, but not its every step: sums and products are
//! flat, signs stand in front of products and numbers at their head, equal factors are a power, and a factor
//! 1 or a summand 0 is not written. Brackets are where they are needed and nowhere else.

use crate::number::Tree;
use crate::number::tree::Step;
use std::fmt;

/// How symbols and structure become characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// `u = (ε (H − l) + m g) / (c + ε)`
    Text,
    /// `u = \frac{\varepsilon\,(H - l) + m\,g}{c + \varepsilon}`
    Latex,
}

/// What a part of a formula is called, if it is to be named instead of written out.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// Its symbol, as a text writes it: `Π`, `u_{k−1}`, `λ₀`.
    pub symbol: String,
    /// What it is taken of, where that has to be said: the Δ of `Π(Δ)`.
    pub arguments: Vec<Tree>,
}

impl Tree {
    /// The formula in LaTeX.
    ///
    /// ```
    /// use spring_mass_contact::number::{Field, Tree};
    /// let [c, u] = ["c", "u"].map(|name| Tree::symbol(name));
    /// assert_eq!((c * &u * &u / Tree::int(2)).latex(), r"\tfrac{1}{2}\,c\,u^2");
    /// ```
    pub fn latex(&self) -> String {
        self.typeset(Notation::Latex, &|_| None)
    }

    /// The formula, with the parts that `name` knows by their names.
    pub fn typeset(&self, notation: Notation, name: &dyn Fn(&Tree) -> Option<Name>) -> String {
        let sum = Layout { name }.sum(self);
        Writer { notation, inline: notation == Notation::Text }.sum(&sum)
    }
}

/// The formula as plain text.
impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.typeset(Notation::Text, &|_| None))
    }
}

/// Terms to be added; never empty.
type Sum = Vec<Term>;

/// A product over another, with its sign.
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
        match self.factors.iter_mut().find(|(own, _)| *own == factor) {
            Some((_, own)) => *own += power,
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
        if a > 1 && self.under.number != 0 {
            self.over.number /= a;
            self.under.number /= a;
        }
        if self.is_zero() { Term::over(Product::number(0)) } else { self }
    }

    fn is_zero(&self) -> bool {
        self.over.number == 0 && self.under.number != 0
    }

    /// Its only factor, if it is nothing else.
    fn only(&self) -> Option<&Factor> {
        match &self.over.factors[..] {
            [(factor, 1)] if self.over.number == 1 && self.under.is_one() => Some(factor),
            _ => None,
        }
    }
}

/// Arranges what is to be written.
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
        // −min(−a, b) reads better as max(a, −b).
        if let [term] = &mut sum[..]
            && term.negative
            && let Some(Factor::Extremum("min", [a, b])) = term.only()
            && (a[0].negative || b[0].negative)
        {
            let negated = |sum: &Sum| sum.iter().cloned().map(Term::negated).collect();
            *term = Term::of(Factor::Extremum("max", [negated(a), negated(b)]), 1);
        }
        sum
    }

    fn collect(&self, tree: &Tree, negative: bool, sum: &mut Sum) {
        match tree.step() {
            _ if (self.name)(tree).is_some() => {}
            Step::Neg(a) => return self.collect(a, !negative, sum),
            Step::Add(a, b) => {
                self.collect(a, negative, sum);
                return self.collect(b, negative, sum);
            }
            Step::Sub(a, b) => {
                self.collect(a, negative, sum);
                return self.collect(b, !negative, sum);
            }
            _ => {}
        }
        let mut term = self.term(tree);
        term.negative ^= negative;
        match term.only() {
            // What is left of 1 (a + b).
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
        match tree.step() {
            Step::Symbol(name) => Term::of(Factor::Name(name.to_string(), Vec::new()), 1),
            Step::Int(n) => {
                let number = Term::over(Product::number(n.unsigned_abs().into()));
                Term { negative: *n < 0, ..number }
            }
            Step::Neg(a) => self.term(a).negated(),
            Step::Add(..) | Step::Sub(..) => match <[Term; 1]>::try_from(self.sum(tree)) {
                Ok([term]) => term,
                Err(sum) => Term::of(Factor::Group(sum), 1),
            },
            Step::Mul(a, b) => {
                let (first, second) = (self.term(a), self.term(b));
                // The square of a product stays one: (m g)² and not m² g².
                if a == b && first.over.pieces() + first.under.pieces() > 1 {
                    return Term::of(Factor::Group(vec![Term { negative: false, ..first }]), 2);
                }
                first.times(second)
            }
            Step::Div(a, b) => self.term(a).times(self.term(b).inverse()),
            Step::Exp(a) => Term::of(Factor::Exp(self.sum(a)), 1),
            Step::PositivePart(a) => Term::of(Factor::PositivePart(self.sum(a)), 1),
            Step::Min(a, b) => Term::of(Factor::Extremum("min", [self.sum(a), self.sum(b)]), 1),
        }
    }
}

/// Writes what is arranged.
#[derive(Clone, Copy)]
struct Writer {
    notation: Notation,
    /// With a / b for fractions: in a line of text, and where LaTeX's would become too small.
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
            let brackets = under.pieces() > 1;
            let under = self.product(under);
            let under = if brackets { self.brackets("(", ")", &under) } else { under };
            return format!("{} / {under}", self.product(over));
        }
        if under.factors.is_empty() {
            let number = format!("\\tfrac{{{}}}{{{}}}", over.number, under.number);
            let rest = Product { number: 1, factors: over.factors.clone() };
            return if rest.is_one() { number } else { format!("{number}\\,{}", self.product(&rest)) };
        }
        format!("\\frac{{{}}}{{{}}}", self.small().whole(over), self.small().whole(under))
    }

    /// A product that stands by itself: a sum needs no brackets.
    fn whole(self, product: &Product) -> String {
        match &product.factors[..] {
            [(Factor::Group(sum), 1)] if product.number == 1 => self.sum(sum),
            _ => self.product(product),
        }
    }

    fn product(self, product: &Product) -> String {
        let factors: Vec<_> =
            product.factors.iter().map(|(factor, power)| self.power(factor, *power)).collect();
        // Unlike a number, letters want a little space between them.
        let factors = factors.join(if self.is_latex() { "\\," } else { " " });
        match (product.number, factors.is_empty()) {
            (number, true) => number.to_string(),
            (1, false) => factors,
            (number, false) => format!("{number} {factors}"),
        }
    }

    fn power(self, factor: &Factor, power: u32) -> String {
        let base = self.factor(factor);
        if power == 1 {
            return base;
        }
        // A base that has an exponent of its own.
        let raised = match factor {
            Factor::Name(symbol, _) => {
                symbol.contains('^') || symbol.chars().any(|c| superscript(c).is_some())
            }
            Factor::Exp(_) => self.is_latex(),
            _ => false,
        };
        let base = if raised { self.brackets("(", ")", &base) } else { base };
        if self.is_latex() {
            return base + &script('^', &power.to_string());
        }
        let digits = power.to_string();
        base + &digits
            .chars()
            .filter_map(|d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d as usize - '0' as usize))
            .collect::<String>()
    }

    fn factor(self, factor: &Factor) -> String {
        match factor {
            Factor::Name(symbol, arguments) => {
                let symbol = if self.is_latex() { latex(symbol) } else { symbol.clone() };
                if arguments.is_empty() { symbol } else { symbol + &self.list(arguments) }
            }
            Factor::Group(sum) => self.brackets("(", ")", &self.sum(sum)),
            Factor::Exp(sum) if self.is_latex() => format!("e^{{{}}}", self.small().sum(sum)),
            Factor::Exp(sum) => format!("exp{}", self.brackets("(", ")", &self.sum(sum))),
            Factor::PositivePart(sum) if self.is_latex() => {
                self.brackets("\\langle ", " \\rangle", &self.sum(sum))
            }
            Factor::PositivePart(sum) => self.brackets("⟨", "⟩", &self.sum(sum)),
            Factor::Extremum(name, sums) => {
                format!("{}{name}{}", if self.is_latex() { "\\" } else { "" }, self.list(sums))
            }
        }
    }

    fn list(self, sums: &[Sum]) -> String {
        let sums: Vec<_> = sums.iter().map(|sum| self.sum(sum)).collect();
        self.brackets("(", ")", &sums.join(", "))
    }

    /// Brackets that are as high as what they hold.
    fn brackets(self, open: &str, close: &str, inner: &str) -> String {
        if inner.contains("\\frac") {
            format!("\\left{open}{inner}\\right{}", close.trim_start())
        } else {
            format!("{open}{inner}{close}")
        }
    }
}

const LETTERS: &[(char, &str)] = &[
    ('α', "\\alpha"),
    ('δ', "\\delta"),
    ('ε', "\\varepsilon"),
    ('η', "\\eta"),
    ('λ', "\\lambda"),
    ('μ', "\\mu"),
    ('ρ', "\\rho"),
    ('Δ', "\\Delta"),
    ('Λ', "\\Lambda"),
    ('Π', "\\Pi"),
    ('𝓛', "\\mathcal{L}"),
    ('∂', "\\partial"),
    ('…', "\\cdots"),
    ('′', "'"),
    ('−', "-"),
];

/// The dot above the letter before it.
const DOT: char = '\u{307}';

fn subscript(c: char) -> Option<char> {
    "₀₁₂₃₄₅₆₇₈₉".chars().position(|own| own == c).and_then(|i| char::from_digit(i as u32, 10))
}

fn superscript(c: char) -> Option<char> {
    let (own, plain) = ("⁰¹²³⁴⁵⁶⁷⁸⁹ᵏ⁺", "0123456789k+");
    own.chars().position(|own| own == c).and_then(|i| plain.chars().nth(i))
}

/// An index or an exponent, in braces if it takes more than one character.
fn script(kind: char, inner: &str) -> String {
    if inner.chars().count() == 1 { format!("{kind}{inner}") } else { format!("{kind}{{{inner}}}") }
}

/// A symbol of a text in LaTeX, character by character; words and indices that are words stand upright.
///
/// ```
/// use spring_mass_contact::formula::latex;
/// assert_eq!(["λ₀", "u_{k−1}", "ε_eff", "u̇"].map(latex), [r"\lambda_0", "u_{k-1}", r"\varepsilon_{\mathrm{eff}}", r"\dot{u}"]);
/// ```
pub fn latex(symbol: &str) -> String {
    let mut result = String::new();
    let mut rest = symbol;
    // A command ends where no letter follows.
    let push = |result: &mut String, next: &str| {
        let command = result
            .rsplit_once('\\')
            .is_some_and(|(_, name)| !name.is_empty() && name.chars().all(|c| c.is_ascii_alphabetic()));
        if command && next.starts_with(|c: char| c.is_ascii_alphabetic()) {
            result.push(' ');
        }
        *result += next;
    };
    while let Some(c) = rest.chars().next() {
        let run = |belongs: &dyn Fn(char) -> bool| rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        let after = &rest[c.len_utf8()..];
        if c == '_' || c == '^' {
            let inner = match after.strip_prefix('{').and_then(|inner| inner.split_once('}')) {
                Some((inner, left)) => {
                    rest = left;
                    inner
                }
                None => {
                    let end = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
                    rest = &after[end..];
                    &after[..end]
                }
            };
            result += &script(c, &latex(inner));
        } else if subscript(c).is_some() {
            let end = run(&|c| subscript(c).is_some());
            result += &script('_', &rest[..end].chars().filter_map(subscript).collect::<String>());
            rest = &rest[end..];
        } else if superscript(c).is_some() {
            let end = run(&|c| superscript(c).is_some());
            result += &script('^', &rest[..end].chars().filter_map(superscript).collect::<String>());
            rest = &rest[end..];
        } else if let Some(left) = after.strip_prefix(DOT) {
            push(&mut result, &format!("\\dot{{{}}}", latex(&c.to_string())));
            rest = left;
        } else if c.is_ascii_alphabetic() {
            let end = run(&|c| c.is_ascii_alphabetic());
            // A letter with a dot is none of the word before it.
            let end = if rest[end..].starts_with(DOT) { end - 1 } else { end };
            match &rest[..end] {
                word @ ("min" | "max" | "lim") => push(&mut result, &format!("\\{word}")),
                word if word.len() > 1 => push(&mut result, &format!("\\mathrm{{{word}}}")),
                letter => push(&mut result, letter),
            }
            rest = &rest[end..];
        } else {
            match LETTERS.iter().find(|(own, _)| *own == c) {
                Some((_, command)) => push(&mut result, command),
                None => result.push(c),
            }
            rest = after;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Exponential, Field, PositivePart};

    fn s(name: &'static str) -> Tree {
        Tree::symbol(name)
    }

    fn n(n: i32) -> Tree {
        Tree::int(n)
    }

    /// Each tree with its text and its LaTeX.
    fn check(cases: &[(Tree, &str, &str)]) {
        for (tree, text, latex) in cases {
            assert_eq!(
                (tree.to_string().as_str(), tree.latex().as_str()),
                (*text, *latex),
                "{:?}",
                tree.step()
            );
        }
    }

    #[test]
    fn signs_come_out_of_brackets_and_products() {
        let [a, b, c] = ["a", "b", "c"].map(s);
        check(&[
            (-(&a - &b), "−a + b", "-a + b"),
            (&a - (&b - &c), "a − b + c", "a - b + c"),
            (&a - (&b + &c), "a − b − c", "a - b - c"),
            (&a + -&b, "a − b", "a - b"),
            (&a - -&b, "a + b", "a + b"),
            (-(-&a), "a", "a"),
            (&a - n(-2), "a + 2", "a + 2"),
            (-&a * (&b - &c), "−a (b − c)", r"-a\,(b - c)"),
            (&a - -&b * (-&c), "a − b c", r"a - b\,c"),
            (&a * -&b, "−a b", r"-a\,b"),
            (n(-2) * &a, "−2 a", "-2 a"),
            (-(&a - &b) / &c, "−(a − b) / c", r"-\frac{a - b}{c}"),
            (-(&a - &b) * &c, "−(a − b) c", r"-(a - b)\,c"),
            (&a - -&b / &c, "a + b / c", r"a + \frac{b}{c}"),
            (&a / -&b, "−a / b", r"-\frac{a}{b}"),
        ]);
    }

    #[test]
    fn products_are_flat_with_their_number_first() {
        let [a, b, c, p] = ["a", "b", "c", "p"].map(s);
        check(&[
            (&a * n(4) * &b * n(3), "12 a b", r"12 a\,b"),
            (&a * (&b * &c), "a b c", r"a\,b\,c"),
            (&a * &p * &p / n(2), "a p² / 2", r"\tfrac{1}{2}\,a\,p^2"),
            (n(3) * &a / n(2), "3 a / 2", r"\tfrac{3}{2}\,a"),
            (&p * &p * (&p * &p), "p⁴", "p^4"),
            ((&a - &b) * (&a - &b), "(a − b)²", "(a - b)^2"),
            ((&a - &b) * &c * (&a - &b), "(a − b)² c", r"(a - b)^2\,c"),
            (-((&a * &b) * (&a * &b)) / (n(2) * &c), "−(a b)² / (2 c)", r"-\frac{(a\,b)^2}{2 c}"),
            (n(1) * &a, "a", "a"),
            (n(1) * (&a - &b) + &c, "a − b + c", "a - b + c"),
            (&c - n(1) * (&a - &b), "c − a + b", "c - a + b"),
            (&a * n(0) + &b, "b", "b"),
            (&a * n(0), "0", "0"),
            (&a - &a * n(0) / &b, "a", "a"),
            (n(2) * &a / n(2), "a", "a"),
            (n(2) / n(4) * &a, "a / 2", r"\tfrac{1}{2}\,a"),
            (n(1) / n(2), "1 / 2", r"\tfrac{1}{2}"),
            ((0..12).fold(n(1), |x, _| x * &a), "a¹²", "a^{12}"),
            (n(-1), "−1", "-1"),
            (&a / n(0), "a / 0", r"\tfrac{1}{0}\,a"),
        ]);
    }

    #[test]
    fn large_numbers_do_not_overflow() {
        let large = n(i32::MAX) * n(i32::MAX) * n(i32::MAX);
        assert_eq!(large.to_string(), "4611686014132420609 (2147483647)");
        assert_eq!(n(i32::MIN).to_string(), "−2147483648");
    }

    #[test]
    fn fractions_have_the_brackets_they_need() {
        let [a, b, c, d] = ["a", "b", "c", "d"].map(s);
        check(&[
            (&a * &b / &c, "a b / c", r"\frac{a\,b}{c}"),
            (&a / (&b * &c), "a / (b c)", r"\frac{a}{b\,c}"),
            (&a / &b / &c, "a / (b c)", r"\frac{a}{b\,c}"),
            (&a / (&b / &c), "a c / b", r"\frac{a\,c}{b}"),
            ((&a + &b) / (&c + &d), "(a + b) / (c + d)", r"\frac{a + b}{c + d}"),
            ((&a + &b) * &d / (n(2) * (&c + &d)), "(a + b) d / (2 (c + d))", r"\frac{(a + b)\,d}{2 (c + d)}"),
            ((&a + &b) / n(2), "(a + b) / 2", r"\tfrac{1}{2}\,(a + b)"),
            (&a / (&b * &b), "a / b²", r"\frac{a}{b^2}"),
            (n(1) / (n(1) + &a), "1 / (1 + a)", r"\frac{1}{1 + a}"),
            ((&a + &b / &c) / (&c / &b + n(1)), "(a + b / c) / (c / b + 1)", r"\frac{a + b / c}{c / b + 1}"),
            (&a * (&b - &c / &d), "a (b − c / d)", r"a\,\left(b - \frac{c}{d}\right)"),
            (&a - &b / &c, "a − b / c", r"a - \frac{b}{c}"),
            ((&a - &b) / &c - &d, "(a − b) / c − d", r"\frac{a - b}{c} - d"),
        ]);
    }

    #[test]
    fn functions_bring_their_own_brackets() {
        let [a, b, c] = ["a", "b", "c"].map(s);
        let decay = (-&b / (&b + &c) * &a).exp();
        let fraction = (&a / &b).positive_part();
        check(&[
            (&c * &decay, "c exp(−b a / (b + c))", r"c\,e^{-b\,a / (b + c)}"),
            (&decay * &decay, "exp(−b a / (b + c))²", r"(e^{-b\,a / (b + c)})^2"),
            ((&a - &b).positive_part(), "⟨a − b⟩", r"\langle a - b \rangle"),
            (-&c * fraction, "−c ⟨a / b⟩", r"-c\,\left\langle \frac{a}{b}\right\rangle"),
            ((&a / &b).min(&(&b - &c)), "min(a / b, b − c)", r"\min\left(\frac{a}{b}, b - c\right)"),
            (-(-&a).min(&(&b / &c)), "max(a, −b / c)", r"\max\left(a, -\frac{b}{c}\right)"),
            (-a.min(&b), "−min(a, b)", r"-\min(a, b)"),
            (&c - (-&a).min(&b), "c − min(−a, b)", r"c - \min(-a, b)"),
        ]);
    }

    #[test]
    fn parts_go_by_their_names() {
        let [l, u, h] = ["l", "u", "H"].map(s);
        let (p, gap) = (&l + &u - &h, &h - &l);
        let name = |tree: &Tree| {
            let name = |symbol: &str, arguments| Some(Name { symbol: symbol.to_string(), arguments });
            if *tree == p {
                name("p", vec![])
            } else if *tree == gap {
                name("Δ", vec![])
            } else if *tree == -&gap {
                name("Π", vec![gap.clone()])
            } else {
                None
            }
        };
        let tree = &u - &p * &p / (n(2) * &gap) + -&gap * &p;
        assert_eq!(tree.typeset(Notation::Text, &name), "u − p² / (2 Δ) + Π(Δ) p");
        assert_eq!(tree.typeset(Notation::Latex, &name), r"u - \frac{p^2}{2 \Delta} + \Pi(\Delta)\,p");
        assert_eq!((-&p).typeset(Notation::Text, &name), "−p");
        assert_eq!((&u - &p).typeset(Notation::Text, &name), "u − p");
    }

    #[test]
    fn a_name_with_an_exponent_is_bracketed_before_it_gets_another() {
        check(&[
            (s("ρᵏ") * s("ρᵏ"), "(ρᵏ)²", r"(\rho^k)^2"),
            (s("λ₀") * s("λ₀"), "λ₀²", r"\lambda_0^2"),
            (s("x^{k+1}") * s("x^{k+1}"), "(x^{k+1})²", "(x^{k+1})^2"),
        ]);
    }

    #[test]
    fn symbols_become_latex() {
        for (symbol, expected) in [
            ("u", "u"),
            ("ε₄", r"\varepsilon_4"),
            ("s₁₂", "s_{12}"),
            ("ρᵏ", r"\rho^k"),
            ("ρᵏ⁺¹", r"\rho^{k+1}"),
            ("δu", r"\delta u"),
            ("δΠ", r"\delta\Pi"),
            ("u_h", "u_h"),
            ("u_nh", r"u_{\mathrm{nh}}"),
            ("u_{k+1}", "u_{k+1}"),
            ("λ_{k−1}", r"\lambda_{k-1}"),
            ("Π_p", r"\Pi_p"),
            ("𝓛", r"\mathcal{L}"),
            ("λ′", r"\lambda'"),
            ("tol", r"\mathrm{tol}"),
            ("min Π_p", r"\min \Pi_p"),
            ("∂L/∂u", r"\partial L/\partial u"),
            ("su̇", r"s\dot{u}"),
            ("(1 + ε/c)^{k+1}", r"(1 + \varepsilon/c)^{k+1}"),
        ] {
            assert_eq!(latex(symbol), expected);
        }
    }
}
