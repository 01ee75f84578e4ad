//! Results of claims in one case.

use super::*;
use crate::claims::hypotheses;
use crate::formula::Rate;
use crate::formula::claim::{
    derivative, equal, geometric_limit, induction, limit, non_negative, positive, within,
};
use crate::number::{Field, Tree};
use num_traits::One;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn int(n: i32) -> Tree {
    Tree::int(n)
}

/// Returns the tally of a claim for one case in a number system.
fn tally<D: NumberDomain>(domain: D, case: Case<Exact>, claim: Statement) -> ClaimTally {
    let hypotheses = claim.stated_hypotheses().to_vec();
    let checker = Checker::new(domain, [&claim], Vec::new());
    let mut tallies = checker.check(&hypotheses, &Options::default(), &[Some(case)]);
    tallies.remove(0).1
}

/// Returns whether a claim holds where every coordinate except q is 2; `None` if it is undecided.
fn verdict<D: NumberDomain>(domain: D, q: i32, claim: Statement) -> Option<bool> {
    let tally = tally(domain, Case { q: Exact::int(q), ..Case::of(|_| Exact::int(2)) }, claim);
    (tally.decided > 0).then_some(tally.failure.is_none())
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
fn common_subexpressions_are_computed_once() {
    let square = || x("u") * x("u");
    let sum = equal("sum", square() + square(), int(2) * square());
    let sign = non_negative("sign", square());
    let other = sign.clone().assuming([&hypotheses().stiffness]);
    let groups = groups(&[sum, other, sign]);
    let of = |group: &Group| group.claims.iter().map(|(place, _)| *place).collect::<Vec<_>>();
    assert_eq!(groups.iter().map(of).collect::<Vec<_>>(), [vec![0, 2], vec![1]]);
    assert_eq!(groups[0].program.len(), 5, "u, u², the sum, 2, and the product");
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
    let tally = tally(Rationals::unrounded(), Case::of(|_| Exact::one()), equal("zero", int(1) / int(0), 1));
    assert_eq!(tally.failure.unwrap().1.as_deref(), Some("division by zero"));
}

#[test]
fn the_ratio_of_an_error_to_a_bound_of_zero_is_infinite() {
    // Constants of MPFR are exact, and so is their difference.
    let [two, three] = [2, 3].map(Ball::<Mpfr>::int);
    let ratios = [&three, &two].map(|other| {
        let [error, bound] = Balls::<Mpfr>::difference(&two, other);
        ratio(&error, &bound)
    });
    assert_eq!(ratios, [f64::INFINITY, 0.0]);
}

#[test]
fn one_failed_case_fails_a_claim_and_no_decided_case_leaves_it_undecided() {
    let row = |tally: ClaimTally| {
        tally.into_result(
            ClaimKey { equation: "1.1", claim: "claim", kind: "equal", hypotheses: vec![] },
            None,
        )
    };
    let held = ClaimTally { decided: 1, undecided: 5, ..ClaimTally::default() };
    let failure = super::super::cases::case(1, 0, &[]).map(|case| (case, Some("why".to_string())));
    let failed = ClaimTally { decided: 7, failure, ..ClaimTally::default() };
    assert_eq!(row(ClaimTally { undecided: 5, ..ClaimTally::default() }).status, Status::Undecided);
    assert_eq!(row(held).status, Status::Held);
    let failed = row(failed);
    assert_eq!((failed.status, failed.reason.as_deref()), (Status::Failed, Some("why")));
    assert!(failed.counterexample.is_some());
}

#[test]
fn a_bound_is_formatted_without_loss() {
    let third = Ball::point(1.0) / Ball::point(3.0);
    let claim = || equal("third", x("u") / int(3), x("u") / int(3));
    let (_, bound) = tally(Balls(0.0), Case::of(|_| Exact::one()), claim()).worst.unwrap();
    assert!(*third.radius() > 0.0);
    assert_eq!(bound.parse(), Ok(*(&third - &third).radius()));
    assert_eq!(tally(Rationals::unrounded(), Case::of(|_| Exact::one()), claim()).worst.unwrap().1, "0");
}

/// The first of equal ratios counts, of several tests and of several tallies.
#[test]
fn the_worst_share_is_recorded() {
    let measured = |all: &[(f64, &'static str)]| {
        let mut tally = ClaimTally::default();
        all.iter().for_each(|(ratio, bound)| tally.measure(*ratio, || bound.to_string()));
        tally
    };
    let worst = |tally: ClaimTally| tally.worst.map(|(_, bound)| bound);
    assert_eq!(worst(measured(&[(0.25, "a"), (0.5, "b"), (0.5, "c"), (0.25, "d")])), Some("b".to_string()));
    for (later, found) in [(0.25, "own"), (0.5, "own"), (0.75, "later")] {
        let mut own = measured(&[(0.5, "own")]);
        own.add(measured(&[(later, "later")]));
        assert_eq!(worst(own), Some(found.to_string()));
    }
    // 2/49 is rounded, and 2 is not.
    let share = |claim| tally(Balls(0f64), Case::of(|_| Exact::from(2)), claim).worst.unwrap().0;
    let rounded = share(equal("rounded", x("u") / int(49) * int(49), 2));
    assert_eq!((share(equal("exact", x("u"), 2)), 0.0 < rounded && rounded <= 1.0), (0.0, true));
}

#[test]
fn a_wrong_derivative_is_detected() {
    let square = |is: Tree| derivative("square", x("u") * x("u"), &x("u"), is);
    assert!(holds(square(x("u") + x("u"))) && !holds(square(x("u"))));
}

#[test]
fn a_bound_limits_the_absolute_value() {
    for of in [x("u"), -x("u")] {
        let is_met = |bound: i32| holds(within("bound", of.clone(), bound));
        assert!(is_met(3) && is_met(2) && !is_met(1) && !is_met(-3));
    }
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

#[test]
fn powers_vanish_only_if_the_ratio_is_less_than_1_in_absolute_value() {
    let vanishing =
        |ratio: Tree, to: Tree| holds(geometric_limit("limit", ratio, x("u") + x("v") * x("q"), to));
    for half in [int(1) / int(2), int(-1) / int(2)] {
        assert!(vanishing(half, x("u")));
    }
    for large in [1, -1, 2, -2] {
        assert!(!vanishing(int(large), x("u")));
    }
    assert!(!vanishing(int(0), x("u") + x("v")), "it is the limit, not the first value");
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
