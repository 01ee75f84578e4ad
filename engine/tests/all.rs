//! All tests of the engine, in one binary.

#[cfg(feature = "prover")]
mod false_claims;
#[cfg(feature = "mpfr")]
mod numbers;
#[cfg(feature = "prover")]
mod shapes;
