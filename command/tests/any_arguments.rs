//! The command with arbitrary arguments: its options in any order and number, with values that are valid,
//! invalid, huge, empty or not text. `PROPTEST_CASES` is the number of lists.

use crate::processes::{Scratch, captured, command};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, TestRunner};
use std::cell::Cell;
use std::os::unix::ffi::OsStringExt;
use std::process::Output;

/// An option or an argument: its name, and its values, if it has some.
type Opt = (String, Option<Vec<String>>);

/// Returns the subcommands and their options.
fn subcommands() -> Vec<(String, Vec<Opt>)> {
    let option = |option: &clap::Arg| {
        let values = option.get_possible_values().iter().map(|value| value.get_name().to_string()).collect();
        (format!("--{}", option.get_long()?), option.get_action().takes_values().then_some(values)).into()
    };
    let definition = spring_mass_contact_cli::definition();
    let all = definition.get_subcommands().map(|command| {
        (command.get_name().to_string(), command.get_arguments().filter_map(option).collect())
    });
    all.collect()
}

const VALUES: [&str; 40] = [
    "1",
    "2",
    "7",
    "100",
    "0.05",
    "1e-9",
    "1/3",
    "-1/3",
    "9.81",
    "1e300",
    "-1e-300",
    "1e1000",
    "0",
    "-0",
    "1e",
    ".",
    "1e400000",
    "1/0",
    "nan",
    "inf",
    "0x1",
    "1..1e9",
    "1e-3..1/2",
    "2..1",
    "18446744073709551616",
    "f32",
    "exact",
    "mpfr:300",
    "mpfr:1",
    "f16",
    "contact",
    "near",
    "1.13",
    "Theorem 1.3.3",
    "",
    "--",
    "\u{e9}",
    "\u{202e}",
    "a\nb",
    "\u{1b}[1m",
];

/// Values that make an expensive option cheap, last in a list.
fn little(subcommand: &str) -> &'static [&'static str] {
    match subcommand {
        "verify" => &["--cases=1", "1.1"],
        "prove" => &["1.2"],
        "solve" => &["--max-augmentations=2"],
        "check" => &["--family=contact", "--cases=2", "--", "cat"],
        "completions" => &["bash"],
        _ => &[],
    }
}

/// Returns an option of these with a value, usually a possible one, or without; or a word.
fn any_argument(options: Vec<Opt>) -> BoxedStrategy<Vec<String>> {
    let word = prop_oneof![20 => select(&VALUES[..]).prop_map(String::from), 1 => Just("9".repeat(5000))];
    if options.is_empty() {
        return word.prop_map(|word| vec![word]).boxed();
    }
    let option = (select(options), word.clone(), any::<prop::sample::Index>(), 0..20_u8);
    let option = option.prop_map(|((name, values), word, any, drawn)| match (values, drawn) {
        (None, 0) | (Some(_), 1) => vec![format!("{name}={word}")],
        (None, _) | (Some(_), 0) => vec![name],
        (Some(values), 2..16) if !values.is_empty() => vec![name, values[any.index(values.len())].clone()],
        (Some(_), _) => vec![name, word],
    });
    prop_oneof![10 => option, 1 => word.prop_map(|word| vec![word])].boxed()
}

/// Returns the fault of an output.
fn wrong(Output { status, stdout, stderr }: &Output) -> Option<&'static str> {
    let stderr = String::from_utf8_lossy(stderr);
    let line = stderr.strip_suffix('\n').unwrap_or("");
    match status.code() {
        _ if stderr.contains("panicked at") => Some("it panics"),
        Some(0 | 1) if !stderr.is_empty() => Some("it says something on stderr"),
        Some(0 | 1) => None,
        Some(2) if !stdout.is_empty() => Some("it says something on stdout"),
        Some(2) if !line.starts_with("error: ") || line.len() > 600 => Some("there is no line on stderr"),
        Some(2) if line.chars().any(|c| c.is_control() || c == '\u{202e}') => Some("the line can be broken"),
        Some(2) => None,
        _ => Some("it ends otherwise"),
    }
}

#[test]
fn no_arguments_get_further_than_they_should() {
    let lists = select(subcommands()).prop_flat_map(|(name, options)| {
        let little = little(&name).iter().map(|word| word.to_string());
        let end: Vec<_> = little.collect();
        vec(any_argument(options), 0..4)
            .prop_map(move |list| [vec![name.clone()], list.concat(), end.clone()].concat())
    });
    let folder = Scratch::new("any_arguments");
    let statuses = Cell::new([0; 3]);
    let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::default() });
    let ran = runner.run(&lists, |list| {
        let output = captured(command().args(&list).current_dir(&*folder).env("NO_COLOR", "1"));
        prop_assert_eq!(wrong(&output), None, "{:?}", output);
        let mut counts = statuses.get();
        counts[output.status.code().expect("a status") as usize] += 1;
        statuses.set(counts);
        Ok(())
    });
    ran.unwrap_or_else(|error| panic!("{error}"));
    // Status 1, an answer that is no success, is rare.
    let counts = statuses.get();
    assert!(counts[0] > 0 && counts[2] > 0, "{counts:?}");
}

/// The message for one invalid value contains the option and the value.
#[test]
fn an_invalid_value_is_reported_with_its_option() {
    for (subcommand, options) in subcommands() {
        for (option, _) in options.iter().filter(|(name, values)| values.is_some() && name != "--coq") {
            for value in ["no such", "1e999999999", "\u{661}", "1,5"] {
                let output = captured(command().args([&subcommand, option, value]));
                let line = String::from_utf8_lossy(&output.stderr);
                assert_eq!((wrong(&output), output.status.code()), (None, Some(2)), "{line}");
                let start = format!("error: invalid value '{value}' for '{option} ");
                assert!(line.starts_with(&start) && line.len() > start.len() + 20, "{subcommand}: {line}");
            }
        }
    }
}

#[test]
fn a_long_argument_is_shortened() {
    let long = "x".repeat(1000);
    for arguments in [vec![&*long], vec!["solve", &long], vec!["solve", "--method", &long]] {
        let output = captured(command().args(arguments));
        let line = String::from_utf8_lossy(&output.stderr);
        assert!(line.starts_with("error: ") && line.contains("xxx…'") && line.len() < 300, "{line}");
    }
}

#[test]
fn an_argument_that_is_not_unicode_is_refused() {
    let bytes = std::ffi::OsString::from_vec(b"\xff\xfe".to_vec());
    let output = captured(command().args(["solve", "--mass"]).arg(bytes));
    assert_eq!((wrong(&output), output.status.code()), (None, Some(2)));
}
