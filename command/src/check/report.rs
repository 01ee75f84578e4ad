//! The report as a table and as Markdown.

use super::Subject;
use crate::args::{Number, format_exact};
use crate::lines::NO_BREAK_SPACE;
use crate::output::{self, counted, shortened};
use spring_mass_contact::check::{
    Answer, AnswerVerdict, ApparentPenalty, CaseResult, Diagnosis, DiagnosisScope, FamilyResult, INFORMATIVE,
    Problem, Reply, Report, Threshold, ThresholdQuantity, VerdictCounts,
};
use spring_mass_contact::number::Exact;
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::State;
use std::io::{self, Write};

/// Number of digits of an error, and of a number beside another.
const ERROR_DIGITS: usize = 2;
const VALUE_DIGITS: usize = 12;

/// Largest number of families with an example; JSON has all.
const MAX_EXAMPLES: usize = 3;

/// Largest number of named mistakes that explain the same answers; JSON has all.
const MAX_NAMED: usize = 4;

/// Prints the number of answers of each kind, the families, examples of failures, and findings.
pub fn table(out: &mut dyn Write, of: &Subject, report: &Report, tolerance: &Number) -> io::Result<()> {
    let within = format!("within {}", shortened(&tolerance.text));
    let (systems, missing) = (counts(report, &within), listed(&of.missing));
    output::list(out, [(of.kind, of.name.clone()), ("systems", systems), ("missing", missing)])?;
    writeln!(out)?;
    let families = report.families();
    output::table(out, NAMES, families.iter().map(|row| cells(row, &within)), ..)?;
    writeln!(out)?;
    writeln!(out, " u relative to |H − l| + |m g / c|, N relative to |m g| + |c (H − l)|; right:")?;
    writeln!(out, " within the rounding error of f64; within: within the tolerance.")?;
    let bad: Vec<_> = families.iter().filter(|row| row.verdict > AnswerVerdict::WithinTolerance).collect();
    for row in bad.iter().take(MAX_EXAMPLES) {
        writeln!(out)?;
        example(out, row.worst)?;
    }
    if !bad.is_empty() {
        writeln!(out, "\n --format json contains an example of each failing family with its request.")?;
    }
    findings(out, report, tolerance)
}

/// Lists the first ids of systems without a row.
fn listed(missing: &[Problem]) -> String {
    let ids = missing.iter().map(|problem| &*problem.id).collect::<Vec<_>>().join(", ");
    if ids.is_empty() { ids } else { format!("{}: {}", missing.len(), shortened(&ids)) }
}

fn counts(report: &Report, within: &str) -> String {
    let VerdictCounts { right, within_tolerance, wrong, refused, crashed, timed_out } = report.summary();
    let counts = [
        (right, "right"),
        (within_tolerance, within),
        (wrong, "wrong"),
        (refused, "refused"),
        (crashed, "crashed"),
        (timed_out, "not answered in time"),
    ];
    let counts = counts.iter().filter(|(count, _)| *count > 0).map(|(count, kind)| format!("{count} {kind}"));
    format!("{}: {}", report.cases(), counts.collect::<Vec<_>>().join(", "))
}

/// Prints findings, each after a blank line; a diagnosis with its program.
fn findings(out: &mut dyn Write, report: &Report, tolerance: &Number) -> io::Result<()> {
    let lag = report.lag();
    for (finding, diagnosis) in [
        (given_up(report), None),
        (families_refused(report), None),
        (changed(report), None),
        (carried_over(report), None),
        (absolute(report), None),
        (lag.map(lagging), lag),
        (diagnosed(report), report.fitting().next()),
        (conditions(report), None),
        (unexplained(report), None),
        (penetrating(report), None),
        (report.holds().then(|| tested(report, tolerance)), None),
    ] {
        let Some(finding) = finding else { continue };
        writeln!(out)?;
        output::wrapped(out, " ", 1, &finding)?;
        let program = diagnosis.map_or(&[][..], |diagnosis| &diagnosis.program);
        program.iter().try_for_each(|line| output::wrapped(out, "   ", 3, line))?;
    }
    Ok(())
}

pub fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    output::markdown(out, NAMES, report.families().iter().map(|row| cells(row, "within tolerance")))
}

/// Columns of the table of families.
const NAMES: [&str; 5] = ["family", "systems", "verdict", "u off by", "N off by"];

fn cells(row: &FamilyResult, within: &str) -> [String; 5] {
    let verdict = match row.verdict {
        AnswerVerdict::WithinTolerance => within.to_string(),
        AnswerVerdict::TimedOut => "not in time".to_string(),
        verdict => verdict.to_string(),
    };
    let some = row.verdict > AnswerVerdict::WithinTolerance && row.count < row.cases;
    let of = if some { format!(": {} of {}", row.count, row.cases) } else { String::new() };
    let [u, n] = [&row.worst_deflection, &row.worst_force]
        .map(|error| error.as_ref().map_or(String::new(), upper_bound));
    [row.family.to_string(), row.cases.to_string(), verdict + &of, u, n]
}

fn upper_bound(x: &Exact) -> String {
    x.decimal(ERROR_DIGITS, Round::Up)
}

/// Prints a system with a wrong answer.
fn example(out: &mut dyn Write, result: &CaseResult) -> io::Result<()> {
    let CaseResult { problem, reply, assessment, .. } = result;
    let system = problem.system.as_ref().map(|x| shortened(&format_exact(x))).to_string();
    let penalty = problem.penalty.as_ref().map(|eps| format!(", ε = {} N/m", format_exact(eps)));
    let mut rows = vec![(&*problem.id, parts(&(system + &penalty.unwrap_or_default())))];
    if let Reply::Answered(answer) = reply {
        let status = answer.status.as_ref().map(|status| format!("; reported status “{status}”"));
        rows.push(("answer", parts(&numbers(answer, VALUE_DIGITS)) + &status.unwrap_or_default()));
    }
    let [u, n] = [&assessment.exact.deflection, &assessment.exact.contact_force]
        .map(|x| x.decimal(VALUE_DIGITS, Round::Nearest));
    rows.push(("exact", parts(&format!("u = {u} m, N = {n} N"))));
    if let (Some(u), Some(n)) = (&assessment.deflection_error, &assessment.force_error) {
        let [u, n] = [u, n].map(upper_bound);
        rows.push(("off by", format!("{u} of the scale of u, {n} of that of N")));
    }
    rows.extend(assessment.kkt.as_ref().map(|kkt| ("residuals", parts(&kkt.to_string()))));
    rows.extend(assessment.finding.clone().map(|finding| ("finding", finding)));
    let width = problem.id.len().max("residuals".len());
    rows.iter()
        .try_for_each(|(name, text)| output::wrapped(out, &format!(" {name:<width$}  "), width + 3, text))
}

/// Formats u and N of an answer.
fn numbers(answer: &Answer, digits: usize) -> String {
    let numbers = [("u", &answer.deflection, "m"), ("N", &answer.contact_force, "N")];
    let numbers = numbers.map(|(name, x, unit)| match x {
        Some(x) => format!("{name} = {} {unit}", x.decimal(digits, Round::Nearest)),
        None => format!("{name} is not a number"),
    });
    numbers.join(", ")
}

/// Breaks a list only after its commas.
fn parts(list: &str) -> String {
    unbroken(list).replace(&format!(",{NO_BREAK_SPACE}"), ", ")
}

fn unbroken(text: &str) -> String {
    text.replace(' ', &NO_BREAK_SPACE.to_string())
}

fn given_up(report: &Report) -> Option<String> {
    let n = report.results.len();
    report.given_up.then(|| format!("It answered none of the first {n} systems, so the others were skipped."))
}

/// Describes a program whose answers depend on more than the request.
fn changed(report: &Report) -> Option<String> {
    let first = report.changed.first()?;
    let result = &report.results[first.of];
    let [before, now] = [&result.reply, &first.reply].map(|reply| match reply {
        Reply::Answered(answer) => numbers(answer, 6),
        _ => "no answer".to_string(),
    });
    Some(format!(
        "The program carries something over from earlier requests, or is random: of {} requests that were \
         repeated in another order, {} have another answer. {}: first {before}, then {now}.",
        report.repeated,
        report.changed.len(),
        result.problem.id,
    ))
}

/// Describes answers that are those of earlier requests.
fn carried_over(report: &Report) -> Option<String> {
    let [id, earlier] = report.carried_over.first()?.map(|i| &report.results[i].problem.id);
    let (count, wrong) = (report.carried_over.len(), report.summary().wrong);
    Some(format!(
        "The program carries something over from earlier requests: {count} of {wrong} wrong answers are the \
         right ones of an earlier request; that to {id} is that to {earlier}."
    ))
}

/// Describes the conditions under which answers are wrong.
fn conditions(report: &Report) -> Option<String> {
    let first = report.conditions.first()?;
    let of = match first.state {
        Some(State::Contact) => " in contact",
        Some(State::Separated) => " without contact",
        Some(State::Grazing) => " with R = 0",
        None => "",
    };
    let clauses =
        report.conditions.iter().filter_map(|condition| condition.threshold.as_ref()).take(MAX_EXAMPLES);
    let clauses: Vec<_> = clauses.map(clause).collect();
    let of = match clauses[..] {
        [] if first.state == Some(State::Grazing) => format!("systems{of}"),
        [] => format!("all {} systems{of}", report.summary().wrong),
        _ => format!("systems{of} with {}", clauses.join(", or ")),
    };
    let others = if clauses.len() > 1 { " More cases may tell which of these matters." } else { "" };
    let disregarded = match report.disregarded {
        0 => String::new(),
        n => format!(
            ", where {} that the mistake does not change are disregarded",
            counted(n as u64, "right answer", "right answers")
        ),
    };
    Some(format!("The {} wrong answers are to {of}{disregarded}.{others}", report.summary().wrong))
}

/// Says that wrong answers are explained by nothing, so that nobody waits for a diagnosis.
fn unexplained(report: &Report) -> Option<String> {
    let is_wrong = |result: &CaseResult| {
        result.assessment.verdict == AnswerVerdict::Wrong && matches!(result.reply, Reply::Answered(_))
    };
    let explained = report.fitting().next().is_some()
        || report.lag().is_some()
        || !(report.conditions.is_empty() && report.changed.is_empty() && report.carried_over.is_empty())
        || report.absolute_bounds.iter().any(Option::is_some);
    let text = match report.results.iter().filter(|result| is_wrong(result)).count() {
        0 => return None,
        1..INFORMATIVE => "Fewer than three wrong answers do not determine a mistake.",
        _ => "No single mistake that is searched for explains the wrong answers.",
    };
    (!explained).then(|| text.to_string())
}

/// Describes wrong answers that have a penalty each.
fn penetrating(report: &Report) -> Option<String> {
    let ApparentPenalty { unit, range } = report.apparent_penalty.as_ref()?;
    let text = |eps: &Exact| unbroken(&format!("{} {unit}", eps.decimal(ERROR_DIGITS + 1, Round::Nearest)));
    let [least, most] = range.each_ref().map(text);
    Some(format!(
        "Where rounding does not hide p = l + u − H, the wrong answers are in equilibrium with p > 0, as by a \
         penalty N/p from {least} to {most}."
    ))
}

/// Formats a threshold: `|R|/c up to 9.9e-7 m (right from 1.3e-6 m on)`.
fn clause(threshold: &Threshold) -> String {
    let Threshold { quantity, wrong, right } = threshold;
    let digits = if *quantity == ThresholdQuantity::Position { VALUE_DIGITS } else { ERROR_DIGITS };
    let [round_wrong, round_right] = rounding(threshold);
    let [wrong, right] = [(wrong, round_wrong), (right, round_right)]
        .map(|(x, round)| unbroken(&(x.decimal(digits, round) + quantity.unit())));
    let symbol = unbroken(quantity.symbol());
    if threshold.is_below() {
        format!("{symbol} up to {wrong} (right from {right} on)")
    } else {
        format!("{symbol} from {wrong} on (right up to {right})")
    }
}

/// Returns the rounding of both ends of a threshold, outwards from it.
pub fn rounding(threshold: &Threshold) -> [Round; 2] {
    if threshold.is_below() { [Round::Up, Round::Down] } else { [Round::Down, Round::Up] }
}

/// Describes the scope of the test if nothing is wrong.
fn tested(report: &Report, tolerance: &Number) -> String {
    let [missed, false_contact] = [State::Contact, State::Separated].map(|state| {
        let least = report.least_deciding(state, &tolerance.value);
        let force = least.map(|x| unbroken(&format!("|R| = {} (|m g| + |c (H − l)|)", upper_bound(&x))));
        force
            .map_or("would not be detected".to_string(), |force| format!("would be detected from {force} on"))
    });
    format!(
        "No error above {} was found in {} of {}, with one unknown and one plane. Missed contact {missed}, \
         false contact {false_contact}.",
        shortened(&tolerance.text),
        counted(report.cases() as u64, "system", "systems"),
        counted(report.families().len() as u64, "family", "families"),
    )
}

/// Describes families without answers if they alone leave the result open.
fn families_refused(report: &Report) -> Option<String> {
    let families = report.families();
    let refused = families.iter().filter(|row| row.verdict == AnswerVerdict::Refused && row.right == 0);
    let names = Vec::from_iter(refused.map(|row| row.family.name()));
    let names = names.join(", ");
    (!names.is_empty()).then(|| format!("Every system of {names} was refused, so its result is unknown."))
}

fn lagging(lag: &Diagnosis) -> String {
    format!("The reported steps of all {} systems show it: {}.", lag.of, lag.name)
}

/// Names a mistake, and two others with the same results.
fn named(diagnosis: &Diagnosis) -> String {
    let Diagnosis { name, equivalent, .. } = diagnosis;
    let others: Vec<_> = equivalent.iter().take(2).map(|other| format!(", or {other}")).collect();
    format!("{name}{}", others.concat())
}

/// Names the mistakes that explain the answers.
fn diagnosed(report: &Report) -> Option<String> {
    let (count, mut names) = (report.fitting().count(), Vec::from_iter(report.fitting().map(named)));
    names.truncate(MAX_NAMED);
    let more = if count > MAX_NAMED { "; …" } else { "" };
    let Diagnosis { answers, of, .. } = report.fitting().next()?;
    let (which, others) = match answers {
        DiagnosisScope::Wrong => ("wrong answers", ", but not the right ones"),
        _ => ("answers", ""),
    };
    Some(match &names[..] {
        [only] => format!("One mistake explains all {of} {which}{others}: {only}."),
        _ => format!(
            "Each of {count} mistakes explains all {of} {which}{others}: {}{more}. More families or cases may tell \
             which it is. The first one:",
            names.join("; "),
        ),
    })
}

/// Describes errors that do not grow with the systems.
fn absolute(report: &Report) -> Option<String> {
    let [u, n, residual] = report.absolute_bounds.each_ref().map(|bound| bound.as_ref().map(upper_bound));
    let residual = residual.filter(|_| u.is_none() && n.is_none());
    let bounds = [("u", u, "m"), ("N", n, "N"), ("m g − c u − N", residual, "N")];
    let bounds =
        bounds.into_iter().filter_map(|(name, bound, unit)| Some(format!("{} {unit} of {name}", bound?)));
    let bounds = bounds.collect::<Vec<_>>().join(", ");
    (!bounds.is_empty()).then(|| {
        format!(
            "The errors do not grow with the systems; the largest is {bounds}. An absolute tolerance, or a \
             constant, has this effect."
        )
    })
}

#[cfg(test)]
mod tests;
