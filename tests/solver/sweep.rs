//! Sweeps of the penalty: rows compared with `solve`, errors compared with R, and the best penalty.

use crate::in_every_float;
use crate::strategies::*;
use num_traits::Zero;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, rounding, system};
use spring_mass_contact::number::{Exact, PositivePart, ToExact};
use spring_mass_contact::solver::{
    Scalar, SolveError, State, SweepRow, best_penalty, penalties, penalty_force_bound, solve, sweep,
};

fn number(text: &str) -> Exact {
    text.parse().unwrap()
}

/// Returns the row of one penalty.
fn row<T: Scalar + ToExact>(system: &SpringMass<T>, eps: &T) -> SweepRow<T> {
    let rows: Vec<_> = sweep(system, [eps.clone()]).collect::<Result<_, _>>().unwrap();
    assert_eq!(rows.len(), 1);
    rows.into_iter().next().unwrap()
}

/// Returns the relative error c/(c + ε) of the penalty force.
fn short(s: &SpringMass<Exact>, eps: &Exact) -> Exact {
    &s.c / (&s.c + eps)
}

/// A row equals the result of `solve`, ε p is rounded once, and both errors are relative to the exact force.
fn a_row_is_a_solve<T: Scalar + ToExact>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let (found, answer) =
        (row(&floats.system, &floats.eps), solve(&floats.system, &floats.penalty()).unwrap());
    prop_assert_eq!(&found.penalty, &floats.eps);
    prop_assert_eq!(&found.deflection, &answer.deflection);
    prop_assert_eq!(&found.penetration, &answer.penetration);
    prop_assert_eq!(&found.contact_force, &answer.contact_force);
    let product = exact(&floats.eps) * exact(&answer.penetration);
    let force = (answer.state != State::Separated).then(|| like.round_from_exact(&product).unwrap());
    prop_assert_eq!(&found.penalty_force, &force);
    // No force is what a plane pushes with that does not, and nothing is a part of it.
    let r = pushing(&floats.exact().system);
    let relative = |n: &T| (!r.is_zero()).then(|| (exact(n) / &r - int(1)).abs());
    prop_assert_eq!(&found.force_error, &relative(&found.contact_force));
    prop_assert_eq!(&found.penalty_force_error, &force.as_ref().and_then(relative));
    Ok(())
}

/// The theorem about (1.12) in numbers: ε p̂ deviates from R by the fraction c/(c + ε), except for rounding.
fn the_error_is_the_springs_until_rounding<T: Float>(
    case: &Case<Exact>,
    like: &T,
) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let Case { system: s, eps, .. } = floats.exact();
    let r = system::reaction(&s);
    let eta = unit_roundoff(like);
    let bound = penalty_force_bound(&floats.system, &floats.eps, &eta).unwrap();
    prop_assert_eq!(bound.is_some(), r > int(0));
    let Some(bound) = bound else { return Ok(()) };
    let (short, of_rounding) =
        (short(&s, &eps), rounding::penalty_force_error(&s, &eps, &(int(1) / &eta)) / &r);
    prop_assert_eq!(&bound, &(&short + &of_rounding));
    let found = row(&floats.system, &floats.eps);
    let error = found.penalty_force_error.unwrap();
    prop_assert!(error <= bound, "{:?}", floats);
    prop_assert!((&error - &short).abs() <= of_rounding, "{:?}", floats);
    // m g − c û: what û is off by, and three roundings. This bound falls with every ε.
    let product = |a: &T, b: &T| exact(&(a * b)).abs();
    let (weight, of_spring) =
        (product(&floats.system.m, &floats.system.g), product(&floats.system.c, &found.deflection));
    let of_rounding = &s.c * rounding::deflection_error(&s, &eps, &(int(1) / &eta))
        + &eta * (weight + of_spring + exact(&found.contact_force));
    // It is no less than 0 where it would be by rounding.
    let error = found.force_error.unwrap();
    prop_assert!(error <= short + of_rounding / r, "{:?}", floats);
    Ok(())
}

/// The bound at ε̂, which is ε* rounded, is less than at ε̂/2 or less, and at 2 ε̂ or more. With s = c + ε
/// and x = s √κ it is c √κ (x + 1/x) plus a constant, and x + 1/x = 2 + (x − 1)²/x. With e = ε* √κ < 1,
/// rounding leaves x within η e of 1, so (x − 1)²/x ≤ η² e²/(1 − η). At ε̂/2 this term is at least (½ − η)²
/// e², and at 2 ε̂ at least (1 − 2η)² e²/(2 + 2η); both are larger for η ≤ 1/8.
fn no_penalty_is_better_than_the_best<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let floats = case.rounded(like);
    let s = floats.exact().system;
    let eta = unit_roundoff(like);
    let bound = |eps: &Exact| {
        let rounding = rounding::penalty_force_error(&s, eps, &(int(1) / &eta));
        short(&s, eps) + rounding / system::reaction(&s)
    };
    let best = best_penalty(&floats.system, &eta).unwrap();
    let touching = system::reaction(&s) > int(0);
    if let Some(best) = &best {
        let best = exact(best);
        prop_assert!(touching && best > int(0));
        for factor in ["1/2", "2", "1/1000", "1000", "1/1000000000", "1000000000"].map(number) {
            prop_assert!(bound(&best) < bound(&(&best * factor)), "{:?}", floats);
        }
    } else if touching {
        // It only falls, where no length can be lost, or only rises.
        let falls = s.h.is_zero() && s.l.is_zero();
        let bounds: Vec<_> = (-90..90).step_by(9).map(|n| bound(&(&s.c * Exact::power_of_two(n)))).collect();
        let ordered = |pair: &[Exact]| if falls { pair[0] > pair[1] } else { pair[0] < pair[1] };
        prop_assert!(bounds.windows(2).all(ordered), "{:?}", floats);
    }
    Ok(())
}

in_every_float! {
    a_row_is_a_solve from any_state;
    the_error_is_the_springs_until_rounding from any_state;
    no_penalty_is_better_than_the_best from in_contact;
}

proptest! {
    #[test]
    fn a_row_of_rationals_is_a_solve(case in any_state(WIDE)) {
        a_row_is_a_solve(&case, &int(0))?;
        let found = row(&case.system, &case.eps);
        if reaction(&case) > int(0) {
            let short = Some(short(&case.system, &case.eps));
            prop_assert_eq!((&found.force_error, &found.penalty_force_error), (&short, &short));
            prop_assert_eq!(penalty_force_bound(&case.system, &case.eps, &int(0)).unwrap(), short);
        }
        prop_assert_eq!(best_penalty(&case.system, &int(0)).unwrap(), None);
    }

    /// The laws hold for every precision, including the smallest.
    #[test]
    fn few_bits_suffice(case in in_contact(WIDE), bits in 2u32..8) {
        the_error_is_the_springs_until_rounding(&case, &int(1).to_mpfr(bits))?;
    }

    /// Without a contact force no penalty is best.
    #[test]
    fn without_contact_no_penalty_is_best(case in prop_oneof![grazing(WIDE), separated(WIDE)]) {
        prop_assert_eq!(best_penalty(&case.system, &Exact::power_of_two(-53)).unwrap(), None);
        prop_assert_eq!(penalty_force_bound(&case.system, &case.eps, &Exact::power_of_two(-53)).unwrap(), None);
    }

    /// Between the ends xᵢ is the ideal from (to/from)^(i/(n−1)) to within half a unit of its third digit,
    /// which is 1/200 of it; the comparison raises both to the power n − 1.
    #[test]
    fn penalties_are_spaced_by_powers(from in positive(WIDE), more in positive(8), n in 2u32..9) {
        let ratio = int(1) + more;
        let to = &from * &ratio;
        let list = penalties(&from, &to, n).unwrap();
        prop_assert_eq!((list.len() as u32, list.first(), list.last()), (n, Some(&from), Some(&to)));
        prop_assert!(list.windows(2).all(|pair| pair[0] < pair[1]));
        let all = n - 1;
        for (i, x) in (0..).zip(&list) {
            let off = power(&(x / &from), all) / power(&ratio, i);
            let [least, most] = [199, 201].map(|part| power(&(int(part) / int(200)), all));
            prop_assert!(least <= off && off <= most, "{} of {}", x, n);
        }
    }
}

/// Penalties of any magnitude have three digits: 10⁴ √2 = 14142…, and 1/√2 of 10⁻⁴.
#[test]
fn large_and_small_penalties_have_three_digits() {
    let between = |from, to| penalties(&number(from), &number(to), 3).unwrap().swap_remove(1);
    assert_eq!([between("1e4", "2e4"), between("5e-5", "1e-4")], ["14100", "0.0000707"].map(number));
}

fn default_system() -> SpringMass<Exact> {
    SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap()
}

/// The default system, from ten times c to where rounding may be a tenth of the error.
fn falls_with_slope_minus_one<T: Float>(like: &T, most: i32) {
    let system = default_system().map(|x| like.round_from_exact(x).unwrap());
    let eta = unit_roundoff(like);
    let exactly = system.map(exact);
    let eps = (3..=most).map(|n| like.round_from_exact(&power(&int(10), n as u32)).unwrap());
    let rows: Vec<_> = sweep(&system, eps).collect::<Result<_, _>>().unwrap();
    // Of errors times c + ε the slope −1 makes a constant, which is c: by the law up to a part that is small.
    for row in &rows {
        let (eps, error) = (exact(&row.penalty), row.penalty_force_error.clone().unwrap());
        let short = short(&exactly, &eps);
        let part = (penalty_force_bound(&system, &row.penalty, &eta).unwrap().unwrap() - &short) / &short;
        assert!(part < number("1/10"), "ε = {eps}: {part:?}");
        assert!((error * (&exactly.c + eps) / &exactly.c - int(1)).abs() <= part);
    }
}

#[test]
fn soft_penalties_err_with_slope_minus_one() {
    // ε* is 8·10⁴ in f32, 1.8·10⁹ in f64 and 2.3·10²⁵ in 160 bits: rounding is a tenth of the error at a third of it.
    falls_with_slope_minus_one(&1f32, 4);
    falls_with_slope_minus_one(&1f64, 8);
    falls_with_slope_minus_one(&int(1).to_mpfr(160), 24);
}

/// Beyond the best penalty the error of ε p grows to R and more; that of m g − c u does not.
#[test]
fn stiff_penalties_lose_the_penalty_force_alone() {
    let system = default_system().try_map(Exact::to_f64).unwrap();
    let best = best_penalty(&system, &Exact::power_of_two(-53)).unwrap().unwrap();
    // √(c R/(η L)) with L = 1.05 + 5 · 0.05.
    let expected = (100.0 * 4.81 * 2_f64.powi(53) / 1.3).sqrt() - 100.0;
    assert!((best / expected - 1.0).abs() < 1e-12, "{best}");
    let rows: Vec<_> = sweep(&system, [best, 1e12, 1e14, 1e17]).collect::<Result<_, _>>().unwrap();
    let errors: Vec<_> =
        rows.iter().map(|row| row.penalty_force_error.as_ref().unwrap().to_f64().unwrap()).collect();
    assert!(errors.windows(2).all(|pair| 9.0 * pair[0] < pair[1]) && errors[3] == 1.0, "{errors:?}");
    let by_spring = rows.iter().map(|row| row.force_error.as_ref().unwrap());
    assert!(by_spring.collect::<Vec<_>>().windows(2).all(|pair| pair[0] > pair[1]));
}

/// The root is computed to the digits of the scalar: it is that of (c + ε)² = c R/(η L (1 + 8 η)), L = |H| +
/// 5 |Δ|, to within one rounding of ε to 300 bits, 2 · 2⁻³⁰⁰, and the preceding rounding errors.
#[test]
fn the_best_penalty_has_the_digits_of_its_scalar() {
    let system = default_system().map(|x| x.to_mpfr(300));
    let eta = Exact::power_of_two(-300);
    let best = exact(&best_penalty(&system, &eta).unwrap().unwrap());
    let SpringMass { c, m, g, l, h } = system.map(exact);
    let gap = &h - &l;
    let reaction = m * g - &c * &gap;
    let lengths = h.abs() + int(5) * gap.abs();
    let square = &c * reaction / (&eta * lengths * (int(1) + int(8) * &eta));
    let total = &c + best;
    assert!((&total * &total / square - int(1)).abs() < Exact::power_of_two(-298));
}

/// If rounding of lengths has no effect, every larger ε is better; if R is negligible compared with c Δ,
/// every smaller ε is better.
#[test]
fn there_need_be_no_best_penalty() {
    let system = SpringMass { c: 1.0, m: 1.0, g: 1.0, l: 0.0, h: 0.0 };
    assert_eq!(best_penalty(&system, &Exact::power_of_two(-53)).unwrap(), None);
    let system = SpringMass { c: 1.0, m: 1.0, g: 1.0 + f64::EPSILON, l: 0.0, h: 1.0 };
    assert_eq!(best_penalty(&system, &Exact::power_of_two(-53)).unwrap(), None);
}

/// R = 1.68·10³⁰⁸ fits f64; but p = 140 is rounded to 256, the next number after 2⁶⁰, so ε p overflows.
#[test]
fn a_force_that_does_not_fit_is_refused() {
    let length = 2_f64.powi(60);
    let system = SpringMass { c: 1.0, m: 1.68e308, g: 1.0, l: length, h: length };
    let error = sweep(&system, [1.2e306]).next().unwrap().unwrap_err();
    assert_eq!(error, SolveError::OutOfRange { quantity: "penalty force" });
}

#[test]
fn bad_input_is_refused() {
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    for eps in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(sweep(&system, [eps]).next().unwrap().is_err(), "{eps}");
    }
    let none = sweep(&system, []).map(|row| row.unwrap_err().to_string());
    assert_eq!(none.collect::<Vec<_>>(), ["penalties []: must be nonempty"]);
    assert!(best_penalty(&SpringMass { c: -1.0, ..system }, &Exact::power_of_two(-53)).is_err());
    let negative = best_penalty(&system, &int(-1)).unwrap_err();
    assert_eq!(negative.to_string(), "unit roundoff -1: must be at least 0");
    // Nor can f64 hold a best penalty of 10³¹².
    let stiff = SpringMass { c: 1e305, m: 1e306, g: 1.0, l: 1e-9, h: 1e-9 };
    let refused = Err(SolveError::OutOfRange { quantity: "best penalty" });
    assert_eq!(best_penalty(&stiff, &Exact::power_of_two(-53)), refused);
    for (from, to, points, argument) in [
        ("0", "1", 2, "first penalty"),
        ("-1", "1", 2, "first penalty"),
        ("1", "1", 2, "last penalty"),
        ("2", "1", 2, "last penalty"),
        ("1", "2", 1, "number of penalties"),
        ("1", "2", 0, "number of penalties"),
    ] {
        match penalties(&number(from), &number(to), points) {
            Err(SolveError::Invalid { argument: named, .. }) => assert_eq!(named, argument),
            other => panic!("{from}..{to}, {points}: {other:?}"),
        }
    }
    let refused = penalties(&int(1), &int(1), 2).unwrap_err();
    assert_eq!(refused.to_string(), "last penalty 1: must be greater than the first");
    // They are told apart by a hundred digits, and no more.
    let beside = |n| int(1) + int(1) / power(&int(10), n);
    assert_eq!(penalties(&int(1), &beside(98), 3).unwrap().len(), 3);
    assert!(penalties(&int(1), &beside(101), 3).is_err());
    assert_eq!(penalties(&int(1), &beside(101), 2).unwrap(), [int(1), beside(101)]);
}
