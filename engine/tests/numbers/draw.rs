//! Random numbers for laws: floats of a format, fractions, rationals.

use super::format::{Format, magnitude};
use num_traits::Zero;
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, TestCaseResult, TestRunner};
use provable::number::{Exact, Field};
use rug::integer::Order;
use rug::{Integer, Rational};
use std::any::Any;
use std::cell::Cell;
use std::fmt::Debug;

/// Floats log-uniform over all exponents and dense around 1, with short, full and random mantissas; including
/// the smallest and the largest ones, subnormal numbers, powers of two and zero.
pub fn floats(format: Format) -> BoxedStrategy<Exact> {
    let Format { bits, least, greatest, .. } = format;
    let ones = (Integer::from(1) << bits) - 1u32;
    let short = 1..=ones.to_u32().unwrap_or(u32::MAX).min(15);
    let mantissa = prop_oneof![
        2 => Just(Integer::from(1)),
        1 => Just(ones),
        2 => short.prop_map(Integer::from),
        5 => any::<[u64; 4]>().prop_map(move |d| Integer::from_digits(&d, Order::Lsf).keep_bits(bits)),
    ];
    let one = -bits.cast_signed();
    let exponent = prop_oneof![
        4 => least..=greatest,
        4 => (one - 6).max(least)..=(one + 6).min(greatest),
        1 => Just(least),
        1 => Just(greatest),
    ];
    let signed = (any::<bool>(), mantissa, exponent).prop_map(|(negative, m, e)| {
        let x = Exact::from(Rational::from(m)) * Exact::power_of_two(e);
        if negative { -x } else { x }
    });
    prop_oneof![15 => signed, 1 => Just(Exact::zero())].boxed()
}

/// Two floats that interact in three cases of four: neighbours up to sign, whose sum cancels, or so different
/// that the smaller one just reaches the last digits of the larger.
pub fn pairs(format: Format) -> BoxedStrategy<(Exact, Exact)> {
    let reach = format.bits.cast_signed() + 3;
    (floats(format), floats(format), 0..4, -3..=3, -reach..=reach, any::<bool>())
        .prop_map(move |(a, b, relation, steps, shift, negate)| {
            let related = match relation {
                0 => b,
                1 => &a + Exact::int(steps) * format.unit(&a),
                _ if a.is_zero() || b.is_zero() => b,
                _ => &b * Exact::power_of_two(magnitude(&a) - magnitude(&b) + shift),
            };
            let b = format.fit(&related);
            (a, if negate { -b } else { b })
        })
        .boxed()
}

/// Fractions of small and of extreme integers with a nonzero denominator.
pub fn fractions() -> BoxedStrategy<(i32, i32)> {
    let whole = || prop_oneof![4 => -12..=12, 1 => Just(i32::MAX), 1 => Just(i32::MIN), 2 => any::<i32>()];
    (whole(), whole()).prop_map(|(p, q)| (p, if q == 0 { 1 } else { q })).boxed()
}

/// Rationals that are neither small nor dyadic, within and beyond the range of f32.
pub fn rationals() -> BoxedStrategy<Exact> {
    let dyadic = Format { least: -200, greatest: 140, ..Format::unbounded(64) };
    (floats(dyadic), fractions())
        .prop_map(|(x, (p, q))| if p == 0 { x } else { x * Exact::int(p) / Exact::int(q) })
        .boxed()
}

/// A value drawn by a strategy, with its type erased, so that the runner is compiled once for all laws.
trait Drawn: Any + Debug {}
impl<T: Any + Debug> Drawn for T {}

/// Tests a law on values of a strategy. A failure is shrunk, reported and stored beside this file.
pub fn for_all<S: Strategy<Value: 'static> + 'static>(strategy: S, law: impl Fn(S::Value) -> TestCaseResult) {
    let drawn = strategy.prop_map(|value| Box::new(value) as Box<dyn Drawn>).boxed();
    run(&drawn, &|drawn| {
        let value: Box<dyn Any> = drawn;
        law(*value.downcast().expect("what the strategy draws"))
    });
}

fn run(drawn: &BoxedStrategy<Box<dyn Drawn>>, law: &dyn Fn(Box<dyn Drawn>) -> TestCaseResult) {
    let remembered = Box::new(FileFailurePersistence::WithSource("regressions"));
    let config =
        Config { source_file: Some(file!()), failure_persistence: Some(remembered), ..Config::default() };
    if let Err(failure) = TestRunner::new(config).run(drawn, law) {
        panic!("{failure}");
    }
}

/// Counts events, so that a law cannot pass because it was never tested.
#[derive(Default)]
pub struct Tally {
    seen: Cell<u32>,
    of: Cell<u32>,
}

impl Tally {
    pub fn count(&self, seen: bool) -> bool {
        self.seen.set(self.seen.get() + u32::from(seen));
        self.of.set(self.of.get() + 1);
        seen
    }

    /// Asserts a share so much lower than the expected one that it is missed by chance less than once in 10⁵ runs.
    pub fn assert_one_in(&self, n: u32, what: &str) {
        let (seen, of) = (self.seen.get(), self.of.get());
        assert!(of > 0 && seen * n >= of, "{what}: {seen} of {of}");
    }
}
