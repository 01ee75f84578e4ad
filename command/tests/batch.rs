//! `contact solve --batch` as a child process: answers, their order and their timing.

use crate::processes::{DEADLINE, captured, command, finish, root};
use proptest::prelude::*;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use spring_mass_contact::number::Exact;
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Output, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

fn contact(arguments: &str) -> Command {
    let mut command = command();
    command.arg("solve").args(arguments.split_whitespace());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn spawn(arguments: &str) -> Child {
    contact(&format!("--batch {arguments}")).spawn().expect("the command runs")
}

/// Writes the input from a separate thread, so that output can be read meanwhile.
fn feed(mut stdin: ChildStdin, input: Vec<u8>) {
    // A command that has ended does not read; what it was to say of that is asked elsewhere.
    thread::spawn(move || stdin.write_all(&input));
}

fn raw(arguments: &str, input: impl Into<Vec<u8>>) -> Output {
    let mut child = spawn(arguments);
    feed(child.stdin.take().expect("a pipe"), input.into());
    finish(child)
}

/// Returns the lines of the output and the exit status; asserts that stderr is empty.
fn batch(arguments: &str, input: impl Into<Vec<u8>>) -> (Vec<Value>, Option<i32>) {
    let output = raw(arguments, input);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(text.is_empty() || text.ends_with('\n'));
    (text.lines().map(|line| serde_json::from_str(line).expect(line)).collect(), output.status.code())
}

/// Returns the answer to one line.
fn one(arguments: &str, line: &str) -> Value {
    let (answers, _) = batch(arguments, line);
    assert_eq!(answers.len(), 1, "{line}");
    answers.into_iter().next().unwrap()
}

/// With a plane at H = l + n/10⁶ a heavy mass has u = n/10⁶, in every number system and after lines of any
/// duration.
#[test]
fn answers_come_in_the_order_of_the_lines() {
    const LINES: usize = 5_000;
    let line = |n: usize| {
        let scalar = if n % 1999 == 3 { "mpfr:200000" } else { "exact" };
        let height = format!("{}.{:06}", 1 + n / 1_000_000, n % 1_000_000);
        format!("{{\"id\": {n}, \"height\": {height}, \"gravity\": 99, \"scalar\": \"{scalar}\"}}\n")
    };
    let (answers, code) = batch("", (0..LINES).map(line).collect::<String>());
    assert_eq!((answers.len(), code), (LINES, Some(0)));
    for (n, answer) in answers.iter().enumerate() {
        assert_eq!(answer["id"], n);
        if answer["scalar"] == "exact" {
            let u: Exact = answer["deflection"].as_str().unwrap().parse().unwrap();
            assert_eq!(u, format!("{n}/1000000").parse().unwrap());
        }
    }
}

/// A line is answered before the next is sent: a program need not know their number.
#[test]
fn a_line_is_answered_before_the_next_one_comes() {
    let mut child = spawn("");
    let mut stdin = child.stdin.take().expect("a pipe");
    let mut stdout = BufReader::new(child.stdout.take().expect("a pipe"));
    let (to, lines) = mpsc::channel();
    thread::spawn(move || {
        let mut line = String::new();
        while stdout.read_line(&mut line).is_ok_and(|bytes| bytes > 0) && to.send(line.clone()).is_ok() {
            line.clear();
        }
    });
    for n in 0..200 {
        // Some come in two parts, some two at a time.
        let text = format!("{{\"id\": {n}}}\n{{\"id\": -1}}\n");
        let (text, answers) =
            if n % 3 == 0 { (&*text, 2) } else { (text.split_inclusive('\n').next().unwrap(), 1) };
        let (head, tail) = text.split_at(n % 8);
        stdin.write_all(head.as_bytes()).unwrap();
        stdin.write_all(tail.as_bytes()).unwrap();
        for _ in 0..answers {
            let answer = lines.recv_timeout(DEADLINE).expect("an answer before the next line");
            assert!(
                answer.starts_with(&format!("{{\"id\":{n},")) || answer.starts_with("{\"id\":-1,"),
                "{answer}"
            );
        }
    }
    drop(stdin);
    assert!(lines.recv_timeout(DEADLINE).is_err() && finish(child).status.success());
}

#[test]
fn ids_are_returned_unchanged() {
    let deep = "[".repeat(10_000) + &"]".repeat(10_000);
    let escaped = "\"a \\u00e9 é \\\" \\ud800\"";
    let ids = [
        "null",
        "-1.50e+07",
        "123456789012345678901234567890.10",
        escaped,
        "{ \"b\": [ ] , \"b\": 1 }",
        &deep,
    ];
    for id in ids {
        // Of an answer, and of an error.
        for (rest, next) in [("}\r", "method"), (", \"mass\": 0}", "error")] {
            let output = raw("", format!("{{\"id\": {id}{rest}"));
            let text = String::from_utf8(output.stdout).expect("UTF-8");
            assert!(text.starts_with(&format!("{{\"id\":{id},\"{next}\":")), "{text}");
        }
    }
    // For some readers this ends a line.
    let output = raw("", "{\"id\": [1,\r2]}");
    assert!(output.stdout.starts_with(b"{\"id\":[1, 2],") && !output.stdout.contains(&b'\r'));
    assert_eq!(one("", "{}")["id"], Value::Null);
    assert_eq!(one("", "\u{feff}{\"id\": 7}")["id"], 7, "a byte-order mark is skipped");
}

/// 0.1 is no float, and these digits exceed those of f64.
#[test]
fn numbers_are_read_by_their_digits() {
    for (spelled, value) in [
        ("0.1", "1/10"),
        ("\".1\"", "1/10"),
        ("1E+3", "1000"),
        ("12345678901234567890123", "12345678901234567890123"),
        ("1e-400", &format!("1/1{}", "0".repeat(400))),
        ("\"\\u0031\"", "1"),
        ("\"-0X1E\"", "-30"),
    ] {
        // The mass hangs free, and p = l + 0 − H.
        let line = format!(
            "{{\"free_length\": {spelled}, \"scalar\": \"exact\", \"gravity\": 0, \"height\": 1e30}}"
        );
        let answer = one("", &line);
        let p: Exact = answer["penetration"].as_str().unwrap_or_else(|| panic!("{answer}")).parse().unwrap();
        assert_eq!(p + "1e30".parse::<Exact>().unwrap(), value.parse().unwrap(), "{spelled}");
    }
}

/// An error names the key, the fault and the allowed values; later lines are unaffected.
#[test]
fn an_error_is_a_line() {
    const SPELLING: &str =
        "a number is a decimal (0.05), scientific (5e-2), hexadecimal (0x1.8p-3) or a fraction (1/20)";
    const KEYS: &str = "[keys: id, stiffness, mass, gravity, free_length, height, method, penalty, tolerance, \
                        max_augmentations, initial_multiplier, bilateral, scalar]";
    let long = "7".repeat(5000) + "x";
    for (fields, error) in [
        (format!("\"{long}\": 1"), format!("unexpected key '{}…' found; {KEYS}", &long[..39])),
        (
            format!("\"mass\": \"{long}\""),
            format!("invalid value '{}…' for 'mass': not a number; {SPELLING}", &long[..39]),
        ),
        ("\"mass\": null".into(), format!("invalid value 'null' for 'mass': not a number; {SPELLING}")),
        ("\"mass\": \"\"".into(), format!("invalid value '' for 'mass': empty; {SPELLING}")),
        // What would end the line of an error, or turn it around, is not passed on.
        (
            "\"mass\": \"1\\n2\u{202e}3\"".into(),
            format!("invalid value '1\u{fffd}2\u{fffd}3' for 'mass': not a number; {SPELLING}"),
        ),
        ("\"mass\": -1".into(), "invalid value '-1' for 'mass': must be greater than 0".into()),
        ("\"mass\": 1e400".into(), "invalid value '1e400' for 'mass': overflows f64; use mpfr:BITS or exact".into()),
        ("\"trace\": true".into(), format!("unexpected key 'trace' found; {KEYS}")),
        ("\"mass\": 1, \"m\\u0061ss\": 1".into(), "the key 'mass' cannot be used multiple times".into()),
        ("\"id\": 7".into(), "the key 'id' cannot be used multiple times".into()),
        (
            "\"method\": null".into(),
            "invalid value 'null' for 'method': [possible values: lagrange, penalty, augmented]".into(),
        ),
        (
            "\"scalar\": 64".into(),
            "invalid value '64' for 'scalar': must be f16, bf16, f32, f64, mpfr:BITS with 2 to 1000000 bits, or exact".into(),
        ),
        ("\"bilateral\": 1".into(), "invalid value '1' for 'bilateral': must be true or false".into()),
        (
            "\"method\": \"augmented\", \"max_augmentations\": 1e3".into(),
            "invalid value '1e3' for 'max_augmentations': must be an integer from 0 to 18446744073709551615".into(),
        ),
        (
            "\"penalty\": 5".into(),
            "'penalty 5' has no effect with method lagrange; use it with method penalty or augmented".into(),
        ),
        (
            "\"method\": \"penalty\"".into(),
            "method penalty needs 'penalty', greater than 0; for example 10 c: penalty 1000".into(),
        ),
        (
            "\"mass\": 1e300, \"gravity\": 1e300".into(),
            "scalar f64: the contact force is out of the range of this scalar; use MPFR (mpfr:BITS) or exact rationals"
                .into(),
        ),
    ] {
        let (answers, code) = batch("", format!("{{\"id\": 1, {fields}}}\n{{\"id\": 2}}\n"));
        assert_eq!((answers.len(), code), (2, Some(1)), "{fields}");
        assert_eq!(answers[0], json!({ "id": 1, "error": error }), "{fields}");
        assert_eq!((&answers[1]["id"], &answers[1]["outcome"]), (&json!(2), &json!("direct")), "{fields}");
    }
}

/// Lines that are not objects, or not text, do not affect the next line.
#[test]
fn no_bad_line_gets_further_than_an_error() {
    let deep = "[".repeat(100_000);
    let bad: [&[u8]; 10] = [
        b"x",
        b"[{}]",
        b"null",
        b"{\"mass\": 1",
        b"{\"mass\": 1,}",
        b"{\"mass\": .5}",
        b"{} {}",
        b"{\0}\0",
        b"\xff",
        deep.as_bytes(),
    ];
    for line in bad {
        let (answers, code) = batch("", [line, b"\n{}"].concat());
        assert_eq!((answers.len(), code), (2, Some(1)), "{answers:?}");
        let error = answers[0]["error"].as_str().expect("an error");
        assert!(answers[0]["id"].is_null() && answers[1]["outcome"] == "direct", "{answers:?}");
        assert!(
            error.starts_with("invalid line '") && error.ends_with("; a line is a JSON object"),
            "{error}"
        );
        assert!(error.len() < 300 && !error.contains(" at line "), "{error}");
        let is_other = line.starts_with(b"[") || line == b"null";
        assert_eq!(error.contains("expected an object"), is_other, "{error}");
    }
}

const KEYS: [&str; 10] =
    ["stiffness", "mass", "gravity", "height", "penalty", "tolerance", "id", "method", "scalar", "Mass"];

/// Values, of which some are no JSON.
const VALUES: [&str; 16] = [
    "1",
    "-0",
    "1e-9",
    "1e400",
    "1e99999999999",
    "\"1/3\"",
    "\"1/0\"",
    "\"exact\"",
    "\"mpfr:70\"",
    "\"augmented\"",
    "null",
    "NaN",
    "[1]",
    "{}",
    "\"\\ud800\"",
    "01",
];

/// A line of pairs of keys and values, right or wrong, with one byte replaced and truncated, or not.
fn any_line() -> impl Strategy<Value = Vec<u8>> {
    let pair = (
        prop::sample::select(&KEYS[..]).prop_map(String::from),
        prop::sample::select(&VALUES[..]).prop_map(String::from),
    );
    let pairs = prop::collection::vec(pair, 0..3);
    let at = any::<prop::sample::Index>();
    (pairs, prop::option::weighted(0.2, (at.clone(), any::<u8>())), prop::option::weighted(0.1, at)).prop_map(
        |(pairs, byte, end)| {
            let pairs: Vec<_> = pairs.iter().map(|(key, value)| format!("\"{key}\":{value}")).collect();
            let mut line = format!("{{{}}}", pairs.join(",")).into_bytes();
            if let Some((at, byte)) = byte {
                let at = at.index(line.len());
                line[at] = byte;
            }
            line.truncate(end.map_or(line.len(), |end| end.index(line.len())));
            line.retain(|byte| !b"\r\n".contains(byte));
            line
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1))]

    #[test]
    fn any_lines_have_an_answer_each(lines in prop::collection::vec(any_line(), 200)) {
        let put: Vec<_> = lines.iter().filter(|line| !line.trim_ascii().is_empty()).collect();
        let output = raw("", lines.join(&b'\n'));
        // An id comes back whatever number it is, so not every answer is a `Value`.
        let answers = std::str::from_utf8(&output.stdout).expect("UTF-8").lines();
        let answers: Vec<HashMap<String, Box<RawValue>>> =
            answers.map(|line| serde_json::from_str(line).expect(line)).collect();
        prop_assert_eq!((answers.len(), output.stderr.len()), (put.len(), 0));
        for (line, answer) in put.iter().zip(&answers) {
            let error = answer.get("error").map(|error| serde_json::from_str::<String>(error.get()).unwrap());
            prop_assert_ne!(error.is_some(), answer.contains_key("state"));
            let is_line = |error: String| !error.contains(char::is_control) && (10..600).contains(&error.len());
            prop_assert!(error.is_none_or(is_line), "{}", String::from_utf8_lossy(line));
        }
        // Otherwise one of the two would hardly have been tried. About 140 are refused, with a deviation of 7.
        let refused = answers.iter().filter(|answer| answer.contains_key("error")).count();
        prop_assert!((20..180).contains(&refused), "{} of {}", refused, answers.len());
    }
}

#[test]
fn blank_lines_have_no_answer() {
    for (input, answers) in
        [("", 0), ("\n\n", 0), (" \r\n\t\n", 0), ("\n{}\n\n \r\n{}", 2), ("{}\r\n{}\r\n", 2)]
    {
        let (found, code) = batch("", input);
        assert_eq!((found.len(), code), (answers, Some(0)), "{input:?}");
    }
}

#[test]
fn options_are_defaults_for_the_lines() {
    let all = "--stiffness 7 --mass 2 --gravity=-3 --free-length 2 --height 1/2 --method augmented --penalty 5 \
               --tolerance 1e-3 --max-augmentations 77 --initial-multiplier 1 --bilateral --scalar exact";
    let alone = |arguments: &str| -> Value {
        let output = contact(&format!("--format json {arguments}")).output().expect("the command runs");
        let mut answer: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        answer["id"] = Value::Null;
        answer
    };
    assert_eq!(one(all, "{}"), alone(all));
    // Each of them gives way to the line's own.
    for (key, option, value) in [
        ("stiffness", "--stiffness 7", "70"),
        ("mass", "--mass 2", "20"),
        ("gravity", "--gravity=-3", "30"),
        ("free_length", "--free-length 2", "20"),
        ("height", "--height 1/2", "5"),
        ("penalty", "--penalty 5", "50"),
        ("tolerance", "--tolerance 1e-3", "1e-5"),
        ("max_augmentations", "--max-augmentations 77", "2"),
        ("initial_multiplier", "--initial-multiplier 1", "10"),
        ("scalar", "--scalar exact", "f32"),
        ("method", "--method augmented", "augmented"),
    ] {
        let other = all.replace(option, &format!("--{}={value}", key.replace('_', "-")));
        assert_eq!(one(all, &format!("{{\"{key}\": \"{value}\"}}")), alone(&other), "{key}");
        assert!(key == "method" || alone(&other) != alone(all), "{key} changes nothing");
    }
    assert_eq!(one(all, "{\"bilateral\": false}"), alone(&all.replace("--bilateral", "")));
    // Those that a line's method has no use for are not for that line.
    let lagrange =
        "--stiffness 7 --mass 2 --gravity=-3 --free-length 2 --height 1/2 --bilateral --scalar exact";
    let penalty = format!("{lagrange} --method penalty --penalty 5");
    assert_eq!(one(all, "{\"method\": \"lagrange\"}"), alone(lagrange));
    assert_eq!(one(all, "{\"method\": \"penalty\"}"), alone(&penalty));
    assert_eq!(one("--penalty 5", "{}")["outcome"], "direct");
    // But what the line itself says is.
    let error = one(all, "{\"method\": \"lagrange\", \"penalty\": 5}");
    assert!(error["error"].as_str().unwrap().contains("has no effect with method lagrange"), "{error}");
}

#[test]
fn the_exit_status_is_that_of_the_worst_line() {
    let unmet = "{\"method\": \"augmented\", \"max_augmentations\": 0}\n";
    for (input, status) in [("{}\n", 0), (unmet, 1), ("x\n", 1)] {
        for around in ["", "{}\n"] {
            let (answers, code) = batch("", format!("{around}{input}{around}"));
            assert_eq!(code, Some(status), "{answers:?}");
        }
    }
}

/// A line has at most 2²⁰ bytes. Longer ones are skipped without losing others.
#[test]
fn a_line_that_is_too_long_is_an_error() {
    const MOST: usize = 1 << 20;
    let line = |bytes: usize| {
        let rest = "{\"id\": \"\"}".len();
        format!("{{\"id\": \"{}\"}}\n", "x".repeat(bytes - rest))
    };
    let input =
        [line(MOST), line(MOST + 1), line(32 * MOST), "{\"id\": 3}\n".into(), line(MOST + 1)].concat();
    let (answers, code) = batch("", input.trim_end());
    let too_long = json!({ "id": null, "error": "a line must have no more than 1048576 bytes" });
    assert_eq!((answers.len(), code), (5, Some(1)));
    assert_eq!(answers[0]["outcome"], "direct");
    assert_eq!((&answers[1], &answers[2], &answers[4]), (&too_long, &too_long, &too_long));
    assert_eq!((&answers[3]["id"], &answers[3]["outcome"]), (&json!(3), &json!("direct")));
}

/// A reader like `| head -1` closes the pipe, with or without further output.
#[test]
fn a_closed_pipe_is_no_error() {
    for lines in [2, 20_000] {
        let mut child = spawn("");
        let mut stdin = child.stdin.take().expect("a pipe");
        drop(child.stdout.take());
        let waiting = thread::spawn(move || {
            // stdin stays open until the command ends. Another test that starts a process at this moment copies the
            // pipe for an instant, so that the first answers may still be written: another line follows.
            let mut lines = "{}\n".repeat(lines);
            while stdin.write_all(lines.as_bytes()).is_ok() {
                lines.truncate(3);
                thread::sleep(Duration::from_millis(50));
            }
        });
        let output = finish(child);
        assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()), "{lines}");
        drop(waiting.join());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_stdin_that_cannot_be_read_is_an_error() {
    let output = contact("--batch").stdin(File::open("/").unwrap()).output().expect("the command runs");
    let stderr = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!((output.status.code(), output.stdout, stderr.lines().count()), (Some(2), Vec::new(), 1));
    assert!(stderr.starts_with("error: cannot read stdin: "), "{stderr}");
}

/// The lines of the page, as far as it contains them.
#[test]
fn the_output_in_the_book_is_current() {
    let page = std::fs::read_to_string(root().join("book/src/command.md")).unwrap();
    let (_, section) = page.split_once("\n## Many systems, many machines\n").expect("the section");
    let mut blocks = section.split("```").skip(1).step_by(2);
    let mut block = |kind: &str| blocks.next().and_then(|block| block.strip_prefix(kind)).expect("a block");
    let (input, shown) = (block("json\n"), block("text\n"));
    let output = raw("", input);
    let answers = std::str::from_utf8(&output.stdout).expect("UTF-8");
    assert_eq!((answers.lines().count(), shown.lines().count()), (3, 3));
    for (answer, shown) in answers.lines().zip(shown.lines()) {
        assert!(answer.starts_with(shown.strip_suffix('…').expect("there is more")), "{answer}\n{shown}");
    }
}

/// Rationals with very many digits are an error in time and do not affect the next line.
#[test]
fn endless_digits_are_an_error_in_time() {
    let line = r#"{"method": "augmented", "scalar": "exact", "penalty": "1e-50000"}"#;
    let (answers, code) = batch("", format!("{line}\n{{}}\n"));
    let said = "scalar exact: multiplier: more than 2097152 binary digits; use MPFR (mpfr:BITS), a larger penalty or \
                tolerance, or fewer augmentations";
    assert_eq!((answers.len(), code), (2, Some(1)));
    assert_eq!((answers[0]["error"].as_str(), answers[1]["outcome"].as_str()), (Some(said), Some("direct")));
}

/// p = R/(c + ε), and for H = 1.05 it requires ε = 10⁷ for p < 10⁻⁶.
#[test]
#[ignore = "requires Python"]
fn a_program_in_python_can_use_it() {
    let mut python = Command::new("python3");
    let output = captured(python.arg(root().join("examples/batch.py")).arg(env!("CARGO_BIN_EXE_contact")));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let rows: Vec<Vec<_>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows.len(), 1 + 9 + 1, "{text}");
    for row in &rows[1..10] {
        let [height, penalty, penetration] = [row[0], row[1], row[3]].map(|x| x.parse::<f64>().unwrap());
        let reaction = 9.81 - 100.0 * (height - 1.0);
        // l + u − H is rounded by less than 2⁻⁵² three times; what is lost of R is divided by c.
        let expected = reaction / (100.0 + if reaction > 0.0 { penalty } else { 0.0 });
        assert!((penetration - expected).abs() < 1e-14, "{row:?}: {expected}");
        assert_eq!(row[2], if reaction > 0.0 { "contact" } else { "separated" }, "{row:?}");
    }
    assert_eq!(rows[10].join(" "), "below 1e-6 m with a penalty of 10000000 N/m");
}
