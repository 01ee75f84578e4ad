//! A bound on the effort of a proof.
//!
//! The size of a polynomial cannot be foretold from the formula that it is read from. So arithmetic counts
//! the terms that it handles, and above [`MAX_EFFORT`] it unwinds to where the count began: nothing is
//! concluded from what was computed until then.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// The number of terms that arithmetic handles in one proof, at most; a coefficient of n words counts like
/// n/8 terms.
pub const MAX_EFFORT: usize = 5_000_000;

struct Exceeded;

thread_local! {
    /// The number of terms that may still be handled.
    static REST: Cell<usize> = const { Cell::new(usize::MAX) };
}

/// The value of `f`, or `None` if its arithmetic handles more than [`MAX_EFFORT`] terms.
pub fn bounded<T>(f: impl FnOnce() -> T) -> Option<T> {
    let before = REST.replace(MAX_EFFORT);
    let value = catch_unwind(AssertUnwindSafe(f));
    REST.set(before);
    match value {
        Ok(value) => Some(value),
        Err(exceeded) if exceeded.is::<Exceeded>() => None,
        Err(panic) => resume_unwind(panic),
    }
}

/// Counts terms that are about to be handled.
pub fn spend(terms: usize) {
    match REST.get().checked_sub(terms) {
        Some(rest) => REST.set(rest),
        None => exceed(),
    }
}

/// Unwinds to where the count began.
pub fn exceed() -> ! {
    resume_unwind(Box::new(Exceeded))
}
