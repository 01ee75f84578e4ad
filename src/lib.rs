//! A mass hangs on a spring over a rigid plane: find its deflection and the contact force under the
//! condition that it must not go through the plane. By Lagrange multiplier, by penalty, by augmented
//! Lagrangian.
//!
//! That is chapter 1 of A. Konyukhov and R. Izi, *Introduction to Computational Contact Mechanics: A
//! Geometrical Approach* (Wiley 2015), as a crate in which **every equation is written once, as a
//! function generic over its number system, and everything else reads that function**.
//!
//! | module | what is in it | who reads it |
//! |---|---|---|
//! | [`number`] | the number systems and the few traits a formula asks for | everything below |
//! | [`chapter`] | the equations, a module a section, a function a formula | everything below |
//! | [`solver`] | [`solve`](solver::solve), the augmentation as an iterator, bounds; and advice | users |
#![cfg_attr(
    feature = "prover",
    doc = "\
| [`formula`] | records as data: typeset, and what is said of them | `proof`, `claims` |
| [`proof`] | proves what is claimed of formulas, refutes what is wrong, prints both | `verify`, `contact` |
| [`claims`](mod@claims) | the chapter as data, and what is claimed of it | `verify`, `check` |
| [`verify`](mod@verify) | runs proofs and number systems | the command `contact` |
| [`check`](mod@check) | holds somebody else's solver against the exact answer | the command `contact` |"
)]
//!
//! The first three are what a user needs, and keep their promises by semantic versioning. The others are
//! open with the feature `prover`, and what they open may change with any minor version.
//!
//! `number`, `formula` and `proof` are those of [`provable`], an engine that knows no mechanics, and serves
//! any other formulas as well; `chapter` and `solver` are the mechanics, and know no proofs; `claims` joins
//! them. A test holds every module to that.
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
//!
//! To find an equation, say (1.16): the number opens the doc comment of its functions in [`chapter`], stands
//! beside its statement among the entries in `claims`, and beside each of its claims. On the command line,
//! `contact equations 1.16` names the functions and the claims, `contact prove 1.16` prints their proofs, and
//! `contact verify 1.16` runs them.
//!
//! # Features
//!
//! - `mpfr` (default): MPFR floats, exact rationals, and all that needs them: certificates, step counts,
//!   advice, reading numbers. Builds GMP and MPFR from source by way of rug, which is LGPL-3.0-or-later.
//! - `prover`: the modules `formula`, `proof`, `claims`, `verify` and `check`.
//! - `serde`: what the solver and the runs of claims return is `serde::Serialize`, quantities as texts.
//! - `gmp-untested` (default): leaves out GMP's and MPFR's own test suites, which take minutes.
//!
//! Without them f32, f64, balls, dual numbers, the chapter and the solver are there; eˣ of a float is not.
//!
//! The command `contact` is a package of its own, `spring-mass-contact-cli`.

// The docs speak of all numbers, also of those that are not there.
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

#[cfg(feature = "mpfr")]
#[doc(no_inline)]
pub use provable::rug;

#[cfg(feature = "prover")]
#[doc(inline)]
pub use provable::{formula, proof};

#[cfg(all(doctest, feature = "mpfr"))]
#[doc = include_str!("../README.md")]
mod readme {}
