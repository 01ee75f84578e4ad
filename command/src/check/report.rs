//! The report as a table and as Markdown.

use crate::args::{Number, format_exact};
use crate::lines::NO_BREAK_SPACE;
use crate::output::{self, shortened};
use spring_mass_contact::check::{
    Answer, CaseResult, Diagnosis, DiagnosisScope, Quantity, Reply, Report, Row, Summary, Threshold, Value,
    Verdict,
};
use spring_mass_contact::number::Exact;
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::State;
use std::io::{self, Write};

/// Number of digits of an error, and of a number beside another.
const FEW: usize = 2;
const DIGITS: usize = 12;

/// Largest number of families with an example; JSON has all.
const EXAMPLES: usize = 3;

pub fn table(out: &mut dyn Write, program: &str, report: &Report, tolerance: &Number) -> io::Result<()> {
    let Summary { right, within_tolerance, wrong, refused, crashed, timed_out } = report.summary();
    let within = format!("within {}", shortened(&tolerance.text));
    let counts = [
        (right, "right"),
        (within_tolerance, &*within),
        (wrong, "wrong"),
        (refused, "refused"),
        (crashed, "crashed"),
        (timed_out, "not answered in time"),
    ];
    let counts = counts.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}"));
    let counts = format!("{}: {}", report.cases(), counts.collect::<Vec<_>>().join(", "));
    output::list(out, [("program", program.to_string()), ("systems", counts)])?;
    writeln!(out)?;
    let families = report.families();
    output::table(out, NAMES, families.iter().map(|row| cells(row, &within)), ..)?;
    writeln!(out)?;
    writeln!(out, " u relative to |H − l| + |m g / c|, N relative to |m g| + |c (H − l)|; right:")?;
    writeln!(out, " within the rounding error of f64; within: within the tolerance.")?;
    let bad: Vec<_> = families.iter().filter(|row| row.verdict > Verdict::WithinTolerance).collect();
    for row in bad.iter().take(EXAMPLES) {
        writeln!(out)?;
        example(out, row.worst)?;
    }
    if !bad.is_empty() {
        writeln!(out, "\n --format json contains an example of each failing family with its request.")?;
    }
    let found =
        [given_up(report), families_refused(report), changed(report), carried_over(report), absolute(report)];
    for said in found.into_iter().flatten() {
        writeln!(out)?;
        output::wrapped(out, " ", 1, &said)?;
    }
    for (said, diagnosis) in
        [(report.lag().map(lagging), report.lag()), (diagnosed(report), report.fitting().next())]
    {
        let (Some(said), Some(diagnosis)) = (said, diagnosis) else { continue };
        writeln!(out)?;
        output::wrapped(out, " ", 1, &said)?;
        diagnosis.program.iter().try_for_each(|line| output::wrapped(out, "   ", 3, line))?;
    }
    if let Some(said) = conditions(report) {
        writeln!(out)?;
        output::wrapped(out, " ", 1, &said)?;
    }
    if report.holds() {
        writeln!(out)?;
        output::wrapped(out, " ", 1, &tested(report, tolerance))?;
    }
    Ok(())
}

pub fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    output::markdown(out, NAMES, report.families().iter().map(|row| cells(row, "within tolerance")))
}

/// Columns of the table of families.
const NAMES: [&str; 5] = ["family", "systems", "verdict", "u off by", "N off by"];

fn cells(row: &Row, within: &str) -> [String; 5] {
    let error = |x: &Option<Exact>| x.as_ref().map_or(String::new(), |x| x.decimal(FEW, Round::Up));
    let verdict = match row.verdict {
        Verdict::WithinTolerance => within.to_string(),
        Verdict::TimedOut => "not in time".to_string(),
        verdict @ (Verdict::Right | Verdict::Refused | Verdict::Wrong | Verdict::Crashed) => {
            verdict.to_string()
        }
    };
    let some = row.verdict > Verdict::WithinTolerance && row.count < row.cases;
    let of = if some { format!(": {} of {}", row.count, row.cases) } else { String::new() };
    let [u, n] = [error(&row.worst_deflection), error(&row.worst_force)];
    [row.family.to_string(), row.cases.to_string(), verdict + &of, u, n]
}

/// Prints a system with a wrong answer.
fn example(out: &mut dyn Write, checked: &CaseResult) -> io::Result<()> {
    let id = &checked.problem.id;
    let width = id.len().max("residuals".len());
    let mut line =
        |name: &str, text: String| output::wrapped(out, &format!(" {name:<width$}  "), width + 3, &text);
    let system = checked.problem.system.map(format_exact).to_string();
    let penalty = checked.problem.penalty.as_ref().map(|eps| format!(", ε = {} N/m", format_exact(eps)));
    line(id, parts(&(system + &penalty.unwrap_or_default())))?;
    let judgement = &checked.assessment;
    let exact = &judgement.exact;
    let decimal = |x: &Exact| x.decimal(DIGITS, Round::Nearest);
    if let Reply::Answered(answer) = &checked.reply {
        let status = answer.status.as_ref().map(|status| format!("; reported status “{status}”"));
        line("answer", parts(&numbers(answer, DIGITS)) + &status.unwrap_or_default())?;
    }
    line(
        "exact",
        parts(&format!("u = {} m, N = {} N", decimal(&exact.deflection), decimal(&exact.contact_force))),
    )?;
    if let (Some(u), Some(n)) = (&judgement.deflection_error, &judgement.force_error) {
        let few = |x: &Exact| x.decimal(FEW, Round::Up);
        line("off by", format!("{} of the scale of u, {} of that of N", few(u), few(n)))?;
    }
    if let Some(kkt) = &judgement.kkt {
        line("residuals", parts(&kkt.to_string()))?;
    }
    judgement.finding.as_ref().map_or(Ok(()), |finding| line("finding", finding.clone()))
}

/// Formats u and N of an answer.
fn numbers(answer: &Answer, digits: usize) -> String {
    let number = |name: &str, x: &Value, unit: &str| match x {
        Some(x) => format!("{name} = {} {unit}", x.decimal(digits, Round::Nearest)),
        None => format!("{name} is not a number"),
    };
    [number("u", &answer.deflection, "m"), number("N", &answer.contact_force, "N")].join(", ")
}

/// Breaks a list only after its commas.
fn parts(list: &str) -> String {
    list.replace(' ', &NO_BREAK_SPACE.to_string()).replace(&format!(",{NO_BREAK_SPACE}"), ", ")
}

fn given_up(report: &Report) -> Option<String> {
    let few = report.results.len();
    let said = || format!("It answered none of the first {few} systems, so the others were skipped.");
    report.given_up.then(said)
}

/// Describes a program whose answers depend on more than the request.
fn changed(report: &Report) -> Option<String> {
    let first = report.changed.first()?;
    let result = &report.results[first.of];
    let said = |reply: &Reply| match reply {
        Reply::Answered(answer) => numbers(answer, 6),
        _ => "no answer".to_string(),
    };
    Some(format!(
        "The program carries something over from earlier requests, or is random: of {} requests that were \
         repeated in another order, {} have another answer. {}: first {}, then {}.",
        report.repeated,
        report.changed.len(),
        result.problem.id,
        said(&result.reply),
        said(&first.reply),
    ))
}

/// Describes answers that are those of earlier requests.
fn carried_over(report: &Report) -> Option<String> {
    let [own, earlier] = report.carried_over.first()?.map(|i| &report.results[i].problem.id);
    let (count, wrong) = (report.carried_over.len(), report.summary().wrong);
    Some(format!(
        "The program carries something over from earlier requests: {count} of {wrong} wrong answers are the \
         right ones of an earlier request; that to {own} is that to {earlier}."
    ))
}

/// Describes what separates the wrong answers from the right ones.
fn conditions(report: &Report) -> Option<String> {
    let first = report.conditions.first()?;
    let of = match first.state {
        Some(State::Contact) => " in contact",
        Some(State::Separated) => " without contact",
        Some(State::Grazing) | None => "",
    };
    let clauses =
        report.conditions.iter().filter_map(|condition| condition.threshold.as_ref()).take(EXAMPLES);
    let clauses: Vec<_> = clauses.map(clause).collect();
    let of = match clauses[..] {
        [] => format!("all {} systems{of}", report.summary().wrong),
        _ => format!("systems{of} with {}", clauses.join(", or ")),
    };
    let others = if clauses.len() > 1 { " More cases may tell which of these matters." } else { "" };
    Some(format!("The {} wrong answers are to {of}.{others}", report.summary().wrong))
}

/// Formats a threshold: `|R|/c up to 9.9e-7 m (right from 1.3e-6 m on)`.
fn clause(threshold: &Threshold) -> String {
    let Threshold { quantity, wrong, right } = threshold;
    let digits = if *quantity == Quantity::Position { DIGITS } else { FEW };
    let text = |x: &Exact, round| {
        (x.decimal(digits, round) + quantity.unit()).replace(' ', &NO_BREAK_SPACE.to_string())
    };
    let symbol = quantity.symbol().replace(' ', &NO_BREAK_SPACE.to_string());
    if threshold.is_below() {
        let (wrong, right) = (text(wrong, Round::Up), text(right, Round::Down));
        format!("{symbol} up to {wrong} (right from {right} on)")
    } else {
        let (wrong, right) = (text(wrong, Round::Down), text(right, Round::Up));
        format!("{symbol} from {wrong} on (right up to {right})")
    }
}

/// Describes the scope of the test if nothing is wrong.
fn tested(report: &Report, tolerance: &Number) -> String {
    let least = |state, before: &str| match report.least_deciding(state, &tolerance.value) {
        None => format!("{before} would not be detected"),
        Some(least) => {
            let force = format!("|R| = {} (|m g| + |c (H − l)|)", least.decimal(FEW, Round::Up));
            format!("{before} would be detected from {} on", force.replace(' ', &NO_BREAK_SPACE.to_string()))
        }
    };
    let missed = least(State::Contact, "Missed contact");
    let held = least(State::Separated, "false contact");
    let count =
        |count: usize, one: &str, more: &str| format!("{count} {}", if count == 1 { one } else { more });
    format!(
        "No error above {} was found in {} of {}, with one unknown and one plane. {missed}, {held}.",
        shortened(&tolerance.text),
        count(report.cases(), "system", "systems"),
        count(report.families().len(), "family", "families"),
    )
}

/// Describes families without answers if they alone leave the result open.
fn families_refused(report: &Report) -> Option<String> {
    let families = report.families();
    let refused = families.iter().filter(|row| row.verdict == Verdict::Refused && row.right == 0);
    let names = Vec::from_iter(refused.map(|row| row.family.name()));
    let said = || format!("Every system of {} was refused, so its result is unknown.", names.join(", "));
    (!names.is_empty()).then(said)
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
    let names: Vec<_> = report.fitting().map(named).collect();
    let Diagnosis { answers, of, .. } = report.fitting().next()?;
    let (which, others) = match answers {
        DiagnosisScope::Wrong => ("wrong answers", ", but not the right ones"),
        _ => ("answers", ""),
    };
    Some(match &names[..] {
        [only] => format!("One mistake explains all {of} {which}{others}: {only}."),
        _ => format!(
            "Each of {} mistakes explains all {of} {which}{others}: {}. More families or cases may tell which it \
             is. The first one:",
            names.len(),
            names.join("; "),
        ),
    })
}

/// Describes errors that do not grow with the systems.
fn absolute(report: &Report) -> Option<String> {
    let [u, n, residual] =
        report.absolute_bounds.each_ref().map(|bound| Some(bound.as_ref()?.decimal(FEW, Round::Up)));
    let residual = residual.filter(|_| u.is_none() && n.is_none());
    let bounds = [("u", u, "m"), ("N", n, "N"), ("m g − c u − N", residual, "N")];
    let bounds =
        bounds.into_iter().filter_map(|(name, bound, unit)| Some(format!("{} {unit} of {name}", bound?)));
    let bounds = bounds.collect::<Vec<_>>().join(", ");
    let said = || {
        format!(
            "The errors do not grow with the systems; the largest is {bounds}. An absolute tolerance, or a constant, has this effect."
        )
    };
    (!bounds.is_empty()).then(said)
}

#[cfg(test)]
mod tests;
