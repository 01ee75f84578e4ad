//! The Karush-Kuhn-Tucker conditions (1.6): satisfied by the Lagrange multiplier method and by the limit of
//! the augmentation, violated by known amounts by the penalty method; in contact, grazing and separated.

use crate::strategies::*;
use spring_mass_contact::chapter::{contact, penalty};
use spring_mass_contact::number::Ball;
use spring_mass_contact::rug::Rational;
use std::cmp::Ordering;

/// Returns the state for a value of R.
fn state_for(r: &Exact) -> State {
    if r.is_zero() {
        State::Grazing
    } else if *r > int(0) {
        State::Contact
    } else {
        State::Separated
    }
}

// In rationals.

/// Each state has one exact solution with zero residuals: N = ⟨R⟩ and −c p = ⟨−R⟩.
#[test]
fn lagrange_meets_the_conditions() {
    let planted = [
        (in_contact(WIDE), State::Contact),
        (grazing(WIDE), State::Grazing),
        (separated(WIDE), State::Separated),
    ];
    for (cases, state) in planted {
        holds(cases, |case| {
            let (s, r) = (&case.system, case.reaction());
            let answer = solve(s, &Method::Lagrange).unwrap();
            assert_eq!((answer.state, answer.outcome), (state, Outcome::Direct));
            assert_eq!(state_for(&r), state, "the sign of R is planted");
            assert!(answer.residuals(s).unwrap().is_zero());
            assert_eq!(answer.deflection, resting(s));
            assert_eq!(answer.contact_force, r.positive_part());
            assert_eq!(-&s.c * &answer.penetration, (-r).positive_part());
            assert_eq!(answer.multiplier.as_ref(), Some(&answer.contact_force));
            // (1.6) solved, as the chapter's functions have it.
            assert_eq!(contact::deflection(s), answer.deflection);
            assert_eq!(contact::contact_force(s), answer.contact_force);
        });
    }
}

/// No other pair (u, N) satisfies all four conditions.
#[test]
fn the_conditions_have_one_solution() {
    let displacement = prop_oneof![
        (nonzero(WIDE), number(WIDE)),
        (number(WIDE), nonzero(WIDE)),
        // Still in equilibrium, so the other three conditions must detect it: N = −c u, relative to c = 1.
        nonzero(WIDE).prop_map(|du| (du.clone(), -du)),
    ];
    holds((any_state(WIDE), displacement), |(case, (du, dn))| {
        let s = &case.system;
        for dn in [dn.clone(), dn * &s.c] {
            assert!(!contact::kkt(s, &(resting(s) + du), &(pushing(s) + dn)).is_zero());
        }
    });
}

/// Each condition is needed: the solution of the other state violates exactly one of them.
#[test]
fn the_other_branch_violates_one_condition() {
    holds(not_grazing(WIDE), |case| {
        let (s, r) = (&case.system, case.reaction());
        let free = contact::kkt(s, &(&s.m * &s.g / &s.c), &int(0));
        let touching = contact::kkt(s, &(&s.h - &s.l), &r);
        for kkt in [&free, &touching] {
            assert_eq!((&kkt.stationarity, &kkt.complementarity), (&int(0), &int(0)));
        }
        // R > 0: it would hang free inside the plane. R < 0: the plane would have to pull.
        assert_eq!((free.primal, free.dual), ((&r / &s.c).positive_part(), int(0)));
        assert_eq!((touching.primal, touching.dual), (int(0), (-r).positive_part()));
    });
}

/// As printed, the plane pulls if the mass is separated: N = R < 0.
#[test]
fn a_bilateral_plane_pulls_when_separated() {
    holds(separated(WIDE), |case| {
        let answer = solve_bilateral(&case.system, &Method::Lagrange).unwrap();
        let kkt = answer.residuals(&case.system).unwrap();
        assert_eq!(answer.state, State::Separated);
        assert_eq!((kkt.stationarity, kkt.primal, kkt.dual), (int(0), int(0), -case.reaction()));
    });
}

/// c p + N = R: for every method, plane and step the error of the force is c times the penetration.
#[test]
fn the_error_of_the_force_is_c_times_the_penetration() {
    holds((any_state(WIDE), 0u64..12), |(case, steps)| {
        let (c, r) = (&case.system.c, case.reaction());
        for (plane, method, answer) in case.solutions(*steps) {
            assert_eq!(c * &answer.penetration + &answer.contact_force, r, "{plane:?} {method:?}");
            assert!(answer.residuals(&case.system).unwrap().stationarity.is_zero());
        }
        for step in planes::<Exact>().iter().flat_map(|(plane, _)| case.steps(*plane).take(8)) {
            assert_eq!(c * step.penetration + step.contact_force, r);
        }
    });
}

/// In contact the positive parts have no effect (from λ₀ ≥ −ε R/c on, for which the first step is in contact).
#[test]
fn one_sided_is_two_sided_in_contact() {
    holds((in_contact(WIDE), any::<bool>()), |(case, edge)| {
        let least = -&case.eps * case.reaction() / &case.system.c;
        let start = if *edge { least } else { case.start.clone().max(least) };
        let case = Case { start, ..case.clone() };
        for method in case.methods(10) {
            assert_eq!(
                solve(&case.system, &method).unwrap(),
                solve_bilateral(&case.system, &method).unwrap()
            );
        }
    });
}

// In floats, checked in rationals; nothing under- or overflows here.

fn certificate_is_small<T: Float>(case: &Case<T>) {
    let (s, r, eta) = (case.system.map(exact), case.exact().reaction(), case.eta());
    let (gap, weight) = (system::gap(&s).abs(), system::weight(&s).abs());
    // û = fl(H − l) has one rounding; û = fl(fl(m g)/c) has two, 2η + η² relative to the result.
    let twice = (int(2) * &eta + &eta * &eta) * &weight;
    let of_free = &twice / &s.c;
    // N = fl(fl(m g) − fl(c û)): each product once, the difference once.
    let of_force = |u: &Exact, n: &Exact| &eta * (&weight + (&s.c * u).abs() + n);
    let certified = |method: Method<T>| {
        let answer = solve(&case.system, &method).unwrap();
        let kkt = answer.residuals(&case.system).unwrap();
        assert_eq!(answer.state, state_for(&r));
        assert!(kkt.dual.is_zero());
        (kkt, exact(&answer.deflection), exact(&answer.contact_force))
    };

    let (kkt, u, n) = certified(Method::Lagrange);
    let u_error = if r < int(0) { of_free.clone() } else { &eta * gap };
    // Exactly 0 where R ≤ 0.
    let n_error = if r > int(0) { of_force(&u, &n) } else { int(0) };
    assert!((&u - resting(&s)).abs() <= u_error);
    // ⟨·⟩ after a rounding may only bring N nearer to R > 0, not the sum of the forces: c times the rest.
    assert!(kkt.stationarity.abs() <= &s.c * &u_error + &n_error);
    assert!((&n - pushing(&s)).abs() <= &s.c * &u_error + n_error);
    assert!(kkt.primal <= u_error);
    assert_eq!(kkt.complementarity.abs(), (&s.l + &u - &s.h).abs() * n);
    assert!(r > int(0) || kkt.complementarity.is_zero(), "N = 0 exactly");

    let (kkt, u, n) = certified(case.penalty());
    // The rounding error of (1.13), computed: the formula read in balls.
    let balls = case.map(|x| Ball::point(x.clone()));
    let of_formula = || exact(penalty::deflection(&balls.system, &balls.eps).radius());
    let u_error = if r < int(0) { of_free } else { of_formula() };
    let p = r.positive_part() / (&s.c + exact(&case.eps));
    assert!((&kkt.primal - p).abs() <= u_error);
    assert!(kkt.stationarity.abs() <= &s.c * u_error + of_force(&u, &n));

    // Wherever the augmentation stops, its force is in equilibrium with its deflection: N = fl(m g − c û), or
    // 0 where û = fl(m g/c) or where the difference is negative for no other reason than û's two roundings.
    let (kkt, u, n) = certified(case.augmented(50));
    assert!(kkt.stationarity.abs() <= of_force(&u, &n) + twice);
}

/// The plane never pulls, despite rounding.
fn the_plane_never_pulls<T: Float>(case: &Case<T>) {
    for method in case.methods(50) {
        assert!(solve(&case.system, &method).unwrap().contact_force >= T::zero(), "{method:?}");
    }
    for step in case.steps(Plane::Unilateral).take(20) {
        assert!(step.contact_force >= T::zero(), "k = {}", step.k);
        assert!(step.k == 0 || step.multiplier >= T::zero(), "k = {}", step.k);
    }
}

in_every_float! {
    certificate_is_small from any_state;
    the_plane_never_pulls from any_state;
}

// The state.

/// Asserts that the state is that of R in rationals.
fn state_is_exact<T: Float>(system: &SpringMass<T>) {
    let numbers = system.map(exact);
    assert_eq!(State::of(system), Ok(state_for(&system::reaction(&numbers))), "{numbers:?}");
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

/// A change of any parameter by one ulp changes the state in the direction of the sign of ∂R.
fn one_ulp_decides<T: Float>(s: &SpringMass<Exact>, like: &T) {
    let s = s.map(|x| like.round_from_exact(x).unwrap());
    assert_eq!(solve(&s, &Method::Lagrange).unwrap().state, State::Grazing);
    let gap = system::gap(&s.map(exact));
    // R = m g − c (H − l), so ∂R is g, −Δ, m, c, −c; and g has the sign of Δ here.
    type Parameter<T> = fn(&mut SpringMass<T>) -> &mut T;
    let parameters: [(Parameter<T>, Exact); 5] = [
        (|s| &mut s.m, gap.clone()),
        (|s| &mut s.c, -gap),
        (|s| &mut s.g, int(1)),
        (|s| &mut s.l, int(1)),
        (|s| &mut s.h, int(-1)),
    ];
    for (parameter, slope) in parameters {
        for (step, slope) in [(T::next_up as fn(T) -> T, slope.clone()), (T::next_down, -slope)] {
            let mut nudged = s.clone();
            let x = parameter(&mut nudged);
            *x = step(x.clone());
            state_is_exact(&nudged);
            assert_eq!(State::of(&nudged), Ok(state_for(&slope)), "{nudged:?}");
        }
    }
}

#[test]
fn one_ulp_off_grazing_decides() {
    holds(exactly_grazing(24), |s| one_ulp_decides(s, &1f32));
    holds(exactly_grazing(53), |s| one_ulp_decides(s, &1f64));
    holds(exactly_grazing(80), |s| one_ulp_decides(s, &float(80)));
}

/// A float of either sign at an end of the range or elsewhere.
type Extreme = (u8, u32, bool);

fn any_extreme() -> impl Strategy<Value = Extreme> {
    (0u8..8, any::<u32>(), any::<bool>())
}

/// Returns the float: zero, subnormal, next to the smallest normal number, the largest, or any other.
fn extreme<T: Float>(like: &T, (kind, digits, negative): Extreme) -> T {
    let round = |x: Exact| like.round_from_exact(&x).unwrap();
    let least = exact(&T::min_subnormal());
    // The smallest normal number in units of the least, and a part of it.
    let normal = int(1) / (int(2) * unit_roundoff(like));
    let part = &normal * Exact::from(Rational::from((digits, u32::MAX)));
    let part = Exact::from(Rational::from(part.as_rational().ceil_ref()));
    let n = digits as i32;
    let x = match kind {
        0 => T::zero(),
        1 => round(int(1 + n.rem_euclid(3)) * least),
        2 | 3 => round(part * least),
        4 => round((part + normal) * least),
        5 => (0..digits % 4).fold(T::infinity().next_down(), |x, _| x.next_down()),
        _ => round(int(1 + n.rem_euclid(1000)) * Exact::power_of_two(n.rem_euclid(7) * 5 - 15)),
    };
    if negative { -x } else { x }
}

/// m g + c l compared with c H, as functions of all numbers at the ends of the range.
fn the_sign_is_exact<T: Float>(like: &T, numbers: [Extreme; 6]) {
    let [a1, b1, a2, b2, a3, b3] = numbers.map(|x| extreme(like, x));
    let product = |a: &T, b: &T| exact(a) * exact(b);
    let sign = (product(&a1, &b1) + product(&a2, &b2)).cmp(&product(&a3, &b3));
    assert_eq!(T::sign_of_sum([(&a1, &b1), (&a2, &b2)], (&a3, &b3)), sign);
    let [c, m] = [a1, a2].map(|x| x.abs());
    let system = SpringMass { c, m, g: b1, l: b2, h: b3 };
    if system.c.is_zero() || system.m.is_zero() {
        assert!(State::of(&system).is_err());
    } else {
        state_is_exact(&system);
    }
}

#[test]
fn the_sign_is_exact_at_the_ends_of_the_range() {
    let numbers = || prop::array::uniform6(any_extreme());
    holds(numbers(), |numbers| the_sign_is_exact(&1f32, *numbers));
    holds(numbers(), |numbers| the_sign_is_exact(&1f64, *numbers));
    the_sign_is_exact(&1f64, [(0, 0, false); 6]);
    // Its square has no digits among the last 64 of the accumulator.
    let subnormal = f64::from_bits(1 << 51);
    let positive = f64::sign_of_sum([(&subnormal, &subnormal), (&0.0, &0.0)], (&0.0, &0.0));
    assert_eq!(positive, Ordering::Greater);
}

/// m g and c (H − l) agree as well as their digits allow, or differ by some ulps of g, so rounding can change
/// the sign of their difference. Both are about 2ᵏ. For significands slightly above 1, half an ulp is nearly
/// η.
fn the_state_is_exact_near_grazing<T: Float>(
    like: &T,
    k: i32,
    (digits, zeros, below): ([u32; 4], [u32; 4], bool),
) {
    let [c, m, l, h] = [0, 1, 2, 3].map(|i| {
        // More digits than any of the machine's floats have.
        let full = 1 << 63 | (u64::from(digits[i]) << 31 | u64::from(!digits[3 - i])) >> zeros[i];
        let size = if i < 2 { k / 2 } else { k - k / 2 };
        like.round_from_exact(&(Exact::from(Rational::from(full)) * Exact::power_of_two(size - 63))).unwrap()
    });
    // Then H − l is rounded, too.
    let l = if below { -l } else { l };
    // Otherwise g = 0, and its neighbours in MPFR have a billion digits.
    if h == l {
        return;
    }
    let g = exact(&c) * (exact(&h) - exact(&l)) / exact(&m);
    let mut g = like.round_from_exact(&g).unwrap().next_down().next_down();
    for _ in 0..5 {
        let [c, m, l, h] = [&c, &m, &l, &h].map(T::clone);
        state_is_exact(&SpringMass { c, m, g: g.clone(), l, h });
        g = g.next_up();
    }
}

/// Among the subnormal numbers, in the middle, and where the products overflow.
#[test]
fn the_state_is_exact_where_rounding_could_turn_it() {
    let digits =
        || (prop::array::uniform4(any::<u32>()), prop::array::uniform4(0..8u32), any::<bool>()).boxed();
    let singles = prop_oneof![-150..-120, Just(0), 122..128];
    holds((singles, digits()), |(k, digits)| the_state_is_exact_near_grazing(&1f32, *k, *digits));
    let doubles = prop_oneof![-1075..-1018, Just(0), 1018..1024];
    holds((doubles, digits()), |(k, digits)| the_state_is_exact_near_grazing(&1f64, *k, *digits));
    holds((2u32..80, digits()), |(bits, digits)| the_state_is_exact_near_grazing(&float(*bits), 0, *digits));
}

/// With a subnormal mass, then with a subnormal stiffness: m g = c H, so the state depends on l alone.
fn a_subnormal_system_can_graze<T: Float>(like: &T, (n, k, shift): (i32, i32, i32), l: Extreme) {
    let (unit, scale) = (exact(&T::min_subnormal()), Exact::power_of_two(shift));
    let (n, k, l) = (int(n), int(k), extreme(like, l));
    for parameters in [
        [&k * &unit * &scale, &n * &unit, &k * &scale, n.clone()],
        [&k * &unit, &n * &unit * &scale, k.clone(), &n * &scale],
    ] {
        let [c, m, g, h] = parameters.map(|x| like.round_from_exact(&x).unwrap());
        let system = SpringMass { c, m, g, l: l.clone(), h };
        assert_eq!(State::of(&system), Ok(state_for(&exact(&l))), "{:?}", system.map(exact));
    }
}

#[test]
fn a_subnormal_system_can_graze_in_f32() {
    let numbers = (1..1 << 22, 1..1 << 22, 30..80);
    holds((numbers, any_extreme()), |(n, l)| a_subnormal_system_can_graze(&1f32, *n, *l));
}
#[test]
fn a_subnormal_system_can_graze_in_f64() {
    let numbers = (1..i32::MAX, 1..i32::MAX, 30..900);
    holds((numbers, any_extreme()), |(n, l)| a_subnormal_system_can_graze(&1f64, *n, *l));
}

/// Arbitrary finite floats: clearing the top bit of the exponent keeps a number finite.
#[test]
fn the_state_is_exact_for_any_float() {
    fn any_floats<T: Float>([c, m, g, l, h]: [T; 5], copy: bool) {
        let h = if copy { l.clone() } else { h };
        let (c, m) = (c.abs(), m.abs());
        // Refused as parameters.
        if !c.is_zero() && !m.is_zero() {
            state_is_exact(&SpringMass { c, m, g, l, h });
        }
    }
    holds((prop::array::uniform5(any::<u64>()), any::<bool>()), |(bits, copy)| {
        any_floats(bits.map(|b| f64::from_bits(b & !(1 << 62))), *copy);
        any_floats(bits.map(|b| f32::from_bits(b as u32 & !(1 << 30))), *copy);
    });
}
