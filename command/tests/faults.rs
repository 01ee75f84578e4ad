//! The command where the system says no: full disks, closed pipes, files in the place of folders. Each is said in one
//! line, with the status that the README names; nothing panics, and no part of a file is left.

use crate::processes::{Scratch, captured, command, finish, run};
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;

/// Every subcommand, and every way in which it prints.
const LINES: [&str; 24] = [
    "verify 1.1 --cases 1",
    "verify 1.1 --cases 1 --format json",
    "prove 1.2",
    "prove 1.2 --format json",
    "solve",
    "solve --format json",
    "solve --format csv",
    "solve --method augmented --trace",
    "solve --method augmented --trace --format csv",
    "advise --tolerance 1e-9",
    "advise --tolerance 1e-9 --format json",
    "sweep --penalty 1..1e9",
    "sweep --penalty 1..1e9 --format json",
    "sweep --penalty 1..1e9 --format csv",
    "cases",
    "cases --format json",
    "check --cases 1 --family contact -- true",
    "check --cases 1 --family contact --format json -- true",
    "check --cases 1 --family contact --format markdown -- true",
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

/// The list above contains all subcommands.
#[test]
fn no_subcommand_is_left_out() {
    let help = captured(&mut words("help"));
    let help = String::from_utf8(help.stdout).expect("UTF-8");
    let (_, list) = help.split_once("Commands:\n").expect("a list");
    let names = list.lines().map_while(|line| line.strip_prefix("  ")?.split(' ').next());
    let names: Vec<_> = names.filter(|name| !name.is_empty()).collect();
    assert!(names.len() > 9, "{names:?}");
    for name in names {
        assert!(LINES.iter().any(|line| line.split(' ').next() == Some(name)), "{name}");
    }
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

/// A directory has the name of the last file: no part of any file remains.
#[test]
fn a_folder_in_the_place_of_a_file_is_refused() {
    let own = folder("in the place of a file");
    assert_eq!(prove(&own).status.code(), Some(0));
    let files = names(&own);
    let last = files.last().expect("files");
    assert!(files.len() > 5 && files.iter().all(|name| name.ends_with(".v")), "{files:?}");
    fs::remove_file(own.join(last)).and_then(|()| fs::create_dir(own.join(last))).expect("a folder");
    refused(&prove(&own), REFUSED, last);
    assert_eq!(names(&own), files);
}

/// On a disk that becomes full, previous files are unchanged.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "requires user namespaces"]
fn a_disk_that_fills_leaves_no_part_of_a_file() {
    let own = folder("small");
    let (contact, place) = (env!("CARGO_BIN_EXE_contact"), own.display());
    let script = format!(
        "mount -t tmpfs -o size=128k small '{place}' || exit 77
         echo kept > '{place}'/Contact_01.v
         '{contact}' prove --coq '{place}'; status=$?
         ls '{place}'; cat '{place}'/*; exit $status"
    );
    let output = captured(Command::new("unshare").args(["--map-root-user", "--mount", "sh", "-c", &script]));
    refused(&output, REFUSED, "a small disk");
    assert!(String::from_utf8_lossy(&output.stderr).contains("No space left on device"));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "Contact_01.v\nkept\n");
}

/// A limit of the file size has the same effect and needs no privileges.
#[test]
fn a_limit_of_size_leaves_no_part_of_a_file() {
    let own = folder("limit");
    let (contact, place) = (env!("CARGO_BIN_EXE_contact"), own.display());
    // Where the signal is not ignored it ends whoever writes, with no time to tidy up.
    let script = format!("trap '' XFSZ; ulimit -f 8; exec '{contact}' prove --coq '{place}'");
    refused(&captured(Command::new("sh").args(["-c", &script])), REFUSED, "a limit");
    assert_eq!(names(&own), [""; 0]);
}
