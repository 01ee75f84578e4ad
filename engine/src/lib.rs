//! Formulas that are written once, as functions generic over their number system, and read by everything else.

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
