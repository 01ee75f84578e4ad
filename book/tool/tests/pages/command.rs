//! The page about the command says what the command does: its options are those of the sources, and its
//! samples are the outputs that `command/tests/cmd` holds the command to. So are all samples of the page on stalls.

use super::files::{files, root, text};
use super::page;
use book_tool::PAGES;
use regex::Regex;
use std::collections::{BTreeMap, BTreeSet};

/// The options that the command's sources declare.
fn declared() -> BTreeSet<String> {
    // What a number may be stands in a second attribute, where the first would be too long.
    let option = r#"#\[arg\(long(?: = "([\w-]+)")?[^\n]*\)\]\s+(?:#\[arg[^\n]*\]\s+)?(?:pub )?(\w+):"#;
    let option = Regex::new(option).unwrap();
    let sources = files(&root().join("command/src"), ".rs");
    let sources: String = sources.iter().map(|path| text(path)).collect();
    option
        .captures_iter(&sources)
        .map(|found| found.get(1).map_or_else(|| found[2].replace('_', "-"), |name| name.as_str().into()))
        .collect()
}

#[test]
fn every_option_is_on_the_page_and_no_other() {
    let flag = Regex::new(r"(?:^|[\s`])--([a-z][a-z-]+)").unwrap();
    let mut named: BTreeSet<String> =
        flag.captures_iter(&page("command")).map(|found| found[1].into()).collect();
    // Cargo's own, and the one that every command has.
    assert!(named.remove("release") && named.remove("path") && named.remove("help"));
    assert_eq!(named, declared());
}

/// Commands with what they print, which may be nothing if the text does not show it.
fn transcript(text: &str) -> Vec<(String, Vec<String>)> {
    let mut runs: Vec<(String, Vec<String>)> = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        if line.starts_with("```") {
            inside = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| inside) {
            runs.push((command.into(), Vec::new()));
        } else if inside && !line.starts_with("? ") {
            runs.last_mut().expect("a command").1.push(line.into());
        }
    }
    for (_, output) in &mut runs {
        while output.last().is_some_and(|line| line.is_empty()) {
            output.pop();
        }
    }
    runs
}

#[test]
fn the_samples_are_what_the_command_prints() {
    let snapshots: BTreeMap<_, _> = files(&root().join("command/tests/cmd"), ".trycmd")
        .iter()
        .flat_map(|path| transcript(&text(path)))
        .collect();
    let mut compared = 0;
    // What the page on stalls shows in part has a test of its own.
    let pages = PAGES.iter().filter(|page| **page != "stalls");
    let pages = pages.map(|name| page(name));
    for (command, sample) in pages.flat_map(|page| transcript(&page)) {
        let Some(snapshot) = snapshots.get(&command).filter(|_| !sample.is_empty()) else {
            // All the cases take too long for a test.
            assert!(sample.is_empty() || command == "contact", "nothing holds the output of {command}");
            continue;
        };
        assert_eq!(sample.len(), snapshot.len(), "{command}");
        for (line, expected) in sample.iter().zip(snapshot) {
            let pattern = regex::escape(expected).replace(r"\[\.\.\]", ".*");
            let pattern = Regex::new(&format!("^{pattern}$")).unwrap();
            assert!(pattern.is_match(line), "{command}: {line:?} is not {expected:?}");
        }
        compared += 1;
    }
    assert!(compared >= 5, "only {compared} samples were compared");
}

/// Each sample of the page is in its own file of `command/tests/cmd`, in the same order, and nothing else is. What the
/// sample leaves out, as ` …`, the file leaves open, as `...`; the rest is held character by character.
#[test]
fn what_the_page_on_stalls_shows_is_what_the_command_prints() {
    let page = page("stalls");
    let commands =
        |runs: &[(String, Vec<String>)]| -> Vec<_> { runs.iter().map(|run| run.0.clone()).collect() };
    let mut shown = transcript(&page);
    assert_eq!(page.matches("$ contact").count(), shown.len(), "a command that is not in a block of its own");
    for line in shown.iter_mut().flat_map(|(_, output)| output) {
        if line == " …" {
            *line = "...".into();
        }
    }
    let held = text(&root().join("command/tests/cmd/stalls.trycmd"));
    assert!(!held.contains("[..]"), "all that is shown is held");
    let held = transcript(&held);
    assert_eq!(commands(&shown), commands(&held));
    for ((command, output), (_, expected)) in shown.iter().zip(&held) {
        assert_eq!(output.join("\n"), expected.join("\n"), "{command}");
        assert!(output.iter().any(|line| line != "..."), "{command}: nothing is shown");
    }
}

#[test]
fn every_symptom_has_a_section_with_an_example_a_test_and_a_remedy() {
    let page = page("stalls");
    let (table, sections) = page.split_once("## The ratio").expect("what follows the table");
    let linked = |text| -> BTreeSet<_> {
        let link = Regex::new(r"(?m)^\| \[.*?\]\(#([\w-]+)\) \|").unwrap();
        link.captures_iter(text).map(|found| found[1].to_string()).collect()
    };
    let (anchor, mut shown) = (Regex::new(r"\{#([\w-]+)\}\n").unwrap(), BTreeSet::new());
    for section in sections.split("\n## ").filter(|section| section.contains("\n*Test.*")) {
        let id = anchor.captures(section).expect("an anchor")[1].to_string();
        assert!(section.contains("\n*Remedy.*"), "{id}: no remedy");
        assert!(
            ["console", "rust"].iter().any(|kind| section.contains(&format!("\n```{kind}\n"))),
            "{id}: no example"
        );
        shown.insert(id);
    }
    assert_eq!(linked(table), shown);
}
