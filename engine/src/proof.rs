//! Proofs of claims, for *all* values of their parameters.
//!
//! **What has to be trusted.**
//!
//! - That the claims say what is meant, hypotheses included, in the words of
//!   [`claim`](crate::formula::claim).
//! - That [`Tree`](crate::number::Tree) records what functions do (tested, bit for bit, in every number
//!   system), and that [`Dual`](crate::number::Dual) differentiates.
//! - In [`statement`](crate::formula::statement) and `sequence.rs`, the goals of a claim of each kind. It is
//!   these that are proved, under the hypotheses; only the constructors of [`claim`](crate::formula::claim)
//!   make a [`Statement`](crate::formula::Statement), so its goals are those of what it prints.
//! - The kernel, which is `kernel.rs` with `kernel/` in `src/proof`: in `algebra.rs` and `monomial.rs` the
//!   arithmetic of polynomials, in `number.rs` that of their coefficients, in `sign.rs` six rules for signs,
//!   in `order.rs` that rounding keeps order, in `reader.rs` and `context.rs` the reading of formulas and
//!   hypotheses, in `kernel.rs` the rules for goals. Nothing else can make a proof, and no one can change
//!   one. `search.rs`, which finds certificates for signs, is not trusted: only the rules make them.
//! - That [`paper`] prints what was proved, in the names of a [`Registry`](crate::formula::Registry); the
//!   compiler, and GMP's rational numbers.
//! - The model of rounding: without under- and overflow, what floats of p ≥ 2 bits make of a result x is
//!   x (1 + γ e) for some −1 ≤ e ≤ 1, where γ = 1/(2ᵖ + 1). `kernel.rs` derives it from rounding to nearest,
//!   which is what machines and MPFR are trusted to do; and to round alike what is alike.
//! - This lemma, which claims about limits of sequences rest on:
//!
//!   > If |ρ| < 1 then ρᵏ → 0. *Proof.* For ρ ≠ 0 write 1/|ρ| = 1 + x with x > 0. By Bernoulli's inequality
//!   > (1 + x)ᵏ ≥ 1 + k x, so |ρ|ᵏ ≤ 1/(1 + k x), which is below any bound once k is large enough. □ So if
//!   > f is continuous at 0, as a quotient of polynomials is where its denominator is not 0, f(ρᵏ) → f(0).
//!
//! Most of that need not be taken on trust: [`coq`] writes the same claims for the proof assistant Coq,
//! whose kernel checks them anew, and what numbers [`refute`](mod@refute) must not be proved here (tested).
//! What floats make of a formula is proved as well, for every precision. What is claimed of the solver in
//! floats, of its promises and counts, is tried as experiments, and not proved.

mod bounds;
pub mod controls;
pub mod coq;
mod hints;
mod kernel;
pub mod paper;
pub mod refute;
mod search;

pub use bounds::{NoBound, RoundingBound, rounding_bound};
pub use controls::{Controls, controls};
pub use hints::sufficient;
pub use kernel::{MAX_DEPTH, MAX_EFFORT, MAX_SIZE, Proof, Why, prove};
pub use refute::{Counterexample, Refutation, refute, sharpest};
