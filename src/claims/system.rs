//! The system: Fig. 1.1.

use super::prelude::*;
use crate::chapter::system;

formulas! {
    |system, x|
    "Δ" = system::gap(&system).abbreviated();
    "" = system::weight(&system);
    "R" = system::reaction(&system).abbreviated();
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![
        Entry::new("Fig. 1.1", "The system")
            .states("A mass hangs on a spring over a rigid plane.")
            .functions(["system::SpringMass", "system::gap", "system::weight", "system::reaction"]),
    ]
}
