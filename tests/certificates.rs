//! Every claim has a proof by certificates, which the checker accepts, and a wrong number in one is noticed.

use rayon::prelude::*;
use spring_mass_contact::claims::statements;
use spring_mass_contact::formula::Statement;
use spring_mass_contact::proof::check::{Certificate, Known, MAX_VARIABLES, Node, Polynomial, Reason, check};
use spring_mass_contact::proof::prove;
use std::sync::LazyLock;

/// A claim with the proofs of its goals.
type Certified = (Statement, Vec<Node>);

/// The claims with their proofs, or the reason why there are none.
static CERTIFIED: LazyLock<Vec<Result<Certified, String>>> = LazyLock::new(|| {
    let certified = |s: &Statement| match prove(s) {
        Ok(proof) => Ok((s.clone(), proof.goals().to_vec())),
        Err(reason) => Err(format!("{} {}: {reason}", s.equation(), s.name())),
    };
    statements().par_iter().map(certified).collect()
});

#[test]
fn every_claim_is_certified() {
    let open: Vec<_> = CERTIFIED.iter().filter_map(|outcome| outcome.as_ref().err()).collect();
    assert!(open.is_empty(), "not certified: {open:#?}");
    assert!(CERTIFIED.len() > 100, "{} claims", CERTIFIED.len());
    let refused = CERTIFIED.iter().flatten().filter(|(s, goals)| check(s, goals).is_err());
    assert_eq!(refused.count(), 0);
}

/// Adds 1 to a coefficient of a form, or to the zero polynomial.
fn spoil_form(form: &mut Polynomial, place: usize) {
    let mut terms: Vec<_> = form.terms().copied().collect();
    let count = terms.len().max(1);
    match terms.get_mut(place % count) {
        Some((_, number)) => *number += 1,
        None => terms.push(([0; MAX_VARIABLES], 1)),
    }
    *form = Polynomial::new(terms).unwrap();
}

/// Changes one coefficient of a certificate, or of a lemma in it.
fn spoil(certificate: &mut Certificate, place: usize) {
    let lemmas = certificate.known.iter_mut().filter_map(|known| match known {
        Known::Lemma(lemma) => Some(&mut lemma.1),
        _ => None,
    });
    // Any multiple of 0 is 0, so another left side would do for it.
    match (place % 3, lemmas.into_iter().next()) {
        (0, Some(lemma)) if !lemma.right.is_zero() => spoil_form(&mut lemma.right, place / 3),
        (1, _) if !certificate.right.is_zero() => spoil_form(&mut certificate.left, place / 3),
        _ => spoil_form(&mut certificate.right, place / 3),
    }
}

/// Collects the certificates of a proof.
fn certificates<'n>(node: &'n mut Node, all: &mut Vec<&'n mut Certificate>) {
    match node {
        Node::Cases(_, both) => both.iter_mut().for_each(|node| certificates(node, all)),
        Node::Leaf(leaf) => {
            leaf.rises.iter_mut().flat_map(|rise| &mut rise.parts).for_each(|node| certificates(node, all));
            all.extend(leaf.signs.iter_mut().filter_map(|reason| match reason {
                Reason::Certificate(certificate) => Some(certificate),
                Reason::Fact(_) => None,
            }));
        }
    }
}

/// Number of certificates of a claim that are changed, at most.
const MAX_CHANGED: usize = 6;

/// Returns the number of certificates that are changed, and of those that are accepted nevertheless.
fn spoiled(statement: &Statement, goals: &[Node]) -> (usize, usize) {
    let mut copy = goals.to_vec();
    let mut all = Vec::new();
    copy.iter_mut().for_each(|node| certificates(node, &mut all));
    let (total, mut count, mut accepted) = (all.len(), 0, 0);
    for place in (0..total).step_by(total.div_ceil(MAX_CHANGED).max(1)) {
        let mut goals = goals.to_vec();
        let mut all = Vec::new();
        goals.iter_mut().for_each(|node| certificates(node, &mut all));
        spoil(all.swap_remove(place), place);
        count += 1;
        accepted += usize::from(check(statement, &goals).is_ok());
    }
    (count, accepted)
}

/// Proofs as data, as `contact prove --format json` prints them.
#[cfg(feature = "serde")]
mod data {
    use super::*;
    use crate::proofs::proofs;
    use spring_mass_contact::claims::registry;
    use spring_mass_contact::proof::Proof;
    use spring_mass_contact::proof::data::GoalProof;
    use spring_mass_contact::proof::render::ProofPrinter;

    fn nodes(json: &str) -> serde_json::Result<Vec<Node>> {
        let goals: Vec<GoalProof> = serde_json::from_str(json)?;
        Ok(goals.into_iter().map(|goal| goal.proof).collect())
    }

    #[test]
    fn proofs_that_are_read_back_are_accepted() {
        let printer = ProofPrinter::new(registry());
        let refused = proofs().par_bridge().filter(|proof| {
            let json = serde_json::to_string(&printer.data(proof)).unwrap();
            check(proof.statement(), &nodes(&json).unwrap()).is_err()
        });
        assert_eq!(refused.count(), 0);
    }

    /// Other data is not a proof, or is one that the checker refuses.
    #[test]
    fn spoiled_data_is_refused() {
        let is_minimum = |proof: &&Proof| proof.statement().name() == "contact-excludes-gap";
        let proof = proofs().find(is_minimum).unwrap();
        let json = serde_json::to_string(&ProofPrinter::new(registry()).data(proof)).unwrap();
        assert!(check(proof.statement(), &nodes(&json).unwrap()).is_ok());
        for (old, new, is_read) in [
            (r#""left":[["1",[]]]"#, r#""left":[["2",[]]]"#, true),
            (r#""left":[["1",[]]]"#, r#""left":[]"#, true),
            (r#"{"fact":2}"#, r#"{"fact":3}"#, true),
            (r#"{"fact":2}"#, r#"{"fact":99}"#, true),
            (r#""hypotheses":[0,"#, r#""hypotheses":["#, true),
            (r#""sizes":[]"#, r#""sizes":["atom"]"#, true),
            (r#"[["1",[]]]"#, r#"[["1",[[63,1]]]]"#, true),
            (r#"[["1",[]]]"#, r#"[["1",[[64,1]]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["1",[[0,0]]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["1",[[0,256]]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["1",[]],["1",[]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["170141183460469231731687303715884105728",[]]]"#, false),
            (r#""sizes":[]"#, r#""sizes":["new"]"#, false),
            (r#""sizes":[]"#, r#""sizes":[],"more":[]"#, false),
            (r#","sizes":[]"#, "", false),
        ] {
            let spoiled = json.replacen(old, new, 1);
            assert_ne!(spoiled, json, "{old}");
            match nodes(&spoiled) {
                Ok(nodes) => assert!(is_read && check(proof.statement(), &nodes).is_err(), "{new}"),
                Err(reason) => assert!(!is_read, "{new}: {reason}"),
            }
        }
    }
}

#[test]
fn a_certificate_with_another_coefficient_is_refused() {
    let all: Vec<_> =
        CERTIFIED.par_iter().flatten().map(|(statement, goals)| spoiled(statement, goals)).collect();
    let (count, accepted) = all.iter().fold((0, 0), |(a, b), (c, d)| (a + c, b + d));
    assert!(count > 300, "{count} certificates");
    assert_eq!(accepted, 0, "of {count} certificates");
}
