//! Tests of the binary, which `.ci/run` runs with more executions.

use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_any_bits")).args(arguments).output().unwrap()
}

#[test]
fn a_sample_of_bits_violates_no_property() {
    for target in ["parse", "solve_f64", "functions"] {
        let output = run(&["--executions", "50", "--target", target]);
        assert!(output.status.success(), "{output:?}");
    }
}

#[test]
fn invalid_arguments_are_named() {
    for (arguments, message) in [
        (
            ["--target", "none"],
            "error: invalid value \"none\" for '--target': must be one of parse, solve_f32",
        ),
        (["--seed", "-1"], "error: invalid value \"-1\" for '--seed': must be an integer from 0 to"),
        (["--sed", "1"], "error: unexpected \"--sed\"; there are --target"),
    ] {
        let output = run(&arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && error.starts_with(message), "{error}");
    }
}
