//! Parser of definitions and theorems of Coq, which finds rationals at which a theorem is false.
//!
//! It uses the precedence levels of Coq's manual and nothing of the printer, which it tests. It supports only
//! the part of Coq's language, Gallina, that the chapter needs. With the precision `prec` ties are rounded to
//! even, which is one possible choice.

mod recursion;

use super::coqc::code;
pub use recursion::Recursion;
use spring_mass_contact::number::tree::{Op, piecewise_ops};
use spring_mass_contact::number::{Dual, Exact, Exponential, Field, PositivePart, Tree};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

/// Returns the parts of a text between proofs.
pub fn stated(text: &str) -> impl Iterator<Item = &str> {
    text.split("\nProof.\n").map(|part| part.rsplit("Qed.\n").next().unwrap())
}

/// Returns the words and signs of a text.
pub fn tokens(text: &str) -> Vec<String> {
    const PAIRS: [&str; 6] = [":=", "->", "=>", "<=", "<>", "/\\"];
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let (mut all, mut before) = (Vec::<String>::new(), ' ');
    for c in text.chars() {
        match all.last_mut() {
            Some(last) if is_word(before) && is_word(c) => last.push(c),
            Some(last) if before != ' ' && PAIRS.contains(&format!("{last}{c}").as_str()) => last.push(c),
            _ if c.is_whitespace() => {}
            _ => all.push(c.to_string()),
        }
        before = if c.is_whitespace() { ' ' } else { c };
    }
    all
}

/// Stores each name once, since symbols have static names.
fn interned(name: &str) -> &'static str {
    static KNOWN: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut known = KNOWN.lock().unwrap();
    known.get(name).copied().unwrap_or_else(|| {
        let name = name.to_string().leak();
        known.insert(name);
        name
    })
}

/// A definition of a function, `Definition NAME (ARGUMENTS : R) : R := BODY.`
#[derive(Clone, Debug)]
pub struct Definition {
    pub name: String,
    pub arguments: Vec<&'static str>,
    /// Its [`tokens`].
    pub body: Vec<String>,
}

impl Definition {
    pub fn of(text: &str) -> Self {
        let all = tokens(text);
        let split = all.iter().position(|token| token == ":=").expect(text);
        let (head, body) = (&all[..split], &all[split + 1..]);
        let [first, name, open, arguments @ .., colon, r, close, again, value] = head else {
            panic!("{text}")
        };
        let around = [first, open, colon, r, close, again, value].map(String::as_str);
        assert_eq!(around, ["Definition", "(", ":", "R", ")", ":", "R"], "{text}");
        let [body @ .., dot] = body else { panic!("{text}") };
        assert_eq!(dot, ".", "{text}");
        let arguments = arguments.iter().map(|name| interned(name)).collect();
        Definition { name: name.clone(), arguments, body: body.to_vec() }
    }

    /// Returns the definitions of a file.
    pub fn all(text: &str) -> Vec<Self> {
        let text = code(text);
        let starts = text.match_indices("Definition ").map(|(start, _)| start);
        starts.map(|start| Definition::of(text[start..].split_inclusive(".\n").next().unwrap())).collect()
    }

    /// Returns the function, whose callees are known.
    pub fn function(&self, known: &Functions) -> Function {
        let mut reader = Reader { rest: &self.body, known, ratio: None };
        let value = reader.formula();
        assert!(reader.rest.is_empty(), "{}: what is {:?}?", self.name, reader.rest);
        for symbol in value.symbols() {
            assert!(self.arguments.contains(&symbol), "{}: what is {symbol}?", self.name);
        }
        Function { arguments: self.arguments.clone(), value }
    }
}

/// A function with all its calls expanded.
#[derive(Clone, Debug)]
pub struct Function {
    pub arguments: Vec<&'static str>,
    pub value: Tree,
}

pub type Functions = BTreeMap<String, Function>;

/// Returns the functions of definitions, each after those it calls.
pub fn functions(definitions: &[Definition]) -> Functions {
    definitions.iter().fold(Functions::new(), |mut known, definition| {
        let function = definition.function(&known);
        known.insert(definition.name.clone(), function);
        known
    })
}

/// Remaining tokens.
struct Reader<'t> {
    rest: &'t [String],
    known: &'t Functions,
    /// The ρ of q, if it has been read.
    ratio: Option<Tree>,
}

impl<'t> Reader<'t> {
    fn next(&self) -> &'t str {
        self.rest.first().map_or("", String::as_str)
    }

    fn take(&mut self) -> &'t str {
        let (first, rest) = self.rest.split_first().expect("it ends too early");
        self.rest = rest;
        first
    }

    fn expect(&mut self, token: &str) {
        assert_eq!(self.take(), token, "before {:?}", self.rest);
    }

    /// Consumes these tokens.
    fn expect_all(&mut self, tokens: &str) {
        tokens.split(' ').for_each(|token| self.expect(token));
    }

    /// Parses one or several propositions.
    fn all_said(&mut self) -> Vec<Said> {
        let mut all = vec![self.said()];
        while self.next() == "/\\" {
            self.take();
            all.push(self.said());
        }
        all
    }

    /// Parses the premises for every precision of at least two bits, every choice of ties, and other powers
    /// of two.
    fn precision(&mut self) {
        self.expect_all("forall ( prec : Z ) ( choice : Z -> bool )");
        if self.next() == "(" {
            while self.take() != ":" {}
            self.expect_all("Z )");
        }
        self.expect_all(", ( 2 <= prec ) % Z ->");
    }

    /// Parses sums at level 50 of products at level 40, from the left.
    fn formula(&mut self) -> Tree {
        self.chain(&[["+", "-"], ["*", "/"]])
    }

    fn chain(&mut self, signs: &[[&str; 2]]) -> Tree {
        let Some((own, stronger)) = signs.split_first() else { return self.signed() };
        let mut value = self.chain(stronger);
        while own.contains(&self.next()) {
            let (sign, other) = (self.take(), self.chain(stronger));
            value = match sign {
                "+" => value + other,
                "-" => value - other,
                "*" => value * other,
                _ => value / other,
            };
        }
        value
    }

    /// Parses a leading minus, at level 35: it binds more strongly than a product. There is no leading plus.
    fn signed(&mut self) -> Tree {
        if self.next() == "-" {
            self.take();
            return -self.signed();
        }
        self.power()
    }

    /// Parses ρ ^ n, at level 30, as q.
    fn power(&mut self) -> Tree {
        let value = self.call();
        if self.next() != "^" {
            return value;
        }
        self.expect_all("^ n");
        assert!(self.ratio.replace(value).is_none(), "powers of one ratio, once");
        Tree::symbol("q")
    }

    /// Parses a function with its arguments, at level 10.
    fn call(&mut self) -> Tree {
        let arity = match self.next() {
            "exp" | "Rabs" => 1,
            "Rmax" | "Rmin" => 2,
            "fl" => 3,
            name => match self.known.get(name) {
                Some(function) => function.arguments.len(),
                None => return self.argument(),
            },
        };
        let name = self.take();
        let values: Vec<_> = (0..arity).map(|_| self.argument()).collect();
        match (name, values.as_slice()) {
            ("exp", [a]) => a.exp(),
            ("Rmax", [a, zero]) if *zero == Tree::int(0) => a.positive_part(),
            ("Rmin", [a, b]) => a.min(b),
            ("Rabs", [a]) => a.abs(),
            ("fl", [precision, choice, a]) => {
                assert_eq!([precision, choice], [&Tree::symbol("prec"), &Tree::symbol("choice")]);
                a.round()
            }
            _ => {
                let Function { arguments, value } = &self.known[name];
                let place = |name| arguments.iter().position(|known| *known == name);
                value.rewrite(&|tree| match tree.op() {
                    Op::Symbol(name) => place(*name).map(|place| values[place].clone()),
                    _ => None,
                })
            }
        }
    }

    /// Parses one word, or an expression in brackets.
    fn argument(&mut self) -> Tree {
        let word = self.take();
        if word == "(" {
            let value = self.formula();
            self.expect(")");
            return value;
        }
        assert!(word.starts_with(|c: char| c.is_ascii_alphanumeric()), "{word:?} is neither name nor number");
        match word.parse() {
            Ok(number) => Tree::int(number),
            Err(_) => Tree::symbol(interned(word)),
        }
    }

    fn said(&mut self) -> Said {
        let keyword = self.next();
        if ["is_derive", "is_lim", "is_lim_seq"].contains(&keyword) {
            self.expect_all(&format!("{keyword} ( fun"));
            let by = interned(self.take());
            self.expect("=>");
            let of = self.formula();
            self.expect(")");
            match keyword {
                "is_derive" => self.expect(by),
                "is_lim" => self.expect("p_infty"),
                _ => assert_eq!(by, "n"),
            }
            let is = self.argument();
            return match keyword {
                "is_derive" => Said::Derivative(of, by, is),
                "is_lim" => Said::Limit(of, by, is),
                _ => Said::LimitOfPowers(self.ratio.take().expect("a power of a ratio"), of, is),
            };
        }
        let left = self.formula();
        let relation = self.take();
        if self.next() == "bpow" {
            let Op::Symbol(power) = left.op() else { panic!("{left} is not a name") };
            self.expect_all("bpow radix2");
            return Said::PowerOfTwo(power, interned(self.take()));
        }
        let right = self.formula();
        match relation {
            "=" => Said::Equal(left, right),
            "<>" => Said::Different(left, right),
            "<" => Said::Less(left, right),
            "<=" => Said::AtMost(left, right),
            _ => panic!("{relation:?} is not a relation"),
        }
    }
}

/// Proposition about numbers.
pub enum Said {
    /// The first is 2 to the power of the second.
    PowerOfTwo(&'static str, &'static str),
    Equal(Tree, Tree),
    Different(Tree, Tree),
    Less(Tree, Tree),
    AtMost(Tree, Tree),
    Derivative(Tree, &'static str, Tree),
    Limit(Tree, &'static str, Tree),
    /// For q = ρⁿ the second tends to the third, where ρ is the first.
    LimitOfPowers(Tree, Tree, Tree),
}

impl Said {
    /// Returns whether it holds; `None` if a formula is undefined or irrational, and for limits.
    fn holds(&self, at: &impl Fn(&'static str) -> Exact) -> Option<bool> {
        let value = |tree: &Tree| value(tree, at);
        Some(match self {
            // They are drawn that way.
            Said::PowerOfTwo(power, of) => {
                (*power, *of) == ("two_p", "prec") || power.strip_prefix("two") == of.strip_prefix("power")
            }
            Said::Equal(a, b) => value(a)? == value(b)?,
            Said::Different(a, b) => value(a)? != value(b)?,
            Said::Less(a, b) => value(a)? < value(b)?,
            Said::AtMost(a, b) => value(a)? <= value(b)?,
            Said::Derivative(of, by, is) => {
                let beyond = |step: Op<&Dual<Exact>>| match step {
                    Op::Exp(a) if a.value == Exact::from(0) => {
                        Some(Dual { value: Exact::from(1), derivative: a.derivative.clone() })
                    }
                    _ => None,
                };
                of.derivative(by, at, &beyond)?.derivative == value(is)?
            }
            Said::Limit(..) | Said::LimitOfPowers(..) => return None,
        })
    }
}

/// Returns the value of a formula; an exponential is rational at 0 only.
pub fn value(tree: &Tree, at: &impl Fn(&'static str) -> Exact) -> Option<Exact> {
    tree.eval(at, &|step| match step {
        Op::Exp(a) if *a == Exact::from(0) => Some(Exact::from(1)),
        Op::Rounded(a) => a.round_to_bits(at("two_p").as_rational().numer().significant_bits() - 1),
        step => piecewise_ops(step),
    })
}

/// A theorem or lemma, as [`tokens`].
pub struct Theorem {
    pub name: String,
    stated: Vec<String>,
    /// The recursion that comes before it, if one does.
    recursion: Vec<String>,
}

/// Parsed theorem.
pub struct Read {
    /// Premises.
    pub given: Vec<Said>,
    /// Conclusions; for a sequence, they hold for each member.
    pub follows: Vec<Said>,
    pub of: Option<Recursion>,
}

impl Read {
    /// Returns whether the premises imply the conclusions at these numbers; `None` if that is unknown.
    fn holds(&self, at: &impl Fn(&'static str) -> Exact) -> Option<bool> {
        let given = self.given.iter().all(|given| given.holds(at) == Some(true));
        let follow = |at: &dyn Fn(&'static str) -> Exact| -> Option<bool> {
            let said: Option<Vec<_>> = self.follows.iter().map(|said| said.holds(&at)).collect();
            Some(said?.into_iter().all(|holds| holds))
        };
        match &self.of {
            _ if !given => None,
            None => follow(at),
            Some(recursion) => recursion.all(at, &follow),
        }
    }

    /// Returns, for each trial in which all premises hold, whether the conclusions hold.
    pub fn trials(&self) -> impl Iterator<Item = bool> {
        let rounds = self.given.iter().any(|given| matches!(given, Said::PowerOfTwo(..)));
        (0..if rounds { TRIALS_OF_LAWS } else { TRIALS })
            .filter_map(|trial| self.holds(&|name| drawn(name, trial)))
    }
}

impl Theorem {
    /// Returns the theorems and lemmas of a file.
    pub fn all(text: &str) -> Vec<Self> {
        let text = code(text);
        let theorem = |part: &str| {
            let start = ["Theorem ", "Lemma "].iter().filter_map(|keyword| part.find(keyword)).min()?;
            let all = tokens(&part[start..]);
            let [_, name, colon, stated @ .., dot] = all.as_slice() else { panic!("{part}") };
            assert_eq!([colon, dot], [":", "."], "{part}");
            let recursion = part[..start].find("Fixpoint ").map(|from| tokens(&part[from..start]));
            let recursion = recursion.unwrap_or_default();
            Some(Theorem { name: name.clone(), stated: stated.to_vec(), recursion })
        };
        stated(&text).filter_map(theorem).collect()
    }

    /// Returns `true` if the theorem contains a function or another name.
    pub fn names(&self, name: &str) -> bool {
        self.stated.iter().any(|token| token == name)
    }

    /// Returns `true` if the theorem contains roundings.
    pub fn rounds(&self) -> bool {
        self.names("prec")
    }

    /// Parses the premises and the conclusions.
    pub fn read(&self, known: &Functions) -> Read {
        let mut reader = Reader { rest: &self.stated, known, ratio: None };
        if self.rounds() {
            reader.precision();
        }
        if reader.next() == "forall" {
            while reader.take() != "," {}
        }
        let (mut given, mut of) = (Vec::new(), None);
        let follows = loop {
            if reader.next() == "forall" {
                let (recursion, follows) = reader.sequence(&self.recursion);
                of = Some(recursion);
                break follows;
            }
            let mut said = reader.all_said();
            if reader.next() != "->" {
                break said;
            }
            reader.take();
            given.append(&mut said);
        };
        assert!(reader.rest.is_empty(), "{}: what is {:?}?", self.name, reader.rest);
        Read { given, follows, of }
    }

    /// Returns `true` if the theorem is false at some numbers, possibly for other functions than those of its
    /// proof.
    pub fn is_false_somewhere(&self, functions: &Functions) -> bool {
        self.read(functions).trials().any(|holds| !holds)
    }
}

/// Number of trials.
pub const TRIALS: u64 = 200;

/// Number of trials for theorems with roundings, which have more premises and rarely attain their bounds.
const TRIALS_OF_LAWS: u64 = 2000;

/// Precisions of rounding.
const BITS: [i32; 8] = [2, 3, 4, 5, 6, 8, 24, 53];

/// Returns a reproducible number for a symbol: mostly positive, zero once in eight trials, with few bits in
/// every other trial; or a power of two.
pub fn drawn(name: &str, trial: u64) -> Exact {
    let mixed = name.bytes().fold(trial + 1, |mixed, byte| {
        let mixed = (mixed ^ u64::from(byte)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 29)
    });
    match name {
        "two_p" => return Exact::power_of_two(BITS[(mixed % 8) as usize]),
        _ if name.starts_with("two_") => return Exact::power_of_two((mixed % 9) as i32 - 4),
        _ => {}
    }
    let (size, kind) = (1 + (mixed >> 8) % 30, mixed % 8);
    let n = match kind {
        0 => 0,
        1 | 2 => -(size as i32),
        _ => size as i32,
    };
    Exact::from(n) / Exact::from(if trial.is_multiple_of(2) { 7 } else { 4 })
}
