//! The Karush-Kuhn-Tucker conditions (1.6): satisfied by the Lagrange multiplier method and by the limit of
//! the augmentation, violated by known amounts by the penalty method; in contact, grazing and separated.

use crate::in_every_float;
use crate::strategies::*;
use num_traits::Zero;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, contact, penalty, system};
use spring_mass_contact::number::{Ball, Exact, PositivePart};
use spring_mass_contact::rug::Rational;
use spring_mass_contact::solver::{
    Augmentation, Method, Outcome, Plane, Solution, State, solve, solve_bilateral,
};
use std::cmp::Ordering;

fn state_by_sign(sign: Ordering) -> State {
    match sign {
        Ordering::Greater => State::Contact,
        Ordering::Equal => State::Grazing,
        Ordering::Less => State::Separated,
    }
}

fn solved<T: Float>(case: &Case<T>, method: &Method<T>) -> Solution<T> {
    solve(&case.system, method).expect("the parameters are within their ranges")
}

/// Nonzero distances from the solution of (1.6), in u and in N.
fn displacement() -> impl Strategy<Value = (Exact, Exact)> {
    prop_oneof![
        (nonzero(WIDE), number(WIDE)),
        (number(WIDE), nonzero(WIDE)),
        // Still in equilibrium, so the other three conditions must detect it: N = −c u is
        // taken relative to c = 1 and scaled by the test.
        nonzero(WIDE).prop_map(|du| (du.clone(), -du)),
    ]
}

proptest! {
    /// Each state has one exact solution with zero residuals: N = ⟨R⟩ and −c p = ⟨−R⟩.
    #[test]
    fn lagrange_meets_the_conditions(
        (case, sign) in prop_oneof![
            (in_contact(WIDE), Just(Ordering::Greater)),
            (grazing(WIDE), Just(Ordering::Equal)),
            (separated(WIDE), Just(Ordering::Less)),
        ]
    ) {
        let Case { system, .. } = &case;
        let r = reaction(&case);
        prop_assert_eq!(r.cmp(&Exact::zero()), sign, "the state is planted");
        let answer = solve(system, &Method::Lagrange).unwrap();
        prop_assert_eq!((answer.state, answer.outcome), (state_by_sign(sign), Outcome::Direct));
        prop_assert!(answer.certificate(system).unwrap().is_zero());
        prop_assert_eq!(&answer.deflection, &resting(system));
        prop_assert_eq!(&answer.contact_force, &positive_part(&r));
        prop_assert_eq!(-&system.c * &answer.penetration, positive_part(&-&r));
        prop_assert_eq!(answer.multiplier.as_ref(), Some(&answer.contact_force));
        prop_assert_eq!(&answer.bounds.deflection.lower, &answer.deflection);
        prop_assert_eq!(&answer.bounds.penetration.upper, &answer.penetration);
        prop_assert_eq!(&answer.bounds.contact_force.lower, &answer.contact_force);
        // (1.6) solved, as the chapter's functions have it.
        prop_assert_eq!(contact::deflection(system), answer.deflection);
        prop_assert_eq!(contact::contact_force(system), answer.contact_force);
    }

    /// No other pair (u, N) satisfies all four conditions.
    #[test]
    fn the_conditions_have_one_solution(case in any_state(WIDE), (du, dn) in displacement()) {
        let Case { system, .. } = &case;
        for dn in [&dn * &system.c, dn] {
            let (u, n) = (resting(system) + &du, pushing(system) + dn);
            prop_assert!(!contact::kkt(system, &u, &n).is_zero());
        }
    }

    /// Each condition is needed: the solution of the other state violates exactly one of them.
    #[test]
    fn the_other_branch_violates_one_condition(case in not_grazing(WIDE)) {
        let s = &case.system;
        let r = reaction(&case);
        let free = contact::kkt(s, &(&s.m * &s.g / &s.c), &int(0));
        let touching = contact::kkt(s, &(&s.h - &s.l), &r);
        for kkt in [&free, &touching] {
            prop_assert_eq!((&kkt.stationarity, &kkt.complementarity), (&int(0), &int(0)));
        }
        // R > 0: it would hang free inside the plane. R < 0: the plane would have to pull.
        prop_assert_eq!((free.primal, free.dual), (positive_part(&(&r / &s.c)), int(0)));
        prop_assert_eq!((touching.primal, touching.dual), (int(0), positive_part(&-r)));
    }

    /// The penalty method violates (1.6) by p = R/(c + ε) and p N = ε p² only.
    #[test]
    fn penalty_violates_by_known_amounts(case in any_state(WIDE)) {
        let Case { system, eps, .. } = &case;
        let p = positive_part(&reaction(&case)) / (&system.c + eps);
        let answer = solve(system, &case.penalty()).unwrap();
        let kkt = answer.certificate(system).unwrap();
        prop_assert_eq!((&kkt.stationarity, &kkt.dual), (&int(0), &int(0)));
        prop_assert_eq!(&kkt.primal, &p);
        prop_assert_eq!(&kkt.complementarity, &(eps * &p * &p));
        prop_assert_eq!(&answer.contact_force, &(eps * &p));
    }

    /// As printed, the plane pulls if the mass is separated: N = R < 0.
    #[test]
    fn a_bilateral_plane_pulls_when_separated(case in separated(WIDE)) {
        let answer = solve_bilateral(&case.system, &Method::Lagrange).unwrap();
        let kkt = answer.certificate(&case.system).unwrap();
        prop_assert_eq!(answer.state, State::Separated);
        prop_assert_eq!((kkt.stationarity, kkt.primal), (int(0), int(0)));
        prop_assert_eq!(kkt.dual, -reaction(&case));
    }

    /// c p + N = R: for every method, plane and step the error of the force is c times the penetration.
    #[test]
    fn the_error_of_the_force_is_c_times_the_penetration(case in any_state(WIDE), steps in 0u64..12) {
        let Case { system, .. } = &case;
        for method in case.methods(steps) {
            for answer in [solve(system, &method).unwrap(), solve_bilateral(system, &method).unwrap()] {
                let sum = &system.c * &answer.penetration + &answer.contact_force;
                prop_assert_eq!(sum, reaction(&case));
                prop_assert_eq!(answer.certificate(system).unwrap().stationarity, int(0));
            }
        }
        for plane in [Plane::Unilateral, Plane::Bilateral] {
            let iteration = Augmentation::new(system, &case.eps).with_multiplier(case.start.clone());
            for step in iteration.over(plane).take(8) {
                prop_assert_eq!(&system.c * step.penetration + step.contact_force, reaction(&case));
            }
        }
    }

    /// In contact the positive parts have no effect (from λ₀ ≥ −ε R/c on, for which the first step is in
    /// contact).
    #[test]
    fn one_sided_is_two_sided_in_contact(case in in_contact(WIDE), edge in any::<bool>()) {
        let least = -&case.eps * reaction(&case) / &case.system.c;
        let start = if edge || case.start < least { least } else { case.start.clone() };
        let case = Case { start, ..case };
        for method in case.methods(10) {
            let (one, two) = (solve(&case.system, &method), solve_bilateral(&case.system, &method));
            prop_assert_eq!(one.unwrap(), two.unwrap());
        }
    }
}

/// Results in floats, checked in rationals for each state; nothing under- or overflows here.
fn certificate_is_small<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    let s = case.system.map(exact);
    let eta = unit_roundoff(like);
    let (gap, weight, r) = (system::gap(&s), system::weight(&s), reaction(&case.exact()));
    // û = fl(H − l) has one rounding; û = fl(fl(m g)/c) has two, 2η + η² relative to the result.
    let once = &eta * gap.abs();
    let twice = (int(2) * &eta + &eta * &eta) * weight.abs() / &s.c;

    let lagrange = solved(&case, &Method::Lagrange);
    let kkt = lagrange.certificate(&case.system).unwrap();
    let (u, n) = (exact(&lagrange.deflection), exact(&lagrange.contact_force));
    let u_error = if r < int(0) { &twice } else { &once };
    // N = fl(fl(m g) − fl(c û)): each product once, the difference once; exactly 0 where R ≤ 0.
    let n_error = if r > int(0) { &eta * (weight.abs() + (&s.c * &u).abs() + &n) } else { int(0) };
    prop_assert_eq!(lagrange.state, state_by_sign(r.cmp(&int(0))));
    prop_assert!((&u - resting(&s)).abs() <= *u_error, "{:?}", case);
    // ⟨·⟩ after a rounding may only bring N nearer to R > 0, not the sum of the forces: c times the rest.
    prop_assert!(kkt.stationarity.abs() <= &s.c * u_error + &n_error, "{:?}", case);
    prop_assert!((&n - pushing(&s)).abs() <= &s.c * u_error + &n_error, "{:?}", case);
    prop_assert!(kkt.primal <= *u_error && kkt.dual.is_zero(), "{:?}", case);
    let p = (&s.l + &u - &s.h).abs();
    prop_assert_eq!(kkt.complementarity.abs(), &p * &n);
    prop_assert!(r > int(0) || kkt.complementarity.is_zero(), "N = 0 exactly: {:?}", case);

    let penalty = solved(&case, &case.penalty());
    let kkt = penalty.certificate(&case.system).unwrap();
    let (u, n) = (exact(&penalty.deflection), exact(&penalty.contact_force));
    // The rounding error of (1.13), computed: the formula read in balls.
    let balls = case.map(|x| Ball::point(x.clone()));
    let u_error = match r.cmp(&int(0)) {
        Ordering::Less => twice,
        _ => exact(penalty::deflection(&balls.system, &balls.eps).radius()),
    };
    let n_error = &eta * (weight.abs() + (&s.c * &u).abs() + &n);
    let p = positive_part(&r) / (&s.c + case.eps.to_exact().unwrap());
    prop_assert!((&kkt.primal - &p).abs() <= u_error, "{:?}", case);
    prop_assert!(kkt.stationarity.abs() <= &s.c * u_error + n_error, "{:?}", case);
    prop_assert!(kkt.dual.is_zero(), "{:?}", case);

    // Wherever the augmentation stops, its force is in equilibrium with its deflection: N = fl(m g − c û), or
    // 0 where û = fl(m g/c) or where the difference is negative for no other reason than û's two roundings.
    let augmented = solved(&case, &case.augmented(50));
    let kkt = augmented.certificate(&case.system).unwrap();
    let (u, n) = (exact(&augmented.deflection), exact(&augmented.contact_force));
    let n_error = &eta * (weight.abs() + (&s.c * u).abs() + n);
    let free_error = (int(2) * &eta + &eta * &eta) * weight.abs();
    prop_assert!(kkt.stationarity.abs() <= n_error + free_error, "{:?}", case);
    prop_assert!(kkt.dual.is_zero(), "{:?}", case);
    Ok(())
}

/// In [`solve`] the plane never pulls, despite rounding, and the bounds hold.
fn the_plane_never_pulls<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    for method in case.methods(50) {
        let answer = solved(&case, &method);
        prop_assert!(answer.contact_force >= T::zero(), "{:?} {:?}", method, case);
    }
    let steps = Augmentation::new(&case.system, &case.eps).with_multiplier(case.start.clone());
    for step in steps.take(20) {
        prop_assert!(step.contact_force >= T::zero(), "{:?}", case);
        prop_assert!(step.k == 0 || step.multiplier >= T::zero(), "{:?}", case);
    }
    Ok(())
}

in_every_float! {
    certificate_is_small from any_state;
    the_plane_never_pulls from any_state;
}

/// A grazing system whose parameters, c Δ and m g = c Δ fit `bits` bits: R is exactly 0 *in floats* too.
fn exactly_grazing(bits: u32) -> impl Strategy<Value = SpringMass<Exact>> {
    let half = 1i32 << (bits / 2 - 1).min(20);
    let exponents = (-20..20, -20..20, -20..20);
    // l and Δ on one grid, so that H = l + Δ is one float too; Δ ≠ 0.
    let lengths = (-half / 2..half / 2, 1..half / 2, any::<bool>());
    (1..half, lengths, exponents).prop_map(|(c, (l, gap, below), (a, b, e))| {
        let (c, m, unit) = (int(c) * Exact::power_of_two(a), Exact::power_of_two(b), Exact::power_of_two(e));
        let gap = if below { -int(gap) } else { int(gap) } * &unit;
        let l = int(l) * unit;
        SpringMass { g: &c * &gap / &m, h: &l + gap, c, m, l }
    })
}

/// Returns a float of either sign at an end of the range (zero, subnormal, next to the smallest normal
/// number, the largest) or elsewhere.
fn extreme<T: Float>(like: &T, (kind, digits, negative): (u8, u32, bool)) -> T {
    let eta = unit_roundoff(like);
    let units = |n: Exact| like.round_from_exact(&(n * exact(&T::min_subnormal()))).unwrap();
    // A fraction of the smallest normal number, which is 1/(2 η) units.
    let fraction = int(1) / (int(2) * &eta) * Exact::from(Rational::from((digits, u32::MAX)));
    let whole = |x: Exact| Exact::from(Rational::from(x.as_rational().ceil_ref()));
    let x = match kind {
        0 => T::zero(),
        1 => units(int(1) + int((digits % 3) as i32)),
        2 | 3 => units(whole(fraction)),
        4 => units(whole(fraction) + int(1) / (int(2) * &eta)),
        5 => (0..digits % 4).fold(T::infinity().next_down(), |x, _| x.next_down()),
        _ => like
            .round_from_exact(
                &(int(1 + (digits % 1000) as i32) * Exact::power_of_two((digits % 7) as i32 * 5 - 15)),
            )
            .unwrap(),
    };
    if negative { -x } else { x }
}

type Extreme = (u8, u32, bool);

fn any_extreme() -> impl Strategy<Value = Extreme> {
    (0u8..8, any::<u32>(), any::<bool>())
}

/// The sign of a₁b₁ + a₂b₂ − a₃b₃ in floats is that in rationals.
fn the_sign_is_exact<T: Float>(like: &T, numbers: [Extreme; 6]) -> Result<(), TestCaseError> {
    let [a1, b1, a2, b2, a3, b3] = numbers.map(|x| extreme(like, x));
    let product = |a: &T, b: &T| exact(a) * exact(b);
    let sign = (product(&a1, &b1) + product(&a2, &b2)).cmp(&product(&a3, &b3));
    prop_assert_eq!(T::sign_of_sum([(&a1, &b1), (&a2, &b2)], (&a3, &b3)), sign);
    let [c, m] = [a1, a2].map(|x| x.abs());
    let system = SpringMass { c, m, g: b1, l: b2, h: b3 };
    let r = system::reaction(&system.map(exact));
    let (state, is_system) = (State::of(&system).ok(), !system.c.is_zero() && !system.m.is_zero());
    prop_assert_eq!(state, is_system.then(|| state_by_sign(r.cmp(&int(0)))), "{:?}", system.map(exact));
    Ok(())
}

/// m g and c (H − l) agree as well as their digits allow, or differ by some ulps of g, so rounding can change
/// the sign of their difference. Both are about 2ᵏ. For significands slightly above 1, half an ulp is nearly
/// η.
fn the_state_is_exact_where_rounding_could_turn_it<T: Float>(
    like: &T,
    k: i32,
    (digits, zeros, below): ([u32; 4], [u32; 4], bool),
) -> Result<(), TestCaseError> {
    let [c, m, l, h] = [0, 1, 2, 3].map(|i| {
        // More digits than any of the machine's floats have.
        let full = 1 << 63 | (u64::from(digits[i]) << 31 | u64::from(!digits[3 - i])) >> zeros[i];
        let size = if i < 2 { k / 2 } else { k - k / 2 };
        like.round_from_exact(&(Exact::from(Rational::from(full)) * Exact::power_of_two(size - 63))).unwrap()
    });
    // Then H − l is rounded, too.
    let l = if below { -l } else { l };
    // The neighbours of 0 in MPFR have a billion digits.
    prop_assume!(h != l);
    let g = exact(&c) * (exact(&h) - exact(&l)) / exact(&m);
    let mut g = like.round_from_exact(&g).unwrap().next_down().next_down();
    for _ in 0..5 {
        let [c, m, l, h] = [&c, &m, &l, &h].map(T::clone);
        let system = SpringMass { c, m, g: g.clone(), l, h };
        let r = system::reaction(&system.map(exact));
        prop_assert_eq!(State::of(&system), Ok(state_by_sign(r.cmp(&int(0)))), "{:?}", system.map(exact));
        g = g.next_up();
    }
    Ok(())
}

fn mantissas() -> impl Strategy<Value = ([u32; 4], [u32; 4], bool)> {
    (prop::array::uniform4(any::<u32>()), prop::array::uniform4(0..8u32), any::<bool>())
}

/// With a subnormal mass, then with a subnormal stiffness: m g = c H, so the state depends on l alone.
fn a_subnormal_system_can_graze<T: Float>(
    like: &T,
    (n, k, shift): (i32, i32, i32),
    l: Extreme,
) -> Result<(), TestCaseError> {
    let (unit, scale) = (exact(&T::min_subnormal()), Exact::power_of_two(shift));
    let (n, k) = (int(n), int(k));
    for (m, g, c, h) in [
        (&n * &unit, &k * &scale, &k * &unit * &scale, n.clone()),
        (&n * &unit * &scale, k.clone(), &k * &unit, &n * &scale),
    ] {
        let [c, m, g, h] = [c, m, g, h].map(|x| like.round_from_exact(&x).unwrap());
        let l = extreme(like, l);
        let sign = exact(&l).cmp(&int(0));
        let system = SpringMass { c, m, g, l, h };
        prop_assert_eq!(State::of(&system), Ok(state_by_sign(sign)), "{:?}", system.map(exact));
    }
    Ok(())
}

/// A change of any parameter by one ulp changes the state in the direction of the sign of ∂R.
fn one_ulp_decides<T: Float>(s: &SpringMass<Exact>, like: &T) -> Result<(), TestCaseError> {
    let s = s.try_map(|x| like.round_from_exact(x)).unwrap();
    prop_assert_eq!(solve(&s, &Method::Lagrange).unwrap().state, State::Grazing);
    let gap = system::gap(&s.map(exact));
    let (zero, one) = (int(0), int(1));
    type Nudge<T> = fn(&mut SpringMass<T>) -> &mut T;
    // R = m g − c (H − l), so ∂R is g, −Δ, m, c, −c; and g has the sign of Δ here.
    let parameters: [(Nudge<T>, Ordering); 5] = [
        (|s| &mut s.m, gap.cmp(&zero)),
        (|s| &mut s.c, zero.cmp(&gap)),
        (|s| &mut s.g, one.cmp(&zero)),
        (|s| &mut s.l, one.cmp(&zero)),
        (|s| &mut s.h, zero.cmp(&one)),
    ];
    for (parameter, slope) in parameters {
        for up in [true, false] {
            let mut nudged = s.clone();
            let x = parameter(&mut nudged);
            *x = if up { x.clone().next_up() } else { x.clone().next_down() };
            let state = state_by_sign(if up { slope } else { slope.reverse() });
            prop_assert_eq!(State::of(&nudged), Ok(state), "{:?}", nudged);
            let r = system::reaction(&nudged.map(exact));
            prop_assert_eq!(state_by_sign(r.cmp(&zero)), state, "{:?}", nudged);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn one_ulp_off_grazing_in_f32(s in exactly_grazing(24)) {
        one_ulp_decides(&s, &1f32)?;
    }
    #[test]
    fn one_ulp_off_grazing_in_f64(s in exactly_grazing(53)) {
        one_ulp_decides(&s, &1f64)?;
    }
    #[test]
    fn one_ulp_off_grazing_in_mpfr(s in exactly_grazing(80)) {
        one_ulp_decides(&s, &int(1).to_mpfr(80))?;
    }

    #[test]
    fn the_sign_is_exact_at_the_ends_of_f32(numbers in prop::array::uniform6(any_extreme())) {
        the_sign_is_exact(&1f32, numbers)?;
    }
    #[test]
    fn the_sign_is_exact_at_the_ends_of_f64(numbers in prop::array::uniform6(any_extreme())) {
        the_sign_is_exact(&1f64, numbers)?;
    }
    // Among the subnormal numbers, in the middle, and where the products overflow.
    #[test]
    fn the_state_is_exact_near_grazing_in_f32(
        k in prop_oneof![-150..-120, Just(0), 122..128], mantissas in mantissas(),
    ) {
        the_state_is_exact_where_rounding_could_turn_it(&1f32, k, mantissas)?;
    }
    #[test]
    fn the_state_is_exact_near_grazing_in_f64(
        k in prop_oneof![-1075..-1018, Just(0), 1018..1024], mantissas in mantissas(),
    ) {
        the_state_is_exact_where_rounding_could_turn_it(&1f64, k, mantissas)?;
    }
    #[test]
    fn the_state_is_exact_near_grazing_in_mpfr(bits in 2u32..80, mantissas in mantissas()) {
        the_state_is_exact_where_rounding_could_turn_it(&int(1).to_mpfr(bits), 0, mantissas)?;
    }
    #[test]
    fn a_subnormal_system_can_graze_in_f32(n in (1..1 << 22, 1..1 << 22, 30..80), l in any_extreme()) {
        a_subnormal_system_can_graze(&1f32, n, l)?;
    }
    #[test]
    fn a_subnormal_system_can_graze_in_f64(n in (1..i32::MAX, 1..i32::MAX, 30..900), l in any_extreme()) {
        a_subnormal_system_can_graze(&1f64, n, l)?;
    }

    /// Arbitrary finite floats.
    #[test]
    fn the_state_is_exact_for_any_f64(bits in prop::array::uniform5(any::<u64>()), copy in any::<bool>()) {
        // Clearing the top bit of the exponent keeps a number finite.
        let [c, m, g, l, h] = bits.map(|b| f64::from_bits(b & !(1 << 62)));
        let h = if copy { l } else { h };
        let system = SpringMass { c: c.abs(), m: m.abs(), g, l, h };
        let r = system::reaction(&system.map(exact));
        prop_assert_eq!(State::of(&system), Ok(state_by_sign(r.cmp(&int(0)))));
    }
    #[test]
    fn the_state_is_exact_for_any_f32(bits in prop::array::uniform5(any::<u32>()), copy in any::<bool>()) {
        let [c, m, g, l, h] = bits.map(|b| f32::from_bits(b & !(1 << 30)));
        let h = if copy { l } else { h };
        let system = SpringMass { c: c.abs(), m: m.abs(), g, l, h };
        let r = system::reaction(&system.map(exact));
        prop_assert_eq!(State::of(&system), Ok(state_by_sign(r.cmp(&int(0)))));
    }
}
