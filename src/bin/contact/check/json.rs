//! The report as JSON has it: quantities as strings, every key always there.

use super::Options;
use super::program::request;
use crate::args::spelled;
use serde::Serialize;
use serde_json::value::RawValue;
use spring_mass_contact::chapter::contact::Kkt;
use spring_mass_contact::check::{
    Checked, Diagnosis, Family, Kind, Of, Reply, Report, Row, Summary, Threshold, Value, Verdict,
};
use spring_mass_contact::number::Exact;
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::State;

/// Digits of an error.
const DIGITS: usize = 6;

#[derive(Serialize)]
pub struct Json<'a> {
    program: &'a str,
    seed: u64,
    tolerance: String,
    cases: usize,
    given_up: bool,
    summary: Summary,
    families: Vec<JsonRow<'a>>,
    penalty: JsonPenalty,
    missed: Option<JsonThreshold>,
    held: Option<JsonThreshold>,
    diagnosis: &'a [Diagnosis],
}

#[derive(Serialize)]
struct JsonRow<'a> {
    family: Family,
    cases: usize,
    verdict: Verdict,
    worst_deflection: Option<String>,
    worst_force: Option<String>,
    counterexample: Option<Counterexample<'a>>,
}

#[derive(Serialize)]
struct Counterexample<'a> {
    request: Box<RawValue>,
    answer: Option<JsonAnswer<'a>>,
    finding: Option<&'a str>,
    exact: Solved,
    kkt: Option<&'a Kkt<Exact>>,
}

#[derive(Serialize)]
struct JsonAnswer<'a> {
    deflection: Option<String>,
    contact_force: Option<String>,
    status: Option<&'a str>,
}

#[derive(Serialize)]
struct Solved {
    state: State,
    deflection: String,
    penetration: String,
    contact_force: String,
}

#[derive(Serialize)]
struct JsonPenalty {
    kind: Kind,
    value: Option<String>,
    spread: Option<String>,
}

#[derive(Serialize)]
struct JsonThreshold {
    count: usize,
    of: Of,
    up_to: String,
    from: String,
}

pub fn of<'a>(program: &'a str, options: &Options, report: &'a Report) -> Json<'a> {
    let penalty = &report.penalty;
    let row = |row: Row<'a>| JsonRow {
        family: row.family,
        cases: row.cases,
        verdict: row.verdict,
        worst_deflection: error(&row.worst_deflection),
        worst_force: error(&row.worst_force),
        counterexample: (row.verdict > Verdict::WithinTolerance).then(|| counterexample(row.worst)),
    };
    Json {
        program,
        seed: options.drawn.seed,
        tolerance: spelled(&options.tolerance.value),
        cases: report.checked.len(),
        given_up: report.given_up,
        summary: report.summary(),
        families: report.families().into_iter().map(row).collect(),
        penalty: JsonPenalty {
            kind: penalty.kind,
            value: penalty.value.as_ref().map(|value| value.decimal(DIGITS, Round::Nearest)),
            spread: error(&penalty.spread),
        },
        missed: report.missed.as_ref().map(threshold),
        held: report.held.as_ref().map(threshold),
        diagnosis: &report.diagnosis,
    }
}

fn threshold(threshold: &Threshold) -> JsonThreshold {
    let Threshold { count, of, up_to, from } = threshold;
    let text = |x: &Exact, round| x.decimal(DIGITS, round);
    JsonThreshold { count: *count, of: *of, up_to: text(up_to, Round::Up), from: text(from, Round::Down) }
}

fn error(x: &Option<Exact>) -> Option<String> {
    x.as_ref().map(|x| x.decimal(DIGITS, Round::Up))
}

fn counterexample(checked: &Checked) -> Counterexample<'_> {
    let judgement = &checked.judgement;
    let text = |value: &Value| value.as_ref().map(spelled);
    let answer = match &checked.reply {
        Reply::Answered(answer) => Some(JsonAnswer {
            deflection: text(&answer.deflection),
            contact_force: text(&answer.contact_force),
            status: answer.status.as_deref(),
        }),
        _ => None,
    };
    let exact = &judgement.exact;
    Counterexample {
        request: RawValue::from_string(request(&checked.problem).trim_end().to_string())
            .expect("a request is JSON"),
        answer,
        finding: judgement.finding.as_deref(),
        exact: Solved {
            state: exact.state,
            deflection: exact.deflection.to_string(),
            penetration: exact.penetration.to_string(),
            contact_force: exact.contact_force.to_string(),
        },
        kkt: judgement.kkt.as_ref(),
    }
}
