//! The chapter for Coq.

use crate::claims::{entries, registry};
use crate::proof::coq::{Development, Placed};
use std::sync::LazyLock;

/// Every function of the chapter, every claim, and Theorem 1.3.3 of the iterates themselves.
pub fn coq() -> &'static Development<'static> {
    static CHAPTER: LazyLock<Development> = LazyLock::new(|| {
        let placed = entries().iter().flat_map(|entry| {
            let place = |claim| Placed { claim, section: entry.section, functions: &entry.functions };
            entry.claims.iter().map(place)
        });
        Development::new("Contact", registry(), placed).with("D_Iterates", include_str!("iterates.v"))
    });
    &CHAPTER
}
