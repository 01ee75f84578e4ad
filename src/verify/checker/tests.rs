//! Results of claims in one case.

use super::*;
use crate::formula::Relation;
use crate::number::Field;

/// Returns the verdict for numbers, some of which may be undefined.
fn verdict<J: NumberDomain>(judge: J, asked: &[Test], values: Vec<Option<J::Number>>) -> Option<bool> {
    match Checker::with(judge, &[], Vec::new()).verdict(asked, &values) {
        Verdict::Undecided => None,
        Verdict::Decided { holds, .. } => Some(holds),
        Verdict::Failed(_) => Some(false),
    }
}

fn equal<J: NumberDomain>(judge: J, left: J::Number, right: J::Number) -> Option<bool> {
    verdict(judge, &[Test::Equal(0, 1)], vec![Some(left), Some(right)])
}

#[test]
fn an_equation_fails_for_a_relative_difference_of_2_to_the_minus_50() {
    let (third, more) = (Ball::point(1.0) / Ball::point(3.0), Ball::point(1.0 / 3.0 + 2f64.powi(-52)));
    assert_eq!(equal(FloatDomain(0.0), third.clone(), third.clone()), Some(true));
    assert_eq!(equal(FloatDomain(0.0), third, more), Some(false));
    assert_eq!(equal(RationalDomain, 1.into(), 2.into()), Some(false));
}

/// Returns a number whose sign is lost in rounding.
fn perhaps_zero() -> Ball<f64> {
    Ball::point(1.0) / Ball::point(3.0) * Ball::point(3.0) - Ball::point(1.0)
}

#[test]
fn a_sign_lost_by_rounding_is_undecided_and_a_wrong_sign_fails() {
    let sign = |x: Ball<f64>| verdict(FloatDomain(0.0), &[Test::Sign(Relation::Positive, 0)], vec![Some(x)]);
    let found = (sign(perhaps_zero()), sign(Ball::point(1.0)), sign(Ball::point(-1.0)));
    assert_eq!(found, (None, Some(true), Some(false)));
}

#[test]
fn a_failed_test_decides_even_if_another_is_undecided() {
    let values = || {
        [1.0, 2.0].map(|x| Some(Ball::point(x))).into_iter().chain([Some(Ball::point(1.0) / perhaps_zero())])
    };
    let (open, wrong) = (Test::Equal(0, 2), Test::Equal(0, 1));
    assert_eq!(verdict(FloatDomain(0.0), &[open], values().collect()), None);
    assert_eq!(verdict(FloatDomain(0.0), &[open, wrong], values().collect()), Some(false));
    assert_eq!(verdict(FloatDomain(0.0), &[wrong, open], values().collect()), Some(false));
}

#[test]
fn division_by_zero_fails_and_division_by_a_ball_around_zero_is_undecided() {
    let zero = Ball::point(1.0) - Ball::point(1.0);
    for (divisor, expected) in [(zero, Some(false)), (perhaps_zero(), None)] {
        let quotient = FloatDomain::<f64>::step(Op::Div(&Ball::point(1.0), &divisor));
        let values = vec![Some(Ball::point(1.0)), quotient];
        for asked in [Test::Equal(0, 1), Test::Sign(Relation::Positive, 1)] {
            assert_eq!(verdict(FloatDomain(0.0), &[asked], values.clone()), expected);
        }
    }
    assert_eq!(RationalDomain::step(Op::Div(&1.into(), &0.into())), None);
}

#[test]
fn an_error_beyond_a_bound_of_zero_is_an_infinite_share() {
    // Constants of MPFR are exact, and so is their difference.
    let [two, three] = [2, 3].map(Ball::<Mpfr>::int);
    let judge = FloatDomain(Mpfr::rounded(53, 0));
    assert_eq!(
        judge.difference(&two, &three).map(|(holds, share, _)| (holds, share)),
        Some((false, f64::INFINITY))
    );
    assert_eq!(judge.difference(&two, &two).map(|(holds, share, _)| (holds, share)), Some((true, 0.0)));
}

#[test]
fn one_failed_case_fails_a_claim_and_no_decided_case_leaves_it_undecided() {
    let row = |tally: Tally| {
        tally.into_row(ClaimKey { equation: "1.1", claim: "claim", kind: "equal", given: vec![] }, None)
    };
    let held = Tally { decided: 1, undecided: 5, ..Tally::default() };
    let failure = super::super::cases::case(1, 0, &[]).map(|case| (case, Some("why".to_string())));
    let failed = Tally { decided: 7, failure, ..Tally::default() };
    assert_eq!(row(Tally { undecided: 5, ..Tally::default() }).status, Status::Undecided);
    assert_eq!(row(held).status, Status::Held);
    let failed = row(failed);
    assert_eq!((failed.status, failed.reason.as_deref()), (Status::Failed, Some("why")));
    assert!(failed.counterexample.is_some());
}

#[test]
fn a_bound_is_formatted_without_loss() {
    let difference = perhaps_zero();
    assert!(*difference.radius() > 0.0);
    assert_eq!(FloatDomain(0.0).bound(&difference).parse(), Ok(*difference.radius()));
    assert_eq!(RationalDomain.bound(&Exact::from(3)), "3");
}

/// In one case, and in many: the first of equal ratios counts.
#[test]
fn the_worst_share_is_recorded() {
    let third = Ball::point(1.0) / Ball::point(3.0);
    let [less, more] = [1, 3].map(|ulps| Ball::point(1.0 / 3.0 + f64::from(ulps) * 2f64.powi(-54)));
    let values = [third, less, more, Ball::point(1.0)].map(Some);
    let judge = Checker::with(FloatDomain(0.0), &[], Vec::new());
    let measured = |asked: &[Test]| match judge.verdict(asked, &values) {
        Verdict::Decided { measured: Some((ratio, bound)), .. } => (ratio, bound()),
        _ => panic!("nothing is measured"),
    };
    let (small, large, none) = (Test::Equal(0, 1), Test::Equal(0, 2), Test::Equal(3, 3));
    assert!(measured(&[small]).0 < measured(&[large]).0);
    assert_eq!(measured(&[small, large]), measured(&[large]));
    assert_eq!(measured(&[large, small]), measured(&[large]));
    let own = Test::Equal(0, 0);
    let (of_own, of_none) = (measured(&[own]), measured(&[none]));
    assert_eq!((of_own.0, of_none.0), (0.0, 0.0));
    assert_ne!(of_own.1, of_none.1);
    assert_eq!((measured(&[own, none]), measured(&[none, own])), (of_own, of_none));

    let case = super::super::cases::case(1, 0, &[]).unwrap();
    let tally = |all: &[(f64, &'static str)]| {
        let mut tally = Tally::default();
        for (ratio, bound) in all.iter().copied() {
            let measured: (f64, Box<dyn Fn() -> String>) = (ratio, Box::new(move || bound.to_string()));
            tally.record(&case, Verdict::Decided { holds: true, measured: Some(measured) });
        }
        tally
    };
    let worst = |tally: Tally| tally.worst.map(|(_, bound)| bound);
    assert_eq!(worst(tally(&[(0.25, "a"), (0.5, "b"), (0.5, "c"), (0.25, "d")])), Some("b".to_string()));
    for (later, found) in [(0.25, "own"), (0.5, "own"), (0.75, "later")] {
        let mut own = tally(&[(0.5, "own")]);
        own.add(tally(&[(later, "later")]));
        assert_eq!(worst(own), Some(found.to_string()));
    }
}
