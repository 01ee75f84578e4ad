//! Texts of claims and proofs.

use super::*;
use crate::formula::claim::{equal, geometric_limit, induction, non_negative, perturbed_recursion, positive};
use crate::formula::{Relation, Statement};
use crate::number::Exponential;
use crate::proof::prove;

#[test]
fn summaries_name_the_method_of_the_proof() {
    let [a, u] = ["a", "u"].map(|name| Tree::symbol(name));
    let given = Hypothesis::new(Relation::Positive, a.clone());
    let summary = |claim: Statement| proof_summary(&prove(&claim).unwrap());
    let is_positive = |of: &Tree| summary(positive("", of).assuming([&given]));
    assert_eq!(summary(equal("", &u + &u, Tree::from(2) * &u)), "identity");
    assert_eq!(summary(equal("", u.positive_part() - (-&u).positive_part(), &u)), "identity, 2 cases");
    let square = &u * &u - Tree::from(2) * &u + Tree::from(2);
    let tangent = a.exp() - &a - Tree::from(1);
    assert_eq!(is_positive(&(&a + &a)), "sign by terms");
    assert_eq!(is_positive(&square), "sign by square");
    let v = Tree::symbol("v");
    assert_eq!(summary(non_negative("", &v * &v * square)), "sign by factors");
    assert_eq!(is_positive(&tangent), "sign by slope");
}

/// The same holds if only a rounded formula contains the name, and with the names of displayed arguments.
#[test]
fn every_name_in_a_claim_is_defined() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    let registry = Registry::new(
        &["a", "b"],
        vec![Formula::new("spring", "c", &["a", "b"], spring(&a, &b)).abbreviated()],
    );
    let names = |of: Tree| {
        let statement = positive("", of);
        let paper = ProofPrinter::new(&registry);
        (paper.claim(&statement), paper.names(&statement))
    };
    assert_eq!(names(spring(&a, &b).round()), ("fl(c) > 0".into(), vec!["c = a b".into()]));
    let other = spring(&b, &(&a + &a)) - spring(&a, &b);
    assert_eq!(names(other), ("c(b, a + a) − c > 0".into(), vec!["c(a, b) = a b".into()]));
}

fn spring(a: &Tree, b: &Tree) -> Tree {
    a * b
}

/// A name that the statement uses for its own quantity does not abbreviate a function.
#[test]
fn a_function_whose_name_is_taken_is_written_out() {
    let [a, b, other] = ["a", "b", "c"].map(|name| Tree::symbol(name));
    let registry = Registry::new(
        &["a", "b"],
        vec![Formula::new("spring", "c", &["a", "b"], spring(&a, &b)).abbreviated()],
    );
    let paper = ProofPrinter::new(&registry);
    let statement = |right: &Tree| equal("", spring(&a, &b) - right, -right + &a * &b);
    let [known, taken] = [&a, &other].map(statement);
    assert_eq!(
        (paper.claim(&known), paper.names(&known)),
        ("c − a = −a + a b".into(), vec!["c = a b".into()])
    );
    assert_eq!((paper.claim(&taken), paper.names(&taken)), ("a b − c = −c + a b".into(), vec![]));
    assert_eq!(paper.proof(&prove(&taken).unwrap()), ["both sides are a b − c"]);
}

/// The index letter has no other meaning, and the base of a power is in brackets.
#[test]
fn the_index_of_a_sequence_is_a_letter_that_does_not_occur_in_the_claim() {
    let [a, k, q] = ["a", "k", "q"].map(|name| Tree::symbol(name));
    let powers = |ratio: &Tree| {
        let statement = induction("", ratio, [a.clone()], |[x]| [x * ratio], [&a * &q]);
        let paper = ProofPrinter::new(&NONE);
        (paper.claim(&statement), paper.proof(&prove(&statement).unwrap())[0].clone())
    };
    let one = Tree::from(1);
    assert_eq!(
        powers(&(&one - &a)),
        (
            "k steps from a, each of x₁ to x₁ (1 − a), lead to a q, where q = (1 − a)ᵏ".into(),
            "by induction on k, with q = (1 − a)ᵏ: for q = 1, and from q to (1 − a) q".into(),
        )
    );
    assert_eq!(
        powers(&(&one - &k)),
        (
            "j steps from a, each of x₁ to x₁ (1 − k), lead to a q, where q = (1 − k)ʲ".into(),
            "by induction on j, with q = (1 − k)ʲ: for q = 1, and from q to (1 − k) q".into(),
        )
    );
    let half = Tree::from(-1) / Tree::from(2);
    let vanishes = geometric_limit("", &half, &k * &q, 0);
    assert_eq!(ProofPrinter::new(&NONE).claim(&vanishes), "k q → 0 for q = (−1 / 2)ʲ and j → ∞");
    let lines = ProofPrinter::new(&NONE).proof(&prove(&vanishes).unwrap());
    assert_eq!(
        lines[..2],
        [
            "q = (−1 / 2)ʲ → 0 if |−1 / 2| < 1, and a function continuous in q at 0 tends to its value there",
            "|−1 / 2| < 1: 1 − 1 / 4 > 0",
        ]
    );
}

static NONE: std::sync::LazyLock<Registry> = std::sync::LazyLock::new(Registry::default);

/// The formula of a computed quantity is part of every claim.
#[test]
fn a_claim_contains_the_definitions_of_computed_quantities() {
    let [a, b, u] = ["a", "b", "u"].map(|name| Tree::symbol(name));
    let near = Hypothesis::near(&u, &a, &b);
    let claim = |claim: Statement| ProofPrinter::new(&NONE).claim(&claim.computing(&u, (&a + &b).round()));
    assert_eq!(claim(positive("", &u + &a).assuming([&near])), "u + a > 0, where u = fl(a + b)");
    let drifts = perturbed_recursion("", &a, 0, |x| x + &u, (a.clone(), b.clone()), |_| []).assuming([&near]);
    assert_eq!(
        claim(drifts),
        "k steps from 0, each of x₁ to x₁ + u, lead to x₁ with |x₁ − a| ≤ b, where q = aᵏ and u = fl(a + b)"
    );
}

#[test]
fn the_reason_for_a_failed_proof_uses_the_names_of_the_registry() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    let statement = equal("", &b + &a * &b, &b);
    let reason = prove(&statement).unwrap_err();
    let registry = Registry::new(&["a", "b"], Vec::new()).with_factors(&["b", "a"]);
    assert_eq!(ProofPrinter::new(&registry).describe(&statement, &reason), "the sides differ by b a");
    // It implements `Error`.
    let error: Box<dyn std::error::Error> = Box::new(reason);
    assert_eq!(error.to_string(), "the sides differ by a b");
}
