//! Properties of advice: each recommended method run_to_tolerance the tolerance in every scalar, near grazing as well;
//! each guaranteed method is recommended; without a guarantee, no method run_to_tolerance the tolerance.

use crate::strategies::*;
use spring_mass_contact::chapter::{augmented, penalty, rounding};
use spring_mass_contact::number::ExactText;
use spring_mass_contact::solver::{
    Advice, MAX_AUGMENTATIONS, Recommendation, advise, exact_augmentation_count,
    guaranteed_max_augmentations, penalty_for_penetration, required_precision, rounding_floor,
};

// Worked out by hand.

/// Returns the floor of contact for η.
fn floor_of<T: Scalar + ToExact>(system: &SpringMass<T>, eta: &Exact) -> Option<Exact> {
    rounding_floor(system, Plane::Unilateral, eta).unwrap()
}

/// Returns 2⁻ᵇ, η of floats with b bits.
fn eta_of(bits: u32) -> Exact {
    Exact::power_of_two(-(bits as i32))
}

/// m g of 10 bits is rounded to 10 bits, so the coarsest parameter determines the floor. A tolerance between
/// this floor and that of the finest parameter is not guaranteed.
#[test]
fn the_coarsest_parameter_determines_the_guarantee() {
    let [c, m, g] = ["4", "1.1", "9.81"].map(|x| q(x).to_mpfr(10));
    let [l, h] = ["1", "3"].map(|x| q(x).to_mpfr(200));
    let system = SpringMass { c, m, g, l, h };
    let [coarse, fine] = [10, 200].map(|bits| floor_of(&system, &eta_of(bits)).unwrap());
    let tolerance = &coarse / int(2);
    assert!(tolerance > fine * int(1000));
    let advice = advise(&system, &tolerance.to_mpfr(200)).unwrap();
    assert_eq!(advice.floor, Some(coarse));
    let iterates = |choice: &Recommendation<_>| matches!(choice.method, Method::Augmented { .. });
    assert!(!advice.recommendations.iter().any(iterates), "{advice:?}");
}

/// The coarsest parameter determines the penalties, too, and constants are computed without rounding: R/c = 2¹⁰⁰ m, of
/// which floats of 20 bits could reach 2⁸⁰ m only.
#[test]
fn penalties_have_the_precision_of_the_coarsest_parameter() {
    let system = SpringMass { c: int(1), m: int(1), g: Exact::power_of_two(100), l: int(1), h: int(1) };
    let tolerance = int(1).to_mpfr(20);
    let constants = system.map(|x| Mpfr::constant(x.as_rational().clone()));
    let mixed = SpringMass { l: int(1).to_mpfr(200), h: int(3).to_mpfr(150), ..constants.clone() };
    for (system, bits) in [(constants, None), (mixed, Some(150))] {
        let choices = advise(&system, &tolerance).unwrap().recommendations;
        let penalties = choices
            .iter()
            .flat_map(|choice| choice.penalty_range.iter().flatten().chain(choice.method.penalty()));
        let precisions: Vec<_> = penalties.map(Mpfr::precision).collect();
        assert!(
            precisions.len() >= 4 && precisions.iter().all(|precision| *precision == bits),
            "{precisions:?}"
        );
    }
}

/// The tolerance is rounded as well and must remain above the floor.
#[test]
fn bits_are_needed_for_the_tolerance_as_well() {
    let system = example().as_ref().map(exact);
    let mut rounded_down = 0;
    for bits in 6..30 {
        let floor = |bits| floor_of(&system, &eta_of(bits)).unwrap();
        // A little above the floor, and the parameters are the same in all of these bits.
        let tolerance = floor(bits) * (int(1) + Exact::power_of_two(-60));
        let least = (6..).find(|bits| floor(*bits) < tolerance.round_to_bits(*bits).unwrap());
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
fn the_smallest_penalty_has_two_digits() {
    let system = example().as_ref().map(exact);
    for (tolerance, smallest) in [("1/4", "4.1"), ("25/101", "4.1"), ("1", "40")] {
        assert_eq!(advised(&system, &q(tolerance))[0], q(smallest));
    }
    // The f64 beside 0.3 is less than that, and yet not too small.
    let light = SpringMass { c: 1.0, m: 1.0, g: 1.295, l: 0.0, h: 0.0 };
    assert_eq!(advised(&light, &1.0)[0], 0.3);
    let least = |tolerance| penalty_for_penetration(&system, &q(tolerance)).unwrap();
    assert_eq!([least("1/4"), least("1/2")], [Some(int(4)), None]);
}

/// The range of f32 ends at 3.4·10³⁸: below 10 c, then below 2 c. If every penalty suffices, and rounding harms none below
/// that end, there is no largest penalty.
#[test]
fn the_range_of_a_scalar_limits_penalties() {
    let system = |c: f32| SpringMass { c, m: 1.0, g: 9.81, l: 1.0, h: 1.0 };
    for (c, penalty) in [(1e37, 1e38), (1e38, 1e38), (3e38, 3e36)] {
        assert_eq!(advised(&system(c), &0.1), [penalty, penalty]);
    }
    let recommended = advise(&system(100.0), &1e37).unwrap().recommendations;
    assert!(recommended[1..].iter().all(|of| of.penalty_range[1].is_none()), "{recommended:?}");
}

/// R = 4.81, c = 100: p₁₀ is smaller than the tolerance if (1 + ε/c)¹¹ > R/(c tol). For 1e-12 m that is 4.81e10, so
/// ε > 835.6; for 1e-9 m, ε > 399.3; for 1e-6 m, ε > 166.5. The limit by rounding is 7.44e16 tol − c, near the floor less
/// than twice the penalty: for 2.1e-14 m, of which rounding leaves 1.84e-14, 1463 for ε > 1245. For 1e-14 m it is 644 for
/// ε > 1322; the largest one with one digit is 600, and p₁₄ = 1.01e-14.
#[test]
fn the_augmentation_takes_ten_steps_with_the_smallest_penalty() {
    let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    for (tolerance, eps, steps) in
        [(1e-6, 170.0, 10), (1e-9, 400.0, 10), (1e-12, 840.0, 10), (2.1e-14, 1300.0, 10), (1e-14, 600.0, 15)]
    {
        let choices = advise(&system, &tolerance).unwrap().recommendations;
        assert_eq!((choices[2].method.penalty(), choices[2].augmentations), (Some(&eps), Some(steps)));
    }
}

/// With c = H = 1 and Δ = 0 the limit by rounding is tol/(11 η) − 1, so 9.5 for a tolerance of 115.5 η, of which rounding
/// leaves 94.5 η. Ten steps suffice if 94.5 η (1 + ε)¹¹ > R = 1.55e13 η: 10.4¹¹ = 1.54e11 is too small, 10.5¹¹ is not.
#[test]
fn a_penalty_at_the_limit_by_rounding_is_recommended() {
    let eta = eta_of(100);
    let g = int(155) * power(&int(10), 11) * &eta;
    let system = SpringMass { c: int(1), m: int(1), g, l: int(1), h: int(1) }.map(|x| x.to_mpfr(100));
    let choices = advise(&system, &(q("115.5") * eta).to_mpfr(100)).unwrap().recommendations;
    assert_eq!(
        (choices[2].method.penalty().map(exact), choices[2].augmentations),
        (Some(q("9.5")), Some(10))
    );
}

/// Δ = 2: rounding changes the deflection of (1.13) by up to 5 η Δ (1 + 2 η) for every penalty, at grazing as
/// well. This value is not a guaranteed tolerance; every larger one is.
#[test]
fn a_tolerance_below_the_rounding_floor_is_rejected() {
    for g in [2, 3] {
        let system = SpringMass { c: 1, m: 1, g, l: 1, h: 3 }.map(|x| int(x).to_mpfr(10));
        let eta = eta_of(10);
        let taken = int(10) * &eta * (int(1) + int(2) * &eta);
        let more = &taken * (int(1) + Exact::power_of_two(-40));
        assert_eq!([taken, more].map(|x| advised(&system, &x.to_mpfr(99)).len()), [0, 1], "g = {g}");
    }
}

/// If the mass is separated, every penalty method computes m g/c. The augmentation is guaranteed above 5 η m
/// g/c for ε ≥ c.
#[test]
fn a_separated_mass_accepts_any_penalty() {
    let system = SpringMass { c: 1, m: 1, g: 1, l: 0, h: 3 }.map(|x| int(x).to_mpfr(10));
    let floor = int(5) * eta_of(10);
    let more = &floor * (int(1) + Exact::power_of_two(-40));
    let [at, above] = [floor, more].map(|x| advise(&system, &x.to_mpfr(99)).unwrap().recommendations);
    let smallest = |choices: &[Recommendation<_>]| -> Vec<_> {
        choices.iter().map(|choice| choice.penalty_range[0].as_ref().map(exact)).collect()
    };
    assert_eq!(smallest(&at), [None, None]);
    assert_eq!(smallest(&above), [None, None, Some(int(1))]);
    assert_eq!(above[1].method.penalty().map(exact), Some(int(10)));
}

// Laws.

/// Returns the result of a run if it meets the tolerance and, for an iteration, reports it.
fn run_to_tolerance<T: Scalar + ToExact>(
    system: &SpringMass<T>,
    method: &Method<T>,
    tolerance: &Exact,
) -> Result<Solution<T>, String> {
    let solution = solve(system, method).map_err(|error| error.to_string())?;
    let error = (exact(&solution.deflection) - resting(&system.as_ref().map(exact))).abs();
    let is_met = matches!(solution.outcome, Outcome::Direct | Outcome::Converged);
    if is_met && error < *tolerance {
        Ok(solution)
    } else {
        Err(format!("error {error}, {}", solution.outcome))
    }
}

/// Returns the method with another penalty.
fn with_penalty_of<T: Float>(method: &Method<T>, eps: &T) -> Method<T> {
    let penalty = eps.clone();
    match method.clone() {
        Method::Lagrange => Method::Lagrange,
        Method::Penalty { .. } => Method::Penalty { penalty },
        Method::Augmented { tolerance, start, .. } => {
            augmentation(penalty, tolerance, MAX_AUGMENTATIONS, start)
        }
    }
}

/// Returns penalties in the range, including its ends; without a lower end, down to `part` of the recommended
/// penalty.
fn within<T: Float>(choice: &Recommendation<T>, part: &Exact, like: &T) -> Vec<T> {
    let Some(own) = choice.method.penalty().map(exact) else { return Vec::new() };
    let [from, to] = choice.penalty_range.each_ref().map(|end| end.as_ref().map(exact));
    let (from, to) = (from.unwrap_or_else(|| &own * part), to.unwrap_or_else(|| &own * int(1000)));
    assert!(from <= own && own <= to, "{from} {own} {to}");
    // Rounded, what is between two scalars stays between them.
    let mut penalties = vec![from.clone(), (&from + &own) / int(2), (&own + &to) / int(2), to.clone()];
    let mut factor = int(1000);
    while power(&factor, 8) * &from < to {
        factor = &factor * &factor;
    }
    let steps = std::iter::successors(Some(from), |eps| Some(eps * &factor));
    penalties.extend(steps.take_while(|eps| *eps < to));
    // A number out of range is not a penalty.
    penalties.iter().filter_map(|eps| like.round_from_exact(eps).ok()).collect()
}

/// Asserts that recommendations hold. If everything `fits` the range of the scalar, each guaranteed method
/// must be present; otherwise penalties may be very small.
fn recommendations_hold<T: Float + ExactText>(case: &Case<T>, tolerance: &Exact, fits: bool) {
    let like = &case.eps;
    let rounded = like.round_from_exact(tolerance).ok();
    let Some(tolerance) = rounded.filter(|tolerance| *tolerance > T::zero()) else { return };
    let tol = &exact(&tolerance);
    let (system, numbers) = (&case.system, case.system.as_ref().map(exact));
    let force = pushing(&numbers);
    let Advice { recommendations: choices, floor, .. } = advise(system, &tolerance).unwrap();
    for choice in &choices {
        let Recommendation { method, augmentations, penetration, force_error, relative_force_error, .. } =
            choice;
        let solution =
            run_to_tolerance(system, method, tol).unwrap_or_else(|error| panic!("{choice:?}: {error}"));
        assert_eq!(solution.augmentations, *augmentations);
        assert_eq!(&numbers.l + exact(&solution.deflection) - &numbers.h, *penetration);
        assert_eq!((exact(&solution.contact_force) - &force).abs(), *force_error);
        let parts = relative_force_error.as_ref().map(|parts| parts * &force);
        assert_eq!(parts, (!force.is_zero()).then(|| force_error.clone()));
        let part = if fits { q("1/1000") } else { Exact::power_of_two(-200) };
        for eps in within(choice, &part, like) {
            // Without another limit, that of the scalar.
            let beyond = choice.penalty_range[1].is_none() && Some(&eps) > method.penalty();
            if let Err(error) = run_to_tolerance(system, &with_penalty_of(method, &eps), tol) {
                let out_of_range = beyond && error.contains("out of the range");
                assert!(out_of_range, "ε = {eps:?} of {choice:?} at {tol}: {error}");
            }
        }
    }
    if fits && floor.is_some_and(|floor| *tol > floor) {
        assert_eq!(choices.len(), 3, "{choices:?} at {tol}");
    }
    if fits && choices.is_empty() {
        let penalties = [-20, -3, 0, 3, 20, 50].map(|e| case.round(&(&numbers.c * Exact::power_of_two(e))));
        for eps in penalties.into_iter().chain([case.eps.clone()]) {
            let augmented = augmentation(eps.clone(), tolerance.clone(), 100, case.round(&int(0)));
            for method in [Method::Lagrange, Method::Penalty { penalty: eps }, augmented] {
                assert!(run_to_tolerance(system, &method, tol).is_err(), "{method:?} run_to_tolerance {tol}");
            }
        }
    }
}

/// The largest penalty: it increases the proved rounding bound by c tol, except for rounding it down, and a
/// run has an error this small.
fn largest_penalty_preserves_the_force<T: Float + ExactText>(case: &Case<T>) {
    let (numbers, eta, precision) = (case.system.as_ref().map(exact), case.eta(), case.precision());
    let SpringMass { c, l, h, .. } = &numbers;
    let r = system::reaction(&numbers);
    let allowed = c * exact(&case.tolerance);
    // Rounding down to a float reduces it by at most this.
    let rounded_down = &allowed * (int(1) - int(2) * &eta);
    for choice in &advise(&case.system, &case.tolerance).unwrap().recommendations {
        let Some(to) = &choice.penalty_range[1] else {
            // Without lengths nothing grows; and rounded the mass may hang free.
            let nothing = h.is_zero() && l.is_zero() || r < int(0);
            assert!(nothing || matches!(choice.method, Method::Lagrange), "{choice:?}");
            continue;
        };
        let eps = exact(to);
        let of_force = |eps: &Exact| rounding::penalty_force_error(&numbers, eps, &precision);
        let iterates = matches!(choice.method, Method::Augmented { .. });
        let growth = if iterates {
            // 11 (c + ε) η (|H| + |Δ|): the part of the drift that grows with ε.
            int(11) * (c + &eps) * &eta * (h.abs() + (h - l).abs())
        } else {
            of_force(&eps) - of_force(&int(0))
        };
        // The penalty of the method, if every sufficient one grows by more.
        let own = Some(to) == choice.method.penalty();
        assert!((own || growth <= allowed) && growth >= rounded_down, "{growth} {allowed} {choice:?}");
        if own {
            continue;
        }
        let solution = solve(&case.system, &with_penalty_of(&choice.method, to)).unwrap();
        if iterates {
            let decay =
                power(&augmented::contraction(&numbers, &eps), solution.augmentations.unwrap() as u32);
            let exactly = augmented::multiplier_after(&numbers, &int(0), &decay);
            let rest = int(11) * &eta * (c + &eps) * &r / &eps;
            let error = (exact(solution.multiplier.as_ref().unwrap()) - exactly).abs();
            assert!(error <= &allowed + rest, "{choice:?}");
        } else {
            let computed = exact(&penalty::contact_force(&case.system, to, &solution.deflection));
            let error = (computed - penalty::contact_force_at_equilibrium(&numbers, &eps)).abs();
            assert!(error <= &allowed + of_force(&int(0)), "{error} {choice:?}");
        }
    }
}

/// The smallest penalty is guaranteed, and the next smaller one is not; for the augmentation, one smaller by
/// a ninth.
fn smallest_penalty_suffices<T: Float + ExactText>(case: &Case<T>) {
    let (numbers, tol, eta) = (case.system.as_ref().map(exact), exact(&case.tolerance), case.eta());
    if system::reaction(&numbers) <= int(0) {
        return;
    }
    let error = |eps: &Exact| {
        penalty::penetration(&numbers, eps) + rounding::deflection_error(&numbers, eps, &case.precision())
    };
    let converges_in_time = |eps: &Exact| {
        let most = guaranteed_max_augmentations(&numbers, eps, &tol, &eta).unwrap();
        most.is_some_and(|most| most <= MAX_AUGMENTATIONS)
    };
    for choice in advise(&case.system, &case.tolerance).unwrap().recommendations {
        match (&choice.method, &choice.penalty_range[0]) {
            (Method::Lagrange, from) => assert_eq!(*from, None),
            (Method::Penalty { .. }, None) => assert!(error(&int(0)) <= tol),
            (Method::Penalty { .. }, Some(from)) => {
                let smaller = exact(&from.neighbours()[0]);
                assert!(error(&exact(from)) <= tol && error(&smaller) >= tol, "{choice:?}");
            }
            (Method::Augmented { .. }, from) => {
                let from = exact(from.as_ref().expect("a smallest one"));
                assert!(converges_in_time(&from) && !converges_in_time(&(from * q("8/9"))), "{choice:?}");
            }
        }
    }
}

/// The augmentation is that with the smallest penalty, to two digits, for which at most ten steps are guaranteed. If it is
/// too large for the multiplier, no penalty of the range has this guarantee, except for the digits.
fn augmentation_takes_at_most_ten_steps<T: Float + ExactText>(case: &Case<T>) {
    let (numbers, tol, eta) = (case.system.as_ref().map(exact), exact(&case.tolerance), case.eta());
    let takes_ten_steps = |eps: &Exact| {
        let most = guaranteed_max_augmentations(&numbers, eps, &tol, &eta).unwrap();
        most.is_some_and(|most| most <= 10)
    };
    let choices = advise(&case.system, &case.tolerance).unwrap().recommendations;
    let [_, by_penalty, by_augmentation] = &choices[..] else { return };
    if by_penalty.penalty_range[0].is_none() {
        return; // every penalty suffices
    }
    let eps = exact(by_augmentation.method.penalty().expect("a penalty"));
    // Two digits are a factor of up to 11/10, and rounding may be one of 1 + 2⁻⁷.
    let smaller = |eps: &Exact| eps * q("8/9");
    if takes_ten_steps(&eps) {
        assert!(by_augmentation.augmentations.unwrap() <= 10, "{by_augmentation:?}");
        assert!(!takes_ten_steps(&smaller(&eps)), "{by_augmentation:?}");
    } else {
        let max = exact(by_augmentation.penalty_range[1].as_ref().expect("a limit"));
        assert!(!takes_ten_steps(&smaller(&max)), "{by_augmentation:?}");
    }
}

/// The guaranteed number of augmentations suffices, at the floor and far above it.
fn guaranteed_augmentations_suffice<T: Float>(case: &Case<T>) {
    let (eta, numbers) = (case.eta(), case.system.as_ref().map(exact));
    // The smallest guaranteed tolerance is affine in the drift (see `is_convergence_guaranteed`).
    let drift = rounding::penetration_drift(&numbers, &exact(&case.eps), &case.precision());
    let begins = (drift + &eta * numbers.h.abs()) / (int(1) - int(8) * &eta);
    for share in ["1001/1000", "3/2", "1000"].map(q) {
        // If ε is too small for any bound of the drift, that formula is negative.
        let tolerance = case.eps.round_from_exact(&(&begins * share)).ok();
        let Some(tolerance) = tolerance.filter(|tolerance| *tolerance > T::zero()) else { continue };
        let guaranteed = guaranteed_max_augmentations(&case.system, &case.eps, &tolerance, &eta).unwrap();
        let most = guaranteed.and_then(|most| most.to_u64()).filter(|most| *most < 2000);
        let Some(most) = most else { continue };
        let method = augmentation(case.eps.clone(), tolerance.clone(), most, case.round(&int(0)));
        let found = run_to_tolerance(&case.system, &method, &exact(&tolerance));
        assert!(found.is_ok(), "{most} for {tolerance:?}: {found:?}");
    }
}

/// Tolerances of the size of the system, far below it, and at the floor.
fn advice_holds<T: Float + ExactText>(case: &Case<T>) {
    recommendations_hold(case, &exact(&case.tolerance), true);
    // Without lengths there is a floor of underflow alone, and a penalty that meets it may not fit.
    let lengths = !(case.system.h.is_zero() && case.system.l.is_zero());
    let floor = floor_of(&case.system, &case.eta()).filter(|floor| lengths && !floor.is_zero());
    for (floor, share) in floor.iter().flat_map(|floor| ["1/2", "1.01", "2"].map(|share| (floor, share))) {
        recommendations_hold(case, &(floor * q(share)), true);
    }
}

in_every_float! {
    advice_holds from any_state;
    largest_penalty_preserves_the_force from in_contact;
    smallest_penalty_suffices from in_contact;
    augmentation_takes_at_most_ten_steps from in_contact;
    guaranteed_augmentations_suffice from in_contact;
}

/// Cases for which these laws failed once, in one of the floats.
#[test]
fn advice_holds_for_recorded_cases() {
    fn holds_in<T: Float + ExactText>(case: &Case<Exact>, like: &T) {
        let case = case.rounded(like);
        advice_holds(&case);
        guaranteed_augmentations_suffice(&case);
        if case.exact().reaction() > int(0) {
            largest_penalty_preserves_the_force(&case);
            smallest_penalty_suffices(&case);
            augmentation_takes_at_most_ten_steps(&case);
        }
    }
    for recorded in [
        "--stiffness 1 --mass 1/5 --gravity 223696215/268435456 --free-length 0 --height 1/6 --penalty 1/67108864 \
         --initial-multiplier 0 --tolerance 44739243/268435456",
        "--stiffness 1/5 --mass 1 --gravity 3602879701896397/90071992547409920 --free-length 0 --height 1/5 \
         --penalty 1/5764607523034234880 --initial-multiplier 0 --tolerance 3602879701896397/18014398509481984",
        "--stiffness 1 --mass 1 --gravity -536870905/6291456 --free-length -64 --height -448/3 --penalty 1 \
         --initial-multiplier 0 --tolerance 313174701/2097152",
        // In 8 bits the smallest penalty is too small if it is rounded to nearest.
        "--stiffness 65536 --mass 1/5 --gravity 589824 --free-length 196608 --height 196608 --penalty 65536 \
         --initial-multiplier 0 --tolerance 983049/671088640",
        "--stiffness 1 --mass 6 \
         --gravity 83076749736557242056487941267521537/498460498419343452338927647605129216 --free-length 0 \
         --height 1 --penalty 1 --initial-multiplier 0 \
         --tolerance 83076749736557242056487941267521537/83076749736557242056487941267521536",
    ] {
        let case = Case::printed(recorded);
        holds_in(&case, &1f32);
        holds_in(&case, &1f64);
        holds_in(&case, &float(113));
        holds_in(&case, &float(8));
    }
}

/// Returns a case in such large units that forces of 2ᶠ, stiffnesses, and lengths of 2ˡ approach the smallest
/// floats, with masses of 2ᵐ. Returns `None` if a number or a product of the solver underflows.
fn tiny<T: Float>(case: &Case<Exact>, [force, length, mass]: [i32; 3], like: &T) -> Option<Case<T>> {
    let times = |x: &Exact, n: i32| like.round_from_exact(&(x * Exact::power_of_two(n))).ok();
    let SpringMass { c, m, g, l, h } = &case.system;
    let case = Case {
        system: SpringMass {
            c: times(c, force - length)?,
            m: times(m, mass)?,
            g: times(g, force - mass)?,
            l: times(l, length)?,
            h: times(h, length)?,
        },
        eps: times(&case.eps, force - length)?,
        start: times(&case.start, force)?,
        tolerance: times(&case.tolerance, length)?,
    };
    solve(&case.system, &Method::Lagrange).is_ok().then_some(case)
}

/// Cases with underflowing products included; the whole range of a recommendation is tested.
fn recommendations_hold_for_small_numbers<T: Float + ExactText>(
    case: &Case<Exact>,
    scales: [i32; 3],
    like: &T,
) {
    let Some(case) = &tiny(case, scales, like) else { return };
    recommendations_hold(case, &exact(&case.tolerance), false);
    let (numbers, eta) = (case.system.as_ref().map(exact), case.eta());
    // The law's own floor, which knows no underflow, and what is lost by it.
    let lengths = int(21) * &eta * (numbers.h.abs() + (&numbers.h - &numbers.l).abs());
    let floor = floor_of(&case.system, &eta).filter(|floor| !floor.is_zero());
    for from in [Some(lengths), floor].into_iter().flatten() {
        for share in ["1/4", "1.01", "8", "100"].map(q) {
            recommendations_hold(case, &(&from * share), false);
        }
    }
    // This is guaranteed in contact and grazing.
    if system::reaction(&numbers) >= int(0) {
        guaranteed_augmentations_suffice(case);
    }
}

/// f32 is subnormal below 2⁻¹²⁶.
#[test]
fn recommendations_hold_for_small_f32s() {
    holds((any_state(NARROW), -150..-60, -130..20, -60..60), |(case, force, length, mass)| {
        recommendations_hold_for_small_numbers(case, [*force, *length, *mass], &1f32);
    });
    // Without lengths, what underflows is all that is lost.
    let [c, m, g, eps, tolerance] = [(); 5].map(|()| int(1));
    let system = SpringMass { c, m, g, l: int(0), h: int(0) };
    let case = Case { system, eps, start: int(0), tolerance };
    recommendations_hold_for_small_numbers(&case, [-131, 0, 0], &1f32);
}

/// f64 is subnormal below 2⁻¹⁰²².
#[test]
fn recommendations_hold_for_small_f64s() {
    holds((any_state(NARROW), -1070..-950, -1020..20, -60..60), |(case, force, length, mass)| {
        recommendations_hold_for_small_numbers(case, [*force, *length, *mass], &1f64);
    });
}

/// 10⁻³ to 10⁻⁴⁰ m, whatever the system.
#[test]
fn advice_holds_for_decimal_tolerances() {
    let law = |case: &Case<Exact>, digits: u32| {
        let tolerance = int(1) / power(&int(10), digits);
        // In f32 a penalty of R / tol may be too large.
        recommendations_hold(&case.rounded(&1f32), &tolerance, digits < 20);
        recommendations_hold(&case.rounded(&1f64), &tolerance, true);
        recommendations_hold(&case.rounded(&float(200)), &tolerance, true);
    };
    holds((any_state(NARROW), 3u32..=40), move |(case, digits)| law(case, *digits));
    // It failed once for these.
    let weights = [
        ("--stiffness 1 --gravity 18/5 --penalty 1 --tolerance 18/5", 38),
        ("--stiffness 7424/5 --gravity 29696/5 --penalty 7424/5 --tolerance 4", 28),
    ];
    for (options, digits) in weights {
        let others = "--mass 1 --free-length 0 --height 0 --initial-multiplier 0";
        law(&Case::printed(&format!("{options} {others}")), digits);
    }
}

/// The required precision suffices for a recommendation of each method; one bit fewer does not guarantee it.
#[test]
fn required_bits_suffice() {
    holds((any_state(WIDE), 3u32..=400), |(case, digits)| {
        let tolerance = int(1) / power(&int(10), *digits);
        let bits = required_precision(&case.system, Plane::Unilateral, &tolerance).unwrap().unwrap();
        let advice = advise(&case.rounded(&float(bits)).system, &tolerance.to_mpfr(bits)).unwrap();
        assert_eq!(advice.recommendations.len(), 3, "{bits} bits");
        if bits > 6 {
            let fewer = case.rounded(&float(bits - 1)).system;
            let floor = floor_of(&fewer, &eta_of(bits - 1));
            assert!(floor.is_none_or(|floor| floor >= exact(&tolerance.to_mpfr(bits - 1))), "{bits} bits");
        }
    });
}

/// Rationals are not rounded: every tolerance is met, and the smallest penalty is that of Remark 1.3.2.
#[test]
fn rationals_meet_every_tolerance() {
    holds(any_state(WIDE), |case| {
        let Case { system: s, tolerance, .. } = case;
        let (r, Advice { recommendations: choices, floor, .. }) =
            (case.reaction(), advise(s, tolerance).unwrap());
        assert_eq!((floor, choices.len()), (Some(int(0)), 3));
        for choice in &choices {
            assert!(run_to_tolerance(s, &choice.method, tolerance).is_ok());
            assert!(choice.augmentations.is_none_or(|k| k <= MAX_AUGMENTATIONS));
        }
        let [of_penalty, of_augmentation] = [1, 2].map(|i| choices[i].penalty_range[0].as_ref());
        if r > int(0) {
            let least = (&r / tolerance - &s.c).positive_part();
            assert!(of_penalty.is_none_or(|from| *from > least && from * q("99/100") <= least));
        }
        let needed =
            |eps: &Exact| exact_augmentation_count(s, eps, tolerance, &int(0), Plane::Unilateral).unwrap();
        match of_augmentation {
            _ if r < int(0) => {}
            None => assert!(r <= &s.c * tolerance),
            Some(from) => {
                assert!(needed(from) <= MAX_AUGMENTATIONS);
                assert!(needed(&(from * q("8/9"))) > MAX_AUGMENTATIONS);
            }
        }
    });
}
