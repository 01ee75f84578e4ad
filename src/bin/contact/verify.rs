//! `contact verify`: every claim, proved and in every number system, as one table.

use crate::output::{self, Exit, Failure};
use crate::{args, solve};
use clap::ValueEnum;
use spring_mass_contact::claims::{claim_names, entry};
use spring_mass_contact::number::NumberSystem;
use spring_mass_contact::verify::{self, Report, Row, Status, Suspect};
use std::io::{self, Write};

const EXAMPLES: &str = "\
Examples:
  contact verify
  contact verify 1.13 'Theorem 1.3.3'
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
    /// Only these numbers of the chapter: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Number system, repeatable [default: f32, f64, mpfr:256, exact]
    #[arg(long = "scalar", value_name = "S")]
    scalars: Vec<NumberSystem>,
    /// Cases to try a claim on, at least 1
    #[arg(value_parser = args::count)]
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().cases)]
    cases: u64,
    /// Where the cases are drawn from; the same seed, the same cases, on every machine
    #[arg(value_parser = args::whole)]
    #[arg(long, value_name = "N", default_value_t = verify::Options::default().seed)]
    seed: u64,
    /// How to print the report
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
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
        wanted.scalars = args::distinct(&options.scalars);
    }
    wanted.equations = args::equations(&options.numbers)?;
    if let Some(empty) = wanted.equations.iter().find(|e| claim_names(e).is_empty()) {
        return Err(format!(
            "invalid value '{empty}' for '[NUMBER]...': nothing is claimed of it; \
             `contact equations` lists how many claims each number has"
        )
        .into());
    }
    let report = output::with_progress("verifying", |progress| verify::verify(&wanted, progress));
    output::print(|out| print(out, &report, &wanted, options.format))?;
    Ok(exit(&report))
}

fn exit(report: &Report) -> Exit {
    if report.holds() { Exit::Fine } else { Exit::Unmet }
}

fn print(out: &mut dyn Write, report: &Report, options: &verify::Options, format: Format) -> io::Result<()> {
    match format {
        Format::Table => table(out, report, options),
        Format::Json => output::json(out, report),
        Format::Markdown => markdown(out, report),
    }
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
    where_to_look(out, report)?;
    let of = |status| report.rows.iter().filter(move |row| row.status == status);
    let mut failed: Vec<&Row> = of(Status::Failed).collect();
    failed.sort_by_key(|row| report.suspects.iter().all(|suspect| suspect.equation != Some(row.equation)));
    for alike in failed.chunk_by(|a, b| fail_alike(a, b)) {
        failure(out, alike)?;
        writeln!(out)?;
    }
    undecided(out, &of(Status::Undecided).collect::<Vec<_>>())?;
    let summary = report.summary();
    let in_numbers = || report.rows.iter().filter(|row| row.scalar.is_some());
    let tried = in_numbers().count();
    if summary.claims > tried {
        let all = counted((summary.claims - tried) as u64, "claim");
        writeln!(out, "{} of {all} proved for all values.", summary.proved)?;
    }
    writeln!(
        out,
        "{} of {} hold: {} decided, {} undecidable.",
        summary.held,
        counted(tried as u64, "claim"),
        counted(in_numbers().map(|row| row.decided).sum(), "trial"),
        in_numbers().map(|row| row.undecided).sum::<u64>()
    )?;
    writeln!(out, "{} from seed {}.", counted(options.cases, "case"), options.seed)?;
    let worst = of(Status::Held).filter_map(|row| row.worst.as_ref().map(|(ratio, _)| (*ratio, row)));
    if let Some((ratio, row)) = worst.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(ratio, _)| *ratio > 0.0) {
        let Row { equation, claim, scalar, .. } = row;
        let share = percent(ratio);
        writeln!(out, "Rounding used at most {share} of its bound ({equation} {claim}, {}).", name(*scalar))?;
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
        let cells = report.by_equation().map(|rows| cell(rows, way).len());
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
fn cell(rows: &[Row], way: Way) -> String {
    let rows = || rows.iter().filter(|row| row.scalar == way);
    let count = |status| rows().filter(|row| row.status == status).count();
    match (count(Status::Failed), count(Status::Undecided), rows().count()) {
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
    for rows in report.by_equation() {
        let [number, title] = entry(rows[0].equation)
            .map_or(Default::default(), |entry| [entry.label(), entry.title.to_string()]);
        table.add_row([number, title].into_iter().chain(ways.iter().map(|way| cell(rows, *way))));
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
        match unproved {
            0 => writeln!(out, "  it computes nothing, but hands on an argument")?,
            1 => writeln!(out, "  or at the claim: no other that speaks of it fails")?,
            _ => {
                let all = unproved + proved;
                writeln!(out, "  of {all} claims that speak of it, {unproved} are not proved")?;
            }
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
    let (Some(point), Some(case)) = (row.point(), counterexample) else { return Ok(()) };
    output::wrapped(out, "  ", 2, &output::glued(&point))?;
    solve::command(out, case)
}

/// The number systems of rows.
fn names(rows: &[&Row]) -> String {
    rows.iter().map(|row| name(row.scalar)).collect::<Vec<_>>().join(", ")
}

fn markdown(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(out, "| number | claim | kind | scalar | status | decided | undecided | worst share |")?;
    writeln!(out, "|---|---|---|---|---|---|---|---|")?;
    report.rows.iter().try_for_each(|row| {
        let Row { equation, claim, kind, status, decided, undecided, .. } = row;
        let scalar = row.scalar.map_or(String::new(), |scalar| scalar.to_string());
        let worst = row.worst.as_ref().map_or(String::new(), |(ratio, _)| format!("{ratio:.2}"));
        writeln!(
            out,
            "| {equation} | {claim} | {kind} | {scalar} | {status} | {decided} | {undecided} | {worst} |"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::printed;
    use spring_mass_contact::claims::Case;
    use spring_mass_contact::number::Exact;

    /// c = 1, m = 1/2, g = −1/3, everything else 7/3.
    fn case() -> Case<Exact> {
        let mut case = Case::of(|_| "7/3".parse().expect("a number"));
        let [c, m, g] = ["1", "1/2", "-1/3"].map(|text| text.parse().expect("a number"));
        (case.system.c, case.system.m, case.system.g) = (c, m, g);
        case
    }

    /// A claim of (1.13), by its proof or on five cases in a number system.
    fn row(way: Way, status: Status) -> Row {
        let decided = if way.is_some() && status != Status::Undecided { 4 } else { 0 };
        let failed = way.is_some() && status == Status::Failed;
        Row {
            equation: "1.13",
            claim: "rate",
            kind: "equal",
            status,
            scalar: way,
            why: None,
            decided,
            undecided: if way.is_some() { 5 - decided } else { 0 },
            worst: (decided > 0).then(|| (if failed { 1e80 } else { 2.5 }, "1/8".to_string())),
            counterexample: failed.then(case),
        }
    }

    fn report(rows: Vec<Row>) -> (Report, verify::Options) {
        let scalars = rows.iter().filter_map(|row| row.scalar).collect();
        let report = Report { rows, suspects: Vec::new(), repairs: Vec::new() };
        (report, verify::Options { scalars, cases: 5, seed: 42, equations: Vec::new() })
    }

    /// Not proved, wrong in f32 and f64 in the same case, open in two bits, right in rationals; and a claim
    /// before it that is wrong for another reason, but of which nobody is suspected.
    fn mistaken() -> (Report, verify::Options) {
        let [single, double, two_bits] = [NumberSystem::F32, NumberSystem::F64, NumberSystem::Mpfr(2)];
        let proof = Row { why: Some("the sides differ by c".into()), ..row(None, Status::Failed) };
        let rows = vec![
            proof.clone(),
            row(Some(single), Status::Failed),
            row(Some(double), Status::Failed),
            row(Some(two_bits), Status::Undecided),
            row(Some(NumberSystem::Exact), Status::Held),
        ];
        let (mut report, options) = report(rows);
        let suspect =
            Suspect { function: "penalty::deflection", equation: Some("1.13"), unproved: 7, proved: 2 };
        report.suspects.push(suspect);
        report.rows.insert(0, Row { equation: "1.1", claim: "root", ..proof });
        (report, options)
    }

    /// A title goes over two lines if it must, and how much of a bound is used is said of claims that hold.
    #[test]
    fn the_table_shows_where_to_look_what_failed_and_how() {
        let (report, options) = mistaken();
        let expected = r"
 number  title                        proved    f32       f64       mpfr:2
 (1.1)   Equilibrium of forces        1 FAILED  -         -         -
 (1.13)  Deflection by penalty and    1 FAILED  1 FAILED  1 FAILED  1 undecided
         its limit

 number  title                                exact
 (1.1)   Equilibrium of forces                -
 (1.13)  Deflection by penalty and its limit  1 held

(1.13) penalty::deflection: look here first
  of 9 claims that speak of it, 7 are not proved

1.13 rate NOT PROVED
  the sides differ by c

1.13 rate FAILED in f32, f64
  c = 1, m = 1/2, g = -1/3, l = 7/3, H = 7/3, ε = 7/3
  contact solve --scalar exact --stiffness 1 --mass 1/2 --gravity -1/3 \
      --free-length 7/3 --height 7/3 --method penalty --penalty 7/3

1.1 root NOT PROVED
  the sides differ by c

1.13 rate undecided in mpfr:2
  No case decides these, so nothing is known against them: try more --cases, or
  a --scalar with more digits.

0 of 2 claims proved for all values.
1 of 4 claims hold: 12 trials decided, 8 undecidable.
5 cases from seed 42.
Rounding used at most 250 % of its bound (1.13 rate, exact).
";
        assert_eq!(format!("\n{}", printed(|out| table(out, &report, &options))), expected);
        let text = printed(|out| markdown(out, &report));
        assert!(text.contains("\n| 1.13 | rate | equal |  | failed | 0 | 0 |  |\n"), "{text}");
        assert!(text.contains("\n| 1.13 | rate | equal | mpfr:2 | undecided | 0 | 5 |  |\n"), "{text}");
        assert!(text.contains("\n| 1.13 | rate | equal | exact | held | 4 | 1 | 2.50 |\n"), "{text}");
    }

    /// Where a function is wrong, mostly more than one claim fails.
    #[test]
    fn a_single_failure_can_be_the_claims_own() {
        for (unproved, said) in [
            (0, "it computes nothing, but hands on an argument"),
            (1, "or at the claim: no other that speaks of it fails"),
            (2, "of 5 claims that speak of it, 2 are not proved"),
        ] {
            let (mut report, _) = report(vec![row(None, Status::Failed)]);
            let (function, equation) = ("penalty::deflection", Some("1.13"));
            report.suspects = vec![Suspect { function, equation, unproved, proved: 5 - unproved }];
            let text = printed(|out| where_to_look(out, &report));
            assert_eq!(text, format!("(1.13) penalty::deflection: look here first\n  {said}\n\n"));
        }
    }

    /// One failure, in a proof or in numbers, first or last: by the status and in whatever format.
    #[test]
    fn a_failure_is_seen_by_status_and_in_every_format() {
        let ways = [None, Some(NumberSystem::F32), Some(NumberSystem::F64), Some(NumberSystem::Exact)];
        let well = |way: Way| row(way, if way.is_none() { Status::Proved } else { Status::Held });
        let printed = |report: &Report, options: &verify::Options| {
            [Format::Table, Format::Json, Format::Markdown]
                .map(|format| printed(|out| print(out, report, options, format)))
        };
        let failures = |texts: [String; 3]| texts.map(|text| text.to_lowercase().matches("failed").count());
        let (all_well, options) = report(ways.map(well).to_vec());
        assert_eq!(exit(&all_well), Exit::Fine);
        // In JSON the summary counts them by this name.
        assert_eq!(failures(printed(&all_well, &options)), [0, 1, 0]);
        for wrong in ways {
            let (mistaken, options) = report(
                ways.map(|way| if way == wrong { row(way, Status::Failed) } else { well(way) }).to_vec(),
            );
            assert_eq!(exit(&mistaken), Exit::Unmet, "{}", name(wrong));
            let texts = printed(&mistaken, &options);
            assert!(texts[1].contains("\"failed\": 1"), "{}", texts[1]);
            let of_table = if wrong.is_some() { 2 } else { 1 };
            assert_eq!(failures(texts), [of_table, 2, 1], "{}", name(wrong));
        }
        let (open, _) = report(vec![row(ways[1], Status::Undecided)]);
        assert_eq!(exit(&open), Exit::Fine);
        let (nothing, _) = report(Vec::new());
        assert_eq!(exit(&nothing), Exit::Unmet);
    }

    #[test]
    fn a_share_is_rounded_up_and_not_far() {
        let shares = [0.994, 0.99401, 1.0, 0.0001, 2.5].map(percent);
        assert_eq!(shares, ["99.4 %", "99.5 %", "100 %", "0.1 %", "250 %"]);
    }

    /// A case that is no system has no command line, whose numbers could be broken.
    #[test]
    fn no_line_is_longer_than_a_page_whatever_the_numbers() {
        let long = Case::of(|_| "-1234567890123456789/1152921504606846976".parse().expect("a number"));
        for c in [Exact::power_of_two(-1074), Exact::from(0)] {
            let mut row = row(Some(NumberSystem::F64), Status::Failed);
            let mut case = long.clone();
            (case.system.c, case.system.m) = (c, Exact::power_of_two(-700));
            row.counterexample = Some(case);
            let (report, options) = report(vec![row]);
            let text = printed(|out| table(out, &report, &options));
            assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
            assert_eq!(text.contains("contact solve"), !text.contains("c = 0"), "{text}");
        }
    }
}
