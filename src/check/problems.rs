//! Test systems of all kinds that may be difficult for a solver, as decimals with few digits.
//!
//! A number is drawn as an integer and a power of ten, so that a seed has the same meaning on every machine,
//! and has at most [`DIGITS`] digits, so that its text is exact.

use super::scales::{decimal, scales, short};
use crate::chapter::{SpringMass, contact, penalty, structure};
use crate::number::{Exact, PositivePart};
use crate::solver::{Method, Solution, SolveError, State, solve};
use num_traits::{One, Zero};
use oorandom::Rand64;
use rug::float::Round;
use strum::{Display, EnumString, IntoStaticStr, VariantArray};

/// Largest number of significant decimal digits of a parameter, since some parsers read only short fields.
pub const DIGITS: usize = 12;

/// Exponents of ten at which the decades of [`Family::Graded`] begin.
const GRADES: std::ops::Range<i32> = -9..-1;

/// The preferred numbers of IEC 60063, E24, times ten: 24 per decade in about equal ratios.
const E24: [i32; 24] =
    [10, 11, 12, 13, 15, 16, 18, 20, 22, 24, 27, 30, 33, 36, 39, 43, 47, 51, 56, 62, 68, 75, 82, 91];

/// The signs of g, H, l and H − l with the state, 1 in contact, in all combinations that exist; and two with l = 0.
const SIGNS: [[i32; 5]; 20] = [
    [1, 1, 1, 1, 1],
    [-1, 1, 1, 1, 0],
    [1, 1, 1, -1, 1],
    [-1, 1, 1, -1, 1],
    [1, 1, 1, 1, 0],
    [-1, 1, 1, -1, 0],
    [1, 1, -1, 1, 1],
    [-1, 1, -1, 1, 0],
    [1, 1, -1, 1, 0],
    [-1, -1, 1, -1, 1],
    [1, -1, 1, -1, 1],
    [-1, -1, 1, -1, 0],
    [1, -1, -1, 1, 1],
    [-1, -1, -1, 1, 0],
    [1, -1, -1, 1, 0],
    [-1, -1, -1, -1, 1],
    [1, -1, -1, -1, 1],
    [-1, -1, -1, -1, 0],
    [1, -1, 0, -1, 1],
    [-1, 1, 0, 1, 0],
];

/// Family of test systems.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Display, EnumString, IntoStaticStr, VariantArray,
)]
#[strum(serialize_all = "snake_case", parse_err_ty = UnknownFamily, parse_err_fn = unknown_family)]
pub enum Family {
    /// Ordinary systems in contact.
    Contact,
    /// Ordinary separated systems.
    Separated,
    /// R = 0: mass and plane touch without force.
    Grazing,
    /// R as close to 0 as [`DIGITS`] digits of one parameter allow, on either side.
    Near,
    /// H < l: the spring must be compressed for the mass to fit above the plane.
    Overlap,
    /// g < 0: the weight acts upwards.
    Lifted,
    /// c from 10⁷ to 10¹⁰ N/m, and gaps from below a nanometre to a millimetre.
    Stiff,
    /// c from 10⁻⁴ to 10⁻¹ N/m.
    Soft,
    /// |l| and |H| of kilometres, and gaps of at most a metre.
    Far,
    /// c, m, l and the gap from 10⁶ to 10¹⁴ SI units. There are twice as many as in another family, so that three or
    /// more answers show a border.
    Huge,
    /// c, m, l and the gap from 10⁻¹⁴ to 10⁻⁶ SI units, also twice as many.
    Tiny,
    /// |R| from 10⁻⁹ to 10⁻¹ of |m g| + |c (H − l)|, on either side, where an internal
    /// tolerance of the solver decides. Each decade has as many systems as another family.
    Graded,
    /// Every combination of the signs of g, H − l, H and l with a state in turn, also l = 0; g is ±9.81 or
    /// ±9.80665 m/s². There are four times as many as in another family.
    Signed,
    /// A system of [`Family::Contact`] with one parameter larger by a thousandth, so that an answer to another
    /// request is wrong. There are three times as many as in another family.
    Neighbour,
}

impl Family {
    /// All families.
    pub const ALL: &[Family] = Family::VARIANTS;

    /// Returns its number of systems relative to other families.
    fn multiplicity(self) -> u64 {
        match self {
            Family::Graded => GRADES.len() as u64,
            Family::Huge | Family::Tiny => 2,
            Family::Neighbour => 3,
            Family::Signed => 4,
            _ => 1,
        }
    }

    /// Returns its name on the command line and in JSON.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Error for an unknown family name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("[possible values: {}]", Family::ALL.iter().copied().map(Family::name).collect::<Vec<_>>().join(", "))]
pub struct UnknownFamily;

fn unknown_family(_: &str) -> UnknownFamily {
    UnknownFamily
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Family);

/// A test system.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Identifier in requests and answers: `stiff-2`.
    pub id: String,
    /// Its family.
    pub family: Family,
    /// Its parameters: decimals with at most [`DIGITS`] digits.
    pub system: SpringMass<Exact>,
    /// ε > 0 in N/m, for the penalty method.
    pub penalty: Option<Exact>,
}

impl Problem {
    /// Returns the problem of a system of one's own, in the family of its state; ε > 0 in N/m for the penalty method.
    ///
    /// # Errors
    /// Returns [`SolveError::Invalid`] if c or m is not positive.
    pub fn own(id: &str, system: SpringMass<Exact>, penalty: Option<Exact>) -> Result<Self, SolveError> {
        let family = match State::of(&system)? {
            State::Contact => Family::Contact,
            State::Separated => Family::Separated,
            State::Grazing => Family::Grazing,
        };
        Ok(Problem { id: id.to_string(), family, system, penalty })
    }

    /// Returns the exact solution of (1.6), or of (1.13) and (1.12) with unilateral contact.
    ///
    /// # Panics
    /// Panics if c, m or ε is not positive.
    pub fn solution(&self) -> Solution<Exact> {
        let method = match &self.penalty {
            None => Method::Lagrange,
            Some(penalty) => Method::Penalty { penalty: penalty.clone() },
        };
        solve(&self.system, &method).expect("a system with c, m and ε > 0")
    }
}

/// Returns the right formulas of u in m and N in N, by Lagrange multiplier or by penalty.
pub(super) fn right<T: PositivePart>(system: &SpringMass<T>, penalty: Option<&T>) -> [T; 2] {
    match penalty {
        None => [contact::deflection(system), contact::contact_force(system)],
        Some(eps) => {
            let u = penalty::unilateral_deflection(system, eps);
            let n = penalty::contact_force(system, eps, &u).positive_part();
            [u, n]
        }
    }
}

/// Returns `cases` systems of each family, or of each decade of [`Family::Graded`], drawn from a seed.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::check::{Family, problems};
/// use spring_mass_contact::solver::State;
///
/// let grazing = problems(1, 20, &[Family::Grazing]);
/// assert_eq!((grazing.len(), grazing[1].id.as_str()), (20, "grazing-2"));
/// assert!(grazing.iter().all(|problem| State::of(&problem.system) == Ok(State::Grazing)));
/// ```
pub fn problems(seed: u64, cases: u64, families: &[Family]) -> Vec<Problem> {
    let mut all = Vec::new();
    for family in families.iter().copied() {
        for number in 1..=cases * family.multiplicity() {
            let system = Sampler::new(seed, family, number).system();
            all.push(Problem { id: format!("{family}-{number}"), family, system, penalty: None });
        }
    }
    all
}

/// Returns one unit of the last allowed digit.
fn last_digit(x: &Exact) -> Exact {
    let first = x.abs().decimal(1, Round::Down);
    let digit = first.chars().find_map(|c| c.to_digit(10).filter(|digit| *digit > 0)).expect("not zero");
    let first: Exact = first.parse().expect("a decimal");
    first / Exact::from(digit as i32) * decimal(1, 1 - DIGITS as i32)
}

/// Random source of the systems of a family.
struct Sampler {
    random: Rand64,
    seed: u64,
    family: Family,
    number: u64,
}

impl Sampler {
    fn new(seed: u64, family: Family, number: u64) -> Self {
        let stream = (u128::from(seed) << 64) | (u128::from(number) << 8) | family as u128;
        Sampler { random: Rand64::new(stream), seed, family, number }
    }

    fn between(&mut self, low: i32, high: i32) -> i32 {
        low + self.random.rand_range(0..(high - low + 1) as u64) as i32
    }

    /// Draws three digits between 10^low and 10^(high + 1).
    fn decades(&mut self, low: i32, high: i32) -> Exact {
        let mantissa = self.between(100, 999).into();
        decimal(mantissa, self.between(low, high) - 2)
    }

    fn sixteenths(&mut self, low: i32, high: i32) -> Exact {
        Exact::from(self.between(low, high)) / Exact::from(16)
    }

    /// Draws the gap relative to the free deflection, in contact.
    fn inside(&mut self) -> Exact {
        self.sixteenths(1, 14)
    }

    /// Draws the gap relative to the free deflection, separated.
    fn beyond(&mut self) -> Exact {
        self.sixteenths(18, 64)
    }

    /// Alternates between contact and separation.
    fn part(&mut self) -> Exact {
        if self.number % 2 == 1 { self.inside() } else { self.beyond() }
    }

    fn system(mut self) -> SpringMass<Exact> {
        match self.family {
            Family::Contact => self.ordinary([1, 3], Sampler::inside),
            Family::Separated => self.ordinary([1, 3], Sampler::beyond),
            Family::Overlap => self.ordinary([1, 3], |draw| -draw.part()),
            Family::Soft => self.ordinary([-4, -2], Sampler::part),
            Family::Lifted => self.lifted(),
            Family::Stiff => self.stiff(),
            Family::Far => self.far(),
            Family::Huge => self.sized(6, 13),
            Family::Tiny => self.sized(-14, -7),
            Family::Grazing => self.grazing(),
            Family::Near => self.near(),
            Family::Graded => self.graded(),
            Family::Signed => self.signed(),
            Family::Neighbour => self.neighbour(),
        }
    }

    /// Returns an ordinary system except for its stiffness. The gap relative to the free deflection is drawn first.
    fn ordinary(&mut self, [low, high]: [i32; 2], part: fn(&mut Self) -> Exact) -> SpringMass<Exact> {
        let part = part(self);
        let (c, m, g, l) =
            (self.decades(low, high), self.decades(-1, 0), self.decades(0, 0), self.decades(-1, 0));
        hung(c, m, g, l, &part)
    }

    /// The mass rises until the spring holds it; contact requires a higher plane.
    fn lifted(&mut self) -> SpringMass<Exact> {
        let SpringMass { c, m, g, l, h } = self.ordinary([1, 3], |draw| {
            let part = Exact::from(1) / draw.part();
            if draw.number % 2 == 1 || draw.between(0, 3) < 3 { -part } else { part }
        });
        SpringMass { c, m, g: -g, l, h }
    }

    fn stiff(&mut self) -> SpringMass<Exact> {
        let part = self.part();
        let l = if self.between(0, 3) == 0 { Exact::zero() } else { self.decades(-1, 0) };
        let (c, m, g) = (self.decades(7, 9), self.decades(0, 1), self.decades(0, 1));
        let system = hung(c.clone(), m.clone(), g.clone(), l, &part);
        // In f64 the difference of long lengths would be off by more than the tolerance.
        let [scale, _] = scales(&system);
        let rounding = (system.l.abs() + system.h.abs()) * Exact::power_of_two(-53);
        if rounding > decimal(9, -7) * scale { hung(c, m, g, Exact::zero(), &part) } else { system }
    }

    /// The free deflection is at most one metre, and the plane at most four metres below the support.
    fn far(&mut self) -> SpringMass<Exact> {
        let part = self.part();
        let l = self.decades(3, 5);
        let l = if self.between(0, 3) == 0 { -l } else { l };
        let (c, m, g) = (self.decades(2, 2), self.decades(-1, 0), self.decades(0, 0));
        hung(c, m, g, l, &part)
    }

    /// A grazing system except for the last digit of one parameter.
    fn near(&mut self) -> SpringMass<Exact> {
        let mut system = self.grazing();
        let SpringMass { c, m, g, l: _, h } = &mut system;
        let near = match self.between(0, 3) {
            0 => c,
            1 => m,
            2 => g,
            _ => h,
        };
        let unit = last_digit(near);
        *near = if self.number % 2 == 1 { &*near + unit } else { &*near - unit };
        system
    }

    /// Draws lengths and stiffness between these powers of ten, which gravity compensates.
    fn sized(&mut self, low: i32, high: i32) -> SpringMass<Exact> {
        let part = self.part();
        let (c, m) = (self.decades(low, high), self.decades(low, high));
        let exponent = self.between(low, high);
        let (l, gap) = (self.decades(exponent, exponent), self.decades(exponent, exponent));
        let g = short(&(&c * &gap / &m / part), 3);
        SpringMass { h: &l + gap, c, m, g, l }
    }

    /// Draws |R| relative to |m g| + |c Δ| in about equal ratios. Every decade alternates between both sides,
    /// and begins with its lowest quarter on both, so that few systems leave no large part out.
    fn graded(&mut self) -> SpringMass<Exact> {
        let grades = GRADES.len() as u64;
        let (decade, turn) = ((self.number - 1) % grades, (self.number - 1) / grades);
        let touches = (decade + turn) % 2 == 0;
        // 0, 1/2, 1/4, 3/4 of a decade, then the remaining quarters.
        let quarter = [0, 2, 1, 3][(turn / 2 % 4) as usize];
        let place = 6 * quarter + self.between(0, 5);
        let part = decimal(E24[place as usize].into(), GRADES.start + decade as i32 - 1);
        let SpringMass { c, m, g, l, h } = self.grazing();
        let (more, less) = (Exact::one() + &part, Exact::one() - &part);
        let factor = if touches { more / less } else { less / more };
        match self.between(0, 2) {
            0 => SpringMass { c: short(&(c / factor), DIGITS), m, g, l, h },
            1 => SpringMass { m: short(&(m * factor), DIGITS), c, g, l, h },
            _ => SpringMass { g: short(&(g * factor), DIGITS), c, m, l, h },
        }
    }

    fn signed(&mut self) -> SpringMass<Exact> {
        let [g, h, l, gap, touches] = SIGNS[(self.number - 1) as usize % SIGNS.len()].map(Exact::from);
        let (m, size) = (self.decades(-1, 0), self.decades(-1, 0));
        let signs_are_equal = h == l;
        // Of two lengths of one sign the difference may exceed the length at the support alone.
        let part = if signs_are_equal && h != gap { self.sixteenths(1, 14) } else { self.sixteenths(1, 64) };
        let l = l * size.clone();
        let h = if signs_are_equal {
            &l + gap.clone() * short(&(&size * part), 3)
        } else {
            h * self.decades(-1, 0)
        };
        let weight = if self.number % 2 == 1 { decimal(981, -2) } else { decimal(980_665, -5) };
        // Where weight and gap have one sign, the ratio of c (H − l) and m g decides the state.
        let is_smaller = (g == Exact::one()) == (touches == Exact::one());
        let part = if is_smaller { self.inside() } else { self.beyond() };
        let c = short(&(&m * &weight / (&h - &l).abs() * part), 3);
        SpringMass { c, m, g: g * weight, l, h }
    }

    /// Each five of these have one base, of which they change one parameter each.
    fn neighbour(&mut self) -> SpringMass<Exact> {
        let [base, which] = [(self.number - 1) / 5, (self.number - 1) % 5];
        let mut system = Sampler::new(self.seed, Family::Contact, base + 1).system();
        let SpringMass { c, m, g, l, h } = &mut system;
        let changed = [c, m, g, l, h].into_iter().nth(which as usize).expect("five parameters");
        *changed = short(&(&*changed * decimal(1001, -3)), DIGITS);
        system
    }

    /// m g = c Δ, where m is a divisor, so that g has few digits. Floats represent every other system exactly.
    fn grazing(&mut self) -> SpringMass<Exact> {
        if self.family == Family::Grazing && self.number % 2 == 1 {
            let (c, gap, l) =
                (Exact::from(self.between(10, 999)), self.sixteenths(1, 15), self.sixteenths(1, 99));
            return SpringMass { g: &c * &gap, c, m: Exact::one(), h: &l + gap, l };
        }
        let (c, gap, l) = (self.decades(1, 3), self.decades(-3, -1), self.decades(-1, 0));
        let twos = Exact::power_of_two(self.between(-2, 5));
        let m = Exact::from(1 + 4 * self.between(0, 1)) * twos;
        let g = &c * &gap / &m;
        SpringMass { h: &l + gap, c, m, g, l }
    }
}

/// Returns a system whose gap is this fraction of the free deflection.
fn hung(c: Exact, m: Exact, g: Exact, l: Exact, part: &Exact) -> SpringMass<Exact> {
    let system = SpringMass { c, m, g, h: l.clone(), l };
    let gap = short(&(structure::deflection(&system) * part), 3);
    SpringMass { h: short(&(&system.l + gap), DIGITS), ..system }
}
