//! A mass hangs on a spring over a rigid plane: find its deflection and the contact force under the
//! condition that it must not go through the plane. By Lagrange multiplier, by penalty, by augmented
//! Lagrangian.
//!
//! That is chapter 1 of A. Konyukhov and R. Izi, *Introduction to Computational Contact Mechanics: A
//! Geometrical Approach* (Wiley 2015), as a crate in which **every equation is written once, as a
//! function generic over its number system, and everything else reads that function**.
//!
//! | module | contents | readers |
//! |---|---|---|
//! | [`number`] | the number systems and the few traits a formula asks for | everything below |
//! | [`chapter`] | the equations, a module a section, a function a formula | everything below |
//! | [`solver`] | [`solve`](solver::solve), the augmentation as an iterator, bounds; and advice | users |
#![cfg_attr(
    feature = "prover",
    doc = "\
| [`formula`] | recorded formulas as data: typesetting, hypotheses, statements | `proof`, `claims` |
| [`eval`] | what statements mean for numbers, exact, enclosed or rounded | `proof`, `verify` |
| [`proof`] | proofs and refutations of statements, in print and for Coq | `verify`, `contact` |
| [`claims`](mod@claims) | the chapter as data: equations with claims | `verify`, `check` |
| [`verify`](mod@verify) | proofs and checks in number systems | the command `contact` |
| [`check`](mod@check) | comparison of an external solver with exact solutions | the command `contact` |"
)]
//! `number`, `chapter` and `solver` are the public API and follow semantic versioning. The feature `prover`
//! opens the other modules, whose API may change with any minor version.
//!
//! `number`, `formula`, `eval` and `proof` are those of [`provable`], an engine that is independent of mechanics and
//! serves other formulas as well. `chapter` and `solver` are the mechanics and do not depend on proofs;
//! `claims` connects the two. A test checks the dependencies of every module.
//!
//! ```
//! use spring_mass_contact::chapter::SpringMass;
//! use spring_mass_contact::solver::{Method, State, solve};
//!
//! // c in N/m, m in kg, g in m/s², l and H in m; any number system will do.
//! let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
//! let answer = solve(&system, &Method::Lagrange)?;
//! assert_eq!((answer.state, answer.deflection, answer.contact_force), (State::Contact, 2.0, 2.0));
//! assert!(answer.bounds.contact_force.contains(&2.0)); // where the exact answer is for certain
//! # Ok::<(), spring_mass_contact::solver::SolveError>(())
//! ```
//! To find an equation, for example (1.16): its number begins the doc comments of its functions in
//! [`chapter`], and names its entry and its claims in `claims`. On the command line, `contact equations 1.16`
//! prints the lines of the functions and of the entry, and names the claims; `contact prove 1.16` prints their
//! proofs, and `contact verify 1.16` checks them.
//!
//! # Features
//! - `mpfr` (default): MPFR floats, exact rationals, and all that needs them: certificates, step counts,
//!   advice and parsing. Builds GMP and MPFR from source through rug, which is LGPL-3.0-or-later.
//! - `half`: f16 and bf16 of the crate `half`, also as number systems of `verify`.
//! - `prover`: the modules `formula`, `eval`, `proof`, `claims`, `verify` and `check`.
//! - `serde`: implements `serde::Serialize` for the results of the solver and of checks, with rationals and MPFR
//!   numbers as texts.
//! - `gmp-untested` (default): omits the test suites of GMP and MPFR, which take minutes.
//!
//! f32, f64, balls, dual numbers, the chapter and the solver need none of these features; only eˣ of floats
//! needs `mpfr`.
//!
//! The command `contact` is a separate package, `spring-mass-contact-cli`.

// The documentation also links to numbers that a build without `mpfr` lacks.
#![cfg_attr(not(feature = "mpfr"), allow(rustdoc::broken_intra_doc_links))]

pub mod chapter;
#[cfg(feature = "prover")]
pub mod check;
#[cfg(feature = "prover")]
pub mod claims;
pub mod solver;
#[cfg(feature = "prover")]
pub mod verify;

#[doc(inline)]
pub use provable::{number, operators};

#[doc(no_inline)]
pub use provable::num_traits;

#[cfg(feature = "half")]
#[doc(no_inline)]
pub use half;

#[cfg(feature = "mpfr")]
#[doc(no_inline)]
pub use provable::rug;

#[cfg(feature = "prover")]
#[doc(inline)]
pub use provable::{eval, formula, proof};

#[cfg(all(doctest, feature = "mpfr"))]
#[doc = include_str!("../README.md")]
mod readme {}
