//! What remains of programs that `contact check` starts: nothing, whatever they do, and no memory is lost to them.

use crate::check::has_python;
use crate::processes::{captured, finish};
use rustix::process::{Pid, Signal, kill_process};
use std::io::Read;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Lifetime of what would remain.
const SLEEP: Duration = Duration::from_secs(30);

/// A script that answers the only request, and those after it.
const LOOP: &str =
    r#"while read -r line; do echo '{"id": "contact-1", "deflection": 1, "contact_force": 2}'; done"#;

/// Returns the command with a script as the program, whose file descriptor 9 is stdout.
fn checking(script: &str, timeout: &str) -> Command {
    let mut sh = Command::new("sh");
    sh.args(["-c", "exec \"$@\" 9>&1 >/dev/null", "sh", env!("CARGO_BIN_EXE_contact"), "check", "--timeout"]);
    let script = script.replace("LOOP", LOOP).replace("SLEEP", &format!("sleep {}", SLEEP.as_secs()));
    sh.args([timeout, "--cases", "1", "--family", "contact", "--", "sh", "-c", &script]);
    sh.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    sh
}

/// A process that remains has stdout open. Silence, an unread pipe and lines without end do not block the command.
#[test]
fn no_process_remains_of_a_program() {
    let in_python = "import os, time; os.setpgid(0, os.getpgid(os.getppid())); time.sleep(30)";
    let leaver = format!("exec python3 -c '{in_python}'");
    let mut scripts = vec![
        ("SLEEP", "0.2"),
        ("cat >/dev/null; SLEEP", "0.2"),
        ("yes", "0.2"),
        ("yes '{'", "0.2"),
        ("cat /dev/zero", "0.2"),
        ("yes >&2", "0.2"),
        ("exec <&-; SLEEP", "0.2"),
        ("trap '' TERM INT HUP PIPE; for second in $(seq 30); do sleep 1; done", "0.2"),
        // It ends, or its stdout does, while another process holds its stdout.
        ("exec >&-; SLEEP", "20"),
        ("SLEEP & exit 3", "20"),
        // It does not end by itself.
        ("LOOP; SLEEP", "20"),
        ("SLEEP & LOOP", "20"),
        ("LOOP; yes", "20"),
        ("read -r line; echo '{}'; SLEEP", "20"),
    ];
    if has_python() {
        // A signal to its former group does not reach it.
        scripts.push((&leaver, "1"));
    }
    thread::scope(|scope| {
        for (script, timeout) in scripts {
            scope.spawn(move || {
                let start = Instant::now();
                let output = captured(&mut checking(&format!("echo open >&9; {script}"), timeout));
                assert_eq!(output.status.code(), Some(1), "{script}: {output:?}");
                assert!(output.stdout.starts_with(b"open\n"), "{script}: {output:?}");
                assert!(start.elapsed() < SLEEP, "{script}: {:?}", start.elapsed());
            });
        }
    });
}

/// A process outside its group keeps its pipes longer than the time limits.
#[test]
fn a_stranger_that_holds_the_pipes_is_not_waited_for() {
    if !has_python() {
        return;
    }
    let popen =
        "import subprocess, sys; subprocess.Popen([\"sleep\", \"30\"], start_new_session=True); sys.exit(3)";
    let start = Instant::now();
    let Output { status, .. } = captured(&mut checking(&format!("python3 -c '{popen}'"), "20"));
    assert_eq!(status.code(), Some(1));
    assert!(start.elapsed() < SLEEP, "{:?}", start.elapsed());
}

#[test]
fn a_signal_ends_the_program_as_well() {
    for (signal, status) in [(Signal::INT, 130), (Signal::TERM, 143), (Signal::HUP, 129), (Signal::QUIT, 131)]
    {
        let mut child = checking("echo open >&9; SLEEP & SLEEP", "20").spawn().expect("it runs");
        let start = Instant::now();
        let mut stdout = child.stdout.take().expect("a pipe");
        stdout.read_exact(&mut [0; 5]).expect("a program that is running");
        kill_process(Pid::from_child(&child), signal).expect("it is there");
        assert_eq!(finish(child).status.code(), Some(status));
        assert_eq!(stdout.read(&mut [0]).expect("a pipe"), 0);
        assert!(start.elapsed() < SLEEP, "{:?}", start.elapsed());
    }
}

/// Only a few lines of unrequested output are kept, and of a line without end at most the allowed length.
#[cfg(target_os = "linux")]
#[test]
fn a_flood_takes_no_memory() {
    thread::scope(|scope| {
        for flood in ["yes", "yes '{\"id\"'", "cat /dev/zero", "yes >&2"] {
            scope.spawn(move || {
                let child = checking(&format!("read -r line; {flood}"), "0.3").spawn().expect("it runs");
                let peak = peak(&child);
                assert_eq!(finish(child).status.code(), Some(1), "{flood}");
                // Eight times the length of a line, since a growing vector uses up to three times its size for a moment.
                assert!((1..1 << 17).contains(&peak), "{flood}: {peak} kB");
            });
        }
    });
}

/// Returns the largest memory of a process until it ends, in kB.
#[cfg(target_os = "linux")]
fn peak(child: &Child) -> u64 {
    let mut peak = 0;
    loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).expect("a child");
        let Some(line) = status.lines().find_map(|line| line.strip_prefix("VmHWM:")) else { return peak };
        peak = line.trim().trim_end_matches(" kB").parse().expect("a number");
        thread::sleep(Duration::from_millis(10));
    }
}
