//! Limits.

use super::*;
use crate::formula::Proposition;

fn tends(of: Tree, to: impl Into<Tree>, given: &[Hypothesis]) -> Statement {
    Statement::new("f", Proposition::Limit(of, "t", to.into())).assuming(given)
}

fn later() -> Hypothesis {
    above_zero(x("t"))
}

/// Returns the steps that assume hypotheses in an order, after the signs of these forms.
fn steps(claim: &Statement, forms: &[Tree], used: &[usize]) -> Vec<Step> {
    let page = Page::of(claim);
    forms.iter().map(|of| page.form(of)).chain(used.iter().map(|i| Step::Assume(*i))).collect()
}

/// Returns a proof of a limit of a quotient by t + 1: the sign of its leading coefficient, t > 0, and its own sign.
fn over(claim: &Statement) -> Vec<Step> {
    [steps(claim, &[n(1)], &[0]), vec![Page::of(claim).form(x("t") + n(1))]].concat()
}

/// (t + 2)/(t + 1) tends to 1.
#[test]
fn leading_coefficients_are_the_limit() {
    let t = x("t");
    let claim = tends((&t + n(2)) / (&t + n(1)), 1, &[later()]);
    accept(&claim, &[Node::Leaf(over(&claim))]);
}

/// For a > 0, a t > 1 holds later. What is known of a comes first.
fn early() -> Vec<Forged> {
    let [a, c, t] = ["a", "c", "t"].map(x);
    let given = [later(), above_zero(&a), above_zero(&a * &t - n(1))];
    let claim = tends(&t * n(0), 0, &given);
    for order in [[1, 0, 2], [1, 2, 0]] {
        accept(&claim, &[Node::Leaf(steps(&claim, &[n(1)], &order))]);
    }
    // From c t > 0 and t > 0 follows c > 0, but only where c t > 0 holds.
    let circular = tends(&t * n(0), 0, &[later(), above_zero(&c * &t)]);
    let by_fact = Page::of(&circular).show(&c, &[3], &t, x("z₁"));
    let circle = [steps(&circular, &[n(1)], &[0]), vec![by_fact, Step::Assume(1)]].concat();
    let row = |flaw, used: &[usize]| forged(flaw, &claim, steps(&claim, &[n(1)], used), Refusal::Limit);
    vec![
        row("what is known later", &[0, 2, 1]),
        row("a hypothesis that is not listed", &[0]),
        forged("a hypothesis that rests on itself", &circular, circle, Refusal::Unknown),
    ]
}

/// Under t > c, min(c − t + t², c − t) is c − t, which does not hold later. After this contradiction, the minimum could
/// be its other operand, whose leading coefficient is positive, and 1 could be 2.
fn contradiction() -> Forged {
    let [c, t, z] = ["c", "t", "z"].map(x);
    let (square, below) = (&c - &t + &t * &t, &c - &t);
    let given = [above_zero(&t - &c), above_zero(square.min(&below)), Hypothesis::between(&z, 0, 1)];
    let claim = tends(n(1), 2, &given);
    let second = Page::of(&claim).form(-(&t * &t));
    let all = [steps(&claim, &[n(1), n(-1)], &[0]), vec![second, Step::Assume(1), Step::Assume(2)]].concat();
    forged("hypotheses that contradict each other", &claim, all, Refusal::Limit)
}

fn hypotheses() -> Vec<Forged> {
    let [a, t, y] = ["a", "t", "y"].map(x);
    let row = |flaw, of: &Tree, more: Hypothesis, used: &[usize]| {
        let claim = tends(of.clone(), 0, &[later(), more]);
        forged(flaw, &claim, steps(&claim, &[n(1), n(-1)], used), Refusal::Limit)
    };
    let below = above_zero(n(1) - &t);
    let follows = zero(&y * &t - n(1));
    let between = Hypothesis::between(&y, 0, &t);
    vec![
        row("a hypothesis that ends", &(&t * n(0)), below.clone(), &[0, 1]),
        row("an equation that ends", &(&t * n(0)), zero(&t - n(1)), &[0, 1]),
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
    let of_weak = [steps(&weak, &[n(1)], &[0, 1]), vec![page.form(n(1) + &c * &t)]].concat();
    let row = |flaw, claim: &Statement, refusal| forged(flaw, claim, over(claim), refusal);
    vec![
        row("a numerator of higher degree", &square, Refusal::Limit),
        row("another coefficient", &twice, Refusal::Goal),
        row("0 for equal degrees", &zero, Refusal::Goal),
        forged("a leading coefficient that may be 0", &weak, of_weak, Refusal::Limit),
    ]
}

fn exponentials() -> Vec<Forged> {
    let [c, t] = ["c", "t"].map(x);
    let decay = || (-&t).exp();
    let row = |flaw, of: Tree, more: &[Tree]| {
        let claim = tends(of, 0, &[above_zero(&c), later()]);
        let page = Page::of(&claim);
        let more = more.iter().map(|of| page.form(of)).collect();
        forged(flaw, &claim, [steps(&claim, &[n(1), n(-1)], &[0, 1]), more].concat(), Refusal::Limit)
    };
    let vanishing = tends(&t * decay(), 0, &[later()]);
    accept(&vanishing, &[Node::Leaf(steps(&vanishing, &[n(1), n(-1)], &[0]))]);
    let (growth, sum) = (&t + t.exp(), &t + n(1));
    vec![
        row("an absolute value that grows", decay() * (&c * t.exp()).abs(), &[]),
        row("an exponential that grows", &t * (&c * &t).exp(), &[]),
        row("a product with one that grows", decay() * (&t * &t).exp(), &[]),
        row("an exponential in an exponent", (t.exp() - &t).exp(), &[]),
        row("an exponent without the variable", (-&c + n(0) * &t).exp(), &[]),
        row("an exponential in a denominator", &t / &growth, &[&t + x("E₁")]),
        row("an exponent that tends to a number", (-&t / &sum).exp(), &[sum]),
    ]
}

fn cases_on_the_way() -> Vec<Forged> {
    let t = x("t");
    let claim = tends(n(0) * &t * (-&t).exp(), 0, &[later()]);
    let page = Page::of(&claim);
    let both = || Node::Leaf(steps(&claim, &[n(1)], &[0]));
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
    refuse(vec![contradiction()]);
    refuse(hypotheses());
    refuse(degrees());
    refuse(exponentials());
    refuse(cases_on_the_way());
}
