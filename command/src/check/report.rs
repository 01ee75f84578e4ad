//! The report for people, and for documents.

use crate::args::{Number, spelled};
use crate::lines::NO_BREAK_SPACE;
use crate::output::{self, shortened};
use spring_mass_contact::check::{
    Answers, Checked, Diagnosis, Kind, Of, Penalty, Reply, Report, Row, Summary, Threshold, Value, Verdict,
};
use spring_mass_contact::number::{Exact, PositivePart};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::State;
use std::io::{self, Write};

/// Digits of an error, and of a number beside another.
const FEW: usize = 2;
const DIGITS: usize = 12;

/// Families of which an example is shown; JSON has all.
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
    let counts = format!("{}: {}", report.checked.len(), counts.collect::<Vec<_>>().join(", "));
    output::list(out, [("program", program.to_string()), ("systems", counts)])?;
    writeln!(out)?;
    let families = report.families();
    output::table(out, NAMES, families.iter().map(|row| cells(row, &within)), &[])?;
    writeln!(out)?;
    writeln!(out, " u in parts of |H − l| + |m g / c|, N of |m g| + |c (H − l)|; right: off by no")?;
    writeln!(out, " more than what rounding in f64 may do, within: than the tolerance.")?;
    let bad: Vec<_> = families.iter().filter(|row| row.verdict > Verdict::WithinTolerance).collect();
    for row in bad.iter().take(EXAMPLES) {
        writeln!(out)?;
        example(out, row.worst)?;
    }
    if !bad.is_empty() {
        writeln!(out, "\n --format json has an example of each family that fails, with its request.")?;
    }
    let lag = report.lag();
    let fitting = report.named().filter(|named| named.answers != Answers::Steps);
    for (said, diagnosis) in [
        (given_up(report), None),
        (families_refused(report), None),
        (penalty(report), None),
        (report.missed.as_ref().map(missed), None),
        (report.held.as_ref().map(held), None),
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

/// A system whose answer is not what it should be.
fn example(out: &mut dyn Write, checked: &Checked) -> io::Result<()> {
    let id = &checked.problem.id;
    let width = id.len().max("residuals".len());
    let mut line =
        |name: &str, text: String| output::wrapped(out, &format!(" {name:<width$}  "), width + 3, &text);
    let system = checked.problem.system.map(spelled).to_string();
    let penalty = checked.problem.penalty.as_ref().map(|eps| format!(", ε = {} N/m", spelled(eps)));
    line(id, parts(&(system + &penalty.unwrap_or_default())))?;
    let judgement = &checked.judgement;
    let exact = &judgement.exact;
    let decimal = |x: &Exact| x.decimal(DIGITS, Round::Nearest);
    if let Reply::Answered(answer) = &checked.reply {
        let number = |name: &str, x: &Value, unit: &str| match x {
            Some(x) => format!("{name} = {} {unit}", decimal(x)),
            None => format!("{name} is not a number"),
        };
        let status = answer.status.as_ref().map(|status| format!("; it says “{status}”"));
        let [u, n] = [number("u", &answer.deflection, "m"), number("N", &answer.contact_force, "N")];
        line("answer", parts(&format!("{u}, {n}")) + &status.unwrap_or_default())?;
    }
    line(
        "exact",
        parts(&format!("u = {} m, N = {} N", decimal(&exact.deflection), decimal(&exact.contact_force))),
    )?;
    if let (Some(u), Some(n)) = (&judgement.deflection_error, &judgement.force_error) {
        let few = |x: &Exact| x.decimal(FEW, Round::Up);
        line("off by", format!("{} of what u is measured by, {} of what N is", few(u), few(n)))?;
    }
    if let Some(kkt) = &judgement.kkt {
        line("residuals", parts(&kkt.to_string()))?;
    }
    judgement.finding.as_ref().map_or(Ok(()), |finding| line("finding", finding.clone()))
}

/// A list whose lines end after its commas.
fn parts(list: &str) -> String {
    list.replace(' ', &NO_BREAK_SPACE.to_string()).replace(&format!(",{NO_BREAK_SPACE}"), ", ")
}

fn given_up(report: &Report) -> Option<String> {
    let few = report.checked.len();
    let said = || format!("It has answered none of the first {few} systems: no more were put.");
    report.given_up.then(said)
}

/// What the forces by their penetrations show, if it is not what was asked for.
fn penalty(report: &Report) -> Option<String> {
    let Penalty { kind, value, spread } = &report.penalty;
    let (value, spread) = (value.as_ref()?, spread.as_ref()?);
    let asked = report.checked.first()?.problem.penalty.as_ref();
    if *kind == Kind::Constant && asked.is_some_and(|asked| (value - asked).abs() <= spread * asked) {
        return None;
    }
    let value = value.decimal(6, Round::Nearest);
    let (eps, besides) = match kind {
        Kind::None => return None,
        Kind::Constant => (format!("ε = {value} N/m"), ""),
        Kind::OfStiffness => (
            format!("ε = {value} c"),
            " So does an iteration that stops after the same number of steps everywhere.",
        ),
        Kind::OfMass => (format!("ε = m × {value}/s²"), ""),
    };
    let spread = spread.decimal(FEW, Round::Up);
    Some(format!(
        "It acts like a penalty: N = ε p with {eps}, the same wherever it shows, to within {spread}.{besides}"
    ))
}

fn missed(missed: &Threshold) -> String {
    let (what, [up_to, from]) = ends(missed, "the mass would go through it by", "it has to push with");
    format!(
        "It misses the plane in {} systems, in which {what} up to {up_to}, and finds it in all others, \
         from {from} on: most likely by a tolerance of its own.",
        missed.count
    )
}

fn held(held: &Threshold) -> String {
    let (what, [up_to, from]) = ends(held, "it hangs clear of it by", "that takes a pull of");
    format!(
        "It holds the mass at the plane in {} systems in which it hangs free, where {what} up to {up_to}, \
         and releases it in all others, from {from} on: most likely by a tolerance of its own.",
        held.count
    )
}

/// Returns the words for a penetration or for a force, and the largest that is decided wrongly and the
/// smallest that is not, with what they are relative to.
fn ends<'a>(threshold: &Threshold, penetration: &'a str, force: &'a str) -> (&'a str, [String; 2]) {
    let Threshold { count: _, of, up_to, from } = threshold;
    let (what, unit) = match of {
        Of::Penetration => (penetration, " m"),
        Of::Force => (force, " N"),
        Of::ForceByWeight => (force, " |m g|"),
        Of::PenetrationByHeight => (penetration, " |H|"),
    };
    // No line ends within it.
    let text = |x: &Exact, round| (x.decimal(FEW, round) + unit).replace(' ', &NO_BREAK_SPACE.to_string());
    (what, [text(up_to, Round::Up), text(from, Round::Down)])
}

/// What was tested, where nothing is wrong: no more follows from it.
fn tested(report: &Report, tolerance: &Number) -> String {
    let least = |state, before: &str| match report.least_deciding(state, &tolerance.value) {
        None => format!("{before} would not show at all"),
        Some(least) => {
            let force = format!("|R| = {} (|m g| + |c (H − l)|)", least.decimal(FEW, Round::Up));
            format!("{before} would show from {} on", force.replace(' ', &NO_BREAK_SPACE.to_string()))
        }
    };
    let missed = least(State::Contact, "A plane that is missed");
    let held = least(State::Separated, "one that holds a mass");
    let count =
        |count: usize, one: &str, more: &str| format!("{count} {}", if count == 1 { one } else { more });
    format!(
        "No error above {} was found in {} of {}, with one unknown and one plane. {missed}, {held}.",
        shortened(&tolerance.text),
        count(report.checked.len(), "system", "systems"),
        count(report.families().len(), "family", "families"),
    )
}

/// Families that alone leave it open whether the program is right.
fn families_refused(report: &Report) -> Option<String> {
    let families = report.families();
    let refused = families.iter().filter(|row| row.verdict == Verdict::Refused && row.right == 0);
    let names = Vec::from_iter(refused.map(|row| row.family.name()));
    let said = || format!("Of {} every system was refused: nothing is known of it.", names.join(", "));
    (!names.is_empty()).then(said)
}

fn lagging(lag: &Diagnosis) -> String {
    format!("The steps of all {} systems that tell them show it: {}.", lag.of, lag.name)
}

fn diagnosed(report: &Report) -> Option<String> {
    let fitting: Vec<_> = report.fitting().collect();
    let Diagnosis { answers, of, .. } = fitting.first()?;
    let which = if *answers == Answers::All { "answers" } else { "wrong answers" };
    let names: Vec<_> = fitting.iter().map(|one| one.name.as_str()).collect();
    Some(match names[..] {
        [only] => format!("Each of {of} {which} fits one mistake that is known, and no other: {only}."),
        _ => format!(
            "Each of {of} {which} fits several mistakes that are known: {}. More families or more cases may \
             tell them apart.",
            names.join("; ")
        ),
    })
}

#[cfg(test)]
mod tests;
