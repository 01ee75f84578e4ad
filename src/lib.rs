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
//! | [`formula`] | records as data: typeset, compiled, and what is said of them | `proof`, `claims` |
#![cfg_attr(
    feature = "mpfr",
    doc = "| [`proof`] | proves what is claimed of formulas, refutes what is wrong, prints both | `verify` |"
)]
//! | [`chapter`] | the equations, a module a section, a function a formula | everything below |
//! | [`solver`] | [`solve`](solver::solve), the augmentation as an iterator, bounds, certificates | users |
//! | [`claims`] | the chapter as data, and what is claimed of it | `verify` |
#![cfg_attr(
    feature = "mpfr",
    doc = "| [`mod@verify`] | runs proofs and number systems | the command `contact` |"
)]
#![cfg_attr(
    feature = "mpfr",
    doc = "| [`mod@check`] | holds somebody else's solver against the exact answer | the command `contact` |"
)]
//!
//! The first three are an engine that knows no mechanics, and serves any other formulas as well; `chapter`
//! and `solver` are the mechanics, and know no proofs; `claims` joins them. A test holds every module to
//! that.
//!
//! To find an equation, say (1.16): the number opens the doc comment of its functions in [`chapter`], stands
//! beside its statement among the [`entries`](claims::entries()), and beside each of its
//! [claims](claims::claims()). On the command line, `contact equations 1.16` names the functions and the
//! claims, `contact prove 1.16` prints their proofs, and `contact verify --equation 1.16` runs them.
//!
//! # Features
//!
//! - `mpfr` (default): MPFR floats, exact rationals, and all that needs them: claims, proofs, certificates,
//!   step counts, reading numbers. Builds GMP and MPFR from source by way of rug, which is
//!   LGPL-3.0-or-later.
//! - `cli` (default): the command `contact`.
//! - `serde`, on with `cli`: what the solver and the runs of claims return is `serde::Serialize`,
//!   quantities as texts.
//! - `gmp-untested` (default): leaves out GMP's and MPFR's own test suites, which take minutes.
//!
//! Without them f32, f64, balls, dual numbers, the chapter and the solver are there; eˣ of a float is not.

pub mod chapter;
#[cfg(feature = "mpfr")]
pub mod check;
pub mod claims;
pub mod formula;
pub mod number;
#[cfg(feature = "mpfr")]
pub mod proof;
pub mod solver;
#[cfg(feature = "mpfr")]
pub mod verify;

#[cfg(feature = "mpfr")]
pub use rug;

#[cfg(all(doctest, feature = "mpfr"))]
#[doc = include_str!("../README.md")]
mod readme {}
