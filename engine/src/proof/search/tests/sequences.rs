//! Tests of reserved names, sequences and computed quantities: each statement is refused for the premise of its
//! row, whatever a proof of it would look like.

use super::*;
use Premise::{Discontinuous, HypothesisOnComputed, NoGoals, ReservedName};

fn half() -> Tree {
    int(1) / int(2)
}

/// Returns the claim that the halves of x₀ are within q = ρᵏ of 0.
fn halves(start: Tree, ratio: Tree) -> Statement {
    let q = Hypothesis::between(&x("q"), int(0), int(1));
    let u = Hypothesis::near(&x("u"), x("x₁") * half(), int(0));
    perturbed_recursion("halves", ratio)
        .start(start)
        .step(|_| x("u"))
        .bounding(|_| x("u"), x("q"))
        .near(0, x("q"))
        .assuming([&q, &u])
        .computing(&x("u"), x("x₁") * half())
}

/// Names of proofs and of sequences have no other meaning.
fn names() -> Vec<(Premise, Statement)> {
    let [a, q, u] = ["a", "q", "u"].map(x);
    let above = above_zero(x("b") - &a);
    let double = |[x]: [Tree; 1]| [Tree::int(2) * x];
    // The search names b − a > 0 s₁. As s₁ grows, 1/(b − a) tends to 0, but the formula does not contain s₁.
    let limit = Statement::new("", Proposition::Limit(int(1) / (x("b") - &a), "s₁", int(0)));
    let slope = Statement::new("", Proposition::Derivative(x("b"), "s₁", int(0)));
    let bounded = perturbed_recursion("halves", half()).start(1).step(|x| x * half());
    let step = induction("step", 1, [int(5)], |_| [int(5) * x("r")], [int(5) * &q]);
    let closed = induction("halves", 2, [int(1)], double, [q.clone()]);
    let bounds = [&above_zero(q.clone()), &above_zero(int(2) - &q)];
    vec![
        (NoGoals, induction("nothing", 2, [], |[]| [], [])),
        (ReservedName("s₁"), positive("slack", x("s₁")).assuming([&above])),
        (ReservedName("s₁"), equal("slack", &u, &u).assuming([&above_zero(&u - x("s₁"))])),
        (ReservedName("s₁"), limit.assuming([&above])),
        (ReservedName("s₁"), slope.assuming([&above])),
        (ReservedName("x₁"), equal("member", x("x₁"), x("x₁"))),
        // From q, x ← ρ x is the sequence q ρᵏ, not ρᵏ.
        (ReservedName("q"), induction("powers", 2, [&q * int(1)], double, [q.clone()])),
        (ReservedName("q"), geometric_limit("vanishes", &q / (int(1) + &q * &q), &q, 0)),
        // Assumptions about each member would otherwise apply to the start.
        (ReservedName("x₁"), halves(x("x₁"), half())),
        (ReservedName("x₁"), halves(int(1), x("x₁"))),
        (ReservedName("u"), halves(u.clone(), half())),
        (ReservedName("u"), halves(int(1), u.clone())),
        // A bound is a formula of q, so a symbol with the name of a member in it would be another quantity.
        (ReservedName("x₁"), bounded.bounding(|x| x.clone(), x("x₁")).near(0, q.clone())),
        (ReservedName("x₁"), closed.assuming([&not_below_zero(x("x₁"))])),
        // A hypothesis on a power may fail as the power tends to 0; a step is the same for all powers.
        (
            ReservedName("q"),
            geometric_limit("one", half(), &q, 0).assuming([&Hypothesis::new(Relation::Zero, &q - int(1))]),
        ),
        (ReservedName("q"), geometric_limit("ratio", &q - int(1), &q, 0).assuming(bounds)),
        (ReservedName("q"), step.map(&|tree| tree.substitute(&[("r", q.clone())]))),
        (Discontinuous, geometric_limit("tends", half(), (int(1) + &q).round(), 1)),
        (Discontinuous, derivative("slope", u.round(), &u, 1)),
    ]
}

/// A computed quantity may change at each step: its symbol has no other meaning, and only its interval is assumed.
fn computed() -> Vec<(Premise, Statement)> {
    let [a, q, u, v, z] = ["a", "q", "u", "v", "z"].map(x);
    let near = |what: &Tree, of: &Tree, most: i32| Hypothesis::near(what, of, int(most));
    let chain = || within("near", &v - &a, int(2)).assuming([&near(&u, &a, 1), &near(&v, &a, 2)]);
    // The members 1, 2, 3, … are not powers of 2, which would follow for a computed q = 1 at each step.
    let counts = induction("counts", 2, [int(1)], |[x]| [x + int(1)], [q.clone()]);
    let near_q = near(&u, &q, 0);
    // A constant sequence, compared with a quantity that changes at each step.
    let stays = |start: &Tree, near: &Tree| perturbed_recursion("stays", 2).start(start).near(near, 0);
    let same = induction("same", 2, [u.clone()], |[x]| [x], [u.clone()]);
    // x stays 0, q is 2ᵏ, and |q (q − 1)| ≤ z² would follow, which is 2 ≤ 1 at z = 1 and q = 2.
    let from_one = not_below_zero(&q - int(1));
    let grows = perturbed_recursion("grows", 2).bounding(|_| &q * (&q - int(1)), &z * &z).near(0, 0);
    let with_u = not_below_zero(&z * &z + (&q - int(1)) * (&q - int(2) * &u));
    let step = |[x]: [Tree; 1]| [x + (&u * (&u - int(1)) - &z * &z).positive_part()];
    let closed =
        || induction("stays", 2, [int(0)], step, [int(0)]).assuming([&from_one, &near_q]).computing(&u, &q);
    let old = &z * &z - &u * (&u - int(1));
    let one = || equal("one", &u, &q).assuming([&near_q]);
    // The derivative of u = v is not 0, and q (1/q) does not tend to 0.
    let inverse = Hypothesis::near(&u, int(1) / &q, int(0));
    let tends = geometric_limit("one", half(), &q * &u, 0).assuming([&above_zero(q.clone()), &inverse]);
    let slope = derivative("slope", &u, &v, 0).assuming([&near(&u, &v, 0)]);
    let power = |name| positive("power", x(name)).assuming([&near(&x(name), &v, 0)]).computing(&x(name), &v);
    vec![
        // v is computed from u, so u comes first; circular definitions are rejected.
        (HypothesisOnComputed("u"), chain().computing(&v, &u + int(1)).computing(&u, &a + int(1))),
        (HypothesisOnComputed("v"), chain().computing(&u, &v - int(1)).computing(&v, &u + int(1))),
        (HypothesisOnComputed("u"), one().computing(&u, &u + (&q - &u))),
        (ReservedName("q"), counts.assuming([&near(&q, &int(1), 0)]).computing(&q, 1)),
        (ReservedName("u"), stays(&u, &u).assuming([&near_q]).computing(&u, &q)),
        (ReservedName("u"), stays(&v, &u).assuming([&near_q]).computing(&u, &q)),
        (ReservedName("u"), same.assuming([&near_q]).computing(&u, &q)),
        (Discontinuous, slope.computing(&u, &v)),
        (ReservedName("q"), tends.computing(&u, int(1) / &q)),
        (ReservedName("2ᵃ"), power("2ᵃ")),
        (ReservedName(PRECISION), power(PRECISION)),
        (
            HypothesisOnComputed("u"),
            grows.assuming([&from_one, &near_q]).computing(&u, &q).assuming([&with_u]),
        ),
        (HypothesisOnComputed("u"), closed().assuming([&not_below_zero(&old + (&q - &u))])),
        (HypothesisOnComputed("u"), closed().assuming([&not_below_zero(old)])),
        (HypothesisOnComputed("u"), one().computing(&u, &q).assuming([&above_zero(u.clone())])),
    ]
}

#[test]
fn statements_without_their_premises_are_refused() {
    for (premise, claim) in names().into_iter().chain(computed()) {
        let refused = prove(&claim).map(drop);
        assert!(
            matches!(&refused, Err(ProofError::Premise(own)) if *own == premise),
            "{premise:?}: {refused:?}"
        );
    }
}

#[test]
fn hypotheses_on_a_member_are_proved_for_each_member() {
    let prove = |hypotheses: &[Hypothesis]| prove(&halves(int(1), half()).assuming(hypotheses));
    assert!(prove(&[]).is_ok() && prove(&[not_below_zero(x("x₁"))]).is_ok());
    // The hypothesis fails at the start, or a step does not preserve it.
    for failing in [-x("x₁"), x("x₁") - int(7), x("x₁") * int(2) - int(1)] {
        assert!(prove(&[not_below_zero(failing)]).is_err());
    }
}

#[test]
#[should_panic(expected = "near: u is computed already")]
fn quantities_are_computed_once() {
    let [a, u] = ["a", "u"].map(x);
    let claim = within("near", &u - &a, int(1)).assuming([&Hypothesis::near(&u, &a, int(1))]);
    let _ = claim.computing(&u, &a).computing(&u, &a + int(1));
}
