//! The same laws for every number system, against rationals.
//!
//! A [`System`] draws numbers together with the exact number each one stands for: a float stands for its
//! own value, a ball for any number inside it. A law is one generic function; the lists in the middle of
//! this file say which systems it is run for, and the rest shows what only some of them have: spellings,
//! derivatives, and the 3-bit floats, of which all pairs are tried.
//!
//! Rounding is judged by [`Format::round`], which is written here from the definition, in integers; of what
//! it judges it uses only the rationals, and those are judged by [`Fraction`], integers again.
#![cfg(feature = "mpfr")]

use num_traits::{One, Zero};
use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, TestCaseResult, TestRunner};
use rug::float::Round;
use rug::integer::Order;
use rug::{Float, Integer, Rational};
use spring_mass_contact::chapter::{SpringMass, augmented, penalty, structure, system};
use spring_mass_contact::number::{
    Ball, Dual, Exact, Exponential, Field, Inexact, Logarithm, MAX_EXPONENT, Mpfr, OrderedField, PRECISIONS,
    ParseError, PositivePart, RangeError, Real, ToExact,
};
use std::cell::Cell;
use std::cmp::Ordering;
use std::fmt::{Debug, Display};
use std::marker::PhantomData;

// ------------------------------------------------------------------------------------------------
// Rounding, in integers
// ------------------------------------------------------------------------------------------------

/// Binary floats m·2ᵉ with |m| < 2^bits.
#[derive(Clone, Copy, Debug)]
struct Format {
    bits: u32,
    /// The exponents e that numbers are drawn with.
    least: i32,
    greatest: i32,
    /// Are those all there are, as in f32 and f64, or does the format go on without end?
    bounded: bool,
}

const SINGLE: Format = Format { bits: 24, least: -149, greatest: 104, bounded: true };
const DOUBLE: Format = Format { bits: 53, least: -1074, greatest: 971, bounded: true };

impl Format {
    const fn unbounded(bits: u32) -> Self {
        Format { bits, least: -300, greatest: 300, bounded: false }
    }

    /// The same format, drawn only with 2^low ≤ |x| < 2^high.
    fn within(self, low: i32, high: i32) -> Self {
        let bits = self.bits.cast_signed();
        Format { least: self.least.max(low - bits), greatest: self.greatest.min(high - bits), ..self }
    }

    /// The distance of two neighbours at `x`.
    fn unit(&self, x: &Exact) -> Exact {
        let lowest = if self.bounded { self.least } else { i32::MIN };
        let exponent = if x.is_zero() { self.least } else { magnitude(x) - self.bits.cast_signed() + 1 };
        Exact::power_of_two(exponent.max(lowest))
    }

    /// The nearest float, ties to the even mantissa, as if there were no largest one.
    fn round(&self, x: &Exact) -> Exact {
        if x.is_zero() {
            return Exact::zero();
        }
        let unit = self.unit(x);
        let scaled = Rational::from(x / &unit);
        let floor = Integer::from(scaled.floor_ref());
        let above_half = (scaled - &floor).cmp(&Rational::from((1, 2)));
        let up = above_half.is_gt() || (above_half.is_eq() && floor.is_odd());
        Exact::from(Rational::from(floor + i32::from(up))) * unit
    }

    fn largest(&self) -> Exact {
        Exact::from(Rational::from((Integer::from(1) << self.bits) - 1u32))
            * Exact::power_of_two(self.greatest)
    }

    /// The nearest float that is not infinite.
    fn fit(&self, x: &Exact) -> Exact {
        self.round(x).clamp(-self.largest(), self.largest())
    }
}

/// The e with 2ᵉ ≤ |x| < 2ᵉ⁺¹; x ≠ 0.
fn magnitude(x: &Exact) -> i32 {
    let q = x.as_rational();
    let e = q.numer().significant_bits().cast_signed() - q.denom().significant_bits().cast_signed();
    if x.abs() < Exact::power_of_two(e) { e - 1 } else { e }
}

// ------------------------------------------------------------------------------------------------
// Strategies
// ------------------------------------------------------------------------------------------------

/// Floats log-uniform over all exponents and dense around 1, with short, full and random mantissas; the
/// smallest and the largest ones, subnormals, powers of two and zero among them.
fn floats(format: Format) -> BoxedStrategy<Exact> {
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

/// Two floats that have to do with each other in three cases of four: neighbours up to sign, whose sum
/// cancels; or so far apart that the smaller one just reaches the last digits of the larger.
fn pairs(format: Format) -> BoxedStrategy<(Exact, Exact)> {
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

/// Fractions of small and of extreme integers, never 0 below the line.
fn fractions() -> BoxedStrategy<(i32, i32)> {
    let whole = || prop_oneof![4 => -12..=12, 1 => Just(i32::MAX), 1 => Just(i32::MIN), 2 => any::<i32>()];
    (whole(), whole()).prop_map(|(p, q)| (p, if q == 0 { 1 } else { q })).boxed()
}

/// Rationals that are neither small nor dyadic, on either side of what f32 can hold.
fn rationals() -> BoxedStrategy<Exact> {
    let dyadic = Format { least: -200, greatest: 140, ..Format::unbounded(64) };
    (floats(dyadic), fractions())
        .prop_map(|(x, (p, q))| if p == 0 { x } else { x * Exact::int(p) / Exact::int(q) })
        .boxed()
}

/// Runs a law on what the strategy draws. A failure is shrunk, reported and remembered beside this file.
fn for_all<S: Strategy>(strategy: S, law: impl Fn(S::Value) -> TestCaseResult) {
    let remembered = Box::new(FileFailurePersistence::WithSource("regressions"));
    let config =
        Config { source_file: Some(file!()), failure_persistence: Some(remembered), ..Config::default() };
    if let Err(failure) = TestRunner::new(config).run(&strategy, law) {
        panic!("{failure}");
    }
}

/// Counts how often something was seen, so that a law cannot hold because it was never tried.
#[derive(Default)]
struct Tally {
    seen: Cell<u32>,
    of: Cell<u32>,
}

impl Tally {
    fn count(&self, seen: bool) -> bool {
        self.seen.set(self.seen.get() + u32::from(seen));
        self.of.set(self.of.get() + 1);
        seen
    }

    fn assert_one_in(&self, n: u32, what: &str) {
        let (seen, of) = (self.seen.get(), self.of.get());
        assert!(of > 0 && seen * n >= of, "{what}: {seen} of {of}");
    }
}

// ------------------------------------------------------------------------------------------------
// The number systems
// ------------------------------------------------------------------------------------------------

/// A number system as the laws see it.
trait System: 'static {
    type Number: Clone + Debug + PartialEq + 'static;
    /// What a number stands for: a rational, or a rational and its derivative.
    type Meaning: Oracle;

    fn number() -> BoxedStrategy<Planted<Self>> {
        Self::pair().prop_map(|(a, _)| a).boxed()
    }
    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)>;
    /// Is `result` what one operation has to return whose exact result is `exact`?
    fn stands_for(result: &Self::Number, exact: &Self::Meaning) -> bool;
    /// Are these the same number, as far as the system can tell?
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        #[allow(clippy::eq_op)]
        let (a_is_nan, b_is_nan) = (a != a, b != b);
        a == b || (a_is_nan && b_is_nan)
    }
}

/// The exact results of the operations: any field can be asked for them.
///
/// It stands between a system and its field since the operators on references come along with a bound
/// `T: Field` only where T is a type parameter, not with a bound on an associated type. For the same reason
/// the laws name the numbers of their system N.
trait Oracle: Clone + Debug + 'static {
    fn negative(&self) -> Self;
    /// `None` for a quotient that does not exist.
    fn results(&self, other: &Self) -> [Option<Self>; 4];
}
impl<T: Field + 'static> Oracle for T {
    fn negative(&self) -> Self {
        -self
    }
    fn results(&self, other: &Self) -> [Option<Self>; 4] {
        operations().map(|(name, f)| (name != "/" || other.is_unit()).then(|| f(self, other)))
    }
}

/// A number and one of the exact numbers that it stands for.
type Planted<S> = (<S as System>::Number, <S as System>::Meaning);

/// The systems whose every operation rounds to nearest.
trait Floats: System<Meaning = Exact> {
    const FORMAT: Format;
    /// `x`, which this format can hold.
    fn float(x: &Exact) -> Self::Number;
}

fn planted<S: Floats>((a, b): (Exact, Exact)) -> (Planted<S>, Planted<S>) {
    ((S::float(&a), a), (S::float(&b), b))
}

macro_rules! machine_floats {
    ($($Name:ident $float:ident $format:ident $convert:ident;)*) => {$(
        struct $Name;

        impl System for $Name {
            type Number = $float;
            type Meaning = Exact;

            fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
                pairs($format).prop_map(planted::<Self>).boxed()
            }
            fn stands_for(result: &$float, exact: &Exact) -> bool {
                let nearest = $format.round(exact);
                if nearest.abs() > $format.largest() {
                    *result == $float::INFINITY.copysign(if nearest > Exact::zero() { 1.0 } else { -1.0 })
                } else {
                    result.to_exact() == Ok(nearest)
                }
            }
        }
        impl Floats for $Name {
            const FORMAT: Format = $format;

            fn float(x: &Exact) -> $float {
                x.as_rational().$convert()
            }
        }
    )*};
}
machine_floats! {
    Binary32 f32 SINGLE to_f32;
    Binary64 f64 DOUBLE to_f64;
}

/// MPFR numbers of one precision.
struct Bits<const BITS: u32>;
type Mpfr2 = Bits<2>;
type Mpfr3 = Bits<3>;
type Mpfr24 = Bits<24>;
type Mpfr53 = Bits<53>;
type Mpfr200 = Bits<200>;

impl<const BITS: u32> System for Bits<BITS> {
    type Number = Mpfr;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        pairs(Self::FORMAT).prop_map(planted::<Self>).boxed()
    }
    fn stands_for(result: &Mpfr, exact: &Exact) -> bool {
        result.precision() == Some(BITS) && MpfrMixed::stands_for(result, exact)
    }
}
impl<const BITS: u32> Floats for Bits<BITS> {
    const FORMAT: Format = Format::unbounded(BITS);

    fn float(x: &Exact) -> Mpfr {
        Mpfr::rounded(BITS, x.as_rational())
    }
}

/// MPFR numbers of all precisions, and constants of none, meeting each other.
struct MpfrMixed;

impl System for MpfrMixed {
    type Number = Mpfr;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let precision =
            || prop_oneof![Just(None), prop::sample::select(vec![2, 3, 24, 53, 200]).prop_map(Some)];
        let number = |x: Exact, precision, (p, q)| match precision {
            Some(bits) => {
                let x = Format::unbounded(bits).round(&x);
                (Mpfr::rounded(bits, x.as_rational()), x)
            }
            None => (Mpfr::int(p) / Mpfr::int(q), Rational::from((p, q)).into()),
        };
        (pairs(Format::unbounded(200)), precision(), precision(), fractions(), fractions())
            .prop_map(move |((a, b), pa, pb, qa, qb)| (number(a, pa, qa), number(b, pb, qb)))
            .boxed()
    }
    fn stands_for(result: &Mpfr, exact: &Exact) -> bool {
        let expected = match result.precision() {
            Some(bits) => Format::unbounded(bits).round(exact),
            None => exact.clone(),
        };
        result.to_exact() == Ok(expected)
    }
}

/// MPFR constants: exact until they meet a rounded number.
struct MpfrConstant;

impl System for MpfrConstant {
    type Number = Mpfr;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let constant = || {
            fractions().prop_map(|(p, q)| (Mpfr::int(p) / Mpfr::int(q), Exact::from(Rational::from((p, q)))))
        };
        (constant(), constant()).boxed()
    }
    fn stands_for(result: &Mpfr, exact: &Exact) -> bool {
        result.precision().is_none() && result.to_exact().as_ref() == Ok(exact)
    }
}

struct Rationals;

impl System for Rationals {
    type Number = Exact;
    /// Not `Exact` again, which would be compared with itself.
    type Meaning = Fraction;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let planted = |x: Exact| {
            let (p, q) = Rational::from(x.clone()).into_numer_denom();
            (x, Fraction(p, q))
        };
        (rationals(), rationals()).prop_map(move |(a, b)| (planted(a), planted(b))).boxed()
    }
    fn stands_for(result: &Exact, exact: &Fraction) -> bool {
        let q = result.as_rational();
        Fraction(q.numer().clone(), q.denom().clone()) == *exact
    }
}

/// What a rational number is: two integers, the second not 0, never reduced.
#[derive(Clone, Debug)]
struct Fraction(Integer, Integer);

spring_mass_contact::operators! { [] Fraction;
    Add add |a, b| Fraction(Integer::from(&a.0 * &b.1) + Integer::from(&b.0 * &a.1), Integer::from(&a.1 * &b.1));
    Sub sub |a, b| Fraction(Integer::from(&a.0 * &b.1) - Integer::from(&b.0 * &a.1), Integer::from(&a.1 * &b.1));
    Mul mul |a, b| Fraction(Integer::from(&a.0 * &b.0), Integer::from(&a.1 * &b.1));
    Div div |a, b| Fraction(Integer::from(&a.0 * &b.1), Integer::from(&a.1 * &b.0));
    - |a| Fraction(Integer::from(-&a.0), a.1.clone())
}
impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        Integer::from(&self.0 * &other.1) == Integer::from(&other.0 * &self.1)
    }
}
impl Zero for Fraction {
    fn zero() -> Self {
        Fraction::int(0)
    }
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}
impl One for Fraction {
    fn one() -> Self {
        Fraction::int(1)
    }
}
impl Field for Fraction {
    fn int(n: i32) -> Self {
        Fraction(n.into(), 1.into())
    }
}

/// Balls over floats, with the exact number anywhere inside: at the ends, at the centre, between.
struct Balls<S>(PhantomData<S>);
type BallF32 = Balls<Binary32>;
type BallF64 = Balls<Binary64>;
type BallMpfr2 = Balls<Mpfr2>;
type BallMpfr53 = Balls<Mpfr53>;

/// How wide a ball is: a point, half a unit in the last place, or about η·2ᵏ of its centre.
#[derive(Clone, Copy, Debug)]
enum Width {
    Point,
    Rounding,
    Wide(i32),
}

impl<S: Floats<Number = N>, N: Real + ToExact + 'static> Balls<S> {
    /// A width and a place inside: from −16, the lower end, to 16, the upper one.
    fn shape() -> BoxedStrategy<(Width, i32)> {
        let widest = S::FORMAT.bits.cast_signed() + 4;
        let width =
            prop_oneof![Just(Width::Point), Just(Width::Rounding), (-8..widest).prop_map(Width::Wide)];
        (width, prop_oneof![Just(-16), Just(0), Just(16), -16..=16]).boxed()
    }

    fn planted(centre: &Exact, (width, place): (Width, i32)) -> Planted<Self> {
        let float = S::float(centre);
        let ball = match width {
            Width::Point => Ball::exactly(float),
            Width::Rounding => Ball::rounded(float),
            Width::Wide(k) => {
                // Around 0 too, where the centre has no size of its own.
                let size = if centre.is_zero() { Exact::one() } else { centre.clone() };
                let error = S::float(&S::FORMAT.fit(&(size * Exact::power_of_two(k))));
                Ball::exactly(float) + (Ball::rounded(error.clone()) - Ball::exactly(error))
            }
        };
        let inside = match ball.radius().to_exact() {
            Ok(radius) => centre + radius * Exact::int(place) / Exact::int(16),
            Err(Inexact) => centre.clone(),
        };
        (ball, inside)
    }

    fn of(centres: BoxedStrategy<Exact>) -> BoxedStrategy<Planted<Self>> {
        (centres, Self::shape()).prop_map(|(centre, shape)| Self::planted(&centre, shape)).boxed()
    }
}

impl<S: Floats<Number = N>, N: Real + ToExact + 'static> System for Balls<S> {
    type Number = Ball<N>;
    type Meaning = Exact;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        (pairs(S::FORMAT), Self::shape(), Self::shape())
            .prop_map(|((a, b), sa, sb)| (Self::planted(&a, sa), Self::planted(&b, sb)))
            .boxed()
    }
    fn stands_for(result: &Self::Number, exact: &Exact) -> bool {
        match (result.value().to_exact(), result.radius().to_exact()) {
            (Ok(value), Ok(radius)) => exact >= &(&value - &radius) && exact <= &(value + radius),
            _ => *result.radius() == N::infinity(),
        }
    }
    /// They have a number in common.
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        let end = |x: &N| x.to_exact();
        match (end(a.value()), end(a.radius()), end(b.value()), end(b.radius())) {
            (Ok(va), Ok(ra), Ok(vb), Ok(rb)) => (va - vb).abs() <= ra + rb,
            _ => !a.is_finite() || !b.is_finite(),
        }
    }
}

/// Dual numbers over any of the others.
struct Duals<S>(PhantomData<S>);
type DualExact = Duals<Rationals>;
type DualF64 = Duals<Binary64>;
type DualBallF32 = Duals<BallF32>;
type DualBallF64 = Duals<BallF64>;

impl<S, N, M> System for Duals<S>
where
    S: System<Number = N, Meaning = M>,
    N: Field + 'static,
    M: Field + 'static,
{
    type Number = Dual<N>;
    /// Not `Dual` again, which would be compared with itself.
    type Meaning = Matrix<M>;

    fn pair() -> BoxedStrategy<(Planted<Self>, Planted<Self>)> {
        let dual = |(value, v): Planted<S>, (derivative, d): Planted<S>| {
            (Dual { value, derivative }, Matrix([[v.clone(), d], [M::zero(), v]]))
        };
        (S::pair(), S::pair()).prop_map(move |((va, vb), (da, db))| (dual(va, da), dual(vb, db))).boxed()
    }
    fn stands_for(result: &Self::Number, Matrix([[v, d], [zero, w]]): &Self::Meaning) -> bool {
        S::stands_for(&result.value, v) && S::stands_for(&result.derivative, d) && zero.is_zero() && v == w
    }
    fn same(a: &Self::Number, b: &Self::Number) -> bool {
        S::same(&a.value, &b.value) && S::same(&a.derivative, &b.derivative)
    }
}

/// What a dual number v + d·ε is: the matrix with v on and d above its diagonal.
#[derive(Clone, Debug, PartialEq)]
struct Matrix<T>([[T; 2]; 2]);

impl<T: Field> Matrix<T> {
    fn each(&self, other: &Self, f: impl Fn(&T, &T) -> T) -> Self {
        Matrix([0, 1].map(|i| [0, 1].map(|j| f(&self.0[i][j], &other.0[i][j]))))
    }

    fn determinant(&self) -> T {
        let [[a, b], [c, d]] = &self.0;
        a * d - b * c
    }
}

spring_mass_contact::operators! { [T: Field] Matrix<T>;
    Add add |a, b| a.each(b, |x, y| x + y);
    Sub sub |a, b| a.each(b, |x, y| x - y);
    Mul mul |a, b| {
        let entry = |i: usize, j: usize| &a.0[i][0] * &b.0[0][j] + &a.0[i][1] * &b.0[1][j];
        Matrix([0, 1].map(|i| [0, 1].map(|j| entry(i, j))))
    };
    Div div |a, b| {
        let [[p, q], [r, s]] = &b.0;
        let product = a * Matrix([[s.clone(), -q], [-r, p.clone()]]);
        product.each(&product, |x, _| x / b.determinant())
    };
    - |a| a.each(a, |x, _| -x)
}
impl<T: Field> Zero for Matrix<T> {
    fn zero() -> Self {
        Matrix::int(0)
    }
    fn is_zero(&self) -> bool {
        self.0.iter().flatten().all(T::is_zero)
    }
}
impl<T: Field> One for Matrix<T> {
    fn one() -> Self {
        Matrix::int(1)
    }
}
impl<T: Field> Field for Matrix<T> {
    fn int(n: i32) -> Self {
        Matrix([[T::int(n), T::zero()], [T::zero(), T::int(n)]])
    }
    fn is_unit(&self) -> bool {
        self.determinant().is_unit()
    }
}

// ------------------------------------------------------------------------------------------------
// Which law is run for which systems
// ------------------------------------------------------------------------------------------------

/// One test a law and system: `law::System`.
macro_rules! law {
    ($law:ident: $($System:ident)+) => {
        #[allow(non_snake_case)]
        mod $law {
            $(#[test]
            fn $System() {
                super::$law::<super::$System, _>();
            })+
        }
    };
}

/// Laws of + − × ÷ alone.
macro_rules! laws_of_every_system {
    ($($law:ident)+) => {$(law! { $law:
        Binary32 Binary64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant Rationals
        BallF32 BallF64 BallMpfr2 BallMpfr53 DualExact DualF64 DualBallF32 DualBallF64
    })+};
}
laws_of_every_system! {
    zero_one_and_signs_are_neutral
    small_integers_add_and_multiply
    owned_and_borrowed_operands_give_the_same
}

// All but the duals of floats, whose derivative takes several roundings; the duals of balls bound it, and
// `dual_floats_are_the_centres_of_dual_balls`.
law! { operations_return_what_the_exact_result_demands:
    Binary32 Binary64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant Rationals
    BallF32 BallF64 BallMpfr2 BallMpfr53 DualExact DualBallF32 DualBallF64
}

law! { exact_numbers_are_a_commutative_ring_with_inverses: Rationals MpfrConstant DualExact }

law! { positive_part_and_minimum_return_what_the_exact_result_demands:
    Binary32 Binary64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant
    BallF32 BallF64 BallMpfr2 BallMpfr53
}

law! { numbers_are_ordered_as_what_they_stand_for:
    Binary32 Binary64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 MpfrMixed MpfrConstant
}

macro_rules! laws_of_floats {
    ($($law:ident)+) => {$(law! { $law: Binary32 Binary64 Mpfr2 Mpfr3 Mpfr24 Mpfr53 Mpfr200 })+};
}
laws_of_floats! {
    neighbours_have_no_number_between_them
    the_unit_roundoff_bounds_every_rounding
    exp_ln_and_ln_1p_are_correctly_rounded
    a_ball_knows_whether_its_centre_is_exact
}

// Laws of the balls over these floats.
macro_rules! laws_of_balls {
    ($($law:ident)+) => {$(law! { $law: Binary32 Binary64 Mpfr2 Mpfr53 })+};
}
laws_of_balls! {
    a_ball_never_errs_about_signs_and_bounds
    the_centre_is_what_the_float_alone_computes
    a_ball_of_exp_holds_the_exponential
    a_dual_ball_of_exp_holds_the_exponential_and_its_derivative
    a_ball_is_hardly_wider_than_the_rounding_of_its_operation
}

// ------------------------------------------------------------------------------------------------
// Laws of every number system
// ------------------------------------------------------------------------------------------------

type Operation<T> = fn(&T, &T) -> T;

fn operations<T: Field>() -> [(&'static str, Operation<T>); 4] {
    [("+", |a, b| a + b), ("-", |a, b| a - b), ("*", |a, b| a * b), ("/", |a, b| a / b)]
}

/// For floats: the nearest float, to even, infinite beyond the largest. For balls: any that contains the
/// exact result, for all numbers inside the operands. For exact numbers: the result.
fn operations_return_what_the_exact_result_demands<S: System<Number = N>, N: Field>() {
    let tried = Tally::default();
    for_all(S::pair(), |((a, exact_a), (b, exact_b))| {
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
}

#[allow(clippy::eq_op)]
fn zero_one_and_signs_are_neutral<S: System<Number = N>, N: Field>() {
    let (zero, one) = (N::zero(), N::one());
    assert!(zero.is_zero() && !zero.is_unit() && !one.is_zero() && one.is_unit());
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
        if divided.count(a.is_unit()) {
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
    divided.assert_one_in(2, "divisors");
}

/// With 12 bits each, so that their products fit into f32.
fn small_integers_add_and_multiply<S: System<Number = N>, N: Field>() {
    let small = || prop_oneof![-10..=10, -4095..=4095];
    for_all((small(), small()), |(m, n)| {
        let (a, b) = (N::int(m), N::int(n));
        prop_assert!(S::same(&(&a + &b), &N::int(m + n)));
        prop_assert!(S::same(&(&a - &b), &N::int(m - n)));
        prop_assert!(S::same(&(&a * &b), &N::int(m * n)));
        prop_assert_eq!(a == b, m == n);
        prop_assert_eq!(a.is_zero(), m == 0);
        prop_assert_eq!(a.is_unit(), m != 0);
        Ok(())
    });
}

/// To the bit and to the precision: that is what the debug format shows.
fn owned_and_borrowed_operands_give_the_same<S: System<Number = N>, N: Field>() {
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
        if divided.count(b.is_unit()) {
            forms!(/);
        }
        Ok(())
    });
    divided.assert_one_in(2, "divisors");
}

fn exact_numbers_are_a_commutative_ring_with_inverses<S: System<Number = N>, N: Field>() {
    let inverted = Tally::default();
    for_all((S::pair(), S::number()), |(((a, _), (b, _)), (c, _))| {
        prop_assert_eq!((&a + &b) + &c, &a + (&b + &c));
        prop_assert_eq!((&a * &b) * &c, &a * (&b * &c));
        prop_assert_eq!(&a * (&b + &c), &a * &b + &a * &c);
        prop_assert_eq!((&a - &b) * &c, &a * &c - &b * &c);
        prop_assert_eq!(&a + &b, &b + &a);
        prop_assert_eq!(&a * &b, &b * &a);
        prop_assert_eq!(&a + -&a, N::zero());
        if inverted.count(c.is_unit()) {
            prop_assert_eq!(&c * (N::one() / &c), N::one());
            prop_assert_eq!(&a / &c * &c, a.clone());
            prop_assert_eq!((&a + &b) / &c, &a / &c + &b / &c);
        }
        Ok(())
    });
    inverted.assert_one_in(2, "divisors");
}

// ------------------------------------------------------------------------------------------------
// Order
// ------------------------------------------------------------------------------------------------

fn positive_part_and_minimum_return_what_the_exact_result_demands<S, N>()
where
    S: System<Number = N, Meaning = Exact>,
    N: PositivePart,
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

/// ⟨·⟩ and min choose among numbers and round nothing, so a zero of no precision may come out.
fn holds_exactly<S: System<Number = N, Meaning = Exact>, N: Field>(result: &N, exact: &Exact) -> bool {
    S::stands_for(result, exact) || (exact.is_zero() && *result == N::zero())
}

fn numbers_are_ordered_as_what_they_stand_for<S, N>()
where
    S: System<Number = N, Meaning = Exact>,
    N: OrderedField + ToExact,
{
    for_all(S::pair(), |((a, exact_a), (b, exact_b))| {
        prop_assert_eq!(a.to_exact(), Ok(exact_a.clone()));
        prop_assert_eq!(a.partial_cmp(&b), Some(exact_a.cmp(&exact_b)));
        prop_assert_eq!(a == b, exact_a == exact_b);
        prop_assert_eq!(a.is_zero(), exact_a.is_zero());
        let absolute = if exact_a < Exact::zero() { -&exact_a } else { exact_a };
        prop_assert_eq!(a.abs().to_exact(), Ok(absolute));
        prop_assert_eq!(a.min(&b), b.min(&a));
        prop_assert_eq!(a.positive_part() - (-&a).positive_part(), a);
        Ok(())
    });
}

// ------------------------------------------------------------------------------------------------
// Floats
// ------------------------------------------------------------------------------------------------

fn neighbours_have_no_number_between_them<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let below_the_largest = Tally::default();
    for_all(S::number(), |(x, exact)| {
        let (up, down) = (x.next_up(), x.next_down());
        prop_assert!(down < x && x < up);
        prop_assert_eq!(up.next_down(), x.clone());
        prop_assert_eq!(down.next_up(), x.clone());
        prop_assert_eq!(format!("{:?}", (-&x).next_up()), format!("{:?}", -&down));
        // The neighbours of an unbounded format's zero have exponents too large to look at.
        let near = if S::FORMAT.bounded || !exact.is_zero() { up } else { x };
        let largest = S::FORMAT.bounded && exact == S::FORMAT.largest();
        prop_assert_eq!(near.is_finite(), !largest);
        if below_the_largest.count(!largest && near.to_exact().as_ref() != Ok(&exact)) {
            let near = near.to_exact().unwrap();
            prop_assert_eq!(&S::FORMAT.round(&near), &near);
            // Were there a float between, one of the two thirds would round to it.
            let third = (&near - &exact) / Exact::int(3);
            prop_assert_eq!(S::FORMAT.round(&(&exact + &third)), exact);
            prop_assert_eq!(S::FORMAT.round(&(&near - third)), near);
        }
        Ok(())
    });
    below_the_largest.assert_one_in(2, "neighbours looked at");
}

fn the_unit_roundoff_bounds_every_rounding<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let eta = Exact::power_of_two(-S::FORMAT.bits.cast_signed());
    let least = if S::FORMAT.bounded { Exact::power_of_two(S::FORMAT.least) } else { Exact::zero() };
    assert_eq!(N::underflow_unit().to_exact(), Ok(least));
    assert!(!N::infinity().is_finite() && N::infinity() > N::zero());
    for_all((S::number(), rationals()), |((x, exact), any)| {
        prop_assert_eq!(x.unit_roundoff().to_exact(), Ok(eta.clone()));
        prop_assert!(x.is_finite());
        let size = x.magnitude().to_exact().unwrap();
        // Exact up to 64 bits, and rounded up to so many beyond.
        prop_assert!(exact.abs() <= size);
        prop_assert!(size <= exact.abs() * (Exact::one() + Exact::power_of_two(-63)));
        // η|fl(x)| is what the balls add for a rounding.
        let rounded = S::FORMAT.fit(&any);
        let overflows = any.abs() > S::FORMAT.largest();
        let error = S::float(&rounded).to_exact().unwrap() - &any;
        let underflow = N::underflow_unit().to_exact().unwrap();
        prop_assert!(overflows || error.abs() <= &eta * rounded.abs() + underflow / Exact::int(2));
        Ok(())
    });
}

/// f(x) for an increasing f, rounded down and up to `bits` bits: the true value lies between.
fn bracket(x: &Exact, bits: u32, f: fn(&mut Float, Round) -> Ordering) -> (Exact, Exact) {
    let end = |round| {
        let (mut y, _) = Float::with_val_round(bits, x.as_rational(), round);
        f(&mut y, round);
        Exact::from(y.to_rational().expect("finite"))
    };
    (end(Round::Down), end(Round::Up))
}

/// A number that rounds as f(x) does: once both ends of a bracket round to the same float, so does what
/// lies between. That happens, since f(x) is irrational but for x = 0 (ln: 1), where the ends are equal.
fn rounds_as(format: Format, x: &Exact, f: fn(&mut Float, Round) -> Ordering) -> Exact {
    let mut bits = 2 * format.bits + 64;
    loop {
        let (low, high) = bracket(x, bits, f);
        if format.round(&low) == format.round(&high) {
            return low;
        }
        bits *= 2;
    }
}

fn exp_ln_and_ln_1p_are_correctly_rounded<S: Floats<Number = N>, N: Logarithm + Exponential + 'static>() {
    // Below η, where exp x rounds to 1, up to e^(2^11), beyond the range of f64.
    let bits = S::FORMAT.bits.cast_signed();
    let arguments = || floats(S::FORMAT.within(-bits - 8, 12));
    for_all(prop_oneof![arguments(), floats(S::FORMAT.within(-3000, 12))], |x| {
        let (result, float) = (S::float(&x).exp(), S::float(&x));
        prop_assert!(S::stands_for(&result, &rounds_as(S::FORMAT, &x, Float::exp_round)), "exp {float:?}");
        Ok(())
    });
    let around_one = arguments().prop_map(|x| S::FORMAT.round(&(Exact::one() + x.clamp(-half(), half()))));
    for_all(prop_oneof![floats(S::FORMAT), around_one], |x| {
        let x = if x.is_zero() { Exact::one() } else { x.abs() };
        let result = S::float(&x).ln();
        prop_assert!(S::stands_for(&result, &rounds_as(S::FORMAT, &x, Float::ln_round)), "ln of {x}");
        Ok(())
    });
    for_all(prop_oneof![floats(S::FORMAT), arguments()], |x| {
        let x = if x <= -Exact::one() { x.abs() } else { x };
        let result = S::float(&x).ln_1p();
        prop_assert!(S::stands_for(&result, &rounds_as(S::FORMAT, &x, Float::ln_1p_round)), "ln_1p of {x}");
        Ok(())
    });
}

/// A good library that promises no correct rounding errs once in some thousand full mantissas, so it takes
/// many, and a quick oracle: 160 bits, then the float. Two roundings differ from one only where the value
/// lies within 2⁻¹⁰⁷ of a tie; in f64 the hardest arguments of this size leave more than 2⁻⁷⁰. (Muller et al.,
/// Handbook of Floating-Point Arithmetic, on the table maker's dilemma.)
#[test]
fn exp_ln_and_ln_1p_are_correctly_rounded_at_many_full_mantissas() {
    for i in 0..20_000u64 {
        // Multiples of the golden section fill [1, 2) evenly, and 13 binades in turn.
        let digits = i.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let double = f64::from_bits(1.0f64.to_bits() | digits >> 12)
            * Exact::power_of_two(i32::try_from(i % 13).unwrap() - 6).to_f64().unwrap();
        let single = double as f32;
        macro_rules! check {
            ($float:ident $x:expr, $convert:ident) => {
                let wide = |x: $float| Float::with_val(160, x);
                assert_eq!(Exponential::exp(&$x), wide($x).exp().$convert(), "exp {:e}", $x);
                assert_eq!(Exponential::exp(&-$x), wide(-$x).exp().$convert(), "exp -{:e}", $x);
                assert_eq!(Logarithm::ln(&$x), wide($x).ln().$convert(), "ln {:e}", $x);
                assert_eq!(Logarithm::ln_1p(&$x), wide($x).ln_1p().$convert(), "ln_1p {:e}", $x);
            };
        }
        check!(f64 double, to_f64);
        check!(f32 single, to_f32);
    }
}

/// Twice is not once: a result that lies a little to one side of the middle of two subnormal numbers can be rounded to
/// the middle first, and then to the wrong side.
#[test]
fn exponentials_among_the_subnormal_numbers_are_rounded_once() {
    fn law<S: Floats<Number = N>, N: Exponential>() {
        // From the smallest normal number's logarithm, 2^(least + bits − 1), to that of half the smallest number's.
        let (bits, least) = (f64::from(S::FORMAT.bits), f64::from(S::FORMAT.least));
        let subnormal = Tally::default();
        for i in 0..1000 {
            let power = least + bits - (bits + 2.0) * f64::from(i) / 1000.0;
            let x = S::FORMAT.round(&(power * std::f64::consts::LN_2).to_exact().unwrap());
            let exponential = rounds_as(S::FORMAT, &x, Float::exp_round);
            subnormal.count(magnitude(&exponential) < S::FORMAT.least + S::FORMAT.bits.cast_signed() - 1);
            let result = S::float(&x).exp();
            assert!(S::stands_for(&result, &exponential), "exp {x} gives {result:?}");
        }
        subnormal.assert_one_in(2, "subnormal numbers");
    }
    law::<Binary32, _>();
    law::<Binary64, _>();
}

fn half() -> Exact {
    Exact::power_of_two(-1)
}

#[test]
fn functions_are_exact_where_their_values_are_rational() {
    fn law<S: Floats<Number = N>, N: Logarithm + Exponential>() {
        let [zero, one] = [Exact::zero(), Exact::one()].map(|x| S::float(&x));
        assert_eq!((zero.exp(), one.ln(), zero.ln_1p()), (one.clone(), zero.clone(), zero));
    }
    law::<Binary32, _>();
    law::<Binary64, _>();
    law::<Mpfr2, _>();
    law::<Mpfr200, _>();
    let [zero, one] = [Mpfr::zero(), Mpfr::one()];
    assert_eq!((zero.exp(), one.ln(), zero.ln_1p()), (one.clone(), zero.clone(), zero));
}

/// The exact result of a conversion, errors and all.
fn converted(x: &Exact, format: Format, scalar: &'static str) -> Result<Exact, RangeError> {
    let nearest = format.round(x);
    if nearest.abs() > format.largest() {
        Err(RangeError::Overflow { scalar })
    } else if nearest.is_zero() && !x.is_zero() {
        Err(RangeError::Underflow { scalar })
    } else {
        Ok(nearest)
    }
}

#[test]
fn rationals_are_rounded_once_to_the_nearest_float_or_refused() {
    // Numbers with a few more bits than the format, half of them ties, from below the smallest subnormal to
    // beyond the largest float.
    let wide = |f: Format| Format { least: f.least - 3, greatest: f.greatest + 1, bits: f.bits + 1, ..f };
    let drawn = |f| prop_oneof![floats(wide(f)), floats(f).prop_map(|x| x / Exact::int(3)), rationals()];
    let refused = Tally::default();
    for_all(drawn(SINGLE), |x| {
        let result = x.to_f32();
        refused.count(result.is_err());
        prop_assert_eq!(result.map(|y| y.to_exact().unwrap()), converted(&x, SINGLE, "f32"));
        Ok(())
    });
    for_all(drawn(DOUBLE), |x| {
        let result = x.to_f64();
        refused.count(result.is_err());
        prop_assert_eq!(result.map(|y| y.to_exact().unwrap()), converted(&x, DOUBLE, "f64"));
        Ok(())
    });
    refused.assert_one_in(50, "refused");
    for_all((rationals(), floats(Format::unbounded(54)), 2u32..=53), |(x, tie, bits)| {
        for x in [x, tie] {
            let result = x.to_mpfr(bits);
            prop_assert_eq!(result.precision(), Some(bits));
            prop_assert_eq!(result.to_exact(), Ok(Format::unbounded(bits).round(&x)));
        }
        Ok(())
    });
}

#[test]
fn overflow_and_underflow_begin_exactly_where_rounding_says() {
    fn edges<F: Copy + PartialEq + Debug>(
        format: Format,
        convert: fn(&Exact) -> Result<F, RangeError>,
        [largest, smallest]: [F; 2],
        scalar: &'static str,
    ) {
        let unit = Exact::power_of_two(format.greatest);
        let beyond = format.largest() + &unit / Exact::int(2);
        let tiny = &unit / Exact::power_of_two(2000);
        assert_eq!(convert(&(&beyond - &tiny)), Ok(largest));
        assert_eq!(convert(&beyond), Err(RangeError::Overflow { scalar }));
        assert_eq!(convert(&-&beyond), Err(RangeError::Overflow { scalar }));
        let least = Exact::power_of_two(format.least);
        let below = &least / Exact::int(2);
        let tiny = &least / Exact::power_of_two(2000);
        assert_eq!(convert(&least), Ok(smallest));
        assert_eq!(convert(&(&below + &tiny)), Ok(smallest));
        assert_eq!(convert(&below), Err(RangeError::Underflow { scalar }));
        assert_eq!(convert(&-below), Err(RangeError::Underflow { scalar }));
        assert_eq!(convert(&tiny), Err(RangeError::Underflow { scalar }));
    }
    edges(SINGLE, Exact::to_f32, [f32::MAX, f32::from_bits(1)], "f32");
    edges(DOUBLE, Exact::to_f64, [f64::MAX, f64::from_bits(1)], "f64");
    assert_eq!(Exact::zero().to_f32().map(f32::to_bits), Ok(0));
    assert_eq!(Exact::zero().to_f64().map(f64::to_bits), Ok(0));
}

#[test]
fn what_is_not_finite_has_no_exact_value() {
    assert_eq!(
        [f32::INFINITY, f32::NEG_INFINITY, f32::NAN].map(|x| x.to_exact()),
        [const { Err(Inexact) }; 3]
    );
    assert_eq!(
        [f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(|x| x.to_exact()),
        [const { Err(Inexact) }; 3]
    );
    let endless = [Mpfr::infinity(), -Mpfr::infinity(), Mpfr::infinity() - Mpfr::infinity()];
    assert_eq!(endless.map(|x| x.to_exact()), [const { Err(Inexact) }; 3]);
}

// ------------------------------------------------------------------------------------------------
// MPFR
// ------------------------------------------------------------------------------------------------

#[test]
fn the_larger_precision_wins_in_whatever_order_and_constants_have_none() {
    let (first, second) = (Tally::default(), Tally::default());
    for_all(MpfrMixed::pair(), |((a, _), (b, _))| {
        let larger = a.precision().max(b.precision());
        first.count(a.precision() > b.precision());
        second.count(a.precision() < b.precision());
        for (name, operation) in operations::<Mpfr>() {
            for (a, b) in [(&a, &b), (&b, &a)] {
                // Constant by constant zero is refused, as a rational is.
                if name != "/" || b.is_unit() {
                    prop_assert_eq!(operation(a, b).precision(), larger, "{}", name);
                }
            }
        }
        prop_assert_eq!((-&a).precision(), a.precision());
        prop_assert_eq!(a.abs().precision(), a.precision());
        prop_assert_eq!((a.next_up().precision(), a.next_down().precision()), (a.precision(), a.precision()));
        Ok(())
    });
    first.assert_one_in(5, "first operand more precise");
    second.assert_one_in(5, "second operand more precise");
}

#[test]
fn precisions_reach_from_2_to_a_million_bits() {
    assert_eq!(PRECISIONS, 2..=1_000_000);
    for bits in [2, 1_000_000] {
        assert_eq!(Exact::one().to_mpfr(bits).precision(), Some(bits));
        assert_eq!(Mpfr::parse("1/3", bits).map(|x| x.precision()), Ok(Some(bits)));
    }
}

#[test]
#[should_panic = "a precision of 1 bits"]
fn one_bit_is_refused() {
    Exact::one().to_mpfr(1);
}

#[test]
#[should_panic = "a precision of 1000001 bits"]
fn more_than_a_million_bits_are_refused() {
    Exact::one().to_mpfr(1_000_001);
}

#[test]
#[should_panic = "exp of a constant"]
fn a_constant_has_no_exponential() {
    Mpfr::int(1).exp();
}

#[test]
#[should_panic = "ln of a constant"]
fn a_constant_has_no_logarithm() {
    Mpfr::int(2).ln();
}

#[test]
#[should_panic = "ln_1p of a constant"]
fn a_constant_has_no_logarithm_after_one() {
    Mpfr::int(1).ln_1p();
}

/// Zero and ±m·2ᵉ, 4 ≤ m ≤ 7: all floats of 3 bits with these exponents.
fn all_of_three_bits(exponents: std::ops::RangeInclusive<i32>) -> Vec<Exact> {
    let positive = exponents.flat_map(|e| (4..8).map(move |m| Exact::int(m) * Exact::power_of_two(e)));
    let signed = positive.flat_map(|x| [-&x, x]);
    std::iter::once(Exact::zero()).chain(signed).collect()
}

#[test]
fn all_pairs_of_3_bit_floats_round_correctly_and_stay_in_their_balls() {
    let all = all_of_three_bits(-5..=3);
    for exact_a in &all {
        for exact_b in &all {
            let [a, b] = [exact_a, exact_b].map(Mpfr3::float);
            let (ball_a, ball_b) = (Ball::exactly(a.clone()), Ball::exactly(b.clone()));
            for (i, (name, exact)) in operations::<Exact>().into_iter().enumerate() {
                let (float, ball) = (operations()[i].1, operations()[i].1);
                if name == "/" && exact_b.is_zero() {
                    assert!(!ball(&ball_a, &ball_b).is_finite());
                    continue;
                }
                let (result, exact) = (float(&a, &b), exact(exact_a, exact_b));
                assert!(Mpfr3::stands_for(&result, &exact), "{exact_a} {name} {exact_b} = {result}");
                let ball = ball(&ball_a, &ball_b);
                assert_eq!(*ball.value(), result);
                assert!(Balls::<Mpfr3>::stands_for(&ball, &exact), "{exact_a} {name} {exact_b}: {ball:?}");
            }
        }
    }
}

/// The four operations are monotone in each operand (÷ on either side of 0), so if the results for the
/// ends of both balls are inside, all others are.
#[test]
fn all_pairs_of_3_bit_balls_hold_the_results_of_their_ends() {
    let all = all_of_three_bits(-4..=0);
    let finite = Tally::default();
    for a in &all {
        for b in &all {
            let balls = [a, b].map(|x| Ball::rounded(Mpfr3::float(x)));
            let [ends_a, ends_b] = [(a, &balls[0]), (b, &balls[1])].map(|(x, ball)| {
                let radius = ball.radius().to_exact().unwrap();
                [x - &radius, x + radius]
            });
            for (i, (name, exact)) in operations::<Exact>().into_iter().enumerate() {
                let result = operations()[i].1(&balls[0], &balls[1]);
                if !finite.count(result.is_finite()) {
                    assert!(name == "/" && b.is_zero(), "{a} {name} {b}: {result:?}");
                    continue;
                }
                for (x, y) in ends_a.iter().flat_map(|x| ends_b.iter().map(move |y| (x, y))) {
                    let exact = exact(x, y);
                    assert!(Balls::<Mpfr3>::stands_for(&result, &exact), "{x} {name} {y}: {result:?}");
                }
            }
        }
    }
    finite.assert_one_in(2, "finite balls");
}

// ------------------------------------------------------------------------------------------------
// Balls
// ------------------------------------------------------------------------------------------------

fn a_ball_never_errs_about_signs_and_bounds<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let (certain, uncertain) = (Tally::default(), Tally::default());
    // Differences of neighbours straddle 0; quotients have infinite balls among them.
    for_all(Balls::<S>::pair(), |((a, exact_a), (b, exact_b))| {
        let mut planted = vec![(&a - &b, &exact_a - &exact_b)];
        if exact_b.is_unit() {
            planted.push((&a / &b, &exact_a / &exact_b));
        }
        planted.push((a, exact_a));
        for (ball, exact) in planted {
            prop_assert!(ball.contains(&exact));
            let sign = ball.sign();
            certain.count(sign.is_some());
            uncertain.count(sign.is_none());
            prop_assert!(sign.is_none() || sign == Some(exact.cmp(&Exact::zero())), "{:?}: {}", ball, exact);
            prop_assert!(!ball.is_unit() || !exact.is_zero());
            prop_assert!(compare(&ball.lower(), &exact).is_some_and(Ordering::is_le), "{:?}", ball);
            prop_assert!(compare(&ball.upper(), &exact).is_some_and(Ordering::is_ge), "{:?}", ball);
            prop_assert!(compare(&ball.magnitude(), &exact.abs()).is_some_and(Ordering::is_ge), "{:?}", ball);
        }
        Ok(())
    });
    certain.assert_one_in(4, "signs decided");
    uncertain.assert_one_in(50, "signs not decided");
}

/// Also where `x` is infinite.
fn compare<N: Real + ToExact>(x: &N, exact: &Exact) -> Option<Ordering> {
    match x.to_exact() {
        Ok(x) => Some(x.cmp(exact)),
        Err(Inexact) => x.partial_cmp(&N::zero()),
    }
}

fn the_centre_is_what_the_float_alone_computes<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    for_all(Balls::<S>::pair(), |((a, _), (b, _))| {
        let (x, y) = (a.value(), b.value());
        let same = |ball: &Ball<N>, float: &N| S::same(ball.value(), float);
        for ((name, ball), (_, float)) in operations().into_iter().zip(operations()) {
            let (ball, float) = (ball(&a, &b), float(x, y));
            prop_assert!(same(&ball, &float), "{}: {:?}, {:?}", name, ball, float);
        }
        prop_assert!(same(&-&a, &-x));
        prop_assert!(same(&a.min(&b), &x.min(y)));
        prop_assert!(same(&a.positive_part(), &x.positive_part()));
        Ok(())
    });
}

fn a_ball_knows_whether_its_centre_is_exact<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
    let inexact = Tally::default();
    for_all(prop_oneof![floats(S::FORMAT), rationals()], |x| {
        let nearest = S::FORMAT.round(&x);
        if nearest.abs() <= S::FORMAT.largest() {
            let ball = Ball::around(S::float(&nearest), &x);
            prop_assert_eq!(ball.radius().is_zero(), !inexact.count(x != nearest));
            prop_assert!(Balls::<S>::stands_for(&ball, &x) && ball.contains(&x));
        }
        let ball = Ball::rounded(S::float(&S::FORMAT.fit(&x)));
        let radius = ball.radius().to_exact().unwrap();
        let end = ball.value().to_exact().unwrap() + &radius;
        prop_assert!(ball.contains(&end));
        prop_assert!(!ball.contains(&(end + Exact::power_of_two(-5000))));
        Ok(())
    });
    inexact.assert_one_in(10, "inexact centres");
}

/// Were every radius infinite, all else would hold. What one operation adds is η|x| for the rounding of x,
/// made larger by at most a factor 1 + 2η where it is rounded up in turn, and the underflow unit u where
/// the product or the sum with it underflows: for points, no more than 2 (η|x| + 4u).
fn a_ball_is_hardly_wider_than_the_rounding_of_its_operation<
    S: Floats<Number = N>,
    N: Real + ToExact + 'static,
>() {
    let eta = Exact::power_of_two(1 - S::FORMAT.bits.cast_signed());
    let underflow = Exact::int(8) * N::underflow_unit().to_exact().unwrap();
    let tried = Tally::default();
    for_all(pairs(S::FORMAT), |(a, b)| {
        let [x, y] = [&a, &b].map(S::float);
        let [p, q] = [&x, &y].map(|x| Ball::exactly(x.clone()));
        for ((_, ball), (_, float)) in operations().into_iter().zip(operations::<N>()) {
            let result = float(&x, &y);
            // Not where the float overflows, or only its bound does.
            let limit = S::FORMAT.largest() / Exact::int(4);
            if tried.count(result.to_exact().is_ok_and(|x| !S::FORMAT.bounded || x.abs() < limit)) {
                let ball = ball(&p, &q);
                let bound = &eta * result.to_exact().unwrap().abs() + &underflow;
                prop_assert!(ball.radius().to_exact().is_ok_and(|r| r <= bound), "{:?}, {}", ball, bound);
            }
        }
        Ok(())
    });
    tried.assert_one_in(2, "operations tried");
}

/// The bits in which the exponential of a rational is enclosed: many more than any of the balls has.
const ENCLOSURE: u32 = 500;

fn a_ball_of_exp_holds_the_exponential<S: Floats<Number = N>, N: Real + Exponential + ToExact + 'static>() {
    let finite = Tally::default();
    let bits = S::FORMAT.bits.cast_signed();
    for_all(Balls::<S>::of(floats(S::FORMAT.within(-bits - 8, 11))), |(ball, x)| {
        let result = ball.exp();
        prop_assert!(Balls::<S>::same(&result, &Ball::exactly(ball.value().exp())));
        if finite.count(result.is_finite()) {
            let (low, high) = bracket(&x, ENCLOSURE, Float::exp_round);
            prop_assert!(Balls::<S>::stands_for(&result, &low), "exp {:?} = {:?} at {}", ball, result, x);
            prop_assert!(Balls::<S>::stands_for(&result, &high), "exp {:?} = {:?} at {}", ball, result, x);
        }
        Ok(())
    });
    finite.assert_one_in(2, "finite exponentials");
}

/// (eˣ)′ = eˣ x′. Both factors of a product lie between their ends, so the product lies between the least
/// and the greatest of the ends' products.
fn a_dual_ball_of_exp_holds_the_exponential_and_its_derivative<
    S: Floats<Number = N>,
    N: Real + Exponential + ToExact + 'static,
>() {
    let finite = Tally::default();
    let bits = S::FORMAT.bits.cast_signed();
    let values = || Balls::<S>::of(floats(S::FORMAT.within(-bits, 6)));
    for_all((values(), values()), |((value, x), (derivative, dx))| {
        let Dual { value, derivative } = Dual { value, derivative }.exp();
        let (low, high) = bracket(&x, ENCLOSURE, Float::exp_round);
        finite.count(value.is_finite() && derivative.is_finite());
        for end in [low, high] {
            prop_assert!(Balls::<S>::stands_for(&value, &end));
            prop_assert!(Balls::<S>::stands_for(&derivative, &(end * &dx)));
        }
        Ok(())
    });
    finite.assert_one_in(2, "finite exponentials");
}

/// Around zero the rounding of the centre adds nothing that could hide one of the radius.
#[test]
fn a_ball_around_zero_is_divided_and_multiplied_outwards() {
    fn law<S: Floats<Number = N>, N: Real + ToExact + 'static>() {
        let one = S::float(&Exact::one());
        let ball = Ball::rounded(one.clone()) - Ball::exactly(one);
        let end = ball.radius().to_exact().unwrap();
        for n in 1..200 {
            let (quotient, product) = (&ball / Ball::int(n), &ball * Ball::int(n));
            for end in [-&end, end.clone()] {
                assert!(
                    Balls::<S>::stands_for(&quotient, &(&end / Exact::int(n))),
                    "{end}/{n}: {quotient:?}"
                );
                assert!(Balls::<S>::stands_for(&product, &(&end * Exact::int(n))), "{end} {n}: {product:?}");
            }
        }
    }
    law::<Binary32, _>();
    law::<Binary64, _>();
    law::<Mpfr2, _>();
    law::<Mpfr53, _>();
}

#[test]
fn division_by_what_may_be_zero_gives_the_infinite_ball_and_by_zero_none() {
    fn law<S: Floats<Number = N>, N: Real + Exponential + ToExact>(zeros: &[N]) {
        let one = S::float(&Exact::one());
        let around_zero = Ball::rounded(one.clone()) - Ball::rounded(one.clone());
        let points = zeros.iter().cloned().map(Ball::exactly);
        for divisor in points.chain([around_zero, Ball::zero()]) {
            assert!(!divisor.is_unit());
            for dividend in [Ball::exactly(one.clone()), Ball::one(), Ball::zero(), divisor.clone()] {
                let quotient = dividend / &divisor;
                assert_eq!((quotient.is_finite(), quotient.sign()), (false, None));
                assert!(quotient.contains(&Exact::int(7)));
                // Nothing is known of what is computed from it, either; and a factor 0 does not mend what is undefined.
                let (one, zero) = (Ball::<N>::one(), Ball::<N>::zero());
                let computed = [
                    (&quotient + &one, &one + &quotient),
                    (&quotient - &one, &one - &quotient),
                    (&quotient * &divisor, &divisor * &quotient),
                    (&quotient / &one, &zero / &quotient),
                    (-&quotient, quotient.min(&one)),
                    (quotient.positive_part(), one.min(&quotient)),
                    (quotient.exp(), &quotient - &quotient),
                ];
                let undefined = divisor.is_zero();
                assert_eq!(quotient.is_undefined(), undefined);
                for ball in computed.into_iter().flat_map(<[_; 2]>::from) {
                    assert!(!ball.is_finite());
                    assert_eq!(ball.is_undefined(), undefined, "{ball:?}");
                }
            }
        }
    }
    law::<Binary32, _>(&[0.0, -0.0]);
    law::<Binary64, _>(&[0.0, -0.0]);
    law::<Mpfr53, _>(&[Mpfr::zero(), Mpfr53::float(&Exact::zero()), -Mpfr53::float(&Exact::zero())]);
}

// ------------------------------------------------------------------------------------------------
// Duals
// ------------------------------------------------------------------------------------------------

/// A system and a penalty; every divisor of the chapter's formulas is positive.
fn systems() -> BoxedStrategy<(SpringMass<Exact>, Exact)> {
    let positive = || rationals().prop_map(|x| if x.is_zero() { Exact::one() } else { x.abs() });
    (positive(), positive(), rationals(), rationals(), rationals(), positive())
        .prop_map(|(c, m, g, l, h, eps)| (SpringMass { c, m, g, l, h }, eps))
        .boxed()
}

fn constants<T: Field>(system: &SpringMass<T>) -> SpringMass<Dual<T>> {
    system.map(|x| Dual::constant(x.clone()))
}

/// Exact for polynomials of degree ≤ 2.
fn central_difference_quotient(f: impl Fn(&Exact) -> Exact, x: &Exact, step: &Exact) -> Exact {
    (f(&(x + step)) - f(&(x - step))) / (Exact::int(2) * step)
}

#[test]
fn the_derivative_of_a_quadratic_is_its_difference_quotient_at_any_step() {
    let step =
        fractions().prop_map(|(p, q)| if p == 0 { Exact::one() } else { Exact::int(p) / Exact::int(q) });
    for_all((systems(), rationals(), rationals(), step), |((system, eps), u, lambda, step)| {
        let (lifted, x) = (constants(&system), Dual::variable(u.clone()));
        let [lifted_eps, lifted_lambda] = [&eps, &lambda].map(|x| Dual::constant(x.clone()));
        let quotient = |f: &dyn Fn(&Exact) -> Exact| central_difference_quotient(f, &u, &step);
        prop_assert_eq!(
            structure::potential_energy(&lifted, &x).derivative,
            quotient(&|u| structure::potential_energy(&system, u))
        );
        prop_assert_eq!(
            penalty::energy(&lifted, &lifted_eps, &x).derivative,
            quotient(&|u| penalty::energy(&system, &eps, u))
        );
        prop_assert_eq!(
            augmented::functional(&lifted, &lifted_eps, &lifted_lambda, &x).derivative,
            quotient(&|u| augmented::functional(&system, &eps, &lambda, u))
        );
        Ok(())
    });
}

#[test]
fn the_derivative_of_a_quartic_is_its_five_point_quotient() {
    for_all((rationals(), rationals(), rationals()), |(eps, fourth, p)| {
        let f = |p: &Exact| penalty::series(&eps, std::slice::from_ref(&fourth), p);
        // The quotients at the steps h and 2h differ from f′ by h² f‴/6 and 4h² f‴/6, and by nothing else
        // if f has no fifth derivative.
        let [near, far] = [1, 2].map(|step| central_difference_quotient(f, &p, &Exact::int(step)));
        let derivative = (Exact::int(4) * near - far) / Exact::int(3);
        prop_assert_eq!(penalty::series_force(&eps, std::slice::from_ref(&fourth), &p), derivative);
        Ok(())
    });
}

#[test]
fn the_derivative_of_a_quotient_of_linear_functions_is_the_algebraic_one() {
    let units = Tally::default();
    for_all((rationals(), rationals(), rationals(), rationals(), rationals()), |(a, b, c, d, x)| {
        let [da, db, dc, dd] = [&a, &b, &c, &d].map(|x| Dual::constant(x.clone()));
        let dx = Dual::variable(x.clone());
        let below = &c + &d * &x;
        if units.count(below.is_unit()) {
            let quotient = (da + db * &dx) / (dc + dd * &dx);
            prop_assert_eq!(quotient.value, (&a + &b * &x) / &below);
            prop_assert_eq!(quotient.derivative, (b * c - a * d) / (&below * &below));
        }
        if units.count(x.is_unit()) {
            prop_assert_eq!((Dual::one() / dx).derivative, -Exact::one() / (&x * &x));
        }
        Ok(())
    });
    units.assert_one_in(2, "divisors");
}

#[test]
fn the_derivatives_of_the_penalty_deflection_are_the_algebraic_ones() {
    for_all(systems(), |(system, eps)| {
        let deflection = penalty::deflection(&constants(&system), &Dual::variable(eps.clone()));
        let (r, total) = (system::reaction(&system), &system.c + &eps);
        // u = Δ + R/(c + ε)
        let first = -&r / (&total * &total);
        prop_assert_eq!(&deflection.derivative, &first);
        // A dual of duals has the second derivative.
        let twice = Dual { value: Dual::variable(eps), derivative: Dual::one() };
        let deflection = penalty::deflection(&constants(&constants(&system)), &twice);
        prop_assert_eq!(deflection.value.derivative, first.clone());
        prop_assert_eq!(deflection.derivative.value, first);
        prop_assert_eq!(deflection.derivative.derivative, Exact::int(2) * r / (&total * &total * &total));
        Ok(())
    });
}

#[test]
fn dual_zero_divisors_are_neither_zero_nor_units() {
    let nilpotent = Dual { value: Exact::zero(), derivative: Exact::one() };
    assert!(!nilpotent.is_zero() && !nilpotent.is_unit());
    assert!((&nilpotent * &nilpotent).is_zero());
}

/// Dual numbers over f64 compute what the centres of dual balls are, so the balls bound their error. Only
/// after an overflow may a ball know better: to it 0·∞ is 0.
#[test]
fn dual_floats_are_the_centres_of_dual_balls() {
    fn law(float: &Dual<f64>, ball: &Dual<Ball<f64>>, finite: &Tally) -> TestCaseResult {
        for (float, ball) in [(float.value, &ball.value), (float.derivative, &ball.derivative)] {
            let overflown = !finite.count(float.is_finite() && ball.is_finite());
            prop_assert!(overflown || float == *ball.value(), "{:?}, {:?}", float, ball);
        }
        Ok(())
    }
    let finite = Tally::default();
    let lift =
        |x: &Dual<f64>| Dual { value: Ball::exactly(x.value), derivative: Ball::exactly(x.derivative) };
    for_all(DualF64::pair(), |((a, _), (b, _))| {
        let (ball_a, ball_b) = (lift(&a), lift(&b));
        for ((_, float), (_, ball)) in operations().into_iter().zip(operations()) {
            law(&float(&a, &b), &ball(&ball_a, &ball_b), &finite)?;
        }
        law(&a.exp(), &ball_a.exp(), &finite)
    });
    finite.assert_one_in(2, "finite balls");
}

/// γₙ = nη/(1 − nη): n roundings in a row, of products, quotients and sums, change a term of a sum by no
/// more than γₙ times its size. (Nicholas Higham, Accuracy and Stability of Numerical Algorithms, §3.1.)
fn gamma(n: i32) -> Exact {
    let roundings = Exact::int(n) * Exact::power_of_two(-53);
    &roundings / (Exact::one() - &roundings)
}

#[test]
fn num_dual_and_ours_agree_with_the_exact_derivative_to_the_roundings_made() {
    // Six exponents of up to ±40 in a formula: nothing underflows.
    let positive =
        || floats(DOUBLE.within(-40, 40)).prop_map(|x| if x.is_zero() { Exact::one() } else { x.abs() });
    let any = || floats(DOUBLE.within(-40, 40));
    for_all((positive(), positive(), any(), any(), any(), positive()), |(c, m, g, l, h, eps)| {
        let exact = SpringMass { c, m, g, l, h };
        let system = exact.map(Binary64::float);
        let x = Binary64::float(&eps);

        let ours = penalty::deflection(&constants(&system), &Dual::variable(x));
        let SpringMass { c, m, g, l, h } = system.map(|&x| num_dual::Dual64::from_re(x));
        let eps_ = num_dual::Dual64::from_re(x).derivative();
        let theirs = (eps_ * (h - l) + m * g) / (c + eps_);
        let reference = penalty::deflection(&constants(&exact), &Dual::variable(eps.clone()));

        // u = n/s with n = εΔ + mg, s = c + ε; u′ = (n′s − n s′)/s² with n′ = Δ, s′ = 1. num-dual forms
        // (n′s − n s′)·(1/s)·(1/s): n′ takes 4 roundings (the difference, the product with ε′, the sums with
        // the zero derivatives of ε·Δ and mg), n 3, s 1, s′ 1, the products 1, their difference 1, each 1/s
        // 2, its product 1: at most 13 on a term. Ours forms (n′ − (n/s)s′)/s: fewer. So γ₁₆ covers both.
        let SpringMass { c, m, g, l, h } = &exact;
        let (gap, total) = ((h - l).abs(), c + &eps);
        let size = &eps * &gap + m * g.abs();
        let value_bound = gamma(16) * &size / &total;
        let derivative_bound = gamma(16) * (&gap * &total + &size) / (&total * &total);
        for (name, value, derivative) in
            [("ours", ours.value, ours.derivative), ("num-dual", theirs.re, theirs.eps)]
        {
            let [value, derivative] = [value, derivative].map(|x| x.to_exact().unwrap());
            prop_assert!((value - &reference.value).abs() <= value_bound, "{}", name);
            prop_assert!((derivative - &reference.derivative).abs() <= derivative_bound, "{}", name);
        }

        // And ours within the bound that it computes itself.
        let balls = constants(&system.map(|&x| Ball::exactly(x)));
        let bounded = penalty::deflection(&balls, &Dual::variable(Ball::exactly(x)));
        prop_assert_eq!((*bounded.value.value(), *bounded.derivative.value()), (ours.value, ours.derivative));
        prop_assert!(BallF64::stands_for(&bounded.value, &reference.value));
        prop_assert!(BallF64::stands_for(&bounded.derivative, &reference.derivative));
        prop_assert!(bounded.derivative.is_finite());
        Ok(())
    });
}

// ------------------------------------------------------------------------------------------------
// Spellings
// ------------------------------------------------------------------------------------------------

fn read(text: &str) -> Result<Exact, ParseError> {
    text.parse()
}

#[test]
fn every_spelling_is_read_exactly() {
    let ratio = |p: i64, q: i64| Ok(Exact::from(Rational::from((p, q))));
    for (text, p, q) in [
        ("0", 0, 1),
        ("-0", 0, 1),
        ("0.000", 0, 1),
        ("0e5", 0, 1),
        ("7", 7, 1),
        ("+7", 7, 1),
        ("007", 7, 1),
        ("-3", -3, 1),
        ("9.81", 981, 100),
        ("-9.81", -981, 100),
        (".5", 1, 2),
        ("-.5", -1, 2),
        ("5.", 5, 1),
        ("0.1", 1, 10),
        ("1e3", 1000, 1),
        ("1E3", 1000, 1),
        ("1e+3", 1000, 1),
        ("1e-3", 1, 1000),
        ("1e0003", 1000, 1),
        ("1e0", 1, 1),
        ("1e-0", 1, 1),
        ("2.50e1", 25, 1),
        ("-2.5e-1", -1, 4),
        (".5e1", 5, 1),
        ("5.e1", 50, 1),
        ("1/2", 1, 2),
        ("-1/2", -1, 2),
        ("+6/4", 3, 2),
        ("0/5", 0, 1),
        ("9007199254740993", 9_007_199_254_740_993, 1),
        ("0.30000000000000004", 30_000_000_000_000_004, 100_000_000_000_000_000),
    ] {
        assert_eq!(read(text), ratio(p, q), "{text}");
    }
}

#[test]
fn what_is_no_number_is_refused() {
    for text in [
        "NaN", "nan", "inf", "-inf", "Infinity", "1e", "1e+", "1e-", "e5", "e", ".", "-.", "+", "-", "--1",
        "+-1", "-+1", "1-", "1_000", "1,5", "1 000", " 1", "1 ", "\t1", "1\n", " ", "0x10", "0b1", "1f",
        "1.5.2", "1..2", "1e5.5", "1e5e5", "1e--5", "1e 5", ".e5", "1/2/3", "1.5/2", "1/2.5", "1e5/2",
        "1/1e5", "/2", "1/", "/", "1/-2", "-1/-2", "1/+2", "1 / 2", "½", "١", "１", "−1", "1\0", "x1", "one",
    ] {
        assert_eq!(read(text), Err(ParseError::NotANumber), "{text:?}");
        assert_eq!(Mpfr::parse(text, 53), Err(ParseError::NotANumber), "{text:?}");
    }
    assert_eq!(read(""), Err(ParseError::Empty));
    for text in ["1/0", "0/0", "-1/0", "1/000"] {
        assert_eq!(read(text), Err(ParseError::DivisionByZero), "{text:?}");
    }
}

/// At once: a number of 10¹² digits would not come back.
#[test]
fn exponents_beyond_100_000_are_refused_before_anything_is_allocated() {
    assert_eq!(MAX_EXPONENT, 100_000);
    let endless = format!("1e{}", "9".repeat(10_000));
    for text in
        ["1e100001", "1e-100001", "0e100001", "1.5e+100001", "1e999999999999", "-1e-999999999999", &endless]
    {
        assert_eq!(read(text), Err(ParseError::Exponent), "{text:.20}");
        assert_eq!(Mpfr::parse(text, 2), Err(ParseError::Exponent), "{text:.20}");
    }
    let large = Exact::from(Rational::from(Integer::from(Integer::u_pow_u(10, 100_000))));
    assert_eq!(read("1e100000").as_ref(), Ok(&large));
    assert_eq!(read("-1e-000100000"), Ok(-Exact::one() / large));
}

#[test]
fn numbers_too_large_or_too_small_for_a_float_are_refused_and_never_inf_or_zero() {
    let to_f32 = |text| read(text).and_then(|x| Ok(x.to_f32()?));
    let to_f64 = |text| read(text).and_then(|x| Ok(x.to_f64()?));
    fn overflow<F>(scalar: &'static str) -> Result<F, ParseError> {
        Err(RangeError::Overflow { scalar }.into())
    }
    fn underflow<F>(scalar: &'static str) -> Result<F, ParseError> {
        Err(RangeError::Underflow { scalar }.into())
    }
    for text in ["1e39", "-1e39", "3.4028236e38", "1e100000"] {
        assert_eq!(to_f32(text), overflow("f32"), "{text}");
    }
    for text in ["1e309", "-1.8e308", "1e100000"] {
        assert_eq!(to_f64(text), overflow("f64"), "{text}");
    }
    for text in ["7e-46", "-7e-46", "1e-100000"] {
        assert_eq!(to_f32(text), underflow("f32"), "{text}");
    }
    for text in ["2e-324", "-2e-324", "1e-100000"] {
        assert_eq!(to_f64(text), underflow("f64"), "{text}");
    }
    assert_eq!((to_f32("0e-5"), to_f64("-0.0")), (Ok(0.0), Ok(0.0)));
}

/// The standard library reads decimals with correct rounding, too.
#[test]
fn decimals_become_the_floats_that_the_standard_library_reads() {
    let decimal =
        (any::<bool>(), any::<u64>(), 0usize..20, -340..310).prop_map(|(negative, digits, point, e)| {
            let mut text = format!("{digits:020}");
            text.insert(point, '.');
            format!("{}{text}e{e}", if negative { "-" } else { "" })
        });
    for_all(decimal, |text| {
        let (exact, double) = (read(&text).unwrap(), text.parse::<f64>().unwrap());
        let in_range = double.is_finite() && double != 0.0;
        prop_assert!(in_range || exact.is_zero() || exact.to_f64().is_err());
        prop_assert!(!in_range || exact.to_f64() == Ok(double));
        let single = text.parse::<f32>().unwrap();
        let in_range = single.is_finite() && single != 0.0;
        prop_assert!(!in_range || exact.to_f32() == Ok(single));
        Ok(())
    });
}

#[test]
fn what_is_printed_reads_back_as_the_same_number() {
    for_all((Binary32::number(), Binary64::number(), rationals()), |((single, _), (double, _), exact)| {
        for text in [format!("{single}"), format!("{single:e}"), format!("{single:?}")] {
            prop_assert_eq!(read(&text).map(|x| x.to_f32()), Ok(Ok(single)), "{}", text);
        }
        for text in [format!("{double}"), format!("{double:e}"), format!("{double:?}")] {
            prop_assert_eq!(read(&text).map(|x| x.to_f64()), Ok(Ok(double)), "{}", text);
        }
        prop_assert_eq!(read(&exact.to_string()), Ok(exact));
        Ok(())
    });
    for_all(MpfrMixed::number(), |(x, _)| {
        let text = x.to_string();
        let read = match x.precision() {
            Some(bits) => Mpfr::parse(&text, bits).unwrap().to_exact(),
            None => Ok(read(&text).unwrap()),
        };
        prop_assert_eq!(read, x.to_exact(), "{}", text);
        Ok(())
    });
}

#[test]
fn mpfr_numbers_with_huge_exponents_read_back_as_far_as_exponents_are_read() {
    for text in ["1.5e99999", "-1.5e99999", "1.5e-99999", "-3.25e-99999"] {
        for bits in [2, 53, 200] {
            let x = Mpfr::parse(text, bits).unwrap();
            assert_eq!(Mpfr::parse(&x.to_string(), bits).unwrap(), x, "{x}");
        }
    }
    // 2^400000 has 120412 digits; as text it is short all the same.
    let beyond = Mpfr::rounded(53, Float::with_val(53, 1) << 400_000);
    assert!(beyond.to_string().ends_with("e120411") && beyond.to_string().len() < 30);
    assert_eq!(Mpfr::parse(&beyond.to_string(), 53), Err(ParseError::Exponent));
}

/// What `format!` can do with an f64 it does with an MPFR number.
#[test]
fn mpfr_numbers_are_padded_and_signed_like_floats() {
    fn shown(x: impl Display) -> [String; 8] {
        [
            format!("{x}"),
            format!("{x:+}"),
            format!("{x:12}|"),
            format!("{x:<12}|"),
            format!("{x:^12}|"),
            format!("{x:>12}|"),
            format!("{x:*>+12}|"),
            format!("{x:012}|"),
        ]
    }
    for x in [0.0, 1.0, -1.0, 1.5, -12.25, 1234.5, -1e6] {
        assert_eq!(shown(Mpfr::rounded(53, x)), shown(x), "{x}");
        assert_eq!(shown(Mpfr::rounded(200, x)), shown(x), "{x}");
    }
    for x in [0, 1, -1, 1234] {
        assert_eq!(shown(Mpfr::int(x)), shown(x), "{x}");
    }
    // Scientific, where the digits would begin or end with zeros; padded all the same.
    let small = Mpfr::rounded(53, -0.25);
    assert_eq!(shown(&small)[2..5], ["     -2.5e-1|", "-2.5e-1     |", "  -2.5e-1   |"]);
    assert_eq!(format!("{:e<8}|{:<+8}|", Mpfr::infinity(), Mpfr::infinity()), "infeeeee|+inf    |");
}

/// A tie goes to the even digit, which is f64's way.
#[test]
fn mpfr_numbers_have_as_many_decimals_as_asked_for() {
    fn shown(x: impl Display + std::fmt::Debug) -> [String; 9] {
        [
            format!("{x:.0}"),
            format!("{x:.1}"),
            format!("{x:.2}"),
            format!("{x:.5}"),
            format!("{x:.40}"),
            format!("{x:+012.3}|"),
            format!("{x:*<12.3}|"),
            format!("{x:>12.3}|"),
            format!("{x:.3?}|"),
        ]
    }
    let ties = [0.5, 1.5, 2.5, -2.5, -3.5, 0.25, 0.75, 0.125, 0.375, 1.0625, -0.03125];
    let others = [0.0, 1.0, -1.0, 9.81, 1.05, 0.1, -0.05, 999.999, -0.999_999, 1e-9, 1e22, 1e300, 5e-324];
    for x in ties.into_iter().chain(others) {
        assert_eq!(shown(Mpfr::rounded(53, x)), shown(x), "{x}");
        assert_eq!(shown(Mpfr::rounded(200, x)), shown(x), "{x}");
        assert_eq!(shown(Mpfr::constant(Rational::from_f64(x).unwrap())), shown(x), "{x}");
    }
    for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(shown(Mpfr::rounded(53, x)), shown(x), "{x}");
    }
    // Next to nothing has nothing to show, and is found out without writing it down.
    let tiny = Mpfr::rounded(53, Float::with_val(53, 1) >> 1_000_000_000);
    assert_eq!([format!("{tiny:.2}"), format!("{:.2}", -tiny)], ["0.00", "-0.00"]);
    // Beyond what any f64 holds: 1/3 in 200 bits is off in the 61st digit.
    let third = Mpfr::rounded(200, 1) / Mpfr::int(3);
    assert_eq!(format!("{third:.60}"), format!("0.{}", "3".repeat(60)));
}
