//! One system by each of the three methods, with its results. Prints
//!
//! ```text
//! u = 0.050000000000000 m, N = 4.81000000000000 N, at once
//!     N is between 4.8099999999999925 and 4.81
//! u = 0.050476237623762 m, N = 4.76237623762376 N, at once
//!     N is between 4.762376237623753 and 4.762376237623764
//! u = 0.050000000000045 m, N = 4.80999999999546 N, after 5 augmentations
//!     N is between 4.8099999999999925 and 4.81
//! stiffness -100.0: must be greater than 0 and finite
//! ```

use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::solver::{Method, Outcome, SolveError, State, solve};

fn main() -> Result<(), SolveError> {
    // SI units: N/m, kg, m/s², m, m.
    let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    let methods = [
        Method::Lagrange,
        Method::Penalty { penalty: 1e4 },
        Method::Augmented { penalty: 1e4, tolerance: 1e-12, max_augmentations: 100, start: 0.0 },
    ];
    for method in methods {
        // An error names the invalid argument.
        let answer = solve(&system, &method)?;
        let how = match answer.outcome {
            Outcome::Direct => "at once".to_string(),
            Outcome::Converged => format!("after {} augmentations", answer.augmentations.unwrap_or(0)),
            // The result is still valid; `floor` and the bounds tell its accuracy.
            Outcome::Stagnated | Outcome::IterationLimit => "not to the tolerance".to_string(),
        };
        println!("u = {:.15} m, N = {:.14} N, {how}", answer.deflection, answer.contact_force);
        // Encloses the exact solution of the method, or the limit of an iteration.
        let force = &answer.bounds.contact_force;
        println!("    N is between {} and {}", force.lower, force.upper);
        assert_eq!(answer.state, State::Contact);
    }
    let error = solve(&SpringMass { c: -100.0, ..system }, &Method::Lagrange).unwrap_err();
    println!("{error}");
    Ok(())
}
