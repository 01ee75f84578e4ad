//! Proofs in a few words.

use crate::proof::kernel::sign::Rule;
use crate::proof::kernel::{Because, Derivation, Proof};

/// How a claim was proved, in a few words.
pub fn how(proof: &Proof) -> String {
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
        Derivation::Direct(direct) => match &direct.because {
            Because::Same(_) => "identity",
            Because::Order(_) => "order",
            Because::Derivative(..) => "derivative",
            Because::Limit { .. } => "limit",
            Because::Within(_) => "bound",
            Because::Sign(signed) => match signed.num.rule() {
                Rule::Sizes(_) | Rule::Ends { .. } => "rounding",
                Rule::Terms => "sign by terms",
                Rule::Factor(_, rest) if matches!(rest.rule(), Rule::Slope { .. }) => "sign by slope",
                Rule::Factor(..) => "sign by factors",
                Rule::Square { .. } => "sign by square",
                Rule::Slope { .. } => "sign by slope",
            },
        },
    }
}
