//! The text of a formula, parsed independently, has the value of its tree.

use crate::strategies::runner::holds_often;
use proptest::prelude::*;
use spring_mass_contact::claims::registry;
use spring_mass_contact::formula::claim::POWER;
use spring_mass_contact::number::tree::{Op, piecewise_ops};
use spring_mass_contact::number::{Exact, Exponential, Field, PositivePart, Tree};
use std::iter;
use std::sync::LazyLock;

/// An exponential is not rational: any function without accidental zeros or repetitions can replace it.
fn exp(x: &Exact) -> Exact {
    x * x * x + x + Exact::from(7)
}

fn value(name: &str) -> Exact {
    let seed = name.bytes().fold(7, |seed, byte| (seed + i32::from(byte)).pow(2) % 10_007);
    Exact::from(seed - 5000) / Exact::from(97)
}

/// Precision of rounding.
const BITS: u32 = 5;

/// Returns the number for a symbol: 2ᵃ is a power of two.
fn at(name: &str) -> Exact {
    match name {
        "2ᵃ" => Exact::power_of_two(-3),
        "2ᵇ" => Exact::power_of_two(2),
        "2ᶠ" => Exact::power_of_two(5),
        "2ᵖ" => Exact::power_of_two(BITS as i32),
        name => value(name),
    }
}

/// Parser of printed formulas that returns their values, or `None` if a formula divides by zero. It follows
/// the rules of the text and does not use the code that prints it.
///
/// Inside fl( ) the result of every + − × ÷, power and exp is rounded, from the left; scaling by a power of
/// two is exact, and so is the content of ⟨ ⟩, | |, min or max. Inside nearest( ) everything is exact and is
/// rounded once.
struct Reader<'a> {
    rest: &'a str,
    rounding: bool,
}

/// All symbols of the tests and of the chapter; those that begin with another precede it.
static SYMBOLS: LazyLock<Vec<&str>> = LazyLock::new(|| {
    let of_formulas = registry().formulas().iter().flat_map(|formula| formula.tree.symbols());
    let mut all: Vec<_> = OWN.into_iter().chain(of_formulas).collect();
    all.sort_by_key(|name| (std::cmp::Reverse(name.len()), *name));
    all.dedup();
    all
});

impl<'a> Reader<'a> {
    fn new(rest: &'a str) -> Self {
        Reader { rest, rounding: false }
    }

    fn value(tree: &Tree) -> Option<Exact> {
        Reader::new(&tree.to_string()).all()
    }

    /// Returns the value of the whole text.
    fn all(mut self) -> Option<Exact> {
        let (text, value) = (self.rest, self.sum());
        assert!(value.is_none() || self.rest.is_empty(), "{text}: left {}", self.rest);
        value
    }

    fn eat(&mut self, token: &str) -> bool {
        let rest = self.rest.strip_prefix(token);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn rounded(&self, x: Exact) -> Exact {
        if self.rounding { x.round_to_bits(BITS).unwrap() } else { x }
    }

    /// Parses the content of brackets, with or without rounding.
    fn inside<T>(&mut self, rounding: bool, read: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        let outside = std::mem::replace(&mut self.rounding, rounding);
        let inner = read(self);
        self.rounding = outside;
        inner
    }

    fn sum(&mut self) -> Option<Exact> {
        let mut sum = if self.eat("−") { -self.term()? } else { self.term()? };
        loop {
            if self.eat(" + ") {
                sum = sum + self.term()?;
            } else if self.eat(" − ") {
                sum = sum - self.term()?;
            } else {
                return Some(sum);
            }
            sum = self.rounded(sum);
        }
    }

    fn term(&mut self) -> Option<Exact> {
        let (mut product, mut exact) = self.factor()?;
        while self.rest.starts_with(['·', ' '])
            && ![" + ", " − ", " / "].iter().any(|s| self.rest.starts_with(s))
        {
            assert!(self.eat("·") || self.eat(" "));
            let (factor, scale) = self.factor()?;
            product = product * factor;
            product = if exact || scale { product } else { self.rounded(product) };
            exact &= scale;
        }
        if !self.eat(" / ") {
            return Some(product);
        }
        let (under, scale) = self.factor()?;
        let quotient = under.is_invertible().then(|| product / under)?;
        Some(if scale { quotient } else { self.rounded(quotient) })
    }

    /// Parses a factor; the flag is `true` for a power of two, scaling by which is exact.
    fn factor(&mut self) -> Option<(Exact, bool)> {
        let is_scale = |scale| self.rest.starts_with(scale) || self.rest.starts_with(&format!("({scale})"));
        let scale = ["2ᵃ", "2ᵇ", "2ᶠ"].into_iter().any(is_scale);
        let base = self.base()?;
        let digits: Vec<_> =
            self.rest.chars().map_while(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c)).collect();
        self.rest = &self.rest[self.rest.chars().take(digits.len()).map(char::len_utf8).sum::<usize>()..];
        let power = digits.iter().fold(0, |power, digit| 10 * power + digit);
        let times = |product: Exact, _| if scale { product * &base } else { self.rounded(product * &base) };
        Some(((1..power).fold(base.clone(), times), scale))
    }

    fn base(&mut self) -> Option<Exact> {
        let digits = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
        // A power of two has a name that begins with a number.
        let named = SYMBOLS.iter().any(|name| name.len() > digits && self.rest.starts_with(name));
        if digits > 0 && !named {
            let number = self.rest[..digits].parse().unwrap();
            self.rest = &self.rest[digits..];
            return Some(number);
        }
        let closed = |reader: &mut Self, bracket: &str| {
            assert!(reader.eat(bracket), "no {bracket} before {:?}", reader.rest)
        };
        for (name, function) in [("min(", false), ("max(", true)] {
            if self.eat(name) {
                let [a, b] = self.inside(false, |reader| {
                    let a = reader.sum()?;
                    closed(reader, ", ");
                    Some([a, reader.sum()?])
                })?;
                closed(self, ")");
                return Some(if function { -PositivePart::min(&-a, &-b) } else { PositivePart::min(&a, &b) });
            }
        }
        for (open, close) in
            [("exp(", ")"), ("⟨", "⟩"), ("|", "|"), ("(", ")"), ("fl(", ")"), ("nearest(", ")")]
        {
            if self.eat(open) {
                let rounding = open == "fl(" || self.rounding && ["exp(", "("].contains(&open);
                let inner = self.inside(rounding, |reader| reader.sum())?;
                closed(self, close);
                return Some(match open {
                    "exp(" => self.rounded(exp(&inner)),
                    "⟨" => inner.positive_part(),
                    "|" => inner.abs(),
                    "(" => inner,
                    _ => inner.round_to_bits(BITS).unwrap(),
                });
            }
        }
        let name = SYMBOLS.iter().find(|name| self.eat(name));
        Some(at(name.unwrap_or_else(|| panic!("neither number nor symbol: {}", self.rest))))
    }
}

fn replayed(tree: &Tree) -> Option<Exact> {
    let beyond = |step: Op<&Exact>| match step {
        Op::Exp(a) => Some(exp(a)),
        Op::Rounded(a) => a.round_to_bits(BITS),
        step => piecewise_ops(step),
    };
    tree.eval(&|name| at(name), &beyond)
}

/// Symbols in sampled trees. k is the index of steps unless another quantity is named k.
const OWN: [&str; 11] = ["a", "b", "u", "k", "ρ", "λ₀", "ρᵏ", "u_{k+1}", "2ᵖ", "2ᵃ", POWER];

/// An operation with its relative frequency, which takes its operands from the last results.
type Operation = (usize, fn(&mut dyn FnMut() -> Tree) -> Tree);

/// Sums of formulas in reverse Polish notation, of fewer than `end` leaves and operations; the first leaf stands for an
/// operand that is missing. Nested unions of strategies would take most of a test's time.
fn composed(leaves: Vec<Tree>, operations: &[Operation], end: usize) -> BoxedStrategy<Tree> {
    let operations = operations.iter().flat_map(|(often, operation)| iter::repeat_n(*operation, *often));
    let operations: Vec<_> = operations.collect();
    let steps = prop::collection::vec((any::<bool>(), any::<usize>()), 1..end);
    let sum = steps.prop_map(move |steps| {
        let mut results = Vec::new();
        for (is_operation, i) in steps {
            let mut operand = || results.pop().unwrap_or_else(|| leaves[0].clone());
            let result = match is_operation {
                true => operations[i % operations.len()](&mut operand),
                false => leaves[i % leaves.len()].clone(),
            };
            results.push(result);
        }
        results.into_iter().reduce(|a, b| a + b).expect("there is a step")
    });
    sum.boxed()
}

fn squared(x: &Tree) -> Tree {
    x * x
}

fn trees() -> BoxedStrategy<Tree> {
    // Three of four leaves are symbols.
    let symbols = OWN.into_iter().chain(OWN).map(|name| Tree::symbol(name));
    let leaves = symbols.chain((-3..4).map(Tree::int)).collect();
    composed(
        leaves,
        &[
            (3, |x| x() + x()),
            (3, |x| x() - x()),
            (4, |x| x() * x()),
            (2, |x| x() / x()),
            (1, |x| x().min(&x())),
            (2, |x| -x()),
            (1, |x| squared(&x())),
            (1, |x| x().exp()),
            (1, |x| x().abs()),
            (1, |x| x().positive_part()),
        ],
        20,
    )
}

/// Trees with roundings: of all operations, of some, or of the last only.
fn rounded_trees() -> BoxedStrategy<Tree> {
    let some = (trees(), any::<u64>()).prop_map(|(tree, seed)| {
        let chosen = std::cell::Cell::new(seed);
        tree.rewrite(&|tree| {
            chosen.set(chosen.get().rotate_left(7).wrapping_mul(0x9e37_79b9_7f4a_7c15));
            (chosen.get() % 3 > 0).then(|| tree.round())
        })
    });
    let once = trees().prop_map(|tree| tree.round());
    let steps = trees().prop_map(|tree| tree.with_rounding());
    prop_oneof![2 => some, 1 => once, 3 => steps].boxed()
}

/// Returns LaTeX as the text that it displays: fractions as quotients in brackets, exponents as superscripts.
fn shown(latex: &str) -> String {
    // What is in braces, and the rest.
    fn braced(latex: &str) -> (&str, &str) {
        let inner = latex.strip_prefix('{').unwrap_or_else(|| panic!("{latex}: no brace"));
        let mut depth = 1;
        let end = inner.find(|c| {
            depth += match c {
                '{' => 1,
                '}' => -1,
                _ => 0,
            };
            depth == 0
        });
        let end = end.unwrap_or_else(|| panic!("{latex}: open"));
        (&inner[..end], &inner[end + 1..])
    }
    let mut symbols: Vec<_> =
        OWN.iter().map(|name| (spring_mass_contact::formula::latex(name), *name)).collect();
    symbols.sort_by_key(|(own, _)| std::cmp::Reverse(own.len()));
    let (mut text, mut rest) = (String::new(), latex);
    while !rest.is_empty() {
        if let Some(both) = rest.strip_prefix("\\frac").or(rest.strip_prefix("\\tfrac")) {
            let ((over, rest_of), is_number) = (braced(both), rest.starts_with("\\t"));
            let (under, after) = braced(rest_of);
            let quotient = format!("({}) / ({})", shown(over), shown(under));
            text += &if is_number { format!("({quotient})") } else { quotient };
            rest = after;
            continue;
        }
        if let Some(exponent) = rest.strip_prefix("\\mathrm{e}^") {
            let (exponent, after) = braced(exponent);
            text += &format!("exp({})", shown(exponent));
            rest = after;
            continue;
        }
        if let Some((own, name)) = symbols.iter().find(|(own, _)| rest.starts_with(own.as_str())) {
            text += name;
            rest = &rest[own.len()..];
            continue;
        }
        if let Some(exponent) = rest.strip_prefix('^') {
            let (digits, after) =
                if exponent.starts_with('{') { braced(exponent) } else { exponent.split_at(1) };
            text.extend(
                digits.chars().map(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10).unwrap() as usize).unwrap()),
            );
            rest = after;
            continue;
        }
        const SIGNS: [(&str, &str); 14] = [
            ("\\,", " "),
            (" \\cdot ", "·"),
            ("\\langle ", "⟨"),
            ("\\left\\langle ", "⟨"),
            (" \\rangle", "⟩"),
            ("\\right\\rangle", "⟩"),
            ("\\lvert ", "|"),
            ("\\left\\lvert ", "|"),
            (" \\rvert", "|"),
            ("\\right\\rvert", "|"),
            ("\\left(", "("),
            ("\\right)", ")"),
            ("\\m", "m"),
            ("-", "−"),
        ];
        if let Some((sign, own)) = SIGNS.iter().find(|(sign, _)| rest.starts_with(sign)) {
            text += own;
            rest = &rest[sign.len()..];
            continue;
        }
        let c = rest.chars().next().unwrap();
        text.push(c);
        rest = &rest[c.len_utf8()..];
    }
    text
}

/// Returns the round brackets of a text, each with its position and its content.
fn brackets(text: &str) -> Vec<(usize, &str)> {
    let (mut open, mut all) = (Vec::new(), Vec::new());
    for (i, c) in text.char_indices() {
        match c {
            '(' => open.push(i),
            ')' => {
                let start = open.pop().expect("a bracket that is open");
                all.push((start, &text[start + 1..i]));
            }
            _ => {}
        }
    }
    assert!(open.is_empty(), "{text}");
    all
}

#[test]
fn a_text_has_the_value_of_its_tree() {
    holds_often(32, trees(), |tree| {
        if let Some(expected) = replayed(tree) {
            assert_eq!(Reader::value(tree), Some(expected), "{}", tree);
        }
    });
}

#[test]
fn latex_has_the_value_of_its_tree() {
    holds_often(32, trees(), |tree| {
        if let Some(expected) = replayed(tree) {
            let latex = tree.latex();
            assert!(!latex.contains(['²', '·', 'ᵖ', '−']), "{}", latex);
            // No blank is seen.
            let digit = |piece: Option<char>| piece.is_some_and(|c| c.is_ascii_digit());
            let pieces: Vec<_> = latex.split(' ').collect();
            let runs = |pair: &[&str]| digit(pair[0].chars().last()) && digit(pair[1].chars().next());
            assert!(!pieces.windows(2).any(runs), "{}", latex);
            assert_eq!(Reader::new(&shown(&latex)).all(), Some(expected), "{}", latex);
        }
    });
}

#[test]
fn a_text_with_rounding_has_the_value_of_its_tree() {
    holds_often(32, rounded_trees(), |tree| {
        if let Some(expected) = replayed(tree) {
            assert_eq!(Reader::value(tree), Some(expected), "{}", tree);
        }
    });
}

#[test]
fn a_text_has_no_redundant_signs_or_brackets() {
    let defined = trees().prop_filter("divides by zero", |tree| replayed(tree).is_some());
    holds_often(32, defined, |tree| {
        let text = tree.to_string();
        for idle in ["−−", "− −", "+ −", "+ 0", "− 0"] {
            assert!(!text.contains(idle), "{}", text);
        }
        let words: Vec<_> = text.split(' ').collect();
        for pair in words.windows(2).filter(|pair| pair[0].trim_start_matches(['(', '⟨', '−']) == "1") {
            assert!(["+", "−", "/"].contains(&pair[1]), "{}", text);
        }
        for (open, inner) in brackets(&text) {
            // Those of a function, or around a sum, a product or an exponent; and never around all.
            let function = text[..open].ends_with(char::is_alphabetic);
            assert!(
                function || inner.contains([' ', 'ᵏ', 'ᵖ', 'ᵃ']) && inner.len() + 2 < text.len(),
                "{}",
                text
            );
        }
        let latex = tree.latex();
        for (open, close) in
            [("{", "}"), ("(", ")"), ("\\left", "\\right"), ("\\langle", "\\rangle"), ("\\lvert", "\\rvert")]
        {
            let count = |token: &str| latex.replace("\\rightarrow", "").matches(token).count();
            assert_eq!(count(open), count(close), "{}", &latex);
        }
    });
}

#[test]
fn every_formula_of_the_chapter_has_the_value_of_its_text() {
    for formula in registry().formulas() {
        let expected = replayed(&formula.tree);
        assert!(expected.is_some(), "{}", formula.name());
        assert_eq!(Reader::value(&formula.tree), expected, "{}: {}", formula.name(), formula.tree);
    }
}
