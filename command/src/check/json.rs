//! The report as JSON: quantities are texts, and every key is always present.

use super::program::request;
use super::report::rounding;
use super::{Options, Subject};
use crate::args::format_exact;
use crate::output::record;
use serde::Serialize;
use serde_json::value::RawValue;
use spring_mass_contact::check::{
    AnswerVerdict, CaseResult, FailureCondition, FamilyResult, Reply, Report, Threshold,
};
use spring_mass_contact::number::Exact;
use spring_mass_contact::rug::float::Round;

/// Number of digits of an error.
const DIGITS: usize = 6;

/// Returns the report with what is checked and the options.
pub fn report(of: &Subject, options: &Options, report: &Report) -> impl Serialize {
    record! {
        program: (of.kind == "program").then(|| of.name.clone()),
        answers: (of.kind == "answers").then(|| of.name.clone()),
        missing: of.missing.iter().map(|problem| problem.id.clone()).collect::<Vec<_>>(),
        seed: options.drawn.seed,
        tolerance: format_exact(&options.tolerance.value),
        cases: report.cases(),
        given_up: report.given_up,
        summary: report.summary(),
        families: report.families().iter().map(family).collect::<Vec<_>>(),
        repeated: report.repeated,
        changed: report.changed.iter().map(|change| id(report, change.of)).collect::<Vec<_>>(),
        carried_over: report.carried_over.iter().map(|pair| pair.map(|i| id(report, i))).collect::<Vec<_>>(),
        conditions: report.conditions.iter().map(condition).collect::<Vec<_>>(),
        absolute_bounds: report.absolute_bounds.each_ref().map(error),
        apparent_penalty: &report.apparent_penalty,
        diagnosis: &report.diagnosis,
    }
}

fn id(report: &Report, i: usize) -> &str {
    &report.results[i].problem.id
}

fn family<'a>(row: &FamilyResult<'a>) -> impl Serialize + use<'a> {
    record! {
        family: row.family,
        cases: row.cases,
        verdict: row.verdict,
        worst_deflection: error(&row.worst_deflection),
        worst_force: error(&row.worst_force),
        counterexample: (row.verdict > AnswerVerdict::WithinTolerance).then(|| counterexample(row.worst)),
    }
}

fn condition(condition: &FailureCondition) -> impl Serialize + use<> {
    record! {
        state: condition.state,
        threshold: condition.threshold.as_ref().map(threshold),
    }
}

fn threshold(threshold: &Threshold) -> impl Serialize + use<> {
    let [wrong, right] = rounding(threshold);
    record! {
        quantity: threshold.quantity,
        wrong: threshold.wrong.decimal(DIGITS, wrong),
        right: threshold.right.decimal(DIGITS, right),
    }
}

fn error(x: &Option<Exact>) -> Option<String> {
    x.as_ref().map(|x| x.decimal(DIGITS, Round::Up))
}

fn counterexample(result: &CaseResult) -> impl Serialize {
    let CaseResult { problem, reply, assessment, .. } = result;
    let exact = &assessment.exact;
    let answer = match reply {
        Reply::Answered(answer) => Some(record! {
            deflection: answer.deflection.as_ref().map(format_exact),
            contact_force: answer.contact_force.as_ref().map(format_exact),
            status: &answer.status,
        }),
        _ => None,
    };
    let request = request(problem).trim_end().to_string();
    record! {
        request: RawValue::from_string(request).expect("a request is JSON"),
        answer: answer,
        finding: &assessment.finding,
        exact: record! {
            state: exact.state,
            deflection: &exact.deflection,
            penetration: &exact.penetration,
            contact_force: &exact.contact_force,
        },
        kkt: &assessment.kkt,
    }
}
