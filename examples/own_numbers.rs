//! Own numbers for `solve`. A float with `Float` of num-traits takes one line, `system.map(Native)`: here f16.
//! Anything else is a number system of its own: here fixed-point decimals, nanometres and nanonewtons.
//!
//! Its numbers are read and rounded in decimals, so that 0.05 is 0.05. Prints
//!
//! ```text
//! u = 0.0498 m in f16, where 1.05 − 1 is 51/1024
//! u = 0.050000000 m, N = 4.810000000 N, for certain 4.810000000 to 4.810000000; direct
//! u = 0.094953271 m, N = 0.314672900 N, for certain 0.314672897 to 0.314672898; direct
//! u = 0.050000006 m, N = 4.809999400 N, for certain 4.810000000 to 4.810000000; converged
//! ```

use half::f16;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::num_traits::{One, Zero};
use spring_mass_contact::number::{Exact, ExactText, Field, Native, OrderedField, PositivePart, ToExact};
use spring_mass_contact::operators;
use spring_mass_contact::rug::Rational;
use spring_mass_contact::solver::laws::{self, LawViolation};
use spring_mass_contact::solver::{Interval, Method, Scalar, SolveError, solve};
use std::cmp::Ordering;
use std::error::Error;
use std::fmt;

/// A number of billionths. A result out of range stays out of range.
#[derive(Clone, PartialEq, PartialOrd)]
struct Nano(i128);

const UNITS: i128 = 1_000_000_000;
const BEYOND: i128 = i128::MAX;

impl Nano {
    fn exact(&self) -> Exact {
        Rational::from((self.0, UNITS)).into()
    }

    /// Rounds to billionths in the given direction.
    fn rounded(x: Exact, integer: fn(Rational) -> Rational) -> Self {
        let units = integer(Rational::from(x) * UNITS);
        Nano(units.numer().to_i128().unwrap_or(if *units.numer() < 0 { -BEYOND } else { BEYOND }))
    }

    /// Returns the result of an operation, rounded to nearest.
    fn with(&self, other: &Self, operation: fn(Exact, Exact) -> Exact) -> Self {
        match [self, other].into_iter().find(|x| !x.is_finite()) {
            Some(beyond) => beyond.clone(),
            None => Nano::rounded(operation(self.exact(), other.exact()), Rational::round),
        }
    }
}

impl fmt::Debug for Nano {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (sign, size) = (if self.0 < 0 { "-" } else { "" }, self.0.unsigned_abs());
        write!(f, "{sign}{}.{:09}", size / UNITS as u128, size % UNITS as u128)
    }
}

// 1. Arithmetic, for the formulas.
operators! { [] Nano;
    Add add |a, b| a.with(b, |x, y| x + y);
    Sub sub |a, b| a.with(b, |x, y| x - y);
    Mul mul |a, b| a.with(b, |x, y| x * y);
    Div div |a, b| if b.is_zero() { Nano(BEYOND) } else { a.with(b, |x, y| x / y) };
    - |a| Nano(-a.0)
}
impl Zero for Nano {
    fn zero() -> Self {
        Nano(0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
}
impl One for Nano {
    fn one() -> Self {
        Nano(UNITS)
    }
}
impl Field for Nano {
    fn int(n: i32) -> Self {
        Nano(UNITS * i128::from(n))
    }
}

// 2. Order, for unilateral contact.
impl PositivePart for Nano {
    fn positive_part(&self) -> Self {
        Nano(self.0.max(0))
    }
    fn min(&self, other: &Self) -> Self {
        Nano(self.0.min(other.0))
    }
}
impl OrderedField for Nano {}

// 3. Bounds, for `solve`: rationals enclose exactly, and the result is rounded outwards.
impl Scalar for Nano {
    type Enclosure = Exact;
    fn enclose(&self) -> Exact {
        self.exact()
    }
    fn interval(x: &Exact) -> Interval<Self> {
        Interval {
            lower: Nano::rounded(x.clone(), Rational::floor),
            upper: Nano::rounded(x.clone(), Rational::ceil),
        }
    }
    fn magnitude(x: &Exact) -> Self {
        Nano::rounded(x.abs(), Rational::ceil)
    }
    fn sign(x: &Exact) -> Option<Ordering> {
        Exact::sign(x)
    }
    fn power(x: &Exact, k: u64) -> Option<Exact> {
        Exact::power(x, k)
    }
    fn is_finite(&self) -> bool {
        self.0.abs() < BEYOND
    }
    fn sign_of_sum(plus: [(&Self, &Self); 2], minus: (&Self, &Self)) -> Ordering {
        let product = |(a, b): (&Nano, &Nano)| a.exact() * b.exact();
        (product(plus[0]) + product(plus[1])).cmp(&product(minus))
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let rounded = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 }.map(f16::from_f64);
    let in_half = rounded.map(Native);
    let u = solve(&in_half, &Method::Lagrange)?.deflection;
    println!("u = {} m in f16, where 1.05 − 1 is {}", u.text(), u.to_exact()?);

    laws_hold()?;
    let system = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse()?;
    solve_in_decimals(&system.map(|x| Nano::rounded(x.clone(), Rational::round)))?;
    Ok(())
}

/// Tests the requirements of `solve`.
fn laws_hold() -> Result<(), LawViolation> {
    let samples = [0, 1, -1, 2, 3, UNITS, UNITS + 1, UNITS / 3, -UNITS / 7, 12_345_678_901_234_567].map(Nano);
    laws::check_scalar_laws(&samples, Nano::exact)
}

fn solve_in_decimals(system: &SpringMass<Nano>) -> Result<(), SolveError> {
    let eps = Nano::int(100);
    let tolerance = Nano(10);
    for method in [
        Method::Lagrange,
        Method::Penalty { penalty: Nano::int(7) },
        Method::Augmented { penalty: eps, tolerance, max_augmentations: 99, start: Nano::zero() },
    ] {
        let answer = solve(system, &method)?;
        let (u, n, force) = (answer.deflection, answer.contact_force, answer.bounds.contact_force);
        println!(
            "u = {u:?} m, N = {n:?} N, for certain {:?} to {:?}; {}",
            force.lower, force.upper, answer.outcome
        );
    }
    Ok(())
}
