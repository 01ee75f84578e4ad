//! Printed numbers, intervals and results: a printed interval contains the exact one.

use crate::strategies::*;
use spring_mass_contact::chapter::contact;
use spring_mass_contact::number::{ExactText, ParseError};
use spring_mass_contact::solver::{FunctionalCondition, FunctionalError};

/// Returns the enclosure in the line of a quantity, without the unit: `… to …`, or one number for both ends.
fn enclosure(shown: &str, symbol: &str, name: &str) -> [Exact; 2] {
    let line = shown.lines().find(|line| line.starts_with(&format!("{symbol} "))).unwrap();
    let (_, rest) = line.split_once(&format!(", {name} ")).unwrap_or_else(|| panic!("{line}"));
    let (text, _unit) = rest.rsplit_once(' ').unwrap();
    let (lower, upper) = text.split_once(" to ").unwrap_or((text, text));
    [q(lower), q(upper)]
}

/// Ends and floors are rounded outwards at every length.
fn what_is_written_encloses<T: Float + ExactText>(case: &Case<T>) {
    for (.., answer) in case.solutions(200) {
        let shown = answer.to_string();
        let name = if answer.outcome == Outcome::Direct { "exact" } else { "limit" };
        let bounds = &answer.bounds;
        for (symbol, interval) in
            [("u", &bounds.deflection), ("p", &bounds.penetration), ("N", &bounds.contact_force)]
        {
            let [lower, upper] = ends(interval);
            for written in [enclosure(&shown, symbol, name), interval.texts().map(|end| q(&end))] {
                assert!(written[0] <= lower && upper <= written[1], "{shown}");
            }
        }
        let floor = shown.lines().next().unwrap().split_once("|u − u*| at most ");
        assert_eq!(floor.is_some(), answer.floor.is_some());
        if let Some(((_, written), floor)) = floor.zip(answer.floor.as_ref()) {
            assert!(exact(floor) <= q(written.strip_suffix(" m").unwrap()), "{shown}");
        }
        assert_eq!(shown.lines().any(|line| line.starts_with('λ')), answer.multiplier.is_some());
        // A page holds it: a number has 24 characters at most, or 17 digits, a sign, a point and an exponent.
        assert!(shown.lines().count() <= 5 && shown.lines().all(|line| line.chars().count() < 110));
    }
}

/// The width is the distance of the ends if the scalar contains this number, otherwise it is larger. It is at
/// most the result of five roundings, of the difference, its radius, their sum, and an ulp, which is two:
/// (1 + η)⁵ and the second-order effect of enlarging a radius are below 1 + 8 η. Containment agrees with the
/// comparison of rationals.
fn a_width_is_no_less_than_the_distance<T: Float>(case: &Case<T>) {
    let Case { system: SpringMass { g, l, h, .. }, start, .. } = case;
    let numbers = [g, l, h, start];
    for (lower, upper) in numbers.into_iter().flat_map(|x| numbers.map(|y| (x.clone(), y.clone()))) {
        let interval = Interval { lower, upper };
        for x in numbers {
            assert_eq!(interval.contains(x), encloses(&interval, &exact(x)), "{interval:?} {x:?}");
        }
        let [lower, upper] = ends(&interval);
        let distance = upper - lower;
        if distance < int(0) {
            continue;
        }
        let width = exact(&interval.width());
        match case.eps.round_from_exact(&distance) {
            Ok(nearest) if exact(&nearest) == distance => assert_eq!(width, distance),
            _ => {
                let most = &distance * (int(1) + int(8) * case.eta());
                assert!(distance <= width && width <= most, "{interval:?} {width}");
            }
        }
    }
}

in_every_float! {
    what_is_written_encloses from any_state;
    a_width_is_no_less_than_the_distance from any_state;
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
    let answer = solve(&example(), &augmentation(4.0, 1e-300, 99, 0.0)).unwrap();
    let first = format!("contact, stagnated at k = {}, |u − u*| at most ", answer.augmentations.unwrap());
    assert!(answer.to_string().starts_with(&first), "{answer}");
    let direct = solve(&example().as_ref().map(exact), &Method::Lagrange).unwrap();
    let lines =
        ["contact, direct", "u = 2 m, exact 2 m", "p = 0 m, exact 0 m", "N = 2 N, exact 2 N", "λ = 2 N"];
    assert_eq!(direct.to_string().lines().collect::<Vec<_>>(), lines);
}

#[test]
fn conditions_and_residuals_are_described_in_words() {
    let broken =
        FunctionalError::Broken { condition: FunctionalCondition::Continuous, at: "0.5".to_string() };
    assert_eq!(broken.to_string(), "the penalty functional must be continuous in p; violated at p = 0.5 m");
    let kkt = contact::kkt(&example(), &2.25, &1.0).to_string();
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
