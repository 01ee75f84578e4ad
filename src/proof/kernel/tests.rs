//! What the kernel proves and what it must not.

use super::*;
use crate::formula::Claim;
use crate::formula::claim::{PRECISION, derivative, drift, induction, positive, vanishing};
use crate::formula::statement::two_bits;
use crate::number::{Exponential, Field, PositivePart};
use num_traits::{One, Zero};

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn above_zero(value: Tree) -> Hypothesis {
    Hypothesis::new(Relation::Positive, value)
}

fn not_below_zero(value: Tree) -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, value)
}

fn outcome(hypotheses: Vec<Hypothesis>, says: Says) -> Result<Proof, Why> {
    let goals = vec![Goal::of_claim("", says)];
    prove(&Statement { hypotheses, goals, ..Statement::default() })
}

fn proved(hypotheses: Vec<Hypothesis>, says: Says) -> bool {
    outcome(hypotheses, says).is_ok()
}

/// c > 0
fn stiffness() -> Vec<Hypothesis> {
    vec![above_zero(x("c"))]
}

/// λ ≥ 0
fn multiplier() -> Vec<Hypothesis> {
    vec![not_below_zero(x("λ"))]
}

#[test]
fn a_divisor_has_to_be_seen_not_to_vanish() {
    let one = || Says::Equal(x("c") / x("c"), Tree::one());
    assert!(proved(stiffness(), one()));
    assert!(matches!(outcome(vec![], one()), Err(Why::MightVanish(..))));
    // Not even where the quotient is multiplied by 0.
    assert!(!proved(vec![], Says::Equal(Tree::zero() * (Tree::one() / x("u")), Tree::zero())));
    assert!(!proved(multiplier(), Says::Equal(x("λ") / x("λ"), Tree::one())));
    assert!(!proved(vec![], Says::Equal(Tree::one() / (x("u") - x("u")), Tree::zero())));
}

#[test]
fn equal_is_equal_everywhere() {
    let square = (x("u") + x("v")) * (x("u") + x("v"));
    let two = Tree::int(2);
    let expanded = x("u") * x("u") + two * x("u") * x("v") + x("v") * x("v");
    assert!(proved(vec![], Says::Equal(square.clone(), expanded.clone())));
    assert!(!proved(vec![], Says::Equal(square, expanded + x("u"))));
}

#[test]
fn strict_and_weak_signs_are_two_things() {
    assert!(proved(multiplier(), Says::Sign(Relation::NonNegative, x("λ"))));
    assert!(!proved(multiplier(), Says::Sign(Relation::Positive, x("λ"))));
    assert!(!proved(multiplier(), Says::Sign(Relation::Zero, x("λ"))));
    assert!(proved(stiffness(), Says::Sign(Relation::Positive, x("c"))));
    assert!(!proved(stiffness(), Says::Sign(Relation::NonNegative, -x("c"))));
}

#[test]
fn a_hypothesis_says_what_it_says_and_no_more() {
    let reaction = || x("m") * x("g") - x("c") * x("H");
    let touching = || vec![not_below_zero(reaction())];
    assert!(proved(touching(), Says::Sign(Relation::NonNegative, reaction())));
    assert!(!proved(touching(), Says::Sign(Relation::Positive, reaction())));
    assert!(!proved(touching(), Says::Sign(Relation::Zero, reaction())));
    let grazing = vec![Hypothesis::new(Relation::Zero, reaction())];
    assert!(proved(grazing.clone(), Says::Equal(x("m") * x("g"), x("c") * x("H"))));
    assert!(!proved(grazing, Says::Equal(x("m"), x("c"))));
    // That of u in eᵘ nothing is known is no matter.
    let power = vec![Hypothesis::new(Relation::Zero, x("a") * x("b") - x("u").exp())];
    assert!(proved(power, Says::Sign(Relation::Positive, x("a") * x("b"))));
}

#[test]
fn the_names_of_quantities_are_the_kernels_own() {
    let above = || vec![above_zero(x("u") - Tree::one())];
    assert!(!proved(above(), Says::Sign(Relation::Positive, x("s₁"))));
    assert!(!proved(vec![above_zero(x("u") - x("s₁"))], Says::Equal(x("u"), x("u"))));
    assert!(prove(&Statement::default()).is_err());
}

#[test]
fn a_bracket_opens_where_its_sign_says_so() {
    let bracket = |t: &Tree| t.positive_part();
    assert!(proved(stiffness(), Says::Equal(bracket(&x("c")), x("c"))));
    assert!(proved(stiffness(), Says::Equal(bracket(&-x("c")), Tree::zero())));
    assert!(!proved(vec![], Says::Equal(bracket(&x("u")), x("u"))));
    assert!(!proved(vec![], Says::Equal(bracket(&x("u")), Tree::zero())));
    // By cases: ⟨u⟩ − ⟨−u⟩ = u, and min(u, v) = v − ⟨v − u⟩.
    assert!(proved(vec![], Says::Equal(bracket(&x("u")) - bracket(&-x("u")), x("u"))));
    let min = x("u").min(&x("v"));
    assert!(proved(vec![], Says::Equal(min.clone(), x("v") - bracket(&(x("v") - x("u"))))));
    assert!(!proved(vec![], Says::Equal(min, x("u"))));
}

#[test]
fn cases_are_nested_so_deep_and_no_deeper() {
    let brackets = |n: u32| {
        let all = ["u", "v", "w", "y", "z"].map(|name| x(name).positive_part());
        let sum = all.into_iter().take(n as usize).fold(Tree::zero(), |sum, bracket| sum + bracket);
        outcome(vec![], Says::Equal(sum.clone(), sum))
    };
    assert!(brackets(CASES).is_ok());
    assert!(matches!(brackets(CASES + 1), Err(Why::OpenBracket(_))));
}

#[test]
fn limits_by_degrees() {
    let limit = |of: Tree, to: Tree| Says::Limit(of, "t", to);
    let t = || x("t");
    assert!(proved(stiffness(), limit(Tree::one() / (x("c") + t() * t()), Tree::zero())));
    let time = || above_zero(t());
    let both = || vec![above_zero(x("c")), time()];
    assert!(proved(both(), limit(t() / (Tree::one() + x("c") * t()), Tree::one() / x("c"))));
    assert!(!proved(both(), limit(t() / (Tree::one() + x("c") * t()), Tree::one())));
    assert!(!proved(both(), limit(t(), Tree::zero())));
    // What might be constant need not vanish.
    let weak = vec![not_below_zero(x("λ")), time()];
    assert!(!proved(weak, limit(Tree::one() / (Tree::one() + x("λ") * t()), Tree::zero())));
    // e^{−ct} falls faster than any power rises; e^{ct} and e^{ut} do not.
    let decay = |rate: Tree| t() * (rate * t()).exp();
    assert!(proved(both(), limit(decay(-x("c")), Tree::zero())));
    assert!(!proved(both(), limit(decay(x("c")), Tree::zero())));
    assert!(!proved(both(), limit(decay(-x("u")), Tree::zero())));
    // An exponential within an exponent has no degree: e^{eᵗ − t} grows, and e^{−t e^{−t}} tends to 1.
    let within = |exponent: Tree| limit(exponent.exp(), Tree::zero());
    assert!(!proved(vec![time()], within(t().exp() - t())));
    assert!(!proved(vec![time()], within(-t() * (-t()).exp())));
    // A hypothesis that ends as t grows says nothing of the limit.
    let before = vec![above_zero(x("c") - t())];
    assert!(!proved(before, limit(Tree::one() / (Tree::one() + t() * t()), Tree::zero())));
}

#[test]
fn an_invariant_has_to_hold_at_the_start() {
    // x ← ⟨x⟩ from λ stays λ if λ ≥ 0; that it is so at every step is no reason for it to be so at the first.
    let (lambda, q) = (x("λ"), x("q"));
    let invariant = |q: &Tree| &lambda + (q - q);
    let goal = |part, role, says| Goal { part, role, says };
    let statement = |hypotheses| Statement {
        kind: "induction",
        hypotheses,
        invariants: vec![not_below_zero(invariant(&q))],
        goals: vec![
            goal("start", Role::Claim, Says::Equal(lambda.clone(), lambda.clone())),
            goal("step", Role::Step, Says::Equal(lambda.positive_part(), lambda.clone())),
            goal("", Role::Begins, Says::Sign(Relation::NonNegative, invariant(&Tree::one()))),
            goal("", Role::Continues, Says::Sign(Relation::NonNegative, invariant(&q))),
        ],
        ..Statement::default()
    };
    assert!(prove(&statement(multiplier())).is_ok());
    assert!(matches!(prove(&statement(vec![])), Err(Why::NoSign(_))));
}

#[test]
fn derivatives_are_those_of_the_formula() {
    let square = || x("u") * x("u");
    let twice = || Tree::int(2) * x("u");
    assert!(proved(vec![], Says::Derivative(square(), "u", twice())));
    assert!(!proved(vec![], Says::Derivative(square(), "u", x("u"))));
    assert!(!proved(vec![], Says::Derivative(square(), "v", twice())));
    // ⟨u⟩ has none at 0.
    let bracket = Says::Derivative(x("u").positive_part(), "u", Tree::one());
    assert!(matches!(outcome(vec![], bracket), Err(Why::Kink)));
}

#[test]
fn a_kept_name_is_no_variable_either() {
    // b > a makes b − a the kernel's s₁; as that grows 1/(b − a) vanishes, and yet nothing of a and b does.
    let above = || vec![above_zero(x("b") - x("a"))];
    let reciprocal = || Tree::one() / (x("b") - x("a"));
    let limit = |by| Says::Limit(reciprocal(), by, Tree::zero());
    assert!(matches!(outcome(above(), limit("s₁")), Err(Why::Reserved("s₁"))));
    let slope = |by| Says::Derivative(x("b"), by, Tree::zero());
    assert!(matches!(outcome(above(), slope("s₁")), Err(Why::Reserved("s₁"))));
    assert!(proved(above(), slope("u")));
    // Nor is what an induction calls the members of its sequence.
    assert!(matches!(outcome(vec![], Says::Equal(x("x₁"), x("x₁"))), Err(Why::Reserved("x₁"))));
}

#[test]
fn a_sequence_starts_from_no_power() {
    // From q, q → ρ q is the sequence q ρᵏ and not ρᵏ.
    let double = |[x]: [Tree; 1]| [Tree::int(2) * x];
    let from = |start: Tree| Statement::of(&induction("powers", [], 2, [start], double, [x("q")]));
    assert!(prove(&from(Tree::one())).is_ok());
    assert!(matches!(prove(&from(x("q") / x("q"))), Err(Why::Reserved("q"))));
    let vanishes = |ratio: Tree| Statement::of(&vanishing("vanishes", [], ratio, x("q"), 0));
    assert!(prove(&vanishes(Tree::one() / Tree::int(2))).is_ok());
    assert!(matches!(prove(&vanishes(x("q") / (Tree::one() + x("q") * x("q")))), Err(Why::Reserved("q"))));
}

#[test]
fn a_hypothesis_on_symbols_of_known_sign_is_used_too() {
    let known = || vec![above_zero(x("a")), above_zero(x("b")), above_zero(x("b") - x("a"))];
    assert!(proved(known(), Says::Sign(Relation::Positive, x("b") - x("a"))));
    assert!(proved(known(), Says::Sign(Relation::Positive, x("b"))), "nothing is forgotten");
    assert!(proved(known(), Says::Sign(Relation::Positive, x("a"))));
    assert!(!proved(known(), Says::Sign(Relation::Positive, x("b") - Tree::int(2) * x("a"))));
    let between = vec![above_zero(x("x")), above_zero(x("L")), not_below_zero(x("L") - x("x"))];
    assert!(proved(between, Says::Sign(Relation::Positive, Tree::int(3) * x("L") - x("x"))));
}

#[test]
fn nothing_is_divided_by_what_may_vanish() {
    // From λ u = λ it does not follow that u = 1, but where λ > 0.
    let given = |sign: Hypothesis| vec![sign, Hypothesis::new(Relation::Zero, x("λ") * x("u") - x("λ"))];
    let one = || Says::Equal(x("u"), Tree::one());
    assert!(!proved(given(multiplier().remove(0)), one()));
    assert!(proved(given(above_zero(x("λ"))), one()));
}

/// Under these hypotheses, and for numbers of two bits or more, as every statement has it that rounds.
fn rounded(hypotheses: Vec<Hypothesis>, says: Says) -> bool {
    proved([vec![two_bits()], hypotheses].concat(), says)
}

fn int(n: i32) -> Tree {
    Tree::from(n)
}

/// 2ᵖ
fn precision() -> Tree {
    x(PRECISION)
}

#[test]
fn an_error_of_rounding_is_as_large_as_it_can_be_and_no_larger() {
    let error = || x("u").nearest() - x("u");
    let within = |bound: Tree| rounded(vec![], Says::Within(error(), bound));
    assert!(within(x("u").abs() / (precision() + int(1))));
    assert!(within(x("u").abs() / precision()));
    assert!(within(x("u").nearest().abs() / precision()));
    assert!(!within(x("u").abs() / (precision() + int(2))));
    assert!(!within(x("u").nearest().abs() / (precision() + int(1))));
    // Nor is it nothing, or of one sign.
    assert!(!rounded(vec![], Says::Equal(x("u").nearest(), x("u"))));
    assert!(!rounded(vec![above_zero(x("u"))], Says::Sign(Relation::NonNegative, error())));
}

#[test]
fn there_are_names_for_so_many_errors_and_no_more() {
    let roundings = |n: usize| {
        let all = (0..n as i32).map(|i| (x("u") + int(i)).nearest());
        let sum = all.fold(Tree::zero(), |sum, one| sum + one);
        outcome(vec![two_bits()], Says::Equal(sum.clone(), sum))
    };
    assert!(roundings(ERRORS.len()).is_ok());
    assert!(matches!(roundings(ERRORS.len() + 1), Err(Why::TooMany)));
}

#[test]
fn what_is_equal_rounds_alike_and_what_is_in_other_units() {
    let alike = |a: Tree, b: Tree| rounded(vec![], Says::Equal(a, b));
    assert!(alike((x("a") + x("b")).nearest(), (x("b") + x("a")).nearest()));
    assert!(alike((x("a") * x("2ᵃ") / x("2ᶠ")).nearest(), x("a").nearest() * x("2ᵃ") / x("2ᶠ")));
    assert!(!alike((x("a") * x("b")).nearest(), x("a").nearest() * x("b")));
    assert!(!alike((x("a") * int(3)).nearest(), x("a").nearest() * int(3)));
    assert!(!alike((x("a") + x("2ᵃ")).nearest(), (x("a") / x("2ᵃ") + int(1)).nearest()));
    // A sum and its parts round each by itself.
    assert!(!alike((x("a") + x("b")).nearest() - x("a"), x("b").nearest()));
}

#[test]
fn rounding_keeps_order() {
    let no_less = |hypotheses: Vec<Hypothesis>, a: Tree, b: Tree| {
        rounded(hypotheses, Says::Sign(Relation::NonNegative, a.nearest() - b.nearest()))
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
    let jump = |says: Says| matches!(outcome(vec![two_bits(), above_zero(x("u"))], says), Err(Why::Jump));
    assert!(jump(Says::Limit((int(1) / x("u")).nearest(), "u", int(0))));
    assert!(jump(Says::Derivative(x("u").nearest(), "u", int(1))));
    let tends = vanishing("tends", [], x("c") / (x("c") + x("c")), (int(1) + x("q")).nearest(), int(1));
    let stiff = Claim { given: stiffness(), ..tends };
    assert!(matches!(prove(&Statement::of(&stiff)), Err(Why::Jump)));
}

#[test]
fn what_is_in_an_interval_is_nowhere_else() {
    let q = x("q");
    let not_above = |ends: [i32; 2], most: Tree| {
        let between = Hypothesis::between(&q, int(ends[0]), int(ends[1]));
        proved(vec![between], Says::Sign(Relation::NonNegative, most - &q))
    };
    assert!(not_above([0, 1], int(1)) && not_above([1, 0], int(1)) && not_above([3, 3], int(3)));
    assert!(!not_above([0, 1], int(99) / int(100)) && !not_above([-1, 1], int(0)));
    // With ends that are quantities, and no more than one interval for each.
    let near = Hypothesis::near(&q, x("u"), x("c"));
    let within = Says::Within(&q - x("u"), x("c"));
    assert!(proved(vec![stiffness()[0].clone(), near.clone()], within.clone()));
    assert!(!proved(vec![near], within), "the reach might be negative");
    let [wide, narrow] = [4, 1].map(|n| Hypothesis::between(&q, int(0), int(n)));
    let small = || Says::Sign(Relation::NonNegative, int(1) - &q);
    assert!(proved(vec![narrow.clone(), wide.clone()], small()));
    assert!(!proved(vec![wide], small()));
    // Nor is one used that speaks of itself, by what is supposed before.
    let places = |given: &[&Hypothesis]| -> Vec<_> {
        let mut context = Context::of(vec![]);
        given.iter().for_each(|given| context.take_in(given).unwrap());
        context.supposed.iter().map(|supposed| matches!(supposed.used, Used::Between(..))).collect()
    };
    let wide = Hypothesis::between(&q, int(0), int(4));
    assert_eq!(places(&[&wide, &Hypothesis::between(&q, int(0), int(1))]), [true, false]);
    let [v, w] = ["v", "w"].map(x);
    let above = above_zero(&v - &w);
    assert_eq!(places(&[&above, &Hypothesis::near(&w, &v, int(1))]), [false; 2], "v is w and more");
    assert_eq!(places(&[&above, &Hypothesis::near(&w, int(1), &v)]), [false; 2]);
    assert_eq!(places(&[&above, &Hypothesis::near(&w, int(1), int(2))]), [false, true]);
    // What only looks like one is none: of (1 − q)(u − 0) nothing is known of q.
    let other = not_below_zero((int(1) - &q) * (x("u") - int(0)));
    assert!(!proved(vec![other], small()));
}

/// x₀ = 1, and each x is half of the last: near 0 within q, if what is supposed of x is.
fn drifts(given: &[Hypothesis]) -> Result<Proof, Why> {
    let half = int(1) / int(2);
    let q = Hypothesis::between(&x("q"), int(0), int(1));
    let u = Hypothesis::near(&x("u"), x("x₁") * &half, int(0));
    let claim =
        drift("halves", [&q, &u], half.clone(), 1, |_| x("u"), (int(0), x("q")), |_| [(x("u"), x("q"))]);
    let claim = claim.computing(&x("u"), x("x₁") * &half);
    prove(&Statement::of(&Claim { given: [given.to_vec(), claim.given.clone()].concat(), ..claim }))
}

#[test]
fn of_a_member_nothing_is_supposed_but_that_it_is_near() {
    assert!(drifts(&[]).is_ok());
    assert!(matches!(drifts(&[not_below_zero(x("x₁") - int(7))]), Err(Why::Reserved("x₁"))));
    // Not even if it is true at the start.
    assert!(matches!(drifts(&[not_below_zero(x("x₁"))]), Err(Why::Reserved("x₁"))));
}

/// What is computed at each step is no constant, and has no other meaning.
#[test]
fn what_is_computed_is_neither_a_power_nor_a_constant() {
    let [q, u, v] = ["q", "u", "v"].map(x);
    let refused = |claim: Claim| matches!(prove(&Statement::of(&claim)), Err(Why::Reserved(_) | Why::Jump));
    // x₀ = 1, and each x is one more: no powers of 2, although q would be 1 at each step.
    let at_one = Hypothesis::near(&q, int(1), int(0));
    let counts = induction("counts", [&at_one], 2, [int(1)], |[x]| [x + int(1)], [q.clone()]);
    assert!(refused(counts.computing(&q, 1)));
    // A sequence that stays as it is, near what is another at each step.
    let near_q = Hypothesis::near(&u, &q, int(0));
    let stays = |near| drift("stays", [&near_q], 2, &u, Tree::clone, (near, int(0)), |_| []);
    assert!(refused(stays(u.clone()).computing(&u, &q)));
    let same = induction("same", [&near_q], 2, [u.clone()], |[x]| [x], [u.clone()]);
    assert!(refused(same.computing(&u, &q)));
    // Nor is what it is said to be near the member itself, or computed from it.
    let near = |member: &Tree| {
        let claim = drift("stays", [&near_q], 2, &v, Tree::clone, (v.clone(), int(0)), |_| []);
        let mut statement = Statement::of(&claim.computing(&u, &q));
        let sequence = statement.amounts_to.as_mut().unwrap();
        sequence.member = vec![member.clone()];
        prove(&statement)
    };
    assert!(near(&v).is_ok());
    assert!(matches!(near(&x("x₁")), Err(Why::Reserved("x₁"))));
    assert!(matches!(near(&u), Err(Why::Reserved("u"))));
    // Its slope is not 0, and q (1/q) does not vanish.
    let near_v = Hypothesis::near(&u, &v, int(0));
    assert!(refused(derivative("slope", [&near_v], &u, &v, 0).computing(&u, &v)));
    let inverse = Hypothesis::near(&u, int(1) / &q, int(0));
    let one = vanishing("one", [&above_zero(q.clone()), &inverse], int(1) / int(2), &q * &u, 0);
    assert!(refused(one.computing(&u, int(1) / &q)));
    // Nor is it a power of two because it is called so.
    for name in ["2ᵃ", PRECISION] {
        let near = Hypothesis::near(&x(name), &v, int(0));
        assert!(refused(positive("power", [&near], x(name)).computing(&x(name), &v)), "{name}");
    }
}

#[test]
fn what_is_compared_is_defined() {
    let quotient = |divisor: Tree| (x("u") / divisor).nearest();
    let difference = |a: Tree| Says::Sign(Relation::NonNegative, &a - &a);
    assert!(rounded(vec![], difference(quotient(int(2)))));
    assert!(!rounded(vec![], difference(quotient(x("c") - x("c")))));
    assert!(!rounded(vec![], difference(quotient(int(0)))));
    let equal = Hypothesis::new(Relation::Zero, x("c") - x("v"));
    assert!(!rounded(vec![equal], difference(quotient(x("c") - x("v")))));
}

/// u is between −1/v and 1/v: for all v, or what it is would tend to 0 without being any number.
#[test]
fn no_interval_shrinks_with_what_tends_to_infinity() {
    let [u, v] = ["u", "v"].map(x);
    let near = Hypothesis::near(&u, int(0), int(1) / &v);
    let shrinks = Says::Limit(u, "v", int(0));
    assert!(!proved(vec![above_zero(v), near], shrinks));
}
