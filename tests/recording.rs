//! A record equals its function: in every number system the compiled function, its evaluated record, and runs
//! of its program return the same bits. Everything based on records relies on this.

use crate::strategies::*;
use num_traits::One;
use spring_mass_contact::claims::{computed, registry};
use spring_mass_contact::eval::{Domain, Evaluation};
use spring_mass_contact::number::tree::{Op, all_ops};
use spring_mass_contact::number::{Ball, Dual, Exponential, Field, Program, Tree};
use spring_mass_contact::operators;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;
use std::marker::PhantomData;

/// A number system with substitutes for missing operations; both sides only need to use the same.
#[derive(Clone, Debug, PartialEq)]
struct Filled<T>(T);

operators! { [T: Field] Filled<T>;
    Add add |a, b| Filled(&a.0 + &b.0);
    Sub sub |a, b| Filled(&a.0 - &b.0);
    Mul mul |a, b| Filled(&a.0 * &b.0);
    // Rationals have no quotient by 0, and 7 is as good as any.
    Div div |a, b| if b.0.is_invertible() { Filled(&a.0 / &b.0) } else { Filled(T::int(7)) };
    - |a| Filled(-&a.0)
}
impl<T: Field> Zero for Filled<T> {
    fn zero() -> Self {
        Filled(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
impl<T: Field> One for Filled<T> {
    fn one() -> Self {
        Filled(T::one())
    }
}
impl<T: Field> Field for Filled<T> {
    fn int(n: i32) -> Self {
        Filled(T::int(n))
    }
}
impl<T: Field> Exponential for Filled<T> {
    fn exp(&self) -> Self {
        Filled(T::one() + &self.0)
    }
}
impl<T: Field> PositivePart for Filled<T> {
    fn positive_part(&self) -> Self {
        Filled(&self.0 * &self.0)
    }
    fn min(&self, other: &Self) -> Self {
        Filled(T::int(3) * &self.0 - &other.0)
    }
}

/// The operations of a number system themselves.
struct Own<T>(PhantomData<T>);

impl<T: PositivePart + Exponential> Domain for Own<T> {
    type Value = T;

    fn apply(&self, op: Op<&T>) -> Option<T> {
        op.arithmetic().or_else(|| all_ops(op))
    }
}

/// Compares every formula as a function, as a record, in a program of all of them, and in runs in which the
/// symbols of `varying` change; `bits` distinguishes all numbers.
fn law<T: PositivePart + Exponential, B: PartialEq + Debug>(
    varying: &BTreeSet<&'static str>,
    symbol: &impl Fn(&'static str) -> T,
    bits: impl Fn(&T) -> B,
) {
    let mut program = Program::default();
    let places: Vec<_> = registry().formulas().iter().map(|formula| program.add(&formula.tree)).collect();
    let fixed = |name| (!varying.contains(name)).then(|| symbol(name));
    let mut rounds = program.specialize(&fixed, &all_ops).expect("everything is known");
    // First with each other's numbers, which leave behind what was made of them.
    for shift in [1, 0] {
        for (name, other) in varying.iter().zip(varying.iter().cycle().skip(shift)) {
            rounds.replace(program.add(&Tree::symbol(name)), symbol(other));
        }
        rounds.run(&all_ops).expect("everything is known");
    }
    let (domain, by_function) = (Own(PhantomData), computed(symbol));
    let values = Evaluation::of(&program, &domain, symbol);
    assert_eq!(by_function.len(), registry().formulas().len());
    for ((formula, place), expected) in registry().formulas().iter().zip(places).zip(&by_function) {
        let (expected, name) = (bits(expected), formula.name());
        assert_eq!(values.at(place).map(&bits).as_ref(), Some(&expected), "{name} as a program");
        assert_eq!(bits(&rounds[place]), expected, "{name} in rounds of {varying:?}");
        // A record that divides by 0 replays to nothing.
        if let Some(by_record) = formula.tree.eval(symbol, &all_ops) {
            assert_eq!(bits(&by_record), expected, "{name}");
        }
    }
}

/// Returns all symbols in formulas.
fn symbols() -> Vec<&'static str> {
    let all: BTreeSet<_> = registry().formulas().iter().flat_map(|f| f.tree.symbols()).collect();
    all.into_iter().collect()
}

/// Draws a number for each symbol.
fn numbers<T: Debug + Clone + 'static>(
    one: impl Strategy<Value = T> + 'static,
) -> BoxedStrategy<BTreeMap<&'static str, T>> {
    let names = symbols();
    prop::collection::vec(one, names.len())
        .prop_map(move |values| names.iter().copied().zip(values).collect())
        .boxed()
}

/// Draws some of the symbols: none, all, or any.
fn some_symbols() -> BoxedStrategy<BTreeSet<&'static str>> {
    let names = symbols();
    let any = prop::collection::vec(any::<bool>(), names.len());
    prop_oneof![1 => Just(vec![false; names.len()]), 1 => Just(vec![true; names.len()]), 8 => any]
        .prop_map(move |varies| {
            names.iter().zip(varies).filter(|(_, varies)| *varies).map(|(name, _)| *name).collect()
        })
        .boxed()
}

/// The sign and payload of a NaN depend on the machine.
fn bits(x: &f64) -> u64 {
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

/// Draws from bits, with all special values: signed zeros, subnormal numbers, infinities; and small integers,
/// which cancel.
fn doubles() -> impl Strategy<Value = f64> {
    prop_oneof![any::<u64>().prop_map(f64::from_bits), (-3..=3i8).prop_map(f64::from), -1e3..1e3]
}

fn singles() -> impl Strategy<Value = f32> {
    prop_oneof![any::<u32>().prop_map(f32::from_bits), (-3..=3i8).prop_map(f32::from), -1e3f32..1e3]
}

fn finite() -> impl Strategy<Value = f64> {
    prop_oneof![(-3..=3i8).prop_map(f64::from), -1e3..1e3, Just(-0.0), Just(1e-300), Just(5e-324)]
}

/// For NaN only the precision is compared.
fn mpfr_bits(x: &Mpfr) -> (Option<u32>, Option<bool>, Option<rug::Rational>) {
    let sign = x.as_float().filter(|x| !x.is_nan()).map(rug::Float::is_sign_negative);
    (x.precision(), sign, x.to_rational())
}

fn rationals() -> impl Strategy<Value = Exact> {
    (-9..=9i32, 1..=4i32).prop_map(|(n, d)| Exact::from(n) / Exact::from(d))
}

#[test]
fn records_agree_in_f32() {
    holds((numbers(singles()), some_symbols()), |(at, varying)| {
        law(varying, &|name| at[name], |x| bits(&f64::from(*x)));
    });
}

#[test]
fn records_agree_in_f64() {
    holds((numbers(doubles()), some_symbols()), |(at, varying)| {
        law(varying, &|name| at[name], bits);
    });
}

#[test]
fn records_agree_in_mpfr() {
    holds((numbers((finite(), 2u32..200)), some_symbols()), |(at, varying)| {
        let number = |name: &'static str| Mpfr::rounded(at[name].1, at[name].0);
        law(varying, &number, mpfr_bits);
    });
}

#[test]
fn records_agree_in_rationals() {
    holds((numbers(rationals()), some_symbols()), |(at, varying)| {
        law(varying, &|name| Filled(at[name].clone()), Clone::clone);
    });
}

#[test]
fn records_agree_in_balls() {
    holds((numbers((finite(), any::<bool>())), some_symbols()), |(at, varying)| {
        let ball = |name: &'static str| match at[name] {
            (x, true) => Ball::point(x),
            (x, false) => Ball::from_rounded(x),
        };
        law(varying, &ball, |x| (bits(x.value()), bits(x.radius())));
    });
}

#[test]
fn records_agree_in_balls_of_mpfr() {
    holds((numbers((finite(), 2u32..200)), some_symbols()), |(at, varying)| {
        let ball = |name: &'static str| Ball::from_rounded(Mpfr::rounded(at[name].1, at[name].0));
        law(varying, &ball, |x| (format!("{x:?}"), x.value().precision(), x.radius().precision()));
    });
}

#[test]
fn records_agree_in_duals() {
    holds((numbers((finite(), finite())), some_symbols()), |(at, varying)| {
        let dual = |name: &'static str| Filled(Dual { value: at[name].0, derivative: at[name].1 });
        law(varying, &dual, |x| (bits(&x.0.value), bits(&x.0.derivative)));
    });
}

#[test]
fn records_agree_in_duals_of_rationals() {
    holds((numbers((rationals(), rationals())), some_symbols()), |(at, varying)| {
        let dual = |name: &'static str| {
            let (value, derivative) = at[name].clone();
            Filled(Dual { value, derivative })
        };
        law(varying, &dual, Clone::clone);
    });
}
