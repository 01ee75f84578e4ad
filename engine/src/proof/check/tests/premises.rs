//! Premises of statements, cases, hypotheses and lists.

use super::*;
use crate::formula::claim::{Rate, induction, limit};
use crate::proof::effort::{MAX_DEPTH, MAX_SIZE, excess_size};

#[test]
fn names_and_sizes_are_checked() {
    let [u, v, s, t] = ["u", "v", "s₁", "t"].map(x);
    let square = |of: &Tree| non_negative("f", of * of);
    let direct = |of: &Tree| vec![leaf(0, vec![Page::of(&square(of)).form(of * of)])];
    accept(&square(&u), &direct(&u));
    let refused = |claim: Statement, nodes: Vec<Node>| match check(&claim, &nodes) {
        Err(CheckError::Statement(reason)) => reason,
        other => panic!("{}: {other:?}", claim.name()),
    };
    let reserved = refused(square(&s), direct(&u));
    assert!(matches!(reserved, Premise::ReservedName("s₁")));
    // Of a computed quantity nothing is assumed but its interval.
    let computed = non_negative("f", &u).assuming(&[Hypothesis::near(&u, &v, 0)]).computing(&u, &v);
    let computed = computed.assuming(&[not_below_zero(n(1) * &u)]);
    assert!(matches!(refused(computed, vec![]), Premise::HypothesisOnComputed("u")));
    let none = induction("f", 1, [], |[]| [], []);
    assert!(matches!(refused(none, vec![]), Premise::NoGoals));
    let deep = (0..=MAX_DEPTH).fold(u.clone(), |sum, _| sum + &u);
    assert!(matches!(refused(square(&deep), vec![]), Premise::TooLarge("its depth", _)));
    let large = (0..12).fold(u.clone(), |sum, _| &sum * &sum);
    let large = refused(within("f", &large * &large * &large * &large, large), vec![]);
    assert!(matches!(large, Premise::TooLarge("its size", _)));
    let roundings = (0..65).fold(u.clone(), |sum, _| (sum + n(1)).round());
    let many = check(&square(&roundings), &[leaf(0, vec![])]);
    assert!(matches!(many, Err(CheckError::Goal(0, Refusal::TooLarge))));
    let tends = limit("f", u.round() / &t, &t, 0, Rate::Equal(u.round() / &t));
    assert!(matches!(refused(tends, vec![]), Premise::Discontinuous));
}

/// Returns this many symbols.
fn symbols(count: usize) -> Vec<Tree> {
    (0..count).map(|i| x(Box::leak(format!("y{i}").into_boxed_str()))).collect()
}

/// Limits of depth, size, atoms, quantities and nesting.
#[test]
fn limits_are_reached_and_not_exceeded() {
    let u = x("u");
    let is_checked = |depth| {
        let claim = non_negative("f", (0..depth).fold(u.clone(), |sum, _| sum + &u));
        matches!(check(&claim, &[]), Err(CheckError::Goals))
    };
    assert_eq!([MAX_DEPTH, MAX_DEPTH + 1].map(is_checked), [true, false]);
    let is_small = |size| excess_size(vec![u.clone(); size as usize].iter()).is_none();
    assert_eq!([MAX_SIZE, MAX_SIZE + 1].map(is_small), [true, false]);
    // All are named by hypotheses, of which the first is the goal.
    let by_hypothesis = |count| {
        let all = symbols(count);
        let given: Vec<_> = all.iter().map(not_below_zero).collect();
        let claim = non_negative("f", &all[0]).assuming(&given);
        check(&claim, &[leaf(1, vec![])]).is_ok()
    };
    assert_eq!([MAX_VARIABLES, MAX_VARIABLES + 2].map(by_hypothesis), [true, false]);
    // The square of their sum, which is one more variable.
    let sum = symbols(MAX_VARIABLES - 1).into_iter().reduce(|sum, y| sum + y).unwrap();
    let claim = non_negative("f", &sum * &sum + n(1));
    let page = Page::of(&claim);
    let square = vec![Step::Square(page.poly(&sum)), page.show(&sum * &sum + n(1), &[1], 1, x("z₁") + n(1))];
    accept(&claim, &[leaf(0, square)]);
    // The minimum of two formulas is no absolute value.
    let [a, b] = ["a", "b"].map(x);
    assert_eq!(Page::of(&non_negative("f", a.min(&b))).0.table.atoms, [Atom::Own("a"), Atom::Own("b")]);
}

#[test]
fn each_goal_has_a_proof() {
    let [u, q] = ["u", "q"].map(x);
    let claim = induction("f", 2, [u.clone()], |[m]| [n(2) * m], [&u * &q]);
    let trivial = || leaf(0, vec![]);
    accept(&claim, &[trivial(), trivial()]);
    for count in [0, 1, 3] {
        assert!(matches!(check(&claim, &vec![trivial(); count]), Err(CheckError::Goals)), "{count} proofs");
    }
}

/// ⟨u⟩ is u for u > 0, and 0 otherwise.
#[test]
fn both_cases_are_proved() {
    let u = x("u");
    let claim = non_negative("f", u.positive_part() + (-&u).positive_part());
    let page = Page::of(&claim);
    let either = || leaf(0, vec![page.show(-&u, &[1], 1, -x("z₁"))]);
    accept(&claim, &[cases(page.poly(&u), either(), either())]);
    let wrong = || leaf(0, vec![page.form(-&u)]);
    let on = |of: Polynomial, a: Node, b: Node| vec![cases(of, a, b)];
    let (lonely, weak) = (positive("f", &u), positive("f", u.positive_part() + (-&u).positive_part()));
    let of_lonely = Page::of(&lonely);
    let deep = (0..=MAX_NESTING).fold(either(), |inner, _| cases(page.poly(1), inner, leaf(0, vec![])));
    refuse(vec![
        (
            "a case left out",
            lonely.clone(),
            on(of_lonely.poly(&u), leaf(0, vec![]), leaf(0, vec![])),
            Refusal::Goal,
        ),
        ("no cases", claim.clone(), vec![wrong()], Refusal::Form),
        ("a case that is not strict", weak, on(page.poly(&u), either(), either()), Refusal::Goal),
        ("a case of nothing", claim.clone(), on(page.poly(x("z₁")), either(), either()), Refusal::Unknown),
        (
            "cases of another quantity",
            claim.clone(),
            on(page.poly(&u + n(1)), either(), either()),
            Refusal::Identity,
        ),
        ("cases inside each other", claim.clone(), vec![deep], Refusal::TooLarge),
    ]);
}

fn uses_of_hypotheses() -> Vec<Forged> {
    let [a, u, q] = ["a", "u", "q"].map(x);
    let claim = positive("f", &a).assuming(&[above_zero(&a)]);
    let form = Page::of(&claim).form(&a);
    let reciprocal = positive("f", n(1) / &u).assuming(&[above_zero(n(1) / &u)]);
    // q ≤ 2 is not known at q = 1 before it is proved there.
    let bounded =
        induction("f", 1, [u.clone()], |[m]| [m], [u.clone()]).assuming(&[not_below_zero(n(2) - &q)]);
    let base = bounded.goals().iter().position(|goal| goal.part == "invariant at the start").unwrap();
    let early = (0..bounded.goals().len()).map(|i| leaf(usize::from(i == base), vec![])).collect();
    vec![
        forged("a hypothesis left out", &claim, vec![form], Refusal::Form),
        forged("a hypothesis that does not exist", &claim, assume(2), Refusal::Unknown),
        ("an invariant at the start", bounded, early, Refusal::Unknown),
        forged("a hypothesis that divides by 0", &reciprocal, assume(1), Refusal::Divisor),
    ]
}

fn intervals() -> Vec<Forged> {
    let u = x("u");
    let opposite = [Hypothesis::between(&u, 0, 1), Hypothesis::between(&u, 1, 0)];
    let half = non_negative("f", n(2) * &u - n(1)).assuming(&opposite);
    let page = Page::of(&half);
    // 2 u − 1 is t₁, and it is −t₂. The two parameters are different numbers.
    let by = |i: usize, t: &'static str, of: Tree| {
        Node::Leaf(vec![Step::Assume(i), page.show(of, &[1], 1, n(2) * x("z₁") * x(t))])
    };
    let upper = |i: usize| by(i, "t₁", n(2) * x("t₁"));
    let on = |a: Node, b: Node| vec![cases(page.poly(x("t₁")), a, b)];
    let wide = [Hypothesis::between(&u, 0, 1), Hypothesis::between(&u, -4, 4)];
    let within_one = non_negative("f", n(1) - &u).assuming(&wide);
    let other = vec![Step::Assume(1), Page::of(&within_one).form(n(2) - n(2) * x("t₁"))];
    vec![
        ("the parameter of another interval", half.clone(), on(upper(0), upper(1)), Refusal::Form),
        forged("the parameter of a symbol in two intervals", &within_one, other, Refusal::Goal),
    ]
}

fn divisors() -> Vec<Forged> {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let claim = positive("f", &a / (&a * &a)).assuming(&[above_zero(&a)]);
    let of = |factors: &[usize]| vec![Step::Assume(0), Step::Divisor(factors.into())];
    accept(&claim, &[Node::Leaf(of(&[1, 1]))]);
    let free = positive("f", n(1) / (&u * &u));
    let square = Page::of(&free).form(&u * &u);
    // 1/a > 0 is not proved by the numerator alone.
    let negative = positive("f", n(1) / &a).assuming(&[above_zero(-&a)]);
    let of_a = |claim: &Statement| Page::of(claim).show(&a, &[1], 1, -x("z₁"));
    let quotient = positive("f", &b).assuming(&[above_zero(-&a), above_zero(&b / &a)]);
    let negative_steps = vec![Step::Assume(0), of_a(&negative), Page::of(&negative).form(1)];
    let quotient_steps = vec![Step::Assume(0), of_a(&quotient), Step::Assume(1)];
    vec![
        forged("a factor left out", &claim, of(&[1]), Refusal::Divisor),
        forged("a divisor left out", &claim, assume(1), Refusal::Divisor),
        forged("a factor that does not exist", &claim, of(&[1, 2]), Refusal::Unknown),
        forged("a divisor that may be 0", &free, vec![square.clone()], Refusal::Divisor),
        forged("a factor that may be 0", &free, vec![square, Step::Divisor(vec![1])], Refusal::NotStrict),
        forged("a divisor counts with its sign", &negative, negative_steps, Refusal::Goal),
        forged("a divisor in a hypothesis", &quotient, quotient_steps, Refusal::Goal),
    ]
}

#[test]
fn forged_uses_and_divisors_are_refused() {
    refuse(uses_of_hypotheses());
    refuse(intervals());
    refuse(divisors());
}

/// The derivative of a deep formula is deeper still.
#[test]
fn deep_derivatives_are_checked() {
    let u = x("u");
    let deep = (1..MAX_DEPTH).fold(u.clone(), |product, _| product * n(1));
    let claim = derivative("f", deep, &u, 1);
    accept(&claim, &[leaf(0, vec![])]);
}
