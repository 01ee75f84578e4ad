//! A study of one's own: the contact force of many systems, on all cores.
//!
//! The formulas are functions on plain numbers, so a loop over them is a loop over numbers: for ten million
//! systems the time goes to memory and to adding up. Where a result needs its state and its bounds, `solve`
//! gives them, at some tens of nanoseconds each.

use rayon::prelude::*;
use spring_mass_contact::chapter::{SpringMass, contact};
use spring_mass_contact::solver::{Method, SolveError, State, solve};
use std::time::Instant;

/// The plane at `i` of a million heights, from where the mass hangs free to where it is well compressed.
fn system(i: u32) -> SpringMass<f64> {
    SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.2 - f64::from(i) * 2e-8 }
}

fn main() -> Result<(), SolveError> {
    let many = 10_000_000;
    let start = Instant::now();
    let forces: f64 = (0..many).into_par_iter().map(|i| contact::contact_force(&system(i))).sum();
    println!(
        "{many} contact forces, {:.4} N on average, in {:.0?}",
        forces / f64::from(many),
        start.elapsed()
    );

    // With the state decided exactly and the force enclosed: how wide is the widest bound?
    let few = many / 10;
    let start = Instant::now();
    let solved = (0..few).into_par_iter().map(|i| {
        let solution = solve(&system(10 * i), &Method::Lagrange)?;
        let force = solution.bounds.contact_force;
        Ok((u32::from(solution.state == State::Contact), force.upper - force.lower))
    });
    let (touching, widest) =
        solved.try_reduce(|| (0, 0.0), |(n, w), (also, width)| Ok((n + also, f64::max(w, width))))?;
    println!(
        "{few} of them solved: {touching} in contact, no bound wider than {widest:.1e} N, in {:.0?}",
        start.elapsed()
    );
    Ok(())
}
