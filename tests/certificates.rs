//! Every claim has a proof by certificates, which the checker accepts, and a wrong number in one is noticed.

use rayon::prelude::*;
use spring_mass_contact::claims::statements;
use spring_mass_contact::formula::Statement;
use spring_mass_contact::proof::certify::certify;
use spring_mass_contact::proof::check::{Certificate, Known, MAX_VARIABLES, Node, Polynomial, Reason, check};
use std::sync::LazyLock;

/// A claim with the proofs of its goals.
type Certified = (Statement, Vec<Node>);

/// The claims with their proofs, or the reason why there are none.
static CERTIFIED: LazyLock<Vec<Result<Certified, String>>> = LazyLock::new(|| {
    let certified = |s: &Statement| match certify(s) {
        Ok(goals) => Ok((s.clone(), goals)),
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

#[test]
fn a_certificate_with_another_coefficient_is_refused() {
    let all: Vec<_> =
        CERTIFIED.par_iter().flatten().map(|(statement, goals)| spoiled(statement, goals)).collect();
    let (count, accepted) = all.iter().fold((0, 0), |(a, b), (c, d)| (a + c, b + d));
    assert!(count > 300, "{count} certificates");
    assert_eq!(accepted, 0, "of {count} certificates");
}
