//! Number systems: what a formula can be read in.
//!
//! | number | what it is | when to use it |
//! |---|---|---|
//! | `f32`, `f64` | the machine's floats | to compute |
#![cfg_attr(
    feature = "mpfr",
    doc = "| [`Mpfr`] | a float of 2 to 1 000 000 bits, chosen at run time | to compute to more digits |"
)]
#![cfg_attr(feature = "mpfr", doc = "| [`Exact`] | a rational number | to know; the oracle of every test |")]
//! | [`Ball<T>`] | a float and a bound of its error | to know how far a float is off |
//! | [`Dual<T>`] | a value and its derivative, over any of the others | to differentiate a formula |
//! | [`Tree`] | the formula itself, step by step | to prove it, print it, change it |
//!
//! The traits they share, and how to add a number system of your own: [`field`].

mod ball;
mod dual;
pub mod field;
#[cfg(feature = "mpfr")]
mod gmp;
mod program;
pub mod tree;

pub use ball::Ball;
pub use dual::Dual;
pub use field::{Exponential, Field, Logarithm, OrderedField, PositivePart, Real};
#[cfg(feature = "mpfr")]
pub use gmp::*;
pub use program::{Program, Rounds};
pub use tree::{Tree, symbols};

#[cfg(feature = "serde")]
#[doc(hidden)]
pub use crate::serialize_as_displayed;
