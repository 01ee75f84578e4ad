//! All tests of the library and of the whole, in one binary, so that what they share is compiled and computed once.

mod api_guarantees;

#[cfg(feature = "mpfr")]
mod derivatives;
#[cfg(feature = "mpfr")]
mod properties;
#[cfg(feature = "mpfr")]
mod small_floats;
#[cfg(feature = "mpfr")]
mod solver;
#[cfg(feature = "mpfr")]
mod strategies;

#[cfg(feature = "prover")]
mod certificates;
#[cfg(feature = "prover")]
mod consistency;
#[cfg(feature = "prover")]
mod coq;
#[cfg(feature = "prover")]
mod coqc;
#[cfg(feature = "prover")]
mod examples;
#[cfg(feature = "prover")]
mod files;
#[cfg(all(feature = "prover", feature = "serde"))]
mod forged;
#[cfg(feature = "prover")]
mod mutation;
#[cfg(feature = "prover")]
mod proofs;
#[cfg(feature = "prover")]
mod recording;
#[cfg(feature = "prover")]
mod rounding;
#[cfg(feature = "prover")]
mod typesetting;
