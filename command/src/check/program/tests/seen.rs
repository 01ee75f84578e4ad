//! Messages about time-outs and lines that are too long.

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
