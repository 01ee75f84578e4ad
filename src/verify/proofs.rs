//! The proofs of all claims, with the controls that show they could have failed.

#[cfg(feature = "serde")]
mod json;

use crate::claims::{place, registry, statements};
use crate::formula::statement::minimum_precision;
use crate::formula::{Hypothesis, Statement};
use crate::proof::controls::{self, Change, Controls, Dropped, Effect, controls, repairs};
use crate::proof::paper::Paper;
use crate::proof::{Counterexample, Proof, prove, refute};
use crate::verify::guard::guarded;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// A claim and what came of it.
#[derive(Clone, Debug)]
pub struct Proved {
    /// What was to be proved.
    pub statement: Statement,
    /// The proof, if there is one.
    pub answer: Answer,
    /// How long it took.
    pub time: Duration,
}

/// A proof, or none.
#[derive(Clone, Debug)]
pub enum Answer {
    /// The proof.
    Proof(Box<Proof>),
    /// Why there is none, and where the claim does not hold, if that was found.
    None(String, Option<Counterexample>),
}

impl Proved {
    /// Proves a statement, or tries to refute it; what breaks off is not proved.
    pub fn of(statement: Statement) -> Self {
        let start = Instant::now();
        let none = |why| Answer::None(why, guarded(|| refute(&statement)).ok().flatten());
        let answer = match guarded(|| prove(&statement)) {
            Ok(Ok(proof)) => Answer::Proof(proof.into()),
            Ok(Err(why)) => none(Paper::new(registry()).why(&statement, &why)),
            Err(panic) => none(panic),
        };
        Proved { statement, answer, time: start.elapsed() }
    }

    /// What it supposes, as a reader writes it.
    pub fn hypotheses(&self) -> Vec<String> {
        registry().all_supposed(self.statement.hypotheses())
    }

    /// `proved`, `refuted` or `unknown`.
    pub fn status(&self) -> &'static str {
        match &self.answer {
            Answer::Proof(_) => "proved",
            Answer::None(_, Some(_)) => "refuted",
            Answer::None(_, None) => "unknown",
        }
    }
}

/// All that is proved of some equations, and what is not.
#[derive(Clone, Debug, Default)]
pub struct Proofs {
    /// In the chapter's order.
    pub claims: Vec<Proved>,
    /// Those about these claims: a change belongs to the one that notices it.
    pub controls: Controls,
    /// With one of these all claims would be proved.
    pub repairs: Vec<Change>,
    /// How long the proofs took.
    pub of_proofs: Duration,
    /// And the controls with them.
    pub in_all: Duration,
}

/// How many proofs and controls came out how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Summary {
    /// All claims.
    pub claims: usize,
    /// Those that are proved.
    pub proved: usize,
    /// Those with a counterexample.
    pub refuted: usize,
    /// Neither.
    pub unknown: usize,
    /// Of all claims.
    pub hypotheses: usize,
    /// What changes of formulas came to.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub controls: controls::Summary,
}

/// Proves every claim of the chapter, and runs the controls if all are proved: of others they say nothing.
/// What is not about these equations is left out; that no claim notices a change is about all of them.
pub fn prove_all(equations: &[String]) -> Proofs {
    let all = statements();
    let start = Instant::now();
    let mut claims: Vec<_> = all.par_iter().cloned().map(Proved::of).collect();
    let of_proofs = start.elapsed();
    let (mut controls, repairs) = if claims.iter().all(|claim| matches!(claim.answer, Answer::Proof(_))) {
        (controls(&all, registry()), Vec::new())
    } else {
        (Controls::default(), repairs(&all, registry()))
    };
    let wanted = |equation: &str| equations.is_empty() || equations.iter().any(|e| e == equation);
    claims.retain(|claim| wanted(claim.statement.equation()));
    claims.sort_by_key(|claim| place(claim.statement.equation()));
    controls.dropped.retain(|dropped| wanted(dropped.equation));
    controls.changes.retain(|(_, effect)| match effect {
        Effect::Noticed { equation, .. } => wanted(equation),
        Effect::Unchanged | Effect::Unnoticed => equations.is_empty(),
    });
    Proofs { claims, controls, repairs, of_proofs, in_all: start.elapsed() }
}

impl Proofs {
    /// Is everything proved, every hypothesis needed, and every change noticed? Not if nothing is.
    pub fn hold(&self) -> bool {
        let Summary { claims, proved, controls, .. } = self.summary();
        0 < proved && claims == proved && controls.unnoticed == 0 && self.controls.needless().next().is_none()
    }

    /// A claim's hypotheses, dropped one at a time.
    pub fn dropped(&self, statement: &Statement) -> impl Iterator<Item = &Dropped> {
        let of = (statement.equation(), statement.name());
        self.controls.dropped.iter().filter(move |dropped| (dropped.equation, dropped.name) == of)
    }

    /// The claims of each equation.
    pub fn by_equation(&self) -> impl Iterator<Item = &[Proved]> {
        self.claims.chunk_by(|a, b| a.statement.equation() == b.statement.equation())
    }

    /// The summary.
    pub fn summary(&self) -> Summary {
        let with = |status| self.claims.iter().filter(|claim| claim.status() == status).count();
        // That a number has two bits goes without saying.
        let said = |given: &&Hypothesis| **given != minimum_precision();
        Summary {
            claims: self.claims.len(),
            proved: with("proved"),
            refuted: with("refuted"),
            unknown: with("unknown"),
            hypotheses: self
                .claims
                .iter()
                .flat_map(|claim| claim.statement.hypotheses())
                .filter(said)
                .count(),
            controls: self.controls.summary(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::given;
    use crate::formula::claim::equal;
    use crate::number::Tree;
    use crate::proof::controls::{Without, changes};

    fn rate() -> Statement {
        statements().into_iter().find(|s| (s.equation(), s.name()) == ("1.13", "rate")).unwrap()
    }

    /// c = 0, in the place of what is claimed.
    fn wrong() -> Statement {
        equal("wrong", Tree::symbol("c"), 0).assuming(rate().hypotheses()).inheriting("1.13", &[])
    }

    fn needless(statement: &Statement) -> Dropped {
        let (equation, name) = (statement.equation(), statement.name());
        Dropped { equation, name, given: given().stiffness.clone(), without: Without::StillTrue }
    }

    /// One claim that is not proved, one change that is not noticed, one hypothesis that is not needed.
    #[test]
    fn one_of_many_that_does_not_hold_is_enough() {
        let change = changes(&[rate()], registry())[0];
        let hold = |statements: &[Statement], effect, dropped| {
            let controls = Controls { changes: vec![(change, effect)], dropped };
            let claims = statements.iter().cloned().map(Proved::of).collect();
            Proofs { claims, controls, ..Proofs::default() }.hold()
        };
        assert!(hold(&[rate()], Effect::Unchanged, vec![]));
        assert!(!hold(&[], Effect::Unchanged, vec![]));
        assert!(!hold(&[wrong()], Effect::Unchanged, vec![]));
        assert!(!hold(&[rate(), wrong()], Effect::Unchanged, vec![]));
        assert!(!hold(&[rate()], Effect::Unnoticed, vec![]));
        assert!(!hold(&[rate()], Effect::Unchanged, vec![needless(&rate())]));
    }

    #[test]
    fn a_claim_has_its_own_hypotheses() {
        let dropped = vec![needless(&wrong()), needless(&rate())];
        let proofs = Proofs { controls: Controls { changes: vec![], dropped }, ..Proofs::default() };
        let names: Vec<_> = proofs.dropped(&rate()).map(|dropped| dropped.name).collect();
        assert_eq!(names, ["rate"]);
        let proved = Proved::of(wrong().only_assuming([&given().penalty]));
        assert_eq!((proved.hypotheses(), proved.status()), (vec!["ε > 0".to_string()], "refuted"));
    }

    /// With all that the claim speaks of, as a text.
    #[cfg(feature = "serde")]
    #[test]
    fn json_shows_where_a_claim_does_not_hold() {
        let proofs = Proofs { claims: vec![Proved::of(wrong())], ..Proofs::default() };
        let json = serde_json::to_value(&proofs).unwrap();
        let claim = &json["equations"][0]["claims"][0];
        assert_eq!(claim["status"], "refuted");
        let c = claim["counterexample"]["c"].as_str().unwrap();
        assert!(c.parse::<crate::number::Exact>().unwrap() > crate::number::Exact::from(0), "{c}");
    }
}
