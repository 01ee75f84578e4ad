//! Summaries of proofs.

use super::leaves;
use crate::proof::Proof;
use crate::proof::check::{Certificate, Known, Node, Reason};

/// Returns the method of a proof in a few words.
pub fn proof_summary(proof: &Proof) -> String {
    let goals = proof.goals();
    let cases = goals.iter().map(|node| leaves(node).len()).max().unwrap_or(1);
    let kind = match proof.statement().kind() {
        "equal" => "identity",
        "sign" => goals.last().map_or("sign", method),
        other => other,
    };
    let precision = if proof.statement().contains_rounding() { ", any precision" } else { "" };
    let cases = if cases > 1 { format!(", {cases} cases") } else { String::new() };
    format!("{kind}{precision}{cases}")
}

/// Returns the method for a sign.
fn method(node: &Node) -> &'static str {
    let leaves = leaves(node);
    let mut last_signs = leaves.iter().filter_map(|leaf| leaf.signs.last());
    if leaves.iter().any(|leaf| !leaf.orders.is_empty()) {
        "order"
    } else if leaves.iter().any(|leaf| !leaf.rises.is_empty()) {
        "sign by slope"
    } else if last_signs.any(|reason| matches!(reason, Reason::Certificate(of) if contains_square(of))) {
        "sign by square"
    } else {
        "sign"
    }
}

/// Returns `true` if a certificate rests on the square of a quantity of unknown sign.
fn contains_square(certificate: &Certificate) -> bool {
    certificate.known.iter().any(|known| match known {
        Known::Value(_) => true,
        Known::Lemma(lemma) => contains_square(&lemma.1),
        Known::Fact(_) | Known::Exponents { .. } => false,
    })
}
