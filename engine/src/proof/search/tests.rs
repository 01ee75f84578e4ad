//! Tests of what is proved and what must not be proved.

use super::*;
use crate::formula::Relation;
use crate::formula::claim::{
    PRECISION, derivative, equal, geometric_limit, induction, perturbed_recursion, positive, within,
};
use crate::formula::statement::minimum_precision;
use crate::number::{Exponential, Field, PositivePart};
use crate::proof::{MAX_DEPTH, Proof, prove};
use num_traits::{One, Zero};

mod limits;
mod rounding;
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

/// Returns 2ᵖ.
fn precision() -> Tree {
    x(PRECISION)
}

/// Returns the hypothesis c > 0.
fn stiffness() -> Vec<Hypothesis> {
    vec![above_zero(x("c"))]
}

/// Returns the hypothesis λ ≥ 0.
fn multiplier() -> Vec<Hypothesis> {
    vec![not_below_zero(x("λ"))]
}

#[test]
fn divisors_must_be_proved_nonzero() {
    let one = || Proposition::Equal(x("c") / x("c"), Tree::one());
    assert!(proved(stiffness(), one()));
    assert!(matches!(outcome(vec![], one()), Err(ProofError::PossibleZeroDivisor(of, _)) if of == x("c")));
    // This applies to a quotient that is multiplied by 0 as well.
    assert!(!proved(vec![], Proposition::Equal(Tree::zero() * (Tree::one() / x("u")), Tree::zero())));
    assert!(!proved(multiplier(), Proposition::Equal(x("λ") / x("λ"), Tree::one())));
    assert!(!proved(vec![], Proposition::Equal(Tree::one() / (x("u") - x("u")), Tree::zero())));
}

#[test]
fn equations_are_proved_for_all_values() {
    let square = (x("u") + x("v")) * (x("u") + x("v"));
    let two = Tree::int(2);
    let expanded = x("u") * x("u") + two * x("u") * x("v") + x("v") * x("v");
    assert!(proved(vec![], Proposition::Equal(square.clone(), expanded.clone())));
    assert!(!proved(vec![], Proposition::Equal(square, expanded + x("u"))));
}

#[test]
fn strict_and_weak_signs_are_distinguished() {
    assert!(proved(multiplier(), Proposition::Sign(Relation::NonNegative, x("λ"))));
    assert!(!proved(multiplier(), Proposition::Sign(Relation::Positive, x("λ"))));
    assert!(!proved(multiplier(), Proposition::Sign(Relation::Zero, x("λ"))));
    assert!(proved(stiffness(), Proposition::Sign(Relation::Positive, x("c"))));
    assert!(!proved(stiffness(), Proposition::Sign(Relation::NonNegative, -x("c"))));
}

#[test]
fn hypotheses_imply_no_stronger_sign() {
    let reaction = || x("m") * x("g") - x("c") * x("H");
    let touching = || vec![not_below_zero(reaction())];
    assert!(proved(touching(), Proposition::Sign(Relation::NonNegative, reaction())));
    assert!(!proved(touching(), Proposition::Sign(Relation::Positive, reaction())));
    assert!(!proved(touching(), Proposition::Sign(Relation::Zero, reaction())));
    let grazing = vec![Hypothesis::new(Relation::Zero, reaction())];
    assert!(proved(grazing.clone(), Proposition::Equal(x("m") * x("g"), x("c") * x("H"))));
    assert!(!proved(grazing, Proposition::Equal(x("m"), x("c"))));
    // The sign of eᵘ does not depend on that of u.
    let power = vec![Hypothesis::new(Relation::Zero, x("a") * x("b") - x("u").exp())];
    assert!(proved(power, Proposition::Sign(Relation::Positive, x("a") * x("b"))));
}

#[test]
fn positive_parts_are_resolved_by_the_sign_of_their_argument() {
    let bracket = |t: &Tree| t.positive_part();
    assert!(proved(stiffness(), Proposition::Equal(bracket(&x("c")), x("c"))));
    assert!(proved(stiffness(), Proposition::Equal(bracket(&-x("c")), Tree::zero())));
    assert!(!proved(vec![], Proposition::Equal(bracket(&x("u")), x("u"))));
    assert!(!proved(vec![], Proposition::Equal(bracket(&x("u")), Tree::zero())));
    // By cases: ⟨u⟩ − ⟨−u⟩ = u, and min(u, v) = v − ⟨v − u⟩.
    assert!(proved(vec![], Proposition::Equal(bracket(&x("u")) - bracket(&-x("u")), x("u"))));
    let min = x("u").min(&x("v"));
    assert!(proved(vec![], Proposition::Equal(min.clone(), x("v") - bracket(&(x("v") - x("u"))))));
    assert!(!proved(vec![], Proposition::Equal(min, x("u"))));
}

/// The main hypothesis is |u − a| ≤ b for b ≥ 0.
#[test]
fn hypotheses_without_a_pivot_are_retained() {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let near = || vec![not_below_zero(b.clone()), Hypothesis::near(&u, &a, &b)];
    let sign = |relation, of: Tree| Proposition::Sign(relation, of);
    let within = |of: Tree, bound: &Tree| Proposition::Within(of, bound.clone());
    let bracket = || u.positive_part() - &a;
    // ⟨·⟩ does not increase the distance from a number that is not negative.
    assert!(proved([near(), vec![not_below_zero(a.clone())]].concat(), within(bracket(), &b)));
    assert!(!proved(near(), within(bracket(), &b)));
    assert!(!proved([near(), vec![not_below_zero(-&a)]].concat(), within(bracket(), &b)));
    assert!(!proved([near(), vec![not_below_zero(a.clone())]].concat(), within(bracket(), &(&b / int(2)))));
    // The assumption of an interval does not lose or strengthen u ≥ 0, and the rest must have a sign, too.
    let both = || [vec![not_below_zero(u.clone())], near()].concat();
    assert!(proved(both(), sign(Relation::NonNegative, u.clone())));
    assert!(proved(both(), sign(Relation::NonNegative, int(2) * &u + &b)));
    assert!(!proved(both(), sign(Relation::Positive, u.clone())));
    assert!(!proved(both(), sign(Relation::NonNegative, -&u)));
    assert!(!proved(both(), sign(Relation::NonNegative, &u - &b)));
    assert!(!proved(near(), sign(Relation::NonNegative, u.clone())));
    let last = || [vec![not_below_zero(a.clone())], near(), vec![not_below_zero(u.clone())]].concat();
    assert!(proved(last(), sign(Relation::NonNegative, u.clone())));
    assert!(!proved(last(), sign(Relation::Positive, u.clone())));
}

#[test]
fn nested_case_distinctions_are_limited() {
    let positive_parts = |n: u32| {
        let all = ["u", "v", "w", "y", "z"].map(|name| x(name).positive_part());
        let sum = all.into_iter().take(n as usize).fold(Tree::zero(), |sum, bracket| sum + bracket);
        outcome(vec![], Proposition::Equal(sum.clone(), sum))
    };
    assert!(positive_parts(MAX_NESTED_CASES as u32).is_ok());
    assert!(matches!(positive_parts(MAX_NESTED_CASES as u32 + 1), Err(ProofError::UndecidedBranch(_))));
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
fn symbols_may_have_two_strict_bounds() {
    let k = x("k");
    let between = || vec![above_zero(k.clone()), above_zero(int(1) - &k)];
    let positive = |of: Tree| Proposition::Sign(Relation::Positive, of);
    for of in [&k - &k * &k, int(1) - &k * &k, int(2) - &k, k.clone(), int(1) - &k, int(1) / (int(1) - &k)] {
        assert!(proved(between(), positive(of.clone())), "{of}");
        assert!(proved(between().into_iter().rev().collect(), positive(of.clone())), "{of}");
    }
    for of in [int(2) * &k - int(1), int(1) - int(2) * &k, &k * &k - &k, -&k] {
        assert!(!proved(between(), positive(of.clone())), "{of}");
    }
    // Negative symbols and symbolic bounds; a weak bound implies a weak sign.
    let negative = vec![above_zero(-&k), above_zero(&k + int(1))];
    assert!(proved(negative, positive(&k * &k * &k - &k)));
    let bounds = |upper: Hypothesis| vec![above_zero(k.clone()), above_zero(x("c")), upper];
    let product = &k * (x("c") - &k);
    assert!(proved(bounds(above_zero(x("c") - &k)), positive(product.clone())));
    assert!(!proved(bounds(not_below_zero(x("c") - &k)), positive(product.clone())));
    assert!(proved(
        bounds(not_below_zero(x("c") - &k)),
        Proposition::Sign(Relation::NonNegative, product.clone())
    ));
    // A hypothesis is not divided by a symbol that may be 0.
    let weak = vec![not_below_zero(k.clone()), above_zero(int(1) - &k)];
    assert!(!proved(weak, positive(&k - &k * &k)));
}

#[test]
fn derivatives_are_proved_by_dual_numbers() {
    let square = || x("u") * x("u");
    let twice = || Tree::int(2) * x("u");
    assert!(proved(vec![], Proposition::Derivative(square(), "u", twice())));
    assert!(!proved(vec![], Proposition::Derivative(square(), "u", x("u"))));
    assert!(!proved(vec![], Proposition::Derivative(square(), "v", twice())));
    // ⟨u⟩ is not differentiable at 0.
    let bracket = Proposition::Derivative(x("u").positive_part(), "u", Tree::one());
    assert!(matches!(outcome(vec![], bracket), Err(ProofError::NotDifferentiable)));
}

#[test]
fn hypotheses_on_symbols_of_known_sign_are_used() {
    let known = || vec![above_zero(x("a")), above_zero(x("b")), above_zero(x("b") - x("a"))];
    assert!(proved(known(), Proposition::Sign(Relation::Positive, x("b") - x("a"))));
    assert!(proved(known(), Proposition::Sign(Relation::Positive, x("b"))), "known signs are not lost");
    assert!(proved(known(), Proposition::Sign(Relation::Positive, x("a"))));
    assert!(!proved(known(), Proposition::Sign(Relation::Positive, x("b") - Tree::int(2) * x("a"))));
    let between = vec![above_zero(x("x")), above_zero(x("L")), not_below_zero(x("L") - x("x"))];
    assert!(proved(between, Proposition::Sign(Relation::Positive, Tree::int(3) * x("L") - x("x"))));
    // A weaker hypothesis does not replace a stronger one.
    let weaker = vec![above_zero(x("a")), not_below_zero(x("a"))];
    assert!(proved(weaker, Proposition::Sign(Relation::Positive, x("a"))));
}

#[test]
fn hypotheses_are_not_divided_by_quantities_that_may_be_zero() {
    // λ u = λ implies u = 1 if λ > 0, but not if λ ≥ 0.
    let hypotheses = |sign: Hypothesis| vec![sign, Hypothesis::new(Relation::Zero, x("λ") * x("u") - x("λ"))];
    let one = || Proposition::Equal(x("u"), Tree::one());
    assert!(!proved(hypotheses(multiplier().remove(0)), one()));
    assert!(proved(hypotheses(above_zero(x("λ"))), one()));
}

fn int(n: i32) -> Tree {
    Tree::from(n)
}

#[test]
fn intervals_bound_their_quantity() {
    let q = x("q");
    let not_above = |ends: [i32; 2], bound: Tree| {
        let between = Hypothesis::between(&q, int(ends[0]), int(ends[1]));
        proved(vec![between], Proposition::Sign(Relation::NonNegative, bound - &q))
    };
    assert!(not_above([0, 1], int(1)) && not_above([1, 0], int(1)) && not_above([3, 3], int(3)));
    assert!(!not_above([0, 1], int(99) / int(100)) && !not_above([-1, 1], int(0)));
    // Symbolic ends, and one interval for each quantity.
    let near = Hypothesis::near(&q, x("u"), x("c"));
    let within = Proposition::Within(&q - x("u"), x("c"));
    assert!(proved(vec![stiffness()[0].clone(), near.clone()], within.clone()));
    assert!(!proved(vec![near], within), "the radius may be negative");
    let [wide, narrow] = [4, 1].map(|n| Hypothesis::between(&q, int(0), int(n)));
    let small = || Proposition::Sign(Relation::NonNegative, int(1) - &q);
    assert!(proved(vec![narrow.clone(), wide.clone()], small()));
    assert!(!proved(vec![wide], small()));
    // An interval whose ends depend on q does not disturb a proof.
    let in_ends = [above_zero(x("u") - &q), Hypothesis::between(&q, x("u") - int(1), x("u") + int(1))];
    let in_ends = [in_ends.to_vec(), stiffness()].concat();
    assert!(proved(in_ends.clone(), Proposition::Sign(Relation::Positive, x("c"))));
    assert!(!proved(in_ends, small()));
    // In any order, an interval bounds what is compared with its quantity.
    let unit = || Hypothesis::between(&q, int(0), int(1));
    let (above, equal) = (above_zero(x("u") - &q), Hypothesis::new(Relation::Zero, x("u") - &q));
    for hypotheses in [vec![unit(), above.clone()], vec![above, unit()]] {
        assert!(proved(hypotheses.clone(), Proposition::Sign(Relation::Positive, x("u"))));
        assert!(!proved(hypotheses, Proposition::Sign(Relation::NonNegative, int(1) - x("u"))));
    }
    for hypotheses in [vec![unit(), equal.clone()], vec![equal, unit()]] {
        assert!(proved(hypotheses.clone(), Proposition::Within(x("u"), int(1))));
        assert!(!proved(hypotheses, Proposition::Sign(Relation::Positive, x("u"))));
    }
    // The ends may depend on a quantity that another interval bounds.
    let near_q = Hypothesis::near(&x("u"), q.positive_part(), x("c"));
    let near_a = Hypothesis::near(&q, x("a"), x("c"));
    for hypotheses in [[near_a.clone(), near_q.clone()], [near_q, near_a]] {
        let hypotheses = [stiffness(), vec![not_below_zero(x("a"))], hypotheses.to_vec()].concat();
        let within = |bound: Tree| Proposition::Within(x("u") - x("a"), bound);
        assert!(proved(hypotheses.clone(), within(x("c") + x("c"))));
        assert!(!proved(hypotheses, within(x("c"))));
    }
    // (1 − q)(u − 0) ≥ 0 has the form of an interval but does not bound q.
    let other = not_below_zero((int(1) - &q) * (x("u") - int(0)));
    assert!(!proved(vec![other], small()));
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
        Proposition::Within(quotient.with_rounding() - &quotient, int(1) / precision()),
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
fn opposite_quantities_have_the_same_absolute_value() {
    let [one, other] = [x("a") - x("b"), x("b") - x("a")].map(|of| of.abs());
    assert!(proved(vec![], Proposition::Equal(one.clone(), other.clone())));
    assert!(!proved(vec![], Proposition::Equal(one, other + int(1))));
}

/// eˣ lies above its tangent at 0, and below (2 + x)/(2 − x) for 0 < x < 2.
#[test]
fn exponentials_lie_between_their_tangent_and_a_fraction() {
    let [a, u, z] = ["a", "u", "z"].map(x);
    let given = || vec![above_zero(a.clone()), not_below_zero(z.clone())];
    let has = |relation, of: Tree| proved(given(), Proposition::Sign(relation, of));
    let (positive, weak) = (Relation::Positive, Relation::NonNegative);
    let tangent = |x: &Tree| x.exp() - int(1) - x;
    assert!(has(positive, tangent(&a)) && has(positive, tangent(&-&a)));
    assert!(has(weak, tangent(&u)) && !has(positive, tangent(&u)) && !has(positive, tangent(&z)));
    assert!(!has(weak, -tangent(&u)) && !has(weak, tangent(&u) - int(1)));
    assert!(has(positive, int(1) - (-&a).exp()) && has(positive, a.exp() - int(1)));
    assert!(has(weak, int(1) - (-&z).exp()) && !has(weak, a.exp() - int(2)));
    let ratio = &a / (&a + int(1));
    assert!(has(positive, int(1) + &a - ratio.exp()));
    assert!(has(positive, int(1) + &a - (int(2) * &a / (int(2) + &a)).exp()));
    assert!(!has(positive, int(1) + &a - (int(3) * &a / (int(2) + &a)).exp()));
}
