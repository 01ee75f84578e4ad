//! Tests of limits.

use super::*;

#[test]
fn limits_follow_from_degrees() {
    let limit = |of: Tree, to: Tree| Proposition::Limit(of, "t", to);
    let t = || x("t");
    assert!(proved(stiffness(), limit(Tree::one() / (x("c") + t() * t()), Tree::zero())));
    let time = || above_zero(t());
    let both = || vec![above_zero(x("c")), time()];
    assert!(proved(both(), limit(t() / (Tree::one() + x("c") * t()), Tree::one() / x("c"))));
    assert!(!proved(both(), limit(t() / (Tree::one() + x("c") * t()), Tree::one())));
    assert!(!proved(both(), limit(t(), Tree::zero())));
    // A hypothesis that others imply restricts nothing.
    assert!(proved(vec![time(), not_below_zero(t())], limit(Tree::one() / t(), Tree::zero())));
    // For λ = 0 the quotient is constant.
    let weak = vec![not_below_zero(x("λ")), time()];
    assert!(!proved(weak, limit(Tree::one() / (Tree::one() + x("λ") * t()), Tree::zero())));
    // e^{−ct} times any power tends to 0; e^{ct} and e^{ut} do not.
    let decay = |rate: Tree| t() * (rate * t()).exp();
    assert!(proved(both(), limit(decay(-x("c")), Tree::zero())));
    assert!(!proved(both(), limit(decay(x("c")), Tree::zero())));
    assert!(!proved(both(), limit(decay(-x("u")), Tree::zero())));
    // The degree rule does not apply to nested exponentials: e^{eᵗ − t} grows, and e^{−t e^{−t}} tends to 1.
    let within = |exponent: Tree| limit(exponent.exp(), Tree::zero());
    assert!(!proved(vec![time()], within(t().exp() - t())));
    assert!(!proved(vec![time()], within(-t() * (-t()).exp())));
    // An exponential in a denominator is not negligible.
    assert!(!proved(vec![time()], limit(t() / (t() + t().exp()), Tree::one())));
    // A case that bounds t does not cover large t, so it proves no limit.
    let case = x("a") / t() + Tree::zero() * (x("a") - t()).positive_part();
    assert!(!proved(vec![above_zero(x("a")), time()], limit(case, Tree::one())));
    // The same applies to a case that replaces another quantity, a by u t + s or by u t − s.
    let case = x("a") / t() + Tree::zero() * (x("a") - x("u") * t()).positive_part();
    assert!(!proved(vec![time()], limit(case, x("u"))));
    // A hypothesis that excludes large t does not restrict the limit.
    let before = vec![above_zero(x("c") - t())];
    assert!(!proved(before, limit(Tree::one() / (Tree::one() + t() * t()), Tree::zero())));
}

/// A limit is named, rather than the sign by which a rule might have found it.
#[test]
fn a_limit_without_a_rule_is_named() {
    let [c, t, u] = ["c", "t", "u"].map(x);
    let bounded = &t / (int(1) + &c * &t);
    for (hypothesis, of, to) in
        [(above_zero(c), bounded, 1), (above_zero(t.clone()), &t * (&u * &t).exp(), 0)]
    {
        let limit = Proposition::Limit(of.clone(), "t", int(to));
        let outcome = outcome(vec![above_zero(t.clone()), hypothesis], limit);
        assert!(matches!(outcome, Err(ProofError::UnknownLimit(_))), "{of}");
    }
}

#[test]
fn a_hypothesis_that_excludes_large_values_is_named() {
    let [c, t] = ["c", "t"].map(x);
    let limit = || Proposition::Limit(int(1) / (int(1) + &t * &t), "t", int(0));
    for ending in [above_zero(&c - &t), above_zero(&c * &t), Hypothesis::between(&t, int(1), int(2))] {
        let outcome = outcome(vec![ending.clone()], limit());
        assert!(matches!(outcome, Err(ProofError::EndingHypothesis(of)) if of == ending.value), "{ending}");
    }
}

#[test]
fn variables_of_limits_may_have_lower_bounds() {
    let [f, g, h] = ["f", "g", "h"].map(x);
    let above = |bound: &Tree| above_zero(&g - bound);
    let image = || Proposition::Limit(&f * &g / (&g - &f), "g", f.clone());
    assert!(proved(vec![above_zero(f.clone()), above(&f)], image()));
    assert!(proved(vec![above_zero(f.clone()), above_zero(g.clone()), above(&f), above(&h)], image()));
    assert!(proved(
        vec![not_below_zero(&g - int(2) * &f), above_zero(f.clone())],
        Proposition::Limit(&f / (&g + &f), "g", int(0))
    ));
    assert!(!proved(
        vec![above_zero(f.clone()), above(&f)],
        Proposition::Limit(&f * &g / (&g - &f), "g", int(1))
    ));
    // Without the bound there may be a pole, and the limit must not depend on the variable.
    assert!(!proved(vec![above_zero(f.clone())], image()));
    assert!(!proved(vec![above(&f)], Proposition::Limit(&f * &g / (&g - &f), "g", &g - &g + &f / &g)));
    assert!(!proved(vec![above(&f)], Proposition::Limit(&g / (&g - &f), "g", &g / (&g - &f))));
    // Upper bounds exclude large g, and so may bounds with a factor of unknown sign.
    let inverse = || Proposition::Limit(int(1) / (int(1) + &g * &g), "g", int(0));
    assert!(proved(vec![above(&f)], inverse()));
    assert!(proved(vec![above_zero(&g * &g - &f)], inverse()));
    for bound in [&f - &g, &h * &g - &f, &f * &f - &g * &g, &f - &g * &g * &g, &g.exp() - &f] {
        assert!(!proved(vec![above_zero(bound.clone())], inverse()), "{bound} > 0");
    }
    assert!(!proved(vec![above(&f), above_zero(&h - &g)], inverse()));
    // The search replaces f by the bound + s; yet 1/(1 + f²) does not depend on g.
    let constant = || Proposition::Limit(int(1) / (int(1) + &f * &f), "g", int(0));
    for bound in [&g * &h, -&g * &h, &g * &g] {
        assert!(!proved(vec![above_zero(&f - &bound)], constant()), "f > {bound}");
    }
    assert!(!proved(vec![Hypothesis::new(Relation::Zero, &g - &f)], inverse()));
    let sum_is_zero = Hypothesis::new(Relation::Zero, &f + &g);
    assert!(!proved(vec![not_below_zero(f.clone()), not_below_zero(g.clone()), sum_is_zero], inverse()));
    assert!(!proved(vec![Hypothesis::between(&g, int(1), int(2))], inverse()));
    // The hypothesis 1/(g − f) ≥ 1/h excludes large g.
    let reciprocal = int(1) / (&g - &f);
    let never = not_below_zero(&reciprocal - int(1) / &h);
    assert!(!proved(
        vec![above_zero(h.clone()), above(&f), never],
        Proposition::Limit(reciprocal, "g", int(0))
    ));
}

/// The hypothesis −1/v ≤ u ≤ 1/v excludes large v unless u = 0.
#[test]
fn intervals_do_not_depend_on_the_variable_of_a_limit() {
    let [u, v] = ["u", "v"].map(x);
    let near = Hypothesis::near(&u, int(0), int(1) / &v);
    let shrinks = Proposition::Limit(u, "v", int(0));
    assert!(!proved(vec![above_zero(v), near], shrinks));
}
