//! The command `contact`, run as a user runs it.
//!
//! What it prints is in `tests/cmd`, with a reason for each value; here is what snapshots cannot say:
//! that bounds hold, that formats agree, that no bad input gets further than one line.

#![cfg(feature = "cli")]

use serde_json::Value;
use spring_mass_contact::chapter::{SpringMass, contact};
use spring_mass_contact::number::{Exact, RangeError, ToExact};
use std::process::{Command, Output, Stdio};

fn contact(arguments: &[&str]) -> Output {
    // Neither the width nor the colours of whoever runs the tests.
    let mut command = Command::new(env!("CARGO_BIN_EXE_contact"));
    command.env("COLUMNS", "80").env("NO_COLOR", "1").args(arguments).output().expect("the command runs")
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).expect("UTF-8")
}

fn solve(arguments: &str) -> (Value, Option<i32>) {
    let arguments: Vec<_> = ["solve", "--format", "json"].into_iter().chain(arguments.split(' ')).collect();
    let output = contact(&arguments);
    (serde_json::from_slice(&output.stdout).expect("JSON"), output.status.code())
}

fn exact(value: &Value) -> Exact {
    value.as_str().and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn prints_what_it_printed() {
    trycmd::TestCases::new()
        .register_bin("contact", std::path::Path::new(env!("CARGO_BIN_EXE_contact")))
        .env("COLUMNS", "80")
        .env("NO_COLOR", "1")
        .case("tests/cmd/*.trycmd")
        .run();
}

/// How solves end: where the number of augmentations is given, it is ⌊ln(p₀/tol)/ln(1 + ε/c)⌋ + 1 with
/// p₀ = 4.81/(100 + ε), and rounding does not change it.
#[test]
fn solves_end_as_they_should() {
    for (arguments, outcome, augmentations, steps_needed) in [
        ("--penalty 100 --tolerance 1e-12", "converged", Some(35), Some("35")),
        ("--penalty 100 --tolerance 1e-30", "stagnated", None, None),
        ("--penalty 100 --tolerance 1e-12 --scalar f32", "stagnated", None, None),
        ("--penalty 1e12 --tolerance 1e-18", "stagnated", None, None),
        ("--penalty 1e5 --tolerance 1e-17", "stagnated", None, None),
        ("--penalty 1e-9 --tolerance 1e-3", "out_of_steps", Some(1000), Some("387328217713")),
        (
            "--penalty 1e-9 --tolerance 1e-3 --max-augmentations 0",
            "out_of_steps",
            Some(0),
            Some("387328217713"),
        ),
        ("--penalty 100 --tolerance 1e-30 --scalar mpfr:200", "converged", Some(95), Some("95")),
        ("--penalty 100 --tolerance 1e-30 --scalar exact", "converged", Some(95), Some("95")),
        // p̂ is 0 at once, and only the bound knows that 1e-6 is met all the same.
        ("--penalty 1e8 --tolerance 1e-6 --scalar f32", "converged", Some(0), None),
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

/// R of the default system in f32 is 630457/131072, far from what 10⁸ p̂ would say.
#[test]
fn the_force_of_f32_is_enclosed() {
    let (answer, _) = solve("--method augmented --penalty 1e8 --tolerance 1e-6 --scalar f32");
    let force = &answer["bounds"]["contact_force"];
    let reaction: Exact = "630457/131072".parse().unwrap();
    assert!(exact(&force[0]) <= reaction && reaction <= exact(&force[1]), "{force}");
}

#[test]
fn a_mass_that_hangs_free_feels_no_plane() {
    for start in ["0", "5", "-5"] {
        let (answer, code) = solve(&format!("--method augmented --height 2 --initial-multiplier {start}"));
        assert_eq!(
            (&answer["state"], &answer["outcome"], &answer["contact_force"], code),
            (&"separated".into(), &"converged".into(), &"0".into(), Some(0)),
            "from λ₀ = {start}"
        );
    }
}

/// The exact answer for the parameters as rounded, by (1.6) in rationals.
fn enclosed<T: ToExact>(system: &SpringMass<Exact>, like: &T, bounds: &Value) {
    let rounded = |x: &Exact| -> Result<Exact, RangeError> { Ok(like.nearest(x)?.to_exact().unwrap()) };
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

/// As decimals, not as the floats they are printed from.
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

/// Names and values, in any order.
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

#[test]
fn csv_says_what_json_says() {
    for scalar in ["f32", "f64", "mpfr:200", "exact"] {
        for method in ["lagrange", "penalty --penalty 7", "augmented", "augmented --tolerance 1e-30"] {
            let arguments = format!("--method {method} --scalar {scalar}");
            let line = format!("solve --format csv {arguments}");
            let csv = contact(&line.split(' ').collect::<Vec<_>>());
            let mut lines = stdout(&csv).lines().map(|line| line.split(',').map(str::to_string));
            let (names, values) = (lines.next().expect("names"), lines.next().expect("values"));
            let mut fields: Vec<_> = names.zip(values).collect();
            fields.sort();
            let (json, code) = solve(&arguments);
            assert_eq!((fields, csv.status.code()), (flat(&json), code), "{arguments}");
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

#[test]
fn a_terminal_of_80_columns_is_enough() {
    for line in [
        "--help",
        "solve --help",
        "solve -h",
        "completions --help",
        "solve",
        "solve --scalar exact --stiffness 1/3 --height 22/7",
        "solve --scalar mpfr:1000 --gravity -1/3e0",
        "solve --scalar mpfr:1000 --gravity -1/3 --method augmented --trace",
        "solve --scalar exact --method augmented --penalty 1/3 --trace",
        "solve --method augmented --tolerance 1e-30 --trace",
        "solve --stiffness 1.2345678901234567e-300 --mass 1.2345678901234567e-300 --gravity -1.2345678901234567",
        "solve --mass 1e100000 --scalar exact",
    ] {
        let output = contact(&line.split(' ').collect::<Vec<_>>());
        let wide = stdout(&output).lines().find(|line| line.chars().count() > 80);
        assert_eq!(wide, None, "{line}");
    }
}

/// One line on stderr, nothing on stdout, exit 2.
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
    const SPELLING: &str = "a number is a decimal (0.05), scientific (5e-2) or a fraction (1/20)";
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
            ("0x10", SPELLING),
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
        assert!(line.contains("must be a whole number from 0 to 18446744073709551615"), "{line}");
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
        let said = format!("'{}' is not used by --method {}", option.join(" "), method[0]);
        assert!(line.contains(&said) && line.contains(&format!("belongs to --method {owner}")), "{line}");
    }
}

#[test]
fn no_text_can_break_the_line() {
    let long = "1".repeat(100_000) + "x";
    for arguments in [
        &["solve", "--mass", "1\n2"],
        &["solve", "--mass", "\u{1b}[31m"],
        &["solve", "\n", "x"],
        &["solve", "--mass", &long],
        &["so\nlve", "--mass", "1"],
    ] {
        assert!(refusal(arguments).len() < 300);
    }
}

#[cfg(unix)]
#[test]
fn text_that_is_not_unicode_is_refused() {
    use std::os::unix::ffi::OsStrExt;
    let mut command = Command::new(env!("CARGO_BIN_EXE_contact"));
    let output =
        command.args(["solve", "--mass"]).arg(std::ffi::OsStr::from_bytes(b"\xff")).output().unwrap();
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
        let line = refusal(&arguments.split(' ').collect::<Vec<_>>());
        assert!(line.contains("leaves the range of this scalar"), "{line}");
    }
}

/// As `contact … | head -1` does, long before the trace is at its end.
#[test]
fn a_closed_pipe_is_no_error() {
    for format in ["table", "json", "csv"] {
        let line = "solve --method augmented --penalty 1e-3 --max-augmentations 10000 --trace --format";
        let mut command = Command::new(env!("CARGO_BIN_EXE_contact"));
        command.args(line.split(' ')).arg(format).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the command runs");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("the command ends");
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()), "{format}");
    }
}

#[test]
fn every_shell_has_completions() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = contact(&["completions", shell]);
        assert_eq!(output.status.code(), Some(0));
        assert!(stdout(&output).contains("initial-multiplier"), "{shell}");
    }
}
