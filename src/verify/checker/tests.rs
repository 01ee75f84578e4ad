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
