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
#[cfg(feature = "mpfr")]
mod brief;
mod dual;
#[cfg(feature = "mpfr")]
mod exact;
pub mod field;
#[cfg(feature = "mpfr")]
mod functions;
#[cfg(feature = "mpfr")]
mod mpfr;
#[cfg(feature = "mpfr")]
mod parse;
#[cfg(feature = "mpfr")]
mod scientific;
#[cfg(feature = "mpfr")]
mod system;
#[cfg(feature = "mpfr")]
mod text;
pub mod tree;

pub use ball::Ball;
#[cfg(feature = "mpfr")]
pub use brief::{brief, brief_bound, relation};
pub use dual::Dual;
#[cfg(feature = "mpfr")]
pub use exact::{Exact, Inexact, ToExact};
pub use field::{Exponential, Field, Logarithm, OrderedField, PositivePart, Real};
#[cfg(feature = "mpfr")]
pub use mpfr::{Mpfr, PRECISIONS};
#[cfg(feature = "mpfr")]
pub use parse::{MAX_EXPONENT, ParseError, RangeError};
#[cfg(feature = "mpfr")]
pub use system::{NumberSystem, UnknownNumberSystem};
#[cfg(feature = "mpfr")]
pub use text::Text;
#[cfg(feature = "serde")]
pub(crate) use text::{lossless, quantity, serialize_as_displayed};
pub use tree::Tree;
