//! A proof with a wrong number is refused.

use crate::proofs::proofs;
use crate::strategies::is_deep;
use rayon::prelude::*;
use spring_mass_contact::formula::Statement;
use spring_mass_contact::proof::check::{Certificate, MAX_VARIABLES, Node, Polynomial, Step, check};

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

/// Changes one coefficient of a certificate.
fn spoil(certificate: &mut Certificate, place: usize) {
    // Any multiple of 0 is 0, so another left side would do for it.
    let is_left = place % 2 == 1 && !certificate.right.is_zero();
    spoil_form(if is_left { &mut certificate.left } else { &mut certificate.right }, place / 2);
}

/// Collects the certificates of a proof.
fn certificates<'n>(node: &'n mut Node, all: &mut Vec<&'n mut Certificate>) {
    match node {
        Node::Cases(_, both) => both.iter_mut().for_each(|node| certificates(node, all)),
        Node::Leaf(steps) => all.extend(steps.iter_mut().filter_map(|step| match step {
            Step::Show(_, certificate) => Some(certificate),
            _ => None,
        })),
    }
}

/// Returns the number of certificates of a claim that are changed, at most, and of changes of each.
fn changes() -> (usize, usize) {
    if is_deep() { (usize::MAX, 30) } else { (6, 1) }
}

/// Returns the number of certificates that are changed, and of those that are accepted nevertheless.
fn spoiled(statement: &Statement, goals: &[Node]) -> (usize, usize) {
    let mut copy = goals.to_vec();
    let mut all = Vec::new();
    copy.iter_mut().for_each(|node| certificates(node, &mut all));
    let (total, (most, of_each)) = (all.len(), changes());
    let (mut count, mut accepted) = (0, 0);
    for place in (0..total).step_by(total.div_ceil(most).max(1)) {
        for change in 0..of_each {
            let mut goals = goals.to_vec();
            let mut all = Vec::new();
            goals.iter_mut().for_each(|node| certificates(node, &mut all));
            spoil(all.swap_remove(place), place + change);
            count += 1;
            accepted += usize::from(check(statement, &goals).is_ok());
        }
    }
    (count, accepted)
}

/// Proofs as data, as `contact prove --format json` prints them.
#[cfg(feature = "serde")]
mod data {
    use super::*;
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
            (r#""known":[3,2]"#, r#""known":[3,1]"#, true),
            (r#"{"assume":0}"#, r#"{"assume":99}"#, true),
            (r#"{"assume":0},"#, "", true),
            (r#"[["1",[]]]"#, r#"[["1",[[63,1]]]]"#, true),
            (r#"[["1",[]]]"#, r#"[["1",[[64,1]]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["1",[[0,0]]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["1",[[0,256]]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["1",[]],["1",[]]]"#, false),
            (r#"[["1",[]]]"#, r#"[["170141183460469231731687303715884105728",[]]]"#, false),
            (r#"{"assume":0}"#, r#"{"assume":[]}"#, false),
            (r#"{"assume":0}"#, r#"{"suppose":0}"#, false),
            (r#""known":[3,2],"#, r#""known":[3,2],"more":[],"#, false),
            (r#""known":[3,2],"#, "", false),
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
    let all = proofs().par_bridge().map(|proof| spoiled(proof.statement(), proof.goals()));
    let (count, accepted) = all.reduce(|| (0, 0), |(a, b), (c, d)| (a + c, b + d));
    assert!(count > 300, "{count} certificates");
    assert_eq!(accepted, 0, "of {count} certificates");
}
