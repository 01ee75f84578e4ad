//! Programs with every kind of behaviour, as scripts.

mod alone;
mod seen;

use super::*;
use num_traits::One;
use rustix::process::{Pid, Signal, getpgid, getppid, kill_process, setpgid};
use spring_mass_contact::check::{Answer, Family};
use std::fs::{self, File};
use std::io::BufRead;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::process::Child;

/// More than any of these takes on a busy machine.
const LONG: Duration = Duration::from_secs(20);

/// Longer than any of these tests takes.
const DEADLINE: Duration = Duration::from_secs(90);

/// Too short for any answer.
const SHORT: Duration = Duration::from_millis(200);

/// Runs a test that could hang, and fails it after a time limit.
fn in_time(test: impl FnOnce() + Send + 'static) {
    let (running, ended) = mpsc::channel::<()>();
    let thread = thread::spawn(move || {
        let _running = running;
        test();
    });
    // The channel is closed when the test ends.
    if ended.recv_timeout(DEADLINE) == Err(RecvTimeoutError::Timeout) {
        panic!("still running after {DEADLINE:?}");
    }
    thread.join().unwrap_or_else(|panic| resume_unwind(panic));
}

/// A script that answers requests with its process number.
const ANSWER: &str = r#"
answer() {
    id=${line#*'"id": "'}
    echo "{\"id\": \"${id%%\"*}\", \"deflection\": 1, \"contact_force\": \"1/3\", \"status\": \"$$\"}"
}
"#;

const LOOP: &str = "while read -r line; do answer; done";

fn sh(script: &str, timeout: Duration) -> Program {
    Program::new(&["sh", "-c", &format!("{ANSWER}{script}"), "sh"].map(String::from), timeout)
}

fn problem(id: &str) -> Problem {
    let system = SpringMass { c: "1e9", m: "3", g: "-9.81", l: "2", h: "2.00000000001" };
    Problem { id: id.to_string(), family: Family::Contact, system: system.parse().unwrap(), penalty: None }
}

fn ask(program: &mut Program, id: &str) -> Reply {
    program.ask(&problem(id)).unwrap_or_else(|failure| panic!("{failure}"))
}

/// Returns the process number in a reply.
fn process(reply: &Reply) -> &str {
    match reply {
        Reply::Answered(answer) => answer.status.as_deref().expect("its number"),
        other => panic!("{other:?}"),
    }
}

fn crashed(reply: &Reply) -> &str {
    match reply {
        Reply::Crashed(how) => how,
        other => panic!("{other:?}"),
    }
}

fn garbled(reply: &Reply) -> &str {
    match reply {
        Reply::InvalidResponse(reason) => reason,
        other => panic!("{other:?}"),
    }
}

/// A named pipe, which ends with the last process that has it open.
struct Fifo(PathBuf);

impl Fifo {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("contact-check-{}-{name}", std::process::id()));
        let made = Command::new("mkfifo").arg(&path).status().expect("a command of every Unix");
        assert!(made.success());
        Fifo(path)
    }

    /// Returns the line of a script that opens the pipe.
    fn open(&self) -> String {
        open(&self.0)
    }

    /// Returns its lines.
    fn read(&self) -> Receiver<String> {
        let (path, (to, lines)) = (self.0.clone(), mpsc::channel());
        thread::spawn(move || {
            let lines = BufReader::new(File::open(path).expect("a pipe")).lines();
            lines.map_while(Result::ok).try_for_each(|line| to.send(line))
        });
        lines
    }
}

impl Drop for Fifo {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

fn open(path: &Path) -> String {
    format!("exec 9>'{}'; echo open >&9;", path.display())
}

/// Asserts that a process has opened the pipe, and that none is left.
fn nobody_is_left(lines: &Receiver<String>) {
    assert_eq!(lines.recv_timeout(LONG).as_deref(), Ok("open"));
    assert_eq!(lines.recv_timeout(LONG), Err(RecvTimeoutError::Disconnected));
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

#[test]
fn a_program_is_started_once_for_all_requests() {
    in_time(|| {
        let mut program = sh(LOOP, LONG);
        let replies = ["a", "b", "c"].map(|id| ask(&mut program, id));
        let first = process(&replies[0]);
        let answer = Answer {
            deflection: Some(Exact::one()),
            contact_force: Some("1/3".parse().unwrap()),
            status: Some(first.to_string()),
            ..Answer::default()
        };
        assert!(
            replies.iter().all(|reply| *reply == Reply::Answered(Box::new(answer.clone()))),
            "{replies:?}"
        );
    });
}

#[test]
fn the_environment_is_passed_on() {
    in_time(|| {
        let script = r#"read -r line; echo "{\"id\": \"a\", \"error\": \"$1 $PATH\"}""#;
        let command = ["sh", "-c", script, "sh", "$HOME *"].map(String::from);
        let reply = ask(&mut Program::new(&command, LONG), "a");
        assert_eq!(reply, Reply::Refused(words(&format!("$HOME * {}", std::env::var("PATH").unwrap()))));
    });
}

#[test]
fn lines_that_are_no_object_are_passed_over() {
    in_time(|| {
        let noise = r#"printf 'hello\n\n[1]\n{oops\n{"id": "a"\n\377\n7\n"id"\n{1}\n\r\nnull\n\0\n'"#;
        let mut program =
            sh(&format!("{noise}; while read -r line; do {noise}; answer; {noise}; done"), LONG);
        let replies = ["a", "b"].map(|id| ask(&mut program, id));
        assert_eq!(process(&replies[0]), process(&replies[1]));
    });
}

#[test]
fn a_wrong_or_missing_id_is_invalid_and_restarts_the_program() {
    in_time(|| {
        let answers = "\"deflection\": 1, \"contact_force\": 2";
        let mut program = sh(
            &format!(
                "read -r line; case $line in *'\"b\"'*) answer;; \
             *) echo '{{\"id\": \"z\", {answers}}}'; read -r line; answer;; esac"
            ),
            LONG,
        );
        assert_eq!(garbled(&ask(&mut program, "a")), "answer to 'z' instead of an answer to 'a'");
        process(&ask(&mut program, "b"));

        let mut program = sh(&format!("read -r line; echo '{{{answers}}}'; {LOOP}"), LONG);
        assert_eq!(garbled(&ask(&mut program, "a")), "answer without id instead of an answer to 'a'");
        assert_eq!(garbled(&ask(&mut program, "b")), "answer without id instead of an answer to 'b'");
    });
}

/// Earlier output cannot be the answer to a later request, whatever its id is.
#[test]
fn an_answer_before_its_question_is_garbled() {
    in_time(|| {
        let object = |id| format!(r#"{{"id": "{id}", "deflection": 1, "contact_force": 2}}\n"#);
        let both = format!("read -r line; printf '{}{}'; {LOOP}", object("a"), object("b"));
        let mut program = sh(&both, LONG);
        assert!(matches!(ask(&mut program, "a"), Reply::Answered(_)));
        assert_eq!(garbled(&ask(&mut program, "b")), "answer to 'b' before the request 'b'");
        assert_eq!(garbled(&ask(&mut program, "c")), "answer to 'a' instead of an answer to 'c'");

        let mut program =
            sh(&format!("read -r line; answer; yes '{}'", object("b").trim_end_matches("\\n")), LONG);
        process(&ask(&mut program, "a"));
        thread::sleep(5 * SHORT);
        assert_eq!(garbled(&ask(&mut program, "b")), "answer to 'b' before the request 'b'");
    });
}

#[test]
fn an_unreadable_reply_leaves_the_program_running() {
    in_time(|| {
        let bad = r#"echo '{"id": "a", "deflection": "twelve", "contact_force": 1}'"#;
        let refused = r#"echo "{\"id\": \"b\", \"error\": \"$$\"}""#;
        let mut program = sh(&format!("read -r line; {bad}; read -r line; {refused}; {LOOP}"), LONG);
        assert!(garbled(&ask(&mut program, "a")).starts_with("invalid value 'twelve' for 'deflection': "));
        let Reply::Refused(number) = ask(&mut program, "b") else { panic!("no refusal") };
        assert_eq!(process(&ask(&mut program, "c")), number);
    });
}

#[test]
fn an_end_is_a_crash_and_the_next_problem_starts_it_again() {
    in_time(|| {
        for (end, how) in [
            ("exit 3", "exit status 3"),
            ("exit 0", "exit status 0"),
            ("kill -9 $$", "signal: 9 (SIGKILL)"),
            ("echo one >&2; echo two >&2; echo >&2; exit 1", "exit status 1; on stderr: two"),
            ("printf 'no line' >&2; exit 1", "exit status 1; on stderr: no line"),
            (
                r"printf '\033[31mred\033[0m \342\200\256\r\n' >&2; exit 1",
                "exit status 1; on stderr: \u{fffd}[31mred\u{fffd}[0m \u{fffd}",
            ),
            (r"yes | head -n 100000 >&2; echo last >&2; exit 1", "exit status 1; on stderr: last"),
        ] {
            let script = format!("read -r line; case $line in *'\"a\"'*) {end};; *) answer; {LOOP};; esac");
            let mut program = sh(&script, LONG);
            assert_eq!(crashed(&ask(&mut program, "a")), how, "{end}");
            let [b, c] = ["b", "c"].map(|id| ask(&mut program, id));
            assert_eq!(process(&b), process(&c), "{end}");
        }
        let mut program = sh("head -c 100000 /dev/zero >&2; exit 1", LONG);
        let how = crashed(&ask(&mut program, "a")).to_string();
        assert!(how.chars().count() < 300 && how.ends_with('…'), "{how}");
    });
}

/// The line that arrived is an answer; the next reply is an end.
#[test]
fn an_answer_counts_though_the_program_ends_with_it() {
    in_time(|| {
        let mut program = sh("read -r line; answer; exit 5", LONG);
        let first = process(&ask(&mut program, "a")).to_string();
        assert_eq!(crashed(&ask(&mut program, "b")), "exit status 5");
        assert_ne!(process(&ask(&mut program, "c")), first);
        let mut program = sh(r#"read -r line; printf '%s' "$(answer)""#, LONG);
        process(&ask(&mut program, "a"));
    });
}

/// Its stdout ends first, or the program ends first while another process holds its stdout; neither is waited
/// for.
#[test]
fn the_end_of_a_program_is_detected_in_any_order_of_events() {
    in_time(|| {
        let ends = |fifo: &str, script: &str, before: &[&str]| {
            let fifo = Fifo::new(fifo);
            let lines = fifo.read();
            let mut program = sh(&format!("{} {script}", fifo.open()), LONG);
            for id in before {
                process(&ask(&mut program, id));
            }
            let how = crashed(&ask(&mut program, "z")).to_string();
            nobody_is_left(&lines);
            how
        };
        let closed = ends("closed", "exec >&-; echo why >&2; sleep 1000", &[]);
        assert_eq!(closed, "closed its stdout; on stderr: why");
        assert_eq!(ends("held", "sleep 1000 & echo why >&2; exit 3", &[]), "exit status 3; on stderr: why");
        assert_eq!(ends("left", "read -r line; answer; sleep 1000 & exit 3", &["a"]), "exit status 3");
    });
}

/// A process outside its group keeps its pipes longer than the time limits.
#[test]
fn a_stranger_that_holds_the_pipes_is_not_waited_for() {
    in_time(|| {
        let script =
            format!("exec '{}' {} --exact --ignored", own_path().display(), own_name("leaves_a_stranger"));
        let (mut program, start) = (sh(&script, LONG), Instant::now());
        let how = ask(&mut program, "a");
        assert!(crashed(&how).starts_with("exit status 3"), "{how:?}");
        assert!(start.elapsed() < STRANGER, "{:?}", start.elapsed());
    });
}

/// Lifetime of that process.
const STRANGER: Duration = Duration::from_secs(10);

#[test]
#[ignore = "run by another"]
fn leaves_a_stranger() {
    use std::os::unix::process::CommandExt;
    if std::env::args().any(|argument| argument == "--exact") {
        let mut sleep = Command::new("sleep");
        sleep.arg(STRANGER.as_secs().to_string()).process_group(0).spawn().expect("a command of every Unix");
        std::process::exit(3);
    }
}

/// It is ended though a signal to its former group does not reach it.
#[test]
fn a_program_that_leaves_its_group_is_ended() {
    in_time(|| {
        let fifo = Fifo::new("leaver");
        let lines = fifo.read();
        let (path, test) = (own_path(), own_name("leaves_its_group"));
        let script = format!("{} exec '{}' {test} --exact --ignored", fifo.open(), path.display());
        let mut program = sh(&script, SHORT);
        assert!(matches!(ask(&mut program, "a"), Reply::TimedOut(_)));
        nobody_is_left(&lines);
    });
}

#[test]
#[ignore = "run by another"]
fn leaves_its_group() {
    if std::env::args().any(|argument| argument == "--exact") {
        setpgid(None, Some(getpgid(getppid()).expect("a parent"))).expect("a group of the same session");
        thread::sleep(DEADLINE + LONG);
    }
}

/// Silence, an unread pipe and lines without end do not block the command.
#[test]
fn a_program_without_a_reply_is_abandoned_in_time() {
    in_time(|| {
        let scripts = [
            "sleep 1000",
            "cat >/dev/null; sleep 1000",
            "yes",
            "yes '{'",
            "cat /dev/zero",
            "yes >&2",
            "exec <&-; sleep 1000",
            "trap '' TERM INT HUP PIPE; for second in $(seq 1000); do sleep 1; done",
        ];
        thread::scope(|scope| {
            for (k, script) in scripts.into_iter().enumerate() {
                scope.spawn(move || {
                    let (fifo, start) = (Fifo::new(&format!("hang-{k}")), Instant::now());
                    let lines = fifo.read();
                    // More than a pipe holds.
                    let id = "x".repeat(1 << 20);
                    let mut program = sh(&format!("{} {script}", fifo.open()), SHORT);
                    assert!(matches!(ask(&mut program, &id), Reply::TimedOut(_)), "{script}");
                    assert!((SHORT..LONG).contains(&start.elapsed()), "{script}: {:?}", start.elapsed());
                    nobody_is_left(&lines);
                });
            }
        });
    });
}

#[test]
fn a_hang_does_not_outlive_its_question() {
    in_time(|| {
        let script = format!("read -r line; case $line in *'\"a\"'*) sleep 1000;; *) answer; {LOOP};; esac");
        let mut program = sh(&script, Duration::from_secs(1));
        assert!(matches!(ask(&mut program, "a"), Reply::TimedOut(_)));
        // Starting a program takes longer on a busy machine.
        program.timeout = LONG;
        let [b, c] = ["b", "c"].map(|id| ask(&mut program, id));
        assert_eq!(process(&b), process(&c));
    });
}

/// Its output on stderr, and on stdout after its stdin is closed, is still read.
#[test]
fn a_program_ends_by_itself_after_the_last_request() {
    in_time(|| {
        let fifo = Fifo::new("end");
        let lines = fifo.read();
        let much = "yes | head -n 500000";
        let script = format!(
            "{} while read -r line; do {much} >&2; answer; done; {much}; {much} >&2; sleep 0.1; \
             echo ended >&9",
            fifo.open()
        );
        let mut program = sh(&script, LONG);
        // The test concerns the time left to it, and not its length.
        program.grace = LONG;
        let [a, b] = ["a", "b"].map(|id| ask(&mut program, id));
        assert_eq!(process(&a), process(&b));
        drop(program);
        assert_eq!(lines.recv_timeout(LONG).as_deref(), Ok("open"));
        assert_eq!(lines.recv_timeout(LONG).as_deref(), Ok("ended"));
        assert_eq!(lines.recv_timeout(LONG), Err(RecvTimeoutError::Disconnected));
    });
}

#[test]
fn no_process_remains_of_a_program_that_does_not_end_by_itself() {
    in_time(|| {
        for (name, script) in [
            ("stays", format!("{LOOP}; sleep 1000")),
            ("leaves", format!("sleep 1000 & {LOOP}")),
            ("floods", format!("{LOOP}; yes")),
            ("astray", "read -r line; answer; echo '{}'; sleep 1000".to_string()),
        ] {
            let fifo = Fifo::new(name);
            let lines = fifo.read();
            let mut program = sh(&format!("{} {script}", fifo.open()), LONG);
            process(&ask(&mut program, "a"));
            let start = Instant::now();
            if name == "astray" {
                garbled(&ask(&mut program, "b"));
            }
            drop(program);
            assert!(start.elapsed() < LONG, "{name}");
            nobody_is_left(&lines);
        }
    });
}

fn own_path() -> PathBuf {
    std::env::current_exe().expect("a path")
}

fn own_name(test: &str) -> String {
    format!("{}::{test}", module_path!().split_once("::").expect("a crate").1)
}
