//! Results of claims in one case.

use super::*;
use crate::formula::Rate;
use crate::formula::claim::{equal, induction, limit, positive};
use crate::number::{Field, Tree};
use num_traits::One;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn int(n: i32) -> Tree {
    Tree::int(n)
}

/// Returns the result of a claim for one case in a number system.
fn result<D: NumberDomain + Clone + Send + 'static>(
    domain: D,
    case: &Case<Exact>,
    claim: &Statement,
) -> ClaimResult {
    let (mut groups, scalar) = (Vec::new(), NumberSystem::Exact);
    add_checks(&mut groups, &Options::default(), (scalar, domain), [claim], Vec::new());
    let Group { results, checks, .. } = &mut groups[0];
    (checks[0].1)(case, results);
    results.remove(0)
}

/// Returns whether a claim holds where every coordinate except q is 2; `None` if it is undecided.
fn verdict<D: NumberDomain + Clone + Send + 'static>(domain: D, q: i32, claim: Statement) -> Option<bool> {
    let result = result(domain, &Case { q: Exact::int(q), ..Case::of(|_| Exact::int(2)) }, &claim);
    (result.decided > 0).then_some(result.counterexample.is_none())
}

fn holds_at(q: i32, claim: Statement) -> bool {
    verdict(Rationals::unrounded(), q, claim).expect("decided")
}

fn holds(claim: Statement) -> bool {
    holds_at(2, claim)
}

/// Returns whether a claim holds in f64 at u = 2; `None` if it is undecided.
fn in_floats(claim: Statement) -> Option<bool> {
    verdict(Balls(0f64), 2, claim)
}

/// Returns a formula whose sign is lost in rounding.
fn perhaps_zero() -> Tree {
    int(1) / int(3) * int(3) - int(1)
}

#[test]
fn an_equation_fails_for_a_relative_difference_of_2_to_the_minus_50() {
    let third = || x("u") / int(6);
    let more = third() + (0..52).fold(int(1), |ulp, _| ulp / int(2));
    assert_eq!(in_floats(equal("same", third(), int(1) / int(3))), Some(true));
    assert_eq!(in_floats(equal("more", third(), more)), Some(false));
    assert!(!holds(equal("other", 1, 2)));
}

#[test]
fn a_sign_lost_by_rounding_is_undecided_and_a_wrong_sign_fails() {
    let sign = |x: Tree| in_floats(positive("sign", x));
    assert_eq!((sign(perhaps_zero()), sign(int(1)), sign(int(-1))), (None, Some(true), Some(false)));
}

/// The bound of a limit and the distance are claims of one statement.
#[test]
fn a_failed_test_decides_even_if_another_is_undecided() {
    let limit = |of: Tree, bound: Tree| in_floats(limit("limit", of, &x("t"), 0, Rate::Within(bound)));
    assert_eq!(limit(int(0), perhaps_zero()), None);
    assert_eq!(limit(int(1), perhaps_zero()), Some(false));
    assert_eq!(limit(perhaps_zero(), int(-1)), Some(false));
}

#[test]
fn division_by_zero_fails_and_division_by_a_ball_around_zero_is_undecided() {
    for (divisor, expected) in [(x("u") - int(2), Some(false)), (perhaps_zero(), None)] {
        let quotient = || int(1) / &divisor;
        assert_eq!(in_floats(equal("equal", quotient(), 1)), expected);
        assert_eq!(in_floats(positive("positive", quotient())), expected);
    }
    let undefined = equal("zero", int(1) / int(0), 1);
    let result = result(Rationals::unrounded(), &Case::of(|_| Exact::one()), &undefined);
    assert_eq!(result.reason.as_deref(), Some("division by zero"));
}

#[test]
fn a_bound_is_formatted_without_loss() {
    let third = Ball::point(1.0) / Ball::point(3.0);
    let claim = || equal("third", x("u") / int(3), x("u") / int(3));
    let worst = |result: ClaimResult| result.worst.unwrap().1;
    let bound = worst(result(Balls(0.0), &Case::of(|_| Exact::one()), &claim()));
    assert!(*third.radius() > 0.0);
    assert_eq!(bound.parse(), Ok(*(&third - &third).radius()));
    assert_eq!(worst(result(Rationals::unrounded(), &Case::of(|_| Exact::one()), &claim())), "0");
}

/// The first of equal ratios counts.
#[test]
fn the_worst_share_is_recorded() {
    let mut own = ClaimResult::new("1.1", "claim", "equal", None);
    for (ratio, bound) in [(0.25, "a"), (0.5, "b"), (0.5, "c"), (0.25, "d")] {
        own.measure(ratio, || bound.to_string());
    }
    assert_eq!(own.worst, Some((0.5, "b".to_string())));
    // 2/49 is rounded, and 2 is not.
    let share = |claim| result(Balls(0f64), &Case::of(|_| Exact::from(2)), &claim).worst.unwrap().0;
    let rounded = share(equal("rounded", x("u") / int(49) * int(49), 2));
    assert_eq!((share(equal("exact", x("u"), 2)), 0.0 < rounded && rounded <= 1.0), (0.0, true));
}

#[test]
fn the_rate_of_a_limit_is_checked_on_either_side() {
    let limit = |of: Tree, rate| holds(limit("limit", of, &x("t"), x("u"), rate));
    for of in [x("u") + int(3), x("u") - int(3)] {
        assert!(limit(of.clone(), Rate::Within(int(3))) && !limit(of.clone(), Rate::Within(int(2))));
        assert!(!limit(of, Rate::Within(int(-3))), "no bound is negative");
    }
    assert!(limit(x("u") + int(3), Rate::Equal(int(3))));
    assert!(!limit(x("u") - int(3), Rate::Equal(int(3))));
}

/// x₀ = 3, x ← 2 x − 1, so x_k − 1 = 2 · 2ᵏ.
#[test]
fn an_induction_checks_its_start_its_step_and_its_closed_form() {
    let induction = |start: i32, less: i32, closed: Tree| {
        let step = |[x]: [Tree; 1]| [int(2) * x - int(less)];
        induction("powers", 2, [int(start)], step, [closed])
    };
    let closed = || int(2) * x("q") + int(1);
    assert!(holds(induction(3, 1, closed())));
    assert!(!holds(induction(4, 1, closed())));
    assert!(!holds(induction(3, 0, closed())));
    assert!(!holds(induction(3, 1, int(2) * x("q") + int(2))));
    assert!(!holds(induction(3, 1, x("q") + int(2))), "right at the start, and then a step late");
    // The start and the step at q = 2 are right, but not the third member.
    let late = [1, 2, 4].into_iter().fold(int(1), |off, n| off * (x("q") - int(n)));
    assert!(!holds(induction(3, 1, closed() + late)));
    // Right from 3 for all steps followed, and wrong for a power that no step meets: 3, 5, 9, 17, and so
    // on.
    let off = [1, 2, 4, 8].into_iter().fold(int(1), |off, n| off * (x("q") - int(n)));
    let followed = || induction(3, 1, closed() + &off);
    assert!(holds_at(2, followed()) && !holds_at(3, followed()));
}
