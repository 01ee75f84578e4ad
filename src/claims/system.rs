//! The system: Fig. 1.1.

use super::prelude::*;
use crate::chapter::system;

formulas! {
    "Δ" (abbreviated) = system::gap(system);
    "" = system::weight(system);
    "R" (abbreviated) = system::reaction(system);
}

/// Returns the entries.
pub(super) fn entries() -> Vec<Entry> {
    vec![
        Entry::new("Fig. 1.1", "The system")
            .states("A mass hangs on a spring over a rigid plane.")
            .functions(["system::SpringMass", "system::gap", "system::weight", "system::reaction"]),
    ]
}
