//! Tests of reserved names, sequences and computed quantities.

use super::*;

#[test]
fn names_of_slack_variables_are_reserved() {
    let above = || vec![above_zero(x("u") - Tree::one())];
    assert!(!proved(above(), Proposition::Sign(Relation::Positive, x("s₁"))));
    assert!(!proved(vec![above_zero(x("u") - x("s₁"))], Proposition::Equal(x("u"), x("u"))));
}

#[test]
fn invariants_must_hold_at_the_start() {
    // x ← ⟨x⟩ from λ stays λ if λ ≥ 0, which does not follow from the invariant that every step preserves.
    let (lambda, q) = (x("λ"), x("q"));
    let invariant = |q: &Tree| &lambda + (q - q);
    let step = |[x]: [Tree; 1]| [x.positive_part()];
    let stays = induction("stays", 1, [lambda.clone()], step, [lambda.clone()])
        .assuming([&not_below_zero(invariant(&q))]);
    assert!(prove(&stays.clone().assuming(&multiplier())).is_ok());
    assert!(matches!(prove(&stays), Err(ProofError::UnknownSign(..))));
}

#[test]
fn variables_must_not_have_reserved_names() {
    // The search names b − a > 0 s₁. As s₁ grows, 1/(b − a) tends to 0, but the formula does not contain s₁.
    let above = || vec![above_zero(x("b") - x("a"))];
    let reciprocal = || Tree::one() / (x("b") - x("a"));
    let limit = |by| Proposition::Limit(reciprocal(), by, Tree::zero());
    assert!(matches!(outcome(above(), limit("s₁")), Err(ProofError::Premise(Premise::ReservedName("s₁")))));
    let slope = |by| Proposition::Derivative(x("b"), by, Tree::zero());
    assert!(matches!(outcome(above(), slope("s₁")), Err(ProofError::Premise(Premise::ReservedName("s₁")))));
    assert!(proved(above(), slope("u")));
    // The names of members of a sequence are reserved as well.
    assert!(matches!(
        outcome(vec![], Proposition::Equal(x("x₁"), x("x₁"))),
        Err(ProofError::Premise(Premise::ReservedName("x₁")))
    ));
}

#[test]
fn sequences_do_not_start_from_a_power() {
    // From q, x ← ρ x is the sequence q ρᵏ, not ρᵏ.
    let double = |[x]: [Tree; 1]| [Tree::int(2) * x];
    let from = |start: Tree| induction("powers", 2, [start], double, [x("q")]);
    assert!(prove(&from(Tree::one())).is_ok());
    assert!(matches!(prove(&from(x("q") / x("q"))), Err(ProofError::Premise(Premise::ReservedName("q")))));
    let vanishes = |ratio: Tree| geometric_limit("vanishes", ratio, x("q"), 0);
    assert!(prove(&vanishes(Tree::one() / Tree::int(2))).is_ok());
    assert!(matches!(
        prove(&vanishes(x("q") / (Tree::one() + x("q") * x("q")))),
        Err(ProofError::Premise(Premise::ReservedName("q")))
    ));
}

#[test]
fn a_statement_without_goals_is_not_proved() {
    let nothing = induction("nothing", 2, [], |[]| [], []);
    assert!(matches!(prove(&nothing), Err(ProofError::Premise(Premise::NoGoals))));
}

/// Returns the claim that the halves of x₀ are within q = ρᵏ of 0.
fn halves(start: Tree, ratio: Tree) -> Statement {
    let half = int(1) / int(2);
    let q = Hypothesis::between(&x("q"), int(0), int(1));
    let u = Hypothesis::near(&x("u"), x("x₁") * &half, int(0));
    perturbed_recursion("halves", ratio)
        .start(start)
        .step(|_| x("u"))
        .bounding(|_| x("u"), x("q"))
        .near(0, x("q"))
        .assuming([&q, &u])
        .computing(&x("u"), x("x₁") * &half)
}

/// Proves, under further hypotheses, that the halves of x₀ = 1 are within q of 0.
fn prove_drift(hypotheses: &[Hypothesis]) -> Result<Proof, ProofError> {
    prove(&halves(int(1), int(1) / int(2)).assuming(hypotheses))
}

/// Assumptions about each member would otherwise apply to the start.
#[test]
fn sequences_start_neither_from_a_member_nor_from_a_computed_quantity() {
    for name in ["x₁", "u"] {
        for claim in [halves(x(name), int(1) / int(2)), halves(int(1), x(name))] {
            assert!(
                matches!(prove(&claim), Err(ProofError::Premise(Premise::ReservedName(own))) if own == name),
                "{name}"
            );
        }
    }
}

/// A bound is a formula of q, so a symbol with the name of a member in it would be another quantity.
#[test]
fn bounds_do_not_depend_on_a_member() {
    let half = || int(1) / int(2);
    let halves = perturbed_recursion("halves", half()).start(1).step(|x| x * half());
    let bounded = |by: Tree| halves.clone().bounding(|x| x.clone(), by).near(0, x("q"));
    assert!(prove(&bounded(x("q")).assuming([&not_below_zero(x("q"))])).is_ok());
    assert!(matches!(prove(&bounded(x("x₁"))), Err(ProofError::Premise(Premise::ReservedName("x₁")))));
}

#[test]
fn hypotheses_on_a_member_are_proved_for_each_member() {
    assert!(prove_drift(&[]).is_ok());
    assert!(prove_drift(&[not_below_zero(x("x₁"))]).is_ok());
    // The hypothesis fails at the start, or a step does not preserve it.
    assert!(matches!(prove_drift(&[not_below_zero(-x("x₁"))]), Err(ProofError::WrongSign(..))));
    assert!(matches!(prove_drift(&[not_below_zero(x("x₁") - int(7))]), Err(ProofError::WrongSign(..))));
    assert!(prove_drift(&[not_below_zero(x("x₁") * int(2) - int(1))]).is_err());
    // Claims of closed forms have no hypotheses on members.
    let closed = induction("halves", 2, [int(1)], |[x]| [x * int(2)], [x("q")]);
    let hypothesis = not_below_zero(x("x₁"));
    assert!(matches!(
        prove(&closed.assuming([&hypothesis])),
        Err(ProofError::Premise(Premise::ReservedName("x₁")))
    ));
}

/// The proof of an interval uses the intervals of earlier computed quantities only.
#[test]
fn computed_quantities_depend_on_earlier_ones_only() {
    let [a, u, v] = ["a", "u", "v"].map(x);
    let intervals = [Hypothesis::near(&u, &a, int(1)), Hypothesis::near(&v, &a, int(2))];
    let claim = |bound: i32| within("near", &v - &a, int(bound)).assuming(&intervals);
    let chain = |claim: Statement| claim.computing(&u, &a + int(1)).computing(&v, &u + int(1));
    assert!(prove(&chain(claim(2))).is_ok());
    assert!(prove(&chain(claim(1))).is_err());
    // v is computed from u, so u comes first; circular definitions are rejected.
    let reversed = claim(2).computing(&v, &u + int(1)).computing(&u, &a + int(1));
    assert!(matches!(prove(&reversed), Err(ProofError::Premise(Premise::HypothesisOnComputed("u")))));
    let circular = claim(2).computing(&u, &v - int(1)).computing(&v, &u + int(1));
    assert!(matches!(prove(&circular), Err(ProofError::Premise(Premise::HypothesisOnComputed("v")))));
    // The second differs from a by 3.
    assert!(prove(&claim(2).computing(&u, &a + int(1)).computing(&v, &u + int(2))).is_err());
    // The first is outside its interval, although the second does not depend on it.
    assert!(prove(&claim(2).computing(&u, &a + int(2)).computing(&v, &a)).is_err());
}

#[test]
#[should_panic(expected = "near: u is computed already")]
fn quantities_are_computed_once() {
    let [a, u] = ["a", "u"].map(x);
    let claim = within("near", &u - &a, int(1)).assuming([&Hypothesis::near(&u, &a, int(1))]);
    let _ = claim.computing(&u, &a).computing(&u, &a + int(1));
}

/// A computed quantity may change at each step, and its symbol has no other meaning.
#[test]
fn computed_quantities_are_neither_powers_nor_constants() {
    let [q, u, v] = ["q", "u", "v"].map(x);
    let is_rejected = |claim: Statement| {
        matches!(
            prove(&claim),
            Err(ProofError::Premise(Premise::ReservedName(_)) | ProofError::Premise(Premise::Discontinuous))
        )
    };
    // The members 1, 2, 3, … are not powers of 2, which would follow for a computed q = 1 at each step.
    let at_one = Hypothesis::near(&q, int(1), int(0));
    let counts = induction("counts", 2, [int(1)], |[x]| [x + int(1)], [q.clone()]).assuming([&at_one]);
    assert!(is_rejected(counts.computing(&q, 1)));
    // A constant sequence, compared with a quantity that changes at each step.
    let near_q = Hypothesis::near(&u, &q, int(0));
    let stays = |near: Tree| perturbed_recursion("stays", 2).start(&u).near(near, 0).assuming([&near_q]);
    assert!(is_rejected(stays(u.clone()).computing(&u, &q)));
    let same = induction("same", 2, [u.clone()], |[x]| [x], [u.clone()]).assuming([&near_q]);
    assert!(is_rejected(same.computing(&u, &q)));
    // The reference of the bound must not be a computed quantity.
    let near = |near: &Tree| {
        let claim = perturbed_recursion("stays", 2).start(&v).near(near, 0).assuming([&near_q]);
        prove(&claim.computing(&u, &q))
    };
    assert!(near(&v).is_ok());
    assert!(matches!(near(&u), Err(ProofError::Premise(Premise::ReservedName("u")))));
    // The derivative of u = v is not 0, and q (1/q) does not tend to 0.
    let near_v = Hypothesis::near(&u, &v, int(0));
    assert!(is_rejected(derivative("slope", &u, &v, 0).assuming([&near_v]).computing(&u, &v)));
    let inverse = Hypothesis::near(&u, int(1) / &q, int(0));
    let one =
        geometric_limit("one", int(1) / int(2), &q * &u, 0).assuming([&above_zero(q.clone()), &inverse]);
    assert!(is_rejected(one.computing(&u, int(1) / &q)));
    // A computed quantity must not have the name of a power of two.
    for name in ["2ᵃ", PRECISION] {
        let near = Hypothesis::near(&x(name), &v, int(0));
        assert!(is_rejected(positive("power", x(name)).assuming([&near]).computing(&x(name), &v)), "{name}");
    }
}

/// A computed quantity changes at each step, so an invariant for the old value does not apply to the new one.
#[test]
fn the_only_hypothesis_on_a_computed_quantity_is_its_interval() {
    let [q, u, z, w] = ["q", "u", "z", "w"].map(x);
    let is_rejected = |claim: Statement| {
        matches!(prove(&claim), Err(ProofError::Premise(Premise::HypothesisOnComputed("u"))))
    };
    let from_one = not_below_zero(&q - int(1));
    let near_q = Hypothesis::near(&u, &q, int(0));
    let square = &z * &z * &w * &w;
    // x stays 0, q is 2ᵏ, and |q (q − 1)| ≤ z² w² would follow, which is 2 ≤ 1 at z = w = 1 and q = 2.
    let grows = perturbed_recursion("grows", 2)
        .bounding(|_| &q * (&q - int(1)), &square)
        .near(0, 0)
        .assuming([&from_one, &near_q]);
    let with_u = not_below_zero(&square + (&q - int(1)) * (&q - int(2) * &u));
    let grows = grows.computing(&u, &q);
    assert!(is_rejected(grows.assuming([&with_u])));
    // x ← x + ⟨u (u − 1) − z² w²⟩ from 0 stays 0 as long as the positive part is 0.
    let step = |[x]: [Tree; 1]| [x + (&u * (&u - int(1)) - &square).positive_part()];
    let stays =
        induction("stays", 2, [int(0)], step, [int(0)]).assuming([&from_one, &near_q]).computing(&u, &q);
    // Such hypotheses are rejected with and without q, and in claims of any kind.
    for more in [&square - &u * (&u - int(1)) + (&q - &u), &square - &u * (&u - int(1))] {
        assert!(is_rejected(stays.clone().assuming([&not_below_zero(more)])));
    }
    let one = equal("one", &u, &q).assuming([&near_q]);
    let computed = one.clone().computing(&u, &q);
    assert!(prove(&computed).is_ok());
    assert!(is_rejected(computed.assuming([&above_zero(u.clone())])));
    // A quantity is not computed from itself.
    assert!(is_rejected(one.computing(&u, &u + (&q - &u))));
}

/// A hypothesis on a power may fail as the power tends to 0; a step is the same for all powers.
#[test]
fn limits_and_steps_of_sequences_do_not_depend_on_a_power() {
    let q = x("q");
    let is_rejected =
        |claim: Statement| matches!(prove(&claim), Err(ProofError::Premise(Premise::ReservedName("q"))));
    let half = || int(1) / int(2);
    assert!(is_rejected(
        geometric_limit("one", half(), &q, 0).assuming([&Hypothesis::new(Relation::Zero, &q - int(1))])
    ));
    let bounds = [&above_zero(q.clone()), &above_zero(int(2) - &q)];
    assert!(is_rejected(geometric_limit("ratio", &q - int(1), &q, 0).assuming(bounds)));
    // The constructor rejects such a step, and `prove` rejects one that results from substitution.
    let step = induction("step", 1, [int(5)], |_| [int(5) * x("r")], [int(5) * &q]);
    assert!(is_rejected(step.map(&|tree| tree.substitute(&[("r", q.clone())]))));
}
