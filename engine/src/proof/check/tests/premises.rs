//! Premises of statements, cases, hypotheses and lists.

use super::*;
use crate::formula::claim::{PRECISION, Rate, induction, limit};

/// Returns the proof that a polynomial is a form itself, with all hypotheses.
fn direct(claim: &Statement, of: &Tree) -> Vec<Node> {
    let used: Vec<_> = (0..claim.hypotheses_for(claim.goals()[0].role).len()).collect();
    proof(&used, vec![Page::of(claim).form(of)])
}

#[test]
fn names_and_sizes_are_checked() {
    let [u, v, s, t] = ["u", "v", "s₁", "t"].map(x);
    let square = |of: &Tree| non_negative("f", of * of);
    accept(&square(&u), &direct(&square(&u), &(&u * &u)));
    let refused = |claim: Statement, nodes: Vec<Node>| match check(&claim, &nodes) {
        Err(CheckError::Statement(reason)) => reason,
        other => panic!("{}: {other:?}", claim.name()),
    };
    let reserved = refused(square(&s), direct(&square(&u), &(&u * &u)));
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
    assert!(matches!(refused(square(&roundings), vec![]), Premise::TooManyRoundings));
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
    let is_small = |size| check_size(vec![u.clone(); size as usize].iter()).is_ok();
    assert_eq!([MAX_SIZE, MAX_SIZE + 1].map(is_small), [true, false]);
    // All are named by hypotheses, of which the first is the goal.
    let by_hypothesis = |count| {
        let all = symbols(count);
        let given: Vec<_> = all.iter().map(not_below_zero).collect();
        let claim = non_negative("f", &all[0]).assuming(&given);
        check(&claim, &proof(&[0], vec![Reason::Fact(1)])).is_ok()
    };
    assert_eq!([MAX_VARIABLES, MAX_VARIABLES + 2].map(by_hypothesis), [true, false]);
    // The square of their sum, which is one more quantity.
    let sum = symbols(MAX_VARIABLES - 1).into_iter().reduce(|sum, y| sum + y).unwrap();
    let claim = non_negative("f", &sum * &sum);
    let page = Page::of(&claim);
    let square = page.with(vec![Known::Value(page.poly(&sum))], 1, x("z₁") * x("z₁"));
    accept(&claim, &proof(&[], vec![square]));
    let claim = non_negative("f", &u * &u);
    let within = |nesting| {
        let [outer, inner] = [(); 2].map(|()| Page::of(&claim).0);
        inner.within(&Problem { nesting, ..outer }).is_ok()
    };
    assert_eq!([MAX_NESTING - 1, MAX_NESTING, MAX_NESTING + 1].map(within), [true, false, false]);
    // The minimum of two formulas is no absolute value.
    let [a, b] = ["a", "b"].map(x);
    assert_eq!(Page::of(&non_negative("f", a.min(&b))).0.table.atoms(), [Atom::Own("a"), Atom::Own("b")]);
}

#[test]
fn each_goal_has_a_proof() {
    let [u, q] = ["u", "q"].map(x);
    let claim = induction("f", 2, [u.clone()], |[m]| [n(2) * m], [&u * &q]);
    let trivial = || node(leaf(&[], vec![Page::of(&claim).form(0)]));
    accept(&claim, &[trivial(), trivial()]);
    for count in [0, 1, 3] {
        assert!(matches!(check(&claim, &vec![trivial(); count]), Err(CheckError::Goals)), "{count} proofs");
    }
}

/// |u| = u for u > 0, and −u otherwise.
#[test]
fn both_cases_are_proved() {
    let u = x("u");
    let claim = non_negative("f", u.positive_part() + (-&u).positive_part());
    let page = Page::of(&claim);
    let of = |own: &Tree, opposite: &Tree| {
        node(leaf(&[], vec![page.form(own), page.form(opposite), page.form(own)]))
    };
    let first = || node(leaf(&[], vec![Reason::Fact(1), page.form(-&u), Reason::Fact(1)]));
    let second = || node(leaf(&[], vec![Reason::Fact(1), page.form(-&u), page.form(-&u)]));
    accept(&claim, &[cases(page.poly(&u), first(), second())]);
    let on = |of: Polynomial, a: Node, b: Node| vec![cases(of, a, b)];
    let none = || node(leaf(&[], vec![]));
    let lonely = positive("f", &u);
    let of_lonely = Page::of(&lonely);
    let lone = || node(leaf(&[], vec![Reason::Fact(1)]));
    let deep = (0..=MAX_NESTING).fold(first(), |inner, _| cases(page.poly(1), inner, none()));
    refuse(vec![
        ("a case like the other", claim.clone(), on(page.poly(&u), first(), first()), Refusal::Identity),
        ("cases exchanged", claim.clone(), on(page.poly(&u), second(), first()), Refusal::Identity),
        ("a case left out", lonely.clone(), on(of_lonely.poly(&u), lone(), lone()), Refusal::Goal),
        ("no cases", claim.clone(), vec![of(&u, &-&u)], Refusal::Form),
        ("a case of nothing", claim.clone(), on(page.poly(x("z₁")), first(), second()), Refusal::Unknown),
        (
            "cases of another quantity",
            claim.clone(),
            on(page.poly(&u + n(1)), first(), second()),
            Refusal::Identity,
        ),
        ("cases inside each other", claim.clone(), vec![deep], Refusal::TooLarge),
    ]);
}

fn uses_of_hypotheses() -> Vec<Forged> {
    let [a, u, q] = ["a", "u", "q"].map(x);
    let claim = positive("f", &a).assuming(&[above_zero(&a)]);
    let of = |used: &[usize]| proof(used, vec![Page::of(&claim).form(&a)]);
    let reciprocal = positive("f", n(1) / &u).assuming(&[above_zero(n(1) / &u)]);
    let page = Page::of(&reciprocal);
    let divided = |sign| {
        let divisors = vec![vec![page.poly(&u)]];
        vec![node(Leaf { divisors, signs: vec![sign], ..leaf(&[0], vec![]) })]
    };
    // q ≤ 2 is not known at q = 1 before it is proved there.
    let bounded =
        induction("f", 1, [u.clone()], |[m]| [m], [u.clone()]).assuming(&[not_below_zero(n(2) - &q)]);
    let base = bounded.goals().iter().position(|goal| goal.part == "invariant at the start").unwrap();
    let goals = bounded.goals().iter().enumerate().map(|(i, goal)| match i == base {
        true => node(leaf(&[0], vec![Page::of_goal(&bounded, goal).form(1)])),
        false => node(leaf(&[], vec![Page::of_goal(&bounded, goal).form(0)])),
    });
    let early: Vec<_> = goals.collect();
    vec![
        ("a hypothesis left out", claim.clone(), of(&[]), Refusal::Form),
        ("a hypothesis that does not exist", claim.clone(), of(&[1]), Refusal::Unknown),
        ("an invariant at the start", bounded, early, Refusal::Unknown),
        ("a hypothesis that divides by 0", reciprocal.clone(), divided(page.form(&u)), Refusal::Form),
    ]
}

fn intervals() -> Vec<Forged> {
    let u = x("u");
    let opposite = [Hypothesis::between(&u, 0, 1), Hypothesis::between(&u, 1, 0)];
    let half = non_negative("f", n(2) * &u - n(1)).assuming(&opposite);
    let page = Page::of(&half);
    // 2 u − 1 is t₁, and it is −t₂. The two places are different numbers.
    let upper = |i: usize| node(leaf(&[i], vec![page.with(vec![Known::Fact(1)], 1, n(4) * x("z₁"))]));
    let lower = |i: usize| node(leaf(&[i], vec![page.with(vec![Known::Fact(1)], 1, n(-4) * x("z₁"))]));
    let on = |a: Node, b: Node| vec![cases(page.poly(x("t₁")), a, b)];
    let wide = [Hypothesis::between(&u, 0, 1), Hypothesis::between(&u, -4, 4)];
    let within_one = non_negative("f", n(1) - &u).assuming(&wide);
    let of_wide = Page::of(&within_one);
    let other_place = vec![of_wide.form(n(2) - n(2) * x("t₁"))];
    vec![
        ("the place in another interval", half.clone(), on(upper(0), lower(1)), Refusal::Identity),
        ("the lower half of an interval", half.clone(), on(upper(0), lower(0)), Refusal::Identity),
        ("the place of a symbol in two intervals", within_one, proof(&[1], other_place), Refusal::Identity),
    ]
}

fn lists() -> Vec<Forged> {
    let [a, u] = ["a", "u"].map(x);
    let claim = positive("f", &a / (&a * &a)).assuming(&[above_zero(&a)]);
    let page = Page::of(&claim);
    let factors = |all: &[&Tree]| vec![all.iter().map(|of| page.poly(*of)).collect::<Vec<_>>()];
    let of = |divisors: Vec<Vec<Polynomial>>, signs: Vec<Reason>| {
        vec![node(Leaf { divisors, ..leaf(&[0], signs) })]
    };
    let fact = || Reason::Fact(1);
    let right = || of(factors(&[&a, &a]), vec![fact(), fact(), fact()]);
    accept(&claim, &right());
    let mut more = right();
    if let Node::Leaf(leaf) = &mut more[0] {
        leaf.roundings.push(None);
    }
    let long = || vec![fact(), fact(), fact(), fact()];
    let free = positive("f", n(1) / (&u * &u));
    let of_free = Page::of(&free);
    let square = vec![node(Leaf {
        divisors: vec![vec![of_free.poly(&u * &u)]],
        ..leaf(&[], vec![of_free.form(&u * &u), Reason::Fact(1)])
    })];
    vec![
        ("a factor left out", claim.clone(), of(factors(&[&a]), vec![fact(), fact()]), Refusal::Divisor),
        ("a divisor left out", claim.clone(), of(vec![], vec![fact()]), Refusal::Missing),
        ("a sign left out", claim.clone(), of(factors(&[&a, &a]), vec![fact(), fact()]), Refusal::Missing),
        ("a sign too much", claim.clone(), of(factors(&[&a, &a]), long()), Refusal::Unused),
        (
            "a divisor too much",
            claim.clone(),
            of([factors(&[&a, &a]), factors(&[&a])].concat(), vec![fact(), fact(), fact()]),
            Refusal::Unused,
        ),
        ("a rounding too much", claim, more, Refusal::Unused),
        ("a divisor that may be 0", free, square, Refusal::NotStrict),
    ]
}

/// 1/a > 0 is not proved by the numerator alone.
fn signs_of_divisors() -> Vec<Forged> {
    let a = x("a");
    let negative = positive("f", n(1) / &a).assuming(&[above_zero(-&a)]);
    let page = Page::of(&negative);
    let signs = vec![page.with(vec![Known::Fact(1)], 1, -x("z₁")), page.form(1)];
    let reciprocal = Leaf { divisors: vec![vec![page.poly(&a)]], ..leaf(&[0], signs) };
    let b = x("b");
    let quotient = positive("f", &b).assuming(&[above_zero(-&a), above_zero(&b / &a)]);
    let of_quotient = Page::of(&quotient);
    let signs = vec![of_quotient.with(vec![Known::Fact(1)], 1, -x("z₁")), Reason::Fact(3)];
    let hypothesis = Leaf { divisors: vec![vec![of_quotient.poly(&a)]], ..leaf(&[0, 1], signs) };
    let hypothesis = ("a divisor in a hypothesis", quotient.clone(), vec![node(hypothesis)], Refusal::Goal);
    vec![
        hypothesis,
        ("a divisor counts with its sign", negative.clone(), vec![node(reciprocal)], Refusal::Goal),
    ]
}

#[test]
fn forged_uses_and_lists_are_refused() {
    refuse(uses_of_hypotheses());
    refuse(intervals());
    refuse(lists());
    refuse(signs_of_divisors());
}

/// The minimum precision is a hypothesis, not a rule.
#[test]
fn the_precision_is_positive_by_hypothesis() {
    let u = x("u");
    let claim = equal("f", u.round(), u.round());
    let page = Page::of(&claim);
    let largest = || page.with(vec![Known::Fact(1)], 1, x("z₁") + n(5));
    let of = |used: &[usize], sign: Reason| {
        vec![node(Leaf { roundings: vec![None], ..leaf(used, vec![sign, page.form(0)]) })]
    };
    accept(&claim, &of(&[0], largest()));
    let form = page.form(x(PRECISION) + n(1));
    refuse(vec![("the precision is not known", claim.clone(), of(&[], form), Refusal::Form)]);
}

/// The derivative of a deep formula is deeper still.
#[test]
fn deep_derivatives_are_checked() {
    let u = x("u");
    let deep = (1..MAX_DEPTH).fold(u.clone(), |product, _| product * n(1));
    let claim = derivative("f", deep, &u, 1);
    accept(&claim, &proof(&[], vec![Page::of(&claim).form(0)]));
}
