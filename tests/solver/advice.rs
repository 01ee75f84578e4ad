//! Properties of advice: each recommended method reaches the tolerance in every scalar, near grazing as well;
//! each guaranteed method is recommended; without a guarantee, no method reaches the tolerance.

use crate::in_every_float;
use crate::strategies::*;
use num_traits::Zero;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, augmented, penalty, rounding, system};
use spring_mass_contact::number::{Exact, ExactText, PositivePart, ToExact};
use spring_mass_contact::solver::{
    Advice, MAX_AUGMENTATIONS, Method, Outcome, Plane, Recommendation, Scalar, Solution, advise,
    exact_augmentation_count, guaranteed_max_augmentations, penalty_for_penetration, required_precision,
    rounding_floor, solve,
};

/// Returns `true` if a run meets the tolerance and, for an iteration, reports it.
fn reaches<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    method: &Method<T>,
    tolerance: &Exact,
) -> Result<Solution<T>, String> {
    let solution = solve(system, method).map_err(|error| error.to_string())?;
    let off = (exact(&solution.deflection) - resting(&system.map(exact))).abs();
    let said = matches!(solution.outcome, Outcome::Direct | Outcome::Converged);
    if said && off < *tolerance { Ok(solution) } else { Err(format!("off by {off}, {}", solution.outcome)) }
}

/// With at most three bits 1 − 8 η ≤ 0, so no tolerance is guaranteed.
#[test]
fn with_few_bits_nothing_is_guaranteed() {
    let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse().unwrap();
    for bits in 0..6 {
        for (eps, tolerance) in [("1", "1"), ("1e9", "1e9"), ("1e-9", "1e9"), ("1e9", "1e-9")] {
            let [eps, tolerance] = [eps, tolerance].map(|x| x.parse::<Exact>().unwrap());
            let eta = Exact::power_of_two(-bits);
            assert_eq!(
                guaranteed_max_augmentations(&system, &eps, &tolerance, &eta),
                Ok(None),
                "{bits} bits"
            );
        }
    }
}

/// m g of 10 bits is rounded to 10 bits, so the coarsest parameter determines the floor. A tolerance between
/// this floor and that of the finest parameter is not guaranteed.
#[test]
fn the_coarsest_parameter_determines_the_guarantee() {
    let like = [10, 10, 10, 200, 200].map(|bits| int(1).to_mpfr(bits));
    let numbers = SpringMass { c: "4", m: "1.1", g: "9.81", l: "1", h: "3" }.parse().unwrap();
    let SpringMass { c, m, g, l, h } = &numbers;
    let mut rounded = like.iter().zip([c, m, g, l, h]).map(|(like, x)| like.round_from_exact(x).unwrap());
    let mut next = || rounded.next().unwrap();
    let system = SpringMass { c: next(), m: next(), g: next(), l: next(), h: next() };
    let floor = |bits: i32| rounding_floor(&system, Plane::Unilateral, &Exact::power_of_two(-bits)).unwrap();
    let tolerance = floor(10).unwrap() / int(2);
    assert!(tolerance > floor(200).unwrap() * int(1000));
    let advice = advise(&system, &tolerance.to_mpfr(200)).unwrap();
    assert_eq!(advice.floor, floor(10));
    assert!(
        !advice.recommendations.iter().any(|choice| matches!(choice.method, Method::Augmented { .. })),
        "{advice}"
    );
}

/// The tolerance is rounded as well and must remain above the floor.
#[test]
fn bits_are_needed_for_the_tolerance_as_well() {
    let system: SpringMass<Exact> = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse().unwrap();
    let mut rounded_down = 0;
    for bits in 6..30 {
        let floor = |bits: u32| {
            rounding_floor(&system, Plane::Unilateral, &Exact::power_of_two(-(bits as i32))).unwrap().unwrap()
        };
        // A little above the floor, and the parameters are the same in all of these bits.
        let tolerance = floor(bits) * (int(1) + Exact::power_of_two(-60));
        let enough = |bits: u32| floor(bits) < tolerance.round_to_bits(bits).unwrap();
        let least = (6..).find(|bits| enough(*bits));
        assert_eq!(required_precision(&system, Plane::Unilateral, &tolerance), Ok(least));
        rounded_down += u32::from(least == Some(bits + 1));
    }
    assert!((1..24).contains(&rounded_down), "{rounded_down}");
}

/// Returns the recommended penalties.
fn advised<T: Scalar + ExactText>(system: &SpringMass<T>, tolerance: &T) -> Vec<T> {
    let choices = advise(system, tolerance).unwrap().recommendations;
    choices.iter().filter_map(|choice| choice.method.penalty().cloned()).collect()
}

/// R = 2, c = 4: p = R/(c + ε) is 1/4 for ε = 4, and smaller for the next number with two digits; it is
/// 25/101 for ε = 4.08. For p < 1 no penalty is needed, since R/c = 1/2.
#[test]
fn the_softest_penalty_has_two_digits() {
    let system: SpringMass<Exact> = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse().unwrap();
    let softest = |tolerance| advised(&system, &tolerance)[0].clone();
    assert_eq!(softest(int(1) / int(4)), int(41) / int(10));
    assert_eq!(softest(int(25) / int(101)), int(41) / int(10));
    assert_eq!(softest(int(1)), int(40));
    // The f64 beside 0.3 is less than that, and yet no softer than it may be.
    let light = SpringMass { c: 1.0, m: 1.0, g: 1.295, l: 0.0, h: 0.0 };
    assert_eq!(advised(&light, &1.0)[0], 0.3);
    let least = |tolerance| penalty_for_penetration(&system, &tolerance).unwrap();
    assert_eq!([least(int(1) / int(4)), least(int(1) / int(2))], [Some(int(4)), None]);
}

/// Δ = 2: rounding changes the deflection of (1.13) by up to 5 η Δ (1 + 2 η) for every penalty, at grazing as
/// well. This value is not a guaranteed tolerance; every larger one is.
#[test]
fn a_tolerance_below_the_rounding_floor_is_rejected() {
    for g in [2, 3] {
        let system = SpringMass { c: 1, m: 1, g, l: 1, h: 3 }.map(|x| int(*x).to_mpfr(10));
        let eta = Exact::power_of_two(-10);
        let taken = int(10) * &eta * (int(1) + int(2) * &eta);
        let advised = |tolerance: Exact| advised(&system, &tolerance.to_mpfr(99)).len();
        let more = &taken * (int(1) + Exact::power_of_two(-40));
        assert_eq!([advised(taken), advised(more)], [0, 1], "g = {g}");
    }
}

/// If the mass is separated, every penalty method computes m g/c. The augmentation is guaranteed above 5 η m
/// g/c for ε ≥ c.
#[test]
fn a_separated_mass_accepts_any_penalty() {
    let system = SpringMass { c: 1, m: 1, g: 1, l: 0, h: 3 }.map(|x| int(*x).to_mpfr(10));
    let floor = int(5) * Exact::power_of_two(-10);
    let more = &floor * (int(1) + Exact::power_of_two(-40));
    let advice = |tolerance: Exact| advise(&system, &tolerance.to_mpfr(99)).unwrap().recommendations;
    let penalties = |choices: &[Recommendation<_>]| -> Vec<_> {
        choices.iter().map(|choice| choice.penalty_range[0].as_ref().map(exact)).collect()
    };
    assert_eq!(penalties(&advice(floor)), [None, None]);
    let choices = advice(more);
    assert_eq!(choices[1].method.penalty().map(exact), Some(int(10)));
    assert_eq!(penalties(&choices), [None, None, Some(int(1))]);
}

/// Returns the method with another penalty.
fn with_penalty_of<T: Float>(method: &Method<T>, eps: &T) -> Method<T> {
    let penalty = eps.clone();
    match method.clone() {
        Method::Lagrange => Method::Lagrange,
        Method::Penalty { .. } => Method::Penalty { penalty },
        Method::Augmented { tolerance, start, .. } => {
            Method::Augmented { penalty, tolerance, max_augmentations: MAX_AUGMENTATIONS, start }
        }
    }
}

/// Returns penalties in the range, including its ends; without a lower end, down to `part` of the recommended
/// penalty.
fn within<T: Float>(choice: &Recommendation<T>, part: &Exact, like: &T) -> Vec<T> {
    let Some(own) = choice.method.penalty() else { return Vec::new() };
    let [from, to] = &choice.penalty_range;
    let own = exact(own);
    let from = from.as_ref().map_or_else(|| &own * part, exact);
    let to = to.as_ref().map_or_else(|| &own * int(1000), exact);
    assert!(from <= own && own <= to, "{from} {own} {to}");
    let all = [from.clone(), (&from + &own) / int(2), (&own + &to) / int(2), to.clone()];
    // Rounded, what is between two scalars stays between them.
    let mut penalties = Vec::from(all);
    let mut factor = int(1000);
    while power(&factor, 8) * &from < to {
        factor = &factor * &factor;
    }
    let mut eps = from;
    while eps < to {
        penalties.push(eps.clone());
        eps = eps * &factor;
    }
    // A number out of range is not a penalty.
    penalties.iter().filter_map(|eps| like.round_from_exact(eps).ok()).collect()
}

/// Asserts that recommendations hold. If everything `fits` the range of the scalar, each guaranteed method
/// must be present; otherwise penalties may be very small.
fn keeps_its_word<T: Float + ExactText>(
    case: &Case<Exact>,
    tolerance: &Exact,
    like: &T,
    fits: bool,
) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    let Some(tolerance) = like.round_from_exact(tolerance).ok().filter(|tolerance| *tolerance > T::zero())
    else {
        return Ok(());
    };
    let tol = exact(&tolerance);
    let system = &case.system;
    let numbers = system.map(exact);
    let Advice { recommendations: choices, floor, .. } = advise(system, &tolerance).unwrap();
    for choice in &choices {
        let Recommendation { method, augmentations, penetration, force_error, relative_force_error, .. } =
            choice;
        let solution = reaches(system, method, &tol);
        prop_assert!(solution.is_ok(), "{choice:?} {solution:?} {case:?}");
        let solution = solution.unwrap();
        prop_assert_eq!(solution.augmentations, *augmentations);
        prop_assert_eq!(&numbers.l + exact(&solution.deflection) - &numbers.h, penetration.clone());
        let force = pushing(&numbers);
        prop_assert_eq!(&(exact(&solution.contact_force) - &force).abs(), force_error);
        let parts = relative_force_error.as_ref().map(|parts| parts * &force);
        prop_assert_eq!(parts, (!force.is_zero()).then(|| force_error.clone()));
        let part = if fits { int(1) / int(1000) } else { Exact::power_of_two(-200) };
        for eps in within(choice, &part, like) {
            let found = reaches(system, &with_penalty_of(method, &eps), &tol);
            // Without another limit, that of the scalar.
            let beyond = choice.penalty_range[1].is_none() && Some(&eps) > method.penalty();
            if beyond && matches!(&found, Err(error) if error.contains("out of the range")) {
                continue;
            }
            prop_assert!(found.is_ok(), "ε = {eps:?} of {choice:?}: {found:?}, {tol} {case:?}");
        }
    }
    if fits && floor.is_some_and(|floor| tol > floor) {
        prop_assert_eq!(choices.len(), 3, "{:?} at {} {:?}", choices, tol, case);
    }
    if fits && choices.is_empty() {
        let exponents = [-20, -3, 0, 3, 20, 50];
        let penalties =
            exponents.map(|e| like.round_from_exact(&(&numbers.c * Exact::power_of_two(e))).unwrap());
        for eps in penalties.into_iter().chain([case.eps.clone()]) {
            let augmented = Method::Augmented {
                penalty: eps.clone(),
                tolerance: tolerance.clone(),
                max_augmentations: 100,
                start: like.clone() - like,
            };
            for method in [Method::Lagrange, Method::Penalty { penalty: eps.clone() }, augmented] {
                prop_assert!(reaches(system, &method, &tol).is_err(), "{method:?} reaches {tol}: {case:?}");
            }
        }
    }
    Ok(())
}

/// The largest penalty: it increases the proved rounding bound by c tol, except for rounding it down, and a
/// run has an error this small.
fn hardest_is_not_too_hard<T: Float + ExactText>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    let (numbers, tol, eta) = (case.system.map(exact), exact(&case.tolerance), unit_roundoff(like));
    let precision = int(1) / &eta;
    let allowed = &numbers.c * &tol;
    // Rounding down to a float reduces it by at most this.
    let rounded_down = int(1) - int(2) * &eta;
    let advice = advise(&case.system, &case.tolerance).unwrap();
    let r = system::reaction(&numbers);
    for choice in &advice.recommendations {
        let Some(to) = choice.penalty_range[1].clone() else {
            // Without lengths nothing grows; and rounded the mass may hang free.
            let nothing = numbers.h.is_zero() && numbers.l.is_zero() || r < Exact::zero();
            prop_assert!(nothing || matches!(choice.method, Method::Lagrange), "{choice:?} {case:?}");
            continue;
        };
        // The penalty of the method, if every sufficient one grows by more.
        let own = Some(&to) == choice.method.penalty();
        let eps = exact(&to);
        let solution = solve(&case.system, &with_penalty_of(&choice.method, &to)).unwrap();
        match &choice.method {
            Method::Lagrange => unreachable!("without a penalty"),
            Method::Penalty { .. } => {
                let bound = |eps: &Exact| rounding::penalty_force_error(&numbers, eps, &precision);
                let growth = bound(&eps) - bound(&Exact::zero());
                prop_assert!(
                    (own || growth <= allowed) && growth >= &allowed * &rounded_down,
                    "{growth} {allowed} {case:?}"
                );
                if own {
                    continue;
                }
                let computed = exact(&penalty::contact_force(&case.system, &to, &solution.deflection));
                let off = (computed - penalty::contact_force_at_equilibrium(&numbers, &eps)).abs();
                prop_assert!(off <= &allowed + bound(&Exact::zero()), "{off} {choice:?} {case:?}");
            }
            Method::Augmented { .. } => {
                // 11 (c + ε) η (|H| + |Δ|): the part of the drift that grows with ε.
                let lengths = numbers.h.abs() + (&numbers.h - &numbers.l).abs();
                let growth = int(11) * (&numbers.c + &eps) * &eta * lengths;
                prop_assert!(
                    (own || growth <= allowed) && growth >= &allowed * &rounded_down,
                    "{growth} {allowed} {case:?}"
                );
                if own {
                    continue;
                }
                let Some(last) = solution.augmentations else { unreachable!("an augmentation") };
                let lambda = exact(solution.multiplier.as_ref().unwrap());
                let rho = augmented::contraction(&numbers, &eps);
                let exactly =
                    augmented::multiplier_after(&numbers, &Exact::zero(), &power(&rho, last as u32));
                let rest = int(11) * &eta * (&numbers.c + &eps) * &r / &eps;
                prop_assert!((lambda - exactly).abs() <= &allowed + rest, "{choice:?} {case:?}");
            }
        }
    }
    Ok(())
}

/// The smallest penalty is guaranteed, and the next smaller one is not; for the augmentation, one smaller by
/// a ninth.
fn softest_is_soft_enough<T: Float + ExactText>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    let (numbers, tol, eta) = (case.system.map(exact), exact(&case.tolerance), unit_roundoff(like));
    if system::reaction(&numbers) <= Exact::zero() {
        return Ok(());
    }
    let off = |eps: &Exact| {
        penalty::penetration(&numbers, eps) + rounding::deflection_error(&numbers, eps, &(int(1) / &eta))
    };
    let arrives = |eps: &Exact| {
        guaranteed_max_augmentations(&numbers, eps, &tol, &eta)
            .unwrap()
            .is_some_and(|most| most <= MAX_AUGMENTATIONS)
    };
    for choice in advise(&case.system, &case.tolerance).unwrap().recommendations {
        match (&choice.method, &choice.penalty_range[0]) {
            (Method::Lagrange, from) => prop_assert_eq!(from, &None),
            (Method::Penalty { .. }, None) => prop_assert!(off(&Exact::zero()) <= tol),
            (Method::Penalty { .. }, Some(from)) => {
                let softer = exact(&from.neighbours()[0]);
                prop_assert!(off(&exact(from)) <= tol, "{choice:?} {case:?}");
                prop_assert!(off(&softer) >= tol, "{choice:?} {case:?}");
            }
            (Method::Augmented { .. }, from) => {
                let from = exact(from.as_ref().expect("a softest one"));
                prop_assert!(arrives(&from), "{choice:?} {case:?}");
                prop_assert!(!arrives(&(from * int(8) / int(9))), "{choice:?} {case:?}");
            }
        }
    }
    Ok(())
}

/// The guaranteed number of augmentations suffices, at the floor and far above it.
fn promised_augmentations_do<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let eta = unit_roundoff(like);
    let case = case.rounded(like);
    // Where the promise begins: the least tolerance is affine in the drift (see `is_convergence_guaranteed`).
    let numbers = case.system.map(exact);
    let drift = rounding::penetration_drift(&numbers, &exact(&case.eps), &(int(1) / &eta));
    let begins = (drift + &eta * numbers.h.abs()) / (int(1) - int(8) * &eta);
    for share in [int(1001) / int(1000), int(3) / int(2), int(1000)] {
        // Where ε is too soft for any bound of the drift, that formula is negative.
        let tolerance =
            like.round_from_exact(&(&begins * share)).ok().filter(|tolerance| *tolerance > T::zero());
        let Some(tolerance) = tolerance else { continue };
        let promised = guaranteed_max_augmentations(&case.system, &case.eps, &tolerance, &eta).unwrap();
        let Some(most) = promised.and_then(|most| most.to_u64()).filter(|most| *most < 2000) else {
            continue;
        };
        let method = Method::Augmented {
            penalty: case.eps.clone(),
            tolerance: tolerance.clone(),
            max_augmentations: most,
            start: like.clone() - like,
        };
        let found = reaches(&case.system, &method, &exact(&tolerance));
        prop_assert!(found.is_ok(), "{most} for {tolerance:?}: {found:?} {case:?}");
    }
    Ok(())
}

/// Tolerances of the size of the system, far below it, and at the floor.
fn advice_holds<T: Float + ExactText>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    keeps_its_word(case, &case.tolerance, like, true)?;
    let floor = rounding_floor(&case.rounded(like).system, Plane::Unilateral, &unit_roundoff(like)).unwrap();
    for share in [int(1) / int(2), int(101) / int(100), int(2)] {
        // Without lengths there is a floor of underflow alone, and a penalty that meets it may not fit.
        let lengths = !(case.system.h.is_zero() && case.system.l.is_zero());
        if let Some(floor) = floor.as_ref().filter(|floor| lengths && !floor.is_zero()) {
            keeps_its_word(case, &(floor * share), like, true)?;
        }
    }
    Ok(())
}

in_every_float! {
    advice_holds from any_state;
    hardest_is_not_too_hard from in_contact;
    softest_is_soft_enough from in_contact;
    promised_augmentations_do from in_contact;
}

/// Returns a case in such large units that forces of 2ᶠ, stiffnesses, and lengths of 2ˡ approach the smallest
/// floats, with masses of 2ᵐ. Returns `None` if a number or a product of the solver underflows.
fn tiny<T: Float>(case: &Case<Exact>, [force, length, mass]: [i32; 3], like: &T) -> Option<Case<Exact>> {
    let times = |x: &Exact, n: i32| x * Exact::power_of_two(n);
    let SpringMass { c, m, g, l, h } = &case.system;
    let system = SpringMass {
        c: times(c, force - length),
        m: times(m, mass),
        g: times(g, force - mass),
        l: times(l, length),
        h: times(h, length),
    };
    let case = Case {
        system,
        eps: times(&case.eps, force - length),
        start: times(&case.start, force),
        tolerance: times(&case.tolerance, length),
    };
    let SpringMass { c, m, g, l, h } = &case.system;
    let fits = [c, m, g, l, h, &case.eps, &case.start, &case.tolerance]
        .iter()
        .all(|x| like.round_from_exact(x).is_ok());
    (fits && solve(&case.rounded(like).system, &Method::Lagrange).is_ok()).then_some(case)
}

/// Cases with underflowing products included; the whole range of a recommendation is tested.
fn small_numbers_keep_their_word<T: Float + ExactText>(
    case: &Case<Exact>,
    scales: [i32; 3],
    like: &T,
) -> Result<(), TestCaseError> {
    let Some(case) = tiny(case, scales, like) else { return Ok(()) };
    keeps_its_word(&case, &case.tolerance, like, false)?;
    let system = case.rounded(like).system;
    let numbers = system.map(exact);
    // The law's own floor, which knows no underflow, and what is lost by it.
    let eta = unit_roundoff(like);
    let lengths = int(21) * &eta * (numbers.h.abs() + (&numbers.h - &numbers.l).abs());
    for share in [int(1) / int(4), int(101) / int(100), int(8), int(100)] {
        keeps_its_word(&case, &(&lengths * &share), like, false)?;
        let floor = rounding_floor(&system, Plane::Unilateral, &eta).unwrap();
        if let Some(floor) = floor.filter(|floor| !floor.is_zero()) {
            keeps_its_word(&case, &(floor * share), like, false)?;
        }
    }
    // That is promised where mass and plane touch.
    if system::reaction(&numbers) >= int(0) { promised_augmentations_do(&case, like) } else { Ok(()) }
}

proptest! {
    /// f32 is subnormal below 2⁻¹²⁶.
    #[test]
    fn small_f32s_keep_their_word(
        case in any_state(NARROW), force in -150..-60, length in -130..20, mass in -60..60,
    ) {
        small_numbers_keep_their_word(&case, [force, length, mass], &1f32)?;
    }

    /// f64 is subnormal below 2⁻¹⁰²².
    #[test]
    fn small_f64s_keep_their_word(
        case in any_state(NARROW), force in -1070..-950, length in -1020..20, mass in -60..60,
    ) {
        small_numbers_keep_their_word(&case, [force, length, mass], &1f64)?;
    }
}

proptest! {
    /// 10⁻³ to 10⁻⁴⁰ m, whatever the system.
    #[test]
    fn advice_holds_for_decimal_tolerances(case in any_state(NARROW), digits in 3u32..=40) {
        let tolerance = int(1) / power(&int(10), digits);
        // In f32 a penalty of R / tol may be too large.
        keeps_its_word(&case, &tolerance, &1f32, digits < 20)?;
        keeps_its_word(&case, &tolerance, &1f64, true)?;
        keeps_its_word(&case, &tolerance, &int(1).to_mpfr(200), true)?;
    }

    /// With the bits that are said to be needed there is a choice of every method; with one less not for certain.
    #[test]
    fn required_bits_suffice(case in any_state(WIDE), digits in 3u32..=400) {
        let tolerance = int(1) / power(&int(10), digits);
        let bits = required_precision(&case.system, Plane::Unilateral, &tolerance).unwrap().unwrap();
        let like = int(1).to_mpfr(bits);
        let rounded = case.rounded(&like);
        let advice = advise(&rounded.system, &tolerance.to_mpfr(bits)).unwrap();
        prop_assert_eq!(advice.recommendations.len(), 3, "{} bits for {}: {:?}", bits, tolerance, rounded);
        if bits > 6 {
            let fewer = case.rounded(&int(1).to_mpfr(bits - 1));
            let floor = rounding_floor(&fewer.system, Plane::Unilateral, &Exact::power_of_two(1 - bits as i32)).unwrap();
            prop_assert!(floor.is_none_or(|floor| floor >= exact(&tolerance.to_mpfr(bits - 1))));
        }
    }

    /// Rationals round nothing: every tolerance is met, and the softest penalty is that of Remark 1.3.2.
    #[test]
    fn rationals_reach_everything(case in any_state(WIDE)) {
        let advice = advise(&case.system, &case.tolerance).unwrap();
        prop_assert_eq!(advice.floor, Some(Exact::zero()));
        prop_assert_eq!(advice.recommendations.len(), 3);
        for choice in &advice.recommendations {
            prop_assert!(reaches(&case.system, &choice.method, &case.tolerance).is_ok());
            prop_assert!(choice.augmentations.is_none_or(|k| k <= MAX_AUGMENTATIONS));
        }
        let from = advice.recommendations[1].penalty_range[0].clone();
        let least = (reaction(&case) / &case.tolerance - &case.system.c).positive_part();
        if reaction(&case) > Exact::zero() {
            prop_assert!(from.is_none_or(|from| from > least));
        }
        if reaction(&case) >= Exact::zero() {
            let plane = Plane::Unilateral;
            let needed = |eps: &Exact| exact_augmentation_count(&case.system, eps, &case.tolerance, &int(0), plane).unwrap();
            match &advice.recommendations[2].penalty_range[0] {
                None => prop_assert!(reaction(&case) <= &case.system.c * &case.tolerance),
                Some(from) => {
                    prop_assert!(needed(from) <= MAX_AUGMENTATIONS);
                    prop_assert!(needed(&(from * int(8) / int(9))) > MAX_AUGMENTATIONS);
                }
            }
        }
    }
}
