//! Tests of derivations: cases, factors and limits.

use super::*;

#[test]
fn a_derivation_contains_each_divisor_and_branch_once() {
    let [c, d] = ["c", "d"].map(x);
    let part = |tree: &Tree| tree.positive_part();
    let sum = part(&c) / &d + part(&d) / &c + part(&c) / &d + &c / int(2);
    let same = Proposition::Equal(sum.clone(), sum);
    let proof = outcome(vec![above_zero(c.clone()), above_zero(d.clone())], same).unwrap();
    let [Derivation::Direct(direct)] = proof.goals() else { panic!("one case") };
    assert!(direct.divisors.iter().map(|(tree, _)| tree).eq([&d, &c]), "a number is not listed");
    let branches = direct.branches.iter().map(|(bracket, branch, _)| (bracket.clone(), branch.clone()));
    assert!(branches.eq([(part(&c), c.clone()), (part(&d), d.clone())]));
}

#[test]
fn case_distinctions_are_exhaustive() {
    // At u = 0 both positive parts are 0.
    let bracket = |tree: Tree| tree.positive_part();
    assert!(!proved(vec![], Proposition::Sign(Relation::Positive, bracket(x("u")) + bracket(-x("u")))));
    // Each case has its own slack variable: u − v and w − z, both positive, need not be equal.
    let both = |a: Tree, b: Tree| bracket(a.clone()) * bracket(b.clone()) * (a - b);
    assert!(!proved(vec![], Proposition::Equal(both(x("u") - x("v"), x("w") - x("z")), Tree::zero())));
}

#[test]
fn exponentials_are_factors() {
    // u v eᵃ = b, so that u v = b e⁻ᵃ.
    let product = || Hypothesis::new(Relation::Zero, x("u") * x("v") * x("a").exp() - x("b"));
    let without = || Proposition::Equal(x("u") * x("v"), x("b"));
    assert!(!proved(vec![above_zero(x("b")), product()], without()));
    assert!(!proved(vec![product()], without()));
    assert!(proved(vec![product()], Proposition::Equal(x("u") * x("v") * x("a").exp(), x("b"))));
}

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
    for bound in [&f - &g, &h * &g - &f, &f * &f - &g * &g, &g * &g - &f, &f - &g * &g * &g, &g.exp() - &f] {
        assert!(!proved(vec![above_zero(bound.clone())], inverse()), "{bound} > 0");
    }
    assert!(!proved(vec![above(&f), above_zero(&h - &g)], inverse()));
    // The kernel replaces f by the bound + s; yet 1/(1 + f²) does not depend on g.
    let constant = || Proposition::Limit(int(1) / (int(1) + &f * &f), "g", int(0));
    for bound in [&g * &h, -&g * &h, &g * &g] {
        assert!(!proved(vec![above_zero(&f - &bound)], constant()), "f > {bound}");
    }
    assert!(!proved(vec![Hypothesis::new(Relation::Zero, &g - &f)], inverse()));
    assert!(!proved(vec![Hypothesis::between(&g, int(1), int(2))], inverse()));
    // The hypothesis 1/(g − f) ≥ 1/h excludes large g.
    let reciprocal = int(1) / (&g - &f);
    let never = not_below_zero(&reciprocal - int(1) / &h);
    assert!(!proved(
        vec![above_zero(h.clone()), above(&f), never],
        Proposition::Limit(reciprocal, "g", int(0))
    ));
}

/// No rule finds the sign of the expanded product.
#[test]
fn divisors_have_the_signs_of_their_factors() {
    let positive_at = |y: &Tree| y * y - y + int(1);
    let divisor = || positive_at(&x("u")) * positive_at(&x("v"));
    assert!(proved(vec![], Proposition::Sign(Relation::Positive, int(1) / divisor())));
    assert!(!proved(vec![], Proposition::Sign(Relation::Positive, divisor())));
}

/// The case may end before the limit is reached.
#[test]
fn a_case_that_depends_on_the_variable_of_a_limit_is_not_used() {
    let [a, g] = ["a", "g"].map(Symbol::Own);
    let variable = |hypothesis: Option<&Hypothesis>, value: Poly| {
        let mut context = Context::of(vec![]).with_variable(&Proposition::Limit(x("g"), "g", int(0)));
        context.assume_sign(hypothesis, value.into(), Sign::Positive);
        context.limit_variable(g)
    };
    let above = Poly::symbol(g) - Poly::symbol(a);
    assert_eq!(variable(Some(&above_zero(x("g") - x("a"))), above.clone()), Some(Symbol::Slack(0)));
    assert_eq!(variable(None, above), None);
    assert_eq!(variable(None, Poly::symbol(a)), Some(g));
}
