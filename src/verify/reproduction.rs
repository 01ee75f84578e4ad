//! Counterexamples that `contact solve` reproduces.

use super::catch_panic::catch_panic;
use crate::chapter::SpringMass;
use crate::claims::Var;
use crate::number::Exact;
use crate::proof::refute::Point;
use crate::solver::{Method, Solution, solve};
use num_traits::Zero;

/// Returns the system of a counterexample and the method that solves it wrongly in rationals: by penalty if ε
/// is given, otherwise by Lagrange multiplier.
///
/// Returns `None` if the point has other quantities than the parameters of a system and ε, if there is no
/// such system, or if its solution is consistent. A solve that panics is wrong.
pub fn reproduction(point: &Point) -> Option<(SpringMass<Exact>, Method<Exact>)> {
    let (system, method) = problem(point)?;
    let wrong = match catch_panic(|| Some(is_inconsistent(&solve(&system, &method).ok()?, &system, &method)))
    {
        Ok(inconsistent) => inconsistent?,
        Err(_) => true,
    };
    wrong.then_some((system, method))
}

/// Returns the system and the method of a point that has no other quantities.
fn problem(point: &Point) -> Option<(SpringMass<Exact>, Method<Exact>)> {
    let parameters = [Var::C, Var::M, Var::G, Var::L, Var::H].map(Var::symbol);
    let penalty = Var::Eps.symbol();
    let mut method = Method::Lagrange;
    for (symbol, x) in point.coordinates() {
        if symbol == penalty {
            method = Method::Penalty { penalty: x.clone() };
        } else if !parameters.contains(&symbol) {
            return None;
        }
    }
    let [c, m, g, l, h] = parameters.map(|symbol| point.at(symbol));
    Some((SpringMass { c, m, g, l, h }, method))
}

/// Returns `true` if an exact solution violates its own bounds, equilibrium, or a contact condition that its
/// method enforces. The penalty method lets the mass penetrate.
fn is_inconsistent(solution: &Solution<Exact>, system: &SpringMass<Exact>, method: &Method<Exact>) -> bool {
    let Ok(residuals) = solution.certificate(system) else { return true };
    let bounds = &solution.bounds;
    let outside = !bounds.deflection.contains(&solution.deflection)
        || !bounds.penetration.contains(&solution.penetration)
        || !bounds.contact_force.contains(&solution.contact_force);
    outside
        || match method {
            Method::Penalty { .. } => !residuals.stationarity.is_zero() || !residuals.dual.is_zero(),
            Method::Lagrange | Method::Augmented { .. } => !residuals.is_zero(),
        }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_traits::One;

    fn point(symbols: &[&'static str], number: &Exact) -> Point {
        Point::new(symbols.iter().map(|symbol| (*symbol, number.clone())))
    }

    #[test]
    fn right_formulas_reproduce_nothing() {
        for number in ["1", "1/3", "-2", "0"].map(|text| text.parse().unwrap()) {
            for symbols in
                [&["c", "m", "g", "l", "H"][..], &["c", "m", "g", "l", "H", "ε"], &["H"], &["g", "u"], &[]]
            {
                assert_eq!(reproduction(&point(symbols, &number)), None, "{symbols:?} = {number}");
            }
        }
    }

    #[test]
    fn a_penalty_decides_the_method() {
        let three = Exact::from(3);
        let method = |symbols: &[&'static str]| problem(&point(symbols, &three)).map(|(_, method)| method);
        assert_eq!(method(&["c", "H"]), Some(Method::Lagrange));
        assert_eq!(method(&["c", "ε", "H"]), Some(Method::Penalty { penalty: three.clone() }));
        assert_eq!(method(&["c", "ε", "u"]), None);
    }

    /// Each result in turn is off by 1: in contact (R = 2), where the penalty method has p = 1/4, and
    /// separated.
    #[test]
    fn a_wrong_result_is_inconsistent() {
        let numbers = |h: i32| [4, 1, 10, 1, h].map(Exact::from);
        for (h, penetration) in [(3, "1/4"), (4, "-1/2")] {
            let [c, m, g, l, h] = numbers(h);
            let system = SpringMass { c, m, g, l, h };
            for method in [Method::Lagrange, Method::Penalty { penalty: Exact::from(4) }] {
                let right = solve(&system, &method).unwrap();
                if matches!(method, Method::Penalty { .. }) {
                    assert_eq!(right.penetration.to_string(), penetration);
                }
                assert!(!is_inconsistent(&right, &system, &method), "{right:?}");
                let off = |x: &Exact| x + Exact::one();
                let mut deflection = right.clone();
                deflection.deflection = off(&right.deflection);
                deflection.bounds.deflection.upper = off(&right.bounds.deflection.upper);
                let mut penetration = right.clone();
                penetration.penetration = off(&right.penetration);
                let mut force = right.clone();
                force.contact_force = off(&right.contact_force);
                force.bounds.contact_force.upper = off(&right.bounds.contact_force.upper);
                for wrong in [deflection, penetration, force] {
                    assert!(is_inconsistent(&wrong, &system, &method), "{wrong:?}");
                }
            }
        }
    }
}
