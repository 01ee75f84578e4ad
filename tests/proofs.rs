//! Every claim is proved for all values, from the chapter's functions.
#![cfg(feature = "prover")]

use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::proof::prove;
use spring_mass_contact::proof::render::ProofPrinter;
use std::collections::BTreeSet;

#[test]
fn every_claim_is_proved() {
    let open: Vec<_> = statements()
        .iter()
        .filter_map(|s| prove(s).err().map(|reason| format!("{} {}: {reason}", s.equation(), s.name())))
        .collect();
    assert!(open.is_empty(), "not proved, as `contact prove` shows: {open:#?}");
    assert!(statements().len() > 100, "{} statements", statements().len());
}

#[test]
fn every_equation_of_the_chapter_has_a_proof() {
    let proved: BTreeSet<_> = statements().iter().map(|s| s.equation()).collect();
    for n in 1..=33 {
        assert!(
            proved.contains(format!("1.{n}").as_str()),
            "nothing is proved of (1.{n}): add a claim to its entry in src/claims"
        );
    }
}

#[test]
fn every_formula_of_the_chapter_is_part_of_a_proof() {
    let mut sites = BTreeSet::new();
    for statement in statements() {
        statement.trees().for_each(|tree| {
            tree.visit(&mut |step| {
                sites.insert(step.site());
            })
        });
    }
    for formula in registry().formulas() {
        // A formula made by differentiating has the places of the number system that does it.
        assert!(
            sites.contains(&formula.tree.site()),
            "no claim contains {}: call it in a claim of the entry that names it in src/claims",
            formula.path
        );
    }
    assert!(registry().formulas().len() > 60, "{} formulas", registry().formulas().len());
}

#[test]
fn a_proof_is_printed_in_readable_lines() {
    let statements = statements();
    let statement = statements.iter().find(|s| (s.equation(), s.name()) == ("1.13", "rate")).unwrap();
    let (proof, paper) = (prove(statement).unwrap(), ProofPrinter::new(registry()));
    assert_eq!(paper.claim(statement), "(c + ε) ((ε (H − l) + m g) / (c + ε) − Δ) = R");
    assert_eq!(paper.used(&proof), ["c > 0", "ε > 0"]);
    let lines = paper.proof(&proof);
    assert_eq!(lines.first().map(String::as_str), Some("c + ε ≠ 0: c + ε > 0, term by term"));
}
