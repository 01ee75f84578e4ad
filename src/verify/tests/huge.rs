//! Runs with more cases than there is time for.

use super::*;
use std::panic::resume_unwind;

/// Ends at the first sign of progress.
#[test]
fn the_number_of_pieces_of_work_does_not_overflow() {
    let checkers = [(NumberSystem::F32, checks(NumberSystem::F32))];
    let stop = |_, all: usize| resume_unwind(Box::new(all.to_string()));
    let stopped = catch_panic(|| run(&checkers, Vec::new(), &options(u64::MAX), &stop));
    assert_eq!(stopped.err(), Some(usize::MAX.to_string()));
}
