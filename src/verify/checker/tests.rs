//! What one case says of a claim.

use super::*;
use crate::formula::Relation;
use crate::number::Field;

/// What is made of some numbers, some of them perhaps undefined.
fn verdict<J: Judge>(judge: J, asked: &[Asked], values: Vec<Option<J::Number>>) -> Option<bool> {
    match Checker::with(judge, &[], Vec::new()).verdict(asked, &values) {
        Verdict::Undecided => None,
        Verdict::Decided { holds, .. } => Some(holds),
        Verdict::Broken(_) => Some(false),
    }
}

fn equal<J: Judge>(judge: J, left: J::Number, right: J::Number) -> Option<bool> {
    verdict(judge, &[Asked::Equal(0, 1)], vec![Some(left), Some(right)])
}

#[test]
fn a_wrong_equation_fails_by_one_part_in_2_to_the_50() {
    let (third, more) = (Ball::exactly(1.0) / Ball::exactly(3.0), Ball::exactly(1.0 / 3.0 + 2f64.powi(-52)));
    assert_eq!(equal(Floats(0.0), third.clone(), third.clone()), Some(true));
    assert_eq!(equal(Floats(0.0), third, more), Some(false));
    assert_eq!(equal(Exactly, 1.into(), 2.into()), Some(false));
}

/// A number whose sign is lost in rounding.
fn perhaps_zero() -> Ball<f64> {
    Ball::exactly(1.0) / Ball::exactly(3.0) * Ball::exactly(3.0) - Ball::exactly(1.0)
}

#[test]
fn a_sign_that_rounding_hides_is_open_and_a_wrong_one_is_wrong() {
    let sign = |x: Ball<f64>| verdict(Floats(0.0), &[Asked::Sign(Relation::Positive, 0)], vec![Some(x)]);
    let found = (sign(perhaps_zero()), sign(Ball::exactly(1.0)), sign(Ball::exactly(-1.0)));
    assert_eq!(found, (None, Some(true), Some(false)));
}

#[test]
fn what_fails_decides_against_what_is_open() {
    let values = || {
        [1.0, 2.0]
            .map(|x| Some(Ball::exactly(x)))
            .into_iter()
            .chain([Some(Ball::exactly(1.0) / perhaps_zero())])
    };
    let (open, wrong) = (Asked::Equal(0, 2), Asked::Equal(0, 1));
    assert_eq!(verdict(Floats(0.0), &[open], values().collect()), None);
    assert_eq!(verdict(Floats(0.0), &[open, wrong], values().collect()), Some(false));
    assert_eq!(verdict(Floats(0.0), &[wrong, open], values().collect()), Some(false));
}

#[test]
fn what_is_divided_by_zero_is_wrong_and_what_may_be_is_open() {
    let zero = Ball::exactly(1.0) - Ball::exactly(1.0);
    for (divisor, expected) in [(zero, Some(false)), (perhaps_zero(), None)] {
        let quotient = Floats::<f64>::step(Step::Div(&Ball::exactly(1.0), &divisor));
        let values = vec![Some(Ball::exactly(1.0)), quotient];
        for asked in [Asked::Equal(0, 1), Asked::Sign(Relation::Positive, 1)] {
            assert_eq!(verdict(Floats(0.0), &[asked], values.clone()), expected);
        }
    }
    assert_eq!(Exactly::step(Step::Div(&1.into(), &0.into())), None);
}

#[test]
fn a_bound_of_zero_has_no_room_for_an_error() {
    // Constants of MPFR are exact, and so is their difference.
    let [two, three] = [2, 3].map(Ball::<Mpfr>::int);
    let judge = Floats(Mpfr::rounded(53, 0));
    assert_eq!(
        judge.difference(&two, &three).map(|(holds, share, _)| (holds, share)),
        Some((false, f64::INFINITY))
    );
    assert_eq!(judge.difference(&two, &two).map(|(holds, share, _)| (holds, share)), Some((true, 0.0)));
}

#[test]
fn one_case_that_fails_decides_and_without_a_decided_case_nothing_is() {
    let row = |tally: Tally| {
        tally.into_row(Head { equation: "1.1", claim: "claim", kind: "equal", given: vec![] }, None)
    };
    let held = Tally { decided: 1, undecided: 5, ..Tally::default() };
    let failure = super::super::cases::case(1, 0, &[]).map(|case| (case, Some("why".to_string())));
    let failed = Tally { decided: 7, failure, ..Tally::default() };
    assert_eq!(row(Tally { undecided: 5, ..Tally::default() }).status, Status::Undecided);
    assert_eq!(row(held).status, Status::Held);
    let failed = row(failed);
    assert_eq!((failed.status, failed.why.as_deref()), (Status::Failed, Some("why")));
    assert!(failed.counterexample.is_some());
}

#[test]
fn a_bound_is_shown_as_it_is() {
    let difference = perhaps_zero();
    assert!(*difference.radius() > 0.0);
    assert_eq!(Floats(0.0).bound(&difference).parse(), Ok(*difference.radius()));
    assert_eq!(Exactly.bound(&Exact::from(3)), "3");
}

/// In one case, and in many: of equals the first.
#[test]
fn the_worst_share_is_measured() {
    let third = Ball::exactly(1.0) / Ball::exactly(3.0);
    let [less, more] = [1, 3].map(|ulps| Ball::exactly(1.0 / 3.0 + f64::from(ulps) * 2f64.powi(-54)));
    let values = [third, less, more, Ball::exactly(1.0)].map(Some);
    let judge = Checker::with(Floats(0.0), &[], Vec::new());
    let measured = |asked: &[Asked]| match judge.verdict(asked, &values) {
        Verdict::Decided { measured: Some((ratio, bound)), .. } => (ratio, bound()),
        _ => panic!("nothing is measured"),
    };
    let (small, large, none) = (Asked::Equal(0, 1), Asked::Equal(0, 2), Asked::Equal(3, 3));
    assert!(measured(&[small]).0 < measured(&[large]).0);
    assert_eq!(measured(&[small, large]), measured(&[large]));
    assert_eq!(measured(&[large, small]), measured(&[large]));
    let own = Asked::Equal(0, 0);
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
