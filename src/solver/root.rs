//! Root of c p + W′(p) = R for any W, between two points with certain signs.

use super::functional::{FunctionalCondition, FunctionalError, check_vanishes, is_finite, violation};
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
pub(super) struct PenaltyEquation<'a, E> {
    pub(super) spring: SpringMass<E>,
    // Not generic, so that the search is compiled once for each number system.
    functional: &'a dyn Fn(&Dual<E>) -> Dual<E>,
}

/// Bounds of the root.
pub(super) struct RootBracket<T> {
    pub(super) lower: T,
    pub(super) upper: T,
    /// Whether the search ended before its limit of steps.
    pub(super) is_complete: bool,
}

impl<T: Clone> RootBracket<T> {
    fn point(root: T) -> Self {
        RootBracket { lower: root.clone(), upper: root, is_complete: true }
    }
}

/// Position of a penetration relative to the root, by the sign of c p + W′ − R, with an estimate of its
/// magnitude.
enum Side<T> {
    Below(T),
    Root,
    Above(T),
    /// The sign is undecided.
    Undecided,
    /// W or W′ is not finite.
    OutOfRange,
}

/// Largest number of steps, each with at most two evaluations of W.
const MAX_STEPS: u32 = 10_000;

/// Largest number of significant binary digits.
const MAX_BITS: u64 = 1 << 22;

impl<'a, E: PositivePart> PenaltyEquation<'a, E> {
    pub(super) fn new(c: E, reaction: E, functional: &'a dyn Fn(&Dual<E>) -> Dual<E>) -> Self {
        PenaltyEquation { spring: reduced_system(c, reaction), functional }
    }

    /// Returns R/c, rounded up; no penetration is larger, since W′ ≥ 0.
    pub(super) fn max_penetration<T: Scalar<Enclosure = E>>(&self) -> Result<T, SolveError> {
        let interval: Interval<T> = to_interval(&structure::deflection(&self.spring), "penetration")?;
        Ok(interval.upper)
    }

    fn energy_and_force<T: Scalar<Enclosure = E>>(&self, p: &T) -> Dual<E> {
        (self.functional)(&Dual::variable(p.enclose()))
    }

    fn side<T: Scalar<Enclosure = E>>(&self, p: &T) -> Result<Side<T>, FunctionalError> {
        let force = self.energy_and_force(p).derivative;
        if T::sign(&force) == Some(Ordering::Less) {
            return Err(violation(FunctionalCondition::Monotone, p));
        }
        let residual = structure::residual(&self.spring, &p.enclose()) + force;
        if !is_finite::<T>(&residual) {
            return Ok(Side::OutOfRange);
        }
        let Interval { lower, upper } = T::interval(&residual);
        let estimate = half(&lower) + half(&upper);
        Ok(match T::sign(&residual) {
            Some(Ordering::Less) => Side::Below(estimate),
            Some(Ordering::Equal) => Side::Root,
            Some(Ordering::Greater) => Side::Above(estimate),
            None => Side::Undecided,
        })
    }

    /// Tests the conditions at 0 and at the sixteenths of R/c.
    pub(super) fn check_conditions<T: Scalar<Enclosure = E>>(&self, max: &T) -> Result<(), FunctionalError> {
        let mut last = (T::zero(), self.energy_and_force(&T::zero()));
        check_vanishes::<T>(&last.1.value)?;
        for i in 1..=16 {
            let p = max * T::int(i) / T::int(16);
            let w = self.energy_and_force(&p);
            if !is_finite::<T>(&w.derivative) {
                continue;
            }
            let gained = &w.value - &last.1.value;
            let distance = p.enclose() - last.0.enclose();
            // The increase of a convex W is at most that for the last force, and at least that for the first.
            let conditions = [
                (FunctionalCondition::Monotone, w.derivative.clone()),
                (FunctionalCondition::Monotone, gained.clone()),
                (FunctionalCondition::Convex, &w.derivative - &last.1.derivative),
                (FunctionalCondition::Convex, &gained - &last.1.derivative * &distance),
                (FunctionalCondition::Continuous, &w.derivative * &distance - &gained),
            ];
            // None of these is negative if the conditions hold.
            let mut violated = conditions.iter().filter(|(_, x)| T::sign(x) == Some(Ordering::Less));
            if let Some((condition, _)) = violated.next() {
                return Err(violation(*condition, &p));
            }
            last = (p, w);
        }
        Ok(())
    }

    /// Encloses the root between 0 and `max`, until the width is at most `max_width`, a sign is undecided, or
    /// no number lies in between.
    pub(super) fn root<T: Scalar<Enclosure = E>>(
        &self,
        max: &T,
        max_width: &T,
    ) -> Result<RootBracket<T>, FunctionalError> {
        let mut lower = match self.side(&T::zero())? {
            Side::Below(residual) => Endpoint { p: T::zero(), residual },
            Side::Root | Side::Above(_) => return Ok(RootBracket::point(T::zero())),
            Side::Undecided => return self.bracket_undecided(&T::zero(), &T::zero(), max),
            Side::OutOfRange => return Err(violation(FunctionalCondition::ZeroAtContact, &T::zero())),
        };
        // An overflow occurs only beyond the root.
        let (mut p, mut overflow) = (max.clone(), max.clone());
        for _ in 0..MAX_STEPS {
            match self.side(&p)? {
                Side::Above(residual) => return self.refine(lower, Endpoint { p, residual }, max_width),
                Side::Root => return Ok(RootBracket::point(p)),
                Side::Undecided => return self.bracket_undecided(&p, &lower.p, max),
                Side::Below(residual) => lower = Endpoint { p, residual },
                Side::OutOfRange => overflow = p,
            }
            p = middle(&lower.p, &overflow);
            if p == lower.p || p == overflow {
                return Ok(RootBracket { lower: lower.p, upper: max.clone(), is_complete: true });
            }
        }
        Ok(RootBracket { lower: lower.p, upper: max.clone(), is_complete: false })
    }

    /// Narrows an interval with certain signs at its ends.
    ///
    /// Uses quadratic interval refinement (J. Abbott): tests the one of 2ⁿ cells in which the secant has its
    /// root, doubles n if the root is there, and otherwise sets n to 1. The tested numbers have few digits in
    /// every number system. The first one is the root of the secant itself, which is exact for ε p²/2.
    fn refine<T: Scalar<Enclosure = E>>(
        &self,
        mut lower: Endpoint<T>,
        mut upper: Endpoint<T>,
        max_width: &T,
    ) -> Result<RootBracket<T>, FunctionalError> {
        let mut n = 0;
        for _ in 0..MAX_STEPS {
            let cell = cell(&lower, &upper, n, max_width);
            let mut is_narrowed = false;
            for p in &cell {
                if lower.p < *p && *p < upper.p {
                    is_narrowed = true;
                    match self.side(p)? {
                        Side::Below(residual) => lower = Endpoint { p: p.clone(), residual },
                        Side::Above(residual) => upper = Endpoint { p: p.clone(), residual },
                        Side::Root => return Ok(RootBracket::point(p.clone())),
                        Side::Undecided | Side::OutOfRange => {
                            return self.bracket_undecided(p, &lower.p, &upper.p);
                        }
                    }
                }
            }
            // The interval is narrow enough, or no number lies in between.
            if n == 1 && !is_narrowed {
                return Ok(RootBracket { lower: lower.p, upper: upper.p, is_complete: true });
            }
            let contains_root = is_narrowed && cell == [lower.p.clone(), upper.p.clone()];
            n = if contains_root { 2 * n } else { 1 };
        }
        Ok(RootBracket { lower: lower.p, upper: upper.p, is_complete: false })
    }

    /// Returns the bounds next to a penetration with undecided sign, from bounds that are further away.
    fn bracket_undecided<T: Scalar<Enclosure = E>>(
        &self,
        near: &T,
        lower: &T,
        upper: &T,
    ) -> Result<RootBracket<T>, FunctionalError> {
        let (lower, k) = self.nearest_certain(near, lower, 1, |side| matches!(side, Side::Below(_)))?;
        let (upper, _) = self.nearest_certain(near, upper, k, |side| matches!(side, Side::Above(_)))?;
        Ok(RootBracket { lower, upper, is_complete: true })
    }

    /// Returns the nearest of the numbers `near` + (`far` − `near`)/2ᵏ with a certain sign, and its k; `far`
    /// and 0 if there is none. The search begins with k = `first`.
    fn nearest_certain<T: Scalar<Enclosure = E>>(
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
        // The distance doubles in each step, up to the last such number.
        let (mut certain, mut open, mut step) = (0, first.max(1), 1);
        while open < MAX_BITS && holds(open)? {
            (certain, open, step) = (open, open + step, 2 * step);
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

/// One end of the interval that contains the root.
struct Endpoint<T> {
    p: T,
    /// Estimate of the residual there.
    residual: T,
}

/// Returns the cell, of 2ⁿ equal parts of the interval, that contains the root of the secant; fewer parts if
/// they are narrow enough. For n = 0 returns that root.
fn cell<T: Scalar>(lower: &Endpoint<T>, upper: &Endpoint<T>, n: u64, max_width: &T) -> [T; 2] {
    let rise = &upper.residual - &lower.residual;
    let mut part = if rise.is_invertible() { -&lower.residual / rise } else { T::zero() };
    let (mut left, mut width) = (lower.p.clone(), &upper.p - &lower.p);
    if n == 0 {
        let root = left + width * part;
        return [root.clone(), root];
    }
    for _ in 0..n {
        if width <= *max_width {
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
        let equation = PenaltyEquation::new(Ball::point(1.0), two_thirds, &functional);
        let from = |far: f64, first: u64| {
            let certain = |side| matches!(side, Side::Below(_) | Side::Above(_));
            equation.nearest_certain(&(1.0 / 3.0), &far, first, certain).unwrap()
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
