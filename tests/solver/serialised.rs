//! Serialised values are deserialised unchanged.

use super::shown::any_float;
use crate::strategies::*;
use serde_json::{Value, json};
use spring_mass_contact::number::{ExactText, Field};
use spring_mass_contact::solver::advise;
use std::fmt::Debug;

/// Returns a system and a method that were serialised, from their texts.
fn read<T: ExactText + Field>(system: &SpringMass<T>, method: &Method<T>) -> (SpringMass<T>, Method<T>) {
    let (system, method) = (serde_json::to_string(system).unwrap(), serde_json::to_string(method).unwrap());
    (serde_json::from_str(&system).unwrap(), serde_json::from_str(&method).unwrap())
}

/// Asserts that numbers come back as they were, as `bits` distinguishes them.
fn come_back<T: ExactText + Field + PartialEq + Debug, B: PartialEq + Debug>(
    case: &Case<T>,
    max_augmentations: u64,
    bits: fn(&T) -> B,
) {
    for method in case.methods(max_augmentations) {
        let (system, again) = read(&case.system, &method);
        let all = |SpringMass { c, m, g, l, h }: &SpringMass<T>| [c, m, g, l, h].map(bits);
        assert_eq!(all(&system), all(&case.system));
        assert_eq!(again, method);
        if let (Method::Augmented { start: was, .. }, Method::Augmented { start: is, .. }) = (method, again) {
            assert_eq!(bits(&was), bits(&is));
        }
    }
}

/// Returns a case of any numbers.
fn case_of<T>([c, m, g, l, h, eps, start, tolerance]: [T; 8]) -> Case<T> {
    Case { system: SpringMass { c, m, g, l, h }, eps, start, tolerance }
}

#[test]
fn numbers_come_back_bit_by_bit() {
    let singles = any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |x| x.is_finite());
    let subnormal = any::<u32>().prop_map(|bits| f32::from_bits(bits >> 10));
    let singles = prop_oneof![6 => singles, 1 => subnormal, 1 => Just(-0.0)].boxed();
    holds((prop::array::uniform8(any_float()), any::<u64>()), |(numbers, k)| {
        come_back(&case_of(*numbers), *k, |x: &f64| x.to_bits());
    });
    holds((prop::array::uniform8(singles), any::<u64>()), |(numbers, k)| {
        come_back(&case_of(*numbers), *k, |x: &f32| x.to_bits());
    });
    holds((any_state(WIDE), any::<u64>()), |(case, k)| come_back(case, *k, Exact::clone));
}

/// A number is read as a constant; rounded to the original precision it is unchanged.
#[test]
fn a_float_of_mpfr_comes_back_as_a_constant() {
    holds((any_state(WIDE), any::<u64>(), 2u32..300), |(case, k, bits)| {
        let case = case.rounded(&float(*bits));
        let rounded = |x: &Mpfr| exact(x).to_mpfr(*bits);
        for method in case.methods(*k) {
            let (system, again) = read(&case.system, &method);
            assert!(system.c.precision().is_none());
            assert_eq!(system.map(rounded), case.system);
            assert_eq!(again.penalty().map(rounded).as_ref(), method.penalty());
        }
    });
}

/// The keys are those of a line of `contact solve --batch`.
#[test]
fn a_system_and_a_method_are_a_line_of_a_batch() {
    let expected = json!({
        "stiffness": "100", "mass": "1", "gravity": "981/100", "free_length": "1", "height": "21/20"
    });
    assert_eq!(serde_json::to_value(default_system()).unwrap(), expected);
    assert_eq!(serde_json::to_value(Method::<f64>::Lagrange).unwrap(), json!({ "method": "lagrange" }));
    let expected = json!({
        "method": "augmented", "penalty": "4", "tolerance": "1e-9", "max_augmentations": 1000,
        "initial_multiplier": "-0"
    });
    assert_eq!(serde_json::to_value(augmentation(4.0, 1e-9, 1000, -0.0)).unwrap(), expected);
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
    let advice = advise(&example().map(exact), &q("1/4")).unwrap();
    let value = serde_json::to_value(&advice).unwrap();
    assert_eq!((value["state"].clone(), value["floor"].clone()), (json!("contact"), json!("0")));
    let expected = json!({
        "method": "penalty", "penalty": "41/10", "penalty_range": ["401/100", null], "augmentations": null,
        "penetration": "20/81", "force_error": "80/81", "relative_force_error": "40/81"
    });
    assert_eq!(value["recommendations"][1], expected);
    assert!(value["recommendations"][0]["penalty_range"].as_array().unwrap().iter().all(Value::is_null));
}
