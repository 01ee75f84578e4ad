//! Properties of the solver on sampled systems, in one crate so that the strategies are compiled once.
#![cfg(feature = "mpfr")]

#[path = "../strategies/mod.rs"]
mod strategies;

mod advice;
mod augmentation_monotone;
mod closed_form;
mod functionals;
mod invariances;
mod kkt;
mod laws;
mod penalty_limit;
mod planted;
mod results;
#[cfg(feature = "serde")]
mod serialised;
mod shown;
mod sweep;
