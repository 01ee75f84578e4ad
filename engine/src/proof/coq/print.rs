//! Names of formulas and functions in Coq.

use super::expr::Expr;
use super::{PROGRAM, is_part_of_name};
use crate::formula::{Formula, Registry};
use crate::number::Tree;
use crate::number::tree::Op;
use num_traits::Zero;
use std::collections::HashSet;
use std::sync::LazyLock;

/// Keywords of Coq, and words of scripts that do not occur in the files that all theorems require.
const TAKEN: [&str; 26] = [
    "R", "Prop", "Set", "Type", "as", "at", "cofix", "else", "end", "exists", "exp", "fix", "for", "forall",
    "fun", "if", "in", "let", "match", "mod", "nat", "return", "then", "using", "where", "with",
];

/// All words of the files that all theorems require.
static PROGRAM_WORDS: LazyLock<HashSet<&str>> = LazyLock::new(|| {
    let words = PROGRAM.iter().flat_map(|(_, text)| text.split(|c| !is_part_of_name(c)));
    words.filter(|word| !word.is_empty()).collect()
});

/// Returns the name of a function or theorem: the word, or another one if it has a meaning. Proofs use letters with a
/// number.
pub(super) fn free(word: String) -> String {
    let number = word.strip_prefix(|c: char| c == 's' || c.is_ascii_uppercase()).unwrap_or_default();
    let is_numbered = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    let is_taken = TAKEN.contains(&word.as_str()) || PROGRAM_WORDS.contains(word.as_str());
    if is_numbered || is_taken { format!("{word}_") } else { word }
}

/// Returns a symbol in ASCII letters: ε₄ is eps4, δu is du, R is R_.
///
/// Words of Coq and of proofs are capitals, or have several letters, or are the index n or an s with a number. A symbol
/// like these ends with an underscore, as no such word does.
pub(super) fn ascii(symbol: &str) -> String {
    let word: String = symbol.chars().map(ascii_letters).collect();
    let letters: Vec<char> = symbol.chars().filter(char::is_ascii_alphabetic).collect();
    let is_distinct = match letters[..] {
        [] | ['H'] => true,
        ['n'] => word != "n",
        ['s'] => word == "s",
        [letter] => letter.is_ascii_lowercase(),
        _ => false,
    };
    match word.starts_with(|c: char| c.is_ascii_alphabetic()) {
        true if is_distinct => word,
        true => word + "_",
        false => format!("u{word}_"),
    }
}

fn ascii_letters(c: char) -> String {
    match c {
        'ε' => "eps".to_string(),
        'λ' => "lambda".to_string(),
        'α' => "alpha".to_string(),
        'ρ' => "rho".to_string(),
        'δ' => "d".to_string(),
        'ᵏ' => "_k".to_string(),
        // For powers of two: 2ᵖ is two_p.
        '2' => "two".to_string(),
        'ᵃ' => "_a".to_string(),
        'ᵇ' => "_b".to_string(),
        'ᶠ' => "_f".to_string(),
        'ᵖ' => "_p".to_string(),
        // Names that begin with H are hypotheses.
        'H' => "h".to_string(),
        '₀'..='₉' => (u32::from(c) - u32::from('₀')).to_string(),
        c if is_part_of_name(c) => c.to_string(),
        c => format!("u{:x}", u32::from(c)),
    }
}

/// Returns the name of a function from its path: `lens::focus` is lens_focus.
pub(super) fn function(formula: &Formula) -> String {
    free(formula.name().replace("::", "_").replace('.', "_"))
}

/// Returns a formula without the zeros that the rules of differentiation produce, as no divisor of a zero is printed.
pub(super) fn simplified(tree: &Tree) -> Tree {
    tree.rewrite(&|tree| {
        if !tree.site().is_in_dual_numbers() {
            return None;
        }
        match tree.op() {
            Op::Add(a, b) if a.is_zero() => Some(b.clone()),
            Op::Mul(a, _) | Op::Div(a, _) | Op::Neg(a) if a.is_zero() => Some(a.clone()),
            Op::Mul(_, b) if b.is_zero() => Some(b.clone()),
            _ => None,
        }
    })
}

/// Printer of formulas with the names of a registry's functions.
#[derive(Clone, Copy)]
pub(super) struct Printer<'a> {
    pub(super) registry: &'a Registry,
    /// The first of these is called if several functions compute the same.
    pub(super) preferred: &'a [&'static str],
}

impl Printer<'_> {
    /// Returns the printer without preferred functions, for shared definitions.
    pub(super) fn plain(self) -> Self {
        Printer { preferred: &[], ..self }
    }

    /// Returns a formula with calls of the registry's functions.
    pub(super) fn expr(self, tree: &Tree) -> Expr {
        match self.registry.calls(tree).min_by_key(|call| self.preference(call.formula)) {
            Some(call) => {
                let common = self.registry.common_symbols(call.formula).map(|name| Expr::word(ascii(name)));
                let arguments = call.arguments.iter().map(|argument| self.expr(argument));
                Expr::call(&function(call.formula), common.chain(arguments))
            }
            None => self.last_operation(tree),
        }
    }

    /// Returns the position of a function among the preferred ones; others follow.
    fn preference(self, formula: &Formula) -> usize {
        self.preferred.iter().position(|path| *path == formula.path).unwrap_or(self.preferred.len())
    }

    /// Returns the body of a function; its last operation is not replaced by a call unless the function only
    /// calls another one.
    pub(super) fn body(self, formula: &Formula) -> Expr {
        if self.registry.delegated_call(formula).is_some() {
            self.expr(&formula.tree)
        } else {
            self.last_operation(&formula.tree)
        }
    }

    fn last_operation(self, tree: &Tree) -> Expr {
        // The rules of differentiation produce 0 x, 1 x and x + 0; only these are simplified.
        let join = if tree.site().is_in_dual_numbers() { Expr::simplified } else { Expr::binary };
        match tree.op() {
            Op::Symbol(name) => Expr::word(ascii(name)),
            Op::Int(n) if *n < 0 => Expr::word(n.unsigned_abs()).negated(),
            Op::Int(n) => Expr::word(n),
            Op::Neg(a) => self.expr(a).negated(),
            Op::Add(a, b) => join('+', self.expr(a), self.expr(b)),
            Op::Sub(a, b) => join('-', self.expr(a), self.expr(b)),
            Op::Mul(a, b) => join('*', self.expr(a), self.expr(b)),
            Op::Div(a, b) => join('/', self.expr(a), self.expr(b)),
            Op::Exp(a) => Expr::call("exp", [self.expr(a)]),
            Op::PositivePart(a) => Expr::call("Rmax", [self.expr(a), Expr::word(0)]),
            Op::Min(a, b) => Expr::call("Rmin", [self.expr(a), self.expr(b)]),
            Op::Rounded(a) => Expr::call("fl prec choice", [self.expr(a)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Dual, Exponential, Field, PositivePart};

    fn printed(tree: &Tree) -> Expr {
        Printer { registry: &Registry::default(), preferred: &[] }.expr(tree)
    }

    fn text(tree: &Tree) -> String {
        printed(tree).to_string()
    }

    #[test]
    fn only_zeros_of_differentiation_are_removed() {
        let [a, x] = ["a", "x"].map(|name| Tree::symbol(name));
        let [constant, variable] = [Dual::constant(a), Dual::variable(x.clone())];
        for derivative in [&constant * &variable, &variable * &constant, -&constant * &variable] {
            simplified(&derivative.derivative).visit(&mut |tree| {
                let has_zero = match tree.op() {
                    Op::Add(a, _) => a.is_zero(),
                    op => op.operands().any(Tree::is_zero),
                };
                assert!(!has_zero, "{tree:?}");
            });
        }
        assert!(matches!(simplified(&(Tree::from(0) * x)).op(), Op::Mul(..)));
    }

    #[test]
    fn brackets_follow_the_precedence_of_coq() {
        let [a, b, c] = ["a", "b", "ε₄"].map(|name| Tree::symbol(name));
        assert_eq!(text(&(&a - &(&b - &c))), "a - (b - eps4)");
        assert_eq!(text(&(&a - &b - &c)), "a - b - eps4");
        assert_eq!(text(&(&a / &(&b * &c))), "a / (b * eps4)");
        assert_eq!(text(&(&a * &b / &c)), "a * b / eps4");
        assert_eq!(text(&(-(&a + &b) * &c)), "- (a + b) * eps4");
        // Coq parses - a * b as (- a) * b.
        assert_eq!(text(&-(&a * &b)), "- (a * b)");
        assert_eq!(text(&-(-&a)), "- (- a)");
        assert_eq!(text(&(&a - Tree::int(-2))), "a - - 2");
        assert_eq!(text(&(&a - &b).exp().positive_part()), "Rmax (exp (a - b)) 0");
        assert_eq!(text(&a.min(&-&b)), "Rmin a (- b)");
    }

    #[test]
    fn names_of_symbols_are_words_of_neither_coq_nor_proofs() {
        let names = [
            "c", "n", "R", "N", "in", "s", "s1", "N1", "tt", "H", "λ₀", "σ", "∂u", "2ᵖ", "ρᵏ", "e_1", "e'",
            "3x", "",
        ];
        let letters = [
            "c", "n_", "R_", "N_", "in_", "s", "s1_", "N1_", "tt_", "h", "lambda0", "u3c3", "u2202u",
            "two_p", "rho_k", "e_1", "eu27", "u3x_", "u_",
        ];
        assert_eq!(names.map(ascii), letters);
        let words = PROGRAM_WORDS.iter().chain(&TAKEN).filter(|word| word.len() > 1);
        let same: Vec<_> = words.filter(|word| ascii(word) == **word || word.ends_with('_')).collect();
        assert!(same.is_empty(), "{same:?}");
    }

    #[test]
    fn names_of_functions_have_no_other_meaning() {
        let of = |path| function(&Formula::new(path, "", &["x"], Tree::symbol("x")));
        let names = ["lens::focus", "fix", "own::size", "Shown", "s1"];
        assert_eq!(names.map(of), ["lens_focus", "fix_", "own_size_", "Shown_", "s1_"]);
    }

    #[test]
    fn bodies_call_functions_except_for_their_last_operation() {
        fn double<T: Field>(x: &T) -> T {
            T::int(2) * x
        }
        fn quadruple<T: Field>(x: &T, k: &T) -> T {
            double(&double(x)) * k
        }
        fn again<T: Field>(x: &T) -> T {
            double(x)
        }
        let slope = |x: &Tree| (double(&Dual::variable(x * x)) + Dual::int(2) / Dual::int(3)).derivative;
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
        // A derivative, without zeros and ones.
        assert_eq!(body("m::slope"), "2");
        // Common symbols precede the arguments, and the preferred one of the equal functions is called.
        let call = quadruple(&(&x + &k), &k);
        let printed = |preferred| Printer { registry: &registry, preferred }.expr(&call).to_string();
        assert_eq!(printed(&[]), "m_quadruple k (x + k)");
        let again = Printer { registry: &registry, preferred: &["m::again"] };
        let called = |printer: Printer| printer.expr(&double(&k)).to_string();
        assert_eq!([again, again.plain()].map(called), ["m_again k", "m_double k"]);
    }
}
