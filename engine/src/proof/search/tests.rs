//! Tests of what is proved and what must not be proved.

use super::*;
use crate::formula::Relation;
use crate::formula::claim::{
    PRECISION, derivative, equal, geometric_limit, induction, perturbed_recursion, positive, within,
};
use crate::formula::statement::minimum_precision;
use crate::number::{Exponential, Field, PositivePart};
use crate::proof::check::MAX_VARIABLES;
use crate::proof::{MAX_DEPTH, Proof, prove};

mod sequences;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn above_zero(value: Tree) -> Hypothesis {
    Hypothesis::new(Relation::Positive, value)
}

fn not_below_zero(value: Tree) -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, value)
}

fn outcome(hypotheses: Vec<Hypothesis>, proposition: Proposition) -> Result<Proof, ProofError> {
    prove(&Statement::new("", proposition).assuming(&hypotheses))
}

fn proved(hypotheses: Vec<Hypothesis>, proposition: Proposition) -> bool {
    outcome(hypotheses, proposition).is_ok()
}

fn int(n: i32) -> Tree {
    Tree::from(n)
}

/// The reason names what no rule proves.
#[test]
fn reasons_are_specific() {
    let [c, t, u] = ["c", "t", "u"].map(x);
    let one = Proposition::Equal(&c / &c, int(1));
    assert!(matches!(outcome(vec![], one), Err(ProofError::PossibleZeroDivisor(of, _)) if of == c));
    let bracket = Proposition::Derivative(u.positive_part(), "u", int(1));
    assert!(matches!(outcome(vec![], bracket), Err(ProofError::NotDifferentiable)));
    let positive = Proposition::Sign(Relation::Positive, u.clone());
    assert!(matches!(
        outcome(vec![], positive),
        Err(ProofError::WrongSign(..) | ProofError::UnknownSign(..))
    ));
    // No precision satisfies the hypothesis 2ᵖ = −1.
    let impossible = Hypothesis::between(&x(PRECISION), int(-1), int(-1));
    let rounded = outcome(vec![impossible], Proposition::Equal(u.round(), u.round()));
    let largest = x(PRECISION) + int(1);
    assert!(matches!(rounded, Err(ProofError::PossibleZeroDivisor(of, _)) if of == largest));
    // A limit is named, rather than the sign by which a rule might have found it.
    let bounded = &t / (int(1) + &c * &t);
    for (hypothesis, of, to) in
        [(above_zero(c.clone()), bounded, 1), (above_zero(t.clone()), &t * (&u * &t).exp(), 0)]
    {
        let outcome =
            outcome(vec![above_zero(t.clone()), hypothesis], Proposition::Limit(of.clone(), "t", int(to)));
        assert!(matches!(outcome, Err(ProofError::UnknownLimit(_))), "{of}");
    }
    // A hypothesis on another symbol is not one on the variable, and a case distinction decides a bracket.
    let limit = || Proposition::Limit(int(1) / (int(1) + &t * &t), "t", int(0));
    let undefined = outcome(vec![above_zero(int(1) / &c)], limit());
    assert!(matches!(undefined, Err(ProofError::PossibleZeroDivisor(of, _)) if of == c));
    assert!(proved(vec![above_zero((u.positive_part() + int(1)) * &t)], limit()));
    // A hypothesis that excludes large values of the variable.
    for ending in [above_zero(&c - &t), above_zero(&c * &t), Hypothesis::between(&t, int(1), int(2))] {
        let outcome =
            outcome(vec![ending.clone()], Proposition::Limit(int(1) / (int(1) + &t * &t), "t", int(0)));
        assert!(matches!(outcome, Err(ProofError::EndingHypothesis(of)) if of == ending.value), "{ending}");
    }
}

/// fl(a) ≥ fl(b) follows from a ≥ b.
#[test]
fn rounding_preserves_the_order_of_positive_parts() {
    let [a, b] = ["a", "b"].map(x);
    let [f, g] = [&a, &b].map(|of| of.round().positive_part().round());
    let known = vec![not_below_zero(&a - &b), not_below_zero(x(PRECISION) - int(4))];
    assert!(proved(known, Proposition::Sign(Relation::NonNegative, f - g)));
}

/// A lower bound of the variable of a limit leaves its large values, an upper bound does not.
#[test]
fn bounds_of_the_variable_of_a_limit_leave_large_values() {
    let [f, g, h] = ["f", "g", "h"].map(x);
    let limit = |of: &Tree| Proposition::Limit(int(1) / (int(1) + of * of), "g", int(0));
    assert!(proved(vec![above_zero(&g - &f)], limit(&g)));
    assert!(proved(
        vec![above_zero(f.clone()), above_zero(g.clone()), above_zero(&g - &f), above_zero(&g - &h)],
        limit(&g)
    ));
    assert!(proved(vec![above_zero(&g * &g - &f)], limit(&g)));
    for bound in [&f - &g, &h * &g - &f, &f * &f - &g * &g, &f - &g * &g * &g, &g.exp() - &f] {
        assert!(!proved(vec![above_zero(bound.clone())], limit(&g)), "{bound} > 0");
    }
    // The search replaces f by the bound + s; yet 1/(1 + f²) does not depend on g.
    for bound in [&g * &h, -&g * &h, &g * &g] {
        assert!(!proved(vec![above_zero(&f - &bound)], limit(&f)), "f > {bound}");
    }
    // The sign of h is that of an exponent that is not in the quantity.
    let cancelled = (&g * &h).exp() - (&g * &h).exp();
    assert!(proved(vec![above_zero(g.clone())], Proposition::Limit(int(1) / &g + cancelled, "g", int(0))));
    // −1/g ≤ f ≤ 1/g excludes large g unless f = 0.
    let near = Hypothesis::near(&f, int(0), int(1) / &g);
    assert!(!proved(vec![above_zero(g.clone()), near], Proposition::Limit(f, "g", int(0))));
}

#[test]
fn nested_case_distinctions_are_limited() {
    let positive_parts = |n: u32| {
        let all = ["u", "v", "w", "y", "z"].map(|name| x(name).positive_part());
        let sum = all.into_iter().take(n as usize).fold(int(0), |sum, bracket| sum + bracket);
        outcome(vec![], Proposition::Equal(sum.clone(), sum))
    };
    assert!(positive_parts(MAX_NESTED_CASES as u32).is_ok());
    assert!(matches!(positive_parts(MAX_NESTED_CASES as u32 + 1), Err(ProofError::UndecidedBranch(_))));
}

#[test]
fn statements_and_proofs_of_excessive_size_are_rejected() {
    let too_large =
        |proposition: Proposition, expected: &str| match outcome(vec![minimum_precision()], proposition) {
            Err(ProofError::Premise(Premise::TooLarge(quantity, _))) => quantity == expected,
            Err(ProofError::TooLarge(_)) => expected == "its proof",
            Err(ProofError::NotExpressed("it is too large")) => expected == "its proof",
            _ => false,
        };
    let sum = |terms: u32| (1..terms).fold(x("u"), |sum, _| sum + x("u"));
    let same = |tree: Tree| Proposition::Equal(tree.clone(), tree);
    assert!(too_large(same(sum(30_000)), "its depth"));
    assert!(too_large(same(sum(MAX_DEPTH + 2)), "its depth"));
    assert!(proved(
        vec![],
        Proposition::Equal(sum(MAX_DEPTH + 1), Tree::from(MAX_DEPTH as i32 + 1) * x("u"))
    ));
    // Repeated doubling makes a formula large but not deep.
    let doubled = |times: u32| (0..times).fold(x("u"), |sum, _| &sum + &sum);
    assert!(too_large(same(doubled(100)), "its size"));
    assert!(too_large(same(doubled(13)), "its size"));
    assert!(proved(vec![], Proposition::Equal(doubled(12), int(1 << 12) * x("u"))));
    // Nine roundings of sums and products have too many products of errors.
    let [a, b, c, d, u, v, w] = ["a", "b", "c", "d", "u", "v", "w"].map(x);
    let sums = (u.positive_part() + &a) * (v.min(&w) + &b) * (&u + &v) * (&v + &w) * (&w + &a);
    let quotient = sums / ((int(1) + &d * &d) * (int(1) + &c * &c));
    assert!(too_large(
        Proposition::Within(quotient.with_rounding() - &quotient, int(1) / x(PRECISION)),
        "its proof"
    ));
    // Further examples are powers of powers, long products, and deeply nested positive parts and roundings.
    let equal_to = |a: &'static str, value: Tree| Hypothesis::new(Relation::Zero, x(a) - value);
    let exceeds = |hypotheses: Vec<Hypothesis>, proposition: Proposition| {
        matches!(
            outcome(hypotheses, proposition),
            Err(ProofError::TooLarge(_) | ProofError::NotExpressed("it is too large"))
        )
    };
    let power = |b: &'static str, n: u32| (0..n).fold(int(1), |power, _| power * x(b));
    let chain = [("a", "b"), ("b", "c"), ("c", "d"), ("d", "f")].map(|(a, b)| equal_to(a, power(b, 400)));
    assert!(exceeds(chain.to_vec(), Proposition::Sign(Relation::NonNegative, x("a") - x("f"))));
    let chain = ["a", "b", "c", "d", "f", "g"];
    let nested =
        chain.windows(2).map(|pair| equal_to(pair[1], x(pair[0]).exp() + (int(2) * x(pair[0])).exp()));
    // Exponents of exponents of … are unknown to the search from the fourth on, and e to their power is positive.
    assert!(proved(nested.collect(), Proposition::Sign(Relation::Positive, x("g"))));
    let names =
        ["a₀", "a₁", "a₂", "a₃", "a₄", "a₅", "a₆", "a₇", "a₈", "a₉", "b₀", "b₁", "b₂", "b₃", "b₄", "b₅"];
    let sum = || names.iter().fold(int(0), |sum, name| sum + x(name));
    let power = |n: usize| (0..n).fold(int(1), |power, _| power * sum());
    assert!(exceeds(vec![], Proposition::Equal(power(9), power(9))));
    let chains = |deeper: fn(&Tree) -> Tree| {
        let deep = |name: &&'static str| (0..480).fold(x(name), |tree, _| deeper(&tree));
        names.iter().map(deep).fold(int(0), |sum, tree| sum + tree)
    };
    let positive: Vec<_> = names.iter().map(|name| above_zero(x(name))).collect();
    let positive_parts = chains(|tree| tree.positive_part());
    assert!(proved(positive.clone(), Proposition::Sign(Relation::Positive, positive_parts)));
    let roundings = Proposition::Sign(Relation::Positive, chains(|tree| tree.round()));
    assert!(exceeds(positive, roundings));
}

#[test]
fn the_number_of_roundings_is_limited() {
    let roundings = |n: usize| {
        let sum = (0..n as i32).map(|i| (x("u") + int(i)).round()).fold(int(0), |sum, term| sum + term);
        outcome(vec![minimum_precision()], Proposition::Equal(sum.clone(), sum)).map(drop)
    };
    // Each has an error, which is a variable like u, the precision, and the fact that the precision is known by.
    assert!(roundings(MAX_VARIABLES - 3).is_ok());
    assert!(matches!(roundings(MAX_VARIABLES - 1), Err(ProofError::NotExpressed("it is too large"))));
}

#[test]
fn opposite_quantities_have_the_same_absolute_value() {
    let [one, other] = [x("a") - x("b"), x("b") - x("a")].map(|of| of.abs());
    assert!(proved(vec![], Proposition::Equal(one.clone(), other.clone())));
    assert!(!proved(vec![], Proposition::Equal(one, other + int(1))));
}
