//! Names, calls and sites of functions.

use super::*;
use crate::number::Dual;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

/// k = a + b
fn sum(a: &Tree, b: &Tree) -> Tree {
    a + b
}

/// k(a b, b)
fn sum_with_product(a: &Tree, b: &Tree) -> Tree {
    sum(&(a * b), b)
}

fn registry() -> Registry {
    let [a, b] = ["a", "b"].map(x);
    let formula = |path, tree| Formula::new(path, "", &["a", "b"], tree);
    let formulas = vec![formula("sum", sum(&a, &b)), formula("more", sum_with_product(&a, &b))];
    Registry::new(&["b", "a"], formulas)
}

#[test]
fn a_registry_contains_the_location_of_every_operation() {
    let (registry, [c, d]) = (registry(), ["c", "d"].map(x));
    let tree = sum_with_product(&c, &d);
    // The sum belongs to one function, its argument to the other.
    let Op::Add(product, _) = tree.op() else { panic!("{tree} is not a sum") };
    assert!(registry.has_site(&tree.site()) && registry.has_site(&product.site()));
    assert!(!registry.has_site(&(&c * &d).site()));
}

#[test]
fn operations_of_dual_numbers_belong_to_no_function() {
    let a = Dual::coordinate(x("a"), true);
    let slope = (&a * &a).derivative;
    assert!(slope.site().is_in_dual_numbers());
    let registry = Registry::new(&["a"], vec![Formula::new("slope", "", &["a"], slope.clone())]);
    assert!(!registry.has_site(&slope.site()));
}

#[test]
fn a_formula_that_only_looks_the_same_is_not_a_call() {
    let (registry, [c, d]) = (registry(), ["c", "d"].map(x));
    let call = |tree: &Tree| registry.call(tree).map(|call| (call.formula.path, call.arguments));
    assert_eq!(call(&sum(&c, &d)), Some(("sum", vec![c.clone(), d.clone()])));
    assert_eq!(call(&(c + d)), None);
}

#[test]
fn unlisted_symbols_follow_listed_ones() {
    let tree = x("z") * x("a") - x("b") + x("y");
    assert_eq!(registry().symbols_of([&tree]), ["b", "a", "y", "z"]);
}

#[test]
fn the_quantities_of_collected_formulas_are_their_arguments() {
    let formula = |path, arguments: &[&'static str]| Formula::new(path, "", arguments, x("a"));
    let registry = Registry::from_iter([formula("first", &["c", "a"]), formula("second", &["a", "b"])]);
    assert_eq!(registry.symbols_of([&(x("a") * x("b") * x("c"))]), ["c", "a", "b"]);
}

#[test]
fn confusable_symbols_are_found_in_both_directions() {
    let registry = registry().with_confusable(&[["a", "b"], ["c", "a"]]);
    let others = |symbol| registry.confusable_with(symbol).collect::<Vec<_>>();
    assert_eq!((others("a"), others("b"), others("d")), (vec!["b", "c"], vec!["a"], vec![]));
}

/// A symbol in a text has one meaning.
#[test]
fn the_symbol_of_an_abbreviated_function_must_be_unique() {
    let folded = |path, symbol, tree: Tree| Formula::new(path, symbol, &["a"], tree).abbreviated();
    let panics = |formulas: Vec<Formula>| {
        let made = std::panic::catch_unwind(|| Registry::new(&["a", "k"], formulas)).map(|_| ());
        *made.unwrap_err().downcast::<String>().unwrap()
    };
    let double = |symbol| folded("double", symbol, x("a") + x("a"));
    assert_eq!(panics(vec![double("k")]), "double is written as k, which is a quantity");
    let square = folded("square", "d", x("a") * x("a"));
    assert_eq!(panics(vec![double("d"), square]), "square is written as d, and another function too");
    for kept in ["s₁", "e₂₄", "t₆", "x₁", "q", "2ᵖ", "2ᵃ", "fl"] {
        let expected = format!("double is written as {kept}, which is a reserved name of proofs");
        assert_eq!(panics(vec![double(kept)]), expected);
    }
    // Functions that are not abbreviated may share a symbol.
    Registry::new(
        &["a", "k"],
        vec![Formula { abbreviated: false, path: "again", ..double("k") }, double("s")],
    );
}

/// k(a b, b) is a call only if both b are the same; the product is not a call.
#[test]
fn all_occurrences_of_an_argument_must_be_equal() {
    let (registry, [c, d, e]) = (registry(), ["c", "d", "e"].map(x));
    let arguments = |tree: &Tree| {
        let call = registry.calls(tree).find(|call| call.formula.path == "more");
        call.map(|call| call.arguments)
    };
    assert_eq!(arguments(&sum_with_product(&c, &d)), Some(vec![c.clone(), d.clone()]));
    // The same function computed it, but from another product.
    assert_eq!(arguments(&sum(&(&c * &d), &e)), None);
    assert_eq!(registry.call(&sum(&(&c * &d), &e)).map(|call| call.formula.path), Some("sum"));
}

/// k + 2 a, where k is not an argument: it is not a call with another k or another number.
#[test]
fn a_call_differs_from_its_formula_only_in_arguments() {
    let with = |a: &Tree, number: i32, k: &'static str| {
        let (own, n) = (x(k), Tree::from(number));
        own + n * a
    };
    let registry = Registry::new(&["a"], vec![Formula::new("own", "", &["a"], with(&x("a"), 2, "k"))]);
    let is_call = |tree: &Tree| registry.call(tree).is_some();
    assert!(is_call(&with(&x("c"), 2, "k")));
    assert!(!is_call(&with(&x("c"), 3, "k")) && !is_call(&with(&x("c"), 2, "l")));
}
