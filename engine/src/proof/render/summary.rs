//! Summaries of proofs.

use crate::proof::kernel::sign::Rule;
use crate::proof::kernel::{Derivation, Justification, Proof};

/// Returns the method of a proof in a few words.
pub fn proof_summary(proof: &Proof) -> String {
    let cases = proof.goals().iter().map(cases).max().unwrap_or(1);
    let means = proof.goals().last().map_or("", |derivation| means(derivation));
    let kind = match proof.statement().kind() {
        "equal" | "sign" => means,
        other => other,
    };
    let kind = if proof.statement().contains_rounding() {
        format!("{kind}, any precision")
    } else {
        kind.to_string()
    };
    if cases > 1 { format!("{kind}, {cases} cases") } else { kind }
}

fn cases(derivation: &Derivation) -> usize {
    match derivation {
        Derivation::Cases(_, positive, not) => cases(positive) + cases(not),
        Derivation::Direct(_) => 1,
    }
}

fn means(derivation: &Derivation) -> &'static str {
    match derivation {
        Derivation::Cases(_, positive, _) => means(positive),
        Derivation::Direct(direct) => match &direct.justification {
            Justification::Equal(_) => "identity",
            Justification::Order(_) => "order",
            Justification::Derivative(..) => "derivative",
            Justification::Limit { .. } => "limit",
            Justification::Within(_) => "bound",
            Justification::Sign(signed) => match signed.num.rule() {
                Rule::TriangleInequality(_) | Rule::Endpoints { .. } => "rounding",
                Rule::Termwise => "sign by terms",
                Rule::Product(_, rest) if matches!(rest.rule(), Rule::MeanValue { .. }) => "sign by slope",
                Rule::Product(..) => "sign by factors",
                Rule::Square { .. } => "sign by square",
                Rule::MeanValue { .. } => "sign by slope",
            },
        },
    }
}
