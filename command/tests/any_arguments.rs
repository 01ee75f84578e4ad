//! The command with arbitrary arguments: its options in any order and number, with values that are valid,
//! invalid, huge, empty or not text.
//!
//! `ARGUMENTS=100000 cargo test --release -p spring-mass-contact-cli any_arguments` tests this number of lists;
//! `SEED=7` selects others.

use crate::processes::{Scratch, asked, captured, command, pick, random};
use oorandom::Rand64;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::process::Output;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::Instant;

/// Default number of lists.
const LISTS: u64 = 200;

/// Definition of an option by clap.
struct Opt {
    name: String,
    takes_value: bool,
    /// Possible values, if they are enumerated.
    values: Vec<String>,
    /// Whether any text is valid.
    path: bool,
}

struct Subcommand {
    name: String,
    options: Vec<Opt>,
}

/// Returns the definitions that clap uses for completions.
fn subcommands() -> Vec<Subcommand> {
    let output = captured(command().args(["completions", "fish"]));
    let script = String::from_utf8(output.stdout).expect("UTF-8");
    let mut subcommands: Vec<Subcommand> = Vec::new();
    for line in script.split("\ncomplete -c contact ") {
        if let Some((_, rest)) = line.split_once("__fish_contact_needs_command\" -f -a \"") {
            let name = rest.split('"').next().expect("a name").to_string();
            subcommands.push(Subcommand { name, options: Vec::new() });
        } else if let Some((_, rest)) = line.split_once("__fish_contact_using_subcommand ") {
            let (subcommand, rest) = rest.split_once('"').expect("a name");
            let Some((_, rest)) = rest.split_once(" -l ") else { continue };
            let name = rest.split(' ').next().expect("a name").to_string();
            let end = rest.rfind("' -").map_or("", |end| &rest[end..]);
            let list = rest.split_once(" -r -f -a \"").map_or("", |(_, list)| list);
            let values =
                list.lines().filter_map(|line| line.split_once("\\t")).map(|(value, _)| value.to_string());
            let option = Opt {
                name: format!("--{name}"),
                takes_value: end.starts_with("' -r") || !list.is_empty(),
                values: values.collect(),
                path: end.starts_with("' -r -F"),
            };
            let own = subcommands.iter_mut().find(|own| own.name == subcommand).expect("a subcommand");
            own.options.push(option);
        }
    }
    subcommands
}

/// The definitions contain known options.
#[test]
fn the_generated_options_agree_with_clap() {
    let all = subcommands();
    let names: Vec<_> = all.iter().map(|own| own.name.as_str()).collect();
    let expected =
        ["verify", "prove", "solve", "advise", "sweep", "cases", "check", "equations", "completions", "help"];
    assert_eq!(names, expected);
    for Subcommand { name, options } in &all {
        let help = captured(command().args(["help", name]));
        let help = String::from_utf8(help.stdout).expect("UTF-8");
        for Opt { name: option, takes_value, values, path } in options {
            let (_, said) = help.split_once(option).unwrap_or_else(|| panic!("{name} {option}"));
            assert_eq!(said.starts_with(" <"), *takes_value, "{name} {option}");
            assert!(values.iter().all(|value| said.contains(value.as_str())), "{name} {option}");
            assert_eq!(*path, option == "--coq");
        }
    }
    let solve = all.iter().find(|own| own.name == "solve").expect("a subcommand");
    assert!(solve.options.len() > 10);
}

const NUMBERS: [&str; 22] = [
    "1",
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
];
const COUNTS: [&str; 8] =
    ["0", "1", "2", "7", "-1", "1.5", "18446744073709551616", "99999999999999999999999"];
const SCALARS: [&str; 10] =
    ["f32", "f64", "exact", "mpfr:2", "mpfr:53", "mpfr:300", "mpfr:1", "mpfr:1000001", "mpfr:", "f16"];
const WORDS: [&str; 16] = [
    "1.13",
    "Theorem 1.3.3",
    "note 4",
    "1.99",
    "",
    " ",
    "-",
    "--",
    "-x",
    "--no-such",
    "=",
    "--=",
    "\u{e9}",
    "\u{202e}",
    "a\nb",
    "\u{1b}[1m",
];
const FAMILIES: [&str; 5] = ["contact", "near", "tiny", "nowhere", "Contact"];
const PROGRAMS: [&str; 6] = ["true", "cat", "false", "/", "", "no such program"];

fn one_in(random: &mut Rand64, n: u64) -> bool {
    random.rand_range(0..n) == 0
}

/// Returns a value for an option, usually a valid one.
fn value(random: &mut Rand64, option: &Opt) -> OsString {
    if one_in(random, 40) {
        return OsStr::from_bytes(b"\xff\xfe").into();
    }
    if one_in(random, 40) {
        return "9".repeat(5000).into();
    }
    let likely: &[&str] = match option.name.as_str() {
        "--cases" | "--seed" | "--max-augmentations" | "--points" => &COUNTS,
        "--scalar" => &SCALARS,
        "--family" => &FAMILIES,
        "--timeout" => &["0.05", "0.01", "0", "1e9"],
        "--coq" => &["a folder", "file", "file/below"],
        _ => &NUMBERS,
    };
    match random.rand_range(0..10) {
        0 => pick(random, &NUMBERS).to_string().into(),
        1 => pick(random, &WORDS).to_string().into(),
        _ if !option.values.is_empty() => pick(random, &option.values).into(),
        _ => pick(random, likely).to_string().into(),
    }
}

/// Returns a list of arguments; expensive options have small values.
fn list(random: &mut Rand64, subcommands: &[Subcommand]) -> Vec<OsString> {
    let mut list: Vec<OsString> = Vec::new();
    let Subcommand { name, options } = pick(random, subcommands);
    if !one_in(random, 20) {
        list.push(name.into());
    }
    for _ in 0..random.rand_range(0..6) {
        let foreign = one_in(random, 20);
        let options = if foreign { &pick(random, subcommands).options } else { options };
        if options.is_empty() || one_in(random, 12) {
            list.push(pick(random, &WORDS).to_string().into());
            continue;
        }
        let option = pick(random, options);
        // One in so many has no value though it should, or has one though it should not.
        if option.takes_value == one_in(random, 20) {
            list.push((&option.name).into());
        } else if one_in(random, 2) {
            list.extend([(&option.name).into(), value(random, option)]);
        } else {
            let mut joined = OsString::from(format!("{}=", option.name));
            joined.push(value(random, option));
            list.push(joined);
        }
    }
    // Without arguments the command proves and checks everything, which other tests do.
    if list.is_empty() {
        list.push("help".into());
    }
    let little: &[&str] = match name.as_str() {
        "verify" => &["--cases=1", "1.1"],
        "prove" => &["1.2"],
        "solve" if one_in(random, 2) => &["--method=augmented", "--max-augmentations=2"],
        "check" => &["--family=contact", "--cases=2"],
        "completions" => &["bash"],
        _ => &[],
    };
    list.extend(little.iter().map(|word| OsString::from(*word)));
    if name == "check" && !one_in(random, 8) {
        list.extend(["--".into(), pick(random, &PROGRAMS).to_string().into()]);
    }
    list
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
    let subcommands = &subcommands();
    let (lists, seed) = (asked("ARGUMENTS", LISTS), asked("SEED", 1));
    let folder = Scratch::new("any_arguments");
    fs::write(folder.join("file"), "").expect("a file");
    let next = AtomicU64::new(0);
    let work = || {
        let mut statuses = [0_u64; 3];
        let mut slowest = (0.0, Vec::new());
        loop {
            let own = next.fetch_add(1, Ordering::Relaxed);
            if own >= lists {
                return (statuses, slowest);
            }
            let list = list(&mut random(seed, own), subcommands);
            let start = Instant::now();
            let output = captured(command().args(&list).current_dir(&*folder).env("NO_COLOR", "1"));
            let took = start.elapsed().as_secs_f64();
            if took > slowest.0 {
                slowest = (took, list.clone());
            }
            // A batch without lines has no answers.
            let silent =
                output.stdout.is_empty() && output.stderr.is_empty() && !list.contains(&"--batch".into());
            if let Some(wrong) = wrong(&output).or(silent.then_some("it has no goals")) {
                panic!("list {own}: contact {list:?}: {wrong}: {output:?}");
            }
            statuses[output.status.code().expect("a status") as usize] += 1;
        }
    };
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let done = thread::scope(|scope| {
        let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        workers.into_iter().map(|worker| worker.join().unwrap()).collect::<Vec<_>>()
    });
    // Enough of each kind for something to have been tried.
    for status in 0..3 {
        let count: u64 = done.iter().map(|(statuses, _)| statuses[status]).sum();
        assert!(count * 50 >= lists, "status {status}: {count} of {lists}");
        eprintln!("status {status}: {count}");
    }
    done.iter().for_each(|(_, (took, list))| eprintln!("slowest: {took:.2} s, contact {list:?}"));
}

/// The message for one invalid value among valid ones contains the option and the value.
#[test]
fn an_invalid_value_is_reported_with_its_option() {
    for Subcommand { name, options } in &subcommands() {
        for Opt { name: option, takes_value, path, .. } in options {
            if *takes_value && !path {
                let output = captured(command().args([name, option, "no such"]));
                let line = String::from_utf8_lossy(&output.stderr);
                assert_eq!(
                    (wrong(&output), output.status.code()),
                    (None, Some(2)),
                    "{name} {option}: {line}"
                );
                let start = format!("error: invalid value 'no such' for '{option} ");
                assert!(line.starts_with(&start) && line.len() > start.len() + 20, "{name} {option}: {line}");
            }
        }
    }
}
