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

/// Returns a proof for of/(t + 1): the leading coefficients of t and of t + 1 come before and after the sign of t + 1.
fn over(claim: &Statement, last: impl Into<Tree>) -> Vec<Node> {
    let page = Page::of(claim);
    let divisor = || x("t") + n(1);
    let signs = vec![page.form(1), page.form(divisor()), page.form(1), page.form(last)];
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
    let [one, of_a, zero] = [n(1), a.clone(), n(0)].map(|of| page.form(of));
    accept(&claim, &proof(&[1, 0, 2], vec![one.clone(), of_a.clone(), zero.clone()]));
    accept(&claim, &proof(&[1, 2, 0], vec![of_a.clone(), one.clone(), zero.clone()]));
    // From c t > 0 and t > 0 follows c > 0, but only where c t > 0 holds.
    let circular = tends(&t * n(0), 0, &[later(), above_zero(&c * &t)]);
    let of_circular = Page::of(&circular);
    let by_fact = of_circular.with(vec![Known::Fact(3)], &t, x("z₁"));
    let circle = proof(&[0, 1], vec![of_circular.form(1), by_fact, of_circular.form(0)]);
    vec![
        ("what is known later", claim.clone(), proof(&[0, 2, 1], vec![one.clone(), of_a]), Refusal::Form),
        ("a hypothesis that is not listed", claim.clone(), proof(&[0], vec![one, zero]), Refusal::Limit),
        ("a hypothesis that rests on itself", circular, circle, Refusal::Unknown),
    ]
}

/// Under t > c, min(c − t + t², c − t) is c − t, which does not hold later. After this contradiction, the minimum could
/// be its other operand, whose leading coefficient is positive, and 1 could be 2.
fn contradiction() -> Vec<Forged> {
    let [c, t, z] = ["c", "t", "z"].map(x);
    let (square, below) = (&c - &t + &t * &t, &c - &t);
    let given = [above_zero(&t - &c), above_zero(square.min(&below)), Hypothesis::between(&z, 0, 1)];
    let claim = tends(n(1), 2, &given);
    let page = Page::of(&claim);
    let both = || vec![Known::Fact(1), Known::Fact(2)];
    let [z1, z2] = ["z₁", "z₂"].map(x);
    let wrong_branch = page.with(both(), &z1 * &z1, &t * &t * &z1 * &z2);
    let [one, minus, second] = [n(1), n(-1), -(&t * &t)].map(|of| page.form(of));
    let equal = page.with(both(), z1 + z2, 0);
    let signs = vec![one.clone(), second, minus, wrong_branch, one, equal];
    vec![("hypotheses that contradict each other", claim.clone(), proof(&[0, 1, 2], signs), Refusal::Limit)]
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
        row("a hypothesis that ends and is not listed", &(&t * n(0)), below, &[0]),
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
    let signs = vec![page.form(1), page.form(&divisor), page.form(&c)];
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
    let signs = vec![of_growth.form(1), of_growth.form(divisor()), of_growth.form(1)];
    let bounded = tends((-&t / (&t + n(1))).exp(), 0, &[later()]);
    let of_bounded = Page::of(&bounded);
    let sum = || &t + n(1);
    let ends = [n(1), sum(), n(-1), n(1)].map(|of| of_bounded.form(of)).into();
    let absolute = tends(decay() * (&c * t.exp()).abs(), 0, &[later()]);
    let of_absolute = Page::of(&absolute);
    let vanishing = [1, -1, 0].map(|of| of_absolute.form(of)).into();
    let of_absolute = Leaf { sizes: vec![AbsoluteValue::Atom], ..leaf(&[0], vanishing) };
    vec![
        ("an absolute value that grows", absolute.clone(), vec![node(of_absolute)], Refusal::Limit),
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
    refuse(contradiction());
    refuse(hypotheses());
    refuse(degrees());
    refuse(exponentials());
    refuse(cases_on_the_way());
}
