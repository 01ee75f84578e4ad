//! Proofs and controls as JSON has them: quantities as texts, every key always there.

use super::{Answer, Proofs, Proved, Summary};
use crate::claims::registry;
use crate::proof::Counterexample;
use crate::proof::controls::{Change, Dropped, Effect, Without};
use crate::proof::paper::Paper;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

#[derive(Serialize)]
struct All {
    summary: Summary,
    equations: Vec<Equation>,
    changes: Vec<Changed>,
}

#[derive(Serialize)]
struct Equation {
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
    certificate: Option<String>,
    why: Option<String>,
    counterexample: Option<Values>,
    dropped: Vec<Less>,
}

/// A claim without one of its hypotheses.
#[derive(Serialize)]
struct Less {
    hypothesis: String,
    status: &'static str,
    counterexample: Option<Values>,
}

#[derive(Serialize)]
struct Changed {
    at: String,
    change: String,
    status: &'static str,
    by: Option<String>,
    counterexample: Option<Values>,
}

/// The coordinates of a counterexample, by their symbols.
type Values = BTreeMap<&'static str, String>;

fn values(counterexample: &Counterexample) -> Values {
    counterexample.point.numbers().map(|(name, x)| (name, x.to_string())).collect()
}

impl Serialize for Proofs {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let equations = self.by_equation().map(|claims| Equation {
            equation: claims[0].statement.equation(),
            claims: claims.iter().map(|proved| claim(proved, self)).collect(),
        });
        let changes = self.controls.changes.iter().map(changed);
        All { summary: self.summary(), equations: equations.collect(), changes: changes.collect() }
            .serialize(to)
    }
}

fn claim(proved: &Proved, proofs: &Proofs) -> Claim {
    let Proved { statement, answer, .. } = proved;
    let paper = Paper::new(registry()).in_full();
    let (certificate, why, counterexample) = match answer {
        Answer::Proof(proof) => (Some(paper.proof(proof).join("\n")), None, None),
        Answer::None(why, counterexample) => (None, Some(why.clone()), counterexample.as_ref().map(values)),
    };
    Claim {
        claim: statement.name(),
        kind: statement.kind(),
        statement: paper.claim(statement),
        hypotheses: proved.hypotheses(),
        status: proved.status(),
        certificate,
        why,
        counterexample,
        dropped: proofs.dropped(statement).map(dropped).collect(),
    }
}

fn dropped(Dropped { given, without, .. }: &Dropped) -> Less {
    let (status, counterexample) = match without {
        Without::Refuted(refutation) => ("refuted", Some(values(&refutation.counterexample()))),
        Without::StillTrue => ("still_true", None),
        Without::Unknown => ("unknown", None),
    };
    Less { hypothesis: registry().supposed(given), status, counterexample }
}

fn changed((Change { site, what }, effect): &(Change, Effect)) -> Changed {
    let (status, by, counterexample) = match effect {
        Effect::Noticed { equation, name, refutation } => {
            ("noticed", Some(format!("{equation} {name}")), Some(values(&refutation.counterexample())))
        }
        Effect::Unchanged => ("unchanged", None, None),
        Effect::Unnoticed => ("unnoticed", None, None),
    };
    Changed { at: site.to_string(), change: what.to_string(), status, by, counterexample }
}
