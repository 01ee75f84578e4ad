//! JSON of proofs and mutations: quantities are texts, and every key is always present.

use super::{ProofAttempt, ProofOutcome, ProofSummary, Proofs};
use crate::claims::registry;
use crate::proof::Counterexample;
use crate::proof::data::GoalProof;
use crate::proof::mutation::{DropOutcome, DroppedHypothesis, Mutant, MutationOutcome};
use crate::proof::render::ProofPrinter;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

#[derive(Serialize)]
struct All {
    summary: ProofSummary,
    equations: Vec<EquationProofs>,
    mutations: Vec<Mutation>,
}

#[derive(Serialize)]
struct EquationProofs {
    equation: &'static str,
    claims: Vec<Claim>,
}

#[derive(Serialize)]
struct Claim {
    claim: &'static str,
    kind: &'static str,
    statement: String,
    hypotheses: Vec<String>,
    status: &'static str,
    proof: Option<Vec<GoalProof>>,
    reason: Option<String>,
    counterexample: Option<Values>,
    dropped: Vec<DroppedResult>,
}

/// A claim without one of its hypotheses.
#[derive(Serialize)]
struct DroppedResult {
    hypothesis: String,
    status: &'static str,
    counterexample: Option<Values>,
}

#[derive(Serialize)]
struct Mutation {
    at: String,
    mutation: String,
    status: &'static str,
    by: Option<String>,
    counterexample: Option<Values>,
}

/// Coordinates of a counterexample by symbol.
type Values = BTreeMap<&'static str, String>;

fn values(counterexample: &Counterexample) -> Values {
    counterexample.point.coordinates().map(|(name, x)| (name, x.to_string())).collect()
}

impl Serialize for Proofs {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let equations = self.by_equation().map(|claims| EquationProofs {
            equation: claims[0].statement.equation(),
            claims: claims.iter().map(|proved| claim(proved, self)).collect(),
        });
        let mutations = self.mutation.mutants.iter().map(mutation);
        All { summary: self.summary(), equations: equations.collect(), mutations: mutations.collect() }
            .serialize(to)
    }
}

fn claim(proved: &ProofAttempt, proofs: &Proofs) -> Claim {
    let ProofAttempt { statement, outcome, .. } = proved;
    let printer = ProofPrinter::new(registry());
    let (proof, reason, counterexample) = match outcome {
        ProofOutcome::Proof(proof) => (Some(printer.data(proof)), None, None),
        ProofOutcome::None(reason, counterexample) => {
            (None, Some(reason.clone()), counterexample.as_ref().map(values))
        }
    };
    Claim {
        claim: statement.name(),
        kind: statement.kind(),
        statement: printer.claim(statement),
        hypotheses: proved.hypotheses(),
        status: proved.status(),
        proof,
        reason,
        counterexample,
        dropped: proofs.dropped(statement).map(dropped).collect(),
    }
}

fn dropped(DroppedHypothesis { hypothesis, outcome, .. }: &DroppedHypothesis) -> DroppedResult {
    let (status, counterexample) = match outcome {
        DropOutcome::Refuted(refutation) => ("refuted", Some(values(&refutation.counterexample()))),
        DropOutcome::StillProved => ("still_proved", None),
        DropOutcome::Undecided => ("unknown", None),
    };
    DroppedResult { hypothesis: registry().format_hypothesis(hypothesis), status, counterexample }
}

fn mutation((Mutant { site, mutation }, outcome): &(Mutant, MutationOutcome)) -> Mutation {
    let (status, by, counterexample) = match outcome {
        MutationOutcome::Detected { equation, name, refutation } => {
            ("detected", Some(format!("{equation} {name}")), Some(values(&refutation.counterexample())))
        }
        MutationOutcome::Equivalent => ("equivalent", None, None),
        MutationOutcome::Undetected => ("undetected", None, None),
    };
    Mutation { at: site.to_string(), mutation: mutation.to_string(), status, by, counterexample }
}
