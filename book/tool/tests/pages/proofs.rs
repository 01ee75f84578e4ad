//! The pages of claims agree with the output of the prover.

use crate::files::{root, text};
use book_tool::proofs::pages;
use spring_mass_contact::claims::entries;

/// With `UPDATE=1` the pages are written.
#[test]
fn pages_of_proofs_agree_with_the_prover() {
    let mut written = String::new();
    for (name, page) in pages() {
        let path = root().join("book/src/proofs").join(&name);
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(&path, &page).unwrap();
        }
        let found = text(path).replace("\r\n", "\n");
        let line = 1 + found.lines().zip(page.lines()).take_while(|(a, b)| a == b).count();
        assert!(
            found == page,
            "book/src/proofs/{name}, line {line}, differs from the output of the prover: UPDATE=1 cargo test -p book-tool pages:: writes it"
        );
        written += &page;
    }
    let claims = entries().iter().map(|entry| entry.claims.len()).sum::<usize>();
    assert_eq!(
        written.matches("\n- *").count() - written.matches("*, tested: ").count(),
        claims,
        "each section has a page"
    );
}
