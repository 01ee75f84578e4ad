//! The meaning of statements for numbers: one evaluator for all that computes with them.
//!
//! A statement is unfolded into the propositions that it makes about numbers, which are compiled once and
//! evaluated in any [`Domain`]: rationals, which decide every sign; balls over any scalar, which enclose;
//! and floats that round each result. Refutations, mutations, dropped hypotheses, checks in number systems
//! and trials of laws of rounding are evaluations of it.

mod computed;
mod domain;
mod evaluation;
mod germ;
mod hypothesis;
mod sample;
mod shrink;
#[cfg(test)]
mod tests;

pub use computed::{Floats, RoundedRationals};
pub use domain::{Balls, Decidable, Domain, Rationals, Value};
pub use evaluation::{
    Compiled, Evaluation, Failure, Instance, Test, UNFOLDED_MEMBERS, Verdict, independent_symbols, instances,
    premises, verdict_at,
};
pub use sample::{Point, constructed_points, first_integer_points, integer_points};
pub use shrink::Counterexample;
pub(crate) use shrink::{shrink, with_divisor_zero};
