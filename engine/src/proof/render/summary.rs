//! Summaries of proofs.

use super::leaves;
use crate::proof::Proof;

/// Returns the kind of a proof in a few words.
pub fn proof_summary(proof: &Proof) -> String {
    let cases = proof.goals().iter().map(|node| leaves(node).len()).max().unwrap_or(1);
    let kind = match proof.statement().kind() {
        "equal" => "identity",
        other => other,
    };
    let precision = if proof.statement().contains_rounding() { ", any precision" } else { "" };
    let cases = if cases > 1 { format!(", {cases} cases") } else { String::new() };
    format!("{kind}{precision}{cases}")
}
