//! Programs with every kind of behaviour, as scripts. What remains of them is tested with the command.

use super::*;
use spring_mass_contact::check::Family;

/// More than any of these takes on a busy machine.
const LONG: Duration = Duration::from_secs(20);

/// Too short for any answer.
const SHORT: Duration = Duration::from_millis(200);

/// A script that answers requests with its process number.
const ANSWER: &str = r#"
answer() {
    id=${line#*'"id": "'}
    echo "{\"id\": \"${id%%\"*}\", \"deflection\": 1, \"contact_force\": \"1/3\", \"status\": \"$$\"}"
}
"#;

const LOOP: &str = "while read -r line; do answer; done";

/// Returns a program that answers with a script whenever it is started.
fn sh(script: &str, timeout: Duration) -> Program {
    let answered = script.replace("LOOP", LOOP);
    Program::new(&["sh", "-c", &format!("{ANSWER}{answered}"), "$HOME *"].map(String::from), timeout)
}

fn problem(id: &str) -> Problem {
    let system = SpringMass { c: "1e9", m: "3", g: "-9.81", l: "2", h: "2.00000000001" };
    Problem { id: id.to_string(), family: Family::Contact, system: system.parse().unwrap(), penalty: None }
}

/// Describes a reply, and an answer by the number of the process among those that have answered.
fn ask(program: &mut Program, processes: &mut Vec<String>, id: &str) -> String {
    match program.ask(&problem(id)).unwrap_or_else(|failure| panic!("{failure}")) {
        Reply::Answered(answer) => {
            let process = answer.status.unwrap_or_default();
            if !processes.contains(&process) {
                processes.push(process.clone());
            }
            let place = processes.iter().position(|other| *other == process);
            format!("process {}", place.unwrap() + 1)
        }
        Reply::Refused(reason) => format!("refused: {reason}"),
        Reply::InvalidResponse(reason) => reason,
        Reply::Crashed(how) => format!("crashed: {how}"),
        Reply::TimedOut(seen) => format!("late: {seen}"),
    }
}

/// Returns the descriptions of the replies to requests a, b, c, …, as many as are expected.
fn replies(program: &mut Program, count: usize) -> Vec<String> {
    let mut processes = Vec::new();
    ["a", "b", "c"][..count].iter().map(|id| ask(program, &mut processes, id)).collect()
}

#[test]
fn a_request_is_a_line_of_decimals() {
    let mut asked = problem("a \"b\"\n");
    let start =
        r#"{"id": "a \"b\"\n", "stiffness": 1e9, "mass": 3, "gravity": -9.81, "free_length": 2, "height": "#;
    assert_eq!(request(&asked), format!("{start}2.00000000001}}\n"));
    asked.penalty = Some("1/3".parse().unwrap());
    assert_eq!(request(&asked), format!("{start}2.00000000001, \"penalty\": \"1/3\"}}\n"));
    asked.system = asked.system.map(|_| "-1.23456789012e-14".parse().unwrap());
    let object: serde_json::Value = serde_json::from_str(&request(&asked)).unwrap();
    let keys = ["stiffness", "mass", "gravity", "free_length", "height"];
    assert!(keys.iter().all(|key| object[key].is_number()), "{object}");
}

/// Output that precedes a request is no answer to it, whatever its id is; what is no object is passed over. A program
/// is started once for all requests, and again after a wrong id or its end.
#[test]
fn each_behaviour_has_its_reply() {
    let noise = r#"printf 'hello\n\n[1]\n{oops\n{"id": "a"\n\377\n7\n"id"\n{1}\n\r\nnull\n\0\n'"#;
    let object = |id: &str| format!(r#"{{{id}"deflection": 1, "contact_force": 2}}"#);
    let [a, b, z] = ["a", "b", "z"].map(|id| object(&format!(r#""id": "{id}", "#)));
    let no_id = object("");
    let bad = r#"echo '{"id": "a", "deflection": 1}'"#;
    let refused = r#"echo '{"id": "b", "error": "no"}'"#;
    let long =
        r#"printf '{"id": "a", "x": "'; head -c 16777216 /dev/zero | tr '\0' x; printf '"}\n'; sleep 60"#;
    let environment = r#"echo "{\"id\": \"a\", \"error\": \"$0 $PATH\"}""#;
    let path = format!("refused: {}", words(&format!("$HOME * {}", std::env::var("PATH").unwrap())));
    let table: [(String, &[&str]); 10] = [
        ("LOOP".into(), &["process 1", "process 1", "process 1"]),
        (
            format!("{noise}; while read -r line; do {noise}; answer; {noise}; done"),
            &["process 1", "process 1"],
        ),
        (
            format!(
                "read -r line; case $line in *'\"b\"'*) answer;; *) echo '{z}'; read -r line; answer;; esac"
            ),
            &["answer to 'z' instead of an answer to 'a'", "process 1"],
        ),
        (
            format!("read -r line; echo '{no_id}'; LOOP"),
            &[
                "answer without id instead of an answer to 'a'",
                "answer without id instead of an answer to 'b'",
            ],
        ),
        (
            format!("read -r line; printf '{a}\\n{b}\\n'; LOOP"),
            &[
                "process 1",
                "answer to 'b' before the request 'b'",
                "answer to 'a' instead of an answer to 'c'",
            ],
        ),
        (
            // The same process refuses and answers.
            format!("read -r line; {bad}; read -r line; {refused}; LOOP"),
            &["the key 'contact_force' is missing", "refused: no", "process 1"],
        ),
        ("read -r line; answer; exit 5".into(), &["process 1", "crashed: exit status 5", "process 2"]),
        (r#"read -r line; printf '%s' "$(answer)""#.into(), &["process 1"]),
        (format!("read -r line; {long}"), &["a line must have no more than 16777216 bytes"]),
        (format!("read -r line; {environment}"), &[&path]),
    ];
    for (script, expected) in table {
        assert_eq!(replies(&mut sh(&script, LONG), expected.len()), expected, "{script}");
    }
}

#[test]
fn an_end_is_a_crash_and_the_next_problem_starts_it_again() {
    for (end, how) in [
        ("exit 3", "exit status 3"),
        ("exit 0", "exit status 0"),
        ("kill -9 $$", "signal: 9 (SIGKILL)"),
        ("exec >&-; echo why >&2; sleep 60", "closed its stdout; on stderr: why"),
        ("sleep 60 & echo why >&2; exit 3", "exit status 3; on stderr: why"),
        ("echo one >&2; echo two >&2; echo >&2; exit 1", "exit status 1; on stderr: two"),
        ("printf 'no line' >&2; exit 1", "exit status 1; on stderr: no line"),
        (
            r"printf '\033[31mred\033[0m \342\200\256\r\n' >&2; exit 1",
            "exit status 1; on stderr: \u{fffd}[31mred\u{fffd}[0m \u{fffd}",
        ),
        (r"yes | head -n 100000 >&2; echo last >&2; exit 1", "exit status 1; on stderr: last"),
    ] {
        let script = format!("read -r line; case $line in *'\"a\"'*) {end};; *) answer; LOOP;; esac");
        let expected = [format!("crashed: {how}"), "process 1".into(), "process 1".into()];
        assert_eq!(replies(&mut sh(&script, LONG), 3), expected, "{end}");
    }
    let how = replies(&mut sh("head -c 100000 /dev/zero >&2; exit 1", LONG), 1).remove(0);
    assert!(how.chars().count() < 300 && how.ends_with('…'), "{how}");
}

/// Python's single quotes, and a missing flush: frequent first mistakes. The next request starts the program again.
#[test]
fn a_timeout_reports_the_last_output() {
    for (script, seen) in [
        ("echo hello; echo \"{'id': 'a'}\"", "not a JSON object: {'id': 'a'}"),
        (":", "nothing on stdout; it may not flush its output"),
        ("printf '{\"id\": \"a\"}'", "without a line break: {\"id\": \"a\"}"),
        ("echo one; echo", "not a JSON object: one"),
        ("echo one; printf 'two three'", "without a line break: two three"),
        ("printf o; sleep 0.1; printf 'ne\\n'", "not a JSON object: one"),
        ("printf on; sleep 0.1; printf 'e two'", "without a line break: one two"),
    ] {
        let script = format!("read -r line; case $line in *'\"a\"'*) {script}; sleep 60;; *) answer;; esac");
        let own = |timeout| {
            let mut program = sh(&script, timeout);
            let late = replies(&mut program, 1).remove(0);
            // Starting a program takes longer on a busy machine.
            program.timeout = LONG;
            assert_eq!(ask(&mut program, &mut Vec::new(), "b"), "process 1", "{script}");
            late
        };
        // On a busy machine it may not print anything in time.
        let soon = own(SHORT);
        let own = if soon.ends_with(seen) { soon } else { own(LONG / 4) };
        assert!(own.starts_with("late: ") && own.ends_with(seen), "{own}");
    }
}

/// Its output on stderr, and on stdout after its stdin is closed, is still read.
#[test]
fn a_program_ends_by_itself_after_the_last_request() {
    let ended = file("ended", "");
    let much = "yes | head -n 500000";
    let answers = format!("while read -r line; do {much} >&2; answer; done");
    let mut program = sh(&format!("{answers}; {much}; {much} >&2; sleep 0.1; rm '{ended}'"), LONG);
    // The test concerns the time left to it, and not its length.
    program.grace = LONG;
    assert_eq!(replies(&mut program, 2), ["process 1"; 2]);
    drop(program);
    assert!(!std::fs::exists(ended).unwrap());
}

/// Returns the path of an executable file with this text. It is written by another process, because a file
/// that any process has open for writing, even between fork and exec, cannot be executed.
fn file(name: &str, text: &str) -> String {
    let path = std::env::temp_dir().join(format!("contact-{name}-{}", std::process::id()));
    let write = r#"printf '%s' "$1" >"$0" && chmod 700 "$0""#;
    let written = Command::new("sh").args(["-c", write]).arg(&path).arg(text).status();
    assert!(written.expect("a shell").success());
    path.display().to_string()
}

/// A program that disappears is not an invalid argument.
#[test]
fn a_program_that_cannot_be_started_is_bad_input() {
    let without_format = file("unknown", "neither a script nor a binary");
    let path = "must be the name of a program on the PATH, or its path";
    let executable = "must be an executable program; a script begins with #!";
    for (name, must) in [("/no such/program", path), ("/", executable), (&without_format, executable)] {
        let asked = Program::new(&[name, "x"].map(String::from), LONG).ask(&problem("a"));
        let Err(Failure::Input(line)) = asked else { panic!("{name}") };
        let start = format!("invalid value '{}' for '<PROGRAM>...': cannot be started: ", shortened(name));
        assert!(line.starts_with(&start) && line.ends_with(must), "{line}");
    }
    std::fs::remove_file(without_format).unwrap();
    let gone = file("gone", "#!/bin/sh\nread -r line; rm -f \"$0\"; echo '{\"id\": \"z\"}'\n");
    let replies = replies(&mut Program::new(&[gone], LONG), 2);
    assert_eq!(replies[0], "answer to 'z' instead of an answer to 'a'");
    assert!(replies[1].starts_with("crashed: cannot be started again: "), "{replies:?}");
}

/// Of a line that is too long a byte more than allowed is kept, whether it arrives in two blocks or in three.
#[test]
fn the_rest_of_a_long_line_is_dropped() {
    let block = vec![b'x'; reply::MAX_LINE_BYTES];
    for blocks in [2, 3] {
        let mut lines = Lines::of(std::sync::mpsc::channel().1);
        (0..blocks).for_each(|_| lines.add(&block));
        assert_eq!(lines.unfinished.len(), reply::MAX_LINE_BYTES + 1);
    }
}
