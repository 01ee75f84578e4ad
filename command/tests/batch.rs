//! `contact solve --batch` as a child process: answers, their order and their timing.

use crate::processes::{DEADLINE, asked, captured, command, finish, pick, random, root};
use oorandom::Rand64;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use spring_mass_contact::number::Exact;
use std::collections::HashMap;
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

/// Returns random options, as a command line and as an object.
fn draw(random: &mut Rand64) -> (String, Value) {
    let mut drawn = Vec::new();
    let method = ["lagrange", "penalty", "augmented"][random.rand_range(0..3) as usize];
    drawn.push(("method", json!(method)));
    let scalar = ["f32", "f64", "mpfr:100", "exact"][random.rand_range(0..4) as usize];
    drawn.push(("scalar", json!(scalar)));
    let mut number = |key, required: bool| {
        let (p, q) = (random.rand_range(1..3000), random.rand_range(1..1000));
        // A number of JSON, with its digits; or a text, as it is typed.
        let value = match random.rand_range(0..if required { 4 } else { 8 }) {
            0 => json!(format!("{p}/{q}")),
            1 => json!(format!("{p}.{q}")),
            2 => serde_json::from_str(&format!("{}e-3", p)).unwrap(),
            3 => serde_json::from_str(&format!("{p}")).unwrap(),
            _ => return,
        };
        drawn.push((key, value));
    };
    ["stiffness", "mass", "gravity", "free_length", "height"].into_iter().for_each(|key| number(key, false));
    if method != "lagrange" {
        number("penalty", method == "penalty");
    }
    if method == "augmented" {
        number("tolerance", false);
        number("initial_multiplier", false);
        drawn.push(("max_augmentations", json!(random.rand_range(0..40))));
    }
    let mut line = "--format json".to_string();
    for (key, value) in &drawn {
        let text = value.as_str().map_or_else(|| value.to_string(), String::from);
        line += &format!(" --{}={text}", key.replace('_', "-"));
    }
    let mut object: serde_json::Map<_, _> = drawn.into_iter().map(|(key, v)| (key.to_string(), v)).collect();
    if random.rand_range(0..2) == 1 {
        object.insert("bilateral".to_string(), json!(true));
        line += " --bilateral";
    }
    (line, object.into())
}

/// Lines are equal except for blanks, with the same numbers of each outcome.
#[test]
fn a_line_of_a_batch_equals_the_output_of_solve() {
    let random = &mut Rand64::new(1);
    let drawn: Vec<_> = (0..60).map(|_| draw(random)).collect();
    let input: String = drawn.iter().map(|(_, object)| format!("{object}\n")).collect();
    let output = raw("", input);
    let lines: Vec<_> = std::str::from_utf8(&output.stdout).unwrap().lines().collect();
    assert_eq!(lines.len(), drawn.len());
    let mut codes = [0; 3];
    for ((arguments, object), line) in drawn.iter().zip(lines) {
        let alone = contact(arguments).stdin(Stdio::null()).output().expect("the command runs");
        let code = alone.status.code().expect("a status") as usize;
        codes[code] += 1;
        if code == 2 {
            assert!(line.starts_with("{\"id\":null,\"error\":\""), "{object}: {line}");
        } else {
            let printed = String::from_utf8(alone.stdout).unwrap().replace(['\n', ' '], "");
            assert_eq!(line.replacen("\"id\":null,", "", 1), printed, "{object}");
        }
    }
    // Otherwise less would have been compared than it seems.
    assert!(codes[0] > 30 && codes[1] > 0, "{codes:?}");
    assert_eq!(output.status.code(), Some(1));
}

/// With a plane at H = l + n/10⁶ a heavy mass has u = n/10⁶, in every number system and after lines of any
/// duration.
#[test]
fn answers_come_in_the_order_of_the_lines() {
    const LINES: usize = 20_000;
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
    let ids = [
        "null",
        "true",
        "0",
        "-1.50e+07",
        "123456789012345678901234567890.10",
        "\"\"",
        "\"a \\u00e9 é \\\" b\"",
        "\"\\ud800\"",
        "[1, 2]",
        "{ \"b\": {}, \"a\": [ ] , \"b\": 1 }",
        &deep,
    ];
    for id in ids {
        // Of an answer, and of an error.
        for rest in ["}", ", \"mass\": 0}", "}\r"] {
            let output = raw("", format!("{{\"id\": {id}{rest}"));
            let text = String::from_utf8(output.stdout).expect("UTF-8");
            let with = if rest.contains("mass") { "error" } else { "method" };
            assert!(text.starts_with(&format!("{{\"id\":{id},\"{with}\":")), "{text}");
        }
    }
    // For some readers this ends a line.
    let output = raw("", "{\"id\": [1,\r2]}");
    assert!(output.stdout.starts_with(b"{\"id\":[1, 2],") && !output.stdout.contains(&b'\r'));
    for line in ["{}", "{\"mass\": 2}", "x", "{\"mass\": 0}"] {
        assert_eq!(one("", line)["id"], Value::Null, "{line}");
    }
    assert_eq!(one("", "\u{feff}{\"id\": 7}")["id"], 7, "a byte-order mark is skipped");
}

/// 1/3 and 0.1 are not floats, and these digits exceed those of f64.
#[test]
fn numbers_are_read_by_their_digits() {
    for (spelled, value) in [
        ("0.1", "1/10"),
        ("1e-1", "1/10"),
        ("\"1/10\"", "1/10"),
        ("\".1\"", "1/10"),
        (
            "0.10000000000000000000000000000000000001",
            "10000000000000000000000000000000000001/100000000000000000000000000000000000000",
        ),
        ("1E+3", "1000"),
        ("12345678901234567890123", "12345678901234567890123"),
        ("1e-400", &format!("1/1{}", "0".repeat(400))),
        ("\"\\u0031\"", "1"),
        ("\"0x1.8p-3\"", "3/16"),
        ("\"-0X1E\"", "-30"),
    ] {
        // Free, of weight and stiffness one, it is l that the penetration is made of: p = l + 1 − 10³⁰.
        let line = format!(
            "{{\"free_length\": {spelled}, \"scalar\": \"exact\", \"stiffness\": 1, \"gravity\": 1, \
             \"height\": 1e30}}"
        );
        let answer = one("", &line);
        let p: Exact = answer["penetration"].as_str().unwrap_or_else(|| panic!("{answer}")).parse().unwrap();
        let one_less = "1e30".parse::<Exact>().unwrap() - Exact::from(1);
        assert_eq!(p + one_less, value.parse().unwrap(), "{spelled}");
    }
}

/// Keys of a line with numbers as values.
const NUMBERS: [&str; 8] =
    ["stiffness", "mass", "gravity", "free_length", "height", "penalty", "tolerance", "initial_multiplier"];

/// An error names the key, the fault and the allowed values; later lines are unaffected.
#[test]
fn an_error_is_a_line() {
    const SPELLING: &str =
        "a number is a decimal (0.05), scientific (5e-2), hexadecimal (0x1.8p-3) or a fraction (1/20)";
    const KEYS: &str = "[keys: id, stiffness, mass, gravity, free_length, height, method, penalty, tolerance, \
                        max_augmentations, initial_multiplier, bilateral, scalar]";
    const WHOLE: &str = "must be an integer from 0 to 18446744073709551615";
    const METHODS: &str = "[possible values: lagrange, penalty, augmented]";
    const SCALARS: &str = "must be f32, f64, mpfr:BITS with 2 to 1000000 bits, or exact";
    let long = "7".repeat(5000) + "x";
    let long_key = format!("\"{long}\": 1");
    let long_value = format!("\"mass\": \"{long}\"");
    let augmented = |value: &str| format!("\"method\": \"augmented\", {value}");
    let mut cases = vec![
        (long_key, format!("unexpected key '{}…' found; {KEYS}", &long[..39])),
        (long_value, format!("invalid value '{}…' for 'mass': not a number; {SPELLING}", &long[..39])),
        ("\"free-length\": 1".into(), format!("unexpected key 'free-length' found; {KEYS}")),
        ("\"trace\": true".into(), format!("unexpected key 'trace' found; {KEYS}")),
        ("\"mass\": 1, \"mass\": 1".into(), "the key 'mass' cannot be used multiple times".into()),
        ("\"mass\": 1, \"m\\u0061ss\": 1".into(), "the key 'mass' cannot be used multiple times".into()),
        ("\"id\": 7".into(), "the key 'id' cannot be used multiple times".into()),
        (
            "\"method\": \"lagrange\", \"method\": \"lagrange\"".into(),
            "the key 'method' cannot be used \
             multiple times"
                .into(),
        ),
        ("\"method\": \"newton\"".into(), format!("invalid value 'newton' for 'method': {METHODS}")),
        ("\"method\": null".into(), format!("invalid value 'null' for 'method': {METHODS}")),
        ("\"scalar\": \"f16\"".into(), format!("invalid value 'f16' for 'scalar': {SCALARS}")),
        ("\"scalar\": 64".into(), format!("invalid value '64' for 'scalar': {SCALARS}")),
        ("\"bilateral\": 1".into(), "invalid value '1' for 'bilateral': must be true or false".into()),
        (
            "\"penalty\": 5".into(),
            "'penalty 5' has no effect with method lagrange; use it with method penalty \
             or augmented"
                .into(),
        ),
        (
            "\"max_augmentations\": 5".into(),
            "'max_augmentations 5' has no effect with method lagrange; use it \
             with method augmented"
                .into(),
        ),
        (
            "\"initial_multiplier\": -5, \"method\": \"penalty\", \"penalty\": 1".into(),
            "'initial_multiplier \
             -5' has no effect with method penalty; use it with method augmented"
                .into(),
        ),
        (
            "\"method\": \"penalty\"".into(),
            "method penalty needs 'penalty', greater than 0; for example 10 \
             c: penalty 1000"
                .into(),
        ),
        (
            "\"mass\": 1e400".into(),
            "invalid value '1e400' for 'mass': overflows f64; use mpfr:BITS or \
             exact"
                .into(),
        ),
        (
            "\"mass\": 1e300, \"gravity\": 1e300".into(),
            "scalar f64: the contact force is out of the range of \
             this scalar; use MPFR (mpfr:BITS) or exact rationals"
                .into(),
        ),
        (
            augmented("\"stiffness\": 1e308"),
            "invalid value '10 c, the default' for 'penalty': overflows \
             f64; use mpfr:BITS or exact"
                .into(),
        ),
    ];
    for value in ["1.5", "1e3", "-1", "true", "null", "\"\"", "18446744073709551616"] {
        let key = "max_augmentations";
        cases.push((
            augmented(&format!("\"{key}\": {value}")),
            format!("invalid value '{}' for '{key}': {WHOLE}", value.trim_matches('"')),
        ));
    }
    // What would end the line of an error, or turn it around, is not passed on.
    for value in ["1\\n2", "1\u{202e}2", "1\\u20282", "1\\u001b2"] {
        let error = format!("invalid value '1\u{fffd}2' for 'mass': not a number; {SPELLING}");
        cases.push((format!("\"mass\": \"{value}\""), error));
    }
    for key in NUMBERS {
        for value in ["true", "null", "[1]", "{}", "\"heavy\"", "\"NaN\"", "\"1,5\"", "\" 1\"", "\"\""] {
            let text = value.trim_matches('"');
            let what = if text.is_empty() { "empty" } else { "not a number" };
            cases.push((
                augmented(&format!("\"{key}\": {value}")),
                format!("invalid value '{text}' for '{key}': {what}; {SPELLING}"),
            ));
        }
        if !["gravity", "free_length", "height", "initial_multiplier"].contains(&key) {
            cases.push((
                augmented(&format!("\"{key}\": -1")),
                format!("invalid value '-1' for '{key}': must be greater than 0"),
            ));
        }
    }
    let input: String =
        cases.iter().map(|(fields, _)| format!("{{\"id\": 1, {fields}}}\n{{\"id\": 2}}\n")).collect();
    let (answers, code) = batch("", input);
    assert_eq!((answers.len(), code), (2 * cases.len(), Some(1)));
    for ((fields, error), answers) in cases.iter().zip(answers.chunks(2)) {
        assert_eq!(answers[0], json!({ "id": 1, "error": error }), "{fields}");
        assert_eq!((&answers[1]["id"], &answers[1]["outcome"]), (&json!(2), &json!("direct")), "{fields}");
    }
}

/// Lines that are not objects, or not text, do not affect the next line.
#[test]
fn no_bad_line_gets_further_than_an_error() {
    let deep = "[".repeat(100_000);
    let bad: [&[u8]; 19] = [
        b"x",
        b"{",
        b"}",
        b"[]",
        b"[{}]",
        b"1",
        b"\"\"",
        b"null",
        b"{\"mass\": 1",
        b"{\"mass\": }",
        b"{\"mass\": 1,}",
        b"{'mass': 1}",
        b"{\"mass\": .5}",
        b"{\"mass\": 01}",
        b"{\"mass\": NaN}",
        b"{} {}",
        b"\0",
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
        assert!(
            !line.starts_with(b"[") || error.contains(": invalid type: sequence, expected an object"),
            "{error}"
        );
    }
    // A text in UTF-16 is not JSON.
    assert!(one("", "{\0}\0\n")["error"].is_string());
}

/// The other keys of a line, and some invalid ones.
const OTHERS: [&str; 8] =
    ["id", "method", "scalar", "max_augmentations", "bilateral", "", "Mass", "no such key"];

/// Texts in place of a value; some are not JSON.
const VALUES: [&str; 40] = [
    "1",
    "0",
    "-0",
    "-1",
    "0.05",
    "1e-9",
    "-1E+3",
    "1e400",
    "1e-400",
    "1e5000",
    "1e100000",
    "1e99999999999",
    "100",
    "\"1/3\"",
    "\"-1/2\"",
    "\"1/0\"",
    "\" 1 \"",
    "\"nan\"",
    "\"\"",
    "\"f32\"",
    "\"f64\"",
    "\"exact\"",
    "\"mpfr:2\"",
    "\"mpfr:70\"",
    "\"lagrange\"",
    "\"penalty\"",
    "\"augmented\"",
    "null",
    "true",
    "false",
    "NaN",
    "-inf",
    "[]",
    "{}",
    "[1]",
    "\"\\u0000\"",
    "\"\\ud800\"",
    "01",
    "1.",
    "--1",
];

/// Returns a valid object, or one with other keys and values, possibly truncated.
fn any_line(random: &mut Rand64) -> Vec<u8> {
    let keys = [NUMBERS, OTHERS].concat();
    let pair = |random: &mut Rand64| format!("\"{}\":{}", pick(random, &keys), pick(random, &VALUES));
    let mut object = draw(random).1.to_string();
    for _ in 0..random.rand_range(0_u64..4).saturating_sub(2) {
        // Of two values for a key, the second is an error of its own.
        object.pop();
        object += &format!(",{}}}", pair(random));
    }
    if random.rand_range(0..4) == 0 {
        let pairs: Vec<_> = (0..random.rand_range(0..4)).map(|_| pair(random)).collect();
        object = format!("{{{}}}", pairs.join(","));
    }
    let mut line = object.into_bytes();
    for _ in 0..random.rand_range(0_u64..5).saturating_sub(3) {
        let place = random.rand_range(0..line.len() as u64) as usize;
        line[place] = random.rand_range(0..256) as u8;
    }
    if random.rand_range(0..8) == 0 {
        line.truncate(random.rand_range(0..line.len() as u64) as usize);
    }
    line.retain(|byte| !b"\r\n".contains(byte));
    line
}

/// `LINES=1000000 cargo test --release --test batch any_lines` tests this number of lines; `SEED=7` selects
/// others.
#[test]
fn any_lines_have_an_answer_each() {
    let (seed, count) = (asked("SEED", 1), asked("LINES", 1000));
    for batch in 0..count.div_ceil(1000) {
        let mut random = random(seed, batch);
        let lines: Vec<_> = (0..1000).map(|_| any_line(&mut random)).collect();
        let put: Vec<_> = lines.iter().filter(|line| !line.trim_ascii().is_empty()).collect();
        let output = raw("", lines.join(&b'\n'));
        // An id comes back whatever number it is, so not every answer is a `Value`.
        let answers = std::str::from_utf8(&output.stdout).expect("UTF-8").lines();
        let answers: Vec<HashMap<String, Box<RawValue>>> =
            answers.map(|line| serde_json::from_str(line).expect(line)).collect();
        assert_eq!((answers.len(), output.stderr.len()), (put.len(), 0));
        let mut refused = 0;
        for (line, answer) in put.iter().zip(&answers) {
            let line = String::from_utf8_lossy(line);
            match (answer.get("error").map(|error| error.get()), answer.contains_key("state")) {
                (Some(error), false) => {
                    let error: String = serde_json::from_str(error).expect(error);
                    let is_line = !error.contains(char::is_control) && (10..600).contains(&error.len());
                    assert!(is_line, "{line}: {error}");
                    refused += 1;
                }
                (None, true) => {}
                _ => panic!("{line}: {answer:?}"),
            }
        }
        // Otherwise one of the two would hardly have been tried.
        let share = refused as f64 / answers.len() as f64;
        assert!((0.2..0.8).contains(&share), "{refused} of {}", answers.len());
        assert_eq!(output.status.code(), Some(1));
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
    for arguments in ["--trace", "--format json", "--mass 0", "--batch"] {
        let output = raw(arguments, "{}\n");
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(
            (output.status.code(), output.stdout.as_slice(), stderr.lines().count()),
            (Some(2), b"".as_slice(), 1)
        );
        assert!(stderr.contains(arguments.split(' ').next().unwrap()), "{stderr}");
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
fn read_and_write_errors_are_reported() {
    use std::fs::File;
    let mut command = contact("--batch");
    let output = command.stdin(File::open("/").unwrap()).output().expect("the command runs");
    let stderr = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(
        (output.status.code(), output.stdout.as_slice(), stderr.lines().count()),
        (Some(2), b"".as_slice(), 1)
    );
    assert!(stderr.starts_with("error: cannot read stdin: "), "{stderr}");
    let mut command = contact("--batch");
    let full = File::options().write(true).open("/dev/full").expect("a device");
    let mut child = command.stdout(full).spawn().expect("the command runs");
    feed(child.stdin.take().expect("a pipe"), b"{}\n".to_vec());
    let output = finish(child);
    let stderr = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!((output.status.code(), stderr.lines().count()), (Some(2), 1), "{stderr}");
    assert!(stderr.starts_with("error: cannot write to stdout"), "{stderr}");
}

/// If nobody reads for a while, no further input is read; stored lines would be visible in memory.
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_number_of_lines() {
    use std::sync::atomic::{AtomicUsize, Ordering};
    static WRITTEN: AtomicUsize = AtomicUsize::new(0);
    const LINES: usize = 40_000;
    let mut child = spawn("");
    let peak = |child: &Child| -> usize {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).expect("a process");
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
        line.trim().trim_end_matches(" kB").parse::<usize>().expect("a number") * 1024
    };
    let mut stdin = child.stdin.take().expect("a pipe");
    let writer = thread::spawn(move || {
        let lines = format!("{{}}{}\n", " ".repeat(97)).repeat(100);
        for _ in 0..LINES / 100 {
            stdin.write_all(lines.as_bytes()).expect("it reads");
            WRITTEN.fetch_add(100, Ordering::Relaxed);
        }
        stdin
    });
    let mut written = 0;
    while written == 0 || WRITTEN.load(Ordering::Relaxed) > written {
        written = WRITTEN.load(Ordering::Relaxed);
        thread::sleep(Duration::from_secs(1));
    }
    let first = peak(&child);
    // 100 bytes each: a pipe has room for 2¹⁶, and so has the buffer behind it.
    assert!(written < LINES, "all is read, though nothing is taken");
    let mut stdout = BufReader::new(child.stdout.take().expect("a pipe"));
    let (mut line, mut bytes) = (String::new(), 0);
    // All but a few, which it need not have passed on yet.
    for _ in 0..LINES - 1000 {
        line.clear();
        bytes += stdout.read_line(&mut line).expect("an answer");
    }
    let last = peak(&child);
    assert!(last < first + bytes / 4, "{first}, then {last} for {bytes} bytes of answers");
    // The last lines are only read once there is room for the answers.
    thread::spawn(move || std::io::copy(&mut stdout, &mut std::io::sink()));
    drop(writer.join().expect("it writes"));
    assert!(finish(child).status.success());
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
