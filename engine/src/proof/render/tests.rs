//! Texts of claims and proofs.

use super::*;
use crate::formula::claim::{
    equal, geometric_limit, induction, non_negative, perturbed_recursion, positive, within,
};
use crate::formula::{Relation, Statement};
use crate::number::{Exponential, PositivePart};
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

    let less = &spring(&a, &b) - &other;
    let above = Hypothesis::new(Relation::Positive, less.clone());
    let inside = Hypothesis::between(&other, 0, spring(&a, &b));
    let claim = positive("", less);
    let reason = prove(&claim).unwrap_err();
    let texts = [paper.describe(&claim, &reason), paper.explain(&claim, &reason)];
    assert_eq!(texts, ["no rule finds the sign of a b − c"; 2]);
    assert_eq!(paper.used(&prove(&claim.clone().assuming([&above])).unwrap()), ["c < a b"]);
    let computing = claim.assuming([&inside]).computing(&other, &a * &b);
    assert_eq!(paper.invariants(&computing), ["0 ≤ c ≤ a b"]);
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
    let drifts = perturbed_recursion("", &a).step(|x| x + &u).near(&a, &b).assuming([&near]);
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

/// Returns the lines of the proof of a claim if these quantities are positive.
fn lines(claim: Statement, positive: &[&Tree], in_full: bool) -> Vec<String> {
    let given: Vec<_> = positive.iter().map(|x| Hypothesis::new(Relation::Positive, (*x).clone())).collect();
    let paper = ProofPrinter::new(&NONE);
    let paper = if in_full { paper.in_full() } else { paper };
    paper.proof(&prove(&claim.assuming(&given)).unwrap())
}

/// By hand, with s₁ = 2ᵖ − 4: a / 2ᵖ − a e₁ / (2ᵖ + 1) is a (s₁ + 5 − e₁ (s₁ + 4)) / ((s₁ + 4) (s₁ + 5)).
#[test]
fn the_proof_of_a_rounding_bound_is_short_unless_in_full() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    let bounded = |of: &Tree| within("", of.round() - of, &a / Tree::symbol(PRECISION));
    let scale = "by 2ᵖ ≥ 4: s₁ = 2ᵖ − 4 ≥ 0, so 2ᵖ = s₁ + 4";
    let errors = |of: &str| format!("fl(…) = … (1 + eᵢ / (2ᵖ + 1)) with |eᵢ| ≤ 1: e₁ of fl({of})");
    let triangle = "by the triangle inequality for the errors";
    assert_eq!(
        lines(bounded(&a), &[&a], false),
        [
            &errors("a"),
            scale,
            &format!(
                "the bound less it is (a s₁ + 5 a − a e₁ s₁ − 4 a e₁) / (s₁² + 9 s₁ + 20) ≥ 0, {triangle}"
            ),
            &format!(
                "the bound and it is (a e₁ s₁ + 4 a e₁ + a s₁ + 5 a) / (s₁² + 9 s₁ + 20) ≥ 0, {triangle}"
            ),
        ]
    );
    assert_eq!(
        lines(bounded(&a), &[&a], true),
        [
            scale,
            &errors("a"),
            "2ᵖ ≠ 0: s₁ + 4 > 0, term by term",
            "the bound less it is ≥ 0:",
            "  it is (a s₁ + 5 a − a e₁ s₁ − 4 a e₁) / (s₁² + 9 s₁ + 20)",
            "  s₁² + 9 s₁ + 20 > 0, term by term",
            &format!(
                "  a s₁ + 5 a − a e₁ s₁ − 4 a e₁ > 0: {triangle} it is no less than a > 0, term by term"
            ),
            "the bound and it is ≥ 0:",
            "  it is (a e₁ s₁ + 4 a e₁ + a s₁ + 5 a) / (s₁² + 9 s₁ + 20)",
            "  s₁² + 9 s₁ + 20 > 0, term by term",
            &format!(
                "  a e₁ s₁ + 4 a e₁ + a s₁ + 5 a > 0: {triangle} it is no less than a > 0, term by term"
            ),
        ]
    );
    // The common part of the cases is stated once.
    let extended = bounded(&(&a - &b).positive_part());
    let short = lines(extended.clone(), &[&a, &b], false);
    assert_eq!(short[..3], [&errors("⟨a − b⟩"), scale, "where a − b > 0:"]);
    assert!(short[3..5].iter().all(|line| line.starts_with("  the bound ") && line.ends_with(triangle)));
    assert_eq!(
        short[5..],
        [
            "where a − b ≤ 0:",
            "  the bound less it is a / (s₁ + 4) ≥ 0, term by term",
            "  the bound and it is a / (s₁ + 4) ≥ 0, term by term",
        ]
    );
    assert_eq!(lines(extended, &[&a, &b], true)[0], "case a − b > 0:");
}

/// By hand: the differences at t₁ = −1, 0 and 1, times 2 in the middle, where the square of t₁ counts as −1.
/// With a second square, each of the three is a quadratic in t₂.
#[test]
fn endpoints_are_counted() {
    let [a, b, c, d, u, v] = ["a", "b", "c", "d", "u", "v"].map(|name| Tree::symbol(name));
    let squares = within("", (&a - &b) * (&a - &b), &u * &u).assuming([&Hypothesis::near(&u, &a, &b)]);
    let sum = (&a - &b) * (&a - &b) + (&c - &d) * (&c - &d);
    let both = within("", sum, &u * &u + &v * &v)
        .assuming([&Hypothesis::near(&u, &a, &b), &Hypothesis::near(&v, &c, &d)]);
    let both = lines(both, &[&b, &d, &(&a - &b), &(&c - &d)], false);
    let less = both.iter().find(|line| line.starts_with("the bound less it is ")).unwrap();
    assert!(less.ends_with("at 9 endpoints"), "{less}");
    let [_, _, less, _] = &lines(squares.clone(), &[&b, &(&a - &b)], false)[..] else { panic!("four lines") };
    assert!(less.ends_with("by the triangle inequality for the errors, at 3 endpoints"), "{less}");
    assert_eq!(
        lines(squares, &[&b, &(&a - &b)], true)[3..7],
        [
            "  b² t₁² + 2 b² t₁ + b² + 2 b s₁ t₁ + 2 b s₁ ≥ 0, by its Bernstein form in t₁ from −1 to 1:",
            "  0 = 0",
            "  4 b s₁ > 0, term by term",
            "  4 b² + 4 b s₁ > 0, term by term",
        ]
    );
}

#[test]
fn cases_are_indented() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    assert_eq!(
        lines(positive("", a.min(&b)), &[&a, &b], false),
        [
            "case b − a > 0:",
            "  by the case: s₁ = b − a > 0, so b = a + s₁",
            "  min(a, b) = a by the sign of the second less the first: s₁ > 0, term by term",
            "  a > 0, term by term",
            "case b − a ≤ 0:",
            "  by the case: s₁ = a − b ≥ 0, so a = b + s₁",
            "  min(a, b) = b by the sign of the second less the first: −s₁ ≤ 0, term by term",
            "  b > 0, term by term",
        ]
    );
}

/// Only a sum among the factors has a proof of its own. The multiplier of an assumption has one in full.
#[test]
fn the_sign_of_each_part_is_proved() {
    let [a, b, c, u] = ["a", "b", "c", "u"].map(|name| Tree::symbol(name));
    let (sum, square) = (&a * &b + &c, &a * &a - &a + Tree::from(1));
    let square_lines = [
        "4 (1) (a² + 1 − a) = (2 a − 1)² + (3), hence a² + 1 − a > 0, since",
        "1 > 0, term by term",
        "3 > 0, term by term",
    ];
    assert_eq!(
        lines(positive("", &a * &square), &[&a], false),
        [&["a³ + a − a² = (a) (a² + 1 − a) > 0, since"], &square_lines[..]].concat()
    );
    assert_eq!(
        lines(positive("", &sum * &sum * square / &sum), &[&a, &b, &c], false)[1..],
        [
            &[
                "a³ b + a² c + a b + c − a² b − a c = (a b + c) (a² + 1 − a) > 0, since",
                "a b + c > 0, term by term"
            ],
            &square_lines[..]
        ]
        .concat()
    );
    let given = [Hypothesis::new(Relation::NonNegative, u.clone()), Hypothesis::near(&u, &a, &b)];
    let doubled = non_negative("", Tree::from(2) * &u + &b).assuming(&given);
    let kept = [
        "by |u − a| ≤ b: u = a + b t₁, where −1 ≤ t₁ ≤ 1",
        "it is 2 a + 2 b t₁ + b",
        "of which 2 a + 2 b t₁ has this sign by assumption and the rest",
    ];
    let rest = "b > 0, term by term";
    assert_eq!(lines(doubled.clone(), &[&b], false), [&kept[..], &[rest]].concat());
    assert_eq!(lines(doubled, &[&b], true), [&kept[..], &["2 > 0, term by term", rest]].concat());
}
