//! Sampling of cases: numbers are drawn from a seed, then adjusted until the hypotheses hold.
//!
//! A number is drawn as an integer mantissa and an integer exponent, so that a seed has the same meaning on
//! every machine.

use crate::chapter::system;
use crate::claims::{Case, Var, hypotheses};
use crate::eval::{Coordinates, Point, adjust};
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
    /// Subnormal parameters or products in f32.
    SubnormalSingle,
    /// Subnormal parameters or products in f64, out of the range of f32.
    SubnormalDouble,
}

const PROFILES: &[Profile] = &[
    Profile::Plain,
    Profile::Moderate,
    Profile::Grazing,
    Profile::Single,
    Profile::Stiff,
    Profile::Double,
    Profile::Tiny,
    Profile::SubnormalSingle,
    Profile::Huge,
    Profile::SubnormalDouble,
];

/// Subnormal quantities of a case. The other quantities are scaled so that no force, and no quotient of a
/// force and a stiffness, is rounded to 0; [`solve`](crate::solver::solve) returns an error for such a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Small {
    /// c and ε.
    Stiffnesses,
    /// m.
    Mass,
    /// g.
    Gravity,
    /// l and H.
    Lengths,
    /// m g and c Δ, with normal parameters.
    Products,
}

impl Small {
    const ALL: [Small; 5] =
        [Small::Stiffnesses, Small::Mass, Small::Gravity, Small::Lengths, Small::Products];

    /// Returns the exponents of two by which a quantity exceeds one of moderate magnitude, for f32 and for
    /// f64; `None` if it is subnormal.
    fn shift(self, var: Var) -> Option<[i32; 2]> {
        use Var::*;
        match (self, var) {
            (Small::Stiffnesses, C | Eps) | (Small::Mass, M) | (Small::Gravity, G) => None,
            (Small::Lengths, L | H) => None,
            (Small::Stiffnesses, L | H | U | V | Du | Tol) => Some([40, 500]),
            (Small::Stiffnesses, G | Lambda) => Some([-90, -550]),
            (Small::Mass, G) | (Small::Gravity, M) => Some([100, 1000]),
            (Small::Mass | Small::Gravity, L | H) => Some([-30, -30]),
            (Small::Lengths, C | Eps) => Some([60, 780]),
            (Small::Lengths, G) => Some([-60, -250]),
            (Small::Products, _) => Some([-56, -519]),
            _ => Some([0, 0]),
        }
    }
}

/// Random source of one case.
struct CaseSampler {
    random: Rand64,
    profile: Profile,
    /// Subnormal quantities, for the subnormal profiles.
    small: Small,
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
            Profile::SubnormalSingle => self.subnormal(var, 0, -149, 24),
            Profile::SubnormalDouble => self.subnormal(var, 1, -1074, 53),
            Profile::Moderate | Profile::Stiff | Profile::Grazing => (11, -18, 4),
            Profile::Single => (24, -32, -16),
            Profile::Double => (53, -60, -46),
            Profile::Huge => (11, 5, 25),
            Profile::Tiny => (11, -45, -25),
        };
        let mantissa = 1 + self.below(1 << bits);
        Exact::from(rug::Rational::from(mantissa) << self.between(low, high))
    }

    /// Returns the number of bits of the mantissa and the range of the exponent, for a subnormal case of
    /// floats of this precision, whose smallest number is 2^`smallest`. Subnormal numbers are multiples of
    /// four times that number, so that a unit four times as large (note 8) changes no digit.
    fn subnormal(&self, var: Var, float: usize, smallest: i32, precision: i32) -> (u32, i32, i32) {
        // Few digits, so that a product of two such numbers is small and not less than the smallest number.
        let digits = if self.small == Small::Products { 6 } else { 11 };
        match self.small.shift(var) {
            None => (11, smallest + 2, smallest + precision - 13),
            Some(shift) => (digits, -18 + shift[float], -12 + shift[float]),
        }
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
        if matches!(self.profile, Profile::SubnormalSingle | Profile::SubnormalDouble) {
            self.small = Small::ALL[self.below(Small::ALL.len() as u64) as usize];
        }
        let mut case = Case::of(|var| self.coordinate(var));
        if self.profile == Profile::Stiff {
            case.eps = case.system.c.abs() * Exact::power_of_two(self.between(-60, 60));
        }
        if self.profile == Profile::Grazing {
            let (reaction, grazing) = (self.next_to_grazing(&case), &hypotheses().grazing);
            if let Some(x) = grazing.solve(&|symbol| case.get_by_symbol(symbol), &reaction) {
                case.set(grazing.solved_for, x);
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
    let mut sampler = CaseSampler { random, profile, small: Small::Products };
    let mut case = sampler.raw();
    adjust(&mut case, hypotheses, |hypothesis, case| {
        let value = hypothesis.value.eval(&|symbol| case.get_by_symbol(symbol), &|_| None)?;
        Some(match hypothesis.relation {
            Relation::Zero => Exact::zero(),
            Relation::NonNegative if sampler.below(4) == 0 => Exact::zero(),
            _ if value.is_zero() => match sampler.next_to_grazing(case).abs() {
                tiny if profile == Profile::Grazing && !tiny.is_zero() => tiny,
                _ => sampler.magnitude(Var::Lambda),
            },
            _ => value.abs(),
        })
    })?;
    Some(case)
}

impl Coordinates for Case<Exact> {
    fn get(&self, symbol: &'static str) -> Exact {
        self.get_by_symbol(symbol)
    }

    fn set(&mut self, symbol: &'static str, x: Exact) {
        if let Some(var) = Var::named(symbol) {
            *self.get_mut(var) = x;
        }
    }
}

/// Returns the case with the coordinates of a point, with 1 for those that it does not contain.
pub(super) fn case_at(point: &Point) -> Case<Exact> {
    Case::of(|var| point.at(var.symbol()))
}

#[cfg(test)]
mod tests;
