//! Bounds on the size of a statement, and on the effort of its proof.
//!
//! The size of a polynomial cannot be predicted from the formula. So arithmetic counts the terms that it processes.

use crate::number::Tree;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Maximum number of terms that arithmetic processes in the check of a goal, and in the search for its proof.
pub const MAX_EFFORT: usize = 20_000_000;

/// Maximum number of operations, quantities and numbers in all formulas of a statement.
pub const MAX_SIZE: u32 = 20_000;

/// Maximum depth of a formula in a statement.
pub const MAX_DEPTH: u32 = 500;

/// Returns the quantity of formulas that exceeds its maximum, and the maximum; `None` if none does.
pub fn excess_size<'t>(trees: impl Iterator<Item = &'t Tree> + Clone) -> Option<(&'static str, usize)> {
    if trees.clone().any(|tree| tree.depth() > MAX_DEPTH) {
        return Some(("its depth", MAX_DEPTH as usize));
    }
    let size = trees.fold(0, |sum: u32, tree| sum.saturating_add(tree.size()));
    (size > MAX_SIZE).then_some(("its size", MAX_SIZE as usize))
}

/// The number of terms that may still be processed, shared by all parts of one proof.
#[derive(Clone, Debug)]
pub struct Effort(Arc<AtomicUsize>);

impl Default for Effort {
    fn default() -> Self {
        Effort(Arc::new(AtomicUsize::new(MAX_EFFORT)))
    }
}

impl Effort {
    /// Counts terms that are about to be processed. Returns `None`, now and from then on, if there are too many.
    pub fn spend(&self, terms: usize) -> Option<()> {
        let left = self.0.load(Ordering::Relaxed).checked_sub(terms);
        self.0.store(left.unwrap_or(0), Ordering::Relaxed);
        left.filter(|left| *left > 0).map(|_| ())
    }

    /// Returns `true` if too many terms were processed.
    pub fn is_exceeded(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effort_is_shared_and_ends_for_good() {
        let effort = Effort::default();
        let shared = effort.clone();
        assert!(effort.spend(MAX_EFFORT - 2).is_some() && shared.spend(1).is_some() && !effort.is_exceeded());
        assert!(shared.spend(1).is_none() && effort.spend(0).is_none() && effort.is_exceeded());
        assert!(Effort::default().spend(1).is_some());
    }
}
