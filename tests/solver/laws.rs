//! The laws of scalars: all number systems satisfy them, and each violated law is named.

use crate::strategies::*;
use half::{bf16, f16};
use num_traits::One;
use spring_mass_contact::number::{Ball, Field, Native};
use spring_mass_contact::operators;
use spring_mass_contact::solver::laws::{self, LawViolation, ScalarLaw};
use std::cmp::Ordering;

/// Neighbours, thirds, tiny and huge numbers, and powers of two near the limits of the range.
fn samples<T: Float>(like: &T, least: i32, largest: i32) -> Vec<T> {
    let round = |x: Exact| like.round_from_exact(&x).unwrap();
    let power = |n: i32| round(Exact::power_of_two(n));
    let [one, third, tenth] = [int(1), q("1/3"), q("1/10")].map(round);
    let ends = [power(least), -power(least), power(largest), -power(largest)];
    let near = [one.clone().next_up(), -one.clone().next_down(), third.clone().next_up()];
    let (large, small) = (power(20.min(largest)), power((-40).max(least)));
    let middle = [power(0) - &one, one, third.clone(), -third, tenth.clone(), tenth * large, small];
    ends.into_iter().chain(near).chain(middle).collect()
}

#[test]
fn our_scalars_keep_the_laws() {
    for (least, largest) in [(-149, 127), (-70, 60)] {
        laws::check_scalar_laws(&samples(&1f32, least, largest), exact).unwrap();
    }
    for (least, largest) in [(-1074, 1023), (-500, 500)] {
        laws::check_scalar_laws(&samples(&1f64, least, largest), exact).unwrap();
    }
    laws::check_scalar_laws(&samples(&Native(f16::ONE), -24, 15), exact).unwrap();
    laws::check_scalar_laws(&samples(&Native(bf16::ONE), -133, 127), exact).unwrap();
    for bits in [2, 24, 53, 200] {
        laws::check_scalar_laws(&samples(&float(bits), -9999, 9999), exact).unwrap();
    }
    // Precisions that meet, and constants that have none.
    let mixed = [float(10), q("1/3").to_mpfr(90), Mpfr::int(3), q("1/7").to_mpfr(3)];
    laws::check_scalar_laws(&mixed, exact).unwrap();
    let rationals: Vec<_> = samples(&1f64, -300, 300).iter().map(|x| exact(x) / int(7)).collect();
    laws::check_scalar_laws(&rationals, exact).unwrap();
}

/// An undecided sign violates no law, but costs time.
#[test]
fn the_sign_of_a_rational_is_known() {
    for (x, sign) in [(-1, Ordering::Less), (0, Ordering::Equal), (1, Ordering::Greater)] {
        assert_eq!(<Exact as Scalar>::sign(&(int(x) / int(7))), Some(sign));
    }
}

/// An f64 that violates the law of this index; none for 8; 9 has wrong signs if b is common to three products; 10 and 11
/// have wrong integers.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
struct Breaks<const LAW: usize>(f64);

operators! { [const LAW: usize] Breaks<LAW>;
    Add add |a, b| Breaks(a.0 + b.0);
    Sub sub |a, b| Breaks(a.0 - b.0);
    Mul mul |a, b| Breaks(a.0 * b.0);
    Div div |a, b| Breaks(a.0 / b.0);
    - |a| Breaks(-a.0)
}
impl<const LAW: usize> Zero for Breaks<LAW> {
    fn zero() -> Self {
        Breaks(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}
impl<const LAW: usize> One for Breaks<LAW> {
    fn one() -> Self {
        Breaks(1.0)
    }
}
impl<const LAW: usize> Field for Breaks<LAW> {
    fn int(n: i32) -> Self {
        Breaks(match LAW {
            10 => 2.0,
            11 => n.unsigned_abs().into(),
            _ => n.into(),
        })
    }
}
impl<const LAW: usize> PositivePart for Breaks<LAW> {
    fn positive_part(&self) -> Self {
        Breaks(self.0.max(0.0))
    }
    fn min(&self, other: &Self) -> Self {
        Breaks(if LAW == 0 && self.0 == -other.0 { self.0.max(other.0) } else { self.0.min(other.0) })
    }
    fn abs(&self) -> Self {
        Breaks(self.0.abs())
    }
}
impl<const LAW: usize> OrderedField for Breaks<LAW> {}
impl<const LAW: usize> Scalar for Breaks<LAW> {
    type Enclosure = Ball<f64>;
    fn enclose(&self) -> Ball<f64> {
        // Through a narrower format.
        if LAW == 2 { f64::from(self.0 as f32).enclose() } else { self.0.enclose() }
    }
    fn interval(ball: &Ball<f64>) -> Interval<Self> {
        let Interval { lower, upper } = f64::interval(ball);
        // Rounded to nearest, and not outward.
        if LAW == 3 {
            let (x, r) = (*ball.value(), *ball.radius());
            return Interval { lower: Breaks(x - r / 2.0), upper: Breaks(x + r / 2.0) };
        }
        Interval { lower: Breaks(lower), upper: Breaks(upper) }
    }
    fn magnitude(ball: &Ball<f64>) -> Self {
        Breaks(if LAW == 4 { ball.value().abs() } else { <f64 as Scalar>::magnitude(ball) })
    }
    fn sign(ball: &Ball<f64>) -> Option<Ordering> {
        if LAW == 5 { ball.value().partial_cmp(&0.0) } else { f64::sign(ball) }
    }
    fn power(x: &Ball<f64>, k: u64) -> Option<Ball<f64>> {
        let power = f64::power(x, k)?;
        Some(if LAW == 6 { Ball::point(*power.value()) } else { power })
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite() && (LAW != 1 || self.0.abs() < 1e100)
    }
    fn sign_of_sum(plus: [(&Self, &Self); 2], (c, d): (&Self, &Self)) -> Ordering {
        let floats = plus.map(|(a, b)| (a.0, b.0));
        let [(a, b), (e, f)] = &floats;
        match LAW {
            9 if b != e || *b != c.0 => f64::sign_of_sum([(a, b), (e, f)], (&c.0, &d.0)),
            7 | 9 => (a * b + e * f).partial_cmp(&(c.0 * d.0)).unwrap_or(Ordering::Equal),
            _ => f64::sign_of_sum([(a, b), (e, f)], (&c.0, &d.0)),
        }
    }
}

fn tried<const LAW: usize>() -> Result<(), LawViolation> {
    let samples: Vec<_> = samples(&1f64, -400, 400).into_iter().map(Breaks::<LAW>).collect();
    laws::check_scalar_laws(&samples, |x| exact(&x.0))
}

#[test]
fn a_violated_law_is_named() {
    for (found, law) in [
        (tried::<0>(), ScalarLaw::Order),
        (tried::<1>(), ScalarLaw::Finite),
        (tried::<2>(), ScalarLaw::Enclose),
        (tried::<3>(), ScalarLaw::Interval),
        (tried::<4>(), ScalarLaw::Magnitude),
        (tried::<5>(), ScalarLaw::Sign),
        (tried::<6>(), ScalarLaw::Power),
        (tried::<7>(), ScalarLaw::SignOfSum),
        (tried::<9>(), ScalarLaw::SignOfSum),
        (tried::<10>(), ScalarLaw::Integer),
        (tried::<11>(), ScalarLaw::Integer),
    ] {
        assert_eq!(found.as_ref().map_err(|broken| broken.law), Err(law), "{found:?}");
    }
    assert_eq!(tried::<8>(), Ok(()));
    // 2⁴⁰⁰.
    let text = tried::<1>().unwrap_err().counterexample;
    assert!(text.ends_with("which is 2.582249878086908589655919172e120"), "{text}");
}
