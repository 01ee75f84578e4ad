//! Kinds of diagnosed mistakes: tolerances, bounds, single roundings, edits, incomplete iterations.

use super::*;

/// Returns the answers of a solver with an internal tolerance: it misses contacts, or holds the mass at the
/// plane, up to this threshold.
fn with_internal_tolerance(
    tolerance: &str,
    misses: bool,
    threshold: &str,
    quantity: fn(&SpringMass<Exact>) -> Exact,
) -> Report {
    run_within(tolerance, &default_problems(), |problem| {
        let system = &problem.system;
        let reaction = system::reaction(system);
        let is_other = if misses { reaction > Exact::zero() } else { reaction < Exact::zero() };
        match is_other && quantity(system) <= number(threshold) {
            true if misses => Answer::new(structure::deflection(system), Exact::zero()),
            true => Answer::new(system::gap(system), reaction),
            false => right(problem),
        }
    })
}

/// Values from 1.61 of each decade on, which is the largest possible minimum of a decade.
#[test]
fn a_relative_tolerance_above_that_of_the_check_is_noticed() {
    for misses in [true, false] {
        for (tolerance, threshold) in [
            ("1e-12", "1.61e-9"),
            ("1e-12", "1e-8"),
            ("1e-9", "1.61e-9"),
            ("1e-6", "1.61e-6"),
            ("1e-6", "1e-5"),
            ("1e-6", "1e-3"),
            ("1e-6", "0.1"),
        ] {
            let report = with_internal_tolerance(tolerance, misses, threshold, part);
            assert!(!report.holds(), "{threshold} passes {tolerance}");
        }
        // The report on a right solver states where a threshold would be noticed.
        let state = if misses { State::Contact } else { State::Separated };
        let least = run(&default_problems(), right).least_deciding(state, &number(TOLERANCE)).unwrap();
        for (threshold, holds) in [(least.clone(), false), (&least * number("0.999"), true)] {
            let report = with_internal_tolerance(TOLERANCE, misses, &threshold.to_string(), part);
            assert_eq!(report.holds(), holds, "{threshold}");
        }
    }
}

/// The mass is at the plane without a force, or the plane pulls the free mass.
#[test]
fn a_false_contact_is_diagnosed_from_deflection_or_force() {
    let held: [fn(&SpringMass<Exact>) -> Answer; 2] = [
        |system| Answer::new(system::gap(system), Exact::zero()),
        |system| Answer::new(structure::deflection(system), system::reaction(system)),
    ];
    for held in held {
        let report = run(&default_problems(), |problem| {
            let system = &problem.system;
            let is_held = system::reaction(system) < Exact::zero() && by_weight(system) <= number("1e-3");
            if is_held { held(system) } else { right(problem) }
        });
        assert_eq!(report.false_contacts.map(|found| found.of), Some(ThresholdQuantity::ForceByWeight));
    }
}

fn by_weight(system: &SpringMass<Exact>) -> Exact {
    system::reaction(system).abs() / system::weight(system).abs()
}

#[test]
fn a_relative_tolerance_is_diagnosed_on_either_side() {
    let by_height: fn(&SpringMass<Exact>) -> Exact =
        |system| system::reaction(system).abs() / &system.c / system.h.abs();
    for misses in [true, false] {
        for (of, quantity) in [
            (ThresholdQuantity::ForceByWeight, by_weight as fn(&_) -> _),
            (ThresholdQuantity::PenetrationByHeight, by_height),
        ] {
            for threshold in ["1e-4", "1e-3", "3e-2"] {
                let report = with_internal_tolerance(TOLERANCE, misses, threshold, quantity);
                let (found, other) = if misses {
                    (report.missed_contacts, report.false_contacts)
                } else {
                    (report.false_contacts, report.missed_contacts)
                };
                let Threshold { of: found, up_to, from, .. } = found.expect(threshold);
                assert_eq!((found, other), (of, None), "{threshold}");
                assert!(up_to <= number(threshold) && number(threshold) < from, "{up_to} {from}");
            }
        }
    }
}

/// A force limited by a constant, small or large, and one that is limited in two systems only.
#[test]
fn a_capped_force_is_diagnosed_at_most_once() {
    for cap in ["1e-2", "1", "100", "1e4", "1e6", "1e12", "1e30"] {
        let capped = changed(|_, u, n| [u, if n > number(cap) { number(cap) } else { n }]);
        let names = Vec::from_iter(capped.diagnosis.iter().map(|d| d.name.as_str()));
        let wrong = capped.summary().wrong;
        let own = format!("N is at most {} N", number(cap).decimal(6, Round::Nearest));
        let expected = if wrong >= 3 { vec![&*own] } else { vec![] };
        assert_eq!(names, expected, "{cap}: {wrong}");
    }
}

/// No diagnosis has the right formulas.
#[test]
fn a_diagnosis_has_its_own_formulas() {
    let formula = |change: fn(Exact, Exact) -> [Exact; 2]| {
        let report = changed(|_, u, n| change(u, n));
        report.identified_mistake().expect("a diagnosis").formula.clone()
    };
    assert_eq!(formula(|_, n| [Exact::zero(), n]), "u = 0, N = ⟨m g − c (H − l)⟩");
    let factor = formula(|u, n| [u * number("1000"), n]);
    assert_eq!(factor, "u = k min(m g / c, H − l), N = ⟨m g − c (H − l)⟩, k = 1000");
    let rounded = formula(|u, n| [u, n].map(|x| x.decimal(4, Round::Nearest).parse().unwrap()));
    assert_eq!(rounded, "u = fl(min(m g / c, H − l)), N = fl(⟨m g − c (H − l)⟩)");
}

/// Numbers printed by a program in single precision, and by one that converts them to double precision.
#[test]
fn a_program_in_f32_is_diagnosed() {
    let solve = |problem: &Problem, print: fn(f32) -> String| {
        let SpringMass { c, m, g, l, h } = problem.system.try_map(Exact::to_f32).unwrap();
        let eps = problem.penalty.as_ref().map(|eps| eps.to_f32().unwrap());
        let held = eps.map_or(h - l, |eps| (m * g + eps * (h - l)) / (c + eps));
        let u = (m * g / c).min(held);
        // By equilibrium, where rounding leaves a small force although the mass is separated.
        let n = eps.map_or(m * g - c * u, |eps| eps * (u - (h - l))).max(0.0);
        Answer::new(number(&print(u)), number(&print(n)))
    };
    let prints: [fn(f32) -> String; 3] =
        [|x| format!("{x:e}"), |x| format!("{:e}", f64::from(x)), |x| format!("{x:.8e}")];
    for problems in [default_problems(), with_penalties(default_problems())] {
        for print in prints {
            let report = run(&problems, |problem| solve(problem, print));
            assert_eq!(
                report.identified_mistake().map(|d| d.name.as_str()),
                Some("it computes in single precision")
            );
        }
    }
}

/// Parameters passed as text, with `%g` or a fixed number of decimals.
#[test]
fn parameters_with_few_digits_are_diagnosed() {
    let name = |change: &dyn Fn(&SpringMass<f64>) -> SpringMass<Exact>| {
        let report = run(&default_problems(), |problem| {
            let floats = problem.system.try_map(Exact::to_f64).unwrap();
            right(&Problem { system: change(&floats), ..problem.clone() })
        });
        report.identified_mistake().map(|only| only.name.clone()).unwrap_or_default()
    };
    for digits in [4, 6] {
        let shortened = |x: &f64| number(&format!("{x:.*e}", digits - 1));
        let own = format!("it uses at most {digits} digits of its parameters");
        assert_eq!(name(&|system| system.map(shortened)), own);
    }
    for decimals in [3, 6] {
        let fixed = |x: &f64| number(&format!("{x:.decimals$}"));
        let lengths = |system: &SpringMass<f64>| {
            let SpringMass { l, h, .. } = system;
            SpringMass { l: fixed(l), h: fixed(h), ..system.map(|x| number(&x.to_string())) }
        };
        assert_eq!(name(&lengths), format!("it uses at most {decimals} decimals of l and H"));
    }
}

/// A mutated formula would affect the other answers as well.
#[test]
fn a_mutant_that_explains_only_some_answers_is_not_diagnosed() {
    let edits = mistakes(false).iter().filter(|mistake| !mistake.at.is_empty());
    let named = edits.filter(|edit| {
        let few = problems(1, CASES, &[Family::Contact, Family::Separated, Family::Stiff, Family::Huge]);
        let report = run(&few, |problem| match problem.family {
            Family::Stiff | Family::Huge => answer(edit, problem, None, None),
            _ => right(problem),
        });
        report.diagnosis.iter().any(|diagnosis| diagnosis.name == edit.name)
    });
    assert_eq!(named.map(|edit| &edit.name).collect::<Vec<_>>(), Vec::<&String>::new());
}

/// (1.16) in f64.
#[test]
fn augmentations_that_end_early_are_diagnosed() {
    for (steps, eps) in [(2, 1e4), (3, 1e4), (5, 2e7), (8, 1e4)] {
        let report = run(&default_problems(), |problem| {
            let system = problem.system.try_map(Exact::to_f64).unwrap();
            let (mut u, mut lambda) = (0.0, 0.0);
            for _ in 0..steps {
                u = augmented::unilateral_deflection(&system, &eps, &lambda);
                lambda = augmented::unilateral_update(&system, &eps, &lambda, &u);
            }
            Answer::new(u.to_exact().unwrap(), lambda.to_exact().unwrap())
        });
        let name = report.identified_mistake().map(|d| d.name.clone()).unwrap_or_default();
        assert_eq!(
            name,
            format!("the augmentation stops after {steps} steps, with ε = {eps:e} N/m")
                .replace("1e4", "10000")
        );
    }
}

/// A fraction of the way of an iteration is positive, and less than twice the way.
#[test]
fn a_fraction_of_the_way_is_limited() {
    for mistake in fitted(false).iter().filter(|mistake| mistake.name.contains("{k} of the way")) {
        for (k, is_named) in [("-3", false), ("2", false), ("3", false), ("1.5", true)] {
            let report = run(&default_problems(), |problem| answer(mistake, problem, None, Some(&number(k))));
            let own = mistake.name.replace("{k}", k);
            let named = report.diagnosis.iter().any(|d| d.name == own);
            assert_eq!(named, is_named, "{own}");
        }
    }
}

/// A program with one single rounding that prints fewer digits than f64 has.
#[test]
fn a_single_rounding_is_diagnosed_from_twelve_digits() {
    let report = run(&default_problems(), |problem| {
        let system = SpringMass { h: single(&problem.system.h), ..problem.system.clone() };
        let Answer { deflection, contact_force, .. } = right(&Problem { system, ..problem.clone() });
        let [u, n] = [deflection, contact_force].map(|x| number(&x.unwrap().decimal(12, Round::Nearest)));
        Answer::new(u, n)
    });
    assert_eq!(report.identified_mistake().unwrap().name, "H is rounded to single precision");
}
