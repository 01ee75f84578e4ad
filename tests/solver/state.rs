//! The state is that of the exact sign of R, in floats as well, wherever rounding could turn it.

use crate::strategies::*;
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

/// Asserts that the state is that of R in rationals.
fn state_is_exact<T: Float>(system: &SpringMass<T>) {
    let numbers = system.as_ref().map(exact);
    assert_eq!(State::of(system), Ok(state_for(&system::reaction(&numbers))), "{numbers:?}");
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
