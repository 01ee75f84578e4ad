//! `contact verify`: every claim, proved and in every number system, as one table.

use crate::args;
use crate::output::{self, Exit, Failure, GLUE};

use clap::ValueEnum;
use serde::Serialize;
use spring_mass_contact::claims::{Case, Entry, Var, claim_names, entries, entry};
use spring_mass_contact::number::{Exact, NumberSystem, Text};
use spring_mass_contact::verify::{self, Report, Row, Suspect, command_line};
use std::collections::BTreeMap;
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact verify
  contact verify --equation 1.13 --equation 'Theorem 1.3.3'
  contact verify --scalar f32 --scalar mpfr:777 --cases 50 --seed 99
  contact verify --format json

Claims about what formulas are, and not about what floats make of them, are
proved for all values. A claim holds in a number system if it does in every case
that can be decided there, and at least one can. Rationals are compared by
equality, floats within the error bounds that balls compute along the way: there
are no tolerances.

What no case decides is undecided, which says nothing against it: so it is with
few cases, and with few digits.

Exit status: 0 none fails; 1 some do; 2 bad input.";

/// Prove every claim of the chapter, and check it in every number system
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Number system, repeatable [default: f32, f64, mpfr:256, exact]
    #[arg(long = "scalar", value_name = "S")]
    scalars: Vec<NumberSystem>,
    /// Cases to try a claim on, at least 1
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().cases, value_parser = args::count)]
    cases: u64,
    /// Where the cases are drawn from; the same seed, the same cases, on every machine
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().seed, value_parser = args::whole)]
    seed: u64,
    /// Only this number of the chapter, repeatable: 1.13, 'note 4', …
    #[arg(long = "equation", value_name = "NUMBER", value_parser = args::equation)]
    equations: Vec<String>,
    /// How to print the report
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// What `contact` alone does.
impl Default for Options {
    fn default() -> Self {
        let verify::Options { cases, seed, .. } = verify::Options::default();
        Options { scalars: Vec::new(), cases, seed, equations: Vec::new(), format: Format::Table }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For reading: a line an equation
    Table,
    /// For programs: everything
    Json,
    /// For documents: a line a claim and number system
    Markdown,
}

/// Verifies and reports.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let mut wanted = verify::Options { cases: options.cases, seed: options.seed, ..Default::default() };
    if !options.scalars.is_empty() {
        wanted.scalars.clear();
        for scalar in &options.scalars {
            if !wanted.scalars.contains(scalar) {
                wanted.scalars.push(*scalar);
            }
        }
    }
    wanted.equations.clone_from(&options.equations);
    if let Some(empty) = wanted.equations.iter().find(|e| claim_names(e).is_empty()) {
        return Err(format!(
            "invalid value '{empty}' for '--equation <NUMBER>': nothing is claimed of it; \
             `contact equations` lists how many claims each number has"
        )
        .into());
    }
    let report = output::with_progress("verifying", |progress| verify::verify(&wanted, progress));
    output::print(|out| match options.format {
        Format::Table => table(out, &report, &wanted),
        Format::Json => output::json(out, &Json::of(&report)),
        Format::Markdown => markdown(out, &report),
    })?;
    Ok(outcome(&report))
}

fn outcome(report: &Report) -> Exit {
    if report.holds() { Exit::Fine } else { Exit::Unmet }
}

fn rows_of<'a>(report: &'a Report, entry: &Entry) -> Vec<&'a Row> {
    report.rows.iter().filter(|row| row.equation == entry.equation).collect()
}

fn count(rows: &[&Row], status: verify::Status) -> usize {
    rows.iter().filter(|row| row.status == status).count()
}

/// What a claim is tried by: a number system, or the prover.
type Way = Option<NumberSystem>;

fn name(way: Way) -> String {
    way.map_or("proved".to_string(), |scalar| scalar.to_string())
}

fn table(out: &mut dyn Write, report: &Report, options: &verify::Options) -> io::Result<()> {
    let ways: Vec<Way> = [None].into_iter().chain(options.scalars.iter().copied().map(Some)).collect();
    for ways in side_by_side(report, &ways) {
        counts(out, report, ways)?;
        writeln!(out)?;
    }
    let rows: Vec<&Row> = report.rows.iter().collect();
    let of = |status| rows.iter().copied().filter(|row| row.status == status).collect::<Vec<_>>();
    where_to_look(out, report)?;
    let mut failed = of(verify::Status::Failed);
    failed.sort_by_key(|row| report.suspects.iter().all(|suspect| suspect.equation != Some(row.equation)));
    for alike in failed.chunk_by(|a, b| fail_alike(a, b)) {
        failure(out, alike)?;
        writeln!(out)?;
    }
    undecided(out, &of(verify::Status::Undecided))?;
    let (proofs, rows): (Vec<&Row>, Vec<&Row>) = rows.iter().copied().partition(|row| row.scalar.is_none());
    if !proofs.is_empty() {
        let (proved, all) = (count(&proofs, verify::Status::Proved), counted(proofs.len() as u64, "claim"));
        writeln!(out, "{proved} of {all} proved for all values.")?;
    }
    let trials = |of: fn(&Row) -> u64| rows.iter().map(|row| of(row)).sum::<u64>();
    writeln!(
        out,
        "{} of {} hold: {} decided, {} undecidable.",
        count(&rows, verify::Status::Held),
        counted(rows.len() as u64, "claim"),
        counted(trials(|row| row.decided), "trial"),
        trials(|row| row.undecided)
    )?;
    writeln!(out, "{} from seed {}.", counted(options.cases, "case"), options.seed)?;
    let kept = rows.iter().filter(|row| row.status == verify::Status::Held);
    let worst = kept.filter_map(|row| row.worst.as_ref().map(|(ratio, _)| (*ratio, row)));
    if let Some((ratio, row)) = worst.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(ratio, _)| *ratio > 0.0) {
        writeln!(
            out,
            "Rounding used at most {} of its bound ({} {}, {}).",
            percent(ratio),
            row.equation,
            row.claim,
            name(row.scalar)
        )?;
    }
    Ok(())
}

/// A share in per cent: with one decimal, and up, so that "at most" is true.
fn percent(share: f64) -> String {
    format!("{} %", (1e3 * share).ceil() / 10.0)
}

fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// What these columns have for themselves; the number and the title's longest word need the rest of a line.
const ROOM: usize = 45;

/// The blanks around a column.
const BLANKS: usize = 2;

/// The ways in groups whose columns fit beside each other.
fn side_by_side<'a>(report: &Report, ways: &'a [Way]) -> Vec<&'a [Way]> {
    let width = |way: Way| {
        let cells = entries().iter().map(|entry| cell(&rows_of(report, entry), way).len());
        cells.chain([name(way).len()]).max().unwrap_or(0) + BLANKS
    };
    let (mut groups, mut start, mut used) = (Vec::new(), 0, 0);
    for (i, way) in ways.iter().enumerate() {
        let width = width(*way);
        if used + width > ROOM && start < i {
            groups.push(&ways[start..i]);
            (start, used) = (i, 0);
        }
        used += width;
    }
    groups.push(&ways[start..]);
    groups
}

/// How many of an equation's claims are proved, or hold in a number system.
fn cell(rows: &[&Row], way: Way) -> String {
    let rows: Vec<&Row> = rows.iter().copied().filter(|row| row.scalar == way).collect();
    match (count(&rows, verify::Status::Failed), count(&rows, verify::Status::Undecided), rows.len()) {
        (_, _, 0) => "-".to_string(),
        (0, 0, all) if way.is_none() => all.to_string(),
        (0, 0, all) => format!("{all} held"),
        (0, undecided, _) => format!("{undecided} undecided"),
        (failed, ..) => format!("{failed} FAILED"),
    }
}

/// A line an equation.
fn counts(out: &mut dyn Write, report: &Report, ways: &[Way]) -> io::Result<()> {
    let mut table = output::table();
    let names = ways.iter().copied().map(name);
    table.set_header(["number", "title"].map(String::from).into_iter().chain(names));
    for entry in entries() {
        let rows = rows_of(report, entry);
        if !rows.is_empty() {
            let cells = ways.iter().map(|way| cell(&rows, *way));
            table.add_row([entry.label(), entry.title.to_string()].into_iter().chain(cells));
        }
    }
    let columns: Vec<usize> = (0..2 + ways.len()).filter(|column| *column != 1).collect();
    output::unbroken(&mut table, &columns);
    output::lines(out, &table)
}

/// What the claims that are not proved have in common, and what would mend them.
fn where_to_look(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    for Suspect { function, equation, unproved, proved } in &report.suspects {
        let number = equation.and_then(entry).map_or(String::new(), |entry| entry.label() + " ");
        writeln!(out, "{number}{function}: look here first")?;
        if *unproved == 0 {
            writeln!(out, "  it computes nothing, but hands on an argument")?;
        } else {
            writeln!(out, "  of the claims that speak of it {unproved} are not proved, and {proved} are")?;
        }
    }
    for change in &report.repairs {
        output::wrapped(out, "  ", 4, &format!("with {change} every claim would be proved"))?;
    }
    if report.suspects.is_empty() { Ok(()) } else { writeln!(out) }
}

/// One claim, failing for the same reason in two number systems; these stand together in a report.
fn fail_alike(a: &Row, b: &Row) -> bool {
    (a.equation, a.claim, &a.why, &a.counterexample) == (b.equation, b.claim, &b.why, &b.counterexample)
        && a.scalar.is_none() == b.scalar.is_none()
}

/// What no case decided, a line a claim, and what helps.
fn undecided(out: &mut dyn Write, rows: &[&Row]) -> io::Result<()> {
    for alike in rows.chunk_by(|a, b| (a.equation, a.claim) == (b.equation, b.claim)) {
        let Row { equation, claim, .. } = alike[0];
        output::wrapped(out, "", 2, &format!("{equation} {claim} undecided in {}", names(alike)))?;
    }
    if rows.is_empty() {
        return Ok(());
    }
    const ADVICE: &str = "No case decides these, so nothing is known against them: try more --cases, or a \
                          --scalar with more digits.";
    output::wrapped(out, "  ", 2, ADVICE)?;
    writeln!(out)
}

/// Failures that are alike, of which there is at least one.
fn failure(out: &mut dyn Write, alike: &[&Row]) -> io::Result<()> {
    let row = alike[0];
    let Row { equation, claim, why, counterexample, .. } = row;
    match row.scalar {
        None => writeln!(out, "{equation} {claim} NOT PROVED")?,
        Some(_) => output::wrapped(out, "", 2, &format!("{equation} {claim} FAILED in {}", names(alike)))?,
    }
    if let Some(why) = why {
        output::wrapped(out, "  ", 4, why)?;
    }
    let Some(case) = counterexample else { return Ok(()) };
    let numbers = symbols(case).into_iter().map(|(symbol, x)| format!("{symbol}{GLUE}={GLUE}{x}"));
    output::wrapped(out, "  ", 2, &numbers.collect::<Vec<_>>().join(", "))?;
    command_line(case).map_or(Ok(()), |line| output::command(out, line.split(' ')))
}

/// The number systems of rows.
fn names(rows: &[&Row]) -> String {
    rows.iter().map(|row| name(row.scalar)).collect::<Vec<_>>().join(", ")
}

fn symbols(case: &Case<Exact>) -> Vec<(&'static str, String)> {
    Var::ALL.iter().map(|var| (var.symbol(), case.get(*var).to_string())).collect()
}

fn status(row: &Row) -> &'static str {
    match row.status {
        verify::Status::Proved => "proved",
        verify::Status::Held => "held",
        verify::Status::Undecided => "undecided",
        _ => "failed",
    }
}

fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(out, "| number | claim | kind | scalar | status | decided | undecided | worst share |")?;
    writeln!(out, "|---|---|---|---|---|---|---|---|")?;
    report.rows.iter().try_for_each(|row| {
        let worst = row.worst.as_ref().map_or(String::new(), |(ratio, _)| format!("{ratio:.2}"));
        let (status, decided, undecided) = (status(row), row.decided, row.undecided);
        writeln!(
            out,
            "| {} | {} | {} | {} | {status} | {decided} | {undecided} | {worst} |",
            row.equation,
            row.claim,
            row.kind,
            row.scalar.map_or(String::new(), |scalar| scalar.to_string())
        )
    })
}

#[derive(Serialize)]
struct Json {
    summary: Summary,
    suspects: Vec<SuspectJson>,
    repairs: Vec<String>,
    equations: Vec<Equation>,
}

#[derive(Serialize)]
struct SuspectJson {
    equation: Option<&'static str>,
    function: &'static str,
    unproved: usize,
    proved: usize,
}

#[derive(Serialize)]
struct Summary {
    claims: usize,
    proved: usize,
    held: usize,
    undecided: usize,
    failed: usize,
}

#[derive(Serialize)]
struct Equation {
    equation: &'static str,
    claims: Vec<Claim>,
}

#[derive(Serialize)]
struct Claim {
    claim: &'static str,
    kind: &'static str,
    status: &'static str,
    scalar: Option<String>,
    why: Option<String>,
    decided: u64,
    undecided: u64,
    worst: Option<String>,
    bound: Option<String>,
    counterexample: Option<BTreeMap<&'static str, String>>,
}

impl Json {
    fn of(report: &Report) -> Self {
        let rows: Vec<&Row> = report.rows.iter().collect();
        let summary = Summary {
            claims: rows.len(),
            proved: count(&rows, verify::Status::Proved),
            held: count(&rows, verify::Status::Held),
            undecided: count(&rows, verify::Status::Undecided),
            failed: count(&rows, verify::Status::Failed),
        };
        let equation = |entry: &Entry| Equation {
            equation: entry.equation,
            claims: rows_of(report, entry).into_iter().map(Claim::of).collect(),
        };
        let equations = entries().iter().map(equation).filter(|e| !e.claims.is_empty()).collect();
        let suspects = report.suspects.iter().map(|suspect| {
            let Suspect { function, equation, unproved, proved } = *suspect;
            SuspectJson { equation, function, unproved, proved }
        });
        let repairs = report.repairs.iter().map(ToString::to_string);
        Json { summary, suspects: suspects.collect(), repairs: repairs.collect(), equations }
    }
}

impl Claim {
    fn of(row: &Row) -> Self {
        Claim {
            claim: row.claim,
            kind: row.kind,
            status: status(row),
            scalar: row.scalar.map(|scalar| scalar.to_string()),
            why: row.why.clone(),
            decided: row.decided,
            undecided: row.undecided,
            worst: row.worst.as_ref().map(|(ratio, _)| Text::text(ratio)),
            bound: row.worst.as_ref().map(|(_, bound)| bound.clone()),
            counterexample: row.counterexample.as_ref().map(|case| symbols(case).into_iter().collect()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::printed;
    use spring_mass_contact::claims::claims;

    /// c = 1, m = 1/2, g = −1/3, everything else 7/3.
    fn case() -> Case<Exact> {
        let numbers = |var| match var {
            Var::C => "1",
            Var::M => "1/2",
            Var::G => "-1/3",
            _ => "7/3",
        };
        Case::try_of(|var| numbers(var).parse()).expect("numbers")
    }

    fn row(status: verify::Status, scalar: NumberSystem, counterexample: Option<Case<Exact>>) -> Row {
        let scalar = Some(scalar);
        let decided = if status == verify::Status::Held || counterexample.is_some() { 4 } else { 0 };
        let worst = (decided > 0).then(|| (2.5, "1/8".to_string()));
        let claim = claims().iter().find(|claim| claim.equation == "1.13").expect("a claim");
        let (claim, kind, undecided) = (claim.name, claim.kind.name(), 5 - decided);
        Row {
            equation: "1.13",
            claim,
            kind,
            scalar,
            status,
            why: None,
            decided,
            undecided,
            worst,
            counterexample,
        }
    }

    /// In f32 the claim is wrong, in two bits nothing can be said, in rationals it holds.
    fn report() -> (Report, verify::Options) {
        use verify::Status::{Failed, Held, Undecided};
        let scalars = vec![NumberSystem::F32, NumberSystem::Mpfr(2), NumberSystem::Exact];
        let statuses = [(Failed, Some(case())), (Undecided, None), (Held, None)];
        let rows = scalars.iter().zip(statuses).map(|(scalar, (status, case))| row(status, *scalar, case));
        let report = Report { rows: rows.collect(), suspects: Vec::new(), repairs: Vec::new() };
        (report, verify::Options { scalars, cases: 5, seed: 42, equations: Vec::new() })
    }

    #[test]
    fn the_table_shows_how_a_claim_fails() {
        let (report, options) = report();
        let text = printed(|out| table(out, &report, &options));
        let name = report.rows[0].claim;
        for line in [
            " number  title                            proved  f32       mpfr:2       exact".to_string(),
            " (1.13)  Deflection by penalty and its    -       1 FAILED  1 undecided  1 held".to_string(),
            format!("1.13 {name} FAILED in f32"),
            "  contact solve --scalar exact --stiffness 1 --mass 1/2 --gravity -1/3 \\".to_string(),
            "      --free-length 7/3 --height 7/3 --method penalty --penalty 7/3".to_string(),
            format!("1.13 {name} undecided in mpfr:2"),
            "  No case decides these, so nothing is known against them: try more --cases, or".to_string(),
            "1 of 3 claims hold: 8 trials decided, 7 undecidable.".to_string(),
            "5 cases from seed 42.".to_string(),
            format!("Rounding used at most 250 % of its bound (1.13 {name}, exact)."),
        ] {
            assert!(text.lines().any(|l| l == line), "no line {line:?} in\n{text}");
        }
        for var in Var::ALL {
            let number = format!(" {} = {}", var.symbol(), case().get(*var));
            assert!(text.contains(&number), "no {number} in\n{text}");
        }
        assert_eq!(outcome(&report), Exit::Unmet);
    }

    #[test]
    fn what_is_undecided_is_no_failure() {
        let (mut report, options) = report();
        report.rows.remove(0);
        let text = printed(|out| table(out, &report, &options));
        assert!(text.contains("1 undecided") && !text.contains("FAILED"), "{text}");
        assert_eq!(outcome(&report), Exit::Fine);
    }

    #[test]
    fn why_a_claim_broke_off_is_said_with_its_case() {
        let (mut report, options) = report();
        report.rows[0].why = Some("division by zero".to_string());
        let text = printed(|out| table(out, &report, &options));
        assert!(text.contains("FAILED in f32\n  division by zero\n  c = 1, m = 1/2"), "{text}");
        let json = serde_json::to_value(Json::of(&report)).expect("JSON");
        assert_eq!(json["equations"][0]["claims"][0]["why"], "division by zero");
    }

    #[test]
    fn where_to_look_comes_before_what_fails() {
        let (mut report, options) = report();
        let other = Row { equation: "1.1", ..report.rows[0].clone() };
        report.rows.insert(0, other);
        report.suspects =
            vec![Suspect { function: "penalty::deflection", equation: Some("1.13"), unproved: 7, proved: 2 }];
        let text = printed(|out| table(out, &report, &options));
        let place = |what: &str| text.find(what).unwrap_or_else(|| panic!("no {what} in {text}"));
        let name = report.rows[1].claim;
        let lines = [
            "(1.13) penalty::deflection: look here first\n  of the claims that speak of it 7 are not proved, and 2 are",
            &format!("1.13 {name} FAILED"),
            &format!("1.1 {name} FAILED"),
        ];
        assert!(lines.map(place).is_sorted(), "{text}");
        let json = serde_json::to_value(Json::of(&report)).expect("JSON");
        assert_eq!(json["suspects"][0]["function"], "penalty::deflection");
    }

    #[test]
    fn a_share_is_rounded_up_and_not_far() {
        assert_eq!(
            [0.994, 0.99401, 1.0, 0.0001, 2.5].map(percent),
            ["99.4 %", "99.5 %", "100 %", "0.1 %", "250 %"]
        );
    }

    #[test]
    fn the_table_shows_what_is_proved_and_what_is_not() {
        let (mut report, options) = report();
        let proof = |status, why: Option<&str>| Row {
            scalar: None,
            why: why.map(String::from),
            decided: 0,
            undecided: 0,
            worst: None,
            ..row(status, NumberSystem::F32, None)
        };
        report.rows.truncate(0);
        report.rows.extend([
            proof(verify::Status::Proved, None),
            row(verify::Status::Held, NumberSystem::F32, None),
        ]);
        assert_eq!(outcome(&report), Exit::Fine);
        let one = verify::Options { scalars: vec![NumberSystem::F32], ..options };
        let text = printed(|out| table(out, &report, &one));
        assert!(text.contains("its limit  1       1 held\n"), "{text}");
        assert!(text.contains("1 of 1 claim proved for all values.\n1 of 1 claim hold"), "{text}");

        report.rows[0] = proof(verify::Status::Failed, Some("the sides differ by c"));
        let text = printed(|out| table(out, &report, &one));
        let name = report.rows[0].claim;
        assert!(text.contains("1 FAILED"), "{text}");
        assert!(text.contains(&format!("1.13 {name} NOT PROVED\n  the sides differ by c\n")), "{text}");
        assert_eq!(outcome(&report), Exit::Unmet);
    }

    #[test]
    fn failures_that_are_alike_are_shown_once() {
        let (mut report, mut options) = report();
        report.rows[1] = row(verify::Status::Failed, NumberSystem::F64, Some(case()));
        options.scalars[1] = NumberSystem::F64;
        // What a wrong formula is off by is no rounding.
        report.rows[0].worst = Some((1e80, "1/8".to_string()));
        let text = printed(|out| table(out, &report, &options));
        let name = report.rows[0].claim;
        assert!(text.contains(&format!("1.13 {name} FAILED in f32, f64\n")), "{text}");
        assert_eq!(
            (text.matches("FAILED in").count(), text.matches("contact solve").count()),
            (1, 1),
            "{text}"
        );
        assert!(text.contains("at most 250 %"), "{text}");
    }

    #[test]
    fn a_case_that_is_no_system_has_no_command_line() {
        let (mut report, options) = report();
        let mut hanging = case();
        hanging.system.c = Exact::from(0);
        report.rows[0].counterexample = Some(hanging);
        let text = printed(|out| table(out, &report, &options));
        assert!(text.contains("  c = 0, m = 1/2") && !text.contains("contact solve"), "{text}");
    }

    #[test]
    fn no_line_is_longer_than_a_page_whatever_the_numbers() {
        let (mut report, options) = report();
        let mut long = case();
        for var in Var::ALL {
            *long.get_mut(*var) = "-1234567890123456789/1152921504606846976".parse().expect("a number");
        }
        // As long as a small f64 is.
        long.system.c = Exact::power_of_two(-1074);
        long.system.m = Exact::power_of_two(-700);
        report.rows[0].counterexample = Some(long);
        let text = printed(|out| table(out, &report, &options));
        assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
    }

    #[test]
    fn json_and_markdown_show_how_a_claim_fails() {
        let (report, _) = report();
        let json = serde_json::to_value(Json::of(&report)).expect("JSON");
        assert_eq!(
            json["summary"],
            serde_json::json!({"claims": 3, "proved": 0, "held": 1, "undecided": 1, "failed": 1})
        );
        let claims = &json["equations"][0]["claims"];
        let statuses = [0, 1, 2].map(|i| claims[i]["status"].as_str());
        assert_eq!(statuses, [Some("failed"), Some("undecided"), Some("held")]);
        let counterexample = claims[0]["counterexample"].as_object().expect("a case");
        assert_eq!(counterexample.len(), Var::ALL.len());
        for var in Var::ALL {
            assert_eq!(counterexample[var.symbol()], case().get(*var).to_string());
        }
        assert_eq!((&claims[0]["worst"], &claims[0]["bound"]), (&"2.5".into(), &"1/8".into()));
        for key in ["worst", "bound", "counterexample"] {
            assert!(claims[1].as_object().is_some_and(|claim| claim[key].is_null()), "{key}");
        }
        let text = printed(|out| markdown(out, &report));
        let name = report.rows[0].claim;
        assert!(text.contains(&format!("| 1.13 | {name} | equal | f32 | failed | 4 | 1 | 2.50 |")), "{text}");
        assert!(text.contains("| mpfr:2 | undecided | 0 | 5 |  |"), "{text}");
    }

    #[test]
    fn columns_fit_beside_each_other() {
        let (report, _) = report();
        let usual: Vec<Way> =
            [None].into_iter().chain(verify::Options::default().scalars.into_iter().map(Some)).collect();
        assert_eq!(side_by_side(&report, &usual), [usual.as_slice()]);
        let many: Vec<Way> = (0..10).map(|i| Some(NumberSystem::Mpfr(1_000_000 - i))).collect();
        let groups = side_by_side(&report, &many);
        assert!(groups.iter().all(|group| !group.is_empty()) && groups.concat() == many, "{groups:?}");
    }
}
