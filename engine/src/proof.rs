//! Proofs of claims for *all* values of their parameters.
//!
//! # The trusted base
//!
//! - The claims and their hypotheses state what is meant; they are built by the constructors of
//!   [`claim`](crate::formula::claim).
//! - [`Tree`](crate::number::Tree) records what functions compute (tested, bit for bit, in every number
//!   system), and [`Dual`](crate::number::Dual) differentiates correctly.
//! - [`statement`](crate::formula::statement), `hypothesis.rs`, `proposition.rs` and `sequence.rs` define the
//!   goals of each kind of claim, which are proved under the hypotheses. The goals of a
//!   [`Statement`](crate::formula::Statement) are derived from its contents and cannot be set, so they belong to
//!   the claim that it prints.
//! - The [checker](check) is `check.rs` with `check/` in `src/proof`. Nothing else can make a proof, and a proof
//!   cannot be changed. `search.rs` with `search/`, which finds proofs, is not trusted.
//! - [`render`] prints what was proved, with the names of a [`Registry`](crate::formula::Registry); the
//!   compiler is correct.
//! - The model of rounding: without underflow and overflow, a result x rounded to p ≥ 2 bits is x (1 + γ e)
//!   for some −1 ≤ e ≤ 1, where γ = 1/(2ᵖ + 1). [`check`](mod@check) derives it from rounding to nearest, which
//!   machines and MPFR are trusted to implement, as a function of the exact result alone; and two bounds of eˣ.
//! - Claims about limits of sequences rest on this lemma:
//!
//!   > If |ρ| < 1 then ρᵏ → 0. *Proof.* For ρ ≠ 0 write 1/|ρ| = 1 + x with x > 0. By Bernoulli's inequality
//!   > (1 + x)ᵏ ≥ 1 + k x, so |ρ|ᵏ ≤ 1/(1 + k x), which is below any bound once k is large enough. □ So if
//!   > f is continuous at 0, as a quotient of polynomials is where its denominator is not 0, f(ρᵏ) → f(0).
//!
//! Most of this can be checked independently: [`coq`] writes the same claims for the proof assistant Coq,
//! whose kernel checks them anew, and tests ensure that nothing is proved that numbers
//! [`refute`](mod@refute). For a claim that the export [omits](coq::Development::omitted), the checker stands alone:
//! a computed quantity in another claim than one bound, and sequences of several components that are perturbed or have a
//! limit. Rounding errors of formulas are proved as well, for every precision. Claims about the solver in floats, about
//! its guarantees and iteration counts, are tested by experiments, not proved.

pub mod check;
pub mod coq;
#[cfg(feature = "serde")]
pub mod data;
mod effort;
pub mod mutation;
pub mod refute;
pub mod render;
mod search;

pub use check::Proof;
pub use effort::{MAX_DEPTH, MAX_EFFORT, MAX_SIZE};
pub use mutation::{MutationReport, test_mutations};
pub use refute::{Counterexample, Refutation, refute, tightest_point};
pub use search::{ProofError, prove};
