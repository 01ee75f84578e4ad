//! Sampling of cases: numbers are drawn from a seed, then adjusted until the hypotheses hold.
//!
//! A number is drawn as an integer mantissa and an integer exponent, so that a seed has the same meaning on
//! every machine.

use super::experiments::unit;
use crate::chapter::system;
use crate::claims::{Case, Var, hypotheses};
use crate::eval::Point;
use crate::formula::{Hypothesis, Relation};
use crate::number::{Exact, PositivePart};
use num_traits::Zero;
use oorandom::Rand64;

/// Magnitudes and special properties of the numbers of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Profile {
    /// Integers from 1 to 9.
    Plain,
    /// Few digits, few decades.
    Moderate,
    /// All the digits of an f32.
    Single,
    /// All the digits of an f64.
    Double,
    /// ε/c from 2⁻⁶⁰ to 2⁶⁰.
    Stiff,
    /// R = 0, or one unit in the last place of c Δ beside it, in f32 or in f64.
    Grazing,
    /// Large numbers.
    Huge,
    /// Small numbers.
    Tiny,
    /// Moderate numbers in units in which some of them, or their products, are subnormal floats: the powers of two of
    /// length, mass and force, one of which is drawn. No other quantity leaves the range, and no force is rounded to 0,
    /// for which [`solve`](crate::solver::solve) returns an error.
    Subnormal(&'static [[i32; 3]]),
}

const PROFILES: &[Profile] = &[
    Profile::Plain,
    Profile::Moderate,
    Profile::Grazing,
    Profile::Single,
    Profile::Stiff,
    Profile::Double,
    Profile::Tiny,
    // Subnormal are c and ε; m; g; the lengths; and the products m g and c Δ. In f32, then in f64.
    Profile::Subnormal(&[[40, 0, -89], [-30, -129, -30], [-30, 99, -30], [-129, -10, -70], [-56, -56, -112]]),
    Profile::Huge,
    Profile::Subnormal(&[
        [500, 0, -554],
        [-30, -1054, -30],
        [-30, 1024, -30],
        [-1054, 0, -250],
        [-519, -519, -1038],
    ]),
];

/// Random source of one case.
struct CaseSampler {
    random: Rand64,
    profile: Profile,
    /// Powers of two of the units of length, mass and force.
    units: [i32; 3],
}

impl CaseSampler {
    fn below(&mut self, n: u64) -> u64 {
        self.random.rand_range(0..n)
    }

    fn between(&mut self, low: i32, high: i32) -> i32 {
        low + self.below((high - low + 1) as u64) as i32
    }

    /// Draws a positive number.
    fn magnitude(&mut self, var: Var) -> Exact {
        let (bits, low, high) = match self.profile {
            Profile::Plain => return Exact::from(self.between(1, 9)),
            // Multiples of four times the smallest float, so that a unit four times as large (note 8) changes no digit;
            // a product of two such numbers is a float, too.
            Profile::Subnormal(_) => (6, -18, -12),
            Profile::Moderate | Profile::Stiff | Profile::Grazing => (11, -18, 4),
            Profile::Single => (24, -32, -16),
            Profile::Double => (53, -60, -46),
            Profile::Huge => (11, 5, 25),
            Profile::Tiny => (11, -45, -25),
        };
        let mantissa = 1 + self.below(1 << bits);
        let exponent = self.between(low, high) + unit(self.units, var);
        Exact::from(rug::Rational::from(mantissa)) * Exact::power_of_two(exponent)
    }

    /// Draws a dimensionless number of moderate magnitude.
    fn pure(&mut self) -> Exact {
        Exact::from(self.between(1, 32)) / Exact::from(8)
    }

    fn coordinate(&mut self, var: Var) -> Exact {
        let size = match var {
            Var::Alpha | Var::Q | Var::T => self.pure(),
            Var::K => Exact::from(self.between(1, 50)),
            _ => self.magnitude(var),
        };
        match (var, self.below(8)) {
            (Var::C | Var::M | Var::Eps | Var::Tol | Var::Q | Var::T | Var::K, 0) => -size,
            (Var::C | Var::M | Var::Eps | Var::Tol | Var::Q | Var::T | Var::K, _) => size,
            (_, 0) => Exact::zero(),
            (_, 1..=3) => -size,
            _ => size,
        }
    }

    /// Returns 0, or plus or minus one unit in the last place of c Δ in f32 or f64.
    fn next_to_grazing(&mut self, case: &Case<Exact>) -> Exact {
        let force = (&case.system.c * system::gap(&case.system)).abs();
        match self.below(5) {
            0 => Exact::zero(),
            1 => force * Exact::power_of_two(-23),
            2 => -force * Exact::power_of_two(-23),
            3 => force * Exact::power_of_two(-52),
            _ => -force * Exact::power_of_two(-52),
        }
    }

    fn raw(&mut self) -> Case<Exact> {
        if let Profile::Subnormal(units) = self.profile {
            self.units = units[self.below(units.len() as u64) as usize];
        }
        let mut case = Case::of(|var| self.coordinate(var));
        if self.profile == Profile::Stiff {
            case.eps = case.system.c.abs() * Exact::power_of_two(self.between(-60, 60));
        }
        if self.profile == Profile::Grazing {
            let (reaction, grazing) = (self.next_to_grazing(&case), &hypotheses().grazing);
            let solved_for = Var::named(grazing.solved_for).expect("a coordinate");
            if let Some(x) = grazing.solve(&|symbol| case.get_by_symbol(symbol), &reaction) {
                *case.get_mut(solved_for) = x;
            }
        }
        case
    }
}

/// Returns case number `index` of a seed with the hypotheses satisfied; `None` if it cannot be adjusted to
/// them.
pub(super) fn case(seed: u64, index: u64, hypotheses: &[Hypothesis]) -> Option<Case<Exact>> {
    let profile = PROFILES[(index % PROFILES.len() as u64) as usize];
    let random = Rand64::new((u128::from(seed) << 64) | u128::from(index));
    let mut sampler = CaseSampler { random, profile, units: [0; 3] };
    let case = point_at(&sampler.raw()).adjusted_to(hypotheses, |hypothesis, point| {
        let value = hypothesis.value.eval(&|symbol| point.at(symbol), &|_| None)?;
        Some(match hypothesis.relation {
            Relation::Zero => Exact::zero(),
            Relation::NonNegative if sampler.below(4) == 0 => Exact::zero(),
            _ if value.is_zero() => match sampler.next_to_grazing(&case_at(point)).abs() {
                tiny if profile == Profile::Grazing && !tiny.is_zero() => tiny,
                _ => sampler.magnitude(Var::Lambda),
            },
            _ => value.abs(),
        })
    })?;
    Some(case_at(&case))
}

fn point_at(case: &Case<Exact>) -> Point {
    Point::new(Var::ALL.iter().map(|var| (var.symbol(), case.get(*var).clone())))
}

/// Returns the case with the coordinates of a point, with 1 for those that it does not contain.
pub(super) fn case_at(point: &Point) -> Case<Exact> {
    Case::of(|var| point.at(var.symbol()))
}

#[cfg(test)]
mod tests;
