//! Claims and proofs as they are written.

use super::*;
use crate::formula::claim::{drift, equal, induction, non_negative, positive, vanishing};
use crate::formula::{Relation, Statement};
use crate::number::Exponential;
use crate::proof::prove;

#[test]
fn in_a_few_words_it_is_said_how() {
    let [a, u] = ["a", "u"].map(|name| Tree::symbol(name));
    let given = Hypothesis::new(Relation::Positive, a.clone());
    let how = |claim: Statement| how(&prove(&claim).unwrap());
    let is_positive = |of: &Tree| how(positive("", of).assuming([&given]));
    assert_eq!(how(equal("", &u + &u, Tree::from(2) * &u)), "identity");
    assert_eq!(how(equal("", u.positive_part() - (-&u).positive_part(), &u)), "identity, 2 cases");
    let square = &u * &u - Tree::from(2) * &u + Tree::from(2);
    let tangent = a.exp() - &a - Tree::from(1);
    assert_eq!(is_positive(&(&a + &a)), "sign by terms");
    assert_eq!(is_positive(&square), "sign by square");
    let v = Tree::symbol("v");
    assert_eq!(how(non_negative("", &v * &v * square)), "sign by factors");
    assert_eq!(is_positive(&tangent), "sign by slope");
}

/// Also where only what is rounded has the name, and with the names of arguments that are said.
#[test]
fn every_name_in_a_claim_is_defined() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    let registry =
        Registry::new(&["a", "b"], vec![Formula::new("spring", "c", &["a", "b"], spring(&a, &b)).folded()]);
    let names = |of: Tree| {
        let statement = positive("", of);
        let paper = Paper::new(&registry);
        (paper.claim(&statement), paper.names(&statement))
    };
    assert_eq!(names(spring(&a, &b).nearest()), ("fl(c) > 0".into(), vec!["c = a b".into()]));
    let other = spring(&b, &(&a + &a)) - spring(&a, &b);
    assert_eq!(names(other), ("c(b, a + a) − c > 0".into(), vec!["c(a, b) = a b".into()]));
}

fn spring(a: &Tree, b: &Tree) -> Tree {
    a * b
}

/// A name that the statement has for a quantity of its own is not written for a function as well.
#[test]
fn a_name_that_is_taken_is_written_out() {
    let [a, b, other] = ["a", "b", "c"].map(|name| Tree::symbol(name));
    let registry =
        Registry::new(&["a", "b"], vec![Formula::new("spring", "c", &["a", "b"], spring(&a, &b)).folded()]);
    let paper = Paper::new(&registry);
    let statement = |right: &Tree| equal("", spring(&a, &b) - right, -right + &a * &b);
    let [known, taken] = [&a, &other].map(statement);
    assert_eq!(
        (paper.claim(&known), paper.names(&known)),
        ("c − a = −a + a b".into(), vec!["c = a b".into()])
    );
    assert_eq!((paper.claim(&taken), paper.names(&taken)), ("a b − c = −c + a b".into(), vec![]));
    assert_eq!(paper.proof(&prove(&taken).unwrap()), ["both sides are a b − c"]);
}

/// The letter that counts steps stands for nothing else, and what a power is of is in brackets.
#[test]
fn steps_are_counted_by_a_letter_of_their_own() {
    let [a, k, q] = ["a", "k", "q"].map(|name| Tree::symbol(name));
    let powers = |ratio: &Tree| {
        let statement = induction("", ratio, [a.clone()], |[x]| [x * ratio], [&a * &q]);
        let paper = Paper::new(&NONE);
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
    let vanishes = vanishing("", &half, &k * &q, 0);
    assert_eq!(Paper::new(&NONE).claim(&vanishes), "k q → 0 for q = (−1 / 2)ʲ and j → ∞");
    let lines = Paper::new(&NONE).proof(&prove(&vanishes).unwrap());
    assert_eq!(
        lines[..2],
        [
            "q = (−1 / 2)ʲ → 0 if |−1 / 2| < 1, and what is continuous in q at 0 tends to what it is there",
            "|−1 / 2| < 1: 1 − 1 / 4 > 0",
        ]
    );
}

static NONE: std::sync::LazyLock<Registry> = std::sync::LazyLock::new(Registry::default);

/// What is computed is part of what is claimed, whatever the claim.
#[test]
fn it_is_said_how_a_quantity_is_computed() {
    let [a, b, u] = ["a", "b", "u"].map(|name| Tree::symbol(name));
    let near = Hypothesis::near(&u, &a, &b);
    let claim = |claim: Statement| Paper::new(&NONE).claim(&claim.computing(&u, (&a + &b).nearest()));
    assert_eq!(claim(positive("", &u + &a).assuming([&near])), "u + a > 0, where u = fl(a + b)");
    let drifts = drift("", &a, 0, |x| x + &u, (a.clone(), b.clone()), |_| []).assuming([&near]);
    assert_eq!(
        claim(drifts),
        "k steps from 0, each of x₁ to x₁ + u, lead to x₁ with |x₁ − a| ≤ b, where q = aᵏ and u = fl(a + b)"
    );
}

#[test]
fn why_there_is_no_proof_is_said_in_the_names_of_the_registry() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    let statement = equal("", &b + &a * &b, &b);
    let why = prove(&statement).unwrap_err();
    let registry = Registry::new(&["a", "b"], Vec::new()).with_factors(&["b", "a"]);
    assert_eq!(Paper::new(&registry).why(&statement, &why), "the sides differ by b a");
    // It is an error like any other.
    let error: Box<dyn std::error::Error> = Box::new(why);
    assert_eq!(error.to_string(), "the sides differ by a b");
}
