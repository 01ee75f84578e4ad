//! The pages of proofs agree with the output of the prover.

use crate::files::root;
use book_tool::proofs::{Page, pages};
use spring_mass_contact::claims::entries;
use std::collections::BTreeSet;

/// With `UPDATE=1` the pages are written.
#[test]
fn pages_of_proofs_agree_with_the_prover() {
    let folder = root().join("book/src/proofs");
    let update = std::env::var_os("UPDATE").is_some();
    let pages = pages();
    for Page { file, text } in &pages {
        let path = folder.join(file);
        if update {
            std::fs::write(&path, text).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        let line = 1 + found.lines().zip(text.lines()).take_while(|(a, b)| a == b).count();
        assert!(
            found == *text,
            "book/src/proofs/{file}, line {line}, differs from the output of the prover: UPDATE=1 cargo test -p book-tool pages:: writes it"
        );
    }
    let sections: BTreeSet<_> =
        entries().iter().filter(|e| !e.claims.is_empty()).map(|e| e.section).collect();
    assert_eq!(pages.len(), sections.len(), "pages and sections with a claim");
}
