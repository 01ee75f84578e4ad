//! Properties for arbitrary bytes: texts as numbers, answers of a program, and proofs with changes. Each function
//! derives its arguments from the bytes and panics if a property is violated. Random bytes test them in `tests`, and a
//! coverage-guided fuzzer in the directory above.

mod bytes;

mod numbers;
mod proofs;
mod replies;

pub use numbers::parse;
pub use proofs::prove_nothing;
pub use replies::read;
