//! The text of a formula, parsed independently, has the value of its tree.

use crate::strategies::runner::{cases, holds_often};
use proptest::prelude::*;
use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::formula::claim::{
    MEMBERS, POWER, derivative, equal, geometric_limit, induction, limit, non_negative, perturbed_recursion,
    positive, within,
};
use spring_mass_contact::formula::statement::{Role, Sequence};
use spring_mass_contact::formula::{Formula, Hypothesis, Proposition, Rate, Registry, Relation, Statement};
use spring_mass_contact::number::tree::{Op, piecewise_ops};
use spring_mass_contact::number::{Exact, Exponential, Field, PositivePart, Tree};
use spring_mass_contact::proof::prove;
use spring_mass_contact::proof::render::ProofPrinter;
use std::collections::BTreeMap;
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
    /// Registry whose names may abbreviate formulas, and the arguments that may be omitted from a call if
    /// they are unchanged.
    registry: &'a Registry,
    quiet: &'a [&'static str],
    /// Numbers for symbols.
    at: &'a dyn Fn(&str) -> Exact,
    rounding: bool,
}

/// All symbols of the tests and of the chapter; those that begin with another precede it.
static SYMBOLS: LazyLock<Vec<&str>> = LazyLock::new(|| {
    let of_formulas = registry().formulas().iter().flat_map(|formula| formula.tree.symbols());
    let of_claims =
        statements().into_iter().flat_map(|s| s.trees().flat_map(Tree::symbols).collect::<Vec<_>>());
    let of_proofs: Vec<String> = (0..75)
        .map(|i| {
            let digit = |d: u8| char::from_u32('₀' as u32 + u32::from(d - b'0')).unwrap();
            let index: String = (i / 3).to_string().bytes().map(digit).collect();
            format!("{}{index}", ['s', 'e', 't'][i % 3])
        })
        .collect();
    let of_proofs = of_proofs.into_iter().map(|name| &*name.leak());
    let own = OWN.into_iter().chain(MEMBERS).chain(of_proofs);
    let mut all: Vec<_> = own.chain(of_formulas).chain(of_claims).collect();
    all.sort_by_key(|name| (std::cmp::Reverse(name.len()), *name));
    all.dedup();
    all
});
static NO_NAMES: LazyLock<Registry> = LazyLock::new(Registry::default);

impl<'a> Reader<'a> {
    fn new(rest: &'a str) -> Self {
        Reader { rest, registry: &NO_NAMES, quiet: &[], at: &at, rounding: false }
    }

    /// Returns the parser with the names of a registry.
    fn with(self, registry: &'a Registry, quiet: &'a [&'static str]) -> Self {
        Reader { registry, quiet, ..self }
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

    /// Returns the value of the whole text, which must be one factor: the base of a power.
    fn one_factor(mut self) -> Option<Exact> {
        let (text, value) = (self.rest, self.base());
        assert!(value.is_none() || self.rest.is_empty(), "{text} is more than a factor: left {}", self.rest);
        value
    }

    /// Returns the value of a name, with its arguments if there are any.
    fn named(&mut self) -> Option<Option<Exact>> {
        let mut all: Vec<_> = self.registry.formulas().iter().filter(|formula| formula.abbreviated).collect();
        all.sort_by_key(|formula| std::cmp::Reverse(formula.symbol.len()));
        let formula = all.into_iter().find(|formula| self.eat(formula.symbol))?;
        let names: Vec<_> = formula.depends_on().collect();
        let mut said = Vec::new();
        while self.eat(if said.is_empty() { "(" } else { ", " }) {
            match self.sum() {
                Some(value) => said.push(value),
                None => return Some(None),
            }
        }
        assert!(said.is_empty() || self.eat(")"), "{}", self.rest);
        let named: Vec<_> = if said.len() == names.len() {
            names
        } else {
            names.into_iter().filter(|name| !self.quiet.contains(name)).collect()
        };
        assert!(said.is_empty() || said.len() == named.len(), "arguments of {}", formula.symbol);
        let tree = if self.rounding { formula.tree.with_rounding() } else { formula.tree.clone() };
        Some(replayed_at(&tree, &|name| match named.iter().position(|own| *own == name) {
            Some(place) if !said.is_empty() => said[place].clone(),
            _ => self.argument(name),
        }))
    }

    /// Returns the value of an omitted argument, which may itself be abbreviated.
    fn argument(&self, name: &str) -> Exact {
        let mut formulas = self.registry.formulas().iter();
        match formulas.find(|formula| formula.abbreviated && formula.symbol == name) {
            Some(formula) => replayed_at(&formula.tree, &at).unwrap(),
            None => at(name),
        }
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
        if let Some(named) = self.named() {
            return named;
        }
        let name = SYMBOLS.iter().find(|name| self.eat(name));
        Some((self.at)(name.unwrap_or_else(|| panic!("neither number nor symbol: {}", self.rest))))
    }
}

fn replayed(tree: &Tree) -> Option<Exact> {
    replayed_at(tree, &at)
}

fn replayed_at(tree: &Tree, at: &dyn Fn(&str) -> Exact) -> Option<Exact> {
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

/// A text, the registry whose names it may use, and the arguments that it may omit.
#[derive(Clone, Copy)]
struct Text<'a>(&'a str, &'a Registry, &'a [&'static str]);

impl<'a> Text<'a> {
    fn part(self, part: &'a str) -> Self {
        Text(part, self.1, self.2)
    }

    fn value(self) -> Option<Exact> {
        Reader::new(self.0).with(self.1, self.2).all()
    }

    /// Asserts that the text has the value of this tree.
    fn is(self, tree: &Tree) {
        if let Some(value) = replayed(tree) {
            assert_eq!(self.value(), Some(value), "{}: not what {tree} is", self.0);
        }
    }

    /// Splits the text into two formulas and their relation.
    fn sides(self) -> (Self, &'a str, Self) {
        let relations = [" = ", " > ", " ≥ ", " < ", " ≤ "];
        let found: Vec<_> = relations.iter().flat_map(|relation| self.0.match_indices(relation)).collect();
        let [(place, relation)] = found[..] else { panic!("{}: one relation, not {found:?}", self.0) };
        (self.part(&self.0[..place]), relation.trim(), self.part(&self.0[place + relation.len()..]))
    }

    /// Asserts that the text states the sign of this tree.
    fn is_sign(self, relation: Relation, tree: &Tree) {
        let (left, said, right) = self.sides();
        assert_eq!(
            relation,
            match said {
                ">" | "<" => Relation::Positive,
                "≥" | "≤" => Relation::NonNegative,
                _ => Relation::Zero,
            }
        );
        let Some(value) = replayed(tree) else { return };
        let (left, right) = (left.value().unwrap(), right.value().unwrap());
        let difference = if ["<", "≤"].contains(&said) { right - left } else { left - right };
        let same = difference == value || relation == Relation::Zero && difference == -value;
        assert!(same, "{}: not what {tree} {relation} 0 says", self.0);
    }

    fn is_within(self, of: &Tree, bound: &Tree) {
        let (left, said, right) = self.sides();
        assert_eq!(said, "≤", "{}", self.0);
        left.is(&of.abs());
        right.is(bound);
    }

    fn is_hypothesis(self, hypothesis: &Hypothesis) {
        let Some((x, lower, upper)) = hypothesis.interval() else {
            return self.is_sign(hypothesis.relation, &hypothesis.value);
        };
        match (hypothesis.distance(), &self.0.split(" ≤ ").collect::<Vec<_>>()[..]) {
            (Some((distance, most)), [_, _]) => self.is_within(&distance, most),
            (None, [from, middle, to]) => {
                self.part(from).is(lower);
                assert_eq!(*middle, x);
                self.part(to).is(upper);
            }
            _ => panic!("{}: no interval", self.0),
        }
    }

    fn is_said(self, says: &Proposition) {
        let between =
            |keyword: &str, close: &str| self.0.strip_prefix(keyword).and_then(|rest| rest.split_once(close));
        match says {
            Proposition::Equal(a, b) => {
                let same = self.0.strip_prefix("both functions are ");
                if let Some(same) =
                    same.or_else(|| between("it is ", " for all values").map(|(same, _)| same))
                {
                    [a, b].into_iter().for_each(|side| self.part(same).is(side));
                    return;
                }
                let (left, said, right) = self.sides();
                assert_eq!(said, "=");
                left.is(a);
                right.is(b);
            }
            Proposition::Sign(relation, of) => {
                let (of_text, said, zero) = self.sides();
                assert_eq!((said, zero.0), (relation.to_string().as_str(), "0"));
                of_text.is(of);
            }
            Proposition::Within(of, bound) => self.is_within(of, bound),
            Proposition::Derivative(of, by, is) => {
                let (of_text, is_text) = between(&format!("∂/∂{by} ["), "] = ").expect(self.0);
                self.part(of_text).is(of);
                self.part(is_text).is(is);
            }
            Proposition::Limit(of, by, to) => {
                let (of_text, to_text) = between("lim [", "] = ").expect(self.0);
                let to_text = to_text.strip_suffix(&format!(" for {by} → ∞")).expect(self.0);
                self.part(of_text).is(of);
                self.part(to_text).is(to);
            }
        }
    }

    /// Asserts that the text lists these formulas.
    fn are(self, trees: &[Tree]) {
        let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
        for (i, c) in self.0.char_indices() {
            match c {
                '(' => depth += 1,
                ')' => depth -= 1,
                ',' if depth == 0 => {
                    parts.push(&self.0[start..i]);
                    start = i + 2;
                }
                _ => {}
            }
        }
        parts.push(&self.0[start..]);
        assert_eq!(parts.len(), trees.len(), "{}", self.0);
        parts.iter().zip(trees).for_each(|(part, tree)| self.part(part).is(tree));
    }

    /// Asserts that the text states the conclusion of a claim.
    fn is_claim(self, statement: &Statement) {
        let Some(Sequence { start, step, ratio, member, limit, within }) = statement.conclusion() else {
            let (said, computed) = self.0.split_once(", where ").unwrap_or((self.0, ""));
            self.is_computed(computed, statement);
            let goals = statement.goals().iter().filter(|goal| goal.role == Role::Claim);
            let (goals, parts): (Vec<_>, Vec<_>) = (goals.collect(), said.split("; ").collect());
            assert_eq!(goals.len(), parts.len(), "{}", self.0);
            parts.iter().zip(goals).for_each(|(part, goal)| self.part(part).is_said(&goal.proposition));
            return;
        };
        let place = if let Some(limit) = limit {
            let (tends, place) = self.0.split_once(" for q = ").expect(self.0);
            let (of, to) = tends.split_once(" → ").expect(self.0);
            self.part(of).are(member);
            self.part(to).is(limit);
            let (place, conditions) = place.split_once(", as ").expect(self.0);
            let (size, at_zero) = conditions.split_once(" < 1 and it is ").expect(self.0);
            self.part(size).is(&ratio.abs());
            self.part(at_zero.strip_suffix(" at q = 0").expect(self.0)).is(limit);
            let (place, infinity) = place.rsplit_once(" and ").expect(self.0);
            assert!(infinity.ends_with(" → ∞"));
            self.is_power(place, infinity.trim_end_matches(" → ∞"), statement)
        } else {
            let (index, rest) = self.0.split_once(" steps from ").expect(self.0);
            let (from, rest) = rest.split_once(", each of ").expect(self.0);
            let (members, rest) = rest.split_once(" to ").expect(self.0);
            let (to, rest) = rest.split_once(", lead to ").expect(self.0);
            let (lead, place) = rest.split_once(", where q = ").expect(self.0);
            assert_eq!(members, MEMBERS[..step.len()].join(", "));
            self.part(from).are(start);
            self.part(to).are(step);
            match lead.strip_prefix("x₁ with ") {
                None => self.part(lead).are(member),
                Some(bounds) => {
                    let bounds: Vec<_> = bounds.split(" and ").collect();
                    assert_eq!(bounds.len(), within.len(), "{}", self.0);
                    bounds
                        .iter()
                        .zip(within)
                        .for_each(|(part, (of, bound))| self.part(part).is_within(of, bound));
                }
            }
            self.is_power(place, index, statement)
        };
        place.expect("a ratio").is(ratio);
    }

    /// Asserts that the text is a power, and that its index occurs nowhere else in the statement.
    fn is_power(self, place: &'a str, index: &str, statement: &Statement) -> Option<Self> {
        let (power, computed) = place.split_once(" and ").unwrap_or((place, ""));
        self.is_computed(computed, statement);
        assert!(
            statement.trees().all(|tree| !tree.symbols().contains(index)),
            "{}: {index} is taken",
            self.0
        );
        let exponent = "kjin".chars().position(|letter| letter.to_string() == index);
        let exponent = "ᵏʲⁱⁿ".chars().nth(exponent.expect(index))?;
        let base = power.strip_suffix(exponent).expect(self.0);
        Reader::new(base).with(self.1, self.2).one_factor();
        Some(self.part(base))
    }

    fn is_computed(self, computed: &'a str, statement: &Statement) {
        let all: Vec<_> = computed.split(" and ").filter(|said| !said.is_empty()).collect();
        assert_eq!(all.len(), statement.computed().len(), "{}: what is computed?", self.0);
        for (said, computed) in all.into_iter().zip(statement.computed()) {
            let (symbol, by) = said.split_once(" = ").expect(self.0);
            assert_eq!(symbol, computed.symbol);
            self.part(by).is(&computed.formula);
        }
    }
}

fn relations() -> impl Strategy<Value = Relation> {
    prop::sample::select(&[Relation::Positive, Relation::NonNegative, Relation::Zero])
}

/// Hypotheses on signs of formulas, negations and differences, and intervals.
fn hypotheses() -> impl Strategy<Value = Hypothesis> {
    let tree = || prop_oneof![trees(), rounded_trees()];
    let value = prop_oneof![
        tree(),
        tree().prop_map(|a| -a),
        (tree(), tree()).prop_map(|(a, b)| a - b),
        (tree(), tree()).prop_map(|(a, b)| -a - b),
        (tree(), tree()).prop_map(|(a, b)| -a + b),
    ];
    let sign = (relations(), value)
        .prop_filter_map("hypotheses are not about numbers", |(relation, value)| {
            value.first_symbol().map(|_| Hypothesis::new(relation, value))
        });
    let x = || Tree::symbol("v");
    prop_oneof![
        3 => sign,
        1 => (tree(), tree()).prop_map(move |(a, b)| Hypothesis::near(&x(), a, b)),
        1 => (tree(), tree()).prop_map(move |(a, b)| Hypothesis::between(&x(), a, b)),
    ]
}

/// Claims of all kinds, which need not be true.
fn claims() -> impl Strategy<Value = Statement> {
    let some = prop::collection::vec(prop_oneof![trees(), rounded_trees()], 9);
    (some, 0..9, relations(), 0..3usize).prop_map(|(trees, kind, relation, computes)| {
        let t = |i: usize| trees[i].clone();
        let a = Tree::symbol("a");
        let claim = match kind {
            0 => equal("drawn", t(0), t(1)),
            1 => equal("drawn", 0, 0).with_proposition(Proposition::Sign(relation, t(0))),
            2 => derivative("drawn", t(0), &a, t(1)),
            3 => limit("drawn", t(0), &a, t(1), Rate::Equal(t(2))),
            4 => limit("drawn", t(0), &a, t(1), Rate::Within(t(2))),
            5 => {
                let two = |i: usize| [t(i), t(i + 1)];
                // A step depends on members, and not on a power.
                let step =
                    |[x, y]: [Tree; 2]| [t(3).substitute(&[(POWER, x)]), t(4).substitute(&[(POWER, y)])];
                induction("drawn", t(0), two(1), step, two(5))
            }
            6 => within("drawn", t(0), t(1)),
            7 => perturbed_recursion("drawn", t(0))
                .start(t(1))
                .step(|x| x - t(2).substitute(&[(POWER, x.clone())]))
                .bounding(|_| t(5), t(6))
                .near(t(3), t(4)),
            _ => geometric_limit("drawn", t(0), t(1), t(2)),
        };
        let computed = ["v", "w"].map(|name| Tree::symbol(name));
        let claim = claim.assuming(&computed.each_ref().map(|x| Hypothesis::near(x, t(7), t(8))));
        computed.iter().take(computes).fold(claim, |claim, x| claim.computing(x, t(8)))
    })
}

#[test]
fn the_text_of_a_hypothesis_has_the_values_of_its_formulas() {
    holds_often(16, hypotheses(), |hypothesis| {
        Text(&hypothesis.to_string(), &NO_NAMES, &[]).is_hypothesis(hypothesis);
    });
}

#[test]
fn the_text_of_a_claim_has_the_values_of_its_formulas() {
    holds_often(16, claims(), |claim| {
        Text(&ProofPrinter::new(&NO_NAMES).claim(claim), &NO_NAMES, &[]).is_claim(claim);
    });
}

/// Returns the value of a text at these numbers, at which no divisor is 0.
fn value_of(text: &str, at: &dyn Fn(&str) -> Exact) -> Exact {
    Reader { at, ..Reader::new(text) }.all().unwrap_or_else(|| panic!("{text}: divides by zero"))
}

/// Numbers for all symbols of a proof, extended by the definitions in its lines.
struct Lines {
    known: BTreeMap<String, Exact>,
    /// The quantities that the goal is about.
    values: Vec<Exact>,
}

/// The beginnings of lines about the goal.
const OF_GOAL: [&str; 5] =
    ["both sides are ", "it is ", "the difference is ", "the bound − it is ", "the bound + it is "];

impl Lines {
    fn value(&self, text: &str) -> Exact {
        value_of(text, &|name| self.known.get(name).cloned().unwrap_or_else(|| at(name)))
    }

    /// Asserts that equal formulas have the same value, which has the sign that is stated, and returns the value.
    fn chain(&self, text: &str) -> Exact {
        use std::cmp::Ordering::{Equal, Greater, Less};
        let signs: [(&str, &[_]); 5] = [
            (" > 0", &[Greater]),
            (" ≥ 0", &[Greater, Equal]),
            (" = 0", &[Equal]),
            (" ≤ 0", &[Less, Equal]),
            (" < 0", &[Less]),
        ];
        let signed = signs.iter().find_map(|(end, sign)| Some((text.strip_suffix(end)?, *sign)));
        let (formulas, sign) = signed.unwrap_or((text, &[Less, Equal, Greater]));
        let values: Vec<_> = formulas.split(" = ").map(|formula| self.value(formula)).collect();
        assert!(values.windows(2).all(|pair| pair[0] == pair[1]), "{text}");
        assert!(sign.contains(&values[0].cmp(&Exact::from(0))), "{text}");
        values[0].clone()
    }

    /// Checks one line at the numbers; returns the number of formulas in it.
    fn holds(&mut self, line: &str) -> usize {
        let (fact, reason) = line.split_once(", as ").unwrap_or((line, ""));
        if let Some((equation, rest)) = reason.split_once(" with |") {
            let (of, _) = equation.split_once(" = ").unwrap();
            let sign = if self.value(of) < Exact::from(0) { -1 } else { 1 };
            self.known.insert(rest.split_once('|').unwrap().0.to_string(), Exact::from(sign));
            self.chain(equation);
        }
        let fact = fact.split_once(" by ").map_or(fact, |(fact, _)| fact);
        if let Some((name, rest)) = fact.split_once(" = ")
            && let Some(name) = name.strip_prefix('s')
        {
            let (of, _) = rest.rsplit_once([' ']).unwrap();
            let value = self.value(of.trim_end_matches([' ', '>', '≥', '=', '≤', '<']));
            self.known.insert(format!("s{name}"), value);
        }
        let start = OF_GOAL.into_iter().find(|start| line.starts_with(start));
        let value = self.chain(fact.trim_start_matches(start.unwrap_or("")));
        assert!(start.is_none() || self.values.contains(&value), "{line}: {:?}", self.values);
        let Some(right) =
            reason.strip_prefix("it is ").map(|right| ("1", right)).or(reason.split_once(" times it is "))
        else {
            return 1;
        };
        let (left, right) = (self.value(right.0), self.value(right.1));
        assert_eq!(left * value, right, "{line}");
        2
    }
}

/// Claims that may be proved: equal formulas, squares, and bounds from hypotheses.
fn provable() -> impl Strategy<Value = Statement> {
    let [a, b, u, k] = ["a", "b", "u", "k"].map(|name| Tree::symbol(name));
    let leaves = [&a, &b, &u, &k].into_iter().cycle().take(24).cloned().chain((-3..4).map(Tree::int));
    let polynomial = composed(
        leaves.collect(),
        &[
            (2, |x| x() + x()),
            (2, |x| x() - x()),
            (3, |x| x() * x()),
            (1, |x| x() / (Tree::symbol("a") + Tree::symbol("b"))),
            (1, |x| -x()),
        ],
        12,
    );
    (polynomial.clone(), polynomial, 0..6, any::<bool>()).prop_map(move |(x, y, kind, more)| {
        let sign = |relation, of: &Tree| Hypothesis::new(relation, of.clone());
        let [of_a, of_b] = [&a, &b].map(|of| sign(Relation::Positive, of));
        let difference = sign(Relation::Positive, &(&b - Tree::int(2) * &a));
        let product = sign(Relation::NonNegative, &(&a * &u - &b * &k));
        let hypotheses: &[&Hypothesis] = if more { &[&of_a, &difference, &product] } else { &[&of_a, &of_b] };
        let claim = match kind {
            0 => equal("drawn", &x * (&y + &a), &a * &x + &y * &x),
            1 => equal("drawn", &x / (&a + &b) - &y, (&x - &y * (&a + &b)) / (&a + &b)),
            2 => positive("drawn", &x * &x + &b),
            3 => positive("drawn", &u * &u * &a - &u * &k * &a + &k * &k * &b + &a),
            4 => non_negative("drawn", (&a * &x * &x + &a * &y * &y - &x * &y * &a) / (&b * &b)),
            _ => within("drawn", &x * &a, (&x * &a).abs() + &b),
        };
        claim.assuming(hypotheses.iter().copied())
    })
}

#[test]
fn every_line_of_a_proof_holds_at_numbers() {
    let held = std::cell::Cell::new(0);
    let law = |statement: &Statement| {
        let Ok(proof) = prove(statement) else { return };
        let said = ProofPrinter::new(&NO_NAMES).proof(&proof);
        // In each case a name may stand for something else; and of what is long only the length is said.
        if said.iter().any(|line| line.trim_start().starts_with("case ") || line.contains("a sum of ")) {
            return;
        }
        // All hypotheses hold there.
        let known =
            [("a", 3), ("b", 10), ("u", 5), ("k", 1)].map(|(name, n)| (name.to_string(), Exact::from(n)));
        let known = BTreeMap::from(known);
        let [goal] = statement.goals() else { return };
        let [first, second] = goal.proposition.trees().map(|tree| {
            let value = replayed_at(tree, &|name| known[name].clone());
            value.expect("no divisor is 0")
        });
        let values = match goal.proposition {
            Proposition::Within(..) => vec![&second - &first, &second + &first],
            _ => vec![&first - &second, first],
        };
        let mut lines = Lines { known, values };
        held.set(held.get() + said.iter().map(|line| lines.holds(line)).sum::<usize>());
    };
    holds_often(32, provable(), law);
    assert!(held.get() > 32 * cases() as usize, "only {} lines are about formulas", held.get());
}

#[test]
fn the_texts_of_the_chapters_claims_have_the_values_of_their_formulas() {
    let quiet = ["ε"];
    for statement in statements() {
        Text(&ProofPrinter::new(registry()).claim(&statement), registry(), &quiet).is_claim(&statement);
        for hypothesis in statement.all_hypotheses() {
            Text(&registry().format_hypothesis(hypothesis), registry(), &quiet).is_hypothesis(hypothesis);
        }
    }
}

/// Returns a b − c.
fn spring(a: &Tree, b: &Tree, c: &Tree) -> Tree {
    a * b - c
}

/// Calls with two arguments that may be omitted, also nested.
#[test]
fn an_abbreviated_call_has_the_value_of_its_tree() {
    holds_often(10, (prop::collection::vec(trees(), 3), 0..8, any::<bool>()), |(drawn, usual, twice)| {
        let [a, b, c] = ["a", "b", "u"].map(|name| Tree::symbol(name));
        let formula = Formula::new("spring", "S", &["a", "b", "u"], spring(&a, &b, &c)).abbreviated();
        let names = Registry::new(&OWN, vec![formula]).with_implicit(&["b", "u"]);
        let argument =
            |i: usize, own: &Tree| if usual & (1 << i) > 0 { own.clone() } else { drawn[i].clone() };
        let called = spring(&argument(0, &a), &argument(1, &b), &argument(2, &c));
        let called = if *twice { spring(&a, &called, &c) } else { called };
        for tree in [&called - &drawn[1], (-&called * &a).round(), (&called * &drawn[2]).with_rounding()] {
            Text(&names.format_tree(&tree), &names, &["b", "u"]).is(&tree);
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
