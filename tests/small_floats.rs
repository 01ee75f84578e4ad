//! Every system of floats with very few bits, by every method and with its bounds, compared with rationals.
//!
//! A sample can miss the one case in which a bound is an ulp too small; with all mantissas, all kinds of
//! rounding are tested. c and m have one exponent (scaling them changes nothing), ε, g, l and H have several,
//! with signs and zero. By default all systems of 2 bits and a sample of the larger sets are tested; with `DEEP=1`
//! all 628 864 of 3 bits and 2 515 456 of 4 bits, which takes minutes.

use crate::strategies::{encloses, exact, int, is_deep};
use num_traits::Zero;
use rayon::prelude::*;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, Mpfr, PositivePart};
use spring_mass_contact::solver::{Bounds, Method, Outcome, Solution, State, solve, solve_bilateral};
use std::cmp::Ordering;
use std::ops::Range;

/// Far more than any of these systems takes.
const MAX_AUGMENTATIONS: u64 = 1000;

/// A float and its value.
type Pair = (Mpfr, Exact);

/// Returns all floats of `bits` bits whose leading bit has a weight in `exponents`.
fn positives(bits: u32, exponents: Range<i32>) -> Vec<Pair> {
    let mantissas = 1 << (bits - 1)..1 << bits;
    let all = exponents.flat_map(|e| mantissas.clone().map(move |n| (n, e - bits as i32 + 1)));
    all.map(|(n, e)| int(n) * Exact::power_of_two(e)).map(|x| (x.to_mpfr(bits), x)).collect()
}

/// Returns the floats with both signs, and zero.
fn signed(bits: u32, exponents: Range<i32>) -> Vec<Pair> {
    let up = positives(bits, exponents);
    let down: Vec<_> = up.iter().map(|(x, value)| (-x, -value)).collect();
    let zero = (Exact::zero().to_mpfr(bits), Exact::zero());
    [down, vec![zero], up].concat()
}

struct Grid {
    stiffnesses: Vec<Pair>,
    masses: Vec<Pair>,
    penalties: Vec<Pair>,
    others: Vec<Pair>,
    tolerance: Pair,
    start: Mpfr,
}

impl Grid {
    fn new(bits: u32, exponents: Range<i32>) -> Self {
        // Within reach of some of the iterations at these precisions, not of all.
        let tolerance = Exact::power_of_two(1 - bits as i32);
        Grid {
            stiffnesses: positives(bits, 0..1),
            masses: positives(bits, 0..1),
            penalties: positives(bits, exponents.clone()),
            others: signed(bits, exponents),
            tolerance: (tolerance.to_mpfr(bits), tolerance),
            start: Exact::zero().to_mpfr(bits),
        }
    }

    /// Returns the number of systems, each with all penalties.
    fn len(&self) -> usize {
        self.stiffnesses.len() * self.masses.len() * self.others.len().pow(3)
    }

    /// Returns the system with an index below [`len`](Self::len): c, m, g, l, H.
    fn get(&self, mut index: usize) -> [&Pair; 5] {
        let Grid { stiffnesses, masses, others, .. } = self;
        [stiffnesses, masses, others, others, others].map(|list| {
            let own = index % list.len();
            index /= list.len();
            &list[own]
        })
    }

    /// Checks every `stride`-th system with all penalties, and returns the counts of events.
    fn check(&self, stride: usize) -> Tally {
        let one = |i| {
            let mut tally = Tally::default();
            self.check_one(i * stride, &mut tally);
            tally
        };
        let add = |a: Tally, b: Tally| std::array::from_fn(|kind| a[kind] + b[kind]);
        (0..self.len().div_ceil(stride)).into_par_iter().map(one).reduce(Tally::default, add)
    }

    fn check_one(&self, index: usize, tally: &mut Tally) {
        let [c, m, g, l, h] = self.get(index);
        let [cf, mf, gf, lf, hf] = [c, m, g, l, h].map(|(x, _)| x.clone());
        let system = SpringMass { c: cf, m: mf, g: gf, l: lf, h: hf };
        let c = &c.1;
        let gap = &h.1 - &l.1;
        let r = &m.1 * &g.1 - c * &gap;
        let state = match r.cmp(&Exact::zero()) {
            Ordering::Less => State::Separated,
            Ordering::Equal => State::Grazing,
            Ordering::Greater => State::Contact,
        };
        tally[state as usize] += self.penalties.len();
        // c p + N = R.
        let force = r.positive_part();
        let p = (&r - &force) / c;
        let u = &gap + &p;

        let judge = |answer: &Solution<Mpfr>, [u, p, n]: [&Exact; 3]| {
            assert_eq!(answer.state, state, "{system:?}");
            let Bounds { deflection, penetration, contact_force, .. } = &answer.bounds;
            for (interval, x) in [(deflection, u), (penetration, p), (contact_force, n)] {
                assert!(encloses(interval, x), "{x} not in {interval:?}: {system:?}");
            }
            assert!(answer.contact_force >= Mpfr::zero(), "the plane pulls: {system:?}");
        };
        let answer = solve(&system, &Method::Lagrange).unwrap();
        judge(&answer, [&u, &p, &force]);
        // However m g and c (H − l) are rounded, there is no force where they are equal.
        let force_is_zero = answer.contact_force.is_zero() && answer.bounds.contact_force.width().is_zero();
        assert!(state == State::Contact || force_is_zero, "{answer:?}: {system:?}");
        let bilateral = solve_bilateral(&system, &Method::Lagrange).unwrap();
        assert!(encloses(&bilateral.bounds.contact_force, &r), "{r} not in {bilateral:?}: {system:?}");

        for (penalty, eps) in &self.penalties {
            let answer = solve(&system, &Method::Penalty { penalty: penalty.clone() }).unwrap();
            let p_eps = if state == State::Separated { p.clone() } else { &r / (c + eps) };
            let n_eps = if state == State::Separated { int(0) } else { eps * &p_eps };
            judge(&answer, [&(&gap + &p_eps), &p_eps, &n_eps]);

            let augmented = Method::Augmented {
                penalty: penalty.clone(),
                tolerance: self.tolerance.0.clone(),
                max_augmentations: MAX_AUGMENTATIONS,
                start: self.start.clone(),
            };
            let answer = solve(&system, &augmented).unwrap();
            judge(&answer, [&u, &p, &force]);
            self.promise(&answer, &u, &system, tally);
            if state == State::Separated {
                let answer = solve_bilateral(&system, &augmented).unwrap();
                self.promise(&answer, &gap, &system, tally);
            }
        }
    }

    fn promise(&self, answer: &Solution<Mpfr>, u: &Exact, system: &SpringMass<Mpfr>, tally: &mut Tally) {
        let error = (exact(&answer.deflection) - u).abs();
        match answer.outcome {
            Outcome::Converged => {
                assert!(error < self.tolerance.1, "converged and off by {error}: {system:?}");
                tally[3] += 1;
            }
            Outcome::Stagnated => {
                assert!(error <= exact(answer.floor.as_ref().unwrap()), "off by {error}: {system:?}");
                tally[4] += 1;
            }
            other => panic!("an iteration ended as {other:?}"),
        }
    }
}

/// Numbers of systems of each state, and of iterations that converged and that stagnated.
type Tally = [usize; 5];

/// Checks one kind of floats: one system in `stride`, which is coprime to the lengths of all lists, so that every
/// entry of every list has its turn; with `DEEP=1` all systems.
fn check(bits: u32, exponents: Range<i32>, systems: usize, stride: usize) {
    let stride = if is_deep() { 1 } else { stride };
    let grid = Grid::new(bits, exponents);
    assert_eq!(grid.len() * grid.penalties.len(), systems);
    let tally = grid.check(stride);
    assert_eq!(tally[..3].iter().sum::<usize>(), grid.len().div_ceil(stride) * grid.penalties.len());
    assert!(tally.iter().all(|n| *n > 0), "{tally:?}");
}

#[test]
fn solutions_of_systems_of_2_bits_are_enclosed() {
    check(2, 0..3, 52_728, 1);
}

#[test]
fn solutions_of_systems_of_3_bits_are_enclosed() {
    check(3, 0..2, 628_864, 11);
}

#[test]
fn solutions_of_systems_of_4_bits_are_enclosed() {
    check(4, 0..1, 2_515_456, 101);
}
