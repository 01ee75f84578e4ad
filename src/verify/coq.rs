//! Export of the chapter to Coq.

use crate::claims::{Entry, entries, registry};
use crate::proof::coq::{Development, LocatedClaim};
use std::sync::LazyLock;

/// Returns a development of every function and claim of the chapter, with Theorem 1.3.3 for the iterates
/// themselves.
pub fn coq() -> &'static Development<'static> {
    static CHAPTER: LazyLock<Development> = LazyLock::new(|| {
        let placed = entries().iter().flat_map(|entry| {
            let Entry { section, functions, .. } = entry;
            entry.claims.iter().map(move |claim| LocatedClaim { claim, section, functions })
        });
        Development::new("Contact", registry(), placed).with_file("D_Iterates", include_str!("iterates.v"))
    });
    &CHAPTER
}
