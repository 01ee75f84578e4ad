//! Systems to be solved, of every kind that a solver may find hard, with decimals of few digits.
//!
//! A number is drawn as an integer and a power of ten, so that a seed means the same on every machine; and
//! every number has at most [`DIGITS`] digits, so that what is printed is what is meant.

use crate::chapter::{SpringMass, structure};
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};
use oorandom::Rand64;
use rug::float::Round;
use std::fmt;
use std::str::FromStr;

/// Significant decimal digits that a parameter has at most: some readers of numbers take no more than a line
/// of a punched card has room for.
pub const DIGITS: usize = 12;

/// The powers of ten that the decades of [`Family::Graded`] begin with.
const GRADES: std::ops::Range<i32> = -9..-1;

/// The preferred numbers of IEC 60063, E24, times ten: 24 to a decade, spaced alike on a logarithmic scale as
/// far as two digits allow.
const E24: [i32; 24] =
    [10, 11, 12, 13, 15, 16, 18, 20, 22, 24, 27, 30, 33, 36, 39, 43, 47, 51, 56, 62, 68, 75, 82, 91];

/// What is special about a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Family {
    /// Nothing, and the plane pushes.
    Contact,
    /// Nothing, and the mass hangs free.
    Separated,
    /// R = 0: it touches without force.
    Grazing,
    /// As near beside R = 0 as [`DIGITS`] digits of one parameter allow, on either side.
    Near,
    /// H < l: the spring has to be shortened before the mass fits above the plane.
    Overlap,
    /// g < 0: the weight lifts.
    Lifted,
    /// c of 10⁷ to 10¹⁰ N/m, and a gap down to a tenth of a nanometre.
    Stiff,
    /// c of 10⁻⁴ to 10⁻¹ N/m.
    Soft,
    /// |l| and |H| of kilometres, and a gap of a metre, or of less.
    Far,
    /// c, m and l of 10⁶ to 10¹⁴ SI units, and a gap alike.
    Huge,
    /// c, m and l of 10⁻¹⁴ to 10⁻⁶ SI units, and a gap alike.
    Tiny,
    /// |R| of 10⁻⁹ to 10⁻¹ of |m g| + |c (H − l)|, on either side: where a tolerance of the solver's own
    /// decides. So many systems a decade as other families have in all.
    Graded,
}

impl Family {
    /// All of them.
    pub const ALL: [Family; 12] = [
        Family::Contact,
        Family::Separated,
        Family::Grazing,
        Family::Near,
        Family::Overlap,
        Family::Lifted,
        Family::Stiff,
        Family::Soft,
        Family::Far,
        Family::Huge,
        Family::Tiny,
        Family::Graded,
    ];

    /// How many systems it has where others have one.
    fn multiplicity(self) -> u64 {
        if self == Family::Graded { GRADES.len() as u64 } else { 1 }
    }

    /// As it is called on the command line and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Family::Contact => "contact",
            Family::Separated => "separated",
            Family::Grazing => "grazing",
            Family::Near => "near",
            Family::Overlap => "overlap",
            Family::Lifted => "lifted",
            Family::Stiff => "stiff",
            Family::Soft => "soft",
            Family::Far => "far",
            Family::Huge => "huge",
            Family::Tiny => "tiny",
            Family::Graded => "graded",
        }
    }
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(self.name())
    }
}

/// There is no family of this name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("[possible values: {}]", Family::ALL.map(Family::name).join(", "))]
pub struct NoFamily;

impl FromStr for Family {
    type Err = NoFamily;
    fn from_str(text: &str) -> Result<Self, NoFamily> {
        Family::ALL.into_iter().find(|family| family.name() == text).ok_or(NoFamily)
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Family);

/// A system to be solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What it is called in requests and answers: `stiff-2`.
    pub id: String,
    /// What is special about it.
    pub family: Family,
    /// Its parameters: decimals of at most [`DIGITS`] digits.
    pub system: SpringMass<Exact>,
    /// ε > 0 in N/m, if the penalty method is asked for.
    pub penalty: Option<Exact>,
}

/// So many systems of each of these families, or of each decade of [`Family::Graded`], drawn from a seed.
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
    let numbered = |family: &Family| {
        let count = cases * family.multiplicity();
        (1..=count).map(|number| (*family, number)).collect::<Vec<_>>()
    };
    let problem = |(family, number): (Family, u64)| Problem {
        id: format!("{family}-{number}"),
        family,
        system: Draw::new(seed, family, number).system(),
        penalty: None,
    };
    families.iter().flat_map(numbered).map(problem).collect()
}

/// mantissa × 10^exponent
pub(super) fn decimal(mantissa: i64, exponent: i32) -> Exact {
    format!("{mantissa}e{exponent}").parse().expect("a decimal")
}

/// The nearest decimal of so many digits.
pub(super) fn short(x: &Exact, digits: usize) -> Exact {
    x.decimal(digits, Round::Nearest).parse().expect("a decimal")
}

/// One unit of the last digit that a number may have.
fn last_digit(x: &Exact) -> Exact {
    let first = x.abs().decimal(1, Round::Down);
    let digit = first.chars().find_map(|c| c.to_digit(10).filter(|digit| *digit > 0)).expect("not zero");
    let first: Exact = first.parse().expect("a decimal");
    first / Exact::from(digit as i32) * decimal(1, 1 - DIGITS as i32)
}

/// Where the systems of a family come from.
struct Draw {
    random: Rand64,
    family: Family,
    number: u64,
}

impl Draw {
    fn new(seed: u64, family: Family, number: u64) -> Self {
        let stream = (u128::from(seed) << 64) | (u128::from(number) << 8) | family as u128;
        Draw { random: Rand64::new(stream), family, number }
    }

    fn between(&mut self, low: i32, high: i32) -> i32 {
        low + self.random.rand_range(0..(high - low + 1) as u64) as i32
    }

    /// Three digits, from 10^low to 10^(high + 1).
    fn decades(&mut self, low: i32, high: i32) -> Exact {
        let mantissa = self.between(100, 999).into();
        decimal(mantissa, self.between(low, high) - 2)
    }

    fn sixteenths(&mut self, low: i32, high: i32) -> Exact {
        Exact::from(self.between(low, high)) / Exact::from(16)
    }

    /// The gap in parts of the free deflection, in contact.
    fn inside(&mut self) -> Exact {
        self.sixteenths(1, 14)
    }

    /// The same, apart.
    fn beyond(&mut self) -> Exact {
        self.sixteenths(18, 64)
    }

    /// By turns.
    fn part(&mut self) -> Exact {
        if self.number % 2 == 1 { self.inside() } else { self.beyond() }
    }

    fn system(mut self) -> SpringMass<Exact> {
        match self.family {
            Family::Contact => {
                let part = self.inside();
                self.ordinary([1, 3], part)
            }
            Family::Separated => {
                let part = self.beyond();
                self.ordinary([1, 3], part)
            }
            Family::Overlap => {
                let part = -self.part();
                self.ordinary([1, 3], part)
            }
            Family::Lifted => {
                // It rises until the spring holds it; only a plane that is higher still is in the way.
                let part = Exact::from(1) / self.part();
                let above = self.number % 2 == 1 || self.between(0, 3) < 3;
                let part = if above { -part } else { part };
                let SpringMass { c, m, g, l, h } = self.ordinary([1, 3], part);
                SpringMass { c, m, g: -g, l, h }
            }
            Family::Stiff => {
                let part = self.part();
                let l = if self.between(0, 3) == 0 { Exact::zero() } else { self.decades(-1, 0) };
                let (c, m, g) = (self.decades(7, 9), self.decades(0, 1), self.decades(0, 1));
                hung(c, m, g, l, &part)
            }
            Family::Soft => {
                let part = self.part();
                self.ordinary([-4, -2], part)
            }
            Family::Far => {
                let part = self.part();
                let l = self.decades(3, 5);
                let l = if self.between(0, 3) == 0 { -l } else { l };
                // The mass hangs no further down than a metre, and the plane no further than four.
                let (c, m, g) = (self.decades(2, 2), self.decades(-1, 0), self.decades(0, 0));
                hung(c, m, g, l, &part)
            }
            Family::Huge => self.sized(6, 13),
            Family::Tiny => self.sized(-14, -7),
            Family::Grazing => self.grazing(),
            Family::Graded => self.graded(),
            Family::Near => {
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
        }
    }

    /// A system of everyday size but for its stiffness.
    fn ordinary(&mut self, stiffness: [i32; 2], part: Exact) -> SpringMass<Exact> {
        let [low, high] = stiffness;
        let (c, m, g, l) =
            (self.decades(low, high), self.decades(-1, 0), self.decades(0, 0), self.decades(-1, 0));
        hung(c, m, g, l, &part)
    }

    /// Lengths and stiffness between these powers of ten; gravity makes up for them.
    fn sized(&mut self, low: i32, high: i32) -> SpringMass<Exact> {
        let part = self.part();
        let (c, m) = (self.decades(low, high), self.decades(low, high));
        let exponent = self.between(low, high);
        let (l, gap) = (self.decades(exponent, exponent), self.decades(exponent, exponent));
        let g = short(&(&c * &gap / &m / part), 3);
        SpringMass { h: &l + gap, c, m, g, l }
    }

    /// |R| as a part of |m g| + |c Δ| that is spaced alike on a logarithmic scale. Every decade is on either
    /// side by turns, and begins with its lowest quarter on both, so that few systems leave no large part
    /// out.
    fn graded(&mut self) -> SpringMass<Exact> {
        let grades = GRADES.len() as u64;
        let (decade, turn) = ((self.number - 1) % grades, (self.number - 1) / grades);
        let touches = (decade + turn) % 2 == 0;
        // 0, 1/2, 1/4, 3/4 of a decade, and on with the quarters that these leave.
        let quarter = [0, 2, 1, 3][(turn / 2 % 4) as usize];
        let place = 6 * quarter + self.between(0, 5);
        let part = decimal(E24[place as usize].into(), GRADES.start + decade as i32 - 1);
        let SpringMass { c, m, g, l, h } = self.grazing();
        let (more, less) = (Exact::one() + &part, Exact::one() - &part);
        let factor = if touches { more / less } else { less / more };
        let short = |x: Exact| short(&x, DIGITS);
        match self.between(0, 2) {
            0 => SpringMass { c: short(c / factor), m, g, l, h },
            1 => SpringMass { m: short(m * factor), c, g, l, h },
            _ => SpringMass { g: short(g * factor), c, m, l, h },
        }
    }

    /// m g = c Δ: m divides it, so that g has few digits.
    fn grazing(&mut self) -> SpringMass<Exact> {
        let (c, gap, l) = (self.decades(1, 3), self.decades(-3, -1), self.decades(-1, 0));
        let twos = Exact::power_of_two(self.between(-2, 5));
        let m = Exact::from(1 + 4 * self.between(0, 1)) * twos;
        let g = &c * &gap / &m;
        SpringMass { h: &l + gap, c, m, g, l }
    }
}

/// The plane is so far below as this part of the free deflection.
fn hung(c: Exact, m: Exact, g: Exact, l: Exact, part: &Exact) -> SpringMass<Exact> {
    let system = SpringMass { c, m, g, h: l.clone(), l };
    let gap = short(&(structure::deflection(&system) * part), 3);
    SpringMass { h: short(&(&system.l + gap), DIGITS), ..system }
}
