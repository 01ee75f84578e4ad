//! The report as JSON: quantities are texts, and every key is always present.

use super::Options;
use super::program::request;
use crate::args::format_exact;
use crate::output::record;
use serde::Serialize;
use serde_json::value::RawValue;
use spring_mass_contact::check::{CaseResult, Condition, Reply, Report, Row, Threshold, Value, Verdict};
use spring_mass_contact::number::Exact;
use spring_mass_contact::rug::float::Round;

/// Number of digits of an error.
const DIGITS: usize = 6;

/// Returns the report with the program and the options.
pub fn report(program: &str, options: &Options, report: &Report) -> impl Serialize {
    let id = |i: usize| &report.results[i].problem.id;
    record! {
        program: program.to_string(),
        seed: options.drawn.seed,
        tolerance: format_exact(&options.tolerance.value),
        cases: report.cases(),
        given_up: report.given_up,
        summary: report.summary(),
        families: report.families().iter().map(family).collect::<Vec<_>>(),
        repeated: report.repeated,
        changed: report.changed.iter().map(|again| id(again.of)).collect::<Vec<_>>(),
        carried_over: report.carried_over.iter().map(|both| both.map(id)).collect::<Vec<_>>(),
        conditions: report.conditions.iter().map(condition).collect::<Vec<_>>(),
        absolute_bounds: report.absolute_bounds.each_ref().map(error),
        diagnosis: &report.diagnosis,
    }
}

fn family<'a>(row: &Row<'a>) -> impl Serialize + use<'a> {
    record! {
        family: row.family,
        cases: row.cases,
        verdict: row.verdict,
        worst_deflection: error(&row.worst_deflection),
        worst_force: error(&row.worst_force),
        counterexample: (row.verdict > Verdict::WithinTolerance).then(|| counterexample(row.worst)),
    }
}

fn condition(condition: &Condition) -> impl Serialize + use<> {
    record! {
        state: condition.state,
        threshold: condition.threshold.as_ref().map(threshold),
    }
}

fn threshold(threshold: &Threshold) -> impl Serialize + use<> {
    let [wrong, right] =
        if threshold.is_below() { [Round::Up, Round::Down] } else { [Round::Down, Round::Up] };
    record! {
        quantity: threshold.quantity,
        wrong: threshold.wrong.decimal(DIGITS, wrong),
        right: threshold.right.decimal(DIGITS, right),
    }
}

fn error(x: &Option<Exact>) -> Option<String> {
    x.as_ref().map(|x| x.decimal(DIGITS, Round::Up))
}

fn counterexample(checked: &CaseResult) -> impl Serialize {
    let judgement = &checked.assessment;
    let exact = &judgement.exact;
    let text = |value: &Value| value.as_ref().map(format_exact);
    let answer = match &checked.reply {
        Reply::Answered(answer) => Some(record! {
            deflection: text(&answer.deflection),
            contact_force: text(&answer.contact_force),
            status: &answer.status,
        }),
        _ => None,
    };
    let request = request(&checked.problem).trim_end().to_string();
    record! {
        request: RawValue::from_string(request).expect("a request is JSON"),
        answer: answer,
        finding: &judgement.finding,
        exact: record! {
            state: exact.state,
            deflection: &exact.deflection,
            penetration: &exact.penetration,
            contact_force: &exact.contact_force,
        },
        kkt: &judgement.kkt,
    }
}
