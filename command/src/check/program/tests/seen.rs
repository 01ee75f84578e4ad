//! Messages about time-outs, lines that are too long, and programs that cannot be started.

use super::*;

/// Python's single quotes, and a missing flush: frequent first mistakes.
#[test]
fn a_timeout_reports_the_last_output() {
    in_time(|| {
        for (script, seen) in [
            ("read -r line; echo hello; echo \"{'id': 'a'}\"; sleep 60", "not a JSON object: {'id': 'a'}"),
            ("read -r line; sleep 60", "nothing on stdout; it may not flush its output"),
            ("read -r line; printf '{\"id\": \"a\"}'; sleep 60", "without a line break: {\"id\": \"a\"}"),
            ("read -r line; echo one; printf 'two three'; sleep 60", "without a line break: two three"),
            ("read -r line; printf o; sleep 0.1; printf 'ne\\n'; sleep 60", "not a JSON object: one"),
            ("read -r line; printf on; sleep 0.1; printf 'e two'; sleep 60", "without a line break: one two"),
        ] {
            let own = |timeout| match ask(&mut sh(script, timeout), "a") {
                Reply::TimedOut(own) => own,
                other => panic!("{script}: {other:?}"),
            };
            // On a busy machine it may not print anything in time.
            let soon = own(SHORT);
            let own = if soon.ends_with(seen) { soon } else { own(LONG / 4) };
            assert!(own.ends_with(seen), "{own}");
        }
    });
}

#[test]
fn a_line_that_is_too_long_is_garbled() {
    in_time(|| {
        let long = format!(
            r#"printf '{{"id": "a", "x": "'; head -c {} /dev/zero | tr '\0' x; printf '"}}\n'"#,
            1 << 24
        );
        let mut program = sh(&format!("read -r line; {long}; {LOOP}"), LONG);
        assert_eq!(garbled(&ask(&mut program, "a")), "a line must have no more than 16777216 bytes");
    });
}

/// Returns the path of an executable file with this text. It is written by another process, because a file
/// that any process has open for writing, even between fork and exec, cannot be executed.
fn executable(name: &str, text: &str) -> String {
    let path = std::env::temp_dir().join(format!("contact-{name}-{}", std::process::id()));
    let write = r#"printf '%s' "$1" >"$0" && chmod 700 "$0""#;
    let written = std::process::Command::new("sh").args(["-c", write]).arg(&path).arg(text).status();
    assert!(written.expect("a shell").success());
    path.display().to_string()
}

#[test]
fn a_program_that_cannot_be_started_is_bad_input() {
    in_time(|| {
        let without_format = executable("unknown", "neither a script nor a binary");
        for name in ["/no such/program", "/", &without_format] {
            let words = [name, "x"].map(String::from);
            let Err(Failure::Input(line)) = Program::new(&words, LONG).ask(&problem("a")) else {
                panic!("{words:?}");
            };
            assert!(
                line.starts_with(&format!("invalid value '{name}' for '<PROGRAM>...': cannot be started: ")),
                "{line}"
            );
            let must = match line.contains("No such file") {
                true => "must be the name of a program on the PATH, or its path",
                false => "must be an executable program; a script begins with #!",
            };
            assert!(line.ends_with(must), "{line}");
        }
        fs::remove_file(without_format).unwrap();
    });
}

/// A program that disappears is not an invalid argument.
#[test]
fn a_program_that_is_gone_has_crashed() {
    in_time(|| {
        let script = "#!/bin/sh\nread -r line; rm -f \"$0\"; echo '{\"id\": \"z\"}'\n";
        let mut program = Program::new(&[executable("gone", script)], LONG);
        assert!(matches!(ask(&mut program, "a"), Reply::InvalidResponse(_)));
        let Reply::Crashed(how) = ask(&mut program, "b") else { panic!("it is still there") };
        assert!(how.starts_with("cannot be started again: "), "{how}");
    });
}
