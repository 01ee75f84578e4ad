//! Mutants of the source that no test detects, with the reasons.
//!
//! `tests/mutants/run` changes one operator, one condition, one value of the source after another, as
//! cargo-mutants does, and runs the fast tests on each. A mutant that survives needs a new test, or an entry
//! in `excused` beside this file that explains why it is equivalent.

use serde_json::Value;
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// A mutant as cargo-mutants names it, with the source line in place of its number.
#[derive(PartialEq, Eq, Hash, Debug)]
struct Mutant {
    file: String,
    change: String,
    line: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Returns the excused mutants with reasons. Each has three lines: `file: mutation`, the source line, and the
/// reason. An empty line follows.
fn excuses() -> HashMap<Mutant, String> {
    let mut excuses = HashMap::new();
    for block in read("tests/mutants/excused").split("\n\n") {
        let lines: Vec<_> =
            block.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("# ")).collect();
        if lines.is_empty() {
            continue;
        }
        let [head, line, reason] = lines[..] else {
            panic!("an excuse takes three lines, this has not: {lines:#?}")
        };
        let (file, change) = head.split_once(": ").unwrap_or_else(|| panic!("{head} names no file"));
        let [file, change, line] = [file, change, line].map(String::from);
        assert!(reason.split(' ').count() > 3, "{head}: {reason} is too short for a reason");
        let before = excuses.insert(Mutant { file, change, line }, reason.to_string());
        assert!(before.is_none(), "{head} is excused twice");
    }
    excuses
}

#[test]
fn excused_lines_exist_in_the_source() {
    for Mutant { file, change, line } in excuses().keys() {
        let there = read(file).lines().any(|own| own.trim() == line);
        assert!(there, "{file} no longer has this line; remove its excuse:\n  {line}\n  {change}");
        let taken = change
            .strip_prefix("replace ")
            .and_then(|rest| rest.split_once(" with "))
            .map(|(taken, _)| taken);
        let operator = taken.filter(|taken| !taken.contains(char::is_alphabetic));
        assert!(operator.is_none_or(|operator| line.contains(operator)), "nothing to {change} in\n  {line}");
    }
}

/// cargo would refuse each mutant as if it did not build.
#[test]
fn test_targets_of_the_run_exist() {
    let settings = read(".cargo/mutants.toml");
    let targets: Vec<_> =
        settings.split("\"--test=").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert!(targets.len() > 10, "{targets:?}");
    for target in targets {
        let there = ["", "engine/", "command/"].iter().any(|package| {
            let path = root().join(package).join("tests").join(target);
            path.join("main.rs").is_file() || path.with_extension("rs").is_file()
        });
        assert!(there, ".cargo/mutants.toml names {target}, which is not a test target");
    }
}

/// Returns the mutants of a run that are named in the text.
fn mutants(all: &Value, named: impl Fn(&str) -> bool) -> Vec<Mutant> {
    let all = all.as_array().expect("a list of mutants");
    let named = all.iter().filter(|mutant| named(mutant["name"].as_str().expect("a name")));
    let mutant = named.map(|mutant| {
        let text = |value: &Value| value.as_str().expect("a text").to_string();
        let (name, file) = (text(&mutant["name"]), text(&mutant["file"]));
        let number = mutant["span"]["start"]["line"].as_u64().expect("a line's number") as usize;
        let line = read(&file).lines().nth(number - 1).unwrap_or_default().trim().to_string();
        Mutant { change: name.splitn(4, ':').last().unwrap_or_default().trim().to_string(), file, line }
    });
    mutant.collect()
}

#[test]
#[ignore = "tests/mutants/run runs it"]
fn every_mutant_is_detected_or_excused() {
    let all = serde_json::from_str(&read("target/mutants/mutants.json")).expect("JSON");
    let missed = read("target/mutants/missed.txt");
    let (excuses, all, missed) =
        (excuses(), mutants(&all, |_| true), mutants(&all, |name| missed.lines().any(|line| line == name)));
    let unnoticed: Vec<_> = missed.iter().filter(|mutant| !excuses.contains_key(mutant)).collect();
    assert!(unnoticed.is_empty(), "no test notices, and nothing excuses: {unnoticed:#?}");
    let idle: Vec<_> = excuses.keys().filter(|mutant| !all.contains(mutant)).collect();
    assert!(idle.is_empty(), "these mutants no longer exist; remove their excuses: {idle:#?}");
}
