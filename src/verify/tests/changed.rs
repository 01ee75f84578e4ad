//! Wrong formulas in process: what the number systems make of every change of a formula, and what is
//! reported of one.

use super::super::checker::Judge;
use super::super::*;
use crate::formula::Hypothesis;
use crate::proof::controls::{Effect, Operator, What, changes, controls};
use std::collections::BTreeMap;

type Drawn = BTreeMap<String, (Vec<Hypothesis>, Vec<Option<Case<Exact>>>)>;

/// The claims that fail in some case.
fn findings<J: Judge>(judge: J, claims: &[Statement], drawn: &Drawn) -> Vec<(&'static str, &'static str)> {
    let checker = Checker::with(judge, claims, Vec::new());
    let heads = checker.heads();
    let mut found = Vec::new();
    for (given, cases) in drawn.values() {
        for (place, tally) in checker.check(given, &|_| true, cases) {
            let row = tally.into_row(heads[place].clone(), None);
            assert_eq!(row.decided + row.undecided, cases.len() as u64);
            found.extend((row.status == Status::Failed).then_some((row.equation, row.claim)));
        }
    }
    found
}

/// Each change of a formula fails some claim that speaks of it, in rationals or in balls; and what is
/// proved to change nothing fails none.
#[test]
fn every_change_of_a_formula_is_a_finding() {
    const CASES: u64 = 6;
    let mut drawn = Drawn::new();
    let claims = || claims().filter(|claim| !claim.contains_rounding());
    for claim in claims() {
        let cases = || (0..CASES).map(|i| super::super::drawn(1, i, claim.stated_hypotheses())).collect();
        drawn
            .entry(format!("{:?}", claim.stated_hypotheses()))
            .or_insert_with(|| (claim.stated_hypotheses().to_vec(), cases()));
    }
    let all: Vec<_> = claims().cloned().collect();
    assert_eq!(findings(Exactly, &all, &drawn), []);
    assert_eq!(findings(Floats(0f64), &all, &drawn), []);
    let seen = |(change, effect): &(Change, Effect)| {
        let touched = all.iter().filter(|claim| {
            let mut formulas = claim.goals().iter().flat_map(|goal| goal.proposition.trees());
            formulas.any(|tree| change.rewrite(tree) != *tree)
        });
        let changed = |claim: &Statement| {
            claim.map(&|tree| change.rewrite(tree)).only_assuming(claim.stated_hypotheses())
        };
        let changed: Vec<_> = touched.map(changed).collect();
        let found = findings(Exactly, &changed, &drawn);
        let found = if found.is_empty() { findings(Floats(0f64), &changed, &drawn) } else { found };
        let wrong = matches!(effect, Effect::Noticed { .. });
        (found.is_empty() == wrong).then(|| format!("{change}: {found:?}"))
    };
    let changes = controls(&statements(), registry()).changes;
    assert!(changes.len() > 600);
    let amiss: Vec<_> = changes.par_iter().filter_map(seen).collect();
    assert!(amiss.is_empty(), "{amiss:#?}");
}

fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The sample in the book of a report with a mistake in it: c − ε for c + ε in the stiffness by penalty.
#[test]
fn the_book_shows_where_to_look_after_a_mistake() {
    let stiffness = registry().formula("penalty::total_stiffness").unwrap();
    let of_sum = |change: &&Change| {
        (change.site, change.what) == (stiffness.tree.site(), What::Opposite(Operator::Add))
    };
    let statements = statements();
    let mistake = changes(&statements, registry()).iter().find(of_sum).copied().unwrap();
    let mistaken = |s: Statement| mistake.apply(&s).unwrap_or(s);
    let statements = statements.into_iter().map(mistaken).collect();
    let options = Options { scalars: Vec::new(), cases: 1, seed: 1, equations: Vec::new() };
    let report = run(&[], statements, &options, &|_, _| ());
    let [suspect] = &report.suspects[..] else { panic!("{:?}", report.suspects) };
    let [repair] = &report.repairs[..] else { panic!("{:?}", report.repairs) };
    let entry = crate::claims::entry(suspect.equation.unwrap()).unwrap();
    let of_entry = |row: &&Row| row.equation == entry.equation && row.status == Status::Failed;
    let row = report.rows.iter().find(of_entry).unwrap();
    let sample = format!(
        "{} {}: look here first of {} claims that speak of it, {} are not proved \
         with {repair} every claim would be proved {} {} NOT PROVED {} {} {} {} FAILED",
        entry.label(),
        suspect.function,
        suspect.unproved + suspect.proved,
        suspect.unproved,
        row.equation,
        row.claim,
        row.why.as_ref().unwrap(),
        row.point().unwrap(),
        row.equation,
        row.claim,
    );
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/command.md");
    let page = in_one_line(&std::fs::read_to_string(page).unwrap());
    assert!(page.contains(&in_one_line(&sample)), "book/src/command.md shows something else than {sample}");
}
