//! Runs with more cases than there is time for.

use super::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Ends at the first sign of progress.
#[test]
fn the_number_of_pieces_of_work_does_not_overflow() {
    let checkers = [(NumberSystem::F32, checks(NumberSystem::F32))];
    let stop = |_, all: usize| resume_unwind(Box::new(all));
    let stopped = catch_unwind(AssertUnwindSafe(|| run(&checkers, Vec::new(), &options(u64::MAX), &stop)));
    assert_eq!(stopped.unwrap_err().downcast_ref(), Some(&usize::MAX));
}
