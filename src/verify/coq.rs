//! Export of the chapter to Coq.

use crate::claims::{entries, registry};
use crate::proof::coq::{Development, LocatedClaim};
use std::sync::LazyLock;

/// Returns a development of every function and claim of the chapter, with Theorem 1.3.3 for the iterates
/// themselves.
pub fn coq() -> &'static Development<'static> {
    static CHAPTER: LazyLock<Development> = LazyLock::new(|| {
        let placed = entries().iter().flat_map(|entry| {
            let place = |claim| LocatedClaim { claim, section: entry.section, functions: &entry.functions };
            entry.claims.iter().map(place)
        });
        Development::new("Contact", registry(), placed).with_file("D_Iterates", include_str!("iterates.v"))
    });
    &CHAPTER
}
