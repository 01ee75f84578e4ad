//! Tests that run in separate processes.

use super::*;

/// Runs one of the functions below in a new process of this test program.
fn alone(test: &str, path: &Path) -> Child {
    let mut command = Command::new(own_path());
    command
        .args([&own_name(&format!("alone::{test}")), "--exact", "--ignored", "--nocapture"])
        .env("CONTACT_ALONE", path);
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it runs")
}

#[test]
fn a_signal_ends_the_program_as_well() {
    in_time(|| {
        for (signal, status) in
            [(Signal::INT, 130), (Signal::TERM, 143), (Signal::HUP, 129), (Signal::QUIT, 131)]
        {
            let fifo = Fifo::new(&format!("signal-{}", signal.as_raw()));
            let lines = fifo.read();
            let mut alone = alone("asks_for_ever", &fifo.0);
            assert_eq!(lines.recv_timeout(LONG).as_deref(), Ok("open"));
            kill_process(Pid::from_child(&alone), signal).expect("it is there");
            assert_eq!(alone.wait().expect("a child").code(), Some(status));
            assert_eq!(lines.recv_timeout(LONG), Err(RecvTimeoutError::Disconnected));
        }
    });
}

#[test]
#[ignore = "run by another"]
fn asks_for_ever() {
    if let Some(path) = std::env::var_os("CONTACT_ALONE") {
        let script = format!("{} sleep 1000 & sleep 1000", open(Path::new(&path)));
        ask(&mut sh(&script, 5 * LONG), "a");
    }
}

/// Only a few lines of unrequested output are kept, and of a line without end at most the allowed length.
#[cfg(target_os = "linux")]
#[test]
fn a_flood_takes_no_memory() {
    in_time(|| {
        let output = alone("is_flooded", Path::new("")).wait_with_output().expect("a child");
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        let peak =
            text.lines().find_map(|line| line.strip_prefix("peak: ")).unwrap_or_else(|| panic!("{text}"));
        let peak: usize = peak.trim().trim_end_matches(" kB").parse().expect("a number");
        // A growing vector uses up to twice its size. The other tests need far less than one line.
        assert!(peak * 1024 < 3 * reply::MAX_LINE_BYTES, "{peak} kB");
    });
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "run by another"]
fn is_flooded() {
    if std::env::var_os("CONTACT_ALONE").is_some() {
        thread::scope(|scope| {
            for flood in ["yes", "yes '{\"id\"'", "cat /dev/zero", "yes >&2"] {
                scope.spawn(move || {
                    let mut program = sh(&format!("read -r line; answer; {flood}"), LONG);
                    process(&ask(&mut program, "a"));
                    program.timeout = 2 * SHORT;
                    thread::sleep(2 * SHORT);
                    let start = Instant::now();
                    assert!(matches!(ask(&mut program, "b"), Reply::TimedOut(_)));
                    assert!(start.elapsed() < LONG, "{flood}: {:?}", start.elapsed());
                });
            }
        });
        let status = fs::read_to_string("/proc/self/status").expect("a process");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
        println!("\npeak: {peak}");
    }
}
