//! Laws of every number system, and of the ordered ones.

use super::ball::{BallBf16, BallF16, BallF32, BallF64, BallMpfr2, BallMpfr53};
use super::draw::{Tally, for_all};
use super::dual::{DualBallF32, DualBallF64, DualExact, DualF64};
use super::exact::Rationals;
use super::floats::{Binary16, Binary32, Binary64, Brain16, Native64};
use super::mpfr::{Mpfr2, Mpfr3, Mpfr24, Mpfr53, Mpfr200, MpfrConstant, MpfrMixed};
use super::system::{Oracle, System, operations};
use num_traits::Zero;
use proptest::prelude::*;
use provable::number::tree::Op;
use provable::number::{Exact, Field, OrderedField, PositivePart, ToExact};

/// Laws of + − × ÷.
macro_rules! laws_of_every_system {
    ($($law:ident)+) => {$(law! { $law:
        Binary16 Brain16 Binary32 Binary64 Native64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant Rationals
        BallF16 BallBf16 BallF32 BallF64 BallMpfr2 BallMpfr53 DualExact DualF64 DualBallF32 DualBallF64
    })+};
}
laws_of_every_system! {
    zero_one_and_signs_satisfy_the_field_identities
    small_integers_add_and_multiply
    owned_and_borrowed_operands_give_the_same_result
    assigned_results_do_not_depend_on_the_previous_number
}

// All but the duals of floats, whose derivative takes several roundings; the duals of balls bound it, and
// `dual_floats_are_the_centres_of_dual_balls`.
law! { operations_agree_with_exact_results:
    Binary16 Brain16 Binary32 Binary64 Native64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant Rationals
    BallF16 BallBf16 BallF32 BallF64 BallMpfr2 BallMpfr53 DualExact DualBallF32 DualBallF64
}

law! { exact_numbers_are_a_commutative_ring_with_inverses: Rationals MpfrConstant DualExact }

law! { positive_part_and_minimum_agree_with_exact_results:
    Binary16 Brain16 Binary32 Binary64 Native64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant
    BallF16 BallBf16 BallF32 BallF64 BallMpfr2 BallMpfr53
}

law! { the_order_agrees_with_exact_values:
    Binary16 Brain16 Binary32 Binary64 Native64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant
}

// Those of which the command and the proofs are told what they stand for.
law! { conversions_to_rationals_are_exact:
    Binary16 Brain16 Binary32 Binary64 Native64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant
}

/// Floats return the nearest float, ties to even, or infinity beyond the largest one. Balls contain the exact
/// result for all numbers in the operands. Exact numbers return the result.
fn operations_agree_with_exact_results<S: System<Number = N>, N: Field + 'static>() {
    let (tried, told_apart) = (Tally::default(), Tally::default());
    for_all(S::pair(), |((a, exact_a), (b, exact_b))| {
        prop_assert!(S::stands_for(&a, &exact_a), "{a:?} is drawn for {exact_a:?}");
        told_apart.count(!S::stands_for(&a, &exact_b));
        prop_assert!(S::stands_for(&-&a, &exact_a.negative()), "-{a:?}");
        for ((name, operation), exact) in operations().into_iter().zip(exact_a.results(&exact_b)) {
            tried.count(exact.is_some());
            if let Some(exact) = exact {
                let result = operation(&a, &b);
                prop_assert!(S::stands_for(&result, &exact), "{name} gives {result:?}, exactly {exact:?}");
            }
        }
        Ok(())
    });
    tried.assert_one_in(2, "operations tried");
    told_apart.assert_one_in(2, "pairs of which neither number stands for the other");
}

#[allow(clippy::eq_op)]
fn zero_one_and_signs_satisfy_the_field_identities<S: System<Number = N>, N: Field + 'static>() {
    let (zero, one) = (N::zero(), N::one());
    assert!(zero.is_zero() && !zero.is_invertible() && !one.is_zero() && one.is_invertible());
    let divided = Tally::default();
    for_all(S::pair(), |((a, _), (b, _))| {
        let mut equations = vec![
            ("a + 0 = a", &a + &zero, a.clone()),
            ("0 + a = a", &zero + &a, a.clone()),
            ("a - 0 = a", &a - &zero, a.clone()),
            ("0 - a = -a", &zero - &a, -&a),
            ("a - a = 0", &a - &a, zero.clone()),
            ("1 a = a", &one * &a, a.clone()),
            ("a 1 = a", &a * &one, a.clone()),
            ("a 0 = 0", &a * &zero, zero.clone()),
            ("0 a = 0", &zero * &a, zero.clone()),
            ("a / 1 = a", &a / &one, a.clone()),
            ("-(-a) = a", -(-&a), a.clone()),
            ("a + b = b + a", &a + &b, &b + &a),
            ("a b = b a", &a * &b, &b * &a),
            ("a - b = a + (-b)", &a - &b, &a + -&b),
            ("a - b = -(b - a)", &a - &b, -(&b - &a)),
            ("(-a) b = -(a b)", -&a * &b, -(&a * &b)),
        ];
        if divided.count(a.is_invertible()) {
            equations.extend([
                ("a / a = 1", &a / &a, one.clone()),
                ("0 / a = 0", &zero / &a, zero.clone()),
                ("b / (-a) = -(b / a)", &b / -&a, -(&b / &a)),
                ("(-b) / a = -(b / a)", -&b / &a, -(&b / &a)),
            ]);
        }
        for (equation, left, right) in equations {
            prop_assert!(S::same(&left, &right), "{equation}: {left:?}, {right:?}");
        }
        Ok(())
    });
    divided.assert_one_in(3, "divisors");
}

/// Of 12 bits each, so that products fit into f32, or up to 2⁸, as [`Field::int`] requires, if the nearest number to
/// 2¹² − 1 is 2¹². Results are then the nearest numbers.
fn small_integers_add_and_multiply<S: System<Number = N>, N: Field + 'static>() {
    let largest = if S::same(&N::int(4095), &N::int(4096)) { 256 } else { 4095 };
    let small = || prop_oneof![-10..=10, -largest..=largest];
    for_all((small(), small()), |(m, n)| {
        let (a, b) = (N::int(m), N::int(n));
        prop_assert!(S::same(&(&a + &b), &N::int(m + n)), "int({m}) + int({n}): small integers are exact");
        prop_assert!(S::same(&(&a - &b), &N::int(m - n)), "int({m}) - int({n}): small integers are exact");
        prop_assert!(S::same(&(&a * &b), &N::int(m * n)), "int({m}) * int({n}): small integers are exact");
        prop_assert_eq!(a == b, m == n);
        prop_assert_eq!(a.is_zero(), m == 0);
        prop_assert_eq!(a.is_invertible(), m != 0);
        Ok(())
    });
}

/// Equal in all bits and in precision, as the debug format shows.
fn owned_and_borrowed_operands_give_the_same_result<S: System<Number = N>, N: Field + 'static>() {
    let bits = |x: N| format!("{x:?}");
    let divided = Tally::default();
    for_all(S::pair(), |((a, _), (b, _))| {
        let own = || (a.clone(), b.clone());
        prop_assert_eq!(bits(-a.clone()), bits(-&a));
        macro_rules! forms {
            ($op:tt) => {
                let expected = bits(&a $op &b);
                prop_assert_eq!(bits(own().0 $op &b), expected.clone());
                prop_assert_eq!(bits(&a $op own().1), expected.clone());
                prop_assert_eq!(bits(own().0 $op own().1), expected);
            };
        }
        forms!(+);
        forms!(-);
        forms!(*);
        if divided.count(b.is_invertible()) {
            forms!(/);
        }
        Ok(())
    });
    divided.assert_one_in(3, "divisors");
}

/// Equal in all bits and in precision, for any previous value.
fn assigned_results_do_not_depend_on_the_previous_number<S: System<Number = N>, N: Field + 'static>() {
    let bits = |x: &N| format!("{x:?}");
    let divided = Tally::default();
    for_all((S::pair(), S::number()), |(((a, _), (b, _)), (there, _))| {
        let divides = divided.count(b.is_invertible());
        let steps = [
            (Op::Int(-7), N::int(-7)),
            (Op::Neg(&a), -&a),
            (Op::Add(&a, &b), &a + &b),
            (Op::Sub(&a, &b), &a - &b),
            (Op::Mul(&a, &b), &a * &b),
        ];
        let quotient = divides.then(|| (Op::Div(&a, &b), &a / &b));
        for (step, expected) in steps.into_iter().chain(quotient) {
            let mut result = there.clone();
            prop_assert!(result.assign_op(step));
            prop_assert_eq!(bits(&result), bits(&expected), "{:?}", step);
        }
        for step in [Op::Symbol("a"), Op::Exp(&a), Op::PositivePart(&a), Op::Min(&a, &b)] {
            let mut result = there.clone();
            prop_assert!(!result.assign_op(step));
            prop_assert_eq!(bits(&result), bits(&there), "{:?}", step);
        }
        Ok(())
    });
    divided.assert_one_in(3, "divisors");
}

fn exact_numbers_are_a_commutative_ring_with_inverses<S: System<Number = N>, N: Field + 'static>() {
    let inverted = Tally::default();
    for_all((S::pair(), S::number()), |(((a, _), (b, _)), (c, _))| {
        prop_assert_eq!((&a + &b) + &c, &a + (&b + &c));
        prop_assert_eq!((&a * &b) * &c, &a * (&b * &c));
        prop_assert_eq!(&a * (&b + &c), &a * &b + &a * &c);
        prop_assert_eq!((&a - &b) * &c, &a * &c - &b * &c);
        prop_assert_eq!(&a + &b, &b + &a);
        prop_assert_eq!(&a * &b, &b * &a);
        prop_assert_eq!(&a + -&a, N::zero());
        if inverted.count(c.is_invertible()) {
            prop_assert_eq!(&c * (N::one() / &c), N::one());
            prop_assert_eq!(&a / &c * &c, a.clone());
            prop_assert_eq!((&a + &b) / &c, &a / &c + &b / &c);
        }
        Ok(())
    });
    inverted.assert_one_in(3, "divisors");
}

fn positive_part_and_minimum_agree_with_exact_results<S, N>()
where
    S: System<Number = N, Meaning = Exact>,
    N: PositivePart + 'static,
{
    for_all(S::pair(), |((a, exact_a), (b, exact_b))| {
        let (part, least) = (a.positive_part(), a.min(&b));
        let exact_part = if exact_a > Exact::zero() { exact_a.clone() } else { Exact::zero() };
        let exact_least = if exact_a < exact_b { exact_a } else { exact_b };
        prop_assert!(holds_exactly::<S, N>(&part, &exact_part), "positive part {part:?} of {exact_part:?}");
        prop_assert!(
            holds_exactly::<S, N>(&least, &exact_least),
            "minimum {least:?}, exactly {exact_least:?}"
        );
        Ok(())
    });
}

/// ⟨·⟩ and min select a number without rounding, so a zero without a precision may result.
fn holds_exactly<S: System<Number = N, Meaning = Exact>, N: Field>(result: &N, exact: &Exact) -> bool {
    S::stands_for(result, exact) || (exact.is_zero() && *result == N::zero())
}

fn the_order_agrees_with_exact_values<S, N>()
where
    S: System<Number = N, Meaning = Exact>,
    N: OrderedField + 'static,
{
    for_all(S::pair(), |((a, exact_a), (b, exact_b))| {
        prop_assert_eq!(a.partial_cmp(&b), Some(exact_a.cmp(&exact_b)));
        prop_assert_eq!(a == b, exact_a == exact_b);
        prop_assert_eq!(a.is_zero(), exact_a.is_zero());
        let absolute = if exact_a < Exact::zero() { -&exact_a } else { exact_a };
        prop_assert!(holds_exactly::<S, N>(&a.abs(), &absolute), "|{a:?}| is {:?}", a.abs());
        prop_assert_eq!(a.min(&b), b.min(&a));
        prop_assert_eq!(a.positive_part() - (-&a).positive_part(), a);
        Ok(())
    });
}

fn conversions_to_rationals_are_exact<S, N>()
where
    S: System<Number = N, Meaning = Exact>,
    N: Field + ToExact + 'static,
{
    for_all(S::number(), |(a, exact)| {
        prop_assert_eq!(a.to_exact(), Ok(exact));
        Ok(())
    });
}
