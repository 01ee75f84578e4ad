//! Number systems.
//!
//! | number | meaning | purpose |
//! |---|---|---|
//! | `f32`, `f64` | machine floats | computation |
//! | [`Native<T>`] | any other float of num-traits, such as `half::f16` | computation |
#![cfg_attr(
    feature = "mpfr",
    doc = "| [`Mpfr`] | a float of 2 to 1 000 000 bits, chosen at run time | high precision |"
)]
#![cfg_attr(
    feature = "mpfr",
    doc = "| [`Exact`] | a rational number | exact results, the reference of every test |"
)]
//! | [`Ball<T>`] | a float with an error bound | rounding errors |
//! | [`Dual<T>`] | a value with its derivative, over any other number system | differentiation |
//! | [`Tree`] | the recorded formula | proofs, printing, mutation |
//!
//! The module [`field`] contains their traits and explains how to add a number system.

mod ball;
mod dual;
pub mod field;
#[cfg(feature = "mpfr")]
mod gmp;
mod native;
mod program;
pub mod tree;

pub use ball::Ball;
pub use dual::Dual;
pub use field::{Exponential, Field, Logarithm, OrderedField, PositivePart, Real};
#[cfg(feature = "mpfr")]
pub use gmp::*;
pub use native::Native;
pub use program::{Program, SpecializedProgram};
pub use tree::{Tree, symbols};

#[cfg(feature = "serde")]
#[doc(hidden)]
pub use crate::serialize_as_displayed;
