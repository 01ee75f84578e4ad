//! Names, and what they may stand for in sequences.

use super::*;

#[test]
fn the_names_of_quantities_are_the_kernels_own() {
    let above = || vec![above_zero(x("u") - Tree::one())];
    assert!(!proved(above(), Proposition::Sign(Relation::Positive, x("s₁"))));
    assert!(!proved(vec![above_zero(x("u") - x("s₁"))], Proposition::Equal(x("u"), x("u"))));
}

#[test]
fn an_invariant_has_to_hold_at_the_start() {
    // x ← ⟨x⟩ from λ stays λ if λ ≥ 0; that it is so at every step is no reason for it to be so at the first.
    let (lambda, q) = (x("λ"), x("q"));
    let invariant = |q: &Tree| &lambda + (q - q);
    let step = |[x]: [Tree; 1]| [x.positive_part()];
    let stays = induction("stays", 1, [lambda.clone()], step, [lambda.clone()])
        .assuming([&not_below_zero(invariant(&q))]);
    assert!(prove(&stays.clone().assuming(&multiplier())).is_ok());
    assert!(matches!(prove(&stays), Err(Why::NoSign(..))));
}

#[test]
fn a_kept_name_is_no_variable_either() {
    // b > a makes b − a the kernel's s₁; as that grows 1/(b − a) vanishes, and yet nothing of a and b does.
    let above = || vec![above_zero(x("b") - x("a"))];
    let reciprocal = || Tree::one() / (x("b") - x("a"));
    let limit = |by| Proposition::Limit(reciprocal(), by, Tree::zero());
    assert!(matches!(outcome(above(), limit("s₁")), Err(Why::Reserved("s₁"))));
    let slope = |by| Proposition::Derivative(x("b"), by, Tree::zero());
    assert!(matches!(outcome(above(), slope("s₁")), Err(Why::Reserved("s₁"))));
    assert!(proved(above(), slope("u")));
    // Nor is what an induction calls the members of its sequence.
    assert!(matches!(outcome(vec![], Proposition::Equal(x("x₁"), x("x₁"))), Err(Why::Reserved("x₁"))));
}

#[test]
fn a_sequence_starts_from_no_power() {
    // From q, q → ρ q is the sequence q ρᵏ and not ρᵏ.
    let double = |[x]: [Tree; 1]| [Tree::int(2) * x];
    let from = |start: Tree| induction("powers", 2, [start], double, [x("q")]);
    assert!(prove(&from(Tree::one())).is_ok());
    assert!(matches!(prove(&from(x("q") / x("q"))), Err(Why::Reserved("q"))));
    let vanishes = |ratio: Tree| vanishing("vanishes", ratio, x("q"), 0);
    assert!(prove(&vanishes(Tree::one() / Tree::int(2))).is_ok());
    assert!(matches!(prove(&vanishes(x("q") / (Tree::one() + x("q") * x("q")))), Err(Why::Reserved("q"))));
}

/// x₀ = 1, and each x is half of the last: near 0 within q, if what is supposed of x is.
fn drifts(given: &[Hypothesis]) -> Result<Proof, Why> {
    let half = int(1) / int(2);
    let q = Hypothesis::between(&x("q"), int(0), int(1));
    let u = Hypothesis::near(&x("u"), x("x₁") * &half, int(0));
    let claim = drift("halves", half.clone(), 1, |_| x("u"), (int(0), x("q")), |_| [(x("u"), x("q"))])
        .assuming([&q, &u]);
    let claim = claim.computing(&x("u"), x("x₁") * &half);
    prove(&claim.assuming(given))
}

#[test]
fn what_is_supposed_of_a_member_is_proved_of_each() {
    assert!(drifts(&[]).is_ok());
    assert!(drifts(&[not_below_zero(x("x₁"))]).is_ok());
    // Not true at the start, although passed on; or not passed on.
    assert!(matches!(drifts(&[not_below_zero(-x("x₁"))]), Err(Why::WrongSign(..))));
    assert!(matches!(drifts(&[not_below_zero(x("x₁") - int(7))]), Err(Why::WrongSign(..))));
    assert!(drifts(&[not_below_zero(x("x₁") * int(2) - int(1))]).is_err());
    // Nor is it known of a sequence of which a closed form is claimed.
    let closed = induction("halves", 2, [int(1)], |[x]| [x * int(2)], [x("q")]);
    let supposed = not_below_zero(x("x₁"));
    assert!(matches!(prove(&closed.assuming([&supposed])), Err(Why::Reserved("x₁"))));
}

/// Each is in its interval because those before it are, and not because it is itself.
#[test]
fn a_computed_quantity_rests_on_those_before_it() {
    let [a, u, v] = ["a", "u", "v"].map(x);
    let given = [Hypothesis::near(&u, &a, int(1)), Hypothesis::near(&v, &a, int(2))];
    let claim = |bound: i32| within("near", &v - &a, int(bound)).assuming(&given);
    let chain = |claim: Statement| claim.computing(&u, &a + int(1)).computing(&v, &u + int(1));
    assert!(prove(&chain(claim(2))).is_ok());
    assert!(prove(&chain(claim(1))).is_err());
    // v is computed from u, so u comes first; and neither without the other.
    let turned = claim(2).computing(&v, &u + int(1)).computing(&u, &a + int(1));
    assert!(matches!(prove(&turned), Err(Why::AssumedOfComputed("u"))));
    let circular = claim(2).computing(&u, &v - int(1)).computing(&v, &u + int(1));
    assert!(matches!(prove(&circular), Err(Why::AssumedOfComputed("v"))));
    // The second is 3 off.
    assert!(prove(&claim(2).computing(&u, &a + int(1)).computing(&v, &u + int(2))).is_err());
    // What is not computed from the first says nothing of it.
    assert!(prove(&claim(2).computing(&u, &a + int(2)).computing(&v, &a)).is_err());
}

#[test]
#[should_panic(expected = "near: u is computed already")]
fn a_quantity_is_computed_once() {
    let [a, u] = ["a", "u"].map(x);
    let claim = within("near", &u - &a, int(1)).assuming([&Hypothesis::near(&u, &a, int(1))]);
    let _ = claim.computing(&u, &a).computing(&u, &a + int(1));
}

/// What is computed at each step is no constant, and has no other meaning.
#[test]
fn what_is_computed_is_neither_a_power_nor_a_constant() {
    let [q, u, v] = ["q", "u", "v"].map(x);
    let refused = |claim: Statement| matches!(prove(&claim), Err(Why::Reserved(_) | Why::Jump));
    // x₀ = 1, and each x is one more: no powers of 2, although q would be 1 at each step.
    let at_one = Hypothesis::near(&q, int(1), int(0));
    let counts = induction("counts", 2, [int(1)], |[x]| [x + int(1)], [q.clone()]).assuming([&at_one]);
    assert!(refused(counts.computing(&q, 1)));
    // A sequence that stays as it is, near what is another at each step.
    let near_q = Hypothesis::near(&u, &q, int(0));
    let stays = |near| drift("stays", 2, &u, Tree::clone, (near, int(0)), |_| []).assuming([&near_q]);
    assert!(refused(stays(u.clone()).computing(&u, &q)));
    let same = induction("same", 2, [u.clone()], |[x]| [x], [u.clone()]).assuming([&near_q]);
    assert!(refused(same.computing(&u, &q)));
    // Nor is the formula that it is near computed from the member.
    let near = |near: &Tree| {
        let claim = drift("stays", 2, &v, Tree::clone, (near.clone(), int(0)), |_| []).assuming([&near_q]);
        prove(&claim.computing(&u, &q))
    };
    assert!(near(&v).is_ok());
    assert!(matches!(near(&u), Err(Why::Reserved("u"))));
    // Its slope is not 0, and q (1/q) does not vanish.
    let near_v = Hypothesis::near(&u, &v, int(0));
    assert!(refused(derivative("slope", &u, &v, 0).assuming([&near_v]).computing(&u, &v)));
    let inverse = Hypothesis::near(&u, int(1) / &q, int(0));
    let one = vanishing("one", int(1) / int(2), &q * &u, 0).assuming([&above_zero(q.clone()), &inverse]);
    assert!(refused(one.computing(&u, int(1) / &q)));
    // Nor is it a power of two because it is called so.
    for name in ["2ᵃ", PRECISION] {
        let near = Hypothesis::near(&x(name), &v, int(0));
        assert!(refused(positive("power", x(name)).assuming([&near]).computing(&x(name), &v)), "{name}");
    }
}

/// A computed quantity is another at each step: at the old one an invariant says nothing of the next member.
#[test]
fn nothing_is_assumed_of_a_computed_quantity_but_its_interval() {
    let [q, u, z, w] = ["q", "u", "z", "w"].map(x);
    let refused = |claim: Statement| matches!(prove(&claim), Err(Why::AssumedOfComputed("u")));
    let from_one = not_below_zero(&q - int(1));
    let near_q = Hypothesis::near(&u, &q, int(0));
    let square = &z * &z * &w * &w;
    // x stays 0, q is 2ᵏ, and |q (q − 1)| ≤ z² w² would follow; with z = w = 1 it is 2 at q = 2.
    let grows =
        drift("grows", 2, 0, Tree::clone, (int(0), int(0)), |_| [(&q * (&q - int(1)), square.clone())])
            .assuming([&from_one, &near_q]);
    let with_u = not_below_zero(&square + (&q - int(1)) * (&q - int(2) * &u));
    let grows = grows.computing(&u, &q);
    assert!(refused(grows.assuming([&with_u])));
    // x ← x + ⟨u (u − 1) − z² w²⟩ from 0 stays 0 as long as the bracket is closed.
    let step = |[x]: [Tree; 1]| [x + (&u * (&u - int(1)) - &square).positive_part()];
    let stays =
        induction("stays", 2, [int(0)], step, [int(0)]).assuming([&from_one, &near_q]).computing(&u, &q);
    // Neither with q in what is assumed of it, nor without, nor in any other kind of claim.
    for more in [&square - &u * (&u - int(1)) + (&q - &u), &square - &u * (&u - int(1))] {
        assert!(refused(stays.clone().assuming([&not_below_zero(more)])));
    }
    let one = equal("one", &u, &q).assuming([&near_q]);
    let computed = one.clone().computing(&u, &q);
    assert!(prove(&computed).is_ok());
    assert!(refused(computed.assuming([&above_zero(u.clone())])));
    // Nor is it computed from itself.
    assert!(refused(one.computing(&u, &u + (&q - &u))));
}

/// A hypothesis on a power may fail as the power tends to 0; a step is the same for all powers.
#[test]
fn neither_the_limit_of_a_sequence_nor_its_step_depends_on_a_power() {
    let q = x("q");
    let refused = |claim: Statement| matches!(prove(&claim), Err(Why::Reserved("q")));
    let half = || int(1) / int(2);
    assert!(refused(
        vanishing("one", half(), &q, 0).assuming([&Hypothesis::new(Relation::Zero, &q - int(1))])
    ));
    let bounds = [&above_zero(q.clone()), &above_zero(int(2) - &q)];
    assert!(refused(vanishing("ratio", &q - int(1), &q, 0).assuming(bounds)));
    // The constructor refuses such a step, and a replaced symbol does not pass it.
    let step = induction("step", 1, [int(5)], |_| [int(5) * x("r")], [int(5) * &q]);
    assert!(refused(step.map(&|tree| tree.with(&[("r", q.clone())]))));
}
