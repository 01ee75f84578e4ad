//! Formulas as Coq writes them.

use crate::formula::{Formula, Registry, Relation};
use crate::number::Tree;
use crate::number::tree::Step;
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio, Symbol};
use std::collections::BTreeMap;
use std::fmt;

/// A formula in Coq.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expr {
    Name(String),
    /// Not negative.
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

/// Words that mean something else to Coq, or to our proofs.
const TAKEN: [&str; 27] = [
    "R", "Prop", "Set", "Type", "as", "at", "cofix", "else", "end", "exists", "exp", "fix", "for", "forall",
    "fun", "if", "in", "let", "match", "mod", "nat", "pow", "return", "then", "using", "where", "with",
];

/// The word, or another if that one is taken. A letter with a number is what proofs call what they find.
pub(super) fn free(word: String) -> String {
    let numbered = |rest: &str| !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit());
    let found = word.strip_prefix(|c: char| c == 's' || c.is_ascii_uppercase()).is_some_and(numbered);
    if found || TAKEN.contains(&word.as_str()) { format!("{word}_") } else { word }
}

/// A symbol in letters that Coq takes: ε₄ is eps4, δu is du.
pub(super) fn ascii(symbol: &str) -> String {
    if symbol.is_ascii() && symbol != "H" {
        return free(symbol.replace(|c: char| !c.is_ascii_alphanumeric(), "_"));
    }
    let letter = |c: char| match c {
        'ε' => "eps".to_string(),
        'λ' => "lambda".to_string(),
        'α' => "alpha".to_string(),
        'ρ' => "rho".to_string(),
        'δ' => "d".to_string(),
        'ᵏ' => "_k".to_string(),
        // Powers of two: 2ᵖ is two_p.
        '2' if symbol.starts_with('2') => "two".to_string(),
        'ᵃ' => "_a".to_string(),
        'ᵇ' => "_b".to_string(),
        'ᶠ' => "_f".to_string(),
        'ᵖ' => "_p".to_string(),
        // What begins with H is a hypothesis.
        'H' => "h".to_string(),
        '₀'..='₉' => char::from(b'0' + (c as u32 - '₀' as u32) as u8).to_string(),
        c if c.is_ascii_alphanumeric() => c.to_string(),
        c if c.is_alphabetic() => format!("u{:x}", u32::from(c)),
        _ => "_".to_string(),
    };
    symbol.chars().map(letter).collect()
}

/// A function by its path: `penalty::deflection` is penalty_deflection.
pub(super) fn function(formula: &Formula) -> String {
    free(formula.name().replace("::", "_").replace('.', "_"))
}

impl Expr {
    pub(super) fn name(name: impl Into<String>) -> Self {
        Expr::Name(name.into())
    }

    fn int(n: i32) -> Self {
        let size = Expr::Number(n.unsigned_abs().to_string());
        if n < 0 { size.negated() } else { size }
    }

    fn negated(self) -> Self {
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

    fn simplified(self) -> Self {
        use Operator::*;
        match self {
            Expr::Binary(Add, a, b) if a.is(0) => *b,
            Expr::Binary(Add | Sub, a, b) if b.is(0) => *a,
            Expr::Binary(Sub, a, b) if a.is(0) => b.negated(),
            Expr::Binary(Mul, a, b) if a.is(0) || b.is(1) => *a,
            Expr::Binary(Mul, a, b) if b.is(0) || a.is(1) => *b,
            Expr::Binary(Div, a, b) if a.is(0) || b.is(1) => *a,
            Expr::Neg(a) if a.is(0) => *a,
            other => other,
        }
    }

    /// A polynomial, as a sum of products of powers.
    pub(super) fn poly(poly: &Poly) -> Self {
        let mut sum: Option<Expr> = None;
        for (exponent, part) in by_exponent(poly) {
            let exponential = exponent.map(|e| Expr::Call("exp".into(), vec![Expr::ratio(e)]));
            for (monomial, coefficient) in part.terms().rev() {
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

    pub(super) fn monomial(monomial: &Monomial) -> Self {
        Expr::poly(&monomial.clone().into())
    }

    pub(super) fn ratio(ratio: &Ratio) -> Self {
        Expr::poly(ratio.num()).over(Expr::poly(ratio.den()))
    }

    /// With a name replaced.
    pub(super) fn with(&self, name: &str, by: &Expr) -> Self {
        let with = |a: &Expr| Box::new(a.with(name, by));
        match self {
            Expr::Name(own) if own == name => by.clone(),
            Expr::Name(_) | Expr::Number(_) => self.clone(),
            Expr::Neg(a) => Expr::Neg(with(a)),
            Expr::Binary(operator, a, b) => Expr::Binary(*operator, with(a), with(b)),
            Expr::Power(a, n) => Expr::Power(with(a), *n),
            Expr::Call(function, arguments) => {
                Expr::Call(function.clone(), arguments.iter().map(|a| a.with(name, by)).collect())
            }
        }
    }

    /// What is said of its sign.
    pub(super) fn relation(&self, relation: Relation) -> String {
        match relation {
            Relation::Positive => format!("0 < {self}"),
            Relation::NonNegative => format!("0 <= {self}"),
            Relation::Zero => format!("{self} = 0"),
        }
    }

    /// Every formula that is this one but for one sign: a + for a − or the other way round, or a − lost.
    pub(super) fn flips(&self) -> Vec<Expr> {
        match self {
            Expr::Neg(a) => {
                let inside = a.flips().into_iter().map(Expr::negated);
                std::iter::once((**a).clone()).chain(inside).collect()
            }
            Expr::Binary(operator, a, b) => {
                let own = match operator {
                    Operator::Add => Some(Operator::Sub),
                    Operator::Sub => Some(Operator::Add),
                    Operator::Mul | Operator::Div => None,
                };
                let own = own.map(|flipped| Expr::Binary(flipped, a.clone(), b.clone()));
                let left = a.flips().into_iter().map(|a| Expr::Binary(*operator, a.into(), b.clone()));
                let right = b.flips().into_iter().map(|b| Expr::Binary(*operator, a.clone(), b.into()));
                own.into_iter().chain(left).chain(right).collect()
            }
            Expr::Power(a, n) => a.flips().into_iter().map(|a| Expr::Power(a.into(), *n)).collect(),
            Expr::Call(function, arguments) => {
                let with = |i: usize, flipped| {
                    let mut all = arguments.clone();
                    all[i] = flipped;
                    Expr::Call(function.clone(), all)
                };
                let of = |i: usize| arguments[i].flips().into_iter().map(move |flipped| with(i, flipped));
                (0..arguments.len()).flat_map(of).collect()
            }
            Expr::Name(_) | Expr::Number(_) => Vec::new(),
        }
    }

    /// How strongly it holds together, on Coq's own scale: less is stronger.
    fn level(&self) -> u32 {
        match self {
            Expr::Name(_) | Expr::Number(_) => 0,
            Expr::Call(..) => 10,
            Expr::Power(..) => 30,
            Expr::Neg(_) => 35,
            Expr::Binary(operator, ..) => operator.level(),
        }
    }

    /// As an argument: in brackets unless it is one word.
    pub(super) fn argument(&self) -> String {
        if self.level() > 0 { format!("({self})") } else { self.to_string() }
    }

    /// To be raised to a power.
    pub(super) fn base(&self) -> String {
        if self.level() > 10 { format!("({self})") } else { self.to_string() }
    }

    fn within(&self, level: u32, f: &mut fmt::Formatter) -> fmt::Result {
        if self.level() > level { write!(f, "({self})") } else { write!(f, "{self}") }
    }
}

/// Prints formulas in the names of a registry's functions.
#[derive(Clone, Copy)]
pub(super) struct Printer<'a> {
    pub(super) registry: &'a Registry,
    /// Of functions that compute the same, the first of these is called.
    pub(super) preferred: &'a [&'static str],
}

impl Printer<'_> {
    /// A formula; what a function of the registry computes in it, as a call of that function.
    pub(super) fn expr(self, tree: &Tree) -> Expr {
        let place = |path: &str| self.preferred.iter().position(|known| *known == path);
        let place = |path: &str| place(path).unwrap_or(self.preferred.len());
        match self.registry.calls(tree).min_by_key(|call| place(call.formula.path)) {
            Some(call) => {
                let common = self.registry.common(call.formula);
                let arguments = call.arguments.iter().map(|argument| self.expr(argument));
                let all = common.map(|name| Expr::Name(ascii(name))).chain(arguments).collect();
                Expr::Call(function(call.formula), all)
            }
            None => self.last_step(tree),
        }
    }

    /// What a function does: its last step is its own, unless all it does is call another.
    pub(super) fn body(self, formula: &Formula) -> Expr {
        if self.registry.delegate(formula).is_some() {
            self.expr(&formula.tree)
        } else {
            self.last_step(&formula.tree)
        }
    }

    fn last_step(self, tree: &Tree) -> Expr {
        use Operator::*;
        let of = |tree: &Tree| Box::new(self.expr(tree));
        let expr = match tree.step() {
            Step::Symbol(name) => Expr::Name(ascii(name)),
            Step::Int(n) => Expr::int(*n),
            Step::Neg(a) => Expr::Neg(of(a)),
            Step::Add(a, b) => Expr::Binary(Add, of(a), of(b)),
            Step::Sub(a, b) => Expr::Binary(Sub, of(a), of(b)),
            Step::Mul(a, b) => Expr::Binary(Mul, of(a), of(b)),
            Step::Div(a, b) => Expr::Binary(Div, of(a), of(b)),
            Step::Exp(a) => Expr::Call("exp".into(), vec![*of(a)]),
            Step::PositivePart(a) => Expr::Call("Rmax".into(), vec![*of(a), Expr::int(0)]),
            Step::Min(a, b) => Expr::Call("Rmin".into(), vec![*of(a), *of(b)]),
            Step::Rounded(a) => Expr::Call("fl prec choice".into(), vec![*of(a)]),
        };
        // What the rules of differentiation write is full of 0 x, 1 x and x + 0; nobody else's zeros are
        // touched.
        if tree.site().is_of_duals() { expr.simplified() } else { expr }
    }
}

/// The parts of a polynomial with the same e^…, without it.
pub(super) fn by_exponent(poly: &Poly) -> BTreeMap<Option<&Ratio>, Poly> {
    let mut parts = BTreeMap::<_, Vec<_>>::new();
    for (monomial, coefficient) in poly.terms() {
        parts.entry(monomial.exponent()).or_default().push((monomial.bare(), coefficient.clone()));
    }
    parts.into_iter().map(|(exponent, terms)| (exponent, terms.into_iter().collect())).collect()
}

fn power((symbol, n): (Symbol, u32)) -> Expr {
    let symbol = Expr::Name(ascii(symbol.0));
    match n {
        1 => symbol,
        // As a square wherever it is one, so that its sign is seen.
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
            Expr::Neg(a) => {
                f.write_str("- ")?;
                a.within(34, f)
            }
            Expr::Binary(operator, a, b) => {
                let sign = match operator {
                    Operator::Add => "+",
                    Operator::Sub => "-",
                    Operator::Mul => "*",
                    Operator::Div => "/",
                };
                a.within(operator.level(), f)?;
                write!(f, " {sign} ")?;
                b.within(operator.level() - 1, f)
            }
            Expr::Power(a, n) => {
                a.within(10, f)?;
                write!(f, " ^ {n}")
            }
            Expr::Call(function, arguments) => {
                f.write_str(function)?;
                for argument in arguments {
                    f.write_str(" ")?;
                    argument.within(0, f)?;
                }
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Exponential, Field, PositivePart};

    fn printed(tree: &Tree) -> Expr {
        Printer { registry: &Registry::default(), preferred: &[] }.expr(tree)
    }

    fn text(tree: &Tree) -> String {
        printed(tree).to_string()
    }

    #[test]
    fn brackets_where_coq_needs_them() {
        let [a, b, c] = ["a", "b", "ε₄"].map(|name| Tree::symbol(name));
        assert_eq!(text(&(&a - &(&b - &c))), "a - (b - eps4)");
        assert_eq!(text(&(&a - &b - &c)), "a - b - eps4");
        assert_eq!(text(&(&a / &(&b * &c))), "a / (b * eps4)");
        assert_eq!(text(&(&a * &b / &c)), "a * b / eps4");
        assert_eq!(text(&(-(&a + &b) * &c)), "- (a + b) * eps4");
        // Coq reads - a * b as (- a) * b.
        assert_eq!(text(&-(&a * &b)), "- (a * b)");
        assert_eq!(text(&-(-&a)), "- (- a)");
        assert_eq!(text(&(&a - Tree::int(-2))), "a - - 2");
        assert_eq!(text(&(&a - &b).exp().positive_part()), "Rmax (exp (a - b)) 0");
        assert_eq!(text(&a.min(&-&b)), "Rmin a (- b)");
    }

    #[test]
    fn what_is_taken_is_called_otherwise() {
        let names = ["R", "N", "in", "s1", "N1", "s₁", "H", "λ₀", "σ", "e_1"];
        let letters = ["R_", "N", "in_", "s1_", "N1_", "s1", "h", "lambda0", "u3c3", "e_1"];
        assert_eq!(names.map(ascii), letters);
        let fix = Formula::new("fix", "", &["x"], Tree::symbol("x"));
        assert_eq!(function(&fix), "fix_");
    }

    #[test]
    fn polynomials_are_sums_of_powers() {
        let x = |name| Poly::symbol(Symbol(name));
        let square = x("a") * x("a");
        let fourth = Poly::constant(-3) * &square * &square;
        assert_eq!(Expr::poly(&(fourth + x("b"))).to_string(), "- (3 * (a ^ 2) ^ 2) + b");
        assert_eq!(Expr::poly(&(square * Poly::constant((1, 2)))).to_string(), "a ^ 2 / 2");
        assert_eq!(Expr::poly(&Poly::zero()).to_string(), "0");
    }

    #[test]
    fn a_call_is_a_call_and_a_definition_is_its_own_work() {
        fn double<T: Field>(x: &T) -> T {
            T::int(2) * x
        }
        fn quadruple<T: Field>(x: &T, k: &T) -> T {
            double(&double(x)) * k
        }
        fn again<T: Field>(x: &T) -> T {
            double(x)
        }
        let slope = |x: &Tree| double(&crate::number::Dual::variable(x * x)).derivative;
        let [x, k] = ["x", "k"].map(|name| Tree::symbol(name));
        let all = vec![
            Formula::new("m::double", "", &["x"], double(&x)),
            Formula::new("m::quadruple", "", &["x"], quadruple(&x, &k)),
            Formula::new("m::again", "", &["x"], again(&x)),
            Formula::new("m::slope", "", &["x"], slope(&x)),
        ];
        let registry = Registry::new(&["k", "x"], all);
        let body = |path: &str| {
            let printer = Printer { registry: &registry, preferred: &[] };
            printer.body(registry.formula(path).unwrap()).to_string()
        };
        assert_eq!(body("m::double"), "2 * x");
        assert_eq!(body("m::quadruple"), "m_double (m_double x) * k");
        assert_eq!(body("m::again"), "m_double x");
        // Formed by differentiating, without the zeros and ones.
        assert_eq!(body("m::slope"), "2");
        // What all functions may depend on comes before the arguments, and of those that hand on, the
        // preferred is called.
        let call = quadruple(&(&x + &k), &k);
        let printed = |preferred| Printer { registry: &registry, preferred }.expr(&call).to_string();
        assert_eq!(printed(&[]), "m_quadruple k (x + k)");
        let called = |preferred| Printer { registry: &registry, preferred }.expr(&double(&k)).to_string();
        assert_eq!((called(&[]), called(&["m::again"])), ("m_double k".into(), "m_again k".into()));
    }

    #[test]
    fn a_flip_changes_one_sign() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let flips = printed(&(-(&a + &b) * &c - &a)).flips();
        let texts: Vec<_> = flips.iter().map(Expr::to_string).collect();
        assert_eq!(texts, ["- (a + b) * c + a", "(a + b) * c - a", "- (a - b) * c - a"]);
        // Wherever the sign stands.
        let flips = printed(&a.min(&-(&b + &c)).exp().positive_part()).flips();
        let texts: Vec<_> = flips.iter().map(Expr::to_string).collect();
        assert_eq!(texts, ["Rmax (exp (Rmin a (b + c))) 0", "Rmax (exp (Rmin a (- (b - c)))) 0"]);
    }
}
