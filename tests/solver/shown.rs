//! Intervals and printed results: a printed interval contains the exact one.

use crate::in_every_float;
use crate::strategies::*;
use proptest::prelude::*;
use spring_mass_contact::chapter::{SpringMass, contact};
use spring_mass_contact::number::{Exact, ExactText, ParseError};
use spring_mass_contact::solver::{
    Condition, FunctionalError, Interval, Method, Outcome, solve, solve_bilateral,
};

/// Returns the ends of a printed interval: `… to …`, or one number for both.
fn ends(text: &str) -> [Exact; 2] {
    let (lower, upper) = text.split_once(" to ").unwrap_or((text, text));
    [lower, upper].map(|end| end.parse().unwrap_or_else(|error| panic!("{end}: {error}")))
}

/// Returns the enclosure in the line of a quantity, without the unit.
fn enclosure<'a>(shown: &'a str, symbol: &str, name: &str) -> &'a str {
    let line = shown.lines().find(|line| line.starts_with(&format!("{symbol} "))).unwrap();
    let (_, rest) = line.split_once(&format!(", {name} ")).unwrap_or_else(|| panic!("{line}"));
    rest.rsplit_once(' ').unwrap().0
}

/// Ends and floors are rounded outwards at every length.
fn what_is_written_encloses<T: Float + ExactText>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    for method in case.methods(200) {
        for solve in [solve::<T>, solve_bilateral::<T>] {
            let answer = solve(&case.system, &method).unwrap();
            let shown = answer.to_string();
            let name = if answer.outcome == Outcome::Direct { "exact" } else { "limit" };
            let bounds = &answer.bounds;
            for (symbol, interval) in
                [("u", &bounds.deflection), ("p", &bounds.penetration), ("N", &bounds.contact_force)]
            {
                let [lower, upper] = ends(enclosure(&shown, symbol, name));
                for [lower, upper] in [[lower, upper], interval.texts().map(|end| end.parse().unwrap())] {
                    prop_assert!(
                        lower <= exact(&interval.lower) && exact(&interval.upper) <= upper,
                        "{}",
                        shown
                    );
                }
            }
            let floor = shown.lines().next().unwrap().split_once("|u − u*| at most ");
            prop_assert_eq!(floor.is_some(), answer.floor.is_some());
            if let Some(((_, written), floor)) = floor.zip(answer.floor.as_ref()) {
                let written: Exact = written.strip_suffix(" m").unwrap().parse().unwrap();
                prop_assert!(exact(floor) <= written, "{}", shown);
            }
            prop_assert_eq!(shown.lines().any(|line| line.starts_with('λ')), answer.multiplier.is_some());
            // A page holds it: a number has 24 characters at most, or 17 digits, a sign, a point and an exponent.
            prop_assert!(shown.lines().count() <= 5 && shown.lines().all(|line| line.chars().count() < 110));
        }
    }
    Ok(())
}

/// The width is the distance of the ends if the scalar contains this number, otherwise it is larger. It is at
/// most the result of five roundings, of the difference, its radius, their sum, and an ulp, which is two: (1
/// + η)⁵ and the second-order effect of enlarging a radius are below 1 + 8 η.
fn a_width_is_no_less_than_the_distance<T: Float>(case: &Case<Exact>, like: &T) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    let Case { system, start, .. } = &case;
    let numbers = [&system.g, &system.l, &system.h, start];
    for (x, y) in numbers.into_iter().flat_map(|x| numbers.map(|y| (x, y))).filter(|(x, y)| x <= y) {
        let width = exact(&Interval { lower: x.clone(), upper: y.clone() }.width());
        let distance = exact(y) - exact(x);
        match like.round_from_exact(&distance) {
            Ok(nearest) if exact(&nearest) == distance => prop_assert_eq!(width, distance),
            _ => {
                let most = &distance * (int(1) + int(8) * unit_roundoff(like));
                prop_assert!(distance <= width && width <= most, "{:?} {:?} {}", x, y, width);
            }
        }
    }
    Ok(())
}

/// Containment agrees with the comparison of rationals.
fn what_is_contained_is_between_the_ends<T: Float>(
    case: &Case<Exact>,
    like: &T,
) -> Result<(), TestCaseError> {
    let case = case.rounded(like);
    let Case { system: SpringMass { g, l, h, .. }, .. } = &case;
    for [lower, upper, x] in [[g, l, h], [l, h, g], [l, l, h], [g, h, h], [l, h, l]] {
        let between = exact(lower) <= exact(x) && exact(x) <= exact(upper);
        let interval = Interval { lower: lower.clone(), upper: upper.clone() };
        prop_assert_eq!(interval.contains(x), between, "{:?} {:?}", interval, x);
    }
    Ok(())
}

in_every_float! {
    what_is_written_encloses from any_state;
    a_width_is_no_less_than_the_distance from any_state;
    what_is_contained_is_between_the_ends from any_state;
}

#[test]
fn a_non_finite_interval_is_printed_and_contains_nothing() {
    let endless = Interval { lower: f64::NAN, upper: f64::INFINITY };
    assert_eq!(endless.to_string(), "NaN to inf");
    assert!(!endless.contains(&0.0) && !Interval { lower: 0.0, upper: 1.0 }.contains(&f64::NAN));
    assert!(endless.width().is_nan());
    assert_eq!(Interval { lower: f64::MIN, upper: f64::MAX }.width(), f64::INFINITY);
}

#[test]
fn a_stagnation_reports_the_attained_penetration() {
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    let tolerance = 1e-300;
    let method = Method::Augmented { penalty: 4.0, tolerance, max_augmentations: 99, start: 0.0 };
    let answer = solve(&system, &method).unwrap();
    let first = format!("contact, stagnated at k = {}, |u − u*| at most ", answer.augmentations.unwrap());
    assert!(answer.to_string().starts_with(&first), "{answer}");
    let direct = solve(&system.map(|x| Exact::try_from(*x).unwrap()), &Method::Lagrange).unwrap();
    assert_eq!(
        direct.to_string(),
        "contact, direct\nu = 2 m, exact 2 m\np = 0 m, exact 0 m\nN = 2 N, exact 2 N\nλ = 2 N"
    );
}

#[test]
fn conditions_and_residuals_are_described_in_words() {
    let broken = FunctionalError::Broken { condition: Condition::Continuous, at: "0.5".to_string() };
    assert_eq!(broken.to_string(), "the penalty functional must be continuous in p; violated at p = 0.5 m");
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    let kkt = contact::kkt(&system, &2.25, &1.0).to_string();
    assert_eq!(kkt, "stationarity 0 N, primal 0.25 m, dual 0 N, complementarity 0.25 J");
    assert!(matches!(Method::augmented(4.0), Method::Augmented { tolerance: 1e-9, .. }));
}

/// The error of a text is the source of the error of a parameter.
#[test]
fn an_error_has_its_cause() {
    let error = SpringMass { c: "1/0", m: "1", g: "1", l: "1", h: "1" }.parse().unwrap_err();
    let cause = std::error::Error::source(&error).expect("a cause");
    assert_eq!(cause.to_string(), ParseError::DivisionByZero.to_string());
}
