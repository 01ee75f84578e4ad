//! `contact prove`: every claim for all values, and that wrong ones would be noticed.

use crate::args;
use crate::output::{self, Failure, Status};
use crate::text::shortened;
use clap::ValueEnum;
use serde::Serialize;
use spring_mass_contact::claims::{Entry, entries, entry, place};
use spring_mass_contact::proof::controls::{
    Change, Controls, Counts, Dropped, Outcome, Without, controls, repairs,
};
use spring_mass_contact::proof::coq::{self, LeftOut};
use spring_mass_contact::proof::refute::Counterexample;
use spring_mass_contact::proof::{Proof, Statement, paper, prove, refute, statements};
use spring_mass_contact::verify::command_line;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const EXAMPLES: &str = "\
Examples:
  contact prove
  contact prove 1.17 'Theorem 1.3.3'
  contact prove --format json
  contact prove --coq target/coq

A proof holds for all values that satisfy the hypotheses, and it is made from
the functions that compute. Two kinds of controls show that it could have
failed: a claim without one of its hypotheses has to be wrong, and every small
change of a formula in src/chapter has to be noticed by some claim, or proved to
change nothing.

Exit status: 0 all proved, no control amiss; 1 otherwise; 2 bad input.";

/// Prove the claims for all values of their quantities
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these, with their proofs in full: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Write everything for the proof assistant Coq to this directory instead
    #[arg(long, value_name = "DIR", conflicts_with_all = ["numbers", "format"])]
    coq: Option<PathBuf>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For reading: a line a claim
    Table,
    /// For programs: everything
    Json,
    /// For documents: a line a claim
    Markdown,
}

/// A claim and what came of it.
struct Proved {
    statement: Statement,
    answer: Answer,
    time: Duration,
}

enum Answer {
    Proof(Proof),
    /// Why there is none, and where the claim does not hold, if that was found.
    None(String, Option<Counterexample>),
}

impl Proved {
    fn status(&self) -> &'static str {
        match &self.answer {
            Answer::Proof(_) => "proved",
            Answer::None(_, Some(_)) => "refuted",
            Answer::None(_, None) => "unknown",
        }
    }

    fn hypotheses(&self) -> Vec<&'static str> {
        self.statement.hypotheses.iter().map(|hypothesis| hypothesis.given.text()).collect()
    }
}

/// Proves and prints.
pub fn run(options: &Options) -> Result<Status, Failure> {
    if let Some(directory) = &options.coq {
        return for_coq(directory);
    }
    let numbers = args::equations(&options.numbers)?;
    let wanted = |equation: &str| numbers.is_empty() || numbers.iter().any(|n| n == equation);
    let statements = statements();
    let empty = |number: &&String| statements.iter().all(|s| s.equation != number.as_str());
    if let Some(empty) = numbers.iter().find(empty) {
        return Err(format!(
            "invalid value '{empty}' for '[NUMBER]...': nothing is proved of it; `contact equations '{empty}'` \
             says what is claimed of it"
        )
        .into());
    }
    let start = Instant::now();
    let all: Vec<Proved> = statements.iter().map(attempt).collect();
    let of_proofs = start.elapsed();
    // Controls say something only of claims that are proved.
    let (controls, repairs) = if all.iter().all(|p| p.status() == "proved") {
        (controls(&statements), Vec::new())
    } else {
        (Controls::default(), repairs(&statements))
    };
    let report = Report::new(all, controls, repairs, (of_proofs, start.elapsed()), &wanted);
    output::print(|out| match options.format {
        Format::Json => output::json(out, &Json::of(&report)),
        Format::Markdown => markdown(out, &report),
        Format::Table if numbers.is_empty() => table(out, &report),
        Format::Table => details(out, &report),
    })?;
    Ok(if report.is_well() { Status::Fine } else { Status::Unmet })
}

/// Writes the files for Coq, and says how they are compiled and what is not among them.
fn for_coq(directory: &Path) -> Result<Status, Failure> {
    let files = coq::write(directory).map_err(|error| {
        let directory = shortened(&directory.display().to_string());
        format!(
            "invalid value '{directory}' for '--coq <DIR>': must be a directory that can be written: {error}"
        )
    })?;
    let left_out = coq::left_out();
    output::print(|out| {
        let claims = statements().len();
        let written = claims - left_out.len();
        let order =
            format!("{written} of {claims} claims written as theorems, to be compiled in this order:");
        output::wrapped(out, "", 2, &order)?;
        let text = |path: &Path| path.display().to_string();
        for file in &files {
            output::command(out, ["coqc", "-R", &text(directory), "Contact", &text(file)])?;
        }
        left_out.iter().try_for_each(|LeftOut { equation, name, reason }| {
            output::wrapped(out, "", 2, &format!("left out: {equation} {name}: {reason}"))
        })
    })
}

fn attempt(statement: &Statement) -> Proved {
    let start = Instant::now();
    let answer = match prove(statement) {
        Ok(proof) => Answer::Proof(proof),
        Err(why) => Answer::None(paper::why(&why), refute(statement)),
    };
    Proved { statement: statement.clone(), answer, time: start.elapsed() }
}

/// Everything there is to say.
struct Report {
    /// In the chapter's order.
    proved: Vec<Proved>,
    /// Of changes those that a claim about the wanted numbers notices, if not all are wanted.
    controls: Controls,
    /// With one of these all claims would be proved.
    repairs: Vec<Change>,
    of_proofs: Duration,
    in_all: Duration,
}

impl Report {
    fn new(
        mut proved: Vec<Proved>,
        mut controls: Controls,
        repairs: Vec<Change>,
        (of_proofs, in_all): (Duration, Duration),
        wanted: &dyn Fn(&str) -> bool,
    ) -> Self {
        proved.retain(|p| wanted(p.statement.equation));
        proved.sort_by_key(|p| place(p.statement.equation));
        controls.dropped.retain(|dropped| wanted(dropped.equation));
        controls.changes.retain(|(_, outcome)| match outcome {
            Outcome::Noticed { equation, .. } => wanted(equation),
            Outcome::Unchanged | Outcome::Unnoticed => wanted(""),
        });
        Report { proved, controls, repairs, of_proofs, in_all }
    }

    fn is_well(&self) -> bool {
        let Summary { claims, proved, unnoticed, .. } = self.summary();
        claims == proved && unnoticed == 0 && self.needless().next().is_none()
    }

    /// Hypotheses that are not seen to be needed.
    fn needless(&self) -> impl Iterator<Item = &Dropped> {
        self.controls.dropped.iter().filter(|dropped| !matches!(dropped.without, Without::Refuted(_)))
    }

    /// A claim's hypotheses, dropped one at a time.
    fn dropped(&self, statement: &Statement) -> impl Iterator<Item = &Dropped> {
        let of = (statement.equation, statement.name);
        self.controls.dropped.iter().filter(move |dropped| (dropped.equation, dropped.name) == of)
    }

    fn of<'a>(&'a self, entry: &Entry) -> Vec<&'a Proved> {
        self.proved.iter().filter(|p| p.statement.equation == entry.equation).collect()
    }

    fn summary(&self) -> Summary {
        let with = |status| self.proved.iter().filter(|p| p.status() == status).count();
        let Counts { changes, noticed, unchanged, unnoticed, .. } = self.controls.counts();
        Summary {
            claims: self.proved.len(),
            proved: with("proved"),
            refuted: with("refuted"),
            unknown: with("unknown"),
            hypotheses: self.proved.iter().map(|p| p.statement.hypotheses.len()).sum(),
            changes,
            noticed,
            unchanged,
            unnoticed,
        }
    }
}

fn how(proved: &Proved) -> String {
    match &proved.answer {
        Answer::Proof(proof) => paper::how(proof),
        Answer::None(..) => proved.status().to_uppercase(),
    }
}

fn supposed(proved: &Proved) -> String {
    match &proved.answer {
        Answer::Proof(proof) => paper::used(proof).join(", "),
        Answer::None(..) => proved.hypotheses().join(", "),
    }
}

fn table(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let mut table = output::table();
    table.set_header(["number", "claim", "how", "by hypotheses", "ms"]);
    for proved in &report.proved {
        let number = entry(proved.statement.equation).map(Entry::label);
        let ms = format!("{:.2}", proved.time.as_secs_f64() * 1e3);
        table.add_row([
            number.unwrap_or_default(),
            proved.statement.name.to_string(),
            how(proved),
            supposed(proved),
            ms,
        ]);
    }
    output::unbroken(&mut table, &[0, 1, 4]);
    output::lines(out, &table)?;
    amiss(out, report)?;
    writeln!(out)?;
    totals(out, report)
}

/// What is not as it should be, each after a blank line.
fn amiss(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    for proved in &report.proved {
        let Statement { equation, name, .. } = &proved.statement;
        match &proved.answer {
            Answer::Proof(_) => {}
            Answer::None(why, None) => {
                writeln!(out)?;
                output::wrapped(out, "", 2, &format!("{equation} {name} UNKNOWN: {why}"))?;
            }
            Answer::None(_, Some(counterexample)) => {
                writeln!(out, "\n{equation} {name} REFUTED")?;
                output::wrapped(out, "  ", 4, &together(&paper::claim(&proved.statement)))?;
                output::wrapped(out, "  at ", 4, &point(counterexample))?;
                if let Some(line) = command_line(&counterexample.case()) {
                    output::command(out, line.split(' '))?;
                }
            }
        }
    }
    for change in &report.repairs {
        writeln!(out)?;
        output::wrapped(out, "", 2, &format!("with {change} every claim would be proved"))?;
    }
    for Dropped { equation, name, given, without } in report.needless() {
        let what = match without {
            Without::StillTrue => "is not needed: the claim is proved without it",
            Without::Unknown | Without::Refuted(_) => {
                "may not be needed: nothing was found against the claim without it"
            }
        };
        writeln!(out)?;
        output::wrapped(out, "", 2, &format!("{equation} {name}: the hypothesis {} {what}", given.text()))?;
    }
    for (Change { site, what }, outcome) in &report.controls.changes {
        if matches!(outcome, Outcome::Unnoticed) {
            writeln!(out)?;
            output::wrapped(out, "", 2, &format!("UNNOTICED {site}: {what}"))?;
        }
    }
    Ok(())
}

fn totals(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let Summary { claims, proved, hypotheses, changes, noticed, unchanged, .. } = report.summary();
    let needless = report.needless().count();
    let seconds = |time: Duration| time.as_secs_f64();
    writeln!(out, "{proved} of {claims} claims proved in {:.3} s.", seconds(report.of_proofs))?;
    if proved < claims {
        return writeln!(out, "The controls wait until all are.");
    }
    let needed = hypotheses - needless;
    let needed = format!("{needed} of {hypotheses} hypotheses needed: without it the claim is refuted.");
    output::wrapped(out, "", 2, &needed)?;
    let seen = noticed + unchanged;
    let seen = format!(
        "{seen} of {changes} changes of formulas noticed: {noticed} refuted, {unchanged} proved to change nothing."
    );
    output::wrapped(out, "", 2, &seen)?;
    writeln!(out, "{:.3} s in all.", seconds(report.in_all))
}

/// The proofs themselves.
fn details(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let mut first = true;
    for entry in entries() {
        let claims = report.of(entry);
        if claims.is_empty() {
            continue;
        }
        if !first {
            writeln!(out)?;
        }
        first = false;
        writeln!(out, "{} {}", entry.label(), entry.title)?;
        for proved in claims {
            writeln!(out)?;
            account(out, report, proved)?;
        }
    }
    let noticed =
        report.controls.changes.iter().filter_map(|(Change { site, what }, outcome)| match outcome {
            Outcome::Noticed { equation, name, counterexample } => {
                Some(format!("{site}: {what}, by {equation} {name} at {}", point(counterexample)))
            }
            Outcome::Unchanged | Outcome::Unnoticed => None,
        });
    let noticed: Vec<_> = noticed.collect();
    if !noticed.is_empty() {
        writeln!(out, "\nchanges of formulas that these claims notice")?;
        noticed.iter().try_for_each(|line| output::wrapped(out, "  ", 4, line))?;
    }
    amiss(out, report)
}

/// Text whose lines end before an operator or a relation: what is multiplied or divided stays together.
fn together(text: &str) -> String {
    let is_operator = |word: &str| ["+", "−", "/", "=", "≠", "<", ">", "≤", "≥", "→"].contains(&word);
    let is_factor = |word: &str| {
        let letters = word.chars().filter(|c| c.is_alphabetic()).count();
        letters < 2 && !is_operator(word) && !word.ends_with([',', ';', ':'])
    };
    let words: Vec<&str> = text.split(' ').collect();
    let mut all = words.first().unwrap_or(&"").to_string();
    for pair in words.windows(2) {
        let (word, next) = (pair[0], pair[1]);
        let glued = is_operator(word) || next == "/" || is_factor(word) && is_factor(next);
        all.push(if glued { output::GLUE } else { ' ' });
        all.push_str(next);
    }
    all
}

/// A counterexample whose lines end between its numbers.
fn point(counterexample: &Counterexample) -> String {
    counterexample.to_string().replace(" = ", &format!("{0}={0}", output::GLUE))
}

fn account(out: &mut dyn Write, report: &Report, proved: &Proved) -> io::Result<()> {
    let Proved { statement, answer, .. } = proved;
    writeln!(out, "{} ({})", statement.name, how(proved))?;
    let mut say = |what: &str, lines: &[String]| {
        lines.iter().enumerate().try_for_each(|(i, line)| {
            let what = if i == 0 { what } else { "" };
            let text = line.trim_start();
            let first = format!("  {what:<8} {}", " ".repeat(line.len() - text.len()));
            // Further in than what is a step of its own.
            output::wrapped(out, &first, first.len() + 4, &together(text))
        })
    };
    say("claim", &[paper::claim(statement)])?;
    if !statement.hypotheses.is_empty() {
        say("if", &[proved.hypotheses().join(", ")])?;
    }
    let invariants: Vec<_> = statement.invariants.iter().map(|i| i.given.text()).collect();
    if !invariants.is_empty() {
        say("always", &[format!("{} for every k, which is part of the proof", invariants.join(", "))])?;
    }
    say("where", &paper::names(statement))?;
    match answer {
        Answer::Proof(proof) => say("proof", &paper::proof(proof))?,
        Answer::None(why, _) => say("no proof", std::slice::from_ref(why))?,
    }
    let needed = report.dropped(statement).filter_map(|Dropped { given, without, .. }| match without {
        Without::Refuted(counterexample) => {
            Some(format!("{}: without it, at {}", given.text(), point(counterexample)))
        }
        Without::StillTrue | Without::Unknown => None,
    });
    say("needs", &needed.collect::<Vec<_>>())
}

fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(out, "| number | claim | says | if | how | status |")?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    report.proved.iter().try_for_each(|proved| {
        let Statement { equation, name, .. } = &proved.statement;
        let says = paper::claim(&proved.statement).replace('|', "\\|");
        let (given, how, status) = (proved.hypotheses().join(", "), how(proved), proved.status());
        writeln!(out, "| {equation} | {name} | {says} | {given} | {how} | {status} |")
    })
}

#[derive(Serialize)]
struct Json {
    summary: Summary,
    equations: Vec<EquationJson>,
    changes: Vec<ChangeJson>,
}

#[derive(Clone, Copy, Serialize)]
struct Summary {
    claims: usize,
    proved: usize,
    refuted: usize,
    unknown: usize,
    hypotheses: usize,
    changes: usize,
    noticed: usize,
    unchanged: usize,
    unnoticed: usize,
}

#[derive(Serialize)]
struct EquationJson {
    equation: &'static str,
    claims: Vec<ClaimJson>,
}

#[derive(Serialize)]
struct ClaimJson {
    claim: &'static str,
    kind: &'static str,
    statement: String,
    hypotheses: Vec<&'static str>,
    status: &'static str,
    certificate: Option<String>,
    why: Option<String>,
    counterexample: Option<Values>,
    dropped: Vec<DroppedJson>,
}

#[derive(Serialize)]
struct DroppedJson {
    hypothesis: &'static str,
    status: &'static str,
    counterexample: Option<Values>,
}

#[derive(Serialize)]
struct ChangeJson {
    at: String,
    change: String,
    status: &'static str,
    by: Option<String>,
    counterexample: Option<Values>,
}

type Values = BTreeMap<&'static str, String>;

fn values(counterexample: &Counterexample) -> Values {
    counterexample.values.iter().map(|(name, x)| (*name, x.to_string())).collect()
}

impl Json {
    fn of(report: &Report) -> Self {
        let equation = |entry: &Entry| EquationJson {
            equation: entry.equation,
            claims: report.of(entry).into_iter().map(|proved| ClaimJson::of(report, proved)).collect(),
        };
        let equations = entries().iter().map(equation).filter(|e| !e.claims.is_empty()).collect();
        let change = |(Change { site, what }, outcome): &(Change, Outcome)| {
            let (status, by, counterexample) = match outcome {
                Outcome::Noticed { equation, name, counterexample } => {
                    ("noticed", Some(format!("{equation} {name}")), Some(values(counterexample)))
                }
                Outcome::Unchanged => ("unchanged", None, None),
                Outcome::Unnoticed => ("unnoticed", None, None),
            };
            ChangeJson { at: site.to_string(), change: what.to_string(), status, by, counterexample }
        };
        let changes = report.controls.changes.iter().map(change).collect();
        Json { summary: report.summary(), equations, changes }
    }
}

impl ClaimJson {
    fn of(report: &Report, proved: &Proved) -> Self {
        let Proved { statement, answer, .. } = proved;
        let dropped = report.dropped(statement).map(|Dropped { given, without, .. }| {
            let (status, counterexample) = match without {
                Without::Refuted(counterexample) => ("refuted", Some(values(counterexample))),
                Without::StillTrue => ("still_true", None),
                Without::Unknown => ("unknown", None),
            };
            DroppedJson { hypothesis: given.text(), status, counterexample }
        });
        let (certificate, why, counterexample) = match answer {
            Answer::Proof(proof) => (Some(paper::proof(proof).join("\n")), None, None),
            Answer::None(why, counterexample) => {
                (None, Some(why.clone()), counterexample.as_ref().map(values))
            }
        };
        ClaimJson {
            claim: statement.name,
            kind: statement.kind,
            statement: paper::claim(statement),
            hypotheses: proved.hypotheses(),
            status: proved.status(),
            certificate,
            why,
            counterexample,
            dropped: dropped.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use spring_mass_contact::number::{Field, Tree};
    use spring_mass_contact::proof::statement::Says;

    /// A run in which every equality is wrong by 1.
    fn refuted() -> Report {
        let wrong = |mut statement: Statement| {
            for goal in &mut statement.goals {
                if let Says::Equal(_, right) = &mut goal.says {
                    *right = &*right + Tree::int(1);
                }
            }
            attempt(&statement)
        };
        let all = statements().into_iter().map(wrong).collect();
        Report::new(all, Controls::default(), Vec::new(), (Duration::ZERO, Duration::ZERO), &|_| true)
    }

    #[test]
    fn what_is_refuted_fits_on_a_page_and_can_be_pasted() {
        let report = refuted();
        let text = output::printed(|out| {
            table(out, &report)?;
            details(out, &report)
        });
        assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
        assert!(text.contains(" REFUTED\n"), "{text}");
        // Backslashes taken away, each command is the one that belongs to its counterexample.
        let pasted = text.replace(" \\\n      ", " ");
        let commands: Vec<_> = pasted.lines().filter(|line| line.starts_with("  contact solve")).collect();
        let lines = report.proved.iter().filter_map(|proved| match &proved.answer {
            Answer::None(_, Some(counterexample)) => command_line(&counterexample.case()),
            _ => None,
        });
        let lines: Vec<_> = lines.map(|line| format!("  {line}")).collect();
        assert!(text.contains(" \\\n") && lines.len() > 50);
        assert_eq!(commands, [lines.as_slice(), &lines].concat());
    }

    #[test]
    fn products_stay_together() {
        let parts = |text: &str| {
            together(text).split(' ').map(|part| part.replace(output::GLUE, "_")).collect::<Vec<_>>()
        };
        assert_eq!(parts("it is 2 c ε² / (c + ε) − s₁ u"), ["it", "is", "2_c_ε²_/_(c", "+_ε)", "−_s₁_u"]);
        assert_eq!(parts("c > 0, ε ≥ 0: m g"), ["c", ">_0,", "ε", "≥_0:", "m_g"]);
        assert_eq!(parts(""), [""]);
    }
}
