//! Limits.

use super::*;

fn tends(of: Tree, to: impl Into<Tree>, given: &[Hypothesis]) -> Statement {
    Statement::new("f", Proposition::Limit(of, "t", to.into())).assuming(given)
}

fn later() -> Hypothesis {
    above_zero(x("t"))
}

/// Returns a proof with one divisor, which is not factored.
fn divided(used: &[usize], divisor: Polynomial, signs: Vec<Reason>) -> Leaf {
    Leaf { divisors: vec![vec![divisor]], ..leaf(used, signs) }
}

/// Returns a proof for of/(t + 1), with the leading coefficients after the sign of t + 1.
fn over(claim: &Statement, last: impl Into<Tree>) -> Vec<Node> {
    let page = Page::of(claim);
    let divisor = || x("t") + n(1);
    let signs = vec![page.form(divisor()), page.form(1), page.form(1), page.form(last)];
    vec![node(divided(&[0], page.poly(divisor()), signs))]
}

/// (t + 2)/(t + 1) tends to 1.
#[test]
fn leading_coefficients_are_the_limit() {
    let t = x("t");
    let claim = tends((&t + n(2)) / (&t + n(1)), 1, &[later()]);
    accept(&claim, &over(&claim, 0));
}

/// For a > 0, a t > 1 holds later. What is known of a comes first.
fn early() -> Vec<Forged> {
    let [a, c, t] = ["a", "c", "t"].map(x);
    let given = [later(), above_zero(&a), above_zero(&a * &t - n(1))];
    let claim = tends(&t * n(0), 0, &given);
    let page = Page::of(&claim);
    let of = |used: &[usize]| proof(used, vec![page.form(1), page.form(&a), page.form(0)]);
    accept(&claim, &of(&[1, 0, 2]));
    accept(&claim, &of(&[1]));
    // From c t > 0 and t > 0 follows c > 0, but only where c t > 0 holds.
    let circular = tends(&t * n(0), 0, &[later(), above_zero(&c * &t)]);
    let of_circular = Page::of(&circular);
    let by_fact = of_circular.with(vec![Known::Fact(2)], &t, x("z₁"));
    let circle = proof(&[0, 1], vec![of_circular.form(1), by_fact, of_circular.form(0)]);
    vec![
        ("what is known later", claim.clone(), of(&[0, 1, 2]), Refusal::Form),
        ("a hypothesis that rests on itself", circular, circle, Refusal::Unknown),
    ]
}

fn hypotheses() -> Vec<Forged> {
    let [a, t, y] = ["a", "t", "y"].map(x);
    let row = |flaw, of: &Tree, more: Hypothesis, used: &[usize]| {
        let claim = tends(of.clone(), 0, &[later(), more]);
        let page = Page::of(&claim);
        let nodes = proof(used, vec![page.form(1), page.form(-1), page.form(0)]);
        (flaw, claim, nodes, Refusal::Limit)
    };
    let below = above_zero(n(1) - &t);
    let follows = zero(&y * &t - n(1));
    let between = Hypothesis::between(&y, 0, &t);
    vec![
        row("a hypothesis that ends", &(&t * n(0)), below.clone(), &[0, 1]),
        row("a hypothesis that ends and is not used", &(&t * n(0)), below, &[0]),
        row("a symbol that follows the variable", &y, follows.clone(), &[0, 1]),
        row("a symbol that follows the variable unseen", &(&t * n(0)), follows, &[0]),
        row("an interval that grows", &(&t * n(0)), between.clone(), &[0, 1]),
        row("an interval that grows unseen", &(&t * n(0)), between, &[]),
        row("a symbol above the variable", &(&t * n(0)), above_zero(&a - &t), &[0, 1]),
    ]
}

fn degrees() -> Vec<Forged> {
    let [c, t] = ["c", "t"].map(x);
    let square = tends(&t * &t / (&t + n(1)), 0, &[later()]);
    let twice = tends((n(2) * &t + n(1)) / (&t + n(1)), 1, &[later()]);
    let zero = tends((&t + n(2)) / (&t + n(1)), 0, &[later()]);
    let weak = tends(n(1) / (n(1) + &c * &t), 0, &[not_below_zero(&c), later()]);
    let page = Page::of(&weak);
    let divisor = n(1) + &c * &t;
    let signs = vec![page.form(&divisor), page.form(1), page.form(&c)];
    let of_weak = node(divided(&[0, 1], page.poly(&divisor), signs));
    vec![
        ("a numerator of higher degree", square.clone(), over(&square, 0), Refusal::Limit),
        ("another coefficient", twice.clone(), over(&twice, 0), Refusal::Identity),
        ("0 for equal degrees", zero.clone(), over(&zero, 1), Refusal::Goal),
        ("a leading coefficient that may be 0", weak.clone(), vec![of_weak], Refusal::NotStrict),
    ]
}

fn exponentials() -> Vec<Forged> {
    let [c, t] = ["c", "t"].map(x);
    let decay = || (-&t).exp();
    let positive_c = || [above_zero(&c), later()];
    let row = |flaw, of: Tree, given: &[Hypothesis], signs: &[Tree]| {
        let claim = tends(of, 0, given);
        let page = Page::of(&claim);
        let used: Vec<_> = (0..given.len()).collect();
        let signs = signs.iter().map(|right| page.form(right)).collect();
        (flaw, claim.clone(), proof(&used, signs), Refusal::Limit)
    };
    let vanishing = tends(&t * decay(), 0, &[later()]);
    let page = Page::of(&vanishing);
    let leading = vec![page.form(1), page.form(-1), page.form(0)];
    accept(&vanishing, &proof(&[0], leading));
    let growth = &t + t.exp();
    let over_growth = tends(&t / &growth, 1, &[later()]);
    let of_growth = Page::of(&over_growth);
    let divisor = || &t + x("E₁");
    let signs = vec![of_growth.form(divisor()), of_growth.form(1)];
    let bounded = tends((-&t / (&t + n(1))).exp(), 0, &[later()]);
    let of_bounded = Page::of(&bounded);
    let sum = || &t + n(1);
    let ends = vec![of_bounded.form(sum()), of_bounded.form(1), of_bounded.form(-1), of_bounded.form(1)];
    vec![
        row("an exponential that grows", &t * (&c * &t).exp(), &positive_c(), &[n(1), c.clone()]),
        row("a product with one that grows", decay() * (&t * &t).exp(), &[later()], &[n(1), n(-1), n(1)]),
        row("an exponential in an exponent", (t.exp() - &t).exp(), &[later()], &[n(1), n(-1)]),
        row("an exponent without the variable", (n(-1) * &c + n(0) * &t).exp(), &positive_c(), &[n(1), -&c]),
        (
            "an exponential in a denominator",
            over_growth.clone(),
            vec![node(divided(&[0], of_growth.poly(divisor()), signs))],
            Refusal::Limit,
        ),
        (
            "an exponent that tends to a number",
            bounded.clone(),
            vec![node(divided(&[0], of_bounded.poly(sum()), ends))],
            Refusal::Limit,
        ),
    ]
}

fn cases_on_the_way() -> Vec<Forged> {
    let t = x("t");
    let claim = tends(n(0) * &t * (-&t).exp(), 0, &[later()]);
    let page = Page::of(&claim);
    let both = || node(leaf(&[0], vec![page.form(1), page.form(0)]));
    let on = |of: Tree| vec![cases(page.poly(of), both(), both())];
    accept(&claim, &on(n(1)));
    vec![
        ("a case that ends", claim.clone(), on(n(1) - &t), Refusal::Limit),
        ("a case that ends with an exponential", claim.clone(), on(x("E₁") - n(1)), Refusal::Limit),
    ]
}

#[test]
fn forged_limits_are_refused() {
    refuse(early());
    refuse(hypotheses());
    refuse(degrees());
    refuse(exponentials());
    refuse(cases_on_the_way());
}
