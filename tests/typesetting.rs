//! A formula that is printed says what it computes: its text, read again, has the value of its tree.
#![cfg(feature = "prover")]

use proptest::prelude::*;
use spring_mass_contact::claims::registry;
use spring_mass_contact::number::tree::{Step, piecewise};
use spring_mass_contact::number::{Exact, Exponential, Field, PositivePart, Tree};

/// No rational is an exponential: any function serves that does not vanish or repeat by accident.
fn exp(x: &Exact) -> Exact {
    x * x * x + x + Exact::from(7)
}

fn value(name: &str) -> Exact {
    let seed = name.bytes().fold(7, |seed, byte| (seed + i32::from(byte)).pow(2) % 10_007);
    Exact::from(seed - 5000) / Exact::from(97)
}

/// Numbers of as many bits are rounded to.
const BITS: u32 = 5;

/// A number for a symbol: 2ᵃ is a power of two.
fn at(name: &str) -> Exact {
    if name == "2ᵃ" { Exact::power_of_two(-3) } else { value(name) }
}

/// Reads formulas as a text writes them, by its rules and by nothing of what writes them: the value, `None` if it
/// divides by zero.
///
/// In fl( ) the result of every + − × ÷, power and exp is rounded, from the left; what is scaled by a power of two is
/// exact, and so is what is in ⟨ ⟩, | |, min or max. In nearest( ) all is exact, and rounded once.
struct Reader<'a> {
    rest: &'a str,
    symbols: Vec<&'static str>,
    at: &'a dyn Fn(&str) -> Exact,
    rounding: bool,
}

impl<'a> Reader<'a> {
    fn new(rest: &'a str, symbols: impl IntoIterator<Item = &'static str>, at: &'a dyn Fn(&str) -> Exact) -> Self {
        let mut symbols: Vec<_> = symbols.into_iter().collect();
        symbols.sort_by_key(|name| std::cmp::Reverse(name.len()));
        Reader { rest, symbols, at, rounding: false }
    }

    fn value(tree: &Tree) -> Option<Exact> {
        Reader::of(&tree.to_string(), tree.symbols(), &at)
    }

    /// The value of all of the text.
    fn of(
        text: &str,
        symbols: impl IntoIterator<Item = &'static str>,
        at: &dyn Fn(&str) -> Exact,
    ) -> Option<Exact> {
        let mut reader = Reader::new(text, symbols, at);
        let value = reader.sum();
        assert!(value.is_none() || reader.rest.is_empty(), "{text}: left {}", reader.rest);
        value
    }

    fn eat(&mut self, token: &str) -> bool {
        let rest = self.rest.strip_prefix(token);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn rounded(&self, x: Exact) -> Exact {
        if self.rounding { x.rounded(BITS).unwrap() } else { x }
    }

    /// What stands between brackets, with rounding or without.
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
        while self.rest.starts_with(['·', ' ']) && ![" + ", " − ", " / "].iter().any(|s| self.rest.starts_with(s))
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
        let quotient = under.is_unit().then(|| product / under)?;
        Some(if scale { quotient } else { self.rounded(quotient) })
    }

    /// And whether it is a power of two, by which is scaled.
    fn factor(&mut self) -> Option<(Exact, bool)> {
        let scale = self.rest.starts_with("2ᵃ") || self.rest.starts_with("(2ᵃ)");
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
        let named = self.symbols.iter().any(|name| name.len() > digits && self.rest.starts_with(name));
        if digits > 0 && !named {
            let number = self.rest[..digits].parse().unwrap();
            self.rest = &self.rest[digits..];
            return Some(number);
        }
        let closed = |reader: &mut Self, bracket: &str| assert!(reader.eat(bracket), "{}", reader.rest);
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
                    _ => inner.rounded(BITS).unwrap(),
                });
            }
        }
        let symbols = self.symbols.clone();
        let name = symbols.into_iter().find(|name| self.eat(name));
        Some((self.at)(name.unwrap_or_else(|| panic!("neither number nor symbol: {}", self.rest))))
    }
}

fn replayed(tree: &Tree) -> Option<Exact> {
    let beyond = |step: Step<&Exact>| match step {
        Step::Exp(a) => Some(exp(a)),
        Step::Rounded(a) => a.rounded(BITS),
        step => piecewise(step),
    };
    tree.replay(&|name| at(name), &beyond)
}

fn trees() -> impl Strategy<Value = Tree> {
    let symbol = prop::sample::select(&["a", "b", "u", "λ₀", "ρᵏ", "u_{k+1}", "2ᵖ", "2ᵃ"])
        .prop_map(|name| Tree::symbol(name));
    let leaf = prop_oneof![3 => symbol, 1 => (-3..4).prop_map(Tree::int)];
    leaf.prop_recursive(6, 40, 2, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            3 => pair.clone().prop_map(|(a, b)| a + b),
            3 => pair.clone().prop_map(|(a, b)| a - b),
            4 => pair.clone().prop_map(|(a, b)| a * b),
            2 => pair.clone().prop_map(|(a, b)| a / b),
            1 => pair.prop_map(|(a, b)| a.min(&b)),
            2 => inner.clone().prop_map(|a| -a),
            1 => inner.clone().prop_map(|a| &a * &a),
            1 => inner.clone().prop_map(|a| a.exp()),
            1 => inner.clone().prop_map(|a| a.abs()),
            1 => inner.prop_map(|a| a.positive_part()),
        ]
    })
}

/// The same where some steps are rounded, in some trees all, in others some or only the last.
fn rounded_trees() -> impl Strategy<Value = Tree> {
    let some = (trees(), any::<u64>()).prop_map(|(tree, seed)| {
        let chosen = std::cell::Cell::new(seed);
        tree.rewrite(&|tree| {
            chosen.set(chosen.get().rotate_left(7).wrapping_mul(0x9e37_79b9_7f4a_7c15));
            (chosen.get() % 3 > 0).then(|| tree.nearest())
        })
    });
    let once = trees().prop_map(|tree| tree.nearest());
    let steps = trees().prop_map(|tree| tree.rounded());
    prop_oneof![2 => some, 1 => once, 3 => steps]
}

/// The round brackets of a text: where each opens, and what it holds.
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_text_has_the_value_of_its_tree(tree in trees()) {
        if let Some(expected) = replayed(&tree) {
            prop_assert_eq!(Reader::value(&tree), Some(expected), "{}", tree);
        }
    }

    #[test]
    fn a_text_says_what_is_rounded(tree in rounded_trees()) {
        if let Some(expected) = replayed(&tree) {
            prop_assert_eq!(Reader::value(&tree), Some(expected), "{}", tree);
        }
    }

    #[test]
    fn nothing_is_written_that_says_nothing(tree in trees()) {
        prop_assume!(replayed(&tree).is_some());
        let text = tree.to_string();
        for idle in ["−−", "− −", "+ −", "+ 0", "− 0"] {
            prop_assert!(!text.contains(idle), "{}", text);
        }
        let words: Vec<_> = text.split(' ').collect();
        for pair in words.windows(2).filter(|pair| pair[0].trim_start_matches(['(', '⟨', '−']) == "1") {
            prop_assert!(["+", "−", "/"].contains(&pair[1]), "{}", text);
        }
        for (open, inner) in brackets(&text) {
            // Those of a function, or around a sum, a product or an exponent; and never around all.
            let function = text[..open].ends_with(char::is_alphabetic);
            prop_assert!(function || inner.contains([' ', 'ᵏ', 'ᵖ', 'ᵃ']) && inner.len() + 2 < text.len(), "{}", text);
        }
        let latex = tree.latex();
        for (open, close) in
            [("{", "}"), ("(", ")"), ("\\left", "\\right"), ("\\langle", "\\rangle"), ("\\lvert", "\\rvert")] {
            let count = |token: &str| latex.replace("\\rightarrow", "").matches(token).count();
            prop_assert_eq!(count(open), count(close), "{}", &latex);
        }
    }
}

#[test]
fn every_formula_of_the_chapter_has_the_value_of_its_text() {
    for formula in registry().formulas() {
        let expected = replayed(&formula.tree);
        assert!(expected.is_some(), "{}", formula.name());
        assert_eq!(Reader::value(&formula.tree), expected, "{}: {}", formula.name(), formula.tree);
    }
}
