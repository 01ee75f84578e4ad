//! Floats of num-traits.

use crate::strategies::*;
use spring_mass_contact::number::{ExactText, Native, NumberSystem};
use spring_mass_contact::rug::float::Round;

/// All bits of all results, as the debug format shows them; that of `Native` is that of the float.
#[test]
fn native_f64_gives_the_bits_of_f64() {
    holds(any_state(WIDE), |case| {
        let case = case.rounded(&1f64);
        let expected = case.solutions(30);
        let found = case.map(|x| Native(*x)).solutions(30);
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
        for ((_, _, found), (_, _, expected)) in found.iter().zip(&expected) {
            let residuals = found.residuals(&case.system.map(Native));
            assert_eq!(residuals, expected.residuals(&case.system));
        }
    });
}

/// Returns the number of significant digits of a text.
fn digits(text: &str) -> usize {
    let digits: String = text.split('e').next().unwrap().chars().filter(char::is_ascii_digit).collect();
    digits.trim_matches('0').len()
}

/// A text has no more digits than that of the f64, and parses as the same number.
#[test]
fn native_f64_has_the_values_and_texts_of_f64() {
    holds(number(WIDE), |x| {
        let (x, native) = (1f64.round_from_exact(x).unwrap(), Native(1f64).round_from_exact(x).unwrap());
        assert_eq!((native.0.to_bits(), native.to_exact()), (x.to_bits(), x.to_exact()));
        assert_eq!(digits(&native.text()), digits(&x.text()));
        assert_eq!(native.text().parse::<Exact>().unwrap().to_f64(), Ok(x));
        assert!(native.bound(Round::Up).parse::<Exact>().unwrap() >= exact(&x));
        assert_eq!(format!("{:?}", native.neighbours()), format!("{:?}", x.neighbours()));
    });
    for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!((Native(x).to_exact(), Native(x).text()), (x.to_exact(), x.text()));
    }
    // A number of more than 19 digits has a power of ten, in f32 of more than ten.
    assert_eq!([1e18, 1e19, 1e22].map(|x| Native(x).text()), ["1000000000000000000", "1e19", "1e22"]);
    assert_eq!([1e9f32, 1e10].map(|x| Native(x).text()), ["1000000000", "1e10"]);
    assert_eq!(Native(1.5).to_string(), "1.5");
    let (format, f64) = (Native(0.5).number_system(), NumberSystem::F64);
    assert_eq!((format, Native(0.5f32).number_system()), (f64, NumberSystem::F32));
}
