//! A mass hangs on a spring over a rigid plane.
//!
#![doc = include_str!("map.md")]

pub mod chapter;
pub mod claims;
pub mod number;
pub mod solver;
#[cfg(feature = "mpfr")]
pub mod verify;

#[cfg(feature = "mpfr")]
pub use rug;
