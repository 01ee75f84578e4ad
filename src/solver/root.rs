//! Root of c p + W′(p) = R for any W, between two points with certain signs.

use super::functional::{Condition, FunctionalError, broken, is_finite, vanishes};
use super::scalar::power;
use super::validate::SolveError;
use super::{Interval, Scalar, to_interval};
use crate::chapter::{SpringMass, structure};
use crate::number::{Dual, PositivePart};
use std::cmp::Ordering;

/// Returns a system of weight R with gap 0. Its equation in p is the same, without further cancellation.
pub(super) fn reduced_system<E: PositivePart>(c: E, reaction: E) -> SpringMass<E> {
    SpringMass { c, m: reaction, g: E::one(), l: E::zero(), h: E::zero() }
}

/// The equation c p + W′(p) = R, for R > 0.
pub(super) struct Equation<'a, E> {
    pub(super) spring: SpringMass<E>,
    // Not generic, so that the search is compiled once for each number system.
    functional: &'a dyn Fn(&Dual<E>) -> Dual<E>,
}

/// Bounds of the root.
pub(super) struct RootBracket<T> {
    pub(super) lower: T,
    pub(super) upper: T,
    /// Whether the search ended before its limit of steps.
    pub(super) ended: bool,
}

impl<T: Clone> RootBracket<T> {
    fn point(root: T) -> Self {
        RootBracket { lower: root.clone(), upper: root, ended: true }
    }
}

/// Position of a penetration relative to the root, by the sign of c p + W′ − R, with an estimate of its
/// magnitude.
enum Side<T> {
    Below(T),
    At,
    Above(T),
    /// The sign is undecided.
    Near,
    /// W or W′ is not finite.
    Nowhere,
}

/// Largest number of steps, each with at most two evaluations of W.
const MOST_STEPS: u32 = 10_000;

/// Largest number of significant binary digits.
const MOST_DIGITS: u64 = 1 << 22;

impl<'a, E: PositivePart> Equation<'a, E> {
    pub(super) fn new(c: E, reaction: E, functional: &'a dyn Fn(&Dual<E>) -> Dual<E>) -> Self {
        Equation { spring: reduced_system(c, reaction), functional }
    }

    /// Returns R/c, rounded up; no penetration is larger, since W′ ≥ 0.
    pub(super) fn most<T: Scalar<Enclosure = E>>(&self) -> Result<T, SolveError> {
        let most: Interval<T> = to_interval(&structure::deflection(&self.spring), "penetration")?;
        Ok(most.upper)
    }

    fn energy_and_force<T: Scalar<Enclosure = E>>(&self, p: &T) -> Dual<E> {
        (self.functional)(&Dual::variable(p.enclose()))
    }

    fn side<T: Scalar<Enclosure = E>>(&self, p: &T) -> Result<Side<T>, FunctionalError> {
        let force = self.energy_and_force(p).derivative;
        if T::sign(&force) == Some(Ordering::Less) {
            return Err(broken(Condition::Monotone, p));
        }
        let residual = structure::residual(&self.spring, &p.enclose()) + force;
        if !is_finite::<T>(&residual) {
            return Ok(Side::Nowhere);
        }
        let Interval { lower, upper } = T::interval(&residual);
        let size = half(&lower) + half(&upper);
        Ok(match T::sign(&residual) {
            Some(Ordering::Less) => Side::Below(size),
            Some(Ordering::Equal) => Side::At,
            Some(Ordering::Greater) => Side::Above(size),
            None => Side::Near,
        })
    }

    /// Tests the conditions at 0 and at the sixteenths of R/c.
    pub(super) fn check<T: Scalar<Enclosure = E>>(&self, most: &T) -> Result<(), FunctionalError> {
        let mut last = (T::zero(), self.energy_and_force(&T::zero()));
        vanishes::<T>(&last.1.value)?;
        for i in 1..=16 {
            let p = most * T::int(i) / T::int(16);
            let w = self.energy_and_force(&p);
            if !is_finite::<T>(&w.derivative) {
                continue;
            }
            let gained = &w.value - &last.1.value;
            let further = p.enclose() - last.0.enclose();
            // The increase of a convex W is at most that for the last force, and at least that for the first.
            let conditions = [
                (Condition::Monotone, w.derivative.clone()),
                (Condition::Monotone, gained.clone()),
                (Condition::Convex, &w.derivative - &last.1.derivative),
                (Condition::Convex, &gained - &last.1.derivative * &further),
                (Condition::Continuous, &w.derivative * &further - &gained),
            ];
            // None of these is negative if the conditions hold.
            let mut violated = conditions.iter().filter(|(_, x)| T::sign(x) == Some(Ordering::Less));
            if let Some((condition, _)) = violated.next() {
                return Err(broken(*condition, &p));
            }
            last = (p, w);
        }
        Ok(())
    }

    /// Encloses the root between 0 and `most`, until the width is at most `enough`, a sign is undecided, or
    /// no number lies in between.
    ///
    /// Uses quadratic interval refinement (J. Abbott): tests the one of 2ⁿ cells in which the secant has its
    /// root, doubles n if the root is there, and otherwise sets n to 1. The tested numbers have few digits in
    /// every number system. The first one is the root of the secant itself, which is exact for ε p²/2.
    pub(super) fn root<T: Scalar<Enclosure = E>>(
        &self,
        most: &T,
        enough: &T,
    ) -> Result<RootBracket<T>, FunctionalError> {
        let mut lower = match self.side(&T::zero())? {
            Side::Below(size) => End { p: T::zero(), size },
            Side::At | Side::Above(_) => return Ok(RootBracket::point(T::zero())),
            Side::Near => return self.around(&T::zero(), &T::zero(), most),
            Side::Nowhere => return Err(broken(Condition::ZeroAtContact, &T::zero())),
        };
        let (mut p, mut nowhere) = (most.clone(), most.clone());
        let mut upper = None;
        for _ in 0..MOST_STEPS {
            match self.side(&p)? {
                Side::Above(size) => {
                    upper = Some(End { p, size });
                    break;
                }
                Side::At => return Ok(RootBracket::point(p)),
                Side::Near => return self.around(&p, &lower.p, most),
                Side::Below(size) => lower = End { p, size },
                // An overflow occurs only beyond the root.
                Side::Nowhere => nowhere = p,
            }
            p = middle(&lower.p, &nowhere);
            if p == lower.p || p == nowhere {
                return Ok(RootBracket { lower: lower.p, upper: most.clone(), ended: true });
            }
        }
        let Some(mut upper) = upper else {
            return Ok(RootBracket { lower: lower.p, upper: most.clone(), ended: false });
        };
        let mut digits = 0;
        for _ in 0..MOST_STEPS {
            let cell = cell(&lower, &upper, digits, enough);
            let mut moved = false;
            for p in &cell {
                if lower.p < *p && *p < upper.p {
                    moved = true;
                    match self.side(p)? {
                        Side::Below(size) => lower = End { p: p.clone(), size },
                        Side::Above(size) => upper = End { p: p.clone(), size },
                        Side::At => return Ok(RootBracket::point(p.clone())),
                        Side::Near | Side::Nowhere => return self.around(p, &lower.p, &upper.p),
                    }
                }
            }
            // The interval is narrow enough, or no number lies in between.
            if digits == 1 && !moved {
                return Ok(RootBracket { lower: lower.p, upper: upper.p, ended: true });
            }
            let hit = moved && cell == [lower.p.clone(), upper.p.clone()];
            digits = if hit { 2 * digits } else { 1 };
        }
        Ok(RootBracket { lower: lower.p, upper: upper.p, ended: false })
    }

    /// Returns the bounds next to a penetration with undecided sign, from bounds that are further away.
    fn around<T: Scalar<Enclosure = E>>(
        &self,
        near: &T,
        lower: &T,
        upper: &T,
    ) -> Result<RootBracket<T>, FunctionalError> {
        let (lower, k) = self.towards(near, lower, 1, |side| matches!(side, Side::Below(_)))?;
        let (upper, _) = self.towards(near, upper, k, |side| matches!(side, Side::Above(_)))?;
        Ok(RootBracket { lower, upper, ended: true })
    }

    /// Returns the nearest of the numbers `near` + (`far` − `near`)/2ᵏ with a certain sign, and its k; `far`
    /// and 0 if there is none. The search begins with k = `first`.
    fn towards<T: Scalar<Enclosure = E>>(
        &self,
        near: &T,
        far: &T,
        first: u64,
        certain: impl Fn(Side<T>) -> bool,
    ) -> Result<(T, u64), FunctionalError> {
        let holds = |k| -> Result<bool, FunctionalError> {
            let p = halve_distance(near, far, k);
            Ok(p != *near && certain(self.side(&p)?))
        };
        // The distance doubles in each step, towards the last such number.
        let (mut certain, mut open, mut further) = (0, first.max(1), 1);
        while open < MOST_DIGITS && holds(open)? {
            (certain, open, further) = (open, open + further, 2 * further);
        }
        while open - certain > 1 {
            let k = certain + (open - certain) / 2;
            if holds(k)? { certain = k } else { open = k }
        }
        Ok((if certain == 0 { far.clone() } else { halve_distance(near, far, certain) }, certain))
    }
}

/// Returns `near` + (`far` − `near`)/2ᵏ.
fn halve_distance<T: Scalar>(near: &T, far: &T, k: u64) -> T {
    near + (far - near) * power(&half(&T::one()), k)
}

/// One bound of the interval that contains the root.
struct End<T> {
    p: T,
    /// Estimate of the residual there.
    size: T,
}

/// Returns the cell, of 2ⁿ equal parts of the interval, that contains the root of the secant; fewer parts if
/// they are narrow enough. For n = 0 returns that root.
fn cell<T: Scalar>(lower: &End<T>, upper: &End<T>, digits: u64, enough: &T) -> [T; 2] {
    let rise = &upper.size - &lower.size;
    let mut part = if rise.is_invertible() { -&lower.size / rise } else { T::zero() };
    let (mut left, mut width) = (lower.p.clone(), &upper.p - &lower.p);
    if digits == 0 {
        let root = left + width * part;
        return [root.clone(), root];
    }
    for _ in 0..digits {
        if width <= *enough {
            break;
        }
        width = half(&width);
        part = T::int(2) * part;
        if part >= T::one() {
            part = part - T::one();
            left = left + &width;
        }
    }
    let right = &left + width;
    [left, right]
}

fn half<T: Scalar>(x: &T) -> T {
    x / T::int(2)
}

pub(super) fn middle<T: Scalar>(a: &T, b: &T) -> T {
    a + half(&(b - a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Ball;

    /// p + p = 2/3: the root is 1/3, which is not a float.
    #[test]
    fn a_bound_is_the_same_from_wherever_it_is_looked_for() {
        let two_thirds = Ball::point(2.0) / Ball::point(3.0);
        let functional = |p: &Dual<Ball<f64>>| p * p / Dual::constant(Ball::point(2.0));
        let equation = Equation::new(Ball::point(1.0), two_thirds, &functional);
        let from = |far: f64, first: u64| {
            let certain = |side| matches!(side, Side::Below(_) | Side::Above(_));
            equation.towards(&(1.0 / 3.0), &far, first, certain).unwrap()
        };
        for far in [0.0, 1.0, 0.25, 1.0 / 3.0 + 1e-12, (1.0f64 / 3.0).next_up()] {
            let (bound, k) = from(far, 1);
            assert_eq!(bound == far, k == 0, "{far}");
            for first in [0, 2, 3, k, k + 1, k + 2, 2 * k + 3, 60, 1000] {
                assert_eq!(from(far, first), (bound, k), "{far} from {first}");
            }
        }
        assert!(from(0.0, 1).1 > 40, "it is near");
    }
}
