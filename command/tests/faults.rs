//! The command where the system says no: full disks, closed pipes, files in the place of folders. Each is said in one
//! line, with the status that the README names; nothing panics, and no part of a file is left.

use crate::processes::{Scratch, captured, command, finish, run};
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;

/// Every subcommand, and every way to print.
const LINES: [&str; 14] = [
    "verify 1.1 --cases 1",
    "prove 1.2 --format json",
    "solve",
    "solve --format json",
    "solve --method augmented --trace --format csv",
    "advise --tolerance 1e-9",
    "sweep --penalty 1..1e9",
    "cases --format json",
    "check --cases 1 --family contact -- true",
    "equations",
    "completions bash",
    "help",
    "solve --help",
    "--version",
];

fn words(line: &str) -> Command {
    let mut command = command();
    command.args(line.split(' ')).env("NO_COLOR", "1");
    command
}

/// Asserts status 2, and one line on stderr with this beginning.
fn refused(output: &Output, begins: &str, what: &str) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), stderr.lines().count()), (Some(2), 1), "{what}: {stderr}");
    assert!(stderr.starts_with(&format!("error: {begins}")), "{what}: {stderr}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported() {
    for line in LINES {
        let full = File::options().write(true).open("/dev/full").expect("a device");
        let output = run(words(line).stdout(full).stderr(Stdio::piped()));
        refused(&output, "cannot write to stdout: ", line);
    }
}

/// If writing to stderr fails, the status still reports the error.
#[cfg(target_os = "linux")]
#[test]
fn a_status_does_not_need_stderr() {
    let full = || File::options().write(true).open("/dev/full").expect("a device");
    for (line, status) in [("solve --mass 0", 2), ("solve", 0), ("no-such", 2)] {
        let output = run(words(line).stdout(Stdio::piped()).stderr(full()));
        assert_eq!(output.status.code(), Some(status), "{line}");
    }
    assert_eq!(run(words("solve").stdout(full()).stderr(full())).status.code(), Some(2));
}

/// A reader that closes the pipe after a line, as in `contact … | head -1`, causes no error.
#[test]
fn a_pipe_that_closes_after_a_line_is_no_error() {
    let long = ["table", "csv", "json"].map(|format| {
        format!("solve --method augmented --penalty 1e-3 --max-augmentations 10000 --trace --format {format}")
    });
    for line in LINES.into_iter().chain(long.iter().map(String::as_str)) {
        let mut child = words(line).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs");
        let mut stdout = BufReader::with_capacity(1, child.stdout.take().expect("a pipe"));
        // Elsewhere, since nobody knows if there will be a line.
        let first = thread::spawn(move || {
            let mut line = Vec::new();
            stdout.read_until(b'\n', &mut line).map(|_| line)
        });
        let output = finish(child);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(stderr, "", "{line}");
        // 1 where what was asked is amiss, and was printed before the pipe was closed.
        assert!(matches!(output.status.code(), Some(0 | 1)), "{line}: {:?}", output.status);
        assert!(first.join().expect("no panic").is_ok_and(|first| first.ends_with(b"\n")), "{line}");
    }
}

/// Streams that are closed when a program starts are opened as empty ones: Rust replaces them by /dev/null
/// before `main` begins, which is indistinguishable from the /dev/null of other programs (Python's
/// subprocess.DEVNULL).
#[test]
fn closed_streams_are_empty() {
    for (redirections, line, status) in [
        ("<&-", "solve --batch", 0),
        ("<&-", "check --cases 1 --family contact -- cat", 1),
        (">&-", "solve", 0),
        ("2>&-", "solve --mass 0", 2),
        ("<&- >&- 2>&-", "solve", 0),
    ] {
        let contact = env!("CARGO_BIN_EXE_contact");
        let output = captured(Command::new("sh").args(["-c", &format!("'{contact}' {line} {redirections}")]));
        assert_eq!((output.status.code(), output.stderr.len()), (Some(status), 0), "{line} {redirections}");
    }
}

fn folder(name: &str) -> Scratch {
    Scratch::new(&format!("faults {name}"))
}

/// Returns the names of the entries of a directory.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn prove(directory: &Path) -> Output {
    captured(command().args(["prove", "--coq"]).arg(directory))
}

/// Beginning of the message, if the name of the directory is short enough to be printed.
const REFUSED: &str = "invalid value '";

#[test]
fn a_path_that_is_not_a_directory_is_rejected() {
    let own = folder("no folder");
    let file = own.join("file");
    fs::write(&file, "kept").expect("a file");
    for place in [&file, &file.join("below"), Path::new("/dev/null/below"), Path::new("/proc/contact")] {
        let output = prove(place);
        refused(&output, REFUSED, &place.display().to_string());
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(stderr.contains("' for '--coq <DIR>': must be a writable directory: "), "{stderr}");
        assert_eq!(output.stdout, b"", "{}", place.display());
    }
    assert_eq!((names(&own), fs::read(&file).expect("a file")), (vec!["file".to_string()], b"kept".to_vec()));
}

/// A directory has the name of the last file: the others are whole, and no part of a file remains.
#[test]
fn a_folder_in_the_place_of_a_file_is_refused() {
    let own = folder("in the place of a file");
    let last = "E_Assumptions.v";
    fs::create_dir(own.join(last)).expect("a folder");
    refused(&prove(&own), REFUSED, last);
    let files = names(&own);
    assert!(files.len() > 5 && files.iter().all(|name| name.ends_with(".v")), "{files:?}");
}

/// A limit of the file size has the effect of a full disk: previous files are unchanged.
#[test]
fn a_limit_of_size_leaves_no_part_of_a_file() {
    let own = folder("limit");
    fs::write(own.join("Contact_01.v"), "kept").expect("a file");
    let (contact, place) = (env!("CARGO_BIN_EXE_contact"), own.display());
    // Where the signal is not ignored it ends whoever writes, with no time to tidy up.
    let script = format!("trap '' XFSZ; ulimit -f 8; exec '{contact}' prove --coq '{place}'");
    refused(&captured(Command::new("sh").args(["-c", &script])), REFUSED, "a limit");
    assert_eq!(
        (names(&own), fs::read(own.join("Contact_01.v")).unwrap()),
        (vec!["Contact_01.v".to_string()], b"kept".to_vec())
    );
}
