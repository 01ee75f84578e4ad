//! What a time-out says, and what a line that is too long is.

use super::*;

/// Quotes of Python's own, and a forgotten flush: what nearly everyone tries first.
#[test]
fn a_time_out_says_what_it_saw() {
    for (script, seen) in [
        ("read -r line; echo hello; echo \"{'id': 'a'}\"; sleep 60", "no JSON object: {'id': 'a'}"),
        ("read -r line; sleep 60", "nothing on stdout: does it flush?"),
    ] {
        let mut program = sh(script, SHORT);
        let Reply::TimedOut(own) = ask(&mut program, "a") else { panic!("{script}") };
        assert!(own.ends_with(seen), "{own}");
    }
}

#[test]
fn a_line_that_is_too_long_is_garbled() {
    let long =
        format!(r#"printf '{{"id": "a", "x": "'; head -c {} /dev/zero | tr '\0' x; printf '"}}\n'"#, 1 << 24);
    let mut program = sh(&format!("read -r line; {long}; {LOOP}"), LONG);
    assert_eq!(garbled(&ask(&mut program, "a")), "a line must have no more than 16777216 bytes");
}
