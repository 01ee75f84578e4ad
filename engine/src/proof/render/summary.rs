//! Summaries of proofs.

use super::leaves;
use crate::proof::Proof;
use crate::proof::check::{Law, Node, Step};

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
    let methods = leaves(node).into_iter().flatten().filter_map(|step| match step {
        Step::Law(Law::Order(_)) => Some("order"),
        Step::Law(Law::AboveTangent(_) | Law::BelowPole(_)) => Some("sign by exponentials"),
        Step::Square(_) => Some("sign by square"),
        _ => None,
    });
    methods.min().unwrap_or("sign")
}
