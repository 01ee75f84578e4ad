//! A thousand digits: the same functions with floats of sufficient precision. Prints
//!
//! ```text
//! converged after 3317 augmentations: N = 4.81000000000000000000000000000000000000000000000000 N
//! right to a thousand digits: true
//! foretold: 3317
//! p < 1e-1000 m from the closed form: true
//! p = 0.61803398874989484820458683436563811772030917980576 m, converged
//! ```

use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exact, PositivePart, ToExact};
use spring_mass_contact::solver::{
    Method, Plane, exact_augmentation_count, kth_iterate, solve, solve_functional,
};
use std::error::Error;

/// A thousand digits are 3322 bits; the rest is a margin for rounding.
const BITS: u32 = 3322 + 64;

fn main() -> Result<(), Box<dyn Error>> {
    // Decimals are read exactly, then rounded once.
    let exact = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse()?;
    let system = exact.map(|x| x.to_mpfr(BITS));
    let number = |text: &str| text.parse::<Exact>().map(|x| x.to_mpfr(BITS));
    let (eps, tolerance, start) = (number("100")?, number("1e-1000")?, number("0")?);

    let method = Method::Augmented {
        penalty: eps.clone(),
        tolerance: tolerance.clone(),
        max_augmentations: 10_000,
        start: start.clone(),
    };
    let answer = solve(&system, &method)?;
    let k = answer.augmentations.unwrap_or(0);
    println!("{} after {k} augmentations: N = {:.50} N", answer.outcome, answer.contact_force);
    let off = (answer.contact_force.to_exact()? - "4.81".parse::<Exact>()?).abs();
    println!("right to a thousand digits: {}", off < "1e-997".parse()?);

    // The number of steps can be predicted, and the last iterate computed directly.
    println!("foretold: {}", exact_augmentation_count(&system, &eps, &tolerance, &start, Plane::Unilateral)?);
    let step = kth_iterate(&system, &eps, &start, k, Plane::Unilateral)?;
    println!("p < 1e-1000 m from the closed form: {}", step.penetration.upper < tolerance);

    // The golden ratio by a user-defined penalty functional: R = 1, c = 1, W = p³/3, so p + p² = 1.
    let golden = SpringMass { c: "1", m: "1", g: "1", l: "1", h: "1" }.parse()?.map(|x| x.to_mpfr(BITS));
    let answer = solve_functional(&golden, &[], &tolerance, |_, p| cube(p))?;
    let p = answer.bounds.penetration;
    println!("p = {:.50} m, {}", p.lower, answer.outcome);
    Ok(())
}

fn cube<T: PositivePart>(p: &T) -> T {
    p * p * p.abs() / T::int(3)
}
