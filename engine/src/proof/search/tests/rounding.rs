//! Tests of propositions about rounding.

use super::*;
use crate::proof::check::MAX_VARIABLES;

/// Returns `true` if the proposition is proved for every precision of at least two bits.
fn rounded(hypotheses: Vec<Hypothesis>, proposition: Proposition) -> bool {
    proved([vec![minimum_precision()], hypotheses].concat(), proposition)
}

#[test]
fn bounds_of_a_rounding_error_are_sharp() {
    let error = || x("u").round() - x("u");
    let within = |bound: Tree| rounded(vec![], Proposition::Within(error(), bound));
    assert!(within(x("u").abs() / (precision() + int(1))));
    assert!(within(x("u").abs() / precision()));
    assert!(within(x("u").round().abs() / precision()));
    assert!(!within(x("u").abs() / (precision() + int(2))));
    assert!(!within(x("u").round().abs() / (precision() + int(1))));
    // The error may differ from 0 and have either sign.
    assert!(!rounded(vec![], Proposition::Equal(x("u").round(), x("u"))));
    assert!(!rounded(vec![above_zero(x("u"))], Proposition::Sign(Relation::NonNegative, error())));
}

#[test]
fn the_number_of_roundings_is_limited() {
    let roundings = |n: usize| {
        let all = (0..n as i32).map(|i| (x("u") + int(i)).round());
        let sum = all.fold(Tree::zero(), |sum, term| sum + term);
        let same = Proposition::Equal(sum.clone(), sum);
        let derived = prove_proposition(&same, vec![&minimum_precision()]).map(drop);
        [derived, outcome(vec![minimum_precision()], same).map(drop)]
    };
    // Each has an error, which is a variable like u, the precision, and the fact that the precision is known by.
    assert!(roundings(MAX_VARIABLES - 3).iter().all(Result::is_ok));
    let is_refused = |of: &Result<(), _>| matches!(of, Err(ProofError::NotExpressed("it is too large")));
    assert!(roundings(MAX_VARIABLES - 1).iter().all(is_refused));
}

#[test]
fn formulas_equal_up_to_a_power_of_two_have_the_same_rounding_error() {
    let equal = |a: Tree, b: Tree| rounded(vec![], Proposition::Equal(a, b));
    assert!(equal((x("a") + x("b")).round(), (x("b") + x("a")).round()));
    assert!(equal((x("a") * x("2ᵃ") / x("2ᶠ")).round(), x("a").round() * x("2ᵃ") / x("2ᶠ")));
    assert!(!equal((x("a") * x("b")).round(), x("a").round() * x("b")));
    assert!(!equal((x("a") * int(3)).round(), x("a").round() * int(3)));
    assert!(!equal((x("a") + x("2ᵃ")).round(), (x("a") / x("2ᵃ") + int(1)).round()));
    // Quotients differ if only the numerators or only the divisors are equal.
    let positive = || ["c", "d"].map(|name| above_zero(x(name))).to_vec();
    let products_agree = |a: Tree, b: Tree, c: Tree, d: Tree| {
        let [left, right] = [(a / &c).round() * c, (b / &d).round() * d];
        rounded(positive(), Proposition::Equal(left, right))
    };
    assert!(!products_agree(x("a"), x("a"), x("c"), x("d")));
    assert!(products_agree(x("a"), x("a"), x("c"), x("c")));
    assert!(!rounded(
        positive(),
        Proposition::Equal((x("a") / x("c")).round() * x("b"), (x("b") / x("c")).round() * x("a"))
    ));
    // A sum and its terms are rounded separately.
    assert!(!equal((x("a") + x("b")).round() - x("a"), x("b").round()));
}

#[test]
fn rounding_is_monotone() {
    let no_less = |hypotheses: Vec<Hypothesis>, a: Tree, b: Tree| {
        rounded(hypotheses, Proposition::Sign(Relation::NonNegative, a.round() - b.round()))
    };
    let [a, b, c] = ["a", "b", "c"].map(x);
    let ordered = |sign: &Tree| vec![not_below_zero(&a - &b), above_zero(sign.clone())];
    assert!(no_less(ordered(&c), a.clone(), b.clone()));
    assert!(!no_less(ordered(&c), b.clone(), a.clone()));
    assert!(!no_less(vec![], a.clone(), b.clone()));
    // A minus reverses the order, and so does a negative factor.
    assert!(no_less(ordered(&c), (&c - &b).round(), (&c - &a).round()));
    assert!(!no_less(ordered(&c), (&c - &a).round(), (&c - &b).round()));
    assert!(
        no_less(ordered(&c), &a * &c, &b * &c) && no_less(ordered(&c), (&a / &c).round(), (&b / &c).round())
    );
    // Rounded operands are compared by their arguments only.
    let near = [&a, &b].map(|tree| tree.round());
    let [near_a, near_b] = &near;
    let operations: [fn(&Tree, &Tree) -> Tree; 3] = [|c, x| c * x, |c, x| x * c, |c, x| x / c];
    for apply in operations {
        assert!(no_less(ordered(&c), apply(&c, near_a), apply(&c, near_b)));
        assert!(!no_less(ordered(&c), apply(&c, near_b), apply(&c, near_a)));
        assert!(!no_less(ordered(&c), apply(&c, near_a), apply(&(&c + int(1)), near_b)), "factors differ");
    }
    assert!(no_less(ordered(&c), -near_b, -near_a) && !no_less(ordered(&c), -near_a, -near_b));
    let parts = [near_a, near_b].map(|tree| tree.positive_part());
    assert!(no_less(ordered(&c), parts[0].clone(), parts[1].clone()));
    assert!(!no_less(ordered(&c), parts[1].clone(), parts[0].clone()));
    assert!(no_less(ordered(&-&c), &b * &c, &a * &c) && !no_less(ordered(&-&c), &a * &c, &b * &c));
    assert!(!no_less(ordered(&(&c * &c)), &a * &c, &b * &c));
    // Both terms of a sum are compared, and a divisor must not be 0.
    assert!(no_less(ordered(&c), &a + &c, b.clone()) && !no_less(ordered(&-&c), &a + &c, b.clone()));
    assert!(!no_less(vec![not_below_zero(&a - &b)], &a / &c, &b / &c));
    assert!(
        no_less(ordered(&c), a.min(&c), b.min(&c))
            && no_less(ordered(&c), a.positive_part(), b.positive_part())
    );
}

#[test]
fn rounded_formulas_have_no_limits_or_derivatives() {
    let is_rejected = |proposition: Proposition| {
        matches!(
            outcome(vec![minimum_precision(), above_zero(x("u"))], proposition),
            Err(ProofError::Premise(Premise::Discontinuous))
        )
    };
    assert!(is_rejected(Proposition::Limit((int(1) / x("u")).round(), "u", int(0))));
    assert!(is_rejected(Proposition::Derivative(x("u").round(), "u", int(1))));
    let tends = geometric_limit("tends", x("c") / (x("c") + x("c")), (int(1) + x("q")).round(), int(1));
    assert!(matches!(prove(&tends.assuming(&stiffness())), Err(ProofError::Premise(Premise::Discontinuous))));
}

#[test]
fn compared_formulas_must_be_defined() {
    let quotient = |divisor: Tree| (x("u") / divisor).round();
    let difference = |a: Tree| Proposition::Sign(Relation::NonNegative, &a - &a);
    assert!(rounded(vec![], difference(quotient(int(2)))));
    assert!(!rounded(vec![], difference(quotient(x("c") - x("c")))));
    assert!(!rounded(vec![], difference(quotient(int(0)))));
    let equal = Hypothesis::new(Relation::Zero, x("c") - x("v"));
    assert!(!rounded(vec![equal], difference(quotient(x("c") - x("v")))));
}

/// No precision satisfies the hypothesis 2ᵖ = −1.
#[test]
fn the_divisor_of_a_rounding_error_must_not_be_zero() {
    let impossible = Hypothesis::between(&precision(), int(-1), int(-1));
    let outcome = outcome(vec![impossible], Proposition::Equal(x("u").round(), x("u").round()));
    assert!(matches!(outcome, Err(ProofError::PossibleZeroDivisor(of, _)) if of == precision() + int(1)));
}
