//! Names, and what they may stand for in sequences.

use super::*;

#[test]
fn the_names_of_quantities_are_the_kernels_own() {
    let above = || vec![above_zero(x("u") - Tree::one())];
    assert!(!proved(above(), Says::Sign(Relation::Positive, x("s₁"))));
    assert!(!proved(vec![above_zero(x("u") - x("s₁"))], Says::Equal(x("u"), x("u"))));
    assert!(prove(&Statement::default()).is_err());
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

/// A computed quantity is another at each step: at the old one an invariant says nothing of the next member.
#[test]
fn nothing_is_assumed_of_a_computed_quantity_but_its_interval() {
    let [q, u, z, w] = ["q", "u", "z", "w"].map(x);
    let refused = |claim: Claim| matches!(prove(&Statement::of(&claim)), Err(Why::AssumedOfComputed("u")));
    let from_one = not_below_zero(&q - int(1));
    let near_q = Hypothesis::near(&u, &q, int(0));
    let square = &z * &z * &w * &w;
    // x stays 0, q is 2ᵏ, and |q (q − 1)| ≤ z² w² would follow; with z = w = 1 it is 2 at q = 2.
    let grows = drift("grows", [&from_one, &near_q], 2, 0, Tree::clone, (int(0), int(0)), |_| {
        [(&q * (&q - int(1)), square.clone())]
    });
    let with_u = not_below_zero(&square + (&q - int(1)) * (&q - int(2) * &u));
    let grows = grows.computing(&u, &q);
    let given = [grows.given.clone(), vec![with_u]].concat();
    assert!(refused(Claim { given, ..grows }));
    // x ← x + ⟨u (u − 1) − z² w²⟩ from 0 stays 0 as long as the bracket is closed.
    let step = |[x]: [Tree; 1]| [x + (&u * (&u - int(1)) - &square).positive_part()];
    let stays = induction("stays", [&from_one, &near_q], 2, [int(0)], step, [int(0)]).computing(&u, &q);
    // Neither with q in what is assumed of it, nor without, nor in any other kind of claim.
    for more in [&square - &u * (&u - int(1)) + (&q - &u), &square - &u * (&u - int(1))] {
        let given = [stays.given.clone(), vec![not_below_zero(more)]].concat();
        assert!(refused(Claim { given, ..stays.clone() }));
    }
    let one = equal("one", [&near_q], &u, &q).computing(&u, &q);
    assert!(prove(&Statement::of(&one)).is_ok());
    let given = [one.given.clone(), vec![above_zero(u.clone())]].concat();
    assert!(refused(Claim { given, ..one.clone() }));
    // Nor is it computed from itself.
    assert!(refused(Claim { computed: Some(("u", &u + (&q - &u))), ..one }));
}

/// A hypothesis on a power may fail as the power tends to 0; a step is the same for all powers.
#[test]
fn neither_the_limit_of_a_sequence_nor_its_step_depends_on_a_power() {
    let q = x("q");
    let refused = |claim: Claim| matches!(prove(&Statement::of(&claim)), Err(Why::Reserved("q")));
    let half = || int(1) / int(2);
    assert!(refused(vanishing("one", [&Hypothesis::new(Relation::Zero, &q - int(1))], half(), &q, 0)));
    let bounds = [&above_zero(q.clone()), &above_zero(int(2) - &q)];
    assert!(refused(vanishing("ratio", bounds, &q - int(1), &q, 0)));
    let (start, closed) = (vec![int(5)], vec![int(5) * &q]);
    let step = vec![int(5) * &q];
    assert!(refused(Claim::new("step", &[], Kind::Induction { ratio: int(1), start, step, closed })));
}
