//! Proofs of claims with random changes, which must not prove a false statement.

use crate::strategies::*;
use proptest::collection::vec;
use proptest::sample::Index;
use serde_json::Value;
use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::formula::Statement;
use spring_mass_contact::proof::check::{Node, check};
use spring_mass_contact::proof::mutation::mutants;
use spring_mass_contact::proof::{prove, refute};
use std::sync::LazyLock;

/// Maximum length of a proof as text, so that a change is tested quickly.
const MAX_LENGTH: usize = 6000;

/// A claim, some of its mutations that numbers refute, its proof, and the places of all values in it.
struct Claim {
    statement: Statement,
    false_statements: Vec<Statement>,
    proof: Value,
    places: Vec<String>,
}

static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| {
    let all = statements().into_iter().filter(|statement| statement.kind() != "drift");
    let some = all.step_by(if is_deep() { 1 } else { 8 });
    some.filter_map(claim).collect()
});

fn claim(statement: Statement) -> Option<Claim> {
    let proof = serde_json::to_value(prove(&statement).unwrap().goals()).unwrap();
    let all = mutants(std::slice::from_ref(&statement), registry());
    let changed = all.iter().filter_map(|mutant| mutant.apply(&statement));
    let false_statements: Vec<_> = changed.filter(|changed| refute(changed).is_some()).take(4).collect();
    let mut places = Vec::new();
    collect_places(&proof, String::new(), &mut places);
    let is_usable = proof.to_string().len() <= MAX_LENGTH && !false_statements.is_empty();
    is_usable.then_some(Claim { statement, false_statements, proof, places })
}

/// Collects the JSON pointers to a value and to all values in it.
fn collect_places(value: &Value, place: String, all: &mut Vec<String>) {
    match value {
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(i, item)| collect_places(item, format!("{place}/{i}"), all));
        }
        Value::Object(fields) => {
            fields.iter().for_each(|(name, field)| collect_places(field, format!("{place}/{name}"), all));
        }
        _ => {}
    }
    all.push(place);
}

/// Changes a part of a proof.
fn change(part: &mut Value, kind: Index, [i, j]: [Index; 2]) {
    match part {
        Value::Number(n) => {
            let n = n.as_u64().unwrap_or(0);
            *part = kind.get(&[n + 1, n.saturating_sub(1), 0, n + 2]).to_owned().into();
        }
        Value::String(text) => {
            *text = match text.parse::<i128>() {
                Ok(n) => kind.get(&[n + 1, n - 1, -n, 2 * n]).to_string(),
                Err(_) => kind.get(&["positive", "non_negative", "zero", "atom", "by_sign"]).to_string(),
            }
        }
        Value::Array(items) if !items.is_empty() => {
            let [i, j] = [i.index(items.len()), j.index(items.len())];
            match kind.index(3) {
                0 => drop(items.remove(i)),
                1 => items.insert(i, items[j].clone()),
                _ => items.swap(i, j),
            }
        }
        other => *other = Value::Null,
    }
}

/// A proof of a claim with one to four changes proves none of the claim's mutations that numbers refute.
#[test]
fn no_changed_proof_proves_a_false_statement() {
    let index = || any::<Index>();
    let changes = vec((index(), index(), index(), [index(), index()]), 1..=4);
    holds((index(), changes), |(claim, changes)| {
        let claim = claim.get(&CLAIMS);
        let mut proof = claim.proof.clone();
        for (place, other, kind, items) in changes {
            // An earlier change may have removed the place.
            let Some(part) = proof.pointer_mut(place.get(&claim.places[..]).as_str()) else { continue };
            match claim.proof.pointer(other.get(&claim.places[..]).as_str()) {
                Some(other) if kind.index(3) == 0 => *part = other.clone(),
                _ => change(part, *kind, *items),
            }
        }
        let Ok(goals) = serde_json::from_value::<Vec<Node>>(proof) else { return };
        let _ = check(&claim.statement, &goals);
        for statement in &claim.false_statements {
            assert!(check(statement, &goals).is_err(), "{statement:?} by {goals:?}");
        }
    });
}
