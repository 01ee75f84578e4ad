//! Serialised values are deserialised unchanged.

use crate::strategies::*;
use proptest::prelude::*;
use serde_json::{Value, json};
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, ExactText, Field, Mpfr, PositivePart};
use spring_mass_contact::solver::{Method, advise};
use std::fmt::Debug;

fn every_method<T: Clone>(penalty: T, tolerance: T, start: T, max_augmentations: u64) -> [Method<T>; 3] {
    let augmented = Method::Augmented { penalty: penalty.clone(), tolerance, max_augmentations, start };
    [Method::Lagrange, Method::Penalty { penalty }, augmented]
}

fn read_back<T: ExactText + Field + PartialEq + Debug>(
    system: &SpringMass<T>,
    methods: &[Method<T>; 3],
    same: impl Fn(&T, &T) -> bool,
) -> Result<(), TestCaseError> {
    let text = serde_json::to_string(system).unwrap();
    let read: SpringMass<T> = serde_json::from_str(&text).unwrap();
    let pairs = [(&system.c, &read.c), (&system.m, &read.m), (&system.g, &read.g)];
    for (was, is) in pairs.into_iter().chain([(&system.l, &read.l), (&system.h, &read.h)]) {
        prop_assert!(same(was, is), "{was:?} became {is:?}: {text}");
    }
    for method in methods {
        let text = serde_json::to_string(method).unwrap();
        let read: Method<T> = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(&read, method);
        if let (Method::Augmented { start: was, .. }, Method::Augmented { start: is, .. }) = (method, &read) {
            prop_assert!(same(was, is), "{was:?} became {is:?}: {text}");
        }
    }
    Ok(())
}

/// Finite floats: random bits, or values that are prone to errors.
fn any_float() -> impl Strategy<Value = f64> {
    let special = [0.0, -0.0, 5e-324, -5e-324, f64::MIN_POSITIVE.next_down(), f64::MAX, f64::MIN, 0.1];
    let special = prop::sample::select(special.to_vec());
    prop_oneof![3 => any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()), 1 => special]
}

fn float_system() -> impl Strategy<Value = SpringMass<f64>> {
    prop::array::uniform5(any_float()).prop_map(|[c, m, g, l, h]| SpringMass { c, m, g, l, h })
}

proptest! {
    #[test]
    fn an_f64_comes_back_bit_by_bit(system in float_system(), [a, b, c] in prop::array::uniform3(any_float()), k: u64) {
        read_back(&system, &every_method(a, b, c, k), |a, b| a.to_bits() == b.to_bits())?;
    }

    #[test]
    fn an_f32_comes_back_bit_by_bit(bits in prop::array::uniform5(any::<u32>()), k: u64) {
        let x = bits.map(f32::from_bits);
        prop_assume!(x.iter().all(|x| x.is_finite()));
        let system = SpringMass { c: x[0], m: x[1], g: -0.0, l: x[3], h: f32::from_bits(bits[4] >> 10) };
        read_back(&system, &every_method(x[2], x[3], x[4], k), |a, b| a.to_bits() == b.to_bits())?;
    }

    #[test]
    fn a_rational_round_trips(case in any_state(WIDE), k: u64) {
        let methods = every_method(case.eps.clone(), case.tolerance.clone(), case.start.clone(), k);
        read_back(&case.system, &methods, |a, b| a == b)?;
    }

    /// The number is read as a constant of the same value; rounded to the original precision it is unchanged.
    #[test]
    fn a_float_of_mpfr_comes_back_as_a_constant(case in any_state(WIDE), k: u64, bits in 2u32..300) {
        let case = case.rounded(&Exact::from(1).to_mpfr(bits));
        let methods = every_method(case.eps.clone(), case.tolerance.clone(), case.start.clone(), k);
        let text = serde_json::to_string(&case.system).unwrap();
        let read: SpringMass<Mpfr> = serde_json::from_str(&text).unwrap();
        prop_assert!(read.c.precision().is_none());
        let again = read.map(|x| exact(x).to_mpfr(bits));
        prop_assert_eq!(again, case.system.clone());
        for method in methods {
            let text = serde_json::to_string(&method).unwrap();
            prop_assert!(serde_json::from_str::<Method<Mpfr>>(&text).is_ok(), "{}", text);
        }
    }

    /// Correctly rounded, ties to even, like machine floats.
    #[test]
    fn scientific_notation_is_that_of_the_machine(x in any_float(), decimals in 0usize..30, power in -8i32..8) {
        // Ties are rare among any bits, and among eighths they are not.
        for x in [x, (x % 1000.0).trunc() / 2_f64.powi(power)] {
            // A zero has no sign here, as in `Display`.
            let x = if x == 0.0 { 0.0 } else { x };
            let (rational, float) = (Exact::try_from(x).unwrap(), Exact::try_from(x).unwrap().to_mpfr(53));
            let machine = format!("{x:.decimals$e}");
            prop_assert_eq!(format!("{rational:.decimals$e}"), machine.clone());
            prop_assert_eq!(format!("{float:.decimals$e}"), machine);
            prop_assert_eq!(format!("{rational:e}").parse::<Exact>(), Ok(rational));
            prop_assert_eq!(Mpfr::parse(&format!("{float:e}"), 53), Ok(float));
        }
    }

    /// A third of an integer is never a tie.
    #[test]
    fn scientific_notation_of_a_fraction_is_nearest(x in nonzero(WIDE), decimals in 0usize..30) {
        let third = x / int(3);
        let (text, more) = (format!("{third:.decimals$e}"), format!("{third:.60e}"));
        let order: i32 = text.split_once('e').unwrap().1.parse().unwrap();
        let unit = if order >= 0 { power(&int(10), order as u32) } else { int(1) / power(&int(10), -order as u32) };
        let off = |text: &str| (text.parse::<Exact>().unwrap() - &third).abs();
        prop_assert!(int(2) * off(&text) * power(&int(10), decimals as u32) <= unit);
        prop_assert!(off(&more) <= off(&text));
        prop_assert_eq!(text.split(['.', 'e']).nth(1).map(str::len), (decimals > 0).then_some(decimals).or(Some(order.to_string().len())));
    }
}

#[test]
fn scientific_notation_of_special_values() {
    for text in ["0", "1", "-1", "9.96", "9.94", "99.5", "2.5", "3.5", "1e300", "1e-300", "999999"] {
        let x: Exact = text.parse().unwrap();
        let f: f64 = text.parse().unwrap();
        // A decimal that is not a float differs from its float.
        if Exact::try_from(f).as_ref() == Ok(&x) {
            for decimals in 0..4 {
                assert_eq!(format!("{x:.decimals$e}"), format!("{f:.decimals$e}"));
            }
        }
    }
    let x: Exact = "9.96".parse().unwrap();
    assert_eq!(format!("{x:e} {x:.1e} {x:.2e} {x:+10.0e}|"), "9.96e0 1.0e1 9.96e0       +1e1|");
    assert_eq!(
        format!("{:e} {:.2e} {:e}", int(0), int(0), int(1) / int(7)),
        "0e0 0.00e0 1.4285714285714286e-1"
    );
    // Seventeen digits that round up to a power of ten.
    let nines = int(1) - int(1) / (int(3) * power(&int(10), 20));
    assert_eq!(format!("{nines:e}"), "1.0000000000000000e0");
    let zero = int(0).to_mpfr(53);
    assert_eq!(format!("{zero:e} {zero:.1e} {:e}", Mpfr::rounded(9, f64::INFINITY)), "0e0 0.0e0 inf");
    // As a rational it would be longer than the memory.
    let tiny = Mpfr::from(rug_float(1) >> 1_000_000_000);
    assert!(format!("{tiny:.3e}").ends_with("e-301029996"), "{tiny:.3e}");
}

fn rug_float(n: i32) -> spring_mass_contact::rug::Float {
    spring_mass_contact::rug::Float::with_val(53, n)
}

/// The keys are those of a line of `contact solve --batch`.
#[test]
fn a_system_and_a_method_are_a_line_of_a_batch() {
    let system = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap();
    let expected = json!({
        "stiffness": "100", "mass": "1", "gravity": "981/100", "free_length": "1", "height": "21/20"
    });
    assert_eq!(serde_json::to_value(&system).unwrap(), expected);
    assert_eq!(serde_json::to_value(Method::<f64>::Lagrange).unwrap(), json!({ "method": "lagrange" }));
    let expected = json!({
        "method": "augmented", "penalty": "4", "tolerance": "1e-9", "max_augmentations": 1000,
        "initial_multiplier": "-0"
    });
    let method = match Method::augmented(4.0) {
        Method::Augmented { penalty, tolerance, max_augmentations, .. } => {
            Method::Augmented { penalty, tolerance, max_augmentations, start: -0.0 }
        }
        other => other,
    };
    assert_eq!(serde_json::to_value(method).unwrap(), expected);
}

/// The error is one line with the text that was read.
#[test]
fn texts_that_are_not_numbers_are_rejected() {
    for (text, said) in [
        ("abc", "'abc': not a number"),
        ("1e400", "'1e400': overflows f64"),
        ("-1e-400", "'-1e-400': is not zero but would round to zero in f64"),
        ("NaN", "'NaN': not a number"),
        ("1\n2", "'1\\n2': not a number"),
        ("", "'': empty"),
    ] {
        let value = json!({ "method": "penalty", "penalty": text });
        let error = serde_json::from_value::<Method<f64>>(value).unwrap_err().to_string();
        assert!(error.starts_with(said) && !error.contains('\n'), "{error}");
    }
    // A number in JSON may have been rounded by its writer.
    assert!(serde_json::from_value::<Method<f64>>(json!({ "method": "penalty", "penalty": 4 })).is_err());
    let half: Value = json!({ "stiffness": "1", "mass": "1" });
    let error = serde_json::from_value::<SpringMass<f64>>(half).unwrap_err().to_string();
    assert!(error.starts_with("missing field `gravity`"), "{error}");
}

#[test]
fn advice_has_the_fields_of_its_choices() {
    let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse().unwrap();
    let advice = advise(&system, &(int(1) / int(4))).unwrap();
    let value = serde_json::to_value(&advice).unwrap();
    assert_eq!((value["state"].clone(), value["floor"].clone()), (json!("contact"), json!("0")));
    let expected = json!({
        "method": "penalty", "penalty": "41/10", "penalty_range": ["41/10", null], "augmentations": null,
        "penetration": "20/81", "force_error": "80/81", "relative_force_error": "40/81"
    });
    assert_eq!(value["recommendations"][1], expected);
    assert!(value["recommendations"][0]["penalty_range"].as_array().unwrap().iter().all(Value::is_null));
}
