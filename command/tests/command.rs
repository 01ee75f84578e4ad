//! The command `contact` as a child process.
//!
//! Its output is recorded in `tests/cmd`, with a reason for each value; these tests check properties beyond
//! snapshots: bounds hold, formats agree, and invalid input has one line.

use crate::processes::{DEADLINE, Scratch, captured, command, root};
use serde_json::Value;
use spring_mass_contact::chapter::{SpringMass, contact};
use spring_mass_contact::claims::entries;
use spring_mass_contact::number::{Exact, PositivePart, RangeError, ToExact};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{Method, Plane, solve_observed};
use spring_mass_contact::verify::claim_names;
use std::iter;
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;

/// `contact prove`, run once for all tests.
static PROVED: LazyLock<Output> = LazyLock::new(|| contact(&["prove"]));

/// `contact verify` with few cases, run once for all tests.
static VERIFIED: LazyLock<Output> = LazyLock::new(|| contact(&["verify", "--cases", "20"]));

fn contact(arguments: &[&str]) -> Output {
    // Neither the width nor the colours of whoever runs the tests.
    captured(command().env("COLUMNS", "80").env("NO_COLOR", "1").args(arguments))
}

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

fn contact_line(line: &str) -> Output {
    contact(&words(line))
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).expect("UTF-8")
}

fn json(arguments: &[&str]) -> (Value, Option<i32>) {
    let output = contact(&[arguments, &["--format", "json"]].concat());
    (serde_json::from_slice(&output.stdout).expect("JSON"), output.status.code())
}

fn solve(arguments: &str) -> (Value, Option<i32>) {
    json(&words(&format!("solve {arguments}")))
}

/// In rationals every difference between numbers affects the result.
#[test]
fn an_augmentation_by_default_is_that_of_the_library() {
    let system = SpringMass { c: "4", m: "1", g: "10", l: "1", h: "3" }.parse().unwrap();
    for penalty in ["4", "1/100"] {
        let (json, _) = solve(&format!(
            "--method augmented --scalar exact --penalty {penalty} --stiffness 4 --mass 1 --gravity 10 \
             --free-length 1 --height 3"
        ));
        let answer =
            spring_mass_contact::solver::solve(&system, &Method::augmented(penalty.parse().unwrap()))
                .unwrap();
        assert_eq!(json["outcome"].as_str(), Some(answer.outcome.to_string().as_str()));
        assert_eq!(
            (json["augmentations"].as_u64(), exact(&json["deflection"])),
            (answer.augmentations, answer.deflection)
        );
    }
}

fn exact(value: &Value) -> Exact {
    value.as_str().and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn output_is_reproducible() {
    let contact = std::path::Path::new(env!("CARGO_BIN_EXE_contact"));
    // `contact check` finds the command by its name, too.
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders =
        contact.parent().map(|own| own.to_path_buf()).into_iter().chain(std::env::split_paths(&path));
    let path = std::env::join_paths(folders).unwrap();
    trycmd::TestCases::new()
        .register_bin("contact", contact)
        .env("PATH", path.to_str().unwrap())
        .env("COLUMNS", "80")
        .env("NO_COLOR", "1")
        .timeout(DEADLINE)
        .case("tests/cmd/*.trycmd")
        .run();
}

/// Outcomes of solves: if the number of augmentations is given, it is ⌊ln(p₀/tol)/ln(1 + ε/c)⌋ + 1 with p₀ =
/// 4.81/(100 + ε), and rounding does not change it.
#[test]
fn solves_end_as_they_should() {
    for (arguments, outcome, augmentations, steps_needed) in [
        ("--penalty 100 --tolerance 1e-12", "converged", Some(35), Some("35")),
        ("--penalty 100 --tolerance 1e-30", "stagnated", None, Some("95")),
        // Nearly: the R of f32 is 4.81000518…, and its H − l is 0.04999995….
        ("--penalty 100 --tolerance 1e-12 --scalar f32", "stagnated", None, Some("35")),
        // p₀ = 4.8…e-12 < 1e-11 but not 1e-12, which one step more is: ρ = 1e-10.
        ("--penalty 1e12 --tolerance 1e-18", "stagnated", None, Some("1")),
        // ln(4.805…e-5/1e-17)/ln 1001 = 4.22….
        ("--penalty 1e5 --tolerance 1e-17", "stagnated", None, Some("5")),
        ("--penalty 1e-9 --tolerance 1e-3", "iteration_limit", Some(1000), Some("387328217713")),
        (
            "--penalty 1e-9 --tolerance 1e-3 --max-augmentations 0",
            "iteration_limit",
            Some(0),
            Some("387328217713"),
        ),
        ("--penalty 100 --tolerance 1e-30 --scalar mpfr:200", "converged", Some(95), Some("95")),
        ("--penalty 100 --tolerance 1e-30 --scalar exact", "converged", Some(95), Some("95")),
        // p̂ is 0 at once, and only the bound knows that 1e-6 is met all the same.
        ("--penalty 1e8 --tolerance 1e-6 --scalar f32", "converged", Some(0), Some("0")),
    ] {
        let (answer, code) = solve(&format!("--method augmented {arguments}"));
        assert_eq!(answer["outcome"], outcome, "{arguments}");
        assert_eq!(code, Some(if outcome == "converged" { 0 } else { 1 }), "{arguments}");
        if let Some(k) = augmentations {
            assert_eq!(answer["augmentations"], k, "{arguments}");
        }
        assert_eq!(answer["steps_needed"].as_str(), steps_needed, "{arguments}");
        assert_eq!(answer["floor"].is_null(), outcome != "stagnated", "{arguments}");
    }
}

/// Below the guaranteed floor a tolerance may still be met, and rounding may require another step:
/// ln((4.81/101)/1e-14)/ln 1.01 = 2933.5…. Only the guaranteed part is printed.
#[test]
fn only_guaranteed_counts_are_printed() {
    let solve = |limit| {
        let line =
            format!("solve --method augmented --penalty 1 --tolerance 1e-14 --max-augmentations {limit}");
        contact_line(&line)
    };
    let words = |output: &Output| stdout(output).split_whitespace().collect::<Vec<_>>().join(" ");
    for limit in ["1000", "2934"] {
        let output = solve(limit);
        let said = format!(
            "iteration_limit at k = {limit}: |u − u*| < 1e-14 m needs k = 2934 in exact arithmetic, which rounding may \
             prevent; a larger --penalty meets it, see contact advise"
        );
        assert!(words(&output).contains(&said) && output.status.code() == Some(1), "{}", stdout(&output));
    }
    let output = solve("10000");
    assert!(words(&output).contains("converged at k = 2935: |u − u*| < 1e-14 m"), "{}", stdout(&output));
    // Where it is guaranteed, and where there is no rounding.
    for (line, said) in [
        (
            "--penalty 1 --tolerance 1e-3",
            "needs k = 389 in exact arithmetic, and rounding may add a few; try",
        ),
        ("--penalty 100 --tolerance 1e-30 --scalar exact", "needs k = 95; try a larger --max-augmentations"),
    ] {
        let line = format!("solve --method augmented --max-augmentations 2 {line}");
        let output = contact_line(&line);
        assert!(words(&output).contains(said), "{}", stdout(&output));
    }
}

/// R of the default system in f32 is 630457/131072, far from 10⁸ p̂.
#[test]
fn the_force_of_f32_is_enclosed() {
    let (answer, _) = solve("--method augmented --penalty 1e8 --tolerance 1e-6 --scalar f32");
    let force = &answer["bounds"]["contact_force"];
    let reaction: Exact = "630457/131072".parse().unwrap();
    assert!(exact(&force[0]) <= reaction && reaction <= exact(&force[1]), "{force}");
}

/// Asserts that the bounds contain the exact solution for the rounded parameters, by (1.6) in rationals.
fn enclosed<T: ToExact>(system: &SpringMass<Exact>, like: &T, bounds: &Value) {
    let rounded =
        |x: &Exact| -> Result<Exact, RangeError> { Ok(like.round_from_exact(x)?.to_exact().unwrap()) };
    let system = system.try_map(rounded).unwrap();
    let u = contact::deflection(&system);
    let answers = [
        ("penetration", contact::penetration(&system, &u)),
        ("contact_force", contact::contact_force(&system)),
        ("deflection", u),
    ];
    for (name, answer) in answers {
        let [lower, upper] = [0, 1].map(|end| exact(&bounds[name][end]));
        assert!(
            lower <= answer && answer <= upper,
            "{name} of {system:?}: {answer} is not in {}",
            bounds[name]
        );
    }
}

/// The bounds hold as decimals, not only as the floats that they are printed from.
#[test]
fn bounds_hold_as_written() {
    let stiffnesses = ["100", "0.1", "1/3", "7e-30", "1.7e30"];
    let heights = ["1.05", "1.0981", "2", "-1/3", "1.00000000000000001", "1e-30", "1e30"];
    for (c, h) in stiffnesses.into_iter().flat_map(|c| heights.map(|h| (c, h))) {
        for (scalar, method) in ["f32", "f64", "mpfr:2", "mpfr:10", "mpfr:113", "exact"]
            .into_iter()
            .flat_map(|scalar| ["lagrange", "augmented --max-augmentations 3"].map(|method| (scalar, method)))
        {
            let (answer, _) =
                solve(&format!("--stiffness {c} --height {h} --scalar {scalar} --method {method}"));
            let system = SpringMass { c, m: "1", g: "9.81", l: "1", h }.parse().unwrap();
            let bounds = &answer["bounds"];
            match scalar.strip_prefix("mpfr:") {
                Some(bits) => enclosed(&system, &Exact::from(0).to_mpfr(bits.parse().unwrap()), bounds),
                None if scalar == "f32" => enclosed(&system, &0_f32, bounds),
                None if scalar == "f64" => enclosed(&system, &0_f64, bounds),
                None => enclosed(&system, &Exact::from(0), bounds),
            }
        }
    }
}

/// Returns names and values, sorted.
fn flat(json: &Value) -> Vec<(String, String)> {
    let text = |value: &Value| match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let mut fields = Vec::new();
    for (name, value) in json.as_object().expect("an object") {
        match (name.as_str(), value.as_object()) {
            ("bounds", Some(bounds)) => fields.extend(bounds.iter().flat_map(|(name, ends)| {
                [(format!("{name}_lo"), text(&ends[0])), (format!("{name}_hi"), text(&ends[1]))]
            })),
            ("kkt", Some(kkt)) => {
                fields.extend(kkt.iter().map(|(name, value)| (format!("kkt_{name}"), text(value))));
            }
            _ => fields.push((name.clone(), text(value))),
        }
    }
    fields.sort();
    fields
}

/// A parameter is printed as it was entered, and as it was rounded if this is visible.
#[test]
fn rounding_notes_appear_only_for_visible_rounding() {
    let seen = |typed: &str, scalar: &str| -> Option<String> {
        let line = format!(
            "solve --stiffness 1 --mass 1 --gravity 1 --height 0 --free-length={typed} --scalar {scalar}"
        );
        let output = contact_line(&line);
        let words = stdout(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(&format!("l = {typed} m, H = 0 m")), "{words}");
        let rounded = stdout(&output).lines().find_map(|line| line.strip_prefix(" as rounded"));
        rounded.map(|numbers| numbers.trim().to_string())
    };
    // Six digits in f32 and fifteen in f64 come back, whatever they are; a fraction has none.
    for typed in ["9.81", "1.05", "0.1", "1e-9", "999999", "-123.456", "7.00001e-30", "1/3", "-22/7", "0"] {
        for scalar in ["f32", "f64", "exact"] {
            assert_eq!(seen(typed, scalar), None, "{typed} in {scalar}");
        }
    }
    for (typed, scalar, expected) in [
        ("999999999999999", "f64", None),
        // 2²⁴ + 1 and 2⁵³ + 1 do not fit. 1.4…e-45 is the least f32.
        ("16777217", "f32", Some("l = 16777216 m")),
        ("9007199254740993", "f64", Some("l = 9007199254740992 m")),
        ("1e-45", "f32", Some("l ≈ 1.4e-45 m")),
        // Two bits: 1, 3/2, 2, 3, 4, 6, 8, 12, …, and 3/32 is 0.09375.
        ("9.81", "mpfr:2", Some("l = 8 m")),
        ("-1.05", "mpfr:2", Some("l = -1 m")),
        ("100", "mpfr:2", Some("l = 96 m")),
        ("0.1", "mpfr:2", Some("l ≈ 0.0938 m")),
        ("1/3", "mpfr:2", Some("l = 0.375 m")),
        ("6e2", "mpfr:2", Some("l = 512 m")),
        ("0x1.8p-3", "mpfr:2", None),
        ("0x1.ep-3", "mpfr:2", Some("l = 0.25 m")),
        ("0x1.999999999999ap-4", "f64", None),
        ("0x1.999999999999ap-4", "f32", Some("l ≈ 0.10000000149012 m")),
        ("12", "mpfr:2", None),
        ("1.50", "mpfr:2", None),
    ] {
        assert_eq!(seen(typed, scalar).as_deref(), expected, "{typed} in {scalar}");
    }
}

#[test]
fn csv_and_json_have_the_same_values() {
    for scalar in ["f32", "f64", "mpfr:200", "exact"] {
        for method in ["lagrange", "penalty --penalty 7", "augmented", "augmented --tolerance 1e-30"] {
            let arguments = format!("--method {method} --scalar {scalar}");
            let line = format!("solve --format csv {arguments}");
            let csv = contact_line(&line);
            let mut lines = stdout(&csv).lines().map(|line| line.split(',').map(str::to_string));
            let (names, values) = (lines.next().expect("names"), lines.next().expect("values"));
            let mut fields: Vec<_> = names.zip(values).collect();
            fields.sort();
            let (json, code) = solve(&arguments);
            assert_eq!((fields, csv.status.code()), (flat(&json), code), "{arguments}");
        }
    }
}

/// The command adds keys to the serialisation of the library; common keys have equal values.
#[test]
fn the_library_and_the_command_serialise_alike() {
    let exact = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap();
    let system = exact.try_map(Exact::to_f64).unwrap();
    let augmented = |tolerance, max_augmentations| Method::Augmented {
        penalty: 100.0,
        tolerance,
        max_augmentations,
        start: 0.0,
    };
    for (arguments, method) in [
        ("--method lagrange", Method::Lagrange),
        ("--method penalty --penalty 7", Method::Penalty { penalty: 7.0 }),
        ("--method augmented --penalty 100 --tolerance 1e-9", augmented(1e-9, 1000)),
        ("--method augmented --penalty 100 --tolerance 1e-30", augmented(1e-30, 1000)),
        ("--method augmented --penalty 100 --max-augmentations 2 --trace", augmented(1e-9, 2)),
    ] {
        let (printed, _) = solve(arguments);
        let mut iterates = Vec::new();
        let solution = solve_observed(&system, &method, Plane::Unilateral, |k| iterates.push(k.clone()));
        let solution = solution.unwrap();
        assert_eq!(printed["kkt"], serde_json::to_value(solution.residuals(&system).unwrap()).unwrap());
        let solution = serde_json::to_value(solution).unwrap();
        let all = "augmentations bounds contact_force deflection floor multiplier outcome penetration state";
        assert_eq!(keys(&solution), words(all));
        for (name, value) in solution.as_object().unwrap() {
            assert_eq!(printed[name], *value, "{name}, {arguments}");
        }
        if arguments.ends_with("--trace") {
            assert_eq!(printed["trace"], serde_json::to_value(&iterates).unwrap());
        }
    }
}

#[test]
fn the_trace_ends_with_the_answer() {
    let (answer, _) = solve("--method augmented --trace");
    let trace = answer["trace"].as_array().expect("rows");
    let last = trace.last().expect("a row");
    for name in ["multiplier", "deflection", "penetration", "contact_force"] {
        assert_eq!(last[name], answer[name]);
    }
    assert_eq!(last["k"], answer["augmentations"]);
    assert!(trace.iter().zip(0..).all(|(row, k)| row["k"] == k));
}

/// Storing a table of 10⁵ steps would exceed the memory limit.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_length_of_a_trace() {
    for format in ["table", "csv", "json"] {
        let mut command = Command::new("sh");
        let line = "ulimit -v 65536; exec \"$0\" solve --method augmented --penalty 1e-6 --max-augmentations 99999 \
                    --trace --format \"$1\"";
        let output =
            command.args(["-c", line, env!("CARGO_BIN_EXE_contact"), format]).output().expect("a shell");
        assert_eq!(output.status.code(), Some(1), "{format}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(stdout(&output).contains("99999"), "{format}");
    }
}

#[test]
fn a_terminal_of_80_columns_is_enough() {
    let too_wide = |output: &Output| -> Option<String> {
        stdout(output).lines().find(|line| line.chars().count() > 80).map(String::from)
    };
    let provable = entries().iter().filter(|entry| !entry.claims.is_empty());
    let proofs: Vec<_> = ["prove"].into_iter().chain(provable.map(|entry| entry.equation)).collect();
    let output = contact(&proofs);
    assert_eq!((too_wide(&output), output.status.code()), (None, Some(0)));
    assert!(stdout(&output).contains("\nThese claims detect "));
    for name in [
        "",
        "verify ",
        "prove ",
        "solve ",
        "advise ",
        "sweep ",
        "cases ",
        "check ",
        "equations ",
        "completions ",
    ] {
        let line = format!("{name}--help");
        let mut command = Command::new(env!("CARGO_BIN_EXE_contact"));
        // Without COLUMNS clap takes what there is room for; there is no terminal.
        let output = command.env_remove("COLUMNS").args(line.split(' ')).stdin(Stdio::null()).output();
        assert_eq!(too_wide(&output.expect("the command runs")), None, "{line}");
    }
    assert_eq!([&PROVED, &VERIFIED].map(|output| too_wide(output)), [None, None]);
    for line in [
        "--help",
        "solve --help",
        "solve -h",
        "sweep --help",
        "sweep -h",
        "cases -h",
        "check -h",
        "check -- false",
        "completions --help",
        "verify --help",
        "equations --help",
        "verify --cases 2 --scalar mpfr:2 --scalar mpfr:3 --scalar mpfr:4 --scalar mpfr:5 --scalar mpfr:6",
        "equations",
        "equations 1.1 1.10 1.13 1.16 1.33",
        "solve",
        "solve --scalar exact --stiffness 1/3 --height 22/7",
        "solve --scalar mpfr:1000 --gravity -1/3e0",
        "solve --scalar mpfr:1000 --gravity -1/3 --method augmented --trace",
        "solve --scalar exact --method augmented --penalty 1/3 --trace",
        "solve --method augmented --tolerance 1e-30 --trace",
        "solve --method augmented --scalar mpfr:9 --stiffness 1e-30000 --mass 1e-30000 --gravity -1 --trace",
        "solve --method augmented --penalty 1 --tolerance 1e-14 --trace --max-augmentations 10000",
        "solve --stiffness 1.2345678901234567e-300 --mass 1.2345678901234567e-300 --gravity -1.2345678901234567",
        "solve --mass 1e100000 --scalar exact",
        "sweep --penalty 1..1e18 --scalar f64 --scalar mpfr:3 --scalar exact",
        "sweep --penalty 1e-99999..1e99999 --points 99 --scalar mpfr:90000 --gravity -1/3 --free-length 1234567",
        "sweep --penalty 1234567890/123456789..12345678901234567890 --points 2 --scalar exact",
    ] {
        let output = contact_line(line);
        assert_eq!(too_wide(&output), None, "{line}");
    }
}

/// Returns the line on stderr; asserts that stdout is empty and the status is 2.
fn refusal(arguments: &[&str]) -> String {
    let output = contact(arguments);
    let stderr = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert_eq!((output.status.code(), stdout(&output)), (Some(2), ""), "{arguments:?}");
    assert!(stderr.starts_with("error: ") && stderr.ends_with('\n'), "{arguments:?}: {stderr}");
    assert_eq!(stderr.lines().count(), 1, "{arguments:?}: {stderr}");
    stderr
}

const NUMBERS: [(&str, &str); 8] = [
    ("--stiffness", "lagrange"),
    ("--mass", "lagrange"),
    ("--gravity", "lagrange"),
    ("--free-length", "lagrange"),
    ("--height", "lagrange"),
    ("--penalty", "penalty"),
    ("--tolerance", "augmented"),
    ("--initial-multiplier", "augmented"),
];

#[test]
fn no_bad_number_gets_further_than_one_line() {
    const SPELLING: &str =
        "a number is a decimal (0.05), scientific (5e-2), hexadecimal (0x1.8p-3) or a fraction (1/20)";
    for (flag, method) in NUMBERS {
        for (value, reason) in [
            ("NaN", SPELLING),
            ("-nan", SPELLING),
            ("inf", SPELLING),
            ("-inf", SPELLING),
            ("", SPELLING),
            (" 1", SPELLING),
            ("heavy", SPELLING),
            ("1e", SPELLING),
            ("1e1.5", SPELLING),
            ("1/", SPELLING),
            ("1/2/3", SPELLING),
            ("0x1.8p", SPELLING),
            ("1_000", SPELLING),
            ("1,5", SPELLING),
            ("١", SPELLING),
            ("1/0", "division by zero"),
            ("1e999999999999", "between -100000 and 100000"),
            ("1e-100001", "between -100000 and 100000"),
            ("1e39", "overflows f32; use mpfr:BITS or exact"),
            ("1e-50", "would round to zero in f32; use mpfr:BITS or exact"),
        ] {
            let line = refusal(&["solve", "--method", method, "--scalar", "f32", flag, value]);
            assert!(line.contains(&format!("'{value}' for '{flag} ")) && line.contains(reason), "{line}");
        }
        let signed = ["--gravity", "--free-length", "--height", "--initial-multiplier"].contains(&flag);
        for value in if signed { [].as_slice() } else { &["0", "-1", "-1/2", "-1e-9", "0/5"] } {
            let line = refusal(&["solve", "--method", method, flag, value]);
            assert!(line.contains(&format!("'{value}' for '{flag} ")), "{line}");
            assert!(line.contains("must be greater than 0"), "{line}");
        }
        missing_or_twice(flag, method, "1");
    }
}

#[test]
fn no_bad_count_gets_further_than_one_line() {
    let flag = "--max-augmentations";
    for value in
        ["NaN", "inf", "", "many", "1e", "1e3", "1/0", "1.5", "0x10", "-1", "+1", "18446744073709551616"]
    {
        let line = refusal(&["solve", "--method", "augmented", flag, value]);
        assert!(line.contains(&format!("'{value}' for '{flag} ")), "{line}");
        assert!(line.contains("must be an integer from 0 to 18446744073709551615"), "{line}");
    }
    missing_or_twice(flag, "augmented", "1");
}

fn missing_or_twice(flag: &str, method: &str, value: &str) {
    let line = refusal(&["solve", "--method", method, flag]);
    assert!(line.contains(&format!("a value is required for '{flag} ")), "{line}");
    let line = refusal(&["solve", "--method", method, flag, "--scalar", "f64"]);
    assert!(line.contains(&format!("a value is required for '{flag} ")), "{line}");
    let line = refusal(&["solve", "--method", method, flag, value, flag, value]);
    assert!(line.contains(&format!("'{flag} ")) && line.contains("multiple times"), "{line}");
}

#[test]
fn an_option_without_effect_is_refused() {
    let augmented = [
        ["--tolerance", "1e-3"].as_slice(),
        &["--max-augmentations", "5"],
        &["--initial-multiplier", "-5"],
        &["--trace"],
    ];
    let mut cases: Vec<(&[&str], &[&str], &str)> =
        vec![(&["lagrange"], &["--penalty", "1"], "penalty or augmented")];
    for option in augmented {
        cases.push((&["lagrange"], option, "augmented"));
        cases.push((&["penalty", "--penalty", "1000"], option, "augmented"));
    }
    for (method, option, owner) in cases {
        let line = refusal(&[&["solve", "--method"], method, option].concat());
        let said = format!("'{}' has no effect with --method {}", option.join(" "), method[0]);
        assert!(line.contains(&said) && line.contains(&format!("use it with --method {owner}")), "{line}");
    }
}

#[test]
fn no_text_can_break_the_line() {
    let long = "1".repeat(100_000) + "x";
    for arguments in [
        ["solve", "--mass", "1\n2"].as_slice(),
        &["solve", "--mass", "\u{1b}[31m"],
        &["solve", "\n", "x"],
        &["solve", "--mass", &long],
        &["so\nlve", "--mass", "1"],
        &["verify", "--seed", &long],
        &["verify", &long],
        &["verify", "--scalar", &long],
        &["equations", &long],
        &["equations", "1.13\r"],
        &["equations", "\u{202e}1.13"],
        &["equations", "1.13\u{2028}"],
        &["sweep", "--penalty", &long],
        &["sweep", "--penalty", &format!("1..{long}")],
        &["sweep", "--penalty", &format!("1..1.{}1", "0".repeat(90_000))],
        &["sweep", "--penalty", "1..2", "--points", &long],
        &["solve", &long],
        &["solve", &format!("-{long}")],
        &["solve", &format!("--{long}")],
        &["solve", &format!("--mass{long}=1")],
        &["solve", &format!("--mass={long}\n")],
        &[&long],
        &[&format!("-{long}")],
        &["help", &long],
        &["completions", &long],
    ] {
        let line = refusal(arguments);
        assert!(line.len() < 300, "{line}");
        assert!(!line.contains(['\u{1b}', '\r', '\u{202e}', '\u{2028}']), "{line:?}");
    }
}

#[cfg(unix)]
#[test]
fn text_that_is_not_unicode_is_refused() {
    use std::os::unix::ffi::OsStrExt;
    let output = captured(command().args(["solve", "--mass"]).arg(std::ffi::OsStr::from_bytes(b"\xff")));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), stderr.lines().count()), (Some(2), 1), "{stderr}");
}

#[test]
fn results_that_do_not_fit_are_refused() {
    for arguments in [
        "solve --mass 1e300 --gravity 1e300",
        "solve --mass 1e-300 --gravity 1e-300",
        "solve --free-length 1e308 --height -1e308",
        "solve --scalar f32 --stiffness 1e38 --height -1e38",
        "solve --scalar f32 --stiffness 3e38 --method augmented --penalty 3e38 --mass 1e30 --height 1",
    ] {
        let line = refusal(&words(arguments));
        assert!(line.contains("is out of the range of this scalar"), "{line}");
    }
}

/// In a terminal of 100 columns: a plot, and a progress bar for slow programs.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "requires script"]
fn a_terminal_gets_a_plot_and_a_bar() {
    let on_a_terminal = |line: &str| {
        let line = format!("stty cols 100 rows 40; '{}' {line}", env!("CARGO_BIN_EXE_contact"));
        let mut script = Command::new("script");
        script
            .args(["-qec", &line, "/dev/null"])
            .env("TERM", "xterm")
            .env("CONTACT", env!("CARGO_BIN_EXE_contact"));
        String::from_utf8(captured(&mut script).stdout).expect("UTF-8")
    };
    let sweep = on_a_terminal("sweep --penalty 1..1e18");
    assert!(sweep.contains("relative error of") && !sweep.contains("sweeping"), "{sweep}");
    let widths = sweep.lines().map(|line| line.trim_end().chars().count());
    assert!((90..=100).contains(&widths.max().expect("lines")), "{sweep}");
    // Seven answers of a fifth of a second each: most are there when the bar is first drawn.
    let slow = "while read -r line; do sleep 0.2; echo \"$line\" | \"$CONTACT\" solve --batch; done";
    let check = on_a_terminal(&format!("check --family contact --cases 7 -- sh -c '{slow}'"));
    let (bars, report) = check.split_once(" program ").expect("a report");
    let percents =
        bars.split("checking ").skip(1).filter_map(|bar| bar.split_once(" %")?.0.split(' ').next_back());
    let percents: Vec<u32> = percents.map(|percent| percent.parse().expect("a number")).collect();
    assert!(percents.len() > 1 && percents.is_sorted() && percents[0] > 50, "{check:?}");
    // Erased before the report.
    assert!(bars.ends_with("\u{1b}[2K") && report.contains("7: 7 right"), "{check:?}");
}

/// Columns of a sweep, in the order of CSV.
const COLUMNS: [&str; 9] = [
    "scalar",
    "penalty",
    "deflection",
    "penetration",
    "contact_force",
    "penalty_force",
    "force_error",
    "penalty_force_error",
    "error",
];

/// The penalty of a row, passed to `solve`, has the results of the row; both formats agree; errors are exact
/// in JSON, as in the library, and have six digits in CSV.
#[test]
fn a_row_of_a_sweep_is_a_solve() {
    for system in
        ["--gravity 9.81", "--gravity -1/3 --height 7/3", "--gravity 5 --height 1.25 --free-length 1.2"]
    {
        let line = format!(
            "sweep --penalty 1/3..1e9 --points 7 --scalar f32 --scalar f64 --scalar mpfr:99 --scalar exact {system}"
        );
        let line = words(&line);
        let (rows, code) = json(&line);
        let csv = contact(&[&line[..], &["--format", "csv"]].concat());
        let mut lines = stdout(&csv).lines();
        assert_eq!(lines.next(), Some(COLUMNS.join(",").as_str()));
        assert_eq!((array(&rows).len(), code), (4 * 7, Some(0)));
        for row in array(&rows) {
            let mut names = COLUMNS;
            names.sort_unstable();
            assert_eq!(keys(row), names);
            let text = |name: &str| row[name].as_str().unwrap_or_default();
            let mut cells = lines.next().expect("a line").split(',');
            for name in COLUMNS {
                let (cell, text) = (cells.next().expect("a cell"), text(name));
                if name.ends_with("_error") && !text.is_empty() {
                    let text: Exact = text.parse().expect("a number");
                    assert_eq!(cell, text.decimal(6, Round::Nearest), "{row}");
                } else {
                    assert_eq!(cell, text, "{row}");
                }
            }
            assert_eq!(cells.next(), None);
            let [scalar, penalty] = ["scalar", "penalty"].map(text);
            let (answer, _) =
                solve(&format!("--method penalty --scalar {scalar} --penalty {penalty} {system}"));
            for name in ["deflection", "penetration", "contact_force"] {
                assert_eq!(row[name], answer[name], "{name} at {penalty} in {scalar}");
            }
            assert_eq!(row["penalty_force"].is_null(), answer["state"] == "separated");
            assert_eq!(row["force_error"].is_null(), answer["state"] != "contact");
            assert_eq!(row["penalty_force_error"].is_null(), answer["state"] != "contact");
            assert!(row["error"].is_null());
        }
        assert_eq!(lines.next(), None);
        // The same penalties in every number system, each once, in their order.
        let penalties: Vec<_> = array(&rows).iter().map(|row| exact(&row["penalty"])).collect();
        assert!(penalties.chunks(7).all(|of_one| of_one == &penalties[..7]));
        assert!(penalties[..7].windows(2).all(|pair| pair[0] < pair[1]));
        let ends = ["1/3", "1e9"].map(|end| end.parse::<Exact>().expect("a number"));
        assert_eq!([&penalties[0], &penalties[6]], ends.each_ref());
    }
}

/// Each error is that of the force of its row, as in the library.
#[test]
fn errors_of_a_sweep_are_exact() {
    let (rows, _) = json(&["sweep", "--penalty", "1e-3..1e30", "--points", "67"]);
    // The f64s beside 9.81 and 1.05.
    let number = |x: f64| Exact::try_from(x).expect("a finite number");
    let gap = number(1.05) - Exact::from(1);
    let reaction = number(9.81) - Exact::from(100) * gap;
    for row in array(&rows) {
        for (force, error) in [("contact_force", "force_error"), ("penalty_force", "penalty_force_error")] {
            // The text of a float is the float's, and not its value.
            let force = number(row[force].as_str().and_then(|text| text.parse().ok()).expect("a float"));
            assert_eq!(exact(&row[error]) * &reaction, (force - &reaction).abs(), "{row}");
        }
    }
}

/// The other rows are still printed: 10³⁰⁸ · 4 m overflows f64.
#[test]
fn an_overflowing_row_reports_the_overflow() {
    let line = ["sweep", "--penalty", "1..1e308", "--points", "3", "--height", "5", "--gravity", "1000"];
    let (rows, code) = json(&line);
    let said = "the deflection is out of the range of this scalar; use MPFR (mpfr:BITS) or exact rationals";
    assert_eq!((array(&rows).len(), code), (3, Some(1)));
    for row in array(&rows) {
        let overflows = row["penalty"] == "1e308";
        assert_eq!(row["error"].as_str(), overflows.then_some(said), "{row}");
        for name in &COLUMNS[2..8] {
            assert_eq!(row[name].is_null(), overflows, "{row}");
        }
    }
    let csv = contact(&[&line[..], &["--format", "csv"]].concat());
    assert!(String::from_utf8_lossy(&csv.stdout).ends_with(&format!("\nf64,1e308,,,,,,,{said}\n")));
    let table = contact(&line);
    let table = String::from_utf8_lossy(&table.stdout).into_owned();
    assert!(table.contains("\n 1e308      the deflection is out of the range of this scalar\n"), "{table}");
    // ε R overflows, but not what it is needed for: p = R/(c + ε) and N = R ε/(c + ε).
    let (rows, code) = json(&["sweep", "--penalty", "1..1e308", "--points", "3"]);
    assert_eq!((array(&rows).iter().all(|row| row["error"].is_null()), code), (true, Some(0)));
}

/// The error in rationals, relative to R = 4.81, is c/(c + ε).
#[test]
fn a_sweep_in_rationals_reports_the_exact_error_of_the_method() {
    let (rows, _) = json(&["sweep", "--penalty", "1e-3..1e30", "--points", "67", "--scalar", "exact"]);
    for row in array(&rows) {
        let (c, eps) = (Exact::from(100), exact(&row["penalty"]));
        let error = &c / (&c + eps);
        for name in ["force_error", "penalty_force_error"] {
            assert_eq!(exact(&row[name]), error, "{row}");
        }
    }
}

/// A plot is printed to terminals only.
#[test]
fn a_pipe_gets_no_plot() {
    for format in ["table", "json", "csv"] {
        let output = contact(&["sweep", "--penalty", "1..1e18", "--format", format]);
        assert!(!stdout(&output).contains(|c| ('\u{2800}'..'\u{2900}').contains(&c)), "{format}");
    }
}

fn keys(object: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = object.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

fn array(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

/// Returns the equation numbers of the chapter, (1.1) to (1.33), each once.
fn numbers() -> Vec<String> {
    (1..=33).map(|n| format!("1.{n}")).collect()
}

/// The chapter holds for other cases and precisions than the default.
#[test]
fn the_whole_chapter_holds() {
    let line = "verify --scalar f32 --scalar f64 --scalar exact --scalar mpfr:777 --cases 50 --seed 99";
    let (report, code) = json(&words(line));
    assert_eq!(keys(&report), ["equations", "shared", "summary"]);
    assert_eq!(keys(&report["summary"]), ["claims", "failed", "held", "proved", "undecided"]);
    assert!(array(&report["shared"]).is_empty());
    let (mut rows, mut proofs) = (0, 0);
    for equation in array(&report["equations"]) {
        assert_eq!(keys(equation), ["claims", "equation"]);
        let number = equation["equation"].as_str().expect("a number");
        for claim in array(&equation["claims"]) {
            rows += 1;
            let all = [
                "bound",
                "claim",
                "counterexample",
                "decided",
                "kind",
                "reason",
                "scalar",
                "status",
                "undecided",
                "worst",
            ];
            assert_eq!(keys(claim), all, "{number}");
            assert!(claim["counterexample"].is_null() && claim["reason"].is_null(), "{number}: {claim}");
            if claim["scalar"].is_null() {
                proofs += 1;
                assert_eq!(claim["status"], "proved", "{number}: {claim}");
                assert!(["worst", "bound"].into_iter().all(|key| claim[key].is_null()), "{number}: {claim}");
                continue;
            }
            assert_eq!(claim["status"], "held", "{number}: {claim}");
            let [decided, undecided] =
                ["decided", "undecided"].map(|key| claim[key].as_u64().expect("a count"));
            assert!(decided > 0 && decided + undecided == 50, "{number}: {claim}");
            assert_eq!(claim["worst"].is_null(), claim["bound"].is_null(), "{number}: {claim}");
            if let Some(worst) = claim["worst"].as_str() {
                let worst: f64 = worst.parse().expect("a number");
                assert!((0.0..=1.0).contains(&worst), "{number}: {claim}");
                assert!(
                    claim["scalar"] != "exact" || claim["kind"] == "experiment" || worst == 0.0,
                    "{claim}"
                );
            }
        }
        // Each of its claims in each number system that it can be made in, and none twice.
        let [claims, scalars] = ["claim", "scalar"]
            .map(|key| array(&equation["claims"]).iter().map(move |c| c[key].as_str().unwrap_or("proof")));
        let pairs: std::collections::BTreeSet<_> = claims.clone().zip(scalars.clone()).collect();
        assert_eq!(pairs.len(), array(&equation["claims"]).len(), "{number}");
        let claims: std::collections::BTreeSet<_> = claims.collect();
        assert_eq!(claims, claim_names(number).into_iter().collect(), "{number}");
        let scalars: std::collections::BTreeSet<_> = scalars.collect();
        assert!(scalars.is_superset(&["f32", "f64", "mpfr:777"].into()), "{number}: {scalars:?}");
        // The chapter's own numbers are all proved.
        assert!(scalars.contains("proof") || !number.starts_with("1."), "{number}");
    }
    assert_eq!((report["summary"]["claims"].as_u64(), code), (Some(rows), Some(0)));
    let summary = &report["summary"];
    assert_eq!((&summary["proved"], &summary["held"]), (&proofs.into(), &(rows - proofs).into()));
    assert_eq!((&summary["failed"], proofs > 150), (&0.into(), true));
    let found: Vec<_> = array(&report["equations"]).iter().map(|e| e["equation"].as_str().unwrap()).collect();
    for number in numbers() {
        assert_eq!(found.iter().filter(|f| **f == number).count(), 1, "({number})");
    }
}

#[test]
fn a_seed_determines_the_cases() {
    let run = |seed| {
        let equations = ["verify", "1.6", "1.16", "1.33", "Theorem 1.3.3"];
        let options = ["--cases", "20", "--scalar", "f32", "--scalar", "exact", "--seed", seed];
        let arguments = [&equations[..], &options].concat();
        [["--format", "table"], ["--format", "json"], ["--format", "markdown"]]
            .map(|format| contact(&[arguments.as_slice(), &format].concat()).stdout)
    };
    let [first, again, other] = ["7", "7", "8"].map(run);
    assert!(first == again, "the same seed says something else");
    assert!(first.iter().zip(&other).all(|(first, other)| first != other), "another seed says the same");
}

/// Seeds 1 and 2³² + 1 differ, in both commands with random cases.
#[test]
fn a_seed_has_64_bits() {
    let out = |arguments: &[&str], seed| contact(&[arguments, &["--seed", seed]].concat()).stdout;
    for arguments in [
        &["verify", "1.33", "--cases", "5", "--scalar", "f32", "--format", "json"][..],
        &["cases", "--family", "near", "--cases", "3"],
    ] {
        assert_eq!(out(arguments, "1"), out(arguments, "1"));
        assert_ne!(out(arguments, "1"), out(arguments, "4294967297"), "{arguments:?}");
    }
}

#[test]
fn one_equation_is_enough() {
    let (report, code) = json(&["verify", "--cases", "10", "note 4", "1.13"]);
    let found: Vec<_> = array(&report["equations"]).iter().map(|e| &e["equation"]).collect();
    // In the chapter's order, not in the order they were asked for in.
    assert_eq!((found, code), (vec![&"1.13".into(), &"note 4".into()], Some(0)));
    let (twice, _) = json(&["verify", "1.13", "1.13", "note", "4", "--cases", "10"]);
    assert_eq!(report, twice);
}

/// With two bits hardly a sign is decided: this is neither a success nor a counterexample.
#[test]
fn an_undecided_claim_is_not_a_failure() {
    let (report, code) = json(&["verify", "--scalar", "mpfr:2", "--cases", "20"]);
    let rows: Vec<_> = array(&report["equations"]).iter().flat_map(|e| array(&e["claims"])).collect();
    let undecided: Vec<_> = rows.iter().filter(|row| row["status"] == "undecided").collect();
    assert!(!undecided.is_empty() && undecided.len() < rows.len());
    let summary = &report["summary"];
    assert_eq!((&summary["undecided"], &summary["failed"]), (&undecided.len().into(), &0.into()));
    assert_eq!(code, Some(0));
    for row in undecided {
        assert_eq!((&row["decided"], &row["undecided"]), (&0.into(), &20.into()), "{row}");
        assert!(["counterexample", "worst", "bound"].into_iter().all(|key| row[key].is_null()), "{row}");
    }
}

#[test]
fn a_table_has_every_number_and_no_broken_word() {
    let table = contact(&["equations"]);
    for entry in entries() {
        let start = format!(" {} ", entry.label());
        let line = stdout(&table).lines().find(|line| line.starts_with(&start));
        let line = line.unwrap_or_else(|| panic!("{start} is not there"));
        let claims = claim_names(entry.equation).len().to_string();
        let words: Vec<_> = line.split_whitespace().collect();
        let last = [entry.functions.first().copied().unwrap_or("-"), &claims];
        assert!(words.ends_with(&last), "{line}");
        let found = stdout(&VERIFIED).lines().filter(|line| line.starts_with(&start)).count();
        assert_eq!(found, usize::from(claims != "0"), "{start}");
    }
    assert_eq!((table.status.code(), VERIFIED.status.code()), (Some(0), Some(0)));
    // Titles go over several lines, their words do not.
    let said: Vec<_> =
        stdout(&VERIFIED).split_whitespace().chain(stdout(&table).split_whitespace()).collect();
    for word in entries().iter().flat_map(|entry| entry.title.split_whitespace()) {
        assert!(said.contains(&word), "{word}");
    }
}

#[test]
fn colours_and_widths_of_the_terminal_do_not_matter_to_a_pipe() {
    for line in ["verify --cases 2 --scalar f64", "equations", "equations 1.13"] {
        let arguments = words(line);
        let usual = contact(&arguments);
        let mut command = command();
        command.env_remove("NO_COLOR").env("CLICOLOR_FORCE", "1").env("COLUMNS", "7").args(&arguments);
        let output = captured(&mut command);
        assert_eq!((stdout(&output), output.status), (stdout(&usual), usual.status), "{line}");
        assert!(!stdout(&output).contains('\u{1b}'), "{line}");
    }
}

#[test]
fn equations_are_data() {
    let (all, code) = json(&["equations"]);
    assert_eq!((array(&all).len(), code), (entries().len(), Some(0)));
    for (row, entry) in array(&all).iter().zip(entries()) {
        let all = "claims derivation entry equation follows_from function functions hypotheses latex section \
                   statement title";
        assert_eq!(keys(row), words(all));
        assert_eq!(row["equation"], entry.equation);
        for key in ["hypotheses", "follows_from", "claims"] {
            assert!(array(&row[key]).iter().all(Value::is_string), "{row}");
        }
        for key in ["title", "section", "statement"] {
            assert!(row[key].as_str().is_some_and(|text| !text.is_empty()), "{row}");
        }
        assert_eq!(row["function"].as_str(), entry.functions.first().copied());
        let functions: Vec<_> =
            array(&row["functions"]).iter().map(|f| f["path"].as_str().unwrap()).collect();
        assert_eq!(functions, entry.functions);
        assert_eq!(row["latex"].as_str(), entry.latex().as_deref());
        assert_eq!(row["claims"], Value::from(claim_names(entry.equation)));
    }
    for number in numbers() {
        let (one, code) = json(&["equations", &number]);
        assert_eq!((array(&one).len(), code), (1, Some(0)));
        assert_eq!(one[0]["equation"], number);
    }
    let (two, _) = json(&["equations", "1.13", "1.1", "1.13"]);
    assert_eq!(array(&two).iter().map(|e| &e["equation"]).collect::<Vec<_>>(), ["1.1", "1.13"]);
}

/// Returns a line of a file of the repository, and how it is named.
fn source_line(place: &Value) -> (String, String) {
    let (file, line) = (place["file"].as_str().expect("a path"), place["line"].as_u64().expect("a number"));
    let text = std::fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    let found = text.lines().nth(line as usize - 1).unwrap_or_else(|| panic!("{file} has no line {line}"));
    (found.to_string(), format!("{file}:{line}"))
}

/// An equation is found in the source: definitions of functions, the entry, and the page that displays it.
#[test]
fn an_equation_stands_on_the_printed_lines() {
    let (all, _) = json(&["equations"]);
    let numbers = array(&all).iter().map(|row| row["equation"].as_str().unwrap());
    let output = contact(&iter::once("equations").chain(numbers).collect::<Vec<_>>());
    // Long lines are broken.
    let blocks: Vec<_> = stdout(&output)
        .split("\n\n")
        .map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect();
    assert_eq!(blocks.len(), array(&all).len());
    for (row, block) in array(&all).iter().zip(blocks) {
        for function in array(&row["functions"]) {
            let path = function["path"].as_str().unwrap();
            let (_, name) = path.split_once("::").expect("a module");
            let (line, place) = source_line(function);
            let head = line.strip_prefix("pub fn ").or(line.strip_prefix("pub struct "));
            let rest = head.and_then(|head| head.strip_prefix(name));
            assert!(rest.is_some_and(|rest| rest.starts_with(['<', '('])), "{path}: {line}");
            assert!(block.contains(&format!(" {place} {path} ")), "{block}");
        }
        let equation = row["equation"].as_str().unwrap();
        let (line, place) = source_line(&row["entry"]);
        assert_eq!(line.trim_start().find(&format!("Entry::new(\"{equation}\", ")), Some(0), "{line}");
        let page = row["derivation"].as_str().expect("a path");
        assert!(block.ends_with(&format!(" entry {place} derivation {page}")), "{block}");
        let page =
            std::fs::read_to_string(root().join(page)).unwrap_or_else(|error| panic!("{page}: {error}"));
        if equation.starts_with(|c: char| c.is_ascii_digit()) {
            assert!(page.contains(&format!("{{{{#eq {equation}}}}}")), "{equation}");
        }
        if equation.starts_with("note ") || equation.starts_with("Theorem ") {
            let anchor = equation.to_lowercase().replace(['.', ' '], "-");
            assert!(page.contains(&format!("{{#{anchor}}}")), "{equation}");
        }
    }
}

/// In any of the ways that numbers are written, and a name and its number as two words.
#[test]
fn all_notations_of_a_number_are_accepted() {
    let found = |arguments: &[&str]| -> Vec<String> {
        let (rows, code) = json(arguments);
        assert_eq!(code, Some(0), "{arguments:?}");
        let rows = rows.get("equations").cloned().unwrap_or(rows);
        array(&rows).iter().map(|row| row["equation"].as_str().expect("a number").to_string()).collect()
    };
    let all = ["1.13", "Theorem 1.3.3", "note 4"];
    assert_eq!(found(&["equations", "(1.13)", "theorem 1.3.3", "Note 4"]), all);
    assert_eq!(found(&["equations", "theorem", "1.3.3", "eq", "1.13", "NOTE", "4"]), all);
    assert_eq!(found(&["prove", "Eq. (1.13)", "note", "4", "THM. 1.3.3"]), all);
    assert_eq!(found(&["equations", "Fig.", "1.2", "1.13", "eq.", "(1.16)"]), ["Fig. 1.2", "1.13", "1.16"]);
    assert_eq!(found(&["equations", "note 4", "note", "5"]), ["note 4", "note 5"]);
    assert_eq!(found(&["verify", "--cases", "5", "eq 1.13", "note", "(4)", "thm 1.3.3"]), all);
    for words in [["1.1", ""], ["", "1.1"], ["1.1", "theorem"], ["1.3.3", "theorem"], ["note", "note 4"]] {
        refusal(&[&["equations"], words.as_slice()].concat());
    }
    // Of what is not there the first word is named.
    for (arguments, value) in [
        (["prove", "theorem", "1.13"].as_slice(), "'theorem' for '[NUMBER]...'"),
        (&["verify", "1.13", "1.130"], "'1.130' for '[NUMBER]...'"),
        (&["equations", "1.13", "figure"], "'figure' for '[NUMBER]...'"),
    ] {
        let line = refusal(arguments);
        assert!(line.contains(value) && line.contains("or 'Theorem 1.3.3'"), "{line}");
    }
}

/// A line each, and as many cells in each as in the heading.
#[test]
fn markdown_is_a_table() {
    for line in ["equations", "verify --cases 2"] {
        let arguments: Vec<_> = line.split(' ').chain(["--format", "markdown"]).collect();
        let output = contact(&arguments);
        let cells = |line: &str| line.replace("\\|", "").matches('|').count();
        let mut lines = stdout(&output).lines();
        let columns = cells(lines.next().expect("a heading"));
        assert!(lines.clone().count() > entries().len());
        assert!(lines.all(|line| line.starts_with('|') && line.ends_with('|') && cells(line) == columns));
    }
}

/// Compares a file of the project with what it should be; with `UPDATE=1` writes it.
fn compare(file: &str, update: impl Fn(&str) -> String) {
    // Several tests write the same page.
    static WRITING: std::sync::Mutex<()> = std::sync::Mutex::new(());
    let _one_at_a_time = WRITING.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let path = root().join(file);
    let found = std::fs::read_to_string(&path).unwrap();
    let expected = update(&found);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &expected).unwrap();
        return;
    }
    let differs = found.lines().zip(expected.lines()).enumerate().find(|(_, (now, then))| now != then);
    if let Some((line, (_, then))) = differs {
        panic!(
            "{file}, line {}, has to be\n{then}\nUPDATE=1 cargo test -p spring-mass-contact-cli command:: writes it",
            line + 1
        );
    }
    assert_eq!(found, expected, "{file}: UPDATE=1 cargo test -p spring-mass-contact-cli command:: writes it");
}

/// The text with `update` applied to the lines of the block between `begin` and the next fence.
fn in_block(text: &str, begin: &str, update: impl Fn(&str) -> String) -> String {
    let (head, rest) = text.split_once(begin).unwrap_or_else(|| panic!("no block begins with {begin:?}"));
    let (block, tail) = rest.split_once("```").expect("a fence ends the block");
    let lines: String = block.lines().map(|line| update(line) + "\n").collect();
    format!("{head}{begin}{lines}```{tail}")
}

#[test]
fn the_book_shows_an_equation_as_it_is_printed() {
    compare("book/src/command.md", |page| {
        let begin = "```console\n$ contact equations 1.16\n";
        let (head, rest) = page.split_once(begin).expect("the sample");
        let (_, tail) = rest.split_once("```").expect("a fence ends the block");
        format!("{head}{begin}{}```{tail}", stdout(&contact_line("equations 1.16")))
    });
}

/// All but the times.
#[test]
fn the_book_has_the_totals_of_the_proofs() {
    let totals: Vec<_> = stdout(&PROVED).lines().rev().take(4).collect();
    let [_, changes, hypotheses, claims] = totals[..] else { panic!("{totals:?}") };
    let (proved, _) = claims.split_once(" in ").expect("a time");
    let total = |line: &str| match line.split_once(" in ") {
        Some((before, time)) if before.ends_with("claims proved") => format!("{proved} in {time}"),
        _ if line.contains(" hypotheses needed") => hypotheses.to_string(),
        _ if line.contains(" mutations of formulas detected") => changes.to_string(),
        _ => line.to_string(),
    };
    let begin = "```text\n";
    compare("book/src/command.md", |page| {
        let (head, rest) = page.split_once("\n## Prove the chapter\n").expect("its section");
        let rest = in_block(rest, begin, total);
        for line in [proved, hypotheses, changes] {
            assert!(
                rest.contains(&format!("\n{line}")),
                "book/src/command.md, \"Prove the chapter\", lacks the line {line}"
            );
        }
        format!("{head}\n## Prove the chapter\n{rest}")
    });
}

/// Two samples of the report, with some of its rows; and in the book its totals.
#[test]
fn book_and_readme_have_the_rows_and_the_totals_of_the_main_job() {
    let output = contact(&[]);
    let printed: Vec<_> = stdout(&output).lines().collect();
    // A row is known by its number, a total by what is counted.
    let key = |line: &str| match line.strip_suffix(" held") {
        Some(row) if line.starts_with(' ') => row.split("  ").next().map(String::from),
        _ => ["claims proved for all values.", "trials decided", "Rounding errors: at most"]
            .into_iter()
            .find(|total| line.contains(total))
            .map(String::from),
    };
    let refreshed = |line: &str| {
        let Some(own) = key(line) else { return line.to_string() };
        let now = printed.iter().find(|printed| key(printed).as_ref() == Some(&own));
        now.unwrap_or_else(|| panic!("`contact` prints no line of {own:?}, but a sample has it")).to_string()
    };
    compare("book/src/command.md", |page| in_block(page, "```console\n$ contact\n", refreshed));
    compare("README.md", |readme| in_block(readme, "```text\n number ", refreshed));
    let samples = ["book/src/command.md", "README.md"].map(|file| {
        let text = std::fs::read_to_string(root().join(file)).unwrap();
        text.lines().filter(|line| key(line).is_some() && printed.contains(line)).count()
    });
    assert_eq!(samples, [8, 4], "rows and totals in the samples");
}

#[test]
fn no_bad_choice_gets_further_than_one_line() {
    let whole = "must be an integer from";
    let number = "must be a number listed by `contact equations`, such as 1.13 or 'Theorem 1.3.3'";
    let scalar = "must be f32, f64, mpfr:BITS with 2 to 1000000 bits, or exact";
    let formats = "[possible values: table, json, markdown]";
    let cases = [
        ("--cases", ["0", "-1", "1.5", "many", "", "1e3", "18446744073709551616"].as_slice(), whole),
        ("--seed", &["-1", "1.5", "text", "", "0x10", "18446744073709551616", "٣"], whole),
        ("--scalar", &["f16", "F32", "", "mpfr", "mpfr:1", "mpfr:1000001", "mpfr:-5", "f32,f64"], scalar),
        ("--format", &["xml", "JSON", "dot", "csv"], formats),
    ];
    for (flag, values, allowed) in cases {
        for value in values {
            let line = refusal(&["verify", flag, value]);
            assert!(line.contains(&format!("'{value}' for '{flag} ")) && line.contains(allowed), "{line}");
        }
        let line = refusal(&["verify", flag]);
        assert!(line.contains(&format!("a value is required for '{flag} ")), "{line}");
    }
    for command in ["equations", "prove", "verify"] {
        for value in ["9.9", "", "1.34", "-", "(1.13", "1.13.", "1.130", "theorem", "1.3.3", "NaN"] {
            let line = refusal(&[command, "1.1", value]);
            assert!(
                line.contains(&format!("'{value}' for '[NUMBER]...'")) && line.contains(number),
                "{line}"
            );
        }
    }
    for (command, reason) in [("prove", "it has no claim to be proved"), ("verify", "it has no claims")] {
        let line = refusal(&[command, "Fig. 1.1"]);
        assert!(line.contains("'Fig. 1.1' for '[NUMBER]...'") && line.contains(reason), "{line}");
    }
    let line = refusal(&["equations", "--format", "xml"]);
    let with_dot = formats.replace("]", ", dot]");
    assert!(line.contains("'xml' for '--format <FORMAT>'") && line.contains(&with_dot), "{line}");
    let line = refusal(&["prove", "--format", "dot"]);
    assert!(line.contains("'dot' for '--format <FORMAT>'") && line.contains(formats), "{line}");
    for flag in ["--cases", "--seed"] {
        let line = refusal(&["verify", flag, "1", flag, "1"]);
        assert!(line.contains(flag) && line.contains("multiple times"), "{line}");
    }
    for arguments in [["verify", "--tolerance", "1"].as_slice(), &["--cases", "5"]] {
        let line = refusal(arguments);
        assert!(
            line.contains("unexpected argument") && line.contains("--help lists what is allowed"),
            "{line}"
        );
    }
    for command in ["VERIFY", "verfy", "", "-", "1.13", "proof"] {
        let line = refusal(&[command]);
        assert!(line.contains(&format!("unrecognized subcommand '{command}'")), "{line}");
        assert!(
            line.contains("verify, prove, solve, advise, sweep, cases, check, equations, completions"),
            "{line}"
        );
    }
}

/// Note 9 has no formula that is mutated.
#[test]
fn detected_mutations_are_counted_only_if_there_are_some() {
    let says = |equation: &str| String::from_utf8(contact(&["prove", equation]).stdout).unwrap();
    assert_eq!(
        ["1.13", "note 9"].map(|equation| says(equation).contains("mutations of formulas")),
        [true, false]
    );
}

/// All claims are proved, all mutations are detected and all hypotheses are needed; and the JSON has the keys of the book.
#[test]
fn the_whole_chapter_is_proved() {
    let (report, code) = json(&["prove"]);
    assert_eq!((keys(&report), code), (vec!["equations", "mutations", "summary"], Some(0)));
    let summary = &report["summary"];
    let all = "claims detected equivalent hypotheses mutations proved refuted undetected unknown";
    assert_eq!(keys(summary), words(all));
    let count = |key: &str| summary[key].as_u64().expect("a count");
    assert_eq!(count("proved"), count("claims"));
    assert_eq!(count("detected") + count("equivalent"), count("mutations"));
    assert!([("refuted", 0), ("unknown", 0), ("undetected", 0)].iter().all(|(key, n)| count(key) == *n));
    let claims: Vec<_> = array(&report["equations"]).iter().flat_map(|e| array(&e["claims"])).collect();
    assert_eq!(claims.len() as u64, count("claims"));
    let mut hypotheses = 0;
    for claim in claims {
        let all = "claim counterexample dropped hypotheses kind proof reason statement status";
        assert_eq!(keys(claim), words(all));
        assert_eq!(claim["status"], "proved", "{claim}");
        assert!(claim["statement"].is_string(), "{claim}");
        for goal in array(&claim["proof"]) {
            assert_eq!(keys(goal), ["atoms", "goal", "hypotheses", "proof"]);
        }
        assert!(["reason", "counterexample"].iter().all(|key| claim[key].is_null()), "{claim}");
        let dropped = array(&claim["dropped"]);
        hypotheses += dropped.len() as u64;
        // That a number has two bits goes without saying.
        let said = array(&claim["hypotheses"]).iter().filter(|given| *given != "2ᵖ ≥ 4");
        assert_eq!(dropped.len(), said.count(), "{claim}");
        for dropped in dropped {
            assert_eq!(keys(dropped), ["counterexample", "hypothesis", "status"]);
            if dropped["status"] == "unknown" && dropped["hypothesis"] == "ε (2ᵖ + 1) ≥ 64 (c + ε)" {
                continue;
            }
            assert_eq!(dropped["status"], "refuted", "{claim}");
            let values = dropped["counterexample"].as_object().expect("values");
            assert!(
                values.values().all(|x| x.as_str().is_some_and(|x| x.parse::<Exact>().is_ok())),
                "{claim}"
            );
        }
    }
    assert_eq!(hypotheses, count("hypotheses"));
    assert_eq!(array(&report["mutations"]).len() as u64, count("mutations"));
    for change in array(&report["mutations"]) {
        assert_eq!(keys(change), ["at", "by", "counterexample", "mutation", "status"]);
        assert!(change["at"].as_str().is_some_and(|at| at.starts_with("src/chapter/")), "{change}");
        let detected = change["status"] == "detected";
        assert!(detected || change["status"] == "equivalent", "{change}");
        assert_eq!((change["by"].is_string(), change["counterexample"].is_object()), (detected, detected));
    }
    assert_eq!(PROVED.status.code(), Some(0));
    let claims = count("claims");
    assert!(stdout(&PROVED).contains(&format!("\n{claims} of {claims} claims proved in ")));
}

/// A directory's name may need quotes, or be longer than a line. Each command that is printed runs, here with a stand-in
/// for coqc, which like it writes a cache to the directory that it is started in.
#[cfg(unix)]
#[test]
fn a_directory_for_coq_can_have_any_name() {
    let long = "0123456789/".repeat(15);
    let scratch = Scratch::new("coq");
    for name in ["it's $HOME, \"quoted\" & long: * ~ ü a\\b", "-1/2", &long] {
        let directory = scratch.join(name);
        let directory = directory.to_str().expect("UTF-8");
        let output = contact(&["prove", "--coq", directory]);
        assert_eq!(output.status.code(), Some(0), "{name}");
        let (_, commands) = stdout(&output).split_once('\n').expect("commands");
        let coqc = "test $# = 4 && test -f \"$4\" && test \"$1 $2 $3\" = '-R . Contact' && echo \"$4\" && touch .nra.cache";
        let script = format!("set -e\ncoqc() {{ {coqc}; }}\n{commands}");
        let started_in = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
        let ran = Command::new("sh").args(["-c", &script]).current_dir(started_in).output().expect("a shell");
        assert!(stdout(&ran).lines().count() > 10 && ran.status.success(), "{script}");
        let has_cache = |directory: &std::path::Path| directory.join(".nra.cache").is_file();
        assert_eq!([directory.as_ref(), started_in].map(has_cache), [true, false], "{name}");
        // A page holds what can be broken.
        let fits = |line: &str| line.chars().count() <= 80 || line.contains('\'');
        assert!(commands.lines().all(fits), "{commands}");
    }
}

#[test]
fn the_graph_has_every_number() {
    let output = contact(&["equations", "--format", "dot"]);
    assert_eq!(output.status.code(), Some(0));
    let lines: Vec<_> = stdout(&output).lines().map(str::trim).collect();
    for entry in entries() {
        let own = format!("\"{}\" [label = ", entry.equation);
        assert_eq!(lines.iter().filter(|line| line.starts_with(&own)).count(), 1, "{own}");
        let arrow = |premise: &&str| format!("\"{premise}\" -> \"{}\";", entry.equation);
        let lost = entry.follows_from.iter().map(arrow).find(|arrow| !lines.contains(&arrow.as_str()));
        assert_eq!(lost, None);
    }
    assert!(!stdout(&output).contains("NOT PROVED"));
}

#[test]
fn every_shell_has_completions() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = contact(&["completions", shell]);
        assert_eq!(output.status.code(), Some(0));
        assert!(stdout(&output).contains("initial-multiplier"), "{shell}");
    }
}
