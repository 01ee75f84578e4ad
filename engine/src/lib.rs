//! Formulas that are written once, as functions generic over their number system, and read by everything
//! else.
//!
//! | module | what is in it | needs |
//! |---|---|---|
//! | [`number`] | the number systems and the few traits a formula asks for; records and their programs | |
#![cfg_attr(
    feature = "prover",
    doc = "\
| [`formula`] | records as data: typeset, and what is said of them | `number` |
| [`proof`] | proves what is claimed of formulas, refutes what is wrong, prints both | `number`, `formula` |"
)]
//!
//! ```
//! use provable::number::{Ball, Dual, Field};
//!
//! /// Where a lens of the focal length f shows what is g away.
//! fn image<T: Field>(f: &T, g: &T) -> T {
//!     f * g / (g - f)
//! }
//!
//! assert_eq!(image(&2.0, &4.0), 4.0);
//! // It moves as fast as the thing does, where both are as far.
//! assert_eq!(image(&Dual::constant(2.0), &Dual::variable(4.0)).derivative, -1.0);
//! // 1/3 is not a float; the ball contains the exact result all the same.
//! let third = Ball::exactly(1.0) / Ball::exactly(3.0);
//! assert!(image(&third, &Ball::exactly(1.0)).is_finite());
//! ```
//!
//! # Features
//!
//! - `mpfr`: MPFR floats, exact rationals, reading numbers. Builds GMP and MPFR from source by way of rug,
//!   which is LGPL-3.0-or-later.
//! - `prover` (default): the modules `formula` and `proof`. What it opens may change with any minor version.
//! - `serde`: numbers are serialised as texts, so that nothing is lost.
//! - `gmp-untested` (default): leaves out GMP's and MPFR's own test suites, which take minutes.

// The docs speak of all numbers, also of those that are not there.
#![cfg_attr(not(feature = "mpfr"), allow(rustdoc::broken_intra_doc_links))]

#[cfg(feature = "prover")]
pub mod formula;
pub mod number;
#[cfg(feature = "prover")]
pub mod proof;

#[cfg(feature = "mpfr")]
pub use rug;

#[cfg(all(doctest, feature = "prover"))]
#[doc = include_str!("../README.md")]
mod readme {}
