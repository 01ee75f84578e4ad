//! Wrong formulas within the process: every mutation is detected in number systems, and reported.

use super::super::checker::NumberDomain;
use super::super::*;
use crate::formula::Hypothesis;
use crate::proof::mutation::{Mutant, Mutation, MutationOutcome, Operator, test_mutations};
use std::collections::BTreeMap;

type Drawn = BTreeMap<String, (Vec<Hypothesis>, Vec<Option<Case<Exact>>>)>;

/// Returns the claims that fail in some case.
fn findings<J: NumberDomain>(
    judge: J,
    claims: &[Statement],
    drawn: &Drawn,
) -> Vec<(&'static str, &'static str)> {
    let checker = Checker::new(judge, claims, Vec::new());
    let keys = checker.keys();
    let mut found = Vec::new();
    for (hypotheses, cases) in drawn.values() {
        for (index, tally) in checker.check(hypotheses, &Options::default(), cases) {
            let result = tally.into_result(keys[index].clone(), None);
            assert_eq!(result.decided + result.undecided, cases.len() as u64);
            found.extend((result.status == Status::Failed).then_some((result.equation, result.claim)));
        }
    }
    found
}

/// Each mutation makes a claim that contains it fail, in rationals or in balls; an equivalent one makes none
/// fail.
#[test]
fn every_mutation_makes_a_claim_fail_unless_it_is_equivalent() {
    const CASES: u64 = 6;
    let mut drawn = Drawn::new();
    let claims = || claims().filter(|claim| !claim.contains_rounding());
    for claim in claims() {
        let cases =
            || (0..CASES).map(|i| super::super::cases::case(1, i, claim.stated_hypotheses())).collect();
        drawn
            .entry(format!("{:?}", claim.stated_hypotheses()))
            .or_insert_with(|| (claim.stated_hypotheses().to_vec(), cases()));
    }
    let all: Vec<_> = claims().cloned().collect();
    assert_eq!(findings(Rationals::unrounded(), &all, &drawn), []);
    assert_eq!(findings(Balls(0f64), &all, &drawn), []);
    let seen = |(change, effect): &(Mutant, MutationOutcome)| {
        let touched = all.iter().filter(|claim| {
            let mut formulas = claim.goals().iter().flat_map(|goal| goal.proposition.trees());
            formulas.any(|tree| change.rewrite(tree) != *tree)
        });
        let changed = |claim: &Statement| {
            claim.map(&|tree| change.rewrite(tree)).only_assuming(claim.stated_hypotheses())
        };
        let changed: Vec<_> = touched.map(changed).collect();
        let found = findings(Rationals::unrounded(), &changed, &drawn);
        let found = if found.is_empty() { findings(Balls(0f64), &changed, &drawn) } else { found };
        let wrong = matches!(effect, MutationOutcome::Detected { .. });
        (found.is_empty() == wrong).then(|| format!("{change}: {found:?}"))
    };
    let mutants = test_mutations(&statements(), registry()).mutants;
    assert!(mutants.len() > 600);
    let undetected: Vec<_> = mutants.par_iter().filter_map(seen).collect();
    assert!(undetected.is_empty(), "{undetected:#?}");
}

fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The sample in the book of a report with a mistake: c − ε for c + ε in the stiffness by penalty.
#[test]
fn the_book_contains_the_report_of_a_mistake() {
    let site = registry().formula("penalty::total_stiffness").unwrap().tree.site();
    let mistake = Mutant { site, mutation: Mutation::Opposite(Operator::Add) };
    let mistaken = |s: Statement| mistake.apply(&s).unwrap_or(s);
    let statements = statements().into_iter().map(mistaken).collect();
    let options = Options { scalars: Vec::new(), cases: 1, seed: 1, equations: Vec::new() };
    let report = run(&[], statements, &options, &|_, _| ());
    assert_eq!(report.shared, ["penalty::total_stiffness"]);
    let row = report.rows.iter().find(|row| row.status == Status::Failed).unwrap();
    let ClaimResult { equation, claim, .. } = row;
    let VerificationSummary { claims, proved, .. } = report.summary();
    let parts = [
        format!("{equation} {claim} NOT PROVED {}", row.reason.as_ref().unwrap()),
        format!("{} {equation} {claim} FAILED", row.point().unwrap()),
        format!("{proved} of {claims} claims proved for all values."),
        format!("Every claim that is not proved uses {}.", report.shared[0]),
    ];
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/command.md");
    let page = in_one_line(&std::fs::read_to_string(page).unwrap());
    parts.iter().map(|part| in_one_line(part)).fold(&page[..], |rest, part| {
        let place = rest.find(&part);
        let place = place
            .unwrap_or_else(|| panic!("book/src/command.md: the report of `c - eps` needs {part:?} here"));
        &rest[place + part.len()..]
    });
}
