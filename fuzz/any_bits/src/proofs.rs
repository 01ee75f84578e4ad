//! Proofs of claims with random changes, which must not prove a false statement.

use crate::bytes::Bytes;
use serde_json::Value;
use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::formula::Statement;
use spring_mass_contact::proof::check::{Node, check};
use spring_mass_contact::proof::mutation::mutants;
use spring_mass_contact::proof::{prove, refute};
use std::sync::LazyLock;

/// Maximum length of a proof as text, so that an execution is short.
const MAX_LENGTH: usize = 6000;

/// Number of false statements for each claim.
const MUTATIONS: usize = 4;

/// A claim, its mutations that numbers refute, and its proof.
struct Claim {
    statement: Statement,
    false_statements: Vec<Statement>,
    proof: Value,
    /// The places of all values in the proof, as JSON pointers.
    places: Vec<String>,
}

static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| statements().into_iter().filter_map(claim).collect());

fn claim(statement: Statement) -> Option<Claim> {
    if statement.kind() == "drift" {
        return None;
    }
    let proof = serde_json::to_value(prove(&statement).expect("a claim").goals()).expect("a proof is data");
    if proof.to_string().len() > MAX_LENGTH {
        return None;
    }
    let all = mutants(std::slice::from_ref(&statement), registry());
    let changed = all.iter().filter_map(|mutant| mutant.apply(&statement));
    let false_statements: Vec<_> =
        changed.filter(|changed| refute(changed).is_some()).take(MUTATIONS).collect();
    let mut places = Vec::new();
    collect_places(&proof, String::new(), &mut places);
    (!false_statements.is_empty()).then_some(Claim { statement, false_statements, proof, places })
}

fn collect_places(value: &Value, place: String, all: &mut Vec<String>) {
    match value {
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                collect_places(item, format!("{place}/{i}"), all);
            }
        }
        Value::Object(fields) => {
            for (name, field) in fields {
                collect_places(field, format!("{place}/{name}"), all);
            }
        }
        _ => {}
    }
    all.push(place);
}

/// Changes a part of a proof.
fn change(part: &mut Value, bytes: &mut Bytes) {
    const NAMES: [&str; 5] = ["positive", "non_negative", "zero", "atom", "by_sign"];
    match part {
        Value::Number(n) => {
            let n = n.as_u64().unwrap_or(0);
            *part = (*bytes.pick(&[n + 1, n.saturating_sub(1), 0, n + 2])).into();
        }
        Value::String(text) => {
            *text = match text.parse::<i128>() {
                Ok(n) => bytes.pick(&[n + 1, n - 1, -n, 2 * n]).to_string(),
                Err(_) => bytes.pick(&NAMES).to_string(),
            }
        }
        Value::Array(items) if !items.is_empty() => {
            let [i, j] = [(); 2].map(|()| bytes.bits() as usize % items.len());
            match bytes.below(3) {
                0 => drop(items.remove(i)),
                1 => items.insert(i, items[j].clone()),
                _ => items.swap(i, j),
            }
        }
        other => *other = Value::Null,
    }
}

/// A proof of a claim with one to four changes proves none of the claim's mutations that numbers refute.
pub fn prove_nothing(bytes: &[u8]) {
    let mut bytes = Bytes(bytes);
    let claim = &CLAIMS[bytes.bits() as usize % CLAIMS.len()];
    let mut proof = claim.proof.clone();
    for _ in 0..=bytes.below(4) {
        let [place, other] = [(); 2].map(|()| &claim.places[bytes.bits() as usize % claim.places.len()]);
        // An earlier change may have removed the place.
        let Some(part) = proof.pointer_mut(place) else { continue };
        match (bytes.one_in(3), claim.proof.pointer(other)) {
            (true, Some(other)) => *part = other.clone(),
            _ => change(part, &mut bytes),
        }
    }
    let Ok(goals) = serde_json::from_value::<Vec<Node>>(proof) else { return };
    let _ = check(&claim.statement, &goals);
    for statement in &claim.false_statements {
        assert!(check(statement, &goals).is_err(), "{statement:?} by {goals:?}");
    }
}
