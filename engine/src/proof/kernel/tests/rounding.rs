//! What is proved of rounding.

use super::*;

/// Under these hypotheses, and for numbers of two bits or more, as every statement has it that rounds.
fn rounded(hypotheses: Vec<Hypothesis>, says: Proposition) -> bool {
    proved([vec![minimum_precision()], hypotheses].concat(), says)
}

#[test]
fn an_error_of_rounding_is_as_large_as_it_can_be_and_no_larger() {
    let error = || x("u").nearest() - x("u");
    let within = |bound: Tree| rounded(vec![], Proposition::Within(error(), bound));
    assert!(within(x("u").abs() / (precision() + int(1))));
    assert!(within(x("u").abs() / precision()));
    assert!(within(x("u").nearest().abs() / precision()));
    assert!(!within(x("u").abs() / (precision() + int(2))));
    assert!(!within(x("u").nearest().abs() / (precision() + int(1))));
    // Nor is it nothing, or of one sign.
    assert!(!rounded(vec![], Proposition::Equal(x("u").nearest(), x("u"))));
    assert!(!rounded(vec![above_zero(x("u"))], Proposition::Sign(Relation::NonNegative, error())));
}

#[test]
fn there_are_names_for_so_many_errors_and_no_more() {
    let roundings = |n: usize| {
        let all = (0..n as i32).map(|i| (x("u") + int(i)).nearest());
        let sum = all.fold(Tree::zero(), |sum, one| sum + one);
        outcome(vec![minimum_precision()], Proposition::Equal(sum.clone(), sum))
    };
    assert!(roundings(MAX_ROUNDINGS).is_ok());
    assert!(matches!(roundings(MAX_ROUNDINGS + 1), Err(Why::TooMany)));
}

#[test]
fn what_is_equal_rounds_alike_and_what_is_in_other_units() {
    let alike = |a: Tree, b: Tree| rounded(vec![], Proposition::Equal(a, b));
    assert!(alike((x("a") + x("b")).nearest(), (x("b") + x("a")).nearest()));
    assert!(alike((x("a") * x("2ᵃ") / x("2ᶠ")).nearest(), x("a").nearest() * x("2ᵃ") / x("2ᶠ")));
    assert!(!alike((x("a") * x("b")).nearest(), x("a").nearest() * x("b")));
    assert!(!alike((x("a") * int(3)).nearest(), x("a").nearest() * int(3)));
    assert!(!alike((x("a") + x("2ᵃ")).nearest(), (x("a") / x("2ᵃ") + int(1)).nearest()));
    // One numerator over two divisors is two numbers, and one divisor under two numerators.
    let positive = || ["c", "d"].map(|name| above_zero(x(name))).to_vec();
    let products_agree = |a: Tree, b: Tree, c: Tree, d: Tree| {
        let [left, right] = [(a / &c).nearest() * c, (b / &d).nearest() * d];
        rounded(positive(), Proposition::Equal(left, right))
    };
    assert!(!products_agree(x("a"), x("a"), x("c"), x("d")));
    assert!(products_agree(x("a"), x("a"), x("c"), x("c")));
    assert!(!rounded(
        positive(),
        Proposition::Equal((x("a") / x("c")).nearest() * x("b"), (x("b") / x("c")).nearest() * x("a"))
    ));
    // A sum and its parts round each by itself.
    assert!(!alike((x("a") + x("b")).nearest() - x("a"), x("b").nearest()));
}

#[test]
fn rounding_keeps_order() {
    let no_less = |hypotheses: Vec<Hypothesis>, a: Tree, b: Tree| {
        rounded(hypotheses, Proposition::Sign(Relation::NonNegative, a.nearest() - b.nearest()))
    };
    let [a, b, c] = ["a", "b", "c"].map(x);
    let given = |sign: &Tree| vec![not_below_zero(&a - &b), above_zero(sign.clone())];
    assert!(no_less(given(&c), a.clone(), b.clone()));
    assert!(!no_less(given(&c), b.clone(), a.clone()));
    assert!(!no_less(vec![], a.clone(), b.clone()));
    // A minus turns it round, and so does what is negative.
    assert!(no_less(given(&c), (&c - &b).nearest(), (&c - &a).nearest()));
    assert!(!no_less(given(&c), (&c - &a).nearest(), (&c - &b).nearest()));
    assert!(
        no_less(given(&c), &a * &c, &b * &c) && no_less(given(&c), (&a / &c).nearest(), (&b / &c).nearest())
    );
    // Of one that is rounded nothing is seen but by comparing what is in it.
    let near = [&a, &b].map(|tree| tree.nearest());
    let [near_a, near_b] = &near;
    let rises: [fn(&Tree, &Tree) -> Tree; 3] = [|c, near| c * near, |c, near| near * c, |c, near| near / c];
    for step in rises {
        assert!(no_less(given(&c), step(&c, near_a), step(&c, near_b)));
        assert!(!no_less(given(&c), step(&c, near_b), step(&c, near_a)));
        assert!(!no_less(given(&c), step(&c, near_a), step(&(&c + int(1)), near_b)), "another factor");
    }
    assert!(no_less(given(&c), -near_b, -near_a) && !no_less(given(&c), -near_a, -near_b));
    assert!(no_less(given(&-&c), &b * &c, &a * &c) && !no_less(given(&-&c), &a * &c, &b * &c));
    assert!(!no_less(given(&(&c * &c)), &a * &c, &b * &c));
    // Of two summands both count, and of a divisor that it is not 0.
    assert!(no_less(given(&c), &a + &c, b.clone()) && !no_less(given(&-&c), &a + &c, b.clone()));
    assert!(!no_less(vec![not_below_zero(&a - &b)], &a / &c, &b / &c));
    assert!(
        no_less(given(&c), a.min(&c), b.min(&c)) && no_less(given(&c), a.positive_part(), b.positive_part())
    );
}

#[test]
fn what_jumps_has_no_limit_and_no_derivative() {
    let jump = |says: Proposition| {
        matches!(outcome(vec![minimum_precision(), above_zero(x("u"))], says), Err(Why::Jump))
    };
    assert!(jump(Proposition::Limit((int(1) / x("u")).nearest(), "u", int(0))));
    assert!(jump(Proposition::Derivative(x("u").nearest(), "u", int(1))));
    let tends = vanishing("tends", x("c") / (x("c") + x("c")), (int(1) + x("q")).nearest(), int(1));
    assert!(matches!(prove(&tends.assuming(&stiffness())), Err(Why::Jump)));
}

#[test]
fn what_is_compared_is_defined() {
    let quotient = |divisor: Tree| (x("u") / divisor).nearest();
    let difference = |a: Tree| Proposition::Sign(Relation::NonNegative, &a - &a);
    assert!(rounded(vec![], difference(quotient(int(2)))));
    assert!(!rounded(vec![], difference(quotient(x("c") - x("c")))));
    assert!(!rounded(vec![], difference(quotient(int(0)))));
    let equal = Hypothesis::new(Relation::Zero, x("c") - x("v"));
    assert!(!rounded(vec![equal], difference(quotient(x("c") - x("v")))));
}
