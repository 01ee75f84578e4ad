//! Sweeps of the penalty: rows compared with `solve`, errors compared with R, and the best penalty.

use crate::strategies::*;
use spring_mass_contact::chapter::rounding;
use spring_mass_contact::solver::{SweepRow, best_penalty, penalties, penalty_force_bound, sweep};

/// Returns the rows of some penalties.
fn rows<T: Scalar + ToExact>(system: &SpringMass<T>, penalties: &[T]) -> Vec<SweepRow<T>> {
    let rows: Vec<_> = sweep(system, penalties.iter().cloned()).collect::<Result<_, _>>().unwrap();
    assert_eq!(rows.len(), penalties.len());
    rows
}

/// Returns the row of the penalty of a case.
fn row<T: Scalar + ToExact>(case: &Case<T>) -> SweepRow<T> {
    rows(&case.system, std::slice::from_ref(&case.eps)).swap_remove(0)
}

/// Returns the relative error c/(c + ε) of the penalty force.
fn short(s: &SpringMass<Exact>, eps: &Exact) -> Exact {
    &s.c / (&s.c + eps)
}

/// Returns η for 53 bits.
fn eta() -> Exact {
    Exact::power_of_two(-53)
}

/// A row equals the result of `solve`, ε p is `rounded` once, and both errors are relative to the exact force.
fn equals_a_solve<T: Scalar + ToExact>(case: &Case<T>, rounded: impl Fn(&Exact) -> T) {
    let (found, answer) = (row(case), solve(&case.system, &case.penalty()).unwrap());
    assert_eq!(found.penalty, case.eps);
    assert_eq!(found.deflection, answer.deflection);
    assert_eq!(found.penetration, answer.penetration);
    assert_eq!(found.contact_force, answer.contact_force);
    let product = exact(&case.eps) * exact(&answer.penetration);
    let force = (answer.state != State::Separated).then(|| rounded(&product));
    assert_eq!(found.penalty_force, force);
    // No force is what a plane pushes with that does not, and nothing is a part of it.
    let r = pushing(&case.system.as_ref().map(exact));
    let relative = |n: &T| (!r.is_zero()).then(|| (exact(n) / &r - int(1)).abs());
    assert_eq!(found.force_error, relative(&found.contact_force));
    assert_eq!(found.penalty_force_error, force.as_ref().and_then(relative));
}

fn a_row_is_a_solve<T: Float>(case: &Case<T>) {
    equals_a_solve(case, |product| case.round(product));
}

/// The theorem about (1.12) in numbers: ε p̂ deviates from R by the fraction c/(c + ε), except for rounding.
fn the_error_is_the_springs_until_rounding<T: Float>(floats: &Case<T>) {
    let Case { system: s, eps, .. } = &floats.exact();
    let (r, eta, precision) = (system::reaction(s), floats.eta(), floats.precision());
    let bound = penalty_force_bound(&floats.system, &floats.eps, &eta).unwrap();
    assert_eq!(bound.is_some(), r > int(0));
    let Some(bound) = bound else { return };
    let (short, of_rounding) = (short(s, eps), rounding::penalty_force_error(s, eps, &precision) / &r);
    assert_eq!(bound, &short + &of_rounding);
    let found = row(floats);
    let error = found.penalty_force_error.unwrap();
    assert!(error <= bound && (&error - &short).abs() <= of_rounding);
    // m g − c û: what û is off by, and three roundings. This bound falls with every ε.
    let product = |a: &T, b: &T| exact(&(a * b)).abs();
    let SpringMass { c, m, g, .. } = &floats.system;
    let terms = product(m, g) + product(c, &found.deflection) + exact(&found.contact_force);
    let of_rounding = &s.c * rounding::deflection_error(s, eps, &precision) + eta * terms;
    // It is no less than 0 where it would be by rounding.
    assert!(found.force_error.unwrap() <= short + of_rounding / r);
}

/// The bound at ε̂, which is ε* rounded, is less than at ε̂/2 or less, and at 2 ε̂ or more. With s = c + ε
/// and x = s √κ it is c √κ (x + 1/x) plus a constant, and x + 1/x = 2 + (x − 1)²/x. With e = ε* √κ < 1,
/// rounding leaves x within η e of 1, so (x − 1)²/x ≤ η² e²/(1 − η). At ε̂/2 this term is at least (½ − η)²
/// e², and at 2 ε̂ at least (1 − 2η)² e²/(2 + 2η); both are larger for η ≤ 1/8.
fn no_penalty_is_better_than_the_best<T: Float>(floats: &Case<T>) {
    let s = &floats.system.as_ref().map(exact);
    let r = system::reaction(s);
    let bound = |eps: &Exact| short(s, eps) + rounding::penalty_force_error(s, eps, &floats.precision()) / &r;
    if let Some(best) = best_penalty(&floats.system, &floats.eta()).unwrap() {
        let best = exact(&best);
        assert!(r > int(0) && best > int(0));
        for factor in ["1/2", "2", "1/1000", "1000", "1e-9", "1e9"].map(q) {
            assert!(bound(&best) < bound(&(&best * factor)));
        }
    } else if r > int(0) {
        // It only falls, where no length can be lost, or only rises.
        let falls = s.h.is_zero() && s.l.is_zero();
        let bounds: Vec<_> = (-90..90).step_by(9).map(|n| bound(&(&s.c * Exact::power_of_two(n)))).collect();
        assert!(bounds.is_sorted_by(|a, b| if falls { a > b } else { a < b }));
    }
}

in_every_float! {
    a_row_is_a_solve from any_state;
    the_error_is_the_springs_until_rounding from any_state;
    no_penalty_is_better_than_the_best from in_contact;
}

/// Without a contact force no penalty is best either.
#[test]
fn a_row_of_rationals_is_a_solve() {
    holds(any_state(WIDE), |case| {
        let Case { system: s, eps, .. } = case;
        equals_a_solve(case, Exact::clone);
        let found = row(case);
        let touching = case.reaction() > int(0);
        let short = touching.then(|| short(s, eps));
        if touching {
            assert_eq!((&found.force_error, &found.penalty_force_error), (&short, &short));
        } else {
            assert_eq!(best_penalty(s, &eta()).unwrap(), None);
            assert_eq!(penalty_force_bound(s, eps, &eta()).unwrap(), None);
        }
        assert_eq!(penalty_force_bound(s, eps, &int(0)).unwrap(), short);
        assert_eq!(best_penalty(s, &int(0)).unwrap(), None);
    });
}

/// The laws hold for every precision, including the smallest.
#[test]
fn few_bits_suffice() {
    holds((in_contact(WIDE), 2u32..8), |(case, bits)| {
        the_error_is_the_springs_until_rounding(&case.rounded(&float(*bits)));
    });
}

/// Between the ends xᵢ is the ideal from (to/from)^(i/(n−1)) to within half a unit of its third digit,
/// which is 1/200 of it; the comparison raises both to the power n − 1.
#[test]
fn penalties_are_spaced_by_powers() {
    holds((positive(WIDE), positive(8), 2u32..9), |(from, more, n)| {
        let ratio = int(1) + more;
        let to = from * &ratio;
        let list = penalties(from, &to, *n).unwrap();
        assert_eq!((list.len() as u32, list.first(), list.last()), (*n, Some(from), Some(&to)));
        assert!(list.is_sorted_by(|a, b| a < b));
        let all = n - 1;
        for (i, x) in (0..).zip(&list) {
            let off = power(&(x / from), all) / power(&ratio, i);
            let [least, most] = ["199/200", "201/200"].map(|part| power(&q(part), all));
            assert!(least <= off && off <= most, "{x} of {n}");
        }
    });
}

/// Penalties of any magnitude have three digits: 10⁴ √2 = 14142…, and 1/√2 of 10⁻⁴.
#[test]
fn large_and_small_penalties_have_three_digits() {
    let between = |from, to| penalties(&q(from), &q(to), 3).unwrap().swap_remove(1);
    assert_eq!([between("1e4", "2e4"), between("5e-5", "1e-4")], ["14100", "0.0000707"].map(q));
}

/// The root is computed to the digits of the scalar: it is that of (c + ε)² = c R/(η L (1 + 8 η)), L = |H| +
/// 5 |Δ|, to within one rounding of ε, 2 η, and the preceding rounding errors.
#[test]
fn the_best_penalty_has_the_digits_of_its_scalar() {
    fn has_its_digits<T: Float>(like: &T) {
        let system = default_system().as_ref().map(|x| like.round_from_exact(x).unwrap());
        let (s, eta) = (system.as_ref().map(exact), unit_roundoff(like));
        let best = exact(&best_penalty(&system, &eta).unwrap().unwrap());
        let lengths = s.h.abs() + int(5) * system::gap(&s).abs();
        let square = &s.c * system::reaction(&s) / (&eta * lengths * (int(1) + int(8) * &eta));
        assert!((power(&(s.c + best), 2) / square - int(1)).abs() < int(4) * eta);
    }
    has_its_digits(&1f64);
    has_its_digits(&float(300));
}

/// If rounding of lengths has no effect, every larger ε is better; if R is negligible compared with c Δ,
/// every smaller ε is better.
#[test]
fn there_need_be_no_best_penalty() {
    let light = SpringMass { c: 1.0, m: 1.0, g: 1.0, l: 0.0, h: 0.0 };
    for system in [light, SpringMass { g: 1.0 + f64::EPSILON, h: 1.0, ..light }] {
        assert_eq!(best_penalty(&system, &eta()).unwrap(), None);
    }
}

/// R = 1.68·10³⁰⁸ fits f64; but p = 140 is rounded to 256, the next number after 2⁶⁰, so ε p overflows.
#[test]
fn a_force_that_does_not_fit_is_refused() {
    let length = 2_f64.powi(60);
    let system = SpringMass { c: 1.0, m: 1.68e308, g: 1.0, l: length, h: length };
    let error = sweep(&system, [1.2e306]).next().unwrap().unwrap_err();
    assert_eq!(error, SolveError::OutOfRange { quantity: "penalty force" });
}

/// In words; that each argument is refused by name is in `results`.
#[test]
fn bad_input_is_refused() {
    let none: Vec<_> = sweep(&example(), []).map(|row| row.unwrap_err().to_string()).collect();
    assert_eq!(none, ["penalties []: must be nonempty"]);
    let negative = best_penalty(&example(), &int(-1)).unwrap_err();
    assert_eq!(negative.to_string(), "unit roundoff -1: must be at least 0");
    let refused = penalties(&int(1), &int(1), 2).unwrap_err();
    assert_eq!(refused.to_string(), "last penalty 1: must be greater than the first");
    // Nor can f64 hold a best penalty of 10³¹².
    let stiff = SpringMass { c: 1e305, m: 1e306, g: 1.0, l: 1e-9, h: 1e-9 };
    assert_eq!(best_penalty(&stiff, &eta()), Err(SolveError::OutOfRange { quantity: "best penalty" }));
    // Penalties are told apart by a hundred digits, and no more.
    let beside = |n| int(1) + int(1) / power(&int(10), n);
    assert_eq!(penalties(&int(1), &beside(98), 3).unwrap().len(), 3);
    assert!(penalties(&int(1), &beside(101), 3).is_err());
    assert_eq!(penalties(&int(1), &beside(101), 2).unwrap(), [int(1), beside(101)]);
}
