//! The system: Fig. 1.1.

use super::prelude::*;
use crate::chapter::system;

formulas! {
    "Δ" (folded) = system::gap(system);
    "" = system::weight(system);
    "R" (folded) = system::reaction(system);
}

/// Its entries, with what is claimed of each.
pub(super) fn entries() -> Vec<Entry> {
    vec![
        Entry::new("Fig. 1.1", "The system")
            .states("A mass hangs on a spring over a rigid plane.")
            .functions(["system::SpringMass", "system::gap", "system::weight", "system::reaction"]),
    ]
}
