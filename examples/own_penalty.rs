//! User-defined penalty functionals: W is written once, as a generic function, and passed to the solver.
//!
//! Its force W′ is not needed: dual numbers differentiate W and bound its rounding error. Prints for the
//! example system with R = 2 N and a spring of 4 N/m
//!
//! ```text
//! cubic, ε = 1e0: N = 0.202041 N, p = 4.494897e-1 m to 4.494897e-1 m
//! cubic, ε = 1e4: N = 1.944226 N, p = 1.394355e-2 m to 1.394355e-2 m
//! cubic, ε = 1e8: N = 1.999434 N, p = 1.414014e-4 m to 1.414014e-4 m
//! layered: N = 1.599400 N, p = 0.100150 m
//! cubic, ε = 2.306e18: p < 9.3e-10 m
//! the penalty functional must be convex in p: its force must not decrease with p; violated at p = 0.03125000000000006 m
//! ```

use spring_mass_contact::chapter::{SpringMass, penalty};
use spring_mass_contact::number::PositivePart;
use spring_mass_contact::solver::{FunctionalError, penalty_for_functional, solve_functional};

/// W = ε |p|³ / 3: the force grows with the square of the penetration; ε in N/m².
fn cubic<T: PositivePart>(eps: &T, p: &T) -> T {
    eps * p * p * p.abs() / T::int(3)
}

/// A soft layer of thickness `d` on a stiff base: two springs, the second of which acts from p = d.
fn layered<T: PositivePart>(soft: &T, stiff: &T, d: &T, p: &T) -> T {
    penalty::functional(soft, p) + penalty::functional(stiff, &(p - d).positive_part())
}

fn main() -> Result<(), FunctionalError> {
    let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    for eps in [1e0, 1e4, 1e8] {
        let answer = solve_functional(&system, &[eps], &1e-14, |[eps], p| cubic(eps, p))?;
        let p = &answer.bounds.penetration;
        println!(
            "cubic, ε = {eps:.0e}: N = {:.6} N, p = {:.6e} m to {:.6e} m",
            answer.contact_force, p.lower, p.upper
        );
    }
    let layer = [1.0, 1e4, 0.1];
    let answer = solve_functional(&system, &layer, &1e-14, |[soft, stiff, d], p| layered(soft, stiff, d, p))?;
    println!("layered: N = {:.6} N, p = {:.6} m", answer.contact_force, answer.penetration);

    // The ε that guarantees a penetration below a micrometre.
    let eps = penalty_for_functional(&system, &[1.0], &1e-6, |[eps], p| cubic(eps, p))?;
    let answer = solve_functional(&system, &[eps], &1e-14, |[eps], p| cubic(eps, p))?;
    println!("cubic, ε = {eps:.3e}: p < {:.1e} m", answer.bounds.penetration.upper);

    // The error names the violated condition.
    let softening = solve_functional(&system, &[1.0], &1e-14, |[eps], p| eps * p / (eps + p));
    println!("{}", softening.unwrap_err());
    Ok(())
}
