//! The command `contact` as a child process.
//!
//! Its output is recorded in `tests/cmd`, with a reason for each value; these tests check properties beyond
//! snapshots: bounds hold, numbers agree with the library, and the book and the README are current.

use crate::processes::{DEADLINE, Scratch, captured, command, root};
use serde_json::Value;
use spring_mass_contact::chapter::{SpringMass, contact};
use spring_mass_contact::claims::entries;
use spring_mass_contact::number::{Exact, RangeError, ToExact};
use spring_mass_contact::solver::{Method, Plane, solve_observed};
use spring_mass_contact::verify::claim_names;
use std::collections::BTreeSet;
use std::iter;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

/// `contact prove`, run once for all tests.
static PROVED: LazyLock<Output> = LazyLock::new(|| contact(&["prove"]));

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

fn solve(arguments: &str) -> Value {
    json(&words(&format!("solve {arguments}"))).0
}

fn exact(value: &Value) -> Exact {
    value.as_str().and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("{value} is no number"))
}

fn keys(object: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = object.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

fn array(value: &Value) -> &[Value] {
    value.as_array().expect("an array")
}

#[test]
fn output_is_reproducible() {
    let contact = Path::new(env!("CARGO_BIN_EXE_contact"));
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

/// Asserts that the bounds contain the exact solution for the rounded parameters, by (1.6) in rationals.
fn enclosed<T: ToExact>(system: &SpringMass<Exact>, like: &T, bounds: &Value) {
    let rounded =
        |x: &Exact| -> Result<Exact, RangeError> { Ok(like.round_from_exact(x)?.to_exact().unwrap()) };
    let system = system.as_ref().try_map(rounded).unwrap();
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
    let heights = ["1.05", "1.0981", "-1/3", "1.00000000000000001", "1e30"];
    for (c, h) in ["100", "1/3", "7e-30", "1.7e30"].into_iter().flat_map(|c| heights.map(|h| (c, h))) {
        let system = SpringMass { c, m: "1", g: "9.81", l: "1", h }.parse().unwrap();
        for method in ["lagrange", "augmented --max-augmentations 3"] {
            let bounds = |scalar: &str| {
                let options = format!("--scalar {scalar} --method {method}");
                solve(&format!("--stiffness {c} --height {h} {options}"))["bounds"].take()
            };
            enclosed(&system, &0_f32, &bounds("f32"));
            enclosed(&system, &0_f64, &bounds("f64"));
            enclosed(&system, &Exact::from(0).to_mpfr(2), &bounds("mpfr:2"));
            enclosed(&system, &Exact::from(0).to_mpfr(113), &bounds("mpfr:113"));
            enclosed(&system, &Exact::from(0), &bounds("exact"));
        }
    }
}

/// A parameter is printed as it was entered, and as it was rounded if this is visible.
#[test]
fn rounding_notes_appear_only_for_visible_rounding() {
    let seen = |typed: &str, scalar: &str| -> Option<String> {
        let line = format!("--stiffness 1 --mass 1 --gravity 1 --height 0 --free-length={typed}");
        let output = contact_line(&format!("solve {line} --scalar {scalar}"));
        let words = stdout(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(&format!("l = {typed} m, H = 0 m")), "{words}");
        let rounded = stdout(&output).lines().find_map(|line| line.strip_prefix(" as rounded"));
        rounded.map(|numbers| numbers.trim().to_string())
    };
    // Six digits in f32 and fifteen in f64 come back, whatever they are; a fraction has none.
    for typed in ["9.81", "999999", "-123.456", "7.00001e-30", "-22/7", "0"] {
        assert_eq!(["f32", "f64", "exact"].map(|scalar| seen(typed, scalar)), [None, None, None], "{typed}");
    }
    for (typed, scalar, expected) in [
        ("999999999999999", "f64", None),
        // 2²⁴ + 1 does not fit. 1.4…e-45 is the least f32.
        ("16777217", "f32", Some("l = 16777216 m")),
        ("1e-45", "f32", Some("l ≈ 1.4013e-45 m")),
        // Two bits: 1, 3/2, 2, 3, 4, 6, 8, 12, …, and 3/32 is 0.09375.
        ("9.81", "mpfr:2", Some("l = 8 m")),
        ("0.1", "mpfr:2", Some("l = 0.09375 m")),
        ("1/3", "mpfr:2", Some("l = 0.375 m")),
        ("6e2", "mpfr:2", Some("l = 512 m")),
        ("0x1.8p-3", "mpfr:2", None),
        ("0x1.ep-3", "mpfr:2", Some("l = 0.25 m")),
        ("0x1.999999999999ap-4", "f32", Some("l ≈ 0.10000000149012 m")),
        ("1.50", "mpfr:2", None),
        ("1.05", "bf16", Some("l ≈ 1.04688 m")),
    ] {
        assert_eq!(seen(typed, scalar).as_deref(), expected, "{typed} in {scalar}");
    }
}

/// The command adds keys to the serialisation of the library; common keys have equal values, except that bounds are
/// texts that enclose.
#[test]
fn the_library_and_the_command_serialise_alike() {
    let system = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap();
    for (arguments, method) in [
        ("--method lagrange", Method::Lagrange),
        ("--method penalty --penalty 7", Method::Penalty { penalty: 7.into() }),
        ("--method augmented --trace", Method::augmented(1000.into())),
    ] {
        let printed = solve(&format!("{arguments} --scalar exact"));
        let mut iterates = Vec::new();
        let solution = solve_observed(&system, &method, Plane::Unilateral, |k| iterates.push(k.clone()));
        let solution = solution.unwrap();
        assert_eq!(printed["kkt"], serde_json::to_value(solution.residuals(&system).unwrap()).unwrap());
        let solution = serde_json::to_value(solution).unwrap();
        let all = "augmentations bounds contact_force deflection floor multiplier outcome penetration state";
        assert_eq!(keys(&solution), words(all));
        for (name, value) in solution.as_object().unwrap().iter().filter(|(name, _)| *name != "bounds") {
            assert_eq!(printed[name], *value, "{name}, {arguments}");
        }
        if arguments.ends_with("--trace") {
            assert_eq!(printed["trace"], serde_json::to_value(&iterates).unwrap());
        }
    }
}

/// Storing a table of 10⁵ steps would exceed the memory limit.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_length_of_a_trace() {
    for format in ["table", "json"] {
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
    let provable = entries().iter().filter(|entry| !entry.claims.is_empty());
    let proofs: Vec<_> = ["prove"].into_iter().chain(provable.map(|entry| entry.equation)).collect();
    let proofs = contact(&proofs);
    let lines = [
        "--help",
        "solve --help",
        "check --help",
        "check -- false",
        "verify --cases 2 --scalar mpfr:2 --scalar mpfr:3 --scalar mpfr:4 --scalar mpfr:5 --scalar mpfr:6",
        "equations 1.1 1.10 1.13 1.16 1.33",
        "solve --scalar exact --stiffness 1/3 --height 22/7",
        "solve --scalar mpfr:1000 --gravity -1/3 --method augmented --trace",
        "solve --scalar exact --method augmented --penalty 1/3 --trace",
        "solve --method augmented --scalar mpfr:9 --stiffness 1e-30000 --mass 1e-30000 --gravity -1 --trace",
        "solve --method augmented --penalty 1 --tolerance 1e-14 --trace --max-augmentations 10000",
        "solve --stiffness 1.2345678901234567e-300 --mass 1.2345678901234567e-300 --gravity -1.2345678901234567",
        "sweep --penalty 1e-99999..1e99999 --points 9 --scalar mpfr:9000 --gravity -1/3 --free-length 1234567",
        "sweep --penalty 1234567890/123456789..12345678901234567890 --points 2 --scalar exact",
    ];
    for output in lines.map(contact_line).iter().chain([&proofs, &PROVED]) {
        let too_wide = stdout(output).lines().find(|line| line.chars().count() > 80);
        assert_eq!(too_wide, None);
    }
}

/// In a terminal of 100 columns a slow program has a progress bar, which is erased before the report.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "requires script"]
fn a_terminal_gets_a_bar() {
    // Seven answers of a fifth of a second each: most are there when the bar is first drawn.
    let slow = "while read -r line; do sleep 0.2; echo \"$line\" | \"$CONTACT\" solve --batch; done";
    let line = format!("\"$CONTACT\" check --family contact --cases 7 -- sh -c '{slow}'");
    let mut script = Command::new("script");
    script.args(["-qec", &format!("stty cols 100 rows 40; {line}"), "/dev/null"]);
    script.env("TERM", "xterm").env("CONTACT", env!("CARGO_BIN_EXE_contact"));
    let output = captured(&mut script);
    let (bars, report) = stdout(&output).split_once(" program ").expect("a report");
    let percents = bars.split("checking ").skip(1).filter_map(|bar| bar.split_once(" %"));
    let percents = percents.filter_map(|(bar, _)| bar.split(' ').next_back()?.parse::<u32>().ok());
    let percents: Vec<_> = percents.collect();
    assert!(!percents.is_empty() && percents.is_sorted() && percents[0] > 50, "{bars:?}");
    assert!(bars.ends_with("\u{1b}[2K") && report.contains("7: 7 right"), "{bars:?}");
}

/// Each claim in each number system that it can be made in, once, proved or held in decided cases, for other cases
/// and precisions than the default.
#[test]
fn the_whole_chapter_holds() {
    let line = "verify --scalar f32 --scalar f64 --scalar exact --scalar mpfr:777 --cases 50 --seed 99";
    let (report, code) = json(&words(line));
    assert_eq!(keys(&report), ["equations", "shared", "summary"]);
    assert_eq!((code, array(&report["shared"]).is_empty()), (Some(0), true));
    let equations: Vec<_> = array(&report["equations"]).iter().map(|e| e["equation"].as_str()).collect();
    assert!((1..=33).all(|n| equations.contains(&Some(format!("1.{n}").as_str()))), "{equations:?}");
    for equation in array(&report["equations"]) {
        let number = equation["equation"].as_str().expect("a number");
        let mut seen = BTreeSet::new();
        for claim in array(&equation["claims"]) {
            let all = "bound claim counterexample decided kind reason scalar status undecided worst";
            assert_eq!(keys(claim), words(all), "{number}");
            let [name, scalar] = ["claim", "scalar"].map(|key| claim[key].as_str());
            assert!(seen.insert((name, scalar)), "{number}: {claim} twice");
            assert_eq!(
                claim["status"],
                if scalar.is_some() { "held" } else { "proved" },
                "{number}: {claim}"
            );
            let [decided, undecided] = ["decided", "undecided"].map(|key| claim[key].as_u64().unwrap());
            let cases = if scalar.is_some() { 50 } else { 0 };
            assert!(decided + undecided == cases && (decided > 0 || cases == 0), "{number}: {claim}");
            let worst = claim["worst"].as_str().map_or(0.0, |worst| worst.parse().unwrap());
            let rounds = scalar != Some("exact") || claim["kind"] == "experiment";
            assert!((0.0..=f64::from(u8::from(rounds))).contains(&worst), "{number}: {claim}");
        }
        let claims: BTreeSet<_> = seen.iter().filter_map(|(claim, _)| *claim).collect();
        assert_eq!(claims, claim_names(number).into_iter().collect(), "{number}");
        let scalars: BTreeSet<_> = seen.iter().map(|(_, scalar)| *scalar).collect();
        assert!(["f32", "f64", "mpfr:777"].iter().all(|scalar| scalars.contains(&Some(scalar))), "{number}");
        // The chapter's own numbers are all proved.
        assert!(scalars.contains(&None) || !number.starts_with("1."), "{number}");
    }
}

/// Seeds 1 and 2³² + 1 differ, in both commands with random cases.
#[test]
fn a_seed_of_64_bits_determines_the_cases() {
    for line in ["verify 1.33 --cases 5 --scalar f32 --format json", "cases --family near --cases 3"] {
        let out = |seed| contact_line(&format!("{line} --seed {seed}")).stdout;
        assert_eq!(out("1"), out("1"));
        assert_ne!(out("1"), out("4294967297"), "{line}");
    }
}

/// In any notation and order, twice or once, and a name and its number as two words.
#[test]
fn equations_are_selected_in_the_order_of_the_chapter() {
    for command in ["equations", "verify --cases 5"] {
        let numbers = ["note", "4", "theorem 1.3.3", "Eq. (1.13)", "1.13"];
        let (rows, code) = json(&[&words(command)[..], &numbers].concat());
        let rows = rows.get("equations").unwrap_or(&rows);
        let found: Vec<_> = array(rows).iter().map(|row| row["equation"].as_str().unwrap()).collect();
        assert_eq!((found, code), (vec!["1.13", "Theorem 1.3.3", "note 4"], Some(0)), "{command}");
    }
}

#[test]
fn colours_and_widths_of_the_terminal_do_not_matter_to_a_pipe() {
    for line in ["verify 1.13 --cases 2 --scalar f64", "equations", "equations 1.13"] {
        let arguments = words(line);
        let usual = contact(&arguments);
        let mut command = command();
        command.env_remove("NO_COLOR").env("CLICOLOR_FORCE", "1").env("COLUMNS", "7").args(&arguments);
        let output = captured(&mut command);
        assert_eq!((stdout(&output), output.status), (stdout(&usual), usual.status), "{line}");
        assert!(!stdout(&output).contains('\u{1b}'), "{line}");
    }
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

/// All claims are proved, all mutations are detected and all hypotheses are needed; and the JSON has the keys of the book.
#[test]
fn the_whole_chapter_is_proved() {
    let (report, code) = json(&["prove"]);
    assert_eq!((keys(&report), code), (vec!["equations", "mutations", "summary"], Some(0)));
    let count = |key: &str| report["summary"][key].as_u64().expect("a count");
    let all = "claims detected equivalent hypotheses mutations proved refuted undetected unknown";
    assert_eq!(keys(&report["summary"]), words(all));
    let claims: Vec<_> = array(&report["equations"]).iter().flat_map(|e| array(&e["claims"])).collect();
    assert_eq!((claims.len() as u64, count("proved")), (count("claims"), count("claims")));
    assert_eq!(count("detected") + count("equivalent"), array(&report["mutations"]).len() as u64);
    for claim in claims {
        let all = "claim counterexample dropped hypotheses kind proof reason statement status";
        assert_eq!((keys(claim), &claim["status"]), (words(all), &"proved".into()), "{claim}");
        array(&claim["proof"])
            .iter()
            .for_each(|goal| assert_eq!(keys(goal), ["atoms", "goal", "hypotheses", "proof"]));
        let dropped = array(&claim["dropped"]);
        // That a number has two bits goes without saying.
        let said = array(&claim["hypotheses"]).iter().filter(|given| *given != "2ᵖ ≥ 4");
        assert_eq!(dropped.len(), said.count(), "{claim}");
        for dropped in dropped {
            let undecided = dropped["hypothesis"] == "ε (2ᵖ + 1) ≥ 64 (c + ε)";
            assert!(dropped["status"] == "refuted" || undecided, "{claim}");
            dropped["counterexample"]
                .as_object()
                .iter()
                .flat_map(|values| values.values())
                .for_each(|x| drop(exact(x)));
        }
    }
    for change in array(&report["mutations"]) {
        assert_eq!(keys(change), ["at", "by", "counterexample", "mutation", "status"]);
        assert!(change["at"].as_str().is_some_and(|at| at.starts_with("src/chapter/")), "{change}");
        let detected = change["status"] == "detected";
        assert_eq!((change["by"].is_string(), change["counterexample"].is_object()), (detected, detected));
    }
    let claims = count("claims");
    assert!(stdout(&PROVED).contains(&format!("\n{claims} of {claims} claims proved in ")));
}

/// A directory's name may need quotes, or be longer than a line. Each command that is printed runs, here with a stand-in
/// for coqc, which like it writes a cache to the directory that it is started in.
#[cfg(unix)]
#[test]
fn a_directory_for_coq_can_have_any_name() {
    let scratch = Scratch::new("coq");
    let directory =
        scratch.join("-it's $HOME, \"quoted\" & long: * ~ ü a\\b/2").join("0123456789/".repeat(15));
    let output = contact(&["prove", "--coq", directory.to_str().expect("UTF-8")]);
    assert_eq!(output.status.code(), Some(0));
    let (_, commands) = stdout(&output).split_once('\n').expect("commands");
    let coqc = "test $# = 4 && test -f \"$4\" && test \"$1 $2 $3\" = '-R . Contact' && echo \"$4\" && touch .nra.cache";
    let script = format!("set -e\ncoqc() {{ {coqc}; }}\n{commands}");
    let started_in = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let ran = Command::new("sh").args(["-c", &script]).current_dir(started_in).output().expect("a shell");
    assert!(stdout(&ran).lines().count() > 10 && ran.status.success(), "{script}");
    let has_cache = |directory: &Path| directory.join(".nra.cache").is_file();
    assert_eq!([&*directory, started_in].map(has_cache), [true, false]);
}

#[test]
fn every_shell_has_completions() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let output = contact(&["completions", shell]);
        assert_eq!(output.status.code(), Some(0));
        assert!(stdout(&output).contains("initial-multiplier"), "{shell}");
    }
}
