//! The report as a table and as Markdown.

use crate::args::{Number, format_exact};
use crate::lines::NO_BREAK_SPACE;
use crate::output::{self, shortened};
use spring_mass_contact::check::{
    CaseResult, Diagnosis, DiagnosisScope, Penalty, PenaltyScaling, Reply, Report, Row, Summary, Threshold,
    ThresholdQuantity, Value, Verdict,
};
use spring_mass_contact::number::{Exact, PositivePart};
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
    let counts = format!("{}: {}", report.results.len(), counts.collect::<Vec<_>>().join(", "));
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
    let lag = report.lag();
    let fitting = report.identified_mistake().filter(|named| named.answers != DiagnosisScope::Steps);
    for (said, diagnosis) in [
        (given_up(report), None),
        (families_refused(report), None),
        (penalty(report), None),
        (report.missed_contacts.as_ref().map(missed), None),
        (report.false_contacts.as_ref().map(held), None),
        (lag.map(lagging), lag),
        (diagnosed(report), fitting),
    ] {
        let Some(said) = said else { continue };
        writeln!(out)?;
        output::wrapped(out, " ", 1, &said)?;
        if let Some(Diagnosis { formula, at, .. }) = diagnosis {
            output::wrapped(out, "   ", 3, formula)?;
            at.iter().try_for_each(|place| output::wrapped(out, "   ", 3, place))?;
        }
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
        let number = |name: &str, x: &Value, unit: &str| match x {
            Some(x) => format!("{name} = {} {unit}", decimal(x)),
            None => format!("{name} is not a number"),
        };
        let status = answer.status.as_ref().map(|status| format!("; reported status “{status}”"));
        let [u, n] = [number("u", &answer.deflection, "m"), number("N", &answer.contact_force, "N")];
        line("answer", parts(&format!("{u}, {n}")) + &status.unwrap_or_default())?;
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

/// Breaks a list only after its commas.
fn parts(list: &str) -> String {
    list.replace(' ', &NO_BREAK_SPACE.to_string()).replace(&format!(",{NO_BREAK_SPACE}"), ", ")
}

fn given_up(report: &Report) -> Option<String> {
    let few = report.results.len();
    let said = || format!("It answered none of the first {few} systems, so the others were skipped.");
    report.given_up.then(said)
}

/// Describes the identified penalty, if it differs from the requested one.
fn penalty(report: &Report) -> Option<String> {
    let Penalty { kind, value, spread } = &report.penalty;
    let (value, spread) = (value.as_ref()?, spread.as_ref()?);
    let asked = report.results.first()?.problem.penalty.as_ref();
    if *kind == PenaltyScaling::Constant && asked.is_some_and(|asked| (value - asked).abs() <= spread * asked)
    {
        return None;
    }
    let value = value.decimal(6, Round::Nearest);
    let (eps, besides) = match kind {
        PenaltyScaling::None => return None,
        PenaltyScaling::Constant => (format!("ε = {value} N/m"), ""),
        PenaltyScaling::OfStiffness => (
            format!("ε = {value} c"),
            " An iteration that always stops after the same number of steps does so, too.",
        ),
        PenaltyScaling::OfMass => (format!("ε = m × {value}/s²"), ""),
    };
    let spread = spread.decimal(FEW, Round::Up);
    Some(format!("It acts like a penalty: N = ε p with {eps}, constant to within {spread}.{besides}"))
}

fn missed(missed: &Threshold) -> String {
    let (what, [up_to, from]) = ends(missed, "the penetration without a plane is", "the contact force is");
    format!(
        "It misses contact in {} systems, in which {what} up to {up_to}, and detects it in all others, \
         from {from} on; probably by an internal tolerance.",
        missed.count
    )
}

fn held(held: &Threshold) -> String {
    let (what, [up_to, from]) = ends(held, "the gap is", "the required pull is");
    format!(
        "It holds the mass at the plane in {} separated systems, where {what} up to {up_to}, \
         and releases it in all others, from {from} on; probably by an internal tolerance.",
        held.count
    )
}

/// Returns the words for a penetration or a force, with the largest value decided wrongly and the smallest
/// one decided rightly, and their reference.
fn ends<'a>(threshold: &Threshold, penetration: &'a str, force: &'a str) -> (&'a str, [String; 2]) {
    let Threshold { count: _, of, up_to, from } = threshold;
    let (what, unit) = match of {
        ThresholdQuantity::Penetration => (penetration, " m"),
        ThresholdQuantity::Force => (force, " N"),
        ThresholdQuantity::ForceByWeight => (force, " |m g|"),
        ThresholdQuantity::PenetrationByHeight => (penetration, " |H|"),
    };
    // Lines are not broken within it.
    let text = |x: &Exact, round| (x.decimal(FEW, round) + unit).replace(' ', &NO_BREAK_SPACE.to_string());
    (what, [text(up_to, Round::Up), text(from, Round::Down)])
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
        count(report.results.len(), "system", "systems"),
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

fn diagnosed(report: &Report) -> Option<String> {
    let fitting: Vec<_> = report.fitting().collect();
    let Diagnosis { answers, of, .. } = fitting.first()?;
    let which = if *answers == DiagnosisScope::All { "answers" } else { "wrong answers" };
    let names: Vec<_> = fitting.iter().map(|one| one.name.as_str()).collect();
    Some(match names[..] {
        [only] => format!("Exactly one known mistake explains each of {of} {which}: {only}."),
        _ => format!(
            "Several known mistakes explain each of {of} {which}: {}. More families or cases may \
             distinguish them.",
            names.join("; ")
        ),
    })
}

#[cfg(test)]
mod tests;
