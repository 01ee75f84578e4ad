//! Proofs of all claims, with mutations and dropped hypotheses that show that they could fail.

#[cfg(feature = "serde")]
mod json;

use crate::claims::{registry, statements};
use crate::formula::statement::minimum_precision;
use crate::formula::{Registry, Statement};
use crate::proof::mutation::{
    self, DroppedHypothesis, MutationReport, find_detected_mutants, test_mutations,
};
use crate::proof::render::ProofPrinter;
use crate::proof::{Counterexample, Proof, prove, refute};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// A claim with its proof or refutation.
#[derive(Clone, Debug)]
pub struct ProofAttempt {
    /// The claim.
    pub statement: Statement,
    /// The outcome.
    pub outcome: ProofOutcome,
    /// Time of the attempt.
    pub time: Duration,
}

/// Outcome of proving a claim.
#[derive(Clone, Debug)]
pub enum ProofOutcome {
    /// The proof.
    Proof(Box<Proof>),
    /// The reason why the proof failed, and a counterexample if one was found.
    None(String, Option<Counterexample>),
}

impl ProofAttempt {
    /// Proves a statement, or tries to refute it.
    pub fn of(statement: Statement) -> Self {
        let start = Instant::now();
        let outcome = match prove(&statement) {
            Ok(proof) => ProofOutcome::Proof(proof.into()),
            Err(error) => {
                let reason = ProofPrinter::new(registry()).describe(&statement, &error);
                ProofOutcome::None(reason, refute(&statement))
            }
        };
        ProofAttempt { statement, outcome, time: start.elapsed() }
    }

    /// Returns its hypotheses as text.
    pub fn hypotheses(&self) -> Vec<String> {
        registry().format_hypotheses(self.statement.hypotheses())
    }

    /// Returns `proved`, `refuted` or `unknown`.
    pub fn status(&self) -> &'static str {
        match &self.outcome {
            ProofOutcome::Proof(_) => "proved",
            ProofOutcome::None(_, Some(_)) => "refuted",
            ProofOutcome::None(_, None) => "unknown",
        }
    }
}

/// Proofs of the claims of some equations.
#[derive(Clone, Debug, Default)]
pub struct Proofs {
    /// Claims in the chapter's order.
    pub claims: Vec<ProofAttempt>,
    /// Mutations and dropped hypotheses of these claims, if all are proved.
    pub mutation: MutationReport,
    /// Time of the proofs.
    pub proof_time: Duration,
    /// Time of the proofs with mutations and dropped hypotheses.
    pub total_time: Duration,
}

/// Numbers of proofs and mutations by outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ProofSummary {
    /// All claims.
    pub claims: usize,
    /// Proved claims.
    pub proved: usize,
    /// Claims with a counterexample.
    pub refuted: usize,
    /// Claims that are neither proved nor refuted.
    pub unknown: usize,
    /// Hypotheses of all claims.
    pub hypotheses: usize,
    /// Outcomes of the mutations.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub controls: mutation::MutationSummary,
}

/// Proves the claims of some equations, or all claims without equations, and tests mutations and dropped
/// hypotheses if all are proved. Of some equations the result contains the mutants that their claims detect;
/// other claims have to detect the others.
pub fn prove_equations(equations: &[String]) -> Proofs {
    let mut selected = statements();
    if equations.is_empty() {
        return prove_statements(&selected, test_mutations);
    }
    selected.retain(|statement| equations.iter().any(|equation| equation == statement.equation()));
    prove_statements(&selected, find_detected_mutants)
}

fn prove_statements(statements: &[Statement], test: fn(&[Statement], &Registry) -> MutationReport) -> Proofs {
    let start = Instant::now();
    let claims: Vec<_> = statements.par_iter().cloned().map(ProofAttempt::of).collect();
    let proof_time = start.elapsed();
    let all_proved = claims.iter().all(|claim| matches!(claim.outcome, ProofOutcome::Proof(_)));
    let mutation = if all_proved { test(statements, registry()) } else { MutationReport::default() };
    Proofs { claims, mutation, proof_time, total_time: start.elapsed() }
}

impl Proofs {
    /// Returns `true` if every claim is proved, every hypothesis needed, and every mutant detected, and there
    /// is at least one claim.
    pub fn hold(&self) -> bool {
        let ProofSummary { claims, proved, controls, .. } = self.summary();
        let is_redundant = self.mutation.redundant_hypotheses().next().is_some();
        0 < proved && claims == proved && controls.undetected == 0 && !is_redundant
    }

    /// Returns the outcomes of dropping each hypothesis of a claim.
    pub fn dropped(&self, statement: &Statement) -> impl Iterator<Item = &DroppedHypothesis> {
        let of = (statement.equation(), statement.name());
        self.mutation.dropped.iter().filter(move |dropped| (dropped.equation, dropped.name) == of)
    }

    /// Returns the claims of each equation.
    pub fn by_equation(&self) -> impl Iterator<Item = &[ProofAttempt]> {
        self.claims.chunk_by(|a, b| a.statement.equation() == b.statement.equation())
    }

    /// Returns the summary.
    pub fn summary(&self) -> ProofSummary {
        let [proved, refuted, unknown] = ["proved", "refuted", "unknown"]
            .map(|status| self.claims.iter().filter(|claim| claim.status() == status).count());
        // The minimum precision is not counted.
        let hypotheses = self.claims.iter().flat_map(|claim| claim.statement.hypotheses());
        let hypotheses = hypotheses.filter(|hypothesis| **hypothesis != minimum_precision()).count();
        let (claims, controls) = (self.claims.len(), self.mutation.summary());
        ProofSummary { claims, proved, refuted, unknown, hypotheses, controls }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::hypotheses;
    use crate::formula::claim::equal;
    use crate::number::Tree;
    use crate::proof::mutation::{DropOutcome, MutationOutcome, mutants};

    fn rate() -> Statement {
        statements().into_iter().find(|s| (s.equation(), s.name()) == ("1.13", "rate")).unwrap()
    }

    /// Returns the false claim c = 0.
    fn wrong() -> Statement {
        equal("wrong", Tree::symbol("c"), 0).assuming(rate().hypotheses()).inheriting("1.13", &[])
    }

    fn redundant(statement: &Statement) -> DroppedHypothesis {
        let (equation, name) = (statement.equation(), statement.name());
        DroppedHypothesis {
            equation,
            name,
            hypothesis: hypotheses().stiffness.clone(),
            outcome: DropOutcome::StillProved,
        }
    }

    /// The claim of note 6 is about formulas of other equations.
    #[test]
    fn selected_claims_alone_are_proved_and_tested() {
        let proofs = prove_equations(&["note 6".to_string()]);
        assert!(proofs.hold() && proofs.claims.iter().all(|claim| claim.statement.equation() == "note 6"));
        let MutationReport { mutants, dropped } = proofs.mutation;
        let by = |outcome: &MutationOutcome| match outcome {
            MutationOutcome::Detected { equation, .. } => Some(*equation),
            MutationOutcome::Equivalent | MutationOutcome::Undetected => None,
        };
        assert!(!mutants.is_empty() && mutants.iter().all(|(_, outcome)| by(outcome) == Some("note 6")));
        assert!(!dropped.is_empty() && dropped.iter().all(|dropped| dropped.equation == "note 6"));
    }

    #[test]
    fn mutations_are_tested_if_all_claims_are_proved() {
        assert!(!prove_statements(&[rate()], test_mutations).mutation.mutants.is_empty());
        assert!(prove_statements(&[rate(), wrong()], test_mutations).mutation.mutants.is_empty());
    }

    /// One unproved claim, one undetected mutant, or one redundant hypothesis suffices.
    #[test]
    fn one_unproved_claim_undetected_mutation_or_redundant_hypothesis_fails_the_proofs() {
        let change = mutants(&[rate()], registry())[0];
        let hold = |statements: &[Statement], effect, dropped| {
            let mutation = MutationReport { mutants: vec![(change, effect)], dropped };
            let claims = statements.iter().cloned().map(ProofAttempt::of).collect();
            Proofs { claims, mutation, ..Proofs::default() }.hold()
        };
        assert!(hold(&[rate()], MutationOutcome::Equivalent, vec![]));
        assert!(!hold(&[], MutationOutcome::Equivalent, vec![]));
        assert!(!hold(&[wrong()], MutationOutcome::Equivalent, vec![]));
        assert!(!hold(&[rate(), wrong()], MutationOutcome::Equivalent, vec![]));
        assert!(!hold(&[rate()], MutationOutcome::Undetected, vec![]));
        assert!(!hold(&[rate()], MutationOutcome::Equivalent, vec![redundant(&rate())]));
    }

    /// JSON contains all quantities of the claim as texts.
    #[cfg(feature = "serde")]
    #[test]
    fn json_contains_the_counterexample_of_a_refuted_claim() {
        let proofs = Proofs { claims: vec![ProofAttempt::of(wrong())], ..Proofs::default() };
        let json = serde_json::to_value(&proofs).unwrap();
        let claim = &json["equations"][0]["claims"][0];
        assert_eq!(claim["status"], "refuted");
        let c = claim["counterexample"]["c"].as_str().unwrap();
        assert!(c.parse::<crate::number::Exact>().unwrap() > crate::number::Exact::from(0), "{c}");
    }
}
