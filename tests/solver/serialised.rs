//! Serialised values are deserialised unchanged.

use crate::strategies::*;
use serde_json::json;
use spring_mass_contact::solver::advise;

/// Every number system has texts or numbers that a system of rationals is read from without rounding.
#[test]
fn numbers_come_back() {
    holds((any_state(WIDE), any::<u64>()), |(case, k)| {
        let text = serde_json::to_string(&case.system).unwrap();
        assert_eq!(serde_json::from_str::<SpringMass<Exact>>(&text).unwrap(), case.system);
        for method in case.methods(*k) {
            let text = serde_json::to_string(&method).unwrap();
            assert_eq!(serde_json::from_str::<Method<Exact>>(&text).unwrap(), method);
        }
        let floats = case.rounded(&float(100)).system;
        let text = serde_json::to_string(&floats).unwrap();
        let read = serde_json::from_str::<SpringMass<Exact>>(&text).unwrap();
        assert_eq!(read.map(|x| x.to_mpfr(100)), floats);
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
        "method": "augmented", "penalty": 4.0, "tolerance": 1e-9, "max_augmentations": 1000,
        "initial_multiplier": -0.0
    });
    assert_eq!(serde_json::to_value(augmentation(4.0, 1e-9, 1000, -0.0)).unwrap(), expected);
}

/// The error is one line with the text that was read.
#[test]
fn texts_that_are_not_numbers_are_rejected() {
    for (text, said) in
        [("NaN", "\"NaN\": not a number"), ("1\n2", "\"1\\n2\": not a number"), ("", "\"\": empty")]
    {
        let value = json!({ "method": "penalty", "penalty": text });
        let error = serde_json::from_value::<Method<Exact>>(value).unwrap_err().to_string();
        assert!(error.starts_with(said) && !error.contains('\n'), "{error}");
    }
}

#[test]
fn advice_has_the_fields_of_its_choices() {
    let advice = advise(&example().as_ref().map(exact), &q("1/4")).unwrap();
    let value = serde_json::to_value(&advice).unwrap();
    assert_eq!((value["state"].clone(), value["floor"].clone()), (json!("contact"), json!("0")));
    let expected = json!({
        "method": "penalty", "penalty": "41/10", "penalty_range": ["401/100", null], "augmentations": null,
        "penetration": "20/81", "force_error": "80/81", "relative_force_error": "40/81"
    });
    assert_eq!(value["recommendations"][1], expected);
}
