//! Every claim is proved for all values, from the chapter's functions.

use rayon::prelude::*;
use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::formula::Statement;
use spring_mass_contact::proof::render::ProofPrinter;
use spring_mass_contact::proof::{Proof, prove};
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// The outcome of proving each claim.
static OUTCOMES: LazyLock<Vec<Result<Proof, String>>> = LazyLock::new(|| {
    let outcome =
        |s: &Statement| prove(s).map_err(|reason| format!("{} {}: {reason}", s.equation(), s.name()));
    statements().par_iter().map(outcome).collect()
});

/// Returns the proofs of all claims.
pub fn proofs() -> impl Iterator<Item = &'static Proof> {
    OUTCOMES.iter().flatten()
}

#[test]
fn every_claim_is_proved() {
    let open: Vec<_> = OUTCOMES.iter().filter_map(|outcome| outcome.as_ref().err()).collect();
    assert!(open.is_empty(), "not proved, as `contact prove` shows: {open:#?}");
    assert!(OUTCOMES.len() > 100, "{} claims", OUTCOMES.len());
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
    let is_rate =
        |proof: &&Proof| (proof.statement().equation(), proof.statement().name()) == ("1.13", "rate");
    let (proof, paper) = (proofs().find(is_rate).unwrap(), ProofPrinter::new(registry()));
    assert_eq!(paper.claim(proof.statement()), "(c + ε) ((ε (H − l) + m g) / (c + ε) − Δ) = R");
    assert_eq!(paper.used(proof), ["c > 0", "ε > 0"]);
    let lines = paper.proof(proof);
    assert_eq!(lines.first().map(String::as_str), Some("c + ε > 0"));
}

/// The signs of symbols are used without saying so.
#[test]
fn a_printed_proof_names_each_hypothesis_that_it_uses() {
    let printer = ProofPrinter::new(registry());
    let unnamed = proofs().flat_map(|proof| {
        let lines = printer.proof(proof).join("\n");
        let is_unnamed =
            move |given: &String| given.split(' ').count() > 3 && !lines.contains(given.as_str());
        let name = proof.statement().name();
        printer.used(proof).into_iter().filter(is_unnamed).map(move |given| (name, given))
    });
    assert_eq!(unnamed.collect::<Vec<_>>(), []);
}
