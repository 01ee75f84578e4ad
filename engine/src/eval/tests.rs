//! Tests of the domains.

use super::*;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Hypothesis, Relation};
use crate::number::{Ball, Exact, Exponential, Mpfr, Program, ToExact, Tree};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::collections::BTreeSet;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn int(n: i32) -> Tree {
    Tree::from(n)
}

/// Returns the value of a formula; `None` if it is undefined.
fn value<D: Domain>(
    formula: &Tree,
    domain: &D,
    symbol: impl Fn(&'static str) -> D::Value,
) -> Option<D::Value> {
    let mut program = Program::default();
    let place = program.add(formula);
    Evaluation::of(&program, domain, symbol).at(place).cloned()
}

/// Rationals with roundings to 3 bits.
fn rationals() -> Rationals {
    Rationals { precision: Exact::from(8) }
}

/// Returns the value of a formula in which x is the integer.
fn rational(n: i32, formula: &Tree) -> Option<Value> {
    value(formula, &rationals(), |_| Value::Exact(Exact::from(n)))
}

#[test]
fn values_are_exact_unless_they_depend_on_an_exponential() {
    let sign = |n: i32, formula: &Tree| rational(n, formula).expect("defined").sign();
    let e = x("x").exp();
    assert_eq!(rational(0, &e), Some(Value::Exact(Exact::one())));
    assert_eq!(sign(1, &(&e - int(2))), Some(Ordering::Greater));
    // The sign of e e⁻¹ − 1 is undecided, and so is that of a quotient by it.
    let zero = &e * (-x("x")).exp() - int(1);
    assert_eq!((sign(1, &zero), sign(1, &(int(1) / &zero))), (None, None));
    assert_eq!(sign(1, &(&e * int(0))), Some(Ordering::Equal));
    assert_eq!(rational(1, &(int(1) / (&e * int(0)))), None);
    assert_eq!(sign(10_000, &e), None);
    // So is the sign of a number outside the range of f64.
    let huge = (0..2000).fold(int(1), |x, _| x * int(2));
    assert_eq!(sign(1, &(&e * huge)), None);
    assert_eq!(rational(0, &(int(1) / x("x"))), None);
}

/// 9/8 is rounded to 1 with 3 bits, and e to one of two numbers.
#[test]
fn only_exact_values_are_rounded() {
    let eighths = (int(9) / int(8)).round();
    assert_eq!(rational(0, &eighths), Some(Value::Exact(Exact::one())));
    let unknown = rational(1, &x("x").exp().round()).unwrap();
    assert_eq!(unknown.sign(), None);
    assert_eq!(unknown.is_within(&Value::Exact(Exact::one())), None);
    let imprecise = Rationals { precision: Exact::from(2) };
    let none = value(&eighths, &imprecise, |_| unreachable!()).unwrap();
    assert_eq!(none.sign(), None);
    for precision in ["12", "16/3"] {
        assert_eq!(Rationals { precision: precision.parse().unwrap() }.round(&Exact::one()), None);
    }
}

/// A power of two by which a system is scaled is drawn as one, and no other number is admitted.
#[test]
fn scales_are_powers_of_two() {
    let scale = SCALES[0];
    let draw = |i: u64| first_integer_points(i, &[], &[scale]).last().map(|point| point.at(scale));
    let drawn: BTreeSet<_> = (1..200).filter_map(draw).collect();
    assert!(drawn.into_iter().eq((-4..=4).map(Exact::power_of_two)));
    let is_admitted = |x: &str| Point::new([(scale, x.parse().unwrap())]).satisfies(&[]);
    assert_eq!(["1/4", "4", "3/4", "4/3"].map(is_admitted), [true, true, false, false]);
}

/// A negative number is replaced by 0 at every third point, and by another one in between.
#[test]
fn a_quantity_that_may_be_zero_is_zero_at_every_third_point() {
    let given = [Hypothesis::new(Relation::NonNegative, x("a"))];
    let points = constructed_points(&given, &["a"]);
    let zeros: Vec<_> = points.enumerate().filter(|(_, point)| point.at("a").is_zero()).collect();
    assert!(!zeros.is_empty() && zeros.iter().all(|(i, _)| i % 3 == 0), "{zeros:?}");
}

/// The quotient by a ball around 0 is unbounded; that by 0 is undefined.
#[test]
fn balls_are_equal_unless_they_are_certainly_different() {
    let balls = Balls(0f64);
    let third =
        |formula: &Tree| value(formula, &balls, |_| Ball::enclosing(&0.0, &"1/3".parse().unwrap()).unwrap());
    let zero = x("x") * int(3) - int(1);
    let nought = Ball::zero();
    let equal = |formula: &Tree| third(formula).unwrap().is_equal(&nought);
    assert_eq!((third(&zero).unwrap().sign(), equal(&zero)), (None, Some(true)));
    assert_eq!((equal(&(&zero + int(1))), equal(&(int(1) / &zero))), (Some(false), None));
    let within = |formula: &Tree| third(formula).unwrap().is_within(&Ball::one());
    assert_eq!([&zero, &(x("x") * int(6)), &(int(1) + &zero)].map(within), [Some(true), Some(false), None]);
    assert!(third(&(int(1) / int(0))).is_none());
}

/// Returns the float that is computed for a formula, where the symbols are two numbers.
fn computed(formula: &Tree, a: f64, b: f64) -> Option<f64> {
    let floats = Floats::coarsest([&a, &b]).unwrap();
    value(formula, &floats, |name| Some(if name == "a" { a } else { b })).expect("never undefined")
}

#[test]
fn underflow_and_overflow_yield_no_value() {
    let [a, b] = ["a", "b"].map(x);
    let (product, quotient, least) = (&a * &b, &a / &b, f64::from_bits(1) * 2f64.powi(53));
    assert_eq!([computed(&product, least, 1.0), computed(&quotient, least, 1.0)], [Some(least); 2]);
    assert_eq!([computed(&product, least, 0.5), computed(&quotient, least, 2.0)], [None, None]);
    assert_eq!([computed(&product, 1e300, 1e300), computed(&quotient, 1e300, 1e-300)], [None, None]);
    assert_eq!(computed(&quotient, 1.0, 0.0), None);
    // A product with 0 is not an underflow, and neither is a difference.
    assert_eq!([computed(&product, 0.0, least), computed(&quotient, 0.0, least)], [Some(0.0); 2]);
    assert_eq!(computed(&(&a - &b), least, least / 2.0), Some(least / 2.0));
}

/// 1 + 2⁻⁵³ is rounded to 1; what is not below a rounding stays exact.
#[test]
fn floats_compute_what_is_below_a_rounding() {
    let sum = x("a") + x("b");
    let tiny = 2f64.powi(-53);
    let floats = Floats::coarsest([&tiny]).unwrap();
    let number = |name| Some(if name == "a" { 1.0 } else { tiny });
    let symbol = |name| match name {
        PRECISION => Value::Exact(floats.precision().clone()),
        name => Value::Exact(number(name).unwrap().to_exact().unwrap()),
    };
    let exact = |formula: &Tree| {
        let mut program = Program::default();
        let place = program.add(formula);
        let computed = RoundedRationals(Evaluation::of(&program, &floats, number));
        let evaluation = Evaluation::of(&program, &computed, symbol);
        evaluation.at(place).expect("never undefined").exact().cloned()
    };
    let lost = exact(&(sum.with_rounding() - &sum)).unwrap();
    assert_eq!(lost, -Exact::power_of_two(-53));
    assert_eq!(exact(&(x(PRECISION) * x("b"))), Some(Exact::one()));
    assert_eq!(exact(&(&sum / (x("a") - x("a")))), None);
    assert_eq!(exact(&(x("b") * x("b") * int(0))), Some(Exact::zero()));
    let underflows = (0..30).fold(x("b"), |product, _| (product * x("b")).round());
    assert_eq!(exact(&underflows), None);
}

#[test]
fn the_coarsest_number_determines_the_precision() {
    let numbers = [53, 24, 113].map(|bits| Mpfr::rounded(bits, 1));
    assert_eq!(*Floats::coarsest(&numbers).unwrap().precision(), Exact::power_of_two(24));
    assert!(Floats::<f64>::coarsest([]).is_none());
}

/// Without sharing, the time doubles with each doubling.
#[test]
fn shared_formulas_are_evaluated_once() {
    let doubled = (0..100).fold(x("a"), |sum, _| &sum + &sum);
    let mut program = Program::default();
    let place = program.add(&doubled);
    assert_eq!((program.len(), program.formula(place).size()), (101, u32::MAX));
    assert_eq!(program.formula(1).to_string(), "a + a");
    assert_eq!(doubled.eval(&|_| 1.0, &|_| None), Some(2f64.powi(100)));
}
