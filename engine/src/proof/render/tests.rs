//! Texts of claims and proofs.

use super::*;
use crate::formula::claim::{
    PRECISION, Rate, equal, geometric_limit, induction, limit, non_negative, perturbed_recursion, positive,
    within,
};
use crate::formula::{Hypothesis, Relation, Statement};
use crate::number::{Exponential, PositivePart};
use crate::proof::prove;

#[test]
fn summaries_name_the_kind_of_the_proof() {
    let [a, u] = ["a", "u"].map(|name| Tree::symbol(name));
    let given = Hypothesis::new(Relation::Positive, a.clone());
    let summary = |claim: Statement| proof_summary(&prove(&claim).unwrap());
    assert_eq!(summary(equal("", &u + &u, Tree::from(2) * &u)), "identity");
    assert_eq!(summary(equal("", u.positive_part() - (-&u).positive_part(), &u)), "identity, 2 cases");
    assert_eq!(summary(positive("", &a + &a).assuming([&given])), "sign");
    assert_eq!(summary(positive("", a.round()).assuming([&given])), "sign, any precision");
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
    assert_eq!(paper.describe(&claim, &reason), "no rule finds the sign of a b − c");
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
    assert_eq!(
        ProofPrinter::new(&NONE).claim(&vanishes),
        "k q → 0 for q = (−1 / 2)ʲ and j → ∞, as |−1 / 2| < 1 and it is 0 at q = 0"
    );
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
    assert_eq!(format!("{reason:?}"), "Unequal(a b)");
    // It implements `Error`.
    let error: Box<dyn std::error::Error> = Box::new(reason);
    assert_eq!(error.to_string(), "the sides differ by a b");
}

/// Returns the lines of the proof of a claim if these quantities are positive.
fn lines(claim: Statement, positive: &[&Tree]) -> Vec<String> {
    let given: Vec<_> = positive.iter().map(|x| Hypothesis::new(Relation::Positive, (*x).clone())).collect();
    ProofPrinter::new(&NONE).proof(&prove(&claim.assuming(&given)).unwrap())
}

#[test]
fn the_proof_of_a_rounding_bound_says_what_its_errors_are() {
    let a = Tree::symbol("a");
    let bounded = |of: &Tree| within("", of.round() - of, &a / Tree::symbol(PRECISION));
    let errors = |of: &str| format!("fl(…) = … (1 + eᵢ / (2ᵖ + 1)) with |eᵢ| ≤ 1: e₁ of fl({of})");
    let bound = lines(bounded(&a), &[&a]);
    assert_eq!(bound[..3], [&errors("a"), "s₁ = 2ᵖ − 4 ≥ 0 by 2ᵖ ≥ 4", "2ᵖ + 1 > 0, as it is s₁ + 5"]);
    // The bound − it is a (2ᵖ + 1 − e₁ 2ᵖ)/(2ᵖ (2ᵖ + 1)).
    assert_eq!(
        bound[4..],
        [
            "s₃ = 2ᵖ a e₁ + 2ᵖ a + a > 0, as it is a e₁ s₁ + 4 a e₁ + a s₁ + 5 a",
            "the bound − it is s₂ / (2ᵖ (2ᵖ + 1)) ≥ 0",
            "the bound + it is s₃ / (2ᵖ (2ᵖ + 1)) ≥ 0",
        ]
    );
}

#[test]
fn cases_are_indented() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    assert_eq!(
        lines(positive("", a.min(&b)), &[&a, &b]),
        [
            "case s₁ = b − a > 0:",
            "  min(a, b) = a",
            "  it is a > 0",
            "case s₁ = b − a ≤ 0:",
            "  min(a, b) = b",
            "  it is b > 0",
        ]
    );
    let nested = cases(lines(equal("", in_cases(&a) + in_cases(&b), &a + &b), &[]));
    assert_eq!(nested[..2], ["case s₁ = a > 0:", "  case s₂ = b > 0:"]);
}

#[test]
fn an_identity_shows_each_sign() {
    let [a, b, u] = ["a", "b", "u"].map(|name| Tree::symbol(name));
    assert_eq!(
        lines(positive("", &a * &u * &u - &a * &u + &a), &[&a]),
        ["s₁ = 4 a² u² + a² − 4 a² u ≥ 0", "a u² + a − a u > 0, as 4 a times it is 3 a² + s₁"]
    );
    let given = [Hypothesis::new(Relation::NonNegative, u.clone()), Hypothesis::near(&u, &a, &b)];
    let near = lines(non_negative("", Tree::from(2) * &u + &b).assuming(&given), &[&b]);
    assert_eq!(near[0], "by |u − a| ≤ b: t₁ goes from −1 to 1 as u goes from a − b to a + b");
    let more = &b - Tree::from(2) * &a;
    assert_eq!(
        lines(positive("", &b - &a), &[&a, &more]),
        ["s₁ = b − 2 a > 0 by b > 2 a", "b − a > 0, as it is a + s₁"]
    );
    let tangent = lines(positive("", a.exp() - &a - Tree::from(1)), &[&a]);
    assert_eq!(
        tangent,
        [
            "exp(a) exp(−a) − 1 = 0, as the exponents have the same sum",
            "exp(a) − a − 1 > 0, as exp(x) > 1 + x for x ≠ 0",
        ]
    );
}

/// Claims about equal formulas are not printed as X = X.
#[test]
fn a_claim_about_equal_formulas_says_so() {
    let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
    let claim = |of: Tree| ProofPrinter::new(&NONE).claim(&equal("", of.clone(), of));
    assert_eq!(claim(&a * &b), "both functions are a b");
    assert_eq!(claim(Tree::from(-1)), "it is −1 for all values");
}

/// An absolute value of undecided sign, an order of roundings, and a limit.
#[test]
fn each_part_of_a_proof_is_a_line() {
    let [a, b, u] = ["a", "b", "u"].map(|name| Tree::symbol(name));
    let bound = lines(within("", &u, u.abs() + &a), &[&a]);
    assert_eq!(bound[0], "s₁ = u − t₁ |u| = 0, as u = t₁ |u| with |t₁| ≤ 1");
    let order = lines(non_negative("", (&a + &b).round() - a.round()), &[&b]);
    assert_eq!(
        order[3],
        "s₂ = 2ᵖ b + a e₂ + b e₂ + b − a e₁ ≥ 0, as fl(a + b) ≥ fl(a), since rounding is monotone"
    );
    let decay = limit("", &u * (-&u).exp(), &u, 0, Rate::Equal(&u * (-&u).exp()));
    assert_eq!(lines(decay, &[&u])[2], "  it tends to 0 by its degrees in u, as its exponentials decay");
    let other = &a / &u + (-&u).exp() - (-&u).exp();
    let other = limit("", other.clone(), &u, 0, Rate::Equal(other));
    assert_eq!(lines(other, &[&u])[2], "  it tends to 0 by its degrees in u");
    let size = lines(equal("", u.abs(), &u), &[&u]);
    assert_eq!(size, ["s₁ = |u| − u = 0, as |x| is x or −x", "the difference is s₁ = 0"]);
    let tends = limit("", &a * &u / (&u + &b), &u, &a, Rate::Equal(-&a * &b / (&u + &b)));
    assert_eq!(
        lines(tends, &[&b, &u])[..4],
        [
            "limit: lim [a u / (u + b)] = a for u → ∞",
            "  b + u > 0",
            "  it is a u / (b + u)",
            "  it tends to a by its degrees in u",
        ]
    );
}

/// Returns the sum of this number of symbols.
fn sum_of_symbols(n: usize) -> Tree {
    let letters = ["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m"];
    letters[..n].iter().map(|name| Tree::symbol(name)).reduce(|a, b| a + b).unwrap()
}

/// Returns `of` as a difference, whose proof is in cases of its sign.
fn in_cases(of: &Tree) -> Tree {
    of.positive_part() - (-of).positive_part()
}

/// Returns the lines of a proof that begin cases.
fn cases(proof: Vec<String>) -> Vec<String> {
    proof.into_iter().filter(|line| line.contains("case ")).collect()
}

/// Returns aⁿ.
fn power(n: i32) -> Tree {
    (1..n).fold(Tree::symbol("a"), |power, _| power * Tree::symbol("a"))
}

/// Returns 100 a²ⁿ, or 1000000000 a² for n = 1.
fn long_power(n: i32) -> Tree {
    Tree::from(if n == 1 { 1_000_000_000 } else { 100 }) * power(2 * n)
}

/// Returns `true` if a failure writes out the sum of `n` terms, and `false` if it has the shape of the sum.
fn is_written(term: fn(i32) -> Tree, n: i32) -> bool {
    let claim = equal("", (1..=n).map(term).reduce(|sum, term| sum + term).unwrap(), Tree::from(0));
    let reason = ProofPrinter::new(&NONE).describe(&claim, &prove(&claim).unwrap_err());
    let is_shape = reason == format!("the sides differ by a sum of {n} terms over one of 1");
    assert_ne!(is_shape, reason.ends_with(&term(1).to_string()), "{reason}");
    !is_shape
}

/// The shape of a formula of more than 16 terms, or 100 characters, is written in its place.
#[test]
fn long_formulas_have_a_shape() {
    assert_eq!([16, 17].map(|n| is_written(power, n)), [true, false]);
    // 100 a²⁰ + … + 100 a⁴ + 1000000000 a² has 100 characters.
    let sum = (1..=10).rev().map(long_power).reduce(|sum, power| sum + power).unwrap();
    assert_eq!(sum.to_string().chars().count(), 100);
    assert_eq!([10, 11].map(|n| is_written(long_power, n)), [true, false]);
    let value = |n| {
        let sum = (0..n).fold(Tree::from(0), |sum, i| sum * Tree::symbol("a") + sum_of_symbols(1 + i % 3));
        lines(equal("", &sum + &sum, Tree::from(2) * &sum), &[]).remove(0)
    };
    assert!(value(3).starts_with("both sides are 2 a"));
    assert!(value(12).starts_with("both sides are a sum of "), "{}", value(12));
}

#[cfg(feature = "serde")]
#[test]
fn the_variables_of_certificates_are_described() {
    let [a, b, u] = ["a", "b", "u"].map(|name| Tree::symbol(name));
    let [above, near] = [Hypothesis::new(Relation::Positive, b.clone()), Hypothesis::near(&u, &a, &b)];
    let atoms = |claim: Statement| {
        let proof = prove(&claim.assuming([&above])).unwrap();
        ProofPrinter::new(&NONE).data(&proof).remove(0).atoms
    };
    assert_eq!(atoms(positive("", b.round())), ["2ᵖ", "b", "e₁: fl(b)"]);
    assert_eq!(atoms(positive("", b.exp() + &b)), ["b", "exp(b)", "exp(−b)"]);
    assert_eq!(atoms(within("", &u, u.abs() + &b)), ["b", "u", "|u|", "t₁: u = t₁ |u|"]);
    let between = non_negative("", &u - &a + &b).assuming([&near]);
    assert_eq!(atoms(between), ["a", "b", "u", "t₁: from −1 to 1 in |u − a| ≤ b"]);
}
