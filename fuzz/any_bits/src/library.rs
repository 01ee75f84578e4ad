//! Properties of the library for arbitrary bytes: each function derives its arguments from them and panics if
//! a property is violated.

use crate::bytes::{Bytes, Number, method, plane, positive, system};
use num_traits::Zero;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use spring_mass_contact::number::{
    Exact, ExactText, MAX_EXPONENT, Mpfr, NumberSystem, ParseError, PositivePart, RangeError, Real, ToExact,
};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::rug::ops::Pow;
use spring_mass_contact::rug::{Integer, Rational};
use spring_mass_contact::solver::{
    Augmentation, Bounds, Interval, Iterate, Method, Outcome, Plane, ReadError, Solution, SolveError, State,
    advise, best_penalty, exact_augmentation_count, guaranteed_max_augmentations, is_convergence_guaranteed,
    kth_iterate, penalties, penalty_for_penetration, penalty_force_bound, required_precision, rounding_floor,
    series_penetration, solve, solve_observed, sweep,
};
use std::cmp::Ordering;
use std::sync::atomic::{AtomicBool, Ordering as AtomicOrdering};

/// Whether the arguments are printed.
pub static SHOWN: AtomicBool = AtomicBool::new(false);

fn show(arguments: impl FnOnce() -> String) {
    if SHOWN.load(AtomicOrdering::Relaxed) {
        println!("{}", arguments());
    }
}

fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("a finite number")
}

fn zero() -> Exact {
    Exact::zero()
}

/// Returns a text of arbitrary bytes, or of the characters of decimal or of hexadecimal numbers.
fn text(bytes: &mut Bytes) -> String {
    const DECIMAL: &[u8] = b"00123456789012345678901234567890123456789..//eE--+  _x\x00naif";
    const HEXADECIMAL: &[u8] = b"00123456789abcdefABCDEF0123456789abcdef...pP+-";
    if bytes.one_in(8) {
        return String::from_utf8_lossy(bytes.rest()).into_owned();
    }
    let (start, characters, mark) = if bytes.one_in(4) {
        (*bytes.pick(&["0x", "-0X", "+0x"]), HEXADECIMAL, 'p')
    } else {
        ("", DECIMAL, 'e')
    };
    let count = bytes.below(24);
    let mut text: String = start.to_string();
    text.extend((0..count).map(|_| char::from(*bytes.pick(characters))));
    // Else few would have an exponent that can be read.
    if bytes.one_in(2) {
        text += &format!("{mark}{}", bytes.bits() as i64 >> (16 + bytes.below(48)));
    }
    // More digits than any integer type has.
    if bytes.one_in(64) {
        text += &"9".repeat(bytes.below(64));
    }
    text
}

/// A number in decimal, scientific or hexadecimal notation: `mantissa · radix^exponent`.
struct Positional {
    mantissa: Exact,
    radix: i32,
    exponent: i64,
}

impl Positional {
    /// Returns the parts of a text; `None` if it is no such number.
    fn of(text: &str) -> Option<Self> {
        let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
        let is_hexadecimal = unsigned.get(..2).is_some_and(|start| start.eq_ignore_ascii_case("0x"));
        let (number, base, radix, marks) =
            if is_hexadecimal { (&unsigned[2..], 16, 2, ['p', 'P']) } else { (unsigned, 10, 10, ['e', 'E']) };
        let (digits, exponent) = number.split_once(marks).unwrap_or((number, "0"));
        let exponent = nearest_integer(exponent)?;
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        if whole.is_empty() && fraction.is_empty() {
            return None;
        }
        let mut mantissa = zero();
        for character in whole.chars().chain(fraction.chars()) {
            let digit = character.to_digit(base as u32)?;
            mantissa = mantissa * Exact::from(base) + Exact::from(digit as i32);
        }
        let mantissa = mantissa / power(base, fraction.len() as i64);
        Some(Positional {
            mantissa: if text.starts_with('-') { -mantissa } else { mantissa },
            radix,
            exponent,
        })
    }

    /// Returns `true` if this is the number x, which has an exponent that is allowed.
    fn is(&self, x: &Exact) -> bool {
        x * power(self.radix, -self.exponent) == &self.mantissa * power(self.radix, self.exponent)
    }
}

/// Returns the integer with these digits, or the nearest that fits.
fn nearest_integer(text: &str) -> Option<i64> {
    // Between digits, rug also accepts spaces and underscores.
    let is_integer = text.trim_start_matches(['+', '-']).bytes().all(|byte| byte.is_ascii_digit());
    let integer: Integer = if is_integer { text.parse().ok()? } else { return None };
    Some(integer.to_i64().unwrap_or(if integer < 0 { i64::MIN } else { i64::MAX }))
}

/// Returns a power; 1 for a negative exponent.
fn power(base: i32, exponent: i64) -> Exact {
    Exact::from(Rational::from(Integer::from(base).pow(exponent.max(0) as u32)))
}

/// Every notation is parsed exactly or rejected; the results for f32 and f64 are compared with Rust's.
pub fn parse(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let text = text(&mut bytes);
    show(|| format!("{text:?}"));
    let read = text.parse::<Exact>();
    let positional = Positional::of(&text);
    match &read {
        Ok(x) if text.contains('/') => {
            let (p, q) = text.split_once('/').expect("a fraction");
            let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            assert!(digits(p.trim_start_matches(['+', '-'])) && digits(q), "it is read");
            let [p, q] =
                [p, q].map(|text| Exact::from(Rational::from(text.parse::<Integer>().expect("digits"))));
            assert_eq!(x * q, p);
        }
        Ok(x) => {
            let positional = positional.expect("it is read");
            assert!(positional.exponent.abs() <= i64::from(MAX_EXPONENT));
            assert!(positional.is(x), "{x}");
            if positional.radix == 10 {
                nearest(x, text.parse().expect("a number"), "f64", x.to_f64());
                nearest(x, text.parse().expect("a number"), "f32", x.to_f32());
            }
        }
        Err(ParseError::Empty) => assert_eq!(text, ""),
        Err(ParseError::NotANumber) => assert!(positional.is_none(), "it is refused"),
        Err(ParseError::DivisionByZero) => assert!(text.trim_end_matches('0').ends_with('/')),
        Err(ParseError::Exponent) => {
            let exponent = positional.expect("a number").exponent;
            assert!(exponent.unsigned_abs() > u64::from(MAX_EXPONENT.unsigned_abs()));
        }
        Err(other) => panic!("{other:?}"),
    }
    let precision = 2 + bytes.below(63) as u32;
    assert_eq!(Mpfr::parse(&text, precision).map(drop), read.clone().map(drop));
    if let Ok(x) = &read
        && bytes.one_in(16)
        && x.bit_length() < 4000
    {
        written(x, precision);
    }
    if let Ok(system) = text.parse::<NumberSystem>() {
        assert_eq!(system.to_string().parse(), Ok(system));
    }
    let texts = SpringMass { c: "1", m: "1", g: &*text, l: "1", h: "1" };
    match (texts.parse(), &read) {
        (Ok(system), Ok(x)) => assert_eq!(system.g, *x),
        (Err(ReadError::NotANumber { argument: "gravity", value, reason }), Err(error)) => {
            assert_eq!((&value, &reason), (&text, error));
        }
        (other, _) => panic!("{other:?}"),
    }
}

/// Asserts that rounding agrees with Rust's, except for results that Rust makes infinite or zero.
fn nearest<T: ExactText + PartialEq + std::fmt::Debug>(
    x: &Exact,
    by_rust: T,
    name: &str,
    ours: Result<T, RangeError>,
) {
    match ours {
        Ok(own) => assert_eq!(own, by_rust),
        Err(RangeError::Overflow { scalar }) => assert!(scalar == name && by_rust.to_exact().is_err()),
        Err(RangeError::Underflow { scalar }) => {
            assert!(scalar == name && !x.is_zero() && exact(&by_rust).is_zero());
        }
        Err(other) => panic!("{other:?}"),
    }
}

/// Asserts that a formatted number parses to the same number, or to one in the direction of rounding.
fn written(x: &Exact, precision: u32) {
    assert_eq!(x.to_string().parse().as_ref(), Ok(x));
    let digits = 1 + precision as usize % 20;
    let [down, near, up] = [Round::Down, Round::Nearest, Round::Up].map(|round| {
        let text = x.decimal(digits, round);
        let mantissa = text.split('e').next().expect("a text");
        let significant = mantissa.trim_start_matches(['-', '0', '.']).trim_end_matches(['0', '.']);
        assert!(significant.bytes().filter(u8::is_ascii_digit).count() <= digits, "{text}");
        text.parse::<Exact>().expect("a number")
    });
    assert!(down <= *x && *x <= up && down <= near && near <= up);
    let rounded = x.to_mpfr(precision);
    assert_eq!(Mpfr::parse(&rounded.text(), precision), Ok(rounded.clone()));
    encloses(&rounded);
    x.to_f64().iter().for_each(encloses);
    x.to_f32().iter().for_each(encloses);
}

/// Asserts that the texts of an interval contain it.
fn encloses<T: Number>(point: &T) {
    let texts = Interval { lower: point.clone(), upper: point.clone() }.texts();
    let [lower, upper] = texts.map(|text| text.parse::<Exact>().expect("a number"));
    assert!(lower <= exact(point) && exact(point) <= upper, "{lower} to {upper}");
}

/// Asserts that both ends are finite and in order.
fn in_order<T: Number>(interval: &Interval<T>) {
    let Interval { lower, upper } = interval;
    assert!(lower.is_number() && upper.is_number() && lower <= upper, "{lower:?} to {upper:?}");
}

/// Names of arguments and whether they are valid, in the order of the checks.
struct Arguments(Vec<(&'static str, bool)>);

impl Arguments {
    fn of<T: Number>(system: &SpringMass<T>) -> Self {
        let SpringMass { c, m, g, l, h } = system;
        Arguments(Vec::new())
            .positive("stiffness", c)
            .positive("mass", m)
            .finite("gravity", g)
            .finite("free length", l)
            .finite("height", h)
    }

    fn with(mut self, name: &'static str, valid: bool) -> Self {
        self.0.push((name, valid));
        self
    }

    fn positive<T: Number>(self, name: &'static str, x: &T) -> Self {
        self.with(name, x.is_number() && *x > T::zero())
    }

    fn finite<T: Number>(self, name: &'static str, x: &T) -> Self {
        self.with(name, x.is_number())
    }

    /// Returns the first invalid argument.
    fn wrong(&self) -> Option<&'static str> {
        self.0.iter().find(|(_, valid)| !valid).map(|(name, _)| *name)
    }

    /// Asserts that an error names an invalid argument, and that there is no error otherwise.
    fn judge<R>(&self, result: Result<R, SolveError>) -> Option<R> {
        match result {
            Ok(result) => {
                assert_eq!(self.wrong(), None, "it is not refused");
                Some(result)
            }
            Err(SolveError::Invalid { argument, value, allowed }) => {
                assert!(self.0.contains(&(argument, false)), "{argument} {value}: must be {allowed}");
                None
            }
            Err(SolveError::OutOfRange { .. } | SolveError::TooLong { .. }) => {
                assert_eq!(self.wrong(), None, "it is not refused");
                None
            }
            Err(other) => panic!("{other:?}"),
        }
    }
}

/// Returns the exact deflection, penetration and contact force.
fn answer(system: &SpringMass<Exact>, method: &Method<Exact>, plane: Plane) -> [Exact; 3] {
    match (method, plane) {
        (Method::Penalty { .. }, Plane::Unilateral) if system::reaction(system) < zero() => {
            let u = structure::deflection(system);
            let p = contact::penetration(system, &u);
            [u, p, zero()]
        }
        (Method::Penalty { penalty: eps }, _) => [
            penalty::deflection(system, eps),
            penalty::penetration(system, eps),
            penalty::contact_force_at_equilibrium(system, eps),
        ],
        (_, Plane::Unilateral) => {
            let u = contact::deflection(system);
            let p = contact::penetration(system, &u);
            [u, p, contact::contact_force(system)]
        }
        (_, Plane::Bilateral) => [lagrange::deflection(system), zero(), lagrange::multiplier(system)],
    }
}

fn within<T: Number>(interval: &Interval<T>, answer: &Exact, what: &str) {
    let [lower, upper] = [&interval.lower, &interval.upper].map(exact);
    assert!(lower <= *answer && *answer <= upper, "the {what} {answer} is not between {lower} and {upper}");
}

fn exactly<T: Number>(method: &Method<T>) -> Method<Exact> {
    match method {
        Method::Lagrange => Method::Lagrange,
        Method::Penalty { penalty } => Method::Penalty { penalty: exact(penalty) },
        Method::Augmented { penalty, tolerance, max_augmentations, start } => Method::Augmented {
            penalty: exact(penalty),
            tolerance: exact(tolerance),
            max_augmentations: *max_augmentations,
            start: exact(start),
        },
    }
}

/// Tests every method with both planes.
pub fn solve_any<T: Number>(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let (sample, plane) = (bytes.byte(), plane(&mut bytes));
    let system = system::<T>(&mut bytes);
    let method = method::<T>(&mut bytes, if T::EXACT { 12 } else { 255 });
    let mut arguments = Arguments::of(&system);
    if let Some(penalty) = method.penalty() {
        arguments = arguments.positive("penalty", penalty);
    }
    let mut most = 0;
    if let Method::Augmented { tolerance, start, max_augmentations, .. } = &method {
        arguments = arguments.positive("tolerance", tolerance).finite("initial multiplier", start);
        most = *max_augmentations;
    }
    show(|| format!("{system:?} {method:?} {plane:?}"));
    let mut steps = 0;
    let solved = solve_observed(&system, &method, plane, |step| {
        assert_eq!(step.k, steps);
        steps += 1;
    });
    let Some(solution) = arguments.judge(solved) else { return };
    let Solution {
        state,
        outcome,
        deflection,
        penetration,
        contact_force,
        multiplier,
        augmentations,
        floor,
        bounds,
        ..
    } = &solution;
    assert!(
        [deflection, penetration, contact_force].into_iter().chain(multiplier).chain(floor).all(T::is_number)
    );
    assert!(plane == Plane::Bilateral || *contact_force >= T::zero(), "the plane pulls");
    let Bounds { deflection: u, penetration: p, contact_force: n, .. } = bounds;
    in_order(u);
    in_order(p);
    in_order(n);
    let augmented = matches!(method, Method::Augmented { .. });
    assert_eq!((*outcome == Outcome::Direct, augmentations.is_some()), (!augmented, augmented));
    assert_eq!(floor.is_some(), *outcome == Outcome::Stagnated);
    assert_eq!(multiplier.is_none(), matches!(method, Method::Penalty { .. }));
    assert!(augmentations.is_none_or(|k| k <= most && k + 1 == steps));
    if sample % 64 != 0 && !T::EXACT {
        return;
    }
    solution.certificate(&system).expect("a solution is finite");
    let (system, method) = (system.map(exact), exactly(&method));
    assert_eq!(*state, state_of(&system));
    let answers = answer(&system, &method, plane);
    within(u, &answers[0], "deflection");
    within(p, &answers[1], "penetration");
    within(n, &answers[2], "contact force");
    let off = (exact(deflection) - &answers[0]).abs();
    if let (Outcome::Converged, Method::Augmented { tolerance, .. }) = (outcome, &method) {
        assert!(off < *tolerance, "it did not converge");
    }
    assert!(floor.as_ref().is_none_or(|floor| exact(floor) >= zero()));
}

fn state_of(system: &SpringMass<Exact>) -> State {
    match system::reaction(system).cmp(&zero()) {
        Ordering::Less => State::Separated,
        Ordering::Equal => State::Grazing,
        Ordering::Greater => State::Contact,
    }
}

/// Tests a function other than `solve`, in one of the number systems.
pub fn functions(bytes: &[u8]) {
    let bytes = &mut Bytes(bytes);
    macro_rules! any {
        ($holds:ident, $($Number:ty),*) => {{
            let holds: &[fn(&mut Bytes)] = &[$($holds::<$Number>),*];
            bytes.pick(holds)(bytes)
        }};
    }
    match bytes.below(8) {
        0 => any!(advised, f32, f64, Mpfr, Exact),
        1 => any!(swept, f32, f64, Mpfr, Exact),
        2 => any!(iterated, f32, f64, Mpfr, Exact),
        3 => any!(counted, f32, f64, Mpfr, Exact),
        4 => any!(floored, f32, f64, Mpfr, Exact),
        5 => any!(in_series, f32, f64, Mpfr),
        6 => any!(best, f32, f64, Mpfr, Exact),
        _ => spaced(bytes),
    }
}

/// Returns `true` if the method meets the tolerance.
fn reaches(solution: &Solution<impl Number>, system: &SpringMass<Exact>, tolerance: &Exact) -> bool {
    let off = (exact(&solution.deflection) - contact::deflection(system)).abs();
    solution.outcome != Outcome::Stagnated && solution.outcome != Outcome::IterationLimit && off < *tolerance
}

/// Asserts that each recommended method meets the tolerance.
fn advised<T: Number>(bytes: &mut Bytes) {
    let (system, tolerance) = (system::<T>(bytes), positive::<T>(bytes));
    let arguments = Arguments::of(&system).positive("tolerance", &tolerance);
    show(|| format!("{system:?} tol {tolerance:?}"));
    let Some(advice) = arguments.judge(advise(&system, &tolerance)) else { return };
    let (exact_system, tol) = (system.map(exact), exact(&tolerance));
    assert_eq!(advice.state, state_of(&exact_system));
    assert!(advice.floor.is_none_or(|floor| floor >= zero()));
    for choice in &advice.recommendations {
        let solution = solve(&system, &choice.method).expect("what has been tried");
        assert!(reaches(&solution, &exact_system, &tol), "{:?} does not reach it", choice.method);
        assert_eq!(solution.augmentations, choice.augmentations);
        let [from, to] = choice.penalty_range.each_ref().map(Option::as_ref);
        match choice.method.penalty() {
            None => assert!(from.is_none() && to.is_none()),
            Some(eps) => assert!(from.is_none_or(|from| from <= eps) && to.is_none_or(|to| eps <= to)),
        }
        for eps in [from, to].into_iter().flatten() {
            let method = match choice.method.clone() {
                Method::Lagrange => Method::Lagrange,
                Method::Penalty { .. } => Method::Penalty { penalty: eps.clone() },
                Method::Augmented { tolerance, max_augmentations, start, .. } => {
                    // In rationals, and in constants of MPFR, a thousand steps would be too long.
                    if eps.number_system() == NumberSystem::Exact {
                        continue;
                    }
                    Method::Augmented { penalty: eps.clone(), tolerance, max_augmentations, start }
                }
            };
            let solution = solve(&system, &method).expect("what has been tried");
            assert!(reaches(&solution, &exact_system, &tol), "{method:?} does not reach it");
        }
        assert!(
            choice.force_error >= zero() && choice.relative_force_error.as_ref().is_none_or(|x| *x >= zero())
        );
    }
}

fn swept<T: Number>(bytes: &mut Bytes) {
    let system = system::<T>(bytes);
    let eps = [(); 3].map(|()| positive::<T>(bytes));
    show(|| format!("{system:?} {eps:?}"));
    let arguments = |eps| Arguments::of(&system).positive("penalty", eps);
    for (row, eps) in sweep(&system, eps.clone()).zip(&eps) {
        let Some(row) = arguments(eps).judge(row) else { continue };
        let numbers = [&row.penalty, &row.deflection, &row.penetration, &row.contact_force];
        assert!(numbers.into_iter().chain(&row.penalty_force).all(T::is_number) && row.penalty == *eps);
        assert!(
            [&row.force_error, &row.penalty_force_error].into_iter().flatten().all(|error| *error >= zero())
        );
    }
    let tolerance = positive::<T>(bytes);
    let arguments = Arguments::of(&system).positive("tolerance", &tolerance);
    if let Some(Some(eps)) = arguments.judge(penalty_for_penetration(&system, &tolerance)) {
        assert!(eps.is_number() && eps > T::zero());
    }
}

/// Asserts that the k-th iterate is within its bounds.
fn iterated<T: Number>(bytes: &mut Bytes) {
    let (system, eps) = (system::<T>(bytes), positive::<T>(bytes));
    let start = if bytes.one_in(3) { T::zero() } else { T::any(bytes) };
    let plane = plane(bytes);
    let k = bytes.bits() >> bytes.below(64);
    // In between rationals take seconds, until they are refused.
    let k = if T::EXACT && k >> 40 == 0 { k % 64 } else { k };
    let arguments = Arguments::of(&system).positive("penalty", &eps).finite("initial multiplier", &start);
    show(|| format!("{system:?} ε {eps:?} λ₀ {start:?} k {k} {plane:?}"));
    let Some(step) = arguments.judge(kth_iterate(&system, &eps, &start, k, plane)) else { return };
    let Iterate { multiplier, deflection, penetration, contact_force, .. } = &step;
    in_order(multiplier);
    in_order(deflection);
    in_order(penetration);
    in_order(contact_force);
    if k > 6 {
        return;
    }
    let (system, eps) = (system.map(exact), exact(&eps));
    let mut steps = Augmentation::new(&system, &eps).with_multiplier(exact(&start)).over(plane);
    let last = steps.nth(k as usize).expect("there always is one");
    assert_eq!(step.k, last.k);
    within(multiplier, &last.multiplier, "multiplier");
    within(deflection, &last.deflection, "deflection");
    within(penetration, &last.penetration, "penetration");
    within(contact_force, &last.contact_force, "contact force");
}

/// Returns a unit roundoff of any precision, or an invalid one.
fn unit_roundoff(bytes: &mut Bytes) -> Exact {
    match bytes.below(8) {
        0 => zero(),
        1 => Exact::any(bytes).abs(),
        _ => Exact::power_of_two(-(bytes.below(70) as i32)),
    }
}

/// Asserts that the count is the first step that meets the tolerance.
fn counted<T: Number>(bytes: &mut Bytes) {
    let (system, eps, tolerance) = (system::<T>(bytes), positive::<T>(bytes), positive::<T>(bytes));
    let (start, plane) = (T::any(bytes), plane(bytes));
    show(|| format!("{system:?} eps {eps:?} tol {tolerance:?} start {start:?} {plane:?}"));
    let arguments = Arguments::of(&system).positive("penalty", &eps).positive("tolerance", &tolerance);
    let eta = unit_roundoff(bytes);
    let promised = arguments.judge(guaranteed_max_augmentations(&system, &eps, &tolerance, &eta));
    let reaches = arguments.judge(is_convergence_guaranteed(&system, &eps, &tolerance, &eta));
    if let (Some(promised), Some(reaches)) = (promised, reaches) {
        assert_eq!(promised.is_some(), reaches);
        assert!(promised.is_none_or(|count| count >= 0));
    }
    let arguments = arguments.with("initial multiplier", start.is_number());
    let needed = exact_augmentation_count(&system, &eps, &tolerance, &start, plane);
    let Some(needed) = arguments.judge(needed) else { return };
    let (system, eps, tol) = (system.map(exact), exact(&eps), exact(&tolerance));
    let Some(k) = needed.to_usize().filter(|k| *k < 6) else {
        assert!(needed > 0);
        return;
    };
    let steps = Augmentation::new(&system, &eps).with_multiplier(exact(&start)).over(plane);
    let residuals = steps.map(|step| match plane {
        Plane::Unilateral => augmented::natural_residual(&system, &eps, &step.multiplier, &step.deflection),
        Plane::Bilateral => step.penetration,
    });
    assert_eq!(residuals.take(k + 1).position(|residual| residual.abs() < tol), Some(k));
}

fn floored<T: Number>(bytes: &mut Bytes) {
    let (system, tolerance) = (system::<T>(bytes), positive::<T>(bytes));
    let (plane, eta) = (plane(bytes), unit_roundoff(bytes));
    show(|| format!("{system:?} tol {tolerance:?} η = {eta}"));
    let arguments = Arguments::of(&system);
    let Some(floor) = arguments.judge(rounding_floor(&system, plane, &eta)) else { return };
    assert!(floor.is_none_or(|floor| floor >= zero()));
    let (system, Ok(tol)) = (system.map(exact), tolerance.to_exact()) else { return };
    let arguments = arguments.with("tolerance", tol > zero());
    if let Some(Some(bits)) = arguments.judge(required_precision(&system, plane, &tol)) {
        let rounded = |x: &Exact| x.round_to_bits(bits).expect("some bits");
        let floor = rounding_floor(&system.map(rounded), plane, &NumberSystem::Mpfr(bits).unit_roundoff());
        assert!(floor.unwrap().is_some_and(|floor| floor < rounded(&tol)));
    }
}

/// Asserts that the root has the sign of the reaction.
fn in_series<T: Number + Real>(bytes: &mut Bytes) {
    let system = system::<T>(bytes);
    let eps = if bytes.one_in(3) { T::zero() } else { positive(bytes) };
    let higher: Vec<T> = (0..bytes.below(4)).map(|_| positive(bytes)).collect();
    let mut arguments = Arguments::of(&system);
    let coefficient = |x: &T| x.is_number() && *x >= T::zero();
    arguments = arguments.with("penalty", coefficient(&eps));
    arguments = arguments.with("higher penalty", higher.iter().all(coefficient));
    arguments = arguments.with("penalties", higher.iter().chain([&eps]).any(|x| *x > T::zero()));
    let parameters = [&system.c, &system.m, &system.g, &system.l, &system.h].map(ToExact::number_system);
    let rounds =
        parameters.into_iter().chain([eps.number_system()]).any(|system| system != NumberSystem::Exact);
    show(|| format!("{system:?} ε {eps:?} {higher:?}"));
    match series_penetration(&system, &eps, &higher) {
        Err(SolveError::Invalid { argument: "system", .. }) => {
            assert!(arguments.wrong().is_none() && !rounds)
        }
        result => {
            let Some(p) = arguments.judge(result) else { return };
            let r = system::reaction(&system.map(exact));
            assert_eq!(exact(&p).cmp(&zero()), r.cmp(&zero()));
        }
    }
}

fn best<T: Number>(bytes: &mut Bytes) {
    let (system, eps) = (system::<T>(bytes), positive::<T>(bytes));
    let eta = unit_roundoff(bytes);
    show(|| format!("{system:?} eps {eps:?} η = {eta}"));
    let arguments = Arguments::of(&system);
    if let Some(Some(best)) = arguments.judge(best_penalty(&system, &eta)) {
        assert!(best.is_number() && best > T::zero());
        assert!(penalty_force_bound(&system, &best, &eta).unwrap().is_some());
    }
    let arguments = arguments.positive("penalty", &eps);
    let Some(bound) = arguments.judge(penalty_force_bound(&system, &eps, &eta)) else { return };
    assert_eq!(bound.is_some(), state_of(&system.map(exact)) == State::Contact);
    assert!(bound.is_none_or(|bound| bound > zero()));
}

/// Asserts that penalties increase from one end to the other.
fn spaced(bytes: &mut Bytes) {
    let [from, to] = [(); 2].map(|()| Exact::any(bytes));
    let points = bytes.below(70);
    let arguments = Arguments(vec![
        ("first penalty", from > zero()),
        ("last penalty", from < to),
        ("number of penalties", points >= 2),
    ]);
    show(|| format!("{from} to {to}, {points}"));
    match penalties(&from, &to, points as u32) {
        // So near to one another that a hundred digits do not distinguish them.
        Err(SolveError::Invalid { argument: "last penalty", .. }) if arguments.wrong().is_none() => {
            assert!((&to - &from) / &to < Exact::power_of_two(-300));
        }
        result => {
            let Some(list) = arguments.judge(result) else { return };
            assert!(list.len() == points && list.first() == Some(&from) && list.last() == Some(&to));
            assert!(list.is_sorted_by(|a, b| a < b));
        }
    }
}
