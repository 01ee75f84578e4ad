//! Formulas and their texts.

use super::*;
use crate::number::{Exponential, Field, PositivePart};

fn s(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn n(n: i32) -> Tree {
    Tree::int(n)
}

/// Compares each tree with its text and its LaTeX.
fn check(cases: &[(Tree, &str, &str)]) {
    for (tree, text, latex) in cases {
        assert_eq!((tree.to_string().as_str(), tree.latex().as_str()), (*text, *latex), "{:?}", tree.op());
    }
}

#[test]
fn signs_move_out_of_brackets_and_products() {
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
        (&c * &decay, "c exp(−b a / (b + c))", r"c\,\mathrm{e}^{-b\,a / (b + c)}"),
        (&decay * &decay, "exp(−b a / (b + c))²", r"(\mathrm{e}^{-b\,a / (b + c)})^2"),
        ((&a - &b).positive_part(), "⟨a − b⟩", r"\langle a - b \rangle"),
        (-&c * fraction, "−c ⟨a / b⟩", r"-c\,\left\langle \frac{a}{b}\right\rangle"),
        ((&a / &b).min(&(&b - &c)), "min(a / b, b − c)", r"\min\left(\frac{a}{b}, b - c\right)"),
        (-(-&a).min(&(&b / &c)), "max(a, −b / c)", r"\max\left(a, -\frac{b}{c}\right)"),
        (-a.min(&b), "−min(a, b)", r"-\min(a, b)"),
        (&c - (-&a).min(&b), "c − min(−a, b)", r"c - \min(-a, b)"),
        ((&a - &b).abs(), "|a − b|", r"\lvert a - b \rvert"),
        (-(&a + &b * &c).with_rounding(), "−fl(a + b c)", r"-\mathrm{fl}(a + b\,c)"),
    ]);
}

#[test]
fn subformulas_are_abbreviated() {
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
fn a_symbol_with_an_exponent_is_bracketed_in_a_power() {
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

/// The text determines the rounding of each operation, in every order; what is rounded once is marked.
#[test]
fn the_text_shows_which_operations_are_rounded() {
    let [a, b, c, scale] = ["a", "b", "c", "2ᵃ"].map(s);
    let sum = (&b + &c).round();
    check(&[
        ((&a + &b * &c).round(), "nearest(a + b c)", r"\mathrm{nearest}(a + b\,c)"),
        (
            (&a + (&b * &c).round() + &a * &b).round(),
            "nearest(a + fl(b c) + a b)",
            r"\mathrm{nearest}(a + \mathrm{fl}(b\,c) + a\,b)",
        ),
        ((&a * (&b + &c)).round(), "nearest(a (b + c))", r"\mathrm{nearest}(a\,(b + c))"),
        ((&a * &sum).round(), "fl(a (b + c))", r"\mathrm{fl}(a\,(b + c))"),
        ((&a + &sum).round(), "fl(a + fl(b + c))", r"\mathrm{fl}(a + \mathrm{fl}(b + c))"),
        ((&sum + &a).round(), "fl(b + c + a)", r"\mathrm{fl}(b + c + a)"),
        ((&a - (&b - &c)).with_rounding(), "fl(a − fl(b − c))", r"\mathrm{fl}(a - \mathrm{fl}(b - c))"),
        (
            (&a / (&b / &c)).with_rounding(),
            "fl(a / fl(b / c))",
            r"\mathrm{fl}\left(\frac{a}{\mathrm{fl}(b / c)}\right)",
        ),
        (
            (&a * (&b / &c)).with_rounding(),
            "fl(a fl(b / c))",
            r"\mathrm{fl}\left(a\,\mathrm{fl}\left(\frac{b}{c}\right)\right)",
        ),
        ((&a * (&b * &c)).with_rounding(), "fl(a fl(b c))", r"\mathrm{fl}(a\,\mathrm{fl}(b\,c))"),
        ((&a * &b * &a).with_rounding(), "fl(fl(a b) a)", r"\mathrm{fl}(\mathrm{fl}(a\,b)\,a)"),
        ((&a * &b * n(3)).with_rounding(), "fl(3 fl(a b))", r"\mathrm{fl}(3 \mathrm{fl}(a\,b))"),
        ((n(1) * &a + &b).with_rounding(), "fl(fl(a) + b)", r"\mathrm{fl}(\mathrm{fl}(a) + b)"),
        ((&a / n(1) + &b).with_rounding(), "fl(fl(a) + b)", r"\mathrm{fl}(\mathrm{fl}(a) + b)"),
        ((a.round() + &b).round(), "fl(fl(a) + b)", r"\mathrm{fl}(\mathrm{fl}(a) + b)"),
        (((a.round() * &b).round() * &a).round(), "fl(fl(a) b a)", r"\mathrm{fl}(\mathrm{fl}(a)\,b\,a)"),
        ((&a * &b / &c).with_rounding(), "fl(a b / c)", r"\mathrm{fl}\left(\frac{a\,b}{c}\right)"),
        (
            (&a * &a / &b).with_rounding(),
            "fl(fl(a²) / b)",
            r"\mathrm{fl}\left(\frac{\mathrm{fl}(a^2)}{b}\right)",
        ),
        ((n(3) * &a / &b).with_rounding(), "fl(3 a / b)", r"\mathrm{fl}\left(\frac{3 a}{b}\right)"),
        (
            ((n(3) * &a) / (n(2) * &b)).with_rounding(),
            "fl(fl(3 a) / fl(2 b))",
            r"\mathrm{fl}\left(\frac{\mathrm{fl}(3 a)}{\mathrm{fl}(2 b)}\right)",
        ),
        ((&a * &scale + &b).round(), "fl(a 2ᵃ + b)", r"\mathrm{fl}(a\,2^a + b)"),
        ((&scale * &a + &b).round(), "fl(2ᵃ a + b)", r"\mathrm{fl}(2^a\,a + b)"),
        ((&a * &b).positive_part().round(), "fl(⟨a b⟩)", r"\mathrm{fl}(\langle a\,b \rangle)"),
        ((&a * (&scale * &scale) + &b).round(), "fl(a (2ᵃ)² + b)", r"\mathrm{fl}(a\,(2^a)^2 + b)"),
        ((-(&a + &b)).round(), "fl(−a − b)", r"\mathrm{fl}(-a - b)"),
        (((&a + n(0)).round() + &b).round(), "fl(fl(a) + b)", r"\mathrm{fl}(\mathrm{fl}(a) + b)"),
        (((&a + &b) * &scale).round(), "fl((a + b) 2ᵃ)", r"\mathrm{fl}((a + b)\,2^a)"),
        (((&a * &scale * n(3)).round() * &b).round(), "fl(3 a 2ᵃ b)", r"\mathrm{fl}(3 a\,2^a\,b)"),
        (
            (&b - (&a * &b).round().positive_part()).round(),
            "fl(b − ⟨fl(a b)⟩)",
            r"\mathrm{fl}(b - \langle \mathrm{fl}(a\,b) \rangle)",
        ),
    ]);
}

#[test]
fn the_base_of_a_power_is_bracketed_if_needed() {
    let [a, b, rho] = ["a", "b", "ρᵏ"].map(s);
    for (tree, expected) in [
        (a.clone(), "aᵏ"),
        (n(2), "2ᵏ"),
        (n(-2), "(−2)ᵏ"),
        (-&a, "(−a)ᵏ"),
        (n(1) - &a, "(1 − a)ᵏ"),
        (&a * &b, "(a b)ᵏ"),
        (&a * &a, "(a²)ᵏ"),
        (&a / &b, "(a / b)ᵏ"),
        (n(1) / n(2), "(1 / 2)ᵏ"),
        (rho, "(ρᵏ)ᵏ"),
        (a.exp(), "exp(a)ᵏ"),
        ((&a - &b).abs(), "|a − b|ᵏ"),
        ((&a - &b).round(), "fl(a − b)ᵏ"),
    ] {
        assert_eq!(tree.raised("ᵏ", &|_| None), expected);
    }
}

/// 5·2ᵖ and not 52ᵖ.
#[test]
fn a_number_is_separated_from_a_symbol_that_begins_with_a_digit() {
    let [a, power] = ["a", "2ᵖ"].map(s);
    check(&[
        (n(5) * &power * &a, "5·2ᵖ a", r"5 \cdot 2^p\,a"),
        (&a * n(5) * &power, "5 a 2ᵖ", r"5 a\,2^p"),
        (n(5) * &power * &power, "5 (2ᵖ)²", "5 (2^p)^2"),
    ]);
}

/// Unusual formulas with texts written by hand.
#[test]
fn unusual_formulas_keep_their_signs_and_brackets() {
    let [a, b, c, d] = ["a", "b", "c", "d"].map(s);
    let text = |tree: Tree| tree.to_string();
    for (tree, expected) in [
        (&a - (&b - (&c - &d)), "a − b + c − d"),
        (-(&a - (&b + &c)), "−a + b + c"),
        (&a - n(-2) * (&b - &c), "a + 2 (b − c)"),
        (-(&a + &b) * -(&a + &b), "(a + b)²"),
        (-((&a + &b) * (&a + &b)), "−(a + b)²"),
        (-(&a * &a), "−a²"),
        ((-&a) * (-&a), "a²"),
        ((-&a) * (-&a) * (-&a), "−a³"),
        (&a / (&b / &c) / &d, "a c / (b d)"),
        (&a / (&b / (&c / &d)), "a c / (b d)"),
        (&a / (&b * &c / &d), "a d / (b c)"),
        ((&a / &b) / (&c / &d), "a d / (b c)"),
        (&a / -(&b - &c), "−a / (b − c)"),
        (-&a / -&b, "a / b"),
        (&a - -(-&b), "a − b"),
        (&a * -&b - -&c * &d, "−a b + c d"),
        ((&a + &b) * (&c - &d), "(a + b) (c − d)"),
        ((&a + &b) / (&c - &d) / (&a + &b), "(a + b) / ((c − d) (a + b))"),
        ((&a / &b) * (&a / &b), "(a / b)²"),
        (&a * &b * (&a * &b), "(a b)²"),
        (n(-3) / &a, "−3 / a"),
        (n(-3) / n(-6) * &a, "a / 2"),
        (&a - n(1) / n(-2), "a + 1 / 2"),
        (n(2) * (n(3) * &a), "6 a"),
        ((n(2) * &a) * (n(2) * &a), "(2 a)²"),
        ((-&a / &b).exp(), "exp(−a / b)"),
        ((-(&a - &b)).exp(), "exp(−a + b)"),
        ((&a / (&b / &c)).exp() / (-&a).exp(), "exp(a c / b) / exp(−a)"),
        ((-(&a + &b)).abs() * -&c, "−|−a − b| c"),
        (&a - (&b - &c).abs() * (&c - &b).positive_part(), "a − |b − c| ⟨c − b⟩"),
        ((&a.abs() - &b).abs(), "||a| − b|"),
        (a.abs() * (&b * c.abs()).abs(), "|a| |b |c||"),
        (-((-&a).min(&-&b)), "max(a, b)"),
        (-((-&a).min(&b)) / &c, "−min(−a, b) / c"),
        (-(&a - &b).round() - (&a + &b).round(), "−fl(a − b) − fl(a + b)"),
        (&a - (-&b).round(), "a − fl(−b)"),
    ] {
        assert_eq!(text(tree), expected);
    }
}

#[test]
fn a_formula_that_is_too_deep_is_replaced_by_its_size() {
    let x = Tree::symbol("x");
    let sum = |terms: u32| (1..terms).fold(x.clone(), |sum, _| sum + &x);
    assert_eq!(sum(2).to_string(), "x + x");
    assert!(sum(MAX_DEPTH + 1).to_string().ends_with("x + x"));
    assert_eq!(sum(100_000).to_string(), "a formula of 199999 operations and quantities");
}
