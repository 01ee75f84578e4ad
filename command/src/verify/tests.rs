use super::*;
use crate::output::capture;
use spring_mass_contact::claims::Case;
use spring_mass_contact::number::Exact;

/// c = 1, m = 1/2, g = −1/3, everything else 7/3.
fn case() -> Case<Exact> {
    let mut case = Case::of(|_| "7/3".parse().expect("a number"));
    let [c, m, g] = ["1", "1/2", "-1/3"].map(|text| text.parse().expect("a number"));
    (case.system.c, case.system.m, case.system.g) = (c, m, g);
    case
}

/// Returns the row of a claim of (1.13), with its proof or five cases in a number system.
fn row(column: Column, status: Status) -> ClaimResult {
    let decided = if column.is_some() && status != Status::Undecided { 4 } else { 0 };
    let failed = column.is_some() && status == Status::Failed;
    ClaimResult {
        equation: "1.13",
        claim: "rate",
        kind: "equal",
        status,
        scalar: column,
        reason: None,
        decided,
        undecided: if column.is_some() { 5 - decided } else { 0 },
        worst: (decided > 0).then(|| (if failed { 1e80 } else { 2.5 }, "1/8".to_string())),
        counterexample: failed.then(case),
    }
}

fn report(rows: Vec<ClaimResult>) -> (VerificationReport, verify::Options) {
    let scalars = rows.iter().filter_map(|row| row.scalar).collect();
    let report = VerificationReport { rows, shared: Vec::new() };
    (report, verify::Options { scalars, cases: 5, seed: 42, equations: Vec::new() })
}

/// A claim that is not proved, wrong in f32 and f64 in the same case, undecided with two bits, and right in
/// rationals; before it another claim that is not proved.
fn mistaken() -> (VerificationReport, verify::Options) {
    let [single, double, two_bits] = [NumberSystem::F32, NumberSystem::F64, NumberSystem::Mpfr(2)];
    let proof = ClaimResult { reason: Some("the sides differ by c".into()), ..row(None, Status::Failed) };
    let rows = vec![
        proof.clone(),
        row(Some(single), Status::Failed),
        row(Some(double), Status::Failed),
        row(Some(two_bits), Status::Undecided),
        row(Some(NumberSystem::Exact), Status::Held),
    ];
    let (mut report, options) = report(rows);
    report.shared = vec!["penalty::deflection", "structure::equilibrium_residual", "system::reaction"];
    report.rows.insert(0, ClaimResult { equation: "1.1", claim: "root", ..proof });
    (report, options)
}

/// A long title is broken, and the ratio of error and bound is printed for claims that hold.
#[test]
fn the_table_shows_failed_claims_counterexamples_and_shared_functions() {
    let (report, options) = mistaken();
    let expected = r"
 number  title                        proved    f32       f64       mpfr:2
 (1.1)   Equilibrium of forces        1 FAILED  -         -         -
 (1.13)  Deflection by penalty and    1 FAILED  1 FAILED  1 FAILED  1 undecided
         its limit

 number  title                                exact
 (1.1)   Equilibrium of forces                -
 (1.13)  Deflection by penalty and its limit  1 held

1.1 root NOT PROVED
  the sides differ by c

1.13 rate NOT PROVED
  the sides differ by c

1.13 rate FAILED in f32, f64
  c = 1, m = 1/2, g = -1/3, l = 7/3, H = 7/3, ε = 7/3

1.13 rate undecided in mpfr:2
  No case decides these, which is not a failure: try more --cases, or a --scalar
  with a higher precision.

0 of 2 claims proved for all values.
1 of 4 checks hold: 12 trials decided, 8 undecidable.
5 cases from seed 42.
Rounding errors: at most 250 % of the bound (1.13 rate, exact).
Every claim that is not proved uses penalty::deflection,
  structure::equilibrium_residual, system::reaction.
";
    assert_eq!(format!("\n{}", capture(|out| table(out, &report, &options))), expected);
}

/// An unproved claim is reported separately, even if a number system fails in the same way.
#[test]
fn failures_of_proofs_and_of_number_systems_are_distinguished() {
    let reason = Some("division by 0".to_string());
    let columns = [None, Some(NumberSystem::F32), Some(NumberSystem::F64)];
    let broken =
        |column| ClaimResult { reason: reason.clone(), counterexample: None, ..row(column, Status::Failed) };
    let (report, options) = report(columns.map(broken).to_vec());
    let text = capture(|out| table(out, &report, &options));
    let reason = "\n  division by 0\n\n";
    assert!(
        text.contains(&format!("1.13 rate NOT PROVED{reason}1.13 rate FAILED in f32, f64{reason}")),
        "{text}"
    );
}

/// One failure, in a proof or in numbers, first or last, is visible in the status and in every format.
#[test]
fn a_failure_is_seen_by_status_and_in_every_format() {
    let columns = [None, Some(NumberSystem::F32), Some(NumberSystem::F64), Some(NumberSystem::Exact)];
    let well = |column: Column| row(column, if column.is_none() { Status::Proved } else { Status::Held });
    let printed = |report: &VerificationReport, options: &verify::Options| {
        [Format::Table, Format::Json].map(|format| capture(|out| print(out, report, options, format)))
    };
    let failures = |texts: [String; 2]| texts.map(|text| text.to_lowercase().matches("failed").count());
    let (all_well, options) = report(columns.map(well).to_vec());
    assert_eq!(exit(&all_well), Exit::Success);
    // The summary in JSON has a key with this name.
    assert_eq!(failures(printed(&all_well, &options)), [0, 1]);
    for wrong in columns {
        let (mistaken, options) = report(
            columns
                .map(|column| if column == wrong { row(column, Status::Failed) } else { well(column) })
                .to_vec(),
        );
        assert_eq!(exit(&mistaken), Exit::Unsatisfied, "{}", column_name(wrong));
        let texts = printed(&mistaken, &options);
        assert!(texts[1].contains("\"failed\": 1"), "{}", texts[1]);
        let of_table = if wrong.is_some() { 2 } else { 1 };
        assert_eq!(failures(texts), [of_table, 2], "{}", column_name(wrong));
    }
    let (open, _) = report(vec![row(columns[1], Status::Undecided)]);
    assert_eq!(exit(&open), Exit::Success);
    let (nothing, _) = report(Vec::new());
    assert_eq!(exit(&nothing), Exit::Unsatisfied);
}

#[test]
fn a_share_is_rounded_up_and_not_far() {
    let shares = [0.994, 0.99401, 1.0, 0.0001, 2.5].map(percent);
    assert_eq!(shares, ["99.4 %", "99.5 %", "100 %", "0.1 %", "250 %"]);
}

#[test]
fn no_line_exceeds_the_width_for_any_numbers() {
    let mut row = row(Some(NumberSystem::F64), Status::Failed);
    let mut case = Case::of(|_| "-1234567890123456789/1152921504606846976".parse().expect("a number"));
    (case.system.c, case.system.m) = (Exact::power_of_two(-1074), Exact::power_of_two(-700));
    row.counterexample = Some(case);
    let (report, options) = report(vec![row]);
    let text = capture(|out| table(out, &report, &options));
    assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
}
