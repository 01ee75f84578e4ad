//! Formulas written once, as functions generic over their number system, and evaluated, recorded, typeset and
//! proved from that one source.
//!
//! | module | contents | requires |
//! |---|---|---|
//! | [`number`] | number systems, the traits that formulas require; recorded formulas, programs | |
#![cfg_attr(
    feature = "prover",
    doc = "\
| [`formula`] | recorded formulas as data: typesetting, hypotheses and statements | `number` |
| [`eval`] | what statements mean for numbers | `number`, `formula` |
| [`proof`] | proofs and refutations of statements, in print and for Coq | `number`, `formula`, `eval` |"
)]
//!
//! ```
//! use provable::number::{Ball, Dual, Field};
//!
//! /// Image distance of a lens of focal length f for the object distance g.
//! fn image<T: Field>(f: &T, g: &T) -> T {
//!     f * g / (g - f)
//! }
//!
//! assert_eq!(image(&2.0, &4.0), 4.0);
//! // At equal distances the image moves as fast as the object.
//! assert_eq!(image(&Dual::constant(2.0), &Dual::variable(4.0)).derivative, -1.0);
//! // 1/3 is not a float; the ball still contains the exact result.
//! let third = Ball::point(1.0) / Ball::point(3.0);
//! assert!(image(&third, &Ball::point(1.0)).is_finite());
//! ```
//! # Features
//! - `mpfr`: MPFR floats, exact rationals and parsing of numbers. Builds GMP and MPFR from source through
//!   rug, which is LGPL-3.0-or-later.
//! - `prover` (default): the modules `formula`, `eval` and `proof`. Their API may change with any minor version.
//! - `serde`: serialises rationals and MPFR numbers as texts, so that no digit is lost.
//! - `gmp-untested` (default): omits the test suites of GMP and MPFR, which take minutes.

// The documentation also links to numbers that a build without `mpfr` lacks.
#![cfg_attr(not(feature = "mpfr"), allow(rustdoc::broken_intra_doc_links))]

#[cfg(feature = "prover")]
pub mod eval;
#[cfg(feature = "prover")]
pub mod formula;
pub mod number;
#[cfg(feature = "prover")]
pub mod proof;

/// Traits that a number system implements: `Zero` and `One`.
pub use num_traits;
#[cfg(feature = "mpfr")]
pub use rug;

#[cfg(all(doctest, feature = "prover"))]
#[doc = include_str!("../README.md")]
mod readme {}
