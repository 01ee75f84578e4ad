//! External programs in other languages, checked against exact solutions.

use crate::processes::{captured, command, root};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn contact(arguments: &[&str]) -> Output {
    captured(command().args(arguments))
}

fn report(program: &[&str]) -> (Option<i32>, Value) {
    let output = contact(&[&["check", "--format", "json", "--"], program].concat());
    let report = serde_json::from_slice(&output.stdout);
    (output.status.code(), report.unwrap_or_else(|error| panic!("{program:?}: {error}; {output:?}")))
}

/// Returns the path of a file in the project.
fn source(path: &str) -> PathBuf {
    root().join(path)
}

/// Compiles a program in the directory of the tests.
fn compiled(compiler: &str, path: &str) -> String {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(Path::new(path).file_stem().unwrap());
    // Another run may do the same at this moment: each puts a whole one in its place.
    let own = program.with_extension(std::process::id().to_string());
    let done = Command::new(compiler).arg(source(path)).arg("-o").arg(&own).output().unwrap();
    assert!(done.status.success(), "{compiler}: {}", String::from_utf8_lossy(&done.stderr));
    std::fs::rename(own, &program).unwrap();
    program.to_str().unwrap().to_string()
}

/// Returns the only diagnosed mistake, as its name and the last line of its program.
fn diagnosed(report: &Value) -> [&str; 2] {
    let found = report["diagnosis"].as_array().unwrap();
    assert_eq!(found.len(), 1, "{report:#}");
    let last = found[0]["program"].as_array().unwrap().last();
    [found[0]["name"].as_str().unwrap(), last.and_then(Value::as_str).unwrap_or_default()]
}

pub fn has_python() -> bool {
    let has = Command::new("python3").arg("--version").output().is_ok();
    if !has {
        eprintln!("no python3: nothing in Python is tried");
    }
    has
}

#[test]
fn a_bilateral_program_in_python_is_diagnosed() {
    if !has_python() {
        return;
    }
    let (status, report) =
        report(&["python3", source("command/tests/adapters/bilateral.py").to_str().unwrap()]);
    assert_eq!(status, Some(1));
    assert_eq!(diagnosed(&report), ["the plane always acts", "u = gap, N = R"]);
}

#[test]
fn a_penalty_program_in_c_is_diagnosed() {
    let (status, report) = report(&[&compiled("cc", "command/tests/adapters/penalty.c")]);
    assert_eq!(status, Some(1));
    assert_eq!(diagnosed(&report)[0], "it is the penalty method, with ε = 1e7 N/m");
}

#[test]
fn the_adapter_to_start_from_is_right() {
    if !has_python() {
        return;
    }
    let (status, report) = report(&["python3", source("examples/adapter.py").to_str().unwrap()]);
    assert_eq!((status, &report["summary"]["right"]), (Some(0), &report["cases"]), "{report:#}");
}

/// The command implements the protocol itself, in every number system.
#[test]
fn the_command_can_be_checked_by_itself() {
    for (scalar, diagnosis) in [
        ("--scalar=f64", None),
        ("--scalar=exact", None),
        ("--scalar=mpfr:53", None),
        ("--scalar=f32", Some("it computes in single precision")),
    ] {
        let (status, report) = report(&[env!("CARGO_BIN_EXE_contact"), "solve", "--batch", scalar]);
        let is_right = report["summary"]["right"] == report["cases"];
        assert_eq!(
            (status, is_right),
            (Some(i32::from(diagnosis.is_some())), diagnosis.is_none()),
            "{scalar}"
        );
        if let Some(name) = diagnosis {
            assert_eq!(diagnosed(&report)[0], name);
            for row in report["families"].as_array().unwrap() {
                assert_eq!(row["counterexample"].is_null(), row["verdict"] != "wrong", "{row:#}");
                let answer = &row["counterexample"]["answer"];
                let has_answer = answer["deflection"].is_string() && answer["contact_force"].is_string();
                assert_eq!(has_answer, row["verdict"] == "wrong", "{row:#}");
            }
        }
    }
}

/// The cases of `cases` have the solutions of `solve` and are those of `check`.
#[test]
fn cases_are_solved_by_their_answers() {
    let output = contact(&["cases", "--format", "json"]);
    let cases: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    let csv = contact(&["cases"]);
    let csv = String::from_utf8(csv.stdout).unwrap();
    assert_eq!(csv.lines().count(), cases.len() + 1);
    let keys: Vec<_> = csv.lines().next().unwrap().split(',').collect();
    for (case, row) in cases.iter().zip(csv.lines().skip(1)) {
        let of = |key: &&str| case[*key].as_str().unwrap();
        assert_eq!(keys.iter().map(of).collect::<Vec<_>>(), row.split(',').collect::<Vec<_>>());
        let options = ["stiffness", "mass", "gravity", "free_length", "height"];
        let options = options.map(|key| format!("--{}={}", key.replace('_', "-"), of(&key)));
        let solved = captured(command().args(["solve", "--scalar=exact", "--format=json"]).args(options));
        let solved: Value = serde_json::from_slice(&solved.stdout).unwrap();
        for key in ["deflection", "penetration", "contact_force"] {
            assert_eq!(solved[key], case[key], "{case}");
        }
    }
}

/// A lack of file descriptors is not a fault of the program.
#[test]
fn errors_of_the_operating_system_are_not_attributed_to_the_program() {
    let limited = "ulimit -n 6; exec \"$@\"";
    let mut sh = Command::new("sh");
    sh.args(["-c", limited, "sh", env!("CARGO_BIN_EXE_contact"), "check", "--", "true"]);
    let Output { status, stdout, stderr } = captured(&mut sh);
    let line = String::from_utf8(stderr).unwrap();
    assert_eq!((status.code(), stdout.len(), line.lines().count()), (Some(2), 0, 1), "{line}");
    assert!(line.contains("Too many open files") && !line.contains("#!"), "{line}");
}

/// Returns the 64-bit FNV-1a hash, as in `examples/solvers/run`.
fn fingerprint(bytes: &[u8]) -> String {
    let hash = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, hash))
}

/// The table of solvers in the book refers to the current systems.
#[test]
fn the_table_of_solvers_is_of_these_systems() {
    let page = std::fs::read_to_string(source("book/src/solvers.md")).unwrap();
    let (_, head) = page.split_once("| program |").unwrap();
    let families = head.lines().next().unwrap().split('|').map(str::trim).filter(|name| !name.is_empty());
    let families: Vec<_> = families.flat_map(|family| ["--family", family]).collect();
    let now = fingerprint(&contact(&[&["cases"], &families[..]].concat()).stdout);
    let of_table = page.split("Systems `").nth(1).and_then(|rest| rest.split('`').next());
    assert_eq!(
        of_table,
        Some(&*now),
        "book/src/solvers.md: the systems of `contact cases` are no longer those of the table. Run \
         examples/solvers/run --brief TABLE, put its tables and its last line into the page, and read whether what the \
         page says of each solver still holds; without the solvers at hand, draw the systems as before"
    );
}

/// The script that writes the table identifies the systems by the same hash.
#[test]
fn the_run_of_solvers_writes_the_same_fingerprint() {
    if !has_python() {
        return;
    }
    let script = "import runpy, sys; print(runpy.run_path(sys.argv[1])['fingerprint']('foobar'))";
    let run = source("examples/solvers/run");
    let output = captured(Command::new("python3").args(["-c", script]).arg(run));
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), fingerprint(b"foobar"), "{output:?}");
}
